//! `equipod new`: designs from sizes, corners and tables, and `design convert --units`.

use std::fmt::Write as _;
use std::path::Path;

use serde_json::Value;

use super::cli_frame::{document, equipod};

const SIZES: [&str; 10] = [
    "--base-radius",
    "500",
    "--platform-radius",
    "300",
    "--base-spread",
    "20",
    "--platform-spread",
    "20",
    "--height",
    "400",
];

fn new(args: &[&str]) -> Value {
    let out = equipod(&[&["new"], args, &["--json"]].concat());
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    document(&out)
}

fn refusal(args: &[&str]) -> (String, String) {
    let out = equipod(&[&["new"], args, &["--json"]].concat());
    assert_eq!(out.status.code(), Some(2), "{}", String::from_utf8_lossy(&out.stderr));
    let error = document(&out)["error"].clone();
    (error["code"].as_str().unwrap().into(), format!("{} {}", error["message"], error["help"]))
}

#[test]
fn sizes_make_a_design_that_every_command_takes() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("hexapod.toml");
    let file = path.to_str().unwrap();
    let out = equipod(&[&["new"], &SIZES[..], &["-o", file]].concat());
    let said = String::from_utf8(out.stdout).unwrap();
    assert_eq!(out.status.code(), Some(0));
    assert!(
        said.contains("home: x,y,z,roll,pitch,yaw = 0,0,400,0,0,0 (mm, deg)")
            && said.contains("leg lengths at home: "),
        "{said}"
    );
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(
        text.contains("base_radius = 500") && text.contains("mirror = ") && text.contains("turn = "),
        "{text}"
    );
    let lengths = document(&equipod(&["ik", file, "--json"]))["lengths"].clone();
    assert!(
        lengths
            .as_array()
            .unwrap()
            .iter()
            .all(|l| (l.as_f64().unwrap() - lengths[0].as_f64().unwrap()).abs() < 1e-9)
    );
    for command in [&["check", file][..], &["fk", file, "--csv"]] {
        assert_eq!(equipod(command).status.code(), Some(0), "{command:?}");
    }
    // one joint for two legs on both bodies is the octahedral design
    let octahedral = folder.path().join("octahedral.json");
    let sizes = [
        "--base-radius=500",
        "--platform-radius=300",
        "--base-spread=0",
        "--platform-spread=0",
        "--height=400",
    ];
    new(&[&sizes[..], &["-o", octahedral.to_str().unwrap()]].concat());
    let found = equipod(&["equivalents", "family", octahedral.to_str().unwrap()]);
    assert_eq!(found.status.code(), Some(0), "{}", String::from_utf8_lossy(&found.stderr));
}

#[test]
fn corners_make_an_octahedral_design() {
    let made = new(&["--corners", "0,0/12,0/6,10.4", "-3,0/3,0/0,5.2,0", "--height", "9", "--units", "in"]);
    assert_eq!((&made["units"], &made["home"]["p"][2]), (&Value::from("in"), &Value::from(9.0)));
    assert_eq!(made["architecturally_singular"], false);
    assert!(made["text"].as_str().unwrap().contains("A2 = [12.0, 0.0, 0.0]"), "{made}");
    assert_eq!(refusal(&["--corners", "0,0/12,0", "1,1/2,2/3,4", "--height", "9"]).0, "new::bad_corners");
}

