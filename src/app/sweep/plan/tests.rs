//! Valid plans, refused plans, and the candidates of plans.

use super::*;
use crate::column::SweepCell;
use ask::presets::{Preset, PresetClass};
use files::design::Violation;

const DESIGN: &str = include_str!("../../../../designs/rbt-octahedral.toml");

const PRESETS: [Preset; 1] = [Preset {
    name: "bench-l16",
    class: PresetClass::Bench,
    text: include_str!("../../../../designs/presets/bench-l16.toml"),
}];

fn base() -> BasePlan {
    BasePlan::new(PlanText::new(DESIGN, Format::Toml)).unwrap()
}

fn plan(text: &str) -> Result<SweepPlan, Vec<Violation>> {
    read(PlanText::new(text, Format::Toml).with_presets(&PRESETS), &base())
}

const HEAD: &str = "name = 'p'\ndesign = 'd.toml'\ncompute = ['conditioning']\n";

fn with(vary: &str) -> Result<SweepPlan, Vec<Violation>> {
    plan(&format!("{HEAD}{vary}"))
}

/// Line and text of every violation.
fn faults(text: &str) -> Vec<(usize, String)> {
    plan(text).unwrap_err().iter().map(|v| (v.line, format!("{} {}", v.message, v.help))).collect()
}

fn numbers(plan: &SweepPlan, k: u64) -> Vec<f64> {
    plan.values(1, k).iter().filter_map(SweepCell::as_number).collect()
}

#[test]
fn a_grid_has_all_combinations_with_the_last_axis_fastest_and_ends_that_are_met() {
    let plan = with("[vary]\nby = 'grid'\n[vary.values]\n'base.P1.x' = { from = 0, to = 0.3, count = 4 }\n'base.P1.y' = [5, 7]\n").unwrap();
    assert_eq!(plan.count(), 8);
    let all: Vec<Vec<f64>> = (0..8).map(|k| numbers(&plan, k)).collect();
    assert_eq!((&all[0], &all[1], &all[7]), (&vec![0.0, 5.0], &vec![0.0, 7.0], &vec![0.3, 7.0]));
    assert!((all[2][0] - 0.1).abs() < 1e-15);
    let names: Vec<String> = plan.columns(&base()).into_iter().map(|c| c.name).collect();
    assert_eq!(names, ["candidate", "base_P1_x", "base_P1_y", "conditioning", "conditioning_pose", "error"]);
    let logarithmic = with("[vary]\nby = 'grid'\nvalues = { 'home.position.3' = { from = 1, to = 100, count = 3, scale = 'log' } }\n").unwrap();
    assert!(
        (numbers(&logarithmic, 1)[0] - 10.0).abs() < 1e-12
            && (numbers(&logarithmic, 2)[0] - 100.0).abs() < 1e-15
    );
}

#[test]
fn numbers_among_texts_are_texts() {
    let plan = with("[vary]\nby = 'list'\nvalues = { 'base.P1.x' = [1, '4/3', -0.5] }\n").unwrap();
    let all: Vec<String> = (0..3).map(|k| plan.values(1, k)[0].to_string()).collect();
    assert_eq!(all, ["1", "4/3", "-0.5"]);
    assert!((0..3).all(|k| matches!(plan.values(1, k)[0], SweepCell::Text(_))));
    let refused = with("[vary]\nby = 'list'\nvalues = { 'base.P1.x' = ['4/3', true] }\n").unwrap_err();
    assert!(refused[0].message.contains("not a number"), "{refused:#?}");
}

