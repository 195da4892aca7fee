//! Functions of second order: singular vectors that turn with the offsets.
//!
//! With fixed vectors `|J(t) v|` exceeds `sigma_6(t)` by the square of the distance from the middle of the box, because the singular vector turns. Let
//! `v(t) = v + sum_j d_j v'_j`, `d = t - middle`, turn with it. Whatever `v`, `v'_j` and `w` are, offsets that reach the limit `g` satisfy
//!
//! ```text
//! F(t) = |J v(t)|^2 - g^2 |v(t)|^2 |J w|^2 / |w|^2 >= 0,      J v(t): row i is (N_i(t_i) . v(t)) / sqrt(q_i(t_i)),
//! ```
//!
//! since `|J v| >= sigma_6 |v| >= g sigma_1 |v| >= g |v| |J w| / |w|`. A combination with multipliers `mu_k >= 0` is bounded from above on the box by its value and
//! gradient in the middle and its Hessian over the box (Taylor, Lagrange's remainder), all in balls.

use nalgebra::{Matrix6, SVD};

use super::ball::{Ball, dot};
use super::multipliers::{SAMPLES, Sampled, multipliers};
use super::rows::LegRow;
use crate::offsets::conditioning::PoseLegs;
use crate::offsets::limits::Bounds;

/// A vector that turns with the offsets, and one that stays, for one pose.
#[derive(Debug, Clone)]
pub(super) struct Turning {
    low: [f64; 6],
    /// `v'_j`.
    rates: [[f64; 6]; 6],
    high: [f64; 6],
}

fn column(m: &Matrix6<f64>, k: usize) -> [f64; 6] {
    std::array::from_fn(|c| m[(c, k)])
}

impl Turning {
    /// The singular vectors in the middle of the box and the rates at which that of the least singular value turns; `None` when the
    /// decomposition fails.
    ///
    /// `v'_j = - sum_o v_o (sigma_6 u_6j (r'_j . v_o) + sigma_o u_oj (r'_j . v_6)) / (sigma_o^2 - sigma_6^2)`; a denominator that is small
    /// on the box is enlarged, so that the vector turns by less than it has room for.
    pub(super) fn of(pose: &PoseLegs, bounds: &Bounds) -> Option<Self> {
        let middle = bounds.map(|(low, high)| f64::midpoint(low, high));
        let rows = pose.rows(&middle);
        let svd = SVD::try_new(rows.value, true, true, f64::EPSILON, 200)?;
        let (u, v) = (svd.u?, svd.v_t?.transpose());
        let sigma = svd.singular_values;
        let mut order = [0, 1, 2, 3, 4, 5];
        order.sort_by(|&a, &b| sigma[a].total_cmp(&sigma[b]));
        let (least, greatest) = (order[0], order[5]);
        let pull = rows.rate * v;
        let mut rates = [[0.0; 6]; 6];
        for o in order.into_iter().skip(1) {
            let numerator: [f64; 6] = std::array::from_fn(|j| {
                sigma[least] * u[(j, least)] * pull[(j, o)] + sigma[o] * u[(j, o)] * pull[(j, least)]
            });
            let reach: f64 = (0..6).map(|j| numerator[j].abs() * (bounds[j].1 - bounds[j].0)).sum();
            let gap = sigma[o] * sigma[o] - sigma[least] * sigma[least];
            let denominator = gap.hypot(reach);
            if denominator > 0.0 {
                for j in 0..6 {
                    for c in 0..6 {
                        rates[j][c] -= v[(c, o)] * numerator[j] / denominator;
                    }
                }
            }
        }
        let finite = sigma.iter().chain(rates.iter().flatten()).all(|x| x.is_finite());
        finite.then(|| Self { low: column(&v, least), rates, high: column(&v, greatest) })
    }
}

/// `F`: value and gradient in the middle of the box, Hessian over the box.
#[derive(Debug, Clone)]
pub(super) struct Curved {
    value: Ball,
    gradient: [Ball; 6],
    hessian: [[Ball; 6]; 6],
}

/// One leg on a range of its offset: row, inverse of the squared length and two derivatives of that.
struct Leg {
    row: [Ball; 6],
    rate: [Ball; 6],
    inverse: [Ball; 3],
}

impl Leg {
    fn on(row: &LegRow, t: Ball) -> Option<Self> {
        let (constant, rate, q) = row.balls();
        let (middle, step) = (Ball::point(t.c), Ball { c: 0.0, r: t.r });
        let at_middle = q[1] + middle.twice() * q[2];
        let square = q[0] + middle * (q[1] + middle * q[2]) + step * (at_middle + step * q[2]);
        let slope = at_middle + step.twice() * q[2];
        let s = square.inverse()?;
        let first = Ball::ZERO - slope * s.square();
        let second = s.square() * (slope.square() * s - q[2]).twice();
        let row = std::array::from_fn(|k| constant[k] + t * rate[k]);
        Some(Self { row, rate: *rate, inverse: [s, first, second] })
    }
}

