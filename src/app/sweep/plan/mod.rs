//! The plan of a sweep: a base design, free quantities, computed results, conditions on rows.

mod condition;
mod place;
mod read;
#[cfg(test)]
mod tests;
mod values;

use files::design::Format;
use machine::manufacture::ErrorBound;
use platform::geom::Pose;

pub use condition::KeepCondition;
pub use place::BasePlan;
pub(crate) use read::pose_of;
pub use read::{files_named, read};
pub use values::{AxisValues, PlanAxis, PlanBlock, Spreading};

use super::column::{CANDIDATE, ColumnKind, SweepColumn};
use ask::presets::Preset;

/// Greatest number of candidates of a plan.
const MOST_CANDIDATES: u64 = 1 << 53;

/// A plan, checked against its base design.
#[derive(Debug, Clone)]
pub struct SweepPlan {
    /// The name of the plan.
    pub name: String,
    /// The purpose, in words.
    pub description: Option<String>,
    /// The free quantities; the candidates are all combinations of the candidates of the blocks.
    pub blocks: Vec<PlanBlock>,
    /// The poses for the worst figures.
    pub poses: PoseChoice,
    /// The effort of assessing requirements.
    pub assess: AssessEffort,
    /// The accuracy for the joint tolerances.
    pub accuracy: Option<ErrorBound>,
    /// Greatest number of steps of a search.
    pub steps: usize,
    /// The computed results, in this order.
    pub tasks: Vec<SweepTask>,
    /// The conditions for keeping a row.
    pub keep: Vec<KeepCondition>,
}

/// The place of a plan's base design.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum BaseName {
    /// A file, relative to the plan.
    File(String),
    /// A preset of the program, as name and text.
    Preset(&'static str, &'static str),
}

/// The files that a plan names.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PlanFiles {
    /// The base design.
    pub base: BaseName,
    /// A table of drives, relative to the plan.
    pub drives: Option<String>,
}

/// The text of a plan, in its notation.
#[derive(Debug, Clone, Copy)]
pub struct PlanText<'a> {
    /// The text.
    pub text: &'a str,
    /// Its notation.
    pub format: Format,
    /// The presets that it may name.
    pub presets: &'static [Preset],
}

impl<'a> PlanText<'a> {
    /// A text without presets.
    #[must_use]
    pub fn new(text: &'a str, format: Format) -> Self {
        Self { text, format, presets: &[] }
    }

    /// The same with presets.
    #[must_use]
    pub fn with_presets(self, presets: &'static [Preset]) -> Self {
        Self { presets, ..self }
    }
}

/// The poses for the worst figures.
#[derive(Debug, Clone, PartialEq)]
pub enum PoseChoice {
    /// Poses of the candidate's workspace: home and the grid, the single poses and the trajectory.
    Workspace,
    /// Home alone.
    Home,
    /// Home, the corners of the region of the workspace, this number of Halton points in it, and as many random ones.
    Region(usize),
    /// Listed poses, base frame.
    Listed(Vec<Pose>),
}

/// The density of sampling requirements, and the effort of bounding them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssessEffort {
    pub(crate) points: usize,
    pub(crate) searches: usize,
    pub(crate) cells: usize,
}

impl Default for AssessEffort {
    fn default() -> Self {
        Self { points: 200, searches: 1, cells: 300 }
    }
}

/// The target of a free quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum FreeQuantity {
    /// The pattern of the equivalent platform.
    Pattern,
    /// The drive in all legs, from the table of the plan.
    Drive,
    /// The offset of this index in the pattern, from 0.
    Offset(usize),
    /// The length of the leg of this index, from 0.
    Length(usize),
    /// A coordinate of the pose that gives the lengths: position, then roll, pitch, yaw in degrees.
    Pose(usize),
    /// The number at this place in the text of the base design.
    Number(std::ops::Range<usize>),
}

/// Names of the coordinates of a pose.
pub const POSE_COORDINATES: [&str; 6] = ["x", "y", "z", "roll_deg", "pitch_deg", "yaw_deg"];

/// A result computed for each candidate.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepTask {
    /// `det A` of the leg map from the base design.
    DetA,
    /// The least inverse condition number over the poses.
    Conditioning,
    /// The inverse condition number at home.
    HomeConditioning,
    /// Least distances of two joints of a body, for base and platform.
    Spacing,
    /// Number of joints that carry more than one leg.
    SharedJoints,
    /// The least clearance of two legs over the poses.
    Clearance,
    /// Least and greatest length over legs and poses.
    LengthRange,
    /// The six lengths at the pose of the candidate.
    Lengths,
    /// Number of poses at the lengths of the candidate.
    Poses,
    /// These poses with their evidence, as JSON.
    Solutions,
    /// Margins of the requirements.
    Margins,
    /// The data of the candidate's drive in the table of drives.
    Drive,
    /// Whether the candidate is architecturally singular.
    Check,
    /// The largest region without singular poses, in the shape of the workspace.
    RegularBox,
    /// The joint error allowed for the accuracy of the plan.
    Tolerance,
    /// The best equivalent or dimensioned platform.
    Optimum,
    /// The joints of the platform, three coordinates for each end of each leg.
    Joints,
    /// A platform with more real poses, found by a search from the candidate.
    Climb,
    /// A field of the answer of a command.
    Field(AnswerField),
}

