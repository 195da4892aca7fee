//! The origins of the joints: unchanged joints, offsets on the sides of an octahedral hexagon, legs on families.

use std::fmt::Debug;

use nalgebra::{Matrix6, Point3, SMatrix, Vector3};

use super::problem::{InvalidProblem, Triangles, Variables};
use super::pull::Rate;
use super::shape::{JointId, LegJoints, VariableLayout, joints_of};
use machine::requirements::KeptSymmetry;
use num::linalg::svd;
use platform::manipulator::{Body, Leg, LegIndex, Manipulator, Octahedral};
use synthesis::components::{
    Component, ComponentOptions, ComponentsError, MovingPoint, Parametrisation, components,
};
use synthesis::{Normalisation, determinant_gradient, leg_vector, offset_determinant};

/// The ends of the legs as functions of the variables: the interface of a kind of design.
pub(crate) trait Skeleton: Debug + Send + Sync {
    /// The joints at the ends of the legs.
    fn joints(&self, m: &Manipulator) -> LegJoints {
        joints_of(m)
    }

    /// Base ends (base frame) and platform ends (platform frame) of the legs.
    fn ends(&self, x: &[f64]) -> [[Vector3<f64>; 6]; 2];

    /// The velocities of the ends, one entry for each variable.
    fn rates(&self, x: &[f64]) -> Vec<Rate> {
        vec![Rate::default(); x.len()]
    }

    /// `det A` of the leg map from the design and its gradient, if the variables keep the class of the design.
    fn determinant(&self, _x: &[f64]) -> Option<(f64, Vec<f64>)> {
        None
    }

    /// Remaining distances of ends from their limit.
    fn rooms(&self, _base: &[Vector3<f64>; 6], _platform: &[Vector3<f64>; 6]) -> Vec<ReachLeft> {
        Vec::new()
    }

    /// Whether the ends are affine functions of the variables.
    fn is_affine(&self) -> bool {
        true
    }

    /// Variables of the offsets of the octahedral hexagon, in cyclic order.
    fn offset_variables(&self) -> Option<[usize; 6]> {
        None
    }
}

/// Remaining distance of the end of a leg from its limit, in reaches of its body.
#[derive(Debug, Clone, Copy)]
pub(super) struct ReachLeft {
    pub leg: usize,
    pub body: Body,
    pub value: f64,
    /// Gradient by the end.
    pub gradient: Vector3<f64>,
}

/// Unchanged joints.
#[derive(Debug)]
pub(super) struct Fixed([Leg; 6]);

impl Fixed {
    pub(super) fn of(m: &Manipulator) -> Self {
        Self(m.legs())
    }
}

impl Skeleton for Fixed {
    fn ends(&self, _x: &[f64]) -> [[Vector3<f64>; 6]; 2] {
        [self.0.map(|l| l.base.coords), self.0.map(|l| l.platform.coords)]
    }
}

/// Base and platform of any design, each scaled about the mean of its leg ends: `p -> c + (1 + s) (p - c)`.
#[derive(Debug)]
pub(crate) struct ScaledBodies {
    legs: [Leg; 6],
    /// Centre of the base, base frame, and of the platform, platform frame.
    centres: [Vector3<f64>; 2],
    /// Variables of the two sizes; `None` for a body of fixed size.
    sizes: [Option<usize>; 2],
}

impl ScaledBodies {
    /// Lays out the two sizes.
    pub(super) fn of(m: &Manipulator, v: &Variables, layout: &mut VariableLayout) -> Self {
        let sizes = Body::BOTH.map(|body| {
            let free = !v.keeps_body(body);
            free.then(|| layout.add(format!("{body} size"), v.stretch_bounds, 0.0))
        });
        Self { legs: m.legs(), centres: m.mean_leg_ends(), sizes }
    }

    /// The end of a leg relative to the mean of all ends on its body.
    fn arm(&self, body: usize, leg: usize) -> Vector3<f64> {
        let end = [self.legs[leg].base, self.legs[leg].platform][body];
        end.coords - self.centres[body]
    }
}

impl Skeleton for ScaledBodies {
    fn ends(&self, x: &[f64]) -> [[Vector3<f64>; 6]; 2] {
        [0, 1].map(|body| {
            let factor = 1.0 + self.sizes[body].map_or(0.0, |k| x[k]);
            [0, 1, 2, 3, 4, 5].map(|leg| self.centres[body] + self.arm(body, leg) * factor)
        })
    }

