//! Three corners on three circles, and Krawczyk's test for their angles, eight centres at once.
//!
//! **Circles.** Two legs to neighbouring base joints `A`, `B` put a corner of the platform on a circle about the line
//! `AB`. In the frame of the base triangle it is `m + h a + z n` with `h^2 + z^2 = rho`. Here `m` is a point of `AB`,
//! `a` is across `AB` in the plane of the base, and `n` is normal to that plane. With `u = h + i z`, `v = h - i z` that
//! is `u v = rho`. If `rho != 0`, `u = c exp(t)`, `v = rho / u` for any `c != 0` run through the circle over the
//! complex numbers; `t` is `i` times an angle. A corner so given is on its circle whatever `u` is. It has all its
//! digits even when `h` and `z` are large and nearly `+- i` times each other.
//!
//! **Gaps.** For corners on two circles, `(u, v)` for `P` and `(p, q)` for `Q`, with `m` the difference of the middles
//! `m_P - m_Q`,
//!
//! ```text
//! G = |P - Q|^2 - d = c + a (u + v) + b (p + q) + A (u p + v q) - B (u q + v p)
//! c = m.m + rho_P + rho_Q - d,   a = m.a_P,   b = -m.a_Q,   A = (1 - a_P.a_Q) / 2,   B = (1 + a_P.a_Q) / 2
//! dG/dt_P = a (u - v) + A (u p - v q) - B (u q - v p),   dG/dt_Q = b (p - q) + A (u p - v q) + B (u q - v p)
//! ```
//!
//! The poses are the common zeros of the three gaps `45, 56, 64`.
//!
//! **The test.** Norm: the largest modulus of the three `t`. Within [`REACH`] no `u`, `v` grows by more than
//! `exp(REACH)`. With bounds `U, V, P, Q` of the four there the second derivatives are at most `|a| (U + V) + X`, `X`
//! and `|b| (P + Q) + X`, `X = A (U P + V Q) + B (U Q + V P)`, and
//!
//! ```text
//! q = (|a| (U + V) + |b| (P + Q)) / 2 + 2 X,
//! |Y G(c)| <= eta,   |I - Y J(c)| <= kappa,   beta = max_k sum_i |Y_ki| q_i
//! ```
//!
//! take the places of the numbers of the same names in the theorem of `docs/theory/certificates.md`. The remainder
//! `R(h)` of `G(c) + J h` has `|R_i(h)| <= q_i |h|^2` and `|R_i(h) - R_i(k)| <= q_i (|h| + |k|) |h - k|`, by the mean
//! of the derivative along the way.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::U;
use super::arithmetic::{CertifiedTriangle, Discs, Reals, reciprocal, root, sizes};
use num::ball::{Real, UP};
use num::batch::{ComplexBatch, LANES};

/// The sides of the base triangle about which `P4`, `P5`, `P6` turn: `P1 P2`, `P2 P3`, `P3 P1`, in the frame of the
/// triangle.
#[derive(Debug, Clone)]
pub(super) struct BaseSides {
    start: [[Real; 2]; 3],
    length: [Real; 3],
    along: [[Real; 2]; 3],
    /// `a`: across the side, in the plane.
    pub(super) across: [[Real; 2]; 3],
    /// `A` and `B` for the circle `k` and the one after it.
    mixed: [[Real; 2]; 3],
}

impl BaseSides {
    pub(super) fn of(t: &CertifiedTriangle) -> Self {
        let (zero, one) = (Real::ZERO, Real::point(1.0));
        let long = |square: Real, by: [Real; 2]| {
            let length = root(square);
            let inverse = reciprocal(length);
            (length, by.map(|x| x * inverse))
        };
        let (second, along2) = long(t.opposite, [t.u - t.len, t.v]);
        let (third, along3) = long(t.cc, [-t.u, -t.v]);
        let along = [[one, zero], along2, along3];
        let across = along.map(|[x, y]| [-y, x]);
        let cosine = |k: usize, l: usize| along[k][0] * along[l][0] + along[k][1] * along[l][1];
        Self {
            start: [[zero, zero], [t.len, zero], [t.u, t.v]],
            length: [t.len, second, third],
            along,
            across,
            mixed: [cosine(0, 1), cosine(1, 2), cosine(2, 0)]
                .map(|c| [(one - c).scaled(0.5), (one + c).scaled(0.5)]),
        }
    }

