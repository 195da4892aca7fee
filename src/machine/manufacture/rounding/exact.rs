//! All joints on the grid and exactly on the lines of two triangles: corners stay corners, and the others lie on sides.

use nalgebra::{Point3, Vector3};

use super::grid::{
    BodyGrid, GridHole, GridTriangle, POOL, TargetPlaces, TrianglePool, length, pool, three_fold_pool,
};
use super::{
    Evaluation, Grid, Keeping, Laying, NoRounding, PlateHoles, RoundedJoint, RoundingProblem, best_of,
    evaluate, objective_above, on_cells, place, plate_of, sample_plan,
};
use crate::manufacture::correction::octahedral_of;
use crate::manufacture::joint::{Joint, joints};
use fk::FkOptions;
use num::exact::{self, ExactVector, product, rational};
use platform::manipulator::{Body, Manipulator, Octahedral};
use synthesis::offset_determinant;
use synthesis::singularity::GriffisDuffy;
use verify::{Verification, VerifyError, verify};

/// The triangles of base and platform.
#[derive(Debug, Clone)]
pub(super) struct TrianglesOfBodies {
    /// Corners by body.
    pub(super) corners: [[Joint; 3]; 2],
    /// Joints on the sides by body: `inner[b][k]` on the side from corner `k` to corner `k + 1`. Absent for the
    /// octahedral platform.
    pub(super) inner: Option<[[Joint; 3]; 2]>,
    /// The legs round the hexagon, for a platform with joints on the sides.
    pub(super) found: Option<GriffisDuffy>,
}

impl TrianglesOfBodies {
    /// `None` for a design that is neither octahedral nor has six joints on each body, one on each side of two
    /// triangles.
    pub(super) fn of(m: &Manipulator) -> Option<Self> {
        let of = |body| move |index| Joint { body, index };
        if let Ok(o) = Octahedral::recognise(m) {
            let corners =
                [o.base_indices().map(of(Body::Base)), o.platform_indices().map(of(Body::Platform))];
            return Some(Self { corners, inner: None, found: None });
        }
        if joints(m).len() != 12 {
            return None;
        }
        let found = GriffisDuffy::recognise(m)?;
        let pairs = m.pairs();
        let base = |legs: [usize; 3]| legs.map(|k| of(Body::Base)(pairs[found.order[k]].0));
        let platform = |legs: [usize; 3]| legs.map(|k| of(Body::Platform)(pairs[found.order[k]].1));
        Some(Self {
            corners: [base([5, 1, 3]), platform([0, 2, 4])],
            inner: Some([base([0, 2, 4]), platform([1, 3, 5])]),
            found: Some(found),
        })
    }

    /// `det A` of a platform with these roles: 1 for the octahedral one.
    pub(super) fn determinant(&self, m: &Manipulator) -> f64 {
        let Some(inner) = &self.inner else { return 1.0 };
        let t = |k: usize| {
            let (corners, joint) = (&self.corners[k % 2], inner[k % 2][k / 2]);
            let (from, to) = (place(m, corners[k / 2]), place(m, corners[(k / 2 + 1) % 3]));
            let side = to - from;
            (place(m, joint) - from).dot(&side) / side.norm_squared()
        };
        offset_determinant(&std::array::from_fn(t))
    }

    /// Distance of a joint on a side from the line of the side, on `m`; `at` is where the joint is.
    pub(super) fn off_line(&self, m: &Manipulator, joint: Joint, at: &Point3<f64>) -> Option<f64> {
        for (corners, inner) in self.corners.iter().zip(self.inner.as_ref()?) {
            if let Some(k) = inner.iter().position(|j| *j == joint) {
                let from = place(m, corners[k]);
                let along: Vector3<f64> = (place(m, corners[(k + 1) % 3]) - from).normalize();
                return Some((at - from).cross(&along).norm());
            }
        }
        None
    }
}

/// Joints may be this share of the shortest side off their places.
const REACH_SHARE: f64 = 0.3;
/// Greatest shift of a joint, pitches.
const REACH: f64 = 12.0;

