//! Stiffness of a platform on legs that are elastic along their lines, and its natural frequencies.
//!
//! Legs of stiffness `k` hold the platform at a pose with `K = J^T diag(k) J`. Row `i` of `J` is `(u_i, R b_i x u_i)`.
//! A small motion `x = (d, w)` (shift of the platform origin, rotation vector) needs the force and torque `K x`. With
//! the mass matrix `M` of platform, payload and legs at the pose, small free motions are sums of `v sin(omega t)` with
//! `K v = omega^2 M v`. Elastic joints and plates and the stiffness from preloaded legs are neglected. Sources:
//! Gosselin (1990) for `K`; Merlet, *Parallel Robots* (2006), sec. 8.

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3, Vector6};

use super::bodies::MovingBodies;
use super::term::TermKind;
use num::small::{bounded_svd, singular_values, symmetric_eigen3};
use platform::geom::Pose;
use platform::manipulator::{Manipulator, jacobian};

/// `K = k J^T J`: force units per design unit, times design units for each index of rotation.
#[must_use]
pub fn stiffness_matrix(m: &Manipulator, pose: &Pose, leg: f64) -> Matrix6<f64> {
    let j = jacobian(m, pose, 1.0);
    j.transpose() * j * leg
}

/// The mass matrix about the platform origin, base frame: kilograms, times design units for each index of rotation. The
/// kinetic energy is half of `x'^T M x'` with the twist `x' = (v, w)`.
#[must_use]
pub fn mass_matrix(m: &Manipulator, bodies: &MovingBodies, pose: &Pose) -> Matrix6<f64> {
    let ends = m.legs().map(|leg| {
        let arm = pose.rotation * leg.platform.coords;
        (arm, arm + pose.position - leg.base.coords)
    });
    mass_of(bodies, &pose.rotation, &ends)
}

/// [`mass_matrix`] from the arm `R b` and the line `R b + p - a` of each leg.
pub fn mass_of(
    bodies: &MovingBodies,
    rotation: &Rotation3<f64>,
    ends: &[(Vector3<f64>, Vector3<f64>); 6],
) -> Matrix6<f64> {
    let r = rotation.matrix();
    let cross = (r * bodies.center.coords).cross_matrix();
    let mut out = Matrix6::zeros();
    let mut add = |mass: &Matrix3<f64>, cross: &Matrix3<f64>| {
        // v + w x c = v - [c] w
        let coupled = mass * cross;
        let corner = |out: &mut Matrix6<f64>, i: usize, j: usize, part: &Matrix3<f64>| {
            let mut view = out.fixed_view_mut::<3, 3>(i, j);
            view += part;
        };
        corner(&mut out, 0, 0, mass);
        corner(&mut out, 0, 3, &-coupled);
        corner(&mut out, 3, 0, &-coupled.transpose());
        corner(&mut out, 3, 3, &(cross.transpose() * coupled));
    };
    add(&(Matrix3::identity() * bodies.mass), &cross);
    for (arm, line) in ends {
        let length = line.norm();
        let along = line / length;
        let turning = bodies.leg.turning(length);
        let lengthwise = along * along.transpose();
        let at_head = lengthwise * bodies.leg.lengthwise()
            + (Matrix3::identity() - lengthwise) * (turning / (length * length));
        add(&at_head, &arm.cross_matrix());
    }
    let inertia = r * bodies.inertia * r.transpose();
    let mut view = out.fixed_view_mut::<3, 3>(3, 3);
    view += inertia;
    out
}

/// Least stiffness against forces and against torques.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LeastStiffness {
    /// Against a force through the platform origin in the softest direction, with free rotation of the platform: force
    /// units per design unit.
    pub linear: f64,
    /// Against a torque about the softest axis, with free motion of the platform origin: force units times design units
    /// per radian.
    pub angular: f64,
}

/// The least stiffness of a stiffness matrix: the inverses of the greatest compliances, which are eigenvalues of the
/// two blocks of `K^-1`. `None` for a singular one.
#[must_use]
pub fn least_stiffness(stiffness: &Matrix6<f64>) -> Option<LeastStiffness> {
    let compliance = stiffness.try_inverse()?;
    let softest = |at: usize| {
        let block: Matrix3<f64> = compliance.fixed_view::<3, 3>(at, at).into();
        1.0 / symmetric_eigen3(&(0.5 * (block + block.transpose()))).0.max()
    };
    let found = LeastStiffness { linear: softest(0), angular: softest(3) };
    [found.linear, found.angular].iter().all(|x| x.is_finite() && *x > 0.0).then_some(found)
}

/// A natural motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vibration {
    /// Hertz.
    pub frequency: f64,
    /// Its shape: shift of the platform origin (design units) and rotation vector (radians), with `v^T M v = 1`.
    pub shape: Vector6<f64>,
}

