//! The twelve ends of the legs from a table in any arrangement of rows and columns.

mod lists;
mod polar;

use nalgebra::Point3;
use thiserror::Error;

use super::hal::{HOME_OF_COMMENT, HexapodPins, home_of};
use super::header::{UNITS, plain};
use super::models;
use super::sheet::{CellTable, InvalidSheet, SheetRow};
use super::text::decode;
use crate::design::{DesignModel, NameCount};
use platform::geom::Pose;
use platform::manipulator::{Body, InvalidManipulator, Leg, Manipulator};

/// Least count of numbers in a row: joints of a flat body are often given by x and y alone.
const LEAST_NUMBERS: usize = 2;

/// Root elements of unsupported models, and the names of their formats.
const MODELS: [(&str, &str); 2] = [("SimMechanics", "Simscape Multibody XML"), ("COLLADA", "COLLADA")];

/// The ends of the six legs from a table.
#[derive(Debug, Clone, PartialEq)]
pub struct PointTable {
    /// The legs, in leg order: the base end in the base frame, the platform end in the platform frame.
    pub legs: [Leg; 6],
    /// Names of the base and platform ends, in leg order, if the table has valid joint names.
    pub names: Option<[[String; 6]; 2]>,
    /// The length unit from the header.
    pub units: Option<String>,
    /// The platform frame at home, base frame, from a comment or from a table with both bodies in one frame.
    pub home: Option<Pose>,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
}

