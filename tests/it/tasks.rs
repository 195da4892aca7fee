//! The tasks of a newcomer, `docs/tasks.md`, and the guides: every command is run as it stands there, in an empty folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a page tells its reader to do.
#[derive(Debug, PartialEq)]
enum Step {
    /// A block ` ```toml ` or ` ```csv ` whose first line is `# FILE` (the file is made) or `# at the end of FILE`.
    Text { file: String, adds: bool, text: String },
    /// A command with the exit code that the page names and words of its output.
    Run { command: String, code: i32, shows: String },
}

/// Text blocks, command lines of blocks ` ```sh ` (`# exit 1` behind a command that does not answer yes), and rows
/// `| number | goal | command | exit code | words |` of tables.
fn steps(page: &str) -> Vec<Step> {
    let mut out = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|l| !l.starts_with("```")).collect();
            if language == "sh" {
                out.extend(block.iter().map(|l| {
                    let (command, code) = l.split_once("# exit ").unwrap_or((l, "0"));
                    let command = command.trim().to_string();
                    Step::Run { command, code: code.trim().parse().unwrap(), shows: String::new() }
                }));
            } else if let Some(name) = block.first().and_then(|l| l.strip_prefix("# ")) {
                let (file, adds) = name.strip_prefix("at the end of ").map_or((name, false), |f| (f, true));
                let text = block[1..].join("\n") + "\n";
                out.push(Step::Text { file: file.to_string(), adds, text });
            }
        } else if line.starts_with("| ") {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
            if let [number, _, command, code, shows] = cells[..]
                && number.parse::<usize>().is_ok()
            {
                let plain = |cell: &str| cell.trim_matches('`').to_string();
                out.push(Step::Run {
                    command: plain(command),
                    code: code.parse().unwrap(),
                    shows: plain(shows),
                });
            }
        }
    }
    out
}

/// Does what the page says, and returns what went otherwise.
fn faults(page: &str, folder: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for step in steps(page) {
        match step {
            Step::Text { file, adds, text } => {
                let path = folder.join(&file);
                if adds && !path.exists() {
                    faults.push(format!("{file} does not exist yet"));
                }
                let before = if adds { fs::read_to_string(&path).unwrap_or_default() } else { String::new() };
                fs::write(path, before + &text).unwrap();
            }
            Step::Run { command, code, shows } => {
                let mut words = command.split(' ');
                assert_eq!(words.next(), Some("equipod"), "{command}");
                let mut program = Command::new(env!("CARGO_BIN_EXE_equipod"));
                let out = program.current_dir(folder).args(words).output().unwrap();
                let shown = String::from_utf8(out.stdout).unwrap() + &String::from_utf8(out.stderr).unwrap();
                if out.status.code() != Some(code) || !shown.contains(&shows) {
                    let seen: String = shown.chars().take(1500).collect();
                    faults.push(format!(
                        "{command}: exit {:?}, not {code} with {shows:?}\n{seen}",
                        out.status.code()
                    ));
                }
                let written = command.split_once(" -o ").and_then(|(_, rest)| rest.split(' ').next());
                if let Some(file) = written.filter(|f| *f != "-" && code == 0)
                    && !folder.join(file).exists()
                {
                    faults.push(format!("{command}: wrote no {file}"));
                }
            }
        }
    }
    faults
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn runs_as_it_stands(page: &str) {
    let folder = tempfile::tempdir().unwrap();
    let faults = faults(page, folder.path());
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}

#[test]
#[ignore = "slow evidence"]
fn thirty_tasks_are_done_with_one_command_each() {
    let page = read("docs/tasks.md");
    let tasks = steps(&page).into_iter().filter(|s| matches!(s, Step::Run { .. })).count();
    assert!(tasks >= 30, "{tasks}");
    runs_as_it_stands(&page);
}

#[test]
#[ignore = "slow evidence"]
fn the_guides_run_as_they_stand() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guides");
    let mut pages: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    pages.sort();
    assert!(pages.len() >= 5, "{pages:?}");
    for page in pages {
        let text = read(&page);
        assert!(steps(&text).len() > 2, "{} runs nothing", page.display());
        runs_as_it_stands(&text);
    }
}

#[test]
fn the_first_five_minutes_of_the_readme_run_as_they_stand() {
    let text = read("README.md");
    let part = text.split("\n## Your own hexapod").nth(1).unwrap().split("\n## ").next().unwrap();
    assert!(steps(part).len() > 5, "{part}");
    runs_as_it_stands(part);
}

#[test]
fn a_page_that_promises_too_much_is_found_out() {
    let folder = tempfile::tempdir().unwrap();
    let page = |body: &str| faults(body, folder.path()).len();
    assert_eq!(page("| 1 | all presets | `equipod design presets` | 0 | bench-l16 |"), 0);
    assert_eq!(page("| 1 | all presets | `equipod design presets` | 0 | no such preset |"), 1);
    assert_eq!(page("| 1 | all presets | `equipod design presets` | 1 | bench-l16 |"), 1);
    assert_eq!(page("```sh\nequipod check none.toml\n```"), 1);
    assert_eq!(page("```sh\nequipod check none.toml  # exit 2\n```"), 0);
    assert_eq!(page("```toml\n# at the end of none.toml\nx = 1\n```"), 1);
    assert_eq!(
        page("```toml\n# made.toml\nname = \"\"\n```\n```sh\nequipod check made.toml  # exit 2\n```"),
        0
    );
}
