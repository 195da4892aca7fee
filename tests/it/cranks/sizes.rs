//! `equipod new --servo`: rotary hexapods from a few sizes.

use std::path::Path;

use serde_json::Value;

use super::{asked, numbers};

/// A desk-top machine in millimetres, without height and rods.
const SIZES: [&str; 10] = [
    "--servo",
    "--crank=24",
    "--base-radius=80",
    "--platform-radius=60",
    "--base-spread=20",
    "--platform-spread=20",
    "--units",
    "mm",
    "--name",
    "desk",
];

fn new(more: &[&str]) -> (Option<i32>, Value) {
    asked(&[&["new"], &SIZES[..], more].concat())
}

fn refusal(args: &[&str]) -> (String, String) {
    let (code, doc) = asked(&[&["new"], args].concat());
    assert_eq!(code, Some(2), "{doc}");
    let text = |key: &str| doc["error"][key].as_str().unwrap().to_owned();
    (text("code"), text("message") + " " + &text("help"))
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_owned()
}

#[test]
fn sizes_make_a_rotary_hexapod_that_commands_take() {
    let folder = tempfile::tempdir().unwrap();
    let file = &path(folder.path(), "servos.toml");
    let (code, made) = new(&["--height=110", "--crank-angles=-60,60", "-o", file]);
    assert_eq!(code, Some(0), "{made}");
    let rods = numbers(&made["lengths"]);
    assert!(rods.iter().all(|rod| (rod - rods[0]).abs() < 1e-12), "{made}");
    assert!(numbers(&made["crank_angles_deg"]).iter().all(|angle| angle.abs() < 1e-9), "{made}");
    let told = made["guesses"].to_string();
    assert!(told.contains("The crank centres are on a circle of radius 80 mm, at -10, 10,"), "{told}");
    assert!(told.contains("The rods are 117.4 mm long") && !told.contains("nearly singular"), "{told}");
    let text = std::fs::read_to_string(file).unwrap();
    for part in ["drive = \"rotary\"", "A3 = { turn = \"A1\", deg = 120 }", "[cranks.A1]\nmirror = \"A2\""] {
        assert!(text.contains(part), "{text}");
    }

    let zero = "--angles=0,0,0,0,0,0";
    let (code, poses) = asked(&["fk", file, zero, "--near", "home"]);
    assert_eq!(code, Some(0), "{poses}");
    let height = poses["solutions"][0]["p"]["re"][2].as_f64().unwrap();
    assert!((height - 110.0).abs() < 1e-9, "{poses}");
    let (code, angles) = asked(&["ik", file, "--pose", "2,-3,112,3,2,1"]);
    assert_eq!((code, &angles["within_limits"]), (Some(0), &true.into()), "{angles}");
    let (code, limits) = asked(&["limits", file]);
    assert_eq!((code, &limits["allowed"]), (Some(0), &true.into()), "{limits}");
    let (code, assessed) = asked(&["assess", file]);
    assert_eq!((code, &assessed["workspace"]), (Some(3), &"none".into()), "{assessed}");
    std::fs::write(file, text + "\n[workspace]\ntranslation = [5, 5, 5]\nrotation_deg = [3, 3, 3]\n")
        .unwrap();
    let (code, assessed) = asked(&["assess", file]);
    assert_eq!((code, &assessed["met"]), (Some(0), &true.into()), "{assessed}");
    let (code, exported) = asked(&["export", file, "--to", "c", "-o", &path(folder.path(), "c")]);
    assert_eq!(code, Some(0), "{exported}");
    assert!(folder.path().join("c/equipod_cranks.c").is_file());
}

#[test]
fn rods_give_the_height_of_home_and_json_holds_the_same_design() {
    let folder = tempfile::tempdir().unwrap();
    let file = &path(folder.path(), "servos.json");
    let (code, made) = new(&["--rod=120", "-o", file]);
    assert_eq!(code, Some(0), "{made}");
    assert!(made["guesses"].to_string().contains("so that the cranks are level there"), "{made}");
    let (_, angles) = asked(&["ik", file]);
    assert!(numbers(&angles["angles_deg"]).iter().all(|angle| angle.abs() < 1e-9), "{angles}");
    // both given: the cranks have the angle that results, and nothing is guessed
    let (code, made) = new(&["--rod=120", "--height=118"]);
    let angles = numbers(&made["crank_angles_deg"]);
    assert!(code == Some(0) && angles.iter().all(|a| *a > 5.0 && (a - angles[0]).abs() < 1e-9), "{made}");
    assert!(!made["guesses"].to_string().contains("so that the cranks are level"), "{made}");
}

