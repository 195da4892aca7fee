//! Angles of universal joints as functions that are nearly linear in the pose.
//!
//! With the leg vector `d`, the first axis `a`, the rest direction `n` across it and `e = a x n`, unit vectors,
//! `x = d.n`, `y = d.e` and `r = |(x, y)|`:
//!
//! ```text
//! r sin(limit -+ first) = x sin(limit) -+ y cos(limit),   cos(90 + second) = -d.a / |d|,   cos(90 - second) = d.a / |d|.
//! ```
//!
//! Each angle has two sides, one bound for either.

use super::cone::{Leaning, Sector, arc_margin};
use super::frame::CellFrame;
use crate::requirements::HingeAngle;
use num::interval::Interval;
use num::jet::{Jet, JetVector, dot};
use platform::geom::enclosed::{IntervalVector, cross, unit};
use platform::geom::{arc_cosine, cosine, degrees, radians, sine};
use platform::manipulator::Manipulator;

/// A universal joint: first axis, rest direction and the direction across both, orthonormal, in the frame of its body.
#[derive(Debug, Clone, Copy)]
pub(super) struct HingeFrame {
    first: IntervalVector,
    /// Rest direction and direction across; `None` if the axis of the joint may coincide with its first axis.
    plane: Option<[IntervalVector; 2]>,
}

impl HingeFrame {
    pub(super) fn new(first: &IntervalVector, axis: &IntervalVector) -> Option<Self> {
        let across = unit(&cross(first, axis));
        let plane = across.and_then(|across| Some([unit(&cross(&across, first))?, across]));
        Some(Self { first: unit(first)?, plane })
    }
}

/// An angle of a universal joint at an end of a leg, and its limit.
pub(super) struct HingeLimit<'a> {
    pub(super) m: &'a Manipulator,
    pub(super) leg: usize,
    /// Whether the joint is one of the platform and moves with it.
    pub(super) platform: bool,
    pub(super) frame: HingeFrame,
    pub(super) angle: HingeAngle,
    pub(super) limit_deg: f64,
}

impl HingeLimit<'_> {
    fn place(&self, v: &IntervalVector, frame: &CellFrame<'_>) -> JetVector {
        if self.platform { frame.turned(v) } else { frame.fixed(v) }
    }

    /// A function of both sides that increases with the [margin](Self::margin): the cosine of the first angle, or minus
    /// the squared sine of the second. `None` where the angle may be undetermined.
    pub(super) fn plain(&self, frame: &CellFrame<'_>) -> Option<Jet> {
        let leg = frame.leg(self.m, self.leg);
        match self.angle {
            HingeAngle::First => {
                let [x, y] = self.frame.plane?.map(|v| dot(&leg.line, &self.place(&v, frame)));
                Some(x * (x.square() + y.square()).inverse_root()?)
            }
            HingeAngle::Second => {
                let along = dot(&leg.line, &self.place(&self.frame.first, frame));
                Some(-(along * leg.square.inverse_root()?).square())
            }
        }
    }

    /// The margin, degrees, for a value of that function.
    pub(super) fn margin(&self, value: Interval) -> Interval {
        let limit = Interval::from(self.limit_deg);
        match self.angle {
            HingeAngle::First => limit - degrees(arc_cosine(value)),
            HingeAngle::Second => {
                let square = -value;
                let positive =
                    Interval::new(square.lo().max(0.0), square.hi().max(0.0)).unwrap_or(Interval::WHOLE);
                let sine = positive.sqrt().unwrap_or(Interval::WHOLE);
                limit - Interval::from(90.0) + degrees(arc_cosine(sine))
            }
        }
    }

    /// Whether the sides are bounded separately. First angles with limits near a right angle or beyond are not, since
    /// neither side is a half space.
    pub(super) fn has_sides(&self) -> bool {
        self.angle == HingeAngle::Second || self.limit_deg < 89.0
    }

    /// The function of a side over a frame; `None` where the leg may have length zero.
    pub(super) fn value(&self, frame: &CellFrame<'_>, side: &Sector) -> Option<Leaning> {
        let leg = frame.leg(self.m, self.leg);
        let positive = side.is_positive();
        match self.angle {
            HingeAngle::First => {
                let [x, y] = self.frame.plane?.map(|v| dot(&leg.line, &self.place(&v, frame)));
                let limit = radians(self.limit_deg);
                let (up, aside) = (x.times(sine(limit)), y.times(cosine(limit)));
                let value = if positive { up - aside } else { up + aside };
                let square = x.value.square() + y.value.square();
                Some(Leaning { value, square, along: x.value, loose: 0.0 })
            }
            HingeAngle::Second => {
                let along =
                    dot(&leg.line, &self.place(&self.frame.first, frame)) * leg.square.inverse_root()?;
                let value = if positive { -along } else { along };
                Some(Leaning { value, square: Interval::from(1.0), along: value.value, loose: 0.0 })
            }
        }
    }

    /// A lower bound of the margin, degrees, where the function of a side is at least `below` over the cell.
    pub(super) fn side_margin(&self, below: f64, over: &Leaning) -> f64 {
        match self.angle {
            HingeAngle::First => arc_margin(below, over, self.limit_deg),
            HingeAngle::Second => {
                let least = (Interval::from(self.limit_deg) - Interval::from(90.0)).lo();
                if !below.is_finite() {
                    return least;
                }
                let away = degrees(arc_cosine(Interval::from(below.clamp(-1.0, 1.0))));
                (Interval::from(self.limit_deg) + Interval::from(90.0) - away).lo().max(least)
            }
        }
    }
}
