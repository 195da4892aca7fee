//! Legs with joint offsets over cells of poses: positions of their second axes, with first and second derivatives.
//!
//! The directions `w`, `w'` to the second axes solve `w = F(w', pose)`, `w' = G(w, pose)` (`docs/theory/joints.md`).
//! Their values are enclosed by repeated enclosure from the cube. The derivatives of either order are linear in those
//! of the same order at the other end: `X = T X' + C`, `X' = T' X + C'`. `C` is the formula's value without derivatives
//! of that order. `|T| <= l = d' / r` and `|T'| <= l' = d / r'`, with the least lengths `r`, `r'` of the vectors before
//! normalisation. So So
//!
//! ```text
//! |X'| <= (|C'| + l' |C|) / (1 - l l'),      X in C + l |X'| [-1, 1]^3.
//! ```

use super::frame::{CellFrame, LegOverCell};
use crate::requirements::Requirements;
use crate::requirements::coupled::{LegNumber, PlacedLeg, cross, dot, minus, scaled, unit};
use num::interval::Interval;
use num::jet::{Jet, JetVector, norm_squared};
use platform::geom::enclosed::IntervalVector;
use platform::geom::{Chart, arc_cosine, radians};
use platform::manipulator::Manipulator;

/// Rounds of shrinking the enclosures of the directions of a leg.
const ROUNDS: usize = 8;

/// The joint offsets of a design, enclosed.
#[derive(Debug)]
pub(super) struct JointOffsets {
    /// First axes at base and platform in the frames of their bodies, unit vectors.
    axes: [[IntervalVector; 6]; 2],
    /// Whether the second axis at an end matters.
    needed: [bool; 2],
    offsets: [f64; 2],
    /// Lead of the screws, design units per radian.
    lead: Option<Interval>,
    /// Sines and cosines of the angles between the second axes at home.
    at_home: [[Interval; 2]; 6],
}

/// A leg over the poses of a frame with the directions to its second axes.
struct PlacedOverCell {
    leg: PlacedLeg<Jet>,
    ends: [JetVector; 2],
}

impl JointOffsets {
    /// `None` for ideal joints, or if the drives have no determined lengths at home.
    pub(super) fn new(m: &Manipulator, required: &Requirements, home: &Chart) -> Option<Self> {
        let hardware = &required.hardware;
        if !hardware.is_coupled() {
            return None;
        }
        let screw = hardware.screw_lead.filter(|lead| *lead != 0.0);
        let joints = platform::manipulator::Body::BOTH.map(|body| hardware.universal(body));
        let offsets = joints.map(|joint| joint.map_or(0.0, |joint| joint.offset));
        let needed = [0, 1].map(|end| joints[end].is_some() && (offsets[end] != 0.0 || screw.is_some()));
        let mut axes = [[[Interval::ZERO; 3]; 6]; 2];
        for end in (0..2).filter(|end| needed[*end]) {
            let Some(joint) = joints[end] else { continue };
            for (axis, given) in axes[end].iter_mut().zip(&joint.first_axes) {
                let given = (*given)?;
                *axis = unit(&std::array::from_fn(|k| Interval::from(given[k])))?;
            }
        }
        let lead = match screw {
            Some(lead) => Some(Interval::from(lead).checked_div(radians(360.0))?),
            None => None,
        };
        let mut out = Self { axes, needed, offsets, lead, at_home: [[Interval::ZERO; 2]; 6] };
        if lead.is_some() {
            let frame = CellFrame::over(home, &home.root, false);
            for i in 0..6 {
                let placed = out.placed(&frame, m, i)?;
                let [sine, cosine] = placed.leg.twist(&placed.ends)?;
                out.at_home[i] = [sine.value, cosine.value];
            }
        }
        Some(out)
    }

    /// Whether screws couple the rotation of the legs about themselves to their lengths.
    pub(super) fn have_lead(&self) -> bool {
        self.lead.is_some()
    }

    /// `None` where the second axes may be undetermined.
    fn placed(&self, frame: &CellFrame<'_>, m: &Manipulator, i: usize) -> Option<PlacedOverCell> {
        let bare = frame.bare_leg(m, i);
        let axes = [frame.fixed(&self.axes[0][i]), frame.turned(&self.axes[1][i])];
        let constant = |x: f64| frame.constant(Interval::from(x));
        let leg = PlacedLeg { line: bare.line, arm: bare.arm, axes, offsets: self.offsets.map(constant) };
        let ends = self.directions(&leg)?;
        Some(PlacedOverCell { leg, ends })
    }

    fn directions(&self, leg: &PlacedLeg<Jet>) -> Option<[JetVector; 2]> {
        let zero = leg.line[0].alike(Interval::ZERO);
        let mut ends = [[zero; 3]; 2];
        // an end is explicit if the other one has no offset
        for end in (0..2).filter(|end| self.needed[*end] && self.offsets[1 - *end] == 0.0) {
            ends[end] = leg.direction(end, &ends[1 - end])?;
        }
        let implicit = |end: usize| self.needed[end] && self.offsets[1 - end] != 0.0;
        match [implicit(0), implicit(1)] {
            [false, false] => {}
            [true, true] => ends = self.both_directions(leg)?,
            [first, _] => {
                let end = usize::from(!first);
                ends[end] = leg.direction(end, &ends[1 - end])?;
            }
        }
        Some(ends)
    }

