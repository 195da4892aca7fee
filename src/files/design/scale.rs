//! A design in another unit of length: every length of it multiplied by the same fraction.

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use super::model::NotBuilt;
use super::{Construction, DesignModel, LinePlace, WrittenNumber};
use machine::requirements::{Envelope, Housing, KeepOutShape, LegBody, LengthLimits, Quantity, Reserve};
use platform::manipulator::{Body, InvalidLengths, InvalidManipulator, LegLengths, Manipulator};

/// Units by label with their lengths in micrometres, which are whole numbers; the inch is 25.4 mm exactly.
const UNITS: [(&str, u64); 6] =
    [("um", 1), ("mm", 1000), ("cm", 10_000), ("m", 1_000_000), ("in", 25_400), ("ft", 304_800)];

/// Micrometres of the unit of a label.
pub fn micrometres(label: &str) -> Option<u64> {
    UNITS.iter().find(|(known, _)| *known == label.trim()).map(|(_, length)| *length)
}

/// The label of the unit of so many millimetres, and its exact length in them.
pub fn unit_of_millimetres(length: f64) -> Option<(&'static str, f64)> {
    let known = UNITS.into_iter().map(|(label, micrometres)| (label, micrometres as f64 / 1000.0));
    known.into_iter().find(|(_, known)| (length - known).abs() <= 1e-9 * known)
}

/// Why a design has no form in another unit.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NotScaled {
    /// A label that names no known length unit.
    #[error("`{0}` is not a known unit of length; the known units are {known}", known = UNITS.map(|(label, _)| label).join(", "))]
    Unit(String),
    /// The poses of its trajectory stand in a file of their own.
    #[error("the trajectory {0} is a file of its own, which would keep the old unit")]
    Trajectory(String),
    /// The scaled joints are too large or too small for doubles.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
    /// So are the lengths.
    #[error(transparent)]
    Lengths(#[from] InvalidLengths),
    /// A construction that is too long with the factor.
    #[error("a construction cannot be scaled: {0}")]
    Construction(String),
}

impl From<NotBuilt> for NotScaled {
    fn from(why: NotBuilt) -> Self {
        Self::Construction(why.to_string())
    }
}

/// The fraction by which lengths are multiplied, in lowest terms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct LengthRatio {
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

    fn inverse(self) -> Self {
        Self { times: self.over, over: self.times }
    }

    /// With one rounding where one of the two numbers is 1.
    fn of(self, x: f64) -> f64 {
        x * self.times as f64 / self.over as f64
    }

    fn vector(self, v: Vector3<f64>) -> Vector3<f64> {
        v.map(|x| self.of(x))
    }

    fn point(self, p: Point3<f64>) -> Point3<f64> {
        p.map(|x| self.of(x))
    }

    /// The same number with the fraction written behind it: what was exact stays exact.
    fn written(self, number: &WrittenNumber) -> Result<WrittenNumber, NotScaled> {
        let text = number.spelled();
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
        WrittenNumber::text(&scaled).map_err(|slip| NotScaled::Construction(slip.message))
    }
}

