//! Octahedral platforms by an octic in one unknown squared distance.
//!
//! Among `P1..P6` only `s15, s34, s26` are unknown. Any five points in space have a vanishing Cayley-Menger
//! determinant; `D(1,2,3,4,5) = 0` and `D(1,3,4,5,6) = 0` contain `x = s15` and `y = s34` only, each of degree
//! two. Eliminating `y` leaves an octic in `x` (Rojas, Borras, Thomas, sec. 3). Each root belongs to one
//! `y` and to two poses, mirror images in the base plane: 16 poses.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

mod beside;
mod factors;
mod lanes;
mod parallel;
mod records;
mod solver;
mod starts;

pub use solver::{OcticPoses, OcticSolver};

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::collect::{PoseCandidate, collect, pose_scale};
use super::counted::compared_with_count;
use super::evidence::{KnownCertificates, attach};
use super::{
    Completeness, FkError, FkOptions, FkSolutions, ForwardKinematics, Method, PreparedDesign, Reason,
    SolutionSet, Theorem,
};
use crate::solve::certify::Certifier;
use num::batch::LANES;
use num::poly::roots;
use platform::geom::{ComplexPose, trilaterate};
use platform::manipulator::{Leg, Manipulator, Octahedral, SquaredLegLengths};

/// Forward kinematics of octahedral platforms (also of those whose joints coincide without being named as
/// shared: only coordinates count).
#[derive(Debug, Clone, Copy, Default)]
pub struct Octic;

/// A polynomial of degree two in `x` and in `y`: `c[i][j] x^i y^j`.
type Biquadratic = [[f64; 3]; 3];

/// The numbers of one problem, in units of the design's size, in cyclic order.
struct OcticProblem {
    base: [Vector3<f64>; 3],
    platform: [Vector3<f64>; 3],
    s: [f64; 6],
    /// Design units a unit.
    size: f64,
}

impl ForwardKinematics for Octic {
    fn method(&self) -> Method {
        Method::Octic
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        compared_with_count(OcticSolver::new(m)?.records(s, o)?, m, s, o)
    }

    fn prepare(&self, m: &Manipulator, _: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        let solver = OcticSolver::new(m).ok()?;
        Some(Box::new(solver))
    }
}

impl PreparedDesign for OcticSolver {
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        compared_with_count(self.records(s, o)?, self.manipulator(), s, o)
    }
}

impl OcticSolver {
    /// All sixteen poses, certified; `None` where that takes the general treatment, or another method.
    pub(crate) fn proved(&self, s: &SquaredLegLengths, seed: u64) -> Option<FkSolutions> {
        self.proved_of(&self.solve(s)?, s, seed)
    }

    fn proved_of(&self, found: &OcticPoses, s: &SquaredLegLengths, seed: u64) -> Option<FkSolutions> {
        let certificates = self.certify(s, found);
        if certificates.complete {
            return Some(records::proved(self, found, &certificates, seed));
        }
        records::proved_one_by_one(self, found, &certificates, s, seed)
    }

    /// The poses with their evidence, as [`Octic`] gives them.
    fn records(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        let (solver, m) = (self, self.manipulator());
        let quick = solver.solve(s);
        if let Some(whole) = quick.as_ref().and_then(|found| self.proved_of(found, s, o.seed)) {
            return Ok(whole);
        }
        let (candidates, pairs, unplaced) = match quick {
            Some(found) => (regular(&found), LANES, 0),
            None => solver.problem(s).candidates()?,
        };
        let candidates = sharpened(m, s, candidates);
        let collected = collect(m, s, &o.tolerances, &candidates);
        let solved = Reason::OcticSolved { pairs, poses: collected.roots.len(), unplaced };
        let mut solutions = FkSolutions {
            method: Method::Octic,
            roots: collected.roots,
            solution_set: SolutionSet::Isolated,
            completeness: Completeness::unproved([solved]),
            paths: Vec::new(),
            rejected: collected.rejected,
            pose_count: None,
            library_calls: Vec::new(),
            unproved: Vec::new(),
            seed: o.seed,
        };
        attach(&mut solutions, m, s, Theorem::Octahedral, KnownCertificates::Listed(Vec::new()))?;
        Ok(solutions)
    }
}

/// Sixteen poses of eight well separated pairs.
fn regular(found: &OcticPoses) -> Vec<PoseCandidate> {
    let candidate = |(i, pose): (usize, &ComplexPose)| PoseCandidate {
        pose: *pose,
        singular: false,
        condition: 1.0,
        source: i / 2,
    };
    found.poses.iter().enumerate().map(candidate).collect()
}

