//! `equipod plot workspace`.

use std::path::PathBuf;

use nalgebra::{Vector3, Vector6};

use crate::app::cli::freedoms::{Freedoms, PoseGrid};
use crate::app::cli::numbers;
use crate::app::cli::poses;
use crate::app::cli::{Context, Failure};
use ask::Design;
use files::plot::{RequiredSection, SectionOutline, WorkspaceFigure, WorkspaceLimit, workspace_slice};
use machine::requirements::{Limit, Limits, PoseSpace, Region};
use platform::geom::{Pose, PoseConvention};

/// Default half width for rotations, degrees.
const DEGREES: f64 = 90.0;

/// Arguments of `plot workspace`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotWorkspaceArgs {
    /// Design file (.toml or .json) with its limits in the table hardware
    design: PathBuf,
    /// Two freedoms on the axes: x, y, z, or rx, ry, rz (rotation vector, base frame)
    #[arg(long, value_name = "A,B", default_value = "x,y", value_parser = Freedoms::parse)]
    slice: Freedoms,
    /// Pose in the centre of the picture, with the other four freedoms
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Half widths of the picture, design units or degrees; default: the size, and 90 degrees
    #[arg(long, value_name = "A,B", value_parser = half_widths)]
    half_widths: Option<[f64; 2]>,
    /// Number of poses along each side of the picture
    #[arg(long, value_name = "N", default_value_t = 181, value_parser = clap::value_parser!(u16).range(2..=1001))]
    resolution: u16,
}

fn half_widths(text: &str) -> Result<[f64; 2], String> {
    let both = numbers::parse(text).filter(|half: &[f64; 2]| half.iter().all(|x| *x > 0.0));
    both.ok_or_else(|| "give two positive numbers separated by a comma".into())
}

pub(super) fn draw(args: &PlotWorkspaceArgs, context: &mut Context) -> Result<String, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let pose = poses::parse(
        &args.pose,
        &design.pose_frames(PoseConvention::default()),
        ("--pose", "plot::bad_pose"),
        context,
    )?;
    let default = || args.slice.places().map(|k| if k < 3 { m.size() } else { DEGREES });
    let grid = PoseGrid {
        freedoms: args.slice,
        middle: pose,
        half: args.half_widths.unwrap_or_else(default),
        side: usize::from(args.resolution),
    };
    let required = design.requirements();
    let limits = Limits::new(m, &required, &poses::home(&design));
    let found: Vec<_> = grid.poses().map(|pose| limits.at(&pose)).collect();
    // the limits that end the workspace in the picture, in the order of the kinds
    let missed = found.iter().filter(|p| p.share.is_nan() || p.share <= 0.0).filter_map(|p| p.limit);
    let mut names: Vec<LimitKind> = missed.map(LimitKind::of).collect();
    names.sort_unstable();
    names.dedup();
    let [across, up] = grid.axes(&design);
    Ok(workspace_slice(&WorkspaceFigure {
        title: format!("Workspace of \u{201c}{}\u{201d}", design.name),
        notes: notes(&design, &limits),
        across,
        up,
        side: grid.side,
        margins: found.iter().map(|p| p.share).collect(),
        worst: found
            .iter()
            .map(|p| p.limit.and_then(|l| names.binary_search(&LimitKind::of(l)).ok()))
            .collect(),
        limits: names.iter().map(|k| WorkspaceLimit { code: k.code(), name: k.words() }).collect(),
        required: required_section(&design, &grid),
        home: (grid.centre(), if args.pose == "home" { "home".into() } else { "pose".into() }),
    }))
}

/// A kind of limit, for any leg.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum LimitKind {
    Requirement(machine::requirements::TermKind),
    Singular,
}

impl LimitKind {
    fn of(limit: Limit) -> Self {
        match limit {
            Limit::Term(term) => Self::Requirement(term.kind),
            Limit::Singular => Self::Singular,
        }
    }

