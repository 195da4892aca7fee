//! The movement of the legs and the forces of the drives along a motion, against the limits of the design.

use nalgebra::{Matrix6, Vector6};

use crate::Design;
use machine::dynamics::{
    LeastStiffness, LegExtremes, LegInstant, LegMotion, Manoeuvre, MotionState, MovingBodies, PosePath,
    Vibration, drive_forces, least_stiffness, leg_motions, mass_matrix, stiffness_matrix, vibration,
};
use machine::requirements::{LeastMargins, Load, Margin, Term, TermKind, Terms};
use machine::rotary::{CrankMotion, RotaryPlatform};
use platform::geom::Pose;
use platform::manipulator::{Manipulator, leg_determinant};
use synthesis::singularity::{SingularEvidence, hold_at, singular_along, straight};

/// A motion of the platform.
#[derive(Debug, Clone, PartialEq)]
pub enum PlatformMotion {
    /// A path through poses at given times, with this number of samples between two poses.
    Path(PosePath, usize),
    /// A standard manoeuvre about a pose, with this number of samples.
    Manoeuvre(Manoeuvre, Pose, usize),
}

impl PlatformMotion {
    /// The states with their times, seconds.
    fn states(&self) -> Vec<(f64, MotionState)> {
        match self {
            Self::Path(path, steps) => {
                let pieces = path.times().windows(2);
                let within = pieces.flat_map(|t| {
                    (0..*steps).map(move |k| t[0] + (t[1] - t[0]) * (k as f64 / *steps as f64))
                });
                within.chain(path.times().last().copied()).map(|t| (t, path.at(t))).collect()
            }
            Self::Manoeuvre(manoeuvre, about, samples) => {
                let duration = manoeuvre.duration();
                let count = if duration > 0.0 { *samples } else { 0 };
                let time = |k: usize| duration * k as f64 / count.max(1) as f64;
                (0..=count).map(|k| (time(k), manoeuvre.at(about, time(k)))).collect()
            }
        }
    }
}

/// Greatest angle of one part of a sinusoidal rotation, radians.
const TURN: f64 = std::f64::consts::FRAC_PI_2;

impl PlatformMotion {
    /// The first pose of the whole motion at which the legs do not hold the platform; `None` if all poses are proved
    /// regular.
    fn singular(&self, m: &Manipulator) -> Option<SingularInstant> {
        match self {
            Self::Path(path, _) => {
                let times = path.times();
                let curves: Vec<_> = (0..times.len() - 1).map(|k| path.control_points(k)).collect();
                let found = singular_along(m, curves.iter().map(|c| &c[..]))?;
                let (from, to) = (times[found.curve], times[found.curve + 1]);
                let time = from + (to - from) * found.at;
                Some(SingularInstant { time, pose: found.pose, evidence: found.evidence })
            }
            Self::Manoeuvre(manoeuvre, about, _) => match manoeuvre {
                Manoeuvre::Acceleration { .. } => {
                    let evidence = hold_at(m, about).singular()?;
                    Some(SingularInstant { time: 0.0, pose: *about, evidence })
                }
                Manoeuvre::Sine { .. } => {
                    // the paths to the two ends hold all poses
                    let period = manoeuvre.duration();
                    [0.0, 0.5 * period]
                        .into_iter()
                        .find_map(|start| quarter_of_sine(m, manoeuvre, about, start))
                }
            },
        }
    }
}

/// The first singular pose of a quarter of a sine, which leaves the middle at a given time.
fn quarter_of_sine(m: &Manipulator, sine: &Manoeuvre, about: &Pose, start: f64) -> Option<SingularInstant> {
    let Manoeuvre::Sine { freedom, amplitude, frequency } = *sine else { return None };
    let rate = std::f64::consts::TAU * frequency;
    let turn = if freedom.is_turn() { amplitude.to_radians() } else { 0.0 };
    let parts = (turn.abs() / TURN).ceil().max(1.0);
    let time = |share: f64| start + share.clamp(0.0, 1.0).asin() / rate;
    let steps = (0u32..).map(f64::from).take_while(|k| *k <= parts);
    let poses: Vec<Pose> = steps.map(|k| sine.at(about, time(k / parts)).pose).collect();
    let curves: Vec<_> = poses.windows(2).map(|w| straight(&w[0], &w[1])).collect();
    let found = singular_along(m, curves.iter().map(|c| &c[..]))?;
    // the quaternion is linear in the parameter, with half the angle of rotation
    let half = 0.5 * turn / parts;
    let within = if half > 0.0 {
        (found.at * half.sin()).atan2(1.0 - found.at + found.at * half.cos()) / half
    } else {
        found.at
    };
    let share = (found.curve as f64 + within) / parts;
    Some(SingularInstant { time: time(share), pose: found.pose, evidence: found.evidence })
}

