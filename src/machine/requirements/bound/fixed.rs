//! Margins that no pose changes: distances of joints, joints in the envelopes of their bodies, holes of plates.

use super::frame::enclosed;
use super::verdict::{MarginBound, MarginVerdict, verdict};
use super::{CellJudge, dot_square};
use crate::requirements::assess::Margin;
use crate::requirements::envelope::{self, Envelope};
use crate::requirements::hardware::Housing;
use crate::requirements::standing::Standing;
use crate::requirements::term::TermKind;
use num::interval::Interval;
use platform::geom::enclosed::IntervalVector;
use platform::manipulator::Body;

impl CellJudge<'_> {
    /// Holes of a plate, whose margins are known but for rounding.
    fn holes(&self, found: Margin) -> MarginBound {
        let rounding = self.terms.rounding(found.term.kind, None);
        let verdict = match found.standing {
            Standing::Met => MarginVerdict::Met,
            Standing::AtLimit => MarginVerdict::AtLimit,
            Standing::Violated => MarginVerdict::Violated,
        };
        MarginBound { found, below: found.value - rounding, verdict, cells: 0, reserve: None }
    }

    /// Joints in the envelope of their body.
    fn joint_in_envelope(&self, found: Margin) -> MarginBound {
        let kind = found.term.kind;
        let (body, envelope) = if kind == TermKind::PlatformEnvelope {
            (Body::Platform, self.required.envelopes.platform)
        } else {
            (Body::Base, self.required.envelopes.base)
        };
        let ends = self.m.pairs().map(|p| body.of(p));
        let (mut below, mut upper) = (f64::INFINITY, f64::INFINITY);
        let joints = self.m.joints(body);
        for (term, _) in self.terms.fixed().iter().filter(|(t, _)| t.kind == kind) {
            let at = enclosed(&joints[term.first]);
            for housing in self.required.hardware.housings_at(body, &ends, term.first) {
                let (half, radius) = envelope::room(housing);
                let margin = envelope.map_or(Interval::WHOLE, |e| room_inside(&e, &at, &half, radius));
                (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
            }
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, reserve: None }
    }

    /// Distances of joints, which no pose changes.
    pub(super) fn fixed(&self, found: Margin) -> MarginBound {
        let kind = found.term.kind;
        if matches!(kind, TermKind::BaseEnvelope | TermKind::PlatformEnvelope) {
            return self.joint_in_envelope(found);
        }
        if kind.plate().is_some() {
            return self.holes(found);
        }
        let body = if kind == TermKind::PlatformSpacing { Body::Platform } else { Body::Base };
        let joints = body.of((self.m.base_joints(), self.m.platform_joints()));
        let hardware = &self.required.hardware;
        let ends = self.m.pairs().map(|p| body.of(p));
        let (mut below, mut upper) = (f64::INFINITY, f64::INFINITY);
        for (term, _) in self.terms.fixed().iter().filter(|(t, _)| t.kind == kind) {
            let (a, b) = (enclosed(&joints[term.first]), enclosed(&joints[term.second]));
            let d: IntervalVector = std::array::from_fn(|k| a[k] - b[k]);
            let norm = dot_square(&d).sqrt().unwrap_or(Interval::WHOLE);
            let centres = self.required.min_joint_distance.map(|least| norm - Interval::from(least));
            let [ours, theirs] = [term.first, term.second].map(|k| hardware.housings_at(body, &ends, k));
            let pairs = ours.iter().flat_map(|a| theirs.iter().filter_map(|b| Housing::pair(*a, *b)));
            let gaps = pairs.map(|housings| housing_gap(&housings, &d, norm));
            for margin in gaps.chain(centres) {
                (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
            }
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, reserve: None }
    }
}

/// The absolute values of an interval.
fn magnitudes(x: Interval) -> Interval {
    let least = if x.lo() <= 0.0 && x.hi() >= 0.0 { 0.0 } else { x.lo().abs().min(x.hi().abs()) };
    Interval::new(least, x.magnitude()).unwrap_or(Interval::WHOLE)
}

/// Room inside an envelope, enclosed: [`Envelope::margin`].
pub(super) fn room_inside(
    envelope: &Envelope,
    at: &IntervalVector,
    half: &nalgebra::Vector3<f64>,
    ball: f64,
) -> Interval {
    let ball = Interval::from(ball);
    match envelope {
        Envelope::Cylinder { radius, center } => {
            let reach = |k: usize| magnitudes(at[k] - Interval::from(center[k])) + Interval::from(half[k]);
            let away = (reach(0).square() + reach(1).square()).sqrt().unwrap_or(Interval::WHOLE);
            Interval::from(*radius) - ball - away
        }
        Envelope::Box { min, max } => {
            let sides = (0..3).flat_map(|k| {
                let own = Interval::from(half[k]) + ball;
                [at[k] - Interval::from(min[k]) - own, Interval::from(max[k]) - at[k] - own]
            });
            let least = |side: fn(&Interval) -> f64, all: &[Interval]| {
                all.iter().map(side).fold(f64::INFINITY, f64::min)
            };
            let all: Vec<Interval> = sides.collect();
            Interval::new(least(|x| x.lo(), &all), least(|x| x.hi(), &all)).unwrap_or(Interval::WHOLE)
        }
    }
}

/// [`Housing::gap`], enclosed; `norm` is that of `d`.
pub(super) fn housing_gap([a, b]: &[Housing; 2], d: &IntervalVector, norm: Interval) -> Interval {
    // halves of doubles are exact
    let ((half, ball), (other_half, other_ball)) = (envelope::room(Some(*a)), envelope::room(Some(*b)));
    let balls = Interval::from(ball) + Interval::from(other_ball);
    if let (Housing::Sphere(_), Housing::Sphere(_)) = (a, b) {
        return norm - balls;
    }
    let edges: IntervalVector =
        std::array::from_fn(|k| Interval::from(half[k]) + Interval::from(other_half[k]));
    let least =
        |x: Interval| if x.lo() <= 0.0 && x.hi() >= 0.0 { 0.0 } else { x.lo().abs().min(x.hi().abs()) };
    let end = |size: &dyn Fn(usize) -> f64, side: fn(Interval) -> f64| {
        let g: [f64; 3] = std::array::from_fn(|k| side(Interval::from(size(k)) - edges[k]));
        let largest = g.into_iter().fold(f64::NEG_INFINITY, f64::max);
        if largest > 0.0 {
            let positive: IntervalVector = g.map(|x| Interval::from(x.max(0.0)));
            dot_square(&positive).sqrt().map_or(largest, side)
        } else {
            largest
        }
    };
    let (lo, hi) = (end(&|k| least(d[k]), Interval::lo), end(&|k| d[k].magnitude(), Interval::hi));
    Interval::new(lo, hi).unwrap_or(Interval::WHOLE) - balls
}
