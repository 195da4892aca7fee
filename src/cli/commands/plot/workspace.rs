//! `equipod plot workspace`.

use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::failure::Failure;
use crate::cli::freedoms::{Freedoms, PoseGrid};
use crate::cli::numbers;
use crate::cli::poses;
use crate::design::Design;
use crate::plot::{WorkspaceFigure, workspace_slice};
use crate::requirements::{Limit, Limits};

/// Rotations shown each way where neither option nor design says more, degrees.
const DEGREES: f64 = 90.0;

/// Arguments of `plot workspace`.
#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Design file (.toml or .json) with its limits in the table hardware
    design: PathBuf,
    /// Two freedoms on the axes: x, y, z (reachable positions at a fixed orientation), rx, ry, rz (reachable orientations at a position; rotation
    /// vector in the base frame)
    #[arg(long, value_name = "A,B", default_value = "x,y", value_parser = Freedoms::parse)]
    slice: Freedoms,
    /// Pose in the middle of the picture, which fixes the other four freedoms; the legs are mounted for the home pose of the design
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Half widths of the picture, design units or degrees; the size of the design and 90 degrees when absent
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

pub(super) fn draw(args: &Args, context: &mut Context) -> Result<String, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let pose = poses::parse(&args.pose, &design, "--pose", "plot::bad_pose")?;
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
    // what ends the workspace somewhere in the picture, in the order of the kinds
    let missed = found.iter().filter(|p| p.share.is_nan() || p.share <= 0.0).filter_map(|p| p.limit);
    let mut names: Vec<Kind> = missed.map(Kind::of).collect();
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
        worst: found.iter().map(|p| p.limit.and_then(|l| names.binary_search(&Kind::of(l)).ok())).collect(),
        limits: names.iter().map(|k| k.words()).collect(),
        home: (grid.centre(), if args.pose == "home" { "home".into() } else { "pose".into() }),
    }))
}

/// A kind of limit, whichever leg it is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Requirement(crate::requirements::TermKind),
    Singular,
}

impl Kind {
    fn of(limit: Limit) -> Self {
        match limit {
            Limit::Term(term) => Self::Requirement(term.kind),
            Limit::Singular => Self::Singular,
        }
    }

    fn words(self) -> String {
        match self {
            Self::Requirement(kind) => kind.code().replace('_', " "),
            Self::Singular => "beyond a singular pose".into(),
        }
    }
}

fn notes(design: &Design, limits: &Limits<'_>) -> Vec<String> {
    let mut out = vec![
        "The other four freedoms are those of the marked pose. Of several limits the one missed by the largest share gives the colour.".to_string(),
        "Evaluated at the points of the grid; nothing is proved between them.".to_string(),
    ];
    if !limits.judges_singularity() {
        out.push("Home is singular: singular poses are not shown as a limit.".into());
    }
    if design.requirements() == crate::requirements::Requirements::default() {
        out.push(
            "The design has no limits of its own: give leg_length, swing .. in the table hardware.".into(),
        );
    }
    out
}
