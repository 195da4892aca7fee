//! Joints of a body and the legs between them.

use std::collections::BTreeMap;

use nalgebra::Point3;

use super::constructions::{self, Places};
use super::found::{self, nearest, numbers, shown};
use crate::design::construction::{Construction, Constructions};
use crate::design::tree::{Entry, Node, Span, Value};
use crate::design::violation::Findings;
use crate::design::{Code, Warning};
use platform::manipulator::{Body, is_collinear};

/// A joint of the file. A joint with bad coordinates is kept, so that legs still find its name.
#[derive(Debug)]
pub(super) struct FileJoint {
    pub(super) name: String,
    pub(super) point: [f64; 3],
    pub(super) intact: bool,
    span: Span,
    /// Whether it is given by other means than three numbers, valid or not.
    pub(super) constructed: bool,
    construction: Option<Construction>,
    pub(super) places: Places,
}

/// The joints of the base or of the platform.
#[derive(Debug)]
pub(super) struct NamedJoints {
    body: Body,
    span: Span,
    pub(super) joints: Vec<FileJoint>,
    index: BTreeMap<String, usize>,
    /// For each joint the first one at exactly the same place.
    first_there: Vec<usize>,
}

/// Six legs as pairs of joint indices.
#[derive(Debug)]
pub(super) struct Legs {
    pub(super) pairs: [(usize, usize); 6],
}

impl NamedJoints {
    pub(super) fn names(&self) -> Vec<String> {
        self.joints.iter().map(|j| j.name.clone()).collect()
    }

    /// The coordinates; not finite if unreadable.
    pub(super) fn points(&self) -> Vec<Point3<f64>> {
        let point = |j: &FileJoint| if j.intact { j.point } else { [f64::NAN; 3] };
        self.joints.iter().map(|j| Point3::from(point(j))).collect()
    }

    /// Finds coincident joints: by exact coordinates if some are constructed, otherwise by doubles.
    pub(super) fn find_coincident(&mut self, constructions: Option<&Constructions>) {
        let exact = constructions
            .filter(|_| self.joints.iter().any(|j| j.constructed))
            .map(|c| c.exact(self.body, &self.points()));
        let known = |i: usize, k: usize| exact.as_ref()?[i][k].exact();
        let same = |i: usize, j: usize| {
            exact.is_none() || (0..3).all(|k| known(i, k).is_some() && known(i, k) == known(j, k))
        };
        let mut near: BTreeMap<[u64; 3], Vec<usize>> = BTreeMap::new();
        for (i, joint) in self.joints.iter().enumerate().filter(|(_, j)| j.intact) {
            // equal numbers have equal nearest doubles; -0 + 0 = 0 gives one key for both zeros
            let there = near.entry(joint.point.map(|x| (x + 0.0).to_bits())).or_default();
            match there.iter().find(|j| same(**j, i)) {
                Some(first) => self.first_there[i] = *first,
                None => there.push(i),
            }
        }
    }

    /// One entry per joint, or none if no joint is constructed.
    pub(super) fn constructions(&self) -> Vec<Option<Construction>> {
        let list: Vec<_> = self.joints.iter().map(|j| j.construction.clone()).collect();
        if list.iter().all(Option::is_none) { Vec::new() } else { list }
    }
}

/// `legs` of a file looks like `[["P1", "P4"], ...]`.
pub(super) fn is_list_of_pairs(node: &Node) -> bool {
    matches!(&node.value, Value::Array(list) if list.iter().any(|e| matches!(e.value, Value::Array(_))))
}

