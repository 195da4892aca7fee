//! The figures by which designs are compared.

use std::time::Instant;

use nalgebra::{Point3, Vector3};

use super::assessing::{AssessReport, deciding};
use super::moving::{MotionMasses, MotionReport, PlatformMotion};
use crate::Design;
use machine::dynamics::{least_stiffness, mass_matrix, stiffness_matrix, vibration};
use machine::manufacture::{ErrorBound, PoseSearch, ToleranceError, joint_allowance};
use machine::requirements::{AssessOptions, Terms, leg_forces};
use machine::rotary::RotaryPlatform;
use num::Purpose;
use platform::geom::Pose;
use platform::manipulator::{Body, jacobian};

/// Number of steps between two poses of a trajectory.
const STEPS: usize = 10;
/// Lengths at home that differ by less than this share of the size count as equal, as in a drawing.
const SAME_LENGTH: f64 = 1e-6;

/// The options of the figures.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct FigureOptions<'a> {
    /// Number of points of a Halton sequence in the region of poses; as many random points are added.
    pub points: usize,
    /// Seed of the random poses.
    pub seed: u64,
    /// Motions about home.
    pub motions: &'a [PlatformMotion],
    /// The masses for the forces along the motions.
    pub masses: Option<&'a MotionMasses>,
    /// The accuracy for the joint tolerances.
    pub accuracy: Option<ErrorBound>,
    /// Characteristic length of the conditioning, common to all designs compared.
    pub characteristic_length: f64,
    /// Optional time at which the assessment ends with the result so far.
    pub until: Option<Instant>,
}

impl<'a> FigureOptions<'a> {
    /// Figures with this characteristic length, without motions and accuracy.
    #[must_use]
    pub fn new(characteristic_length: f64) -> Self {
        let points = AssessOptions::default().points;
        Self {
            points,
            seed: 1,
            motions: &[],
            masses: None,
            accuracy: None,
            characteristic_length,
            until: None,
        }
    }

    num::setters! {
        /// Number of points of a Halton sequence in the region of poses; as many random points are added.
        fn points(points: usize) = points;
        /// Seed of the random poses.
        fn seed(seed: u64) = seed;
        /// Motions about home.
        fn motions(motions: &'a [PlatformMotion]) = motions;
        /// The masses for the forces along the motions.
        fn masses(masses: impl Into<Option<&'a MotionMasses>>) = masses.into();
        /// The accuracy for the joint tolerances.
        fn accuracy(accuracy: impl Into<Option<ErrorBound>>) = accuracy.into();
        /// Optional time at which the assessment ends with the result so far.
        fn until(until: impl Into<Option<Instant>>) = until.into();
    }
}

/// Figures of a design over the poses of its workspace, or at home if it states none. A figure is `None` if the design
/// does not specify its quantity; an infinite force stands for a singular pose.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct DesignFigures {
    /// The result of `assess`; `None` without requirements.
    pub assessment: Option<AssessReport>,
    /// Number of poses evaluated.
    pub poses: usize,
    /// Least and greatest leg length; not a number for rods on cranks.
    pub lengths: [f64; 2],
    /// The figures of the cranks; `None`: the legs change their lengths.
    pub cranks: Option<CrankFigures>,
    /// Number of different leg lengths at home, or of rod lengths.
    pub different_legs: usize,
    /// Greatest leg force under the loads.
    pub force: Option<f64>,
    /// Greatest leg speed at the required speed of the platform.
    pub speed: Option<f64>,
    /// Greatest force, speed and power (watts) of a leg along the motions.
    pub motion: MotionFigures,
    /// Least inverse condition number over the poses of `assess`.
    pub conditioning: f64,
    /// Least stiffness against a force.
    pub stiffness: Option<f64>,
    /// Lowest natural frequency, hertz.
    pub frequency: Option<f64>,
    /// Least distance of two joint centres, for base and platform; `None` for a body with a single joint.
    pub spacing: [Option<f64>; 2],
    /// Least clearance between two legs.
    pub clearance: Option<f64>,
    /// Greatest distance of a joint from the centroid of its body's joints, for base and platform.
    pub radius: [f64; 2],
    /// The greatest error of each joint that keeps the accuracy, as a radius, or the reason why there is none.
    pub allowance: Option<Result<f64, NoAllowance>>,
}

/// The reason why joints are not toleranced.
#[derive(Debug, Clone, PartialEq)]
pub enum NoAllowance {
    /// The tolerances cannot be computed.
    Error(ToleranceError),
    /// The legs are rods on cranks.
    Cranks,
}

impl std::fmt::Display for NoAllowance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Error(why) => why.fmt(f),
            Self::Cranks => f.write_str(
                "the legs are rods on cranks; joint tolerances exist for legs of variable length only",
            ),
        }
    }
}

