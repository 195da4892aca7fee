//! `equipod plot sweep`.

use std::path::PathBuf;

use clap::ValueEnum;

use crate::app::cli::failure::Failure;
use crate::app::cli::swept_table::{Better, SweptTable};
use files::plot::{SweptColumn, SweptFigure, swept_cloud, swept_field, swept_histogram, swept_parallel};

/// Arguments of `plot sweep`.
#[derive(Debug, clap::Args)]
pub(super) struct PlotSweptArgs {
    /// Folder of a sweep, or the file written by `equipod sweep merge`
    table: PathBuf,
    /// Kind of picture
    #[arg(long, value_enum, default_value_t = SweptKind::Scatter)]
    kind: SweptKind,
    /// Columns, separated by commas: horizontal, vertical, colour; two to eight for parallel axes
    #[arg(long, value_name = "A,B,..", value_delimiter = ',', required = true)]
    columns: Vec<String>,
    /// Keep rows with this condition, such as "conditioning > 0.1"; repeat for several
    #[arg(long, value_name = "CONDITION")]
    keep: Vec<String>,
    /// Better directions of the two columns, for the front
    #[arg(long, value_enum, num_args = 2, value_delimiter = ',', value_name = "HIGH|LOW", default_values_t = [Better::High, Better::High])]
    better: Vec<Better>,
}

/// `--kind`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum SweptKind {
    Heat,
    Contour,
    Histogram,
    Parallel,
    Scatter,
    Front,
}

impl SweptKind {
    /// Least and greatest number of columns.
    fn columns(self) -> (usize, usize) {
        match self {
            Self::Contour => (3, 3),
            Self::Histogram => (1, 1),
            Self::Parallel => (2, 8),
            Self::Heat | Self::Scatter | Self::Front => (2, 3),
        }
    }
}

pub(super) fn draw(args: &PlotSweptArgs) -> Result<String, Failure> {
    let (least, most) = args.kind.columns();
    let (kind, given) = (
        args.kind.to_possible_value().map(|v| v.get_name().to_owned()).unwrap_or_default(),
        args.columns.len(),
    );
    if !(least..=most).contains(&given) {
        let message =
            format!("--columns names {given} of the columns, too few or too many for the kind {kind}");
        let help = if least == most {
            format!("give {least} names")
        } else {
            format!("give {least} to {most} names")
        };
        return Err(Failure::refused("plot::columns", message).with_help(help));
    }
    let table = SweptTable::open(&args.table, &args.keep)?;
    let chosen = args.columns.iter().map(|name| table.column(name)).collect::<Result<Vec<usize>, _>>()?;
    let mut candidates = Vec::new();
    let mut values = vec![Vec::new(); chosen.len()];
    table.each_row(|row| {
        candidates.push(row[0].as_number().unwrap_or(-1.0) as i64);
        for (list, k) in values.iter_mut().zip(&chosen) {
            list.push(row[*k].as_number().unwrap_or(f64::NAN));
        }
    })?;
    let all = &table.columns;
    let label = |k: &usize| match &all[*k].unit {
        Some(unit) => format!("{} [{unit}]", all[*k].name),
        None => all[*k].name.clone(),
    };
    let columns =
        chosen.iter().zip(values).map(|(k, values)| SweptColumn { label: label(k), values }).collect();
    let digest = table.note("equipod.plan_sha256");
    let filter = if args.keep.is_empty() { String::new() } else { format!(" with {}", args.keep.join(", ")) };
    let note = format!(
        "{} rows{filter}; plan {}, seed {}, equipod {}",
        candidates.len(),
        digest.get(..12).unwrap_or_default(),
        table.note("equipod.seed"),
        table.note("equipod.version"),
    );
    let figure = SweptFigure { title: table.name.clone(), note, candidates, columns };
    let gain = [args.better[0], args.better[1]].map(|b| b == Better::High);
    Ok(match args.kind {
        SweptKind::Heat => swept_field(&figure, false),
        SweptKind::Contour => swept_field(&figure, true),
        SweptKind::Histogram => swept_histogram(&figure),
        SweptKind::Parallel => swept_parallel(&figure),
        SweptKind::Scatter => swept_cloud(&figure, None),
        SweptKind::Front => swept_cloud(&figure, Some(gain)),
    })
}
