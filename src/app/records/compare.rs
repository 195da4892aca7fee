//! Answers that set designs side by side.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::nearest::short;
use super::{AssessAnswer, AssessedPosesRecord, LightestDriveRecord, Number};
use ask::{CrankFigures, Design, DesignFigures};
use files::design::AssessedForces;

/// The answer of `compare`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CompareAnswer {
    /// Unit of lengths.
    pub length_unit: String,
    /// Unit of forces.
    pub force_unit: String,
    /// The manoeuvres about home; forces, speeds and powers are computed along them.
    pub manoeuvres: Vec<String>,
    /// The accuracy for the joint tolerances; null: none was requested.
    pub accuracy: Option<AccuracyRecord>,
    /// Characteristic length: the value of the first design, design units.
    pub characteristic_length: f64,
    /// The designs in the order given.
    pub designs: Vec<FiguresRecord>,
    /// The files written: the table and the page.
    pub paths: Vec<String>,
}

/// The allowed error of the pose.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AccuracyRecord {
    /// Error of the platform origin, design units.
    pub position: f64,
    /// Error of the orientation, degrees.
    pub rotation_deg: f64,
}

view! {
    /// The figures of a design over the poses of its workspace, or at home if it states none. Null: the design does not
    /// specify the quantity, or the value is infinite.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct FiguresRecord {
        /// Name of the design.
        pub name: String = design.name.clone(),
        /// The design file.
        pub path: String = path,
        /// The result of `assess`; null: the design has no requirements.
        pub assessment: Option<AssessAnswer> = found.assessment.as_ref().map(|report| {
            AssessAnswer::beside(design, report, characteristic_length).without_assumptions()
        }),
        /// Lightest drive that meets the requirements, from the table that the design names; null: it names none.
        pub lightest_drive: Option<LightestDriveRecord> = None,
        /// Poses of all figures.
        pub assessed_poses: AssessedPosesRecord = design.assessed_poses().into(),
        /// Number of poses evaluated; the assessment and the conditioning use poses of their own.
        pub poses: usize = found.poses,
        /// Least leg length; null: the legs are rods on cranks.
        pub shortest: Number = Number(shortest),
        /// Greatest leg length; null: the legs are rods on cranks.
        pub longest: Number = Number(longest),
        /// Greatest minus least leg length.
        pub stroke: Number = Number(longest - shortest),
        /// Crank angles, torques and speeds; null: the legs change their lengths.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub cranks: Option<CrankFiguresRecord> =
            found.cranks.as_ref().map(|cranks| CrankFiguresRecord::of(cranks, found)),
        /// Number of different leg lengths, or rod lengths on cranks; a difference counts above a millionth of the
        /// size.
        pub different_legs: usize = found.different_legs,
        /// Greatest leg force under weight and each load, one at a time.
        pub force: Option<Number> = number(found.force),
        /// Greatest leg speed at the required platform speed.
        pub speed: Option<Number> = number(found.speed),
        /// Greatest leg force along the manoeuvres.
        pub motion_force: Option<Number> = number(found.motion.force).filter(|_| !turns),
        /// Greatest leg speed along the manoeuvres.
        pub motion_speed: Option<Number> = number(found.motion.speed).filter(|_| !turns),
        /// Greatest drive power along the manoeuvres, watts.
        pub motion_power_w: Option<Number> = number(found.motion.power),
        /// Worst conditioning of `assess`: the least inverse condition number.
        pub conditioning: Number = Number(found.conditioning),
        /// Least stiffness against forces through the platform origin, force units per design unit.
        pub stiffness: Option<Number> = number(found.stiffness),
        /// Lowest natural frequency, hertz.
        pub frequency_hz: Option<Number> = number(found.frequency),
        /// Least distance of base joint centres, design units.
        pub base_spacing: Option<Number> = number(found.spacing[0]),
        /// Least distance of platform joint centres, design units.
        pub platform_spacing: Option<Number> = number(found.spacing[1]),
        /// Least leg clearance, design units.
        pub clearance: Option<Number> = number(found.clearance),
        /// Greatest distance of base joints from their centroid, design units.
        pub base_radius: Number = Number(found.radius[0]),
        /// Greatest distance of platform joints from their centroid, design units.
        pub platform_radius: Number = Number(found.radius[1]),
        /// Greatest error of all joints that keeps the accuracy, design units.
        pub joint_tolerance: Option<Number> = number(tolerance),
        /// Reason for no tolerance; null: there is one, or none was requested.
        pub no_tolerance: Option<String> = no_tolerance,
        /// Assumptions about masses, one sentence each. Empty: no figure is a force, a torque or a natural frequency.
        pub assumptions: Vec<String> = design.assumptions_of(AssessedForces {
            at_rest: found.force.is_some() || found.cranks.is_some_and(|cranks| cranks.torque.is_some()),
            in_motion: found.motion.speed.is_some() || found.frequency.is_some(),
        }),
    }
    /// The figures of a design.
    pub fn new(design: &Design, path: String, found: &DesignFigures, characteristic_length: f64) {
        let [shortest, longest] = found.lengths;
        let turns = found.cranks.is_some();
        let (tolerance, no_tolerance) = match &found.allowance {
            None => (None, None),
            Some(Ok(value)) => (Some(*value), None),
            Some(Err(why)) => (None, Some(why.to_string())),
        };
    }
}

