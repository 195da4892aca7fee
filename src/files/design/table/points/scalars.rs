//! Coordinates as single values with a name each: `#define BASE_0_X 310`, `B1x = 310`, or a row below such names.

use super::words::{bodies_of_words, body_of_word, told_apart};
use super::{InvalidPointTable, PointTable};
use crate::design::table::header::CellUnit;
use crate::design::table::sheet::CellTable;
use nalgebra::Point3;
use platform::manipulator::{Body, Leg};

/// Fewest values that make a text such a list: x and y of twelve joints.
const FEWEST: usize = 24;

/// The name of a coordinate: the word of its body, the number of the joint, and the axis from 0.
#[derive(Debug, Clone, PartialEq, Eq)]
struct CoordinateName {
    word: String,
    joint: usize,
    axis: usize,
}

impl CoordinateName {
    /// Parts `DEFAULT_BASE_0_X`, `base[0].x`, `B1x` or `Bx1`.
    fn of(name: &str) -> Option<Self> {
        let mut parts: Vec<String> = Vec::new();
        let mut digits = None;
        for c in name.chars() {
            let kind = c.is_ascii_digit();
            if !c.is_alphanumeric() {
                digits = None;
                continue;
            }
            if digits == Some(kind) {
                parts.last_mut()?.extend(c.to_lowercase());
            } else {
                parts.push(c.to_lowercase().collect());
                digits = Some(kind);
            }
        }
        let axis = |word: &str| ["x", "y", "z"].iter().position(|axis| *axis == word);
        let (word, joint, axis) = match parts.as_slice() {
            [.., word, joint, last] if axis(last).is_some() => (word.as_str(), joint, axis(last)?),
            [.., word, middle, joint] if axis(middle).is_some() => (word.as_str(), joint, axis(middle)?),
            [.., both, joint] => {
                let (word, last) = both.split_at(both.char_indices().next_back()?.0);
                // `max_12` names no axis
                if word.len() > 1 && body_of_word(word).is_none() {
                    return None;
                }
                (word, joint, axis(last)?)
            }
            _ => return None,
        };
        let is_word = !word.is_empty() && word.chars().all(char::is_alphabetic);
        Some(Self { word: word.to_owned(), joint: joint.parse().ok()?, axis }).filter(|_| is_word)
    }
}

/// A value, with the line where it stands.
struct NamedScalar<'a> {
    line: usize,
    shown: &'a str,
    name: CoordinateName,
    value: Option<f64>,
    unit: Option<CellUnit>,
}

/// The value named in a line.
fn scalar(line: &str, number: usize) -> Option<NamedScalar<'_>> {
    let line = line.trim();
    let line = line.strip_prefix("#define").unwrap_or(line);
    let line = line.split(['#', '%']).next()?.split("//").next()?;
    // a comma is a decimal mark beside other separators
    let commas = !line.contains([';', '=', '\t']);
    let separates = |c: char| c.is_whitespace() || "=;:\"".contains(c) || (commas && c == ',');
    let mut cells = line.split(separates).filter(|cell| !cell.is_empty());
    let (shown, name) = cells.find_map(|cell| Some((cell, CoordinateName::of(cell)?)))?;
    let cell = cells.next()?.trim_end_matches([',', 'f']).replace(',', ".").replace('\u{2212}', "-");
    let value = cell.parse().ok().filter(|x: &f64| x.is_finite());
    Some(NamedScalar { line: number, shown, name, value, unit: cells.next().and_then(CellUnit::of) })
}

/// The joints in single values; `None` if the text has too few.
pub(super) fn read(text: &str) -> Option<Result<PointTable, InvalidPointTable>> {
    let found: Vec<NamedScalar<'_>> =
        text.lines().enumerate().filter_map(|(k, line)| scalar(line, k + 1)).collect();
    (found.len() >= FEWEST).then(|| table(&found).map_err(InvalidPointTable::Form))
}

/// The joints in the only row of a table, below their names.
pub(super) fn of_one_row(sheet: &CellTable) -> Option<Result<PointTable, InvalidPointTable>> {
    let header = sheet.header.as_ref()?;
    let [row] = &sheet.rows[..] else { return None };
    let found: Vec<NamedScalar<'_>> = header
        .iter()
        .zip(&row.cells)
        .filter_map(|(shown, cell)| {
            let name = CoordinateName::of(shown)?;
            Some(NamedScalar { line: row.line, shown, name, value: sheet.number(cell), unit: None })
        })
        .collect();
    (found.len() >= FEWEST).then(|| table(&found).map_err(InvalidPointTable::Form))
}