    fn rates(&self, x: &[f64]) -> Vec<Rate> {
        let mut out = vec![Rate::default(); x.len()];
        for leg in 0..6 {
            if let Some(k) = self.sizes[0] {
                out[k].ends.push((leg, self.arm(0, leg), Vector3::zeros()));
            }
            if let Some(k) = self.sizes[1] {
                out[k].ends.push((leg, Vector3::zeros(), self.arm(1, leg)));
            }
        }
        out
    }
}

/// A triangle stretched in its plane about its centroid.
#[derive(Debug, Clone)]
struct StretchedTriangle {
    centre: Vector3<f64>,
    /// Coordinates of the vertices in `axes`.
    plane: [[f64; 2]; 3],
    axes: [Vector3<f64>; 2],
    /// Index of the first variable.
    first: Option<usize>,
    kind: Triangles,
}

impl StretchedTriangle {
    fn new(vertices: [Point3<f64>; 3], kind: Triangles, first: Option<usize>) -> Self {
        let centre = vertices.iter().map(|v| v.coords).sum::<Vector3<f64>>() / 3.0;
        let edge = (vertices[1] - vertices[0]).normalize();
        let normal = (vertices[1] - vertices[0]).cross(&(vertices[2] - vertices[0])).normalize();
        let axes = [edge, normal.cross(&edge)];
        let plane = vertices.map(|v| axes.map(|e| e.dot(&(v.coords - centre))));
        Self { centre, plane, axes, first, kind }
    }

    /// Entries `xx, xy, yy` of the stretch minus the identity.
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

    fn vertices(&self, x: &[f64]) -> [Vector3<f64>; 3] {
        let [xx, xy, yy] = self.stretch(x);
        [0, 1, 2].map(|v| self.centre + self.displaced(v, [1.0 + xx, xy, 1.0 + yy]))
    }

    /// Variables with the velocities of the vertices.
    fn rates(&self) -> Vec<(usize, [Vector3<f64>; 3])> {
        let unit: &[[f64; 3]] = match self.kind {
            Triangles::Fixed => &[],
            Triangles::Sizes => &[[1.0, 0.0, 1.0]],
            Triangles::Shapes => &[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        };
        let Some(first) = self.first else { return Vec::new() };
        unit.iter().enumerate().map(|(k, s)| (first + k, [0, 1, 2].map(|v| self.displaced(v, *s)))).collect()
    }
}

/// Offsets on the sides of an octahedral hexagon between two triangles.
#[derive(Debug)]
pub(crate) struct OctahedralSides {
    /// Leg of the design for each leg in cyclic order.
    order: [usize; 6],
    triangles: [StretchedTriangle; 2],
    /// Variable of each offset.
    offsets: Option<[usize; 6]>,
}

/// Vertices of both triangles between which leg `i` in cyclic order slides: the one at its start and the next.
fn side(i: usize) -> [usize; 2] {
    [i / 2, (i / 2 + 1) % 3]
}

impl OctahedralSides {
    /// Lays out offsets and stretches.
    pub(super) fn of(
        m: &Manipulator,
        v: &Variables,
        layout: &mut VariableLayout,
    ) -> Result<Self, InvalidProblem> {
        let o = Octahedral::recognise(m).map_err(InvalidProblem::NotOctahedral)?;
        let three_fold = v.symmetry == KeptSymmetry::ThreeFold;
        // an equilateral triangle stays equilateral if only its size changes
        let chosen =
            if three_fold && v.triangles == Triangles::Shapes { Triangles::Sizes } else { v.triangles };
        let offsets = v.offsets.then(|| {
            let mut at = [0; 6];
            for i in 0..6 {
                at[i] = if (v.symmetric || three_fold) && i > 1 {
                    at[i % 2]
                } else {
                    layout.add(format!("t{}", i + 1), v.offset_bounds[i], 0.0)
                };
            }
            at
        });
        let mut triangle = |vertices, body: Body| {
            let first = layout.next();
            let chosen = if v.keeps_body(body) { Triangles::Fixed } else { chosen };
            let (diagonal, shear) = (v.stretch_bounds, 0.5 * (v.stretch_bounds.1 - v.stretch_bounds.0));
            match chosen {
                Triangles::Fixed => return StretchedTriangle::new(vertices, chosen, None),
                Triangles::Sizes => {
                    layout.add(format!("{body} size"), diagonal, 0.0);
                }
                Triangles::Shapes => {
                    layout.add(format!("{body} stretch xx"), diagonal, 0.0);
                    layout.add(format!("{body} stretch xy"), (-shear, shear), 0.0);
                    layout.add(format!("{body} stretch yy"), diagonal, 0.0);
                }
            }
            StretchedTriangle::new(vertices, chosen, Some(first))
        };
        let triangles = [triangle(o.base(), Body::Base), triangle(o.platform(), Body::Platform)];
        Ok(Self { order: o.order().map(LegIndex::get), triangles, offsets })
    }
}

impl Skeleton for OctahedralSides {
    fn joints(&self, m: &Manipulator) -> LegJoints {
        match self.offsets {
            Some(_) => std::array::from_fn(|i| (JointId::OfLeg(i), JointId::OfLeg(i))),
            None => joints_of(m),
        }
    }

