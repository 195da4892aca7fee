//! `equipod explore` for designs that are not octahedral: replaceable legs, an equivalent platform made by moving legs,
//! the nearest octahedral platform.

use std::fmt::Write as _;

use super::folder::{self, Folder};
use super::{ExploreArgs, exit_of, text, verification};
use crate::app::cli::commands::report::page;
use crate::app::cli::output::{Answer, document};
use crate::app::cli::progress::ProgressLine;
use crate::app::cli::{Context, Failure};
use ask::exploring::NEAREST_EXTENSION;
use ask::{Design, ExploreVerdict, ExploredDesign, MovedPlatform};
use records::{
    AssessAnswer, ComparedRecord, ComponentsAnswer, DesignRoleWord, ExploreAnswer, ExploreGeneralAnswer,
    FamiliesFoundRecord, FkRunRecord, MoveSearchAnswer, MovesFoundRecord, NearestAnswer, NearestErrorRecord,
    Number, PoseTotalsRecord, ProvenanceRecord, StageRecord, StageWord, VerifyAnswer, leg_number,
};
use sheet::Sheet;
use verify::VerdictWord;

/// The design with its results, and the files and sentences made of them.
struct ExploreRun<'a> {
    design: &'a Design,
    found: &'a ExploredDesign,
    folder: Folder,
    provenance: ProvenanceRecord,
    stages: Vec<StageRecord>,
}

impl ExploreRun<'_> {
    fn done(&mut self, stage: StageWord, explanation: impl Into<String>) {
        self.stages.push(StageRecord { stage, explanation: explanation.into() });
    }
}

/// The answer, with its files.
pub(super) fn written(
    args: &ExploreArgs,
    design: &Design,
    found: &ExploredDesign,
    folder: Folder,
    (progress, context): (&mut ProgressLine, &Context),
) -> Result<Answer, Failure> {
    let mut run = ExploreRun { design, found, folder, provenance: context.provenance(), stages: Vec::new() };
    replaceable(&mut run)?;
    let moves = moves(&mut run)?;
    let nearest = nearest_platform(&mut run)?;
    let met = requirements(&mut run)?;
    let verified = compared(&mut run)?;
    let document_of_poses =
        document(FkRunRecord::new(&found.poses, &design.units), run.provenance.clone(), &[])?;
    run.folder.keep(folder::FK, document_of_poses);
    run.folder.keep(folder::MODES, super::figures::modes(design, &found.poses));
    let totals = PoseTotalsRecord::new(&found.poses);
    run.done(
        StageWord::Fk,
        format!(
            "{} finite poses, {} real, {} certified",
            totals.finite_count, totals.real_count, totals.certified_count
        ),
    );

    progress.stage(7, "report");
    let verdict = found.verdict();
    let explanation = explanation(found, moves.as_ref(), verified.as_ref());
    let ExploreRun { mut folder, stages, .. } = run;
    let mut answer = ExploreGeneralAnswer {
        verdict,
        explanation,
        name: design.name.clone(),
        paths: Vec::new(),
        stages,
        components: FamiliesFoundRecord {
            count: found.families.found.components.len(),
            complete: found.families.found.doubts.is_empty(),
        },
        moves: moves.as_ref().map(|m| moves_found(found, m)),
        nearest,
        nearest_meets_requirements: met,
        verify: found.compared.as_ref().map(|c| ComparedRecord::from(&c.found)),
        fk: totals,
    };
    let repeat = format!(
        "equipod explore {} -o DIR --seed {} --samples {} --extension {}",
        folder::ORIGINAL,
        context.seed(),
        args.samples,
        args.extension.unwrap_or(NEAREST_EXTENSION)
    );
    folder.keep(folder::REPORT, markdown(&answer, design, &repeat));
    let files = folder.results();
    folder.keep(folder::PAGE, page(files, None, None));
    folder.finish()?;
    answer.paths = folder.paths().collect();
    let text = text(&answer.name, answer.verdict, &answer.explanation, &answer.paths, Sheet::new());
    Ok(Answer::new(exit_of(verdict), ExploreAnswer::General(Box::new(answer)), text))
}

/// The families of replaceable legs.
fn replaceable(run: &mut ExploreRun<'_>) -> Result<(), Failure> {
    let families = &run.found.families;
    let answer = ComponentsAnswer::new(&run.design.name, families);
    run.folder.keep(folder::COMPONENTS, document(answer, run.provenance.clone(), &[])?);
    let all = if families.found.doubts.is_empty() { "there are no others" } else { "there may be others" };
    let text = match families.found.components.len() {
        0 => format!("no leg is replaceable; {all}"),
        1 => format!("one family of replaceable legs; {all}"),
        n => format!("{n} families of replaceable legs; {all}"),
    };
    run.done(StageWord::Components, text);
    Ok(())
}

