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
//! **The proof.** Six legs and the patch are regular far out although the eight equations may have double zeros: a
//! common point at infinity of a butterfly is double, and rounded joints make two zeros of it that doubles do not tell
//! apart. So the seven equations are followed as a curve and the last one, `q = gamma^2 - rho h`, is examined on it.
//! With a unit direction `d`, `Y` an approximate inverse of the Jacobian `G'` at a centre `c` with the row `d^*` in the
//! place of `q'`, and `Y e_6 = d`:
//!
//! ```text
//! G_t(x) = (legs, d^* (x - c) - t, patch),    x = c + d t + y,
//! |y_k| <= R_k,    X = c + d [|t| <= tau] + [|y| <= R],
//! |Y G_0(c)|_k + sum over j of |I - Y G'(X)|_kj (|d_j| tau + R_j) < R_k.
//! ```
//!
//! 1. The left side bounds Krawczyk's operator of `G_t` for every complex `t` with `|t| <= tau`, because
//!    `Y G_t(c + d t) = Y G_0(c) - (I - Y G') d t` with the mean value of `G'`. So there is exactly one `y(t)`, and it
//!    is analytic in `t`.
//! 2. `q(c + d t)` is a polynomial `p_0 + .. + p_3 t^3`, and `q(x(t))` differs from it by a remainder that `R` bounds.
//!    If `|p_m| tau^m` is larger than this remainder and all other terms, `q(x(t))` has exactly `m` zeros with
//!    `|t| < tau` by Rouche's theorem.
//! 3. The curve is smooth with the parameter `t`, so that the multiplicity of a zero is the length of the local ring of
//!    the eight equations, and that of the six legs on the closure of the group. The closure is a hypersurface in the
//!    seven coordinates here, a complete intersection, where that length is the intersection number (Fulton 1984,
//!    proposition 7.1).
//!
//! `G_0(c)` and the `p_k` are in discs about double-doubles, `G'(X)` in discs about doubles.

use nalgebra::{SMatrix, SVector};
use num_complex::Complex64;

use super::system::SquareData;
use num::ball::{Disc, TINY, UP, WideDisc};
use num::double_double::DoubleDouble;
use num::rounding::check_arithmetic;
use num::vector::RingNumber;
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
const FAR: f64 = 4.0;
/// Newton steps onto the curve.
const STEPS: usize = 5;
/// Zeros on the curve farther than this from the start belong to other starts.
const REACH: f64 = 0.1;
/// Two zeros closer than this are tried as a pair.
const CLOSE: f64 = 1e-2;
/// Discs of the parameter that are tried about a single zero: the first ones suffice for most.
const RADII: [f64; 6] = [1e-8, 1e-6, 1e-10, 1e-12, 1e-14, 1e-4];
/// The smallest and the largest disc about two zeros, and how the ones between follow each other.
const PAIR_RADII: [f64; 3] = [1e-9, 1e-2, 32.0];
/// The number of times that a polydisc is widened.
const WIDENED: usize = 4;

/// Numbers of the equations.
trait Ring: RingNumber {
    fn of(x: f64) -> Self;
    fn wide(x: WideDisc) -> Self;
    fn scaled(self, x: f64) -> Self;
}

impl Ring for Complex64 {
    fn of(x: f64) -> Self {
        Self::from(x)
    }
    fn wide(x: WideDisc) -> Self {
        x.centre.hi()
    }
    fn scaled(self, x: f64) -> Self {
        self * x
    }
}

impl Ring for Disc {
    fn of(x: f64) -> Self {
        Self::point(Complex64::from(x))
    }
    fn wide(x: WideDisc) -> Self {
        x.rounded()
    }
    fn scaled(self, x: f64) -> Self {
        self * Self::of(x)
    }
}

impl Ring for WideDisc {
    fn of(x: f64) -> Self {
        Self::about(Complex64::from(x), Complex64::ZERO, 0.0)
    }
    fn wide(x: WideDisc) -> Self {
        x
    }
    fn scaled(self, x: f64) -> Self {
        self * Self::of(x)
    }
}

/// A number and its derivatives by the unknowns.
#[derive(Clone, Copy)]
struct Dual<T> {
    value: T,
    by: [T; N],
}