    fn ends(&self, x: &[f64]) -> [[Vector3<f64>; 6]; 2] {
        let (base, platform) = (self.triangles[0].vertices(x), self.triangles[1].vertices(x));
        let mut out = [[Vector3::zeros(); 6]; 2];
        for (i, leg) in self.order.into_iter().enumerate() {
            let t = self.offsets.map_or(0.0, |at| x[at[i]]);
            let [k, next] = side(i);
            let (a, b) = if i % 2 == 0 {
                (base[k] + (base[next] - base[k]) * t, platform[k])
            } else {
                (base[next], platform[k] + (platform[next] - platform[k]) * t)
            };
            (out[0][leg], out[1][leg]) = (a, b);
        }
        out
    }

    fn rates(&self, x: &[f64]) -> Vec<Rate> {
        let mut out = vec![Rate::default(); x.len()];
        let corners = self.triangles.each_ref().map(|t| t.vertices(x));
        for (i, leg) in self.order.into_iter().enumerate() {
            let sliding = i % 2;
            let t = self.offsets.map_or(0.0, |at| x[at[i]]);
            let [k, next] = side(i);
            let place = |body: usize, moved: Vector3<f64>| {
                if body == 0 { (leg, moved, Vector3::zeros()) } else { (leg, Vector3::zeros(), moved) }
            };
            if let Some(at) = self.offsets {
                out[at[i]].ends.push(place(sliding, corners[sliding][next] - corners[sliding][k]));
            }
            for (body, triangle) in self.triangles.iter().enumerate() {
                // the other end stays at the vertex that legs i and i + 1 share
                let fixed = if body == 0 { next } else { k };
                for (j, moved) in triangle.rates() {
                    let end =
                        if body == sliding { moved[k] + (moved[next] - moved[k]) * t } else { moved[fixed] };
                    out[j].ends.push(place(body, end));
                }
            }
        }
        out
    }

    /// `det A = prod (1 - t_i) - prod t_i`.
    fn determinant(&self, x: &[f64]) -> Option<(f64, Vec<f64>)> {
        let at = self.offsets?;
        let t = at.map(|k| x[k]);
        let mut gradient = vec![0.0; x.len()];
        for (k, slope) in at.into_iter().zip(determinant_gradient(&t)) {
            gradient[k] += slope;
        }
        Some((offset_determinant(&t), gradient))
    }

    fn is_affine(&self) -> bool {
        self.offsets.is_none() || self.triangles.iter().all(|t| t.first.is_none())
    }

    fn offset_variables(&self) -> Option<[usize; 6]> {
        self.offsets
    }
}

/// A leg that slides on a family.
#[derive(Debug, Clone)]
struct Sliding {
    leg: usize,
    /// Index of the first variable.
    first: usize,
    /// Number of parameters.
    parameters: usize,
    base: MovingPoint,
    platform: MovingPoint,
}

impl Sliding {
    /// Base end and platform end with their velocities.
    fn ends(&self, parameters: &[f64]) -> [(Vector3<f64>, Vec<Vector3<f64>>); 2] {
        [moved(&self.base, parameters), moved(&self.platform, parameters)]
    }

