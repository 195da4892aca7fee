//! The page as a whole.

use super::{Report, ReportFile, html};
use ask::AtPoseOptions;
use files::design::Format;
use platform::geom::PoseConvention;
use records::{AtPoseAnswer, CheckAnswer, Document, FkAnswer, ProvenanceRecord, SolvedRecord};
use sheet::{Sheet, answers, shown};

fn file(name: &str, text: &str) -> ReportFile {
    ReportFile { name: name.into(), bytes: text.as_bytes().to_vec() }
}

const DESIGN: &str = include_str!("../../../designs/rbt-octahedral.toml");
const MIDLINE: &str = include_str!("../../../designs/rbt-midline.toml");

fn report(files: Vec<ReportFile>) -> String {
    html(&Report { title: "A <test>".into(), files, comparison: None, view: None })
}

#[test]
fn verdicts_stand_at_the_top_with_sign_and_word() {
    let text = report(vec![
        file("original.toml", DESIGN),
        file(
            "verify.json",
            r#"{"schema_version":1,"provenance":{"version":"0.1.0","seed":7,"designs":[],"files":[]},"verdict":"not_equivalent","explanation":"a pose tells them apart",
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
fn the_answer_of_check_is_a_verdict() {
    let told = |answer: &str| {
        let text = format!(
            r#"{{"schema_version":1,"architecturally_singular":{answer},"singular_as_written":false,"explanation":"why"}}"#
        );
        report(vec![file("check.json", &text)]).split("id=\"inputs\"").next().unwrap().to_string()
    };
    assert!(
        told("false").contains(
            "<strong class=\"yes\"><span aria-hidden=\"true\">\u{2713}</span> regular</strong>: why"
        )
    );
    assert!(told("true").contains(
        "<strong class=\"no\"><span aria-hidden=\"true\">\u{2717}</span> architecturally singular</strong>"
    ));
    let undecided = told("null");
    assert!(undecided.contains("undecided") && !undecided.contains("class=\"yes\""));
}

#[test]
fn a_saved_answer_of_check_is_shown_as_its_command_prints_it() {
    for (design, told) in [
        (DESIGN, "Generic leg lengths have 16 poses, real and complex"),
        (MIDLINE, "The lengths of the design can be assembled, and at almost every pose"),
    ] {
        let (design, _) = ask::design::parse(design, Format::Toml).unwrap();
        let answer = CheckAnswer::from(&design.check().unwrap());
        let saved =
            serde_json::to_string(&Document::new(&answer, ProvenanceRecord::default(), vec![])).unwrap();
        let read: CheckAnswer = serde_json::from_str(&saved).unwrap();
        let fields = |answer: &CheckAnswer| serde_json::to_value(answer).unwrap();
        assert_eq!(fields(&read), fields(&answer), "nothing is lost on the way");
        let text = report(vec![file("check.json", &saved)]);
        let result = text.split("id=\"results\"").nth(1).unwrap();
        assert!(result.contains(&answer.headline) && result.contains(told), "{result}");
        assert!(
            result.contains("<details><summary>Details</summary>")
                && result.contains("rank of the leg vectors")
        );
    }
}

/// The report of a folder with this answer.
fn saved(answer: &impl serde::Serialize) -> String {
    let document = Document::new(answer, ProvenanceRecord::default(), vec![]);
    report(vec![file("a.json", &serde_json::to_string(&document).unwrap())])
}

/// Fields that no sheet shows are read over: certificates, paths and rejected candidates of forward kinematics.
#[test]
fn saved_poses_are_shown_as_their_commands_print_them() {
    let (design, _) = ask::design::parse(DESIGN, Format::Toml).unwrap();
    let frames = design.pose_frames(PoseConvention::default());
    let is_shown = |text: &str, sheet: &Sheet| text.contains(&shown(&sheet.html()));

    let found = design.fk(design.ik(&frames.home).unwrap()).unwrap();
    let solved = SolvedRecord::from(&found).with_real_poses(design.manipulator(), &frames);
    let poses = FkAnswer::One(Box::new(solved.into())).with_frames(&frames, &design.units);
    let sheet = answers::fk("the design", &design.units, &poses);
    assert!(sheet.to_string().contains("nearest to home"), "{sheet}");
    assert!(is_shown(&saved(&poses), &sheet));

    let asked = AtPoseOptions::at(frames.home).wrench([0.0, 0.0, -10.0, 0.0, 0.0, 0.0]).leg(1);
    let found = design.at_pose(&frames, &asked).unwrap();
    let at = AtPoseAnswer::new(&design, &frames, (&asked, 1.0), &found);
    assert!(is_shown(&saved(&at), &answers::at_pose(&at)));
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
        comparison: None,
        view: Some("<!doctype html><script>let a = \"b\" && 1</script>".into()),
    });
    assert!(!text.contains("<script") && !text.contains("</td>\"") && !text.contains("<b>"));
    assert!(text.contains("srcdoc=\"&lt;!doctype html&gt;&lt;script&gt;let a = &quot;b&quot; &amp;&amp; 1"));
    assert!(text.contains("alt=\"c\"") && text.contains("<figcaption>a &amp; b ("));
    // unreadable files are listed too
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

/// Pieces of attacks; texts are drawn from them in any order.
const PIECES: [&str; 16] = [
    "<script>alert(1)</script>",
    "</title><img src=x onerror=alert(1)>",
    "\" onload=\"alert(1)",
    "' onmouseover='alert(1)",
    "]]>",
    "-->",
    "<svg onload=alert(1)>",
    "&lt;script&gt;alert(1)&lt;/script&gt;",
    "&amp;lt;img src=x onerror=alert(1)&amp;gt;",
    "</style><style>*{background:url(http://x.invalid)}</style>",
    "javascript:alert(1)",
    "<iframe srcdoc='&lt;script&gt;alert(1)&lt;/script&gt;'>",
    "\u{0}\u{1b}[2J",
    "</pre></details>",
    "&#60;script&#62;",
    "name",
];

/// Tags with their attributes; the text between them is ignored. For a browser a tag begins with `<` and a letter, `/`,
/// `!` or `?`.
fn tags(html: &str) -> Vec<(String, Vec<(String, String)>)> {
    let mut out = Vec::new();
    let mut rest = html;
    while let Some(at) = rest.find('<') {
        rest = &rest[at + 1..];
        let name: String = rest.chars().take_while(|c| !c.is_whitespace() && *c != '>').collect();
        rest = &rest[name.len()..];
        let mut attributes = Vec::new();
        loop {
            rest = rest.trim_start();
            let key: String =
                rest.chars().take_while(|c| !c.is_whitespace() && !matches!(c, '>' | '=')).collect();
            rest = &rest[key.len()..];
            if let Some(value) = rest.strip_prefix("=\"") {
                let (inside, after) = value.split_once('"').unwrap();
                attributes.push((key, inside.to_owned()));
                rest = after;
            } else if rest.starts_with('>') || rest.is_empty() {
                if !key.is_empty() {
                    attributes.push((key, String::new()));
                }
                break;
            } else {
                attributes.push((key, "?".into()));
                rest = rest.strip_prefix('=').unwrap_or(rest);
            }
        }
        if name == "style" {
            rest = rest.split_once("</style>").unwrap().1;
        }
        out.push((name, attributes));
    }
    out
}

/// Checks that the page holds only its own tags and attributes, links within it and to the files beside it, and
/// pictures as data.
fn only_its_own(html: &str) -> Result<(), String> {
    const TAGS: [&str; 29] = [
        "!DOCTYPE", "html", "head", "meta", "title", "style", "body", "main", "section", "h1", "h2", "h3",
        "p", "ul", "li", "a", "strong", "span", "table", "caption", "thead", "tbody", "tr", "th", "td",
        "div", "details", "summary", "pre",
    ];
    const ATTRIBUTES: [&str; 12] = [
        "lang",
        "charset",
        "name",
        "content",
        "http-equiv",
        "class",
        "id",
        "scope",
        "href",
        "aria-hidden",
        "open",
        "html",
    ];
    for (name, attributes) in tags(html) {
        let name = name.trim_start_matches('/');
        for (key, value) in &attributes {
            let fine = match (name, key.as_str()) {
                ("img", "alt") | ("iframe", "title" | "sandbox" | "srcdoc") => true,
                ("img", "src") => value.starts_with("data:image/svg+xml,%3C"),
                ("a", "href") => {
                    let own = |c: char| c.is_ascii_alphanumeric() || "#-%/".contains(c);
                    value.chars().all(own) && !value.starts_with('/')
                }
                (_, key) => ATTRIBUTES.contains(&key),
            };
            if !fine {
                return Err(format!("<{name} {key}=\"{value}\">"));
            }
        }
        if !TAGS.contains(&name) && !["img", "figure", "figcaption", "iframe"].contains(&name) {
            return Err(format!("<{name}>"));
        }
    }
    Ok(())
}

#[test]
fn foreign_texts_never_become_markup() {
    let mut state = 7_u64;
    let mut draw = |most: u64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from((state >> 33) % most).unwrap()
    };
    for round in 0..60 {
        let mut hostile = || -> String { (0..=draw(4)).map(|_| PIECES[draw(PIECES.len() as u64)]).collect() };
        let svg = format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\"><title id=\"title\">{}</title><desc id=\"desc\">{}</desc>{}</svg>",
            hostile(),
            hostile(),
            hostile()
        );
        let quoted = |text: String| serde_json::Value::String(text).to_string();
        let joint = toml_text(&hostile());
        let design = DESIGN
            .replace("\"P1\"", &joint)
            .replacen("P1 = ", &format!("{joint} = "), 1)
            .replacen("units = \"mm\"", &format!("units = {}", toml_text(&hostile())), 1)
            .replacen("source = ", &format!("source = {} #", toml_text(&hostile())), 1)
            .replacen("description = ", &format!("description = {} #", toml_text(&hostile())), 1)
            .replacen("name = \"octahedral 12-6\"", &format!("name = {}", toml_text(&hostile())), 1);
        let result = format!(
            "{{\"schema_version\":1,\"verdict\":{},\"explanation\":{},\"provenance\":{{\"version\":{},\"seed\":{}}},{}:{},\"list\":[{{{}:{}}}],\"met\":null,\"tolerances\":{{{}:1}}}}",
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile()),
            quoted(hostile())
        );
        let text = html(&Report {
            title: hostile(),
            files: vec![
                file(&format!("{}.svg", hostile()), &svg),
                file(&format!("{}.toml", hostile()), &design),
                file(&format!("{}.json", hostile()), &result),
                file(&hostile(), &hostile()),
            ],
            comparison: None,
            view: Some(hostile()),
        });
        assert!(text.contains("<h2>Designs</h2>") && text.contains("<h2>Results</h2>"), "round {round}");
        only_its_own(&text).unwrap_or_else(|tag| panic!("round {round}: {tag} in\n{text}"));
        assert!(text.contains("default-src 'none'; script-src 'sha256-") && !text.contains("unsafe-inline"));
    }
    // the reader recognises its purpose
    for bad in [
        "<p>a</p><script>",
        "<p onclick=\"x\">",
        "<a href=\"javascript:x\">",
        "<a href=\"//x\">",
        "<img src=\"http://x\">",
        "<p><svg onload=x>",
    ] {
        assert!(only_its_own(bad).is_err(), "{bad}");
    }
}

