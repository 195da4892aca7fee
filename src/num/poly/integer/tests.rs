use super::*;
use crate::Rng;

fn linear(root: i64) -> IntPoly {
    IntPoly::from_i64(&[-root, 1])
}

fn product(factors: impl IntoIterator<Item = IntPoly>) -> IntPoly {
    factors.into_iter().fold(IntPoly::from_i64(&[1]), |p, f| &p * &f)
}

fn random(rng: &mut Rng, degree: usize, words: usize) -> IntPoly {
    let mut integer = || {
        let digits: Vec<u32> = (0..words).map(|_| rng.next_u64() as u32).collect();
        let sign = if rng.unit() < 0.5 { Sign::Minus } else { Sign::Plus };
        BigInt::from_slice(sign, &digits)
    };
    IntPoly::new((0..=degree).map(|_| integer()).collect())
}

fn chebyshev(n: usize) -> IntPoly {
    let (mut a, mut b) = (IntPoly::from_i64(&[1]), IntPoly::x());
    for _ in 1..n {
        let next = &(&IntPoly::from_i64(&[0, 2]) * &b) - &a;
        (a, b) = (b, next);
    }
    b
}

/// `x^n - 2 (a x - 1)^2`: two roots closer than `2 a^-(n/2 + 1)`.
fn mignotte(n: usize, a: i64) -> IntPoly {
    let mut c = vec![0; n + 1];
    (c[0], c[1], c[2], c[n]) = (-2, 4 * a, -2 * a * a, 1);
    IntPoly::from_i64(&c)
}

/// Sturm over the whole line.
fn distinct_real(p: &IntPoly) -> usize {
    let far = Dyadic::new(BigInt::from(1), p.root_bound() + 1);
    sturm_count(p, &far.negated(), &far)
}

fn isolates(p: &IntPoly) -> usize {
    let found = real_roots(p);
    assert!(found.windows(2).all(|w| w[0].high() < w[1].low()));
    for r in &found {
        if !r.is_exact() {
            assert_eq!(sturm_count(p, r.low(), r.high()), 1);
        }
    }
    assert_eq!(found.len(), distinct_real(p));
    found.len()
}

#[test]
fn products_agree_with_the_schoolbook_and_divide_back() {
    let mut rng = Rng::new(1);
    for case in 0..60 {
        let (n, m) = (case % 9, 3 + case % 23);
        let (p, q) = (random(&mut rng, n, 1 + case % 5), random(&mut rng, m, 1 + case % 7));
        let mut expected = vec![BigInt::zero(); n + m + 1];
        for (i, a) in p.coefficients().iter().enumerate() {
            for (j, b) in q.coefficients().iter().enumerate() {
                expected[i + j] += a * b;
            }
        }
        let r = &p * &q;
        assert_eq!(r, IntPoly::new(expected));
        assert_eq!(r.exact_div(&p), Some(q.clone()));
        assert_eq!((&r + &IntPoly::from_i64(&[1])).exact_div(&p.scaled(&BigInt::from(3))), None);
    }
    assert_eq!(IntPoly::from_i64(&[1, 1]).exact_div(&IntPoly::default()), None);
}

#[test]
fn greatest_common_divisors_and_square_free_factors() {
    let mut rng = Rng::new(2);
    for _ in 0..20 {
        let (g, p, q) = (random(&mut rng, 4, 6).primitive(), random(&mut rng, 7, 3), random(&mut rng, 5, 8));
        assert_eq!(gcd(&(&g * &p), &(&g * &q)), g);
        assert_eq!(gcd(&p, &q).degree(), Some(0));
        let power = product([g.clone(), g.clone(), p.clone(), g.clone()]).scaled(&BigInt::from(-6));
        let found = squarefree_factors(&power);
        assert_eq!(found.iter().map(|f| f.multiplicity).collect::<Vec<_>>(), [1, 3]);
        assert!(found[0].factor == p.primitive() && found[1].factor == g);
    }
    assert!(squarefree_factors(&IntPoly::from_i64(&[7])).is_empty());
    assert!(gcd(&IntPoly::default(), &IntPoly::default()).is_zero());
}

#[test]
fn wilkinson_and_its_perturbation() {
    let p = product((1..=20).map(linear));
    let found = real_roots(&p);
    assert_eq!(
        found.iter().map(RealRoot::to_f64).collect::<Vec<_>>(),
        (1..=20).map(f64::from).collect::<Vec<_>>()
    );
    // -210 - 2^-23 for the coefficient of x^19: ten roots leave the real line
    let q = &p.scaled(&BigInt::from(1 << 23)) - &product(vec![IntPoly::x(); 19]);
    assert_eq!(isolates(&q), 10);
    let all = complex_roots(&q, 60).unwrap();
    assert_eq!((all.len(), all.iter().filter(|z| z.is_real()).count()), (20, 10));
    let z = all.iter().map(ComplexRoot::to_complex64).max_by(|a, b| a.im.total_cmp(&b.im)).unwrap();
    // Wilkinson 1963: 16.730737466 + 2.812624894 i
    assert!((z.re - 16.730_737_466).abs() < 1e-8 && (z.im - 2.812_624_894).abs() < 1e-8, "{z}");
}