#[test]
fn a_spreadsheet_makes_a_design_and_every_guess_is_said() {
    let out = equipod(&["new", "--points", "designs/tables/hexapod.csv"]);
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(said.contains("separated by semicolons") && said.contains("comma marks the decimals"), "{said}");
    let made = new(&["--points", "designs/tables/hexapod.csv"]);
    let guesses = made["guesses"].as_array().unwrap();
    assert!(guesses.iter().all(|g| said.contains(g.as_str().unwrap())), "{said}");
    assert_eq!((&made["home"]["p"][2], &made["units"]), (&Value::from(350.0), &Value::from("mm")));
    // it is the platform of the collection, in decimals
    let meant = document(&equipod(&["ik", "designs/symmetric-hexapod.toml", "--json"]))["lengths"].clone();
    for leg in 0..6 {
        let (a, b) = (meant[leg].as_f64().unwrap(), made["lengths"][leg].as_f64().unwrap());
        assert!((a - b).abs() < 1e-3, "leg {}: {a} {b}", leg + 1);
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("points.csv");
    std::fs::write(&path, "1,2,3\n4,5,x\n").unwrap();
    assert_eq!(refusal(&["--points", path.to_str().unwrap()]).0, "new::bad_table");
}

#[test]
fn exported_models_make_their_design_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let design = &path("inches.toml");
    equipod(&["design", "convert", "designs/rbt-octahedral.toml", "--units", "in", "-o", design]);
    let out = equipod(&["export", design, "--to", "mjcf", "-o", &path("")]);
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let lengths = |file: &str| document(&equipod(&["ik", file, "--json"]))["lengths"].clone();
    for (model, code, text) in [("platform.xml", "new::bad_mjcf", "<mujoco/>")] {
        let made = new(&["--points", &path(model), "-o", &path("made.toml")]);
        assert_eq!(made["units"], "in", "{model}");
        assert!(made["guesses"].as_array().unwrap().iter().any(|g| g.as_str().unwrap().contains("Home is")));
        let (meant, read) = (lengths(design), lengths(&path("made.toml")));
        for leg in 0..6 {
            let [a, b] = [&meant, &read].map(|list| list[leg].as_f64().unwrap());
            assert!((a - b).abs() < 1e-11 * a, "{model}, leg {}: {a} {b}", leg + 1);
        }
        let families = equipod(&["equivalents", "family", &path("made.toml")]);
        assert_eq!(families.status.code(), Some(0), "{model}: {}", String::from_utf8_lossy(&families.stderr));
        let labelled = new(&["--points", &path(model), "--units", "cm"]);
        assert!(labelled["guesses"].to_string().contains("nothing is converted"), "{labelled}");
        std::fs::write(path("broken"), text).unwrap();
        let (refused, said) = refusal(&["--points", &path("broken")]);
        assert!(
            refused == code && ["line 3", "0 slide joints"].iter().any(|w| said.contains(w)),
            "{refused} {said}"
        );
    }
}

#[test]
fn what_is_missing_is_named() {
    let (code, said) = refusal(&[]);
    assert_eq!(code, "new::nothing_given");
    assert!(["--base-radius", "--corners", "--points"].iter().all(|option| said.contains(option)), "{said}");
    let (code, said) = refusal(&SIZES[..8]);
    assert!(code == "new::missing" && said.contains("--height"), "{said}");
    let similar =
        [&SIZES[..4], &["--base-spread", "100", "--platform-spread", "20", "--height", "400"]].concat();
    let (code, said) = refusal(&similar);
    assert!(code == "new::bad_sizes" && said.contains("architecturally singular"), "{said}");
}

#[test]
fn a_list_of_points_in_a_design_is_refused_with_an_example() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("list.toml");
    std::fs::write(
        &path,
        "name = \"x\"\nunits = \"mm\"\nbase = [[1, 0, 0], [2, 0, 0]]\nplatform = [[1, 0, 0]]\n",
    )
    .unwrap();
    let out = equipod(&["check", path.to_str().unwrap()]);
    let said = String::from_utf8(out.stderr).unwrap();
    assert!(said.contains("A1 = [100, 0, 0]") && said.contains("B1 = [100, 0, 0]"), "{said}");
}

