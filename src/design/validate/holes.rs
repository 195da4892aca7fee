//! `[holes]`: grids on which the joints of both plates can be put.

use super::tables::positive;
use super::{check_keys, nearest_help, number, numbers, shown, table, text};
use crate::design::Code;
use crate::design::tree::{Entry, find};
use crate::design::violation::Findings;
use crate::requirements::{Grid, HolePattern};

/// The plates, base first.
pub(super) const PLATE_KEYS: [&str; 2] = ["base", "platform"];
/// The keys of a grid.
pub(super) const GRID_KEYS: [&str; 4] = ["pattern", "pitch", "origin", "angle_deg"];

/// `[holes]`.
pub(super) fn holes(report: &mut Findings<'_>, top: &[Entry]) -> Option<[Grid; 2]> {
    let place = "[holes]";
    let entry = find(top, "holes")?;
    let entries = table(report, &entry.node, place)?;
    check_keys(report, entries, &PLATE_KEYS, place);
    let [base, platform] = PLATE_KEYS.map(|key| {
        let Some(e) = find(entries, key) else {
            let (message, help) =
                (format!("{place} has no `{key}`"), format!("add {key} = {{ pitch = 25 }}"));
            report.refuse(Code::MissingKey, &entry.key_span, message, help);
            return None;
        };
        grid(report, e)
    });
    Some([base?, platform?])
}

fn grid(report: &mut Findings<'_>, entry: &Entry) -> Option<Grid> {
    let place = format!("`{}` of [holes]", entry.key);
    let entries = table(report, &entry.node, &place)?;
    check_keys(report, entries, &GRID_KEYS, &place);
    if find(entries, "pitch").is_none() {
        let message = format!("{place} has no `pitch`");
        let help = "add pitch = 25, the distance of neighbouring holes";
        report.refuse(Code::MissingKey, &entry.key_span, message, help);
    }
    let pattern = match find(entries, "pattern") {
        None => Some(HolePattern::default()),
        Some(e) => pattern(report, e),
    };
    let origin = match find(entries, "origin") {
        None => Some([0.0; 2]),
        Some(e) => {
            let what = format!("`origin` of {place}");
            numbers::<2>(report, &e.node, &what, Code::CoordinateCount, "coordinates x, y of a hole")
        }
    };
    let angle_deg = match find(entries, "angle_deg") {
        None => Some(0.0),
        Some(e) => number(report, &e.node, &format!("`angle_deg` of {place}")),
    };
    let pitch = positive(report, entries, "pitch");
    Some(Grid { pattern: pattern?, pitch: pitch?, origin: origin?, angle_deg: angle_deg? })
}

fn pattern(report: &mut Findings<'_>, entry: &Entry) -> Option<HolePattern> {
    let word = text(report, entry)?;
    let found = HolePattern::ALL.into_iter().find(|p| p.name() == word);
    if found.is_none() {
        let message = format!("`{}` is no pattern of holes", shown(&word));
        let help = nearest_help("patterns", &word, &HolePattern::ALL.map(HolePattern::name));
        report.refuse(Code::UnknownKey, &entry.node.span, message, help);
    }
    found
}
