//! Designs with many real poses: pairs of conjugate complex poses are led together by moving joints and lengths, until they meet and go on as two real ones.
//!
//! The method is Dietmaier's (1998), who found a platform with 40 real poses: at each step the derivatives of all poses with respect to joints and squared lengths are known
//! from the leg equations, a direction is taken in which the imaginary part of one pair shrinks and near real poses do not come nearer to each other, and all poses
//! are computed again.

use nalgebra::{DVector, Matrix3, Matrix6, Vector3, Vector6};
use num_complex::Complex64;

use crate::fk::{FkOptions, FkSolutions, PoseCounting, Reality, solver};
use crate::geom::ComplexPose;
use crate::manipulator::{Body, Manipulator, SquaredLegLengths};
use crate::num::{Purpose, Rng};

/// Lengths of steps that are tried one after the other, as shares of the size.
const STEPS: [f64; 6] = [0.2, 0.08, 0.03, 0.01, 3e-3, 1e-3];
/// Pairs of complex poses that are tried at each step, those with the least imaginary parts.
const PAIRS: usize = 3;
/// Pairs of real poses that must not come nearer to each other, the nearest ones.
const KEPT: usize = 10;
/// Random directions in a row without a better platform after which a search ends.
const PATIENCE: usize = 12;
/// The imaginary part has to shrink by this factor for a step to count.
const SHRUNK: f64 = 0.98;

/// Where a search ended.
#[derive(Debug, Clone)]
pub(super) struct Climb {
    pub(super) manipulator: Manipulator,
    pub(super) squares: SquaredLegLengths,
    /// All poses there, with their evidence.
    pub(super) found: FkSolutions,
    /// Real poses at the start.
    pub(super) began: usize,
    /// Steps taken.
    pub(super) steps: usize,
}

/// What a search may move: which coordinates of which joints, and six squared lengths.
#[derive(Debug)]
struct ClimbFreedoms {
    /// Body, joint, axis.
    coordinates: Vec<(Body, usize, usize)>,
    pairs: [(usize, usize); 6],
    size: f64,
}

/// A platform with lengths and its poses.
#[derive(Debug, Clone)]
struct Stand {
    manipulator: Manipulator,
    squares: SquaredLegLengths,
    found: FkSolutions,
    real: usize,
    /// The least measure of an imaginary part; infinite where all poses are real.
    least: f64,
}

impl ClimbFreedoms {
    /// Every coordinate of the joints that carry legs; a body whose joints all have `z = 0` stays flat.
    fn of(m: &Manipulator) -> Self {
        let pairs = m.pairs();
        let mut coordinates = Vec::new();
        for body in Body::BOTH {
            let joints = m.joints(body);
            let used = |j: &usize| pairs.iter().any(|p| body.of(*p) == *j);
            let flat = (0..joints.len()).filter(used).all(|j| joints[j].z.abs() <= 0.0);
            let axes = if flat { 2 } else { 3 };
            coordinates.extend(
                (0..joints.len()).filter(used).flat_map(|j| (0..axes).map(move |axis| (body, j, axis))),
            );
        }
        Self { coordinates, pairs, size: m.size() }
    }

    /// The platform moved by a vector of coordinates and squared lengths, in units of the size and of its square.
    fn moved(&self, from: &Stand, by: &DVector<f64>) -> Option<(Manipulator, SquaredLegLengths)> {
        let mut joints = Body::BOTH.map(|body| from.manipulator.joints(body).to_vec());
        for (k, (body, joint, axis)) in self.coordinates.iter().enumerate() {
            joints[body.index()][*joint][*axis] += by[k] * self.size;
        }
        let n = self.coordinates.len();
        let own = from.squares.get();
        let squares = std::array::from_fn(|i| own[i] + by[n + i] * self.size * self.size);
        let [base, platform] = joints;
        let moved = Manipulator::try_new(base, platform, self.pairs).ok()?;
        Some((moved, SquaredLegLengths::try_new(squares).ok()?))
    }

    /// How a pose moves with each of them: turns `w` (`dR = [w]x R`) and shifts in units of the size. `None` at a singular pose.
    ///
    /// With `d = R b + p - a` the leg equation `d.d = s` gives `2 d.(dp + w x R b) = ds + 2 d.da - 2 (R^T d).db`.
    fn derivatives(&self, m: &Manipulator, pose: &ComplexPose) -> Option<Vec<Vector6<Complex64>>> {
        let complex = |v: Vector3<f64>| v.map(|x| Complex64::new(x, 0.0));
        let mut rows = Matrix6::<Complex64>::zeros();
        let mut ends = [(Vector3::zeros(), Vector3::zeros()); 6];
        for (i, leg) in m.legs().iter().enumerate() {
            let arm = pose.rotation * complex(leg.platform.coords);
            let d = arm + pose.position - complex(leg.base.coords);
            let moment = arm.cross(&d);
            for k in 0..3 {
                rows[(i, k)] = moment[k] / self.size;
                rows[(i, 3 + k)] = d[k];
            }
            ends[i] = (d, pose.rotation.transpose() * d);
        }
        // unknowns are w and dp / size; both sides over the size
        let inverse = rows.try_inverse()?;
        let half = Complex64::new(0.5, 0.0);
        let mut out = Vec::with_capacity(self.coordinates.len() + 6);
        for (body, joint, axis) in &self.coordinates {
            let mut right = Vector6::zeros();
            for i in (0..6).filter(|i| body.of(self.pairs[*i]) == *joint) {
                right[i] = match body {
                    Body::Base => ends[i].0[*axis],
                    Body::Platform => -ends[i].1[*axis],
                };
            }
            out.push(inverse * right);
        }
        for i in 0..6 {
            let mut right = Vector6::zeros();
            right[i] = half * self.size;
            out.push(inverse * right);
        }
        Some(out)
    }
}

