//! Allowed position errors of the joints.

use nalgebra::{Matrix3, Point3, Vector3};

use super::gauge::Gauge;
use super::joint::{Joint, joints};
use super::product::largest_product;
use super::sample::{ErrorBound, ErrorKind, PoseSample, PoseSearch, SampleEntry, Shares, ToleranceError};
use super::trials::solved_error;
use crate::requirements::PoseSpace;
use num::small::symmetric_eigen3;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// Gap of the bracket of the worst case at the worst pose.
const GAP: f64 = 1e-6;
/// Accuracy of the allowances of largest product, and rounds of new constraints at most.
const PRODUCT: (f64, usize) = (1e-3, 80);
/// A coordinate below this share of the largest influence has no influence.
const NO_INFLUENCE: f64 = 1e-12;

/// An allowed joint error with the bound that limits it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "JointLimitRecord", transform = num::nullable))]
pub struct LimitedAllowance {
    /// Allowed error to first order, design units.
    // no error of this size reaches the bound at the sampled poses
    pub value: f64,
    /// Error that reaches the bound to first order.
    // some error of this size reaches it at `pose`; it exceeds `value` by a millionth at most, except for worst cases
    // with nearly equal directions
    pub reached: f64,
    /// Bound reached.
    #[cfg_attr(feature = "serde", serde(rename = "limited_by"))]
    pub kind: ErrorKind,
    /// Pose at which it is reached.
    #[cfg_attr(feature = "serde", serde(with = "platform::geom::ByQuaternion"))]
    pub pose: Pose,
}

/// The allowance of a single joint.
#[derive(Debug, Clone, PartialEq)]
pub struct JointBudget {
    /// The joint.
    pub joint: Joint,
    /// Allowed error of this joint alone in the worst direction, with all other joints in place.
    pub alone: LimitedAllowance,
    /// The worst direction, frame of the body, of norm 1; the opposite one is as bad.
    pub direction: Vector3<f64>,
    /// Error at `alone.pose` per unit of error in that direction: of the tool point (no unit) and of the orientation
    /// (degrees per design unit).
    pub per_unit: (f64, f64),
    /// Allowed error of this joint alone along each axis of the body frame; `None` where an error has no influence.
    pub along: [Option<f64>; 3],
    /// Half widths of the box of errors with the largest product over all joints; `None` where an error has no
    /// influence.
    pub product_box: [Option<f64>; 3],
}

/// Allowed errors of all joints together.
#[derive(Debug, Clone, PartialEq)]
pub struct Budget {
    /// All joints at once, each in a ball of this radius.
    pub radius: LimitedAllowance,
    /// All coordinates at once, each up to this much.
    pub half_width: LimitedAllowance,
    /// Joints, the most critical first.
    pub joints: Vec<JointBudget>,
    /// Errors of all joints that use up the bound at `radius.pose`, of length `radius.reached`, in the order of
    /// [`joints`].
    pub worst_errors: Vec<Vector3<f64>>,
    /// Poses of the sample.
    pub poses: usize,
}

/// Steps in which a radius is made smaller.
const SHRINKING: usize = 30;

impl Budget {
    /// The share of the bounds that the worst joint errors reach at their pose, with this length and either sign. The
    /// pose is solved, not linearised. `None` where a pose could not be followed.
    #[must_use]
    pub fn solved_share(
        &self,
        m: &Manipulator,
        tool: &Point3<f64>,
        bound: &ErrorBound,
        radius: f64,
    ) -> Option<f64> {
        [1.0, -1.0].into_iter().try_fold(0.0_f64, |most, sign| {
            let scale = sign * radius / self.radius.reached;
            let errors: Vec<_> = self.worst_errors.iter().map(|e| e * scale).collect();
            let (p, w) = solved_error(m, &errors, &self.radius.pose, tool)?;
            Some(most.max(p.norm() / bound.position).max(w.norm().to_degrees() / bound.rotation_deg))
        })
    }

    /// A radius, at most that of the budget, whose worst errors keep the bound at their pose when the pose is solved,
    /// with either sign.
    #[must_use]
    pub fn solved_radius(&self, m: &Manipulator, tool: &Point3<f64>, bound: &ErrorBound) -> Option<f64> {
        let mut radius = self.radius.value;
        for _ in 0..SHRINKING {
            match self.solved_share(m, tool, bound, radius) {
                Some(used) if used <= 1.0 => return Some(radius),
                Some(used) => radius *= (1.0 - 1e-9) / used.min(2.0),
                None => radius *= 0.5,
            }
        }
        None
    }
}

