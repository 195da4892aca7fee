//! Leg lengths from the command line, a CSV file or the design.

use std::path::Path;

use crate::app::cli::numbers;
use crate::app::cli::rows::{self, TableName};
use crate::app::cli::{Context, Failure};
use ask::Design;
use files::design::{SeriesKind, SeriesRow, TimeSeries};
use platform::manipulator::LegLengths;

/// Shown lengths, and distances of the joints: the shown lengths minus the offsets of a calibration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::app::cli::commands) struct ShownLengths {
    pub(in crate::app::cli::commands) shown: [f64; 6],
    pub(in crate::app::cli::commands) distances: LegLengths,
}

/// Lengths from one line of a table.
pub(in crate::app::cli::commands) type Row = SeriesRow<ShownLengths>;

/// One problem or many.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::app::cli::commands) enum GivenLengths {
    One(ShownLengths),
    Rows(TimeSeries<ShownLengths>),
}

/// The lengths of `--lengths` (shown lengths), or else the lengths of the design (distances of joints).
pub(in crate::app::cli::commands) fn given(
    option: Option<&str>,
    design: &Design,
    context: &Context,
) -> Result<GivenLengths, Failure> {
    let offsets = design.leg_offsets();
    let Some(text) = option else {
        let own = design.lengths.ok_or_else(|| {
            Failure::refused("fk::no_lengths", "the design has no `lengths` and --lengths was not given")
                .with_help("give --lengths l1,l2,l3,l4,l5,l6 or --lengths FILE.csv")
        })?;
        // lengths in the file are distances of joints, for every command
        let shown = std::array::from_fn(|i| own.get()[i] + offsets[i]);
        return Ok(GivenLengths::One(ShownLengths { shown, distances: own }));
    };
    if text.contains(',') || text.parse::<f64>().is_ok() {
        let one = six(text, &offsets, &design.units).map_err(|message| {
            Failure::refused("fk::bad_lengths", format!("--lengths: {message}"))
                .with_help("give six lengths separated by commas, or a CSV file")
        })?;
        doubt_unit(&one, design, context);
        return Ok(GivenLengths::One(one));
    }
    let rows = rows(Path::new(text), (&offsets, &design.units), context)?;
    if let Some(row) = rows.rows.first() {
        doubt_unit(&row.value, design, context);
    }
    Ok(GivenLengths::Rows(rows))
}

/// Ratio of lengths to those at home from which on they are probably in another unit.
const DOUBTFUL_RATIO: f64 = 5.0;

/// Notes lengths that are far from those at the home pose of the design.
fn doubt_unit(given: &ShownLengths, design: &Design, context: &Context) {
    let Some(home) = design.home.and_then(|home| home.lengths(design.manipulator())) else { return };
    let mean = |lengths: [f64; 6]| lengths.iter().sum::<f64>() / 6.0;
    let (own, at_home) = (mean(given.distances.get()), mean(home.get()));
    let ratio = own / at_home;
    if !(ratio > 1.0 / DOUBTFUL_RATIO && ratio < DOUBTFUL_RATIO) {
        context.note(&format!(
            "The lengths are {own:.3} {units} on average, and at home {at_home:.3} {units}: are they in another unit, or travels?",
            units = design.units
        ));
    }
}

impl ShownLengths {
    fn new(shown: [f64; 6], offsets: &[f64; 6]) -> Result<Self, String> {
        let distances = LegLengths::try_new(std::array::from_fn(|i| shown[i] - offsets[i]));
        let of_calibration = if offsets.iter().any(|d| *d != 0.0) {
            " (the length shown, less the offset of the calibration)"
        } else {
            ""
        };
        let distances = distances.map_err(|why| format!("{why}{of_calibration}"))?;
        Ok(Self { shown, distances })
    }
}

/// Six comma-separated lengths.
pub(in crate::app::cli::commands) fn six(
    text: &str,
    offsets: &[f64; 6],
    units: &str,
) -> Result<ShownLengths, String> {
    ShownLengths::new(numbers::lengths(text, "six", units)?, offsets)
}

/// A table with six lengths on each line.
fn rows(
    path: &Path,
    (offsets, units): (&[f64; 6], &str),
    context: &Context,
) -> Result<TimeSeries<ShownLengths>, Failure> {
    let form = "six lengths a line: l1,l2,l3,l4,l5,l6";
    let table = TableName { path, code: "fk::bad_lengths", form };
    rows::read(SeriesKind::Lengths, table, units, context, |text| six(text, offsets, units))
}

