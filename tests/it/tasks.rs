//! The first page and the guides: every command is run as it stands there and prints the lines shown, beside the
//! shipped designs. A design that the answer of a command calls good is given to
//! `equipod assess`, which has to agree.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::Mutex;

use serde_json::{Value, json};

use super::papers::shows as is_line;

/// A step that a page tells its reader to take.
#[derive(Debug, PartialEq)]
enum Step {
    /// A block ` ```toml ` or ` ```csv ` whose first line is `# FILE` (the file is made) or `# at the end of FILE`.
    Text { file: String, adds: bool, text: String },
    /// A command with the exit code that the page names, words of its output, and lines of it.
    Run { command: String, code: i32, shows: String, lines: Vec<String> },
}

/// A command line as a step (`# exit 1` behind a command that does not answer yes).
fn command_step(line: &str) -> Step {
    let (command, code) = line.split_once("# exit ").unwrap_or((line, "0"));
    let command = command.trim().replace("cargo run -- ", "equipod ");
    Step::Run { command, code: code.trim().parse().unwrap(), shows: String::new(), lines: Vec::new() }
}

/// Text blocks, command lines of blocks ` ```sh `, commands behind `$` in blocks ` ```console ` with the lines that
/// they print, and rows `| number | goal | command | exit code | words |` of tables.
fn steps(page: &str) -> Vec<Step> {
    let mut out = Vec::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|l| !l.starts_with("```")).collect();
            if language == "sh" {
                out.extend(block.iter().map(|line| command_step(line)));
            } else if language == "console" {
                let first = out.len();
                for line in block {
                    if let Some(command) = line.strip_prefix("$ ") {
                        out.push(command_step(command));
                    } else if let Some(Step::Run { lines, .. }) = out[first..].last_mut() {
                        lines.push(line.to_owned());
                    }
                }
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
                    lines: Vec::new(),
                });
            }
        }
    }
    out
}

/// Follows the steps of the page, and returns the differences from it.
fn faults(page: &str, folder: &Path) -> Vec<String> {
    faults_of(steps(page), folder)
}

