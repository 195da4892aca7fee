//! The softest loads and the slowest motions of a platform at a pose, as smooth functions of the legs.
//!
//! Under a fixed unit load `w` the platform moves by `|F|^2 / k` along it, with `F = J^-T w`. The least stiffness is
//! the least of `k / |F|^2` over all unit forces, or torques. For a fixed motion `v` the quotient `v^T K v / v^T M v`
//! is at least the square of the lowest natural frequency (Rayleigh). Each quotient is smooth in the legs, while the
//! least value has kinks. The loads and motions are the softest at the point with their sums and differences, which
//! include the softest one of a nearby platform.
//!
//! Derivatives, with `x = J^-1 F`: `d |F|^2 = -2 sum F_i dJ_i . x`, and `d (v^T K v) = 2 k sum (J v)_i dJ_i . v`.

use nalgebra::{Matrix6, Vector3, Vector6};

use super::leg_lines::LegLines;
use super::pull::Gradient;
use machine::requirements::{VibratingMasses, mass_of, scaled_mass};
use num::small::{bounded_svd, symmetric_eigen3};

/// An upper bound of the least value, equal to it for the softest load or motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RayleighQuotient<P> {
    pub value: f64,
    pub pull: P,
}

/// Number of motions next to the slowest one that are mixed with it.
const MIXED: usize = 3;

/// Least share of the greatest softness of a motion with a valid quotient.
const SOFT: f64 = 1e-12;

/// Stiffness of legs of stiffness 1 against forces, or against torques, in design units and radians. `None` at a
/// singular pose.
pub(super) fn stiffness<P: Gradient>(
    l: &LegLines,
    size: f64,
    against_torques: bool,
) -> Option<Vec<RayleighQuotient<P>>> {
    let inverse = l.jacobian(size).try_inverse()?;
    let by_load = inverse.transpose();
    let (from, unit) = if against_torques { (3, size * size) } else { (0, 1.0) };
    let columns = by_load.fixed_columns::<3>(from).into_owned();
    let (_, axes) = symmetric_eigen3(&(columns.transpose() * columns));
    let mut loads: Vec<Vector3<f64>> = axes.column_iter().map(Into::into).collect();
    mix::<P, 3>(&mut loads, 3);
    let of = |w: &Vector3<f64>| {
        let forces: Vector6<f64> = columns * w;
        let square = forces.norm_squared();
        let x = inverse * forces;
        let mut pull = P::none();
        for i in (0..6).filter(|_| P::KEPT) {
            l.pull_row(&mut pull, i, size, &(x * (2.0 * unit * forces[i] / (square * square))));
        }
        RayleighQuotient { value: unit / square, pull }
    };
    let found: Vec<RayleighQuotient<P>> = loads.iter().map(of).collect();
    found.iter().all(|q| q.value.is_finite()).then_some(found)
}

/// Squares of angular frequencies. `None` at a singular pose.
pub(super) fn frequencies<P: Gradient>(
    l: &LegLines,
    size: f64,
    masses: &VibratingMasses,
) -> Option<Vec<RayleighQuotient<P>>> {
    let rows = l.jacobian(size);
    let inverse = rows.try_inverse()?;
    let ends = std::array::from_fn(|i| (l.arm[i], l.line[i]));
    let mass: Matrix6<f64> = scaled_mass(&mass_of(&masses.bodies, &l.rotation, &ends), size);
    let found = bounded_svd(&(inverse.transpose() * mass * inverse))?;
    let softness = found.singular_values;
    let turned = inverse * found.u?;
    let mut order: Vec<usize> = (0..6).filter(|k| softness[*k] > SOFT * softness.max()).collect();
    order.sort_by(|i, j| softness[*j].total_cmp(&softness[*i]));
    // motions of the same energy in the legs
    let mut motions: Vec<Vector6<f64>> = order.iter().map(|k| turned.column(*k).into()).collect();
    mix::<P, 6>(&mut motions, MIXED);
    let of = |v: &Vector6<f64>| {
        let stretched: Vector6<f64> = rows * v;
        let heavy = v.dot(&(mass * v));
        let value = masses.leg * stretched.norm_squared() / heavy;
        let mut pull = P::none();
        for i in (0..6).filter(|_| P::KEPT) {
            l.pull_row(&mut pull, i, size, &(v * (2.0 * masses.leg * stretched[i] / heavy)));
            leg_mass(l, masses, (i, v, size), -value / heavy, &mut pull);
        }
        RayleighQuotient { value, pull }
    };
    let found: Vec<RayleighQuotient<P>> = motions.iter().map(of).collect();
    (!found.is_empty() && found.iter().all(|q| q.value.is_finite())).then_some(found)
}

/// Adds sums and differences of the first vectors for gradients; without gradients only the least value is needed.
fn mix<P: Gradient, const N: usize>(list: &mut Vec<nalgebra::SVector<f64, N>>, first: usize) {
    if !P::KEPT {
        return;
    }
    let own: Vec<_> = list.iter().take(first).copied().collect();
    for (i, a) in own.iter().enumerate() {
        for b in &own[i + 1..] {
            list.extend([
                (a + b) * std::f64::consts::FRAC_1_SQRT_2,
                (a - b) * std::f64::consts::FRAC_1_SQRT_2,
            ]);
        }
    }
}

/// Adds `factor` times the gradient of twice the kinetic energy of a leg for the twist `v`, `(v, L w)`. With the
/// velocity `c = v + w x R b` of its end, `a = u . c` and `B = T / |d|^2` it is `(m_a - B) a^2 + B |c|^2`.
fn leg_mass<P: Gradient>(
    l: &LegLines,
    masses: &VibratingMasses,
    (leg, v, size): (usize, &Vector6<f64>, f64),
    factor: f64,
    pull: &mut P,
) {
    let own = &masses.bodies.leg;
    let (u, length) = (&l.direction[leg], l.length[leg]);
    let (shift, turn): (Vector3<f64>, Vector3<f64>) =
        (v.fixed_rows::<3>(0).into(), v.fixed_rows::<3>(3) / size);
    let c = shift + turn.cross(&l.arm[leg]);
    let a = u.dot(&c);
    let across = own.turning(length) / (length * length);
    let slope = 2.0 * (own.rod.mass * (length - own.rod.center) / (length * length) - across / length);
    let along_line = (c - u * a) * (2.0 * a * (own.lengthwise() - across) / length)
        + u * (slope * (c.norm_squared() - a * a));
    // d c = w x d(R b)
    let at_end = (u * (a * (own.lengthwise() - across)) + c * across) * 2.0;
    pull.line(leg, along_line * factor);
    pull.at_arm(leg, &(at_end.cross(&turn) * factor));
}
