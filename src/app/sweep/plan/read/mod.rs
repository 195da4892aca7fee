//! Reading a plan: one walk that collects every violation with its place.

mod blocks;
mod coherence;
mod quantities;
mod settings;
mod tasks;

use super::{BaseName, BasePlan, PlanFiles, PlanText, PoseChoice, SweepPlan};
use ask::presets::Preset;
use files::design::spanned::{
    Entry, Findings, Node, Value, check_keys, find, nearest_help, number, read as read_tree, shown, text,
};
use files::design::{Code, Violation};
use platform::geom::Pose;

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

/// Default number of steps of a search.
const STEPS: u64 = 200;

/// Greatest number of elements of a list in a plan.
const MOST_LISTED: usize = 1_000_000;

fn entries<'a>(root: &'a Node, report: &mut Findings<'_>) -> Option<&'a [Entry]> {
    match &root.value {
        Value::Table(entries) => Some(entries),
        other => {
            let message = format!("a plan is a table, not {}", other.kind());
            report.refused(
                Code::WrongType,
                &root.span,
                message,
                "write { \"name\": ..., \"design\": ..., \"vary\": [ ... ], \"compute\": [ ... ] }",
            )
        }
    }
}

fn tree(plan: PlanText<'_>, report: &mut Findings<'_>) -> Option<Node> {
    let bare = plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text);
    if bare.trim().is_empty() {
        let help = "a plan needs name, design, compute and [[vary]]; docs/sweep.md has examples";
        return report.refused(Code::Empty, &(0..0), "the file is empty", help);
    }
    read_tree(bare, plan.format, report)
}

/// The base design that a plan names, and its table of drives.
///
/// # Errors
/// The violations of a plan that names no design.
pub fn files_named(plan: PlanText<'_>) -> Result<PlanFiles, Vec<Violation>> {
    let mut report = Findings::new(plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text));
    let root = tree(plan, &mut report);
    let found = root.as_ref().and_then(|root| {
        let entries = entries(root, &mut report)?;
        check_keys(&mut report, entries, &TOP_LEVEL, "a plan");
        let base = base(root, entries, plan.presets, &mut report)?;
        let drives = match find(entries, "drives") {
            Some(entry) => Some(text(&mut report, entry)?),
            None => None,
        };
        Some(PlanFiles { base, drives })
    });
    // all other violations are reported once the design is known
    found.ok_or_else(|| report.into_violations())
}

fn base(root: &Node, entries: &[Entry], presets: &[Preset], report: &mut Findings<'_>) -> Option<BaseName> {
    match (find(entries, "design"), find(entries, "preset")) {
        (Some(design), None) => text(report, design).map(BaseName::File),
        (None, Some(preset)) => {
            let name = text(report, preset)?;
            let found = presets.iter().find(|p| p.name == name);
            if found.is_none() {
                let names: Vec<&str> = presets.iter().map(|p| p.name).collect();
                let help = nearest_help("presets", &name, &names);
                report.refuse(
                    Code::UnknownName,
                    &preset.node.span,
                    format!("there is no preset `{}`", shown(&name)),
                    help,
                );
            }
            found.map(|p| BaseName::Preset(p.name, p.text))
        }
        (Some(_), Some(preset)) => report.refused(
            Code::ConflictingKeys,
            &preset.key_span,
            "`design` and `preset` both name the base design",
            "keep one of them",
        ),
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
pub fn read(plan: PlanText<'_>, base_plan: &BasePlan) -> Result<SweepPlan, Vec<Violation>> {
    let mut report = Findings::new(plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text));
    let root = tree(plan, &mut report);
    let found = root.and_then(|root| {
        PlanReader { report: &mut report, base: base_plan, presets: plan.presets }.plan(&root)
    });
    match found {
        Some(plan) if report.is_clean() => Ok(plan),
        _ => Err(report.into_violations()),
    }
}

struct PlanReader<'r, 't> {
    report: &'r mut Findings<'t>,
    base: &'r BasePlan,
    presets: &'r [Preset],
}

impl PlanReader<'_, '_> {
    fn plan(&mut self, root: &Node) -> Option<SweepPlan> {
        let entries = entries(root, self.report)?;
        check_keys(self.report, entries, &TOP_LEVEL, "a plan");
        let named = find(entries, "name");
        if named.is_none() {
            missing(self.report, root, "name", "add `name = \"...\"` at the top");
        }
        let name = named.and_then(|e| text(self.report, e));
        let description = find(entries, "description").and_then(|e| text(self.report, e));
        base(root, entries, self.presets, self.report);
        let poses = self.poses(find(entries, "poses"));
        let assess = self.assess(find(entries, "assess"));
        let accuracy = match find(entries, "accuracy") {
            Some(entry) => self.accuracy(entry).map(Some),
            None => Some(None),
        };
        let steps = find(entries, "steps").map_or(Some(STEPS), |e| self.whole(e, 1_000_000));
        let blocks = self.blocks(root, find(entries, "vary"));
        let tasks = self.tasks(root, find(entries, "compute"));
        let keep = find(entries, "keep");
        let (Some(blocks), Some(tasks)) = (blocks, tasks) else {
            if let Some(keep) = keep {
                self.keep(keep, None);
            }
            return None;
        };
        // if one of these is missing, the plan is refused, but the rest is checked too
        let mut plan = SweepPlan {
            name: name.unwrap_or_default(),
            description,
            blocks,
            poses: poses.unwrap_or(PoseChoice::Home),
            assess: assess.unwrap_or_default(),
            accuracy: accuracy.unwrap_or_default(),
            steps: steps.unwrap_or(STEPS) as usize,
            tasks,
            keep: Vec::new(),
        };
        let place = find(entries, "vary").map_or(root.span.clone(), |e| e.key_span.clone());
        let computed = find(entries, "compute").map_or(root.span.clone(), |e| e.key_span.clone());
        self.count(&plan, &place);
        self.quantities(&plan, &place);
        self.computable(&plan, &computed);
        let columns = self.columns(&plan, &computed);
        if let Some(keep) = keep {
            plan.keep = self.keep(keep, Some(&columns))?;
        }
        Some(plan)
    }

    fn list<'a>(&mut self, node: &'a Node, what: &str, form: &str) -> Option<&'a [Node]> {
        match &node.value {
            Value::Array(list) if list.is_empty() => {
                self.report.refused(Code::MissingKey, &node.span, format!("{what} is empty"), form)
            }
            Value::Array(list) if list.len() > MOST_LISTED => {
                let message = format!("{what} has {} elements", list.len());
                self.report.refused(
                    Code::TooComplex,
                    &node.span,
                    message,
                    format!("list at most {MOST_LISTED}"),
                )
            }
            Value::Array(list) => Some(list),
            _ => self.report.not_a(node, what, "an array", form),
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
        self.report.refused(Code::NotPositive, &entry.node.span, message, help)
    }
}

/// The pose of six coordinates, angles in degrees.
pub(crate) fn pose_of([x, y, z, roll, pitch, yaw]: [f64; 6]) -> Pose {
    Pose::new([x, y, z], platform::geom::Angles::from_degrees([roll, pitch, yaw]))
}
