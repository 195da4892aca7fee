//! Designs, with the questions about them as methods.

use std::num::NonZeroUsize;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::Point3;
use ndarray::Array2;
use numpy::{IntoPyArray, PyArray1, PyArray2, PyArrayDyn, PyReadonlyArray2, PyReadonlyArray3};
use pyo3::prelude::*;

use super::answers::document;
use super::arrays::{
    as_it_stands, at_poses, leg_map_arrays, lengths_in, matrices, pose_entries, poses_in, shaped,
};
use super::failure::{interrupted, interruptible, raised, refused, refused_for_cranks};
use super::forms::{ConventionWords, words_of};
use super::solutions::{NativeSolutions, SolutionArrays, SolutionColumns, SolvedFor};
use super::tracker::{NativeTracker, TrackerKind};
use ask::Design;
use ask::design::parse_ideal;
use ask::{Error, Solver, solve_angles};
use equipod::PRESETS;
use files::design::Format;
use fk::{FkOptions, Method, PoseCounting, Threads};
use machine::requirements::{AssessOptions, Terms};
use machine::rotary::{InvalidRotary, RotaryPlatform, RotaryTracker};
use num::Cancel;
use platform::manipulator::{Body, Manipulator, NoSuchBody, jacobian_of_legs};
use records::{AssessAnswer, CheckAnswer};
use synthesis::singularity::SingularityVerdict;

/// A design with `A` and `c` of the leg map to it.
type WithLegMap<'py> = (NativeDesign, Bound<'py, PyArray2<f64>>, Bound<'py, PyArray1<f64>>);

/// A platform with names, units, home pose and requirements.
#[pyclass(frozen, name = "Design", module = "equipod._core")]
pub(super) struct NativeDesign {
    design: Arc<Design>,
    /// The cranks, for rods on cranks.
    cranks: Result<Option<RotaryPlatform>, InvalidRotary>,
    /// The prepared design of the last batch, for the next one with the same options.
    solver: Mutex<Option<(FkOptions, Solver)>>,
}

/// Crank angles, angles on the other sides, transmissions, margins to the limits; float64, shape (.., 6).
type CrankArrays<'py> = [Bound<'py, PyArrayDyn<f64>>; 4];

impl NativeDesign {
    pub(super) fn of(design: Design) -> Self {
        Self { cranks: design.rotary(), design: Arc::new(design), solver: Mutex::default() }
    }

    pub(super) fn inner(&self) -> &Design {
        &self.design
    }

    /// The cranks of a design that has some.
    fn cranks(&self, py: Python<'_>) -> PyResult<Option<&RotaryPlatform>> {
        self.cranks
            .as_ref()
            .map(Option::as_ref)
            .map_err(|why| refused(py, "design::invalid", &why.to_string()))
    }

    /// Refuses rods on cranks for questions about legs that change their lengths, and names the question to ask
    /// instead.
    pub(super) fn only_of_legs(&self, py: Python<'_>, instead: &str) -> PyResult<()> {
        if self.design.has_cranks() { Err(refused_for_cranks(py, instead)) } else { Ok(()) }
    }

    /// The design prepared for many lengths; a second batch with the same options finds it prepared.
    fn prepared(&self, options: FkOptions) -> Solver {
        let mut kept = self.solver.lock().unwrap_or_else(PoisonError::into_inner);
        match &*kept {
            Some((own, solver)) if *own == options => solver.clone(),
            _ => {
                let solver = self.design.solver(options);
                *kept = Some((options, solver.clone()));
                solver
            }
        }
    }

    fn body(py: Python<'_>, name: &str) -> PyResult<Body> {
        name.parse().map_err(|e: NoSuchBody| refused(py, "unknown_name", &e.to_string()))
    }
}