    fn ends_at(&self, x: &[f64]) -> [(Vector3<f64>, Vec<Vector3<f64>>); 2] {
        self.ends(&x[self.first..self.first + self.parameters])
    }

    /// Whether an end never moves.
    fn is_fixed(&self, body: Body) -> bool {
        let end = body.of((&self.base, &self.platform));
        end.terms.iter().all(|(e, _)| *e == [0; 3])
    }
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

/// A family for each leg, different ones as far as possible (augmenting paths); `None` for a leg without family.
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

/// Legs on their rational families, and the data for the determinant of the leg map.
#[derive(Debug)]
pub(crate) struct OnFamilies {
    sliding: Vec<Sliding>,
    legs: [Leg; 6],
    normalisation: Normalisation,
    /// Right inverse of the leg vectors of the design: `A = V' P`.
    inverse: SMatrix<f64, 16, 6>,
}

/// Singular values of the leg vectors below this, over the largest, count as zero.
const DEPENDENT: f64 = 1e-9;
/// An end within this of a joint, in sizes of the design, coincides with it.
const SAME_JOINT: f64 = 1e-9;

impl OnFamilies {
    /// The rational families of a design with legs assigned to them as far as possible, with their parameters as
    /// variables.
    pub(super) fn of(
        m: &Manipulator,
        v: &Variables,
        layout: &mut VariableLayout,
    ) -> Result<Self, InvalidProblem> {
        let found = components(m, ComponentOptions::default())?;
        let is_rational = |c: &&Component| {
            matches!(c.parametrisation, Parametrisation::Rational { .. }) && c.contained_in.is_empty()
        };
        let rational: Vec<&Component> = found.components.iter().filter(is_rational).collect();
        let choice = assigned(&rational);
        let slide = |leg: LegIndex| match &rational[choice[leg.get()]?].parametrisation {
            Parametrisation::Rational { parameters, base, platform } => Some(Sliding {
                leg: leg.get(),
                first: 0,
                parameters: *parameters,
                base: base.clone(),
                platform: platform.clone(),
            }),
            Parametrisation::Cubic(_) => None,
        };
        let stays = |s: &Sliding| {
            Body::BOTH.into_iter().all(|body| !v.fixed_ends[body.index()][s.leg] || s.is_fixed(body))
        };
        let mut sliding: Vec<Sliding> = LegIndex::all().filter_map(slide).filter(stays).collect();
        if sliding.is_empty() {
            return Err(InvalidProblem::NoFamily);
        }
        let (legs, normalisation) = (m.legs(), Normalisation::of(m));
        let rows: Vec<Vec<f64>> = legs.iter().map(|l| leg_vector(&normalisation.apply(l)).to_vec()).collect();
        let d = svd(&rows).map_err(ComponentsError::from)?;
        if !(d.s[5] > DEPENDENT * d.s[0]) {
            return Err(InvalidProblem::DependentLegs);
        }
        let inverse = SMatrix::from_fn(|p, i| (0..6).map(|k| d.v[p][k] * d.u[i][k] / d.s[k]).sum());
        let middle = f64::midpoint(v.parameter_bounds.0, v.parameter_bounds.1);
        for s in &mut sliding {
            s.first = layout.next();
            for k in 0..s.parameters {
                layout.add(format!("leg {} parameter {}", s.leg + 1, k + 1), v.parameter_bounds, middle);
            }
        }
        Ok(Self { sliding, legs, normalisation, inverse })
    }

    /// `det A` of the leg map to these legs, and its derivatives by base ends and platform ends.
    fn determinant_of(
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
        // cofactors by products, so that a singular A causes no error
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

    /// Remaining distance of an end from its limit, in reaches, and the gradient.
    fn room_of(&self, body: Body, end: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let n = &self.normalisation;
        let (centre, unit) =
            body.of(((n.base_centre.coords, n.base_unit), (n.platform_centre.coords, n.platform_unit)));
        let out = (end - centre) / unit;
        (REACH - out.norm(), -out.try_normalize(0.0).unwrap_or_else(Vector3::x) / unit)
    }
}

impl Skeleton for OnFamilies {
    /// Sliding ends are separate joints.
    fn joints(&self, m: &Manipulator) -> LegJoints {
        let mut out = joints_of(m);
        for s in &self.sliding {
            let (ends, size) = (s.ends(&vec![0.0; s.parameters]), m.size());
            let joint = |body: Body, joints: &[Point3<f64>]| {
                let end = Point3::from(ends[body.index()].0);
                let same = |p: &Point3<f64>| (p - end).norm() <= SAME_JOINT * size;
                let stays = s.is_fixed(body).then(|| joints.iter().position(same)).flatten();
                stays.map_or(JointId::OfLeg(s.leg), JointId::OfDesign)
            };
            out[s.leg] = (joint(Body::Base, m.base_joints()), joint(Body::Platform, m.platform_joints()));
        }
        out
    }

