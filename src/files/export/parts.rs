//! The bill of materials: bought and made parts, with their numbers, lengths and masses.

use std::fmt::Write as _;

use super::plate::ClearanceHole;
use super::text::{commented, csv_field, real, rounded};
use super::{Export, ExportBody, Plate};
use machine::requirements::Housing;
use platform::manipulator::Body;

/// Legs whose lengths agree within this share of the size are of one kind. It is above the asymmetry after a search: a
/// hundredth of a micrometre in a metre.
pub(super) const SAME_LENGTH: f64 = 1e-8;
/// Kinds of joint by body.
const JOINTS: [&str; 2] = ["base joint", "platform joint"];

/// The kind of a joint, for the list of parts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointSort {
    /// The name of the model, or the names of several joints about one centre.
    pub(super) models: String,
    /// Greatest joint angle, degrees; `None` without a limit, or if joints about one centre differ.
    pub(super) cone_angle_deg: Option<f64>,
    /// Its housing, or the widest about one centre; `None` if the design gives none.
    pub(super) housing: Option<Housing>,
}

impl JointSort {
    /// Housing and joint angle in words, if the design gives them.
    pub(super) fn description(&self, mm: f64) -> String {
        let housing = self.housing.map(|housing| match housing {
            Housing::Sphere(diameter) => format!("housing: ball of {} mm", rounded(diameter * mm)),
            Housing::Box(edges) => {
                let edges: Vec<String> = edges.iter().map(|x| rounded(x * mm)).collect();
                format!("housing: box of {} mm", edges.join(" x "))
            }
        });
        let cone_angle = self.cone_angle_deg.map(|deg| format!("cone angle {} deg", real(deg)));
        [housing, cone_angle].into_iter().flatten().collect::<Vec<_>>().join("; ")
    }
}

/// A line of the bill of materials; millimetres and kilograms.
#[derive(Debug, Clone, PartialEq)]
pub struct PartLine {
    /// The kind of part.
    pub part: String,
    /// The number of these parts.
    pub count: usize,
    /// Mass of one, kilograms, if the design gives it.
    pub mass: Option<f64>,
    /// Length at home of a leg, or that of a cylinder or rod, millimetres.
    pub length: Option<f64>,
    /// Least and greatest length over the poses of the workspace, millimetres.
    pub lengths: Option<[f64; 2]>,
    /// Diameter, or thickness of a plate, millimetres.
    pub thickness: Option<f64>,
    /// Volume of one in cm^3, of plates.
    pub volume: Option<f64>,
    /// Its place and its required limits.
    pub remark: String,
}

impl PartLine {
    fn new(part: impl Into<String>, count: usize, remark: impl Into<String>) -> Self {
        let (part, remark) = (part.into(), remark.into());
        let (mass, length, lengths) = (None, None, None);
        Self { part, count, mass, length, lengths, thickness: None, volume: None, remark }
    }
}

/// The names of the columns of a bill of materials.
pub const PART_COLUMNS: [&str; 10] = [
    "part",
    "count",
    "mass_each_kg",
    "mass_kg",
    "home_length_mm",
    "least_length_mm",
    "greatest_length_mm",
    "diameter_or_thickness_mm",
    "volume_each_cm3",
    "remark",
];

impl PartLine {
    /// Its fields in the order of [`PART_COLUMNS`]; empty if unknown.
    #[must_use]
    pub fn fields(&self) -> [String; 10] {
        let number = |x: Option<f64>| x.map_or_else(String::new, rounded);
        [
            self.part.clone(),
            self.count.to_string(),
            number(self.mass),
            number(self.mass.map(|m| m * self.count as f64)),
            number(self.length),
            number(self.lengths.map(|l| l[0])),
            number(self.lengths.map(|l| l[1])),
            number(self.thickness),
            number(self.volume),
            self.remark.clone(),
        ]
    }
}

