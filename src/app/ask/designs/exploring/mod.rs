//! Explores a design: the best platform of its class, or an equivalent platform for a design that is not octahedral.

mod general;
mod octahedral;

use std::ops::ControlFlow;
use std::time::Duration;

use thiserror::Error as ThisError;

pub use self::general::{ExploredDesign, NEAREST_EXTENSION, nearest_options};
pub use self::octahedral::{DefaultSafetyMargin, ExploreFinding, ExploredClass};
use crate::optimizing::{EXTENSION, Watch, ends_of};
use crate::{Design, Error, NoReplaceableLegs, OptimizeOptions, OptimizeProgress, SAMPLES};
use files::design::DriveTable;
use fk::{FkError, FkOptions, FkSolutions, PoseCounting};
use num::Cancel;
use platform::manipulator::{LegLengths, Octahedral};
use synthesis::relocate::search::SearchError;
use verify::{VerdictWord, VerifyError};

/// The progress of the exploration.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ExploreProgress {
    /// A stage begins: its number, from 1, and its name.
    Stage(usize, &'static str),
    /// The progress of the search for the best platform, or for a platform on holes.
    Search(OptimizeProgress),
    /// A search has ended, and another one may begin.
    Searched,
}

/// Options of [`Design::explore`].
#[derive(Debug)]
pub struct ExploreOptions<'a> {
    seed: u64,
    samples: usize,
    extension: Option<f64>,
    drives: Option<&'a DriveTable>,
    watch: Watch<'a, ExploreProgress>,
}

impl Default for ExploreOptions<'_> {
    fn default() -> Self {
        Self { seed: 1, samples: SAMPLES, extension: None, drives: None, watch: Watch::default() }
    }
}

impl<'a> ExploreOptions<'a> {
    /// The defaults: seed 1, ten samples of the comparison.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    num::setters! {
        /// Sets the seed of all random numbers.
        fn seed(seed: u64) = seed;
        /// Sets the number of length sets; two designs are solved and compared at each.
        fn samples(samples: usize) = samples;
        /// Sets the greatest distance of a joint beyond a corner, on the extension of its side, in lengths of the side.
        /// The default is 0.3, and 1 for the nearest octahedral platform of a design that is not octahedral.
        fn extension(extension: Option<f64>) = extension;
        /// Sets the drives to choose from, for octahedral designs ([`OptimizeOptions::drives`]).
        fn drives(table: Option<&'a DriveTable>) = table;
        /// Sets the time limit of search and assessments from now on ([`OptimizeOptions::time_limit`]).
        fn time_limit(limit: Option<Duration>) watch.ends = limit.and_then(ends_of);
        /// Sets the cancellation of the search for the best platform; the answer has the best platform until then.
        fn cancel(cancel: &Cancel) watch.cancel = cancel.clone();
        /// Sets a function that sees the progress, and may end the search for the best platform.
        fn on_progress(observe: impl FnMut(ExploreProgress) -> ControlFlow<()> + 'a) watch.on_progress = Some(Box::new(observe));
    }

    /// Announces a stage. Every stage is run: only searches and assessments can be ended.
    fn stage(&mut self, number: usize, name: &'static str) {
        let _ = self.watch.tell(ExploreProgress::Stage(number, name));
    }

    /// Options of forward kinematics.
    fn fk(&self) -> FkOptions {
        FkOptions::new().seed(self.seed).pose_count(PoseCounting::Never)
    }

    /// Options of the search for the best platform.
    fn optimize(&mut self, explains: bool) -> OptimizeOptions<'_> {
        let extension = self.extension.unwrap_or(EXTENSION);
        let mut options = OptimizeOptions::new().seed(self.seed).extension(extension).explains(explains);
        options.drives = self.drives;
        options.watch = self.watch.of_part(ExploreProgress::Search);
        options
    }
}

