//! Legs of any design on the rational families of replaceable legs they belong to.

use nalgebra::{Matrix6, Point3, SMatrix, Vector3};

use super::problem::InvalidProblem;
use crate::manipulator::{Leg, LegIndex, Manipulator};
use crate::num::linalg::svd;
use crate::synthesis::components::{Component, ComponentOptions, MovingPoint, Parametrisation, components};
use crate::synthesis::{Normalisation, leg_vector};

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
