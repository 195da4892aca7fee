//! What `round` writes.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{in_words, verdict};
use crate::cli::commands::tolerances::{joint_name, spread};
use crate::cli::output::number;
use crate::cli::poses;
use crate::design::Design;
use crate::manufacture::{
    ExactRounding, Grid, Judgement, NearestRounding, NoRounding, RoundedJoint, Rounding, RoundingProblem,
};

/// Everything there is to tell.
#[derive(Debug)]
pub(super) struct Report<'a> {
    pub(super) design: &'a Design,
    pub(super) problem: &'a RoundingProblem<'a>,
    pub(super) found: &'a Rounding,
    pub(super) rounded: Option<(&'static str, &'a Design)>,
    pub(super) written: Option<&'a str>,
}

fn judgement(j: &Judgement) -> Value {
    let margins = j
        .margins
        .iter()
        .map(|(kind, margin)| json!({ "requirement": kind.code(), "margin": number(*margin) }));
    json!({
        "objective": number(j.objective), "worst_pose": poses::record(&j.worst_pose),
        "least_distances": j.least_distances.map(number), "det": j.det.map_or(Value::Null, number),
        "margins": margins.collect::<Value>(), "met": j.met,
    })
}

fn refusal(why: NoRounding) -> Value {
    let code = match why {
        NoRounding::NoTriangles => "no_triangles",
        NoRounding::NoTriangleNear(_) => "no_triangle_near",
        NoRounding::Singular => "singular",
        NoRounding::JointsCoincide(_) => "joints_coincide",
        NoRounding::SingularPose => "singular_pose",
        _ => "bad_grid",
    };
    json!({ "error": { "code": code, "message": why.to_string() } })
}

fn grids(grids: &[Grid; 2]) -> Value {
    let one = |g: &Grid| json!({ "pitch": number(g.pitch), "origin": g.origin.map(number), "angle_deg": number(g.angle_deg) });
    json!({ "base": one(&grids[0]), "platform": one(&grids[1]) })
}

