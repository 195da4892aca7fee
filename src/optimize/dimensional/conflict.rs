//! Infeasible problems: the least violation, and an irreducible set of conflicting requirements with a proof for convex
//! ones.

use std::collections::BTreeMap;

use super::leg_lines::{HeldPose, LegLines};
use super::model::Model;
use super::outcome::{ConstraintConflict, Demand, Give};
use super::search::{
    PoseAdding, ProgressReport, RefinedRun, ShapeSearchOptions, Stage, distinct, expects_no_other,
    population, refine, refine_adding,
};
use super::terms::PoseTerm;
use crate::climb::{ConstraintGroup, Task};
use machine::requirements::{HingeAngle, TermKind};
use num::conic::{Cone, ConicAnswer, ConicProgram, ConicRow};
use num::farkas::{EnclosedRow, refuted};
use num::interval::Interval;
use num::parallel::parallel;

pub(crate) fn no_objective(model: &Model<'_>, dropped: Vec<ConstraintGroup>) -> Task {
    let n = model.objectives.len();
    Task { weights: vec![0.0; n], floors: vec![None; n], dropped, soft: None }
}

/// Number of runs towards the least violation before the test whether they are enough.
const ELASTIC_BATCH: usize = 16;

/// The least violation without objectives, from the ends of the runs of a task, each distinct end once. The runs
/// continue while none meets the requirements and other ends are expected.
pub(super) fn elastic(
    model: &Model<'_>,
    task: &Task,
    from: &[RefinedRun],
    threads: usize,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Vec<RefinedRun> {
    let plain = no_objective(model, Vec::new());
    let from = apart(task, from);
    let mut runs: Vec<RefinedRun> = Vec::new();
    for batch in ends(&from).chunks(ELASTIC_BATCH) {
        runs.extend(settle(PoseAdding::WhileMet, model, &plain, batch, threads, watch));
        let is_met = runs.iter().any(|r| r.run.is_feasible());
        if is_met || expects_no_other(runs.len(), apart(&plain, &runs).len()) {
            break;
        }
    }
    with_least_whole(model, &plain, runs, watch)
}

/// Runs in the order of their violations; poses are added to the first until none is worse. Further poses only increase
/// a violation, so the run with the least one is among those whose violation without them is no greater.
fn with_least_whole(
    model: &Model<'_>,
    task: &Task,
    mut runs: Vec<RefinedRun>,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Vec<RefinedRun> {
    let violation = |r: &RefinedRun| r.run.judged.total_violation(task);
    runs.sort_by(|a, b| by_violation(task, a, b));
    let mut whole: Vec<RefinedRun> = Vec::new();
    while !runs.is_empty() && whole.first().is_none_or(|least| violation(&runs[0]) < violation(least)) {
        let next = runs.remove(0);
        let complete = next.complete || model.is_stopped();
        let seed = whole.len() as u64;
        whole.push(if complete { next } else { refine(model, task, &next.run.x, next.poses, seed) });
        whole.sort_by(|a, b| by_violation(task, a, b));
        watch.tell(Stage::Conflict, (whole.len(), whole.len()), None);
    }
    whole.append(&mut runs);
    whole.sort_by(|a, b| by_violation(task, a, b));
    whole
}

/// Runs towards the least violation, if the requirements appear infeasible from all of some points; otherwise `None`.
///
/// The search for the least violation starts at the point with the least one. The requirements missed there are
/// necessary, so failing to meet them means failing to meet all. They alone are tried from the points, since the other
/// requirements would create local optima. The requirements count as infeasible, within the power of local searches, if
/// every run misses them and no other end is expected ([`expects_no_other`]).
///
/// Here a trial is a single run from a point, even if several points come from one population. Those depend on each
/// other, so this search can end before all populations have started: only the runs made are evidence.
pub(super) fn unmet(
    model: &Model<'_>,
    points: &[Vec<f64>],
    threads: usize,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Option<Vec<RefinedRun>> {
    let plain = no_objective(model, Vec::new());
    let poses = model.first_poses();
    let missed = |x: &Vec<f64>| model.judge(&poses, x, &plain, model.sign(x)).total_violation(&plain);
    let mut order: Vec<(f64, &Vec<f64>)> = points.iter().map(|x| (missed(x), x)).collect();
    order.sort_by(|a, b| a.0.total_cmp(&b.0));
    let starts: Vec<SettleStart<'_>> = order.iter().map(|(_, x)| (x.as_slice(), poses.as_slice())).collect();
    let least = settle(PoseAdding::WhileMet, model, &plain, starts.get(..1)?, threads, watch).pop()?;
    if least.run.is_feasible() {
        return None;
    }
    let violations = &least.run.judged.violations;
    let held = violations.iter().filter(|(_, v)| **v <= 0.0).map(|(group, _)| *group).collect();
    let fewer = no_objective(model, held);
    let mut runs: Vec<RefinedRun> = Vec::new();
    for batch in starts.chunks(ELASTIC_BATCH) {
        runs.extend(settle(PoseAdding::WhileMet, model, &fewer, batch, threads, watch));
        if model.is_stopped() || runs.iter().any(|r| r.run.is_feasible()) {
            return None;
        }
        if expects_no_other(runs.len(), apart(&fewer, &runs).len()) {
            let mut from = apart(&fewer, &runs);
            from.push(least);
            let whole = settle(PoseAdding::WhileMet, model, &plain, &ends(&from), threads, watch);
            return Some(with_least_whole(model, &plain, whole, watch));
        }
    }
    None
}

/// A point, and the initial held poses of the requirements.
type SettleStart<'r> = (&'r [f64], &'r [HeldPose]);

/// Ends of runs.
fn ends(from: &[RefinedRun]) -> Vec<SettleStart<'_>> {
    from.iter().map(|r| (r.run.x.as_slice(), r.poses.as_slice())).collect()
}

/// Runs from some points, those with the least violation first.
fn settle(
    adding: PoseAdding,
    model: &Model<'_>,
    task: &Task,
    from: &[SettleStart<'_>],
    threads: usize,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Vec<RefinedRun> {
    let run = |k: usize| refine_adding(adding, model, task, from[k].0, from[k].1.to_vec(), k as u64);
    // a run without some requirements gives no information about the best platform
    let tick = &mut |done: usize, _: &RefinedRun| watch.tell(Stage::Conflict, (done, from.len()), None);
    let mut out = parallel(from.len(), threads, run, tick);
    out.sort_by(|a, b| by_violation(task, a, b));
    out
}

fn by_violation(task: &Task, a: &RefinedRun, b: &RefinedRun) -> std::cmp::Ordering {
    let of = |r: &RefinedRun| r.run.judged.total_violation(task);
    of(a).total_cmp(&of(b))
}

/// Number of the first population of an attempt, beyond those of a search.
const POPULATIONS: usize = 3000;
/// Number of starts of an attempt besides the ends of earlier runs, and generations of their population. Both are
/// small, since the basin that attracts a population may contain the compromise to be left.
const FRESH: (usize, usize) = (6, 5);

/// Number of runs of an attempt before the test whether one of them is enough.
const BATCH: usize = 4;

/// Tries to meet the requirements that a task keeps, from the ends of other runs and from a separate population. The
/// earlier ends come from all requirements together, and may be far from points that meet fewer of them.
pub(super) fn attempt(
    model: &Model<'_>,
    task: &Task,
    from: &[RefinedRun],
    o: &ShapeSearchOptions,
    k: usize,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> Result<RefinedRun, Vec<RefinedRun>> {
    let mut runs: Vec<RefinedRun> = Vec::new();
    let mut meets = |all: &[SettleStart<'_>]| {
        for batch in all.chunks(BATCH) {
            let mut found = settle(PoseAdding::WhileMet, model, task, batch, o.threads, watch);
            if found.first().is_some_and(|r| r.run.is_feasible()) {
                return Some(found.swap_remove(0));
            }
            runs.append(&mut found);
        }
        None
    };
    if let Some(met) = meets(&ends(from)) {
        return Ok(met);
    }
    let few = ShapeSearchOptions { starts: FRESH.0, generations: FRESH.1, ..*o };
    let fresh = population(model, task, &[], POPULATIONS + 3 * k, &few);
    let poses = model.first_poses();
    let fresh: Vec<SettleStart<'_>> = fresh.iter().map(|s| (s.x.as_slice(), poses.as_slice())).collect();
    if let Some(met) = meets(&fresh) {
        return Ok(met);
    }
    runs.sort_by(|a, b| by_violation(task, a, b));
    runs.truncate(from.len().max(BATCH));
    Err(runs)
}

/// Runs with distinct violations or ends: other runs would only repeat an attempt from the same end.
fn apart(task: &Task, runs: &[RefinedRun]) -> Vec<RefinedRun> {
    distinct(runs.iter(), |r| r.run.judged.total_violation(task)).into_iter().cloned().collect()
}

/// The result for requirements that no run met.
pub(crate) enum ConflictOutcome {
    /// An irreducible set of constraints that no run met together.
    Conflict(ConstraintConflict),
    /// The search for a conflict found a point that meets all requirements.
    Met(Box<RefinedRun>),
    /// The elastic problem did not converge, the search was stopped, or the remaining set turned out to be feasible.
    Unsettled,
}

/// Searches for an irreducible set of constraints that no run meets together.
///
/// Deletion filter (Chinneck, Dravnieks 1991): constraints are removed one kind at a time, and stay out if the others
/// still cannot be met. Those that hold at the least violation are removed together first, and stay out if the others
/// still cannot be met.
pub(super) fn conflict(
    model: &Model<'_>,
    settled: &[RefinedRun],
    o: &ShapeSearchOptions,
    watch: &mut ProgressReport<'_, '_, '_>,
) -> ConflictOutcome {
    let Some(best) = settled.first().filter(|best| best.run.is_settled()) else {
        return ConflictOutcome::Unsettled;
    };
    let all: Vec<ConstraintGroup> = best.run.judged.violations.keys().copied().collect();
    let mut dropped: Vec<ConstraintGroup> = Vec::new();
    let mut from = apart(&no_objective(model, Vec::new()), settled);
    // those that hold at the least violation go first: they are least likely to take part
    let mut order = all.clone();
    order.sort_by(|a, b| best.run.judged.violations[a].total_cmp(&best.run.judged.violations[b]));
    let mut alone: BTreeMap<ConstraintGroup, RefinedRun> = BTreeMap::new();
    // all of these at once, if the others cannot be met even then
    let idle: Vec<ConstraintGroup> =
        order.iter().copied().filter(|group| best.run.judged.violations[group] <= 0.0).collect();
    if idle.len() > 1
        && let Err(runs) = attempt(model, &no_objective(model, idle.clone()), &from, o, order.len(), watch)
    {
        (dropped, from) = (idle, runs);
        order.retain(|group| !dropped.contains(group));
    }
    for (k, group) in order.into_iter().enumerate() {
        let mut without = dropped.clone();
        without.push(group);
        if without.len() == all.len() || model.is_stopped() {
            break;
        }
        match attempt(model, &no_objective(model, without.clone()), &from, o, k, watch) {
            Ok(met) => {
                alone.insert(group, met);
            }
            Err(runs) => (dropped, from) = (without, runs),
        }
    }
    // interrupted runs show nothing, here and below
    if model.is_stopped() {
        return ConflictOutcome::Unsettled;
    }
    let kept: Vec<ConstraintGroup> = all.into_iter().filter(|g| !dropped.contains(g)).collect();
    let task = no_objective(model, dropped);
    let together = settle(PoseAdding::UntilNoneIsWorse, model, &task, &ends(&from), o.threads, watch);
    let Some(least) = together.first().filter(|least| !least.run.is_feasible()) else {
        return ConflictOutcome::Unsettled;
    };
    let total = amounts(model, &least.poses, &least.run.x, &task);
    let proved = proved_empty(model, &least.poses, &least.run.x, &kept, &task);
    let of = |group: &ConstraintGroup| total.get(group).copied().unwrap_or(0.0);
    let mut demands = Vec::new();
    for group in kept {
        let mut found = None;
        if let Some(from) = alone.get(&group) {
            let run = least_alone(model, from, group, &task);
            if run.run.is_feasible() {
                // no requirement has to be relaxed after all
                let whole = refine(model, &no_objective(model, Vec::new()), &run.run.x, run.poses, o.seed);
                let met = whole.run.is_feasible();
                return if met { ConflictOutcome::Met(Box::new(whole)) } else { ConflictOutcome::Unsettled };
            }
            if others_hold(model, &run, group) {
                found = amounts(model, &run.poses, &run.run.x, &task).get(&group).copied();
            }
        }
        // the same if the sum of all violations is least and no other is violated, as without any other conflict
        if others_hold(model, least, group) {
            found = Some(found.map_or(of(&group), |x| x.min(of(&group))));
        }
        demands.push(Give { demand: demand(model, group), alone: found, together: of(&group) });
    }
    if model.is_stopped() {
        return ConflictOutcome::Unsettled;
    }
    ConflictOutcome::Conflict(ConstraintConflict { demands, proved })
}

/// The constraint of a group, as named in answers.
pub(super) fn demand(model: &Model<'_>, group: ConstraintGroup) -> Demand {
    match group {
        ConstraintGroup::Term(kind) => Demand::Requirement(kind),
        ConstraintGroup::Determinant => Demand::Determinant,
        ConstraintGroup::Reach => Demand::Reach,
        ConstraintGroup::Floor(m) => Demand::Level(model.objectives[m]),
    }
}

/// The run with the least violation of one group while the others of the conflict hold.
fn least_alone(model: &Model<'_>, from: &RefinedRun, group: ConstraintGroup, task: &Task) -> RefinedRun {
    // a group with a hundredth of the penalty is relaxed first
    let task = Task { soft: Some(group), ..task.clone() };
    refine(model, &task, &from.run.x, from.poses.clone(), 1)
}

fn others_hold(model: &Model<'_>, refined: &RefinedRun, group: ConstraintGroup) -> bool {
    let others = refined.run.judged.violations.iter().filter(|(g, _)| **g != group);
    others.map(|(_, v)| *v).fold(0.0, f64::max) <= model.backoff
}

/// Violations in the units of the requirements.
fn amounts(model: &Model<'_>, poses: &[HeldPose], x: &[f64], task: &Task) -> BTreeMap<ConstraintGroup, f64> {
    let h = &model.problem.requirements.hardware;
    let safety_margin = |kind| model.problem.requirements.safety_margin(kind);
    let least = |kind| model.problem.requirements.least_stiffness_of(kind).unwrap_or(1.0);
    let ends = model.shape.ends(x);
    let mut out: BTreeMap<ConstraintGroup, f64> = BTreeMap::new();
    for at in poses {
        let l = LegLines::new(&ends, at);
        model.terms.visit(&l, &ends, x, &mut |item: PoseTerm<()>| {
            let (kind, leg) = (item.id.0, item.id.1);
            let beyond = |limit: f64, length: f64| {
                let cos = limit.to_radians().cos() + item.value * model.terms.size / length;
                cos.clamp(-1.0, 1.0).acos().to_degrees() - limit
            };
            let lean = |limit: f64| beyond(limit, l.length[leg]);
            let hinge = kind.hinge().zip(h.angle_limit_deg(kind, leg));
            let miss = match kind {
                TermKind::BaseConeAngle => {
                    h.base_cone_angle.map_or(0.0, |s| lean(s.limits_deg[leg] - safety_margin(kind)))
                }
                TermKind::PlatformConeAngle => {
                    h.platform_cone_angle.map_or(0.0, |s| lean(s.limits_deg[leg] - safety_margin(kind)))
                }
                kind if kind.hinge().is_some() => match hinge {
                    Some(((body, HingeAngle::First), limit)) => {
                        beyond(limit - safety_margin(kind), model.terms.across_first_axis(&l, body, leg))
                    }
                    Some(((_, HingeAngle::Second), limit)) => lean(90.0 + limit - safety_margin(kind)),
                    None => 0.0,
                },
                TermKind::LegForce | TermKind::LegSpeed => -item.value * h.drive_limit(kind).unwrap_or(1.0),
                TermKind::LinearStiffness | TermKind::AngularStiffness => -item.value * least(kind),
                TermKind::NaturalFrequency => {
                    let wanted = least(kind) + safety_margin(kind);
                    let share = wanted / least(kind);
                    wanted - least(kind) * (share * share + 2.0 * item.value).max(0.0).sqrt()
                }
                _ => -item.value * model.terms.size,
            };
            let worst = out.entry(ConstraintGroup::Term(kind)).or_insert(0.0);
            *worst = worst.max(miss);
        });
    }
    for (group, value) in &model.judge(poses, x, task, model.sign(x)).violations {
        match group {
            ConstraintGroup::Floor(_) => {
                out.insert(*group, *value);
            }
            // the margin is not part of the requirement
            ConstraintGroup::Determinant | ConstraintGroup::Reach => {
                out.insert(*group, (*value - model.backoff).max(0.0));
            }
            ConstraintGroup::Term(kind) if kind.is_fixed() => {
                out.insert(*group, (*value - model.backoff).max(0.0) * model.terms.size);
            }
            ConstraintGroup::Term(_) => {}
        }
    }
    out
}

/// Radius around any point that contains all bounded variables.
const EVERYWHERE: f64 = 100.0;

/// Rounding error of a coefficient, relative to the largest length in it. Every coefficient is a sum of at most a few
/// dozen products and quotients of the data. Each of these costs less than `2^-52` of the largest; the bound allows
/// four thousand.
const ROUNDING: f64 = 1.0 / (1u64 << 40) as f64;

/// An interval that contains the exact coefficient despite rounding.
fn enclosed(x: f64, scale: f64) -> Interval {
    Interval::new((x - ROUNDING * scale).next_down(), (x + ROUNDING * scale).next_up())
        .unwrap_or(Interval::WHOLE)
}

/// `true` if no values of the variables within their bounds meet the requirements of `groups` at these poses. A
/// certificate judged in intervals proves it.
///
/// It applies only to cones that are exact far from the point: greatest lengths and joint angles with given axes. Lines
/// must be affine in the variables. `false` means that nothing is proved.
pub(crate) fn proved_empty(
    model: &Model<'_>,
    poses: &[HeldPose],
    x: &[f64],
    groups: &[ConstraintGroup],
    task: &Task,
) -> bool {
    let Some(all) = model.linearise(poses, x, task, model.sign(x), EVERYWHERE) else { return false };
    let own = all.items.iter().filter(|i| groups.contains(&i.group));
    let n = x.len();
    // the sizes of the line components, in the unit of the rows
    let ends = model.shape.ends(x);
    let positions = poses.iter().map(|p| p.pose.position.amax()).fold(ends.lift.amax(), f64::max);
    let coordinates =
        ends.base.iter().chain(&ends.platform).map(nalgebra::Matrix::amax).fold(positions, f64::max);
    let mut p = ConicProgram { variables: n, linear: vec![0.0; n], ..Default::default() };
    let mut rows: Vec<EnclosedRow> = Vec::new();
    for item in own {
        let Some(cone) = &item.cone else { return false };
        let row = |(value, gradient): &(f64, Vec<f64>), spare: f64| ConicRow {
            coefficients: gradient.iter().enumerate().map(|(j, g)| (j, -g)).collect(),
            rhs: value + spare,
        };
        // the proof concerns the requirement itself, without the margin
        let head = row(&cone.head, model.backoff * cone.slack);
        let block: Vec<ConicRow> =
            std::iter::once(head).chain(cone.tail.iter().map(|t| row(t, 0.0))).collect();
        let rates = block.iter().flat_map(|r| &r.coefficients).map(|c| c.1.abs()).fold(0.0, f64::max);
        let largest = block.iter().map(|r| r.rhs.abs()).fold(rates, f64::max);
        let scale = (coordinates / model.terms.size + largest + 1.0) * cone.slack.abs().max(1.0);
        rows.extend(block.iter().map(|r| EnclosedRow {
            coefficients: r.coefficients.iter().map(|(j, a)| (*j, enclosed(*a, scale))).collect(),
            rhs: enclosed(r.rhs, scale),
        }));
        p.second_order(block);
    }
    let cones: Vec<Cone> = p.cones.clone();
    let mut ranges = Vec::new();
    for (j, (low, high)) in model.shape.bounds.iter().enumerate() {
        p.at_least_zero(vec![(j, 1.0)], high - x[j]);
        p.at_least_zero(vec![(j, -1.0)], x[j] - low);
        ranges.push(
            Interval::new((low - x[j]).next_down(), (high - x[j]).next_up()).unwrap_or(Interval::WHOLE),
        );
    }
    match p.solve(&model.conic) {
        // the ranges of the variables enter unchanged, without multipliers
        ConicAnswer::Infeasible(ray) => {
            ray.get(..rows.len()).is_some_and(|ray| refuted(&rows, &cones, ray, &ranges).is_some())
        }
        _ => false,
    }
}
