//! `[optimize]`: variables, objectives and mode of the optimiser.

use serde_json::{Value as Json, json};

use super::found::{nearest_help, number, numbers, shown};
use super::joints::NamedJoints;
use super::kind::{KeyKind, either, list as list_of, own, positive, table, unit, whole, word};
use super::stored::{Stored, StoredValue, Word};
use super::{Code, FoundKey, KeyTable, TEXT, key};
use crate::design::tree::{Entry, Node, Value, find};
use crate::design::violation::Findings;
use crate::design::{Combination, DesignModel, OptimizeTable, SearchTable};
use machine::requirements::{KeptSymmetry, Objective, VariableKind};
use platform::manipulator::Body;

/// Default share of the gains of earlier levels that later ones may give up.
const SLACK: f64 = 0.01;
/// Default and greatest number of steps of a Pareto front.
const POINTS: (usize, usize) = (10, 100);

/// The table, as it is written.
#[derive(Default)]
pub(super) struct OptimizeKeys {
    limits: OptimizeTable,
    search: SearchTable,
    objective: Option<Objective>,
    mode: Option<WeighingMode>,
    slack: Option<f64>,
    points: Option<usize>,
    /// The names of the joints of both bodies; `None` if they could not be read.
    joints: [Option<Vec<String>>; 2],
}

num::words! {
    /// The combination of several objectives.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(super) enum WeighingMode as name {
        Weighted = "weighted",
        Lexicographic = "lexicographic",
        Pareto = "pareto",
    }
}

