//! Searches for designs with many real poses. Moving joints and lengths brings pairs of conjugate complex poses
//! together, until they meet and become two real ones.
//!
//! The method is due to Dietmaier (1998), who found a platform with 40 real poses. The leg equations give the
//! derivatives of all poses with respect to joints and squared lengths. A step brings one pair of complex poses
//! together as far as it can, while no two real poses come nearer than a bound. This is a conic program, linear except
//! for the length of the step. Then all poses are computed again. A pair has one real number `q`, the sum of squared
//! differences of all entries of its two poses. It is negative for conjugates and positive for real poses. It passes
//! smoothly through zero at a double pose, although the poses themselves have infinite derivatives there. The same kind
//! of step thus brings a pair together, through the double pose, and apart again.

use nalgebra::{DVector, Matrix3, Matrix6, Vector3, Vector6};
use num_complex::Complex64;

use fk::{FkOptions, FkRoot, FkSolutions, PoseCounting, Reality, solver};
use num::conic::{ConicAnswer, ConicProgram, ConicRow, ConicTally};
use num::{Purpose, Rng};
use platform::geom::ComplexPose;
use platform::manipulator::{Body, Manipulator, SquaredLegLengths};

/// Length of the first and of the longest step, in units of the size.
const FIRST: f64 = 0.05;
const LONGEST: f64 = 0.3;
/// A step counts if it shrinks the squared imaginary parts by this factor.
const SHRUNK: f64 = 0.999;
/// A pair is given up if steps of this length do not bring it together.
const SHORTEST: f64 = 1e-4;
/// The factors on the step length after a rejected and after an accepted step.
const SHORTER: f64 = 0.5;
const LONGER: f64 = 1.5;
/// A pair is also given up if a spell of steps does not shrink its squared imaginary part to this share.
const SPELL_SHRINKS: f64 = 0.5;
/// Number of steps of a spell. It is small at first, since a pair that hardly moves here may meet quickly from another
/// place. It doubles each time no pair can be brought together, up to the greatest number.
const SHORTEST_SPELL: usize = 3;
const LONGEST_SPELL: usize = 40;
/// Squared distance that real poses keep; nearer pairs may not approach further.
const APART: f64 = 0.3;
/// Pairs of real poses within this multiple of the distance limit a step.
const WITHIN: f64 = 10.0;
/// The largest share of its distance that a pair of real poses may lose in one step.
const LOST: f64 = 0.5;
/// Shares of the greatest possible gain of two real poses at zero distance; the first share that is possible for all is
/// used.
const PARTING: [f64; 4] = [0.5, 0.25, 0.1, 0.0];
/// Tolerance on the constraints of a step, in units of its length.
const RESIDUAL: f64 = 1e-4;
/// Weight of separating close pairs of real poses; the weight of the target pair is 1.
const OPENING: f64 = 0.3;
/// Number of pairs of complex poses that are tried in turn.
const PAIRS: usize = 4;
/// Number and length of steps in a random direction, after every pair has been given up.
const WANDERING: usize = 5;
const WANDERED: f64 = 0.15;

/// The end of a search.
#[derive(Debug, Clone)]
pub(super) struct Climb {
    pub(super) manipulator: Manipulator,
    pub(super) squares: SquaredLegLengths,
    /// All poses at the end, with their evidence.
    pub(super) found: FkSolutions,
    /// Number of real poses at the start.
    pub(super) began: usize,
    /// Number of steps taken.
    pub(super) steps: usize,
}

/// The freedoms of a search: coordinates of joints, and six squared lengths.
#[derive(Debug)]
struct ClimbFreedoms {
    /// The coordinates as body, joint, axis.
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
}

/// A pair of poses: `q` in units of the size, and its derivatives with respect to the freedoms.
#[derive(Debug)]
struct PosePair {
    q: f64,
    slope: DVector<f64>,
}

impl ClimbFreedoms {
    /// Every coordinate of the joints that carry legs; a body with all joints at `z = 0` stays flat.
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

