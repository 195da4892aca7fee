//! `equipod plot`: every figure is drawn, names its content, and follows the design.

use super::cli_frame::{document, equipod};
use super::evidence::size;

const OCTAHEDRAL: &str = "designs/rbt-octahedral.toml";

fn svg(args: &[&str]) -> String {
    let out = equipod(&[&["plot"], args].concat());
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(text.starts_with("<svg ") && text.ends_with("</svg>\n"));
    assert!(text.contains("<title") && text.contains("<desc") && !text.contains("NaN"));
    text
}

fn refusal(args: &[&str]) -> (i32, String) {
    let out = equipod(&[&["--json", "plot"], args].concat());
    (out.status.code().unwrap(), document(&out)["error"]["code"].as_str().unwrap().to_string())
}

#[test]
fn modes_are_drawn_for_any_design() {
    assert_eq!(svg(&["modes", OCTAHEDRAL]).matches(">pose ").count(), 12);
    assert_eq!(svg(&["modes", "designs/lee-shim.toml"]).matches(">pose ").count(), 8);
}

#[test]
fn det_a_changes_its_sign_on_the_published_line() {
    let text = svg(&["det", OCTAHEDRAL, "--offsets", "0.2,0.3,0.2,0.3,0.2,0.3"]);
    // t1 + t2 = 1 from (-0.5, 1.5) to (1.5, -0.5): corner to corner of the frame
    let line = text.split("class=\"singular\" points=\"").nth(1).unwrap().split('"').next().unwrap();
    for point in line.split(' ') {
        let (x, y) = point.split_once(',').unwrap();
        let (x, y): (f64, f64) = (x.parse().unwrap(), y.parse().unwrap());
        let share = (x - 84.0) / 580.0 + (566.0 - y) / 500.0;
        assert!((share - 1.0).abs() < 1e-4, "{point}");
    }
    assert!(text.contains("det A = 0.175400"), "(0.8 * 0.7)^3 - (0.2 * 0.3)^3");
    let two = svg(&["det", OCTAHEDRAL, "--slice", "1,4", "--offsets", "0,0.5,0.5,0,0.5,0.5"]);
    assert!(two.contains("offset t1 [edge]") && two.contains("offset t4 [edge]"));
    assert_eq!(refusal(&["det", "designs/lee-shim.toml"]), (2, "plot::not_octahedral".into()));
    assert_eq!(refusal(&["det", OCTAHEDRAL, "--slice", "1,7"]).1, "usage");
}

#[test]
fn a_workspace_ends_at_the_limits_of_the_design() {
    let design = "designs/worked/bench-octahedral.toml";
    let at = |slice: &str| svg(&["workspace", design, "--slice", slice, "--resolution", "61"]);
    let (positions, orientations) = (at("x,z"), at("rx,ry"));
    for text in [&positions, &orientations] {
        assert!(text.contains("class=\"boundary\"") && text.contains(">reachable<"));
    }
    assert!(positions.contains(">leg length, maximum<") && positions.contains("[mm]"));
    assert!(orientations.contains("rx [degrees]"));
    // a design without limits of its own ends at singular poses only, and says so
    let free = svg(&["workspace", "designs/lee-shim.toml", "--slice", "rx,rz", "--resolution", "61"]);
    assert!(free.contains("no limits of its own") && !free.contains("leg length, maximum"));
    assert!(free.contains(">beyond a singular pose<"));
}

#[test]
fn the_other_figures_are_those_of_their_commands() {
    let steps = size("2", "5");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("by-command.svg");
    let path = file.to_str().unwrap();
    let by_command = |args: &[&str]| {
        assert!(equipod(&[args, &["--svg", path]].concat()).status.success());
        std::fs::read_to_string(&file).unwrap()
    };
    let locus = ["plot", "locus", OCTAHEDRAL, "--leg", "1", "--from", "10", "--to", "14", "--steps", steps];
    let out = equipod(&[&locus[..], &["-o", path]].concat());
    assert_eq!(svg(&locus[1..]), std::fs::read_to_string(&file).unwrap());
    assert!(String::from_utf8(out.stdout).unwrap().starts_with(path), "and the values as text");
    let griffis_duffy = "designs/rbt-griffis-duffy.toml";
    assert_eq!(
        svg(&["components", griffis_duffy]),
        by_command(&["equivalents", "components", griffis_duffy])
    );
    assert_eq!(svg(&["topologies", OCTAHEDRAL]), by_command(&["equivalents", "topologies", OCTAHEDRAL]));
    let out = equipod(&["singular", "poses", OCTAHEDRAL, "--cells", "10", "--slice", "x,z", "--svg", path]);
    assert!(out.status.code().is_some_and(|c| c < 4));
    assert_eq!(
        svg(&["singular-poses", OCTAHEDRAL, "--slice", "x,z"]),
        std::fs::read_to_string(&file).unwrap()
    );
}

