//! The report in Markdown.

use std::fmt::Write as _;

use super::general::capital;
use super::{MachineFiles, Results, folder};
use ask::equivalents::Original;
use ask::rounding::{DesignOnHoles, RoundingWay, grid_in_words};
use ask::{LengthsOrigin, OptimizeEvidence};
use files::export::{PART_COLUMNS, PartLine};
use fk::Completeness;
use records::{AssessAnswer, DerivationRecord, VerifyAnswer};
use sheet::{Sheet, Table, answers, left, markdown_escaped as plain};
use synthesis::Pattern;

/// The whole report. Writing to a string cannot fail, so the results of `write!` are dropped.
pub(super) fn markdown(r: &Results, headline: &[String]) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "# {}: {}\n\nEvidence: {}.\n",
        plain(&r.design.name),
        r.found.verdict().name().replace('_', " "),
        plain(&r.explanation())
    );
    for line in headline {
        let _ = writeln!(out, "{}.\n", plain(&capital(line)));
    }
    if let (Some(_), Some(a)) = (r.found.built(), &r.assessment) {
        requirements(&mut out, a);
    }
    if let Some(machine) = &r.machine {
        parts(&mut out, machine);
    }
    if let Some(Ok(on)) = &r.found.holes {
        holes(&mut out, on, &r.design.units);
    }
    inputs(&mut out, r);
    class(&mut out, r);
    search(&mut out, r);
    if let Some(v) = &r.verified {
        verification(&mut out, r, v);
    }
    poses(&mut out, r);
    reproduction(&mut out, r);
    out
}

fn inputs(out: &mut String, r: &Results) {
    let d = &r.design;
    let _ = writeln!(out, "## Input\n");
    let _ = writeln!(out, "Design: [{0}]({0}), lengths in {1}.", folder::ORIGINAL, plain(&d.units));
    if let Some(source) = &d.source {
        let _ = writeln!(out, "Source: {}.", plain(source));
    }
    let _ = writeln!(out, "\n{}", Sheet::from(answers::legs(d)).markdown());
}

fn class(out: &mut String, r: &Results) {
    let c = r.found.family.counts();
    let _ = writeln!(
        out,
        "## Equivalence class\n\n{} patterns of legs equivalent to the octahedral one, {} up to symmetry ({} when base \
         and platform may be exchanged); {} topologies ({}), {} of them ({}) reached by one offset at a time. \
         All patterns: [{7}]({7}).\n",
        c.patterns,
        c.classes,
        c.classes_exchange,
        c.topologies,
        c.topologies_exchange,
        c.sequential_topologies,
        c.sequential_topologies_exchange,
        folder::FAMILY,
    );
}

/// The table of `assess` for the platform.
fn requirements(out: &mut String, found: &AssessAnswer) {
    let table = answers::requirements_without_assumptions(found).markdown();
    let _ = writeln!(out, "## Requirements\n\n{table}\n{}.\n", plain(&found.regular_explanation));
}

/// The bill of materials and the files of the machine.
fn parts(out: &mut String, machine: &MachineFiles) {
    let rows = machine.parts.iter().map(PartLine::fields);
    let table = Table::new(PART_COLUMNS.map(|title| left(title, 0))).with_rows(rows);
    let _ = writeln!(
        out,
        "## Bill of materials\n\nMillimetres and kilograms; empty where the design does not say it. The same as a table: [{0}/parts.csv]({0}/parts.csv).\n\n{1}",
        folder::MACHINE,
        Sheet::from(table).markdown()
    );
    let _ = writeln!(
        out,
        "\nSolids, hole plans, simulation, controller and drawing are in [{0}]({0}).",
        folder::MACHINE
    );
    for (format, why) in &machine.refused {
        let _ = writeln!(out, "The format {format} cannot hold this platform: {}.", plain(why));
    }
    out.push('\n');
}

