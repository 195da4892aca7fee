//! `[cranks]`: the stated data of cranks and rods, and the resulting numbers.

use nalgebra::{Unit, Vector3};

use super::resolve::{Fault, Owner, ordered};
use super::{Constructions, CoordinatePlane, WrittenNumber};
use crate::design::Code;
use machine::rotary::Elbow;
use num::real::RealNumber;

/// Greatest magnitude of a length: its fourth power still fits a double.
const LARGEST: f64 = 1e60;
/// Places of the numbers of a crank among its parts.
pub(in crate::design) const PARTS: usize = 11;
const LENGTH: usize = 0;
const ROD_LENGTH: usize = 1;
const AXIS: usize = 2;
const ZERO: usize = 5;
const ANGLES: usize = 8;
const TURN: usize = 10;

/// The crank that another one is a copy of.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum CrankCopy {
    /// `turn = "A1"`, `deg = 120`: axis and zero direction are rotated about the z axis of the base frame.
    Turned { crank: usize, deg: WrittenNumber },
    /// `mirror = "A1"`, `plane = "xz"`: at equal angles the cranks are mirror images.
    Mirrored { crank: usize, plane: CoordinatePlane },
}

impl CrankCopy {
    /// The crank it starts from, by its base joint.
    pub(in crate::design) fn crank(&self) -> usize {
        match self {
            Self::Turned { crank, .. } | Self::Mirrored { crank, .. } => *crank,
        }
    }
}

/// The stated data of one crank, or of all of them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct WrittenCrank {
    pub(in crate::design) length: Option<WrittenNumber>,
    pub(in crate::design) rod_length: Option<WrittenNumber>,
    pub(in crate::design) axis: Option<[WrittenNumber; 3]>,
    pub(in crate::design) zero: Option<[WrittenNumber; 3]>,
    pub(in crate::design) angle_deg: Option<[WrittenNumber; 2]>,
    pub(in crate::design) elbow: Option<Elbow>,
    pub(in crate::design) copy: Option<CrankCopy>,
}

impl WrittenCrank {
    /// The numbers in it, with their parts.
    pub(super) fn quantities(&self) -> Vec<(usize, &WrittenNumber)> {
        let mut all: Vec<(usize, &WrittenNumber)> = Vec::new();
        all.extend(self.length.iter().map(|q| (LENGTH, q)));
        all.extend(self.rod_length.iter().map(|q| (ROD_LENGTH, q)));
        all.extend(self.axis.iter().flatten().enumerate().map(|(k, q)| (AXIS + k, q)));
        all.extend(self.zero.iter().flatten().enumerate().map(|(k, q)| (ZERO + k, q)));
        all.extend(self.angle_deg.iter().flatten().enumerate().map(|(k, q)| (ANGLES + k, q)));
        if let Some(CrankCopy::Turned { deg, .. }) = &self.copy {
            all.push((TURN, deg));
        }
        all
    }
}

/// The stated numbers of a crank, as the nearest doubles.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Stated {
    length: Option<f64>,
    rod: Option<f64>,
    axis: Option<Vector3<f64>>,
    zero: Option<Vector3<f64>>,
    limits_deg: Option<[f64; 2]>,
    elbow: Option<Elbow>,
}

impl Stated {
    /// The values stated here, completed by those of `other`.
    fn or(self, other: Self) -> Self {
        Self {
            length: self.length.or(other.length),
            rod: self.rod.or(other.rod),
            axis: self.axis.or(other.axis),
            zero: self.zero.or(other.zero),
            limits_deg: self.limits_deg.or(other.limits_deg),
            elbow: self.elbow.or(other.elbow),
        }
    }
}

/// A crank and its rod, without the joints at their ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct CrankValues {
    pub(in crate::design) length: f64,
    pub(in crate::design) rod: f64,
    pub(in crate::design) axis: Unit<Vector3<f64>>,
    pub(in crate::design) zero: Vector3<f64>,
    pub(in crate::design) limits_deg: Option<[f64; 2]>,
    pub(in crate::design) elbow: Elbow,
}

