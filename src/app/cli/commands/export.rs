//! `equipod export`: files for other programs.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;

use super::build::tolerances;
use crate::app::cli::numbers::{Length, length};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::export::{Export, ExportFormat, ExportOptions, ExportedFile, LengthUnit, NoExport, Writer};
use ask::Design;
use ask::exporting::octahedral_of_controllers;
use num::shown::significant;
use records::{AssessAnswer, ExportAnswer, FormatOutcome, FormatRecord};
use sheet::{Sheet, answers::verdict};

/// Arguments of `export`.
#[derive(Debug, clap::Args)]
pub(crate) struct ExportArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Formats, separated by commas, or `all`
    #[arg(long, value_name = "FORMAT", value_delimiter = ',', required = true, value_parser = PossibleValuesParser::new(names()))]
    to: Vec<String>,
    /// Folder for the files
    #[arg(short, long, value_name = "DIR")]
    output: OutputPath,
    /// Length unit of the design, if its label is not one: um, mm, cm, m, in, ft
    #[arg(long, value_name = "UNIT")]
    unit: Option<String>,
    /// Thickness of the plates, design units
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    thickness: Option<Length>,
    /// Distance from the joints to the outline of a plate, design units
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    margin: Option<Length>,
    /// Diameter of the holes under the joints, design units
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    hole_diameter: Option<Length>,
    /// Diameter of the balls, design units
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    ball_diameter: Option<Length>,
    /// Allowed error as in `build tolerances`, for joint tolerances in hole plans and tables
    #[arg(long, value_name = "LENGTH,DEG")]
    bound: Option<String>,
    /// Tool point, design units, platform frame
    #[arg(long, value_name = "X,Y,Z", default_value = "0,0,0", allow_hyphen_values = true)]
    tool: String,
    /// Mass of platform and payload in simulations, kilograms
    #[arg(long, value_name = "KG")]
    mass: Option<f64>,
    /// Compensate the weight of all bodies in the simulator
    #[arg(long)]
    gravity_compensation: bool,
}

/// The names accepted by `--to`.
fn names() -> Vec<&'static str> {
    ExportFormat::ALL.map(ExportFormat::name).into_iter().chain(["all"]).collect()
}

fn model(args: &ExportArgs, design: &Design, hole_places: Option<f64>) -> Result<Export, Failure> {
    let unit = args.unit.as_deref().map(LengthUnit::of).transpose();
    let unit = unit.map_err(|e| Failure::refused("export::unknown_unit", format!("--unit: {e}")))?;
    let mut options = ExportOptions::new();
    let of = |option: &Option<Length>| Length::of_option(option.as_ref(), &design.units);
    (options.unit, options.thickness, options.margin) = (unit, of(&args.thickness)?, of(&args.margin)?);
    (options.hole, options.ball, options.mass) =
        (of(&args.hole_diameter)?, of(&args.ball_diameter)?, args.mass);
    (options.hole_places, options.gravity_compensation) = (hole_places, args.gravity_compensation);
    Export::of(design, &options).map_err(|why| refusal(&why))
}

fn refusal(why: &NoExport) -> Failure {
    match why {
        NoExport::Unit(e) => {
            Failure::refused("export::unknown_unit", format!("the units of the design cannot be used: {e}"))
                .with_help("state the unit of the design, such as `--unit mm`")
        }
        other => Failure::refused("export::bad_size", other.to_string()),
    }
}

/// A design for all formats, with sizes from the design and by default rules.
///
/// # Errors
/// Exit 2: a unit that is no length, or unusable sizes.
pub(super) fn plain(design: &Design) -> Result<Export, Failure> {
    Export::of(design, &ExportOptions::default()).map_err(|why| match why {
        NoExport::Unit(_) => refusal(&why).with_help("name a unit of length, such as `units = \"mm\"`"),
        other => refusal(&other),
    })
}

/// The requested formats, each once, in the order of the list.
fn requested(args: &ExportArgs) -> Vec<ExportFormat> {
    let all = args.to.iter().any(|t| t == "all");
    let asked = |f: &ExportFormat| all || args.to.iter().any(|t| t == f.name());
    ExportFormat::ALL.into_iter().filter(asked).collect()
}

fn write(folder: &Path, file: &ExportedFile) -> Result<String, Failure> {
    Ok(files::write_into(folder, &file.name, &file.text)?.display().to_string())
}

