//! Cone angles of legs as functions that are nearly linear in the pose.
//!
//! Let `k` be the axis, `e` a unit vector across it, and `theta` the angle of the leg vector `n` to the axis. The part
//! of `n` across the axis has an angle of at most `delta` to `e`. It is then no longer than `n.e / cos(delta)`, so that
//! for a limit `alpha` below a right angle
//!
//! ```text
//! |n| sin(alpha - theta) = sin(alpha) n.k - cos(alpha) |n across k| >= sin(alpha) n.k - cos(alpha) n.e / cos(delta).
//! ```
//!
//! The right side is linear in the translation and nearly so in the rotation, where the angle itself has a kink and
//! many local minima. The directions `e` all around the axis are covered by sectors.

use super::frame::CellFrame;
use num::interval::Interval;
use num::jet::{Jet, dot};
use platform::geom::enclosed::{IntervalVector, cross};
use platform::geom::{arc_cosine, cosine, degrees, radians, sine};
use platform::manipulator::Manipulator;

/// Directions around an axis: a middle one and a half width, radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sector {
    middle: f64,
    half: f64,
}

/// Sectors at first.
const SECTORS: usize = 8;

/// Sectors overlap by more than the rounding of their middles.
const OVERLAP: f64 = 1e-12;

impl Sector {
    /// The sector of functions without directions.
    pub(super) const ALL: Self = Self { middle: 0.0, half: 0.0 };

    /// Sectors that cover all directions, or the placeholder if none are needed.
    pub(super) fn all(needed: bool) -> Vec<Self> {
        if !needed {
            return vec![Self::ALL];
        }
        let half = std::f64::consts::PI / SECTORS as f64;
        // middles between -pi and pi, where sines are enclosed tightly
        (0..SECTORS)
            .map(|k| Self { middle: half * (2.0 * k as f64 + 1.0) - std::f64::consts::PI, half })
            .collect()
    }

    /// Both sides of an angle of a universal joint: greater and smaller than 0.
    pub(super) fn sides() -> Vec<Self> {
        [1.0, -1.0].map(|middle| Self { middle, half: 0.0 }).to_vec()
    }

    /// Whether it is the side of the greater angles.
    pub(super) fn is_positive(&self) -> bool {
        self.middle > 0.0
    }

    /// Two sectors that cover it.
    pub(super) fn halves(self) -> [Self; 2] {
        let half = 0.5 * self.half;
        [-half, half].map(|x| Self { middle: self.middle + x, half })
    }
}

/// The allowed cone of directions of a leg.
pub(super) struct AllowedCone<'a> {
    m: &'a Manipulator,
    leg: usize,
    /// Whether the axis is that of a joint of the platform and moves with it.
    platform: bool,
    /// Axis and two directions across it, orthonormal; platform frame for a joint of the platform.
    frame: [IntervalVector; 3],
    limit_deg: f64,
    /// `sin` and `cos` of the limit.
    sine: Interval,
    cosine: Interval,
}

/// A value over a cell, with the quantities that convert it to a margin.
pub(super) struct Leaning {
    pub(super) value: Jet,
    /// `n.n`.
    pub(super) square: Interval,
    /// `n.k`.
    pub(super) along: Interval,
    /// Amount by which the width of the sector lowers the value.
    pub(super) loose: f64,
}

impl<'a> AllowedCone<'a> {
    /// `None` for limits of 90 degrees and more, whose allowed directions are not a convex cone.
    pub(super) fn new(
        m: &'a Manipulator,
        leg: usize,
        platform: bool,
        axis: &IntervalVector,
        length: Interval,
        limit_deg: f64,
    ) -> Option<Self> {
        if !(limit_deg < 89.0) {
            return None;
        }
        let mut k = *axis;
        for x in &mut k {
            *x = x.checked_div(length)?;
        }
        // a right-handed frame: the cross product with the coordinate axis that is farthest away, made a unit vector in
        // intervals
        let farthest =
            (0..3).fold(0, |best, j| if k[j].magnitude() < k[best].magnitude() { j } else { best });
        let unit: IntervalVector =
            std::array::from_fn(|j| if j == farthest { Interval::from(1.0) } else { Interval::ZERO });
        let mut first = cross(&k, &unit);
        let norm = (first[0].square() + first[1].square() + first[2].square()).sqrt()?;
        for x in &mut first {
            *x = x.checked_div(norm)?;
        }
        let second = cross(&k, &first);
        let limit = radians(limit_deg);
        Some(Self {
            m,
            leg,
            platform,
            frame: [k, first, second],
            limit_deg,
            sine: sine(limit),
            cosine: cosine(limit),
        })
    }

