//! The largest box of poses around home in which the Jacobian is proved to be regular.
//!
//! Poses are `R = Cay(c) R_0`, `p = p_0 + d` with
//!
//! ```text
//! Cay(c) = I + 2 / (1 + c.c) ([c]x + [c]x^2),   c = tan(angle / 2) axis,
//! ```
//!
//! a box is `|d_k| <= t D_k`, `|c_k| <= tan(t theta_k / 2)` with half widths `D_k` (design units) and `theta_k` (radians) that fix its
//! shape, and `t` is sought. The box of Cayley parameters holds every rotation by at most `t min theta_k` about any axis. From below: boxes in which `det J != 0` is proved by interval arithmetic
//! ([`enclosure`]), added shell by shell. From above: a pose at which `det J` has the other sign; the segment in `(d, c)` from home to it stays in the box and
//! holds a singular pose ([`rays`]).
//!
//! `J` is the matrix of leg lines that are not divided by the leg lengths, so that for a leg map `det J' = det A det J` at every pose: the
//! box is that of all equivalent platforms.

mod enclosure;
mod rays;

use nalgebra::{Rotation3, UnitQuaternion, Vector3};

use crate::geom::Pose;
use crate::manipulator::Manipulator;
use enclosure::{Lines, Region};

/// What box is sought, and how hard.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoxOptions {
    /// Half widths `D_k` of the translations at `t = 1`, base frame, design units; not negative.
    pub translation: [f64; 3],
    /// Half widths `theta_k` of the rotations at `t = 1`, about the axes of the base frame, radians; not negative.
    pub rotation: [f64; 3],
    /// Most regions to test.
    pub regions: usize,
    /// Stop when the proved scale is at least this part of the refuted one, below 1.
    pub enough: f64,
    /// Seed of the search for singular poses.
    pub seed: u64,
}

/// The largest box found.
#[derive(Debug, Clone, PartialEq)]
pub struct RegularBox {
    /// Proved: no singular pose for scales up to this; 0 when not even home is proved regular.
    pub proved: f64,
    /// Proved: a singular pose at this scale or below; `None` when none was found up to [`RegularBox::searched`].
    pub refuted: Option<SingularSegment>,
    /// Scale up to which singular poses were looked for. Half-turns end the box of Cayley parameters.
    pub searched: f64,
    /// Regions tested.
    pub regions: usize,
}

/// A segment of poses with a singular one on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularSegment {
    /// Scale of the smallest box that holds the segment.
    pub scale: f64,
    /// `(d / size, c)` of its far end; home is the other end, `det J` has opposite signs at the two.
    pub end: [f64; 6],
    /// The pose of the far end, rounded.
    pub pose: Pose,
}

/// The largest regular box of the shape given by `options` about `home`.
///
/// The rotation of `home` is that of its quaternion, exactly. The answer brackets the largest scale: `proved <= t <= refuted.scale`.
#[must_use]
pub fn regular_box(m: &Manipulator, home: &Pose, options: &BoxOptions) -> RegularBox {
    let lines = Lines::new(m, home);
    let shape = Shape::new(m.size(), options);
    let searched = shape.largest();
    let mut state = Search { lines: &lines, shape: &shape, left: options.regions, refuted: None };
    if !lines.is_regular(&Region::POINT) {
        return RegularBox { proved: 0.0, refuted: None, searched, regions: 1 };
    }
    state.refuted = rays::nearest_change(&lines, &shape, options.seed);
    let mut proved = 0.0;
    // shells thin out towards the singular pose, where regions get small
    let mut part = 0.5;
    while part < 1.0 && proved < options.enough * state.limit() {
        let next = part * state.limit();
        if next > proved {
            match state.shell(proved, next) {
                Shell::Regular => proved = next,
                Shell::Singular => continue,
                Shell::Undecided => break,
            }
        }
        part = 1.0 - 0.7 * (1.0 - part);
    }
    let refuted =
        state.refuted.map(|(scale, end)| SingularSegment { scale, end, pose: pose_at(home, m.size(), &end) });
    RegularBox { proved, refuted, searched, regions: options.regions - state.left }
}

