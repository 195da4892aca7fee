//! Zeros of a function known through values and logarithmic derivatives: Ehrlich-Aberth iteration on the function itself.

use num_complex::Complex64;

/// Sweeps after which a zero that still moves is left where it is.
const SWEEPS: usize = 30;
/// A step below this, relative to the size of the zero, is the last: the one after it would be of the order of its cube.
const SETTLED: f64 = 1e-6;

/// A function with as many zeros as start values are given for: a polynomial, not necessarily by its coefficients.
pub(super) trait Condition {
    /// What else an evaluation finds.
    type Evidence;

    /// `p'(z) / p(z)`, infinite or not a number at a zero; `None` where it cannot be computed.
    fn rate(&mut self, z: Complex64) -> Option<(Complex64, Self::Evidence)>;

    /// The size that small zeros are measured by.
    fn floor(&self) -> f64;
}

/// One zero.
#[derive(Debug, Clone)]
pub(super) struct Zero<E> {
    pub(super) at: Complex64,
    /// Of the last evaluation: where the zero was before its last step, `None` when that failed.
    pub(super) evidence: Option<E>,
    pub(super) settled: bool,
}

/// The zeros, and the number of evaluations.
pub(super) fn zeros<C: Condition>(condition: &mut C, start: &[Complex64]) -> (Vec<Zero<C::Evidence>>, usize) {
    let new = |z: &Complex64| Zero { at: *z, evidence: None, settled: false };
    let mut zeros: Vec<Zero<C::Evidence>> = start.iter().map(new).collect();
    let mut evaluations = 0;
    for _ in 0..SWEEPS {
        for k in 0..zeros.len() {
            if !zeros[k].settled {
                evaluations += 1;
                step(condition, &mut zeros, k);
            }
        }
        if zeros.iter().all(|z| z.settled) {
            break;
        }
    }
    (zeros, evaluations)
}

fn step<C: Condition>(condition: &mut C, zeros: &mut [Zero<C::Evidence>], k: usize) {
    let z = zeros[k].at;
    let size = z.norm().max(condition.floor());
    let Some((rate, evidence)) = condition.rate(z) else {
        // nothing is known here; a little further something may be
        zeros[k].at = z + Complex64::new(1e-3, 7e-4) * size;
        return;
    };
    let others = zeros.iter().enumerate().filter(|(j, _)| *j != k);
    let repulsion: Complex64 = others.map(|(_, o)| (z - o.at).inv()).filter(|q| q.is_finite()).sum();
    let step = (rate - repulsion).inv();
    let zero = &mut zeros[k];
    zero.evidence = Some(evidence);
    if step.is_finite() && step.norm() < 1e3 * size {
        zero.at = z - step;
        zero.settled = step.norm() < SETTLED * size;
    } else {
        // not finite: a zero to the last digit
        zero.settled = !rate.is_finite();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial by its zeros.
    struct Known(Vec<Complex64>);

    impl Condition for Known {
        type Evidence = ();
        fn rate(&mut self, z: Complex64) -> Option<(Complex64, ())> {
            Some((self.0.iter().map(|r| (z - r).inv()).sum(), ()))
        }
        fn floor(&self) -> f64 {
            1.0
        }
    }

    #[test]
    fn all_zeros_are_found_from_anywhere() {
        let known: Vec<Complex64> =
            (-3..=3).map(|k| Complex64::new(f64::from(k), 0.1 * f64::from(k * k))).collect();
        let start: Vec<Complex64> = (0..7).map(|k| Complex64::from_polar(9.0, f64::from(k) + 0.3)).collect();
        let (found, evaluations) = zeros(&mut Known(known.clone()), &start);
        assert!(found.iter().all(|z| z.settled) && evaluations < 7 * SWEEPS);
        for r in known {
            assert_eq!(found.iter().filter(|z| (z.at - r).norm() < 1e-9).count(), 1);
        }
    }
}
