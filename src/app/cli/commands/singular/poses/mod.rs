//! `equipod singular poses`: det J at poses, over a slice, and the box of poses in which it is proved not to vanish.

mod paths;
mod render;
pub(in crate::app::cli::commands) mod slice;

use std::path::PathBuf;

use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::freedoms::Freedoms;
use crate::app::cli::output::Answer;
use crate::app::cli::poses;
use ::files::plot::singular_slice;
use ask::BOX_CELLS;
use ask::Design;
use fk::{Automatic, FkOptions, ForwardKinematics};
use platform::geom::{Pose, PoseSpace, Region};
use platform::manipulator::{LegLengths, Octahedral, inverse_condition, jacobian, leg_determinant};
use synthesis::singularity::{
    BoxOptions, RegularBox, Regularity, four_planes, regular_box, regular_workspace,
};

/// Arguments of `singular poses`.
#[derive(Debug, clap::Args)]
pub(crate) struct Args {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Pose in the middle: `home`, `x,y,z,roll_deg,pitch_deg,yaw_deg` or `x,y,z,qw,qx,qy,qz`
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
    /// Six lengths at which all assembly modes are judged; those of the pose when absent
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
    /// Shape of the box: half widths of translations (design units) and components of the rotation vector (degrees); without it
    /// the workspace of the design, box or ellipsoid, else half its size and 30 degrees
    #[arg(long = "box", value_name = "X,Y,Z,RX,RY,RZ")]
    shape: Option<String>,
    /// Greatest number of cells of the region of poses over which det J is bounded to prove the box
    #[arg(long, value_name = "N", default_value_t = BOX_CELLS)]
    cells: usize,
    /// Write a picture of the singular poses over two of the six freedoms
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    /// Two freedoms of that picture: x, y, z (positions), rx, ry, rz (rotation vector in the base frame)
    #[arg(long, value_name = "A,B", default_value = "rx,rz", value_parser = Freedoms::parse, requires = "svg")]
    slice: Freedoms,
    /// Compute det J along the straight path between two assembly modes, by their numbers in the list; 0 is the pose of --pose
    #[arg(long, value_name = "I,J")]
    path: Option<String>,
    /// A pose that the path passes through; repeat the option for several, in order
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, requires = "path")]
    via: Vec<String>,
    /// Write det J along that path as a table
    #[arg(long, value_name = "FILE", requires = "path")]
    csv: Option<OutputPath>,
    /// Write a picture of det J along that path
    #[arg(long, value_name = "FILE", requires = "path")]
    path_svg: Option<OutputPath>,
    /// Compute det J along the straight paths between all assembly modes, and find which modes other paths join without a singular pose
    #[arg(long)]
    between: bool,
    /// Number of random poses drawn in the search for such paths, for each sign of det J
    #[arg(long, value_name = "N", default_value_t = 1000, requires = "between")]
    samples: usize,
}

/// Figures of one pose.
struct Judged {
    pose: Pose,
    /// `det J` of the leg lines, lengths over the size.
    determinant: f64,
    /// Of the Jacobian with unit lines and the characteristic length of the design.
    inverse_condition: f64,
    four_planes: Option<[f64; 2]>,
}

/// What was found, for [`render`].
struct Found {
    middle: Judged,
    modes: Vec<Judged>,
    modes_complete: bool,
    options: BoxOptions,
    regular: RegularBox,
    /// Whether the workspace, or the region asked about, is free of singular poses, and the cells that took.
    safe: Option<(Regularity, usize)>,
    /// Whether that is the workspace of the design.
    of_the_design: bool,
    path: Option<paths::Path>,
    between: Option<paths::Between>,
    exit: Exit,
}

