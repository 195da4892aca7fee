//! All poses for given lengths: prepared designs, single rows and batches.

use std::num::NonZeroUsize;

use super::design::EqpDesign;
use super::failure::{CallFault, EqpError, EqpStatus, give, items, places, read, take_back, told, write};
use ask::Solver;
use fk::{Completeness, FkOptions, FkRoot, FkSolutions, Reality, Threads};

/// A design prepared for many lengths. It is immutable, and threads may share it.
#[derive(Debug)]
pub struct EqpSolver(Solver);

/// All finite poses for one row of lengths, real ones first.
#[derive(Debug)]
pub struct EqpSolutions(FkSolutions);

/// Whether a list holds all poses.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpCompleteness {
    /// Nothing is known.
    Unproved = 0,
    /// The list has as many poses as counted modulo random primes; the library bounds the probability of a wrong count.
    Modular = 1,
    /// The list has as many poses as a theorem allows.
    Proved = 2,
    /// The list has all poses up to a distance, so all real ones, by a theorem; all others are proved to be farther
    /// away.
    ProvedBounded = 3,
}

/// Whether a pose is real.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpReality {
    /// The pose is not real.
    Complex = 0,
    /// The pose is real.
    Real = 1,
    /// Undecided.
    Undecided = 2,
}

/// A pose with its evidence.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EqpSolution {
    /// Real part of `R`, row by row.
    pub rotation: [[f64; 3]; 3],
    /// Real part of `p`, design units.
    pub position: [f64; 3],
    /// Imaginary part of `R`; zero for a real pose.
    pub rotation_imaginary: [[f64; 3]; 3],
    /// Imaginary part of `p`, design units.
    pub position_imaginary: [f64; 3],
    /// Whether the pose is real.
    pub reality: EqpReality,
    /// Whether a proof in interval arithmetic shows that such a pose exists near these numbers.
    pub certified: bool,
    /// Greatest error of an entry of `R` against the proved pose; infinite without a certificate.
    pub rotation_error: f64,
    /// Greatest error of an entry of `p` against the proved pose, design units; infinite without a certificate.
    pub position_error: f64,
    /// The multiplicity of the pose.
    pub multiplicity: u32,
    /// Largest error of the leg equations divided by the squared size of the design.
    pub residual: f64,
}

/// Greatest errors of the numbers of a root against the pose proved by its certificate: of `R` and of `p`.
fn errors(root: &FkRoot) -> (f64, f64) {
    let Some(certificate) = &root.certificate else { return (f64::INFINITY, f64::INFINITY) };
    let discs = certificate.enclosure();
    // differences and sums round up by a few units in the last place
    let up = |x: f64| x * (1.0 + 1e-12);
    let rotation = (0..9).map(|k| {
        let (i, j) = (k / 3, k % 3);
        up((root.pose.rotation[(i, j)] - discs.rotation[i][j].centre).norm() + discs.rotation[i][j].radius)
    });
    let position = (0..3)
        .map(|i| up((root.pose.position[i] - discs.position[i].centre).norm() + discs.position[i].radius));
    (rotation.fold(0.0, f64::max), position.fold(0.0, f64::max))
}

impl From<&FkRoot> for EqpSolution {
    fn from(root: &FkRoot) -> Self {
        let (r, p) = (&root.pose.rotation, &root.pose.position);
        let (rotation_error, position_error) = errors(root);
        Self {
            rotation: std::array::from_fn(|i| std::array::from_fn(|j| r[(i, j)].re)),
            position: std::array::from_fn(|i| p[i].re),
            rotation_imaginary: std::array::from_fn(|i| std::array::from_fn(|j| r[(i, j)].im)),
            position_imaginary: std::array::from_fn(|i| p[i].im),
            reality: match root.reality {
                Reality::Real => EqpReality::Real,
                Reality::NonReal => EqpReality::Complex,
                Reality::Undecided => EqpReality::Undecided,
            },
            certified: root.certified(),
            rotation_error,
            position_error,
            multiplicity: root.multiplicity,
            residual: root.residual,
        }
    }
}

/// Prepares a design; the solver does not need the design afterwards. The same seed gives the same answers.
///
/// # Safety
/// `design` is a design, `solver` points to a place for a pointer, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solver_new(
    design: *const EqpDesign,
    seed: u64,
    solver: *mut *mut EqpSolver,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let design = &read(design, "design")?.design;
            give(EqpSolver(design.solver(FkOptions::new().seed(seed))), solver, "solver")
        })
    }
}

