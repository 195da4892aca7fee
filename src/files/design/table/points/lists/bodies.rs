//! The joints of both bodies in lists: points by rows or columns, lists of coordinates, single points, or legs.

use nalgebra::Point3;

use crate::design::table::header::plain;
use crate::design::table::listed::ListValue;
use crate::design::table::points::InvalidPointTable;
use crate::design::table::points::polar::{angle_unit, is_angle, is_radius, on_circle};
use crate::design::table::points::words::{
    LEG_WORDS, ROW_WORDS, body_of_word, name_both_bodies, only_number, own_words,
};
use platform::manipulator::Body;

/// Joints of a body, with the names of the values in the text.
pub(super) struct ListedBody {
    pub(super) name: String,
    pub(super) points: [Point3<f64>; 6],
    pub(super) used: Vec<usize>,
}

/// The structure of the C export that begins with the joints of the base and of the platform.
pub(super) const C_EXPORT: &str = "equipod_nominal";

/// Six points, by rows or by columns.
struct SixPoints {
    points: [Point3<f64>; 6],
    by_columns: bool,
    flat: bool,
}

impl SixPoints {
    fn of(value: &ListValue) -> Option<Self> {
        // 18 numbers are six points one after another
        if let Some(list) = value.numbers().filter(|list| list.len() == 18) {
            let points = std::array::from_fn(|i| Point3::new(list[3 * i], list[3 * i + 1], list[3 * i + 2]));
            return Some(Self { points, by_columns: false, flat: false });
        }
        let rows = value.rows()?;
        let (height, width) = (rows.len(), rows[0].len());
        let by_columns = match (height, width) {
            (6, 2 | 3) => false,
            (2 | 3, 6) => true,
            _ => return None,
        };
        let at = |leg: usize, axis: usize| {
            if by_columns { rows.get(axis).map(|row| row[leg]) } else { rows[leg].get(axis).copied() }
        };
        let points = std::array::from_fn(|i| Point3::from([0, 1, 2].map(|axis| at(i, axis).unwrap_or(0.0))));
        Some(Self { points, by_columns, flat: height.min(width) == 2 })
    }
}

pub(super) fn points(
    values: &[(String, ListValue)],
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let mut found: Vec<(usize, SixPoints)> =
        values.iter().enumerate().filter_map(|(k, (_, value))| Some((k, SixPoints::of(value)?))).collect();
    if found.len() > 2 {
        // other lists may have six rows too, such as limits of the lengths
        let is_pair = |i: usize, j: usize| {
            let [first, second] = own_words([i, j].map(|k| values[k].0.as_str()));
            name_both_bodies(&first, &second)
        };
        let places: Vec<usize> = found.iter().map(|(k, _)| *k).collect();
        let pairs = places.iter().enumerate().flat_map(|(n, i)| places[..n].iter().map(move |j| [*j, *i]));
        if let [pair] = pairs.filter(|[i, j]| is_pair(*i, *j)).collect::<Vec<_>>()[..] {
            found.retain(|(k, _)| pair.contains(k));
        }
    }
    if found.len() > 2 {
        let names: Vec<String> = found.iter().map(|(k, _)| format!("`{}`", values[*k].0)).collect();
        let message = format!(
            "there are {} lists of six points, {}: leave the two of the bodies",
            found.len(),
            names.join(", ")
        );
        return Some(Err(InvalidPointTable::Form(message)));
    }
    let bodies: Vec<ListedBody> = found
        .into_iter()
        .map(|(k, six)| {
            let name = values[k].0.clone();
            if six.by_columns {
                guesses.push(format!("The columns of `{name}` are the joints of the legs."));
            }
            if six.flat {
                guesses.push(format!("`{name}` has no z: its joints are at z = 0 of their body."));
            }
            ListedBody { name, points: six.points, used: vec![k] }
        })
        .collect();
    bodies.try_into().ok().map(Ok)
}

/// A point of two or three coordinates.
fn point_of(list: &[f64]) -> Point3<f64> {
    Point3::from([0, 1, 2].map(|axis| list.get(axis).copied().unwrap_or(0.0)))
}

/// Lists of x, of y and perhaps of z for both bodies: `base_x = [..]`.
pub(super) fn coordinate_lists(values: &[(String, ListValue)]) -> Option<[ListedBody; 2]> {
    let mut bodies: Vec<(String, [Option<usize>; 3])> = Vec::new();
    for (k, (name, value)) in values.iter().enumerate() {
        if value.numbers().is_none_or(|list| list.len() != 6) {
            continue;
        }
        let word = plain(name);
        let Some(axis) = word.chars().last().and_then(|c| "xyz".find(c)) else { continue };
        let stem = word[..word.len() - 1].to_owned();
        if let Some((_, places)) = bodies.iter_mut().find(|(known, _)| *known == stem) {
            places[axis] = Some(k);
        } else {
            let mut places = [None; 3];
            places[axis] = Some(k);
            bodies.push((stem, places));
        }
    }
    let of = |(stem, places): (String, [Option<usize>; 3])| {
        let [Some(_), Some(_), _] = places else { return None };
        let list = |place: Option<usize>| place.and_then(|k| values[k].1.numbers());
        let lists = places.map(list);
        let at = |i: usize| lists.each_ref().map(|list| list.as_ref().map_or(0.0, |list| list[i]));
        let points = std::array::from_fn(|i| Point3::from(at(i)));
        Some(ListedBody { name: stem, points, used: places.into_iter().flatten().collect() })
    };
    let bodies: Vec<ListedBody> = bodies.into_iter().map(of).collect::<Option<_>>()?;
    bodies.try_into().ok()
}

