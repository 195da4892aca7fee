//! From variables to joints: offsets, triangles, height of the home pose, joint axes, parameters of families.
//!
//! The triangles of an octahedral design under a stretch of their planes.
//!
//! Legs of any design on the rational families of replaceable legs they belong to.
//!
//! The smallest cap of the sphere that holds given directions: the joint axis from which a leg leans least.
//!
//! Derivatives by reverse accumulation: what a function pulls at on the joints, and what the variables do to the joints.

use nalgebra::{Matrix6, Point3, Rotation3, SMatrix, Vector3};

use super::problem::{InvalidProblem, Triangles, Variables};
use crate::geom::Pose;
use crate::manipulator::{InvalidManipulator, Leg, LegIndex, Manipulator, Octahedral};
use crate::num::linalg::svd;
use crate::num::small::symmetric_eigen3;
use crate::synthesis::components::{Component, ComponentOptions, MovingPoint, Parametrisation, components};
use crate::synthesis::{Normalisation, leg_vector};

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

/// A triangle that is stretched in its plane about its centroid.
#[derive(Debug, Clone)]
pub(crate) struct Triangle {
    centre: Vector3<f64>,
    /// Coordinates of the vertices in `axes`.
    plane: [[f64; 2]; 3],
    axes: [Vector3<f64>; 2],
    /// Index of the first variable.
    pub(crate) first: Option<usize>,
    kind: Triangles,
}

impl Triangle {
    pub(crate) fn new(vertices: [Point3<f64>; 3], kind: Triangles, first: Option<usize>) -> Self {
        let centre = vertices.iter().map(|v| v.coords).sum::<Vector3<f64>>() / 3.0;
        let edge = (vertices[1] - vertices[0]).normalize();
        let normal = (vertices[1] - vertices[0]).cross(&(vertices[2] - vertices[0])).normalize();
        let axes = [edge, normal.cross(&edge)];
        let plane = vertices.map(|v| axes.map(|e| e.dot(&(v.coords - centre))));
        Self { centre, plane, axes, first, kind }
    }

    /// Entries `xx, xy, yy` of the stretch less the identity.
    fn stretch(&self, x: &[f64]) -> [f64; 3] {
        match (self.first, self.kind) {
            (Some(k), Triangles::Sizes) => [x[k], 0.0, x[k]],
            (Some(k), Triangles::Shapes) => [x[k], x[k + 1], x[k + 2]],
            _ => [0.0; 3],
        }
    }

    fn displaced(&self, v: usize, s: [f64; 3]) -> Vector3<f64> {
        let [p, q] = self.plane[v];
        self.axes[0] * (s[0] * p + s[1] * q) + self.axes[1] * (s[1] * p + s[2] * q)
    }

    pub(crate) fn vertices(&self, x: &[f64]) -> [Vector3<f64>; 3] {
        let [xx, xy, yy] = self.stretch(x);
        [0, 1, 2].map(|v| self.centre + self.displaced(v, [1.0 + xx, xy, 1.0 + yy]))
    }

