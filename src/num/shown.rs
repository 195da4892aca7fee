//! Numbers as people read them.

/// So many decimals; what rounds to zero has no sign.
pub fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.bytes().all(|b| matches!(b, b'0' | b'.')) => rest.to_owned(),
        _ => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_rounds_to_zero_has_no_sign() {
        let four = [-1e-9, 0.0, -0.0, -5.1e-5, 1.0, -12.5].map(|x| fixed(x, 4));
        assert_eq!(four, ["0.0000", "0.0000", "0.0000", "-0.0001", "1.0000", "-12.5000"]);
        assert_eq!([-0.4, -0.6, f64::NEG_INFINITY].map(|x| fixed(x, 0)), ["0", "-1", "-inf"]);
    }
}
