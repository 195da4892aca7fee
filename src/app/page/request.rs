//! The requests of a page.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::session::{Equivalent, InvalidStart, Session};
use super::{
    begin, derivation, feasible, limits, modes, motion, opening, path, plane, scene, surface, worst,
};
use ask::design::parse_ideal;
use files::design::Format;
use machine::requirements::AssessOptions;
use platform::geom::Pose;
use records::{AssessAnswer, PoseRecord};
use synthesis::Pattern;

/// A platform of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Which {
    /// The octahedral original, or else the design.
    First,
    /// The equivalent platform.
    Second,
}

/// An equivalent platform, as requested.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Chosen {
    pattern: String,
    offsets: Vec<f64>,
}

impl From<&Equivalent> for Chosen {
    fn from(e: &Equivalent) -> Self {
        Self { pattern: e.pattern.to_string(), offsets: e.offsets.clone() }
    }
}

/// A request.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "lowercase")]
pub(super) enum PageRequest {
    /// The contents of the page.
    Open,
    /// Starting offsets.
    Start { pattern: String },
    /// The pose at a share of the path.
    Path { at: f64 },
    /// The pose of six numbers in the convention of the design.
    Place { numbers: [f64; 6] },
    /// The pose at a position with a unit quaternion, scalar part first, as other answers give their worst poses.
    Quaternion { p: [f64; 3], q: [f64; 4] },
    /// All results about both platforms at a pose, with the answer of `Assess` in the table of requirements.
    State { pose: PoseRecord, chosen: Option<Chosen>, limits: Option<Box<AssessAnswer>> },
    /// Worst conditioning over the poses of the workspace.
    Worst { chosen: Option<Chosen> },
    /// The requirements of a platform over its whole workspace, as in `assess` with these numbers; the default for
    /// cells is that of `assess`.
    Assess { which: Which, chosen: Option<Chosen>, points: usize, searches: usize, cells: Option<usize> },
    /// All poses with given leg lengths, or with the lengths at a pose; for cranks, angles in degrees.
    Modes { pose: PoseRecord, lengths: Option<[f64; 6]>, which: Which, chosen: Option<Chosen> },
    /// All poses of both platforms, each from its own leg lengths, paired.
    Confirm { pose: PoseRecord, chosen: Chosen },
    /// The derivation of the leg map from coplanar joints.
    Derivation { chosen: Chosen },
    /// `det A` over two offsets.
    Plane { chosen: Chosen, axes: [usize; 2], range: [f64; 2], points: usize },
    /// Violated requirements over two offsets, at the poses that `assess` with this number of points evaluates before
    /// its searches.
    Feasible { chosen: Chosen, axes: [usize; 2], range: [f64; 2], points: usize, samples: usize },
    /// `det A = 0` over three offsets.
    Surface { chosen: Chosen, axes: [usize; 3], range: [f64; 2], points: usize },
    /// `det J = 0` over positions with the orientation of a pose.
    Locus { pose: PoseRecord, which: Which, chosen: Option<Chosen>, points: usize },
    /// The curve of poses with the leg lengths of a pose.
    Motion { pose: PoseRecord, which: Which, chosen: Option<Chosen> },
    /// Names of the presets.
    Presets,
    /// A preset as a design file.
    Preset { name: String },
    /// Twelve points from a table, as a design file.
    Points { text: String, units: String },
    /// A hexapod with the numbers of a data sheet, as a design file.
    Sheet(begin::DataSheet),
    /// The design with the symmetry of its joints as constructions, as a design file.
    Snap,
    /// The platform as a design file.
    Design { which: Which, chosen: Option<Chosen> },
}

/// Starting offsets.
#[derive(Debug, Serialize)]
struct OffsetsRecord {
    offsets: Vec<f64>,
}

/// A platform as a design file.
#[derive(Debug, Serialize)]
struct FileRecord {
    name: String,
    toml: String,
    json: String,
}

/// A refusal.
#[derive(Debug, Serialize)]
struct RefusalRecord {
    error: Refusal,
}

/// A record as JSON; every record consists of texts, numbers, lists and fields, so this cannot fail.
fn value(record: impl Serialize) -> Value {
    serde_json::to_value(record).unwrap_or_default()
}

/// The reason why there is no answer.
#[derive(Debug, Serialize)]
pub(super) struct Refusal {
    code: &'static str,
    message: String,
}

impl Refusal {
    pub(super) fn new(code: &'static str, message: impl std::fmt::Display) -> Self {
        Self { code, message: message.to_string() }
    }

    fn record(self) -> Value {
        value(RefusalRecord { error: self })
    }
}

impl From<InvalidStart> for Refusal {
    fn from(e: InvalidStart) -> Self {
        Self::new("offsets", e)
    }
}

impl Chosen {
    fn equivalent(self) -> Result<Equivalent, Refusal> {
        let pattern: Pattern = self.pattern.parse().map_err(|e| Refusal::new("pattern", e))?;
        Ok(Equivalent { pattern, offsets: self.offsets })
    }
}

impl Session {
    /// Opens the design in a JSON text `{"design": TOML, "trajectory": [poses], "start": {"pattern", "offsets"}}`, the
    /// last two optional.
    ///
    /// # Errors
    /// A JSON text `{"error": {"code", "message"}}`.
    pub fn open(text: &str) -> Result<Self, String> {
        opened(text).map_err(|e| e.record().to_string())
    }

    /// The answer to a request, both in JSON. An invalid request gives `{"error": {"code", "message"}}`.
    #[must_use]
    pub fn answer(&self, request: &str) -> String {
        let request: Result<PageRequest, _> = serde_json::from_str(request);
        let request = request.map_err(|e| Refusal::new("request", e));
        request.map_or_else(Refusal::record, |r| self.reply(r)).to_string()
    }