/// Reads `[base]` or `[platform]`.
pub(super) fn body(report: &mut Findings<'_>, which: Body, entry: &Entry) -> Option<NamedJoints> {
    if matches!(entry.node.value, Value::Array(_)) {
        let letter = which.of(("A", "B"));
        let message = format!("`{which}` is a list of points without names");
        let help = format!(
            "name the joints, a line each below [{which}]: {letter}1 = [100, 0, 0]; `equipod new --points FILE` makes a design of twelve points in a table"
        );
        return report.refused(Code::WrongType, &entry.node.span, message, help);
    }
    let entries = found::table(report, &entry.node, &format!("[{which}]"))?;
    let mut body = NamedJoints {
        body: which,
        span: entry.key_span.clone(),
        joints: Vec::new(),
        index: BTreeMap::new(),
        first_there: Vec::new(),
    };
    let is_joint = |e: &&Entry| e.key != "legs" || !is_list_of_pairs(&e.node);
    let names = entries.iter().filter(is_joint).enumerate();
    body.index = names.map(|(i, e)| (e.key.clone(), i)).collect();
    for e in entries.iter().filter(is_joint) {
        if e.key.trim().is_empty() {
            let message = format!("a joint of the {which} has an empty name");
            report.refuse(Code::EmptyName, &e.key_span, message, "give the joint a name");
        }
        let what = format!("{which} joint {}", shown(&e.key));
        let constructed = constructions::is_constructed(&e.node);
        let (mut point, mut construction, mut places) = (None, None, Places::default());
        if constructed {
            if let Some(made) = constructions::joint(report, &e.node, &what, &body.index) {
                (construction, places) = (Some(made.0), made.1);
            }
        } else {
            point = numbers::<3>(report, &e.node, &what, Code::CoordinateCount, "coordinates x, y, z");
        }
        body.joints.push(FileJoint {
            name: e.key.clone(),
            point: point.unwrap_or_default(),
            intact: point.is_some() || construction.is_some(),
            span: e.key_span.clone(),
            constructed,
            construction,
            places,
        });
    }
    body.first_there = (0..body.joints.len()).collect();
    Some(body)
}

pub(super) fn warn_coincident(report: &mut Findings<'_>, body: &NamedJoints) {
    for (joint, first) in body.joints.iter().zip(&body.first_there) {
        let first = &body.joints[*first].name;
        if *first != joint.name {
            let (first, second) = (first.clone(), joint.name.clone());
            let line = report.line(joint.span.start);
            report.warn(Warning::CoincidentJoints { body: body.body, first, second, line });
        }
    }
}

/// Reads `legs` and checks the pairs and the joints that they use.
pub(super) fn legs(
    report: &mut Findings<'_>,
    entry: &Entry,
    base: &NamedJoints,
    platform: &NamedJoints,
) -> Option<Legs> {
    let pairs = pairs::<6>(report, entry, base, platform)?;
    for (body, used) in [(base, pairs.map(|p| p.0)), (platform, pairs.map(|p| p.1))] {
        check_use(report, body, used);
    }
    Some(Legs { pairs })
}

/// The pairs of joints of `N` legs.
pub(super) fn pairs<const N: usize>(
    report: &mut Findings<'_>,
    entry: &Entry,
    base: &NamedJoints,
    platform: &NamedJoints,
) -> Option<[(usize, usize); N]> {
    let five = "; `equipod check` and `equipod fk` take designs of five legs";
    let help = format!(
        "write six pairs: legs = [[\"A1\", \"B1\"], [\"A2\", \"B2\"], ...]{}",
        if number_of_legs(entry) == Some(5) { five } else { "" }
    );
    let Value::Array(list) = &entry.node.value else {
        return report.not_a(&entry.node, "`legs`", "an array of pairs", help);
    };
    if list.len() != N {
        let message = format!("there are {} legs instead of six", list.len());
        report.refuse(Code::LegCount, &entry.key_span, message, help);
    }
    let pairs: Vec<Option<(usize, usize)>> =
        list.iter().enumerate().map(|(i, node)| pair(report, i, node, base, platform)).collect();
    warn_coincident_legs(report, list, &pairs, base, platform);
    let pairs: Vec<(usize, usize)> = pairs.into_iter().collect::<Option<_>>()?;
    pairs.try_into().ok()
}

