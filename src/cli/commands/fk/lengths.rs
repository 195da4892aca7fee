//! Leg lengths from the command line, a CSV file or the design.

use std::path::Path;

use crate::cli::context::Context;
use crate::cli::failure::Failure;
use crate::cli::rows::{self, TableName};
use crate::design::{SeriesKind, SeriesRow, TimeSeries};
use crate::manipulator::LegLengths;

/// Lengths of one line of a table.
pub(in crate::cli::commands) type Row = SeriesRow<LegLengths>;

/// One problem or many.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::cli::commands) enum Given {
    One(LegLengths),
    Rows(TimeSeries<LegLengths>),
}

/// `--lengths`, else the lengths of the design.
pub(in crate::cli::commands) fn given(
    option: Option<&str>,
    of_design: Option<LegLengths>,
    context: &Context,
) -> Result<Given, Failure> {
    let Some(text) = option else {
        return of_design.map(Given::One).ok_or_else(|| {
            Failure::refused("fk::no_lengths", "the design has no `lengths` and --lengths was not given")
                .with_help("give --lengths l1,l2,l3,l4,l5,l6 or --lengths FILE.csv")
        });
    };
    if text.contains(',') || text.parse::<f64>().is_ok() {
        return six(text).map(Given::One).map_err(|message| {
            Failure::refused("fk::bad_lengths", format!("--lengths: {message}"))
                .with_help("give six lengths separated by commas, or a CSV file")
        });
    }
    rows(Path::new(text), context).map(Given::Rows)
}

/// Six comma-separated lengths.
pub(in crate::cli::commands) fn six(text: &str) -> Result<LegLengths, String> {
    let fields: Vec<&str> = text.split(',').map(str::trim).collect();
    let fields: [&str; 6] =
        fields.try_into().map_err(|f: Vec<_>| format!("{} values instead of six", f.len()))?;
    let mut values = [0.0; 6];
    for (i, field) in fields.iter().enumerate() {
        values[i] = field.parse().map_err(|_| format!("value {}, `{field}`, is not a number", i + 1))?;
    }
    LegLengths::try_new(values).map_err(|e| e.to_string())
}

/// A table with six lengths a line.
fn rows(path: &Path, context: &Context) -> Result<TimeSeries<LegLengths>, Failure> {
    let form = "six lengths a line: l1,l2,l3,l4,l5,l6";
    rows::read(SeriesKind::Lengths, TableName { path, code: "fk::bad_lengths", form }, context, six)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::InvalidSeries;

    #[test]
    fn csv_takes_a_header_comments_and_names_all_bad_lines() {
        let good = "l1,l2,l3,l4,l5,l6\n\n# note\n1,2,3,4,5,6\n 6, 5,4,3,2,1.5 \r\n";
        let found = SeriesKind::Lengths.read(good.as_bytes(), six).unwrap().rows;
        assert_eq!(found.iter().map(|r| r.line).collect::<Vec<_>>(), [4, 5]);
        assert!((found[1].value.get()[5] - 1.5).abs() < 1e-15);
        let bad = "1,2,3,4,5,6\n1,2,3\n1,2,x,4,5,6\n1,2,3,4,5,-6\n1,2,3,4,5,inf\n";
        let why = SeriesKind::Lengths.read(bad.as_bytes(), six).unwrap_err().to_string();
        for line in ["line 2: 3 values", "line 3: value 3, `x`", "line 4: ", "line 5: "] {
            assert!(why.contains(line), "{why}");
        }
        let header_alone = SeriesKind::Lengths.read(b"a,b\n", six);
        assert_eq!(header_alone, Err(InvalidSeries::Empty), "a header alone is no data");
    }

    #[test]
    fn the_design_provides_lengths_when_the_option_is_absent() {
        let context = Context::silent();
        let given = |option, of_design| given(option, of_design, &context);
        let l = LegLengths::try_new([1.0; 6]).unwrap();
        assert_eq!(given(None, Some(l)).unwrap(), Given::One(l));
        assert_eq!(given(None, None).unwrap_err().code, "fk::no_lengths");
        assert_eq!(given(Some("1,2,3"), Some(l)).unwrap_err().code, "fk::bad_lengths");
        assert_eq!(given(Some("no-such-file.csv"), Some(l)).unwrap_err().code, "file::not_readable");
    }
}
