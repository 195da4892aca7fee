//! The joint errors allowed.

use super::poses::{POSE, pose, units as pose_units};
use super::verdict;
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use records::{
    CalibratedPosesRecord, CorrelationsWord, JointBudgetRecord, Number, SolvedBudgetRecord, SourceWord,
    TolerancesAnswer, TrialsRecord,
};

/// The answer of `build tolerances` about a design of this name; `margins`: the place with the margins of the design.
#[must_use]
pub fn tolerances(name: &str, r: &TolerancesAnswer, margins: &str) -> Sheet {
    let units = &r.units;
    let mut out = Sheet::new();
    let [joint, coordinate] = [&r.all_joints_radius, &r.all_coordinates];
    say!(
        out,
        "{name}: every joint may be off by {} {units} in any direction, to first order (limited by {})",
        figure(joint.value),
        joint.kind.name()
    );
    say!(
        out,
        "Required accuracy: tool point {} {units}, orientation {} deg, at {} poses of the {} workspace",
        figure(r.bound.position.0),
        figure(r.bound.rotation_deg.0),
        r.poses.count,
        if r.poses.workspace == SourceWord::Design { "design's" } else { "default" }
    );
    say!(
        out,
        "Every coordinate may be off by {} {units}, to first order (limited by {})",
        figure(coordinate.value),
        coordinate.kind.name()
    );
    say!(out, "{}.", sentence(&r.solved, units));
    out.space();
    out.table(joints(&r.joints, units));
    out.space();
    for (what, e) in [
        ("this tolerance", &r.worst_errors.in_budget),
        ("1.5 times this tolerance", &r.worst_errors.times_1_5),
    ] {
        if let Some(e) = e {
            let (p, w) = (figure(e.position.0), figure(e.rotation_deg.0));
            say!(out, "Greatest pose error for joints off by {what}, solved exactly: {p} {units}, {w} deg");
        }
    }
    spread(&mut out, "random joint errors within this tolerance", &r.trials, units);
    if let Some(calibrated) = &r.calibrated {
        spread(&mut out, "random joint errors with the covariance of the calibration", calibrated, units);
    }
    if let Some(computed) = &r.calibrated_poses {
        computed_poses(&mut out, computed, units);
    }
    if let Some(map) = &r.map {
        say!(
            out,
            "\nGreatest pose errors at {} poses, to first order, for joint errors of {} {units}, length errors of {} {units} and growth factors {} (base, platform, legs)",
            map.poses,
            figure(map.joint_error.0),
            figure(map.length_error.0),
            map.growth.map(|x| figure(x.0)).join(", ")
        );
        for (what, unit, worst) in
            [("position", units.as_str(), &map.position), ("orientation", "deg", &map.rotation_deg)]
        {
            say!(
                out,
                "{what}: {} {unit} at {POSE} = {}{}; from joints alone {}, from lengths {}, from growth {} {unit}; median {} {unit}",
                figure(worst.greatest.0),
                pose(&worst.pose),
                pose_units(units, "deg"),
                figure(worst.joints.0),
                figure(worst.lengths.0),
                figure(worst.growth.0),
                figure(worst.median.0)
            );
        }
        if let Some(path) = &map.path {
            say!(out, "wrote {path}");
        }
    }
    out.space();
    out.add(verdict(name, r.assessment.as_ref(), margins));
    out
}

/// The uncertainty of computed poses due to the errors of the calibration.
fn computed_poses(out: &mut Sheet, r: &CalibratedPosesRecord, units: &str) {
    let known = r.correlations == CorrelationsWord::Design;
    say!(
        out,
        "\nStandard deviations of computed poses due to the calibration, to first order, at {} poses, {}",
        r.poses,
        if known {
            "with the correlations of the design file"
        } else {
            "with independent coordinates and offsets (the design file has no correlations)"
        }
    );
    for (what, unit, d) in [("position", units, &r.position), ("orientation", "deg", &r.rotation_deg)] {
        let without = if known {
            format!(" ({} {unit} without the correlations)", figure(d.independent.0))
        } else {
            String::new()
        };
        say!(
            out,
            "{what}: median {} {unit}, greatest {} {unit} at {POSE} = {}{}{without}",
            figure(d.median.0),
            figure(d.greatest.0),
            pose(&d.pose),
            pose_units(units, "deg")
        );
    }
}

