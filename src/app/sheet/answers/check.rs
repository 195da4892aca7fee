//! Whether a design is architecturally singular, why, and how many poses given lengths have.

use std::fmt::Write as _;

use super::poses::full_sentence;
use crate::figure::{figure, length};
use crate::{Sheet, Table};
use records::{
    CheckAnswer, DependencyRecord, GriffisDuffyRecord, NearestSingularRecord, Number, legs_in_words,
};
use synthesis::singularity::Assembly;

/// The ratio of distance from a line to distance along it, below which joints of a body count as nearly on the line.
const NEARLY: f64 = 0.05;

/// The answer of `check`; with the algebra behind it, if requested.
#[must_use]
pub fn check(c: &CheckAnswer, with_details: bool) -> Sheet {
    let mut out = Sheet::new();
    out.line(&c.headline);
    if let Some(evidence) = c.singular_home.filter(|_| c.architecturally_singular != Some(true)) {
        say!(out, "THE HOME POSE IS SINGULAR: {evidence}");
    }
    // a regular design needs no more words than its headline
    let said = c.architecturally_singular != Some(false);
    match c.level.filter(|level| level.is_proved()) {
        Some(level) if said => say!(out, "Proved {}: {}.", level.words(), c.explanation),
        Some(level) => say!(out, "Proved {}.", level.words()),
        None => out.line(full_sentence(&c.explanation)),
    }
    generic_poses(&mut out, c);
    if let Some(n) = &c.nearest_singular {
        nearest(&mut out, n, c);
    }
    if let Some(lengths) = c.griffis_duffy.as_ref().and_then(lengths_in_words) {
        say!(out, "The lengths of the design {lengths}.");
    }
    // a body whose joints lie nearly on a line turns nearly freely about it
    for l in c.best_lines.iter().filter(|l| l.distance.0 <= NEARLY * l.reach.0) {
        let [point, direction] = [l.point, l.direction].map(|v| v.map(|x| figure(x.0)).join(", "));
        let off = length(l.distance.0, &c.units);
        say!(
            out,
            "The joints of the {} lie within {off} of a line through ({point}) along ({direction}).",
            l.body
        );
    }
    let f = &c.jacobian_inverse_condition;
    say!(
        out,
        "Conditioning at {} random poses: best {}, median {}, worst {} (1 at best, 0 at a singular pose).",
        f.poses,
        figure(f.best),
        figure(f.median),
        figure(f.worst)
    );
    if with_details {
        out.space();
        out.part("Details", false, details(c));
    } else {
        out.line("The algebra behind this answer: --details");
    }
    out
}

/// The number of poses for given lengths, and the number of those of a general platform that lie at infinity.
fn generic_poses(out: &mut Sheet, answer: &CheckAnswer) {
    let (c, bound) = (&answer.pose_count, answer.pose_bound.poses);
    match (c.finite, c.dimension) {
        (Some(0), _) if answer.architecturally_singular == Some(true) => {
            out.line(
                "Generic leg lengths have no pose. At almost every pose the platform moves with locked legs.",
            );
        }
        (Some(n), _) => {
            let lost = answer.common_points.and_then(|p| Some(p.isotropic? + p.at_infinity?));
            let lost = lost.filter(|n| *n > 0);
            let lost = lost.map_or_else(String::new, |lost| format!("; {lost} more are at infinity"));
            let how = if c.primes.is_empty() { "counted" } else { "counted modulo random primes" };
            say!(out, "Generic leg lengths have {n} poses, real and complex, {how}{lost}.");
        }
        (None, Some(d)) => {
            say!(
                out,
                "The platform can move at constant leg lengths: its poses form a set of dimension {d}."
            );
        }
        (None, None) => say!(
            out,
            "Generic leg lengths have at most {bound} poses, real and complex; they were not counted."
        ),
    }
    if answer.solvability.quadratic || !answer.solvability.placed_first.is_empty() {
        say!(out, "Order of solution: {}.", answer.solvability.sentence());
    }
}

