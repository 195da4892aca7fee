//! Measures of how near a design is to an architectural singularity.

use crate::LegSpan;
use num::Rng;
use num::linalg::LinalgError;
use platform::geom::CentredPoses;
use platform::manipulator::{Manipulator, inverse_condition, jacobian};

/// The inverse condition number of the Jacobian at random poses.
// `sigma_min / sigma_max` with unit lines and moments over the characteristic length
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "ConditioningRecord", transform = num::nullable))]
pub struct Conditioning {
    /// Singular values of the six normalised leg vectors, largest first.
    #[cfg_attr(feature = "serde", serde(skip))]
    pub leg_vectors: [f64; 6],
    /// The number of poses.
    // any rotation, middle of the platform within the size of the middle of the base in every coordinate
    pub poses: usize,
    /// The best.
    // small for a design near singular
    pub best: f64,
    /// The median value.
    pub median: f64,
    /// The worst.
    // small for every design, because singular poses exist
    pub worst: f64,
}

/// Number of random poses.
const POSES: usize = 200;

/// The measures of `m`, with poses from `seed`.
///
/// # Errors
/// When the singular value decomposition does not converge.
pub fn conditioning(m: &Manipulator, seed: u64) -> Result<Conditioning, LinalgError> {
    let leg_vectors = LegSpan::of(m, 0.0)?.singular_values();
    let centred = CentredPoses::new(m);
    let mut rng = Rng::new(seed);
    let mut values: Vec<f64> = (0..POSES)
        .map(|_| {
            let (rotation, offset) = centred.draw(&mut rng);
            let pose = centred.pose(rotation, offset);
            inverse_condition(&jacobian(m, &pose, m.platform_rms_radius()))
        })
        .collect();
    values.sort_by(f64::total_cmp);
    let (worst, median, best) = (values[0], values[POSES / 2], values[POSES - 1]);
    Ok(Conditioning { leg_vectors, poses: POSES, best, median, worst })
}
