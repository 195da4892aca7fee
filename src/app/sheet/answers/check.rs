//! Whether a design is architecturally singular, and why.

use std::fmt::Write as _;

use crate::{Sheet, Table};
use records::{
    CheckAnswer, DependencyRecord, GriffisDuffyRecord, NearestSingularRecord, Number, legs_in_words,
};
use synthesis::singularity::Assembly;

/// The ratio of distance from a line to distance along it, below which joints of a body count as nearly on the line.
const NEARLY: f64 = 0.05;

/// The answer of `check` below its headline; `size` and `units` are those of the design.
#[must_use]
pub fn check(c: &CheckAnswer, headline: &str, size: f64, units: &str) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "{headline}\n{}", c.explanation);
    if let Some(evidence) = c.singular_home.filter(|_| c.architecturally_singular != Some(true)) {
        say!(out, "THE HOME POSE IS SINGULAR: {}", evidence);
    }
    say!(out, "joints: {}", c.joints.explanation);
    let ranks = [("rank of the leg vectors", c.leg_rank), ("generic rank of the lines", c.jacobian_rank)];
    out.space();
    out.table(Table::facts(27, ranks.map(|(name, rank)| (name, rank.to_string()))));
    say!(out, "proof: {}", c.proof_explanation);
    for f in c.cases.iter().skip(1) {
        say!(out, "also: {} ({})", f.explanation, legs_in_words(&f.legs));
    }
    for d in &c.dependencies {
        dependency(&mut out, d);
    }
    if let Some(g) = &c.griffis_duffy {
        griffis_duffy(&mut out, g);
    }
    if let Some(n) = &c.nearest_singular {
        nearest(&mut out, n, size, units);
    }
    // a body with its joints nearly on a line rotates almost freely about it
    for l in c.best_lines.iter().filter(|l| l.distance.0 <= NEARLY * l.reach.0) {
        let (off, [x, y, z], [a, b, c]) = (l.distance.0, l.point.map(|x| x.0), l.direction.map(|x| x.0));
        say!(
            out,
            "the joints of the {} lie within {off:.3e} {units} of a line, through ({x:.4}, {y:.4}, {z:.4}) along ({a:.4}, {b:.4}, {c:.4})",
            l.body
        );
    }
    pose_count(&mut out, c);
    let f = &c.jacobian_inverse_condition;
    let values: Vec<String> = c.singular_values.iter().map(|x| format!("{:.3e}", x.0)).collect();
    say!(out, "\nsingular values of the normalised leg vectors: {}", values.join(", "));
    say!(
        out,
        "inverse condition number of the Jacobian at {} random poses: best {:.3e}, median {:.3e}, worst {:.3e}",
        f.poses,
        f.best,
        f.median,
        f.worst
    );
    out
}

fn pose_count(out: &mut Sheet, answer: &CheckAnswer) {
    let (c, bound) = (&answer.pose_count, &answer.pose_bound);
    let error = c.error_probability.map(|p| {
        format!("counted modulo {} random primes, wrong with probability {p:.1e} at most", c.primes.len())
    });
    let error = error.unwrap_or_default();
    match (c.finite, c.dimension) {
        (Some(n), _) => {
            say!(out, "\nfinite poses, real and complex, for generic leg lengths: {n} ({error})");
        }
        (None, Some(d)) => {
            say!(out, "\nfor generic leg lengths the poses form a set of dimension {d} ({error})");
        }
        (None, None) => out.line("\nthe finite poses for generic leg lengths are not counted"),
    }
    if let Some(degrees) = &c.by_degree {
        let degrees: Vec<String> = degrees.iter().map(ToString::to_string).collect();
        say!(out, "  by degree {}", degrees.join(" + "));
    }
    if let Some(p) = &answer.common_points {
        let number = |n: Option<usize>| n.map_or("not counted".into(), |n| n.to_string());
        say!(
            out,
            "  common points of six legs: {} finite, with e.e = 0 {}, at infinity {}",
            p.finite,
            number(p.isotropic),
            number(p.at_infinity)
        );
    }
    say!(out, "  proved for all lengths: {}", bound.theorem);
    say!(out, "  in steps: {}", answer.solvability.sentence());
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

fn dependency(out: &mut Sheet, d: &DependencyRecord) {
    say!(out, "\ndependency of {}: {} = 0", legs_in_words(&d.legs), sum(&d.coefficients, 'v'));
    say!(out, "  base ends span dimension {}, platform ends {}", d.base_dimension, d.platform_dimension);
    say!(out, "  squared lengths of every pose: {} = {}", sum(&d.coefficients, 's'), d.constant.0);
    if let Some(defect) = d.lengths_defect {
        say!(out, "  the lengths of the design miss it by {:.1e} (relative)", defect.0);
    }
}

fn griffis_duffy(out: &mut Sheet, g: &GriffisDuffyRecord) {
    let t: Vec<String> = g.t.iter().map(|t| format!("{:.6}", t.0)).collect();
    say!(out, "\nGriffis-Duffy type, going round by {}: t = {}", legs_in_words(&g.order), t.join(", "));
    let exactly = if g.exactly_singular { " (zero exactly)" } else { "" };
    say!(out, "  det A = prod (1 - t) - prod t = {:.6e}{exactly}; singular where it is zero", g.det.0);
    say!(
        out,
        "  joints off their sides by at most {:.1e} (recognised up to {:.1e})",
        g.deviation.0,
        g.deviation_limit.0
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
    say!(out, "  the lengths of the design {lengths}");
}

fn nearest(out: &mut Sheet, n: &NearestSingularRecord, size: f64, units: &str) {
    say!(
        out,
        "\nnearest singular design found ({}, {}): {:.6e} away, {:.1e} of the size (norm of the change of all joints)",
        n.kind,
        legs_in_words(&n.legs),
        n.distance.0,
        n.distance.0 / size
    );
    say!(out, "  none is nearer than {:.6e} (lengths in {units})", n.distance_at_least.0);
}