fn faults_of(steps: Vec<Step>, folder: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for step in steps {
        match step {
            Step::Text { file, adds, text } => {
                let path = folder.join(&file);
                if adds && !path.exists() {
                    faults.push(format!("{file} does not exist yet"));
                }
                let before = if adds { fs::read_to_string(&path).unwrap_or_default() } else { String::new() };
                fs::write(path, before + &text).unwrap();
            }
            Step::Run { command, code, shows, lines } => {
                let words_wanted = !shows.is_empty() || !lines.is_empty();
                let (found, shown) = run(&command, words_wanted, folder, &mut faults);
                let missing = lines.iter().filter(|line| !shown.lines().any(|own| is_line(line, own)));
                faults.extend(missing.map(|line| format!("{command}: does not print `{line}`:\n{shown}")));
                if found != Some(code) || !shown.contains(&shows) {
                    let seen: String = shown.chars().take(1500).collect();
                    faults.push(format!("{command}: exit {found:?}, not {code} with {shows:?}\n{seen}"));
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

/// Runs a command line in a folder, assesses its answer, and returns its exit code and output. The output is the answer
/// as data, unless words for people are asked for.
fn run(command: &str, words_wanted: bool, folder: &Path, faults: &mut Vec<String>) -> (Option<i32>, String) {
    // quotes are for a shell
    let words: Vec<String> = command.split(' ').map(|w| w.trim_matches('\'').to_owned()).collect();
    assert_eq!(words[0], "equipod", "{command}");
    let shown = |out: Output| {
        (out.status.code(), String::from_utf8(out.stdout).unwrap() + &String::from_utf8(out.stderr).unwrap())
    };
    if !assesses(command) {
        return shown(equipod_in(folder, &words[1..]));
    }
    let copy = tempfile::tempdir().unwrap();
    if words_wanted {
        copy_folder(folder, copy.path());
    }
    let (out, found) = assessed(&words, if words_wanted { copy.path() } else { folder });
    faults.extend(found.into_iter().map(|fault| format!("{command}: {fault}")));
    shown(if words_wanted { equipod_in(folder, &words[1..]) } else { out })
}

fn equipod_in(folder: &Path, words: &[String]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_equipod")).current_dir(folder).args(words).output().unwrap()
}

/// Compares the answer of a command with the verdict of `assess` on the designs that the answer is about. These are
/// the new designs, or else those that were read.
fn assessed(words: &[String], folder: &Path) -> (Output, Vec<String>) {
    let before = designs(folder);
    let mut all = words[1..].to_vec();
    all.extend((!words.iter().any(|w| w == "--json")).then(|| "--json".to_owned()));
    let out = equipod_in(folder, &all);
    let Ok(answer) = serde_json::from_slice::<Value>(&out.stdout) else {
        let why = format!("no answer: {}", String::from_utf8_lossy(&out.stdout));
        return (out, vec![why]);
    };
    let after = designs(folder);
    let is_new = |(path, text): &(&String, &String)| before.get(*path) != Some(*text);
    let mut subjects: Vec<&String> = after.iter().filter(is_new).map(|(path, _)| path).collect();
    if subjects.is_empty() {
        subjects = after.keys().filter(|path| words.contains(path)).collect();
    }
    let assessed: Vec<(String, bool)> =
        subjects.into_iter().map(|path| (path.clone(), !is_refused(path, folder))).collect();
    (out, contradictions(&answer, &assessed))
}

/// Designs of a folder and of those below it by their paths, with their texts. The original named by `explore` is the
/// design that it has read.
fn designs(folder: &Path) -> BTreeMap<String, String> {
    let mut out = BTreeMap::new();
    let mut open = vec![folder.to_path_buf()];
    while let Some(at) = open.pop() {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            let named = |end: &str| path.extension().is_some_and(|e| e == end);
            if path.is_dir() {
                open.push(path);
            } else if (named("toml") || named("json")) && !path.ends_with("original.toml") {
                let text = fs::read_to_string(&path).unwrap();
                // answers and plans have no legs of their own
                if text.lines().any(|l| l.starts_with("legs = ") || l.starts_with("  \"legs\"")) {
                    out.insert(path.strip_prefix(folder).unwrap().to_str().unwrap().replace('\\', "/"), text);
                }
            }
        }
    }
    out
}

/// Commands whose answer says whether a design meets its requirements.
fn assesses(command: &str) -> bool {
    let verbs =
        ["assess", "optimize", "explore", "build", "export", "view", "report", "compare", "equivalents move"];
    let of = |verb: &str| {
        command.strip_prefix("equipod ").is_some_and(|rest| rest.starts_with(&format!("{verb} ")))
    };
    verbs.iter().any(|verb| of(verb)) && !command.ends_with("--help")
}

/// Whether an answer calls a design good, by the fields that say so: of a table of requirements, of a search, of a
/// candidate.
fn calls_good(answer: &Value) -> bool {
    let met = |v: &Value| v["met"] == true || v["assessment"]["met"] == true || v["fulfilled"] == true;
    let each = |key: &str| answer[key].as_array().is_some_and(|list| list.iter().any(met));
    let found = ["optimal", "best_found", "feasible", "front"].iter().any(|word| answer["status"] == *word);
    met(answer) || found || each("candidates") || each("designs")
}

/// The verdicts of `assess` on the designs with these texts: many commands are about the same one.
static SAID: Mutex<BTreeMap<String, bool>> = Mutex::new(BTreeMap::new());

/// Whether `assess` does not call a design good; one that requires nothing cannot be bad.
fn is_refused(design: &str, folder: &Path) -> bool {
    let text = fs::read_to_string(folder.join(design)).unwrap();
    if let Some(said) = SAID.lock().unwrap().get(&text) {
        return *said;
    }
    let out = equipod_in(folder, &["assess", design, "--json"].map(str::to_owned));
    let answer: Value = serde_json::from_slice(&out.stdout).unwrap();
    let refused = answer["met"] != true && answer["error"]["code"] != "assess::nothing_required";
    SAID.lock().unwrap().insert(text, refused);
    refused
}

/// Cases of an answer that calls designs good which `assess` refuses. It calls the only one or all of them good, or a
/// candidate whose file has its number.
fn contradictions(answer: &Value, assessed: &[(String, bool)]) -> Vec<String> {
    let mut out = Vec::new();
    if calls_good(answer) && !assessed.is_empty() && assessed.iter().all(|(_, good)| !good) {
        let names: Vec<&str> = assessed.iter().map(|(path, _)| path.as_str()).collect();
        out.push(format!("`assess` does not agree about {}", names.join(", ")));
    }
    for (k, candidate) in answer["candidates"].as_array().into_iter().flatten().enumerate() {
        let number = (k + 1).to_string();
        let own =
            assessed.iter().filter(|(path, good)| !good && Path::new(path).file_stem().unwrap() == &*number);
        out.extend(
            own.filter(|_| calls_good(candidate))
                .map(|(path, _)| format!("`assess` does not agree about {path}")),
        );
    }
    out
}

fn read(path: impl AsRef<Path>) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn runs_as_it_stands(page: &str) {
    let folder = with_designs();
    let faults = faults(page, folder.path());
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
}

#[test]
#[ignore = "evidence"]
fn the_guides_run_as_they_stand() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/guides");
    let mut pages: Vec<PathBuf> = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    pages.sort();
    assert!(pages.len() >= 7, "{pages:?}");
    for page in pages {
        let text = read(&page);
        assert!(steps(&text).len() > 2, "{} runs nothing", page.display());
        runs_as_it_stands(&text);
    }
    let tasks = steps(&read("docs/guides/own-hexapod.md"));
    let rows = tasks.iter().filter(|s| matches!(s, Step::Run { shows, .. } if !shows.is_empty())).count();
    assert!(rows >= 15, "{rows} tasks");
}

/// Runs the commands of the first page, those of the whole analysis or all others, beside the shipped designs.
fn readme_prints_what_it_shows(whole_analysis: bool) -> usize {
    let (folder, text) = (with_designs(), read("README.md"));
    let own = |step: &Step| match step {
        Step::Run { command, .. } => {
            command.starts_with("equipod ") && command.starts_with("equipod explore ") == whole_analysis
        }
        Step::Text { .. } => false,
    };
    let steps: Vec<Step> = steps(&text).into_iter().filter(own).collect();
    let shown: usize =
        steps.iter().map(|s| if let Step::Run { lines, .. } = s { lines.len() } else { 0 }).sum();
    let faults = faults_of(steps, folder.path());
    assert!(faults.is_empty(), "{}", faults.join("\n\n"));
    shown
}

#[test]
fn the_readme_prints_what_it_shows() {
    assert!(readme_prints_what_it_shows(false) >= 10);
}

#[test]
#[ignore = "evidence"]
fn the_whole_analysis_of_the_readme_prints_what_it_shows() {
    assert!(readme_prints_what_it_shows(true) >= 3);
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
    assert_eq!(page("```console\n$ equipod design presets\nbench-l16 ..\n```"), 0);
    assert_eq!(page("```console\n$ equipod design presets\nbench-l16\n```"), 1);
    assert_eq!(page("```console\n$ equipod check none.toml  # exit 2\n```"), 0);
    assert_eq!(page("```toml\n# at the end of none.toml\nx = 1\n```"), 1);
    assert_eq!(
        page("```toml\n# made.toml\nname = \"\"\n```\n```sh\nequipod check made.toml  # exit 2\n```"),
        0
    );
}

#[test]
fn praise_that_assess_does_not_share_is_found_out() {
    let found = |answer: Value, all: &[(&str, bool)]| {
        let assessed: Vec<(String, bool)> =
            all.iter().map(|(path, good)| ((*path).to_owned(), *good)).collect();
        contradictions(&answer, &assessed).len()
    };
    for praise in [
        json!({"status": "optimal"}),
        json!({"met": true}),
        json!({"assessment": {"met": true}}),
        json!({"designs": [{"assessment": {"met": true}}]}),
    ] {
        assert_eq!(found(praise.clone(), &[("x.toml", true)]), 0, "{praise}");
        assert_eq!(found(praise.clone(), &[("x.toml", false)]), 1, "{praise}");
        assert_eq!(found(praise.clone(), &[("x.toml", false), ("y.toml", true)]), 0, "{praise}");
    }
    let two = json!({"candidates": [{"fulfilled": true}, {"targets_met": true, "fulfilled": false, "assessment": {"met": false}}]});
    assert_eq!(found(two.clone(), &[("found/1.toml", true), ("found/2.toml", false)]), 0);
    assert_eq!(found(two, &[("found/1.toml", false), ("found/2.toml", true)]), 1);
    for none in [
        json!({"status": "violated", "assessment": {"met": false}}),
        json!({"met": null}),
        json!({"assessment": null}),
    ] {
        assert_eq!(found(none.clone(), &[("x.toml", false)]), 0, "{none}");
    }
    // the program itself: a design that misses a limit is refused, one without limits is not, and a table of joints is
    // no design
    let folder = tempfile::tempdir().unwrap();
    let text = read("designs/rbt-octahedral.toml");
    fs::write(folder.path().join("good.toml"), &text).unwrap();
    fs::write(folder.path().join("bad.toml"), text + "\n[hardware]\nleg_length = [1.0, 2.0]\n").unwrap();
    fs::write(folder.path().join("none.toml"), read("designs/general-6-6.toml")).unwrap();
    fs::write(folder.path().join("table.toml"), "x = 1\n").unwrap();
    assert_eq!(designs(folder.path()).len(), 3);
    let refused = |name: &str| is_refused(name, folder.path());
    assert_eq!(["bad.toml", "none.toml"].map(refused), [true, false]);
    let said = |text: &str| assessed(&text.split(' ').map(str::to_owned).collect::<Vec<_>>(), folder.path());
    assert_eq!(said("equipod assess bad.toml").1, [""; 0]);
}

/// Commands of the pages that are not run here, by their beginning, and why.
const LEFT_OUT: [(&str, &str); 13] = [
    ("equipod bench ", "solves problems for minutes and assesses no design; tests/it/cli_bench.rs runs it"),
    ("equipod export hexapod.toml ", "stands for any design with joints that are not ideal"),
    ("equipod fk DESIGN ", "stands for any design"),
    ("equipod design schema fk > ", "the shell writes the file"),
    (
        "equipod plot pareto ",
        "reads the answer of a search for a front, which no page makes; tests/it/cli_plot.rs does",
    ),
    (
        "equipod plot self-motion ",
        "a minute, and assesses no design; tests/it/cli_plot.rs runs a shorter one",
    ),
    ("equipod singular motion ", "a minute, and assesses no design; tests/it/cli_singularities.rs runs it"),
    ("equipod shell completions bash > ", "writes into the folder of its user"),
    ("equipod shell completions fish > ", "writes into the folder of its user"),
    ("equipod shell man -o ~", "writes into the folder of its user"),
    (
        "equipod optimize designs/worked/",
        "a minute; tests/it/worked_designs.rs assesses the result, which is shipped",
    ),
    (
        "equipod explore designs/worked/",
        "minutes; tests/it/worked_designs.rs assesses the result, which is shipped",
    ),
    ("equipod assess designs/worked/bench-plates", "half a minute; it is `assess` itself"),
];

/// Commands that a page asks its reader to type: lines of blocks for a shell, indented lines, and commands in sentences
/// with a shipped design.
fn examples(page: &str) -> Vec<String> {
    let mut out: Vec<String> = Vec::new();
    let mut block: Option<bool> = None;
    for line in page.lines() {
        if let Some(language) = line.strip_prefix("```") {
            block = if block.is_some() { None } else { Some(["sh", "console"].contains(&language)) };
            continue;
        }
        let typed = match block {
            Some(true) => vec![line.trim_start_matches("$ ").replace("cargo run -- ", "equipod ")],
            Some(false) => Vec::new(),
            None if line.starts_with("    ") => vec![line.trim().to_owned()],
            None => {
                let quoted = line.split('`').skip(1).step_by(2).filter(|q| q.contains(" designs/"));
                quoted.map(str::to_owned).collect()
            }
        };
        for command in typed {
            let command = command.split("  #").next().unwrap().trim().to_owned();
            // patterns of usage have brackets and dots
            let pattern = command.contains(['[', '<', '{']) || command.contains("..");
            if command.starts_with("equipod ") && !pattern && !out.contains(&command) {
                out.push(command);
            }
        }
    }
    out
}

/// The pages whose commands are not run by another test: those of `docs` and the first one.
fn pages() -> Vec<(String, String)> {
    let mut out = vec![("README.md".to_owned(), read("README.md"))];
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for folder in ["docs", "docs/theory", "docs/evidence"] {
        for entry in fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            if path.extension().is_some_and(|e| e == "md") {
                out.push((format!("{folder}/{name}"), fs::read_to_string(path).unwrap()));
            }
        }
    }
    out.sort();
    out
}

pub(crate) fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let target = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy_folder(&path, &target);
        } else {
            fs::copy(&path, &target).unwrap();
        }
    }
}

