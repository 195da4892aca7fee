//! Poses in lists and objects of Python, MATLAB, JSON and YAML, as a table.

use super::names::{is_time, without_angle_units};
use super::pose_names::named_pose;
use crate::design::table::header::{CellUnit, plain};
use crate::design::table::listed::{
    Formula, ListValue, NamedValues, Record, member, named_values, records, stated_units, table_of,
};
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::geom::{PoseConvention, QuaternionOrder, RotationOrder};

/// The head of the names of the numbers of a pose that are in one list.
const POSE_NUMBER: &str = "posenumber";

/// Parts of names of lists with the numbers of a pose.
const POSE_WORDS: [&str; 6] = ["pose", "xyz", "coord", "target", "dof", "place"];
/// Parts of names of lists with the entries of a matrix.
const MATRIX_WORDS: [&str; 3] = ["transform", "matrix", "frame"];

fn names_in(word: &str, parts: &[&str]) -> bool {
    parts.iter().any(|part| word.contains(part))
}

/// The rows of a text that is a list or has objects with columns that `knows`; `None` for other texts. A list of six
/// numbers under one of `words` is one of numbered columns.
///
/// # Errors
/// A list in a formula.
pub(super) fn read(
    text: &str,
    (stated, words): (&PoseConvention, &'static [&'static str]),
    knows: &dyn Fn(&[String]) -> bool,
) -> Result<Option<CellTable>, Formula> {
    let in_brackets = text.contains(['[', '{', '(']);
    if !in_brackets && !text.lines().any(|line| line.trim_start().starts_with("- ")) {
        return Ok(None);
    }
    let is_known = |value: &ListValue| {
        if let Some((names, _)) = columns(value) {
            return knows(&names);
        }
        let mut cells = Cells::of_six(words);
        value.leaves("", &mut |name, leaf| cells.take(name, leaf, stated));
        matches!(value, ListValue::Named(_)) && !cells.holds_lists && knows(&cells.names())
    };
    let Some(found) = records(text, &is_known)? else { return Ok(None) };
    let values =
        named_values(text, &mut Vec::new()).map_or_else(Vec::new, |NamedValues { values, .. }| values);
    let (length_unit, angle_unit, guess) = stated_units(&values, text);
    let mut guesses: Vec<String> = guess.into_iter().collect();
    let (header, rows) = table(found, (stated, words), &mut guesses);
    Ok(Some(CellTable::of_rows(header, rows, (length_unit, angle_unit), guesses)))
}

/// Whether names of columns tell a pose, perhaps in an order of angles that may have to be stated.
pub(super) fn is_pose(names: &[String]) -> bool {
    let plain: Vec<String> = names.iter().map(|name| plain(name)).collect();
    let stated = PoseConvention { rotation_order: Some(RotationOrder::Vector), ..Default::default() };
    plain.iter().any(|name| name.starts_with(POSE_NUMBER))
        || matches!(named_pose(names, &plain, &stated), Ok(Some(_)))
}

/// Names and rows of columns that are lists of one length each: `{"x": [..], "y": [..], ..}`.
fn columns(value: &ListValue) -> Option<(Vec<String>, Vec<Vec<f64>>)> {
    let ListValue::Named(members) = value else { return None };
    let numbers = |value: &ListValue| match value {
        // columns whose rows have their numbers as names
        ListValue::Named(rows) if rows.iter().all(|(name, _)| name.chars().all(|c| c.is_ascii_digit())) => {
            rows.iter().map(|(_, x)| x.number()).collect()
        }
        other => other.numbers(),
    };
    let found: Vec<(String, Vec<f64>)> =
        members.iter().filter_map(|(name, value)| Some((name.clone(), numbers(value)?))).collect();
    let count = found.first()?.1.len();
    (found.len() >= 6 && found.iter().all(|(_, list)| list.len() == count)).then(|| found.into_iter().unzip())
}

fn table(
    found: Vec<Record>,
    (stated, words): (&PoseConvention, &'static [&'static str]),
    guesses: &mut Vec<String>,
) -> (Option<Vec<String>>, Vec<SheetRow>) {
    let shown = |x: f64| format!("{x:?}");
    if let [Record { value, line }] = &found[..]
        && let Some((names, lists)) = columns(value)
    {
        let rows = (0..lists[0].len())
            .map(|k| SheetRow { line: line + k, cells: lists.iter().map(|list| shown(list[k])).collect() });
        return (Some(names), rows.collect());
    }
    let mut named = Vec::new();
    let mut rows = Vec::new();
    for Record { line, value } in found {
        if let ListValue::List(list) = &value {
            let cells = list.iter().filter_map(ListValue::number).map(shown).collect();
            rows.push(SheetRow { line, cells });
        } else {
            let mut cells = Cells::of_six(words);
            value.leaves("", &mut |name, leaf| cells.take(name, leaf, stated));
            named.push((line, cells.of_pose(guesses)));
        }
    }
    if named.is_empty() {
        return (None, rows);
    }
    let (header, mut table) = table_of(named);
    // a list among objects has no columns of theirs, and is refused as a row without values
    table.extend(rows.into_iter().map(|row| SheetRow { cells: Vec::new(), ..row }));
    (Some(header), table)
}