#[test]
#[ignore = "evidence"]
fn close_roots_are_told_apart_and_equal_ones_are_not() {
    let p = mignotte(31, 1_000_000_007);
    assert_eq!(isolates(&p), 3);
    let all = complex_roots(&p, 60).unwrap();
    assert_eq!((all.len(), all.iter().filter(|z| z.is_real()).count()), (31, 3));
    // the same with the two roots merged, and moved apart into the plane
    let double = &IntPoly::from_i64(&[1, -2, 1]) * &IntPoly::from_i64(&[1, 0, 1]);
    assert_eq!(real_roots(&double).iter().map(RealRoot::multiplicity).collect::<Vec<_>>(), [2]);
    let tiny = |sign: i64| {
        let square = IntPoly::from_i64(&[1, -2, 1]).scaled(&(BigInt::from(1) << 900u32));
        &square + &IntPoly::from_i64(&[sign])
    };
    assert_eq!((isolates(&tiny(1)), isolates(&tiny(-1)), isolates(&tiny(0))), (0, 2, 1));
}

#[test]
fn chebyshev_roots_are_cosines() {
    let n = 40;
    assert_eq!(isolates(&chebyshev(n)), n);
    let exact = |k: usize| (std::f64::consts::PI * (2 * k + 1) as f64 / (2 * n) as f64).cos();
    for (k, r) in real_roots(&chebyshev(n)).iter().rev().enumerate() {
        assert!((r.to_f64() - exact(k)).abs() < 1e-15);
    }
}

#[test]
fn random_products_have_the_roots_they_were_made_of() {
    let mut rng = Rng::new(7);
    for _ in 0..25 {
        let mut known: Vec<i64> = (0..6).map(|_| (rng.uniform(-40.0, 40.0)) as i64).collect();
        let no_root = IntPoly::from_i64(&[1 + (rng.unit() * 9.0) as i64, 2, 1]);
        let p = &product(known.iter().map(|r| linear(*r))) * &no_root.scaled(&BigInt::from(-5));
        known.sort_unstable();
        let counted: Vec<i64> =
            real_roots(&p).iter().flat_map(|r| vec![r.to_f64() as i64; r.multiplicity()]).collect();
        // x^2 + 2x + 1 is the only square among the quadratic factors
        if !no_root.coefficients()[0].is_one() {
            assert_eq!(counted, known);
        }
        isolates(&p);
        let all = complex_roots(&p, 50).unwrap();
        assert_eq!(all.iter().map(|z| z.multiplicity).sum::<usize>(), 8);
        assert_eq!(all.iter().filter(|z| z.is_real()).count(), real_roots(&p).len());
    }
}

#[test]
fn signs_at_roots_of_another_polynomial() {
    let p = product([IntPoly::from_i64(&[-2, 0, 1]), IntPoly::from_i64(&[-7, 5])]); // -sqrt 2, 7/5, sqrt 2
    let signs =
        |q: &[i64]| real_roots(&p).iter().map(|r| r.sign_of(&IntPoly::from_i64(q))).collect::<Vec<_>>();
    let (minus, zero, plus) = (Sign::Minus, Sign::NoSign, Sign::Plus);
    assert_eq!(signs(&[-4, 0, 2]), [zero, minus, zero]);
    // 141/100 and 1414213/1000000 lie between the last two
    assert_eq!(signs(&[-141, 100]), [minus, minus, plus]);
    assert_eq!(signs(&[-1_414_213, 1_000_000]), [minus, minus, plus]);
    assert_eq!(signs(&[5]), [plus; 3]);
    assert_eq!(signs(&[]), [zero; 3]);
    assert_eq!(real_roots(&IntPoly::from_i64(&[-1, 2]))[0].sign_of(&IntPoly::from_i64(&[-1, 2])), zero);
}

#[test]
fn roots_at_zero_at_ends_of_intervals_and_none() {
    // dyadic roots are ends of intervals of the bisection
    let p = product([
        IntPoly::x(),
        linear(1),
        linear(-1),
        IntPoly::from_i64(&[-1, 2]),
        IntPoly::from_i64(&[-3, 4]),
    ]);
    let exact: Vec<f64> = real_roots(&p).iter().map(RealRoot::to_f64).collect();
    assert_eq!(exact, [-1.0, 0.0, 0.5, 0.75, 1.0]);
    let q = product([linear(1), IntPoly::from_i64(&[-2, 0, 1]), IntPoly::from_i64(&[-1, 2])]);
    assert_eq!(isolates(&q), 4);
    assert!(real_roots(&IntPoly::from_i64(&[3])).is_empty() && real_roots(&IntPoly::default()).is_empty());
    assert_eq!(isolates(&IntPoly::from_i64(&[1, 0, 1])), 0);
}
