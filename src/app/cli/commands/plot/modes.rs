//! `equipod plot modes`.

use std::path::PathBuf;

use crate::app::cli::commands::{explore, fk};
use crate::app::cli::{Context, Failure};
use ::fk::FkOptions;

/// Arguments of `plot modes`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotModesArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Six lengths, design units; default: from the design or its home
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
}

pub(super) fn draw(args: &PlotModesArgs, context: &mut Context) -> Result<String, Failure> {
    let mut design = context.load(&args.design)?;
    if let Some(text) = &args.lengths {
        let six = fk::lengths::six(text, &design.leg_offsets(), &design.units).map(|given| given.distances);
        design.lengths = Some(six.map_err(|m| {
            Failure::refused("plot::bad_lengths", format!("--lengths: {m}"))
                .with_help("give six lengths separated by commas")
        })?);
    }
    explore::modes_picture(&design, &FkOptions::new().seed(context.seed()))
}