view! {
    /// The figures of the cranks over the poses that all rods reach.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CrankFiguresRecord {
        /// Least crank angle, degrees; null: no pose is reached.
        pub least_deg: Option<Number> = number(cranks.angles_deg.map(|a| a[0])),
        /// Greatest crank angle, degrees.
        pub greatest_deg: Option<Number> = number(cranks.angles_deg.map(|a| a[1])),
        /// Least transmission angle, degrees: 0 at a singular crank.
        pub transmission_deg: Option<Number> = number(cranks.transmission_deg),
        /// Greatest torque under payload and loads, one at a time, force units times design units.
        pub torque: Option<Number> = number(cranks.torque),
        /// Greatest crank speed at the required platform speed, degrees per second.
        pub speed_deg: Option<Number> = number(cranks.speed_deg),
        /// Greatest torque along the manoeuvres.
        pub motion_torque: Option<Number> = number(found.motion.force),
        /// Greatest speed along the manoeuvres, degrees per second.
        pub motion_speed_deg: Option<Number> = number(found.motion.speed),
    }
    fn of(cranks: &CrankFigures, found: &DesignFigures) {
    }
}

fn number(x: Option<f64>) -> Option<Number> {
    x.map(Number)
}

/// A column of the table: a figure of every design.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureColumn {
    /// The title of the column.
    pub title: String,
    /// The unit; empty for pure numbers.
    pub unit: String,
    /// The cells by design; `None` for a design without the figure.
    pub cells: Vec<Option<FigureCell>>,
}

impl FigureColumn {
    /// The title with the unit.
    pub fn heading(&self) -> String {
        if self.unit.is_empty() { self.title.clone() } else { format!("{} [{}]", self.title, self.unit) }
    }
}

/// A cell of the table.
#[derive(Debug, Clone, PartialEq)]
pub enum FigureCell {
    /// A number; `true` marks a violated limit.
    Number(f64, bool),
    /// A word.
    Word(String),
}

