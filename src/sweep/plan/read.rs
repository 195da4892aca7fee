//! Reading a plan: one walk that collects every violation with its place.

use super::{
    AnswerField, AnswerName, AssessEffort, AxisValues, BaseName, BasePlan, FreeQuantity, KeepCondition,
    MOST_CANDIDATES, POSE_COORDINATES, PlanAxis, PlanBlock, PlanFiles, PlanText, PoseChoice, Spreading,
    SweepPlan, SweepTask, TASK_WORDS,
};
use crate::design::spanned::{
    Entry, Findings, Node, Span, Value, check_keys, find, nearest_help, number, read as read_tree, shown,
    table, text,
};
use crate::design::{Code, PRESETS, Violation};
use crate::equivalents::Original;
use crate::geom::Pose;
use crate::manufacture::ErrorBound;
use crate::sweep::column::{ColumnKind, SweepColumn};
use crate::sweep::sample::{DIMENSIONS, MOST, PointSpread};
use crate::synthesis::{Family, Pattern};

const TOP_LEVEL: [&str; 12] = [
    "name",
    "description",
    "design",
    "preset",
    "drives",
    "poses",
    "assess",
    "accuracy",
    "steps",
    "compute",
    "keep",
    "vary",
];

const SPREADINGS: [(&str, Spreading); 5] = [
    ("grid", Spreading::Grid),
    ("list", Spreading::List),
    ("uniform", Spreading::Points(PointSpread::Uniform)),
    ("latin_hypercube", Spreading::Points(PointSpread::LatinHypercube)),
    ("sobol", Spreading::Points(PointSpread::Sobol)),
];

/// Steps of a search where nothing is said.
const STEPS: u64 = 200;

/// Elements of a list in a plan, at most.
const MOST_LISTED: usize = 1_000_000;

fn entries<'a>(root: &'a Node, report: &mut Findings<'_>) -> Option<&'a [Entry]> {
    match &root.value {
        Value::Table(entries) => Some(entries),
        other => {
            let message = format!("a plan is a table, not {}", other.kind());
            report.refuse(
                Code::WrongType,
                &root.span,
                message,
                "write { \"name\": ..., \"design\": ..., \"vary\": [ ... ], \"compute\": [ ... ] }",
            );
            None
        }
    }
}

fn tree(plan: PlanText<'_>, report: &mut Findings<'_>) -> Option<Node> {
    let bare = plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text);
    if bare.trim().is_empty() {
        let help = "a plan needs name, design, compute and [[vary]]; docs/sweep.md has examples";
        report.refuse(Code::Empty, &(0..0), "the file is empty", help);
        return None;
    }
    read_tree(bare, plan.format, report)
}

/// The base design that a plan names, and its table of drives.
///
/// # Errors
/// The violations of the plan, where it names no design.
pub(crate) fn files_named(plan: PlanText<'_>) -> Result<PlanFiles, Vec<Violation>> {
    let mut report = Findings::new(plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text));
    let root = tree(plan, &mut report);
    let found = root.as_ref().and_then(|root| {
        let entries = entries(root, &mut report)?;
        check_keys(&mut report, entries, &TOP_LEVEL, "a plan");
        let base = base(root, entries, &mut report)?;
        let drives = match find(entries, "drives") {
            Some(entry) => Some(text(&mut report, entry)?),
            None => None,
        };
        Some(PlanFiles { base, drives })
    });
    // everything else is said once the design is known
    found.ok_or_else(|| report.into_violations())
}

fn base(root: &Node, entries: &[Entry], report: &mut Findings<'_>) -> Option<BaseName> {
    match (find(entries, "design"), find(entries, "preset")) {
        (Some(design), None) => text(report, design).map(BaseName::File),
        (None, Some(preset)) => {
            let name = text(report, preset)?;
            let found = PRESETS.iter().find(|p| p.name == name);
            if found.is_none() {
                let help = nearest_help("presets", &name, &PRESETS.map(|p| p.name));
                report.refuse(
                    Code::UnknownName,
                    &preset.node.span,
                    format!("there is no preset `{}`", shown(&name)),
                    help,
                );
            }
            found.map(|p| BaseName::Preset(p.name, p.text))
        }
        (Some(_), Some(preset)) => {
            report.refuse(
                Code::ConflictingKeys,
                &preset.key_span,
                "`design` and `preset` both name the base design",
                "keep one of them",
            );
            None
        }
        (None, None) => {
            missing(
                report,
                root,
                "design",
                "add `design = \"FILE\"`, relative to the plan, or `preset = \"NAME\"`",
            );
            None
        }
    }
}

