//! The table of equivalent rearrangements: every design it names by the leg map, by poses, and against the
//! documentation.

use std::path::Path;

use equipod::methods::equivalence::{InconclusiveReason, Verdict, verify};
use equipod::methods::fk::FkOptions;
use equipod::methods::geom::{Pose, SamplePlan, random_rotation};
use equipod::methods::manipulator::{Manipulator, default_home};
use equipod::methods::num::Rng;
use equipod::methods::synthesis::rearrangement::{
    Argument, Arrangement, NoOctahedralEquivalent, PlanarBodies, Rearrangement, Reduction, rearrangement,
    rearrangements,
};
use equipod::methods::synthesis::{Family, LegMapTolerances, leg_map};
use equipod::methods::topology::{Topology, catalogue};
use nalgebra::{Vector3, Vector6};

fn name(r: &Rearrangement) -> String {
    format!("{} {:?}", r.topology.id(), r.planar.names())
}

fn octahedral(r: &Rearrangement) -> Option<&Arrangement> {
    match &r.octahedral {
        Reduction::Octahedral(design) => Some(design),
        Reduction::Not(_) => None,
    }
}

/// `s' = A s + c` at random poses, `det A` not zero: nothing here knows how the design was found.
fn assert_equivalent(from: &Manipulator, to: &Manipulator, rng: &mut Rng, what: &str) {
    let outcome = leg_map(from, to, LegMapTolerances::default()).unwrap();
    assert!(outcome.is_regular_within_rounding(), "{what}: {outcome:?}");
    let map = outcome.map().unwrap();
    assert!(map.determinant().abs() > 1e-12, "{what}");
    for _ in 0..3 {
        let position = Vector3::from_fn(|_, _| 10.0 * rng.normal());
        let pose = Pose { rotation: random_rotation(rng), position };
        let [s, expected] = [from, to].map(|m| Vector6::from(pose.squared_lengths(m).unwrap().get()));
        let error = (map.a * s + map.c - expected).amax() / expected.amax();
        assert!(error < 1e-7, "{what}: {error}");
    }
}

#[test]
fn every_design_of_the_table_is_equivalent_by_the_leg_map() {
    let mut rng = Rng::new(0x34);
    let all = rearrangements().unwrap();
    assert_eq!(all.len(), 101);
    for r in &all {
        let member = r.member.manipulator().unwrap();
        assert_eq!(Topology::of_manipulator(&member), r.topology.topology(), "{}", name(r));
        let flat = |joints: &[nalgebra::Point3<f64>]| joints.iter().all(|p| p.z.abs() <= 0.0);
        assert_eq!(flat(member.base_joints()), r.planar.base, "{}", name(r));
        assert_eq!(flat(member.platform_joints()), r.planar.platform, "{}", name(r));
        let fewest = r.fewest.manipulator().unwrap();
        assert_equivalent(&member, &fewest, &mut rng, &name(r));
        assert_eq!(Topology::of_manipulator(&fewest).shared_joints(), r.fewest_shared, "{}", name(r));
        let joints = fewest.base_joints().len() + fewest.platform_joints().len();
        assert_eq!((12 - joints, r.fewest.merged_ends()), (r.fewest_merged, r.fewest_merged), "{}", name(r));
        if let Some(design) = octahedral(r) {
            let design = design.manipulator().unwrap();
            assert_equivalent(&member, &design, &mut rng, &name(r));
            assert_eq!(Topology::of_manipulator(&design), catalogue()[33].topology());
        }
    }
}

#[test]
fn poses_of_some_of_the_designs_agree() {
    let cases = [(34, true, true), (21, false, false), (12, false, true), (24, true, true), (33, true, true)];
    for (number, base, platform) in cases {
        let r = rearrangement(catalogue()[number - 1], PlanarBodies { base, platform }).unwrap();
        let (member, fewest) = (r.member.manipulator().unwrap(), r.fewest.manipulator().unwrap());
        let (translation, rotation) = (Vector3::repeat(member.size()), Vector3::repeat(0.5));
        let plan = SamplePlan { home: default_home(&member), translation, rotation, count: 1, seed: 9 };
        let verdict = verify(&member, &fewest, &plan, &FkOptions::default()).unwrap().verdict;
        let agrees = matches!(
            verdict,
            Verdict::Equivalent | Verdict::Inconclusive(InconclusiveReason::WithinRounding)
        );
        assert!(agrees, "{}: {verdict:?}", name(&r));
    }
}

#[test]
fn exchange_of_the_bodies_changes_nothing() {
    let mut self_dual = 0;
    for t in catalogue().into_iter().filter(|t| t.topology().exchanged() == t.topology()) {
        let fewest = |base: bool, platform: bool| {
            rearrangement(t, PlanarBodies { base, platform }).map(|r| (r.fewest_shared, r.fewest_merged))
        };
        if t.topology().base_joints() > 3 {
            assert_eq!(fewest(true, false).unwrap(), fewest(false, true).unwrap(), "{}", t.id());
            self_dual += 1;
        }
    }
    assert!(self_dual > 3, "{self_dual}");
}

