//! Every reader of user input against files that are nearly right: designs, tables of lengths and of poses. Also
//! answers read back, folders of results, requests of the page.
//!
//! Whatever a file contains, the program ends by itself with 0, 1, 2 or 3 and one JSON document. The document has an
//! error record when the code is 2. Exit 4 would be a panic. The program takes at most 1 GiB of memory. In a build with
//! optimisation it takes at most two seconds of processor time to read or refuse a file. It takes at most ten to
//! compute with the input: lengths of 1e19 are valid numbers. Beyond that the system ends it, which is a fault.
//!
//! Cases are drawn from a fixed seed and named by their number: `EQUIPOD_FUZZ_SEED` takes another seed,
//! `EQUIPOD_FUZZ_CASES` that many times as many cases. Ten thousand inputs:
//!
//! ```sh
//! EQUIPOD_FUZZ_CASES=50 cargo test --profile evidence --test it mutated_inputs
//! ```
//!
//! The targets of `tests/fuzz` search for inputs by coverage in the same readers.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use equipod::methods::design::{PointTable, SeriesKind, read_poses, read_poses_with_lengths};
use equipod::methods::page::Session;
use equipod::prelude::{Pose, PoseConvention};
use serde_json::Value;

mod mutate;
use super::evidence::size;
use mutate::{Draw, mutated};

/// Longer than any processor time allowed, on a machine that has much else to do.
const SLOWEST: Duration = Duration::from_secs(600);
/// Processor time of a run that reads, and of one that computes, seconds; ten times as much without optimisation.
const PROCESSOR_SECONDS: [u32; 2] = if cfg!(debug_assertions) { [20, 100] } else { [2, 10] };
/// Memory of a run, KiB.
const MEMORY: u32 = 1 << 20;
/// Runs a program within these limits, where the system has them.
const WITHIN: &str = r#"ulimit -t "$0" 2>/dev/null; ulimit -v "$1" 2>/dev/null; shift; exec "$@""#;
const OCTAHEDRAL: &str = include_str!("../../../designs/rbt-octahedral.toml");
const CONSTRUCTED: &str = include_str!("../../fixtures/constructed.toml");
const LENGTHS: &str = "l1,l2,l3,l4,l5,l6\n# home\n17,16,15,17,16,15\n16.5,16.25,15.75,17,16,15.5\n";
const POSES: &str = "x,y,z,roll,pitch,yaw\n3,5,15,0,0,0\n3,5,16,1,-2,3\n3,5,16.5,1,0,0,0\n";
const FRONT: &str = r#"{"schema_version":1,"provenance":{"version":"0.2.0","seed":7,"designs":[],"files":[]},"front":[
{"objectives":[{"name":"worst_conditioning","value":0.25,"unit":""},{"name":"stiffness","value":1200.5,"unit":"N/mm"}],"design":{"name":"a front"}},
{"objectives":[{"name":"worst_conditioning","value":0.5,"unit":""},{"name":"stiffness","value":800.25,"unit":"N/mm"}],"design":{"name":"a front"}}],"warnings":[]}"#;
const ANSWER: &str = r#"{"schema_version":1,"provenance":{"version":"0.2.0","seed":7,"designs":[],"files":[]},"verdict":"not_equivalent","explanation":"a pose tells them apart","offsets":[0.25,0.5,0.25,0.5,0.25,0.5],
"relation":"regular","determinant":22.1,"solutions":[{"real":true,"certified":true,"p":[1.0,2.0,3.0]}],"warnings":[]}"#;
const PICTURE: &str = r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><title>a &amp; b</title><desc>c</desc><path d="M0 0L1 1"/></svg>"#;

fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// The first of `cases` mutations of `files` with which `read` finds a fault, as number of the case and fault.
fn first_fault(
    files: &[&[u8]],
    cases: u64,
    mut read: impl FnMut(&[u8], &mut Draw) -> Result<(), String>,
) -> Option<(u64, String)> {
    let seed = from_environment("EQUIPOD_FUZZ_SEED", 1);
    (0..cases * from_environment("EQUIPOD_FUZZ_CASES", 1)).find_map(|case| {
        let mut draw = Draw::of_case(seed, case);
        let file = draw.one(files);
        let bytes = mutated(&mut draw, file, files);
        read(&bytes, &mut draw).err().map(|fault| (case, fault))
    })
}