/// The cost of separate joints: figures of a design and of a platform made from it, in this order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Separation {
    /// Worst conditioning over the assessed poses, both by the characteristic length of the design.
    pub conditioning: [f64; 2],
    /// Least distance of the ends of two legs, on base and platform; 0 for a shared joint.
    pub spacing: [[f64; 2]; 2],
    /// Radii of base and platform, as in [`DesignFigures`].
    pub radius: [[f64; 2]; 2],
}

/// Figures of the cranks over the poses. Poses that a rod does not reach are left out here; `assess` reports them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrankFigures {
    /// Least and greatest crank angle, degrees; `None` if no pose is reached.
    pub angles_deg: Option<[f64; 2]>,
    /// Least transmission angle, degrees.
    pub transmission_deg: Option<f64>,
    /// Greatest torque under the loads, force units times design units; infinite at a singular pose.
    pub torque: Option<f64>,
    /// Greatest crank speed at the required speed of the platform, degrees per second.
    pub speed_deg: Option<f64>,
}

/// The greatest values of all legs along all motions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionFigures {
    pub force: Option<f64>,
    pub speed: Option<f64>,
    pub power: Option<f64>,
}

impl MotionFigures {
    fn of(reports: &[MotionReport]) -> Self {
        let legs = || reports.iter().flat_map(|r| &r.legs);
        let greatest = |values: Vec<f64>| values.into_iter().map(f64::abs).reduce(f64::max);
        let drives = || legs().map(|l| l.drive).collect::<Option<Vec<_>>>().unwrap_or_default();
        // no force holds the platform at a singular pose
        let singular =
            (!drives().is_empty() && reports.iter().any(|r| r.singular.is_some())).then_some(f64::INFINITY);
        Self {
            force: singular
                .or(greatest(drives().iter().flat_map(|d| [d.push.value, d.pull.value]).collect())),
            speed: greatest(legs().map(|l| l.speed.value).collect()),
            power: greatest(drives().iter().map(|d| d.power.value).collect()),
        }
    }
}

impl Design {
    /// The cost of separate joints in a platform made from this design.
    pub fn separation(&self, separate: &Self, seed: u64) -> Separation {
        let length = self.characteristic_length();
        let both = [self, separate];
        Separation {
            conditioning: both.map(|d| d.least_conditioning(&deciding(seed), length).value),
            spacing: Body::BOTH.map(|body| both.map(|d| d.leg_spacing(body))),
            radius: Body::BOTH.map(|body| both.map(|d| d.radius(body))),
        }
    }

    /// The least distance of the ends of two legs on a body.
    fn leg_spacing(&self, body: Body) -> f64 {
        let legs = self.manipulator().legs();
        let ends = legs.map(|l| if body == Body::Base { l.base } else { l.platform });
        let pairs = (0..6).flat_map(|i| (0..i).map(move |k| (i, k)));
        pairs.map(|(i, k)| (ends[i] - ends[k]).norm()).fold(f64::INFINITY, f64::min)
    }

