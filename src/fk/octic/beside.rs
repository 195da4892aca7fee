//! The three angles of the corners. They make roughly known poses exact, and they lead from neighbouring lengths to
//! lengths at which two pairs `(s15, s34)` coincide.
//!
//! With two leg lengths each corner of the platform is on a circle about a side of the base. The three distances of the
//! corners are three equations in three angles, of low degree. They keep the digits that the closures in two distances
//! lose by cancellation.
//!
//! Two poses share their pair of distances when `P4 P5` is parallel to `P1 P3`. The four points then lie in a plane,
//! and a pair of distances belongs to two places of `P6`. This happens at home, and at every pure translation from
//! there, when the platform triangle has its sides parallel to those of the base. The octic has a double root there,
//! though the poses are regular, and simple zeros of the three equations.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::lanes::{Corners, Points, dot, separate};
use super::solver::{FramedTriangle, OcticSolver};
use num::batch::{ComplexBatch, LANES};

/// Newton steps of the angles at most.
const STEPS: usize = 8;

/// The circle of a corner of the platform about a side of the base, in the frame of the base triangle.
#[derive(Clone, Copy)]
struct OcticCircle {
    /// Centre in the plane of the base.
    centre: [f64; 2],
    /// Unit vector across the side in that plane.
    across: [f64; 2],
    /// Negative where no real corner has these distances.
    squared_radius: f64,
}

impl OcticCircle {
    /// The circle of the points at squared distances `s` from both ends of a side.
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

/// A corner on its circle: `h + i z` and `h - i z`, with `h` across the side in the plane and `z` above the plane.
/// Their product is the squared radius, and each has all its digits.
type OnCircle = [ComplexBatch; 2];

/// `|P - Q|^2 - d` for corners on two circles, and its derivatives by the logarithms of both `h + i z`.
#[inline(always)]
fn gap(p: &OcticCircle, [u, v]: &OnCircle, q: &OcticCircle, [k, l]: &OnCircle, d: f64) -> [ComplexBatch; 3] {
    let between = [p.centre[0] - q.centre[0], p.centre[1] - q.centre[1]];
    let dot = |a: &[f64; 2], b: &[f64; 2]| a[0] * b[0] + a[1] * b[1];
    let constant = dot(&between, &between) + p.squared_radius + q.squared_radius - d;
    let (a, b) = (dot(&between, &p.across), -dot(&between, &q.across));
    let cosine = dot(&p.across, &q.across);
    let (same, other) = (0.5 - 0.5 * cosine, 0.5 + 0.5 * cosine);
    let (uk, vl, ul, vk) = (*u * *k, *v * *l, *u * *l, *v * *k);
    let (along, crosswise) = ((uk - vl).times(same), (ul - vk).times(other));
    let value = (*u + *v).times(a) + (*k + *l).times(b) + (uk + vl).times(same) - (ul + vk).times(other);
    let (first, second) = ((*u - *v).times(a) + along - crosswise, (*k - *l).times(b) + along + crosswise);
    [value.plus(constant), first, second]
}

/// By the distances across the sides, which are those of the mirror image too.
#[inline(always)]
fn are_separate(places: &[OnCircle; 3]) -> bool {
    let mut across = [ComplexBatch::ZERO; 3];
    for k in 0..3 {
        across[k] = places[k][0] + places[k][1];
    }
    separate(&across)
}

impl OcticSolver {
    /// Legs in the order s14 s24 s25 s35 s36 s16.
    #[inline(always)]
    fn circles(&self, s: &[f64; 6]) -> [OcticCircle; 3] {
        let FramedTriangle { b, u, v, .. } = self.base;
        let corners = [[0.0, 0.0], [b, 0.0], [u, v]];
        [
            OcticCircle::new([corners[0], corners[1]], [s[0], s[1]]),
            OcticCircle::new([corners[1], corners[2]], [s[2], s[3]]),
            OcticCircle::new([corners[2], corners[0]], [s[4], s[5]]),
        ]
    }

