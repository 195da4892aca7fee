//! Poses of one sign of `det J` joined by chains of straight paths that keep it: a random roadmap, its edges proved.

use nalgebra::{UnitQuaternion, Vector3};

use super::polynomial::Sign;
use super::{between, signs_along};
use crate::geom::{Pose, random_rotation};
use crate::manipulator::{Manipulator, plucker_matrix};
use crate::num::Rng;

/// Neighbours of a pose of the roadmap.
const NEIGHBOURS: usize = 12;
/// Poses looked at on an edge before it is proved.
const PROBES: usize = 12;

/// How hard to search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JoinOptions {
    /// Random poses drawn for each sign.
    pub samples: usize,
    /// Seed of the drawing.
    pub seed: u64,
}

/// A chain of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    /// Index of the pose it starts from.
    pub from: usize,
    /// Index of the pose it leads to.
    pub to: usize,
    /// All poses of the chain, both ends included; `det J` is proved to keep its sign on every straight path from one to the next.
    pub poses: Vec<Pose>,
}

/// Which of some poses are proved to be joined without a singular pose between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Joined {
    /// Sign of `det J` at each pose, `None` where it is not proved.
    pub signs: Vec<Option<Sign>>,
    /// Poses proved to be joined, each pose in one group. Poses of different groups and opposite signs cannot be joined; those of equal signs
    /// were not joined by the search.
    pub groups: Vec<Vec<usize>>,
    /// Ways inside the groups: every pose of a group is reached from its first.
    pub ways: Vec<Way>,
}

/// Joins poses by chains of straight paths without a singular pose.
///
/// Two poses in different regions of `det J != 0` are never joined, whatever the effort; two in one region may be missed.
#[must_use]
pub fn join(m: &Manipulator, poses: &[Pose], options: &JoinOptions) -> Joined {
    let signs: Vec<Option<Sign>> = poses.iter().map(|p| signs_along(m, p, p).kept()).collect();
    let mut joined = Joined { signs, groups: Vec::new(), ways: Vec::new() };
    for sign in [Sign::Positive, Sign::Negative] {
        let members: Vec<usize> = (0..poses.len()).filter(|k| joined.signs[*k] == Some(sign)).collect();
        if members.is_empty() {
            continue;
        }
        let mut map = Roadmap::new(m, members.iter().map(|k| poses[*k]).collect(), sign, options);
        let mut left: Vec<usize> = (0..members.len()).collect();
        while let Some(first) = left.first().copied() {
            let mut group = vec![members[first]];
            let reached: Vec<(usize, Vec<Pose>)> =
                left[1..].iter().filter_map(|k| map.way(first, *k).map(|way| (*k, way))).collect();
            for (k, poses) in reached {
                group.push(members[k]);
                joined.ways.push(Way { from: members[first], to: members[k], poses });
            }
            left.retain(|k| !group.contains(&members[*k]));
            joined.groups.push(group);
        }
    }
    let unsigned = (0..poses.len()).filter(|k| joined.signs[*k].is_none());
    joined.groups.extend(unsigned.map(|k| vec![k]));
    joined.groups.sort();
    joined
}

/// Poses of one sign with edges that seem to keep it.
struct Roadmap<'a> {
    m: &'a Manipulator,
    sign: Sign,
    poses: Vec<Pose>,
    edges: Vec<Vec<usize>>,
    /// Edges proved, smaller index first.
    proved: Vec<(usize, usize)>,
}

impl<'a> Roadmap<'a> {
    fn new(m: &'a Manipulator, mut poses: Vec<Pose>, sign: Sign, options: &JoinOptions) -> Self {
        let mut rng = Rng::stream(options.seed, u64::from(sign == Sign::Positive));
        let low = poses.iter().fold(poses[0].position, |x, p| x.inf(&p.position));
        let high = poses.iter().fold(poses[0].position, |x, p| x.sup(&p.position));
        let margin = Vector3::repeat(0.5 * m.size());
        let (low, high) = (low - margin, high + margin);
        for _ in 0..options.samples {
            let position = Vector3::from_fn(|k, _| rng.uniform(low[k], high[k]));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            if has_sign(m, &pose, sign) {
                poses.push(pose);
            }
        }
        let edges = neighbours(m, &poses);
        let mut map = Self { m, sign, poses, edges, proved: Vec::new() };
        for k in 0..map.edges.len() {
            let list = std::mem::take(&mut map.edges[k]);
            map.edges[k] = list.into_iter().filter(|l| map.seems_free(k, *l)).collect();
        }
        map
    }

