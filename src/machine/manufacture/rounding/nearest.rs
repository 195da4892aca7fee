//! Every joint on a grid point near its given place, chosen for the least error of the pose.

use nalgebra::{Matrix3, Vector3};

use super::exact::TrianglesOfBodies;
use super::grid::GridHole;
use super::plate::ThreeFold;
use super::{
    Evaluation, Grid, Laying, NoRounding, PlateHoles, RoundedJoint, RoundingProblem, best_of, evaluate,
    on_cells, place, places, plate_of, sample_plan,
};
use crate::manufacture::joint::{Joint, joints};
use crate::manufacture::sensitivity::Sensitivity;
use crate::manufacture::trials::{ErrorSpread, solved_error};
use fk::FkOptions;
use num::Purpose;
use platform::manipulator::{Body, Manipulator};
use verify::{Verification, VerifyError, verify};

/// A rounding whose joints are near their lines, not on them.
#[derive(Debug, Clone)]
pub struct NearestRounding {
    /// The grids of base and platform, as given or chosen.
    pub grids: [Option<Grid>; 2],
    /// The rounded design, joints in the order of the given one.
    pub manipulator: Manipulator,
    /// Every joint, in the order of [`joints`].
    pub joints: Vec<RoundedJoint>,
    /// The evaluation of the rounded design.
    pub evaluation: Evaluation,
    /// Greatest pose error over the poses of the problem with the formula of the given design, to first order. The
    /// parts are the tool point (design units) and the orientation (degrees).
    pub first_order: (f64, f64),
    /// The same with every joint simply on the nearest grid point.
    pub first_order_nearest: (f64, f64),
    /// The error at random poses of the workspace, solved, and the number of these poses.
    pub solved: (ErrorSpread, usize),
    /// Joints that are not on the grid point nearest to them.
    pub not_nearest: usize,
    /// Whether rotations by 120 degrees about the middle of its joints map the joints of each body to themselves.
    /// Symmetric holes keep this symmetry.
    pub three_fold: bool,
    /// Leg map and forward kinematics against the given design.
    pub verification: Result<Verification, VerifyError>,
}

/// The errors of the joints and of the poses they cause.
struct RoundingErrors<'a> {
    sensitivities: &'a [Sensitivity],
    length: f64,
    cells: Vec<GridHole>,
    moved: Vec<Vector3<f64>>,
}

impl RoundingErrors<'_> {
    /// Greatest error of the tool point and of the orientation (radians).
    fn errors(&self) -> (f64, f64) {
        let norms = self.sensitivities.iter().map(|s| s.error(&self.moved));
        norms.fold((0.0, 0.0), |m, (p, w)| (f64::max(m.0, p.norm()), f64::max(m.1, w.norm())))
    }

    /// The greatest error over the poses with some joints at other places: the larger of the position error and the
    /// angle times the characteristic length.
    fn cost(&self, sums: &[(Vector3<f64>, Vector3<f64>)], moved: &[(usize, Vector3<f64>)]) -> f64 {
        let one = |(s, (p, w)): (&Sensitivity, &(Vector3<f64>, Vector3<f64>))| {
            let with = |g: &[Matrix3<f64>], sum: &Vector3<f64>| {
                moved.iter().fold(*sum, |sum, (k, moved)| sum + g[*k] * (moved - self.moved[*k])).norm()
            };
            with(&s.position, p).max(self.length * with(&s.rotation, w))
        };
        self.sensitivities.iter().zip(sums).map(one).fold(0.0, f64::max)
    }
}

/// Joints that move together, by their numbers in the list, and their possible holes, nearest first.
struct Orbit {
    members: Vec<usize>,
    choices: Vec<Vec<GridHole>>,
}

