//! The intermediate polynomials `Theta_n`, `Phi_n` at a value of `c_3`, as polynomials in `c_1, c_2`.

use num_complex::Complex64;

use super::SylvesterError;
use super::bivariate::{Bivariate, place};
use super::elimination::Triangularised;
use crate::solve::generic_frame::{GenericProblem, PRODUCTS, norm_form, rotation_forms};
use num::double_double::{ComplexDoubleDouble as Number, DoubleDouble};

/// Below this pivot ratio the five equations linear in `(q, p)` are dependent to rounding.
const LINEAR_LIMIT: f64 = 1e-11;

/// Below this pivot ratio the two cubics whose Sylvester matrix lowers degree five have a common root.
const CUBIC_LIMIT: f64 = 1e-11;

type Triple = [Bivariate; 3];

/// `(q, p) = (u_q, u_p) + lambda (n_q, n_p)`: all solutions of the five leg equations linear in `(q, p)`.
#[derive(Debug, Clone)]
pub(super) struct ReducedEquations {
    /// `N u`, six quadratic forms in `(1, c_1, c_2, c_3)`.
    particular: [[Number; 10]; 6],
    null: [Number; 6],
    /// Squared length of leg 1.
    first: Number,
}

/// Everything at one value of `c_3`.
#[derive(Debug, Clone)]
pub(super) struct Slice {
    /// `Theta_1, Theta_2, Theta_3`.
    pub(super) theta: Triple,
    /// Numerators of `p` from each of the three rows, and their denominators.
    pub(super) numerators: [Triple; 3],
    pub(super) denominators: Triple,
    first: Number,
}

fn real(x: DoubleDouble) -> Number {
    Number { re: x, im: DoubleDouble::ZERO }
}

fn double(x: f64) -> Number {
    Number::from(Complex64::new(x, 0.0))
}

impl ReducedEquations {
    /// Solves `b_i^T q - a_i^T p = a_i^T R b_i - (|a_i|^2 + |b_i|^2 - L_i + L_1) / 2`, `i = 2..6`, exactly rounded
    /// to double-double, for `N q, N p` as forms in the quaternion `(1, c)` (Lee, Shim, eqs. 8 and 14).
    pub(super) fn of(problem: &GenericProblem) -> Result<Self, SylvesterError> {
        let (forms, norm) = (rotation_forms(), norm_form());
        let rows = (0..5).map(|i| {
            let (a, b) = (&problem.base[i], &problem.platform[i]);
            let square = |v: &nalgebra::Vector3<f64>| {
                v.iter().fold(DoubleDouble::ZERO, |s, x| s + DoubleDouble::from_product(*x, *x))
            };
            let lengths = DoubleDouble::from_sum(problem.first, -problem.others[i]);
            let constant = (square(a) + square(b) + lengths).scaled(0.5);
            let mut row: Vec<Number> = b.iter().copied().chain(a.iter().map(|x| -x)).map(double).collect();
            row.extend(forms.iter().zip(norm).map(|(form, n)| {
                let mut sum = -constant * DoubleDouble::from(n);
                for r in 0..3 {
                    for c in 0..3 {
                        // entries of the forms are 0, 1, 2 in modulus
                        sum = sum + DoubleDouble::from_product(a[r], b[c]) * DoubleDouble::from(form[(r, c)]);
                    }
                }
                real(sum)
            }));
            row
        });
        let eliminated = Triangularised::new(rows.collect(), 6);
        let pivot_ratio = eliminated.pivot_ratio();
        if !(pivot_ratio > LINEAR_LIMIT) {
            return Err(SylvesterError::DependentLegs { pivot_ratio });
        }
        let columns: Vec<Vec<Number>> = (0..10).map(|k| eliminated.solution(k)).collect();
        let null = eliminated.null_vector();
        Ok(Self {
            particular: std::array::from_fn(|i| std::array::from_fn(|k| columns[k][i])),
            null: std::array::from_fn(|i| null[i]),
            first: double(problem.first),
        })
    }

    /// The polynomials at `c_3`.
    pub(super) fn slice(&self, c3: Number) -> Slice {
        let one = double(1.0);
        let monomial = |(i, j): (usize, usize)| {
            let (mut z, mut at) = (one, [0; 2]);
            for index in [i, j] {
                match index {
                    0 => {}
                    3 => z = z * c3,
                    _ => at[index - 1] += 1,
                }
            }
            (z, at)
        };
        let form = |coefficients: &[Number; 10]| {
            let terms = coefficients.iter().zip(PRODUCTS);
            terms.fold(Bivariate::ZERO, |sum, (c, product)| {
                let (z, [i, j]) = monomial(product);
                sum.plus(&Bivariate::monomial(*c * z, i, j))
            })
        };
        let u: [Bivariate; 6] = std::array::from_fn(|i| form(&self.particular[i]));
        let n: [Bivariate; 6] = std::array::from_fn(|i| Bivariate::monomial(self.null[i], 0, 0));
        let delta = form(&norm_form().map(double));
        let (mu, nu) = (closure(&u, c3), closure(&n, c3));
        let cross = |i: usize, j: usize| mu[i].product(&nu[j]).minus(&mu[j].product(&nu[i]));
        Slice {
            // the terms of degree four in c_1, c_2 cancel in Theta_3
            theta: [cross(1, 2), cross(2, 0), cross(0, 1).truncated(3)],
            numerators: std::array::from_fn(|k| {
                std::array::from_fn(|x| u[3 + x].product(&nu[k]).minus(&mu[k].times(self.null[3 + x])))
            }),
            denominators: std::array::from_fn(|k| delta.product(&nu[k])),
            first: self.first,
        }
    }
}