fn missing(report: &mut Findings<'_>, root: &Node, key: &str, help: &str) {
    let start = root.span.start;
    report.refuse(Code::MissingKey, &(start..start), format!("`{key}` is missing"), help);
}

/// Reads a plan about a base design.
///
/// # Errors
/// All violations, in the order of the text.
pub(crate) fn read(plan: PlanText<'_>, base_plan: &BasePlan) -> Result<SweepPlan, Vec<Violation>> {
    let mut report = Findings::new(plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text));
    let root = tree(plan, &mut report);
    let found = root.and_then(|root| Reader { report: &mut report, base: base_plan }.plan(&root));
    match found {
        Some(plan) if report.is_clean() => Ok(plan),
        _ => Err(report.into_violations()),
    }
}

struct Reader<'r, 't> {
    report: &'r mut Findings<'t>,
    base: &'r BasePlan,
}

impl Reader<'_, '_> {
    fn plan(&mut self, root: &Node) -> Option<SweepPlan> {
        let entries = entries(root, self.report)?;
        check_keys(self.report, entries, &TOP_LEVEL, "a plan");
        let named = find(entries, "name");
        if named.is_none() {
            missing(self.report, root, "name", "add `name = \"...\"` at the top");
        }
        let name = named.and_then(|e| text(self.report, e));
        let description = find(entries, "description").and_then(|e| text(self.report, e));
        base(root, entries, self.report);
        let poses = self.poses(find(entries, "poses"));
        let assess = self.assess(find(entries, "assess"));
        let accuracy = match find(entries, "accuracy") {
            Some(entry) => self.accuracy(entry).map(Some),
            None => Some(None),
        };
        let steps = find(entries, "steps").map_or(Some(STEPS), |e| self.whole(e, 1_000_000));
        let blocks = self.blocks(root, find(entries, "vary"));
        let tasks = self.tasks(root, find(entries, "compute"));
        if !self.report.is_clean() {
            return None;
        }
        let mut plan = SweepPlan {
            name: name?,
            description,
            blocks: blocks?,
            poses: poses?,
            assess: assess?,
            accuracy: accuracy?,
            steps: steps? as usize,
            tasks: tasks?,
            keep: Vec::new(),
        };
        let place = find(entries, "vary").map_or(root.span.clone(), |e| e.key_span.clone());
        let computed = find(entries, "compute").map_or(root.span.clone(), |e| e.key_span.clone());
        self.count(&plan, &place);
        self.quantities(&plan, &place);
        self.computable(&plan, &computed);
        let columns = self.columns(&plan, &computed);
        if let Some(keep) = find(entries, "keep") {
            plan.keep = self.keep(keep, &columns)?;
        }
        Some(plan)
    }

    fn refuse(&mut self, code: Code, span: &Span, message: impl Into<String>, help: impl Into<String>) {
        self.report.refuse(code, span, message, help);
    }

