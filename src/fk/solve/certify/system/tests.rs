//! Values, gradients and the second-order part against exact rationals, the equations written with quaternion products.

use num_rational::BigRational;

use super::*;
use nalgebra::Point3;
use num::Rng;
use num::interval::Interval;
use platform::manipulator::{Leg, LegLengths};

type ExactComplex = (BigRational, BigRational);
type Quaternion = [ExactComplex; 4];

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

fn zero() -> ExactComplex {
    (exact(0.0), exact(0.0))
}

fn add(a: &ExactComplex, b: &ExactComplex, sign: f64) -> ExactComplex {
    (&a.0 + exact(sign) * &b.0, &a.1 + exact(sign) * &b.1)
}

fn mul(a: &ExactComplex, b: &ExactComplex) -> ExactComplex {
    (&a.0 * &b.0 - &a.1 * &b.1, &a.0 * &b.1 + &a.1 * &b.0)
}

fn norm_squared(a: &ExactComplex) -> BigRational {
    &a.0 * &a.0 + &a.1 * &a.1
}

fn product(a: &Quaternion, b: &Quaternion) -> Quaternion {
    // (row, column, sign) of Hamilton's table
    const TABLE: [[(usize, usize, f64); 4]; 4] = [
        [(0, 0, 1.0), (1, 1, -1.0), (2, 2, -1.0), (3, 3, -1.0)],
        [(0, 1, 1.0), (1, 0, 1.0), (2, 3, 1.0), (3, 2, -1.0)],
        [(0, 2, 1.0), (2, 0, 1.0), (3, 1, 1.0), (1, 3, -1.0)],
        [(0, 3, 1.0), (3, 0, 1.0), (1, 2, 1.0), (2, 1, -1.0)],
    ];
    TABLE.map(|terms| terms.iter().fold(zero(), |sum, &(i, j, sign)| add(&sum, &mul(&a[i], &b[j]), sign)))
}

fn dot(a: &[ExactComplex], b: &[ExactComplex]) -> ExactComplex {
    a.iter().zip(b).fold(zero(), |sum, (x, y)| add(&sum, &mul(x, y), 1.0))
}

fn pure(p: &[f64; 3]) -> Quaternion {
    let lift = |x: f64| (exact(x), exact(0.0));
    [zero(), lift(p[0]), lift(p[1]), lift(p[2])]
}

/// `F(x)` from the definition.
fn truth(system: &LegSystem, x: &[ExactComplex; 8]) -> [ExactComplex; N] {
    let (e, g): (Quaternion, Quaternion) =
        (std::array::from_fn(|j| x[j].clone()), std::array::from_fn(|j| x[j + 4].clone()));
    std::array::from_fn(|i| {
        if i == 6 {
            return dot(&e, &g);
        }
        let (eb, ae) = (product(&e, &pure(&system.b[i])), product(&pure(&system.a[i]), &e));
        let v: Quaternion = std::array::from_fn(|j| add(&add(&g[j], &eb[j], 1.0), &ae[j], -1.0));
        let n = dot(&e, &e);
        let s = exact(system.s[i]) + exact(system.s_low[i]);
        let sn = (&s * &n.0, &s * &n.1);
        mul(&add(&dot(&v, &v), &sn, -1.0), &(exact(0.5), exact(0.0)))
    })
}

fn random_system(rng: &mut Rng) -> LegSystem {
    system_within(rng, 0.0)
}

/// A random system of joints known within a radius.
fn system_within(rng: &mut Rng, radius: f64) -> LegSystem {
    let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal()) * 3.0;
    let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
    let lengths = LegLengths::try_new(std::array::from_fn(|_| rng.uniform(0.7, 3.0))).unwrap();
    let m = Manipulator::from_legs(legs).unwrap();
    let m = if radius > 0.0 { m.enclosed_within(radius) } else { m };
    let system = LegSystem::new(&m, &(&lengths.squared()).into()).unwrap();
    assert!(system.s_low.iter().all(|low| low.abs() > 0.0), "squares of lengths have digits beyond double");
    system
}