/// The fault in the end of the program, if there is one.
fn verdict_of(out: &Output) -> Result<(), String> {
    let fault = |what: &str| {
        let shown = |bytes: &[u8]| String::from_utf8_lossy(bytes).chars().take(400).collect::<String>();
        Err(format!("{what}: {:?} {} {}", out.status, shown(&out.stdout), shown(&out.stderr)))
    };
    let Some(code @ 0..=3) = out.status.code() else { return fault("a panic or a kill") };
    let Ok(document) = serde_json::from_slice::<Value>(&out.stdout) else { return fault("no JSON document") };
    if document["schema_version"] != 1 || !document["warnings"].is_array() {
        return fault("not the document of an answer");
    }
    let error = &document["error"];
    let is_record = |key: &str| error[key].as_str().is_some_and(|text| !text.is_empty());
    if (code == 2) == error.is_null() || (code == 2 && !(is_record("code") && is_record("message"))) {
        return fault("the error record does not fit the code");
    }
    Ok(())
}

/// A command that runs its further arguments with limits of processor time (seconds) and of memory.
fn within(limits: [u32; 2]) -> Command {
    let mut command = Command::new("sh");
    command.args(["-c", WITHIN]).args(limits.map(|limit| limit.to_string()));
    command
}

/// Runs the program with `--json` and checks how it ends.
fn program(args: &[&str]) -> Result<(), String> {
    let computes = ["fk", "calibrate", "build", "report"].contains(&args[0]);
    let child = within([PROCESSOR_SECONDS[usize::from(computes)], MEMORY])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .arg(env!("CARGO_BIN_EXE_equipod"))
        .args(args)
        .arg("--json")
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = child.map_err(|e| e.to_string())?;
    let pipes = (child.stdout.take(), child.stderr.take());
    // pipes are emptied meanwhile, or a long answer would wait for ever
    let read = |pipe: Option<Box<dyn std::io::Read + Send>>| {
        std::thread::spawn(move || {
            let mut bytes = Vec::new();
            pipe.map(|mut p| p.read_to_end(&mut bytes));
            bytes
        })
    };
    let stdout = read(pipes.0.map(|p| Box::new(p) as _));
    let stderr = read(pipes.1.map(|p| Box::new(p) as _));
    let began = Instant::now();
    let status = loop {
        match child.try_wait().map_err(|e| e.to_string())? {
            Some(status) => break status,
            None if began.elapsed() > SLOWEST => {
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!("no end within {SLOWEST:?}"));
            }
            None => std::thread::sleep(Duration::from_millis(2)),
        }
    };
    verdict_of(&Output { status, stdout: stdout.join().unwrap(), stderr: stderr.join().unwrap() })
}

/// A file in a folder of its own.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        Self { folder: tempfile::tempdir().unwrap() }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, bytes: &[u8]) -> String {
        let path = self.path(name);
        std::fs::write(&path, bytes).unwrap();
        path.to_str().unwrap().to_owned()
    }
}

fn designs() -> Vec<Vec<u8>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|e| e.unwrap().path()).collect();
    paths.retain(|p| p.extension().is_some_and(|e| e == "toml"));
    paths.sort();
    // joints in all the ways there are
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    paths.extend(["constructed.toml", "constructed.json"].map(|name| fixtures.join(name)));
    paths.iter().map(|p| std::fs::read(p).unwrap()).collect()
}

#[track_caller]
fn sound(found: Option<(u64, String)>) {
    if let Some((case, fault)) = found {
        panic!("case {case}: {fault}");
    }
}

#[test]
fn designs_are_read_or_refused() {
    let (place, files) = (Place::new(), designs());
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    let out = place.path("out.toml");
    sound(first_fault(&files, 60, |bytes, draw| {
        let design = place.write(["d.toml", "d.json"][draw.below(2)], bytes);
        program(&["design", "convert", &design, "-o", out.to_str().unwrap()])
    }));
}

