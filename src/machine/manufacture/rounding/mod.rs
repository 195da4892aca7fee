//! Moves the joints of a design to a grid of holes and evaluates the rounded design: conditioning, requirements, joint
//! distances.

mod exact;
mod free;
mod grid;
mod nearest;
mod plate;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use nalgebra::{Point3, Vector3};
use thiserror::Error;

pub use self::exact::ExactRounding;
use self::exact::TrianglesOfBodies;
use self::grid::GridHole;
pub use self::nearest::NearestRounding;
use self::plate::PlateHoles;
pub use self::plate::holes_turn;
use super::joint::{Joint, joints};
use crate::requirements::{Grid, HolePattern, PoseSpace, Requirements, TermKind, Terms};
use platform::geom::{Pose, SamplePlan};
use platform::manipulator::{Body, Manipulator, inverse_condition, jacobian};

/// Sets of leg lengths for the comparison of a rounded design with its equivalent.
const SAMPLES: usize = 3;

/// A design to put on a grid, and the criteria of its evaluation.
#[derive(Debug, Clone, Copy)]
pub struct RoundingProblem<'a> {
    /// The given design.
    pub manipulator: &'a Manipulator,
    /// Grids of base and platform; `None` for a plate whose joints keep their places.
    pub grids: [Option<Grid>; 2],
    /// Whether origins and angles are chosen too; the given grids remain candidates, so the result is never worse than
    /// theirs.
    pub free: bool,
    /// For each joint of base and platform, `true` if rounding keeps its place; empty: none is kept.
    pub fixed: [&'a [bool]; 2],
    /// The requirements of the design.
    pub requirements: &'a Requirements,
    /// The required poses.
    pub space: &'a PoseSpace,
    /// Poses at which it is evaluated, at least one.
    pub poses: &'a [Pose],
    /// Length that turns angles into lengths in the inverse condition number, design units.
    pub characteristic_length: f64,
    /// Least `|det A|`, where one is required.
    pub min_abs_det: Option<f64>,
    /// Tool point at which errors of the pose are measured, platform frame.
    pub tool: Point3<f64>,
    /// Triangles of each body that are combined in the first search.
    pub candidates: usize,
    /// The exact rounding is chosen when its objective is at least this share of the given design's.
    pub keep: f64,
    /// Random poses for the error of the nearest rounding.
    pub trials: usize,
    /// Seed.
    pub seed: u64,
}

impl RoundingProblem<'_> {
    /// Whether rounding keeps the place of a joint.
    fn holds(&self, joint: Joint) -> bool {
        self.fixed[joint.body.index()].get(joint.index) == Some(&true)
    }
}

/// Reasons why there is no rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum NoRounding {
    /// The joints of a body do not lie in a plane.
    #[error("the joints of the {0} do not lie in a plane, as the holes of a grid do")]
    NotPlanar(Body),
    /// A pitch, radius or number of holes is not positive, or another value of a grid is not finite.
    #[error(
        "the grid of the {0} is invalid: pitch, radii and numbers of holes have to be positive, all numbers finite"
    )]
    BadGrid(Body),
    /// An exact rounding needs lines through many holes.
    #[error("the {0} has no square or triangular grid, and only such grids have lines with many holes")]
    NoLines(Body),
    /// Origins and angles can be chosen only for square grids.
    #[error("the origin and the angle of the grid of the {0} cannot be chosen: it is not a square grid")]
    FreePattern(Body),
    /// The design is not octahedral and lacks one joint on each side of two triangles.
    #[error(
        "the design is neither octahedral nor has one joint on each side of two triangles, so there are no lines to keep the joints on"
    )]
    NoTriangles,
    /// No triangle on the grid is near enough.
    #[error(
        "the grid is too coarse or too fine for the {0}: no triangle near the given one has holes at the joints"
    )]
    NoTriangleNear(Body),
    /// No combination of triangles makes a regular platform.
    #[error("no combination of triangles on the grid makes a regular platform")]
    Singular,
    /// Two joints fall on one hole.
    #[error("two joints of the {0} fall on one hole")]
    JointsCoincide(Body),
    /// A pose at which the design is evaluated is singular.
    #[error("the design is singular at one of its poses")]
    SingularPose,
}

