//! `equipod plot pareto`.

use std::path::PathBuf;

use serde_json::Value;

use crate::app::cli::{Failure, files};
use ::files::plot::{FrontAxis, FrontFigure, pareto_front};
use machine::requirements::Objective;

/// Arguments of `plot pareto`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotFrontArgs {
    /// Answer of `optimize --json` with `mode = "pareto"`
    front: PathBuf,
}

fn refused(args: &PlotFrontArgs, message: &str) -> Failure {
    Failure::refused("plot::not_a_front", format!("{}: {message}", args.front.display()))
        .with_help("give the output of `equipod optimize DESIGN --json` for a design with mode = \"pareto\"")
}

pub(super) fn draw(args: &PlotFrontArgs) -> Result<String, Failure> {
    let text = files::read_text(&args.front)?;
    let document: Value = serde_json::from_str(&text)
        .map_err(|e| refused(args, &format!("the file is not a JSON document: {e}")))?;
    let members = document.get("front").and_then(Value::as_array);
    let members = members.ok_or_else(|| refused(args, "the document has no list `front`"))?;
    let first = members.first().ok_or_else(|| refused(args, "the front has no members"))?;
    let axes = objectives(first).iter().map(axis).collect::<Option<Vec<FrontAxis>>>();
    let axes = axes.filter(|a| (2..=3).contains(&a.len()));
    let axes = axes.ok_or_else(|| refused(args, "the members do not have two or three objectives"))?;
    let values = |member: &Value| {
        let all: Option<Vec<f64>> = objectives(member).iter().map(|o| o.get("value")?.as_f64()).collect();
        all.filter(|v| v.len() == axes.len())
    };
    let values = members.iter().map(values).collect::<Option<Vec<_>>>();
    let members = values.ok_or_else(|| refused(args, "a member has no values"))?;
    let name = first.get("design").and_then(|d| d.get("name")).and_then(Value::as_str);
    let seed = document
        .pointer("/provenance/seed")
        .and_then(Value::as_u64)
        .map_or(String::new(), |s| format!(", seed {s}"));
    Ok(pareto_front(&FrontFigure {
        title: name.map_or("Front".into(), |n| format!("Front of \u{201c}{n}\u{201d}")),
        note: format!(
            "{} members, numbered as in the result; none is better in every objective{seed}",
            members.len()
        ),
        axes,
        members,
    }))
}

fn objectives(member: &Value) -> &[Value] {
    member.get("objectives").and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

fn axis(objective: &Value) -> Option<FrontAxis> {
    let name = objective.get("name")?.as_str()?;
    let unit = objective.get("unit").and_then(Value::as_str).filter(|u| !u.is_empty());
    let words = name.replace('_', " ");
    Some(FrontAxis {
        label: unit.map_or_else(|| words.clone(), |u| format!("{words} [{u}]")),
        is_gain: !Objective::ALL.iter().find(|o| o.code() == name)?.is_cost(),
    })
}
