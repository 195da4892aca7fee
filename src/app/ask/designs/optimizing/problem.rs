//! The search problem of a design: variables, objectives, and limits with their safety margins.

use super::super::SingularHome;
use crate::Design;
use files::design::{Combination, SearchTable};
use machine::requirements::{Objective, Requirements, TermKind, VariableKind};
use optimize::dimensional::{self, DimensionalProblem, InvalidProblem, Mode, Triangles, Variables};
use optimize::offsets::{DEFAULT_MIN_ABS_DET, OffsetProblem};
use platform::geom::Pose;
use platform::manipulator::{Body, Octahedral};

/// The default limit of a joint's distance beyond a corner, in lengths of its side. It leaves space for the joint, and
/// a body at most half as wide again.
pub const EXTENSION: f64 = 0.3;
/// The default safety margin on every limit in `explore`, percent.
pub const SAFETY_MARGIN_PERCENT: f64 = 5.0;

/// The kind of search for a design.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SearchKind {
    /// A search for the offsets with the best worst-case conditioning.
    Offsets,
    /// A search for a platform under requirements.
    Platform,
    /// A search for a Pareto front with this number of platforms.
    Front(usize),
}

impl SearchKind {
    /// The kind of search for a design; `with_drives`: a table of drives is given, with lengths as requirements.
    pub fn of(design: &Design, with_drives: bool) -> Self {
        match design.search.mode {
            _ if !with_drives && !asks_for_more(design) => Self::Offsets,
            Some(Combination::Pareto { points }) => Self::Front(points),
            _ => Self::Platform,
        }
    }
}

/// A singular home pose that the search cannot leave, because neither the triangles nor the height of home are
/// variables. The value `det J` of an equivalent platform is then a constant multiple of `det J` of the design.
pub fn hopeless_home(design: &Design, extension: f64) -> Option<SingularHome> {
    let variables = dimensional_problem(design, extension).variables;
    let stays = variables.triangles == Triangles::Fixed && !variables.home_height;
    design.home_that_no_equivalent_holds().filter(|_| stays)
}

/// Whether a design requires more than offsets with the best worst-case conditioning. It may have requirements, other
/// variables or objectives, or legs moved in families because it has no offsets.
fn asks_for_more(design: &Design) -> bool {
    let plain = Requirements {
        min_joint_distance: design.optimize.min_joint_distance,
        safety_margins: design.safety_margins.clone(),
        ..Requirements::default()
    };
    design.search != SearchTable::default()
        || design.requirements() != plain
        || Octahedral::recognise(design.manipulator()).is_err()
}

/// The design with a safety margin on every limit; `None` if it states one.
pub fn with_default_safety_margin(design: &Design) -> Option<Design> {
    let mut careful = design.clone();
    careful.safety_margins.all = Some(SAFETY_MARGIN_PERCENT);
    design.safety_margins.is_empty().then_some(careful)
}

/// The limits of a search for offsets without and with the safety margins of the design: the least distance of joints
/// and the least `|det A|`.
fn offset_limits(design: &Design, octahedral: &Octahedral) -> [[f64; 2]; 2] {
    let default = OffsetProblem::with_defaults(octahedral.clone(), Vec::new());
    let table = &design.optimize;
    let distance = table.min_joint_distance.unwrap_or(default.min_joint_distance);
    let det = table.min_abs_det.unwrap_or(default.min_abs_det);
    let required = Requirements { min_joint_distance: Some(distance), ..design.requirements() };
    let safety_margin =
        [TermKind::BaseSpacing, TermKind::PlatformSpacing].map(|kind| required.safety_margin(kind));
    let share = design.safety_margins.all.unwrap_or(0.0) / 100.0;
    [[distance, distance + safety_margin[0].max(safety_margin[1])], [det, det * (1.0 + share)]]
}

/// The safety margins on the least distance of joints and on the least `|det A|` in a search for offsets.
pub fn offset_safety_margins(design: &Design, octahedral: &Octahedral) -> [f64; 2] {
    offset_limits(design, octahedral).map(|[stated, held]| held - stated)
}

/// The offset problem of an octahedral design over these poses, within the limits of its `[optimize]` and with its
/// safety margins.
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

/// The design with the sizes of its bodies and the height of home as variables. `None` unless it has requirements,
/// names no variables, and no leg of it can be replaced.
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
        // joints that offsets separate need spacing, even if the design states none
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

/// Leg ends at joints that no search may move, base first.
fn fixed_ends(design: &Design) -> [[bool; 6]; 2] {
    let fixed = Body::BOTH.map(|body| design.fixed_joints(body));
    let pairs = design.manipulator().pairs();
    [pairs.map(|(base, _)| fixed[0][base]), pairs.map(|(_, platform)| fixed[1][platform])]
}

/// The problem of a search for offsets as a problem under requirements.
pub(super) fn as_dimensional(design: &Design, problem: &OffsetProblem) -> DimensionalProblem {
    let mut general = dimensional_problem(design, EXTENSION);
    general.variables.offset_bounds = problem.bounds;
    general.characteristic_length = problem.characteristic_length;
    let [[min_joint_distance, _], [min_abs_det, _]] = offset_limits(design, &problem.octahedral);
    general.min_abs_det = min_abs_det;
    general.requirements.min_joint_distance = Some(min_joint_distance);
    general
}
