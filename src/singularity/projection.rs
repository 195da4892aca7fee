//! The nearest design with a relation between its leg vectors, by Gauss-Newton steps on joints and relation together.
//!
//! Minimise `|y|^2` over changes `y` of the joints and unit vectors `c` with `F = sum c_i v_i(x_0 + y) = 0` (sixteen equations). Each step solves the
//! linearised problem: the part of the equations that a change of `c` cannot reach is met by the least `y`, the rest by `c`.

use nalgebra::{DMatrix, DVector, Vector3};

use super::nearest::Change;
use crate::manipulator::Manipulator;
use crate::num::Rng;

/// Where the search begins: a unit vector of coefficients.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start([f64; 6]);

impl Start {
    /// The six singular vectors of the relation `c -> sum c_i v_i`, and `random` others.
    pub(super) fn all(m: &Manipulator, seed: u64, random: u64) -> Vec<Self> {
        let problem = Problem::of(m);
        let singular =
            problem.vectors(&problem.start).try_svd(false, true, f64::EPSILON, 500).and_then(|d| d.v_t);
        let rows =
            singular.iter().flat_map(|v| (0..6).rev().map(move |k| std::array::from_fn(|i| v[(k, i)])));
        let mut starts: Vec<Self> = rows.map(Self).collect();
        for k in 0..random {
            let mut rng = Rng::stream(seed, k);
            starts.push(Self([(); 6].map(|()| rng.normal())));
        }
        starts
    }
}

const STEPS: usize = 60;
/// Largest change in one step, and of `|F|` at the end, in the normalised coordinates.
const STRIDE: f64 = 0.3;
const SOLVED: f64 = 1e-13;
/// Smaller steps than this end the search: what they leave in `F` is their square.
const SETTLED: f64 = 1e-10;
/// Legs with a smaller share in the relation count as not taking part.
const SHARE: f64 = 1e-7;

/// Coordinates below this, relative to the size, are left out of the search; what it finds is measured from the joints as they are.
const LEAST: f64 = 1e-100;

/// Joints in use, centred and scaled to the size.
struct Problem {
    joints: [Vec<usize>; 2],
    start: DVector<f64>,
    legs: [(usize, usize); 6],
}

impl Problem {
    fn of(m: &Manipulator) -> Self {
        let used = |pick: fn(&(usize, usize)) -> usize| {
            let mut list: Vec<usize> = m.pairs().iter().map(pick).collect();
            list.sort_unstable();
            list.dedup();
            list
        };
        let joints = [used(|p| p.0), used(|p| p.1)];
        let mut x = Vec::new();
        for (list, at) in joints.iter().zip([m.base_joints(), m.platform_joints()]) {
            let first = at[list[0]];
            let mean = list.iter().map(|j| at[*j] - first).sum::<Vector3<f64>>() / list.len() as f64;
            let scaled = |j: &usize| (at[*j] - first - mean) / m.size();
            // parts that no sum with a part of order one can hold: products of them are below the range of doubles, where iterations do not settle
            let held = |x: f64| if x.abs() < LEAST { 0.0 } else { x };
            x.extend(list.iter().flat_map(|j| scaled(j).iter().map(|x| held(*x)).collect::<Vec<_>>()));
        }
        let place = |list: &[usize], j: usize| list.iter().position(|k| *k == j).unwrap_or_default();
        let legs = m.pairs().map(|(a, b)| (place(&joints[0], a), joints[0].len() + place(&joints[1], b)));
        Self { joints, start: DVector::from_vec(x), legs }
    }

    /// `(1, a)` and `(1, b)` of a leg.
    fn ends(&self, x: &DVector<f64>, leg: usize) -> [[f64; 4]; 2] {
        let (a, b) = self.legs[leg];
        [a, b].map(|j| [1.0, x[3 * j], x[3 * j + 1], x[3 * j + 2]])
    }

    /// The leg vectors as columns.
    fn vectors(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let ends: Vec<_> = (0..6).map(|i| self.ends(x, i)).collect();
        DMatrix::from_fn(16, 6, |k, i| ends[i][0][k / 4] * ends[i][1][k % 4])
    }

