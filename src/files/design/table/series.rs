//! Leg lengths or poses in rows, with times.

use thiserror::Error;

use super::header::{CellUnit, converted, length_unit, plain};
use super::sheet::{CellTable, InvalidSheet, SheetRow};
use platform::geom::{AngleUnit, InvalidPose, ListedFrom, Pose, PoseConvention, RotationOrder};

/// Least count of numbers in a row.
const LEAST_NUMBERS: usize = 2;
/// Greatest number of quoted bad lines.
const QUOTED: usize = 3;

/// Number of lengths in a row.
const LEGS: usize = 6;

/// The contents of the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesKind {
    /// Six leg lengths.
    Lengths,
    /// Six angles of cranks, degrees.
    Angles,
}

/// The kind of rows of a table.
#[derive(Debug, Clone, Copy)]
enum RowKind<'a> {
    /// Six numbers.
    Six(SeriesKind),
    /// A pose, and six leg lengths after it or none.
    Poses { stated: &'a PoseConvention, with_lengths: bool },
}

/// A row that was read.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesRow<T> {
    /// Its line in the text, from 1.
    pub line: usize,
    /// Its time in the unit of the table, if there is a column for it.
    pub time: Option<f64>,
    /// Its value.
    pub value: T,
}

/// A table of rows.
#[derive(Debug, Clone, PartialEq)]
pub struct TimeSeries<T> {
    /// The name of the column of times.
    pub time_name: Option<String>,
    /// In the order of the text; at least one.
    pub rows: Vec<SeriesRow<T>>,
    /// The convention of its poses: what was stated, and what the names of columns say where nothing was.
    pub frames: PoseConvention,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
}

impl<T> TimeSeries<T> {
    /// Rows that stand in no table.
    #[must_use]
    pub fn of_rows(rows: Vec<SeriesRow<T>>) -> Self {
        Self { time_name: None, rows, frames: PoseConvention::default(), guesses: Vec::new() }
    }
}

/// Reasons why a text is no such table.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum InvalidSeries {
    /// It is not a table.
    #[error("{0}")]
    Sheet(InvalidSheet),
    /// It has no row of numbers.
    #[error("there is no line of numbers")]
    Empty,
    /// The names of its angles do not determine their order.
    #[error("`{0}` may be angles in several orders, or a rotation vector: state the rotation order")]
    Order(String),
    /// Columns name each axis once, and the order turns about one of them twice.
    #[error("`{0}` names every axis once, and the rotation order {1} turns about one of them twice")]
    Twice(String, String),
    /// The unit of a column and that of the design have no known ratio.
    #[error("`{0}` is in {1}, and the unit `{2}` of the design is not a known one")]
    Unit(String, &'static str, String),
    /// Columns of travel where lengths are needed.
    #[error("`{0}` is a travel and not a length from joint centre to joint centre")]
    Travel(String),
    /// Rows that cannot be read, each with its line.
    #[error("{}", quoted(.0))]
    Rows(Vec<String>),
}

fn quoted(rows: &[String]) -> String {
    let shown = rows.iter().take(QUOTED).cloned().collect::<Vec<_>>().join("; ");
    if rows.len() > QUOTED { format!("{shown}; and {} more", rows.len() - QUOTED) } else { shown }
}

impl InvalidSeries {
    /// The faults, one sentence per faulty line.
    pub fn sentences(&self) -> Vec<String> {
        match self {
            Self::Rows(rows) => rows.clone(),
            other => vec![other.to_string()],
        }
    }
}

