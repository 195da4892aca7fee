//! What `tolerances` writes.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::Found;
use crate::cli::output::number;
use crate::cli::poses;
use crate::design::Design;
use crate::manufacture::{ErrorSpread, Joint, JointBudget, Limit, Quantiles};
use crate::synthesis::Body;

/// The name of a joint in the design.
pub(crate) fn joint_name(design: &Design, joint: Joint) -> &str {
    match joint.body {
        Body::Base => &design.base_names()[joint.index],
        Body::Platform => &design.platform_names()[joint.index],
    }
}

fn limit(l: &Limit) -> Value {
    json!({
        "value": number(l.value), "reached": number(l.reached), "limited_by": l.kind.as_str(),
        "pose": poses::record(&l.pose),
    })
}

fn quantiles(q: &Quantiles) -> Value {
    json!({ "median": number(q.median), "p90": number(q.p90), "p99": number(q.p99), "max": number(q.max) })
}

pub(crate) fn spread(s: &ErrorSpread) -> Value {
    json!({ "position": quantiles(&s.position), "rotation_deg": quantiles(&s.rotation_deg) })
}

fn joint(design: &Design, b: &JointBudget) -> Value {
    let each = |v: &[Option<f64>; 3]| v.iter().map(|x| x.map_or(Value::Null, number)).collect::<Value>();
    json!({
        "body": b.joint.body.to_string(), "joint": joint_name(design, b.joint),
        "alone": limit(&b.alone),
        "direction": b.direction.iter().map(|x| number(*x)).collect::<Value>(),
        "position_per_unit": number(b.per_unit.0), "rotation_deg_per_unit": number(b.per_unit.1),
        "along_axes": each(&b.along), "largest_product": each(&b.product_box),
    })
}

pub(super) fn json(design: &Design, f: &Found) -> Map<String, Value> {
    let error = |e: &Option<(f64, f64)>| {
        e.map_or(Value::Null, |(p, w)| json!({ "position": number(p), "rotation_deg": number(w) }))
    };
    let (b, t) = (&f.budget, &f.trials);
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| out.insert(key.into(), value);
    put(
        "bound",
        json!({ "position": number(f.bound.position), "rotation_deg": number(f.bound.rotation_deg) }),
    );
    put("tool", f.tool.coords.iter().map(|x| number(*x)).collect());
    put("units", json!(design.units));
    put("all_joints_radius", limit(&b.radius));
    put("all_coordinates", limit(&b.half_width));
    put("joints", b.joints.iter().map(|j| joint(design, j)).collect());
    put(
        "worst_errors",
        json!({
            "in_budget": error(&f.worst[0]), "times_1_5": error(&f.worst[1]),
            "pose": poses::record(&b.radius.pose),
        }),
    );
    put(
        "solved",
        json!({
            "within_bound": f.solved.within(), "largest_share": f.solved.share.map_or(Value::Null, number),
            "radius": f.solved.radius.map_or(Value::Null, number),
        }),
    );
    put(
        "trials",
        json!({
            "count": t.count, "lost": t.lost, "within_bound": t.within, "beyond_bound": t.count - t.lost - t.within, "formula": spread(&t.formula),
            "first_order_discrepancy": spread(&t.discrepancy),
            "after_one_step": spread(&t.corrected[0]), "after_two_steps": spread(&t.corrected[1]),
        }),
    );
    put(
        "poses",
        json!({ "count": b.poses, "workspace": if f.workspace_given { "design" } else { "default" } }),
    );
    out
}

fn optional(x: Option<f64>) -> String {
    x.map_or("any".to_string(), |x| format!("{x:.3e}"))
}

/// What solving says about the radius.
fn sentence(f: &Found, units: &str) -> String {
    let radius = f.solved.radius.map_or_else(String::new, |r| {
        format!("; with {r:.6e} {units} the worst errors found keep it when they are solved")
    });
    match f.solved.share {
        _ if f.solved.within() => "solved, no error looked at in the budget goes beyond the bound".into(),
        Some(share) => {
            format!(
                "the first order is too wide: solved, errors in the budget use up {share:.6} of the bound{radius}"
            )
        }
        None => format!("the first order is too wide: poses with errors in the budget were lost{radius}"),
    }
}

pub(super) fn text(design: &Design, f: &Found) -> String {
    let (b, t, units) = (&f.budget, &f.trials, &design.units);
    let mut out = format!(
        "{}: error of the tool point at most {} {units}, of the orientation {} deg ({} poses, {} workspace)\n\n",
        design.name,
        f.bound.position,
        f.bound.rotation_deg,
        b.poses,
        if f.workspace_given { "given" } else { "default" }
    );
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "to first order every joint may be off by {:.6e} {units} in any direction ({} is the limit)",
        b.radius.value,
        b.radius.kind.as_str()
    );
    let _ = writeln!(
        out,
        "to first order every coordinate may be off by {:.6e} {units} ({} is the limit)\n",
        b.half_width.value,
        b.half_width.kind.as_str()
    );
    let _ = writeln!(
        out,
        "most critical first    alone      worst direction           pos/unit  deg/unit  alone along x, y, z              all, largest product"
    );
    for j in &b.joints {
        let direction = j.direction.iter().map(|x| format!("{x:6.3}")).collect::<Vec<_>>().join(" ");
        let list = |v: &[Option<f64>; 3]| {
            v.iter().map(|x| format!("{:>9}", optional(*x))).collect::<Vec<_>>().join(" ")
        };
        let _ = writeln!(
            out,
            "{:<8} {:<12} {:>9.3e}  ({direction})  {:>8.3}  {:>8.4}  {}  {}",
            j.joint.body.to_string(),
            joint_name(design, j.joint),
            j.alone.value,
            j.per_unit.0,
            j.per_unit.1,
            list(&j.along),
            list(&j.product_box)
        );
    }
    for (what, e) in ["the budget", "1.5 times it"].iter().zip(&f.worst) {
        if let Some((p, w)) = e {
            let _ = writeln!(
                out,
                "\njoints off by {what} in the worst way, solved: {p:.6e} {units}, {w:.6e} deg"
            );
        }
    }
    let _ = writeln!(
        out,
        "\n{}\n\n{} random errors in the budget: {} within the bound, {} beyond it, {} lost\n\n{:<28} {:>11} {:>11} {:>11} {:>11}  max [deg]",
        sentence(f, units),
        t.count,
        t.within,
        t.count - t.lost - t.within,
        t.lost,
        "error of the pose",
        "median",
        "90 %",
        "99 %",
        "max"
    );
    let rows = [
        ("nominal formula", &t.formula),
        ("  its first order is off by", &t.discrepancy),
        ("after one Newton step", &t.corrected[0]),
        ("after two", &t.corrected[1]),
    ];
    for (what, s) in rows {
        let q = &s.position;
        let _ = writeln!(
            out,
            "{what:<28} {:>11.3e} {:>11.3e} {:>11.3e} {:>11.3e}  {:.3e}",
            q.median, q.p90, q.p99, q.max, s.rotation_deg.max
        );
    }
    out
}