/// Equivalent platforms without shared joints; `None` if there was nothing to search.
fn moves(run: &mut ExploreRun<'_>) -> Result<Option<MoveSearchAnswer>, Failure> {
    let Some(moves) = &run.found.moves else {
        let why = if run.found.is_singular() {
            "the design is architecturally singular, and so is every platform made of its legs"
        } else {
            "no leg is replaceable"
        };
        run.done(StageWord::Moves, why);
        return Ok(None);
    };
    let answer = MoveSearchAnswer::new(run.design, moves);
    run.folder.keep(folder::MOVES, document(answer.clone(), run.provenance.clone(), &[])?);
    if let Some(design) = run.found.equivalent() {
        run.folder.keep(folder::EQUIVALENT, design.to_toml());
    }
    let explanation = match run.found.chosen() {
        Some(chosen) => {
            let legs: Vec<String> = new_legs(chosen).iter().map(ToString::to_string).collect();
            format!("{}; the first has new legs {}", answer.explanation, legs.join(", "))
        }
        None => answer.explanation.clone(),
    };
    run.done(StageWord::Moves, explanation);
    Ok(Some(answer))
}

fn new_legs(platform: &MovedPlatform) -> Vec<usize> {
    platform.new_legs().into_iter().map(leg_number).collect()
}

fn moves_found(found: &ExploredDesign, moves: &MoveSearchAnswer) -> MovesFoundRecord {
    MovesFoundRecord {
        outcome: moves.outcome,
        moved_legs: found.chosen().map(new_legs),
        det: found.chosen().map(|f| Number(f.map.determinant)),
    }
}

/// The error of the nearest octahedral platform.
fn nearest_platform(run: &mut ExploreRun<'_>) -> Result<Option<NearestErrorRecord>, Failure> {
    let near = run.found.near.as_ref();
    let answer = NearestAnswer::new(run.design, &run.found.limits, near);
    let error = answer.nearest.as_ref().map(|n| n.error);
    run.done(StageWord::Nearest, answer.explanation.clone());
    run.folder.keep(folder::NEAREST, document(answer, run.provenance.clone(), &[])?);
    if let Some(near) = near {
        run.folder.keep(folder::NEAREST_OCTAHEDRAL, near.octahedral.to_toml());
        run.folder.keep(folder::BESIDE, near.beside.to_toml());
    }
    Ok(error)
}

/// Whether the equivalent of the nearest octahedral platform meets the requirements of the design.
fn requirements(run: &mut ExploreRun<'_>) -> Result<Option<bool>, Failure> {
    let Some(near) = &run.found.near else { return Ok(None) };
    let Some(assessed) = &run.found.assessed else {
        run.done(StageWord::Assess, "the design has no requirements");
        return Ok(None);
    };
    let answer = AssessAnswer::new(&near.beside, assessed).with_role(DesignRoleWord::NearestEquivalent);
    let met = answer.met_at_assessed_poses();
    let text = format!("the equivalent of the nearest octahedral platform {}", answer.explanation);
    run.folder.keep(folder::ASSESS, document(answer, run.provenance.clone(), &[])?);
    run.done(StageWord::Assess, text);
    Ok(met)
}

/// The answer of `verify`.
fn compared(run: &mut ExploreRun<'_>) -> Result<Option<VerifyAnswer>, Failure> {
    let Some(compared) = &run.found.compared else { return Ok(None) };
    let who = match run.found.equivalent() {
        Some(_) => "the design and the equivalent found",
        None => "the nearest octahedral platform and its equivalent",
    };
    let answer = verification(compared, &run.provenance, &mut run.folder)?;
    let word = compared.found.verdict.name().replace('_', " ");
    run.done(StageWord::Verify, format!("{who}: {word}, {}", answer.explanation));
    Ok(Some(answer))
}

/// The verdict in a sentence.
fn explanation(
    found: &ExploredDesign,
    moves: Option<&MoveSearchAnswer>,
    verified: Option<&VerifyAnswer>,
) -> String {
    match (moves, found.chosen(), verified) {
        (Some(_), Some(_), Some(verified)) => verified.explanation.clone(),
        (Some(moves), ..) if found.verdict() == ExploreVerdict::Violated => {
            format!("{}; `equipod optimize` searches sizes and a height that meet them", moves.explanation)
        }
        (Some(moves), ..) => moves.explanation.clone(),
        (None, ..) => match found.verdict() {
            ExploreVerdict::Compared(VerdictWord::Singular) => "the design is architecturally singular",
            ExploreVerdict::None => "no leg is replaceable, so no other platform is equivalent to the design",
            _ => "no replaceable leg was found, but some may exist",
        }
        .into(),
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
pub(super) fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters
        .next()
        .map_or_else(String::new, |first| first.to_uppercase().collect::<String>() + letters.as_str())
}
