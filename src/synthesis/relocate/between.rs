//! Families told by the flats they lie between, which do not change when legs are moved.

use nalgebra::{Point3, Vector3};

use crate::manipulator::Manipulator;
use crate::num::Rng;
use crate::num::linalg::LinalgError;
use crate::synthesis::components::{Component, Components};

/// Orthonormal directions of the flat through the points, and one of them; what is within `limit` of the flat of the points before adds nothing.
struct Through {
    origin: Point3<f64>,
    axes: Vec<Vector3<f64>>,
    /// Indices of the points that span it.
    chosen: Vec<usize>,
}

impl Through {
    fn new(points: &[Point3<f64>], limit: f64) -> Option<Self> {
        let mut flat = Self { origin: *points.first()?, axes: Vec::new(), chosen: vec![0] };
        for (k, p) in points.iter().enumerate().skip(1) {
            let rest = flat.off(p);
            if rest.norm() > limit {
                flat.axes.push(rest.normalize());
                flat.chosen.push(k);
            }
        }
        Some(flat)
    }

    fn off(&self, p: &Point3<f64>) -> Vector3<f64> {
        let mut d = p - self.origin;
        for _ in 0..2 {
            for e in &self.axes {
                d -= e * e.dot(&d);
            }
        }
        d
    }
}

/// Four ends of legs of the family on each body: they span what the ends of all its legs span.
fn samples(found: &Components, family: &Component) -> Result<[Vec<Point3<f64>>; 2], LinalgError> {
    let mut rng = Rng::stream(found.options.seed, 0xbe);
    let mut ends = [Vec::new(), Vec::new()];
    for _ in 0..6 {
        if let Some(s) = family.sample(&found.span, &mut rng)? {
            ends[0].push(s.leg.base);
            ends[1].push(s.leg.platform);
        }
    }
    Ok(ends)
}

fn limit(m: &Manipulator, found: &Components) -> f64 {
    (100.0 * found.options.tolerance).max(1e-7) * m.size()
}

/// Indices of the families whose base ends span the flat of the base points given, and whose platform ends span that of the platform points.
///
/// # Errors
/// When a decomposition does not converge.
pub fn family_between(
    m: &Manipulator,
    found: &Components,
    base: &[Point3<f64>],
    platform: &[Point3<f64>],
) -> Result<Vec<usize>, LinalgError> {
    let limit = limit(m, found);
    let (Some(a), Some(b)) = (Through::new(base, limit), Through::new(platform, limit)) else {
        return Ok(Vec::new());
    };
    let mut out = Vec::new();
    for (k, family) in found.components.iter().enumerate() {
        if (family.base_span, family.platform_span) != (a.axes.len(), b.axes.len()) {
            continue;
        }
        let [on_base, on_platform] = samples(found, family)?;
        let inside =
            |flat: &Through, points: &[Point3<f64>]| points.iter().all(|p| flat.off(p).norm() <= limit);
        if !on_base.is_empty() && inside(&a, &on_base) && inside(&b, &on_platform) {
            out.push(k);
        }
    }
    Ok(out)
}

/// Joints of `m` (indices on the base, indices on the platform) that span the two flats of a family; `None` when the joints of the
/// platform do not.
///
/// # Errors
/// When a decomposition does not converge.
pub fn spanning_joints(
    m: &Manipulator,
    found: &Components,
    family: usize,
) -> Result<Option<[Vec<usize>; 2]>, LinalgError> {
    let Some(component) = found.components.get(family) else { return Ok(None) };
    let limit = limit(m, found);
    let [base, platform] = samples(found, component)?;
    let joints = |ends: &[Point3<f64>], joints: &[Point3<f64>], span: usize| -> Option<Vec<usize>> {
        let flat = Through::new(ends, limit)?;
        let inside: Vec<usize> =
            (0..joints.len()).filter(|k| flat.off(&joints[*k]).norm() <= limit).collect();
        let points: Vec<Point3<f64>> = inside.iter().map(|k| joints[*k]).collect();
        let through = Through::new(&points, limit)?;
        (through.axes.len() == span).then(|| through.chosen.iter().map(|k| inside[*k]).collect())
    };
    let ends = joints(&base, m.base_joints(), component.base_span).zip(joints(
        &platform,
        m.platform_joints(),
        component.platform_span,
    ));
    Ok(ends.map(|(a, b)| [a, b]))
}
