//! The ends of the legs from six rows of two points or twelve rows of one.

use nalgebra::Point3;

use super::InvalidPointTable;
use super::columns::PointColumns;
use super::rows::{PointRow, point};
use super::words::{FIRST_WITH_FIRST, bodies_of_words, body_of_word, only_number};
use crate::design::table::header::plain;
use crate::design::table::sheet::{CellTable, SheetRow};
use platform::manipulator::Body;

/// A point with its name.
pub(super) struct NamedPoint {
    pub(super) at: Point3<f64>,
    pub(super) name: Option<String>,
}

/// The points of base and platform, in leg order.
pub(super) type Ends = [Vec<NamedPoint>; 2];

pub(super) fn six_rows(
    sheet: &CellTable,
    rows: &[PointRow<'_>],
    columns: &PointColumns,
    guesses: &mut Vec<String>,
) -> Result<Ends, InvalidPointTable> {
    if rows.len() != 6 {
        let message =
            format!("there are {} rows with both ends of a leg instead of six{}", rows.len(), last_row(rows));
        return Err(InvalidPointTable::Form(message));
    }
    let mut rows: Vec<&PointRow<'_>> = rows.iter().collect();
    let number = |row: &PointRow<'_>| leg_number(sheet, row.row.cells.get(columns.leg?)?);
    let numbers: Option<Vec<u64>> = rows.iter().map(|row| number(row)).collect();
    if let Some(numbers) = numbers {
        if let Some(k) = second_of_two(&numbers) {
            let message = format!("line {}: leg {} is there twice", rows[k].row.line, numbers[k]);
            return Err(InvalidPointTable::Form(message));
        }
        if !numbers.is_sorted() {
            rows.sort_by_key(|row| number(row));
            guesses.push("The legs are put in the order of their numbers.".into());
        }
    }
    let mut ends: Ends = [Vec::new(), Vec::new()];
    for row in rows {
        let words = words(sheet, row.row);
        let name = |i: usize| if words.len() == 2 { words.get(i).map(ToString::to_string) } else { None };
        ends[0].push(NamedPoint { at: point(sheet, row, columns.first)?, name: name(0) });
        ends[1].push(NamedPoint {
            at: point(sheet, row, columns.second.unwrap_or(columns.first))?,
            name: name(1),
        });
    }
    Ok(ends)
}

pub(super) fn twelve_rows(
    sheet: &CellTable,
    rows: &[PointRow<'_>],
    columns: &PointColumns,
    guesses: &mut Vec<String>,
) -> Result<Ends, InvalidPointTable> {
    if rows.len() != 12 {
        let message = format!(
            "there are {} rows of one point instead of twelve, six of the base and six of the platform; a joint of two legs stands there twice{}",
            rows.len(),
            last_row(rows)
        );
        return Err(InvalidPointTable::Form(message));
    }
    let words: Vec<Vec<&str>> = rows.iter().map(|r| words(sheet, r.row)).collect();
    let said = |k: usize| rows[k].body.or_else(|| words[k].iter().find_map(|w| body_of_word(&plain(w))));
    let bodies: Vec<Option<Body>> = (0..12).map(said).collect();
    let said: Option<Vec<Body>> = bodies.iter().copied().collect();
    let bodies = match said.or_else(|| by_letters(&words, guesses)) {
        Some(bodies) => bodies,
        None => by_order(sheet, rows, columns, guesses)?,
    };
    let count = bodies.iter().filter(|b| **b == Body::Base).count();
    if count != 6 {
        let message =
            format!("{count} rows are joints of the base and {} of the platform; each needs six", 12 - count);
        return Err(InvalidPointTable::Form(message));
    }
    let mut ends: [Vec<(Option<u64>, usize, NamedPoint)>; 2] = [Vec::new(), Vec::new()];
    for ((row, body), words) in rows.iter().zip(bodies).zip(&words) {
        let name = words.iter().find(|w| !["base", "platform"].contains(&plain(w).as_str()));
        let at = point(sheet, row, columns.first)?;
        let number = match columns.leg {
            Some(c) => row.row.cells.get(c).and_then(|cell| leg_number(sheet, cell)),
            None => words.iter().find_map(|word| only_number(word)),
        };
        let named = NamedPoint { at, name: name.map(ToString::to_string) };
        ends[body.index()].push((number, row.row.line, named));
    }
    in_order_of_numbers(&mut ends, columns.leg.is_some(), guesses)?;
    Ok(ends.map(|list| list.into_iter().map(|(_, _, point)| point).collect()))
}

/// The cells of a row that are not numbers.
fn words<'a>(sheet: &CellTable, row: &'a SheetRow) -> Vec<&'a str> {
    row.cells.iter().filter(|c| !c.is_empty() && sheet.number(c).is_none()).map(String::as_str).collect()
}

/// The number of a leg in a cell: `3`, `3.0`, `leg 3`.
fn leg_number(sheet: &CellTable, cell: &str) -> Option<u64> {
    match sheet.number(cell) {
        Some(x) if x.fract() == 0.0 => format!("{x:.0}").parse().ok(),
        Some(_) => None,
        None => only_number(cell),
    }
}

/// The place of the first number that stands there a second time.
fn second_of_two(numbers: &[u64]) -> Option<usize> {
    (0..numbers.len()).find(|k| numbers[..*k].contains(&numbers[*k]))
}

