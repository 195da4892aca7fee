//! `equipod sweep best`: the best candidates as design files, side by side on one page.

use std::cmp::Ordering;
use std::path::PathBuf;

use crate::app::cli::commands::report;
use crate::app::cli::sweep_folder::SweepFolder;
use crate::app::cli::swept_table::{Better, SweptTable};
use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use num::shown::rounded;
use records::{SweepBestAnswer, SweepBestRecord};
use sweep::SweepCell;

/// The page in the folder.
const PAGE: &str = "report.html";
/// Greatest number of designs written: the page compares all of them.
const MOST: u64 = 50;
/// Number of candidates tried for each requested design: several may be one design.
const RANKED: usize = 20;

/// Arguments of `sweep best`.
#[derive(Debug, clap::Args)]
pub(crate) struct SweepBestArgs {
    /// Folder of the sweep
    folder: PathBuf,
    /// Column of numbers for the ranking
    #[arg(long, value_name = "COLUMN")]
    by: String,
    /// Better direction of its values
    #[arg(long, value_enum, default_value_t = Better::High)]
    better: Better,
    /// Keep rows with this condition, such as "conditioning > 0.1"; repeat for several
    #[arg(long, value_name = "CONDITION")]
    keep: Vec<String>,
    /// Number of candidates
    #[arg(long, value_name = "N", default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..=MOST))]
    count: u64,
    /// Folder for the designs and the page that compares them
    #[arg(short, long, value_name = "DIR")]
    output: OutputPath,
}

/// Ranks the rows, makes the designs again from plan and seed, and compares them.
pub(crate) fn run(args: &SweepBestArgs, context: &Context) -> Result<Answer, Failure> {
    let folder = SweepFolder::open(&args.folder)?;
    let sweep = folder.sweep()?;
    let table = SweptTable::open(&args.folder, &args.keep)?;
    let by = table.column(&args.by)?;
    let mut ranked: Vec<(f64, u64)> = Vec::new();
    let (mut rows, count) = (0, args.count as usize);
    let better = |a: &(f64, u64), b: &(f64, u64)| -> Ordering {
        let order = match args.better {
            Better::High => b.0.total_cmp(&a.0),
            Better::Low => a.0.total_cmp(&b.0),
        };
        // among equal values the first
        order.then(a.1.cmp(&b.1))
    };
    table.each_row(|row| {
        rows += 1;
        let (SweepCell::Integer(k), Some(value)) = (&row[0], row[by].as_number()) else { return };
        if value.is_nan() {
            return;
        }
        ranked.push((value, k.cast_unsigned()));
        // the memory does not grow with the table
        if ranked.len() >= 2 * RANKED * count {
            ranked.sort_by(better);
            ranked.truncate(RANKED * count);
        }
    })?;
    ranked.sort_by(better);
    ranked.truncate(RANKED * count);
    let (mut candidates, mut paths, mut lines) = (Vec::new(), Vec::new(), Vec::new());
    if !ranked.is_empty() {
        files::make_folder(&args.output)?;
        folder.write_poses(&sweep, &args.output)?;
    }
    let mut texts: Vec<String> = Vec::new();
    for (value, k) in ranked {
        if texts.len() == count {
            break;
        }
        let text = sweep.design_text(k).map_err(|why| {
            Failure::new(Exit::No, "sweep::no_design", format!("candidate {k} gives no design: {why}"))
        })?;
        // candidates may differ only in lengths and poses, which are not part of the design
        if texts.contains(&text) {
            continue;
        }
        let place = texts.len() + 1;
        // the page has files in alphabetical order
        let path = args.output.join(format!("{place:02}-candidate-{k}.toml"));
        files::write_text(&path, &text)?;
        texts.push(text);
        let output = path.display().to_string();
        lines.push(format!("{output}  {} {}\n", args.by, rounded(value, context.digits())));
        candidates.push(SweepBestRecord { candidate: k, value: value.into(), output });
        paths.push(path);
    }
    if candidates.is_empty() {
        let answer = SweepBestAnswer { column: args.by.clone(), rows, candidates, page: None };
        return Ok(Answer::new(Exit::No, answer, "No row passes the filters and has a value.\n"));
    }
    let page = args.output.join(PAGE);
    files::write_text(&page, &report::page(report::read(&args.output, paths)?, Some(table.name), None))?;
    let page = page.display().to_string();
    lines.push(format!("{page}\n"));
    let answer = SweepBestAnswer { column: args.by.clone(), rows, candidates, page: Some(page) };
    Ok(Answer::new(Exit::Yes, answer, lines.concat()))
}