/// Limits of the drives of the cranks and the joints of the rods.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct CrankLimits {
    /// Greatest torque about the axis of a crank, force units times design units.
    pub max_torque: Option<f64>,
    /// Greatest speed of a crank, degrees per second.
    pub max_speed_deg: Option<f64>,
    /// Least transmission angle, degrees.
    pub min_transmission_angle_deg: Option<f64>,
    /// Cone angle of the joint at the tip, out of the plane in which the crank turns, degrees.
    pub tip_angle_deg: Option<f64>,
    /// Cone angle of the joint at the platform, from the direction of the rod at home, degrees.
    pub platform_cone_angle_deg: Option<f64>,
}

/// `[cranks]`, as written, with the resulting numbers.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct WrittenCranks {
    /// The data of all cranks, used where single ones state nothing.
    pub(in crate::design) shared: WrittenCrank,
    /// The data of single cranks, by base joint.
    pub(in crate::design) own: Vec<Option<WrittenCrank>>,
    pub(in crate::design) drives: CrankLimits,
    /// The numbers of each crank by base joint, or the name of a missing key.
    pub(in crate::design) values: Vec<Result<CrankValues, &'static str>>,
}

impl WrittenCranks {
    /// All stated data, each with its owner for error messages: all cranks, then single ones.
    pub(super) fn all(&self) -> impl Iterator<Item = (Option<usize>, &WrittenCrank)> {
        let own = self.own.iter().enumerate().filter_map(|(j, own)| Some((Some(j), own.as_ref()?)));
        std::iter::once((None, &self.shared)).chain(own)
    }
}

impl Constructions {
    /// The numbers of all cranks.
    pub(super) fn resolve_cranks(
        &self,
        cranks: &mut WrittenCranks,
        names: &[String],
        parameters: (&[Option<RealNumber>], &[String]),
        faults: &mut Vec<Fault>,
    ) -> Option<()> {
        let before = faults.len();
        let mut evaluated = vec![(Stated::default(), None); cranks.own.len()];
        let mut shared = Stated::default();
        let mut whole = true;
        for (joint, written) in cranks.all() {
            let found = self.stated(joint, written, parameters, faults);
            whole &= found.is_some();
            match (joint, found) {
                (None, Some((stated, _))) => shared = stated,
                (Some(j), Some(found)) => evaluated[j] = found,
                (_, None) => {}
            }
        }
        let source = |j: usize| cranks.own[j].as_ref().and_then(|own| own.copy.as_ref());
        let needs: Vec<Vec<usize>> =
            (0..cranks.own.len()).map(|j| source(j).map(CrankCopy::crank).into_iter().collect()).collect();
        let (order, cycles) = ordered(&needs);
        for cycle in cycles {
            let names: Vec<&str> =
                cycle.iter().chain(cycle.first()).take(20).map(|j| names[*j].as_str()).collect();
            let message = format!("cranks follow from one another in a circle: {}", names.join(" -> "));
            let help = "give `axis` and `zero` of one of them";
            faults.push(fault(Some(cycle[0]), None, Code::Cycle, message, help));
        }
        if faults.len() > before || !whole {
            return None;
        }
        let mut stated = vec![shared; cranks.own.len()];
        for j in order {
            let (own, turn) = evaluated[j];
            stated[j] = match source(j) {
                None => own.or(shared),
                Some(copy) => own.or(copied(stated[copy.crank()], copy, turn)),
            };
        }
        cranks.values = stated.iter().map(|s| complete(s)).collect();
        // faults of copied or shared data are reported once, at the table that states them
        let states =
            |j: usize| cranks.own[j].as_ref().is_some_and(|own| own.axis.is_some() || own.zero.is_some());
        let mut shared_blamed = false;
        for (j, values) in cranks.values.iter().enumerate() {
            let Ok(values) = values else { continue };
            let blamed = if states(j) {
                Some(j)
            } else if source(j).is_some() || std::mem::replace(&mut shared_blamed, true) {
                continue;
            } else {
                None
            };
            let across = values.zero.normalize().cross(&values.axis).norm();
            if !(across > 1e-9) {
                let name = &names[j];
                let message =
                    format!("the direction of the angle zero of the crank {name} is along its axis");
                let help = "give a direction across the axis";
                faults.push(fault(blamed, Some(ZERO), Code::OutOfRange, message, help));
            }
        }
        (faults.len() == before).then_some(())
    }