    /// The figures of the design.
    pub fn figures(&self, options: &FigureOptions<'_>) -> DesignFigures {
        let m = self.manipulator();
        let home = self.home_or_default();
        let space = self.workspace.space(&home);
        let mut rng = Purpose::ASSESSED_POSES.rng(options.seed);
        let region = space.cube_points(options.points, &mut rng).into_iter().map(|x| space.pose(&x));
        let poses: Vec<Pose> = space.listed(STEPS).into_iter().chain(region).collect();
        let least = |values: &dyn Fn(&Pose) -> Option<f64>| -> Option<f64> {
            poses.iter().map(values).collect::<Option<Vec<f64>>>()?.into_iter().reduce(f64::min)
        };
        let lengths = |pose: &Pose| m.legs().map(|l| (pose.transform(&l.platform) - l.base).norm());
        let all = || poses.iter().flat_map(lengths);
        let moving: Vec<MotionReport> =
            options.motions.iter().map(|motion| self.along(motion, options.masses)).collect();
        let required = self.requirements();
        let terms = Terms::new(m, &required, &home);
        // the cranks of a parsed design always make a platform
        let platform = self.rotary().ok().flatten();
        let (assessment, conditioning) =
            self.assessed_beside(options.seed, options.characteristic_length, options.until);
        let stiffness = self.hardware.leg_stiffness;
        // a singular pose has no stiffness
        let softest = |pose: &Pose| {
            least_stiffness(&stiffness_matrix(m, pose, stiffness?)).map_or(Some(0.0), |s| Some(s.linear))
        };
        let lowest = |pose: &Pose| self.lowest_frequency(pose, options.masses?);
        DesignFigures {
            assessment,
            poses: poses.len(),
            lengths: match &platform {
                None => [all().fold(f64::INFINITY, f64::min), all().fold(0.0, f64::max)],
                Some(_) => [f64::NAN; 2],
            },
            different_legs: match &platform {
                None => different(lengths(&home), SAME_LENGTH * m.size()),
                Some(platform) => different(platform.rods().get(), SAME_LENGTH * m.size()),
            },
            force: least(&|pose| self.greatest_force(pose).filter(|_| platform.is_none()).map(|f| -f))
                .map(|f| -f),
            speed: least(&|pose| self.greatest_speed(pose).filter(|_| platform.is_none()).map(|v| -v))
                .map(|v| -v),
            cranks: platform.as_ref().map(|platform| self.crank_figures(platform, &poses)),
            motion: MotionFigures::of(&moving),
            conditioning: conditioning.value,
            stiffness: least(&softest),
            frequency: least(&lowest),
            spacing: Body::BOTH.map(|body| m.nearest_joints(body).map(|n| n.0)),
            clearance: least(&|pose| terms.least_leg_gap(pose)),
            radius: Body::BOTH.map(|body| self.radius(body)),
            allowance: options.accuracy.map(|bound| {
                if platform.is_some() {
                    return Err(NoAllowance::Cranks);
                }
                let search = PoseSearch {
                    points: options.points.min(300),
                    seed: options.seed,
                    ..PoseSearch::default()
                };
                let found = joint_allowance(m, &space, Point3::origin(), bound, &search);
                found.map(|found| found.value).map_err(NoAllowance::Error)
            }),
        }
    }

