//! The report in Markdown.

use std::fmt::Write as _;

use super::{Machine, Results, Verified, folder};
use crate::app::cli::commands::optimize::opened_file;
use crate::app::cli::requirements as table;
use ask::optimizing::offset_reserves;
use ask::rounding::{DesignOnHoles, RoundingWay, grid_in_words};
use ask::{FoundOffsets, FoundPlatform, OptimizeEvidence};
use files::export::PART_COLUMNS;
use fk::{Completeness, FkSolutions};
use optimize::offsets::OffsetSolution;
use platform::manipulator::LegIndex;
use records::{AssessAnswer, DriveSearchRecord, FreedomRecord, LengthsOrigin, Number};
use synthesis::AffineLegMap;
use verify::SAME_POSE;

/// The whole report. Writing to a string cannot fail, so the results of `write!` are dropped.
pub(super) fn markdown(r: &Results, headline: &[String]) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "# {}: {}\n\nEvidence: {}.\n",
        plain(&r.design.name),
        r.verdict().as_str().replace('_', " "),
        plain(&r.explanation())
    );
    for line in headline {
        let _ = writeln!(out, "{}.\n", sentence(line));
    }
    if let (Some(design), Some(a)) = (r.built(), &r.assessment) {
        requirements(&mut out, &design.name, a);
    }
    if let Some(machine) = &r.machine {
        parts(&mut out, machine);
    }
    if let Some(Ok(on)) = &r.holes {
        holes(&mut out, on, &r.design.units);
    }
    inputs(&mut out, r);
    class(&mut out, r);
    match &r.search.found.evidence {
        OptimizeEvidence::Offsets(found) => offsets(&mut out, r, found),
        OptimizeEvidence::Dimensions(found) => platform(&mut out, r, found),
        OptimizeEvidence::Front(_) => (),
    }
    if let Some(v) = &r.verified {
        verification(&mut out, v);
    }
    poses(&mut out, r);
    reproduction(&mut out, r);
    out
}

/// Text of a design cannot become markup.
pub(super) fn plain(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

fn inputs(out: &mut String, r: &Results) {
    let d = &r.design;
    let _ = writeln!(out, "## Input\n");
    let _ = writeln!(out, "Design: [{0}]({0}), lengths in {1}.", folder::ORIGINAL, plain(&d.units));
    if let Some(source) = &d.source {
        let _ = writeln!(out, "Source: {}.", plain(source));
    }
    let _ = writeln!(out, "\n| leg | base joint | platform joint |\n|---|---|---|");
    for (leg, (a, b)) in LegIndex::all().zip(d.leg_names()) {
        let _ = writeln!(out, "| {} | {} | {} |", leg.get() + 1, plain(a), plain(b));
    }
    let OptimizeEvidence::Offsets(found) = &r.search.found.evidence else {
        out.push('\n');
        return;
    };
    let p = &found.problem;
    let given = |by_design| if by_design { "of the design" } else { "default" };
    let _ = writeln!(
        out,
        "\nHome pose: {}. Worst case over {} poses, workspace: {}. Joints of one body at least {} {} apart, \
         |det A| at least {}, reserve included; characteristic length {} {}.\n",
        given(d.home.is_some()),
        p.poses.len(),
        given(!d.workspace.is_empty()),
        p.min_joint_distance,
        plain(&d.units),
        p.min_abs_det,
        p.characteristic_length,
        plain(&d.units)
    );
}

fn class(out: &mut String, r: &Results) {
    let c = r.family.counts();
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

/// The table of `assess`, which says what the platform is worth.
fn requirements(out: &mut String, name: &str, found: &AssessAnswer) {
    let _ = writeln!(
        out,
        "## Requirements\n\n{}\n\n| requirement | status | least margin | proved margin | of | position at the worst pose |\n|---|---|---|---|---|---|",
        plain(table::sentence(name, found).trim_end())
    );
    for m in &found.requirements {
        let number = |x: f64| {
            if x.is_finite() { format!("{x:.6} {}", plain(&m.unit)) } else { "none".to_owned() }
        };
        let place = m
            .pose
            .as_ref()
            .map_or_else(|| "any".to_owned(), |pose| pose.position.map(|x| format!("{:.4}", x.0)).join(", "));
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} | {place} |",
            plain(m.name.code()),
            plain(m.status.name()),
            number(if m.at_limit { 0.0 } else { m.margin.0 }),
            number(m.proved_margin.0),
            plain(&m.between.join(", "))
        );
    }
    let _ = writeln!(out, "\n{}.\n", plain(&found.regular_explanation));
}

