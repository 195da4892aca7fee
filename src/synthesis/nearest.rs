//! The octahedral platform nearest to a platform: six legs moved as little as possible onto the sides of two triangles.
//!
//! A platform with one leg on each side of the hexagon of an octahedral platform ([`edge`]) is equivalent to it if
//! `det A = prod (1 - t_k) - prod t_k` is nonzero. With all `t_k = 0` it is the octahedral platform. The search
//! minimises the distances of its leg ends:
//!
//! ```text
//! F = sum over the legs of |a - a'|^2 + |b - b'|^2  ->  min,
//! ```
//!
//! with base ends `a` in the base frame and platform ends `b` in the platform frame. The variables are the six corners,
//! the six `t_k` between `-e` and `1 + e`, and the 120 ways to lay six legs round the hexagon. For one way the two
//! bodies are separate fits: a triangle with corners near three points and side lines near three others. Gauss-Newton
//! steps over the corners solve each fit, from six deterministic starts. The nearest `t_k` are projections; with them
//! `F` has the same gradient as with fixed `t_k`.
//!
//! The result is the least of the local minima of all ways; a smaller one may exist. Ways whose minimum has triangles
//! without area, or `|det A|` below the limit, are set aside and counted.

use nalgebra::{Point3, SMatrix, SVector, Vector3};

use super::hexagon::{corner, edge, sliding_body};
use super::offset_determinant;
use platform::geom::Pose;
use platform::manipulator::{Body, InvalidManipulator, Leg, LegIndex, Manipulator, is_collinear};

/// Greatest number of steps of a fit.
const STEPS: usize = 300;
/// A fit has converged if its gradient is below this times the size of the body.
const SETTLED: f64 = 1e-10;
/// Offsets within this of 0 or 1, and joints within this share of the size, are at the corner.
const AT_CORNER: f64 = 1e-9;

/// Limits of the search for the nearest octahedral platform.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestOptions {
    /// `e`: greatest extension of a leg end beyond a corner on the line of its side, in lengths of the side.
    pub extension: f64,
    /// Least `|det A|`.
    pub min_abs_det: f64,
}

/// The nearest octahedral platform found, and its equivalent platform with legs nearest to the given ones.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct NearestOctahedral {
    /// Leg `order[k]` lies on side `k` of the hexagon.
    pub order: [LegIndex; 6],
    /// Corners `P1, P2, P3`, base frame.
    pub base: [Point3<f64>; 3],
    /// Corners `P4, P5, P6`, platform frame.
    pub platform: [Point3<f64>; 3],
    /// `t_k` of the leg on side `k`, exactly 0 or 1 at a corner.
    pub offsets: [f64; 6],
    /// Displacements of the base end and the platform end of each leg, in the order of the legs, design units.
    pub displacements: [[f64; 2]; 6],
    /// `det A = prod (1 - t_k) - prod t_k`.
    pub determinant: f64,
    /// Whether both fits converged.
    pub settled: bool,
    /// Number of nearer ways round the hexagon that give no regular platform.
    pub set_aside: usize,
}

impl NearestOctahedral {
    /// The largest displacement of a leg end, design units.
    #[must_use]
    pub fn largest_displacement(&self) -> f64 {
        self.displacements.iter().flatten().fold(0.0, |m: f64, x| m.max(*x))
    }

    /// The root of the mean square of the twelve displacements, design units.
    #[must_use]
    pub fn rms_displacement(&self) -> f64 {
        (self.displacements.iter().flatten().map(|x| x * x).sum::<f64>() / 12.0).sqrt()
    }

    /// The octahedral platform: leg `order[k]` joins the corners of vertex `k`.
    ///
    /// # Errors
    /// The corners form no manipulator.
    pub fn octahedral(&self) -> Result<Manipulator, InvalidManipulator> {
        let mut pairs = [(0, 0); 6];
        for (k, leg) in self.order.into_iter().enumerate() {
            pairs[leg.get()] = (corner(Body::Base, k), corner(Body::Platform, k) - 3);
        }
        Manipulator::try_new(self.base.to_vec(), self.platform.to_vec(), pairs)
    }

    /// Ends of the legs nearest to the given ones, base first, in their order.
    #[must_use]
    pub fn ends(&self) -> [[LegEnd; 2]; 6] {
        let mut ends = [[LegEnd::Corner(0); 2]; 6];
        for (k, leg) in self.order.into_iter().enumerate() {
            let sliding = sliding_body(k);
            let [from, to] = edge(k).map(LegEnd::Corner);
            let slid = match self.offsets[k] {
                0.0 => from,
                1.0 => to,
                _ => LegEnd::OnSide(k),
            };
            let fixed = LegEnd::Corner(corner(sliding.other(), k));
            ends[leg.get()] = sliding.of(([slid, fixed], [fixed, slid]));
        }
        ends
    }

