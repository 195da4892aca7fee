//! The calibration of a machine, with all measures of its reliability.

use nalgebra::{DMatrix, Matrix6, Vector6};
use thiserror::Error;

use super::chi_square::{chi_square_exceeds, chi_square_quantile};
use super::exchanged::exchanged;
use super::fit::{CalibrationFit, FitProblem};
use super::model::{HeldParts, LegModel, Measurement, Unknowns};
use super::noise::{MeasurementNoise, NoiseSource};
use super::observability::Observability;
use super::robust::{Loss, LossUnit, PoseWeight};
use super::spectrum::{FitSpectrum, deletion};
use super::start::closed_form;
use platform::manipulator::InvalidManipulator;

/// Measurements of a right model have a larger chi-square with this probability.
const REFUTED: f64 = 1e-3;
/// Measurements of a right model have an outlier among them with this probability.
const OUTLIER: f64 = 0.01;
/// Two fits that differ by less than this share of the greatest standard deviation are the same.
const SAME_END: f64 = 0.01;

/// Options of a calibration.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct CalibrateOptions {
    /// Noise of the measurements; `None`: equal for all lengths, zero for poses, with the amount estimated from the
    /// residuals.
    pub noise: Option<MeasurementNoise>,
    /// The loss function of the fit.
    pub loss: Loss,
    /// Whether gross errors are expected in whole poses or in single lengths.
    pub loss_unit: LossUnit,
    /// Parameters that the fit keeps.
    pub held: HeldParts,
    /// The start of the fit.
    pub start: StartChoice,
    /// The greatest standard deviation, as a share of the size of the design, at which a direction counts as
    /// identified.
    pub identified: f64,
}

impl Default for CalibrateOptions {
    fn default() -> Self {
        Self {
            noise: None,
            loss: Loss::Squares,
            loss_unit: LossUnit::Pose,
            held: HeldParts::default(),
            start: StartChoice::Best,
            identified: 0.01,
        }
    }
}

impl CalibrateOptions {
    num::setters! {
        /// Noise of the measurements; `None`: equal for all lengths, zero for poses.
        fn noise(noise: impl Into<Option<MeasurementNoise>>) = noise.into();
        /// The loss function of the fit.
        fn loss(loss: Loss) = loss;
        /// Whether gross errors are expected in whole poses or in single lengths.
        fn loss_unit(loss_unit: LossUnit) = loss_unit;
        /// Parameters that the fit keeps.
        fn held(held: HeldParts) = held;
        /// The start of the fit.
        fn start(start: StartChoice) = start;
        /// The greatest standard deviation, as a share of the size, at which a direction counts as identified.
        fn identified(identified: f64) = identified;
    }
}

num::words! {
    /// The start of a fit.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum StartChoice as name {
        /// Both starts; the better result is taken.
        #[default]
        Best = "best",
        /// The nominal joints.
        Nominal = "nominal",
        /// The solution of the linear equations.
        ClosedForm = "closed-form",
    }
}

/// The start whose result was taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum StartName {
    /// The nominal joints.
    Nominal,
    /// The solution of the linear equations.
    ClosedForm,
}

/// The start that was taken, and the result of the other one.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "StartRecord", transform = num::nullable))]
pub struct Starts {
    /// Start taken.
    pub taken: StartName,
    /// Whether both starts agree; null: only one was tried.
    pub agree: Option<bool>,
    /// Misfit from nominal joints: sum of the losses, or estimated deviation of a length; smaller is better; null: not
    /// tried.
    pub nominal: Option<f64>,
    /// Misfit from the linear equations for squared lengths, which need no design; null: not tried, or not determined
    /// by the poses.
    pub closed_form: Option<f64>,
}

