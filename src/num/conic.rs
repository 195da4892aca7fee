//! The only interface to the conic solver clarabel (Goulart, Chen 2024).
//!
//! A program is `minimise 1/2 x^T P x + q^T x` subject to `b - A x in K`, given row by row. Its status is translated
//! and always checked: points by plain arithmetic on the rows, infeasibility certificates in intervals by
//! `num::farkas`.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettings, DefaultSolver, IPSolver, NonnegativeConeT, SecondOrderConeT, SolverStatus,
    SupportedConeT,
};

/// `rhs - sum coefficients x`, which must be in the cone of its block.
#[derive(Debug, Clone)]
pub struct ConicRow {
    /// Pairs of variable and coefficient.
    pub coefficients: Vec<(usize, f64)>,
    /// The constant.
    pub rhs: f64,
}

/// A block of consecutive rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cone {
    /// Every entry at least 0.
    NonNegative(usize),
    /// First entry at least the norm of the others.
    SecondOrder(usize),
}

/// A conic program with a convex quadratic objective.
#[derive(Debug, Clone, Default)]
pub struct ConicProgram {
    /// Number of variables.
    pub variables: usize,
    /// Upper triangle of `P`: (row, column, value), row at most column.
    pub quadratic: Vec<(usize, usize, f64)>,
    /// Linear part of the objective.
    pub linear: Vec<f64>,
    /// The constraints, block after block.
    pub rows: Vec<ConicRow>,
    /// The blocks.
    pub cones: Vec<Cone>,
}

/// A point with its multipliers; `residual` is the largest violation found by plain arithmetic.
#[derive(Debug, Clone)]
pub struct ConicPoint {
    /// The variables.
    pub x: Vec<f64>,
    /// One multiplier per row, in the dual cone.
    pub dual: Vec<f64>,
    /// Largest violation.
    pub residual: f64,
}

/// Answer of the conic solver.
#[derive(Debug, Clone)]
pub enum ConicAnswer {
    /// A point; accept it by its residual.
    Point(ConicPoint),
    /// Claimed infeasible, with an unchecked dual ray.
    Infeasible(Vec<f64>),
    /// The solver failed.
    Failed(SolverFailure),
}

crate::words! {
    /// The reason why the conic solver gave no answer.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum SolverFailure as words, Display {
        /// The data were refused.
        Data = "the conic solver refused the data",
        /// Claimed unbounded.
        Unbounded = "the conic solver called the subproblem unbounded",
        /// Iteration or time limit.
        Limit = "the conic solver reached its iteration limit",
        /// Numerical trouble or no progress.
        Numerical = "the conic solver met numerical trouble",
        /// The point returned violates the constraints more than the accepted residual.
        Residual = "the conic solver's point does not satisfy the constraints",
    }
}

/// Counts the programs of a search; clones count together.
#[derive(Debug, Clone, Default)]
pub struct ConicTally(Arc<AtomicU64>);

impl ConicTally {
    /// Number of programs given to clarabel.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }
}

impl ConicProgram {
    /// Appends one linear inequality `rhs - coefficients . x >= 0`.
    pub fn at_least_zero(&mut self, coefficients: Vec<(usize, f64)>, rhs: f64) {
        self.rows.push(ConicRow { coefficients, rhs });
        match self.cones.last_mut() {
            Some(Cone::NonNegative(n)) => *n += 1,
            _ => self.cones.push(Cone::NonNegative(1)),
        }
    }

    /// Appends `rows[0] >= |rows[1..]|`.
    pub fn second_order(&mut self, rows: Vec<ConicRow>) {
        self.cones.push(Cone::SecondOrder(rows.len()));
        self.rows.extend(rows);
    }

    fn slacks(&self, x: &[f64]) -> Vec<f64> {
        let value = |r: &ConicRow| r.rhs - r.coefficients.iter().map(|&(j, a)| a * x[j]).sum::<f64>();
        self.rows.iter().map(value).collect()
    }

    /// Largest cone violation of `b - A x` (0 when inside all cones).
    pub fn violation(&self, x: &[f64]) -> f64 {
        cone_violation(&self.cones, &self.slacks(x))
    }

    fn matrix(&self) -> CscMatrix<f64> {
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.variables];
        for (i, row) in self.rows.iter().enumerate() {
            for &(j, a) in &row.coefficients {
                columns[j].push((i, a));
            }
        }
        csc(self.rows.len(), &columns)
    }

    fn objective_matrix(&self) -> CscMatrix<f64> {
        let mut columns: Vec<Vec<(usize, f64)>> = vec![Vec::new(); self.variables];
        for &(i, j, v) in &self.quadratic {
            columns[j].push((i, v));
        }
        csc(self.variables, &columns)
    }

    /// Solves the program, sequentially and without output.
    pub fn solve(&self, tally: &ConicTally) -> ConicAnswer {
        tally.0.fetch_add(1, Ordering::Relaxed);
        let settings =
            DefaultSettings::<f64> { verbose: false, max_iter: 80, max_threads: 1, ..Default::default() };
        let cones: Vec<SupportedConeT<f64>> = self
            .cones
            .iter()
            .map(|c| match *c {
                Cone::NonNegative(n) => NonnegativeConeT(n),
                Cone::SecondOrder(n) => SecondOrderConeT(n),
            })
            .collect();
        let rhs: Vec<f64> = self.rows.iter().map(|r| r.rhs).collect();
        let (p, a) = (self.objective_matrix(), self.matrix());
        let Ok(mut solver) = DefaultSolver::new(&p, &self.linear, &a, &rhs, &cones, settings) else {
            return ConicAnswer::Failed(SolverFailure::Data);
        };
        solver.solve();
        let found = &solver.solution;
        match found.status {
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                ConicAnswer::Infeasible(found.z.clone())
            }
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => {
                ConicAnswer::Failed(SolverFailure::Unbounded)
            }
            SolverStatus::MaxIterations | SolverStatus::MaxTime => ConicAnswer::Failed(SolverFailure::Limit),
            // a stalled solver is often at a good point: its residual decides
            SolverStatus::Solved | SolverStatus::AlmostSolved | SolverStatus::InsufficientProgress => {
                let residual = self.violation(&found.x);
                ConicAnswer::Point(ConicPoint { x: found.x.clone(), dual: found.z.clone(), residual })
            }
            SolverStatus::NumericalError | SolverStatus::CallbackTerminated | SolverStatus::Unsolved => {
                ConicAnswer::Failed(SolverFailure::Numerical)
            }
        }
    }
}

