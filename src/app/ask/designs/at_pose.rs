//! Small questions at one pose: forces, small motions, stiffness, a leg that is stuck, the nearest singular pose.

use nalgebra::{Matrix3, Matrix6, Vector3, Vector6};
use thiserror::Error;

use super::PoseFrames;
use crate::Design;
use fk::{NearOutcome, NearSolver};
use machine::reach::StraightPath;
use machine::requirements::{LeastStiffness, Term, Terms};
use machine::rotary::OutOfReach;
use machine::statics::{PoseStatics, Screw, both_in, in_axes};
use platform::geom::Pose;
use platform::manipulator::{
    Body, LegLengths, Manipulator, inverse_condition, jacobian, jacobian_of_legs, leg_determinant,
};
use synthesis::singularity::{
    NearestPoseSearch, NearestSingularPose, SingularEvidence, nearest_singular_pose, nearest_zero,
};

/// The questions at a pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AtPoseOptions {
    /// The pose.
    pub pose: Pose,
    /// The point that wrenches, shifts and stiffness are about, platform frame.
    pub point: Vector3<f64>,
    /// The body whose axes vectors have.
    pub axes: Body,
    /// A wrench on the platform: force and torque about the point.
    pub wrench: Option<[f64; 6]>,
    /// Forces of the legs, positive where they push, or torques of the cranks.
    pub efforts: Option<[f64; 6]>,
    /// The leg that is stuck or free, by its index.
    pub leg: Option<usize>,
    /// Directions in which the nearest singular pose is sought; `None`: it is not asked for.
    pub directions: Option<usize>,
    /// The seed of the search.
    pub seed: u64,
}

impl AtPoseOptions {
    /// The questions at a pose about the origin of the platform, in the axes of the base.
    #[must_use]
    pub fn at(pose: Pose) -> Self {
        Self {
            pose,
            point: Vector3::zeros(),
            axes: Body::Base,
            wrench: None,
            efforts: None,
            leg: None,
            directions: None,
            seed: 1,
        }
    }

    num::setters! {
        /// The point that wrenches, shifts and stiffness are about, platform frame.
        fn point(point: Vector3<f64>) = point;
        /// The body whose axes vectors have.
        fn axes(axes: Body) = axes;
        /// A wrench on the platform: force and torque about the point.
        fn wrench(wrench: impl Into<Option<[f64; 6]>>) = wrench.into();
        /// Forces of the legs, positive where they push, or torques of the cranks.
        fn efforts(efforts: impl Into<Option<[f64; 6]>>) = efforts.into();
        /// The leg that is stuck or free, by its index.
        fn leg(leg: impl Into<Option<usize>>) = leg.into();
        /// Directions in which the nearest singular pose is sought.
        fn directions(directions: impl Into<Option<usize>>) = directions.into();
        /// The seed of the search.
        fn seed(seed: u64) = seed;
    }
}

/// Why there is no answer.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoAtPose {
    /// A leg has no length at the pose.
    #[error("the leg lengths at this pose are not finite positive numbers")]
    NoLengths,
}

/// The state of the drives.
#[derive(Debug, Clone, PartialEq)]
pub enum DrivesAt {
    /// The lengths that the legs show.
    Lengths([f64; 6]),
    /// The angles of the cranks, radians.
    Angles([f64; 6]),
    /// A rod does not reach.
    OutOfReach(OutOfReach),
}

/// A wrench and the efforts that hold it.
#[derive(Debug, Clone, PartialEq)]
pub struct HeldWrench {
    /// The name of the load; `None`: the wrench that was asked for.
    pub load: Option<String>,
    /// Force and torque about the point, in the axes asked for.
    pub wrench: [f64; 6],
    /// The efforts; `None` at a singular pose.
    pub efforts: Option<[f64; 6]>,
}