/// Poses with entries above this, positions over the size, are refined beyond doubles before they are given.
const FAR: f64 = 30.0;
/// Farthest that refinement may lead, relative to the pose's own numbers.
const REFINED: f64 = 1e-2;

/// Poses far out, which the trilateration gives with few digits, in all digits of a double.
fn sharpened(
    m: &Manipulator,
    s: &SquaredLegLengths,
    mut candidates: Vec<PoseCandidate>,
) -> Vec<PoseCandidate> {
    let far = |c: &PoseCandidate| pose_scale(&c.pose, m.size()) > FAR;
    if !candidates.iter().any(far) {
        return candidates;
    }
    let Ok(certifier) = Certifier::new(m, s) else { return candidates };
    for c in candidates.iter_mut().filter(|c| pose_scale(&c.pose, m.size()) > FAR) {
        let Ok(refined) = certifier.refine(&c.pose) else { continue };
        let pose = refined.pose();
        if pose.distance(&c.pose, m.size()) <= REFINED * pose_scale(&c.pose, m.size()) {
            c.pose = pose;
        }
    }
    candidates
}

/// Squared distances of an apex to the corners `A, B, C` of a triangle, each `k[0] + k[1] x`.
type Apex = [[f64; 2]; 3];

/// `(U.V - q_U.q_V)^2 - h_U h_V` as a polynomial in the unknown `x` of apex `U` and `y` of apex `V`.
///
/// Origin in corner `A`; `q` is the projection into the plane of the triangle, `h` the squared height. It
/// vanishes when `U` and `V` can be placed at squared distance `d`: the Cayley-Menger determinant of the
/// five points up to a constant.
#[inline]
fn closure(triangle: [&Vector3<f64>; 3], u: Apex, v: Apex, d: f64) -> Biquadratic {
    let (b, c) = (triangle[1] - triangle[0], triangle[2] - triangle[0]);
    let (bb, bc, cc) = (b.norm_squared(), b.dot(&c), c.norm_squared());
    let area = bb * cc - bc * bc;
    // products of an apex with the sides: affine in its unknown
    let sides = |w: &Apex| -> [[f64; 2]; 2] {
        let along = |k: usize, corner: usize, square: f64| {
            let constant = if k == 0 { square } else { 0.0 };
            (w[0][k] + constant - w[corner][k]) / 2.0
        };
        [[along(0, 1, bb), along(1, 1, bb)], [along(0, 2, cc), along(1, 2, cc)]]
    };
    let (su, sv) = (sides(&u), sides(&v));
    let gram = |p: &[[f64; 2]; 2], i: usize, q: &[[f64; 2]; 2], j: usize| {
        (cc * p[0][i] * q[0][j] - bc * (p[0][i] * q[1][j] + p[1][i] * q[0][j]) + bb * p[1][i] * q[1][j])
            / area
    };
    // U.V - q_U.q_V, bilinear
    let mut mixed = [[0.0; 2]; 2];
    for (i, row) in mixed.iter_mut().enumerate() {
        for (j, z) in row.iter_mut().enumerate() {
            *z = -gram(&su, i, &sv, j);
        }
    }
    mixed[0][0] += (u[0][0] + v[0][0] - d) / 2.0;
    mixed[1][0] += u[0][1] / 2.0;
    mixed[0][1] += v[0][1] / 2.0;
    let height = |w: &Apex, s: &[[f64; 2]; 2]| {
        let square = [gram(s, 0, s, 0), gram(s, 0, s, 1) + gram(s, 1, s, 0), gram(s, 1, s, 1)];
        [w[0][0] - square[0], w[0][1] - square[1], -square[2]]
    };
    let (hu, hv) = (height(&u, &su), height(&v, &sv));
    let mut out = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            out[i][j] = -hu[i] * hv[j];
        }
    }
    for (i, j, k, l) in (0..16).map(|n| (n & 1, n >> 1 & 1, n >> 2 & 1, n >> 3 & 1)) {
        out[i + k][j + l] += mixed[i][j] * mixed[k][l];
    }
    out
}

/// `a_i b_j - a_j b_i` for the coefficients of `y^i`, `y^j`: a polynomial of degree four in `x`.
#[inline(always)]
fn minor(a: &Biquadratic, b: &Biquadratic, i: usize, j: usize) -> [f64; 5] {
    let mut out = [0.0; 5];
    for k in 0..3 {
        for l in 0..3 {
            out[k + l] += a[k][i] * b[l][j] - a[k][j] * b[l][i];
        }
    }
    out
}

