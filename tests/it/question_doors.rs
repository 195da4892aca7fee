//! One question, one function: the commands give the answers of the library.

use equipod::prelude::*;
use serde_json::{Value, json};
use std::ops::ControlFlow;

use super::cli_frame::asked;

const GRIFFIS_DUFFY: &str = "designs/rbt-griffis-duffy.toml";

#[test]
fn a_locus_is_that_of_the_command() {
    let file = "designs/innocenti-6-4.toml";
    let (code, answer) =
        asked(&["plot", "locus", file, "--leg", "6", "--from", "4.3", "--to", "4.7", "--steps", "3"]);
    let design = Design::load(file).unwrap();
    let leg = LegIndex::new(5).unwrap();
    let lengths = design.lengths.unwrap();
    let options = LocusOptions::new(lengths, leg, [4.3, 4.7]).steps(3);
    let found = design.locus(&options).unwrap();
    assert_eq!((code == Some(0), &answer["between"]), (found.is_complete(), &json!(found.between.names)));
    for (row, point) in answer["rows"].as_array().unwrap().iter().zip(&found.points) {
        let (_, values) = point.found.as_ref().unwrap();
        let values: Vec<Value> = values.iter().map(|v| json!([v.re, v.im])).collect();
        let said = row["values"].as_array().unwrap().iter().map(|v| json!([v["re"], v["im"]]));
        assert_eq!((&row["length"], said.collect::<Vec<_>>()), (&json!(point.length), values));
    }
}

#[test]
fn replaceable_legs_and_the_platforms_made_of_them_are_those_of_the_commands() {
    let design = Design::load(GRIFFIS_DUFFY).unwrap();
    let options = ReplaceableOptions::all(ComponentOptions::default()).samples(2);
    let legs = design.replaceable_legs(&options).unwrap();
    let (_, answer) = asked(&["equivalents", "components", GRIFFIS_DUFFY, "--samples", "2"]);
    let drawn: Vec<usize> = legs.families.iter().map(|f| f.samples.len()).collect();
    let listed = answer["components"].as_array().unwrap();
    let said: Vec<usize> = listed.iter().map(|c| c["samples"].as_array().unwrap().len()).collect();
    assert_eq!((answer["count"].as_u64(), said), (Some(drawn.len() as u64), drawn));

    let targets = MoveTargets::default().no_shared_joints(true);
    let found = design.search_moves(&legs.found, &targets, &MoveSearchOptions::default()).unwrap();
    let (_, answer) = asked(&["equivalents", "move", GRIFFIS_DUFFY, "--search", "--no-shared-joints"]);
    assert_eq!(
        (&answer["outcome"], &answer["explanation"]),
        (&json!(found.word()), &json!(found.to_string()))
    );
    let said: Vec<&Value> =
        answer["designs"].as_array().unwrap().iter().map(|d| &d["design"]["name"]).collect();
    let names: Vec<Value> =
        found.platforms.iter().map(|p| json!(p.design.as_ref().map(|d| &d.name))).collect();
    assert!(!names.is_empty() && said.into_iter().eq(&names), "{names:?}");
}

#[test]
fn moves_of_legs_are_those_of_the_command() {
    let file = "designs/rbt-octahedral.toml";
    let design = Design::load(file).unwrap();
    let moves = ["1:P1-P2:P4:1/5", "2:P2:P4-P5:1/4"];
    for together in [false, true] {
        let requests: Vec<_> = moves.iter().map(|text| text.parse().unwrap()).collect();
        let options = MoveOptions::default().together(together);
        let found = design.move_legs(&requests, options).unwrap();
        let mut args = vec!["equivalents", "move", file, "--move", moves[0], "--move", moves[1]];
        args.extend(together.then_some("--together"));
        let (code, answer) = asked(&args);
        assert_eq!((code, found.is_regular()), (Some(0), true));
        assert_eq!(answer["outcome"], json!(found.outcome()));
        assert_eq!(answer["steps"].as_array().unwrap().len(), found.steps.len());
        assert_eq!(answer["det"], json!(found.chain.direct.determinant));
        let lengths = found.design.as_ref().and_then(|d| d.lengths).map(|l| l.get());
        assert_eq!(answer["design"]["lengths"], json!(lengths));
    }
    // a refusal names the existing families, whoever asks
    let refused = design.move_legs(&["1:9:0.2".parse().unwrap()], MoveOptions::default());
    let Err(NoMoves::NoSuchFamily { families, .. }) = refused else { panic!("{refused:?}") };
    let (code, answer) = asked(&["equivalents", "move", file, "--move", "1:9:0.2"]);
    assert_eq!((code, &answer["error"]["help"]), (Some(2), &json!(families)));
}

#[test]
fn an_exploration_is_that_of_the_command_and_tells_its_stages() {
    let design = Design::load(GRIFFIS_DUFFY).unwrap();
    let mut stages = Vec::new();
    let options = ExploreOptions::new().samples(1).on_progress(|p| {
        if let ExploreProgress::Stage(number, _) = p {
            stages.push(number);
        }
        ControlFlow::Continue(())
    });
    let ExploreReport::General(found) = design.explore(options).unwrap() else { panic!("not octahedral") };
    assert_eq!(stages, [1, 2, 3, 4, 5, 6]);
    let folder = tempfile::tempdir().unwrap();
    let (_, answer) =
        asked(&["explore", GRIFFIS_DUFFY, "--samples", "1", "-o", folder.path().to_str().unwrap()]);
    assert_eq!(answer["verdict"], json!(found.verdict().name()));
    let equivalent = std::fs::read_to_string(folder.path().join("equivalent.toml")).unwrap();
    assert_eq!(found.equivalent().map(|d| d.to_toml()), Some(equivalent));
    assert_eq!(answer["fk"]["finite_count"], json!(found.poses.solutions.roots.len()));
}
