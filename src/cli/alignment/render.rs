//! Alignments as JSON and as text.

use nalgebra::{UnitQuaternion, Vector3};
use serde_json::{Map, Value, json};

use crate::cli::output::{number, relation};
use crate::geom::Pose;
use crate::synthesis::alignment::{Alignment, Difference, Invariant, Motion, NearestMotion, Undecided};

/// The word of the document.
pub(super) fn status(a: &Alignment) -> &'static str {
    match a {
        Alignment::Found { .. } => "found",
        Alignment::None { .. } => "none",
        Alignment::Undecided { .. } => "undecided",
    }
}

fn pose(p: &Pose) -> Value {
    let m = p.rotation.matrix();
    let row = |i: usize| (0..3).map(|j| number(m[(i, j)])).collect::<Value>();
    json!({ "R": (0..3).map(row).collect::<Value>(), "p": p.position.iter().map(|x| number(*x)).collect::<Value>() })
}

/// The fields of the document.
pub(super) fn record(a: &Alignment) -> Map<String, Value> {
    let mut fields = Map::new();
    let mut put = |key: &str, value: Value| fields.insert(key.into(), value);
    put("status", json!(status(a)));
    put("explanation", json!(explanation(a)));
    let near = |n: &Option<NearestMotion>| {
        n.map_or(Value::Null, |n| json!({ "base": pose(&n.base), "platform": pose(&n.platform), "residual": number(n.residual) }))
    };
    match a {
        Alignment::Found { motions, all, freedom } => {
            let one = |m: &Motion| {
                json!({
                    "base": pose(&m.base), "platform": pose(&m.platform), "residual": number(m.map.residual),
                    "det": number(m.map.determinant), "relation": relation(m.map.relation),
                })
            };
            put("motions", motions.iter().map(one).collect());
            put("all", json!(all));
            put("freedom", json!(freedom));
        }
        Alignment::None { difference: d, nearest } => {
            let difference = json!({
                "invariant": d.invariant.as_str(), "a": number(d.in_a), "b": number(d.in_b), "gap": number(d.gap), "bound": number(d.bound),
            });
            put("difference", difference);
            put("nearest", near(nearest));
        }
        Alignment::Undecided { reason, nearest } => {
            put("reason", json!(reason.as_str()));
            put("nearest", near(nearest));
        }
    }
    fields
}

/// One sentence with the numbers that decided.
pub(super) fn explanation(a: &Alignment) -> String {
    match a {
        Alignment::Found { motions, all, freedom } => {
            let n = motions.len();
            let family = match freedom {
                0 => String::new(),
                d => format!(", one of each family of dimension {d}"),
            };
            let others = if *all { "there are no others" } else { "there may be others" };
            format!(
                "{n} pair{} of rigid motions make{} the second design equivalent to the first{family}; {others}",
                if n == 1 { "" } else { "s" },
                if n == 1 { "s" } else { "" }
            )
        }
        Alignment::None { difference, nearest } => {
            format!(
                "no rigid motions make the second design equivalent to the first: {}{}",
                reason(difference),
                remark(nearest.as_ref())
            )
        }
        Alignment::Undecided { reason, nearest } => {
            let why = match reason {
                Undecided::UnclearDimension => {
                    "a dimension is not clear, singular values are too near to the tolerance"
                }
                Undecided::NoAxes => "a body has no axes of its own, and the search found no motion",
                _ => "no invariant differs by more than its error bound, and no motion reaches the tolerance",
            };
            format!(
                "whether rigid motions make the designs equivalent is not decided: {why}{}",
                remark(nearest.as_ref())
            )
        }
    }
}

fn reason(d: &Difference) -> String {
    let (x, y, gap, bound) = (d.in_a, d.in_b, d.gap, d.bound);
    match d.invariant {
        Invariant::BasePrincipalValue => format!(
            "a principal value of the base is {x:.9} and {y:.9}, they differ by {gap:.1e} (error bound {bound:.1e})"
        ),
        Invariant::PlatformPrincipalValue => format!(
            "a principal value of the platform is {x:.9} and {y:.9}, they differ by {gap:.1e} (error bound {bound:.1e})"
        ),
        Invariant::CanonicalDistance => {
            format!("the canonical forms are {gap:.1e} apart at best (error bound {bound:.1e})")
        }
        other => format!(
            "{} is {x} and {y} (smallest singular value that counts {gap:.1e}, largest that does not {bound:.1e})",
            other.as_str().replace('_', " ")
        ),
    }
}

fn remark(nearest: Option<&NearestMotion>) -> String {
    nearest.map_or(String::new(), |n| format!("; the nearest motions leave a residual of {:.1e}", n.residual))
}

/// A motion as axis, angle and shift.
pub(super) fn motion_text(p: &Pose) -> String {
    // by the quaternion: the axis of a half turn has no place in the skew part of the matrix
    let q = UnitQuaternion::from_rotation_matrix(&p.rotation);
    let (axis, angle) = q.axis_angle().map_or((Vector3::z(), 0.0), |(u, t)| (u.into_inner(), t.to_degrees()));
    let place = |x: f64| (x * 1e6).round() / 1e6 + 0.0; // + 0.0: no "-0.000000"
    let vector = |v: &Vector3<f64>| format!("({:.6}, {:.6}, {:.6})", place(v.x), place(v.y), place(v.z));
    format!("turn by {angle:.6} deg about {}, then shift by {}", vector(&axis), vector(&p.position))
}