/// A folder with the shipped designs.
fn with_designs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    copy_folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("designs"), &folder.path().join("designs"));
    fs::create_dir_all(folder.path().join("docs/figures")).unwrap();
    folder
}

/// Runs the commands of a page one after the other; a command that ran before is not run again.
fn faults_of_examples(page: &str, done: &mut BTreeSet<String>) -> (usize, Vec<String>) {
    let folder = with_designs();
    let (mut count, mut faults) = (0, Vec::new());
    for command in examples(page) {
        let left_out = LEFT_OUT.iter().any(|(start, _)| command.starts_with(start));
        // a command that writes runs again on another page, whose later commands may read its files
        if left_out || (!command.contains(" -o ") && !done.insert(command.clone())) {
            continue;
        }
        count += 1;
        let (code, shown) = run(&command, false, folder.path(), &mut faults);
        if !matches!(code, Some(0 | 1 | 3)) {
            faults.push(format!("{command}: exit {code:?}\n{shown}"));
        }
    }
    (count, faults)
}

#[test]
fn commands_left_out_are_named_and_stand_in_a_page() {
    let all: Vec<String> = pages().iter().flat_map(|(_, text)| examples(text)).collect();
    assert!(all.len() > 80, "{}", all.len());
    for (start, why) in LEFT_OUT {
        assert!(all.iter().any(|c| c.starts_with(start)), "{start} stands in no page");
        assert!(why.len() > 10, "{start}: {why}");
    }
}

#[test]
#[ignore = "evidence"]
fn no_command_of_the_pages_calls_a_design_good_that_assess_refuses() {
    let (mut done, mut count, mut all) = (BTreeSet::new(), 0, Vec::new());
    for (name, text) in pages() {
        let (run, faults) = faults_of_examples(&text, &mut done);
        count += run;
        all.extend(faults.into_iter().map(|fault| format!("{name}: {fault}")));
    }
    assert!(count > 60, "{count}");
    assert!(all.is_empty(), "{}", all.join("\n\n"));
}
