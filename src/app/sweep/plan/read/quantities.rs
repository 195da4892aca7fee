//! Free quantities: their names, their values.

use super::PlanReader;
use crate::column::{ColumnKind, SweepColumn};
use crate::plan::place::TRAJECTORY;
use crate::plan::{AxisValues, FreeQuantity, POSE_COORDINATES, PlanAxis};
use crate::sample::MOST;
use files::design::Code;
use files::design::spanned::{Entry, Node, Value, check_keys, find, nearest_help, number, shown, text};
use synthesis::{Family, Pattern};
impl PlanReader<'_, '_> {
    /// The axes of a quantity; `offsets` and `lengths` stand for six each.
    pub(super) fn axes(&mut self, path: &str, entry: &Entry, grid: bool) -> Option<Vec<PlanAxis>> {
        let units = self.base.design.units.clone();
        let each = |name: &str, of: fn(usize) -> FreeQuantity| {
            (0..6).map(|i| (format!("{name}.{}", i + 1), of(i))).collect::<Vec<_>>()
        };
        let numbered = |rest: &str| rest.parse::<usize>().ok().filter(|n| (1..=6).contains(n)).map(|n| n - 1);
        let (name, rest) = path.split_once('.').unwrap_or((path, ""));
        let list = match (name, rest) {
            ("offsets", "") => each("offsets", FreeQuantity::Offset),
            ("lengths", "") => each("lengths", FreeQuantity::Length),
            ("offsets" | "lengths", number) => {
                let Some(i) = numbered(number) else {
                    return self.report.refused(
                        Code::UnknownName,
                        &entry.key_span,
                        format!("there is no `{}`", shown(path)),
                        format!("write {name}.1 to {name}.6, or `{name}` for all six"),
                    );
                };
                let quantity =
                    if name == "offsets" { FreeQuantity::Offset(i) } else { FreeQuantity::Length(i) };
                vec![(path.to_owned(), quantity)]
            }
            ("pattern", "") => vec![(path.to_owned(), FreeQuantity::Pattern)],
            ("drive", "") => vec![(path.to_owned(), FreeQuantity::Drive)],
            ("pose", coordinate) => {
                let Some(i) = POSE_COORDINATES.iter().position(|c| *c == coordinate) else {
                    let help = nearest_help("coordinates of a pose", coordinate, &POSE_COORDINATES);
                    return self.report.refused(
                        Code::UnknownName,
                        &entry.key_span,
                        format!("`{}` is no coordinate of a pose", shown(path)),
                        help,
                    );
                };
                vec![(path.to_owned(), FreeQuantity::Pose(i))]
            }
            _ if path == TRAJECTORY => {
                return self.report.refused(
                    Code::ConflictingKeys,
                    &entry.key_span,
                    format!("`{TRAJECTORY}` is read once for all candidates"),
                    "vary numbers; a plan for each table compares them",
                );
            }
            _ => match self.base.place(path) {
                Ok(span) => vec![(path.to_owned(), FreeQuantity::Number(span))],
                Err((message, help)) => {
                    return self.report.refused(Code::UnknownName, &entry.key_span, message, help);
                }
            },
        };
        let values = self.values(path, entry, &list[0].1, grid)?;
        let axis = |(path, quantity): (String, FreeQuantity)| {
            let (unit, meaning) = match &quantity {
                FreeQuantity::Pattern => (None, "pattern of the equivalent platform".to_owned()),
                FreeQuantity::Drive => (None, "drive in all legs, from the table of the plan".to_owned()),
                FreeQuantity::Offset(i) => {
                    (None, format!("offset {} of the pattern, as a fraction of its side", i + 1))
                }
                FreeQuantity::Length(i) => (Some(units.as_str()), format!("length of leg {}", i + 1)),
                FreeQuantity::Pose(i) if *i < 3 => {
                    (Some(units.as_str()), "position of the platform".to_owned())
                }
                FreeQuantity::Pose(_) => (Some("deg"), "angle of the platform".to_owned()),
                FreeQuantity::Number(_) => {
                    let body = path.starts_with("base.") || path.starts_with("platform.");
                    let length = body && ["x", "y", "z"].iter().any(|a| path.ends_with(&format!(".{a}")));
                    (length.then_some(units.as_str()), format!("{path} of the base design"))
                }
            };
            let kind =
                if matches!(values, AxisValues::Words(_)) { ColumnKind::Text } else { ColumnKind::Number };
            let name: String = path.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect();
            PlanAxis {
                quantity,
                column: SweepColumn::new(&name, kind, unit, &meaning),
                values: values.clone(),
            }
        };
        Some(list.into_iter().map(axis).collect())
    }