/// The larger use of the two bounds, and its kind.
fn larger(values: [f64; 2]) -> (f64, ErrorKind) {
    if values[1] > values[0] { (values[1], ErrorKind::Rotation) } else { (values[0], ErrorKind::Position) }
}

fn index(kind: ErrorKind) -> usize {
    usize::from(kind == ErrorKind::Rotation)
}

/// The pose with the greatest value of a family of gauges, with the bracket there.
fn limit(
    sample: &PoseSample<'_>,
    gauge: &dyn Fn(&[Matrix3<f64>]) -> Gauge,
) -> Result<(LimitedAllowance, SampleEntry, Vector3<f64>), ToleranceError> {
    let measure = |s: &Shares| larger([0, 1].map(|k| gauge(&s[k]).search().0)).0;
    let (_, worst) = sample.worst(&measure)?;
    let brackets = [0, 1].map(|k| gauge(&worst.shares[k]).bracket(GAP));
    let (_, kind) = larger(brackets.map(|b| b.least));
    let most = brackets[0].most.max(brackets[1].most);
    let reached = brackets[index(kind)];
    let limit = LimitedAllowance { value: 1.0 / most, reached: 1.0 / reached.least, pose: worst.pose, kind };
    Ok((limit, worst, reached.direction))
}

/// The largest singular value of a matrix with its right singular vector.
fn norm_and_direction(g: &Matrix3<f64>) -> (f64, Vector3<f64>) {
    let (values, vectors) = symmetric_eigen3(&(g.transpose() * g));
    let k = values.imax();
    (values[k].max(0.0).sqrt(), vectors.column(k).into())
}

/// The vector with the sign that makes its entry of largest modulus positive.
fn oriented(v: Vector3<f64>) -> Vector3<f64> {
    let entry = v[v.iamax()];
    if entry < 0.0 { -v } else { v }
}

/// The tolerance budget of a manipulator over a workspace: first order in the errors, worst case over them.
///
/// Pose errors are those of [`Sensitivity`](super::Sensitivity). Worst cases over balls are `max_n sum_j |G_j^T n|`,
/// over boxes `max_n sum_jk |g_jk . n|`. Subdivision of the sphere of directions `n` brackets them. Poses are sampled,
/// so a worse pose between them is possible, if unlikely.
///
/// # Errors
/// [`ToleranceError`]: a bound that is not positive, or a singular pose in the workspace.
pub fn budget(
    m: &Manipulator,
    space: &PoseSpace,
    tool: Point3<f64>,
    bound: ErrorBound,
    search: &PoseSearch,
) -> Result<Budget, ToleranceError> {
    let sample = PoseSample::new(m, space, tool, bound, search)?;
    let count = joints(m).len();
    let (radius, worst, direction) = limit(&sample, &|g| Gauge::balls(g, 1.0))?;
    let worst_errors = worst.shares[index(radius.kind)]
        .iter()
        .map(|g| g.tr_mul(&direction).try_normalize(0.0).unwrap_or_default() * radius.reached)
        .collect();
    let ones = vec![Vector3::repeat(1.0); count];
    let (half_width, _, _) = limit(&sample, &|g| Gauge::boxes(g, &ones))?;
    let rows = coordinate_rows(&sample, count)?;
    let boxes = product_boxes(&sample, &rows, count, half_width.value)?;
    let mut list = Vec::with_capacity(count);
    for (j, joint) in joints(m).into_iter().enumerate() {
        let measure = |s: &Shares| larger([0, 1].map(|k| norm_and_direction(&s[k][j]).0)).0;
        let (_, at) = sample.worst(&measure)?;
        let found = [0, 1].map(|k| norm_and_direction(&at.shares[k][j]));
        let (most, kind) = larger(found.map(|f| f.0));
        let direction = oriented(found[index(kind)].1);
        let size = |k: usize| (at.shares[k][j] * direction).norm();
        list.push(JointBudget {
            joint,
            alone: LimitedAllowance { value: 1.0 / most, reached: 1.0 / most, pose: at.pose, kind },
            direction,
            per_unit: (size(0) * bound.position, size(1) * bound.rotation_deg),
            along: std::array::from_fn(|k| rows[3 * j + k].as_ref().map(|r| 1.0 / r[3 * j + k])),
            product_box: std::array::from_fn(|k| boxes[3 * j + k]),
        });
    }
    list.sort_by(|a, b| a.alone.value.total_cmp(&b.alone.value).then(a.joint.cmp(&b.joint)));
    Ok(Budget { radius, half_width, joints: list, worst_errors, poses: sample.entries.len() })
}