/// The bill of materials and the files of the machine.
fn parts(out: &mut String, machine: &Machine) {
    let _ = writeln!(
        out,
        "## Bill of materials\n\nMillimetres and kilograms; empty where the design does not say it. The same as a table: [{0}/parts.csv]({0}/parts.csv).\n\n| {1} |\n|{2}",
        folder::MACHINE,
        PART_COLUMNS.map(plain).join(" | "),
        "---|".repeat(PART_COLUMNS.len())
    );
    for part in &machine.parts {
        let _ = writeln!(out, "| {} |", part.fields().map(|f| plain(&f)).join(" | "));
    }
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

/// Where the joints went.
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
            "All joints are on holes next to where they were wanted, and not on the lines of the triangles.",
        ),
    };
    let again: Vec<&str> = on.refitted.iter().map(|kind| kind.code()).collect();
    let after = if again.is_empty() {
        String::new()
    } else {
        format!(" Chosen again after rounding: {}.", plain(&again.join(", ")))
    };
    let _ = writeln!(
        out,
        "{how}{after} Design: [{0}]({0}).\n\n| body | joint | hole | moved [{1}] |\n|---|---|---|---|",
        folder::ROUNDED,
        plain(units)
    );
    for j in joints.into_iter().flatten() {
        let name = &on.wanted.joint_names(j.joint.body)[j.joint.index];
        let hole = j.cell.map_or_else(|| "as wanted".into(), |[i, k]| format!("{i}, {k}"));
        let _ = writeln!(out, "| {} | {} | {hole} | {:.3} |", j.joint.body, plain(name), j.moved.norm());
    }
    out.push('\n');
}

/// What was chosen under the requirements.
fn platform(out: &mut String, r: &Results, found: &FoundPlatform) {
    let _ = writeln!(out, "## The best platform under the requirements\n");
    let answer = &r.answer;
    if let Some(s) = &answer.symmetry {
        let _ = writeln!(out, "{}.\n", sentence(&s.message));
    }
    if let Some(d) = &answer.drive_search {
        drives(out, d);
    }
    freedoms(out, answer.freedoms.as_deref().unwrap_or_default());
    let Some((s, c)) = found.report.solution().zip(found.checked.as_ref()) else {
        let _ = writeln!(out, "No platform was found. Details: [{0}]({0}).\n", folder::OPTIMIZE);
        return;
    };
    let _ = writeln!(
        out,
        "Optimised design: [{0}]({0}). Details: [{1}]({1}).\n\n| quantity | value |\n|---|---|",
        folder::OPTIMISED,
        folder::OPTIMIZE
    );
    for (objective, value) in &c.objectives {
        let unit = objective.quantity().map_or_else(String::new, |q| r.design.unit_of(q));
        let _ = writeln!(out, "| {} | {value:.6} {} |", plain(objective.code()), plain(&unit));
    }
    for v in &s.variables {
        let _ = writeln!(out, "| {} | {:.6} |", plain(&v.name), v.value);
    }
    out.push('\n');
    if r.search.keeps_class() && r.search.offsets().is_some() {
        let _ = writeln!(out, "![det A over the two offsets]({})\n", folder::DETERMINANT);
    }
}