/// A basic string of TOML.
fn toml_text(text: &str) -> String {
    let escaped: String = text
        .chars()
        .map(|c| match c {
            '"' => "\\\"".to_owned(),
            '\\' => "\\\\".to_owned(),
            c if c.is_control() => format!("\\u{:04x}", u32::from(c)),
            c => c.to_string(),
        })
        .collect();
    format!("\"{escaped}\"")
}

/// An answer of `assess` about a design of this name, with one requirement.
fn assessment(name: &str, role: &str, margin: f64) -> String {
    let (met, status) = if margin < 0.0 { (false, "violated") } else { (true, "met") };
    let pose = r#"{"p":[32.4443,14.3,371.8],"q":[1,0,0,0]}"#;
    format!(
        r#"{{"schema_version":1,"name":"{name}","role":"{role}","met":{met},"explanation":"meets all",
            "workspace":"stated","assessed_poses":{{"stated":true,"region":true,"listed":0,"trajectory":0,"met_in_words":"met"}},"safety_margin_kept":null,
            "requirements":[{{"name":"max_leg_length","margin":{margin},"safety_margin":0,"net_margin":{margin},
            "safety_margin_kept":null,"met":{met},"at_limit":false,"status":"{status}","proved_margin":null,"unit":"mm",
            "between":["leg <1>"],"legs":[1],"pose":{pose}}}],
            "regular":{{"met":true,"status":"proved","pose":null,"cells":1}},"regular_explanation":"No singular pose",
            "conditioning":{{"inverse_condition":0.3359123,"pose":{pose},"characteristic_length":1}},
            "poses":1,"cells":1,"lightest_drive":null,"provenance":{{"version":"0","designs":[{{"name":"mine"}}]}}}}"#
    )
}

