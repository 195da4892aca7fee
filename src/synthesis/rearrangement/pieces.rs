//! Irreducible families of replaceable legs in exact form, found for three kinds of designs.
//!
//! First kind: designs whose legs span a sum of stars, `L = sum_j alpha_j (x) V_j` with independent points `alpha_j` of
//! one body.
//!
//! Then `(a, b)` with `(1, a) = sum_j lambda_j alpha_j` is replaceable exactly if `(1, b)` lies in `V_j` for every `j`
//! with `lambda_j != 0`. So the replaceable legs are the legs between the flats `span(alpha_j, j in S)` and `V_S`, the
//! intersection of the `V_j` with `j` in `S`.
//!
//! Second kind: designs with one body or both in space and too many joints for a sum of stars. They have families at
//! the joints, and one pairing.
//!
//! A leg that is a combination of legs `S` with nonzero coefficients needs `|S| >= i + j + 1` (lemma of
//! `docs/theory/components.md`). If the joints of one body in `S` are independent, the argument for stars holds for
//! `S`. Otherwise `i` and `j` are the dimensions of the bodies, and only a plane and a space with all six legs remain.
//!
//! Third kind: replaceable legs between two planes, constructed from the pair of cubics by chords.
//!
//! `M(alpha) beta = 0` are the three equations of the span of six legs. A line through two points of the cubic
//! `det M = 0` meets it once more, so six rational legs give further rational ones.

use super::sample::{DesignSample, finite, integer, leg_through, meet, subsets, weighted};
use num::Rng;
use num::exact::{ExactVector, Rational, rank, relations};
use platform::manipulator::{Body, ExactLeg};

/// The kind of a family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case"),
    schemars(rename = "FamilyKindWord")
)]
pub enum PieceKind {
    /// Every point of one flat with every point of the other.
    AllPairs,
    /// Every point with its partner.
    // a projective pairing of two lines
    Pairing,
}

/// One irreducible family of replaceable legs.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The pairing of its ends.
    pub kind: PieceKind,
    /// Homogeneous coordinates of points that span the flat of the base ends.
    pub(super) base: Vec<ExactVector>,
    /// Points that span the flat of the platform ends. In a pairing, partner `k` belongs to base point `k`, and sums to
    /// sums.
    pub(super) platform: Vec<ExactVector>,
    /// The summands of the span of all legs that contain its legs.
    pub(super) parts: Vec<usize>,
    /// Greatest dimension of the span of its legs in each of these summands.
    pub(super) weight: usize,
}

impl Piece {
    /// Dimension of the flat of its base ends.
    #[must_use]
    pub fn base_dimension(&self) -> usize {
        self.base.len().saturating_sub(1)
    }

    /// Dimension of the flat of its platform ends.
    #[must_use]
    pub fn platform_dimension(&self) -> usize {
        self.platform.len().saturating_sub(1)
    }

    /// Dimension of the family.
    #[must_use]
    pub fn dimension(&self) -> usize {
        match self.kind {
            PieceKind::AllPairs => self.base_dimension() + self.platform_dimension(),
            PieceKind::Pairing => 1,
        }
    }

    /// Number of independent legs in it.
    #[must_use]
    pub fn rank(&self) -> usize {
        match self.kind {
            PieceKind::AllPairs => self.base.len() * self.platform.len(),
            PieceKind::Pairing => 3,
        }
    }

    /// The summands of the span of the legs in which its legs have a part; in each they span at most
    /// [`weight`](Self::weight) dimensions.
    #[must_use]
    pub fn parts(&self) -> &[usize] {
        &self.parts
    }

    /// The greatest dimension in each of the [`parts`](Self::parts).
    #[must_use]
    pub fn weight(&self) -> usize {
        self.weight
    }

    /// Whether all its legs, more than one, share a joint.
    #[must_use]
    pub fn has_common_joint(&self) -> bool {
        (self.base.len() == 1) != (self.platform.len() == 1)
    }

    /// Homogeneous coordinates of points that span the two flats, as fractions: base, platform.
    #[must_use]
    pub fn points(&self) -> [Vec<[String; 4]>; 2] {
        let text = |list: &[ExactVector]| {
            list.iter()
                .map(|p| std::array::from_fn(|k| p.get(k).map_or(String::new(), Rational::to_string)))
                .collect()
        };
        [text(&self.base), text(&self.platform)]
    }

