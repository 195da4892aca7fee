//! A design in another unit of length: every length of it multiplied by the same fraction.

use serde_json::{Map, Value as Json, json};
use thiserror::Error;

use super::construction::expression::UnitsBehind;
use super::keys::{FILE, KeyForm, KeyKind, KeyShape};
use super::{DesignModel, Format, WrittenNumber, parse_with_cranks};

/// Units by label with their lengths in micrometres, which are whole numbers; the inch is 25.4 mm exactly.
pub(super) const UNITS: [(&str, u64); 6] =
    [("um", 1), ("mm", 1000), ("cm", 10_000), ("m", 1_000_000), ("in", 25_400), ("ft", 304_800)];

/// Micrometres per unit of a label.
pub fn micrometres(label: &str) -> Option<u64> {
    UNITS.iter().find(|(known, _)| *known == label.trim()).map(|(_, length)| *length)
}

/// The label of the unit with this length in millimetres, and its exact length.
pub fn unit_of_millimetres(length: f64) -> Option<(&'static str, f64)> {
    let known = UNITS.into_iter().map(|(label, micrometres)| (label, micrometres as f64 / 1000.0));
    known.into_iter().find(|(_, known)| (length - known).abs() <= 1e-9 * known)
}

/// Reasons why a design cannot change to another unit.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NotScaled {
    /// A label that names no known length unit.
    #[error("`{0}` is not a known unit of length; the known units are {known}", known = UNITS.map(|(label, _)| label).join(", "))]
    Unit(String),
    /// The poses of its trajectory are in a separate file.
    #[error("the trajectory {0} is a file of its own, which would keep the old unit")]
    Trajectory(String),
    /// A construction that is too long with the factor.
    #[error("a construction cannot be scaled: {0}")]
    Construction(String),
    /// The scaled numbers form no design: they are too large or too small for doubles.
    #[error("{0}")]
    Design(String),
}

/// The factor of lengths as a fraction in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct LengthRatio {
    times: u64,
    over: u64,
}

impl LengthRatio {
    fn between(from: u64, to: u64) -> Self {
        let (mut a, mut b) = (from, to);
        while b > 0 {
            (a, b) = (b, a % b);
        }
        Self { times: from / a, over: to / a }
    }

    /// From a unit to another one, by their labels; `None` if one is unknown.
    pub(super) fn of_labels(from: &str, to: &str) -> Option<Self> {
        Some(Self::between(micrometres(from)?, micrometres(to)?))
    }

    fn inverse(self) -> Self {
        Self { times: self.over, over: self.times }
    }

    /// With one rounding where one of the two numbers is 1.
    pub(super) fn of(self, x: f64) -> f64 {
        x * self.times as f64 / self.over as f64
    }

    /// A number whose unit has this power of the unit of length.
    fn of_power(self, x: f64, power: i8) -> f64 {
        let ratio = if power < 0 { self.inverse() } else { self };
        (0..power.unsigned_abs()).fold(x, |x, _| ratio.of(x))
    }

    /// All numbers of a value.
    fn numbers(self, value: &mut Json, power: i8) {
        match value {
            Json::Number(x) if power != 0 => {
                *value = json!(x.as_f64().map(|x| self.of_power(x, power)));
            }
            Json::Array(list) => list.iter_mut().for_each(|item| self.numbers(item, power)),
            _ => {}
        }
    }

    /// The number with the fraction as a factor, so that exact values stay exact.
    fn written(self, number: &Json) -> Result<Json, NotScaled> {
        let text = match number {
            Json::String(text) => text.clone(),
            number => format!("{:?}", number.as_f64().unwrap_or_default()),
        };
        // a length with its own unit is the same in every design
        if WrittenNumber::with_units(&text, UnitsBehind::Length(Some(1))).is_ok_and(|read| read.1) {
            return Ok(number.clone());
        }
        let is_zero = text.parse::<f64>().is_ok_and(|x| x == 0.0);
        if is_zero {
            return Ok(number.clone());
        }
        let simple = text.chars().all(|c| c.is_alphanumeric() || c == '.' || c == '_');
        let mut scaled = if simple { text } else { format!("({text})") };
        for (sign, factor) in [('*', self.times), ('/', self.over)] {
            if factor != 1 {
                scaled.push(sign);
                scaled.push_str(&factor.to_string());
            }
        }
        WrittenNumber::text(&scaled).map_err(|slip| NotScaled::Construction(slip.message))?;
        Ok(Json::String(scaled))
    }

