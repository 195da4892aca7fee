//! Numbers of the library for the self-test of the C code: poses about home, paths between them, and invalid inputs.

use std::fmt::Write as _;

use nalgebra::{DMatrix, Matrix3, Rotation3, Vector3};

use super::{EquivalentOctahedral, braces, heading, number};
use crate::export::Export;
use fk::{NearOptions, NearOutcome, NearSolver, WhyLost};
use machine::reach::{PoseAxis, Reach, StraightPath};
use machine::requirements::{Hardware, Limit, Requirements, TermKind, Terms};
use num::Rng;
use num::double_double::DoubleDouble;
use platform::geom::Pose;
use platform::manipulator::{SquaredLegLengths, jacobian};

/// Seed of the poses.
const SEED: u64 = 21;
/// Greatest rotation (radians) and shift (over the size) of poses about home.
const AWAY: f64 = 0.12;
/// Number of poses for inverse kinematics besides those of the workspace.
const POSES: usize = 16;
/// Greatest number of poses from the workspace.
const OF_WORKSPACE: usize = 9;
/// Lengths of paths: rotations in radians and shifts over the size.
const WAYS: [f64; 6] = [1e-4, 1e-3, 1e-2, 0.05, 0.2, 0.5];
/// Number of paths of each length.
const REPEATS: usize = 6;
/// Segments allowed: the value of `EQUIPOD_SEGMENTS`.
const SEGMENTS: u32 = 8;
/// Number of poses whose paths are followed to their limits.
const FREE_WAYS: usize = 3;
/// Newton steps that correct a mapped pose.
const CORRECTIONS: u32 = 2;

pub(super) fn text(export: &Export) -> String {
    let mut rng = Rng::new(SEED);
    let about: Vec<Pose> = (0..POSES).map(|_| moved(&export.home, AWAY, export.size, &mut rng)).collect();
    let mut out = heading(export);
    let mut poses: Vec<Pose> = export.workspace.iter().take(OF_WORKSPACE).copied().collect();
    poses.extend(&about);
    list(&mut out, "inverse_vector", "inverse_vectors", poses.iter().filter_map(|p| inverse(export, p)));
    list(&mut out, "track_vector", "track_vectors", paths(export, &mut rng).iter().map(|w| track(export, w)));
    list(&mut out, "newton_vector", "newton_vectors", newton(export, &about, &mut rng));
    list(&mut out, "free_vector", "free_vectors", free(export, &mut rng));
    if let Some(found) = &export.calibration {
        let whole = found.of_legs(&export.manipulator.pairs());
        let entries = about.iter().filter_map(|pose| covariance(export, &whole, pose));
        list(&mut out, "covariance_vector", "covariance_vectors", entries);
    }
    if let Some(octahedral) = &export.octahedral {
        let starts = about.iter().filter_map(|start| {
            let end = moved(start, 1e-2, export.size, &mut rng);
            mapped(export, octahedral, start, &end)
        });
        let starts: Vec<String> = starts.collect();
        list(&mut out, "map_vector", "map_vectors", starts);
    }
    out
}

pub(super) fn list(out: &mut String, kind: &str, name: &str, entries: impl IntoIterator<Item = String>) {
    let entries: Vec<String> = entries.into_iter().collect();
    let _ = writeln!(out, "\nstatic const {kind} {name}[] = {{\n    {}\n}};", entries.join(",\n    "));
}

/// The pose moved at random by about `far`.
pub(super) fn moved(pose: &Pose, far: f64, size: f64, rng: &mut Rng) -> Pose {
    let mut vector = || Vector3::from_fn(|_, _| rng.uniform(-far, far));
    let (turn, shift) = (vector(), vector() * size);
    Pose { rotation: Rotation3::new(turn) * pose.rotation, position: pose.position + shift }
}

pub(super) fn row(values: &[f64]) -> String {
    braces(values.iter().map(|x| number(*x)))
}

pub(super) fn pose_numbers(pose: &Pose) -> String {
    let r = pose.rotation.matrix();
    let rows = (0..3).map(|i| row(&[r[(i, 0)], r[(i, 1)], r[(i, 2)]]));
    braces([braces(rows), row(pose.position.as_slice())])
}

/// Lengths, Jacobian and margins at a pose; `None` where a leg has no direction or lengths overflow.
fn inverse(export: &Export, pose: &Pose) -> Option<String> {
    let m = &export.manipulator;
    let squares = pose.squared_lengths(m)?;
    let lengths = squares.lengths().get();
    if !lengths.iter().all(|l| *l > 0.0) {
        return None;
    }
    let j = jacobian(m, pose, 1.0);
    let rows = (0..6).map(|i| row(&std::array::from_fn::<f64, 6, _>(|k| j[(i, k)])));
    let required = Requirements { hardware: export.hardware, ..Requirements::default() };
    let margins = Terms::new(m, &required, &export.home).at(pose);
    let kinds = [
        TermKind::MinLegLength,
        TermKind::MaxLegLength,
        TermKind::BaseConeAngle,
        TermKind::PlatformConeAngle,
    ];
    let margins = kinds.map(|kind| {
        let of_leg = |leg: usize| margins.iter().find(|(t, _)| t.kind == kind && t.first == leg);
        row(&std::array::from_fn::<f64, 6, _>(|leg| of_leg(leg).map_or(f64::INFINITY, |m| m.1)))
    });
    let entries = [pose_numbers(pose), row(&squares.get()), row(&lengths), braces(rows)];
    Some(braces(entries.into_iter().chain(margins)))
}

