//! `equipod plot`: one picture, as SVG.

mod determinant;
mod front;
mod locus;
mod modes;
mod pair;
mod swept;
mod workspace;

use std::path::{Path, PathBuf};

use super::equivalents::{components, topologies};
use super::singular::{motion, poses as singular_poses};
use crate::app::cli::freedoms::Freedoms;
use crate::app::cli::poses;
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::plot::singular_slice;
use platform::geom::PoseConvention;
use records::{FigureWord, PictureRecord, PlotAnswer};

/// Arguments of `plot`.
#[derive(Debug, clap::Args)]
pub(crate) struct PlotArgs {
    #[command(subcommand)]
    figure: Figure,
    /// Write the picture to this file; default: standard output
    #[arg(short, long, value_name = "FILE", global = true)]
    output: Option<OutputPath>,
}

/// The kinds of pictures.
#[derive(Debug, clap::Subcommand)]
enum Figure {
    /// Draw all assembly modes at given leg lengths, mirror images side by side
    Modes(modes::PlotModesArgs),
    /// Draw the curves of replaceable joints in two planes (conics, cubics, lines)
    Components {
        /// Design file (.toml or .json)
        design: PathBuf,
        /// Draw only this pair of planes of `equivalents components`, from 1
        #[arg(long, value_name = "K")]
        pair: Option<usize>,
        /// Threshold for zero, relative to the size of the body
        #[arg(long, value_name = "X", default_value_t = 1e-9)]
        tolerance: f64,
    },
    /// Draw the sign of det A over two of the six offsets
    Det(determinant::PlotDeterminantArgs),
    /// Draw the squared length of a virtual leg at all poses while one leg length varies
    Locus(locus::PlotLocusArgs),
    /// Draw two designs at the same pose side by side, with their leg map
    Pair(pair::PlotPairArgs),
    /// Draw a Pareto front of `optimize` with `mode = "pareto"`
    Pareto(front::PlotFrontArgs),
    /// Draw the longest self-motion, animated
    SelfMotion(motion::CurveQuestion),
    /// Draw the singular poses, det J = 0, over two freedoms of the platform
    SingularPoses {
        /// Design file (.toml or .json)
        design: PathBuf,
        /// Pose in the centre of the picture
        #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
        pose: String,
        /// Two freedoms on the axes: x, y, z, or rx, ry, rz (rotation vector, base frame)
        #[arg(long, value_name = "A,B", default_value = "rx,rz", value_parser = Freedoms::parse)]
        slice: Freedoms,
    },
    /// Draw columns of a sweep's table: colours or lines over two, a distribution, parallel axes, points, a front
    Sweep(swept::PlotSweptArgs),
    /// Draw the topology of a design, or all topologies
    Topologies {
        /// Design file (.toml or .json): name only its topology
        design: Option<PathBuf>,
        /// Number of random members of each topology to solve
        #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..=1000))]
        members: u64,
    },
    /// Draw the poses within all limits over two freedoms, and the limits that end them
    Workspace(workspace::PlotWorkspaceArgs),
}

/// The result of drawing: the picture alone, or the picture with its values.
enum Picture {
    Picture(FigureWord, String),
    Answer(Answer),
}

impl Figure {
    fn draw(&self, output: Option<&Path>, context: &mut Context) -> Result<Picture, Failure> {
        let seed = context.seed();
        let (word, svg) = match self {
            Self::Locus(args) => return locus::run(args, output, context).map(Picture::Answer),
            Self::Modes(args) => (FigureWord::Modes, modes::draw(args, context)?),
            Self::Components { design, pair, tolerance } => {
                let svg = components::drawing(&context.load(design)?, *pair, *tolerance, seed)?;
                (FigureWord::Components, svg)
            }
            Self::Det(args) => (FigureWord::Det, determinant::draw(args, context)?),
            Self::Pair(args) => (FigureWord::Pair, pair::draw(args, context)?),
            Self::Pareto(args) => (FigureWord::Pareto, front::draw(args)?),
            Self::SelfMotion(question) => (FigureWord::SelfMotion, motion::drawing(question, context)?),
            Self::SingularPoses { design, pose, slice } => {
                let design = context.load(design)?;
                let frames = design.pose_frames(PoseConvention::default());
                let pose = poses::parse(pose, &frames, ("--pose", "plot::bad_pose"), context)?;
                // the picture needs only the shape of the box
                let options = design.box_options(0, seed);
                let figure = singular_poses::slice::figure(&design, *slice, &pose, &options);
                (FigureWord::SingularPoses, singular_slice(&figure))
            }
            Self::Sweep(args) => (FigureWord::Sweep, swept::draw(args)?),
            Self::Topologies { design, members } => {
                let design = design.as_deref().map(|path| context.load(path)).transpose()?;
                (FigureWord::Topologies, topologies::drawing(design.as_ref(), *members, seed)?)
            }
            Self::Workspace(args) => (FigureWord::Workspace, workspace::draw(args, context)?),
        };
        Ok(Picture::Picture(word, svg))
    }
}

/// Draws, and writes the file or the picture to standard output.
pub(crate) fn run(args: &PlotArgs, context: &mut Context) -> Result<Answer, Failure> {
    let (figure, svg) = match args.figure.draw(args.output.as_deref(), context)? {
        Picture::Answer(answer) => return Ok(answer),
        Picture::Picture(figure, svg) => (figure, svg),
    };
    let (picture, text) = if let Some(path) = &args.output {
        files::write_text(path, &svg)?;
        let output = path.display().to_string();
        let text = format!("{output}\n");
        (PictureRecord::Written { output }, text)
    } else {
        (PictureRecord::Given { svg: svg.clone() }, svg)
    };
    Ok(Answer::new(Exit::Yes, PlotAnswer { figure, picture }, text))
}