#[test]
fn blocks_are_multiplied_and_lists_go_side_by_side() {
    let plan = with(
        "[[vary]]\nby = 'list'\n[vary.values]\npattern = ['S123456', 'V123456']\n'home.position.3' = [14, 16]\n[[vary]]\nby = 'uniform'\ncount = 3\n[vary.values]\noffsets = { from = 0.2, to = 0.4 }\n",
    )
    .unwrap();
    assert_eq!(plan.count(), 6);
    let of = |k| plan.values(9, k);
    assert_eq!(of(0)[..2], [SweepCell::Text("S123456".into()), SweepCell::Number(14.0)]);
    assert_eq!(of(3)[..2], [SweepCell::Text("V123456".into()), SweepCell::Number(16.0)]);
    // the points of the second block are the same for each candidate of the first
    assert_eq!(of(1)[2..], of(4)[2..]);
    assert_ne!(of(1)[2..], of(2)[2..]);
    assert_ne!(plan.values(10, 1)[2..], of(1)[2..], "another seed");
    assert!(of(5)[2..].iter().all(|x| x.as_number().is_some_and(|x| (0.2..0.4).contains(&x))));
}

#[test]
fn the_whole_class_may_be_listed() {
    let family = synthesis::Family::octahedral();
    for (word, count) in [("all", family.counts().patterns), ("classes", family.counts().classes)] {
        let plan = with(&format!(
            "[[vary]]\nby = 'grid'\nvalues = {{ pattern = '{word}' }}\n[[vary]]\nby = 'sobol'\ncount = 2\nvalues = {{ offsets = {{ from = 0.1, to = 0.9 }} }}\n"
        ))
        .unwrap();
        assert_eq!(plan.count(), 2 * count as u64, "{word}");
    }
}

#[test]
fn json_says_the_same_as_toml() {
    let toml =
        with("[[vary]]\nby = 'sobol'\ncount = 8\nvalues = { offsets = { from = 0.1, to = 0.9 } }\n").unwrap();
    let text = r#"{"name": "p", "design": "d.toml", "compute": ["conditioning"], "vary": [{"by": "sobol", "count": 8, "values": {"offsets": {"from": 0.1, "to": 0.9}}}]}"#;
    let json = read(PlanText::new(text, Format::Json), &base()).unwrap();
    assert_eq!(toml.values(3, 5), json.values(3, 5));
    let named = files_named(PlanText::new(text, Format::Json)).unwrap();
    assert_eq!(named, PlanFiles { base: BaseName::File("d.toml".into()), drives: None });
}

const DRIVES: &[u8] =
    b"name,stroke,dead_length,force,mass_kg,price_EUR\nshort,4,6,100,1,50\nlong,9,6,80,2,90\n";

#[test]
fn drives_of_a_table_vary_by_their_names() {
    let based = || base().with_drives(DRIVES).unwrap();
    let head = "name = 'p'\ndesign = 'd.toml'\ndrives = 'drives.csv'\ncompute = ['drive']\n";
    let of = |text: &str| read(PlanText::new(text, Format::Toml), &based());
    let named = files_named(PlanText::new(head, Format::Toml)).unwrap();
    assert_eq!(named.drives.as_deref(), Some("drives.csv"));
    let whole = of(&format!("{head}[vary]\nby = 'grid'\nvalues = {{ drive = 'all' }}\n")).unwrap();
    let names: Vec<String> = (0..2).map(|k| whole.values(1, k)[0].to_string()).collect();
    assert_eq!((whole.count(), names), (2, vec!["short".to_string(), "long".to_string()]));
    let units: Vec<_> = whole.columns(&based()).into_iter().map(|c| (c.name, c.unit)).collect();
    assert_eq!(units[4], ("drive_price".to_string(), Some("EUR".to_string())));
    let complaint = |text: &str| {
        let first = of(text).unwrap_err().remove(0);
        format!("{} {}", first.message, first.help)
    };
    let wrong = complaint(&format!("{head}[vary]\nby = 'grid'\nvalues = {{ drive = ['shart'] }}\n"));
    assert!(wrong.contains("did you mean `short`?"), "{wrong}");
    let unused = complaint(&format!("{head}[vary]\nby = 'grid'\nvalues = {{ 'base.P1.x' = [1] }}\n"));
    assert!(unused.contains("the drive does not vary"), "{unused}");
    let tableless = format!("{HEAD}[vary]\nby = 'grid'\nvalues = {{ drive = 'all' }}\n");
    assert!(plan(&tableless).unwrap_err()[0].message.contains("names no table of drives"));
    let twice = base().with_drives(b"name,stroke,dead_length\na,4,6\na,5,6\n");
    assert_eq!(twice.unwrap_err(), files::design::InvalidDriveTable::TwoDrives("a".into()));
}

