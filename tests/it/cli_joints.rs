//! Kinds of joints in design files. Angles of universal joints are in `assess`, lengths of drives in `ik` and
//! `fk --near`. Some commands refuse joints that are not ideal.

use serde_json::Value;

use super::cli_frame::{document, equipod};
use super::evidence::size;

const DESIGN: &str = "designs/symmetric-hexapod.toml";

/// The symmetric hexapod with more lines in `[hardware]`.
fn with(folder: &tempfile::TempDir, name: &str, lines: &str) -> String {
    let text = std::fs::read_to_string(DESIGN).unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, format!("{text}{lines}")).unwrap();
    path.display().to_string()
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap_or_else(|| panic!("{value}")).iter().map(|x| x.as_f64().unwrap()).collect()
}

/// First axes across the legs, in the planes of base and platform.
const TANGENT: &str =
    "[[0, 1, 0], [0, 1, 0], [-0.866, -0.5, 0], [-0.866, -0.5, 0], [0.866, -0.5, 0], [0.866, -0.5, 0]]";

fn universal(keys: &str) -> String {
    let joint =
        |body: &str| format!("{body}_joint = {{ model = \"universal\", first_axis = {TANGENT}{keys} }}\n");
    joint("base") + &joint("platform")
}

#[test]
#[ignore = "evidence"]
fn assess_proves_both_angles_of_universal_joints() {
    let folder = tempfile::tempdir().unwrap();
    for (limits, exit) in [("[60, 60]", 0), ("[60, 12]", 1)] {
        let path = with(&folder, "universal.toml", &universal(&format!(", angle_deg = {limits}")));
        let out = equipod(&["assess", &path, "--json"]);
        let answer = document(&out);
        let rows = answer["requirements"].as_array().unwrap_or_else(|| panic!("{answer}"));
        for name in ["base_first_angle", "base_second_angle", "platform_first_angle", "platform_second_angle"]
        {
            let row = rows.iter().find(|r| r["name"] == name).unwrap_or_else(|| panic!("{name}: {answer}"));
            let second = name.ends_with("second_angle");
            let expected = if second && exit == 1 { "violated" } else { "met" };
            assert_eq!(row["status"], expected, "{row}");
        }
        assert_eq!(out.status.code(), Some(exit), "{answer}");
    }
}

/// Three universal joints at the base, two balls and a flexure; universal joints have no limit of the cone angle.
fn per_leg(second: f64, ball: f64, flexure: f64) -> String {
    let first = ["[0, 1, 0]", "[-0.866, -0.5, 0]", "[0.866, -0.5, 0]"];
    let universal = |k: usize| {
        format!(
            "{{ model = \"universal\", first_axis = {}, angle_deg = [60, {second}], cone_angle_deg = 180 }}",
            first[k]
        )
    };
    let ball = format!("{{ model = \"ball\", cone_angle_deg = {ball} }}");
    let flexure = format!("{{ model = \"flexure\", bending_stiffness = 4e4, cone_angle_deg = {flexure} }}");
    let list = [universal(0), ball.clone(), universal(1), ball, universal(2), flexure];
    format!("base_joint = [{}]\n", list.join(", "))
}

