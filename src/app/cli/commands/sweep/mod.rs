//! `equipod sweep`: many designs from a plan, as Parquet.

mod best;
mod design;
mod merge;
mod run;
mod script;
mod status;
mod verify;

use clap::Subcommand;

use crate::app::cli::{Answer, Context, Failure};

/// Commands about sweeps.
#[derive(Debug, Subcommand)]
pub(crate) enum SweepCommand {
    /// Compute the candidates of a plan, or one shard of them; finished shards stay. Short form: `equipod sweep PLAN`
    Run(run::SweepRunArgs),
    /// List the finished, missing and damaged shards
    Status(status::SweepStatusArgs),
    /// Put the parts of a sweep into one Parquet file
    Merge(merge::SweepMergeArgs),
    /// Check the digests of all parts, and recompute a random sample bit for bit
    Verify(verify::SweepVerifyArgs),
    /// Write the best candidates as design files, with a page that compares them
    Best(best::SweepBestArgs),
    /// Write a candidate as a design file
    Design(design::SweepDesignArgs),
    /// Write a script that submits the shards to a Slurm cluster
    Script(script::SweepScriptArgs),
}

impl SweepCommand {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Run(args) => run::run(args, context),
            Self::Status(args) => status::run(args),
            Self::Merge(args) => merge::run(args),
            Self::Verify(args) => verify::run(args, context),
            Self::Best(args) => best::run(args, context),
            Self::Design(args) => design::run(args),
            Self::Script(args) => script::run(args, context),
        }
    }
}
