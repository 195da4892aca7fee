//! `equipod explore` for designs that are not octahedral: replaceable legs, an equivalent platform by moves of legs,
//! the nearest octahedral platform.

use std::fmt::Write as _;

use super::folder::{self, Folder};
use super::{ExploreArgs, Verified, fk_record, original, solve, text, verification};
use crate::app::cli::commands::equivalents::r#move::found::platforms;
use crate::app::cli::commands::equivalents::nearest;
use crate::app::cli::commands::report::page;
use crate::app::cli::commands::verify::exit_of;
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::{Answer, document};
use crate::app::cli::progress::ProgressLine;
use ask::equivalents::NearestDesigns;
use ask::{Design, MoveSearchReport, MoveWishes, MovedPlatform, ReplaceableOptions, SearchWord};
use fk::{FkOptions, PoseCounting};
use records::{
    AssessAnswer, ComparedRecord, ComponentsAnswer, DesignRoleWord, ExploreAnswer, ExploreGeneralAnswer,
    ExploreVerdict, FamiliesFoundRecord, MoveSearchAnswer, MovesFoundRecord, NearestAnswer,
    NearestErrorRecord, Number, PoseTotalsRecord, ProvenanceRecord, StageRecord, StageWord, leg_number,
};
use synthesis::components::{ComponentOptions, Components};
use synthesis::relocate::search::MoveSearchOptions;
use verify::VerdictWord;

/// What is worked with in all stages.
struct ExploreRun<'a> {
    design: &'a Design,
    folder: Folder,
    provenance: ProvenanceRecord,
    seed: u64,
    stages: Vec<StageRecord>,
}

impl ExploreRun<'_> {
    fn done(&mut self, stage: StageWord, explanation: impl Into<String>) {
        self.stages.push(StageRecord { stage, explanation: explanation.into() });
    }
}

/// Runs all stages; each file is written when its stage is finished.
pub(super) fn run(args: &ExploreArgs, design: &Design, context: &Context) -> Result<Answer, Failure> {
    let mut progress = ProgressLine::new(context.quiet());
    let seed = context.seed();
    let mut run = ExploreRun {
        design,
        folder: Folder::prepare(&args.output)?,
        provenance: context.provenance(),
        seed,
        stages: Vec::new(),
    };
    run.folder.keep(folder::ORIGINAL, original(design, seed).to_toml());

    progress.stage(1, "replaceable legs");
    let families = replaceable(&mut run)?;
    progress.stage(2, "equivalent platforms");
    let moves = moves(&mut run, &families)?;
    progress.stage(3, "nearest octahedral platform");
    let extension = args.extension.unwrap_or(nearest::EXTENSION);
    let near = nearest_platform(&mut run, extension)?;
    progress.stage(4, "requirements");
    let met = requirements(&mut run, near.as_ref().map(|n| &n.0))?;
    progress.stage(5, "comparison");
    let options = FkOptions::new().seed(seed).pose_count(PoseCounting::Never);
    let verified = compared(&mut run, args.samples, &options, moves.as_ref(), near.as_ref().map(|n| &n.0))?;

    progress.stage(6, "forward kinematics");
    let poses = solve(design, &options)?;
    let document_of_poses = document(fk_record(&poses), run.provenance.clone(), &[])?;
    run.folder.keep(folder::FK, document_of_poses);
    run.folder.keep(folder::MODES, super::figures::modes(design, &poses));
    let totals = PoseTotalsRecord::new(poses.from, &poses.solutions);
    run.done(
        StageWord::Fk,
        format!(
            "{} finite poses, {} real, {} certified",
            totals.finite_count, totals.real_count, totals.certified_count
        ),
    );

    progress.stage(7, "report");
    let (verdict, explanation, exit) = judged(&families, moves.as_ref(), verified.as_ref());
    let ExploreRun { mut folder, stages, .. } = run;
    let mut answer = ExploreGeneralAnswer {
        verdict,
        explanation,
        name: design.name.clone(),
        paths: Vec::new(),
        stages,
        components: FamiliesFoundRecord {
            count: families.components.len(),
            complete: families.doubts.is_empty(),
        },
        moves: moves.as_ref().map(Moves::record),
        nearest: near.as_ref().map(|n| n.1),
        nearest_meets_requirements: met,
        verify: verified.as_ref().map(|v| ComparedRecord::from(&v.found)),
        fk: totals,
    };
    let repeat = format!(
        "equipod explore {} -o DIR --seed {seed} --samples {} --extension {}",
        folder::ORIGINAL,
        args.samples,
        extension
    );
    folder.keep(folder::REPORT, markdown(&answer, design, &repeat));
    let files = folder.results();
    folder.keep(folder::PAGE, page(files, None));
    folder.finish()?;
    answer.paths = folder.paths().collect();
    let text = text(&answer.name, answer.verdict, &answer.explanation, &answer.paths, None);
    Ok(Answer::new(exit, ExploreAnswer::General(Box::new(answer)), text))
}

