//! Rows compared with the figures of the rest of the library for the same designs.

use std::sync::Arc;

use nalgebra::Point3;

use super::plan::{BasePlan, PlanText, read};
use super::{Sweep, SweepCell, SweepRow};
use ask::design::parse;
use files::design::Format;
use machine::manufacture::{ErrorBound, PoseSearch, joint_allowance};
use num::Cancel;
use platform::manipulator::{inverse_condition, jacobian};

const OCTAHEDRAL: &str = include_str!("../../../designs/rbt-octahedral.toml");

fn sweep_of(design: &str, plan: &str) -> Sweep {
    let base = BasePlan::new(PlanText::new(design, Format::Toml)).unwrap();
    let plan = format!("name = 'p'\ndesign = 'd.toml'\n{plan}");
    let plan = read(PlanText::new(&plan, Format::Toml), &base).unwrap_or_else(|v| panic!("{v:#?}"));
    Sweep::new(plan, base, 1).unwrap()
}

fn cell<'a>(sweep: &Sweep, row: &'a [SweepCell], name: &str) -> &'a SweepCell {
    &row[sweep.columns.iter().position(|c| c.name == name).unwrap_or_else(|| panic!("{name}"))]
}

#[test]
fn figures_are_those_of_the_design_that_the_candidate_is() {
    let sweep = sweep_of(
        OCTAHEDRAL,
        "compute = ['det_a', 'conditioning', 'home_conditioning', 'spacing', 'clearance', 'length_range', 'lengths', 'joints']\n[vary]\nby = 'latin_hypercube'\ncount = 5\nvalues = { offsets = { from = 0.1, to = 0.9 } }\n",
    );
    for k in 0..5 {
        let row = sweep.row(k).unwrap();
        assert_eq!((row.len(), &row[row.len() - 1]), (sweep.columns.len(), &SweepCell::Empty));
        let number = |name: &str| cell(&sweep, &row, name).as_number().unwrap();
        let (design, _) = parse(&sweep.design_text(k).unwrap(), Format::Toml).unwrap();
        let m = design.manipulator();
        let home = design.home_or_default();
        let poses = design.workspace_or_default().sample(&home);
        assert_eq!(poses.len(), 65);
        let length = design.characteristic_length();
        let worst =
            poses.iter().map(|p| inverse_condition(&jacobian(m, p, length))).fold(f64::INFINITY, f64::min);
        assert!((number("conditioning") - worst).abs() < 1e-12);
        let pose = &poses[number("conditioning_pose") as usize];
        assert!((inverse_condition(&jacobian(m, pose, length)) - worst).abs() < 1e-12);
        let offsets: [f64; 6] = std::array::from_fn(|i| number(&format!("offsets_{}", i + 1)));
        assert!((number("det_a") - synthesis::offset_determinant(&offsets)).abs() < 1e-12);
        assert!(
            number("base_spacing") > 0.0 && number("platform_spacing") > 0.0 && number("clearance") >= 0.0
        );
        let at_home = home.lengths(m).unwrap().get();
        assert!(number("least_length") <= at_home[0] && at_home[0] <= number("greatest_length"));
        assert!((number("base_1_x") - m.legs()[0].base.x).abs() < 1e-12);
        // the leg map also moves the lengths of the design
        let moved = design.lengths.unwrap().get();
        assert!((0..6).all(|i| (number(&format!("length_{}", i + 1)) - moved[i]).abs() < 1e-9));
    }
}

#[test]
#[ignore = "evidence"]
fn a_candidate_with_a_drive_is_assessed_by_its_limits() {
    let table = b"name,stroke,dead_length,force,price_EUR\nshort,1,12,1e6,50\nlong,30,1,1e6,90\n";
    let base = BasePlan::new(PlanText::new(OCTAHEDRAL, Format::Toml)).unwrap();
    let base = base.with_drives(table).unwrap();
    let text = "name = 'p'\ndesign = 'd.toml'\ndrives = 't.csv'\ncompute = ['drive', 'margins']\n[vary]\nby = 'grid'\nvalues = { drive = ['long', 'short'] }\n";
    let plan = read(PlanText::new(text, Format::Toml), &base).unwrap_or_else(|v| panic!("{v:#?}"));
    let drives: Vec<_> = ["long", "short"].map(|name| base.drive(name).unwrap().clone()).into();
    let sweep = Sweep::new(plan, base, 1).unwrap();
    let (original, _) = parse(OCTAHEDRAL, Format::Toml).unwrap();
    for (k, drive) in drives.iter().enumerate() {
        let row = sweep.row(k as u64).unwrap();
        assert_eq!(row[row.len() - 1], SweepCell::Empty);
        assert_eq!(cell(&sweep, &row, "drive_price").as_number(), drive.price);
        // the same result as for the design with these limits
        let alone = original.with_drive(drive);
        let options =
            machine::requirements::AssessOptions::new().points(200).searches(1).seed(1).close(false);
        let found = alone.assess_with(&options, 300).unwrap();
        let too_long = machine::requirements::TermKind::MaxLegLength;
        let bound = found.proof.bounds.iter().find(|b| b.found.term.kind == too_long).unwrap();
        let said = cell(&sweep, &row, &format!("margin_{}", too_long.code())).as_number().unwrap();
        assert!((said - bound.found.value).abs() <= 1e-12 * said.abs(), "{said} {}", bound.found.value);
        let (written, _) = parse(&sweep.design_text(k as u64).unwrap(), Format::Toml).unwrap();
        assert_eq!(written.hardware.leg_length, Some(drive.lengths));
    }
    let margin = |k| cell(&sweep, &sweep.row(k).unwrap(), "margin_max_leg_length").as_number().unwrap();
    assert!(margin(0) > 0.0 && margin(1) < 0.0, "{} {}", margin(0), margin(1));
}

