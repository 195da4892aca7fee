//! Singularities as text and JSON.

use std::fmt::Write as _;

use serde_json::{Map, Value, json};

use super::{Found, Judged};
use crate::cli::output::{Answer, number};
use crate::cli::poses;
use crate::design::Design;
use crate::geom::Region;
use crate::manipulator::LegLengths;
use crate::singularity::BoxOptions;

fn judged(j: &Judged) -> Value {
    let mut record = poses::record(&j.pose);
    record["determinant"] = number(j.determinant);
    record["inverse_condition"] = number(j.inverse_condition);
    if let Some(d) = j.four_planes {
        record["four_planes"] = d.map(number).to_vec().into();
    }
    record
}

fn region(options: &BoxOptions) -> &'static str {
    match options.region {
        Region::Box => "box",
        Region::Ellipsoid => "ellipsoid",
    }
}

/// The answer.
pub(super) fn answer(design: &Design, lengths: &LegLengths, found: &Found) -> Answer {
    let mut json = Map::new();
    json.insert("name".into(), json!(design.name));
    json.insert("units".into(), json!(design.units));
    json.insert("pose".into(), judged(&found.middle));
    json.insert("lengths".into(), json!(lengths.get()));
    json.insert("assembly_modes".into(), found.modes.iter().map(judged).collect());
    json.insert("assembly_modes_accounted".into(), json!(found.modes_complete));
    let regular = &found.regular;
    let segment = regular.refuted.map(|s| {
        let mut record = poses::record(&s.pose);
        record["scale"] = number(s.scale);
        record
    });
    json.insert(
        "box".into(),
        json!({
            "translation": found.options.translation, "rotation_deg": found.options.rotation_deg, "region": region(&found.options),
            "proved_scale": number(regular.proved), "singular_within": segment, "searched_scale": number(regular.searched),
            "regions": regular.regions,
        }),
    );
    if let Some(path) = &found.path {
        json.insert("path".into(), path.record());
    }
    if let Some(between) = &found.between {
        json.insert("between".into(), between.record());
    }
    Answer::new(found.exit, json, text(design, found))
}

fn text(design: &Design, found: &Found) -> String {
    let mut out = format!("{}\n", design.name);
    let line = |out: &mut String, name: &str, j: &Judged| {
        let p = &j.pose.position;
        let _ = writeln!(
            out,
            "{name:<8} [{:.4}, {:.4}, {:.4}]  det J {:+.6e}  inverse condition {:.3e}",
            p.x, p.y, p.z, j.determinant, j.inverse_condition
        );
    };
    line(&mut out, "pose", &found.middle);
    for (k, mode) in found.modes.iter().enumerate() {
        line(&mut out, &format!("mode {}", k + 1), mode);
    }
    let negative = found.modes.iter().filter(|m| m.determinant < 0.0).count();
    let _ = writeln!(
        out,
        "{} assembly modes, {} with det J > 0 and {negative} with det J < 0{}",
        found.modes.len(),
        found.modes.len() - negative,
        if found.modes_complete { "" } else { "; some may be missing" }
    );
    out.extend(found.path.iter().map(super::paths::Path::text));
    out.extend(found.between.iter().map(super::paths::Between::text));
    let o = &found.options;
    let degrees = o.rotation_deg;
    let _ = writeln!(
        out,
        "{} of half widths t x ({:.4}, {:.4}, {:.4}) {} and t x ({:.4}, {:.4}, {:.4}) degrees of the rotation vector about the pose:",
        region(o),
        o.translation[0],
        o.translation[1],
        o.translation[2],
        design.units,
        degrees[0],
        degrees[1],
        degrees[2]
    );
    let regular = &found.regular;
    if !(regular.proved > 0.0) {
        out.push_str("  nothing is proved: the pose itself may be singular\n");
        return out;
    }
    let _ = writeln!(
        out,
        "  no singular pose for t <= {:.4}, proved on {} regions; the same for every equivalent platform",
        regular.proved, regular.regions
    );
    let _ = match regular.refuted {
        Some(s) => writeln!(out, "  a singular pose within t = {:.4}, proved by a change of sign", s.scale),
        None => writeln!(out, "  no change of sign found up to t = {:.4}", regular.searched),
    };
    out
}