impl<T: Ring> Dual<T> {
    /// Unknown `k`.
    fn unknown(value: T, k: usize) -> Self {
        Self { value, by: std::array::from_fn(|j| T::of(if j == k { 1.0 } else { 0.0 })) }
    }
}

num::operators! {
    [inline] [T: Ring] Dual<T>;
    Add::add(x, y) {
        let by = std::array::from_fn(|k| x.by[k] + y.by[k]);
        Self { value: x.value + y.value, by }
    }
    Sub::sub(x, y) {
        let by = std::array::from_fn(|k| x.by[k] - y.by[k]);
        Self { value: x.value - y.value, by }
    }
    Mul::mul(x, y) {
        let by = std::array::from_fn(|k| x.by[k] * y.value + x.value * y.by[k]);
        Self { value: x.value * y.value, by }
    }
}

impl<T: Ring> Ring for Dual<T> {
    fn of(x: f64) -> Self {
        Self { value: T::of(x), by: [T::of(0.0); N] }
    }
    fn wide(x: WideDisc) -> Self {
        Self { value: T::wide(x), by: [T::of(0.0); N] }
    }
    fn scaled(self, x: f64) -> Self {
        Self { value: self.value.scaled(x), by: self.by.map(|z| z.scaled(x)) }
    }
}

/// `e.e`.
fn norm<T: Ring>(e: &[T]) -> T {
    e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]
}

/// `e.e R(e)`.
fn matrix<T: Ring>(e: &[T]) -> [[T; 3]; 3] {
    let (ww, xx, yy, zz) = (e[0] * e[0], e[1] * e[1], e[2] * e[2], e[3] * e[3]);
    let (wx, wy, wz) = (e[0] * e[1], e[0] * e[2], e[0] * e[3]);
    let (xy, xz, yz) = (e[1] * e[2], e[1] * e[3], e[2] * e[3]);
    [
        [ww + xx - yy - zz, (xy - wz).scaled(2.0), (xz + wy).scaled(2.0)],
        [(xy + wz).scaled(2.0), ww - xx + yy - zz, (yz - wx).scaled(2.0)],
        [(xz - wy).scaled(2.0), (yz + wx).scaled(2.0), ww - xx - yy + zz],
    ]
}

/// Product with a constant vector.
fn dot<T: Ring>(x: [T; 3], c: [f64; 3]) -> T {
    x[0].scaled(c[0]) + x[1].scaled(c[1]) + x[2].scaled(c[2])
}

/// `x` times a constant vector.
fn cross<T: Ring>(x: [T; 3], c: [f64; 3]) -> [T; 3] {
    std::array::from_fn(|i| {
        let (j, k) = ((i + 1) % 3, (i + 2) % 3);
        x[j].scaled(c[k]) - x[k].scaled(c[j])
    })
}

/// The eight equations of one problem, lengths in units of a power of two.
pub(crate) struct FarSystem {
    a: [[f64; 3]; 6],
    b: [[f64; 3]; 6],
    /// `a.a + b.b - s`.
    constant: [WideDisc; 6],
}

/// Proved common points of the six legs far out: so many zeros, counted with multiplicity, in a polydisc.
#[derive(Debug, Clone)]
pub(crate) struct FarRoots {
    discs: [Disc; N],
    /// One or two.
    pub(crate) multiplicity: usize,
    /// Lower bound of the largest entry of `R`.
    pub(crate) rotation: f64,
    /// Upper bound of the same, infinite where a zero may be at infinity.
    pub(crate) rotation_at_most: f64,
}

impl FarRoots {
    /// Whether the zeros of both are proved to be different.
    pub(crate) fn is_apart(&self, other: &Self) -> bool {
        self.discs.iter().zip(&other.discs).any(|(x, y)| x.is_disjoint(y))
    }

    /// The conjugate zeros: the equations are real.
    pub(crate) fn conjugate(&self) -> Self {
        let discs = self.discs.map(|d| Disc { centre: d.centre.conj(), radius: d.radius });
        Self { discs, ..*self }
    }
}

/// A point of the curve of the legs, the row in the place of `q'`, `Y`, and its column `d`.
struct Curve {
    point: Vector,
    row: [Complex64; N],
    inverse: Matrix,
    direction: Vector,
}