/// A joint with a housing of its own decides the distance from its neighbours, and has its own line in the list of
/// parts. Boxes that are no housings are refused at the place.
#[test]
fn joints_per_leg_have_housings_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let six = |third: &str| {
        let ball = |k: usize| format!("{{ model = \"ball\"{} }}", if k == 2 { third } else { "" });
        format!("base_joint = [{}]\n", (0..6).map(ball).collect::<Vec<_>>().join(", "))
    };
    let spacing = |third: &str| {
        let path = with(&folder, "housings.toml", &six(third));
        let answer = document(&equipod(&["assess", &path, "--json"]));
        let rows = answer["requirements"].as_array().unwrap_or_else(|| panic!("{answer}"));
        let row = rows.iter().find(|r| r["name"] == "base_spacing").unwrap_or_else(|| panic!("{answer}"));
        (path, row.clone())
    };
    let margin = |row: &Value| row["margin"].as_f64().unwrap();
    // pairs are 2 * 62.374 apart, and all joints are 30 wide
    let (_, alike) = spacing("");
    assert!((margin(&alike) - (2.0 * 62.374 - 30.0)).abs() < 1e-9, "{alike}");
    let (path, wide) = spacing(", housing = 50");
    assert!((margin(&wide) - (2.0 * 62.374 - 40.0)).abs() < 1e-9, "{wide}");
    assert!(wide["between"].as_array().unwrap().iter().any(|j| j == "A3"), "{wide}");
    let out = folder.path().join("parts");
    let done = equipod(&["export", &path, "--to", "csv", "-o", &out.display().to_string()]);
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let table = std::fs::read_to_string(out.join("parts.csv")).unwrap();
    for part in ["\"base joint, ball\",5,,,,,,30.0,", "\"base joint, ball\",1,,,,,,50.0,"] {
        assert!(table.contains(part), "{part}: {table}");
    }
    let path = with(&folder, "flat.toml", &six(", housing = [1, 2]"));
    let answer = document(&equipod(&["assess", &path, "--json"]));
    assert!(answer["error"]["violations"][0]["line"].as_u64().is_some(), "{answer}");
}

/// Each leg has the limits of its own joint. The least margin of a row is at a leg that has such a joint, and a limit
/// of other legs changes nothing.
#[test]
fn joints_per_leg_are_assessed_leg_by_leg() {
    let poses = size(&["--points", "200"][..], &[]);
    let folder = tempfile::tempdir().unwrap();
    let row = |name: &str, lines: &str| {
        let path = with(&folder, "mixed.toml", lines);
        let answer = document(&equipod(&[&["assess", &path, "--json"], poses].concat()));
        let rows = answer["requirements"].as_array().unwrap_or_else(|| panic!("{answer}"));
        rows.iter().find(|r| r["name"] == name).cloned().unwrap_or_else(|| panic!("{name}: {answer}"))
    };
    let legs = |row: &Value| numbers(&row["legs"]);
    let margin = |row: &Value| row["margin"].as_f64().unwrap();
    // the same joint for all legs: where each leg stands at the worst
    let all = row("base_cone_angle", "base_cone_angle_deg = 90\n");
    let worst = 90.0 - margin(&all);
    assert!(worst > 10.0, "{all}");
    let wide = row("base_cone_angle", &per_leg(60.0, 60.0, 60.0));
    assert!(legs(&wide).iter().all(|leg| [2.0, 4.0, 6.0].contains(leg)), "{wide}");
    assert!((margin(&wide) - (60.0 - worst)).abs() < 5.0 && wide["status"] == "met", "{wide}");
    // the flexure alone is too stiff for the workspace, and leg 6 has it
    let stiff = row("base_cone_angle", &per_leg(60.0, 60.0, 4.0));
    assert_eq!((legs(&stiff), &stiff["status"]), (vec![6.0], &"violated".into()), "{stiff}");
    // the second angles are those of legs 1, 3 and 5
    let free = row("base_second_angle", &per_leg(60.0, 60.0, 60.0));
    let tight = row("base_second_angle", &per_leg(12.0, 60.0, 60.0));
    for found in [&free, &tight] {
        assert!(legs(found).iter().all(|leg| [1.0, 3.0, 5.0].contains(leg)), "{found}");
    }
    assert!((margin(&free) - margin(&tight) - 48.0).abs() < 1e-6);
    assert_eq!((&free["status"], &tight["status"]), (&"met".into(), &"violated".into()));
    // all legs alike in a list are all legs alike in one table
    let six = |model: &str| format!("base_joint = [{}]\n", format!("{model}, ").repeat(6));
    let list = row("base_cone_angle", &six("{ model = \"ball\", cone_angle_deg = 40 }"));
    assert_eq!(list, row("base_cone_angle", "base_cone_angle_deg = 40\n"));
}

