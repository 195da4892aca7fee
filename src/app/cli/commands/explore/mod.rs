//! `equipod explore`: everything about a design in one folder. This file is about octahedral designs, [`general`] about
//! the others.

mod figures;
pub(super) mod folder;
mod general;
mod report;
mod search;

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use self::folder::Folder;
use self::search::ExploreSearch;
use super::build::drives;
use super::build::round::render::RoundReport;
use super::equivalents::r#move as relocation;
use super::report::page;
use super::{export, fk as fk_command, optimize, verify as verify_command};
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::{Answer, document};
use crate::app::cli::poses;
use crate::app::cli::progress::{Interrupt, ProgressLine, TimeLimit};
use crate::app::cli::streams::output_is_terminal;
use ::files::design::DriveTable;
use ::files::export::{ExportFormat, PartLine};
use ask::Design;
use ask::equivalents::Original;
use ask::exporting::octahedral_of_controllers;
use ask::optimizing::{EXTENSION, RESERVE_PERCENT, with_default_reserve};
use ask::rounding::DesignOnHoles;
use ask::{FreedomWord, OptimizeEvidence, SAMPLES};
use fk::{self, FkOptions, FkSolutions, PoseCounting};
use machine::manufacture::NoRounding;
use machine::requirements::KeptSymmetry;
use platform::manipulator::{LegLengths, Octahedral};
use records::{
    AssessAnswer, ComparedRecord, DefaultReserveRecord, DesignRoleWord, ExploreAnswer,
    ExploreOctahedralAnswer, ExploreVerdict, FamilyAnswer, FamilySizeRecord, FkRunRecord, LengthsOrigin,
    OnHolesRecord, OptimizeAnswer, OptimizedRecord, PoseTotalsRecord, PriceRecord, ProvenanceRecord,
    RoundAnswer, VerifyAnswer,
};
use synthesis::{Family, FamilyMember};
use verify::{VerdictWord, Verification};

/// Arguments of `explore`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExploreArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Folder for the results; it is made where it does not exist, the results of an earlier run are replaced, and a
    /// file of yours that a result would replace is refused
    #[arg(short, long, value_name = "DIR")]
    output: OutputPath,
    /// Number of sets of leg lengths at which two designs are solved and compared: an octahedral design with the
    /// optimised one, another with the equivalent found, or its nearest octahedral platform with that one's equivalent
    #[arg(long, default_value_t = SAMPLES, value_name = "N", value_parser = verify_command::at_least_one)]
    samples: usize,
    /// How far a joint may stand beyond a corner, on the extension of its side, in lengths of the side; default: 0.3,
    /// and 1 for the nearest octahedral platform of a design that is not octahedral
    #[arg(long, value_name = "X")]
    extension: Option<f64>,
    /// Table of drives (.csv), as `equipod build drives` reads it: the platform is searched with each drive that could
    /// win, as `optimize --drives` does, in place of that of the design (`drives` in `[hardware]`). Of octahedral
    /// designs
    #[arg(long, value_name = "TABLE")]
    drives: Option<PathBuf>,
    /// End the search after so many seconds, the judging of what it found included: the folder has the best platform
    /// until then. Of octahedral designs
    #[arg(long, value_name = "SECONDS", value_parser = clap::value_parser!(TimeLimit))]
    time_limit: Option<TimeLimit>,
}

/// The verification with its answer.
#[derive(Debug)]
struct Verified {
    found: Verification,
    record: VerifyAnswer,
    /// The number of random sets of leg lengths.
    samples: usize,
}

/// Poses for one set of leg lengths.
#[derive(Debug)]
struct ExplorePoses {
    lengths: LegLengths,
    from: LengthsOrigin,
    solutions: FkSolutions,
}

/// All results.
#[derive(Debug)]
struct Results {
    design: Design,
    /// What became of the default reserve; `None` where the design states one.
    reserve: Option<DefaultReserve>,
    family: Family,
    search: ExploreSearch,
    /// The answer of `optimize`.
    answer: OptimizeAnswer,
    /// The platform on the holes that the design states; `None` where it states none, or no platform was found.
    holes: Option<Result<DesignOnHoles, NoRounding>>,
    /// What `assess` says of the platform found, on its holes where the design states them.
    assessment: Option<AssessAnswer>,
    /// Parts and files for other programs, where the design states holes.
    machine: Option<MachineFiles>,
    /// Absent when no platform was found, or one with other triangles.
    verified: Option<Verified>,
    poses: ExplorePoses,
    options: FkOptions,
    extension: f64,
}

