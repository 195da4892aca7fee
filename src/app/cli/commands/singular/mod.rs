//! `equipod singular`: singular poses and self-motions of a design.

mod locus;
pub(in crate::app::cli::commands) mod motion;
pub(in crate::app::cli::commands) mod poses;

use clap::Subcommand;

use crate::app::cli::{Answer, Context, Failure};

/// Commands about singular poses.
#[derive(Debug, Subcommand)]
pub(crate) enum SingularCommand {
    /// Find the sign of det J at poses and along paths, and a box without singular poses
    Poses(poses::SingularPosesArgs),
    /// Write det J as an exact polynomial in the position, along a line or over rotations about an axis
    Locus(locus::SingularLocusArgs),
    /// Trace self-motions, which are curves of poses with constant leg lengths
    Motion(motion::SingularMotionArgs),
}

impl SingularCommand {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Poses(args) => poses::run(args, context),
            Self::Locus(args) => locus::run(args, context),
            Self::Motion(args) => motion::run(args, context),
        }
    }
}