#[test]
fn the_poses_of_a_table_belong_to_the_workspace_of_every_candidate() {
    let table = "x,y,z,roll_deg,pitch_deg,yaw_deg\n0,0,1,0,0,0\n1,-1,0.5,10,0,5\n";
    let region = "translation = [2.0, 2.0, 2.0]\nrotation_deg = [10.0, 10.0, 10.0]\ngrid = 2\n";
    assert!(OCTAHEDRAL.contains(region));
    let text = OCTAHEDRAL.replace(region, "trajectory = \"data/path.csv\"\nrelative_to = \"home\"\n");
    let base = BasePlan::new(PlanText::new(&text, Format::Toml)).unwrap();
    assert!(base.clone().with_poses(b"1,2\n").is_err(), "no pose has two numbers");
    let base = base.with_poses(table.as_bytes()).unwrap();
    let sweep = |vary: &str| {
        let plan =
            format!("name = 'p'\ndesign = 'd.toml'\ncompute = ['conditioning', 'length_range']\n{vary}");
        let plan = read(PlanText::new(&plan, Format::Toml), &base).unwrap_or_else(|v| panic!("{v:#?}"));
        Sweep::new(plan, base.clone(), 1).unwrap()
    };
    // numbers in the text, offsets of an equivalent platform
    for vary in [
        "[vary]\nby = 'grid'\nvalues = { 'home.position.3' = [14, 17] }\n",
        "[vary]\nby = 'uniform'\ncount = 2\nvalues = { offsets = { from = 0.2, to = 0.4 } }\n",
    ] {
        let sweep = sweep(vary);
        for k in 0..2 {
            let row = sweep.row(k).unwrap();
            assert_eq!(row[row.len() - 1], SweepCell::Empty);
            let written = sweep.design_text(k).unwrap();
            // the file of a candidate has the table beside it
            assert!(written.contains("\"path.csv\""), "{written}");
            let (design, _) = parse(&written, Format::Toml).unwrap();
            let home = design.home_or_default();
            let moved = |x: [f64; 3], angles: [f64; 3]| {
                let listed = platform::geom::Pose::new(x, platform::geom::Angles::from_degrees(angles));
                platform::geom::ListedFrom::Home.in_base_frame(&listed, &home)
            };
            let poses = [home, moved([0.0, 0.0, 1.0], [0.0; 3]), moved([1.0, -1.0, 0.5], [10.0, 0.0, 5.0])];
            let lengths: Vec<f64> =
                poses.iter().flat_map(|p| p.lengths(design.manipulator()).unwrap().get()).collect();
            let longest = lengths.iter().copied().fold(0.0, f64::max);
            let said = cell(&sweep, &row, "greatest_length").as_number().unwrap();
            assert!((said - longest).abs() < 1e-9 * longest, "{said} {longest}");
            let length = design.characteristic_length();
            let least = poses
                .iter()
                .map(|p| inverse_condition(&jacobian(design.manipulator(), p, length)))
                .fold(f64::INFINITY, f64::min);
            assert!((cell(&sweep, &row, "conditioning").as_number().unwrap() - least).abs() < 1e-9);
        }
    }
}

