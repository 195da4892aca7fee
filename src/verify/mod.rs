//! Decides whether two platforms are kinematically equivalent, by two kinds of evidence: the leg map between them, and the poses that forward kinematics of both,
//! solved independently, finds.
//!
//! Only this module sees both `synthesis` (leg maps) and `fk` (poses).

mod determined;
mod judgement;
mod matching;
mod sample;
mod verdict;

pub use judgement::judge;
pub use matching::{PoseMatching, match_poses};
pub use sample::Sample;
pub use verdict::{
    Counterexample, InconclusiveReason, SAME_POSE, Verdict, Verification, VerifyError, VerifyRun, verify,
    verify_each, verify_mapped,
};