impl DesignModel {
    /// The same design with its lengths in another unit. Parameters stay, since they may be angles; the constructions that use them get the factor.
    ///
    /// # Errors
    /// [`NotScaled`].
    pub fn in_units(&self, units: &str) -> Result<Self, NotScaled> {
        let known = |label: &str| micrometres(label).ok_or_else(|| NotScaled::Unit(label.to_string()));
        let ratio = LengthRatio::between(known(&self.units)?, known(units)?);
        if let Some(trajectory) = &self.workspace.trajectory {
            return Err(NotScaled::Trajectory(trajectory.file.clone()));
        }
        let m = self.manipulator();
        let joints = |body: Body| m.joints(body).iter().map(|p| ratio.point(*p)).collect();
        let scaled = Manipulator::try_new(joints(Body::Base), joints(Body::Platform), m.pairs())?;
        let mut constructions = self.current_constructions();
        for made in constructions.joints.iter_mut().flatten().flatten() {
            scale_construction(made, ratio)?;
        }
        for coordinate in constructions.home.iter_mut().flat_map(|home| &mut home.position) {
            *coordinate = ratio.written(coordinate)?;
        }
        if let Some(cranks) = &mut constructions.cranks {
            for crank in std::iter::once(&mut cranks.shared).chain(cranks.own.iter_mut().flatten()) {
                for length in crank.length.iter_mut().chain(&mut crank.rod_length) {
                    *length = ratio.written(length)?;
                }
            }
            cranks.drives.max_torque = cranks.drives.max_torque.map(|t| ratio.of(t));
        }
        let home_is_written = constructions.home.is_some();
        let mut out = self.clone();
        out.units = units.trim().to_string();
        out.manipulator = scaled;
        out = out.with_constructions(constructions)?;
        if let Some(lengths) = self.lengths {
            out.lengths = Some(LegLengths::try_new(lengths.get().map(|l| ratio.of(l)))?);
        }
        let home = out.home.iter_mut().filter(|_| !home_is_written);
        for pose in home.chain(&mut out.workspace.poses) {
            pose.position = ratio.vector(pose.position);
        }
        out.workspace.translation = ratio.vector(out.workspace.translation);
        if let Some(table) = &mut out.calibration {
            for x in table.offsets.iter_mut().chain(table.offset_deviations.iter_mut().flatten()) {
                *x = ratio.of(*x);
            }
            let joints = table.base_deviations.iter_mut().chain(&mut table.platform_deviations);
            for deviation in joints.flatten() {
                *deviation = ratio.vector(*deviation);
            }
        }
        out.scale_requirements(ratio);
        Ok(out)
    }

    fn scale_requirements(&mut self, ratio: LengthRatio) {
        let length = |x: &mut Option<f64>| *x = x.map(|x| ratio.of(x));
        let housing = |x: &mut Option<Housing>| {
            *x = x.map(|h| match h {
                Housing::Sphere(d) => Housing::Sphere(ratio.of(d)),
                Housing::Box(edges) => Housing::Box(ratio.vector(edges)),
            });
        };
        length(&mut self.optimize.min_joint_distance);
        length(&mut self.optimize.characteristic_length);
        let hardware = &mut self.hardware;
        housing(&mut hardware.base_housing);
        housing(&mut hardware.platform_housing);
        hardware.base_joint_housing.iter_mut().for_each(housing);
        hardware.platform_joint_housing.iter_mut().for_each(housing);
        length(&mut hardware.joint_diameter);
        length(&mut hardware.leg_clearance);
        length(&mut hardware.max_leg_speed);
        length(&mut hardware.screw_lead);
        // torques are force units times the unit of length
        hardware.base_bending.iter_mut().for_each(length);
        hardware.platform_bending.iter_mut().for_each(length);
        for joint in [&mut hardware.base_universal, &mut hardware.platform_universal].into_iter().flatten() {
            joint.offset = ratio.of(joint.offset);
        }
        hardware.leg_stiffness = hardware.leg_stiffness.map(|k| ratio.inverse().of(k));
        if let Some(masses) = &mut hardware.leg_masses {
            for part in [&mut masses.cylinder, &mut masses.rod] {
                part.center = ratio.of(part.center);
                part.inertia = ratio.of(ratio.of(part.inertia));
            }
        }
        hardware.leg_body = hardware.leg_body.map(|body| LegBody {
            diameter: ratio.of(body.diameter),
            rod: body.rod.map(|(length, diameter)| (ratio.of(length), ratio.of(diameter))),
        });
        hardware.leg_length = hardware.leg_length.map(|limits| match limits {
            LengthLimits::Range(least, greatest) => LengthLimits::Range(ratio.of(least), ratio.of(greatest)),
            LengthLimits::Stroke { dead, stroke } => {
                LengthLimits::Stroke { dead: ratio.of(dead), stroke: ratio.of(stroke) }
            }
        });
        if let Some(speed) = &mut self.speed {
            speed.linear = ratio.of(speed.linear);
        }
        if let Some(wanted) = &mut self.stiffness {
            wanted.linear = wanted.linear.map(|k| ratio.inverse().of(k));
            wanted.angular = wanted.angular.map(|k| ratio.of(k));
        }
        for envelope in [&mut self.envelopes.base, &mut self.envelopes.platform, &mut self.envelopes.machine]
        {
            *envelope = envelope.map(|e| match e {
                Envelope::Cylinder { radius, center } => {
                    Envelope::Cylinder { radius: ratio.of(radius), center: center.map(|x| ratio.of(x)) }
                }
                Envelope::Box { min, max } => Envelope::Box { min: ratio.point(min), max: ratio.point(max) },
            });
        }
        for grid in self.holes.iter_mut().flatten().flatten() {
            (grid.pitch, grid.origin) = (ratio.of(grid.pitch), grid.origin.map(|x| ratio.of(x)));
            grid.circles = grid.circles.scaled(|x| ratio.of(x));
        }
        for plate in [&mut self.plates.base, &mut self.plates.platform].into_iter().flatten() {
            for x in [
                &mut plate.thickness,
                &mut plate.margin,
                &mut plate.hole,
                &mut plate.edge_distance,
                &mut plate.hole_distance,
            ] {
                *x = ratio.of(*x);
            }
            length(&mut plate.height);
            length(&mut plate.foot);
            if let Some(bolts) = &mut plate.bolts {
                (bolts.circle, bolts.hole) = (ratio.of(bolts.circle), ratio.of(bolts.hole));
            }
        }
        for (kind, reserve) in &mut self.reserves.kinds {
            let Reserve::Amount(x) = reserve else { continue };
            match kind.quantity() {
                Quantity::Length | Quantity::Speed | Quantity::AngularStiffness | Quantity::Torque => {
                    *x = ratio.of(*x);
                }
                Quantity::LinearStiffness => *x = ratio.inverse().of(*x),
                Quantity::Angle | Quantity::Force | Quantity::Frequency | Quantity::AngularSpeed => {}
            }
        }
        if let Some(payload) = &mut self.payload {
            payload.center = ratio.point(payload.center);
            payload.inertia = payload.inertia.map(|m| m.map(|x| ratio.of(ratio.of(x))));
            payload.shape = payload.shape.map(|shape| scaled_shape(&shape, ratio));
        }
        for load in &mut self.loads {
            load.torque = ratio.vector(load.torque);
            load.at = ratio.point(load.at);
        }
        for keep_out in &mut self.keep_outs {
            keep_out.shape = scaled_shape(&keep_out.shape, ratio);
        }
    }
}

