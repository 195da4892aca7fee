//! The far poses of a special design: common points at infinity of its legs, as far as doubles know them.
//!
//! With isotropic `u`, `v` a leg holds at infinity when `r - 2 eta a.u - 2 xi b.v - 2 (a.u)(b.v) = 0` (`special`). A
//! rounded design fulfils six such equations nearly. `u` and `v` have one parameter each; the five unknowns are found
//! by least squares from random starts. They depend on the joints alone. Nothing is proved here: the points are starts
//! for `certify::far`.

use nalgebra::{Quaternion, Rotation3, SMatrix, SVector, UnitQuaternion, Vector3};
use num_complex::Complex64;

use super::certify::far::{C, D, FarPoint, PATCH};
use num::{Purpose, Rng};
use platform::manipulator::Manipulator;

/// Random starts, and how many in turn may find nothing new.
const STARTS: usize = 1500;
const VAIN: usize = 100;
/// So many points, one of each conjugate pair, are searched for: six legs have at most forty isolated ones.
const MOST: usize = 20;
/// Steps of one search.
const STEPS: usize = 40;
/// Square of the last step, relative: the point is only a start.
const SETTLED: f64 = 1e-18;
/// Largest residual of what may be a common point: joints are rounded.
const NEARLY: f64 = 1e-2;
/// Points closer than this are one.
const SAME: f64 = 1e-4;

type Unknowns = SVector<Complex64, 5>;
type Gradient = SMatrix<Complex64, 6, 5>;

/// An isotropic vector and its derivative.
fn isotropic(s: Complex64) -> [[Complex64; 3]; 2] {
    let (i, one) = (Complex64::I, Complex64::ONE);
    [[one - s * s, i * (one + s * s), s * 2.0], [s * -2.0, i * s * 2.0, Complex64::from(2.0)]]
}

fn dot(a: &[f64; 3], u: &[Complex64; 3]) -> Complex64 {
    u[0] * a[0] + u[1] * a[1] + u[2] * a[2]
}

/// The ends of the legs in frames that are turned.
struct Search {
    a: [[f64; 3]; 6],
    b: [[f64; 3]; 6],
    turned: [Rotation3<f64>; 2],
}

impl Search {
    /// Turned at random: otherwise directions for which a parameter is large are hardly found.
    fn turned(ends: &[[Vector3<f64>; 6]; 2], rng: &mut Rng) -> Self {
        let turned = [(); 2].map(|()| {
            let quaternion = Quaternion::new(rng.normal(), rng.normal(), rng.normal(), rng.normal());
            UnitQuaternion::from_quaternion(quaternion).to_rotation_matrix()
        });
        let [a, b] = [0, 1].map(|k| ends[k].map(|end| (turned[k] * end).into()));
        Self { a, b, turned }
    }

    /// An isotropic vector in the frame of the design.
    fn isotropic(&self, body: usize, s: Complex64) -> [Complex64; 3] {
        let ([u, _], back) = (isotropic(s), self.turned[body].inverse());
        std::array::from_fn(|i| (0..3).fold(Complex64::ZERO, |sum, k| sum + u[k] * back[(i, k)]))
    }

    /// Unknowns `s`, `t` of `u` and `v`, `r`, `eta`, `xi`.
    fn equations(&self, x: &Unknowns) -> (SVector<Complex64, 6>, Gradient) {
        let ([u, du], [v, dv]) = (isotropic(x[0]), isotropic(x[1]));
        let mut f = SVector::<Complex64, 6>::zeros();
        let mut j = Gradient::zeros();
        for i in 0..6 {
            let (p, dp) = (dot(&self.a[i], &u), dot(&self.a[i], &du));
            let (q, dq) = (dot(&self.b[i], &v), dot(&self.b[i], &dv));
            f[i] = x[2] - (x[3] * p + x[4] * q + p * q) * 2.0;
            let row = [(x[3] + q) * dp * -2.0, (x[4] + p) * dq * -2.0, Complex64::ONE, p * -2.0, q * -2.0];
            for k in 0..5 {
                j[(i, k)] = row[k];
            }
        }
        (f, j)
    }

    /// Levenberg's method.
    fn from(&self, mut x: Unknowns) -> Option<Unknowns> {
        let (mut f, mut j) = self.equations(&x);
        let mut damping = 1e-2;
        for _ in 0..STEPS {
            let (gradient, mut normal) = (j.adjoint() * f, j.adjoint() * j);
            for k in 0..5 {
                normal[(k, k)] += damping;
            }
            let step = normal.lu().solve(&gradient)?;
            let next = x - step;
            let (g, k) = self.equations(&next);
            if g.norm_squared() < f.norm_squared() {
                let settled = step.norm_squared() < SETTLED * (1.0 + x.norm_squared());
                (x, f, j) = (next, g, k);
                damping *= 0.1;
                if settled {
                    break;
                }
            } else {
                damping = (damping * 8.0).max(1e-14);
                if damping > 1e8 {
                    break;
                }
            }
        }
        (f.norm() < NEARLY && x.norm() < 1e3).then_some(x)
    }

