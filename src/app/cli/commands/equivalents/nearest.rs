//! `equipod equivalents nearest`: the octahedral platform nearest to a design.

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::app::cli::commands::optimize::check_extension;
use crate::app::cli::context::Context;
use crate::app::cli::exit::Exit;
use crate::app::cli::failure::Failure;
use crate::app::cli::files::{self, OutputPath};
use crate::app::cli::output::Answer;
use ask::Design;
use ask::equivalents::NearestDesigns;
use optimize::offsets::DEFAULT_MIN_ABS_DET;
use records::NearestAnswer;
use synthesis::NearestOptions;

/// How far a joint of the design may stand beyond a corner of the triangles sought, in lengths of the side, where
/// nothing is said: what exists is recognised, nothing is chosen.
pub(in crate::app::cli::commands) const EXTENSION: f64 = 1.0;

/// Arguments of `equivalents nearest`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsNearestArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// How far a joint may lie outside its side, on its extension, in lengths of the side
    #[arg(long, value_name = "X", default_value_t = EXTENSION)]
    extension: f64,
    /// Write the octahedral platform as a design
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
    /// Write the platform equivalent to it whose legs are next to those of the design
    #[arg(long, value_name = "FILE")]
    beside: Option<OutputPath>,
}

/// The limits for a design.
pub(in crate::app::cli::commands) fn options(design: &Design, extension: f64) -> NearestOptions {
    NearestOptions { extension, min_abs_det: design.optimize.min_abs_det.unwrap_or(DEFAULT_MIN_ABS_DET) }
}

/// Finds it, and writes the designs asked for.
pub(crate) fn run(args: &EquivalentsNearestArgs, context: &mut Context) -> Result<Answer, Failure> {
    check_extension(args.extension)?;
    let design = context.load(&args.design)?;
    let options = options(&design, args.extension);
    let near = NearestDesigns::of(&design, &options);
    let mut answer = NearestAnswer::new(&design, &options, near.as_ref());
    if let Some(near) = &near {
        for (path, design) in [(&args.output, &near.octahedral), (&args.beside, &near.beside)] {
            if let Some(path) = path {
                files::write_design(path, design)?;
                answer.paths.push(path.display().to_string());
            }
        }
    }
    // that no way was found is no proof that there is none
    let exit = if answer.nearest.is_some() { Exit::Yes } else { Exit::Inconclusive };
    let text = text(&design.units, &answer);
    Ok(Answer::new(exit, answer, text))
}

fn text(units: &str, r: &NearestAnswer) -> String {
    let mut text = format!("{}: {}\n", r.name, r.explanation);
    let Some(n) = &r.nearest else { return text };
    let _ = writeln!(
        text,
        "\nleg  side       offset  base joint moves [{units}]  platform joint moves [{units}]"
    );
    for leg in 0..6 {
        let side = n.order.iter().position(|l| *l == leg + 1).unwrap_or(0);
        let [base, platform] = n.displacements[leg];
        let _ = writeln!(
            text,
            "{:>3}  {:>4}  {:>11.6}  {:>16.6}  {:>20.6}",
            leg + 1,
            side + 1,
            n.offsets[side].0,
            base.0,
            platform.0
        );
    }
    let _ = writeln!(
        text,
        "\nlargest displacement {:.6} {units}, root of the mean square {:.6} {units}; det A = {:.6}\n\
         leg {} differs most in length: {:.6} {units} at {} ({} poses of the {} workspace)",
        n.largest_displacement.0,
        n.rms_displacement.0,
        n.det.0,
        n.deviating_leg,
        n.largest_length_deviation.0,
        n.deviating_pose.short(),
        n.poses,
        if n.workspace_from == records::SourceWord::Design { "design's" } else { "default" }
    );
    if !n.settled {
        text.push_str("the fit has not settled: there are nearer platforms\n");
    }
    if n.set_aside > 0 {
        let _ = writeln!(text, "{} nearer way(s) were set aside: they make no regular platform", n.set_aside);
    }
    for path in &r.paths {
        let _ = writeln!(text, "wrote {path}");
    }
    text
}
