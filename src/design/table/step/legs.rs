//! Legs out of spheres and cylinders, and which ends are those of the base.

use std::collections::BTreeMap;

use nalgebra::{Point3, Rotation3, Vector3};

use super::SAME;
use super::assembly::{Named, PartAssembly};
use crate::design::table::header::plain;
use crate::design::table::placed::{extent, order_of, trailing_number};
use crate::design::table::points::body_of_word;
use crate::geom::Pose;
use crate::manipulator::Body;

/// The legs of an assembly.
pub(super) struct StepLegs {
    /// Base end and platform end, frame of the assembly, millimetres, in leg order.
    pub(super) ends: [[Point3<f64>; 2]; 6],
    /// The platform frame, millimetres.
    pub(super) home: Pose,
    /// Names of the occurrences of the balls of base and platform.
    pub(super) names: Option<[[String; 6]; 2]>,
    pub(super) guesses: Vec<String>,
}

/// A joint centre with the names of the part whose sphere was found first.
type Centre<'a> = &'a Named<Point3<f64>>;

/// A pair of centres with the names of the first cylinder between them.
struct Pair<'a> {
    centres: [usize; 2],
    names: &'a [String],
}

/// Spheres at the same place are one centre.
fn centres(assembly: &PartAssembly, near: f64) -> Vec<Centre<'_>> {
    let mut found: Vec<Centre<'_>> = Vec::new();
    for sphere in &assembly.spheres {
        if found.iter().all(|c| !((c.shape - sphere.shape).norm() <= near)) {
            found.push(sphere);
        }
    }
    found
}

