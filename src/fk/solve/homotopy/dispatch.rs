//! The tracker, for the vector unit of the machine.

use num_complex::Complex64;
use pulp::{Simd, WithSimd};

use super::limits::TrackerLimits;
use super::system::SectionHomotopy;
use super::tracker::{Tracked, track_lanes};
use num::vector_unit::on_vector_unit;

struct TrackAll<'a> {
    homotopy: &'a SectionHomotopy,
    starts: &'a [[Complex64; 8]],
    limits: &'a TrackerLimits,
    endgame_at: f64,
}

impl WithSimd for TrackAll<'_> {
    type Output = Vec<Tracked>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<Tracked> {
        track_lanes(simd, self.homotopy, self.starts, self.limits, self.endgame_at)
    }
}

/// [`track_lanes`] on the vector unit of this machine.
pub(crate) fn track_all(
    homotopy: &SectionHomotopy,
    starts: &[[Complex64; 8]],
    limits: &TrackerLimits,
    endgame_at: f64,
) -> Vec<Tracked> {
    on_vector_unit(TrackAll { homotopy, starts, limits, endgame_at })
}
