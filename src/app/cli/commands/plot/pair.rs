//! `equipod plot pair`.

use std::path::PathBuf;

use crate::app::cli::poses;
use crate::app::cli::{Context, Exit, Failure};
use files::plot::{PairFigure, platform_pair};
use platform::geom::PoseConvention;
use synthesis::Relation;
use verify::decide_map;

/// Arguments of `plot pair`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotPairArgs {
    /// Design file (.toml or .json)
    #[arg(value_name = "A")]
    first: PathBuf,
    /// Design file (.toml or .json) of the other design, in the same frames
    #[arg(value_name = "B")]
    second: PathBuf,
    /// Pose of both designs
    #[arg(long, value_name = "POSE", allow_hyphen_values = true, default_value = "home")]
    pose: String,
}

pub(super) fn draw(args: &PlotPairArgs, context: &mut Context) -> Result<String, Failure> {
    let (a, b) = (context.load(&args.first)?, context.load(&args.second)?);
    let pose = poses::parse(
        &args.pose,
        &a.pose_frames(PoseConvention::default()),
        ("--pose", "plot::bad_pose"),
        context,
    )?;
    let found = decide_map(a.manipulator(), b.manipulator()).map_err(|e| Failure::internal(e.to_string()))?;
    let between = match found.relation {
        Relation::Equivalent => {
            vec!["s\u{2032} = A s + c".into(), format!("det A = {:.3}", found.determinant)]
        }
        Relation::Singular => vec!["s\u{2032} = A s + c".into(), "singular".into()],
        Relation::Undecided => vec!["s\u{2032} = A s + c".into(), "undecided".into()],
        Relation::Unrelated => {
            let message = format!(
                "no affine map leads from the squared leg lengths of {} to those of {}: {}",
                a.name,
                b.name,
                found.explanation()
            );
            return Err(Failure::new(Exit::No, "plot::no_leg_map", message).with_help(
                "`equipod equivalents map A B --align` searches for other frames of the second design",
            ));
        }
    };
    let note = match found.relation {
        Relation::Equivalent => {
            "s and s\u{2032} are the squared leg lengths on the left and on the right: the same poses for corresponding lengths, the same singularities"
        }
        _ => "s and s\u{2032} are the squared leg lengths on the left and on the right",
    };
    let figure = PairFigure {
        title: "Two platforms at the same pose".into(),
        names: [a.name.clone(), b.name.clone()],
        between,
        note: note.into(),
        pose,
    };
    Ok(platform_pair([a.manipulator(), b.manipulator()], &figure))
}
