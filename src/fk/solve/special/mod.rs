//! Special positions of joints that take finite poses away, decided without rounding.
//!
//! *Joints on a line* and *affine hexagons* have bounds of their own. In general poses are lost at infinity. The
//! closure of the group in the sixteen coordinates of `pose_count` has dimension 6 and degree 40. Its points at
//! infinity are `M = mu u v^T`, `y = eta u`, `x = xi v`, `r` with isotropic `u, v` (`u.u = v.v = 0`). A leg holds there
//! when
//!
//! ```text
//! r - 2 eta alpha_i - 2 xi beta_i - 2 mu alpha_i beta_i = 0,    alpha_i = a_i.u,    beta_i = b_i.v,
//! ```
//!
//! whatever its length is. Each such point common to six legs takes one of the 40 intersections. It takes two when the
//! form is a product `(alpha - alpha_0)(beta - beta_0)`, because the closure is singular there. Theorem and proof:
//! "Points at infinity" in `docs/theory/completeness.md`. Source of the points: Gallet, Nawratil, Schicho 2014, who
//! call them bonds.
//!
//! The counts here are exact: butterflies by lines that cover the legs, inversions of two planar bodies by ranks over
//! the field of the joints.

mod lines;
mod planes;

use num::split::SplitField;
use num::surd::Surd;
use num::{Purpose, Rng};
use platform::manipulator::{ExactEnds, Manipulator};

use super::pose_count::are_points_at_infinity_finite;

/// Points at infinity common to all legs, whatever the lengths, and isolated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct PointsAtInfinity {
    /// Pairs of a line of the base and a line of the platform such that every leg ends on one of them. Each pair has
    /// four points, and each of these counts twice.
    pub(crate) butterflies: usize,
    /// Projections of two planar bodies that a linear fractional map relates: four points each.
    pub(crate) inversions: usize,
}

impl PointsAtInfinity {
    /// Lower bound on the number of the forty poses that these points take away.
    pub(crate) fn weight(self) -> usize {
        8 * self.butterflies + 4 * self.inversions
    }
}

/// The special features of the joints of a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct SpecialPosition {
    /// The largest number of legs that end on one line of a body, spanned by two of the ends.
    pub(crate) on_a_line: usize,
    /// Whether both bodies are planar and the ends on one are the images of those on the other under an affine map of
    /// the planes.
    pub(crate) affine_hexagons: bool,
    /// Common points at infinity that are shown to be isolated.
    pub at_infinity: Option<PointsAtInfinity>,
}

/// The special features of the joints of `m`; `None` when the joints are not known exactly or their numbers become too
/// long.
///
/// Nothing depends on the seed but whether an unlucky prime hides the answer.
pub(crate) fn special_position(m: &Manipulator, seed: u64) -> Option<SpecialPosition> {
    let ends = m.exact_ends()?;
    let mut rng = Purpose::POSE_COUNT.rng(seed);
    let split = SplitField::drawn(&mut rng, ends.iter().flatten().flatten())?;
    let residues = Residues::of(&split, &ends)?;
    let lines = [lines::lines(&residues, &ends, 0)?, lines::lines(&residues, &ends, 1)?];
    let butterflies = lines::covering_pairs(&lines);
    let planes = planes::charts(&residues);
    let affine_hexagons =
        planes.as_ref().is_some_and(|c| planes::are_affine_images(&residues, &ends, c).unwrap_or(false));
    let inversions = |rng: &mut Rng| planes::inversions(&residues, &ends, planes.as_ref()?, butterflies, rng);
    let found = PointsAtInfinity { butterflies, inversions: inversions(&mut rng).unwrap_or(0) };
    // a set that is finite modulo a prime is finite
    let isolated =
        found.weight() > 0 && are_points_at_infinity_finite(split.field(), &residues.ends, &mut rng);
    Some(SpecialPosition {
        on_a_line: lines::most(&lines),
        affine_hexagons,
        at_infinity: isolated.then_some(found),
    })
}

/// The ends of the legs modulo a prime. A number that does not vanish there does not vanish.
struct Residues {
    split: SplitField,
    /// Base and platform end of every leg.
    ends: [[[u64; 3]; 2]; 6],
}

impl Residues {
    fn of(split: &SplitField, ends: &[ExactEnds; 6]) -> Option<Self> {
        let point = |p: &[Surd; 3]| -> Option<[u64; 3]> {
            Some([split.residue(&p[0])?, split.residue(&p[1])?, split.residue(&p[2])?])
        };
        let legs: Vec<[[u64; 3]; 2]> =
            ends.iter().map(|[a, b]| Some([point(a)?, point(b)?])).collect::<Option<_>>()?;
        Some(Self { split: split.clone(), ends: legs.try_into().ok()? })
    }
}

#[cfg(test)]
mod tests;