impl Export {
    /// The bill of materials: plates, joints, drives by kind, payload.
    ///
    /// Legs are of one kind if their lengths at home agree. The least and greatest lengths are those at the listed
    /// poses of the workspace, over all legs of the kind.
    #[must_use]
    pub fn parts(&self) -> Vec<PartLine> {
        let mm = self.unit.millimetres;
        let mut out: Vec<PartLine> =
            self.bodies.iter().map(|body| plate(body, mm, self.unit.metres)).collect();
        for body in &self.bodies {
            let k = body.body.index();
            let kinds = self.joint_kinds(body);
            for (kind, names) in &kinds {
                let name = if kinds.len() == 1 {
                    JOINTS[k].to_owned()
                } else {
                    format!("{}, {}", JOINTS[k], kind.models)
                };
                let cone_angle = kind
                    .cone_angle_deg
                    .map_or_else(String::new, |deg| format!("cone angle {} deg; ", real(deg)));
                let line = PartLine::new(name, names.len(), format!("{cone_angle}{}", names.join(" ")));
                // the body has one ball size, which fits into each of its housings
                let differ = kinds.iter().any(|(other, _)| other.housing != kind.housing);
                let own = kind.housing.filter(|_| differ).map(|h| h.least_width());
                out.push(PartLine { thickness: Some(own.unwrap_or(body.ball_diameter) * mm), ..line });
            }
            out.extend(bolts(body, mm));
        }
        self.legs_by_kind(&mut out);
        let leg = &self.moving.leg;
        let known = |mass: f64| Some(mass).filter(|m| *m > 0.0);
        let (thick, thin) = self.legs[0].diameters;
        out.push(PartLine {
            mass: known(leg.cylinder.mass),
            length: Some(self.legs[0].cylinder * mm),
            thickness: Some(thick * mm),
            ..PartLine::new("cylinder", 6, "one a leg")
        });
        for (length, count) in self.rods() {
            out.push(PartLine {
                mass: known(leg.rod.mass),
                length: length.map(|l| l * mm),
                thickness: Some(thin * mm),
                ..PartLine::new("rod", count, "one a leg")
            });
        }
        if self.payload {
            // the plate of the platform has a separate line and mass
            let plate = self.bodies[1].plate().ok().and_then(|plate| plate.mass(self.unit.metres));
            let what = if plate.is_some() { "payload" } else { "payload with platform" };
            let mass = (self.moving.mass - plate.unwrap_or(0.0)).max(0.0);
            out.push(PartLine { mass: Some(mass), ..PartLine::new(what, 1, "carried, not bought") });
        }
        out
    }

    /// Rods by length, with their numbers. The length is missing if cylinders leave no space for the rods at home, or
    /// for rods on cranks.
    fn rods(&self) -> Vec<(Option<f64>, usize)> {
        let mut out: Vec<(Option<f64>, usize)> = Vec::new();
        for kind in self.leg_kinds() {
            let length = self.telescope(&kind).ok().filter(|_| self.cranks.is_none()).map(|t| t.rod);
            let alike = |other: Option<f64>| match (other, length) {
                (Some(a), Some(b)) => (a - b).abs() <= SAME_LENGTH * self.size,
                (a, b) => a.is_none() && b.is_none(),
            };
            match out.iter_mut().find(|(other, _)| alike(*other)) {
                Some((_, count)) => *count += kind.legs.len(),
                None => out.push((length, kind.legs.len())),
            }
        }
        out
    }

    /// The joint of a leg at a body.
    fn joint_of(&self, body: Body, leg: usize) -> JointSort {
        let h = &self.hardware;
        let cone_angle = body.of((h.base_cone_angle, h.platform_cone_angle));
        JointSort {
            models: h.joint_kind(body, leg).name().to_owned(),
            cone_angle_deg: cone_angle.map(|s| s.limits_deg[leg]).filter(|deg| *deg < 180.0),
            housing: h.housing(body, leg),
        }
    }

    /// The joints of a leg at base and platform.
    pub(super) fn joint_sorts(&self, leg: usize) -> [JointSort; 2] {
        Body::BOTH.map(|body| self.joint_of(body, leg))
    }

