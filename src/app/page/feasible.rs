//! Violated requirements over two offsets of an equivalent platform, for all poses of the workspace.

use serde::Serialize;

use super::plane::square;
use super::request::Refusal;
use super::session::{Equivalent, Session};
use ask::Design;
use machine::requirements::{AssessOptions, Requirements, Terms, ViolationSearch};
use platform::geom::Pose;

/// The name for offsets that give no platform: some of its joints or legs coincide.
const NO_PLATFORM: &str = "joints coincide";

/// Requirements on a square of two offsets.
#[derive(Debug, Serialize)]
pub(super) struct FeasibleRecord {
    /// Number of points along each side.
    points: usize,
    low: f64,
    high: f64,
    /// Greatest number of poses of the workspace evaluated for each platform.
    poses: usize,
    /// Row by row, the first offset to the right: the name of one violated requirement; `null` if none is violated at
    /// these poses.
    violated: Vec<Option<&'static str>>,
}

fn requires_nothing(design: &Design, required: &Requirements, home: &Pose) -> bool {
    let terms = Terms::new(design.manipulator(), required, home);
    terms.fixed().is_empty() && terms.at(home).is_empty()
}

/// Requirements on a square of two offsets, at the poses that `assess` with these numbers evaluates before its
/// searches.
pub(super) fn record(
    session: &Session,
    e: &Equivalent,
    axes: [usize; 2],
    range: [f64; 2],
    points: usize,
    options: &AssessOptions,
) -> Result<FeasibleRecord, Refusal> {
    let place = square(axes, range, points)?;
    let space_of = |design: &Design| design.workspace.space(&design.home_or_default());
    let here = session.second(e)?.0;
    let required = here.requirements();
    if requires_nothing(&here, &required, &here.home_or_default()) {
        return Err(Refusal::new("nothing_required", "the design has no requirements"));
    }
    let mut search = ViolationSearch::new(&space_of(&here), options);
    let mut violated = Vec::with_capacity(points * points);
    for row in 0..points {
        for column in 0..points {
            let there = e.moved(&[(axes[0], place(column)), (axes[1], place(row))])?;
            let Ok((design, _)) = session.second(&there) else {
                violated.push(Some(NO_PLATFORM));
                continue;
            };
            // without a home pose in the file, each platform has its own
            if *search.home() != design.home_or_default() {
                search = ViolationSearch::new(&space_of(&design), options);
            }
            let kind = search.violated(design.manipulator(), &design.requirements());
            violated.push(kind.map(machine::requirements::TermKind::label));
        }
    }
    Ok(FeasibleRecord { points, low: range[0], high: range[1], poses: search.poses(), violated })
}
