//! The twelve ends of the legs from a table in any arrangement of rows and columns.

mod lists;
mod polar;
mod scalars;
mod upright;

use nalgebra::Point3;
use thiserror::Error;

use super::hal::{HOME_OF_COMMENT, HexapodPins, home_of};
use super::header::{length_unit, plain};
use super::models;
use super::sheet::{CellTable, InvalidSheet, SheetRow};
use super::text::decode;
use crate::design::keys::LARGEST;
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
    /// It is a program that computes its numbers.
    #[error("this text computes its numbers, and programs are not run")]
    Computed,
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
        if let Some(listed) = lists::read(&text).or_else(|| scalars::read(&text)) {
            return listed;
        }
        if lists::is_computed(&text) {
            return Err(InvalidPointTable::Computed);
        }
        let mut sheet = CellTable::read(bytes, LEAST_NUMBERS)?;
        if let Some(listed) = scalars::of_one_row(&sheet) {
            return listed;
        }
        let mut guesses = std::mem::take(&mut sheet.guesses);
        upright::turn(&mut sheet, &mut guesses);
        polar::to_coordinates(&mut sheet, &text, &mut guesses)?;
        let rows = data_rows(&sheet, &mut guesses)?;
        let unit = sheet.header.as_ref().map_or(Ok(None), |header| unit_of(header))?;
        if let (Some(of_columns), Some(stated)) = (unit, sheet.length_unit)
            && of_columns != stated
        {
            return Err(InvalidPointTable::Form(format!(
                "the columns are in {of_columns}, and a line above them says {stated}"
            )));
        }
        let units = unit.or(sheet.length_unit).map(String::from);
        let columns = match sheet.header.as_ref().and_then(|h| PointColumns::named(h, &mut guesses)) {
            Some(columns) => columns,
            None => PointColumns::numbered(&sheet, &rows, &mut guesses)?,
        };
        guesses.extend(columns.unused(&sheet, &rows));
        let points = match columns.second {
            Some(_) => six_rows(&sheet, &rows, &columns, &mut guesses)?,
            None => twelve_rows(&sheet, &rows, &columns, &mut guesses)?,
        };
        guesses.extend(units.iter().map(|unit| format!("The lengths are in {unit}, as the table says.")));
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
        } else if !columns.own_heights {
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

/// A row with numbers, and what the titles above it say.
struct PointRow<'a> {
    row: &'a SheetRow,
    body: Option<Body>,
    /// Factor of its numbers, as MATLAB prints it above a matrix.
    scale: f64,
}

/// The factor in a line such as `1.0e+03 *`.
fn scale_of(sheet: &CellTable, row: &SheetRow) -> Option<f64> {
    let text = row.cells.join(" ");
    sheet.number(text.strip_suffix('*')?.trim()).filter(|x| *x > 0.0)
}