/// `(R, p)` of `(d / size, c)`.
fn pose_at(home: &Pose, size: f64, q: &[f64; 6]) -> Pose {
    let turn = UnitQuaternion::new_normalize(nalgebra::Quaternion::new(1.0, q[3], q[4], q[5]));
    let rotation = Rotation3::from(turn) * home.rotation;
    Pose { rotation, position: home.position + Vector3::new(q[0], q[1], q[2]) * size }
}

/// Half widths by scale.
#[derive(Debug, Clone)]
pub(super) struct Shape {
    translation: [f64; 3],
    rotation: [f64; 3],
}

impl Shape {
    fn new(size: f64, o: &BoxOptions) -> Self {
        Self { translation: o.translation.map(|x| x / size), rotation: o.rotation }
    }

    /// Half widths at scale `t`, those of translations over the size.
    pub(super) fn half_widths(&self, t: f64) -> [f64; 6] {
        let [x, y, z] = self.translation.map(|d| d * t);
        let [u, v, w] = self.rotation.map(|a| (0.5 * a * t).tan());
        [x, y, z, u, v, w]
    }

    /// The scale searched: translations of 16 sizes or rotations of 170 degrees, whichever comes first.
    pub(super) fn largest(&self) -> f64 {
        let translations = self.translation.iter().map(|d| 16.0 / d);
        let rotations = self.rotation.iter().map(|a| 170f64.to_radians() / a);
        translations.chain(rotations).fold(f64::INFINITY, f64::min)
    }

    /// The smallest scale of a box that holds the point, a little more for rounding.
    pub(super) fn scale_of(&self, q: &[f64; 6]) -> f64 {
        let ratio = |x: f64, full: f64| if x == 0.0 { 0.0 } else { x.abs() / full };
        let moved = (0..3).map(|k| ratio(q[k], self.translation[k]));
        let turned = (0..3).map(|k| ratio(2.0 * q[k + 3].atan(), self.rotation[k]));
        moved.chain(turned).fold(0.0, f64::max) * (1.0 + 1e-12)
    }
}

enum Shell {
    Regular,
    /// A region has a pose with the other sign: the limit is lower now.
    Singular,
    Undecided,
}

struct Search<'a> {
    lines: &'a Lines,
    shape: &'a Shape,
    left: usize,
    /// Scale and end of the segment.
    refuted: Option<(f64, [f64; 6])>,
}

impl Search<'_> {
    fn limit(&self) -> f64 {
        self.refuted.map_or(self.shape.largest(), |r| r.0)
    }

    /// Decides the box of scale `to` less that of scale `from`, by twelve slabs and halving.
    fn shell(&mut self, from: f64, to: f64) -> Shell {
        let (inner, outer) = (self.shape.half_widths(from), self.shape.half_widths(to));
        let mut waiting = slabs(&inner, &outer);
        while let Some(region) = waiting.pop() {
            if self.left == 0 {
                return Shell::Undecided;
            }
            self.left -= 1;
            if self.lines.is_regular(&region) {
                continue;
            }
            let scale = self.shape.scale_of(&region.centre);
            if scale < self.limit() && self.lines.has_other_sign(&region.centre) {
                self.refuted = Some((scale, region.centre));
                return Shell::Singular;
            }
            match region.halves(self.lines.steepest(&region)) {
                Some(parts) => waiting.extend(parts),
                None => return Shell::Undecided,
            }
        }
        Shell::Regular
    }
}

/// Twelve boxes that cover the outer box less the inner one; fewer where axes have no width.
fn slabs(inner: &[f64; 6], outer: &[f64; 6]) -> Vec<Region> {
    let mut out = Vec::new();
    if inner.iter().all(|w| *w == 0.0) {
        return vec![Region::between(&outer.map(|w| -w), outer)];
    }
    for axis in (0..6).filter(|k| outer[*k] > inner[*k]) {
        for side in [-1.0, 1.0] {
            // axes before this one stay inside, those after it are free
            let half = |k: usize| if k < axis { inner[k] } else { outer[k] };
            let mut lo: [f64; 6] = std::array::from_fn(|k| -half(k));
            let mut hi = lo.map(|x| -x);
            let ends = [side * inner[axis], side * outer[axis]];
            (lo[axis], hi[axis]) = (ends[0].min(ends[1]), ends[0].max(ends[1]));
            out.push(Region::between(&lo, &hi));
        }
    }
    out
}

#[cfg(test)]
mod tests;
