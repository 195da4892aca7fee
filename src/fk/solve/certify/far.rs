//! Poses far out, and points at infinity, proved in coordinates that are regular there.
//!
//! Rounded joints of a special design have poses whose `R` has entries of `1e6` or more. In `(e, g)` they are nearly
//! singular; here they are not. With `h = e.e`, `M = h R(e)`, constant vectors `c`, `c'` and the position
//! `p = alpha R c + beta c' + gamma (R c) x c'`,
//!
//! ```text
//! h p     = alpha M c + beta h c' + gamma (M c) x c',
//! h R^T p = alpha h c + beta M^T c' + gamma c x (M^T c'),
//! h p.p   = h (alpha^2 c.c + beta^2 c'.c' + gamma^2 c.c c'.c') + 2 alpha beta k - rho k^2,     k = c'.M c,
//! rho h   = gamma^2.
//! ```
//!
//! These are polynomials in `(e, alpha, beta, gamma, rho)`, so that the six leg equations times `h`, the last equation
//! and a patch `l.e = 1` are eight equations in eight unknowns. As long as `d = (M c) x c' . (M c) x c'
//! = h^2 c.c c'.c' - k^2` does not vanish, they are coordinates of the closure of the group ("Points at infinity" in
//! `docs/theory/completeness.md`): `M` gives `e`, the first two lines give `alpha, beta, gamma`, the third gives `rho`.
//! A regular zero is thus an isolated common point of the six legs, and different zeros are different points.
//!
//! The proof is Krawczyk's: `K = x - Y F(x) + (I - Y F'(X)) (X - x)` inside `X`, with `F(x)` in discs about
//! double-doubles and `F'(X)` in discs about doubles.

use std::ops::{Add, Mul, Sub};

use nalgebra::{SMatrix, SVector};
use num_complex::Complex64;

use super::system::SquareData;
use num::ball::{Disc, UP, WideDisc};
use num::double_double::{ComplexDoubleDouble, DoubleDouble};
use num::rounding::check_arithmetic;
use platform::manipulator::{Body, Manipulator};

/// Unknowns: `e`, `alpha`, `beta`, `gamma`, `rho`.
const N: usize = 8;
/// A point of the chart.
pub(crate) type FarPoint = [Complex64; N];
type Matrix = SMatrix<Complex64, N, N>;
type Vector = SVector<Complex64, N>;

/// The vector `c`; both are generic and their products are exact.
pub(crate) const C: [f64; 3] = [0.75, -0.5, 0.625];
/// The vector `c'`.
pub(crate) const D: [f64; 3] = [-0.375, 0.875, 0.5];
/// The patch `l`.
pub(crate) const PATCH: [f64; 4] = [0.375, 0.8125, -0.6875, 0.53125];
/// Entries of `R` of a far pose are at least this large: those of real poses are at most one.
const FAR: f64 = 1e2;
/// Newton steps from a start.
const STEPS: usize = 40;
/// A step below this, relative, is the last one: values are in double-double.
const SETTLED: f64 = 1e-22;

/// A number of the equations: a disc, or a disc with its derivatives.
trait Ring: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    fn real(middle: DoubleDouble, radius: f64) -> Self;
    fn of(x: f64) -> Self {
        Self::real(DoubleDouble::from(x), 0.0)
    }
}

impl Ring for WideDisc {
    fn real(middle: DoubleDouble, radius: f64) -> Self {
        Self { centre: ComplexDoubleDouble { re: middle, im: DoubleDouble::ZERO }, radius }
    }
}

/// A disc and its derivatives by the unknowns.
#[derive(Clone, Copy)]
struct Dual {
    value: Disc,
    by: [Disc; N],
}

fn zero() -> Disc {
    Disc::point(Complex64::ZERO)
}

impl Add for Dual {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let by = std::array::from_fn(|k| self.by[k] + other.by[k]);
        Self { value: self.value + other.value, by }
    }
}

