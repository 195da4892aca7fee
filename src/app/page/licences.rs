//! The licence notices of the software compiled into the core of the page.

use std::fmt::Write as _;

/// The notices of all software compiled into the program; a star marks parts that are in the pages too.
const NOTICES: &str = include_str!("../../../THIRD-PARTY-LICENCES.txt");
/// The length of the rules above and below the names of each text.
const RULE_LENGTH: usize = 100;
/// The part of the core without a star, since it is no crate.
const STANDARD_LIBRARY: &str = "the Rust standard library";

/// The notices of the core: its crates with their licences, and the texts that apply to one of them.
pub(super) fn notices() -> String {
    let rule = "=".repeat(RULE_LENGTH);
    let mut parts = NOTICES.split(&rule);
    let head = parts.next().unwrap_or_default();
    let listed: Vec<&str> = head.lines().filter_map(|l| l.strip_prefix("* ")).collect();
    let names: Vec<&str> = listed.iter().filter_map(|l| l.split(": ").next()).collect();
    let is_ours = |name: &str| name.starts_with(STANDARD_LIBRARY) || names.contains(&name);
    let mut out = format!(
        "equipod itself is licensed under MIT or Apache-2.0.\n\
         This page contains code of the Rust standard library and of these crates:\n\n{}\n",
        listed.join("\n")
    );
    while let (Some(over), Some(text)) = (parts.next(), parts.next()) {
        let over: Vec<&str> = over.trim().split(", ").map(str::trim).filter(|name| is_ours(name)).collect();
        if !over.is_empty() {
            // writing to a string cannot fail
            let _ = write!(out, "\n{rule}\n{}\n{rule}\n\n{}\n", over.join(", "), text.trim());
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_crate_of_the_core_has_its_text_and_no_other_crate_is_named() {
        let text = notices();
        let rule = "=".repeat(RULE_LENGTH);
        let mut parts = text.split(&rule);
        let head = parts.next().unwrap();
        assert!(head.contains("nalgebra ") && head.contains("clarabel ") && !head.contains("clap "));
        let parts: Vec<&str> = parts.collect();
        let covered: Vec<&str> = parts.chunks(2).flat_map(|p| p[0].trim().split(", ")).collect();
        let (list, _) = NOTICES.split_once(&rule).unwrap();
        let starred = list.lines().filter_map(|l| l.strip_prefix("* ")?.split(": ").next());
        let mut count = 0;
        for name in starred {
            assert!(covered.contains(&name), "{name} has no text");
            count += 1;
        }
        assert!(count > 40 && covered.iter().any(|name| name.starts_with(STANDARD_LIBRARY)));
        assert!(!covered.iter().any(|name| name.starts_with("clap")));
        assert!(text.len() < NOTICES.len());
    }
}
