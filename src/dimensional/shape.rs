//! From variables to joints: offsets, triangles, height of the home pose, joint axes, parameters of families.

use nalgebra::{Point3, Vector3};

use super::families::Families;
use super::problem::{InvalidProblem, Triangles, Variables};
use super::pull::Rate;
use super::triangle::Triangle;
use crate::geom::Pose;
use crate::manipulator::{InvalidManipulator, Leg, Manipulator, Octahedral};
use crate::num::small::symmetric_eigen3;

/// Where the joints come from.
#[derive(Debug, Clone)]
enum Skeleton {
    /// Joints as they are.
    Fixed([Leg; 6]),
    /// Offsets on the sides of an octahedral hexagon.
    Octahedral {
        order: [usize; 6],
        triangles: Box<[Triangle; 2]>,
        /// Variable of each offset.
        offsets: Option<[usize; 6]>,
    },
    /// Legs on families, with the first variable of each.
    Families(Box<Families>, Vec<usize>),
}

/// The joints as functions of the variables.
#[derive(Debug, Clone)]
pub(crate) struct Shape {
    skeleton: Skeleton,
    /// Names of the variables, for reports.
    pub(crate) names: Vec<String>,
    pub(crate) bounds: Vec<(f64, f64)>,
    pub(crate) start: Vec<f64>,
    /// Variable of the height, and the vector by which home moves for its unit.
    lift: Option<(usize, Vector3<f64>)>,
    /// First variable of the axes of base and platform joints.
    pub(crate) axes: [Option<usize>; 2],
    /// Joints of the legs: equal numbers are one joint.
    pub(crate) joints: [(usize, usize); 6],
    original: Manipulator,
}

/// Joints at the variables.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Ends {
    pub(crate) base: [Vector3<f64>; 6],
    /// Platform frame.
    pub(crate) platform: [Vector3<f64>; 6],
    pub(crate) lift: Vector3<f64>,
}

/// Unit normal of the plane that fits the base joints best, towards the platform at home.
fn upwards(m: &Manipulator, home: &Pose) -> Vector3<f64> {
    let legs = m.legs();
    let centre = legs.iter().map(|l| l.base.coords).sum::<Vector3<f64>>() / 6.0;
    let moments = legs
        .iter()
        .map(|l| l.base.coords - centre)
        .map(|v| v * v.transpose())
        .sum::<nalgebra::Matrix3<f64>>();
    let (values, vectors) = symmetric_eigen3(&moments);
    let n: Vector3<f64> = vectors.column(values.imin()).into();
    let tip = legs.iter().map(|l| home.transform(&l.platform).coords).sum::<Vector3<f64>>() / 6.0;
    if n.dot(&(tip - centre)) < 0.0 { -n } else { n }
}

impl Shape {
    /// Lays out the variables.
    pub(crate) fn new(m: &Manipulator, home: &Pose, v: &Variables) -> Result<Self, InvalidProblem> {
        let mut shape = Self {
            skeleton: Skeleton::Fixed(m.legs()),
            names: Vec::new(),
            bounds: Vec::new(),
            start: Vec::new(),
            lift: None,
            axes: [None; 2],
            joints: m.pairs(),
            original: m.clone(),
        };
        if v.offsets || v.triangles != Triangles::Fixed {
            shape.octahedral(m, v)?;
        }
        if v.components {
            shape.families(m, v)?;
        }
        if v.home_height {
            let k = shape.variable("home height".into(), v.height_bounds, 0.0);
            shape.lift = Some((k, upwards(m, home) * m.size()));
        }
        for body in (0..2).filter(|b| v.joint_axes[*b]) {
            shape.axes[body] = Some(shape.start.len());
            for leg in m.legs() {
                let line = home.transform(&leg.platform) - leg.base;
                let line = if body == 0 { line } else { home.rotation.inverse() * line };
                for (k, c) in line.normalize().iter().enumerate() {
                    let body = ["base", "platform"][body];
                    shape.variable(format!("{body} axis {}", ["x", "y", "z"][k]), (-1.0, 1.0), *c);
                }
            }
        }
        if shape.start.is_empty() {
            return Err(InvalidProblem::NoVariables);
        }
        Ok(shape)
    }

