//! Names of columns of times, lengths and angles, and their numbers.

use crate::design::table::header::CellUnit;
use platform::geom::AngleUnit;

pub(super) fn is_time(name: &str) -> bool {
    ["time", "zeit", "temps", "tiempo", "tempo"].iter().any(|word| name.starts_with(word))
        || ["t", "ts", "tms", "sec", "seconds"].contains(&name)
}

/// Whether a plain name is that of a travel, which is a length less the least one.
pub(super) fn is_travel(name: &str) -> bool {
    ["stroke", "ext", "travel", "hub", "course"].iter().any(|word| name.starts_with(word))
}

/// A name whose number stands in brackets: `position[0]`.
pub(super) fn numbered_name(name: &str) -> String {
    match name.trim().strip_suffix(']').and_then(|head| head.split_once('[')) {
        Some((word, number)) if word.ends_with(char::is_alphanumeric) && number.parse::<u8>().is_ok() => {
            format!("{word}{number}")
        }
        _ => name.to_owned(),
    }
}

/// Column names of leg lengths.
pub(super) const LENGTH_WORDS: [&str; 3] = ["leg", "len", "l"];

/// Column names of crank angles.
pub(super) const ANGLE_WORDS: [&str; 7] = ["crank", "angle", "motor", "servo", "theta", "alpha", "q"];

/// The unit of angles at the end of a name, in brackets or not.
pub(super) fn angle_unit_of(name: &str) -> Option<AngleUnit> {
    if let Some(CellUnit::Angle(unit)) = name.rsplit(['[', '(']).next().and_then(CellUnit::of) {
        return Some(unit);
    }
    let letters: String = name.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
    let ends = |words: [&str; 3]| words.iter().any(|word| letters.ends_with(word));
    if ends(["rad", "radian", "radians"]) {
        Some(AngleUnit::Radians)
    } else {
        ends(["deg", "degree", "degrees"]).then_some(AngleUnit::Degrees)
    }
}

/// The names without angle units at their ends.
pub(super) fn without_angle_units(names: &[String]) -> Vec<String> {
    let ends = ["degrees", "degree", "deg", "radians", "rad"];
    let less = |name: &String| ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name).to_string();
    names.iter().map(less).collect()
}

/// The six columns with one word and the numbers 1 to 6, or 0 to 5, in the order of the numbers. A known word selects
/// one of several such lists.
pub(super) fn numbered_columns(names: &[String], known: &[&str]) -> Option<Vec<usize>> {
    let parted: Vec<(&str, &str)> =
        names.iter().map(|n| n.split_at(n.trim_end_matches(|c: char| c.is_ascii_digit()).len())).collect();
    let of = |word: &str| -> Option<Vec<usize>> {
        let column = |k: u8| {
            let mut found =
                (0..parted.len()).filter(|c| parted[*c].0 == word && parted[*c].1.parse() == Ok(k));
            let one = found.next()?;
            if found.next().is_none() { Some(one) } else { None }
        };
        (1..=6).map(column).collect::<Option<_>>().or_else(|| (0..=5).map(column).collect())
    };
    // of several lists, such as lengths beside speeds, choose the one with a known word
    let words = parted.iter().map(|(word, _)| *word).filter(|word| !word.is_empty());
    let called = |word: &str| {
        known.iter().any(|name| word == *name || (name.len() > 1 && *name != "leg" && word.contains(name)))
    };
    let mut words: Vec<&str> = words.collect();
    words.sort_by_key(|word| !called(word));
    words.into_iter().find_map(of)
}
