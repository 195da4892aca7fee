//! `equipod new`: a design from a few sizes with legs or servos, from corners, from a table of points, from a sheet of
//! parameters or from a model.

mod prompts;

use std::io::{stderr, stdin};
use std::path::PathBuf;

use crate::app::cli::numbers::{self, number};
use crate::app::cli::streams;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::design::{
    Format, HexapodSizes, InvalidPointTable, InvalidServoSizes, PointTable, RigSheet, ServoHome, ServoSizes,
    SheetDialect, octahedral_toml, with_lengths,
};
use ask::Design;
use ask::design::parse_with_cranks;
use platform::geom::{Angles, Pose};
use records::{NewAnswer, PresetFile};
use synthesis::singularity::Architecture;

use self::prompts::{PromptedHexapod, PromptedSizes};

/// Arguments of `new`.
#[derive(Debug, clap::Args)]
pub(crate) struct NewArgs {
    /// Radius of the circle of the base joints, design units
    #[arg(long, value_name = "LENGTH", value_parser = number, allow_negative_numbers = true)]
    base_radius: Option<f64>,
    /// Radius of the circle of the platform joints, design units
    #[arg(long, value_name = "LENGTH", value_parser = number, allow_negative_numbers = true)]
    platform_radius: Option<f64>,
    /// Angle between the two base joints of a pair, seen from the centre, degrees; 0: one joint
    #[arg(long, value_name = "DEG", value_parser = number, allow_negative_numbers = true)]
    base_spread: Option<f64>,
    /// The same for the platform
    #[arg(long, value_name = "DEG", value_parser = number, allow_negative_numbers = true)]
    platform_spread: Option<f64>,
    /// Height of the platform frame above the base frame at home, design units
    #[arg(long, value_name = "LENGTH", value_parser = number, allow_negative_numbers = true)]
    height: Option<f64>,
    /// Servos with cranks and rods in place of legs of variable length; the base joints are the crank centres
    #[arg(long, conflicts_with_all = ["corners", "points", "sheet"])]
    servo: bool,
    /// Length of the servo cranks, from axis to rod, design units
    #[arg(long, value_name = "LENGTH", requires = "servo", value_parser = number, allow_negative_numbers = true)]
    crank: Option<f64>,
    /// Length of the servo rods, design units. Without it the cranks are level at home; without --height too
    #[arg(long, value_name = "LENGTH", requires = "servo", value_parser = number, allow_negative_numbers = true)]
    rod: Option<f64>,
    /// Least and greatest angle of the servo cranks, degrees: 0 is level, outward from the pair, and positive is up
    #[arg(long, value_name = "MIN,MAX", requires = "servo", allow_hyphen_values = true)]
    crank_angles: Option<String>,
    /// Three corners of the base and three of the platform of an octahedral design, each as x,y/x,y/x,y or with z
    #[arg(
        long,
        num_args = 2,
        value_names = ["BASE", "PLATFORM"],
        allow_hyphen_values = true,
        conflicts_with_all = ["base_radius", "platform_radius", "base_spread", "platform_spread", "points"]
    )]
    corners: Option<Vec<String>>,
    /// Table of the leg ends (`-` for standard input): six rows of two points or twelve rows of one. Also pins of
    /// `genhexkins`, a spreadsheet, or a model of `MuJoCo`, Gazebo (SDF) or ROS (URDF)
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["base_radius", "platform_radius", "base_spread", "platform_spread"]
    )]
    points: Option<PathBuf>,
    /// Write symmetries of the joints up to rounding as constructions, as `design convert --snap`
    #[arg(long, requires = "points")]
    snap: bool,
    /// Parameters of a motion-simulator program (`-` for standard input): lines `L1 = 900` to `L4`, then `middle` and
    /// `range` of legs, or `crank`, `rod`, `middle_angle` and `crank_angle_1` to `crank_angle_6`
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["base_radius", "platform_radius", "base_spread", "platform_spread", "height", "corners", "points"]
    )]
    sheet: Option<PathBuf>,
    /// Program of --sheet: the long side of the base is L4 in `motion4sim` (and `FlyPT Mover`), L3 in `dr-sim-manager`
    #[arg(long, value_name = "DIALECT", requires = "sheet")]
    dialect: Option<SheetDialect>,
    /// Label of the length unit; default: from the table, else mm
    #[arg(long, value_name = "UNIT")]
    units: Option<String>,
    /// Name of the design
    #[arg(long, value_name = "NAME", default_value = "hexapod")]
    name: String,
    /// File to write, .toml or .json; default: standard output
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// A design with the file that shows how it is meant.
struct Made {
    design: Design,
    toml: String,
    guesses: Vec<String>,
}

