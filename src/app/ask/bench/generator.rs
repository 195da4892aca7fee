//! Problem `k` of a class: joints, lengths and the pose behind the lengths, if there is one.

use nalgebra::{Point3, Rotation3, Vector3};
use thiserror::Error;

use super::exact_members::{self, ExactMember};
use super::singular::{close_pair, double_root};
use super::{Class, Planar};
use num::Rng;
use platform::geom::{Pose, any_pose};
use platform::manipulator::{InvalidManipulator, Leg, Manipulator, SquaredLegLengths};
use platform::topology::NamedTopology;

num::words! {
    /// The source of the leg lengths.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[cfg_attr(
        feature = "files",
        derive(serde::Serialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum LengthsFrom as name {
        /// A random real pose: rotation uniform, position standard normal.
        Pose = "pose",
        /// Squared lengths uniform in `[0.5, 3]` (Martyushev, sec. 5.1).
        Uniform = "uniform",
    }
}

/// One problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Problem {
    /// The platform.
    pub manipulator: Manipulator,
    /// Squared leg lengths.
    pub squares: SquaredLegLengths,
    /// The pose behind the lengths; it solves the problem up to the rounding of the lengths.
    pub pose: Option<Pose>,
}

impl Problem {
    /// The problem with joints that are rounded to so many digits behind the point, and lengths of the same pose.
    ///
    /// # Errors
    /// [`NotDrawn`] where rounding leaves no manipulator.
    pub(super) fn rounded(self, digits: u32) -> Result<Self, NotDrawn> {
        let scale = 10f64.powi(i32::try_from(digits).unwrap_or(i32::MAX));
        let round = |x: f64| {
            let scaled = (x * scale).round();
            // doubles of order one have 16 digits
            if scaled.abs() < 1.0 / f64::EPSILON { scaled / scale } else { x }
        };
        let legs = self
            .manipulator
            .legs()
            .map(|leg| Leg { base: leg.base.map(round), platform: leg.platform.map(round) });
        let manipulator = Manipulator::from_legs(legs)?;
        match self.pose {
            Some(pose) => at_pose(manipulator, pose),
            None => Ok(Self { manipulator, ..self }),
        }
    }
}

/// The reason why a problem could not be drawn.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotDrawn {
    /// The joints make no manipulator.
    #[error(transparent)]
    Joints(#[from] InvalidManipulator),
    /// The leg lengths at the pose are not finite.
    #[error("the leg lengths of the pose are not finite")]
    Lengths,
    /// No leg in the drawn direction has a length.
    #[error("the drawn legs have no length")]
    NoLeg,
    /// A coordinate has too many digits to be exact.
    #[error("the exact coordinates of the joints are too long")]
    TooLong,
    /// The class needs a real pose.
    #[error("the class {0} takes its lengths from real poses")]
    NeedsPose(Class),
}

/// Draws problem `k` of `class`; it depends on `seed`, `class`, `lengths` and `k` only.
///
/// Joints lie in `[-2, 2]^3`, and planar bodies in `z = 0`. The first joint of each body is at the origin for the
/// classes of Martyushev. [`Class::Hexapod`] is drawn about its home pose. [`Class::ClosePair`] starts from a singular
/// pose with squared lengths `1e-12` off it, and [`Class::DoubleRoot`] exactly at one. [`Class::Spread`] has leg
/// lengths spaced evenly by ratio between `10^-1.5` and `10^1.5`.
///
/// # Errors
/// [`NotDrawn`]; in practice only [`NotDrawn::NeedsPose`].
pub fn problem(class: Class, lengths: LengthsFrom, seed: u64, k: u64) -> Result<Problem, NotDrawn> {
    if lengths == LengthsFrom::Uniform && !class.allows_uniform_lengths() {
        return Err(NotDrawn::NeedsPose(class));
    }
    let mut rng = Rng::stream(seed ^ class.stream(), k);
    let rng = &mut rng;
    match class {
        Class::ClosePair => return close_pair(rng),
        Class::Spread => return spread(rng),
        Class::DoubleRoot => return double_root(rng),
        Class::Hexapod => return hexapod(rng, 1.0),
        Class::HexapodHome => return hexapod(rng, 0.0),
        _ => {}
    }
    let manipulator = match class {
        Class::Topology { topology, planar } => sharing(topology, planar, rng)?,
        Class::GriffisDuffy => exact(exact_members::griffis_duffy(rng))?,
        Class::Similar => exact(exact_members::images(rng, exact_members::scaling))?,
        Class::Congruent => exact(exact_members::images(rng, |_| exact_members::identity()))?,
        Class::Affine => exact(exact_members::images(rng, exact_members::linear))?,
        Class::Collinear => exact(exact_members::collinear(rng))?,
        _ => Manipulator::from_legs(joints(class, rng))?,
    };
    match lengths {
        LengthsFrom::Pose => at_pose(manipulator, any_pose(rng)),
        LengthsFrom::Uniform => {
            let squares = std::array::from_fn(|_| rng.uniform(0.5, 3.0));
            let squares = SquaredLegLengths::try_new(squares).map_err(|_| NotDrawn::Lengths)?;
            Ok(Problem { manipulator, squares, pose: None })
        }
    }
}

