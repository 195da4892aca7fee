//! Outcomes of the search: conflicts, levels, fronts, refusals.

use std::ops::ControlFlow;

use nalgebra::{Point3, Unit, Vector3};

use super::super::conflict::attempt;
use super::super::search::{ProgressReport, expects_no_other, refine};
use super::super::*;
use super::{ConstraintGroup, Model, everything, problem, quick};
use crate::climb::Task;
use machine::requirements::{ConeLimits, JointAxes, LengthLimits, Objective, TermKind, VariableKind};
use platform::manipulator::Manipulator;

#[test]
fn a_conflict_is_named_with_what_each_requirement_would_have_to_give() {
    let mut p = problem(&[VariableKind::HomeHeight], Objective::WorstConditioning);
    p.requirements.min_joint_distance = None;
    p.space.translation = Vector3::new(0.0, 0.0, 20.0);
    p.space.rotation_deg = Vector3::zeros();
    // a stroke of 10 for a travel of 40; joint angles have no influence
    p.requirements.hardware.leg_length = Some(LengthLimits::Range(250.0, 260.0));
    p.requirements.hardware.base_cone_angle = Some(ConeLimits::of_all(80.0, JointAxes::Home));
    let found = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    let DimensionalOutcome::Infeasible(conflict) = &found.outcome else { panic!("{found:?}") };
    let kinds: Vec<Demand> = conflict.demands.iter().map(|g| g.demand).collect();
    assert_eq!(kinds, [TermKind::MinLegLength, TermKind::MaxLegLength].map(Demand::Requirement));
    // least length 250: the height is fixed, and the greatest length follows
    let reach = (200.0f64.powi(2) + 120.0 * 120.0 - 200.0 * 120.0).sqrt();
    let low = (250.0f64.powi(2) - reach * reach).sqrt();
    let excess = (reach * reach + (low + 40.0).powi(2)).sqrt() - 260.0;
    let give = conflict.demands[1].alone.unwrap();
    assert!((give - excess).abs() < 1e-2, "{give} {excess}");
    // each conflicts with the other, though the least sum relaxes only some of them
    assert!(conflict.demands.iter().all(|g| g.alone.is_some_and(|x| x > 0.0)), "{conflict:?}");
    assert!(conflict.demands.iter().any(|g| g.together > 0.0), "{conflict:?}");
    for g in &conflict.demands {
        let others = conflict.demands.iter().filter(|o| o.demand != g.demand);
        if others.map(|o| o.together).sum::<f64>() <= 0.0 {
            assert!(g.alone.unwrap() <= g.together, "the least sum shows a smaller amount: {conflict:?}");
        }
    }
    // negative control: with this additional stroke there is no conflict
    p.requirements.hardware.leg_length = Some(LengthLimits::Range(250.0, 260.0 + excess + 0.01));
    assert!(optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap().solution().is_some());
}

#[test]
#[ignore = "evidence"]
fn a_conflict_of_cones_is_proved_and_one_that_is_none_is_not() {
    let mut p = problem(&[VariableKind::Offsets], Objective::WorstConditioning);
    p.requirements.hardware.leg_length = None;
    // no leg of any offset points along the base axis within a degree at all poses
    let axis = Unit::new_normalize(Vector3::new(1.0, 0.0, 0.3));
    p.requirements.hardware.base_cone_angle = Some(ConeLimits::of_all(1.0, JointAxes::Given([axis; 6])));
    let proved = |p: &DimensionalProblem, group: ConstraintGroup| {
        let model = Model::new(p).unwrap();
        let x = [0.4; 6];
        crate::dimensional::conflict::proved_empty(&model, &model.first_poses(), &x, &[group], &everything(1))
    };
    assert!(proved(&p, ConstraintGroup::Term(TermKind::BaseConeAngle)));
    // spacing is not convex, so nothing is proved about it
    assert!(!proved(&p, ConstraintGroup::Term(TermKind::BaseSpacing)));
    let found = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    let DimensionalOutcome::Infeasible(conflict) = &found.outcome else { panic!("{found:?}") };
    assert!(conflict.proved && conflict.demands.len() == 1, "{conflict:?}");
    // negative control: the legs can be within 70 degrees of the vertical
    let axes = JointAxes::Given([Vector3::z_axis(); 6]);
    p.requirements.hardware.base_cone_angle = Some(ConeLimits::of_all(70.0, axes));
    assert!(!proved(&p, ConstraintGroup::Term(TermKind::BaseConeAngle)));
}

