//! All pairs of rotations that can map one centred span of leg vectors to another.
//!
//! The span determines axes of each body.
//!
//! Symmetric 3 x 3 matrices formed from the projector on the span rotate with the body. Their common principal axes are
//! the axes. If two principal values agree, an angle about the third axis is open; if all three agree, the whole
//! rotation is open.
//!
//! Gauss-Newton steps refine a pair of rigid motions until the moved legs lie in the span or cannot come nearer.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Matrix3, Point3, Rotation3, SMatrix, Vector3};

use super::leg_space::LegSpace;
use crate::components::spectrum::{Spectrum, dot, norm, unit};
use crate::leg_vector::leg_vector;
use num::Rng;
use num::linalg::{LinalgError, svd};
use num::small::symmetric_eigen3;
use platform::geom::{Pose, nearest_rotation, random_rotation};
use platform::manipulator::Leg;

/// Projector on a span, entry `(4 i + j, 4 k + l)`.
pub(super) type Projector = SMatrix<f64, 16, 16>;

/// Principal values closer than this (relative to the largest) count as equal. Two values that differ by less leave an
/// angle open. Other parts of the projector decide it, so nothing is lost.
const EQUAL: f64 = 1e-7;

/// The rotations of a body that keep its principal axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Freedom {
    /// Half turns about the three axes.
    HalfTurns,
    /// Rotations about the third axis, and half turns about axes across it.
    Axis,
    /// All rotations.
    All,
}

/// Right-handed axes (columns), and the principal values in falling order.
#[derive(Debug, Clone, Copy)]
pub(super) struct Axes {
    pub(super) frame: Matrix3<f64>,
    pub(super) values: Vector3<f64>,
    /// Whether neighbouring principal values, in falling order, count as equal.
    equal: [bool; 2],
}

impl Axes {
    /// The axes of the base. `equal` tells which principal values count as equal, for the second of two compared
    /// designs.
    pub(super) fn of_base(p: &Projector, equal: Option<[bool; 2]>) -> Self {
        Self::of(|i, j, k, l| p[(4 * i + j, 4 * k + l)], equal)
    }

    /// The axes of the platform.
    pub(super) fn of_platform(p: &Projector, equal: Option<[bool; 2]>) -> Self {
        Self::of(|i, j, k, l| p[(4 * j + i, 4 * l + k)], equal)
    }

    /// The axes for `p(i, j, k, l)`, with `i, k` for the body of interest.
    fn of(p: impl Fn(usize, usize, usize, usize) -> f64, equal: Option<[bool; 2]>) -> Self {
        let (found, vectors) = symmetric_eigen3(&moments(&p));
        let mut order = [0, 1, 2];
        order.sort_by(|x, y| found[*y].total_cmp(&found[*x]));
        let values = order.map(|k| found[k]);
        let size = found.amax().max(f64::MIN_POSITIVE);
        let equal = equal.unwrap_or_else(|| [0, 1].map(|k| values[k] - values[k + 1] <= EQUAL * size));
        if equal == [false, true] {
            order.rotate_left(1); // the lone axis becomes the third
        }
        let mut frame = Matrix3::from_columns(&order.map(|k| vectors.column(k).into_owned()));
        if frame.determinant() < 0.0 {
            let third = -frame.column(2);
            frame.set_column(2, &third);
        }
        Self { frame, values: Vector3::from(values), equal }
    }

    /// The open rotations of the axes.
    pub(super) fn freedom(&self) -> Freedom {
        match self.equal {
            [false, false] => Freedom::HalfTurns,
            [true, true] => Freedom::All,
            _ => Freedom::Axis,
        }
    }
}

/// A symmetric matrix that rotates with the body. It is a sum of all available matrices with fixed unequal weights, so
/// that two principal values agree only by symmetry.
fn moments(p: &impl Fn(usize, usize, usize, usize) -> f64) -> Matrix3<f64> {
    let square = |m: Matrix3<f64>| m * m.transpose();
    let vector = |f: &dyn Fn(usize) -> f64| {
        let v = Vector3::from_fn(|i, _| f(i + 1));
        v * v.transpose()
    };
    let mut sum = Matrix3::from_fn(|i, k| p(i + 1, 0, k + 1, 0));
    sum += Matrix3::from_fn(|i, k| (1..4).map(|j| p(i + 1, j, k + 1, j)).sum::<f64>()) * 0.731;
    sum += vector(&|i| p(i, 0, 0, 0)) * 1.377;
    sum += vector(&|i| (1..4).map(|j| p(i, j, 0, j)).sum()) * 0.613;
    sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, 0, 0))) * 1.193;
    sum += square(Matrix3::from_fn(|i, j| p(i + 1, 0, 0, j + 1))) * 0.871;
    for k in 1..4 {
        sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, k, 0))) * 0.567;
        sum += square(Matrix3::from_fn(|i, j| p(i + 1, j + 1, 0, k))) * 1.531;
        for l in 1..4 {
            sum += square(Matrix3::from_fn(|i, m| p(i + 1, k, m + 1, l))) * 0.449;
        }
    }
    sum
}

