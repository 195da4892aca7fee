//! The best platform for the design, as `optimize` finds it, and what the other stages need of it.

use super::ExploreQuestion;
use super::folder::Folder;
use crate::app::cli::commands::optimize;
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::progress::ProgressLine;
use ::optimize::dimensional::{Progress, Stage, Triangles};
use ::optimize::offsets::OffsetProgress;
use ask::Design;
use ask::optimizing::{EXTENSION, SearchKind, dimensional_problem};
use ask::rounding::{DesignOnHoles, FirstSearch, on_stated_holes};
use ask::{Checked, FoundOffsets, OptimizeEvidence, OptimizeOptions, OptimizeProgress, OptimizeReport};
use machine::manufacture::NoRounding;
use machine::requirements::StartSymmetry;
use records::{AssessAnswer, DesignRoleWord, OptimizeAnswer, OptimizeFiles};
use verify::Verdict;

/// The report of the search, and what the stages of `explore` ask of it.
#[derive(Debug)]
pub(super) struct ExploreSearch {
    pub(super) found: OptimizeReport,
}

/// A design whose answer is no single platform.
pub(super) fn refuse_front(design: &Design) -> Result<(), Failure> {
    if matches!(SearchKind::of(design, true), SearchKind::Front(_)) {
        let message = "mode = \"pareto\" asks for many platforms, and the folder is about one";
        return Err(Failure::refused("explore::front", message).with_help(
            "`equipod optimize` gives the front; explore one of its members, or set another mode",
        ));
    }
    Ok(())
}

/// Options that the search under requirements does not ask; `with_drives`: a table is given.
pub(super) fn refuse_options(design: &Design, with_drives: bool, context: &Context) -> Result<(), Failure> {
    if SearchKind::of(design, with_drives || design.drive_table.is_some()) == SearchKind::Offsets {
        return Ok(());
    }
    optimize::refuse_extension(design, context)?;
    if dimensional_problem(design, EXTENSION).variables.triangles != Triangles::Fixed {
        let why =
            "a platform with other triangles has kinematics of its own, which are compared with nothing";
        context.no_effect("samples", why)?;
    }
    Ok(())
}

/// Searches as `optimize` does; whether freedoms are opened is decided later.
pub(super) fn search(
    asked: &ExploreQuestion<'_>,
    progress: &mut ProgressLine,
) -> Result<ExploreSearch, Failure> {
    let found = asked.design.optimize_with(options(asked, progress).freedoms(false));
    Ok(ExploreSearch { found: found.map_err(optimize::failed)? })
}