    fn values(
        &mut self,
        path: &str,
        entry: &Entry,
        quantity: &FreeQuantity,
        grid: bool,
    ) -> Option<AxisValues> {
        let what = format!("`{}`", shown(path));
        let form = "write { from = A, to = B }, with `count` in a grid, or a list of values";
        if *quantity == FreeQuantity::Pattern {
            return self.patterns(&entry.node);
        }
        if *quantity == FreeQuantity::Drive {
            return self.drives(entry);
        }
        match &entry.node.value {
            Value::Table(inner) => {
                check_keys(self.report, inner, &["from", "to", "count", "scale"], &what);
                let mut end = |key: &str| {
                    if let Some(e) = find(inner, key) {
                        return number(self.report, &e.node, &format!("`{key}` of {what}"));
                    }
                    let message = format!("`{key}` of {what} is missing");
                    self.report.refused(Code::MissingKey, &entry.key_span, message, form)
                };
                let (from, to) = (end("from"), end("to"));
                let logarithmic = match find(inner, "scale") {
                    None => false,
                    Some(e) => match text(self.report, e)?.as_str() {
                        "linear" => false,
                        "log" => true,
                        other => {
                            return self.report.refused(
                                Code::UnknownName,
                                &e.node.span,
                                format!("`{}` is not a scale", shown(other)),
                                "write \"linear\" or \"log\"",
                            );
                        }
                    },
                };
                let count = match find(inner, "count") {
                    Some(e) if grid => self.whole(e, MOST)?,
                    Some(e) => {
                        return self.report.refused(
                            Code::ConflictingKeys,
                            &e.key_span,
                            format!("`count` of {what} is for grids"),
                            "the block has one `count` for all of its quantities",
                        );
                    }
                    None if grid => {
                        return self.report.refused(
                            Code::MissingKey,
                            &entry.key_span,
                            format!("`count` of {what} is missing"),
                            form,
                        );
                    }
                    None => 1,
                };
                let (from, to) = (from?, to?);
                if logarithmic && !(from * to > 0.0) {
                    return self.report.refused(
                        Code::NotPositive,
                        &entry.node.span,
                        format!("{what} has a logarithmic scale from {from} to {to}"),
                        "both ends have one sign, and neither is zero",
                    );
                }
                Some(AxisValues::Range { from, to, logarithmic, count })
            }
            Value::Number(_) => number(self.report, &entry.node, &what).map(|x| AxisValues::Numbers(vec![x])),
            Value::Text(word) if matches!(quantity, FreeQuantity::Number(_)) => {
                Some(AxisValues::Words(vec![word.clone()]))
            }
            _ => {
                let list = self.list(&entry.node, &what, form)?;
                let has_texts = list.iter().any(|n| matches!(n.value, Value::Text(_)));
                if has_texts && matches!(quantity, FreeQuantity::Number(_)) {
                    // a column has one type: beside texts such as "1/3" numbers become texts
                    let mut word = |n: &Node| match &n.value {
                        Value::Text(word) => Some(word.clone()),
                        _ => {
                            number(self.report, n, &format!("a value of {what}")).map(|x: f64| x.to_string())
                        }
                    };
                    let words: Vec<Option<String>> = list.iter().map(&mut word).collect();
                    return words.into_iter().collect::<Option<_>>().map(AxisValues::Words);
                }
                let numbers: Vec<Option<f64>> =
                    list.iter().map(|n| number(self.report, n, &format!("a value of {what}"))).collect();
                numbers.into_iter().collect::<Option<_>>().map(AxisValues::Numbers)
            }
        }
    }

    /// Patterns by their names, or the word for a set of them.
    fn patterns(&mut self, node: &Node) -> Option<AxisValues> {
        const FORM: &str =
            "write \"classes\" (one of each class), \"all\", or a list of patterns such as \"S123456\"";
        let named = |p: &Pattern| p.to_string();
        if let Value::Text(word) = &node.value {
            let family = Family::octahedral();
            let mut seen = std::collections::BTreeSet::new();
            match word.as_str() {
                "all" => {
                    return Some(AxisValues::Words(
                        family.members().iter().map(|m| named(&m.pattern)).collect(),
                    ));
                }
                "classes" => {
                    let first = family.members().iter().filter(|m| seen.insert(m.class));
                    return Some(AxisValues::Words(first.map(|m| named(&m.pattern)).collect()));
                }
                _ => {}
            }
        }
        let list = match &node.value {
            Value::Text(_) => std::slice::from_ref(node),
            _ => self.list(node, "`pattern`", FORM)?,
        };
        let mut words = Vec::new();
        for node in list {
            let Value::Text(word) = &node.value else {
                return self.report.not_a(node, "a pattern", "a string", FORM);
            };
            match word.parse::<Pattern>() {
                Ok(pattern) => words.push(named(&pattern)),
                Err(why) => {
                    return self.report.refused(
                        Code::UnknownName,
                        &node.span,
                        format!("`{}`: {why}", shown(word)),
                        FORM,
                    );
                }
            }
        }
        Some(AxisValues::Words(words))
    }

    /// Drives of the table by their names, or the word for all of them.
    fn drives(&mut self, entry: &Entry) -> Option<AxisValues> {
        const FORM: &str = "write \"all\", or a list of names of the table";
        let Some(table) = &self.base.drives else {
            return self.report.refused(
                Code::MissingKey,
                &entry.key_span,
                "the drive varies, and the plan names no table of drives",
                "add `drives = \"FILE.csv\"`, relative to the plan; docs/guides/choosing-drives.md has its columns",
            );
        };
        let known: Vec<&str> = table.drives.iter().map(|d| d.name.as_str()).collect();
        let list = match &entry.node.value {
            Value::Text(word) if word == "all" => {
                return Some(AxisValues::Words(known.into_iter().map(str::to_owned).collect()));
            }
            Value::Text(_) => std::slice::from_ref(&entry.node),
            _ => self.list(&entry.node, "`drive`", FORM)?,
        };
        let mut words = Vec::new();
        for node in list {
            match &node.value {
                Value::Text(word) if known.contains(&word.as_str()) => words.push(word.clone()),
                Value::Text(word) => {
                    let message = format!("the table has no drive `{}`", shown(word));
                    return self.report.refused(
                        Code::UnknownName,
                        &node.span,
                        message,
                        nearest_help("it has", word, &known),
                    );
                }
                _ => return self.report.not_a(node, "a drive", "a string", FORM),
            }
        }
        Some(AxisValues::Words(words))
    }
}
