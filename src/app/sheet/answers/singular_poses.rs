//! det J at poses, along paths, and the box in which it is proved not to vanish.

use crate::{Sheet, Table, right};
use records::{
    JudgedPoseRecord, PoseQuaternionRecord, SignOutcome, SignPairsRecord, SignPathRecord, SingularitiesAnswer,
};
use synthesis::singularity::RegularityWord;

/// The answer of `singular poses`; `of_the_design`: the region comes from the design.
#[must_use]
pub fn singular_poses(r: &SingularitiesAnswer, of_the_design: bool) -> Sheet {
    let mut out = Sheet::new();
    out.line(&r.name);
    if let Some(regular) = &r.regular {
        let region = if of_the_design { "workspace" } else { "region of --box" };
        let at = regular.pose.as_ref().map(PoseQuaternionRecord::short).unwrap_or_default();
        match regular.status {
            RegularityWord::Proved => say!(out, "The {region} is free of singular poses: proved."),
            RegularityWord::ChangesSign => {
                say!(out, "The {region} holds a singular pose: det J changes its sign on the way to {at}.");
            }
            RegularityWord::Undecided => {
                say!(
                    out,
                    "It is undecided whether the {region} holds a singular pose, near {at}; more --cells may decide."
                );
            }
        }
    }
    judged(&mut out, "pose", &r.pose);
    for (k, mode) in r.assembly_modes.iter().enumerate() {
        judged(&mut out, &format!("mode {}", k + 1), mode);
    }
    let negative = r.assembly_modes.iter().filter(|m| m.determinant.0 < 0.0).count();
    say!(
        out,
        "{} assembly modes, {} with det J > 0 and {negative} with det J < 0{}",
        r.assembly_modes.len(),
        r.assembly_modes.len() - negative,
        if r.assembly_modes_accounted { "" } else { "; some may be missing" }
    );
    r.path.iter().for_each(|found| path(&mut out, found));
    r.between.iter().for_each(|found| pairs(&mut out, found));
    let b = &r.regular_box;
    let (widths, degrees) = (b.translation, b.rotation_deg);
    say!(
        out,
        "{} of half widths t x ({:.4}, {:.4}, {:.4}) {} and t x ({:.4}, {:.4}, {:.4}) degrees of the rotation vector about the pose:",
        b.region.name(),
        widths[0],
        widths[1],
        widths[2],
        r.units,
        degrees[0],
        degrees[1],
        degrees[2]
    );
    if !(b.proved_scale.0 > 0.0) {
        out.line("  nothing is proved: the pose itself may be singular");
        return out;
    }
    say!(
        out,
        "  no singular pose for t <= {:.4}, proved over {} cells; the same for every equivalent platform",
        b.proved_scale.0,
        b.cells
    );
    match &b.singular_within {
        Some(s) => say!(out, "  a singular pose within t = {:.4}, proved by a change of sign", s.scale.0),
        None => say!(out, "  no change of sign found up to t = {:.4}", b.searched_scale.0),
    }
    out
}

fn judged(out: &mut Sheet, name: &str, j: &JudgedPoseRecord) {
    let p = j.pose.position.map(|x| x.0);
    say!(
        out,
        "{name:<8} [{:.4}, {:.4}, {:.4}]  det J {:+.6e}  inverse condition {:.3e}",
        p[0],
        p[1],
        p[2],
        j.determinant.0,
        j.inverse_condition.0
    );
}

/// The sign of det J along a path, in words.
fn path(out: &mut Sheet, r: &SignPathRecord) {
    say!(out, "path from mode {} to mode {} (0 is the pose):", r.from, r.to);
    for (k, part) in r.parts.iter().enumerate() {
        say!(out, "  part {}", k + 1);
        for p in &part.pieces {
            let told = match p.sign.0 {
                Some(sign) if sign > 0 => "det J > 0, proved",
                Some(_) => "det J < 0, proved",
                None if p.singular => "a singular pose, proved by a change of sign",
                None => "det J vanishes or nearly so",
            };
            say!(out, "    {:<14} to {:<14} {told}", p.from.0, p.to.0);
        }
    }
}

/// The assembly modes joined by regular paths, in words.
fn pairs(out: &mut Sheet, r: &SignPairsRecord) {
    let n = r.signs.len();
    out.line(
        "straight paths between modes: = det J keeps its sign (proved), x changes it (proved), ? neither proved",
    );
    let columns = (1..=n).map(|j| right(j.to_string(), 3).gap(0));
    let mut table = Table::new([right("", 5)].into_iter().chain(columns));
    for i in 1..=n {
        let marks = (1..=n).map(|j| {
            let found = r.pairs.iter().find(|s| s.modes == [i.min(j), i.max(j)]);
            match found.map(|s| s.straight) {
                None => ".",
                Some(SignOutcome::KeepsSign) => "=",
                Some(SignOutcome::Crosses) => "x",
                Some(SignOutcome::Undecided) => "?",
            }
        });
        table.row([i.to_string()].into_iter().chain(marks.map(str::to_owned)));
    }
    out.table(table);
    out.line("modes joined by paths without singular pose (proved):");
    for group in &r.groups {
        let sign = match group.first().and_then(|k| r.signs.get(k - 1)?.0) {
            Some(sign) if sign > 0 => "det J > 0",
            Some(_) => "det J < 0",
            None => "sign not proved",
        };
        let names: Vec<String> = group.iter().map(ToString::to_string).collect();
        say!(out, "  {sign}: {}", names.join(", "));
    }
}