fn random_point(rng: &mut Rng) -> Study<DoubleDouble> {
    let mut part = |patch: usize, one: f64| -> [DoubleDouble; 8] {
        std::array::from_fn(|j| {
            if j == patch {
                return one.into();
            }
            let x = rng.uniform(-1.0, 1.0);
            DoubleDouble::from_sum(x, x * rng.uniform(-0.5, 0.5) * U)
        })
    };
    let (re, im) = (part(2, 1.0), part(2, 0.0));
    Study { re, im, patch: 2 }
}

fn lift(x: &Study<DoubleDouble>) -> [ExactComplex; 8] {
    let value = |d: DoubleDouble| exact(d.hi()) + exact(d.lo());
    std::array::from_fn(|j| (value(x.re[j]), value(x.im[j])))
}

fn assert_within(computed: &ExactComplex, truth: &ExactComplex, bound: f64, what: &str) {
    let error = norm_squared(&add(computed, truth, -1.0));
    assert!(error <= exact(bound) * exact(bound), "{what}: {bound:e}");
}

#[test]
fn computed_values_stay_within_their_bounds_in_both_precisions() {
    let mut rng = Rng::new(81);
    for _ in 0..20 {
        let (system, x) = (random_system(&mut rng), random_point(&mut rng));
        let hi = x.rounded();
        let values = system.values(&hi);
        let (bounds, _) = system.value_bounds(&hi, &values, U);
        let at_hi = truth(&system, &lift(&hi.lifted()));
        let fine = system.values(&x);
        let (fine_bounds, _) = system.value_bounds(&hi, &values, DoubleDouble::UNIT);
        let at_x = truth(&system, &lift(&x));
        let value = |d: DoubleDouble| exact(d.hi()) + exact(d.lo());
        for i in 0..N {
            assert_within(&(exact(values.f_re[i]), exact(values.f_im[i])), &at_hi[i], bounds[i], "double");
            let computed = (value(fine.f_re[i]), value(fine.f_im[i]));
            assert_within(&computed, &at_x[i], fine_bounds[i], "double-double");
            assert!(bounds[i] < 1e-12 && fine_bounds[i] < 1e-26, "the bounds are of use: {bounds:?}");
        }
    }
}

#[test]
fn gradients_and_second_order_part_stay_within_their_bounds() {
    let mut rng = Rng::new(82);
    for _ in 0..6 {
        let (system, point) = (random_system(&mut rng), random_point(&mut rng));
        let x = point.rounded();
        let j = system.jacobian(&x, &system.values(&x));
        let centre = lift(&x.lifted());
        for column in 0..N {
            // a quadric's central difference is its derivative, and half the second difference its Q(h, h)
            let coordinate = if column == x.patch { 7 } else { column };
            let mut ends = [centre.clone(), centre.clone()];
            ends[0][coordinate].0 += exact(1.0);
            ends[1][coordinate].0 -= exact(1.0);
            let (plus, minus) = (truth(&system, &ends[0]), truth(&system, &ends[1]));
            for i in 0..N {
                let twice = (exact(2.0 * j.re[i][column]), exact(2.0 * j.im[i][column]));
                assert_within(&twice, &add(&plus[i], &minus[i], -1.0), 2.0 * j.error[i], "gradient");
            }
        }
        assert!(j.error.iter().all(|e| *e < 1e-12) && j.re.iter().chain(&j.im).all(|row| row[7] == 0.0));
        let mut h = lift(&random_point(&mut rng));
        h[x.patch] = zero();
        let q = truth(&system, &h); // F is homogeneous: Q(h, h) = F(h)
        for i in 0..N {
            // coordinates of h have moduli up to sqrt 2
            assert_within(&zero(), &q[i], 2.0 * system.q[i], "second order");
        }
    }
}