/// An instant of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionInstant {
    /// The time, seconds.
    pub time: f64,
    /// The pose of the platform with its velocity and acceleration.
    pub state: MotionState,
    /// The legs, in design units and seconds. For cranks the angles, in degrees and seconds, not finite if a rod does
    /// not reach.
    pub legs: [LegMotion; 6],
    /// Forces of the drives (force units) and powers (watts); for cranks, torques in force units times design units.
    /// `None` if no masses are known, at a singular pose, and if a rod does not reach.
    pub drives: Option<([f64; 6], [f64; 6])>,
}

/// A least margin with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TimedMargin {
    /// The least margin.
    pub margin: Margin,
    /// The time from the start, seconds.
    pub time: f64,
}

/// A singular pose of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularInstant {
    /// The time, seconds.
    pub time: f64,
    pub pose: Pose,
    pub evidence: SingularEvidence,
}

/// The results along a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct MotionReport {
    /// The instants in the order of time.
    pub instants: Vec<MotionInstant>,
    /// Whether the legs are rods on cranks, so that angles in degrees replace lengths, and torques replace forces.
    pub cranks: bool,
    /// The extremes of each leg; empty if a leg has no length, or a rod does not reach.
    pub legs: Vec<LegExtremes>,
    /// The least margin of each kind of requirement over the instants.
    pub margins: Vec<TimedMargin>,
    /// The first singular pose: the legs or rods do not hold the platform, or a crank is singular. For legs the whole
    /// path is checked, between the instants too.
    pub singular: Option<SingularInstant>,
    /// The time at which a rod first does not reach, seconds.
    pub unreached: Option<f64>,
}

/// The stiffness of a platform at a pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct StiffnessReport {
    /// The pose.
    pub pose: Pose,
    /// The stiffness matrix `J^T diag(k) J` in force units, design units and radians.
    pub matrix: Matrix6<f64>,
    /// The least stiffness; `None` at a singular pose.
    pub least: Option<LeastStiffness>,
    /// The natural motions; `None` if masses are unknown, or no inertia resists some rotation.
    pub natural: Option<[Vibration; 6]>,
}

/// The data for computing forces.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionMasses {
    bodies: MovingBodies,
    /// The number of newtons in a force unit.
    newtons: f64,
    /// The load in addition to the weight.
    load: Option<Load>,
}

impl Design {
    /// The data for computing forces: [the bodies that move with the
    /// platform](files::design::DesignModel::moving_payload) and the masses of the legs. A design unit is `metres`
    /// long. `None` if no masses are known.
    pub fn motion_masses(&self, metres: f64, load: Option<Load>) -> Option<MotionMasses> {
        let newtons = self.force_unit().newtons();
        let bodies = self.moving_bodies(metres)?;
        Some(MotionMasses { bodies, newtons, load })
    }

    /// The stiffness at a pose; `None` if the design does not state the stiffness of its legs.
    pub fn stiffness_at(&self, pose: &Pose, masses: Option<&MotionMasses>) -> Option<StiffnessReport> {
        let (m, leg) = (self.manipulator(), self.hardware.leg_stiffness?);
        let matrix = stiffness_matrix(m, pose, leg);
        let natural = masses.and_then(|known| {
            vibration(m, pose, known.per_second_squared(leg), &mass_matrix(m, &known.bodies, pose))
        });
        Some(StiffnessReport { pose: *pose, matrix, least: least_stiffness(&matrix), natural })
    }

