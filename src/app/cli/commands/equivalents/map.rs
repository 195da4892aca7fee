//! `equipod equivalents map`: the affine map between the squared leg lengths of two designs.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::alignment::{FrameArgs, same_units};
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::Answer;
use num::shown::fixed;
use records::{CorrespondenceRecord, MapAnswer, MapRecord};
use synthesis::{LegCorrespondence, Relation};

/// Arguments of `equivalents map`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json) whose squared lengths are given
    from: PathBuf,
    /// Design file whose squared lengths are wanted, in the same units and, without --align, in the same two frames
    to: PathBuf,
    #[command(flatten)]
    frames: FrameArgs,
}

/// Decides whether s(TO) = A s(FROM) + c holds at every pose.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let (from, to) = (context.load(&args.from)?, context.load(&args.to)?);
    same_units(&from, &to, "map::different_units")?;
    let second = args.frames.apply(&from, &to, context)?;
    let outcome = second
        .judged(from.manipulator())
        .map_err(|e| Failure::new(Exit::Inconclusive, "map::breakdown", e.to_string()))?;
    let exit = match (outcome.relation, second.refuted()) {
        (Relation::Equivalent, _) => Exit::Yes,
        (Relation::Unrelated, Some(false)) | (Relation::Undecided, _) => Exit::Inconclusive,
        _ => Exit::No,
    };
    let legs = LegCorrespondence::between(from.manipulator(), &second.manipulator);
    let record =
        MapAnswer { map: (&outcome).into(), correspondence: (&legs).into(), frames: second.record() };
    let mut text = second.text();
    text.push_str(&table(&record.map, &from.name, &to.name));
    text.push_str(&same_legs(&record.correspondence));
    Ok(Answer::new(exit, record, text))
}

fn same_legs(c: &CorrespondenceRecord) -> String {
    let named: Vec<(usize, usize)> =
        c.legs.iter().enumerate().filter_map(|(i, leg)| leg.map(|old| (i + 1, old))).collect();
    let worst = named.iter().map(|(i, _)| c.distances[i - 1].0).fold(0.0, f64::max);
    let nearly = if c.exact { String::new() } else { format!(", up to {worst:.1e} of the size") };
    if c.permutation {
        let order: Vec<String> = named.iter().map(|(_, old)| old.to_string()).collect();
        return format!("the legs of TO are legs {} of FROM{nearly}\n", order.join(", "));
    }
    let list: Vec<String> =
        named.iter().map(|(i, old)| format!("leg {i} of TO is leg {old} of FROM")).collect();
    if list.is_empty() { String::new() } else { format!("{}{nearly}\n", list.join(", ")) }
}

/// A map with its evidence, in words.
pub(super) fn table(r: &MapRecord, from: &str, to: &str) -> String {
    let relation = r.relation.unwrap_or(Relation::Undecided).as_str();
    let mut text = format!("{from} -> {to}: {relation}\n{}\n\n", r.explanation);
    text.push_str("s(TO) = A s(FROM) + c\n        A");
    text.push_str(&" ".repeat(60));
    text.push_str("c            residual\n");
    for (i, row) in r.matrix.iter().enumerate() {
        let _ = write!(text, "leg {}  ", i + 1);
        for x in row {
            let _ = write!(text, "{:>9} ", fixed(x.0, 5));
        }
        let _ = writeln!(text, "{:>14.6}  {:>10.1e}", r.constants[i].0, r.residuals[i].0);
    }
    let _ = writeln!(text, "\ndet A = {}", r.determinant.0);
    if let Some(exact) = &r.det_exact {
        let _ = writeln!(text, "      = {exact} exactly");
    }
    text.push_str(&exact_rows(r));
    text
}

/// Longest number of a row that is written out: the decimals of an optimised offset take a line each.
const WRITTEN: usize = 24;

/// The map in exact numbers, a formula a leg.
fn exact_rows(r: &MapRecord) -> String {
    let (Some(a), Some(c), Some(shares)) = (&r.matrix_exact, &r.constants_exact, &r.singular_shares) else {
        return String::new();
    };
    let mut text = String::from("\nexactly, for the joints as the designs say them:\n");
    if a.iter().flatten().chain(c).any(|x| x.len() > WRITTEN) {
        text.push_str("  numbers too long for a table; --json has them as A_exact and c_exact\n");
        return text;
    }
    for i in 0..6 {
        let terms = (0..6).filter(|k| a[i][*k] != "0").map(|k| match a[i][k].as_str() {
            "1" => format!("s{}", k + 1),
            "-1" => format!("-s{}", k + 1),
            number if number.contains(' ') => format!("({number}) s{}", k + 1),
            number => format!("{number} s{}", k + 1),
        });
        let constant = (c[i] != "0").then(|| c[i].clone());
        let row = terms.chain(constant).collect::<Vec<_>>().join(" + ").replace("+ -", "- ");
        let singular = shares[i].as_ref().filter(|share| share.len() <= WRITTEN);
        let singular =
            singular.map_or_else(String::new, |t| format!("    (det A = 0 with t = {t} in this row)"));
        let _ = writeln!(text, "  s{}' = {row}{singular}", i + 1);
    }
    if let Some(polynomial) = &r.det_of_shares {
        let _ = writeln!(
            text,
            "  with any shares t of these edges det A = {polynomial}: singular where it is zero"
        );
    }
    text
}
