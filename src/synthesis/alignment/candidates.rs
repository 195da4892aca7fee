//! All pairs of rotations that can take one centred span of leg vectors to another.

use std::f64::consts::TAU;

use nalgebra::{Complex, DMatrix, Matrix3, Rotation3, SMatrix, Vector3};

use super::axes::{Axes, Freedom, Projector};
use crate::geom::random_rotation;
use crate::num::Rng;

/// Parts of the projector with a smaller norm count as zero.
const SILENT: f64 = 1e-10;
/// Pairs of rotations tried at least for bodies without any axis.
const DRAWN: usize = 144;

/// A rotation of the base and one of the platform.
pub(super) type Turns = (Matrix3<f64>, Matrix3<f64>);

/// Candidates for the pair of rotations.
#[derive(Debug, Clone)]
pub(super) struct Candidates {
    /// One of every connected family, if `complete`; starts for a search otherwise.
    pub(super) turns: Vec<Turns>,
    /// Every pair of rotations that maps the one span to the other is in the list, up to rotations that keep both spans.
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

/// What takes the span with projector `b` to the span with projector `a`.
pub(super) fn candidates(a: &Projector, b: &Projector, seed: u64) -> Candidates {
    let (base, platform) = (Axes::of_base(a, None), Axes::of_platform(a, None));
    let freedom = [base.freedom(), platform.freedom()];
    let in_a = (base.frame, platform.frame);
    let in_b = (Axes::of_base(b, Some(base.equal)).frame, Axes::of_platform(b, Some(platform.equal)).frame);
    let own = |p: &Projector, f: &Turns| turned(p, &(f.0.transpose(), f.1.transpose()));
    let (pa, pb) = (own(a, &in_a), own(b, &in_b));
    let mut turns = Vec::new();
    // as many rotations of a body without axes as make the pairs come to DRAWN
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
    Candidates { turns, complete: !freedom.contains(&Freedom::All) }
}

/// Rotations among the axes, up to those about the third where these are left open.
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

/// A part of the projector that turns by `e^{i (m theta + n phi)}`: `(m, n)`, its norm in A, the phase that takes B to A.
#[derive(Debug, Clone, Copy)]
struct Part {
    weight: (i32, i32),
    norm: f64,
    phase: f64,
}

/// Angles about the third axes of base and platform that take `b` to `a`; zero where the body has no angle open.
fn angles(a: &Projector, b: &Projector, freedom: [Freedom; 2]) -> Vec<(f64, f64)> {
    let mut parts = parts(a, b, freedom.map(|f| f == Freedom::Axis));
    parts.sort_by(|x, y| y.norm.total_cmp(&x.norm));
    let Some(&first) = parts.first() else { return vec![(0.0, 0.0)] };
    let across = |p: &&Part| p.weight.0 * first.weight.1 != p.weight.1 * first.weight.0;
    match parts.iter().find(across) {
        Some(second) => crossings(&first, second),
        None => along(&first),
    }
}

/// All angles modulo a full turn with both phases.
fn crossings(x: &Part, y: &Part) -> Vec<(f64, f64)> {
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
fn along(x: &Part) -> Vec<(f64, f64)> {
    let (m, n) = x.weight;
    let families = gcd(m.unsigned_abs(), n.unsigned_abs());
    let angle = |k: u32| (x.phase + TAU * f64::from(k)) / f64::from(if m == 0 { n } else { m });
    (0..families).map(|k| if m == 0 { (0.0, angle(k)) } else { (angle(k), 0.0) }).collect()
}

fn gcd(a: u32, b: u32) -> u32 {
    if b == 0 { a } else { gcd(b, a % b) }
}

/// The parts of `a` that are not silent, with weights up to sign and not zero.
fn parts(a: &Projector, b: &Projector, open: [bool; 2]) -> Vec<Part> {
    let (a, b) = (circular(a), circular(b));
    // coordinates (1, x + i y, x - i y, z) turn by e^{0, i, -i, 0}
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
                found.push(Part { weight: (m, n), norm, phase: inner.arg() });
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