    /// Variables with the directions in which they move the vertices.
    pub(crate) fn rates(&self) -> Vec<(usize, [Vector3<f64>; 3])> {
        let unit: &[[f64; 3]] = match self.kind {
            Triangles::Fixed => &[],
            Triangles::Sizes => &[[1.0, 0.0, 1.0]],
            Triangles::Shapes => &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let Some(first) = self.first else { return Vec::new() };
        unit.iter().enumerate().map(|(k, s)| (first + k, [0, 1, 2].map(|v| self.displaced(v, *s)))).collect()
    }
}

/// A leg that slides on a family.
#[derive(Debug, Clone)]
pub(crate) struct Sliding {
    pub(crate) leg: usize,
    /// Number of parameters.
    pub(crate) parameters: usize,
    base: MovingPoint,
    platform: MovingPoint,
}

/// The legs that slide, and what tells the determinant of the leg map.
#[derive(Debug, Clone)]
pub(crate) struct Families {
    pub(crate) sliding: Vec<Sliding>,
    pub(crate) legs: [Leg; 6],
    normalisation: Normalisation,
    /// Right inverse of the leg vectors of the design: `A = V' P`.
    inverse: SMatrix<f64, 16, 6>,
}

/// Largest distance of an end from the centre of its body, in reaches of the body.
const REACH: f64 = 2.5;

/// A point and its derivatives by the parameters.
fn moved(p: &MovingPoint, parameters: &[f64]) -> (Vector3<f64>, Vec<Vector3<f64>>) {
    let h = p.homogeneous(parameters);
    let point = Vector3::new(h[1], h[2], h[3]) / h[0];
    let rate = |k: usize| {
        let mut d = [0.0; 4];
        for (e, c) in p.terms.iter().filter(|(e, _)| e[k] > 0) {
            let power = |j: usize| {
                let x = parameters.get(j).copied().unwrap_or(0.0);
                if j == k { f64::from(e[j]) * x.powi(i32::from(e[j]) - 1) } else { x.powi(i32::from(e[j])) }
            };
            let factor = power(0) * power(1) * power(2);
            d.iter_mut().zip(c).for_each(|(o, x)| *o += factor * x);
        }
        (Vector3::new(d[1], d[2], d[3]) - point * d[0]) / h[0]
    };
    (point, (0..parameters.len().min(3)).map(rate).collect())
}

/// A family for each leg, different ones as far as possible (augmenting paths); a leg without family has `None`.
fn assigned(rational: &[&Component]) -> [Option<usize>; 6] {
    fn place(leg: usize, own: &[Vec<usize>; 6], held: &mut [Option<usize>], seen: &mut [bool]) -> bool {
        for &c in &own[leg] {
            if !std::mem::replace(&mut seen[c], true)
                && held[c].is_none_or(|other| place(other, own, held, seen))
            {
                held[c] = Some(leg);
                return true;
            }
        }
        false
    }
    let own: [Vec<usize>; 6] = std::array::from_fn(|leg| {
        let holds = |c: &&usize| rational[**c].legs.iter().any(|l| l.get() == leg);
        let all: Vec<usize> = (0..rational.len()).collect();
        all.iter().filter(holds).copied().collect()
    });
    let mut held = vec![None; rational.len()];
    for leg in 0..6 {
        place(leg, &own, &mut held, &mut vec![false; rational.len()]);
    }
    std::array::from_fn(|leg| held.iter().position(|h| *h == Some(leg)).or_else(|| own[leg].first().copied()))
}

impl Families {
    /// The rational families of a design with a leg on each as far as there are any.
    pub(crate) fn of(m: &Manipulator) -> Result<Self, InvalidProblem> {
        let found = components(m, ComponentOptions::default())?;
        let rational: Vec<&Component> = found
            .components
            .iter()
            .filter(|c| {
                matches!(c.parametrisation, Parametrisation::Rational { .. }) && c.contained_in.is_empty()
            })
            .collect();
        let choice = assigned(&rational);
        let slide = |leg: LegIndex| match &rational[choice[leg.get()]?].parametrisation {
            Parametrisation::Rational { parameters, base, platform } => Some(Sliding {
                leg: leg.get(),
                parameters: *parameters,
                base: base.clone(),
                platform: platform.clone(),
            }),
            _ => None,
        };
        let sliding: Vec<Sliding> = LegIndex::all().filter_map(slide).collect();
        if sliding.is_empty() {
            return Err(InvalidProblem::NoFamily);
        }
        let (legs, normalisation) = (m.legs(), Normalisation::of(m));
        let rows: Vec<Vec<f64>> = legs.iter().map(|l| leg_vector(&normalisation.apply(l)).to_vec()).collect();
        let d = svd(&rows).map_err(crate::synthesis::components::ComponentsError::from)?;
        if !(d.s[5] > 1e-9 * d.s[0]) {
            return Err(InvalidProblem::DependentLegs);
        }
        let inverse = SMatrix::from_fn(|p, i| (0..6).map(|k| d.v[p][k] * d.u[i][k] / d.s[k]).sum());
        Ok(Self { sliding, legs, normalisation, inverse })
    }

    /// Ends of a sliding leg and their velocities.
    pub(crate) fn ends(s: &Sliding, parameters: &[f64]) -> [(Vector3<f64>, Vec<Vector3<f64>>); 2] {
        [moved(&s.base, parameters), moved(&s.platform, parameters)]
    }

    /// Whether an end of a sliding leg never moves.
    pub(crate) fn is_fixed(s: &Sliding, platform: bool) -> bool {
        let p = if platform { &s.platform } else { &s.base };
        p.terms.iter().all(|(e, _)| *e == [0; 3])
    }

