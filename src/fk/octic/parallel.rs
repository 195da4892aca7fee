//! Orientations in which sides of both triangles are parallel, as at home: there pairs `(s15, s34)` coincide, and half
//! of the poses are known from one.
//!
//! When `P4 P5` is parallel to `P1 P3` these four points lie in a plane, at every translation. The mirror image of `P6`
//! in that plane has the same distances to all four. So two poses share their pair, a double root of the octic, though
//! both are regular. At home and at pure translations of most octahedral platforms all sides are parallel. Then the
//! same is true of `P4` and the plane `P1 P2 P5 P6`, with the same `s15`, and of `P5` and the plane `P2 P3 P4 P6`. The
//! root is triple, and the octic divided by the known factor is a quartic.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use super::lanes::{COARSE, LEGS, Points};
use super::solver::FramedTriangle;
use num::batch::{ComplexBatch, LANES};
use num::poly::roots_in_lanes;

/// Largest relative distance of squared lengths from those of a translation for a start from there. Three roots of the
/// octic coincide at the translation, and still differ only by the cube root of this distance beside it. Ten times
/// farther the continuation fails too often to be worth its time.
const NEAR: f64 = 1e-3;
/// Sides with a smaller angle count as parallel. This only decides where Newton's method begins.
const PARALLEL: f64 = 1e-4;

/// A vector in the plane of the base.
type Flat = [f64; 2];

#[inline(always)]
fn dot(a: Flat, b: Flat) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

#[inline(always)]
fn minus(a: Flat, b: Flat) -> Flat {
    [a[0] - b[0], a[1] - b[1]]
}

/// A corner of the platform that has a mirror image with the same distances. The mirror is the plane through another
/// corner and a side of the base that starts in a foot.
#[derive(Debug, Clone, Copy)]
struct MirrorCorner {
    corner: usize,
    foot: Flat,
    /// Across the side, of length one.
    across: Flat,
    other: usize,
}

/// An orientation with both triangles in parallel planes and `P4 P5` parallel to `P1 P3`.
///
/// With `d` the vectors in the plane from base to platform joints for `P4` in `P1`, a translation by `t` has
/// `s = |t|^2 + 2 t.d + |d|^2`. Without `|d|^2` these six squared lengths are combinations of `1`, `d_x` and `d_y`,
/// whose factors are the translation.
#[derive(Debug, Clone)]
pub(super) struct ParallelSides {
    /// Corners of the platform from `P4`.
    heads: [Flat; 3],
    d: [Flat; 6],
    middle: Flat,
    /// `2 t` is these times the squared lengths less `|d|^2`.
    factors: [[f64; 6]; 2],
    mirrors: [MirrorCorner; 3],
    /// The number of valid mirrors: one, or three when all sides are parallel.
    mirrored: usize,
}

/// A translation: `P4` in the frame of the base triangle, with the square of its height.
#[derive(Debug, Clone, Copy)]
pub(super) struct Translation<'a> {
    sides: &'a ParallelSides,
    foot: Flat,
    squared_height: f64,
}

impl ParallelSides {
    /// Both directions along `P1 P3`, with either side of the platform above.
    pub(super) fn all(base: &FramedTriangle, platform: &FramedTriangle) -> [Self; 4] {
        let feet = [[0.0, 0.0], [base.b, 0.0], [base.u, base.v]];
        let along = unit(feet[2]);
        [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)].map(|(forth, left)| {
            let corner = |x: f64, y: f64| {
                let (x, y) = (x * forth, y * left);
                [along[0] * x - along[1] * y, along[1] * x + along[0] * y]
            };
            let heads = [[0.0, 0.0], corner(platform.b, 0.0), corner(platform.u, platform.v)];
            Self::of(feet, heads)
        })
    }

    fn of(feet: [Flat; 3], heads: [Flat; 3]) -> Self {
        let d = LEGS.map(|(foot, head)| minus(heads[head], feet[foot]));
        let middle = [0, 1].map(|i| d.iter().map(|d| d[i]).sum::<f64>() / 6.0);
        let spread = d.map(|d| minus(d, middle));
        // least squares; not finite where the vectors lie on a line, and then no lengths are near
        let gram = |i: usize, j: usize| spread.iter().map(|e| e[i] * e[j]).sum::<f64>();
        let (xx, xy, yy) = (gram(0, 0), gram(0, 1), gram(1, 1));
        let inverse = (xx * yy - xy * xy).recip();
        let factors = [
            spread.map(|e| (yy * e[0] - xy * e[1]) * inverse),
            spread.map(|e| (xx * e[1] - xy * e[0]) * inverse),
        ];
        let mirror = |corner: usize, [from, to]: [usize; 2], other: usize| {
            let [x, y] = unit(minus(feet[to], feet[from]));
            MirrorCorner { corner, foot: feet[from], across: [-y, x], other }
        };
        let mirrors = [mirror(2, [0, 2], 0), mirror(0, [0, 1], 1), mirror(1, [1, 2], 2)];
        let parallel = |m: &MirrorCorner, to: usize| {
            let side = minus(heads[to], heads[m.other]);
            dot(m.across, side).abs() <= PARALLEL * dot(side, side).sqrt()
        };
        let all = parallel(&mirrors[1], 2) && parallel(&mirrors[2], 0);
        Self { heads, d, middle, factors, mirrors, mirrored: if all { 3 } else { 1 } }
    }

    /// The translation whose squared lengths are near these, in the order s14 s24 s25 s35 s36 s16.
    #[inline(always)]
    pub(super) fn translation(&self, s: &[f64; 6]) -> Option<Translation<'_>> {
        let mut given = *s;
        for (k, d) in self.d.iter().enumerate() {
            given[k] -= dot(*d, *d);
        }
        let (mut twice, mut mean, mut size) = ([0.0; 2], 0.0, 0.0);
        for k in 0..6 {
            twice = [twice[0] + self.factors[0][k] * given[k], twice[1] + self.factors[1][k] * given[k]];
            mean += given[k];
            size += s[k] * s[k];
        }
        let square = mean / 6.0 - dot(twice, self.middle);
        let mut rest = 0.0;
        for k in 0..6 {
            let error = given[k] - square - dot(twice, self.d[k]);
            rest += error * error;
        }
        let foot = [0.5 * twice[0], 0.5 * twice[1]];
        let near = rest <= NEAR * NEAR * size;
        near.then(|| Translation { sides: self, foot, squared_height: square - dot(foot, foot) })
    }
}

