//! `equipod sweep merge`: the parts of a sweep in one file.

use std::path::PathBuf;

use crate::app::cli::sweep_folder::{
    PartCheck, ShardState, SweepFolder, outside, part_failed, ranges, write_whole,
};
use crate::app::cli::{Answer, Exit, Failure, OutputPath, files};
use records::SweepMergeAnswer;
use sweep::Digested;
use sweep::part::{PartError, PartWriter};

/// Arguments of `sweep merge`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepMergeArgs {
    /// Folder of the sweep
    folder: PathBuf,
    /// Parquet file to write
    #[arg(short, long, value_name = "FILE")]
    output: OutputPath,
    /// Merge the finished parts even if others are missing
    #[arg(long)]
    partial: bool,
}

/// Reads all parts, group of rows by group of rows, and writes them in order.
pub(crate) fn run(args: &SweepMergeArgs) -> Result<Answer, Failure> {
    let folder = SweepFolder::open(&args.folder)?;
    outside(&args.output)?;
    if files::is_standard(&args.output) {
        return Err(Failure::refused(
            "file::standard_output",
            "a Parquet file is not written to standard output",
        )
        .with_help("name a file"));
    }
    let states: Vec<ShardState> =
        (0..folder.record.shards).map(|s| folder.state(s, PartCheck::Whole)).collect();
    let is_done = |s: &ShardState| matches!(s, ShardState::Done(_));
    let numbers = |requested: bool| {
        (0..).zip(&states).filter(|(_, s)| is_done(s) == requested).map(|(k, _)| k).collect::<Vec<u64>>()
    };
    let (done, missing) = (numbers(true), numbers(false));
    if done.is_empty() || !(missing.is_empty() || args.partial) {
        let message =
            format!("{}: shards {} are missing or damaged", folder.path.display(), ranges(&missing));
        return Err(Failure::new(Exit::No, "sweep::incomplete", message)
            .with_help("`equipod sweep run` computes them; --partial leaves them out"));
    }
    let first = folder.reader(done[0])?;
    let (description, columns) = (first.note("equipod.description"), first.columns);
    let requested: Vec<usize> = (0..columns.len()).collect();
    let path = &args.output;
    let failed = |e: PartError| part_failed(path, &e);
    let written = write_whole(path, |to| {
        let mut writer =
            PartWriter::new(Digested::new(to), &columns, &folder.notes(description.as_deref(), None), 0)
                .map_err(failed)?;
        let mut rows = 0;
        for shard in &done {
            let reader = folder.reader(*shard)?;
            for group in 0..reader.groups() {
                for mut row in reader.group(group, &requested).map_err(failed)? {
                    rows += 1;
                    writer.push(&mut row).map_err(failed)?;
                }
            }
        }
        let (to, bytes, sha256) = writer.finish().map_err(failed)?.finish();
        Ok(Some((to, (rows, bytes, sha256))))
    })?;
    let Some((rows, bytes, sha256)) = written else { return Err(Failure::internal("nothing was written")) };
    let output = path.display().to_string();
    let text =
        format!("wrote {output}: {rows} rows of {} parts, {bytes} bytes\nsha256 {sha256}\n", done.len());
    let answer = SweepMergeAnswer { output, parts: done.len() as u64, rows, bytes, sha256 };
    Ok(Answer::new(Exit::Yes, answer, text))
}
