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
    let mut map = leg_map(a, b, LegMapTolerances::default())?;
    if map.relation == Relation::Singular {
        return Ok(map);
    }
    let found = [SingularityVerdict::of(a)?, SingularityVerdict::of(b)?];
    // independent leg vectors may belong to dependent lines
    let dependent = found.iter().find(|f| f.is_singular() == Some(true)).and_then(SingularityVerdict::level);
    let near = found.iter().find_map(|f| f.meant.as_ref()).map(|near| near.distance);
    map.architectures = Some(Box::new(found.map(|f| f.architecture)));
    let doubles = map.relation == Relation::Equivalent && map.level == Level::DoublesAsWritten;
    Ok(match (dependent, near) {
        (Some(level), _) => map.with_dependent_lines(level),
        (None, Some(distance)) if doubles => map.near_singular(distance),
        _ => map,
    })
}
