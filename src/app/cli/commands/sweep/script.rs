//! `equipod sweep script`: a script that submits the shards of a plan to a cluster.

#![allow(clippy::cast_sign_loss, reason = "only shares of counts are cast")]

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::app::cli::sweep_folder::{MOST_SHARDS, SweepTexts};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use records::{SweepDesignFile, SweepScriptAnswer};

use super::run::CandidateSample;

/// Arguments of `sweep script`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepScriptArgs {
    /// Plan (.toml or .json)
    plan: PathBuf,
    /// Write job arrays for Slurm (the default)
    #[arg(long)]
    slurm: bool,
    /// Folder of the parts, visible to all nodes
    #[arg(long, value_name = "DIR")]
    folder: OutputPath,
    /// Write the script; default: standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Number of shards; default: about --minutes each, from a sample
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..=MOST_SHARDS))]
    shards: Option<u64>,
    /// Target time of a shard, minutes
    #[arg(long, value_name = "M", default_value_t = 20, value_parser = clap::value_parser!(u64).range(1..=10_000))]
    minutes: u64,
    /// Number of processors for each job
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1024))]
    threads: u64,
    /// Greatest number of jobs in an array: the cluster's `MaxArraySize`
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=1_000_000))]
    array: u64,
}

/// Writes the script.
pub(crate) fn run(args: &SweepScriptArgs, context: &mut Context) -> Result<Answer, Failure> {
    let texts = SweepTexts::load(&args.plan, context)?;
    let seed = context.seed();
    let sweep = texts.sweep(seed, &files::shown(&args.plan))?;
    let each = CandidateSample::of(&sweep).seconds_each();
    let seconds = each * sweep.count() as f64 / args.threads as f64;
    let shards = args.shards.unwrap_or_else(|| {
        let needed = (seconds / (60.0 * args.minutes as f64)).ceil().clamp(1.0, MOST_SHARDS as f64);
        (needed as u64).min(sweep.count().max(1))
    });
    let script =
        Script { args, seed, shards, minutes: seconds / 60.0 / shards as f64, name: &sweep.plan.name }
            .text()?;
    let (file, text) = match &args.output {
        Some(path) => {
            files::write_text(path, &script)?;
            let output = path.display().to_string();
            let text = format!(
                "wrote {output}: {shards} {} of about {:.1} min; `bash {output}` submits the sweep\n",
                if shards == 1 { "shard" } else { "shards" },
                seconds / 60.0 / shards as f64
            );
            (SweepDesignFile::Written { output }, text)
        }
        None => (SweepDesignFile::Given { text: script.clone() }, script),
    };
    let arrays = shards.div_ceil(args.array);
    let answer =
        SweepScriptAnswer { shards, arrays, seconds_per_shard: (seconds / shards as f64).into(), file };
    Ok(Answer::new(Exit::Yes, answer, text))
}

struct Script<'a> {
    args: &'a SweepScriptArgs,
    seed: u64,
    shards: u64,
    /// The time of a shard, minutes.
    minutes: f64,
    name: &'a str,
}

impl Script<'_> {
    fn text(&self) -> Result<String, Failure> {
        let Self { args, seed, shards, minutes, name } = self;
        let (plan, folder) = (quoted(&absolute(&args.plan)?), quoted(&absolute(&args.folder)?));
        let word: String =
            name.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).take(40).collect();
        // three times the time expected from the sample, and five minutes for a slow start
        let limit = (3.0 * minutes).ceil() + 5.0;
        let mut out = String::from("#!/usr/bin/env bash\n");
        let _ = write!(
            out,
            "# {shards} shards of about {minutes:.1} minutes on {} processor(s) each, written by equipod {}.\n\
             # `bash THIS_FILE` submits them and, after them, the check and the merge. A second time it submits what is missing.\n\
             set -euo pipefail\n\
             plan={plan}\nfolder={folder}\nseed={seed}\nshards={shards}\narray={}\nthreads={}\n\
             options=(--job-name={word} --time={limit:.0} --cpus-per-task=\"$threads\" --output=\"$folder/slurm-%A-%a.log\")\n\
             # where the program is: the environment of the one who submits is that of the jobs\n\
             equipod=${{EQUIPOD:-equipod}}\n\n",
            args.threads,
            env!("CARGO_PKG_VERSION"),
            args.array,
            args.threads,
        );
        out.push_str(
            r#"case ${1:-submit} in
submit)
    mkdir -p "$folder"
    jobs=
    for ((offset = 0; offset < shards; offset += array)); do
        last=$((shards - offset < array ? shards - offset - 1 : array - 1))
        # shards that are done already end at once
        job=$(sbatch --parsable "${options[@]}" --array="0-$last" "$0" shard "$offset")
        jobs=$jobs:${job%%;*}
        echo "shards $offset to $((offset + last)): job ${job%%;*}"
    done
    # after shards that failed too: it says which are missing
    job=$(sbatch --parsable "${options[@]}" --output="$folder/slurm-%j-merge.log" --dependency="afterany$jobs" "$0" merge)
    echo "check and merge: job ${job%%;*}, $folder/merged.parquet"
    ;;
shard)
    exec "$equipod" sweep run "$plan" --seed "$seed" --shard "$SLURM_ARRAY_TASK_ID/$shards" --shard-offset "$2" \
        --threads "$threads" --output "$folder"
    ;;
merge)
    if ! "$equipod" sweep verify "$folder"; then
        echo "not merged: remove the cause, then the same script submits the missing shards" >&2
        exit 1
    fi
    exec "$equipod" sweep merge "$folder" --output "$folder/merged.parquet"
    ;;
*)
    echo "bash $0 [submit]" >&2
    exit 2
    ;;
esac
"#,
        );
        Ok(out)
    }
}

/// Makes a path absolute, since nodes start in their own folders.
fn absolute(path: &Path) -> Result<PathBuf, Failure> {
    std::path::absolute(path)
        .map_err(|e| Failure::refused("file::not_readable", format!("{}: {e}", path.display())))
}

/// Quotes a path as one word of a shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_one_word_whatever_is_in_them() {
        assert_eq!(quoted(Path::new("a b")), "'a b'");
        assert_eq!(quoted(Path::new("it's $HOME")), r"'it'\''s $HOME'");
    }
}