impl NoRounding {
    /// The reason as a word.
    #[must_use]
    pub fn word(self) -> NoRoundingWord {
        match self {
            Self::NoTriangles => NoRoundingWord::NoTriangles,
            Self::NoTriangleNear(_) => NoRoundingWord::NoTriangleNear,
            Self::Singular => NoRoundingWord::Singular,
            Self::JointsCoincide(_) => NoRoundingWord::JointsCoincide,
            Self::SingularPose => NoRoundingWord::SingularPose,
            Self::FreePattern(_) => NoRoundingWord::FreePattern,
            Self::NoLines(_) => NoRoundingWord::NoLines,
            Self::NotPlanar(_) | Self::BadGrid(_) => NoRoundingWord::BadGrid,
        }
    }
}

num::answer_words! {
    /// The reason against a rounding as a word.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum NoRoundingWord as name {
        /// The joints are not on the sides of two triangles.
        NoTriangles = "no_triangles",
        /// No triangle on the grid is near.
        NoTriangleNear = "no_triangle_near",
        /// Every rounding is architecturally singular.
        Singular = "singular",
        /// Two joints come to the same hole.
        JointsCoincide = "joints_coincide",
        /// A pose becomes singular.
        SingularPose = "singular_pose",
        /// Origin and angle can be chosen only for square grids.
        FreePattern = "free_pattern",
        /// The grid cannot be used.
        BadGrid = "bad_grid",
        /// A plate has no lines through many holes.
        NoLines = "no_lines",
    }
}

/// A joint on its hole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundedJoint {
    /// The joint.
    pub joint: Joint,
    /// Hole: its count from the origin of the grid along both axes, or circle and number on it. `None` for a joint that
    /// stays at its given place.
    pub cell: Option<[i64; 2]>,
    /// Shift of the joint from its given place, frame of the body, design units.
    pub moved: Vector3<f64>,
    /// Distance from the line of its side, design units: of the new triangle for the exact rounding, of the given one
    /// for the nearest. `None` for corners and for joints without triangle.
    pub off_line: Option<f64>,
}

/// Both roundings of a design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Rounding {
    /// The given design, evaluated in the same way.
    pub given: Evaluation,
    /// All joints on the grid and exactly on the lines of two triangles.
    pub exact: Result<ExactRounding, NoRounding>,
    /// All joints on grid points next to their given places.
    pub nearest: Result<NearestRounding, NoRounding>,
}

impl Rounding {
    /// The rounding to build. The exact one is chosen if it meets the requirements and keeps the share `keep` of the
    /// objective. Otherwise the nearest one is chosen if it meets them, then the exact one if it meets them.
    #[must_use]
    pub fn choice(&self, keep: f64) -> Option<&Manipulator> {
        let exact = self.exact.as_ref().ok().filter(|e| e.evaluation.met);
        let nearest = self.nearest.as_ref().ok().filter(|n| n.evaluation.met);
        let kept = exact.filter(|e| e.evaluation.objective >= keep * self.given.objective);
        kept.map(|e| &e.manipulator).or(nearest.map(|n| &n.manipulator)).or(exact.map(|e| &e.manipulator))
    }

    /// The rounding that misses the requirements least, if the rule chooses none; of equals the exact one.
    ///
    /// The miss of a rounding is the greatest share by which a margin is below 0. The share refers to the limit or to
    /// the size of the design.
    pub fn least_missed(&self, required: &Requirements, size: f64) -> Option<&Manipulator> {
        let exact =
            self.exact.as_ref().ok().map(|e| (&e.manipulator, e.evaluation.missed_share(required, size)));
        let nearest =
            self.nearest.as_ref().ok().map(|n| (&n.manipulator, n.evaluation.missed_share(required, size)));
        let better = |a: (_, f64), b: (_, f64)| if b.1 < a.1 { b } else { a };
        exact.into_iter().chain(nearest).reduce(better).map(|(m, _)| m)
    }
}

