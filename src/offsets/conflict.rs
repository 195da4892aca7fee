//! Why offsets cannot be feasible, in values and in words.

use super::branch::Zone;

/// Two requirements that cannot be met together; each is a proof that no offset of its set is feasible.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Conflict {
    /// Two vertices of a body are closer than the spacing: no offset can help.
    VerticesTooClose {
        /// Upper bound of the length of the edge, design units.
        distance: f64,
        /// Side of the hexagon that slides on the edge.
        side: usize,
    },
    /// The bounds leave nothing of the zone.
    OutsideBounds {
        /// Side of the hexagon.
        side: usize,
        /// The zone.
        zone: Zone,
    },
    /// The spacing from the three vertices leaves nothing of the zone within the bounds.
    NoRoom {
        /// Side of the hexagon.
        side: usize,
        /// The zone.
        zone: Zone,
        /// Length of the zone within the bounds, design units.
        available: f64,
    },
    /// Two edge joints of a body stay closer than the spacing.
    PairTooClose {
        /// The two sides.
        sides: (usize, usize),
        /// Upper bound of their distance, design units.
        greatest: f64,
    },
    /// `|det A|` stays too small: `sign det A` reaches this value at most.
    DetTooSmall {
        /// Sign of `det A`.
        sign: i8,
        /// Upper bound of `sign det A` over the box (the greatest value is at a vertex: it is affine in every offset).
        greatest: f64,
    },
    /// The linear relaxation of all spacings together is infeasible, by a Farkas certificate judged in intervals.
    Combination {
        /// How far below 0 the combination of the rows stays (`|y|_1 = 1`, the largest row about 1), dimensionless.
        strength: f64,
    },
}

impl Conflict {
    /// A short stable code.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::VerticesTooClose { .. } => "vertices_too_close",
            Self::OutsideBounds { .. } => "outside_bounds",
            Self::NoRoom { .. } => "no_room",
            Self::PairTooClose { .. } => "pair_too_close",
            Self::DetTooSmall { .. } => "det_too_small",
            Self::Combination { .. } => "combination",
        }
    }
}

impl std::fmt::Display for Conflict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::VerticesTooClose { distance, side } => {
                write!(f, "the vertices of the edge of offset {} are only {distance} apart", side + 1)
            }
            Self::OutsideBounds { side, zone } => {
                write!(f, "the bounds of offset {} leave nothing {}", side + 1, zone.words())
            }
            Self::NoRoom { side, zone, available } => write!(
                f,
                "offset {}: {available} {} is too short for the joint distance",
                side + 1,
                zone.words()
            ),
            Self::PairTooClose { sides: (i, j), greatest } => {
                write!(f, "the joints of offsets {} and {} are at most {greatest} apart", i + 1, j + 1)
            }
            Self::DetTooSmall { sign, greatest } => {
                write!(f, "{} det A is at most {greatest}", if *sign > 0 { "+" } else { "-" })
            }
            Self::Combination { strength } => {
                write!(
                    f,
                    "the joint distances exclude each other (Farkas certificate of strength {strength:.2e})"
                )
            }
        }
    }
}