#[test]
fn a_front_is_read_from_a_result() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("front.json");
    let path = file.to_str().unwrap();
    let member = |a: f64, b: f64| {
        format!(
            r#"{{"objectives":[{{"name":"worst_conditioning","value":{a},"unit":""}},{{"name":"stroke","value":{b},"unit":"mm"}}],"design":{{"name":"D"}}}}"#
        )
    };
    let write = |members: &[String]| {
        std::fs::write(&file, format!(r#"{{"front":[{}],"provenance":{{"seed":7}}}}"#, members.join(",")))
            .unwrap();
    };
    write(&[member(0.2, 30.0), member(0.3, 50.0), member(0.4, 90.0)]);
    let text = svg(&["pareto", path]);
    assert_eq!(text.matches("class=\"mark\"").count(), 3);
    // conditioning is to be large, stroke small
    assert!(text.contains(">worst conditioning, better \u{2192}<"));
    assert!(text.contains(">\u{2190} better, stroke [mm]<"));
    write(&[]);
    assert_eq!(refusal(&["pareto", path]), (2, "plot::not_a_front".into()));
    std::fs::write(&file, "{}").unwrap();
    assert_eq!(refusal(&["pareto", path]).1, "plot::not_a_front");
}

#[test]
fn with_json_the_picture_is_in_the_document_or_in_the_file() {
    let inline = document(&equipod(&["--json", "plot", "det", OCTAHEDRAL]));
    assert!(inline["svg"].as_str().unwrap().starts_with("<svg "));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("det.svg");
    let path = file.to_str().unwrap();
    let written = document(&equipod(&["--json", "plot", "det", OCTAHEDRAL, "-o", path]));
    assert_eq!(written["output"].as_str(), Some(path));
    assert_eq!(inline["svg"].as_str().unwrap(), std::fs::read_to_string(&file).unwrap());
}

#[test]
fn a_pair_shows_the_leg_map() {
    let text = svg(&["pair", OCTAHEDRAL, "designs/rbt-griffis-duffy.toml"]);
    // six rings for the shared joints of the octahedral platform, twelve single joints; one of each in the legend
    assert_eq!(
        (text.matches("class=\"shared\" cx").count(), text.matches("class=\"hollow\" cx").count()),
        (7, 13)
    );
    assert!(text.contains("A s + c") && text.contains("det A = "));
    // no map, no picture: the answer is no
    assert_eq!(refusal(&["pair", OCTAHEDRAL, "designs/lee-shim.toml"]), (1, "plot::no_leg_map".into()));
}

#[test]
fn the_required_workspace_is_drawn_over_the_reachable_one() {
    let design = "designs/worked/bench-octahedral.toml";
    let picture = |more: &[&str]| svg(&[&["workspace", design, "--resolution", "21"], more].concat());
    let colour =
        |text: &str, code: &str| text.split(&format!(".{code}{{fill:")).nth(1).unwrap()[..7].to_owned();
    let (places, tilts) = (picture(&[]), picture(&["--slice", "rx,ry"]));
    for text in [&places, &tilts] {
        assert!(text.contains(">required workspace</text>") && text.contains("<polyline class=\"required\""));
        assert!(!text.contains("paint-order"), "some viewers do not know it");
    }
    // one colour for a limit in every slice
    for (code, _) in equipod::methods::plot::LIMIT_FILLS {
        assert_eq!(colour(&places, code), colour(&tilts, code), "{code}");
    }
    // at another pose it is the section there: smaller for a position that is turned, none outside of the region
    let lines = |more: &[&str]| picture(more).matches("<polyline class=\"required\"").count();
    assert_eq!(lines(&["--pose", "1,2,211,1,0,0"]), 1);
    assert_eq!(lines(&["--pose", "0,0,900,0,0,0"]), 0);
    // without a workspace nothing is required
    let free = svg(&["workspace", "designs/lee-shim.toml", "--resolution", "11"]);
    assert!(!free.contains("required workspace"));
}

#[test]
fn the_picture_of_the_readme_is_the_one_the_command_draws() {
    let drawn = svg(&["pair", OCTAHEDRAL, "designs/rbt-griffis-duffy.toml"]);
    assert_eq!(drawn, std::fs::read_to_string("docs/figures/equivalence.svg").unwrap());
}