#[test]
fn a_design_is_converted_to_another_unit() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (inches, back) = (path("inches.toml"), path("back.json"));
    let design = "designs/symmetric-hexapod.toml";
    let run = |args: &[&str]| assert_eq!(equipod(args).status.code(), Some(0), "{args:?}");
    run(&["design", "convert", design, "--units", "in", "-o", &inches]);
    run(&["design", "convert", &inches, "--units", "mm", "-o", &back]);
    let lengths = |file: &str| document(&equipod(&["ik", file, "--json"]))["lengths"][0].as_f64().unwrap();
    assert!((lengths(design) / lengths(&inches) - 25.4).abs() < 1e-12);
    assert!((lengths(design) - lengths(&back)).abs() < 1e-9);
    let exact =
        |file: &str| document(&equipod(&["check", file, "--json"]))["architecturally_singular"].clone();
    assert_eq!(exact(design), exact(&inches));
    let out = equipod(&["design", "convert", design, "--units", "parsec", "-o", &back, "--json"]);
    assert_eq!(document(&out)["error"]["code"], "convert::units");
    assert!(Path::new(&inches).exists());
}

#[test]
fn refusals_of_general_designs_name_what_takes_them() {
    for args in [
        &["equivalents", "family", "designs/symmetric-hexapod.toml"][..],
        &["optimize", "designs/general-6-6.toml"],
    ] {
        let out = equipod(args);
        let said = String::from_utf8(out.stderr).unwrap();
        assert_eq!(out.status.code(), Some(2));
        for named in
            ["`equipod equivalents components`", "--search", "`equipod equivalents nearest DESIGN -o FILE`"]
        {
            assert!(said.contains(named), "{named}: {said}");
        }
    }
}

/// The parameters of a rig with cranks as a sheet of either program has them.
fn sheet(folder: &Path, name: &str, [l3, l4]: [f64; 2]) -> String {
    let mut text =
        format!("L1 = 700\nL2 = 120\nL3 = {l3}\nL4 = {l4}\ncrank = 90\nrod = 600\nmiddle_angle = 10\n");
    for (i, angle) in [180, 0, 300, 120, 60, 240].into_iter().enumerate() {
        writeln!(text, "crank_angle_{} = {angle}", i + 1).unwrap();
    }
    let path = folder.join(name);
    std::fs::write(&path, text).unwrap();
    path.display().to_string()
}

#[test]
fn sheets_of_either_dialect_give_one_design_and_the_wrong_dialect_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let sheets = [("dr-sim-manager", [900.0, 250.0]), ("motion4sim", [250.0, 900.0])];
    let mut designs = Vec::new();
    for (dialect, sides) in sheets {
        let path = sheet(folder.path(), dialect, sides);
        let design = folder.path().join(format!("{dialect}.toml")).display().to_string();
        let made = new(&["--sheet", &path, "--dialect", dialect, "-o", &design]);
        assert_eq!(made["lengths"][0], 600.0, "rods: {made}");
        designs.push(std::fs::read_to_string(&design).unwrap());
        // back to a sheet of the same program, and to one of the other
        for (other, [l3, l4]) in sheets {
            let out = folder.path().join("back").display().to_string();
            let wrote = equipod(&["design", "convert", &design, "--dialect", other, "-o", &out]);
            assert_eq!(wrote.status.code(), Some(0), "{}", String::from_utf8_lossy(&wrote.stderr));
            let text = std::fs::read_to_string(&out).unwrap();
            let value = |name: &str| -> f64 {
                let line = text
                    .lines()
                    .find_map(|l| l.strip_prefix(&format!("{name} = ")))
                    .unwrap_or_else(|| panic!("{text}"));
                line.parse().unwrap()
            };
            for (name, meant) in [
                ("L1", 700.0),
                ("L2", 120.0),
                ("L3", l3),
                ("L4", l4),
                ("crank", 90.0),
                ("rod", 600.0),
                ("middle_angle", 10.0),
            ] {
                assert!((value(name) - meant).abs() < 1e-9, "{name}: {text}");
            }
            let turn = (value("crank_angle_3") - 300.0).to_radians();
            assert!((turn.cos() - 1.0).abs() < 1e-12, "{text}");
        }
    }
    assert_eq!(designs[0], designs[1], "one rig");
    // angles of the cranks at home are the middle angle
    let design = folder.path().join("motion4sim.toml").display().to_string();
    let ik = document(&equipod(&["ik", &design, "--json"]));
    assert!((ik["angles_deg"][0].as_f64().unwrap() - 10.0).abs() < 1e-9, "{ik}");
    // no dialect, the wrong one, and none that is known
    let path = sheet(folder.path(), "sheet", [250.0, 900.0]);
    let (code, help) = refusal(&["--sheet", &path]);
    assert!(code == "new::no_dialect" && help.contains("dr-sim-manager"), "{code} {help}");
    let (code, help) = refusal(&["--sheet", &path, "--dialect", "dr-sim-manager"]);
    assert!(code == "new::bad_sheet" && help.contains("motion4sim"), "{code} {help}");
    assert_eq!(equipod(&["new", "--sheet", &path, "--dialect", "mover"]).status.code(), Some(2));
    let none = folder.path().join("none.txt").display().to_string();
    // a design that a sheet does not hold
    let out = equipod(&[
        "design",
        "convert",
        "designs/general-6-6.toml",
        "--dialect",
        "motion4sim",
        "-o",
        &none,
        "--json",
    ]);
    assert_eq!((out.status.code(), &document(&out)["error"]["code"]), (Some(2), &"convert::no_sheet".into()));
}