#[test]
fn the_table_of_poses_is_the_same_for_all_candidates() {
    let design = DESIGN.replace("[workspace]\n", "[workspace]\ntrajectory = 'path.csv'\n");
    let base = BasePlan::new(PlanText::new(&design, Format::Toml)).unwrap();
    let base = base.with_poses(b"0,0,16,0,0,0\n").unwrap();
    let text =
        format!("{HEAD}[vary]\nby = 'grid'\nvalues = {{ 'workspace.trajectory' = ['a.csv', 'b.csv'] }}\n");
    let refused = read(PlanText::new(&text, Format::Toml), &base).unwrap_err();
    assert!(refused[0].message.contains("read once for all candidates"), "{refused:#?}");
}

#[test]
fn slips_are_named_with_their_line_and_what_was_meant() {
    let vary = "[vary]\nby = 'grid'\n[vary.values]\n";
    let cases = [
        ("nmae = 'p'\n", 1, "did you mean `name`?"),
        ("name = 'p'\ndesign = 'd.toml'\ncompute = ['conditionning']\n", 3, "did you mean `conditioning`?"),
        (
            "name = 'p'\ndesign = 'd.toml'\nkeep = ['conditoning > 1']\ncompute = ['conditioning']\n[vary]\nby = 'grid'\nvalues = { 'base.P1.x' = [1] }\n",
            3,
            "did you mean `conditioning`?",
        ),
        ("name = 'p'\npreset = 'bench-116'\n", 2, "did you mean `bench-l16`?"),
        (&format!("{HEAD}{vary}'base.P7.x' = [1]\n"), 7, "it has: P1, P2, P3"),
        (&format!("{HEAD}{vary}'base.P1' = [1]\n"), 7, "is an array, not a number"),
        (&format!("{HEAD}{vary}'base.P1.w' = [1]\n"), 7, "no `w`"),
        (&format!("{HEAD}{vary}'offsets.7' = [1]\n"), 7, "offsets.1 to offsets.6"),
        (&format!("{HEAD}{vary}'pose.rol_deg' = [1]\n"), 7, "did you mean `roll_deg`?"),
        (
            &format!("{HEAD}{vary}'base.P1.x' = {{ from = 0, to = 1 }}\n"),
            7,
            "`count` of `base.P1.x` is missing",
        ),
        (
            &format!("{HEAD}{vary}'base.P1.x' = {{ from = 0, till = 1, count = 2 }}\n"),
            7,
            "`till` is not a key",
        ),
        (&format!("{HEAD}{vary}'base.P1.x' = [inf]\n"), 7, "not a finite number"),
        (&format!("{HEAD}{vary}pattern = ['S1']\n"), 7, "not six independent"),
        (
            &format!("{HEAD}[vary]\nby = 'sobel'\nvalues = {{ 'base.P1.x' = [1] }}\n"),
            5,
            "did you mean `sobol`?",
        ),
        (
            &format!("{HEAD}[vary]\nby = 'list'\nvalues = {{ 'base.P1.x' = [1], 'base.P1.y' = [1, 2] }}\n"),
            4,
            "1, 2 elements",
        ),
        (
            &format!("{HEAD}[vary]\nby = 'uniform'\nvalues = {{ 'base.P1.x' = [1] }}\n"),
            4,
            "`count` is missing",
        ),
        (
            &format!("{HEAD}[vary]\nby = 'uniform'\ncount = 2.5\nvalues = {{ 'base.P1.x' = [1] }}\n"),
            6,
            "whole number",
        ),
        (
            &format!("{HEAD}[vary]\nby = 'uniform'\ncount = 2\nvalues = {{ 'offsets.1' = [0.5] }}\n"),
            4,
            "all six",
        ),
        (
            &format!("{HEAD}[vary]\nby = 'uniform'\ncount = 2\nvalues = {{ pattern = ['S123456'] }}\n"),
            4,
            "up to 6",
        ),
        (&format!("{HEAD}{vary}lengths = [18]\n"), 4, "nothing that is computed depends on them"),
        (
            "name = 'p'\ndesign = 'd.toml'\ncompute = ['det_a']\n[vary]\nby = 'grid'\nvalues = { 'base.P1.x' = [1] }\n",
            3,
            "equivalent platform",
        ),
        (
            "name = 'p'\ndesign = 'd.toml'\ncompute = ['spacing', 'spacing']\n[vary]\nby = 'grid'\nvalues = { 'base.P1.x' = [1] }\n",
            3,
            "two columns",
        ),
        (
            "name = 'p'\ndesign = 'd.toml'\ncompute = ['margins']\n[vary]\nby = 'grid'\nvalues = { 'hardware.max' = [1] }\n",
            6,
            "has no `hardware`",
        ),
        ("name = 'p'\ndesign = 'd.toml'\npreset = 'bench-l16'\n", 3, "keep one of them"),
        ("name = 'p'\n", 1, "`design` is missing"),
    ];
    for (text, line, part) in cases {
        let found = faults(text);
        assert!(found.iter().any(|(l, t)| *l == line && t.contains(part)), "{text}\n{part}: {found:#?}");
    }
    // all of them at once
    assert!(faults("nmae = 'p'\ncompute = ['x']\n").len() >= 4);
}

