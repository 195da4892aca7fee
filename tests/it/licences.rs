//! The program prints the licence notices of its crates; `.ci/licences --check` says that they are complete.

use super::cli_frame::equipod;

#[test]
fn the_program_prints_the_notices() {
    let notices = include_str!("../../THIRD-PARTY-LICENCES.txt");
    let out = equipod(&["--licences"]);
    assert_eq!((out.status.code(), String::from_utf8(out.stdout).unwrap()), (Some(0), notices.to_string()));
    // like --version it is asked without a command
    let refused = equipod(&["--licences", "design", "presets"]);
    assert_eq!((refused.status.code(), refused.stdout.len()), (Some(2), 0));
}
