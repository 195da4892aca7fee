//! Tilings of a region of poses: cells, on each of which one inequality proves a requirement.
//!
//! Points of the region have coordinates in the cube `[-1, 1]^6`: distances of translation and rotation vector from the
//! middle of the region, over the half widths. Platform points are measured from the pivot, so that the translation
//! moves the pivot alone. A cell with the middle `z` and half widths `h` is proved by the mean value form
//!
//! ```text
//! f(x) >= f(z) - sum_k |c_k| h_k - sum_k r_k h_k,       slopes over the cell within r_k of c_k.
//! ```
//!
//! In an ellipsoid `c.z + |c|`, for translation and rotation each, may replace their part of the first sum. Lengths are
//! linear but for a square: `|n|^2 = |n(z)|^2 + 2 n(z).D + |D|^2` with `D = n - n(z)`.
//!
//! Cells of `det J` are proved by `|I - K J(x)| < 1` with `K` near the inverse of `J(z)`. The bounds of
//! [`prove_telling`](super::prove_telling) need fewer cells; these are so simple that another program can check them.
//! The program `equipod-check` does, with the same formulas in integers.

mod force;
mod pair;

use nalgebra::{Matrix6, Vector3};

use super::{PoseSpace, Region};
use num::interval::{Interval, radians};
use num::vector::{cross, dot, minus};
use platform::geom::enclosed::{IntervalMatrix, IntervalVector, Rotation, apply, exact_rotation, times};
use platform::geom::{cosine, turn, turn_slope};
use platform::manipulator::{Body, Manipulator};

/// Greatest number of cells of a tiling: the program that checks it takes one to thirty milliseconds for a cell.
const MOST_CELLS: usize = 3000;
/// Greatest square of a rotation vector; the coefficients of rotations are monotone up to it.
const LARGEST_TURN: f64 = 20.0;
/// Cells of `det J` are split until the norm is below this, so that another inverse proves them too.
const CONTRACTION: f64 = 0.99;
/// Bounds have to be above zero by this share of their terms, so that other roundings prove them too.
const SLACK: f64 = 1e-9;
/// Weight of the linear part of a function in the choice of the coordinate to split.
const LINEAR: f64 = 0.02;
/// Cells count as outside an ellipsoid if their least norm is above this square.
const OUTSIDE: f64 = 1.0 + 1e-9;

/// A requirement on one leg, with its margin already taken off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LegRequirement {
    /// The length is at least this.
    MinLength(f64),
    /// The length is at most this.
    MaxLength(f64),
    /// The angle between the leg and the axis of its joint on the body is at most this.
    ConeAngle {
        /// The body.
        body: Body,
        /// The axis, body frame.
        axis: Vector3<f64>,
        /// Degrees.
        limit_deg: f64,
    },
}

/// The region of a workspace, ready for tilings.
#[derive(Debug)]
pub struct TiledRegion {
    region: Region,
    home: Rotation,
    /// The pivot, platform frame.
    pivot: Vector3<f64>,
    /// The pivot at home.
    position: IntervalVector,
    /// Middle of translation and rotation vector, measured from home, design units and radians.
    middle: [Interval; 6],
    /// Half widths of the same.
    widths: [Interval; 6],
    base: [IntervalVector; 6],
    /// Platform joints measured from the pivot, rotated to home.
    platform: [IntervalVector; 6],
    /// Length by which moments are divided.
    unit: f64,
}

/// The poses of a cell.
struct Cell {
    rotation: Rotation,
    slopes: [Rotation; 3],
    position: IntervalVector,
}

/// A function that has to be non-negative on a cell.
struct Function {
    /// Its value at the middle.
    value: Interval,
    /// Slopes along the coordinates, over the cell.
    slopes: [Interval; 6],
    /// Norms of changes along the coordinates; the square of their sum is subtracted.
    rest: [f64; 6],
}

/// A cell in coordinates of the cube.
#[derive(Clone, Copy)]
struct Ends {
    low: [f64; 6],
    high: [f64; 6],
}

impl Ends {
    fn middle(&self) -> Self {
        let middle = std::array::from_fn(|k| 0.5 * (self.low[k] + self.high[k]));
        Self { low: middle, high: middle }
    }

    fn half(&self, k: usize) -> f64 {
        0.5 * (self.high[k] - self.low[k])
    }