/// The names of the two joints of a leg: a list of both, or an object with one for each body.
fn joint_pair(leg: &ListValue) -> Option<[String; 2]> {
    let text = |value: &ListValue| if let ListValue::Text(text) = value { Some(text.clone()) } else { None };
    match leg {
        ListValue::List(list) => match &list[..] {
            [a, b] => Some([text(a)?, text(b)?]),
            _ => None,
        },
        ListValue::Named(named) => {
            let of = |body: Body| {
                let mut own = named.iter().filter(|(name, _)| body_of_word(&plain(name)) == Some(body));
                own.find_map(|(_, value)| text(value))
            };
            Some([of(Body::Base)?, of(Body::Platform)?])
        }
        _ => None,
    }
}

/// A joint of this name: a point with the name, or an object with it in a list.
fn named_joint(
    values: &[(String, ListValue)],
    joint: &str,
    body: Body,
) -> Option<(String, usize, Point3<f64>)> {
    let coordinates = |value: &ListValue| value.place().filter(|list| (2..=3).contains(&list.len()));
    values.iter().enumerate().find_map(|(k, (name, value))| {
        let own = name.strip_suffix(joint).is_some_and(|way| way.is_empty() || way.ends_with('_'));
        let point = match value {
            ListValue::List(list) if !own && body_of_word(&plain(name)).is_none_or(|said| said == body) => {
                let item = list.iter().find(|item| item.text_of(&["name", "id", "joint"]) == Some(joint));
                item.and_then(coordinates)
            }
            _ => Some(value).filter(|_| own).and_then(coordinates),
        };
        Some((name.clone(), k, point_of(&point?)))
    })
}

