//! Poses at lengths at which two pairs `(s15, s34)` coincide, from the poses at lengths beside these.
//!
//! Where `P4 P5` is parallel to `P1 P3`, as at home and at every pure translation from there when the platform triangle has its sides parallel to those of the base, the
//! four points lie in a plane, so that a pair of distances belongs to two places of `P6`: a double root of the octic, though the poses are regular. They are
//! simple zeros of three equations in three angles: with two leg lengths each corner of the platform is on a circle about a side of the base, and the corners
//! have three distances.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::lanes::{Corners, Points, dot, separate};
use super::solver::{OcticSolver, Triangle};
use crate::num::batch::{ComplexBatch, LANES};

/// How far beside the lengths wanted those are whose poses are continued, as parts of the squares.
const BESIDE: [f64; 8] = [1e-2, -1e-2, 3e-2, 3e-3, -3e-2, -3e-3, 1e-1, 1e-3];
/// A direction without symmetry.
const ASKEW: [f64; 6] = [0.71, -0.43, 1.0, 0.29, -0.87, 0.53];
/// Newton steps of the continuation, and for the pairs it starts from, which may still be close to each other.
const STEPS: usize = 8;

/// The circle of a corner of the platform about a side of the base, in the frame of the base triangle.
#[derive(Clone, Copy)]
struct Circle {
    /// In the plane of the base.
    centre: [f64; 2],
    /// In that plane, across the side.
    across: [f64; 2],
    /// Negative where no real corner has these distances.
    squared_radius: f64,
}

impl Circle {
    /// Of the points at squared distances `s` from both ends of a side.
    #[inline(always)]
    fn new(ends: [[f64; 2]; 2], s: [f64; 2]) -> Self {
        let [a, b] = ends;
        let side = [b[0] - a[0], b[1] - a[1]];
        let length = (side[0] * side[0] + side[1] * side[1]).sqrt();
        let along = [side[0] / length, side[1] / length];
        let foot = 0.5 * (s[0] + length * length - s[1]) / length;
        Self {
            centre: [a[0] + foot * along[0], a[1] + foot * along[1]],
            across: [-along[1], along[0]],
            squared_radius: s[0] - foot * foot,
        }
    }
}

/// A corner on its circle: across the side in the plane, and above the plane.
type OnCircle = [ComplexBatch; 2];

/// `|P - Q|^2 - d` for corners on two circles, and its derivatives by the two angles.
#[inline(always)]
fn gap(p: &Circle, [h, z]: &OnCircle, q: &Circle, [k, w]: &OnCircle, d: f64) -> [ComplexBatch; 3] {
    let between = [p.centre[0] - q.centre[0], p.centre[1] - q.centre[1]];
    let dot = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[0] + a[1] * b[1];
    let constant = dot(&between, &between) + p.squared_radius + q.squared_radius - d;
    let (a, b) = (2.0 * dot(&between, &p.across), -2.0 * dot(&between, &q.across));
    let n = 2.0 * dot(&p.across, &q.across);
    let by_h = k.times(-n).plus(a);
    let by_k = h.times(-n).plus(b);
    let value = (*h * by_h + k.times(b) - (*z * *w).times(2.0)).plus(constant);
    let by_first = ComplexBatch::ZERO - *z * by_h - (*h * *w).times(2.0);
    let by_second = ComplexBatch::ZERO - *w * by_k - (*z * *k).times(2.0);
    [value, by_first, by_second]
}

impl OcticSolver {
    /// The corners, continued from lengths beside; `None` unless these are eight separate poses.
    #[inline(always)]
    pub(super) fn corners_from_beside(&self, scaled: &[f64; 6]) -> Option<Corners> {
        for part in BESIDE {
            let mut beside = *scaled;
            for i in 0..6 {
                beside[i] *= 1.0 + part * ASKEW[i];
            }
            // near each other they may be known with few digits: the continuation judges
            if let Some((x, y, _)) = self.pairs(&beside, STEPS) {
                let found = self.continued(&self.corners(&beside, x, y), &beside, scaled);
                if found.is_some() {
                    return found;
                }
            }
        }
        None
    }

    /// Legs in the order s14 s24 s25 s35 s36 s16.
    #[inline(always)]
    fn circles(&self, s: &[f64; 6]) -> [Circle; 3] {
        let Triangle { b, u, v, .. } = self.base;
        let corners = [[0.0, 0.0], [b, 0.0], [u, v]];
        [
            Circle::new([corners[0], corners[1]], [s[0], s[1]]),
            Circle::new([corners[1], corners[2]], [s[2], s[3]]),
            Circle::new([corners[2], corners[0]], [s[4], s[5]]),
        ]
    }

    #[inline(always)]
    fn continued(&self, corners: &[Points; 3], from: &[f64; 6], to: &[f64; 6]) -> Option<Corners> {
        let (before, circles) = (self.circles(from), self.circles(to));
        let t = &self.platform;
        let (d45, d46) = (t.b * t.b, t.u * t.u + t.v * t.v);
        let d56 = (t.u - t.b) * (t.u - t.b) + t.v * t.v;
        let mut places = [[ComplexBatch::ZERO; 2]; 3];
        for k in 0..3 {
            let Circle { centre, across, squared_radius } = before[k];
            let ratio = circles[k].squared_radius / squared_radius;
            if !(ratio > 0.0) {
                return None;
            }
            let [x, y, z] = corners[k];
            let h = x.plus(-centre[0]).times(across[0]) + y.plus(-centre[1]).times(across[1]);
            places[k] = [h.times(ratio.sqrt()), z.times(ratio.sqrt())];
        }
        let mut moved = [0.0; LANES];
        for _ in 0..STEPS {
            let [p, q, r] = places;
            let [e1, a4, a5] = gap(&circles[0], &p, &circles[1], &q, d45);
            let [e2, b5, b6] = gap(&circles[1], &q, &circles[2], &r, d56);
            let [e3, c6, c4] = gap(&circles[2], &r, &circles[0], &p, d46);
            // Cramer's rule; the angles decrease by these
            let inverse = (a4 * b5 * c6 + a5 * b6 * c4).reciprocal();
            let inner = e2 * c6 - b6 * e3;
            let turns = [
                (e1 * b5 * c6 - a5 * inner) * inverse,
                (a4 * inner + e1 * b6 * c4) * inverse,
                (a4 * b5 * e3 + a5 * e2 * c4 - e1 * b5 * c4) * inverse,
            ];
            moved = [0.0; LANES];
            for k in 0..3 {
                let ([h, z], turn) = (places[k], turns[k]);
                // back to the circle
                let norm = (turn * turn).plus(1.0).sqrt().reciprocal();
                places[k] = [(h + turn * z) * norm, (z - turn * h) * norm];
                let size = turn.norm_sqr();
                for l in 0..LANES {
                    moved[l] += size[l];
                }
            }
        }
        let mut settled = true;
        for m in moved {
            settled &= m <= 1e-20;
        }
        if !(settled && separate(&[places[0][0], places[1][0], places[2][0]])) {
            return None;
        }
        let mut out = [[ComplexBatch::ZERO; 3]; 3];
        for k in 0..3 {
            let (Circle { centre, across, .. }, [h, z]) = (circles[k], places[k]);
            out[k] = [h.times(across[0]).plus(centre[0]), h.times(across[1]).plus(centre[1]), z];
        }
        let Triangle { u, v, .. } = self.base;
        let [p4, p5, _] = out;
        let from_p3 = [p4[0].plus(-u), p4[1].plus(-v), p4[2]];
        Some((out, dot(&p5, &p5), dot(&from_p3, &from_p3)))
    }
}
