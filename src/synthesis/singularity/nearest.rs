//! The distance of a design from architectural singularity.
//!
//! Distance is the Euclidean norm of the change of all joints together, design units; a shared joint moves as one. The
//! result is an explicit singular design, hence an upper bound of the distance; the optimum may be smaller.
//!
//! The nearest design with a relation between its leg vectors is found by Gauss-Newton steps on joints and relation
//! together. They minimise `|y|^2` over changes `y` of the joints and unit vectors `c` with
//! `F = sum c_i v_i(x_0 + y) = 0` (sixteen equations). Each step solves the linearised problem. The least `y` meets the
//! part of the equations that a change of `c` cannot reach; `c` meets the rest.
//!
//! [`JointFamily`] gives the nearest designs that are singular since joints coincide or are collinear.

use nalgebra::{DMatrix, DVector, Point3, Vector3};

use super::digit_units::DigitUnits;
use super::joint_families::JointFamily;
use super::lattice::candidate_poses;
use super::lower_bound::proved_at_pose;
use crate::LegSpan;
use num::Purpose;
use num::linalg::LinalgError;
use num::small::bounded_svd;
use platform::manipulator::{InvalidManipulator, Manipulator};

/// A singular design near a given one.
#[derive(Debug, Clone, PartialEq)]
pub struct NearestSingular {
    /// Norm of the change of all joints, design units.
    pub distance: f64,
    /// The kind of singularity: a name as in [`Case::name`](super::Case::name).
    pub kind: &'static str,
    /// The dependent legs (0-based).
    pub legs: Vec<usize>,
    /// The relation between leg vectors, if it causes the singularity; of norm 1.
    pub coefficients: Option<[f64; 6]>,
    /// Base joints of the singular design, in the order of the manipulator; unused joints stay.
    pub base: Vec<Point3<f64>>,
    /// Its platform joints.
    pub platform: Vec<Point3<f64>>,
    /// The rounding residual of these joints. It is the ratio of smallest to largest singular value of the normalised
    /// leg vectors for a relation between them, otherwise 0.
    pub residual: f64,
    /// Whether every coordinate changes by at most `2^-50` of the largest coordinate of its body, so that rounding of
    /// the file may hide the change.
    pub within_rounding: bool,
    /// Half a unit of the last given digit, design units, if no coordinate changes by more: the same for all
    /// coordinates with equal decimals, the largest with equal significant digits. The design is then singular to the
    /// given digits.
    pub within_digits: Option<f64>,
}

impl NearestSingular {
    /// Whether the design may be a rounded value of this one.
    #[must_use]
    pub fn may_be_meant(&self) -> bool {
        self.within_rounding || self.within_digits.is_some()
    }

    /// The relation to this design in words, if it may be the intended one; lengths in `units`.
    #[must_use]
    pub fn words(&self, units: &str) -> String {
        match self.within_digits.filter(|_| !self.within_rounding) {
            Some(half) => format!("singular to the digits given ({half} {units})"),
            None => format!("singular within rounding ({:.1e} {units})", self.distance),
        }
    }
}

/// The singular design whose rounded values the plain doubles may be, if any; only called for designs that are regular
/// as written.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub(super) fn rounded_singular(m: &Manipulator) -> Result<Option<NearestSingular>, LinalgError> {
    let digits = DigitUnits::given(m);
    // if one pose proves a distance from singular designs beyond rounding, no search is needed
    let reach = 6.0 * ROUNDING * largest(m.base_joints()).max(largest(m.platform_joints()));
    let reach = digits.iter().map(DigitUnits::reach).fold(reach, f64::max);
    if candidate_poses(m).take(4).any(|pose| proved_at_pose(m, &pose.pose()) > reach) {
        return Ok(None);
    }
    let Some(nearest) = nearest_singular(m, SEED)? else { return Ok(None) };
    if nearest.may_be_meant() {
        return Ok(Some(nearest));
    }
    // the nearest design may change one coordinate too much while another changes none so
    for units in digits.iter().filter(|units| nearest.distance <= units.reach()) {
        let near = |family: &JointFamily| family.nearest(m).norm() <= units.reach();
        let closed = JointFamily::all(m).into_iter().filter(near).find_map(|family| family.within(m, units));
        let searched = || {
            let starts = UnitCoefficients::all(m, SEED, STARTS);
            starts.iter().find_map(|start| units.contained(|scales| project(m, start, Some(scales))))
        };
        if let Some(meant) = closed.or_else(searched) {
            return describe(m, meant).map(Some);
        }
    }
    Ok(None)
}

