//! Both platforms at a pose: where everything is, lengths, margins, and how the lengths are related.

use std::collections::BTreeMap;

use nalgebra::{Matrix6, Point3};
use serde_json::{Value, json};

use super::request::Refusal;
use super::session::{Equivalent, Session};
use super::wire::{self, number, numbers};
use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::{SquaredLegLengths, inverse_condition, jacobian};
use crate::requirements::{Standing, Term, TermKind, Terms};
use crate::synthesis::AffineLegMap;

/// Below this a singular value is not told from zero.
const ROUNDING: f64 = 1e-13;

/// Everything a page shows at a pose.
pub(super) fn record(session: &Session, at: &Pose, e: Option<&Equivalent>) -> Result<Value, Refusal> {
    let first = session.first();
    let s = squares(first, at)?;
    let mut platforms = vec![platform(session, first, at, &s, session.first_is_given())];
    let mut map = Value::Null;
    if let Some(e) = e {
        let (second, a) = session.second(e)?;
        let own = squares(&second, at)?;
        platforms.push(platform(session, &second, at, &own, true));
        map = relation(e, &a, &s, &own)?;
    }
    Ok(json!({"pose": wire::pose(at), "platforms": platforms, "map": map}))
}

fn squares(design: &Design, at: &Pose) -> Result<SquaredLegLengths, Refusal> {
    let s = at.squared_lengths(design.manipulator());
    s.ok_or_else(|| Refusal::new("pose", "a leg length at this pose is not a finite positive number"))
}

fn platform(session: &Session, design: &Design, at: &Pose, s: &SquaredLegLengths, required: bool) -> Value {
    let m = design.manipulator();
    let place = |(name, p): (&String, Point3<f64>)| json!({"name": name, "at": numbers(p.iter().copied())});
    let base = design.base_names().iter().zip(m.base_joints().iter().copied());
    let moved = design.platform_names().iter().zip(m.platform_joints().iter().map(|p| at.transform(p)));
    let pairs = m.pairs();
    json!({
        "name": design.name,
        "base": base.map(place).collect::<Value>(), "platform": moved.map(place).collect::<Value>(),
        "legs": pairs.map(|(a, b)| [a, b]), "lengths": numbers(s.lengths().get()), "squares": numbers(s.get()),
        "inverse_condition": number(session.inverse_condition(design, at)),
        "sign": sign(&jacobian(m, at, session.characteristic_length)),
        "spacing": {
            "base": spacing(design.base_names(), m.base_joints(), &pairs.map(|p| p.0)),
            "platform": spacing(design.platform_names(), m.platform_joints(), &pairs.map(|p| p.1)),
        },
        "margins": if required { margins(session, design, at) } else { json!([]) },
    })
}

/// The sign of `det J`; 0 where `sigma_min / sigma_max` is below rounding.
pub(super) fn sign(j: &Matrix6<f64>) -> i8 {
    match j.determinant() {
        _ if inverse_condition(j) < ROUNDING => 0,
        d if d > 0.0 => 1,
        _ => -1,
    }
}

/// The two joint centres in use that are closest to each other.
fn spacing(names: &[String], joints: &[Point3<f64>], used: &[usize; 6]) -> Value {
    let mut least: Option<(f64, usize, usize)> = None;
    for i in 0..joints.len() {
        for j in 0..i {
            let distance = (joints[i] - joints[j]).norm();
            let both = used.contains(&i) && used.contains(&j);
            if both && least.is_none_or(|l| distance < l.0) {
                least = Some((distance, j, i));
            }
        }
    }
    least.map_or(Value::Null, |(d, i, j)| json!({"distance": number(d), "joints": [names[i], names[j]]}))
}

/// The least margin of every kind of requirement at the pose.
fn margins(session: &Session, design: &Design, at: &Pose) -> Value {
    let required = design.requirements();
    let terms = Terms::new(design.manipulator(), &required, &session.home);
    let mut least: BTreeMap<TermKind, (Term, f64)> = BTreeMap::new();
    for (term, value) in terms.fixed().into_iter().chain(terms.at(at)) {
        let entry = least.entry(term.kind).or_insert((term, value));
        if value < entry.1 {
            *entry = (term, value);
        }
    }
    let row = |(term, value): (Term, f64)| {
        let pose = (!term.kind.is_fixed()).then_some(at);
        let standing = terms.standing(term.kind, value, pose);
        json!({
            "requirement": term.kind.code(), "margin": number(value),
            "met": standing.is_met(), "at_limit": standing == Standing::AtLimit,
            "unit": design.unit_of(term.kind.quantity()), "between": design.names_of(term),
        })
    };
    least.into_values().map(row).collect()
}

/// `s' = A s + c`, and how well it holds at the pose.
fn relation(
    e: &Equivalent,
    map: &AffineLegMap,
    s: &SquaredLegLengths,
    own: &SquaredLegLengths,
) -> Result<Value, Refusal> {
    let image = map.a * nalgebra::Vector6::from(s.get()) + map.c;
    let most = own.get().into_iter().fold(0.0, f64::max);
    let error = image.iter().zip(own.get()).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max) / most;
    let rows: Value = (0..6).map(|i| numbers((0..6).map(|j| map.a[(i, j)]))).collect();
    let det = e.pattern.determinant(&e.offsets).map_err(|e| Refusal::new("offsets", e))?;
    Ok(json!({
        "A": rows, "c": numbers(map.c.iter().copied()), "det": number(det),
        "inverse_condition": number(map.inverse_condition()), "image": numbers(image.iter().copied()), "error": number(error),
        "zeros": e.zeros()?.into_iter().map(|z| z.map_or(Value::Null, number)).collect::<Value>(),
    }))
}
