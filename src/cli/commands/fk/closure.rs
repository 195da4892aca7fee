//! The closure polynomial as JSON and as text.

use std::fmt::Write as _;

use serde_json::{Value, json};

use crate::cli::output::number;
use crate::design::Design;
use crate::distance::SingularFactor;
use crate::fk::{Closure, NoClosure};
use crate::poly::RealRoot;
use crate::topology::{Joint, Step};

/// Coefficients are decimal integers as text: they have hundreds of digits.
pub(super) fn json(design: &Design, closure: &Result<Closure, NoClosure>) -> Value {
    let c = match closure {
        Ok(c) => c,
        Err(why) => return json!({ "error": why.to_string() }),
    };
    let p = &c.polynomial;
    let name = |j: Joint| joint(design, j);
    let ends = |list: &[(usize, usize)]| -> Option<Value> {
        list.first().map(|(a, b)| json!([name(Joint::Base(*a)), name(Joint::Platform(*b))]))
    };
    let step = |s: &Step| json!({ "from": s.from.map(name), "place": name(s.place), "rigid": s.rigid });
    let factor = |f: &SingularFactor| json!({ "step": f.step, "degree": f.degree, "removed": f.removed });
    let interval = |r: &RealRoot| {
        let mut r = r.clone();
        r.refine_relative(60);
        let [low, high] = [r.low(), r.high()].map(crate::poly::Dyadic::to_f64);
        // rounded outwards
        if r.is_exact() {
            json!([number(low), number(high)])
        } else {
            json!([number(low.next_down()), number(high.next_up())])
        }
    };
    json!({
        "virtual_leg": ends(&p.sequence.virtual_legs),
        "unknown": p.unknown.map(name),
        "start": p.sequence.start.map(name),
        "sequence": p.sequence.steps.iter().map(step).collect::<Value>(),
        "degree_before": c.degrees.before,
        "degree": p.polynomial.degree(),
        "distinct_roots": p.distinct,
        "factors": c.degrees.factors.iter().map(factor).collect::<Value>(),
        "coefficients": p.polynomial.coefficients().iter().map(ToString::to_string).collect::<Value>(),
        "real_roots": p.real_roots.iter().map(interval).collect::<Value>(),
        "real_root_multiplicities": p.real_roots.iter().map(RealRoot::multiplicity).collect::<Value>(),
        "real_poses_at_roots": c.real_poses,
        "poses_real_proved": c.real_count(),
    })
}

/// Two or three lines.
pub(super) fn text(design: &Design, closure: &Result<Closure, NoClosure>) -> String {
    let c = match closure {
        Ok(c) => c,
        Err(why) => return format!("no closure polynomial: {why}\n"),
    };
    let p = &c.polynomial;
    let [x, y] = p.unknown.map(|j| joint(design, j));
    let degree = p.polynomial.degree().unwrap_or(0);
    let mut out = String::new();
    let _ = writeln!(
        out,
        "closure polynomial in the squared distance of {x} and {y}: degree {} before, {degree} after removal of singular factors, {} distinct roots, {} real",
        c.degrees.before,
        p.distinct,
        p.real_roots.len()
    );
    let _ = match c.real_count() {
        Some(n) => writeln!(out, "real poses: {n}, proved by its real roots"),
        None => writeln!(out, "real poses: not decided by its real roots alone"),
    };
    out
}

fn joint(design: &Design, j: Joint) -> String {
    match j {
        Joint::Base(k) => design.base_names()[k].clone(),
        Joint::Platform(k) => design.platform_names()[k].clone(),
    }
}
