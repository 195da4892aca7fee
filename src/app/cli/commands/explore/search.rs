//! The best platform for the design, under whatever it requires: one of two searches, and what the other stages need of either.

use super::Asked;
use super::folder::Folder;
use crate::app::Design;
use crate::app::cli::commands::optimize::{self, Choices, Done, dimensional};
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::document;
use crate::app::cli::progress::ProgressLine;
use crate::app::entrance::optimizing::{Checked, EXTENSION, asks_for_more, dimensional_problem};
use crate::app::entrance::rounding::{DesignOnHoles, FirstSearch, on_stated_holes};
use crate::app::records::{
    AssessAnswer, DesignRoleWord, DriveSearchRecord, FreedomRecord, OptimizeAnswer, OptimizedRecord,
    ProvenanceRecord, SymmetryRecord,
};
use ::optimize::dimensional::{Progress, ShapeSearchOptions, Stage, Triangles};
use ::optimize::offsets;
use files::design::Combination;
use machine::manufacture::NoRounding;
use machine::requirements::StartSymmetry;
use verify::Verdict;

/// What was searched, and what came out.
#[derive(Debug)]
pub(super) enum Search {
    /// Offsets alone, for a design that requires nothing else.
    Offsets(Box<Done>),
    /// A platform under all requirements of the design.
    Dimensions(Box<dimensional::Done>),
}

/// A design whose answer is no single platform.
pub(super) fn refuse_front(design: &Design) -> Result<(), Failure> {
    if matches!(design.search.mode, Some(Combination::Pareto { .. })) {
        let message = "mode = \"pareto\" asks for many platforms, and the folder is about one";
        return Err(Failure::refused("explore::front", message).with_help(
            "`equipod optimize` gives the front; explore one of its members, or set another mode",
        ));
    }
    Ok(())
}

