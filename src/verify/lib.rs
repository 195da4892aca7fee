//! Decides whether two platforms are kinematically equivalent, by two kinds of evidence: the leg map between them, and
//! the independently solved poses of both.
//!
//! The crate uses `num`, `platform`, `fk` and `synthesis`, and is the only one that uses the last two together. The map
//! never uses the poses, and the poses never use the map.
//!
//! * [`Verdict`]: equivalent, not equivalent, singular, or undecided, and at which level.
//! * [`Verification`]: the verdict with the map and all samples.
//! * [`Sample`]: one set of lengths, the poses of both platforms, and how they match.
//!
//! [`decide_map`] first compares two designs on exact joints. Then lengths are drawn, mapped, and solved twice, and the
//! two sets of poses are matched one to one.

mod decision;
mod determined;
mod matching;
mod sample;
mod verdict;

pub use decision::decide_map;
pub use matching::{PoseMatching, match_poses};
pub use sample::Sample;
pub use verdict::{
    Counterexample, InconclusiveReason, SAME_POSE, Verdict, VerdictWord, Verification, VerifyError,
    VerifyRun, verify, verify_each, verify_mapped,
};
