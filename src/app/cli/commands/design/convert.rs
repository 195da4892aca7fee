//! `equipod design convert`: a design in the other notation, in another unit of length, or as parameters of a
//! motion-simulator program.

use std::path::PathBuf;

use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::design::{Format, RigSheet, SheetDialect};
use records::ConvertAnswer;

/// Arguments of `design convert`.
#[derive(Debug, clap::Args)]
pub(crate) struct DesignConvertArgs {
    /// Design file (.toml or .json), or `-` for standard input
    design: PathBuf,
    /// File to write; .json gives JSON, .toml and `-` (standard output) give TOML
    #[arg(short, long, value_name = "FILE")]
    output: OutputPath,
    /// Write all lengths in this unit: um, mm, cm, m, in or ft
    #[arg(long, value_name = "UNIT")]
    units: Option<String>,
    /// Write symmetries of the joints up to rounding as constructions
    #[arg(long)]
    snap: bool,
    /// Write the parameters of a motion-simulator program instead, as `new --sheet` reads them
    #[arg(long, value_name = "DIALECT")]
    dialect: Option<SheetDialect>,
}

/// Reads, checks and writes the design, without the comments of the input.
pub(crate) fn run(args: &DesignConvertArgs, context: &mut Context) -> Result<Answer, Failure> {
    let extension = args.output.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let format = match extension.as_deref() {
        // a sheet has neither notation, and its reader decides on the file name
        _ if args.dialect.is_some() => Format::Toml,
        _ if files::is_standard(&args.output) => Format::Toml,
        Some("toml") => Format::Toml,
        Some("json") => Format::Json,
        _ => {
            let message = format!("{}: the extension names no known format", args.output.display());
            let failure = Failure::refused("convert::unknown_format", message);
            return Err(failure.with_help("end the name in .toml or .json"));
        }
    };
    let mut design = context.load_with_cranks(&args.design)?;
    let mut sentences = Vec::new();
    if args.snap {
        let Some(snapped) = design.snapped() else {
            let message = format!("{}: no further symmetry of the joints was found", design.name);
            return Err(Failure::refused("convert::no_symmetry", message).with_help(
                "joints are compared within two millionths of the size; constructed joints are already exact",
            ));
        };
        sentences = snapped.sentences(&design.units);
        design = snapped.design.into();
    }
    if let Some(units) = &args.units {
        let scaled = design.in_units(units).map_err(|why| {
            Failure::refused("convert::units", why.to_string())
                .with_help("`units` of the design and --units each name one of um, mm, cm, m, in, ft")
        })?;
        design = scaled.into();
    }
    match args.dialect {
        Some(dialect) => {
            if Context::coupled_of(&design)?.is_some() {
                let message = format!("{}: a sheet has ideal joints", design.name);
                let help = "without `offset` and `screw_lead` the sheet has the machine with ideal joints";
                return Err(Failure::refused("design::not_ideal", message).with_help(help));
            }
            let cranks = Context::cranks_of(&design)?;
            let sheet = RigSheet::of(&design, cranks.as_ref()).map_err(|why| {
                Failure::refused("convert::no_sheet", why.to_string()).with_help(why.help())
            })?;
            files::write_text(&args.output, &sheet.text(dialect, &design))?;
        }
        None => files::write_design(&args.output, &design)?,
    }
    let output = args.output.display().to_string();
    sentences.push(format!("wrote {output}\n"));
    let text = sentences.join("\n");
    Ok(Answer::new(Exit::Yes, ConvertAnswer { name: design.name.clone(), output, format }, text))
}
