//! What a design asks of a search: variables, objectives and limits with their reserves.

use super::super::SingularHome;
use crate::Design;
use files::design::{Combination, SearchTable};
use machine::requirements::{Objective, Requirements, TermKind, VariableKind};
use optimize::dimensional::{self, DimensionalProblem, InvalidProblem, Mode, Triangles, Variables};
use optimize::offsets::{DEFAULT_MIN_ABS_DET, OffsetProblem};
use platform::geom::Pose;
use platform::manipulator::{Body, Octahedral};

/// How far a joint may stand beyond a corner, in lengths of its side, where nothing is said: room for the joint, and a
/// body half as wide again at most.
pub const EXTENSION: f64 = 0.3;
/// The reserve on every limit that `explore` keeps where the design states none, percent.
pub const RESERVE_PERCENT: f64 = 5.0;

/// Which search answers a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchKind {
    /// For the offsets with the best worst-case conditioning.
    Offsets,
    /// For a platform under requirements.
    Platform,
    /// For so many platforms of which none is better in every objective.
    Front(usize),
}

impl SearchKind {
    /// That of a design; `with_drives`: a table of drives is given, whose lengths are requirements.
    pub fn of(design: &Design, with_drives: bool) -> Self {
        match design.search.mode {
            _ if !with_drives && !asks_for_more(design) => Self::Offsets,
            Some(Combination::Pareto { points }) => Self::Front(points),
            _ => Self::Platform,
        }
    }
}

/// A singular home pose that the search cannot leave: neither the triangles nor the height of home are chosen, and
/// `det J` of an equivalent platform is that of the
/// design times a constant.
pub fn hopeless_home(design: &Design, extension: f64) -> Option<SingularHome> {
    let variables = dimensional_problem(design, extension).variables;
    let stays = variables.triangles == Triangles::Fixed && !variables.home_height;
    design.home_that_no_equivalent_holds().filter(|_| stays)
}

/// Whether a design asks for anything besides offsets with the best worst-case conditioning: requirements, other
/// variables or objectives, or legs moved on families because it has no offsets.
fn asks_for_more(design: &Design) -> bool {
    let plain = Requirements {
        min_joint_distance: design.optimize.min_joint_distance,
        reserves: design.reserves.clone(),
        ..Requirements::default()
    };
    design.search != SearchTable::default()
        || design.requirements() != plain
        || Octahedral::recognise(design.manipulator()).is_err()
}

/// The design with a reserve on every limit; `None` where it states one.
pub fn with_default_reserve(design: &Design) -> Option<Design> {
    let mut careful = design.clone();
    careful.reserves.all = Some(RESERVE_PERCENT);
    design.reserves.is_empty().then_some(careful)
}

/// The limits of a search for offsets without and with the reserves of the design: the least distance of joints and the
/// least `|det A|`.
fn offset_limits(design: &Design, octahedral: &Octahedral) -> [[f64; 2]; 2] {
    let default = OffsetProblem::with_defaults(octahedral.clone(), Vec::new());
    let table = &design.optimize;
    let distance = table.min_joint_distance.unwrap_or(default.min_joint_distance);
    let det = table.min_abs_det.unwrap_or(default.min_abs_det);
    let required = Requirements { min_joint_distance: Some(distance), ..design.requirements() };
    let reserve = [TermKind::BaseSpacing, TermKind::PlatformSpacing].map(|kind| required.reserve(kind));
    let share = design.reserves.all.unwrap_or(0.0) / 100.0;
    [[distance, distance + reserve[0].max(reserve[1])], [det, det * (1.0 + share)]]
}

/// What the reserves add to the least distance of joints and to the least `|det A|` in a search for offsets.
pub fn offset_reserves(design: &Design, octahedral: &Octahedral) -> [f64; 2] {
    offset_limits(design, octahedral).map(|[stated, held]| held - stated)
}

