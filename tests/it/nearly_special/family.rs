//! Designs that rounding, or a small displacement, takes off a special one. As they are written they are platforms of
//! the general class. They have poses far out or close together, where the special design has none or multiple ones.

use equipod::methods::geom::{Pose, random_rotation};
use equipod::methods::manipulator::{Leg, Manipulator, SquaredLegLengths};
use equipod::methods::num::Rng;
use nalgebra::{Matrix3, Point3, Rotation3, Vector3};

/// The special design that a member is near.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    Congruent,
    Similar,
    Affine,
    SplitJoints,
    SymmetricHexapod,
    GriffisDuffy,
}

pub(crate) const KINDS: [Kind; 6] = [
    Kind::Congruent,
    Kind::Similar,
    Kind::Affine,
    Kind::SplitJoints,
    Kind::SymmetricHexapod,
    Kind::GriffisDuffy,
];

/// A design with lengths of a real pose.
#[derive(Debug, Clone)]
pub(crate) struct Member {
    pub(crate) planar: bool,
    /// Distance of the joints from the special design, by its size.
    pub(crate) offset: f64,
    pub(crate) m: Manipulator,
    pub(crate) s: SquaredLegLengths,
    /// The pose the lengths were computed from, to rounding.
    pub(crate) pose: Pose,
}

fn normal(rng: &mut Rng) -> Vector3<f64> {
    Vector3::from_fn(|_, _| rng.normal())
}

/// Six joints, all in `z = 0` when `planar`.
fn hexagon(rng: &mut Rng, planar: bool) -> [Vector3<f64>; 6] {
    std::array::from_fn(|_| {
        let v = normal(rng);
        if planar { Vector3::new(v.x, v.y, 0.0) } else { v }
    })
}

/// Ends of the sides of a semi-regular hexagon, angles in doubles as a user would compute them.
fn semi_regular(radius: f64, half: f64, turn: f64) -> [Vector3<f64>; 6] {
    std::array::from_fn(|i| {
        let third = (i / 2) as f64 * std::f64::consts::TAU / 3.0;
        let side = if i % 2 == 0 { -half } else { half };
        let angle = third + side + turn;
        Vector3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
    })
}

fn special(rng: &mut Rng, kind: Kind, planar: bool) -> [[Vector3<f64>; 6]; 2] {
    match kind {
        Kind::Congruent | Kind::Similar | Kind::Affine => {
            let base = hexagon(rng, planar);
            let map = match kind {
                Kind::Congruent => Matrix3::identity(),
                Kind::Similar => Matrix3::identity() * rng.uniform(0.3, 2.0),
                _ => Matrix3::from_fn(|_, _| rng.normal()) * 0.6,
            };
            [base, base.map(|v| map * v)]
        }
        Kind::SplitJoints => {
            let (a, b) = (hexagon(rng, planar), hexagon(rng, planar));
            // octahedral, or double joints of one body only
            let double = [0, 0, 1, 1, 2, 2];
            if rng.unit() < 0.6 {
                [[0, 1, 1, 2, 2, 0].map(|k| a[k]), double.map(|k| b[k])]
            } else {
                [a, double.map(|k| b[k])]
            }
        }
        Kind::SymmetricHexapod => {
            let (base, platform) = (rng.uniform(0.05, 0.5), rng.uniform(0.05, 0.5));
            let ratio = rng.uniform(0.3, 1.0);
            let top = semi_regular(ratio, std::f64::consts::FRAC_PI_3 - platform, 0.0);
            [semi_regular(1.0, base, 0.0), top]
        }
        Kind::GriffisDuffy => {
            let (a, b) = (hexagon(rng, planar), hexagon(rng, planar));
            let mut on = |p: Vector3<f64>, q: Vector3<f64>| p + (q - p) * rng.uniform(0.15, 0.4);
            let base = [a[0], on(a[0], a[1]), a[1], on(a[1], a[2]), a[2], on(a[2], a[0])];
            let platform = [on(b[0], b[1]), b[1], on(b[1], b[2]), b[2], on(b[2], b[0]), b[0]];
            [base, platform]
        }
    }
}

/// Member `k` of the family that `seed` draws.
pub(crate) fn member(kind: Kind, seed: u64, k: u64) -> Option<Member> {
    let rng = &mut Rng::stream(seed, k);
    let planar = rng.unit() < 0.4;
    let [base, platform] = special(rng, kind, planar);
    let offset = match kind {
        Kind::SplitJoints => 10f64.powf(rng.uniform(-13.0, -6.0)),
        Kind::SymmetricHexapod | Kind::GriffisDuffy => 0.0,
        _ => 10f64.powf(rng.uniform(-12.0, -4.0)),
    };
    // some displacements leave the planes, some do not
    let flat = planar && rng.unit() < 0.5;
    let mut moved = |v: Vector3<f64>| {
        let d = normal(rng);
        let d = if flat { Vector3::new(d.x, d.y, 0.0) } else { d };
        Point3::from(if offset > 0.0 { v + d * offset } else { v })
    };
    let base = base.map(&mut moved);
    let platform = platform.map(&mut moved);
    let m =
        Manipulator::from_legs(std::array::from_fn(|i| Leg { base: base[i], platform: platform[i] })).ok()?;
    let pose = match rng.next_u64() % 3 {
        // at home: the platform over the base, turned little or not at all
        0 => {
            let small = if rng.unit() < 0.5 { offset } else { 1e-2 };
            let rotation = Rotation3::new(normal(rng) * small);
            Pose { rotation, position: Vector3::new(0.0, 0.0, rng.uniform(1.0, 2.0)) + normal(rng) * small }
        }
        _ => Pose { rotation: random_rotation(rng), position: normal(rng) * 1.2 },
    };
    let s = pose.squared_lengths(&m)?;
    Some(Member { planar, offset, m, s, pose })
}
