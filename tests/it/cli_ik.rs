//! `equipod ik`, and the tables of `equipod fk DESIGN --csv`: each reads the files of the other.

use super::cli_frame::{document, equipod};

const DESIGN: &str = "designs/symmetric-hexapod.toml";
/// A design without requirements.
const WITHOUT_LIMITS: &str = "designs/rbt-octahedral.toml";
/// A design whose legs have limits.
const LIMITED: &str = "designs/presets/bench-l16.toml";

fn table(args: &[&str]) -> Vec<Vec<String>> {
    let out = equipod(args);
    assert_eq!(out.status.code(), Some(0), "{args:?}: {}", String::from_utf8_lossy(&out.stderr));
    let text = String::from_utf8(out.stdout).unwrap();
    let rows: Vec<Vec<String>> = text.lines().map(|l| l.split(',').map(str::to_string).collect()).collect();
    assert!(rows.iter().all(|row| row.len() == rows[0].len()), "{text}");
    rows
}

fn column<'a>(rows: &'a [Vec<String>], name: &str) -> Vec<&'a str> {
    let place = rows[0].iter().position(|n| n == name).unwrap_or_else(|| panic!("{name} in {:?}", rows[0]));
    rows[1..].iter().map(|row| row[place].as_str()).collect()
}

#[test]
fn lengths_of_poses_are_a_table_without_preamble() {
    let rows = table(&["ik", DESIGN]);
    let legs = ["leg_1_mm", "leg_2_mm", "leg_3_mm", "leg_4_mm", "leg_5_mm", "leg_6_mm"];
    assert_eq!((&rows[0][..6], rows[0][6].as_str()), (&legs.map(String::from)[..], "within_limits"));
    assert_eq!(table(&["ik", WITHOUT_LIMITS])[0].len(), 6);
    assert_eq!(rows.len(), 2);
    // the design has the lengths of its home pose
    let home: f64 = rows[1][0].parse().unwrap();
    assert!((home - 394.230_682_404_350_66).abs() < 1e-9);
    let rows = table(&["ik", DESIGN, "--pose", "home", "--pose", "0,0,360,0,0,0", "--pose=-5,0,360,5,0,0"]);
    assert_eq!(rows.len(), 4);
    let limited = table(&["ik", LIMITED, "--pose", "home", "--pose", "0,0,1000,0,0,0"]);
    assert_eq!(column(&limited, "within_limits"), ["true", "false"]);
}

#[test]
fn poses_as_matrices_and_in_json_are_those_of_their_angles() {
    // a third of a turn about the diagonal, exactly
    let (matrix, angles) = ("0,0,1,4,1,0,0,-2,0,1,0,350", "4,-2,350,90,0,90");
    let meant = table(&["ik", WITHOUT_LIMITS, "--pose", angles]);
    let folder = tempfile::tempdir().unwrap();
    let near = |found: &[Vec<String>]| {
        let number = |cell: &String| cell.parse::<f64>().unwrap();
        found[1].iter().map(number).zip(meant[1].iter().map(number)).all(|(a, b)| (a - b).abs() < 1e-9)
    };
    assert!(near(&table(&["ik", WITHOUT_LIMITS, "--pose", matrix])));
    let lines = "0 0 1 4\n1 0 0 -2\n0 1 0 350\n0 0 0 1\n";
    let json = "{\"poses\": [{\"R\": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], \"p\": [4, -2, 350]}]}";
    for text in [lines, json, &matrix.replace(',', " ")] {
        let file = folder.path().join("poses.txt");
        std::fs::write(&file, text).unwrap();
        assert!(near(&table(&["ik", WITHOUT_LIMITS, file.to_str().unwrap()])), "{text}");
    }
    let at = |pose: &str| document(&equipod(&["at", WITHOUT_LIMITS, "--pose", pose, "--json"]));
    assert_eq!(at(matrix)["pose"]["p"], at(angles)["pose"]["p"]);
    // all commands with exact poses read them too
    let exact = document(&equipod(&["singular", "motion", WITHOUT_LIMITS, "--pose", matrix, "--json"]));
    assert!(exact["error"].is_null(), "{exact}");
    let mirrored =
        document(&equipod(&["ik", WITHOUT_LIMITS, "--pose", "0,0,1,4,1,0,0,-2,0,-1,0,350", "--json"]));
    assert!(mirrored["error"]["message"].as_str().unwrap().contains("no rotation"), "{mirrored}");
}

#[test]
fn the_record_has_one_pose_or_rows() {
    let one = document(&equipod(&["ik", DESIGN, "--json"]));
    assert_eq!(one["lengths"].as_array().unwrap().len(), 6);
    assert!(one["within_limits"] == true && one["pose"]["R"][0][0] == 1.0);
    assert!(document(&equipod(&["ik", WITHOUT_LIMITS, "--json"]))["within_limits"].is_null());
    let two = document(&equipod(&["ik", LIMITED, "--pose", "home", "--pose", "0,0,1000,0,0,0", "--json"]));
    assert_eq!(two["rows"].as_array().unwrap().len(), 2);
    assert_eq!(two["rows"][1]["within_limits"], false);
    assert_eq!(two["rows"][1]["outside"], serde_json::json!([1, 2, 3, 4, 5, 6]));
    let bad = document(&equipod(&["ik", DESIGN, "--pose", "1,2,3", "--json"]));
    assert_eq!(bad["error"]["code"], "ik::bad_pose");
}