/// A rounding that is exactly equivalent to an octahedral platform.
#[derive(Debug, Clone)]
pub struct ExactRounding {
    /// The grids of base and platform, as given or chosen.
    pub grids: [Option<Grid>; 2],
    /// The rounded design, joints in the order of the given one.
    pub manipulator: Manipulator,
    /// The octahedral platform on its triangles.
    pub octahedral: Manipulator,
    /// Parts of the sides and where the joints are on them, in the order of the hexagon (base and platform
    /// alternately): `t_k = inner / parts`. `None` for the octahedral platform itself.
    pub fractions: Option<[(i64, i64); 6]>,
    /// Every joint, in the order of [`joints`].
    pub joints: Vec<RoundedJoint>,
    /// The evaluation of the rounded design.
    pub evaluation: Evaluation,
    /// Whether exact rational arithmetic on the holes shows: six independent legs in the span of six independent
    /// octahedral legs.
    pub proved: bool,
    /// Whether rotations by 120 degrees at home map the triangles of both bodies with their joints to themselves.
    /// Triangular grids keep this symmetry.
    pub three_fold: bool,
    /// Triangles of each body in the search.
    pub pool: [usize; 2],
    /// All triangles with joints within this distance of their places were in the search, base and platform, design
    /// units.
    pub complete_to: [f64; 2],
    /// Replacements of one body's triangle by a better one after the first search.
    pub replacements: usize,
    /// Leg map and forward kinematics compared with `octahedral`.
    pub verification: Result<Verification, VerifyError>,
}

/// A pair of triangles with its objective.
#[derive(Debug, Clone, Copy)]
struct TrianglePair {
    triangles: [GridTriangle; 2],
    objective: f64,
}

struct ExactRoundingSearch<'a> {
    problem: &'a RoundingProblem<'a>,
    plates: [PlateHoles; 2],
    roles: &'a TrianglesOfBodies,
    list: Vec<Joint>,
    /// Combinations below this share of the requirements are skipped.
    least: Keeping,
    hint: usize,
}

fn cells(roles: &TrianglesOfBodies, list: &[Joint], triangles: &[GridTriangle; 2]) -> Vec<GridHole> {
    let cell = |joint: &Joint| {
        let body = joint.body.index();
        let corner = roles.corners[body].iter().position(|j| j == joint);
        let inner = roles.inner.and_then(|i| i[body].iter().position(|j| j == joint));
        match (corner, inner) {
            (Some(k), _) => triangles[body].corners[k],
            (None, Some(k)) => triangles[body].joint(k),
            (None, None) => [0, 0],
        }
    };
    list.iter().map(cell).collect()
}

impl ExactRoundingSearch<'_> {
    fn build(&self, triangles: &[GridTriangle; 2]) -> Option<Manipulator> {
        if self.roles.inner.is_some() && determinant_numerator(triangles) == Some(0) {
            return None;
        }
        on_cells(self.problem, &self.plates, &cells(self.roles, &self.list, triangles))
    }

    /// The pair, if its objective is above `floor` and it keeps enough of the requirements.
    fn better(&mut self, triangles: [GridTriangle; 2], floor: f64) -> Option<TrianglePair> {
        let m = self.build(&triangles)?;
        let mut hint = self.hint;
        let objective = objective_above(&m, self.problem, floor, &mut hint);
        self.hint = hint;
        let objective = objective?;
        let reached = self.least == Keeping::Nothing
            || evaluate(&m, self.problem, Some(self.roles.determinant(&m))).keeping() >= self.least;
        reached.then_some(TrianglePair { triangles, objective })
    }

    /// The best combination of the first `count` triangles of each body. Replacing one triangle by any of its pool then
    /// improves it until none is better.
    fn run(&mut self, pools: &[TrianglePool; 2], count: usize) -> Option<(TrianglePair, usize)> {
        let floor = |best: &Option<TrianglePair>| best.map_or(0.0, |b| b.objective);
        let mut best: Option<TrianglePair> = None;
        for a in pools[0].triangles.iter().take(count) {
            for b in pools[1].triangles.iter().take(count) {
                best = self.better([*a, *b], floor(&best)).or(best);
            }
        }
        // if the nearest triangles give nothing, combine all of one body with the nearest of the other
        if best.is_none() {
            for (body, pool) in pools.iter().enumerate() {
                for t in &pool.triangles {
                    let mut triangles = [pools[0].triangles[0], pools[1].triangles[0]];
                    triangles[body] = *t;
                    best = self.better(triangles, floor(&best)).or(best);
                }
            }
        }
        let mut best = best?;
        let mut replacements = 0;
        loop {
            let before = replacements;
            for (body, pool) in pools.iter().enumerate() {
                let start = best;
                for t in &pool.triangles {
                    let mut triangles = start.triangles;
                    triangles[body] = *t;
                    best = self.better(triangles, best.objective).unwrap_or(best);
                }
                replacements += usize::from(best.objective > start.objective);
            }
            if replacements == before {
                return Some((best, replacements));
            }
        }
    }
}

/// `det A` times the product of the parts, exactly; `None` on overflow.
fn determinant_numerator(triangles: &[GridTriangle; 2]) -> Option<i128> {
    let sides = || triangles.iter().flat_map(|t| t.parts.into_iter().zip(t.inner));
    let product = |factor: fn((i64, i64)) -> i64| {
        sides().map(factor).try_fold(1i128, |p, x| p.checked_mul(i128::from(x)))
    };
    product(|(n, k)| n - k)?.checked_sub(product(|(_, k)| k)?)
}