/// Reasons why a table does not give the ends of six legs.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InvalidPointTable {
    /// It is not a table of numbers.
    #[error(transparent)]
    Sheet(#[from] InvalidSheet),
    /// Its rows or columns are not those of twelve points.
    #[error("{0}")]
    Form(String),
    /// It is a model of a simulator, or other XML, without six legs.
    #[error("{0}")]
    Mechanism(String),
    /// It is an exchange file of a CAD program (ISO 10303-21), which is not supported.
    #[error("this is a STEP file, and assemblies are not read")]
    Step,
    /// It is an unsupported model of another program; its name.
    #[error("this is a model of {0}, and such models are not read")]
    Model(&'static str),
    /// The points form no manipulator.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
}

impl PointTable {
    /// Reads six rows of two points, base end first, or twelve rows of one point, in any notation.
    ///
    /// Columns follow the coordinate names of the header if it has any, otherwise their order. Rows of one point belong
    /// to the body given by a cell, a title above them or their name. Without these, the first six belong to the base.
    /// It also reads lists of Python, C, MATLAB, JSON and YAML, settings of `genhexkins` and models of `MuJoCo`, Gazebo
    /// (SDF) and ROS (URDF).
    ///
    /// # Errors
    /// [`InvalidPointTable`].
    pub fn read(bytes: &[u8]) -> Result<Self, InvalidPointTable> {
        let text = decode(bytes).map(|decoded| decoded.text).unwrap_or_default();
        if text.trim_start().starts_with("ISO-10303-21") {
            return Err(InvalidPointTable::Step);
        }
        if models::is_xml(&text) {
            let root = text.split('<').find(|tag| tag.starts_with(|c: char| c.is_ascii_alphabetic()));
            if let Some((_, name)) =
                MODELS.iter().find(|(root_of, _)| root.is_some_and(|r| r.starts_with(root_of)))
            {
                return Err(InvalidPointTable::Model(name));
            }
            return models::read(&text).map_err(InvalidPointTable::Mechanism);
        }
        if let Some(pins) = HexapodPins::read(&text) {
            let HexapodPins { legs, home, guesses } = pins?;
            return Ok(Self { legs, names: None, units: None, home, guesses });
        }
        if let Some(listed) = lists::read(&text) {
            return listed;
        }
        let mut sheet = CellTable::read(bytes, LEAST_NUMBERS)?;
        let mut guesses = std::mem::take(&mut sheet.guesses);
        polar::to_coordinates(&mut sheet, &text, &mut guesses)?;
        let rows = data_rows(&sheet, &mut guesses)?;
        let columns = match sheet.header.as_ref().and_then(|h| PointColumns::named(h, &mut guesses)) {
            Some(columns) => columns,
            None => PointColumns::numbered(&sheet, &rows, &mut guesses)?,
        };
        let points = match columns.second {
            Some(_) => six_rows(&sheet, &rows, &columns, &mut guesses)?,
            None => twelve_rows(&sheet, &rows, &columns, &mut guesses)?,
        };
        let units = sheet.header.as_ref().and_then(|header| unit_of(header));
        guesses.extend(units.iter().map(|unit| format!("The lengths are in {unit}, as the header says.")));
        let names = names(&points);
        let mut table = Self {
            legs: std::array::from_fn(|i| Leg { base: points[0][i].at, platform: points[1][i].at }),
            names,
            units,
            home: text.lines().find_map(home_of),
            guesses,
        };
        if table.home.is_some() {
            table.guesses.push(HOME_OF_COMMENT.to_string());
        } else {
            table.part_frames();
        }
        Ok(table)
    }

    /// If one body is entirely above the other, the table has both in one frame, as in a drawing. The platform frame is
    /// then at the mean height of the platform joints.
    pub(super) fn part_frames(&mut self) {
        // the axis along which the bodies are apart: z if possible
        let Some(axis) = [2, 1, 0].into_iter().find(|axis| self.apart_along(*axis)) else { return };
        let heights = |body: Body| self.legs.map(|leg| leg.end(body)[axis]);
        let above = heights(Body::Platform)[0] > heights(Body::Base)[0];
        let heights = heights(Body::Platform);
        // a common height keeps its exact value
        let level = heights.iter().all(|z| z.to_bits() == heights[0].to_bits());
        let height = if level { heights[0] } else { heights.iter().sum::<f64>() / 6.0 };
        for leg in &mut self.legs {
            leg.platform[axis] -= height;
        }
        let rotation = nalgebra::Rotation3::identity();
        let mut position = [0.0; 3];
        position[axis] = height;
        self.home = Some(Pose::new(position, rotation));
        let name = ["x", "y", "z"][axis];
        let up = if axis == 2 { String::new() } else { format!(" {name} is up.") };
        self.guesses.push(format!(
            "The platform joints are all {} those of the base: both are read in the base frame, and home is at {name} = {height}.{up}",
            if above { "above" } else { "below" }
        ));
    }

    /// Whether all platform joints are beyond all base joints along an axis. Along x and y the distance must exceed the
    /// extent of each body, since bodies in separate frames may be apart by chance.
    fn apart_along(&self, axis: usize) -> bool {
        let range = |body: Body| {
            let of = self.legs.map(|leg| leg.end(body)[axis]);
            (of.into_iter().fold(f64::INFINITY, f64::min), of.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let (base, platform) = (range(Body::Base), range(Body::Platform));
        let gap = (platform.0 - base.1).max(base.0 - platform.1);
        let extent = (base.1 - base.0).max(platform.1 - platform.0);
        gap > 0.0 && (axis == 2 || gap > extent)
    }

    /// The design with these joints: ends with equal coordinates are one joint of several legs.
    ///
    /// # Errors
    /// [`InvalidManipulator`].
    pub fn design(&mut self, name: &str, units: &str) -> Result<DesignModel, InvalidManipulator> {
        let manipulator = Manipulator::from_legs(self.legs)?;
        let counts = Body::BOTH.map(|body| manipulator.joints(body).len());
        for (body, count) in Body::BOTH.into_iter().zip(counts).filter(|(_, count)| *count < 6) {
            let sentence = format!(
                "Legs of the {body} that end at the same place share a joint: it has {count} joints."
            );
            if !self.guesses.contains(&sentence) {
                self.guesses.push(sentence);
            }
        }
        let pairs = manipulator.pairs();
        let mut design = DesignModel::new(name, units, manipulator);
        if let Some(names) = &self.names {
            let of = |body: Body| -> Vec<String> {
                let leg = |j: usize| pairs.iter().position(|(a, b)| body.of((*a, *b)) == j);
                (0..counts[body.index()]).filter_map(|j| Some(names[body.index()][leg(j)?].clone())).collect()
            };
            let named: Result<DesignModel, NameCount> =
                design.clone().with_joint_names(of(Body::Base), of(Body::Platform));
            design = named.unwrap_or(design);
        }
        design.home = self.home;
        Ok(design)
    }
}

/// A point with its name.
struct NamedPoint {
    at: Point3<f64>,
    name: Option<String>,
}

/// A row with numbers, and the body from a title above it.
struct PointRow<'a> {
    row: &'a SheetRow,
    body: Option<Body>,
}

/// The rows with numbers; rows of words are titles of a body, or a repeated header.
fn data_rows<'a>(
    sheet: &'a CellTable,
    guesses: &mut Vec<String>,
) -> Result<Vec<PointRow<'a>>, InvalidPointTable> {
    let mut body = None;
    let mut rows = Vec::new();
    for row in &sheet.rows {
        let numbers = row.cells.iter().filter(|c| sheet.number(c).is_some()).count();
        if numbers >= LEAST_NUMBERS {
            rows.push(PointRow { row, body });
            continue;
        }
        let title = row.cells.join(" ");
        let named = row.cells.iter().find_map(|c| body_of_word(&plain(c)));
        let repeated = row.cells.iter().all(|c| axis_of(&plain(c)).is_some());
        match named {
            Some(said) if numbers == 0 => {
                body = Some(said);
                guesses.push(format!(
                    "Line {}, `{title}`, says that the rows below it are of the {said}.",
                    row.line
                ));
            }
            _ if repeated => {}
            _ if numbers == 0 && (rows.is_empty() || row.cells.len() == 1) => {
                guesses.push(format!("Line {}, `{title}`, has no numbers and is passed over.", row.line));
            }
            _ => {
                let message = format!("line {}, `{title}`, has fewer than two numbers", row.line);
                return Err(InvalidPointTable::Form(message));
            }
        }
    }
    Ok(rows)
}