    /// A leg of it at random fractions; `None` when an end is at infinity.
    pub(super) fn draw(&self, rng: &mut Rng) -> Option<ExactLeg> {
        let base = weights(self.base.len(), rng);
        let platform = match self.kind {
            PieceKind::AllPairs => weights(self.platform.len(), rng),
            PieceKind::Pairing => base.clone(),
        };
        leg_through(&weighted(&self.base, &base), &weighted(&self.platform, &platform))
    }
}

/// Barycentric coordinates in quarters and halves, for points spread about the given ones.
fn weights(count: usize, rng: &mut Rng) -> Vec<Rational> {
    const LINE: [[i64; 2]; 8] = [[2, 2], [1, 3], [3, 1], [6, -2], [-2, 6], [5, -1], [-1, 5], [8, -4]];
    let quarter = |x: i64| integer(x) / integer(4);
    if count == 1 {
        return vec![integer(1)];
    }
    let mut out = vec![integer(1)];
    for _ in 1..count {
        // the current point of the simplex, then the line to the next vertex
        let [s, t] = LINE[(rng.next_u64() % 8) as usize].map(quarter);
        for w in &mut out {
            *w *= &s;
        }
        out.push(t);
    }
    out
}

/// A point of a body, and the joints of the other one to which it has replaceable legs in every design of the topology.
#[derive(Debug, Clone)]
struct Star {
    point: ExactVector,
    sees: Vec<usize>,
}

/// All families, and the dimensions of the summands.
#[derive(Debug, Clone)]
pub(super) struct SplitFamilies {
    pub(super) pieces: Vec<Piece>,
    pub(super) summands: Vec<usize>,
}

/// The result for a sample.
#[derive(Debug, Clone)]
pub(super) enum SampleOutcome {
    /// All families of the sample, which are those of every general member.
    Found(SplitFamilies),
    /// An intersection is larger than in general: another sample is needed.
    Special,
    /// The span is not such a sum.
    None,
}

/// Joints of a body with legs to every point of the other body's flat.
fn full(sample: &DesignSample, body: Body) -> Vec<usize> {
    let enough = sample.dimension(body.other()) + 1;
    (0..sample.joints(body).len()).filter(|k| sample.neighbours(body, *k).len() >= enough).collect()
}

/// The stars of a body: its joints, and the intersections in its plane of the lines of two double joints of the other
/// body.
fn stars(sample: &DesignSample, body: Body) -> Vec<Star> {
    let there = body.other();
    let everywhere = full(sample, there);
    let with = |mut sees: Vec<usize>| {
        sees.extend(&everywhere);
        sees.sort_unstable();
        sees.dedup();
        sees
    };
    let joints = sample.joints(body).iter().enumerate();
    let mut out: Vec<Star> =
        joints.map(|(k, p)| Star { point: p.clone(), sees: with(sample.neighbours(body, k)) }).collect();
    for pair in subsets(sample.joints(there).len()).filter(|s| s.len() == 2) {
        let seen = [0, 1].map(|k| sample.neighbours(there, pair[k]));
        let apart = seen[0].iter().all(|k| !seen[1].contains(k));
        if sample.dimension(body) == 2 && apart && seen.iter().all(|s| s.len() == 2) {
            let [u, v] = seen.map(|s| sample.points(body, &s));
            let crossing = meet(&u, &v).first().and_then(finite);
            out.extend(crossing.map(|point| Star { point, sees: with(pair) }));
        }
    }
    out
}

/// The sum over points of `body`.
pub(super) fn split(sample: &DesignSample, body: Body) -> SampleOutcome {
    let there = body.other();
    let (own, most) = (sample.dimension(body) + 1, sample.dimension(there) + 1);
    let all = stars(sample, body);
    let chosen = subsets(all.len()).filter(|s| s.len() == own).find(|s| {
        let legs: usize = s.iter().map(|k| all[*k].sees.len()).sum();
        let points: Vec<ExactVector> = s.iter().map(|k| all[*k].point.clone()).collect();
        legs == 6 && s.iter().all(|k| all[*k].sees.len() <= most) && rank(&points) == own
    });
    let Some(chosen) = chosen else { return SampleOutcome::None };
    let basis: Vec<&Star> = chosen.iter().map(|k| &all[*k]).collect();
    families(sample, body, &basis).map_or(SampleOutcome::Special, SampleOutcome::Found)
}

