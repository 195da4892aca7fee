//! Irreducible families of replaceable legs in exact form.

use super::sample::{ExactLeg, integer, weighted};
use crate::num::Rng;
use crate::num::exact::Rational;
use crate::synthesis::components::exact::Exact;

/// How the ends of the legs of a [`Piece`] are paired.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PieceKind {
    /// Every leg between two flats.
    AllPairs,
    /// A projective pairing of two lines.
    Pairing,
}

/// One irreducible family of replaceable legs.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// How the ends are paired.
    pub kind: PieceKind,
    /// Homogeneous coordinates of points that span the flat of the base ends.
    pub(super) base: Vec<Exact>,
    /// Points that span the flat of the platform ends; for a pairing partner `k` belongs to base point `k`, and sums to sums.
    pub(super) platform: Vec<Exact>,
    /// Where its legs lie: summands of the span of all legs, with the dimension it has in each at most.
    pub(super) parts: Vec<usize>,
    /// That dimension.
    pub(super) weight: usize,
}

impl Piece {
    /// Dimension of the flat of its base ends.
    #[must_use]
    pub fn base_dimension(&self) -> usize {
        self.base.len().saturating_sub(1)
    }

    /// Dimension of the flat of its platform ends.
    #[must_use]
    pub fn platform_dimension(&self) -> usize {
        self.platform.len().saturating_sub(1)
    }

    /// Dimension of the family.
    #[must_use]
    pub fn dimension(&self) -> usize {
        match self.kind {
            PieceKind::AllPairs => self.base_dimension() + self.platform_dimension(),
            PieceKind::Pairing => 1,
        }
    }

    /// Number of independent legs in it.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self.kind {
            PieceKind::AllPairs => self.base.len() * self.platform.len(),
            PieceKind::Pairing => 3,
        }
    }

    /// The summands of the span of the legs in which its legs have a part; in each they span at most [`weight`](Self::weight)
    /// dimensions.
    #[must_use]
    pub fn parts(&self) -> &[usize] {
        &self.parts
    }

    /// See [`parts`](Self::parts).
    #[must_use]
    pub fn weight(&self) -> usize {
        self.weight
    }

    /// Whether all its legs, more than one, meet in a joint.
    #[must_use]
    pub fn has_common_joint(&self) -> bool {
        (self.base.len() == 1) != (self.platform.len() == 1)
    }

    /// Homogeneous coordinates of points that span the two flats, as fractions: base, platform.
    #[must_use]
    pub fn points(&self) -> [Vec<[String; 4]>; 2] {
        let text = |list: &[Exact]| {
            list.iter()
                .map(|p| std::array::from_fn(|k| p.get(k).map_or(String::new(), Rational::to_string)))
                .collect()
        };
        [text(&self.base), text(&self.platform)]
    }

    /// A leg of it at random fractions; `None` when an end is at infinity.
    pub(super) fn draw(&self, rng: &mut Rng) -> Option<ExactLeg> {
        let base = weights(self.base.len(), rng);
        let platform = match self.kind {
            PieceKind::AllPairs => weights(self.platform.len(), rng),
            PieceKind::Pairing => base.clone(),
        };
        ExactLeg::through(&weighted(&self.base, &base), &weighted(&self.platform, &platform))
    }
}

/// Barycentric coordinates, quarters and halves: points spread about the given ones.
fn weights(count: usize, rng: &mut Rng) -> Vec<Rational> {
    const LINE: [[i64; 2]; 8] = [[2, 2], [1, 3], [3, 1], [6, -2], [-2, 6], [5, -1], [-1, 5], [8, -4]];
    let quarter = |x: i64| integer(x) / integer(4);
    if count == 1 {
        return vec![integer(1)];
    }
    let mut out = vec![integer(1)];
    for _ in 1..count {
        // one point of the simplex so far, then the line to the next vertex
        let [s, t] = LINE[(rng.next_u64() % 8) as usize].map(quarter);
        for w in &mut out {
            *w *= &s;
        }
        out.push(t);
    }
    out
}
