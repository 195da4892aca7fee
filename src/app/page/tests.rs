//! The answers of the core to a page.

use serde_json::{Value, json};

use super::{Session, page};
use crate::app::presets::PRESETS;
use ask::Design;
use ask::design::parse;
use files::design::Format;
use machine::requirements::{AssessOptions, assess};
use platform::geom::{Angles, Pose};
use records::AssessAnswer;
use synthesis::{LegMapTolerances, leg_map};

const OCTAHEDRAL: &str = include_str!("../../../designs/rbt-octahedral.toml");
const EQUIVALENT: &str = include_str!("../../../designs/rbt-griffis-duffy.toml");
const MIDLINE: &str = include_str!("../../../designs/rbt-midline.toml");
const GENERAL: &str = include_str!("../../../designs/general-6-6.toml");

fn design(text: &str) -> Design {
    parse(text, Format::Toml).unwrap().0
}

fn session(text: &str) -> Session {
    Session::new(design(text))
}

fn ask(session: &Session, request: &Value) -> Value {
    serde_json::from_str(&session.answer(&request.to_string())).unwrap()
}

fn numbers(v: &Value) -> Vec<f64> {
    v.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
}

fn built(answer: &Value) -> Design {
    design(answer["toml"].as_str().unwrap())
}

/// The designs offered by the page have the leg map it shows, checked by the leg vectors of their joints.
#[test]
fn the_original_of_a_design_without_shared_joints_is_found_with_its_offsets() {
    for text in [EQUIVALENT, MIDLINE] {
        for order in [[0, 1, 2, 3, 4, 5], [3, 0, 5, 2, 4, 1]] {
            let given = design(text);
            let turned = given.manipulator().reordered(order).unwrap();
            let given = Design::new("turned", "mm", turned);
            let session = Session::new(given.clone());
            let start = ask(&session, &json!({"op": "open"}))["start"].clone();
            let original = built(&ask(&session, &json!({"op": "design", "which": "first"})));
            let again = built(&ask(&session, &json!({"op": "design", "which": "second", "chosen": start})));
            let m = |d: &Design| d.manipulator().clone();
            for (a, b) in m(&given).legs().iter().zip(m(&again).legs()) {
                assert!(
                    (a.base - b.base).norm() + (a.platform - b.platform).norm() < 1e-9,
                    "same legs, same order"
                );
            }
            let pose = ask(&session, &json!({"op": "path", "at": 0.3}))["pose"].clone();
            let state = ask(&session, &json!({"op": "state", "pose": pose, "chosen": start}));
            let found = leg_map(&m(&original), &m(&again), LegMapTolerances::default());
            let outcome = found.unwrap();
            assert!((outcome.determinant - state["map"]["det"].as_f64().unwrap()).abs() < 1e-9);
            assert!(state["map"]["error"].as_f64().unwrap() < 1e-12);
        }
    }
}

/// Saved designs keep their constructions: the original has its exact corners, and the joints of the equivalent
/// platform are on its edges.
#[test]
fn saved_designs_keep_constructions() {
    let chosen = json!({"pattern": "S123456", "offsets": [0.25, 0.5, 0.25, 0.5, 0.25, 0.75]});
    for text in [OCTAHEDRAL, EQUIVALENT] {
        let session = session(text);
        let open = |which: &str| ask(&session, &json!({"op": "design", "which": which, "chosen": chosen}));
        for (which, edges) in [("first", 0), ("second", 6)] {
            let answer = open(which);
            let saved = answer["toml"].as_str().unwrap();
            assert!(saved.contains("\"6*sqrt(3)\""), "{which}: {saved}");
            assert_eq!(saved.matches("{ on = [").count(), edges, "{which}: {saved}");
            assert_eq!(built(&answer).exactness().to_string(), "exact numbers of Q(sqrt(3))");
            let (json, _) = parse(answer["json"].as_str().unwrap(), Format::Json).unwrap();
            assert_eq!(json, built(&answer));
        }
    }
}

#[test]
fn lengths_are_those_of_the_pose_and_the_map_holds_on_the_whole_way() {
    let session = session(OCTAHEDRAL);
    let chosen = json!({"pattern": "S123456", "offsets": [0.1, -0.3, 0.45, 1.2, 0.2, 0.7]});
    for k in 0..8 {
        let pose = ask(&session, &json!({"op": "path", "at": f64::from(k) / 8.0}))["pose"].clone();
        let state = ask(&session, &json!({"op": "state", "pose": pose, "chosen": chosen}));
        assert!(state["map"]["error"].as_f64().unwrap() < 1e-12);
        for p in state["platforms"].as_array().unwrap() {
            for (leg, length) in p["legs"].as_array().unwrap().iter().zip(numbers(&p["lengths"])) {
                let end = |body: &str, k: usize| numbers(&p[body][leg[k].as_u64().unwrap() as usize]["at"]);
                let (a, b) = (end("base", 0), end("platform", 1));
                let distance = a.iter().zip(&b).map(|(x, y)| (x - y).powi(2)).sum::<f64>().sqrt();
                assert!((distance - length).abs() < 1e-12 * length);
            }
        }
    }
}

