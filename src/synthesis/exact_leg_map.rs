//! What exact arithmetic says about two sets of legs, where doubles cannot decide.
//!
//! Coordinates are taken as the binary numbers they are, so that ranks of leg vectors are true or false without a tolerance.

use crate::manipulator::{ExactLegs, Leg};
use crate::num::exact::{Rational, approximate, rank, relations};

/// Exact facts about the legs of two platforms.
pub(super) struct ExactFacts {
    /// Rank of the leg vectors of FROM.
    pub(super) from_rank: usize,
    /// Rank of the leg vectors of TO.
    pub(super) to_rank: usize,
    /// `A` and `c`, computed exactly and rounded once; `None` where some leg of TO is not exactly in the span, or the legs of FROM are dependent.
    pub(super) map: Option<([[f64; 6]; 6], [f64; 6])>,
}

impl ExactFacts {
    /// `None` when a coordinate is not finite, which no manipulator has.
    pub(super) fn of(from: &[Leg; 6], to: &[Leg; 6]) -> Option<Self> {
        let (old, new) = (ExactLegs::of(from)?, ExactLegs::of(to)?);
        let (from_rank, to_rank) = (rank(&old.vectors), rank(&new.vectors));
        let map = if from_rank == 6 { map(&old, &new) } else { None };
        Some(Self { from_rank, to_rank, map })
    }
}

/// The map between independent `old` and `new` in their span.
fn map(old: &ExactLegs, new: &ExactLegs) -> Option<([[f64; 6]; 6], [f64; 6])> {
    let (mut a, mut c) = ([[0.0; 6]; 6], [0.0; 6]);
    for (i, w) in new.vectors.iter().enumerate() {
        let mut rows = old.vectors.clone();
        rows.push(w.clone());
        // the six are independent: at most one relation, and the seventh has a part in it
        let relation = relations(&rows).pop()?;
        let row: Vec<Rational> = relation[..6].iter().map(|x| -(x / &relation[6])).collect();
        let taken: Rational = row.iter().enumerate().map(|(k, x)| x * old.squares(k)).sum();
        c[i] = approximate(&(new.squares(i) - taken));
        for (entry, x) in a[i].iter_mut().zip(&row) {
            *entry = approximate(x);
        }
    }
    Some((a, c))
}
