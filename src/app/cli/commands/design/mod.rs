//! `equipod design`: design files and their schema.

mod convert;
mod presets;
mod schema;

use clap::Subcommand;

use crate::app::cli::{Answer, Context, Failure};

/// Commands about design files.
#[derive(Debug, Subcommand)]
pub(crate) enum DesignCommand {
    /// Write a design in the other notation, TOML or JSON
    Convert(convert::DesignConvertArgs),
    /// List designs of real hardware with their sources, or write one of them
    Presets(presets::DesignPresetsArgs),
    /// Print the JSON Schema of design files, or of the answers with --json
    Schema(schema::DesignSchemaArgs),
}

impl DesignCommand {
    /// Runs the command.
    pub(crate) fn run(&self, context: &mut Context) -> Result<Answer, Failure> {
        match self {
            Self::Convert(args) => convert::run(args, context),
            Self::Presets(args) => presets::run(args),
            Self::Schema(args) => schema::run(args),
        }
    }
}
