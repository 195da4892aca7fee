//! A pose for lengths of drives, proved: an interval Newton test (Krawczyk 1969) about the pose that was found.

use nalgebra::Matrix6;

use super::{CoupledLegs, DriveState};
use crate::requirements::coupled::{PlacedLeg, Vec3, unit};
use num::interval::Interval;
use platform::geom::enclosed::{IntervalMatrix, IntervalVector, Rotation, apply, exact_rotation, times};
use platform::geom::{Pose, arc_cosine};

/// Greatest distance of the true pose of the machine from the computed one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseBound {
    /// Error of the platform origin, design units.
    pub position: f64,
    /// Error of the orientation, radians.
    pub angle: f64,
    /// Contraction factor of the Newton map about the pose, below 1.
    pub contraction: f64,
}

/// Rounds of shrinking the enclosures of the directions of a leg.
const ROUNDS: usize = 12;

/// Factor between successive sizes of the tried neighbourhood.
const WIDER: f64 = 30.0;

/// A neighbourhood of a pose: translations and rotations within `reach`, each coordinate in its unit.
struct Neighbourhood {
    rotation: Rotation,
    position: IntervalVector,
    /// Bounds the entries of `J - I`, `J` the left Jacobian of the rotation: `|w| / 2 + |w|^2 / 6`, rounded up.
    tilt: f64,
}

impl Neighbourhood {
    fn new(pose: &Pose, reach: f64, unit_of_length: f64) -> Self {
        // |w| is at most sqrt 3 times a coordinate, and exp [w]x differs from I by no more
        let turn = 1.7321 * reach;
        let rotation = exact_rotation(pose);
        let wide = Interval::about_zero(turn);
        let rotation = std::array::from_fn(|i| {
            std::array::from_fn(|j| (0..3).fold(rotation[i][j], |sum, k| sum + wide * rotation[k][j]))
        });
        let shift = Interval::from(reach) * Interval::from(unit_of_length);
        let position =
            std::array::from_fn(|k| Interval::from(pose.position[k]) + Interval::about_zero(shift.hi()));
        Self { rotation, position, tilt: turn * (0.5 + turn) }
    }
}

impl CoupledLegs {
    fn enclosed(&self, i: usize, at: &Neighbourhood) -> Option<(PlacedLeg<Interval>, [Vec3<Interval>; 2])> {
        let [base, platform] = self.manipulator.enclosed_ends(i);
        let arm = apply(&at.rotation, &platform);
        let line = std::array::from_fn(|k| arm[k] + at.position[k] - base[k]);
        let axis = |end: usize| -> Option<IntervalVector> {
            let axis: IntervalVector = std::array::from_fn(|k| Interval::from(self.axes[end][i][k]));
            if self.needs(end) { unit(&axis) } else { Some(axis) }
        };
        let axes = [axis(0)?, apply(&at.rotation, &axis(1)?)];
        let placed = PlacedLeg { line, arm, axes, offsets: self.offsets.map(Interval::from) };
        let all = if self.needs(0) || self.needs(1) { Interval::about_zero(1.0) } else { Interval::ZERO };
        let mut ends = [0, 1].map(|end| if self.needs(end) { [all; 3] } else { [Interval::ZERO; 3] });
        for _ in 0..ROUNDS {
            for end in (0..2).filter(|end| self.needs(*end)) {
                // the first rounds may give no enclosure where the offsets are large
                if let Some(next) = placed.direction(end, &ends[1 - end]) {
                    ends[end] = std::array::from_fn(|k| next[k].narrowed(ends[end][k]));
                }
            }
        }
        Some((placed, ends))
    }

    /// The length of a drive at the pose itself, enclosed.
    fn enclosed_drive(&self, i: usize, pose: &Pose, twist: f64) -> Option<Interval> {
        let (placed, ends) = self.enclosed(i, &Neighbourhood::new(pose, 0.0, 1.0))?;
        let s = placed.between(&ends);
        let length = (s[0].square() + s[1].square() + s[2].square()).sqrt()?;
        if self.lead == 0.0 {
            return Some(length);
        }
        let (home, at_home) = self.enclosed(i, &Neighbourhood::new(&self.home, 0.0, 1.0))?;
        let ([s1, c1], [s0, c0]) = (placed.twist(&ends)?, home.twist(&at_home)?);
        let turned = angle(s1 * c0 - c1 * s0, c1 * c0 + s1 * s0, twist)?;
        let lead = self.enclosed_lead()?;
        Some(length - lead * turned)
    }

