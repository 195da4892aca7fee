//! Poses from lengths and lengths from poses.

use std::sync::Arc;

use super::Error;
#[cfg(feature = "files")]
use crate::Design;
use fk::{
    FkOptions, FkSolutions, ForwardKinematics, NearOutcome, NearSolver, PreparedDesign, Threads, solver,
};
#[cfg(feature = "files")]
use machine::rotary::RotaryPlatform;
use num::Cancel;
use num::stream::Stream;
use platform::geom::Pose;
use platform::manipulator::{LegLengths, Manipulator, SquaredLegLengths};

/// Inverse and forward kinematics of a [`Manipulator`], which has no names, units or home; a `Design` has the same
/// methods as its own.
pub trait Kinematics {
    /// Forward kinematics: all finite poses, real and complex, at these leg lengths.
    ///
    /// # Errors
    /// Values that are no lengths; a failed computation.
    fn fk<L: TryInto<LegLengths>>(&self, lengths: L) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>;

    /// As [`fk`](Self::fk), with options.
    ///
    /// # Errors
    /// The errors of [`fk`](Self::fk); a method that does not apply.
    fn fk_with<L: TryInto<LegLengths>>(&self, lengths: L, options: FkOptions) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>;

    /// Inverse kinematics: the leg lengths at a pose.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a pose so far away that the lengths overflow.
    fn ik(&self, pose: &Pose) -> Result<LegLengths, Error>;

    /// Prepares forward kinematics for many lengths.
    #[must_use]
    fn solver(&self, options: FkOptions) -> Solver;

    /// Starts tracking one real pose from lengths to lengths, for control loops.
    #[must_use]
    fn tracker(&self, start: Pose) -> Tracker;
}

impl Kinematics for Manipulator {
    fn fk<L: TryInto<LegLengths>>(&self, lengths: L) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>,
    {
        self.fk_with(lengths, FkOptions::new())
    }

    fn fk_with<L: TryInto<LegLengths>>(&self, lengths: L, options: FkOptions) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>,
    {
        let squares = lengths.try_into()?.squared();
        Ok(solver(options.method).solve(self, &squares, &options)?)
    }

    fn ik(&self, pose: &Pose) -> Result<LegLengths, Error> {
        pose.lengths(self).ok_or(Error::Overflow)
    }

    fn solver(&self, options: FkOptions) -> Solver {
        Solver::new(self.clone(), options)
    }

    fn tracker(&self, start: Pose) -> Tracker {
        Tracker { solver: NearSolver::new(self), pose: start, offsets: [0.0; 6] }
    }
}

#[cfg(feature = "files")]
impl Design {
    /// Forward kinematics: all finite poses, real and complex, at the lengths that the legs show; `&LegLengths` or six
    /// numbers. In a calibrated design the distance of two joints is the shown length minus the
    /// [offset](files::design::DesignModel::leg_offsets).
    ///
    /// ```
    /// use equipod::prelude::*;
    /// let design: Design = include_str!("../../../designs/rbt-octahedral.toml").parse()?;
    /// let found = design.fk([18.0, 18.5, 18.0, 17.5, 18.0, 17.8])?;
    /// assert_eq!(found.roots.len(), 16);
    /// let found = design.fk_with(&design.ik(&design.home_or_default())?, FkOptions::new().seed(3))?;
    /// assert!(found.real_poses().count() > 0);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Values that are no lengths; a failed computation.
    pub fn fk<L: TryInto<LegLengths>>(&self, lengths: L) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>,
    {
        self.fk_with(lengths, FkOptions::new())
    }

    /// As [`fk`](Self::fk), with options.
    ///
    /// # Errors
    /// The errors of [`fk`](Self::fk); a method that does not apply.
    pub fn fk_with<L: TryInto<LegLengths>>(
        &self,
        lengths: L,
        options: FkOptions,
    ) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>,
    {
        let distances = lengths.try_into()?.without(&self.leg_offsets())?;
        self.manipulator().fk_with::<&LegLengths>(&distances, options)
    }

    /// Inverse kinematics: the lengths that the legs show at a pose, with the
    /// [offsets](files::design::DesignModel::leg_offsets) of a calibration.
    ///
    /// # Errors
    /// [`Error::Overflow`] for a pose so far away that the lengths overflow; an offset that makes a length negative.
    pub fn ik(&self, pose: &Pose) -> Result<LegLengths, Error> {
        Ok(self.manipulator().ik(pose)?.shown_with(&self.leg_offsets())?)
    }

    /// Prepares forward kinematics for many shown lengths.
    #[must_use]
    pub fn solver(&self, options: FkOptions) -> Solver {
        Solver { offsets: self.leg_offsets(), ..self.manipulator().solver(options) }
    }

    /// Starts tracking one real pose from shown lengths to shown lengths, for control loops.
    #[must_use]
    pub fn tracker(&self, start: Pose) -> Tracker {
        Tracker { offsets: self.leg_offsets(), ..self.manipulator().tracker(start) }
    }
}

/// Forward kinematics prepared once for a design. Clones share the preparation and may move to other threads.
#[derive(Clone)]
pub struct Solver {
    manipulator: Arc<Manipulator>,
    method: Arc<dyn ForwardKinematics>,
    /// The preparation; `None` if the method has nothing to prepare.
    prepared: Option<Arc<dyn PreparedDesign>>,
    options: FkOptions,
    threads: Threads,
    cancel: Cancel,
    /// The shown length of each leg minus the distance of its joints.
    offsets: [f64; 6],
}

impl std::fmt::Debug for Solver {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { manipulator, prepared, options, threads, .. } = self;
        f.debug_struct("Solver")
            .field("manipulator", manipulator)
            .field("prepared", &prepared.is_some())
            .field("options", options)
            .field("threads", threads)
            .finish_non_exhaustive()
    }
}

