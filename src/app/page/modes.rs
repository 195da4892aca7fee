//! Assembly modes: all real poses with given leg lengths.

use serde::Serialize;

use super::request::Refusal;
use super::scene::sign;
use super::session::Session;
use ask::{Design, PoseFrames};
use fk::{Completeness, FkOptions, FkRoot, FkSolutions, PoseCounting, Reality, SolutionSet, solver};
use machine::rotary::RotaryPlatform;
use platform::geom::{ComplexPose, Pose, turn_between};
use platform::manipulator::{LegLengths, Manipulator, SquaredLegLengths, inverse_condition, jacobian};
use records::PoseRecord;
use verify::match_poses;

/// All poses of two platforms.
#[derive(Debug, Serialize)]
pub(super) struct ConfirmedRecord {
    first: PosesRecord,
    second: PosesRecord,
    /// The largest distance of a pose from its partner; `null` if some pose has none.
    distance: Option<f64>,
}

/// The number of poses of a platform.
#[derive(Debug, Serialize)]
struct PosesRecord {
    method: &'static str,
    finite: usize,
    set: &'static str,
}

/// Assembly modes.
#[derive(Debug, Serialize)]
pub(super) struct ModesRecord {
    method: &'static str,
    solution_set: &'static str,
    finite: usize,
    proved: bool,
    reason: String,
    /// Index of the mode of the given pose.
    here: Option<usize>,
    /// Index of the mode nearest to the given pose, for any lengths.
    nearest: Option<usize>,
    modes: Vec<ModeRecord>,
    complex: usize,
}

/// A real pose.
#[derive(Debug, Serialize)]
struct ModeRecord {
    pose: PoseRecord,
    /// Position and angles in the convention of the design.
    written: [f64; 6],
    turn_deg: f64,
    sign: i8,
    inverse_condition: f64,
    /// Whether every crank is on the side that the design keeps; `null`: no cranks.
    elbows_kept: Option<bool>,
    certified: bool,
    multiplicity: u32,
    residual: f64,
}

fn at_pose(m: &Manipulator, at: &Pose) -> Result<SquaredLegLengths, Refusal> {
    at.squared_lengths(m).ok_or_else(|| Refusal::new("pose", "a leg has no length at this pose"))
}

fn solve(m: &Manipulator, s: SquaredLegLengths) -> Result<FkSolutions, Refusal> {
    solve_with(m, s, &FkOptions::default())
}

