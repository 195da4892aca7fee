//! Numbers in options, and in texts for people.

use num::shown::fixed;

/// So many finite numbers separated by commas.
pub(crate) fn parse<const N: usize>(text: &str) -> Option<[f64; N]> {
    let all: Option<Vec<f64>> =
        text.split(',').map(|f| f.trim().parse().ok().filter(|x: &f64| x.is_finite())).collect();
    all.and_then(|v| v.try_into().ok())
}

/// Six significant digits.
pub(crate) fn significant(x: f64) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{}", x + 0.0);
    }
    let digits = 5 - x.abs().log10().floor() as i64;
    match usize::try_from(digits) {
        Ok(digits) if digits <= 12 => {
            let text = format!("{x:.digits$}");
            if text.contains('.') {
                text.trim_end_matches('0').trim_end_matches('.').to_string()
            } else {
                text
            }
        }
        Ok(_) => format!("{x:.5e}"),
        Err(_) => format!("{x:.0}"),
    }
}

/// The width of a column of names of drives: a name of more than forty characters pushes its row aside, and a row that a file makes wide costs nothing.
pub(crate) fn width_of<'a>(names: impl Iterator<Item = &'a str>) -> usize {
    names.map(|name| name.chars().count()).fold(5, usize::max).min(40)
}

/// Numbers with so many decimals, in brackets; what rounds to zero has no sign.
pub(crate) fn listed(numbers: impl IntoIterator<Item = f64>, decimals: usize) -> String {
    format!("[{}]", numbers.into_iter().map(|x| fixed(x, decimals)).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_as_long_as_a_file_makes_no_column_as_wide() {
        let long = "x".repeat(70_000);
        assert_eq!(
            [vec![], vec!["a", "abcdefg"], vec![&long[..]]].map(|n| width_of(n.into_iter())),
            [5, 7, 40]
        );
        assert!(format!("{:<width$}", long, width = width_of([&long[..]].into_iter())).len() == 70_000);
    }

    #[test]
    fn numbers_for_people_have_six_digits_that_count() {
        for (x, text) in [
            (0.0, "0"),
            (-0.0, "0"),
            (1.0, "1"),
            (-123.456_789, "-123.457"),
            (123_456_789.0, "123456789"),
            (1.25e-6, "0.00000125"),
            (1.25e-9, "1.25000e-9"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(significant(x), text);
        }
    }
}
