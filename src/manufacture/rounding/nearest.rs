//! Every joint on a grid point next to where it is wanted, chosen for the least error of the pose.

use nalgebra::{Matrix3, Vector3};

use super::exact::Roles;
use super::grid::{BodyGrid, GridHole, length};
use super::{
    Grid, Judgement, Laying, NoRounding, RoundedJoint, RoundingProblem, best_of, grid_of, judge, on_cells,
    place, sample_plan,
};
use crate::equivalence::{Verification, VerifyError, verify};
use crate::fk::FkOptions;
use crate::manipulator::Manipulator;
use crate::manufacture::joint::{Joint, joints};
use crate::manufacture::sensitivity::Sensitivity;
use crate::manufacture::trials::{ErrorSpread, solved_error};
use crate::num::Purpose;

/// A rounding whose joints are near their lines, not on them.
#[derive(Debug, Clone)]
pub struct NearestRounding {
    /// The grids of base and platform, as given or chosen.
    pub grids: [Grid; 2],
    /// The rounded design, joints in the order of the wanted one.
    pub manipulator: Manipulator,
    /// Every joint, in the order of [`joints`].
    pub joints: Vec<RoundedJoint>,
    /// What it is worth.
    pub judgement: Judgement,
    /// Greatest error of the pose over the poses of the problem when the formula of the wanted design is used, to first order: of the tool point
    /// (design units) and of the orientation (degrees).
    pub first_order: (f64, f64),
    /// The same with every joint simply on the nearest grid point.
    pub first_order_nearest: (f64, f64),
    /// The error at random poses of the workspace, solved, and how many there were.
    pub solved: (ErrorSpread, usize),
    /// Joints that are not on the grid point nearest to them.
    pub not_nearest: usize,
    /// Leg map and forward kinematics against the wanted design.
    pub verification: Result<Verification, VerifyError>,
}

/// The errors of the joints and of the poses they cause.
struct State<'a> {
    sensitivities: &'a [Sensitivity],
    length: f64,
    cells: Vec<GridHole>,
    moved: Vec<Vector3<f64>>,
}

impl State<'_> {
    /// Greatest error of the tool point and of the orientation (radians).
    fn errors(&self) -> (f64, f64) {
        let norms = self.sensitivities.iter().map(|s| s.error(&self.moved));
        norms.fold((0.0, 0.0), |m, (p, w)| (f64::max(m.0, p.norm()), f64::max(m.1, w.norm())))
    }

    /// Greatest over the poses of the larger of both, the angle times the characteristic length, with joint `k` at another place.
    fn cost(&self, sums: &[(Vector3<f64>, Vector3<f64>)], k: usize, moved: &Vector3<f64>) -> f64 {
        let change = moved - self.moved[k];
        let one = |(s, (p, w)): (&Sensitivity, &(Vector3<f64>, Vector3<f64>))| {
            let with = |g: &[Matrix3<f64>], sum: &Vector3<f64>| (sum + g[k] * change).norm();
            with(&s.position, p).max(self.length * with(&s.rotation, w))
        };
        self.sensitivities.iter().zip(sums).map(one).fold(0.0, f64::max)
    }
}

/// The four cells around a place, nearest first.
fn around(grid: &BodyGrid, m: &Manipulator, joint: Joint) -> [GridHole; 4] {
    let at = grid.coordinates(&place(m, joint));
    let low = at.map(|x| x.floor() as i64);
    let mut out = [[0, 0], [1, 0], [0, 1], [1, 1]].map(|d: [i64; 2]| [low[0] + d[0], low[1] + d[1]]);
    let distance = |c: &GridHole| length([c[0] as f64 - at[0], c[1] as f64 - at[1]], grid.skew());
    out.sort_by(|a, b| distance(a).total_cmp(&distance(b)).then(a.cmp(b)));
    out
}

/// The holes on grids that are laid.
struct NearestHoles {
    laying: Laying,
    /// For every joint its hole, and where it is next to the nearest.
    cells: Vec<GridHole>,
    moved: Vec<Vector3<f64>>,
    not_nearest: usize,
    rounded: Manipulator,
    judgement: Judgement,
    errors: (f64, f64),
    nearest_errors: (f64, f64),
}

