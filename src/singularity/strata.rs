//! The nearest designs in which joints meet or line up so that no pose is held, in closed form.

use nalgebra::{Matrix3, Point3, Vector3};

use super::nearest::Change;
use crate::manipulator::Manipulator;
use crate::num::small::symmetric_eigen3;
use crate::synthesis::Body;

/// The nearest member of each simple family: coincident legs, four legs at one point, two points that hold all legs, a collinear body,
/// three legs of a pencil, a bundle and a pencil with a common line.
///
/// Each is the least change within its family: points that have to meet meet in their centroid, points that have to line up go
/// to the line through their centroid along the principal axis.
pub(super) fn changes(m: &Manipulator) -> Vec<Change> {
    let mut found = Vec::new();
    let bodies = [Body::Base, Body::Platform];
    for set in (1u8..64).map(members) {
        let rest: Vec<usize> = (0..6).filter(|i| !set.contains(i)).collect();
        if set.len() == 2 {
            let mut change = still(m, "coincident_legs", &set);
            for body in bodies {
                meet(m, &mut change, body, &set);
            }
            found.push(change);
        }
        for body in bodies {
            if set.len() == 4 {
                let mut change = still(m, "concurrent_four", &set);
                meet(m, &mut change, body, &set);
                found.push(change);
            }
            if set.len() == 3 {
                let mut change = still(m, "point_line", &set);
                meet(m, &mut change, body, &set);
                line_up(m, &mut change, opposite(body), &each(m, opposite(body), &set));
                found.push(change);
                stars_and_pencils(m, body, &set, &rest, &mut found);
                for other in bodies {
                    let mut change = still(m, "two_joints_hold_all_legs", &[0, 1, 2, 3, 4, 5]);
                    meet(m, &mut change, body, &set);
                    meet_again(m, &mut change, other, &rest);
                    found.push(change);
                }
            }
            if set.len() == 6 {
                let mut change = still(m, "all_collinear", &set);
                line_up(m, &mut change, body, &each(m, body, &set));
                found.push(change);
            }
        }
    }
    found
}

fn members(mask: u8) -> Vec<usize> {
    (0..6).filter(|i| mask >> i & 1 == 1).collect()
}

fn opposite(body: Body) -> Body {
    if body == Body::Base { Body::Platform } else { Body::Base }
}

fn still(m: &Manipulator, kind: &'static str, legs: &[usize]) -> Change {
    let none = |joints: &[Point3<f64>]| vec![Vector3::zeros(); joints.len()];
    let (base, platform) = (none(m.base_joints()), none(m.platform_joints()));
    Change { kind, legs: legs.to_vec(), coefficients: None, base, platform }
}

/// The joints of `body` at which `legs` end, each once.
fn joints(m: &Manipulator, body: Body, legs: &[usize]) -> Vec<usize> {
    let pairs = m.pairs();
    let mut list: Vec<usize> =
        legs.iter().map(|i| if body == Body::Base { pairs[*i].0 } else { pairs[*i].1 }).collect();
    list.sort_unstable();
    list.dedup();
    list
}

fn places(m: &Manipulator, body: Body) -> &[Point3<f64>] {
    if body == Body::Base { m.base_joints() } else { m.platform_joints() }
}

fn displacements(change: &mut Change, body: Body) -> &mut Vec<Vector3<f64>> {
    if body == Body::Base { &mut change.base } else { &mut change.platform }
}

/// Moves the ends of `legs` to their centroid.
fn meet(m: &Manipulator, change: &mut Change, body: Body, legs: &[usize]) {
    let (list, at) = (joints(m, body, legs), places(m, body));
    let mean = list.iter().map(|j| at[*j].coords).sum::<Vector3<f64>>() / list.len() as f64;
    for j in list {
        displacements(change, body)[j] = mean - at[j].coords;
    }
}

/// As [`meet`], where joints of `body` may have been moved already: a joint in both sets makes the two points one.
fn meet_again(m: &Manipulator, change: &mut Change, body: Body, legs: &[usize]) {
    let list = joints(m, body, legs);
    let moved = |j: &usize, change: &mut Change| displacements(change, body)[*j].norm_squared() > 0.0;
    if list.iter().any(|j| moved(j, change)) {
        let all: Vec<usize> = (0..6).collect();
        meet(m, change, body, &all);
    } else {
        meet(m, change, body, legs);
    }
}

/// Moves the ends of each group to one point, and these points to a line: the line through the weighted centroid along the principal axis
/// leaves the least change.
fn line_up(m: &Manipulator, change: &mut Change, body: Body, groups: &[Vec<usize>]) {
    let at = places(m, body);
    let groups: Vec<Vec<usize>> = groups.iter().map(|g| joints(m, body, g)).collect();
    let centre =
        |group: &Vec<usize>| group.iter().map(|j| at[*j].coords).sum::<Vector3<f64>>() / group.len() as f64;
    let weight: f64 = groups.iter().map(|g| g.len() as f64).sum();
    let mean = groups.iter().map(|g| centre(g) * g.len() as f64).sum::<Vector3<f64>>() / weight;
    let term = |g: &Vec<usize>| (centre(g) - mean) * (centre(g) - mean).transpose() * g.len() as f64;
    let scatter: Matrix3<f64> = groups.iter().map(term).sum();
    let (values, vectors) = symmetric_eigen3(&scatter);
    let axis = vectors.column(values.imax()).into_owned();
    for group in &groups {
        let place = mean + axis * axis.dot(&(centre(group) - mean));
        for j in group {
            displacements(change, body)[*j] = place - at[*j].coords;
        }
    }
}

/// One group a joint of `body` at which `legs` end.
fn each(m: &Manipulator, body: Body, legs: &[usize]) -> Vec<Vec<usize>> {
    let mut seen = Vec::new();
    legs.iter()
        .filter_map(|i| {
            let joint = joints(m, body, &[*i]);
            let new = !seen.contains(&joint);
            seen.push(joint);
            new.then(|| vec![*i])
        })
        .collect()
}

/// Three legs from one point of `body`, two of the others from one point of the other body to a line through it.
fn stars_and_pencils(m: &Manipulator, body: Body, star: &[usize], rest: &[usize], found: &mut Vec<Change>) {
    for skipped in rest {
        let pair: Vec<usize> = rest.iter().copied().filter(|i| i != skipped).collect();
        let mut legs: Vec<usize> = star.iter().chain(&pair).copied().collect();
        legs.sort_unstable();
        let at_star = joints(m, body, star);
        if pair.iter().any(|i| at_star.contains(&joints(m, body, &[*i])[0])) {
            continue; // four legs at one point: another family
        }
        let mut change = still(m, "star_and_pencil", &legs);
        let mut groups = each(m, body, &pair);
        groups.push(star.to_vec());
        line_up(m, &mut change, body, &groups);
        meet(m, &mut change, opposite(body), &pair);
        found.push(change);
    }
}
