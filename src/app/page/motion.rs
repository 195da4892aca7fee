//! Self-motions for animation.

use serde::Serialize;

use super::request::Refusal;
use ask::{Design, MotionStart, SelfMotionOptions};
use platform::geom::Pose;
use records::PoseRecord;
use synthesis::singularity::{CurveEnd, MotionCurve, MotionOptions};

/// Greatest number of poses of an animation.
const FRAMES: usize = 240;
/// The step sizes of tracing, coarse enough for a quick answer on a page.
const OPTIONS: MotionOptions = MotionOptions { turn: 0.05, points: 3000, seed: 1 };

/// A self-motion.
#[derive(Debug, Serialize)]
pub(super) struct SelfMotionRecord {
    /// The dimension; null: undecided.
    dimension: Option<usize>,
    curves: usize,
    closed: bool,
    end: Option<&'static str>,
    length_error: f64,
    poses: Vec<PoseRecord>,
}

/// The curve of poses with constant leg lengths through the pose; the longest if several cross.
pub(super) fn record(design: &Design, at: &Pose) -> Result<SelfMotionRecord, Refusal> {
    let options = SelfMotionOptions::new(MotionStart::Pose(*at)).sections(0).motion(OPTIONS);
    let report = design.self_motions(&options).map_err(|why| Refusal::new("pose", why.to_string()))?;
    let found = &report.motion;
    let longest = report.longest().map(|k| &found.curves[k]);
    let poses = longest.map(frames).unwrap_or_default();
    Ok(SelfMotionRecord {
        dimension: report.dimension,
        curves: found.curves.len(),
        closed: longest.is_some_and(|c| c.end == CurveEnd::Closed),
        end: longest.map(|c| c.end.name()),
        length_error: found.worst_length_error,
        poses: poses.iter().map(PoseRecord::from).collect(),
    })
}

/// Poses at about equal spacing along the curve.
fn frames(c: &MotionCurve) -> Vec<Pose> {
    let total = c.points.last().map_or(0.0, |p| p.arc);
    let mut next = 0.0;
    let mut out = Vec::new();
    for p in &c.points {
        if p.arc >= next {
            out.push(p.pose);
            next = p.arc + total / FRAMES as f64;
        }
    }
    out
}