/// Columns of the coordinates of one end of a leg; a missing z is zero.
type CoordinateColumns = (usize, usize, Option<usize>);

/// The contents of the columns.
struct PointColumns {
    first: CoordinateColumns,
    /// The columns of the platform end, for two points per row.
    second: Option<CoordinateColumns>,
    /// The column with the number of the leg.
    leg: Option<usize>,
}

/// The common unit of the columns of coordinates.
fn unit_of(header: &[String]) -> Option<String> {
    let unit = |name: &String| {
        axis_of(&plain(name))?;
        let name = name.to_lowercase();
        let last = name.split(|c: char| !c.is_alphanumeric()).rfind(|word| !word.is_empty())?;
        UNITS.iter().find(|(spelling, _)| *spelling == last).map(|(_, label)| *label)
    };
    let mut found: Vec<&str> = header.iter().filter_map(unit).collect();
    found.dedup();
    if let [one] = found[..] { Some(one.to_string()) } else { None }
}

/// The coordinate, 0 to 2, at the start or end of a plain name, and the rest of the name.
fn axis_of(name: &str) -> Option<(usize, &str)> {
    let axis = |c: char| "xyz".find(c);
    let last = name.chars().last().and_then(axis).map(|k| (k, &name[..name.len() - 1]));
    let first = name.chars().next().and_then(axis).map(|k| (k, &name[1..]));
    // `index`, `matrix`: a word that contains an x is no coordinate
    let known = |(_, rest): &(usize, &str)| {
        rest.chars().count() <= 2
            || body_of_word(rest).is_some()
            || ["pos", "position", "coord", "coordinate", "point", "joint"].contains(rest)
    };
    last.filter(known).or(first.filter(known))
}

/// The body that a plain word names unambiguously.
pub(super) fn body_of_word(word: &str) -> Option<Body> {
    const BASE: [&str; 8] = ["base", "fixed", "lower", "bottom", "ground", "fest", "unten", "basis"];
    const PLATFORM: [&str; 8] = ["plat", "moving", "mobile", "upper", "top", "effector", "oben", "deck"];
    let has = |list: &[&str]| list.iter().any(|w| word.contains(w));
    match (has(&BASE), has(&PLATFORM)) {
        (true, false) => Some(Body::Base),
        (false, true) => Some(Body::Platform),
        _ => None,
    }
}

