//! `equipod calibrate`: joint centres and leg offsets from measured poses and lengths.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use crate::app::cli::args::choice;
use crate::app::cli::frames::{FrameArgs, note_frames};
use crate::app::cli::rows;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ask::{Design, Error, PoseFrames};
use machine::calibration::{
    CalibrateOptions, Calibration, CalibrationError, CalibrationStatus, CarriedFrames, HeldParts, Loss,
    LossUnit, Measurement, MeasurementNoise, NextPose, StartChoice, Unknowns, next_poses, planning_root,
};
use platform::geom::Pose;
use records::{
    CalibrateAnswer, CalibrateOutcome, CalibrationRecord, ComputedPosesRecord, NextPoseRecord, Number,
    ResidualsRecord,
};

/// Arguments of `calibrate`.
#[derive(Debug, clap::Args)]
pub(crate) struct CalibrateArgs {
    /// Design file (.toml or .json) of the nominal machine
    design: PathBuf,
    /// Table of measured poses and lengths (`-` for standard input); without it, poses to measure are planned
    measurements: Option<PathBuf>,
    /// Standard deviation of a length, design units; default: estimated, for exact poses
    #[arg(long, value_name = "LENGTH", allow_hyphen_values = true)]
    sigma_length: Option<f64>,
    /// Standard deviation of a measured coordinate, design units; default 0
    #[arg(long, value_name = "LENGTH", requires = "sigma_length", allow_hyphen_values = true)]
    sigma_position: Option<f64>,
    /// Standard deviation of a measured rotation vector component, degrees; default 0
    #[arg(long, value_name = "DEG", requires = "sigma_length", allow_hyphen_values = true)]
    sigma_rotation_deg: Option<f64>,
    /// Loss function; all except squares tolerate gross errors
    #[arg(long, default_value = "squares", value_parser = choice(&Loss::ALL, Loss::name))]
    loss: Loss,
    /// Unit rejected by the loss: a pose, or a leg length
    #[arg(long, default_value = "pose", value_parser = choice(&LossUnit::ALL, LossUnit::name))]
    loss_of: LossUnit,
    /// Frames of the joints: of the measurement, or fitted to the design
    #[arg(long, value_enum, default_value_t = FramesArg::Measured)]
    frames: FramesArg,
    /// Known quantities to hold, separated by commas
    #[arg(long, value_enum, value_delimiter = ',')]
    hold: Vec<HeldArg>,
    /// Start of the fit: the design, a closed form, or the better of both
    #[arg(long, default_value = "best", value_parser = choice(&StartChoice::ALL, StartChoice::name))]
    start: StartChoice,
    /// Greatest standard deviation of an identified change, over the size of the design
    #[arg(long, value_name = "SHARE", default_value_t = 0.01, allow_hyphen_values = true)]
    identified: f64,
    /// Second table of measurements, for residuals outside the fit
    #[arg(long, value_name = "FILE")]
    check: Option<PathBuf>,
    /// Number of poses to measure next
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = clap::value_parser!(u16).range(0..=200))]
    next: u16,
    /// Number of Halton points in the workspace, and of random ones: candidates for --next, and poses for the
    /// uncertainty
    #[arg(long, value_name = "N", default_value_t = 300, value_parser = clap::value_parser!(u16).range(1..=5000))]
    candidates: u16,
    /// Write the calibrated design, if identified and not refuted
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    #[command(flatten)]
    convention: FrameArgs,
}

/// `--frames`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum FramesArg {
    Measured,
    Design,
}

/// `--hold`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum HeldArg {
    Base,
    Platform,
    Offsets,
}

const BAD_MEASUREMENTS: &str = "calibrate::bad_measurements";

impl CalibrateArgs {
    fn options(&self) -> CalibrateOptions {
        let noise = |length| MeasurementNoise {
            length,
            position: self.sigma_position.unwrap_or(0.0),
            rotation: self.sigma_rotation_deg.unwrap_or(0.0).to_radians(),
        };
        let held = HeldParts {
            base: self.hold.contains(&HeldArg::Base),
            platform: self.hold.contains(&HeldArg::Platform),
            offsets: self.hold.contains(&HeldArg::Offsets),
        };
        CalibrateOptions::default()
            .noise(self.sigma_length.map(noise))
            .loss(self.loss)
            .loss_unit(self.loss_of)
            .held(held)
            .start(self.start)
            .identified(self.identified)
    }

