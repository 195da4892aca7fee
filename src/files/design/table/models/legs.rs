//! Six legs in a kinematic tree: slides between joints at one point on either side, or tendons from site to site.
//!
//! Without its six slides the graph of rigid groups and joints has two pieces: base and platform, each with one part of
//! every leg. The ball joints and hinge axes between a slide and the base (or platform) must share a point: the end of
//! the leg. Hinges and bodies may form a universal or ball joint in any order. Either part of a leg may carry the
//! slide, in either direction.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use nalgebra::{Matrix3, Point3, Vector3};

use super::graph::{JointKind, Mechanism, ModelJoint, WORLD};
use crate::design::table::placed::{extent, order_of, trailing_number};

/// Points and axes of joints within this times the size of the end of a leg go through it.
pub(super) const SAME_POINT: f64 = 1e-9;

/// Greatest distance of joints at the end of a leg, over the size: models are often written with six digits.
const ROUNDED_POINT: f64 = 1e-5;

/// The legs of a model.
#[derive(Debug)]
pub(super) struct ModelLegs {
    /// Base end and platform end, base frame, in leg order.
    pub(super) ends: [[Point3<f64>; 2]; 6],
    /// The group of the platform.
    pub(super) platform: usize,
    pub(super) guesses: Vec<String>,
}

/// A leg without its place in the order.
struct NamedLeg {
    name: String,
    ends: [Point3<f64>; 2],
    /// Distance of the joints at an end, 0 if they meet.
    apart: f64,
}

/// All joints between two groups.
struct Link<'a> {
    groups: [usize; 2],
    joints: Vec<&'a ModelJoint>,
}

impl Link<'_> {
    fn points(&self) -> impl Iterator<Item = &Point3<f64>> {
        self.joints.iter().flat_map(|j| &j.points)
    }

    /// Several joints at one point leave at most the rotations of the most restrictive one.
    fn rotations(&self) -> usize {
        self.joints.iter().map(|j| j.kind.rotations()).min().unwrap_or(0)
    }

    fn other(&self, group: usize) -> usize {
        if self.groups[0] == group { self.groups[1] } else { self.groups[0] }
    }
}

/// The joints other than slides.
struct Graph<'a> {
    links: Vec<Link<'a>>,
    /// Indices of links by group.
    at: BTreeMap<usize, Vec<usize>>,
}

/// A piece of the graph as a tree: for each group the link towards the root.
type RootedPiece = BTreeMap<usize, Option<usize>>;

impl<'a> Graph<'a> {
    fn of(model: &'a Mechanism) -> Self {
        let mut between: BTreeMap<[usize; 2], Vec<&ModelJoint>> = BTreeMap::new();
        for joint in model.joints.iter().filter(|j| j.kind != JointKind::Slide) {
            let [a, b] = joint.groups.map(|g| model.group(g));
            if a != b {
                between.entry([a.min(b), a.max(b)]).or_default().push(joint);
            }
        }
        let links: Vec<Link<'a>> =
            between.into_iter().map(|(groups, joints)| Link { groups, joints }).collect();
        let mut at: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (k, link) in links.iter().enumerate() {
            for group in link.groups {
                at.entry(group).or_default().push(k);
            }
        }
        Self { links, at }
    }

    fn links_of(&self, group: usize) -> &[usize] {
        self.at.get(&group).map_or(&[], Vec::as_slice)
    }

    /// The piece with `root`.
    ///
    /// # Errors
    /// Loops, which leave the way from a leg to the root ambiguous.
    fn piece(&self, root: usize) -> Result<RootedPiece, String> {
        let mut piece = RootedPiece::from([(root, None)]);
        let mut open = vec![root];
        while let Some(group) = open.pop() {
            let by = piece.get(&group).copied().flatten();
            for &k in self.links_of(group).iter().filter(|k| Some(**k) != by) {
                let next = self.links[k].other(group);
                if piece.insert(next, Some(k)).is_some() {
                    let name = self.links[k].joints.first().map_or("", |j| j.name.as_str());
                    return Err(format!(
                        "joint `{name}` closes a loop that has none of the six slides in it, so that no point is the end of a leg"
                    ));
                }
                open.push(next);
            }
        }
        Ok(piece)
    }

    /// The links from a group to the root of its piece.
    fn way(&self, piece: &RootedPiece, mut group: usize) -> Vec<&Link<'a>> {
        let mut way = Vec::new();
        while let Some(Some(k)) = piece.get(&group) {
            way.push(&self.links[*k]);
            group = self.links[*k].other(group);
        }
        way
    }
}