#[test]
fn det_a_vanishes_at_the_marks_and_on_the_line_of_the_plane() {
    let session = session(OCTAHEDRAL);
    let pose = ask(&session, &json!({"op": "open"}))["home"].clone();
    let mut offsets = vec![0.1, 0.3, 0.45, 0.6, 0.2, 0.7];
    let det = |offsets: &[f64]| {
        let chosen = json!({"pattern": "S123456", "offsets": offsets});
        let map = ask(&session, &json!({"op": "state", "pose": pose, "chosen": chosen}))["map"].clone();
        (map["det"].as_f64().unwrap(), map["zeros"].clone())
    };
    let (_, zeros) = det(&offsets);
    offsets[3] = zeros[3].as_f64().unwrap();
    assert!(det(&offsets).0.abs() < 1e-15);
    let chosen = json!({"pattern": "S123456", "offsets": offsets});
    let request =
        json!({"op": "plane", "chosen": chosen, "axes": [1, 4], "range": [-0.5, 1.5], "points": 81});
    let plane = ask(&session, &request);
    let line: Vec<&Value> =
        plane["zero"].as_array().unwrap().iter().flat_map(|l| l.as_array().unwrap()).collect();
    assert!(line.len() > 20, "{line:?}");
    for point in line {
        let at = numbers(point);
        (offsets[1], offsets[4]) = (at[0], at[1]);
        assert!(det(&offsets).0.abs() < 1e-3, "linear interpolation on a grid of 81 points");
    }
}

#[test]
fn modes_of_both_platforms_are_the_same_poses() {
    let session = session(OCTAHEDRAL);
    let start = ask(&session, &json!({"op": "open"}));
    let request = json!({"op": "confirm", "pose": start["home"], "chosen": start["start"]});
    let found = ask(&session, &request);
    assert_eq!((&found["first"]["finite"], &found["second"]["finite"]), (&json!(16), &json!(16)));
    assert!(found["distance"].as_f64().unwrap() < 1e-8);
    let modes = ask(&session, &json!({"op": "modes", "pose": start["home"], "which": "first"}));
    let here = modes["here"].as_u64().unwrap() as usize;
    let shown = numbers(&modes["modes"][here]["pose"]["p"]);
    assert!(shown.iter().zip(numbers(&start["home"]["p"])).all(|(a, b)| (a - b).abs() < 1e-6));
    assert_eq!(modes["proved"], json!(true));
}

#[test]
fn a_singular_platform_moves_and_a_regular_one_does_not() {
    let moving = |text: &str| {
        let session = session(text);
        let start = ask(&session, &json!({"op": "open"}));
        ask(
            &session,
            &json!({"op": "motion", "pose": start["home"], "which": "second", "chosen": start["start"]}),
        )
    };
    let found = moving(MIDLINE);
    assert!(found["dimension"] == json!(1) && found["poses"].as_array().unwrap().len() > 50);
    assert!(found["length_error"].as_f64().unwrap() < 1e-9);
    assert_eq!(moving(EQUIVALENT)["dimension"], json!(0));
}

/// The mark of a violation in the table of requirements.
const VIOLATED: &str = "<td class=\"no\">";

/// Every class begins with a regular platform; if some regular one meets the requirements of the file, so does this
/// one.
#[test]
fn the_first_offsets_meet_the_requirements_at_home() {
    let required = "[hardware]\njoint_diameter = 1.4\nbase_cone_angle_deg = 30.0\n";
    for text in [OCTAHEDRAL.to_string(), format!("{OCTAHEDRAL}\n{required}")] {
        let session = session(&text);
        let open = ask(&session, &json!({"op": "open"}));
        for pattern in open["patterns"].as_array().unwrap() {
            let first = ask(&session, &json!({"op": "start", "pattern": pattern["id"]}));
            let chosen = json!({"pattern": pattern["id"], "offsets": first["offsets"]});
            let state = ask(&session, &json!({"op": "state", "pose": open["home"], "chosen": chosen}));
            assert!(state["map"]["det"].as_f64().unwrap().abs() >= 0.1, "{pattern}: {first}");
            let table = state["requirements"].as_str().unwrap();
            assert!(table.matches("<tr>").count() > 2 && !table.contains(VIOLATED), "{first}: {table}");
        }
        assert_eq!(
            open["start"]["offsets"],
            ask(&session, &json!({"op": "start", "pattern": "S123456"}))["offsets"]
        );
    }
    // more spacing than any platform on these edges has: the best one is chosen, and the page names the violations
    let session = session(&OCTAHEDRAL.replace("min_joint_distance = 1.2", "min_joint_distance = 7.0"));
    let open = ask(&session, &json!({"op": "open"}));
    let state = ask(&session, &json!({"op": "state", "pose": open["home"], "chosen": open["start"]}));
    assert!(state["requirements"].as_str().unwrap().contains(VIOLATED));
}