#[test]
fn the_octahedral_lines_agree_with_the_octahedral_class() {
    let family = Family::octahedral();
    let known =
        |t: Topology| family.topologies().iter().any(|f| f.topology.up_to_exchange() == t.up_to_exchange());
    let all = rearrangements().unwrap();
    let reducible: Vec<&Rearrangement> = all.iter().filter(|r| octahedral(r).is_some()).collect();
    let ids: Vec<String> = reducible.iter().map(|r| r.topology.id()).collect();
    assert_eq!(ids, ["T08", "T16", "T24", "T31", "T34"]);
    for r in reducible {
        assert!(known(r.topology.topology()), "{}", name(r));
        assert_eq!((r.planar.base, r.planar.platform, r.fewest_shared), (true, true, 0), "{}", name(r));
    }
    // a topology with three legs at a joint is not in the class: every line of legs of it has two independent ones
    for r in all.iter().filter(|r| !known(r.topology.topology())) {
        assert!(octahedral(r).is_none(), "{}", name(r));
    }
}

#[test]
fn all_three_topologies_with_three_joints_a_body_can_be_freed() {
    let all = rearrangements().unwrap();
    let three: Vec<&Rearrangement> =
        all.iter().filter(|r| r.topology.topology().base_joints() == 3).collect();
    assert_eq!(three.iter().map(|r| r.topology.name()).collect::<Vec<_>>(), ["3-3a", "3-3b", "3-3c"]);
    assert!(three.iter().all(|r| r.fewest_shared == 0));
    let surface = Reduction::Not(NoOctahedralEquivalent::Surface);
    assert!(
        three[0].octahedral == surface && three[1].octahedral == surface && octahedral(three[2]).is_some()
    );
}

fn document(name: &str) -> String {
    std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(name)).unwrap()
}

/// Compares the lines of a table that begin with a topology with those computed.
fn assert_table(name: &str, begin: &str, expected: &[String]) {
    let text = document(name);
    let lines: Vec<&str> = text.lines().filter(|l| l.starts_with(begin)).collect();
    let first = lines.iter().zip(expected).find(|(l, e)| l != e);
    assert!(lines == expected, "{name} should have:\n{}\nfirst difference: {first:?}", expected.join("\n"));
}

fn reason(r: &Rearrangement) -> String {
    match &r.octahedral {
        Reduction::Octahedral(_) => "yes".to_string(),
        Reduction::Not(why) => why.name().replace('_', " "),
    }
}

/// `0`, `1`, `1 (2)`: shared joints, and merged ends where they are not the same.
fn sharing(r: &Rearrangement) -> String {
    let merged =
        if r.fewest_merged == r.fewest_shared { String::new() } else { format!(" ({})", r.fewest_merged) };
    format!("{}{merged}", r.fewest_shared)
}

fn argument(r: &Rearrangement) -> &'static str {
    match r.argument {
        Argument::Stars(_) => "stars",
        Argument::Supports => "supports",
        Argument::Curves => "curves",
    }
}

#[test]
fn the_tables_of_the_documentation_are_those_computed() {
    let all = rearrangements().unwrap();
    let mut expected = Vec::new();
    for t in catalogue() {
        let at = |base: bool, platform: bool| {
            let r = all.iter().find(|r| r.topology == t && r.planar == PlanarBodies { base, platform });
            r.map_or("-".to_string(), sharing)
        };
        // The result at the head of the page has the case of two planes.
        let star_of_three = ["T03", "T09", "T19", "T26"].contains(&t.id().as_str());
        assert_eq!(at(true, true), if star_of_three { "1 (2)" } else { "0" }, "{}", t.id());
        let reduced = all.iter().any(|r| r.topology == t && octahedral(r).is_some());
        assert_eq!(reduced, ["T08", "T16", "T24", "T31", "T34"].contains(&t.id().as_str()), "{}", t.id());
        let columns = [at(false, false), at(true, false), at(false, true)].join(" | ");
        expected.push(format!("| {} | {} | {columns} |", t.id(), t.name()));
    }
    assert_table("theory/rearrangements.md", "| T", &expected);
    let cases: Vec<String> = all
        .iter()
        .map(|r| {
            let [base, platform] = r.planar.names();
            // a list has commas
            let families = Some(r.family_names()).filter(|names| names.contains(','));
            let families = families.map_or_else(|| r.family_names(), |names| format!("\"{names}\""));
            let (id, argument, sharing, reason) = (r.topology.id(), argument(r), sharing(r), reason(r));
            format!("{id},{base},{platform},{families},{argument},{sharing},{reason}")
        })
        .collect();
    assert_table("evidence/rearrangements.csv", "T", &cases);
}
