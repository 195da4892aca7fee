//! From variables to joints: leg ends by the skeleton of the design, the height of home, joint axes.

use std::sync::Arc;

use nalgebra::{Matrix3, Point3, Vector3};

use super::problem::{InvalidProblem, Triangles, Variables};
use super::pull::Rate;
use super::skeleton::{Fixed, OctahedralSides, OnFamilies, ReachLeft, ScaledBodies, Skeleton};
use num::small::symmetric_eigen3;
use platform::geom::Pose;
use platform::manipulator::{Body, InvalidManipulator, Manipulator, Octahedral};

/// Number of variables of the joint axes of one body: three components for each leg.
const AXIS_VARIABLES: usize = 18;

/// A joint of one body by its origin; joints of the design sort before those of legs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum JointId {
    /// A joint of the design, with the legs that share it there.
    OfDesign(usize),
    /// The end of a leg that leaves its joint and has a separate one.
    OfLeg(usize),
}

/// The joint of each leg on the base and on the platform.
pub(crate) type LegJoints = [(JointId, JointId); 6];

/// The joints of a design without changes.
pub(super) fn joints_of(m: &Manipulator) -> LegJoints {
    m.pairs().map(|(base, platform)| (JointId::OfDesign(base), JointId::OfDesign(platform)))
}

/// The variables in their order.
#[derive(Debug, Clone, Default)]
pub(crate) struct VariableLayout {
    names: Vec<String>,
    bounds: Vec<(f64, f64)>,
    start: Vec<f64>,
}

impl VariableLayout {
    /// Index of the next variable.
    pub(super) fn next(&self) -> usize {
        self.start.len()
    }

    /// Adds a variable and returns its index.
    pub(super) fn add(&mut self, name: String, bounds: (f64, f64), start: f64) -> usize {
        self.names.push(name);
        self.bounds.push(bounds);
        self.start.push(start);
        self.start.len() - 1
    }
}

/// The joints as functions of the variables.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    skeleton: Arc<dyn Skeleton>,
    /// Names of the variables, for reports.
    pub names: Vec<String>,
    pub bounds: Vec<(f64, f64)>,
    pub start: Vec<f64>,
    /// Variable of the height, and the displacement of home for its unit.
    lift: Option<(usize, Vector3<f64>)>,
    /// First variable of the axes of base and platform joints.
    pub axes: [Option<usize>; 2],
    /// Joints of the legs.
    pub joints: LegJoints,
    original: Manipulator,
}

/// Joints at the variables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct JointEnds {
    pub base: [Vector3<f64>; 6],
    /// Platform frame.
    pub platform: [Vector3<f64>; 6],
    pub lift: Vector3<f64>,
}

/// Unit normal of the plane of best fit of the base joints, towards the platform at home.
fn upwards(m: &Manipulator, home: &Pose) -> Vector3<f64> {
    let legs = m.legs();
    let [centre, _] = m.mean_leg_ends();
    let moments =
        legs.iter().map(|l| l.base.coords - centre).map(|v| v * v.transpose()).sum::<Matrix3<f64>>();
    let (values, vectors) = symmetric_eigen3(&moments);
    let n: Vector3<f64> = vectors.column(values.imin()).into();
    let tip = legs.iter().map(|l| home.transform(&l.platform).coords).sum::<Vector3<f64>>() / 6.0;
    if n.dot(&(tip - centre)) < 0.0 { -n } else { n }
}

/// The skeleton for the variables.
fn skeleton(
    m: &Manipulator,
    v: &Variables,
    layout: &mut VariableLayout,
) -> Result<Arc<dyn Skeleton>, InvalidProblem> {
    if (v.offsets, v.components, v.triangles) == (false, false, Triangles::Sizes)
        && Octahedral::recognise(m).is_err()
    {
        return Ok(Arc::new(ScaledBodies::of(m, v, layout)));
    }
    let octahedral = v.offsets || v.triangles != Triangles::Fixed;
    Ok(match (octahedral, v.components) {
        (false, false) => Arc::new(Fixed::of(m)),
        (true, false) => Arc::new(OctahedralSides::of(m, v, layout)?),
        (false, true) => Arc::new(OnFamilies::of(m, v, layout)?),
        (true, true) => {
            // report faults of the design itself first
            OctahedralSides::of(m, v, layout)?;
            return Err(InvalidProblem::ComponentsAndOffsets);
        }
    })
}

