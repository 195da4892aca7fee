//! Climbing the worst margin, a function that is not smooth where two margins are equal.

use super::score::Scorer;
use crate::num::Rng;
use crate::num::linalg::LinalgError;

/// First step in every parameter; the families are written so that joints are parameters 0 and 1 apart.
const FIRST_STEP: f64 = 0.25;
/// The climb ends below this step.
const LAST_STEP: f64 = 1e-6;

/// Compass search: steps along the parameters and along random directions, halved when none helps. The value never falls.
pub(super) fn climb(
    scorer: &Scorer,
    start: Vec<f64>,
    evaluations: usize,
    rng: &mut Rng,
) -> Result<(f64, Vec<f64>), LinalgError> {
    let n = start.len();
    let mut best = (scorer.worst(&start)?, start);
    let (mut used, mut step) = (1, FIRST_STEP);
    while n > 0 && used < evaluations && step > LAST_STEP {
        let mut better = false;
        for k in 0..2 * n {
            let direction: Vec<f64> = if k < n {
                (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect()
            } else {
                // at a ridge, where two margins are equal, the parameters one by one do not climb
                (0..n).map(|_| rng.normal() / (n as f64).sqrt()).collect()
            };
            for sign in [1.0, -1.0] {
                let x: Vec<f64> = best.1.iter().zip(&direction).map(|(x, d)| x + sign * step * d).collect();
                let value = scorer.worst(&x)?;
                used += 1;
                if value > best.0 {
                    best = (value, x);
                    better = true;
                    break;
                }
            }
        }
        if !better {
            step *= 0.5;
        }
    }
    Ok(best)
}
