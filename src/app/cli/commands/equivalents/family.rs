//! `equipod equivalents family`: all platforms equivalent to an octahedral design.

use std::path::PathBuf;

use crate::app::cli::commands::verify::failure_of;
use crate::app::cli::commands::{GENERAL, NEAREST};
use crate::app::cli::numbers;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::design::Share;
use ask::equivalents::{Original, Origins};
use ask::{Design, leg_map};
use fk::FkOptions;
use platform::manipulator::Octahedral;
use records::{DerivationRecord, FamilyAnswer, InstanceRecord};
use sheet::Sheet;
use synthesis::{Family, FamilyMember, LegMapOutcome, Pattern, Relation};

/// Arguments of `equivalents family`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsFamilyArgs {
    /// Octahedral design (.toml or .json), or one with offsets along its sides
    design: PathBuf,
    /// Write the graph of topologies for Graphviz
    #[arg(long, value_name = "FILE")]
    dot: Option<OutputPath>,
    /// Write a drawing of the topologies
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    /// Report only this pattern, for instance S123456 (no shared joint) or V23456S1
    #[arg(long, value_name = "ID")]
    pattern: Option<String>,
    /// Offsets of the moved joints as fractions of the edges: decimals or expressions such as 1/5
    #[arg(
        long,
        value_name = "T1,..",
        value_delimiter = ',',
        value_parser = numbers::offset,
        allow_hyphen_values = true,
        requires = "pattern"
    )]
    offsets: Option<Vec<String>>,
    /// Show the derivation of A, c and det A step by step, and the check by forward kinematics
    #[arg(long, requires = "offsets")]
    explain: bool,
    /// Write the platform of the pattern as a design
    #[arg(short, long, value_name = "FILE", requires = "offsets")]
    output: Option<OutputPath>,
}

/// Lists the class, or one pattern of it.
pub(crate) fn run(args: &EquivalentsFamilyArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let original = original(&design)?;
    let family = Family::octahedral();
    if let Some(path) = &args.dot {
        files::write_text(path, &family.to_dot())?;
    }
    if let Some(path) = &args.svg {
        files::write_text(path, &family.to_svg())?;
    }
    let pattern = args.pattern.as_deref().map(parse_pattern).transpose()?;
    let members: Vec<&FamilyMember> =
        family.members().iter().filter(|m| pattern.as_ref().is_none_or(|p| m.pattern == *p)).collect();
    let mut answer = FamilyAnswer::new(&design.name, &original, &family, &members);
    let mut built = None;
    if let (Some(pattern), Some(offsets)) = (&pattern, &args.offsets) {
        let (record, derivation, found) = realise(args, pattern, &design, &original, offsets, context)?;
        (answer.instance, answer.derivation, built) = (Some(record), derivation, Some(found));
    }
    let mut sheet = Sheet::new();
    if let Some(map) = original.map.as_ref().filter(|map| map.relation == Relation::Undecided) {
        let said = map.explanation();
        sheet.line(format_args!("{} is made from an octahedral platform {said}\n", design.name));
    }
    sheet.add(sheet::answers::family(&answer, pattern.is_some()));
    // a result for a design made from the platform holds as far as the design is equivalent to it
    let of_design = original.map.as_ref().map_or(Relation::Equivalent, |map| map.relation);
    let exit = match (of_design, built.as_ref().map(|map| map.relation)) {
        (_, Some(Relation::Singular | Relation::Unrelated)) => Exit::No,
        (Relation::Equivalent, None | Some(Relation::Equivalent)) => Exit::Yes,
        _ => Exit::Inconclusive,
    };
    if let Some(path) = &args.output {
        let written = built.as_ref().is_some_and(LegMapOutcome::is_regular_within_rounding);
        match exit {
            _ if written => sheet.line(format_args!("wrote {}", path.display())),
            Exit::No => sheet.line("No design is written: the platform is architecturally singular."),
            _ => sheet.line("No design is written: the platform may be architecturally singular."),
        }
    }
    Ok(Answer::new(exit, answer, sheet))
}

