//! Two designs compared.

use std::ops::ControlFlow;

use super::Error;
use crate::Design;
use fk::{FkOptions, Threads};
use num::Cancel;
use platform::geom::SamplePlan;
use synthesis::LegMapOutcome;
use verify::{Sample, Verification, VerifyError, VerifyRun, decide_map, verify_each};

/// The default number of sample poses.
pub const SAMPLES: usize = 10;

/// Random poses in a box about the home pose of the design, which holds the region and the ranges of its workspace.
/// Without these, poses within a quarter of the size and 20 degrees in each direction.
pub fn sample_plan(design: &Design, count: usize, seed: u64) -> SamplePlan {
    let home = design.home_or_default();
    SamplePlan::about(
        design.manipulator(),
        home,
        design.workspace.space(&home).box_about_home(),
        (count, seed),
    )
}

type OnSample<'a> = Box<dyn FnMut(&Sample) -> ControlFlow<()> + 'a>;

/// Options of [`verify_with`].
pub struct VerifyOptions<'a> {
    samples: usize,
    seed: u64,
    run: VerifyRun,
    on_sample: Option<OnSample<'a>>,
}

impl std::fmt::Debug for VerifyOptions<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { samples, seed, run, on_sample } = self;
        f.debug_struct("VerifyOptions")
            .field("samples", samples)
            .field("seed", seed)
            .field("run", run)
            .field("on_sample", &on_sample.is_some())
            .finish()
    }
}

impl Default for VerifyOptions<'_> {
    fn default() -> Self {
        Self { samples: SAMPLES, seed: 1, run: VerifyRun::default(), on_sample: None }
    }
}

impl<'a> VerifyOptions<'a> {
    /// The defaults: ten samples, seed 1, one thread for each processor.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    num::setters! {
        /// Sets the number of length sets; both platforms are solved at each.
        fn samples(samples: usize) = samples;
        /// Sets the seed of the sample poses and of forward kinematics. The answer depends on the seed and not on the
        /// number of threads.
        fn seed(seed: u64) = seed;
        /// Sets the number of threads that solve samples.
        fn threads(threads: Threads) run.threads = threads;
        /// Sets the cancellation of the comparison.
        fn cancel(cancel: &Cancel) run.cancel = cancel.clone();
        /// Sets a function that sees each sample in order as soon as it is solved, and may end the comparison.
        fn on_sample(observe: impl FnMut(&Sample) -> ControlFlow<()> + 'a) = Some(Box::new(observe));
    }
}

/// Decides whether two platforms are kinematically equivalent. The leg map gives the algebraic answer. Forward
/// kinematics of both, computed without the map, confirms or refutes it at lengths of random poses of `a`. Both designs
/// are given in the same two frames and units.
///
/// ```
/// use equipod::prelude::*;
/// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
/// let a = Design::load("designs/rbt-octahedral.toml")?;
/// let b = Design::load("designs/rbt-griffis-duffy.toml")?;
/// let found = verify(&a, &b)?;
/// assert_eq!((found.verdict.to_string().as_str(), found.samples.len()), ("equivalent", 10));
/// # Ok::<(), Error>(())
/// ```
///
/// # Errors
/// Designs in different units; a part that could not be computed.
pub fn verify(a: &Design, b: &Design) -> Result<Verification, Error> {
    verify_with(a, b, VerifyOptions::new())
}

/// As [`verify()`], with options.
///
/// # Errors
/// The errors of [`verify()`]; [`Error::Cancelled`].
pub fn verify_with(a: &Design, b: &Design, options: VerifyOptions<'_>) -> Result<Verification, Error> {
    same_units(a, b)?;
    let VerifyOptions { samples, seed, run, on_sample } = options;
    let plan = sample_plan(a, samples, seed);
    let fk = FkOptions::new().seed(seed);
    let mut observe = on_sample.unwrap_or_else(|| Box::new(|_| ControlFlow::Continue(())));
    let found = verify_each(a.manipulator(), b.manipulator(), &plan, &fk, &run, &mut observe);
    let found = found.map_err(|e| match e {
        VerifyError::Cancelled => Error::Cancelled,
        other => other.into(),
    })?;
    Ok(found)
}

/// Two designs compared, with the sample poses.
#[derive(Debug)]
pub struct ComparedDesigns {
    /// The comparison.
    pub found: Verification,
    /// The poses of the first design.
    pub plan: SamplePlan,
}

impl ComparedDesigns {
    /// Compares two designs in their given frames, at the lengths of `samples` poses of the first.
    ///
    /// # Errors
    /// The errors of the comparison ([`verify::verify`]).
    pub fn of([a, b]: [&Design; 2], samples: usize, options: &FkOptions) -> Result<Self, VerifyError> {
        let plan = sample_plan(a, samples, options.seed);
        let found = verify::verify(a.manipulator(), b.manipulator(), &plan, options)?;
        Ok(Self { found, plan })
    }
}

/// The affine map between the squared leg lengths of two platforms, `s(to) = A s(from) + c`, or the legs without such a
/// map. It is decided in exact arithmetic on the joints as the designs write them, with the level of the proof.
///
/// # Errors
/// Designs in different units; a decomposition that does not converge.
pub fn leg_map(from: &Design, to: &Design) -> Result<LegMapOutcome, Error> {
    same_units(from, to)?;
    Ok(decide_map(from.manipulator(), to.manipulator())?)
}

fn same_units(a: &Design, b: &Design) -> Result<(), Error> {
    if a.units == b.units {
        return Ok(());
    }
    Err(Error::Units(Box::new([a, b].map(|d| (d.name.clone(), d.units.clone())))))
}
