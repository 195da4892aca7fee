use super::*;
use crate::Rng;
use num_rational::BigRational;

fn exact(x: f64) -> BigRational {
    BigRational::from_float(x).unwrap()
}

fn value(x: DoubleDouble) -> BigRational {
    exact(x.hi) + exact(x.lo)
}

fn abs(x: BigRational) -> BigRational {
    if x < exact(0.0) { -x } else { x }
}

fn random(rng: &mut Rng) -> DoubleDouble {
    let hi = rng.uniform(-1.0, 1.0) * 2f64.powi((rng.next_u64() % 121) as i32 - 60);
    DoubleDouble::from_sum(hi, hi * rng.uniform(-1.0, 1.0) * f64::EPSILON / 2.0)
}

fn assert_close(computed: DoubleDouble, truth: &BigRational, what: &str) {
    assert!(computed.hi.to_bits() == (computed.hi + computed.lo).to_bits(), "{what}: parts overlap");
    let error = abs(value(computed) - truth);
    assert!(error <= exact(DoubleDouble::UNIT) * abs(truth.clone()), "{what}: {computed:?}");
}

#[test]
fn the_error_free_transforms_are_exact() {
    let mut rng = Rng::new(11);
    for _ in 0..2000 {
        let (a, b) = (random(&mut rng).hi, random(&mut rng).hi);
        let (s, t) = two_sum(a, b);
        assert_eq!(exact(s) + exact(t), exact(a) + exact(b));
        let (p, e) = two_product(a, b);
        assert_eq!(exact(p) + exact(e), exact(a) * exact(b));
        assert!(p.to_bits() == (a * b).to_bits() && s.to_bits() == (a + b).to_bits());
    }
}

#[test]
fn every_operation_stays_within_its_bound() {
    let mut rng = Rng::new(12);
    for i in 0..2000 {
        let (a, mut b) = (random(&mut rng), random(&mut rng));
        if i % 3 == 0 {
            b = DoubleDouble::from_sum(-a.hi, a.hi * rng.uniform(-1.0, 1.0) * f64::EPSILON); // cancellation
        }
        assert_close(a + b, &(value(a) + value(b)), "sum");
        assert_close(a - b, &(value(a) - value(b)), "difference");
        assert_close(a * b, &(value(a) * value(b)), "product");
        assert_close(a / b, &(value(a) / value(b)), "quotient");
    }
}

#[test]
fn the_bounds_are_not_met_by_plain_doubles() {
    // negative control: the same assertion must fail for an operation done in double
    let (a, b) = (DoubleDouble::from_sum(1.0, 1e-17), DoubleDouble::from_sum(3.0, 1e-17));
    let plain = DoubleDouble::from(a.hi * b.hi + 1e-25);
    let error = abs(value(plain) - value(a) * value(b));
    assert!(error > exact(DoubleDouble::UNIT) * value(a) * value(b));
}

#[test]
fn complex_quotient_undoes_the_product() {
    let mut rng = Rng::new(13);
    for _ in 0..200 {
        let z = ComplexDoubleDouble { re: random(&mut rng), im: random(&mut rng) };
        let w = ComplexDoubleDouble { re: random(&mut rng), im: random(&mut rng) };
        let back = z * w / w - z;
        assert!(back.hi().norm() <= 40.0 * DoubleDouble::UNIT * z.hi().norm());
        assert_eq!((z - z).hi(), Complex64::new(0.0, 0.0));
        assert_eq!(z.scaled(0.25).scaled(4.0), z);
    }
    assert_eq!((DoubleDouble::from(-2.5).abs(), DoubleDouble::ONE.lo()), (DoubleDouble::from(2.5), 0.0));
}
