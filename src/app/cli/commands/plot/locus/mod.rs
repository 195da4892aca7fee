//! `equipod plot locus`: the squared length of a virtual leg at all poses while one leg length varies.

mod render;

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;

use crate::app::cli::commands::fk::{failure_of, lengths, pair};
use crate::app::cli::output::{Answer, AnswerText};
use crate::app::cli::{Context, Exit, Failure, OutputPath, files};
use ask::{Design, LocusOptions, LocusReport, NoLocus};
use fk::Method;
use platform::manipulator::LegIndex;
use records::{LocusAnswer, METHODS};
use sheet::Sheet;

/// Arguments of `plot locus`.
#[derive(Debug, clap::Args)]
pub(crate) struct PlotLocusArgs {
    /// Design file (.toml or .json)
    design: PathBuf,
    /// Six lengths, design units; default: from the design; the length of the variable leg is ignored
    #[arg(long, value_name = "L1,..,L6")]
    lengths: Option<String>,
    /// Number of the leg with variable length, 1 to 6
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u8).range(1..=6))]
    leg: u8,
    /// First length of this leg, design units
    #[arg(long, value_name = "L")]
    from: f64,
    /// Last length of this leg, design units
    #[arg(long, value_name = "L")]
    to: f64,
    /// Number of lengths, both ends included
    #[arg(long, value_name = "N", default_value_t = LocusOptions::STEPS, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    steps: u32,
    /// Virtual leg, by its joints; default: the first that trilateration needs, or the first pair that no leg joins
    #[arg(long, value_name = "BASE,PLATFORM")]
    between: Option<String>,
    /// Method of solution; auto takes the best one for the design
    #[arg(long, default_value = "auto", value_parser = PossibleValuesParser::new(METHODS))]
    method: String,
    /// Write the values as a table
    #[arg(long, value_name = "FILE")]
    csv: Option<OutputPath>,
}

/// Solves at each length and computes the distance. Without `output` the text of the answer is the picture.
pub(super) fn run(
    args: &PlotLocusArgs,
    output: Option<&Path>,
    context: &mut Context,
) -> Result<Answer, Failure> {
    let design = context.load(&args.design)?;
    let found = asked(args, &design, context)?;
    let record = LocusAnswer::from(&found);
    let picture = render::picture(&design.name, &found);
    let text = match output {
        Some(path) => {
            files::write_text(path, &picture)?;
            let mut sheet = Sheet::new();
            sheet.line(path.display());
            sheet.add(sheet::answers::locus(&design.name, &record));
            AnswerText::Sheet(sheet)
        }
        None => picture.into(),
    };
    if let Some(path) = &args.csv {
        files::write_text(path, &render::csv(&record))?;
    }
    let exit = if found.is_complete() { Exit::Yes } else { Exit::Inconclusive };
    Ok(Answer::new(exit, record, text))
}

fn asked(args: &PlotLocusArgs, design: &Design, context: &Context) -> Result<LocusReport, Failure> {
    let lengths::GivenLengths::One(given) = lengths::given(args.lengths.as_deref(), design, context)? else {
        return Err(Failure::refused(
            "locus::one_row",
            "--lengths names a table, but the picture needs one set of lengths",
        )
        .with_help("give six lengths separated by commas"));
    };
    let between = args.between.as_deref().map(|text| pair(text, design, "locus::unknown_joint"));
    let leg = LegIndex::new(usize::from(args.leg - 1)).unwrap_or(LegIndex::FIRST); // refused above 6
    let options = LocusOptions::new(given.distances, leg, [args.from, args.to])
        .steps(args.steps)
        .between(between.transpose()?)
        .method(args.method.parse::<Method>().ok())
        .seed(context.seed());
    design.locus(&options).map_err(|why| match why {
        NoLocus::IsLeg(leg) => {
            let names = args.between.as_deref().unwrap_or_default();
            Failure::refused("locus::is_a_leg", format!("--between: {leg} joins {names}"))
                .with_help("give two joints without a common leg")
        }
        NoLocus::NoVirtualLeg => {
            Failure::refused("locus::no_virtual_leg", why.to_string()).with_help("give --between")
        }
        NoLocus::Lengths(_) => Failure::refused("locus::bad_lengths", format!("--from, --to: {why}"))
            .with_help("give lengths that are not negative"),
        NoLocus::Method(why) => failure_of(&why),
        _ => Failure::internal(why.to_string()),
    })
}