#[cfg(test)]
mod tests {
    use super::*;
    use files::design::InvalidSeries;

    #[test]
    fn csv_takes_a_header_comments_and_names_all_bad_lines() {
        let good = "l1,l2,l3,l4,l5,l6\n\n# note\n1,2,3,4,5,6\n 6, 5,4,3,2,1.5 \r\n";
        let found =
            SeriesKind::Lengths.read(good.as_bytes(), "mm", |text| six(text, &[0.0; 6], "mm")).unwrap().rows;
        assert_eq!(found.iter().map(|r| r.line).collect::<Vec<_>>(), [4, 5]);
        assert!((found[1].value.shown[5] - 1.5).abs() < 1e-15);
        let bad = "1,2,3,4,5,6\n1,2,3\n1,2,x,4,5,6\n1,2,3,4,5,-6\n1,2,3,4,5,inf\n";
        let why = SeriesKind::Lengths
            .read(bad.as_bytes(), "mm", |text| six(text, &[0.0; 6], "mm"))
            .unwrap_err()
            .to_string();
        for line in ["line 2: 3 values", "line 3: value 3 is not a length: `x`", "line 4: ", "and 1 more"] {
            assert!(why.contains(line), "{why}");
        }
        let header_alone = SeriesKind::Lengths.read(b"a,b\n", "mm", |text| six(text, &[0.0; 6], "mm"));
        assert_eq!(header_alone, Err(InvalidSeries::Empty), "a header alone is no data");
    }

    #[test]
    fn the_design_provides_lengths_when_the_option_is_absent() {
        let context = Context::silent();
        let mut design: Design = include_str!("../../../../../designs/rbt-octahedral.toml").parse().unwrap();
        design.lengths = None;
        assert_eq!(given(None, &design, &context).unwrap_err().code, "fk::no_lengths");
        design.lengths = Some(LegLengths::try_new([1.0; 6]).unwrap());
        let given = |option| given(option, &design, &context);
        let own = ShownLengths::new([1.0; 6], &[0.0; 6]).unwrap();
        assert_eq!(given(None).unwrap(), GivenLengths::One(own));
        assert_eq!(given(Some("1,2,3")).unwrap_err().code, "fk::bad_lengths");
        assert_eq!(given(Some("no-such-file.csv")).unwrap_err().code, "file::not_readable");
        // lengths in the file are distances, independent of the offsets
        let table = "\n[calibration]\noffsets = [0.5, -0.5, 0.25, 0, 0, 2]\n";
        let text = format!("{}{table}", include_str!("../../../../../designs/rbt-octahedral.toml"));
        let mut shown: Design = text.parse().unwrap();
        shown.lengths = design.lengths;
        let GivenLengths::One(found) = super::given(None, &shown, &context).unwrap() else {
            panic!("one set")
        };
        assert_eq!((Some(found.distances), found.shown), (design.lengths, [1.5, 0.5, 1.25, 1.0, 1.0, 3.0]));
    }

    #[test]
    fn lengths_have_units_where_the_design_has_one() {
        let shown = |text, units| six(text, &[0.0; 6], units).map(|six| six.shown);
        let found = shown("1 in,36/19 in,12/5 mm,2,5 ft + 3 in,sqrt(4) cm", "mm").unwrap();
        for (found, meant) in found.into_iter().zip([25.4, 25.4 * 36.0 / 19.0, 2.4, 2.0, 1600.2, 20.0]) {
            assert!((found - meant).abs() <= 1e-15 * meant, "{found} {meant}");
        }
        let foot = shown("1 m,1,1,1,1,1", "ft").unwrap()[0];
        assert!((foot - 1.0 / 0.3048).abs() < 1e-15, "{foot}");
        assert!(shown("1 m,1,1,1,1,1", "1").unwrap_err().contains("no known length"));
        assert!(shown("1 parsec,1,1,1,1,1", "mm").unwrap_err().contains("value 1 is not a length"));
    }

    #[test]
    fn joints_are_as_far_apart_as_a_leg_shows_less_its_offset() {
        let offsets = [0.5, -0.25, 0.0, 9.0, -9.0, 3.0];
        let given = six("1,1,1,10,-8,4", &offsets, "mm").unwrap();
        assert_eq!((given.shown[4], given.distances.get()), (-8.0, [0.5, 1.25, 1.0, 1.0, 1.0, 1.0]));
        let why = six("1,1,1,1,1,1", &offsets, "mm").unwrap_err();
        assert!(why.contains("-8") && why.contains("less the offset of the calibration"), "{why}");
    }
}