    /// The derivatives of a pose with respect to each freedom: rotations `w` (`dR = [w]x R`) and shifts in units of the
    /// size. `None` at a singular pose.
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
        // unknowns are w and dp / size; both sides are divided by the size
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

/// The derivatives of `sum f(entry)^2` over rotation and position (in units of the size) of a pose. The function `f`
/// takes a real number from the entries, and `at` has the values of `f` there.
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

/// The sum of squares of the imaginary parts.
fn measure(pose: &ComplexPose, size: f64) -> f64 {
    let (r, p) = imaginary(pose, size);
    r.norm_squared() + p.norm_squared()
}

fn real_difference(a: &ComplexPose, b: &ComplexPose, size: f64) -> (Matrix3<f64>, Vector3<f64>) {
    ((a.rotation - b.rotation).map(|z| z.re), (a.position - b.position).map(|z| z.re / size))
}

impl PosePair {
    /// A pose and its conjugate.
    fn conjugates(stand: &Stand, freedoms: &ClimbFreedoms, pose: &ComplexPose) -> Option<Self> {
        let moves = freedoms.derivatives(&stand.manipulator, pose)?;
        let (r, p) = imaginary(pose, freedoms.size);
        let slope = freedoms.without_scale(stand, -4.0 * slope(pose, &moves, (&r, &p), |z| z.im));
        Some(Self { q: -4.0 * measure(pose, freedoms.size), slope })
    }

    fn usable(self) -> Option<Self> {
        let norm = self.slope.norm();
        (norm.is_finite() && norm > 0.0).then_some(self)
    }
}

impl ClimbFreedoms {
    fn number(&self) -> usize {
        self.coordinates.len() + 6
    }

    /// The changes without their component that scales the whole platform.
    fn without_scale(&self, stand: &Stand, mut v: DVector<f64>) -> DVector<f64> {
        let joints = Body::BOTH.map(|body| stand.manipulator.joints(body));
        let own = self.coordinates.iter().map(|(body, j, axis)| joints[body.index()][*j][*axis] / self.size);
        let squares = stand.squares.get().map(|s| 2.0 * s / (self.size * self.size));
        let larger = DVector::from_iterator(self.number(), own.chain(squares)).normalize();
        v -= &larger * larger.dot(&v);
        v
    }

    /// The step of length at most `radius` that goes farthest along `aim`. Pairs of real poses keep their distance, and
    /// those that are too close separate.
    fn step(&self, aim: &DVector<f64>, kept: &[PosePair], radius: f64) -> Option<DVector<f64>> {
        PARTING.iter().find_map(|parting| self.step_parting(aim, kept, radius, *parting))
    }

    /// The same with this share of the greatest possible gain for a pair at zero distance.
    fn step_parting(
        &self,
        aim: &DVector<f64>,
        kept: &[PosePair],
        radius: f64,
        parting: f64,
    ) -> Option<DVector<f64>> {
        let n = self.number();
        // unknowns in units of the radius
        let mut program =
            ConicProgram { variables: n, linear: (-aim).iter().copied().collect(), ..Default::default() };
        for pair in kept {
            let norm = pair.slope.norm() * radius;
            let gain = if pair.q < APART {
                (parting * (1.0 - pair.q / APART)).min((APART - pair.q) / norm)
            } else {
                (LOST * pair.q).max(APART) / norm - pair.q / norm
            };
            let row = pair.slope.iter().enumerate().map(|(k, x)| (k, -x * radius / norm)).collect();
            program.at_least_zero(row, -gain);
        }
        let unit = |k: usize| ConicRow { coefficients: vec![(k, -1.0)], rhs: 0.0 };
        let mut ball = vec![ConicRow { coefficients: Vec::new(), rhs: 1.0 }];
        ball.extend((0..n).map(unit));
        program.second_order(ball);
        match program.solve(&ConicTally::default()) {
            ConicAnswer::Point(point) if point.residual < RESIDUAL => {
                Some(DVector::from_vec(point.x) * radius)
            }
            _ => None,
        }
    }
}

impl Stand {
    fn new(manipulator: Manipulator, squares: SquaredLegLengths, seed: u64) -> Option<Self> {
        // completeness is checked at the end
        let options = FkOptions::new().seed(seed).pose_count(PoseCounting::Never);
        let found = solver(None).solve(&manipulator, &squares, &options).ok()?;
        let real = found.assembly_modes().count();
        Some(Self { manipulator, squares, found, real })
    }

