//! The JSON document of any answer, for reports and notebooks.

use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

use super as answers;
use crate::{Sheet, Table, left};
use num::shown::significant;
use records::{
    AssessAnswer, AtPoseAnswer, CheckAnswer, CompareAnswer, ComponentsAnswer, DrivesAnswer, FamilyAnswer,
    FkAnswer, FkOneAnswer, LimitsAnswer, MapAnswer, MotionAnswer, MoveSearchAnswer, MovesAnswer,
    NearestAnswer, OptimizeAnswer, RoundAnswer, SelfmotionAnswer, TolerancesAnswer, TopologiesAnswer,
    VerifyAnswer,
};

type Fields = Map<String, Value>;

/// The display of an answer's document: fields that identify the answer, a heading, and the sheet that its command
/// prints. The names are those of the designs.
struct DocumentKind(&'static [&'static str], &'static str, fn(&Fields, [&str; 2]) -> Option<Sheet>);

/// The kinds of documents; the first kind with all its fields present applies.
const KINDS: [DocumentKind; 20] = [
    DocumentKind(&["samples", "map"], "Equivalence", |f, [a, b]| {
        read(f).map(|x: VerifyAnswer| answers::verify(&x, a, b))
    }),
    DocumentKind(&["finite_count"], "Forward kinematics", |f, [a, _]| {
        let mut one: FkOneAnswer = read(f)?;
        let units = one.units.take()?;
        Some(answers::fk(a, &units, &FkAnswer::One(Box::new(one))))
    }),
    DocumentKind(&["status", "objective"], "Optimisation", |f, [a, _]| {
        read(f).map(|x: OptimizeAnswer| answers::optimize(a, &x))
    }),
    DocumentKind(&["patterns", "topologies"], "Equivalence class", |f, _| {
        read(f).map(|x: FamilyAnswer| answers::family(&x, false))
    }),
    DocumentKind(&["requirements", "regular"], "Requirements", |f, _| {
        read(f).map(|x: AssessAnswer| answers::assess(&x))
    }),
    DocumentKind(&["components", "planes"], "Replaceable legs", |f, _| {
        read(f).map(|x: ComponentsAnswer| answers::components(&x))
    }),
    DocumentKind(&["curves", "singular_values"], "Self-motions", |f, _| {
        read(f).map(|x: SelfmotionAnswer| answers::self_motion(&x))
    }),
    DocumentKind(&["topologies", "members"], "Topologies", |f, _| {
        read(f).map(|x: TopologiesAnswer| answers::topologies(&x))
    }),
    DocumentKind(&["steps", "moves_left_out"], "Moved legs", |f, _| {
        read(f).map(|x: MovesAnswer| answers::moves(&x))
    }),
    DocumentKind(&["targets", "patterns_searched"], "Equivalent platforms", |f, _| {
        read(f).map(|x: MoveSearchAnswer| answers::move_search(&x))
    }),
    DocumentKind(&["nearest", "extension"], "Nearest octahedral platform", |f, _| {
        read(f).map(|x: NearestAnswer| answers::nearest(&x))
    }),
    DocumentKind(&["exact", "nearest"], "Joints on holes", |f, _| {
        read(f).map(|x: RoundAnswer| answers::round(&x))
    }),
    DocumentKind(&["relation", "A"], "Leg map", |f, [a, b]| {
        read(f).map(|x: MapAnswer| answers::map(&x, a, b))
    }),
    DocumentKind(&["architecturally_singular"], "Architectural singularity", |f, _| {
        read(f).map(|x: CheckAnswer| answers::check(&x, true))
    }),
    DocumentKind(&["wrench_matrix", "resolution"], "At a pose", |f, _| {
        read(f).map(|x: AtPoseAnswer| answers::at_pose(&x))
    }),
    DocumentKind(&["axes", "violated"], "Limits", |f, [a, _]| {
        read(f).map(|x: LimitsAnswer| answers::limits(a, &x))
    }),
    DocumentKind(&["motions", "stiffness"], "Motion", |f, _| {
        read(f).map(|x: MotionAnswer| answers::motion(&x))
    }),
    DocumentKind(&["trials", "joints"], "Tolerances", |f, [a, _]| {
        read(f).map(|x: TolerancesAnswer| answers::tolerances(a, &x, "equipod assess, with this design"))
    }),
    DocumentKind(&["drives", "chosen"], "Drives", |f, _| read(f).map(|x: DrivesAnswer| answers::drives(&x))),
    DocumentKind(&["designs", "manoeuvres"], "Comparison", |f, _| {
        read(f).map(|x: CompareAnswer| answers::compare(&x))
    }),
];

