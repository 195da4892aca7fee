//! Five legs: the line that they hold, its poses for given lengths, its singular poses, and the sixth legs that
//! decouple.

use files::design::FiveLegs;
use fk::{LineClass, LinePoses, NoLinePoses, count_line_poses, line_class, line_poses};
use platform::pentapod::LinearPentapod;
use synthesis::{DecouplingLeg, LineLocus, independent_somewhere};

/// The legs hold a line of one body.
#[derive(Debug, Clone)]
pub struct HeldLine {
    /// The line.
    pub line: LinearPentapod,
    /// The type of equation for its poses; `None` if the legs are dependent.
    pub class: Option<LineClass>,
    /// Number of poses of the line, real and complex, for lengths drawn from the seed; `None` if not counted.
    pub generic_poses: Option<usize>,
    /// The singular poses of the line.
    pub locus: LineLocus,
}

/// The answer about a design of five legs.
#[derive(Debug, Clone)]
pub struct PentapodReport {
    /// The design.
    pub design: FiveLegs,
    /// The line that the legs hold; `None` if no body has all its joints on one.
    pub held: Option<HeldLine>,
    /// Whether the five legs are dependent at every pose, decided exactly if they hold a line. Otherwise a pose proves
    /// `Some(false)`, and `None` means that no such pose was found.
    pub architecturally_singular: Option<bool>,
    /// Sixth legs that make the platform solvable in steps.
    pub sixth_legs: Vec<DecouplingLeg>,
    /// The given lengths.
    pub lengths: Option<[f64; 5]>,
    /// The poses of the line for the given lengths.
    pub poses: Option<Result<LinePoses, NoLinePoses>>,
}

impl PentapodReport {
    /// Why lengths have no list of poses; `None` where the legs hold a line.
    #[must_use]
    pub fn without_line(&self) -> Option<String> {
        self.held.is_none().then(|| {
            format!(
                "{}: no body has all its joints on a line, so that the poses for five lengths are a curve",
                self.design.name
            )
        })
    }
}

/// The line that five legs hold and, for given lengths, all its poses.
///
/// ```
/// use equipod::methods::design::{Format, parse_five_legs};
/// use equipod::methods::pentapod::about_five_legs;
/// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
/// let text = std::fs::read_to_string("designs/pentapods/line-plane.toml")?;
/// let (design, _) = parse_five_legs(&text, Format::Toml).ok_or("other legs")?.map_err(|why| why[0].to_string())?;
/// let report = about_five_legs(&design, design.lengths, 1);
/// assert_eq!(report.architecturally_singular, Some(false));
/// let poses = report.poses.ok_or("no lengths")??;
/// assert_eq!((poses.counted, poses.poses.iter().filter(|pose| pose.real).count()), (8, 4));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn about_five_legs(design: &FiveLegs, lengths: Option<[f64; 5]>, seed: u64) -> PentapodReport {
    let p = &design.pentapod;
    let held = p.linear().map(|line| HeldLine {
        class: line_class(&line),
        generic_poses: count_line_poses(&line, seed).ok(),
        locus: LineLocus::of(&line),
        line,
    });
    let architecturally_singular = match &held {
        Some(held) => Some(held.locus.everywhere),
        None => independent_somewhere(p, seed).then_some(false),
    };
    let poses = held.as_ref().zip(lengths).map(|(held, lengths)| line_poses(&held.line, &lengths));
    PentapodReport {
        design: design.clone(),
        held,
        architecturally_singular,
        sixth_legs: DecouplingLeg::all(p),
        lengths,
        poses,
    }
}