#[test]
fn the_second_order_part_of_two_vectors_stays_within_its_bounds() {
    let mut rng = Rng::new(84);
    let half = (exact(0.5), exact(0.0));
    for round in 0..20 {
        let system = random_system(&mut rng);
        let mut vector = |size: f64| -> [Complex64; N] {
            std::array::from_fn(|_| Complex64::new(rng.uniform(-size, size), rng.uniform(-size, size)))
        };
        let (h, k) = (vector(1.0), vector([1.0, 1e-5][round % 2]));
        let (patch, value) = (round % 4, |z: Complex64| (exact(z.re), exact(z.im)));
        let (x, y) = (system.increment(&h, patch), system.increment(&k, patch));
        let (computed, bounds) = system.second_order_part(&x, &y);
        let (h, k) = (lift(&x.x.lifted()), lift(&y.x.lifted()));
        let both: [ExactComplex; 8] = std::array::from_fn(|j| add(&h[j], &k[j], 1.0));
        // polarised: F is homogeneous
        let [of_both, of_h, of_k] = [&both, &h, &k].map(|x| truth(&system, x));
        for i in 0..N {
            let mixed = add(&add(&of_both[i], &of_h[i], -1.0), &of_k[i], -1.0);
            assert_within(&value(computed[i]), &mul(&mixed, &half), bounds[i], "second-order part");
            assert!(bounds[i] < 1e-12 && computed[i].norm() > 1e3 * bounds[i], "{computed:?} {bounds:?}");
        }
    }
}

#[test]
fn the_combined_second_order_bound_holds_and_is_nearly_attained() {
    let mut rng = Rng::new(83);
    let mut closest = 0.0_f64;
    for round in 0..300 {
        let (system, patch) = (random_system(&mut rng), round % 4);
        let mut row = || std::array::from_fn(|i| if i < N { rng.normal() } else { 0.0 });
        let (y_re, y_im): ([f64; 8], [f64; 8]) = (row(), if round % 2 == 0 { [0.0; 8] } else { row() });
        let weights: [f64; N] = std::array::from_fn(|i| y_re[i].abs() + y_im[i].abs());
        let bound = system.second_order_bound(&y_re, &y_im, &weights, patch);
        let coarse: f64 = (0..N).map(|i| weights[i] * system.q[i]).sum();
        assert!(bound < coarse);
        // corners of the polydisc: F is homogeneous, so F(h) = Q(h, h)
        for _ in 0..200 {
            let angle: [f64; 8] = std::array::from_fn(|_| match round % 3 {
                0 => rng.uniform(0.0, 7.0),
                _ => [0.0, std::f64::consts::PI][(rng.next_u64() % 2) as usize],
            });
            let (mut re, mut im) = (angle.map(f64::cos), angle.map(f64::sin));
            (re[patch], im[patch]) = (0.0, 0.0);
            let q = system.values(&Study { re, im, patch });
            let sum = |f: &[f64; N], g: &[f64; N], sign: f64| -> f64 {
                (0..N).map(|i| y_re[i] * f[i] + sign * y_im[i] * g[i]).sum()
            };
            let value = sum(&q.f_re, &q.f_im, -1.0).hypot(sum(&q.f_im, &q.f_re, 1.0));
            assert!(value <= bound * (1.0 + 1e-12), "{value} {bound}");
            closest = closest.max(value / bound);
        }
    }
    assert!(closest > 0.5, "{closest}");
}

#[test]
fn scaling_that_is_not_exact_is_refused() {
    let leg = |i: usize, x: f64| Leg {
        base: Point3::new(x, i as f64, 1.0),
        platform: Point3::new(1.0, 0.5, i as f64),
    };
    let system = |x: f64, s: f64| {
        let legs = std::array::from_fn(|i| leg(i, x));
        LegSystem::new(&Manipulator::from_legs(legs).unwrap(), &(&[Interval::from(s); 6]).into())
    };
    assert!(system(3.0, 4.0).is_ok());
    assert!(system(5e-324, 4.0).is_err(), "a subnormal coordinate loses its bits");
    assert!(system(1e150, 4.0).is_err() && system(3.0, 1e300).is_err());
}

