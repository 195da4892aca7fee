//! Singularities as text and JSON.

use std::fmt::Write as _;

use super::{Found, Judged};
use crate::cli::output::Answer;
use crate::design::Design;
use crate::geom::Region;
use crate::manipulator::LegLengths;
use crate::records::{
    JudgedPoseRecord, Number, RegionWord, RegularBoxRecord, ScaledPoseRecord, SingularitiesAnswer,
};
use crate::singularity::BoxOptions;

fn judged(j: &Judged) -> JudgedPoseRecord {
    JudgedPoseRecord {
        pose: (&j.pose).into(),
        determinant: Number(j.determinant),
        inverse_condition: Number(j.inverse_condition),
        four_planes: j.four_planes.map(|d| d.map(Number)),
    }
}

fn region(options: &BoxOptions) -> RegionWord {
    match options.region {
        Region::Box => RegionWord::Box,
        Region::Ellipsoid => RegionWord::Ellipsoid,
    }
}

/// The answer.
pub(super) fn answer(design: &Design, lengths: &LegLengths, found: &Found) -> Answer {
    let regular = &found.regular;
    let record = SingularitiesAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        pose: judged(&found.middle),
        lengths: lengths.get(),
        assembly_modes: found.modes.iter().map(judged).collect(),
        assembly_modes_accounted: found.modes_complete,
        regular_box: RegularBoxRecord {
            translation: found.options.translation,
            rotation_deg: found.options.rotation_deg,
            region: region(&found.options),
            proved_scale: Number(regular.proved),
            singular_within: regular
                .refuted
                .map(|s| ScaledPoseRecord { pose: (&s.pose).into(), scale: Number(s.scale) }),
            searched_scale: Number(regular.searched),
            regions: regular.regions,
        },
        path: found.path.as_ref().map(super::paths::Path::record),
        between: found.between.as_ref().map(super::paths::Between::record),
    };
    Answer::new(found.exit, record, text(design, found))
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
        region(o).as_str(),
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
        "  no singular pose for t <= {:.4}, proved over {} cells; the same for every equivalent platform",
        regular.proved, regular.regions
    );
    let _ = match regular.refuted {
        Some(s) => writeln!(out, "  a singular pose within t = {:.4}, proved by a change of sign", s.scale),
        None => writeln!(out, "  no change of sign found up to t = {:.4}", regular.searched),
    };
    out
}