/// `(q - p) + c x (q + p)`, which vanishes when `q = R^T p` (Lee, Shim, eqs. 10-12).
fn closure(u: &[Bivariate; 6], c3: Number) -> Triple {
    let sum: Triple = std::array::from_fn(|k| u[k].plus(&u[3 + k]));
    let difference: Triple = std::array::from_fn(|k| u[k].minus(&u[3 + k]));
    [
        difference[0].plus(&sum[2].shifted(0, 1)).minus(&sum[1].times(c3)),
        difference[1].plus(&sum[0].times(c3)).minus(&sum[2].shifted(1, 0)),
        difference[2].plus(&sum[1].shifted(1, 0)).minus(&sum[0].shifted(0, 1)),
    ]
}

impl Slice {
    /// `Phi`: `p.p = L_1` with `p` from rows `k` and `l`, degree six.
    fn phi(&self, k: usize, l: usize) -> Bivariate {
        let (a, b) = (&self.numerators[k], &self.numerators[l]);
        let square = (0..3).fold(Bivariate::ZERO, |s, x| s.plus(&a[x].product(&b[x])));
        square.minus(&self.denominators[k].product(&self.denominators[l]).times(self.first))
    }

    /// `c_1^(5-n) c_2^n` in terms of degree four and lower, `n = 0..=5` (Lee, Shim, eq. 20).
    ///
    /// `c_3` times the first three equations is subtracted from the last three. The remaining terms of degree five are
    /// the constant Sylvester matrix of two binary cubics.
    fn lowered(&self, c3: Number) -> Result<[Bivariate; 6], SylvesterError> {
        let [t1, t2, t3] = &self.theta;
        let p = [t1.shifted(1, 0), t2.shifted(1, 0), t2.shifted(0, 1)];
        let q = [t3.shifted(2, 0), t3.shifted(1, 1), t3.shifted(0, 2)];
        let lower = p.iter().zip(&q).map(|(p, q)| q.minus(&p.times(c3)));
        let rows = p.iter().copied().chain(lower).map(|r| {
            let top = (0..6).map(|j| r.at(5 - j, j)).collect::<Vec<_>>();
            top.into_iter().chain(r.up_to(4).iter().map(|z| -*z)).collect::<Vec<_>>()
        });
        let eliminated = Triangularised::new(rows.collect(), 6);
        let pivot_ratio = eliminated.pivot_ratio();
        if !(pivot_ratio > CUBIC_LIMIT) {
            return Err(SylvesterError::CommonFactor { pivot_ratio });
        }
        let mut out = [Bivariate::ZERO; 6];
        for d in 0..=4 {
            for j in 0..=d {
                let column = eliminated.solution(place(d - j, j));
                for (o, z) in out.iter_mut().zip(column) {
                    *o = o.plus(&Bivariate::monomial(z, d - j, j));
                }
            }
        }
        Ok(out)
    }

    /// The 15 x 15 matrix at `c_3` (Lee, Shim, eqs. 33-38), columns `1, c_1, c_2, c_1^2, ..`.
    pub(super) fn matrix(&self, c3: Number) -> Result<Vec<Vec<Number>>, SylvesterError> {
        let lower = self.lowered(c3)?;
        let [t1, t2, t3] = &self.theta;
        let pairs = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];
        let phi = pairs.map(|(k, l)| self.phi(k, l).reduced(&lower));
        let shifted = |p: &Bivariate, a: usize, b: usize| p.shifted(a, b).reduced(&lower);
        let mixed = phi[1].shifted(1, 0).times(t1.at(4, 0)).plus(&phi[1].shifted(0, 1).times(t1.at(3, 1)));
        let rows = [*t1, *t2, *t3, t3.shifted(1, 0), t3.shifted(0, 1)].into_iter().chain(phi).chain([
            shifted(&phi[0], 1, 0),
            shifted(&phi[0], 0, 1),
            shifted(&phi[0], 1, 1),
            mixed.reduced(&lower),
        ]);
        Ok(rows.map(|r| r.up_to(4).to_vec()).collect())
    }
}
