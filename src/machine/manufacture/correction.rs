//! The controller's computation: the pose by the octahedral formula, then Newton steps on the calibrated joints.

use nalgebra::Point3;
use thiserror::Error;

use super::uncertainty::{MachineUncertainty, PoseCovariance};
use fk::{FkError, NearSolver, OcticSolver};
use num::linalg::LinalgError;
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{InvalidManipulator, Manipulator, Octahedral, SquaredLegLengths};
use synthesis::singularity::GriffisDuffy;
use synthesis::{AffineLegMap, LegMapTolerances, Relation, SingularMap, leg_map};

/// Imaginary parts of a real pose of the octic are below this, relative.
const REAL: f64 = 1e-7;

/// Reasons why a design has no octahedral formula.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoFormula {
    /// The octahedral platform is not octahedral.
    #[error(transparent)]
    NotOctahedral(#[from] FkError),
    /// The design is not equivalent to the octahedral platform.
    #[error("the design is not equivalent to the octahedral platform (relation: {})", .0.name())]
    NotEquivalent(Relation),
    /// The leg map could not be computed.
    #[error(transparent)]
    LegMap(#[from] LinalgError),
    /// The leg map has no inverse.
    #[error(transparent)]
    Singular(#[from] SingularMap),
}

/// The octahedral platform that a platform without shared joints is equivalent to: its two triangles with the legs
/// `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6`.
///
/// # Errors
/// When a triangle is degenerate.
pub fn octahedral_of(m: &Manipulator, found: &GriffisDuffy) -> Result<Manipulator, InvalidManipulator> {
    let legs = m.legs();
    let [p1, p2, p3] = [5, 1, 3].map(|k| legs[found.order[k]].base);
    let [p4, p5, p6] = [0, 2, 4].map(|k| legs[found.order[k]].platform);
    let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    Manipulator::try_new(vec![p1, p2, p3], vec![p4, p5, p6], pairs)
}

/// The octahedral platform equivalent to a design that is octahedral itself or has one joint on each side of two
/// triangles.
#[must_use]
pub fn equivalent_octahedral(m: &Manipulator) -> Option<Manipulator> {
    let merged = Manipulator::from_legs(m.legs()).ok()?;
    if Octahedral::recognise(&merged).is_ok() {
        return Some(merged);
    }
    let found = GriffisDuffy::recognise(m)?;
    if found.is_nearly_singular() {
        return None;
    }
    octahedral_of(m, &found).ok()
}

/// Forward kinematics of a machine that is nominally equivalent to an octahedral platform. It is made once; its methods
/// allocate no memory.
///
/// ```text
/// s_o = A^-1 (s - c),   pose = octic(s_o), the real pose nearest to the last one;   then Newton's method on |R b + p - a|^2 = s.
/// ```
///
/// `s` are the squared lengths that the machine measures, `A` and `c` the leg map of the nominal design, `a` and `b`
/// the calibrated joints. The first pose has the first-order error of [`Sensitivity`](super::Sensitivity); each step of
/// Newton's method squares it.
#[derive(Debug, Clone)]
pub struct Controller {
    to_octahedral: AffineLegMap,
    octic: OcticSolver,
    follow: NearSolver,
    calibrated: NearSolver,
    machine: Manipulator,
    size: f64,
}

impl Controller {
    /// Prepares the controller. The calibrated joints are in the leg order and the frames of the nominal design, which
    /// is equivalent to the octahedral platform.
    ///
    /// # Errors
    /// [`NoFormula`].
    pub fn new(
        octahedral: &Manipulator,
        nominal: &Manipulator,
        calibrated: &Manipulator,
    ) -> Result<Self, NoFormula> {
        let octic = OcticSolver::new(octahedral)?;
        let map = leg_map(octahedral, nominal, LegMapTolerances::default())?;
        let Some(forward) = map.map().filter(|_| map.is_regular_within_rounding()) else {
            return Err(NoFormula::NotEquivalent(map.relation));
        };
        Ok(Self {
            to_octahedral: forward.invert()?,
            octic,
            follow: NearSolver::new(octahedral),
            calibrated: NearSolver::new(calibrated),
            machine: calibrated.clone(),
            size: octahedral.size(),
        })
    }

    /// The pose by the octahedral formula: the real pose nearest to `last`. Lengths at which the octic is degenerate (a
    /// symmetric home pose is) are solved from `last` by [`NearSolver`]. `None` when no real pose has these lengths.
    #[must_use]
    pub fn formula(&self, s: &SquaredLegLengths, last: &Pose) -> Option<Pose> {
        let squares = self.to_octahedral.apply(s).ok()?;
        let Some(found) = self.octic.solve(&squares) else {
            return self.follow.solve(&squares, last).tracked().copied();
        };
        let start = ComplexPose::from(*last);
        let real = found.poses.iter().filter(|p| p.imaginary_size(self.size) < REAL);
        let near = real.map(|p| (p.distance(&start, self.size), p));
        near.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, p)| p.real_part())
    }

    /// `steps` Newton steps from `pose` on the leg equations of the calibrated joints; `None` at a singular pose.
    #[must_use]
    pub fn corrected(&self, s: &SquaredLegLengths, pose: &Pose, steps: u32) -> Option<Pose> {
        self.calibrated.newton_steps(s, pose, steps)
    }

    /// The covariance of a [corrected](Self::corrected) pose from the uncertainty of the calibrated joints and offsets,
    /// to first order. The noise of the lengths is not included. `None` at a singular pose and for an uncertainty of
    /// another machine.
    #[must_use]
    pub fn covariance(
        &self,
        known: &MachineUncertainty,
        pose: &Pose,
        tool: &Point3<f64>,
    ) -> Option<PoseCovariance> {
        known.pose_covariance(&self.machine, pose, tool)
    }
}