/// The offsets of an octahedral design over these poses, within the limits of its `[optimize]` and with its reserves on
/// them.
pub(super) fn offset_problem(
    design: &Design,
    octahedral: Octahedral,
    poses: Vec<Pose>,
    extension: f64,
) -> OffsetProblem {
    let [[_, min_joint_distance], [_, min_abs_det]] = offset_limits(design, &octahedral);
    let default = OffsetProblem::with_defaults(octahedral, poses);
    OffsetProblem {
        characteristic_length: design.optimize.characteristic_length.unwrap_or(default.characteristic_length),
        min_joint_distance,
        min_abs_det,
        bounds: [(0.0 - extension, 1.0 + extension); 6],
        ..default
    }
}

/// The design with the sizes of its bodies and the height of home to choose, where it requires something, names no
/// variables, and no leg of it can be replaced; else `None`.
pub(super) fn with_sizes_to_choose(design: &Design) -> Option<Design> {
    let usual = design.search.variables.is_empty() && Octahedral::recognise(design.manipulator()).is_err();
    if !usual || design.requirements() == Requirements::default() {
        return None;
    }
    let problem = dimensional_problem(design, EXTENSION);
    if !matches!(dimensional::why_not(&problem), Some(InvalidProblem::NoFamily)) {
        return None;
    }
    let mut out = design.clone();
    out.search.variables = vec![VariableKind::TriangleSizes, VariableKind::HomeHeight];
    Some(out)
}

/// The problem of a design.
pub fn dimensional_problem(design: &Design, extension: f64) -> DimensionalProblem {
    let (m, table, search) = (design.manipulator(), &design.optimize, &design.search);
    let home = design.home_or_default();
    let space = design.workspace_or_default().space(&home);
    let usual =
        if Octahedral::recognise(m).is_ok() { VariableKind::Offsets } else { VariableKind::Components };
    let kinds =
        if search.variables.is_empty() { std::slice::from_ref(&usual) } else { &search.variables[..] };
    let mut variables = Variables::of(kinds);
    variables.symmetry = search.symmetry.unwrap_or_default();
    variables.fixed_ends = fixed_ends(design);
    if Body::BOTH.into_iter().all(|body| variables.keeps_body(body)) {
        variables.triangles = Triangles::Fixed;
    }
    variables.offset_bounds = [search.offset_bounds.unwrap_or((0.0 - extension, 1.0 + extension)); 6];
    variables.stretch_bounds = search.stretch_bounds.unwrap_or(variables.stretch_bounds);
    variables.height_bounds = search.height_bounds.unwrap_or(variables.height_bounds);
    let mut requirements = design.requirements();
    let octahedral = Octahedral::recognise(m).ok().map(|o| OffsetProblem::with_defaults(o, Vec::new()));
    if let (true, Some(default)) = (variables.offsets, &octahedral) {
        // joints that offsets separate need room, also where the design says nothing
        requirements.min_joint_distance.get_or_insert(default.min_joint_distance);
    }
    let objectives = if search.objectives.is_empty() {
        vec![(Objective::WorstConditioning, 1.0)]
    } else {
        search.objectives.clone()
    };
    let mode = match search.mode {
        Some(Combination::Lexicographic { slack }) => Mode::Lexicographic { slack },
        _ => Mode::Weighted,
    };
    DimensionalProblem {
        characteristic_length: design.characteristic_length(),
        min_abs_det: table.min_abs_det.unwrap_or(DEFAULT_MIN_ABS_DET),
        manipulator: m.clone(),
        requirements,
        space,
        variables,
        objectives,
        mode,
    }
}

/// Legs whose ends are at joints that no search may move, base first.
fn fixed_ends(design: &Design) -> [[bool; 6]; 2] {
    let fixed = Body::BOTH.map(|body| design.fixed_joints(body));
    let pairs = design.manipulator().pairs();
    [pairs.map(|(base, _)| fixed[0][base]), pairs.map(|(_, platform)| fixed[1][platform])]
}

/// The question of a search for offsets as that of a search under requirements.
pub(super) fn as_dimensional(design: &Design, problem: &OffsetProblem) -> DimensionalProblem {
    let mut general = dimensional_problem(design, EXTENSION);
    general.variables.offset_bounds = problem.bounds;
    general.characteristic_length = problem.characteristic_length;
    let [[min_joint_distance, _], [min_abs_det, _]] = offset_limits(design, &problem.octahedral);
    general.min_abs_det = min_abs_det;
    general.requirements.min_joint_distance = Some(min_joint_distance);
    general
}
