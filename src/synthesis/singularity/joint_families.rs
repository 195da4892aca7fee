//! Designs that are singular because joints coincide or are collinear, and the nearest member of each family.

use nalgebra::{DMatrix, DVector, Matrix3, Point3, Vector3};

use super::digit_units::DigitUnits;
use super::nearest::{Change, SOLVED, pseudo_solve};
use num::small::symmetric_eigen3;
use platform::manipulator::{Body, Manipulator};

/// Designs that are singular because groups of joints meet, or meet in points of a line.
///
/// The families are coincident legs, four legs at one point, all legs through two points, a collinear body, three legs
/// of a pencil, and a bundle and a pencil with a common line.
#[derive(Debug, Clone)]
pub(super) struct JointFamily {
    kind: &'static str,
    legs: Vec<usize>,
    conditions: Vec<Condition>,
}

/// The joints of each group are in one place, and these places are on one line. No joint is in two conditions.
#[derive(Debug, Clone)]
struct Condition {
    body: Body,
    groups: Vec<Vec<usize>>,
}

impl JointFamily {
    pub(super) fn all(m: &Manipulator) -> Vec<Self> {
        let mut found = Vec::new();
        let all: Vec<usize> = (0..6).collect();
        let mut add = |kind: &'static str, legs: &[usize], conditions: Vec<Condition>| {
            found.push(Self { kind, legs: legs.to_vec(), conditions });
        };
        for set in (1u8..64).map(members) {
            let rest: Vec<usize> = (0..6).filter(|i| !set.contains(i)).collect();
            if set.len() == 2 {
                add("coincident_legs", &set, Body::BOTH.map(|body| Condition::meet(m, body, &set)).to_vec());
            }
            for body in Body::BOTH {
                let meet = || Condition::meet(m, body, &set);
                if set.len() == 4 {
                    add("concurrent_four", &set, vec![meet()]);
                }
                if set.len() == 3 {
                    add("point_line", &set, vec![meet(), Condition::line(m, body.other(), &set)]);
                    for (legs, conditions) in stars_and_pencils(m, body, &set, &rest) {
                        add("star_and_pencil", &legs, conditions);
                    }
                    for other in Body::BOTH {
                        add("two_joints_hold_all_legs", &all, two_points(m, (body, &set), (other, &rest)));
                    }
                }
                if set.len() == 6 {
                    add("all_collinear", &set, vec![Condition::line(m, body, &set)]);
                }
            }
        }
        found
    }

    /// The least change into the family: points that must coincide move to their centroid, points that must be
    /// collinear move to the line through their centroid along the principal axis.
    pub(super) fn nearest(&self, m: &Manipulator) -> Change {
        self.changed(m, |condition| Some(condition.nearest(m.joints(condition.body))))
            .unwrap_or_else(|| self.still(m))
    }

    /// A change into the family with no coordinate beyond its unit, if one is found.
    pub(super) fn within(&self, m: &Manipulator, units: &DigitUnits) -> Option<Change> {
        units.contained(|scales| {
            self.changed(m, |condition| {
                let scales = condition.body.of((&scales.base, &scales.platform));
                condition.least(m.joints(condition.body), scales)
            })
        })
    }

    fn still(&self, m: &Manipulator) -> Change {
        let none = |joints: &[Point3<f64>]| vec![Vector3::zeros(); joints.len()];
        let (base, platform) = (none(m.base_joints()), none(m.platform_joints()));
        Change { kind: self.kind, legs: self.legs.clone(), coefficients: None, base, platform }
    }

    fn changed(
        &self,
        m: &Manipulator,
        by: impl Fn(&Condition) -> Option<Vec<(usize, Vector3<f64>)>>,
    ) -> Option<Change> {
        let mut change = self.still(m);
        for condition in &self.conditions {
            let joints = condition.body.of((&mut change.base, &mut change.platform));
            for (joint, moved) in by(condition)? {
                joints[joint] = moved;
            }
        }
        Some(change)
    }
}

fn members(mask: u8) -> Vec<usize> {
    (0..6).filter(|i| mask >> i & 1 == 1).collect()
}

/// The joints of `body` at which `legs` end, each once.
fn joints(m: &Manipulator, body: Body, legs: &[usize]) -> Vec<usize> {
    let pairs = m.pairs();
    let mut list: Vec<usize> = legs.iter().map(|i| body.of(pairs[*i])).collect();
    list.sort_unstable();
    list.dedup();
    list
}

