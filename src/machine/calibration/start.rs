//! A start without nominal joints: squared lengths are linear in seventeen quantities of a leg.

use nalgebra::{DMatrix, DVector, Point3, Vector3};

use super::model::{HeldParts, LegModel, Measurement};
use super::spectrum::FitSpectrum;

/// Singular values below this share of the largest one leave the quantities undetermined.
const DETERMINED: f64 = 1e-10;

/// The joints and offsets of all legs by the linear equations
///
/// ```text
/// l^2 - |p|^2 = 2 l d - 2 p . a + 2 (R^T p) . b - 2 sum_jk R_jk a_j b_k + c,      c = |a|^2 + |b|^2 - d^2
/// ```
///
/// in `d`, `a`, `b`, the nine products `a_j b_k`, and `c`; the products and `c` are then dropped. Lengths are divided
/// by their root mean square and positions counted from their mean, so that the equations have no unit. A joint of
/// several legs gets the mean of its estimates.
///
/// `None` if joints are held, or if the poses do not determine the seventeen quantities (sixteen with known offsets).
/// Examples are too few poses, poses without rotation, and rotations about one axis only.
pub(super) fn closed_form(
    nominal: &LegModel,
    measurements: &[Measurement],
    held: HeldParts,
) -> Option<LegModel> {
    let quantities = if held.offsets { 16 } else { 17 };
    if held.base || held.platform || measurements.len() < quantities {
        return None;
    }
    let count = measurements.len() as f64;
    let centre = measurements.iter().map(|m| m.pose.position).sum::<Vector3<f64>>() / count;
    let mut out = nominal.clone();
    let mut base = vec![(Vector3::zeros(), 0.0); out.base.len()];
    let mut platform = vec![(Vector3::zeros(), 0.0); out.platform.len()];
    for leg in 0..6 {
        let known = held.offsets.then_some(nominal.offsets[leg]);
        let (a, b, d) = one_leg(measurements, leg, &centre, known)?;
        let ends = nominal.pairs[leg];
        for (sum, point) in [(&mut base[ends.0], a), (&mut platform[ends.1], b)] {
            sum.0 += point;
            sum.1 += 1.0;
        }
        out.offsets[leg] = d;
    }
    for (joints, sums) in [(&mut out.base, base), (&mut out.platform, platform)] {
        for (joint, (sum, count)) in joints.iter_mut().zip(sums) {
            if count > 0.0 {
                *joint = Point3::from(sum / count);
            }
        }
    }
    Some(out)
}

/// Base joint, platform joint and offset of a leg.
fn one_leg(
    measurements: &[Measurement],
    leg: usize,
    centre: &Vector3<f64>,
    known_offset: Option<f64>,
) -> Option<(Vector3<f64>, Vector3<f64>, f64)> {
    let length = |m: &Measurement| m.lengths[leg] - known_offset.unwrap_or(0.0);
    let far = |m: &Measurement| (m.pose.position - centre).norm_squared().max(length(m).powi(2));
    let squares = measurements.iter().map(far).sum::<f64>();
    let unit = (squares / measurements.len() as f64).sqrt();
    if !(unit.is_finite() && unit > 0.0) {
        return None;
    }
    let first = usize::from(known_offset.is_none());
    let mut rows = DMatrix::zeros(measurements.len(), 16 + first);
    let mut right = DVector::zeros(measurements.len());
    for (k, m) in measurements.iter().enumerate() {
        let (l, p) = (length(m) / unit, (m.pose.position - centre) / unit);
        let back = m.pose.rotation.inverse() * p;
        if first == 1 {
            rows[(k, 0)] = 2.0 * l;
        }
        for j in 0..3 {
            rows[(k, first + j)] = -2.0 * p[j];
            rows[(k, first + 3 + j)] = 2.0 * back[j];
            for i in 0..3 {
                rows[(k, first + 6 + 3 * j + i)] = -2.0 * m.pose.rotation[(j, i)];
            }
        }
        rows[(k, first + 15)] = 1.0;
        right[k] = l * l - p.norm_squared();
    }
    let found = FitSpectrum::of(rows, right, f64::INFINITY)?;
    let last = found.values[found.values.len() - 1];
    if !(last > DETERMINED * found.values[0]) {
        return None;
    }
    let x = found.step(0.0) * unit;
    if !x.iter().all(|x| x.is_finite()) {
        return None;
    }
    let point = |at: usize| Vector3::new(x[at], x[at + 1], x[at + 2]);
    let offset = known_offset.unwrap_or(x[0]);
    Some((point(first) + centre, point(first + 3), offset))
}
