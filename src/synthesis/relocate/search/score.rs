//! The margins of a platform.

use nalgebra::Matrix6;

use super::patterns::Pattern;
use super::pool::Pool;
use super::wishes::{Margin, Wish, Wishes};
use crate::geom::{Pose, segment_distance};
use crate::manipulator::{Leg, Manipulator, inverse_condition, jacobian_of_legs};
use crate::num::linalg::LinalgError;
use crate::synthesis::components::Components;

/// Margins of the platforms of one pattern.
pub(super) struct Scorer<'a> {
    pub(super) pool: &'a Pool<'a>,
    pub(super) found: &'a Components,
    pub(super) m: &'a Manipulator,
    pub(super) wishes: &'a Wishes,
    pub(super) pattern: &'a Pattern,
}

impl Scorer<'_> {
    /// The smallest slack at the parameters; `-infinity` where a leg does not exist.
    pub(super) fn worst(&self, x: &[f64]) -> Result<f64, LinalgError> {
        let Some(legs) = self.pool.legs(self.pattern, x)? else { return Ok(f64::NEG_INFINITY) };
        Ok(worst(&self.margins(&legs)))
    }

    /// All margins of six legs of the pattern, in its order.
    pub(super) fn margins(&self, legs: &[Leg; 6]) -> Vec<Margin> {
        let (w, size) = (self.wishes, self.m.size());
        let above = |wish, value: f64, required: f64, unit: f64| Margin {
            wish,
            value,
            required,
            slack: if value.is_finite() { (value - required) / unit } else { f64::NEG_INFINITY },
        };
        let mut out = vec![
            above(Wish::Spacing, self.spacing(legs), w.spacing, size),
            above(Wish::Conditioning, self.conditioning(legs), w.conditioning, 1.0),
        ];
        if let Some(d) = w.clearance {
            out.push(above(Wish::Clearance, self.clearance(legs), d, size));
        }
        let reach = self.reach(legs);
        let slack = (w.reach - reach) / size;
        out.push(Margin { wish: Wish::Reach, value: reach, required: w.reach, slack });
        out
    }

    fn pairs() -> impl Iterator<Item = (usize, usize)> {
        (0..6).flat_map(|j| (0..j).map(move |i| (i, j)))
    }

    /// Smallest distance of two joints of one body; joints that are one in the whole pattern are left out unless none may be shared.
    fn spacing(&self, legs: &[Leg; 6]) -> f64 {
        let all = self.wishes.no_shared_joints && self.pattern.shared == 0;
        let mut least = f64::MAX;
        for (i, j) in Self::pairs() {
            if all || !self.pattern.same_base[i][j] {
                least = least.min((legs[i].base - legs[j].base).norm());
            }
            if all || !self.pattern.same_platform[i][j] {
                least = least.min((legs[i].platform - legs[j].platform).norm());
            }
        }
        least
    }

    /// Smallest distance of two legs that share no joint, at all poses.
    fn clearance(&self, legs: &[Leg; 6]) -> f64 {
        let mut least = f64::MAX;
        for pose in &self.wishes.poses {
            let segments = legs.map(|l| [l.base, pose.transform(&l.platform)]);
            for (i, j) in Self::pairs() {
                if !self.pattern.same_base[i][j] && !self.pattern.same_platform[i][j] {
                    least = least.min(segment_distance(segments[i], segments[j]));
                }
            }
        }
        least
    }

    fn conditioning(&self, legs: &[Leg; 6]) -> f64 {
        let at = |pose: &Pose| -> f64 {
            let j: Matrix6<f64> = jacobian_of_legs(legs, pose, self.wishes.characteristic_length);
            inverse_condition(&j)
        };
        self.wishes.poses.iter().map(at).fold(f64::MAX, f64::min)
    }

    fn reach(&self, legs: &[Leg; 6]) -> f64 {
        let n = self.found.span.normalisation();
        let far = |l: &Leg| (l.base - n.base_centre).norm().max((l.platform - n.platform_centre).norm());
        legs.iter().map(far).fold(0.0, f64::max)
    }
}

/// The smallest slack. The reach is a limit, nothing that is better the larger it is: it counts only where it is missed.
pub(super) fn worst(margins: &[Margin]) -> f64 {
    let counts = |m: &&Margin| m.wish != Wish::Reach || m.slack < 0.0;
    margins.iter().filter(counts).map(|m| m.slack).fold(f64::INFINITY, f64::min)
}
