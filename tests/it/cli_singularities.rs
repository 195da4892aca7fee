//! The processes `equipod selfmotion` and `equipod singularities`.

use super::cli_frame::{document, equipod};

#[test]
fn the_midline_platform_moves_on_two_closed_curves() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (csv, svg) = (file("m.csv"), file("m.svg"));
    let out = equipod(&["selfmotion", "designs/rbt-midline.toml", "--csv", &csv, "--svg", &svg, "--json"]);
    let doc = document(&out);
    assert_eq!(out.status.code(), Some(0), "{doc}");
    assert_eq!(doc["dimension"], 1);
    assert!(doc["worst_length_error"].as_f64().unwrap() < 1e-12);
    let curves = doc["curves"].as_array().unwrap();
    assert!(curves.iter().all(|c| c["end"] == "closed"));
    let degrees: Vec<u64> = curves.iter().map(|c| c["degree"]["degree"].as_u64().unwrap()).collect();
    assert_eq!(degrees, [4, 24]);
    let points: usize = curves.iter().map(|c| c["points"].as_array().unwrap().len()).sum();
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), points + 1);
    assert!(std::fs::read_to_string(svg).unwrap().contains("<animate "));
}

#[test]
fn a_regular_platform_has_no_self_motion() {
    let out = equipod(&["selfmotion", "designs/rbt-octahedral.toml", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["dimension"].as_u64()), (Some(1), Some(0)));
    let out = equipod(&["selfmotion", "designs/rbt-octahedral.toml", "--pose", "1,2", "--json"]);
    assert_eq!(document(&out)["error"]["code"], "selfmotion::bad_pose");
}

#[test]
fn equivalent_platforms_have_the_same_regular_box() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("s.svg");
    let run = |design: &str| {
        let pose = "0,0,9,0,0,25";
        let shape = "2,2,2,10,10,10";
        let args = ["singularities", design, "--pose", pose, "--box", shape, "--regions", "4000", "--json"];
        let out = equipod(&[&args[..], &["--svg", svg.to_str().unwrap()]].concat());
        let doc = document(&out);
        assert_eq!(out.status.code(), Some(0), "{doc}");
        let bounds = (
            doc["box"]["proved_scale"].as_f64().unwrap(),
            doc["box"]["singular_within"]["scale"].as_f64().unwrap(),
        );
        (doc, bounds)
    };
    let (octahedral, one) = run("designs/rbt-octahedral.toml");
    let (_, two) = run("designs/rbt-griffis-duffy.toml");
    assert!(one.0 > 0.0 && one.0 < one.1 && two.0 < two.1);
    // what is proved of one holds for the other
    assert!(one.0 < two.1 && two.0 < one.1, "{one:?} {two:?}");
    let modes = octahedral["assembly_modes"].as_array().unwrap();
    assert!(!modes.is_empty());
    for mode in modes {
        let d = mode["determinant"].as_f64().unwrap();
        for p in mode["four_planes"].as_array().unwrap() {
            assert!((p.as_f64().unwrap().abs() - d.abs()).abs() < 1e-9 * d.abs().max(1e-3));
        }
    }
    assert!(std::fs::read_to_string(svg).unwrap().contains("<svg"));
}