/// Puts the joints of each body in the order of their numbers, if every joint has one: joints with the same number are
/// the ends of one leg, wherever they stand.
///
/// # Errors
/// A column of leg numbers with a number twice on one body.
fn in_order_of_numbers(
    ends: &mut [Vec<(Option<u64>, usize, NamedPoint)>; 2],
    of_legs: bool,
    guesses: &mut Vec<String>,
) -> Result<(), InvalidPointTable> {
    let numbers = [0, 1].map(|k| ends[k].iter().map(|(n, ..)| *n).collect::<Option<Vec<u64>>>());
    if let [Some(base), Some(platform)] = &numbers {
        let doubled = [base, platform].map(|list| second_of_two(list));
        if of_legs && let Some((body, k)) = (0..2).find_map(|body| Some((body, doubled[body]?))) {
            let (number, line, _) = &ends[body][k];
            return Err(InvalidPointTable::Form(format!(
                "line {line}: leg {} has two joints of the {}",
                number.unwrap_or_default(),
                Body::BOTH[body]
            )));
        }
        if doubled == [None, None] {
            let sorted = |list: &[u64]| {
                let mut list = list.to_vec();
                list.sort_unstable();
                list
            };
            let equal = sorted(base) == sorted(platform);
            // a column that counts all rows numbers no legs
            let apart = base.iter().all(|number| !platform.contains(number));
            if of_legs && !equal && !apart {
                let message = "the joints of the base and of the platform have different leg numbers";
                return Err(InvalidPointTable::Form(message.into()));
            }
            let moved = !(base.is_sorted() && platform.is_sorted());
            for list in ends.iter_mut() {
                list.sort_by_key(|(number, ..)| *number);
            }
            guesses.push(match (equal, moved) {
                (true, _) => "Joints with the same number are the ends of one leg.".into(),
                (false, true) => "Legs join the joints of both bodies in the order of their numbers.".into(),
                (false, false) => FIRST_WITH_FIRST.into(),
            });
            return Ok(());
        }
    }
    guesses.push(FIRST_WITH_FIRST.into());
    Ok(())
}

/// The last row, for a message about too many rows: totals and notes stand there.
fn last_row(rows: &[PointRow<'_>]) -> String {
    rows.last().map_or_else(String::new, |PointRow { row, .. }| {
        format!(" (the last is line {}, `{}`)", row.line, row.cells.join(" "))
    })
}

/// The bodies of rows that say nothing: six and six, or in turn if only this puts one body above the other.
fn by_order(
    sheet: &CellTable,
    rows: &[PointRow<'_>],
    columns: &PointColumns,
    guesses: &mut Vec<String>,
) -> Result<Vec<Body>, InvalidPointTable> {
    let mut heights = Vec::new();
    for row in rows {
        heights.push(point(sheet, row, columns.first)?.z);
    }
    let above = |of: &dyn Fn(usize) -> bool| {
        let range = |wanted: bool| {
            let list = (0..12).filter(|k| of(*k) == wanted).map(|k| heights[k]);
            list.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), z| (a.min(z), b.max(z)))
        };
        let (upper, lower) = (range(true), range(false));
        upper.0 > lower.1 || lower.0 > upper.1
    };
    if above(&|k| k % 2 == 1) && !above(&|k| k >= 6) {
        guesses.push(
            "The rows are joints of the base and of the platform in turn, as their heights show.".into(),
        );
        return Ok((0..12).map(|k| Body::BOTH[k % 2]).collect());
    }
    guesses.push("The first six rows are joints of the base, the other six of the platform.".into());
    Ok((0..12).map(|k| Body::BOTH[k / 6]).collect())
}

/// The bodies by the letters before the numbers in the names, for example `A1`, `B1`.
fn by_letters(words: &[Vec<&str>], guesses: &mut Vec<String>) -> Option<Vec<Body>> {
    let letters = |list: &Vec<&str>| {
        Some(plain(list.first()?).trim_end_matches(|c: char| c.is_ascii_digit()).to_string())
    };
    let letters: Vec<String> = words.iter().map(letters).collect::<Option<_>>()?;
    let first = letters.first()?;
    let second = letters.iter().find(|l| *l != first)?;
    if letters.iter().any(|l| l != first && l != second)
        || letters.iter().filter(|l| *l == first).count() != 6
    {
        return None;
    }
    let order = bodies_of_words(first, second, guesses);
    Some(letters.iter().map(|l| order[usize::from(l != first)]).collect())
}

/// The names, if every end has a valid one and no two ends of a body have the same, except at the same place.
pub(super) fn names(ends: &Ends) -> Option<[[String; 6]; 2]> {
    let usable = |name: &str| {
        name.chars().count() <= 32 && name.chars().all(|c| c.is_alphanumeric() || "_-. ".contains(c))
    };
    let of = |list: &Vec<NamedPoint>| -> Option<[String; 6]> {
        let named: Vec<String> =
            list.iter().map(|p| p.name.clone().filter(|n| usable(n))).collect::<Option<_>>()?;
        let differ = |i: usize, j: usize| (named[i] == named[j]) == (list[i].at == list[j].at);
        let distinct = (0..named.len()).all(|i| (0..i).all(|j| differ(i, j)));
        if distinct { named.try_into().ok() } else { None }
    };
    Some([of(&ends[0])?, of(&ends[1])?])
}
