//! Six leg equations by an elimination template: one LU factorisation, one generalised eigenproblem.
//!
//! Cayley vector `(u, v, w)`, that is the quaternion `e = (1, u, v, w)`, and position `t = (x, y, z)`; leg 1 joins
//! the origins, so `f_1 = t.t - L_1`. The other legs minus `N f_1`, `N = e.e`, are
//!
//! ```text
//! f_i = N (L_1 - L_i + |a_i|^2 + |b_i|^2) + 2 t^T (N R(e) b_i - N a_i) - 2 a_i^T N R(e) b_i,
//! ```
//!
//! forty coefficients each. The template (Martyushev, Forward kinematics of a general Stewart-Gough platform by
//! elimination templates, sec. 4 and appendix) multiplies `f_2..f_6` by 293 monomials. After reduction with multiples
//! of `f_1`, 362 columns suffice (the others depend on them linearly). Eliminating the 255 excessive ones leaves 38
//! equations between reducible and basic monomials. `1/w` maps basic monomials to basic and reducible ones, which gives
//! a 69 x 69 pencil. At most 40 of its eigenvectors belong to poses. Refinement and proof decide which, not sorted
//! residuals.

mod layout;

pub use layout::{LayoutError, TemplateLayout};

use nalgebra::Vector3;

use super::generic_frame::{GenericProblem, RawCandidate, norm_form, rotation_forms};
use layout::DividedMonomial;
use num::dense::{GeneralizedEigenpair, generalized_eigenpairs, upper_factor};
use num::linalg::LinalgError;
use platform::geom::ComplexPose;

/// A template whose smallest pivot is below this, relative to the largest, has lost rank to rounding.
const PIVOT_LIMIT: f64 = 1e-13;

/// The matrix of a problem, 293 x 362, columns excessive, reducible, basic.
#[derive(Debug, Clone, PartialEq)]
pub struct Filled<'a> {
    layout: &'a TemplateLayout,
    rows: Vec<Vec<f64>>,
}

/// The equations after the factorisation: `A_R v(R) + A_B v(B) = 0`.
#[derive(Debug, Clone, PartialEq)]
pub struct Eliminated<'a> {
    layout: &'a TemplateLayout,
    /// 38 rows, columns reducible, basic.
    rows: Vec<Vec<f64>>,
    /// Smallest pivot over largest, a rough measure of how near the template is to losing rank.
    pub pivot_ratio: f64,
}

/// Coefficients of `f_2..f_6`, each equation scaled to norm one.
fn coefficients(problem: &GenericProblem) -> [[f64; 40]; 5] {
    let (forms, norm) = (rotation_forms(), norm_form());
    std::array::from_fn(|i| {
        let (a, b) = (&problem.base[i], &problem.platform[i]);
        let constant = problem.first - problem.others[i] + a.norm_squared() + b.norm_squared();
        let mut out = [0.0; 40];
        for (k, (form, n)) in forms.iter().zip(norm).enumerate() {
            let arm = form * b;
            let linear = (arm - a * n) * 2.0;
            out[4 * k] = n * constant - 2.0 * a.dot(&arm);
            out[4 * k + 1..4 * k + 4].copy_from_slice(linear.as_slice());
        }
        let size = out.iter().map(|x| x * x).sum::<f64>().sqrt();
        out.map(|x| x / size)
    })
}

impl TemplateLayout {
    /// Writes the coefficients of a problem into the template.
    #[must_use]
    pub fn fill(&self, problem: &GenericProblem) -> Filled<'_> {
        let values = coefficients(problem);
        let mut rows = vec![vec![0.0; self.excessive + self.reducible + self.basic]; self.rows];
        for f in &self.fills {
            let factor = if f.times_first { problem.first * f.sign } else { f.sign };
            rows[usize::from(f.row)][usize::from(f.column)] +=
                factor * values[usize::from(f.equation)][usize::from(f.term)];
        }
        Filled { layout: self, rows }
    }
}

impl<'a> Filled<'a> {
    /// Entries that are zero, as a share.
    #[must_use]
    pub fn zeros(&self) -> f64 {
        let [rows, columns] = self.layout.size();
        let zeros = self.rows.iter().flatten().filter(|x| **x == 0.0).count();
        zeros as f64 / (rows * columns) as f64
    }

    /// LU factorisation with partial pivoting: the last 38 rows of `U` are free of excessive monomials.
    #[must_use]
    pub fn eliminate(&self) -> Eliminated<'a> {
        let upper = upper_factor(&self.rows);
        let pivots = (0..upper.len()).map(|k| upper[k][k].abs());
        let (smallest, largest) = pivots.fold((f64::INFINITY, 0.0), |(a, b), p| (p.min(a), p.max(b)));
        let rows = upper[self.layout.excessive..].iter().map(|r| r[self.layout.excessive..].to_vec());
        Eliminated { layout: self.layout, rows: rows.collect(), pivot_ratio: smallest / largest }
    }
}

impl Eliminated<'_> {
    /// Whether the template keeps its rank on this problem.
    #[must_use]
    pub fn has_rank(&self) -> bool {
        self.pivot_ratio > PIVOT_LIMIT
    }

    /// Eigenpairs of the pencil `(1/w) T_1 v = T_0 v`, 69 of them.
    ///
    /// # Errors
    /// When the QZ iteration does not converge.
    pub fn eigenpairs(&self) -> Result<Vec<GeneralizedEigenpair>, LinalgError> {
        let l = self.layout;
        let (mut t0, mut t1) = (vec![vec![0.0; l.basic]; l.basic], vec![vec![0.0; l.basic]; l.basic]);
        let mut equations = self.rows.iter();
        for (i, quotient) in l.quotients.iter().enumerate() {
            if let DividedMonomial::Basic(j) = quotient {
                t0[i][*j] = 1.0;
                t1[i][i] = 1.0;
            } else if let Some(equation) = equations.next() {
                let size = equation.iter().map(|x| x * x).sum::<f64>().sqrt();
                for (k, q) in l.quotients.iter().enumerate() {
                    if let DividedMonomial::Reducible(r) = q {
                        t1[i][k] = equation[*r] / size;
                    }
                    t0[i][k] = -equation[l.reducible + k] / size;
                }
            }
        }
        generalized_eigenpairs(&t0, &t1)
    }
}

impl TemplateLayout {
    /// The candidate that an eigenvector holds, read from `w (1, u, v, w, x, y, z)` (Martyushev, eq. 17).
    #[must_use]
    pub fn candidate(&self, pair: &GeneralizedEigenpair) -> RawCandidate {
        let [w, uw, vw, ww, xw, yw, zw] = self.coordinates.map(|k| pair.vector[k]);
        RawCandidate { quaternion: [w, uw, vw, ww], position: Vector3::new(xw / w, yw / w, zw / w) }
    }

    /// The pose an eigenvector points to, in the design's frames, not checked against any equation; `None` when the
    /// eigenvalue or the coordinates are at infinity or `e.e = 0`.
    #[must_use]
    pub fn pose(&self, problem: &GenericProblem, pair: &GeneralizedEigenpair) -> Option<ComplexPose> {
        // an eigenvalue 1/w = alpha/beta at infinity is w = 0, which no pose has in random frames
        if !(pair.beta.norm() > f64::EPSILON * pair.alpha.norm()) {
            return None;
        }
        problem.pose(&self.candidate(pair))
    }
}
