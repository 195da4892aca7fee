//! The chi-square distribution: what sums of squares of standard normal numbers do.

/// Terms of a series or a continued fraction at most; the number grows with the root of the degrees of freedom.
const TERMS: usize = 100_000;
/// Halvings of an interval of quantiles: more than a double has digits.
const HALVINGS: usize = 200;

/// The probability that the sum of the squares of `freedoms` independent standard normal numbers exceeds `value`: `Q(freedoms / 2, value / 2)`, the upper incomplete
/// gamma function over the complete one.
///
/// By its power series below the mean and by Lentz's continued fraction above it (Abramowitz, Stegun 1964, 6.5.29 and 6.5.31). 1 where there are no
/// degrees of freedom and the value is at most zero.
#[must_use]
pub fn chi_square_exceeds(value: f64, freedoms: usize) -> f64 {
    if !(value > 0.0) {
        return 1.0;
    }
    if freedoms == 0 {
        return 0.0;
    }
    let (a, x) = (0.5 * freedoms as f64, 0.5 * value);
    let front = (a * x.ln() - x - ln_gamma_of_half(freedoms)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum) = (1.0 / a, 1.0 / a);
        for n in 1..TERMS {
            term *= x / (a + n as f64);
            sum += term;
            if term < sum * f64::EPSILON {
                break;
            }
        }
        return (1.0 - front * sum).clamp(0.0, 1.0);
    }
    let mut b = x + 1.0 - a;
    let mut c = f64::INFINITY;
    let mut d = 1.0 / b;
    let mut h = d;
    for n in 1..TERMS {
        let n = n as f64;
        let an = n * (a - n);
        b += 2.0;
        d = 1.0 / (an * d + b);
        c = b + an / c;
        h *= d * c;
        if (d * c - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    (front * h).clamp(0.0, 1.0)
}

/// The value that is exceeded with this probability, by bisection.
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

/// `ln Gamma(n / 2)` by `Gamma(x + 1) = x Gamma(x)` from `Gamma(1/2) = sqrt(pi)` or `Gamma(1) = 1`.
fn ln_gamma_of_half(n: usize) -> f64 {
    let (mut x, mut sum) = if n % 2 == 1 { (0.5, 0.5 * std::f64::consts::PI.ln()) } else { (1.0, 0.0) };
    let end = 0.5 * n as f64;
    while x < end - 0.25 {
        sum += f64::ln(x);
        x += 1.0;
    }
    sum
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
