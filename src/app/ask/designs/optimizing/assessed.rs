//! Platforms found by a search, as designs, with an assessment independent of all search code.

use std::time::Instant;

use super::super::AssessReport;
use super::super::equivalence::sample_plan;
use super::OptimizeStatus;
use super::problem::as_dimensional;
use crate::Design;
use files::design::{DesignModel, Origin, Share};
use fk::FkOptions;
use machine::requirements::{AssessOptions, Assessment, JointAxes, Objective, Requirements, assess};
use optimize::dimensional::{
    DimensionalOutcome, DimensionalProblem, DimensionalReport, DimensionalSolution, ShapeSearchOptions,
    Triangles, evaluate,
};
use optimize::offsets::{OffsetOutcome, OffsetProblem, OffsetReport, OffsetSolution};
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator, Octahedral, inverse_condition, jacobian};
use synthesis::relocate::Assembled;
use synthesis::{joint_free, sliding_body};
use verify::{Verification, VerifyError, verify};

/// Number of points of the dense evaluation; as many random points are added.
const POINTS: usize = 5000;
/// Number of samples of the comparison with the design.
const SAMPLES: usize = 3;

/// The status of a search for offsets, after the independent check.
pub(crate) fn offset_status(report: &OffsetReport, checked: Option<&Checked>) -> OptimizeStatus {
    let met = checked.map(Checked::met);
    match report.outcome {
        _ if report.interrupted => OptimizeStatus::Interrupted,
        _ if met.is_some_and(|met| met != Some(true)) => missed(met.flatten()),
        OffsetOutcome::Optimal(_) => OptimizeStatus::Optimal,
        OffsetOutcome::LocalOptimum(_) | OffsetOutcome::NotConverged(_) => OptimizeStatus::Feasible,
        OffsetOutcome::Infeasible => OptimizeStatus::Infeasible,
        OffsetOutcome::Undecided { .. } => OptimizeStatus::Undecided,
    }
}

/// The status of a search under requirements, after the independent check.
pub(crate) fn dimensional_status(report: &DimensionalReport, checked: Option<&Checked>) -> OptimizeStatus {
    match (&report.outcome, checked) {
        _ if report.interrupted => OptimizeStatus::Interrupted,
        (DimensionalOutcome::Infeasible(_), _) => OptimizeStatus::Infeasible,
        (_, None) => OptimizeStatus::Undecided,
        (outcome, Some(c)) => match (c.met(), outcome) {
            (Some(true), DimensionalOutcome::Optimal(_)) => OptimizeStatus::BestFound,
            (Some(true), _) => OptimizeStatus::Feasible,
            (met, _) => missed(met),
        },
    }
}

/// The status of a platform that is not proved to meet its requirements; it is neither optimal nor feasible.
fn missed(met: Option<bool>) -> OptimizeStatus {
    if met == Some(false) { OptimizeStatus::Violated } else { OptimizeStatus::Undecided }
}

/// Whether the requirements are met with their safety margins; `Some(true)` without requirements.
pub fn met_or_nothing_required(assessed: Option<&AssessReport>) -> Option<bool> {
    assessed.map_or(Some(true), AssessReport::met_with_safety_margin)
}

/// The optimised platform as a design, with the tables of its original.
pub(crate) fn optimised_design(
    design: &Design,
    problem: &OffsetProblem,
    s: &OffsetSolution,
    seed: u64,
) -> Design {
    let mut out = joint_free_design(design, &problem.octahedral, &s.manipulator, s.offsets);
    out.source.clone_from(&design.source);
    out.description = Some(format!(
        "Offsets optimised by equipod {} (seed {seed}) from the design \"{}\": worst inverse condition number {}",
        env!("CARGO_PKG_VERSION"),
        design.name,
        s.recheck.objective
    ));
    out.with_tables_of(design).into()
}