/// Every joint alone, or three joints together if rotations by 120 degrees permute the joints of the body and the holes
/// around them.
fn orbits(
    problem: &RoundingProblem<'_>,
    list: &[Joint],
    plates: &[PlateHoles; 2],
    body: Body,
) -> (Vec<Orbit>, bool) {
    let m = problem.manipulator;
    let holds = |k: usize| problem.holds(list[k]);
    let own: Vec<usize> = (0..list.len()).filter(|k| list[*k].body == body).collect();
    let plate = plate_of(plates, body);
    let staying = |k: usize| {
        plate.hole_at(&place(m, list[k]), k).unwrap_or([i64::MIN, i64::try_from(k).unwrap_or(i64::MAX)])
    };
    if let Some(symmetry) = ThreeFold::of(&places(m, body), m.size()) {
        let turned = |first: usize| -> Option<Orbit> {
            let (second, third) = (symmetry.next[first], symmetry.next[symmetry.next[first]]);
            let members = [first, second, third].map(|k| own[k]);
            if members.iter().any(|k| holds(*k)) {
                // the joints are symmetric as they stand, or not at all
                let stay: Vec<GridHole> = members.iter().map(|k| staying(*k)).collect();
                let all = members.iter().all(|k| holds(*k));
                return all.then(|| Orbit { members: members.to_vec(), choices: vec![stay] });
            }
            let whole = |cell: &GridHole| -> Option<Vec<GridHole>> {
                let at = plate.point(*cell, &place(m, list[members[0]]));
                let next = symmetry.turned(&at);
                let cells = [
                    *cell,
                    plate.hole_at(&next, members[1])?,
                    plate.hole_at(&symmetry.turned(&next), members[2])?,
                ];
                let apart = cells[0] != cells[1] && cells[1] != cells[2] && cells[0] != cells[2];
                apart.then(|| cells.to_vec())
            };
            let around = plate.around(&place(m, list[members[0]]), members[0]);
            let choices: Vec<Vec<GridHole>> = around.iter().filter_map(whole).collect();
            (!choices.is_empty()).then(|| Orbit { members: members.to_vec(), choices })
        };
        let firsts =
            (0..own.len()).filter(|k| *k < symmetry.next[*k] && *k < symmetry.next[symmetry.next[*k]]);
        if let Some(all) = firsts.map(turned).collect::<Option<Vec<Orbit>>>() {
            return (all, true);
        }
    }
    let one = |k: usize| {
        if holds(k) {
            return Orbit { members: vec![k], choices: vec![vec![staying(k)]] };
        }
        let around = plate.around(&place(m, list[k]), k);
        Orbit { members: vec![k], choices: around.into_iter().map(|cell| vec![cell]).collect() }
    };
    (own.into_iter().map(one).collect(), false)
}

/// The holes on placed grids.
struct NearestHoles {
    laying: Laying,
    /// The hole of each joint, or its place next to the nearest hole.
    cells: Vec<GridHole>,
    moved: Vec<Vector3<f64>>,
    not_nearest: usize,
    three_fold: bool,
    rounded: Manipulator,
    evaluation: Evaluation,
    errors: (f64, f64),
    nearest_errors: (f64, f64),
}

impl NearestHoles {
    /// The cost that the search lowers.
    fn cost(&self, length: f64) -> f64 {
        self.errors.0.max(length * self.errors.1)
    }
}