    /// Least square of the norm of three coordinates.
    fn least_square(&self, first: usize) -> f64 {
        (first..first + 3).map(|k| self.low[k].max(-self.high[k]).max(0.0).powi(2)).sum()
    }
}

/// `None` for a proved cell, otherwise the coordinate along which to split it.
type Split = Option<usize>;

fn step(k: usize) -> IntervalVector {
    std::array::from_fn(|i| if i == k { Interval::from(1.0) } else { Interval::ZERO })
}

fn square_of(v: &IntervalVector) -> Interval {
    v[0].square() + v[1].square() + v[2].square()
}

fn sum(u: &IntervalVector, v: &IntervalVector) -> IntervalVector {
    std::array::from_fn(|i| u[i] + v[i])
}

impl TiledRegion {
    /// `None` for rotations too large for the formulas. A space without region has its home.
    #[must_use]
    pub fn new(m: &Manipulator, space: &PoseSpace) -> Option<Self> {
        let in_units = |k: usize, x: f64| if k < 3 { Interval::from(x) } else { radians(x) };
        let middle: [Interval; 6] = std::array::from_fn(|k| in_units(k, space.middle[k]));
        let widths: [Interval; 6] = std::array::from_fn(|k| {
            in_units(k, if k < 3 { space.translation[k] } else { space.rotation_deg[k - 3] })
        });
        let largest: f64 = (3..6).map(|k| (middle[k].magnitude() + widths[k].magnitude()).powi(2)).sum();
        if largest > 0.99 * LARGEST_TURN {
            return None;
        }
        let home = exact_rotation(&space.home);
        let ends: [[IntervalVector; 2]; 6] = std::array::from_fn(|i| m.enclosed_ends(i));
        let pivot = <[f64; 3]>::from(space.pivot).map(Interval::from);
        let origin = <[f64; 3]>::from(space.home.position).map(Interval::from);
        Some(Self {
            region: space.region,
            home,
            pivot: space.pivot,
            position: sum(&origin, &apply(&home, &pivot)),
            middle,
            widths,
            base: ends.map(|[base, _]| base),
            platform: ends.map(|[_, platform]| apply(&home, &minus(&platform, &pivot))),
            unit: 2f64.powi(m.platform_rms_radius().max(f64::MIN_POSITIVE).log2().round() as i32),
        })
    }

    /// The length by which the moments of leg lines are divided in the tilings of `det J`, design units.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// A tiling that proves a requirement on one leg at every pose of the region; `None` if it is violated or needs too
    /// many cells.
    ///
    /// The text is a binary tree: a digit splits the cell in halves along a coordinate, from 0, and the lower half
    /// follows. A point is a proved cell, an `x` one outside the ellipsoid.
    #[must_use]
    pub fn leg_tiling(&self, leg: usize, required: LegRequirement) -> Option<String> {
        self.tiling(&mut |ends| self.leg_cell(leg, required, ends))
    }

    /// A tiling that proves `det J` nonzero at every pose of the region.
    #[must_use]
    pub fn regular_tiling(&self) -> Option<String> {
        self.tiling(&mut |ends| self.regular_cell(ends))
    }

    fn tiling(&self, prove: &mut dyn FnMut(&Ends) -> Split) -> Option<String> {
        let half = self.widths.map(|w| if w == Interval::ZERO { 0.0 } else { 1.0 });
        let mut open = vec![Ends { low: half.map(|h| -h), high: half }];
        let (mut tree, mut cells) = (String::new(), 0);
        while let Some(ends) = open.pop() {
            if self.is_outside(&ends) {
                tree.push('x');
                continue;
            }
            match prove(&ends) {
                None => {
                    tree.push('.');
                    cells += 1;
                }
                Some(k) if cells + open.len() < MOST_CELLS => {
                    tree.push(char::from(b'0' + k as u8));
                    let middle = ends.middle().low[k];
                    let (mut lower, mut upper) = (ends, ends);
                    (lower.high[k], upper.low[k]) = (middle, middle);
                    open.extend([upper, lower]);
                }
                Some(_) => return None,
            }
        }
        Some(tree)
    }

    fn is_outside(&self, ends: &Ends) -> bool {
        self.region == Region::Ellipsoid && [0, 3].iter().any(|first| ends.least_square(*first) > OUTSIDE)
    }