/// The reason why a design is not explored.
#[derive(Debug, ThisError)]
#[non_exhaustive]
pub enum NoExploration {
    /// The best platform cannot be searched for.
    #[error(transparent)]
    Search(Error),
    /// Its joints cannot be put on holes.
    #[error(transparent)]
    Holes(Error),
    /// The families of replaceable legs cannot be found.
    #[error(transparent)]
    Families(#[from] NoReplaceableLegs),
    /// Equivalent platforms cannot be searched for.
    #[error(transparent)]
    Moves(#[from] SearchError),
    /// Two designs cannot be compared.
    #[error(transparent)]
    Comparison(#[from] VerifyError),
    /// There are no poses.
    #[error(transparent)]
    Poses(#[from] NoOwnPoses),
}

/// The results for a design.
#[derive(Debug)]
pub enum ExploreReport {
    /// An octahedral design.
    Class(Box<ExploredClass>),
    /// Another design.
    General(Box<ExploredDesign>),
}

/// The verdict of `explore`: the verdict of the comparison, or the reason why there was none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ExploreVerdict {
    /// Every branch of offsets is proved to violate the limits, or no start met the requirements together.
    Infeasible,
    /// No other platform without shared joints is equivalent to the design. Either no leg can be replaced, or every
    /// platform made of its replaceable legs shares joints.
    None,
    /// The platform found violates requirements.
    Violated,
    /// The platform meets its requirements; its triangles were chosen too, so it is not equivalent to the design.
    NewKinematics,
    /// The platform meets its requirements with its joints on the holes that the design states.
    OnHoles,
    /// The verdict of the comparison; also `inconclusive` if no offsets were found and some branches are not proved
    /// empty.
    #[serde(untagged)]
    Compared(VerdictWord),
}

impl ExploreVerdict {
    /// The word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Infeasible => "infeasible",
            Self::None => "none",
            Self::Violated => "violated",
            Self::NewKinematics => "new_kinematics",
            Self::OnHoles => "on_holes",
            Self::Compared(verdict) => verdict.name(),
        }
    }
}

/// The source of the leg lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LengthsOrigin {
    /// The lengths of the design.
    Design,
    /// The lengths at the home pose, since the design has none.
    Home,
}

/// All poses of a design at its own leg lengths.
#[derive(Debug)]
pub struct OwnPoses {
    /// The lengths.
    pub lengths: LegLengths,
    /// The source of the lengths.
    pub origin: LengthsOrigin,
    /// The poses.
    pub solutions: FkSolutions,
}

/// The reason why there are no poses.
#[derive(Debug, Clone, PartialEq, ThisError)]
#[non_exhaustive]
pub enum NoOwnPoses {
    /// Neither the design nor its home pose has lengths.
    #[error("the home pose has no finite leg lengths")]
    NoLengths,
    /// Forward kinematics failed.
    #[error(transparent)]
    Fk(#[from] FkError),
}

impl Design {
    /// The poses at the lengths of the design, or at the lengths of its home pose.
    ///
    /// # Errors
    /// [`NoOwnPoses`].
    pub fn own_poses(&self, options: &FkOptions) -> Result<OwnPoses, NoOwnPoses> {
        let m = self.manipulator();
        let (lengths, origin) = match self.lengths {
            Some(lengths) => (lengths, LengthsOrigin::Design),
            None => (self.home_or_default().lengths(m).ok_or(NoOwnPoses::NoLengths)?, LengthsOrigin::Home),
        };
        let solutions = fk::solver(None).solve(m, &lengths.squared(), options)?;
        Ok(OwnPoses { lengths, origin, solutions })
    }

    /// Explores the design. For an octahedral design: the best platform without shared joints, and its comparison with
    /// the design. For other designs: replaceable legs, an equivalent platform made by moving legs, and the nearest
    /// octahedral platform.
    ///
    /// # Errors
    /// [`NoExploration`].
    pub fn explore(&self, options: ExploreOptions<'_>) -> Result<ExploreReport, NoExploration> {
        Ok(match Octahedral::recognise(self.manipulator()) {
            Ok(octahedral) => ExploreReport::Class(Box::new(ExploredClass::of(self, octahedral, options)?)),
            Err(_) => ExploreReport::General(Box::new(ExploredDesign::of(self, options)?)),
        })
    }
}