    /// The circles for squared lengths `s14 s24 s25 s35 s36 s16`.
    #[inline(always)]
    pub(super) fn circles(&self, s: &[Real; 6]) -> [CornerCircle; 3] {
        [0, 1, 2].map(|k| {
            let length = self.length[k];
            let (from, to) = (s[2 * k], s[2 * k + 1]);
            let foot = (from + length * length - to).scaled(0.5) * reciprocal(length);
            let middle = [0, 1].map(|i| self.start[k][i] + foot * self.along[k][i]);
            CornerCircle { middle, squared_radius: from - foot * foot }
        })
    }

    /// The gaps `45, 56, 64`, with `d` their squared distances.
    #[inline(always)]
    pub(super) fn gaps(&self, circles: &[CornerCircle; 3], d: [Real; 3]) -> [CornerGap; 3] {
        [0, 1, 2].map(|k| {
            let l = (k + 1) % 3;
            let (p, q) = (&circles[k], &circles[l]);
            let m = [p.middle[0] - q.middle[0], p.middle[1] - q.middle[1]];
            let dot = |a: &[Real; 2]| m[0] * a[0] + m[1] * a[1];
            let constant = m[0] * m[0] + m[1] * m[1] + p.squared_radius + q.squared_radius - d[k];
            CornerGap {
                constant,
                first: dot(&self.across[k]),
                second: -dot(&self.across[l]),
                mixed: self.mixed[k],
            }
        })
    }
}

/// The circle of a corner that is held by its two legs.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerCircle {
    /// Centre in the plane of the base.
    pub(super) middle: [Real; 2],
    pub(super) squared_radius: Real,
}

/// Coefficients `c`, `a`, `b`, `(A, B)`.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerGap {
    constant: Real,
    first: Real,
    second: Real,
    mixed: [Real; 2],
}

/// `(u, v)` of a corner.
pub(super) type OnCircle = [ComplexBatch; 2];
pub(super) type DiscOnCircle = [Discs; 2];

impl CornerGap {
    /// The gap and its derivatives by both `t`, rounded.
    #[inline(always)]
    fn rounded(&self, [u, v]: &OnCircle, [p, q]: &OnCircle) -> [ComplexBatch; 3] {
        let (a, b, [same, other]) = (self.first.centre, self.second.centre, self.mixed.map(|x| x.centre));
        let (up, vq, uq, vp) = (*u * *p, *v * *q, *u * *q, *v * *p);
        let (along, across) = ((up - vq).times(same), (uq - vp).times(other));
        let value = (*u + *v).times(a) + (*p + *q).times(b) + (up + vq).times(same) - (uq + vp).times(other);
        let (turned_u, turned_p) = ((*u - *v).times(a) + along, (*p - *q).times(b) + along);
        [value.plus(self.constant.centre), turned_u - across, turned_p + across]
    }

    /// Bounds of the errors of [`rounded`](Self::rounded), alike for all three, and `q`. `[u, v]`, `[p, q]` are moduli,
    /// where `v` and `q` are known up to `loose` times theirs.
    ///
    /// A term passes seven roundings at most, that of a complex product counted by its bound `sqrt 5 U`; the
    /// coefficients have their radii.
    #[inline(always)]
    fn errors(&self, [u, v]: &[Reals; 2], [p, q]: &[Reals; 2], loose: [f64; 2]) -> [Reals; 2] {
        let ([uv, pq], [same, other]) = ([*u + *v, *p + *q], [*u * *p + *v * *q, *u * *q + *v * *p]);
        let (a, b, [m, n]) = (self.first, self.second, self.mixed);
        let (ma, mb, mm, mn) = (a.magnitude(), b.magnitude(), m.magnitude(), n.magnitude());
        let linear = uv.times(ma) + pq.times(mb);
        let mixed = same.times(mm) + other.times(mn);
        let by_v = *v * (q.times(mm) + p.times(mn)).plus(ma);
        let by_q = *q * (v.times(mm) + u.times(mn)).plus(mb);
        let unknown = uv.times(a.radius) + pq.times(b.radius) + same.times(m.radius) + other.times(n.radius);
        let constant = self.constant.radius + 2.0 * U * self.constant.centre.abs();
        let data = by_v.times(loose[0]) + by_q.times(loose[1]) + unknown.plus(constant);
        let error = (linear + mixed).times(10.0 * U) + data;
        let bend = linear.times(0.5 * STRETCH) + mixed.times(2.0 * STRETCH * STRETCH);
        [error.up(), bend.up()]
    }
}