/// Options that the search under requirements does not ask; `with_drives`: a table is given.
pub(super) fn refuse_options(design: &Design, with_drives: bool, context: &Context) -> Result<(), Failure> {
    if !(asks_for_more(design) || with_drives || design.drive_table.is_some()) {
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

/// Searches as `optimize` does.
pub(super) fn search(asked: &Asked<'_>, progress: &mut ProgressLine) -> Result<Search, Failure> {
    let Asked { design, extension, interrupt, .. } = *asked;
    let seed = asked.context.seed();
    // lengths of drives are requirements
    if asks_for_more(design) || asked.drives.is_some() {
        let done = dimensional::search(
            design,
            asked.drives,
            extension,
            (&options(asked), asked.explains),
            &mut |_, p| {
                part(progress, &p);
                interrupt.flow()
            },
        )?;
        return Ok(Search::Dimensions(Box::new(done)));
    }
    let done = optimize::search(
        design,
        asked.octahedral.clone(),
        &Choices::plain(extension, interrupt.until()),
        seed,
        &mut |p| {
            match p {
                offsets::OffsetProgress::Ranking { done, total, .. } => progress.part("ranking", done, total),
                offsets::OffsetProgress::Polishing { done, total, .. } => {
                    progress.part("polishing", done, total);
                }
                offsets::OffsetProgress::Bounding { boxes, open, .. } => {
                    progress.part("bounding", boxes, boxes + open);
                }
            }
            interrupt.flow()
        },
    )?;
    Ok(Search::Offsets(Box::new(done)))
}

fn options(asked: &Asked<'_>) -> ShapeSearchOptions {
    ShapeSearchOptions {
        seed: asked.context.seed(),
        threads: optimize::workers(None),
        until: asked.interrupt.until(),
        ..ShapeSearchOptions::default()
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

impl Search {
    /// Where nothing was found: the searches with one more freedom each, their platforms written into the folder.
    pub(super) fn open_freedoms(
        &mut self,
        asked: &Asked<'_>,
        progress: &mut ProgressLine,
        folder: &mut Folder,
    ) -> Result<(), Failure> {
        let Self::Dimensions(done) = self else { return Ok(()) };
        let Asked { design, extension, interrupt, .. } = *asked;
        let options = options(asked);
        let mut keep = |name: &str, design: &Design| Ok(Some(folder.keep(name, design.to_toml())));
        dimensional::open_freedoms(done, design, extension, options, &mut keep, &mut |_, p| {
            part(progress, &p);
            interrupt.flow()
        })
    }

    /// Whether the answer has a symmetry that the design has and does not ask for.
    pub(super) fn keeps_symmetry_of_start(&self) -> bool {
        matches!(self, Self::Dimensions(done) if done.symmetry == Some(StartSymmetry::Kept))
    }

    /// This search, which was made because the symmetry of the design led to no platform.
    pub(super) fn without_symmetry_of_start(mut self) -> Self {
        if let Self::Dimensions(done) = &mut self {
            done.symmetry = Some(StartSymmetry::GivenUp);
        }
        self
    }

    /// What other freedoms came to, where they were tried.
    pub(super) fn freedoms(&self, design: &Design) -> Option<Vec<FreedomRecord>> {
        match self {
            Self::Offsets(_) => None,
            Self::Dimensions(done) => done.freedoms(design),
        }
    }

    /// What became of the symmetry of a design that names none.
    pub(super) fn symmetry(&self) -> Option<SymmetryRecord> {
        match self {
            Self::Offsets(_) => None,
            Self::Dimensions(done) => done.symmetry.map(SymmetryRecord::from),
        }
    }

    /// The drives of the table, where there is one.
    pub(super) fn drive_search(&self) -> Option<DriveSearchRecord> {
        match self {
            Self::Offsets(_) => None,
            Self::Dimensions(done) => done.drive_search(),
        }
    }

    /// The platform found, with the leg lengths of the pose at which the design has its own.
    pub(super) fn with_lengths_of(mut self, design: &Design) -> Self {
        let lengths = design.lengths.map(|l| l.squared());
        match &mut self {
            Self::Offsets(done) => {
                if let (Some(c), Some(s)) = (&mut done.checked, done.report.solution()) {
                    c.design.lengths = lengths.and_then(|l| s.map.apply(&l).ok()).map(|s| s.lengths());
                }
            }
            Self::Dimensions(done) => {
                if let Some(c) = &mut done.checked {
                    let kept = c.verification.as_ref().filter(|v| v.verdict == Verdict::Equivalent);
                    let map = kept.map(|v| &v.map.closest);
                    c.design.lengths =
                        map.zip(lengths).and_then(|(m, l)| m.apply(&l).ok()).map(|s| s.lengths());
                }
            }
        }
        self
    }

    /// The platform found, judged.
    fn checked(&self) -> Option<&Checked> {
        match self {
            Self::Offsets(done) => done.checked.as_ref(),
            Self::Dimensions(done) => done.checked.as_ref(),
        }
    }

    /// The platform found.
    pub(super) fn optimised(&self) -> Option<&Design> {
        self.checked().map(|c| &c.design)
    }

    /// The platform found, or the one that misses the requirements least.
    pub(super) fn closest(&self) -> Option<&Design> {
        match self {
            Self::Offsets(done) => done.optimised(),
            Self::Dimensions(done) => done.checked.as_ref().or(done.nearest.as_ref()).map(|c| &c.design),
        }
    }

    /// The closest platform with its joints on the holes that the design states; `None` without such a platform or holes.
    pub(super) fn on_holes(
        &self,
        asked: &Asked<'_>,
        progress: &mut ProgressLine,
    ) -> Result<Option<Result<DesignOnHoles, NoRounding>>, Failure> {
        let Asked { design, interrupt, .. } = *asked;
        let Some((grids, wanted)) = design.holes.zip(self.closest()) else { return Ok(None) };
        let first = match self {
            Self::Dimensions(done) => done
                .report
                .solution()
                .or(done.report.nearest.as_deref())
                .map(|s| FirstSearch { design: done.asked(design), problem: &done.problem, point: &s.point }),
            Self::Offsets(_) => None,
        };
        let options = options(asked);
        let found = on_stated_holes(wanted, &grids, first, &options, &mut |p| {
            part(progress, &p);
            interrupt.flow()
        });
        found.map(Some).map_err(|why| Failure::internal(why.to_string()))
    }

    /// What `assess` says of the platform found; `None` without one, or where nothing is required.
    pub(super) fn assessment(&self) -> Option<AssessAnswer> {
        let c = self.checked()?;
        Some(AssessAnswer::new(&c.design, c.assessed.as_ref()?).with_role(DesignRoleWord::Optimised))
    }

    /// Whether the platform found meets what is required; `Some(true)` where nothing is.
    pub(super) fn met(&self) -> Option<bool> {
        self.checked().map_or(Some(true), Checked::met)
    }

    /// Whether the platform has the kinematics of the design by its making: with other triangles it has not.
    pub(super) fn keeps_class(&self) -> bool {
        match self {
            Self::Offsets(_) => true,
            Self::Dimensions(done) => done.problem.variables.triangles == Triangles::Fixed,
        }
    }

    /// What the search alone means for the exit code.
    pub(super) fn exit(&self) -> Exit {
        match self {
            Self::Offsets(done) => done.exit(),
            Self::Dimensions(done) => optimize::exit_of(done.status()),
        }
    }

    /// The offsets and `det A` of the map from the design, where there are both.
    pub(super) fn offsets(&self) -> Option<([f64; 6], f64)> {
        match self {
            Self::Offsets(done) => done.report.solution().map(|s| (s.offsets, s.recheck.det)),
            Self::Dimensions(done) => {
                let offsets = done.report.solution()?.offsets?;
                let map = &done.checked.as_ref()?.verification.as_ref()?.map;
                Some((offsets, map.determinant))
            }
        }
    }

    /// The answer of `optimize`.
    fn answer(&self, design: &Design) -> OptimizeAnswer {
        match self {
            Self::Offsets(done) => done.record(design, None),
            Self::Dimensions(done) => done.record(design, None),
        }
    }

    /// The key figures.
    pub(super) fn key_figures(&self, design: &Design) -> Option<OptimizedRecord> {
        OptimizedRecord::new(&self.answer(design))
    }

    /// Writes the answer of `optimize`.
    pub(super) fn write(
        &self,
        design: &Design,
        provenance: ProvenanceRecord,
        folder: &mut Folder,
    ) -> Result<(), Failure> {
        let text = document(self.answer(design), provenance, &[])?;
        folder.keep(super::folder::OPTIMIZE, text);
        Ok(())
    }
}
