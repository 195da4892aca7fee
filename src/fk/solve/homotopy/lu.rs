//! LU factorisation of one 8 x 8 complex matrix per lane.

use pulp::Simd;

use super::lanes::{Lanes, Matrix8, PerLane, Vec8, store};

/// Factors with partial pivoting, every lane its own row exchanges.
#[derive(Debug, Clone, Copy)]
pub(super) struct Lu<S: Simd> {
    factors: Matrix8<S>,
    inverse_pivots: [Lanes<S>; 8],
    /// Row exchanged with row `k` in step `k`, as a number per lane.
    pivot_rows: [S::f64s; 8],
}

impl<S: Simd> Lu<S> {
    /// Factorises `a`.
    #[inline(always)]
    pub(super) fn factorise(mut a: Matrix8<S>) -> Self {
        let s = a[0][0].simd;
        let mut inverse_pivots = [Lanes::zero(s); 8];
        let mut pivot_rows = [s.splat_f64s(0.0); 8];
        for k in 0..8 {
            let mut best = a[k][k].norm_sqr();
            let mut row = s.splat_f64s(k as f64);
            for i in k + 1..8 {
                let n = a[i][k].norm_sqr();
                let larger = s.greater_than_f64s(n, best);
                best = s.select_f64s(larger, n, best);
                row = s.select_f64s(larger, s.splat_f64s(i as f64), row);
            }
            pivot_rows[k] = row;
            for i in k + 1..8 {
                let mask = s.equal_f64s(row, s.splat_f64s(i as f64));
                if s.first_true_m64s(mask) < S::F64_LANES {
                    for j in 0..8 {
                        let (top, here) = (a[k][j], a[i][j]);
                        a[k][j] = top.select(mask, here);
                        a[i][j] = here.select(mask, top);
                    }
                }
            }
            let inverse = a[k][k].recip();
            inverse_pivots[k] = inverse;
            let pivot_row = a[k];
            for i in k + 1..8 {
                let factor = a[i][k] * inverse;
                a[i][k] = factor;
                for j in k + 1..8 {
                    a[i][j] = a[i][j].mul_sub(factor, pivot_row[j]);
                }
            }
        }
        Self { factors: a, inverse_pivots, pivot_rows }
    }

    /// Solves `A x = b`.
    #[inline(always)]
    pub(super) fn solve(&self, mut b: Vec8<S>) -> Vec8<S> {
        let s = b[0].simd;
        for k in 0..7 {
            let row = self.pivot_rows[k];
            for i in k + 1..8 {
                let mask = s.equal_f64s(row, s.splat_f64s(i as f64));
                if s.first_true_m64s(mask) < S::F64_LANES {
                    let (top, here) = (b[k], b[i]);
                    b[k] = top.select(mask, here);
                    b[i] = here.select(mask, top);
                }
            }
        }
        for i in 1..8 {
            for j in 0..i {
                b[i] = b[i].mul_sub(self.factors[i][j], b[j]);
            }
        }
        for i in (0..8).rev() {
            for j in i + 1..8 {
                b[i] = b[i].mul_sub(self.factors[i][j], b[j]);
            }
            b[i] = b[i] * self.inverse_pivots[i];
        }
        b
    }

    /// Smallest over largest pivot modulus, a crude inverse condition number.
    pub(super) fn pivot_ratio(&self) -> PerLane {
        let pivots = self.inverse_pivots.map(|z| store::<S>(z.norm_sqr()));
        std::array::from_fn(|l| {
            let least = pivots.iter().map(|p| p[l]).fold(f64::INFINITY, f64::min);
            let greatest = pivots.iter().map(|p| p[l]).fold(0.0, f64::max);
            (least / greatest).sqrt()
        })
    }
}

/// Factorises `a` in place without exchanging rows; `inverse` receives the inverse pivots.
///
/// Exchanges that differ from lane to lane cost more than the elimination itself. Without them a small pivot makes the
/// factors inaccurate once in a while. The tracker notices a Newton correction that does not fit, and paths that it
/// cannot finish are tracked again with pivoting.
#[inline(always)]
pub(super) fn eliminate<S: Simd>(a: &mut Matrix8<S>, inverse: &mut Vec8<S>) {
    for k in 0..8 {
        inverse[k] = a[k][k].recip();
        let pivot_row = a[k];
        for i in k + 1..8 {
            let factor = a[i][k] * inverse[k];
            a[i][k] = factor;
            for j in k + 1..8 {
                a[i][j] = a[i][j].mul_sub(factor, pivot_row[j]);
            }
        }
    }
}

/// Solves with the factors of [`eliminate`], in place.
#[inline(always)]
pub(super) fn substitute<S: Simd>(a: &Matrix8<S>, inverse: &Vec8<S>, b: &mut Vec8<S>) {
    // by columns: the updates of one column do not wait for each other
    for j in 0..7 {
        let top = b[j];
        for i in j + 1..8 {
            b[i] = b[i].mul_sub(a[i][j], top);
        }
    }
    for j in (0..8).rev() {
        b[j] = b[j] * inverse[j];
        let known = b[j];
        for i in 0..j {
            b[i] = b[i].mul_sub(a[i][j], known);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use num::vector_unit::on_vector_unit;
    use num_complex::Complex64;
    use pulp::WithSimd;

    struct SolveRandom;

    impl WithSimd for SolveRandom {
        type Output = ();

        fn with_simd<S: Simd>(self, simd: S) {
            let mut rng = Rng::new(5);
            let mut random = || {
                let mut z = Lanes::zero(simd);
                for l in 0..S::F64_LANES {
                    z.set_lane(l, Complex64::new(rng.normal(), rng.normal()));
                }
                z
            };
            for _ in 0..50 {
                let mut a: [[Lanes<S>; 8]; 8] = std::array::from_fn(|_| std::array::from_fn(|_| random()));
                a[0][0] = Lanes::zero(simd); // forces an exchange
                let x: Vec8<S> = std::array::from_fn(|_| random());
                let zero = Lanes::zero(simd);
                let b = a.map(|row| row.iter().zip(&x).fold(zero, |s, (p, q)| s.mul_add(*p, *q)));
                let lu = Lu::factorise(a);
                let y = lu.solve(b);
                for (p, q) in x.iter().zip(&y) {
                    let error = store::<S>((*p - *q).norm_sqr());
                    assert!(error.iter().all(|n| n.sqrt() < 1e-10));
                }
                assert!(lu.pivot_ratio()[..S::F64_LANES].iter().all(|r| *r > 1e-4 && *r <= 1.0));
            }
        }
    }

    #[test]
    fn solves_random_systems_in_every_lane_of_every_unit() {
        on_vector_unit(SolveRandom);
        pulp::Arch::Scalar.dispatch(SolveRandom);
    }
}
