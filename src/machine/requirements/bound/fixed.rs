//! Margins independent of the pose: distances of joints, joints in the envelopes of their bodies, holes of plates.

use super::CellEvaluator;
use super::frame::enclosed;
use super::verdict::{MarginBound, MarginVerdict, verdict};
use crate::requirements::assess::Margin;
use crate::requirements::envelope;
use crate::requirements::hardware::Housing;
use crate::requirements::standing::Standing;
use crate::requirements::term::TermKind;
use num::interval::Interval;
use num::ordered::OrderedNumber;
use platform::geom::enclosed::IntervalVector;
use platform::manipulator::Body;

impl CellEvaluator<'_> {
    /// Holes of a plate, whose margins are exact up to rounding.
    fn holes(&self, found: Margin) -> MarginBound {
        let rounding = self.terms.rounding(found.term.kind, None);
        let verdict = match found.standing {
            Standing::Met => MarginVerdict::Met,
            Standing::AtLimit => MarginVerdict::AtLimit,
            Standing::Violated => MarginVerdict::Violated,
        };
        MarginBound { found, below: found.value - rounding, verdict, cells: 0, safety_margin: None }
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
                let (half, radius) = envelope::extent(housing);
                let margin = envelope.map_or(Interval::WHOLE, |e| e.margin(at, &half, radius));
                (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
            }
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, safety_margin: None }
    }

    /// Distances of joints, which are independent of the pose.
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
            let centres =
                self.required.min_joint_distance.map(|least| Interval::norm(d) - Interval::from(least));
            let [ours, theirs] = [term.first, term.second].map(|k| hardware.housings_at(body, &ends, k));
            let pairs = ours.iter().flat_map(|a| theirs.iter().filter_map(|b| Housing::pair(*a, *b)));
            let gaps = pairs.map(|[a, b]| a.gap(&b, d));
            for margin in gaps.chain(centres) {
                (below, upper) = (below.min(margin.lo()), upper.min(margin.hi()));
            }
        }
        let verdict = verdict(below, upper, self.terms.rounding(kind, None));
        MarginBound { found, below, verdict, cells: 0, safety_margin: None }
    }
}
