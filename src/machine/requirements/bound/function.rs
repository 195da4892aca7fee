//! The functions bounded over cells; their least values give the least margins of a kind.

use super::CellEvaluator;
use crate::requirements::envelope::Envelope;
use crate::requirements::term::{Term, TermKind};
use platform::manipulator::Body;

/// A bounded function: one requirement, or several that are computed together.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum BoundedFunction {
    /// Length, joint angle or speed of a leg.
    Leg(TermKind, usize),
    /// Two legs.
    Pair(usize, usize),
    /// A leg and a keep-out.
    Body(usize, usize),
    /// A leg and the plate of a body.
    Plate(usize, Body),
    /// A leg and the payload.
    Payload(usize),
    /// All leg forces under a load.
    Load(usize),
    /// The softest motion of the platform on its legs.
    Platform(TermKind),
    /// A side of the envelope of the machine, or its cylinder, and the joint at an end (0 base, 1 platform) of a leg.
    Joint { leg: usize, end: usize, side: Side },
}

/// A part of an envelope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Side {
    /// The cylinder.
    Round,
    /// The side of a box with the least value of a coordinate.
    Least(usize),
    /// The side with the greatest.
    Greatest(usize),
}

impl BoundedFunction {
    pub(super) fn has(self, term: &Term) -> bool {
        match self {
            Self::Leg(kind, i) => term.kind == kind && term.first == i,
            Self::Pair(i, j) => term.kind == TermKind::LegClearance && (term.first, term.second) == (i, j),
            Self::Body(i, k) => term.kind == TermKind::KeepOut && (term.first, term.second) == (i, k),
            Self::Plate(i, body) => {
                term.kind == TermKind::PlateClearance && (term.first, term.second) == (i, body.index())
            }
            Self::Payload(i) => term.kind == TermKind::PayloadClearance && term.first == i,
            Self::Load(k) => {
                matches!(term.kind, TermKind::LegForce | TermKind::CrankTorque) && term.second == k
            }
            Self::Platform(kind) => term.kind == kind,
            Self::Joint { leg, end, .. } => {
                term.kind == TermKind::MachineEnvelope && (term.first, term.second) == (leg, end)
            }
        }
    }
}

impl CellEvaluator<'_> {
    pub(super) fn functions(&self, kind: TermKind) -> Vec<BoundedFunction> {
        let pairs = self.m.pairs();
        match kind {
            TermKind::LegClearance => (0..6)
                .flat_map(|i| (i + 1..6).map(move |j| (i, j)))
                .filter(|(i, j)| pairs[*i].0 != pairs[*j].0 && pairs[*i].1 != pairs[*j].1)
                .map(|(i, j)| BoundedFunction::Pair(i, j))
                .collect(),
            TermKind::KeepOut => (0..6)
                .flat_map(|i| (0..self.required.keep_outs.len()).map(move |k| BoundedFunction::Body(i, k)))
                .collect(),
            TermKind::PlateClearance => {
                let stated = Body::BOTH.into_iter().filter(|body| self.terms.plate(*body).is_some());
                stated.flat_map(|body| (0..6).map(move |i| BoundedFunction::Plate(i, body))).collect()
            }
            TermKind::PayloadClearance => (0..6).map(BoundedFunction::Payload).collect(),
            TermKind::LegForce | TermKind::CrankTorque => {
                (0..self.required.loads.len()).map(BoundedFunction::Load).collect()
            }
            TermKind::MachineEnvelope => {
                let sides: Vec<Side> = match self.required.envelopes.machine {
                    None => Vec::new(),
                    Some(Envelope::Cylinder { .. }) => vec![Side::Round],
                    Some(Envelope::Box { .. }) => {
                        (0..3).flat_map(|k| [Side::Least(k), Side::Greatest(k)]).collect()
                    }
                };
                let ends = (0..6).flat_map(|leg| [(leg, 0), (leg, 1)]);
                ends.flat_map(|(leg, end)| {
                    sides.iter().map(move |side| BoundedFunction::Joint { leg, end, side: *side })
                })
                .collect()
            }
            kind if kind.is_of_platform() => vec![BoundedFunction::Platform(kind)],
            // joints of other kinds have no such angle
            kind if kind.hinge().is_some() => {
                let has_limit = |i: &usize| self.required.hardware.angle_limit_deg(kind, *i).is_some();
                (0..6).filter(has_limit).map(|i| BoundedFunction::Leg(kind, i)).collect()
            }
            _ => (0..6).map(|i| BoundedFunction::Leg(kind, i)).collect(),
        }
    }
}