/// Three legs share one point of `body`; two others go from one point of the other body to a line through it.
fn stars_and_pencils(
    m: &Manipulator,
    body: Body,
    star: &[usize],
    rest: &[usize],
) -> Vec<(Vec<usize>, Vec<Condition>)> {
    let at_star = joints(m, body, star);
    let pairs =
        rest.iter().map(|skipped| rest.iter().copied().filter(|i| i != skipped).collect::<Vec<usize>>());
    // with a leg of the pair at the star it is four legs at one point, another family
    let apart = pairs.filter(|pair| joints(m, body, pair).iter().all(|joint| !at_star.contains(joint)));
    apart
        .map(|pair| {
            let mut legs: Vec<usize> = star.iter().chain(&pair).copied().collect();
            legs.sort_unstable();
            let mut line = Condition::line(m, body, &pair);
            line.groups.push(at_star.clone());
            (legs, vec![line, Condition::meet(m, body.other(), &pair)])
        })
        .collect()
}

/// Two sets of legs, each through one point. A common joint makes the two points one.
fn two_points(m: &Manipulator, one: (Body, &[usize]), two: (Body, &[usize])) -> Vec<Condition> {
    let (first, second) = (Condition::meet(m, one.0, one.1), Condition::meet(m, two.0, two.1));
    let common = one.0 == two.0 && first.groups[0].iter().any(|joint| second.groups[0].contains(joint));
    if common { vec![Condition::meet(m, one.0, &[0, 1, 2, 3, 4, 5])] } else { vec![first, second] }
}

/// Most Gauss-Newton steps of a condition, which converges quadratically from rounded values.
const STEPS: usize = 20;
/// Steps below this, relative to the distances of the joints, end the iteration.
const SETTLED: f64 = 1e-15;

impl Condition {
    fn meet(m: &Manipulator, body: Body, legs: &[usize]) -> Self {
        Self { body, groups: vec![joints(m, body, legs)] }
    }

    fn line(m: &Manipulator, body: Body, legs: &[usize]) -> Self {
        Self { body, groups: joints(m, body, legs).into_iter().map(|joint| vec![joint]).collect() }
    }

    /// The least changes of the joints in closed form: the line through the weighted centroid of the groups along their
    /// principal axis.
    fn nearest(&self, at: &[Point3<f64>]) -> Vec<(usize, Vector3<f64>)> {
        let centre = |group: &Vec<usize>| {
            group.iter().map(|j| at[*j].coords).sum::<Vector3<f64>>() / group.len() as f64
        };
        let weight: f64 = self.groups.iter().map(|g| g.len() as f64).sum();
        let mean = self.groups.iter().map(|g| centre(g) * g.len() as f64).sum::<Vector3<f64>>() / weight;
        let term = |g: &Vec<usize>| (centre(g) - mean) * (centre(g) - mean).transpose() * g.len() as f64;
        let scatter: Matrix3<f64> = self.groups.iter().map(term).sum();
        let (values, vectors) = symmetric_eigen3(&scatter);
        let axis = vectors.column(values.imax()).into_owned();
        let places = self.groups.iter().flat_map(|group| {
            let place = mean + axis * axis.dot(&(centre(group) - mean));
            group.iter().map(move |j| (*j, place))
        });
        places.map(|(j, place)| (j, place - at[j].coords)).collect()
    }