/// Points far out: `g` up to `10^5` times `e`.
fn far_point(rng: &mut Rng) -> Study<DoubleDouble> {
    let mut x = random_point(rng);
    let scale = 2f64.powi((rng.next_u64() % 17) as i32);
    for k in 4..8 {
        (x.re[k], x.im[k]) = (x.re[k].scaled(scale), x.im[k].scaled(scale));
    }
    x
}

fn apart(f: &[ExactComplex; N]) -> [ExactComplex; N] {
    std::array::from_fn(|i| if (1..6).contains(&i) { add(&f[i], &f[0], -1.0) } else { f[i].clone() })
}

#[test]
#[ignore = "evidence"]
fn differences_of_the_equations_stay_within_their_bounds() {
    let mut rng = Rng::new(84);
    let value = |d: DoubleDouble| exact(d.hi()) + exact(d.lo());
    for _ in 0..20 {
        let (system, x) = (random_system(&mut rng), far_point(&mut rng));
        let hi = x.rounded();
        let (re, im) = system.values_apart(&x);
        let (bounds, _) = system.value_bounds_apart(&hi);
        let truth_apart = apart(&truth(&system, &lift(&x)));
        let g = hi.re[4..].iter().chain(&hi.im[4..]).fold(1.0_f64, |m, y| m.max(y.abs()));
        for i in 0..N {
            assert_within(&(value(re[i]), value(im[i])), &truth_apart[i], bounds[i], "difference");
            // linear in g, where the square of a leg itself would not be
            assert!(!(1..6).contains(&i) || bounds[i] < 1e-25 * g, "{:e}", bounds[i]);
        }
        let [j_re, j_im] = system.jacobian_apart(&x);
        let errors = system.jacobian_bounds_apart(&hi);
        for column in 0..N {
            let coordinate = if column == x.patch { 7 } else { column };
            let mut ends = [lift(&x), lift(&x)];
            ends[0][coordinate].0 += exact(1.0);
            ends[1][coordinate].0 -= exact(1.0);
            let (plus, minus) = (apart(&truth(&system, &ends[0])), apart(&truth(&system, &ends[1])));
            for i in 0..N {
                let twice = (value(j_re[i][column]) * exact(2.0), value(j_im[i][column]) * exact(2.0));
                assert_within(&twice, &add(&plus[i], &minus[i], -1.0), 2.0 * errors[i], "gradient");
            }
        }
    }
}

#[test]
fn a_larger_unit_is_the_same_problem() {
    let mut rng = Rng::new(85);
    for _ in 0..10 {
        let (system, x) = (random_system(&mut rng), far_point(&mut rng));
        let coarse = system.coarser(1024.0).unwrap();
        let mut y = x;
        for k in 4..8 {
            (y.re[k], y.im[k]) = (x.re[k].scaled(1.0 / 1024.0), x.im[k].scaled(1.0 / 1024.0));
        }
        let (f, scaled) = (truth(&system, &lift(&x)), truth(&coarse, &lift(&y)));
        for i in 0..N {
            let factor = exact(1024.0) * if i == 6 { exact(1.0) } else { exact(1024.0) };
            assert_eq!(f[i].0, &scaled[i].0 * &factor);
            assert_eq!(f[i].1, &scaled[i].1 * &factor);
        }
        assert!((coarse.unit() - 1024.0 * system.unit()).abs() < 1e-300);
    }
    assert!(random_system(&mut rng).coarser(2f64.powi(1070)).is_none());
}

