//! The chi-square distribution: sums of squares of standard normal numbers.

use statrs::function::gamma::checked_gamma_ur;

/// Halvings of an interval of quantiles: more than a double has digits.
const HALVINGS: usize = 200;

/// The probability that the sum of squares of `freedoms` independent standard normal numbers exceeds `value`. It is
/// `Q(freedoms / 2, value / 2)`, the upper incomplete gamma function over the complete one.
#[must_use]
pub fn chi_square_exceeds(value: f64, freedoms: usize) -> f64 {
    if !(value > 0.0) {
        return 1.0;
    }
    // the function refuses zero degrees of freedom and infinite values
    checked_gamma_ur(0.5 * freedoms as f64, 0.5 * value)
        .map_or(0.0, |probability| probability.clamp(0.0, 1.0))
}

/// The value that is exceeded with this probability, by bisection: `statrs` inverts `1 - exceeded`, which has lost
/// digits of small probabilities.
#[must_use]
pub fn chi_square_quantile(exceeded: f64, freedoms: usize) -> f64 {
    let (mut low, mut high) = (0.0, freedoms as f64 + 1.0);
    while chi_square_exceeds(high, freedoms) > exceeded && high < 1e12 {
        high *= 2.0;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if chi_square_exceeds(middle, freedoms) > exceeded {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn probabilities_are_those_of_closed_forms_and_tables() {
        for value in [0.1, 1.0, 5.0, 30.0] {
            // two degrees of freedom: exp(-x / 2); four: (1 + x / 2) exp(-x / 2)
            let half = 0.5 * value;
            assert!((chi_square_exceeds(value, 2) - (-half).exp()).abs() < 1e-14);
            assert!((chi_square_exceeds(value, 4) - (1.0 + half) * (-half).exp()).abs() < 1e-14);
        }
        // Abramowitz, Stegun 1964, table 26.8
        for (exceeded, freedoms, value) in
            [(0.05, 1, 3.84146), (0.05, 6, 12.5916), (0.01, 30, 50.8922), (0.995, 10, 2.15585)]
        {
            assert!((chi_square_quantile(exceeded, freedoms) - value).abs() < 1e-4 * value);
        }
        for freedoms in [1, 7, 198, 3000] {
            for exceeded in [1e-9, 0.3, 0.999] {
                let value = chi_square_quantile(exceeded, freedoms);
                assert!((chi_square_exceeds(value, freedoms) / exceeded - 1.0).abs() < 1e-6);
            }
        }
        assert_eq!((chi_square_exceeds(0.0, 3), chi_square_exceeds(1.0, 0)), (1.0, 0.0));
    }
}