fn options<'a>(asked: &'a ExploreQuestion<'_>, progress: &'a mut ProgressLine) -> OptimizeOptions<'a> {
    let options = OptimizeOptions::new()
        .seed(asked.context.seed())
        .extension(asked.extension)
        .explains(asked.explains)
        .until(asked.interrupt.until())
        .on_progress(|p| {
            stage(progress, &p);
            asked.interrupt.flow()
        });
    match asked.drives {
        Some(table) => options.drives(table),
        None => options,
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
        // what is not counted has no line
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

impl ExploreSearch {
    /// The answer of `optimize`. Where nothing was found the search is made with one more freedom each, whose platforms
    /// are kept in the folder.
    pub(super) fn answer(
        &mut self,
        asked: &ExploreQuestion<'_>,
        progress: &mut ProgressLine,
        folder: &mut Folder,
    ) -> Result<OptimizeAnswer, Failure> {
        self.found.open_freedoms(&mut options(asked, progress)).map_err(optimize::failed)?;
        let mut files = OptimizeFiles::default();
        for opened in self.found.freedoms.iter().flatten() {
            if let Some(design) = opened.design() {
                let path = folder.keep(&optimize::opened_file(opened.freedom), design.to_toml());
                files.freedoms.push((opened.freedom, path));
            }
        }
        Ok(OptimizeAnswer::new(&self.found, &files))
    }

    /// Whether the answer has a symmetry that the design has and does not ask for.
    pub(super) fn keeps_symmetry_of_start(&self) -> bool {
        self.found.symmetry() == Some(StartSymmetry::Kept)
    }

    /// This search, which was made because the symmetry of the design led to no platform.
    pub(super) fn without_symmetry_of_start(mut self) -> Self {
        if let OptimizeEvidence::Dimensions(found) = &mut self.found.evidence {
            found.symmetry = Some(StartSymmetry::GivenUp);
        }
        self
    }

    /// The platform found, with the leg lengths of the pose at which the design has its own.
    pub(super) fn with_lengths_of(mut self, design: &Design) -> Self {
        let lengths = design.lengths.map(|l| l.squared());
        match &mut self.found.evidence {
            OptimizeEvidence::Offsets(found) => {
                let FoundOffsets { checked, report, .. } = &mut **found;
                if let (Some(c), Some(s)) = (checked, report.solution()) {
                    c.design.lengths = lengths.and_then(|l| s.map.apply(&l).ok()).map(|s| s.lengths());
                }
            }
            OptimizeEvidence::Dimensions(found) => {
                if let Some(c) = &mut found.checked {
                    let kept = c.verification.as_ref().filter(|v| v.verdict == Verdict::Equivalent);
                    let map = kept.map(|v| &v.map.closest);
                    c.design.lengths =
                        map.zip(lengths).and_then(|(m, l)| m.apply(&l).ok()).map(|s| s.lengths());
                }
            }
            OptimizeEvidence::Front(_) => (),
        }
        self
    }

    /// The platform found.
    pub(super) fn optimised(&self) -> Option<&Design> {
        self.found.design()
    }

    /// The platform found, or the one that misses the requirements least.
    pub(super) fn closest(&self) -> Option<&Design> {
        self.found.checked().or(self.found.nearest()).map(|c| &c.design)
    }

    /// The closest platform with its joints on the holes that the design states; `None` without such a platform or
    /// holes.
    pub(super) fn on_holes(
        &self,
        asked: &ExploreQuestion<'_>,
        progress: &mut ProgressLine,
    ) -> Result<Option<Result<DesignOnHoles, NoRounding>>, Failure> {
        let ExploreQuestion { design, interrupt, .. } = *asked;
        let Some((grids, wanted)) = design.holes.zip(self.closest()) else { return Ok(None) };
        let first = match &self.found.evidence {
            OptimizeEvidence::Dimensions(found) => {
                let solution = found.report.solution().or(found.report.nearest.as_deref());
                let (design, problem) = (&self.found.asked, &found.problem);
                solution.map(|s| FirstSearch { design, problem, point: &s.point })
            }
            OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => None,
        };
        let options = options(asked, progress).search();
        let found = on_stated_holes(wanted, &grids, first, &options, &mut |p| {
            part(progress, &p);
            interrupt.flow()
        });
        found.map(Some).map_err(|why| Failure::internal(why.to_string()))
    }

    /// What `assess` says of the platform found; `None` without one, or where nothing is required.
    pub(super) fn assessment(&self) -> Option<AssessAnswer> {
        let c = self.found.checked()?;
        Some(AssessAnswer::new(&c.design, c.assessed.as_ref()?).with_role(DesignRoleWord::Optimised))
    }

    /// Whether the platform found meets what is required; `Some(true)` where nothing is.
    pub(super) fn met(&self) -> Option<bool> {
        self.found.checked().map_or(Some(true), Checked::met)
    }

    /// Whether the platform has the kinematics of the design by its making: with other triangles it has not.
    pub(super) fn keeps_class(&self) -> bool {
        match &self.found.evidence {
            OptimizeEvidence::Dimensions(found) => found.problem.variables.triangles == Triangles::Fixed,
            OptimizeEvidence::Offsets(_) | OptimizeEvidence::Front(_) => true,
        }
    }

    /// What the search alone means for the exit code.
    pub(super) fn exit(&self) -> Exit {
        optimize::exit_of(self.found.status)
    }

    /// The offsets and `det A` of the map from the design, where there are both.
    pub(super) fn offsets(&self) -> Option<([f64; 6], f64)> {
        match &self.found.evidence {
            OptimizeEvidence::Offsets(found) => found.report.solution().map(|s| (s.offsets, s.recheck.det)),
            OptimizeEvidence::Dimensions(found) => {
                let offsets = found.report.solution()?.offsets?;
                let map = &found.checked.as_ref()?.verification.as_ref()?.map;
                Some((offsets, map.determinant))
            }
            OptimizeEvidence::Front(_) => None,
        }
    }
}