    /// Derivative of `sum c_i v_i` by the joints.
    fn by_joints(&self, x: &DVector<f64>, c: &DVector<f64>) -> DMatrix<f64> {
        let mut d = DMatrix::zeros(16, x.len());
        for leg in 0..6 {
            let [a, b] = self.ends(x, leg);
            let (j, k) = self.legs[leg];
            for axis in 0..3 {
                for other in 0..4 {
                    d[(4 * (axis + 1) + other, 3 * j + axis)] += c[leg] * b[other];
                    d[(4 * other + axis + 1, 3 * k + axis)] += c[leg] * a[other];
                }
            }
        }
        d
    }
}

/// Follows one start; `None` when it does not settle on a design with a relation.
pub(super) fn project(m: &Manipulator, start: &Start) -> Option<Change> {
    let problem = Problem::of(m);
    let mut x = problem.start.clone();
    let mut c = DVector::from_row_slice(&start.0).normalize();
    for _ in 0..STEPS {
        let v = problem.vectors(&x);
        let f = &v * &c;
        let by_x = problem.by_joints(&x, &c);
        let reached = tangent(&v, &c).try_svd(true, false, f64::EPSILON, 500)?;
        // columns of U with a singular value: what a change of c reaches
        let u = reached.u.as_ref()?;
        let limit = 1e-10 * reached.singular_values.max();
        let kept: Vec<usize> = (0..5).filter(|k| reached.singular_values[*k] > limit).collect();
        let across = |w: &DMatrix<f64>| {
            let basis = u.select_columns(&kept);
            w - &basis * (basis.transpose() * w)
        };
        let y = &x - &problem.start;
        let target = across(&DMatrix::from_column_slice(16, 1, (&by_x * &y - &f).as_slice()));
        let least = pseudo_solve(across(&by_x), &target)?;
        let mut step = DVector::from_column_slice(least.as_slice()) - &y;
        let left = -(&f + &by_x * &step);
        let mut turn = pseudo_solve(tangent(&v, &c), &DMatrix::from_column_slice(16, 1, left.as_slice()))?;
        let damping = (STRIDE / step.norm().max(turn.norm())).min(1.0);
        step *= damping;
        turn *= damping;
        x += &step;
        c = (&c + basis_across(&c) * DVector::from_column_slice(turn.as_slice())).normalize();
        if step.norm() <= SETTLED && turn.norm() <= SETTLED {
            break;
        }
    }
    let residual = (problem.vectors(&x) * &c).norm();
    (residual < SOLVED).then(|| change(m, &problem, &x, &c))
}

/// An orthonormal basis of the vectors at right angles to `c`, as 6 x 5.
fn basis_across(c: &DVector<f64>) -> DMatrix<f64> {
    // Householder: the reflection that takes the first axis to c takes the others to a basis
    let mut h = c.clone();
    let sign = if h[0] < 0.0 { -1.0 } else { 1.0 };
    h[0] += sign;
    let reflection = DMatrix::identity(6, 6) - (&h * h.transpose()) * (2.0 / h.norm_squared());
    reflection.columns(1, 5).into_owned()
}

/// Changes of `F` by changes of `c` on the unit sphere.
fn tangent(v: &DMatrix<f64>, c: &DVector<f64>) -> DMatrix<f64> {
    v * basis_across(c)
}

fn pseudo_solve(a: DMatrix<f64>, b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let svd = a.try_svd(true, true, f64::EPSILON, 500)?;
    let limit = 1e-10 * svd.singular_values.max();
    svd.solve(b, limit).ok()
}

fn change(m: &Manipulator, problem: &Problem, x: &DVector<f64>, c: &DVector<f64>) -> Change {
    let moved = (x - &problem.start) * m.size();
    let still = |count: usize| vec![Vector3::zeros(); count];
    let mut bodies = [still(m.base_joints().len()), still(m.platform_joints().len())];
    let mut next = 0;
    for (body, list) in problem.joints.iter().enumerate() {
        for j in list {
            bodies[body][*j] = Vector3::new(moved[next], moved[next + 1], moved[next + 2]);
            next += 3;
        }
    }
    let [base, platform] = bodies;
    let coefficients: [f64; 6] = std::array::from_fn(|i| c[i]);
    let legs = (0..6).filter(|i| c[*i].abs() > SHARE).collect();
    Change { kind: "leg_vectors_dependent", legs, coefficients: Some(coefficients), base, platform }
}