#[test]
fn joints_exactly_as_far_apart_as_required_are_at_the_limit() {
    let session = session(OCTAHEDRAL);
    let home = ask(&session, &json!({"op": "open"}))["home"].clone();
    let platform = |t: f64| {
        let chosen = json!({"pattern": "S123456", "offsets": [0.3, t, 0.3, t, 0.3, t]});
        let state = ask(&session, &json!({"op": "state", "pose": home, "chosen": chosen}));
        let table = state["requirements"].as_str().unwrap();
        let row = table.split("<tr>").find(|row| row.contains("distance of platform joints")).unwrap();
        (!row.contains(VIOLATED), row.contains("0, at the limit"))
    };
    assert_eq!(platform(0.2), (true, true), "0.2 of an edge of 6 is 1.2");
    assert_eq!(platform(0.2 - 1e-9), (false, false));
    assert_eq!(platform(0.2 + 1e-9), (true, false));
}

/// The answer about the workspace and the margins at the pose shown are one table, with poses to be shown.
#[test]
fn the_table_of_requirements_has_the_workspace_and_the_pose_shown() {
    let session = session(OCTAHEDRAL);
    let open = ask(&session, &json!({"op": "open"}));
    let request = json!({"op": "assess", "which": "second", "chosen": open["start"], "points": 20, "searches": 0, "cells": 0});
    let limits = ask(&session, &request);
    let state = |limits: &Value| {
        let request = json!({"op": "state", "pose": open["home"], "chosen": open["start"], "limits": limits});
        ask(&session, &request)["requirements"].as_str().unwrap().to_owned()
    };
    let rows = limits["requirements"].as_array().unwrap().len();
    let (here, whole) = (state(&Value::Null), state(&limits));
    assert_eq!((here.matches("<tr>").count(), whole.matches("<tr>").count()), (rows + 1, rows + 3));
    assert!(
        here.contains("here, equivalent") && !here.contains("least margin") && !here.contains("data-pose")
    );
    let posed = limits["requirements"].as_array().unwrap().iter().filter(|m| !m["pose"].is_null()).count();
    // the conditioning has a pose as well
    assert!(whole.matches("data-pose").count() > posed && whole.contains("least margin"), "{whole}");
}

#[test]
fn a_general_design_has_no_offsets() {
    let session = session(GENERAL);
    let open = ask(&session, &json!({"op": "open"}));
    assert!(open["kind"] == json!("general") && open["patterns"].is_null() && open["hexagon"].is_null());
    let state = ask(&session, &json!({"op": "state", "pose": open["home"]}));
    assert!(state["platforms"].as_array().unwrap().len() == 1 && state["map"].is_null());
    let chosen = json!({"pattern": "S123456", "offsets": [0.2, 0.2, 0.2, 0.2, 0.2, 0.2]});
    let refused = ask(&session, &json!({"op": "state", "pose": open["home"], "chosen": chosen}));
    assert_eq!(refused["error"]["code"], json!("offsets"));
}