/// The function and two derivatives where legs, vector and distances from the middle are within their balls.
struct Parts {
    /// `|J v|^2`, its gradient and Hessian.
    low: (Ball, [Ball; 6], [[Ball; 6]; 6]),
    /// `|J w|^2`, its gradient and the diagonal of its Hessian.
    high: (Ball, [Ball; 6], [Ball; 6]),
}

impl Parts {
    fn of(legs: &[Leg; 6], v: &[Ball; 6], rates: &[[Ball; 6]; 6], w: &[Ball; 6]) -> Self {
        let zero = Ball::ZERO;
        let mut low = (zero, [zero; 6], [[zero; 6]; 6]);
        let mut high = (zero, [zero; 6], [zero; 6]);
        for (i, leg) in legs.iter().enumerate() {
            let [s, s1, s2] = leg.inverse;
            let y = dot(&leg.row, v);
            let own_rate = dot(&leg.rate, v);
            let slope: [Ball; 6] = std::array::from_fn(|j| {
                let turned = dot(&leg.row, &rates[j]);
                if i == j { turned + own_rate } else { turned }
            });
            let bend: [Ball; 6] = std::array::from_fn(|j| dot(&leg.rate, &rates[j]));
            let (sy, s1y) = (s * y, s1 * y);
            low.0 = low.0 + sy * y;
            for j in 0..6 {
                low.1[j] = low.1[j] + (sy * slope[j]).twice();
                let scaled = s * slope[j];
                for l in j..6 {
                    low.2[j][l] = low.2[j][l] + (scaled * slope[l]).twice();
                }
                // what leg i adds for its own offset
                let mixed = (sy * bend[j] + s1y * slope[j]).twice();
                let (a, b) = (i.min(j), i.max(j));
                low.2[a][b] = low.2[a][b] + if i == j { mixed.twice() } else { mixed };
            }
            low.1[i] = low.1[i] + s1y * y;
            low.2[i][i] = low.2[i][i] + s2 * y.square();
            let (z, z1) = (dot(&leg.row, w), dot(&leg.rate, w));
            let zz = z.square();
            high.0 = high.0 + s * zz;
            high.1[i] = (s * z * z1).twice() + s1 * zz;
            high.2[i] = (s * z1.square() + (s1 * z * z1).twice()).twice() + s2 * zz;
        }
        Self { low, high }
    }
}

impl Curved {
    /// `limit` is `g^2`. `None` where a leg may have no length.
    pub(super) fn new(rows: &[LegRow; 6], turning: &Turning, bounds: &Bounds, limit: Ball) -> Option<Self> {
        let places: [Ball; 6] = bounds.map(|(low, high)| around(low, high));
        let legs = |of: &dyn Fn(usize) -> Ball| -> Option<[Leg; 6]> {
            let all: Option<Vec<Leg>> = (0..6).map(|i| Leg::on(&rows[i], of(i))).collect();
            all?.try_into().ok()
        };
        let (there, here) = (legs(&|i| places[i])?, legs(&|i| Ball::point(places[i].c))?);
        let rates = turning.rates.map(|r| r.map(Ball::point));
        let w = turning.high.map(Ball::point);
        let v = turning.low.map(Ball::point);
        let steps = places.map(|p| Ball { c: 0.0, r: p.r });
        let turned: [Ball; 6] =
            std::array::from_fn(|c| (0..6).fold(v[c], |sum, j| sum + steps[j] * rates[j][c]));
        let norm = dot(&w, &w).inverse()?;
        let limit = limit * norm;
        let middle = Parts::of(&here, &v, &rates, &w);
        let box_ = Parts::of(&there, &turned, &rates, &w);
        let size = |v: &[Ball; 6]| dot(v, v);
        let size_slope = |v: &[Ball; 6], j: usize| dot(v, &rates[j]).twice();
        let value = middle.low.0 - limit * size(&v) * middle.high.0;
        let gradient = std::array::from_fn(|j| {
            middle.low.1[j] - limit * (size(&v) * middle.high.1[j] + size_slope(&v, j) * middle.high.0)
        });
        let n = size(&turned);
        let slopes: [Ball; 6] = std::array::from_fn(|j| size_slope(&turned, j));
        let mut hessian = [[Ball::ZERO; 6]; 6];
        for j in 0..6 {
            for l in j..6 {
                let mut second = box_.high.0 * dot(&rates[j], &rates[l]).twice()
                    + slopes[j] * box_.high.1[l]
                    + slopes[l] * box_.high.1[j];
                if j == l {
                    second = second + n * box_.high.2[j];
                }
                hessian[j][l] = box_.low.2[j][l] - limit * second;
                hessian[l][j] = hessian[j][l];
            }
        }
        Some(Self { value, gradient, hessian })
    }

