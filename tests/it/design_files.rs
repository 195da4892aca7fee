//! Shipped designs, written designs that are read back, and inputs that are not designs.

use equipod::methods::design::{Code, Design, Format, OptimizeTable, Workspace, parse};
use equipod::methods::geom::Pose;
use equipod::methods::manipulator::{LegLengths, Manipulator};
use equipod::methods::requirements::{
    ConeLimits, CoordinateRange, Hardware, JointAxes, LegBody, ListedFrom, Region,
};
use nalgebra::{Point3, Rotation3, Vector3};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn shipped() -> Vec<(String, String)> {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/designs");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .unwrap()
        .map(|e| e.unwrap().path())
        .filter(|p| p.extension().is_some_and(|e| e == "toml"))
        .map(|p| (p.file_name().unwrap().to_string_lossy().into_owned(), std::fs::read_to_string(p).unwrap()))
        .collect();
    files.sort();
    files
}

#[test]
fn every_shipped_design_loads_without_warning_and_names_its_source() {
    let files = shipped();
    assert!(files.len() >= 7);
    let table = include_str!("../../designs/README.md");
    for (file, text) in files {
        let (design, warnings) = parse(&text, Format::Toml).unwrap_or_else(|v| panic!("{file}: {v:?}"));
        assert_eq!(warnings, [], "{file}");
        assert!(design.source.is_some() && design.lengths.is_some(), "{file}");
        assert!(table.contains(&format!("`{file}`")), "{file} is missing in designs/README.md");
        reads_back(&design);
    }
}

#[test]
fn home_poses_of_the_collection_have_the_lengths_they_claim() {
    for (file, text) in shipped() {
        let (design, _) = parse(&text, Format::Toml).unwrap();
        let Some(lengths) = design.home.and_then(|home| home.lengths(design.manipulator())) else { continue };
        if file == "rbt-octahedral.toml" {
            // home is a regular antiprism of legs, not the pose of the printed lengths
            assert!(lengths.get().iter().all(|l| (l - 261_f64.sqrt()).abs() < 1e-12));
        } else {
            let given = design.lengths.unwrap().get();
            assert!(
                lengths.get().iter().zip(given).all(|(l, g)| (l - g).abs() < 6e-3),
                "{file}: three digits"
            );
        }
    }
}

/// Both notations give the same design to the last bit (`Debug` tells -0 from 0, equality does not).
fn reads_back(design: &Design) {
    for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
        let (again, _) = parse(&text, format).unwrap_or_else(|v| panic!("{v:?}\n{text}"));
        assert_eq!(format!("{again:?}"), format!("{design:?}"), "{text}");
    }
}

/// Numbers of very different magnitude with all their bits in use.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        Just(0.0),
        Just(-0.0),
        -10.0..10.0_f64,
        (-1.0..1.0_f64, -25..25).prop_map(|(m, e)| m * 10_f64.powi(e)),
        (-1000..1000_i32).prop_map(f64::from),
    ]
}

fn point() -> impl Strategy<Value = Point3<f64>> {
    [coordinate(), coordinate(), coordinate()].prop_map(Point3::from)
}

fn pose() -> impl Strategy<Value = Pose> {
    (point(), [-3.0..3.0_f64, -3.0..3.0, -3.0..3.0])
        .prop_map(|(p, w)| Pose { rotation: Rotation3::new(Vector3::from(w)), position: p.coords })
}

fn text() -> impl Strategy<Value = String> {
    "[A-Za-z0-9_.\"'\\\\ \u{e9}\u{4e2d}\t\n\u{7f}\u{1}-]{0,8}[a-z#=]"
}

fn positive() -> impl Strategy<Value = Option<f64>> {
    proptest::option::of(1e-6..1e6_f64)
}

