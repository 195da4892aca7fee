//! Joints, and a manipulator with its joints off their places.

use nalgebra::Vector3;

use platform::manipulator::{Body, InvalidManipulator, Manipulator};

/// A joint that carries legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Joint {
    /// The body it sits on.
    pub body: Body,
    /// Its index among the joints of the body.
    pub index: usize,
}

/// The joints that carry legs: those of the base by index, then those of the platform.
///
/// A shared joint is one joint with one error, whatever the number of its legs.
#[must_use]
pub fn joints(m: &Manipulator) -> Vec<Joint> {
    let pairs = m.pairs();
    let used = |j: &Joint| pairs.iter().any(|p| j.body.of(*p) == j.index);
    let all = |body| (0..m.joints(body).len()).map(move |index| Joint { body, index });
    Body::BOTH.into_iter().flat_map(all).filter(used).collect()
}

/// The manipulator with joint `k` of [`joints`] moved by `errors[k]`, in the frame of its body.
///
/// # Errors
/// When an error is not finite; see [`InvalidManipulator`].
pub fn displaced(m: &Manipulator, errors: &[Vector3<f64>]) -> Result<Manipulator, InvalidManipulator> {
    let (mut base, mut platform) = (m.base_joints().to_vec(), m.platform_joints().to_vec());
    for (joint, error) in joints(m).iter().zip(errors) {
        joint.body.of((&mut base, &mut platform))[joint.index] += error;
    }
    Manipulator::try_new(base, platform, m.pairs())
}