/// Pairs of letters, the base first: common one-letter names of the bodies.
const LETTERS: [(&str, &str); 9] = [
    ("a", "b"),
    ("b", "p"),
    ("b", "t"),
    ("b", "m"),
    ("l", "u"),
    ("f", "m"),
    ("1", "2"),
    ("0", "1"),
    ("g", "p"),
];

/// The first letter of a word.
fn initial(word: &str) -> &str {
    word.char_indices().nth(1).map_or(word, |(end, _)| &word[..end])
}

/// The bodies of two different words: by their meaning, or by their order of appearance.
fn bodies_of_words(first: &str, second: &str, guesses: &mut Vec<String>) -> [Body; 2] {
    let said = [first, second].map(body_of_word);
    let is_pair = |(a, b): (&str, &str)| LETTERS.contains(&(a, b));
    let order = match said {
        [Some(body), other] if other != Some(body) => [body, body.other()],
        [None, Some(body)] => [body.other(), body],
        _ if is_pair((first, second)) => Body::BOTH,
        _ if is_pair((second, first)) => [Body::Platform, Body::Base],
        _ if is_pair((initial(first), initial(second))) => Body::BOTH,
        _ if is_pair((initial(second), initial(first))) => [Body::Platform, Body::Base],
        _ => Body::BOTH,
    };
    guesses.push(told_apart([first, second], order));
    order
}

fn told_apart([first, second]: [&str; 2], order: [Body; 2]) -> String {
    format!("`{first}` is the {} and `{second}` the {}.", order[0], order[1])
}

impl PointColumns {
    /// The columns by the names in the header; `None` if these name no coordinates.
    fn named(header: &[String], guesses: &mut Vec<String>) -> Option<Self> {
        let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
        // columns by the word beside each axis, in the order of appearance
        let mut words: Vec<(&str, Vec<(usize, usize)>)> = Vec::new();
        for (column, name) in names.iter().enumerate() {
            let Some((axis, word)) = axis_of(name) else { continue };
            let word =
                word.trim_start_matches("coordinate").trim_start_matches("coord").trim_start_matches("pos");
            // a second x, y, z is the other end
            let open =
                words.iter_mut().find(|(known, list)| *known == word && list.iter().all(|(a, _)| *a != axis));
            match open {
                Some((_, list)) => list.push((axis, column)),
                None => words.push((word, vec![(axis, column)])),
            }
        }
        let triple = |list: &[(usize, usize)]| -> Option<CoordinateColumns> {
            let of = |axis: usize| list.iter().find(|(a, _)| *a == axis).map(|(_, column)| *column);
            Some((of(0)?, of(1)?, of(2)))
        };
        let leg = names.iter().position(|name| LEG_WORDS.contains(&name.as_str()));
        match &words[..] {
            [(_, list)] => Some(Self { first: triple(list)?, second: None, leg }),
            [(a, first), (b, second)] => {
                let (first, second) = (triple(first)?, triple(second)?);
                let order = if a == b { Body::BOTH } else { bodies_of_words(a, b, guesses) };
                let (first, second) = if order[0] == Body::Base { (first, second) } else { (second, first) };
                Some(Self { first, second: Some(second), leg })
            }
            _ => None,
        }
    }

    /// The columns by the order of those with a number in every row.
    fn numbered(
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
        Ok(Self { first, second, leg: None })
    }
}

/// The point in three columns of a row.
fn point(
    sheet: &CellTable,
    row: &SheetRow,
    (x, y, z): CoordinateColumns,
) -> Result<Point3<f64>, InvalidPointTable> {
    let value = |column: usize| {
        let cell = row.cells.get(column).map_or("", String::as_str);
        sheet.number(cell).ok_or_else(|| not_a_number(row, column))
    };
    Ok(Point3::new(value(x)?, value(y)?, z.map_or(Ok(0.0), value)?))
}

fn not_a_number(row: &SheetRow, column: usize) -> InvalidPointTable {
    let cell = row.cells.get(column).map_or("", String::as_str);
    InvalidPointTable::Form(format!("line {}, column {}: `{cell}` is not a number", row.line, column + 1))
}

