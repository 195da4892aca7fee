//! `equipod check`: whether a design is architecturally singular, and why.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::output::Answer;
use ask::CheckReport;
use records::{CheckAnswer, DependencyRecord, GriffisDuffyRecord, NearestSingularRecord, Number};
use synthesis::singularity::Assembly;

/// Joints of a body lie nearly on a line where they are nearer to it than this share of their distance along it.
const NEARLY: f64 = 0.05;

/// Arguments of `check`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json)
    design: PathBuf,
}

/// Decides and explains.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let found = design.check_with(context.seed()).map_err(|e| Failure::internal(e.to_string()))?;
    let answer = CheckAnswer::from(&found);
    let exit = match answer.architecturally_singular {
        Some(false) if answer.singular_home.is_none() => Exit::Yes,
        Some(_) => Exit::No,
        None => Exit::Inconclusive,
    };
    let text = format!("{}\n{}", headline(&found), text(&answer, m.size(), &design.units));
    Ok(Answer::new(exit, answer, text))
}

/// The verdict with its level; a singular design that may have been meant is named here, with its distance.
fn headline(found: &CheckReport) -> String {
    let name = &found.design.name;
    match (&found.verdict.meant, found.is_singular()) {
        (Some(n), _) => format!("{name}: {}", n.words(&found.design.units)),
        (None, Some(true)) => format!("{name}: architecturally singular"),
        (None, Some(false)) => format!("{name}: regular"),
        (None, None) => format!("{name}: not decided"),
    }
}

fn list(legs: &[usize]) -> String {
    let numbers: Vec<String> = legs.iter().map(ToString::to_string).collect();
    format!("legs {}", numbers.join(", "))
}

/// The answer in words; `size` and `units` are those of the design.
fn text(c: &CheckAnswer, size: f64, units: &str) -> String {
    let mut text = format!("{}\n", c.explanation);
    if let Some(evidence) = c.singular_home.filter(|_| c.architecturally_singular != Some(true)) {
        let _ = writeln!(text, "THE HOME POSE IS SINGULAR: {evidence}");
    }
    let _ = writeln!(text, "joints: {}", c.joints.explanation);
    let _ = writeln!(text, "\nrank of the leg vectors     {}", c.leg_rank);
    let _ = writeln!(text, "generic rank of the lines   {}", c.jacobian_rank);
    let _ = writeln!(text, "proof: {}", c.proof_explanation);
    for f in c.cases.iter().skip(1) {
        let _ = writeln!(text, "also: {} ({})", f.explanation, list(&f.legs));
    }
    for d in &c.dependencies {
        dependency(&mut text, d);
    }
    if let Some(g) = &c.griffis_duffy {
        griffis_duffy(&mut text, g);
    }
    if let Some(n) = &c.nearest_singular {
        nearest(&mut text, n, size, units);
    }
    // a body whose joints lie nearly on a line turns nearly freely about it
    for l in c.best_lines.iter().filter(|l| l.distance.0 <= NEARLY * l.reach.0) {
        let (off, [x, y, z], [a, b, c]) = (l.distance.0, l.point.map(|x| x.0), l.direction.map(|x| x.0));
        let _ = writeln!(
            text,
            "the joints of the {} lie within {off:.3e} {units} of a line, through ({x:.4}, {y:.4}, {z:.4}) along ({a:.4}, {b:.4}, {c:.4})",
            l.body
        );
    }
    pose_count(&mut text, c);
    let f = &c.jacobian_inverse_condition;
    let values: Vec<String> = c.singular_values.iter().map(|x| format!("{:.3e}", x.0)).collect();
    let _ = writeln!(text, "\nsingular values of the normalised leg vectors: {}", values.join(", "));
    let _ = writeln!(
        text,
        "inverse condition number of the Jacobian at {} random poses: best {:.3e}, median {:.3e}, worst {:.3e}",
        f.poses, f.best.0, f.median.0, f.worst.0
    );
    text
}