fn largest(points: &[Point3<f64>]) -> f64 {
    points.iter().map(|p| p.coords.amax()).fold(0.0, f64::max)
}

/// Changes of the joints that make a design singular.
#[derive(Debug, Clone)]
pub(super) struct Change {
    pub(super) kind: &'static str,
    pub(super) legs: Vec<usize>,
    pub(super) coefficients: Option<[f64; 6]>,
    pub(super) base: Vec<Vector3<f64>>,
    pub(super) platform: Vec<Vector3<f64>>,
}

impl Change {
    pub(super) fn norm(&self) -> f64 {
        self.base.iter().chain(&self.platform).map(Vector3::norm_squared).sum::<f64>().sqrt()
    }
}

/// Fixed seed of the search for an intended singular design: the verdict on a design must not depend on the seed of a
/// command.
const SEED: u64 = 1;
/// Share of the largest coordinate that counts as rounding: eight half units in its last place.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;
/// Two distances that differ by less than this count as equal.
const SAME: f64 = 1e-6;
/// Random starts besides the six singular vectors.
const STARTS: u64 = 12;

/// The nearest singular design found. Closed forms serve joints that must coincide or be collinear; local optimisation
/// from several starts (with `seed`) serves relations between leg vectors.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn nearest_singular(m: &Manipulator, seed: u64) -> Result<Option<NearestSingular>, LinalgError> {
    let least = |all: Vec<Change>| {
        all.into_iter().filter(|c| c.norm().is_finite()).min_by(|x, y| x.norm().total_cmp(&y.norm()))
    };
    let closed = least(JointFamily::all(m).iter().map(|family| family.nearest(m)).collect());
    let searched = least(
        UnitCoefficients::all(m, seed, STARTS).iter().filter_map(|start| project(m, start, None)).collect(),
    );
    let best = match (closed, searched) {
        // if both ways find the same design, take the exact one regardless of rounding
        (Some(x), Some(y)) => Some(if x.norm() <= y.norm() * (1.0 + SAME) { x } else { y }),
        (x, y) => x.or(y),
    };
    best.map(|change| describe(m, change)).transpose()
}

fn describe(m: &Manipulator, change: Change) -> Result<NearestSingular, LinalgError> {
    let moved = |from: &[Point3<f64>], by: &[Vector3<f64>]| -> Vec<Point3<f64>> {
        from.iter().zip(by).map(|(p, d)| p + d).collect()
    };
    let base = moved(m.base_joints(), &change.base);
    let platform = moved(m.platform_joints(), &change.platform);
    let rebuilt: Result<Manipulator, InvalidManipulator> =
        Manipulator::try_new(base.clone(), platform.clone(), m.pairs());
    let (residual, kind) = match (&change.coefficients, rebuilt) {
        (Some(_), Ok(there)) => {
            (LegSpan::of(&there, 0.0)?.inverse_condition(), super::case::name(&there, &change.legs)?)
        }
        _ => (0.0, change.kind),
    };
    let within = |by: &[Vector3<f64>], limit: f64| by.iter().all(|d| d.amax() <= limit);
    let within_rounding = within(&change.base, ROUNDING * largest(m.base_joints()))
        && within(&change.platform, ROUNDING * largest(m.platform_joints()));
    let within_digits =
        DigitUnits::given(m).iter().find(|units| units.contain(&change)).map(DigitUnits::largest);
    Ok(NearestSingular {
        distance: change.norm(),
        kind,
        legs: change.legs,
        coefficients: change.coefficients,
        base,
        platform,
        residual,
        within_rounding,
        within_digits,
    })
}

/// The start of the search: a unit vector of coefficients.
#[derive(Debug, Clone, Copy)]
pub(super) struct UnitCoefficients([f64; 6]);