    /// `det A` of the leg map to these legs, and its derivatives by base ends and platform ends.
    pub(crate) fn determinant(
        &self,
        base: &[Vector3<f64>; 6],
        platform: &[Vector3<f64>; 6],
    ) -> (f64, [Vector3<f64>; 6], [Vector3<f64>; 6]) {
        let n = &self.normalisation;
        let legs: [Leg; 6] = std::array::from_fn(|i| {
            n.apply(&Leg { base: Point3::from(base[i]), platform: Point3::from(platform[i]) })
        });
        let vectors = legs.map(|l| leg_vector(&l));
        let a = Matrix6::from_fn(|i, j| (0..16).map(|p| vectors[i][p] * self.inverse[(p, j)]).sum());
        let det: f64 = a.determinant();
        // cofactors by products, so that a singular A does no harm
        let cofactor = Matrix6::from_fn(|i, j| {
            let minor: f64 = a.remove_row(i).remove_column(j).determinant();
            if (i + j) % 2 == 0 { minor } else { -minor }
        });
        let (mut on_base, mut on_platform) = ([Vector3::zeros(); 6], [Vector3::zeros(); 6]);
        for i in 0..6 {
            let g: [f64; 16] =
                std::array::from_fn(|p| (0..6).map(|j| cofactor[(i, j)] * self.inverse[(p, j)]).sum());
            let one = |v: &Point3<f64>| [1.0, v.x, v.y, v.z];
            let (alpha, beta) = (one(&legs[i].base), one(&legs[i].platform));
            for k in 0..3 {
                on_base[i][k] = (0..4).map(|q| g[4 * (k + 1) + q] * beta[q]).sum::<f64>() / n.base_unit;
                on_platform[i][k] =
                    (0..4).map(|p| g[4 * p + k + 1] * alpha[p]).sum::<f64>() / n.platform_unit;
            }
        }
        (det, on_base, on_platform)
    }

    /// How far an end may still go out, in reaches, and the gradient.
    pub(crate) fn room(&self, platform: bool, end: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let n = &self.normalisation;
        let (centre, unit) = if platform {
            (n.platform_centre.coords, n.platform_unit)
        } else {
            (n.base_centre.coords, n.base_unit)
        };
        let out = (end - centre) / unit;
        (REACH - out.norm(), -out.try_normalize(0.0).unwrap_or_else(Vector3::x) / unit)
    }
}

/// Directions within this angle cosine count as inside; about 1e-7 degrees at 45 degrees.
const SLIP: f64 = 1e-14;

#[derive(Debug, Clone, Copy)]
struct Cap {
    axis: Vector3<f64>,
    cos: f64,
}

impl Cap {
    fn holds(&self, u: &Vector3<f64>) -> bool {
        self.axis.dot(u) >= self.cos - SLIP
    }

    fn of_two(u: &Vector3<f64>, v: &Vector3<f64>) -> Option<Self> {
        let axis = (u + v).try_normalize(1e-9)?;
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)) })
    }

    /// The cap whose rim passes through three directions.
    fn of_three(u: &Vector3<f64>, v: &Vector3<f64>, w: &Vector3<f64>) -> Option<Self> {
        let n = (v - u).cross(&(w - u)).try_normalize(1e-300)?;
        let axis = if n.dot(u) < 0.0 { -n } else { n };
        Some(Self { axis, cos: axis.dot(u).min(axis.dot(v)).min(axis.dot(w)) })
    }
}

/// Axis (unit vector) that minimises the greatest angle to the directions, and the cosine of that angle.
///
/// `max_c min_k u_k . c` over `|c| <= 1`; at the optimum two or three directions are on the rim, and the incremental algorithm of
/// Welzl (1991) finds them. `None` for no direction, or when no open half space holds all.
pub(crate) fn smallest_cap(directions: &[Vector3<f64>]) -> Option<(Vector3<f64>, f64)> {
    let first = directions.first()?;
    let mut cap = Cap { axis: *first, cos: 1.0 };
    for i in 1..directions.len() {
        if cap.holds(&directions[i]) {
            continue;
        }
        cap = Cap { axis: directions[i], cos: 1.0 };
        for j in 0..i {
            if cap.holds(&directions[j]) {
                continue;
            }
            cap = Cap::of_two(&directions[i], &directions[j])?;
            for k in 0..j {
                if !cap.holds(&directions[k]) {
                    cap = Cap::of_three(&directions[i], &directions[j], &directions[k])?;
                }
            }
        }
    }
    (cap.cos > 0.0 && directions.iter().all(|u| cap.axis.dot(u) >= cap.cos - 1e-9))
        .then_some((cap.axis, cap.cos))
}

/// Directions in which the joints move when one variable grows at unit rate.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rate {
    /// Leg, velocity of its base end (base frame) and of its platform end (platform frame).
    pub(crate) ends: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
    /// Velocity of home, and of every pose that is given relative to it.
    pub(crate) lift: Vector3<f64>,
    /// Joint axis: body (0 base, 1 platform), leg, component.
    pub(crate) axis: Option<(usize, usize, usize)>,
}

