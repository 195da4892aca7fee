//! `[limits]`: the safety margins of the limits.

use serde_json::{Map, Value as Json, json};

use super::found::{check_keys, shown, table};
use super::kind::{KeyForm, KeyKind, KeyShape, Range, either, not_negative, own, table as table_of, unit};
use super::renamed::OLD_ROWS;
use super::stored::StoredValue;
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::{Entry, Value, find};
use crate::design::violation::Findings;
use machine::requirements::{Quantity, SafetyMargin, SafetyMargins, TermKind};

/// The safety margin of every limit without its own.
const ALL: &str = "all";

const PERCENT: KeyKind = own(r##"{"$ref": "#/$defs/percent"}"##, unit::NONE);

/// The row of `assess` of this name.
fn row(name: &str) -> Option<TermKind> {
    TermKind::ALL.into_iter().find(|kind| kind.code() == name)
}

/// The names of the rows of `assess`.
struct ByKind;

static BY_KIND: ByKind = ByKind;

impl KeyShape for ByKind {
    fn kind(&self, key: &str) -> Option<KeyKind> {
        if key == ALL {
            return Some(PERCENT);
        }
        let kind = row(key)?;
        Some(not_negative(match kind.quantity() {
            Quantity::Length => unit::LENGTH,
            Quantity::Speed => unit::SPEED,
            Quantity::AngularStiffness | Quantity::Torque => unit::TORQUE,
            Quantity::LinearStiffness => unit::STIFFNESS,
            Quantity::Force => unit::FORCE,
            Quantity::Angle | Quantity::AngularSpeed => unit::DEGREES,
            Quantity::Frequency => unit::NONE,
        }))
    }

    fn renamed(&self, old: &str) -> Option<&'static str> {
        OLD_ROWS.iter().find(|(name, _)| *name == old).map(|(_, kind)| kind.code())
    }

    fn schema(&self, _: &mut Map<String, Json>) -> Json {
        let safety_margin =
            |kind: TermKind| (kind.code().to_owned(), json!({"$ref": "#/$defs/safety_margin"}));
        let mut properties = Map::from_iter([(ALL.to_owned(), json!({"$ref": "#/$defs/percent"}))]);
        properties.extend(TermKind::ALL.map(safety_margin));
        json!({"type": "object", "properties": properties, "additionalProperties": false})
    }
}

pub(super) static LIMITS: KeyTable<SafetyMargins> = KeyTable {
    keys: &[key!("safety_margin" { old = "reserve" }: either(&[PERCENT, table_of(&BY_KIND)]),
        safety_margin, written;
        "one percentage for all limits, or amounts and percentages by the names of the rows of assess")],
    ..KeyTable::EMPTY
};

/// `[limits]`.
pub(super) fn safety_margins(report: &mut Findings<'_>, top: &[Entry]) -> SafetyMargins {
    let mut safety_margins = SafetyMargins::default();
    if let Some(entry) = find(top, "limits") {
        LIMITS.read(report, &entry.node, "[limits]", &mut safety_margins);
    }
    safety_margins
}

fn safety_margin(found: &mut FoundKey<'_, '_>, to: &mut SafetyMargins) {
    if !matches!(found.entry.node.value, Value::Table(_)) {
        to.all = percent(found);
        return;
    }
    let place = "`safety_margin`";
    let own = table(found.report, &found.entry.node, place).unwrap_or_default();
    let known: Vec<&str> = TermKind::ALL.map(TermKind::code).into_iter().chain([ALL]).collect();
    check_keys(found.report, own, &known, place);
    for entry in own {
        let kind = KeyKind::new(KeyForm::Number(Range::NotNegative), unit::NONE);
        let mut found = FoundKey { report: &mut *found.report, entry, place, kind };
        if entry.key == ALL {
            to.all = percent(&mut found);
        }
        let Some(kind) = row(&entry.key) else { continue };
        let safety_margin = if matches!(entry.node.value, Value::Text(_)) {
            percent(&mut found).map(SafetyMargin::Percent)
        } else {
            found.number().map(SafetyMargin::Amount)
        };
        to.kinds.extend(safety_margin.map(|safety_margin| (kind, safety_margin)));
    }
}

/// `"5%"`.
fn percent(found: &mut FoundKey<'_, '_>) -> Option<f64> {
    let (key, help) = (&found.entry.key, "write a percentage in quotes, such as \"5%\"");
    if !matches!(found.entry.node.value, Value::Text(_)) {
        return found.report.not_a(&found.entry.node, &format!("`{key}`"), "a percentage", help);
    }
    let word = found.text()?;
    let value = word.trim().strip_suffix('%').and_then(|x| x.trim().parse::<f64>().ok());
    let value = value.filter(|x| (0.0..100.0).contains(x));
    if value.is_none() {
        let help = format!("{help}, from 0% to less than 100%");
        found.refuse(Code::OutOfRange, format!("`{key}` is \"{}\"", shown(&word)), help);
    }
    value
}

/// A single percentage if nothing else is stated, otherwise a table in the order of the names.
fn written(safety_margins: &SafetyMargins) -> Option<Json> {
    let percent = |x: f64| json!(format!("{x}%"));
    if safety_margins.kinds.is_empty() {
        return safety_margins.all.map(percent);
    }
    let own = safety_margins.kinds.iter().map(|(kind, safety_margin)| match safety_margin {
        SafetyMargin::Percent(x) => (kind.code(), percent(*x)),
        SafetyMargin::Amount(x) => (kind.code(), x.json()),
    });
    let mut all: Vec<_> = own.chain(safety_margins.all.map(|x| (ALL, percent(x)))).collect();
    all.sort_by_key(|(name, _)| *name);
    Some(all.into_iter().map(|(name, value)| (name.to_owned(), value)).collect::<Map<_, _>>().into())
}