/// The cells of an object with the names of their columns.
#[derive(Default)]
struct Cells {
    /// Names of lists of six numbers that are numbered columns.
    words: &'static [&'static str],
    named: Vec<(String, String)>,
    /// Whether there are lists of other lists or objects, which may be the poses.
    holds_lists: bool,
    guesses: Vec<String>,
}

impl Cells {
    fn of_six(words: &'static [&'static str]) -> Self {
        Self { words, ..Self::default() }
    }

    fn names(&self) -> Vec<String> {
        self.named.iter().map(|(name, _)| name.clone()).collect()
    }

    /// The cells of a pose: a pose in one list needs nothing but its time and lengths.
    fn of_pose(self, guesses: &mut Vec<String>) -> Vec<(String, String)> {
        for guess in self.guesses {
            if !guesses.contains(&guess) {
                guesses.push(guess);
            }
        }
        let in_list = |name: &str| plain(name).starts_with(POSE_NUMBER);
        if !self.named.iter().any(|(name, _)| in_list(name)) {
            return self.named;
        }
        let (pose, rest): (Vec<_>, Vec<_>) = self.named.into_iter().partition(|(name, _)| in_list(name));
        let is_length = |name: &str| {
            let word = plain(name);
            self.words.iter().any(|own| word.strip_suffix(|c: char| c.is_ascii_digit()) == Some(own))
        };
        let (times, rest): (Vec<_>, Vec<_>) = rest.into_iter().partition(|(name, _)| is_time(&plain(name)));
        times.into_iter().chain(pose).chain(rest.into_iter().filter(|(name, _)| is_length(name))).collect()
    }

    fn take(&mut self, name: &str, value: &ListValue, stated: &PoseConvention) {
        match value {
            ListValue::Number(x) => self.push(name, *x),
            ListValue::Text(text) => self.named.push((name.to_owned(), text.clone())),
            ListValue::Named(_) => {}
            ListValue::List(_) => match (value.numbers(), value.rows()) {
                (Some(list), _) => self.take_numbers(name, &list, stated),
                (None, Some(rows)) => self.take_matrix(&rows),
                (None, None) => self.holds_lists = true,
            },
        }
    }

    fn push(&mut self, name: &str, x: f64) {
        self.named.push((name.to_owned(), format!("{x:?}")));
    }

    fn take_numbers(&mut self, name: &str, list: &[f64], stated: &PoseConvention) {
        let word = &without_angle_units(&[plain(name)])[0];
        let names: Vec<String> = match list.len() {
            3 if word.ends_with("rpy") || word.ends_with("rollpitchyaw") => {
                ["roll", "pitch", "yaw"].map(|axis| with_unit(name, axis)).to_vec()
            }
            3 => ["x", "y", "z"].map(|axis| member(name, axis)).to_vec(),
            4 if word.starts_with('q') || names_in(word, &["quat", "orient", "rot", "attitude"]) => {
                let said = QuaternionOrder::ALL.into_iter().find(|order| word.ends_with(order.name()));
                let names = said.unwrap_or(stated.quaternion_order()).written(["qw", "qx", "qy", "qz"]);
                if said.is_none() {
                    self.guesses.push(format!("`{name}` is read in the order {}.", names.join(", ")));
                }
                names.map(String::from).to_vec()
            }
            6 if self.words.iter().any(|own| word.starts_with(own)) => {
                (1..=6).map(|leg| format!("{}{leg}", self.words[0])).collect()
            }
            6 | 7 if names_in(word, &POSE_WORDS) => {
                (0..list.len()).map(|k| format!("{POSE_NUMBER}{k}")).collect()
            }
            12 | 16 if name == "T" || names_in(word, &POSE_WORDS) || names_in(word, &MATRIX_WORDS) => {
                (0..list.len()).map(|k| format!("{POSE_NUMBER}{k}")).collect()
            }
            _ => return,
        };
        for (name, x) in names.iter().zip(list) {
            self.push(name, *x);
        }
    }

    fn take_matrix(&mut self, rows: &[Vec<f64>]) {
        let numbers = || rows.iter().flatten();
        match (rows.len(), rows[0].len()) {
            (3, 3) => {
                for (k, x) in numbers().enumerate() {
                    self.push(&format!("r{}{}", k / 3 + 1, k % 3 + 1), *x);
                }
            }
            (3 | 4, 4) => {
                for (k, x) in numbers().enumerate() {
                    self.push(&format!("{POSE_NUMBER}{k}"), *x);
                }
            }
            _ => self.holds_lists = true,
        }
    }
}

/// The name of an angle with the unit of a list.
fn with_unit(name: &str, axis: &str) -> String {
    match name.rsplit_once('_') {
        Some((_, unit)) if CellUnit::of(unit).is_some() => format!("{axis}_{unit}"),
        _ => axis.to_owned(),
    }
}