#[test]
fn tables_of_lengths_and_of_poses_are_read_or_refused() {
    let place = Place::new();
    sound(first_fault(&[LENGTHS.as_bytes()], 30, |bytes, _| {
        let table = place.write("lengths.csv", bytes);
        program(&["fk", "designs/rbt-octahedral.toml", "--lengths", &table])
    }));
    let text = OCTAHEDRAL.replace("[workspace]", "[workspace]\ntrajectory = \"path.csv\"");
    assert_ne!(text, OCTAHEDRAL);
    let design = place.write("d.toml", text.as_bytes());
    let out = place.path("out.toml");
    sound(first_fault(&[POSES.as_bytes()], 30, |bytes, _| {
        place.write("path.csv", bytes);
        program(&["design", "convert", &design, "-o", out.to_str().unwrap()])
    }));
}

type Words = &'static [&'static str];

/// Points of legs, sheets of motion-simulator programs, measurements, drives, plans of sweeps.
#[test]
fn tables_sheets_and_plans_are_read_or_refused() {
    let place = Place::new();
    let whole =
        |name: &str| std::fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("designs").join(name)).unwrap();
    let out = place.path("out.toml").to_str().unwrap().to_owned();
    let sheet =
        b"L1 = 700\nL2 = 120\nL3 = 250\nL4 = 900\ncrank = 90\nrod = 600\nmiddle_angle = 10\ncrank_angle_1 = 180\ncrank_angle_2 = 0\ncrank_angle_3 = 300\ncrank_angle_4 = 120\ncrank_angle_5 = 60\ncrank_angle_6 = 240\n".to_vec();
    let measured: Vec<u8> =
        whole("tables/calibration.csv").split_inclusive(|b| *b == b'\n').take(9).flatten().copied().collect();
    let plan = String::from_utf8(whole("sweeps/offsets.toml")).unwrap();
    let plan = plan.replace("../rbt", &format!("{}/designs/rbt", env!("CARGO_MANIFEST_DIR")));
    // drives and measurements are computed with, which takes seconds where they can be read
    let readers: [(Vec<u8>, &str, Words, Words, u64); 5] = [
        (whole("tables/hexapod.csv"), "points.csv", &["new", "--points"], &["-o"], 12),
        (sheet, "rig.txt", &["new", "--dialect", "motion4sim", "--sheet"], &["-o"], 12),
        (measured, "measured.csv", &["calibrate", "designs/symmetric-hexapod.toml"], &["-o"], size(3, 40)),
        (
            whole("tables/drives.csv"),
            "drives.csv",
            &["build", "drives", "designs/presets/bench-l16.toml"],
            &["-o"],
            size(0, 20),
        ),
        (plan.into_bytes(), "plan.toml", &["sweep", "run"], &["--estimate"], 12),
    ];
    for (bytes, name, before, after, cases) in &readers {
        sound(first_fault(&[bytes], *cases, |bytes, _| {
            let file = place.write(name, bytes);
            let mut args = before.to_vec();
            args.push(&file);
            args.extend(*after);
            if *after == ["-o"] {
                let _ = std::fs::remove_file(&out);
                args.push(&out);
            }
            program(&args)
        }));
    }
}

#[test]
fn answers_that_are_read_back_are_read_or_refused() {
    let place = Place::new();
    let picture = place.path("front.svg");
    sound(first_fault(&[FRONT.as_bytes(), ANSWER.as_bytes()], 40, |bytes, _| {
        let front = place.write("front.json", bytes);
        program(&["plot", "pareto", &front, "-o", picture.to_str().unwrap()])
    }));
}

