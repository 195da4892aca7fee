//! What `build tolerances` writes.

use std::fmt::Write as _;

use super::Found;
use crate::app::cli::numbers::significant;
use crate::app::cli::requirements;
use crate::app::cli::table::{column_unit, csv_line, number};
use ask::Design;
use machine::manufacture::{ErrorAtPose, ErrorParts, Trials};
use records::{
    AssessAnswer, BudgetPosesRecord, CalibratedPosesRecord, CorrelationsWord, ErrorMapRecord,
    JointBudgetRecord, Number, PoseErrorRecord, SolvedBudgetRecord, TolerancesAnswer, TrialsRecord,
    WorkspaceWord, WorstErrorsRecord,
};

/// The record of the answer.
pub(super) fn record(design: &Design, f: &Found, seed: u64, path: Option<String>) -> TolerancesAnswer {
    let b = &f.budget;
    TolerancesAnswer {
        assessment: AssessAnswer::of(design, seed),
        bound: (f.bound.position, f.bound.rotation_deg).into(),
        tool: [f.tool.x, f.tool.y, f.tool.z].map(Number),
        units: design.units.clone(),
        all_joints_radius: b.radius,
        all_coordinates: b.half_width,
        joints: b.joints.iter().map(|j| JointBudgetRecord::new(design, j)).collect(),
        worst_errors: WorstErrorsRecord {
            in_budget: f.worst[0].map(PoseErrorRecord::from),
            times_1_5: f.worst[1].map(PoseErrorRecord::from),
            pose: (&b.radius.pose).into(),
        },
        solved: SolvedBudgetRecord {
            within_bound: f.solved.within(),
            largest_share: f.solved.share.map(Number),
            radius: f.solved.radius.map(Number),
        },
        trials: (&f.trials).into(),
        calibrated: f.calibrated.as_ref().map(TrialsRecord::from),
        calibrated_poses: f.computed.as_ref().and_then(|poses| CalibratedPosesRecord::new(design, poses)),
        map: f.map.as_ref().and_then(|(errors, map)| ErrorMapRecord::new(errors, map, path)),
        poses: BudgetPosesRecord {
            count: b.poses,
            workspace: if f.workspace_given { WorkspaceWord::Design } else { WorkspaceWord::Default },
        },
    }
}

fn optional(x: Option<Number>) -> String {
    x.map_or("any".to_string(), |x| format!("{:.3e}", x.0))
}

/// What solving says about the radius.
fn sentence(f: &Found, units: &str) -> String {
    let radius = f.solved.radius.map_or_else(String::new, |r| {
        format!("; with {r:.6e} {units} the worst errors found keep it when they are solved")
    });
    match f.solved.share {
        _ if f.solved.within() => "solved, no error looked at in the budget goes beyond the bound".into(),
        Some(share) => {
            format!(
                "the first order is too wide: solved, errors in the budget use up {share:.6} of the bound{radius}"
            )
        }
        None => format!("the first order is too wide: poses with errors in the budget were lost{radius}"),
    }
}

