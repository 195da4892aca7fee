//! Tables and pictures.

use std::fmt::Write as _;
use std::path::Path;

use equipod::methods::plot::{ConvergenceCurve, ConvergenceFigure, convergence_chart};

use crate::record::{Point, Rival, Spent};
use crate::verdict::{Judged, Verdict};
use crate::{Answer, Failure};

/// One problem.
#[derive(Debug)]
pub(crate) struct Row {
    pub(crate) name: String,
    /// The quantity to be maximised; costs are negative.
    pub(crate) quantity: String,
    /// The number of poses, or that they fill a region.
    pub(crate) poses: String,
    /// Processor time of CMA-ES over that of the optimiser.
    pub(crate) factor: f64,
    pub(crate) ours: Answer,
    pub(crate) random: Rival,
    pub(crate) rival: Rival,
    /// Against random designs and against CMA-ES.
    pub(crate) verdicts: [Verdict; 2],
}

/// All problems.
#[derive(Debug, Default)]
pub(crate) struct Report {
    pub(crate) rows: Vec<Row>,
}

fn value(j: Option<Judged>) -> String {
    match j {
        Some(j) if j.violation <= 0.0 && j.value.abs() < 10.0 => format!("{:.9}", j.value),
        Some(j) if j.violation <= 0.0 => format!("{:.4}", j.value),
        Some(j) => format!("violates by {:.1e}", j.violation),
        None => "none".into(),
    }
}

fn seconds(s: Spent) -> String {
    format!("{:.2}", s.cpu)
}

const HEAD: &str = "\
# Results of the optimiser

This table shows users of `optimize` its results beside random designs and CMA-ES; the [benchmarks](../benchmarks.md#optimiser) define the columns.
`tests/optimizer/run` writes it, and [the CSV](optimizer.csv) with further columns; `s` are processor seconds.

| problem | value | optimiser | proved: none above | s | best random | feasible of drawn | s | optimiser against random | CMA-ES | s | optimiser against CMA-ES |
|---|---|--:|--:|--:|--:|--:|--:|---|--:|--:|---|
";

impl Row {
    pub(crate) fn has_loss(&self) -> bool {
        self.verdicts.iter().any(|v| v.is_loss())
    }

    pub(crate) fn markdown(&self) -> String {
        format!(
            "| {} | {} | {} | {} | {} | {} | {} of {} | {} | {} | {} | {} | {} |",
            self.name,
            self.quantity,
            value(self.ours.judged),
            self.ours.bound.map_or("-".into(), |b| format!("{b:.6}")),
            seconds(self.ours.spent),
            value(self.random.judged),
            self.random.evaluations,
            self.random.draws,
            seconds(self.random.spent),
            self.verdicts[0],
            value(self.rival.judged),
            seconds(self.rival.spent),
            self.verdicts[1],
        )
    }

    fn csv(&self) -> String {
        let plain = |j: Option<Judged>| {
            j.map_or(String::from(","), |j| format!("{:.17e},{:.3e}", j.value, j.violation))
        };
        format!(
            "\"{}\",\"{}\",{},{},{},{},{},{},{},{},{},\"{}\",{},{},{},{},{},\"{}\"",
            self.name,
            self.quantity,
            self.poses,
            plain(self.ours.judged),
            self.ours.bound.map_or(String::new(), |b| format!("{b:.17e}")),
            self.ours.spent.elapsed,
            self.ours.spent.cpu,
            plain(self.random.judged),
            self.random.evaluations,
            self.random.draws,
            self.random.spent.cpu,
            self.verdicts[0],
            plain(self.rival.judged),
            self.rival.draws,
            self.factor,
            self.rival.spent.elapsed,
            self.rival.spent.cpu,
            self.verdicts[1],
        )
    }

    /// The curves, each drawn to the end of its run.
    fn picture(&self) -> String {
        let curve = |label: &str, points: &[Point], end: f64| {
            let mut points: Vec<(f64, f64)> = points.iter().map(|p| (p.elapsed, p.value)).collect();
            points.extend(points.last().copied().map(|last| (end.max(last.0), last.1)));
            ConvergenceCurve { label: label.into(), points }
        };
        let mut own = self.ours.curve.clone();
        if let (Some(judged), end) = (self.ours.judged, self.ours.spent.elapsed) {
            own.push(Point { elapsed: end, value: judged.value });
        }
        convergence_chart(&ConvergenceFigure {
            title: self.name.clone(),
            quantity: self.quantity.clone(),
            note: format!(
                "Poses: {}. The optimiser's curve ends when its run ends, proof of the bound included; CMA-ES had {} times its processor time.",
                self.poses, self.factor
            ),
            curves: vec![
                curve("optimiser", &own, self.ours.spent.elapsed),
                curve("CMA-ES", &self.rival.curve, self.rival.spent.elapsed),
                curve("random feasible designs", &self.random.curve, self.random.spent.elapsed),
            ],
        })
    }

    /// A file name.
    fn slug(&self) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' };
        self.name.replace(", ", "-").chars().map(plain).collect()
    }
}

impl Report {
    pub(crate) fn markdown(&self) -> String {
        let mut out = HEAD.to_string();
        for row in &self.rows {
            let _ = writeln!(out, "{}", row.markdown());
        }
        out
    }

    /// `optimizer.md`, `optimizer.csv` and one picture for each problem. Rows of other problems are kept: a run over
    /// everything takes hours and may be made in parts.
    pub(crate) fn write(&self, folder: &Path) -> Result<(), Failure> {
        std::fs::create_dir_all(folder)?;
        kept(&folder.join("optimizer.md"), &self.markdown(), |line| line.split('|').nth(1).map(str::trim))?;
        let mut csv = String::from(
            "problem,quantity,poses,value,violation,bound,elapsed,cpu,random_value,random_violation,random_feasible,random_drawn,random_cpu,\
             against_random,cmaes_value,cmaes_violation,cmaes_points,factor,cmaes_elapsed,cmaes_cpu,against_cmaes\n",
        );
        for row in &self.rows {
            let _ = writeln!(csv, "{}", row.csv());
            std::fs::write(folder.join(format!("convergence-{}.svg", row.slug())), row.picture())?;
        }
        kept(&folder.join("optimizer.csv"), &csv, |line| line.split('"').nth(1))
    }
}

/// Writes the rows of a table in place of those with the same key that the file has; the others stay.
fn kept(file: &Path, table: &str, key: fn(&str) -> Option<&str>) -> Result<(), Failure> {
    let earlier = std::fs::read_to_string(file).unwrap_or_default();
    let stays = |line: &&str| key(line).is_some_and(|k| table.lines().all(|new| key(new) != Some(k)));
    // heads have a key of their own in Markdown and none in CSV
    let rows: Vec<&str> = table.lines().chain(earlier.lines().filter(stays)).collect();
    std::fs::write(file, rows.join("\n") + "\n")?;
    Ok(())
}