    fn refuse_without_effect(&self, context: &Context) -> Result<(), Failure> {
        if self.measurements.is_none() {
            for option in ["loss", "loss_of", "frames", "start", "check", "output"] {
                context.no_effect(option, "there are no measurements")?;
            }
        }
        if self.loss == Loss::Squares {
            context.no_effect("loss_of", "the loss of squares rejects no measurement")?;
        }
        Ok(())
    }
}

/// Exit 0 if the machine is calibrated, 1 if it is not identifiable or the model is refuted, 3 if undecided.
pub(crate) fn run(args: &CalibrateArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    args.refuse_without_effect(context)?;
    let options = args.options();
    let Some(path) = &args.measurements else { return plan(args, &design, &options, context) };
    let mut poses = args.convention.of(&design);
    let (rows, lines) = measurements(path, &mut poses, &design.units, context)?;
    let check = args
        .check
        .as_deref()
        .map(|path| measurements(path, &mut poses.clone(), &design.units, context))
        .transpose()?;
    let found = design.calibrate(&rows, &options).map_err(|e| failure_of(&e))?;
    let frames = frames(args, &design, &found)?;
    let mut record =
        CalibrationRecord::new(&design, &found, (options.loss, options.loss_unit), frames.as_ref(), &lines);
    record.check = check.map(|(rows, lines)| ResidualsRecord::new(&found.residuals_of(&rows), &lines));
    let candidates = design.measurable_poses(args.candidates.into(), context.seed());
    let measured: Vec<Pose> = match &frames {
        None => candidates.clone(),
        Some(frames) => candidates.iter().map(|pose| frames.measured_pose(pose)).collect(),
    };
    if found.status != CalibrationStatus::NotIdentifiable {
        record.computed_poses = ComputedPosesRecord::new(&found, &measured);
    }
    let outcome = CalibrateOutcome::from(found.status);
    let path = match (&args.output, found.status) {
        (Some(path), CalibrationStatus::Calibrated) => {
            let calibrated = design.with_calibration(&found, frames.as_ref()).map_err(|e| failure_of(&e))?;
            files::write_design(path, &calibrated)?;
            Some(path.display().to_string())
        }
        _ => None,
    };
    let next_poses = next((args, &poses), &found, &candidates, &measured);
    let answer = CalibrateAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        frames: (&poses.convention).into(),
        outcome,
        reason: reason(&found),
        calibration: Some(record),
        next_poses,
        path,
    };
    let text = sheet::answers::calibrate(&answer, args.output.is_some());
    Ok(Answer::new(exit_of(outcome), answer, text))
}

fn exit_of(outcome: CalibrateOutcome) -> Exit {
    match outcome {
        CalibrateOutcome::Calibrated | CalibrateOutcome::Planned => Exit::Yes,
        CalibrateOutcome::NotIdentifiable | CalibrateOutcome::Refuted => Exit::No,
        CalibrateOutcome::Undecided => Exit::Inconclusive,
    }
}

/// The reason of the outcome.
fn reason(found: &Calibration) -> String {
    let (rank, unknowns) = (found.observability.rank, found.unknowns.count());
    match found.status {
        CalibrationStatus::Calibrated => {
            format!("all {unknowns} unknowns are identified, and the residuals are consistent with the model")
        }
        CalibrationStatus::NotIdentifiable => {
            format!(
                "the measurements do not see {} of {unknowns} independent changes of the machine",
                unknowns - rank
            )
        }
        CalibrationStatus::Refuted => {
            "the residuals are too large for the noise given: a measurement, the noise or the model is wrong"
                .into()
        }
        CalibrationStatus::Undecided if found.converged => {
            "there are no more numbers than unknowns, so that nothing speaks for or against the model".into()
        }
        CalibrationStatus::Undecided => "the fit did not converge".into(),
    }
}

fn failure_of(error: &Error) -> Failure {
    let Error::Calibration(why) = error else {
        return Failure::new(Exit::No, "calibrate::bad_machine", error.to_string())
            .with_help("no such machine fits the measurements: check their columns and units");
    };
    match why {
        CalibrationError::BadNoise { .. } => Failure::refused("calibrate::bad_noise", why.to_string())
            .with_help(
                "give --sigma-length above 0, and --sigma-position and --sigma-rotation-deg of 0 or more",
            ),
        CalibrationError::NothingUnknown => {
            Failure::refused("calibrate::nothing_unknown", why.to_string()).with_help("hold less")
        }
        CalibrationError::BadShare(_) => Failure::refused("calibrate::bad_share", why.to_string())
            .with_help("give --identified above 0, for instance 0.01"),
        CalibrationError::NoClosedForm => {
            Failure::new(Exit::No, "calibrate::no_closed_form", why.to_string()).with_help(
                "start at the design (--start nominal), or measure at least 17 poses with rotations about all axes",
            )
        }
        _ => Failure::refused(BAD_MEASUREMENTS, why.to_string()),
    }
}

