//! What `build tolerances` writes.

use std::fmt::Write as _;

use super::Found;
use crate::cli::requirements;
use crate::design::Design;
use crate::records::{
    AssessAnswer, BudgetPosesRecord, JointBudgetRecord, Number, PoseErrorRecord, SolvedBudgetRecord,
    TolerancesAnswer, WorkspaceWord, WorstErrorsRecord,
};

/// The record of the answer.
pub(super) fn record(design: &Design, f: &Found, seed: u64) -> TolerancesAnswer {
    let b = &f.budget;
    TolerancesAnswer {
        assessment: AssessAnswer::briefly(design, seed),
        bound: (f.bound.position, f.bound.rotation_deg).into(),
        tool: [f.tool.x, f.tool.y, f.tool.z].map(Number),
        units: design.units.clone(),
        all_joints_radius: (&b.radius).into(),
        all_coordinates: (&b.half_width).into(),
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
            j.alone.value.0,
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
    let _ = writeln!(
        out,
        "\n{}\n\n{} random errors in the budget: {} within the bound, {} beyond it, {} lost\n\n{:<28} {:>11} {:>11} {:>11} {:>11}  max [deg]",
        sentence(f, units),
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
    out
}