/// Largest `|t|` within which second derivatives are bounded.
const REACH: f64 = 1.0 / 16.0;
/// More than `exp(REACH)`.
const STRETCH: f64 = 1.065;

/// The three rows and columns of the matrix of derivatives that are not zero: `(row, column, derivative)`.
const ENTRIES: [(usize, usize, usize); 6] =
    [(0, 0, 1), (0, 1, 2), (1, 1, 1), (1, 2, 2), (2, 2, 1), (2, 0, 2)];

/// An approximate inverse of the derivatives, by Cramer's rule.
#[inline(always)]
fn inverse(gaps: &[[ComplexBatch; 3]; 3]) -> [[ComplexBatch; 3]; 3] {
    let [[_, a4, a5], [_, b5, b6], [_, c6, c4]] = *gaps;
    let (b5c6, b6c4, a4b5) = (b5 * c6, b6 * c4, a4 * b5);
    let det = (a4 * b5c6 + a5 * b6c4).reciprocal();
    let negative = det.times(-1.0);
    [
        [b5c6 * det, (a5 * c6) * negative, (a5 * b6) * det],
        [b6c4 * det, (a4 * c6) * det, (a4 * b6) * negative],
        [(b5 * c4) * negative, (a5 * c4) * det, a4b5 * det],
    ]
}

/// Discs that hold exactly one zero each, with the proof's numbers lane by lane; radii that prove nothing are NaN.
pub(super) struct ZeroDiscs {
    /// `u` of each corner: the centre.
    pub(super) centres: [ComplexBatch; 3],
    /// The zero is at most this far from the centre.
    pub(super) radius: Reals,
    /// There is no other zero at most this far from the centre.
    pub(super) uniqueness: Reals,
    /// `|Y G(c)|`.
    pub(super) step: Reals,
    /// Lipschitz constant of the map on the ball of the radius.
    pub(super) lipschitz: Reals,
    /// `|J| |Y|`, with gaps scaled to gradients of size one: no bound, an estimate.
    pub(super) condition: Reals,
    /// `(h, z)` of the corners of the centre.
    pub(super) corners: [DiscOnCircle; 3],
    /// Their derivatives by `t`, rounded, and bounds of `|u| + |v|`.
    pub(super) directions: [OnCircle; 3],
    pub(super) sizes: [Reals; 3],
    /// `(h, z)` of the corners of the zero.
    pub(super) places: [DiscOnCircle; 3],
    /// See [`from_conjugate`].
    pub(super) conjugates: [Reals; 2],
}

/// `(u, v)` of corners with these `u`.
#[inline(always)]
fn corners_at(circles: &[CornerCircle; 3], u: &[ComplexBatch; 3]) -> [OnCircle; 3] {
    let mut out = [[ComplexBatch::ZERO; 2]; 3];
    for k in 0..3 {
        out[k] = [u[k], u[k].reciprocal().times(circles[k].squared_radius.centre)];
    }
    out
}

/// The three gaps with their derivatives, rounded.
#[inline(always)]
fn gaps_at(gaps: &[CornerGap; 3], corners: &[OnCircle; 3]) -> [[ComplexBatch; 3]; 3] {
    let mut out = [[ComplexBatch::ZERO; 3]; 3];
    for k in 0..3 {
        out[k] = gaps[k].rounded(&corners[k], &corners[(k + 1) % 3]);
    }
    out
}