/// The columns of the values in a row.
struct SeriesColumns {
    time: Option<usize>,
    /// The columns of the values in their order; `None`: all except the time.
    values: Option<Vec<usize>>,
    /// Columns of angles in radians that are read in degrees.
    radians: Vec<usize>,
    /// Columns of lengths in another unit than that of the design, with their units.
    foreign: Vec<(usize, &'static str)>,
    /// The unit of the design.
    units: String,
    /// The convention of the poses.
    frames: PoseConvention,
    /// The number of named columns; 0 without names.
    named: usize,
}

impl SeriesKind {
    /// Reads a table in any common notation; `record` reads the values of a row as decimals with points, separated by
    /// commas.
    ///
    /// A header may name a column of times and, in any order, those of the values. Without names the values are all
    /// columns except the time, in their order. Lines without numbers before the first row are titles. Lengths in
    /// another unit than `units`, as a name or a title says, are converted.
    ///
    /// # Errors
    /// [`InvalidSeries`].
    pub fn read<T>(
        self,
        bytes: &[u8],
        units: &str,
        record: impl Fn(&str) -> Result<T, String>,
    ) -> Result<TimeSeries<T>, InvalidSeries> {
        read_rows(RowKind::Six(self), bytes, units, |_, text| record(text))
    }
}

/// Reads a table of poses in a convention. Names of columns say what it leaves open: the order of `u, v, w`, that
/// `surge, sway, heave` count from home, the units of angles. Positions become those of the unit of the design.
///
/// # Errors
/// [`InvalidSeries`].
pub fn read_poses(
    bytes: &[u8],
    stated: &PoseConvention,
    home: &Pose,
    units: &str,
) -> Result<TimeSeries<Pose>, InvalidSeries> {
    read_rows(RowKind::Poses { stated, with_lengths: false }, bytes, units, |frames, text| {
        frames.read_text(text, home).map_err(|why| why.to_string())
    })
}

/// Reads a table with a pose and six leg lengths a row.
///
/// # Errors
/// [`InvalidSeries`].
pub fn read_poses_with_lengths(
    bytes: &[u8],
    stated: &PoseConvention,
    home: &Pose,
    units: &str,
) -> Result<TimeSeries<(Pose, [f64; 6])>, InvalidSeries> {
    read_rows(RowKind::Poses { stated, with_lengths: true }, bytes, units, |frames, text| {
        let fields: Vec<&str> = text.split(',').collect();
        if !(12..=13).contains(&fields.len()) {
            return Err(format!("{} values instead of a pose and six lengths", fields.len()));
        }
        let (pose, shown) = fields.split_at(fields.len() - LEGS);
        let pose = frames.read_text(&pose.join(","), home).map_err(|why: InvalidPose| why.to_string())?;
        let mut lengths = [0.0; LEGS];
        for (leg, (length, field)) in lengths.iter_mut().zip(shown).enumerate() {
            let read = field.trim().parse().ok().filter(|x: &f64| x.is_finite());
            *length = read.ok_or_else(|| format!("length {}, `{field}`, is not a finite number", leg + 1))?;
        }
        Ok((pose, lengths))
    })
}

fn read_rows<T>(
    kind: RowKind<'_>,
    bytes: &[u8],
    units: &str,
    record: impl Fn(&PoseConvention, &str) -> Result<T, String>,
) -> Result<TimeSeries<T>, InvalidSeries> {
    let mut sheet = match CellTable::read(bytes, LEAST_NUMBERS) {
        Ok(sheet) => sheet,
        Err(InvalidSheet::NoNumbers(_)) => return Err(InvalidSeries::Empty),
        Err(why) => return Err(InvalidSeries::Sheet(why)),
    };
    let mut guesses = std::mem::take(&mut sheet.guesses);
    let header = sheet.header.clone().unwrap_or_default();
    let columns = kind.columns(&sheet, units, &mut guesses)?;
    let (mut rows, mut bad) = (Vec::new(), Vec::new());
    for row in &sheet.rows {
        let has_numbers = row.cells.iter().any(|c| sheet.number(c).is_some());
        if rows.is_empty() && bad.is_empty() && !has_numbers {
            guesses.push(format!(
                "Line {}, `{}`, has no numbers and is passed over.",
                row.line,
                row.cells.join(" ")
            ));
            continue;
        }
        match columns.read(&sheet, row, |text| record(&columns.frames, text)) {
            Ok((time, value)) => rows.push(SeriesRow { line: row.line, time, value }),
            Err(why) => bad.push(format!("line {}: {why}", row.line)),
        }
    }
    if !bad.is_empty() {
        return Err(InvalidSeries::Rows(bad));
    }
    if rows.is_empty() {
        return Err(InvalidSeries::Empty);
    }
    let time_name = columns.time.and_then(|c| header.get(c).cloned());
    Ok(TimeSeries { time_name, rows, frames: columns.frames, guesses })
}

impl RowKind<'_> {
    fn columns(
        self,
        sheet: &CellTable,
        units: &str,
        guesses: &mut Vec<String>,
    ) -> Result<SeriesColumns, InvalidSeries> {
        let header: &[String] = sheet.header.as_deref().unwrap_or_default();
        let names: Vec<String> = header.iter().map(|name| plain(&numbered_name(name))).collect();
        let time = names.iter().position(|name| is_time(name));
        let mut frames = PoseConvention::default();
        let mut radians = Vec::new();
        let values = match self {
            Self::Six(SeriesKind::Lengths) => {
                let found = numbered_columns(&names, &LENGTH_WORDS);
                if let Some(travel) = found.iter().flatten().find(|c| is_travel(&names[**c])) {
                    return Err(InvalidSeries::Travel(header[*travel].clone()));
                }
                found
            }
            Self::Six(SeriesKind::Angles) => numbered_columns(&without_angle_units(&names), &ANGLE_WORDS),
            Self::Poses { stated, with_lengths } => {
                frames = *stated;
                let lengths = with_lengths.then(|| numbered_columns(&names, &LENGTH_WORDS));
                let titled = PoseConvention { angles: stated.angles.or(sheet.angle_unit), ..*stated };
                let found = named_pose(header, &names, &titled)?.filter(|_| lengths != Some(None));
                found.map(|named| {
                    frames = named.frames;
                    guesses.extend(named.guesses);
                    radians = named.radians;
                    named.columns.into_iter().chain(lengths.flatten().into_iter().flatten()).collect()
                })
            }
        };
        let width = sheet.rows.iter().map(|row| row.cells.len()).max().unwrap_or(0);
        let in_order: Vec<usize> = (0..width).filter(|c| Some(*c) != time).collect();
        let taken = values.as_ref().unwrap_or(&in_order);
        let is_in_radians = |c: &usize| {
            let named = header.get(*c).and_then(|name| angle_unit_of(name));
            named.or(sheet.angle_unit) == Some(AngleUnit::Radians)
        };
        let angles: &[usize] = match self {
            Self::Six(SeriesKind::Angles) => taken,
            Self::Six(SeriesKind::Lengths) => &[],
            // three angles, and not the four numbers of a quaternion
            Self::Poses { with_lengths, .. } => {
                let end = taken.len().saturating_sub(if with_lengths { LEGS } else { 0 });
                if end == 6 { &taken[3..6] } else { &[] }
            }
        };
        let is_read_in_degrees = values.is_none() && frames.angles.is_none();
        if matches!(self, Self::Six(_)) || is_read_in_degrees {
            radians.extend(angles.iter().copied().filter(is_in_radians));
        }
        guesses.extend(time.map(|c| format!("The column `{}` holds times.", header[c])));
        if !angles.is_empty() && angles.iter().any(is_in_radians) {
            guesses.push("The angles are in radians, as the table says.".into());
        }
        let foreign = self.foreign_lengths(sheet, taken, units, guesses)?;
        if values.is_none() {
            guesses.extend(self.order_taken(&frames, in_order.len(), !header.is_empty()));
        }
        let unused = (0..header.len())
            .filter(|c| Some(*c) != time && values.as_ref().is_some_and(|list| !list.contains(c)));
        let unused: Vec<String> = unused.map(|c| format!("`{}`", header[c])).collect();
        if !unused.is_empty() {
            guesses.push(format!("These columns are not used: {}.", unused.join(", ")));
        }
        Ok(SeriesColumns {
            time,
            values,
            radians,
            foreign,
            units: units.to_owned(),
            frames,
            named: header.len(),
        })
    }

