#![allow(clippy::float_cmp)] // the tests compare exact ends

use super::*;
use crate::Rng;
use crate::complex::Complex;
use num_complex::Complex64;
use num_rational::BigRational;

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

/// `value` lies in `interval`, decided with rationals.
fn holds(interval: Interval, value: &BigRational) -> bool {
    (interval.lo == f64::NEG_INFINITY || exact(interval.lo) <= *value)
        && (interval.hi == f64::INFINITY || *value <= exact(interval.hi))
}

/// Bit patterns of all exponents, subnormals and zero included, mixed with special values.
fn random_double(rng: &mut Rng) -> f64 {
    const SPECIAL: [f64; 10] =
        [0.0, -0.0, 1.0, -1.0, f64::MAX, f64::MIN, f64::MIN_POSITIVE, 5e-324, -5e-324, 1.0 + f64::EPSILON];
    match rng.next_u64() % 4 {
        0 => SPECIAL[(rng.next_u64() % 10) as usize],
        1 => rng.uniform(-4.0, 4.0),
        2 => f64::from_bits(rng.next_u64() & 0x800f_ffff_ffff_ffff), // subnormal
        _ => Some(f64::from_bits(rng.next_u64())).filter(|x| x.is_finite()).unwrap_or(0.5),
    }
}

fn random_interval(rng: &mut Rng) -> Interval {
    let (x, y) = (random_double(rng), random_double(rng));
    match rng.next_u64() % 8 {
        0 => Interval::raw(f64::NEG_INFINITY, x),
        1 => Interval::raw(x, f64::INFINITY),
        2 => Interval::from(x),
        _ => Interval::raw(x.min(y), x.max(y)),
    }
}

/// A few numbers of the interval, ends first.
fn members(i: Interval, rng: &mut Rng) -> Vec<f64> {
    let (lo, hi) = (i.lo.max(f64::MIN), i.hi.min(f64::MAX));
    let mut all = vec![lo, hi, (0.5 * lo + 0.5 * hi).clamp(lo, hi), 0.0, random_double(rng)];
    all.retain(|x| i.contains(*x));
    all
}

#[test]
fn operations_enclose_the_exact_result() {
    let mut rng = Rng::new(21);
    let mut quotients = 0;
    for _ in 0..1500 {
        let (a, b) = (random_interval(&mut rng), random_interval(&mut rng));
        for x in members(a, &mut rng) {
            let xx = exact(x);
            assert!(holds(a.square(), &(&xx * &xx)) && a.square().lo >= 0.0, "{a:?} squared at {x}");
            assert!(holds(-a, &-xx.clone()));
            if x >= 0.0 {
                let root = a.sqrt().unwrap();
                let square = |e: f64| exact(e) * exact(e);
                assert!(square(root.lo) <= xx && (root.hi == f64::INFINITY || xx <= square(root.hi)));
            }
            for y in members(b, &mut rng) {
                let yy = exact(y);
                assert!(holds(a + b, &(&xx + &yy)), "{a:?} + {b:?} at {x}, {y}");
                assert!(holds(a - b, &(&xx - &yy)), "{a:?} - {b:?} at {x}, {y}");
                assert!(holds(a * b, &(&xx * &yy)), "{a:?} * {b:?} at {x}, {y}");
                if let Some(q) = a.checked_div(b) {
                    quotients += 1;
                    assert!(holds(q, &(&xx / &yy)), "{a:?} / {b:?} at {x}, {y}");
                }
            }
        }
        for r in [a + b, a - b, a * b, a.square()] {
            assert!(r.lo <= r.hi && r.lo < f64::INFINITY && r.hi > f64::NEG_INFINITY, "{a:?} {b:?} {r:?}");
        }
    }
    assert!(quotients > 1000);
}

#[test]
fn round_to_nearest_alone_does_not_enclose() {
    // negative control: 0.1 + 0.2 is not a double
    let sum = Interval::from(0.1 + 0.2);
    assert!(!holds(sum, &(exact(0.1) + exact(0.2))));
    assert!(holds(Interval::from(0.1) + Interval::from(0.2), &(exact(0.1) + exact(0.2))));
}