/// Poses, limits, the search and exported files take joints per leg, or say why they do not.
#[test]
fn commands_take_joints_per_leg_or_refuse_them() {
    let folder = tempfile::tempdir().unwrap();
    let path = with(&folder, "mixed.toml", &per_leg(60.0, 60.0, 40.0));
    let run = |args: &[&str]| {
        let out = equipod(args);
        (out.status.code(), document(&out))
    };
    // a flexure alone pushes: at home nothing, away from it at leg 6
    let home = {
        let text = std::fs::read_to_string(&path).unwrap();
        let (design, _) =
            equipod::methods::design::parse(&text, equipod::methods::design::Format::Toml).unwrap();
        let p = design.home.unwrap().position;
        [p.x, p.y, p.z]
    };
    let at = |dx: f64| format!("{},{},{},0,0,0", home[0] + dx, home[1], home[2]);
    let force = |dx: f64| {
        let (code, answer) = run(&["ik", &path, "--pose", &at(dx), "--details", "--json"]);
        assert_eq!(code, Some(0), "{answer}");
        let found = numbers(&answer["flexures"]["force"]);
        assert!(!found.is_empty());
        found.iter().map(|x| x * x).sum::<f64>().sqrt()
    };
    assert!(force(0.0) < 1e-6 && force(20.0) > 1.0, "{} {}", force(0.0), force(20.0));
    let (code, limits) = run(&["limits", &path, "--json"]);
    assert_eq!(code, Some(0), "{limits}");
    let copy = folder.path().join("copy.toml").display().to_string();
    let (code, written) = run(&["design", "convert", &path, "-o", &copy, "--json"]);
    assert_eq!(code, Some(0), "{written}");
    let to = |format: &str| {
        let out = folder.path().join(format);
        let (code, answer) = run(&["export", &path, "--to", format, "-o", out.to_str().unwrap(), "--json"]);
        (code, answer, out)
    };
    let (code, answer, out) = to("mjcf");
    assert_eq!(code, Some(0), "{answer}");
    let model = std::fs::read_to_string(out.join("platform.xml")).unwrap();
    let ranged = |leg: usize| {
        model.lines().any(|l| l.contains(&format!("name=\"swing{leg}x\"")) && l.contains("range="))
    };
    assert_eq!([1, 2, 3, 4, 5, 6].map(ranged), [false, true, false, true, false, true], "{model}");
    let (code, answer, _) = to("c");
    assert_eq!(code, Some(1), "{answer}");
    let why = answer["formats"][0]["refused"].as_str().unwrap();
    assert!(why.contains("different cone angles"), "{why}");
    let (code, answer, out) = to("csv");
    assert_eq!(code, Some(0), "{answer}");
    let table = std::fs::read_to_string(out.join("parts.csv")).unwrap();
    for part in ["\"base joint, universal\",3", "\"base joint, ball\",2", "\"base joint, flexure\",1"] {
        assert!(table.contains(part), "{part}: {table}");
    }
    assert!(table.contains("flexure at the base, ball at the platform"), "{table}");
    // a list of five, with the place in the file
    let five = with(
        &folder,
        "five.toml",
        &per_leg(60.0, 60.0, 40.0).replacen("{ model = \"ball\", cone_angle_deg = 60 }, ", "", 1),
    );
    let (code, answer) = run(&["assess", &five, "--json"]);
    assert_eq!(code, Some(2));
    let fault = &answer["error"]["violations"][0];
    assert!(fault["message"].as_str().unwrap().contains("`base_joint` is a list of 5"), "{answer}");
    assert!(fault["line"].as_u64().is_some(), "{answer}");
}

