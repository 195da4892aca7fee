//! The `equipod` program: see `equipod --help` and `docs/cli.md`.

fn main() {}
