//! What a page may ask.

use serde::Deserialize;
use serde_json::{Value, json};

use super::session::{Equivalent, InvalidStart, Session};
use super::wire::{PoseRecord, numbers};
use super::{modes, motion, opening, path, plane, scene, worst};
use crate::design::{Format, parse};
use crate::geom::Pose;
use crate::synthesis::Pattern;

/// Which platform of the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Which {
    /// The octahedral original, or the design where there is none.
    First,
    /// The equivalent.
    Second,
}

/// An equivalent platform, as asked for.
#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Chosen {
    pattern: String,
    offsets: Vec<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(tag = "op", rename_all = "lowercase")]
enum Request {
    /// What there is to show.
    Open,
    /// Offsets to begin with.
    Start { pattern: String },
    /// The pose at a share of the way round.
    Path { at: f64 },
    /// Everything about both platforms at a pose.
    State { pose: PoseRecord, chosen: Option<Chosen> },
    /// Worst conditioning over the poses of the workspace.
    Worst { chosen: Option<Chosen> },
    /// All poses with given leg lengths, or with those of a pose.
    Modes { pose: PoseRecord, lengths: Option<[f64; 6]>, which: Which, chosen: Option<Chosen> },
    /// All poses of both platforms, each from its own leg lengths, paired.
    Confirm { pose: PoseRecord, chosen: Chosen },
    /// `det A` over two offsets.
    Plane { chosen: Chosen, axes: [usize; 2], range: [f64; 2], points: usize },
    /// The curve of poses with the leg lengths of a pose.
    Motion { pose: PoseRecord, which: Which, chosen: Option<Chosen> },
    /// The platform as a design file.
    Design { which: Which, chosen: Option<Chosen> },
}

/// Why there is no answer.
#[derive(Debug)]
pub(super) struct Refusal {
    code: &'static str,
    message: String,
}

impl Refusal {
    pub(super) fn new(code: &'static str, message: impl std::fmt::Display) -> Self {
        Self { code, message: message.to_string() }
    }

    fn record(&self) -> Value {
        json!({"error": {"code": self.code, "message": self.message}})
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
    /// Opens the design in a JSON text `{"design": TOML, "trajectory": [poses], "start": {"pattern", "offsets"}}`, the last two optional.
    ///
    /// # Errors
    /// A JSON text `{"error": {"code", "message"}}`.
    pub fn open(text: &str) -> Result<Self, String> {
        opened(text).map_err(|e| e.record().to_string())
    }

    /// The answer to a request, both in JSON. A request that cannot be answered gives `{"error": {"code", "message"}}`.
    #[must_use]
    pub fn answer(&self, request: &str) -> String {
        let request: Result<Request, _> = serde_json::from_str(request);
        let request = request.map_err(|e| Refusal::new("request", e));
        request.and_then(|r| self.respond(r)).unwrap_or_else(|e| e.record()).to_string()
    }

    fn respond(&self, request: Request) -> Result<Value, Refusal> {
        let equivalent = |c: Option<Chosen>| c.map(Chosen::equivalent).transpose();
        match request {
            Request::Open => Ok(opening::record(self)),
            Request::Start { pattern } => {
                let pattern: Pattern = pattern.parse().map_err(|e| Refusal::new("pattern", e))?;
                Ok(json!({"offsets": numbers(self.first_offsets(&pattern)?)}))
            }
            Request::Path { at } => Ok(path::record(self, at)),
            Request::State { pose, chosen } => {
                scene::record(self, &Pose::from(&pose), equivalent(chosen)?.as_ref())
            }
            Request::Worst { chosen } => worst::record(self, equivalent(chosen)?.as_ref()),
            Request::Modes { pose, lengths, which, chosen } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                modes::record(design.manipulator(), &self.home, &Pose::from(&pose), lengths)
            }
            Request::Confirm { pose, chosen } => {
                let second = self.second(&chosen.equivalent()?)?.0;
                modes::confirm(self.first().manipulator(), second.manipulator(), &Pose::from(&pose))
            }
            Request::Plane { chosen, axes, range, points } => {
                plane::record(&chosen.equivalent()?, axes, range, points)
            }
            Request::Motion { pose, which, chosen } => {
                motion::record(self.platform(which, equivalent(chosen)?)?.manipulator(), &Pose::from(&pose))
            }
            Request::Design { which, chosen } => {
                let design = self.platform(which, equivalent(chosen)?)?;
                Ok(json!({"name": design.name, "toml": design.to_toml(), "json": design.to_json()}))
            }
        }
    }

    fn platform(
        &self,
        which: Which,
        equivalent: Option<Equivalent>,
    ) -> Result<crate::design::Design, Refusal> {
        match (which, equivalent) {
            (Which::First, _) => Ok(self.first().clone()),
            (Which::Second, Some(e)) => Ok(self.second(&e)?.0),
            (Which::Second, None) => Err(Refusal::new("request", "the second platform is not described")),
        }
    }
}

#[derive(Debug, Deserialize)]
struct Opening {
    design: String,
    #[serde(default)]
    trajectory: Vec<PoseRecord>,
    start: Option<Chosen>,
}

fn opened(text: &str) -> Result<Session, Refusal> {
    let opening: Opening = serde_json::from_str(text).map_err(|e| Refusal::new("request", e))?;
    let (mut design, _) = parse(&opening.design, Format::Toml).map_err(|violations| {
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
