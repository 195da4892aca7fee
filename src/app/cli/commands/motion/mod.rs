//! `equipod motion`: forces, speeds, accelerations and powers of the legs along a trajectory or standard manoeuvres.

mod render;

use std::path::{Path, PathBuf};

use crate::app::cli::frames::{FrameArgs, note_frames};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use crate::app::cli::{poses, rows};
use ::files::export::LengthUnit;
use ask::{Design, MotionMasses, MotionReport, PlatformMotion, PoseFrames};
use machine::dynamics::{InvalidManoeuvre, Manoeuvre, PathEnds, PosePath};
use machine::requirements::Load;
use platform::geom::Pose;
use records::{MotionAnswer, MotionRunRecord, StiffnessRecord};

/// Arguments of `motion`.
#[derive(Debug, clap::Args)]
pub(crate) struct MotionArgs {
    /// Design file (.toml or .json) with `[home]`, `[payload]` and `[hardware]`
    design: PathBuf,
    /// Table of times and poses (`-` for standard input)
    trajectory: Option<PathBuf>,
    /// Sine about a pose: x, y, z (design units), roll, pitch or yaw (degrees), amplitude and frequency; repeat for
    /// several
    #[arg(long, value_name = "AXIS:AMPLITUDE:HERTZ", allow_hyphen_values = true)]
    sine: Vec<String>,
    /// Acceleration from rest at a pose, design units or degrees per second squared; repeat for several
    #[arg(long, value_name = "AXIS:ACCELERATION", allow_hyphen_values = true)]
    accelerate: Vec<String>,
    /// Add stiffness and natural frequencies at --about
    #[arg(long)]
    stiffness: bool,
    /// Pose of sines, accelerations and stiffness: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    about: String,
    /// Name of a load of the design that acts beside the weight
    #[arg(long, value_name = "NAME")]
    load: Option<String>,
    /// Rest at the first and last pose of the trajectory
    #[arg(long)]
    at_rest: bool,
    /// Number of steps between two poses of the trajectory
    #[arg(long, value_name = "N", default_value_t = STEPS, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    steps: u32,
    /// Number of instants in the period of a sine
    #[arg(long, value_name = "N", default_value_t = SAMPLES, value_parser = clap::value_parser!(u32).range(4..=1_000_000))]
    samples: u32,
    /// Length unit of the design, if its label is not one: um, mm, cm, m, in, ft
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Write a table of all instants
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
    #[command(flatten)]
    frames: FrameArgs,
}

/// The motions requested by a command.
#[derive(Debug, Clone, Copy)]
pub(in crate::app::cli::commands) struct ChosenMotions<'a> {
    trajectory: Option<&'a Path>,
    sine: &'a [String],
    accelerate: &'a [String],
    at_rest: bool,
    /// The pose of the manoeuvres, as written.
    about: &'a str,
    steps: u32,
    samples: u32,
    frames: FrameArgs,
}

impl<'a> ChosenMotions<'a> {
    /// The given motions about home, with the usual numbers of instants.
    pub(in crate::app::cli::commands) fn new(
        trajectory: Option<&'a Path>,
        sine: &'a [String],
        accelerate: &'a [String],
    ) -> Self {
        Self {
            trajectory,
            sine,
            accelerate,
            at_rest: false,
            about: "home",
            steps: STEPS,
            samples: SAMPLES,
            frames: FrameArgs::default(),
        }
    }

    fn of(args: &'a MotionArgs) -> Self {
        let MotionArgs { at_rest, about, steps, samples, frames, .. } = args;
        let chosen = Self::new(args.trajectory.as_deref(), &args.sine, &args.accelerate);
        Self { at_rest: *at_rest, about, steps: *steps, samples: *samples, frames: *frames, ..chosen }
    }

    /// Whether no motion is requested.
    pub(in crate::app::cli::commands) fn is_empty(&self) -> bool {
        self.trajectory.is_none() && self.sine.is_empty() && self.accelerate.is_empty()
    }