#[test]
fn joints_that_are_their_doubles_have_no_width() {
    let mut rng = Rng::new(86);
    for _ in 0..10 {
        let system = random_system(&mut rng);
        for i in 0..6 {
            let widths = [
                system.joint_width_of_value(i, 2.0, 30.0),
                system.joint_width_of_gradient(i, 2.0, 30.0),
                system.joint_width_of_second_order(i),
                system.turn_radius[i],
            ];
            // added to bounds that are not negative, such a zero changes no bit of them
            assert!(widths.iter().all(|w| w.to_bits() == 0), "{widths:?}");
        }
    }
    assert!(random_system(&mut rng).coarser(1024.0).unwrap().turn_radius.iter().all(|t| t.to_bits() == 0));
}

/// The system of joints moved within their radii, coordinate by coordinate.
fn moved(system: &LegSystem, radius: f64, rng: &mut Rng) -> LegSystem {
    let mut out = system.clone();
    let mut side = || if rng.next_u64().is_multiple_of(2) { radius } else { -radius };
    for i in 0..6 {
        out.a[i] = system.a[i].map(|x| x + side());
        out.b[i] = system.b[i].map(|x| x + side());
        out.prepare_leg(i);
    }
    out
}

fn difference<const M: usize>(x: &[f64; M], y: &[f64; M]) -> [f64; M] {
    std::array::from_fn(|k| x[k] - y[k])
}

#[test]
fn what_joints_within_their_radii_change_is_within_the_widths_and_nearly_attains_them() {
    let mut rng = Rng::new(87);
    let mut closest = [0.0_f64; 6];
    for round in 0..400 {
        let radius = 2f64.powi(-6 - (round % 10));
        let system = system_within(&mut rng, radius);
        let x = if round % 2 == 0 { random_point(&mut rng) } else { far_point(&mut rng) }.rounded();
        let values = system.values(&x);
        let (_, width) = system.value_bounds(&x, &values, U);
        let (_, width_apart) = system.value_bounds_apart(&x);
        let j = system.jacobian(&x, &values);
        let [j_re, j_im] = system.jacobian_apart::<f64>(&x);
        let j_bounds = system.jacobian_bounds_apart(&x);
        let lifted = x.lifted();
        let (f_re, f_im) = system.values_apart(&lifted);
        for _ in 0..20 {
            // less than the radius by more than rounding can add
            let other = moved(&system, 0.999 * radius / system.unit(), &mut rng);
            let there = other.values(&x);
            let (g_re, g_im) = other.values_apart(&lifted);
            let k = other.jacobian(&x, &there);
            let [k_re, k_im] = other.jacobian_apart::<f64>(&x);
            let h = Study { patch: x.patch, ..random_point(&mut rng).rounded() };
            let mut h = Study { re: h.re.map(f64::signum), im: [0.0; 8], patch: x.patch };
            h.re[x.patch] = 0.0;
            let (q, r) = (system.values(&h), other.values(&h));
            for i in 0..6 {
                let row = |re: [f64; 8], im: [f64; 8]| (0..8).map(|k| re[k].hypot(im[k])).sum::<f64>();
                let changes = [
                    ((there.f_re[i] - values.f_re[i]).hypot(there.f_im[i] - values.f_im[i]), width[i]),
                    ((g_re[i] - f_re[i]).rounded().hypot((g_im[i] - f_im[i]).rounded()), width_apart[i]),
                    (row(difference(&k.re[i], &j.re[i]), difference(&k.im[i], &j.im[i])), j.error[i]),
                    (row(difference(&k_re[i], &j_re[i]), difference(&k_im[i], &j_im[i])), j_bounds[i]),
                    ((r.f_re[i] - q.f_re[i]).abs(), system.joint_width_of_second_order(i)),
                    (r.f_re[i].abs(), system.q[i]),
                ];
                for (closest, (change, bound)) in closest.iter_mut().zip(changes) {
                    assert!(change <= bound, "{round} {i}: {change:e} {bound:e}");
                    *closest = closest.max(change / bound);
                }
            }
        }
    }
    assert!(closest.iter().all(|c| *c > 0.1), "{closest:?}");
}