/// The margins of another platform once stood under the title of the design, and two tables had the same title.
#[test]
fn every_table_of_requirements_has_the_role_of_its_design() {
    let text = report(vec![
        file("assess.json", &assessment("mine", "design", 1.5)),
        file("nearest-assess.json", &assessment("<b>, nearest", "nearest_equivalent", -25.156_342_1)),
    ]);
    let section = text.split("id=\"requirements\"").nth(1).unwrap().split("</section>").next().unwrap();
    let tables: Vec<&str> = section.split("<h3>").skip(1).collect();
    assert_eq!(tables.len(), 2, "{section}");
    assert!(tables[0].starts_with("Original: mine</h3>") && tables[0].contains(">1.5</td>"));
    for shown in [
        "Equivalent of the nearest octahedral platform: &lt;b&gt;, nearest</h3>",
        "<th scope=\"row\">leg length, maximum</th><td class=\"no\"><span aria-hidden=\"true\">\u{2717}</span> violated</td>",
        "-25.2",
        "leg &lt;1&gt;",
        "32.4,14.3,372,",
        "0.336",
        "<p>No singular pose.</p>",
    ] {
        assert!(tables[1].contains(shown), "{shown}: {section}");
    }
    for role in ["Requirements: Original", "Requirements: Equivalent of the nearest octahedral platform"] {
        assert!(text.contains(role), "{role}");
    }
    // one that carries an assessment has the same table
    let carried = assessment("mine", "design", 1.5);
    let carried = report(vec![file("a.json", &format!(r#"{{"schema_version":1,"assessment":{carried}}}"#))]);
    assert!(carried.contains(tables[0].split("From").next().unwrap()), "{carried}");
    // an answer of an earlier version lacks fields: all fields it has are listed
    let old = assessment("mine", "design", 1.5).replace("\"role\"", "\"rule\"");
    let text = report(vec![file("old.json", &old)]);
    assert!(text.contains("<td>1.5</td>") && !text.contains("Original"), "{text}");
}