/// Frees a solver; null is ignored.
///
/// # Safety
/// `solver` is null or a solver that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solver_free(solver: *mut EqpSolver) {
    // SAFETY: the caller's promise.
    unsafe { take_back(solver) }
}

/// All finite poses, real and complex, for six lengths.
///
/// # Safety
/// `solver` is a solver, `lengths` points to six numbers, and `solutions` to a place for a pointer. The argument
/// `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solve(
    solver: *const EqpSolver,
    lengths: *const f64,
    solutions: *mut *mut EqpSolutions,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let found = read(solver, "solver")?.0.solve(*read(lengths.cast::<[f64; 6]>(), "lengths")?)?;
            give(EqpSolutions(found), solutions, "solutions")
        })
    }
}

/// Finds all finite poses for each of `count` rows of lengths, with up to `threads` threads; 0 means one for each
/// processor. A row that fails has a null pointer in `solutions`, and its code in `statuses`, which may be null. It
/// does not affect other rows. Returns the first code that is not `EQP_STATUS_OK`, with its message.
///
/// # Safety
/// `solver` is a solver, `lengths` points to `count` rows of six numbers, and `solutions` to places for `count`
/// pointers. The argument `statuses` is null or points to places for `count` codes. The argument `error` is null or
/// points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solve_all(
    solver: *const EqpSolver,
    lengths: *const f64,
    count: usize,
    threads: usize,
    solutions: *mut *mut EqpSolutions,
    statuses: *mut EqpStatus,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let solver = &read(solver, "solver")?.0;
            let rows = items(lengths.cast::<[f64; 6]>(), count, "lengths")?.to_vec();
            let solutions = places(solutions, count, "solutions")?;
            let mut statuses =
                if statuses.is_null() { None } else { Some(places(statuses, count, "statuses")?) };
            solutions.fill(std::ptr::null_mut());
            let threads = NonZeroUsize::new(threads).map_or(Threads::All, Threads::Count);
            let mut first = Ok(());
            for (k, found) in solver.clone().threads(threads).solve_all(rows).enumerate() {
                let status = match found.map_err(CallFault::from) {
                    Ok(found) => {
                        solutions[k] = Box::into_raw(Box::new(EqpSolutions(found)));
                        EqpStatus::Ok
                    }
                    Err(fault) => {
                        let status = fault.status;
                        if first.is_ok() {
                            first = Err(fault);
                        }
                        status
                    }
                };
                if let Some(statuses) = &mut statuses {
                    statuses[k] = status;
                }
            }
            first
        })
    }
}

/// Frees a list of poses; null is ignored.
///
/// # Safety
/// `solutions` is null or a list that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solutions_free(solutions: *mut EqpSolutions) {
    // SAFETY: the caller's promise.
    unsafe { take_back(solutions) }
}

/// Number of poses in a list; 0 for null.
///
/// # Safety
/// `solutions` is null or a list.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solutions_count(solutions: *const EqpSolutions) -> usize {
    // SAFETY: the caller's promise.
    unsafe { solutions.as_ref() }.map_or(0, |s| s.0.roots.len())
}

/// Whether a list holds all poses; `EQP_COMPLETENESS_UNPROVED` for null.
///
/// # Safety
/// `solutions` is null or a list.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solutions_completeness(solutions: *const EqpSolutions) -> EqpCompleteness {
    // SAFETY: the caller's promise.
    match unsafe { solutions.as_ref() }.map(|s| &s.0.completeness) {
        Some(Completeness::Proved { .. }) => EqpCompleteness::Proved,
        Some(Completeness::ProvedBounded { .. }) => EqpCompleteness::ProvedBounded,
        Some(Completeness::Modular { .. }) => EqpCompleteness::Modular,
        _ => EqpCompleteness::Unproved,
    }
}

/// The pose with this index in a list, from 0.
///
/// # Safety
/// `solutions` is a list, and `solution` points to a place for a pose with its evidence. The argument `error` is null
/// or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_solutions_get(
    solutions: *const EqpSolutions,
    index: usize,
    solution: *mut EqpSolution,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let roots = &read(solutions, "solutions")?.0.roots;
            let root = roots.get(index).ok_or_else(|| {
                CallFault::new(EqpStatus::BadIndex, format!("pose {index} of a list of {}", roots.len()))
            })?;
            *write(solution, "solution")? = root.into();
            Ok(())
        })
    }
}
