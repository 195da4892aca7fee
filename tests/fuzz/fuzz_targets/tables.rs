//! Tables of lengths (`fk --lengths`) and of poses (`trajectory` of a design).
#![no_main]

use libfuzzer_sys::fuzz_target;

#[path = "../program.rs"]
mod program;

const DESIGN: &str = include_str!("../../../designs/rbt-octahedral.toml");

fuzz_target!(|bytes: &[u8]| {
    // a table of thousands of lines only takes longer
    if bytes.len() > 400 {
        return;
    }
    program::in_folder(|folder| {
        let at = |name: &str| folder.join(name).to_string_lossy().into_owned();
        let (design, table, out) = (at("d.toml"), at("table.csv"), at("out.toml"));
        let text = DESIGN.replace("[workspace]", "[workspace]\ntrajectory = \"table.csv\"");
        std::fs::write(&design, text).expect("a writable folder");
        std::fs::write(&table, bytes).expect("a writable folder");
        program::equipod(&["design", "convert", &design, "-o", &out]);
        program::equipod(&["fk", &design, "--lengths", &table]);
    });
});