    /// Places of the corners on their circles, from the larger of `h + i z` and `h - i z`.
    #[inline(always)]
    fn on_circles(circles: &[OcticCircle; 3], corners: &[Points; 3]) -> [OnCircle; 3] {
        let mut places = [[ComplexBatch::ZERO; 2]; 3];
        for k in 0..3 {
            let OcticCircle { centre, across, squared_radius } = circles[k];
            let [x, y, z] = corners[k];
            let h = x.plus(-centre[0]).times(across[0]) + y.plus(-centre[1]).times(across[1]);
            let iz = z.times_i();
            let (u, v) = (h + iz, h - iz);
            let (nu, nv) = (u.norm_sqr(), v.norm_sqr());
            let mut first = [false; LANES];
            for l in 0..LANES {
                first[l] = nu[l] >= nv[l];
            }
            let other = u.select(v, first).reciprocal().times(squared_radius);
            places[k] = [u.select(other, first), other.select(v, first)];
        }
        places
    }

    /// The corners at these places, with `(s15, s34)`.
    #[inline(always)]
    fn off_circles(&self, circles: &[OcticCircle; 3], places: &[OnCircle; 3]) -> Corners {
        let mut out = [[ComplexBatch::ZERO; 3]; 3];
        for k in 0..3 {
            let (OcticCircle { centre, across, .. }, [u, v]) = (circles[k], places[k]);
            let (h, z) = ((u + v).times(0.5), (v - u).times_i().times(0.5));
            out[k] = [h.times(across[0]).plus(centre[0]), h.times(across[1]).plus(centre[1]), z];
        }
        let FramedTriangle { u, v, .. } = self.base;
        let [p4, p5, _] = out;
        let from_p3 = [p4[0].plus(-u), p4[1].plus(-v), p4[2]];
        (out, dot(&p5, &p5), dot(&from_p3, &from_p3))
    }

    #[inline(always)]
    fn turned(&self, circles: &[OcticCircle; 3], mut places: [OnCircle; 3]) -> Option<[OnCircle; 3]> {
        let t = &self.platform;
        let (d45, d46) = (t.b * t.b, t.u * t.u + t.v * t.v);
        let d56 = (t.u - t.b) * (t.u - t.b) + t.v * t.v;
        for _ in 0..STEPS {
            let [p, q, r] = places;
            let [e1, a4, a5] = gap(&circles[0], &p, &circles[1], &q, d45);
            let [e2, b5, b6] = gap(&circles[1], &q, &circles[2], &r, d56);
            let [e3, c6, c4] = gap(&circles[2], &r, &circles[0], &p, d46);
            // Cramer's rule; the logarithms decrease by these
            let inverse = (a4 * b5 * c6 + a5 * b6 * c4).reciprocal();
            let inner = e2 * c6 - b6 * e3;
            let turns = [
                (e1 * b5 * c6 - a5 * inner) * inverse,
                (a4 * inner + e1 * b6 * c4) * inverse,
                (a4 * b5 * e3 + a5 * e2 * c4 - e1 * b5 * c4) * inverse,
            ];
            let mut moved = [0.0; LANES];
            for k in 0..3 {
                let turn = turns[k];
                // near exp(-turn), and its modulus 1 where that of exp(-turn) is
                let half = turn.times(0.5);
                let factor = (half.times(-1.0).plus(1.0)) * half.plus(1.0).reciprocal();
                let u = places[k][0] * factor;
                places[k] = [u, u.reciprocal().times(circles[k].squared_radius)];
                let size = turn.norm_sqr();
                for l in 0..LANES {
                    moved[l] += size[l];
                }
            }
            if moved.iter().all(|m| *m <= 1e-20) {
                return Some(places);
            }
        }
        None
    }

    /// Newton's method in the three angles, from corners known roughly, for other squared lengths where `from` says so.
    /// `None` unless it settles, on eight separate poses.
    #[inline(always)]
    pub(super) fn continued(
        &self,
        corners: &[Points; 3],
        from: Option<&[f64; 6]>,
        to: &[f64; 6],
    ) -> Option<Corners> {
        let circles = self.circles(to);
        let before = from.map_or(circles, |from| self.circles(from));
        let mut places = Self::on_circles(&before, corners);
        if from.is_some() {
            for k in 0..3 {
                let ratio = circles[k].squared_radius / before[k].squared_radius;
                if !(ratio > 0.0) {
                    return None;
                }
                let [u, v] = places[k];
                places[k] = [u.times(ratio.sqrt()), v.times(ratio.sqrt())];
            }
        }
        let places = self.turned(&circles, places)?;
        are_separate(&places).then(|| self.off_circles(&circles, &places))
    }
}
