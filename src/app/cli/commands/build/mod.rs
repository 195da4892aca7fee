//! `equipod build`: from the design on paper to the workshop.

pub(super) mod drives;
pub(super) mod round;
pub(super) mod tolerances;

use clap::Subcommand;

use crate::app::cli::{Answer, Context, Failure};

/// Commands about building a design.
#[derive(Debug, Subcommand)]
pub(crate) enum BuildCommand {
    /// Find the cheapest drive of a table with which the design meets its requirements
    Drives(drives::BuildDrivesArgs),
    /// Put the joints on a grid of holes, exactly equivalent or as near as the grid allows
    Round(round::BuildRoundArgs),
    /// Compute the joint errors allowed for a given accuracy of the pose
    Tolerances(tolerances::BuildTolerancesArgs),
}

impl BuildCommand {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Drives(args) => drives::run(args, context),
            Self::Round(args) => round::run(args, context),
            Self::Tolerances(args) => tolerances::run(args, context),
        }
    }
}