/// The octahedral platform that a design is or is made from; for a design proved to have none the answer is no.
fn original(design: &Design) -> Result<Original, Failure> {
    let no = |code, message: String| Failure::new(Exit::No, code, message);
    let original = match Original::behind(design) {
        Origins::Of(original) => *original,
        Origins::Refuted(map) => {
            let message = format!(
                "{} is not equivalent to the octahedral platform of its triangles: {}",
                design.name,
                map.explanation()
            );
            return Err(no("family::not_equivalent", message).with_help(NEAREST));
        }
        Origins::None => {
            let why = Octahedral::recognise(design.manipulator());
            let why = why.err().map_or_else(String::new, |e| format!(": {e}"));
            let message =
                format!("{} is neither octahedral nor made from an octahedral platform{why}", design.name);
            return Err(Failure::refused("family::not_octahedral", message).with_help(format!(
                "give a design with three joints on each body and two legs at each joint, or with its joints on the sides of two triangles; {NEAREST} {GENERAL}"
            )));
        }
    };
    if original.map.as_ref().is_some_and(|map| map.relation == Relation::Singular) {
        let message = format!(
            "{} is made from an octahedral platform but singular, so it is equivalent to no octahedral platform",
            design.name
        );
        return Err(no("family::singular", message).with_help("`equipod check DESIGN` says why"));
    }
    Ok(original)
}

fn parse_pattern(text: &str) -> Result<Pattern, Failure> {
    text.parse().map_err(|e| {
        Failure::refused("family::bad_pattern", format!("`{text}`: {e}"))
            .with_help("take an \"id\" from the patterns of `equipod equivalents family DESIGN --json`")
    })
}

/// Builds the platform and writes it if requested, unless it is singular.
fn realise(
    args: &EquivalentsFamilyArgs,
    pattern: &Pattern,
    design: &Design,
    original: &Original,
    offsets: &[String],
    context: &Context,
) -> Result<(InstanceRecord, Option<DerivationRecord>, LegMapOutcome), Failure> {
    let refused = |e: &dyn std::fmt::Display| {
        Failure::refused("family::bad_offsets", e.to_string())
            .with_help("give one finite offset for each S of the pattern, separated by commas")
    };
    let shares = original.shares(pattern, offsets).map_err(|e| refused(&e))?;
    let offsets: Vec<f64> = shares.iter().map(Share::nearest).collect();
    let (built, map) = original.equivalent_at(pattern, &shares).map_err(|e| refused(&e))?;
    let record = InstanceRecord::new(pattern, &offsets, &built, &map).map_err(|e| refused(&e))?;
    let (derivation, own_map) =
        args.explain.then(|| explain(pattern, original, &built, context)).transpose()?.unzip();
    // an octahedral design is its own original
    let found = match own_map.filter(|_| original.map.is_none()) {
        Some(map) => map,
        None => leg_map(design, &built)
            .map_err(|e| Failure::new(Exit::Inconclusive, "family::breakdown", e.to_string()))?,
    };
    if let Some(path) = args.output.as_ref().filter(|_| found.is_regular_within_rounding()) {
        files::write_design(path, &built)?;
    }
    Ok((record, derivation, found))
}

/// The steps to the platform, and the forward kinematics of both platforms.
fn explain(
    pattern: &Pattern,
    original: &Original,
    built: &Design,
    context: &Context,
) -> Result<(DerivationRecord, LegMapOutcome), Failure> {
    let options = FkOptions::new().seed(context.seed());
    let found = DerivationRecord::compared(original, pattern, built, &options);
    let found = found.map_err(|e| failure_of(&e))?;
    found.ok_or_else(|| Failure::internal("an edge of the octahedral platform has no length"))
}
