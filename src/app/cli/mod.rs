//! The command line: the only place that reads files, prints and ends the process.
//!
//! Data goes to standard output, everything else to standard error. With `--json` standard output holds
//! exactly one JSON document, for refusals and failures too. See `docs/cli.md`.

mod alignment;
mod args;
mod commands;
mod context;
mod diagnostic;
mod exact_pose;
mod exit;
mod failure;
mod files;
mod frames;
mod freedoms;
pub mod guide;
mod numbers;
mod output;
mod poses;
mod progress;
mod proof;
mod rows;
mod streams;
mod sweep_folder;
mod swept_table;
mod table;
mod usage;

use std::ffi::OsString;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use clap::FromArgMatches;

use self::args::Cli;
use self::context::Context;
use self::exit::Exit;
use self::failure::Failure;
use self::files::OutputPath;
use self::output::{Answer, Output};
pub use self::streams::Stop;
use num::rounding::check_arithmetic;

/// Runs the program on its arguments and returns its exit code. Panics inside are caught and reported.
pub fn main(args: impl IntoIterator<Item = OsString>) -> ExitCode {
    ExitCode::from(status(args))
}

/// As [`main`]; the exit code as a number.
pub fn status(args: impl IntoIterator<Item = OsString>) -> u8 {
    std::panic::set_hook(Box::new(|info| diagnostic::print_note(&format!("internal: {info}"))));
    started(args.into_iter().collect()).code()
}

/// Runs the program for a caller in the same process: exit code and standard output.
///
/// The texts for standard error go to `said`, piece by piece. Standard input is empty. The streams, the signals and the
/// panic hook of the process stay unchanged. Several threads may call this at once.
pub fn asked(args: Vec<OsString>, said: Sender<String>, stop: Arc<Stop>) -> (u8, String) {
    streams::for_caller(said, stop, || started(args).code())
}

fn started(args: Vec<OsString>) -> Exit {
    // clap knows --json only after it has understood everything, but its refusals must obey it too
    let json = args.iter().skip(1).take_while(|a| *a != "--").any(|a| a == "--json");
    guarded(json, || run(args, json))
}

/// Runs `body`; a panic becomes a failure with exit 4, in JSON if requested.
fn guarded(json: bool, body: impl FnOnce() -> Exit) -> Exit {
    catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        let text = payload.downcast_ref::<&str>().map(ToString::to_string);
        let text = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
        Output::new(json).failure(&Failure::internal(format!("the program broke down: {text}")), None)
    })
}

/// The notices of all software compiled in, as they come with the sources.
const LICENCES: &str = include_str!("../../../THIRD-PARTY-LICENCES.txt");

/// Whether only `--licences` is given: like `--version` it needs no command.
fn asks_for_licences(words: &[String]) -> bool {
    let own = |w: &String| ["--json", "-q", "--quiet"].contains(&w.as_str());
    words.iter().skip(1).filter(|w| !own(w)).eq(["--licences"])
}

/// Expands `equipod sweep PLAN` to `equipod sweep run PLAN`, since the most frequent command gets the shortest name.
/// For a plan with the name of a command, write `sweep run status`.
fn sweep_run_in_full(mut args: Vec<OsString>) -> Vec<OsString> {
    let mut rest = args.iter().enumerate().skip(1);
    while let Some((at, word)) = rest.next() {
        if word == "--seed" {
            rest.next();
        } else if word == "sweep" {
            let next = rest.map(|(_, word)| word.to_string_lossy()).find(|word| !word.starts_with('-'));
            if next.is_some_and(|word| !SWEEP_COMMANDS.contains(&word.as_ref())) {
                args.insert(at + 1, "run".into());
            }
            break;
        } else if !word.to_string_lossy().starts_with('-') {
            break;
        }
    }
    args
}

/// The arguments that `sweep` accepts beside a plan.
const SWEEP_COMMANDS: [&str; 8] = ["run", "status", "merge", "verify", "best", "design", "script", "help"];

/// Prints help and version, or refuses the arguments, as decided by clap.
fn told(output: Output, said: &clap::Error, words: &[String]) -> Exit {
    if said.use_stderr() { output.failure(&usage::refusal(said, words), None) } else { output.help(said) }
}

