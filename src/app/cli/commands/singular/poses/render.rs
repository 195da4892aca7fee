//! Singularities as text and JSON.

use std::fmt::Write as _;

use super::{SingularPoses, paths};
use crate::app::cli::output::Answer;
use ask::{Design, PoseFigures};
use records::{
    JudgedPoseRecord, Number, PoseQuaternionRecord, RegularBoxRecord, RegularityRecord, ScaledPoseRecord,
    SingularitiesAnswer,
};
use synthesis::singularity::RegularityWord;

fn judged(j: &PoseFigures) -> JudgedPoseRecord {
    JudgedPoseRecord {
        pose: (&j.pose).into(),
        determinant: Number(j.determinant),
        inverse_condition: Number(j.inverse_condition),
        four_planes: j.four_planes.map(|d| d.map(Number)),
    }
}

/// The answer.
pub(super) fn answer(design: &Design, found: &SingularPoses) -> Answer {
    let report = &found.report;
    let regular = &report.regular;
    let record = SingularitiesAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        regular: report.safe.as_ref().map(|(regularity, cells)| RegularityRecord::new(regularity, *cells)),
        pose: judged(&report.middle),
        lengths: report.lengths.get(),
        assembly_modes: report.modes.iter().map(judged).collect(),
        assembly_modes_accounted: report.modes_complete,
        regular_box: RegularBoxRecord {
            translation: report.options.translation,
            rotation_deg: report.options.rotation_deg,
            region: report.options.region,
            proved_scale: Number(regular.proved),
            singular_within: regular
                .refuted
                .map(|s| ScaledPoseRecord { pose: (&s.pose).into(), scale: Number(s.scale) }),
            searched_scale: Number(regular.searched),
            cells: regular.regions,
        },
        path: found.path.as_ref().map(paths::path_record),
        between: found.between.as_ref().map(paths::pairs_record),
    };
    let text = text(&record, found.of_the_design);
    Answer::new(report.is_regular().into(), record, text)
}

fn text(r: &SingularitiesAnswer, of_the_design: bool) -> String {
    let mut out = format!("{}\n", r.name);
    if let Some(regular) = &r.regular {
        let region = if of_the_design { "workspace" } else { "region of --box" };
        let at = regular.pose.as_ref().map(PoseQuaternionRecord::short).unwrap_or_default();
        let _ = match regular.status {
            RegularityWord::Proved => writeln!(out, "The {region} is free of singular poses: proved."),
            RegularityWord::ChangesSign => {
                writeln!(
                    out,
                    "The {region} holds a singular pose: det J changes its sign on the way to {at}."
                )
            }
            RegularityWord::Undecided => {
                writeln!(
                    out,
                    "It is undecided whether the {region} holds a singular pose, near {at}; more --cells may decide."
                )
            }
        };
    }
    let line = |out: &mut String, name: &str, j: &JudgedPoseRecord| {
        let p = j.pose.position.map(|x| x.0);
        let _ = writeln!(
            out,
            "{name:<8} [{:.4}, {:.4}, {:.4}]  det J {:+.6e}  inverse condition {:.3e}",
            p[0], p[1], p[2], j.determinant.0, j.inverse_condition.0
        );
    };
    line(&mut out, "pose", &r.pose);
    for (k, mode) in r.assembly_modes.iter().enumerate() {
        line(&mut out, &format!("mode {}", k + 1), mode);
    }
    let negative = r.assembly_modes.iter().filter(|m| m.determinant.0 < 0.0).count();
    let _ = writeln!(
        out,
        "{} assembly modes, {} with det J > 0 and {negative} with det J < 0{}",
        r.assembly_modes.len(),
        r.assembly_modes.len() - negative,
        if r.assembly_modes_accounted { "" } else { "; some may be missing" }
    );
    out.extend(r.path.iter().map(paths::path_text));
    out.extend(r.between.iter().map(paths::pairs_text));
    let b = &r.regular_box;
    let (widths, degrees) = (b.translation, b.rotation_deg);
    let _ = writeln!(
        out,
        "{} of half widths t x ({:.4}, {:.4}, {:.4}) {} and t x ({:.4}, {:.4}, {:.4}) degrees of the rotation vector about the pose:",
        b.region.name(),
        widths[0],
        widths[1],
        widths[2],
        r.units,
        degrees[0],
        degrees[1],
        degrees[2]
    );
    if !(b.proved_scale.0 > 0.0) {
        out.push_str("  nothing is proved: the pose itself may be singular\n");
        return out;
    }
    let _ = writeln!(
        out,
        "  no singular pose for t <= {:.4}, proved over {} cells; the same for every equivalent platform",
        b.proved_scale.0, b.cells
    );
    let _ = match &b.singular_within {
        Some(s) => writeln!(out, "  a singular pose within t = {:.4}, proved by a change of sign", s.scale.0),
        None => writeln!(out, "  no change of sign found up to t = {:.4}", b.searched_scale.0),
    };
    out
}