    /// The place of an end, in the frame of its body.
    #[must_use]
    pub fn point(&self, end: LegEnd) -> Point3<f64> {
        let corner = |i: usize| if i < 3 { self.base[i] } else { self.platform[i - 3] };
        match end {
            LegEnd::Corner(i) => corner(i),
            LegEnd::OnSide(k) => {
                let [from, to] = edge(k).map(corner);
                from + (to - from) * self.offsets[k]
            }
        }
    }

    /// The legs nearest to the given ones, in their order.
    #[must_use]
    pub fn legs(&self) -> [Leg; 6] {
        self.ends().map(|[base, platform]| Leg { base: self.point(base), platform: self.point(platform) })
    }
}

/// The end of a leg on the sides of two triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegEnd {
    /// A corner: 0, 1, 2 on the base, 3, 4, 5 on the platform.
    Corner(usize),
    /// The joint on the triangle side of this side of the hexagon, 0 to 5.
    OnSide(usize),
}

/// The largest difference of leg lengths between two platforms at the same poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LengthDeviation {
    /// The difference, design units.
    pub value: f64,
    /// The leg.
    pub leg: LegIndex,
    /// The pose, an index.
    pub pose: usize,
}

/// The largest difference of leg lengths between two platforms over poses; `None` without poses.
#[must_use]
pub fn length_deviation(a: &[Leg; 6], b: &[Leg; 6], poses: &[Pose]) -> Option<LengthDeviation> {
    let mut worst: Option<LengthDeviation> = None;
    for (k, pose) in poses.iter().enumerate() {
        for leg in LegIndex::all() {
            let length = |legs: &[Leg; 6]| pose.squared_length(&legs[leg.get()]).sqrt();
            let value = (length(a) - length(b)).abs();
            if worst.is_none_or(|w| value > w.value) {
                worst = Some(LengthDeviation { value, leg, pose: k });
            }
        }
    }
    worst
}

/// A triangle fitted to six points of a body.
#[derive(Debug, Clone, Copy)]
struct TriangleFit {
    corners: [Vector3<f64>; 3],
    /// Parameters of the side points, from corner `s` to corner `s + 1`.
    t: [f64; 3],
    /// Sum of squared distances.
    squares: f64,
    settled: bool,
}

/// Target points of a triangle: three for the corners, and one for the line of each side from corner `s` to `s + 1`.
#[derive(Debug, Clone, Copy)]
struct TriangleTarget {
    corners: [Vector3<f64>; 3],
    sides: [Vector3<f64>; 3],
    extension: f64,
    size: f64,
}

impl TriangleTarget {
    /// The nearest place on side `s`, and whether it is at the end of the allowed range.
    fn place(&self, c: &[Vector3<f64>; 3], s: usize) -> (f64, bool) {
        let (from, to) = (c[s], c[(s + 1) % 3]);
        let along = to - from;
        let length = along.norm_squared();
        if length <= (AT_CORNER * self.size).powi(2) {
            return (0.5, true);
        }
        let free = (self.sides[s] - from).dot(&along) / length;
        let (least, most) = (-self.extension, 1.0 + self.extension);
        match free {
            t if t <= least => (least, true),
            t if t >= most => (most, true),
            t => (t, false),
        }
    }

    /// Distance vector from the point at side `s` to its place.
    fn miss(&self, c: &[Vector3<f64>; 3], s: usize, t: f64) -> Vector3<f64> {
        c[s] * (1.0 - t) + c[(s + 1) % 3] * t - self.sides[s]
    }

    fn squares(&self, c: &[Vector3<f64>; 3]) -> f64 {
        let corners = c.iter().zip(&self.corners).map(|(x, p)| (x - p).norm_squared());
        let sides = (0..3).map(|s| self.miss(c, s, self.place(c, s).0).norm_squared());
        corners.chain(sides).sum()
    }