    fn variable(&mut self, name: String, bounds: (f64, f64), start: f64) -> usize {
        self.names.push(name);
        self.bounds.push(bounds);
        self.start.push(start);
        self.start.len() - 1
    }

    fn octahedral(&mut self, m: &Manipulator, v: &Variables) -> Result<(), InvalidProblem> {
        let o = Octahedral::recognise(m).map_err(InvalidProblem::NotOctahedral)?;
        let mut offsets = None;
        if v.offsets {
            let mut at = [0; 6];
            for i in 0..6 {
                at[i] = if v.symmetric && i > 1 {
                    at[i % 2]
                } else {
                    self.variable(format!("t{}", i + 1), v.offset_bounds[i], 0.0)
                };
            }
            offsets = Some(at);
            self.joints = std::array::from_fn(|i| (i, i));
        }
        let mut triangle = |vertices, body: &str| {
            let first = self.start.len();
            let (diagonal, shear) = (v.stretch_bounds, 0.5 * (v.stretch_bounds.1 - v.stretch_bounds.0));
            match v.triangles {
                Triangles::Fixed => return Triangle::new(vertices, v.triangles, None),
                Triangles::Sizes => {
                    self.variable(format!("{body} size"), diagonal, 0.0);
                }
                Triangles::Shapes => {
                    self.variable(format!("{body} stretch xx"), diagonal, 0.0);
                    self.variable(format!("{body} stretch xy"), (-shear, shear), 0.0);
                    self.variable(format!("{body} stretch yy"), diagonal, 0.0);
                }
            }
            Triangle::new(vertices, v.triangles, Some(first))
        };
        let triangles = Box::new([triangle(o.base(), "base"), triangle(o.platform(), "platform")]);
        let order = o.order().map(crate::manipulator::LegIndex::get);
        self.skeleton = Skeleton::Octahedral { order, triangles, offsets };
        Ok(())
    }

    /// Lays out the parameters of the families; joints that slide are joints of their own.
    fn families(&mut self, m: &Manipulator, v: &Variables) -> Result<(), InvalidProblem> {
        if v.offsets || v.triangles != Triangles::Fixed {
            return Err(InvalidProblem::ComponentsAndOffsets);
        }
        let families = Families::of(m)?;
        let mut firsts = Vec::new();
        for s in &families.sliding {
            firsts.push(self.start.len());
            for k in 0..s.parameters {
                let name = format!("leg {} parameter {}", s.leg + 1, k + 1);
                let middle = f64::midpoint(v.parameter_bounds.0, v.parameter_bounds.1);
                self.variable(name, v.parameter_bounds, middle);
            }
            let (ends, size) = (Families::ends(s, &vec![0.0; s.parameters]), m.size());
            let stays = |platform: bool, joints: &[Point3<f64>]| {
                let end = Point3::from(ends[usize::from(platform)].0);
                let same = |p: &Point3<f64>| (p - end).norm() <= 1e-9 * size;
                Families::is_fixed(s, platform).then(|| joints.iter().position(same)).flatten()
            };
            // numbers beyond those of the design stand for new joints
            self.joints[s.leg] = (
                stays(false, m.base_joints()).unwrap_or(m.base_joints().len() + s.leg),
                stays(true, m.platform_joints()).unwrap_or(m.platform_joints().len() + s.leg),
            );
        }
        self.skeleton = Skeleton::Families(Box::new(families), firsts);
        Ok(())
    }

