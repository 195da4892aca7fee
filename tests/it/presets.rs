//! Designs of real hardware: they load, name the sources of their figures, and agree with the page.

use equipod::methods::design::{Code, Format, PRESETS, PresetClass, parse, parse_with_cranks};
use equipod::methods::geom::Pose;
use equipod::methods::requirements::{AssessOptions, TermKind, assess};
use equipod::methods::singularity::Architecture;

use super::cli_frame::{document, equipod};

fn quick() -> AssessOptions {
    AssessOptions::new().points(300).steps(4).searches(1).seed(1)
}

fn page() -> String {
    std::fs::read_to_string("docs/presets.md").unwrap()
}

#[test]
fn every_preset_loads_without_warning_and_reads_back() {
    for preset in PRESETS {
        let read = parse_with_cranks(preset.text, Format::Toml);
        let (design, warnings) = read.unwrap_or_else(|v| panic!("{v:?}"));
        assert_eq!(warnings, [], "{}", preset.name);
        for (text, format) in [(design.to_toml(), Format::Toml), (design.to_json(), Format::Json)] {
            let (again, _) = parse_with_cranks(&text, format).unwrap();
            assert_eq!(format!("{again:?}"), format!("{design:?}"), "{}", preset.name);
        }
    }
}

#[test]
fn the_presets_are_the_files_of_their_folder() {
    let files = std::fs::read_dir("designs/presets").unwrap().map(|e| e.unwrap().path());
    let mut stems: Vec<String> =
        files.map(|p| p.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    stems.sort();
    let mut names = PRESETS.map(|p| p.name.to_string()).to_vec();
    names.sort();
    assert_eq!(stems, names);
    for class in [PresetClass::Bench, PresetClass::MotionSimulator, PresetClass::PrecisionPositioner] {
        assert!(PRESETS.iter().any(|p| p.class == class), "{class:?}");
    }
}

/// Lines with a figure, up to the key or table they belong to, that say neither where it is from nor that it was
/// chosen.
fn unexplained(text: &str) -> Vec<String> {
    let mut explained = false; // by the comment of the table
    let mut before = "";
    let mut out = Vec::new();
    for line in text.lines() {
        let says = |s: &str| s.contains("# sourced") || s.contains("# chosen");
        if line.starts_with('[') {
            explained = says(line) || (line.starts_with("[[") && explained);
        } else if line.starts_with(|c: char| c.is_ascii_lowercase()) {
            let plain = [
                "name",
                "units",
                "force_units",
                "mass_units",
                "source",
                "description",
                "legs",
                "drive",
                "region",
                "grid",
                "rpy_deg",
            ];
            let key = line.split([' ', '=']).next().unwrap();
            if !plain.contains(&key) && !explained && !says(line) && !says(before) {
                out.push(line.to_string());
            }
        }
        before = line;
    }
    out
}

#[test]
fn every_figure_is_sourced_or_marked_as_chosen() {
    for preset in PRESETS {
        assert_eq!(unexplained(preset.text), [""; 0], "{}", preset.name);
        let (design, _) = parse_with_cranks(preset.text, Format::Toml).unwrap();
        let source = design.source.as_ref().unwrap();
        assert!(source.contains("https://"), "{}: an address", preset.name);
        assert!(preset.text.contains("# sourced") && preset.text.starts_with("# Sourced"), "{}", preset.name);
    }
    // the check sees a figure that nobody vouches for
    let bare = PRESETS[0].text.replace("leg_diameter = 20.0                 # chosen", "leg_diameter = 20.0");
    assert_eq!(unexplained(&bare), ["leg_diameter = 20.0"]);
}

#[test]
fn every_preset_is_regular_and_meets_what_it_asks_for() {
    for preset in PRESETS {
        // `cranks/margins.rs` checks the requirements of cranks
        let Ok((design, _)) = parse(preset.text, Format::Toml) else { continue };
        let home = design.home.unwrap();
        assert_eq!(Architecture::of(design.manipulator()).is_singular(), Some(false), "{}", preset.name);
        let found =
            assess(design.manipulator(), &design.requirements(), &design.workspace.space(&home), &quick());
        assert!(found.all_met() && found.margins.len() >= 3, "{}: {:?}", preset.name, found.margins);
    }
}

#[test]
fn struts_at_rest_are_what_the_sources_say() {
    // LinuxCNC homes all struts at 29.7466; Rubin's struts are 493 mm
    for (name, length, within) in [
        ("linuxcnc-hexapod", 29.7466, 1e-3),
        ("rubin-camera-hexapod", 493.1, 0.2),
        ("rubin-m2-hexapod", 493.0, 0.1),
    ] {
        let preset = PRESETS.iter().find(|p| p.name == name).unwrap();
        let (design, _) = parse(preset.text, Format::Toml).unwrap();
        let home: Pose = design.home.unwrap();
        let lengths = home.lengths(design.manipulator()).unwrap().get();
        assert!(lengths.iter().all(|l| (l - length).abs() < within), "{name}: {lengths:?}");
    }
}

#[test]
fn a_preset_with_a_broken_value_is_refused_and_one_with_a_shorter_drive_fails() {
    let text = PRESETS[0].text;
    let broken = text.replace("leg_length = [198.0, 298.0]", "leg_length = [298.0, 198.0]");
    assert!(parse(&broken, Format::Toml).is_err());
    let unknown = text.replace("joint_diameter", "joint_diametre");
    let violations = parse(&unknown, Format::Toml).unwrap_err();
    assert_eq!(violations[0].code, Code::UnknownKey);
    // the drive with half the stroke: 118 closed, 50 of stroke, 15 at either end
    let shorter = text.replace("leg_length = [198.0, 298.0]", "leg_length = [148.0, 198.0]");
    let (design, _) = parse(&shorter, Format::Toml).unwrap();
    let space = design.workspace.space(&design.home.unwrap());
    let found = assess(design.manipulator(), &design.requirements(), &space, &quick());
    let failing: Vec<TermKind> =
        found.margins.iter().filter(|m| m.value < 0.0).map(|m| m.term.kind).collect();
    assert_eq!(failing, [TermKind::MaxLegLength]);
}

#[test]
fn the_page_has_a_row_for_every_preset_with_its_lengths() {
    let page = page();
    for preset in PRESETS {
        assert!(page.contains(&format!("`{}`", preset.name)), "{}", preset.name);
        // the numbers of the line on leg lengths stand in the table too
        let key = ["leg_length", "dead_length", "rod_length"].iter().find_map(|k| {
            let line = preset.text.lines().find(|l| l.starts_with(k))?;
            Some(line.split('#').next()?.split('=').nth(1)?.trim().to_string())
        });
        let key = key.unwrap();
        assert!(page.contains(&key), "{}: {key}", preset.name);
    }
}

#[test]
fn the_command_lists_writes_and_refuses() {
    let doc = document(&equipod(&["design", "presets", "--json"]));
    let listed = doc["presets"].as_array().unwrap();
    assert_eq!(listed.len(), PRESETS.len());
    assert!(listed.iter().all(|p| p["source"].as_str().unwrap().contains("https://")), "{doc}");

    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let out = equipod(&["design", "presets", "rubin-camera-hexapod", "-o", path.to_str().unwrap()]);
    assert_eq!(out.status.code(), Some(0));
    let written = std::fs::read_to_string(&path).unwrap();
    assert!(PRESETS.iter().any(|p| p.text == written), "with its comments");
    let out = equipod(&["assess", path.to_str().unwrap(), "--points", "100"]);
    assert_eq!(out.status.code(), Some(0));

    let shown = equipod(&["design", "presets", "bench-l16"]);
    assert_eq!(String::from_utf8(shown.stdout).unwrap(), PRESETS[0].text);
    let refused = equipod(&["design", "presets", "bench-l61", "--json"]);
    let doc = document(&refused);
    assert_eq!((refused.status.code(), doc["error"]["code"].as_str()), (Some(2), Some("presets::unknown")));
    assert!(doc["error"]["help"].as_str().unwrap().contains("bench-l16"));
    let refused = equipod(&["design", "presets", "bench-l16", "-o", "x.json", "--json"]);
    assert_eq!(document(&refused)["error"]["code"].as_str(), Some("presets::unknown_format"));
}
