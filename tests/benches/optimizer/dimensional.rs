//! The judge of problems with requirements: builds the platform and searches for its worst poses with code that the
//! optimiser does not use.

use std::collections::BTreeMap;
use std::sync::RwLock;

use equipod::methods::dimensional::{DimensionalProblem, DimensionalSolution, Triangles};
use equipod::methods::geom::Pose;
use equipod::methods::manipulator::{Leg, LegIndex, Manipulator, Octahedral, inverse_condition, jacobian};
use equipod::methods::num::Rng;
use equipod::methods::requirements::Objective;
use equipod::methods::requirements::{
    AssessOptions, JointAxes, PoseSpace, Quantity, Requirements, Term, TermKind, Terms, assess, leg_forces,
};
use nalgebra::{Point3, Unit, Vector3, Vector6};

use crate::cap;
use crate::judge::Judge;
use crate::region::descend;
use crate::verdict::Judged;

/// Requirements are held with this share of the size or of their limit to spare, as the optimiser does.
const SPARE: f64 = 1e-6;
/// Points (and as many random ones) of a check, and of the last judgement.
const CHECKED: usize = 200;
const JUDGED: usize = 3000;
/// Margins below this share are searched for worse ones.
const CLOSE: f64 = 0.03;
/// Points for each start of a search for the worst pose of an objective.
const POINTS_A_SEARCH: usize = 60;

/// The number of terms in the sum of an objective, each the least over the poses; 0: not known to this judge.
pub(crate) fn components(o: Objective) -> usize {
    match o {
        Objective::WorstConditioning | Objective::LegForce | Objective::Stiffness => 1,
        Objective::Stroke => 2,
        _ => 0,
    }
}

/// A platform with its home and its requirements, axes chosen.
#[derive(Debug, Clone)]
pub(crate) struct Built {
    manipulator: Manipulator,
    requirements: Requirements,
    home: Pose,
}

/// The judge.
#[derive(Debug)]
pub(crate) struct DimensionalJudge {
    problem: DimensionalProblem,
    octahedral: Option<Octahedral>,
    bounds: Vec<(f64, f64)>,
    /// Way of home for a unit of height.
    lift: Vector3<f64>,
    /// Points of the cube of poses to examine; worse ones that are found join them.
    held: RwLock<Vec<Vector6<f64>>>,
    /// Least value of an earlier objective.
    floor: Option<(Objective, f64)>,
    size: f64,
}

fn upwards(m: &Manipulator, home: &Pose) -> Vector3<f64> {
    let points = m.legs().map(|l| l.base.coords);
    let centre = points.iter().sum::<Vector3<f64>>() / 6.0;
    let spread: nalgebra::Matrix3<f64> = points.iter().map(|p| (p - centre) * (p - centre).transpose()).sum();
    let e = spread.symmetric_eigen();
    let n: Vector3<f64> = e.eigenvectors.column(e.eigenvalues.imin()).into();
    let tips = m.legs().map(|l| home.transform(&l.platform).coords).iter().sum::<Vector3<f64>>() / 6.0;
    if n.dot(&(tips - centre)) < 0.0 { -n } else { n }
}

impl DimensionalJudge {
    pub(crate) fn new(problem: &DimensionalProblem) -> Self {
        let v = &problem.variables;
        let m = &problem.manipulator;
        let mut bounds = Vec::new();
        if v.offsets {
            bounds.extend_from_slice(&v.offset_bounds[..if v.symmetric { 2 } else { 6 }]);
        }
        if v.triangles == Triangles::Sizes {
            bounds.extend([v.stretch_bounds; 2]);
        }
        if v.home_height {
            bounds.push(v.height_bounds);
        }
        let mut held = problem.space.cube_points(12, &mut Rng::new(0x6865));
        held.truncate(80);
        Self {
            octahedral: Octahedral::recognise(m).ok(),
            bounds,
            lift: upwards(m, &problem.space.home) * m.size(),
            held: RwLock::new(held),
            floor: None,
            size: m.size(),
            problem: problem.clone(),
        }
    }

    /// The last objective is judged; earlier ones are held at the values of this platform.
    pub(crate) fn hold_earlier(&mut self, built: &Built) {
        if let [.., (earlier, _), _] = self.problem.objectives[..] {
            self.floor = Some((earlier, self.worst(built, earlier, JUDGED).0));
        }
    }

    fn objective(&self) -> Objective {
        self.problem.objectives.last().map_or(Objective::WorstConditioning, |o| o.0)
    }

