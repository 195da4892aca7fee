//! The published eliminations alone: their candidates before any refinement, and the time of each step.
//!
//! The errors follow Martyushev (2025), sec. 5.1, in randomly rotated frames and in the units of the design.

use std::time::Instant;

use super::error_metric::{MacaulayMatrix, epsilon};
use super::generator::Problem;
use super::statistics::{ErrorStatistics, error_statistics, quantile};
use fk::Method;
use fk::solve::generic_frame::{GenericProblem, RawCandidate};
use fk::solve::sylvester::Eliminant;
use fk::solve::template::TemplateLayout;
use num::Purpose;

/// Number of poses of a general platform; only this number of candidates, those with the smallest residuals, count.
const POSES: usize = 40;
/// Width of a bin of the histogram of errors.
const BIN: f64 = 0.5;

/// A published elimination.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Elimination {
    /// Lee, Shim: a determinant of degree 40.
    Sylvester,
    /// Martyushev: a template of 293 rows.
    Template,
}

/// The result of one problem's elimination.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RawOutcome {
    /// Residuals of the candidates, eq. (18), ascending; `None` if the elimination does not apply.
    residuals: Option<Vec<f64>>,
    /// Share of zeros in the matrix of the template.
    zeros: f64,
    steps_us: [f64; 3],
}

/// The matrix of an elimination.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "EliminationMatrixRecord", transform = num::nullable))]
pub struct EliminationMatrix {
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Median share of zero entries; null: not counted.
    pub zeros: Option<f64>,
}

/// The ratio between the fortieth residual and the next one, as a decimal logarithm.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "GapRecord", transform = num::nullable))]
pub struct GapStatistics {
    // as in Table 1 of the paper
    /// The median.
    pub median: f64,
    /// The mean.
    pub mean: f64,
}

/// A bin of the histogram of errors.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "ErrorBinRecord", transform = num::nullable))]
pub struct ErrorBin {
    /// The lower end, decimal logarithm.
    pub from: f64,
    /// The upper end, decimal logarithm; it belongs to the next bin.
    pub to: f64,
    /// Number of problems.
    pub count: u64,
}

/// Time of a step of an elimination.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "StepTimeRecord", transform = num::nullable))]
pub struct StepTime {
    /// Name of the step: `template`, `plu`, `qz` as in Table 2 of Martyushev, or `determinants`, `roots`,
    /// `back_substitution`.
    pub step: &'static str,
    /// The median time, microseconds.
    pub median_us: f64,
    /// Library; null: equipod itself.
    pub library: Option<&'static str>,
}

/// Candidates of an elimination before refinement, over the problems of a class.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "RawRecord", transform = num::nullable))]
pub struct RawReport {
    /// The matrix.
    pub matrix: EliminationMatrix,
    /// Number of candidates; forty of them are poses.
    pub candidates: usize,
    /// Number of problems with a degenerate elimination; the statistics leave them out.
    pub refused: u64,
    /// Number of problems with fewer than forty finite candidates; the statistics leave them out.
    pub infinite: u64,
    /// Error of the forty best candidates (Martyushev, eq. 19), decimal logarithm; null: all problems degenerate.
    pub epsilon: Option<ErrorStatistics>,
    /// Ratio of the fortieth to the next residual, decimal logarithm (Martyushev, Table 1); null: there is no next one.
    pub gap: Option<GapStatistics>,
    /// Histogram of the error (Martyushev, Fig. 3a).
    pub bins: Vec<ErrorBin>,
    /// Times by step, in order.
    pub steps: Vec<StepTime>,
}

impl Elimination {
    /// The elimination of a method, if it is one.
    #[must_use]
    pub fn of(method: Method) -> Option<Self> {
        match method {
            Method::Sylvester => Some(Self::Sylvester),
            Method::Template => Some(Self::Template),
            _ => None,
        }
    }

    /// One elimination of problem `k`, in frames drawn for this problem.
    pub(super) fn measure(self, problem: &Problem, seed: u64, k: u64) -> RawOutcome {
        let rng = &mut Purpose::GENERIC_FRAMES.item(seed, k);
        let framed = GenericProblem::draw(&problem.manipulator, &problem.squares, rng);
        let mut times = StepTimes { begin: Instant::now(), laps: Vec::new(), zeros: 0.0 };
        let candidates = match self {
            Self::Template => by_template(&framed, &mut times),
            Self::Sylvester => by_determinant(&framed, &mut times),
        };
        let matrix = MacaulayMatrix::of(&framed.unscaled());
        let residuals = candidates.map(|candidates| {
            let mut residuals: Vec<f64> =
                candidates.iter().map(|c| matrix.residual(&framed.in_units(c))).collect();
            residuals.sort_by(f64::total_cmp);
            residuals
        });
        let steps_us = std::array::from_fn(|i| times.laps.get(i).copied().unwrap_or(0.0));
        RawOutcome { residuals, zeros: times.zeros, steps_us }
    }