/// Judges the poses, proves the box, draws the slice.
pub(crate) fn run(args: &Args, context: &mut Context) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let m = design.manipulator();
    let pose = poses::parse(&args.pose, &design, "--pose", "poses::bad_pose")?;
    let lengths = match &args.lengths {
        Some(text) => Some(six(text, "--lengths").and_then(|l| {
            LegLengths::try_new(l).map_err(|e| Failure::refused("poses::bad_lengths", e.to_string()))
        })?),
        None => pose.lengths(m),
    };
    let lengths = lengths.ok_or_else(|| {
        Failure::refused("poses::bad_pose", "the leg lengths at this pose are not finite positive numbers")
    })?;
    let octahedral = Octahedral::recognise(m).ok();
    let options = FkOptions::new().seed(context.seed());
    let solutions = Automatic
        .solve(m, &lengths.squared(), &options)
        .map_err(|e| Failure::internal(format!("assembly modes: {e}")))?;
    let modes: Vec<Judged> = solutions
        .assembly_modes()
        .map(|r| judged(&design, octahedral.as_ref(), r.pose.real_part()))
        .collect();
    let options = box_options(args.shape.as_deref(), args.cells, &design, context.seed())?;
    let regular = regular_box(m, &pose, &options);
    let safe = asked_space(args, &design, &pose, &options)
        .map(|space| regular_workspace(m, &space, args.cells, context.seed()));
    let found = match &safe {
        Some((regularity, _)) => regularity.is_regular(),
        // a box of no particular size: the answer is how large the regular one is
        None => (regular.proved > 0.0).then_some(true),
    };
    let exit = match found {
        Some(true) => Exit::Yes,
        Some(false) => Exit::No,
        None => Exit::Inconclusive,
    };
    if let Some(path) = &args.svg {
        files::write_text(path, &singular_slice(&slice::figure(&design, args.slice, &pose, &options)))?;
    }
    let middle = judged(&design, octahedral.as_ref(), pose);
    let path = paths::path(args, &design, &pose, &modes)?;
    let between = paths::all_pairs(args, &design, &modes, context.seed());
    let modes_complete = solutions.all_accounted();
    let of_the_design = args.shape.is_none();
    let found =
        Found { middle, modes, modes_complete, options, regular, safe, of_the_design, path, between, exit };
    Ok(render::answer(&design, &lengths, &found))
}

/// The region of `--box`, else the workspace of the design, about the pose.
fn asked_space(args: &Args, design: &Design, pose: &Pose, options: &BoxOptions) -> Option<PoseSpace> {
    if args.shape.is_some() {
        return Some(PoseSpace {
            region: options.region,
            translation: options.translation.into(),
            rotation_deg: options.rotation_deg.into(),
            ..PoseSpace::at(*pose)
        });
    }
    (!design.workspace.is_empty()).then(|| design.workspace.space(pose))
}

fn judged(design: &Design, octahedral: Option<&Octahedral>, pose: Pose) -> Judged {
    let m = design.manipulator();
    let unit = m.size();
    Judged {
        pose,
        determinant: leg_determinant(m, &pose),
        inverse_condition: inverse_condition(&jacobian(m, &pose, design.characteristic_length())),
        four_planes: octahedral.map(|o| four_planes(o, &pose).map(|d| d / unit.powi(9))),
    }
}

fn six(text: &str, option: &str) -> Result<[f64; 6], Failure> {
    crate::app::cli::numbers::parse(text).ok_or_else(|| {
        Failure::refused("poses::bad_numbers", format!("{option}: `{text}` is not six finite numbers"))
    })
}

pub(in crate::app::cli::commands) fn box_options(
    shape: Option<&str>,
    regions: usize,
    design: &Design,
    seed: u64,
) -> Result<BoxOptions, Failure> {
    let of_the_design = design.box_options(regions, seed);
    let Some(text) = shape else { return Ok(of_the_design) };
    let v = six(text, "--box")?;
    if v.iter().any(|x| *x < 0.0) || v.iter().all(|x| *x == 0.0) {
        let message = "--box: half widths are not negative, and not all zero";
        return Err(Failure::refused("poses::bad_numbers", message));
    }
    let (translation, rotation_deg) = ([v[0], v[1], v[2]], [v[3], v[4], v[5]]);
    Ok(BoxOptions { region: Region::Box, translation, rotation_deg, ..of_the_design })
}
