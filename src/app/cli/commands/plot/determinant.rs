//! `equipod plot det`.

use std::path::PathBuf;

use crate::app::cli::numbers;
use crate::app::cli::{Context, Failure};
use files::plot::{SliceAxis, SliceFigure, singular_slice};
use platform::manipulator::Octahedral;
use synthesis::offset_determinant;

/// Number of grid points along each side.
const SIDE: usize = 201;

/// Arguments of `plot det`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotDeterminantArgs {
    /// Octahedral design (.toml or .json)
    design: PathBuf,
    /// Two offsets for the axes, 1 to 6 around the octahedron; `equal`: base and platform offsets
    #[arg(long, value_name = "I,J", default_value = "equal", value_parser = ChangedOffsets::parse)]
    slice: ChangedOffsets,
    /// Six offsets of the marked design, as fractions of the edges; those off the axes are kept
    #[arg(long, value_name = "T1,..,T6", allow_hyphen_values = true, default_value = "0,0,0,0,0,0", value_parser = six)]
    offsets: Offsets,
    /// Least and greatest offset in the picture
    #[arg(long, value_name = "A,B", allow_hyphen_values = true, default_value = "-0.5,1.5", value_parser = range)]
    range: (f64, f64),
}

/// Offsets in the order of the legs around the octahedron.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Offsets([f64; 6]);

/// The offsets on the axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ChangedOffsets {
    /// All base offsets to the right, all platform offsets upwards.
    Equal,
    Two(usize, usize),
}

impl ChangedOffsets {
    fn parse(text: &str) -> Result<Self, String> {
        if text == "equal" {
            return Ok(Self::Equal);
        }
        let place = |t: &str| t.trim().parse().ok().filter(|k| (1..=6).contains(k)).map(|k: usize| k - 1);
        match text.split_once(',').map(|(a, b)| (place(a), place(b))) {
            Some((Some(a), Some(b))) if a != b => Ok(Self::Two(a, b)),
            _ => Err("give two different numbers from 1 to 6, or `equal`".into()),
        }
    }

    fn put(self, t: &mut [f64; 6], across: f64, up: f64) {
        match self {
            Self::Equal => *t = std::array::from_fn(|k| if k % 2 == 0 { across } else { up }),
            Self::Two(i, j) => (t[i], t[j]) = (across, up),
        }
    }

    /// The place of the offsets in the plane of the picture, if they lie in it.
    fn place(self, t: &[f64; 6]) -> Option<(f64, f64)> {
        let same = |k: usize| (t[k] - t[k + 2]).abs() <= 1e-12 && (t[k] - t[k + 4]).abs() <= 1e-12;
        match self {
            Self::Equal => (same(0) && same(1)).then_some((t[0], t[1])),
            Self::Two(i, j) => Some((t[i], t[j])),
        }
    }

    fn labels(self) -> [String; 2] {
        match self {
            Self::Equal => ["base", "platform"].map(|body| format!("offsets on the {body} edges [edge]")),
            Self::Two(i, j) => [i, j].map(|k| format!("offset t{} [edge]", k + 1)),
        }
    }
}

fn six(text: &str) -> Result<Offsets, String> {
    numbers::parse(text).map(Offsets).ok_or_else(|| "give six numbers separated by commas".into())
}

fn range(text: &str) -> Result<(f64, f64), String> {
    let ends = numbers::parse(text).filter(|[a, b]| a < b).map(|[a, b]| (a, b));
    ends.ok_or_else(|| "give two numbers, the smaller one first".into())
}

pub(super) fn draw(args: &PlotDeterminantArgs, context: &mut Context) -> Result<String, Failure> {
    let design = context.load(&args.design)?;
    if let Err(why) = Octahedral::recognise(design.manipulator()) {
        let failure =
            Failure::refused("plot::not_octahedral", format!("the design is not octahedral: {why}"));
        return Err(failure.with_help("offsets along edges belong to an octahedral design"));
    }
    let (low, high) = args.range;
    let step = |k: usize| low + (high - low) * k as f64 / (SIDE as f64 - 1.0);
    let value = |k: usize| {
        let mut t = args.offsets.0;
        args.slice.put(&mut t, step(k % SIDE), step(k / SIDE));
        offset_determinant(&t)
    };
    let [across, up] = args.slice.labels().map(|label| SliceAxis { label, low, high });
    let det = offset_determinant(&args.offsets.0);
    let list = |t: &[f64; 6]| t.map(|x| x.to_string()).join(", ");
    let rest = match args.slice {
        ChangedOffsets::Equal => "equal offsets on each body".to_string(),
        ChangedOffsets::Two(..) => format!("the other offsets as in ({})", list(&args.offsets.0)),
    };
    Ok(singular_slice(&SliceFigure {
        title: format!("det A of the platforms without shared joints of \u{201c}{}\u{201d}", design.name),
        quantity: "det A".into(),
        note: format!("{rest}; det A = {det:.6} at ({})", list(&args.offsets.0)),
        across,
        up,
        side: SIDE,
        values: (0..SIDE * SIDE).map(value).collect(),
        mark: args.slice.place(&args.offsets.0).map(|at| (at, "det A = ".to_string() + &format!("{det:.4}"))),
    }))
}