/// The six natural motions, the slowest first: `K v = omega^2 M v`.
///
/// `omega` are the singular values of `sqrt(k) J L^-T` with `M = L L^T`, which stay real under rounding. The stiffness
/// of a leg is in kilograms per second squared, which equals newtons per metre for any design unit. `None` where `M` is
/// not positive definite (a point mass has no inertia about axes through itself), or for a leg of length zero.
#[must_use]
pub fn vibration(m: &Manipulator, pose: &Pose, leg: f64, mass: &Matrix6<f64>) -> Option<[Vibration; 6]> {
    // in units in which the diagonal of M is one
    let scale = Vector6::from_fn(|k, _| mass[(k, k)].sqrt());
    let lower = Matrix6::from_fn(|i, j| mass[(i, j)] / (scale[i] * scale[j])).cholesky()?.l();
    let back = lower.try_inverse()?.transpose();
    let lines = jacobian(m, pose, 1.0) * leg.sqrt();
    let lines = Matrix6::from_fn(|i, j| lines[(i, j)] / scale[j]) * back;
    if !lines.iter().all(|x| x.is_finite()) {
        return None;
    }
    let found = bounded_svd(&lines)?;
    let shapes = found.v_t?;
    let mut order: [usize; 6] = std::array::from_fn(|k| k);
    order.sort_by(|a, b| found.singular_values[*a].total_cmp(&found.singular_values[*b]));
    Some(order.map(|k| Vibration {
        frequency: found.singular_values[k] / std::f64::consts::TAU,
        shape: (back * shapes.row(k).transpose()).component_div(&scale),
    }))
}

/// The required stiffness of the platform on its legs, at every pose. Absent entries require nothing.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PlatformStiffness {
    /// Least [`LeastStiffness::linear`], force units per design unit.
    pub linear: Option<f64>,
    /// Least [`LeastStiffness::angular`], force units times design units per radian.
    pub angular: Option<f64>,
    /// Least natural frequency, hertz.
    pub natural_frequency: Option<f64>,
}

impl PlatformStiffness {
    /// The required value for a kind of requirement.
    #[must_use]
    pub fn least(&self, kind: TermKind) -> Option<f64> {
        match kind {
            TermKind::LinearStiffness => self.linear,
            TermKind::AngularStiffness => self.angular,
            TermKind::NaturalFrequency => self.natural_frequency,
            _ => None,
        }
    }
}

/// The vibrating masses (platform, payload and legs) with the stiffness of the legs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VibratingMasses {
    /// The bodies.
    pub bodies: MovingBodies,
    /// Stiffness of a leg, kilograms per second squared, which is newtons per metre.
    pub leg: f64,
}

impl VibratingMasses {
    /// Frequency of the mass of platform and payload on a single leg, hertz: a scale for natural frequencies.
    pub fn on_one_leg(&self) -> f64 {
        (self.leg / self.bodies.mass).sqrt() / std::f64::consts::TAU
    }
}

/// [`least_stiffness`] of legs of stiffness `leg` at a pose, from the leg forces under unit loads. With
/// `F = J^-T (f, t)` a unit force moves the platform by `|F|^2 / leg` along it. The least stiffness is `leg` over the
/// square of the greatest singular value of the columns of `J^-T` for forces, or for torques.
///
/// `J` is given by the rates of the drives in rows, with their moments over `size`. The result is zero at a singular
/// pose, and without rates.
pub(crate) fn softest_of(rows: Option<&Matrix6<f64>>, size: f64, leg: f64) -> LeastStiffness {
    let none = LeastStiffness { linear: 0.0, angular: 0.0 };
    let Some(inverse) = rows.and_then(|rows| rows.transpose().try_inverse()) else { return none };
    let softest = |at: usize| -> Option<f64> {
        let forces = inverse.fixed_columns::<3>(at).into_owned();
        let greatest = singular_values(&forces)?.max();
        Some(leg / (greatest * greatest)).filter(|x| x.is_finite())
    };
    match (softest(0), softest(3)) {
        (Some(linear), Some(angular)) => LeastStiffness { linear, angular: angular * size * size },
        _ => none,
    }
}

/// The lowest natural frequency at a pose, hertz: `omega^2 = 1 / max (v^T M v)` over the motions with `v^T K v = 1`. It
/// needs no inverse of `M`; directions without mass have no frequency. Zero at a singular pose.
#[must_use]
pub fn lowest_frequency(m: &Manipulator, pose: &Pose, masses: &VibratingMasses) -> f64 {
    lowest_of(Some(&jacobian(m, pose, m.size())), m.size(), &mass_matrix(m, &masses.bodies, pose), masses.leg)
}

/// [`lowest_frequency`] from rates of drives by rows with their moments over `size`; zero without rates.
pub(super) fn lowest_of(rows: Option<&Matrix6<f64>>, size: f64, mass: &Matrix6<f64>, leg: f64) -> f64 {
    let Some(inverse) = rows.and_then(|rows| rows.try_inverse()) else { return 0.0 };
    let mass = scaled_mass(mass, size);
    let form = inverse.transpose() * mass * inverse;
    let greatest = singular_values(&form).map_or(f64::INFINITY, |s| s.max());
    (leg / greatest).sqrt() / std::f64::consts::TAU
}

/// A mass matrix for twists `(v, L w)`.
pub fn scaled_mass(mass: &Matrix6<f64>, length: f64) -> Matrix6<f64> {
    let unit = |k: usize| if k < 3 { 1.0 } else { length };
    Matrix6::from_fn(|i, j| mass[(i, j)] / (unit(i) * unit(j)))
}