/// Reasons why a calibration is impossible.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// No measurement.
    #[error("there are no measurements")]
    NoMeasurements,
    /// A number that is not finite.
    #[error("measurement {} has a number that is not finite", .index + 1)]
    NotFinite {
        /// Its index.
        index: usize,
    },
    /// A standard deviation with a wrong sign or value.
    #[error(
        "the standard deviation of lengths has to be positive and those of poses not negative: {length}, {position}, {rotation}"
    )]
    BadNoise {
        /// Standard deviation of lengths.
        length: f64,
        /// Standard deviation of positions.
        position: f64,
        /// Standard deviation of orientations, radians.
        rotation: f64,
    },
    /// Joints and offsets are all held.
    #[error("joints and offsets are all held: nothing is unknown")]
    NothingUnknown,
    /// A share that is not positive.
    #[error("the greatest deviation of what counts as identified is {0} of the size: it has to be positive")]
    BadShare(f64),
    /// The linear equations have no solution.
    #[error(
        "the measurements do not determine the seventeen quantities of a leg from which a start without the nominal joints is computed"
    )]
    NoClosedForm,
    /// Numbers too large for doubles.
    #[error("the numbers are too large or too small for double precision")]
    Overflow,
    /// The nominal joints make no manipulator.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
}

/// The result of a calibration in a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum CalibrationStatus {
    /// All unknowns are identified, and the data agree with the model.
    Calibrated,
    /// The measurements do not determine some changes of the machine.
    NotIdentifiable,
    /// The residuals are too large for the noise given: the model, the noise or a measurement is wrong.
    Refuted,
    /// The fit did not converge, or there are no more numbers than unknowns.
    Undecided,
}

/// The largest residual.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GreatestResidual {
    /// Index of the measurement.
    pub measurement: usize,
    /// Index of the leg.
    pub leg: usize,
    /// Measured length minus that of the model, design units.
    pub value: f64,
}

/// Sizes of residuals, design units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResidualSpread {
    /// Root mean square.
    pub rms: f64,
    /// Root mean square of each leg, design units.
    pub legs: [f64; 6],
    /// The residual of the largest size; `None` where nothing was counted.
    pub greatest: Option<GreatestResidual>,
    /// Numbers counted.
    pub count: usize,
}

impl ResidualSpread {
    /// The spread of the residuals whose measurement and leg `counted` accepts.
    fn of(residuals: &[Option<Vector6<f64>>], counted: impl Fn(usize, usize) -> bool) -> Self {
        let (mut sums, mut counts) = ([0.0; 6], [0_usize; 6]);
        let mut greatest: Option<GreatestResidual> = None;
        for (measurement, residual) in residuals.iter().enumerate() {
            let Some(residual) = residual else { continue };
            for leg in (0..6).filter(|leg| counted(measurement, *leg)) {
                let value = residual[leg];
                sums[leg] += value * value;
                counts[leg] += 1;
                if greatest.is_none_or(|g| value.abs() > g.value.abs()) {
                    greatest = Some(GreatestResidual { measurement, leg, value });
                }
            }
        }
        let root = |sum: f64, count: usize| if count > 0 { (sum / count as f64).sqrt() } else { 0.0 };
        let count = counts.iter().sum();
        Self {
            rms: root(sums.iter().sum(), count),
            legs: std::array::from_fn(|leg| root(sums[leg], counts[leg])),
            greatest,
            count,
        }
    }
}

/// Agreement of residuals with the noise.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "ChiSquareRecord", transform = num::nullable))]
pub struct ChiSquare {
    /// Sum of squared whitened residuals.
    // outliers are left out if the loss allows for gross errors
    pub value: f64,
    /// Number of residuals minus number of identified unknowns.
    #[cfg_attr(feature = "serde", serde(rename = "degrees_of_freedom"))]
    pub freedoms: usize,
    /// Probability of a larger value by noise; null: the noise is estimated from the same residuals.
    pub probability: Option<f64>,
}

/// A measurement that contradicts the others.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Outlier {
    /// Index of the measurement.
    pub measurement: usize,
    /// Index of the leg if a single length is the outlier.
    pub leg: Option<usize>,
    /// Its distance from the model, in standard deviations.
    pub distance: f64,
    /// Right measurements all stay below this distance with a probability of 99 %.
    pub threshold: f64,
    /// Its weight in the fit.
    pub weight: f64,
}

