//! `equipod sweep` as a process: shards, kills, torn files, full disks, other threads, refusals.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use equipod::records::sha256;
use serde_json::Value;

use super::cli_frame::{document, equipod};

const BASE: &str = "designs/rbt-octahedral.toml";

struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    fn path(&self, name: &str) -> String {
        self.folder.path().join(name).to_str().unwrap().to_owned()
    }

    /// A plan about the octahedral design.
    fn plan(&self, name: &str, rest: &str) -> String {
        let base = Path::new(env!("CARGO_MANIFEST_DIR")).join(BASE);
        let path = self.path(name);
        std::fs::write(&path, format!("name = 'test'\ndesign = '{}'\n{rest}", base.display())).unwrap();
        path
    }
}

const OFFSETS: &str = "compute = ['det_a', 'spacing', 'conditioning']\nkeep = ['base_spacing > 2']\n[vary]\nby = 'sobol'\ncount = 300\nvalues = { offsets = { from = 0.1, to = 0.9 } }\n";

fn asked(args: &[&str]) -> (Option<i32>, Value) {
    let out = equipod(&[&["sweep"], args, &["--json"]].concat());
    (out.status.code(), document(&out))
}

/// The parts of a folder, with their bytes.
fn parts(folder: &str) -> Vec<(String, Vec<u8>)> {
    let mut names: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    names.retain(|p| p.extension().is_some_and(|e| e == "parquet"));
    names.sort();
    let name = |p: &PathBuf| p.file_name().unwrap().to_str().unwrap().to_owned();
    names.iter().map(|p| (name(p), std::fs::read(p).unwrap())).collect()
}

fn numbers(value: &Value) -> Vec<u64> {
    value.as_array().unwrap().iter().map(|n| n.as_u64().unwrap()).collect()
}

#[test]
fn parts_are_the_same_bytes_for_any_threads_and_any_order_of_shards() {
    let place = Place::new();
    let plan = place.plan("plan.toml", OFFSETS);
    let (one, two, three) = (place.path("one"), place.path("two"), place.path("three"));
    let (code, doc) = asked(&[&plan, "--shards", "4", "--threads", "1", "-o", &one]);
    assert_eq!(
        (code, numbers(&doc["done"]), numbers(&doc["missing"])),
        (Some(0), vec![0, 1, 2, 3], vec![]),
        "{doc}"
    );
    assert!(doc["rows"].as_u64().unwrap() > 100 && doc["rows"].as_u64().unwrap() < 300);
    assert_eq!(asked(&["run", &plan, "--shards", "4", "--threads", "3", "-o", &two]).0, Some(0));
    // in another order, counted from 1, by the short name
    for shard in ["4/4", "2/4", "3/4", "1/4"] {
        let (code, doc) = asked(&[&plan, "--shard", shard, "-o", &three]);
        assert_eq!((code, numbers(&doc["computed"]).len()), (Some(0), 1), "{shard}: {doc}");
    }
    let bytes = parts(&one);
    assert_eq!((bytes.len(), &bytes), (4, &parts(&two)));
    // the writing of the part takes some of the time of its shard
    for (name, _) in &bytes {
        let manifest = std::fs::read(Path::new(&one).join(name).with_extension("json")).unwrap();
        let manifest: Value = serde_json::from_slice(&manifest).unwrap();
        let [all, writing] = ["seconds", "writing_seconds"].map(|key| manifest[key].as_f64().unwrap());
        assert!(0.0 < writing && writing < all, "{manifest}");
    }
    assert_eq!(bytes, parts(&three));
    // one part per shard whatever is done twice
    let (code, doc) = asked(&[&plan, "-o", &three]);
    assert_eq!((code, numbers(&doc["computed"]), bytes), (Some(0), vec![], parts(&three)));
    let (code, doc) = asked(&["verify", &three, "--sample", "30"]);
    assert_eq!((code, &doc["same"]), (Some(0), &Value::Bool(true)), "{doc}");
    assert_eq!(numbers(&doc["sampled"]).len(), 30);
    let merged = place.path("all.parquet");
    let (code, doc) = asked(&["merge", &three, "-o", &merged]);
    assert_eq!((code, &doc["rows"]), (Some(0), &asked(&["status", &one]).1["rows"]));
    assert_eq!(doc["sha256"], sha256(&std::fs::read(&merged).unwrap()));
}

