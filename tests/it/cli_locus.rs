//! The process `equipod plot locus`.

use serde_json::Value;

use super::cli_frame::{document, equipod};

const INNOCENTI: [&str; 10] =
    ["plot", "locus", "designs/innocenti-6-4.toml", "--leg", "6", "--from", "4.3", "--to", "4.7", "--json"];

fn values(row: &Value) -> Vec<(f64, f64)> {
    let list = row["values"].as_array().unwrap().iter();
    list.map(|v| (v["re"].as_f64().unwrap(), v["im"].as_f64().unwrap())).collect()
}

#[test]
fn the_values_of_the_second_example_and_its_two_double_values() {
    let folder = tempfile::tempdir().unwrap();
    let [svg, csv] = ["l.svg", "l.csv"].map(|n| folder.path().join(n));
    let files =
        ["--between", "b,e", "--steps", "11", "-o", svg.to_str().unwrap(), "--csv", csv.to_str().unwrap()];
    let out = equipod(&[&INNOCENTI[..], &files].concat());
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let doc = document(&out);
    assert_eq!((&doc["between"], &doc["leg"]), (&serde_json::json!(["b", "e"]), &serde_json::json!(6)));
    let rows = doc["rows"].as_array().unwrap();
    assert_eq!((rows.len(), rows[10]["length"].as_f64()), (11, Some(4.7)));
    let real = |row: &Value| row["values"].as_array().unwrap().iter().filter(|v| v["real"] == true).count();
    // at 4.58, the length of the paper, 10 real poses; before 4.40 and after 4.59 8
    assert_eq!([real(&rows[0]), real(&rows[7]), real(&rows[10])], [8, 10, 8]);
    for row in rows {
        let found = values(row);
        assert_eq!((found.len(), row["status"].as_str()), (32, Some("isolated")));
        assert!(row["values"].as_array().unwrap().iter().all(|v| v["certified"] == true));
        // conjugate poses have conjugate distances
        for v in &found {
            let size = v.0.hypot(v.1).max(1.0);
            assert!(found.iter().any(|w| (v.0 - w.0).hypot(v.1 + w.1) < 1e-9 * size));
        }
    }
    let meetings = doc["meetings"].as_array().unwrap();
    let lengths: Vec<f64> = meetings.iter().map(|m| m["length"].as_f64().unwrap()).collect();
    assert!((lengths[0] - 4.3997).abs() < 1e-3 && (lengths[1] - 4.5921).abs() < 1e-3, "{lengths:?}");
    let table = std::fs::read_to_string(&csv).unwrap();
    assert!(
        table.starts_with("step,length,status,re,im,real,certified\n")
            && table.lines().count() == 1 + 11 * 32
    );
    let picture = std::fs::read_to_string(&svg).unwrap();
    assert!(picture.contains("near the real poses") && picture.matches("class=\"met\"").count() == 1 + 4);
}

#[test]
fn the_distance_is_that_of_the_joints_named() {
    let doc = document(&equipod(&[&INNOCENTI[..], &["--steps", "2"]].concat()));
    let leg = |b: &str, p: &str| doc["between"] == serde_json::json!([b, p]);
    assert!(
        !["ba", "da", "fe", "he", "ji", "lk"].iter().any(|l| leg(&l[..1], &l[1..])),
        "{}",
        doc["between"]
    );
    let doc = document(&equipod(&[&INNOCENTI[..], &["--steps", "2", "--between", "d,k"]].concat()));
    let rows = doc["rows"].as_array().unwrap();
    let lengths = "5.74,3.32,4.58,5.39,4.69,4.3";
    let fk = document(&equipod(&["fk", "designs/innocenti-6-4.toml", "--lengths", lengths, "--json"]));
    let part = |pose: &Value, key: &str, k: &[usize]| {
        let at = |part: &str| k.iter().fold(&pose[key][part], |v, i| &v[*i]).as_f64().unwrap();
        (at("re"), at("im"))
    };
    let (d, k) = ([5.0, 0.0, 1.0], [-4.0, 3.0, 3.0]);
    for (pose, value) in fk["solutions"].as_array().unwrap().iter().zip(values(&rows[0])) {
        let mut sum = (0.0, 0.0);
        for i in 0..3 {
            let mut x = part(pose, "p", &[i]);
            for (j, k) in k.iter().enumerate() {
                let r = part(pose, "R", &[i, j]);
                x = (x.0 + r.0 * k, x.1 + r.1 * k);
            }
            x.0 -= d[i];
            sum = (sum.0 + x.0 * x.0 - x.1 * x.1, sum.1 + 2.0 * x.0 * x.1);
        }
        let size = sum.0.hypot(sum.1).max(1.0);
        assert!((sum.0 - value.0).hypot(sum.1 - value.1) < 1e-8 * size, "{sum:?} {value:?}");
    }
}

#[test]
fn lengths_without_isolated_poses_say_so() {
    // a congruent platform with equal legs moves without restraint
    let design = "name = \"congruent\"\nunits = \"1\"\n\
        legs = [[\"A\",\"a\"],[\"B\",\"b\"],[\"C\",\"c\"],[\"D\",\"d\"],[\"E\",\"e\"],[\"F\",\"f\"]]\n\
        [base]\nA = [1.0,0.0,0.0]\nB = [0.5,0.8,0.0]\nC = [-0.5,0.9,0.0]\nD = [-1.0,0.1,0.0]\nE = [-0.4,-0.9,0.0]\nF = [0.5,-0.7,0.0]\n\
        [platform]\na = [1.0,0.0,0.0]\nb = [0.5,0.8,0.0]\nc = [-0.5,0.9,0.0]\nd = [-1.0,0.1,0.0]\ne = [-0.4,-0.9,0.0]\nf = [0.5,-0.7,0.0]\n";
    let folder = tempfile::tempdir().unwrap();
    let [file, csv] = ["d.toml", "l.csv"].map(|n| folder.path().join(n));
    std::fs::write(&file, design).unwrap();
    let out = equipod(&[
        "plot",
        "locus",
        file.to_str().unwrap(),
        "--lengths",
        "1,1,1,1,1,1",
        "--leg",
        "1",
        "--from",
        "1",
        "--to",
        "1.5",
        "--steps",
        "2",
        "--json",
        "--csv",
        csv.to_str().unwrap(),
    ]);
    let doc = document(&out);
    let status: Vec<&str> = (0..2).map(|k| doc["rows"][k]["status"].as_str().unwrap()).collect();
    assert_eq!(status[0], "positive_dimensional", "{doc}");
    assert!(std::fs::read_to_string(&csv).unwrap().contains("0,1,positive_dimensional"));
}

#[test]
fn what_cannot_be_asked_is_refused() {
    let design = "designs/innocenti-6-4.toml";
    let base = ["plot", "locus", design, "--leg", "6", "--from", "1", "--to", "2", "--json"];
    for (more, code) in [
        (["--between", "b,a"].as_slice(), "locus::is_a_leg"),
        (&["--between", "a,b"], "locus::is_a_leg"),
        (&["--between", "b"], "locus::unknown_joint"),
        (&["--lengths", "1,2,3"], "fk::bad_lengths"),
        (&["--steps", "1"], "usage"),
        (&["--method", "octic"], "fk::not_applicable"),
    ] {
        let out = equipod(&[&base[..], more].concat());
        assert_eq!((out.status.code(), document(&out)["error"]["code"].as_str()), (Some(2), Some(code)));
    }
    let out = equipod(&["plot", "locus", design, "--leg", "6", "--from=-1", "--to", "2", "--json"]);
    assert_eq!(document(&out)["error"]["code"], "locus::bad_lengths");
}