#[test]
#[ignore = "evidence"]
fn no_member_of_a_front_is_better_in_every_objective() {
    let mut p = problem(&[VariableKind::HomeHeight], Objective::WorstConditioning);
    p.requirements.min_joint_distance = None;
    p.objectives.push((Objective::Stroke, 1.0));
    let found = pareto(&p, 4, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(found.front.len() >= 3, "{found:?}");
    for pair in found.front.windows(2) {
        assert!(pair[0].dense[0] > pair[1].dense[0] && pair[0].dense[1] > pair[1].dense[1]);
    }
    p.objectives.truncate(1);
    assert_eq!(
        pareto(&p, 4, &quick(), &mut |_| ControlFlow::Continue(())).unwrap_err(),
        InvalidProblem::FrontOf(1)
    );
}

#[test]
#[ignore = "evidence"]
fn an_interrupted_front_says_so_and_has_what_was_found() {
    let mut p = problem(&[VariableKind::HomeHeight], Objective::WorstConditioning);
    p.requirements.min_joint_distance = None;
    p.objectives.push((Objective::Stroke, 1.0));
    // stopped at the given number of calls, counted in the sweep if `sweep` is set
    let stopped = |after: usize, sweep: bool| {
        let mut calls = 0;
        let found = pareto(&p, 4, &quick(), &mut |now| {
            // the earlier searches polish batches of fewer runs than the sweep has steps
            calls += usize::from(!sweep || (now.stage == Stage::Polishing && now.total == 4));
            if calls > after { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        (found.unwrap(), calls)
    };
    let (whole, calls) = stopped(usize::MAX, true);
    assert!(!whole.interrupted && calls > 4, "{calls}");
    let (some, _) = stopped(0, true);
    assert!(some.interrupted && !some.front.is_empty() && some.front.len() < whole.front.len(), "{some:?}");
    assert_eq!((some.unmet, &some.failure), (0, &None));
    let (none, _) = stopped(0, false);
    assert!(none.interrupted && none.failure.is_none(), "{none:?}");
}

#[test]
#[ignore = "evidence"]
fn later_levels_keep_the_earlier_ones() {
    let mut p = problem(&[VariableKind::HomeHeight], Objective::WorstConditioning);
    p.requirements.min_joint_distance = None;
    let alone = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(()))
        .unwrap()
        .solution()
        .unwrap()
        .objectives[0]
        .1;
    p.objectives.push((Objective::Stroke, 1.0));
    let strokes = [0.01, 0.1].map(|slack| {
        p.mode = Mode::Lexicographic { slack };
        let found = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
        let s = found.solution().unwrap();
        assert!((s.objectives[0].1 - alone * (1.0 - slack)).abs() < 1e-4, "{:?} {alone}", s.objectives);
        s.objectives[1].1
    });
    assert!(strokes[1] < strokes[0]);
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let p = problem(&[VariableKind::Offsets], Objective::LegForce);
    let refused =
        |p: &DimensionalProblem| optimize(p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap_err();
    assert!(matches!(refused(&p), InvalidProblem::Needs { needs: "[[loads]]", .. }));
    let p = problem(&[], Objective::WorstConditioning);
    assert_eq!(refused(&p), InvalidProblem::NoVariables);
    let mut p = problem(&[VariableKind::JointAxes], Objective::WorstConditioning);
    p.requirements.hardware.base_cone_angle = Some(ConeLimits::of_all(120.0, JointAxes::Optimize));
    assert_eq!(refused(&p), InvalidProblem::ConeTooWide(120.0));
}

/// An octahedral hexagon whose legs are longest with the joints near the corners, and must be longer than they are in
/// between.
fn long_struts(limits: LengthLimits) -> DimensionalProblem {
    let corner = |r: f64, k: f64| {
        let (s, c) = (std::f64::consts::TAU * k / 3.0).sin_cos();
        Point3::new(r * c, r * s, 0.0)
    };
    let base = (0..3).map(|k| corner(26.5, f64::from(k))).collect();
    let platform = (0..3).map(|k| corner(13.232, f64::from(k) + 0.5)).collect();
    let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let mut p = problem(&[VariableKind::Offsets], Objective::WorstConditioning);
    p.manipulator = Manipulator::try_new(base, platform, pairs).unwrap();
    p.characteristic_length = p.manipulator.platform_rms_radius();
    p.space.home.position.z = 20.0;
    p.space.region = machine::requirements::Region::Ellipsoid;
    p.space.translation = Vector3::new(4.0, 4.0, 3.0);
    p.space.rotation_deg = Vector3::repeat(10.0);
    p.variables.offset_bounds = [(0.0, 1.0); 6];
    p.requirements.min_joint_distance = Some(1e-6);
    p.requirements.hardware.leg_length = Some(limits);
    p.min_abs_det = 1e-9;
    p
}

#[test]
#[ignore = "evidence"]
fn what_other_starts_can_meet_is_no_conflict() {
    let p = long_struts(LengthLimits::Range(24.0, 33.0));
    // the compromise has joints in the middle of sides, where the least length has a saddle that climbs do not leave
    let model = Model::new(&p).unwrap();
    let others =
        [TermKind::MaxLegLength, TermKind::BaseSpacing, TermKind::PlatformSpacing].map(ConstraintGroup::Term);
    let dropped = others.into_iter().chain([ConstraintGroup::Determinant]).collect();
    let task = Task { weights: vec![0.0], floors: vec![None], dropped, soft: None };
    let middle = [0.5, 0.55, 0.6, 0.45, 0.3, 0.6];
    let stuck = refine(&model, &task, &middle, model.first_poses(), 1);
    assert!(!stuck.run.is_feasible());
    let mut silent = |_| ControlFlow::Continue(());
    let mut watch = ProgressReport::new(&model, &mut silent);
    let met = attempt(&model, &task, &[stuck], &quick(), 0, &mut watch);
    assert!(met.is_ok_and(|r| r.run.is_feasible() && r.complete));
    let found = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    let DimensionalOutcome::Infeasible(conflict) = &found.outcome else { panic!("{found:?}") };
    let kinds: Vec<Demand> = conflict.demands.iter().map(|g| g.demand).collect();
    assert_eq!(kinds, [TermKind::MinLegLength, TermKind::MaxLegLength].map(Demand::Requirement));
    // each of them alone is feasible
    for limits in [LengthLimits::Range(24.0, 100.0), LengthLimits::Range(1.0, 33.0)] {
        let found =
            optimize(&long_struts(limits), &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
        assert!(found.solution().is_some(), "{limits:?}");
    }
}

/// A search interrupted during the search for a conflict reports no conflict, since an incomplete attempt shows
/// nothing.
#[test]
fn a_search_that_is_told_to_end_names_no_conflict() {
    let mut p = problem(&[VariableKind::Offsets], Objective::WorstConditioning);
    p.requirements.hardware.leg_length = Some(LengthLimits::Range(1e3, 1.1e3));
    let ended = optimize(&p, &[], &quick(), &mut |now| match now.stage {
        Stage::Conflict => ControlFlow::Break(()),
        _ => ControlFlow::Continue(()),
    });
    let ended = ended.unwrap();
    assert!(ended.interrupted && matches!(ended.outcome, DimensionalOutcome::Undecided(_)), "{ended:?}");
    // and it returns the least violation found
    assert!(ended.nearest.is_some());
    // negative control: without the interruption there is a conflict
    let found = optimize(&p, &[], &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
    assert!(matches!(found.outcome, DimensionalOutcome::Infeasible(_)), "{found:?}");
}

/// Eight trials with a single end are enough; trials with all different ends never are.
#[test]
fn trials_are_enough_when_their_ends_repeat() {
    let first = |ends: usize| (1..1000).find(|n| expects_no_other(*n, ends));
    assert_eq!([1, 2, 3, 8].map(first), [Some(8), Some(17), Some(30), Some(155)]);
    assert!((1..1000).all(|n| !expects_no_other(n, n)));
}