    /// The lead per radian is a quotient that was rounded.
    fn enclosed_lead(&self) -> Option<Interval> {
        Interval::new(self.lead.next_down().next_down(), self.lead.next_up().next_up())
    }

    /// Error bound of a given pose for exactly these drive lengths. The test proves that a neighbourhood holds exactly
    /// one pose with these lengths.
    pub(super) fn bound(
        &self,
        pose: &Pose,
        states: &[DriveState; 6],
        drives: &[f64; 6],
    ) -> Option<PoseBound> {
        let unit_of_length = self.manipulator.platform_rms_radius();
        let slopes = Matrix6::from_fn(|i, k| states[i].rates[k] * if k < 3 { unit_of_length } else { 1.0 });
        let inverse = slopes.try_inverse()?;
        let mut missing = [Interval::ZERO; 6];
        for i in 0..6 {
            missing[i] = self.enclosed_drive(i, pose, states[i].twist)? - Interval::from(drives[i]);
        }
        let step = |r: usize| {
            (0..6).fold(Interval::ZERO, |sum, k| sum + Interval::from(inverse[(r, k)]) * missing[k])
        };
        let eta = (0..6).map(|r| step(r).magnitude()).fold(0.0, f64::max);
        let mut reach = eta.max(f64::MIN_POSITIVE) * 2.0;
        let mut best: Option<(f64, f64)> = None;
        for _ in 0..3 {
            let Some(kappa) = self.contraction(pose, reach, &inverse) else { break };
            // eta + kappa reach < reach: the Newton map takes the neighbourhood into itself and contracts
            let inside = (Interval::from(eta) + Interval::from(kappa) * Interval::from(reach)).hi() < reach;
            if kappa < 1.0 && inside {
                best = Some((kappa, eta));
                break;
            }
            reach *= WIDER;
        }
        let (kappa, eta) = best?;
        let away = Interval::from(eta).checked_div(Interval::from(1.0) - Interval::from(kappa))?.hi();
        // three coordinates and a root of three, rounded up; the quaternion defines the pose
        let norm = (Interval::from(away) * Interval::from(1.7321)).hi();
        Some(PoseBound {
            position: (Interval::from(norm) * Interval::from(unit_of_length)).hi(),
            angle: norm,
            contraction: kappa,
        })
    }

    /// The largest row sum of `I - X H'` over a neighbourhood.
    fn contraction(&self, pose: &Pose, reach: f64, inverse: &Matrix6<f64>) -> Option<f64> {
        let unit_of_length = self.manipulator.platform_rms_radius();
        let at = Neighbourhood::new(pose, reach, unit_of_length);
        let lead = if self.lead == 0.0 { Interval::ZERO } else { self.enclosed_lead()? };
        let mut slopes: IntervalMatrix = [[Interval::ZERO; 6]; 6];
        for (i, row) in slopes.iter_mut().enumerate() {
            let (placed, ends) = self.enclosed(i, &at)?;
            let [length, twist] = placed.rates(&ends, self.lead != 0.0)?;
            let rates: [Interval; 6] = std::array::from_fn(|k| length[k] - lead * twist[k]);
            for k in 0..3 {
                row[k] = rates[k] * Interval::from(unit_of_length);
                let tilted =
                    (3..6).fold(Interval::ZERO, |sum, j| sum + rates[j] * Interval::about_zero(at.tilt));
                row[k + 3] = rates[k + 3] + tilted;
            }
        }
        let product = times(inverse, &slopes);
        let row = |r: usize| {
            (0..6).fold(Interval::ZERO, |sum, k| {
                let identity = if r == k { Interval::from(1.0) } else { Interval::ZERO };
                sum + Interval::from((identity - product[r][k]).magnitude())
            })
        };
        let worst = (0..6).map(|r| row(r).hi()).fold(0.0, f64::max);
        worst.is_finite().then_some(worst)
    }
}

/// The angle with this sine and cosine that is near another one.
fn angle(sine: Interval, cosine: Interval, near: f64) -> Option<Interval> {
    let right = arc_cosine(Interval::ZERO);
    if cosine.lo() > 0.5 {
        return Some(right - arc_cosine(sine));
    }
    // the cosine alone determines the angle if its sign is known
    let known = arc_cosine(cosine);
    if sine.lo() > 0.0 && near > 0.0 {
        Some(known)
    } else if sine.hi() < 0.0 && near < 0.0 {
        Some(-known)
    } else {
        None
    }
}
