//! The `equipod` program: see `equipod --help` and `docs/cli.md`.

use std::process::ExitCode;

fn main() -> ExitCode {
    equipod::cli::main(std::env::args_os())
}