/// Puts the joints of a design with planar bodies on grids, in two ways.
///
/// *Exact*: triangles with corners on grid points whose sides carry grid points near the given joints. The result is
/// exactly equivalent to the octahedral platform on these triangles, decided in exact arithmetic. *Nearest*: every
/// joint on one of the four grid points around it. The choice minimises the pose error of the formula of the target
/// design.
///
/// `free` grids also choose their origins and angles (`docs/theory/manufacture.md`). The candidates are the given grids
/// and those whose holes come nearest to the given places; each rounding takes its own best.
///
/// # Errors
/// [`NoRounding::NotPlanar`], [`NoRounding::BadGrid`]; a reason against one of the two ways is in its part of the
/// answer.
pub fn round_to_grid(problem: &RoundingProblem<'_>) -> Result<Rounding, NoRounding> {
    let m = problem.manipulator;
    let mut bodies = [PlateHoles::AsGiven; 2];
    for (body, grid) in Body::BOTH.into_iter().zip(&problem.grids) {
        if grid.is_some_and(|grid| !grid.is_usable()) {
            return Err(NoRounding::BadGrid(body));
        }
        if problem.free && grid.is_some_and(|grid| grid.pattern != HolePattern::Square) {
            return Err(NoRounding::FreePattern(body));
        }
        let points = places(m, body);
        let laid = PlateHoles::new(&points, grid.as_ref(), m.size()).ok_or(NoRounding::NotPlanar(body))?;
        if !laid.reaches(&points) {
            return Err(NoRounding::BadGrid(body));
        }
        bodies[body.index()] = laid;
    }
    let given = Laying { grids: problem.grids, bodies };
    let roles = TrianglesOfBodies::of(m);
    let det = roles.as_ref().map(|r| r.determinant(m));
    let free = |roles| if problem.free { layings(problem, &given, roles) } else { vec![given] };
    let without_lines = Body::BOTH.into_iter().find(|body| bodies[body.index()].lattice().is_none());
    Ok(Rounding {
        given: evaluate(m, problem, det),
        exact: match (&roles, without_lines) {
            (Some(_), Some(body)) => Err(NoRounding::NoLines(body)),
            (Some(roles), None) => exact::round(problem, &free(Some(roles)), roles),
            (None, _) => Err(NoRounding::NoTriangles),
        },
        nearest: nearest::round(problem, &free(None), roles.as_ref()),
    })
}

/// Grids of both bodies, placed.
#[derive(Debug, Clone, Copy)]
struct Laying {
    grids: [Option<Grid>; 2],
    bodies: [PlateHoles; 2],
}

/// A grid with its holes in the plane of a body.
type LaidPlate = (Option<Grid>, PlateHoles);

/// The given grids, and grids of the same pitches whose holes come nearest to the given places. With roles these are
/// the best triangles of each body. Without roles they are the best grids for the joints, in every combination of the
/// two bodies.
fn layings(problem: &RoundingProblem<'_>, given: &Laying, roles: Option<&TrianglesOfBodies>) -> Vec<Laying> {
    let m = problem.manipulator;
    let found = Body::BOTH.map(|body| {
        let k = body.index();
        let Some(grid) = problem.grids[k] else { return vec![(None, PlateHoles::AsGiven)] };
        let plain = Grid { origin: [0.0; 2], angle_deg: 0.0, ..grid };
        let points = places(m, body);
        let lay = |grid: Grid| {
            let laid =
                PlateHoles::new(&points, Some(&grid), m.size()).filter(|laid| laid.reaches(&points))?;
            Some((Some(grid), laid))
        };
        let Some((_, PlateHoles::Lattice(plain))) = lay(plain) else { return Vec::new() };
        let laid = match roles {
            Some(roles) => {
                let target = exact::target(m, roles, &plain, k);
                let mut best = free::near_triangles(&target, exact::limit(&target));
                best.truncate(1);
                best
            }
            None => free::near_holes(&points.iter().map(|p| plain.coordinates(p)).collect::<Vec<_>>()),
        };
        laid.iter().filter_map(|l| lay(free::as_grid(l, &plain))).collect()
    });
    let [base, platform]: [Vec<LaidPlate>; 2] = found;
    let pair = |(a, b): (&LaidPlate, &LaidPlate)| Laying { grids: [a.0, b.0], bodies: [a.1, b.1] };
    let all = base.iter().flat_map(|a| platform.iter().map(move |b| (a, b)));
    std::iter::once(*given).chain(all.map(pair)).collect()
}