    /// The legs along a motion. Limits are checked at the sampled instants.
    pub fn along(&self, motion: &PlatformMotion, masses: Option<&MotionMasses>) -> MotionReport {
        let m = self.manipulator();
        // the cranks of a parsed design always make a platform
        let cranks = self.rotary().ok().flatten();
        let instants: Vec<MotionInstant> = motion
            .states()
            .into_iter()
            .map(|(time, state)| {
                if let Some(platform) = &cranks {
                    return crank_instant(platform, time, state, masses);
                }
                let legs = leg_motions(m, &state);
                let drives = masses.and_then(|known| known.drives(self, &state, &legs));
                MotionInstant { time, state, legs, drives }
            })
            .collect();
        let of_leg = |i: usize| -> Option<LegExtremes> {
            let driven = |at: &MotionInstant| at.drives.as_ref().map(|(f, p)| (f[i], p[i]));
            let list: Vec<LegInstant> = instants.iter().map(|at| (at.time, at.legs[i], driven(at))).collect();
            LegExtremes::of(&list)
        };
        let reached = |at: &&MotionInstant| at.legs.iter().all(|leg| leg.length.is_finite());
        let unreached = instants.iter().find(|at| cranks.is_some() && !reached(at)).map(|at| at.time);
        let legs = if unreached.is_some() { Vec::new() } else { (0..6).map_while(of_leg).collect() };
        let unheld = |at: &&MotionInstant| masses.is_some() && at.drives.is_none();
        let stuck = |at: &&MotionInstant| !at.legs.iter().all(|leg| leg.acceleration.is_finite());
        let at_instant = |at: &MotionInstant| SingularInstant {
            time: at.time,
            pose: at.state.pose,
            evidence: SingularEvidence::Rounding,
        };
        let singular = match &cranks {
            None => motion.singular(m).or_else(|| instants.iter().find(unheld).map(at_instant)),
            Some(platform) => {
                let found =
                    instants.iter().filter(reached).find(|at| unheld(at) || stuck(at)).map(at_instant);
                let all = [found, rods_that_change_side(platform, &instants)];
                all.into_iter().flatten().min_by(|x, y| x.time.total_cmp(&y.time))
            }
        };
        let margins = self.margins_along(&instants);
        MotionReport { instants, cranks: cranks.is_some(), legs, margins, singular, unreached }
    }

    /// The least margin of each kind: margins of the pose as in `assess`, margins of force and speed by the motion.
    fn margins_along(&self, instants: &[MotionInstant]) -> Vec<TimedMargin> {
        let required = self.requirements();
        let terms = Terms::new(self.manipulator(), &required, &self.home_or_default());
        let mut least: LeastMargins<&MotionInstant> = LeastMargins::default();
        for at in instants {
            let by_pose = terms.at(&at.state.pose).into_iter();
            let by_pose = by_pose.filter(|(t, _)| !is_of_motion(t.kind));
            least.see(by_pose.chain(self.drive_margins(at)), at);
        }
        let timed = |(term, value, at): (Term, f64, &MotionInstant)| TimedMargin {
            margin: terms.margin((term, value), Some(at.state.pose)),
            time: at.time,
        };
        least.each().map(timed).collect()
    }

    /// The greatest force and speed of a leg, or torque and speed (degrees per second) of a crank.
    pub(super) fn drive_limits(&self) -> [(TermKind, Option<f64>); 2] {
        if self.has_cranks() {
            let cranks = self.crank_limits();
            [(TermKind::CrankTorque, cranks.max_torque), (TermKind::CrankSpeed, cranks.max_speed_deg)]
        } else {
            [TermKind::LegForce, TermKind::LegSpeed].map(|kind| (kind, self.hardware.drive_limit(kind)))
        }
    }

    /// Margins of the drives: greatest speed minus speed, and greatest force minus force, or torque for cranks. A pose
    /// beyond the reach of a rod has none.
    fn drive_margins(&self, at: &MotionInstant) -> Vec<(Term, f64)> {
        let [force, speed] = self.drive_limits();
        let mut out = Vec::new();
        for i in 0..6 {
            if let (kind, Some(greatest)) = speed
                && !(self.has_cranks() && at.legs[i].length.is_nan())
            {
                out.push((Term { kind, first: i, second: i }, greatest - at.legs[i].speed.abs()));
            }
            if let ((kind, Some(greatest)), Some((forces, _))) = (force, &at.drives) {
                out.push((Term { kind, first: i, second: 0 }, greatest - forces[i].abs()));
            }
        }
        out
    }
}

