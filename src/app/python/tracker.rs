//! Tracks one real pose from lengths to lengths, or from crank angles to crank angles.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use super::arrays::{as_it_stands, lengths_in, matrices};
use super::failure::{interrupted, raised};
use ask::Error;
use fk::NearOutcome;
use machine::rotary::RotaryTracker;
use platform::geom::Pose;
use platform::manipulator::LegLengths;

/// Number of rows between two checks for signals: some milliseconds.
const SIGNALS: usize = 1024;

/// Tracks one real pose without changing the assembly mode.
#[pyclass(name = "Tracker", module = "equipod._core")]
#[derive(Clone)]
pub(super) struct NativeTracker(pub(super) TrackerKind);

/// The input of tracking.
#[derive(Clone)]
pub(super) enum TrackerKind {
    /// Six leg lengths.
    Legs(Box<ask::Tracker>),
    /// Six crank angles, radians.
    Cranks(Box<RotaryTracker>),
}

impl TrackerKind {
    fn pose(&self) -> Pose {
        match self {
            Self::Legs(tracker) => tracker.pose(),
            Self::Cranks(tracker) => tracker.pose(),
        }
    }

    /// Whether these inputs can be tracked at all; angles are checked during tracking.
    fn check(&self, row: [f64; 6]) -> Result<(), Error> {
        match self {
            Self::Legs(_) => LegLengths::try_new(row).map(|_| ()).map_err(Error::from),
            Self::Cranks(_) => Ok(()),
        }
    }

    fn continued(&mut self, row: [f64; 6]) -> Result<NearOutcome, Error> {
        match self {
            Self::Legs(tracker) => tracker.step(row),
            Self::Cranks(tracker) => Ok(tracker.step(&row)?),
        }
    }
}

/// The outcome `tracked`, `near_singularity` or `lost`, the fraction of the straight line of squared lengths, and the
/// reason.
fn said(outcome: &NearOutcome) -> (&'static str, f64, Option<String>) {
    match outcome {
        NearOutcome::Tracked { .. } => (outcome.name(), 1.0, None),
        NearOutcome::NearSingularity { fraction, .. } => (outcome.name(), *fraction, None),
        NearOutcome::Lost { fraction, reason, .. } => (outcome.name(), *fraction, Some(reason.to_string())),
    }
}

#[pymethods]
impl NativeTracker {
    /// Another tracker at the same pose.
    fn __copy__(&self) -> Self {
        self.clone()
    }

    /// The current pose of the platform, float64, shape (4, 4).
    fn transform<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        matrices(&[self.0.pose()]).index_axis_move(ndarray::Axis(0), 0).into_pyarray(py)
    }

    /// Continues to six lengths: status, the pose reached, residual, Frobenius ratio, fraction of the way, reason.
    /// `None`: the lengths are no array of six doubles.
    #[allow(clippy::type_complexity)]
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        lengths: &Bound<'py, PyAny>,
    ) -> PyResult<Option<(&'static str, Bound<'py, PyArray2<f64>>, f64, f64, f64, Option<String>)>> {
        let Some(array) = as_it_stands(lengths) else { return Ok(None) };
        let six = array.as_slice().ok().and_then(|entries| <[f64; 6]>::try_from(entries).ok());
        let Some(six) = six.filter(|_| array.ndim() == 1) else { return Ok(None) };
        let outcome = self.0.continued(six).map_err(|e| raised(py, e))?;
        let (status, fraction, reason) = said(&outcome);
        let pose = matrices(&[*outcome.pose()]).index_axis_move(ndarray::Axis(0), 0).into_pyarray(py);
        let evidence = outcome.evidence();
        Ok(Some((status, pose, evidence.residual, evidence.frobenius_ratio, fraction, reason)))
    }

    /// Continues through rows of lengths until one fails: the poses of the successful rows, and the outcome of the
    /// next.
    #[allow(clippy::type_complexity)]
    fn follow<'py>(
        &mut self,
        py: Python<'py>,
        lengths: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<(
        Bound<'py, PyArray3<f64>>,
        [Bound<'py, PyArray1<f64>>; 2],
        &'static str,
        f64,
        Option<String>,
    )> {
        let rows = lengths_in(py, &lengths.as_array())?;
        rows.iter().try_for_each(|row| self.0.check(*row)).map_err(|e| raised(py, e))?;
        let tracker = &mut self.0;
        let (poses, residuals, ratios, end) = py.detach(move || {
            let (mut poses, mut residuals, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
            for (k, row) in rows.iter().enumerate() {
                if k % SIGNALS == 0 && interrupted() {
                    return (poses, residuals, ratios, Err(Error::Cancelled));
                }
                match tracker.continued(*row) {
                    Ok(NearOutcome::Tracked { pose, evidence }) => {
                        poses.push(pose);
                        residuals.push(evidence.residual);
                        ratios.push(evidence.frobenius_ratio);
                    }
                    Ok(other) => return (poses, residuals, ratios, Ok(said(&other))),
                    Err(error) => return (poses, residuals, ratios, Err(error)),
                }
            }
            (poses, residuals, ratios, Ok(("tracked", 1.0, None)))
        });
        let (status, fraction, reason) = end.map_err(|e| raised(py, e))?;
        Ok((
            matrices(&poses).into_pyarray(py),
            [residuals, ratios].map(|column| ndarray::Array1::from(column).into_pyarray(py)),
            status,
            fraction,
            reason,
        ))
    }
}