/// The rows with numbers; rows of words are titles of a body, or a repeated header.
fn data_rows<'a>(
    sheet: &'a CellTable,
    guesses: &mut Vec<String>,
) -> Result<Vec<PointRow<'a>>, InvalidPointTable> {
    let mut body = None;
    let mut scale = 1.0;
    let mut rows = Vec::new();
    // titles that name a matrix, such as `B =`, and the number of rows above them
    let mut matrices: Vec<(String, usize)> = Vec::new();
    for row in &sheet.rows {
        let numbers = row.cells.iter().filter(|c| sheet.number(c).is_some()).count();
        if numbers >= LEAST_NUMBERS {
            rows.push(PointRow { row, body, scale });
            continue;
        }
        let title = row.cells.join(" ");
        if let Some(factor) = scale_of(sheet, row) {
            guesses.push(format!("Line {}, `{title}`, is a factor of the numbers below it.", row.line));
            scale = factor;
            continue;
        }
        let named = row.cells.iter().find_map(|c| body_of_word(&plain(c)));
        let coordinates = row.cells.iter().filter(|c| axis_of(&plain(c)).is_some()).count();
        let matrix = title.strip_suffix('=').or(title.strip_suffix(':')).map(str::trim);
        match (named, matrix) {
            // the names of the columns again
            _ if numbers == 0 && coordinates >= LEAST_NUMBERS => {}
            (Some(said), _) if numbers == 0 => {
                (body, scale) = (Some(said), 1.0);
                guesses.push(format!(
                    "Line {}, `{title}`, says that the rows below it are of the {said}.",
                    row.line
                ));
            }
            (_, Some(name)) if numbers == 0 => {
                scale = 1.0;
                matrices.push((name.to_owned(), rows.len()));
            }
            _ if numbers == 0 && (rows.is_empty() || row.cells.len() == 1) => {
                guesses.push(format!("Line {}, `{title}`, has no numbers and is passed over.", row.line));
            }
            _ => {
                let message = format!("line {}, `{title}`, has fewer than two numbers", row.line);
                return Err(InvalidPointTable::Form(message));
            }
        }
    }
    if let [(first, 0), (second, 6)] = &matrices[..]
        && rows.iter().all(|row| row.body.is_none())
        && rows.len() == 12
    {
        let order = bodies_of_words(&plain(first), &plain(second), &mut Vec::new());
        guesses.push(told_apart([first, second], order));
        for (k, row) in rows.iter_mut().enumerate() {
            row.body = Some(order[k / 6]);
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
    /// Whether the coordinates z are heights of pins above their own plates.
    own_heights: bool,
}

/// The common unit of the columns of coordinates.
///
/// # Errors
/// Columns in several units.
fn unit_of(header: &[String]) -> Result<Option<&'static str>, InvalidPointTable> {
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

/// Words for a height, which is the coordinate z of a table without z.
const HEIGHT_WORDS: [&str; 5] = ["height", "hoehe", "h\u{f6}he", "hauteur", "elevation"];

/// Words beside an axis that tell nothing about the body.
const POINT_WORDS: [&str; 10] =
    ["coordinate", "coord", "position", "pos", "point", "joint", "pin", "centre", "center", "anchor"];

/// The coordinate, 0 to 2, at the start or end of a plain name, and the rest of the name.
fn axis_of(name: &str) -> Option<(usize, &str)> {
    let axis = |c: char| "xyz".find(c);
    let last = name.chars().last().and_then(axis).map(|k| (k, &name[..name.len() - 1]));
    let first = name.chars().next().and_then(axis).map(|k| (k, &name[1..]));
    // `index`, `matrix`: a word that contains an x is no coordinate
    let known = |(_, rest): &(usize, &str)| {
        rest.chars().count() <= 2 || body_of_word(rest).is_some() || POINT_WORDS.contains(rest)
    };
    last.filter(known).or(first.filter(known))
}

/// The word beside a height: `base` for `base pin height`.
fn height_of(name: &str) -> Option<&str> {
    let rest = HEIGHT_WORDS.iter().find_map(|word| name.strip_suffix(word))?;
    (rest.is_empty() || body_of_word(rest).is_some() || POINT_WORDS.contains(&rest)).then_some(rest)
}

/// A word beside an axis without the words for points.
fn stem(word: &str) -> &str {
    let mut word = word;
    while let Some(shorter) =
        POINT_WORDS.iter().find_map(|noise| word.strip_prefix(noise).or(word.strip_suffix(noise)))
    {
        word = shorter;
    }
    word
}

/// Whether two words beside axes name one body.
fn same_body(a: &str, b: &str) -> bool {
    a == b || body_of_word(a).is_some_and(|body| body_of_word(b) == Some(body))
}

/// The body that a plain word names unambiguously.
pub(super) fn body_of_word(word: &str) -> Option<Body> {
    const BASE: [&str; 11] = [
        "base", "fixed", "lower", "bottom", "ground", "fest", "unten", "basis", "gestell", "inferior",
        "socle",
    ];
    const PLATFORM: [&str; 11] = [
        "plat", "moving", "mobile", "upper", "top", "effector", "oben", "deck", "beweg", "superior", "movil",
    ];
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
            let word = stem(word);
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
    fn unused(&self, sheet: &CellTable, rows: &[PointRow<'_>]) -> Option<String> {
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
        Ok(Self { first, second, leg: None, own_heights: false })
    }
}

/// A number times a factor; a power of ten moves the decimal point without rounding.
fn scaled(cell: &str, x: f64, factor: f64) -> f64 {
    let power = factor.log10();
    if factor.to_bits() == 1.0_f64.to_bits() || power.fract() != 0.0 {
        return x * factor;
    }
    format!("{cell}e{power}").parse().unwrap_or(x * factor)
}

/// The point in three columns of a row.
fn point(
    sheet: &CellTable,
    PointRow { row, scale, .. }: &PointRow<'_>,
    (x, y, z): CoordinateColumns,
) -> Result<Point3<f64>, InvalidPointTable> {
    let value = |column: usize| {
        let cell = row.cells.get(column).map_or("", String::as_str);
        let x = sheet.number(cell).ok_or_else(|| not_a_number(row, column))?;
        let x = scaled(&sheet.with_point(cell), x, *scale);
        if x.abs() < LARGEST {
            Ok(x)
        } else {
            Err(InvalidPointTable::Form(format!(
                "line {}, column {}: `{cell}` is too far out, stay below {LARGEST:e}",
                row.line,
                column + 1
            )))
        }
    };
    Ok(Point3::new(value(x)?, value(y)?, z.map_or(Ok(0.0), value)?))
}

fn not_a_number(row: &SheetRow, column: usize) -> InvalidPointTable {
    let cell = row.cells.get(column).map_or("", String::as_str);
    InvalidPointTable::Form(format!("line {}, column {}: `{cell}` is not a number", row.line, column + 1))
}

/// Names of a column with leg numbers.
const LEG_WORDS: [&str; 11] = [
    "leg",
    "legnumber",
    "legno",
    "strut",
    "actuator",
    "limb",
    "cylinder",
    "bein",
    "zylinder",
    "jambe",
    "pierna",
];

/// Names of a column that counts rows.
const ROW_WORDS: [&str; 8] = ["", "no", "nr", "n", "id", "index", "number", "joint"];

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
        let message =
            format!("there are {} rows with both ends of a leg instead of six{}", rows.len(), last_row(rows));
        return Err(InvalidPointTable::Form(message));
    }
    let mut rows: Vec<&PointRow<'_>> = rows.iter().collect();
    let number = |row: &PointRow<'_>| leg_number(sheet, row.row.cells.get(columns.leg?)?);
    let numbers: Option<Vec<u64>> = rows.iter().map(|row| number(row)).collect();
    if let Some(numbers) = numbers {
        let twice = (0..6).find(|k| numbers[..*k].contains(&numbers[*k]));
        if let Some(k) = twice {
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

fn twelve_rows(
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

/// The number of a leg in a cell: `3`, `3.0`, `leg 3`.
fn leg_number(sheet: &CellTable, cell: &str) -> Option<u64> {
    match sheet.number(cell) {
        Some(x) if x.fract() == 0.0 => format!("{x:.0}").parse().ok(),
        Some(_) => None,
        None => only_number(cell),
    }
}

/// The only number in a word, such as 3 in `base_3`; `None` for several numbers.
fn only_number(word: &str) -> Option<u64> {
    let mut groups = word.split(|c: char| !c.is_ascii_digit()).filter(|group| !group.is_empty());
    let number = groups.next()?.parse().ok()?;
    if groups.next().is_none() { Some(number) } else { None }
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
        let twice = |list: &[u64]| (0..list.len()).find(|k| list[..*k].contains(&list[*k]));
        let doubled = [base, platform].map(|list| twice(list));
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

/// The guess about legs of joints without numbers.
const FIRST_WITH_FIRST: &str =
    "Leg 1 joins the first joint of the base and the first of the platform, and so on.";

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