/// Pairs of centres with a cylinder between them.
fn pairs<'a>(assembly: &'a PartAssembly, centres: &[Centre<'a>], near: f64) -> Result<Vec<Pair<'a>>, String> {
    let mut found: BTreeMap<[usize; 2], (usize, Pair<'a>)> = BTreeMap::new();
    for (number, cylinder) in assembly.cylinders.iter().enumerate() {
        let shape = &cylinder.shape;
        let mut on_axis: Vec<(f64, usize)> = Vec::new();
        for (k, centre) in centres.iter().enumerate() {
            let d = centre.shape - shape.on_axis;
            let along = d.dot(&shape.axis);
            if (d - shape.axis * along).norm() <= near {
                on_axis.push((along, k));
            }
        }
        let split = |middle: Point3<f64>| {
            let at = (middle - shape.on_axis).dot(&shape.axis);
            let (below, above): (Vec<_>, Vec<_>) = on_axis.iter().partition(|(along, _)| *along < at);
            (below, above)
        };
        let pair = match shape.middle.map(split) {
            None => match on_axis[..] {
                [(_, a), (_, b)] => [a, b],
                _ => continue,
            },
            Some((below, above)) => match (&below[..], &above[..]) {
                ([], _) | (_, []) => continue,
                ([(_, a)], [(_, b)]) => [*a, *b],
                _ => {
                    let name =
                        cylinder.names.iter().find(|n| !n.is_empty()).map_or("a cylinder", String::as_str);
                    return Err(format!(
                        "the axis of `{name}` passes through {} centres of spheres: two of them have to be the ends of a leg, and which is not said",
                        below.len() + above.len()
                    ));
                }
            },
        };
        let key = [pair[0].min(pair[1]), pair[0].max(pair[1])];
        found.entry(key).or_insert((number, Pair { centres: key, names: &cylinder.names }));
    }
    let mut found: Vec<(usize, Pair<'a>)> = found.into_values().collect();
    found.sort_by_key(|(number, _)| *number);
    Ok(found.into_iter().map(|(_, pair)| pair).collect())
}

/// Axes of the assembly along which the platform may be above the base, the usual one first.
const UP: [(&str, usize); 3] = [("z", 2), ("y", 1), ("x", 0)];

/// The number of the axis along which all platform ends are above all base ends, and which centre of each pair is the lower.
fn by_height(pairs: &[Pair<'_>], centres: &[Centre<'_>]) -> Option<(usize, Vec<[usize; 2]>)> {
    UP.iter().find_map(|(_, axis)| {
        let height = |k: usize| centres[k].shape[*axis];
        let ordered: Vec<[usize; 2]> = pairs
            .iter()
            .map(|p| {
                if height(p.centres[0]) < height(p.centres[1]) {
                    p.centres
                } else {
                    [p.centres[1], p.centres[0]]
                }
            })
            .collect();
        let highest = ordered.iter().map(|p| height(p[0])).fold(f64::NEG_INFINITY, f64::max);
        let lowest = ordered.iter().map(|p| height(p[1])).fold(f64::INFINITY, f64::min);
        (highest < lowest).then_some((*axis, ordered))
    })
}

/// By the names of the parts: one end of each leg is of the base and the other of the platform.
fn by_names(pairs: &[Pair<'_>], centres: &[Centre<'_>]) -> Option<Vec<[usize; 2]>> {
    let said = |k: usize| centres[k].names.iter().find_map(|name| body_of_word(&plain(name)));
    let ordered = |p: &Pair<'_>| match p.centres.map(said) {
        [Some(Body::Base), Some(Body::Platform)] => Some(p.centres),
        [Some(Body::Platform), Some(Body::Base)] => Some([p.centres[1], p.centres[0]]),
        _ => None,
    };
    pairs.iter().map(ordered).collect()
}

/// The order of legs by numbers in the names of their cylinders: of the parts, else of the occurrences, else of the assemblies.
fn numbered(pairs: &[Pair<'_>]) -> Option<Vec<usize>> {
    let levels = pairs.iter().map(|p| p.names.len()).min().unwrap_or(0);
    (0..levels).find_map(|level| {
        let numbers: Vec<Option<u64>> = pairs.iter().map(|p| trailing_number(&p.names[level])).collect();
        order_of(&numbers)
    })
}

impl StepLegs {
    /// Finds the legs; `home` in millimetres where the file says it.
    ///
    /// # Errors
    /// Not six legs, ends on an axis that cannot be told apart, bodies that cannot be.
    pub(super) fn of(assembly: &PartAssembly, home: Option<Pose>) -> Result<Self, String> {
        let near = SAME * extent(assembly.spheres.iter().map(|s| &s.shape));
        let centres = centres(assembly, near);
        let mut pairs = pairs(assembly, &centres, near)?;
        if pairs.len() != 6 {
            return Err(format!(
                "{} cylinders lead from the centre of a sphere to that of another, and six have to; the file has {} centres of spheres and {} cylinders",
                pairs.len(),
                centres.len(),
                assembly.cylinders.len()
            ));
        }
        let mut guesses = Vec::new();
        if let Some(order) = numbered(&pairs) {
            guesses.push("The legs are in the order of the numbers in the names of their parts.".to_string());
            let mut places: Vec<Option<Pair<'_>>> = pairs.into_iter().map(Some).collect();
            pairs = order.into_iter().filter_map(|k| places[k].take()).collect();
        } else {
            guesses.push("The legs are in the order in which their cylinders stand in the file.".into());
        }
        let (named, high) = (by_names(&pairs, &centres), by_height(&pairs, &centres));
        let axis = high.as_ref().map_or(2, |(axis, _)| *axis);
        let ordered = match (named, high) {
            (Some(ordered), _) => {
                guesses.push(
                    "The names of the parts say which balls are of the base and which of the platform."
                        .into(),
                );
                ordered
            }
            (None, Some((axis, ordered))) => {
                let letter = UP.iter().find(|(_, k)| *k == axis).map_or("z", |(letter, _)| *letter);
                guesses
                    .push(format!("The platform is what is above along {letter}, the base what is below."));
                ordered
            }
            (None, None) => {
                return Err("which ends are of the base and which of the platform is not said: no axis has all of one above the others, and the names of the parts do not say it".into());
            }
        };
        let bodies = [0, 1].map(|side: usize| ordered.iter().map(|p| p[side]).collect::<Vec<usize>>());
        if bodies[0].iter().any(|k| bodies[1].contains(k)) {
            return Err("a ball is at the upper end of one leg and at the lower end of another".into());
        }
        let all: Vec<[Point3<f64>; 2]> = ordered.iter().map(|p| p.map(|k| centres[k].shape)).collect();
        let names = [0, 1].map(|side: usize| {
            let name = |k: &usize| centres[*k].names.get(1).cloned().unwrap_or_default();
            bodies[side].iter().map(name).collect::<Vec<String>>()
        });
        let names = match names.map(<[String; 6]>::try_from) {
            [Ok(base), Ok(platform)] => Some([base, platform]),
            _ => None,
        };
        let ends: [[Point3<f64>; 2]; 6] = all.try_into().map_err(|_| "there are not six legs")?;
        let home = if let Some(home) = home {
            guesses.push("Home is the pose of the platform frame in the header.".into());
            home
        } else {
            let mut position = Vector3::zeros();
            position[axis] = ends.iter().map(|e| e[1][axis]).sum::<f64>() / 6.0;
            guesses.push("Base frame: that of the file. Home: the platform as it is drawn, its frame parallel to that of the file at the mean height of its joints.".into());
            Pose { rotation: Rotation3::identity(), position }
        };
        Ok(Self { ends, home, names, guesses })
    }
}