const UNIT: &str = "mm";

/// Makes the design, shows its home and the lengths there, and writes it.
pub(crate) fn run(args: &NewArgs, context: &Context) -> Result<Answer, Failure> {
    let units = args.units.as_deref();
    let (made, asked_output) = match (&args.points, &args.corners) {
        _ if args.sheet.is_some() => (from_sheet(args)?, None),
        (Some(path), _) => (from_table(args, path, context)?, None),
        (None, Some(corners)) => (from_corners(args, corners)?, None),
        (None, None) if nothing_given(args) => {
            let PromptedHexapod { sizes, units, output } = asked()?;
            let made = match sizes {
                PromptedSizes::Legs(sizes) => from_sizes(&sizes, &args.name, &units, context)?,
                PromptedSizes::Servos(sizes) => from_servos(&sizes, &args.name, &units, context)?,
            };
            (made, Some(output))
        }
        (None, None) if args.servo => {
            (from_servos(&servo_sizes(args)?, &args.name, units.unwrap_or(UNIT), context)?, None)
        }
        (None, None) => (from_sizes(&sizes(args)?, &args.name, units.unwrap_or(UNIT), context)?, None),
    };
    let output = args.output.clone().or(asked_output);
    finish(made, output.as_ref(), context)
}

fn nothing_given(args: &NewArgs) -> bool {
    let sizes = [args.base_radius, args.platform_radius, args.base_spread, args.platform_spread, args.height];
    sizes.iter().all(Option::is_none) && !args.servo
}

/// The ways to describe a design, for a command without enough arguments.
const WAYS: &str = "give --base-radius, --platform-radius, --base-spread, --platform-spread and --height, for servos also --servo and --crank; or --corners BASE PLATFORM and --height; or --points FILE; or --sheet FILE and --dialect";

/// Questions on a terminal.
fn asked() -> Result<PromptedHexapod, Failure> {
    if !streams::input_is_terminal() {
        let message = "no sizes are given, and there is no terminal for questions";
        return Err(Failure::refused("new::nothing_given", message).with_help(WAYS));
    }
    prompts::ask(&mut stdin().lock(), &mut stderr().lock()).ok_or_else(|| {
        Failure::refused("new::nothing_given", "no answer was given to the questions").with_help(WAYS)
    })
}

fn missing(option: &str) -> Failure {
    Failure::refused("new::missing", format!("{option} is missing")).with_help(WAYS)
}

/// Radii and spreads.
fn circles(args: &NewArgs) -> Result<[[f64; 2]; 2], Failure> {
    Ok([
        [
            args.base_radius.ok_or_else(|| missing("--base-radius"))?,
            args.platform_radius.ok_or_else(|| missing("--platform-radius"))?,
        ],
        [
            args.base_spread.ok_or_else(|| missing("--base-spread"))?,
            args.platform_spread.ok_or_else(|| missing("--platform-spread"))?,
        ],
    ])
}

fn sizes(args: &NewArgs) -> Result<HexapodSizes, Failure> {
    let [radius, spread_deg] = circles(args)?;
    Ok(HexapodSizes { radius, spread_deg, height: args.height.ok_or_else(|| missing("--height"))? })
}

fn servo_sizes(args: &NewArgs) -> Result<ServoSizes, Failure> {
    let [radius, spread_deg] = circles(args)?;
    let angles = args.crank_angles.as_deref().map(|text| {
        let fault = || Failure::refused("new::bad_sizes", numbers::fault("--crank-angles", text, 2));
        numbers::parse(text)
            .ok_or_else(|| fault().with_help("write the least and the greatest angle: -60,60"))
    });
    Ok(ServoSizes {
        radius,
        spread_deg,
        crank: args.crank.ok_or_else(|| missing("--crank"))?,
        angle_deg: angles.transpose()?,
        home: match (args.height, args.rod) {
            (Some(height), None) => ServoHome::LevelAt { height },
            (None, Some(rod)) => ServoHome::LevelWith { rod },
            (Some(height), Some(rod)) => ServoHome::Stated { height, rod },
            (None, None) => {
                let message = "--height and --rod are missing: one of them is enough, and the cranks are then level at home";
                return Err(Failure::refused("new::missing", message).with_help(WAYS));
            }
        },
    })
}

