//! Solves many problems on all cores.
//!
//! Problems are handed out one by one, and each result goes to the place of its problem. Each result is computed on one
//! thread from its own data and the options alone. So results depend neither on the number of threads nor on which
//! thread took which problem.

use std::num::NonZeroUsize;

use super::{FkError, FkOptions, FkSolutions, ForwardKinematics};
use num::parallel::parallel;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// The number of threads that a batch may use.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Threads {
    /// The number that the process may run at the same time; one if it is unknown.
    #[default]
    All,
    /// This many.
    Count(NonZeroUsize),
}

impl Threads {
    /// The number of threads for `jobs` jobs: never more than there are jobs, never none.
    #[must_use]
    pub fn count(self, jobs: usize) -> usize {
        let most = match self {
            Self::All => std::thread::available_parallelism().map_or(1, NonZeroUsize::get),
            Self::Count(n) => n.get(),
        };
        most.min(jobs).max(1)
    }
}

/// Result of one problem.
pub type BatchResult = Result<FkSolutions, FkError>;

/// Solves one design, [prepared](ForwardKinematics::prepare) where there are several leg lengths; result `i` belongs to
/// `lengths[i]`. A problem that fails leaves the others as they are.
///
/// ```
/// # mod equipod {
/// #     pub use equipod_fk::*;
/// #     pub mod methods {
/// #         pub use equipod_fk as fk; pub use equipod_fk::solve;
/// #         pub use platform::{geom, manipulator};
/// #     }
/// # }
/// use equipod::methods::fk::{Automatic, FkOptions, Threads, solve_batch};
/// use equipod::methods::manipulator::{LegLengths, Manipulator};
/// use nalgebra::Point3;
/// let triangle = |r: f64| vec![Point3::origin(), Point3::new(r / 2.0, r, 0.0), Point3::new(r, 0.0, 0.0)];
/// let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let m = Manipulator::try_new(triangle(12.0), triangle(6.0), legs)?;
/// let rows: Result<Vec<_>, _> =
///     [17.0, 17.5, 18.0].map(|l| LegLengths::try_new([l, 18.0, 18.0, 17.0, 15.0, 17.8])).into_iter().collect();
/// let squares: Vec<_> = rows?.iter().map(|l| l.squared()).collect();
/// let found = solve_batch(&Automatic, &m, &squares, &FkOptions::default(), Threads::All);
/// assert_eq!(found.len(), 3);
/// assert!(found.iter().all(|f| f.as_ref().is_ok_and(|f| f.roots.len() == 16)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn solve_batch(
    solver: &dyn ForwardKinematics,
    m: &Manipulator,
    lengths: &[SquaredLegLengths],
    options: &FkOptions,
    threads: Threads,
) -> Vec<BatchResult> {
    // preparation pays from the second row on
    let prepared = if lengths.len() > 1 { solver.prepare(m, options) } else { None };
    in_order(lengths.len(), threads, &|i| match &prepared {
        Some(design) => design.solve(&lengths[i], options),
        None => solver.solve(m, &lengths[i], options),
    })
}