    /// The columns of lengths in another unit than that of the design.
    ///
    /// # Errors
    /// A unit without a known ratio to that of the design.
    fn foreign_lengths(
        self,
        sheet: &CellTable,
        taken: &[usize],
        units: &str,
        guesses: &mut Vec<String>,
    ) -> Result<Vec<(usize, &'static str)>, InvalidSeries> {
        let lengths: Vec<usize> = match self {
            Self::Six(SeriesKind::Lengths) => taken.to_vec(),
            Self::Six(SeriesKind::Angles) => Vec::new(),
            Self::Poses { with_lengths, .. } => {
                let after = if with_lengths { taken.len().saturating_sub(LEGS).max(3) } else { taken.len() };
                taken.iter().take(3).chain(taken.iter().skip(after)).copied().collect()
            }
        };
        let header: &[String] = sheet.header.as_deref().unwrap_or_default();
        let mut foreign = Vec::new();
        for c in lengths {
            let name = header.get(c).map_or("", String::as_str);
            let Some(unit) = length_unit(name).or(sheet.length_unit).filter(|unit| *unit != units) else {
                continue;
            };
            if converted(1.0, unit, units).is_none() {
                return Err(InvalidSeries::Unit(name.to_owned(), unit, units.to_owned()));
            }
            foreign.push((c, unit));
        }
        let mut said: Vec<&str> = foreign.iter().map(|(_, unit)| *unit).collect();
        said.dedup();
        guesses.extend(
            said.iter()
                .map(|unit| format!("Lengths in {unit}, as the table says, are converted to {units}.")),
        );
        Ok(foreign)
    }

    /// The guess about columns without known names.
    fn order_taken(self, frames: &PoseConvention, count: usize, named: bool) -> Option<String> {
        let Self::Poses { with_lengths, .. } = self else { return None };
        let rotation = match count.saturating_sub(if with_lengths { LEGS } else { 0 }) {
            6 => format!("three angles of the order {}", frames.order()),
            7 => frames.quaternion_order().written(["qw", "qx", "qy", "qz"]).join(","),
            _ => return None,
        };
        let order = format!("x,y,z,{rotation}");
        // three angles without names are the usual form of a table
        match (named, count) {
            (true, _) => Some(format!(
                "The names of the columns say nothing about poses: the columns are taken in the order {order}."
            )),
            (false, 7) => Some(format!("The columns are taken in the order {order}.")),
            (false, _) => None,
        }
    }
}

impl SeriesColumns {
    fn read<T>(
        &self,
        sheet: &CellTable,
        row: &SheetRow,
        record: impl Fn(&str) -> Result<T, String>,
    ) -> Result<(Option<f64>, T), String> {
        if self.named > 0 && row.cells.len() > self.named {
            return Err(format!("{} cells below {} names of columns", row.cells.len(), self.named));
        }
        let cell = |column: usize| row.cells.get(column).map_or("", String::as_str);
        let time = match self.time {
            None => None,
            Some(c) => Some(sheet.number(cell(c)).ok_or_else(|| format!("`{}` is not a time", cell(c)))?),
        };
        let columns: Vec<usize> = match &self.values {
            // missing cells at the end of a line are absent, not blank
            Some(list) => list.iter().copied().filter(|c| *c < row.cells.len()).collect(),
            None => (0..row.cells.len()).filter(|c| Some(*c) != self.time).collect(),
        };
        let unit = |c: usize| self.foreign.iter().find(|(column, _)| *column == c).map(|(_, unit)| *unit);
        let value = |c: usize| match (sheet.number(cell(c)), unit(c)) {
            (Some(angle), _) if self.radians.contains(&c) => format!("{:?}", angle.to_degrees()),
            (Some(length), Some(unit)) => {
                format!("{:?}", converted(length, unit, &self.units).unwrap_or(f64::NAN))
            }
            _ => sheet.with_point(cell(c)),
        };
        let values: Vec<String> = columns.into_iter().map(value).collect();
        Ok((time, record(&values.join(","))?))
    }
}

