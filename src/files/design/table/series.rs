//! Leg lengths or poses in rows, with times.

use nalgebra::{UnitQuaternion, Vector3};
use thiserror::Error;

use super::header::plain;
use super::sheet::{CellTable, InvalidSheet, SheetRow};
use platform::geom::Pose;

/// Least count of numbers in a row.
const LEAST_NUMBERS: usize = 2;
/// Greatest number of quoted bad lines.
const QUOTED: usize = 20;

/// Number of lengths in a row.
const LEGS: usize = 6;

/// The contents of the rows of a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SeriesKind {
    /// Six leg lengths.
    Lengths,
    /// Six angles of cranks.
    Angles,
    /// Position with roll, pitch and yaw, or with a quaternion.
    Poses,
    /// A pose and six leg lengths after it.
    PosesWithLengths,
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
    /// Whether poses count from home: the header has surge, sway and heave.
    pub from_home: bool,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
}

impl TimeSeries<Pose> {
    /// The poses in the base frame, including those that [count from home](Self::from_home).
    #[must_use]
    pub fn with_home(mut self, home: &Pose) -> Self {
        if std::mem::take(&mut self.from_home) {
            for row in &mut self.rows {
                let Pose { rotation, position } = row.value;
                row.value = Pose { rotation: rotation * home.rotation, position: position + home.position };
            }
        }
        self
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
    #[error("`{0}` may be angles in several orders, or a rotation vector")]
    Order(String),
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
    /// Columns of angles in radians.
    radians: Vec<usize>,
    /// The convention of the pose columns.
    meant: PoseNames,
    /// The number of named columns; 0 without names.
    named: usize,
}

/// The naming convention of pose columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
struct PoseNames {
    /// Whether the angles are the U, V, W of hexapod makers: `R = Rx(U) Ry(V) Rz(W)`.
    uvw: bool,
    /// Whether the positions are the surge, sway and heave of motion simulators, which count from home.
    from_home: bool,
}

impl SeriesKind {
    /// Reads a table in any common notation; `record` reads the values of a row as decimals with points, separated by
    /// commas.
    ///
    /// A header may name a column of times and, in any order, those of the values. Without names the values are all
    /// columns except the time, in their order. Lines without numbers before the first row are titles.
    ///
    /// # Errors
    /// [`InvalidSeries`].
    pub fn read<T>(
        self,
        bytes: &[u8],
        record: impl Fn(&str) -> Result<T, String>,
    ) -> Result<TimeSeries<T>, InvalidSeries> {
        let mut sheet = match CellTable::read(bytes, LEAST_NUMBERS) {
            Ok(sheet) => sheet,
            Err(InvalidSheet::NoNumbers(_)) => return Err(InvalidSeries::Empty),
            Err(why) => return Err(InvalidSeries::Sheet(why)),
        };
        let mut guesses = std::mem::take(&mut sheet.guesses);
        let header = sheet.header.clone().unwrap_or_default();
        let columns = self.columns(&header, &mut guesses)?;
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
            match columns.read(&sheet, row, &record) {
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
        Ok(TimeSeries { time_name, rows, from_home: columns.meant.from_home, guesses })
    }

    fn columns(self, header: &[String], guesses: &mut Vec<String>) -> Result<SeriesColumns, InvalidSeries> {
        let names: Vec<String> = header.iter().map(|name| plain(name)).collect();
        let time = names.iter().position(|name| is_time(name));
        let mut meant = PoseNames::default();
        let values = match self {
            Self::Lengths => numbered_columns(&names, &LENGTH_WORDS),
            Self::Angles => numbered_columns(&without_angle_units(&names), &ANGLE_WORDS),
            Self::Poses => {
                let found = pose_columns(&names, true);
                meant = found.as_ref().map_or(meant, |(_, meant)| *meant);
                found.map(|(columns, _)| columns)
            }
            Self::PosesWithLengths => {
                let lengths = numbered_columns(&names, &LENGTH_WORDS);
                pose_columns(&names, false).zip(lengths).map(|((pose, _), lengths)| [pose, lengths].concat())
            }
        };
        if values.is_none() && matches!(self, Self::Poses | Self::PosesWithLengths) {
            let unclear =
                ["rx", "ry", "rz"].map(|name| without_angle_units(&names).iter().position(|n| n == name));
            if let [Some(x), Some(y), Some(z)] = unclear {
                return Err(InvalidSeries::Order([x, y, z].map(|c| header[c].as_str()).join(", ")));
            }
        }
        if meant.uvw {
            guesses
                .push("U, V and W are turns about x, y and z in this order: R = Rx(U) Ry(V) Rz(W).".into());
        }
        if meant.from_home {
            guesses.push(
                "Surge, sway and heave count from home, along x, y and z, and so does the rotation.".into(),
            );
        }
        guesses.extend(time.map(|c| format!("The column `{}` holds times.", header[c])));
        let in_radians =
            |list: &[usize]| list.iter().copied().filter(|c| names[*c].ends_with("rad")).collect();
        let radians: Vec<usize> = match (&values, self) {
            (Some(list), Self::Angles) => in_radians(list),
            (Some(list), Self::Poses) => in_radians(&list[3..]),
            (Some(list), Self::PosesWithLengths) => in_radians(&list[3..list.len() - LEGS]),
            _ => Vec::new(),
        };
        if !radians.is_empty() {
            guesses.push("The angles are in radians, as the header says.".into());
        }
        let unused = (0..header.len())
            .filter(|c| Some(*c) != time && values.as_ref().is_some_and(|list| !list.contains(c)));
        let unused: Vec<String> = unused.map(|c| format!("`{}`", header[c])).collect();
        if !unused.is_empty() {
            guesses.push(format!("These columns are not used: {}.", unused.join(", ")));
        }
        Ok(SeriesColumns { time, values, radians, meant, named: header.len() })
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
        let value = |c: usize| match sheet.number(cell(c)) {
            Some(angle) if self.radians.contains(&c) => format!("{:?}", angle.to_degrees()),
            _ => sheet.with_point(cell(c)),
        };
        let mut values: Vec<String> = columns.into_iter().map(value).collect();
        if self.meant.uvw {
            turned_xyz(&mut values)?;
        }
        Ok((time, record(&values.join(","))?))
    }
}

fn is_time(name: &str) -> bool {
    name.starts_with("time") || ["t", "ts", "tms", "sec", "seconds", "zeit", "zeits"].contains(&name)
}

/// Column names of leg lengths.
const LENGTH_WORDS: [&str; 3] = ["leg", "len", "l"];
/// Column names of crank angles.
const ANGLE_WORDS: [&str; 7] = ["crank", "angle", "motor", "servo", "theta", "alpha", "q"];

/// The names without angle units at their ends.
fn without_angle_units(names: &[String]) -> Vec<String> {
    let ends = ["degrees", "degree", "deg", "radians", "rad"];
    let less = |name: &String| ends.iter().find_map(|end| name.strip_suffix(end)).unwrap_or(name).to_string();
    names.iter().map(less).collect()
}

/// The six columns with one word and the numbers 1 to 6, in the order of the numbers. A wanted word selects one of
/// several such lists.
fn numbered_columns(names: &[String], wanted: &[&str]) -> Option<Vec<usize>> {
    let parted: Vec<(&str, &str)> =
        names.iter().map(|n| n.split_at(n.trim_end_matches(|c: char| c.is_ascii_digit()).len())).collect();
    let of = |word: &str| -> Option<Vec<usize>> {
        let column = |k: usize| {
            let mut found =
                (0..parted.len()).filter(|c| parted[*c].0 == word && parted[*c].1.parse() == Ok(k));
            let one = found.next()?;
            if found.next().is_none() { Some(one) } else { None }
        };
        (1..=6).map(column).collect()
    };
    // of several lists, such as lengths beside speeds, choose the one with a wanted word
    let words = parted.iter().map(|(word, _)| *word).filter(|word| !word.is_empty());
    let called = |word: &str| {
        wanted.iter().any(|name| word == *name || (name.len() > 1 && *name != "leg" && word.contains(name)))
    };
    let mut words: Vec<&str> = words.collect();
    words.sort_by_key(|word| !called(word));
    words.into_iter().find_map(of)
}

/// The columns of x, y and z with those of the angles or of the quaternion; `others` allows names of other conventions.
fn pose_columns(names: &[String], others: bool) -> Option<(Vec<usize>, PoseNames)> {
    let names = without_angle_units(names);
    let column = |accepted: &[&str]| names.iter().position(|n| accepted.contains(&n.as_str()));
    let usual = [
        column(&["x", "px", "posx", "tx"]),
        column(&["y", "py", "posy", "ty"]),
        column(&["z", "pz", "posz", "tz"]),
    ];
    let from_home = [column(&["surge"]), column(&["sway"]), column(&["heave"])];
    let angles = vec![column(&["roll"]), column(&["pitch"]), column(&["yaw"])];
    let quaternion = vec![column(&["qw"]), column(&["qx"]), column(&["qy"]), column(&["qz"])];
    let uvw = vec![column(&["u"]), column(&["v"]), column(&["w"])];
    let whole = |position: [Option<usize>; 3], rotation: &[Option<usize>], meant: PoseNames| {
        let list: Option<Vec<usize>> = position.into_iter().chain(rotation.iter().copied()).collect();
        Some((list?, meant))
    };
    let plain = PoseNames::default();
    let known = whole(usual, &angles, plain).or_else(|| whole(usual, &quaternion, plain));
    if !others {
        return known;
    }
    known
        .or_else(|| whole(usual, &uvw, PoseNames { uvw: true, from_home: false }))
        .or_else(|| whole(from_home, &angles, PoseNames { uvw: false, from_home: true }))
}

/// `x, y, z, U, V, W` as `x, y, z` and the quaternion of `Rx(U) Ry(V) Rz(W)`.
fn turned_xyz(values: &mut Vec<String>) -> Result<(), String> {
    let number = |text: &String| text.parse::<f64>().map_err(|_| format!("`{text}` is not a number"));
    let [u, v, w] = match &values[..] {
        [_, _, _, u, v, w] => [number(u)?, number(v)?, number(w)?],
        other => return Err(format!("{} values instead of six", other.len())),
    };
    let about = |axis, degrees: f64| UnitQuaternion::from_axis_angle(&axis, degrees.to_radians());
    let turn = about(Vector3::x_axis(), u) * about(Vector3::y_axis(), v) * about(Vector3::z_axis(), w);
    values.truncate(3);
    values.extend([turn.w, turn.i, turn.j, turn.k].map(|q| format!("{q:?}")));
    Ok(())
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
        kind.read(text.as_bytes(), numbers).unwrap_or_else(|why| panic!("{why}\n{text}"))
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

    #[test]
    fn conventions_of_makers_are_taken_by_their_names_or_refused() {
        let found = read(SeriesKind::Poses, "X,Y,Z,U,V,W\n0,0,650,5,3,10\n");
        assert!(found.guesses.iter().any(|g| g.contains("Rx(U) Ry(V) Rz(W)")) && !found.from_home);
        let [_, _, z, w, i, j, k] = found.rows[0].value[..] else { panic!("{:?}", found.rows) };
        // the rotation about the platform's own z comes first, that about x last: the column of Rx(U) Ry(V) is its z
        // axis
        let turned = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, i, j, k)) * Vector3::z();
        let (u, v) = (5.0_f64.to_radians(), 3.0_f64.to_radians());
        let meant = Vector3::new(v.sin(), -u.sin() * v.cos(), u.cos() * v.cos());
        assert!((turned - meant).norm() < 1e-15 && z.to_bits() == 650.0_f64.to_bits());
        let home = read(SeriesKind::Poses, "surge,sway,heave,roll,pitch,yaw\n0,0,0,5,3,10\n");
        assert!(home.from_home && home.guesses.iter().any(|g| g.contains("count from home")));
        let unclear = SeriesKind::Poses.read(b"x,y,z,rx,ry,rz\n1,2,3,4,5,6\n", numbers);
        assert!(matches!(unclear, Err(InvalidSeries::Order(names)) if names == "rx, ry, rz"));
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
        let found =
            read(SeriesKind::Poses, "time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n1,0,0,1,10,20,30\n");
        assert_eq!(found.rows[0].value, [10.0, 20.0, 30.0, 1f64.to_degrees(), 0.0, 0.0]);
        assert!(found.guesses.iter().any(|g| g.contains("radians")), "{:?}", found.guesses);
        let found = read(SeriesKind::Poses, "qw,qx,qy,qz,x,y,z,note\n1,0,0,0,10,20,30,\"a, b\"\n");
        assert_eq!(found.rows[0].value, [10.0, 20.0, 30.0, 1.0, 0.0, 0.0, 0.0]);
        assert!(found.guesses.iter().any(|g| g.contains("`note`")), "{:?}", found.guesses);
    }

