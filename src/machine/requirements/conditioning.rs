//! The least conditioning over a workspace.

use super::{AssessOptions, PoseSpace};
use num::Purpose;
use platform::geom::Pose;
use platform::manipulator::{Manipulator, inverse_condition, jacobian};

/// The worst conditioning of the Jacobian among the sampled poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastConditioning {
    /// `sigma_min / sigma_max` of the Jacobian with unit lines, moments divided by the characteristic length: 1 at
    /// best, 0 at a singular pose.
    pub value: f64,
    /// The pose.
    pub pose: Pose,
}

/// The least inverse condition number over the poses that [`assess`](super::assess()) examines first: home, those
/// listed, and points of the region. Poses between the sampled ones may have a smaller value, and so may those that
/// [`AssessOptions::until`] leaves out.
#[must_use]
pub fn least_conditioning(
    m: &Manipulator,
    space: &PoseSpace,
    o: &AssessOptions,
    characteristic_length: f64,
) -> LeastConditioning {
    least_over(space, o, |pose| inverse_condition(&jacobian(m, pose, characteristic_length)))
}

/// The least value of a function over these poses.
pub(super) fn least_over(
    space: &PoseSpace,
    o: &AssessOptions,
    number: impl Fn(&Pose) -> f64,
) -> LeastConditioning {
    let mut rng = Purpose::ASSESSED_POSES.rng(o.seed);
    let at = |pose: Pose| LeastConditioning { value: number(&pose), pose };
    let points = space.cube_points(o.points, &mut rng).into_iter().map(|x| space.pose(&x));
    let in_time = |_: &Pose| !o.is_late();
    let all = space.listed(o.steps).into_iter().chain(points).take_while(in_time).map(at);
    all.fold(at(space.home), |least, next| if next.value < least.value { next } else { least })
}
