//! Decides whether two platforms are kinematically equivalent, by two kinds of evidence: the leg map between them, and
//! the poses that forward kinematics of both, solved independently, finds.
//!
//! It knows `num`, `platform`, `fk` and `synthesis`, and is the only room that sees both of the last two: the map is
//! never asked where the poses are, nor the poses what the map is.
//!
//! * [`Verdict`]: equivalent, not equivalent, singular, or not decided, and at which level.
//! * [`Verification`]: the verdict with the map and all samples.
//! * [`Sample`]: one set of lengths, the poses of both platforms, and how they match.
//!
//! Two designs are judged by [`judge`] on exact joints first; then lengths are drawn, mapped, and solved twice, and the
//! two sets of poses are matched one to one.

mod determined;
mod judgement;
mod matching;
mod sample;
mod verdict;

pub use judgement::judge;
pub use matching::{PoseMatching, match_poses};
pub use sample::Sample;
pub use verdict::{
    Counterexample, InconclusiveReason, SAME_POSE, Verdict, VerdictWord, Verification, VerifyError,
    VerifyRun, verify, verify_each, verify_mapped,
};