fn is_time(name: &str) -> bool {
    name.starts_with("time") || ["t", "ts", "tms", "sec", "seconds", "zeit", "zeits"].contains(&name)
}

/// Whether a plain name is that of a travel, which is a length less the least one.
fn is_travel(name: &str) -> bool {
    ["stroke", "ext", "travel", "hub", "course"].iter().any(|word| name.starts_with(word))
}

/// A name whose number stands in brackets: `position[0]`.
fn numbered_name(name: &str) -> String {
    match name.trim().strip_suffix(']').and_then(|head| head.split_once('[')) {
        Some((word, number)) if word.ends_with(char::is_alphanumeric) && number.parse::<u8>().is_ok() => {
            format!("{word}{number}")
        }
        _ => name.to_owned(),
    }
}

/// Column names of leg lengths.
const LENGTH_WORDS: [&str; 3] = ["leg", "len", "l"];
/// Column names of crank angles.
const ANGLE_WORDS: [&str; 7] = ["crank", "angle", "motor", "servo", "theta", "alpha", "q"];

/// The unit of angles at the end of a name, in brackets or not.
fn angle_unit_of(name: &str) -> Option<AngleUnit> {
    if let Some(CellUnit::Angle(unit)) = name.rsplit(['[', '(']).next().and_then(CellUnit::of) {
        return Some(unit);
    }
    let letters: String = name.to_lowercase().chars().filter(|c| c.is_alphabetic()).collect();
    let ends = |words: [&str; 3]| words.iter().any(|word| letters.ends_with(word));
    if ends(["rad", "radian", "radians"]) {
        Some(AngleUnit::Radians)
    } else {
        ends(["deg", "degree", "degrees"]).then_some(AngleUnit::Degrees)
    }
}

/// The names without angle units at their ends.
fn without_angle_units(names: &[String]) -> Vec<String> {
    let ends = ["degrees", "degree", "deg", "radians", "rad"];
    let less = |name: &String| ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name).to_string();
    names.iter().map(less).collect()
}

/// The six columns with one word and the numbers 1 to 6, or 0 to 5, in the order of the numbers. A known word selects
/// one of several such lists.
fn numbered_columns(names: &[String], known: &[&str]) -> Option<Vec<usize>> {
    let parted: Vec<(&str, &str)> =
        names.iter().map(|n| n.split_at(n.trim_end_matches(|c: char| c.is_ascii_digit()).len())).collect();
    let of = |word: &str| -> Option<Vec<usize>> {
        let column = |k: u8| {
            let mut found =
                (0..parted.len()).filter(|c| parted[*c].0 == word && parted[*c].1.parse() == Ok(k));
            let one = found.next()?;
            if found.next().is_none() { Some(one) } else { None }
        };
        (1..=6).map(column).collect::<Option<_>>().or_else(|| (0..=5).map(column).collect())
    };
    // of several lists, such as lengths beside speeds, choose the one with a known word
    let words = parted.iter().map(|(word, _)| *word).filter(|word| !word.is_empty());
    let called = |word: &str| {
        known.iter().any(|name| word == *name || (name.len() > 1 && *name != "leg" && word.contains(name)))
    };
    let mut words: Vec<&str> = words.collect();
    words.sort_by_key(|word| !called(word));
    words.into_iter().find_map(of)
}

/// Names of the turn about x, in several languages.
const ROLL_WORDS: [&str; 5] = ["roll", "rollen", "rollwinkel", "wanken", "roulis"];
/// Names of the turn about y.
const PITCH_WORDS: [&str; 6] = ["pitch", "nick", "nicken", "nickwinkel", "stampfen", "tangage"];
/// Names of the turn about z.
const YAW_WORDS: [&str; 5] = ["yaw", "gier", "gieren", "gierwinkel", "lacet"];

/// The columns of poses that names tell.
struct NamedPose {
    /// Position, then angles or the quaternion, in the order of the convention.
    columns: Vec<usize>,
    /// The convention, with what the names add to it.
    frames: PoseConvention,
    /// Columns in radians among others in degrees.
    radians: Vec<usize>,
    guesses: Vec<String>,
}