/// Names of a column with leg numbers.
const LEG_WORDS: [&str; 6] = ["leg", "legnumber", "legno", "strut", "actuator", "limb"];

/// The cells of a row that are not numbers.
fn words<'a>(sheet: &CellTable, row: &'a SheetRow) -> Vec<&'a str> {
    row.cells.iter().filter(|c| !c.is_empty() && sheet.number(c).is_none()).map(String::as_str).collect()
}

/// The points of base and platform, in leg order.
type Ends = [Vec<NamedPoint>; 2];

fn six_rows(
    sheet: &CellTable,
    rows: &[PointRow<'_>],
    columns: &PointColumns,
    guesses: &mut Vec<String>,
) -> Result<Ends, InvalidPointTable> {
    if rows.len() != 6 {
        let message = format!("there are {} rows with both ends of a leg instead of six", rows.len());
        return Err(InvalidPointTable::Form(message));
    }
    let mut rows: Vec<&SheetRow> = rows.iter().map(|r| r.row).collect();
    let number = |row: &SheetRow| sheet.number(row.cells.get(columns.leg?)?);
    let numbers: Option<Vec<f64>> = rows.iter().map(|row| number(row)).collect();
    if numbers.is_some_and(|list| list.windows(2).any(|pair| pair[0] >= pair[1])) {
        rows.sort_by(|a, b| number(a).unwrap_or(0.0).total_cmp(&number(b).unwrap_or(0.0)));
        guesses.push("The legs are put in the order of their numbers.".into());
    }
    let mut ends: Ends = [Vec::new(), Vec::new()];
    for row in rows {
        let words = words(sheet, row);
        let name = |i: usize| if words.len() == 2 { words.get(i).map(ToString::to_string) } else { None };
        ends[0].push(NamedPoint { at: point(sheet, row, columns.first)?, name: name(0) });
        ends[1].push(NamedPoint {
            at: point(sheet, row, columns.second.unwrap_or(columns.first))?,
            name: name(1),
        });
    }
    Ok(ends)
}

fn twelve_rows(
    sheet: &CellTable,
    rows: &[PointRow<'_>],
    columns: &PointColumns,
    guesses: &mut Vec<String>,
) -> Result<Ends, InvalidPointTable> {
    if rows.len() != 12 {
        let message = format!(
            "there are {} rows of one point instead of twelve, six of the base and six of the platform; a joint of two legs stands there twice",
            rows.len()
        );
        return Err(InvalidPointTable::Form(message));
    }
    let words: Vec<Vec<&str>> = rows.iter().map(|r| words(sheet, r.row)).collect();
    let said = |k: usize| rows[k].body.or_else(|| words[k].iter().find_map(|w| body_of_word(&plain(w))));
    let bodies: Vec<Option<Body>> = (0..12).map(said).collect();
    let said: Option<Vec<Body>> = bodies.iter().copied().collect();
    let bodies = said.or_else(|| by_letters(&words, guesses)).unwrap_or_else(|| {
        guesses.push("The first six rows are joints of the base, the other six of the platform.".into());
        (0..12).map(|k| Body::BOTH[k / 6]).collect()
    });
    let count = bodies.iter().filter(|b| **b == Body::Base).count();
    if count != 6 {
        let message =
            format!("{count} rows are joints of the base and {} of the platform; each needs six", 12 - count);
        return Err(InvalidPointTable::Form(message));
    }
    let mut ends: Ends = [Vec::new(), Vec::new()];
    for ((PointRow { row, .. }, body), words) in rows.iter().zip(bodies).zip(&words) {
        let name = words.iter().find(|w| !["base", "platform"].contains(&plain(w).as_str()));
        let at = point(sheet, row, columns.first)?;
        ends[body.index()].push(NamedPoint { at, name: name.map(ToString::to_string) });
    }
    guesses.push("Leg 1 joins the first joint of the base and the first of the platform, and so on.".into());
    Ok(ends)
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
fn names(ends: &Ends) -> Option<[[String; 6]; 2]> {
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

#[cfg(test)]
mod tests;