/// A field of the answer of a command, as a column of its own.
#[derive(Debug, Clone, PartialEq)]
pub struct AnswerField {
    pub(crate) column: String,
    pub(crate) answer: AnswerName,
    /// The keys on the path to it; elements of lists by their number from 1.
    pub path: Vec<String>,
    pub(crate) kind: ColumnKind,
    pub(crate) unit: Option<String>,
}

num::words! {
    /// The commands whose answers have columns.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum AnswerName as name {
        /// The answer on requirements and margins.
        Assess = "assess",
        /// The answer on architectural singularity.
        Check = "check",
        /// The answer on poses for lengths.
        Fk = "fk",
    }
}

/// The words for computed results, with their meaning.
pub const TASK_WORDS: [(&str, SweepTask); 18] = [
    ("det_a", SweepTask::DetA),
    ("conditioning", SweepTask::Conditioning),
    ("home_conditioning", SweepTask::HomeConditioning),
    ("spacing", SweepTask::Spacing),
    ("shared_joints", SweepTask::SharedJoints),
    ("clearance", SweepTask::Clearance),
    ("length_range", SweepTask::LengthRange),
    ("lengths", SweepTask::Lengths),
    ("poses", SweepTask::Poses),
    ("solutions", SweepTask::Solutions),
    ("margins", SweepTask::Margins),
    ("drive", SweepTask::Drive),
    ("check", SweepTask::Check),
    ("regular_box", SweepTask::RegularBox),
    ("tolerance", SweepTask::Tolerance),
    ("optimum", SweepTask::Optimum),
    ("joints", SweepTask::Joints),
    ("climb", SweepTask::Climb),
];

impl SweepTask {
    /// Whether it depends on the lengths of the candidate.
    pub fn needs_lengths(&self) -> bool {
        match self {
            Self::Lengths | Self::Poses | Self::Solutions | Self::Climb => true,
            Self::Field(field) => field.answer == AnswerName::Fk,
            _ => false,
        }
    }