fn kind(fields: &Fields) -> Option<&'static DocumentKind> {
    KINDS.iter().find(|kind| kind.0.iter().all(|key| fields.contains_key(*key)))
}

/// The heading for the document of an answer.
#[must_use]
pub fn heading(fields: &Fields) -> &'static str {
    kind(fields).map_or("Result", |kind| kind.1)
}

/// The sheet that the command of the answer prints. An answer without such a sheet, or of another version with missing
/// fields, is listed with all its fields.
#[must_use]
pub fn document(fields: &Fields) -> Sheet {
    let name = |k: usize| fields.get("provenance")?.get("designs")?.get(k)?.get("name")?.as_str();
    let names = [name(0).unwrap_or("the design"), name(1).unwrap_or("the second design")];
    kind(fields).and_then(|kind| kind.2(fields, names)).unwrap_or_else(|| all_fields(fields))
}

fn read<T: DeserializeOwned>(fields: &Fields) -> Option<T> {
    T::deserialize(fields).ok()
}

/// The greatest number of rows of a list shown.
const ROWS: usize = 24;
/// The greatest depth of nested objects shown; deeper ones are in the file.
const DEPTH: usize = 3;

/// Fields shown elsewhere.
const ELSEWHERE: [&str; 4] = ["schema_version", "provenance", "explanation", "warnings"];

/// The explanation, then all other fields.
fn all_fields(fields: &Fields) -> Sheet {
    let mut sheet = Sheet::new();
    fields.get("explanation").and_then(Value::as_str).into_iter().for_each(|text| sheet.line(text));
    sheet.add(facts(fields.iter().filter(|(key, _)| !ELSEWHERE.contains(&key.as_str())), 0));
    sheet
}

/// Scalars and short lists as one table, then everything else under its name.
fn facts<'a>(fields: impl Iterator<Item = (&'a String, &'a Value)> + Clone, depth: usize) -> Sheet {
    let plain = |v: &Value| cell(v).filter(|_| short(v));
    let mut sheet = Sheet::new();
    // fields that do not apply are in the file
    let told = fields.clone().filter(|(_, v)| !v.is_null());
    sheet.table(Table::facts(24, told.filter_map(|(key, v)| Some((words(key), plain(v)?)))));
    for (key, value) in fields.filter(|(_, v)| plain(v).is_none()) {
        nested(&mut sheet, &words(key), value, depth);
    }
    sheet
}

fn nested(sheet: &mut Sheet, name: &str, value: &Value, depth: usize) {
    match value {
        Value::Object(_) if depth >= DEPTH => say!(sheet, "{name}: in the file"),
        Value::Object(fields) => sheet.part(name, depth == 0, facts(fields.iter(), depth + 1)),
        Value::Array(list) => {
            let plural = if list.len() == 1 { "entry" } else { "entries" };
            // a small matrix is shown unfolded
            let open = list.len() <= 6 && list.iter().all(Value::is_array);
            sheet.part(format!("{name} ({} {plural})", list.len()), open, rows(list));
        }
        _ => {}
    }
}

/// A list as rows: objects by their plain fields, lists by their entries.
fn rows(list: &[Value]) -> Sheet {
    let empty = |key: &String| list.iter().all(|entry| entry.get(key).is_none_or(Value::is_null));
    let heads: Vec<&String> = list.first().and_then(Value::as_object).map_or(Vec::new(), |first| {
        let shown = first.iter().filter(|(_, v)| short(v) && cell(v).is_some());
        shown.map(|(key, _)| key).filter(|key| !empty(key)).collect()
    });
    let most = list.iter().filter_map(Value::as_array).map(Vec::len).max().unwrap_or(1);
    let titles = heads.iter().map(|head| left(words(head), 0));
    let titled = [left(if heads.is_empty() { "" } else { "#" }, 0)].into_iter().chain(titles);
    let untitled = (0..if heads.is_empty() { most } else { 0 }).map(|_| left("", 0));
    let mut table = Table::new(titled.chain(untitled));
    for (k, entry) in list.iter().take(ROWS).enumerate() {
        let cells: Vec<String> = match entry {
            Value::Object(fields) => heads
                .iter()
                .map(|head| fields.get(*head).and_then(cell).unwrap_or_else(|| "\u{2013}".into()))
                .collect(),
            Value::Array(row) => row.iter().map(|v| cell(v).unwrap_or_else(|| "\u{2026}".into())).collect(),
            other => scalar(other).into_iter().collect(),
        };
        table.row([(k + 1).to_string()].into_iter().chain(cells));
    }
    let mut sheet = Sheet::new();
    sheet.table(table);
    if list.len() > ROWS {
        say!(sheet, "{} more in the file", list.len() - ROWS);
    }
    sheet
}