/// The least dimension of the intersection of the `V_j`, from common joints and from counting dimensions.
fn least(basis: &[&Star], most: usize, set: &[usize]) -> usize {
    let Some((first, rest)) = set.split_first() else { return most };
    let common =
        basis[*first].sees.iter().filter(|k| rest.iter().all(|j| basis[*j].sees.contains(k))).count();
    let parts = subsets(set.len()).filter(|s| s.len() < set.len() && s[0] == 0).map(|s| {
        let (in_it, out): (Vec<usize>, Vec<usize>) = (0..set.len()).partition(|k| s.contains(k));
        let at = |part: Vec<usize>| least(basis, most, &part.iter().map(|k| set[*k]).collect::<Vec<_>>());
        (at(in_it) + at(out)).saturating_sub(most)
    });
    parts.max().unwrap_or(0).max(common)
}

/// The families; `None` if an intersection has more than its least dimension.
fn families(sample: &DesignSample, body: Body, basis: &[&Star]) -> Option<SplitFamilies> {
    let there = body.other();
    let most = sample.dimension(there) + 1;
    let mut pieces = Vec::new();
    for set in subsets(basis.len()) {
        let seen: Vec<Vec<ExactVector>> = basis.iter().map(|s| sample.points(there, &s.sees)).collect();
        let common: Vec<usize> = basis[set[0]]
            .sees
            .iter()
            .copied()
            .filter(|k| set.iter().all(|j| basis[*j].sees.contains(k)))
            .collect();
        let mut flat = set[1..].iter().fold(seen[set[0]].clone(), |flat, j| meet(&flat, &seen[*j]));
        if flat.len() != least(basis, most, &set) {
            return None;
        }
        if flat.len() == common.len() {
            flat = sample.points(there, &common);
        } else {
            flat = flat.iter().map(finite).collect::<Option<_>>()?;
        }
        let inside = |j: usize| rank(&[seen[j].clone(), flat.clone()].concat()) == seen[j].len();
        if flat.is_empty() || (0..basis.len()).any(|j| !set.contains(&j) && inside(j)) {
            continue;
        }
        let weight = flat.len();
        let own: Vec<ExactVector> = set.iter().map(|j| basis[*j].point.clone()).collect();
        let (base, platform) = if body == Body::Base { (own, flat) } else { (flat, own) };
        pieces.push(Piece { kind: PieceKind::AllPairs, base, platform, parts: set, weight });
    }
    Some(SplitFamilies { pieces, summands: basis.iter().map(|s| s.sees.len()).collect() })
}

/// The families; `None` when the sample is special.
pub(super) fn at_joints(sample: &DesignSample, legs: &[(usize, usize); 6]) -> Option<SplitFamilies> {
    let both = Body::BOTH;
    if !both.into_iter().all(|body| flats_meet_in_joints(sample, body)) {
        return None;
    }
    let mut split = SplitFamilies { pieces: complete_graphs(sample, legs), summands: vec![1; 6] };
    let flat = both.into_iter().find(|b| sample.dimension(*b) == 2);
    if let Some(pairing) = flat.and_then(|body| pairing(sample, body)) {
        // a single leg at a joint of the line is a leg of the pairing
        let same = |x: &ExactVector, y: &ExactVector| rank(&[x.clone(), y.clone()]) == 1;
        let held = |p: &Piece| {
            let mut ends = pairing.base.iter().zip(&pairing.platform);
            p.dimension() == 0 && ends.any(|(a, b)| same(a, &p.base[0]) && same(b, &p.platform[0]))
        };
        split.pieces.retain(|p| !held(p));
        split.pieces.push(pairing);
        split.summands.push(3);
    }
    Some(split)
}

/// Whether the flats of the neighbours of two joints on the other body intersect only in common joints.
fn flats_meet_in_joints(sample: &DesignSample, body: Body) -> bool {
    let there = body.other();
    subsets(sample.joints(body).len()).filter(|s| s.len() == 2).all(|pair| {
        let seen = [0, 1].map(|k| sample.neighbours(body, pair[k]));
        let common = seen[0].iter().filter(|k| seen[1].contains(k)).count();
        let [u, v] = seen.map(|s| sample.points(there, &s));
        meet(&u, &v).len() == common
    })
}