#[test]
fn what_cannot_be_answered_is_said() {
    let session = session(OCTAHEDRAL);
    let code = |request: &Value| ask(&session, request)["error"]["code"].clone();
    assert_eq!(code(&json!({"op": "nothing"})), json!("request"));
    let chosen = |pattern: &str, n: usize| json!({"pattern": pattern, "offsets": vec![0.2; n]});
    assert_eq!(code(&json!({"op": "worst", "chosen": chosen("S123456", 5)})), json!("offsets"));
    assert_eq!(code(&json!({"op": "worst", "chosen": chosen("V1", 0)})), json!("pattern"));
    let plane = |axes: [usize; 2]| json!({"op": "plane", "chosen": chosen("S123456", 6), "axes": axes, "range": [0.0, 1.0], "points": 3});
    assert_eq!(code(&plane([2, 2])), json!("request"));
    assert_eq!(code(&plane([0, 6])), json!("offsets"));
    assert!(Session::open(r#"{"design": "name = 3"}"#).unwrap_err().contains("\"code\":\"design\""));
}

#[test]
fn the_page_opens_the_same_session_and_holds_no_address() {
    let session = session(EQUIVALENT);
    let html = page(&session, Some(b"\0asm"));
    let licences = html.split("<details id=\"licences\"").nth(1).unwrap().split("</details>").next().unwrap();
    assert!(
        licences.contains("nalgebra ")
            && licences.contains("Apache License")
            && licences.contains("&#58;//")
            && !licences.contains("clap ")
    );
    // the XML namespace of pictures is the only address, and no browser follows it
    let html = html.replace("http://www.w3.org/2000/svg", "");
    assert!(!html.contains("{{") && !html.contains("http:") && !html.contains("https:"));
    let data = html.split("id=\"data\">").nth(1).unwrap().split("</script>").next().unwrap();
    let data: Value = serde_json::from_str(data).unwrap();
    let again = Session::open(&data["opening"].to_string()).unwrap();
    let open = json!({"op": "open"}).to_string();
    assert_eq!(again.answer(&open), session.answer(&open));
    assert_eq!(data["recorded"]["open"], ask(&session, &json!({"op": "open"})));
    assert!(data["recorded"]["frames"].as_array().unwrap().iter().all(|f| f["error"].is_null()));
}

#[test]
fn a_name_is_text_and_not_markup() {
    let mut evil = design(OCTAHEDRAL);
    evil.name = "</title></script><script>x</script>&".into();
    let html = page(&Session::new(evil), None);
    assert!(!html.contains("id=\"licences\""), "nothing is compiled in");
    assert!(
        !html.contains("<script>x") && html.contains("&lt;/title&gt;") && html.contains("\\u003c/script>")
    );
}

#[test]
fn a_pose_by_its_angles_and_by_its_quaternion_has_the_lengths_of_its_rotation() {
    let session = session(GENERAL);
    let (position, rpy) = ([0.4, -0.3, 1.9], [12.0, -7.5, 33.0]);
    let six = [position, rpy].concat();
    let placed = ask(&session, &json!({"op": "place", "numbers": six}))["pose"].clone();
    let expected = Pose::new(position, Angles::from_degrees(rpy));
    let state = ask(&session, &json!({"op": "state", "pose": placed}));
    let squares = expected.squared_lengths(design(GENERAL).manipulator()).unwrap();
    let lengths = numbers(&state["platforms"][0]["lengths"]);
    assert!(lengths.iter().zip(squares.lengths().get()).all(|(a, b)| (a - b).abs() < 1e-12 * b));
    assert!(numbers(&state["written"])[3..].iter().zip(rpy).all(|(a, b)| (a - b).abs() < 1e-12));
    let again = ask(&session, &json!({"op": "quaternion", "p": position, "q": expected.quaternion()}));
    let rows = |v: &Value| v["R"].as_array().unwrap().iter().flat_map(numbers).collect::<Vec<_>>();
    assert!(rows(&again["pose"]).iter().zip(rows(&placed)).all(|(a, b)| (a - b).abs() < 1e-15));
    let refused = ask(&session, &json!({"op": "quaternion", "p": position, "q": [1.0, 1.0, 0.0, 0.0]}));
    assert_eq!(refused["error"]["code"], json!("pose"));
}

/// Typed lengths give the pose they come from, as the nearest one to a pose close to it.
#[test]
fn the_nearest_mode_of_given_lengths_is_the_pose_they_come_from() {
    let session = session(OCTAHEDRAL);
    let start = ask(&session, &json!({"op": "open"}));
    let pose = ask(&session, &json!({"op": "path", "at": 0.05}))["pose"].clone();
    let state = ask(&session, &json!({"op": "state", "pose": pose, "chosen": start["start"]}));
    for (which, k) in [("first", 0), ("second", 1)] {
        let request = json!({
            "op": "modes", "pose": start["home"], "lengths": state["platforms"][k]["lengths"],
            "which": which, "chosen": start["start"],
        });
        let modes = ask(&session, &request);
        assert!(modes["here"].is_null(), "no pose was shown with these lengths");
        let found = numbers(&modes["modes"][modes["nearest"].as_u64().unwrap() as usize]["pose"]["p"]);
        assert!(
            found.iter().zip(numbers(&pose["p"])).all(|(a, b)| (a - b).abs() < 1e-6),
            "{which}: {found:?}"
        );
    }
}

#[test]
#[ignore = "evidence"]
fn requirements_over_the_workspace_are_those_of_assess() {
    for text in [OCTAHEDRAL, PRESETS[0].text, GENERAL] {
        let session = session(text);
        let request = json!({"op": "assess", "which": "first", "points": 200, "searches": 1, "cells": 100});
        let answer = ask(&session, &request);
        let options = AssessOptions::new().points(200).searches(1);
        match design(text).assess_with(&options, 100) {
            Ok(found) => {
                let expected = serde_json::to_value(AssessAnswer::new(session.design(), &found)).unwrap();
                assert_eq!(answer, expected);
            }
            Err(_) => assert_eq!(answer["error"]["code"], json!("nothing_required")),
        }
    }
}

#[test]
fn a_data_sheet_is_a_symmetric_hexapod() {
    let session = Session::without_design().unwrap();
    let sheet = |base: f64, platform: f64| {
        let request = json!({
            "op": "sheet", "base_radius": 250.0, "platform_radius": 120.0, "base_spread_deg": base,
            "platform_spread_deg": platform, "height": 220.0, "units": "mm",
        });
        ask(&session, &request)
    };
    for (base, platform, joints) in
        [(30.0, 25.5, [6, 6]), (0.0, 0.0, [3, 3]), (0.0, 10.0, [3, 6]), (10.0, 0.0, [6, 3])]
    {
        let made = design(sheet(base, platform)["toml"].as_str().unwrap());
        let m = made.manipulator();
        assert_eq!([m.base_joints().len(), m.platform_joints().len()], joints);
        let lengths = made.home.unwrap().squared_lengths(m).unwrap().lengths().get();
        // from the base joint to the platform joint next to it
        let turn = (60.0 - f64::midpoint(base, platform)).to_radians();
        let expected = (250.0_f64.powi(2) + 120.0_f64.powi(2) - 2.0 * 250.0 * 120.0 * turn.cos()
            + 220.0_f64.powi(2))
        .sqrt();
        assert!(
            lengths.iter().all(|l| (l - expected).abs() < 1e-9),
            "{base}, {platform}: {lengths:?}, {expected}"
        );
    }
    assert_eq!(sheet(120.0, 0.0)["error"]["code"], json!("sizes"));
    assert_eq!(sheet(-1.0, 0.0)["error"]["code"], json!("sizes"));
    assert_eq!(ask(&session, &json!({"op": "open"}))["kind"], json!("general"));
}

#[test]
fn presets_and_points_are_designs() {
    let session = Session::without_design().unwrap();
    for preset in ask(&session, &json!({"op": "presets"})).as_array().unwrap() {
        let made = ask(&session, &json!({"op": "preset", "name": preset["name"]}));
        let opened = Session::open(&json!({"design": made["toml"], "start": null}).to_string());
        assert!(opened.is_ok(), "{preset}: {opened:?}");
    }
    assert_eq!(ask(&session, &json!({"op": "preset", "name": "none"}))["error"]["code"], json!("preset"));
    let general = design(GENERAL);
    let rows: Vec<String> = general
        .manipulator()
        .legs()
        .iter()
        .map(|l| {
            let cells = l.base.iter().chain(l.platform.iter()).map(|x| format!("{x:?}").replace('.', ","));
            cells.collect::<Vec<_>>().join(";")
        })
        .collect();
    let made = ask(&session, &json!({"op": "points", "text": rows.join("\r\n"), "units": "cm"}));
    let read = built(&made);
    assert_eq!((read.units.as_str(), read.manipulator().legs()), ("cm", general.manipulator().legs()));
    assert!(!made["guesses"].as_array().unwrap().is_empty(), "decimal commas are a guess");
    assert_eq!(
        ask(&session, &json!({"op": "points", "text": "1 2 3", "units": "mm"}))["error"]["code"],
        json!("points")
    );
}

/// The shading over two offsets agrees with `assess` for the platform of each point at the same poses.
#[test]
fn a_platform_is_shaded_where_a_requirement_is_violated_at_a_pose_of_the_workspace() {
    let session = session(OCTAHEDRAL);
    let chosen = ask(&session, &json!({"op": "open"}))["start"].clone();
    let request = json!({
        "op": "feasible", "chosen": chosen, "axes": [1, 3], "range": [-0.5, 1.5], "points": 9, "samples": 30,
    });
    let answer = ask(&session, &request);
    let offsets = numbers(&chosen["offsets"]);
    let shaded = answer["violated"].as_array().unwrap();
    let mut met = 0;
    for (k, shade) in shaded.iter().enumerate() {
        let mut there = offsets.clone();
        for (axis, place) in [(1, k % 9), (3, k / 9)] {
            there[axis] = -0.5 + 0.25 * place as f64;
        }
        let pattern = &chosen["pattern"];
        let request =
            json!({"op": "design", "which": "second", "chosen": {"pattern": pattern, "offsets": there}});
        let saved = ask(&session, &request);
        if !saved["error"].is_null() {
            assert_eq!(shade, &json!("joints coincide"), "{there:?}");
            continue;
        }
        let platform = built(&saved);
        let found = assess(
            platform.manipulator(),
            &platform.requirements(),
            &platform.workspace.space(&platform.home_or_default()),
            &AssessOptions::new().points(30).searches(0),
        );
        assert_eq!(answer["poses"].as_u64().unwrap() as usize, found.poses);
        let bad: Vec<&str> =
            found.margins.iter().filter(|m| !m.standing.is_met()).map(|m| m.term.kind.label()).collect();
        match shade.as_str() {
            Some(kind) => assert!(bad.contains(&kind), "{there:?}: {kind} is not among {bad:?}"),
            None => assert!(bad.is_empty(), "{there:?}: {bad:?}"),
        }
        met += usize::from(bad.is_empty());
    }
    assert!(0 < met && met < shaded.len(), "some of both: {met} of {}", shaded.len());
    let chosen = ask(&Session::new(design(MIDLINE)), &json!({"op": "open"}))["start"].clone();
    let bare = Session::new(Design::new("bare", "mm", design(OCTAHEDRAL).manipulator().clone()));
    let request = json!({"op": "feasible", "chosen": chosen, "axes": [0, 1], "range": [0.0, 1.0], "points": 2, "samples": 1});
    assert_eq!(ask(&bare, &request)["error"]["code"], json!("nothing_required"));
    let twice = json!({"op": "feasible", "chosen": chosen, "axes": [1, 1], "range": [0.0, 1.0], "points": 2, "samples": 1});
    assert_eq!(ask(&session, &twice)["error"]["code"], json!("request"));
}

#[test]
fn det_a_vanishes_on_the_surface_over_three_offsets_and_changes_its_sign_across_it() {
    let session = session(OCTAHEDRAL);
    let home = ask(&session, &json!({"op": "open"}))["home"].clone();
    let offsets = [0.1, 0.3, 0.45, 0.6, 0.2, 0.7];
    let chosen = json!({"pattern": "S123456", "offsets": offsets});
    let request =
        json!({"op": "surface", "chosen": chosen, "axes": [0, 2, 5], "range": [-0.5, 1.5], "points": 17});
    let surface = ask(&session, &request);
    let vertices = surface["vertices"].as_array().unwrap();
    assert!(surface["triangles"].as_array().unwrap().len() > 100);
    let det = |at: &[f64]| {
        let mut there = offsets;
        for (axis, value) in [0, 2, 5].into_iter().zip(at) {
            there[axis] = *value;
        }
        let chosen = json!({"pattern": "S123456", "offsets": there});
        ask(&session, &json!({"op": "state", "pose": home, "chosen": chosen}))["map"]["det"].as_f64().unwrap()
    };
    for v in vertices.iter().step_by(97) {
        let v = numbers(v);
        // affine on the edges of the grid, cubic on the diagonals of its cells
        assert!(det(&v).abs() < 0.02, "{v:?}: {}", det(&v));
        let around = (0..3).flat_map(|k| [-0.1, 0.1].map(|step| (k, step)));
        let signs: Vec<bool> = around
            .map(|(k, step)| {
                let mut beside = v.clone();
                beside[k] += step;
                det(&beside) > 0.0
            })
            .collect();
        assert!(signs.contains(&true) && signs.contains(&false), "{v:?}");
    }
    let two = json!({"op": "surface", "chosen": chosen, "axes": [0, 2, 2], "range": [0.0, 1.0], "points": 5});
    assert_eq!(ask(&session, &two)["error"]["code"], json!("request"));
}

/// Near the surface `det J` is small and has both signs; a singular design is singular everywhere.
#[test]
fn the_surface_of_singular_positions_is_where_the_sign_of_det_j_changes() {
    let session = session(OCTAHEDRAL);
    let home = session.design().home_or_default();
    let request = |pose: &Pose| json!({"op": "locus", "pose": records::PoseRecord::from(pose), "which": "first", "points": 13});
    let (m, l) = (session.design().manipulator(), session.design().characteristic_length());
    let mut seen = 0;
    for yaw in [0.0, 40.0, 70.0, 85.0] {
        let turned = Pose::new(home.position, Angles::from_degrees([15.0, -25.0, yaw]));
        let found = ask(&session, &request(&turned));
        assert_eq!(found["everywhere"], json!(false));
        let det = |p: nalgebra::Vector3<f64>| {
            platform::manipulator::jacobian(m, &Pose { position: p, ..turned }, l).determinant()
        };
        let [low, high] = ["low", "high"].map(|end| numbers(&found["surface"][end]));
        let cell: Vec<f64> = low.iter().zip(&high).map(|(a, b)| (b - a) / 12.0).collect();
        for v in found["surface"]["vertices"].as_array().unwrap() {
            let p = nalgebra::Vector3::from_column_slice(&numbers(v));
            let around = (0..3).flat_map(|k| [-1.0, 1.0].map(|sign| (k, sign * cell[k])));
            let signs: Vec<bool> = around
                .map(|(k, step)| {
                    let mut beside = p;
                    beside[k] += step;
                    det(beside) > 0.0
                })
                .collect();
            assert!(signs.contains(&true) && signs.contains(&false), "yaw {yaw}: {p}");
            seen += 1;
        }
    }
    assert!(seen > 50, "{seen} points of a surface");
    let midline = Session::new(design(MIDLINE));
    let chosen = ask(&midline, &json!({"op": "open"}))["start"].clone();
    let mut everywhere = request(&midline.design().home_or_default());
    (everywhere["which"], everywhere["chosen"]) = (json!("second"), chosen);
    let found = ask(&midline, &everywhere);
    assert!(found["everywhere"] == json!(true) && found["surface"]["triangles"] == json!([]));
}

#[test]
fn cranks_have_both_tips_and_no_questions_about_legs_that_change_their_lengths() {
    let preset = PRESETS.iter().find(|p| p.name == "reachy-mini").unwrap();
    let session = Session::open(&json!({"design": preset.text, "start": null}).to_string()).unwrap();
    let open = ask(&session, &json!({"op": "open"}));
    assert_eq!(
        (&open["kind"], &open["singular"], &open["patterns"]),
        (&json!("cranks"), &json!(null), &json!(null))
    );
    assert_eq!(open["angles_deg"].as_array().unwrap().len(), 6);
    let state = ask(&session, &json!({"op": "state", "pose": open["home"], "chosen": null}));
    let platform = &state["platforms"][0];
    let point = |v: &Value| -> Vec<f64> { serde_json::from_value(v.clone()).unwrap() };
    let apart = |a: &[f64], b: &[f64]| {
        let square: f64 = a.iter().zip(b).map(|(x, y)| (x - y).powi(2)).sum();
        square.sqrt()
    };
    for (k, crank) in platform["cranks"]["list"].as_array().unwrap().iter().enumerate() {
        let [a, b] = [0, 1].map(|end| platform["legs"][k][end].as_u64().unwrap() as usize);
        let (centre, joint) = (point(&platform["base"][a]["at"]), point(&platform["platform"][b]["at"]));
        for tip in ["tip", "other_tip"].map(|key| point(&crank[key])) {
            assert!((apart(&tip, &joint) - 85.0).abs() < 1e-9 && (apart(&tip, &centre) - 40.0).abs() < 1e-9);
        }
        let arms = &platform["cranks"]["arms"][k];
        let (s, c) = crank["angle_deg"].as_f64().unwrap().to_radians().sin_cos();
        let turned: Vec<f64> = centre
            .iter()
            .zip(point(&arms[0]))
            .zip(point(&arms[1]))
            .map(|((x, e), f)| x + c * e + s * f)
            .collect();
        assert!(apart(&turned, &point(&crank["tip"])) < 1e-9);
    }
    assert!(platform["inverse_condition"].as_f64().unwrap() > 0.0 && platform["sign"] != json!(0));
    // beyond reach there are only circles
    let far = json!({"op": "place", "numbers": [0, 0, 300, 0, 0, 0]});
    let pose = ask(&session, &far)["pose"].clone();
    let state = ask(&session, &json!({"op": "state", "pose": pose, "chosen": null}));
    let cranks = &state["platforms"][0]["cranks"];
    assert!(cranks["out_of_reach"]["too_short_by"].as_f64().unwrap() > 0.0 && cranks["list"] == json!([]));
    assert_eq!(state["platforms"][0]["inverse_condition"], json!(0.0));
    for op in ["motion", "locus"] {
        let asked = json!({"op": op, "pose": open["home"], "which": "first", "chosen": null, "points": 5});
        assert_eq!(ask(&session, &asked)["error"]["code"], json!("rotary"), "{op}");
    }
}

/// The page and `check` agree on singular platforms: the one shown first, and the starting equivalent, with the joints
/// of the file.
#[test]
fn the_page_says_of_the_joints_of_the_file_what_check_says() {
    let opened = |name: &str| {
        let text = std::fs::read_to_string(format!("tests/fixtures/verdicts/{name}.toml")).unwrap();
        let session = Session::open(&json!({"design": text, "start": null}).to_string()).unwrap();
        ask(&session, &json!({"op": "open"}))
    };
    for (name, kind, first, start) in [
        ("exact-regular-rounds-to-singular", "equivalent", json!(false), json!(false)),
        ("gd-exact-singular", "equivalent", json!(false), json!(true)),
        ("oct-sqrt3", "octahedral", json!(false), json!(null)),
        ("cyclic-hexagons", "general", json!(true), json!(null)),
        ("griffis-duffy-rounded", "general", json!(null), json!(null)),
    ] {
        let open = opened(name);
        assert_eq!(
            (&open["kind"], &open["singular"], &open["start_singular"]),
            (&json!(kind), &first, &start),
            "{name}"
        );
    }
    assert_eq!(opened("griffis-duffy-rounded")["reason"], "singular to the digits given (0.0005 mm)");
}

/// The steps shown are those of `equivalents family --explain` at the offsets asked for, with escaped names.
#[test]
fn the_derivation_is_the_sheet_of_the_command() {
    let renamed = OCTAHEDRAL.replacen("name = \"", "name = \"<b>&", 1);
    let session = session(&renamed);
    let chosen = json!({"pattern": "S123456", "offsets": [0.25, 0.25, 0.25, 0.25, 0.25, 0.25]});
    let found = ask(&session, &json!({"op": "derivation", "chosen": chosen}));
    let html = found["html"].as_str().unwrap();
    assert!(!html.contains("<b>") && html.contains("&lt;b&gt;&amp;"), "{html}");
    // (3/4)^6 - (1/4)^6
    for part in ["Cayley-Menger", "det A is their difference, 91/512", "equivalent"] {
        assert!(html.contains(part), "{part}: {html}");
    }
    let halves = json!({"pattern": "S123456", "offsets": [0.5, 0.5, 0.5, 0.5, 0.5, 0.5]});
    let singular = ask(&session, &json!({"op": "derivation", "chosen": halves}));
    assert!(singular["html"].as_str().unwrap().contains("0: singular"), "{singular}");
    let general = ask(&Session::new(design(GENERAL)), &json!({"op": "derivation", "chosen": chosen}));
    assert_eq!(general["error"]["code"], "offsets");
    let text = page(&session, None);
    assert!(
        text.contains("Cayley-Menger") && !text.contains("<b>&"),
        "the page without a core has it recorded"
    );
}

#[test]
fn numbers_of_poses_have_the_convention_of_the_design() {
    let frames = "\n[frames]\nrotation_order = \"pi\"\npivot = [0, 0, 0.5]\nrelative_to = \"home\"\nangles = \"rad\"\n";
    let session = session(&format!("{GENERAL}{frames}"));
    let opening = ask(&session, &json!({"op": "open"}));
    assert_eq!(opening["frames"]["names"], json!(["x", "y", "z", "rx", "ry", "rz"]), "{opening}");
    assert!(opening["frames"]["sentence"].as_str().unwrap().contains("Rx(a) Ry(b) Rz(c)"));
    assert!(numbers(&opening["slides"]["angles"]).iter().all(|range| *range < 6.3));
    let home = ask(&session, &json!({"op": "state", "pose": opening["home"]}));
    assert!(numbers(&home["written"]).iter().all(|x| x.abs() < 1e-12), "{home}");
    let given = [0.1, -0.2, 0.3, 0.2, -0.1, 0.4];
    let placed = ask(&session, &json!({"op": "place", "numbers": given}))["pose"].clone();
    let own = session.frames();
    let meant = own.convention.read(&given, &own.home).unwrap();
    assert!((numbers(&placed["p"])[2] - meant.position.z).abs() < 1e-12);
    let state = ask(&session, &json!({"op": "state", "pose": placed}));
    assert!(numbers(&state["written"]).iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-12), "{state}");
    let modes = ask(&session, &json!({"op": "modes", "pose": placed, "which": "first"}));
    let here = &modes["modes"][modes["here"].as_u64().unwrap() as usize]["written"];
    assert!(numbers(here).iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-6), "{modes}");
}

