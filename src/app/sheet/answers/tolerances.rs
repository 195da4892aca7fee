//! The joint errors allowed.

use super::requirements;
use crate::{Sheet, Table, left, right};
use num::shown::significant;
use records::{
    CalibratedPosesRecord, CorrelationsWord, JointBudgetRecord, Number, SolvedBudgetRecord, TolerancesAnswer,
    TrialsRecord, WorkspaceWord,
};

/// The answer of `build tolerances` about a design of this name.
#[must_use]
pub fn tolerances(name: &str, r: &TolerancesAnswer) -> Sheet {
    let units = &r.units;
    let mut out = requirements(name, r.assessment.as_ref());
    say!(
        out,
        "\n{name}: error of the tool point at most {} {units}, of the orientation {} deg ({} poses, {} workspace)\n",
        r.bound.position.0,
        r.bound.rotation_deg.0,
        r.poses.count,
        if r.poses.workspace == WorkspaceWord::Design { "given" } else { "default" }
    );
    for (what, limit) in [("joint", &r.all_joints_radius), ("coordinate", &r.all_coordinates)] {
        let any = if what == "joint" { " in any direction" } else { "" };
        say!(
            out,
            "to first order every {what} may be off by {:.6e} {units}{any} ({} is the limit)",
            limit.value,
            limit.kind.name()
        );
    }
    out.space();
    out.table(joints(&r.joints));
    for (what, e) in [("the budget", &r.worst_errors.in_budget), ("1.5 times it", &r.worst_errors.times_1_5)]
    {
        if let Some(e) = e {
            let (p, w) = (e.position.0, e.rotation_deg.0);
            say!(out, "\njoints off by {what} in the worst way, solved: {p:.6e} {units}, {w:.6e} deg");
        }
    }
    say!(out, "\n{}", sentence(&r.solved, units));
    spread(&mut out, "random errors in the budget", &r.trials);
    if let Some(calibrated) = &r.calibrated {
        spread(&mut out, "random errors with the covariance of the calibration", calibrated);
    }
    if let Some(computed) = &r.calibrated_poses {
        computed_poses(&mut out, computed, units);
    }
    if let Some(map) = &r.map {
        say!(
            out,
            "\nat {} poses, to first order, the greatest errors by joints off by {} {units}, lengths by {} {units} and growth of {} (base, platform, legs)",
            map.poses,
            significant(map.joint_error.0),
            significant(map.length_error.0),
            map.growth.map(|x| significant(x.0)).join(", ")
        );
        for (what, unit, worst) in
            [("position", units.as_str(), &map.position), ("orientation", "deg", &map.rotation_deg)]
        {
            say!(
                out,
                "{what}: {} {unit} at {}; by joints alone {}, by lengths {}, by growth {}; half of the poses stay below {}",
                significant(worst.greatest.0),
                worst.pose.short(),
                significant(worst.joints.0),
                significant(worst.lengths.0),
                significant(worst.growth.0),
                significant(worst.median.0)
            );
        }
        if let Some(path) = &map.path {
            say!(out, "wrote {path}");
        }
    }
    out
}

/// The uncertainty of computed poses due to the errors of the calibration.
fn computed_poses(out: &mut Sheet, r: &CalibratedPosesRecord, units: &str) {
    let known = r.correlations == CorrelationsWord::Design;
    say!(
        out,
        "\nstandard deviations of computed poses by what the calibration does not know, to first order, at {} poses, {}",
        r.poses,
        if known {
            "with the correlations of the design file"
        } else {
            "every coordinate and offset off for itself, since the design file has no correlations"
        }
    );
    for (what, unit, d) in [("position", units, &r.position), ("orientation", "deg", &r.rotation_deg)] {
        let without = if known {
            format!(" ({} without the correlations)", significant(d.independent.0))
        } else {
            String::new()
        };
        say!(
            out,
            "{what}: {} {unit} in the median, {} at {}{without}",
            significant(d.median.0),
            significant(d.greatest.0),
            d.pose.short()
        );
    }
}

/// The joints, the most critical first.
fn joints(joints: &[JointBudgetRecord]) -> Table {
    let text = |title: &str, width| left(title, width).gap(2);
    let mut table = Table::new([
        left("most critical", 8),
        left("first", 12),
        right("alone", 9),
        text("worst direction", 22),
        right("pos/unit", 8).gap(2),
        right("deg/unit", 8).gap(2),
        text("alone along x, y, z", 29),
        text("all, largest product", 0),
    ]);
    let optional = |x: &Option<Number>| x.map_or("any".to_string(), |x| format!("{:.3e}", x.0));
    let list = |v: &[Option<Number>; 3]| v.each_ref().map(|x| format!("{:>9}", optional(x))).join(" ");
    for j in joints {
        table.row([
            j.body.to_string(),
            j.joint.clone(),
            format!("{:.3e}", j.alone.value),
            format!("({})", j.direction.map(|x| format!("{:6.3}", x.0)).join(" ")),
            format!("{:.3}", j.position_per_unit.0),
            format!("{:.4}", j.rotation_deg_per_unit.0),
            list(&j.along_axes),
            list(&j.largest_product),
        ]);
    }
    table
}

/// The exact check of the first-order radius.
fn sentence(solved: &SolvedBudgetRecord, units: &str) -> String {
    let radius = solved.radius.map_or_else(String::new, |r| {
        format!("; with {:.6e} {units} the worst errors found keep it when they are solved", r.0)
    });
    match solved.largest_share {
        _ if solved.within_bound => "solved, no error looked at in the budget goes beyond the bound".into(),
        Some(share) => format!(
            "the first order is too wide: solved, errors in the budget use up {:.6} of the bound{radius}",
            share.0
        ),
        None => format!("the first order is too wide: poses with errors in the budget were lost{radius}"),
    }
}

/// The effect of random errors on the pose.
fn spread(out: &mut Sheet, what: &str, t: &TrialsRecord) {
    say!(
        out,
        "\n{} {what}: {} within the bound, {} beyond it, {} lost\n",
        t.count,
        t.within_bound,
        t.beyond_bound,
        t.lost
    );
    let numbers = ["median", "90 %", "99 %", "max"].map(|title| right(title, 11));
    let columns = [left("error of the pose", 28)].into_iter().chain(numbers);
    let rows = [
        ("nominal formula", &t.formula),
        ("  its first order is off by", &t.first_order_discrepancy),
        ("after one Newton step", &t.after_one_step),
        ("after two", &t.after_two_steps),
    ];
    let rows = rows.map(|(what, s)| {
        let q = &s.position;
        let numbers = [q.median, q.p90, q.p99, q.max, s.rotation_deg.max].map(|x| format!("{x:.3e}"));
        [what.to_owned()].into_iter().chain(numbers)
    });
    out.table(Table::new(columns.chain([left("max [deg]", 0).gap(2)])).with_rows(rows));
}