impl Results {
    /// The platform to build: that on the holes, where the design states them.
    fn built(&self) -> Option<&Design> {
        match &self.holes {
            Some(Ok(on)) => on.found.as_ref().map(|(_, design)| design),
            Some(Err(_)) => None,
            None => self.search.optimised(),
        }
    }

    /// What separate joints cost in the platform to build.
    fn price(&self) -> Option<PriceRecord> {
        let found = self.design.separation(self.built()?, self.options.seed);
        Some(PriceRecord::new(&found, &self.design.units))
    }

    /// What the platform found is judged by: its requirements first, then the comparison.
    fn judgement(&self) -> JudgedBy<'_> {
        match &self.holes {
            Some(Err(why)) => return JudgedBy::NoHoles(why.to_string()),
            Some(Ok(on)) => {
                let Some((_, design)) = &on.found else { return JudgedBy::NoHoles(why_none(on)) };
                return match on.met() {
                    Some(true) => JudgedBy::OnHoles,
                    Some(false) => JudgedBy::Violated(design),
                    None => JudgedBy::Unproved(design),
                };
            }
            None => (),
        }
        match (self.search.optimised(), self.search.met(), &self.verified) {
            (None, ..) if self.search.exit() == Exit::No => JudgedBy::Infeasible,
            (None, ..) => JudgedBy::NotFound,
            (Some(design), Some(false), _) => JudgedBy::Violated(design),
            (Some(design), None, _) => JudgedBy::Unproved(design),
            (Some(_), Some(true), Some(v)) => JudgedBy::Compared(v),
            (Some(_), Some(true), None) => JudgedBy::New,
        }
    }

    /// The word for the whole run.
    fn verdict(&self) -> ExploreVerdict {
        match self.judgement() {
            JudgedBy::Infeasible => ExploreVerdict::Infeasible,
            JudgedBy::Violated(_) | JudgedBy::NoHoles(_) => ExploreVerdict::Violated,
            JudgedBy::OnHoles => ExploreVerdict::OnHoles,
            JudgedBy::New => ExploreVerdict::NewKinematics,
            JudgedBy::Compared(v) => ExploreVerdict::Compared(v.found.verdict.word()),
            JudgedBy::NotFound | JudgedBy::Unproved(_) => ExploreVerdict::Compared(VerdictWord::Inconclusive),
        }
    }

    fn exit(&self) -> Exit {
        match self.judgement() {
            JudgedBy::Infeasible | JudgedBy::Violated(_) | JudgedBy::NoHoles(_) => Exit::No,
            JudgedBy::OnHoles => Exit::Yes,
            JudgedBy::NotFound | JudgedBy::Unproved(_) => Exit::Inconclusive,
            JudgedBy::Compared(v) => verify_command::exit_of(&v.found.verdict),
            JudgedBy::New => self.search.exit(),
        }
    }

    /// The freedoms with which the requirements were met, as the end of a sentence; empty where there are none.
    fn what_resolves_it(&self) -> String {
        let opened = self.answer.freedoms.iter().flatten();
        let resolved =
            opened.filter(|f| f.outcome == FreedomWord::Resolved).map(|f| format!("; {}", f.message));
        resolved.collect()
    }

    /// One sentence with what decided.
    fn explanation(&self) -> String {
        let judged = |design: &Design| {
            self.assessment.as_ref().map_or_else(
                || format!("{} does not have the room that separate joints need", design.name),
                sheet::answers::sentence,
            )
        };
        let of_offsets = matches!(self.search.found.evidence, OptimizeEvidence::Offsets(_));
        match (self.judgement(), of_offsets) {
            (JudgedBy::Infeasible, true) => {
                "every branch of offsets is proved to violate the limits".into()
            }
            (JudgedBy::Infeasible, false) => {
                format!(
                    "no start met the requirements together; the conflict stands in optimize.json{}",
                    self.what_resolves_it()
                )
            }
            (JudgedBy::NotFound, true) => {
                "no offsets were found that keep the limits, but some branches are not proved empty".into()
            }
            (JudgedBy::NotFound, false) => {
                format!(
                    "no platform that meets the requirements was found, and no conflict{}",
                    self.what_resolves_it()
                )
            }
            (JudgedBy::Violated(design) | JudgedBy::Unproved(design), _) => judged(design),
            (JudgedBy::OnHoles, _) => match (self.built(), &self.assessment) {
                (Some(_), Some(a)) => {
                    format!("{}; its joints are on the holes", sheet::answers::sentence(a))
                }
                _ => "all joints are on the holes; nothing is required besides".into(),
            },
            (JudgedBy::NoHoles(why), _) => format!("no platform has its joints on the holes: {why}"),
            (JudgedBy::Compared(v), _) => v.record.explanation.clone(),
            (JudgedBy::New, _) => {
                "the platform meets its requirements; its triangles were chosen too, so that its kinematics are new".into()
            }
        }
    }
}

