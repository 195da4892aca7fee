//! Kinds of values: their types, ranges and units, and their schema.

use serde_json::{Map, Value as Json, json};

use super::{Code, KeyTable};

/// The power of the length unit in the unit of a value; it determines the change with that unit.
pub(super) mod unit {
    /// A number, an angle, a share.
    pub(in crate::design::keys) const NONE: i8 = 0;
    pub(in crate::design::keys) const FORCE: i8 = 0;
    pub(in crate::design::keys) const MASS: i8 = 0;
    pub(in crate::design::keys) const DEGREES: i8 = 0;
    pub(in crate::design::keys) const LENGTH: i8 = 1;
    /// Length over time.
    pub(in crate::design::keys) const SPEED: i8 = 1;
    /// Force times length; also the bending stiffness.
    pub(in crate::design::keys) const TORQUE: i8 = 1;
    /// Force over length.
    pub(in crate::design::keys) const STIFFNESS: i8 = -1;
    /// Mass times length squared.
    pub(in crate::design::keys) const INERTIA: i8 = 2;
}

/// The numbers that a key takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Range {
    /// Every number.
    Any,
    /// Above 0.
    Positive,
    /// 0 or more.
    NotNegative,
    /// An angle above 0 and at most 180 degrees.
    HalfTurn,
    /// An angle above 0 and below this number of degrees.
    Below(u8),
}