/// Parts of the projector with a smaller norm count as zero.
const SILENT: f64 = 1e-10;
/// Least number of tried pairs of rotations for bodies without any axis.
const DRAWN: usize = 144;

/// A rotation of the base and one of the platform.
pub(super) type Turns = (Matrix3<f64>, Matrix3<f64>);

/// Candidates for the pair of rotations.
#[derive(Debug, Clone)]
pub(super) struct RotationCandidates {
    /// One of every connected family, if `complete`; starts for a search otherwise.
    pub(super) turns: Vec<Turns>,
    /// Whether the list has every pair of rotations that maps one span to the other, up to rotations that keep both
    /// spans.
    pub(super) complete: bool,
}

/// `(R (x) Q) P (R (x) Q)^T` with `R`, `Q` extended by `1` for the first coordinate.
pub(super) fn turned(p: &Projector, turns: &Turns) -> Projector {
    let wide = |m: &Matrix3<f64>, i: usize, j: usize| match (i, j) {
        (0, 0) => 1.0,
        (0, _) | (_, 0) => 0.0,
        _ => m[(i - 1, j - 1)],
    };
    let k: Projector = SMatrix::from_fn(|r, c| wide(&turns.0, r / 4, c / 4) * wide(&turns.1, r % 4, c % 4));
    k * p * k.transpose()
}

/// Candidates for rotations that map the span with projector `b` to that with projector `a`.
pub(super) fn candidates(a: &Projector, b: &Projector, seed: u64) -> RotationCandidates {
    let (base, platform) = (Axes::of_base(a, None), Axes::of_platform(a, None));
    let freedom = [base.freedom(), platform.freedom()];
    let in_a = (base.frame, platform.frame);
    let in_b = (Axes::of_base(b, Some(base.equal)).frame, Axes::of_platform(b, Some(platform.equal)).frame);
    let own = |p: &Projector, f: &Turns| turned(p, &(f.0.transpose(), f.1.transpose()));
    let (pa, pb) = (own(a, &in_a), own(b, &in_b));
    let mut turns = Vec::new();
    // enough rotations of a body without axes to reach DRAWN pairs
    let drawn = if freedom == [Freedom::All; 2] { 12 } else { DRAWN / 2 };
    for base in flips(freedom[0], drawn, seed) {
        for platform in flips(freedom[1], drawn, seed ^ 1) {
            let flipped = turned(&pb, &(base, platform));
            for (theta, phi) in angles(&pa, &flipped, freedom) {
                let about = |angle: f64| *Rotation3::from_axis_angle(&Vector3::z_axis(), angle).matrix();
                let base = in_a.0 * about(theta) * base * in_b.0.transpose();
                let platform = in_a.1 * about(phi) * platform * in_b.1.transpose();
                turns.push((base, platform));
            }
        }
    }
    RotationCandidates { turns, complete: !freedom.contains(&Freedom::All) }
}

/// Rotations among the axes, up to open rotations about the third.
fn flips(freedom: Freedom, drawn: usize, seed: u64) -> Vec<Matrix3<f64>> {
    let half = |x: f64, y: f64, z: f64| Matrix3::from_diagonal(&Vector3::new(x, y, z));
    match freedom {
        Freedom::HalfTurns => {
            vec![half(1.0, 1.0, 1.0), half(1.0, -1.0, -1.0), half(-1.0, 1.0, -1.0), half(-1.0, -1.0, 1.0)]
        }
        Freedom::Axis => vec![half(1.0, 1.0, 1.0), half(1.0, -1.0, -1.0)],
        Freedom::All => {
            let mut rng = Rng::new(seed);
            (0..drawn).map(|_| *random_rotation(&mut rng).matrix()).collect()
        }
    }
}

/// A part of the projector that rotates by `e^{i (m theta + n phi)}`: `(m, n)`, its norm in A, and the phase from B to
/// A.
#[derive(Debug, Clone, Copy)]
struct FourierPart {
    weight: (i32, i32),
    norm: f64,
    phase: f64,
}

