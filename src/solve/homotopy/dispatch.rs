//! The tracker compiled for the vector units that the machine turns out to have; the binary stays portable.

use num_complex::Complex64;
use pulp::{Arch, Simd, WithSimd};

use super::limits::TrackerLimits;
use super::system::SectionHomotopy;
use super::tracker::{Tracked, track_lanes};

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

/// [`track_lanes`] on the widest vector unit of this machine.
pub(crate) fn track_all(
    homotopy: &SectionHomotopy,
    starts: &[[Complex64; 8]],
    limits: &TrackerLimits,
    endgame_at: f64,
) -> Vec<Tracked> {
    Arch::new().dispatch(TrackAll { homotopy, starts, limits, endgame_at })
}