#[test]
fn a_pose_is_within_limits_only_if_every_requirement_is_met() {
    let folder = tempfile::tempdir().unwrap();
    let stiff = folder.path().join("stiff.toml");
    let text = std::fs::read_to_string(LIMITED).unwrap();
    let narrow = text.replace("base_cone_angle_deg = 35.0", "base_cone_angle_deg = 10.0");
    assert_ne!(narrow, text);
    std::fs::write(&stiff, narrow).unwrap();
    let stiff = stiff.to_str().unwrap();
    // the lengths are allowed at both poses, and the joint angles at the first only
    for (pose, allowed) in [("home", true), ("0,0,212,0,0,40", false)] {
        let ik = document(&equipod(&["ik", stiff, "--pose", pose, "--json"]));
        let at = document(&equipod(&["at", stiff, "--pose", pose, "--json"]));
        assert_eq!((&ik["within_limits"], &at["allowed"]), (&allowed.into(), &allowed.into()), "{ik}");
        assert!(ik["outside"].is_null(), "{ik}");
    }
}

#[test]
fn angles_of_joints_jacobian_and_margins_stand_beside_the_lengths() {
    let one = document(&equipod(&["ik", LIMITED, "--pose", "5,0,212,0,4,0", "--json"]));
    let joints = &one["joints"];
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        value.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let cone_angle = numbers(&joints["base_cone_angle_deg"]);
    let margin = |name: &str| {
        let rows = one["margins"].as_array().unwrap();
        rows.iter().find(|m| m["name"] == name).unwrap_or_else(|| panic!("{name}: {one}")).clone()
    };
    // the preset allows 35 degrees
    let most = cone_angle.iter().copied().fold(0.0, f64::max);
    assert!((margin("base_cone_angle")["margin"].as_f64().unwrap() - (35.0 - most)).abs() < 1e-9);
    let leg = margin("base_cone_angle")["legs"][0].as_u64().unwrap() as usize;
    assert!((cone_angle[leg - 1] - most).abs() < 1e-12);
    for leg in 0..6 {
        let pair = numbers(&joints["base_universal_deg"][leg]);
        let cosine = pair[0].to_radians().cos() * pair[1].to_radians().cos();
        assert!((cone_angle[leg].to_radians().cos() - cosine).abs() < 1e-12);
    }
    // a row of the Jacobian is the derivative of a length
    let moved = document(&equipod(&["ik", LIMITED, "--pose", "5.0001,0,212,0,4,0", "--json"]));
    for leg in 0..6 {
        let change = numbers(&moved["lengths"])[leg] - numbers(&one["lengths"])[leg];
        assert!((change / 1e-4 - numbers(&one["J"][leg])[0]).abs() < 1e-5);
    }
    assert!(one["inverse_condition"].as_f64().unwrap() > 0.0);
    let home = document(&equipod(&["ik", LIMITED, "--json"]));
    assert!(numbers(&home["joints"]["platform_cone_angle_deg"]).iter().all(|x| x.abs() < 1e-6));
    let rows = table(&["ik", LIMITED, "--pose", "home", "--pose", "5,0,212,0,4,0", "--details"]);
    let column = column(&rows, "margin_base_cone_angle_deg");
    assert!((column[1].parse::<f64>().unwrap() - (35.0 - most)).abs() < 1e-9);
}