fn csc(rows: usize, columns: &[Vec<(usize, f64)>]) -> CscMatrix<f64> {
    let mut starts = vec![0];
    let (mut indices, mut values) = (Vec::new(), Vec::new());
    for column in columns {
        indices.extend(column.iter().map(|c| c.0));
        values.extend(column.iter().map(|c| c.1));
        starts.push(indices.len());
    }
    CscMatrix::new(rows, columns.len(), starts, indices, values)
}

/// NaN counts as an infinite violation.
fn cone_violation(cones: &[Cone], s: &[f64]) -> f64 {
    let mut at = 0;
    let mut worst = 0f64;
    for cone in cones {
        let n = match *cone {
            Cone::NonNegative(n) | Cone::SecondOrder(n) => n,
        };
        let block = &s[at..at + n];
        let miss = match cone {
            Cone::NonNegative(_) => {
                block.iter().fold(0.0, |m: f64, v| if v.is_nan() { f64::INFINITY } else { m.max(-v) })
            }
            Cone::SecondOrder(_) => block[1..].iter().map(|v| v * v).sum::<f64>().sqrt() - block[0],
        };
        worst = if miss.is_nan() { f64::INFINITY } else { worst.max(miss) };
        at += n;
    }
    worst
}

#[cfg(test)]
mod tests {
    use super::*;

    fn disc() -> ConicProgram {
        // |(x, y)| <= 1
        let mut p = ConicProgram { variables: 2, linear: vec![-1.0, -1.0], ..Default::default() };
        let row = |j: Option<usize>, rhs| ConicRow {
            coefficients: j.map(|j| (j, -1.0)).into_iter().collect(),
            rhs,
        };
        p.second_order(vec![row(None, 1.0), row(Some(0), 0.0), row(Some(1), 0.0)]);
        p
    }

    #[test]
    fn maximises_a_linear_function_on_the_disc() {
        let ConicAnswer::Point(p) = disc().solve(&ConicTally::default()) else { panic!("no point") };
        let s = 0.5f64.sqrt();
        assert!((p.x[0] - s).abs() < 1e-6 && (p.x[1] - s).abs() < 1e-6 && p.residual < 1e-7);
        // negative control: plain arithmetic detects a point outside
        assert!((disc().violation(&[1.0, 1.0]) - (2f64.sqrt() - 1.0)).abs() < 1e-12);
        assert!(disc().violation(&[f64::NAN, 0.0]).is_infinite());
    }

    #[test]
    fn the_ray_of_an_infeasible_program_refutes_it_and_not_its_feasible_neighbour() {
        use crate::farkas::{EnclosedRow, refuted};
        use crate::interval::Interval;
        let mut p = disc();
        p.at_least_zero(vec![(0, -1.0)], -2.0); // x >= 2
        let ConicAnswer::Infeasible(ray) = p.solve(&ConicTally::default()) else { panic!("not infeasible") };
        let strength = |p: &ConicProgram, ray: &[f64]| {
            let row = |r: &ConicRow| EnclosedRow {
                coefficients: r.coefficients.iter().map(|c| (c.0, c.1.into())).collect(),
                rhs: r.rhs.into(),
            };
            let rows: Vec<EnclosedRow> = p.rows.iter().map(row).collect();
            refuted(&rows, &p.cones, ray, &[Interval::new(-10.0, 10.0).unwrap(); 2])
        };
        assert!(strength(&p, &ray).is_some_and(|s| s > 0.1));
        let mut wrong = ray.clone();
        wrong[3] = -wrong[3];
        assert_eq!(strength(&p, &wrong), None);
        // the same ray proves nothing about the feasible neighbour x >= 0.5
        p.rows[3].rhs = -0.5;
        assert_eq!(strength(&p, &ray), None);
    }

    #[test]
    fn clones_of_a_tally_count_together() {
        let tally = ConicTally::default();
        let other = tally.clone();
        disc().solve(&tally);
        disc().solve(&other);
        assert_eq!((tally.count(), other.count()), (2, 2));
    }

    #[test]
    fn rescaled_rows_give_the_same_point() {
        for k in [-3, 0, 3] {
            let mut p = disc();
            let scale = 10f64.powi(k);
            p.rows.iter_mut().for_each(|r| {
                r.rhs *= scale;
                r.coefficients.iter_mut().for_each(|c| c.1 *= scale);
            });
            let ConicAnswer::Point(found) = p.solve(&ConicTally::default()) else {
                panic!("no point at {k}")
            };
            assert!((found.x[0] - 0.5f64.sqrt()).abs() < 1e-5);
        }
    }
}
