//! All poses for given lengths, or one pose that is tracked.

use std::fmt::Display;

use super::poses::{POSE, angle, numbers, pose, units as pose_units, written};
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use fk::{CompletenessWord, NearWord};
use machine::coupled::DriveSolutionWord;
use platform::geom::ComplexPose;
use records::{
    ClosureRecord, DriveSolutionRecord, FkAnswer, FkOneAnswer, FkRowOutcome, FkRowRecord, NearRecord, Number,
    PolynomialRecord, PoseConventionRecord, RotationPolynomialRecord, SolutionRecord, SolutionSetRecord,
    SolvedRecord,
};

/// The answer of `fk` for a design of this name, in its units.
#[must_use]
pub fn fk(name: &str, units: &str, answer: &FkAnswer) -> Sheet {
    match answer {
        FkAnswer::One(one) => one_set(name, units, one),
        FkAnswer::Rows(answer) => many(&answer.rows, units),
    }
}

fn one_set(name: &str, units: &str, one: &FkOneAnswer) -> Sheet {
    let mut out = Sheet::new();
    match (&one.drives, &one.near) {
        (Some(drives), Some(near)) => out.line(drive_sentence(drives, near, units)),
        (None, Some(near)) => followed(&mut out, name, near, units),
        _ => {}
    }
    if one.near.is_none() || one.drives.is_some() {
        counts(&mut out, name, &one.solved);
    }
    poses(&mut out, units, &one.solved, one.frames.as_ref());
    if one.angles_deg.is_some() {
        out.line(elbows(&one.solved));
        beyond_limits(&mut out, one, "");
        symmetric(&mut out, one);
    }
    if let Some(found) = &one.closure {
        closure(&mut out, found);
    }
    if let Some(found) = &one.polynomial {
        rotations(&mut out, found);
    }
    out
}

fn solved(row: &FkRowRecord) -> Option<&FkOneAnswer> {
    match &row.outcome {
        FkRowOutcome::Solved(one) => Some(one),
        FkRowOutcome::Failed(_) => None,
    }
}

/// The table of all rows, one line each. Cranks beyond their limits follow the table.
fn many(rows: &[FkRowRecord], units: &str) -> Sheet {
    let first = rows.iter().find_map(solved);
    let columns = if first.is_some_and(|one| one.drives.is_some()) {
        vec![left("pose and its proof", 0)]
    } else if first.is_some_and(|one| one.near.is_some()) {
        let numbers = [right("segments", 8), right("conditioning", 17)];
        [left("outcome", 16)]
            .into_iter()
            .chain(numbers)
            .chain([left(format!("{POSE}{}", pose_units(units, "deg")), 0)])
            .collect()
    } else {
        vec![left("method", 13), right("finite", 6), right("real", 4), left("complete", 0)]
    };
    let columns = columns.into_iter().map(|column| column.gap(2));
    let mut table = Table::new([right("line", 4)].into_iter().chain(columns));
    for row in rows {
        table.row([row.line.to_string()].into_iter().chain(cells(&row.outcome, units)));
    }
    let mut out = Sheet::from(table);
    for row in rows {
        if let Some(one) = solved(row) {
            beyond_limits(&mut out, one, &format!("line {}: ", row.line));
        }
    }
    out
}

/// The cells of a row after the number of its line.
fn cells(outcome: &FkRowOutcome, units: &str) -> Vec<String> {
    let one = match outcome {
        FkRowOutcome::Solved(one) => one,
        FkRowOutcome::Failed(why) => {
            return ["-", "-", "-", &why.error.message].map(str::to_owned).into();
        }
    };
    match (&one.drives, &one.near) {
        (Some(drives), Some(near)) => vec![drive_sentence(drives, near, units)],
        (None, Some(near)) => vec![
            near.outcome.name().to_owned(),
            near.segments.to_string(),
            figure(near.inverse_condition.0),
            position(near),
        ],
        _ => {
            let s = &one.solved;
            let complete = match s.completeness {
                _ if !s.solution_set.witness_points().is_empty() => "SELF-MOTION",
                CompletenessWord::Proved => "proved",
                CompletenessWord::ProvedBounded => "proved, all real",
                CompletenessWord::Modular => "modular",
                CompletenessWord::Unproved if s.all_paths_accounted => "all paths accounted",
                CompletenessWord::Unproved => "ROOTS MAY BE MISSING",
            };
            let counts = [s.finite_count, s.real_count].map(|n| n.to_string());
            [s.method.to_string()].into_iter().chain(counts).chain([complete.to_owned()]).collect()
        }
    }
}

