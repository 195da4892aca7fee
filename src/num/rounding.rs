//! Check of this thread's arithmetic against the assumptions of proofs: doubles of 64 bits, rounded to nearest, with
//! subnormal numbers.
//!
//! An interval consists of neighbours ([`f64::next_down`], [`f64::next_up`]) of a result of the processor. It encloses
//! the true value because IEEE 754 rounds to the nearest by default. Three conditions silently invalidate this:
//!
//! * a processor that holds results in wider registers (x87): refused when the library is compiled,
//! * a rounding mode other than to the nearest, and
//! * flushing of subnormal results or operands to zero. Code compiled with `-ffast-math` switches it on for a whole
//!   process when its library is loaded.
//!
//! The last two are settings of a thread, which new threads inherit. [`check_arithmetic`] detects them by seven
//! operations on any processor. The program calls it at its start, and `fk::solve::certify` before every certified
//! solve, so no certificate comes from such a thread.

use std::hint::black_box;

use thiserror::Error;

#[cfg(all(target_arch = "x86", not(target_feature = "sse2")))]
compile_error!(
    "equipod proves by interval arithmetic, which x87 registers break: compile for a target with SSE2 (i686, not i586)"
);

/// A deviation of the arithmetic from the assumptions of interval proofs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum UnfitArithmetic {
    /// Sums are not rounded to the nearest double.
    #[error("this thread does not round to the nearest double, which interval proofs assume")]
    NotToNearest,
    /// Subnormal numbers, below `2^-1022`, are treated as zero.
    #[error("this thread takes numbers below 2.2e-308 for zero, which interval proofs do not allow")]
    SubnormalsFlushed,
}

/// Tests by computing whether this thread rounds to the nearest and keeps subnormal numbers.
///
/// # Errors
/// [`UnfitArithmetic`] names the first deviation.
pub fn check_arithmetic() -> Result<(), UnfitArithmetic> {
    fitness(|x, y| black_box(x) + black_box(y), |x, y| black_box(x) * black_box(y))
}

/// The test for any sum and product, so that deviations can be tested without changing the processor mode.
fn fitness(sum: impl Fn(f64, f64) -> f64, product: impl Fn(f64, f64) -> f64) -> Result<(), UnfitArithmetic> {
    let quarter = f64::EPSILON / 4.0;
    // bits are compared: a comparison of doubles would flush its operands as well
    let gives = |x: f64, expected: f64| black_box(x).to_bits() == expected.to_bits();
    // in the order of the lines: not upwards, nor in wide registers; not downwards; not towards zero; ties to even
    let to_nearest = gives(sum(1.0, quarter), 1.0)
        && gives(sum(-1.0, -quarter), -1.0)
        && gives(sum(1.0, 3.0 * quarter), 1.0 + f64::EPSILON)
        && gives(sum(-1.0, -3.0 * quarter), -1.0 - f64::EPSILON)
        && gives(sum(1.0 + f64::EPSILON, 2.0 * quarter), 1.0 + 2.0 * f64::EPSILON);
    if !to_nearest {
        return Err(UnfitArithmetic::NotToNearest);
    }
    let subnormal = f64::from_bits(1);
    let result_kept = gives(product(f64::MIN_POSITIVE, 0.5), f64::from_bits(1 << 51));
    // the exponent of 2^-1074 times 2^1000
    let operand_kept = gives(product(subnormal, 2f64.powi(1000)), 2f64.powi(-74));
    if result_kept && operand_kept { Ok(()) } else { Err(UnfitArithmetic::SubnormalsFlushed) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of `s = x + y` (Knuth 1969), exact without overflow.
    fn error(x: f64, y: f64, s: f64) -> f64 {
        let back = s - x;
        (x - (s - back)) + (y - back)
    }

    fn plain(x: f64, y: f64) -> f64 {
        x * y
    }

    #[test]
    fn this_thread_and_its_children_compute_as_proofs_assume() {
        assert_eq!(check_arithmetic(), Ok(()));
        assert_eq!(std::thread::spawn(check_arithmetic).join().unwrap(), Ok(()));
    }

    #[test]
    fn directed_rounding_is_found() {
        type Correct = fn(f64, f64) -> f64;
        let up: Correct = |s, e| if e > 0.0 { s.next_up() } else { s };
        let down: Correct = |s, e| if e < 0.0 { s.next_down() } else { s };
        let to_zero: Correct = |s, e| {
            let outside = if s > 0.0 { e < 0.0 } else { e > 0.0 };
            if outside { f64::from_bits(s.to_bits() - 1) } else { s }
        };
        for correct in [up, down, to_zero] {
            let sum = |x: f64, y: f64| correct(x + y, error(x, y, x + y));
            assert_eq!(fitness(sum, plain), Err(UnfitArithmetic::NotToNearest));
        }
    }

    #[test]
    fn ties_that_do_not_go_to_the_even_neighbour_are_found() {
        // here the even neighbour is above: take the one below
        let odd = |x: f64, y: f64| {
            let s = x + y;
            if error(x, y, s).to_bits() == (-f64::EPSILON / 2.0).to_bits() { s.next_down() } else { s }
        };
        assert_eq!(fitness(odd, plain), Err(UnfitArithmetic::NotToNearest));
    }

    #[test]
    fn subnormals_taken_for_zero_are_found_in_results_and_in_operands() {
        let flushed = |x: f64| if x.is_subnormal() { 0.0_f64.copysign(x) } else { x };
        let sum = |x: f64, y: f64| x + y;
        assert_eq!(fitness(sum, |x, y| flushed(x * y)), Err(UnfitArithmetic::SubnormalsFlushed));
        assert_eq!(fitness(sum, |x, y| flushed(x) * flushed(y)), Err(UnfitArithmetic::SubnormalsFlushed));
        assert_eq!(fitness(sum, plain), Ok(()));
    }
}
