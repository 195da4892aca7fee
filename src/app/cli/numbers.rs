//! Numbers in options, and in texts for people.

use num::shown::fixed;

/// So many finite numbers separated by commas.
pub(crate) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> =
        text.split(',').map(|f| f.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    all.and_then(|v| v.try_into().ok())
}

/// Numbers with so many decimals, in brackets; what rounds to zero has no sign.
pub(crate) fn listed(numbers: impl IntoIterator<Item = f64>, decimals: usize) -> String {
    format!("[{}]", numbers.into_iter().map(|x| fixed(x, decimals)).collect::<Vec<_>>().join(", "))
}
