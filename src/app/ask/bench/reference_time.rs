//! Two eigenvalue problems as units of time, so that figures from different machines can be compared.

use std::time::Instant;

use num::dense::{eigenvalues, generalized_eigenpairs};
use num::linalg::LinalgError;
use num::{Purpose, Rng};

const RUNS: usize = 12;

/// Two reference timings on this machine, in microseconds, or ratios to these timings.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "files", derive(serde::Serialize, schemars::JsonSchema), schemars(rename = "ReferenceRecord", transform = num::nullable))]
pub struct ReferenceTimes {
    /// Generalised eigenvalues, random 69 x 69 pair.
    pub qz69: f64,
    /// Eigenvalues, random 40 x 40 matrix.
    pub eig40: f64,
}

/// A random matrix with standard normal entries.
fn random_matrix(n: usize, rng: &mut Rng) -> Vec<Vec<f64>> {
    (0..n).map(|_| (0..n).map(|_| rng.normal()).collect()).collect()
}

fn median_of_runs(mut once: impl FnMut() -> Result<(), LinalgError>) -> Result<f64, LinalgError> {
    let mut times = Vec::with_capacity(RUNS);
    for _ in 0..=RUNS {
        let start = Instant::now();
        once()?;
        times.push(start.elapsed().as_secs_f64() * 1e6);
    }
    let mut times = times.split_off(1); // the first run warms up
    times.sort_by(f64::total_cmp);
    Ok(times[RUNS / 2])
}

/// Measures both references.
///
/// # Errors
/// An iteration that does not converge, which does not happen for random matrices.
pub fn reference_times(seed: u64) -> Result<ReferenceTimes, LinalgError> {
    let mut rng = Purpose::REFERENCE_MATRICES.rng(seed);
    let (a, b) = (random_matrix(69, &mut rng), random_matrix(69, &mut rng));
    let square = random_matrix(40, &mut rng);
    let keep = |n: usize| {
        std::hint::black_box(n);
    };
    Ok(ReferenceTimes {
        qz69: median_of_runs(|| generalized_eigenpairs(&a, &b).map(|p| keep(p.len())))?,
        eig40: median_of_runs(|| eigenvalues(&square).map(|v| keep(v.len())))?,
    })
}