impl Shape {
    /// Lays out the variables.
    pub(super) fn new(m: &Manipulator, home: &Pose, v: &Variables) -> Result<Self, InvalidProblem> {
        let mut layout = VariableLayout::default();
        let skeleton = skeleton(m, v, &mut layout)?;
        let lift = v.home_height.then(|| {
            let k = layout.add("home height".into(), v.height_bounds, 0.0);
            (k, upwards(m, home) * m.size())
        });
        let mut axes = [None; 2];
        for body in (0..2).filter(|b| v.joint_axes[*b]) {
            axes[body] = Some(layout.next());
            for leg in m.legs() {
                let line = home.transform(&leg.platform) - leg.base;
                let line = if body == 0 { line } else { home.rotation.inverse() * line };
                let body = ["base", "platform"][body];
                for (k, c) in line.normalize().iter().enumerate() {
                    layout.add(format!("{body} axis {}", ["x", "y", "z"][k]), (-1.0, 1.0), *c);
                }
            }
        }
        let VariableLayout { names, bounds, start } = layout;
        if start.is_empty() {
            return Err(InvalidProblem::NoVariables);
        }
        let joints = skeleton.joints(m);
        Ok(Self { skeleton, names, bounds, start, lift, axes, joints, original: m.clone() })
    }

    /// `det A` of the leg map from the design and its gradient, if the variables keep the class of the design.
    pub(super) fn determinant(&self, x: &[f64]) -> Option<(f64, Vec<f64>)> {
        self.skeleton.determinant(x)
    }

    /// Remaining distances of the ends of sliding legs from their limit.
    pub(super) fn rooms(&self, ends: &JointEnds) -> Vec<ReachLeft> {
        self.skeleton.rooms(&ends.base, &ends.platform)
    }

    /// `true` if the lines of all legs are affine functions of the variables (axes excluded).
    pub(crate) fn is_affine(&self) -> bool {
        self.skeleton.is_affine()
    }

    /// Offsets of the octahedral hexagon in cyclic order, if they are variables.
    pub(super) fn offsets(&self, x: &[f64]) -> Option<[f64; 6]> {
        self.offset_variables().map(|at| at.map(|k| x[k]))
    }

    /// Whether a variable is a component of a joint axis.
    fn is_axis(&self, j: usize) -> bool {
        self.axes.iter().flatten().any(|first| (*first..first + AXIS_VARIABLES).contains(&j))
    }

    /// The variables that are not components of a joint axis.
    pub(super) fn free(&self) -> Vec<usize> {
        (0..self.start.len()).filter(|j| !self.is_axis(*j)).collect()
    }

    pub(crate) fn offset_variables(&self) -> Option<[usize; 6]> {
        self.skeleton.offset_variables()
    }

    pub(super) fn ends(&self, x: &[f64]) -> JointEnds {
        let lift = self.lift.map_or_else(Vector3::zeros, |(k, v)| v * x[k]);
        let [base, platform] = self.skeleton.ends(x);
        JointEnds { base, platform, lift }
    }

    /// Velocities for each variable.
    pub(super) fn rates(&self, x: &[f64]) -> Vec<Rate> {
        let mut out = self.skeleton.rates(x);
        if let Some((k, v)) = self.lift {
            out[k].lift = v;
        }
        for (body, first) in self.axes.into_iter().enumerate().filter_map(|(b, first)| Some((b, first?))) {
            for j in 0..AXIS_VARIABLES {
                out[first + j].axis = Some((body, j / 3, j % 3));
            }
        }
        out
    }

    /// Joints of a body without legs, which stay in the result.
    pub(crate) fn joints_without_legs(&self, body: Body) -> Vec<Vector3<f64>> {
        if self.joints != joints_of(&self.original) {
            return Vec::new();
        }
        let used = self.original.pairs().map(|p| body.of(p));
        let all = self.original.joints(body).iter().enumerate();
        all.filter(|(k, _)| !used.contains(k)).map(|(_, p)| p.coords).collect()
    }

    /// The platform at the variables: legs of the design in their order; shared joints stay shared unless offsets split
    /// them.
    pub(super) fn manipulator(&self, x: &[f64]) -> Result<Manipulator, InvalidManipulator> {
        let ends = self.ends(x);
        let kept = self.joints == joints_of(&self.original);
        let (legs, mut base, mut platform) = if kept {
            let m = &self.original;
            (m.pairs(), m.base_joints().to_vec(), m.platform_joints().to_vec())
        } else {
            let (base, base_count) = numbered(self.joints.map(|p| p.0));
            let (platform, platform_count) = numbered(self.joints.map(|p| p.1));
            let legs = std::array::from_fn(|i| (base[i], platform[i]));
            (legs, vec![Point3::origin(); base_count], vec![Point3::origin(); platform_count])
        };
        for (i, (a, b)) in legs.into_iter().enumerate() {
            (base[a], platform[b]) = (ends.base[i].into(), ends.platform[i].into());
        }
        Manipulator::try_new(base, platform, legs)
    }
}

/// The number of the joint of each leg on a body, counted from 0 in their order, and the number of joints.
fn numbered(joints: [JointId; 6]) -> ([usize; 6], usize) {
    let mut all = joints.to_vec();
    all.sort_unstable();
    all.dedup();
    (joints.map(|j| all.binary_search(&j).unwrap_or(0)), all.len())
}
