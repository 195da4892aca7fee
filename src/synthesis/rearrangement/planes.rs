//! Replaceable legs between two planes, drawn from the pair of cubics by chords.
//!
//! `M(alpha) beta = 0` are the three equations of the span of six legs. A line through two points of the cubic `det M = 0`
//! meets it once more, so that six rational legs lead to further rational ones.

use super::sample::{ExactLeg, Sample, finite, integer, other, subsets};
use crate::num::exact::{Rational, relations};
use crate::synthesis::components::exact::Exact;
use crate::synthesis::hexagon::Body;

/// The equations of the span of six legs between the planes `z = 0`.
#[derive(Debug, Clone)]
pub(super) struct Planes {
    /// `equations[r][3 i + j]` is the coefficient of `alpha_i beta_j`.
    equations: Vec<Exact>,
}

impl Planes {
    /// Of six legs with independent vectors.
    pub(super) fn of(sample: &Sample) -> Self {
        let vectors: Vec<Exact> = sample.legs().iter().map(|l| flat(&l.base, &l.platform)).collect();
        let columns: Vec<Exact> = (0..9).map(|k| vectors.iter().map(|v| v[k].clone()).collect()).collect();
        Self { equations: relations(&columns) }
    }

    /// The equations for the partners of a point of a body: one row each.
    fn matrix(&self, body: Body, point: &Exact) -> Vec<Exact> {
        let entry = |e: &Exact, free: usize| {
            let terms = (0..3).map(|k| {
                let at = if body == Body::Base { 3 * k + free } else { 3 * free + k };
                &e[at] * &point[k]
            });
            terms.fold(integer(0), |sum, x| sum + x)
        };
        self.equations.iter().map(|e| (0..3).map(|free| entry(e, free)).collect()).collect()
    }

    fn determinant(&self, body: Body, point: &Exact) -> Rational {
        let m = self.matrix(body, point);
        let minor = |i: usize, j: usize| &m[1][i] * &m[2][j] - &m[1][j] * &m[2][i];
        &m[0][0] * minor(1, 2) - &m[0][1] * minor(0, 2) + &m[0][2] * minor(0, 1)
    }

    /// Points that span the partners of a point, which has coordinates `(1, x, y, 0)`.
    pub(super) fn partners(&self, body: Body, point: &Exact) -> Vec<Exact> {
        let m = self.matrix(body, point);
        let columns: Vec<Exact> = (0..3).map(|k| m.iter().map(|row| row[k].clone()).collect()).collect();
        let spatial = |mut x: Exact| {
            x.push(integer(0));
            x
        };
        relations(&columns).into_iter().map(spatial).collect()
    }

    /// Finite points of the cubic on the line through two of its points, other than these two.
    fn chord(&self, body: Body, p: &Exact, q: &Exact) -> Vec<Exact> {
        let at = |t: Rational| -> Exact { p.iter().zip(q).map(|(x, y)| x + &t * y).collect() };
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

    /// The six legs, and legs at chords of the two cubics through joints, those with the shorter numbers first.
    pub(super) fn legs(&self, sample: &Sample) -> Vec<ExactLeg> {
        let mut out = sample.legs();
        for body in [Body::Base, Body::Platform] {
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
    fn leg_at(&self, body: Body, point: &Exact) -> Option<ExactLeg> {
        let partners: Vec<Exact> = self.partners(body, point).iter().filter_map(finite).collect();
        let (first, rest) = partners.split_first()?;
        // weights with sum 1 that no joint has
        let mut end = first.clone();
        for next in rest {
            end = end.iter().zip(next).map(|(x, y)| (integer(5) * x - y) / integer(4)).collect();
        }
        match body {
            Body::Base => ExactLeg::through(point, &end),
            Body::Platform => ExactLeg::through(&end, point),
        }
    }

    /// Whether each end of the leg has the other one as its only partner.
    pub(super) fn alone(&self, leg: &ExactLeg) -> bool {
        self.partners(Body::Base, &leg.base).len() == 1
            && self.partners(Body::Platform, &leg.platform).len() == 1
    }
}

/// Whether five of the legs and of those they imply lie between the line of two joints of a body and the other plane: then every point of
/// the line has a line of partners.
pub(super) fn scroll(sample: &Sample) -> bool {
    [Body::Base, Body::Platform].into_iter().any(|body| {
        let there = other(body);
        // two legs at a joint of the other body imply one at the crossing of the line of their joints with the line in question
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
fn flat(base: &Exact, platform: &Exact) -> Exact {
    base[..3].iter().flat_map(|x| platform[..3].iter().map(move |y| x * y)).collect()
}