impl Solver {
    /// Prepares a platform, which the solver then owns.
    #[must_use]
    pub fn new(manipulator: Manipulator, options: FkOptions) -> Self {
        let method = solver(options.method);
        let prepared = method.prepare(&manipulator, &options).map(Arc::from);
        Self {
            manipulator: Arc::new(manipulator),
            method: method.into(),
            prepared,
            options,
            threads: Threads::All,
            cancel: Cancel::new(),
            offsets: [0.0; 6],
        }
    }

    num::setters! {
        /// Sets the number of threads of [`solve_all`](Self::solve_all); by default one for each processor.
        fn threads(threads: Threads) = threads;
        /// Sets the cancellation of [`solve_all`](Self::solve_all).
        fn cancel(cancel: &Cancel) = cancel.clone();
    }

    /// All finite poses at these lengths.
    ///
    /// # Errors
    /// As [`Manipulator::fk_with`].
    pub fn solve<L: TryInto<LegLengths>>(&self, lengths: L) -> Result<FkSolutions, Error>
    where
        Error: From<L::Error>,
    {
        self.solve_shown(&lengths.try_into()?)
    }

    fn solve_shown(&self, shown: &LegLengths) -> Result<FkSolutions, Error> {
        self.solve_squared(&shown.without(&self.offsets)?.squared())
    }

    /// All finite poses at these squared distances of joints, for instance from a leg map.
    ///
    /// # Errors
    /// As [`Manipulator::fk_with`].
    pub fn solve_squared(&self, squares: &SquaredLegLengths) -> Result<FkSolutions, Error> {
        Ok(match &self.prepared {
            Some(design) => design.solve(squares, &self.options)?,
            None => self.method.solve(&self.manipulator, squares, &self.options)?,
        })
    }

    /// Solves many lengths on all cores. Result `i` belongs to row `i`, and comes as soon as it and all before it are
    /// ready. Rows are read when needed, so a table of millions needs no more memory than a short one. A row that fails
    /// does not affect others; results do not depend on the number of threads.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// let design: Design = include_str!("../../../designs/rbt-octahedral.toml").parse()?;
    /// let rows = (0..4).map(|k| [18.0, 18.5, 18.0, 17.5, 18.0, 17.8 + 0.1 * f64::from(k)]);
    /// for found in design.solver(FkOptions::new()).solve_all(rows) {
    ///     assert_eq!(found?.roots.len(), 16);
    /// }
    /// # Ok::<(), Error>(())
    /// ```
    pub fn solve_all<L, I>(&self, rows: I) -> Batch
    where
        L: TryInto<LegLengths> + Send + 'static,
        Error: From<L::Error>,
        I: IntoIterator<Item = L>,
        I::IntoIter: Send + 'static,
    {
        let solver = self.clone();
        let rows = rows.into_iter();
        let workers = self.threads.count(rows.size_hint().1.unwrap_or(usize::MAX));
        let checked = rows.map(|row| row.try_into().map_err(Error::from));
        Batch(Stream::new(checked, workers, self.cancel.clone(), move |row: Result<LegLengths, Error>| {
            solver.solve_shown(&row?)
        }))
    }
}

/// The results of [`Solver::solve_all`], in the order of the rows. Dropping it ends the work.
pub struct Batch(Stream<Result<LegLengths, Error>, Result<FkSolutions, Error>>);

impl std::fmt::Debug for Batch {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Batch").finish_non_exhaustive()
    }
}

impl Iterator for Batch {
    type Item = Result<FkSolutions, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.0.next()
    }
}

/// All finite poses for each row of crank angles, radians, on all cores and in the order of the rows; as
/// [`Solver::solve_all`].
#[cfg(feature = "files")]
pub fn solve_angles<I>(
    platform: RotaryPlatform,
    rows: I,
    options: FkOptions,
    threads: Threads,
    cancel: &Cancel,
) -> Stream<[f64; 6], Result<FkSolutions, Error>>
where
    I: Iterator<Item = [f64; 6]> + Send + 'static,
{
    let workers = threads.count(rows.size_hint().1.unwrap_or(usize::MAX));
    Stream::new(rows, workers, cancel.clone(), move |angles: [f64; 6]| Ok(platform.fk(&angles, &options)?))
}

/// Tracks one real pose without changing the assembly mode; a step allocates nothing.
#[derive(Debug, Clone)]
pub struct Tracker {
    solver: NearSolver,
    pose: Pose,
    /// The shown length of each leg minus the distance of its joints.
    offsets: [f64; 6],
}

impl Tracker {
    /// Continues the pose to these lengths. If it is lost, or a singularity is in the way, the tracker stays at its old
    /// pose.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// let design: Design = include_str!("../../../designs/rbt-octahedral.toml").parse()?;
    /// let mut pose = design.home_or_default();
    /// let mut tracker = design.tracker(pose);
    /// pose.position.x += 0.1;
    /// assert!(matches!(tracker.step(&design.ik(&pose)?)?, NearOutcome::Tracked { .. }));
    /// assert!((tracker.pose().position - pose.position).norm() < 1e-9);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Values that are no lengths.
    pub fn step<L: TryInto<LegLengths>>(&mut self, lengths: L) -> Result<NearOutcome, Error>
    where
        Error: From<L::Error>,
    {
        let distances = lengths.try_into()?.without(&self.offsets)?;
        let outcome = self.solver.solve(&distances.squared(), &self.pose);
        if let NearOutcome::Tracked { pose, .. } = &outcome {
            self.pose = *pose;
        }
        Ok(outcome)
    }

    /// The current pose of the platform.
    #[must_use]
    pub fn pose(&self) -> Pose {
        self.pose
    }
}