    /// Normal matrix of the linearised distances, and half of the gradient.
    fn linearised(&self, c: &[Vector3<f64>; 3]) -> (SMatrix<f64, 9, 9>, SVector<f64, 9>) {
        let (mut normal, mut half) = (SMatrix::<f64, 9, 9>::identity(), SVector::<f64, 9>::zeros());
        for v in 0..3 {
            half.fixed_rows_mut::<3>(3 * v).copy_from(&(c[v] - self.corners[v]));
        }
        for s in 0..3 {
            let (t, at_end) = self.place(c, s);
            let (from, to) = (s, (s + 1) % 3);
            let along = c[to] - c[from];
            let mut across = nalgebra::Matrix3::identity();
            if !at_end {
                let u = along.normalize();
                across -= u * u.transpose(); // a freely sliding place is unaffected by motions along the side
            }
            let miss = self.miss(c, s, t);
            for (v, x) in [(from, 1.0 - t), (to, t)] {
                let mut rows = half.fixed_rows_mut::<3>(3 * v);
                rows += miss * x;
                for (w, y) in [(from, 1.0 - t), (to, t)] {
                    let mut block = normal.fixed_view_mut::<3, 3>(3 * v, 3 * w);
                    block += across * (x * y);
                }
            }
        }
        (normal, half)
    }

    /// Gauss-Newton from these corners; a step is halved until the sum of squares falls.
    fn from(&self, mut c: [Vector3<f64>; 3]) -> TriangleFit {
        let mut squares = self.squares(&c);
        let mut settled = false;
        for _ in 0..STEPS {
            let (normal, half) = self.linearised(&c);
            settled = half.norm() <= SETTLED * self.size;
            let Some(step) = normal.cholesky().filter(|_| !settled).map(|n| n.solve(&half)) else { break };
            let mut share = 1.0;
            let found = loop {
                let next: [Vector3<f64>; 3] =
                    std::array::from_fn(|v| c[v] - step.fixed_rows::<3>(3 * v) * share);
                let value = self.squares(&next);
                if value < squares {
                    break Some((next, value));
                }
                share *= 0.5;
                if share < 1e-12 {
                    break None;
                }
            };
            // no step lowers the sum: this is the minimum up to rounding, or the gradient shows the contrary
            let Some((next, value)) = found else {
                settled = half.norm() <= SETTLED.sqrt() * self.size;
                break;
            };
            (c, squares) = (next, value);
        }
        let t = [0, 1, 2].map(|s| self.place(&c, s).0);
        TriangleFit { corners: c, t, squares, settled }
    }

    /// The best fit over all starts. The starts are the corners as given, and each corner moved half-way to the side
    /// points before, after and to both. Two further starts are the triangle with the side points at its midpoints, and
    /// the corners at twice the distance from their mean.
    fn best(&self) -> TriangleFit {
        let p = self.corners;
        let q = |s: usize| self.sides[s % 3];
        let mean = (p[0] + p[1] + p[2]) / 3.0;
        let starts = [
            p,
            [0, 1, 2].map(|v| (p[v] + q(v)) * 0.5),
            [0, 1, 2].map(|v| (p[v] + q(v + 2)) * 0.5),
            [0, 1, 2].map(|v| (p[v] * 2.0 + q(v) + q(v + 2)) * 0.25),
            [0, 1, 2].map(|v| q(v) + q(v + 2) - q(v + 1)),
            [0, 1, 2].map(|v| p[v] * 2.0 - mean),
        ];
        let mut best = self.from(starts[0]);
        for start in &starts[1..] {
            let next = self.from(*start);
            if next.squares < best.squares {
                best = next;
            }
        }
        best
    }
}

/// Both bodies for one way round the hexagon.
#[derive(Debug, Clone, Copy)]
struct HexagonWay {
    order: [usize; 6],
    fits: [TriangleFit; 2],
}

impl HexagonWay {
    fn of(legs: &[Leg; 6], order: [usize; 6], extension: f64, size: f64) -> Self {
        let fits = Body::BOTH.map(|body| {
            let end = |k: usize| body.of((legs[order[k]].base, legs[order[k]].platform)).coords;
            // the side that starts at corner s, and the side of the other body with leg ends there
            let slides = [0, 1, 2].map(|s| 2 * s + body.index());
            let ends = [0, 1, 2].map(|v| {
                let label = v + 3 * body.index();
                let stays = |k: &usize| sliding_body(*k) != body && corner(body, *k) == label;
                (0..6).find(stays).unwrap_or_else(|| unreachable!("every corner has a side that ends there"))
            });
            TriangleTarget { corners: ends.map(end), sides: slides.map(end), extension, size }.best()
        });
        Self { order, fits }
    }

    fn squares(&self) -> f64 {
        self.fits[0].squares + self.fits[1].squares
    }