/// Exact rank of legs between holes: `(1, i, j) (x) (1, k, l)`.
pub(super) fn rank(legs: &[(GridHole, GridHole)]) -> Option<usize> {
    let number = |x: i64| rational(x as f64);
    let point = |c: &GridHole| -> Option<ExactVector> { [1, c[0], c[1]].into_iter().map(number).collect() };
    let row = |(a, b): &(GridHole, GridHole)| Some(product(&point(a)?, &point(b)?));
    Some(exact::rank(&legs.iter().map(row).collect::<Option<Vec<_>>>()?))
}

/// Whether the six legs span the same space as the octahedral legs between the corners, which has dimension six.
pub(super) fn proved(
    m: &Manipulator,
    list: &[Joint],
    cells: &[GridHole],
    corners: &[[GridHole; 3]; 2],
) -> bool {
    let cell = |body, index| list.iter().position(|j| *j == Joint { body, index }).map(|k| cells[k]);
    let legs: Option<Vec<(GridHole, GridHole)>> =
        m.pairs().iter().map(|p| Some((cell(Body::Base, p.0)?, cell(Body::Platform, p.1)?))).collect();
    let Some(legs) = legs else { return false };
    let [a, b] = corners;
    let octahedral: Vec<(GridHole, GridHole)> =
        [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)].map(|(i, j)| (a[i], b[j])).to_vec();
    let both: Vec<_> = legs.iter().chain(&octahedral).copied().collect();
    [&legs, &octahedral, &both].into_iter().all(|list| rank(list) == Some(6))
}

/// The given places of the roles on a grid.
pub(super) fn target(
    m: &Manipulator,
    roles: &TrianglesOfBodies,
    grid: &BodyGrid,
    body: usize,
) -> TargetPlaces {
    let at = |j: Joint| grid.coordinates(&place(m, j));
    TargetPlaces {
        corners: roles.corners[body].map(at),
        inner: roles.inner.map(|i| i[body].map(at)),
        skew: grid.skew(),
    }
}

/// Greatest reach of a pool, pitches.
pub(super) fn limit(w: &TargetPlaces) -> f64 {
    let side = |k: usize| {
        let (p, q) = (w.corners[k], w.corners[(k + 1) % 3]);
        length([p[0] - q[0], p[1] - q[1]], w.skew)
    };
    (REACH_SHARE * side(0).min(side(1)).min(side(2))).min(REACH)
}

/// The role of a joint on a triangle.
#[derive(Debug, Clone, Copy)]
enum TriangleRole {
    Corner(usize),
    OnSide(usize),
}

impl TriangleRole {
    fn cell(self, t: &GridTriangle) -> GridHole {
        match self {
            Self::Corner(k) => t.corners[k],
            Self::OnSide(k) => t.joint(k),
        }
    }
}

/// The joints of a body that stay, with their holes.
fn held(
    problem: &RoundingProblem<'_>,
    roles: &TrianglesOfBodies,
    plate: &PlateHoles,
    body: usize,
) -> Vec<(TriangleRole, Option<GridHole>)> {
    let corners = (0..3).map(|k| (roles.corners[body][k], TriangleRole::Corner(k)));
    let inner = roles.inner.iter().flat_map(|i| (0..3).map(|k| (i[body][k], TriangleRole::OnSide(k))));
    let staying = corners.chain(inner).filter(|(joint, _)| problem.holds(*joint));
    staying
        .map(|(joint, role)| (role, plate.hole_at(&place(problem.manipulator, joint), joint.index)))
        .collect()
}

/// The best pair of triangles on given grids, and the course of the search.
struct BestTriangles {
    laying: Laying,
    pitches: [f64; 2],
    pools: [TrianglePool; 2],
    best: TrianglePair,
    replacements: usize,
    three_fold: bool,
    /// The kept share of the requirements.
    keeping: Keeping,
}