/// Decides for each lane whether some disc about the corners `(h, z)` given holds exactly one zero of the three gaps.
/// One Newton step comes first.
#[inline(always)]
pub(super) fn one_zero_about(
    circles: &[CornerCircle; 3],
    gaps: &[CornerGap; 3],
    given: &[OnCircle; 3],
) -> ZeroDiscs {
    // loops all through: `map` of an array of batches is now and then a function of its own, compiled without vector
    // units
    let mut centres = [ComplexBatch::ZERO; 3];
    for k in 0..3 {
        centres[k] = larger(&given[k], circles[k].squared_radius.centre);
    }
    let first = gaps_at(gaps, &corners_at(circles, &centres));
    let y = inverse(&first);
    for k in 0..3 {
        let t = (y[k][0] * first[0][0] + y[k][1] * first[1][0] + y[k][2] * first[2][0]).times(-1.0);
        centres[k] = centres[k] * (t.plus(1.0) + (t * t).times(0.5));
    }
    let corners = corners_at(circles, &centres);
    let (mut moduli, mut conjugates) = ([[Reals::ZERO; 2]; 3], [Reals::ZERO; 2]);
    let mut loose = [0.0_f64; 3];
    for k in 0..3 {
        let rho = circles[k].squared_radius;
        let relative = rho.radius / (rho.centre.abs() - rho.radius);
        // of the squared radius, and of the reciprocal by its bound in `Discs`
        loose[k] = if relative >= 0.0 { relative * UP + 16.0 * U } else { f64::NAN };
        moduli[k] = moduli_of(&corners[k], loose[k]);
        let new = from_conjugate(&centres[k], rho);
        conjugates = [conjugates[0].largest(new[0]), conjugates[1].largest(new[1])];
    }
    let j = gaps_at(gaps, &corners);
    let mut bounds = [[Reals::ZERO; 2]; 3];
    for k in 0..3 {
        let l = (k + 1) % 3;
        bounds[k] = gaps[k].errors(&moduli[k], &moduli[l], [loose[k], loose[l]]);
    }
    let (mut eta, mut kappa, mut beta, mut condition) = (Reals::ZERO, Reals::ZERO, Reals::ZERO, Reals::ZERO);
    // of each entry: its size, and its error with that of a product with it
    let mut gradients = [[Reals::ZERO; 2]; 3];
    for i in 0..3 {
        gradients[i] = [sizes(&j[i][1]), sizes(&j[i][2])];
    }
    for k in 0..3 {
        let size = [sizes(&y[k][0]), sizes(&y[k][1]), sizes(&y[k][2])];
        let step = y[k][0] * j[0][0] + y[k][1] * j[1][0] + y[k][2] * j[2][0];
        let mut products = [ComplexBatch::ZERO; 3];
        for (i, l, derivative) in ENTRIES {
            products[l] = products[l] + y[k][i] * j[i][derivative];
        }
        products[k] = products[k].plus(-1.0);
        let (mut error, mut turned, mut slope) = (Reals::ZERO, Reals::ZERO, Reals::ZERO);
        for i in 0..3 {
            error = error + size[i] * (bounds[i][0] + sizes(&j[i][0]).times(6.0 * U));
            // both entries of a row have the same error
            let entries = gradients[i][0] + gradients[i][1];
            turned = turned + size[i] * (bounds[i][0].times(2.0) + entries.times(6.0 * U));
            slope = slope + size[i] * entries;
        }
        eta = eta.largest(sizes(&step) + error);
        let defect = sizes(&products[0]) + sizes(&products[1]) + sizes(&products[2]);
        kappa = kappa.largest(defect + turned + Reals::all(6.0 * U));
        beta = beta.largest(size[0] * bounds[0][1] + size[1] * bounds[1][1] + size[2] * bounds[2][1]);
        condition = condition.largest(slope);
    }
    let (eta, kappa, beta) = (eta.up(), kappa.up(), beta.up());
    let (radius, uniqueness) = radii(eta, kappa, beta);
    let lipschitz = (kappa + (beta * radius).times(2.0)).up();
    // |exp(t) - 1| <= exp(r) - 1 <= r (1 + r) for r <= 1
    let moved = (radius * radius.plus(1.0)).up();
    let mut out = ZeroDiscs {
        centres,
        radius,
        uniqueness,
        step: eta,
        lipschitz,
        condition,
        corners: [[Discs::ZERO; 2]; 3],
        directions: [[ComplexBatch::ZERO; 2]; 3],
        sizes: [Reals::ZERO; 3],
        places: [[Discs::ZERO; 2]; 3],
        conjugates,
    };
    for k in 0..3 {
        let [u, v] = corners[k];
        let size = (moduli[k][0] + moduli[k][1]).up();
        // half the sum of u and v: one rounding, and the uncertainty of v
        let blur = (size.times(U) + moduli[k][1].times(loose[k])).up();
        let [h, z] = [(u + v).times(0.5), (v - u).times_i().times(0.5)];
        out.corners[k] = [Discs { c: h, r: blur }, Discs { c: z, r: blur }];
        // the derivative of (u + v) / 2 is (u - v) / 2, that of (u - v) / 2i is (u + v) / 2i
        out.directions[k] = [z.times_i(), h.times_i().times(-1.0)];
        out.sizes[k] = size;
        let r = (blur + (size * moved).times(0.5)).up();
        out.places[k] = [Discs { c: h, r }, Discs { c: z, r }];
    }
    out
}

