//! `equipod sweep design`: a candidate as a design file.

use std::path::{Path, PathBuf};

use crate::app::cli::sweep_folder::SweepFolder;
use crate::app::cli::{Answer, Exit, Failure, OutputPath, files};
use records::{SweepDesignAnswer, SweepDesignFile};

/// Arguments of `sweep design`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepDesignArgs {
    /// Folder of the sweep
    folder: PathBuf,
    /// Number of the candidate, from the column `candidate`
    #[arg(long, value_name = "K")]
    candidate: u64,
    /// Write the design, as TOML; default: standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// Makes the design again from plan and seed.
pub(crate) fn run(args: &SweepDesignArgs) -> Result<Answer, Failure> {
    let folder = SweepFolder::open(&args.folder)?;
    let sweep = folder.sweep()?;
    let k = args.candidate;
    if k >= sweep.count() {
        let message =
            format!("there is no candidate {k}; the sweep has {} candidates, counted from 0", sweep.count());
        return Err(Failure::refused("sweep::no_candidate", message));
    }
    let text = sweep.design_text(k).map_err(|why| {
        Failure::new(Exit::No, "sweep::no_design", format!("candidate {k} gives no design: {why}"))
    })?;
    let (file, said) = match &args.output {
        Some(path) => {
            if !files::is_standard(path) {
                folder.write_poses(&sweep, path.parent().unwrap_or(Path::new("")))?;
            }
            files::write_text(path, &text)?;
            let output = path.display().to_string();
            let said = format!("wrote {output}\n");
            (SweepDesignFile::Written { output }, said)
        }
        None => (SweepDesignFile::Given { text: text.clone() }, text),
    };
    Ok(Answer::new(Exit::Yes, SweepDesignAnswer { candidate: k, file }, said))
}