    /// The platform, if it is regular.
    fn platform(&self, legs: &[Leg; 6], options: &NearestOptions) -> Option<NearestOctahedral> {
        let [base, platform] = self.fits.map(|f| f.corners.map(Point3::from));
        if is_collinear(&base) || is_collinear(&platform) {
            return None;
        }
        let at_corner = |t: f64| match t {
            t if t.abs() <= AT_CORNER => 0.0,
            t if (t - 1.0).abs() <= AT_CORNER => 1.0,
            t => t,
        };
        let offsets = std::array::from_fn(|k| at_corner(self.fits[sliding_body(k).index()].t[k / 2]));
        let determinant = offset_determinant(&offsets);
        if determinant.abs() < options.min_abs_det {
            return None;
        }
        let order =
            self.order.map(|i| LegIndex::new(i).unwrap_or_else(|| unreachable!("a way has the legs 0 to 5")));
        let mut found = NearestOctahedral {
            order,
            base,
            platform,
            offsets,
            displacements: [[0.0; 2]; 6],
            determinant,
            settled: self.fits.iter().all(|f| f.settled),
            set_aside: 0,
        };
        let placed = found.legs();
        found.displacements = std::array::from_fn(|i| {
            [(placed[i].base - legs[i].base).norm(), (placed[i].platform - legs[i].platform).norm()]
        });
        found.octahedral().is_ok().then_some(found)
    }
}

/// The octahedral platform nearest to a platform.
///
/// The legs may share joints; legs at one joint are moved independently. `None` if no way round the hexagon gives a
/// regular platform.
///
/// The sum of squares has the unit of the design squared; the answer scales with the design. The same input gives the
/// same answer.
#[must_use]
pub fn nearest_octahedral(m: &Manipulator, options: &NearestOptions) -> Option<NearestOctahedral> {
    let (legs, size) = (m.legs(), m.size());
    let mut ways: Vec<HexagonWay> =
        hexagon_orders().map(|order| HexagonWay::of(&legs, order, options.extension, size)).collect();
    ways.sort_by(|a, b| a.squares().total_cmp(&b.squares()));
    let found = ways.iter().enumerate().find_map(|(k, way)| Some((k, way.platform(&legs, options)?)));
    found.map(|(set_aside, nearest)| NearestOctahedral { set_aside, ..nearest })
}