    fn ends(&self, x: &[f64]) -> [[Vector3<f64>; 6]; 2] {
        let mut out = [self.legs.map(|l| l.base.coords), self.legs.map(|l| l.platform.coords)];
        for s in &self.sliding {
            let [a, b] = s.ends_at(x);
            (out[0][s.leg], out[1][s.leg]) = (a.0, b.0);
        }
        out
    }

    fn rates(&self, x: &[f64]) -> Vec<Rate> {
        let mut out = vec![Rate::default(); x.len()];
        for s in &self.sliding {
            let [a, b] = s.ends_at(x);
            for (k, (a, b)) in a.1.into_iter().zip(b.1).enumerate() {
                out[s.first + k].ends.push((s.leg, a, b));
            }
        }
        out
    }

    fn determinant(&self, x: &[f64]) -> Option<(f64, Vec<f64>)> {
        let [base, platform] = self.ends(x);
        let (det, on_base, on_platform) = self.determinant_of(&base, &platform);
        let by = |rate: &Rate| {
            rate.ends.iter().map(|(i, a, b)| on_base[*i].dot(a) + on_platform[*i].dot(b)).sum::<f64>()
        };
        Some((det, self.rates(x).iter().map(by).collect()))
    }

    fn rooms(&self, base: &[Vector3<f64>; 6], platform: &[Vector3<f64>; 6]) -> Vec<ReachLeft> {
        let mut out = Vec::new();
        for s in &self.sliding {
            for (body, ends) in [(Body::Base, base), (Body::Platform, platform)] {
                if !s.is_fixed(body) {
                    let (value, gradient) = self.room_of(body, &ends[s.leg]);
                    out.push(ReachLeft { leg: s.leg, body, value, gradient });
                }
            }
        }
        out
    }

    fn is_affine(&self) -> bool {
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scaled_bodies_keep_their_means_and_move_at_their_rates() {
        let points =
            |k: f64| (0..6).map(|i| Point3::new(k + f64::from(i), k * f64::from(i * i), 0.3 * k)).collect();
        let m = Manipulator::try_new(points(1.0), points(0.5), [0, 1, 2, 3, 4, 5].map(|i| (i, i))).unwrap();
        let mut layout = VariableLayout::default();
        let bodies = ScaledBodies::of(&m, &Variables::default(), &mut layout);
        assert_eq!(layout.next(), 2);
        let mean = |ends: [Vector3<f64>; 6]| ends.iter().sum::<Vector3<f64>>() / 6.0;
        let (before, after) = (bodies.ends(&[0.0, 0.0]), bodies.ends(&[0.5, -0.25]));
        for body in 0..2 {
            let factor = [1.5, 0.75][body];
            assert!((mean(after[body]) - mean(before[body])).norm() < 1e-12);
            for i in 0..6 {
                let legs = m.legs().map(|l| [l.base.coords, l.platform.coords][body]);
                assert!((before[body][i] - legs[i]).norm() < 1e-12);
                let spread = |ends: [Vector3<f64>; 6]| (ends[i] - ends[0]).norm();
                assert!((spread(after[body]) - factor * spread(before[body])).abs() < 1e-12);
            }
        }
        let rates = bodies.rates(&[0.5, -0.25]);
        let moved = bodies.ends(&[0.5 + 1.0, -0.25]);
        for (leg, base, platform) in &rates[0].ends {
            assert!((moved[0][*leg] - after[0][*leg] - base).norm() < 1e-12 && platform.norm() < 1e-12);
        }
        assert_eq!((rates[0].ends.len(), rates[1].ends.len()), (6, 6));
    }
}