    /// The columns it fills, for a base design.
    pub fn columns(&self, base: &BasePlan) -> Vec<SweepColumn> {
        let units = base.design.units.as_str();
        let number = SweepColumn::number;
        match self {
            Self::DetA => vec![number("det_a", None, "determinant of the leg map from the base design")],
            Self::Conditioning => vec![
                number("conditioning", None, "least sigma_6 / sigma_1 of the Jacobian over the poses"),
                SweepColumn::new(
                    "conditioning_pose",
                    ColumnKind::Integer,
                    None,
                    "number of the pose where it is, from 0",
                ),
            ],
            Self::HomeConditioning => {
                vec![number("home_conditioning", None, "sigma_6 / sigma_1 of the Jacobian at home")]
            }
            Self::Spacing => vec![
                number("base_spacing", Some(units), "least distance of two joint centres of the base"),
                number(
                    "platform_spacing",
                    Some(units),
                    "least distance of two joint centres of the platform",
                ),
            ],
            Self::SharedJoints => vec![SweepColumn::new(
                "shared_joints",
                ColumnKind::Integer,
                None,
                "joints of base and platform that carry more than one leg",
            )],
            Self::Clearance => vec![number(
                "clearance",
                Some(units),
                "least gap over the poses of two legs that share no joint: of the bodies where the design has them, else of the axes",
            )],
            Self::LengthRange => vec![
                number("least_length", Some(units), "least leg length over legs and poses"),
                number("greatest_length", Some(units), "greatest leg length over legs and poses"),
            ],
            Self::Lengths => (1..=6)
                .map(|i| {
                    number(&format!("length_{i}"), Some(units), "leg length at the pose of the candidate")
                })
                .collect(),
            Self::Poses => vec![
                SweepColumn::new(
                    "finite_poses",
                    ColumnKind::Integer,
                    None,
                    "finite poses found, real and complex",
                ),
                SweepColumn::new("real_poses", ColumnKind::Integer, None, "real poses among them"),
                SweepColumn::new("certified_poses", ColumnKind::Integer, None, "those with a certificate"),
                SweepColumn::new(
                    "completeness",
                    ColumnKind::Text,
                    None,
                    "proved, modular or unproved: whether these are all",
                ),
            ],
            Self::Solutions => vec![SweepColumn::new(
                "solutions",
                ColumnKind::Text,
                None,
                "the answer of fk, as JSON: poses with their certificates",
            )],
            Self::Margins => {
                let mut columns = vec![
                    SweepColumn::new(
                        "met",
                        ColumnKind::Truth,
                        None,
                        "all requirements met; null: not decided",
                    ),
                    SweepColumn::new(
                        "regular",
                        ColumnKind::Truth,
                        None,
                        "no singular pose in the workspace; null: not decided",
                    ),
                ];
                columns.extend(base.required_kinds().into_iter().map(|kind| {
                    let unit = base.design.unit_of(kind.quantity());
                    number(
                        &format!("margin_{}", kind.code()),
                        Some(&unit),
                        "least margin found of this requirement",
                    )
                }));
                columns
            }
            Self::Drive => {
                let mass = base.design.drive_units().mass.label();
                let price = base.drives.as_ref().and_then(|table| table.currency.as_deref());
                vec![
                    number("drive_stroke", Some(units), "travel of the drive"),
                    number("drive_mass", Some(mass), "mass of one drive"),
                    number("drive_price", price, "price of one drive"),
                ]
            }
            Self::Check => vec![
                SweepColumn::new(
                    "singular",
                    ColumnKind::Truth,
                    None,
                    "architecturally singular; null: within rounding",
                ),
                SweepColumn::new("singular_reason", ColumnKind::Text, None, "short code of the reason"),
                number("singular_distance", Some(units), "no singular design is nearer"),
                SweepColumn::new(
                    "generic_poses",
                    ColumnKind::Integer,
                    None,
                    "finite poses for generic leg lengths",
                ),
            ],
            Self::RegularBox => vec![
                number(
                    "regular_box",
                    None,
                    "the region of the workspace about home, so many times as large, is proved to have no singular pose",
                ),
                number(
                    "regular_box_limit",
                    None,
                    "so many times as large it is proved to have one; null: none was found",
                ),
            ],
            Self::Tolerance => vec![number(
                "tolerance",
                Some(units),
                "how far every joint centre may be off for the accuracy of the plan to be kept over the workspace",
            )],
            Self::Optimum => vec![
                SweepColumn::new("optimum_status", ColumnKind::Text, None, "what became of the optimisation"),
                number("optimum", None, "value of the first objective"),
            ],
            Self::Joints => (1..=6)
                .flat_map(|leg| ["base", "platform"].map(|body| (leg, body)))
                .flat_map(|(leg, body)| {
                    ["x", "y", "z"].map(|axis| {
                        number(
                            &format!("{body}_{leg}_{axis}"),
                            Some(units),
                            "end of a leg in the frame of its body",
                        )
                    })
                })
                .collect(),
            Self::Climb => {
                let whole =
                    |name: &str, meaning: &str| SweepColumn::new(name, ColumnKind::Integer, None, meaning);
                let mut columns = vec![
                    whole("began_real_poses", "real poses of the candidate"),
                    whole("found_real_poses", "real poses of the platform found, each with a certificate"),
                    whole(
                        "found_finite_poses",
                        "finite poses of it, real and complex, each with a certificate",
                    ),
                    SweepColumn::new("found_completeness", ColumnKind::Text, None, "whether these are all"),
                    whole("climb_steps", "steps of the search"),
                ];
                for leg in 1..=6 {
                    for end in ["base", "platform"]
                        .iter()
                        .flat_map(|b| ["x", "y", "z"].map(|a| format!("{b}_{leg}_{a}")))
                    {
                        columns.push(number(
                            &format!("found_{end}"),
                            Some(units),
                            "end of a leg of it in the frame of its body",
                        ));
                    }
                }
                columns.extend(
                    (1..=6)
                        .map(|leg| number(&format!("found_length_{leg}"), Some(units), "leg length of it")),
                );
                columns
            }
            Self::Field(field) => {
                let meaning =
                    format!("field {} of the answer of {}", field.path.join("."), field.answer.name());
                vec![SweepColumn::new(&field.column, field.kind, field.unit.as_deref(), &meaning)]
            }
        }
    }
}

impl SweepPlan {
    /// The number of candidates.
    pub fn count(&self) -> u64 {
        self.blocks.iter().map(|b| b.count).product()
    }

    /// Whether only lengths or a pose vary, so that the platform stays the same.
    pub fn platform_is_fixed(&self) -> bool {
        !self
            .quantities()
            .any(|q| matches!(q, FreeQuantity::Pattern | FreeQuantity::Offset(_) | FreeQuantity::Number(_)))
    }

    /// Whether the text of the base design stays the same.
    pub fn text_is_fixed(&self) -> bool {
        !self.quantities().any(|q| matches!(q, FreeQuantity::Number(_)))
    }

    /// All free quantities.
    pub fn quantities(&self) -> impl Iterator<Item = &FreeQuantity> {
        self.blocks.iter().flat_map(|b| b.axes.iter().map(|a| &a.quantity))
    }

    /// All columns of the table: the number of the candidate, free quantities, computed results, the error.
    pub fn columns(&self, base: &BasePlan) -> Vec<SweepColumn> {
        let mut columns =
            vec![SweepColumn::new(CANDIDATE, ColumnKind::Integer, None, "number of the candidate, from 0")];
        columns.extend(self.blocks.iter().flat_map(|b| b.axes.iter().map(|a| a.column.clone())));
        columns.extend(self.tasks.iter().flat_map(|task| task.columns(base)));
        columns.push(SweepColumn::new("error", ColumnKind::Text, None, "why the rest of the row is empty"));
        columns
    }
}