#[test]
fn symmetry_of_decimals_is_offered_and_written() {
    let rows: Vec<String> = [-10.0_f64, 10.0, 110.0, 130.0, 230.0, 250.0]
        .iter()
        .zip([-50.0_f64, 50.0, 70.0, 170.0, 190.0, 290.0])
        .map(|(a, b)| {
            let at = |r: f64, degrees: f64| {
                let (s, c) = degrees.to_radians().sin_cos();
                format!("{:.6},{:.6},0", r * c, r * s)
            };
            format!("{},{}", at(500.0, *a), at(280.0, b))
        })
        .collect();
    let points = json!({"op": "points", "text": rows.join("\n"), "units": "mm"});
    let made = ask(&session(GENERAL), &points)["toml"].as_str().unwrap().to_owned();
    let typed = session(&made);
    let symmetry = ask(&typed, &json!({"op": "open"}))["symmetry"].to_string();
    assert!(symmetry.contains("turned by a third"), "{symmetry}");
    let snapped = ask(&typed, &json!({"op": "snap"}));
    // the same constructions as `design convert --snap`
    assert_eq!(snapped["toml"].as_str().unwrap(), typed.design.snapped().unwrap().design.to_toml());
    let exact = session(snapped["toml"].as_str().unwrap());
    assert!(ask(&exact, &json!({"op": "open"}))["symmetry"].is_null());
    assert_eq!(ask(&exact, &json!({"op": "snap"}))["error"]["code"], "symmetry");
}

#[test]
fn a_nearly_singular_data_sheet_is_said_to_be_one() {
    let sheet = |spread: f64| {
        json!({"op": "sheet", "base_radius": 500, "platform_radius": 300, "base_spread_deg": 20,
            "platform_spread_deg": spread, "height": 400, "units": "mm"})
    };
    let session = session(GENERAL);
    let told = ask(&session, &sheet(98.0))["guesses"].to_string();
    assert!(told.contains("nearly singular") && told.contains("(22 degrees)"), "{told}");
    assert!(!ask(&session, &sheet(20.0))["guesses"].to_string().contains("singular"));
    let refused = ask(&session, &sheet(100.0))["error"]["message"].to_string();
    assert!(refused.contains("give 20 degrees"), "{refused}");
}