/// Measurements with the lines they stand on.
///
/// `poses` becomes the convention that the names of columns complete.
fn measurements(
    path: &Path,
    poses: &mut PoseFrames,
    units: &str,
    context: &Context,
) -> Result<(Vec<Measurement>, Vec<usize>), Failure> {
    let series = rows::poses_with_lengths(path, BAD_MEASUREMENTS, (poses, units), context)?;
    poses.convention = series.frames;
    note_frames(poses, context);
    let measured = |(pose, lengths): (Pose, [f64; 6])| Measurement { pose, lengths };
    Ok(series.rows.into_iter().map(|row| (measured(row.value), row.line)).unzip())
}

/// The motions to the design frames, if requested.
fn frames(
    args: &CalibrateArgs,
    design: &Design,
    found: &Calibration,
) -> Result<Option<CarriedFrames>, Failure> {
    if args.frames == FramesArg::Measured {
        return Ok(None);
    }
    let nominal = design.leg_model();
    CarriedFrames::between(&found.model, &nominal).map(Some).ok_or_else(|| {
        let message = "the joints of a body lie on a line, so every rotation about the line fits";
        Failure::new(Exit::No, "calibrate::no_frames", message).with_help("leave out --frames design")
    })
}

/// The poses to measure next, in the frames of the design and of the measurements.
fn next(
    (args, poses): (&CalibrateArgs, &PoseFrames),
    found: &Calibration,
    candidates: &[Pose],
    measured: &[Pose],
) -> Vec<NextPoseRecord> {
    let chosen = next_poses(
        &found.model,
        &found.unknowns,
        &found.noise,
        &found.bounded_root,
        measured,
        args.next.into(),
    );
    chosen.iter().map(|n| next_record(poses, &candidates[n.candidate], n)).collect()
}

fn next_record(poses: &PoseFrames, pose: &Pose, next: &NextPose) -> NextPoseRecord {
    NextPoseRecord {
        pose: pose.into(),
        rpy_deg: pose.angles().degrees().map(Number),
        in_frames: (&poses.write(pose)).into(),
        shrinks: Number(next.shrinks),
        greatest_deviation: Number(next.greatest_deviation),
    }
}

/// The first poses to measure.
fn plan(
    args: &CalibrateArgs,
    design: &Design,
    options: &CalibrateOptions,
    context: &Context,
) -> Result<Answer, Failure> {
    if let Some(MeasurementNoise { length, position, rotation }) = options.noise
        && !(length > 0.0 && position >= 0.0 && rotation >= 0.0)
    {
        return Err(failure_of(&CalibrationError::BadNoise { length, position, rotation }.into()));
    }
    if !(options.identified > 0.0 && options.identified.is_finite()) {
        return Err(failure_of(&CalibrationError::BadShare(options.identified).into()));
    }
    let poses = args.convention.of(design);
    let model = design.leg_model();
    let unknowns = Unknowns::new(&model, options.held);
    if unknowns.count() == 0 {
        return Err(failure_of(&CalibrationError::NothingUnknown.into()));
    }
    let size = design.manipulator().size();
    let noise = options.noise.unwrap_or_else(|| MeasurementNoise::assumed(size));
    let candidates = design.measurable_poses(args.candidates.into(), context.seed());
    let root = planning_root(&unknowns, options.identified * size);
    let chosen = next_poses(&model, &unknowns, &noise, &root, &candidates, args.next.into());
    let answer = CalibrateAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        frames: (&poses.convention).into(),
        outcome: CalibrateOutcome::Planned,
        reason: "nothing was measured: these are the poses to begin with".into(),
        calibration: None,
        next_poses: chosen.iter().map(|n| next_record(&poses, &candidates[n.candidate], n)).collect(),
        path: None,
    };
    let text = sheet::answers::calibrate(&answer, false);
    Ok(Answer::new(Exit::Yes, answer, text))
}