fn search(
    problem: &RoundingProblem<'_>,
    laying: &Laying,
    sensitivities: &[Sensitivity],
) -> Result<NearestHoles, NoRounding> {
    let m = problem.manipulator;
    let list = joints(m);
    let plates = &laying.bodies;
    let [(base, base_turns), (platform, platform_turns)] =
        Body::BOTH.map(|body| orbits(problem, &list, plates, body));
    let orbits: Vec<Orbit> = base.into_iter().chain(platform).collect();
    let moved = |k: usize, cell: GridHole| {
        if problem.holds(list[k]) {
            return Vector3::zeros();
        }
        let target = place(m, list[k]);
        plate_of(plates, list[k].body).point(cell, &target) - target
    };
    let mut cells = vec![[0, 0]; list.len()];
    for orbit in &orbits {
        let nearest = orbit.choices.first().ok_or(NoRounding::JointsCoincide(list[orbit.members[0]].body))?;
        orbit.members.iter().zip(nearest).for_each(|(k, cell)| cells[*k] = *cell);
    }
    let taken = |cells: &[GridHole], members: &[usize], k: usize, cell: GridHole| {
        (0..list.len())
            .any(|i| i != k && !members.contains(&i) && list[i].body == list[k].body && cells[i] == cell)
    };
    if let Some(k) = (0..list.len()).find(|k| taken(&cells, &[], *k, cells[*k])) {
        return Err(NoRounding::JointsCoincide(list[k].body));
    }
    let start = (0..list.len()).map(|k| moved(k, cells[k])).collect();
    let length = problem.characteristic_length;
    let mut state = RoundingErrors { sensitivities, length, cells, moved: start };
    let nearest_errors = state.errors();
    // one joint or orbit at a time, until no change improves the cost
    loop {
        let mut better = false;
        for Orbit { members, choices } in &orbits {
            let sums: Vec<_> = sensitivities.iter().map(|s| s.error(&state.moved)).collect();
            let mut best = state.cost(&sums, &[]);
            let mut chosen = None;
            for choice in choices {
                let places = || members.iter().copied().zip(choice.iter().copied());
                let changed: Vec<_> = places().map(|(k, cell)| (k, moved(k, cell))).collect();
                let cost = state.cost(&sums, &changed);
                let free = places().all(|(k, cell)| !taken(&state.cells, members, k, cell));
                if cost < best * (1.0 - 1e-12) && free {
                    (best, chosen) = (cost, Some((choice, changed)));
                }
            }
            if let Some((choice, changed)) = chosen {
                members.iter().zip(choice).for_each(|(k, cell)| state.cells[*k] = *cell);
                for (k, moved) in changed {
                    state.moved[k] = moved;
                }
                better = true;
            }
        }
        if !better {
            break;
        }
    }
    let off_nearest = |orbit: &&Orbit| {
        orbit.choices.first().is_some_and(|c| c.first() != Some(&state.cells[orbit.members[0]]))
    };
    let rounded = on_cells(problem, plates, &state.cells).ok_or(NoRounding::Singular)?;
    Ok(NearestHoles {
        laying: *laying,
        not_nearest: orbits.iter().filter(off_nearest).map(|orbit| orbit.members.len()).sum(),
        three_fold: base_turns && platform_turns,
        evaluation: evaluate(&rounded, problem, None),
        errors: state.errors(),
        nearest_errors,
        cells: state.cells,
        moved: state.moved,
        rounded,
    })
}

/// The best result on any of the grids, the first of equals; without a result, the reason on the first grid.
pub(super) fn round(
    problem: &RoundingProblem<'_>,
    layings: &[Laying],
    roles: Option<&TrianglesOfBodies>,
) -> Result<NearestRounding, NoRounding> {
    let m = problem.manipulator;
    let sensitivities: Option<Vec<Sensitivity>> =
        problem.poses.iter().map(|pose| Sensitivity::at(m, pose, &problem.tool)).collect();
    let sensitivities = sensitivities.ok_or(NoRounding::SingularPose)?;
    let length = problem.characteristic_length;
    let better = |a: &NearestHoles, b: &NearestHoles| {
        (a.evaluation.met, -a.cost(length)) > (b.evaluation.met, -b.cost(length))
    };
    let all = layings.iter().map(|laying| search(problem, laying, &sensitivities));
    let found = best_of(all, better).unwrap_or(Err(NoRounding::Singular))?;
    let rounded = found.rounded;
    let one = |(k, joint): (usize, &Joint)| RoundedJoint {
        joint: *joint,
        cell: found.laying.grids[joint.body.index()].map(|_| found.cells[k]).filter(|c| c[0] > i64::MIN),
        moved: found.moved[k],
        off_line: roles.and_then(|r| r.off_line(m, *joint, &place(&rounded, *joint))),
    };
    let degrees = |(p, w): (f64, f64)| (p, w.to_degrees());
    let options = FkOptions::new().seed(problem.seed);
    Ok(NearestRounding {
        grids: found.laying.grids,
        joints: joints(m).iter().enumerate().map(one).collect(),
        evaluation: found.evaluation,
        first_order: degrees(found.errors),
        first_order_nearest: degrees(found.nearest_errors),
        solved: solved(problem, &found.moved),
        not_nearest: found.not_nearest,
        three_fold: found.three_fold,
        verification: verify(m, &rounded, &sample_plan(problem), &options),
        manipulator: rounded,
    })
}

/// Errors at random poses, solved.
fn solved(problem: &RoundingProblem<'_>, moved: &[Vector3<f64>]) -> (ErrorSpread, usize) {
    let listed = problem.space.listed(1);
    let one = |k: usize| {
        let pose = problem.space.draw(&listed, &mut Purpose::ROUNDED_POSES.item(problem.seed, k as u64));
        let (p, w) = solved_error(problem.manipulator, moved, &pose, &problem.tool)?;
        Some((p.norm(), w.norm()))
    };
    let found: Vec<(f64, f64)> = (0..problem.trials).filter_map(one).collect();
    (ErrorSpread::of(&found), found.len())
}