/// The platform with names: vertices keep theirs, and an edge joint has the name of its edge and is given by its
/// offset.
fn joint_free_design(design: &Design, o: &Octahedral, m: &Manipulator, t: [f64; 6]) -> DesignModel {
    let (base, platform) = (design.base_names(), design.platform_names());
    let base_name = |k: usize| base[o.base_indices()[k % 3]].clone();
    let platform_name = |k: usize| platform[o.platform_indices()[k % 3]].clone();
    // names belong to joints, in an order that may differ from the legs
    let (mut a, mut b) =
        (vec![String::new(); m.base_joints().len()], vec![String::new(); m.platform_joints().len()]);
    let mut origins = [vec![Origin::New; a.len()], vec![Origin::New; b.len()]];
    for (i, leg) in o.order().into_iter().enumerate() {
        let k = i / 2;
        let (on_base, on_platform) = m.pairs()[leg.get()];
        let corner = |of: [usize; 3], k: usize| of[k % 3];
        let edge = |of: [usize; 3]| Origin::between([corner(of, k), corner(of, k + 1)], t[i]);
        let (first, second) = (o.base_indices(), o.platform_indices());
        (a[on_base], b[on_platform]) = match sliding_body(i) {
            Body::Base => (format!("{}_{}", base_name(k), base_name(k + 1)), platform_name(k)),
            Body::Platform => (base_name(k + 1), format!("{}_{}", platform_name(k), platform_name(k + 1))),
        };
        (origins[0][on_base], origins[1][on_platform]) = match sliding_body(i) {
            Body::Base => (edge(first), Origin::Kept(corner(second, k))),
            Body::Platform => (Origin::Kept(corner(first, k + 1)), edge(second)),
        };
    }
    let plain =
        DesignModel::new(format!("{}, separate joints", design.name), design.units.clone(), m.clone());
    let distinct = |v: &[String]| v.iter().enumerate().all(|(i, x)| !v[..i].contains(x));
    let named =
        if distinct(&a) && distinct(&b) { plain.clone().with_joint_names(a, b) } else { Ok(plain.clone()) };
    named.unwrap_or(plain).constructed_from(design, [&origins[0], &origins[1]])
}

/// A platform with independently computed evidence.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct Checked {
    /// The platform as a design.
    pub design: Design,
    /// The requirements of the search over many poses: those of the design, and the spacing of joints that offsets
    /// separate.
    pub assessment: Assessment,
    /// The result of [`Design::assess`]; `None` without requirements.
    pub assessed: Option<AssessReport>,
    /// The objectives over many poses.
    pub objectives: Vec<(Objective, f64)>,
    /// The held pose with the worst conditioning, and its index among the held poses, if the first objective is the
    /// worst conditioning.
    pub worst_pose: Option<(usize, Pose)>,
    /// The equivalence with the design, if the variables keep it.
    pub verification: Option<Verification>,
}

impl Checked {
    /// Whether the platform is proved to meet the requirements with the safety margin on each; `None`: undecided.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        if self.assessment.all_met() { met_or_nothing_required(self.assessed.as_ref()) } else { Some(false) }
    }
}

/// The options of assessing a platform.
#[derive(Debug, Clone, Copy)]
pub struct Assessing {
    /// Seed of the search and of the sampled poses.
    pub seed: u64,
    /// The time at which samples and proofs end with their result so far.
    pub until: Option<Instant>,
}

impl From<&ShapeSearchOptions> for Assessing {
    fn from(options: &ShapeSearchOptions) -> Self {
        Self { seed: options.seed, until: options.until }
    }
}

/// The platform as a design, evaluated independently of the optimiser.
pub(crate) fn checked(
    design: &Design,
    problem: &DimensionalProblem,
    s: &DimensionalSolution,
    assessing: Assessing,
) -> Result<Checked, VerifyError> {
    let out = optimised(design, problem, s, assessing.seed);
    let v = &problem.variables;
    let keeps_class = (v.offsets || v.components) && v.triangles == Triangles::Fixed;
    assessed(design, problem, out, (&s.home, &s.poses), keeps_class, assessing)
}

