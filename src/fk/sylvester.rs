//! Forward kinematics by the 15 x 15 Sylvester matrix.

use super::counted::compared_with_count;
use super::elimination::PoseCandidates;
use super::{FkError, FkOptions, FkSolutions, ForwardKinematics, Method};
use crate::solve::generic_frame::GenericProblem;
use crate::solve::sylvester::Eliminant;
use num::Purpose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Times the elimination is made anew, in other frames, while fewer than 40 poses are proved.
const ATTEMPTS: u64 = 2;

/// Forward kinematics of a general platform by the degree-40 polynomial of Lee and Shim.
///
/// Works in double-double arithmetic; every root is refined and checked against the leg equations. The set is complete
/// only when 40 distinct poses are certified. [`FkError::NotApplicable`] when the elimination degenerates: dependent
/// linear equations (planar base and platform), or a determinant that is not a polynomial of degree 40. Platforms with
/// fewer than 40 poses get an answer that says roots may be missing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sylvester;

impl ForwardKinematics for Sylvester {
    fn method(&self) -> Method {
        Method::Sylvester
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        compared_with_count(eliminated(m, s, o)?, m, s, o)
    }
}

fn eliminated(m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
    let mut candidates = PoseCandidates::default();
    let mut refusal = None;
    for attempt in 0..ATTEMPTS {
        let problem = GenericProblem::draw(m, s, &mut Purpose::GENERIC_FRAMES.item(o.seed, attempt));
        let eliminant = match Eliminant::of(&problem) {
            Ok(eliminant) => eliminant,
            Err(e) => {
                refusal = Some(e);
                continue;
            }
        };
        candidates.add(eliminant.poses(&problem));
        let found = candidates.solutions(Method::Sylvester, m, s, o)?;
        if attempt + 1 == ATTEMPTS || found.completeness.is_proved() {
            return Ok(found);
        }
    }
    match refusal {
        Some(e) if candidates.is_empty() => {
            Err(FkError::NotApplicable { method: Method::Sylvester, reason: e.to_string() })
        }
        _ => candidates.solutions(Method::Sylvester, m, s, o),
    }
}