/// The remaining motion with a leg stuck, or free.
#[derive(Debug, Clone, PartialEq)]
pub struct StuckLeg {
    /// The leg, by its index.
    pub leg: usize,
    /// The speed of its drive when each of the six numbers of the pose grows alone; a number with 0 is still free.
    pub rates: [f64; 6],
    /// The motion that is lost, and the only one left when the leg is free and the others hold, in the axes asked for;
    /// `None` at a singular pose.
    pub screw: Option<Screw>,
    /// Poses of that motion to smaller lengths of the leg, and to greater ones; empty for cranks.
    pub ways: [Vec<(f64, Pose)>; 2],
}

/// The greatest speed and effort of one of the six numbers of a pose; without the effort of weights.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisCapacity {
    /// Greatest speed, design units or radians per second; `None` without a speed limit of the drives.
    pub speed: Option<f64>,
    /// Greatest force along the axis or torque about it; `None` without a limit of the drives, or at a singular pose.
    pub effort: Option<f64>,
}

/// The answer for a pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AtPoseReport {
    /// Lengths or angles.
    pub drives: DrivesAt,
    /// The evidence of a singular pose; `None`: the pose is regular.
    pub singular: Option<SingularEvidence>,
    /// The inverse condition of the Jacobian of legs or rods with the characteristic length; `None` where a rod does
    /// not reach.
    pub inverse_condition: Option<f64>,
    /// The loads of the design, and the wrench asked for.
    pub held: Vec<HeldWrench>,
    /// The wrench that the efforts asked for hold.
    pub wrench: Option<[f64; 6]>,
    /// Wrenches for unit efforts, by columns; `None` where a rod does not reach or a crank is singular.
    pub wrenches: Option<Matrix6<f64>>,
    /// Stiffness at the point; `None` where the design does not say that of its drives.
    pub stiffness: Option<(Matrix6<f64>, Option<LeastStiffness>)>,
    /// Twists of the point for unit steps of the drives, by columns; `None` at a singular pose.
    pub motions: Option<Matrix6<f64>>,
    /// The leg asked about.
    pub stuck: Option<StuckLeg>,
    /// The nearest singular pose, where it was asked for and a search met one.
    pub nearest_singular: Option<NearestSingularPose>,
}

/// Poses to each side on the motion of one leg.
const WAY_POSES: usize = 20;
/// The leg moves by up to this share of its length, where the design does not limit it.
const WAY_SHARE: f64 = 0.1;

impl Design {
    /// Forces, small motions and stiffness at a pose about a point of the platform.
    ///
    /// # Errors
    /// A leg without a length.
    pub fn at_pose(&self, frames: &PoseFrames, asked: &AtPoseOptions) -> Result<AtPoseReport, NoAtPose> {
        let (pose, length) = (&asked.pose, self.characteristic_length());
        // cranks of a design that was read make a platform
        let cranks = self.rotary().ok().flatten();
        let axes = axes_of(frames, asked);
        let (drives, rods) = match &cranks {
            None => {
                let lengths = pose.lengths(self.manipulator()).ok_or(NoAtPose::NoLengths)?.get();
                let offsets = self.leg_offsets();
                let shown = std::array::from_fn(|i| lengths[i] + offsets[i]);
                (DrivesAt::Lengths(shown), Some(self.manipulator().clone()))
            }
            Some(platform) => match platform.ik(pose) {
                Ok(angles) => (DrivesAt::Angles(angles), platform.at(&angles).ok()),
                Err(missing) => (DrivesAt::OutOfReach(missing), None),
            },
        };
        let arm = pose.rotation * asked.point;
        let statics = self.statics_at(pose, &arm);
        let both = both_in(&axes);
        let shown = |v: Vector6<f64>| -> [f64; 6] { (both.transpose() * v).into() };
        let held = |load: Option<String>, wrench: Vector6<f64>| HeldWrench {
            load,
            wrench: shown(wrench),
            efforts: statics.as_ref().and_then(|s| s.efforts(&wrench)).map(Into::into),
        };
        let loads = rods.iter().flat_map(|rods| {
            let loads = self.all_loads().into_iter();
            loads.map(move |load| (Some(load.name.clone()), at_point(load.wrench(rods, pose), &arm)))
        });
        let own = asked.wrench.map(|wrench| (None, both * Vector6::from(wrench)));
        let springs = match &cranks {
            None => self.hardware.leg_stiffness,
            Some(_) => self.crank_limits().stiffness,
        };
        let springs = springs.map(|drive| [drive; 6]);
        let motions = statics.as_ref().and_then(|s| s.motions().copied());
        Ok(AtPoseReport {
            singular: self.singular_at(pose).map(|found| found.evidence),
            inverse_condition: rods
                .as_ref()
                .map(|rods| inverse_condition(&jacobian_of_legs(&rods.legs(), pose, length))),
            held: loads.chain(own).map(|(load, wrench)| held(load, wrench)).collect(),
            wrench: asked
                .efforts
                .and_then(|efforts| Some(shown(statics.as_ref()?.wrench(&Vector6::from(efforts))))),
            wrenches: statics.as_ref().map(|s| -(both.transpose() * s.rates().transpose())),
            stiffness: statics
                .as_ref()
                .zip(springs)
                .map(|(s, springs)| (in_axes(&s.stiffness(&springs), &axes), s.least_stiffness(&springs))),
            motions: motions.map(|motions| both.transpose() * motions),
            stuck: match (asked.leg, &statics) {
                (Some(leg), Some(statics)) => Some(self.stuck(frames, asked, statics, leg)),
                _ => None,
            },
            nearest_singular: match asked.directions {
                None => None,
                Some(directions) => {
                    let search = NearestPoseSearch { length, directions, seed: asked.seed };
                    match &cranks {
                        None => nearest_singular_pose(self.manipulator(), pose, &search),
                        Some(platform) => {
                            // rods as legs from the crank tips; a pose out of reach has no value
                            let of = |pose: &Pose| {
                                let rods =
                                    platform.ik(pose).ok().and_then(|angles| platform.at(&angles).ok());
                                rods.map_or(f64::NAN, |rods| leg_determinant(&rods, pose))
                            };
                            nearest_zero(&of, None, self.manipulator().size(), pose, &search)
                        }
                    }
                }
            },
            drives,
        })
    }