/// The best result over several grids, the first of equals; without a result, the first error.
fn best_of<T>(
    all: impl Iterator<Item = Result<T, NoRounding>>,
    better: impl Fn(&T, &T) -> bool,
) -> Option<Result<T, NoRounding>> {
    all.reduce(|old, new| match (&old, &new) {
        (Ok(a), Ok(b)) if better(b, a) => new,
        (Err(_), Ok(_)) => new,
        _ => old,
    })
}

/// The joints of a body that legs use.
fn places(m: &Manipulator, body: Body) -> Vec<Point3<f64>> {
    joints(m).into_iter().filter(|j| j.body == body).map(|j| place(m, j)).collect()
}

fn place(m: &Manipulator, joint: Joint) -> Point3<f64> {
    m.joints(joint.body)[joint.index]
}

/// The design with its joints (in the order of [`joints`]) on these holes; fixed joints keep their places.
fn on_cells(
    problem: &RoundingProblem<'_>,
    plates: &[PlateHoles; 2],
    cells: &[GridHole],
) -> Option<Manipulator> {
    let m = problem.manipulator;
    let (mut base, mut platform) = (m.base_joints().to_vec(), m.platform_joints().to_vec());
    for (joint, cell) in joints(m).into_iter().zip(cells).filter(|(joint, _)| !problem.holds(*joint)) {
        let at = plate_of(plates, joint.body).point(*cell, &place(m, joint));
        joint.body.of((&mut base, &mut platform))[joint.index] = at;
    }
    Manipulator::try_new(base, platform, m.pairs()).ok()
}

fn plate_of(plates: &[PlateHoles; 2], body: Body) -> &PlateHoles {
    &plates[body.index()]
}

/// Sample poses in the workspace, or within a quarter of the size and 20 degrees about home if the workspace has no
/// width.
fn sample_plan(problem: &RoundingProblem<'_>) -> SamplePlan {
    let space = problem.space;
    SamplePlan::about(problem.manipulator, space.home, space.box_about_home(), (SAMPLES, problem.seed))
}

/// The quality of a design.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "EvaluationRecord", transform = num::nullable))]
pub struct Evaluation {
    /// Worst inverse condition number.
    pub objective: f64,
    /// The pose of this value.
    #[cfg_attr(feature = "serde", serde(with = "platform::geom::ByQuaternion"))]
    pub worst_pose: Pose,
    /// Least distances of joints, base and platform.
    // design units
    pub least_distances: [f64; 2],
    /// det A; null: there is no leg map.
    // of the leg map from the octahedral platform
    pub det: Option<f64>,
    /// Least margin by requirement.
    pub requirements: Vec<LeastMargin>,
    /// Whether all requirements are met.
    // by more than rounding, and `|det A|` is as large as required
    pub met: bool,
    /// Whether all safety margins are kept.
    pub safety_margin_kept: bool,
}

/// The least margin of a requirement.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "RequirementMarginRecord", transform = num::nullable))]
pub struct LeastMargin {
    /// The requirement.
    #[cfg_attr(feature = "serde", serde(rename = "name"))]
    pub kind: TermKind,
    /// The margin; a violation below 0.
    #[cfg_attr(feature = "serde", serde(rename = "margin"))]
    pub value: f64,
}