    /// The stated numbers of a crank, each checked alone, with cosine and sine of its rotation.
    fn stated(
        &self,
        joint: Option<usize>,
        written: &WrittenCrank,
        parameters: (&[Option<RealNumber>], &[String]),
        faults: &mut Vec<Fault>,
    ) -> Option<(Stated, Option<[f64; 2]>)> {
        let owner = Owner::Crank(joint);
        let mut doubles = [None; PARTS];
        let (mut turn, mut whole) = (None, true);
        for (part, q) in written.quantities() {
            let Some(value) = self.quantity((owner, Some(part)), q, parameters, faults) else {
                whole = false;
                continue;
            };
            if part == TURN {
                turn = value.turn().ok().map(|(c, s)| [c.nearest(), s.nearest()]);
                whole &= turn.is_some();
            }
            let x = value.nearest();
            doubles[part] = Some(x);
            let mut refuse = |code, message: String, help: &str| {
                faults.push(fault(joint, Some(part), code, message, help));
                whole = false;
            };
            if !(x.abs() <= LARGEST) {
                refuse(Code::OutOfRange, format!("{x:e} is too large to compute with"), "stay below 1e60");
            } else if part <= ROD_LENGTH && !(x > 0.0) {
                let what = if part == LENGTH { "length" } else { "rod_length" };
                refuse(Code::NotPositive, format!("`{what}` of a crank is {x}"), "give a positive length");
            }
        }
        let vector =
            |first: usize| Some(Vector3::new(doubles[first]?, doubles[first + 1]?, doubles[first + 2]?));
        for (first, key) in [(AXIS, "axis"), (ZERO, "zero")] {
            if vector(first).is_some_and(|v| v.try_normalize(0.0).is_none()) {
                let message = format!("`{key}` of a crank has no direction");
                faults.push(fault(
                    joint,
                    Some(first),
                    Code::NotPositive,
                    message,
                    "give a vector that is not zero",
                ));
                whole = false;
            }
        }
        let limits_deg = doubles[ANGLES].zip(doubles[ANGLES + 1]).map(|(least, most)| [least, most]);
        if let Some([least, most]) =
            limits_deg.filter(|[least, most]| !(least < most && most - least <= 360.0))
        {
            let message = format!("angles of a crank from {least} to {most} degrees");
            let help = "give [least, greatest], at most a whole turn apart";
            faults.push(fault(joint, Some(ANGLES), Code::OutOfRange, message, help));
            whole = false;
        }
        let stated = Stated {
            length: doubles[LENGTH],
            rod: doubles[ROD_LENGTH],
            axis: vector(AXIS),
            zero: vector(ZERO),
            limits_deg,
            elbow: written.elbow,
        };
        whole.then_some((stated, turn))
    }
}

fn fault(joint: Option<usize>, part: Option<usize>, code: Code, message: String, help: &str) -> Fault {
    Fault { owner: Owner::Crank(joint), part, within: None, code, message, help: help.to_string() }
}

/// The data that a copy takes over.
fn copied(from: Stated, copy: &CrankCopy, turn: Option<[f64; 2]>) -> Stated {
    match copy {
        CrankCopy::Turned { .. } => {
            let [c, s] = turn.unwrap_or([1.0, 0.0]);
            let turn = |v: Vector3<f64>| Vector3::new(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
            Stated { axis: from.axis.map(turn), zero: from.zero.map(turn), ..from }
        }
        CrankCopy::Mirrored { plane, .. } => {
            // S (n x e) = (-S n) x (S e): with the axis -S n the images have equal angles
            let image = |mut v: Vector3<f64>| {
                v[plane.normal()] = -v[plane.normal()];
                v
            };
            Stated { axis: from.axis.map(|n| -image(n)), zero: from.zero.map(image), ..from }
        }
    }
}

/// All numbers, or the key that is missing.
fn complete(s: &Stated) -> Result<CrankValues, &'static str> {
    let axis = s.axis.ok_or("axis")?;
    // a unit vector is kept to the bit
    let unit = (axis.norm_squared() - 1.0).abs() < 1e-15;
    Ok(CrankValues {
        length: s.length.ok_or("length")?,
        rod: s.rod.ok_or("rod_length")?,
        axis: if unit { Unit::new_unchecked(axis) } else { Unit::new_normalize(axis) },
        zero: s.zero.ok_or("zero")?,
        limits_deg: s.limits_deg,
        elbow: s.elbow.ok_or("elbow")?,
    })
}
