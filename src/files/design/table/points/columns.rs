//! The columns of coordinates: by the names in the header, or by their order.

use super::InvalidPointTable;
use super::rows::{PointRow, not_a_number};
use super::words::{
    LEG_WORDS, ROW_WORDS, axis_of, bodies_of_words, body_of_word, height_of, misspelt_axis, same_body, stem,
};
use crate::design::table::header::{length_unit, plain, units_in_title};
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::manipulator::Body;

/// Columns of the coordinates of one end of a leg; a missing z is zero.
pub(super) type CoordinateColumns = (usize, usize, Option<usize>);

/// The contents of the columns.
pub(super) struct PointColumns {
    pub(super) first: CoordinateColumns,
    /// The columns of the platform end, for two points per row.
    pub(super) second: Option<CoordinateColumns>,
    /// The column with the number of the leg.
    pub(super) leg: Option<usize>,
    /// Whether the coordinates z are heights of pins above their own plates.
    pub(super) own_heights: bool,
}

/// The common unit of the columns of coordinates.
///
/// # Errors
/// Columns in several units.
pub(super) fn unit_of(header: &[String]) -> Result<Option<&'static str>, InvalidPointTable> {
    let unit = |name: &String| {
        axis_of(&plain(name))?;
        Some((name.clone(), length_unit(name)?))
    };
    let found: Vec<(String, &str)> = header.iter().filter_map(unit).collect();
    let Some((first, one)) = found.first() else { return Ok(None) };
    match found.iter().find(|(_, unit)| unit != one) {
        None => Ok(Some(one)),
        Some((name, other)) => Err(InvalidPointTable::Form(format!(
            "the column `{first}` is in {one} and `{name}` in {other}: write all lengths in one unit"
        ))),
    }
}

/// Makes a header that names a body and no coordinates, such as `Platform joints, in mm`, the title of the rows below.
pub(super) fn header_as_title(sheet: &mut CellTable) {
    let Some(header) = sheet.header.take_if(|header| {
        let words: Vec<String> = header.iter().map(|cell| plain(cell)).collect();
        let said: Vec<Body> = words.iter().filter_map(|word| body_of_word(word)).collect();
        let is_body = said.first().is_some_and(|body| said.iter().all(|other| other == body));
        is_body && PointColumns::named(header, &mut Vec::new()).is_none()
    }) else {
        return;
    };
    let line = sheet.rows.first().map_or(1, |row| row.line.saturating_sub(1).max(1));
    sheet.length_unit = sheet.length_unit.or(units_in_title(&header.join(" ")).0);
    sheet.rows.insert(0, SheetRow { line, cells: header });
}

impl PointColumns {
    /// The columns by the names in the header; `None` if these name no coordinates.
    pub(super) fn named(header: &[String], guesses: &mut Vec<String>) -> Option<Self> {
        let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
        // columns by the word beside each axis, in the order of appearance
        let mut words: Vec<(&str, Vec<(usize, usize)>)> = Vec::new();
        for (column, name) in names.iter().enumerate() {
            let known = axis_of(name).map(|(axis, word)| (axis, stem(word)));
            let Some((axis, word)) = known.or_else(|| misspelt_axis(&header[column])) else { continue };
            if known.is_none() {
                guesses.push(format!("`{}` is read as {word} {}.", header[column], ["x", "y", "z"][axis]));
            }
            // a second x, y, z is the other end
            let open = words
                .iter_mut()
                .find(|(known, list)| same_body(known, word) && list.iter().all(|(a, _)| *a != axis));
            match open {
                Some((_, list)) => list.push((axis, column)),
                None => words.push((word, vec![(axis, column)])),
            }
        }
        let mut own_heights = false;
        for (column, name) in names.iter().enumerate() {
            let Some(word) = height_of(name).map(stem) else { continue };
            let flat = words
                .iter_mut()
                .find(|(known, list)| same_body(known, word) && list.iter().all(|(a, _)| *a != 2));
            if let Some((_, list)) = flat {
                guesses.push(format!("`{}` is the coordinate z.", header[column]));
                list.push((2, column));
                own_heights |= ["pin", "joint", "point"].iter().any(|of_plate| name.contains(of_plate));
            }
        }
        let triple = |list: &[(usize, usize)]| -> Option<CoordinateColumns> {
            let of = |axis: usize| list.iter().find(|(a, _)| *a == axis).map(|(_, column)| *column);
            Some((of(0)?, of(1)?, of(2)))
        };
        let leg = names.iter().position(|name| LEG_WORDS.contains(&name.as_str()));
        match &words[..] {
            [(_, list)] => Some(Self { first: triple(list)?, second: None, leg, own_heights }),
            [(a, first), (b, second)] => {
                let (first, second) = (triple(first)?, triple(second)?);
                let order = if a == b { Body::BOTH } else { bodies_of_words(a, b, guesses) };
                let (first, second) = if order[0] == Body::Base { (first, second) } else { (second, first) };
                Some(Self { first, second: Some(second), leg, own_heights })
            }
            _ => None,
        }
    }