    fn space(&self, home: Pose) -> PoseSpace {
        self.problem.space.with_home(home)
    }

    /// Poses that are examined: listed ones, and those of the held points.
    fn poses(&self, home: Pose) -> Vec<Pose> {
        let space = self.space(home);
        let held = self.held.read().map(|h| h.clone()).unwrap_or_default();
        held.iter().map(|x| space.pose(x)).chain(space.listed(4)).collect()
    }

    fn legs(&self, x: &[f64]) -> [Leg; 6] {
        let v = &self.problem.variables;
        let Some(o) = self.octahedral.as_ref().filter(|_| v.offsets || v.triangles != Triangles::Fixed)
        else {
            return self.problem.manipulator.legs();
        };
        let count = match (v.offsets, v.symmetric) {
            (false, _) => 0,
            (true, true) => 2,
            (true, false) => 6,
        };
        let t: [f64; 6] = std::array::from_fn(|i| if count == 0 { 0.0 } else { x[i % count] });
        let sized = |triangle: [Point3<f64>; 3], k: usize| {
            let factor = if v.triangles == Triangles::Sizes { 1.0 + x[count + k] } else { 1.0 };
            let centre = triangle.iter().map(|p| p.coords).sum::<Vector3<f64>>() / 3.0;
            triangle.map(|p| Point3::from(centre + (p.coords - centre) * factor))
        };
        let (base, platform) = (sized(o.base(), 0), sized(o.platform(), 1));
        let mut legs = self.problem.manipulator.legs();
        for (i, leg) in o.order().map(LegIndex::get).into_iter().enumerate() {
            let (k, next) = (i / 2, (i / 2 + 1) % 3);
            let between = |w: &[Point3<f64>; 3]| Point3::from(w[k].coords.lerp(&w[next].coords, t[i]));
            legs[leg] = if i % 2 == 0 {
                Leg { base: between(&base), platform: platform[k] }
            } else {
                Leg { base: base[next], platform: between(&platform) }
            };
        }
        legs
    }

    /// The platform at these variables; `None` when they make none. Chosen axes are the centres of the smallest caps.
    pub(crate) fn build(&self, x: &[f64]) -> Option<Built> {
        let legs = self.legs(x);
        let manipulator = Manipulator::from_legs(legs).ok()?;
        let mut home = self.problem.space.home;
        if self.problem.variables.home_height {
            home.position += self.lift * *x.last()?;
        }
        let mut requirements = self.problem.requirements.clone();
        let hardware = &mut requirements.hardware;
        let cone_angles = [&mut hardware.base_cone_angle, &mut hardware.platform_cone_angle];
        for (body, cone_angle) in cone_angles.into_iter().enumerate() {
            let Some(cone_angle) = cone_angle else { continue };
            if self.problem.variables.joint_axes[body] || cone_angle.axes == JointAxes::Optimize {
                let poses = self.poses(home);
                let axis = |leg: &Leg| {
                    let along = |pose: &Pose| {
                        let line = (pose.transform(&leg.platform) - leg.base).normalize();
                        if body == 0 { line } else { pose.rotation.inverse() * line }
                    };
                    let all: Vec<Vector3<f64>> = poses.iter().map(along).collect();
                    Unit::new_normalize(cap::centre(&all))
                };
                cone_angle.axes = JointAxes::Given(legs.each_ref().map(axis));
            }
        }
        Some(Built { manipulator, requirements, home })
    }

    /// The optimiser's platform; an error when the variables of this judge do not build the same.
    pub(crate) fn built_of(&self, s: &DimensionalSolution) -> Result<Built, String> {
        let own = self.build(&s.point[..self.bounds.len()]).ok_or("no platform")?;
        let apart = |a: &Leg, b: &Leg| (a.base - b.base).norm().max((a.platform - b.platform).norm());
        let legs = own.manipulator.legs();
        let far = legs.iter().zip(&s.manipulator.legs()).map(|(a, b)| apart(a, b)).fold(0.0, f64::max);
        let lifted = (own.home.position - s.home.position).norm();
        if far.max(lifted) > 1e-9 * self.size {
            return Err(format!("the variables build another platform: {far:.1e}, {lifted:.1e}"));
        }
        let mut built = Built { manipulator: s.manipulator.clone(), home: s.home, ..own };
        let hardware = &mut built.requirements.hardware;
        for (cone_angle, axes) in
            [(&mut hardware.base_cone_angle, s.axes[0]), (&mut hardware.platform_cone_angle, s.axes[1])]
        {
            if let (Some(cone_angle), Some(axes)) = (cone_angle, axes) {
                cone_angle.axes = JointAxes::Given(axes);
            }
        }
        Ok(built)
    }