fn solve_with(m: &Manipulator, s: SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, Refusal> {
    solver(None).solve(m, &s, o).map_err(|e| Refusal::new("fk", e))
}

/// All poses of two platforms, real and complex, with their own leg lengths at a pose. The field `distance` is the
/// largest distance of a pair as matched by [`match_poses`]. It is `null` if some pose has no partner of its own.
pub(super) fn confirm(
    first: &Manipulator,
    second: &Manipulator,
    at: &Pose,
) -> Result<ConfirmedRecord, Refusal> {
    // as in `verify`, poses are left out if they are so far away that rounding of the joints decides whether they exist
    let options = FkOptions::new().pose_count(PoseCounting::Never);
    let poses = |m: &Manipulator| solve_with(m, at_pose(m, at)?, &options);
    let (a, b) = (poses(first)?, poses(second)?);
    let all = |s: &FkSolutions| s.roots.iter().map(|r| r.pose).collect::<Vec<_>>();
    // pairs at any distance, since the page shows the distance
    let matching = match_poses(&all(&a), &all(&b), first.size(), f64::INFINITY);
    let distance = matching.is_perfect().then(|| matching.worst_distance());
    let side = |s: &FkSolutions| PosesRecord {
        method: s.method.name(),
        finite: s.roots.len(),
        set: s.solution_set.name(),
    };
    Ok(ConfirmedRecord { first: side(&a), second: side(&b), distance })
}

/// The given lengths or angles with their legs: the legs of the design, or the rods on the tips of cranks.
struct InputsOfPoses {
    m: Manipulator,
    squares: SquaredLegLengths,
    cranks: Option<(RotaryPlatform, [f64; 6])>,
}

impl InputsOfPoses {
    fn of(session: &Session, design: &Design, at: &Pose, given: Option<[f64; 6]>) -> Result<Self, Refusal> {
        let Some(platform) = &session.cranks else {
            let m = design.manipulator().clone();
            let squares = match given {
                Some(l) => LegLengths::try_new(l).map_err(|e| Refusal::new("lengths", e))?.squared(),
                None => at_pose(&m, at)?,
            };
            return Ok(Self { m, squares, cranks: None });
        };
        let angles = match given {
            Some(degrees) => degrees.map(f64::to_radians),
            None => platform.ik(at).map_err(|e| Refusal::new("pose", e))?,
        };
        let m = platform.at(&angles).map_err(|e| Refusal::new("lengths", e))?;
        Ok(Self { m, squares: platform.rods().squared(), cranks: Some((platform.clone(), angles)) })
    }
}

/// All poses with the given lengths (for cranks, angles in degrees), or with the lengths at a pose. For a given pose
/// with isolated poses, `here` is the index of the nearest one. `turn_deg` is the rotation of the platform from home,
/// degrees.
pub(super) fn record(
    session: &Session,
    design: &Design,
    at: &Pose,
    lengths: Option<[f64; 6]>,
) -> Result<ModesRecord, Refusal> {
    let frames = session.frames();
    let asked = InputsOfPoses::of(session, design, at, lengths)?;
    let m = &asked.m;
    let found = solve(m, asked.squares)?;
    let roots: Vec<&FkRoot> = match &found.solution_set {
        SolutionSet::PositiveDimensional { witnesses, .. } => witnesses.iter().collect(),
        _ => found.roots.iter().collect(),
    };
    let real: Vec<&FkRoot> = roots.iter().copied().filter(|r| r.reality == Reality::Real).collect();
    let from = ComplexPose::from(*at);
    let distance = |r: &FkRoot| r.pose.distance(&from, m.size());
    // poses of a curve are samples, so the nearest one is another pose
    let listed = lengths.is_none() && !matches!(found.solution_set, SolutionSet::PositiveDimensional { .. });
    let nearest = (0..real.len()).min_by(|a, b| distance(real[*a]).total_cmp(&distance(real[*b])));
    let here = nearest.filter(|_| listed);
    let proved =
        matches!(found.completeness, Completeness::Proved { .. } | Completeness::ProvedBounded { .. });
    Ok(ModesRecord {
        method: found.method.name(),
        solution_set: found.solution_set.name(),
        finite: found.roots.len(),
        proved,
        reason: found.completeness.to_string(),
        here,
        nearest,
        modes: real.iter().map(|r| mode(&asked, design, &frames, r)).collect(),
        complex: roots.iter().filter(|r| r.reality != Reality::Real).count(),
    })
}

fn mode(asked: &InputsOfPoses, design: &Design, frames: &PoseFrames, root: &FkRoot) -> ModeRecord {
    let real = root.pose.real_part();
    let j = jacobian(&asked.m, &real, design.characteristic_length());
    let kept = |(platform, angles): &(RotaryPlatform, [f64; 6])| {
        platform.elbows_kept(&real, angles).iter().all(|kept| *kept)
    };
    let turn = turn_between(&frames.home.rotation, &real.rotation).norm();
    ModeRecord {
        pose: (&real).into(),
        written: frames.write(&real).numbers(),
        turn_deg: turn.to_degrees(),
        sign: sign(&j),
        inverse_condition: inverse_condition(&j),
        elbows_kept: asked.cranks.as_ref().map(kept),
        certified: root.certified(),
        multiplicity: root.multiplicity,
        residual: root.residual,
    }
}
