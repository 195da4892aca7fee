//! The meaning of column names and of units beside numbers.

use crate::design::scale::LengthRatio;
use platform::geom::AngleUnit;

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
pub(super) const UNITS: [(&str, &str); 21] = [
    ("mm", "mm"),
    ("millimeter", "mm"),
    ("millimetre", "mm"),
    ("millimeters", "mm"),
    ("millimetres", "mm"),
    ("cm", "cm"),
    ("centimeter", "cm"),
    ("centimetre", "cm"),
    ("um", "um"),
    ("\u{b5}m", "um"),
    ("\u{3bc}m", "um"),
    ("inches", "in"),
    ("inch", "in"),
    ("in", "in"),
    ("feet", "ft"),
    ("ft", "ft"),
    ("meter", "m"),
    ("metre", "m"),
    ("meters", "m"),
    ("metres", "m"),
    ("m", "m"),
];

/// The label of a spelling of a length unit.
fn label_of(word: &str) -> Option<&'static str> {
    UNITS.iter().find(|(spelling, _)| *spelling == word).map(|(_, label)| *label)
}

/// The unit of an angle, from its spelling.
fn angle_label(word: &str) -> Option<AngleUnit> {
    match word {
        "deg" | "degree" | "degrees" | "grad" | "\u{b0}" => Some(AngleUnit::Degrees),
        "rad" | "radian" | "radians" => Some(AngleUnit::Radians),
        _ => None,
    }
}

/// The unit at the end of a cell or below the name of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum CellUnit {
    Length(&'static str),
    Angle(AngleUnit),
}

impl CellUnit {
    /// The unit of a word without brackets.
    pub(super) fn of(word: &str) -> Option<Self> {
        let word = word.trim_matches(|c: char| c.is_whitespace() || "[]()".contains(c)).to_lowercase();
        label_of(&word).map(Self::Length).or_else(|| angle_label(&word).map(Self::Angle))
    }

    /// Its word in the name of a column.
    pub(super) fn word(self) -> &'static str {
        match self {
            Self::Length(label) => label,
            Self::Angle(AngleUnit::Degrees) => "deg",
            Self::Angle(AngleUnit::Radians) => "rad",
        }
    }
}

/// The words of a name, in lower case.
fn words(name: &str) -> Vec<String> {
    let lower = name.to_lowercase();
    lower
        .split(|c: char| !(c.is_alphanumeric() || c == '\u{b0}'))
        .filter(|word| !word.is_empty())
        .map(String::from)
        .collect()
}

/// The contents of brackets in a name.
fn in_brackets(name: &str) -> impl Iterator<Item = &str> {
    name.split(['[', '(']).skip(1).filter_map(|rest| rest.split([']', ')']).next())
}

/// The length unit in the name of a column: in brackets, or its last word.
pub(super) fn length_unit(name: &str) -> Option<&'static str> {
    let bracketed = in_brackets(name).find_map(|inner| match CellUnit::of(inner) {
        Some(CellUnit::Length(label)) => Some(label),
        _ => None,
    });
    let words = words(name);
    // `m` alone is a name
    bracketed.or_else(|| label_of(words.last().filter(|_| words.len() > 1)?))
}

/// The units of lengths and of angles that a title or a comment states, such as `all sizes in mm` or `joints [cm]`.
pub(super) fn units_in_title(line: &str) -> (Option<&'static str>, Option<AngleUnit>) {
    let words = words(line);
    let stated = |word: &str| ["in", "unit", "units", "einheit", "einheiten"].contains(&word);
    let mut found = (None, None);
    let bracketed = in_brackets(line).map(str::to_lowercase);
    let named = words.windows(2).filter(|pair| stated(&pair[0])).map(|pair| pair[1].clone());
    for word in bracketed.chain(named) {
        match CellUnit::of(&word) {
            // `in` is a word of sentences too
            Some(CellUnit::Length(label)) if word != "in" => found.0 = found.0.or(Some(label)),
            Some(CellUnit::Angle(unit)) => found.1 = found.1.or(Some(unit)),
            _ => {}
        }
    }
    found
}

/// A length in another unit; `None` if a label is no known unit.
pub(super) fn converted(x: f64, from: &str, to: &str) -> Option<f64> {
    Some(LengthRatio::of_labels(from, to)?.of(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_names_and_titles_are_their_words_and_not_parts_of_words() {
        for (name, unit) in [
            ("x [mm]", Some("mm")),
            ("base_x_cm", Some("cm")),
            ("X (m)", Some("m")),
            ("L1 in", Some("in")),
            ("m", None),
            ("bottom", None),
            ("v [m/s]", None),
        ] {
            assert_eq!(length_unit(name), unit, "{name}");
        }
        let degrees = Some(AngleUnit::Degrees);
        for (line, units) in [
            ("Joint centres; all sizes in inch", (Some("in"), None)),
            ("Base joints (mm)", (Some("mm"), None)),
            ("position in m, angles in rad", (Some("m"), Some(AngleUnit::Radians))),
            ("units: cm", (Some("cm"), None)),
            ("angles [\u{b0}], measured in May", (None, degrees)),
            ("Motion log", (None, None)),
        ] {
            assert_eq!(units_in_title(line), units, "{line}");
        }
        assert_eq!(converted(0.25, "m", "mm"), Some(250.0));
        assert_eq!(converted(2.0, "in", "cm"), Some(5.08));
        assert_eq!(converted(2.0, "in", "bananas"), None);
    }
}
