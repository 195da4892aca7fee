//! The columns of poses that names tell.

use super::InvalidSeries;
use super::names::{angle_unit_of, without_angle_units};
use platform::geom::{AngleUnit, ListedFrom, PoseConvention, RotationOrder};

/// Names of the turn about x, in several languages.
const ROLL_WORDS: [&str; 7] = ["roll", "rollen", "rollwinkel", "wanken", "roulis", "alabeo", "rollio"];

/// Names of the turn about y.
const PITCH_WORDS: [&str; 8] =
    ["pitch", "nick", "nicken", "nickwinkel", "stampfen", "tangage", "cabeceo", "beccheggio"];

/// Names of the turn about z.
const YAW_WORDS: [&str; 8] =
    ["yaw", "gier", "gieren", "gierwinkel", "lacet", "gui\u{f1}ada", "guinada", "imbardata"];

/// The columns of poses that names tell.
pub(super) struct NamedPose {
    /// Position, then angles or the quaternion, in the order of the convention.
    pub(super) columns: Vec<usize>,
    /// The convention, with what the names add to it.
    pub(super) frames: PoseConvention,
    /// Columns in radians among others in degrees.
    pub(super) radians: Vec<usize>,
    pub(super) guesses: Vec<String>,
}

/// Greatest number of columns that are compared with each other.
const MOST_COLUMNS: usize = 2000;

/// The columns of nine entries `r11` to `r33`, or `r00` to `r22`, row by row. The second part is the fourth column, if
/// it is named so.
fn matrix_columns(header: &[String]) -> Option<([usize; 9], Option<[usize; 3]>)> {
    let words: Vec<String> = header
        .iter()
        .map(|name| name.chars().filter(|c| c.is_alphanumeric()).collect::<String>().to_lowercase())
        .collect();
    let heads = words.iter().filter_map(|word| word.strip_suffix("11"));
    let column = |head: &str, i: usize, j: usize| {
        words.iter().position(|word| word.strip_prefix(head).is_some_and(|tail| tail == format!("{i}{j}")))
    };
    let of = |head: &str, from: usize| -> Option<([usize; 9], Option<[usize; 3]>)> {
        let mut nine = [0; 9];
        for (k, place) in nine.iter_mut().enumerate() {
            *place = column(head, k / 3 + from, k % 3 + from)?;
        }
        let fourth = [0, 1, 2].map(|i| column(head, i + from, 3 + from));
        let [x, y, z] = fourth;
        Some((nine, x.zip(y).zip(z).map(|((x, y), z)| [x, y, z])))
    };
    heads
        .filter(|head| head.chars().all(char::is_alphabetic))
        .find_map(|head| of(head, 1).or_else(|| of(head, 0)))
}

/// The columns of x, y and z with those of the angles, or of the quaternion; `None` where names tell no pose.
///
/// # Errors
/// Angles in an order that neither names nor the convention tell.
pub(super) fn named_pose(
    header: &[String],
    names: &[String],
    stated: &PoseConvention,
) -> Result<Option<NamedPose>, InvalidSeries> {
    if names.len() > MOST_COLUMNS {
        return Ok(None);
    }
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
    if let Some((rotation, position)) = matrix_columns(header)
        && let Some(position) = position.or(usual)
    {
        let columns =
            (0..3).flat_map(|i| [0, 1, 2].map(|j| rotation[3 * i + j]).into_iter().chain([position[i]]));
        return Ok(Some(NamedPose {
            columns: columns.collect(),
            frames: *stated,
            radians: Vec::new(),
            guesses: vec![
                "The columns are entries of rotation matrices, the number of the row first.".into(),
            ],
        }));
    }
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
        ["r", "rot", "rvec", "theta", "phi", "angle", "angles", "ang", "tilt"].contains(*stem)
            || ["rotation", "orientation", "euler", "attitude"].iter().any(|end| stem.ends_with(end))
    };
    let rotations = stems.iter().filter(is_rotation).find_map(|stem| with_stem(stem).1);
    if let (None, Some([w, x, y, z])) = (roll, by_stem.or_else(by_units).or_else(by_number)) {
        if by_stem.is_none() && by_units().is_none() {
            guesses.push("`q0` is the scalar part of the quaternion.".into());
        }
        columns.extend(frames.quaternion_order().written([w, x, y, z]));
        return Ok(Some(NamedPose { columns, frames, radians, guesses }));
    }
    // letters of other conventions too, so that a stated order takes the columns as they stand
    let greek = by_words([&["phi"], &["theta"], &["psi"]]).filter(|_| stated.rotation_order.is_none());
    if roll.is_none() && greek.is_some() {
        guesses.push("`phi`, `theta` and `psi` are roll, pitch and yaw.".into());
    }
    let roll = roll.or(greek);
    let Some(about) = roll.or(uvw).or(rotations) else {
        // A is a turn about x for some makers and about z for others
        let letters = by_words([&["a"], &["b"], &["c"]])
            .or_else(|| by_words([&["alpha"], &["beta"], &["gamma"]]))
            .filter(|_| stated.rotation_order.is_none());
        return match letters {
            Some(letters) => Err(InvalidSeries::Order(letters.map(|c| header[c].as_str()).join(", "))),
            None => Ok(None),
        };
    };
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