impl Report<'_> {
    fn joints(&self, joints: &[RoundedJoint]) -> Value {
        let one = |j: &RoundedJoint| {
            json!({
                "body": j.joint.body.to_string(), "joint": joint_name(self.design, j.joint), "cell": j.cell,
                "moved": j.moved.iter().map(|x| number(*x)).collect::<Value>(),
                "distance": number(j.moved.norm()), "off_line": j.off_line.map_or(Value::Null, number),
            })
        };
        joints.iter().map(one).collect()
    }

    fn exact(&self, e: &ExactRounding) -> Value {
        json!({
            "grids": grids(&e.grids), "proved": e.proved, "verdict": verdict(&e.verification),
            "fractions": e.fractions.map_or(Value::Null, |f| f.iter().map(|(k, n)| json!([k, n])).collect()),
            "joints": self.joints(&e.joints), "judgement": judgement(&e.judgement),
            "search": { "triangles": e.pool, "complete_to": e.complete_to.map(number), "replacements": e.replacements },
        })
    }

    fn nearest(&self, n: &NearestRounding) -> Value {
        let pair = |(p, w): (f64, f64)| json!({ "position": number(p), "rotation_deg": number(w) });
        let residual = n.verification.as_ref().map_or(Value::Null, |v| number(v.map.residual));
        json!({
            "grids": grids(&n.grids), "verdict": verdict(&n.verification), "map_residual": residual,
            "joints": self.joints(&n.joints), "judgement": judgement(&n.judgement),
            "pose_error": {
                "first_order": pair(n.first_order), "first_order_nearest_points": pair(n.first_order_nearest),
                "solved": spread(&n.solved.0), "solved_poses": n.solved.1,
            },
            "not_nearest": n.not_nearest,
        })
    }

    pub(super) fn json(&self) -> Map<String, Value> {
        let mut out = Map::new();
        let mut put = |key: &str, value: Value| out.insert(key.into(), value);
        put("grids", grids(&self.problem.grids));
        put("free_grid", json!(self.problem.free));
        put("wanted", judgement(&self.found.wanted));
        put("exact", self.found.exact.as_ref().map_or_else(|why| refusal(*why), |e| self.exact(e)));
        put("nearest", self.found.nearest.as_ref().map_or_else(|why| refusal(*why), |n| self.nearest(n)));
        put("chosen", json!(self.rounded.map(|r| r.0)));
        let design = self.rounded.and_then(|(_, d)| serde_json::from_str::<Value>(&d.to_json()).ok());
        put("design", design.unwrap_or(Value::Null));
        put("output", json!(self.written));
        out
    }

    fn judged(&self, out: &mut String, what: &str, j: &Judgement) {
        let det = j.det.map_or(String::new(), |d| format!(", det A = {d:.6}"));
        let _ = writeln!(
            out,
            "{what:<8} worst inverse condition number {:.6}{det}; joints at least {:.4} and {:.4} {} apart; requirements {}",
            j.objective,
            j.least_distances[0],
            j.least_distances[1],
            self.design.units,
            if j.met { "met" } else { "violated" }
        );
    }

    fn grids(&self, out: &mut String, grids: &[Grid; 2]) {
        if self.problem.free {
            for (body, grid) in ["base", "platform"].iter().zip(grids) {
                let _ = writeln!(out, "  grid of the {body}: {}", in_words(grid));
            }
        }
    }

    fn table(&self, out: &mut String, joints: &[RoundedJoint]) {
        let _ = writeln!(
            out,
            "  {:<8} {:<12} {:>7} {:>7}  {:>10}  off its line",
            "body", "joint", "i", "j", "moved"
        );
        for j in joints {
            let off = j.off_line.map_or("corner".to_string(), |x| format!("{x:.3e}"));
            let _ = writeln!(
                out,
                "  {:<8} {:<12} {:>7} {:>7}  {:>10.6}  {off}",
                j.joint.body.to_string(),
                joint_name(self.design, j.joint),
                j.cell[0],
                j.cell[1],
                j.moved.norm()
            );
        }
    }

    pub(super) fn text(&self) -> String {
        let units = &self.design.units;
        let mut out = format!("{}\n", self.design.name);
        self.judged(&mut out, "wanted", &self.found.wanted);
        match &self.found.exact {
            Ok(e) => {
                self.judged(&mut out, "exact", &e.judgement);
                let proof = if e.proved { "proved in exact arithmetic" } else { "NOT proved" };
                let _ = writeln!(
                    out,
                    "  equivalent to its own octahedral platform: {proof}; leg map and forward kinematics: {}",
                    verdict(&e.verification)
                );
                self.grids(&mut out, &e.grids);
                self.table(&mut out, &e.joints);
            }
            Err(why) => {
                let _ = writeln!(out, "exact    none: {why}");
            }
        }
        match &self.found.nearest {
            Ok(n) => {
                self.judged(&mut out, "nearest", &n.judgement);
                let _ = writeln!(
                    out,
                    "  with the wanted design: {}; error of the pose by its formula: first order {:.4e} {units}, {:.4e} deg \
                     (every joint on the nearest point: {:.4e}, {:.4e}); solved at {} random poses at most {:.4e}, {:.4e}",
                    verdict(&n.verification),
                    n.first_order.0,
                    n.first_order.1,
                    n.first_order_nearest.0,
                    n.first_order_nearest.1,
                    n.solved.1,
                    n.solved.0.position.max,
                    n.solved.0.rotation_deg.max
                );
                self.grids(&mut out, &n.grids);
                self.table(&mut out, &n.joints);
            }
            Err(why) => {
                let _ = writeln!(out, "nearest  none: {why}");
            }
        }
        let chosen = self.rounded.map_or("none meets the requirements", |r| r.0);
        let _ = writeln!(out, "chosen: {chosen}");
        if let Some(path) = self.written {
            let _ = writeln!(out, "wrote {path}");
        }
        out
    }
}