/// The derivatives of `sum f(entry)^2` over rotation and position (in units of the size) of a pose, where `f` takes a real number from the entries and
/// `at` has the values of `f` there.
fn slope(
    pose: &ComplexPose,
    moves: &[Vector6<Complex64>],
    at: (&Matrix3<f64>, &Vector3<f64>),
    f: fn(Complex64) -> f64,
) -> DVector<f64> {
    let one = |by: &Vector6<Complex64>| {
        let (w, p) = (by.fixed_rows::<3>(0).into_owned(), by.fixed_rows::<3>(3).into_owned());
        let mut sum = 0.0;
        for column in 0..3 {
            let turned = w.cross(&pose.rotation.column(column).into_owned());
            sum += (0..3).map(|i| at.0[(i, column)] * f(turned[i])).sum::<f64>();
        }
        2.0 * (sum + (0..3).map(|i| at.1[i] * f(p[i])).sum::<f64>())
    };
    DVector::from_iterator(moves.len(), moves.iter().map(one))
}

/// Imaginary parts of a pose, positions in units of the size.
fn imaginary(pose: &ComplexPose, size: f64) -> (Matrix3<f64>, Vector3<f64>) {
    (pose.rotation.map(|z| z.im), pose.position.map(|z| z.im / size))
}

/// The sum of their squares.
fn measure(pose: &ComplexPose, size: f64) -> f64 {
    let (r, p) = imaginary(pose, size);
    r.norm_squared() + p.norm_squared()
}

fn real_difference(a: &ComplexPose, b: &ComplexPose, size: f64) -> (Matrix3<f64>, Vector3<f64>) {
    ((a.rotation - b.rotation).map(|z| z.re), (a.position - b.position).map(|z| z.re / size))
}

impl Stand {
    fn new(manipulator: Manipulator, squares: SquaredLegLengths, seed: u64) -> Option<Self> {
        // completeness is asked for at the end
        let options = FkOptions::new().seed(seed).pose_count(PoseCounting::Never);
        let found = solver(None).solve(&manipulator, &squares, &options).ok()?;
        let size = manipulator.size();
        let real = found.assembly_modes().count();
        let complex = found.roots.iter().filter(|r| r.reality == Reality::NonReal);
        let least = complex.map(|r| measure(&r.pose, size)).fold(f64::INFINITY, f64::min);
        Some(Self { manipulator, squares, found, real, least })
    }

    /// More real poses, or as many and a pair of complex ones nearer to being real; poses that get lost are no gain.
    fn is_better_than(&self, other: &Self) -> bool {
        self.found.roots.len() >= other.found.roots.len()
            && (self.real > other.real || self.real == other.real && self.least < SHRUNK * other.least)
    }

    /// Directions in which a pair of complex poses comes together, the nearest pairs first.
    fn directions(&self, freedoms: &ClimbFreedoms) -> Vec<DVector<f64>> {
        let size = freedoms.size;
        let mut complex: Vec<(f64, &ComplexPose)> = self
            .found
            .roots
            .iter()
            .filter(|r| r.reality == Reality::NonReal)
            .map(|r| (measure(&r.pose, size), &r.pose))
            .collect();
        complex.sort_by(|a, b| a.0.total_cmp(&b.0));
        // conjugates have the same measure, but for rounding
        complex.dedup_by(|a, b| (a.0 - b.0).abs() <= 1e-6 * b.0);
        let kept = self.kept(freedoms);
        let toward = |pose: &ComplexPose| {
            let moves = freedoms.derivatives(&self.manipulator, pose)?;
            let (r, p) = imaginary(pose, size);
            let mut direction = -slope(pose, &moves, (&r, &p), |z| z.im);
            for _ in 0..8 {
                for slope in &kept {
                    let along = slope.dot(&direction);
                    if along < 0.0 {
                        direction -= slope * along;
                    }
                }
            }
            let norm = direction.norm();
            (norm.is_finite() && norm > 0.0).then(|| direction / norm)
        };
        complex.iter().take(PAIRS).filter_map(|(_, pose)| toward(pose)).collect()
    }