/// The result of a calibration.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Calibration {
    /// The result in a word.
    pub status: CalibrationStatus,
    /// The machine, in the frames of the measured poses.
    pub model: LegModel,
    /// The unknowns, in the order of the covariance.
    pub unknowns: Unknowns,
    /// `F` with the covariance `F F^T` of the unknowns, design units; directions that are not identified have none.
    pub root: DMatrix<f64>,
    /// The same with the greatest deviation accepted along directions that are not identified.
    pub bounded_root: DMatrix<f64>,
    /// Noise of the measurements.
    pub noise: MeasurementNoise,
    /// Source of the noise.
    pub noise_source: NoiseSource,
    /// The start of the fit.
    pub starts: Starts,
    /// Whether steps and rounds converged.
    pub converged: bool,
    /// Rounds of weights.
    pub rounds: usize,
    /// Number of steps in total.
    pub steps: usize,
    /// Observability of the changes of the machine.
    pub observability: Observability,
    /// Residuals of the nominal machine.
    pub before: ResidualSpread,
    /// Residuals of the calibrated one, without outliers.
    pub after: ResidualSpread,
    /// Residuals of each pose for the machine that the other poses give, to first order, without outliers.
    pub left_out: ResidualSpread,
    /// Measurements without which the unknowns are not determined.
    pub indispensable: Vec<usize>,
    /// Agreement with the noise.
    pub chi_square: ChiSquare,
    /// The farthest first.
    pub outliers: Vec<Outlier>,
    /// Indices of two legs whose measured lengths look exchanged: exchanging them brings the data five times nearer to
    /// the nominal machine.
    pub exchanged: Option<[usize; 2]>,
    /// Weights of the measurements.
    pub weights: Vec<PoseWeight>,
}

impl Calibration {
    /// Standard deviations of the unknowns, design units, in their order.
    #[must_use]
    pub fn deviations(&self) -> Vec<f64> {
        self.root.row_iter().map(|row| row.norm()).collect()
    }

    /// Residuals of other measurements.
    #[must_use]
    pub fn residuals_of(&self, measurements: &[Measurement]) -> ResidualSpread {
        residuals_of(&self.model, measurements)
    }
}

fn residuals_of(model: &LegModel, measurements: &[Measurement]) -> ResidualSpread {
    let all: Vec<_> = measurements.iter().map(|m| Some(model.residual(m))).collect();
    ResidualSpread::of(&all, |_, _| true)
}

/// A root of the covariance before any measurement: every unknown has the deviation `widest`, the greatest one that
/// counts as identified.
#[must_use]
pub fn planning_root(unknowns: &Unknowns, widest: f64) -> DMatrix<f64> {
    DMatrix::identity(unknowns.count(), unknowns.count()) * widest
}

/// Calibrates a machine from measurements: the joints and offsets with the least sum of losses of whitened residuals,
/// in the frames of the measured poses.
///
/// Each round takes the covariances of the residuals, the weights of the loss and the noise, if not given, from the
/// last round. It then minimises the sum of squares by Levenberg-Marquardt steps. Directions that are not identified
/// keep their values of the start.
///
/// # Errors
/// [`CalibrationError`]; unknowns that are not identifiable give a [`CalibrationStatus`] instead.
pub fn calibrate(
    nominal: &LegModel,
    measurements: &[Measurement],
    options: &CalibrateOptions,
) -> Result<Calibration, CalibrationError> {
    let size = nominal.manipulator()?.size();
    check(measurements, options)?;
    let unknowns = Unknowns::new(nominal, options.held);
    if unknowns.count() == 0 {
        return Err(CalibrationError::NothingUnknown);
    }
    let problem = FitProblem {
        measurements,
        unknowns: &unknowns,
        size,
        noise: options.noise,
        loss: options.loss,
        unit: options.loss_unit,
        widest: options.identified * size,
    };
    let (fit, starts) = fit_from_starts(&problem, nominal, options)?;
    let weighted = problem.whitening(&fit.model, &fit.noise, &fit.weights);
    let spectrum = problem.spectrum(&fit.model, &weighted).ok_or(CalibrationError::Overflow)?;
    let observability = Observability::new(&spectrum, &unknowns, measurements.len(), fit.noise.length);
    let outliers = outliers(&problem, &fit);
    let is_out = |measurement: usize, leg: usize| {
        outliers.iter().any(|o| o.measurement == measurement && o.leg.is_none_or(|l| l == leg))
    };
    let residuals: Vec<_> = measurements.iter().map(|m| Some(fit.model.residual(m))).collect();
    let root = spectrum.covariance_root();
    let (left_out, indispensable) = leave_one_out(&problem, &fit, &weighted, &root);
    let chi_square = chi_square(&problem, &fit, &outliers, spectrum.rank);
    Ok(Calibration {
        status: status(&fit, &spectrum, &chi_square, unknowns.count()),
        root,
        bounded_root: spectrum.bounded_root(problem.widest),
        noise: fit.noise,
        noise_source: fit.source,
        starts,
        converged: fit.converged,
        rounds: fit.rounds,
        steps: fit.steps,
        observability,
        before: residuals_of(nominal, measurements),
        after: ResidualSpread::of(&residuals, |k, leg| !is_out(k, leg)),
        left_out: ResidualSpread::of(&left_out, |k, leg| !is_out(k, leg)),
        indispensable,
        chi_square,
        outliers,
        exchanged: exchanged(nominal, measurements),
        weights: fit.weights,
        model: fit.model,
        unknowns,
    })
}