/// The first letter large, as a sentence of its own.
fn sentence(text: &str) -> String {
    let mut rest = text.chars();
    rest.next().map_or_else(String::new, |first| plain(&format!("{}{}", first.to_uppercase(), rest.as_str())))
}

/// The drives of the table.
fn drives(out: &mut String, d: &DriveSearchRecord) {
    let price = d.currency.as_ref().map_or("price".to_owned(), |c| format!("price {}", plain(c)));
    let _ = writeln!(
        out,
        "{}.\n\n| drive | outcome | {price} | objective | why not |\n|---|---|---|---|---|",
        sentence(&d.message)
    );
    for drive in &d.drives {
        let number = |x: Option<Number>| x.map_or_else(String::new, |x| format!("{:.6}", x.0));
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} |",
            plain(&drive.name),
            plain(drive.outcome.as_str()),
            drive.price.map_or_else(String::new, |x| format!("{}", x.0)),
            number(drive.objective),
            plain(drive.reason.as_deref().unwrap_or_default())
        );
    }
    out.push('\n');
}

/// What other freedoms came to.
fn freedoms(out: &mut String, list: &[FreedomRecord]) {
    if list.is_empty() {
        return;
    }
    let _ = writeln!(out, "Which freedom more would resolve it was tried:\n");
    for f in list {
        let file = opened_file(f.freedom);
        let link = f.output.as_ref().map_or_else(String::new, |_| format!(" ([{file}]({file}))"));
        let _ = writeln!(out, "- {}{link}", plain(&f.message));
    }
    out.push('\n');
}

fn offsets(out: &mut String, r: &Results, found: &FoundOffsets) {
    let n = found.report.counts();
    let _ = writeln!(out, "## Offsets of the platform without shared joints\n");
    if let Some(s) = found.report.solution() {
        let _ = writeln!(out, "Optimised design: [{0}]({0}).\n", folder::OPTIMISED);
        solution(out, r, found, s);
        map(out, &s.map, &r.design.units);
    } else {
        let _ = writeln!(out, "No offsets were found.\n");
    }
    let _ = writeln!(
        out,
        "Branches (each joint before, inside or beyond its edge): {} feasible, {} outside the bounds, {} without room, \
         {} with |det A| too small, {} unproved, {} failed. Details: [{6}]({6}).\n\n\
         ![det A over the two offsets]({7})\n",
        n.feasible,
        n.outside_bounds,
        n.spacing,
        n.det,
        n.unproved,
        n.failed,
        folder::OPTIMIZE,
        folder::DETERMINANT
    );
}

fn solution(out: &mut String, r: &Results, found: &FoundOffsets, s: &OffsetSolution) {
    let (units, p) = (plain(&r.design.units), &found.problem);
    let (order, edges, bodies) = (r.octahedral.order(), p.edge_lengths(), p.sliding_bodies());
    let _ = writeln!(
        out,
        "| leg | joint moves on | edge [{units}] | t | offset [{units}] | zone |\n|---|---|---|---|---|---|"
    );
    for i in 0..6 {
        let _ = writeln!(
            out,
            "| {} | {} | {:.6} | {:.6} | {:.6} | {} |",
            order[i].get() + 1,
            bodies[i],
            edges[i],
            s.offsets[i],
            s.shifts[i],
            s.branch.0[i].words()
        );
    }
    let (c, m) = (&s.recheck, &s.recheck.margins);
    let [distance, det] = offset_reserves(&r.search.found.asked, &p.octahedral);
    let _ = writeln!(
        out,
        "\nWorst inverse condition number {:.9} (pose {} of {}); {}.\n\n| quantity | value | margin |\n|---|---|---|\n\
         | det A | {:.9} | {:.3e} |\n| spacing on the base | | {:.3e} {units} |\n\
         | spacing on the platform | | {:.3e} {units} |\n| bounds of the offsets | | {:.3e} |\n",
        c.objective,
        c.worst_pose + 1,
        c.per_pose.len(),
        if s.evidence.converged {
            "the local search has settled"
        } else {
            "the local search has NOT settled"
        },
        c.det,
        m.det + det,
        m.base_spacing + distance,
        m.platform_spacing + distance,
        m.bounds
    );
}

