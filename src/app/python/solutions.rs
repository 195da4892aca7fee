//! Answers of forward kinematics as arrays.

use std::sync::Arc;

use ndarray::Array1;
use num_complex::Complex64;
use numpy::{IntoPyArray, PyArray1, PyArray3};
use pyo3::prelude::*;

use super::answers::{as_json, document};
use super::arrays::{complex_matrices, entry, shaped};
use super::failure::{raised, refused_for_cranks};
use ask::Design;
use ask::Error;
use fk::{Completeness, FkRoot, FkSolutions, Reality, SolutionSet};
use machine::rotary::RotaryPlatform;
use platform::geom::{ComplexPose, PoseConvention};
use platform::manipulator::LegLengths;
use records::{ClosureRecord, FkOneAnswer, RotationPolynomialRecord, SolvedRecord};

/// Code of reality: 1 for a real pose, 0 for a complex one, -1 if undecided.
fn reality(root: &FkRoot) -> i8 {
    match root.reality {
        Reality::Real => 1,
        Reality::NonReal => 0,
        Reality::Undecided => -1,
    }
}

/// Code of completeness: 3 proved up to a distance, 2 proved, 1 counted modulo primes, 0 unproved.
fn completeness(found: &FkSolutions) -> i8 {
    match found.completeness {
        Completeness::Proved { .. } => 2,
        Completeness::ProvedBounded { .. } => 3,
        Completeness::Modular { .. } => 1,
        Completeness::Unproved { .. } => 0,
    }
}

/// The input of the solved poses.
pub(super) enum SolvedFor {
    /// Leg lengths, as the legs show them.
    Lengths(Arc<Design>, [f64; 6]),
    /// Crank angles, radians.
    Angles(Arc<Design>, Box<RotaryPlatform>, [f64; 6]),
}

/// All finite poses, real and complex, for one set of leg lengths or crank angles.
#[pyclass(frozen, name = "Solutions", module = "equipod._core")]
pub(super) struct NativeSolutions {
    found: FkSolutions,
    of: SolvedFor,
}

impl NativeSolutions {
    pub(super) fn new(found: FkSolutions, of: SolvedFor) -> Self {
        Self { found, of }
    }
}

#[pymethods]
impl NativeSolutions {
    fn __len__(&self) -> usize {
        self.found.roots.len()
    }

    /// Poses, complex128, shape (n, 4, 4).
    fn transforms<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray3<Complex64>> {
        complex_matrices(&self.found.roots.iter().map(|r| &r.pose).collect::<Vec<_>>()).into_pyarray(py)
    }

    /// Code of reality: 1 real, 0 not real, -1 undecided; int8, shape (n,).
    fn reality<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<i8>> {
        self.column(py, reality)
    }

    /// Whether each pose has a certificate; bool, shape (n,).
    fn certified<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<bool>> {
        self.column(py, FkRoot::certified)
    }