/// `p_0 .. p_3` of the module's text, at `x` along `d`.
fn quadric<T: Ring>(x: &[T; N], d: &[T; N]) -> [T; 4] {
    let product = |u: &[T; N], v: &[T; N]| u[0] * v[0] + u[1] * v[1] + u[2] * v[2] + u[3] * v[3];
    let h = [product(x, x), product(x, d).scaled(2.0), product(d, d)];
    [
        x[6] * x[6] - x[7] * h[0],
        (x[6] * d[6]).scaled(2.0) - x[7] * h[1] - d[7] * h[0],
        d[6] * d[6] - x[7] * h[2] - d[7] * h[1],
        T::of(0.0) - d[7] * h[2],
    ]
}

impl Curve {
    /// The parameters at which the last equation vanishes, up to the term of third order; the smaller one first.
    fn zeros(&self) -> [Complex64; 2] {
        let [x, d]: [FarPoint; 2] = [self.point.into(), self.direction.into()];
        let [c, slope, bend, _] = quadric(&x, &d);
        let root = (slope * slope - bend * c * 4.0).sqrt();
        let larger = if (slope + root).norm() > (slope - root).norm() { slope + root } else { slope - root };
        [-c * 2.0 / larger, -larger / (bend * 2.0)]
    }

    fn at(&self, t: Complex64) -> FarPoint {
        std::array::from_fn(|k| self.point[k] + self.direction[k] * t)
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
        let mut constant = [WideDisc::of(0.0); 6];
        for (i, leg) in m.legs().iter().enumerate() {
            a[i] = super::system::scale_point(leg.base.coords.into(), inverse)?;
            b[i] = super::system::scale_point(leg.platform.coords.into(), inverse)?;
            let square = inverse * inverse;
            let [hi, lo] = [s.middle[i].hi(), s.middle[i].lo()];
            let middle = DoubleDouble::from_sum(
                super::system::exact_product(hi, square)?,
                super::system::exact_product(lo, square)?,
            );
            let s = WideDisc {
                centre: num::double_double::ComplexDoubleDouble { re: middle, im: DoubleDouble::ZERO },
                radius: super::system::scaled_radius(s.radius[i], square),
            };
            constant[i] = dot(a[i].map(WideDisc::of), a[i]) + dot(b[i].map(WideDisc::of), b[i]) - s;
        }
        Some(Self { a, b, constant })
    }