    fn code(self) -> &'static str {
        match self {
            Self::Requirement(kind) => kind.code(),
            Self::Singular => "singular",
        }
    }

    fn words(self) -> String {
        match self {
            Self::Requirement(kind) => kind.label().into(),
            Self::Singular => "beyond a singular pose".into(),
        }
    }
}

/// Freedoms of two poses with a smaller difference count as equal, in shares of the picture's half widths.
const SAME: f64 = 1e-6;
/// Number of corners of the polygon for an ellipse.
const ELLIPSE: usize = 96;

/// The section of the design's required workspace with the slice; `None` if it requires none.
fn required_section(design: &Design, grid: &PoseGrid) -> Option<RequiredSection> {
    if design.workspace.is_empty() {
        return None;
    }
    let home = poses::home(design);
    let space = design.workspace.space(&home);
    let [across, up] = grid.freedoms.places();
    let at_home = space.coordinates(&grid.middle).iter().all(|x| *x == 0.0);
    // rotations about another point than the origin also move the origin
    let moves_origin = space.pivot != Vector3::zeros() && (across >= 3 || up >= 3);
    let has_home_off_axes = space.region == Region::Ellipsoid && space.home_in_cube().is_some();
    let outline = match () {
        () if !design.workspace.has_box() => None,
        () if at_home && !moves_origin && !has_home_off_axes => {
            Some(SectionOutline::Through(section_at_home(&space, grid)))
        }
        // rotation vectors about different poses do not add, so the section is the zero line of a function
        () => Some(SectionOutline::Zero(
            grid.poses().map(|pose| inside(&space, [across, up], &space.coordinates(&pose))).collect(),
        )),
    };
    let about_middle = PoseSpace::at(grid.middle);
    let scale = |k: usize| if k < 3 { design.manipulator().size() } else { 1.0 };
    let in_slice = |pose: &Pose| {
        let x = about_middle.coordinates(pose);
        let fixed = (0..6).filter(|k| *k != across && *k != up).all(|k| x[k].abs() <= SAME * scale(k));
        let centre = grid.centre();
        let place = |k: usize, middle: f64| middle + if k < 3 { x[k] } else { x[k].to_degrees() };
        let at = (place(across, centre.0), place(up, centre.1));
        let shown = (at.0 - centre.0).abs() <= grid.half[0] && (at.1 - centre.1).abs() <= grid.half[1];
        (fixed && shown).then_some(at)
    };
    let ends = space.along_ranges(1);
    let poses = space.poses.iter().chain(&space.trajectory).chain(&ends).filter_map(in_slice).collect();
    Some(RequiredSection { outline, poses })
}