fn pose_count(text: &mut String, answer: &CheckAnswer) {
    let (c, bound) = (&answer.pose_count, &answer.pose_bound);
    let error = c.error_probability.map(|p| {
        format!("counted modulo {} random primes, wrong with probability {p:.1e} at most", c.primes.len())
    });
    let error = error.unwrap_or_default();
    let _ = match (c.finite, c.dimension) {
        (Some(n), _) => {
            writeln!(text, "\nfinite poses, real and complex, for generic leg lengths: {n} ({error})")
        }
        (None, Some(d)) => {
            writeln!(text, "\nfor generic leg lengths the poses form a set of dimension {d} ({error})")
        }
        (None, None) => writeln!(text, "\nthe finite poses for generic leg lengths are not counted"),
    };
    if let Some(degrees) = &c.by_degree {
        let degrees: Vec<String> = degrees.iter().map(ToString::to_string).collect();
        let _ = writeln!(text, "  by degree {}", degrees.join(" + "));
    }
    if let Some(p) = &answer.common_points {
        let number = |n: Option<usize>| n.map_or("not counted".into(), |n| n.to_string());
        let _ = writeln!(
            text,
            "  common points of six legs: {} finite, with e.e = 0 {}, at infinity {}",
            p.finite,
            number(p.isotropic),
            number(p.at_infinity)
        );
    }
    let _ = writeln!(text, "  proved for all lengths: {}", bound.theorem);
}

fn sum(coefficients: &[Number; 6], letter: char) -> String {
    let mut text = String::new();
    for (i, c) in coefficients.iter().map(|c| c.0).enumerate().filter(|(_, c)| *c != 0.0) {
        let sign = match (c < 0.0, text.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let size = c.abs();
        let factor = if size.total_cmp(&1.0).is_eq() { String::new() } else { format!("{size} ") };
        let _ = write!(text, "{sign}{factor}{letter}{}", i + 1);
    }
    text
}

fn dependency(text: &mut String, d: &DependencyRecord) {
    let _ = writeln!(text, "\ndependency of {}: {} = 0", list(&d.legs), sum(&d.coefficients, 'v'));
    let _ = writeln!(
        text,
        "  base ends span dimension {}, platform ends {}",
        d.base_dimension, d.platform_dimension
    );
    let _ =
        writeln!(text, "  squared lengths of every pose: {} = {}", sum(&d.coefficients, 's'), d.constant.0);
    if let Some(defect) = d.lengths_defect {
        let _ = writeln!(text, "  the lengths of the design miss it by {:.1e} (relative)", defect.0);
    }
}

fn griffis_duffy(text: &mut String, g: &GriffisDuffyRecord) {
    let t: Vec<String> = g.t.iter().map(|t| format!("{:.6}", t.0)).collect();
    let _ = writeln!(text, "\nGriffis-Duffy type, going round by {}: t = {}", list(&g.order), t.join(", "));
    let exactly = if g.exactly_singular { " (zero exactly)" } else { "" };
    let _ = writeln!(
        text,
        "  det A = prod (1 - t) - prod t = {:.6e}{exactly}; singular where it is zero",
        g.det.0
    );
    let _ = writeln!(
        text,
        "  joints off their sides by at most {:.1e} (recognised up to {:.1e})",
        g.deviation.0, g.deviation_limit.0
    );
    let lengths = match &g.assembly {
        None => return,
        Some(Assembly::Incompatible { defect }) => {
            format!("cannot be assembled: they miss the condition by {defect:.1e} (relative)")
        }
        Some(Assembly::NoRealPose {}) => {
            "satisfy the condition, but have no real pose: the triangles of the legs do not close".into()
        }
        Some(Assembly::Undecided { .. }) => "satisfy the condition; no real pose was found".into(),
        Some(Assembly::Real { residual, .. }) => {
            format!("can be assembled, and the platform moves: real pose found, residual {residual:.1e}")
        }
    };
    let _ = writeln!(text, "  the lengths of the design {lengths}");
}

fn nearest(text: &mut String, n: &NearestSingularRecord, size: f64, units: &str) {
    let _ = writeln!(
        text,
        "\nnearest singular design found ({}, {}): {:.6e} away, {:.1e} of the size (norm of the change of all joints)",
        n.kind,
        list(&n.legs),
        n.distance.0,
        n.distance.0 / size
    );
    let _ = writeln!(text, "  none is nearer than {:.6e} (lengths in {units})", n.distance_at_least.0);
}
