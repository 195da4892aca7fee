//! Points by a radius and an angle: their words, and tables with columns of them.

use nalgebra::Point3;

use super::InvalidPointTable;
use super::words::body_of_word;
use crate::design::table::header::{length_unit, plain};
use crate::design::table::sheet::CellTable;
use platform::manipulator::Body;

/// Words for a radius.
const RADIUS_WORDS: [&str; 3] = ["radius", "halbmesser", "rayon"];

/// Words for a diameter.
const DIAMETER_WORDS: [&str; 2] = ["diameter", "durchmesser"];

/// Whether a name is that of a diameter.
fn is_diameter(name: &str) -> bool {
    DIAMETER_WORDS.iter().any(|word| plain(name).contains(word))
}

/// Whether a name is that of a radius.
pub(super) fn is_radius(name: &str) -> bool {
    let name = plain(name);
    RADIUS_WORDS.iter().any(|word| name.contains(word))
        || name.contains("radii")
        || ["r", "rb", "rp", "rt", "br", "pr", "tr"].contains(&name.as_str())
}

/// Whether a name is that of an angle.
pub(super) fn is_angle(name: &str) -> bool {
    let name = plain(name);
    ["angle", "theta", "phi", "azimut", "deg", "winkel"].iter().any(|word| name.contains(word))
}

/// The unit of angles, from their names, a comment, or a value above 6.3. Otherwise it is the reason why the unit is
/// unknown.
pub(super) fn angle_unit<'a>(
    names: [&str; 2],
    text: &str,
    mut angles: impl Iterator<Item = &'a f64>,
) -> Result<bool, String> {
    let said = |text: &str| {
        let text = text.to_lowercase();
        let words = |words: &[&str]| {
            text.split(|c: char| !(c.is_alphabetic() || c == '\u{b0}')).any(|part| words.contains(&part))
        };
        let degrees = words(&["deg", "degree", "degrees", "grad", "\u{b0}"]);
        match (degrees, words(&["rad", "radian", "radians"])) {
            (true, false) => Some(true),
            (false, true) => Some(false),
            _ => None,
        }
    };
    match said(&names.join(" ")).or_else(|| said(text)) {
        Some(degrees) => Ok(degrees),
        None if angles.any(|x| x.abs() > std::f64::consts::TAU) => Ok(true),
        None => Err("the angles may be degrees or radians: say which in a name or in a comment".into()),
    }
}

/// The point of a circle about z at an angle from x towards y.
pub(super) fn on_circle(radius: f64, angle: f64, degrees: bool) -> Point3<f64> {
    let (sin, cos) = if degrees { angle.to_radians() } else { angle }.sin_cos();
    Point3::new(radius * cos, radius * sin, 0.0)
}

/// Replaces columns of radii and angles, if the header has any, by x and y.
///
/// # Errors
/// A radius without an angle, an angle without a radius, or angles of unknown unit.
pub(super) fn to_coordinates(
    sheet: &mut CellTable,
    text: &str,
    guesses: &mut Vec<String>,
) -> Result<(), InvalidPointTable> {
    let Some(header) = sheet.header.clone() else { return Ok(()) };
    let columns = |accepts: fn(&str) -> bool| -> Vec<usize> {
        (0..header.len()).filter(|c| accepts(&header[*c])).collect()
    };
    let (radii, angles) = (columns(|name| is_radius(name) || is_diameter(name)), columns(is_angle));
    if radii.is_empty() && angles.is_empty() {
        return Ok(());
    }
    let refused = |message: String| Err(InvalidPointTable::Form(message));
    if radii.len() != angles.len() || radii.len() > 2 {
        let listed = |list: &[usize]| {
            let names: Vec<String> = list.iter().map(|c| format!("`{}`", header[*c])).collect();
            if names.is_empty() { "none".into() } else { names.join(", ") }
        };
        return refused(format!(
            "a point has a radius and an angle: the columns of radii are {}, those of angles {}",
            listed(&radii),
            listed(&angles)
        ));
    }
    let body = |c: usize| -> Option<Body> { body_of_word(&plain(&header[c])) };
    let mut open = angles;
    for radius in radii {
        // angles of unnamed bodies stand in the order of their radii
        let Some(at) = open.iter().position(|c| body(*c) == body(radius)) else {
            return refused(format!("the radius `{}` has no angle of the same body", header[radius]));
        };
        pair(sheet, text, [radius, open.remove(at)], guesses)?;
    }
    Ok(())
}

/// One radius with its angle.
fn pair(
    sheet: &mut CellTable,
    text: &str,
    [radius, angle]: [usize; 2],
    guesses: &mut Vec<String>,
) -> Result<(), InvalidPointTable> {
    let mut read = Vec::new();
    for row in &sheet.rows {
        let number = |c: usize| row.cells.get(c).and_then(|cell| sheet.number(cell));
        read.push(number(radius).zip(number(angle)));
    }
    let turns: Vec<f64> = read.iter().flatten().map(|(_, turn)| *turn).collect();
    let Some(header) = &mut sheet.header else { return Ok(()) };
    let names = [header[radius].clone(), header[angle].clone()];
    let degrees = angle_unit([&names[1], &names[1]], text, turns.iter()).map_err(InvalidPointTable::Form)?;
    let half = is_diameter(&names[0]);
    guesses.push(format!(
        "`{}` is a {} and `{}` its angle in {}, counted from x towards y.",
        names[0],
        if half { "diameter" } else { "radius" },
        names[1],
        if degrees { "degrees" } else { "radians" }
    ));
    // the name of the radius gives body and unit of the coordinates
    let renamed = |axis: &str| {
        let lower = names[0].to_lowercase();
        let word = RADIUS_WORDS.iter().chain(&DIAMETER_WORDS).find_map(|w| Some((lower.find(w)?, w.len())));
        let plain = plain(&names[0]);
        let letter = plain.trim_start_matches('r').trim_end_matches('r');
        let unit = length_unit(&names[0]).map_or_else(String::new, |unit| format!(" [{unit}]"));
        match word {
            Some((at, length)) if lower.len() == names[0].len() => {
                format!("{}{axis}{}", &names[0][..at], &names[0][at + length..])
            }
            Some(_) => format!("{axis}{unit}"),
            None => format!("{letter}{axis}{unit}"),
        }
    };
    (header[radius], header[angle]) = (renamed("x"), renamed("y"));
    for (k, values) in read.into_iter().enumerate() {
        let Some((radius_of, turn)) = values else { continue };
        let at = on_circle(if half { radius_of / 2.0 } else { radius_of }, turn, degrees);
        let [x, y] = [at.x, at.y].map(|x| sheet.shown(x));
        (sheet.rows[k].cells[radius], sheet.rows[k].cells[angle]) = (x, y);
    }
    Ok(())
}