#[test]
fn a_home_that_rods_do_not_hold_is_refused_with_rods_that_do() {
    let (code, said) = refusal(&[&SIZES[..], &["--height=110", "--rod=90"]].concat());
    assert_eq!(code, "new::out_of_reach", "{said}");
    let words: Vec<f64> = said.split([' ', ',']).filter_map(|word| word.parse().ok()).collect();
    let [_, least, most, _, low, high] = words[..] else { panic!("{words:?}: {said}") };
    for rod in [least, most] {
        let (code, made) = new(&["--height=110", &format!("--rod={rod}")]);
        assert_eq!(code, Some(0), "{made}");
    }
    for height in [low, high] {
        let (code, made) = new(&[&format!("--height={height}"), "--rod=90"]);
        assert_eq!(code, Some(0), "{made}");
    }
    let steep = [&SIZES[..], &["--height=110", "--rod=101", "--crank-angles=-30,30"]].concat();
    let (code, said) = refusal(&steep);
    assert!(code == "new::out_of_reach" && said.contains("outside their angles from -30 to 30"), "{said}");
}

#[test]
fn numbers_and_options_that_make_no_rotary_hexapod_are_refused() {
    let level = [&SIZES[..], &["--height=110"]].concat();
    for (more, code, said) in [
        (&["--crank-angles=60,-60"][..], "new::bad_sizes", "from 60 to -60 degrees"),
        (&["--crank-angles=60"], "new::bad_sizes", "has one number instead of 2"),
        (&["--crank-angles=a,60"], "new::bad_sizes", "`a` is not a finite number"),
        (&["--rod=-5"], "new::bad_sizes", "the length of a rod is -5"),
        (&["--crank-angles=10,60"], "new::out_of_reach", "at home the cranks are at 0 degrees"),
        (&["--rod=x"], "usage", "give a finite number"),
        (&["--points", "designs/tables/hexapod.csv"], "usage", "cannot be used with"),
    ] {
        let (found, text) = refusal(&[&level[..], more].concat());
        assert!(found == code && text.contains(said), "{more:?}: {found} {text}");
    }
    let corners = ["--servo", "--corners", "0,0/12,0/6,10", "0,0/6,0/3,5", "--height=9"];
    assert_eq!(refusal(&corners).0, "usage");
    let without = |option: &str| {
        let left: Vec<&str> = level.iter().copied().filter(|arg| !arg.starts_with(option)).collect();
        refusal(&left)
    };
    for option in ["--crank", "--base-radius", "--platform-spread"] {
        let (code, said) = without(option);
        assert!(code == "new::missing" && said.contains(option), "{said}");
    }
    let (code, said) = without("--height");
    assert!(code == "new::missing" && said.contains("--height and --rod are missing"), "{said}");
    assert_eq!(refusal(&["--servo"]).0, "new::missing");
    let (code, said) = without("--servo");
    assert!(code == "usage" && said.contains("--servo"), "{said}");
    let one: Vec<&str> =
        level.iter().map(|a| if a.starts_with("--base-s") { "--base-spread=0" } else { a }).collect();
    let (code, said) = refusal(&one);
    assert!(code == "new::bad_sizes" && said.contains("cannot have one centre"), "{said}");
}

#[test]
fn a_home_with_tips_below_the_platform_joints_is_called_nearly_singular() {
    // the tips are at 25.7 degrees of each pair, and with this spread so are the platform joints
    let spread = |degrees: f64| {
        let spread = format!("--platform-spread={degrees}");
        let sizes = SIZES.map(|arg| if arg.starts_with("--platform-s") { spread.as_str() } else { arg });
        let (_, made) = asked(&[&["new", "--height=110"], &sizes[..]].concat());
        made["guesses"].to_string()
    };
    let told = spread(68.6);
    assert!(told.contains("Home is nearly singular"), "{told}");
    // angles are printed without the digits of their rounding
    assert!(told.contains("at 25.7, 94.3,") && told.contains("write 51.4 instead of 68.6 degrees"), "{told}");
    // hexagons of crank centres and platform joints may be similar
    assert!(!spread(100.0).contains("nearly singular"), "{}", spread(100.0));
}