prop_compose! {
    fn extras()(
        home in pose(),
        poses in proptest::collection::vec(pose(), 0..3),
        widths in [0.0..5.0_f64, 0.0..5.0, 0.0..5.0, 0.0..180.0, 0.0..180.0, 0.0..180.0],
        grid in 1..6_usize,
        lengths in proptest::option::of([0.0..1e9_f64, 0.0..1.0, 0.0..1.0, 0.0..1.0, 0.0..1.0, 1e-9..1e-3]),
        numbers in [positive(), positive(), positive(), positive(), positive()],
        texts in (text(), text(), proptest::option::of(text())),
    ) -> (Pose, Workspace, Option<LegLengths>, [Option<f64>; 5], (String, String, Option<String>)) {
        // an ellipsoid of intervals to one side might leave out home
        let share = if grid > 3 { 1.0 } else { 0.25 };
        let travels = widths.map(|w| CoordinateRange { min: -share * w, max: w });
        let [x, y, z, roll, pitch, yaw] = travels;
        let workspace = Workspace {
            translation: [x, y, z],
            rotation_deg: [roll, pitch, yaw],
            ranges: if grid > 1 { [CoordinateRange::default(), y, z, CoordinateRange::default(), pitch, yaw] } else { [CoordinateRange::default(); 6] },
            pivot: (grid > 2).then(|| Vector3::new(widths[0], -1.0, 0.5)),
            grid,
            listed_from: if grid > 2 && !poses.is_empty() { ListedFrom::Home } else { ListedFrom::Base },
            poses,
            region: if grid > 3 { Region::Ellipsoid } else { Region::Box },
            ..Workspace::default()
        };
        (home, workspace, lengths.map(|l| LegLengths::try_new(l).unwrap()), numbers, texts)
    }
}

prop_compose! {
    fn design()(
        base in proptest::collection::btree_map(text(), point(), 6),
        platform in proptest::collection::btree_map(text(), point(), 6),
        (home, workspace, lengths, numbers, texts) in extras(),
        shared in 0..6_usize,
    ) -> Option<Design> {
        let split = |m: std::collections::BTreeMap<String, Point3<f64>>| -> (Vec<_>, Vec<_>) { m.into_iter().unzip() };
        let ((base_names, base), (platform_names, platform)) = (split(base), split(platform));
        let legs = std::array::from_fn(|i| (i, if i == 5 { shared } else { i }));
        let m = Manipulator::try_new(base, platform, legs).ok()?;
        let mut design = Design::new(texts.0, texts.1, m).with_joint_names(base_names, platform_names).unwrap();
        design.source = texts.2;
        design.home = Some(home);
        design.workspace = workspace;
        design.lengths = lengths;
        design.optimize = OptimizeTable {
            min_joint_distance: numbers[0], min_abs_det: numbers[1], characteristic_length: numbers[2],
        };
        design.hardware = Hardware {
            joint_diameter: numbers[3],
            leg_body: numbers[4].map(|diameter| LegBody { diameter, rod: numbers[0].zip(numbers[1]) }),
            base_cone_angle: numbers[2].map(|x| ConeLimits::of_all(x.min(180.0), JointAxes::Home)),
            max_leg_force: numbers[1],
            ..Hardware::default()
        };
        Some(design)
    }
}

proptest! {
    // PROPTEST_CASES and PROPTEST_RNG_SEED take other numbers
    #![proptest_config(ProptestConfig {
        cases: 200,
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    #[test]
    fn what_is_written_reads_back_to_the_same_bits(design in design()) {
        if let Some(design) = design {
            reads_back(&design);
        }
    }

    #[test]
    fn random_text_is_refused_and_never_panics(text in "\\PC{0,200}", json in any::<bool>()) {
        let format = if json { Format::Json } else { Format::Toml };
        prop_assert!(parse(&text, format).is_err());
    }

    #[test]
    fn random_bytes_are_refused_and_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        let text = String::from_utf8_lossy(&bytes);
        prop_assert!(parse(&text, Format::Toml).is_err());
        prop_assert!(parse(&text, Format::Json).is_err());
    }

    #[test]
    fn mutated_designs_are_read_or_refused_with_a_place(
        pick in any::<prop::sample::Index>(),
        cuts in proptest::collection::vec((any::<prop::sample::Index>(), 0..12_usize, "[\\[\\]{}\"=,.#0-9aeinf -]{0,4}"), 1..5),
        json in any::<bool>(),
    ) {
        let files = shipped();
        let (_, toml) = pick.get(&files);
        let (design, _) = parse(toml, Format::Toml).unwrap();
        let (mut text, format) = if json { (design.to_json(), Format::Json) } else { (toml.clone(), Format::Toml) };
        for (at, length, insert) in cuts {
            let start = at.index(text.len() + 1);
            let end = (start + length).min(text.len());
            if text.is_char_boundary(start) && text.is_char_boundary(end) {
                text.replace_range(start..end, &insert);
            }
        }
        match parse(&text, format) {
            Ok((design, _)) => reads_back(&design),
            Err(violations) => {
                prop_assert!(!violations.is_empty());
                let lines = text.lines().count().max(1) + 1;
                prop_assert!(violations.iter().all(|v| v.line >= 1 && v.line <= lines && v.column >= 1));
                prop_assert!(violations.iter().all(|v| v.code != Code::TooMany && !v.help.is_empty()));
            }
        }
    }
}
