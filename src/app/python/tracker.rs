//! Tracks one real pose from lengths to lengths, or from crank angles to crank angles.

use numpy::{IntoPyArray, PyArray1, PyArray2, PyArray3, PyReadonlyArray2, PyUntypedArrayMethods};
use pyo3::prelude::*;

use super::arrays::{as_it_stands, lengths_in, matrices};
use super::failure::{interrupted, raised};
use ask::Error;
use fk::{NearEvidence, NearOutcome};
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

    /// Continues through rows of lengths: the poses of those that were reached with their rows, what became of the
    /// last one, and the rows that were skipped. Without `skip` the first row that is not reached is the last.
    fn follow<'py>(
        &mut self,
        py: Python<'py>,
        lengths: PyReadonlyArray2<'py, f64>,
        skip: bool,
    ) -> PyResult<Followed<'py>> {
        let rows = lengths_in(py, &lengths.as_array())?;
        if !skip {
            rows.iter().try_for_each(|row| self.0.check(*row)).map_err(|e| raised(py, e))?;
        }
        let tracker = &mut self.0;
        let (way, end) = py.detach(move || {
            let mut way = Way::default();
            for (k, row) in rows.iter().enumerate() {
                if k % SIGNALS == 0 && interrupted() {
                    return (way, Err(Error::Cancelled));
                }
                match tracker.continued(*row) {
                    Ok(NearOutcome::Tracked { pose, evidence }) => way.push(k, pose, &evidence),
                    Ok(other) if skip => way.skip(k, said(&other)),
                    Err(error) if skip => way.skip(k, ("refused", 0.0, Some(error.to_string()))),
                    Ok(other) => return (way, Ok(said(&other))),
                    Err(error) => return (way, Err(error)),
                }
            }
            // the last row speaks for the way, reached or skipped
            let last = way.skipped.last().filter(|skipped| skipped.0 + 1 == rows.len() as i64);
            let end = last.map_or(("tracked", 1.0, None), |(_, status, fraction, reason)| {
                (*status, *fraction, reason.clone())
            });
            (way, Ok(end))
        });
        let end = end.map_err(|e| raised(py, e))?;
        Ok((
            matrices(&way.poses).into_pyarray(py),
            [way.residuals, way.ratios].map(|column| ndarray::Array1::from(column).into_pyarray(py)),
            way.rows.into_pyarray(py),
            end,
            way.skipped,
        ))
    }
}

/// A row that was skipped: its number, status, fraction of the way and reason.
type SkippedRow = (i64, &'static str, f64, Option<String>);

/// Poses, residuals and Frobenius ratios, rows reached; status, fraction and reason of the last row; rows skipped.
type Followed<'py> = (
    Bound<'py, PyArray3<f64>>,
    [Bound<'py, PyArray1<f64>>; 2],
    Bound<'py, PyArray1<i64>>,
    (&'static str, f64, Option<String>),
    Vec<SkippedRow>,
);

/// The outcome of rows of lengths.
#[derive(Default)]
struct Way {
    poses: Vec<Pose>,
    residuals: Vec<f64>,
    ratios: Vec<f64>,
    /// The row of each pose.
    rows: Vec<i64>,
    skipped: Vec<SkippedRow>,
}

impl Way {
    fn push(&mut self, row: usize, pose: Pose, evidence: &NearEvidence) {
        self.poses.push(pose);
        self.residuals.push(evidence.residual);
        self.ratios.push(evidence.frobenius_ratio);
        self.rows.push(row as i64);
    }

    fn skip(&mut self, row: usize, (status, fraction, reason): (&'static str, f64, Option<String>)) {
        self.skipped.push((row as i64, status, fraction, reason));
    }
}