/// The covariance of a pose, `J^-1 E C E^T J^-T`, with the covariance `C` of joints and offsets by legs; `None` at a
/// singular pose.
fn covariance(export: &Export, by_legs: &DMatrix<f64>, pose: &Pose) -> Option<String> {
    let m = &export.manipulator;
    let j = jacobian(m, pose, 1.0);
    let mut errors = DMatrix::zeros(6, 42);
    for i in 0..6 {
        let u = Vector3::new(j[(i, 0)], j[(i, 1)], j[(i, 2)]);
        let back = pose.rotation.inverse() * u;
        for k in 0..3 {
            (errors[(i, 7 * i + k)], errors[(i, 7 * i + 3 + k)]) = (-u[k], back[k]);
        }
        errors[(i, 7 * i + 6)] = 1.0;
    }
    let shown = &errors * by_legs * errors.transpose();
    let inverse = j.try_inverse()?;
    let found = inverse * shown * inverse.transpose();
    let rows = (0..6).map(|i| row(&std::array::from_fn::<f64, 6, _>(|k| found[(i, k)])));
    Some(braces([pose_numbers(pose), braces(rows)]))
}

/// The start of a tracked pose and its final squared lengths.
struct TrackedPath {
    start: Pose,
    squares: SquaredLegLengths,
    segments: u32,
}

/// Paths of all lengths about home. Further paths end at a singularity, are too far, or begin at an invalid pose.
fn paths(export: &Export, rng: &mut Rng) -> Vec<TrackedPath> {
    let (m, home) = (&export.manipulator, &export.home);
    let mut out = Vec::new();
    let mut push = |start: Pose, squares: Option<SquaredLegLengths>, segments: u32| {
        out.extend(squares.map(|squares| TrackedPath { start, squares, segments }));
    };
    for far in WAYS {
        for _ in 0..REPEATS {
            let start = moved(home, AWAY, export.size, rng);
            let end = moved(&start, far, export.size, rng);
            push(start, end.squared_lengths(m), SEGMENTS);
        }
    }
    let far = moved(home, 1.0, export.size, rng);
    push(*home, home.squared_lengths(m), SEGMENTS);
    push(*home, far.squared_lengths(m), 1);
    push(*home, far.squared_lengths(m), 1000);
    for (leg, factor) in [(0, 0.01), (3, 4.0)] {
        let squares = home.squared_lengths(m).and_then(|s| {
            let mut s = s.get();
            s[leg] *= factor;
            SquaredLegLengths::try_new(s).ok()
        });
        push(*home, squares, 1000);
    }
    let turned = home.rotation.matrix();
    for factor in [1.1, -1.0] {
        let matrix: Matrix3<f64> = turned * factor;
        let start = Pose { rotation: Rotation3::from_matrix_unchecked(matrix), ..*home };
        push(start, home.squared_lengths(m), SEGMENTS);
    }
    out
}

fn track(export: &Export, path: &TrackedPath) -> String {
    let options = NearOptions { segments: path.segments, ..NearOptions::default() };
    let outcome = NearSolver::with_options(&export.manipulator, options).solve(&path.squares, &path.start);
    let (status, reason, fraction) = told(&outcome);
    let evidence = outcome.evidence();
    braces([
        pose_numbers(&path.start),
        row(&path.squares.get()),
        path.segments.to_string(),
        status.to_string(),
        reason.to_string(),
        pose_numbers(outcome.pose()),
        number(fraction),
        evidence.segments.to_string(),
        evidence.newton_steps.to_string(),
        number(evidence.kantorovich),
        number(evidence.frobenius_ratio),
        number(evidence.residual),
        number(evidence.distance),
    ])
}

/// The C names of an outcome, and the fraction of the path reached.
fn told(outcome: &NearOutcome) -> (&'static str, &'static str, f64) {
    match outcome {
        NearOutcome::Tracked { .. } => ("EQUIPOD_TRACKED", "EQUIPOD_NO_REASON", 1.0),
        NearOutcome::NearSingularity { fraction, .. } => {
            ("EQUIPOD_NEAR_SINGULAR", "EQUIPOD_NO_REASON", *fraction)
        }
        NearOutcome::Lost { reason, fraction, .. } => {
            let reason = match reason {
                WhyLost::StartIsNoPose => "EQUIPOD_START_IS_NO_POSE",
                WhyLost::SegmentsExhausted | WhyLost::AnglesTooFar => "EQUIPOD_SEGMENTS_EXHAUSTED",
                WhyLost::NoConvergence => "EQUIPOD_NO_CONVERGENCE",
            };
            ("EQUIPOD_LOST", reason, *fraction)
        }
    }
}

