//! det J over a family of poses, as a polynomial.

use crate::Sheet;
use crate::figure::figure;
use num::shown::significant;
use records::{CoefficientsWord, Number, PolynomialRecord, PoseFamilyWord, SingularLocusAnswer};

/// The greatest length of a polynomial written with its exact coefficients, characters.
const EXACT_LENGTH: usize = 400;

/// The answer of `singular locus`.
#[must_use]
pub fn singular_locus(r: &SingularLocusAnswer) -> Sheet {
    let mut out = Sheet::new();
    let position = r.position.join(", ");
    let rotation = match r.quaternion.join(", ") {
        none if none == "1, 0, 0, 0" => "without rotation".to_owned(),
        quaternion => format!("with the rotation of the quaternion ({quaternion})"),
    };
    let direction = r.direction.as_ref().map(|d| d.join(", ")).unwrap_or_default();
    let p = &r.polynomial;
    let family = match r.family {
        PoseFamilyWord::Positions => format!("at the positions (x, y, z) {rotation}"),
        PoseFamilyWord::Line => {
            format!("on the line ({position}) + u ({direction}) {rotation}")
        }
        PoseFamilyWord::Rotation => format!(
            "at the position ({position}) {rotation}, then rotated by the quaternions (1, u ({direction}))"
        ),
    };
    say!(out, "{}: det J {family}", r.name);
    let Some(degree) = p.degree else {
        out.line("is zero at all of them: every one of these poses is singular, proved.");
        return out;
    };
    let removed: Vec<String> = p.removed.iter().map(|f| format!("({})^{}", f.factor, f.times)).collect();
    let after = match removed.as_slice() {
        [] => String::new(),
        list => format!(" after removal of {} from degree {}", list.join(" "), p.degree_before),
    };
    let known = match p.coefficients_known {
        CoefficientsWord::Integers => "integer coefficients",
        CoefficientsWord::Expressions => "exact coefficients",
        CoefficientsWord::Enclosed => "coefficients between bounds",
    };
    say!(out, "is a multiple of this polynomial of degree {degree}{after}, with {known}:");
    say!(out, "  {}", polynomial(p));
    roots(&mut out, r);
    out
}

fn roots(out: &mut Sheet, r: &SingularLocusAnswer) {
    let p = &r.polynomial;
    let Some(count) = p.real_roots_by_sturm else { return };
    say!(out, "Real roots, counted by Sturm's theorem: {count}");
    for ([low, high], times) in p.real_roots.iter().zip(&p.real_root_multiplicities) {
        let u = 0.5 * (low.0 + high.0);
        let angle = r.axis_squared.map_or_else(String::new, |square| {
            format!(", a rotation by {} deg", figure(2.0 * (u * square.0.sqrt()).atan().to_degrees()))
        });
        let often = if *times > 1 { format!(", {times} times") } else { String::new() };
        say!(out, "  u = {}{angle}{often}", figure(u));
    }
}

/// The terms with exact coefficients; long integers are divided by the largest one and rounded.
fn polynomial(p: &PolynomialRecord) -> String {
    let exact = joined(p, |k| p.coefficients.get(k).cloned().unwrap_or_default());
    if p.coefficient_bounds.is_none() && exact.len() <= EXACT_LENGTH {
        return exact;
    }
    let middle = |[low, high]: &[Number; 2]| 0.5 * (low.0 + high.0);
    let values: Vec<f64> = match &p.coefficient_bounds {
        Some(list) => list.iter().map(middle).collect(),
        None => p.coefficients.iter().filter_map(|c| c.parse().ok()).collect(),
    };
    let largest = values.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if values.len() < p.exponents.len() || !largest.is_finite() {
        return exact;
    }
    joined(p, |k| significant(values[k] / largest))
}

/// The terms of highest degree first.
fn joined(p: &PolynomialRecord, coefficient: impl Fn(usize) -> String) -> String {
    let mut order: Vec<usize> = (0..p.exponents.len()).collect();
    order
        .sort_by_key(|k| std::cmp::Reverse((p.exponents[*k].iter().sum::<usize>(), p.exponents[*k].clone())));
    let mut text = String::new();
    for k in order {
        let number = coefficient(k);
        let sum = number.contains(' ');
        let (sign, size) = match number.strip_prefix('-') {
            Some(size) if !sum => ('-', size.to_owned()),
            _ if sum => ('+', format!("({number})")),
            _ => ('+', number),
        };
        if size == "0" {
            continue;
        }
        let power = |(x, n): (&String, &usize)| match n {
            0 => None,
            1 => Some(x.clone()),
            n => Some(format!("{x}^{n}")),
        };
        let mut factors: Vec<String> = p.unknowns.iter().zip(&p.exponents[k]).filter_map(power).collect();
        if size != "1" || factors.is_empty() {
            factors.insert(0, size);
        }
        let before = match (text.is_empty(), sign) {
            (true, '-') => "-",
            (true, _) => "",
            (false, '-') => " - ",
            (false, _) => " + ",
        };
        text.push_str(before);
        text.push_str(&factors.join(" "));
    }
    text
}