/// The families of replaceable legs.
fn replaceable(run: &mut ExploreRun<'_>) -> Result<Components, Failure> {
    let options = ComponentOptions { seed: run.seed, ..ComponentOptions::default() };
    let legs = run.design.replaceable_legs(&ReplaceableOptions::all(options));
    let legs = legs.map_err(|why| Failure::internal(why.to_string()))?;
    let answer = ComponentsAnswer::new(&run.design.name, &legs);
    run.folder.keep(folder::COMPONENTS, document(answer, run.provenance.clone(), &[])?);
    let found = legs.found;
    let count = found.components.len();
    let all = if found.doubts.is_empty() { "there are no others" } else { "there may be others" };
    let text = match count {
        0 => format!("no leg belongs to a family of replaceable legs; {all}"),
        1 => format!("one family of legs that can be replaced without changing the platform; {all}"),
        n => format!("{n} families of legs that can be replaced without changing the platform; {all}"),
    };
    run.done(StageWord::Components, text);
    Ok(found)
}

/// A search with its answer.
struct Moves {
    found: MoveSearchReport,
    answer: MoveSearchAnswer,
}

impl Moves {
    /// The platform that is written.
    fn chosen(&self) -> Option<&MovedPlatform> {
        self.found.first_other()
    }

    fn design(&self) -> Option<&Design> {
        self.chosen()?.design.as_ref()
    }

    fn record(&self) -> MovesFoundRecord {
        let legs = |f: &MovedPlatform| f.new_legs().into_iter().map(leg_number).collect();
        MovesFoundRecord {
            outcome: self.answer.outcome,
            moved_legs: self.chosen().map(legs),
            det: self.chosen().map(|f| Number(f.map.determinant)),
        }
    }
}

/// Equivalent platforms without shared joints; `None` where there is nothing to search.
fn moves(run: &mut ExploreRun<'_>, families: &Components) -> Result<Option<Moves>, Failure> {
    if families.leg_rank.value < 6 {
        run.done(
            StageWord::Moves,
            "the design is architecturally singular, and so is every platform made of its legs",
        );
        return Ok(None);
    }
    if families.components.is_empty() {
        run.done(StageWord::Moves, "no leg can be moved");
        return Ok(None);
    }
    let wishes = MoveWishes { no_shared_joints: true, ..MoveWishes::default() };
    let options = MoveSearchOptions { seed: run.seed, ..MoveSearchOptions::default() };
    let found = platforms(run.design, families, &wishes, &options)?;
    let answer = MoveSearchAnswer::new(run.design, &found);
    run.folder.keep(folder::MOVES, document(answer.clone(), run.provenance.clone(), &[])?);
    let moves = Moves { found, answer };
    if let Some(design) = moves.design() {
        run.folder.keep(folder::EQUIVALENT, design.to_toml());
    }
    let explanation = match &moves.record().moved_legs {
        Some(legs) => {
            let legs: Vec<String> = legs.iter().map(ToString::to_string).collect();
            format!("{}; the first has new legs {}", moves.answer.explanation, legs.join(", "))
        }
        None => moves.answer.explanation.clone(),
    };
    run.done(StageWord::Moves, explanation);
    Ok(Some(moves))
}

/// The nearest octahedral platform with its error.
fn nearest_platform(
    run: &mut ExploreRun<'_>,
    extension: f64,
) -> Result<Option<(NearestDesigns, NearestErrorRecord)>, Failure> {
    let options = nearest::options(run.design, extension);
    let near = NearestDesigns::of(run.design, &options);
    let answer = NearestAnswer::new(run.design, &options, near.as_ref());
    let error = answer.nearest.as_ref().map(NearestErrorRecord::from);
    run.done(StageWord::Nearest, answer.explanation.clone());
    run.folder.keep(folder::NEAREST, document(answer, run.provenance.clone(), &[])?);
    let Some(found) = near.zip(error) else { return Ok(None) };
    run.folder.keep(folder::NEAREST_OCTAHEDRAL, found.0.octahedral.to_toml());
    run.folder.keep(folder::BESIDE, found.0.beside.to_toml());
    Ok(Some(found))
}

/// Whether the equivalent of the nearest octahedral platform meets the requirements of the design.
fn requirements(run: &mut ExploreRun<'_>, near: Option<&NearestDesigns>) -> Result<Option<bool>, Failure> {
    let Some(near) = near else { return Ok(None) };
    let Some(answer) = AssessAnswer::of(&near.beside, run.seed) else {
        run.done(StageWord::Assess, "the design has no requirements");
        return Ok(None);
    };
    let answer = answer.with_role(DesignRoleWord::NearestEquivalent);
    let met = answer.met;
    let text = format!("the equivalent of the nearest octahedral platform {}", answer.explanation);
    run.folder.keep(folder::ASSESS, document(answer, run.provenance.clone(), &[])?);
    run.done(StageWord::Assess, text);
    Ok(met)
}

