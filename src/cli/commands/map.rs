//! `equipod map`: the affine map between the squared leg lengths of two designs.

use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use crate::cli::alignment::FrameArgs;
use crate::cli::context::Context;
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::output::{Answer, number, relation};
use crate::manipulator::LegIndex;
use crate::synthesis::{LegCorrespondence, LegMapOutcome, LegMapTolerances, Relation, leg_map};

/// Arguments of `map`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design whose squared lengths are given (.toml or .json)
    from: PathBuf,
    /// Design whose squared lengths are wanted, in the same units and, without --align, the same two frames
    to: PathBuf,
    #[command(flatten)]
    frames: FrameArgs,
}

/// Decides whether s(TO) = A s(FROM) + c holds at every pose.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let (from, to) = (context.load(&args.from)?, context.load(&args.to)?);
    if from.units != to.units {
        let message = format!("{} is in {}, {} is in {}", from.name, from.units, to.name, to.units);
        return Err(Failure::refused("map::different_units", message)
            .with_help("write both designs in the same unit: c has the unit squared"));
    }
    let second = args.frames.apply(&from, &to, context.seed())?;
    let outcome = leg_map(from.manipulator(), &second.manipulator, LegMapTolerances::default())
        .map_err(|e| Failure::new(Exit::Inconclusive, "map::breakdown", e.to_string()))?;
    let exit = match (outcome.relation, second.refuted()) {
        (Relation::Equivalent, _) => Exit::Yes,
        (Relation::Unrelated, Some(false)) | (Relation::Undecided, _) => Exit::Inconclusive,
        _ => Exit::No,
    };
    let legs = LegCorrespondence::between(from.manipulator(), &second.manipulator);
    let mut json = record(&outcome);
    json.insert("correspondence".into(), correspondence(&legs));
    second.put(&mut json);
    let mut text = second.text();
    text.push_str(&table(&outcome, &from.name, &to.name));
    text.push_str(&same_legs(&legs));
    Ok(Answer { exit, json, text })
}

/// Which leg of FROM each leg of TO is, from 1.
fn correspondence(c: &LegCorrespondence) -> Value {
    json!({
        "legs": c.legs.map(|leg| leg.map(|i| i.get() + 1)),
        "distances": c.distances.map(number),
        "permutation": c.is_permutation(),
        "exact": c.is_exact(),
    })
}

fn same_legs(c: &LegCorrespondence) -> String {
    let named: Vec<(LegIndex, LegIndex)> =
        LegIndex::all().filter_map(|i| c.legs[i.get()].map(|old| (i, old))).collect();
    let worst = named.iter().map(|(i, _)| c.distances[i.get()]).fold(0.0, f64::max);
    let nearly = if c.is_exact() { String::new() } else { format!(", up to {worst:.1e} of the size") };
    if c.is_permutation() {
        let order: Vec<String> = named.iter().map(|(_, old)| (old.get() + 1).to_string()).collect();
        return format!("the legs of TO are legs {} of FROM{nearly}\n", order.join(", "));
    }
    let list: Vec<String> = named.iter().map(|(i, old)| format!("{i} of TO is {old} of FROM")).collect();
    if list.is_empty() { String::new() } else { format!("{}{nearly}\n", list.join(", ")) }
}

/// One sentence: what was decided and by which number.
pub(super) fn explanation(o: &LegMapOutcome) -> String {
    let t = o.tolerances;
    match o.relation {
        Relation::Unrelated => {
            let legs: Vec<String> = o.legs_off().map(|i| i.to_string()).collect();
            format!(
                "the squared length of {} of TO is no affine function of those of FROM: distance from the span \
                 {:.3e}, tolerance {:.0e}; A and c are the closest fit only",
                legs.join(", "),
                o.residual,
                t.residual
            )
        }
        Relation::Singular if o.leg_rank < 6 => format!(
            "the leg vectors of FROM have rank {}: FROM is architecturally singular and the coefficients of the map \
             are not unique; the shortest ones are given",
            o.leg_rank
        ),
        Relation::Singular => format!(
            "det A = 0: the leg vectors of TO are dependent as the numbers they are, without a tolerance; TO is architecturally singular \
             (smallest singular value of A {:.3e} of the largest)",
            o.inverse_condition
        ),
        Relation::Undecided => format!(
            "neither platform is architecturally singular as the numbers they are, but the smallest singular value of A, {:.3e} of the largest, is not above \
             the {:.1e} that rounding and the residual {:.1e} leave open",
            o.inverse_condition, o.singular_limit, o.residual
        ),
        Relation::Equivalent if o.exact => format!(
            "same poses for corresponding lengths, same singularities: every leg vector of TO is a combination of those of FROM and both are \
             independent, in exact arithmetic; smallest singular value of A {:.3e} of the largest",
            o.inverse_condition
        ),
        Relation::Equivalent => format!(
            "same poses for corresponding lengths, same singularities: residual {:.1e} (tolerance {:.0e}), smallest \
             singular value of A {:.3e} of the largest (limit {:.1e})",
            o.residual, t.residual, o.inverse_condition, o.singular_limit
        ),
    }
}

pub(super) fn record(o: &LegMapOutcome) -> Map<String, Value> {
    let numbers = |x: &mut dyn Iterator<Item = f64>| x.map(number).collect::<Value>();
    let a: Value = (0..6).map(|i| numbers(&mut (0..6).map(|j| o.closest.a[(i, j)]))).collect();
    let mut json = Map::new();
    json.insert("relation".into(), relation(o.relation));
    json.insert("explanation".into(), json!(explanation(o)));
    json.insert("A".into(), a);
    json.insert("c".into(), numbers(&mut o.closest.c.iter().copied()));
    json.insert("det".into(), number(o.determinant));
    json.insert("residual".into(), number(o.residual));
    json.insert("residuals".into(), numbers(&mut o.residuals.into_iter()));
    json.insert("leg_rank".into(), json!(o.leg_rank));
    json.insert("singular_values".into(), numbers(&mut o.singular_values.into_iter()));
    json.insert("inverse_condition".into(), number(o.inverse_condition));
    json.insert(
        "tolerances".into(),
        json!({
            "residual": o.tolerances.residual, "rank": o.tolerances.rank, "inverse_condition": o.singular_limit,
        }),
    );
    json
}

pub(super) fn table(o: &LegMapOutcome, from: &str, to: &str) -> String {
    let mut text = format!("{from} -> {to}: {}\n{}\n\n", o.relation.as_str(), explanation(o));
    text.push_str("s(TO) = A s(FROM) + c\n        A");
    text.push_str(&" ".repeat(60));
    text.push_str("c            residual\n");
    for leg in LegIndex::all() {
        let i = leg.get();
        let _ = write!(text, "{leg}  ");
        for j in 0..6 {
            let shown = (o.closest.a[(i, j)] * 1e5).round() / 1e5 + 0.0; // + 0.0: no "-0.00000"
            let _ = write!(text, "{shown:>9.5} ");
        }
        let _ = writeln!(text, "{:>14.6}  {:>10.1e}", o.closest.c[i], o.residuals[i]);
    }
    let _ = writeln!(text, "\ndet A = {}", o.determinant);
    text
}