/// What decides about the platform found.
enum JudgedBy<'a> {
    /// There is none, and that is known.
    Infeasible,
    /// None was found.
    NotFound,
    /// It misses requirements.
    Violated(&'a Design),
    /// It is not proved to meet its requirements.
    Unproved(&'a Design),
    /// It meets its requirements, and this is how it compares with the design.
    Compared(&'a Verified),
    /// It meets its requirements, and is not meant to have the kinematics of the design.
    New,
    /// It meets its requirements with its joints on the holes that the design states.
    OnHoles,
    /// No platform has its joints on those holes, and why.
    NoHoles(String),
}

/// What stands against both roundings.
fn why_none(on: &DesignOnHoles) -> String {
    let exact = on.rounding.exact.as_ref().err().map(ToString::to_string);
    let nearest = on.rounding.nearest.as_ref().err().map(ToString::to_string);
    exact.into_iter().chain(nearest).collect::<Vec<_>>().join("; ")
}

/// The machine in files for other programs.
#[derive(Debug)]
struct MachineFiles {
    parts: Vec<PartLine>,
    /// Formats that cannot hold it, and why.
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
        design: &on.wanted,
        choices: &on.choices,
        found: &on.rounding,
        rounded: on.found.as_ref().map(|(way, design)| (*way, design)),
        is_taken: on.met() != Some(false),
        assessment,
        written: None,
    };
    report.record()
}

/// Runs all stages; each file is written when its stage is finished.
pub(crate) fn run(args: &ExploreArgs, context: &mut Context) -> Result<Answer, Failure> {
    args.extension.map_or(Ok(()), optimize::check_extension)?;
    let design = context.load(&args.design)?;
    let Ok(octahedral) = Octahedral::recognise(design.manipulator()) else {
        let why = "no platform is searched under the requirements of a design that is not octahedral";
        context.no_effect("drives", why)?;
        context.no_effect("time_limit", why)?;
        optimize::refuse_drives(&design, why)?;
        if design.holes.is_some() {
            let message =
                "the design states [holes], and joints are put on them for octahedral designs alone";
            return Err(Failure::refused("explore::holes", message).with_help(
                "`equipod build round` puts the joints of this design on its holes; without [holes] it can be explored",
            ));
        }
        relocation::refuse_fixed(
            &design,
            "explore::fixed",
            "the search for equivalents of a design that is not octahedral moves legs to places of its own",
        )?;
        return general::run(args, &design, context);
    };
    let extension = args.extension.unwrap_or(EXTENSION);
    optimize::refuse_singular_home(&design, extension, "explore::singular_home")?;
    search::refuse_front(&design)?;
    search::refuse_options(&design, args.drives.is_some(), context)?;
    if design.holes.is_some() {
        export::plain(&design)?; // units that are no lengths: now, and not after the search
    }
    let table = drives::asked(args.drives.as_deref(), &args.design, &design, context)?;
    let mut folder = Folder::prepare(&args.output)?;
    let mut progress = ProgressLine::new(context.quiet());
    let seed = context.seed();
    let provenance = context.provenance();
    let options = FkOptions::new().seed(seed).pose_count(PoseCounting::Never);
    let copy = with_table_beside(&design, args, &mut folder, seed)?;
    folder.keep(folder::ORIGINAL, copy.to_toml());

    progress.stage(1, "equivalence class");
    let family = Family::octahedral();
    let members: Vec<&FamilyMember> = family.members().iter().collect();
    folder.keep(
        folder::FAMILY,
        document(
            FamilyAnswer::new(
                &design.name,
                &Original::octahedral(&design, octahedral.clone()),
                &family,
                &members,
            ),
            provenance.clone(),
            &[],
        )?,
    );

    progress.stage(2, "the best platform");
    let interrupt = Interrupt::watch_for(args.time_limit);
    let careful = with_default_reserve(&design);
    let asked = ExploreQuestion {
        design: &design,
        drives: table.as_ref(),
        extension,
        explains: true,
        context,
        interrupt: &interrupt,
    };
    let Careful { found, holes, reserve } = searched_carefully(&asked, careful.as_ref(), &mut progress)?;
    let mut found = found.with_lengths_of(&design);
    let answer = found.answer(&asked, &mut progress, &mut folder)?;
    folder.keep(folder::OPTIMIZE, document(&answer, provenance.clone(), &[])?);
    if let Some(new) = found.optimised() {
        folder.keep(folder::OPTIMISED, new.to_toml());
    }
    if let (None, Some(closest)) = (found.optimised(), found.closest()) {
        folder.keep(folder::CLOSEST, closest.to_toml());
    }
    if let Some(picture) = figures::determinant(&design, &octahedral, &found) {
        folder.keep(folder::DETERMINANT, picture);
    }

    progress.stage(3, "verification");
    let verified = found
        .optimised()
        .filter(|_| found.keeps_class())
        .map(|new| verification(&design, new, args.samples, &options, &provenance, &mut folder))
        .transpose()?;

    progress.stage(4, "forward kinematics");
    let poses = solve(&design, &options)?;
    folder.keep(folder::FK, document(fk_record(&poses), provenance, &[])?);
    folder.keep(folder::MODES, figures::modes(&design, &poses));

    let mut assessment = found.assessment();
    let mut built = None;
    if let Some(Ok(on)) = &holes {
        let new = on.found.as_ref().map(|(_, design)| design);
        assessment = new
            .zip(on.assessed.as_ref())
            .map(|(d, a)| AssessAnswer::new(d, a).with_role(DesignRoleWord::OnHoles));
        let rounding = round_record(on, assessment.clone());
        folder.keep(folder::ROUND, document(rounding, context.provenance(), &[])?);
        if let Some(new) = new {
            folder.keep(folder::ROUNDED, new.to_toml());
            if let Some(found) = &assessment {
                let text = document(found.clone(), context.provenance(), &[])?;
                folder.keep(folder::ROUNDED_ASSESS, text);
            }
            built = Some(machine(new, &mut folder)?);
        }
    }

    progress.stage(5, "report");
    let results = Results {
        design,
        reserve,
        family,
        search: found,
        answer,
        holes,
        assessment,
        machine: built,
        verified,
        poses,
        options,
        extension,
    };
    let short = headline(&record(&results, &folder));
    folder.keep(folder::REPORT, report::markdown(&results, &short));
    let files = folder.results();
    folder.keep(folder::PAGE, page(files, None));
    folder.finish()?;
    let record = record(&results, &folder);
    let lead = results.built().zip(record.assessment.as_ref());
    let lead = lead.map(|(design, a)| sheet::answers::requirements(&design.name, Some(a)));
    let notes = notes(&record);
    let lead = lead.map_or_else(|| notes.clone(), |lead| format!("{notes}{lead}"));
    let lead = (!lead.is_empty()).then_some(lead);
    let explanation = [&[record.explanation.clone()][..], &headline(&record)].concat().join("\n");
    let text = text(&record.name, record.verdict, &explanation, &record.paths, lead.as_deref());
    Ok(Answer::new(results.exit(), ExploreAnswer::Octahedral(Box::new(record)), text))
}

/// What is searched for, and how.
#[derive(Debug, Clone, Copy)]
pub(super) struct ExploreQuestion<'a> {
    design: &'a Design,
    /// The drives to choose from, where a table was given.
    drives: Option<&'a DriveTable>,
    extension: f64,
    /// Whether a conflict is looked for where nothing meets the requirements.
    explains: bool,
    context: &'a Context,
    interrupt: &'a Interrupt,
}