    fn values<T: Ring>(&self, x: &[T; N]) -> [T; N] {
        let (e, [alpha, beta, gamma, rho]) = (&x[..4], [x[4], x[5], x[6], x[7]]);
        let (h, m) = (norm(e), matrix(e));
        let mc: [T; 3] = std::array::from_fn(|i| dot(m[i], C));
        let md: [T; 3] = std::array::from_fn(|j| dot([m[0][j], m[1][j], m[2][j]], D));
        // c x M^T c' is the cross product with the constant on the left
        let (k, across, back) = (dot(mc, D), cross(mc, D), cross(md, C.map(|z| -z)));
        let (alpha_h, beta_h) = (alpha * h, beta * h);
        let y: [T; 3] = std::array::from_fn(|i| alpha * mc[i] + beta_h.scaled(D[i]) + gamma * across[i]);
        let q: [T; 3] = std::array::from_fn(|i| alpha_h.scaled(C[i]) + beta * md[i] + gamma * back[i]);
        let [cc, dd] = [C, D].map(|v| v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        let square = alpha_h * alpha.scaled(cc)
            + beta_h * beta.scaled(dd)
            + h * gamma * gamma.scaled(cc * dd)
            + ((alpha * beta).scaled(2.0) - rho * k) * k;
        std::array::from_fn(|i| match i {
            0..6 => {
                let (a, b) = (self.a[i], self.b[i]);
                let mb: [T; 3] = std::array::from_fn(|j| dot(m[j], b) + y[j]);
                T::wide(self.constant[i]) * h + square + (dot(q, b) - dot(mb, a)).scaled(2.0)
            }
            6 => gamma * gamma - rho * h,
            _ => (0..4).fold(T::of(-1.0), |sum, j| sum + e[j].scaled(PATCH[j])),
        })
    }

    /// Values and derivatives.
    fn derivatives<T: Ring>(&self, x: &[T; N]) -> [Dual<T>; N] {
        self.values(&std::array::from_fn(|k| Dual::unknown(x[k], k)))
    }

    /// The point of the curve of the legs that Newton's method finds.
    fn curve_near(&self, start: &FarPoint) -> Option<Curve> {
        let mut point = Vector::from_column_slice(start);
        // any row that is not one of the others
        let mut row: [Complex64; N] =
            std::array::from_fn(|k| Complex64::from_polar(1.0, 1.0 + 1.7 * (k * k) as f64));
        for step in 0..STEPS {
            let rows = self.derivatives::<Complex64>(&point.as_slice().try_into().ok()?);
            let jacobian = Matrix::from_fn(|i, j| if i == 6 { row[j] } else { rows[i].by[j] });
            let f = Vector::from_fn(|i, _| if i == 6 { Complex64::ZERO } else { rows[i].value });
            let inverse = jacobian.try_inverse()?;
            let moved = inverse * f;
            point -= moved;
            let size = point.iter().map(|z| z.norm()).fold(1.0, f64::max);
            if !(size < 1e9) {
                return None;
            }
            let direction = inverse.column(6).into_owned();
            // the first row is not that of the direction
            if step + 1 == STEPS || (step > 0 && moved.norm() < 1e-14 * size) {
                return Some(Curve { point, row, inverse, direction });
            }
            if step == 0 {
                let length = direction.norm();
                row = std::array::from_fn(|k| direction[k].conj() / length);
            }
        }
        None
    }

    /// The zeros near a common point at infinity of a design next to this one, where they are proved and far out.
    pub(crate) fn roots_near(&self, start: &FarPoint) -> Vec<FarRoots> {
        let Some(curve) = self.curve_near(start) else { return Vec::new() };
        let zeros = curve.zeros();
        let apart = (zeros[1] - zeros[0]).norm() / 2.0;
        if apart < CLOSE {
            let middle = curve.at((zeros[0] + zeros[1]) / 2.0);
            let steps =
                std::iter::successors(Some((4.0 * apart).max(PAIR_RADII[0])), |r| Some(r * PAIR_RADII[2]));
            let radii = steps.take_while(|r| *r < PAIR_RADII[1]);
            if let Some(pair) = self.curve_near(&middle).and_then(|curve| self.prove(&curve, 2, radii)) {
                return vec![pair];
            }
        }
        let single = |t: &Complex64| {
            let mut curve = self.curve_near(&curve.at(*t))?;
            for _ in 0..2 {
                curve = self.curve_near(&curve.at(curve.zeros()[0]))?;
            }
            self.prove(&curve, 1, RADII.into_iter())
        };
        zeros.iter().filter(|t| t.norm() < REACH).filter_map(single).collect()
    }

    /// So many zeros, in the first disc of the parameter for which they are proved.
    fn prove(&self, curve: &Curve, zeros: usize, mut radii: impl Iterator<Item = f64>) -> Option<FarRoots> {
        let newton = |x: &[WideDisc; N]| -> [Disc; N] {
            let f = self.values(x).map(|v| v.rounded());
            std::array::from_fn(|i| {
                let terms = (0..N).filter(|k| *k != 6).map(|k| Disc::point(curve.inverse[(i, k)]) * f[k]);
                terms.fold(Disc::of(0.0), |sum, term| sum + term)
            })
        };
        // a step in double-double, so that what is left of it is far below the discs that are tried
        let rounded = std::array::from_fn(|k| WideDisc::about(curve.point[k], Complex64::ZERO, 0.0));
        let step = newton(&rounded);
        let centre: [WideDisc; N] =
            std::array::from_fn(|k| WideDisc::about(curve.point[k], -step[k].centre, 0.0));
        let step = newton(&centre).map(|y| y.magnitude());
        let direction = std::array::from_fn(|k| WideDisc::about(curve.direction[k], Complex64::ZERO, 0.0));
        let quadric = quadric(&centre, &direction).map(|p| p.rounded());
        let centre = centre.map(|x| x.rounded());
        radii.find_map(|tau| {
            let tube = self.tube(curve, &centre, &step, tau)?;
            let discs = tube.polydisc(&centre, tau);
            if !tube.has_zeros(&quadric, zeros, tau, &centre) {
                return None;
            }
            let [rotation, rotation_at_most] = sizes(&discs)?;
            Some(FarRoots { discs, multiplicity: zeros, rotation, rotation_at_most })
        })
    }

    /// The radii `R` for which Krawczyk's operator maps the tube into itself for all `|t| <= tau`.
    fn tube(&self, curve: &Curve, centre: &[Disc; N], step: &[f64; N], tau: f64) -> Option<Tube> {
        let direction = std::array::from_fn(|k| Disc::point(curve.direction[k]).magnitude());
        let mut tube = Tube { direction, rest: step.map(|y| 2.0 * y + TINY) };
        for _ in 0..WIDENED {
            let radius: [f64; N] = std::array::from_fn(|k| tube.radius(k, tau));
            let rows = self.derivatives::<Disc>(&tube.polydisc(centre, tau));
            let image: [f64; N] = std::array::from_fn(|i| {
                (0..N).fold(step[i], |sum, j| {
                    let one = Disc::of(if i == j { 1.0 } else { 0.0 });
                    let defect = (0..N).fold(one, |rest, k| {
                        let entry = if k == 6 { Disc::point(curve.row[j]) } else { rows[k].by[j] };
                        rest - Disc::point(curve.inverse[(i, k)]) * entry
                    });
                    (sum + defect.magnitude() * radius[j]) * UP
                })
            });
            if image.iter().zip(&tube.rest).all(|(new, old)| new < old) {
                return Some(tube);
            }
            tube.rest = std::array::from_fn(|k| 1.5 * image[k].max(tube.rest[k]));
        }
        None
    }
}

/// All points `c + d t + y`, `|y_k| <= R_k`.
struct Tube {
    /// Bounds of `|d_k|`.
    direction: [f64; N],
    /// `R`.
    rest: [f64; N],
}

impl Tube {
    /// The distance of coordinate `k` from that of the centre for `|t| <= tau`.
    fn radius(&self, k: usize, tau: f64) -> f64 {
        (self.direction[k] * tau + self.rest[k]) * UP
    }

