//! `equipod equivalents move DESIGN --search`.

use std::path::Path;

use super::targets::TargetArgs;
use crate::app::cli::{Answer, Exit, Failure, files};
use ask::{Design, SearchWord};
use records::{MoveAnswer, MoveSearchAnswer};
use synthesis::components::ComponentOptions;
use synthesis::relocate::search::SearchError;

/// Searches, and writes the designs found.
pub(super) fn run(
    output: Option<&Path>,
    args: &TargetArgs,
    design: &Design,
    options: ComponentOptions,
) -> Result<Answer, Failure> {
    let targets = args.targets(design)?;
    let families = super::families(design, options)?;
    let found =
        design.search_moves(&families, &targets, &args.options(options.seed)).map_err(|e| failed(&e))?;
    let mut record = MoveSearchAnswer::new(design, &found);
    if let Some(folder) = output {
        files::make_folder(folder)?;
        for (k, platform) in found.platforms.iter().enumerate() {
            let path = folder.join(format!("{}.toml", k + 1));
            if let Some(d) = &platform.design {
                files::write_design(&path, d)?;
                record.paths.push(path.display().to_string());
            }
        }
    }
    let exit = match record.outcome {
        SearchWord::Found => Exit::Yes,
        SearchWord::Impossible | SearchWord::Violated => Exit::No,
        SearchWord::Undecided => Exit::Inconclusive,
    };
    let text = sheet::answers::move_search(&record);
    Ok(Answer::new(exit, MoveAnswer::Search(Box::new(record)), text))
}

/// A search that was invalid or failed.
pub(in crate::app::cli::commands) fn failed(why: &SearchError) -> Failure {
    match why {
        SearchError::NearlyDependent(_) => {
            Failure::new(Exit::Inconclusive, "move::nearly_singular_design", why.to_string())
        }
        SearchError::Linalg(_) => Failure::internal(why.to_string()),
        SearchError::Dependent(_) => Failure::refused("move::singular_design", why.to_string())
            .with_help("`equipod check DESIGN` says why"),
        _ => Failure::refused("move::bad_target", why.to_string()),
    }
}