/// The question for cranks that replaces architectural singularity.
const OF_SINGULARITY: &str = "ask assess, which proves that no pose of the workspace is singular";
/// The reason why cranks have no question that replaces leg maps.
pub(super) const OF_LEG_MAPS: &str =
    "leg maps hold between squared lengths of legs, and nothing follows from them for the angles of cranks";

/// The pattern without shared joints.
const SEPARATE_JOINTS: &str = "S123456";

/// Number of rows of a batch between two checks for a signal; they take milliseconds for the slowest rows.
const SIGNALS: usize = 64;

/// The number of threads; `None` means one for each processor.
pub(super) fn threads_of(py: Python<'_>, threads: Option<usize>) -> PyResult<Threads> {
    match threads {
        None => Ok(Threads::All),
        Some(n) => NonZeroUsize::new(n)
            .map(Threads::Count)
            .ok_or_else(|| refused(py, "threads", "threads counts from 1; None is one for each processor")),
    }
}

fn points(py: Python<'_>, joints: &PyReadonlyArray2<'_, f64>) -> PyResult<Vec<Point3<f64>>> {
    let joints = joints.as_array();
    if joints.shape()[1] != 3 {
        return Err(refused(py, "shape", &format!("joints are (n, 3), not {:?}", joints.shape())));
    }
    Ok(joints.rows().into_iter().map(|r| Point3::new(r[0], r[1], r[2])).collect())
}

fn options(py: Python<'_>, seed: u64, method: Option<&str>, pose_count: bool) -> PyResult<FkOptions> {
    let counting = if pose_count { PoseCounting::WhenUnproved } else { PoseCounting::Never };
    let options = FkOptions::new().seed(seed).pose_count(counting);
    match method {
        None => Ok(options),
        Some(name) => {
            let method: Method = name.parse().map_err(|e: num::names::UnknownName| raised(py, e.into()))?;
            Ok(options.method(method))
        }
    }
}

#[pymethods]
impl NativeDesign {
    /// Reads a file.
    #[staticmethod]
    fn load(py: Python<'_>, path: std::path::PathBuf) -> PyResult<Self> {
        Design::load_ideal(path).map(Self::of).map_err(|e| raised(py, e))
    }

    /// Reads a text, TOML or JSON.
    #[staticmethod]
    fn loads(py: Python<'_>, text: &str, json: bool) -> PyResult<Self> {
        let format = if json { Format::Json } else { Format::Toml };
        let read = parse_ideal(text, format).map_err(|violations| Error::Design { file: None, violations });
        read.map(|(design, _)| Self::of(design)).map_err(|e| raised(py, e))
    }

    /// A preset by its name.
    #[staticmethod]
    fn preset(py: Python<'_>, name: &str) -> PyResult<Self> {
        if let Some(preset) = PRESETS.iter().find(|p| p.name == name) {
            return Self::loads(py, preset.text, false);
        }
        let known: Vec<&str> = PRESETS.iter().map(|p| p.name).collect();
        let message = format!("there is no preset `{name}`; there are {}", known.join(", "));
        Err(refused(py, "unknown_name", &message))
    }

    /// A design from its joints and the pairs of joints that the legs connect.
    #[staticmethod]
    fn from_arrays(
        py: Python<'_>,
        base: PyReadonlyArray2<'_, f64>,
        platform: PyReadonlyArray2<'_, f64>,
        legs: [(usize, usize); 6],
        name: &str,
        units: &str,
    ) -> PyResult<Self> {
        let made = Manipulator::try_new(points(py, &base)?, points(py, &platform)?, legs);
        let manipulator = made.map_err(|e| raised(py, e.into()))?;
        Ok(Self::of(Design::new(name, units, manipulator)))
    }

    /// The design with the symmetry that its joints have up to rounding, and a list of the findings.
    fn snapped(&self) -> Option<(Self, Vec<String>)> {
        let snapped = self.design.snapped()?;
        let sentences = snapped.sentences(&self.design.units);
        Some((Self::of(snapped.design.into()), sentences))
    }