/// The number of legs in a list; `None` if it is no list.
pub(super) fn number_of_legs(entry: &Entry) -> Option<usize> {
    if let Value::Array(list) = &entry.node.value { Some(list.len()) } else { None }
}

/// One leg.
fn pair(
    report: &mut Findings<'_>,
    i: usize,
    node: &Node,
    base: &NamedJoints,
    platform: &NamedJoints,
) -> Option<(usize, usize)> {
    let leg = i + 1;
    let ends: Vec<Option<(&str, &Span)>> = match &node.value {
        Value::Array(ends) => ends
            .iter()
            .map(|e| if let Value::Text(name) = &e.value { Some((name.as_str(), &e.span)) } else { None })
            .collect(),
        _ => Vec::new(),
    };
    let [Some(a), Some(b)] = ends.as_slice() else {
        let message = format!("leg {leg} is not a pair of joint names");
        return report.refused(
            Code::LegShape,
            &node.span,
            message,
            "write [\"base joint\", \"platform joint\"]",
        );
    };
    let a = lookup(report, leg, *a, base, platform);
    let b = lookup(report, leg, *b, platform, base);
    Some((a?, b?))
}

fn lookup(
    report: &mut Findings<'_>,
    leg: usize,
    (name, span): (&str, &Span),
    body: &NamedJoints,
    other: &NamedJoints,
) -> Option<usize> {
    if let Some(index) = body.index.get(name) {
        return Some(*index);
    }
    let label = body.body;
    let names: Vec<&str> = body.joints.iter().map(|j| j.name.as_str()).take(200).collect();
    let help = if other.index.contains_key(name) {
        format!("`{}` is a joint of the {}; a leg names the base joint first", shown(name), other.body)
    } else if let Some(near) = nearest(name, &names) {
        format!("did you mean `{}`?", shown(near))
    } else {
        format!("add `{} = [x, y, z]` to [{label}]", shown(name))
    };
    let message = format!("leg {leg} names `{}`, which is not a joint of the {label}", shown(name));
    report.refused(Code::MissingJoint, span, message, help)
}

/// Two legs between the same two points: architecturally singular, but still a valid question.
fn warn_coincident_legs(
    report: &mut Findings<'_>,
    list: &[Node],
    pairs: &[Option<(usize, usize)>],
    base: &NamedJoints,
    platform: &NamedJoints,
) {
    let mut seen: BTreeMap<(usize, usize), usize> = BTreeMap::new();
    for (i, pair) in pairs.iter().enumerate() {
        let Some((a, b)) = *pair else { continue };
        let first = *seen.entry((base.first_there[a], platform.first_there[b])).or_insert(i);
        if first != i {
            let line = report.line(list[i].span.start);
            report.warn(Warning::CoincidentLegs { legs: [first + 1, i + 1], line });
        }
    }
}

/// Unused joints, and degenerate triangles.
fn check_use(report: &mut Findings<'_>, body: &NamedJoints, used: [usize; 6]) {
    for (i, joint) in body.joints.iter().enumerate() {
        if !used.contains(&i) {
            let line = report.line(joint.span.start);
            report.warn(Warning::UnusedJoint { body: body.body, name: joint.name.clone(), line });
        }
    }
    let mut distinct = used.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    if let [i, j, k] = distinct.as_slice() {
        let triangle = [*i, *j, *k].map(|n| &body.joints[n]);
        let points = triangle.map(|joint| Point3::from(joint.point));
        if triangle.iter().all(|joint| joint.intact) && is_collinear(&points) {
            let names = triangle.map(|joint| shown(&joint.name)).join(", ");
            let message = format!("the {} joints {names} are on one line", body.body);
            let help = "move one of them: a body held in three points on a line can turn about it";
            report.refuse(Code::CollinearTriangle, &body.span, message, help);
        }
    }
}