fn run(args: Vec<OsString>, json: bool) -> Exit {
    let mut args = args;
    if args.len() < 2 {
        // without arguments show the help
        args.push("--help".into());
    }
    let args = sweep_run_in_full(args);
    let words: Vec<String> = args.iter().map(|a| a.to_string_lossy().into_owned()).collect();
    if asks_for_licences(&words) {
        return Output::new(json).notices(LICENCES);
    }
    let matches = match guide::program().try_get_matches_from(args) {
        Ok(matches) => matches,
        Err(error) => return told(Output::new(json), &error, &words),
    };
    let cli = match Cli::from_arg_matches(&matches) {
        Ok(cli) => cli,
        Err(error) => return told(Output::new(json), &error.format(&mut guide::program()), &words),
    };
    let output = Output::new(cli.global.json);
    if cli.licences {
        let failure = Failure::refused("usage", "--licences is an option of `equipod` without a command");
        return output.failure(&failure.with_help("`equipod --licences`"), None);
    }
    if let Err(unfit) = check_arithmetic() {
        let help = "a library loaded into this process has switched the processor, as code compiled with `-ffast-math` does: start without it (LD_PRELOAD?)";
        return output
            .failure(&Failure::new(Exit::Internal, "arithmetic", unfit.to_string()).with_help(help), None);
    }
    files::begin();
    if let Err(failure) = files::check_arguments(&matches, output.is_json()) {
        return output.failure(&failure, None);
    }
    let mut context = Context::new(&cli.global, &matches);
    let result = cli.command.run(&mut context);
    match result {
        Ok(answer) => output.answer(&answer, &context),
        Err(failure) => output.failure(&failure, Some(&context)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_of_a_plan_needs_no_further_word() {
        let full = |line: &str| {
            let words = std::iter::once("equipod").chain(line.split(' ')).map(Into::into).collect();
            sweep_run_in_full(words).iter().skip(1).map(|w| w.to_string_lossy()).collect::<Vec<_>>().join(" ")
        };
        assert_eq!(full("sweep plan.toml --shard 0/4 -o dir"), "sweep run plan.toml --shard 0/4 -o dir");
        assert_eq!(full("--seed 5 --json sweep plan.toml"), "--seed 5 --json sweep run plan.toml");
        for line in
            ["sweep", "sweep --help", "sweep status dir", "sweep run status", "check sweep", "fk sweep a"]
        {
            assert_eq!(full(line), line);
        }
        let group = guide::program();
        let group = group.find_subcommand("sweep").unwrap();
        assert!(group.get_subcommands().all(|c| SWEEP_COMMANDS.contains(&c.get_name())));
    }

    /// Exit code, standard output and standard error of a command for a caller.
    fn asked_here(line: &str) -> (u8, String, String) {
        let (said, heard) = std::sync::mpsc::channel();
        let (code, output) = asked(line.split(' ').map(Into::into).collect(), said, Arc::default());
        (code, output, heard.iter().collect())
    }

    #[test]
    fn a_caller_gets_all_that_a_command_writes() {
        let (code, output, said) = asked_here("equipod design presets --json");
        assert!(code == 0 && output.starts_with('{') && said.is_empty(), "{code} {output} {said}");
        let (code, output, said) = asked_here("equipod chekc a.toml");
        assert!(
            code == 2 && output.is_empty() && said.starts_with("error[usage]: "),
            "{code} {output} {said}"
        );
        let (code, output, _) = asked_here("equipod --help");
        assert!(code == 0 && output.contains("design") && !output.contains('\x1b'), "{code} {output}");
    }

    #[test]
    fn standard_input_is_empty_for_a_caller() {
        let (code, _, said) = asked_here("equipod check -");
        assert!(code == 2 && said.contains("standard input"), "{code} {said}");
        let (code, _, said) = asked_here("equipod new");
        assert!(code == 2 && said.starts_with("error[new::nothing_given]: "), "{code} {said}");
    }

    #[test]
    fn a_caller_is_told_whether_a_command_heeds_the_stop() {
        let (said, _heard) = std::sync::mpsc::channel();
        let stop = Arc::<Stop>::default();
        let ((), output) = streams::for_caller(said, Arc::clone(&stop), || {
            let interrupt = progress::Interrupt::watch();
            assert!(interrupt.flow().is_continue());
            assert!(stop.ask(), "a first request is heeded");
            assert!(!stop.ask() && interrupt.flow().is_break());
        });
        assert!(output.is_empty() && !Stop::default().ask(), "no command heeds this stop");
    }

    #[test]
    fn a_panic_is_an_internal_failure() {
        assert_eq!(guarded(true, || panic!("boom {}", 1)), Exit::Internal);
        assert_eq!(guarded(false, || Exit::No), Exit::No);
    }
}
