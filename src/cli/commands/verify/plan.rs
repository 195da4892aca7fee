//! Where the sample poses of a verification come from.

use nalgebra::Vector3;

use crate::cli::poses;
use crate::design::Design;
use crate::equivalence::SamplePlan;

/// Half width of the box of positions where the design has no workspace box, in sizes of the design.
const TRANSLATION: f64 = 0.25;
/// Half width of the box of rotation vectors where the design has no workspace box, degrees.
const ROTATION_DEG: f64 = 20.0;

/// Random poses in the workspace box of the design about its home pose; where it has neither, about the
/// default home pose, a quarter of the size and 20 degrees each way.
pub(crate) fn sample_plan(design: &Design, count: usize, seed: u64) -> SamplePlan {
    let m = design.manipulator();
    let home = poses::home(design);
    let (translation, rotation) = if design.workspace.has_box() {
        (design.workspace.translation, design.workspace.rotation_deg.map(f64::to_radians))
    } else {
        (Vector3::repeat(TRANSLATION * m.size()), Vector3::repeat(ROTATION_DEG.to_radians()))
    };
    SamplePlan { home, translation, rotation, count, seed }
}