#[test]
#[ignore = "evidence"]
fn assess_assesses_drives_whose_joints_are_not_ideal() {
    let folder = tempfile::tempdir().unwrap();
    let hexapod = std::fs::read_to_string(DESIGN).unwrap();
    assert!(hexapod.contains("translation = [60.0, 60.0, 60.0]"));
    let small = hexapod
        .replace("[60.0, 60.0, 60.0]", "[20.0, 20.0, 20.0]")
        .replace("[10.0, 10.0, 10.0]", "[3.0, 0.0, 3.0]");
    let assessed = |name: &str, limits: &str, joints: &str| {
        let path = folder.path().join(name);
        std::fs::write(&path, format!("{small}leg_length = {limits}\n{joints}")).unwrap();
        let out = equipod(&["assess", &path.display().to_string(), "--json"]);
        (out.status.code(), document(&out))
    };
    let joints = format!("screw_lead = 8\n{}", universal(", offset = 14, angle_deg = [60, 60]"));
    let row = |answer: &Value, name: &str| -> Value {
        let rows = answer["requirements"].as_array().unwrap_or_else(|| panic!("{answer}"));
        rows.iter().find(|r| r["name"] == name).unwrap_or_else(|| panic!("{name}: {answer}")).clone()
    };
    let (exit, wide) = assessed("wide.toml", "[200, 600]", &joints);
    assert_eq!((exit, &wide["regular"]["status"]), (Some(0), &"proved".into()), "{wide}");
    for name in ["max_leg_length", "min_leg_length", "base_second_angle", "leg_clearance"] {
        assert_eq!(row(&wide, name)["status"], "met", "{wide}");
    }
    // a limit between the longest drive and the longest distance of joints
    let longest = |answer: &Value| 600.0 - row(answer, "max_leg_length")["margin"].as_f64().unwrap();
    let (_, ideal) = assessed("ideal.toml", "[200, 600]", &universal(", angle_deg = [60, 60]"));
    let between = 0.5 * (longest(&wide) + longest(&ideal));
    assert!(longest(&ideal) - longest(&wide) > 5.0, "{} {}", longest(&ideal), longest(&wide));
    let limits = format!("[200, {between}]");
    assert_eq!(assessed("short.toml", &limits, &joints).0, Some(0));
    assert_eq!(assessed("other.toml", &limits, &universal(", angle_deg = [60, 60]")).0, Some(1));
}

#[test]
fn drives_of_poses_lead_back_to_the_poses() {
    let folder = tempfile::tempdir().unwrap();
    let path = with(&folder, "coupled.toml", &format!("screw_lead = 8\n{}", universal(", offset = 14")));
    let pose = "12,-20,365,4,-3,6";
    let one = document(&equipod(&["ik", &path, "--pose", pose, "--json"]));
    let (drives, distances) = (numbers(&one["drives"]["lengths"]), numbers(&one["lengths"]));
    let offsets = numbers(&one["drives"]["of_offsets"]);
    let twists = numbers(&one["drives"]["twists_deg"]);
    for i in 0..6 {
        let meant = distances[i] + offsets[i] - 8.0 / 360.0 * twists[i];
        assert!((drives[i] - meant).abs() < 1e-9 && (drives[i] - distances[i]).abs() > 1.0, "{one}");
    }
    let kinds: Vec<&str> =
        one["margins"].as_array().unwrap().iter().filter_map(|m| m["name"].as_str()).collect();
    assert!(kinds.contains(&"leg_clearance"), "legs from second axis to second axis: {one}");
    // the table of one command is read by the other
    let table = folder.path().join("drives.csv");
    let out = equipod(&["ik", &path, "--pose", "home", "--pose", pose]);
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.starts_with("drive_length_1_mm,"), "{text}");
    std::fs::write(&table, text).unwrap();
    let table = table.display().to_string();
    let out = equipod(&["fk", &path, "--near", "home", "--lengths", &table, "--json"]);
    let answer = document(&out);
    assert_eq!(out.status.code(), Some(0), "{answer}");
    let row = &answer["rows"][1];
    assert_eq!((&row["drives"]["status"], &row["near"]["outcome"]), (&"proved".into(), &"tracked".into()));
    let position = numbers(&row["solutions"][0]["real_pose"]["position"]);
    for (found, meant) in position.iter().zip([12.0, -20.0, 365.0]) {
        assert!((found - meant).abs() < 1e-9, "{row}");
    }
    assert_eq!(row["solutions"][0]["certified"], false, "certificates are about distances of joints");
    assert!(row["drives"]["position_bound"].as_f64().unwrap() < 1e-9);
    // a lead that is no lead of a machine: no pose, and it says why
    let wild = with(&folder, "wild.toml", &format!("screw_lead = 40000\n{}", universal("")));
    let drives = numbers(&document(&equipod(&["ik", &wild, "--pose", pose, "--json"]))["drives"]["lengths"]);
    let lengths: Vec<String> = drives.iter().map(|x| x.abs().to_string()).collect();
    let out = equipod(&["fk", &wild, "--near", "home", "--lengths", &lengths.join(","), "--json"]);
    let answer = document(&out);
    assert_eq!((out.status.code(), answer["solutions"].as_array().unwrap().len()), (Some(3), 0), "{answer}");
    assert!(answer["drives"]["reason"].is_string() && answer["near"]["outcome"] != "tracked");
}

