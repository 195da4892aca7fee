//! Refusals of `explore` before its search, and the progress of the search.

use crate::app::cli::commands::optimize;
use crate::app::cli::progress::ProgressLine;
use crate::app::cli::{Context, Failure};
use ::optimize::dimensional::{Progress, Stage, Triangles};
use ::optimize::offsets::OffsetProgress;
use ask::optimizing::{EXTENSION, SearchKind, dimensional_problem};
use ask::{Design, ExploreProgress, OptimizeProgress};

/// Refuses a design whose answer is not a single platform.
pub(super) fn refuse_front(design: &Design) -> Result<(), Failure> {
    if matches!(SearchKind::of(design, true), SearchKind::Front(_)) {
        let message = "mode = \"pareto\" gives many platforms, but the folder is about one";
        return Err(Failure::refused("explore::front", message).with_help(
            "`equipod optimize` gives the front; explore one of its members, or set another mode",
        ));
    }
    Ok(())
}

/// Refuses options without effect on the search under requirements; `with_drives`: a table is given.
pub(super) fn refuse_options(design: &Design, with_drives: bool, context: &Context) -> Result<(), Failure> {
    if SearchKind::of(design, with_drives || design.drive_table.is_some()) == SearchKind::Offsets {
        return Ok(());
    }
    optimize::refuse_extension(design, context)?;
    if dimensional_problem(design, EXTENSION).variables.triangles != Triangles::Fixed {
        let why = "a platform with other triangles has other kinematics, so it is not compared";
        context.no_effect("samples", why)?;
    }
    Ok(())
}

/// Shows the stage, and the progress of the search.
pub(super) fn show(progress: &mut ProgressLine, p: &ExploreProgress) {
    match p {
        ExploreProgress::Stage(number, name) => progress.stage(*number, name),
        ExploreProgress::Search(p) => stage(progress, p),
        _ => (),
    }
}

fn stage(progress: &mut ProgressLine, p: &OptimizeProgress) {
    match p {
        OptimizeProgress::Offsets(OffsetProgress::Ranking { done, total, .. }) => {
            progress.part("ranking", *done, *total);
        }
        OptimizeProgress::Offsets(OffsetProgress::Polishing { done, total, .. }) => {
            progress.part("polishing", *done, *total);
        }
        OptimizeProgress::Offsets(OffsetProgress::Bounding { boxes, open, .. }) => {
            progress.part("bounding", *boxes, boxes + open);
        }
        OptimizeProgress::Dimensions(p) | OptimizeProgress::Drive(_, p) | OptimizeProgress::Freedom(_, p) => {
            part(progress, p);
        }
        // uncounted stages have no line
        _ => (),
    }
}

fn part(progress: &mut ProgressLine, p: &Progress) {
    let what = match p.stage {
        Stage::Populations => "populations",
        Stage::Climbs => "climbs",
        Stage::Polishing => "polishing",
        Stage::Conflict => "conflict",
    };
    progress.part(what, p.done, p.total);
}