    /// A value of a kind.
    fn scale(self, value: &mut Json, kind: &KeyKind) -> Result<(), NotScaled> {
        match (kind.form, value) {
            (KeyForm::Quantity(_), _) if kind.unit == 0 => {}
            (KeyForm::Quantity(None), value) => *value = self.written(value)?,
            // three plain numbers are doubles
            (KeyForm::Quantity(Some(_)), Json::Array(list)) if list.iter().any(Json::is_string) => {
                for item in list {
                    *item = self.written(item)?;
                }
            }
            (KeyForm::Table(shape), Json::Object(keys)) => self.table(keys, shape)?,
            (KeyForm::List(kind, _), Json::Array(list)) => {
                list.iter_mut().try_for_each(|item| self.scale(item, kind))?;
            }
            (KeyForm::Either(kinds), value) => {
                if let Some(kind) = kinds.iter().find(|kind| fits(value, kind)) {
                    self.scale(value, kind)?;
                }
            }
            (_, value) => self.numbers(value, kind.unit),
        }
        Ok(())
    }

    fn table(self, keys: &mut Map<String, Json>, shape: &dyn KeyShape) -> Result<(), NotScaled> {
        for (key, value) in keys {
            if let Some(kind) = shape.kind(key) {
                self.scale(value, &kind)?;
            }
        }
        Ok(())
    }
}

/// Whether a value may be of a kind.
fn fits(value: &Json, kind: &KeyKind) -> bool {
    match (kind.form, value) {
        (KeyForm::Table(shape), Json::Object(keys)) => keys.keys().all(|key| shape.kind(key).is_some()),
        (KeyForm::Table(_), _) | (_, Json::Object(_)) => false,
        (KeyForm::List(..) | KeyForm::Quantity(Some(_)), value) => value.is_array(),
        _ => true,
    }
}

