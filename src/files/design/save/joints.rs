//! Joints and cranks as they were written: coordinates, constructions, expressions.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use super::as_map;
use crate::design::construction::{CrankCopy, Spelling, WrittenCrank, WrittenCranks};
use crate::design::{Construction, LinePlace, WrittenNumber};
use machine::rotary::Elbow;

/// `[cranks]`: what is said of all cranks, and of single ones by name.
#[derive(Serialize)]
pub(super) struct CranksFile<'a> {
    #[serde(flatten)]
    shared: CrankFile<'a>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_torque: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    max_speed_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    least_transmission_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_swing_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform_swing_deg: Option<f64>,
    #[serde(flatten, serialize_with = "as_map")]
    own: Vec<(&'a str, CrankFile<'a>)>,
}

/// A crank, as it is written.
#[derive(Serialize)]
pub(super) struct CrankFile<'a> {
    #[serde(skip_serializing_if = "Option::is_none")]
    length: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_length: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    axis: Option<&'a [WrittenNumber; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    zero: Option<&'a [WrittenNumber; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    elbow: Option<&'static str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    angle_deg: Option<&'a [WrittenNumber; 2]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    turn: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    deg: Option<&'a WrittenNumber>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mirror: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    plane: Option<&'static str>,
}

impl<'a> CrankFile<'a> {
    pub(super) fn of(crank: &'a WrittenCrank, names: &'a [String]) -> Self {
        let (mut turn, mut deg, mut mirror, mut plane) = (None, None, None, None);
        match &crank.copy {
            Some(CrankCopy::Turned { crank, deg: by }) => {
                (turn, deg) = (Some(names[*crank].as_str()), Some(by));
            }
            Some(CrankCopy::Mirrored { crank, plane: p }) => {
                (mirror, plane) = (Some(names[*crank].as_str()), Some(p.name()));
            }
            None => {}
        }
        Self {
            length: crank.length.as_ref(),
            rod_length: crank.rod_length.as_ref(),
            axis: crank.axis.as_ref(),
            zero: crank.zero.as_ref(),
            elbow: crank.elbow.map(Elbow::name),
            angle_deg: crank.angle_deg.as_ref(),
            turn,
            deg,
            mirror,
            plane,
        }
    }
}

impl<'a> CranksFile<'a> {
    pub(super) fn of(cranks: &'a WrittenCranks, names: &'a [String]) -> Self {
        let own = names.iter().zip(&cranks.own);
        let own = own.filter_map(|(name, own)| Some((name.as_str(), CrankFile::of(own.as_ref()?, names))));
        Self {
            shared: CrankFile::of(&cranks.shared, names),
            max_torque: cranks.drives.max_torque,
            max_speed_deg: cranks.drives.max_speed_deg,
            least_transmission_deg: cranks.drives.least_transmission_deg,
            tip_swing_deg: cranks.drives.tip_swing_deg,
            platform_swing_deg: cranks.drives.platform_swing_deg,
            own: own.collect(),
        }
    }
}

/// A joint, as it is written.
pub(super) enum JointFile<'a> {
    Numbers([f64; 3]),
    Coordinates(&'a [WrittenNumber; 3]),
    /// A table of keys.
    Form(Vec<(&'static str, FormValue<'a>)>),
}

/// A value in the table of a joint.
pub(super) enum FormValue<'a> {
    WrittenNumber(&'a WrittenNumber),
    Text(&'a str),
    Pair([&'a str; 2]),
}

impl<'a> JointFile<'a> {
    pub(super) fn of(made: &'a Construction, names: &'a [String]) -> Self {
        let name = |j: usize| names[j].as_str();
        let form = match made {
            Construction::Coordinates(list) => return Self::Coordinates(list),
            Construction::OnLine { through, at } => {
                let (key, value) = match at {
                    LinePlace::Share(value) => ("t", value),
                    LinePlace::Offset(value) => ("offset", value),
                };
                vec![("on", FormValue::Pair(through.map(name))), (key, FormValue::WrittenNumber(value))]
            }
            Construction::Polar { radius, angle_deg, z } => {
                let mut form = vec![
                    ("radius", FormValue::WrittenNumber(radius)),
                    ("angle_deg", FormValue::WrittenNumber(angle_deg)),
                ];
                form.extend(z.as_ref().map(|z| ("z", FormValue::WrittenNumber(z))));
                form
            }
            Construction::Turned { joint, deg } => {
                vec![("turn", FormValue::Text(name(*joint))), ("deg", FormValue::WrittenNumber(deg))]
            }
            Construction::Mirrored { joint, plane } => {
                vec![("mirror", FormValue::Text(name(*joint))), ("plane", FormValue::Text(plane.name()))]
            }
        };
        Self::Form(form)
    }

    pub(super) fn to_toml(&self) -> String {
        match self {
            Self::Numbers(p) => format!("[{}]", p.map(toml_number).join(", ")),
            Self::Coordinates(list) => format!("[{}]", list.each_ref().map(toml_quantity).join(", ")),
            Self::Form(fields) => {
                let field = |(key, value): &(&str, FormValue<'_>)| {
                    let value = match value {
                        FormValue::WrittenNumber(q) => toml_quantity(q),
                        FormValue::Text(text) => toml_text(text),
                        FormValue::Pair(pair) => format!("[{}]", pair.map(toml_text).join(", ")),
                    };
                    format!("{key} = {value}")
                };
                format!("{{ {} }}", fields.iter().map(field).collect::<Vec<_>>().join(", "))
            }
        }
    }
}

impl Serialize for JointFile<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Numbers(p) => p.serialize(serializer),
            Self::Coordinates(list) => list.serialize(serializer),
            Self::Form(fields) => {
                let mut map = serializer.serialize_map(Some(fields.len()))?;
                for (key, value) in fields {
                    match value {
                        FormValue::WrittenNumber(q) => map.serialize_entry(key, q)?,
                        FormValue::Text(text) => map.serialize_entry(key, text)?,
                        FormValue::Pair(pair) => map.serialize_entry(key, pair)?,
                    }
                }
                map.end()
            }
        }
    }
}

impl Serialize for WrittenNumber {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.written() {
            Spelling::Number(x) => serializer.serialize_f64(*x),
            Spelling::Text(text) => serializer.serialize_str(text),
        }
    }
}

pub(super) fn toml_number(x: f64) -> String {
    toml::Value::Float(x).to_string()
}

/// In quotes, on one line.
pub(super) fn toml_text(text: &str) -> String {
    // what JSON writes is a basic string of TOML, but for one character
    serde_json::to_string(text).unwrap_or_default().replace('\u{7f}', "\\u007f")
}

pub(super) fn toml_quantity(q: &WrittenNumber) -> String {
    match q.written() {
        Spelling::Number(x) => toml_number(*x),
        Spelling::Text(text) => toml_text(text),
    }
}

/// `key = value`, the key in quotes where it has to be.
pub(super) fn toml_line(key: &str, value: &str) -> String {
    let pair = toml::to_string(&std::collections::BTreeMap::from([(key, 0)])).unwrap_or_default();
    format!("{}= {value}\n", pair.trim_end().trim_end_matches('0').trim_end_matches("= "))
}
