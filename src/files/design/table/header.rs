//! The meaning of column names.

/// Letters and digits of a name, in lower case, without parts in brackets.
pub(super) fn plain(name: &str) -> String {
    let mut depth = 0_usize;
    let kept = name.chars().filter(|c| match c {
        '[' | '(' => {
            depth += 1;
            false
        }
        ']' | ')' => {
            depth = depth.saturating_sub(1);
            false
        }
        c => depth == 0 && c.is_alphanumeric(),
    });
    let plain = kept.collect::<String>().to_lowercase();
    // `x_mm`: the unit is not part of the name, unless it is the whole name
    let less = UNITS.iter().find_map(|(suffix, _)| {
        let separated = name.trim().to_lowercase();
        let head = separated.strip_suffix(suffix)?;
        head.ends_with(['_', ' ', '/'])
            .then(|| head.chars().filter(|c| c.is_alphanumeric()).collect::<String>())
    });
    less.unwrap_or(plain)
}

/// Spellings of length units in headers, and their labels.
pub(super) const UNITS: [(&str, &str); 12] = [
    ("mm", "mm"),
    ("millimeter", "mm"),
    ("millimetre", "mm"),
    ("cm", "cm"),
    ("um", "um"),
    ("\u{b5}m", "um"),
    ("\u{3bc}m", "um"),
    ("inches", "in"),
    ("inch", "in"),
    ("in", "in"),
    ("ft", "ft"),
    ("m", "m"),
];