    /// `det A` of the leg map from the design and its gradient, where the variables keep the class of the design.
    pub(crate) fn determinant(&self, x: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut gradient = vec![0.0; x.len()];
        match &self.skeleton {
            Skeleton::Fixed(_) => None,
            Skeleton::Octahedral { offsets, .. } => {
                let at = (*offsets)?;
                let t = at.map(|k| x[k]);
                for j in 0..6 {
                    let others = || (0..6).filter(move |i| *i != j);
                    gradient[at[j]] -= others().map(|i| 1.0 - t[i]).product::<f64>()
                        + others().map(|i| t[i]).product::<f64>();
                }
                let det = t.iter().map(|x| 1.0 - x).product::<f64>() - t.iter().product::<f64>();
                Some((det, gradient))
            }
            Skeleton::Families(families, _) => {
                let ends = self.ends(x);
                let (det, on_base, on_platform) = families.determinant(&ends.base, &ends.platform);
                for (g, rate) in gradient.iter_mut().zip(self.rates(x)) {
                    *g = rate.ends.iter().map(|(i, a, b)| on_base[*i].dot(a) + on_platform[*i].dot(b)).sum();
                }
                Some((det, gradient))
            }
        }
    }

    /// How far the ends of sliding legs may still go out, with gradients by the end: leg, platform or not.
    pub(crate) fn rooms(&self, ends: &Ends) -> Vec<(usize, bool, f64, Vector3<f64>)> {
        let Skeleton::Families(families, _) = &self.skeleton else { return Vec::new() };
        let mut out = Vec::new();
        for s in &families.sliding {
            for (platform, list) in [(false, &ends.base), (true, &ends.platform)] {
                if !Families::is_fixed(s, platform) {
                    let (value, g) = families.room(platform, &list[s.leg]);
                    out.push((s.leg, platform, value, g));
                }
            }
        }
        out
    }

    /// `true` when the lines of all legs are affine functions of the variables (axes apart).
    pub(crate) fn is_affine(&self) -> bool {
        match &self.skeleton {
            Skeleton::Fixed(_) => true,
            Skeleton::Octahedral { triangles, offsets, .. } => {
                offsets.is_none() || triangles.iter().all(|t| t.first.is_none())
            }
            Skeleton::Families(..) => false,
        }
    }

    /// Offsets of the octahedral hexagon in cyclic order, when they are variables.
    pub(crate) fn offsets(&self, x: &[f64]) -> Option<[f64; 6]> {
        self.offset_variables().map(|at| at.map(|k| x[k]))
    }

    /// Whether a variable is a component of a joint axis.
    fn is_axis(&self, j: usize) -> bool {
        self.axes.iter().flatten().any(|first| (*first..first + 18).contains(&j))
    }

    /// The variables that are no component of a joint axis.
    pub(crate) fn free(&self) -> Vec<usize> {
        (0..self.start.len()).filter(|j| !self.is_axis(*j)).collect()
    }

    pub(crate) fn offset_variables(&self) -> Option<[usize; 6]> {
        match &self.skeleton {
            Skeleton::Octahedral { offsets, .. } => *offsets,
            _ => None,
        }
    }

    pub(crate) fn ends(&self, x: &[f64]) -> Ends {
        let lift = self.lift.map_or_else(Vector3::zeros, |(k, v)| v * x[k]);
        let mut out = Ends { base: [Vector3::zeros(); 6], platform: [Vector3::zeros(); 6], lift };
        match &self.skeleton {
            Skeleton::Fixed(legs) => {
                (out.base, out.platform) = (legs.map(|l| l.base.coords), legs.map(|l| l.platform.coords));
            }
            Skeleton::Octahedral { order, triangles, offsets } => {
                let (base, platform) = (triangles[0].vertices(x), triangles[1].vertices(x));
                for i in 0..6 {
                    let t = offsets.map_or(0.0, |at| x[at[i]]);
                    let (k, next) = (i / 2, (i / 2 + 1) % 3);
                    let (a, b) = if i % 2 == 0 {
                        (base[k] + (base[next] - base[k]) * t, platform[k])
                    } else {
                        (base[next], platform[k] + (platform[next] - platform[k]) * t)
                    };
                    (out.base[order[i]], out.platform[order[i]]) = (a, b);
                }
            }
            Skeleton::Families(families, firsts) => {
                (out.base, out.platform) =
                    (families.legs.map(|l| l.base.coords), families.legs.map(|l| l.platform.coords));
                for (s, first) in families.sliding.iter().zip(firsts) {
                    let [a, b] = Families::ends(s, &x[*first..first + s.parameters]);
                    (out.base[s.leg], out.platform[s.leg]) = (a.0, b.0);
                }
            }
        }
        out
    }