    fn complex(&self) -> impl Iterator<Item = &FkRoot> {
        self.found.roots.iter().filter(|r| r.reality == Reality::NonReal)
    }

    /// One pose of each pair of conjugates, ordered by the length of a step that would make them meet.
    fn targets(&self, freedoms: &ClimbFreedoms) -> Vec<ComplexPose> {
        let mut near: Vec<(f64, f64, &ComplexPose)> = self
            .complex()
            .filter_map(|r| {
                let pair = PosePair::conjugates(self, freedoms, &r.pose)?.usable()?;
                Some((-pair.q / pair.slope.norm(), -pair.q, &r.pose))
            })
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0));
        // conjugates have the same measure, up to rounding
        near.dedup_by(|a, b| (a.1 - b.1).abs() <= 1e-6 * b.1);
        near.into_iter().map(|(_, _, pose)| *pose).collect()
    }

    /// The complex pose nearest to a given one.
    fn nearest(&self, pose: &ComplexPose, size: f64) -> Option<ComplexPose> {
        let far = |r: &&FkRoot| r.pose.distance(pose, size);
        self.complex().min_by(|a, b| far(a).total_cmp(&far(b))).map(|r| r.pose)
    }

    /// Squared distances of pairs of real poses, ascending.
    fn distances(&self, size: f64) -> Vec<f64> {
        let real: Vec<&ComplexPose> = self.found.assembly_modes().map(|r| &r.pose).collect();
        let mut out = Vec::new();
        for i in 0..real.len() {
            for j in i + 1..real.len() {
                let (r, p) = real_difference(real[i], real[j], size);
                out.push(r.norm_squared() + p.norm_squared());
            }
        }
        out.sort_by(f64::total_cmp);
        out
    }

    /// Pairs of real poses close to each other.
    fn kept(&self, freedoms: &ClimbFreedoms) -> Vec<PosePair> {
        let size = freedoms.size;
        let real: Vec<&ComplexPose> = self.found.assembly_modes().map(|r| &r.pose).collect();
        let moves: Vec<_> = real.iter().map(|pose| freedoms.derivatives(&self.manipulator, pose)).collect();
        let mut pairs = Vec::new();
        for i in 0..real.len() {
            for j in i + 1..real.len() {
                let (r, p) = real_difference(real[i], real[j], size);
                let q = r.norm_squared() + p.norm_squared();
                if q > WITHIN * APART {
                    continue;
                }
                let (Some(first), Some(second)) = (&moves[i], &moves[j]) else { continue };
                let along =
                    |pose: &ComplexPose, moves: &[Vector6<Complex64>]| slope(pose, moves, (&r, &p), |z| z.re);
                let slope = freedoms.without_scale(self, along(real[i], first) - along(real[j], second));
                pairs.extend(PosePair { q, slope }.usable());
            }
        }
        pairs
    }
}

/// The direction that brings the target pair together, plus a small part that separates real poses that are too close.
fn aim(target: &PosePair, kept: &[PosePair]) -> DVector<f64> {
    let near = kept.iter().filter(|pair| pair.q < APART);
    let opening = near.map(|pair| pair.slope.normalize() * (OPENING * (1.0 - pair.q / APART)));
    opening.fold(target.slope.normalize(), |sum, v| sum + v)
}

/// A running search.
struct SingularClimb {
    freedoms: ClimbFreedoms,
    seed: u64,
    here: Stand,
    radius: f64,
    /// Number of steps of a spell.
    spell: usize,
    steps: usize,
    most: usize,
}