    fn cell(&self, ends: &Ends) -> Cell {
        let x: [Interval; 6] = std::array::from_fn(|k| {
            let ends = Interval::new(ends.low[k], ends.high[k]).unwrap_or(Interval::WHOLE);
            self.middle[k] + ends * self.widths[k]
        });
        let w = [x[3], x[4], x[5]];
        let position = sum(&self.position, &[x[0], x[1], x[2]]);
        Cell { rotation: turn(&w), slopes: [0, 1, 2].map(|k| turn_slope(&w, k)), position }
    }

    fn leg_cell(&self, leg: usize, required: LegRequirement, ends: &Ends) -> Split {
        let (at, over) = (self.cell(&ends.middle()), self.cell(ends));
        let f = match required {
            LegRequirement::MinLength(least) => {
                let (square, slopes) = self.square(leg, &at, &over);
                Function { value: square - Interval::from(least).square(), slopes, rest: [0.0; 6] }
            }
            LegRequirement::MaxLength(greatest) => {
                let (square, slopes) = self.square(leg, &at, &over);
                let rest = std::array::from_fn(|k| {
                    let t = self.along(leg, &over, k).map(Interval::magnitude);
                    (t[0].powi(2) + t[1].powi(2) + t[2].powi(2)).sqrt() * ends.half(k)
                });
                Function {
                    value: Interval::from(greatest).square() - square,
                    slopes: slopes.map(|x| -x),
                    rest,
                }
            }
            LegRequirement::ConeAngle { body, axis, limit_deg } => {
                self.cone(leg, (body, &axis, limit_deg), (&at, &over))
            }
        };
        self.split(&f, ends)
    }

    fn line(&self, leg: usize, cell: &Cell) -> IntervalVector {
        minus(&sum(&apply(&cell.rotation, &self.platform[leg]), &cell.position), &self.base[leg])
    }

    /// The change of a leg vector along a coordinate of the cube.
    fn along(&self, leg: usize, cell: &Cell, k: usize) -> IntervalVector {
        let change = if k < 3 { step(k) } else { apply(&cell.slopes[k - 3], &self.platform[leg]) };
        change.map(|x| x * self.widths[k])
    }

    /// The square of the length at the middle of a cell, and the slopes of `2 n(z) . n`.
    fn square(&self, leg: usize, at: &Cell, over: &Cell) -> (Interval, [Interval; 6]) {
        let n = self.line(leg, at);
        let slope = |k| Interval::from(2.0) * dot(&n, &self.along(leg, over, k));
        (square_of(&n), std::array::from_fn(slope))
    }

    /// `n.m - cos(limit) |n| |m|` for the axis `m` in the base frame.
    fn cone(
        &self,
        leg: usize,
        (body, axis, limit_deg): (Body, &Vector3<f64>, f64),
        (at, over): (&Cell, &Cell),
    ) -> Function {
        let axis = [axis.x, axis.y, axis.z].map(Interval::from);
        let size = square_of(&axis).sqrt().unwrap_or(Interval::WHOLE);
        let cosine = cosine(radians(limit_deg)) * size;
        let at_home = apply(&self.home, &axis);
        let axis_in = |cell: &Cell| match body {
            Body::Base => axis,
            Body::Platform => apply(&cell.rotation, &at_home),
        };
        let length = |n: &IntervalVector| square_of(n).sqrt().unwrap_or(Interval::WHOLE);
        let (first, n, m) = (self.line(leg, at), self.line(leg, over), axis_in(over));
        let slope = |k: usize| {
            let t = self.along(leg, over, k);
            let of_length = dot(&n, &t).checked_div(length(&n)).unwrap_or(Interval::WHOLE);
            let of_axis = match body {
                Body::Platform if k >= 3 => dot(&n, &apply(&over.slopes[k - 3], &at_home)) * self.widths[k],
                _ => Interval::ZERO,
            };
            dot(&t, &m) + of_axis - cosine * of_length
        };
        let value = dot(&first, &axis_in(at)) - cosine * length(&first);
        Function { value, slopes: std::array::from_fn(slope), rest: [0.0; 6] }
    }

