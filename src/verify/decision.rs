//! The common verdict on two platforms, used by every command that asks for their equivalence.

use num::linalg::LinalgError;
use platform::manipulator::{Level, Manipulator};
use synthesis::singularity::SingularityVerdict;
use synthesis::{LegMapOutcome, LegMapTolerances, Relation, leg_map};

/// The relation of platforms A and B, described in the same two frames and units.
///
/// | relation | when |
/// |---|---|
/// | singular | one of the two is architecturally singular: dependent leg vectors, or dependent lines at every pose |
/// | equivalent | the leg vectors of B are combinations of those of A, with a regular `A` |
/// | unrelated | a leg vector of B is no combination of those of A |
/// | undecided | it holds within rounding only, or a singular design is within rounding of plain doubles, or joints are known between bounds only |
///
/// The first three are proved for the exact joints or for doubles as written ([`LegMapOutcome::level`]). The exception
/// is unrelated platforms whose joints are known only between bounds.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn decide_map(a: &Manipulator, b: &Manipulator) -> Result<LegMapOutcome, LinalgError> {
    let map = leg_map(a, b, LegMapTolerances::default())?;
    if map.relation == Relation::Singular {
        return Ok(map);
    }
    let found = [SingularityVerdict::of(a)?, SingularityVerdict::of(b)?];
    // independent leg vectors may belong to dependent lines
    if let Some(level) =
        found.iter().find(|f| f.is_singular() == Some(true)).and_then(SingularityVerdict::level)
    {
        return Ok(map.with_dependent_lines(level));
    }
    let doubles = map.relation == Relation::Equivalent && map.level == Level::DoublesAsWritten;
    match found.iter().find_map(|f| f.meant.as_ref()) {
        Some(near) if doubles => Ok(map.near_singular(near.distance)),
        _ => Ok(map),
    }
}