pub(super) fn text(design: &Design, f: &Found, r: &TolerancesAnswer) -> String {
    let (b, t, units) = (&f.budget, &f.trials, &design.units);
    let mut out = requirements::lead(&design.name, r.assessment.as_ref());
    let _ = writeln!(
        out,
        "\n{}: error of the tool point at most {} {units}, of the orientation {} deg ({} poses, {} workspace)\n",
        design.name,
        f.bound.position,
        f.bound.rotation_deg,
        b.poses,
        if f.workspace_given { "given" } else { "default" }
    );
    // writing to a string cannot fail
    let _ = writeln!(
        out,
        "to first order every joint may be off by {:.6e} {units} in any direction ({} is the limit)",
        b.radius.value,
        b.radius.kind.as_str()
    );
    let _ = writeln!(
        out,
        "to first order every coordinate may be off by {:.6e} {units} ({} is the limit)\n",
        b.half_width.value,
        b.half_width.kind.as_str()
    );
    let _ = writeln!(
        out,
        "most critical first    alone      worst direction           pos/unit  deg/unit  alone along x, y, z              all, largest product"
    );
    for j in &r.joints {
        let direction = j.direction.iter().map(|x| format!("{:6.3}", x.0)).collect::<Vec<_>>().join(" ");
        let list = |v: &[Option<Number>; 3]| {
            v.iter().map(|x| format!("{:>9}", optional(*x))).collect::<Vec<_>>().join(" ")
        };
        let _ = writeln!(
            out,
            "{:<8} {:<12} {:>9.3e}  ({direction})  {:>8.3}  {:>8.4}  {}  {}",
            j.body.to_string(),
            j.joint,
            j.alone.value,
            j.position_per_unit.0,
            j.rotation_deg_per_unit.0,
            list(&j.along_axes),
            list(&j.largest_product)
        );
    }
    for (what, e) in ["the budget", "1.5 times it"].iter().zip(&f.worst) {
        if let Some((p, w)) = e {
            let _ = writeln!(
                out,
                "\njoints off by {what} in the worst way, solved: {p:.6e} {units}, {w:.6e} deg"
            );
        }
    }
    let _ = writeln!(out, "\n{}", sentence(f, units));
    spread(&mut out, "random errors in the budget", t);
    if let Some(calibrated) = &f.calibrated {
        spread(&mut out, "random errors with the covariance of the calibration", calibrated);
    }
    if let Some(computed) = &r.calibrated_poses {
        computed_poses(&mut out, computed, units);
    }
    if let Some(map) = &r.map {
        let _ = writeln!(
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
            let _ = writeln!(
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
            let _ = writeln!(out, "wrote {path}");
        }
    }
    out
}

/// What the calibration does not know of computed poses.
fn computed_poses(out: &mut String, r: &CalibratedPosesRecord, units: &str) {
    let known = r.correlations == CorrelationsWord::Design;
    let _ = writeln!(
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
        let _ = write!(
            out,
            "{what}: {} {unit} in the median, {} at {}",
            significant(d.median.0),
            significant(d.greatest.0),
            d.pose.short()
        );
        let _ = if known {
            writeln!(out, " ({} without the correlations)", significant(d.independent.0))
        } else {
            writeln!(out)
        };
    }
}

/// What random errors did to the pose.
fn spread(out: &mut String, what: &str, t: &Trials) {
    let _ = writeln!(
        out,
        "\n{} {what}: {} within the bound, {} beyond it, {} lost\n\n{:<28} {:>11} {:>11} {:>11} {:>11}  max [deg]",
        t.count,
        t.within,
        t.count - t.lost - t.within,
        t.lost,
        "error of the pose",
        "median",
        "90 %",
        "99 %",
        "max"
    );
    let rows = [
        ("nominal formula", &t.formula),
        ("  its first order is off by", &t.discrepancy),
        ("after one Newton step", &t.corrected[0]),
        ("after two", &t.corrected[1]),
    ];
    for (what, s) in rows {
        let q = &s.position;
        let _ = writeln!(
            out,
            "{what:<28} {:>11.3e} {:>11.3e} {:>11.3e} {:>11.3e}  {:.3e}",
            q.median, q.p90, q.p99, q.max, s.rotation_deg.max
        );
    }
}

/// The map of errors as a table, a pose a line.
pub(super) fn map(design: &Design, map: &[ErrorAtPose]) -> String {
    let unit = column_unit(&design.units);
    let mut header: Vec<String> = ["x", "y", "z"].iter().map(|axis| format!("{axis}_{unit}")).collect();
    header.extend(["roll_deg", "pitch_deg", "yaw_deg"].map(str::to_string));
    for what in ["position", "rotation"] {
        let unit = if what == "position" { unit.as_str() } else { "deg" };
        header.extend(["", "_by_joints", "_by_lengths", "_by_growth"].map(|of| format!("{what}{of}_{unit}")));
    }
    let mut out = csv_line(&header);
    for at in map {
        let parts = |p: &ErrorParts| [p.total, p.joints, p.lengths, p.growth];
        let numbers = at.pose.position.iter().copied().chain(at.pose.angles().degrees());
        let numbers = numbers.chain(parts(&at.position)).chain(parts(&at.rotation_deg));
        out.push_str(&csv_line(&numbers.map(number).collect::<Vec<_>>()));
    }
    out
}
