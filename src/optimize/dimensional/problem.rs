//! The problem of dimensional synthesis: variables, objectives, requirements, poses.

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use machine::requirements::{
    JointAxes, KeptSymmetry, ListedFrom, Objective, PoseSpace, Requirements, VariableKind,
};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, NotOctahedral, Octahedral};
use synthesis::components::ComponentsError;

/// Variables of base and platform: the triangles of an octahedral design, with fixed centroids and planes, or the sizes
/// of any design.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Triangles {
    /// Nothing.
    #[default]
    Fixed,
    /// One factor for each body, about the mean of its leg ends: for a triangle its centroid.
    Sizes,
    /// A symmetric stretch of the plane for each triangle: every shape and size.
    Shapes,
}

/// The quantities that the optimiser chooses.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::struct_excessive_bools, reason = "independent choices")]
pub struct Variables {
    /// The six offsets of an octahedral design.
    pub offsets: bool,
    /// The triangles of an octahedral design, or the sizes of base and platform of any other.
    pub triangles: Triangles,
    /// The legs on their rational families of replaceable legs; not with offsets or triangles.
    pub components: bool,
    /// Height of home, and of all poses around it, over the base.
    pub home_height: bool,
    /// Axes of the base and of the platform joints, the reference of the joint angles.
    pub joint_axes: [bool; 2],
    /// One offset for the three edges of the base and one for those of the platform.
    pub symmetric: bool,
    /// The kept symmetry of the whole platform at home. With [`KeptSymmetry::ThreeFold`] offsets are as with
    /// `symmetric`, and triangles only change in size.
    pub symmetry: KeptSymmetry,
    /// Legs with fixed ends on the base and on the platform. A body with such an end keeps its triangle and its size,
    /// and such legs do not slide on families that move the end. Offsets add joints beside those of the design, which
    /// stay.
    pub fixed_ends: [[bool; 6]; 2],
    /// Least and greatest offset of each side, cyclic order.
    pub offset_bounds: [(f64, f64); 6],
    /// Least and greatest parameter of a family.
    pub parameter_bounds: (f64, f64),
    /// Least and greatest diagonal entry of the stretch minus 1; the other entry is at most half of the width.
    pub stretch_bounds: (f64, f64),
    /// Least and greatest change of the height, in sizes of the design.
    pub height_bounds: (f64, f64),
}

impl Default for Variables {
    /// No variables; bounds -1 to 2 of offsets and parameters, -0.5 to 1 of stretches, -0.5 to 1 of the height.
    fn default() -> Self {
        Self {
            offsets: false,
            triangles: Triangles::Fixed,
            components: false,
            parameter_bounds: (-1.0, 2.0),
            home_height: false,
            joint_axes: [false; 2],
            symmetric: false,
            symmetry: KeptSymmetry::None,
            fixed_ends: [[false; 6]; 2],
            offset_bounds: [(-1.0, 2.0); 6],
            stretch_bounds: (-0.5, 1.0),
            height_bounds: (-0.5, 1.0),
        }
    }
}

impl Variables {
    /// Whether the triangle or the size of a body is kept.
    #[must_use]
    pub fn keeps_body(&self, body: Body) -> bool {
        self.fixed_ends[body.index()].contains(&true)
    }

    /// These kinds within the default bounds.
    #[must_use]
    pub fn of(kinds: &[VariableKind]) -> Self {
        let has = |kind| kinds.contains(&kind);
        let triangles = match (has(VariableKind::Triangles), has(VariableKind::TriangleSizes)) {
            (true, _) => Triangles::Shapes,
            (false, true) => Triangles::Sizes,
            (false, false) => Triangles::Fixed,
        };
        Self {
            offsets: has(VariableKind::Offsets) || has(VariableKind::SymmetricOffsets),
            symmetric: has(VariableKind::SymmetricOffsets),
            triangles,
            components: has(VariableKind::Components),
            home_height: has(VariableKind::HomeHeight),
            joint_axes: [has(VariableKind::JointAxes); 2],
            ..Self::default()
        }
    }
}

/// The combination of several objectives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Mode {
    /// The weighted sum of the values, each over its value at the start of the run.
    Weighted,
    /// One after the other; each later level may give up this share of the earlier values.
    Lexicographic {
        /// Share, for instance 0.01.
        slack: f64,
    },
}