impl CompareAnswer {
    /// The table: a column for every figure that some design has.
    pub fn columns(&self) -> Vec<FigureColumn> {
        let (length, force) = (self.length_unit.as_str(), self.force_unit.as_str());
        let speed = format!("{length}/s");
        let stiffness = format!("{force}/{length}");
        let torque = format!("{force} {length}");
        let mut out = vec![self.words("requirements", |d| {
            d.assessment.as_ref().map(|a| match a.met_at_assessed_poses() {
                Some(true) => a.assessed_poses.met_in_words.clone(),
                Some(false) => "violated".to_owned(),
                None => "undecided".to_owned(),
            })
        })];
        out.extend(self.margins());
        out.push(self.words("lightest drive", |d| {
            d.lightest_drive.as_ref().map(|l| l.name.clone().unwrap_or_else(|| "none".to_owned()))
        }));
        let of = |title: &str, unit: &str, value: &dyn Fn(&FiguresRecord) -> Option<Number>| FigureColumn {
            title: title.into(),
            unit: unit.into(),
            cells: self
                .designs
                .iter()
                .map(|d| value(d).filter(|x| !x.0.is_nan()).map(|x| FigureCell::Number(x.0, false)))
                .collect(),
        };
        out.extend([
            of("shortest leg", length, &|d| Some(d.shortest)),
            of("longest leg", length, &|d| Some(d.longest)),
            of("stroke used", length, &|d| Some(d.stroke)),
            of("greatest force", force, &|d| d.force),
            of("greatest speed", &speed, &|d| d.speed),
            of("force in motion", force, &|d| d.motion_force),
            of("speed in motion", &speed, &|d| d.motion_speed),
            of("least crank angle", "deg", &|d| d.cranks.as_ref()?.least_deg),
            of("greatest crank angle", "deg", &|d| d.cranks.as_ref()?.greatest_deg),
            of("least transmission angle", "deg", &|d| d.cranks.as_ref()?.transmission_deg),
            of("greatest torque", &torque, &|d| d.cranks.as_ref()?.torque),
            of("greatest crank speed", "deg/s", &|d| d.cranks.as_ref()?.speed_deg),
            of("torque in motion", &torque, &|d| d.cranks.as_ref()?.motion_torque),
            of("crank speed in motion", "deg/s", &|d| d.cranks.as_ref()?.motion_speed_deg),
            of("power in motion", "W", &|d| d.motion_power_w),
            of("conditioning", "", &|d| Some(d.conditioning)),
            of("least stiffness", &stiffness, &|d| d.stiffness),
            of("lowest frequency", "Hz", &|d| d.frequency_hz),
            of("joint distance, base", length, &|d| d.base_spacing),
            of("joint distance, platform", length, &|d| d.platform_spacing),
            of("leg clearance", length, &|d| d.clearance),
            of("radius, base", length, &|d| Some(d.base_radius)),
            of("radius, platform", length, &|d| Some(d.platform_radius)),
            of("different legs", "", &|d| Some(Number(d.different_legs as f64))),
            of("joint tolerance", length, &|d| d.joint_tolerance),
        ]);
        out.retain(|column| column.cells.iter().any(Option::is_some));
        out
    }

    fn words(&self, title: &str, word: impl Fn(&FiguresRecord) -> Option<String>) -> FigureColumn {
        let cells = self.designs.iter().map(|d| word(d).map(FigureCell::Word)).collect();
        FigureColumn { title: title.into(), unit: String::new(), cells }
    }

    /// A sentence for every design: its verdict with the poses assessed.
    pub fn verdicts(&self) -> Vec<String> {
        let sentence = |d: &FiguresRecord| match &d.assessment {
            Some(a) => format!("{} {}", d.name, a.explanation),
            None if d.assessed_poses.stated => format!("{} has no requirements", d.name),
            None => format!("{} has no requirements and no workspace: its figures are at home", d.name),
        };
        self.designs.iter().map(sentence).collect()
    }

    /// The characteristic length of every conditioning, in a sentence.
    pub fn yardstick(&self) -> String {
        let (length, unit) = (short(self.characteristic_length), &self.length_unit);
        format!("Every conditioning uses one characteristic length, {length} {unit}, from the first design.")
    }

    /// The assumptions about masses, one line each; an assumption of some designs only carries their names.
    pub fn assumptions(&self) -> Vec<String> {
        let mut sentences: Vec<&String> = Vec::new();
        for sentence in self.designs.iter().flat_map(|d| &d.assumptions) {
            if !sentences.contains(&sentence) {
                sentences.push(sentence);
            }
        }
        let line = |sentence: &String| {
            let has = |d: &&FiguresRecord| d.assumptions.contains(sentence);
            let names: Vec<&str> = self.designs.iter().filter(has).map(|d| d.name.as_str()).collect();
            if names.len() == self.designs.len() {
                sentence.clone()
            } else {
                format!("{}: {sentence}", names.join(", "))
            }
        };
        sentences.into_iter().map(line).collect()
    }

    /// A column for every kind of margin that some design has.
    fn margins(&self) -> Vec<FigureColumn> {
        let all = || self.designs.iter().filter_map(|d| d.assessment.as_ref()).flat_map(|a| &a.requirements);
        let mut kinds: Vec<_> = all().map(|m| m.name).collect();
        kinds.sort_unstable();
        kinds.dedup();
        let column = |kind: machine::requirements::TermKind| {
            let margin = |d: &FiguresRecord| {
                let found = d.assessment.as_ref()?.requirements.iter().find(|m| m.name == kind)?;
                Some(FigureCell::Number(found.margin.0, found.violates()))
            };
            FigureColumn {
                title: format!("margin of {}", kind.label()),
                unit: all().find(|m| m.name == kind).map(|m| m.unit.clone()).unwrap_or_default(),
                cells: self.designs.iter().map(margin).collect(),
            }
        };
        kinds.into_iter().map(column).collect()
    }
}
