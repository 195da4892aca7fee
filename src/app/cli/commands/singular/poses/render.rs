//! Singularities as JSON.

use super::{SingularPoses, paths};
use crate::app::cli::output::Answer;
use ask::{Design, PoseFigures, PoseFrames};
use platform::geom::Pose;
use records::{
    Number, PoseConventionRecord, PoseFiguresRecord, PoseInFrames, RegularBoxRecord, RegularityRecord,
    ScaledPoseRecord, SingularitiesAnswer,
};

fn figures(j: &PoseFigures) -> PoseFiguresRecord {
    PoseFiguresRecord {
        pose: (&j.pose).into(),
        determinant: Number(j.determinant),
        inverse_condition: Number(j.inverse_condition),
        four_planes: j.four_planes.map(|d| d.map(Number)),
    }
}

/// The answer, with poses in the convention of the command.
pub(super) fn answer(design: &Design, found: &SingularPoses, frames: &PoseFrames) -> Answer {
    let report = &found.report;
    let regular = &report.regular;
    let record = SingularitiesAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        regular: report.safe.as_ref().map(|(regularity, cells)| RegularityRecord::new(regularity, *cells)),
        pose: figures(&report.middle),
        lengths: report.lengths.get(),
        assembly_modes: report.modes.iter().map(figures).collect(),
        assembly_modes_accounted: report.modes_complete,
        regular_box: RegularBoxRecord {
            translation: report.options.translation,
            rotation_deg: report.options.rotation_deg,
            pivot: report.options.pivot,
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
    let write = |pose: &Pose| PoseInFrames::from(&frames.write(pose));
    let convention = PoseConventionRecord::from(&frames.convention);
    let sheet = sheet::answers::singular_poses(&record, found.of_the_design, &convention, &write);
    Answer::new(report.is_regular().into(), record, sheet)
}