    /// The motions with their names, in the order of the answer.
    pub(in crate::app::cli::commands) fn motions(
        &self,
        design: &Design,
        context: &Context,
    ) -> Result<Vec<(String, PlatformMotion)>, Failure> {
        let mut out = Vec::new();
        let frames = self.frames.of(design);
        if let Some(path) = self.trajectory {
            let ends = if self.at_rest { PathEnds::AtRest } else { PathEnds::Free };
            let motion = PlatformMotion::Path(
                trajectory(path, ends, (&frames, &design.units), context)?,
                self.steps as usize,
            );
            out.push((files::shown(path), motion));
        }
        let about = about(self.about, &frames, context)?;
        for (name, manoeuvre) in manoeuvres(self.sine, self.accelerate, "motion::bad_manoeuvre")? {
            let samples = if matches!(manoeuvre, Manoeuvre::Sine { .. }) { self.samples as usize } else { 1 };
            out.push((name, PlatformMotion::Manoeuvre(manoeuvre, about, samples)));
        }
        Ok(out)
    }
}

/// The manoeuvres of `--sine` and `--accelerate` with their names.
///
/// # Errors
/// Exit 2 with this code: a text that states no manoeuvre.
pub(in crate::app::cli::commands) fn manoeuvres(
    sine: &[String],
    accelerate: &[String],
    code: &str,
) -> Result<Vec<(String, Manoeuvre)>, Failure> {
    let refused = |option: &str, why: InvalidManoeuvre| {
        let help = "an axis is x, y, z, roll, pitch or yaw: --sine z:50:1, --accelerate yaw:90";
        Failure::refused(code, format!("{option}: {why}")).with_help(help)
    };
    let mut out = Vec::new();
    for text in sine {
        out.push((format!("sine {text}"), Manoeuvre::sine(text).map_err(|e| refused("--sine", e))?));
    }
    for text in accelerate {
        let start = Manoeuvre::acceleration(text).map_err(|e| refused("--accelerate", e))?;
        out.push((format!("accelerate {text}"), start));
    }
    Ok(out)
}

/// Number of steps between two poses of a trajectory.
const STEPS: u32 = 10;
/// Number of instants in the period of a sine.
const SAMPLES: u32 = 360;

const BAD_TRAJECTORY: &str = "motion::bad_trajectory";

/// Exit 1 if a sampled instant violates a limit, or forces are not determined.
pub(crate) fn run(args: &MotionArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_ideal(&args.design)?;
    refuse_without_effect(args, &design, context)?;
    let chosen = ChosenMotions::of(args);
    let motions = chosen.motions(&design, context)?;
    if chosen.is_empty() && !args.stiffness {
        let help = "give a table of times and poses, --sine z:50:1 or --accelerate x:2000";
        return Err(Failure::refused("motion::no_motion", "no motion is given").with_help(help));
    }
    note_frames(&args.frames.of(&design), context);
    let masses = masses(args, &design)?;
    let found: Vec<(String, MotionReport)> =
        motions.iter().map(|(name, motion)| (name.clone(), design.along(motion, masses.as_ref()))).collect();
    let stiffness = stiffness(args, &design, masses.as_ref(), context)?;
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(&design, &args.frames.of(&design), &found))?;
    }
    let records: Vec<MotionRunRecord> =
        found.iter().map(|(name, report)| MotionRunRecord::new(&design, name.clone(), report)).collect();
    let answer = MotionAnswer {
        name: design.name.clone(),
        frames: (&args.frames.of(&design).convention).into(),
        met: records.iter().all(|r| r.met),
        length_unit: design.units.clone(),
        force_unit: design.force_unit().label().into(),
        assumptions: design.mass_assumptions(),
        motions: records,
        stiffness,
        csv: args.csv.as_ref().map(|path| path.display().to_string()),
    };
    let exit = if answer.met { Exit::Yes } else { Exit::No };
    let text = sheet::answers::motion(&answer);
    Ok(Answer::new(exit, answer, text))
}

fn refuse_without_effect(args: &MotionArgs, design: &Design, context: &Context) -> Result<(), Failure> {
    if args.trajectory.is_none() {
        context.no_effect("at_rest", "there is no trajectory")?;
        context.no_effect("steps", "there is no trajectory")?;
    }
    if ChosenMotions::of(args).is_empty() {
        context.no_effect("csv", "there is no motion")?;
        context.no_effect("load", "there is no motion")?;
    }
    if args.sine.is_empty() {
        context.no_effect("samples", "there is no sine")?;
    }
    if args.sine.is_empty() && args.accelerate.is_empty() && !args.stiffness {
        context.no_effect(
            "about",
            "there is neither a sine nor an acceleration, and --stiffness is not given",
        )?;
    }
    if design.moving_payload().is_none() {
        for option in ["load", "unit"] {
            context.no_effect(option, "the design has no payload, so that no forces are computed")?;
        }
    }
    Ok(())
}

