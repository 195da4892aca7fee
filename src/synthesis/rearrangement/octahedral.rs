//! Whether a design is equivalent to an octahedral one.
//!
//! The replaceable legs of an octahedral design are the six sides of a hexagon of lines between two planes, and nothing
//! else (`docs/theory/octahedral-class.md`). Every equivalent design has the same replaceable legs, so any other family
//! proves that no octahedral design is equivalent.

use super::pieces::{Piece, PlaneGroups, scroll};
use super::sample::{Arrangement, DesignSample, leg_through};
use num::exact::{ExactVector, rank};
use platform::manipulator::{Body, ExactLeg};
use platform::topology::Topology;

/// The answer.
#[derive(Debug, Clone, PartialEq)]
pub enum Reduction {
    /// An equivalent octahedral design.
    Octahedral(Arrangement),
    /// No octahedral design is equivalent.
    Not(NoOctahedralEquivalent),
}

/// The reason why no octahedral design is equivalent.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NoOctahedralEquivalent {
    /// The joints of a body span space; those of equivalent designs do too.
    BodyInSpace(Body),
    /// There is a family of dimension two or three.
    Surface,
    /// There is a replaceable leg whose ends have no further partners: it belongs to no line of legs.
    LegOnNoLine,
}

impl NoOctahedralEquivalent {
    /// The name used in JSON and in the documentation.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::BodyInSpace(Body::Base) => "base_in_space",
            Self::BodyInSpace(Body::Platform) => "platform_in_space",
            Self::Surface => "surface",
            Self::LegOnNoLine => "leg_on_no_line",
        }
    }
}

/// The decision from all families.
pub(super) fn from_families(sample: &DesignSample, pieces: &[Piece]) -> Option<Reduction> {
    if let Some(body) = in_space(sample) {
        return Some(Reduction::Not(NoOctahedralEquivalent::BodyInSpace(body)));
    }
    if pieces.iter().any(|p| p.dimension() > 1) {
        return Some(Reduction::Not(NoOctahedralEquivalent::Surface));
    }
    if pieces.iter().any(|p| !p.has_common_joint()) {
        return Some(Reduction::Not(NoOctahedralEquivalent::LegOnNoLine));
    }
    corners(sample, pieces).map(Reduction::Octahedral)
}

/// The decision from the cubics of two planes.
pub(super) fn from_cubics(
    sample: &DesignSample,
    planes: &PlaneGroups,
    legs: &[ExactLeg],
) -> Option<Reduction> {
    let reason = if legs.iter().any(|l| planes.alone(l)) {
        NoOctahedralEquivalent::LegOnNoLine
    } else if scroll(sample) {
        NoOctahedralEquivalent::Surface
    } else {
        return None;
    };
    Some(Reduction::Not(reason))
}

pub(super) fn in_space(sample: &DesignSample) -> Option<Body> {
    Body::BOTH.into_iter().find(|b| sample.dimension(*b) == 3)
}

/// The legs between the fixed joints of the six lines.
fn corners(sample: &DesignSample, pieces: &[Piece]) -> Option<Arrangement> {
    let own: Vec<ExactVector> = sample.legs().iter().map(ExactLeg::vector).collect();
    let fixed = |base: bool| {
        let side = move |p: &&Piece| if base { p.base.len() == 1 } else { p.platform.len() == 1 };
        pieces.iter().filter(side).map(move |p| if base { &p.base[0] } else { &p.platform[0] })
    };
    let mut legs = Vec::new();
    for a in fixed(true) {
        for b in fixed(false) {
            let leg = leg_through(a, b)?;
            if rank(&[own.clone(), vec![leg.vector()]].concat()) == 6 {
                legs.push(leg);
            }
        }
    }
    let found = Arrangement::of_legs(&legs)?;
    let of = |end: fn(&(usize, usize)) -> usize| found.legs().map(|l| end(&l));
    let zigzag = Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
    let is_zigzag = Topology::of_legs(of(|l| l.0), of(|l| l.1)) == zigzag;
    (is_zigzag && found.is_equivalent_to(&Arrangement::of_sample(sample)?)).then_some(found)
}