/// The problem: the platform that meets the requirements and has the best objectives.
#[derive(Debug, Clone, PartialEq)]
pub struct DimensionalProblem {
    /// The initial design of the variables.
    pub manipulator: Manipulator,
    /// The requirements of the platform.
    pub requirements: Requirements,
    /// The poses of the requirements.
    pub space: PoseSpace,
    /// The variables.
    pub variables: Variables,
    /// Objectives with weights, or in the order of their levels.
    pub objectives: Vec<(Objective, f64)>,
    /// Their combination.
    pub mode: Mode,
    /// `L`, design units.
    pub characteristic_length: f64,
    /// Least `|det A|` of the offsets.
    pub min_abs_det: f64,
}

/// Reasons why a problem is invalid.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidProblem {
    /// There are no variables.
    #[error("no variable is left to be chosen")]
    NoVariables,
    /// No objective.
    #[error("no objective is given")]
    NoObjective,
    /// Offsets or triangles of a design that is not octahedral.
    #[error("offsets and triangles are variables of octahedral designs: {0}")]
    NotOctahedral(NotOctahedral),
    /// The families of replaceable legs could not be computed.
    #[error("the families of replaceable legs could not be computed: {0}")]
    Components(#[from] ComponentsError),
    /// No leg belongs to a rational family.
    #[error("no leg of the design belongs to a rational family of replaceable legs")]
    NoFamily,
    /// The leg vectors are dependent, so there is no leg map to keep.
    #[error("the legs of the design are dependent: it is architecturally singular")]
    DependentLegs,
    /// Offsets or triangles together with components.
    #[error("components cannot be chosen together with offsets or triangles")]
    ComponentsAndOffsets,
    /// A front of one objective, or of more than three.
    #[error("a Pareto front has two or three objectives, not {0}")]
    FrontOf(usize),
    /// An objective without the data it needs.
    #[error("the objective {} needs {needs}", objective.code())]
    Needs {
        /// The objective.
        objective: Objective,
        /// The key of the design file.
        needs: &'static str,
    },
    /// A weight, length or bound that is not positive and finite.
    #[error("{quantity} is {value}; it must be positive and finite")]
    NotPositive {
        /// Its name.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Bounds without any value.
    #[error(
        "the bounds of {variable} are {low} and {high}; both have to be finite, and the first no larger than the second"
    )]
    Bounds {
        /// Name of the variable.
        variable: String,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
    /// Axes can be chosen only for limits of joint angles below 90 degrees.
    #[error("joint axes can be chosen for cone angles below 90 degrees only, and this limit is {0} degrees")]
    ConeTooWide(f64),
    /// Axes of universal joints cannot be chosen.
    #[error(
        "the axes of universal joints are not chosen: joint_axes is for ball joints, and the {0} has universal ones"
    )]
    UniversalAxes(Body),
    /// The design lacks the symmetry to be kept.
    #[error("symmetry = \"three_fold\" needs a design that has it, and {why}")]
    NotThreeFold {
        /// The missing symmetry.
        why: &'static str,
    },
    /// No platform can have the requested properties.
    #[error(
        "a platform on the six edges without shared joints that has a mirror plane is architecturally singular: its offsets are 1/2, or in \
         pairs t and 1 - t, so that det A = prod (1 - t) - prod t = 0"
    )]
    MirrorIsSingular,
    /// A mirror plane without offsets as variables.
    #[error("a mirror plane is not kept by a search that chooses no offsets")]
    MirrorWithoutOffsets,
    /// A symmetry of designs that are not octahedral.
    #[error("symmetry is kept in searches from octahedral designs only")]
    SymmetryOfGeneral,
    /// A leg has no length at home.
    #[error("a leg has no length at home")]
    NoLegAtHome,
}