/// A scalar, or numbers side by side.
fn cell(value: &Value) -> Option<String> {
    match value {
        Value::Array(list) if list.is_empty() => Some("none".into()),
        Value::Array(list) => {
            list.iter().map(scalar).collect::<Option<Vec<_>>>().map(|cells| cells.join(", "))
        }
        other => scalar(other),
    }
}

fn scalar(value: &Value) -> Option<String> {
    match value {
        Value::Null => Some("\u{2013}".into()),
        Value::Bool(b) => Some(if *b { "yes".into() } else { "no".into() }),
        Value::Number(n) => {
            Some(n.as_f64().filter(|_| n.is_f64()).map_or_else(|| n.to_string(), significant))
        }
        Value::String(s) => Some(if is_name(s) { s.replace('_', " ") } else { s.clone() }),
        _ => None,
    }
}

/// Whether a text is a word of the answers, such as `min_leg_length`, rather than a sentence, a path or a user's name.
fn is_name(text: &str) -> bool {
    text.contains('_') && text.chars().all(|c| c.is_ascii_lowercase() || c == '_')
}

fn short(value: &Value) -> bool {
    value.as_array().is_none_or(|list| list.len() <= 12)
}

/// The name of a field in words: short names in full, a unit at the end of a name in brackets.
#[must_use]
pub fn words(key: &str) -> String {
    const SHORT: [(&str, &str); 10] = [
        ("p", "position"),
        ("q", "quaternion w, x, y, z"),
        ("R", "rotation"),
        ("re", "real part"),
        ("im", "imaginary part"),
        ("A", "A (leg map)"),
        ("c", "c (leg map)"),
        ("det", "det A"),
        ("det_exact", "det A, exact"),
        ("at_limit", "at its limit"),
    ];
    const UNITS: [&str; 6] = ["deg", "rad", "mm", "um", "us", "s"];
    if let Some((_, full)) = SHORT.iter().find(|(short, _)| *short == key) {
        return (*full).to_owned();
    }
    match key.rsplit_once('_').filter(|(_, end)| UNITS.contains(end)) {
        Some((name, unit)) => format!("{} [{unit}]", name.replace('_', " ")),
        None => key.replace('_', " "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_keep_the_digits_that_mean_something() {
        let show = |text: &str| scalar(&serde_json::from_str(text).unwrap()).unwrap();
        assert_eq!(show("22.105444020912273"), "22.1054");
        assert_eq!(show("-171.01007176555896"), "-171.01");
        assert_eq!(show("1.924349568582784e-12"), "1.92435e-12");
        assert_eq!(
            (show("-0.5"), show("120"), show("1e300")),
            ("-0.5".into(), "120".into(), "1.00000e300".into())
        );
        assert_eq!((show("null"), show("true")), ("\u{2013}".into(), "yes".into()));
    }

    #[test]
    fn names_of_fields_and_answers_read_as_words() {
        let show = |text: &str| scalar(&serde_json::from_str(text).unwrap()).unwrap();
        assert_eq!(show("\"min_leg_length\""), "min leg length");
        assert_eq!(show("\"A1_A2\""), "A1_A2", "the name of a joint stays");
        let words = ["rotation_deg", "real_count", "worst_s", "p"].map(words);
        assert_eq!(words, ["rotation [deg]", "real count", "worst [s]", "position"]);
    }

    #[test]
    fn what_does_not_apply_takes_no_space() {
        let told = |list: &str| {
            let list: Vec<Value> = serde_json::from_str(list).unwrap();
            rows(&list).to_string()
        };
        assert_eq!(told(r#"[{"a":1,"b":null},{"a":2,"b":null}]"#), "# a\n1 1\n2 2\n");
        assert_eq!(told(r#"[{"a":1,"b":null},{"a":2,"b":3}]"#), "# a b\n1 1 \u{2013}\n2 2 3\n");
        assert_eq!(told("[[1,2],[3,4]]"), "1 1 2\n2 3 4\n");
        let fields: Fields = serde_json::from_str(r#"{"a":1,"missing_count":null}"#).unwrap();
        assert!(!document(&fields).to_string().contains("missing"));
    }
}
