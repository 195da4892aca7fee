//! The base design of a plan, with the places of its numbers.

use std::collections::BTreeSet;
use std::ops::Range;

use super::PlanText;
use ask::Design;
use ask::design::parse;
use files::design::spanned::{Findings, Node, Value, find, nearest_help, read, shown};
use files::design::{Drive, DriveTable, Format, InvalidDriveTable, InvalidSeries, Violation, read_poses};
use machine::requirements::{TermKind, Terms};

/// The key of a design's table of poses.
pub(super) const TRAJECTORY: &str = "workspace.trajectory";

/// A base design with its text, into which candidates write their numbers.
#[derive(Debug, Clone)]
pub struct BasePlan {
    pub(crate) text: String,
    pub(crate) format: Format,
    /// The design.
    pub design: Design,
    /// The drives that candidates may have.
    pub drives: Option<DriveTable>,
    root: Node,
}

impl BasePlan {
    /// Reads the design.
    ///
    /// # Errors
    /// All violations of the design.
    pub fn new(plan: PlanText<'_>) -> Result<Self, Vec<Violation>> {
        let text = plan.text.strip_prefix('\u{feff}').unwrap_or(plan.text).to_owned();
        let (design, _) = parse(&text, plan.format).map_err(refused_as_base)?;
        let mut report = Findings::new(&text);
        let Some(root) = read(&text, plan.format, &mut report) else { return Err(report.into_violations()) };
        Ok(Self { format: plan.format, design, drives: None, root, text })
    }

    /// The same with a table of drives for the candidates.
    ///
    /// # Errors
    /// A text that is no table of drives; two drives with one name, since plans choose them by it.
    pub fn with_drives(mut self, table: &[u8]) -> Result<Self, InvalidDriveTable> {
        let table = DriveTable::read(table, &self.design.drive_units())?;
        let mut seen = BTreeSet::new();
        if let Some(twice) = table.drives.iter().find(|d| !seen.insert(d.name.as_str())) {
            return Err(InvalidDriveTable::TwoDrives(twice.name.clone()));
        }
        self.drives = Some(table);
        Ok(self)
    }

    /// The same with the table of poses that the workspace of the design names. Its name then means a file beside the
    /// design, since the files of candidates are elsewhere.
    ///
    /// # Errors
    /// A text that is no table of poses.
    pub fn with_poses(mut self, table: &[u8]) -> Result<Self, InvalidSeries> {
        let (home, frames) = (self.design.home_or_default(), self.design.trajectory_frames());
        let read = read_poses(table, &frames, &home, &self.design.units)?;
        if let Some(own) = &self.design.workspace.trajectory
            && let Ok(place) = self.place(TRAJECTORY)
        {
            let name = own.file.rsplit(['/', '\\']).next().unwrap_or_default().to_owned();
            if name != own.file {
                let text = self.with_values(&[(place, serde_json::Value::from(name).to_string())]);
                let drives = self.drives.take();
                if let Ok(moved) = Self::new(PlanText::new(&text, self.format)) {
                    self = Self { drives, ..moved };
                }
            }
        }
        if let Some(trajectory) = &mut self.design.workspace.trajectory {
            trajectory.poses = read.rows.into_iter().map(|row| row.value).collect();
        }
        Ok(self)
    }

    /// A design of the sweep read from a text, which has the poses of the table.
    ///
    /// # Errors
    /// All violations of the text.
    pub fn candidate(&self, text: &str) -> Result<Design, Vec<Violation>> {
        let (mut design, _) = parse(text, self.format)?;
        if let (Some(own), Some(read)) = (&self.design.workspace.trajectory, &mut design.workspace.trajectory)
        {
            read.poses.clone_from(&own.poses);
        }
        Ok(design)
    }

    /// The drive with a name.
    pub fn drive(&self, name: &str) -> Option<&Drive> {
        self.drives.as_ref()?.drives.iter().find(|d| d.name == name)
    }

    /// The place of the number with this path: `parameters.r`, `base.P1.x`, `home.position.3`,
    /// `hardware.max_leg_force`.
    ///
    /// # Errors
    /// The missing part of the path, with the existing ones.
    pub fn place(&self, path: &str) -> Result<Range<usize>, (String, String)> {
        let mut node = &self.root;
        let mut walked = String::new();
        for step in path.split('.') {
            let missing = |known: &[&str]| {
                let inside = if walked.is_empty() {
                    "the base design".to_owned()
                } else {
                    format!("`{walked}` of the base design")
                };
                let help = if known.is_empty() {
                    "it holds no further numbers".to_owned()
                } else {
                    nearest_help("it has", step, known)
                };
                (format!("{inside} has no `{}`", shown(step)), help)
            };
            node = match &node.value {
                Value::Table(entries) => match find(entries, step) {
                    Some(entry) => &entry.node,
                    None => return Err(missing(&entries.iter().map(|e| e.key.as_str()).collect::<Vec<_>>())),
                },
                Value::Array(list) => {
                    let axis = ["x", "y", "z"].iter().position(|a| *a == step && list.len() == 3);
                    let number = axis.or_else(|| step.parse::<usize>().ok()?.checked_sub(1));
                    match number.and_then(|i| list.get(i)) {
                        Some(element) => element,
                        None => return Err(missing(if list.len() == 3 { &["x", "y", "z"] } else { &[] })),
                    }
                }
                _ => return Err(missing(&[])),
            };
            if !walked.is_empty() {
                walked.push('.');
            }
            walked.push_str(step);
        }
        match &node.value {
            Value::Number(_) | Value::Text(_) => Ok(node.span.clone()),
            other => Err((
                format!("`{}` of the base design is {}, not a number", shown(path), other.kind()),
                "name a number in it".into(),
            )),
        }
    }

    /// The text with other values at these places, in the notation of a design file.
    pub fn with_values(&self, values: &[(Range<usize>, String)]) -> String {
        let mut sorted: Vec<&(Range<usize>, String)> = values.iter().collect();
        sorted.sort_by_key(|(span, _)| span.start);
        let mut out = String::with_capacity(self.text.len() + 32 * values.len());
        let mut from = 0;
        for (span, value) in sorted {
            out.push_str(&self.text[from..span.start]);
            out.push_str(value);
            from = span.end;
        }
        out.push_str(&self.text[from..]);
        out
    }

    /// The kinds of requirements that the design has, alone or with some drive.
    pub fn required_kinds(&self) -> Vec<TermKind> {
        let drives = self.drives.iter().flat_map(|table| &table.drives);
        let designs = std::iter::once(self.design.clone()).chain(drives.map(|d| self.design.with_drive(d)));
        let kinds: BTreeSet<TermKind> = designs.flat_map(|design| kinds_of(&design)).collect();
        kinds.into_iter().collect()
    }
}

fn kinds_of(design: &Design) -> Vec<TermKind> {
    let (m, required, home) = (design.manipulator(), design.requirements(), design.home_or_default());
    let terms = Terms::new(m, &required, &home);
    terms.fixed().into_iter().chain(terms.at(&home)).map(|(term, _)| term.kind).collect()
}

/// The violations of a base design; for cranks, with the kinds of designs that a sweep accepts.
fn refused_as_base(mut violations: Vec<Violation>) -> Vec<Violation> {
    for v in violations.iter_mut().filter(|v| v.code == files::design::Code::Rotary) {
        v.message =
            "the legs are rods on cranks, but the base design of a sweep needs legs of variable length"
                .into();
        v.help = "the columns of a sweep are about squared leg lengths, leg lengths and their range: `equipod assess` takes a design with cranks, one at a time".into();
    }
    violations
}