/// What a formula leaves of its gradient: a [`Pull`], or nothing where the value alone is wanted.
pub(crate) trait Gradient: Copy {
    /// Whether anything is kept; formulas skip their derivatives otherwise.
    const KEPT: bool;
    fn none() -> Self;
    /// Adds to the gradient with respect to a base end.
    fn at_base(&mut self, leg: usize, g: &Vector3<f64>);
    /// Adds to the gradient with respect to an arm `R b`.
    fn at_arm(&mut self, leg: usize, g: &Vector3<f64>);
    /// Adds to the gradient with respect to the position.
    fn at_position(&mut self, g: &Vector3<f64>);
    /// Sets the gradient with respect to the line of a leg at home.
    fn set_home(&mut self, leg: usize, g: Vector3<f64>);
    /// Sets the gradient with respect to the axis of a joint.
    fn set_axis(&mut self, body: usize, leg: usize, g: Vector3<f64>);
    fn scaled(self, factor: f64) -> Self;

    /// Adds a gradient with respect to the line `R b + p - a` of a leg.
    fn line(&mut self, leg: usize, g: Vector3<f64>) {
        self.at_base(leg, &-g);
        self.at_arm(leg, &g);
        self.at_position(&g);
    }
}

impl Gradient for () {
    const KEPT: bool = false;
    fn none() -> Self {}
    fn at_base(&mut self, _: usize, _: &Vector3<f64>) {}
    fn at_arm(&mut self, _: usize, _: &Vector3<f64>) {}
    fn at_position(&mut self, _: &Vector3<f64>) {}
    fn set_home(&mut self, _: usize, _: Vector3<f64>) {}
    fn set_axis(&mut self, _: usize, _: usize, _: Vector3<f64>) {}
    fn scaled(self, _: f64) -> Self {}
}

/// Gradient of a function of the legs at one pose with respect to base ends, arms `R b` and position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull {
    pub(crate) base: [Vector3<f64>; 6],
    pub(crate) arm: [Vector3<f64>; 6],
    pub(crate) position: Vector3<f64>,
    /// Leg and gradient with respect to its line at home.
    pub(crate) home: Option<(usize, Vector3<f64>)>,
    /// Body, leg and gradient with respect to the axis of the joint.
    pub(crate) axis: Option<(usize, usize, Vector3<f64>)>,
}

impl Gradient for Pull {
    const KEPT: bool = true;

    fn none() -> Self {
        let zero = Vector3::zeros();
        Self { base: [zero; 6], arm: [zero; 6], position: zero, home: None, axis: None }
    }

    fn at_base(&mut self, leg: usize, g: &Vector3<f64>) {
        self.base[leg] += g;
    }

    fn at_arm(&mut self, leg: usize, g: &Vector3<f64>) {
        self.arm[leg] += g;
    }

    fn at_position(&mut self, g: &Vector3<f64>) {
        self.position += g;
    }

    fn set_home(&mut self, leg: usize, g: Vector3<f64>) {
        self.home = Some((leg, g));
    }

    fn set_axis(&mut self, body: usize, leg: usize, g: Vector3<f64>) {
        self.axis = Some((body, leg, g));
    }

    fn scaled(mut self, factor: f64) -> Self {
        self.base.iter_mut().chain(&mut self.arm).for_each(|g| *g *= factor);
        self.position *= factor;
        self.home = self.home.map(|(i, g)| (i, g * factor));
        self.axis = self.axis.map(|(b, i, g)| (b, i, g * factor));
        self
    }
}

impl Pull {
    /// Adds `factor` times another.
    pub(crate) fn add(&mut self, other: &Self, factor: f64) {
        for i in 0..6 {
            self.base[i] += other.base[i] * factor;
            self.arm[i] += other.arm[i] * factor;
        }
        self.position += other.position * factor;
    }

    /// Gradient with respect to the variables at a pose; `follows`: the pose moves with home.
    pub(crate) fn gradient(
        &self,
        rates: &[Rate],
        rotation: &Rotation3<f64>,
        follows: bool,
        home: &Rotation3<f64>,
    ) -> Vec<f64> {
        let arm = self.arm.map(|g| rotation.inverse() * g);
        let back = self.home.map(|(i, g)| (i, g, home.inverse() * g));
        let one = |rate: &Rate| {
            let mut sum = if follows { self.position.dot(&rate.lift) } else { 0.0 };
            for (i, a, b) in &rate.ends {
                sum += self.base[*i].dot(a) + arm[*i].dot(b);
            }
            if let Some((leg, g, turned)) = &back {
                sum += g.dot(&rate.lift);
                for (_, a, b) in rate.ends.iter().filter(|e| e.0 == *leg) {
                    sum += turned.dot(b) - g.dot(a);
                }
            }
            if let (Some((body, leg, g)), Some((b, l, k))) = (self.axis, rate.axis)
                && (body, leg) == (b, l)
            {
                sum += g[k];
            }
            sum
        };
        rates.iter().map(one).collect()
    }
}