    /// Statistics over the problems.
    pub(super) fn report(self, outcomes: &[RawOutcome]) -> RawReport {
        let sorted: Vec<&[f64]> = outcomes.iter().filter_map(|o| o.residuals.as_deref()).collect();
        let errors =
            sorted.iter().map(|r| epsilon(r.iter().copied().chain([f64::INFINITY; POSES]).take(POSES)));
        let errors: Vec<f64> = errors.filter(|e| e.is_finite()).collect();
        let gaps = sorted.iter().filter_map(|r| Some((r.get(POSES - 1)? / r.get(POSES)?).log10()));
        let gaps: Vec<f64> = gaps.filter(|g| g.is_finite()).collect();
        let eliminated: Vec<&RawOutcome> = outcomes.iter().filter(|o| o.residuals.is_some()).collect();
        let steps = self.steps().into_iter().enumerate().map(|(i, (step, library))| StepTime {
            step,
            median_us: quantile(eliminated.iter().map(|o| o.steps_us[i]), 0.5),
            library,
        });
        RawReport {
            matrix: self.matrix(quantile(outcomes.iter().map(|o| o.zeros), 0.5)),
            candidates: self.candidates(),
            refused: (outcomes.len() - sorted.len()) as u64,
            infinite: (sorted.len() - errors.len()) as u64,
            epsilon: (!errors.is_empty()).then(|| error_statistics(&errors)),
            gap: (!gaps.is_empty()).then(|| GapStatistics {
                median: quantile(gaps.iter().copied(), 0.5),
                mean: gaps.iter().sum::<f64>() / gaps.len() as f64,
            }),
            bins: histogram(&errors),
            steps: steps.collect(),
        }
    }

    fn steps(self) -> [(&'static str, Option<&'static str>); 3] {
        match self {
            Self::Template => [("template", None), ("plu", Some("faer")), ("qz", Some("faer"))],
            Self::Sylvester => [("determinants", None), ("roots", None), ("back_substitution", None)],
        }
    }

    fn matrix(self, zeros: f64) -> EliminationMatrix {
        match (self, TemplateLayout::shipped()) {
            (Self::Template, Ok(layout)) => {
                let [rows, columns] = layout.size();
                EliminationMatrix { rows, columns, zeros: Some(zeros) }
            }
            _ => EliminationMatrix { rows: Eliminant::MATRIX, columns: Eliminant::MATRIX, zeros: None },
        }
    }

    fn candidates(self) -> usize {
        match (self, TemplateLayout::shipped()) {
            (Self::Template, Ok(layout)) => layout.candidates(),
            _ => Eliminant::DEGREE,
        }
    }
}

/// Measures the times of steps; zeros are counted outside these times.
struct StepTimes {
    begin: Instant,
    laps: Vec<f64>,
    zeros: f64,
}

impl StepTimes {
    /// Ends a step and records its time.
    fn lap(&mut self) {
        let now = Instant::now();
        self.laps.push(now.duration_since(self.begin).as_secs_f64() * 1e6);
        self.begin = now;
    }
}

/// The candidates of the template; `None` if it loses rank.
fn by_template(problem: &GenericProblem, times: &mut StepTimes) -> Option<Vec<RawCandidate>> {
    let layout = TemplateLayout::shipped().ok()?;
    let filled = layout.fill(problem);
    times.lap();
    times.zeros = filled.zeros();
    times.begin = Instant::now();
    let eliminated = filled.eliminate();
    times.lap();
    let pairs = eliminated.has_rank().then(|| eliminated.eigenpairs().ok())??;
    times.lap();
    Some(pairs.iter().map(|pair| layout.candidate(pair)).collect())
}

/// The candidates of the determinant; `None` if it is not a polynomial of degree 40.
fn by_determinant(problem: &GenericProblem, times: &mut StepTimes) -> Option<Vec<RawCandidate>> {
    let eliminant = Eliminant::of(problem).ok()?;
    times.lap();
    let roots = eliminant.roots();
    times.lap();
    let candidates = roots.into_iter().filter_map(|c3| eliminant.candidate(c3)).collect();
    times.lap();
    Some(candidates)
}

/// The bins from the smallest error to the largest one.
fn histogram(errors: &[f64]) -> Vec<ErrorBin> {
    let bin = |error: f64| (error / BIN).floor() as i64;
    let places: Vec<i64> = errors.iter().copied().map(bin).collect();
    let (Some(first), Some(last)) = (places.iter().min(), places.iter().max()) else { return Vec::new() };
    let at = |place: i64| ErrorBin {
        from: place as f64 * BIN,
        to: (place + 1) as f64 * BIN,
        count: places.iter().filter(|p| **p == place).count() as u64,
    };
    (*first..=*last).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::{Class, LengthsFrom, problem};

    #[test]
    fn candidates_of_both_eliminations_have_the_errors_of_their_arithmetic() {
        let outcome =
            |e: Elimination, class, k| e.measure(&problem(class, LengthsFrom::Uniform, 1, k).unwrap(), 1, k);
        let report = |e: Elimination, class| e.report(&[0, 1].map(|k| outcome(e, class, k)));
        let template = report(Elimination::Template, Class::General);
        assert_eq!((template.matrix.rows, template.matrix.columns, template.candidates), (293, 362, 69));
        assert_eq!((template.refused, template.infinite), (0, 0));
        assert!(
            (template.matrix.zeros.unwrap() - 0.90).abs() < 0.005,
            "published: 90 %, {:?}",
            template.matrix
        );
        let error = template.epsilon.unwrap();
        assert!((-13.0..-6.0).contains(&error.median), "doubles: {error:?}");
        assert!(template.gap.unwrap().mean < -4.0);
        assert_eq!(template.bins.iter().map(|b| b.count).sum::<u64>(), 2);
        assert!(template.steps.iter().all(|s| s.median_us > 0.0));
        let determinant = report(Elimination::Sylvester, Class::General);
        assert!(determinant.epsilon.unwrap().max < -10.0, "pairs of doubles: {determinant:?}");
        assert_eq!((determinant.candidates, determinant.gap), (40, None));
        let planar = report(Elimination::Template, Class::BothPlanar);
        assert_eq!((planar.refused, planar.epsilon, planar.bins.len()), (2, None, 0));
    }
}