    /// Unit vectors along which the nearest pairs of real poses part.
    fn kept(&self, freedoms: &ClimbFreedoms) -> Vec<DVector<f64>> {
        let size = freedoms.size;
        let real: Vec<&ComplexPose> = self.found.assembly_modes().map(|r| &r.pose).collect();
        let mut pairs: Vec<(f64, usize, usize)> = Vec::new();
        for i in 0..real.len() {
            for j in i + 1..real.len() {
                let (r, p) = real_difference(real[i], real[j], size);
                pairs.push((r.norm_squared() + p.norm_squared(), i, j));
            }
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
        let parting = |i: usize, j: usize| {
            let (r, p) = real_difference(real[i], real[j], size);
            let own = |pose: &ComplexPose| {
                let moves = freedoms.derivatives(&self.manipulator, pose)?;
                Some(slope(pose, &moves, (&r, &p), |z| z.re))
            };
            let slope = own(real[i])? - own(real[j])?;
            let norm = slope.norm();
            (norm.is_finite() && norm > 0.0).then(|| slope / norm)
        };
        pairs.iter().take(KEPT).filter_map(|(_, i, j)| parting(*i, *j)).collect()
    }
}

/// Searches from a platform with lengths for one with more real poses, in at most so many steps.
///
/// # Errors
/// Where the poses of the start or of the end cannot be computed.
pub(super) fn climb(
    m: &Manipulator,
    squares: &SquaredLegLengths,
    seed: u64,
    most: usize,
) -> Result<Climb, String> {
    let freedoms = ClimbFreedoms::of(m);
    let mut here =
        Stand::new(m.clone(), *squares, seed).ok_or("the poses of the start cannot be computed")?;
    let began = here.real;
    let mut rng: Rng = Purpose::SWEPT_AGAIN.item(seed, 2);
    let (mut steps, mut idle) = (0, 0);
    while steps < most && here.least.is_finite() && idle < PATIENCE {
        let mut directions = here.directions(&freedoms);
        if idle > 0 {
            let n = freedoms.coordinates.len() + 6;
            let random = DVector::from_iterator(n, (0..n).map(|_| rng.normal()));
            directions = vec![random.normalize()];
        }
        let tried = directions.iter().flat_map(|d| STEPS.iter().map(move |t| d * *t));
        let better = tried
            .filter_map(|by| freedoms.moved(&here, &by))
            .filter_map(|(m, s)| Stand::new(m, s, seed))
            .find(|there| there.is_better_than(&here));
        match better {
            Some(there) => (here, idle) = (there, 0),
            None => idle += 1,
        }
        steps += 1;
    }
    let options = FkOptions::new().seed(seed);
    let found = solver(None).solve(&here.manipulator, &here.squares, &options).map_err(|e| e.to_string())?;
    Ok(Climb { manipulator: here.manipulator, squares: here.squares, found, began, steps })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::design::{Format, parse};

    fn octahedral() -> (Manipulator, SquaredLegLengths) {
        let text = include_str!("../../designs/rbt-octahedral.toml");
        let (design, _) = parse(text, Format::Toml).unwrap();
        (design.manipulator().clone(), design.lengths.unwrap().squared())
    }

    #[test]
    fn derivatives_are_those_of_the_poses() {
        let text = include_str!("../../designs/general-6-6.toml");
        let (design, _) = parse(text, Format::Toml).unwrap();
        let stand = Stand::new(design.manipulator().clone(), design.lengths.unwrap().squared(), 1).unwrap();
        let freedoms = ClimbFreedoms::of(&stand.manipulator);
        let n = freedoms.coordinates.len() + 6;
        let root = stand.found.roots.iter().find(|r| r.reality == Reality::NonReal).unwrap();
        let moves = freedoms.derivatives(&stand.manipulator, &root.pose).unwrap();
        let (r, p) = imaginary(&root.pose, freedoms.size);
        let slope = slope(&root.pose, &moves, (&r, &p), |z| z.im);
        let h = 1e-6;
        for k in (0..n).step_by(5) {
            let at = |h: f64| {
                let mut by = DVector::zeros(n);
                by[k] = h;
                let (m, s) = freedoms.moved(&stand, &by).unwrap();
                let there = Stand::new(m, s, 1).unwrap();
                let near = there.found.roots.iter().min_by(|a, b| {
                    let far = |x: &ComplexPose| x.distance(&root.pose, freedoms.size);
                    far(&a.pose).total_cmp(&far(&b.pose))
                });
                measure(&near.unwrap().pose, freedoms.size)
            };
            let numeric = (at(h) - at(-h)) / (2.0 * h);
            assert!((numeric - slope[k]).abs() < 1e-4 * (1.0 + slope.amax()), "{k}: {numeric} {}", slope[k]);
        }
    }

    #[test]
    fn a_search_ends_with_more_real_poses_and_the_same_joints_shared() {
        let (m, _) = octahedral();
        // lengths with few real poses
        let squares = SquaredLegLengths::try_new([400.0, 300.0, 310.0, 290.0, 350.0, 320.0]).unwrap();
        let found = climb(&m, &squares, 1, 60).unwrap();
        let real = found.found.assembly_modes().count();
        assert!(real > found.began, "{} {real}", found.began);
        assert_eq!((found.manipulator.pairs(), found.found.roots.len()), (m.pairs(), 16));
        assert!(found.found.roots.iter().all(crate::fk::FkRoot::certified));
    }
}