impl DimensionalProblem {
    /// Checks that the problem is complete and its numbers are valid.
    ///
    /// # Errors
    /// The first violation.
    pub fn validate(&self) -> Result<(), InvalidProblem> {
        if self.objectives.is_empty() {
            return Err(InvalidProblem::NoObjective);
        }
        let hardware = &self.requirements.hardware;
        for &(objective, weight) in &self.objectives {
            let needs = match objective {
                Objective::LegForce if self.requirements.loads.is_empty() => "[[loads]]",
                Objective::LegClearance if hardware.leg_body.is_none() => "leg_diameter in [hardware]",
                Objective::Stiffness | Objective::NaturalFrequency if hardware.leg_stiffness.is_none() => {
                    "leg_stiffness in [hardware]"
                }
                Objective::NaturalFrequency if self.requirements.vibrating.is_none() => {
                    "[payload] and a unit of length that is known"
                }
                _ => "",
            };
            if !needs.is_empty() {
                return Err(InvalidProblem::Needs { objective, needs });
            }
            positive("a weight", weight)?;
        }
        positive("characteristic_length", self.characteristic_length)?;
        positive("min_abs_det", self.min_abs_det)?;
        if let Mode::Lexicographic { slack } = self.mode {
            positive("the slack of the levels", slack)?;
        }
        for (cone_angle, wanted) in
            [hardware.base_cone_angle, hardware.platform_cone_angle].iter().zip(self.axes_wanted())
        {
            if let (Some(cone_angle), true) = (cone_angle, wanted)
                && cone_angle.least_deg() >= 90.0
            {
                return Err(InvalidProblem::ConeTooWide(cone_angle.least_deg()));
            }
        }
        for body in Body::BOTH {
            if hardware.universal(body).is_some() && self.axes_wanted()[body.index()] {
                return Err(InvalidProblem::UniversalAxes(body));
            }
        }
        self.validate_symmetry()?;
        let home = &self.space.home;
        if self.manipulator.legs().iter().any(|l| !(home.squared_length(l) > 0.0)) {
            return Err(InvalidProblem::NoLegAtHome);
        }
        Ok(())
    }

    /// Whether the design has the symmetry to be kept, within a billionth of its size.
    fn validate_symmetry(&self) -> Result<(), InvalidProblem> {
        match self.variables.symmetry {
            KeptSymmetry::None => return Ok(()),
            KeptSymmetry::Mirror if self.variables.offsets => return Err(InvalidProblem::MirrorIsSingular),
            KeptSymmetry::Mirror => return Err(InvalidProblem::MirrorWithoutOffsets),
            KeptSymmetry::ThreeFold => {}
        }
        let octahedral =
            Octahedral::recognise(&self.manipulator).map_err(|_| InvalidProblem::SymmetryOfGeneral)?;
        let [base, platform] = [octahedral.base(), octahedral.platform()];
        let near = SYMMETRIC * self.manipulator.size();
        let sides = |t: &[Point3<f64>; 3]| [0, 1, 2].map(|k| (t[(k + 1) % 3] - t[k]).norm());
        let is_equilateral = |t: &[Point3<f64>; 3]| {
            let s = sides(t);
            (s[0] - s[1]).abs() <= near && (s[1] - s[2]).abs() <= near
        };
        if !is_equilateral(&base) || !is_equilateral(&platform) {
            return Err(InvalidProblem::NotThreeFold { why: "a triangle is not equilateral" });
        }
        let platform = platform.map(|p| self.space.home.transform(&p));
        let centre = |t: &[Point3<f64>; 3]| t.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 3.0;
        let normal = |t: &[Point3<f64>; 3]| (t[1] - t[0]).cross(&(t[2] - t[0])).normalize();
        let (axis, between) = (normal(&base), centre(&platform) - centre(&base));
        let aside = between - axis * axis.dot(&between);
        let tilt = axis.cross(&normal(&platform)).norm() * self.manipulator.size();
        if aside.norm() > near || tilt > near {
            return Err(InvalidProblem::NotThreeFold { why: "at home the triangles have no common axis" });
        }
        Ok(())
    }

    /// Whether the axes of base and platform joints are chosen: requested, and with limits.
    pub(crate) fn axes_wanted(&self) -> [bool; 2] {
        let h = &self.requirements.hardware;
        let wanted = |k: usize, cone_angle: Option<machine::requirements::ConeLimits>| {
            cone_angle.is_some_and(|s| s.axes == JointAxes::Optimize || self.variables.joint_axes[k])
        };
        [wanted(0, h.base_cone_angle), wanted(1, h.platform_cone_angle)]
    }

    /// The single poses and those along trajectory and ranges, and whether each moves with home.
    pub fn listed(&self) -> Vec<(Pose, bool)> {
        let space = &self.space;
        let stated = space.poses.iter().copied().chain(space.along_trajectory(STEPS));
        let stated = stated.map(|pose| (pose, space.listed_from == ListedFrom::Home));
        stated.chain(space.along_ranges(STEPS).into_iter().map(|pose| (pose, true))).collect()
    }
}

/// Steps between two poses of a trajectory, and from home to each end of a range.
const STEPS: usize = 4;

/// Tolerance of a symmetry, in sizes of the design.
const SYMMETRIC: f64 = 1e-9;

fn positive(quantity: &'static str, value: f64) -> Result<(), InvalidProblem> {
    if value > 0.0 && value.is_finite() {
        Ok(())
    } else {
        Err(InvalidProblem::NotPositive { quantity, value })
    }
}