#[test]
fn rows_do_not_depend_on_threads_nor_on_the_range() {
    let sweep = Arc::new(sweep_of(
        OCTAHEDRAL,
        "compute = ['det_a', 'conditioning']\nkeep = ['det_a > 0']\n[vary]\nby = 'sobol'\ncount = 200\nvalues = { offsets = { from = 0.1, to = 0.9 } }\n",
    ));
    // numbers of candidates, and the rows kept
    let all = |range, threads| {
        let mut candidates = 0;
        let mut rows: Vec<SweepRow> = Vec::new();
        for mut chunk in sweep.rows(range, threads, &Cancel::new()) {
            candidates += chunk.candidates;
            rows.extend(chunk.rows().map(|row| row.to_vec()));
        }
        (candidates, rows)
    };
    let (candidates, one) = all(0..200, 1);
    assert_eq!(candidates, 200);
    assert!(one.len() > 50 && one.len() < 200, "some are kept");
    assert_eq!(one, (0..200).filter_map(|k| sweep.row(k)).collect::<Vec<_>>());
    assert_eq!(all(0..200, 3).1, one);
    assert_eq!([all(0..77, 2).1, all(77..200, 1).1].concat(), one);
    assert_eq!(all(0..0, 2).0, 0);
}

#[test]
fn numbers_of_the_text_change_and_failures_are_rows() {
    let sweep = sweep_of(
        OCTAHEDRAL,
        "compute = ['home_conditioning', 'spacing']\nkeep = ['home_conditioning > 2']\n[vary]\nby = 'grid'\nvalues = { 'base.P2.y' = [11.0, 0.0], 'base.P1.x' = ['-1/3', 'sqrt(0-1)'] }\n",
    );
    // a valid candidate that is not kept
    assert!(sweep.row(0).is_none());
    let failed = sweep.row(1).unwrap();
    assert!(cell(&sweep, &failed, "error").to_string().contains("negative"), "{failed:?}");
    assert_eq!(cell(&sweep, &failed, "base_P1_x"), &SweepCell::Text("sqrt(0-1)".into()));
    assert_eq!(cell(&sweep, &failed, "base_spacing"), &SweepCell::Empty);
    let collinear = sweep.row(2).unwrap();
    assert!(matches!(cell(&sweep, &collinear, "error"), SweepCell::Text(_)));
    let text = sweep.design_text(0).unwrap();
    assert!(text.contains("\"-1/3\"") && text.contains("# of P4"), "comments stay: {text}");
}

#[test]
fn poses_are_counted_with_their_evidence_and_fields_of_answers_are_columns() {
    let sweep = sweep_of(
        OCTAHEDRAL,
        "compute = ['poses', 'check', { column = 'median', field = 'check.jacobian_inverse_condition.median' }, { column = 'method', field = 'fk.method', as = 'text' }, { column = 'first', field = 'fk.solutions.1.certified', as = 'truth' }]\n[vary]\nby = 'list'\nvalues = { 'lengths.1' = [19.8, 18.1] }\n",
    );
    let row = sweep.row(1).unwrap();
    let of = |name: &str| cell(&sweep, &row, name).clone();
    assert_eq!((of("finite_poses"), of("certified_poses")), (SweepCell::Integer(16), SweepCell::Integer(16)));
    assert_eq!(
        (of("completeness"), of("method")),
        (SweepCell::Text("proved".into()), SweepCell::Text("octic".into()))
    );
    assert_eq!(
        (of("singular"), of("generic_poses"), of("first")),
        (SweepCell::Truth(false), SweepCell::Integer(16), SweepCell::Truth(true))
    );
    assert!(of("median").as_number().unwrap() > 0.0);
    assert_eq!(of("error"), SweepCell::Empty);
}

#[test]
fn margins_have_a_column_for_each_kind_of_requirement() {
    let design = include_str!("../../../designs/worked/bench-octahedral.toml");
    let sweep = sweep_of(
        design,
        "compute = ['margins']\nassess = { points = 5, searches = 0, cells = 20 }\n[vary]\nby = 'uniform'\ncount = 2\nvalues = { offsets = { from = 0.2, to = 0.3 } }\n",
    );
    let row = sweep.row(0).unwrap();
    assert!(sweep.columns.iter().filter(|c| c.name.starts_with("margin_")).count() > 2);
    for column in sweep.columns.iter().filter(|c| c.name.starts_with("margin_")) {
        assert!(
            cell(&sweep, &row, &column.name).as_number().is_some() && column.unit.is_some(),
            "{column:?}"
        );
    }
}