    /// A margin in shares of the size or of its limit.
    fn share(&self, (term, margin): &(Term, f64)) -> f64 {
        let h = &self.problem.requirements.hardware;
        let scale = match term.kind.quantity() {
            Quantity::Length => self.size,
            Quantity::Angle => 90.0,
            Quantity::Force => h.max_leg_force.unwrap_or(1.0),
            Quantity::Speed => h.max_leg_speed.unwrap_or(1.0),
            _ => self.problem.requirements.least_stiffness_of(term.kind).unwrap_or(1.0),
        };
        margin / scale
    }

    /// Margins of `|det A|` and earlier objectives, which do not belong to single poses of the requirements.
    fn other_margins(&self, x: &[f64], built: &Built) -> f64 {
        let v = &self.problem.variables;
        let mut least = f64::INFINITY;
        if v.offsets {
            let t = |i: usize| if v.symmetric { x[i % 2] } else { x[i] };
            let det = (0..6).map(|i| 1.0 - t(i)).product::<f64>() - (0..6).map(t).product::<f64>();
            least = det.abs() - self.problem.min_abs_det - SPARE;
        }
        if let Some((o, floor)) = self.floor {
            least = least.min((self.held_value(built, o) - floor) / floor.abs());
        }
        least
    }

    /// Terms of the objective at a pose.
    fn terms(&self, built: &Built, o: Objective, pose: &Pose) -> [f64; 2] {
        let (m, p) = (&built.manipulator, &self.problem);
        match o {
            Objective::WorstConditioning => {
                [inverse_condition(&jacobian(m, pose, p.characteristic_length)), 0.0]
            }
            Objective::Stiffness => {
                let s = jacobian(m, pose, p.characteristic_length).singular_values().min();
                [p.requirements.hardware.leg_stiffness.unwrap_or(0.0) * s * s, 0.0]
            }
            Objective::LegForce => {
                let force = |load: &equipod::methods::requirements::Load| {
                    leg_forces(m, pose, &load.wrench(m, pose), m.size()).map_or(f64::INFINITY, |f| f.amax())
                };
                [-p.requirements.loads.iter().map(force).fold(0.0, f64::max), 0.0]
            }
            _ => {
                let lengths = m.legs().map(|l| pose.squared_length(&l).sqrt());
                let most = lengths.iter().copied().fold(0.0, f64::max);
                [-most, lengths.into_iter().fold(f64::INFINITY, f64::min)]
            }
        }
    }

    fn held_value(&self, built: &Built, o: Objective) -> f64 {
        let mut least = [f64::INFINITY; 2];
        for pose in self.poses(built.home) {
            let here = self.terms(built, o, &pose);
            least = [least[0].min(here[0]), least[1].min(here[1])];
        }
        least[0] + least[1]
    }

    /// The objective over all poses, by searches from the worst of many points, with the worst points.
    fn worst(&self, built: &Built, o: Objective, points: usize) -> (f64, Vec<Vector6<f64>>) {
        let space = self.space(built.home);
        let mut rng = Rng::new(0x776f);
        let mut cube = space.cube_points(points, &mut rng);
        cube.extend(self.held.read().map(|h| h.clone()).unwrap_or_default());
        let (mut sum, mut found) = (0.0, Vec::new());
        for c in 0..components(o) {
            let at = |x: &Vector6<f64>| self.terms(built, o, &space.pose(x))[c];
            let mut rated: Vec<(f64, Vector6<f64>)> = cube.iter().map(|x| (at(x), *x)).collect();
            rated.sort_by(|a, b| a.0.total_cmp(&b.0));
            rated.truncate(3 + points / POINTS_A_SEARCH);
            let mut least =
                space.listed(10).iter().map(|p| self.terms(built, o, p)[c]).fold(f64::INFINITY, f64::min);
            for (value, x) in rated {
                let (value, x) = descend(&at, value, x, &space.axes(), &mut rng);
                if value < least {
                    least = value;
                    found.push(x);
                }
            }
            sum += least;
        }
        (sum, found)
    }