    /// The right side over a frame; `None` for sectors too wide for it.
    pub(super) fn value(&self, frame: &CellFrame<'_>, sector: &Sector) -> Option<Leaning> {
        let line = frame.leg(self.m, self.leg).line;
        let place = |v: &IntervalVector| if self.platform { frame.turned(v) } else { frame.fixed(v) };
        let middle = Interval::from(sector.middle);
        let (c, s) = (cosine(middle), sine(middle));
        let e: IntervalVector = std::array::from_fn(|k| c * self.frame[1][k] + s * self.frame[2][k]);
        let narrow = cosine(Interval::from(sector.half + OVERLAP));
        let weight = self.cosine.checked_div(narrow).filter(|_| narrow.lo() > 0.0)?;
        let (along, across) = (dot(&line, &place(&self.frame[0])), dot(&line, &place(&e)));
        let value = along.times(self.sine) - across.times(weight);
        let square = line[0].value.square() + line[1].value.square() + line[2].value.square();
        let loose = (1.0 - narrow.lo()) * self.cosine.hi() * across.value.magnitude();
        Some(Leaning { value, square, along: along.value, loose })
    }

    /// A lower bound of the margin, degrees, where the right side is at least `below` over the cell.
    pub(super) fn margin(&self, below: f64, over: &Leaning) -> f64 {
        arc_margin(below, over, self.limit_deg)
    }
}

/// The least angle whose sine, times the root of `square`, is at least `below`. It gives a lower bound of the limit
/// minus the angle, at least the limit minus 180 degrees.
pub(super) fn arc_margin(below: f64, over: &Leaning, limit_deg: f64) -> f64 {
    let limit = Interval::from(limit_deg);
    let least = (limit - Interval::from(180.0)).lo();
    // sines cannot distinguish angles beyond a right angle
    if !(over.along.lo() > 0.0 && over.square.lo() > 0.0 && below.is_finite()) {
        return least;
    }
    let Some(length) = over.square.sqrt() else { return least };
    let length = if below >= 0.0 { length.hi() } else { length.lo() };
    let Some(sine) = Interval::from(below).checked_div(Interval::from(length)) else { return least };
    if sine.lo() < -1.0 {
        return least;
    }
    let right = Interval::from(90.0);
    (right - degrees(arc_cosine(Interval::from(sine.lo().min(1.0))))).lo().max(least)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3, Vector3};
    use num::Rng;
    use platform::geom::{Chart, ChartCell, Pose};

    /// The sector in which a leg leans gives its angle, and no sector gives less.
    #[test]
    fn sectors_give_the_angle_of_the_leg() {
        let mut rng = Rng::new(3);
        for _ in 0..100 {
            let mut joint = || Point3::new(rng.normal(), rng.normal(), 0.2 * rng.normal());
            let base: Vec<_> = (0..6).map(|_| joint()).collect();
            let top: Vec<_> = (0..6).map(|_| joint()).collect();
            let m = Manipulator::try_new(base, top, std::array::from_fn(|i| (i, i))).unwrap();
            let pose = Pose {
                rotation: Rotation3::from_euler_angles(0.3 * rng.normal(), 0.2, 0.1),
                position: Vector3::new(rng.normal(), 0.3, 4.0),
            };
            let axis = Vector3::new(0.3 * rng.normal(), 0.3 * rng.normal(), 1.0);
            let enclosed: IntervalVector = std::array::from_fn(|k| Interval::from(axis[k]));
            let length = (enclosed[0].square() + enclosed[1].square() + enclosed[2].square()).sqrt().unwrap();
            let limit = rng.uniform(10.0, 85.0);
            let cone = AllowedCone::new(&m, 2, false, &enclosed, length, limit).unwrap();
            let chart = Chart::of_pose(&pose);
            let frame = CellFrame::over(&chart, &ChartCell::point([0.0; 6]), false);
            let mut sectors = Sector::all(true);
            for _ in 0..5 {
                sectors = sectors.into_iter().flat_map(Sector::halves).collect();
            }
            let margin = |s: &Sector| {
                let found = cone.value(&frame, s).unwrap();
                cone.margin(found.value.value.lo(), &found)
            };
            let least = sectors.iter().map(margin).fold(f64::INFINITY, f64::min);
            let leg = m.legs()[2];
            let angle = (pose.transform(&leg.platform) - leg.base).angle(&axis).to_degrees();
            assert!(
                least <= limit - angle + 1e-9 && least > limit - angle - 0.03,
                "{least} {}",
                limit - angle
            );
        }
        let k: IntervalVector = [Interval::ZERO, Interval::ZERO, Interval::from(1.0)];
        let m = Manipulator::try_new(
            vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)],
            vec![Point3::origin(), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)],
            [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)],
        );
        assert!(
            AllowedCone::new(&m.unwrap(), 0, false, &k, Interval::from(1.0), 120.0).is_none(),
            "no convex cone"
        );
    }
}