/// What became of the reserve that a design does not state.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum DefaultReserve {
    /// The platform found keeps it.
    Kept,
    /// No platform that keeps it was found: the answer is that of the search without it.
    GivenUp,
}

/// A search with what became of the default reserve.
struct Careful {
    found: ExploreSearch,
    holes: OnHoles,
    reserve: Option<DefaultReserve>,
}

/// The search with the default reserve first, where the design states none, and without it where that leads to no
/// platform.
fn searched_carefully(
    asked: &ExploreQuestion<'_>,
    careful: Option<&Design>,
    progress: &mut ProgressLine,
) -> Result<Careful, Failure> {
    let Some(careful) = careful else {
        let (found, holes) = searched(asked, progress)?;
        return Ok(Careful { found, holes, reserve: None });
    };
    let (found, holes) = searched(&ExploreQuestion { design: careful, explains: false, ..*asked }, progress)?;
    let keeps = match &holes {
        None => found.optimised().is_some() && found.met() == Some(true),
        Some(_) => is_met(&holes),
    };
    if keeps || asked.interrupt.flow().is_break() {
        return Ok(Careful { found, holes, reserve: Some(DefaultReserve::Kept) });
    }
    let (found, holes) = searched(asked, progress)?;
    Ok(Careful { found, holes, reserve: Some(DefaultReserve::GivenUp) })
}