fn table(found: &[NamedScalar<'_>]) -> Result<PointTable, String> {
    let mut words: Vec<&str> = Vec::new();
    for scalar in found {
        if !words.contains(&scalar.name.word.as_str()) {
            words.push(&scalar.name.word);
        }
    }
    let [first, second] = words[..] else {
        return Err(format!(
            "the coordinates belong to {} bodies ({}), not to two",
            words.len(),
            words.join(", ")
        ));
    };
    let from = found.iter().map(|scalar| scalar.name.joint).min().unwrap_or(0);
    let mut values = [[[None::<f64>; 3]; 6]; 2];
    for NamedScalar { line, shown, name, value, .. } in found {
        let value = value.ok_or_else(|| format!("line {line}: `{shown}` has no number"))?;
        let joint = values[usize::from(name.word == second)].get_mut(name.joint - from);
        let place =
            &mut joint.ok_or_else(|| format!("line {line}: `{shown}` is of a seventh joint"))?[name.axis];
        if place.replace(value).is_some() {
            return Err(format!("line {line}: `{shown}` is there twice"));
        }
    }
    let flat = found.iter().all(|scalar| scalar.name.axis < 2);
    let mut points = [[Point3::origin(); 6]; 2];
    for (body, word) in [first, second].into_iter().enumerate() {
        for joint in 0..6 {
            for axis in 0..3 {
                points[body][joint][axis] = match values[body][joint][axis] {
                    Some(value) => value,
                    None if flat && axis == 2 => 0.0,
                    None => {
                        let axis = ["x", "y", "z"][axis];
                        return Err(format!("{axis} of joint {} of `{word}` is missing", joint + from));
                    }
                };
            }
        }
    }
    let mut units = found.iter().filter_map(|scalar| scalar.unit);
    let unit = units.next();
    if let (Some(unit), Some(other)) = (unit, units.find(|other| Some(*other) != unit)) {
        return Err(format!("some coordinates are in {} and some in {}", unit.word(), other.word()));
    }
    let order = bodies_of_words(first, second, &mut Vec::new());
    let mut guesses = vec![told_apart([first, second], order)];
    guesses
        .push(format!("Joints with the number N belong to leg {}.", if from == 0 { "N + 1" } else { "N" }));
    let units = match unit {
        Some(CellUnit::Length(label)) => Some(label.to_owned()),
        _ => None,
    };
    guesses.extend(units.iter().map(|unit| format!("The lengths are in {unit}, as the table says.")));
    let of = |body: Body, leg: usize| points[usize::from(order[0] != body)][leg];
    let legs =
        std::array::from_fn(|leg| Leg { base: of(Body::Base, leg), platform: of(Body::Platform, leg) });
    let mut table = PointTable { legs, names: None, units, home: None, guesses };
    table.part_frames();
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_coordinates_have_a_body_a_number_and_an_axis() {
        for name in
            ["BASE_3_X", "DEFAULT_BASE_3_X", "base[3].x", "basex3", "base_x_3", "base3x", "kins.base.3.x"]
        {
            let meant = CoordinateName { word: "base".into(), joint: 3, axis: 0 };
            assert_eq!(CoordinateName::of(name), Some(meant), "{name}");
        }
        for name in ["x", "3x", "base_x", "leg3", "base3", "max_12", "12_3_x"] {
            assert_eq!(CoordinateName::of(name), None, "{name}");
        }
    }

    #[test]
    fn single_values_are_the_joints_and_gaps_are_named() {
        let value = |body: usize, joint: usize, axis: usize| {
            (if axis < 2 { 100 * body } else { 0 } + 10 * joint + axis * axis) as f64
        };
        let listed = |line: &dyn Fn(usize, usize, usize) -> String| -> String {
            (0..36).map(|k| line(k / 18, k / 3 % 6, k % 3)).collect()
        };
        let texts = [
            listed(&|b, j, a| {
                format!(
                    "#define {}_{j}_{} {:.1}f\n",
                    ["BASE", "PLATFORM"][b],
                    ["X", "Y", "Z"][a],
                    value(b, j, a)
                )
            }),
            "[KINS]\n".to_owned()
                + &listed(&|b, j, a| {
                    format!("{}{}{} = {}\n", ["B", "P"][b], j + 1, ["x", "y", "z"][a], value(b, j, a))
                }),
            "parameter;value;unit\n".to_owned()
                + &listed(&|b, j, a| {
                    format!("{}{}{};{},0;cm\n", ["B", "P"][b], j + 1, ["x", "y", "z"][a], value(b, j, a))
                }),
        ];
        for text in &texts {
            let table = read(text).unwrap().unwrap();
            assert_eq!(table.legs[4].platform, Point3::new(140.0, 141.0, 44.0), "{text}");
            assert_eq!(table.legs[5].base, Point3::new(50.0, 51.0, 54.0));
        }
        assert_eq!(read(&texts[2]).unwrap().unwrap().units.as_deref(), Some("cm"));
        let why = |text: &str| read(text).unwrap().unwrap_err().to_string();
        assert!(why(&texts[1].replace("P4y = 131\n", "")).contains("y of joint 4 of `p` is missing"));
        assert!(why(&texts[1].replace("P4y = 131", "P4y = ten")).contains("`P4y` has no number"));
        assert!(why(&texts[2].replacen("cm", "mm", 1)).contains("some coordinates are in mm"));
        assert!(read("x = 1\nB1x = 3\n").is_none());
    }
}