    fn list<'a>(&mut self, node: &'a Node, what: &str, form: &str) -> Option<&'a [Node]> {
        match &node.value {
            Value::Array(list) if list.is_empty() => {
                self.refuse(Code::MissingKey, &node.span, format!("{what} is empty"), form);
                None
            }
            Value::Array(list) if list.len() > MOST_LISTED => {
                let message = format!("{what} has {} elements", list.len());
                self.refuse(Code::TooComplex, &node.span, message, format!("list at most {MOST_LISTED}"));
                None
            }
            Value::Array(list) => Some(list),
            other => {
                let message = format!("{what} is {}, not an array", other.kind());
                self.refuse(Code::WrongType, &node.span, message, form);
                None
            }
        }
    }

    /// A whole number from 1 to `most`.
    fn whole(&mut self, entry: &Entry, most: u64) -> Option<u64> {
        self.whole_from(1, entry, most)
    }

    /// A whole number from `least` to `most`.
    fn whole_from(&mut self, least: u64, entry: &Entry, most: u64) -> Option<u64> {
        let x = number(self.report, &entry.node, &format!("`{}`", entry.key))?;
        if x >= least as f64 && x <= most as f64 && x.fract() == 0.0 {
            return Some(x as u64);
        }
        let message = format!("`{}` is {x}", entry.key);
        let help = format!("write a whole number from {least} to {most}");
        self.refuse(Code::NotPositive, &entry.node.span, message, help);
        None
    }

    fn poses(&mut self, entry: Option<&Entry>) -> Option<PoseChoice> {
        const FORM: &str = "write \"workspace\", \"home\", { region = N } or a list of poses [x, y, z, roll_deg, pitch_deg, yaw_deg]";
        let Some(entry) = entry else { return Some(PoseChoice::Workspace) };
        match &entry.node.value {
            Value::Text(word) => match word.as_str() {
                "workspace" => Some(PoseChoice::Workspace),
                "home" => Some(PoseChoice::Home),
                other => {
                    let message = format!("`{}` is not a set of poses", shown(other));
                    self.refuse(Code::UnknownName, &entry.node.span, message, FORM);
                    None
                }
            },
            Value::Table(inner) => {
                check_keys(self.report, inner, &["region"], "`poses`");
                let Some(region) = find(inner, "region") else {
                    self.refuse(Code::MissingKey, &entry.node.span, "`poses` says nothing", FORM);
                    return None;
                };
                self.whole(region, 1_000_000).map(|n| PoseChoice::Region(n as usize))
            }
            _ => {
                let list = self.list(&entry.node, "`poses`", FORM)?;
                list.iter()
                    .map(|node| self.pose(node))
                    .collect::<Vec<_>>()
                    .into_iter()
                    .collect::<Option<_>>()
                    .map(PoseChoice::Listed)
            }
        }
    }

    fn pose(&mut self, node: &Node) -> Option<Pose> {
        const FORM: &str = "give six numbers x, y, z, roll_deg, pitch_deg, yaw_deg";
        let list = self.list(node, "a pose", FORM)?;
        let values: Vec<Option<f64>> =
            list.iter().map(|n| number(self.report, n, "a coordinate of a pose")).collect();
        let values: Vec<f64> = values.into_iter().collect::<Option<_>>()?;
        let Ok(six) = <[f64; 6]>::try_from(values) else {
            self.refuse(
                Code::CoordinateCount,
                &node.span,
                format!("a pose has {} numbers", list.len()),
                FORM,
            );
            return None;
        };
        Some(pose_of(six))
    }

    fn assess(&mut self, entry: Option<&Entry>) -> Option<AssessEffort> {
        let mut effort = AssessEffort::default();
        let Some(entry) = entry else { return Some(effort) };
        let inner = table(self.report, &entry.node, "`assess`")?;
        check_keys(self.report, inner, &["points", "searches", "cells"], "`assess`");
        let mut take = |key: &str, most: u64, into: &mut usize| -> Option<()> {
            if let Some(entry) = find(inner, key) {
                *into = self.whole_from(0, entry, most)? as usize;
            }
            Some(())
        };
        let points = take("points", 10_000_000, &mut effort.points);
        let searches = take("searches", 1000, &mut effort.searches);
        let cells = take("cells", 100_000_000, &mut effort.cells);
        points.and(searches).and(cells).map(|()| effort)
    }

    fn accuracy(&mut self, entry: &Entry) -> Option<ErrorBound> {
        const FORM: &str = "write accuracy = [0.1, 0.05]: of the position in the unit of the design, of the rotation in degrees";
        let list = self.list(&entry.node, "`accuracy`", FORM)?;
        let values: Vec<Option<f64>> = list.iter().map(|n| number(self.report, n, "an accuracy")).collect();
        match values.into_iter().collect::<Option<Vec<f64>>>()?[..] {
            [position, rotation_deg] if position > 0.0 && rotation_deg > 0.0 => {
                Some(ErrorBound { position, rotation_deg })
            }
            _ => {
                self.refuse(
                    Code::NotPositive,
                    &entry.node.span,
                    "`accuracy` is not two positive numbers",
                    FORM,
                );
                None
            }
        }
    }

    fn blocks(&mut self, root: &Node, entry: Option<&Entry>) -> Option<Vec<PlanBlock>> {
        const FORM: &str = "write `[[vary]]` with `by = \"grid\"` and [vary.values] below it";
        let Some(entry) = entry else {
            missing(self.report, root, "vary", FORM);
            return None;
        };
        let nodes = match &entry.node.value {
            // one block may be written as a table
            Value::Table(_) => std::slice::from_ref(&entry.node),
            _ => self.list(&entry.node, "`vary`", FORM)?,
        };
        if nodes.len() > 255 {
            self.refuse(
                Code::TooComplex,
                &entry.node.span,
                "`vary` has more than 255 blocks",
                "put quantities into one block",
            );
            return None;
        }
        let blocks: Vec<_> = nodes.iter().map(|node| self.block(node)).collect();
        blocks.into_iter().collect()
    }

    fn block(&mut self, node: &Node) -> Option<PlanBlock> {
        let entries = table(self.report, node, "a block of `vary`")?;
        check_keys(self.report, entries, &["by", "count", "values"], "`vary`");
        let by = match find(entries, "by") {
            None => {
                let at = node.span.start..node.span.start;
                self.refuse(
                    Code::MissingKey,
                    &at,
                    "`by` is missing",
                    "add `by = \"grid\"`, or list, uniform, latin_hypercube, sobol",
                );
                None
            }
            Some(entry) => text(self.report, entry).and_then(|word| {
                let found = SPREADINGS.iter().find(|(name, _)| *name == word);
                if found.is_none() {
                    let help = nearest_help("ways to vary", &word, &SPREADINGS.map(|s| s.0));
                    self.refuse(
                        Code::UnknownName,
                        &entry.node.span,
                        format!("`{}` is not a way to vary", shown(&word)),
                        help,
                    );
                }
                found.map(|(_, s)| *s)
            }),
        };
        let Some(values) = find(entries, "values") else {
            let at = node.span.start..node.span.start;
            self.refuse(
                Code::MissingKey,
                &at,
                "`values` is missing",
                "add [vary.values] with a line for each free quantity",
            );
            return None;
        };
        let listed = table(self.report, &values.node, "`values`")?;
        let mut leaves = Vec::new();
        flatten(listed, "", &mut leaves);
        if leaves.is_empty() {
            self.refuse(
                Code::MissingKey,
                &values.key_span,
                "`values` is empty",
                "add a line such as `offsets = { from = 0.1, to = 0.4 }`",
            );
            return None;
        }
        let by = by?;
        let grid = by == Spreading::Grid;
        let axes: Vec<Option<Vec<PlanAxis>>> =
            leaves.iter().map(|(path, entry)| self.axes(path, entry, grid)).collect();
        let axes: Vec<PlanAxis> = axes.into_iter().collect::<Option<Vec<_>>>()?.concat();
        let count = self.block_count(node, entries, by, &axes)?;
        if by == Spreading::Points(PointSpread::Sobol) && axes.len() > DIMENSIONS {
            let message = format!("{} quantities of one Sobol sequence", axes.len());
            self.refuse(
                Code::TooComplex,
                &node.span,
                message,
                format!("a block by sobol has at most {DIMENSIONS}: take latin_hypercube"),
            );
            return None;
        }
        Some(PlanBlock { spreading: by, count, axes })
    }

    fn block_count(
        &mut self,
        node: &Node,
        entries: &[Entry],
        by: Spreading,
        axes: &[PlanAxis],
    ) -> Option<u64> {
        let at = node.span.start..node.span.start;
        let given = find(entries, "count");
        match by {
            Spreading::Points(spread) => {
                let Some(entry) = given else {
                    self.refuse(
                        Code::MissingKey,
                        &at,
                        "`count` is missing",
                        "add `count = N`, the number of points of this block",
                    );
                    return None;
                };
                let most = if spread == PointSpread::Sobol { 1 << 32 } else { MOST };
                self.whole(entry, most)
            }
            Spreading::Grid | Spreading::List => {
                if let Some(entry) = given {
                    self.refuse(
                        Code::ConflictingKeys,
                        &entry.key_span,
                        "`count` is for uniform, latin_hypercube and sobol",
                        "leave it out: the values say how many there are",
                    );
                    return None;
                }
                let lens: Vec<u64> = axes.iter().map(|a| a.values.len()).collect();
                if by == Spreading::Grid {
                    return self.product(&lens, &at);
                }
                if axes.iter().any(|a| matches!(a.values, AxisValues::Range { .. })) {
                    self.refuse(
                        Code::WrongType,
                        &at,
                        "a block by list has a range",
                        "write the values one by one, or take `by = \"grid\"`",
                    );
                    return None;
                }
                if lens.iter().any(|n| *n != lens[0]) {
                    let message = format!(
                        "the lists have {} elements",
                        lens.iter().map(u64::to_string).collect::<Vec<_>>().join(", ")
                    );
                    self.refuse(
                        Code::ConflictingKeys,
                        &at,
                        message,
                        "candidate j has element j of each list: give them the same length",
                    );
                    return None;
                }
                Some(lens[0])
            }
        }
    }

    fn product(&mut self, numbers: &[u64], at: &Span) -> Option<u64> {
        let product =
            numbers.iter().try_fold(1u64, |p, n| p.checked_mul(*n).filter(|p| *p <= MOST_CANDIDATES));
        if product.is_none() {
            self.refuse(
                Code::TooComplex,
                at,
                format!("more than {MOST_CANDIDATES} candidates"),
                "take fewer values",
            );
        }
        product
    }

    /// The axes of a quantity: `offsets` and `lengths` stand for six.
    fn axes(&mut self, path: &str, entry: &Entry, grid: bool) -> Option<Vec<PlanAxis>> {
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
                    self.refuse(
                        Code::UnknownName,
                        &entry.key_span,
                        format!("there is no `{}`", shown(path)),
                        format!("write {name}.1 to {name}.6, or `{name}` for all six"),
                    );
                    return None;
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
                    self.refuse(
                        Code::UnknownName,
                        &entry.key_span,
                        format!("`{}` is no coordinate of a pose", shown(path)),
                        help,
                    );
                    return None;
                };
                vec![(path.to_owned(), FreeQuantity::Pose(i))]
            }
            _ => match self.base.place(path) {
                Ok(span) => vec![(path.to_owned(), FreeQuantity::Number(span))],
                Err((message, help)) => {
                    self.refuse(Code::UnknownName, &entry.key_span, message, help);
                    return None;
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
                    self.report.refuse(Code::MissingKey, &entry.key_span, message, form);
                    None
                };
                let (from, to) = (end("from"), end("to"));
                let logarithmic = match find(inner, "scale") {
                    None => false,
                    Some(e) => match text(self.report, e)?.as_str() {
                        "linear" => false,
                        "log" => true,
                        other => {
                            self.refuse(
                                Code::UnknownName,
                                &e.node.span,
                                format!("`{}` is not a scale", shown(other)),
                                "write \"linear\" or \"log\"",
                            );
                            return None;
                        }
                    },
                };
                let count = match find(inner, "count") {
                    Some(e) if grid => self.whole(e, MOST)?,
                    Some(e) => {
                        self.refuse(
                            Code::ConflictingKeys,
                            &e.key_span,
                            format!("`count` of {what} is for grids"),
                            "the block has one `count` for all of its quantities",
                        );
                        return None;
                    }
                    None if grid => {
                        self.refuse(
                            Code::MissingKey,
                            &entry.key_span,
                            format!("`count` of {what} is missing"),
                            form,
                        );
                        return None;
                    }
                    None => 1,
                };
                let (from, to) = (from?, to?);
                if logarithmic && !(from * to > 0.0) {
                    self.refuse(
                        Code::NotPositive,
                        &entry.node.span,
                        format!("{what} has a logarithmic scale from {from} to {to}"),
                        "both ends have one sign, and neither is zero",
                    );
                    return None;
                }
                Some(AxisValues::Range { from, to, logarithmic, count })
            }
            Value::Number(_) => number(self.report, &entry.node, &what).map(|x| AxisValues::Numbers(vec![x])),
            Value::Text(word) if matches!(quantity, FreeQuantity::Number(_)) => {
                Some(AxisValues::Words(vec![word.clone()]))
            }
            _ => {
                let list = self.list(&entry.node, &what, form)?;
                let words = list.iter().filter(|n| matches!(n.value, Value::Text(_))).count();
                if words == list.len() && matches!(quantity, FreeQuantity::Number(_)) {
                    let word = |n: &Node| {
                        if let Value::Text(word) = &n.value { word.clone() } else { String::new() }
                    };
                    return Some(AxisValues::Words(list.iter().map(word).collect()));
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
                self.refuse(
                    Code::WrongType,
                    &node.span,
                    format!("a pattern is {}, not a string", node.value.kind()),
                    FORM,
                );
                return None;
            };
            match word.parse::<Pattern>() {
                Ok(pattern) => words.push(named(&pattern)),
                Err(why) => {
                    self.refuse(Code::UnknownName, &node.span, format!("`{}`: {why}", shown(word)), FORM);
                    return None;
                }
            }
        }
        Some(AxisValues::Words(words))
    }

    /// Drives of the table by their names, or the word for all of them.
    fn drives(&mut self, entry: &Entry) -> Option<AxisValues> {
        const FORM: &str = "write \"all\", or a list of names of the table";
        let Some(table) = &self.base.drives else {
            self.refuse(
                Code::MissingKey,
                &entry.key_span,
                "the drive varies, and the plan names no table of drives",
                "add `drives = \"FILE.csv\"`, relative to the plan; docs/guides/choosing-drives.md has its columns",
            );
            return None;
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
                    self.refuse(Code::UnknownName, &node.span, message, nearest_help("it has", word, &known));
                    return None;
                }
                other => {
                    let message = format!("a drive is {}, not a string", other.kind());
                    self.refuse(Code::WrongType, &node.span, message, FORM);
                    return None;
                }
            }
        }
        Some(AxisValues::Words(words))
    }

    fn tasks(&mut self, root: &Node, entry: Option<&Entry>) -> Option<Vec<SweepTask>> {
        const FORM: &str = "write compute = [\"det_a\", \"conditioning\"]";
        let Some(entry) = entry else {
            missing(self.report, root, "compute", FORM);
            return None;
        };
        let list = self.list(&entry.node, "`compute`", FORM)?;
        let tasks: Vec<_> = list.iter().map(|node| self.task(node)).collect();
        tasks.into_iter().collect()
    }

    fn task(&mut self, node: &Node) -> Option<SweepTask> {
        let words: Vec<&str> = TASK_WORDS.iter().map(|t| t.0).collect();
        match &node.value {
            Value::Text(word) => {
                let found = TASK_WORDS.iter().find(|t| t.0 == word);
                if found.is_none() {
                    let help = nearest_help("what can be computed", word, &words);
                    self.refuse(
                        Code::UnknownName,
                        &node.span,
                        format!("`{}` cannot be computed", shown(word)),
                        help,
                    );
                }
                found.map(|t| t.1.clone())
            }
            Value::Table(inner) => self.field(node, inner).map(SweepTask::Field),
            other => {
                let message = format!("what is computed is {}, not a word", other.kind());
                self.refuse(Code::WrongType, &node.span, message, format!("one of {}", words.join(", ")));
                None
            }
        }
    }

    fn field(&mut self, node: &Node, inner: &[Entry]) -> Option<AnswerField> {
        const FORM: &str = "write { column = \"median\", field = \"check.jacobian_inverse_condition.median\", as = \"number\" }";
        check_keys(self.report, inner, &["column", "field", "as", "unit"], "a computed field");
        let mut word = |key: &str, optional: bool| match find(inner, key) {
            Some(e) => text(self.report, e),
            None if optional => None,
            None => {
                self.report.refuse(Code::MissingKey, &node.span, format!("`{key}` is missing"), FORM);
                None
            }
        };
        let (column, field) = (word("column", false), word("field", false));
        let (kind, unit) = (word("as", true), word("unit", true));
        let kind = match kind {
            None => ColumnKind::Number,
            Some(word) => {
                let found = ColumnKind::ALL.into_iter().find(|k| k.name() == word);
                let Some(kind) = found else {
                    let help = nearest_help("kinds", &word, &ColumnKind::ALL.map(ColumnKind::name));
                    self.refuse(
                        Code::UnknownName,
                        &node.span,
                        format!("`{}` is not a kind of column", shown(&word)),
                        help,
                    );
                    return None;
                };
                kind
            }
        };
        let (column, field) = (column?, field?);
        let mut path = field.split('.').map(str::to_owned);
        let first = path.next().unwrap_or_default();
        let Some(answer) = AnswerName::ALL.into_iter().find(|a| a.name() == first) else {
            let help = nearest_help("answers", &first, &AnswerName::ALL.map(AnswerName::name));
            self.refuse(
                Code::UnknownName,
                &node.span,
                format!("`{}` is not an answer with fields", shown(&first)),
                help,
            );
            return None;
        };
        Some(AnswerField { column, answer, path: path.collect(), kind, unit })
    }

    fn count(&mut self, plan: &SweepPlan, place: &Span) {
        let counts: Vec<u64> = plan.blocks.iter().map(|b| b.count).collect();
        self.product(&counts, place);
    }

    /// What free quantities need of each other and of the base design.
    fn quantities(&mut self, plan: &SweepPlan, place: &Span) {
        let has = |wanted: &dyn Fn(&FreeQuantity) -> bool| plan.quantities().filter(|q| wanted(q)).count();
        let offsets = has(&|q| matches!(q, FreeQuantity::Offset(_)));
        let pattern = has(&|q| *q == FreeQuantity::Pattern) > 0;
        if (offsets > 0 || pattern) && plan.text_is_fixed() && Original::of(&self.base.design).is_none() {
            self.refuse(
                Code::ConflictingKeys,
                place,
                "offsets and patterns are those of octahedral platforms, and the base design is none",
                "take an octahedral design; `equipod equivalents nearest DESIGN` finds one near",
            );
        }
        if offsets > 0 && !pattern && offsets != 6 {
            self.refuse(
                Code::MissingKey,
                place,
                format!("{offsets} of the six offsets vary"),
                "give all six: `offsets.1` to `offsets.6`, single values in lists of one",
            );
        }
        if pattern {
            let words =
                plan.blocks.iter().flat_map(|b| &b.axes).filter(|a| a.quantity == FreeQuantity::Pattern);
            let needed = words
                .filter_map(|a| if let AxisValues::Words(list) = &a.values { Some(list) } else { None })
                .flatten()
                .filter_map(|w| w.parse::<Pattern>().ok())
                .map(|p| p.offsets().len())
                .max()
                .unwrap_or(0);
            if needed > offsets {
                self.refuse(
                    Code::MissingKey,
                    place,
                    format!("{offsets} offsets vary, and the patterns take up to {needed}"),
                    "give `offsets`: a pattern with fewer takes the first ones",
                );
            }
        }
        if self.base.drives.is_some() && has(&|q| *q == FreeQuantity::Drive) == 0 {
            self.refuse(
                Code::ConflictingKeys,
                place,
                "the plan names a table of drives, and the drive does not vary",
                "add drive = \"all\" to the values of a block, or leave `drives` out",
            );
        }
        let lengths = has(&|q| matches!(q, FreeQuantity::Length(_)));
        let pose = has(&|q| matches!(q, FreeQuantity::Pose(_)));
        if lengths > 0 && pose > 0 {
            self.refuse(
                Code::ConflictingKeys,
                place,
                "lengths vary, and the pose from which lengths are taken does too",
                "keep one of them",
            );
        }
        if (1..6).contains(&lengths) && self.base.design.lengths.is_none() {
            self.refuse(
                Code::MissingKey,
                place,
                format!("{lengths} of the six lengths vary, and the base design has none"),
                "give all six, or `lengths` to the base design",
            );
        }
        if (lengths > 0 || pose > 0) && !plan.tasks.iter().any(SweepTask::needs_lengths) {
            self.refuse(
                Code::ConflictingKeys,
                place,
                "lengths or the pose vary, and nothing that is computed depends on them",
                "compute lengths, poses or solutions",
            );
        }
    }

    /// What is computed has to make sense for the base design and for what varies.
    fn computable(&mut self, plan: &SweepPlan, place: &Span) {
        let equivalent =
            plan.quantities().any(|q| matches!(q, FreeQuantity::Pattern | FreeQuantity::Offset(_)));
        for task in &plan.tasks {
            match task {
                SweepTask::DetA if !equivalent => {
                    self.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`det_a` is that of an equivalent platform",
                        "vary `offsets` or `pattern`, or leave it out",
                    );
                }
                SweepTask::Tolerance if plan.accuracy.is_none() => {
                    self.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`tolerance` is that for an accuracy, and the plan has none",
                        "add accuracy = [position, rotation_deg], or leave it out",
                    );
                }
                SweepTask::Drive if self.base.drives.is_none() => {
                    self.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`drive` is what a table says of the drive of a candidate, and the plan names none",
                        "add `drives = \"FILE.csv\"`, or leave it out",
                    );
                }
                SweepTask::Margins if self.base.required_kinds().is_empty() => {
                    self.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`margins` are those of requirements, and the base design has none",
                        "add [hardware] to the design, or leave it out",
                    );
                }
                SweepTask::Field(AnswerField { answer: AnswerName::Assess, .. })
                    if self.base.required_kinds().is_empty() =>
                {
                    self.refuse(
                        Code::ConflictingKeys,
                        place,
                        "the base design requires nothing that `assess` could answer",
                        "add [hardware] to the design, or leave the field out",
                    );
                }
                _ => {}
            }
        }
    }

    /// All columns, each name once.
    fn columns(&mut self, plan: &SweepPlan, place: &Span) -> Vec<SweepColumn> {
        let columns = plan.columns(self.base);
        for (k, column) in columns.iter().enumerate() {
            if columns[..k].iter().any(|c| c.name == column.name) {
                let message = format!("two columns have the name `{}`", shown(&column.name));
                self.refuse(
                    Code::ConflictingKeys,
                    place,
                    message,
                    "a quantity varies once, and a thing is computed once",
                );
            }
        }
        columns
    }

    fn keep(&mut self, entry: &Entry, columns: &[SweepColumn]) -> Option<Vec<KeepCondition>> {
        let form = "write keep = [\"conditioning >= 0.1\"]";
        let list = self.list(&entry.node, "`keep`", form)?;
        let mut keep = Vec::new();
        for node in list {
            let Value::Text(condition) = &node.value else {
                self.refuse(
                    Code::WrongType,
                    &node.span,
                    format!("a condition is {}, not a string", node.value.kind()),
                    form,
                );
                continue;
            };
            match KeepCondition::read(condition, columns) {
                Ok(condition) => keep.push(condition),
                Err((message, help)) => self.refuse(Code::Expression, &node.span, message, help),
            }
        }
        Some(keep)
    }
}

/// The pose of six coordinates, angles in degrees.
pub(in crate::sweep) fn pose_of([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Pose {
    Pose::new([x, y, z], crate::geom::Angles::from_degrees([roll, pitch, yaw]))
}

/// The values with their whole names: a table without `from` and `to` holds further ones (`offsets.1 = ...` without quotes).
fn flatten<'a>(entries: &'a [Entry], before: &str, out: &mut Vec<(String, &'a Entry)>) {
    for entry in entries {
        let path = if before.is_empty() { entry.key.clone() } else { format!("{before}.{}", entry.key) };
        match &entry.node.value {
            Value::Table(inner)
                if find(inner, "from").is_none() && find(inner, "to").is_none() && !inner.is_empty() =>
            {
                flatten(inner, &path, out);
            }
            _ => out.push((path, entry)),
        }
    }
}