    /// The coordinate along which to split a cell on which a function is not proved to be non-negative.
    fn split(&self, f: &Function, ends: &Ends) -> Split {
        let (centres, radii) =
            (f.slopes.map(|x| x.centre_and_radius().0), f.slopes.map(|x| x.centre_and_radius().1));
        let middle = ends.middle().low;
        let part = |first: usize| -> f64 {
            let of = |term: &dyn Fn(usize) -> f64| (first..first + 3).map(term).sum::<f64>();
            let in_cell = -of(&|k| centres[k].abs() * ends.half(k));
            let in_ball = -of(&|k| centres[k] * middle[k]) - of(&|k| centres[k].powi(2)).sqrt();
            if self.region == Region::Ellipsoid { in_cell.max(in_ball) } else { in_cell }
        };
        let loose = |k: usize| radii[k] * ends.half(k) + f.rest[k].powi(2);
        let wide = (0..6).map(|k| radii[k] * ends.half(k)).sum::<f64>() + f.rest.iter().sum::<f64>().powi(2);
        let bound = f.value.lo() + part(0) + part(3) - wide;
        let proved = bound >= SLACK * (f.value.magnitude() + wide);
        (!proved).then(|| widest(&|k| loose(k) + LINEAR * centres[k].abs() * ends.half(k)))
    }

    fn regular_cell(&self, ends: &Ends) -> Split {
        let at = self.lines(&self.cell(&ends.middle()));
        let middle = Matrix6::from_fn(|i, j| at[i][j].centre_and_radius().0);
        let Some(inverse) = middle.try_inverse() else { return Some(widest(&|k| ends.half(k))) };
        let start = times(&inverse, &at);
        let cell = self.cell(ends);
        let changes: [IntervalMatrix; 6] = std::array::from_fn(|k| times(&inverse, &self.changes(&cell, k)));
        let row = |i: usize| -> f64 {
            let entry = |j: usize| {
                let identity = if i == j { Interval::from(1.0) } else { Interval::ZERO };
                let fixed = Interval::from((start[i][j] - identity).magnitude());
                (0..6).fold(fixed, |sum, k| {
                    sum + Interval::from(changes[k][i][j].magnitude()) * Interval::from(ends.half(k))
                })
            };
            (0..6).map(entry).fold(Interval::ZERO, |sum, x| sum + x).hi()
        };
        let proved = (0..6).map(row).fold(0.0, f64::max) < CONTRACTION;
        let size = |k: usize| -> f64 {
            let row = |i: usize| changes[k][i].iter().map(|x| x.magnitude()).sum::<f64>();
            (0..6).map(row).fold(0.0, f64::max)
        };
        (!proved).then(|| widest(&|k| size(k) * ends.half(k)))
    }

    /// Rows `(n, R b x n / unit)` of the leg lines, moments about the pivot; `R b x n = R b x (p - a)` with joints `b`
    /// measured from the pivot and its position `p`.
    fn lines(&self, cell: &Cell) -> IntervalMatrix {
        std::array::from_fn(|i| {
            let arm = apply(&cell.rotation, &self.platform[i]);
            let lever = minus(&cell.position, &self.base[i]);
            self.row(sum(&arm, &lever), cross(&arm, &lever))
        })
    }

    /// The change of the rows along a coordinate of the cube.
    fn changes(&self, cell: &Cell, k: usize) -> IntervalMatrix {
        std::array::from_fn(|i| {
            let (change, moment) = if k < 3 {
                (step(k), cross(&apply(&cell.rotation, &self.platform[i]), &step(k)))
            } else {
                let turned = apply(&cell.slopes[k - 3], &self.platform[i]);
                (turned, cross(&turned, &minus(&cell.position, &self.base[i])))
            };
            self.row(change, moment).map(|x| x * self.widths[k])
        })
    }

    fn row(&self, n: IntervalVector, moment: IntervalVector) -> [Interval; 6] {
        // the unit is a power of two
        let scale = self.unit.recip();
        std::array::from_fn(|j| if j < 3 { n[j] } else { moment[j - 3].scaled(scale) })
    }
}

