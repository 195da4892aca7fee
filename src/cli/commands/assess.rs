//! `equipod assess`: by how much a design meets its requirements.

use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::{Answer, number};
use crate::cli::poses;
use crate::design::Design;
use crate::geom::Pose;
use crate::requirements::{AssessOptions, Assessment, Margin, MarginBound, Proof, Standing, Verdict, prove};
use crate::singularity::{Regularity, regular_workspace};

/// Arguments of `assess`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) with home, workspace and hardware
    design: PathBuf,
    /// Points of a Halton sequence in the region of poses, and as many random ones
    #[arg(long, value_name = "N", default_value_t = 5000, value_parser = clap::value_parser!(u32).range(0..=10_000_000))]
    points: u32,
    /// Steps between two poses of a trajectory
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Local searches for the worst pose of each requirement
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = clap::value_parser!(u32).range(0..=1000))]
    searches: u32,
    /// Most cells of the workspace over which the margins of one kind of requirement, and det J, are bounded for a proof
    #[arg(long, value_name = "N", default_value_t = 6000, value_parser = clap::value_parser!(u32).range(0..=100_000_000))]
    cells: u32,
}

/// What was found.
struct Found {
    proof: Proof,
    regularity: Regularity,
    regularity_cells: usize,
}

impl Found {
    /// Proved either way, or `None`.
    fn met(&self) -> Option<bool> {
        match (self.proof.all_met(), is_regular(&self.regularity)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        }
    }
}

fn is_regular(regularity: &Regularity) -> Option<bool> {
    match regularity {
        Regularity::Regular => Some(true),
        Regularity::ChangesSign(_) => Some(false),
        Regularity::Undecided(_) => None,
    }
}

/// Evaluates the requirements.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let home = poses::home(&design);
    let options = AssessOptions {
        points: args.points as usize,
        steps: args.steps as usize,
        searches: args.searches as usize,
        seed: context.seed(),
    };
    let (m, space, cells) = (design.manipulator(), design.workspace.space(&home), args.cells as usize);
    let proof = prove(m, &design.requirements(), &space, &options, cells);
    if proof.bounds.is_empty() {
        let help =
            "add [hardware] with lengths, swing, diameters or greatest forces; see docs/design-files.md";
        return Err(
            Failure::refused("assess::nothing_required", "the design requires nothing").with_help(help)
        );
    }
    let (regularity, regularity_cells) = regular_workspace(m, &space, cells, context.seed());
    let found = Found { proof, regularity, regularity_cells };
    let exit = match found.met() {
        Some(true) => Exit::Yes,
        Some(false) => Exit::No,
        None => Exit::Inconclusive,
    };
    Ok(Answer::new(exit, record(&design, &found), text(&design, &found)))
}

fn margin(design: &Design, m: &Margin, met: Option<bool>, status: &str, below: f64) -> Value {
    json!({
        "requirement": m.term.kind.code(), "margin": number(m.value), "met": met, "at_limit": m.standing == Standing::AtLimit,
        "status": status, "proved_margin": number(below),
        "unit": design.unit_of(m.term.kind.quantity()), "between": design.names_of(m.term), "pose": m.pose.as_ref().map(poses::record),
    })
}

/// Margins that were looked for and not proved, as JSON: `met` says that no violation was found.
pub(super) fn margins(design: &Design, found: &Assessment) -> Value {
    let record = |m: &Margin| {
        let status = if m.standing.is_met() { "searched" } else { "violated" };
        margin(design, m, Some(m.standing.is_met()), status, f64::NEG_INFINITY)
    };
    found.margins.iter().map(record).collect()
}

fn status(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Met => "met",
        Verdict::AtLimit => "at_limit",
        Verdict::Violated => "violated",
        Verdict::Searched => "searched",
    }
}

fn record(design: &Design, found: &Found) -> Map<String, Value> {
    let mut json = Map::new();
    json.insert("met".into(), json!(found.met()));
    let bound = |b: &MarginBound| margin(design, &b.found, b.verdict.is_met(), status(b.verdict), b.below);
    json.insert("margins".into(), found.proof.bounds.iter().map(bound).collect());
    let (status, pose) = match &found.regularity {
        Regularity::Regular => ("proved", None),
        Regularity::ChangesSign(pose) => ("changes_sign", Some(pose)),
        Regularity::Undecided(pose) => ("undecided", Some(pose)),
    };
    json.insert(
        "regular".into(),
        json!({"met": is_regular(&found.regularity), "status": status, "pose": pose.map(poses::record), "cells": found.regularity_cells}),
    );
    json.insert("poses".into(), json!(found.proof.poses));
    json.insert("cells".into(), json!(found.proof.bounds.iter().map(|b| b.cells).sum::<usize>()));
    json
}

fn shown(pose: &Pose) -> String {
    let values = pose.position.iter().copied().chain(pose.quaternion());
    values.map(|x| format!("{x:.4}")).collect::<Vec<_>>().join(",")
}

fn text(design: &Design, found: &Found) -> String {
    let word = match found.met() {
        Some(true) => "meets all its requirements, proved for every pose of its workspace",
        Some(false) => "violates requirements",
        None => "violates no requirement at the poses looked at; not all is proved",
    };
    let mut out = format!("{} {word} ({} poses looked at)\n\n", design.name, found.proof.poses);
    let _ = writeln!(
        out,
        "{:<17} {:<9} {:>14} {:>14} {:<8} {:<24} worst pose x,y,z,qw,qx,qy,qz",
        "requirement", "status", "least margin", "proved margin", "unit", "of"
    );
    for b in &found.proof.bounds {
        let m = &b.found;
        let pose = m.pose.as_ref().map_or_else(|| "any".to_string(), shown);
        let (mark, value) = match m.standing {
            Standing::Met => (' ', m.value),
            Standing::AtLimit => ('=', 0.0),
            Standing::Violated => ('!', m.value),
        };
        let below = match b.below {
            x if b.verdict == Verdict::AtLimit || x == 0.0 => format!("{:.6}", 0.0),
            x if x.is_finite() => format!("{x:.6}"),
            _ => "none".into(),
        };
        let of = design.names_of(m.term).join(", ");
        let _ = writeln!(
            out,
            "{:<17}{mark}{:<9} {value:>14.6} {below:>14} {:<8} {of:<24} {pose}",
            m.term.kind.code(),
            status(b.verdict),
            design.unit_of(m.term.kind.quantity())
        );
    }
    let _ = match &found.regularity {
        Regularity::Regular => writeln!(out, "\nNo singular pose in the workspace: proved."),
        Regularity::ChangesSign(pose) => {
            writeln!(
                out,
                "\nThe workspace holds a singular pose: det J changes its sign on the way to {}.",
                shown(pose)
            )
        }
        Regularity::Undecided(pose) => {
            writeln!(out, "\nNot proved to be free of singular poses; undecided near {}.", shown(pose))
        }
    };
    out.push_str("A margin below 0 is a violation (!); = at the limit, as far as rounding can tell, which is none. The proved margin is one that no pose of the workspace falls below.\n");
    if found.met().is_none() {
        out.push_str(
            "What is only searched may be violated between the poses looked at; more --cells may prove it.\n",
        );
    }
    out
}