impl UnitCoefficients {
    /// The six singular vectors of the relation `c -> sum c_i v_i`, and `random` others.
    pub(super) fn all(m: &Manipulator, seed: u64, random: u64) -> Vec<Self> {
        let problem = NearestProblem::of(m);
        let singular = bounded_svd(&problem.vectors(&problem.start)).and_then(|d| d.v_t);
        let rows =
            singular.iter().flat_map(|v| (0..6).rev().map(move |k| std::array::from_fn(|i| v[(k, i)])));
        let mut starts: Vec<Self> = rows.map(Self).collect();
        for k in 0..random {
            let mut rng = Purpose::NEAREST_STARTS.item(seed, k);
            starts.push(Self([(); 6].map(|()| rng.normal())));
        }
        starts
    }
}

/// Most Gauss-Newton steps.
const STEPS: usize = 60;
/// Largest change in one step, in the normalised coordinates.
const STRIDE: f64 = 0.3;
/// Largest `|F|` at the end, in the normalised coordinates.
pub(super) const SOLVED: f64 = 1e-13;
/// Smaller steps than this end the search: they leave their square in `F`.
const SETTLED: f64 = 1e-10;
/// Legs with a smaller share in the relation count as outside it.
const SHARE: f64 = 1e-7;

/// Coordinates below this, relative to the size, are ignored in the search; results are measured from the original
/// joints.
const LEAST: f64 = 1e-100;

/// Joints in use, centred and scaled to the size.
struct NearestProblem {
    joints: [Vec<usize>; 2],
    start: DVector<f64>,
    legs: [(usize, usize); 6],
}

impl NearestProblem {
    fn of(m: &Manipulator) -> Self {
        let used = |pick: fn(&(usize, usize)) -> usize| {
            let mut list: Vec<usize> = m.pairs().iter().map(pick).collect();
            list.sort_unstable();
            list.dedup();
            list
        };
        let joints = [used(|p| p.0), used(|p| p.1)];
        let mut x = Vec::new();
        for (list, at) in joints.iter().zip([m.base_joints(), m.platform_joints()]) {
            let first = at[list[0]];
            let mean = list.iter().map(|j| at[*j] - first).sum::<Vector3<f64>>() / list.len() as f64;
            let scaled = |j: &usize| (at[*j] - first - mean) / m.size();
            // parts too small for any sum with a part of order one: their products underflow, so iterations would not
            // converge
            let held = |x: f64| if x.abs() < LEAST { 0.0 } else { x };
            x.extend(list.iter().flat_map(|j| scaled(j).iter().map(|x| held(*x)).collect::<Vec<_>>()));
        }
        let place = |list: &[usize], j: usize| list.iter().position(|k| *k == j).unwrap_or_default();
        let legs = m.pairs().map(|(a, b)| (place(&joints[0], a), joints[0].len() + place(&joints[1], b)));
        Self { joints, start: DVector::from_vec(x), legs }
    }

    /// The scales of all coordinates, over the largest; 1 without scales.
    fn weights(&self, scales: Option<&DigitUnits>) -> DVector<f64> {
        let Some(scales) = scales else { return DVector::from_element(self.start.len(), 1.0) };
        let of_body = self.joints.iter().zip([&scales.base, &scales.platform]);
        let joints = of_body.flat_map(|(used, all)| used.iter().map(|j| &all[*j]));
        let list: Vec<f64> = joints.flat_map(|half| half.iter().map(|x| x / scales.largest())).collect();
        DVector::from_vec(list)
    }

    /// `(1, a)` and `(1, b)` of a leg.
    fn ends(&self, x: &DVector<f64>, leg: usize) -> [[f64; 4]; 2] {
        let (a, b) = self.legs[leg];
        [a, b].map(|j| [1.0, x[3 * j], x[3 * j + 1], x[3 * j + 2]])
    }

    /// The leg vectors as columns.
    fn vectors(&self, x: &DVector<f64>) -> DMatrix<f64> {
        let ends: Vec<_> = (0..6).map(|i| self.ends(x, i)).collect();
        DMatrix::from_fn(16, 6, |k, i| ends[i][0][k / 4] * ends[i][1][k % 4])
    }