/// Starts a sweep that takes a while, and kills it once some shards are done.
fn killed(plan: &str, folder: &str, after: usize) {
    let mut child = Command::new(env!("CARGO_BIN_EXE_equipod"))
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .args(["sweep", plan, "--shards", "60", "-q", "-o", folder])
        .stdout(Stdio::null())
        .spawn()
        .unwrap();
    let began = Instant::now();
    let done = || {
        let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
        entries.filter(|e| e.path().extension().is_some_and(|e| e == "json")).count()
    };
    // the file of the sweep itself is one of them
    while done() < after + 1
        && child.try_wait().unwrap().is_none()
        && began.elapsed() < Duration::from_secs(120)
    {
        std::thread::sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
}

#[test]
fn a_sweep_that_is_killed_twice_is_resumed_and_verified() {
    let place = Place::new();
    let plan = place.plan("plan.toml", &OFFSETS.replace("count = 300", "count = 1400"));
    let (folder, whole) = (place.path("killed"), place.path("whole"));
    killed(&plan, &folder, 3);
    let (code, first) = asked(&["status", &folder]);
    assert_eq!(code, Some(1), "{first}");
    let before: Vec<_> = numbers(&first["done"]);
    assert!(before.len() >= 3 && before.len() < 60, "{first}");
    // the remainder of a killed run under another name is nobody's part
    std::fs::write(Path::new(&folder).join(".part-00059-of-00060.parquet.1.part"), "PAR1").unwrap();
    killed(&plan, &folder, before.len() + 3);
    let (_, second) = asked(&["status", &folder]);
    let after = numbers(&second["done"]);
    assert!(
        before.iter().all(|s| after.contains(s)) && after.len() > before.len() && after.len() < 60,
        "{second}"
    );
    assert_eq!(after.len() + numbers(&second["missing"]).len(), 60);
    let (code, done) = asked(&["run", &plan, "-o", &folder]);
    assert_eq!(
        (code, numbers(&done["computed"])),
        (Some(0), numbers(&second["missing"])),
        "only what is missing: {done}"
    );
    assert_eq!(done["unfinished"], serde_json::json!([]));
    assert_eq!(asked(&["verify", &folder]).0, Some(0));
    assert_eq!(asked(&[&plan, "--shards", "60", "-o", &whole]).0, Some(0));
    assert_eq!(parts(&folder), parts(&whole));
}

#[test]
fn torn_altered_and_lost_files_are_seen_and_computed_again() {
    let place = Place::new();
    let plan = place.plan("plan.toml", OFFSETS);
    let folder = place.path("sweep");
    assert_eq!(asked(&[&plan, "--shards", "6", "-o", &folder]).0, Some(0));
    let good = parts(&folder);
    let file = |k: usize| Path::new(&folder).join(&good[k].0);
    std::fs::write(file(0), &good[0].1[..good[0].1.len() / 2]).unwrap();
    let mut altered = good[1].1.clone();
    let middle = altered.len() / 2;
    altered[middle] ^= 1;
    std::fs::write(file(1), altered).unwrap();
    std::fs::remove_file(file(2)).unwrap();
    std::fs::write(file(3).with_extension("json"), "{").unwrap();
    let foreign = std::fs::read(file(5).with_extension("json")).unwrap();
    std::fs::write(file(4).with_extension("json"), foreign).unwrap();
    let (code, doc) = asked(&["status", &folder]);
    assert_eq!(
        (code, numbers(&doc["done"]), numbers(&doc["missing"])),
        (Some(1), vec![5], vec![0, 1, 2, 3, 4]),
        "{doc}"
    );
    assert_eq!(doc["missing_ranges"], "0-4");
    let reasons: Vec<&str> =
        doc["damaged"].as_array().unwrap().iter().map(|d| d["reason"].as_str().unwrap()).collect();
    assert_eq!(reasons.len(), 4);
    assert!(reasons[0].contains("bytes instead of") && reasons[1].contains("another digest"), "{reasons:?}");
    assert_eq!(asked(&["verify", &folder]).0, Some(1));
    let merged = place.path("all.parquet");
    assert_eq!(asked(&["merge", &folder, "-o", &merged]).1["error"]["code"], "sweep::incomplete");
    assert_eq!(asked(&["merge", &folder, "--partial", "-o", &merged]).0, Some(0));
    let (code, doc) = asked(&[&plan, "-o", &folder]);
    assert_eq!((code, numbers(&doc["computed"]), parts(&folder)), (Some(0), vec![0, 1, 2, 3, 4], good));
}

#[test]
fn a_part_with_other_numbers_and_a_digest_that_fits_is_found_by_computing_again() {
    let place = Place::new();
    let (plan, other) =
        (place.plan("a.toml", OFFSETS), place.plan("b.toml", &OFFSETS.replace("to = 0.9", "to = 0.8")));
    let (folder, donor) = (place.path("a"), place.path("b"));
    for (plan, folder) in [(&plan, &folder), (&other, &donor)] {
        assert_eq!(asked(&[plan, "--shards", "1", "-o", folder]).0, Some(0));
    }
    let name = parts(&folder)[0].0.clone();
    let at = |folder: &str, end: &str| Path::new(folder).join(&name).with_extension(end);
    std::fs::copy(at(&donor, "parquet"), at(&folder, "parquet")).unwrap();
    let read = |path: &Path| serde_json::from_slice::<Value>(&std::fs::read(path).unwrap()).unwrap();
    let (mut own, theirs) = (read(&at(&folder, "json")), read(&at(&donor, "json")));
    for key in ["bytes", "sha256", "rows"] {
        own[key] = theirs[key].clone();
    }
    std::fs::write(at(&folder, "json"), own.to_string()).unwrap();
    assert_eq!(asked(&["status", &folder]).0, Some(0), "digests alone agree");
    let (code, doc) = asked(&["verify", &folder, "--sample", "5"]);
    assert_eq!((code, &doc["error"]["code"]), (Some(2), &Value::from("sweep::damaged")), "{doc}");
}

#[test]
#[cfg(unix)]
fn where_there_is_no_space_the_shard_at_work_is_lost_and_nothing_else() {
    let place = Place::new();
    let plan = place.plan("plan.toml", OFFSETS);
    let folder = place.path("sweep");
    assert_eq!(asked(&[&plan, "--shard", "0/3", "-o", &folder]).0, Some(0));
    // a limit on the size of files instead of a full disk: 4 blocks of 512 or 1024 bytes
    let script = format!(
        "trap '' XFSZ; ulimit -f 4; exec '{}' sweep '{plan}' --shards 3 -q --json -o '{folder}'",
        env!("CARGO_BIN_EXE_equipod")
    );
    let out = Command::new("sh").args(["-c", &script]).output().unwrap();
    assert_eq!(out.status.code(), Some(4), "{}", String::from_utf8_lossy(&out.stderr));
    assert_eq!(document(&out)["error"]["code"], "file::disk_full");
    let (_, doc) = asked(&["status", &folder]);
    assert_eq!((numbers(&doc["done"]), doc["unfinished"].as_array().unwrap().len()), (vec![0], 0), "{doc}");
    assert_eq!(asked(&[&plan, "-o", &folder]).0, Some(0));
    assert_eq!(asked(&["verify", &folder]).0, Some(0));
}

#[test]
fn candidates_are_designs_and_failures_are_rows() {
    let place = Place::new();
    let plan = place.plan(
        "plan.toml",
        "compute = ['spacing']\n[vary]\nby = 'grid'\nvalues = { 'base.P2.y' = [11.0, 0.0, 12] }\n",
    );
    let folder = place.path("sweep");
    let (code, doc) = asked(&[&plan, "-o", &folder]);
    assert_eq!(
        (code, &doc["rows"], &doc["failed"], &doc["shards"]),
        (Some(0), &3.into(), &1.into(), &3.into()),
        "{doc}"
    );
    let design = place.path("candidate.toml");
    assert_eq!(asked(&["design", &folder, "--candidate", "2", "-o", &design]).0, Some(0));
    assert!(std::fs::read_to_string(&design).unwrap().contains("P2 = [6, 12.0, 0]"));
    assert_eq!(equipod(&["check", &design]).status.code(), Some(0));
    assert_eq!(asked(&["design", &folder, "--candidate", "1"]).1["error"]["code"], "sweep::no_design");
    assert_eq!(asked(&["design", &folder, "--candidate", "3"]).1["error"]["code"], "sweep::no_candidate");
    // the requested design is written to standard output as it is
    let out = equipod(&["sweep", "design", &folder, "--candidate", "0"]);
    assert!(String::from_utf8(out.stdout).unwrap().contains("P2 = [6, 11.0, 0]"));
}

#[test]
fn the_table_of_poses_of_a_workspace_belongs_to_the_sweep() {
    let place = Place::new();
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(BASE)).unwrap();
    std::fs::create_dir(place.path("data")).unwrap();
    std::fs::write(
        place.path("base.toml"),
        text.replace("[workspace]\n", "[workspace]\ntrajectory = 'data/path.csv'\nrelative_to = 'home'\n"),
    )
    .unwrap();
    let table = |rows: &str| std::fs::write(place.path("data/path.csv"), rows).unwrap();
    let plan = place.path("plan.toml");
    let vary = "[vary]\nby = 'grid'\nvalues = { 'home.position.3' = [13, 14, 15, 16] }\n";
    std::fs::write(&plan, format!("name = 'test'\ndesign = 'base.toml'\ncompute = ['length_range']\n{vary}"))
        .unwrap();
    let (one, two, best) = (place.path("one"), place.path("two"), place.path("best"));
    table("0,0,1,0,0,0\n0,0,2,0,0,0\n");
    let (code, doc) = asked(&[&plan, "--shard", "0/2", "-o", &one]);
    assert_eq!((code, numbers(&doc["done"])), (Some(0), vec![0]), "{doc}");
    // other poses make another sweep
    table("0,0,1,0,0,0\n0,0,3,0,0,0\n");
    assert_eq!(asked(&[&plan, "-o", &one]).1["error"]["code"], "sweep::other_sweep");
    let (code, other) = asked(&[&plan, "--shards", "2", "-o", &two]);
    assert!(code == Some(0) && other["plan_sha256"] != doc["plan_sha256"], "{other}");
    assert_ne!(parts(&one)[0].1, parts(&two)[0].1);
    table("0,0,1,0,0,0\n0,0,2,0,0,0\n");
    assert_eq!(asked(&[&plan, "-o", &one]).0, Some(0));
    // the folder alone is enough from here on
    std::fs::remove_dir_all(place.path("data")).unwrap();
    let (code, doc) = asked(&["verify", &one, "--sample", "4"]);
    assert_eq!((code, numbers(&doc["sampled"]).len()), (Some(0), 4), "{doc}");
    let (code, doc) = asked(&["best", &one, "--by", "greatest_length", "--count", "2", "-o", &best]);
    assert_eq!(code, Some(0), "{doc}");
    let candidate = doc["candidates"][0]["output"].as_str().unwrap();
    assert_eq!(std::fs::read_to_string(place.path("best/path.csv")).unwrap(), "0,0,1,0,0,0\n0,0,2,0,0,0\n");
    assert_eq!(equipod(&["check", candidate]).status.code(), Some(0));
    // another file is not written over
    std::fs::write(place.path("path.csv"), "0,0,0,0,0,0\n").unwrap();
    let design = place.path("candidate.toml");
    let (code, doc) = asked(&["design", &one, "--candidate", "2", "-o", &design]);
    assert_eq!((code, doc["error"]["code"].as_str()), (Some(2), Some("sweep::other_poses")));
    assert!(!Path::new(&design).exists());
    std::fs::remove_file(place.path("path.csv")).unwrap();
    assert_eq!(asked(&["design", &one, "--candidate", "2", "-o", &design]).0, Some(0));
    assert_eq!(equipod(&["check", &design]).status.code(), Some(0));
    table_is_named(&plan, &place);
}