/// The page of a report computes the figures of the first design, so that these cases are few.
#[test]
fn folders_of_results_are_reported_whatever_stands_in_a_file() {
    let place = Place::new();
    let files = [ANSWER.as_bytes(), FRONT.as_bytes(), PICTURE.as_bytes(), OCTAHEDRAL.as_bytes()];
    let folder = place.folder.path().to_str().unwrap().to_owned();
    sound(first_fault(&files, 8, |bytes, draw| {
        let names = ["verify.json", "optimize.json", "a.svg", "a.csv", "original.toml"];
        for name in names {
            let _ = std::fs::remove_file(place.path(name));
        }
        place.write("optimize.json", ANSWER.as_bytes());
        place.write(names[draw.below(names.len())], bytes);
        program(&["report", &folder])
    }));
}

/// A reader in this process: a panic is the fault.
fn quiet(read: impl FnOnce()) -> Result<(), String> {
    catch_unwind(AssertUnwindSafe(read)).map_err(|payload| {
        let text = payload.downcast_ref::<String>().cloned();
        text.or_else(|| payload.downcast_ref::<&str>().map(ToString::to_string)).unwrap_or_default()
    })
}

/// Lists of programs, JSON, printed matrices, settings of controllers, models of robots.
#[test]
fn texts_of_joints_and_poses_are_read_or_refused() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures");
    let mut paths: Vec<PathBuf> = ["readers", "models"]
        .iter()
        .flat_map(|name| std::fs::read_dir(folder.join(name)).unwrap().map(|entry| entry.unwrap().path()))
        .collect();
    paths.sort();
    let files: Vec<Vec<u8>> = paths.iter().map(|path| std::fs::read(path).unwrap()).collect();
    let files: Vec<&[u8]> = files.iter().map(Vec::as_slice).collect();
    let (usual, home) = (PoseConvention::default(), Pose::identity());
    let six = |text: &str| {
        let numbers = text.split(',').map(|cell| cell.parse::<f64>().map_err(|why| why.to_string()));
        numbers.collect::<Result<Vec<_>, _>>()
    };
    let read = |bytes: &[u8]| {
        let why = [
            PointTable::read(bytes).err().map(|why| why.to_string()),
            SeriesKind::Lengths.read(bytes, "mm", six).err().map(|why| why.to_string()),
            SeriesKind::Angles.read(bytes, "", six).err().map(|why| why.to_string()),
            read_poses(bytes, &usual, &home, "mm").err().map(|why| why.to_string()),
            read_poses_with_lengths(bytes, &usual, &home, "mm").err().map(|why| why.to_string()),
        ];
        assert!(why.iter().flatten().all(|sentence| !sentence.is_empty()));
        why.iter().filter(|why| why.is_none()).count()
    };
    // every file is one that some reader reads
    for (path, file) in paths.iter().zip(&files) {
        let is_part = ["points-objects.json", "points-printed.txt", "points-pins.hal"];
        let name = path.file_name().unwrap().to_str().unwrap();
        assert!(read(file) > 0 || is_part.contains(&name), "{name}");
    }
    sound(first_fault(&files, size(60, 20_000), |bytes, _| quiet(|| _ = read(bytes))));
}

