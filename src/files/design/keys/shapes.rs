//! `box`, `sphere` and `capsule`: bodies that the legs keep clear of.

use nalgebra::{Point3, Vector3};
use serde_json::{Value as Json, json};

use super::found::{self, check_keys};
use super::kind::{EDGES, numbers, positive, unit, vector};
use super::{Code, FoundKey, KeyTable, key};
use crate::design::tree::find;
use machine::requirements::KeepOutShape;

/// The help names all keys of the shape.
const ADD: &str = "add it";

/// The keys of a shape.
#[derive(Default)]
pub(super) struct ShapeKeys {
    center: Option<Point3<f64>>,
    size: Option<Vector3<f64>>,
    from: Option<Point3<f64>>,
    to: Option<Point3<f64>>,
    diameter: Option<f64>,
}

pub(super) static BOX: KeyTable<ShapeKeys> = KeyTable {
    definition: "box",
    keys: &[
        key!("center" { required = ADD }: vector(unit::LENGTH), center; ""),
        key!("size" { required = ADD }: numbers(&EDGES, unit::LENGTH), size; ""),
    ],
    ..KeyTable::EMPTY
};

pub(super) static SPHERE: KeyTable<ShapeKeys> = KeyTable {
    definition: "sphere",
    keys: &[
        key!("center" { required = ADD }: vector(unit::LENGTH), center; ""),
        key!("diameter" { required = ADD }: positive(unit::LENGTH), diameter; ""),
    ],
    ..KeyTable::EMPTY
};

pub(super) static CAPSULE: KeyTable<ShapeKeys> = KeyTable {
    definition: "capsule",
    keys: &[
        key!("from" { required = ADD }: vector(unit::LENGTH), from; ""),
        key!("to" { required = ADD }: vector(unit::LENGTH), to; ""),
        key!("diameter" { required = ADD }: positive(unit::LENGTH), diameter; ""),
    ],
    ..KeyTable::EMPTY
};

/// The shape of a key that is named after it.
pub(super) fn shape(found: &mut FoundKey<'_, '_>) -> Option<KeepOutShape> {
    let (place, mut keys) = (format!("`{}`", found.entry.key), ShapeKeys::default());
    let table = match found.entry.key.as_str() {
        "box" => &BOX,
        "sphere" => &SPHERE,
        _ => &CAPSULE,
    };
    let names = table.names();
    let entries = found::table(found.report, &found.entry.node, &place)?;
    check_keys(found.report, entries, &names, &place);
    let missing: Vec<_> = names.iter().filter(|key| find(entries, key).is_none()).collect();
    for key in &missing {
        let help = format!("{place} takes {}", names.join(", "));
        found.refuse(Code::MissingKey, format!("`{key}` of {place} is missing"), help);
    }
    table.fill(found.report, entries, &place, &mut keys, |_| missing.is_empty());
    Some(match found.entry.key.as_str() {
        "box" => KeepOutShape::Box { center: keys.center?, size: keys.size? },
        "sphere" => KeepOutShape::Sphere { center: keys.center?, diameter: keys.diameter? },
        _ => KeepOutShape::Capsule { from: keys.from?, to: keys.to?, diameter: keys.diameter? },
    })
}

/// The value of the key, if it is the key of the shape.
pub(super) fn written(shape: Option<&KeepOutShape>, key: &str) -> Option<Json> {
    let none = ShapeKeys::default();
    let (name, table, keys) = match *shape? {
        KeepOutShape::Box { center, size } => {
            ("box", &BOX, ShapeKeys { center: Some(center), size: Some(size), ..none })
        }
        KeepOutShape::Sphere { center, diameter } => {
            ("sphere", &SPHERE, ShapeKeys { center: Some(center), diameter: Some(diameter), ..none })
        }
        KeepOutShape::Capsule { from, to, diameter } => {
            let keys = ShapeKeys { from: Some(from), to: Some(to), diameter: Some(diameter), ..none };
            ("capsule", &CAPSULE, keys)
        }
    };
    (name == key).then(|| json!(table.write(&keys)))
}