    /// The directions if both ends have offsets.
    fn both_directions(&self, leg: &PlacedLeg<Jet>) -> Option<[JetVector; 2]> {
        let values = |v: &JetVector| v.map(|x| x.value);
        let plain = PlacedLeg {
            line: values(&leg.line),
            arm: values(&leg.arm),
            axes: [values(&leg.axes[0]), values(&leg.axes[1])],
            offsets: self.offsets.map(Interval::from),
        };
        let mut found = [[Interval::about_zero(1.0); 3]; 2];
        for _ in 0..ROUNDS {
            for end in 0..2 {
                if let Some(next) = plain.direction(end, &found[1 - end]) {
                    found[end] = std::array::from_fn(|k| next[k].narrowed(found[end][k]));
                }
            }
        }
        // |T| at either end, rounded up
        let factor = |end: usize| -> Option<Interval> {
            let reach = scaled(&found[1 - end], plain.offsets[1 - end]);
            let aside = cross(&plain.axes[end], &minus(&plain.line, &reach));
            let least = Interval::from(dot(&aside, &aside).root()?.lo());
            Some(Interval::from(plain.offsets[1 - end].over(least)?.magnitude()))
        };
        let factors = [factor(0)?, factor(1)?];
        let gap = Interval::from(1.0) - factors[0] * factors[1];
        if !(gap.lo() > 0.0) {
            return None;
        }
        let mut ends = found.map(|v| v.map(|x| leg.line[0].alike(x)));
        for order in 1..=2 {
            let own = [leg.direction(0, &ends[1])?, leg.direction(1, &ends[0])?];
            let sizes = own.map(|v| Jet::sizes(&v, order));
            let mut widths = [sizes[0], sizes[1]];
            for end in 0..2 {
                for (k, width) in widths[end].iter_mut().enumerate() {
                    let most = sizes[1 - end][k] + factors[1 - end] * sizes[end][k];
                    *width = factors[end] * most.checked_div(gap)?;
                }
            }
            for end in 0..2 {
                ends[end] = std::array::from_fn(|k| {
                    own[end][k].widened(order, &widths[end]).with_value(found[end][k])
                });
            }
        }
        Some(ends)
    }

    /// A leg from its second axis at the base to that at the platform; `None` where these may be undetermined.
    pub(super) fn leg(&self, frame: &CellFrame<'_>, m: &Manipulator, i: usize) -> Option<LegOverCell> {
        let PlacedOverCell { leg, ends } = self.placed(frame, m, i)?;
        let line = leg.between(&ends);
        let base = frame.bare_leg(m, i).base;
        let moved = |end: usize| scaled(&ends[end], leg.offsets[end]);
        let (start, stop) = (moved(0), moved(1));
        Some(LegOverCell {
            base: std::array::from_fn(|k| base[k] + start[k]),
            arm: minus(&leg.arm, &stop),
            line,
            square: norm_squared(&line),
        })
    }

    /// The length of the drive of a leg. `None` where it may not exist, or where the leg may rotate about itself to the
    /// limit of the counted angle.
    pub(super) fn drive(&self, frame: &CellFrame<'_>, m: &Manipulator, i: usize) -> Option<Jet> {
        let PlacedOverCell { leg, ends } = self.placed(frame, m, i)?;
        let length = norm_squared(&leg.between(&ends)).root()?;
        let Some(lead) = self.lead else { return Some(length) };
        let ([s, c], [s0, c0]) = (leg.twist(&ends)?, self.at_home[i]);
        let (sine, cosine) = (s.times(c0) - c.times(s0), c.times(c0) + s.times(s0));
        Some(length - turn(&sine, &cosine)?.times(lead))
    }

    /// The rates of the drive for velocities of the platform origin and angular velocities.
    pub(super) fn rates(&self, frame: &CellFrame<'_>, m: &Manipulator, i: usize) -> Option<[Jet; 6]> {
        let PlacedOverCell { leg, ends } = self.placed(frame, m, i)?;
        let [length, twist] = leg.rates(&ends, self.lead.is_some())?;
        let lead = self.lead.unwrap_or(Interval::ZERO);
        Some(std::array::from_fn(|k| length[k] - twist[k].times(lead)))
    }
}

/// The angle with this sine and cosine, between -180 and 180 degrees. `None` where it may be at the ends, or where the
/// enclosures do not determine it.
fn turn(sine: &Jet, cosine: &Jet) -> Option<Jet> {
    let one = Interval::from(1.0);
    // derivatives of the arc sine at x, whose square is below 1
    let slopes = |x: Interval| -> Option<[Interval; 2]> {
        let left = one - x.square();
        let root = Some(left).filter(|l| l.lo() > 0.0)?.sqrt()?;
        let first = one.checked_div(root)?;
        Some([first, x * first.checked_div(left)?])
    };
    if cosine.value.lo() > 0.5 {
        let [first, second] = slopes(sine.value)?;
        let value = arc_cosine(Interval::ZERO) - arc_cosine(sine.value);
        return Some(sine.composed([value, first, second]));
    }
    let [first, second] = slopes(cosine.value)?;
    let positive = cosine.composed([arc_cosine(cosine.value), -first, -second]);
    if sine.value.lo() > 0.0 {
        Some(positive)
    } else if sine.value.hi() < 0.0 {
        Some(-positive)
    } else {
        None
    }
}