    /// `X` of the module's text.
    fn polydisc(&self, centre: &[Disc; N], tau: f64) -> [Disc; N] {
        std::array::from_fn(|k| Disc {
            centre: centre[k].centre,
            radius: (centre[k].radius + self.radius(k, tau)) * UP,
        })
    }

    /// Whether the last equation has so many zeros on the curve with `|t| < tau`: Rouche's theorem.
    fn has_zeros(&self, quadric: &[Disc; 4], zeros: usize, tau: f64, centre: &[Disc; N]) -> bool {
        // bounds of the coordinates of `c + d t`
        let size: [f64; N] = std::array::from_fn(|k| (centre[k].magnitude() + self.direction[k] * tau) * UP);
        let r = &self.rest;
        let turned: f64 = (0..4).map(|k| r[k] * (2.0 * size[k] + r[k])).sum();
        // `|h|` over the curve without its remainder, from the discs of the coordinates
        let e: [Disc; 4] = std::array::from_fn(|k| Disc {
            centre: centre[k].centre,
            radius: (centre[k].radius + self.direction[k] * tau) * UP,
        });
        let h = norm(&e).magnitude();
        let remainder = r[6] * (2.0 * size[6] + r[6]) + r[7] * h + (size[7] + r[7]) * turned;
        let power = |k: usize| (0..k).fold(1.0, |x, _| x * tau);
        let others: f64 = (0..4).filter(|k| *k != zeros).map(|k| quadric[k].magnitude() * power(k)).sum();
        (others + remainder * UP) * UP < quadric[zeros].mignitude() * power(zeros) * (2.0 - UP)
    }
}

/// Bounds of the largest entry of `R` over a polydisc in which the coordinates are those of the closure and `R` is
/// large.
fn sizes(discs: &[Disc; N]) -> Option<[f64; 2]> {
    let e = &discs[..4];
    let (h, m) = (norm(e), matrix(e));
    let across = cross(std::array::from_fn(|i| dot(m[i], C)), D);
    let normal = across[0] * across[0] + across[1] * across[1] + across[2] * across[2];
    let entry = m.iter().flatten().map(Disc::mignitude).fold(0.0, f64::max);
    let rotation = entry / h.magnitude() * (2.0 - UP);
    let largest = m.iter().flatten().map(Disc::magnitude).fold(0.0, f64::max) / h.mignitude() * UP;
    (normal.mignitude() > 0.0 && rotation > FAR).then_some([rotation, largest])
}