#[test]
fn poses_become_lengths_and_lengths_the_poses_again_with_their_times() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_string();
    let (poses, lengths, back) = (path("poses.csv"), path("lengths.csv"), path("back.csv"));
    // as a spreadsheet of another country writes it
    std::fs::write(&poses, "Zeit;x;y;z;roll;pitch;yaw\r\n0;0;0;350;0;0;0\r\n0,5;10;-5;355;2;-3;4,25\r\n")
        .unwrap();
    let rows = table(&["ik", DESIGN, &poses]);
    assert_eq!(column(&rows, "Zeit"), ["0.0", "0.5"]);
    let text: String = rows.iter().map(|row| row.join(",") + "\n").collect();
    std::fs::write(&lengths, text).unwrap();
    let found = table(&["fk", DESIGN, "--lengths", &lengths, "--csv"]);
    assert_eq!(found[0][..5], ["row", "Zeit", "pose", "nearest_home", "mode"].map(String::from));
    let nearest: Vec<&Vec<String>> = found.iter().filter(|row| row[3] == "true").collect();
    assert_eq!(nearest.len(), 2, "one for each row");
    assert_eq!((nearest[1][0].as_str(), nearest[1][1].as_str()), ("2", "0.5"));
    assert_eq!(nearest[1][4], "above");
    let value = |row: &[String], name: &str| -> f64 {
        row[found[0].iter().position(|n| n == name).unwrap()].parse().unwrap()
    };
    for (name, meant) in [
        ("x_mm", 10.0),
        ("y_mm", -5.0),
        ("z_mm", 355.0),
        ("roll_deg", 2.0),
        ("pitch_deg", -3.0),
        ("yaw_deg", 4.25),
    ] {
        assert!((value(nearest[1], name) - meant).abs() < 1e-6, "{name}: {}", value(nearest[1], name));
    }
    assert!(column(&found, "mode").contains(&"below"), "the mirror images under the base are told apart");
    // the table of poses is read as it was written
    let text: String = [&found[0], nearest[0], nearest[1]].iter().map(|row| row.join(",") + "\n").collect();
    std::fs::write(&back, text).unwrap();
    let again = table(&["ik", DESIGN, &back]);
    assert_eq!(column(&again, "Zeit"), ["0.0", "0.5"]);
    let (a, b): (f64, f64) = (again[2][3].parse().unwrap(), rows[2][3].parse().unwrap());
    assert!((a - b).abs() < 1e-9);
}

/// The real positions of all poses of a JSON answer, in the order of their numbers.
fn positions(doc: &serde_json::Value) -> Vec<[f64; 3]> {
    let list = |name: &str| doc[name].as_array().into_iter().flatten().collect::<Vec<_>>();
    let all = list("solutions").into_iter().chain(list("witness_points"));
    all.map(|s| [0, 1, 2].map(|i| s["p"]["re"][i].as_f64().unwrap())).collect()
}

#[test]
fn one_number_names_a_pose_in_the_text_in_the_table_and_in_json() {
    // the second design has a self-motion, whose points are numbered too
    for (design, real_column) in
        [("designs/rbt-octahedral.toml", "x_mm"), ("designs/rbt-midline.toml", "px_mm")]
    {
        let meant = positions(&document(&equipod(&["fk", design, "--json"])));
        let rows = table(&["fk", design, "--csv", "--all"]);
        let numbers: Vec<usize> = column(&rows, "pose").iter().map(|n| n.parse().unwrap()).collect();
        let mut sorted = numbers.clone();
        sorted.sort_unstable();
        assert_eq!(sorted, (1..=meant.len()).collect::<Vec<_>>(), "{design}: every pose has one number");
        for (number, x) in numbers.iter().zip(column(&rows, real_column)) {
            assert!(x.is_empty() || x.parse() == Ok(meant[number - 1][0]), "{design}: row of pose {number}");
        }
        let text = String::from_utf8(equipod(&["fk", design, "--digits", "15"]).stdout).unwrap();
        let lines = text.lines().skip_while(|line| !line.starts_with("pose ")).skip(1);
        let lines = lines.map_while(|line| {
            let mut words = line.split_whitespace();
            Some((words.next()?.parse::<usize>().ok()?, words.next()?.parse::<f64>().ok()?))
        });
        let lines: Vec<(usize, f64)> = lines.collect();
        assert!(!lines.is_empty(), "{text}");
        for (number, x) in lines {
            assert!((x - meant[number - 1][0]).abs() < 1e-9, "{design}: line of pose {number}");
        }
    }
    // the order from home on is another one than the numbers
    let rows = table(&["fk", "designs/rbt-octahedral.toml", "--csv"]);
    let (first, nearest) = (column(&rows, "pose")[0], column(&rows, "nearest_home")[0]);
    assert_eq!(nearest, "true");
    assert_ne!(first, "1");
}

#[test]
fn complex_poses_are_rows_on_demand_and_json_has_real_numbers() {
    let octahedral = "designs/rbt-octahedral.toml";
    let doc = document(&equipod(&["fk", octahedral, "--json"]));
    let real = doc["real_count"].as_u64().unwrap() as usize;
    let all = doc["finite_count"].as_u64().unwrap() as usize;
    assert_eq!(table(&["fk", octahedral, "--csv"]).len(), 1 + real);
    let rows = table(&["fk", octahedral, "--csv", "--all"]);
    assert_eq!(rows.len(), 1 + all);
    assert_eq!(column(&rows, "real").iter().filter(|word| **word == "false").count(), all - real);
    let solutions = doc["solutions"].as_array().unwrap();
    let poses: Vec<_> = solutions.iter().filter_map(|s| s.get("real_pose")).collect();
    assert_eq!(poses.len(), real);
    assert_eq!(poses.iter().filter(|p| p["nearest_home"] == true).count(), 1);
    for (pose, solution) in poses.iter().zip(solutions) {
        assert_eq!(pose["position"], solution["p"]["re"]);
        assert_eq!(pose["rpy_deg"].as_array().unwrap().len(), 3);
    }
}
