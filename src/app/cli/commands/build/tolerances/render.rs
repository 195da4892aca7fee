//! The output of `build tolerances`.

use super::ToleranceReports;
use crate::app::cli::table::{column_unit, csv_line, number};
use ask::Design;
use machine::manufacture::{ErrorAtPose, ErrorParts};
use records::{
    AssessAnswer, BudgetPosesRecord, CalibratedPosesRecord, ErrorMapRecord, JointBudgetRecord, Number,
    PoseErrorRecord, SolvedBudgetRecord, SourceWord, TolerancesAnswer, TrialsRecord, WorstErrorsRecord,
};

/// The record of the answer.
pub(super) fn record(
    design: &Design,
    f: &ToleranceReports,
    seed: u64,
    path: Option<String>,
) -> TolerancesAnswer {
    let b = &f.budget;
    TolerancesAnswer {
        assessment: AssessAnswer::of(design, seed),
        bound: (f.bound.position, f.bound.rotation_deg).into(),
        tool: [f.tool.x, f.tool.y, f.tool.z].map(Number),
        units: design.units.clone(),
        all_joints_radius: b.radius,
        all_coordinates: b.half_width,
        joints: b.joints.iter().map(|j| JointBudgetRecord::new(design, j)).collect(),
        worst_errors: WorstErrorsRecord {
            in_budget: f.worst[0].map(PoseErrorRecord::from),
            times_1_5: f.worst[1].map(PoseErrorRecord::from),
            pose: (&b.radius.pose).into(),
        },
        solved: SolvedBudgetRecord {
            within_bound: f.solved.within(),
            largest_share: f.solved.share.map(Number),
            radius: f.solved.radius.map(Number),
        },
        trials: (&f.trials).into(),
        calibrated: f.calibrated.as_ref().map(TrialsRecord::from),
        calibrated_poses: f.computed.as_ref().and_then(|poses| CalibratedPosesRecord::new(design, poses)),
        map: f.map.as_ref().and_then(|(errors, map)| ErrorMapRecord::new(errors, map, path)),
        poses: BudgetPosesRecord { count: b.poses, workspace: SourceWord::given(f.workspace_given) },
    }
}

/// The error map as a table, one pose on each line.
pub(super) fn map(design: &Design, map: &[ErrorAtPose]) -> String {
    let unit = column_unit(&design.units);
    let mut header: Vec<String> = ["x", "y", "z"].iter().map(|axis| format!("{axis}_{unit}")).collect();
    header.extend(["roll_deg", "pitch_deg", "yaw_deg"].map(str::to_string));
    for what in ["position", "rotation"] {
        let unit = if what == "position" { unit.as_str() } else { "deg" };
        header.extend(["", "_by_joints", "_by_lengths", "_by_growth"].map(|of| format!("{what}{of}_{unit}")));
    }
    let mut out = csv_line(&header);
    for at in map {
        let parts = |p: &ErrorParts| [p.total, p.joints, p.lengths, p.growth];
        let numbers = at.pose.position.iter().copied().chain(at.pose.angles().degrees());
        let numbers = numbers.chain(parts(&at.position)).chain(parts(&at.rotation_deg));
        out.push_str(&csv_line(&numbers.map(number).collect::<Vec<_>>()));
    }
    out
}