/// The platform of exact legs.
fn exact(legs: ExactMember) -> Result<Manipulator, NotDrawn> {
    Ok(Manipulator::from_exact_ends(&legs.ok_or(NotDrawn::TooLong)?)?)
}

/// A random member of a topology, with all its joints in use.
fn sharing(t: NamedTopology, planar: Planar, rng: &mut Rng) -> Result<Manipulator, InvalidManipulator> {
    let t = t.topology();
    let mut points = |n: usize, flat: bool| (0..n).map(|_| point(rng, flat)).collect::<Vec<_>>();
    let base = points(t.base_joints(), matches!(planar, Planar::Base | Planar::Both));
    let platform = points(t.platform_joints(), matches!(planar, Planar::Platform | Planar::Both));
    Manipulator::try_new(base, platform, t.legs())
}

fn at_pose(manipulator: Manipulator, pose: Pose) -> Result<Problem, NotDrawn> {
    let squares = pose.squared_lengths(&manipulator).ok_or(NotDrawn::Lengths)?;
    Ok(Problem { manipulator, squares, pose: Some(pose) })
}

/// A point of `[-2, 2]^3`, or of the same square in `z = 0`.
fn point(rng: &mut Rng, planar: bool) -> Point3<f64> {
    let (x, y) = (rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0));
    Point3::new(x, y, if planar { 0.0 } else { rng.uniform(-2.0, 2.0) })
}

/// Six joints, the first at the origin.
pub(super) fn body(rng: &mut Rng, planar: bool) -> [Point3<f64>; 6] {
    std::array::from_fn(|i| if i == 0 { Point3::origin() } else { point(rng, planar) })
}

pub(super) fn legs(base: [Point3<f64>; 6], platform: [Point3<f64>; 6]) -> [Leg; 6] {
    std::array::from_fn(|i| Leg { base: base[i], platform: platform[i] })
}

fn joints(class: Class, rng: &mut Rng) -> [Leg; 6] {
    match class {
        // classes with their own generator are drawn elsewhere
        Class::General
        | Class::ClosePair
        | Class::Spread
        | Class::DoubleRoot
        | Class::Hexapod
        | Class::HexapodHome
        | Class::GriffisDuffy
        | Class::Similar
        | Class::Congruent
        | Class::Affine
        | Class::Collinear
        | Class::Topology { .. } => legs(body(rng, false), body(rng, false)),
        Class::SharedPlatformJoint => {
            let (base, mut platform) = (body(rng, false), body(rng, false));
            platform[5] = platform[4];
            legs(base, platform)
        }
        Class::PlanarBase => legs(body(rng, true), body(rng, false)),
        Class::BothPlanar => legs(body(rng, true), body(rng, true)),
        Class::AlmostPlanar => {
            let (mut base, mut platform) = (body(rng, true), body(rng, true));
            let lifted = if rng.uniform(0.0, 1.0) < 0.5 { &mut base } else { &mut platform };
            lifted[(rng.next_u64() % 6) as usize].z = rng.uniform(-2.0, 2.0);
            legs(base, platform)
        }
        Class::TiltedPlanes => {
            let (base, platform) = (body(rng, true), body(rng, true));
            let mut tilt = |joints: [Point3<f64>; 6]| {
                let motion = any_pose(rng);
                joints.map(|p| motion.transform(&p))
            };
            legs(tilt(base), tilt(platform))
        }
        Class::Octahedral => {
            let mut triangle = || [(); 3].map(|()| point(rng, false));
            let (b, p) = (triangle(), triangle());
            let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
            pairs.map(|(i, j)| Leg { base: b[i], platform: p[j] })
        }
    }
}

/// Pairs of joints on circles, threefold symmetric, with base pairs between platform pairs. The pose is off home by at
/// most `off` times 20 degrees and a fifth of the base radius.
fn hexapod(rng: &mut Rng, off: f64) -> Result<Problem, NotDrawn> {
    let manipulator = exact(exact_members::hexapod(rng))?;
    let axis = nalgebra::Unit::new_normalize(Vector3::from_fn(|_, _| rng.normal()));
    let rotation = Rotation3::from_axis_angle(&axis, off * rng.uniform(0.0, 20.0).to_radians());
    let height = Vector3::new(0.0, 0.0, rng.uniform(0.8, 1.4));
    let position = height + Vector3::from_fn(|_, _| off * rng.uniform(-0.2, 0.2));
    at_pose(manipulator, Pose { rotation, position })
}

fn spread(rng: &mut Rng) -> Result<Problem, NotDrawn> {
    let platform = body(rng, false);
    let pose = any_pose(rng);
    let legs = std::array::from_fn(|i| {
        let direction = Vector3::from_fn(|_, _| rng.normal()).normalize();
        let length = 10f64.powf(-1.5 + 0.6 * i as f64);
        Leg { base: pose.transform(&platform[i]) - direction * length, platform: platform[i] }
    });
    at_pose(Manipulator::from_legs(legs)?, pose)
}
