//! The bounds of the theorem with 256 bits, for roots whose Jacobian no double can tell from a singular one.
//!
//! Near special platforms the equations at a pose far out differ in the twentieth digit only. The approximate inverse
//! of the Jacobian, and all its factors in products, need more digits than that. Statement and proof are those of the
//! [`krawczyk`](super::krawczyk) module; centre, inverse, values and gradients have 256 bits here.
//!
//! **Error bounds.** An operation has a relative error below `2^-252` in each part. Values, gradients and their
//! products with the inverse are sums of products in which no term passes through more than 200 roundings. So errors
//! are below [`ERROR`] `= 2^-240` times the sum of the terms' moduli (Higham 2002, lemma 3.1). That sum is at most
//! `m_i` for values and `j_i` for rows of the Jacobian, in the notation of the `system` module. Moduli are those of
//! both parts added.
//!
//! * `m_i = 8 (G + t_i E)^2 + 8 |s_i| P`, and `8 E G` for `e.g`.
//! * `j_i = 16 (1 + t_i) (G + t_i E) + 8 |s_i| E`, and `8 (E + G)` for `e.g`.
//!
//! Radii of squared lengths and joints add the same as in the `system` module, with `V_i = 2 (G + t_i E)`.

use num_complex::Complex64;

use super::certificate::WhyUncertified;
use super::krawczyk::{KrawczykBounds, largest};
use super::system::{LegSystem, N, Study};
use num::ball::UP;
use num::double_double::DoubleDouble;
use num::octuple::{ComplexOctuple, Octuple, OctupleLu};

/// See the module's text.
const ERROR: f64 = 1.0 / ((1u128 << 120) as f64 * (1u128 << 120) as f64);

fn octuple(x: DoubleDouble) -> Octuple {
    Octuple::from(x.hi()) + Octuple::from(x.lo())
}

/// `|re| + |im|`, not below the modulus.
fn modulus(z: ComplexOctuple) -> f64 {
    (z.re.rounded().abs() + z.im.rounded().abs()) * UP
}

fn dot(a: &[ComplexOctuple], b: &[ComplexOctuple]) -> ComplexOctuple {
    a.iter().zip(b).fold(ComplexOctuple::ZERO, |sum, (x, y)| sum + *x * *y)
}

/// Rows of `T = [0 -d^T; d -[c]x]`.
fn turns(system: &LegSystem, i: usize) -> [[Octuple; 4]; 4] {
    let whole = |high: &[f64; 3], low: &[f64; 3]| -> [Octuple; 3] {
        std::array::from_fn(|k| Octuple::from(high[k]) + Octuple::from(low[k]))
    };
    let (a, b) = (whole(&system.a[i], &system.a_low[i]), whole(&system.b[i], &system.b_low[i]));
    let d: [Octuple; 3] = std::array::from_fn(|k| b[k] - a[k]);
    let c: [Octuple; 3] = std::array::from_fn(|k| b[k] + a[k]);
    let zero = Octuple::ZERO;
    [
        [zero, -d[0], -d[1], -d[2]],
        [d[0], zero, c[2], -c[1]],
        [d[1], -c[2], zero, c[0]],
        [d[2], c[1], -c[0], zero],
    ]
}

/// One leg at the centre: `F_i`, its gradient by `(e, g)`, `T_i` and `s_i`.
struct LegAt {
    value: ComplexOctuple,
    gradient: [ComplexOctuple; 8],
    turn: [[Octuple; 4]; 4],
    s: Octuple,
}

fn leg_at(system: &LegSystem, i: usize, x: &[ComplexOctuple; 8]) -> LegAt {
    let turn = turns(system, i);
    let s = Octuple::from(system.s[i]) + Octuple::from(system.s_low[i]);
    let (e, g) = x.split_at(4);
    let image = |r: usize| (0..4).fold(ComplexOctuple::ZERO, |sum, k| sum + e[k].times(turn[r][k]));
    let v: [ComplexOctuple; 4] = std::array::from_fn(|r| g[r] + image(r));
    let value = (dot(&v, &v) - dot(e, e).times(s)).scaled(-1);
    let mut gradient = [ComplexOctuple::ZERO; 8];
    for k in 0..4 {
        let back = (0..4).fold(ComplexOctuple::ZERO, |sum, r| sum + v[r].times(turn[r][k]));
        gradient[k] = back - e[k].times(s);
        gradient[4 + k] = v[k];
    }
    LegAt { value, gradient, turn, s }
}