/// Maximal sets of joints with a leg between every two on different bodies, such that each leg is in at least one set.
fn complete_graphs(sample: &DesignSample, legs: &[(usize, usize); 6]) -> Vec<Piece> {
    let count = sample.joints(Body::Base).len();
    let seen: Vec<Vec<usize>> = (0..count).map(|k| sample.neighbours(Body::Base, k)).collect();
    let sets = subsets(count).filter_map(|set| {
        let common: Vec<usize> =
            seen[set[0]].iter().copied().filter(|k| set.iter().all(|j| seen[*j].contains(k))).collect();
        let closed = (0..count).all(|j| set.contains(&j) || !common.iter().all(|k| seen[j].contains(k)));
        (closed && !common.is_empty()).then_some((set, common))
    });
    let piece = |(set, common): (Vec<usize>, Vec<usize>)| Piece {
        kind: PieceKind::AllPairs,
        parts: (0..6).filter(|l| set.contains(&legs[*l].0) && common.contains(&legs[*l].1)).collect(),
        base: sample.points(Body::Base, &set),
        platform: sample.points(Body::Platform, &common),
        weight: 1,
    };
    sets.map(piece).collect()
}

/// The pairing of the line `a1 a2` of a planar body of four joints with a line in space. The line goes through the
/// double joint `b` and meets the flats of the neighbours of `a1` and `a2`. Joint `b` is joined to the other two
/// joints, and no other joint is.
///
/// Let `b = w1 + w2` (`wk` in the flat of `ak`). Let `c = a1 + a2` (suitably scaled) be the intersection of `a1 a2`
/// with the line of the other two joints. The legs `(a1, w1)`, `(a2, w2)`, `(c, b)` are then replaceable and lie
/// between two lines.
fn pairing(sample: &DesignSample, planar: Body) -> Option<Piece> {
    let space = planar.other();
    if sample.joints(planar).len() != 4 || sample.joints(space).len() != 5 {
        return None;
    }
    // its rank counts in a separate summand, after those of the six legs
    let double = (0..5).find(|k| sample.neighbours(space, *k).len() == 2)?;
    let held = sample.neighbours(space, double);
    let free: Vec<usize> = (0..4).filter(|k| !held.contains(k)).collect();
    let flats = [0, 1].map(|k| sample.points(space, &sample.neighbours(planar, free[k])));
    if flats[0].len() + flats[1].len() != 4 {
        return None;
    }
    let line = sample.points(planar, &free);
    let crossing = meet(&line, &sample.points(planar, &held)).into_iter().next()?;
    let target = &sample.points(space, &[double])[0];
    let on_plane = parts(&crossing, [&line[..1], &line[1..]])?.to_vec();
    let in_space = parts(target, [&flats[0], &flats[1]])?.to_vec();
    let (base, platform) = if planar == Body::Base { (on_plane, in_space) } else { (in_space, on_plane) };
    Some(Piece { kind: PieceKind::Pairing, base, platform, parts: vec![6], weight: 3 })
}

/// `x = u + v` with `u` and `v` in two spans that intersect only in zero.
fn parts(x: &ExactVector, spans: [&[ExactVector]; 2]) -> Option<[ExactVector; 2]> {
    let rows: Vec<ExactVector> = spans[0].iter().chain(spans[1]).chain([x]).cloned().collect();
    let relation = relations(&rows).into_iter().next()?;
    let (last, head) = relation.split_last()?;
    let scaled: Vec<_> = head.iter().map(|c| -(c / last)).collect();
    let (u, v) = scaled.split_at(spans[0].len());
    Some([weighted(spans[0], u), weighted(spans[1], v)])
}

/// The equations of the span of six legs between the planes `z = 0`.
#[derive(Debug, Clone)]
pub(super) struct PlaneGroups {
    /// `equations[r][3 i + j]` is the coefficient of `alpha_i beta_j`.
    equations: Vec<ExactVector>,
}

impl PlaneGroups {
    /// The equations of six legs with independent vectors.
    pub(super) fn of(sample: &DesignSample) -> Self {
        let vectors: Vec<ExactVector> = sample.legs().iter().map(|l| flat(&l.base, &l.platform)).collect();
        let columns: Vec<ExactVector> =
            (0..9).map(|k| vectors.iter().map(|v| v[k].clone()).collect()).collect();
        Self { equations: relations(&columns) }
    }

    /// The equations for the partners of a point of a body: one row each.
    fn matrix(&self, body: Body, point: &ExactVector) -> Vec<ExactVector> {
        let entry = |e: &ExactVector, free: usize| {
            let terms = (0..3).map(|k| {
                let at = if body == Body::Base { 3 * k + free } else { 3 * free + k };
                &e[at] * &point[k]
            });
            terms.fold(integer(0), |sum, x| sum + x)
        };
        self.equations.iter().map(|e| (0..3).map(|free| entry(e, free)).collect()).collect()
    }