/// The diameter of the zone for the centre of each hole, if an accuracy is requested: joints are at their holes.
fn hole_places(args: &ExportArgs, design: &Design, context: &Context) -> Result<Option<f64>, Failure> {
    let Some(bound) = &args.bound else {
        context.no_effect("tool", "it is the point that --bound is about")?;
        return Ok(None);
    };
    if !requested(args).iter().any(|f| [ExportFormat::Dxf, ExportFormat::Csv].contains(f)) {
        context.no_effect("bound", "only the formats dxf and csv state joint tolerances")?;
    }
    let radius = tolerances::joint_radius(design, (bound, &args.tool), context.seed())?;
    Ok(Some(2.0 * radius))
}

/// Writes every format that can hold the design; exit 1 if one cannot.
pub(crate) fn run(args: &ExportArgs, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load_with_cranks(&args.design)?;
    let coupled = Context::coupled_of(&design)?.is_some();
    if args.bound.is_some() || (coupled && !requested(args).iter().any(|f| f.writer().takes_coupled)) {
        // refuses cranks and joints that are not ideal at their place in the file: either no requested format holds
        // them, or their tolerances are unknown
        context.load(&args.design)?;
    }
    let asked = |formats: &[ExportFormat]| requested(args).iter().any(|format| formats.contains(format));
    let simulated = asked(&[ExportFormat::Mjcf, ExportFormat::Sdf, ExportFormat::Urdf]);
    if !simulated {
        context.no_effect("mass", "only the formats of simulators (mjcf, sdf, urdf) hold masses")?;
    }
    if !asked(&[ExportFormat::Mjcf, ExportFormat::Sdf]) {
        context.no_effect("gravity_compensation", "only the formats mjcf and sdf can switch gravity off")?;
    }
    let mut export = model(args, &design, hole_places(args, &design, context)?)?;
    let controller = asked(&[ExportFormat::C]);
    if controller && export.cranks.is_none() && !coupled {
        export = export.with_octahedral(octahedral_of_controllers(&design));
    }
    files::make_folder(&args.output)?;
    let (mut exit, mut formats, mut text) = (Exit::Yes, Vec::new(), Sheet::new());
    for format in requested(args) {
        let Writer { purpose, leaves_out, .. } = *format.writer();
        let (files, outcome) = match export.files(format) {
            Ok(made) => {
                let paths = made.iter().map(|f| write(&args.output, f));
                let paths = paths.collect::<Result<Vec<_>, _>>()?;
                for path in &paths {
                    text.line(format_args!("wrote {path}"));
                }
                if !leaves_out.is_empty() {
                    text.line(format_args!("  {format} leaves out {leaves_out}"));
                }
                (paths, FormatOutcome::Written { leaves_out: leaves_out.into() })
            }
            Err(why) => {
                exit = Exit::No;
                text.line(format_args!("{format} not written: {why}"));
                (Vec::new(), FormatOutcome::Refused { refused: why.to_string() })
            }
        };
        formats.push(FormatRecord { format: format.to_string(), purpose: purpose.into(), files, outcome });
    }
    // only legs of variable length are assessed
    let assessment = if design.has_cranks() { None } else { AssessAnswer::of(&design, context.seed()) };
    let assessment = assessment.map(|found| if simulated { found.without_assumptions() } else { found });
    let mut lead = if design.has_cranks() {
        Sheet::new()
    } else {
        verdict(&design.name, assessment.as_ref(), &format!("equipod assess {}", args.design.display()))
    };
    if design.has_cranks() {
        lead.line(format_args!(
            "{} has cranks: `equipod ik` states the margins of their limits at a pose",
            design.name
        ));
    }
    lead.space();
    lead.add(text);
    let assumptions = if simulated { simulator_assumptions(&design, &export) } else { Vec::new() };
    let record =
        ExportAnswer::new(&export, assessment, args.output.display().to_string(), formats, assumptions);
    lead.add(sheet::answers::export(&record));
    Ok(Answer::new(exit, record, lead))
}

/// Tells the masses that the simulator's model assumes if the design states none.
fn simulator_assumptions(design: &Design, export: &Export) -> Vec<String> {
    let mut out = if design.moving_payload().is_some() {
        design.mass_assumptions()
    } else {
        vec!["The design has no [payload]: the platform is a ball in the middle of its joints.".to_owned()]
    };
    if let Some(mass) = export.added_rod_mass() {
        out.push(format!(
            "The simulator's rods weigh {} kg each that the design does not have: its inertia leaves them nothing of the platform, and rods without mass cannot be moved.",
            significant(mass)
        ));
    }
    out
}