fn about(text: &str, frames: &PoseFrames, context: &Context) -> Result<Pose, Failure> {
    poses::parse(text, frames, ("--about", "motion::bad_pose"), context)
}

/// The stiffness at the requested pose.
fn stiffness(
    args: &MotionArgs,
    design: &Design,
    masses: Option<&MotionMasses>,
    context: &Context,
) -> Result<Option<StiffnessRecord>, Failure> {
    if !args.stiffness {
        return Ok(None);
    }
    if design.has_cranks() {
        let message = "the legs are rods on cranks; stiffness is computed for legs of variable length only";
        return Err(Failure::refused("motion::no_stiffness", message).with_help(
            "leave out --stiffness; `equipod ik` gives the torques that hold the loads at a pose",
        ));
    }
    let about = about(&args.about, &args.frames.of(design), context)?;
    let found = design.stiffness_at(&about, masses).ok_or_else(|| {
        Failure::refused("motion::no_stiffness", "the design has no stiffness of its legs")
            .with_help("add `leg_stiffness` to [hardware], in force units per design unit")
    })?;
    Ok(Some(StiffnessRecord::new(&found)))
}

/// The motion through the poses of a table.
fn trajectory(
    path: &Path,
    ends: PathEnds,
    frames: (&PoseFrames, &str),
    context: &Context,
) -> Result<PosePath, Failure> {
    let series = rows::poses(path, BAD_TRAJECTORY, frames, context)?;
    let shown = files::shown(path);
    let Some(name) = &series.time_name else {
        let message = format!("{shown} has no column of times");
        let help = "name a column `t` or `time_s` in the first line, with times in seconds";
        return Err(Failure::refused("motion::no_times", message).with_help(help));
    };
    let letters: String = name.to_lowercase().chars().filter(char::is_ascii_alphanumeric).collect();
    let in_milliseconds = letters.ends_with("ms") || letters.ends_with("milliseconds");
    if in_milliseconds {
        context.note_guesses(&shown, &["The times are in milliseconds, as the header says.".into()]);
    }
    let second = if in_milliseconds { 1e-3 } else { 1.0 };
    let times: Vec<f64> = series.rows.iter().filter_map(|row| row.time).map(|t| t * second).collect();
    let all: Vec<Pose> = series.rows.iter().map(|row| row.value).collect();
    PosePath::through(&times, &all, ends).map_err(|why| {
        let line = why.row().and_then(|row| series.rows.get(row)).map(|row| format!("line {}: ", row.line));
        let message = format!("{shown}: {}{why}", line.unwrap_or_default());
        Failure::refused(BAD_TRAJECTORY, message)
            .with_help("give poses in the order of time, close enough to each other to follow the motion")
    })
}

/// The masses for forces; none without a payload.
fn masses(args: &MotionArgs, design: &Design) -> Result<Option<MotionMasses>, Failure> {
    if design.moving_payload().is_none() {
        return Ok(None);
    }
    let metres = metres(args.unit.as_deref(), design)?;
    let load = args.load.as_deref().map(|name| load(design, name)).transpose()?;
    Ok(design.motion_masses(metres, load))
}

/// The length of one unit of the design or of `--unit`, metres.
pub(in crate::app::cli::commands) fn metres(label: Option<&str>, design: &Design) -> Result<f64, Failure> {
    let unit = match label {
        Some(label) => LengthUnit::of(label)
            .map_err(|e| Failure::refused("motion::unknown_unit", format!("--unit: {e}")))?,
        None => LengthUnit::of(&design.units).map_err(|e| {
            let message = format!("the units of the design cannot be used: {e}");
            Failure::refused("motion::unknown_unit", message)
                .with_help("state the unit of the design, such as `--unit mm`")
        })?,
    };
    Ok(unit.metres)
}

fn load(design: &Design, name: &str) -> Result<Load, Failure> {
    design.loads.iter().find(|l| l.name == name).cloned().ok_or_else(|| {
        let names: Vec<&str> = design.loads.iter().map(|l| l.name.as_str()).collect();
        let help = if names.is_empty() {
            "the design has none: add [[loads]]".to_string()
        } else {
            format!("its loads are {}", names.join(", "))
        };
        Failure::refused("motion::no_such_load", format!("`{name}` is no load of the design")).with_help(help)
    })
}