    /// Derivative of `sum c_i v_i` by the joints.
    fn by_joints(&self, x: &DVector<f64>, c: &DVector<f64>) -> DMatrix<f64> {
        let mut d = DMatrix::zeros(16, x.len());
        for leg in 0..6 {
            let [a, b] = self.ends(x, leg);
            let (j, k) = self.legs[leg];
            for axis in 0..3 {
                for other in 0..4 {
                    d[(4 * (axis + 1) + other, 3 * j + axis)] += c[leg] * b[other];
                    d[(4 * other + axis + 1, 3 * k + axis)] += c[leg] * a[other];
                }
            }
        }
        d
    }
}

/// Follows one start; `None` if it does not converge to a design with a relation. With `scales`, every coordinate is
/// measured in its own, and coordinates without a scale stay.
fn project(m: &Manipulator, start: &UnitCoefficients, scales: Option<&DigitUnits>) -> Option<Change> {
    let problem = NearestProblem::of(m);
    let weights = problem.weights(scales);
    let mut x = problem.start.clone();
    let mut c = DVector::from_row_slice(&start.0).normalize();
    for _ in 0..STEPS {
        let v = problem.vectors(&x);
        let f = &v * &c;
        let by_x = problem.by_joints(&x, &c);
        let reached = bounded_svd(&tangent(&v, &c))?;
        // columns of U with a singular value: the range of changes of c
        let u = reached.u.as_ref()?;
        let limit = 1e-10 * reached.singular_values.max();
        let kept: Vec<usize> = (0..5).filter(|k| reached.singular_values[*k] > limit).collect();
        let across = |w: &DMatrix<f64>| {
            let basis = u.select_columns(&kept);
            w - &basis * (basis.transpose() * w)
        };
        let y = &x - &problem.start;
        let target = across(&DMatrix::from_column_slice(16, 1, (&by_x * &y - &f).as_slice()));
        let mut weighted = by_x.clone();
        weighted.column_iter_mut().zip(weights.iter()).for_each(|(mut column, weight)| column *= *weight);
        let least = pseudo_solve(&across(&weighted), &target)?;
        let mut step = DVector::from_column_slice(least.as_slice()).component_mul(&weights) - &y;
        let left = -(&f + &by_x * &step);
        let mut turn = pseudo_solve(&tangent(&v, &c), &DMatrix::from_column_slice(16, 1, left.as_slice()))?;
        let damping = (STRIDE / step.norm().max(turn.norm())).min(1.0);
        step *= damping;
        turn *= damping;
        x += &step;
        c = (&c + basis_across(&c) * DVector::from_column_slice(turn.as_slice())).normalize();
        if step.norm() <= SETTLED && turn.norm() <= SETTLED {
            break;
        }
    }
    let residual = (problem.vectors(&x) * &c).norm();
    (residual < SOLVED).then(|| change(m, &problem, &x, &c))
}

/// An orthonormal basis of the vectors perpendicular to `c`, as 6 x 5.
fn basis_across(c: &DVector<f64>) -> DMatrix<f64> {
    // Householder: the reflection that maps the first axis to c maps the others to a basis
    let mut h = c.clone();
    let sign = if h[0] < 0.0 { -1.0 } else { 1.0 };
    h[0] += sign;
    let reflection = DMatrix::identity(6, 6) - (&h * h.transpose()) * (2.0 / h.norm_squared());
    reflection.columns(1, 5).into_owned()
}

/// Changes of `F` by changes of `c` on the unit sphere.
fn tangent(v: &DMatrix<f64>, c: &DVector<f64>) -> DMatrix<f64> {
    v * basis_across(c)
}

pub(super) fn pseudo_solve(a: &DMatrix<f64>, b: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    let svd = bounded_svd(a)?;
    let limit = 1e-10 * svd.singular_values.max();
    svd.solve(b, limit).ok()
}