    /// The least changes of the joints, with every coordinate measured in its scale. Coordinates without a scale stay.
    fn least(&self, at: &[Point3<f64>], scales: &[Vector3<f64>]) -> Option<Vec<(usize, Vector3<f64>)>> {
        let list: Vec<usize> = self.groups.concat();
        let first = *list.first()?;
        let size = list.iter().map(|j| (at[*j] - at[first]).norm()).fold(0.0, f64::max);
        let largest = list.iter().map(|j| scales[*j].amax()).fold(0.0, f64::max);
        let still = || list.iter().map(|j| (*j, Vector3::zeros())).collect();
        if !(size > 0.0 && largest > 0.0) {
            return (size <= 0.0).then(still);
        }
        let of = |f: &dyn Fn(usize) -> Vector3<f64>| {
            DVector::from_vec(list.iter().flat_map(|j| f(*j).iter().copied().collect::<Vec<_>>()).collect())
        };
        let start = of(&|j| (at[j] - at[first]) / size);
        let scale = of(&|j| scales[j] / largest);
        let equations = Equations::of(self, &start);
        let mut change = DVector::zeros(start.len());
        for _ in 0..STEPS {
            let (f, mut slope) = equations.at(&(&start + &change));
            let target = &slope * &change - f;
            slope.column_iter_mut().zip(scale.iter()).for_each(|(mut column, s)| column *= *s);
            let target = DMatrix::from_column_slice(target.len(), 1, target.as_slice());
            let next = pseudo_solve(&slope, &target)?;
            let next = DVector::from_column_slice(next.as_slice()).component_mul(&scale);
            let step = (&next - &change).norm();
            change = next;
            if step <= SETTLED {
                break;
            }
        }
        let residual = equations.at(&(&start + &change)).0.norm();
        let moved = |k: usize| change.fixed_rows::<3>(3 * k).into_owned() * size;
        (residual < SOLVED).then(|| list.iter().enumerate().map(|(k, j)| (*j, moved(k))).collect())
    }
}

/// The equations of a condition for its joints in their order: the joints of a group are where its first one is, and
/// these places lie on the line of the two that are farthest apart.
struct Equations {
    /// A joint and the first one of its group.
    together: Vec<(usize, usize)>,
    /// First joints of the groups.
    places: Vec<usize>,
    /// The two places of the line.
    ends: [usize; 2],
    /// Two directions normal to the line.
    normals: [Vector3<f64>; 2],
}

fn place(x: &DVector<f64>, joint: usize) -> Vector3<f64> {
    x.fixed_rows::<3>(3 * joint).into_owned()
}

impl Equations {
    fn of(condition: &Condition, x: &DVector<f64>) -> Self {
        let (mut together, mut places, mut next) = (Vec::new(), Vec::new(), 0);
        for group in &condition.groups {
            places.push(next);
            together.extend((1..group.len()).map(|k| (next + k, next)));
            next += group.len();
        }
        let pairs = places.iter().flat_map(|p| places.iter().map(move |q| [*p, *q]));
        let length = |[p, q]: &[usize; 2]| (place(x, *q) - place(x, *p)).norm();
        let ends = pairs.max_by(|x, y| length(x).total_cmp(&length(y))).unwrap_or_default();
        let axis = place(x, ends[1]) - place(x, ends[0]);
        let across = Vector3::ith(axis.iamin(), 1.0).cross(&axis).try_normalize(0.0).unwrap_or_default();
        let other = axis.cross(&across).try_normalize(0.0).unwrap_or_default();
        Self { together, places, ends, normals: [across, other] }
    }

    /// Values and slopes.
    fn at(&self, x: &DVector<f64>) -> (DVector<f64>, DMatrix<f64>) {
        let inner: Vec<usize> = self.places.iter().copied().filter(|p| !self.ends.contains(p)).collect();
        let count = 3 * self.together.len() + 2 * inner.len();
        let (mut values, mut slopes) = (DVector::zeros(count), DMatrix::zeros(count, x.len()));
        for (k, (joint, first)) in self.together.iter().enumerate() {
            for i in 0..3 {
                values[3 * k + i] = x[3 * joint + i] - x[3 * first + i];
                slopes[(3 * k + i, 3 * joint + i)] = 1.0;
                slopes[(3 * k + i, 3 * first + i)] = -1.0;
            }
        }
        let [from, to] = self.ends;
        let axis = place(x, to) - place(x, from);
        for (k, joint) in inner.iter().enumerate() {
            let arm = place(x, *joint) - place(x, from);
            for (i, normal) in self.normals.iter().enumerate() {
                // n.(arm x axis) and its slopes by both vectors
                let (by_arm, by_axis) = (axis.cross(normal), normal.cross(&arm));
                let row = 3 * self.together.len() + 2 * k + i;
                values[row] = normal.dot(&arm.cross(&axis));
                for j in 0..3 {
                    slopes[(row, 3 * joint + j)] += by_arm[j];
                    slopes[(row, 3 * to + j)] += by_axis[j];
                    slopes[(row, 3 * from + j)] -= by_arm[j] + by_axis[j];
                }
            }
        }
        (values, slopes)
    }
}