/// Points with names, and six legs as pairs of these names.
pub(super) fn named_legs(
    values: &[(String, ListValue)],
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let pairs = |value: &ListValue| match value {
        ListValue::List(list) if list.len() == 6 => list.iter().map(joint_pair).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    let (at, legs) = values.iter().enumerate().find_map(|(k, (_, value))| Some((k, pairs(value)?)))?;
    let body = |end: usize| -> Result<ListedBody, InvalidPointTable> {
        let point = |leg: &[String; 2]| {
            named_joint(values, &leg[end], Body::BOTH[end]).ok_or_else(|| {
                InvalidPointTable::Form(format!(
                    "`{}` names the joint `{}`, which has no list of coordinates",
                    values[at].0, leg[end]
                ))
            })
        };
        let joints = legs.iter().map(point).collect::<Result<Vec<_>, _>>()?;
        let name = joints[0].0.chars().filter(|c| !c.is_ascii_digit()).collect();
        let used = joints.iter().map(|(_, k, _)| *k).chain([at]).collect();
        Ok(ListedBody { name, points: std::array::from_fn(|leg| joints[leg].2), used })
    };
    guesses.push(format!("The legs join the joints that `{}` names.", values[at].0));
    Some(body(0).and_then(|first| Ok([first, body(1)?])))
}

/// The two bodies as two lists of six points in one list; the structure of the C export has more behind them.
pub(super) fn both_in_one(values: &[(String, ListValue)]) -> Option<[ListedBody; 2]> {
    values.iter().enumerate().find_map(|(k, (name, value))| {
        let ListValue::List(list) = value else { return None };
        if list.len() != 2 && name != C_EXPORT {
            return None;
        }
        let of = |value: &ListValue| {
            Some(ListedBody { name: String::new(), points: SixPoints::of(value)?.points, used: vec![k] })
        };
        Some([of(list.first()?)?, of(list.get(1)?)?])
    })
}

/// A point with the number in its name and its place among the values.
type NumberedPoint = (u64, usize, Point3<f64>);

/// Single points with a number in their names: `B1 = [..]`, or the members of an object for each body.
pub(super) fn numbered_points(
    values: &[(String, ListValue)],
    guesses: &mut Vec<String>,
) -> Option<[ListedBody; 2]> {
    let mut bodies: Vec<(String, Vec<NumberedPoint>)> = Vec::new();
    for (k, (name, value)) in values.iter().enumerate() {
        let Some(list) = value.numbers().filter(|list| (2..=3).contains(&list.len())) else { continue };
        let Some(number) = only_number(name) else { continue };
        let stem: String = name.chars().filter(|c| !c.is_ascii_digit()).collect();
        let joint = (number, k, point_of(&list));
        match bodies.iter_mut().find(|(known, _)| *known == stem) {
            Some((_, joints)) => joints.push(joint),
            None => bodies.push((stem, vec![joint])),
        }
    }
    bodies.retain(|(_, joints)| joints.len() == 6);
    let numbers = |(_, joints): &mut (String, Vec<NumberedPoint>)| {
        joints.sort_by_key(|(number, ..)| *number);
        joints.iter().map(|(number, ..)| *number).collect::<Vec<_>>()
    };
    let [first, second] = &mut bodies[..] else { return None };
    let (first, second) = (numbers(first), numbers(second));
    if first != second || first.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    guesses.push("Joints with the same number are the ends of one leg.".into());
    let of = |(name, joints): (String, Vec<NumberedPoint>)| ListedBody {
        name,
        points: std::array::from_fn(|i| joints[i].2),
        used: joints.iter().map(|(_, k, _)| *k).collect(),
    };
    let bodies: Vec<ListedBody> = bodies.into_iter().map(of).collect();
    bodies.try_into().ok()
}

/// Six legs, each with its two ends.
pub(super) fn legs(values: &[(String, ListValue)], guesses: &mut Vec<String>) -> Option<[ListedBody; 2]> {
    let (k, items) = values.iter().enumerate().find_map(|(k, (_, value))| match value {
        ListValue::List(list) if list.len() == 6 && list.iter().all(|leg| leg.points().len() == 2) => {
            Some((k, list))
        }
        _ => None,
    })?;
    let number = |leg: &ListValue| {
        let ListValue::Named(named) = leg else { return None };
        named.iter().find_map(|(name, value)| {
            let name = plain(name);
            let counts =
                LEG_WORDS.contains(&name.as_str()) || ROW_WORDS.contains(&name.as_str()) || name == "name";
            match value {
                ListValue::Number(x) if counts && *x >= 0.0 && x.fract() == 0.0 => Some(*x),
                ListValue::Text(text) if counts => only_number(text).map(|n| n as f64),
                _ => None,
            }
        })
    };
    let mut order: Vec<&ListValue> = items.iter().collect();
    let numbers: Option<Vec<f64>> = items.iter().map(number).collect();
    if let Some(numbers) = numbers
        && !numbers.is_sorted()
    {
        order.sort_by(|a, b| number(a).unwrap_or(0.0).total_cmp(&number(b).unwrap_or(0.0)));
        guesses.push("The legs are put in the order of their numbers.".into());
    }
    let names = order[0].points().into_iter().map(|(name, _)| name.to_owned()).collect::<Vec<_>>();
    let same =
        order.iter().all(|leg| leg.points().iter().zip(&names).all(|((name, _), known)| name == known));
    if !same {
        return None;
    }
    let of = |end: usize| ListedBody {
        name: names[end].clone(),
        points: std::array::from_fn(|i| point_of(&order[i].points()[end].1)),
        used: vec![k],
    };
    Some([of(0), of(1)])
}

/// Two radii and two lists of six angles.
pub(super) fn polar(
    values: &[(String, ListValue)],
    text: &str,
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let angles: Vec<(usize, Vec<f64>)> = values
        .iter()
        .enumerate()
        .filter_map(|(k, (_, value))| Some((k, value.numbers().filter(|list| list.len() == 6)?)))
        .collect();
    let [(i, first), (j, second)] = &angles[..] else { return None };
    let radii: Vec<(usize, f64)> = values
        .iter()
        .enumerate()
        .filter_map(|(k, (name, value))| Some((k, value.number().filter(|_| is_radius(name))?)))
        .collect();
    let names = [values[*i].0.as_str(), values[*j].0.as_str()];
    if !names.iter().all(|name| is_angle(name)) {
        return None;
    }
    let [(k, r), (l, s)] = radii[..] else {
        let message = format!(
            "`{}` and `{}` are six angles each, and two radii are needed beside them, not {}",
            names[0],
            names[1],
            radii.len()
        );
        return Some(Err(InvalidPointTable::Form(message)));
    };
    // a radius belongs to the angles of the same body, otherwise both are in the same order
    let said = |name: &str| body_of_word(&plain(name));
    let crossed = matches!((said(names[0]), said(&values[k].0)), (Some(x), Some(y)) if x != y);
    let pairs = if crossed { [(s, l), (r, k)] } else { [(r, k), (s, l)] };
    let degrees = match angle_unit(names, text, first.iter().chain(second)) {
        Ok(degrees) => degrees,
        Err(why) => return Some(Err(InvalidPointTable::Form(why))),
    };
    guesses.push(format!(
        "`{}` and `{}` are angles in {}, counted from x towards y.",
        names[0],
        names[1],
        if degrees { "degrees" } else { "radians" }
    ));
    let body = |index: usize, list: &[f64], (radius, at): (f64, usize)| ListedBody {
        name: values[index].0.clone(),
        points: std::array::from_fn(|leg| on_circle(radius, list[leg], degrees)),
        used: vec![index, at],
    };
    Some(Ok([body(*i, first, pairs[0]), body(*j, second, pairs[1])]))
}