/// The joints, the most critical first.
fn joints(joints: &[JointBudgetRecord], units: &str) -> Table {
    let text = |title: &str, width| left(title, width).gap(2);
    let mut table = Table::new([
        left("body", 8),
        left("joint", 12),
        right(in_units("alone", units), 9),
        text("worst direction", 22),
        right(per_unit(units), 8).gap(2),
        right(per_unit_angle(units), 8).gap(2),
        text(&in_units("alone along x, y, z", units), 29),
        text(&in_units("box of largest volume", units), 0),
    ]);
    let optional = |x: &Option<Number>| x.map_or("any".to_string(), |x| figure(x.0));
    let list = |v: &[Option<Number>; 3]| v.each_ref().map(optional).join(", ");
    for j in joints {
        table.row([
            j.body.to_string(),
            j.joint.clone(),
            figure(j.alone.value),
            j.direction.map(|x| figure(x.0)).join(", "),
            figure(j.position_per_unit.0),
            figure(j.rotation_deg_per_unit.0),
            list(&j.along_axes),
            list(&j.largest_product),
        ]);
    }
    table
}

/// The title of the position error for a unit joint error.
fn per_unit(units: &str) -> String {
    if units == "1" { "position error".to_owned() } else { format!("position {units}/{units}") }
}

/// The title of the orientation error for a unit joint error.
fn per_unit_angle(units: &str) -> String {
    if units == "1" { "orientation deg".to_owned() } else { format!("orientation deg/{units}") }
}

/// A title with its unit; designs without a unit have the label `1`.
fn in_units(title: &str, units: &str) -> String {
    if units == "1" { title.to_owned() } else { format!("{title} [{units}]") }
}

/// The exact check of the first-order radius.
fn sentence(solved: &SolvedBudgetRecord, units: &str) -> String {
    let radius = solved.radius.map_or_else(String::new, |r| {
        format!(". The worst errors found stay within the required accuracy up to {} {units}", figure(r.0))
    });
    match solved.largest_share {
        _ if solved.within_bound => {
            "Checked without linearisation: no sampled error within this tolerance exceeds the required accuracy".into()
        }
        Some(share) => format!(
            "The first order is too optimistic: without linearisation, errors within it exceed the required accuracy by {} %{radius}",
            figure(100.0 * (share.0 - 1.0))
        ),
        None => format!("The first order is too optimistic: some errors within it have no solution nearby{radius}"),
    }
}

/// The effect of random errors on the pose.
fn spread(out: &mut Sheet, what: &str, t: &TrialsRecord, units: &str) {
    say!(
        out,
        "\n{} {what}: {} within the required accuracy, {} beyond it, {} without a solution nearby\n",
        t.count,
        t.within_bound,
        t.beyond_bound,
        t.lost
    );
    let numbers = ["median", "90 %", "99 %", "max"].map(|title| right(title, 11));
    let columns = [left(in_units("pose error", units), 28)].into_iter().chain(numbers);
    let rows = [
        ("nominal kinematics", &t.formula),
        ("  minus its first order", &t.first_order_discrepancy),
        ("after one Newton step", &t.after_one_step),
        ("after two steps", &t.after_two_steps),
    ];
    let rows = rows.map(|(what, s)| {
        let q = &s.position;
        let numbers = [q.median, q.p90, q.p99, q.max, s.rotation_deg.max].map(figure);
        [what.to_owned()].into_iter().chain(numbers)
    });
    out.table(Table::new(columns.chain([left("max [deg]", 0).gap(2)])).with_rows(rows));
}
