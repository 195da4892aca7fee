//! Answers of all commands in their different outcomes: each is the schema's and the type's, to the last key, and planted faults are seen by both.

mod asked;
mod validator;

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use equipod::records::{
    AssessAnswer, BenchAnswer, CalibrateAnswer, CheckAnswer, CompareAnswer, CompletionsAnswer,
    ComponentsAnswer, ConvertAnswer, Document, DrivesAnswer, ErrorAnswer, ExploreAnswer, ExportAnswer,
    FamilyAnswer, FkAnswer, FkRunRecord, HelpAnswer, IkAnswer, LimitsAnswer, LocusAnswer, ManAnswer,
    MapAnswer, MotionAnswer, MoveAnswer, NearestAnswer, NewAnswer, OptimizeAnswer, PlotAnswer, PresetsAnswer,
    ReportAnswer, RoundAnswer, SchemaAnswer, SelfmotionAnswer, SingularitiesAnswer, SweepBestAnswer,
    SweepDesignAnswer, SweepMergeAnswer, SweepRunAnswer, SweepScriptAnswer, SweepStatusAnswer,
    SweepVerifyAnswer, TolerancesAnswer, TopologiesAnswer, VerifyAnswer, ViewAnswer, schema, schema_names,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};

use self::asked::{Files, asked, seen};
pub(crate) use self::validator::Validator;
use super::cli_frame::equipod;

/// Reads a document as its type and writes it again.
type Reread = fn(&str) -> Result<String, String>;

fn reread<T: Serialize + DeserializeOwned>(text: &str) -> Result<String, String> {
    let document: Document<T> = serde_json::from_str(text).map_err(|e| e.to_string())?;
    serde_json::to_string(&document).map_err(|e| e.to_string())
}

const TYPES: &[(&str, Reread)] = &[
    ("assess", reread::<AssessAnswer>),
    ("bench", reread::<BenchAnswer>),
    ("build-drives", reread::<DrivesAnswer>),
    ("build-round", reread::<RoundAnswer>),
    ("build-tolerances", reread::<TolerancesAnswer>),
    ("check", reread::<CheckAnswer>),
    ("design-convert", reread::<ConvertAnswer>),
    ("design-presets", reread::<PresetsAnswer>),
    ("design-schema", reread::<SchemaAnswer>),
    ("equivalents-components", reread::<ComponentsAnswer>),
    ("equivalents-family", reread::<FamilyAnswer>),
    ("equivalents-map", reread::<MapAnswer>),
    ("equivalents-move", reread::<MoveAnswer>),
    ("equivalents-nearest", reread::<NearestAnswer>),
    ("equivalents-topologies", reread::<TopologiesAnswer>),
    ("error", reread::<ErrorAnswer>),
    ("explore", reread::<ExploreAnswer>),
    ("export", reread::<ExportAnswer>),
    ("fk", reread::<FkAnswer>),
    ("help", reread::<HelpAnswer>),
    ("ik", reread::<IkAnswer>),
    ("limits", reread::<LimitsAnswer>),
    ("new", reread::<NewAnswer>),
    ("optimize", reread::<OptimizeAnswer>),
    ("plot", reread::<PlotAnswer>),
    ("plot-locus", reread::<LocusAnswer>),
    ("report", reread::<ReportAnswer>),
    ("shell-completions", reread::<CompletionsAnswer>),
    ("shell-man", reread::<ManAnswer>),
    ("singular-motion", reread::<SelfmotionAnswer>),
    ("singular-poses", reread::<SingularitiesAnswer>),
    ("compare", reread::<CompareAnswer>),
    ("motion", reread::<MotionAnswer>),
    ("sweep-best", reread::<SweepBestAnswer>),
    ("sweep-design", reread::<SweepDesignAnswer>),
    ("sweep-merge", reread::<SweepMergeAnswer>),
    ("sweep-run", reread::<SweepRunAnswer>),
    ("sweep-script", reread::<SweepScriptAnswer>),
    ("sweep-status", reread::<SweepStatusAnswer>),
    ("sweep-verify", reread::<SweepVerifyAnswer>),
    ("calibrate", reread::<CalibrateAnswer>),
    ("verify", reread::<VerifyAnswer>),
    ("view", reread::<ViewAnswer>),
];

