//! det J at poses, along paths, and the box in which it is proved not to vanish.

use super::poses::{pose, units, words, written};
use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use platform::geom::Pose;
use records::{
    PoseConventionRecord, PoseFiguresRecord, PoseInFrames, PoseQuaternionRecord, SignOutcome,
    SignPairsRecord, SignPathRecord, SingularitiesAnswer,
};
use synthesis::singularity::RegularityWord;

/// The convention of the poses in a sheet: its description, and the numbers of a pose in it.
struct Convention<'a> {
    record: &'a PoseConventionRecord,
    write: &'a dyn Fn(&Pose) -> PoseInFrames,
}

impl Convention<'_> {
    /// The numbers of a pose with commas.
    fn pose(&self, record: &PoseQuaternionRecord) -> String {
        if self.record.is_usual() {
            return pose(record);
        }
        written(&(self.write)(&record.into())).map(figure).join(",")
    }

    /// The names of these numbers.
    fn names(&self) -> &'static str {
        words(self.record)
    }
}

/// The answer of `singular poses`; `of_the_design`: the region comes from the design. Poses have the convention, in
/// which `write` gives the numbers of a pose.
#[must_use]
pub fn singular_poses(
    r: &SingularitiesAnswer,
    of_the_design: bool,
    convention: &PoseConventionRecord,
    write: &dyn Fn(&Pose) -> PoseInFrames,
) -> Sheet {
    let convention = &Convention { record: convention, write };
    let mut out = Sheet::new();
    let name = &r.name;
    if let Some(regular) = &r.regular {
        let region = if of_the_design { "workspace" } else { "region of --box" };
        let names = convention.names();
        let at = regular.pose.as_ref().map_or_else(|| "any".to_owned(), |found| convention.pose(found));
        match regular.status {
            RegularityWord::Proved => say!(out, "{name}: no singular pose in the {region}, proved."),
            RegularityWord::ChangesSign => {
                say!(
                    out,
                    "{name}: the {region} contains a singular pose, proved: det J changes its sign on the path to {names} = {at}."
                );
            }
            RegularityWord::Undecided => {
                say!(
                    out,
                    "{name}: undecided whether the {region} contains a singular pose near {names} = {at}; more --cells may decide."
                );
            }
        }
    }
    regular_box(&mut out, r);
    let negative = r.assembly_modes.iter().filter(|m| m.determinant.0 < 0.0).count();
    say!(
        out,
        "{} assembly modes, {} with det J > 0 and {negative} with det J < 0{}",
        r.assembly_modes.len(),
        r.assembly_modes.len() - negative,
        if r.assembly_modes_accounted { "" } else { "; some may be missing" }
    );
    out.space();
    out.table(rows(r, convention));
    r.path.iter().for_each(|found| path(&mut out, found));
    r.between.iter().for_each(|found| pairs(&mut out, found));
    out
}

/// The region about the pose that is proved to be free of singular poses.
fn regular_box(out: &mut Sheet, r: &SingularitiesAnswer) {
    let b = &r.regular_box;
    let listed = |widths: [f64; 3], scale: f64| widths.map(|w| figure(w * scale)).join(", ");
    let widths = |scale: f64| {
        let (positions, angles) = (listed(b.translation, scale), listed(b.rotation_deg, scale));
        let unit = if r.units == "1" { String::new() } else { format!(" {}", r.units) };
        let about =
            if b.pivot.iter().all(|x| *x == 0.0) { String::new() } else { " about the pivot".to_owned() };
        format!("{positions}{unit} and {angles} deg (rotation vector{about})")
    };
    let shape = b.region.name();
    if !(b.proved_scale.0 > 0.0) {
        out.line("No region around the pose is proved to be regular: the pose itself may be singular.");
        return;
    }
    let proved = b.proved_scale.0;
    say!(
        out,
        "Proved regular: the {shape} around the pose with half widths {}, for every equivalent platform too.",
        widths(proved)
    );
    let requested = format!("That is {} times the requested {shape}", figure(proved));
    match &b.singular_within {
        Some(s) => say!(
            out,
            "{requested}; at {} times, the {shape} contains a singular pose, proved.",
            figure(s.scale.0)
        ),
        None => {
            say!(out, "{requested}; up to {} times, no singular pose was found.", figure(b.searched_scale.0));
        }
    }
}

/// A row for the pose and for each assembly mode.
fn rows(r: &SingularitiesAnswer, convention: &Convention<'_>) -> Table {
    let title = format!("{}{}", convention.names(), units(&r.units, &convention.record.angles));
    let det = if r.units == "1" { "det J".to_owned() } else { format!("det J {}^3", r.units) };
    let columns = [left("", 8), right(det, 8).gap(2), right("conditioning", 0).gap(2)];
    let mut table = Table::new(columns.into_iter().chain([left(title, 0).gap(2)]));
    let mut row = |name: String, j: &PoseFiguresRecord| {
        table.row([name, figure(j.determinant.0), figure(j.inverse_condition.0), convention.pose(&j.pose)]);
    };
    row("pose".into(), &r.pose);
    for (k, mode) in r.assembly_modes.iter().enumerate() {
        row(format!("mode {}", k + 1), mode);
    }
    table
}

/// The sign of det J along a path, in words.
fn path(out: &mut Sheet, r: &SignPathRecord) {
    say!(
        out,
        "\nStraight path from mode {} to mode {} (0 is the pose), as a fraction of its length:",
        r.from,
        r.to
    );
    for (k, part) in r.parts.iter().enumerate() {
        say!(out, "  part {}", k + 1);
        for p in &part.pieces {
            let told = match p.sign.0 {
                Some(sign) if sign > 0 => "det J > 0, proved",
                Some(_) => "det J < 0, proved",
                None if p.singular => "a singular pose, proved by a change of sign",
                None => "undecided: det J is zero or nearly zero",
            };
            say!(out, "    {} to {}: {told}", figure(p.from.0), figure(p.to.0));
        }
    }
}

/// The assembly modes joined by regular paths, in words.
fn pairs(out: &mut Sheet, r: &SignPairsRecord) {
    let n = r.signs.len();
    out.line(
        "\nStraight paths between modes: `=` det J keeps its sign, proved; `x` it changes its sign, proved; `?` undecided",
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
    out.line("Modes joined by paths without a singular pose, proved:");
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