    /// The answer to a request, or the refusal.
    pub(super) fn reply(&self, request: PageRequest) -> Value {
        self.respond(request).unwrap_or_else(Refusal::record)
    }

    fn respond(&self, request: PageRequest) -> Result<Value, Refusal> {
        let equivalent = |c: Option<Chosen>| c.map(Chosen::equivalent).transpose();
        if self.cranks.is_some() && matches!(request, PageRequest::Locus { .. } | PageRequest::Motion { .. })
        {
            let message = "the legs are rods on cranks, but this answer needs legs of variable length";
            return Err(Refusal::new("rotary", message));
        }
        match request {
            PageRequest::Open => Ok(value(opening::record(self))),
            PageRequest::Start { pattern } => {
                let pattern: Pattern = pattern.parse().map_err(|e| Refusal::new("pattern", e))?;
                Ok(value(OffsetsRecord { offsets: self.first_offsets(&pattern)? }))
            }
            PageRequest::Path { at } => Ok(value(path::record(self, at))),
            PageRequest::Place { numbers } => {
                let frames = self.frames();
                let pose = frames.convention.read(&numbers, &frames.home);
                Ok(value(path::PathPose::from(&pose.map_err(|e| Refusal::new("pose", e))?)))
            }
            PageRequest::Quaternion { p, q } => {
                let pose = Pose::from_quaternion(p, q).map_err(|e| Refusal::new("pose", e))?;
                Ok(value(path::PathPose::from(&pose)))
            }
            PageRequest::State { pose, chosen, limits } => {
                let chosen = equivalent(chosen)?;
                scene::record(self, &Pose::from(&pose), chosen.as_ref(), limits.as_deref()).map(value)
            }
            PageRequest::Worst { chosen } => worst::record(self, equivalent(chosen)?.as_ref()).map(value),
            PageRequest::Assess { which, chosen, points, searches, cells } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                let options = AssessOptions::new().points(points).searches(searches);
                limits::record(&design, &options, cells).map(value)
            }
            PageRequest::Modes { pose, lengths, which, chosen } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                modes::record(self, &design, &Pose::from(&pose), lengths).map(value)
            }
            PageRequest::Confirm { pose, chosen } => {
                let second = self.second(&chosen.equivalent()?)?.0;
                modes::confirm(self.first().manipulator(), second.manipulator(), &Pose::from(&pose))
                    .map(value)
            }
            PageRequest::Derivation { chosen } => derivation::record(self, &chosen.equivalent()?).map(value),
            PageRequest::Plane { chosen, axes, range, points } => {
                plane::record(&chosen.equivalent()?, axes, range, points).map(value)
            }
            PageRequest::Feasible { chosen, axes, range, points, samples } => {
                let options = AssessOptions::new().points(samples);
                feasible::record(self, &chosen.equivalent()?, axes, range, points, &options).map(value)
            }
            PageRequest::Surface { chosen, axes, range, points } => {
                surface::offsets(&chosen.equivalent()?, axes, range, points).map(value)
            }
            PageRequest::Locus { pose, which, chosen, points } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                surface::locus(&design, &self.home, &Pose::from(&pose), points).map(value)
            }
            PageRequest::Motion { pose, which, chosen } => {
                motion::record(&self.platform(which, equivalent(chosen)?)?, &Pose::from(&pose)).map(value)
            }
            PageRequest::Presets => Ok(value(begin::presets())),
            PageRequest::Preset { name } => begin::preset(&name).map(value),
            PageRequest::Points { text, units } => begin::points(&text, &units).map(value),
            PageRequest::Sheet(sheet) => sheet.made().map(value),
            PageRequest::Snap => begin::snapped(&self.design).map(value),
            PageRequest::Design { which, chosen } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                let (toml, json) = (design.to_toml(), design.to_json());
                Ok(value(FileRecord { name: design.name.clone(), toml, json }))
            }
        }
    }

    fn platform(&self, which: Which, equivalent: Option<Equivalent>) -> Result<ask::Design, Refusal> {
        match (which, equivalent) {
            (Which::First, _) => Ok(self.first().clone()),
            (Which::Second, Some(e)) => Ok(self.second(&e)?.0),
            (Which::Second, None) => Err(Refusal::new("request", "the second platform is not described")),
        }
    }
}

/// The input of [`Session::open`].
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Opening {
    design: String,
    #[serde(default)]
    trajectory: Vec<PoseRecord>,
    start: Option<Chosen>,
}

impl From<&Session> for Opening {
    /// The input that opens the same session.
    fn from(session: &Session) -> Self {
        let trajectory = session.design.workspace.trajectory.as_ref();
        Self {
            design: session.design.to_toml(),
            trajectory: trajectory.map_or_else(Vec::new, |t| t.poses.iter().map(PoseRecord::from).collect()),
            start: session.start.as_ref().map(Chosen::from),
        }
    }
}

fn opened(text: &str) -> Result<Session, Refusal> {
    let opening: Opening = serde_json::from_str(text).map_err(|e| Refusal::new("request", e))?;
    let (mut design, _) = parse_ideal(&opening.design, Format::Toml).map_err(|violations| {
        let list: Vec<String> =
            violations.iter().map(|v| format!("line {}: {}", v.line, v.message)).collect();
        Refusal::new("design", list.join("; "))
    })?;
    if let Some(trajectory) = &mut design.workspace.trajectory {
        trajectory.poses = opening.trajectory.iter().map(Pose::from).collect();
    }
    let session = Session::new(design);
    let Some(start) = opening.start else { return Ok(session) };
    let start = start.equivalent()?;
    Ok(session.starting_with(start.pattern, start.offsets)?)
}