fn change(m: &Manipulator, problem: &NearestProblem, x: &DVector<f64>, c: &DVector<f64>) -> Change {
    let moved = (x - &problem.start) * m.size();
    let still = |count: usize| vec![Vector3::zeros(); count];
    let mut bodies = [still(m.base_joints().len()), still(m.platform_joints().len())];
    let mut next = 0;
    for (body, list) in problem.joints.iter().enumerate() {
        for j in list {
            bodies[body][*j] = Vector3::new(moved[next], moved[next + 1], moved[next + 2]);
            next += 3;
        }
    }
    let [base, platform] = bodies;
    let coefficients: [f64; 6] = std::array::from_fn(|i| c[i]);
    let legs = (0..6).filter(|i| c[*i].abs() > SHARE).collect();
    Change { kind: "leg_vectors_dependent", legs, coefficients: Some(coefficients), base, platform }
}

#[cfg(test)]
mod tests {
    use super::super::digit_units::half_unit;
    use super::*;
    use nalgebra::Rotation3;
    use num::Rng;
    use platform::geom::random_rotation;
    use platform::manipulator::Leg;

    /// A Griffis-Duffy platform with `prod t_i = prod (1 - t_i)`, rotated and moved in general.
    fn singular() -> [Leg; 6] {
        let corner = |x: f64, y: f64| Vector3::new(x, y, 0.0);
        let base = [corner(0., 0.), corner(160., 0.), corner(40., 120.)];
        let platform = [corner(0., 0.), corner(80., 40.), corner(-40., 80.)];
        let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let t = [0.3, 0.7, 0.4, 0.2, 0.8, 0.6];
        let turn = |x: f64, y: f64, z: f64| Rotation3::new(Vector3::new(x, y, z));
        let (turns, shifts) = (
            [turn(0.4, -0.9, 0.3), turn(-0.2, 0.5, 1.1)],
            [Vector3::new(7.3, -5.1, 11.2), Vector3::new(-61.7, 0.3, 18.9)],
        );
        std::array::from_fn(|k| {
            let ((i, j), (l, n)) = (hexagon[k], hexagon[(k + 1) % 6]);
            let at = |p: Vector3<f64>, q: Vector3<f64>, body: usize| {
                Point3::from(turns[body] * (p + (q - p) * t[k]) + shifts[body])
            };
            Leg { base: at(base[i], base[l], 0), platform: at(platform[j], platform[n], 1) }
        })
    }

    fn rounded(legs: &[Leg; 6], round: &dyn Fn(f64) -> f64) -> Manipulator {
        let point = |p: &Point3<f64>| Point3::from(p.coords.map(round));
        let leg = |l: &Leg| Leg { base: point(&l.base), platform: point(&l.platform) };
        Manipulator::from_legs(legs.each_ref().map(leg)).unwrap()
    }

    fn significant(digits: usize) -> impl Fn(f64) -> f64 {
        move |x| format!("{x:.*e}", digits - 1).parse().unwrap()
    }

    fn decimals(count: usize) -> impl Fn(f64) -> f64 {
        move |x| format!("{x:.count$}").parse().unwrap()
    }

    #[test]
    fn a_singular_design_is_recognised_behind_its_digits() {
        let exact = singular();
        for digits in [5, 6, 8, 10, 12, 14, 17] {
            let m = rounded(&exact, &significant(digits));
            let meant = rounded_singular(&m).unwrap();
            assert!(meant.is_some_and(|n| n.may_be_meant()), "{digits} significant digits");
        }
        for count in [2, 3, 5, 8, 11] {
            let m = rounded(&exact, &decimals(usize::try_from(count).unwrap()));
            let meant = rounded_singular(&m).unwrap().unwrap();
            assert!(meant.within_rounding || meant.within_digits == Some(half_unit(count)), "{count}");
        }
    }

