//! The question that a design with requirements asks of `equipod optimize`.

use equipod::methods::design::{Combination, Design, SearchTable};
use equipod::methods::dimensional::{DimensionalProblem, Mode, Triangles, Variables};
use equipod::methods::manipulator::{Octahedral, default_home};
use equipod::methods::offsets::{DEFAULT_MIN_ABS_DET, OffsetProblem};
use equipod::methods::requirements::Requirements;
use equipod::methods::requirements::{Objective, VariableKind};

use crate::dimensional::components;

/// Whether a design asks for more than the offsets with the best conditioning.
fn asks_for_more(design: &Design) -> bool {
    let min_joint_distance = design.optimize.min_joint_distance;
    let plain = Requirements { min_joint_distance, ..Requirements::default() };
    design.search != SearchTable::default() || design.requirements() != plain
}

/// The problem that `equipod optimize DESIGN` solves; of a Pareto front the first objective alone. `None` when the
/// design asks for the offsets only, there is no such problem, or it has variables that the judge does not build.
pub(crate) fn problem(design: &Design) -> Option<DimensionalProblem> {
    let (m, search) = (design.manipulator(), &design.search);
    let kinds = if search.variables.is_empty() { &[VariableKind::Offsets] } else { &search.variables[..] };
    let not_built = kinds.contains(&VariableKind::Components) || kinds.contains(&VariableKind::Triangles);
    if not_built || design.workspace.is_empty() || !asks_for_more(design) {
        return None;
    }
    let home = design.home.unwrap_or_else(|| default_home(m));
    let mut variables = Variables::of(kinds);
    variables.offset_bounds = [search.offset_bounds.unwrap_or((-1.0, 2.0)); 6];
    variables.stretch_bounds = search.stretch_bounds.unwrap_or(variables.stretch_bounds);
    variables.height_bounds = search.height_bounds.unwrap_or(variables.height_bounds);
    let mut requirements = design.requirements();
    let default = Octahedral::recognise(m).ok().map(|o| OffsetProblem::with_defaults(o, Vec::new()));
    if default.is_none() && (variables.offsets || variables.triangles != Triangles::Fixed) {
        return None;
    }
    if let (true, Some(default)) = (variables.offsets, &default) {
        requirements.min_joint_distance.get_or_insert(default.min_joint_distance);
    }
    let mut objectives = search.objectives.clone();
    if objectives.is_empty() {
        objectives.push((Objective::WorstConditioning, 1.0));
    }
    let mode = match search.mode {
        Some(Combination::Lexicographic { slack }) => Mode::Lexicographic { slack },
        Some(Combination::Pareto { .. }) => {
            objectives.truncate(1);
            Mode::Weighted
        }
        _ => Mode::Weighted,
    };
    let one = objectives.len() == 1 || matches!(mode, Mode::Lexicographic { .. });
    let judged = |o: &(Objective, f64)| components(o.0) > 0;
    (one && objectives.iter().all(judged)).then(|| DimensionalProblem {
        characteristic_length: design
            .optimize
            .characteristic_length
            .unwrap_or_else(|| m.platform_rms_radius()),
        min_abs_det: design.optimize.min_abs_det.unwrap_or(DEFAULT_MIN_ABS_DET),
        manipulator: m.clone(),
        requirements,
        space: design.workspace.space(&home),
        variables,
        objectives,
        mode,
    })
}