    /// Largest errors of the leg equations divided by the squared size; float64, shape (n,).
    fn residual<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        self.column(py, |r| r.residual)
    }

    /// The multiplicity of each pose; uint32, shape (n,).
    fn multiplicity<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<u32>> {
        self.column(py, |r| r.multiplicity)
    }

    /// The real pose nearest to home, by its index; `None` without real poses.
    fn nearest_home(&self) -> Option<usize> {
        let (design, size) = match &self.of {
            SolvedFor::Lengths(design, _) => (design, design.manipulator().size()),
            SolvedFor::Angles(design, platform, angles) => (design, platform.at(angles).ok()?.size()),
        };
        let home = ComplexPose::from(design.home_or_default());
        let distance =
            |k: usize| ComplexPose::from(self.found.roots[k].pose.real_part()).distance(&home, size);
        let real = (0..self.found.roots.len()).filter(|k| self.found.roots[*k].reality == Reality::Real);
        real.min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
    }

    /// The level of completeness: `proved`, `proved_bounded`, `modular` or `unproved`.
    fn completeness(&self) -> &'static str {
        self.found.completeness.name()
    }

    /// The evidence for completeness in one sentence.
    fn reason(&self) -> String {
        self.found.completeness.to_string()
    }

    /// Whether all poses are listed, by proof or modulo random primes.
    fn is_complete(&self) -> bool {
        self.found.is_complete()
    }

    /// Dimension of the set of poses, found numerically; 0 for isolated poses.
    fn dimension(&self) -> usize {
        match &self.found.solution_set {
            SolutionSet::PositiveDimensional { dimension, .. } => *dimension,
            SolutionSet::Isolated | SolutionSet::Empty => 0,
        }
    }

    /// The method that found the poses.
    fn method(&self) -> &'static str {
        self.found.method.name()
    }

    /// The polynomial in the Cayley parameter c3 of all poses, or why there is none, as JSON.
    fn rotation_polynomial(&self, py: Python<'_>) -> PyResult<String> {
        self.of_legs(py)?;
        as_json(&RotationPolynomialRecord::from(fk::rotation_polynomial(&self.found)))
    }

    /// The closure polynomial in the squared distance of a base joint and a platform joint, by their numbers, as JSON.
    fn closure(&self, py: Python<'_>, pair: (usize, usize)) -> PyResult<String> {
        let (design, lengths) = self.of_legs(py)?;
        let shown = LegLengths::try_new(lengths).map_err(|e| raised(py, e.into()))?;
        let distances = shown.without(&design.leg_offsets()).map_err(|e| raised(py, e.into()))?;
        let record = || ClosureRecord::between(design, &distances.squared(), &self.found, pair);
        as_json(&py.detach(record))
    }

    /// The document of one set of lengths, certificates included.
    fn json(&self, py: Python<'_>) -> PyResult<String> {
        let solved = SolvedRecord::from(&self.found);
        let (design, answer) = match &self.of {
            SolvedFor::Lengths(design, _) => {
                let frames = design.pose_frames(PoseConvention::default());
                let solved = solved.with_real_poses(design.manipulator(), &frames);
                let frames = Some((&frames.convention).into());
                let units = Some(design.units.clone());
                (design, FkOneAnswer { frames, units, ..solved.into() })
            }
            SolvedFor::Angles(design, platform, angles) => {
                let tips = platform.at(angles).map_err(|e| raised(py, e.into()))?;
                let frames = design.pose_frames(PoseConvention::default());
                let solved = solved.with_real_poses(&tips, &frames);
                let solved = solved.with_elbows(platform, angles);
                let symmetric_finite = platform.symmetric_pose_count(angles);
                let frames = Some((&frames.convention).into());
                let units = Some(design.units.clone());
                let answer = FkOneAnswer { symmetric_finite, frames, units, ..solved.into() };
                (design, answer.with_angles(platform, angles, angles.map(f64::to_degrees)))
            }
        };
        document(answer, &[design], Some(self.found.seed))
    }
}

impl NativeSolutions {
    /// Design and lengths of legs; cranks have no polynomials.
    fn of_legs(&self, py: Python<'_>) -> PyResult<(&Design, [f64; 6])> {
        match &self.of {
            SolvedFor::Lengths(design, lengths) => Ok((design, *lengths)),
            SolvedFor::Angles(..) => Err(refused_for_cranks(py, "ask `record` for the poses")),
        }
    }

    fn column<'py, T: numpy::Element>(
        &self,
        py: Python<'py>,
        of: impl Fn(&FkRoot) -> T,
    ) -> Bound<'py, PyArray1<T>> {
        Array1::from_iter(self.found.roots.iter().map(of)).into_pyarray(py)
    }
}

