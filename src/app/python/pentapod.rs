//! Designs of five legs: what they hold, and the poses of the line for five lengths.

use ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2};
use pyo3::prelude::*;

use super::answers::as_json;
use super::failure::{interruptible, raised, refused};
use ask::{Error, PentapodReport, about_five_legs};
use files::design::{FiveLegs, Format, parse_five_legs};
use num::exact::nearest;
use records::{DesignSourceRecord, Document, PentapodAnswer, ProvenanceRecord, sha256};

/// A design of five legs.
#[pyclass(frozen, name = "FiveLegs", module = "equipod._core")]
pub(super) struct NativeFiveLegs {
    design: FiveLegs,
    text: String,
    json: bool,
}

#[pymethods]
impl NativeFiveLegs {
    /// Reads a text, TOML or JSON.
    #[staticmethod]
    fn loads(py: Python<'_>, text: &str, json: bool) -> PyResult<Self> {
        let format = if json { Format::Json } else { Format::Toml };
        match parse_five_legs(text, format) {
            None => Err(refused(py, "legs", "the text lists another number of legs than five: use Design")),
            Some(Err(violations)) => Err(raised(py, Error::Design { file: None, violations })),
            Some(Ok((design, _))) => Ok(Self { design, text: text.to_owned(), json }),
        }
    }

    /// The text it was read from, and whether that is JSON.
    fn text(&self) -> (&str, bool) {
        (&self.text, self.json)
    }

    #[getter]
    fn name(&self) -> &str {
        &self.design.name
    }

    #[getter]
    fn units(&self) -> &str {
        &self.design.units
    }

    /// Base end and platform end of each leg, float64, shape (5, 3).
    fn ends<'py>(&self, py: Python<'py>) -> [Bound<'py, PyArray2<f64>>; 2] {
        [&self.design.pentapod.base, &self.design.pentapod.platform]
            .map(|ends| Array2::from_shape_fn((5, 3), |(leg, i)| nearest(&ends[leg][i])).into_pyarray(py))
    }

    /// Names of the base joint and of the platform joint of each leg.
    fn leg_names(&self) -> Vec<(String, String)> {
        self.design.leg_names.iter().map(|[base, platform]| (base.clone(), platform.clone())).collect()
    }

    /// Leg lengths of the file, float64, shape (5,).
    fn lengths<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.design.lengths.map(|l| ndarray::Array1::from_iter(l).into_pyarray(py))
    }

    /// The answer of `equipod check`, and with lengths that of `equipod fk`.
    fn about(&self, py: Python<'_>, lengths: Option<[f64; 5]>, seed: u64) -> PyResult<String> {
        let design = self.design.clone();
        let report: PentapodReport = interruptible(py, move || Ok(about_five_legs(&design, lengths, seed)))?;
        if let (Some(message), Some(_)) = (report.without_line(), lengths) {
            return Err(refused(py, "fk::five_legs", &message));
        }
        let source = DesignSourceRecord {
            name: self.design.name.clone(),
            path: None,
            sha256: sha256(self.text.as_bytes()),
        };
        let provenance = ProvenanceRecord { seed: Some(seed), designs: vec![source], ..Default::default() };
        as_json(&Document::new(PentapodAnswer::from(&report), provenance, Vec::new()))
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.design == other.design
    }
}
