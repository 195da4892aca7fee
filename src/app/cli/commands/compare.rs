//! `equipod compare`: a table of several designs.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::Instant;

use super::build::drives;
use super::build::tolerances::numbers;
use super::motion::manoeuvres;
use crate::app::cli::table::{csv_line, number};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use crate::app::report::{Comparison, comparison_page};
use ::files::export::LengthUnit;
use ::files::plot::thumbnail;
use ask::Design;
use ask::{FigureOptions, PlatformMotion};
use machine::dynamics::Manoeuvre;
use machine::manufacture::ErrorBound;
use platform::geom::Pose;
use platform::manipulator::Manipulator;
use records::{AccuracyRecord, CompareAnswer, FigureCell, FigureColumn, FiguresRecord};

/// Arguments of `compare`.
#[derive(Debug, clap::Args)]
pub(crate) struct CompareArgs {
    /// Design files (.toml or .json), all in the same units
    #[arg(value_name = "DESIGN", required = true, num_args = 1..)]
    designs: Vec<PathBuf>,
    /// Sine about home for forces, speeds and powers; repeat for several
    #[arg(long, value_name = "AXIS:AMPLITUDE:HERTZ", allow_hyphen_values = true)]
    sine: Vec<String>,
    /// Acceleration from rest at home, design units or degrees per second squared; repeat for several
    #[arg(long, value_name = "AXIS:ACCELERATION", allow_hyphen_values = true)]
    accelerate: Vec<String>,
    /// Accuracy for joint tolerances: platform origin, design units, and orientation, degrees
    #[arg(long, value_name = "LENGTH,DEG")]
    accuracy: Option<String>,
    /// Number of Halton points in the region of poses, and of random ones
    #[arg(long, value_name = "N", default_value_t = 500, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    points: u32,
    /// Write the table as CSV, one design on each line
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
    /// Write the table with pictures as one sortable HTML page
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// Number of instants in a period of a sine.
const SAMPLES: usize = 120;

/// The question put to all designs.
pub(super) struct CompareQuestion {
    motions: Vec<(String, Manoeuvre)>,
    accuracy: Option<ErrorBound>,
    points: usize,
    seed: u64,
    /// The time at which assessments end with the result so far.
    until: Option<Instant>,
}

impl CompareQuestion {
    /// Only the figures, for the report.
    pub(super) fn plain(points: usize, until: Option<Instant>) -> Self {
        Self { motions: Vec::new(), accuracy: None, points, seed: 1, until }
    }
}

/// Every design has its figures: exit 0.
pub(crate) fn run(args: &CompareArgs, context: &mut Context) -> Result<Answer, Failure> {
    let mut designs = Vec::new();
    for path in &args.designs {
        designs.push((files::shown(path), context.load_ideal(path)?));
    }
    let asked = asked(args, context)?;
    let mut comparison = compare(&designs, &asked)?;
    for ((path, (_, design)), found) in args.designs.iter().zip(&designs).zip(&mut comparison.answer.designs)
    {
        found.lightest_drive = drives::lightest(path, design, context)?;
    }
    if let Some(path) = &args.csv {
        files::write_text(path, &csv(&comparison.answer))?;
        comparison.answer.paths.push(path.display().to_string());
    }
    if let Some(path) = &args.output {
        files::write_text(path, &comparison_page(&comparison))?;
        comparison.answer.paths.push(path.display().to_string());
    }
    let text = sheet::answers::compare(&comparison.answer);
    Ok(Answer::new(Exit::Yes, comparison.answer, text))
}

fn asked(args: &CompareArgs, context: &Context) -> Result<CompareQuestion, Failure> {
    let accuracy = args.accuracy.as_deref().map(|text| -> Result<ErrorBound, Failure> {
        let [position, rotation_deg] = numbers(text, "--accuracy", "compare::bad_accuracy")?;
        if !(position > 0.0 && rotation_deg > 0.0) {
            let message = format!("--accuracy: `{text}` is not two positive numbers");
            return Err(Failure::refused("compare::bad_accuracy", message)
                .with_help("give a length in design units and an angle in degrees, for instance 0.1,0.05"));
        }
        Ok(ErrorBound { position, rotation_deg })
    });
    Ok(CompareQuestion {
        motions: manoeuvres(&args.sine, &args.accelerate, "compare::bad_manoeuvre")?,
        accuracy: accuracy.transpose()?,
        points: args.points as usize,
        seed: context.seed(),
        until: None,
    })
}

/// The figures and pictures of all designs.
///
/// # Errors
/// `compare::units_differ`.
pub(super) fn compare(designs: &[(String, Design)], asked: &CompareQuestion) -> Result<Comparison, Failure> {
    let all =
        |unit: &dyn Fn(&Design) -> String| designs.iter().map(|(_, d)| unit(d)).collect::<BTreeSet<_>>();
    let (lengths, forces) =
        (all(&|d| d.units.trim().to_string()), all(&|d| d.force_unit().label().to_string()));
    for (what, units) in [("length", &lengths), ("force", &forces)] {
        if units.len() > 1 {
            let list = units.iter().cloned().collect::<Vec<_>>().join(", ");
            let message = format!("the designs have different units of {what}: {list}");
            return Err(Failure::refused("compare::units_differ", message)
                .with_help("`equipod design convert DESIGN --units mm -o FILE` writes a design in another unit of length"));
        }
    }
    let mut out = Comparison {
        answer: CompareAnswer {
            length_unit: lengths.into_iter().next().unwrap_or_default(),
            force_unit: forces.into_iter().next().unwrap_or_default(),
            manoeuvres: asked.motions.iter().map(|(name, _)| name.clone()).collect(),
            accuracy: asked
                .accuracy
                .map(|b| AccuracyRecord { position: b.position, rotation_deg: b.rotation_deg }),
            characteristic_length: designs.first().map_or(f64::NAN, |(_, d)| d.characteristic_length()),
            designs: Vec::new(),
            paths: Vec::new(),
        },
        thumbnails: Vec::new(),
    };
    for (path, design) in designs {
        let home = design.home_or_default();
        let motions: Vec<PlatformMotion> =
            asked.motions.iter().map(|(_, m)| PlatformMotion::Manoeuvre(*m, home, SAMPLES)).collect();
        // no forces in motion if the unit is no length
        let masses =
            LengthUnit::of(&design.units).ok().and_then(|unit| design.motion_masses(unit.metres, None));
        let length = out.answer.characteristic_length;
        let options = FigureOptions::new(length)
            .points(asked.points)
            .seed(asked.seed)
            .motions(&motions)
            .masses(masses.as_ref())
            .accuracy(asked.accuracy)
            .until(asked.until);
        let found = design.figures(&options);
        out.answer.designs.push(FiguresRecord::new(design, path.clone(), &found, length));
        out.thumbnails.push(thumbnail(&drawn(design, &home), &home, &design.name));
    }
    Ok(out)
}

/// The legs to draw at a pose; for cranks, rods from their tips as far as they reach.
fn drawn(design: &Design, pose: &Pose) -> Manipulator {
    let tips = design.rotary().ok().flatten().and_then(|platform| {
        let angles = platform.ik(pose).ok()?;
        platform.at(&angles).ok()
    });
    tips.unwrap_or_else(|| design.manipulator().clone())
}

/// The table as CSV, one line for each design.
fn csv(answer: &CompareAnswer) -> String {
    let columns = answer.columns();
    let mut header = vec!["name".to_string(), "path".to_string()];
    header.extend(columns.iter().map(FigureColumn::heading));
    let mut out = csv_line(&header);
    for (row, design) in answer.designs.iter().enumerate() {
        let mut cells = vec![design.name.clone(), design.path.clone()];
        cells.extend(columns.iter().map(|c| match &c.cells[row] {
            None => String::new(),
            Some(FigureCell::Word(word)) => word.clone(),
            Some(FigureCell::Number(x, _)) => number(*x),
        }));
        out.push_str(&csv_line(&cells));
    }
    out
}