/// The platform of a search for offsets, evaluated in the same way.
pub(crate) fn checked_offsets(
    design: &Design,
    problem: &OffsetProblem,
    s: &OffsetSolution,
    assessing: Assessing,
) -> Result<Checked, VerifyError> {
    let general = as_dimensional(design, problem);
    let out = optimised_design(design, problem, s, assessing.seed);
    assessed(design, &general, out, (&design.home_or_default(), &problem.poses), true, assessing)
}

/// A platform found for a design over held poses, evaluated independently of every search. `keeps_class`: it should be
/// equivalent to the design.
fn assessed(
    design: &Design,
    problem: &DimensionalProblem,
    out: Design,
    (home, held): (&Pose, &[Pose]),
    keeps_class: bool,
    Assessing { seed, until }: Assessing,
) -> Result<Checked, VerifyError> {
    let space = problem.space.with_home(*home);
    let requirements = Requirements { hardware: out.hardware, ..problem.requirements.clone() };
    let options = AssessOptions::new().points(POINTS).seed(seed).until(until);
    // the platform as written, which may differ from the search result by rounding
    let platform = out.manipulator();
    let assessment = assess(platform, &requirements, &space, &options);
    let values = evaluate(problem, platform, &space, held, POINTS, seed);
    let objectives: Vec<(Objective, f64)> = problem.objectives.iter().map(|o| o.0).zip(values).collect();
    let conditioned = objectives.first().is_some_and(|o| o.0 == Objective::WorstConditioning);
    let worst_pose =
        if conditioned { worst_conditioned(platform, held, problem.characteristic_length) } else { None };
    let verification = if keeps_class {
        let plan = sample_plan(design, SAMPLES, seed);
        let options = FkOptions::new().seed(seed);
        Some(verify(design.manipulator(), platform, &plan, &options)?)
    } else {
        None
    };
    let assessed = out.assessed_until(seed, until);
    Ok(Checked { design: out, assessment, assessed, objectives, worst_pose, verification })
}

/// The pose with the least inverse condition number, with its index.
fn worst_conditioned(m: &Manipulator, poses: &[Pose], length: f64) -> Option<(usize, Pose)> {
    let value = |pose: &Pose| inverse_condition(&jacobian(m, pose, length));
    let values = poses.iter().map(value).enumerate();
    let (k, _) = values.min_by(|a, b| a.1.total_cmp(&b.1))?;
    Some((k, poses[k]))
}

/// The platform with the tables of the design, its axes and its home.
fn optimised(design: &Design, problem: &DimensionalProblem, s: &DimensionalSolution, seed: u64) -> Design {
    let octahedral = Octahedral::recognise(design.manipulator()).ok().zip(s.offsets);
    let mut out: Design = if let Some((o, t)) = &octahedral {
        // triangles that are not variables equal those of the design, to the last digit
        let fixed = problem.variables.triangles == Triangles::Fixed;
        let own = if fixed { joint_free(o, *t).ok() } else { None };
        joint_free_design(design, o, own.as_ref().map_or(&s.manipulator, |(m, _)| m), *t).into()
    } else if let Some(moved) = problem.variables.components.then(|| with_moved_legs(design, s)).flatten() {
        moved
    } else {
        let plain = DesignModel::new(design.name.clone(), design.units.clone(), s.manipulator.clone());
        let (base, platform) = (design.base_names().to_vec(), design.platform_names().to_vec());
        let kept = [base.len(), platform.len()].map(|n| (0..n).map(Origin::Kept).collect::<Vec<_>>());
        let named = plain.clone().with_joint_names(base, platform);
        // joints that have stayed in place
        named.map_or(plain, |named| named.constructed_from(design, [&kept[0], &kept[1]])).into()
    };
    if octahedral.is_none() {
        out.name = format!("{}, optimised", design.name);
    }
    out.source.clone_from(&design.source);
    let best: Vec<String> = s.objectives.iter().map(|(o, v)| format!("{} {v}", o.code())).collect();
    out.description = Some(format!(
        "Optimised by equipod {} (seed {seed}) from the design \"{}\": {}",
        env!("CARGO_PKG_VERSION"),
        design.name,
        best.join(", ")
    ));
    let mut out = out.with_tables_of(design);
    if design.home.is_some() || problem.variables.home_height {
        out.home = Some(s.home);
    }
    let hardware = &mut out.hardware;
    for (cone_angle, axes) in
        [(&mut hardware.base_cone_angle, s.axes[0]), (&mut hardware.platform_cone_angle, s.axes[1])]
    {
        if let (Some(cone_angle), Some(axes)) = (cone_angle, axes) {
            cone_angle.axes = JointAxes::Given(axes);
        }
    }
    out
}

