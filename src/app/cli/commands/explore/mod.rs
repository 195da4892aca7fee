//! `equipod explore`: all results about a design in one folder. This file handles octahedral designs, [`general`] the
//! others.

mod figures;
pub(super) mod folder;
mod general;
mod report;
mod search;

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use self::folder::Folder;
use super::build::drives;
use super::build::round::render::RoundReport;
use super::equivalents::r#move::{self as relocation, found};
use super::report::page;
use super::{export, fk as fk_command, optimize, verify as verify_command};
use crate::app::cli::output::{Answer, document};
use crate::app::cli::progress::{Interrupt, ProgressLine, TimeLimit};
use crate::app::cli::streams::output_is_terminal;
use crate::app::cli::{Context, Exit, Failure, OutputPath, files};
use ::files::design::DriveTable;
use ::files::export::{ExportFormat, PartLine};
use ask::equivalents::Original;
use ask::exporting::octahedral_of_controllers;
use ask::optimizing::{EXTENSION, SAFETY_MARGIN_PERCENT};
use ask::rounding::DesignOnHoles;
use ask::{
    ComparedDesigns, Design, ExploreFinding, ExploreOptions, ExploreReport, ExploreVerdict, ExploredClass,
    FreedomWord, NoExploration, NoOwnPoses, OptimizeEvidence, SAMPLES,
};
use fk::FkOptions;
use platform::manipulator::Octahedral;
use records::{
    AssessAnswer, ComparedRecord, DefaultSafetyMarginRecord, DesignRoleWord, ExploreAnswer,
    ExploreOctahedralAnswer, FamilyAnswer, FamilySizeRecord, FkRunRecord, OnHolesRecord, OptimizeAnswer,
    OptimizeFiles, OptimizedRecord, PoseTotalsRecord, PriceRecord, ProvenanceRecord, RoundAnswer,
    VerifyAnswer,
};
use sheet::Sheet;
use synthesis::FamilyMember;
use verify::VerdictWord;

/// Arguments of `explore`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExploreArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Folder for the results; results of an earlier run are replaced, other files refused
    #[arg(short, long, value_name = "DIR")]
    output: OutputPath,
    /// Number of length sets for comparing two designs, as in `verify`
    #[arg(long, default_value_t = SAMPLES, value_name = "N", value_parser = verify_command::at_least_one)]
    samples: usize,
    /// Greatest distance of a joint beyond its side, in side lengths; default: 0.3, or 1 for the nearest octahedral
    /// platform
    #[arg(long, value_name = "X")]
    extension: Option<f64>,
    /// Table of drives (.csv) as in `optimize`, for octahedral designs
    #[arg(long, value_name = "TABLE")]
    drives: Option<PathBuf>,
    /// Time limit of search and assessment, seconds, for octahedral designs; open requirements are then undecided
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(TimeLimit))]
    time_limit: Option<TimeLimit>,
}

/// All results about an octahedral design.
#[derive(Debug)]
struct Results {
    design: Design,
    found: ExploredClass,
    /// The answer of `optimize`.
    answer: OptimizeAnswer,
    /// The result of `assess` for the platform found, on its holes if the design states them.
    assessment: Option<AssessAnswer>,
    /// Parts and files for other programs, if the design states holes.
    machine: Option<MachineFiles>,
    /// The answer of `verify`.
    verified: Option<VerifyAnswer>,
    options: FkOptions,
    samples: usize,
    extension: f64,
}

impl Results {
    /// The cost of separate joints in the platform to build.
    fn price(&self) -> Option<PriceRecord> {
        let found = self.design.separation(self.found.built()?, self.options.seed);
        Some(PriceRecord::new(&found, &self.design.units))
    }

    fn exit(&self) -> Exit {
        match self.found.verdict() {
            ExploreVerdict::NewKinematics => optimize::exit_of(self.found.search.status),
            verdict => exit_of(verdict),
        }
    }