/// Ranks, dependencies, fields and counts.
fn details(c: &CheckAnswer) -> Sheet {
    let mut out = Sheet::new();
    say!(out, "joints: {}", c.joints.explanation);
    let ranks = [("rank of the leg vectors", c.leg_rank), ("generic rank of the lines", c.jacobian_rank)];
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
    pose_count(&mut out, c);
    let values: Vec<String> = c.singular_values.iter().map(|x| figure(x.0)).collect();
    say!(out, "\nsingular values of the normalised leg vectors: {}", values.join(", "));
    out
}

fn pose_count(out: &mut Sheet, answer: &CheckAnswer) {
    let c = &answer.pose_count;
    out.space();
    if let Some(p) = c.error_probability {
        let primes = c.primes.len();
        say!(
            out,
            "poses counted modulo {primes} random primes, wrong with probability {} at most",
            figure(p)
        );
    }
    if let Some(degrees) = c.by_degree.as_ref().filter(|degrees| !degrees.is_empty()) {
        let degrees: Vec<String> = degrees.iter().map(ToString::to_string).collect();
        say!(out, "  by degree {}", degrees.join(" + "));
    }
    if let Some(p) = &answer.common_points {
        let number = |n: Option<usize>| n.map_or("not counted".into(), |n| n.to_string());
        say!(
            out,
            "  common points of six legs: {} finite, {} with e.e = 0, {} at infinity",
            p.finite,
            number(p.isotropic),
            number(p.at_infinity)
        );
    }
    say!(out, "  proved for all lengths: {}", answer.pose_bound.theorem);
    say!(out, "  order of solution: {}", answer.solvability.sentence());
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
        let factor = if size.total_cmp(&1.0).is_eq() { String::new() } else { format!("{} ", figure(size)) };
        let _ = write!(text, "{sign}{factor}{letter}{}", i + 1);
    }
    text
}

fn dependency(out: &mut Sheet, d: &DependencyRecord) {
    say!(out, "\ndependency of {}: {} = 0", legs_in_words(&d.legs), sum(&d.coefficients, 'v'));
    say!(out, "  base joints span dimension {}, platform joints {}", d.base_dimension, d.platform_dimension);
    say!(out, "  squared lengths of every pose: {} = {}", sum(&d.coefficients, 's'), figure(d.constant.0));
    if let Some(defect) = d.lengths_defect {
        say!(out, "  relative deviation of the design's own lengths: {}", figure(defect.0));
    }
}

fn griffis_duffy(out: &mut Sheet, g: &GriffisDuffyRecord) {
    let t: Vec<String> = g.t.iter().map(|t| figure(t.0)).collect();
    say!(
        out,
        "\nGriffis-Duffy type, in the cyclic order of {}: t = {}",
        legs_in_words(&g.order),
        t.join(", ")
    );
    let det = if g.exactly_singular { "0 exactly".into() } else { figure(g.det.0) };
    say!(out, "  det A = prod (1 - t) - prod t = {det}; the design is singular if it is zero");
    let [off, limit] = [g.deviation.0, g.deviation_limit.0].map(figure);
    say!(out, "  distance of the joints from their sides: at most {off} of the size (limit {limit})");
}

/// Whether the lengths of the design fit, after `the lengths of the design`; `None` where it has none.
fn lengths_in_words(g: &GriffisDuffyRecord) -> Option<String> {
    Some(match g.assembly.as_ref()? {
        Assembly::Incompatible { defect } => {
            format!("cannot be assembled: their relative deviation from the condition is {}", figure(*defect))
        }
        Assembly::NoRealPose {} => {
            "satisfy the condition, but have no real pose: the triangles of the legs do not close".into()
        }
        Assembly::Undecided { .. } => "satisfy the condition; no real pose was found".into(),
        Assembly::Real { .. } => {
            "can be assembled, and at almost every pose the platform moves with locked legs".into()
        }
    })
}

fn nearest(out: &mut Sheet, n: &NearestSingularRecord, c: &CheckAnswer) {
    let (kind, legs) = (n.kind.replace('_', " "), legs_in_words(&n.legs));
    if n.distance.0 <= 0.0 {
        say!(out, "The joints rounded to doubles are a singular design ({kind}, {legs}).");
        return;
    }
    say!(
        out,
        "Nearest singular design found: {} away, {} % of the size ({kind}, {legs}); none is nearer than {}.",
        length(n.distance.0, &c.units),
        figure(100.0 * n.distance.0 / c.size.0),
        length(n.distance_at_least.0, &c.units)
    );
}
