//! The page as a whole.

use super::{Report, ReportFile, html};

fn file(name: &str, text: &str) -> ReportFile {
    ReportFile { name: name.into(), bytes: text.as_bytes().to_vec() }
}

const DESIGN: &str = include_str!("../../designs/rbt-octahedral.toml");

fn report(files: Vec<ReportFile>) -> String {
    html(&Report { title: "A <test>".into(), files, view: None })
}

#[test]
fn verdicts_stand_at_the_top_with_sign_and_word() {
    let text = report(vec![
        file("original.toml", DESIGN),
        file(
            "verify.json",
            r#"{"schema_version":1,"version":"0.1.0","seed":7,"verdict":"not_equivalent","explanation":"a pose tells them apart",
                "map":{"det":0.5,"tolerances":{"residual":1e-9}},"samples":[{"matched":16},{"matched":15}],"warnings":[]}"#,
        ),
        file(
            "fk.json",
            r#"{"schema_version":1,"finite_count":16,"real_count":12,"completeness":"proved","completeness_reason":"16 of 16"}"#,
        ),
    ]);
    let top = text.split("id=\"inputs\"").next().unwrap();
    assert!(top.contains("<strong class=\"no\"><span aria-hidden=\"true\">\u{2717}</span> not equivalent</strong>: a pose tells them apart"));
    assert!(top.contains("<strong class=\"yes\"><span aria-hidden=\"true\">\u{2713}</span> 16 finite poses, 12 real</strong>: 16 of 16"));
    assert!(text.contains("A &lt;test&gt;") && !text.contains("<test>"));
    assert!(text.contains("<td>residual 1e-9</td>") && text.contains("<td>7</td>"));
    // the legs of the design, and no result under a wrong heading
    assert!(text.contains("<td>P1</td><td>") && text.contains("<h3>Equivalence <strong"));
}

#[test]
fn the_hash_is_that_of_the_bytes() {
    // FIPS 180-4, example of one block
    let text = report(vec![file("abc.txt", "abc")]);
    assert!(text.contains("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"));
    assert!(!report(vec![file("abc.txt", "abd")]).contains("ba7816bf"));
}

#[test]
fn files_cannot_break_out_of_their_place() {
    let svg = "<svg xmlns=\"http://www.w3.org/2000/svg\"><title id=\"title\">a &amp; b</title><desc id=\"desc\">c</desc><script>alert(1)</script></svg>";
    let text = html(&Report {
        title: "t".into(),
        files: vec![
            file("x\"><script>.svg", svg),
            file("r.json", r#"{"schema_version":1,"verdict":"<b>","list":[{"a<b":"</td>"}]}"#),
            file("broken.json", "{"),
            file("broken.toml", "legs = ["),
        ],
        view: Some("<!doctype html><script>let a = \"b\" && 1</script>".into()),
    });
    assert!(!text.contains("<script") && !text.contains("</td>\"") && !text.contains("<b>"));
    assert!(text.contains("srcdoc=\"&lt;!doctype html&gt;&lt;script&gt;let a = &quot;b&quot; &amp;&amp; 1"));
    assert!(text.contains("alt=\"c\"") && text.contains("<figcaption>a &amp; b ("));
    // what cannot be read is listed, not dropped
    assert!(text.contains("broken.json") && text.contains("broken.toml"));
}

#[test]
fn long_lists_say_how_much_is_left_out() {
    let list: Vec<String> = (0..30).map(|k| format!(r#"{{"k":{k}}}"#)).collect();
    let text =
        report(vec![file("r.json", &format!(r#"{{"schema_version":1,"list":[{}]}}"#, list.join(",")))]);
    assert!(text.contains("list (30 entries)") && text.contains("6 more in the file"));
    let empty = report(vec![file("r.json", r#"{"schema_version":1,"rejected":[]}"#)]);
    assert!(empty.contains("<th scope=\"row\">rejected</th><td>none</td>"));
}