    #[test]
    fn poses_with_lengths_are_read_by_names_and_by_places() {
        let numbers = |text: &str| -> Result<Vec<f64>, String> {
            text.split(',').map(|f| f.parse().map_err(|_| format!("`{f}` is not a number"))).collect()
        };
        let read = |text: &str| {
            let kind = SeriesKind::PosesWithLengths;
            kind.read(text.as_bytes(), numbers).unwrap_or_else(|why| panic!("{why}")).rows.remove(0).value
        };
        let meant = [10.0, 20.0, 30.0, 1f64.to_degrees(), 0.0, 0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let named = "l6,l5,l4,l3,l2,l1,time,yaw_rad,pitch_rad,roll_rad,x_mm,y_mm,z_mm\n6,5,4,3,2,1,9,0,0,1,10,20,30\n";
        assert_eq!(read(named), meant);
        assert_eq!(read("1,2,3,4,5,6,7,8,9,10,11,12\n").len(), 12);
        let quaternion = "x,y,z,qw,qx,qy,qz,leg_1,leg_2,leg_3,leg_4,leg_5,leg_6\n1,2,3,1,0,0,0,4,5,6,7,8,9\n";
        assert_eq!(read(quaternion), [1.0, 2.0, 3.0, 1.0, 0.0, 0.0, 0.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]);
    }

    #[test]
    fn every_bad_row_is_named() {
        let text = "t,1,2,3,4,5,6\n0,1,2,3,4,5,6\n1,2,3\n?,1,2,3,4,5,6\n3,1,2,x,4,5,6\n";
        let Err(why) =
            SeriesKind::Lengths.read(text.replace("1,2,3,4,5,6\n0", "a,b,c,d,e,f\n0").as_bytes(), numbers)
        else {
            panic!()
        };
        let sentences = why.sentences();
        assert_eq!(
            sentences,
            ["line 3: 2 values", "line 4: `?` is not a time", "line 5: `x` is not a number"]
        );
        let named = "l1,l2,l3,l4,l5,l6\n1,2,3,4,5\n1,2,3,4,5,6,7\n";
        let why = SeriesKind::Lengths.read(named.as_bytes(), numbers).unwrap_err();
        assert_eq!(why.to_string(), "line 2: 5 values; line 3: 7 cells below 6 names of columns");
        assert_eq!(SeriesKind::Lengths.read(b"a,b\n", numbers), Err(InvalidSeries::Empty));
    }
}