/// Two rings with these decimals, a row a leg.
fn rings(decimals: usize) -> String {
    let at = |r: f64, degrees: f64| {
        let (s, c) = f64::to_radians(degrees).sin_cos();
        format!("{:.decimals$},{:.decimals$},0", r * c, r * s)
    };
    let (base, platform) = ([-10., 10., 110., 130., 230., 250.], [-50., 50., 70., 170., 190., 290.]);
    let rows = base.iter().zip(platform).map(|(a, b)| format!("{},{}\n", at(500.0, *a), at(300.0, b)));
    rows.collect()
}

#[test]
fn decimals_that_were_meant_symmetric_are_said_to_be_and_written_so_with_snap() {
    let folder = tempfile::tempdir().unwrap();
    let name = |file: &str| folder.path().join(file).to_str().unwrap().to_owned();
    let (points, typed, snapped) = (name("rings.csv"), name("typed.toml"), name("snapped.toml"));
    std::fs::write(&points, rings(6)).unwrap();
    let plain = new(&["--points", &points, "-o", &typed]);
    let guesses = plain["guesses"].to_string();
    assert!(guesses.contains("--snap writes these") && guesses.contains("turned by a third"), "{guesses}");
    new(&["--points", &points, "--snap", "-o", &snapped]);
    let fk = document(&equipod(&["fk", &snapped, "--json"]));
    assert_eq!(
        (&fk["completeness"], &fk["finite_count"], &fk["real_count"]),
        (&"proved".into(), &28.into(), &8.into())
    );
    let converted = name("converted.toml");
    assert_eq!(equipod(&["design", "convert", &typed, "--snap", "-o", &converted]).status.code(), Some(0));
    let body = |path: &str| {
        let text = std::fs::read_to_string(path).unwrap();
        text.lines().filter(|line| line.starts_with(['A', 'B'])).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(body(&converted), body(&snapped));
    let again = equipod(&["design", "convert", &snapped, "--snap", "-o", &name("again.toml"), "--json"]);
    assert_eq!(
        (again.status.code(), &document(&again)["error"]["code"]),
        (Some(2), &"convert::no_symmetry".into())
    );
}

#[test]
fn sizes_are_told_as_they_were_understood_and_nearly_singular_ones_with_the_other_reading() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("other.toml");
    let usual = new(&SIZES);
    let told = usual["guesses"].to_string();
    assert!(
        told.contains("at 50, 70, 170, 190, 290, 310 degrees")
            && told.contains("write 100 instead of 20 degrees"),
        "{told}"
    );
    assert!(!told.contains("nearly singular"));
    let mut sizes = SIZES.map(str::to_owned);
    sizes[7] = "98".into();
    let mut words: Vec<&str> = sizes.iter().map(String::as_str).collect();
    words.extend(["-o", path.to_str().unwrap()]);
    let told = new(&words)["guesses"].to_string();
    assert!(
        told.contains("nearly singular") && told.contains("from the legs of a base pair (22 degrees)"),
        "{told}"
    );
}