/// Resultant with respect to `y`: `(a2 b0 - a0 b2)^2 - (a2 b1 - a1 b2)(a1 b0 - a0 b1)`.
#[inline(always)]
fn resultant(a: &Biquadratic, b: &Biquadratic) -> [f64; 9] {
    let (outer, high, low) = (minor(a, b, 2, 0), minor(a, b, 2, 1), minor(a, b, 1, 0));
    let mut out = [0.0; 9];
    for k in 0..5 {
        for l in 0..5 {
            out[k + l] += outer[k] * outer[l] - high[k] * low[l];
        }
    }
    out
}

/// Value and derivatives by `x` and `y`.
fn evaluate(p: &Biquadratic, x: Complex64, y: Complex64) -> [Complex64; 3] {
    let (px, py) = ([Complex64::ONE, x, x * x], [Complex64::ONE, y, y * y]);
    let (dx, dy) = ([Complex64::ZERO, Complex64::ONE, x * 2.0], [Complex64::ZERO, Complex64::ONE, y * 2.0]);
    let mut out = [Complex64::ZERO; 3];
    for i in 0..3 {
        for j in 0..3 {
            out[0] += px[i] * py[j] * p[i][j];
            out[1] += dx[i] * py[j] * p[i][j];
            out[2] += px[i] * dy[j] * p[i][j];
        }
    }
    out
}

/// Newton's method on both closures; `None` when it leaves the neighbourhood of its start.
fn polish(a: &Biquadratic, b: &Biquadratic, start: [Complex64; 2]) -> Option<[Complex64; 2]> {
    let [mut x, mut y] = start;
    let scale = x.norm() + y.norm();
    let mut step = f64::INFINITY;
    for _ in 0..12 {
        let (f, g) = (evaluate(a, x, y), evaluate(b, x, y));
        let det = f[1] * g[2] - f[2] * g[1];
        let dx = (f[0] * g[2] - f[2] * g[0]) / det;
        let dy = (f[1] * g[0] - f[0] * g[1]) / det;
        let next = dx.norm() + dy.norm();
        if !next.is_finite() || next > 0.05 * scale {
            return None;
        }
        if next >= step && step < 1e-12 * scale {
            break;
        }
        x -= dx;
        y -= dy;
        step = next;
    }
    (step < 1e-8 * scale).then_some([x, y])
}

impl OcticProblem {
    fn closures(&self) -> (Biquadratic, Biquadratic) {
        let s = self.s.map(|k| [k, 0.0]);
        let unknown = [0.0, 1.0];
        let [p1, p2, p3] = &self.base;
        let [p4, p5, p6] = &self.platform;
        // legs: s14 s24 s25 s35 s36 s16
        let first =
            closure([p1, p2, p3], [unknown, s[2], s[3]], [s[0], s[1], unknown], (p4 - p5).norm_squared());
        let second =
            closure([p4, p5, p6], [s[0], unknown, s[5]], [unknown, s[3], s[4]], (p1 - p3).norm_squared());
        (first, second)
    }

    /// Root by root, for coinciding pairs and flat corners too: candidates, pairs, pairs without a pose.
    fn candidates(&self) -> Result<(Vec<PoseCandidate>, usize, usize), FkError> {
        let pairs = self.distance_pairs().map_err(|what| FkError::Breakdown { what })?;
        let mut candidates = Vec::new();
        let mut unplaced = 0;
        for (source, pair) in pairs.iter().enumerate() {
            match self.poses(*pair) {
                Some(two) => candidates.extend(two.map(|pose| PoseCandidate {
                    pose: ComplexPose { position: pose.position * Complex64::from(self.size), ..pose },
                    singular: false,
                    condition: 1.0,
                    source,
                })),
                None => unplaced += 1,
            }
        }
        Ok((candidates, pairs.len(), unplaced))
    }

    /// The pairs `(s15, s34)` that satisfy both closures, eight in general.
    fn distance_pairs(&self) -> Result<Vec<[Complex64; 2]>, String> {
        let (a, b) = self.closures();
        let octic: Vec<Complex64> = resultant(&a, &b).into_iter().map(Complex64::from).collect();
        let mut pairs: Vec<[Complex64; 2]> = Vec::new();
        for x in roots(&octic).map_err(|e| e.to_string())? {
            let column = |j: usize| a[0][j] + x * (a[1][j] + x * a[2][j]);
            let quadratic = [column(0), column(1), column(2)];
            for y in roots(&quadratic).map_err(|e| e.to_string())? {
                let Some(pair) = polish(&a, &b, [x, y]) else { continue };
                let far = |q: &[Complex64; 2]| {
                    let distance = (q[0] - pair[0]).norm() + (q[1] - pair[1]).norm();
                    distance > 1e-9 * (pair[0].norm() + pair[1].norm())
                };
                if pairs.iter().all(far) {
                    pairs.push(pair);
                }
            }
        }
        Ok(pairs)
    }

