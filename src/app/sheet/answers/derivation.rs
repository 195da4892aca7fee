//! The derivation of an equivalent platform, step by step.

use super::map::{WRITTEN, combination};
use crate::{Cell, Sheet, Table, left, right};
use num::shown::significant;
use records::{DerivationRecord, ExactNumberRecord, LegSlideRecord};

/// The steps from coplanar joints to A, c and det A, and the check by forward kinematics.
#[must_use]
pub fn derivation(d: &DerivationRecord, from: &str, to: &str) -> Sheet {
    let mut out = derivation_steps(d);
    out.line("\n4. Check: leg map and forward kinematics of both platforms, solved independently");
    out.add(super::verify(&d.verification, from, to));
    out
}

/// The steps alone.
#[must_use]
pub fn derivation_steps(d: &DerivationRecord) -> Sheet {
    let mut out = Sheet::new();
    let numbers = if d.exact { "exact numbers" } else { "the joints as doubles" };
    say!(out, "\nDerivation with {numbers}\n");
    out.line("1. Four joints in one plane at every pose: their Cayley-Menger determinant D vanishes.");
    out.line(
        "   One row of A and c for each moved leg (Rojas, Borras, Thomas 2010, eq. 7); the other legs keep their lengths.",
    );
    for step in &d.moves {
        coplanar(&mut out, step);
    }
    one_at_a_time(&mut out, d);
    out.line("\n3. det A");
    determinant(&mut out, d);
    out
}

/// The number as an expression, in parentheses if it has several terms; as a decimal if it is long or inexact.
fn text(x: &ExactNumberRecord) -> String {
    match &x.exact {
        Some(exact) if exact.len() > WRITTEN => significant(x.value.0),
        Some(exact) if exact.contains(' ') => format!("({exact})"),
        Some(exact) => exact.clone(),
        None => significant(x.value.0),
    }
}

/// `(1 - t) s_X + t s_Y - t (1 - t) d^2`.
fn row(step: &LegSlideRecord) -> String {
    let [x, y] = step.between.map(|leg| format!("s{leg}"));
    combination([(text(&step.rest), x), (text(&step.offset), y)], &text(&step.constant))
}

fn coplanar(out: &mut Sheet, step: &LegSlideRecord) {
    let LegSlideRecord { leg, ends: [x, y], moved, fixed, between: [a, b], .. } = step;
    let place = combination([("1".into(), x.clone()), (text(&step.offset), format!("({y} - {x})"))], "0");
    say!(out, "\n   leg {leg}: {moved} = {place}; {x}, {y}, {moved} and {fixed} in one plane");
    let (zero, one, d) = ("0".to_owned(), "1".to_owned(), text(&step.square));
    let [to_x, to_y] = step.squares_to_ends.each_ref().map(text);
    let (s_x, s_y, s) = (format!("s{a}"), format!("s{b}"), format!("s{leg}'"));
    let rows = [
        ["", &zero, &one, &one, &one, &one],
        [x, &one, &zero, &d, &to_x, &s_x],
        [y, &one, &d, &zero, &to_y, &s_y],
        [moved, &one, &to_x, &to_y, &zero, &s],
        [fixed, &one, &s_x, &s_y, &s, &zero],
    ];
    let titles = ["", x, y, moved, fixed].map(|title| right(title, 0).gap(2));
    let mut table = Table::new([left("   ", 8)].into_iter().chain(titles));
    for [title, cells @ ..] in rows {
        table.row(std::iter::once(format!("     {title}")).chain(cells.map(str::to_owned)).map(Cell::from));
    }
    out.table(table);
    say!(out, "   D = -2 * {d} ({s} - ({}))^2 = 0", row(step));
    say!(out, "   {s} = {}", row(step));
}

/// The order in which offsets can be introduced.
fn one_at_a_time(out: &mut Sheet, d: &DerivationRecord) {
    let Some(steps) = &d.sequence else {
        out.line("\n2. One offset at a time: no order reaches this platform.");
        out.line(
            "   Each move needs two legs with a joint in common. All offsets must be introduced together.",
        );
        return;
    };
    if steps.is_empty() {
        return;
    }
    out.line("\n2. The same, one offset at a time; s of a moved leg is its new squared length");
    for (k, step) in steps.iter().enumerate() {
        let [x, y] = &step.ends;
        say!(out, "   {}. leg {}: {} on the line {x} {y}, {} stays", k + 1, step.leg, step.moved, step.fixed);
        say!(out, "      s{}' = {}", step.leg, row(step));
    }
    let product = steps.iter().map(|step| text(&step.rest)).collect::<Vec<_>>().join(" * ");
    say!(out, "   det A is the product of the legs' own coefficients: {product}");
}

fn determinant(out: &mut Sheet, d: &DerivationRecord) {
    if let Some(products) = &d.products {
        say!(out, "   (1 - t1)(1 - t2)(1 - t3)(1 - t4)(1 - t5)(1 - t6) = {}", text(&products.rest));
        say!(out, "   t1 t2 t3 t4 t5 t6 = {}", text(&products.own));
        let zero = if d.factors.iter().any(|f| f.value.value.0 == 0.0) { ": singular" } else { "" };
        for f in &d.factors {
            say!(
                out,
                "   det A is their difference, {}{zero}; platforms with equal products are singular",
                text(&f.value)
            );
        }
        return;
    }
    for f in &d.factors {
        let zero = if f.value.value.0 == 0.0 { "; here it is zero: singular" } else { "" };
        say!(
            out,
            "   factor {} = {}, which is zero in singular designs: {}{zero}",
            f.formula,
            text(&f.value),
            f.zero
        );
    }
    if d.factors.is_empty() {
        out.line("   No leg is moved: det A = 1");
    }
}