impl Sub for Dual {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        let by = std::array::from_fn(|k| self.by[k] - other.by[k]);
        Self { value: self.value - other.value, by }
    }
}

impl Mul for Dual {
    type Output = Self;
    #[allow(clippy::suspicious_arithmetic_impl)] // the product rule
    fn mul(self, other: Self) -> Self {
        let by = std::array::from_fn(|k| self.by[k] * other.value + self.value * other.by[k]);
        Self { value: self.value * other.value, by }
    }
}

impl Ring for Dual {
    fn real(middle: DoubleDouble, radius: f64) -> Self {
        Self { value: WideDisc::real(middle, radius).rounded(), by: [zero(); N] }
    }
}

/// `e.e`.
fn norm<T: Ring>(e: &[T]) -> T {
    e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]
}

/// `e.e R(e)`.
fn matrix<T: Ring>(e: &[T]) -> [[T; 3]; 3] {
    let two = T::of(2.0);
    let (ww, xx, yy, zz) = (e[0] * e[0], e[1] * e[1], e[2] * e[2], e[3] * e[3]);
    let (wx, wy, wz) = (e[0] * e[1], e[0] * e[2], e[0] * e[3]);
    let (xy, xz, yz) = (e[1] * e[2], e[1] * e[3], e[2] * e[3]);
    [
        [ww + xx - yy - zz, two * (xy - wz), two * (xz + wy)],
        [two * (xy + wz), ww - xx + yy - zz, two * (yz - wx)],
        [two * (xz - wy), two * (yz + wx), ww - xx - yy + zz],
    ]
}

fn dot<T: Ring>(x: &[T; 3], y: &[T; 3]) -> T {
    x[0] * y[0] + x[1] * y[1] + x[2] * y[2]
}

fn cross<T: Ring>(x: &[T; 3], y: &[T; 3]) -> [T; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        x[j] * y[k] - x[k] * y[j]
    })
}

/// The eight equations of one problem, lengths in units of a power of two.
pub(crate) struct FarSystem {
    a: [[f64; 3]; 6],
    b: [[f64; 3]; 6],
    s: [DoubleDouble; 6],
    s_radius: [f64; 6],
}

/// A proved common point of the six legs far out: there is exactly one zero in the polydisc.
#[derive(Debug, Clone)]
pub(crate) struct FarRoot {
    discs: [WideDisc; N],
    /// Lower bound of the largest entry of `R`; infinite at infinity.
    pub(crate) rotation: f64,
}

impl FarRoot {
    /// The nearest doubles to the middle.
    pub(crate) fn centre(&self) -> FarPoint {
        std::array::from_fn(|k| self.discs[k].centre.hi())
    }

    /// Whether two zeros are proved to be different.
    pub(crate) fn is_apart(&self, other: &Self) -> bool {
        self.discs.iter().zip(&other.discs).any(|(x, y)| x.is_disjoint(y))
    }
}

impl FarSystem {
    /// `None` for joints that are not exactly their doubles, and where scaling is not exact.
    pub(crate) fn new(m: &Manipulator, s: &SquareData) -> Option<Self> {
        check_arithmetic().ok()?;
        if (0..6).any(|i| Body::BOTH.iter().any(|body| m.end_radius(i, *body) > 0.0)) {
            return None;
        }
        let unit = super::system::power_of_two_below(m.size());
        let inverse = unit.recip();
        let (mut a, mut b) = ([[0.0; 3]; 6], [[0.0; 3]; 6]);
        for (i, leg) in m.legs().iter().enumerate() {
            a[i] = super::system::scale_point(leg.base.coords.into(), inverse)?;
            b[i] = super::system::scale_point(leg.platform.coords.into(), inverse)?;
        }
        let square = inverse * inverse;
        let mut middle = s.middle;
        for x in &mut middle {
            let (hi, lo) = (
                super::system::exact_product(x.hi(), square)?,
                super::system::exact_product(x.lo(), square)?,
            );
            *x = DoubleDouble::from_sum(hi, lo);
        }
        Some(Self { a, b, s: middle, s_radius: s.radius.map(|r| super::system::scaled_radius(r, square)) })
    }

