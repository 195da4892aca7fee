//! Random poses of every kind, with their distributions. `num::Purpose` defines their streams of the seed.
//!
//! | drawn by | rotation | position | how many |
//! |---|---|---|---|
//! | comparison of two platforms, roundings ([`SamplePlan`]) | rotation vector uniform in a box about home | uniform in a box about home | [`SamplePlan::count`] |
//! | trials of joint errors ([`PoseSpace::draw`]) | in the region of the workspace | likewise | as asked |
//! | requirements, tolerances, the search for a platform ([`PoseSpace::cube_points`]) | centre, corners, Halton points and random ones of the region | likewise | as asked |
//! | conditioning, lower bound of the distance to a singular design ([`CentredPoses`]) | uniform on SO(3) | middle of the platform within the size of the middle of the base | there |
//! | problems of `bench` ([`any_pose`]) | uniform on SO(3) | normal | one a problem |

use nalgebra::{Quaternion, Rotation3, UnitQuaternion, Vector3, Vector6};

use super::{Pose, PoseSpace};
use crate::manipulator::Manipulator;
use num::{Purpose, Rng};

/// Half width of the box of positions without a workspace, in sizes of the manipulator.
const TRANSLATION: f64 = 0.25;
/// Half width of the box of rotation vectors without a workspace, degrees.
const ROTATION_DEG: f64 = 20.0;

/// A rotation uniform on SO(3).
pub fn random_rotation(rng: &mut Rng) -> Rotation3<f64> {
    loop {
        let q = Quaternion::new(rng.normal(), rng.normal(), rng.normal(), rng.normal());
        if q.norm() > 1e-6 {
            return UnitQuaternion::from_quaternion(q).to_rotation_matrix();
        }
    }
}

/// A uniform rotation, and a position with normal coordinates of variance one.
pub fn any_pose(rng: &mut Rng) -> Pose {
    let rotation = random_rotation(rng);
    Pose { rotation, position: Vector3::from_fn(|_, _| rng.normal()) }
}

/// Poses of a manipulator by the offset between the centroids of the leg ends on platform and base.
#[derive(Debug, Clone, Copy)]
pub struct CentredPoses {
    base: Vector3<f64>,
    platform: Vector3<f64>,
    size: f64,
}

impl CentredPoses {
    /// For the centroids of the leg ends and the size of a platform.
    pub fn new(m: &Manipulator) -> Self {
        let [base, platform] = m.mean_leg_ends();
        Self { base, platform, size: m.size() }
    }

    /// The pose that rotates the platform about its centroid and moves the centroid to `offset` from that of the base.
    pub fn pose(&self, rotation: Rotation3<f64>, offset: Vector3<f64>) -> Pose {
        Pose { rotation, position: self.base + offset - rotation * self.platform }
    }

    /// A uniform rotation, and an offset with coordinates uniform within the size.
    pub fn draw(&self, rng: &mut Rng) -> (Rotation3<f64>, Vector3<f64>) {
        let rotation = random_rotation(rng);
        (rotation, Vector3::from_fn(|_, _| rng.uniform(-self.size, self.size)))
    }
}

impl PoseSpace {
    /// A random pose of the space: in the region, or one of the listed poses if there is no region.
    pub fn draw(&self, listed: &[Pose], rng: &mut Rng) -> Pose {
        if self.axes().is_empty() && !listed.is_empty() {
            return listed[(rng.next_u64() % listed.len() as u64) as usize];
        }
        self.pose(&Vector6::from_fn(|_, _| rng.uniform(-1.0, 1.0)))
    }
}

/// Random poses about a home pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SamplePlan {
    /// Centre of the poses.
    pub home: Pose,
    /// Half widths of the position box, design units.
    pub translation: Vector3<f64>,
    /// Half widths of the rotation-vector box, radians.
    pub rotation: Vector3<f64>,
    /// Number of poses; without any, a comparison is inconclusive unless the map alone decides.
    pub count: usize,
    /// Seed; pose `k` depends only on the seed and `k`.
    pub seed: u64,
}

impl SamplePlan {
    /// Poses in the box of the given half widths (design units, degrees) about home. If all of them are zero, they are
    /// a quarter of the size and 20 degrees.
    #[must_use]
    pub fn about(
        m: &Manipulator,
        home: Pose,
        (translation, rotation_deg): (Vector3<f64>, Vector3<f64>),
        (count, seed): (usize, u64),
    ) -> Self {
        let given = translation.iter().chain(rotation_deg.iter()).any(|width| *width > 0.0);
        let (translation, rotation_deg) = if given {
            (translation, rotation_deg)
        } else {
            (Vector3::repeat(TRANSLATION * m.size()), Vector3::repeat(ROTATION_DEG))
        };
        Self { home, translation, rotation: rotation_deg.map(f64::to_radians), count, seed }
    }

    /// Pose number `k`: `p = home + d`, `R = exp([w]x) R_home`, `d` and `w` uniform in their boxes.
    #[must_use]
    pub fn pose(&self, k: usize) -> Pose {
        let mut rng = Purpose::COMPARED_POSES.item(self.seed, k as u64);
        let mut draw = |half: &Vector3<f64>| half.map(|h| rng.uniform(-h, h));
        let (d, w) = (draw(&self.translation), draw(&self.rotation));
        Pose { rotation: Rotation3::new(w) * self.home.rotation, position: self.home.position + d }
    }
}
