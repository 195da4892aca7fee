//! `equipod sweep status`: the finished and the missing shards.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::sweep_folder::SweepFolder;
use crate::app::cli::{Answer, Exit, Failure};
use records::SweepStatusAnswer;

/// Arguments of `sweep status`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepStatusArgs {
    /// Folder of the sweep
    folder: PathBuf,
}

/// Reads all parts.
pub(crate) fn run(args: &SweepStatusArgs) -> Result<Answer, Failure> {
    let status = SweepFolder::open(&args.folder)?.status();
    let exit = if status.missing.is_empty() { Exit::Yes } else { Exit::No };
    let text = text(&status);
    Ok(Answer::new(exit, status, text))
}

pub(super) fn text(s: &SweepStatusAnswer) -> String {
    let mut out = format!(
        "{}: {} of {} shards finished; {} rows of {} candidates, {} with an error\n",
        s.name,
        s.done.len(),
        s.shards,
        s.rows,
        s.candidates,
        s.failed
    );
    if !s.missing.is_empty() {
        let _ = writeln!(out, "missing: {}", s.missing_ranges);
    }
    for d in &s.damaged {
        let _ = writeln!(out, "shard {}: {}", d.shard, d.reason);
    }
    if !s.unfinished.is_empty() {
        let _ = writeln!(out, "being written, or left by an interrupted run: {}", s.unfinished.join(", "));
    }
    out
}
