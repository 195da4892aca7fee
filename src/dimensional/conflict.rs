//! Infeasible problems: the least violation, and an irreducible set of requirements that exclude each other.

use std::collections::BTreeMap;

use super::certificate::proved_empty;
use super::kinematics::{HeldPose, Lines};
use super::model::{Group, Model, Task};
use super::outcome::{Conflict, Demand, Give};
use super::search::{Refined, SearchOptions, refine};
use super::terms::Item;
use crate::num::parallel::parallel;
use crate::requirements::TermKind;

fn no_objective(model: &Model<'_>, dropped: Vec<Group>) -> Task {
    let n = model.objectives.len();
    Task { weights: vec![0.0; n], floors: vec![None; n], dropped, soft: None }
}

/// Least violation, objectives left out, from where the runs ended.
pub(crate) fn elastic(model: &Model<'_>, from: &[Refined], threads: usize) -> Vec<Refined> {
    settle(model, &no_objective(model, Vec::new()), from, threads)
}

fn settle(model: &Model<'_>, task: &Task, from: &[Refined], threads: usize) -> Vec<Refined> {
    let run = |k: usize| refine(model, task, &from[k].run.x, from[k].poses.clone(), k as u64);
    let mut out = parallel(from.len(), threads, run, &mut |_, _| ());
    let key = |r: &Refined| r.run.judged.total_violation(task);
    out.sort_by(|a, b| key(a).total_cmp(&key(b)));
    out
}

/// An irreducible set of constraints that could not be met together, `None` when the elastic problem did not settle.
///
/// Deletion filter (Chinneck, Dravnieks 1991): constraints are left out one kind at a time, and stay out when the others still cannot be met.
pub(crate) fn conflict(model: &Model<'_>, settled: &[Refined], o: &SearchOptions) -> Option<Conflict> {
    let best = settled.first()?;
    if !best.run.converged {
        return None;
    }
    let all: Vec<Group> = best.run.judged.violations.keys().copied().collect();
    let mut dropped: Vec<Group> = Vec::new();
    let mut from: Vec<Refined> = settled.to_vec();
    // those that hold at the least violation go first: they are most likely to take no part
    let mut order = all.clone();
    order.sort_by(|a, b| best.run.judged.violations[a].total_cmp(&best.run.judged.violations[b]));
    let mut alone: BTreeMap<Group, Refined> = BTreeMap::new();
    for group in order {
        let mut without = dropped.clone();
        without.push(group);
        if without.len() == all.len() {
            break;
        }
        let runs = settle(model, &no_objective(model, without.clone()), &from, o.threads);
        if let Some(met) = runs.iter().find(|r| r.run.is_feasible(model)) {
            alone.insert(group, met.clone());
        } else {
            (dropped, from) = (without, runs);
        }
    }
    let kept: Vec<Group> = all.into_iter().filter(|g| !dropped.contains(g)).collect();
    let task = no_objective(model, dropped);
    let together = settle(model, &task, &from, o.threads);
    let least = together.first()?;
    let total = amounts(model, &least.poses, &least.run.x, &task);
    let proved = proved_empty(model, &least.poses, &least.run.x, &kept, &task);
    let give = |group: &Group| Give {
        demand: demand(model, *group),
        alone: match alone.get(group) {
            Some(from) => least_alone(model, from, *group, &task),
            // nothing else is left to hold
            None => total.get(group).copied(),
        },
        together: total.get(group).copied().unwrap_or(0.0),
    };
    Some(Conflict { demands: kept.iter().map(give).collect(), proved })
}

fn demand(model: &Model<'_>, group: Group) -> Demand {
    match group {
        Group::Term(kind) => Demand::Requirement(kind),
        Group::Determinant => Demand::Determinant,
        Group::Reach => Demand::Reach,
        Group::Floor(m) => Demand::Level(model.objectives[m]),
    }
}

/// The least violation of one group where the others of the conflict hold.
fn least_alone(model: &Model<'_>, from: &Refined, group: Group, task: &Task) -> Option<f64> {
    // a group that costs a hundredth of the others gives way first
    let task = Task { soft: Some(group), ..task.clone() };
    let refined = refine(model, &task, &from.run.x, from.poses.clone(), 1);
    let others = refined.run.judged.violations.iter().filter(|(g, _)| **g != group);
    let met = others.map(|(_, v)| *v).fold(0.0, f64::max) <= model.backoff;
    met.then(|| amounts(model, &refined.poses, &refined.run.x, &task).get(&group).copied().unwrap_or(0.0))
}

/// Violations in the units of the requirements.
fn amounts(model: &Model<'_>, poses: &[HeldPose], x: &[f64], task: &Task) -> BTreeMap<Group, f64> {
    let h = &model.problem.requirements.hardware;
    let ends = model.shape.ends(x);
    let mut out: BTreeMap<Group, f64> = BTreeMap::new();
    for at in poses {
        let l = Lines::new(&ends, at);
        model.terms.visit(&l, &ends, x, &mut |item: Item<()>| {
            let (kind, leg) = (item.id.0, item.id.1);
            let lean = |limit: f64| {
                let cos = limit.to_radians().cos() + item.value * model.terms.size / l.length[leg];
                cos.clamp(-1.0, 1.0).acos().to_degrees() - limit
            };
            let miss = match kind {
                TermKind::BaseSwing => h.base_swing.map_or(0.0, |s| lean(s.limit_deg)),
                TermKind::PlatformSwing => h.platform_swing.map_or(0.0, |s| lean(s.limit_deg)),
                TermKind::LegForce => -item.value * h.max_leg_force.unwrap_or(1.0),
                TermKind::LegSpeed => -item.value * h.max_leg_speed.unwrap_or(1.0),
                _ => -item.value * model.terms.size,
            };
            let worst = out.entry(Group::Term(kind)).or_insert(0.0);
            *worst = worst.max(miss);
        });
    }
    for (group, value) in &model.judge(poses, x, task, model.sign(x)).violations {
        match group {
            Group::Determinant | Group::Reach | Group::Floor(_) => {
                out.insert(*group, *value);
            }
            Group::Term(kind) if kind.is_fixed() => {
                out.insert(*group, *value * model.terms.size);
            }
            Group::Term(_) => {}
        }
    }
    out
}