/// Upper bounds of `|u|` and `|v|` when `v` is known up to `loose` times its modulus. A squared radius known within
/// wide bounds makes this more than the slack of [`STRETCH`].
#[inline(always)]
fn moduli_of([u, v]: &OnCircle, loose: f64) -> [Reals; 2] {
    [modulus(u), modulus(v).times(1.0 + loose).up()]
}

/// Upper bounds of the moduli.
#[inline(always)]
fn modulus(z: &ComplexBatch) -> Reals {
    Reals(z.norm_sqr()).up().map(f64::sqrt).up()
}

/// `u` of a corner near the circle, from `h + i z` or `h - i z`, whichever is larger.
#[inline(always)]
fn larger([h, z]: &OnCircle, rho: f64) -> ComplexBatch {
    let iz = z.times_i();
    let (u, v) = (*h + iz, *h - iz);
    let (nu, nv) = (u.norm_sqr(), v.norm_sqr());
    let mut first = [false; LANES];
    for k in 0..LANES {
        first[k] = nu[k] >= nv[k];
    }
    u.select(v.reciprocal().times(rho), first)
}

/// Distance of a centre from its conjugate: bounds from above and below of `|log(rho / |u|^2)|`. The first is NaN when
/// the circle may have no real points, the second infinite when it has none.
///
/// The conjugate of the corner with `u` has `conj(v) = rho / conj(u) = u rho / |u|^2` in its place: for `rho > 0` it is
/// at `t = log(rho / |u|^2)`, which is real. A corner at `t` is real only for `2 Re t = log(rho / |u|^2)`.
#[inline(always)]
fn from_conjugate(u: &ComplexBatch, rho: Real) -> [Reals; 2] {
    let (low, high) = (rho.centre - rho.radius, rho.centre + rho.radius);
    let (mut above, mut below) = (Reals::ZERO, Reals::ZERO);
    for k in 0..LANES {
        let square = u.re[k] * u.re[k] + u.im[k] * u.im[k];
        let gap = (rho.centre - square).abs();
        let blur = (rho.radius + (square + rho.centre.abs()) * (4.0 * f64::EPSILON)) * UP;
        let (least, most) = (low.min(square) * (2.0 - UP), high.max(square) * UP);
        above.0[k] = if low > 0.0 { (gap + blur) / least * UP } else { f64::NAN };
        below.0[k] = if high < 0.0 { f64::INFINITY } else { (gap - blur) / most * (2.0 - UP) };
    }
    [above, below]
}

/// Radii of the ball that holds the zero and of that in which it is alone, NaN where there is no proof.
#[inline(always)]
fn radii(eta: Reals, kappa: Reals, beta: Reals) -> (Reals, Reals) {
    let (mut radius, mut uniqueness) = (Reals::ZERO, Reals::ZERO);
    for k in 0..LANES {
        let (eta, kappa, beta) = (eta.0[k], kappa.0[k], beta.0[k]);
        let contraction_gap = 1.0 - kappa;
        let root = (contraction_gap * contraction_gap - 4.0 * beta * eta).sqrt();
        // the smaller root of beta r^2 - contraction_gap r + eta, a little enlarged; the proof is the check below
        let r = 2.0 * eta / (contraction_gap + root) * (1.0 + 1e-3);
        let inside = (eta + kappa * r + beta * r * r) * UP <= r;
        let contracts = (kappa + 2.0 * beta * r) * UP < 1.0;
        // both balls lie where the second derivatives are bounded
        let wide = contraction_gap / beta * (1.0 - 1e-9) - r;
        let wide = if wide < REACH { wide } else { REACH };
        let alone = wide > r * (1.0 + 1e-9) && (kappa + beta * (r + wide)) * UP < 1.0;
        let proved = inside && contracts && alone && kappa < 1.0 && r < REACH;
        radius.0[k] = if proved { r } else { f64::NAN };
        uniqueness.0[k] = if proved { wide } else { f64::NAN };
    }
    (radius, uniqueness)
}

#[cfg(test)]
mod tests;