/// Angles about the third axes of base and platform that map `b` to `a`; zero if the body has no open angle.
fn angles(a: &Projector, b: &Projector, freedom: [Freedom; 2]) -> Vec<(f64, f64)> {
    let mut parts = parts(a, b, freedom.map(|f| f == Freedom::Axis));
    parts.sort_by(|x, y| y.norm.total_cmp(&x.norm));
    let Some(&first) = parts.first() else { return vec![(0.0, 0.0)] };
    let across = |p: &&FourierPart| p.weight.0 * first.weight.1 != p.weight.1 * first.weight.0;
    match parts.iter().find(across) {
        Some(second) => crossings(&first, second),
        None => along(&first),
    }
}

/// All angles modulo a full turn with both phases.
fn crossings(x: &FourierPart, y: &FourierPart) -> Vec<(f64, f64)> {
    let det = x.weight.0 * y.weight.1 - x.weight.1 * y.weight.0;
    let mut found: Vec<(f64, f64)> = Vec::new();
    for k in 0..det.abs() {
        for l in 0..det.abs() {
            let (p, q) = (x.phase + TAU * f64::from(k), y.phase + TAU * f64::from(l));
            let theta = (f64::from(y.weight.1) * p - f64::from(x.weight.1) * q) / f64::from(det);
            let phi = (f64::from(x.weight.0) * q - f64::from(y.weight.0) * p) / f64::from(det);
            let same = |(t, f): &(f64, f64)| near(*t - theta) && near(*f - phi);
            if !found.iter().any(same) {
                found.push((theta, phi));
            }
        }
    }
    found
}

fn near(angle: f64) -> bool {
    (angle / TAU - (angle / TAU).round()).abs() < 1e-6
}

/// One pair of angles of every family `m theta + n phi = phase`: there are `gcd(m, n)` of them.
fn along(x: &FourierPart) -> Vec<(f64, f64)> {
    let (m, n) = x.weight;
    let families = gcd(m.unsigned_abs(), n.unsigned_abs());
    let angle = |k: u32| (x.phase + TAU * f64::from(k)) / f64::from(if m == 0 { n } else { m });
    (0..families).map(|k| if m == 0 { (0.0, angle(k)) } else { (angle(k), 0.0) }).collect()
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The parts of `a` that are not silent, with weights up to sign and not zero.
fn parts(a: &Projector, b: &Projector, open: [bool; 2]) -> Vec<FourierPart> {
    let (a, b) = (circular(a), circular(b));
    // coordinates (1, x + i y, x - i y, z) rotate by e^{0, i, -i, 0}
    let spin = |i: usize, open: bool| if open { [0, 1, -1, 0][i] } else { 0 };
    let weight = |r: usize, c: usize| {
        (spin(r / 4, open[0]) - spin(c / 4, open[0]), spin(r % 4, open[1]) - spin(c % 4, open[1]))
    };
    let mut found = Vec::new();
    for m in 0..=2 {
        for n in -2..=2 {
            if m == 0 && n <= 0 {
                continue;
            }
            let (mut norm, mut inner) = (0.0, Complex::new(0.0, 0.0));
            for r in 0..16 {
                for c in (0..16).filter(|c| weight(r, *c) == (m, n)) {
                    norm += a[(r, c)].norm_sqr();
                    inner += b[(r, c)].conj() * a[(r, c)];
                }
            }
            let norm = f64::sqrt(norm);
            if norm > SILENT {
                found.push(FourierPart { weight: (m, n), norm, phase: inner.arg() });
            }
        }
    }
    found
}

/// The projector in the coordinates `(1, (x + i y)/sqrt 2, (x - i y)/sqrt 2, z)` of both bodies.
fn circular(p: &Projector) -> DMatrix<Complex<f64>> {
    let h = std::f64::consts::FRAC_1_SQRT_2;
    let entry = |i: usize, j: usize| match (i, j) {
        (0, 0) | (3, 3) => Complex::new(1.0, 0.0),
        (1 | 2, 1) => Complex::new(h, 0.0),
        (1, 2) => Complex::new(0.0, h),
        (2, 2) => Complex::new(0.0, -h),
        _ => Complex::new(0.0, 0.0),
    };
    let k = DMatrix::from_fn(16, 16, |r, c| entry(r / 4, c / 4) * entry(r % 4, c % 4));
    let p = DMatrix::from_fn(16, 16, |r, c| Complex::new(p[(r, c)], 0.0));
    &k * p * k.adjoint()
}

/// Most Gauss-Newton steps.
const STEPS: usize = 40;
/// Singular values of the Jacobian below this times the largest belong to motions that keep the span.
const FREE: f64 = 1e-7;

/// A pair of motions of centred, normalised coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct MotionPair {
    pub(super) base: Pose,
    pub(super) platform: Pose,
    /// Number of dimensions in which the motions can vary without first-order change.
    pub(super) freedom: usize,
}

