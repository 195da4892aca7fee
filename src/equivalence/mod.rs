//! Are two platforms kinematically equivalent? The map says so algebraically, forward kinematics of both,
//! solved independently, agrees or disagrees.
//!
//! Only this module sees both `synthesis` (leg maps) and `fk` (poses).

mod determined;
mod matching;
mod sample;
mod verdict;

pub use matching::{PoseMatching, match_poses};
pub use sample::{Sample, SamplePlan};
pub use verdict::{
    Counterexample, InconclusiveReason, SAME_POSE, Verdict, Verification, VerifyError, verify,
};