#[test]
#[ignore = "evidence"]
fn what_takes_drives_for_distances_refuses_joints_that_are_not_ideal() {
    let folder = tempfile::tempdir().unwrap();
    let path = with(&folder, "coupled.toml", &universal(", offset = 14"));
    let out = folder.path().join("out").display().to_string();
    for words in [
        &["fk", &path][..],
        &["limits", &path],
        &["check", &path],
        &["optimize", &path],
        &["export", &path, "--to", "hal", "-o", &out],
        &["view", &path, "-o", &out],
    ] {
        let answer = equipod(&[words, &["--json"]].concat());
        assert_eq!(answer.status.code(), Some(2), "{words:?}");
        let document = document(&answer);
        let code = &document["error"]["code"];
        let first = &document["error"]["violations"][0]["code"];
        assert!(*code == "design::not_ideal" || *first == "design::not_ideal", "{words:?} {document}");
    }
    // C has the functions of the drives, and kinematics modules that compute with them
    assert_eq!(equipod(&["export", &path, "--to", "c", "-o", &out]).status.code(), Some(0));
    let of = |name: &str| std::fs::read_to_string(folder.path().join("out").join(name)).unwrap();
    assert!(of("equipod_design.h").contains("#define EQUIPOD_HAS_DRIVES 1"));
    assert!(
        of("linuxcnc/equipodkins.h").contains("equipod_track_drives")
            && of("linuxcnc/equipodkins.c").contains("base-joint-offset")
    );
    assert!(of("linuxcnc/equipodkins_ops.c").contains("base-joint-offset"));
    let written = folder.path().join("written.toml").display().to_string();
    assert_eq!(equipod(&["design", "convert", &path, "-o", &written]).status.code(), Some(0));
    assert!(std::fs::read_to_string(&written).unwrap().contains("offset = 14"));
}

#[test]
fn flexures_pull_the_platform_back_to_home() {
    let folder = tempfile::tempdir().unwrap();
    let joint =
        "platform_cone_angle_deg = 20\nplatform_joint = { model = \"flexure\", bending_stiffness = 5e4 }\n";
    let path = with(&folder, "flexures.toml", joint);
    let at = |pose: &str| document(&equipod(&["ik", &path, "--pose", pose, "--json"]))["flexures"].clone();
    let home = numbers(&at("home")["torque"]);
    assert!(home.iter().all(|x| x.abs() < 1e-6), "{home:?}");
    let aside = at("30,0,350,0,0,0");
    assert!(numbers(&aside["force"])[0] < -1.0, "{aside}");
    let turned = at("0,0,350,0,0,8");
    assert!(numbers(&turned["torque"])[2] < -1.0, "{turned}");
}