    fn seems_free(&self, k: usize, l: usize) -> bool {
        let probe = |i: usize| between(&self.poses[k], &self.poses[l], (i as f64 + 0.5) / PROBES as f64);
        (0..PROBES).all(|i| has_sign(self.m, &probe(i), self.sign))
    }

    fn is_free(&self, k: usize, l: usize) -> bool {
        signs_along(self.m, &self.poses[k], &self.poses[l]).kept() == Some(self.sign)
    }

    /// A proved way between two poses; edges that turn out not to be free are dropped on the way.
    fn way(&mut self, from: usize, to: usize) -> Option<Vec<Pose>> {
        loop {
            let chain = self.shortest(from, to)?;
            let bad = chain.windows(2).find(|w| !self.prove(w[0], w[1])).map(|w| (w[0], w[1]));
            match bad {
                Some((k, l)) => {
                    self.edges[k].retain(|x| *x != l);
                    self.edges[l].retain(|x| *x != k);
                }
                None => return Some(self.shortened(&chain).iter().map(|k| self.poses[*k]).collect()),
            }
        }
    }

    fn prove(&mut self, k: usize, l: usize) -> bool {
        let edge = (k.min(l), k.max(l));
        if !self.proved.contains(&edge) {
            if !self.is_free(k, l) {
                return false;
            }
            self.proved.push(edge);
        }
        true
    }

    /// Fewest edges, breadth first.
    fn shortest(&self, from: usize, to: usize) -> Option<Vec<usize>> {
        let mut before: Vec<Option<usize>> = vec![None; self.poses.len()];
        before[from] = Some(from);
        let mut queue = std::collections::VecDeque::from([from]);
        while let Some(k) = queue.pop_front() {
            if k == to {
                let mut chain = vec![to];
                let mut at = to;
                while at != from {
                    at = before[at]?;
                    chain.push(at);
                }
                chain.reverse();
                return Some(chain);
            }
            for &l in &self.edges[k] {
                if before[l].is_none() {
                    before[l] = Some(k);
                    queue.push_back(l);
                }
            }
        }
        None
    }

    /// Leaves out poses that a proved straight path passes by.
    fn shortened(&self, chain: &[usize]) -> Vec<usize> {
        let (mut out, mut at) = (vec![chain[0]], 0);
        while at + 1 < chain.len() {
            let far = (at + 2..chain.len()).rev().find(|k| self.is_free(chain[at], chain[*k]));
            at = far.unwrap_or(at + 1);
            out.push(chain[at]);
        }
        out
    }
}

/// The sign of `det J` in rounded numbers.
fn has_sign(m: &Manipulator, pose: &Pose, sign: Sign) -> bool {
    plucker_matrix(m, pose, m.size()).determinant() * f64::from(sign.value()) > 0.0
}

/// For every pose the nearest others, in both directions.
fn neighbours(m: &Manipulator, poses: &[Pose]) -> Vec<Vec<usize>> {
    let places: Vec<(UnitQuaternion<f64>, Vector3<f64>)> = poses
        .iter()
        .map(|p| (UnitQuaternion::from_rotation_matrix(&p.rotation), p.position / m.size()))
        .collect();
    let apart = |k: usize, l: usize| {
        let ((q, x), (r, y)) = (&places[k], &places[l]);
        (x - y).norm_squared() + 8.0 * (1.0 - q.coords.dot(&r.coords).abs())
    };
    let mut edges: Vec<Vec<usize>> = vec![Vec::new(); poses.len()];
    for k in 0..poses.len() {
        let mut others: Vec<(f64, usize)> =
            (0..poses.len()).filter(|l| *l != k).map(|l| (apart(k, l), l)).collect();
        let count = NEIGHBOURS.min(others.len());
        if count > 0 && count < others.len() {
            others.select_nth_unstable_by(count - 1, |x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
        }
        for (_, l) in others.into_iter().take(count) {
            if !edges[k].contains(&l) {
                edges[k].push(l);
                edges[l].push(k);
            }
        }
    }
    for list in &mut edges {
        list.sort_unstable();
    }
    edges
}