fn scaled_shape(shape: &KeepOutShape, ratio: LengthRatio) -> KeepOutShape {
    match *shape {
        KeepOutShape::Box { center, size } => {
            KeepOutShape::Box { center: ratio.point(center), size: ratio.vector(size) }
        }
        KeepOutShape::Sphere { center, diameter } => {
            KeepOutShape::Sphere { center: ratio.point(center), diameter: ratio.of(diameter) }
        }
        KeepOutShape::Capsule { from, to, diameter } => KeepOutShape::Capsule {
            from: ratio.point(from),
            to: ratio.point(to),
            diameter: ratio.of(diameter),
        },
    }
}

fn scale_construction(made: &mut Construction, ratio: LengthRatio) -> Result<(), NotScaled> {
    match made {
        Construction::Coordinates(list) => {
            for x in list {
                *x = ratio.written(x)?;
            }
        }
        Construction::OnLine { at: LinePlace::Offset(x), .. } => *x = ratio.written(x)?,
        Construction::Polar { radius, z, .. } => {
            *radius = ratio.written(radius)?;
            if let Some(z) = z {
                *z = ratio.written(z)?;
            }
        }
        Construction::OnLine { .. } | Construction::Turned { .. } | Construction::Mirrored { .. } => {}
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};

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
        assert!(near(mm.workspace.translation.x, inches.workspace.translation.x));
        assert!(near(mm.hardware.joint_diameter.unwrap(), inches.hardware.joint_diameter.unwrap()));
        // the file says the same, and back again it is the same design
        let back = design(&inches.to_toml()).in_units("mm").unwrap();
        assert_eq!(back.exact_joints(Body::Base), mm.exact_joints(Body::Base));
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