fn check(measurements: &[Measurement], options: &CalibrateOptions) -> Result<(), CalibrationError> {
    if measurements.is_empty() {
        return Err(CalibrationError::NoMeasurements);
    }
    for (index, m) in measurements.iter().enumerate() {
        let pose = m.pose.position.iter().chain(m.pose.rotation.matrix().iter());
        if !pose.chain(&m.lengths).all(|x| x.is_finite()) {
            return Err(CalibrationError::NotFinite { index });
        }
    }
    if let Some(noise) = &options.noise {
        let MeasurementNoise { length, position, rotation } = *noise;
        let finite = [length, position, rotation].iter().all(|x| x.is_finite());
        if !(finite && length > 0.0 && position >= 0.0 && rotation >= 0.0) {
            return Err(CalibrationError::BadNoise { length, position, rotation });
        }
    }
    if !(options.identified > 0.0 && options.identified.is_finite()) {
        return Err(CalibrationError::BadShare(options.identified));
    }
    Ok(())
}

/// The better result of the requested starts.
fn fit_from_starts(
    problem: &FitProblem<'_>,
    nominal: &LegModel,
    options: &CalibrateOptions,
) -> Result<(CalibrationFit, Starts), CalibrationError> {
    let linear = || closed_form(nominal, problem.measurements, options.held).map(|start| problem.fit(&start));
    let closed = match options.start {
        StartChoice::Nominal => None,
        StartChoice::Best => linear(),
        StartChoice::ClosedForm => Some(linear().ok_or(CalibrationError::NoClosedForm)?),
    };
    let from_nominal = (options.start != StartChoice::ClosedForm).then(|| problem.fit(nominal));
    let merit = |fit: &Option<CalibrationFit>| fit.as_ref().map(|f| f.merit);
    let (nominal_merit, closed_merit) = (merit(&from_nominal), merit(&closed));
    let starts = |taken, agree| Starts { taken, agree, nominal: nominal_merit, closed_form: closed_merit };
    match (from_nominal, closed) {
        (Some(fit), None) => Ok((fit, starts(StartName::Nominal, None))),
        (None, Some(fit)) => Ok((fit, starts(StartName::ClosedForm, None))),
        (Some(a), Some(b)) => {
            let apart = (a.model.values(problem.unknowns) - b.model.values(problem.unknowns)).amax();
            let lower = problem.whitening(&a.model, &a.noise, &a.weights);
            let widest = problem.spectrum(&a.model, &lower).map_or(0.0, |s| s.covariance_root().amax());
            let same = apart <= (SAME_END * widest).max(1e-9 * problem.size);
            // a fit that did not converge ranks below every fit that did
            let key = |fit: &CalibrationFit| (!fit.converged, fit.merit);
            let (x, y) = (key(&a), key(&b));
            let nominal_is_better = if same {
                a.converged || !b.converged
            } else {
                x.partial_cmp(&y).is_none_or(std::cmp::Ordering::is_le)
            };
            if nominal_is_better {
                Ok((a, starts(StartName::Nominal, Some(same))))
            } else {
                Ok((b, starts(StartName::ClosedForm, Some(same))))
            }
        }
        (None, None) => Err(CalibrationError::NoClosedForm),
    }
}

