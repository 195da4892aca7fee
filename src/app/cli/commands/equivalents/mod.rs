//! `equipod equivalents`: the platforms equivalent to a design, with proofs.

pub(in crate::app::cli::commands) mod components;
mod family;
mod map;
pub(in crate::app::cli::commands) mod r#move;
pub(in crate::app::cli::commands) mod nearest;
pub(in crate::app::cli::commands) mod topologies;

use clap::Subcommand;

use crate::app::cli::{Answer, Context, Failure};

/// Commands about equivalent designs.
#[derive(Debug, Subcommand)]
pub(crate) enum EquivalentsCommand {
    /// List every platform equivalent to an octahedral design, or write one of them
    Family(family::EquivalentsFamilyArgs),
    /// List the families of legs that can be moved without changing the platform
    Components(components::EquivalentsComponentsArgs),
    /// List the 34 topologies, the ways to share joints that can hold a platform, or name the topology of a design
    Topologies(topologies::EquivalentsTopologiesArgs),
    /// Move legs along their families, or search for an equivalent platform with given properties
    Move(r#move::EquivalentsMoveArgs),
    /// Find the octahedral platform nearest to a design, and the error of using it
    Nearest(nearest::EquivalentsNearestArgs),
    /// Compute the affine map between the squared leg lengths of two designs
    Map(map::EquivalentsMapArgs),
}

impl EquivalentsCommand {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Family(args) => family::run(args, context),
            Self::Components(args) => components::run(args, context),
            Self::Topologies(args) => topologies::run(args, context),
            Self::Move(args) => r#move::run(args, context),
            Self::Nearest(args) => nearest::run(args, context),
            Self::Map(args) => map::run(args, context),
        }
    }
}