/// Keys that an answer may lack: help and path of refusals, what an option adds, what only some outcome has.
const OPTIONAL: &[&str] = &[
    "help",
    "path",
    "near",
    "closure",
    "notes",
    "exchanged",
    "alignment",
    "output",
    "counterexample",
    "real_pose",
    "sampling",
    "beyond_precision",
    "instance",
    "by_virtual_legs",
    "design",
    "rearrangements",
    "conflict",
    "history",
    "nearest",
    "base",
    "platform",
    "squared_lengths",
    "between",
    "four_planes",
    "freedoms",
    "drives",
    "drive_search",
    "symmetry",
    "flexures",
];
/// Keys of whole designs.
const DESIGNS: [&str; 3] = ["design", "beside", "octahedral"];
/// Objects whose keys are names or numbers.
const MAPS: &[&str] = &["base", "platform", "finite_counts", "real_counts"];

/// One command with what was seen of it.
struct Command {
    name: &'static str,
    schema: Map<String, Value>,
    reread: Reread,
    /// Places at which faults were planted, one of each kind.
    kinds: BTreeSet<String>,
}

impl Command {
    fn new(name: &'static str) -> Self {
        let (_, reread) = TYPES.iter().find(|(of, _)| *of == name).unwrap();
        Self { name, schema: schema(name).unwrap(), reread: *reread, kinds: BTreeSet::new() }
    }

    fn faults(&self, document: &Value) -> Vec<String> {
        let schema = Validator::new(&self.schema).check(document).err().map(|f| f.to_string());
        let text = document.to_string();
        let type_ = match (self.reread)(&text) {
            Ok(again) if again == text => None,
            Ok(again) => Some(format!("read and written again: {}", difference(&text, &again))),
            Err(why) => Some(format!("not read: {why}")),
        };
        schema.map(|f| format!("schema: {f}")).into_iter().chain(type_).collect()
    }

    /// Faults that the schema or the type does not see.
    fn overlooked(&mut self, document: &Value) -> Vec<String> {
        let document = short(document);
        let whole = self.faults(&document);
        if !whole.is_empty() {
            return whole;
        }
        let mut missed = Vec::new();
        let mut places = Vec::new();
        walk(&document, &mut Vec::new(), "", &mut places);
        for (path, kind) in places {
            // a schema is any object
            if path.first().is_some_and(|k| k == "schema") && path.len() > 1 || !self.kinds.insert(kind) {
                continue;
            }
            for (what, spoilt) in spoilt(&document, &path) {
                let place = path.join("/");
                if Validator::new(&self.schema).check(&spoilt).is_ok() {
                    missed.push(format!("{what} at {place}: the schema does not see it"));
                }
                let text = spoilt.to_string();
                // a design in an answer is any JSON to the type: its own schema is the one that knows it
                let is_design = path.iter().any(|k| DESIGNS.contains(&k.as_str()))
                    && self.name != "equivalents-topologies";
                if !is_design && (self.reread)(&text).is_ok_and(|again| again == text) {
                    missed.push(format!("{what} at {place}: the type does not see it"));
                }
            }
        }
        missed
    }
}

fn difference(a: &str, b: &str) -> String {
    let at = a.bytes().zip(b.bytes()).take_while(|(x, y)| x == y).count();
    let part = |s: &str| s.get(at.saturating_sub(40)..(at + 40).min(s.len())).unwrap_or("").to_owned();
    format!("{} / {}", part(a), part(b))
}

/// The first two of long lists: the others are alike.
fn short(value: &Value) -> Value {
    match value {
        Value::Array(list) => {
            list.iter().take(if list.len() <= 8 { list.len() } else { 2 }).map(short).collect()
        }
        Value::Object(fields) => Value::Object(fields.iter().map(|(k, v)| (k.clone(), short(v))).collect()),
        other => other.clone(),
    }
}