/// A platform with its joints on the holes that the design states; `None` where it states none, or no platform was
/// found.
type OnHoles = Option<Result<DesignOnHoles, NoRounding>>;

/// The best platform, and the same on the holes that the design states. Where a symmetry that nobody asked for leads to
/// a platform on the holes that is not proved to meet its requirements, the search without it is the answer if it leads
/// to one that is.
fn searched(
    asked: &ExploreQuestion<'_>,
    progress: &mut ProgressLine,
) -> Result<(ExploreSearch, OnHoles), Failure> {
    let found = search::search(asked, progress)?;
    let holes = found.on_holes(asked, progress)?;
    let is_last = holes.is_none() || is_met(&holes) || asked.interrupt.flow().is_break();
    if is_last || !found.keeps_symmetry_of_start() {
        return Ok((found, holes));
    }
    let mut free = asked.design.clone();
    free.search.symmetry = Some(KeptSymmetry::None);
    let free = ExploreQuestion { design: &free, ..*asked };
    let other = search::search(&free, progress)?;
    let on_holes = other.on_holes(&free, progress)?;
    Ok(if is_met(&on_holes) { (other.without_symmetry_of_start(), on_holes) } else { (found, holes) })
}

/// Whether a platform stands on the holes and is proved to meet its requirements.
fn is_met(holes: &OnHoles) -> bool {
    matches!(holes, Some(Ok(on)) if on.found.is_some() && on.met() == Some(true))
}

/// The lines below the verdict: the price of separate joints, what the platform rides on, and the reserve.
fn headline(a: &ExploreOctahedralAnswer) -> Vec<String> {
    // of joints on holes the price is known, and not what the platform before the rounding rode on
    let riding = a.optimize.as_ref().filter(|_| a.holes.is_none()).and_then(|o| o.riding.as_ref());
    let found = a.price.is_some();
    let lines = [
        a.price.as_ref().map(|p| p.message.clone()),
        riding.map(|r| r.message.clone()),
        a.reserve.as_ref().filter(|_| found).map(|r| r.message.clone()),
    ];
    lines.into_iter().flatten().collect()
}

