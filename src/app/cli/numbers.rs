//! Numbers in options: decimals, or expressions as in design files.

use files::design::Share;
use num::surd::Surd;

/// So many finite numbers separated by commas.
pub(crate) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let one = |field: &str| field.parse().ok().map(|x: Share| x.nearest()).filter(|x| x.is_finite());
    let all: Option<Vec<f64>> = text.split(',').map(one).collect();
    all.and_then(|v| v.try_into().ok())
}

/// So many exact numbers separated by commas.
///
/// # Errors
/// What is wrong with the text.
pub(crate) fn exact<const N: usize>(text: &str) -> Result<[Surd; N], String> {
    let one = |field: &str| {
        let number: Share = field.parse().map_err(|why: files::design::InvalidShare| why.to_string())?;
        number
            .exact()
            .cloned()
            .ok_or_else(|| format!("`{field}` has no exact value in square roots and cosines"))
    };
    let all: Vec<Surd> = text.split(',').map(one).collect::<Result<_, _>>()?;
    all.try_into().map_err(|_| format!("`{text}` is not {N} numbers"))
}
