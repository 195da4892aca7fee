//! The process `equipod equivalents topologies`.

use super::cli_frame::{document, equipod};

#[test]
fn the_document_has_the_fields_of_the_contract() {
    let folder = tempfile::tempdir().unwrap();
    let svg = folder.path().join("all.svg");
    let out =
        equipod(&["equivalents", "topologies", "--members", "1", "--json", "--svg", svg.to_str().unwrap()]);
    assert_eq!(out.status.code(), Some(0));
    let shown = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/theory/topologies.svg");
    let [new, shown] = [svg.as_path(), shown.as_ref()].map(|p| std::fs::read_to_string(p).unwrap());
    assert!(
        new == shown,
        "write the picture of the documentation again: equipod equivalents topologies --svg docs/theory/topologies.svg"
    );
    let doc = document(&out);
    assert_eq!(doc["count"], 34);
    let by = &doc["by_virtual_legs"];
    let sizes = ["0", "1_decoupled", "1_coupled", "2", "3"].map(|k| by[k].as_u64().unwrap());
    assert_eq!(sizes, [10, 7, 13, 3, 1]);
    let list = doc["topologies"].as_array().unwrap();
    assert_eq!(list.len(), 34);
    for (k, t) in list.iter().enumerate() {
        assert_eq!(t["id"], format!("T{:02}", k + 1));
        assert_eq!(t["legs"].as_array().unwrap().len(), 6);
        let joints = t["base_joints"].as_u64().unwrap() + t["platform_joints"].as_u64().unwrap();
        assert_eq!(t["sequence"].as_array().unwrap().len() as u64 + 3, joints);
        assert!(matches!(t["finite_roots"].as_u64(), Some(8 | 16 | 24 | 32 | 40)), "{t}");
        assert_eq!(t["finite_roots_proved"], true, "{t}");
        // thirty topologies have a closure polynomial, whose degree says the same
        let closure =
            if t["virtual_legs"].as_u64() < Some(2) { &t["finite_roots"] } else { &serde_json::Value::Null };
        assert_eq!(&t["closure_degree"], closure, "{t}");
    }
    assert_eq!((list[0]["virtual_legs"].as_u64(), list[2]["decoupled"].as_bool()), (Some(3), Some(true)));
}

#[test]
fn designs_are_recognised_and_written_designs_are_recognised_as_themselves() {
    for (design, id, exchanged) in
        [("rbt-octahedral", "T34", false), ("dietmaier", "T01", false), ("porta-thomas-1", "T03", false)]
    {
        let path = format!("designs/{design}.toml");
        let doc = document(&equipod(&["equivalents", "topologies", &path, "--members", "1", "--json"]));
        assert_eq!(
            (doc["design"]["id"].as_str(), doc["topologies"].as_array().unwrap().len()),
            (Some(id), 1)
        );
        assert_eq!(doc["design"]["exchanged"], exchanged, "{design}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    assert_eq!(
        equipod(&["equivalents", "topologies", "designs/innocenti-6-4.toml", "-o", path]).status.code(),
        Some(0)
    );
    let written = folder.path().join("T04.toml");
    let doc = document(&equipod(&[
        "equivalents",
        "topologies",
        written.to_str().unwrap(),
        "--members",
        "1",
        "--json",
    ]));
    assert_eq!(doc["design"]["id"], "T04");
    let svg = std::fs::read_to_string(folder.path().join("T04.svg")).unwrap();
    assert!(svg.starts_with("<svg") && svg.matches("class=\"leg\"").count() == 6);
    let found = document(&equipod(&["fk", written.to_str().unwrap(), "--json"]));
    assert_eq!((found["finite_count"].as_u64(), found["completeness"].as_str()), (Some(32), Some("proved")));
}

#[test]
fn a_design_that_is_always_singular_has_no_topology() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("four.toml");
    let text = "name = \"four\"\nunits = \"1\"\n\
        legs = [[\"A1\",\"B1\"],[\"A1\",\"B2\"],[\"A1\",\"B3\"],[\"A1\",\"B4\"],[\"A2\",\"B5\"],[\"A3\",\"B6\"]]\n\
        [base]\nA1 = [0.0,0.0,0.0]\nA2 = [1.0,0.0,0.0]\nA3 = [0.0,1.0,0.2]\n\
        [platform]\nB1 = [1.0,0.1,0.0]\nB2 = [0.0,1.0,0.3]\nB3 = [0.5,0.2,1.0]\nB4 = [2.0,1.0,0.1]\nB5 = [0.3,0.3,0.0]\nB6 = [1.0,1.0,1.0]\n";
    std::fs::write(&file, text).unwrap();
    let out = equipod(&["equivalents", "topologies", file.to_str().unwrap(), "--json"]);
    let doc = document(&out);
    assert_eq!(out.status.code(), Some(1), "{doc}");
    assert_eq!(doc["error"]["code"], "topologies::always_singular");
}

#[test]
fn rearrangements_come_with_designs_that_the_map_confirms() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let design = "designs/rbt-octahedral.toml";
    let common = ["equivalents", "topologies", design, "--members", "1", "--json"];
    let plain = document(&equipod(&common));
    let doc = document(&equipod(&[&common[..], &["--rearrangements", "-o", path]].concat()));
    assert_eq!((plain.get("rearrangements"), &plain["topologies"]), (None, &doc["topologies"]));
    let list = doc["rearrangements"].as_array().unwrap();
    assert_eq!(list.len(), 1);
    let line = &list[0];
    assert_eq!((line["id"].as_str(), line["octahedral"].as_bool()), (Some("T34"), Some(true)));
    assert_eq!((line["shared_joints"].as_u64(), line["fewest_shared_joints"].as_u64()), (Some(6), Some(0)));
    assert_eq!(line["fewest"]["legs"].as_array().unwrap().len(), 6);
    assert_eq!(line["families"].as_array().unwrap().len(), 6);
    let file = |name: &str| format!("{path}/T34-plane-plane-{name}.toml");
    for to in ["fewest", "octahedral"] {
        assert_eq!(
            equipod(&["equivalents", "map", &file("member"), &file(to)]).status.code(),
            Some(0),
            "{to}"
        );
    }
}
