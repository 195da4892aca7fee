//! Numbers in the form for people.

/// A number with fixed decimals; a result of zero has no sign.
pub fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| matches!(b, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

/// Six significant digits.
pub fn significant(x: f64) -> String {
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
        Err(_) if x.abs() < 1e15 => format!("{x:.0}"),
        _ => format!("{x:.5e}"),
    }
}

/// At least so many significant digits; the digits before the point stay up to a million, and zeros at the end go.
pub fn rounded(x: f64, digits: usize) -> String {
    if x == 0.0 || !x.is_finite() {
        return format!("{}", x + 0.0);
    }
    let digits = digits.clamp(1, 17);
    let scientific = format!("{x:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i64 = exponent.parse().unwrap_or(0);
    let trimmed = |text: &str| {
        if text.contains('.') {
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        } else {
            text.to_owned()
        }
    };
    match usize::try_from(i64::try_from(digits).unwrap_or(17) - 1 - exponent) {
        // 0.000123 is still read at a glance
        Ok(decimals) if exponent >= -4 => trimmed(&format!("{x:.decimals$}")),
        Err(_) if x.abs() < 1e6 => format!("{x:.0}"),
        _ => format!("{}e{exponent}", trimmed(mantissa)),
    }
}

/// A positive number, rounded down to three significant digits, so that a limit of this value implies the original one.
pub fn rounded_down(x: f64) -> String {
    let (mut decimals, mut scale) = (0, 1.0);
    while x * scale < 100.0 && decimals < 300 {
        decimals += 1;
        scale *= 10.0;
    }
    format!("{:.decimals$}", (x * scale).floor() / scale)
}

/// The ends of an interval, rounded inward by at most a thousandth of its width, so that quoted values lie within it.
pub fn rounded_inward([least, most]: [f64; 2]) -> [String; 2] {
    let (mut decimals, mut step) = (0, 1.0);
    while (most - least).abs() * step < 1000.0 && decimals < 17 {
        decimals += 1;
        step *= 10.0;
    }
    [(least * step).ceil() / step, (most * step).floor() / step].map(|x| format!("{:.decimals$}", x + 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_ends_of_an_interval_are_rounded_inward() {
        assert_eq!(rounded_inward([94.2311, 139.8877]), ["94.24", "139.88"]);
        assert_eq!(rounded_inward([0.123_450_04, 0.123_670_06]), ["0.1234501", "0.1236700"]);
        assert_eq!(rounded_inward([-0.4, 98765.4]), ["0", "98765"]);
    }

    #[test]
    fn what_rounds_to_zero_has_no_sign() {
        let four = [-1e-9, 0.0, -0.0, -5.1e-5, 1.0, -12.5].map(|x| fixed(x, 4));
        assert_eq!(four, ["0.0000", "0.0000", "0.0000", "-0.0001", "1.0000", "-12.5000"]);
        let down = [0.012_399, 1.0, 0.999_99, 123.4, 5432.1, 6.015e-7].map(rounded_down);
        assert_eq!(down, ["0.0123", "1.00", "0.999", "123", "5432", "0.000000601"]);
        assert_eq!([-0.4, -0.6, f64::NEG_INFINITY].map(|x| fixed(x, 0)), ["0", "-1", "-inf"]);
    }

    #[test]
    fn digits_before_the_point_are_never_rounded_away() {
        for (x, digits, text) in [
            (1_234.56, 3, "1235"),
            (123.456, 3, "123"),
            (12.345_6, 3, "12.3"),
            (9.999, 3, "10"),
            (0.5, 3, "0.5"),
            (-0.000_123_456, 3, "-0.000123"),
            (1.239_9e-7, 3, "1.24e-7"),
            (7.0e-16, 3, "7e-16"),
            (123_456_789.0, 3, "1.23e8"),
            (123_456.78, 3, "123457"),
            (0.1, 17, "0.10000000000000001"),
            (0.0, 3, "0"),
            (-0.0, 3, "0"),
            (f64::INFINITY, 3, "inf"),
        ] {
            assert_eq!(rounded(x, digits), text, "{x}");
        }
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
            (1e300, "1.00000e300"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(significant(x), text);
        }
    }
}