impl SingularClimb {
    /// The platform after a step; `None` if poses get lost, real ones become complex, or real ones come too close to
    /// each other.
    fn at(&self, by: &DVector<f64>) -> Option<Stand> {
        let (m, s) = self.freedoms.moved(&self.here, by)?;
        let there = Stand::new(m, s, self.seed)?;
        if there.found.roots.len() < self.here.found.roots.len() || there.real < self.here.real {
            return None;
        }
        let least = |stand: &Stand| stand.distances(self.freedoms.size);
        let (near, was) = (least(&there), least(&self.here));
        // pairs that have just met are the closest ones, and may be
        let allowed = was.iter().map(|q| LOST * q).fold(LOST * APART, f64::min);
        let fresh = (there.real - self.here.real) / 2;
        (near.get(fresh).is_none_or(|q| *q >= allowed)).then_some(there)
    }

    fn ended(&self) -> bool {
        self.steps >= self.most || self.here.complex().next().is_none()
    }

    /// Brings a pair of complex poses together until it is real (`true`) or no step brings it nearer.
    fn follow(&mut self, mut pose: ComplexPose) -> bool {
        self.radius = self.radius.max(FIRST);
        let mut milestone = f64::NEG_INFINITY;
        for step in 0_usize.. {
            if self.ended() {
                break;
            }
            let Some(pair) =
                PosePair::conjugates(&self.here, &self.freedoms, &pose).and_then(PosePair::usable)
            else {
                return false;
            };
            if step.is_multiple_of(self.spell) {
                if pair.q < SPELL_SHRINKS * milestone {
                    return false;
                }
                milestone = pair.q;
            }
            let kept = self.here.kept(&self.freedoms);
            let aim = aim(&pair, &kept);
            let Some(there) = self.forward(&aim, &kept, &pose, pair.q) else { return false };
            self.here = there.0;
            match there.1 {
                Some(next) => pose = next,
                None => return true,
            }
        }
        false
    }

    /// Tries the nearest pairs in turn, each from here, until one has become real.
    fn follow_nearest(&mut self) -> bool {
        let before = self.here.clone();
        for pose in before.targets(&self.freedoms).into_iter().take(PAIRS) {
            if self.follow(pose) {
                return true;
            }
            if self.ended() {
                return false;
            }
            self.here = before.clone();
        }
        false
    }

    /// The first step, from long to short, that gives more real poses or brings the pair nearer to being real. Returned
    /// with the new pose of the pair.
    fn forward(
        &mut self,
        aim: &DVector<f64>,
        kept: &[PosePair],
        pose: &ComplexPose,
        q: f64,
    ) -> Option<(Stand, Option<ComplexPose>)> {
        let size = self.freedoms.size;
        let mut refused = false;
        while self.radius > SHORTEST && self.steps < self.most {
            self.steps += 1;
            let by = self.freedoms.step(aim, kept, self.radius)?;
            let there = self.at(&by);
            let better = there.and_then(|there| {
                if there.real > self.here.real {
                    return Some((there, None));
                }
                let next = there.nearest(pose, size)?;
                (-4.0 * measure(&next, size) > q * SHRUNK).then_some((there, Some(next)))
            });
            if let Some(found) = better {
                if !refused {
                    self.radius = (LONGER * self.radius).min(LONGEST);
                }
                return Some(found);
            }
            refused = true;
            self.radius *= SHORTER;
        }
        None
    }

    /// Takes steps in a random direction that lose no real pose.
    fn wander(&mut self, rng: &mut Rng) {
        let n = self.freedoms.number();
        let direction = |rng: &mut Rng| DVector::from_iterator(n, (0..n).map(|_| rng.normal())).normalize();
        let mut aim = direction(rng);
        for _ in 0..WANDERING {
            let kept = self.here.kept(&self.freedoms);
            self.steps += 1;
            let mut radius = WANDERED;
            while radius > SHORTEST {
                let Some(by) = self.freedoms.step(&aim, &kept, radius) else { break };
                if let Some(there) = self.at(&by) {
                    self.here = there;
                    break;
                }
                radius *= SHORTER;
            }
            aim = (aim + direction(rng)).normalize();
        }
    }
}

