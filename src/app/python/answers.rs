//! Answers as JSON records, as on the command line.

use std::ops::ControlFlow;

use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use serde::Serialize;

use super::arrays::{LegMapArrays, leg_map_arrays};
use super::design::{NativeDesign, OF_LEG_MAPS, threads_of};
use super::failure::{interrupted, raised};
use ask::Design;
use ask::{VerifyOptions, sample_plan};
use equipod::PRESETS;
use records::{Document, FramesRecord, MapAnswer, ProvenanceRecord, VerifyAnswer};
use synthesis::LegCorrespondence;

/// The document of an answer about designs, as the command line prints it.
pub(super) fn document(answer: impl Serialize, designs: &[&Design], seed: Option<u64>) -> PyResult<String> {
    as_json(&Document::new(answer, ProvenanceRecord::of(designs, seed), Vec::new()))
}

/// A record as JSON.
pub(super) fn as_json(record: &impl Serialize) -> PyResult<String> {
    serde_json::to_string(record).map_err(|e| PyRuntimeError::new_err(e.to_string()))
}

/// The names of the presets.
#[pyfunction]
pub(super) fn preset_names() -> Vec<&'static str> {
    PRESETS.iter().map(|p| p.name).collect()
}

/// The display of an answer in a notebook: the sheet of its JSON document.
#[pyfunction]
pub(super) fn sheet_html(document: &str) -> PyResult<String> {
    let fields = serde_json::from_str(document).map_err(|e| PyRuntimeError::new_err(e.to_string()))?;
    Ok(sheet::shown(&sheet::answers::document(&fields).html()))
}

/// `A` and `c` of the affine map of squared leg lengths, and the answer of `equipod equivalents map`.
#[pyfunction]
pub(super) fn leg_map<'py>(
    py: Python<'py>,
    from_: &NativeDesign,
    to: &NativeDesign,
) -> PyResult<(Option<LegMapArrays<'py>>, String)> {
    [from_, to].into_iter().try_for_each(|design| design.only_of_legs(py, OF_LEG_MAPS))?;
    let (a, b) = (from_.inner(), to.inner());
    let found = py.detach(|| ask::leg_map(a, b)).map_err(|e| raised(py, e))?;
    let map = found.map().map(|map| leg_map_arrays(py, map));
    let correspondence = (&LegCorrespondence::between(a.manipulator(), b.manipulator())).into();
    let answer =
        MapAnswer { map: (&found).into(), correspondence, lengths: None, frames: FramesRecord::default() };
    Ok((map, document(answer, &[a, b], None)?))
}

/// The answer of `equipod verify`.
#[pyfunction]
#[pyo3(signature = (a, b, samples, seed, threads))]
pub(super) fn verify(
    py: Python<'_>,
    a: &NativeDesign,
    b: &NativeDesign,
    samples: usize,
    seed: u64,
    threads: Option<usize>,
) -> PyResult<String> {
    [a, b].into_iter().try_for_each(|design| design.only_of_legs(py, OF_LEG_MAPS))?;
    let (a, b) = (a.inner(), b.inner());
    let threads = threads_of(py, threads)?;
    let found = py.detach(|| {
        let observe = |_: &_| if interrupted() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
        let options = VerifyOptions::new().samples(samples).seed(seed).threads(threads).on_sample(observe);
        ask::verify_with(a, b, options)
    });
    let found = found.map_err(|e| raised(py, e))?;
    let answer = VerifyAnswer::new(&found, &sample_plan(a, samples, seed), FramesRecord::default());
    document(answer, &[a, b], Some(seed))
}