#[test]
fn requests_of_the_page_are_answered_or_refused() {
    let pose = r#"{"R":[[1,0,0],[0,1,0],[0,0,1]],"p":[3,5,15]}"#;
    let chosen = r#"{"pattern":"S123456","offsets":[0.2,0.3,0.4,0.5,0.6,0.7]}"#;
    let opening = serde_json::json!({ "design": OCTAHEDRAL }).to_string();
    let session = Session::open(&opening).unwrap();
    let requests = [
        r#"{"op":"open"}"#.to_owned(),
        r#"{"op":"path","at":0.25}"#.to_owned(),
        r#"{"op":"start","pattern":"S123456"}"#.to_owned(),
        format!(r#"{{"op":"state","pose":{pose},"chosen":{chosen}}}"#),
        format!(r#"{{"op":"modes","pose":{pose},"lengths":[15,15,15,15,15,15],"which":"first"}}"#),
        format!(r#"{{"op":"plane","chosen":{chosen},"axes":[0,1],"range":[-0.5,1.5],"points":9}}"#),
        format!(r#"{{"op":"design","which":"second","chosen":{chosen}}}"#),
    ];
    let files: Vec<&[u8]> = requests.iter().map(String::as_bytes).collect();
    let answered = |text: &str| {
        let answer: Value = serde_json::from_str(&session.answer(text)).unwrap();
        assert!(answer.is_object(), "{answer}");
        answer["error"].is_null()
    };
    for request in &requests {
        assert!(answered(request), "{request}");
    }
    sound(first_fault(&files, 150, |bytes, _| quiet(|| _ = answered(&String::from_utf8_lossy(bytes)))));
    sound(first_fault(&[opening.as_bytes()], 40, |bytes, _| {
        quiet(|| {
            if let Err(refusal) = Session::open(&String::from_utf8_lossy(bytes)) {
                let refusal: Value = serde_json::from_str(&refusal).unwrap();
                assert!(refusal["error"]["code"].is_string());
            }
        })
    }));
}

/// Faults as readers have them are found in as many cases as the readers above get.
#[test]
fn planted_faults_are_found() {
    type Reader = fn(&str);
    let planted: [(&str, Reader); 4] = [
        ("a number that is no finite one", |text| {
            let numbers =
                text.split([',', '\n', ' ', '=', '[', ']']).filter_map(|f| f.trim().parse::<f64>().ok());
            numbers.for_each(|x| assert!(x.is_finite() && x.abs() < 1e300));
        }),
        ("a cut inside a character", |text| {
            // as columns of fixed width are read
            for line in text.lines() {
                for at in (0..line.len()).step_by(4) {
                    let _ = &line[at..];
                }
            }
        }),
        ("a line that lacks fields", |text| {
            for line in text.lines().filter(|l| l.contains(',') && !l.starts_with('#')) {
                let _ = line.split(',').nth(2).expect("a third field");
            }
        }),
        ("brackets deeper than a stack", |text| assert!(text.matches('[').count() < 10_000)),
    ];
    let missed: Vec<&str> = planted
        .iter()
        .filter(|(_, reader)| {
            let read = |bytes: &[u8], _: &mut Draw| quiet(|| reader(&String::from_utf8_lossy(bytes)));
            first_fault(&[OCTAHEDRAL, CONSTRUCTED, LENGTHS].map(str::as_bytes), 150, read).is_none()
        })
        .map(|(name, _)| *name)
        .collect();
    assert_eq!(missed, Vec::<&str>::new());
}

/// Runs that take too much time or memory do not end well.
#[cfg(target_os = "linux")]
#[test]
fn runs_beyond_their_limits_are_ended() {
    let endless = within([1, MEMORY]).args(["sh", "-c", "while :; do :; done"]).output().unwrap();
    assert_eq!(endless.status.code(), None);
    let small = within([1, 4096]).args([env!("CARGO_BIN_EXE_equipod"), "--version"]).output().unwrap();
    assert!(!small.status.success(), "{small:?}");
}

/// The ends of a run that the check has to refuse.
#[cfg(unix)]
#[test]
fn the_check_refuses_panics_kills_and_wrong_documents() {
    use std::os::unix::process::ExitStatusExt;
    let ended = |wait: i32, stdout: &str| Output {
        status: std::process::ExitStatus::from_raw(wait),
        stdout: stdout.into(),
        stderr: Vec::new(),
    };
    let yes = r#"{"schema_version":1,"warnings":[]}"#;
    let no = r#"{"schema_version":1,"error":{"code":"a::b","message":"c"},"warnings":[]}"#;
    assert!(
        verdict_of(&ended(0, yes)).is_ok()
            && verdict_of(&ended(3 << 8, yes)).is_ok()
            && verdict_of(&ended(2 << 8, no)).is_ok()
    );
    let bad =
        [(0, no), (2 << 8, yes), (4 << 8, no), (101 << 8, no), (9, yes), (0, ""), (0, "[]"), (0, "{}{}")];
    for (wait, stdout) in bad {
        assert!(verdict_of(&ended(wait, stdout)).is_err(), "{wait} {stdout}");
    }
}