    fn values<T: Ring>(&self, x: &[T; N]) -> [T; N] {
        let (e, [alpha, beta, gamma, rho]) = (&x[..4], [x[4], x[5], x[6], x[7]]);
        let (c, d, two) = (C.map(T::of), D.map(T::of), T::of(2.0));
        let (h, m) = (norm(e), matrix(e));
        let mc: [T; 3] = std::array::from_fn(|i| dot(&m[i], &c));
        let md: [T; 3] = std::array::from_fn(|j| dot(&[m[0][j], m[1][j], m[2][j]], &d));
        let (k, across, back) = (dot(&mc, &d), cross(&mc, &d), cross(&c, &md));
        let y: [T; 3] = std::array::from_fn(|i| alpha * mc[i] + beta * h * d[i] + gamma * across[i]);
        let q: [T; 3] = std::array::from_fn(|i| alpha * h * c[i] + beta * md[i] + gamma * back[i]);
        let (cc, dd) = (dot(&c, &c), dot(&d, &d));
        let square = h * (alpha * alpha * cc + beta * beta * dd + gamma * gamma * cc * dd)
            + two * alpha * beta * k
            - rho * k * k;
        std::array::from_fn(|i| match i {
            0..6 => {
                let (a, b) = (self.a[i].map(T::of), self.b[i].map(T::of));
                let mb: [T; 3] = std::array::from_fn(|j| dot(&m[j], &b));
                let constant = dot(&a, &a) + dot(&b, &b) - T::real(self.s[i], self.s_radius[i]);
                constant * h + square + two * (dot(&b, &q) - dot(&a, &y) - dot(&a, &mb))
            }
            6 => gamma * gamma - rho * h,
            _ => (0..4).fold(T::of(-1.0), |sum, j| sum + T::of(PATCH[j]) * e[j]),
        })
    }

    /// Values at a point and the derivatives there, in discs about doubles; derivatives over the polydisc.
    fn derivatives(&self, x: &[Disc; N]) -> [Dual; N] {
        let dual = std::array::from_fn(|j| {
            let by =
                std::array::from_fn(|k| Disc::point(if j == k { Complex64::ONE } else { Complex64::ZERO }));
            Dual { value: x[j], by }
        });
        self.values(&dual)
    }

    fn jacobian(&self, x: &FarPoint) -> (Vector, Matrix) {
        let rows = self.derivatives(&x.map(Disc::point));
        (Vector::from_fn(|i, _| rows[i].value.centre), Matrix::from_fn(|i, j| rows[i].by[j].centre))
    }

    /// Both zeros near a common point at infinity of a design next to this one: a Newton step onto the linear equations,
    /// then the quadratic one on the line that they leave.
    pub(crate) fn starts(&self, x: &FarPoint) -> Option<[FarPoint; 2]> {
        let mut x = Vector::from_column_slice(x);
        let mut direction = Vector::zeros();
        for _ in 0..3 {
            let (mut f, mut j) = self.jacobian(&x.as_slice().try_into().ok()?);
            // any row that is not one of the others
            for k in 0..N {
                j[(6, k)] = Complex64::from_polar(1.0, 1.0 + 1.7 * (k * k) as f64);
            }
            f[6] = Complex64::ZERO;
            let lu = j.lu();
            x -= lu.solve(&f)?;
            let mut one = Vector::zeros();
            one[6] = Complex64::ONE;
            direction = lu.solve(&one)?;
        }
        let point = |t: Complex64| x + direction * t;
        let quadric =
            |y: &Vector| y[6] * y[6] - y[7] * (y[0] * y[0] + y[1] * y[1] + y[2] * y[2] + y[3] * y[3]);
        let c = quadric(&x);
        let (mut slope, mut bend) = (direction[6] * x[6] * 2.0, direction[6] * direction[6]);
        for k in 0..4 {
            slope -= direction[7] * x[k] * x[k] + x[7] * x[k] * direction[k] * 2.0;
            bend -= x[7] * direction[k] * direction[k] + direction[7] * x[k] * direction[k] * 2.0;
        }
        let root = (slope * slope - bend * c * 4.0).sqrt();
        let larger = if (slope + root).norm() > (slope - root).norm() { slope + root } else { slope - root };
        let (near, far) = (-c * 2.0 / larger, -larger / (bend * 2.0));
        let array = |t: Complex64| -> Option<FarPoint> { point(t).as_slice().try_into().ok() };
        Some([array(near)?, array(far)?])
    }