fn status(
    fit: &CalibrationFit,
    spectrum: &FitSpectrum,
    chi: &ChiSquare,
    unknowns: usize,
) -> CalibrationStatus {
    // measurements that refute a model cannot show the observability of its parameters
    if chi.probability.is_some_and(|p| p < REFUTED) {
        CalibrationStatus::Refuted
    } else if spectrum.rank < unknowns {
        CalibrationStatus::NotIdentifiable
    } else if !fit.converged || chi.freedoms == 0 {
        CalibrationStatus::Undecided
    } else {
        CalibrationStatus::Calibrated
    }
}

/// Right measurements all stay below the outlier threshold with a probability of 99 %. If more than half of the poses
/// (or lengths) would be outliers, the list stays empty: then the noise or the model is wrong.
fn outliers(problem: &FitProblem<'_>, fit: &CalibrationFit) -> Vec<Outlier> {
    if fit.source == NoiseSource::Assumed {
        return Vec::new();
    }
    let poses = problem.measurements.len() as f64;
    let pose_threshold = chi_square_quantile(OUTLIER / poses, 6).sqrt();
    let leg_threshold = chi_square_quantile(OUTLIER / (6.0 * poses), 1).sqrt();
    let mut out = Vec::new();
    for (measurement, distances) in problem.distances(&fit.model, &fit.noise).iter().enumerate() {
        let weight = fit.weights[measurement];
        match problem.unit {
            LossUnit::Pose if distances.pose > pose_threshold => out.push(Outlier {
                measurement,
                leg: None,
                distance: distances.pose,
                threshold: pose_threshold,
                weight: weight.pose,
            }),
            LossUnit::Pose => {}
            LossUnit::Leg => {
                for leg in (0..6).filter(|leg| distances.legs[*leg] > leg_threshold) {
                    out.push(Outlier {
                        measurement,
                        leg: Some(leg),
                        distance: distances.legs[leg],
                        threshold: leg_threshold,
                        weight: weight.legs[leg],
                    });
                }
            }
        }
    }
    let all = match problem.unit {
        LossUnit::Pose => problem.measurements.len(),
        LossUnit::Leg => 6 * problem.measurements.len(),
    };
    if 2 * out.len() > all {
        return Vec::new();
    }
    out.sort_by(|a, b| b.distance.total_cmp(&a.distance));
    out
}

/// The sum of squares and its degrees of freedom. Poses with an outlier are left out if the loss allows for gross
/// errors.
fn chi_square(
    problem: &FitProblem<'_>,
    fit: &CalibrationFit,
    outliers: &[Outlier],
    rank: usize,
) -> ChiSquare {
    let robust = problem.loss != Loss::Squares;
    let counted = |k: usize| !(robust && outliers.iter().any(|o| o.measurement == k));
    let distances = problem.distances(&fit.model, &fit.noise);
    let kept: Vec<f64> =
        distances.iter().enumerate().filter(|(k, _)| counted(*k)).map(|(_, d)| d.pose * d.pose).collect();
    let (value, freedoms) = (kept.iter().sum(), (6 * kept.len()).saturating_sub(rank));
    let given = fit.source == NoiseSource::Given && freedoms > 0;
    ChiSquare { value, freedoms, probability: given.then(|| chi_square_exceeds(value, freedoms)) }
}

/// Residuals of each pose for the machine that the other poses give, to first order: `(I - H_kk)^-1 r_k` of whitened
/// residuals (Cook, Weisberg 1982). Also returns the poses without which the unknowns are undetermined.
fn leave_one_out(
    problem: &FitProblem<'_>,
    fit: &CalibrationFit,
    weighted: &[Matrix6<f64>],
    root: &DMatrix<f64>,
) -> (Vec<Option<Vector6<f64>>>, Vec<usize>) {
    let mut indispensable = Vec::new();
    let residuals = problem
        .measurements
        .iter()
        .zip(weighted)
        .enumerate()
        .map(|(k, (m, lower))| {
            let block = problem.block(&fit.model, m, lower);
            let whitened = lower.solve_lower_triangular(&fit.model.residual(m))?;
            let found = deletion(&block, root).map(|inverse| lower * (inverse * whitened));
            if found.is_none() {
                indispensable.push(k);
            }
            found
        })
        .collect();
    (residuals, indispensable)
}