/// The section of the region through home: a rectangle, or an ellipse if both freedoms belong to one ellipsoid.
fn section_at_home(space: &PoseSpace, grid: &PoseGrid) -> Vec<(f64, f64)> {
    let [across, up] = grid.freedoms.places();
    let shown = |k: usize| if k < 3 { space.translation[k] } else { space.rotation_deg[k - 3] };
    let (a, b, home) = (shown(across), shown(up), grid.centre());
    let centre = (home.0 + space.middle[across], home.1 + space.middle[up]);
    let round = space.region == Region::Ellipsoid && (across < 3) == (up < 3);
    let corners: Vec<(f64, f64)> = if round {
        (0..ELLIPSE).map(|k| (std::f64::consts::TAU * k as f64 / ELLIPSE as f64).sin_cos()).collect()
    } else {
        vec![(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
    };
    corners.into_iter().map(|(s, t)| (centre.0 + a * s, centre.1 + b * t)).collect()
}

/// Positive inside the region; a freedom of width zero is inside only at home. The coordinates are those of
/// [`PoseSpace::coordinates`]. A face of a box that contains the slice does not bound it.
fn inside(space: &PoseSpace, slice: [usize; 2], x: &Vector6<f64>) -> f64 {
    let width = |k: usize| if k < 3 { space.translation[k] } else { space.rotation_deg[k - 3].to_radians() };
    let middle = |k: usize| if k < 3 { space.middle[k] } else { space.middle[k].to_radians() };
    let greatest = (0..6).map(width).fold(0.0, f64::max);
    let share = |k: usize| match width(k) {
        w if w > 0.0 => {
            let share = ((x[k] - middle(k)) / w).abs();
            let lies_in_face =
                space.region == Region::Box && !slice.contains(&k) && (share - 1.0).abs() <= SAME;
            if lies_in_face { 0.0 } else { share }
        }
        _ if x[k].abs() <= SAME * greatest => 0.0,
        _ => f64::MAX.sqrt(),
    };
    let norm = |range: std::ops::Range<usize>| match space.region {
        Region::Ellipsoid => range.map(|k| share(k).powi(2)).sum::<f64>().sqrt(),
        Region::Box => range.map(share).fold(0.0, f64::max),
    };
    1.0 - norm(0..3).max(norm(3..6))
}

fn notes(design: &Design, limits: &Limits<'_>) -> Vec<String> {
    let mut out = vec![
        "The other four coordinates are those of the marked pose. The colour shows the limit with the largest relative violation.".to_string(),
        "Evaluated at the points of the grid; nothing is proved between them.".to_string(),
    ];
    if !limits.checks_singularity() {
        out.push("Home is singular: singular poses are not shown as a limit.".into());
    }
    if design.requirements() == machine::requirements::Requirements::default() {
        out.push(
            "The design has no limits of its own: give leg_length, base_cone_angle_deg .. in the table hardware.".into(),
        );
    }
    out
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::app::cli::freedoms::Freedoms;
    use machine::requirements::{CoordinateRange, TermKind};

    #[test]
    fn every_limit_has_its_colour() {
        let known = |code: &str| files::plot::LIMIT_FILLS.iter().any(|(c, _)| *c == code);
        let kinds = TermKind::ALL;
        assert!(
            kinds
                .into_iter()
                .map(LimitKind::Requirement)
                .chain([LimitKind::Singular])
                .all(|k| known(k.code()))
        );
        assert_eq!(kinds.len() + 1, files::plot::LIMIT_FILLS.len());
    }

    /// The zero line of the function for other poses is the section that is drawn at home.
    #[test]
    fn the_boundary_of_the_region_is_where_the_function_is_zero() {
        let middle = Pose { rotation: Rotation3::identity(), position: Vector3::new(5.0, 6.0, 7.0) };
        let space_of = |region: Region, translation: &[CoordinateRange; 3]| {
            let half_angles = [6.0, 12.0, 18.0].map(CoordinateRange::within);
            PoseSpace::at(middle).with_region(region, translation, &half_angles)
        };
        let about_home = [2.0, 3.0, 0.0].map(CoordinateRange::within);
        let to_one_side = [
            CoordinateRange { min: -1.0, max: 3.0 },
            CoordinateRange { min: 0.0, max: 2.0 },
            CoordinateRange::default(),
        ];
        for (region, travels) in
            [(Region::Box, about_home), (Region::Ellipsoid, about_home), (Region::Box, to_one_side)]
        {
            let space = space_of(region, &travels);
            for (slice, half) in [("x,y", [4.0, 4.0]), ("y,rz", [4.0, 30.0]), ("rx,ry", [20.0, 20.0])] {
                let freedoms = Freedoms::parse(slice).unwrap();
                let grid = PoseGrid { freedoms, middle, half, side: 3 };
                let (centre, places) = (grid.centre(), freedoms.places());
                for (a, b) in section_at_home(&space, &grid) {
                    for (share, sign) in [(0.98, 1.0), (1.02, -1.0)] {
                        let mut x = Vector6::zeros();
                        for (k, d) in places.into_iter().zip([a - centre.0, b - centre.1]) {
                            let at = space.middle[k] + share * (d - space.middle[k]);
                            x[k] = if k < 3 { at } else { at.to_radians() };
                        }
                        assert!(inside(&space, places, &x) * sign > 0.0, "{region:?} {slice} {a} {b}");
                    }
                }
            }
        }
        // no pose leaves a freedom of width zero
        let along_z = Vector6::ith(2, 0.1);
        assert!(inside(&space_of(Region::Box, &about_home), [0, 1], &along_z) < 0.0);
    }
}