    /// The least margin over all poses in shares, and the points with a violation. It searches for every leg and pair
    /// that comes close to its limit.
    fn least_margin(&self, built: &Built, points: usize) -> (f64, Vec<Vector6<f64>>) {
        let space = self.space(built.home);
        let mut rng = Rng::new(0x6c6d);
        let terms = Terms::new(&built.manipulator, &built.requirements, &built.home);
        let mut worst: BTreeMap<Term, (f64, Vector6<f64>)> = BTreeMap::new();
        let held = self.held.read().map(|h| h.clone()).unwrap_or_default();
        for x in space.cube_points(points, &mut rng).into_iter().chain(held) {
            for t in terms.at(&space.pose(&x)) {
                let own = worst.entry(t.0).or_insert((f64::INFINITY, x));
                let share = self.share(&t);
                if !(share >= own.0) {
                    *own = (share, x);
                }
            }
        }
        let listed = space.listed(10);
        let apart = terms.fixed().into_iter().chain(listed.iter().flat_map(|p| terms.at(p)));
        let mut least = apart.map(|t| self.share(&t)).fold(f64::INFINITY, f64::min);
        let mut violated = Vec::new();
        for (term, (share, x)) in worst {
            let at = |x: &Vector6<f64>| {
                let own = terms.at(&space.pose(x)).into_iter().find(|t| t.0 == term);
                own.map_or(f64::INFINITY, |t| self.share(&t))
            };
            let (share, x) =
                if share < CLOSE { descend(&at, share, x, &space.axes(), &mut rng) } else { (share, x) };
            if share.is_nan() || share < 0.0 {
                violated.push(x);
            }
            least = if share.is_nan() { f64::NEG_INFINITY } else { least.min(share) };
        }
        (least, violated)
    }

    /// The last word: densely, from other points than any of the answers was chosen by.
    pub(crate) fn judge(&self, built: &Built) -> Judged {
        let options = AssessOptions::new().points(JUDGED).seed(77);
        let found = assess(&built.manipulator, &built.requirements, &self.space(built.home), &options);
        let shares = found.margins.iter().map(|m| self.share(&(m.term, m.value)));
        let least = shares.fold(self.least_margin(built, JUDGED).0, f64::min);
        Judged { value: self.worst(built, self.objective(), JUDGED).0, violation: (-least).max(0.0) }
    }

    fn hold(&self, points: impl IntoIterator<Item = Vector6<f64>>) {
        if let Ok(mut held) = self.held.write() {
            held.extend(points);
        }
    }
}

impl Judge for DimensionalJudge {
    fn bounds(&self) -> &[(f64, f64)] {
        &self.bounds
    }

    fn violation(&self, x: &[f64]) -> f64 {
        let Some(built) = self.build(x) else { return 1e6 };
        let terms = Terms::new(&built.manipulator, &built.requirements, &built.home);
        let poses = self.poses(built.home);
        let all = terms.fixed().into_iter().chain(poses.iter().flat_map(|p| terms.at(p)));
        // the worst of every kind counts, so that one kind does not hide the others
        let mut worst: BTreeMap<TermKind, f64> = BTreeMap::new();
        for t in all {
            let missed = SPARE - self.share(&t);
            let own = worst.entry(t.0.kind).or_insert(0.0);
            *own = if missed.is_nan() { 1e6 } else { own.max(missed) };
        }
        let other = -self.other_margins(x, &built);
        worst.values().sum::<f64>() + if other.is_nan() { 1e6 } else { other.max(0.0) }
    }

    /// As the violation, given up at the first pose that refutes.
    fn is_feasible(&self, x: &[f64]) -> bool {
        let Some(built) = self.build(x) else { return false };
        let terms = Terms::new(&built.manipulator, &built.requirements, &built.home);
        let met = |list: Vec<(Term, f64)>| list.iter().all(|t| self.share(t) >= SPARE);
        met(terms.fixed())
            && self.poses(built.home).iter().all(|p| met(terms.at(p)))
            && self.other_margins(x, &built) >= 0.0
    }

    fn value(&self, x: &[f64]) -> f64 {
        self.build(x).map_or(f64::NEG_INFINITY, |b| self.held_value(&b, self.objective()))
    }

    fn last_word(&self, x: &[f64]) -> Judged {
        let nothing = Judged { value: f64::NAN, violation: f64::INFINITY };
        self.build(x).map_or(nothing, |built| self.judge(&built))
    }

    /// Looks between the held poses. Poses that violate a requirement, or are worse, are held from then on.
    fn confirm(&self, x: &[f64]) -> Option<f64> {
        let built = self.build(x)?;
        let (value, worst) = self.worst(&built, self.objective(), CHECKED);
        if value < self.held_value(&built, self.objective()) {
            self.hold(worst);
        }
        let (least, violated) = self.least_margin(&built, CHECKED);
        self.hold(violated);
        (least >= 0.0).then_some(value)
    }
}