    /// The zero that Newton's method finds from a start, if it is proved and far out.
    pub(crate) fn root_near(&self, start: &FarPoint) -> Option<FarRoot> {
        let wide = |z: Complex64| WideDisc::about(z, Complex64::ZERO, 0.0).centre;
        let size = |v: &[Complex64]| v.iter().map(|z| z.norm()).fold(0.0, f64::max);
        let mut x = start.map(wide);
        for _ in 0..STEPS {
            let rounded = x.map(ComplexDoubleDouble::hi);
            if !(size(&rounded) < 1e9) {
                return None;
            }
            let f = self.values(&x.map(WideDisc::point)).map(|v| v.centre.hi());
            let (_, j) = self.jacobian(&rounded);
            let lu = j.lu();
            let step = lu.solve(&Vector::from_column_slice(&f))?;
            for k in 0..N {
                x[k] = x[k] - wide(step[k]);
            }
            if size(step.as_slice()) < SETTLED * (1.0 + size(&rounded)) {
                return self.prove(&x, &lu.try_inverse()?);
            }
        }
        None
    }

    /// Krawczyk's test about a centre, and how far out the zero is.
    fn prove(&self, centre: &[ComplexDoubleDouble; N], inverse: &Matrix) -> Option<FarRoot> {
        let f = self.values(&centre.map(WideDisc::point)).map(|v| v.rounded());
        let product = |row: usize, column: &dyn Fn(usize) -> Disc| {
            (0..N).fold(zero(), |sum, k| sum + Disc::point(inverse[(row, k)]) * column(k))
        };
        let step: [f64; N] = std::array::from_fn(|i| product(i, &|k| f[k]).magnitude());
        let radius: [f64; N] = step.map(|y| (4.0 * y).max(1e-300));
        let discs: [WideDisc; N] = std::array::from_fn(|k| WideDisc { centre: centre[k], radius: radius[k] });
        let over = self.derivatives(&discs.map(|d| d.rounded()));
        for i in 0..N {
            let mut image = step[i];
            for j in 0..N {
                let one = Disc::point(if i == j { Complex64::ONE } else { Complex64::ZERO });
                let defect = one - product(i, &|k| over[k].by[j]);
                image = (image + defect.magnitude() * radius[j]) * UP;
            }
            if !(image < radius[i]) {
                return None;
            }
        }
        // over the polydisc: the coordinates are those of the closure, and R is large
        let e = &discs[..4];
        let (h, m) = (norm(e), matrix(e));
        let mc: [WideDisc; 3] = std::array::from_fn(|i| dot(&m[i], &C.map(WideDisc::of)));
        let across = cross(&mc, &D.map(WideDisc::of));
        if !(dot(&across, &across).mignitude() > 0.0) {
            return None;
        }
        let entry = m.iter().flatten().map(WideDisc::mignitude).fold(0.0, f64::max);
        let rotation = entry / h.magnitude() * (2.0 - UP);
        (rotation > FAR).then_some(FarRoot { discs, rotation })
    }
}