/// The columns of x, y and z with those of the angles, or of the quaternion; `None` where names tell no pose.
///
/// # Errors
/// Angles in an order that neither names nor the convention tell.
fn named_pose(
    header: &[String],
    names: &[String],
    stated: &PoseConvention,
) -> Result<Option<NamedPose>, InvalidSeries> {
    let names = without_angle_units(names);
    let column = |accepted: &[&str]| names.iter().position(|n| accepted.contains(&n.as_str()));
    let all = |list: [Option<usize>; 3]| -> Option<[usize; 3]> {
        let [x, y, z] = list;
        Some([x?, y?, z?])
    };
    let by_words = |words: [&[&str]; 3]| all(words.map(column));
    let with_stem = |stem: &str| {
        let [w, x, y, z] = ["w", "x", "y", "z"].map(|axis| {
            names.iter().position(|name| name.strip_suffix(axis).is_some_and(|head| head == stem))
        });
        (w, all([x, y, z]))
    };
    let stems: Vec<&str> = names.iter().filter_map(|name| name.strip_suffix('x')).collect();
    let is_position = |stem: &&&str| {
        ["", "p", "pos", "t", "trans"].contains(*stem)
            || ["position", "translation"].iter().any(|end| stem.ends_with(end))
    };
    // x, y, z beside w are a quaternion if there is another position
    let alone = stems.iter().filter(is_position).find(|stem| with_stem(stem).0.is_none());
    let chosen = alone.or_else(|| stems.iter().find(is_position));
    let usual = chosen.and_then(|stem| with_stem(stem).1);
    let motions = by_words([&["surge"], &["sway"], &["heave"]]);
    let Some(position) = usual.or(motions) else { return Ok(None) };
    let (mut frames, mut guesses, mut radians) = (*stated, Vec::new(), Vec::new());
    if usual.is_none() && stated.relative_to.is_none() {
        frames.relative_to = Some(ListedFrom::Home);
        guesses.push(
            "Surge, sway and heave count from home, along x, y and z, and so does the rotation.".into(),
        );
    }
    let mut columns = position.to_vec();
    let by_stem = stems.iter().filter(|stem| Some(*stem) != chosen).find_map(|stem| {
        let (w, [x, y, z]) = (with_stem(stem).0?, with_stem(stem).1?);
        Some([w, x, y, z])
    });
    let by_units = || Some([column(&["qr", "qw"])?, column(&["qi"])?, column(&["qj"])?, column(&["qk"])?]);
    let by_number = || Some([column(&["q0"])?, column(&["q1"])?, column(&["q2"])?, column(&["q3"])?]);
    let roll = by_words([&ROLL_WORDS, &PITCH_WORDS, &YAW_WORDS]);
    let uvw = by_words([&["u"], &["v"], &["w"]]);
    let is_rotation = |stem: &&&str| {
        ["r", "rot", "rotation", "rvec", "theta", "phi", "angle", "ang", "euler", "tilt"].contains(*stem)
    };
    let rotations = stems.iter().filter(is_rotation).find_map(|stem| with_stem(stem).1);
    if let (None, Some([w, x, y, z])) = (roll, by_stem.or_else(by_units).or_else(by_number)) {
        if by_stem.is_none() && by_units().is_none() {
            guesses.push("`q0` is the scalar part of the quaternion.".into());
        }
        columns.extend(frames.quaternion_order().written([w, x, y, z]));
        return Ok(Some(NamedPose { columns, frames, radians, guesses }));
    }
    let Some(about) = roll.or(uvw).or(rotations) else { return Ok(None) };
    let shown = || about.map(|c| header[c].as_str()).join(", ");
    if stated.rotation_order.is_none() {
        if roll.is_none() && uvw.is_some() {
            frames.rotation_order = Some(RotationOrder::MOVING_XYZ);
            guesses
                .push("U, V and W are turns about x, y and z in this order: R = Rx(U) Ry(V) Rz(W).".into());
        } else if roll.is_none() {
            return Err(InvalidSeries::Order(shown()));
        }
    }
    let order = frames.order();
    let places = order.places().ok_or_else(|| InvalidSeries::Twice(shown(), order.to_string()))?;
    let mut written = about;
    for (axis, place) in places.into_iter().enumerate() {
        written[place] = about[axis];
    }
    let unit = |c: usize| angle_unit_of(&header[c]).unwrap_or(frames.angle_unit());
    let units = written.map(unit);
    // columns of several units are read in degrees
    let one = if units.iter().all(|unit| *unit == units[0]) { units[0] } else { AngleUnit::Degrees };
    if one == AngleUnit::Degrees {
        radians.extend(written.into_iter().filter(|c| unit(*c) == AngleUnit::Radians));
    }
    frames.angles = Some(one).filter(|one| stated.angles.is_some() || *one != AngleUnit::default());
    columns.extend(written);
    Ok(Some(NamedPose { columns, frames, radians, guesses }))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn numbers(text: &str) -> Result<Vec<f64>, String> {
        let fields: Vec<&str> = text.split(',').collect();
        if !(6..=7).contains(&fields.len()) {
            return Err(format!("{} values", fields.len()));
        }
        fields.into_iter().map(|f| f.parse().map_err(|_| format!("`{f}` is not a number"))).collect()
    }

    fn read(kind: SeriesKind, text: &str) -> TimeSeries<Vec<f64>> {
        kind.read(text.as_bytes(), "mm", numbers).unwrap_or_else(|why| panic!("{why}\n{text}"))
    }

    #[test]
    fn times_and_names_are_recognised_in_any_order() {
        let meant = vec![1.5, 2.0, 3.0, 4.0, 5.0, 6.0];
        for (text, time) in [
            ("1.5,2,3,4,5,6\n", None),
            ("l1,l2,l3,l4,l5,l6\n1.5,2,3,4,5,6\n", None),
            ("t;a;b;c;d;e;f\n0,25;1,5;2;3;4;5;6\n", Some(0.25)),
            (
                "leg_6_mm,leg_5_mm,leg_4_mm,leg_3_mm,leg_2_mm,leg_1_mm,time_s\n6,5,4,3,2,1.5,0.25\n",
                Some(0.25),
            ),
            (
                "Time [s]\tv1\tv2\tv3\tv4\tv5\tv6\tL1\tL2\tL3\tL4\tL5\tL6\n0.25\t9\t9\t9\t9\t9\t9\t1.5\t2\t3\t4\t5\t6\n",
                Some(0.25),
            ),
            ("# t l1 l2 l3 l4 l5 l6\n0.25 1.5 2 3 4 5 6\n", Some(0.25)),
            ("Log of May\n1.5 2 3 4 5 6", None),
        ] {
            let found = read(SeriesKind::Lengths, text);
            assert_eq!((&found.rows[0].value, found.rows[0].time), (&meant, time), "{text}");
        }
    }

    fn home() -> Pose {
        Pose::new([1.0, 2.0, 300.0], platform::geom::Angles::from_degrees([0.0, 0.0, 30.0]))
    }

    fn poses(text: &str, stated: &PoseConvention) -> TimeSeries<Pose> {
        read_poses(text.as_bytes(), stated, &home(), "mm").unwrap_or_else(|why| panic!("{why}\n{text}"))
    }

    fn usual(text: &str) -> TimeSeries<Pose> {
        poses(text, &PoseConvention::default())
    }

    #[test]
    fn conventions_of_makers_are_taken_by_their_names_or_refused() {
        let found = usual("X,Y,Z,U,V,W\n0,0,650,5,3,10\n");
        assert!(found.guesses.iter().any(|g| g.contains("Rx(U) Ry(V) Rz(W)")));
        assert_eq!(found.frames.order(), RotationOrder::MOVING_XYZ);
        // the rotation about the platform's own z comes first, that about x last: the column of Rx(U) Ry(V) is its z
        // axis
        let (u, v) = (5.0_f64.to_radians(), 3.0_f64.to_radians());
        let meant = [v.sin(), -u.sin() * v.cos(), u.cos() * v.cos()];
        let pose = found.rows[0].value;
        assert!((0..3).all(|k| (pose.rotation.matrix()[(k, 2)] - meant[k]).abs() < 1e-15));
        assert_eq!(pose.position.z.to_bits(), 650.0_f64.to_bits());
        let moved = usual("surge,sway,heave,roll,pitch,yaw\n0,0,0,0,0,0\n");
        assert!(moved.guesses.iter().any(|g| g.contains("count from home")));
        assert_eq!((moved.rows[0].value, moved.frames.measured_from()), (home(), ListedFrom::Home));
        let text = "x,y,z,rx,ry,rz\n1,2,3,4,5,6\n";
        let unclear = read_poses(text.as_bytes(), &PoseConvention::default(), &home(), "mm");
        assert!(matches!(unclear, Err(InvalidSeries::Order(names)) if names == "rx, ry, rz"));
    }

    #[test]
    fn an_order_that_is_stated_holds_for_columns_of_every_name() {
        let stated =
            |order: &str| PoseConvention { rotation_order: order.parse().ok(), ..Default::default() };
        let table = |names: &str| format!("x,y,z,{names}\n1,2,3,4,5,6\n");
        // named columns are turns about x, y and z, whatever comes first; those without names stand in the order
        for (order, plain) in [("moving-zyx", "6,5,4"), ("fixed-yzx", "5,6,4"), ("vector", "4,5,6")] {
            let convention = stated(order);
            let meant = convention.read_text(&format!("1,2,3,{plain}"), &home()).unwrap();
            for names in ["roll,pitch,yaw", "u,v,w", "rx_deg,ry_deg,rz_deg"] {
                let found = poses(&table(names), &convention);
                assert_eq!(found.rows[0].value, meant, "{order} {names}");
                assert!(!found.guesses.iter().any(|g| g.contains("Rx(U)")));
            }
            assert_eq!(poses(&format!("1,2,3,{plain}\n"), &convention).rows[0].value, meant);
        }
        let twice = read_poses(table("rx,ry,rz").as_bytes(), &stated("moving-zxz"), &home(), "mm");
        assert!(matches!(twice, Err(InvalidSeries::Twice(..))), "{twice:?}");
        let unnamed = poses(&table("alpha,beta,gamma"), &stated("moving-zxz"));
        assert!(
            unnamed.guesses.iter().any(|g| g.contains("taken in the order x,y,z,three angles")),
            "{:?}",
            unnamed.guesses
        );
    }

    #[test]
    fn angles_of_cranks_are_read_by_their_names() {
        let meant = [1.5, 2.0, 3.0, 4.0, 5.0, 6.0];
        for text in [
            "1.5,2,3,4,5,6\n",
            // the output of `ik` for a design with cranks
            "crank_1_deg,crank_2_deg,crank_3_deg,crank_4_deg,crank_5_deg,crank_6_deg,other_1_deg,other_2_deg,other_3_deg,other_4_deg,other_5_deg,other_6_deg\n1.5,2,3,4,5,6,9,9,9,9,9,9\n",
            "other1,other2,other3,other4,other5,other6,servo1,servo2,servo3,servo4,servo5,servo6\n9,9,9,9,9,9,1.5,2,3,4,5,6\n",
        ] {
            assert_eq!(read(SeriesKind::Angles, text).rows[0].value, meant, "{text}");
        }
        let found = read(SeriesKind::Angles, "q1_rad,q2_rad,q3_rad,q4_rad,q5_rad,q6_rad\n1,0,0,0,0,0\n");
        assert_eq!(found.rows[0].value, [1f64.to_degrees(), 0.0, 0.0, 0.0, 0.0, 0.0]);
    }

    #[test]
    fn poses_are_read_by_their_names() {
        let found = usual("time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n1,0,0,1,10,20,30\n");
        let meant = Pose::new([10.0, 20.0, 30.0], platform::geom::Angles::from_radians([1.0, 0.0, 0.0]));
        assert_eq!((found.rows[0].value, found.frames.angles), (meant, Some(AngleUnit::Radians)));
        assert!(found.guesses.iter().any(|g| g.contains("radians")), "{:?}", found.guesses);
        assert_eq!(usual("x,y,z,roll [rad],pitch [rad],yaw [rad]\n10,20,30,1,0,0\n").rows[0].value, meant);
        let mixed = usual("x,y,z,roll_rad,pitch_deg,yaw\n10,20,30,1,0,0\n");
        assert_eq!(mixed.rows[0].value, meant);
        let radians = PoseConvention { angles: Some(AngleUnit::Radians), ..PoseConvention::default() };
        assert_eq!(poses("x,y,z,roll,pitch,yaw\n10,20,30,1,0,0\n", &radians).rows[0].value, meant);
        let degrees = poses("x,y,z,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,0,90\n", &radians).rows[0].value;
        assert!((degrees.angles().degrees()[2] - 90.0).abs() < 1e-12, "the header says the unit");
        for order in platform::geom::QuaternionOrder::ALL {
            let convention = PoseConvention { quaternion: Some(order), ..PoseConvention::default() };
            let found = poses("qw,qx,qy,qz,x,y,z,note\n0,1,0,0,10,20,30,\"a, b\"\n", &convention);
            let bits = found.rows[0].value.quaternion().map(f64::to_bits);
            assert_eq!(bits, [0.0_f64, 1.0, 0.0, 0.0].map(f64::to_bits));
            assert!(found.guesses.iter().any(|g| g.contains("`note`")), "{:?}", found.guesses);
        }
    }

    #[test]
    fn poses_with_lengths_are_read_by_names_and_by_places() {
        let read = |text: &str| {
            let stated = PoseConvention::default();
            let table = read_poses_with_lengths(text.as_bytes(), &stated, &home(), "mm");
            table.unwrap_or_else(|why| panic!("{why}")).rows.remove(0).value
        };
        let pose = Pose::new([10.0, 20.0, 30.0], platform::geom::Angles::from_radians([1.0, 0.0, 0.0]));
        let named = "l6,l5,l4,l3,l2,l1,time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n6,5,4,3,2,1,9,0,0,1,10,20,30\n";
        assert_eq!(read(named), (pose, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
        let bits = read("1,2,3,4,5,6,7,8,9,10,11,12\n").1.map(f64::to_bits);
        assert_eq!(bits, [7.0_f64, 8.0, 9.0, 10.0, 11.0, 12.0].map(f64::to_bits));
        let quaternion = "x,y,z,qw,qx,qy,qz,leg_1,leg_2,leg_3,leg_4,leg_5,leg_6\n1,2,3,1,0,0,0,4,5,6,7,8,9\n";
        assert_eq!(
            read(quaternion).1.map(f64::to_bits),
            [4.0_f64, 5.0, 6.0, 7.0, 8.0, 9.0].map(f64::to_bits)
        );
    }

    #[test]
    fn lengths_of_other_units_are_converted_and_said() {
        let meant = usual("x,y,z,roll,pitch,yaw\n250,20,400.5,1,2,3\n").rows[0].value;
        for text in [
            "t,x [m],y [m],z [m],roll,pitch,yaw\n0,0.25,0.02,0.4005,1,2,3\n",
            "t,x_cm,y_mm,z_m,roll,pitch,yaw\n0,25,20,0.4005,1,2,3\n",
            "t,x,y,z,roll,pitch,yaw\ns,m,m,m,deg,deg,deg\n0,0.25,0.02,0.4005,1,2,3\n",
            "Log, positions in m\nx,y,z,roll,pitch,yaw\n0.25,0.02,0.4005,1,2,3\n",
            "a [m],b [m],c [m],d,e,f\n0.25,0.02,0.4005,1,2,3\n",
        ] {
            let found = usual(text);
            assert_eq!(found.rows[0].value, meant, "{text}");
            assert!(found.guesses.iter().any(|g| g.contains("converted to mm")), "{:?}", found.guesses);
        }
        let lengths = read(SeriesKind::Lengths, "l0_m,l1_m,l2_m,l3_m,l4_m,l5_m\n0.25,1,2,3,4,5\n");
        assert_eq!(lengths.rows[0].value, [250.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0]);
        let unknown = SeriesKind::Lengths.read(b"l1_m,l2_m,l3_m,l4_m,l5_m,l6_m\n1,2,3,4,5,6\n", "1", numbers);
        assert!(matches!(unknown, Err(InvalidSeries::Unit(name, "m", _)) if name == "l1_m"));
        let both = "x [m],y [m],z [m],roll,pitch,yaw,l1,l2,l3,l4,l5,l6\n0.25,0.02,0.4005,1,2,3,1,2,3,4,5,6\n";
        let both =
            read_poses_with_lengths(both.as_bytes(), &PoseConvention::default(), &home(), "mm").unwrap();
        assert_eq!(both.rows[0].value, (meant, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    }

    #[test]
    fn units_of_angles_hold_wherever_they_are_written() {
        let meant = usual("x,y,z,roll_rad,pitch_rad,yaw_rad\n10,20,30,0.1,0.2,0.3\n").rows[0].value;
        for text in [
            "t,x,y,z,roll,pitch,yaw\ns,mm,mm,mm,rad,rad,rad\n0,10,20,30,0.1,0.2,0.3\n",
            "angles in rad\nx,y,z,roll,pitch,yaw\n10,20,30,0.1,0.2,0.3\n",
            "a,b,c,d [rad],e [rad],f [rad]\n10,20,30,0.1,0.2,0.3\n",
            "x,y,z,gier [rad],nick [rad],roll [rad]\n10,20,30,0.3,0.2,0.1\n",
        ] {
            let (found, meant) = (usual(text).rows[0].value, meant);
            let apart = (found.rotation.matrix() - meant.rotation.matrix()).amax();
            assert!(apart < 1e-15, "{text} {apart}");
        }
        let degrees = usual("x,y,z,roll [\u{b0}],pitch [\u{b0}],yaw [\u{b0}]\n0,0,0,0,0,90\n").rows[0].value;
        assert!((degrees.angles().degrees()[2] - 90.0).abs() < 1e-12);
    }

    #[test]
    fn quaternions_are_read_by_their_letters_in_any_order() {
        let meant = usual("x,y,z,qw,qx,qy,qz\n1,2,3,0.5,0.1,-0.7,0.5\n").rows[0].value;
        for names in [
            "pose.position.x,pose.position.y,pose.position.z,pose.orientation.x,pose.orientation.y,pose.orientation.z,pose.orientation.w",
            "x,y,z,qi,qj,qk,qr",
            "tx,ty,tz,quat_x,quat_y,quat_z,quat_w",
        ] {
            let text = format!("{names}\n1,2,3,0.1,-0.7,0.5,0.5\n");
            assert_eq!(usual(&text).rows[0].value, meant, "{names}");
        }
        assert_eq!(usual("x,y,z,q0,q1,q2,q3\n1,2,3,0.5,0.1,-0.7,0.5\n").rows[0].value, meant);
        let unnamed = usual("1,2,3,0.5,0.1,-0.7,0.5\n");
        assert!(unnamed.guesses.iter().any(|g| g.contains("x,y,z,qw,qx,qy,qz")), "{:?}", unnamed.guesses);
        let angles = "x,y,z,theta_x,theta_y,theta_z\n1,2,3,4,5,6\n";
        let unclear = read_poses(angles.as_bytes(), &PoseConvention::default(), &home(), "mm");
        assert!(matches!(unclear, Err(InvalidSeries::Order(_))), "{unclear:?}");
    }

    #[test]
    fn legs_may_count_from_0_and_travels_are_refused() {
        let reversed = "l5,l4,l3,l2,l1,l0\n6,5,4,3,2,1\n";
        let meant = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(read(SeriesKind::Lengths, reversed).rows[0].value, meant);
        let states = "name,position[1],position[0],position[2],position[3],position[4],position[5]\nlegs,2,1,3,4,5,6\n";
        assert_eq!(read(SeriesKind::Lengths, states).rows[0].value, meant);
        let travel = SeriesKind::Lengths.read(b"ext1,ext2,ext3,ext4,ext5,ext6\n1,2,3,4,5,6\n", "mm", numbers);
        assert!(matches!(travel, Err(InvalidSeries::Travel(name)) if name == "ext1"));
    }

    #[test]
    fn every_bad_row_is_named() {
        let text = "t,1,2,3,4,5,6\n0,1,2,3,4,5,6\n1,2,3\n?,1,2,3,4,5,6\n3,1,2,x,4,5,6\n";
        let Err(why) = SeriesKind::Lengths.read(
            text.replace("1,2,3,4,5,6\n0", "a,b,c,d,e,f\n0").as_bytes(),
            "mm",
            numbers,
        ) else {
            panic!()
        };
        let sentences = why.sentences();
        assert_eq!(
            sentences,
            ["line 3: 2 values", "line 4: `?` is not a time", "line 5: `x` is not a number"]
        );
        let named = "l1,l2,l3,l4,l5,l6\n1,2,3,4,5\n1,2,3,4,5,6,7\n";
        let why = SeriesKind::Lengths.read(named.as_bytes(), "mm", numbers).unwrap_err();
        assert_eq!(why.to_string(), "line 2: 5 values; line 3: 7 cells below 6 names of columns");
        assert_eq!(SeriesKind::Lengths.read(b"a,b\n", "mm", numbers), Err(InvalidSeries::Empty));
    }
}