/// `job(0), .., job(count - 1)`, in this order whatever the threads.
pub fn in_order<T: Send>(count: usize, threads: Threads, job: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    parallel(count, threads.count(count), job, &mut |_, _| ())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Automatic, Homotopy, Method, NearSolver, Octic, OcticSolver, Sylvester, Template};
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    fn threads(n: usize) -> Threads {
        Threads::Count(NonZeroUsize::new(n).unwrap())
    }

    fn octahedral(count: usize) -> (Manipulator, Vec<SquaredLegLengths>) {
        let mut rng = Rng::new(11);
        let mut triangle =
            || (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)))).collect();
        let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let m = Manipulator::try_new(triangle(), triangle(), legs).unwrap();
        let mut draw = || {
            let position = Vector3::from_fn(|_, _| rng.normal());
            Pose { rotation: random_rotation(&mut rng), position }.squared_lengths(&m).unwrap()
        };
        let squares = (0..count).map(|_| draw()).collect();
        (m, squares)
    }

    #[test]
    fn solvers_may_be_shared_between_threads() {
        fn shared<T: Send + Sync>() {}
        shared::<Automatic>();
        shared::<Homotopy>();
        shared::<Octic>();
        shared::<Sylvester>();
        shared::<Template>();
        shared::<OcticSolver>();
        shared::<NearSolver>();
        shared::<crate::solve::certify::Certifier>();
        shared::<crate::solve::certify::octahedral::OctahedralCertifier>();
        shared::<FkSolutions>();
        shared::<Box<dyn ForwardKinematics>>();
        shared::<Box<dyn crate::PreparedDesign>>();
    }

    #[test]
    fn the_results_are_the_same_for_any_number_of_threads() {
        let (m, squares) = octahedral(40);
        let options = FkOptions::default();
        let text = |n: usize| format!("{:?}", solve_batch(&Automatic, &m, &squares, &options, threads(n)));
        let one = text(1);
        assert_eq!(one, text(2));
        assert_eq!(one, text(5));
        let single: Vec<BatchResult> = squares.iter().map(|s| Automatic.solve(&m, s, &options)).collect();
        assert_eq!(one, format!("{single:?}"), "prepared or not");
    }

    #[test]
    fn rows_of_a_design_followed_in_the_lengths_do_not_depend_on_threads_either() {
        let mut rng = Rng::new(12);
        let mut point = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
        let legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        let m = Manipulator::from_legs(legs).unwrap();
        let mut draw = || {
            let position = Vector3::from_fn(|_, _| rng.normal());
            Pose { rotation: random_rotation(&mut rng), position }.squared_lengths(&m).unwrap()
        };
        let squares: Vec<_> = (0..6).map(|_| draw()).collect();
        let options = FkOptions::default();
        let text = |n: usize| format!("{:?}", solve_batch(&Automatic, &m, &squares, &options, threads(n)));
        let one = text(1);
        assert_eq!(one, text(2));
        assert_eq!(one, text(5));
        let single = Automatic.solve(&m, &squares[0], &options);
        let alone = solve_batch(&Automatic, &m, &squares[..1], &options, threads(1));
        assert_eq!(format!("{alone:?}"), format!("{:?}", [single]), "one row is not worth preparation");
    }

    #[test]
    fn an_empty_batch_has_no_results_and_more_threads_than_jobs_are_no_harm() {
        let (m, squares) = octahedral(2);
        let options = FkOptions::default();
        assert!(solve_batch(&Octic, &m, &[], &options, threads(3)).is_empty());
        assert_eq!(solve_batch(&Octic, &m, &squares, &options, threads(9)).len(), 2);
        assert_eq!((threads(9).count(2), threads(9).count(0)), (2, 1));
    }

    #[test]
    fn a_problem_that_fails_leaves_the_others_alone() {
        let (m, squares) = octahedral(3);
        let mut rng = Rng::new(4);
        let mut point = || Point3::from(Vector3::from_fn(|_, _| rng.normal()));
        let legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
        let general = Manipulator::from_legs(legs).unwrap();
        let problems = [(&m, &squares[0]), (&general, &squares[1]), (&m, &squares[2])];
        let options = FkOptions::default();
        let found = in_order(3, threads(2), &|i| Octic.solve(problems[i].0, problems[i].1, &options));
        assert!(matches!(found[1], Err(FkError::NotApplicable { method: Method::Octic, .. })));
        for i in [0, 2] {
            assert_eq!(found[i].as_ref().unwrap().roots.len(), 16);
        }
        let refused = solve_batch(&Octic, &general, &squares, &FkOptions::default(), threads(2));
        assert!(refused.iter().all(Result::is_err) && refused.len() == 3);
    }
}