    /// The freedoms with which the requirements were met, as the end of a sentence; empty if there are none.
    fn what_resolves_it(&self) -> String {
        let opened = self.answer.beside.freedoms.iter().flatten();
        let resolved =
            opened.filter(|f| f.outcome == FreedomWord::Resolved).map(|f| format!("; {}", f.message));
        resolved.collect()
    }

    /// The explanation: one sentence with the deciding facts.
    fn explanation(&self) -> String {
        let end = if self.found.interrupted { "; search or assessment was interrupted" } else { "" };
        self.facts() + end
    }

    fn facts(&self) -> String {
        let assessed = |design: &Design| {
            self.assessment.as_ref().map_or_else(
                || format!("{} has too little space for separate joints", design.name),
                sheet::answers::sentence,
            )
        };
        let of_offsets = matches!(self.found.search.evidence, OptimizeEvidence::Offsets(_));
        match (self.found.finding(), of_offsets) {
            (ExploreFinding::Infeasible, true) => {
                "every branch of offsets violates the limits: proved".into()
            }
            (ExploreFinding::Infeasible, false) => {
                format!(
                    "no start met the requirements together; optimize.json has the conflict{}",
                    self.what_resolves_it()
                )
            }
            (ExploreFinding::NotFound, true) => {
                "no offsets were found within the limits, but some branches are not proved to be empty".into()
            }
            (ExploreFinding::NotFound, false) => {
                format!(
                    "no platform that meets the requirements was found, and no conflict either{}",
                    self.what_resolves_it()
                )
            }
            (ExploreFinding::Violated(design) | ExploreFinding::Unproved(design), _) => assessed(design),
            (ExploreFinding::OnHoles, _) => match (self.found.built(), &self.assessment) {
                (Some(_), Some(a)) => {
                    format!("{}; its joints are on the holes", sheet::answers::sentence(a))
                }
                _ => "all joints are on the holes; the design has no other requirements".into(),
            },
            (ExploreFinding::NoHoles(why), _) => format!("no platform has its joints on the holes: {why}"),
            (ExploreFinding::Compared(_), _) => {
                self.verified.as_ref().map_or_else(String::new, |v| v.explanation.clone())
            },
            (ExploreFinding::New, _) => {
                "the platform meets its requirements. Its triangles were chosen too, so its kinematics are new".into()
            }
        }
    }
}