const RANGE: KeyKind = own(r##"{"$ref": "#/$defs/range"}"##, unit::NONE);
const OBJECTIVE: KeyKind = own(r##"{"$ref": "#/$defs/objective"}"##, unit::NONE);

pub(super) static OPTIMIZE: KeyTable<OptimizeKeys> = KeyTable {
    keys: &[
        key!("min_joint_distance": positive(unit::LENGTH), limits.min_joint_distance;
            "least distance of joint centres of a body, design units; chosen by the optimiser when absent"),
        key!("min_abs_det": positive(unit::NONE), limits.min_abs_det;
            "least `|det A|`; chosen by the optimiser when absent"),
        key!("characteristic_length": positive(unit::LENGTH), limits.characteristic_length;
            "length that divides moments in the Jacobian, design units; else the RMS distance of the platform joints from their centroid"),
        key!("variables" { default = r#"["offsets"]"# }: list_of(&word(VariableKind::words)),
            |found, to| to.search.variables = variables(found),
            |of| list(&of.search.variables, |v| json!(v.code()));
            "chosen quantities; `components` excludes offsets and triangles"),
        key!("symmetry": word(KeptSymmetry::words),
            |found, to| to.search.symmetry = named(found.report, &found.entry.node, "a symmetry"),
            |of| of.search.symmetry.written();
            "symmetry of the platform found: `three_fold` keeps the symmetry of the design under rotations by 120 degrees at home (alternating offsets, triangles that change only in size, at most two kinds of leg); `mirror` is refused, because no regular platform without shared joints has a mirror plane; when absent, `three_fold` is tried first if the design has it, then `none`"),
        key!("objective" { default = r#""worst_conditioning""# }: OBJECTIVE,
            |found, to| to.objective = objective(found.report, &found.entry.node), |_| None;
            "objective of the search"),
        key!("objectives": list_of(&either(&[OBJECTIVE, table(&WEIGHTED)])),
            |found, to| to.search.objectives = objectives(found),
            |of| list(&of.search.objectives, |(objective, weight)| {
                let (name, weight) = (Some(*objective), Some(*weight));
                json!(WEIGHTED.write(&WeightedKeys { name, weight }))
            });
            "instead of `objective`: several, with weights"),
        key!("mode" { default = r#""weighted""# }: word(WeighingMode::words),
            |found, to| to.mode = named(found.report, &found.entry.node, "a mode"),
            |of| of.mode.written();
            "combination of several objectives: weighted sum, order of the list, or Pareto front"),
        key!("slack" { default = "0.01" }: positive(unit::NONE), slack;
            "with `lexicographic`: share of an earlier objective that a later one may give up"),
        key!("points" { default = "10" }: whole(2, 100),
            |found, to| to.points = points(found), |of| Some(json!(of.points?));
            "steps of the front, with `pareto`"),
        key!("offset_bounds": RANGE, search.offset_bounds;
            "`[least, greatest]`, in edges; with `--extension X` it is `[-X, 1 + X]`"),
        key!("stretch_bounds" { default = "[-0.5, 1.0]" }: RANGE, search.stretch_bounds;
            "`[least, greatest]` change of a triangle, as a share"),
        key!("height_bounds" { default = "[-0.5, 1.0]" }: RANGE, search.height_bounds;
            "`[least, greatest]` change of the height, in sizes of the design"),
        key!("fixed": list_of(&TEXT),
            |found, to| to.search.fixed = fixed(found, &to.joints),
            |of| list(&of.search.fixed.concat(), |name| json!(name));
            "names of joints that no search may move, or base and platform for all joints of a body"),
    ],
    rules: r#"{
        "not": {"required": ["objective", "objectives"]},
        "dependentSchemas": {
            "slack": {"required": ["mode"], "properties": {"mode": {"const": "lexicographic"}}},
            "points": {"required": ["mode"], "properties": {"mode": {"const": "pareto"}}}
        }
    }"#,
    ..KeyTable::EMPTY
};

/// An objective with a weight.
#[derive(Default)]
struct WeightedKeys {
    name: Option<Objective>,
    weight: Option<f64>,
}

static WEIGHTED: KeyTable<WeightedKeys> = KeyTable {
    keys: &[
        key!("name" { required = "write { name = \"...\", weight = 1.0 }" }: OBJECTIVE,
            |found, to| to.name = objective(found.report, &found.entry.node), |of| of.name.written();
            ""),
        key!("weight": positive(unit::NONE), weight; ""),
    ],
    ..KeyTable::EMPTY
};

/// `[optimize]`, for bodies with named joints.
pub(super) fn optimize(
    report: &mut Findings<'_>,
    top: &[Entry],
    bodies: [Option<&NamedJoints>; 2],
) -> (OptimizeTable, SearchTable) {
    let joints = bodies.map(|body| body.map(NamedJoints::names));
    let mut keys = OptimizeKeys { joints, ..OptimizeKeys::default() };
    let entries = find(top, "optimize").and_then(|e| OPTIMIZE.read(report, &e.node, "[optimize]", &mut keys));
    let entries = entries.unwrap_or_default();
    if let (Some(entry), Some(_)) = (find(entries, "objective"), find(entries, "objectives")) {
        let help = "keep one of `objective` and `objectives`";
        report.refuse(Code::ConflictingKeys, &entry.key_span, "objectives are given twice", help);
    }
    for (key, mode) in [("slack", WeighingMode::Lexicographic), ("points", WeighingMode::Pareto)] {
        if let (Some(e), true) = (find(entries, key), keys.mode != Some(mode)) {
            let message = format!("`{key}` without `mode = \"{}\"`", mode.name());
            report.refuse(Code::MissingKey, &e.key_span, message, format!("remove `{key}`, or add the mode"));
        }
    }
    keys.search.objectives.extend(keys.objective.map(|objective| (objective, 1.0)));
    keys.search.mode = keys.mode.map(|mode| match mode {
        WeighingMode::Weighted => Combination::Weighted,
        WeighingMode::Lexicographic => Combination::Lexicographic { slack: keys.slack.unwrap_or(SLACK) },
        WeighingMode::Pareto => Combination::Pareto { points: keys.points.unwrap_or(POINTS.0) },
    });
    (keys.limits, keys.search)
}

impl OptimizeKeys {
    /// The table as written, with the fixed joints that exist.
    pub(super) fn of(design: &DesignModel) -> Self {
        let mut search = design.search.clone();
        let (mode, slack, points) = match search.mode {
            None => (None, None, None),
            Some(Combination::Weighted) => (Some(WeighingMode::Weighted), None, None),
            Some(Combination::Lexicographic { slack }) => {
                (Some(WeighingMode::Lexicographic), Some(slack), None)
            }
            Some(Combination::Pareto { points }) => (Some(WeighingMode::Pareto), None, Some(points)),
        };
        for body in Body::BOTH {
            search.fixed[body.index()].retain(|name| design.joint_names(body).contains(name));
        }
        let (objective, joints) = (None, [None, None]);
        Self { limits: design.optimize, search, objective, mode, slack, points, joints }
    }
}

fn list<T>(list: &[T], of: impl Fn(&T) -> Json) -> Option<Json> {
    (!list.is_empty()).then(|| list.iter().map(of).collect())
}

/// Names of joints, or of a body for all its joints; a name in both bodies means both joints.
fn fixed(found: &mut FoundKey<'_, '_>, joints: &[Option<Vec<String>>; 2]) -> [Vec<String>; 2] {
    let mut out = [Vec::new(), Vec::new()];
    let names = joints.each_ref().map(|names| names.as_deref().unwrap_or_default());
    for node in nodes(found) {
        let Value::Text(word) = &node.value else {
            let message = format!("a name of `fixed` is {}, not a string", node.value.kind());
            let help = "write names of joints, \"base\" or \"platform\"";
            found.report.refuse(Code::WrongType, &node.span, message, help);
            continue;
        };
        let mut known = false;
        for body in Body::BOTH {
            let own = names[body.index()].iter().filter(|name| word == body.name() || *name == word);
            let before = out[body.index()].len();
            out[body.index()].extend(own.cloned());
            known |= out[body.index()].len() > before;
        }
        if !known && joints.iter().all(Option::is_some) {
            let all: Vec<&str> = Body::BOTH
                .map(Body::name)
                .into_iter()
                .chain(names.into_iter().flatten().map(String::as_str))
                .collect();
            let message = format!("`{}` is no joint of the design", shown(word));
            let help = nearest_help("known names", word, &all);
            found.report.refuse(Code::UnknownName, &node.span, message, help);
        }
    }
    for list in &mut out {
        list.sort();
        list.dedup();
    }
    out
}

/// One of the words of a type; `what` is one of them.
fn named<W: Word>(report: &mut Findings<'_>, node: &Node, what: &str) -> Option<W> {
    let Value::Text(text) = &node.value else {
        return report.not_a(node, what, "a string", format!("write one of {}", W::words().join(", ")));
    };
    let value = W::of(text);
    if value.is_none() {
        let (message, help) =
            (format!("`{}` is not {what}", shown(text)), nearest_help("known keys", text, &W::words()));
        report.refuse(Code::UnknownKey, &node.span, message, help);
    }
    value
}

/// The elements of a list.
fn nodes<'a>(found: &mut FoundKey<'a, '_>) -> &'a [Node] {
    if let Value::Array(list) = &found.entry.node.value {
        return list;
    }
    let message = format!("`{}` is {}, not an array", found.entry.key, found.entry.node.value.kind());
    found.refuse(Code::WrongType, message, "write an array");
    &[]
}

fn variables(found: &mut FoundKey<'_, '_>) -> Vec<VariableKind> {
    nodes(found).iter().filter_map(|node| named(found.report, node, "a variable")).collect()
}

fn objective(report: &mut Findings<'_>, node: &Node) -> Option<Objective> {
    named(report, node, "an objective")
}

/// Names, or `{ name, weight }`.
fn objectives(found: &mut FoundKey<'_, '_>) -> Vec<(Objective, f64)> {
    let list = nodes(found);
    let mut weighted = |node: &Node| {
        if matches!(node.value, Value::Text(_)) {
            return objective(found.report, node).map(|o| (o, 1.0));
        }
        let mut keys = WeightedKeys::default();
        let entries = WEIGHTED.read(found.report, node, "an objective", &mut keys)?;
        if find(entries, "name").is_none() {
            let help = WEIGHTED.keys[0].required;
            found.report.refuse(Code::MissingKey, &node.span, "an objective without a name", help);
        }
        Some((keys.name?, keys.weight.unwrap_or(1.0)))
    };
    list.iter().filter_map(&mut weighted).collect()
}

fn points(found: &mut FoundKey<'_, '_>) -> Option<usize> {
    let x = number(found.report, &found.entry.node, "`points`")?;
    let whole = (2..=POINTS.1).find(|n| (*n as f64 - x).abs() < 1e-9);
    if whole.is_none() {
        let help = format!("give a whole number from 2 to {}", POINTS.1);
        found.refuse(Code::OutOfRange, format!("`points` is {x}"), help);
    }
    whole
}

impl StoredValue for (f64, f64) {
    fn take(found: &mut FoundKey<'_, '_>) -> Option<Self> {
        let (what, noun) = (found.what(), "bounds, least and greatest");
        let [low, high] = numbers::<2>(found.report, &found.entry.node, &what, Code::CoordinateCount, noun)?;
        if low > high {
            found.refuse(Code::OutOfRange, format!("{what} from {low} to {high}"), "give [least, greatest]");
        }
        Some((low, high))
    }

    fn json(&self) -> Json {
        json!([self.0, self.1])
    }
}
