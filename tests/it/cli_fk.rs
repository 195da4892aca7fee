//! `equipod fk`: the sources of the lengths, the refusals, and the fields of the document.

use crate::cli_frame::{document, equipod};

const DESIGN: &str = "designs/rbt-octahedral.toml";

fn refusal(args: &[&str]) -> String {
    let out = equipod(&[&["fk", DESIGN, "--json"], args].concat());
    assert_eq!(out.status.code(), Some(2), "{args:?}");
    document(&out)["error"]["code"].as_str().unwrap().to_string()
}

#[test]
fn lengths_that_are_none_are_refused() {
    for lengths in
        ["1,2,3", "1,2,3,4,5,6,7", "1,2,3,4,5,x", "1,2,3,4,5,inf", "1,2,3,4,5,-6", "7", "1,2,3,4,5,1e200"]
    {
        assert_eq!(refusal(&["--lengths", lengths]), "fk::bad_lengths", "{lengths}");
    }
    assert_eq!(refusal(&["--lengths=-1,2,3,4,5,6"]), "fk::bad_lengths");
    assert_eq!(refusal(&["--lengths", "no-such.csv"]), "file::not_readable");
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.csv");
    std::fs::write(&path, "l1,l2,l3,l4,l5,l6\n1,2,3,4,5,6\n1,2,3,4,5\n").unwrap();
    let out = equipod(&["fk", DESIGN, "--lengths", path.to_str().unwrap(), "--json"]);
    assert!(document(&out)["error"]["message"].as_str().unwrap().contains("line 3: 5 values instead of six"));
}

#[test]
fn a_design_without_lengths_needs_the_option() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bare.toml");
    let text = std::fs::read_to_string(DESIGN).unwrap();
    let bare: Vec<&str> = text.lines().filter(|l| !l.starts_with("lengths")).collect();
    std::fs::write(&path, bare.join("\n")).unwrap();
    let out = equipod(&["fk", path.to_str().unwrap(), "--json"]);
    assert_eq!(document(&out)["error"]["code"], "fk::no_lengths");
}

#[test]
fn unknown_methods_are_usage_errors() {
    assert_eq!(refusal(&["--method", "guess"]), "usage");
}

#[test]
fn every_shipped_design_has_the_poses_its_readme_claims() {
    let table = include_str!("../../designs/README.md");
    let mut checked = 0;
    for row in table.lines().filter(|l| l.starts_with("| `")) {
        let cells: Vec<&str> = row.trim_matches('|').split('|').map(str::trim).collect();
        let file = format!("designs/{}", cells[0].trim_matches('`'));
        let out = equipod(&["fk", &file, "--json"]);
        if cells[3] == "continuum" {
            assert_eq!(out.status.code(), Some(0), "{file}");
            let answer = document(&out);
            assert_eq!(answer["solution_set"], "positive_dimensional", "{file}");
            // it moves within the rounding of its lengths, which as written contradict each other in the last digit
            assert_eq!(
                (&answer["dimension_established"], &answer["finite_count"]),
                (&false.into(), &0.into())
            );
            assert!(!answer["witness_points"].as_array().unwrap().is_empty());
            let other = equipod(&["fk", &file, "--lengths", "18,18,17,16,15,19", "--json"]);
            assert_eq!(other.status.code(), Some(0), "{file}: proved empty");
            let answer = document(&other);
            assert_eq!(
                (&answer["solution_set"], &answer["completeness"]),
                (&"empty".into(), &"proved".into())
            );
            continue;
        }
        let answer = document(&out);
        // special platforms whose joints are rounded have further poses far out as written
        let rounded = ["rbt-griffis-duffy.toml", "symmetric-hexapod.toml"].iter().any(|f| file.ends_with(f));
        let missing = answer["missing_count"].as_u64().unwrap_or(0);
        assert_eq!(out.status.code(), Some(if missing > 0 { 3 } else { 0 }), "{file}");
        assert!(rounded || missing == 0, "{file}: {missing} missing");
        assert_eq!(answer["real_count"].to_string(), cells[4], "{file}");
        let solutions = answer["solutions"].as_array().unwrap();
        assert_eq!(Some(solutions.len() as u64), answer["finite_count"].as_u64());
        // how many of the poses far out are found is not for a table
        let least: usize = cells[3].parse().unwrap();
        let most = if rounded { 40 } else { least };
        assert!((least..=most).contains(&solutions.len()), "{file}: {} poses", solutions.len());
        for s in solutions {
            // rounding in R^T R grows with the square of R, far out
            let numbers = [&s["R"]["re"], &s["R"]["im"]].into_iter().flat_map(|m| m.as_array().unwrap());
            let entries = numbers.flat_map(|row| row.as_array().unwrap()).map(|x| x.as_f64().unwrap().abs());
            let scale = entries.fold(1.0, f64::max);
            assert!(s["residual"].as_f64().unwrap() < 1e-9 * scale * scale, "{file}");
            for key in ["R", "p", "real", "certified", "multiplicity", "condition"] {
                assert!(s.get(key).is_some(), "{file}: {key}");
            }
        }
        checked += 1;
    }
    assert!(checked >= 7);
}