/// Axes within about this angle of parallel have no reliable common point, radians.
const NEARLY_PARALLEL: f64 = 1e-3;

/// The common point of the joints on a way, and the distance of the farthest joint from it. `None` without one, for
/// instance for parallel hinges.
///
/// It is the place of the last joint if all agree exactly, otherwise the least-squares point of the points and axes.
fn common_point(way: &[&Link<'_>], near: f64) -> Option<(Point3<f64>, f64)> {
    let last = *way.iter().flat_map(|link| link.points()).last()?;
    let apart = way.iter().flat_map(|link| link.points()).map(|p| (p - last).norm()).fold(0.0, f64::max);
    if apart <= near {
        return Some((last, apart));
    }
    let joints = || way.iter().flat_map(|link| &link.joints);
    // across the axis of a hinge, in all directions for a ball
    let across = |joint: &ModelJoint| {
        joint.axis.map_or_else(Matrix3::identity, |a| Matrix3::identity() - a.as_ref() * a.transpose())
    };
    let (mut matrix, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for joint in joints() {
        for point in &joint.points {
            matrix += across(joint);
            right += across(joint) * (point - last);
        }
    }
    let least = matrix.symmetric_eigenvalues().min();
    if !(least > NEARLY_PARALLEL * NEARLY_PARALLEL) {
        return None;
    }
    let point = last + matrix.try_inverse()? * right;
    let far = |joint: &ModelJoint| joint.points.map(|p| (across(joint) * (p - point)).norm());
    Some((point, joints().flat_map(|j| far(j)).fold(0.0, f64::max)))
}

/// The joints of a model without six legs, in words.
fn counted(model: &Mechanism) -> String {
    let slides = model.joints.iter().filter(|j| j.kind == JointKind::Slide).count();
    let mut found = format!(
        "six slide joints, or six spatial tendons from one site to another, are legs; this model has {slides} slide joints, {} such tendons and {} others",
        model.tendons.len(),
        model.other_tendons
    );
    if slides == 0 && model.driven_hinges > 0 {
        let _ = write!(
            found,
            "; {} of its hinges are driven, and legs that are rods on cranks are not read from a model: write a design with `[[cranks]]`",
            model.driven_hinges
        );
    }
    found
}

impl ModelLegs {
    /// Finds the legs.
    ///
    /// # Errors
    /// A sentence that describes the model instead.
    pub(super) fn of(model: &Mechanism) -> Result<Self, String> {
        let slides: Vec<&ModelJoint> = model.joints.iter().filter(|j| j.kind == JointKind::Slide).collect();
        let (what, (platform, legs)) = match (slides.len(), model.tendons.len()) {
            (6, _) => ("slide joints", by_slides(model, &slides)?),
            (0, 6) => ("tendons", by_tendons(model)?),
            _ => return Err(counted(model)),
        };
        let numbers: Vec<Option<u64>> = legs.iter().map(|l| trailing_number(&l.name)).collect();
        let order = order_of(&numbers);
        let by = if order.is_some() { "by the numbers in their names" } else { "as they stand in the file" };
        let order = order.unwrap_or_else(|| (0..6).collect());
        let names: Vec<&str> = order.iter().map(|k| legs[*k].name.as_str()).collect();
        let mut guesses = vec![format!("The legs are the six {what} {}, in order {by}.", names.join(", "))];
        let apart = legs.iter().map(|leg| leg.apart).fold(0.0, f64::max);
        if apart > 0.0 {
            guesses.push(format!(
                "Joints at the end of a leg pass up to {apart:.1e} from each other: the nearest point is the end."
            ));
        }
        let ends: Vec<[Point3<f64>; 2]> = order.iter().map(|k| legs[*k].ends).collect();
        let ends = ends.try_into().map_err(|_| counted(model))?;
        Ok(Self { ends, platform, guesses })
    }
}

fn by_slides(model: &Mechanism, slides: &[&ModelJoint]) -> Result<(usize, Vec<NamedLeg>), String> {
    let graph = Graph::of(model);
    let base = graph.piece(WORLD)?;
    let mut leg_groups = Vec::new();
    for slide in slides {
        let groups = slide.groups.map(|g| model.group(g));
        leg_groups.push(match groups.map(|g| base.contains_key(&g)) {
            [true, false] => groups,
            [false, true] => [groups[1], groups[0]],
            [true, true] => {
                return Err(format!(
                    "slide `{}` is between two parts that the base carries without it",
                    slide.name
                ));
            }
            [false, false] => {
                return Err(format!(
                    "slide `{}` joins nothing to the base, which is what does not move in the world",
                    slide.name
                ));
            }
        });
    }
    let moved = leg_groups.first().map_or(WORLD, |[_, g]| *g);
    let platform = platform_of(model, &graph, &graph.piece(moved)?)?;
    let piece = graph.piece(platform)?;
    let mut legs = Vec::new();
    let mut ways = Vec::new();
    for (slide, groups) in slides.iter().zip(leg_groups) {
        if !piece.contains_key(&groups[1]) {
            return Err(format!(
                "slide `{}` leads from the base to something that is not joined to what `{}` leads to",
                slide.name, slides[0].name
            ));
        }
        ways.push([graph.way(&base, groups[0]), graph.way(&piece, groups[1])]);
    }
    let size = extent(ways.iter().flatten().flatten().flat_map(|link| link.points()));
    for (slide, ways) in slides.iter().zip(&ways) {
        let rotations = [0, 1].map(|k| ways[k].iter().map(|link| link.rotations()).sum::<usize>());
        let mut ends = [Point3::origin(); 2];
        let mut widest = 0.0_f64;
        for ((way, body), (end, free)) in
            ways.iter().zip(["base", "platform"]).zip(ends.iter_mut().zip(rotations))
        {
            if way.is_empty() {
                return Err(format!("slide `{}` has no joint between it and the {body}", slide.name));
            }
            let Some((point, apart)) = common_point(way, SAME_POINT * size) else {
                return Err(format!(
                    "the hinges between slide `{}` and the {body} are parallel: the end of a leg is one point",
                    slide.name
                ));
            };
            if !(apart <= ROUNDED_POINT * size) {
                return Err(format!(
                    "the joints between slide `{}` and the {body} pass {apart} from each other: the end of a leg is one point",
                    slide.name
                ));
            }
            if free < 2 {
                return Err(format!(
                    "between slide `{}` and the {body} there is one hinge only: a leg needs a universal joint or a ball joint at either end",
                    slide.name
                ));
            }
            *end = point;
            if apart > SAME_POINT * size {
                widest = widest.max(apart);
            }
        }
        if rotations[0] + rotations[1] < 5 {
            return Err(format!(
                "slide `{}` is between two universal joints: one end of a leg needs a ball joint, or the leg has to turn about itself",
                slide.name
            ));
        }
        legs.push(NamedLeg { name: slide.name.clone(), ends, apart: widest });
    }
    Ok((platform, legs))
}

/// The group of a piece with the most joints; of several, the one with the site `platform_frame` or a body named
/// platform.
fn platform_of(model: &Mechanism, graph: &Graph<'_>, piece: &RootedPiece) -> Result<usize, String> {
    let most = piece.keys().map(|g| graph.links_of(*g).len()).max().unwrap_or(0);
    let candidates: Vec<usize> = piece.keys().copied().filter(|g| graph.links_of(*g).len() == most).collect();
    let named = |g: &&usize| {
        model.site(super::PLATFORM_SITE).is_some_and(|(of, _)| of == **g)
            || model.first_body(**g).is_some_and(|(name, _)| name.to_lowercase().contains("platform"))
    };
    let by_name: Vec<&usize> = candidates.iter().filter(named).collect();
    match (&candidates[..], &by_name[..]) {
        ([one], _) => Ok(*one),
        (_, [one]) => Ok(**one),
        _ => Err(format!(
            "{} bodies have {most} joints, and which of them is the platform is not said: name it `platform`",
            candidates.len()
        )),
    }
}

fn by_tendons(model: &Mechanism) -> Result<(usize, Vec<NamedLeg>), String> {
    let mut platform = None;
    let mut legs = Vec::new();
    for tendon in &model.tendons {
        let groups = tendon.groups.map(|g| model.group(g));
        let [a, b] = tendon.points;
        let (moved, ends) = match groups.map(|g| g == WORLD) {
            [true, false] => (groups[1], [a, b]),
            [false, true] => (groups[0], [b, a]),
            _ => {
                return Err(format!(
                    "tendon `{}` does not lead from the base, which does not move in the world, to another body",
                    tendon.name
                ));
            }
        };
        if *platform.get_or_insert(moved) != moved {
            return Err(format!("tendon `{}` leads to another body than those before it", tendon.name));
        }
        legs.push(NamedLeg { name: tendon.name.clone(), ends, apart: 0.0 });
    }
    Ok((platform.unwrap_or(WORLD), legs))
}
