//! Numbers in options: decimals, or expressions as in design files.

use files::design::Share;
use num::surd::Surd;

/// The double nearest to a finite number.
pub(crate) fn one(text: &str) -> Option<f64> {
    let double: Option<f64> = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    double.or_else(|| text.parse().ok().map(|x: Share| x.nearest()).filter(|x| x.is_finite()))
}

/// The value of an option that is one number.
///
/// # Errors
/// The fault of the text.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    one(text).ok_or_else(|| {
        "this is no finite number, neither a decimal nor an expression such as 12/5".to_owned()
    })
}

/// Finite numbers separated by commas.
pub(crate) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> = text.split(',').map(one).collect();
    all.and_then(|v| v.try_into().ok())
}

/// Exact numbers separated by commas.
///
/// # Errors
/// The fault of the text.
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