#[test]
fn empty_and_invalid_intervals_do_not_exist() {
    assert_eq!(Interval::new(1.0, 0.0), None);
    assert_eq!(Interval::new(f64::NAN, 0.0), None);
    assert_eq!(Interval::new(0.0, f64::NAN), None);
    assert_eq!(Interval::new(f64::INFINITY, f64::INFINITY), None);
    assert_eq!(Interval::point(f64::NEG_INFINITY), None);
    assert_eq!(Interval::from(f64::NAN), Interval::WHOLE);
    let i = |lo, hi| Interval::new(lo, hi).unwrap();
    assert_eq!(i(-2.0, -1.0).sqrt(), None);
    assert_eq!(i(1.0, 2.0).checked_div(i(-1.0, 0.0)), None);
    assert!(!Interval::WHOLE.contains(f64::INFINITY) && Interval::WHOLE.encloses(i(0.0, 1.0)));
}

#[test]
fn zero_stays_zero_and_infinity_is_not_attained() {
    assert_eq!(Interval::ZERO * Interval::WHOLE, Interval::ZERO);
    assert_eq!(Interval::ZERO + Interval::from(3.0), Interval::from(3.0));
    let large = Interval::from(f64::MAX) + Interval::from(f64::MAX);
    assert!(large.lo == f64::MAX && large.hi == f64::INFINITY);
    let tiny = Interval::from(5e-324) * Interval::from(0.5);
    assert!(tiny.lo < 0.0 && tiny.hi > 0.0 && tiny.hi < 1e-323);
    let unbounded = Interval::new(1.0, f64::INFINITY).unwrap();
    let ratio = unbounded.checked_div(unbounded).unwrap();
    assert!(ratio.lo <= 0.0 && ratio.hi == f64::INFINITY);
}

#[test]
fn centre_and_radius_cover_the_interval() {
    let mut rng = Rng::new(22);
    for _ in 0..500 {
        let i = random_interval(&mut rng);
        let (m, r) = i.centre_and_radius();
        assert!(r >= 0.0 && m.is_finite());
        if r.is_finite() {
            assert!(exact(m) - exact(r) <= exact(i.lo) && exact(i.hi) <= exact(m) + exact(r), "{i:?}");
        }
    }
    assert_eq!(Interval::from(0.3).centre_and_radius().0, 0.3);
}

#[test]
fn complex_products_and_quotients_enclose() {
    let mut rng = Rng::new(23);
    for _ in 0..300 {
        let z: [f64; 4] = std::array::from_fn(|_| rng.normal());
        let (a, b) = (Complex64::new(z[0], z[1]), Complex64::new(z[2], z[3]));
        let q = z.map(exact);
        let (ia, ib) = (Complex::<Interval>::from(a), Complex::<Interval>::from(b));
        let (re, im) = (&q[0] * &q[2] - &q[1] * &q[3], &q[0] * &q[3] + &q[1] * &q[2]);
        assert!(holds((ia * ib).re, &re) && holds((ia * ib).im, &im));
        let n = &q[2] * &q[2] + &q[3] * &q[3];
        let quotient = |x: Interval| x.checked_div(ib.norm_sqr()).unwrap();
        let product = ia * ib.conj();
        assert!(holds(quotient(product.re), &((&q[0] * &q[2] + &q[1] * &q[3]) / &n)));
        assert!(holds(quotient(product.im), &((&q[1] * &q[2] - &q[0] * &q[3]) / &n)));
        let back = ia - ib + ib;
        assert!(back.re.contains(a.re) && back.im.contains(a.im));
        assert!(!(ia * ib).re.contains((a * b + 1.0).re));
    }
    assert_eq!(Interval::from(1.0).checked_div(Complex::<Interval>::from(Complex64::ZERO).norm_sqr()), None);
}

/// Ends rounded once are those of products rounded one by one, for numbers of all sizes, zeros, subnormals and
/// unbounded intervals.
#[test]
fn products_are_as_narrow_as_their_ends_allow() {
    let mut rng = Rng::new(22);
    for _ in 0..20_000 {
        let (a, b) = (random_interval(&mut rng), random_interval(&mut rng));
        assert_eq!(a * b, a.product_by_ends(b), "{a:?} * {b:?}");
        let x = random_double(&mut rng);
        assert_eq!(a.scaled(x), a.product_by_ends(Interval::from(x)), "{a:?} * {x:e}");
        // a square is not below zero and no wider than the product
        assert!((a * a).encloses(a.square()) && a.square().lo >= 0.0, "{a:?}");
    }
    assert_eq!(Interval::WHOLE.scaled(0.0), Interval::ZERO);
    assert_eq!(Interval::from(1.0).scaled(f64::NAN), Interval::WHOLE);
}