fn map(out: &mut String, map: &AffineLegMap, units: &str) {
    let _ = writeln!(
        out,
        "Leg map s' = A s + c on squared leg lengths:\n\n| leg | A 1 | A 2 | A 3 | A 4 | A 5 | A 6 | c [{}^2] |\n\
         |---|---|---|---|---|---|---|---|",
        plain(units)
    );
    for i in 0..6 {
        let row: Vec<String> = (0..6).map(|j| format!("{:.9}", map.a[(i, j)] + 0.0)).collect();
        let _ = writeln!(out, "| {} | {} | {:.9} |", i + 1, row.join(" | "), map.c[i] + 0.0);
    }
    out.push('\n');
}

fn verification(out: &mut String, v: &Verified) {
    let (map, samples) = (&v.found.map, &v.found.samples);
    let _ = writeln!(
        out,
        "## Verdict: {}\n\nEvidence: {}.\n\nThe map was derived from the leg vectors alone: residual {:.3e} (tolerance {:.0e}), \
         smallest singular value of A {:.3e} of the largest (limit {:.1e}). Sampling supports the claim, the map proves \
         it up to the rounding of the coordinates.\n",
        v.found.verdict.as_str().replace('_', " "),
        plain(&v.explanation),
        map.residual,
        map.tolerances.residual,
        map.inverse_condition,
        map.singular_limit
    );
    if samples.is_empty() {
        return;
    }
    let _ = writeln!(
        out,
        "| sample | poses, design | poses, optimised | matched | certified | proved complete | worst pose distance |\n\
         |---|---|---|---|---|---|---|"
    );
    for (k, s) in samples.iter().enumerate() {
        let (a, b) = (&s.solutions_a, &s.solutions_b);
        let _ = writeln!(
            out,
            "| {} | {} | {} | {} | {} + {} | {} + {} | {:.1e} |",
            k + 1,
            a.roots.len(),
            b.roots.len(),
            s.matching.pairs.len(),
            certified(a),
            certified(b),
            proved(a),
            proved(b),
            s.matching.worst_distance()
        );
    }
    let _ = writeln!(
        out,
        "\nWorst pose distance over all samples: {:.3e} (relative to the size; poses farther apart than {SAME_POSE:.0e} \
         are different). {} random poses about the home pose. Details: [{2}]({2}).\n",
        v.found.worst_distance(),
        v.plan.count,
        folder::VERIFY
    );
}

fn certified(s: &FkSolutions) -> usize {
    s.roots.iter().filter(|r| r.certified()).count()
}

fn proved(s: &FkSolutions) -> &'static str {
    match s.completeness {
        Completeness::Proved { .. } => "yes",
        Completeness::Modular { .. } => "modulo random primes",
        Completeness::Unproved { .. } if s.all_accounted() => "no (all paths accounted for)",
        Completeness::Unproved { .. } => "NO, poses may be missing",
    }
}

fn poses(out: &mut String, r: &Results) {
    let s = &r.poses.solutions;
    let lengths: Vec<String> = r.poses.lengths.get().iter().map(ToString::to_string).collect();
    let whose = match r.poses.from {
        LengthsOrigin::Design => "its own leg lengths",
        LengthsOrigin::Home => "the leg lengths of its home pose (the design gives none)",
    };
    let complete = match &s.completeness {
        Completeness::Proved { .. } => "proved",
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
        certified(s),
        s.method,
        plain(&reason),
        folder::FK,
        folder::FK,
        folder::MODES
    );
}

fn reproduction(out: &mut String, r: &Results) {
    let (t, samples) = (r.options.tolerances, r.verified.as_ref().map_or(0, |v| v.plan.count));
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
