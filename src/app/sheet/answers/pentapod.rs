//! The line that five legs hold.

use std::fmt::Write as _;

use crate::Sheet;
use crate::figure::figure;
use fk::LineClass;
use records::{LineTermRecord, PentapodAnswer, legs_in_words};
use synthesis::DecouplingLeg;

/// The greatest number of terms of a polynomial written out.
const TERMS: usize = 12;

/// The answer of `check` and of `fk` about a design of five legs; `units` are those of the design.
#[must_use]
pub fn pentapod(answer: &PentapodAnswer, units: &str) -> Sheet {
    let mut out = Sheet::new();
    match (&answer.line, answer.architecturally_singular) {
        (Some(line), Some(true)) => say!(
            out,
            "{}: architecturally singular, the five legs hold no line of the {} at any pose",
            answer.name,
            line.body
        ),
        (Some(line), _) => say!(
            out,
            "{}: five legs hold a line of the {}, about which it rotates freely",
            answer.name,
            line.body
        ),
        (None, Some(_)) => say!(
            out,
            "{}: five independent legs leave one freedom. The joints of neither body lie on a line, so the poses for given lengths form a curve",
            answer.name
        ),
        (None, None) => {
            say!(out, "{}: undecided, the five legs are dependent at all poses tried", answer.name);
        }
    }
    if answer.rounded_joints {
        out.line("Joints that are no fractions are rounded to doubles.");
    }
    if let Some(line) = &answer.line {
        say!(
            out,
            "Joints on the line, as multiples of {} {units}: {}",
            figure(line.length.0),
            line.marks.map(|x| figure(x.0)).join(", ")
        );
        if let Some(class) = line.class {
            say!(out, "Equation of the line: {}", equation(class));
        }
        if let Some(n) = line.generic_poses {
            say!(out, "Poses of the line, real and complex, for generic leg lengths: {n}");
        }
        let locus = &line.singular_poses;
        if answer.architecturally_singular == Some(false) {
            say!(
                out,
                "Singular poses of the line: F(p, v) = 0 of degree {}, with degree {} in the position p and {} in the direction v ({})",
                locus.degree,
                locus.degree_in_position,
                locus.degree_in_direction,
                locus.family
            );
            if locus.terms.len() <= TERMS {
                say!(out, "  F = {}", polynomial(&locus.terms));
            } else {
                say!(out, "  F has {} terms; --json lists them", locus.terms.len());
            }
        }
    }
    sixth_legs(&mut out, &answer.sixth_legs);
    poses(&mut out, answer, units);
    out
}

fn equation(class: LineClass) -> &'static str {
    match class {
        LineClass::Quadratic => "quadratic, with two mirror poses for each root (line-plane)",
        LineClass::Cubic => "cubic, with two mirror poses for each root (line-plane)",
        LineClass::Quartic => "quartic, with two mirror poses for each root (line-plane)",
        _ => "degree 8, because the other joints do not lie in a plane",
    }
}

fn polynomial(terms: &[LineTermRecord]) -> String {
    let names = ["px", "py", "pz", "vx", "vy", "vz"];
    let mut text = String::new();
    for term in terms {
        let (sign, size) = match term.coefficient.strip_prefix('-') {
            Some(size) => ("-", size),
            None => ("+", term.coefficient.as_str()),
        };
        match (text.is_empty(), sign) {
            (true, "+") => {}
            (true, _) => text.push('-'),
            _ => {
                let _ = write!(text, " {sign} ");
            }
        }
        let factors = names.iter().zip(term.exponents).filter(|(_, e)| *e > 0).map(|(name, e)| match e {
            1 => (*name).to_owned(),
            _ => format!("{name}^{e}"),
        });
        let coefficient = Some(size.to_owned()).filter(|c| c != "1");
        let product: Vec<String> = coefficient.into_iter().chain(factors).collect();
        text.push_str(if product.is_empty() { "1" } else { "" });
        text.push_str(&product.join(" "));
    }
    text
}

fn sixth_legs(out: &mut Sheet, legs: &[DecouplingLeg]) {
    if legs.is_empty() {
        out.line("No sixth leg decouples the platform by a line or a joint alone.");
    }
    for leg in legs {
        match leg {
            DecouplingLeg::OffTheLine { body } => say!(
                out,
                "A sixth leg to a point of the {body} off the line fixes the rotation about the line: two angles for each pose of the line."
            ),
            DecouplingLeg::ToTheLine { body, legs } => say!(
                out,
                "With a sixth leg to the line of {} on the {body}, five legs hold that line.",
                legs_in_words(legs)
            ),
            DecouplingLeg::ToTheJoint { body, legs } => say!(
                out,
                "A sixth leg to the joint of {} on the {body} fixes its position by three distances.",
                legs_in_words(legs)
            ),
            _ => {}
        }
    }
}

fn poses(out: &mut Sheet, answer: &PentapodAnswer, units: &str) {
    if let Some(why) = &answer.no_poses {
        say!(out, "No poses: {why}");
    }
    let Some(found) = &answer.poses else { return };
    say!(out, "\nPoses of the line for these lengths: {}, {} of them real.", found.counted, found.real);
    out.line("They are counted and enclosed in exact arithmetic; the rotation about the line is free.");
    for pose in found.poses.iter().filter(|pose| pose.real) {
        let twice = if pose.multiplicity > 1 {
            format!("  counts {} times", pose.multiplicity)
        } else {
            String::new()
        };
        say!(
            out,
            "  joint of leg 1 at ({}) {units}  direction ({}){twice}",
            pose.position.re.map(|x| figure(x.0)).join(", "),
            pose.direction.re.map(|x| figure(x.0)).join(", ")
        );
    }
}