/// The 120 ways to lay six legs round the hexagon of an octahedral platform, with leg `order[k]` on side `k`.
/// Symmetries that keep base and platform are removed.
pub(crate) fn hexagon_orders() -> impl Iterator<Item = [usize; 6]> {
    (0..46656_usize).filter_map(|n| {
        let mut rest = n;
        let order: [usize; 6] = std::array::from_fn(|_| {
            let digit = rest % 6;
            rest /= 6;
            digit
        });
        let all = order.iter().fold(0u8, |set, i| set | 1 << i) == 0b11_1111;
        (all && order[0] < order[2] && order[0] < order[4] && order[1] < order[5]).then_some(order)
    })
}

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;

    use super::*;
    use crate::hexagon::tests::example;
    use crate::{LegMapTolerances, joint_free, leg_map};
    use num::Rng;

    const OPTIONS: NearestOptions = NearestOptions { extension: 1.0, min_abs_det: 0.05 };

    fn platform_of(legs: &[Leg; 6]) -> Manipulator {
        let pairs = [0, 1, 2, 3, 4, 5].map(|i| (i, i));
        Manipulator::try_new(legs.map(|l| l.base).to_vec(), legs.map(|l| l.platform).to_vec(), pairs).unwrap()
    }

    #[test]
    fn there_are_120_ways_round_the_hexagon() {
        assert_eq!(hexagon_orders().count(), 120);
    }

    #[test]
    fn a_platform_that_is_made_of_an_octahedral_one_is_its_own_nearest() {
        let o = example();
        for (t, turned) in [
            ([0.2, 0.3, 0.15, 0.25, 0.2, 0.3], [3, 0, 5, 2, 4, 1]),
            ([-0.4, 0.1, 1.4, 0.2, -0.3, 0.3], [5, 4, 3, 2, 1, 0]),
        ] {
            let (m, _) = joint_free(&o, t).unwrap();
            let m = m.reordered(turned).unwrap();
            let found = nearest_octahedral(&m, &OPTIONS).unwrap();
            assert!(found.largest_displacement() < 1e-9 && found.settled, "{found:?}");
            let det = crate::offset_determinant(&t);
            assert!((found.determinant.abs() - det.abs()).abs() < 1e-8, "{} {det}", found.determinant);
        }
        // the octahedral platform itself: every leg at a corner
        let m = Manipulator::try_new(
            o.base().to_vec(),
            o.platform().to_vec(),
            [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)],
        );
        let found = nearest_octahedral(&m.unwrap(), &OPTIONS).unwrap();
        assert!(found.largest_displacement() < 1e-9 && (found.determinant.abs() - 1.0).abs() < 1e-8);
    }

    #[test]
    fn the_nearest_is_no_farther_than_a_platform_it_was_disturbed_from_and_is_equivalent_to_its_octahedral_one()
     {
        let o = example();
        let mut rng = Rng::new(11);
        for size in [1e-6, 1e-3, 0.3] {
            let (m, _) = joint_free(&o, [0.2, 0.3, 0.15, 0.25, 0.2, 0.3]).unwrap();
            let mut legs = m.legs();
            let mut squares = 0.0;
            for leg in &mut legs {
                for end in [&mut leg.base, &mut leg.platform] {
                    let by = Vector3::from_fn(|_, _| size * rng.uniform(-1.0, 1.0));
                    *end += by;
                    squares += by.norm_squared();
                }
            }
            let found = nearest_octahedral(&platform_of(&legs), &OPTIONS).unwrap();
            let rms = found.rms_displacement();
            assert!(12.0 * rms * rms <= squares && rms > 0.01 * size, "{size}: {rms}");
            let (octahedral, near) = (found.octahedral().unwrap(), platform_of(&found.legs()));
            let map = leg_map(&octahedral, &near, LegMapTolerances::default()).unwrap();
            assert!(map.is_regular_within_rounding());
            assert!((map.determinant.abs() - found.determinant.abs()).abs() < 1e-9);
        }
    }

    #[test]
    fn no_small_change_of_a_corner_or_an_offset_comes_nearer() {
        let mut rng = Rng::new(5);
        let point = |rng: &mut Rng| Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
        let legs: [Leg; 6] =
            std::array::from_fn(|_| Leg { base: point(&mut rng), platform: point(&mut rng) });
        let found = nearest_octahedral(&platform_of(&legs), &OPTIONS).unwrap();
        assert!(found.settled && found.largest_displacement() > 0.1, "{found:?}");
        let squares = |n: &NearestOctahedral| -> f64 {
            let ends = n.legs().into_iter().zip(legs);
            ends.map(|(x, y)| (x.base - y.base).norm_squared() + (x.platform - y.platform).norm_squared())
                .sum()
        };
        let least = squares(&found);
        assert!((least - 12.0 * found.rms_displacement().powi(2)).abs() < 1e-9);
        for _ in 0..200 {
            let mut other = found.clone();
            for p in other.base.iter_mut().chain(&mut other.platform) {
                *p += Vector3::from_fn(|_, _| 1e-3 * rng.uniform(-1.0, 1.0));
            }
            for t in &mut other.offsets {
                *t = (*t + 1e-3 * rng.uniform(-1.0, 1.0)).clamp(-1.0, 2.0);
            }
            assert!(squares(&other) >= least - 1e-12);
        }
        // in millimetres it is the same platform
        let scaled = legs.map(|l| Leg { base: l.base * 1e3, platform: l.platform * 1e3 });
        let again = nearest_octahedral(&platform_of(&scaled), &OPTIONS).unwrap();
        assert_eq!(again.order, found.order);
        assert!((again.largest_displacement() / 1e3 - found.largest_displacement()).abs() < 1e-7);
    }

    #[test]
    fn lengths_deviate_by_no_more_than_the_ends_of_the_leg_have_moved() {
        let (m, _) = joint_free(&example(), [0.2, 0.3, 0.15, 0.25, 0.2, 0.3]).unwrap();
        let mut legs = m.legs();
        legs[2].base += Vector3::new(0.01, 0.0, 0.02);
        let at = |x, y, z| Pose { rotation: Rotation3::identity(), position: Vector3::new(x, y, z) };
        let poses = [at(0.0, 0.0, 0.0), at(1.0, 2.0, 9.0)];
        let worst = length_deviation(&m.legs(), &legs, &poses).unwrap();
        assert!(worst.leg.get() == 2 && worst.value > 0.0 && worst.value <= 0.0224);
        assert_eq!(length_deviation(&legs, &legs, &poses).unwrap().value.to_bits(), 0);
        assert!(length_deviation(&legs, &legs, &[]).is_none());
    }

    #[test]
    fn a_limit_of_det_a_that_nothing_keeps_leaves_nothing() {
        let (m, _) = joint_free(&example(), [0.2, 0.3, 0.15, 0.25, 0.2, 0.3]).unwrap();
        assert!(nearest_octahedral(&m, &NearestOptions { extension: 0.0, min_abs_det: 2.0 }).is_none());
    }
}
