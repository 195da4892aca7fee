//! `equipod equivalents family`: every platform equivalent to an octahedral design.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files::{self, OutputPath};
use crate::cli::output::Answer;
use crate::design::Design;
use crate::equivalents::Original;
use crate::manipulator::{Body, Octahedral};
use crate::records::{FamilyAnswer, InstanceRecord};
use crate::synthesis::{Factor, Family, FamilyCounts, FamilyMember, HexagonPoint, Pattern, edge_lengths};

/// Arguments of `equivalents family`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Octahedral design (.toml or .json)
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
    /// Fractions of the edges at which the moved joints sit, one for each inner point
    #[arg(
        long,
        value_name = "T1,..",
        value_delimiter = ',',
        allow_hyphen_values = true,
        requires = "pattern"
    )]
    offsets: Option<Vec<f64>>,
    /// Write the platform of the pattern as a design
    #[arg(short, long, value_name = "FILE", requires = "offsets")]
    output: Option<OutputPath>,
}

/// Lists the class, or one pattern of it.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let o = Octahedral::recognise(design.manipulator()).map_err(|e| {
        Failure::refused("family::not_octahedral", format!("{} is not octahedral: {e}", design.name))
            .with_help("an octahedral design has three joints on each body and two legs at each joint, and the legs make one closed zigzag")
    })?;
    let family = Family::octahedral();
    if let Some(path) = &args.dot {
        files::write_text(path, &family.to_dot())?;
    }
    if let Some(path) = &args.svg {
        files::write_text(path, &family.to_svg())?;
    }
    let wanted = args.pattern.as_deref().map(parse_pattern).transpose()?;
    let members: Vec<&FamilyMember> =
        family.members().iter().filter(|m| wanted.as_ref().is_none_or(|p| m.pattern == *p)).collect();
    let c = family.counts();
    let mut answer = FamilyAnswer::new(&design, &o, &family, &members);
    let mut text = summary(&design, c);
    match wanted {
        Some(pattern) => {
            let original = Original::octahedral(&design, o);
            describe(&mut text, &pattern, &original);
            if let Some(offsets) = &args.offsets {
                answer.instance = Some(realise(args, &pattern, &original, offsets, &mut text)?);
            }
        }
        None => list_topologies(&mut text, &family),
    }
    Ok(Answer::new(Exit::Yes, answer, text))
}

fn parse_pattern(text: &str) -> Result<Pattern, Failure> {
    text.parse().map_err(|e| {
        Failure::refused("family::bad_pattern", format!("`{text}`: {e}"))
            .with_help("take an \"id\" from the patterns of `equipod equivalents family DESIGN --json`")
    })
}

/// Builds the platform and writes it where asked.
fn realise(
    args: &Args,
    pattern: &Pattern,
    original: &Original,
    offsets: &[f64],
    text: &mut String,
) -> Result<InstanceRecord, Failure> {
    let refused = |e: &dyn std::fmt::Display| Failure::refused("family::bad_offsets", e.to_string());
    let (built, map) = original.equivalent(pattern, offsets).map_err(|e| refused(&e))?;
    let record = InstanceRecord::new(pattern, offsets, &built, &map).map_err(|e| refused(&e))?;
    let _ = writeln!(text, "\nat these offsets det A = {}", record.determinant.0);
    if let Some(path) = &args.output {
        files::write_design(path, &built)?;
        let _ = writeln!(text, "wrote {}", path.display());
    }
    Ok(record)
}

fn summary(design: &Design, c: FamilyCounts) -> String {
    let mut text = format!("platforms equivalent to {}\n\n", design.name);
    let lines = [
        ("patterns", c.patterns, None),
        ("patterns up to symmetry", c.classes, Some(c.classes_exchange)),
        ("topologies", c.topologies, Some(c.topologies_exchange)),
        ("topologies, one offset at a time", c.sequential_topologies, Some(c.sequential_topologies_exchange)),
    ];
    for (what, count, exchange) in lines {
        let _ = write!(text, "{count:>5}  {what}");
        let _ = match exchange {
            Some(n) => writeln!(text, " ({n} when base and platform may be exchanged)"),
            None => writeln!(text),
        };
    }
    text
}

fn list_topologies(text: &mut String, family: &Family) {
    text.push_str("\ntopology  base  platform  shared  patterns  sequential  example\n");
    for (k, t) in family.topologies().iter().enumerate() {
        let patterns = family.members().iter().filter(|m| m.topology == k).count();
        let _ = writeln!(
            text,
            "{:>8}  {:>4}  {:>8}  {:>6}  {patterns:>8}  {:<10}  {}",
            k + 1,
            t.topology.base_joints(),
            t.topology.platform_joints(),
            t.topology.shared_joints(),
            if t.sequential { "yes" } else { "no" },
            t.example
        );
    }
}

fn describe(text: &mut String, pattern: &Pattern, original: &Original) {
    let o = &original.octahedral;
    let _ = writeln!(text, "\npattern {pattern}");
    let mut lines: Vec<(usize, String)> = Vec::new();
    for (slot, point) in o.order().iter().zip(pattern.legs()) {
        let [a, b] = original.leg_names(point);
        let formula = match point {
            HexagonPoint::Vertex(_) => format!("s{}", slot.get() + 1),
            HexagonPoint::Inner(t) => {
                let (k, n) = (o.order()[t.side].get() + 1, o.order()[(t.side + 1) % 6].get() + 1);
                format!("(1 - {t}) s{k} + {t} s{n} - {t} (1 - {t}) d{}^2", t.side + 1)
            }
        };
        lines.push((slot.get(), format!("  {slot}  {a:<4} {b:<4}  s' = {formula}\n")));
    }
    lines.sort_unstable();
    text.extend(lines.into_iter().map(|l| l.1));
    for (k, d) in edge_lengths(o).iter().enumerate() {
        let body = if k % 2 == 0 { Body::Base } else { Body::Platform };
        let _ = writeln!(text, "  d{} = {d} ({body})", k + 1);
    }
    let zeros: Vec<String> = pattern.factors().iter().map(|f| Factor::zero(*f)).collect();
    let _ = writeln!(text, "  det A = {}", pattern.determinant_formula());
    let _ = writeln!(
        text,
        "  singular where {}",
        if zeros.is_empty() { "never".into() } else { zeros.join(" or ") }
    );
}