/// A table that is not there, or that is none, is refused by its name.
fn table_is_named(plan: &str, place: &Place) {
    let refused = || asked(&[plan, "-o", &place.path("new")]).1["error"]["code"].clone();
    assert_eq!(refused(), "file::not_readable");
    std::fs::create_dir(place.path("data")).unwrap();
    std::fs::write(place.path("data/path.csv"), "0,0\n").unwrap();
    assert_eq!(refused(), "design::bad_trajectory");
}

#[test]
fn what_is_refused_says_why() {
    let place = Place::new();
    let plan = place.plan("plan.toml", OFFSETS);
    let folder = place.path("sweep");
    assert_eq!(asked(&[&plan, "--shards", "2", "-o", &folder]).0, Some(0));
    let code = |args: &[&str]| asked(args).1["error"]["code"].as_str().map(str::to_owned);
    let other = place.plan("other.toml", &OFFSETS.replace("0.9", "0.8"));
    assert_eq!(code(&[&other, "-o", &folder]).as_deref(), Some("sweep::other_sweep"));
    assert_eq!(code(&[&plan, "--seed", "2", "-o", &folder]).as_deref(), Some("sweep::other_sweep"));
    assert_eq!(code(&[&plan, "--shard", "0/3", "-o", &folder]).as_deref(), Some("sweep::other_sweep"));
    assert_eq!(
        code(&[&plan, "--shard", "1/2", "--shard-offset", "2", "-o", &folder]).as_deref(),
        Some("sweep::no_shard")
    );
    assert_eq!(code(&[&plan, "--shard", "x", "-o", &folder]).as_deref(), Some("usage"));
    assert_eq!(code(&[&plan]).as_deref(), Some("usage"), "a folder is needed");
    assert_eq!(code(&["status", &place.path("nowhere")]).as_deref(), Some("sweep::no_sweep"));
    let (exit, doc) = asked(&[&place.plan("bad.toml", "compute = ['det_b']\nvery = 1\n"), "-o", &folder]);
    assert_eq!((exit, &doc["error"]["code"]), (Some(2), &Value::from("sweep::bad_plan")));
    let violations = doc["error"]["violations"].as_array().unwrap();
    let has = |line: u64, help: &str| {
        violations.iter().any(|v| v["line"] == line && v["help"].as_str().unwrap().contains(help))
    };
    assert!(has(3, "did you mean `det_a`?") && has(4, "did you mean `vary`?"), "{violations:#?}");
    let (exit, doc) = asked(&[&plan, "--estimate"]);
    assert_eq!((exit, &doc["candidates"], &doc["sampled"]), (Some(0), &300.into(), &24.into()));
    let lost = place.path("lost.toml");
    std::fs::write(&lost, "name = 'x'\ndesign = 'no-such.toml'\n").unwrap();
    assert_eq!(code(&[&lost, "-o", &folder]).as_deref(), Some("file::not_readable"));
}

