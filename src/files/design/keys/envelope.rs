//! `[envelope]`: the space that plates and machine may occupy.

use nalgebra::{Point3, Vector3};
use serde_json::{Value as Json, json};

use super::kind::{KeyKind, Numbers, numbers, positive, table, unit, vector};
use super::stored::StoredValue;
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::{Entry, find};
use crate::design::violation::Findings;
use machine::requirements::{Envelope, Envelopes};

/// The keys of a cylinder or of a box.
#[derive(Default)]
struct EnvelopeKeys {
    radius: Option<f64>,
    center: Option<[f64; 2]>,
    min: Option<Vector3<f64>>,
    max: Option<Vector3<f64>>,
}

static CENTER: Numbers = Numbers::coordinates(2, "coordinates x, y");

static SHAPE: KeyTable<EnvelopeKeys> = KeyTable {
    definition: "envelope",
    keys: &[
        key!("radius": positive(unit::LENGTH), radius; "of a cylinder about a line along the z axis"),
        key!("center" { default = "[0, 0]" }: numbers(&CENTER, unit::LENGTH).placed(), center;
            "of the cylinder"),
        key!("min": vector(unit::LENGTH), min; "the least coordinates of a box"),
        key!("max": vector(unit::LENGTH), max; "the greatest coordinates of a box"),
    ],
    rules: r#"{"oneOf": [{"required": ["radius"]}, {"required": ["min", "max"]}]}"#,
    ..KeyTable::EMPTY
};

const ENVELOPE: KeyKind = table(&SHAPE);

pub(super) static ENVELOPES: KeyTable<Envelopes> = KeyTable {
    keys: &[
        key!("base": ENVELOPE, base; "of the base joints with their housings, base frame"),
        key!("platform": ENVELOPE, platform; "of the platform joints with their housings, platform frame"),
        key!("machine": ENVELOPE, machine; "of all joints with their housings at every pose, base frame"),
    ],
    ..KeyTable::EMPTY
};

/// `[envelope]`.
pub(super) fn envelopes(report: &mut Findings<'_>, top: &[Entry]) -> Envelopes {
    let mut envelopes = Envelopes::default();
    if let Some(entry) = find(top, "envelope") {
        ENVELOPES.read(report, &entry.node, "[envelope]", &mut envelopes);
    }
    envelopes
}

impl StoredValue for Envelope {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        let (place, mut keys) = (format!("`{}` of [envelope]", found.entry.key), EnvelopeKeys::default());
        let entries = found.table(&SHAPE, &place, &mut keys)?;
        let has = |key: &str| find(entries, key).is_some();
        if has("radius") == (has("min") || has("max"))
            || has("min") != has("max")
            || (has("center") && has("min"))
        {
            let help = "give `{ radius = R }`, with `center = [x, y]` where it is not the origin, or `{ min = [x, y, z], max = [x, y, z] }`";
            let span = &found.entry.key_span;
            return found.report.refused(Code::MissingKey, span, format!("{place} is no shape"), help);
        }
        if has("radius") {
            let center = if has("center") { keys.center? } else { [0.0; 2] };
            return Some(Self::Cylinder { radius: keys.radius?, center });
        }
        let (min, max) = (keys.min?, keys.max?);
        if (0..3).any(|k| !(min[k] < max[k])) {
            let help = "give every coordinate of `max` greater than that of `min`";
            found.refuse(Code::OutOfRange, format!("the box of {place} is empty"), help);
        }
        Some(Self::Box { min: Point3::from(min), max: Point3::from(max) })
    }

    fn json(&self) -> Json {
        let none = EnvelopeKeys::default();
        json!(SHAPE.write(&match *self {
            Self::Cylinder { radius, center } => {
                EnvelopeKeys { radius: Some(radius), center: Some(center), ..none }
            }
            Self::Box { min, max } => {
                EnvelopeKeys { min: Some(min.coords), max: Some(max.coords), ..none }
            }
        }))
    }
}