/// Allowed error of all joints together, each in a ball of this radius: [`Budget::radius`] alone, without the work for
/// single joints.
///
/// # Errors
/// As [`budget`].
pub fn joint_allowance(
    m: &Manipulator,
    space: &PoseSpace,
    tool: Point3<f64>,
    bound: ErrorBound,
    search: &PoseSearch,
) -> Result<LimitedAllowance, ToleranceError> {
    let sample = PoseSample::new(m, space, tool, bound, search)?;
    limit(&sample, &|g| Gauge::balls(g, 1.0)).map(|(radius, ..)| radius)
}

/// `|g_jk . n|` of all coordinates.
fn row(g: &[Matrix3<f64>], n: &Vector3<f64>) -> Vec<f64> {
    g.iter().flat_map(|g| g.tr_mul(n).iter().map(|x| x.abs()).collect::<Vec<_>>()).collect()
}

/// For every coordinate the constraint at the pose and in the direction where it has the greatest influence; `None`
/// where it has none.
fn coordinate_rows(sample: &PoseSample<'_>, count: usize) -> Result<Vec<Option<Vec<f64>>>, ToleranceError> {
    let mut found = Vec::with_capacity(3 * count);
    for c in 0..3 * count {
        let column = |g: &[Matrix3<f64>]| -> Vector3<f64> { g[c / 3].column(c % 3).into() };
        let (value, at) = sample.worst(&|s| larger([0, 1].map(|k| column(&s[k]).norm())).0)?;
        let (_, kind) = larger([0, 1].map(|k| column(&at.shares[k]).norm()));
        let g = &at.shares[index(kind)];
        found.push((value, row(g, &column(g).try_normalize(0.0).unwrap_or_default())));
    }
    let most = found.iter().map(|f| f.0).fold(0.0, f64::max);
    Ok(found.into_iter().map(|(value, row)| (value > NO_INFLUENCE * most).then_some(row)).collect())
}

/// Half widths with the largest product: constraints `sum |g . n| x <= 1` are added at the worst pose and direction
/// until none is violated.
fn product_boxes(
    sample: &PoseSample<'_>,
    coordinates: &[Option<Vec<f64>>],
    count: usize,
    equal: f64,
) -> Result<Vec<Option<f64>>, ToleranceError> {
    let free: Vec<usize> = (0..3 * count).filter(|c| coordinates[*c].is_some()).collect();
    let only_free = |row: &[f64]| free.iter().map(|c| row[*c]).collect::<Vec<f64>>();
    let mut rows: Vec<Vec<f64>> = coordinates.iter().flatten().map(|r| only_free(r)).collect();
    let mut weights = Vec::new();
    let mut half = vec![Vector3::repeat(equal); count];
    for round in 0..=PRODUCT.1 {
        let gauge = |g: &[Matrix3<f64>]| Gauge::boxes(g, &half);
        let (value, at) = sample.worst(&|s| larger([0, 1].map(|k| gauge(&s[k]).search().0)).0)?;
        if value <= 1.0 + PRODUCT.0 && round > 0 || round == PRODUCT.1 {
            let most = [0, 1].map(|k| gauge(&at.shares[k]).bracket(GAP).most);
            let scale = most[0].max(most[1]).max(f64::MIN_POSITIVE);
            for h in &mut half {
                *h /= scale;
            }
            break;
        }
        for k in 0..2 {
            let (used, n) = gauge(&at.shares[k]).search();
            if used > 1.0 || round == 0 {
                rows.push(only_free(&row(&at.shares[k], &n)));
            }
        }
        let x = largest_product(&rows, &mut weights, 0.1 * PRODUCT.0);
        half = vec![Vector3::zeros(); count];
        for (c, x) in free.iter().zip(x) {
            half[c / 3][c % 3] = x;
        }
    }
    Ok((0..3 * count).map(|c| coordinates[c].as_ref().map(|_| half[c / 3][c % 3])).collect())
}
