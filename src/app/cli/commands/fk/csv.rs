//! Poses as a table that other programs read without options: one pose on each row, units in the names of the columns.

use crate::app::cli::table::{column_unit, csv_line, number};
use ask::{Design, PoseFrames};
use records::{FkAnswer, FkOneAnswer, FkRowOutcome, SideWord, SolutionRecord};

/// Number of cells of a pose between its number and the completeness.
const BESIDE_COMPLETENESS: usize = 14;

/// The options of `--csv`.
#[derive(Debug, Clone)]
pub(super) struct PoseTable {
    /// Whether the table is requested.
    pub(super) requested: bool,
    /// Whether complex poses are included.
    pub(super) all: bool,
    /// The column of times of the lengths.
    pub(super) time_name: Option<String>,
    /// The convention of the poses.
    pub(super) frames: PoseFrames,
    /// Only poses that meet the requirements.
    pub(super) limits: bool,
}

impl PoseTable {
    /// The table, if requested.
    pub(super) fn text(&self, design: &Design, answer: &FkAnswer) -> Option<String> {
        if !self.requested {
            return None;
        }
        let many = matches!(answer, FkAnswer::Rows(_));
        let mut out = csv_line(&self.header(&design.units, many));
        match answer {
            FkAnswer::One(one) => self.poses(&mut out, &[], one),
            FkAnswer::Rows(answer) => {
                for (k, row) in answer.rows.iter().enumerate() {
                    let mut before = vec![(k + 1).to_string()];
                    if self.time_name.is_some() {
                        before.push(row.time.map(number).unwrap_or_default());
                    }
                    match &row.outcome {
                        FkRowOutcome::Solved(one) => self.poses(&mut out, &before, one),
                        FkRowOutcome::Failed(_) => self.nothing(&mut out, &before, "failed"),
                    }
                }
            }
        }
        Some(out)
    }

    fn header(&self, units: &str, many: bool) -> Vec<String> {
        let unit = column_unit(units);
        let mut names: Vec<String> = Vec::new();
        if many {
            names.push("row".into());
            names.extend(self.time_name.clone());
        }
        names.extend(["pose", "nearest_home", "mode"].map(String::from));
        names.extend(["x", "y", "z"].map(|axis| format!("{axis}_{unit}")));
        names.extend(self.frames.convention.angle_names());
        let quaternion = self.frames.convention.quaternion_order().written(["qw", "qx", "qy", "qz"]);
        names.extend(quaternion.into_iter().chain(["real", "certified", "completeness"]).map(String::from));
        if self.all {
            for part in ["", "_im"] {
                names.extend(["x", "y", "z"].map(|axis| format!("p{axis}{part}_{unit}")));
                names.extend((1..=3).flat_map(|i| (1..=3).map(move |j| format!("r{i}{j}{part}"))));
            }
        }
        names
    }

    /// One row for each pose that may be real, from the nearest to home on, with its number in the text and in JSON;
    /// with `all` also the complex poses after them.
    fn poses(&self, out: &mut String, before: &[String], one: &FkOneAnswer) {
        let far = |s: &SolutionRecord| s.real_pose.map_or(f64::INFINITY, |p| p.distance_from_home);
        let mut shown: Vec<(usize, &SolutionRecord)> =
            one.solved.numbered().filter(|(_, s)| self.all || s.real != Some(false)).collect();
        if self.limits {
            shown.retain(|(_, s)| s.real_pose.is_none_or(|pose| pose.allowed != Some(false)));
        }
        shown.sort_by(|(_, a), (_, b)| far(a).total_cmp(&far(b)));
        let completeness = one.solved.completeness.name();
        if shown.is_empty() {
            self.nothing(out, before, completeness);
        }
        for (number, solution) in shown {
            let number = number.to_string();
            let cells = before.iter().cloned().chain([number]).chain(self.pose(solution, completeness));
            out.push_str(&csv_line(&cells.collect::<Vec<_>>()));
        }
    }

    /// The row of lengths without a pose: only their completeness.
    fn nothing(&self, out: &mut String, before: &[String], completeness: &str) {
        let blank = |n: usize| vec![String::new(); n];
        let mut cells = [before.to_vec(), blank(1 + BESIDE_COMPLETENESS), vec![completeness.into()]].concat();
        cells.extend(if self.all { blank(24) } else { Vec::new() });
        out.push_str(&csv_line(&cells));
    }

    /// The cells of a pose after its number; cells for real poses are empty for the others.
    fn pose(&self, solution: &SolutionRecord, completeness: &str) -> Vec<String> {
        let mut cells = Vec::new();
        if let Some(pose) = &solution.real_pose {
            let mode = pose.mode.map_or("", |side| match side {
                SideWord::Above => "above",
                SideWord::Below => "below",
            });
            cells.extend([pose.nearest_home.to_string(), mode.to_string()]);
            let written = &pose.in_frames;
            let values = written.position.iter().chain(&written.angles).chain(&written.quaternion);
            cells.extend(values.map(|x| number(x.0)));
        } else {
            cells.push("false".to_string());
            cells.extend(vec![String::new(); 11]);
        }
        cells.push(solution.real.map_or("undecided", |real| if real { "true" } else { "false" }).into());
        cells.extend([solution.certified.to_string(), completeness.to_string()]);
        if self.all {
            let (p, r) = (&solution.pose.position, &solution.pose.rotation);
            for (p, r) in [(&p.re, &r.re), (&p.im, &r.im)] {
                cells.extend(p.iter().chain(r.iter().flatten()).map(|x| number(x.0)));
            }
        }
        cells
    }
}