#[test]
#[ignore = "evidence"]
fn the_best_candidates_are_designs_side_by_side() {
    let place = Place::new();
    let (plan, folder, best) = (place.plan("plan.toml", OFFSETS), place.path("sweep"), place.path("best"));
    assert_eq!(asked(&["run", &plan, "-o", &folder]).0, Some(0));
    let ranked = |more: &[&str]| {
        asked(&[&["best", &folder, "--by", "conditioning", "--count", "3", "-o", &best], more].concat())
    };
    let values = |doc: &Value| -> Vec<f64> {
        doc["candidates"].as_array().unwrap().iter().map(|c| c["value"].as_f64().unwrap()).collect()
    };
    let (code, high) = ranked(&[]);
    let (_, all) =
        asked(&["best", &folder, "--by", "conditioning", "--count", "8", "-o", &place.path("all")]);
    let (high_values, all_values) = (values(&high), values(&all));
    assert_eq!((code, high_values.len()), (Some(0), 3));
    assert!(all["rows"].as_u64().unwrap() > 100, "{}", all["rows"]);
    assert_eq!(high_values, all_values[..3]);
    assert!(all_values.windows(2).all(|w| w[0] >= w[1]), "{all_values:?}");
    // each file is the candidate, and the page holds all of them
    let page = std::fs::read_to_string(high["page"].as_str().unwrap()).unwrap();
    for c in high["candidates"].as_array().unwrap() {
        let file = c["output"].as_str().unwrap();
        let number = c["candidate"].to_string();
        let (_, design) = asked(&["design", &folder, "--candidate", &number]);
        assert_eq!(std::fs::read_to_string(file).unwrap(), design["text"].as_str().unwrap());
        assert!(page.contains(&format!("candidate-{number}.toml")));
    }
    let (_, low) = ranked(&["--better", "low"]);
    assert!(values(&low).windows(2).all(|w| w[0] <= w[1]) && values(&low)[2] <= all_values[7]);
    // without the two best ones the third is first
    let (_, kept) = ranked(&["--keep", &format!("conditioning<{}", all_values[1])]);
    assert_eq!(values(&kept)[0].to_bits(), all_values[2].to_bits());
    assert_eq!(kept["rows"].as_u64().unwrap(), all["rows"].as_u64().unwrap() - 2);
    let (code, none) = ranked(&["--keep", "conditioning>2"]);
    assert_eq!((code, none["page"].is_null(), values(&none).len()), (Some(1), true, 0));
    let (code, refused) = asked(&["best", &folder, "--by", "conditionin", "-o", &best]);
    assert_eq!((code, refused["error"]["code"].as_str()), (Some(2), Some("sweep::no_column")));
}