/// The poses of many sets of leg lengths, one after the other, as columns.
#[derive(Default)]
pub(super) struct SolutionColumns {
    /// Real poses alone are kept.
    real_only: bool,
    /// Row by row, complex 4 x 4; empty where real poses alone are kept.
    transforms: Vec<Complex64>,
    /// Row by row, 4 x 4, where real poses alone are kept.
    real_transforms: Vec<f64>,
    /// Poses of each row of which it is not decided whether they are real.
    undecided: Vec<u32>,
    reality: Vec<i8>,
    certified: Vec<bool>,
    residual: Vec<f64>,
    multiplicity: Vec<u32>,
    /// The end index of the poses of each row.
    ends: Vec<i64>,
    completeness: Vec<i8>,
    /// The index of each row's reason.
    reason: Vec<i64>,
    reasons: Vec<String>,
    /// The completeness of the previous row, with the index of its reason.
    last: Option<(Completeness, usize)>,
}

/// Transforms, reality, certified, residual, multiplicity; offsets, completeness and reason of each row; the reasons.
pub(super) type SolutionArrays<'py> = (
    Bound<'py, PyAny>,
    Bound<'py, PyArray1<i8>>,
    Bound<'py, PyArray1<bool>>,
    Bound<'py, PyArray1<f64>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<i64>>,
    Bound<'py, PyArray1<i8>>,
    Bound<'py, PyArray1<u32>>,
    Bound<'py, PyArray1<i64>>,
    Vec<String>,
);

impl SolutionColumns {
    pub(super) fn new(real_only: bool) -> Self {
        Self { real_only, ..Self::default() }
    }

    /// Appends the answer of the next row; certificates are dropped.
    pub(super) fn push(&mut self, row: &Result<FkSolutions, Error>) {
        let mut undecided = 0;
        let word = match row {
            Ok(found) => {
                for root in &found.roots {
                    undecided += u32::from(root.reality == Reality::Undecided);
                    if !self.real_only || root.reality == Reality::Real {
                        self.push_root(root);
                    }
                }
                completeness(found)
            }
            Err(_) => -1,
        };
        self.undecided.push(undecided);
        self.ends.push(self.reality.len() as i64);
        self.completeness.push(word);
        let place = self.place_of_reason(row);
        self.reason.push(place as i64);
    }

    /// The index of a row's reason. Most rows share the reason of the previous row, and its words are not written
    /// again.
    fn place_of_reason(&mut self, row: &Result<FkSolutions, Error>) -> usize {
        let known = row.as_ref().ok().map(|found| &found.completeness);
        if let (Some(known), Some((last, place))) = (known, &self.last)
            && known == last
        {
            return *place;
        }
        let reason = match row {
            Ok(found) => found.completeness.to_string(),
            Err(error) => error.to_string(),
        };
        let place = self.reasons.iter().rposition(|r| *r == reason).unwrap_or_else(|| {
            self.reasons.push(reason);
            self.reasons.len() - 1
        });
        self.last = known.map(|known| (known.clone(), place));
        place
    }

    fn push_root(&mut self, root: &FkRoot) {
        let (r, p) = (&root.pose.rotation, &root.pose.position);
        let matrix: [Complex64; 16] = std::array::from_fn(|k| entry(r, p, (k / 4, k % 4)));
        if self.real_only {
            self.real_transforms.extend(matrix.map(|z| z.re));
        } else {
            self.transforms.extend_from_slice(&matrix);
        }
        self.reality.push(reality(root));
        self.certified.push(root.certified());
        self.residual.push(root.residual);
        self.multiplicity.push(root.multiplicity);
    }

    pub(super) fn into_arrays(self, py: Python<'_>) -> PyResult<SolutionArrays<'_>> {
        let shape = (self.reality.len(), 4, 4);
        let transforms = if self.real_only {
            shaped(shape, self.real_transforms)?.into_pyarray(py).into_any()
        } else {
            shaped(shape, self.transforms)?.into_pyarray(py).into_any()
        };
        let offsets: Vec<i64> = std::iter::once(0).chain(self.ends).collect();
        Ok((
            transforms,
            self.reality.into_pyarray(py),
            self.certified.into_pyarray(py),
            self.residual.into_pyarray(py),
            self.multiplicity.into_pyarray(py),
            offsets.into_pyarray(py),
            self.completeness.into_pyarray(py),
            self.undecided.into_pyarray(py),
            self.reason.into_pyarray(py),
            self.reasons,
        ))
    }
}