/// Searches for a platform with more real poses, from a given one with its lengths, in at most `steps` steps.
///
/// # Errors
/// An error if the poses at the start or at the end cannot be computed.
pub(super) fn climb(
    m: &Manipulator,
    squares: &SquaredLegLengths,
    seed: u64,
    most: usize,
) -> Result<Climb, String> {
    let freedoms = ClimbFreedoms::of(m);
    let here = Stand::new(m.clone(), *squares, seed).ok_or("the poses of the start cannot be computed")?;
    let began = here.real;
    let mut rng: Rng = Purpose::SWEPT_AGAIN.item(seed, 2);
    let mut search =
        SingularClimb { freedoms, seed, here, radius: FIRST, spell: SHORTEST_SPELL, steps: 0, most };
    while !search.ended() {
        if search.follow_nearest() {
            search.spell = SHORTEST_SPELL;
        } else if !search.ended() {
            search.spell = (2 * search.spell).min(LONGEST_SPELL);
            search.wander(&mut rng);
        }
    }
    let (steps, here) = (search.steps, search.here);
    let options = FkOptions::new().seed(seed);
    let found = solver(None).solve(&here.manipulator, &here.squares, &options).map_err(|e| e.to_string())?;
    Ok(Climb { manipulator: here.manipulator, squares: here.squares, found, began, steps })
}

#[cfg(test)]
mod tests {
    use super::*;
    use ask::design::parse;
    use files::design::Format;

    fn octahedral() -> (Manipulator, SquaredLegLengths) {
        let text = include_str!("../../../designs/rbt-octahedral.toml");
        let (design, _) = parse(text, Format::Toml).unwrap();
        (design.manipulator().clone(), design.lengths.unwrap().squared())
    }

    #[test]
    fn derivatives_are_those_of_the_poses() {
        let text = include_str!("../../../designs/general-6-6.toml");
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

    /// A step goes as far as possible along the aim. If a pair of real poses would come too close, it follows a
    /// direction that does not bring it nearer.
    #[test]
    fn a_step_keeps_near_real_poses_apart() {
        let (m, _) = octahedral();
        let freedoms = ClimbFreedoms::of(&m);
        let n = freedoms.number();
        let unit = |k: usize| DVector::from_fn(n, |i, _| if i == k { 1.0 } else { 0.0 });
        let aim = (unit(0) + unit(1)).normalize();
        let free = freedoms.step(&aim, &[], 0.1).unwrap();
        assert!((free - &aim * 0.1).norm() < 1e-5);
        // at the bound, below it (the pair has to separate), and far above it (not active)
        for (q, least) in [(APART, 0.0), (0.5 * APART, 1e-3), (9.0 * APART, -0.1)] {
            let near = PosePair { q, slope: -unit(0) };
            let by = freedoms.step(&aim, &[near], 0.1).unwrap();
            assert!(
                -by[0] >= least - 1e-5 && by[1] > 0.05 && by.norm() < 0.1 + 1e-5,
                "{q}: {} {}",
                by[0],
                by[1]
            );
            assert_eq!(by[0] > 0.05, q > 2.0 * APART, "{q}: {}", by[0]);
        }
    }

    /// Dietmaier's result, starting from a random platform: all 40 poses are real.
    #[test]
    #[ignore = "evidence"]
    fn a_general_platform_is_led_to_forty_real_poses() {
        let reached = (0..12).any(|k| {
            let mut rng = Rng::stream(40, k);
            let mut body = || -> Vec<nalgebra::Point3<f64>> {
                (0..6).map(|_| std::array::from_fn::<_, 3, _>(|_| rng.uniform(-1.0, 1.0)).into()).collect()
            };
            let (base, platform) = (body(), body());
            let m = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
            let squares = std::array::from_fn(|_| rng.uniform(0.5, 2.5).powi(2));
            let found = climb(&m, &SquaredLegLengths::try_new(squares).unwrap(), 1, 1500).unwrap().found;
            found.assembly_modes().filter(|r| r.certified()).count() == 40
                && found.completeness.name() == "proved"
        });
        assert!(reached);
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
        assert!(found.found.roots.iter().all(fk::FkRoot::certified));
    }
}