/// The platform with joints constructed at the parameters of its legs, so that equivalence is proved about exact
/// joints; `None` if the legs make no platform.
fn with_moved_legs(design: &Design, s: &DimensionalSolution) -> Option<Design> {
    let parameters: Vec<Share> = s.variables.iter().filter_map(|v| Share::shortest(v.value)).collect();
    design.with_legs_of(&Assembled::of(design.manipulator(), &s.manipulator.legs().map(Some)), &parameters)
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use num::Rng;

    /// Draws random triangles, leg orders and offsets. Joint `X` stays in place, and joint `X_Y` is on the line of `X`
    /// and `Y`, away from every vertex.
    #[test]
    fn joints_are_where_their_names_say() {
        let mut rng = Rng::new(8);
        for _ in 0..60 {
            let mut triangle = |z: f64| -> Vec<Point3<f64>> {
                (0..3).map(|_| Point3::new(rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0), z)).collect()
            };
            let (base, platform) = (triangle(0.0), triangle(1.0));
            let mut legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
            for k in (1..6).rev() {
                legs.swap(k, (rng.next_u64() % (k as u64 + 1)) as usize);
            }
            let m = Manipulator::try_new(base, platform, legs).unwrap();
            let names = |letter: &str| (1..=3).map(|k| format!("{letter}{k}")).collect::<Vec<_>>();
            let design = Design::new("drawn", "mm", m).with_joint_names(names("B"), names("Q")).unwrap();
            let o = Octahedral::recognise(design.manipulator()).unwrap();
            let t: [f64; 6] = std::array::from_fn(|_| rng.uniform(-1.0, 2.0));
            let (platform, _) = joint_free(&o, t).unwrap();
            let built = joint_free_design(&design, &o, &platform, t);
            let mut on_edges = 0;
            let old_joints = [design.manipulator().base_joints(), design.manipulator().platform_joints()];
            let old_names = [design.base_names(), design.platform_names()];
            let new_joints = [built.manipulator().base_joints(), built.manipulator().platform_joints()];
            for (body, list) in [built.base_names(), built.platform_names()].into_iter().enumerate() {
                let place =
                    |name: &str| old_joints[body][old_names[body].iter().position(|n| n == name).unwrap()];
                for (name, joint) in list.iter().zip(new_joints[body]) {
                    let Some((x, y)) = name.split_once('_') else {
                        assert!((joint - place(name)).norm() < 1e-12, "{name}");
                        continue;
                    };
                    let (edge, gap) = (place(y) - place(x), joint - place(x));
                    assert!(edge.cross(&gap).norm() < 1e-9 * edge.norm(), "{name} is off its line");
                    assert!(old_joints[body].iter().all(|v| (joint - v).norm() > 1e-9), "{name} is a vertex");
                    on_edges += 1;
                }
            }
            assert_eq!(on_edges, 6);
        }
    }
}