/// A list of `count` numbers.
#[derive(Debug)]
pub(crate) struct Numbers {
    pub(super) count: usize,
    pub(super) range: Range,
    /// The violation for a list of another length.
    pub(super) code: Code,
    /// All of them, for messages.
    pub(super) noun: &'static str,
    /// One of them, and the rule for it.
    pub(super) one: [&'static str; 2],
    /// The name of its definition in the schema; empty without one.
    pub(super) definition: &'static str,
}

impl Numbers {
    pub(super) const fn coordinates(count: usize, noun: &'static str) -> Self {
        Self { count, range: Range::Any, code: Code::CoordinateCount, noun, one: [""; 2], definition: "" }
    }
}

pub(super) static VECTOR: Numbers =
    Numbers { definition: "vector", ..Numbers::coordinates(3, "coordinates x, y, z") };
pub(super) static EDGES: Numbers = Numbers {
    range: Range::Positive,
    one: ["an edge length of", "give positive edge lengths"],
    definition: "edges",
    ..Numbers::coordinates(3, "edge lengths")
};
pub(super) static HALF_WIDTHS: Numbers = Numbers {
    range: Range::NotNegative,
    one: ["a half width of", "half widths are not negative"],
    definition: "half_widths",
    ..Numbers::coordinates(3, "half widths")
};

/// The type of a value.
#[derive(Clone, Copy)]
pub(crate) enum KeyForm {
    /// A number.
    Number(Range),
    /// A whole number between bounds.
    Whole(u32, u32),
    /// A list of numbers of fixed length.
    Numbers(&'static Numbers),
    /// A number or an expression in quotes, or a list of them.
    Quantity(Option<usize>),
    /// A text that is not blank.
    Text,
    /// One of these words.
    Word(fn() -> Vec<&'static str>),
    /// A table.
    Table(&'static dyn KeyShape),
    /// A list of values of fixed length; 0: of any length.
    List(&'static KeyKind, usize),
    /// One of these.
    Either(&'static [KeyKind]),
    /// A value with its own schema, as JSON: all numbers in it have the unit.
    Own(&'static str),
}

/// The kind of the value of a key.
#[derive(Clone, Copy)]
pub(crate) struct KeyKind {
    pub(in crate::design) form: KeyForm,
    pub(in crate::design) unit: i8,
    /// Whether messages name the table with the key.
    pub(super) is_placed: bool,
}

impl KeyKind {
    pub(super) const fn new(form: KeyForm, unit: i8) -> Self {
        Self { form, unit, is_placed: false }
    }

    pub(super) const fn placed(self) -> Self {
        Self { is_placed: true, ..self }
    }
}

pub(super) const TEXT: KeyKind = KeyKind::new(KeyForm::Text, unit::NONE);

pub(super) const fn any(unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Number(Range::Any), unit)
}

pub(super) const fn positive(unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Number(Range::Positive), unit)
}

pub(super) const fn not_negative(unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Number(Range::NotNegative), unit)
}

pub(super) const fn angle(range: Range) -> KeyKind {
    KeyKind::new(KeyForm::Number(range), unit::DEGREES)
}

pub(super) const fn whole(least: u32, most: u32) -> KeyKind {
    KeyKind::new(KeyForm::Whole(least, most), unit::NONE)
}

pub(super) const fn numbers(numbers: &'static Numbers, unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Numbers(numbers), unit)
}

pub(super) const fn vector(unit: i8) -> KeyKind {
    numbers(&VECTOR, unit)
}

pub(super) const fn quantity(unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Quantity(None), unit)
}

pub(super) const fn quantities(count: usize, unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Quantity(Some(count)), unit)
}

pub(super) const fn word(words: fn() -> Vec<&'static str>) -> KeyKind {
    KeyKind::new(KeyForm::Word(words), unit::NONE)
}

pub(super) const fn own(schema: &'static str, unit: i8) -> KeyKind {
    KeyKind::new(KeyForm::Own(schema), unit)
}

pub(super) const fn table(shape: &'static dyn KeyShape) -> KeyKind {
    KeyKind::new(KeyForm::Table(shape), unit::NONE)
}

pub(super) const fn list(item: &'static KeyKind) -> KeyKind {
    list_of(0, item)
}

pub(super) const fn list_of(count: usize, item: &'static KeyKind) -> KeyKind {
    KeyKind::new(KeyForm::List(item, count), unit::NONE)
}

pub(super) const fn either(kinds: &'static [KeyKind]) -> KeyKind {
    KeyKind::new(KeyForm::Either(kinds), unit::NONE)
}

/// The keys of a table, independent of the type they are read into.
pub(crate) trait KeyShape: Sync {
    /// The kind of a key.
    fn kind(&self, key: &str) -> Option<KeyKind>;
    /// The name of the key that had this name in the last release.
    fn renamed(&self, old: &str) -> Option<&'static str>;
    /// The schema of the table; named definitions go to `definitions`.
    fn schema(&self, definitions: &mut Map<String, Json>) -> Json;
}

/// The definition of this name, added if it is new.
fn defined(definitions: &mut Map<String, Json>, name: &str, made: Json) -> Json {
    if name.is_empty() {
        return made;
    }
    definitions.insert(name.to_owned(), made);
    json!({"$ref": format!("#/$defs/{name}")})
}

fn array(count: usize, item: &Json) -> Json {
    json!({"type": "array", "minItems": count, "maxItems": count, "items": item})
}

impl Range {
    fn schema(self) -> Json {
        match self {
            Self::Any => json!({"$ref": "#/$defs/number"}),
            Self::Positive => json!({"$ref": "#/$defs/positive"}),
            Self::NotNegative => json!({"$ref": "#/$defs/not_negative"}),
            Self::HalfTurn => json!({"type": "number", "exclusiveMinimum": 0, "maximum": 180}),
            Self::Below(most) => json!({"type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": most}),
        }
    }
}

impl KeyKind {
    /// The schema of a value.
    pub(super) fn schema(&self, definitions: &mut Map<String, Json>) -> Json {
        match self.form {
            KeyForm::Number(range) => range.schema(),
            KeyForm::Whole(least, most) => json!({"type": "integer", "minimum": least, "maximum": most}),
            KeyForm::Numbers(n) => defined(definitions, n.definition, array(n.count, &n.range.schema())),
            KeyForm::Quantity(None) => json!({"$ref": "#/$defs/quantity"}),
            KeyForm::Quantity(Some(count)) => array(count, &json!({"$ref": "#/$defs/quantity"})),
            KeyForm::Text => json!({"type": "string", "pattern": "\\S"}),
            KeyForm::Word(words) => json!({"enum": words()}),
            KeyForm::Table(shape) => shape.schema(definitions),
            KeyForm::List(item, 0) => json!({"type": "array", "items": item.schema(definitions)}),
            KeyForm::List(item, count) => array(count, &item.schema(definitions)),
            KeyForm::Either(kinds) => {
                json!({"oneOf": kinds.iter().map(|kind| kind.schema(definitions)).collect::<Vec<_>>()})
            }
            KeyForm::Own(schema) => parsed(schema),
        }
    }
}

/// JSON of the sources.
pub(super) fn parsed(text: &str) -> Json {
    serde_json::from_str(text).unwrap_or_default()
}

impl<M> KeyShape for KeyTable<M> {
    fn kind(&self, key: &str) -> Option<KeyKind> {
        let found = self.keys.iter().find(|k| k.name == key).map(|k| k.kind);
        found.or(self.named.copied())
    }