/// The design compared with the equivalent found, else the nearest octahedral platform with its equivalent.
fn compared(
    run: &mut ExploreRun<'_>,
    samples: usize,
    options: &FkOptions,
    moves: Option<&Moves>,
    near: Option<&NearestDesigns>,
) -> Result<Option<Verified>, Failure> {
    let (a, b, who) = match (moves.and_then(Moves::design), near) {
        (Some(new), _) => (run.design, new, "the design and the equivalent found"),
        (None, Some(near)) => {
            (&near.octahedral, &near.beside, "the nearest octahedral platform and its equivalent")
        }
        (None, None) => return Ok(None),
    };
    let verified = verification(a, b, samples, options, &run.provenance, &mut run.folder)?;
    let word = verified.found.verdict.name().replace('_', " ");
    run.done(StageWord::Verify, format!("{who}: {word}, {}", verified.record.explanation));
    Ok(Some(verified))
}

/// The answer to the whole: is there an equivalent platform without shared joints other than the design?
fn judged(
    families: &Components,
    moves: Option<&Moves>,
    verified: Option<&Verified>,
) -> (ExploreVerdict, String, Exit) {
    let undecided = ExploreVerdict::Compared(VerdictWord::Inconclusive);
    let Some(moves) = moves else {
        return if families.leg_rank.value < 6 {
            (
                ExploreVerdict::Compared(VerdictWord::Singular),
                "the design is architecturally singular".into(),
                Exit::No,
            )
        } else if families.doubts.is_empty() {
            let text = "no leg can be replaced: no platform other than the design is equivalent to it";
            (ExploreVerdict::None, text.into(), Exit::No)
        } else {
            (undecided, "no replaceable leg was found, but there may be some".into(), Exit::Inconclusive)
        };
    };
    match (moves.chosen(), verified, moves.answer.outcome) {
        (Some(_), Some(v), _) => (
            ExploreVerdict::Compared(v.found.verdict.word()),
            v.record.explanation.clone(),
            exit_of(&v.found.verdict),
        ),
        (_, _, SearchWord::Violated) => {
            (ExploreVerdict::Violated, moves.answer.explanation.clone(), Exit::No)
        }
        (_, _, SearchWord::Impossible) => (ExploreVerdict::None, moves.answer.explanation.clone(), Exit::No),
        _ => (undecided, moves.answer.explanation.clone(), Exit::Inconclusive),
    }
}

/// The report. Writing to a string cannot fail, so the results of `write!` are dropped.
fn markdown(r: &ExploreGeneralAnswer, design: &Design, repeat: &str) -> String {
    let plain = sheet::markdown_escaped;
    let mut out = format!(
        "# {}: {}\n\nEvidence: {}.\n\nDesign: [{3}]({3}), lengths in {4}. It is not octahedral.\n",
        plain(&r.name),
        r.verdict.name().replace('_', " "),
        plain(&r.explanation),
        folder::ORIGINAL,
        plain(&design.units)
    );
    for stage in &r.stages {
        let _ = writeln!(out, "\n## {}\n\n{}.", stage.stage.heading(), capital(&plain(&stage.explanation)));
        let files: &[&str] = match stage.stage {
            StageWord::Components => &[folder::COMPONENTS],
            StageWord::Moves => match &r.moves {
                Some(MovesFoundRecord { det: Some(_), .. }) => &[folder::EQUIVALENT, folder::MOVES],
                Some(_) => &[folder::MOVES],
                None => &[],
            },
            StageWord::Nearest if r.nearest.is_some() => {
                &[folder::NEAREST_OCTAHEDRAL, folder::BESIDE, folder::NEAREST]
            }
            StageWord::Nearest => &[folder::NEAREST],
            StageWord::Assess if stage.explanation.contains("no requirements") => &[],
            StageWord::Assess => &[folder::ASSESS],
            StageWord::Verify => &[folder::VERIFY],
            StageWord::Fk => &[folder::FK],
        };
        if !files.is_empty() {
            let links: Vec<String> = files.iter().map(|f| format!("[{f}]({f})")).collect();
            let _ = writeln!(out, "\nFiles: {}.", links.join(", "));
        }
    }
    if let Some(NearestErrorRecord {
        largest_displacement: Number(moved),
        largest_length_deviation: Number(by),
        ..
    }) = r.nearest
    {
        let units = plain(&design.units);
        let _ = writeln!(
            out,
            "\nThe error of the nearest octahedral platform: a joint moves by up to {moved:.6} {units}, a leg length changes by up to {by:.6} {units} over the workspace.",
        );
    }
    let _ = writeln!(
        out,
        "\n![Assembly modes]({})\n\n## To repeat this\n\n    {repeat}\n\nequipod {}.",
        folder::MODES,
        env!("CARGO_PKG_VERSION")
    );
    out
}

/// The text with its first letter a capital.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}