/// The machine in files for other programs.
#[derive(Debug)]
struct MachineFiles {
    parts: Vec<PartLine>,
    /// Formats that cannot hold the machine, with the reason.
    refused: Vec<(&'static str, String)>,
}

/// Writes every format that can hold the platform into the folder.
fn machine(design: &Design, folder: &mut Folder) -> Result<MachineFiles, Failure> {
    let export = export::plain(design)?.with_octahedral(octahedral_of_controllers(design));
    let mut refused = Vec::new();
    for format in ExportFormat::ALL {
        match format.writer().files(&export) {
            Ok(list) => folder.keep_machine(list),
            Err(why) => refused.push((format.name(), why.to_string())),
        }
    }
    Ok(MachineFiles { parts: export.parts(), refused })
}

/// The answer of `build round` about the platform on its holes.
fn round_record(on: &DesignOnHoles, assessment: Option<AssessAnswer>) -> RoundAnswer {
    let report = RoundReport {
        design: &on.given,
        choices: &on.choices,
        found: &on.rounding,
        rounded: on.found.as_ref().map(|(way, design)| (*way, design)),
        is_taken: on.met() != Some(false),
        assessment,
        written: None,
    };
    report.record()
}

/// The exit code of the verdict.
fn exit_of(verdict: ExploreVerdict) -> Exit {
    match verdict {
        ExploreVerdict::OnHoles | ExploreVerdict::NewKinematics => Exit::Yes,
        ExploreVerdict::Infeasible | ExploreVerdict::None | ExploreVerdict::Violated => Exit::No,
        ExploreVerdict::Compared(word) => match word {
            VerdictWord::Equivalent => Exit::Yes,
            VerdictWord::NotEquivalent | VerdictWord::Singular => Exit::No,
            VerdictWord::Inconclusive => Exit::Inconclusive,
        },
    }
}

/// The failure for a design that could not be explored.
fn failed(why: NoExploration) -> Failure {
    match why {
        NoExploration::Search(why) => optimize::failed(why),
        NoExploration::Moves(why) => found::failed(&why),
        NoExploration::Comparison(why) => verify_command::failure_of(&why),
        NoExploration::Poses(why) => no_poses(&why),
        _ => Failure::internal(why.to_string()),
    }
}

fn no_poses(why: &NoOwnPoses) -> Failure {
    match why {
        NoOwnPoses::NoLengths => Failure::refused("explore::no_lengths", why.to_string()),
        NoOwnPoses::Fk(why) => fk_command::failure_of(why),
        _ => Failure::internal(why.to_string()),
    }
}

/// Runs all stages and writes their files.
pub(crate) fn run(args: &ExploreArgs, context: &mut Context) -> Result<Answer, Failure> {
    args.extension.map_or(Ok(()), optimize::check_extension)?;
    let design = context.load(&args.design)?;
    if Octahedral::recognise(design.manipulator()).is_err() {
        let why = "no platform is searched under the requirements of a design that is not octahedral";
        context.no_effect("drives", why)?;
        context.no_effect("time_limit", why)?;
        optimize::refuse_drives(&design, why)?;
        if design.holes.is_some() {
            let message = "the design states [holes], but only joints of octahedral designs are put on holes";
            return Err(Failure::refused("explore::holes", message).with_help(
                "`equipod build round` puts the joints of this design on its holes; without [holes] it can be explored",
            ));
        }
        relocation::refuse_fixed(
            &design,
            "explore::fixed",
            "the search for equivalents of a design that is not octahedral moves legs to places of its own",
        )?;
        return explored(args, design, None, context);
    }
    let extension = args.extension.unwrap_or(EXTENSION);
    optimize::refuse_singular_home(&design, extension, "explore::singular_home")?;
    search::refuse_front(&design)?;
    search::refuse_options(&design, args.drives.is_some(), context)?;
    if design.holes.is_some() {
        export::plain(&design)?; // units that are no lengths: now, and not after the search
    }
    let table = drives::asked(args.drives.as_deref(), &args.design, &design, context)?;
    explored(args, design, table.as_ref(), context)
}

/// Explores and writes the files of the folder.
fn explored(
    args: &ExploreArgs,
    design: Design,
    table: Option<&DriveTable>,
    context: &Context,
) -> Result<Answer, Failure> {
    let mut folder = Folder::prepare(&args.output)?;
    let copy = with_table_beside(&design, args, &mut folder, context.seed())?;
    folder.keep(folder::ORIGINAL, copy.to_toml());
    let mut progress = ProgressLine::new(context.quiet());
    // only the search for an octahedral design can be interrupted
    let octahedral = Octahedral::recognise(design.manipulator()).is_ok();
    let interrupt = octahedral.then(Interrupt::watch);
    let options = ExploreOptions::new()
        .seed(context.seed())
        .samples(args.samples)
        .extension(args.extension)
        .drives(table)
        .time_limit(args.time_limit.map(|limit| limit.0))
        .on_progress(|p| {
            search::show(&mut progress, &p);
            interrupt.as_ref().map_or(ControlFlow::Continue(()), Interrupt::flow)
        });
    match design.explore(options).map_err(failed)? {
        ExploreReport::Class(found) => written(args, design, *found, folder, (&mut progress, context)),
        ExploreReport::General(found) => {
            general::written(args, &design, &found, folder, (&mut progress, context))
        }
    }
}

/// The answer about an octahedral design, with its files.
fn written(
    args: &ExploreArgs,
    design: Design,
    found: ExploredClass,
    mut folder: Folder,
    (progress, context): (&mut ProgressLine, &Context),
) -> Result<Answer, Failure> {
    let provenance = context.provenance();
    let members: Vec<&FamilyMember> = found.family.members().iter().collect();
    let original = Original::octahedral(&design, found.octahedral.clone());
    let family = FamilyAnswer::new(&design.name, &original, &found.family, &members);
    folder.keep(folder::FAMILY, document(family, provenance.clone(), &[])?);
    let answer = OptimizeAnswer::new(&found.search, &platforms_of_freedoms(&found, &mut folder));
    folder.keep(folder::OPTIMIZE, document(&answer, provenance.clone(), &[])?);
    match (found.search.design(), found.search.closest()) {
        (Some(new), _) => _ = folder.keep(folder::OPTIMISED, new.to_toml()),
        (None, Some(closest)) => _ = folder.keep(folder::CLOSEST, closest.to_toml()),
        (None, None) => (),
    }
    if let Some(picture) = figures::determinant(&design, &found.octahedral, &found.search) {
        folder.keep(folder::DETERMINANT, picture);
    }
    let verified = found.compared.as_ref().map(|c| verification(c, &provenance, &mut folder)).transpose()?;
    folder
        .keep(folder::FK, document(FkRunRecord::new(&found.poses, &design.units), provenance.clone(), &[])?);
    folder.keep(folder::MODES, figures::modes(&design, &found.poses));

    let of_search = found.search.checked().and_then(|c| Some((&c.design, c.assessed.as_ref()?)));
    let mut assessment = of_search.map(|(d, a)| AssessAnswer::new(d, a).with_role(DesignRoleWord::Optimised));
    let mut built = None;
    if let Some(Ok(on)) = &found.holes {
        let new = on.found.as_ref().map(|(_, design)| design);
        assessment = new
            .zip(on.assessed.as_ref())
            .map(|(d, a)| AssessAnswer::new(d, a).with_role(DesignRoleWord::OnHoles));
        let rounding = round_record(on, assessment.clone());
        folder.keep(folder::ROUND, document(rounding, provenance.clone(), &[])?);
        if let Some(new) = new {
            folder.keep(folder::ROUNDED, new.to_toml());
            if let Some(found) = &assessment {
                folder.keep(folder::ROUNDED_ASSESS, document(found.clone(), provenance, &[])?);
            }
            built = Some(machine(new, &mut folder)?);
        }
    }

    progress.stage(5, "report");
    let results = Results {
        design,
        found,
        answer,
        assessment,
        machine: built,
        verified,
        options: FkOptions::new().seed(context.seed()),
        samples: args.samples,
        extension: args.extension.unwrap_or(EXTENSION),
    };
    let mut record = record(&results);
    folder.keep(folder::REPORT, report::markdown(&results, &headline(&record)));
    let files = folder.results();
    folder.keep(folder::PAGE, page(files, None, results.found.until));
    folder.finish()?;
    record.paths = folder.paths().collect();
    let lead = results.found.built().zip(record.assessment.as_ref());
    // the platform on holes, where there is one, is the platform that is built
    let file = [folder::ROUNDED, folder::OPTIMISED];
    let file = file.iter().find_map(|name| record.paths.iter().find(|path| path.ends_with(name)));
    let place = file.map_or_else(|| "in the report".to_owned(), |path| format!("equipod assess {path}"));
    let mut lead =
        lead.map_or_else(Sheet::new, |(design, a)| sheet::answers::verdict(&design.name, Some(a), &place));
    lead.add(notes(&record));
    let explanation = [&[record.explanation.clone()][..], &headline(&record)].concat().join("\n");
    let text = text(&record.name, record.verdict, &explanation, &record.paths, lead);
    Ok(Answer::new(results.exit(), ExploreAnswer::Octahedral(Box::new(record)), text))
}

/// Keeps the platforms that one more freedom each has led to.
fn platforms_of_freedoms(found: &ExploredClass, folder: &mut Folder) -> OptimizeFiles {
    let mut files = OptimizeFiles::default();
    for opened in found.search.freedoms.iter().flatten() {
        if let Some(design) = opened.design() {
            let path = folder.keep(&optimize::opened_file(opened.freedom), design.to_toml());
            files.freedoms.push((opened.freedom, path));
        }
    }
    files
}

/// The lines below the verdict: the cost of separate joints, the active bounds of the platform, and the safety margin.
fn headline(a: &ExploreOctahedralAnswer) -> Vec<String> {
    // on holes the cost is known, but active bounds are known only before rounding
    let active_bounds =
        a.optimize.as_ref().filter(|_| a.holes.is_none()).and_then(|o| o.active_bounds.as_ref());
    let found = a.price.is_some();
    let lines = [
        a.price.as_ref().map(|p| p.message.clone()),
        active_bounds.map(|r| r.message.clone()),
        a.safety_margin.as_ref().filter(|_| found).map(|r| r.message.clone()),
    ];
    lines.into_iter().flatten().collect()
}

/// Further notes of the answer: symmetry, drives, freedoms.
fn notes(a: &ExploreOctahedralAnswer) -> Sheet {
    let mut out = sheet::answers::symmetry_and_drives(&a.beside);
    for f in a.beside.freedoms.iter().flatten() {
        out.line(&f.message);
    }
    out
}

/// The design as read, with its table of drives beside it in the folder.
fn with_table_beside(
    design: &Design,
    args: &ExploreArgs,
    folder: &mut Folder,
    seed: u64,
) -> Result<Design, Failure> {
    let mut copy = original(design, seed);
    if let Some(name) = &design.drive_table {
        let path = args.design.parent().unwrap_or(Path::new("")).join(name);
        folder.keep(folder::DRIVES, files::read_text(&path)?);
        copy.drive_table = Some(folder::DRIVES.to_owned());
    }
    Ok(copy)
}

/// The design as read, with a note on the origin of the copy.
fn original(design: &Design, seed: u64) -> Design {
    let mut copy = design.clone();
    let note = format!("Input of equipod {} explore (seed {seed})", env!("CARGO_PKG_VERSION"));
    copy.description = Some(match &design.description {
        Some(text) => format!("{text}. {note}"),
        None => note,
    });
    copy
}

/// Keeps the answer of `verify`.
fn verification(
    compared: &ComparedDesigns,
    provenance: &ProvenanceRecord,
    folder: &mut Folder,
) -> Result<VerifyAnswer, Failure> {
    let answer = VerifyAnswer::from(compared);
    folder.keep(folder::VERIFY, document(&answer, provenance.clone(), &[])?);
    Ok(answer)
}

/// The real poses of a design at its own lengths, or at the lengths of its home pose.
pub(super) fn modes_picture(design: &Design, options: &FkOptions) -> Result<String, Failure> {
    let poses = design.own_poses(options).map_err(|why| no_poses(&why))?;
    Ok(figures::modes(design, &poses))
}

/// The record that `--json` writes to standard output; no file is written yet.
fn record(r: &Results) -> ExploreOctahedralAnswer {
    let (c, found) = (r.found.family.counts(), &r.found);
    ExploreOctahedralAnswer {
        verdict: found.verdict(),
        explanation: r.explanation(),
        interrupted: found.interrupted,
        assessment: r.assessment.clone(),
        name: r.design.name.clone(),
        paths: Vec::new(),
        family: FamilySizeRecord { patterns: c.patterns, topologies: c.topologies },
        optimize: OptimizedRecord::new(&r.answer),
        conic_programs: r.answer.search.conic_programs,
        price: r.price(),
        safety_margin: found
            .default_safety_margin
            .map(|result| DefaultSafetyMarginRecord::new(SAFETY_MARGIN_PERCENT, result)),
        verify: found.compared.as_ref().map(|c| ComparedRecord::from(&c.found)),
        holes: found.holes.as_ref().map(OnHolesRecord::from),
        beside: r.answer.beside.clone(),
        fk: PoseTotalsRecord::new(&found.poses),
    }
}

/// The paths, for programs; before them the requirements and the verdict, for people.
fn text(name: &str, verdict: ExploreVerdict, explanation: &str, paths: &[String], lead: Sheet) -> Sheet {
    let mut out = Sheet::new();
    if output_is_terminal() {
        out.line(format_args!("{name}: {}\n{explanation}", verdict.name().replace('_', " ")));
        out.add(lead);
    }
    for path in paths {
        out.line(path);
    }
    out
}
