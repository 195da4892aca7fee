//! The JSON document of `check`.

use nalgebra::Point3;
use serde_json::{Map, Value, json};

use super::Checked;
use super::render::{explanation, proof};
use crate::cli::output::number;
use crate::geom::Pose;
use crate::singularity::{
    Assembly, CornerLengths, Dependency, Finding, GriffisDuffy, NearestSingular, RankBound, RationalPose,
};

pub(super) fn record(c: &Checked) -> Map<String, Value> {
    let a = &c.architecture;
    let mut json = Map::new();
    let mut put = |key: &str, value: Value| {
        json.insert(key.into(), value);
    };
    put("name", json!(c.design.name));
    put("architecturally_singular", json!(c.verdict()));
    put("singular_as_written", json!(a.is_singular()));
    put("reason", json!(c.reason()));
    put("explanation", json!(explanation(c)));
    put("proof", json!(proof_code(c)));
    put("proof_explanation", json!(proof(c)));
    put("leg_rank", json!(a.leg_rank));
    put("jacobian_rank", json!(a.jacobian.rank));
    put("witness", witness(&a.jacobian.witness));
    put("dependency", a.dependencies.first().map_or(Value::Null, |d| dependency(c, d)));
    put("dependencies", a.dependencies.iter().map(|d| dependency(c, d)).collect());
    put("guilty_legs", a.findings.first().map_or(Value::Null, |f| legs(&f.legs)));
    put("cases", a.findings.iter().map(finding).collect());
    put("griffis_duffy", a.griffis_duffy.as_ref().map_or(Value::Null, |g| griffis_duffy(c, g)));
    put("nearest_singular", c.nearest.as_ref().map_or(Value::Null, |n| nearest(c, n)));
    let f = &c.conditioning;
    put("singular_values", numbers(f.leg_vectors));
    put(
        "jacobian_inverse_condition",
        json!({"poses": f.poses, "best": number(f.best), "median": number(f.median), "worst": number(f.worst)}),
    );
    json
}

fn proof_code(c: &Checked) -> &'static str {
    let a = &c.architecture;
    match a.jacobian.bound {
        _ if !a.is_singular() => "regular_pose",
        RankBound::LegVectors | RankBound::Legs => "leg_vectors",
        RankBound::Lattice { .. } => "pose_lattice",
    }
}

fn numbers(x: impl IntoIterator<Item = f64>) -> Value {
    x.into_iter().map(number).collect()
}

/// Legs counted from 1.
fn legs(list: &[usize]) -> Value {
    list.iter().map(|i| json!(i + 1)).collect()
}

fn witness(w: &RationalPose) -> Value {
    let mut record = rigid(&w.pose());
    record["quaternion"] = json!(w.quaternion);
    record
}

fn rigid(pose: &Pose) -> Value {
    let r: Value = (0..3).map(|i| numbers((0..3).map(|j| pose.rotation[(i, j)]))).collect();
    json!({"R": r, "p": numbers(pose.position.iter().copied())})
}

fn dependency(c: &Checked, d: &Dependency) -> Value {
    let defect = c.design.lengths.map(|l| number(d.defect(&l.squared())));
    json!({
        "legs": legs(&d.legs), "coefficients": numbers(d.coefficients), "constant": number(d.constant),
        "base_dimension": d.base_dimension, "platform_dimension": d.platform_dimension, "lengths_defect": defect,
    })
}

fn finding(f: &Finding) -> Value {
    json!({
        "case": f.case.name(), "reason": f.case.reason(), "legs": legs(&f.legs), "sentence": f.case.sentence(),
    })
}

fn griffis_duffy(c: &Checked, g: &GriffisDuffy) -> Value {
    let defect = c.design.lengths.map(|l| number(g.assembly_defect(&l.squared())));
    json!({
        "order": legs(&g.order), "t": numbers(g.t), "side_lengths": numbers(g.sides), "det": number(g.determinant()),
        "exactly_singular": g.is_exactly_singular(), "deviation": number(g.deviation),
        "deviation_limit": number(GriffisDuffy::limit(c.design.manipulator())),
        "coefficients": numbers(g.coefficients()), "constant": number(g.constant()), "lengths_defect": defect,
        "assembly": c.assembly.as_ref().map(assembly),
    })
}

fn assembly(a: &Assembly) -> Value {
    let corners = |o: &CornerLengths| json!({"origin": numbers(o.origin), "direction": numbers(o.direction), "interval": numbers(o.interval)});
    match a {
        Assembly::Incompatible { defect } => json!({"verdict": "incompatible", "defect": number(*defect)}),
        Assembly::NoTriangles => json!({"verdict": "no_real_pose"}),
        Assembly::NotFound { corners: o } => {
            json!({"verdict": "undecided", "octahedral_squared_lengths": corners(o)})
        }
        Assembly::Real { pose, residual, corners: o } => json!({
            "verdict": "real", "pose": rigid(pose), "residual": number(*residual), "octahedral_squared_lengths": corners(o),
        }),
    }
}

fn nearest(c: &Checked, n: &NearestSingular) -> Value {
    let joints = |names: &[String], at: &[Point3<f64>]| -> Value {
        let entry = |(name, p): (&String, &Point3<f64>)| (name.clone(), numbers(p.iter().copied()));
        Value::Object(names.iter().zip(at).map(entry).collect())
    };
    json!({
        "distance": number(n.distance), "bound": "upper", "distance_at_least": number(c.at_least), "kind": n.kind, "legs": legs(&n.legs),
        "coefficients": n.coefficients.map(numbers), "residual": number(n.residual),
        "within_rounding": n.within_rounding,
        "base": joints(c.design.base_names(), &n.base), "platform": joints(c.design.platform_names(), &n.platform),
    })
}
