//! Self-motions as JSON and CSV.

use std::fmt::Write as _;

use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ask::{Design, MotionOrigin, PoseFrames, SelfMotionReport};
use fk::CompletenessWord;
use records::{
    CriticalPointsRecord, IsolatedRecord, MotionCurveRecord, MotionEvidenceWord, Number,
    PoseQuaternionRecord, SelfmotionAnswer,
};
use synthesis::singularity::CurveDegree;

/// The answer.
pub(super) fn answer(design: &Design, found: &SelfMotionReport, degrees: &[Option<CurveDegree>]) -> Answer {
    let motion = &found.motion;
    let critical = found.critical.as_ref();
    let curves = motion.curves.iter().zip(degrees);
    // with lengths alone the first pose is one of several, and matters only if it proves a motion
    let at = motion.at_pose.as_ref().filter(|_| found.start.is_some());
    let proof = motion.at_pose.as_ref().filter(|_| found.start.is_some() || found.moves() == Some(true));
    let record = SelfmotionAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        dimension: found.dimension,
        evidence: proof.map_or(MotionEvidenceWord::Sections, |at| at.verdict.into()),
        tangent_dimension: at.map(|at| at.tangent_dimension),
        isolated: at.and_then(|at| IsolatedRecord::of(at.verdict)),
        start: found.start.as_ref().map(PoseQuaternionRecord::from),
        lengths: found.squares.lengths().get().map(Number),
        singular_values: motion.singular_values.map(Number),
        further_starts: further(found),
        real_poses: found.real_poses.iter().map(PoseQuaternionRecord::from).collect(),
        completeness: if found.isolated { CompletenessWord::Proved } else { CompletenessWord::Unproved },
        components_accounted: found.accounted,
        complex_components: critical.map(|c| c.components.clone()),
        critical_points: critical.map(CriticalPointsRecord::from),
        worst_length_error: Number(motion.worst_length_error),
        crossings: motion.crossings.iter().map(PoseQuaternionRecord::from).collect(),
        curves: curves
            .map(|(c, d)| MotionCurveRecord::new(c, d.as_ref(), found.origins.get(c.start).copied()))
            .collect(),
    };
    let sheet = sheet::answers::self_motion(&record);
    Answer::new(found.moves().into(), record, sheet)
}

/// Number of starting poses beside the given one.
fn further(found: &SelfMotionReport) -> usize {
    found.origins.iter().filter(|o| **o != MotionOrigin::Pose).count()
}

/// The table, one line for each pose.
pub(super) fn csv(found: &SelfMotionReport, frames: &PoseFrames) -> String {
    let [_, _, _, a, b, c, d] = poses::csv_names(frames);
    let mut out = format!("curve,point,arc,px,py,pz,{a},{b},{c},{d},length_error,gap\n");
    for (k, curve) in found.motion.curves.iter().enumerate() {
        for (i, point) in curve.points.iter().enumerate() {
            let pose = poses::csv_fields(frames, &point.pose);
            let (arc, error, gap) = (point.arc, point.length_error, point.gap);
            let _ = writeln!(out, "{},{},{arc},{pose},{error},{gap}", k + 1, i + 1);
        }
    }
    out
}