impl NearestHoles {
    /// What is lowered.
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
    let grids = &laying.bodies;
    let choices: Vec<[GridHole; 4]> = list.iter().map(|j| around(grid_of(grids, j.body), m, *j)).collect();
    let moved = |k: usize, cell: GridHole| grid_of(grids, list[k].body).point(cell) - place(m, list[k]);
    let cells: Vec<GridHole> = choices.iter().map(|c| c[0]).collect();
    let taken = |cells: &[GridHole], k: usize, cell: GridHole| {
        (0..list.len()).any(|i| i != k && list[i].body == list[k].body && cells[i] == cell)
    };
    if let Some(k) = (0..list.len()).find(|k| taken(&cells, *k, cells[*k])) {
        return Err(NoRounding::JointsCoincide(list[k].body));
    }
    let start = (0..list.len()).map(|k| moved(k, cells[k])).collect();
    let length = problem.characteristic_length;
    let mut state = State { sensitivities, length, cells, moved: start };
    let nearest_errors = state.errors();
    // one joint at a time, until no joint can do better
    loop {
        let mut better = false;
        for k in 0..list.len() {
            let sums: Vec<_> = sensitivities.iter().map(|s| s.error(&state.moved)).collect();
            let mut best = state.cost(&sums, k, &state.moved[k]);
            let mut cell = state.cells[k];
            for other in choices[k] {
                let cost = state.cost(&sums, k, &moved(k, other));
                if cost < best * (1.0 - 1e-12) && !taken(&state.cells, k, other) {
                    (best, cell) = (cost, other);
                }
            }
            if cell != state.cells[k] {
                state.cells[k] = cell;
                state.moved[k] = moved(k, cell);
                better = true;
            }
        }
        if !better {
            break;
        }
    }
    let rounded = on_cells(m, grids, &state.cells).ok_or(NoRounding::Singular)?;
    Ok(NearestHoles {
        laying: *laying,
        not_nearest: state.cells.iter().zip(&choices).filter(|(cell, c)| **cell != c[0]).count(),
        judgement: judge(&rounded, problem, None),
        errors: state.errors(),
        nearest_errors,
        cells: state.cells,
        moved: state.moved,
        rounded,
    })
}

/// The best answer on any of the grids, the first ones where several are equally good; what stands against the first where there is none.
pub(super) fn round(
    problem: &RoundingProblem<'_>,
    layings: &[Laying],
    roles: Option<&Roles>,
) -> Result<NearestRounding, NoRounding> {
    let m = problem.manipulator;
    let sensitivities: Option<Vec<Sensitivity>> =
        problem.poses.iter().map(|pose| Sensitivity::at(m, pose, &problem.tool)).collect();
    let sensitivities = sensitivities.ok_or(NoRounding::SingularPose)?;
    let length = problem.characteristic_length;
    let better = |a: &NearestHoles, b: &NearestHoles| {
        (a.judgement.met, -a.cost(length)) > (b.judgement.met, -b.cost(length))
    };
    let all = layings.iter().map(|laying| search(problem, laying, &sensitivities));
    let found = best_of(all, better).unwrap_or(Err(NoRounding::Singular))?;
    let rounded = found.rounded;
    let one = |(k, joint): (usize, &Joint)| RoundedJoint {
        joint: *joint,
        cell: found.cells[k],
        moved: found.moved[k],
        off_line: roles.and_then(|r| r.off_line(m, *joint, &place(&rounded, *joint))),
    };
    let degrees = |(p, w): (f64, f64)| (p, w.to_degrees());
    let options = FkOptions { seed: problem.seed, ..FkOptions::default() };
    Ok(NearestRounding {
        grids: found.laying.grids,
        joints: joints(m).iter().enumerate().map(one).collect(),
        judgement: found.judgement,
        first_order: degrees(found.errors),
        first_order_nearest: degrees(found.nearest_errors),
        solved: solved(problem, &found.moved),
        not_nearest: found.not_nearest,
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