fn position(near: &NearRecord) -> String {
    pose(&near.reached)
}

/// A number with its noun, in the plural unless it is one.
fn counted<N: Copy + Display + PartialEq + From<u8>>(count: N, noun: &str) -> String {
    if count == N::from(1) { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// The tracking of the pose, before the list of poses.
fn followed(out: &mut Sheet, name: &str, near: &NearRecord, units: &str) {
    let share = 100.0 * near.fraction;
    match near.outcome {
        NearWord::Tracked => say!(
            out,
            "{name}: the pose was followed from the start pose; it moved by {} {units} and {} deg. Its conditioning is {} ({}, {}).",
            figure(near.distance.0),
            figure(angle(near.angle_deg.0)),
            figure(near.inverse_condition.0),
            counted(near.segments, "segment"),
            counted(near.newton_steps, "Newton step")
        ),
        NearWord::NearSingularity => say!(
            out,
            "{name}: NEAR A SINGULAR POSE, stopped after {} % of the path at a conditioning of {}.",
            figure(share),
            figure(near.inverse_condition.0)
        ),
        NearWord::Lost => {
            say!(
                out,
                "{name}: POSE LOST after {} % of the path: {}",
                figure(share),
                near.reason.as_deref().unwrap_or_default()
            );
        }
    }
    if let Some(found) = &near.uncertainty {
        say!(
            out,
            "Standard deviations due to the calibration: {} {units} and {} deg",
            figure(found.position.0),
            figure(found.rotation_deg.0)
        );
    }
}

/// The pose for the lengths of drives with joints that are not ideal.
fn drive_sentence(drives: &DriveSolutionRecord, near: &NearRecord, length: &str) -> String {
    let (at, steps) = (position(near) + &pose_units(length, "deg"), drives.steps);
    match drives.status {
        DriveSolutionWord::Proved => {
            let [position, angle] =
                [drives.position_bound, drives.angle_bound_deg].map(|x| x.map_or(f64::INFINITY, |x| x.0));
            format!(
                "{POSE} = {at}: proved, the pose with these drive lengths is within {} {length} and {} deg of it ({})",
                figure(position),
                figure(angle),
                counted(steps, "step")
            )
        }
        DriveSolutionWord::Unproved => format!(
            "{POSE} = {at}: NOT PROVED, the corrections converged after {}, but no bound of the error is proved",
            counted(steps, "step")
        ),
        _ => {
            let why = drives.reason.as_deref().unwrap_or_default();
            format!(
                "NO POSE after {}: {why}; contraction factor {}",
                counted(steps, "step"),
                figure(drives.factor.0)
            )
        }
    }
}

/// The number of poses, or the set that they form.
fn counts(out: &mut Sheet, name: &str, s: &SolvedRecord) {
    if let SolutionSetRecord::PositiveDimensional { dimension_at_least, witness_points, .. } = &s.solution_set
    {
        let what = if *dimension_at_least == 1 { "curve" } else { "set" };
        say!(
            out,
            "{name}: self-motion, a {what} of poses of dimension at least {dimension_at_least}, with {} found on it and {} (method {})",
            counted(witness_points.len(), "point"),
            counted(s.finite_count, "isolated pose"),
            s.method
        );
    } else {
        let undecided = match s.undecided_count {
            0 => String::new(),
            n => format!(", {n} undecided"),
        };
        say!(
            out,
            "{name}: {} finite {}, {} of them real{undecided} (method {})",
            s.finite_count,
            if s.finite_count == 1 { "pose" } else { "poses" },
            s.real_count,
            s.method
        );
    }
}

/// The completeness of the list, and the real poses.
fn poses(out: &mut Sheet, units: &str, s: &SolvedRecord, frames: Option<&PoseConventionRecord>) {
    say!(out, "{}: {}", completeness(s), s.completeness_reason);
    for call in &s.library_calls {
        let [rows, columns] = call.size;
        say!(
            out,
            "{} computed {} of {rows} x {columns}, calls: {}",
            call.library,
            call.computation,
            call.calls
        );
    }
    let frames = frames.filter(|frames| !frames.is_usual());
    let mut listed: Vec<_> = s.numbered().filter(|(_, r)| r.real != Some(false)).collect();
    let violating = listed.len();
    listed.retain(|(_, r)| r.real_pose.is_none_or(|pose| pose.allowed != Some(false)));
    let violating = violating - listed.len();
    listed.sort_by(|(_, a), (_, b)| from_home(a).total_cmp(&from_home(b)));
    out.space();
    out.table(real_poses(&listed, units, frames));
    if violating > 0 {
        say!(out, "{violating} real poses violate requirements: see --json");
    }
    if let Some(frames) = frames {
        out.line(&frames.sentence);
    }
    let complex = s.solutions.iter().filter(|r| r.real == Some(false)).count();
    if complex > 0 {
        say!(out, "{complex} complex poses: see --json");
    }
    if !s.unproved.is_empty() {
        say!(
            out,
            "{} path ends without a certificate (multiple poses, several close poses, or none); --json lists them as `unproved`. Ends that may be real:",
            s.unproved.len()
        );
        for (i, r) in s.unproved.iter().enumerate().filter(|(_, r)| r.real != Some(false)) {
            unproved_pose(out, i + 1, r);
        }
    }
}

/// The beginning of the completeness sentence, before the reason.
fn completeness(s: &SolvedRecord) -> &'static str {
    let moves = matches!(s.solution_set, SolutionSetRecord::PositiveDimensional { .. });
    let as_written =
        matches!(s.solution_set, SolutionSetRecord::PositiveDimensional { dimension_established: true, .. });
    match (s.completeness, moves, s.all_paths_accounted) {
        (CompletenessWord::Proved, ..) => "All poses are found, proved",
        (CompletenessWord::ProvedBounded, ..) => "All real poses are found, proved",
        (CompletenessWord::Modular, ..) => "All poses are found, counted modulo random primes",
        (CompletenessWord::Unproved, true, true) if as_written => "Self-motion, established",
        (CompletenessWord::Unproved, true, true) => "Self-motion within the rounding of the lengths",
        (CompletenessWord::Unproved, true, false) => "UNDECIDED: self-motion",
        (CompletenessWord::Unproved, false, true) => "Not proved to be all poses",
        (CompletenessWord::Unproved, false, false) => "INCOMPLETE, poses may be missing",
    }
}

/// The real part of a pose: position, then roll, pitch and yaw in degrees.
fn shown(r: &SolutionRecord) -> [f64; 6] {
    numbers(&ComplexPose::from(&r.pose).real_part())
}

/// The distance of a pose from home; poses that are not real come last.
fn from_home(r: &SolutionRecord) -> f64 {
    r.real_pose.map_or(f64::INFINITY, |pose| pose.distance_from_home)
}

/// A row for each real pose, in the convention `frames` where it is not the usual one.
fn real_poses(
    listed: &[(usize, &SolutionRecord)],
    units: &str,
    frames: Option<&PoseConventionRecord>,
) -> Table {
    let position =
        ["x", "y", "z"].map(|axis| if units == "1" { axis.to_owned() } else { format!("{axis} {units}") });
    let angles = match frames {
        None => ["roll", "pitch", "yaw"].map(|angle| format!("{angle} deg")),
        Some(frames) => ["a", "b", "c"].map(|angle| format!("{angle} {}", frames.angles)),
    };
    let columns = position.into_iter().chain(angles).map(|title| right(title, 8).gap(2));
    let columns = [right("pose", 0)].into_iter().chain(columns);
    let mut table = Table::new(columns.chain([left("root", 0).gap(2)]));
    for (number, r) in listed {
        let kind = match (r.certified, r.real.is_some()) {
            (true, true) => "certified",
            (false, true) => "not certified",
            (true, false) => "certified, real or complex undecided",
            (false, false) => "not certified, real or complex undecided",
        };
        let mut kind = kind.to_owned();
        let mut numbers = shown(r);
        if let Some(pose) = r.real_pose {
            let own = pose.in_frames;
            if frames.is_some() {
                numbers = written(&own);
            }
            if pose.nearest_home {
                kind.push_str(", nearest to home");
            }
            if !own.angles_unique {
                kind.push_str(", angles not unique");
            }
        }
        table.row([number.to_string()].into_iter().chain(numbers.map(figure)).chain([kind]));
    }
    table
}

/// A possible multiple pose, with the number of paths that end near it.
fn unproved_pose(out: &mut Sheet, number: usize, r: &SolutionRecord) {
    say!(out, "{number:>3}  near {POSE} = {}  paths {}", shown(r).map(figure).join(","), r.multiplicity);
}

/// The real poses with all cranks on the sides that the design keeps.
fn elbows(s: &SolvedRecord) -> String {
    let kept =
        s.numbered().filter(|(_, r)| r.real_pose.and_then(|p| p.elbow_kept).is_some_and(|k| k == [true; 6]));
    let kept: Vec<String> = kept.map(|(i, _)| i.to_string()).collect();
    match kept.len() {
        0 => "No real pose has all cranks on the elbow sides of the design.".into(),
        1 => format!("All cranks have the elbow sides of the design in pose {}.", kept[0]),
        _ => format!("All cranks have the elbow sides of the design in poses {}.", kept.join(", ")),
    }
}

/// The cranks beyond their limits at the given angles, after the words `before`; nothing if there are none.
fn beyond_limits(out: &mut Sheet, answer: &FkOneAnswer, before: &str) {
    let legs: Vec<String> = answer.outside.iter().map(ToString::to_string).collect();
    let (crank, is) = if legs.len() == 1 { ("crank of leg", "is") } else { ("cranks of legs", "are") };
    if !legs.is_empty() {
        say!(out, "{before}the {crank} {} {is} beyond `angle_deg`", legs.join(", "));
    }
}

/// The theorem about symmetric tips, in words.
fn symmetric(out: &mut Sheet, answer: &FkOneAnswer) {
    let Some(count) = answer.symmetric_finite else { return };
    let certified = answer.solved.solutions.iter().filter(|s| s.certified).count();
    let listed = if certified == count {
        "the same number is certified here; further poses are due to rounding of the tips"
    } else {
        "not all of them are certified here"
    };
    say!(
        out,
        "Tips and joints have three-fold symmetry within rounding. The exactly symmetric platform has {count} finite poses, and {listed}."
    );
}

/// The polynomial in a Cayley parameter: its degree, the accuracy of its coefficients, its real roots.
fn rotations(out: &mut Sheet, found: &RotationPolynomialRecord) {
    let p = match found {
        RotationPolynomialRecord::Polynomial(p) => p,
        RotationPolynomialRecord::None { error } => return say!(out, "no polynomial in c3: {error}"),
    };
    of_poses(out, "polynomial in c3 = z / w of the quaternion", p);
}

/// A polynomial whose roots are the values of a number at all poses.
fn of_poses(out: &mut Sheet, what: &str, p: &PolynomialRecord) {
    let bounds = p.coefficient_bounds.as_deref().unwrap_or_default();
    let most = |of: fn(&[Number; 2]) -> f64| bounds.iter().map(of).fold(0.0, f64::max);
    let widest = most(|[low, high]| high.0 - low.0) / most(|[low, high]| low.0.abs().max(high.0.abs()));
    say!(
        out,
        "{what}: degree {}, {} real roots; coefficients enclosed to {} of the largest (see --json)",
        p.degree.unwrap_or(0),
        p.real_roots.len(),
        figure(widest)
    );
    real_roots(out, p);
}

fn real_roots(out: &mut Sheet, p: &PolynomialRecord) {
    let middle = |[low, high]: &[Number; 2]| figure(0.5 * (low.0 + high.0));
    let roots: Vec<String> = p.real_roots.iter().map(middle).collect();
    if !roots.is_empty() {
        say!(out, "its real roots: {}", roots.join(", "));
    }
}

/// The closure polynomial in two lines.
fn closure(out: &mut Sheet, closure: &ClosureRecord) {
    let p = match closure {
        ClosureRecord::Polynomial(p) => p,
        ClosureRecord::OfPoses(p) => {
            let [x, y] = &p.unknown;
            let what = format!("polynomial in the squared distance of {x} and {y}, computed from all poses");
            of_poses(out, &what, &p.polynomial);
            return say!(out, "No polynomial follows from trilaterations: {}", p.no_sequence);
        }
        ClosureRecord::None { error } => return say!(out, "no closure polynomial: {error}"),
    };
    let [x, y] = &p.unknown;
    say!(
        out,
        "closure polynomial in the squared distance of {x} and {y}: degree {} before, {} after removal of singular factors, {} distinct roots, {} real",
        p.polynomial.degree_before,
        p.polynomial.degree.unwrap_or(0),
        p.polynomial.distinct_roots.unwrap_or(0),
        p.polynomial.real_roots.len()
    );
    real_roots(out, &p.polynomial);
    match p.poses_real_proved {
        Some(n) => say!(out, "real poses: {n}, proved by its real roots"),
        None => out.line("real poses: not decided by its real roots alone"),
    }
}