/// Improves the pair of rotations `turns`, with translations, so that the moved `legs` come near `space`.
pub(super) fn refine(space: &LegSpace, legs: &[Leg; 6], turns: &Turns) -> Result<MotionPair, LinalgError> {
    let normals = Spectrum::of(&space.basis, 16)?.kernel(space.dimension()).to_vec();
    let still = |m: &Matrix3<f64>| Pose { rotation: nearest_rotation(m), position: Vector3::zeros() };
    let mut at = (still(&turns.0), still(&turns.1));
    let mut errors = residuals(&normals, legs, &at);
    let mut freedom = 12;
    for _ in 0..STEPS {
        let d = svd(&tangents(&normals, legs, &at))?;
        let open = d.s.iter().filter(|s| **s > FREE * d.s[0]).count();
        freedom = 12 - open;
        let mut step = vec![0.0; 12];
        for k in 0..open {
            let along: f64 = errors.iter().zip(&d.v).map(|(e, row)| e * row[k]).sum::<f64>() / d.s[k];
            step.iter_mut().zip(&d.u).for_each(|(x, row)| *x -= along * row[k]);
        }
        let Some(next) = descend(&normals, legs, &at, &step, norm(&errors)) else { break };
        at = next;
        errors = residuals(&normals, legs, &at);
    }
    Ok(MotionPair { base: at.0, platform: at.1, freedom })
}

/// The step, halved until it brings the legs nearer; `None` if it never does.
fn descend(
    normals: &[Vec<f64>],
    legs: &[Leg; 6],
    at: &(Pose, Pose),
    step: &[f64],
    best: f64,
) -> Option<(Pose, Pose)> {
    let mut factor = 1.0;
    for _ in 0..8 {
        let part = |k: usize| Vector3::new(step[k], step[k + 1], step[k + 2]) * factor;
        let next = (moved(&at.0, &part(0), &part(3)), moved(&at.1, &part(6), &part(9)));
        if norm(&residuals(normals, legs, &next)) < best {
            return Some(next);
        }
        factor *= 0.5;
    }
    None
}

/// `x -> exp([w]x) (R x + p) + u`.
fn moved(pose: &Pose, turn: &Vector3<f64>, shift: &Vector3<f64>) -> Pose {
    let turn = Rotation3::new(*turn);
    Pose { rotation: turn * pose.rotation, position: turn * pose.position + shift }
}

fn image(leg: &Leg, at: &(Pose, Pose)) -> Leg {
    Leg { base: at.0.transform(&leg.base), platform: at.1.transform(&leg.platform) }
}

/// Components of the moved leg vectors, of unit length, along the normals of the span.
fn residuals(normals: &[Vec<f64>], legs: &[Leg; 6], at: &(Pose, Pose)) -> Vec<f64> {
    let vectors = legs.iter().map(|leg| unit(&leg_vector(&image(leg, at))));
    vectors.flat_map(|v| normals.iter().map(|n| dot(n, &v)).collect::<Vec<_>>()).collect()
}

/// Derivatives of [`residuals`], one list each: by rotation and shift of the base, then of the platform. The length of
/// a leg vector is taken as constant, which is exact where the residuals vanish.
fn tangents(normals: &[Vec<f64>], legs: &[Leg; 6], at: &(Pose, Pose)) -> Vec<Vec<f64>> {
    let moves: Vec<(usize, bool, Vector3<f64>)> = (0..12)
        .map(|k| {
            let axis = Vector3::from_fn(|i, _| if i == k % 3 { 1.0 } else { 0.0 });
            (k / 6, (k / 3) % 2 == 0, axis)
        })
        .collect();
    let column = |(body, turn, axis): &(usize, bool, Vector3<f64>)| -> Vec<f64> {
        let one = |leg: &Leg| -> Vec<f64> {
            let leg = image(leg, at);
            let size = norm(&leg_vector(&leg));
            let v = velocity(&leg, *body, *turn, axis);
            normals.iter().map(|n| dot(n, &v) / size).collect()
        };
        legs.iter().flat_map(one).collect()
    };
    moves.iter().map(column).collect()
}

fn velocity(leg: &Leg, body: usize, turn: bool, axis: &Vector3<f64>) -> [f64; 16] {
    let along = |x: &Point3<f64>| if turn { axis.cross(&x.coords) } else { *axis };
    let place = |x: &Point3<f64>| [1.0, x.x, x.y, x.z];
    let speed = |x: &Point3<f64>| {
        let v = along(x);
        [0.0, v.x, v.y, v.z]
    };
    let (a, b) = match body {
        0 => (speed(&leg.base), place(&leg.platform)),
        _ => (place(&leg.base), speed(&leg.platform)),
    };
    std::array::from_fn(|k| a[k / 4] * b[k % 4])
}