fn bad(why: impl Into<String>) -> Failure {
    Failure::refused("new::bad_sizes", why)
        .with_help("give positive radii and a positive height, and spreads from 0 to less than 120 degrees whose sum is not 120")
}

fn from_sizes(sizes: &HexapodSizes, name: &str, units: &str, context: &Context) -> Result<Made, Failure> {
    sizes.check().map_err(|why| bad(why.to_string()))?;
    let mut made = read_back(sizes.to_toml(name, units))?;
    made.guesses = made.design.told_of_sizes(sizes);
    made.guesses.iter().for_each(|sentence| context.note(sentence));
    Ok(made)
}

fn from_servos(sizes: &ServoSizes, name: &str, units: &str, context: &Context) -> Result<Made, Failure> {
    let hexapod = sizes.solved().map_err(|why| match why {
        InvalidServoSizes::Size(why) => Failure::refused("new::bad_sizes", why.to_string()).with_help(
            "give positive lengths, a base spread above 0 and below 120 degrees, and --crank-angles from less to more",
        ),
        InvalidServoSizes::Home(why) => Failure::refused("new::out_of_reach", why)
            .with_help("without --rod, or without --height, the cranks are level at home"),
    })?;
    let mut made = read_back(hexapod.to_toml(name, units))?;
    made.guesses = made.design.told_of_servos(&hexapod);
    made.guesses.iter().for_each(|sentence| context.note(sentence));
    Ok(made)
}

/// The design read from a text that this command made.
fn read_back(toml: String) -> Result<Made, Failure> {
    match parse_with_cranks(&toml, Format::Toml) {
        Ok((design, _)) => Ok(Made { design, toml, guesses: Vec::new() }),
        Err(violations) => Err(Failure::bad_design("the new design".into(), toml, violations)),
    }
}

/// The parameters of a program.
fn from_sheet(args: &NewArgs) -> Result<Made, Failure> {
    let path = args.sheet.as_deref().unwrap_or(std::path::Path::new("-"));
    let Some(dialect) = args.dialect else {
        let message =
            "--sheet needs --dialect: programs disagree on which of L3 and L4 is the long side of the base";
        let help = "--dialect motion4sim where L4 is the long side (Motion4Sim, FlyPT Mover), --dialect dr-sim-manager where L3 is";
        return Err(Failure::refused("new::no_dialect", message).with_help(help));
    };
    let shown = files::shown(path);
    let toml = RigSheet::read(&files::read_table(path)?, dialect)
        .and_then(|sheet| sheet.to_toml(&args.name, args.units.as_deref().unwrap_or(UNIT)))
        .map_err(|why| Failure::refused("new::bad_sheet", format!("{shown}: {why}")).with_help(why.help()))?;
    read_back(toml)
}

fn from_corners(args: &NewArgs, texts: &[String]) -> Result<Made, Failure> {
    let height =
        args.height.ok_or_else(|| Failure::refused("new::missing", "--height is missing").with_help(WAYS))?;
    let [base, platform] = texts else {
        return Err(bad("--corners takes the corners of the base and those of the platform"));
    };
    let corners = [corners(base)?, corners(platform)?];
    read_back(octahedral_toml(&corners, &args.name, args.units.as_deref().unwrap_or(UNIT), height))
}

/// `x,y/x,y/x,y`, each with or without z.
fn corners(text: &str) -> Result<[[f64; 3]; 3], Failure> {
    let corner = |part: &str| {
        let numbers: Option<Vec<f64>> = part.split(',').map(|f| f.trim().parse().ok()).collect();
        match numbers?[..] {
            [x, y] => Some([x, y, 0.0]),
            [x, y, z] => Some([x, y, z]),
            _ => None,
        }
    };
    let all: Option<Vec<[f64; 3]>> = text.split('/').map(corner).collect();
    all.and_then(|list| list.try_into().ok()).ok_or_else(|| {
        Failure::refused("new::bad_corners", format!("--corners: `{text}` is not three corners"))
            .with_help("write three corners of two or three numbers: 0,0/12,0/6,10.4")
    })
}