/// All places in a document, each with its kind: indices of lists do not count, the keys of objects in them do.
fn walk(value: &Value, path: &mut Vec<String>, kind: &str, out: &mut Vec<(Vec<String>, String)>) {
    let shape = |v: &Value| match v {
        Value::Object(fields) => fields.keys().cloned().collect::<Vec<_>>().join(","),
        Value::Array(_) => "list".into(),
        Value::Null => "null".into(),
        Value::Bool(_) => "truth".into(),
        Value::Number(_) => "number".into(),
        Value::String(_) => "text".into(),
    };
    if !path.is_empty() {
        out.push((path.clone(), kind.to_owned()));
    }
    let inner: Vec<(String, &Value)> = match value {
        Value::Object(fields) => fields.iter().map(|(k, v)| (k.clone(), v)).collect(),
        Value::Array(list) => list.iter().enumerate().map(|(k, v)| (k.to_string(), v)).collect(),
        _ => return,
    };
    for (key, part) in inner {
        let step = if value.is_object() { key.as_str() } else { "*" };
        let kind = format!("{kind}/{step}:{}", shape(part));
        path.push(key);
        walk(part, path, &kind, out);
        path.pop();
    }
}

/// The document with a value of a wrong kind, an unknown key and a missing key at a place, as far as these are faults there.
fn spoilt(document: &Value, path: &[String]) -> Vec<(&'static str, Value)> {
    let with = |change: &dyn Fn(&mut Value)| {
        let mut copy = document.clone();
        let place = path.iter().fold(&mut copy, |place, key| match place {
            Value::Array(list) => &mut list[key.parse::<usize>().unwrap()],
            other => &mut other[key.as_str()],
        });
        change(place);
        copy
    };
    let (key, above) = path.split_last().unwrap();
    let mut out = vec![(
        "wrong kind",
        with(&|v| {
            *v = match v {
                Value::Object(_) => json!(7.5),
                // a coordinate may be a text or a number, radii of holes a number or a list
                Value::String(_) | Value::Array(_) => json!(true),
                _ => json!({"no": "such"}),
            };
        }),
    )];
    if path != ["schema"] {
        let unknown = with(&|v| {
            if let Value::Object(fields) = v {
                fields.insert("no such key".into(), "no such value".into());
            }
        });
        if unknown != *document {
            out.push(("unknown key", unknown));
        }
    }
    let optional = OPTIONAL.contains(&key.as_str())
        || path.iter().any(|k| DESIGNS.contains(&k.as_str()))
        || above.last().is_some_and(|k| MAPS.contains(&k.as_str()));
    let mut lacking = document.clone();
    let holder = above.iter().fold(&mut lacking, |place, key| match place {
        Value::Array(list) => &mut list[key.parse::<usize>().unwrap()],
        other => &mut other[key.as_str()],
    });
    if let (Value::Object(fields), false) = (holder, optional) {
        fields.shift_remove(key);
        out.push(("missing key", lacking));
    }
    out
}

/// Asks and compares; complaints by call.
fn compare(wanted: impl Fn(&str) -> bool) -> (Files, Vec<String>) {
    let mut files = Files::new();
    let mut commands: BTreeMap<&str, Command> = BTreeMap::new();
    let mut complaints = Vec::new();
    for (exit, name, words) in asked(&mut files, wanted) {
        let words: Vec<&str> = words.iter().map(String::as_str).chain(["--json"]).collect();
        let command = commands.entry(name).or_insert_with(|| Command::new(name));
        let out = equipod(&words);
        let title = words.join(" ");
        if out.status.code() != Some(exit) {
            complaints.push(format!("{title}: exit {:?} instead of {exit}", out.status.code()));
        }
        let text = String::from_utf8(out.stdout).unwrap();
        let text = text.trim_end();
        let Ok(document) = serde_json::from_str::<Value>(text) else {
            complaints.push(format!("{title}: {text:.100} is not JSON"));
            continue;
        };
        // what the program wrote, not only what is read from it
        let written = document.to_string();
        if written != text {
            complaints.push(format!("{title}: {}", difference(text, &written)));
        }
        let faults = command.faults(&document);
        let found = if faults.is_empty() { command.overlooked(&document) } else { faults };
        complaints.extend(found.into_iter().take(5).map(|f| format!("{title}: {f}")));
    }
    (files, complaints)
}