    /// The figures of the cranks over these poses.
    fn crank_figures(&self, platform: &RotaryPlatform, poses: &[Pose]) -> CrankFigures {
        let reached: Vec<(&Pose, [f64; 6])> =
            poses.iter().filter_map(|pose| Some((pose, platform.ik(pose).ok()?))).collect();
        let all = || reached.iter().flat_map(|(_, angles)| angles.map(f64::to_degrees));
        let transmissions = reached.iter().flat_map(|(pose, angles)| platform.transmissions(pose, angles));
        let greatest = |values: Option<[f64; 6]>| {
            values.map_or(f64::INFINITY, |values| values.iter().fold(0.0, |a: f64, x| a.max(x.abs())))
        };
        let loads = self.all_loads();
        let torques = reached.iter().flat_map(|(pose, angles)| {
            loads
                .iter()
                .map(|load| greatest(platform.torques(pose, angles, &load.wrench(self.manipulator(), pose))))
        });
        let speeds = self.speed.map(|speed| {
            let of = |(pose, angles): &(&Pose, [f64; 6])| {
                let angular = speed.angular_deg.to_radians();
                greatest(platform.greatest_speeds(pose, angles, speed.linear, angular)).to_degrees()
            };
            reached.iter().map(of).fold(0.0, f64::max)
        });
        CrankFigures {
            angles_deg: all().reduce(f64::min).zip(all().reduce(f64::max)).map(|(least, most)| [least, most]),
            transmission_deg: transmissions.map(|g| g.abs().min(1.0).asin().to_degrees()).reduce(f64::min),
            torque: torques.reduce(f64::max),
            speed_deg: speeds,
        }
    }

    /// The greatest force of a leg under the loads; infinite at a singular pose.
    fn greatest_force(&self, pose: &Pose) -> Option<f64> {
        let m = self.manipulator();
        let each = |wrench| leg_forces(m, pose, &wrench, m.size()).map_or(f64::INFINITY, |f| f.amax());
        self.all_loads().iter().map(|load| each(load.wrench(m, pose))).reduce(f64::max)
    }

    /// The greatest speed of a leg in the worst direction of motion.
    fn greatest_speed(&self, pose: &Pose) -> Option<f64> {
        let speed = self.speed?;
        let rows = jacobian(self.manipulator(), pose, 1.0);
        let of = |i: usize| speed.fastest(1.0, rows.fixed_view::<1, 3>(i, 3).norm());
        (0..6).map(of).reduce(f64::max)
    }

    /// The lowest natural frequency at a pose, hertz; `None` without the stiffness of the legs, or if no inertia
    /// resists some rotation.
    pub fn lowest_frequency(&self, pose: &Pose, masses: &MotionMasses) -> Option<f64> {
        let m = self.manipulator();
        let stiffness = masses.per_second_squared(self.hardware.leg_stiffness?);
        let found = vibration(m, pose, stiffness, &mass_matrix(m, masses.bodies(), pose))?;
        Some(found[0].frequency)
    }

    /// The greatest distance of a joint of a body from the centroid of the joints that carry legs.
    pub fn radius(&self, body: Body) -> f64 {
        let m = self.manipulator();
        let joints: Vec<Point3<f64>> = m.used_joints(body).iter().map(|&i| m.joints(body)[i]).collect();
        let centroid = joints.iter().map(|p| p.coords).sum::<Vector3<f64>>() / joints.len() as f64;
        joints.iter().map(|p| (p.coords - centroid).norm()).fold(0.0, f64::max)
    }
}

/// The number of different values: in order of size, a value counts if it differs from all before it by more than
/// `distance`.
fn different(mut values: [f64; 6], distance: f64) -> usize {
    values.sort_by(f64::total_cmp);
    let mut kinds = 1;
    let mut first = values[0];
    for value in values {
        if value - first > distance {
            (kinds, first) = (kinds + 1, value);
        }
    }
    kinds
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_told_apart_by_their_distance() {
        assert_eq!(different([1.0; 6], 1e-6), 1);
        assert_eq!(different([1.0, 2.0, 1.0, 2.0, 1.0, 2.0 + 1e-9], 1e-6), 2);
        assert_eq!(different([6.0, 5.0, 4.0, 3.0, 2.0, 1.0], 1e-6), 6);
        assert_eq!(different([f64::NAN, 1.0, 1.0, 1.0, 1.0, 1.0], 1e-6), 1);
    }
}
