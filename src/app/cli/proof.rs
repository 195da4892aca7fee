//! `--proof` of `verify`, `fk`, `check` and `assess`: the claims of the answer as a file that `equipod-check` checks.

use super::context::Context;
use super::failure::Failure;
use super::files::{self, OutputPath};
use records::ProofFile;

/// The option for a proof file.
#[derive(Debug, clap::Args)]
pub(crate) struct ProofArgs {
    /// Write the proved claims with their data to FILE (.json); `equipod-check FILE` checks them without this program
    #[arg(long, value_name = "FILE")]
    proof: Option<OutputPath>,
}

impl ProofArgs {
    /// Writes the proof if it is requested, and tells what is in it.
    pub(crate) fn write(&self, context: &Context, proof: impl FnOnce() -> ProofFile) -> Result<(), Failure> {
        let Some(path) = &self.proof else { return Ok(()) };
        let proof = proof();
        files::write_text(path, &files::record_text(&proof)?)?;
        context.note(&format!("proof {}: {}", path.display(), proof.summary()));
        Ok(())
    }
}