/// The leg equations from the document alone: numbers, frames and leg order have the meaning of the contract.
#[test]
fn real_poses_of_the_document_satisfy_the_leg_equations() {
    let lengths = [19.8, 18.0, 18.0, 17.0, 14.9, 17.8];
    let h = 108_f64.sqrt();
    let base = [[0.0, 0.0], [6.0, h], [6.0, h], [12.0, 0.0], [12.0, 0.0], [0.0, 0.0]];
    let platform = [[0.0, 0.0], [0.0, 0.0], [6.0, 0.0], [6.0, 0.0], [3.0, -h / 2.0], [3.0, -h / 2.0]];
    let answer = document(&equipod(&["fk", DESIGN, "--json", "--lengths", "19.8, 18,18,17,14.9,17.8"]));
    let mut real = 0;
    for s in answer["solutions"].as_array().unwrap().iter().filter(|s| s["real"] == true) {
        for i in 0..6 {
            let mut squared = 0.0;
            for k in 0..3 {
                let r = |j: usize| s["R"]["re"][k][j].as_f64().unwrap();
                let a = if k < 2 { base[i][k] } else { 0.0 };
                let x = r(0) * platform[i][0] + r(1) * platform[i][1] + s["p"]["re"][k].as_f64().unwrap() - a;
                squared += x * x;
            }
            assert!((squared.sqrt() - lengths[i]).abs() < 1e-9, "leg {}", i + 1);
        }
        real += 1;
    }
    assert_eq!(real, 12);
}

#[test]
fn a_csv_file_gives_one_record_a_row_and_the_same_bytes_every_time() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.csv");
    std::fs::write(&path, "l1,l2,l3,l4,l5,l6\n19.8,18,18,17,14.9,17.8\n\n16,16,16,16,16,17\n").unwrap();
    let args =
        ["fk", DESIGN, "--lengths", path.to_str().unwrap(), "--json", "--method", "homotopy", "--seed", "5"];
    let (first, second) = (equipod(&args), equipod(&args));
    assert_eq!(first.stdout, second.stdout);
    let answer = document(&first);
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!((rows.len(), &rows[0]["line"], &rows[1]["line"]), (2, &2.into(), &4.into()));
    assert_eq!((&rows[0]["finite_count"], &rows[0]["method"]), (&16.into(), &"homotopy".into()));
    // prepared for several rows: a path for each pair of mirror images
    assert_eq!((&answer["provenance"]["seed"], rows[0]["paths"].as_array().unwrap().len()), (&5.into(), 8));
    let text = equipod(&args[..4]);
    assert_eq!(String::from_utf8(text.stdout).unwrap().lines().count(), 3);
}

#[test]
fn the_octic_refuses_a_general_design() {
    let out = equipod(&["fk", "designs/dietmaier.toml", "--method", "octic", "--json"]);
    assert_eq!(
        (out.status.code(), &document(&out)["error"]["code"]),
        (Some(2), &"fk::not_applicable".into())
    );
}