    /// Values at samples of the offsets as if the function had no mixed derivatives: for the choice of multipliers only.
    fn sampled(&self, reach: &[f64; 6]) -> Sampled {
        std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                let d = reach[i] * (2.0 * k as f64 / (SAMPLES - 1) as f64 - 1.0);
                self.value.c / 6.0 + d * (self.gradient[i].c + 0.5 * d * self.hessian[i][i].c)
            })
        })
    }
}

/// A ball about the middle that holds the range; its centre is the middle as rounded.
fn around(low: f64, high: f64) -> Ball {
    let c = f64::midpoint(low, high);
    Ball { c, r: (high - c).max(c - low).next_up() }
}

/// `true` when a combination of the functions is below 0 on the whole box: proved.
pub(super) fn excluded(functions: &[Curved], bounds: &Bounds) -> bool {
    let reach = bounds.map(|(low, high)| around(low, high).r);
    let samples: Vec<Sampled> = functions.iter().map(|f| f.sampled(&reach)).collect();
    let Some(mu) = multipliers(&samples) else { return false };
    let mut sum = Curved { value: Ball::ZERO, gradient: [Ball::ZERO; 6], hessian: [[Ball::ZERO; 6]; 6] };
    for (mu, f) in mu.into_iter().zip(functions).filter(|(mu, _)| *mu > 0.0) {
        let mu = Ball::point(mu);
        sum.value = sum.value + mu * f.value;
        for j in 0..6 {
            sum.gradient[j] = sum.gradient[j] + mu * f.gradient[j];
            for l in 0..6 {
                sum.hessian[j][l] = sum.hessian[j][l] + mu * f.hessian[j][l];
            }
        }
    }
    greatest(&sum, &reach) < 0.0
}

/// More than the roundings of the sums below, relative to the sum of the sizes of their terms.
const GUARD: f64 = 1e-12;

/// An upper bound of `f + g . d + d^T H d / 2` over `|d_i| <= reach_i` for all numbers within their balls.
///
/// With `y_i = d_i / reach_i` the radii cost at most their sum. Of the matrix of the centres either the rows are bounded by their sums (Gershgorin 1931), or first
/// its negative part `-M M^T` is left out, which is not above 0; what rounding leaves of the difference goes to the radii.
fn greatest(sum: &Curved, reach: &[f64; 6]) -> f64 {
    let h = Matrix6::from_fn(|j, l| sum.hessian[j][l].c * reach[j] * reach[l]);
    let radius = |j: usize, l: usize| sum.hessian[j][l].r * reach[j] * reach[l];
    let gradient: [f64; 6] = std::array::from_fn(|j| sum.gradient[j].c.abs() * reach[j]);
    let mut fixed = sum.value.c + sum.value.r;
    let mut sizes = sum.value.c.abs() + sum.value.r;
    for j in 0..6 {
        let wobble = sum.gradient[j].r * reach[j] + 0.5 * (0..6).map(|l| radius(j, l)).sum::<f64>();
        fixed += wobble;
        sizes += wobble + gradient[j] + h.column(j).iter().map(|x| x.abs()).sum::<f64>();
    }
    let on_rows = |m: &Matrix6<f64>| -> f64 {
        let of = |j: usize| {
            let bend = m[(j, j)] + (0..6).filter(|l| *l != j).map(|l| m[(j, l)].abs()).sum::<f64>();
            // greatest value of g y + bend y^2 / 2 for |y| <= 1
            if bend >= 0.0 || gradient[j] >= -bend {
                gradient[j] + 0.5 * bend
            } else {
                -0.5 * gradient[j] * gradient[j] / bend
            }
        };
        (0..6).map(of).sum()
    };
    let plain = fixed + on_rows(&h) + GUARD * sizes;
    if plain < 0.0 || !plain.is_finite() {
        return if plain.is_finite() { plain } else { f64::INFINITY };
    }
    let e = h.symmetric_eigen();
    let m = Matrix6::from_fn(|j, k| e.eigenvectors[(j, k)] * (-e.eigenvalues[k]).max(0.0).sqrt());
    let back = m * m.transpose();
    let positive = Matrix6::from_fn(|j, l| h[(j, l)] + back[(j, l)]);
    // the product is rounded entry by entry
    let all: f64 = m.iter().map(|x| x * x).sum::<f64>() * 6.0;
    let above = fixed + on_rows(&positive) + GUARD * (sizes + all);
    if above.is_finite() { above.min(plain) } else { plain }
}