/// The first instant at which `det J` of the rods has the opposite sign to the instant before.
fn rods_that_change_side(platform: &RotaryPlatform, instants: &[MotionInstant]) -> Option<SingularInstant> {
    let side = |at: &MotionInstant| -> Option<bool> {
        let angles = platform.ik(&at.state.pose).ok()?;
        let det = leg_determinant(&platform.at(&angles).ok()?, &at.state.pose);
        det.is_finite().then_some(det > 0.0)
    };
    let sides: Vec<Option<bool>> = instants.iter().map(side).collect();
    let changed =
        (1..sides.len()).find(|k| matches!((sides[k - 1], sides[*k]), (Some(x), Some(y)) if x != y))?;
    let at = &instants[changed];
    Some(SingularInstant { time: at.time, pose: at.state.pose, evidence: SingularEvidence::SignChange })
}

/// Whether the motion itself decides this requirement, rather than a greatest speed or a load in every direction.
fn is_of_motion(kind: TermKind) -> bool {
    use TermKind::{CrankSpeed, CrankTorque, LegForce, LegSpeed};
    matches!(kind, LegForce | LegSpeed | CrankTorque | CrankSpeed)
}

/// The cranks at an instant, with angles in degrees as lengths and torques as forces.
fn crank_instant(
    platform: &RotaryPlatform,
    time: f64,
    state: MotionState,
    masses: Option<&MotionMasses>,
) -> MotionInstant {
    let none = LegMotion { length: f64::NAN, speed: f64::NAN, acceleration: f64::NAN };
    let Ok(angles) = platform.ik(&state.pose) else {
        return MotionInstant { time, state, legs: [none; 6], drives: None };
    };
    let joints = platform.legs().map(|leg| state.of_arm(&(state.pose.rotation * leg.platform.coords)));
    let motions = platform.motions(&state.pose, &angles, &joints);
    let legs = motions.map(|crank| LegMotion {
        length: crank.angle.to_degrees(),
        speed: crank.speed.to_degrees(),
        acceleration: crank.acceleration.to_degrees(),
    });
    let drives = masses.and_then(|known| known.torques(platform, &state, &angles, &motions));
    MotionInstant { time, state, legs, drives }
}

impl MotionMasses {
    /// The masses of platform, payload and legs.
    pub fn bodies(&self) -> &MovingBodies {
        &self.bodies
    }

    /// Converts a stiffness from force units per design unit to kilograms per second squared.
    pub fn per_second_squared(&self, stiffness: f64) -> f64 {
        stiffness * self.newtons / self.bodies.metres
    }

    /// Forces of the drives in force units, and powers in watts.
    fn drives(
        &self,
        design: &Design,
        state: &MotionState,
        legs: &[LegMotion; 6],
    ) -> Option<([f64; 6], [f64; 6])> {
        let bodies = &self.bodies;
        // converts the internal unit of force, kilograms times design units per second squared, to force units
        let in_unit = self.newtons / bodies.metres;
        let m = design.manipulator();
        let load = self.load.as_ref().map_or_else(Vector6::zeros, |l| l.wrench(m, &state.pose) * in_unit);
        let forces = drive_forces(m, bodies, state, &load)?;
        let powers = std::array::from_fn(|i| bodies.newtons(forces[i]) * legs[i].speed * bodies.metres);
        Some((forces.map(|f| f / in_unit), powers))
    }

    /// Torques of the cranks in force units times design units, and powers in watts. Cranks and rods count as massless.
    fn torques(
        &self,
        platform: &RotaryPlatform,
        state: &MotionState,
        angles: &[f64; 6],
        motions: &[CrankMotion; 6],
    ) -> Option<([f64; 6], [f64; 6])> {
        let bodies = &self.bodies;
        let in_unit = self.newtons / bodies.metres;
        let rods = platform.at(angles).ok()?;
        let load = self.load.as_ref().map_or_else(Vector6::zeros, |l| l.wrench(&rods, &state.pose) * in_unit);
        let pushes = drive_forces(&rods, bodies, state, &load)?;
        let transmissions = platform.transmissions(&state.pose, angles);
        let torques: [f64; 6] =
            std::array::from_fn(|i| pushes[i] * platform.legs()[i].crank.length * transmissions[i]);
        // in kilograms times design units squared per second squared
        let powers: [f64; 6] =
            std::array::from_fn(|i| bodies.newtons(torques[i]) * bodies.metres * motions[i].speed);
        let finite = torques.iter().chain(&powers).all(|x| x.is_finite());
        finite.then(|| (torques.map(|t| t / in_unit), powers))
    }
}