    /// The guess that names columns of numbers that are neither coordinates nor numbers of legs.
    pub(super) fn unused(&self, sheet: &CellTable, rows: &[PointRow<'_>]) -> Option<String> {
        let header = sheet.header.as_ref()?;
        let of_end = |(x, y, z): CoordinateColumns| [Some(x), Some(y), z];
        let used: Vec<usize> =
            [Some(self.first), self.second].into_iter().flatten().flat_map(of_end).flatten().collect();
        let has_numbers = |c: usize| {
            rows.iter().any(|row| row.row.cells.get(c).is_some_and(|cell| sheet.number(cell).is_some()))
        };
        let counts = |name: &String| ROW_WORDS.contains(&plain(name).as_str());
        let unused: Vec<String> = (0..header.len())
            .filter(|c| !used.contains(c) && self.leg != Some(*c) && has_numbers(*c) && !counts(&header[*c]))
            .map(|c| format!("`{}`", header[c]))
            .collect();
        (!unused.is_empty()).then(|| format!("These columns are not used: {}.", unused.join(", ")))
    }

    /// The columns by the order of those with a number in every row.
    pub(super) fn numbered(
        sheet: &CellTable,
        rows: &[PointRow<'_>],
        guesses: &mut Vec<String>,
    ) -> Result<Self, InvalidPointTable> {
        let value = |row: &PointRow<'_>, c: usize| row.row.cells.get(c).and_then(|cell| sheet.number(cell));
        let width = rows.iter().map(|r| r.row.cells.len()).max().unwrap_or(0);
        // a column of numbers with a single word is a mistake, not a column of names
        let count = |c: usize| rows.iter().filter(|row| value(row, c).is_some()).count();
        let mut columns: Vec<usize> = (0..width).filter(|c| 2 * count(*c) > rows.len()).collect();
        if let Some((row, c)) =
            rows.iter().find_map(|row| Some((row.row, *columns.iter().find(|c| value(row, **c).is_none())?)))
        {
            return Err(not_a_number(row, c));
        }
        let counts = |c: usize| {
            let step = |pair: &[PointRow<'_>]| match (value(&pair[0], c), value(&pair[1], c)) {
                // twelve rows may count from one to six twice
                (Some(a), Some(b)) => (b - a - 1.0).abs() < 0.5 || (a - b - 5.0).abs() < 0.5,
                _ => false,
            };
            let starts = rows.first().and_then(|row| value(row, c)).is_some_and(|x| (0.0..1.5).contains(&x));
            let whole = rows.iter().all(|row| value(row, c).is_some_and(|x| x.fract() == 0.0));
            starts && whole && rows.windows(2).all(step)
        };
        if [4, 5, 7].contains(&columns.len()) && columns.first().is_some_and(|c| counts(*c)) {
            columns.remove(0);
            guesses.push("The first column of numbers counts the rows.".into());
        }
        let triple = |c: &[usize]| (c[0], c[1], c.get(2).copied());
        let (first, second) = match columns.len() {
            6 => (triple(&columns[..3]), Some(triple(&columns[3..]))),
            4 => (triple(&columns[..2]), Some(triple(&columns[2..]))),
            3 | 2 => (triple(&columns), None),
            n => {
                let message = format!(
                    "the rows have {n} columns of numbers: a point has two or three, the two ends of a leg have four or six"
                );
                return Err(InvalidPointTable::Form(message));
            }
        };
        let order = if second.is_some() {
            "of the base end and then of the platform end of a leg"
        } else {
            "of a joint"
        };
        guesses.push(format!("The columns are the coordinates {order}."));
        if first.2.is_none() {
            guesses.push("There is no z: all joints are at z = 0 of their body.".into());
        }
        Ok(Self { first, second, leg: None, own_heights: false })
    }
}