    /// The point in the coordinates of `certify::far`.
    fn point(&self, x: &Unknowns) -> Option<FarPoint> {
        let (u, v) = (self.isotropic(0, x[0]), self.isotropic(1, x[1]));
        let m = |i: usize, j: usize| u[i] * v[j];
        let trace = m(0, 0) + m(1, 1) + m(2, 2);
        let product = |i: usize, j: usize| match (i.min(j), i.max(j)) {
            (0, 0) => trace,
            (0, k) => m((k + 1) % 3, k % 3) - m(k % 3, (k + 1) % 3),
            (k, l) if k == l => m(k - 1, k - 1) * 2.0 - trace,
            (k, l) => m(k - 1, l - 1) + m(l - 1, k - 1),
        };
        let largest = (0..4).max_by(|i, j| product(*i, *i).norm().total_cmp(&product(*j, *j).norm()))?;
        let column: [Complex64; 4] = std::array::from_fn(|i| product(i, largest));
        let patch = (0..4).fold(Complex64::ZERO, |sum, k| sum + column[k] * PATCH[k]);
        let e = column.map(|z| z / patch);
        // `column` is a multiple of the quaternion of `u v^T` by four times its largest coordinate
        let scale = product(largest, largest) * 4.0 / (patch * patch);
        let (to_u, to_v) = (dot(&D, &u), dot(&C, &v));
        let k = to_u * to_v;
        let (alpha, beta) = (x[3] / to_v, -x[4] / to_u);
        let rho = (alpha * beta * k * 2.0 - x[2]) / (scale * k * k);
        let out = [e[0], e[1], e[2], e[3], alpha, beta, Complex64::ZERO, rho];
        out.iter().all(|z| z.norm() < 1e8).then_some(out)
    }
}

/// The search for the points at infinity that the legs of a design nearly have in common.
pub(crate) struct FarSearch {
    ends: [[Vector3<f64>; 6]; 2],
    rng: Rng,
    found: Vec<FarPoint>,
    starts: usize,
    vain: usize,
}

impl FarSearch {
    pub(crate) fn new(m: &Manipulator, seed: u64) -> Self {
        // the unit of length of `certify::far`
        let inverse = 2f64.powi(m.size().log2().floor() as i32).recip();
        let legs = m.legs();
        let ends = [
            std::array::from_fn(|i| legs[i].base.coords * inverse),
            std::array::from_fn(|i| legs[i].platform.coords * inverse),
        ];
        Self { ends, rng: Purpose::FAR_POINTS.rng(seed), found: Vec::new(), starts: 0, vain: 0 }
    }

    /// The points, one of each conjugate pair: first those that are known, then new ones as they are found.
    ///
    /// Legs that have a curve of common points at infinity have no end of them: then [`MOST`] are searched for.
    pub(crate) fn points(&mut self) -> impl Iterator<Item = FarPoint> {
        let mut k = 0;
        std::iter::from_fn(move || {
            if k == self.found.len() {
                let point = self.another()?;
                self.found.push(point);
            }
            k += 1;
            Some(self.found[k - 1])
        })
    }

    /// The points found so far.
    pub(crate) fn known(&self) -> &[FarPoint] {
        &self.found
    }

    /// One that is not known yet.
    fn another(&mut self) -> Option<FarPoint> {
        let is_same = |x: &FarPoint, y: &FarPoint| {
            let size = 1.0 + x.iter().map(|z| z.norm()).fold(0.0, f64::max);
            x.iter().zip(y).all(|(x, y)| (x - y).norm() < SAME * size)
        };
        while self.starts < STARTS && self.vain < VAIN && self.found.len() < MOST {
            self.starts += 1;
            self.vain += 1;
            let start = Unknowns::from_fn(|_, _| Complex64::new(self.rng.normal(), self.rng.normal()));
            let problem = Search::turned(&self.ends, &mut self.rng);
            let found = problem.from(start);
            let Some(point) = found.as_ref().and_then(|x| problem.point(x)) else { continue };
            let conjugate = point.map(|z| z.conj());
            if !self.found.iter().any(|x| is_same(&point, x) || is_same(&conjugate, x)) {
                self.vain = 0;
                return Some(point);
            }
        }
        None
    }
}