    fn determinant(&self, body: Body, point: &ExactVector) -> Rational {
        let m = self.matrix(body, point);
        let minor = |i: usize, j: usize| &m[1][i] * &m[2][j] - &m[1][j] * &m[2][i];
        &m[0][0] * minor(1, 2) - &m[0][1] * minor(0, 2) + &m[0][2] * minor(0, 1)
    }

    /// Points that span the partners of a point, which has coordinates `(1, x, y, 0)`.
    pub(super) fn partners(&self, body: Body, point: &ExactVector) -> Vec<ExactVector> {
        let m = self.matrix(body, point);
        let columns: Vec<ExactVector> =
            (0..3).map(|k| m.iter().map(|row| row[k].clone()).collect()).collect();
        let spatial = |mut x: ExactVector| {
            x.push(integer(0));
            x
        };
        relations(&columns).into_iter().map(spatial).collect()
    }

    /// Finite points of the cubic on the line through two of its points, other than these two.
    fn chord(&self, body: Body, p: &ExactVector, q: &ExactVector) -> Vec<ExactVector> {
        let at = |t: Rational| -> ExactVector { p.iter().zip(q).map(|(x, y)| x + &t * y).collect() };
        // det M(p + t q) = c1 t + c2 t^2
        let (plus, minus) =
            (self.determinant(body, &at(integer(1))), self.determinant(body, &at(integer(-1))));
        let (linear, square) = (&plus - &minus, &plus + &minus);
        let zero = integer(0);
        let all = if linear == zero && square == zero {
            vec![at(integer(1)), at(integer(3))]
        } else if linear == zero || square == zero {
            Vec::new()
        } else {
            vec![at(-(linear / square))]
        };
        all.iter().filter_map(finite).collect()
    }

    /// The six legs, and legs from chords of the two cubics through joints, those with the shorter numbers first.
    pub(super) fn legs(&self, sample: &DesignSample) -> Vec<ExactLeg> {
        let mut out = sample.legs();
        for body in Body::BOTH {
            let joints = sample.joints(body);
            for pair in subsets(joints.len()).filter(|s| s.len() == 2) {
                for point in self.chord(body, &joints[pair[0]], &joints[pair[1]]) {
                    out.extend(self.leg_at(body, &point));
                }
            }
            for joint in joints {
                out.extend(self.leg_at(body, joint));
            }
        }
        let digits = |l: &ExactLeg| {
            let ends = l.base.iter().chain(&l.platform);
            ends.map(|x| x.numer().bits() + x.denom().bits()).max()
        };
        out[6..].sort_by_cached_key(digits);
        out
    }

    /// A leg at a point of a cubic: to its partner, or to one of them.
    fn leg_at(&self, body: Body, point: &ExactVector) -> Option<ExactLeg> {
        let partners: Vec<ExactVector> = self.partners(body, point).iter().filter_map(finite).collect();
        let (first, rest) = partners.split_first()?;
        // weights with sum 1 that no joint has
        let mut end = first.clone();
        for next in rest {
            end = end.iter().zip(next).map(|(x, y)| (integer(5) * x - y) / integer(4)).collect();
        }
        match body {
            Body::Base => leg_through(point, &end),
            Body::Platform => leg_through(&end, point),
        }
    }

    /// Whether each end of the leg has no other partner.
    pub(super) fn alone(&self, leg: &ExactLeg) -> bool {
        self.partners(Body::Base, &leg.base).len() == 1
            && self.partners(Body::Platform, &leg.platform).len() == 1
    }
}

/// Whether five of the legs, including implied ones, lie between the line of two joints of a body and the other plane.
/// Then every point of the line has a line of partners.
pub(super) fn scroll(sample: &DesignSample) -> bool {
    Body::BOTH.into_iter().any(|body| {
        let there = body.other();
        // two legs at a joint of the other body imply one at the intersection of the line of their joints with this
        // line
        let crossing = |pair: &[usize]| {
            let joints = (0..sample.joints(there).len()).map(|k| sample.neighbours(there, k));
            joints.filter(|s| s.len() == 2 && s.iter().all(|k| !pair.contains(k))).count()
        };
        subsets(sample.joints(body).len()).filter(|s| s.len() == 2).any(|pair| {
            pair.iter().map(|k| sample.neighbours(body, *k).len()).sum::<usize>() + crossing(&pair) >= 5
        })
    })
}

/// `alpha (x) beta` without the third coordinates, which are zero.
fn flat(base: &ExactVector, platform: &ExactVector) -> ExactVector {
    base[..3].iter().flat_map(|x| platform[..3].iter().map(move |y| x * y)).collect()
}