    /// The design with another home pose.
    fn with_home(&self, py: Python<'_>, pose: PyReadonlyArray3<'_, f64>) -> PyResult<Self> {
        let home = poses_in(py, &pose.as_array())?.into_iter().next();
        let mut design = Design::clone(&self.design);
        design.home = home;
        Ok(Self::of(design))
    }

    /// The design with a joint, `"A1"` or `"base.A1"`, at other coordinates.
    fn with_joint(&self, py: Python<'_>, name: &str, point: [f64; 3]) -> PyResult<Self> {
        let mut design = Design::clone(&self.design);
        design.set_joint(name, point).map_err(|e| raised(py, Error::Joint(e)))?;
        Ok(Self::of(design))
    }

    /// Leg lengths of the file, float64, shape (6,); `None` where it has none.
    fn lengths<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        self.design.lengths.map(|l| ndarray::Array1::from_iter(l.get()).into_pyarray(py))
    }

    #[getter]
    fn name(&self) -> &str {
        &self.design.name
    }

    #[getter]
    fn units(&self) -> &str {
        &self.design.units
    }

    /// `prismatic` or `rotary`.
    #[getter]
    fn drive(&self) -> &'static str {
        if self.design.has_cranks() { "rotary" } else { "prismatic" }
    }

    /// Whether the design states a home pose.
    #[getter]
    fn has_home(&self) -> bool {
        self.design.home.is_some()
    }

    /// The home pose, or the default pose above the base; float64, shape (4, 4).
    fn home<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<f64>> {
        let home = matrices(&[self.design.home_or_default()]);
        home.index_axis_move(ndarray::Axis(0), 0).into_pyarray(py)
    }

    /// The words of the design's own convention for poses.
    fn frames(&self) -> ConventionWords {
        words_of(&self.design.frames)
    }

    /// The joints of a body, float64, shape (n, 3).
    fn joints<'py>(&self, py: Python<'py>, body: &str) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let joints = self.design.manipulator().joints(Self::body(py, body)?);
        Ok(Array2::from_shape_fn((joints.len(), 3), |(i, k)| joints[i][k]).into_pyarray(py))
    }

    /// The names of the joints of a body.
    fn joint_names(&self, py: Python<'_>, body: &str) -> PyResult<Vec<String>> {
        Ok(Self::body(py, body)?.of((self.design.base_names(), self.design.platform_names())).to_vec())
    }

    /// The indices of base joint and platform joint of each leg, int64, shape (6, 2).
    fn legs<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray2<i64>> {
        let pairs = self.design.manipulator().pairs().map(|(a, b)| [a as i64, b as i64]);
        Array2::from_shape_fn((6, 2), |(i, k)| pairs[i][k]).into_pyarray(py)
    }

    /// Valid but suspicious entries of the file.
    fn warnings(&self) -> Vec<String> {
        self.design.warnings().iter().map(ToString::to_string).collect()
    }

    /// The text of the design.
    fn dumps(&self, json: bool) -> String {
        if json { self.design.to_json() } else { self.design.text() }
    }

    /// Writes a file.
    fn save(&self, py: Python<'_>, path: std::path::PathBuf) -> PyResult<()> {
        self.design.save(path).map_err(|e| raised(py, e))
    }

    /// Leg lengths or crank angles, float64, shape (.., 6), at poses (.., 4, 4). `None`: the poses are no array of
    /// doubles, row by row, of this shape. NaN: a rod does not reach.
    fn ik<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
    ) -> PyResult<Option<Bound<'py, PyArrayDyn<f64>>>> {
        let Some(array) = as_it_stands(poses) else { return Ok(None) };
        let Some((entries, before)) = pose_entries(&array) else { return Ok(None) };
        let legs = self.design.manipulator().legs();
        let mut lengths = Vec::with_capacity(6 * (entries.len() / 16));
        if let Some(platform) = self.cranks(py)? {
            at_poses(py, entries, |pose| {
                let angles = platform.ik(&pose).unwrap_or([f64::NAN; 6]);
                lengths.extend_from_slice(&angles);
                Ok(())
            })?;
            return Ok(Some(shaped([before, &[6]].concat(), lengths)?.into_pyarray(py)));
        }
        let offsets = self.design.leg_offsets();
        at_poses(py, entries, |pose| {
            let distances = pose.lengths_of(&legs).ok_or(Error::Overflow)?;
            lengths.extend_from_slice(&distances.shown_with(&offsets).map_err(Error::from)?.get());
            Ok(())
        })?;
        Ok(Some(shaped([before, &[6]].concat(), lengths)?.into_pyarray(py)))
    }

    /// Angles, transmissions and margins of the cranks at poses (.., 4, 4); `None` as for `ik`.
    fn crank_angles<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
    ) -> PyResult<Option<CrankArrays<'py>>> {
        let Some(platform) = self.cranks(py)? else {
            let message = "the legs change their lengths, and the design has no cranks: use ik";
            return Err(refused(py, "no_cranks", message));
        };
        let Some(array) = as_it_stands(poses) else { return Ok(None) };
        let Some((entries, before)) = pose_entries(&array) else { return Ok(None) };
        let mut columns: [Vec<f64>; 4] =
            std::array::from_fn(|_| Vec::with_capacity(6 * (entries.len() / 16)));
        at_poses(py, entries, |pose| {
            let rows = match platform.both_angles(&pose) {
                Err(_) => [[f64::NAN; 6]; 4],
                Ok(both) => {
                    let of = |i: usize| platform.legs()[i].elbow;
                    let kept = std::array::from_fn(|i| platform.counted(i, both[i].of(of(i))));
                    let other: [f64; 6] =
                        std::array::from_fn(|i| platform.counted(i, both[i].of(of(i).other())));
                    [kept, other, platform.transmissions(&pose, &kept), platform.limit_margins(&kept)]
                }
            };
            columns.iter_mut().zip(rows).for_each(|(column, row)| column.extend_from_slice(&row));
            Ok(())
        })?;
        let shape = [before, &[6]].concat();
        let [kept, other, transmission, left] =
            columns.map(|column| shaped(shape.clone(), column).map(|a| a.into_pyarray(py)));
        Ok(Some([kept?, other?, transmission?, left?]))
    }

    /// Speeds of legs, or of cranks in radians per second, from velocity and angular velocity, float64, shape (.., 6,
    /// 6), at poses (.., 4, 4). `None` as for `ik`. NaN: a rod does not reach, or a crank is singular.
    fn jacobian<'py>(
        &self,
        py: Python<'py>,
        poses: &Bound<'py, PyAny>,
        characteristic_length: f64,
    ) -> PyResult<Option<Bound<'py, PyArrayDyn<f64>>>> {
        let Some(array) = as_it_stands(poses) else { return Ok(None) };
        let Some((entries, before)) = pose_entries(&array) else { return Ok(None) };
        let legs = self.design.manipulator().legs();
        let mut rows = Vec::with_capacity(36 * (entries.len() / 16));
        if let Some(platform) = self.cranks(py)? {
            at_poses(py, entries, |pose| {
                let found =
                    platform.ik(&pose).ok().and_then(|angles| platform.crank_jacobian(&pose, &angles));
                let over = |(i, j): (usize, usize)| {
                    let scale = if j < 3 { 1.0 } else { characteristic_length };
                    found.map_or(f64::NAN, |found| found[(i, j)] / scale)
                };
                rows.extend((0..36).map(|k| over((k / 6, k % 6))));
                Ok(())
            })?;
            return Ok(Some(shaped([before, &[6, 6]].concat(), rows)?.into_pyarray(py)));
        }
        at_poses(py, entries, |pose| {
            // row by row: the columns of the transposed matrix
            rows.extend_from_slice(
                jacobian_of_legs(&legs, &pose, characteristic_length).transpose().as_slice(),
            );
            Ok(())
        })?;
        Ok(Some(shaped([before, &[6, 6]].concat(), rows)?.into_pyarray(py)))
    }

    /// The characteristic length, by which moments are divided in condition numbers.
    fn characteristic_length(&self) -> f64 {
        self.design.characteristic_length()
    }

    /// All finite poses for six lengths, or for six crank angles.
    fn fk(
        &self,
        py: Python<'_>,
        lengths: [f64; 6],
        seed: u64,
        method: Option<&str>,
        pose_count: bool,
    ) -> PyResult<NativeSolutions> {
        let options = options(py, seed, method, pose_count)?;
        if let Some(platform) = self.cranks(py)? {
            let found = py.detach(|| platform.fk(&lengths, &options)).map_err(|e| raised(py, e.into()))?;
            return Ok(NativeSolutions::new(
                found,
                SolvedFor::Angles(Arc::clone(&self.design), Box::new(platform.clone()), lengths),
            ));
        }
        let found = py.detach(|| self.design.fk_with(lengths, options)).map_err(|e| raised(py, e))?;
        Ok(NativeSolutions::new(found, SolvedFor::Lengths(Arc::clone(&self.design), lengths)))
    }

    /// All finite poses with each row of lengths, or of angles of cranks (n, 6); of `real_only` batches the real ones.
    #[allow(clippy::too_many_arguments, reason = "Python gives each by its name")]
    fn fk_batch<'py>(
        &self,
        py: Python<'py>,
        lengths: PyReadonlyArray2<'py, f64>,
        threads: Option<usize>,
        seed: u64,
        method: Option<&str>,
        pose_count: bool,
        real_only: bool,
    ) -> PyResult<SolutionArrays<'py>> {
        let rows = lengths_in(py, &lengths.as_array())?;
        let threads = threads_of(py, threads)?;
        let options = options(py, seed, method, pose_count)?;
        let cancel = Cancel::new();
        let cranks = self.cranks(py)?.cloned();
        let found = py.detach(|| {
            let solved: Box<dyn Iterator<Item = _>> = if let Some(platform) = cranks {
                Box::new(solve_angles(platform, rows.into_iter(), options, threads, &cancel))
            } else {
                Box::new(self.prepared(options).threads(threads).cancel(&cancel).solve_all(rows))
            };
            let mut found = SolutionColumns::new(real_only);
            for (k, row) in solved.enumerate() {
                found.push(&row);
                if k % SIGNALS == 0 && interrupted() {
                    cancel.cancel();
                    return Err(Error::Cancelled);
                }
            }
            Ok(found)
        });
        found.map_err(|e| raised(py, e))?.into_arrays(py)
    }

    /// Tracks real poses from `start` (1, 4, 4).
    fn tracker(&self, py: Python<'_>, start: PyReadonlyArray3<'_, f64>) -> PyResult<NativeTracker> {
        let start = poses_in(py, &start.as_array())?;
        let first = start.first().ok_or_else(|| refused(py, "shape", "a tracker starts at one pose"))?;
        if let Some(platform) = self.cranks(py)? {
            let angles = platform.ik(first).map_err(|why| {
                refused(
                    py,
                    "pose",
                    &format!("the cranks do not hold the pose where the tracker starts: {why}"),
                )
            })?;
            return Ok(NativeTracker(TrackerKind::Cranks(Box::new(RotaryTracker::new(
                platform.clone(),
                *first,
                angles,
            )))));
        }
        Ok(NativeTracker(TrackerKind::Legs(Box::new(self.design.tracker(*first)))))
    }

    /// The margins of all requirements at poses (n, 4, 4). Returns names, units, and legs or joints of the columns, and
    /// float64 of shape (n, columns).
    #[allow(clippy::type_complexity)]
    fn margins<'py>(
        &self,
        py: Python<'py>,
        poses: PyReadonlyArray3<'py, f64>,
    ) -> PyResult<(Vec<(String, String, Vec<String>)>, Bound<'py, PyArray2<f64>>)> {
        let poses = poses_in(py, &poses.as_array())?;
        let required = self.design.requirements();
        let home = self.design.home_or_default();
        let terms = Terms::new(self.design.manipulator(), &required, &home);
        let fixed = terms.fixed();
        let columns: Vec<_> = terms.at(&home).into_iter().chain(fixed.iter().copied()).map(|t| t.0).collect();
        let names = columns
            .iter()
            .map(|t| {
                let unit = self.design.unit_of(t.kind.quantity());
                (t.kind.code().to_owned(), unit, self.design.names_of(*t))
            })
            .collect();
        let mut out = Array2::zeros((poses.len(), columns.len()));
        for (k, pose) in poses.iter().enumerate() {
            for (j, (_, margin)) in terms.at(pose).iter().chain(&fixed).enumerate() {
                out[[k, j]] = *margin;
            }
        }
        Ok((names, out.into_pyarray(py)))
    }

    /// The answer of `equipod check`.
    fn check(&self, py: Python<'_>, seed: u64) -> PyResult<String> {
        self.only_of_legs(py, OF_SINGULARITY)?;
        let design = Arc::clone(&self.design);
        let found = interruptible(py, move || design.check_with(seed))?;
        document(CheckAnswer::from(&found), &[&self.design], Some(seed))
    }

    /// The answer of `equipod assess`.
    fn assess(
        &self,
        py: Python<'_>,
        points: usize,
        steps: usize,
        searches: usize,
        cells: Option<usize>,
        seed: u64,
    ) -> PyResult<String> {
        let options = AssessOptions::new().points(points).steps(steps).searches(searches).seed(seed);
        let design = Arc::clone(&self.design);
        let found = interruptible(py, move || design.assess_by(&options, cells, &mut |_| {}))?;
        document(AssessAnswer::new(&self.design, &found), &[&self.design], Some(seed))
    }

    /// An equivalent of the class, given by the name of a pattern (`None`: separate joints) and offsets. Returns the
    /// design, `A` and `c`.
    fn equivalent<'py>(
        &self,
        py: Python<'py>,
        pattern: Option<&str>,
        offsets: Vec<String>,
    ) -> PyResult<WithLegMap<'py>> {
        self.only_of_legs(py, OF_LEG_MAPS)?;
        let built = || -> Result<_, Error> {
            let class = self.design.equivalents()?;
            class.build_at(&pattern.unwrap_or(SEPARATE_JOINTS).parse()?, &offsets)
        };
        let (design, map) = py.detach(built).map_err(|e| raised(py, e))?;
        let (a, c) = leg_map_arrays(py, &map);
        Ok((Self::of(design), a, c))
    }

    /// Whether the design is architecturally singular: the verdict of `check`.
    fn is_singular(&self, py: Python<'_>) -> PyResult<Option<bool>> {
        self.only_of_legs(py, OF_LEG_MAPS)?;
        let found = py.detach(|| SingularityVerdict::of(self.design.manipulator()));
        Ok(found.map_err(|e| raised(py, e.into()))?.is_singular())
    }

    /// The files of a format, as names and texts.
    fn export(&self, py: Python<'_>, format: &str) -> PyResult<Vec<(String, String)>> {
        let format = format.parse().map_err(|e: num::names::UnknownName| raised(py, e.into()))?;
        let files = py.detach(|| self.design.export(format)).map_err(|e| raised(py, e))?;
        Ok(files.into_iter().map(|f| (f.name, f.text)).collect())
    }

    fn __eq__(&self, other: &Self) -> bool {
        self.design == other.design
    }
}