impl Evaluation {
    /// The greatest miss of a requirement, as a share of its limit or of the size of the design; 0 if none is missed.
    fn missed_share(&self, required: &Requirements, size: f64) -> f64 {
        let share = |margin: &LeastMargin| {
            let whole = required.whole(margin.kind);
            -margin.value / if whole > 0.0 { whole } else { size }
        };
        self.requirements.iter().map(share).fold(0.0, f64::max)
    }
}

/// The degree to which a rounding keeps the requirements at the sampled poses, least first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Keeping {
    Nothing,
    Limits,
    SafetyMargin,
}

impl Keeping {
    /// From the strictest to the weakest.
    const ALL: [Self; 3] = [Self::SafetyMargin, Self::Limits, Self::Nothing];
}

impl Evaluation {
    fn keeping(&self) -> Keeping {
        match (self.met, self.safety_margin_kept) {
            (true, true) => Keeping::SafetyMargin,
            (true, false) => Keeping::Limits,
            (false, _) => Keeping::Nothing,
        }
    }
}

/// The worst inverse condition number if it is above `floor`. The search begins at pose number `hint`, which becomes
/// the number of the worst pose.
fn objective_above(
    m: &Manipulator,
    problem: &RoundingProblem<'_>,
    floor: f64,
    hint: &mut usize,
) -> Option<f64> {
    let count = problem.poses.len();
    let (mut worst, start) = (f64::INFINITY, *hint);
    for k in (0..count).map(|k| (start + k) % count) {
        let value = inverse_condition(&jacobian(m, &problem.poses[k], problem.characteristic_length));
        if value < worst {
            (worst, *hint) = (value, k);
        }
        if !(worst > floor) {
            return None;
        }
    }
    Some(worst)
}

/// Least margins at the poses, whether none is violated, and whether none is below its safety margin.
fn margins(m: &Manipulator, problem: &RoundingProblem<'_>) -> (Vec<LeastMargin>, [bool; 2]) {
    let terms = Terms::new(m, problem.requirements, &problem.space.home);
    let mut least: BTreeMap<TermKind, (f64, Option<&Pose>)> = BTreeMap::new();
    let at = |pose| terms.at(pose).into_iter().map(move |(term, margin)| (term, margin, Some(pose)));
    let fixed = terms.fixed().into_iter().map(|(term, margin)| (term, margin, None));
    for (term, margin, pose) in fixed.chain(problem.poses.iter().flat_map(at)) {
        let entry = least.entry(term.kind).or_insert((margin, pose));
        if margin < entry.0 {
            *entry = (margin, pose);
        }
    }
    let all = |safety_margin: &dyn Fn(TermKind) -> f64| {
        least.iter().all(|(kind, (margin, pose))| {
            terms.standing(*kind, margin - safety_margin(*kind), *pose).is_met()
        })
    };
    let met = [all(&|_| 0.0), all(&|kind| problem.requirements.safety_margin(kind))];
    (least.into_iter().map(|(kind, (value, _))| LeastMargin { kind, value }).collect(), met)
}

/// The evaluation of a design.
fn evaluate(m: &Manipulator, problem: &RoundingProblem<'_>, det: Option<f64>) -> Evaluation {
    let mut hint = 0;
    let objective = objective_above(m, problem, -1.0, &mut hint).unwrap_or(0.0);
    let (requirements, [requirements_met, safety_margin_kept]) = margins(m, problem);
    let det_met = problem.min_abs_det.is_none_or(|least| det.is_none_or(|det| det.abs() >= least));
    Evaluation {
        objective,
        worst_pose: problem.poses[hint],
        least_distances: Body::BOTH.map(|body| m.nearest_joints(body).map_or(f64::INFINITY, |n| n.0)),
        det,
        met: det_met && requirements_met,
        safety_margin_kept: det_met && safety_margin_kept,
        requirements,
    }
}