    /// Greatest speed, force and torque of each of the six numbers of a pose under the limits of the drives. One number
    /// moves alone, or one force or torque acts alone at the pivot.
    #[must_use]
    pub fn axis_capacities(&self, frames: &PoseFrames, pose: &Pose) -> [AxisCapacity; 6] {
        let pivot = frames.convention.pivot_on_platform();
        let statics = self.statics_at(pose, &(pose.rotation * pivot));
        let [effort, speed] = self.drive_limits().map(|(_, greatest)| greatest);
        // speeds of cranks are limited in degrees
        let speed = if self.has_cranks() { speed.map(f64::to_radians) } else { speed };
        let share = |limit: Option<f64>, drives: Option<Vector6<f64>>| {
            Some(limit? / drives?.amax()).filter(|most| most.is_finite())
        };
        frames.ways(pose).map(|way| {
            let alone = twist_along(&way, &pivot);
            let statics = statics.as_ref();
            AxisCapacity {
                speed: share(speed, statics.map(|s| s.rates() * alone)),
                effort: share(effort, statics.and_then(|s| s.efforts(&alone))),
            }
        })
    }

    /// The drives about a point at an arm from the platform origin; `None` if a rod does not reach or a crank is
    /// singular.
    fn statics_at(&self, pose: &Pose, arm: &Vector3<f64>) -> Option<PoseStatics> {
        // cranks of a design that was read make a platform
        let rates = match self.rotary().ok().flatten() {
            None => jacobian(self.manipulator(), pose, 1.0),
            Some(platform) => platform.crank_jacobian(pose, &platform.ik(pose).ok()?)?,
        };
        Some(PoseStatics::new(&rates, arm, self.characteristic_length()))
    }

    fn stuck(
        &self,
        frames: &PoseFrames,
        asked: &AtPoseOptions,
        statics: &PoseStatics,
        leg: usize,
    ) -> StuckLeg {
        let (pose, point) = (&asked.pose, asked.point);
        let rates = frames.ways(pose).map(|way| (statics.rates().row(leg) * twist_along(&way, &point))[0]);
        let axes = axes_of(frames, asked).transpose();
        let screw = statics.screw(leg).map(|screw| Screw {
            direction: axes * screw.direction,
            point: axes * screw.point,
            ..screw
        });
        let ways = if self.has_cranks() { [Vec::new(), Vec::new()] } else { self.ways_of_leg(pose, leg) };
        StuckLeg { leg, rates, screw, ways }
    }