impl DesignModel {
    /// The same design with its lengths in another unit. Parameters stay, since they may be angles; the constructions
    /// that use them are scaled.
    ///
    /// # Errors
    /// [`NotScaled`].
    pub fn in_units(&self, units: &str) -> Result<Self, NotScaled> {
        let known = |label: &str| micrometres(label).ok_or_else(|| NotScaled::Unit(label.to_string()));
        let ratio = LengthRatio::between(known(&self.units)?, known(units)?);
        if let Some(trajectory) = &self.workspace.trajectory {
            return Err(NotScaled::Trajectory(trajectory.file.clone()));
        }
        let mut keys = self.document();
        ratio.table(&mut keys, FILE)?;
        keys.insert("units".to_owned(), json!(units.trim()));
        let text = Json::Object(keys).to_string();
        let (mut out, _) = parse_with_cranks(&text, Format::Json)
            .map_err(|list| NotScaled::Design(list.first().map_or_else(String::new, ToString::to_string)))?;
        // these two tables have no lengths, and a name in both bodies may mean one joint only
        (out.written, out.search) = (self.written.clone(), self.search.clone());
        Ok(out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::parse;
    use machine::requirements::{KeepOutShape, LengthLimits};
    use nalgebra::Point3;
    use platform::manipulator::Body;

    const TEXT: &str = include_str!("../../../designs/symmetric-hexapod.toml");

    fn design(text: &str) -> DesignModel {
        parse(text, Format::Toml).unwrap_or_else(|v| panic!("{v:?}\n{text}")).0
    }

    #[test]
    fn every_length_is_in_the_new_unit_and_constructions_stay_exact() {
        let mm = design(TEXT);
        let inches = mm.in_units("in").unwrap();
        assert_eq!((inches.units.as_str(), inches.exactness()), ("in", mm.exactness()));
        for (a, b) in mm.manipulator().legs().iter().zip(inches.manipulator().legs()) {
            assert!((a.base.coords - b.base.coords * 25.4).norm() < 1e-12 * mm.manipulator().size());
            assert!((a.platform.coords - b.platform.coords * 25.4).norm() < 1e-12 * mm.manipulator().size());
        }
        let near = |a: f64, b: f64| (a - 25.4 * b).abs() < 1e-12 * a.abs();
        assert!(near(mm.home.unwrap().position.z, inches.home.unwrap().position.z));
        assert!(near(mm.lengths.unwrap().get()[3], inches.lengths.unwrap().get()[3]));
        assert!(near(mm.workspace.translation[0].max, inches.workspace.translation[0].max));
        assert!(near(mm.hardware.joint_diameter.unwrap(), inches.hardware.joint_diameter.unwrap()));
        // the file states the same design, which converts back to equal bits
        let back = design(&inches.to_toml()).in_units("mm").unwrap();
        assert_eq!(back.exact_joints(Body::Base), mm.exact_joints(Body::Base));
    }

    #[test]
    fn joints_with_their_own_unit_are_the_same_in_every_design() {
        let text = |units: &str| {
            format!(
                "name = \"own\"\nunits = \"{units}\"\nlegs = [[\"A\", \"a\"], [\"B\", \"a\"], [\"B\", \"b\"], [\"C\", \"b\"], [\"C\", \"c\"], [\"D\", \"c\"]]\n[parameters]\nr = 3\n[base]\nA = [\"-6 in\", 0, 0]\nB = {{ radius = \"r ft\", angle_deg = 30 }}\nC = [\"1 ft\", \"-2 ft\", 0]\nD = {{ on = [\"A\", \"B\"], offset = \"12/5 in\" }}\n[platform]\na = [0, 0, 0]\nb = [1, 0, 0]\nc = [0, 1, \"5 ft + 3 in\"]\n"
            )
        };
        let inches = design(&text("in"));
        assert_eq!(inches.manipulator().base_joints()[0].x.to_bits(), (-6.0_f64).to_bits());
        assert_eq!(inches.manipulator().platform_joints()[2].z.to_bits(), 63.0_f64.to_bits());
        let mm = inches.in_units("mm").unwrap();
        assert_eq!(mm.manipulator().base_joints()[0].x.to_bits(), (-152.4_f64).to_bits());
        assert_eq!(mm.exact_joints(Body::Base), design(&text("mm")).exact_joints(Body::Base));
        assert!(mm.to_toml().contains("-6 in") && mm.to_toml().contains("r ft"));
        let refused = |text: &str| parse(text, Format::Toml).unwrap_err()[0].message.clone();
        assert!(refused(&text("1")).contains("the unit of the design is no known length"));
        let angle = text("mm").replace("angle_deg = 30", "angle_deg = \"30 mm\"");
        assert!(refused(&angle).contains("this number is no length"));
    }

    #[test]
    fn requirements_keep_their_meaning() {
        let text = format!(
            "{TEXT}leg_length = [300, 500]\nleg_stiffness = 50\nmax_leg_speed = 20\nrod_mass = 3\nrod_center = 200\nrod_inertia = 5e4\n[speed]\nlinear = 100\nangular_deg = 5\n[[loads]]\nname = \"weight\"\nforce = [0, 0, -10]\ntorque = [0, 0, 300]\nat = [0, 0, 50]\n[[keep_out]]\nname = \"ball\"\nsphere = {{ center = [0, 0, 100], diameter = 40 }}\n"
        );
        let m = design(&text).in_units("m").unwrap();
        assert_eq!(m.hardware.leg_length, Some(LengthLimits::Range(0.3, 0.5)));
        assert_eq!((m.hardware.leg_stiffness, m.hardware.max_leg_speed), (Some(50_000.0), Some(0.02)));
        let rod = m.hardware.leg_masses.unwrap().rod;
        assert_eq!((rod.mass, rod.center, rod.inertia), (3.0, 0.2, 0.05));
        assert_eq!((m.loads[0].force.z, m.loads[0].torque.z, m.loads[0].at.z), (-10.0, 0.3, 0.05));
        assert_eq!(m.speed.map(|s| (s.linear, s.angular_deg)), Some((0.1, 5.0)));
        let sphere = KeepOutShape::Sphere { center: Point3::new(0.0, 0.0, 0.1), diameter: 0.04 };
        assert_eq!(m.keep_outs[0].shape, sphere);
        assert_eq!(design(&text).in_units("parsec"), Err(NotScaled::Unit("parsec".into())));
    }
}