/// A table or a model that gives no design.
fn bad_points(shown: &str, why: &InvalidPointTable) -> Failure {
    let (code, help) = match why {
        InvalidPointTable::Mechanism(_) => (
            "new::bad_mjcf",
            "legs are six slide joints (prismatic), each between joints of the base and of the platform; in MuJoCo also spatial tendons from a site of the base to one of the platform",
        ),
        InvalidPointTable::Model(_) => (
            "new::bad_model",
            "write the twelve joint centres as a table: a row for each leg, x, y, z of its base end and of its platform end, each in the frame of its body or both at home",
        ),
        InvalidPointTable::Computed => (
            "new::bad_table",
            "print the joints in your program and read its output, or write the numbers out",
        ),
        InvalidPointTable::Step => (
            "new::bad_step",
            "measure the twelve joint centres in the CAD program and write them as a table: a row for each leg, x, y, z of its base end and of its platform end",
        ),
        _ => (
            "new::bad_table",
            "a table has six rows with x, y, z of the base end and of the platform end of a leg, or twelve rows with a point each",
        ),
    };
    Failure::refused(code, format!("{shown}: {why}")).with_help(help)
}

fn from_table(args: &NewArgs, path: &std::path::Path, context: &Context) -> Result<Made, Failure> {
    let shown = files::shown(path);
    let mut table = PointTable::read(&files::read_table(path)?).map_err(|why| bad_points(&shown, &why))?;
    if let (Some(asked), Some(said)) = (&args.units, &table.units)
        && asked != said
    {
        table.guesses.push(format!(
            "The numbers are in {asked}, as --units says, and not in {said}: nothing is converted."
        ));
    }
    let units = args.units.clone().or(table.units.clone()).unwrap_or_else(|| {
        table.guesses.push(format!("The lengths are in {UNIT}: give --units where they are not."));
        UNIT.into()
    });
    let mut design = table.design(&args.name, &units).map_err(|why| bad_points(&shown, &why.into()))?;
    if let Some(snapped) = design.snapped() {
        let sentences = snapped.sentences(&units);
        if args.snap {
            design = snapped.design;
        } else {
            table.guesses.push("--snap writes these as constructions, so that joints are exact:".into());
        }
        table.guesses.extend(sentences);
    } else if args.snap {
        table.guesses.push("No symmetry was found that the joints do not have exactly.".into());
    }
    if let Some(height) = args.height {
        design.home = Some(Pose::new([0.0, 0.0, height], Angles::default()));
    } else if design.home.is_none() {
        design.home = Some(design.home_or_default());
        table.guesses.push(
            "Home is chosen above the centre of the base, at a height of its radius: give --height for another.".into(),
        );
    }
    context.note_guesses(&shown, &table.guesses);
    Ok(Made { toml: design.to_toml(), design: design.into(), guesses: table.guesses })
}

/// Adds the lengths at home, and writes the file.
fn finish(made: Made, output: Option<&OutputPath>, context: &Context) -> Result<Answer, Failure> {
    let Made { mut design, toml, guesses } = made;
    let home = design.home_or_default();
    let mut lengths =
        home.lengths(design.manipulator()).ok_or_else(|| bad("the lengths at home overflow"))?.get();
    let mut toml = toml;
    let (mut singular, mut crank_angles) = (false, None);
    if let Some(platform) = Context::cranks_of(&design)? {
        // rods have the same length everywhere, and their lines begin at the crank tips
        lengths = platform.legs().map(|leg| leg.rod);
        let angles = platform.ik(&home);
        let angles = angles.map_err(|why| Failure::refused("new::out_of_reach", why.to_string()))?;
        crank_angles = Some(angles.map(f64::to_degrees));
    } else {
        design.lengths = home.lengths(design.manipulator());
        toml = with_lengths(&toml, lengths);
        singular = Architecture::of(design.manipulator()).is_singular() == Some(true);
    }
    let singular_home = design.singular_at(&home);
    if let Some(found) = &singular_home {
        context.note(&format!("{found}. Choose another height, turn or size."));
    }
    let (file, text) = match output {
        None => (PresetFile::Given { text: toml.clone() }, Some(toml)),
        Some(path) => {
            match Format::of_path(path) {
                Format::Toml => files::write_text(path, &toml)?,
                Format::Json => files::write_design(path, &design)?,
            }
            (PresetFile::Written { output: path.display().to_string() }, None)
        }
    };
    let answer = NewAnswer {
        name: design.name.clone(),
        units: design.units.clone(),
        file,
        home: (&home).into(),
        lengths,
        crank_angles_deg: crank_angles,
        architecturally_singular: singular,
        singular_home: singular_home.map(|home| home.evidence),
        guesses,
    };
    let exit = if singular_home.is_none() { Exit::Yes } else { Exit::No };
    Ok(if let Some(text) = text {
        Answer::new(exit, answer, text)
    } else {
        let sheet = sheet::answers::new_design(&answer);
        Answer::new(exit, answer, sheet)
    })
}