fn unit(a: Flat) -> Flat {
    let length = dot(a, a).sqrt();
    [a[0] / length, a[1] / length]
}

impl Translation<'_> {
    /// A little beside, in parts of the distance from base to platform.
    #[inline(always)]
    pub(super) fn shifted(self, [x, y, z]: [f64; 3]) -> Self {
        let distance = (dot(self.foot, self.foot) + self.squared_height).abs().sqrt();
        let foot = [self.foot[0] + x * distance, self.foot[1] + y * distance];
        Self { foot, squared_height: self.squared_height * (1.0 + z), ..self }
    }

    /// Its squared lengths, in the order s14 s24 s25 s35 s36 s16.
    #[inline(always)]
    pub(super) fn squared_lengths(&self) -> [f64; 6] {
        let mut s = [self.squared_height; 6];
        for k in 0..6 {
            let d = self.sides.d[k];
            let leg = [self.foot[0] + d[0], self.foot[1] + d[1]];
            s[k] += dot(leg, leg);
        }
        s
    }

    /// A corner: its place in the plane, and its height as a part of the platform's.
    #[inline(always)]
    fn corner(&self, k: usize) -> (Flat, f64) {
        let head = self.sides.heads[k];
        ([self.foot[0] + head[0], self.foot[1] + head[1]], 1.0)
    }

    /// A corner and its mirror image, see [`MirrorCorner`].
    #[inline(always)]
    fn mirrored(&self, m: &MirrorCorner) -> (Flat, f64) {
        let ((p, _), (other, _)) = (self.corner(m.corner), self.corner(m.other));
        // across the side, where all of the plane's other corners are, and how far from there the corner is
        let c = dot(minus(other, m.foot), m.across);
        let w = dot(minus(p, other), m.across);
        let tilt = 2.0 * w / (c * c + self.squared_height);
        let back = self.squared_height * tilt;
        ([p[0] - back * m.across[0], p[1] - back * m.across[1]], 1.0 + c * tilt)
    }

    /// `s15` of the poses that are not known; the other lanes, from the last on, belong to those that are.
    #[inline(always)]
    pub(super) fn other_roots(&self, octic: &[f64; LANES + 1]) -> Option<ComplexBatch> {
        let square = |(p, height): (Flat, f64)| dot(p, p) + height * height * self.squared_height;
        let shared = square(self.corner(1));
        let mut c = *octic;
        divide(&mut c[..], shared);
        divide(&mut c[1..], shared);
        if self.sides.mirrored == 1 {
            return roots_in_lanes::<6>(&c[2..], COARSE);
        }
        divide(&mut c[2..], shared);
        divide(&mut c[3..], square(self.mirrored(&self.sides.mirrors[2])));
        roots_in_lanes::<4>(&c[4..], COARSE)
    }

    /// The corners of the poses that are known, into the last lanes.
    #[inline(always)]
    pub(super) fn put(&self, places: &mut [Points; 3]) {
        let size = self.squared_height.abs().sqrt();
        let above = |(p, height): (Flat, f64)| [p[0], p[1], height * size];
        let plain = [above(self.corner(0)), above(self.corner(1)), above(self.corner(2))];
        let mut known = [plain; 4];
        for k in 0..3 {
            let m = &self.sides.mirrors[k];
            known[k + 1][m.corner] = above(self.mirrored(m));
        }
        let imaginary = self.squared_height < 0.0;
        for (lane, corners) in known[..=self.sides.mirrored].iter().enumerate() {
            let lane = LANES - 1 - lane;
            for k in 0..3 {
                for i in 0..3 {
                    let (re, im) =
                        if imaginary && i == 2 { (0.0, corners[k][i]) } else { (corners[k][i], 0.0) };
                    (places[k][i].re[lane], places[k][i].im[lane]) = (re, im);
                }
            }
        }
    }
}