/// The coordinate with the greatest part in the width of the bound.
fn widest(part: &dyn Fn(usize) -> f64) -> usize {
    (0..6).max_by(|i, j| part(*i).total_cmp(&part(*j))).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3};
    use num::Rng;
    use platform::geom::{CoordinateRange, Pose};
    use platform::manipulator::Leg;

    pub(super) fn hexapod() -> Manipulator {
        let joint = |radius: f64, degrees: f64| {
            let (sine, cosine) = degrees.to_radians().sin_cos();
            Point3::new(radius * cosine, radius * sine, 0.0)
        };
        let legs = std::array::from_fn(|i| {
            let side = if i % 2 == 0 { -1.0 } else { 1.0 };
            let (base, platform) = (f64::from(i as u32 / 2) * 120.0, side * 46.0);
            Leg { base: joint(300.0, base + side * 12.0), platform: joint(200.0, base + platform) }
        });
        Manipulator::from_legs(legs).unwrap()
    }

    pub(super) fn space(region: Region, scale: f64) -> PoseSpace {
        PoseSpace {
            region,
            translation: Vector3::new(40.0, 40.0, 30.0) * scale,
            rotation_deg: Vector3::new(6.0, 6.0, 0.0) * scale,
            ..PoseSpace::at(Pose { rotation: Rotation3::identity(), position: Vector3::new(0.0, 0.0, 350.0) })
        }
    }

    /// The same about a pivot, to one side of home.
    pub(super) fn aside(region: Region) -> PoseSpace {
        let intervals = |ends: [(f64, f64); 3]| ends.map(|(min, max)| CoordinateRange { min, max });
        let translation = intervals([(-10.0, 40.0), (-30.0, 0.0), (-20.0, 20.0)]);
        let rotation_deg = intervals([(-2.0, 7.0), (0.0, 0.0), (0.0, 4.0)]);
        let space = PoseSpace { pivot: Vector3::new(20.0, -10.0, 90.0), ..space(region, 1.0) };
        space.with_region(region, &translation, &rotation_deg)
    }

    #[test]
    fn what_holds_with_room_is_tiled_and_what_fails_at_a_pose_is_not() {
        let m = hexapod();
        let spaces = [Region::Box, Region::Ellipsoid].map(|region| [space(region, 1.0), aside(region)]);
        for space in spaces.into_iter().flatten() {
            let tiled = TiledRegion::new(&m, &space).unwrap();
            let poses: Vec<Pose> =
                space.cube_points(300, &mut Rng::new(1)).iter().map(|x| space.pose(x)).collect();
            let line = |pose: &Pose| pose.transform(&m.legs()[0].platform) - m.legs()[0].base;
            let lengths = || poses.iter().map(|pose| line(pose).norm());
            let (least, greatest) = (lengths().fold(f64::INFINITY, f64::min), lengths().fold(0.0, f64::max));
            let axis = Vector3::z();
            let angle = |pose: &Pose| line(pose).angle(&axis).to_degrees();
            let widest = poses.iter().map(angle).fold(0.0, f64::max);
            let cone = |limit_deg| LegRequirement::ConeAngle { body: Body::Base, axis, limit_deg };
            let of_platform = |limit_deg| LegRequirement::ConeAngle { body: Body::Platform, axis, limit_deg };
            let back = |pose: &Pose| (pose.rotation.inverse() * line(pose)).angle(&axis).to_degrees();
            let widest_back = poses.iter().map(back).fold(0.0, f64::max);
            for (met, violated) in [
                (LegRequirement::MinLength(least - 15.0), LegRequirement::MinLength(least + 1.0)),
                (LegRequirement::MaxLength(greatest + 15.0), LegRequirement::MaxLength(greatest - 1.0)),
                (cone(widest + 3.0), cone(widest - 0.2)),
                (of_platform(widest_back + 3.0), of_platform(widest_back - 0.2)),
            ] {
                let tree = tiled.leg_tiling(0, met);
                assert!(tree.is_some_and(|t| t.contains('.')), "{met:?}");
                assert_eq!(tiled.leg_tiling(0, violated), None, "{violated:?}");
            }
        }
    }

    #[test]
    fn regions_without_singular_poses_are_tiled_and_wide_ones_are_not() {
        let m = hexapod();
        let tiling =
            |scale| TiledRegion::new(&m, &space(Region::Box, scale)).and_then(|t| t.regular_tiling());
        assert!(tiling(0.5).is_some());
        assert_eq!(tiling(8.0), None);
    }

    #[test]
    fn corners_of_the_cube_are_outside_of_an_ellipsoid() {
        let tiled = TiledRegion::new(&hexapod(), &space(Region::Ellipsoid, 1.0)).unwrap();
        let corner = Ends { low: [0.7, 0.7, 0.7, 0.0, 0.0, 0.0], high: [1.0; 6] };
        assert!(tiled.is_outside(&corner));
        assert!(!tiled.is_outside(&Ends { low: [0.5, 0.5, 0.5, 0.0, 0.0, 0.0], ..corner }));
    }
}