    /// Leg ends of singular designs by kind, with general numbers.
    fn of_kind(kind: &str, rng: &mut Rng) -> [Leg; 6] {
        let mut point = || Vector3::from_fn(|_, _| rng.uniform(-90.0, 90.0));
        let (mut a, mut b) = ([0; 6].map(|_| point()), [0; 6].map(|_| point()));
        let (o, p, d, e) = (point(), point(), point(), point());
        let t = [-0.9, -0.4, 0.1, 0.35, 0.7, 1.1].map(|t| t + 0.001 * o.x);
        match kind {
            "all_collinear" => b = t.map(|t| p + e * t),
            "point_line" => (0..3).for_each(|k| (a[k], b[k]) = (o, p + e * t[k])),
            "star_and_pencil" => {
                (0..3).for_each(|k| a[k] = o);
                (a[3], a[4], b[4]) = (o + d * t[0], o + d * t[4], b[3]);
            }
            "five_between_lines" => (0..5).for_each(|k| {
                (a[k], b[k]) = (o + d * t[k], p + e * t[(k * k + 1) % 6]);
            }),
            "four_paired" => (0..4).for_each(|k| {
                (a[k], b[k]) = (o + d * t[k], p + e * ((3.0 * t[k] + 0.2) / (t[k] + 2.5)));
            }),
            "line_plane" => (0..5).for_each(|k| {
                let w = 1.0 + 0.4 * t[k] * t[k];
                (a[k], b[k]) = (o + d * t[k], p + e * (t[k] / w) + d * (t[k] * t[k] / w));
            }),
            _ => {
                // projective images of points on an ellipse, similar ones on a circle
                let circle = kind == "similar_circles";
                for (k, t) in t.into_iter().enumerate() {
                    let (sin, cos) = (3.0 * t).sin_cos();
                    a[k] = Vector3::new(90.0 * cos, if circle { 90.0 } else { 60.0 } * sin, 0.0);
                    let w = if circle { 1.0 } else { 1.0 + 0.002 * a[k].x };
                    b[k] = Vector3::new(0.6 * a[k].x, 0.6 * a[k].y, 0.0) / w;
                }
            }
        }
        std::array::from_fn(|k| Leg { base: Point3::from(a[k]), platform: Point3::from(b[k]) })
    }

    /// The same legs in other frames and another unit.
    fn moved(legs: &[Leg; 6], rng: &mut Rng) -> [Leg; 6] {
        let scale = 10f64.powf(rng.uniform(-2.0, 3.0));
        let mut frame = || (random_rotation(rng), Vector3::from_fn(|_, _| rng.uniform(-150.0, 150.0)));
        let frames = [frame(), frame()];
        let at = |p: &Point3<f64>, (turn, shift): &(Rotation3<f64>, Vector3<f64>)| {
            Point3::from((turn * p.coords + shift) * scale)
        };
        legs.each_ref().map(|l| Leg { base: at(&l.base, &frames[0]), platform: at(&l.platform, &frames[1]) })
    }

    const KINDS: [&str; 8] = [
        "all_collinear",
        "point_line",
        "star_and_pencil",
        "five_between_lines",
        "four_paired",
        "line_plane",
        "similar_circles",
        "conic",
    ];

    /// Rounded coordinates of joints on a line are not on one. The line through them that changes all coordinates by
    /// half a unit at most is not that of the least squares.
    #[test]
    fn every_kind_is_recognised_behind_its_digits_in_any_frame() {
        let mut rng = Rng::new(8);
        for (k, kind) in KINDS.into_iter().cycle().take(24).enumerate() {
            let legs = moved(&of_kind(kind, &mut rng), &mut rng);
            let digits = [6, 9, 12][k / KINDS.len()];
            let m = rounded(&legs, &significant(digits));
            let meant = rounded_singular(&m).unwrap();
            assert!(meant.is_some_and(|n| n.may_be_meant()), "{kind}, {digits} digits, case {k}");
        }
    }

    #[test]
    fn regular_designs_with_few_digits_are_meant() {
        let mut rng = Rng::new(5);
        for digits in [5, 6, 9, 12] {
            let mut point = || Point3::new(rng.normal(), rng.normal(), 0.1 * rng.normal());
            let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
            assert_eq!(rounded_singular(&rounded(&legs, &significant(digits))).unwrap(), None, "{digits}");
        }
        // a thousand units of the last digit off the singular design
        let mut legs = singular();
        legs[2].platform.x += 1e-5;
        assert_eq!(rounded_singular(&rounded(&legs, &significant(10))).unwrap(), None);
    }
}