/// The holes of the joints.
fn holes(out: &mut String, on: &DesignOnHoles, units: &str) {
    let [base, platform] = on.choices.grids.map(|grid| grid_in_words(grid.as_ref()));
    let _ = writeln!(
        out,
        "## Joints on holes\n\nHoles of the base: {base}; of the platform: {platform}. Platforms sought and rounded: {}. Details: [{1}]({1}).\n",
        on.passes,
        folder::ROUND
    );
    let Some((way, _)) = &on.found else {
        let _ = writeln!(out, "No platform has its joints on these holes.\n");
        return;
    };
    let (joints, how) = match way {
        RoundingWay::Exact => (
            on.rounding.exact.as_ref().map(|e| &e.joints).ok(),
            "All joints are corners of two triangles of holes or lie exactly on their sides, so that the platform is equivalent to an octahedral one without any error.",
        ),
        RoundingWay::Nearest => (
            on.rounding.nearest.as_ref().map(|n| &n.joints).ok(),
            "All joints are on holes next to their given places, and not on the lines of the triangles.",
        ),
    };
    let again: Vec<&str> = on.refitted.iter().map(|kind| kind.code()).collect();
    let after = if again.is_empty() {
        String::new()
    } else {
        format!(" Chosen again after rounding: {}.", plain(&again.join(", ")))
    };
    let rows = joints.into_iter().flatten().map(|j| {
        let name = on.given.joint_names(j.joint.body)[j.joint.index].clone();
        let hole = j.cell.map_or_else(|| "as given".into(), |[i, k]| format!("{i}, {k}"));
        [j.joint.body.to_string(), name, hole, format!("{:.3}", j.moved.norm())]
    });
    let titles = ["body", "joint", "hole", &format!("moved [{units}]")].map(|title| left(title, 0));
    let table = Table::new(titles).with_rows(rows);
    let _ = writeln!(
        out,
        "{how}{after} Design: [{0}]({0}).\n\n{1}",
        folder::ROUNDED,
        Sheet::from(table).markdown()
    );
}

/// The verdict of the comparison, and the map that proves it.
fn verification(out: &mut String, r: &Results, v: &VerifyAnswer) {
    let [design, optimised] = [r.design.name.as_str(), "the platform found"];
    let verdict = answers::verify(v, design, optimised).markdown();
    let map = answers::leg_map(&v.map, design, optimised).markdown();
    let _ = writeln!(
        out,
        "## Verdict: {}\n\n{verdict}\nDetails: [{1}]({1}).\n\n## Leg map\n\n{map}",
        v.verdict.name().replace('_', " "),
        folder::VERIFY
    );
    if let Some(steps) = derivation(r, v) {
        let steps = answers::derivation_steps(&steps).markdown();
        let _ = writeln!(out, "## How the leg map follows\n{steps}");
    }
}

/// The steps to the platform without shared joints, if one was found.
fn derivation(r: &Results, v: &VerifyAnswer) -> Option<DerivationRecord> {
    r.found.search.offsets()?;
    let original = Original::of(&r.design)?;
    let steps = original.derivation(&Pattern::new([false; 6], [1; 6])?, r.found.search.design()?)?;
    Some(DerivationRecord::new(&steps, &original, v.clone()))
}

/// The result of the search.
fn search(out: &mut String, r: &Results) {
    let found = answers::search(&r.design.name, &r.answer).markdown();
    let _ = writeln!(out, "## Search\n\n{found}\nDetails: [{0}]({0}).", folder::OPTIMIZE);
    if r.found.search.offsets().is_some() || matches!(r.found.search.evidence, OptimizeEvidence::Offsets(_)) {
        let _ = writeln!(out, "\n![det A over the two offsets]({})", folder::DETERMINANT);
    }
    out.push('\n');
}

fn poses(out: &mut String, r: &Results) {
    let s = &r.found.poses.solutions;
    let lengths: Vec<String> = r.found.poses.lengths.get().iter().map(ToString::to_string).collect();
    let whose = match r.found.poses.origin {
        LengthsOrigin::Design => "its own leg lengths",
        LengthsOrigin::Home => "the leg lengths of its home pose (the design gives none)",
    };
    let complete = match &s.completeness {
        Completeness::Proved { .. } => "proved",
        Completeness::ProvedBounded { .. } => "proved for all real poses",
        Completeness::Modular { .. } => "modulo random primes",
        Completeness::Unproved { .. } if s.all_accounted() => "not proved",
        Completeness::Unproved { .. } => "NOT proved, poses may be missing",
    };
    let reason = s.completeness.to_string();
    let _ = writeln!(
        out,
        "## Assembly modes\n\nThe design at {whose}, ({}) {}: {} finite poses, {} real, {} certified (method {}). \
         Completeness: {complete}, {}. Details: [{}]({}).\n\n![Assembly modes]({})\n",
        lengths.join(", "),
        plain(&r.design.units),
        s.roots.len(),
        s.assembly_modes().count(),
        s.roots.iter().filter(|r| r.certified()).count(),
        s.method,
        plain(&reason),
        folder::FK,
        folder::FK,
        folder::MODES
    );
}

fn reproduction(out: &mut String, r: &Results) {
    let (t, samples) = (r.options.tolerances, r.verified.as_ref().map_or(0, |_| r.samples));
    let _ = writeln!(
        out,
        "## To repeat this\n\n    equipod explore {} -o DIR --seed {} --samples {} --extension {}\n\nequipod {}. Tolerances of forward \
         kinematics, dimensionless: residual {:.0e}, distinct poses {:.0e}, reality {:.0e}.",
        folder::ORIGINAL,
        r.options.seed,
        samples.max(1),
        r.extension,
        env!("CARGO_PKG_VERSION"),
        t.residual,
        t.distinct,
        t.reality
    );
}