    /// Poses with all lengths but one, to both sides, up to its limits or the first singular pose.
    fn ways_of_leg(&self, pose: &Pose, leg: usize) -> [Vec<(f64, Pose)>; 2] {
        let m: &Manipulator = self.manipulator();
        let Some(lengths) = pose.lengths(m) else { return [Vec::new(), Vec::new()] };
        let now = lengths.get()[leg];
        let limits = self.hardware.leg_length.map(|limits| limits.range());
        let (least, most) = limits.unwrap_or((now * (1.0 - WAY_SHARE), now * (1.0 + WAY_SHARE)));
        let solver = NearSolver::new(m);
        [least.min(now), most.max(now)].map(|end| {
            let mut from = *pose;
            let step = |k: usize| {
                let mut next = lengths.get();
                next[leg] = now + (end - now) * (k as f64 / WAY_POSES as f64);
                let NearOutcome::Tracked { pose, .. } =
                    solver.solve(&LegLengths::try_new(next).ok()?.squared(), &from)
                else {
                    return None;
                };
                from = pose;
                Some((next[leg], pose))
            };
            if (end - now).abs() > 0.0 { (1..=WAY_POSES).map_while(step).collect() } else { Vec::new() }
        })
    }
}

/// Whether a pose meets all requirements that have these margins there; a margin of zero within rounding is met.
#[must_use]
pub fn meets_all(terms: &Terms<'_>, margins: &[(Term, f64)], pose: &Pose) -> bool {
    margins
        .iter()
        .all(|(term, margin)| *margin > 0.0 || terms.standing(term.kind, *margin, Some(pose)).is_met())
}

/// The twist of a point of the platform at the start of a path, whose own pivot stays on its line.
fn twist_along(way: &StraightPath, point: &Vector3<f64>) -> Vector6<f64> {
    let velocity = way.velocity + way.turn.cross(&(way.start.rotation * (point - way.pivot)));
    Vector6::new(velocity.x, velocity.y, velocity.z, way.turn.x, way.turn.y, way.turn.z)
}

/// The axes of vectors in the base frame, by columns.
fn axes_of(frames: &PoseFrames, asked: &AtPoseOptions) -> Matrix3<f64> {
    let own = frames.convention.axes();
    match asked.axes {
        Body::Base => own,
        Body::Platform => asked.pose.rotation.matrix() * own,
    }
}

/// A wrench about the platform origin, about a point at an arm from it.
fn at_point(wrench: Vector6<f64>, arm: &Vector3<f64>) -> Vector6<f64> {
    let force: Vector3<f64> = wrench.fixed_rows::<3>(0).into();
    let torque: Vector3<f64> = wrench.fixed_rows::<3>(3) - arm.cross(&force);
    Vector6::new(force.x, force.y, force.z, torque.x, torque.y, torque.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::parse;
    use files::design::Format;
    use machine::requirements::LengthLimits;

    /// The greatest length is that of the legs at home, changed by a share of it.
    fn meets(share: f64) -> bool {
        let text = include_str!("../../../../designs/symmetric-hexapod.toml");
        let (mut design, _) = parse(text, Format::Toml).unwrap();
        let home = design.home_or_default();
        let longest = home.lengths(design.manipulator()).unwrap().get().into_iter().fold(0.0, f64::max);
        design.hardware.leg_length = Some(LengthLimits::Range(longest / 2.0, longest * (1.0 + share)));
        let required = design.requirements();
        let terms = Terms::new(design.manipulator(), &required, &home);
        meets_all(&terms, &terms.at(&home), &home)
    }

    #[test]
    fn a_margin_of_zero_is_met_and_a_negative_one_is_not() {
        assert_eq!([1e-6, 1e-16, 0.0, -1e-16, -1e-6].map(meets), [true, true, true, true, false]);
    }
}