    /// The joints of a body by kind, with their names; legs that share a joint may have different ones about one
    /// centre.
    pub(super) fn joint_kinds<'b>(&self, body: &'b ExportBody) -> Vec<(JointSort, Vec<&'b str>)> {
        let mut kinds: Vec<(JointSort, Vec<&'b str>)> = Vec::new();
        for (k, joint) in body.joints.iter().enumerate() {
            let ends = self.legs.iter().enumerate();
            let here = ends.filter(|(_, leg)| [leg.base, leg.platform][body.body.index()] == k);
            let mut sorts: Vec<JointSort> = Vec::new();
            for sort in here.map(|(i, _)| self.joint_of(body.body, i)) {
                if !sorts.contains(&sort) {
                    sorts.push(sort);
                }
            }
            let cone_angle_deg = sorts.first().and_then(|s| s.cone_angle_deg).filter(|_| sorts.len() == 1);
            let housing = sorts
                .iter()
                .filter_map(|s| s.housing)
                .max_by(|a, b| a.greatest_width().total_cmp(&b.greatest_width()));
            let models = sorts.into_iter().map(|s| s.models).collect::<Vec<_>>().join(" and ");
            let sort = JointSort { models, cone_angle_deg, housing };
            match kinds.iter_mut().find(|(known, _)| *known == sort) {
                Some((_, names)) => names.push(joint.name.as_str()),
                None => kinds.push((sort, vec![joint.name.as_str()])),
            }
        }
        kinds
    }

    fn legs_by_kind(&self, out: &mut Vec<PartLine>) {
        let mm = self.unit.millimetres;
        let mixed = (1..6).any(|leg| self.joint_sorts(leg) != self.joint_sorts(0));
        for kind in self.leg_kinds() {
            let mut remark = kind.numbers();
            if mixed {
                let [base, platform] = self.joint_sorts(kind.legs[0]);
                let _ = write!(remark, "; {} at the base, {} at the platform", base.models, platform.models);
            }
            if let Some((least, greatest)) = self.leg_range {
                let _ =
                    write!(remark, "; drive from {} to {} mm", rounded(least * mm), rounded(greatest * mm));
            }
            if let Some(force) = self.greatest_force {
                let _ = write!(remark, ", {} N", rounded(force));
            }
            out.push(PartLine {
                length: Some(kind.length * mm),
                lengths: Some(kind.lengths.map(|l| l * mm)),
                ..PartLine::new(kind.name("leg"), kind.legs.len(), remark)
            });
        }
    }

    /// The bill of materials as a table.
    pub(super) fn parts_csv(&self) -> String {
        let more = "parts; masses, lengths and diameters are empty if the design does not state them";
        let mut out = commented("#", self.heading("mm").into_iter().chain([more.to_string()]));
        let _ = writeln!(out, "{}", PART_COLUMNS.join(","));
        for part in self.parts() {
            let _ = writeln!(out, "{}", part.fields().map(|f| csv_field(&f)).join(","));
        }
        out
    }
}

/// Material and holes.
fn plate_remark(plate: &Plate, mm: f64) -> String {
    let mut out = plate.material.as_ref().map_or_else(String::new, |name| format!("{name}; "));
    let _ = write!(out, "{} holes of {} mm", plate.holes.len(), rounded(plate.hole_diameter * mm));
    if plate.bolt_count() > 0 {
        let _ = write!(out, ", {} of {} mm", plate.bolt_count(), rounded(plate.bolt_diameter * mm));
    }
    out
}

/// The bolts of the joints of a body.
fn bolts(body: &ExportBody, mm: f64) -> Option<PartLine> {
    let plate = body.plate().ok()?;
    let each = plate.holes.first().map_or(0, |h| h.bolts.len());
    let line = |count| {
        let name = format!("bolt of a {}", JOINTS[body.body.index()]);
        let thread = ClearanceHole::of(plate.bolt_diameter * mm);
        let of = thread.map_or_else(String::new, |thread| format!(" ({thread})"));
        let remark = format!("{each} a joint, through holes of {} mm{of}", rounded(plate.bolt_diameter * mm));
        PartLine { thickness: thread.map(|thread| thread.thread), ..PartLine::new(name, count, remark) }
    };
    (plate.bolt_count() > 0).then(|| line(plate.bolt_count()))
}

fn plate(body: &ExportBody, mm: f64, metres: f64) -> PartLine {
    let name = if body.body == Body::Base { "base plate" } else { "platform plate" };
    match body.plate() {
        Ok(plate) => PartLine {
            thickness: Some(plate.thickness * mm),
            volume: Some(plate.volume() * mm * mm * mm / 1e3),
            mass: plate.mass(metres),
            ..PartLine::new(name, 1, plate_remark(plate, mm))
        },
        Err(why) => PartLine::new(name, 1, format!("not drawn: {why}")),
    }
}