    /// The two poses of a pair, by trilateration: `P4`, `P5` from the base, then `P6`, then `(R, p)`.
    fn poses(&self, [s15, s34]: [Complex64; 2]) -> Option<[ComplexPose; 2]> {
        let lift = |v: &Vector3<f64>| v.map(Complex64::from);
        let base = [0, 1, 2].map(|k| lift(&self.base[k]));
        let s = self.s.map(Complex64::from);
        let side = |i: usize, j: usize| Complex64::from((self.platform[i] - self.platform[j]).norm_squared());
        let square = |v: Vector3<Complex64>| v.dot(&v);
        let nearest = |pair: [Vector3<Complex64>; 2], error: &dyn Fn(&Vector3<Complex64>) -> f64| {
            if error(&pair[0]) <= error(&pair[1]) { pair[0] } else { pair[1] }
        };
        let p4 = trilaterate(&base, [s[0], s[1], s34])?[0];
        let p5 = nearest(trilaterate(&base, [s15, s[2], s[3]])?, &|p| (square(p - p4) - side(0, 1)).norm());
        let p6 = self.third_corner(&base, p4, p5)?;
        let frame = |p: [Vector3<Complex64>; 3]| {
            let (u, v) = (p[1] - p[0], p[2] - p[0]);
            Matrix3::from_columns(&[u, v, u.cross(&v)])
        };
        let local = [0, 1, 2].map(|k| lift(&self.platform[k]));
        let inverse = frame(local).try_inverse()?;
        let n = (base[1] - base[0]).cross(&(base[2] - base[0]));
        let mirror = |p: Vector3<Complex64>| p - n * ((p - base[0]).dot(&n) / square(n) * 2.0);
        let pose = |p: [Vector3<Complex64>; 3]| {
            let rotation = frame(p) * inverse;
            ComplexPose { rotation, position: p[0] - rotation * local[0] }
        };
        Some([pose([p4, p5, p6]), pose([p4, p5, p6].map(mirror))])
    }

    /// `P6` from three of `P1, P3, P4, P5` (the triangle with the largest area), the sign from the fourth.
    fn third_corner(
        &self,
        base: &[Vector3<Complex64>; 3],
        p4: Vector3<Complex64>,
        p5: Vector3<Complex64>,
    ) -> Option<Vector3<Complex64>> {
        let side = |i: usize, j: usize| (self.platform[i] - self.platform[j]).norm_squared();
        let known = [
            (base[0], Complex64::from(self.s[5])),
            (base[2], Complex64::from(self.s[4])),
            (p4, Complex64::from(side(0, 2))),
            (p5, Complex64::from(side(1, 2))),
        ];
        let area = |skip: usize| {
            let [a, b, c] = others(skip).map(|k| known[k].0);
            let n = (b - a).cross(&(c - a));
            n.dot(&n).norm()
        };
        let skip = (0..4).max_by(|&i, &j| area(i).total_cmp(&area(j)))?;
        let corners = others(skip);
        let pair = trilaterate(&corners.map(|k| known[k].0), corners.map(|k| known[k].1))?;
        let error = |p: &Vector3<Complex64>| {
            let d = p - known[skip].0;
            (d.dot(&d) - known[skip].1).norm()
        };
        Some(if error(&pair[0]) <= error(&pair[1]) { pair[0] } else { pair[1] })
    }
}

fn others(skip: usize) -> [usize; 3] {
    [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]][skip]
}

/// The octic of an octahedral manipulator in `s15`, up to a common factor. Coefficients run from the constant term up,
/// in units of the design (not scaled to size one).
///
/// # Errors
/// [`FkError::NotApplicable`] when the manipulator is not octahedral.
pub fn octic(m: &Manipulator, s: &SquaredLegLengths) -> Result<[f64; 9], FkError> {
    let refuse = |reason: String| FkError::NotApplicable { method: Method::Octic, reason };
    let legs: [Leg; 6] = m.legs();
    let merged = Manipulator::from_legs(legs).map_err(|e| refuse(e.to_string()))?;
    let octahedral = Octahedral::recognise(&merged).map_err(|e| refuse(e.to_string()))?;
    let problem = OcticProblem {
        base: octahedral.base().map(|p| p.coords),
        platform: octahedral.platform().map(|p| p.coords),
        s: octahedral.order().map(|i| s.get()[i.get()]),
        size: 1.0,
    };
    let (a, b) = problem.closures();
    Ok(resultant(&a, &b))
}

#[cfg(test)]
mod certificate_tests;
#[cfg(test)]
mod tests;