#[test]
fn rows_of_a_file_give_the_same_bytes_for_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.csv");
    let row = |k: u32| {
        let d = 0.03 * f64::from(k);
        format!("{},{},18,17,{},17.8\n", 19.8 - d, 18.0 + d, 14.9 + 0.5 * d)
    };
    let text: String = (0..30).map(row).collect();
    std::fs::write(&path, text).unwrap();
    let answer = |threads: &str, format: &[&str]| {
        let file = path.to_str().unwrap();
        equipod(&[&["fk", DESIGN, "--lengths", file, "--threads", threads], format].concat()).stdout
    };
    for format in [&["--json"][..], &[]] {
        let one = answer("1", format);
        assert!(!one.is_empty());
        assert_eq!(one, answer("2", format));
        assert_eq!(one, answer("5", format));
    }
    let out = equipod(&["fk", DESIGN, "--lengths", path.to_str().unwrap(), "--json"]);
    assert_eq!(document(&out)["rows"].as_array().unwrap().len(), 30);
    std::fs::write(&path, "").unwrap();
    assert_eq!(refusal(&["--lengths", path.to_str().unwrap()]), "fk::bad_lengths");
    assert_eq!(refusal(&["--threads", "0"]), "usage");
}

#[test]
fn a_row_that_cannot_be_solved_leaves_the_others_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lengths.csv");
    std::fs::write(&path, "18,18,17,16,15,19\n18,18.1,17,16,15,19\n").unwrap();
    let general = "designs/general-6-6.toml";
    let args =
        ["fk", general, "--lengths", path.to_str().unwrap(), "--method", "octic", "--threads", "2", "--json"];
    let out = equipod(&args);
    let answer = document(&out);
    let rows = answer["rows"].as_array().unwrap();
    assert_eq!(rows.len(), 2);
    assert!(rows.iter().all(|r| r["error"]["code"] == "fk::not_applicable"), "every row says so itself");
}

#[test]
fn the_template_says_what_its_library_computed() {
    let answer =
        |method: &str| document(&equipod(&["fk", "designs/lee-shim.toml", "--method", method, "--json"]));
    let calls = answer("template")["library_calls"].clone();
    let call =
        |k: usize| (calls[k]["library"].clone(), calls[k]["computation"].clone(), calls[k]["size"].clone());
    assert_eq!(call(0), ("faer".into(), "plu".into(), vec![293, 362].into()));
    assert_eq!(call(1), ("faer".into(), "qz".into(), vec![69, 69].into()));
    assert!(answer("sylvester").get("library_calls").is_none());
}

/// Both methods enclose one polynomial, and each real pose is over a real root.
#[test]
fn the_polynomial_of_degree_forty_does_not_depend_on_the_method() {
    let found = |method: &str| {
        let words = ["fk", "designs/lee-shim.toml", "--method", method, "--polynomial"];
        super::cli_frame::asked(&words).1
    };
    let (one, other) = (found("sylvester"), found("homotopy"));
    let bounds = |doc: &serde_json::Value| -> Vec<[f64; 2]> {
        serde_json::from_value(doc["polynomial"]["coefficient_bounds"].clone()).unwrap()
    };
    let (a, b) = (bounds(&one), bounds(&other));
    assert_eq!((a.len(), b.len(), a[40]), (41, 41, [1.0, 1.0]));
    let largest = a.iter().map(|x| x[1].abs()).fold(0.0, f64::max);
    for (x, y) in a.iter().zip(&b) {
        assert!(x[0] <= y[1] && y[0] <= x[1] && x[1] - x[0] < 1e-4 * largest, "{x:?} {y:?}");
    }
    let roots = one["polynomial"]["real_roots"].as_array().unwrap();
    assert_eq!(Some(roots.len() as u64), one["real_count"].as_u64());
    let mirrored = super::cli_frame::asked(&["fk", "designs/rbt-octahedral.toml", "--polynomial"]).1;
    assert!(mirrored["polynomial"]["error"].as_str().unwrap().contains("mirror images"));
}
