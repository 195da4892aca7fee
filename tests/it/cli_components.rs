//! The process `equipod equivalents components`.

use equipod::prelude::{Design, Manipulator};
use serde_json::Value;

use super::cli_frame::{document, equipod};

fn of(design: &str, more: &[&str]) -> Value {
    let path = format!("designs/{design}.toml");
    let mut args = vec!["equivalents", "components", path.as_str(), "--json"];
    args.extend(more);
    let out = equipod(&args);
    assert_eq!(out.status.code(), Some(0), "{design}: {}", String::from_utf8_lossy(&out.stderr));
    document(&out)
}

fn types(doc: &Value) -> Vec<&str> {
    doc["components"].as_array().unwrap().iter().map(|c| c["type"].as_str().unwrap()).collect()
}

#[test]
fn the_octahedral_platform_has_the_six_sides_of_the_hexagon() {
    let doc = of("rbt-octahedral", &["--samples", "3"]);
    assert_eq!(types(&doc), ["point-line"; 6]);
    assert_eq!(
        (doc["count"].as_u64(), doc["complete"].as_bool(), doc["leg_rank"].as_u64()),
        (Some(6), Some(true), Some(6))
    );
    for family in doc["components"].as_array().unwrap() {
        assert_eq!(family["exact"], true);
        assert_eq!(family["legs"], family["support"]);
        for s in family["samples"].as_array().unwrap() {
            let used =
                s["coefficients"].as_array().unwrap().iter().filter(|c| c.as_f64().unwrap().abs() > 1e-9);
            assert!(used.count() <= 2 && s["residual"].as_f64().unwrap() < 1e-14, "{s}");
        }
    }
    // both cubics are the product of the three edges, and at the corners a whole line corresponds
    for body in ["base", "platform"] {
        let curve = &doc["planes"][0][body];
        let kinds: Vec<&str> =
            curve["parts"].as_array().unwrap().iter().map(|p| p["kind"].as_str().unwrap()).collect();
        assert_eq!(kinds, ["line"; 3]);
        let corners = curve["singular_points"].as_array().unwrap();
        assert_eq!(corners.len(), 3);
        assert!(corners.iter().all(|s| s["kind"] == "crossing" && s["line_of_partners"] == true));
    }
    // a family is the move of the paper: t = 0 and t = 1 are its two legs, 0.2 a fifth of the edge
    let slide = &doc["components"][3]["parametrisation"]["base"];
    assert_eq!(slide[0]["coefficient"], serde_json::json!([1.0, 0.0, 0.0, 0.0]));
    assert_eq!(slide[1]["coefficient"], serde_json::json!([0.0, 6.0, 10.392304845413264, 0.0]));
}

#[test]
fn every_shipped_design() {
    for (design, expected) in [
        ("general-6-6", vec![]),
        ("dietmaier", vec![]),
        ("lee-shim", vec![]),
        ("innocenti-6-4", vec!["point-line"; 2]),
        ("symmetric-hexapod", vec!["plane-plane"]),
    ] {
        let doc = of(design, &["--samples", "2"]);
        assert_eq!(types(&doc), expected, "{design}");
    }
    // curves are split over the fractions: of exact joints with square roots nothing is said about their doubles
    let doc = of("symmetric-hexapod", &[]);
    assert_eq!(doc["planes"][0]["smooth"], Value::Null);
    assert!(doc["planes"][0]["base"]["exact"]["reason"].as_str().unwrap().contains("square roots"), "{doc}");
    // as plain numbers the hexapod has a cubic that is smooth, which is proved
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plain.toml");
    let hexapod = Design::load("designs/symmetric-hexapod.toml").unwrap();
    let plain = Manipulator::from_legs(hexapod.manipulator().legs()).unwrap();
    std::fs::write(&path, Design::new("plain", &hexapod.units, plain).to_toml()).unwrap();
    let doc = document(&equipod(&["equivalents", "components", path.to_str().unwrap(), "--json"]));
    assert_eq!(doc["planes"][0]["smooth"], true);
    assert_eq!(doc["planes"][0]["base"]["parts"][0]["kind"], "cubic");
    // ten integers, in x and y of the body, that vanish at the joints
    let exact = &doc["planes"][0]["base"]["exact"];
    assert_eq!((exact["axes"].as_array().unwrap().len(), exact["degree"].as_u64()), (2, Some(3)));
    let integer = |c: &Value| c.as_str().unwrap().trim_start_matches('-').chars().all(|d| d.is_ascii_digit());
    assert!(exact["coefficients"].as_array().unwrap().iter().all(integer));
    assert_eq!(exact["parts"][0]["kind"], "cubic");
    // the platform without shared joints has the six sides again, exactly, since its joints are on the edges by
    // construction
    let doc = of("rbt-griffis-duffy", &[]);
    let lines = doc["components"].as_array().unwrap();
    assert!(
        lines.len() == 6 && lines.iter().all(|c| c["type"] == "point-line" && c["exact"] == true),
        "{doc}"
    );
}

#[test]
fn one_family_and_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("curves.svg");
    let more = ["--family", "1", "--samples", "2", "--svg", svg.to_str().unwrap()];
    let doc = of("symmetric-hexapod", &more);
    assert_eq!(
        (doc["components"].as_array().unwrap().len(), doc["components"][0]["component"].as_u64()),
        (1, Some(1))
    );
    assert_eq!(doc, of("symmetric-hexapod", &more), "the same seed, the same legs");
    let picture = std::fs::read_to_string(svg).unwrap();
    assert!(picture.starts_with("<svg") && picture.matches("class=\"mark\"").count() == 12);
    assert_eq!(picture.matches("class=\"hollow\"").count(), 16);
    let pair = doc["planes"][0]["pair"].to_string();
    let one = folder.path().join("one.svg");
    of("symmetric-hexapod", &["--svg", one.to_str().unwrap(), "--pair", &pair]);
    assert!(std::fs::read_to_string(one).unwrap().contains(&format!("base plane of pair {pair}")));
    let out = equipod(&[
        "equivalents",
        "components",
        "designs/symmetric-hexapod.toml",
        "--json",
        "--svg",
        "x.svg",
        "--pair",
        "99",
    ]);
    assert_eq!(document(&out)["error"]["code"], "components::no_planes");
    let out = equipod(&["equivalents", "components", "designs/dietmaier.toml", "--json", "--svg", "x.svg"]);
    assert_eq!(document(&out)["error"]["code"], "components::no_planes");
    let out = equipod(&["equivalents", "components", "designs/dietmaier.toml", "--json", "--family", "1"]);
    assert_eq!(document(&out)["error"]["code"], "components::no_such_family");
    let out =
        equipod(&["equivalents", "components", "designs/dietmaier.toml", "--json", "--tolerance", "0.5"]);
    assert_eq!(
        (out.status.code(), document(&out)["error"]["code"].as_str()),
        (Some(2), Some("components::bad_tolerance"))
    );
}