fn newton(export: &Export, about: &[Pose], rng: &mut Rng) -> Vec<String> {
    let solver = NearSolver::new(&export.manipulator);
    let entry = |(k, start): (usize, &Pose)| {
        let steps = u32::try_from(k % 4).unwrap_or(0);
        let squares = moved(start, 1e-2, export.size, rng).squared_lengths(&export.manipulator)?;
        let found = solver.newton_steps(&squares, start, steps);
        Some(braces([
            pose_numbers(start),
            row(&squares.get()),
            steps.to_string(),
            u8::from(found.is_some()).to_string(),
            pose_numbers(&found.unwrap_or(*start)),
        ]))
    };
    about.iter().take(8).enumerate().filter_map(entry).collect()
}

/// Paths from poses about home with their free travel by lengths and joint angles: each axis, and some with both
/// velocities.
fn free(export: &Export, rng: &mut Rng) -> Vec<String> {
    let hardware = Hardware {
        leg_length: export.hardware.leg_length,
        base_cone_angle: export.hardware.base_cone_angle,
        platform_cone_angle: export.hardware.platform_cone_angle,
        ..Hardware::default()
    };
    let required = Requirements { hardware, ..Requirements::default() };
    let reach = Reach::new(&export.manipulator, &required, &export.home, export.size);
    let mut out = Vec::new();
    for k in 0..FREE_WAYS {
        let start = if k == 0 { export.home } else { moved(&export.home, 0.02, export.size, rng) };
        if !reach.allows(&start) {
            continue;
        }
        let mut vector = |far: f64| Vector3::from_fn(|_, _| rng.uniform(-far, far));
        let mixed = StraightPath {
            start,
            velocity: vector(export.size),
            turn: vector(1.0),
            pivot: nalgebra::Vector3::zeros(),
        };
        let far = |axis: PoseAxis| if axis.is_turn() { 1.0 } else { export.size };
        let axes = PoseAxis::ALL.map(|axis| (StraightPath::axis(&start, axis), far(axis)));
        for (path, mut most) in axes.into_iter().chain([(mixed, 1.0)]) {
            let found = reach.along(&path, most);
            let mut travel = (found.amount, found.binding.is_some());
            if found.binding == Some(Limit::Singular) {
                // the C code does not search for singular poses
                most = 0.5 * found.amount;
                travel = (most, false);
            }
            out.push(braces([
                pose_numbers(&start),
                row(path.velocity.as_slice()),
                row(path.turn.as_slice()),
                number(most),
                number(travel.0),
                u8::from(travel.1).to_string(),
            ]));
        }
    }
    if out.is_empty() {
        // home itself violates a limit; C has no empty lists, and the self-test skips paths of length zero
        out.push(braces([
            pose_numbers(&export.home),
            row(&[0.0; 3]),
            row(&[0.0; 3]),
            number(0.0),
            number(0.0),
            "0".to_string(),
        ]));
    }
    out
}

/// The map in the plain doubles of the C code, and a bound of their rounding.
fn image(octahedral: &EquivalentOctahedral, s: &[f64; 6]) -> ([f64; 6], [f64; 6]) {
    let (mut to, mut radius) = ([0.0; 6], [0.0; 6]);
    for i in 0..6 {
        let (mut sum, mut size) = (octahedral.c[i], octahedral.c[i].abs());
        for (a, s) in octahedral.a[i].iter().zip(s) {
            let term = a * s;
            sum += term;
            size += term.abs();
        }
        to[i] = sum;
        radius[i] = 12.0 * (f64::EPSILON / 2.0) * size + f64::MIN_POSITIVE;
    }
    (to, radius)
}

/// `None` if the octahedral platform has no such lengths.
fn mapped(export: &Export, octahedral: &EquivalentOctahedral, start: &Pose, end: &Pose) -> Option<String> {
    let squares = end.squared_lengths(&export.manipulator)?;
    let (to, radius) = image(octahedral, &squares.get());
    let target = SquaredLegLengths::try_within(to.map(DoubleDouble::from), radius).ok()?;
    let options = NearOptions { segments: SEGMENTS, ..NearOptions::default() };
    let outcome = NearSolver::with_options(&octahedral.manipulator, options).solve(&target, start);
    let own = NearSolver::new(&export.manipulator);
    let corrected = outcome.tracked().and_then(|pose| own.newton_steps(&squares, pose, CORRECTIONS));
    Some(braces([
        pose_numbers(start),
        row(&squares.get()),
        row(&to),
        row(&radius),
        told(&outcome).0.to_string(),
        pose_numbers(outcome.pose()),
        CORRECTIONS.to_string(),
        pose_numbers(&corrected.unwrap_or(*outcome.pose())),
    ]))
}
