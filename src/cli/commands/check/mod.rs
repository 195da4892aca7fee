//! `equipod check`: whether a design is architecturally singular, and why.

mod record;
mod render;

use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::Answer;
use crate::design::Design;
use crate::singularity::{
    Architecture, Assembly, Conditioning, NearestSingular, assembly, conditioning, nearest_singular,
    singular_distance_at_least,
};

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json)
    design: PathBuf,
}

/// Everything that was found.
struct Checked {
    design: Design,
    architecture: Architecture,
    /// For a regular design only.
    nearest: Option<NearestSingular>,
    /// No singular design is nearer; 0 for a singular one.
    at_least: f64,
    /// For a (nearly) singular design of Griffis-Duffy type with lengths.
    assembly: Option<Assembly>,
    conditioning: Conditioning,
}

impl Checked {
    /// `None` where a singular design lies within rounding of one that is regular as written.
    fn verdict(&self) -> Option<bool> {
        let doubtful = self.nearest.as_ref().is_some_and(|n| n.within_rounding);
        (!doubtful).then(|| self.architecture.is_singular())
    }

    fn reason(&self) -> Option<&'static str> {
        match self.verdict() {
            None => Some("singular_within_rounding"),
            Some(_) => self.architecture.findings.first().map(|f| f.case.reason()),
        }
    }
}

/// Decides and explains.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let failed = |e: crate::num::linalg::LinalgError| Failure::internal(e.to_string());
    let architecture = Architecture::of(m);
    let nearest = if architecture.is_singular() {
        None
    } else {
        nearest_singular(m, context.seed()).map_err(failed)?
    };
    let at_least = if nearest.is_some() { singular_distance_at_least(m, context.seed()) } else { 0.0 };
    let conditioning = conditioning(m, context.seed()).map_err(failed)?;
    let singular_hexagon = architecture.griffis_duffy.as_ref().filter(|g| g.is_nearly_singular());
    let assembly = match (singular_hexagon, design.lengths) {
        (Some(g), Some(l)) => Some(assembly(g, m, &l.squared()).map_err(failed)?),
        _ => None,
    };
    let checked = Checked { design, architecture, nearest, at_least, assembly, conditioning };
    let exit = match checked.verdict() {
        Some(false) => Exit::Yes,
        Some(true) => Exit::No,
        None => Exit::Inconclusive,
    };
    Ok(Answer { exit, json: record::record(&checked), text: render::text(&checked) })
}
