//! The twelve joint centres in lists of source code, with their units and the home pose.

mod bodies;
mod objects;

use self::bodies::ListedBody;
pub(super) use self::objects::read as read_objects;
use super::words::{FIRST_WITH_FIRST, bodies_of_words, name_both_bodies, own_words, told_apart};
use super::{InvalidPointTable, PointTable};
use crate::design::table::header::plain;
use crate::design::table::listed::{ListValue, NamedValues, named_values, stated_units};
use crate::design::table::sheet::is_list;
use platform::geom::{Angles, Pose, PoseConvention, QuaternionOrder};
use platform::manipulator::{Body, Leg};

/// The twelve ends in lists; `None` if the text has no two named lists of six points or angles, or if formulas compute
/// some of its values and the names do not tell the bodies.
pub(super) fn read(text: &str) -> Option<Result<PointTable, InvalidPointTable>> {
    let mut guesses = Vec::new();
    let Some(NamedValues { values, computed }) = named_values(text, &mut guesses) else {
        return is_list(text).then_some(Err(InvalidPointTable::Computed));
    };
    let in_export = values.iter().any(|(name, _)| name == bodies::C_EXPORT);
    let exported = in_export.then(|| bodies::both_in_one(&values)).flatten();
    let bodies = exported
        .map(Ok)
        .or_else(|| bodies::named_legs(&values, &mut guesses))
        .or_else(|| bodies::points(&values, &mut guesses))
        .or_else(|| bodies::coordinate_lists(&values).map(Ok))
        .or_else(|| bodies::numbered_points(&values, &mut guesses).map(Ok))
        .or_else(|| bodies::legs(&values, &mut guesses).map(Ok))
        .or_else(|| bodies::both_in_one(&values).map(Ok))
        .or_else(|| bodies::polar(&values, text, &mut guesses));
    let Some(bodies) = bodies else {
        return (!computed.is_empty() && is_list(text)).then_some(Err(InvalidPointTable::Computed));
    };
    if !computed.is_empty() {
        if let Ok([first, second]) = &bodies
            && !first.name.is_empty()
        {
            let [first, second] = own_words([&first.name, &second.name]);
            name_both_bodies(&first, &second).then_some(())?;
        }
        guesses.push(format!("Not computed: `{}`.", computed.join("`, `")));
    }
    Some(bodies.map(|bodies| table(&bodies, &values, text, guesses)))
}

/// Names of the height of the platform above the base.
const HEIGHTS: [&str; 8] = ["height", "h", "z0", "home", "homeheight", "h0", "zhome", "homez"];

/// Names of the rotation of the platform at home.
const ROTATIONS: [&str; 5] = ["r", "r0", "rot", "rotation", "orientation"];

/// The rotation matrix of a value with such a name, or its quaternion if the name says the order, in a pose.
fn rotation(word: &str, value: &ListValue) -> Option<Pose> {
    let order = QuaternionOrder::ALL.into_iter().find(|order| word.ends_with(order.name()));
    if let (Some(_), Some(quaternion)) = (order, value.numbers().filter(|list| list.len() == 4)) {
        let numbers: Vec<f64> = [0.0; 3].into_iter().chain(quaternion).collect();
        let convention = PoseConvention { quaternion: order, ..PoseConvention::default() };
        return convention.read(&numbers, &Pose::identity()).ok();
    }
    if !ROTATIONS.iter().any(|name| word == *name || (name.len() > 2 && word.ends_with(name))) {
        return None;
    }
    let rows = value.rows().filter(|rows| rows.len() == 3 && rows[0].len() == 3)?;
    let matrix: Vec<f64> = rows.iter().flat_map(|row| row.iter().copied().chain([0.0])).collect();
    PoseConvention::default().read(&matrix, &Pose::identity()).ok()
}

/// A rotation matrix and a position in one list whose name ends in `home`.
fn home_pose(word: &str, value: &ListValue) -> Option<Pose> {
    let ListValue::List(parts) = value else { return None };
    let [turn, position] = &parts[..] else { return None };
    let [x, y, z] = position.numbers().filter(|_| word.ends_with("home"))?[..] else { return None };
    Some(Pose { position: [x, y, z].into(), ..rotation("rotation", turn)? })
}

fn table(
    bodies: &[ListedBody; 2],
    values: &[(String, ListValue)],
    text: &str,
    mut guesses: Vec<String>,
) -> PointTable {
    let [first, second] = bodies;
    let [word, other] = own_words([&first.name, &second.name]);
    let order = bodies_of_words(&word, &other, &mut Vec::new());
    guesses.push(if first.name.is_empty() {
        "The first point of a leg is the one of the base.".into()
    } else {
        told_apart([&first.name, &second.name], order)
    });
    let (base, platform) = if order[0] == Body::Base { (first, second) } else { (second, first) };
    if !first.used.iter().any(|k| second.used.contains(k))
        && !guesses.iter().any(|g| g.contains("same number"))
    {
        guesses.push(FIRST_WITH_FIRST.into());
    }
    let mut used: Vec<usize> = bodies.iter().flat_map(|body| body.used.iter().copied()).collect();
    let mut home: Option<Pose> = None;
    let mut turn = None;
    for (k, (name, value)) in values.iter().enumerate() {
        let word = plain(name.rsplit('.').next().unwrap_or(name));
        let vector = value.numbers().filter(|list| list.len() == 3);
        let position = match (value.number(), vector) {
            (Some(z), _)
                if HEIGHTS.contains(&word.as_str())
                    || ["height", "homez"].iter().any(|end| word.ends_with(end)) =>
            {
                Some([0.0, 0.0, z])
            }
            (_, Some(p)) => Some([p[0], p[1], p[2]]),
            _ => None,
        };
        if let Some(position) = position.filter(|_| home.is_none() && !used.contains(&k)) {
            let [x, y, z] = position;
            guesses
                .push(format!("`{name}` is the place of the platform at home: x = {x}, y = {y}, z = {z}."));
            home = Some(Pose::new(position, Angles::default()));
            used.push(k);
        }
        if let Some(pose) = home_pose(&word, value).filter(|_| home.is_none()) {
            guesses.push(format!("`{name}` is the rotation and the position of the platform at home."));
            home = Some(pose);
            used.push(k);
        }
        if let Some(pose) = rotation(&word, value).filter(|_| turn.is_none()) {
            turn = Some((k, pose.rotation));
        }
    }
    if let (Some(home), Some((k, rotation))) = (&mut home, turn) {
        guesses.push(format!("`{}` is the rotation of the platform at home.", values[k].0));
        home.rotation = rotation;
        used.push(k);
    }
    let (units, _, guess) = stated_units(values, text);
    guesses.extend(guess);
    let unread: Vec<String> = values
        .iter()
        .enumerate()
        .filter(|(k, (_, value))| !used.contains(k) && !matches!(value, ListValue::Text(_)))
        .map(|(_, (name, _))| format!("`{name}`"))
        .collect();
    if !unread.is_empty() {
        guesses.push(format!("Not read: {}.", unread.join(", ")));
    }
    let mut table = PointTable {
        legs: std::array::from_fn(|i| Leg { base: base.points[i], platform: platform.points[i] }),
        names: None,
        units: units.map(String::from),
        home,
        guesses,
    };
    if table.home.is_none() {
        table.part_frames();
    }
    table
}

#[cfg(test)]
mod tests;
