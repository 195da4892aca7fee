//! The number of finite poses of a class, computed instead of tabulated.

use std::collections::BTreeMap;

use super::Class;
use super::generator::{LengthsFrom, problem};
use super::run::claims_of;
use super::validator::validate;
use fk::{FkOptions, ForwardKinematics, PoseCounting};

/// Number of members solved to find the number of poses.
const MEMBERS: u64 = 7;
/// Members and problems are drawn with different seeds.
const APART: u64 = 0x5eed_0fc0;

/// The most frequent validated number of roots over several members, each with the better of two starts. `None` if
/// nothing could be solved.
pub(super) fn expected_count(
    class: Class,
    lengths: LengthsFrom,
    seed: u64,
    reference: &dyn ForwardKinematics,
) -> Option<usize> {
    let mut votes: BTreeMap<usize, u32> = BTreeMap::new();
    for k in 0..MEMBERS {
        let Ok(member) = problem(class, lengths, seed ^ APART, k) else { continue };
        let counts = [1, 2].map(|start| {
            let options =
                FkOptions::new().seed(seed.wrapping_add(1_000 + start)).pose_count(PoseCounting::Never);
            let found = reference.solve(&member.manipulator, &member.squares, &options).ok()?;
            let claims = claims_of(&member, &found).0;
            Some(validate(&member, &claims, &[]).counted)
        });
        if let Some(count) = counts.into_iter().flatten().max() {
            *votes.entry(count).or_default() += 1;
        }
    }
    // of equally frequent counts take the larger, since a failure loses roots
    votes.into_iter().max_by_key(|(count, votes)| (*votes, *count)).map(|(count, _)| count)
}
