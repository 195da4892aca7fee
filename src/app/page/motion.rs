//! Self-motions for animation.

use serde::Serialize;

use super::request::Refusal;
use platform::geom::Pose;
use platform::manipulator::Manipulator;
use records::PoseRecord;
use synthesis::singularity::{CurveEnd, MotionCurve, MotionOptions, self_motion};

/// Most poses of an animation.
const FRAMES: usize = 240;
/// How finely the curve is followed: a page has to answer in a moment.
const OPTIONS: MotionOptions = MotionOptions { turn: 0.05, points: 3000, seed: 1 };

/// A self-motion.
#[derive(Debug, Serialize)]
pub(super) struct SelfMotionRecord {
    /// Null where it is undecided.
    dimension: Option<usize>,
    curves: usize,
    closed: bool,
    end: Option<&'static str>,
    length_error: f64,
    poses: Vec<PoseRecord>,
}

/// The curve of poses with constant leg lengths on which the pose lies, the longest where several cross.
pub(super) fn record(m: &Manipulator, at: &Pose) -> Result<SelfMotionRecord, Refusal> {
    let s = at.squared_lengths(m).ok_or_else(|| Refusal::new("pose", "a leg has no length at this pose"))?;
    let found = self_motion(m, &s, &[*at], &OPTIONS);
    let length = |c: &&MotionCurve| c.points.last().map_or(0.0, |p| p.arc);
    let longest = found.curves.iter().max_by(|x, y| length(x).total_cmp(&length(y)));
    let poses = longest.map(frames).unwrap_or_default();
    Ok(SelfMotionRecord {
        dimension: found.dimension(),
        curves: found.curves.len(),
        closed: longest.is_some_and(|c| c.end == CurveEnd::Closed),
        end: longest.map(|c| c.end.name()),
        length_error: found.worst_length_error,
        poses: poses.iter().map(PoseRecord::from).collect(),
    })
}

/// Poses at about equal lengths along the curve.
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