#[test]
#[ignore = "evidence"]
fn mutated_plans_are_read_or_refused_and_nothing_else() {
    let good = format!(
        "{HEAD}keep = ['conditioning >= 0.1']\nposes = {{ region = 10 }}\nassess = {{ points = 5 }}\n[[vary]]\nby = 'sobol'\ncount = 8\n[vary.values]\noffsets = {{ from = 0.1, to = 0.9 }}\n[[vary]]\nby = 'grid'\nvalues = {{ 'home.position.3' = {{ from = 1, to = 2, count = 3, scale = 'log' }} }}\n"
    );
    assert!(plan(&good).is_ok(), "{:?}", plan(&good));
    let mut rng = num::Rng::new(11);
    let pieces =
        ["[", "]", "{", "}", "'", "=", "1e99", "-1", "\n", "nan", ".", "vary", "0", "\u{e9}", "from", ","];
    let (mut read, mut refused) = (0, 0);
    for _ in 0..3000 {
        let mut text: Vec<char> = good.chars().collect();
        for _ in 0..=rng.next_u64() % 3 {
            let at = (rng.next_u64() % text.len() as u64) as usize;
            let piece = pieces[(rng.next_u64() % pieces.len() as u64) as usize];
            match rng.next_u64() % 3 {
                0 => drop(text.splice(at..at, piece.chars())),
                1 => drop(text.remove(at)),
                _ => {
                    let end = text.len().min(at + 1 + (rng.next_u64() % 12) as usize);
                    drop(text.drain(at..end));
                }
            }
        }
        let text: String = text.into_iter().collect();
        match plan(&text) {
            Ok(plan) => {
                // every accepted plan has candidates
                let last = plan.count() - 1;
                assert_eq!(plan.values(1, last).len(), plan.quantities().count(), "{text}");
                read += 1;
            }
            Err(violations) => {
                assert!(violations.iter().all(|v| v.line >= 1 && !v.message.is_empty()), "{text}");
                assert!(!violations.is_empty(), "{text}");
                refused += 1;
            }
        }
    }
    assert!(read > 100 && refused > 1000, "{read} {refused}");
}