    fn renamed(&self, old: &str) -> Option<&'static str> {
        self.keys.iter().find(|k| !k.old.is_empty() && k.old == old).map(|k| k.name)
    }

    fn schema(&self, definitions: &mut Map<String, Json>) -> Json {
        let (mut properties, mut required, mut needs) = (Map::new(), Vec::new(), Map::new());
        for key in self.keys {
            let mut value = key.kind.schema(definitions);
            for (name, said) in [("description", json!(key.says)), ("default", parsed(key.default))] {
                if !(said.is_null() || said == "") {
                    value[name] = said;
                }
            }
            properties.insert(key.name.to_owned(), value);
            required.extend(Some(key.name).filter(|_| !key.required.is_empty()));
            if !key.needs.is_empty() {
                needs.insert(key.name.to_owned(), json!(key.needs));
            }
        }
        let others = self.named.map_or(json!(false), |kind| kind.schema(definitions));
        let mut out = json!({"type": "object"});
        if !properties.is_empty() {
            out["properties"] = Json::Object(properties);
        }
        out["additionalProperties"] = others;
        if !required.is_empty() {
            out["required"] = json!(required);
        }
        if !needs.is_empty() {
            out["dependentRequired"] = json!(needs);
        }
        if let (Some(out), Json::Object(rules)) = (out.as_object_mut(), parsed(self.rules)) {
            out.extend(rules);
        }
        defined(definitions, self.definition, out)
    }
}

/// Several key tables combined in one table of the file, with names as further keys.
pub(super) struct CombinedTable {
    pub(super) definition: &'static str,
    pub(super) shapes: &'static [&'static dyn KeyShape],
    pub(super) named: Option<&'static KeyKind>,
}

impl KeyShape for CombinedTable {
    fn kind(&self, key: &str) -> Option<KeyKind> {
        self.shapes.iter().find_map(|shape| shape.kind(key)).or(self.named.copied())
    }

    fn renamed(&self, old: &str) -> Option<&'static str> {
        self.shapes.iter().find_map(|shape| shape.renamed(old))
    }

    fn schema(&self, definitions: &mut Map<String, Json>) -> Json {
        let mut out = Map::new();
        for shape in self.shapes {
            let Json::Object(rules) = shape.schema(definitions) else { continue };
            for (name, rule) in rules {
                match (out.get_mut(&name).and_then(Json::as_object_mut), rule) {
                    (Some(keys), Json::Object(more)) => keys.extend(more),
                    (_, rule) => {
                        out.insert(name, rule);
                    }
                }
            }
        }
        if let Some(kind) = self.named {
            out.insert("additionalProperties".to_owned(), kind.schema(definitions));
        }
        defined(definitions, self.definition, Json::Object(out))
    }
}