/// Groups of schemas, so that the tests run side by side.
const GROUPS: [&[&str]; 4] = [
    &[
        "fk",
        "limits",
        "ik",
        "new",
        "bench",
        "help",
        "error",
        "plot",
        "plot-locus",
        "design-schema",
        "design-presets",
        "design-convert",
    ],
    &[
        "optimize",
        "assess",
        "compare",
        "motion",
        "calibrate",
        "build-drives",
        "build-round",
        "view",
        "export",
        "shell-completions",
        "shell-man",
    ],
    &[
        "explore",
        "report",
        "verify",
        "equivalents-map",
        "equivalents-family",
        "equivalents-nearest",
        "build-tolerances",
    ],
    &[
        "check",
        "equivalents-components",
        "equivalents-move",
        "equivalents-topologies",
        "singular-motion",
        "singular-poses",
        "sweep-run",
        "sweep-status",
        "sweep-verify",
        "sweep-merge",
        "sweep-best",
        "sweep-design",
        "sweep-script",
    ],
];

#[test]
fn every_schema_has_a_type_a_call_and_a_group() {
    let names: BTreeSet<&str> = schema_names().collect();
    assert_eq!(names, TYPES.iter().map(|(name, _)| *name).collect());
    assert_eq!(names, seen().collect());
    assert_eq!(names, GROUPS.iter().flat_map(|g| g.iter().copied()).collect());
}

#[test]
#[ignore = "slow evidence"]
fn answers_about_poses_and_files() {
    let (_, complaints) = compare(|name| GROUPS[0].contains(&name));
    assert!(complaints.is_empty(), "{complaints:#?}");
}

#[test]
#[ignore = "slow evidence"]
fn answers_about_the_best_platform_and_its_making() {
    let (_, complaints) = compare(|name| GROUPS[1].contains(&name));
    assert!(complaints.is_empty(), "{complaints:#?}");
}

#[test]
#[ignore = "slow evidence"]
fn answers_about_equivalence_and_the_files_of_explore() {
    let (files, complaints) = compare(|name| GROUPS[2].contains(&name));
    assert!(complaints.is_empty(), "{complaints:#?}");
    for (file, name) in [("family", "equivalents-family"), ("optimize", "optimize"), ("verify", "verify")] {
        let text = fs::read_to_string(files.beside("explored").join(format!("{file}.json"))).unwrap();
        let document: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(Command::new(name).faults(&document), [""; 0], "{file}.json");
    }
    // the poses of `explore` are those of `fk` with the lengths they belong to
    let text = fs::read_to_string(files.beside("explored/fk.json")).unwrap();
    assert_eq!(reread::<FkRunRecord>(&text).unwrap(), text.trim_end());
    let mut document: Map<String, Value> = serde_json::from_str(&text).unwrap();
    for key in ["lengths", "lengths_from"] {
        assert!(document.shift_remove(key).is_some(), "{key}");
    }
    assert_eq!(Command::new("fk").faults(&Value::Object(document)), [""; 0]);
}

#[test]
#[ignore = "slow evidence"]
fn answers_about_legs_and_singular_poses() {
    let (_, complaints) = compare(|name| GROUPS[3].contains(&name));
    assert!(complaints.is_empty(), "{complaints:#?}");
}

#[test]
fn a_document_that_is_not_of_its_schema_is_found() {
    let command = Command::new("report");
    let good = json!({"schema_version": 1, "output": "a", "files": 3, "assessment": null, "provenance": {"version": "0", "seed": null, "designs": [], "files": []}, "warnings": []});
    assert_eq!(command.faults(&good), [""; 0]);
    for (path, bad) in [
        ("/schema_version", json!(2)),
        ("/files", json!(-1.5)),
        ("/provenance/seed", json!("7")),
        ("/provenance/designs", json!([{"name": "a", "path": null, "sha256": "ab"}])),
    ] {
        let mut document = good.clone();
        *document.pointer_mut(path).unwrap() = bad;
        assert!(Validator::new(&command.schema).check(&document).is_err(), "{path}");
    }
}