/// Divides a polynomial, given from the constant term up, by `x - root`. The remainder takes the place of the constant
/// term, the quotient that of the other terms.
#[inline(always)]
fn divide(c: &mut [f64], root: f64) {
    for k in (1..c.len()).rev() {
        c[k - 1] += root * c[k];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::OcticSolver;
    use nalgebra::{Point3, Rotation3, Vector3};
    use num::Rng;
    use platform::geom::Pose;
    use platform::manipulator::Manipulator;

    const ZERO: Points = [ComplexBatch::ZERO; 3];

    /// Largest error of the nine distances of `P4, P5, P6` in a lane, over the largest squared length.
    fn error(solver: &OcticSolver, s: &[f64; 6], places: &[Points; 3], lane: usize) -> f64 {
        let FramedTriangle { b, u, v, .. } = solver.base;
        let feet = [[0.0, 0.0], [b, 0.0], [u, v]];
        let t = &solver.platform;
        let sides =
            [(0, 1, t.b * t.b), (0, 2, t.u * t.u + t.v * t.v), (1, 2, (t.u - t.b).powi(2) + t.v * t.v)];
        let square = |d: Points| (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).lane(lane);
        let legs = LEGS.into_iter().zip(s).map(|((foot, head), s)| {
            let [x, y, z] = places[head];
            (square([x.plus(-feet[foot][0]), y.plus(-feet[foot][1]), z]) - s).norm()
        });
        let sides = sides.into_iter().map(|(i, j, d)| {
            let (p, q) = (&places[i], &places[j]);
            (square([p[0] - q[0], p[1] - q[1], p[2] - q[2]]) - d).norm()
        });
        legs.chain(sides).fold(0.0, f64::max) / s.iter().fold(0.0, |m: f64, s| m.max(*s))
    }

    /// Base triangle, platform triangle, legs to the ends of a side from the corner beside it.
    fn solver(base: [Flat; 3], platform: [Flat; 3]) -> (Manipulator, OcticSolver) {
        let points = |t: [Flat; 3]| t.map(|p| Point3::new(p[0], p[1], 0.0)).to_vec();
        let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let m = Manipulator::try_new(points(base), points(platform), legs).unwrap();
        let solver = OcticSolver::new(&m).unwrap();
        (m, solver)
    }

    #[test]
    fn poses_known_at_a_translation_have_all_distances() {
        let base = [[0.3, -1.0], [4.0, 5.5], [9.0, -2.0]];
        let middle = |i: usize, j: usize| [0, 1].map(|k| 0.4 * (base[i][k] + base[j][k]));
        let similar = [middle(0, 1), middle(1, 2), middle(2, 0)];
        // one side parallel only
        let bent = [similar[0], similar[1], [similar[2][0] + 1.0, similar[2][1] - 0.3]];
        let mut rng = Rng::new(5);
        for (platform, known) in [(similar, 4), (bent, 2)] {
            let (m, solver) = solver(base, platform);
            let mut solved = 0;
            for k in 0..40 {
                let position = Vector3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), 6.0);
                let turn = Rotation3::new(Vector3::z() * if k == 0 { 0.1 } else { 0.0 });
                let s = Pose { rotation: turn, position }.squared_lengths(&m).unwrap();
                let s = solver.scaled(&s);
                let found: Vec<Translation> =
                    solver.parallel.iter().filter_map(|sides| sides.translation(&s)).collect();
                if k == 0 {
                    // negative control: turned about the vertical it is no translation
                    assert!(found.is_empty());
                    continue;
                }
                assert_eq!(found.len(), 1, "{k}");
                assert_eq!(found[0].sides.mirrored + 1, known);
                let mut places = [ZERO; 3];
                found[0].put(&mut places);
                for lane in 0..LANES {
                    let is_known = lane >= LANES - known;
                    let error = error(&solver, &s, &places, lane);
                    assert!(if is_known { error < 1e-12 } else { error > 1e-3 }, "{k}, {lane}: {error}");
                }
                // and the first start leads to all of them, but for a few near singular poses
                let start = solver.starts(&s).next().unwrap();
                let near = solver.start(&start, &s);
                let near = near.and_then(|near| solver.continued(&near, start.beside.as_ref(), &s));
                solved += usize::from(near.is_some());
            }
            assert!(solved >= 36, "{solved} of 39 from what is known");
        }
    }
}