/// What the answer says besides its verdict: symmetry, drives, freedoms.
fn notes(a: &ExploreOctahedralAnswer) -> String {
    let mut out = String::new();
    if let Some(s) = &a.symmetry {
        let _ = writeln!(out, "{}", s.message);
    }
    if let Some(d) = &a.drive_search {
        let _ = write!(out, "\n{}", sheet::answers::tried_drives(d));
    }
    for f in a.freedoms.iter().flatten() {
        let _ = writeln!(out, "{}", f.message);
    }
    out
}

/// The design as it was read, with the table of drives that it names beside it in the folder.
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

/// The design as it was read, with a word on where the copy comes from.
fn original(design: &Design, seed: u64) -> Design {
    let mut copy = design.clone();
    let note = format!("Input of equipod {} explore (seed {seed})", env!("CARGO_PKG_VERSION"));
    copy.description = Some(match &design.description {
        Some(text) => format!("{text}. {note}"),
        None => note,
    });
    copy
}

fn verification(
    design: &Design,
    new: &Design,
    samples: usize,
    options: &FkOptions,
    provenance: &ProvenanceRecord,
    folder: &mut Folder,
) -> Result<Verified, Failure> {
    let (found, record) = verify_command::compared([design, new], samples, options)?;
    folder.keep(folder::VERIFY, document(&record, provenance.clone(), &[])?);
    Ok(Verified { found, record, samples })
}

/// The poses at the design's own lengths, or at those of its home pose.
fn solve(design: &Design, options: &FkOptions) -> Result<ExplorePoses, Failure> {
    let m = design.manipulator();
    let home = || poses::home(design).lengths(m);
    let (lengths, from) = if let Some(lengths) = design.lengths {
        (lengths, LengthsOrigin::Design)
    } else {
        let none = || Failure::refused("explore::no_lengths", "the home pose has no finite leg lengths");
        (home().ok_or_else(none)?, LengthsOrigin::Home)
    };
    let solutions =
        fk::solver(None).solve(m, &lengths.squared(), options).map_err(|e| fk_command::failure_of(&e))?;
    Ok(ExplorePoses { lengths, from, solutions })
}

/// The real poses of a design at its own lengths, or at those of its home pose.
pub(super) fn modes_picture(design: &Design, options: &FkOptions) -> Result<String, Failure> {
    Ok(figures::modes(design, &solve(design, options)?))
}

fn fk_record(poses: &ExplorePoses) -> FkRunRecord {
    FkRunRecord { lengths: poses.lengths.get(), lengths_from: poses.from, solved: (&poses.solutions).into() }
}

/// What `--json` writes to standard output.
fn record(r: &Results, folder: &Folder) -> ExploreOctahedralAnswer {
    let c = r.family.counts();
    ExploreOctahedralAnswer {
        verdict: r.verdict(),
        explanation: r.explanation(),
        assessment: r.assessment.clone(),
        name: r.design.name.clone(),
        paths: folder.paths().collect(),
        family: FamilySizeRecord { patterns: c.patterns, topologies: c.topologies },
        optimize: OptimizedRecord::new(&r.answer),
        conic_programs: r.answer.search.conic_programs,
        price: r.price(),
        reserve: r.reserve.map(|r| DefaultReserveRecord::new(RESERVE_PERCENT, r == DefaultReserve::Kept)),
        verify: r.verified.as_ref().map(|v| ComparedRecord::from(&v.found)),
        holes: r.holes.as_ref().map(OnHolesRecord::from),
        symmetry: r.answer.symmetry.clone(),
        drive_search: r.answer.drive_search.clone(),
        freedoms: r.answer.freedoms.clone(),
        fk: PoseTotalsRecord::new(r.poses.from, &r.poses.solutions),
    }
}

/// The paths, for programs; before them the requirements and the verdict, for people.
fn text(
    name: &str,
    verdict: ExploreVerdict,
    explanation: &str,
    paths: &[String],
    lead: Option<&str>,
) -> String {
    let mut out = String::new();
    if output_is_terminal() {
        if let Some(lead) = lead {
            let _ = writeln!(out, "{lead}");
        }
        let _ = writeln!(out, "{name}: {}\n{explanation}", verdict.name());
    }
    for path in paths {
        let _ = writeln!(out, "{path}");
    }
    out
}