/// The bounds about `x` with 256 bits.
pub(super) fn bounds(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<KrawczykBounds, WhyUncertified> {
    let point: [ComplexOctuple; 8] =
        std::array::from_fn(|k| ComplexOctuple { re: octuple(x.re[k]), im: octuple(x.im[k]) });
    let legs: [LegAt; 6] = std::array::from_fn(|i| leg_at(system, i, &point));
    let mut values = [ComplexOctuple::ZERO; N];
    let mut rows = [[ComplexOctuple::ZERO; 8]; N];
    for (i, leg) in legs.iter().enumerate() {
        (values[i], rows[i]) = (leg.value, leg.gradient);
    }
    values[6] = dot(&point[..4], &point[4..]);
    rows[6][..4].copy_from_slice(&point[4..]);
    rows[6][4..].copy_from_slice(&point[..4]);
    // column `patch` holds the gradient by g_3, as everywhere here
    let jacobian: [[ComplexOctuple; N]; N] =
        std::array::from_fn(|i| std::array::from_fn(|k| rows[i][if k == x.patch { 7 } else { k }]));
    let lu = OctupleLu::factorise(jacobian).ok_or(WhyUncertified::SingularJacobian)?;
    // columns of the approximate inverse
    let columns: [[ComplexOctuple; N]; N] = std::array::from_fn(|i| {
        let mut unit = [ComplexOctuple::ZERO; N];
        unit[i].re = Octuple::ONE;
        lu.solve(&unit)
    });
    let (e, g, p) = x.rounded().magnitudes();
    let size = |i: usize| (g + system.t[i] * e, system.s[i].abs() + system.s_radius[i]);
    let value_size = |i: usize| {
        if i == 6 { 8.0 * e * g } else { 8.0 * (size(i).0 * size(i).0 + size(i).1 * p) }
    };
    let row_size = |i: usize| {
        if i == 6 { 8.0 * (e + g) } else { 16.0 * (1.0 + system.t[i]) * size(i).0 + 8.0 * size(i).1 * e }
    };
    let mut out =
        KrawczykBounds { eta_centre: 0.0, eta: 0.0, kappa: 0.0, beta: 0.0, step: [Complex64::ZERO; 8] };
    for k in 0..N {
        let y: [ComplexOctuple; N] = std::array::from_fn(|i| columns[i][k]);
        let weights = y.map(modulus);
        let along = |term: &dyn Fn(usize) -> f64| (0..N).map(|i| weights[i] * term(i)).sum::<f64>();
        let radius = |i: usize| if i < 6 { system.s_radius[i] } else { 0.0 };
        let joints = |i: usize, width: &dyn Fn(usize, f64) -> f64| {
            if i < 6 { width(i, 2.0 * size(i).0) } else { 0.0 }
        };
        let value_width =
            |i: usize| 0.5 * radius(i) * p + joints(i, &|i, v| system.low_joint_width_of_value(i, e, v));
        let row_width =
            |i: usize| 4.0 * radius(i) * e + joints(i, &|i, v| system.joint_width_of_gradient(i, e, v));
        let second_order_width =
            |i: usize| 1.5 * radius(i) + joints(i, &|i, _| system.joint_width_of_second_order(i));
        let step = dot(&y, &values);
        out.step[if k == x.patch { 7 } else { k }] = step.rounded();
        let centre = modulus(step) + ERROR * along(&value_size);
        let defect: f64 = (0..N)
            .map(|l| {
                let product = (0..N).fold(ComplexOctuple::ZERO, |sum, i| sum + y[i] * jacobian[i][l]);
                let one = if l == k { Octuple::ONE } else { Octuple::ZERO };
                modulus(product - ComplexOctuple { re: one, im: Octuple::ZERO })
            })
            .sum();
        let beta =
            second_order(&legs, &y, x.patch) + ERROR * along(&|i| system.q[i]) + along(&second_order_width);
        out.eta_centre = largest(out.eta_centre, centre);
        out.eta = largest(out.eta, centre + along(&value_width));
        out.kappa = largest(out.kappa, defect + ERROR * along(&row_size) + along(&row_width));
        out.beta = largest(out.beta, beta);
    }
    Ok(out.rounded_up())
}

/// The bound of the `second_order` module for a row of the inverse, rounding apart:
/// `2 |alpha| + 3 |y_7| + sum |T|_j over columns j != patch + 1/2 sum |S_ij|`.
fn second_order(legs: &[LegAt; 6], y: &[ComplexOctuple; N], patch: usize) -> f64 {
    let zero = ComplexOctuple::ZERO;
    let over = |term: &dyn Fn(&LegAt) -> Octuple| {
        modulus(legs.iter().zip(y).fold(zero, |sum, (leg, y)| sum + y.times(term(leg))))
    };
    let mut total = 2.0 * over(&|_| Octuple::ONE) + 3.0 * modulus(y[N - 1]);
    for j in (0..4).filter(|j| *j != patch) {
        for r in 0..4 {
            total += over(&|leg| leg.turn[r][j]);
        }
        for i in (0..4).filter(|i| *i != patch) {
            let entry = |leg: &LegAt| {
                let square = (0..4).fold(Octuple::ZERO, |sum, r| sum + leg.turn[r][i] * leg.turn[r][j]);
                if i == j { square - leg.s } else { square }
            };
            total += 0.5 * over(&entry);
        }
    }
    total * UP
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::certify::coordinates::study_of;
    use crate::solve::certify::krawczyk::{Centre, Digits, RootBall, one_root_about};
    use crate::solve::certify::refine::refine_study;
    use crate::solve::certify::system::RealScalar;
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::{Leg, Manipulator};

    fn known_pose(rng: &mut Rng) -> (Manipulator, Pose) {
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let m = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }))
            .unwrap();
        (m, Pose { rotation: random_rotation(rng), position: Vector3::new(0.3, -0.4, 1.2) })
    }

    /// A platform with a root known to the digits of double-double.
    fn known_root(rng: &mut Rng) -> (LegSystem, Study<DoubleDouble>) {
        let (m, pose) = known_pose(rng);
        let s = pose.squared_lengths(&m).unwrap();
        let system = LegSystem::new(&m, &(&s).into()).unwrap();
        let start = study_of(&pose.into(), system.unit()).unwrap();
        let refined = refine_study(&system, &start, f64::INFINITY).unwrap();
        (system, refined.x)
    }

    fn one_root(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<RootBall, WhyUncertified> {
        one_root_about(system, &Centre { hi: &x.rounded(), full: Some(x) }, Digits::Octuple)
    }

    #[test]
    fn the_ball_holds_the_root_however_far_the_centre_is_moved() {
        let rng = &mut Rng::new(0x9ec);
        for _ in 0..8 {
            let (system, root) = known_root(rng);
            let own = one_root(&system, &root).unwrap();
            assert!(own.radius < 1e-26 && own.uniqueness_radius > 1e-8, "{own:?}");
            for shift in [1e-20, 1e-14, 1e-10] {
                let mut centre = root;
                let k = (0..4).find(|k| *k != root.patch).unwrap();
                centre.im[k] = centre.im[k] + DoubleDouble::from(shift);
                let moved = one_root(&system, &centre).unwrap();
                // the root is at this distance, give or take its own uncertainty
                assert!(
                    moved.radius >= shift * (1.0 - 1e-5) && moved.radius < 1.1 * shift,
                    "{shift} {moved:?}"
                );
                assert!((moved.uniqueness_radius / own.uniqueness_radius - 1.0).abs() < 1e-3);
            }
            // no root is as near as a certificate wants it
            let mut centre = root;
            centre.re[5] = centre.re[5] + DoubleDouble::from(1e-3);
            assert!(one_root(&system, &centre).is_err());
        }
    }

    #[test]
    fn the_ball_for_joints_within_radii_holds_the_root_of_every_choice() {
        let rng = &mut Rng::new(0x9ed);
        let mut widest = 0.0_f64;
        for _ in 0..8 {
            let (m, pose) = known_pose(rng);
            let s = pose.squared_lengths(&m).unwrap();
            let radius = 1e-20;
            let plain = LegSystem::new(&m, &(&s).into()).unwrap();
            let start = study_of(&pose.into(), plain.unit()).unwrap();
            let root = refine_study(&plain, &start, f64::INFINITY).unwrap().x;
            let enclosed = LegSystem::new(&m.clone().enclosed_within(radius), &(&s).into()).unwrap();
            let ball = one_root(&enclosed, &root).unwrap();
            // a squared length off by so much changes its equation by less than the joints may
            let (e, g, p) = root.rounded().magnitudes();
            for i in 0..6 {
                let mut other = plain.clone();
                other.s_low[i] += enclosed.joint_width_of_value(i, e, g) / p;
                let moved = refine_study(&other, &start, f64::INFINITY).unwrap().x;
                let gap = |k: usize| {
                    (moved.re[k] - root.re[k]).rounded().hypot((moved.im[k] - root.im[k]).rounded())
                };
                let distance = (0..8).map(gap).fold(0.0, f64::max);
                assert!(distance <= ball.radius, "{distance:e} {ball:?}");
                widest = widest.max(distance / ball.radius);
            }
            assert!(ball.centre_radius < 1e-26 && ball.radius > 1e-21 && ball.radius < 1e-15, "{ball:?}");
        }
        assert!(widest > 1e-4, "{widest}");
    }
}
