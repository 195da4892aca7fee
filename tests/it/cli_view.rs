//! `equipod view` as a process: one file, refusals. `tests/page` tests the page in a browser.

use super::cli_frame::{document, equipod};

#[test]
fn the_page_is_one_file_with_the_core_or_without() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("page.html");
    let out = path.to_str().unwrap();
    let mut sizes = Vec::new();
    for core in [&[][..], &["--core", "none"]] {
        let mut args = vec!["view", "designs/rbt-griffis-duffy.toml", "-o", out, "--json"];
        args.extend(core);
        let output = equipod(&args);
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let doc = document(&output);
        let html = std::fs::read_to_string(&path).unwrap();
        assert_eq!(
            (doc["live"].as_bool(), doc["bytes"].as_u64()),
            (Some(core.is_empty()), Some(html.len() as u64))
        );
        assert!(html.starts_with("<!DOCTYPE html>") && html.trim_end().ends_with("</html>"));
        sizes.push(html.len());
    }
    assert!(sizes[0] > sizes[1] + 100_000 && sizes[0] < 2_700_000, "{sizes:?}");
}

#[test]
fn what_cannot_be_shown_first_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("page.html");
    let refused = |design: &str, more: &[&str]| {
        let mut args = vec!["view", design, "-o", out.to_str().unwrap(), "--json"];
        args.extend(more);
        let output = equipod(&args);
        assert_eq!(output.status.code(), Some(2));
        document(&output)["error"]["code"].as_str().unwrap().to_string()
    };
    let design = "designs/rbt-octahedral.toml";
    assert_eq!(refused(design, &["--offsets", "0.2,0.3"]), "view::bad_offsets");
    assert_eq!(refused(design, &["--pattern", "V12", "--offsets", "0.2"]), "view::bad_pattern");
    assert_eq!(refused("designs/general-6-6.toml", &["--offsets", "0,0,0,0,0,0"]), "view::bad_offsets");
    assert_eq!(refused(design, &["--core", "Cargo.toml"]), "view::bad_core");
    assert_eq!(refused(design, &["--core", "no/such.wasm"]), "file::not_readable");
    assert!(!out.exists());
}

/// Without a design the page begins with an ordinary hexapod.
#[test]
fn without_a_design_the_page_asks_for_one() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("start.html");
    let output = equipod(&["view", "-o", path.to_str().unwrap(), "--json"]);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let doc = document(&output);
    assert_eq!((doc["name"].as_str(), doc["live"].as_bool()), (Some("hexapod"), Some(true)));
    let html = std::fs::read_to_string(&path).unwrap();
    assert!(html.contains("\"begin\":true") && html.contains("base_spread_deg"));
    let refused = equipod(&["view", "--offsets", "0.2,0.2,0.2,0.2,0.2,0.2"]);
    assert_eq!(refused.status.code(), Some(2), "offsets of nothing");
}