fn search(
    problem: &RoundingProblem<'_>,
    laying: &Laying,
    roles: &TrianglesOfBodies,
) -> Result<BestTriangles, NoRounding> {
    let m = problem.manipulator;
    let count = problem.candidates.max(1);
    let lattice = |body: Body| laying.bodies[body.index()].lattice().ok_or(NoRounding::NoLines(body));
    let grids = [*lattice(Body::Base)?, *lattice(Body::Platform)?];
    let all = [0, 1].map(|body| target(m, roles, &grids[body], body));
    // a rotationally symmetric design keeps its symmetry if both grids have symmetric triangles
    let turning = all.each_ref().map(|w| three_fold_pool(w, limit(w)).filter(|p| !p.triangles.is_empty()));
    let held = [0, 1].map(|body| held(problem, roles, &laying.bodies[body], body));
    // only few triangles pass through given holes
    let wide = held.each_ref().map(|list| if list.is_empty() { count } else { POOL });
    let (mut pools, three_fold) = match turning {
        [Some(base), Some(platform)] => ([base, platform], true),
        _ => ([0, 1].map(|k| pool(&all[k], wide[k], limit(&all[k]))), false),
    };
    for (k, pool) in pools.iter_mut().enumerate() {
        pool.triangles.retain(|t| held[k].iter().all(|(role, hole)| Some(role.cell(t)) == *hole));
    }
    for (body, pool) in Body::BOTH.into_iter().zip(&pools) {
        if pool.triangles.is_empty() {
            return Err(NoRounding::NoTriangleNear(body));
        }
    }
    let mut search = ExactRoundingSearch {
        problem,
        plates: laying.bodies,
        roles,
        list: joints(m),
        least: Keeping::SafetyMargin,
        hint: 0,
    };
    let mut found = None;
    let target =
        if problem.requirements.safety_margins.is_empty() { &Keeping::ALL[1..] } else { &Keeping::ALL };
    for least in target {
        search.least = *least;
        found = search.run(&pools, count).map(|(best, replacements)| (best, replacements, *least));
        if found.is_some() {
            break;
        }
    }
    let (best, replacements, keeping) = found.ok_or(NoRounding::Singular)?;
    Ok(BestTriangles {
        laying: *laying,
        pitches: grids.map(|g| g.pitch()),
        pools,
        best,
        replacements,
        three_fold,
        keeping,
    })
}

/// The best result on any of the grids, the first of equals; without a result, the reason on the first grid.
pub(super) fn round(
    problem: &RoundingProblem<'_>,
    layings: &[Laying],
    roles: &TrianglesOfBodies,
) -> Result<ExactRounding, NoRounding> {
    let better =
        |a: &BestTriangles, b: &BestTriangles| (a.keeping, a.best.objective) > (b.keeping, b.best.objective);
    let found = best_of(layings.iter().map(|laying| search(problem, laying, roles)), better);
    finish(problem, roles, &found.unwrap_or(Err(NoRounding::Singular))?)
}

fn finish(
    problem: &RoundingProblem<'_>,
    roles: &TrianglesOfBodies,
    found: &BestTriangles,
) -> Result<ExactRounding, NoRounding> {
    let (m, best, plates, pools) = (problem.manipulator, &found.best, &found.laying.bodies, &found.pools);
    let list = joints(m);
    let cells = cells(roles, &list, &best.triangles);
    let rounded = on_cells(problem, plates, &cells).ok_or(NoRounding::Singular)?;
    let octahedral = match &roles.found {
        Some(found) => octahedral_of(&rounded, found).map_err(|_| NoRounding::Singular)?,
        None => rounded.clone(),
    };
    let options = FkOptions::new().seed(problem.seed);
    let fraction = |k: usize| {
        let t = &best.triangles[k % 2];
        (t.inner[k / 2], t.parts[k / 2])
    };
    Ok(ExactRounding {
        grids: found.laying.grids,
        fractions: roles.inner.is_some().then(|| std::array::from_fn(fraction)),
        joints: rounded_joints(m, &rounded, roles, plates, &cells),
        evaluation: evaluate(&rounded, problem, Some(roles.determinant(&rounded))),
        proved: proved(m, &list, &cells, &[best.triangles[0].corners, best.triangles[1].corners]),
        three_fold: found.three_fold,
        pool: [0, 1].map(|k| pools[k].triangles.len()),
        complete_to: [0, 1].map(|k| pools[k].complete_to * found.pitches[k]),
        replacements: found.replacements,
        verification: verify(&octahedral, &rounded, &sample_plan(problem), &options),
        octahedral,
        manipulator: rounded,
    })
}

fn rounded_joints(
    m: &Manipulator,
    rounded: &Manipulator,
    roles: &TrianglesOfBodies,
    plates: &[PlateHoles; 2],
    cells: &[GridHole],
) -> Vec<RoundedJoint> {
    let one = |(joint, cell): (Joint, &GridHole)| {
        let at = plate_of(plates, joint.body).point(*cell, &place(m, joint));
        let off_line = roles.off_line(rounded, joint, &at);
        RoundedJoint { joint, cell: Some(*cell), moved: at - place(m, joint), off_line }
    };
    joints(m).into_iter().zip(cells).map(one).collect()
}