    pub(crate) fn rates(&self, x: &[f64]) -> Vec<Rate> {
        let mut out = vec![Rate::default(); x.len()];
        if let Some((k, v)) = self.lift {
            out[k].lift = v;
        }
        for (body, first) in self.axes.into_iter().enumerate() {
            for j in 0..first.map_or(0, |_| 18) {
                out[first.unwrap_or(0) + j].axis = Some((body, j / 3, j % 3));
            }
        }
        if let Skeleton::Octahedral { order, triangles, offsets } = &self.skeleton {
            let corners = [triangles[0].vertices(x), triangles[1].vertices(x)];
            for i in 0..6 {
                let (leg, sliding) = (order[i], i % 2);
                let t = offsets.map_or(0.0, |at| x[at[i]]);
                let (k, next) = (i / 2, (i / 2 + 1) % 3);
                let place = |body: usize, moved: Vector3<f64>| {
                    if body == 0 { (leg, moved, Vector3::zeros()) } else { (leg, Vector3::zeros(), moved) }
                };
                if let Some(at) = offsets {
                    out[at[i]].ends.push(place(sliding, corners[sliding][next] - corners[sliding][k]));
                }
                for body in 0..2 {
                    // the other end stays at the vertex that legs i and i + 1 share
                    let fixed = if body == 0 { next } else { k };
                    for (j, moved) in triangles[body].rates() {
                        let end = if body == sliding {
                            moved[k] + (moved[next] - moved[k]) * t
                        } else {
                            moved[fixed]
                        };
                        out[j].ends.push(place(body, end));
                    }
                }
            }
        }
        if let Skeleton::Families(families, firsts) = &self.skeleton {
            for (s, first) in families.sliding.iter().zip(firsts) {
                let [a, b] = Families::ends(s, &x[*first..first + s.parameters]);
                for (k, (a, b)) in a.1.into_iter().zip(b.1).enumerate() {
                    out[first + k].ends.push((s.leg, a, b));
                }
            }
        }
        out
    }

    /// The platform at the variables: legs of the design in their order; shared joints stay shared unless offsets split them.
    pub(crate) fn manipulator(&self, x: &[f64]) -> Result<Manipulator, InvalidManipulator> {
        let ends = self.ends(x);
        if !matches!(&self.skeleton, Skeleton::Fixed(_)) && self.joints != self.original.pairs() {
            let numbers = |pick: fn(&(usize, usize)) -> usize| -> Vec<usize> {
                let mut all: Vec<usize> = self.joints.iter().map(pick).collect();
                all.sort_unstable();
                all.dedup();
                all
            };
            let (base, platform) = (numbers(|p| p.0), numbers(|p| p.1));
            let place = |list: &[usize], joint: usize| list.binary_search(&joint).unwrap_or(0);
            let legs = self.joints.map(|(a, b)| (place(&base, a), place(&platform, b)));
            let (mut from, mut to) =
                (vec![Point3::origin(); base.len()], vec![Point3::origin(); platform.len()]);
            for (i, (a, b)) in legs.into_iter().enumerate() {
                (from[a], to[b]) = (ends.base[i].into(), ends.platform[i].into());
            }
            return Manipulator::try_new(from, to, legs);
        }
        let (mut base, mut platform) =
            (self.original.base_joints().to_vec(), self.original.platform_joints().to_vec());
        for (i, (a, b)) in self.joints.into_iter().enumerate() {
            (base[a], platform[b]) = (ends.base[i].into(), ends.platform[i].into());
        }
        Manipulator::try_new(base, platform, self.joints)
    }
}
