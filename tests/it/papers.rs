//! `docs/papers.md`: every command prints the text of the page, and the line of Fig. 8 is singular.

use super::cli_frame::equipod;
use equipod::methods::manipulator::Level;
use equipod::prelude::*;

/// Whether a line of the page is this line of the program; `..` at its end stands for the rest.
pub(crate) fn shows(shown: &str, printed: &str) -> bool {
    let (shown, printed) = (shown.trim(), printed.trim());
    shown.strip_suffix(" ..").map_or(printed == shown, |start| printed.starts_with(start))
}

/// Runs these commands, all or some of the `count` commands under one heading of the page.
fn section_prints_what_it_shows(heading: &str, count: usize, part: std::ops::Range<usize>) {
    let page = std::fs::read_to_string("docs/papers.md").unwrap();
    let section = page.split("\n## ").find(|part| part.starts_with(heading)).unwrap();
    let mut commands: Vec<(&str, Vec<&str>)> = Vec::new();
    for block in section.split("```console\n").skip(1) {
        for line in block.split("```").next().unwrap().lines() {
            match line.strip_prefix("$ equipod ") {
                Some(command) => commands.push((command, Vec::new())),
                None => commands.last_mut().unwrap().1.push(line),
            }
        }
    }
    assert_eq!(commands.len(), count);
    for (command, lines) in commands.drain(part) {
        let output = equipod(&command.split(' ').collect::<Vec<_>>());
        let printed = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap()).concat();
        assert!(!lines.is_empty(), "{command}");
        for line in lines {
            let found = printed.lines().any(|own| shows(line, own));
            assert!(found, "`{line}` is not printed by `equipod {command}`:\n{printed}");
        }
    }
}

#[test]
fn the_octahedral_manipulator() {
    section_prints_what_it_shows("Rojas", 13, 0..13);
}

#[test]
fn topologies() {
    section_prints_what_it_shows("Porta", 5, 0..1);
}

#[test]
fn trilateration() {
    section_prints_what_it_shows("Porta", 5, 1..5);
}

#[test]
fn the_determinant_of_degree_forty() {
    section_prints_what_it_shows("Lee", 4, 0..4);
}

#[test]
fn elimination_templates_of_almost_planar_platforms() {
    section_prints_what_it_shows("Martyushev", 6, 0..3);
}

#[test]
fn elimination_templates_of_all_classes() {
    section_prints_what_it_shows("Martyushev", 6, 3..6);
}

/// `Delta1 + 2 Delta2 = 12` (Rojas, Borras, Thomas, Fig. 8) is singular at all points, and nothing beside it is.
#[test]
fn the_line_of_figure_8_is_singular() {
    let read = |name: &str| std::fs::read_to_string(format!("designs/{name}.toml")).unwrap();
    let octahedral: Design = read("rbt-octahedral").parse().unwrap();
    let with = |first: &str, second: &str| -> Design {
        let line = |line: &str| match line {
            _ if line.starts_with("delta1 =") => format!("delta1 = \"{first}\""),
            _ if line.starts_with("delta2 =") => format!("delta2 = \"{second}\""),
            _ if line.starts_with("lengths") => String::new(),
            other => other.to_owned(),
        };
        read("rbt-griffis-duffy").lines().map(line).collect::<Vec<_>>().join("\n").parse().unwrap()
    };
    for k in 1..=23 {
        let on = leg_map(&octahedral, &with(&format!("{k}/2"), &format!("(12-{k}/2)/2"))).unwrap();
        assert_eq!((on.relation, on.level), (Relation::Singular, Level::ExactJoints), "{k}");
        let beside = leg_map(&octahedral, &with(&format!("{k}/2"), &format!("(12-{k}/2)/2+1/1000"))).unwrap();
        assert_eq!(beside.relation, Relation::Equivalent, "{k}");
    }
}