/// `det J` of an equivalent platform is `det J` of the original times `det A`. The same poses are singular, and all
/// candidates share one number between the two bounds.
#[test]
#[ignore = "evidence"]
fn equivalent_platforms_have_one_region_without_singular_poses_and_tolerances_of_their_own() {
    let sweep = sweep_of(
        OCTAHEDRAL,
        "compute = ['regular_box', 'tolerance']\naccuracy = [0.1, 0.5]\n[vary]\nby = 'sobol'\ncount = 3\nvalues = { offsets = { from = 0.1, to = 0.9 } }\n",
    );
    let rows: Vec<_> = (0..3).map(|k| sweep.row(k).unwrap()).collect();
    let all =
        |name: &str| rows.iter().map(|r| cell(&sweep, r, name).as_number().unwrap()).collect::<Vec<_>>();
    let (proved, limit) = (all("regular_box"), all("regular_box_limit"));
    assert!(proved.iter().all(|p| *p > 0.0));
    let most = proved.iter().copied().fold(0.0, f64::max);
    assert!(limit.iter().all(|l| *l >= most), "{proved:?} {limit:?}");
    for (k, tolerance) in all("tolerance").into_iter().enumerate() {
        let (design, _) = parse(&sweep.design_text(k as u64).unwrap(), Format::Toml).unwrap();
        let space = design.workspace_or_default().space(&design.home_or_default());
        let bound = ErrorBound { position: 0.1, rotation_deg: 0.5 };
        let search = PoseSearch { points: 300, seed: 1, ..PoseSearch::default() };
        let own = joint_allowance(design.manipulator(), &space, Point3::origin(), bound, &search).unwrap();
        assert!(
            tolerance > 0.0 && (tolerance - own.value).abs() < 1e-9 * own.value,
            "{tolerance} {}",
            own.value
        );
    }
}

#[test]
fn a_base_design_with_cranks_is_refused_at_its_place() {
    let text = include_str!("../../../designs/presets/reachy-mini.toml");
    let violations = BasePlan::new(PlanText::new(text, Format::Toml)).unwrap_err();
    let refused = violations.iter().find(|v| v.code == files::design::Code::Rotary).unwrap();
    let line = text.lines().position(|l| l.starts_with("drive = \"rotary\"")).unwrap() + 1;
    assert_eq!(refused.line, line);
    assert!(refused.message.contains("base design of a sweep"), "{refused}");
    assert!(refused.help.contains("squared leg lengths"), "{refused}");
}

/// Patterns use some of the varying offsets; the unused ones make no further platform.
#[test]
fn a_platform_whose_pattern_leaves_offsets_unused_has_one_row() {
    let plan = |vary: &str| format!("compute = ['shared_joints', 'spacing']\n{vary}");
    let rows = |sweep: &Sweep| (0..sweep.count()).filter_map(|k| sweep.row(k)).collect::<Vec<_>>();
    // the corners of both triangles, which have no offset; one offset; all six
    let family = synthesis::Family::octahedral();
    let corners = family.members().iter().find(|m| m.pattern.offsets().is_empty()).unwrap();
    let patterns = format!("pattern = ['{}', 'S123456']", corners.pattern);
    let grid = sweep_of(
        OCTAHEDRAL,
        &plan(&format!(
            "[vary]\nby = 'grid'\nvalues = {{ {patterns}, offsets.1 = [0.2, 0.3], offsets.2 = [0.4], offsets.3 = [0.2], offsets.4 = [0.4], offsets.5 = [0.2], offsets.6 = [0.4, 0.5] }}\n"
        )),
    );
    let blocks = sweep_of(
        OCTAHEDRAL,
        &plan(&format!(
            "[[vary]]\nby = 'list'\nvalues = {{ {patterns} }}\n[[vary]]\nby = 'sobol'\ncount = 4\nvalues = {{ offsets = {{ from = 0.1, to = 0.9 }} }}\n"
        )),
    );
    for sweep in [&grid, &blocks] {
        let shared: Vec<SweepCell> =
            rows(sweep).iter().map(|row| cell(sweep, row, "shared_joints").clone()).collect();
        let of = |n: i64| shared.iter().filter(|c| **c == SweepCell::Integer(n)).count();
        // the octahedral platform shares six joints, the platform without shared joints none
        assert_eq!((shared.len(), of(6), of(0)), (5, 1, 4), "{shared:?}");
    }
}

#[test]
fn all_slips_of_a_plan_are_said_at_once() {
    let base = BasePlan::new(PlanText::new(OCTAHEDRAL, Format::Toml)).unwrap();
    let text = "name = 5\ndesign = 'd.toml'\ncompute = ['det_b']\nkeep = ['x']\nbogus = 1\n[[vary]]\nby = 'sobl'\ncount = -4\n[vary.values]\noffsets = { from = 0.1, tu = 0.9 }\n[[vary]]\nby = 'grid'\n[vary.values]\npatern = 'all'\n";
    let violations = read(PlanText::new(text, Format::Toml), &base).unwrap_err();
    let lines: Vec<usize> = violations.iter().map(|v| v.line).collect();
    assert_eq!(lines, [1, 3, 4, 5, 7, 8, 10, 10, 14], "{violations:#?}");
}
