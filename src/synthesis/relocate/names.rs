//! Names of families and parameters that are invariant under moves of legs.
//!
//! A family is identified by the joints that span its flats, and a parameter counts from given joints.

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector, Point3, Vector3};

use crate::components::{Component, Components, MovingPoint, Parametrisation};
use num::Purpose;
use num::linalg::LinalgError;
use num::small::bounded_svd;
use platform::manipulator::Manipulator;

/// Orthonormal directions of the flat through the points, and one of the points. Points within `limit` of the flat of
/// the earlier ones add nothing.
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

/// Four ends of legs of the family on each body: they span the flats of all its legs.
fn samples(found: &Components, family: &Component) -> Result<[Vec<Point3<f64>>; 2], LinalgError> {
    let mut rng = Purpose::FAMILY_ENDS.rng(found.options.seed);
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

/// Indices of the families whose base ends span the flat of the given base points, and whose platform ends span that of
/// the platform points.
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

/// Joints of `m` that span the two flats of a family (indices on the base, indices on the platform); `None` if there
/// are none.
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

/// `t_i = map[i][0] + sum_j map[i][j + 1] s_j`: the family's original parameters by the new ones.
type AffineMap = [[f64; 4]; 3];

/// A point that is affine in some parameters: its place at zero, and a direction for each of them.
struct AffineEnd {
    start: Vector3<f64>,
    directions: Vec<(usize, Vector3<f64>)>,
}

impl AffineEnd {
    fn of(end: &MovingPoint) -> Option<Self> {
        let mut out = Self { start: Vector3::zeros(), directions: Vec::new() };
        for (e, c) in &end.terms {
            let place = Vector3::new(c[1], c[2], c[3]);
            let at_infinity = c[0].abs() <= 0.0;
            match (e.iter().sum::<u8>(), e.iter().position(|x| *x == 1)) {
                (0, None) if !at_infinity => out.start = place / c[0],
                (1, Some(k)) if at_infinity => out.directions.push((k, place)),
                _ => return None,
            }
        }
        out.directions.sort_by_key(|d| d.0);
        (!out.directions.is_empty()).then_some(out)
    }

    /// Original parameters of a point or, without the start, of a direction, by least squares.
    fn solve(&self, target: Vector3<f64>) -> Option<Vec<f64>> {
        let d = DMatrix::from_fn(3, self.directions.len(), |i, k| self.directions[k].1[i]);
        let x = bounded_svd(&d)?.solve(&DVector::from_column_slice(target.as_slice()), 1e-12).ok()?;
        Some(x.iter().copied().collect())
    }
}

/// The formulas of a family with parameters counted from joints. On an end that is affine in its parameters they are
/// `x_0 + sum s_j (x_j - x_0)` with the given points of that body, in that order. Dependent ends (partners on a line, a
/// plane) use the new parameters.
///
/// `None` if no end is affine in its parameters with one more point than parameters: conics and cubics keep their own
/// parameters.
#[must_use]
pub fn counted_from(
    formulas: &Parametrisation,
    base_points: &[Point3<f64>],
    platform_points: &[Point3<f64>],
) -> Option<Parametrisation> {
    let Parametrisation::Rational { parameters, base, platform } = formulas else { return None };
    let mut map: AffineMap =
        std::array::from_fn(|i| std::array::from_fn(|j| if j == i + 1 { 1.0 } else { 0.0 }));
    let mut done = [false; 3];
    let mut direct: [Option<MovingPoint>; 2] = [None, None];
    for (k, (end, points)) in [(base, base_points), (platform, platform_points)].into_iter().enumerate() {
        let Some(affine) = AffineEnd::of(end) else { continue };
        let slots: Vec<usize> = affine.directions.iter().map(|d| d.0).collect();
        if points.len() != slots.len() + 1 || slots.iter().any(|s| done[*s]) {
            continue;
        }
        let start = affine.solve(points[0].coords - affine.start)?;
        for (i, slot) in slots.iter().enumerate() {
            map[*slot] = [start[i], 0.0, 0.0, 0.0];
            done[*slot] = true;
        }
        // the end itself is written in the new form, so its joints keep all digits
        let first = points[0].coords;
        let mut terms = vec![([0; 3], [1.0, first.x, first.y, first.z])];
        for (slot, p) in slots.iter().zip(&points[1..]) {
            let d = p.coords - first;
            let mut exponent = [0; 3];
            exponent[*slot] = 1;
            terms.push((exponent, [0.0, d.x, d.y, d.z]));
            for (own, x) in slots.iter().zip(affine.solve(d)?) {
                map[*own][slot + 1] = x;
            }
        }
        direct[k] = Some(MovingPoint { terms });
    }
    if direct.iter().all(Option::is_none) {
        return None;
    }
    let [on_base, on_platform] = direct;
    Some(Parametrisation::Rational {
        parameters: *parameters,
        base: on_base.unwrap_or_else(|| composed(base, &map)),
        platform: on_platform.unwrap_or_else(|| composed(platform, &map)),
    })
}

/// The moving point with its parameters replaced.
fn composed(end: &MovingPoint, map: &AffineMap) -> MovingPoint {
    let mut terms: BTreeMap<[u8; 3], [f64; 4]> = BTreeMap::new();
    for (exponents, c) in &end.terms {
        let mut product: BTreeMap<[u8; 3], f64> = BTreeMap::from([([0; 3], 1.0)]);
        for (i, n) in exponents.iter().enumerate() {
            for _ in 0..*n {
                product = times(&product, &map[i]);
            }
        }
        for (e, x) in product {
            let sum = terms.entry(e).or_insert([0.0; 4]);
            sum.iter_mut().zip(c).for_each(|(s, c)| *s += x * c);
        }
    }
    MovingPoint { terms: terms.into_iter().collect() }
}

fn times(p: &BTreeMap<[u8; 3], f64>, factor: &[f64; 4]) -> BTreeMap<[u8; 3], f64> {
    let mut out = BTreeMap::new();
    for (e, x) in p {
        for (j, c) in factor.iter().enumerate().filter(|(_, c)| c.abs() > 0.0) {
            let mut e = *e;
            if j > 0 {
                e[j - 1] += 1;
            }
            *out.entry(e).or_insert(0.0) += x * c;
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::components::{ComponentOptions, FamilyKind, components};
    use num::Rng;
    use platform::manipulator::{Leg, Manipulator};

    #[test]
    fn the_legs_are_those_of_the_family_and_the_joints_are_at_zero_and_one() {
        let mut rng = Rng::new(4);
        let mut p = || Vector3::new(rng.normal(), rng.normal(), rng.normal());
        let (o, d, q, e, f) = (p(), p(), p(), p(), p());
        let place = [(-1.0, 0.3), (0.2, -0.7), (0.9, 0.4), (1.4, 1.2), (0.0, 0.0), (0.0, 0.0)];
        for count in [3, 4] {
            // three legs between two lines, four between a line and a plane
            let legs: [Leg; 6] = std::array::from_fn(|k| {
                let (s, t) = place[k];
                if k < count {
                    let u = if count == 4 { s * s - t } else { 0.0 };
                    Leg { base: Point3::from(o + d * s), platform: Point3::from(q + e * t + f * u) }
                } else {
                    Leg { base: Point3::from(p()), platform: Point3::from(p()) }
                }
            });
            let m = Manipulator::from_legs(legs).unwrap();
            let found = components(&m, ComponentOptions::default()).unwrap();
            let family = found.components.iter().find(|c| c.kind == FamilyKind::OverLine).unwrap();
            let points = [legs[2].base, legs[0].base];
            let new = counted_from(&family.parametrisation, &points, &[legs[0].platform]).unwrap();
            for (t, k) in [(0.0, 2), (1.0, 0)] {
                let leg = new.leg_at(&[t]).unwrap().unwrap();
                assert!(
                    (leg.base - legs[k].base).norm() < 1e-12
                        && (leg.platform - legs[k].platform).norm() < 1e-9
                );
            }
            for t in [-0.6, 0.35, 1.7] {
                let leg = new.leg_at(&[t]).unwrap().unwrap();
                assert!(found.span.distance(&leg) < 1e-10);
                assert!((leg.base - (points[0] + (points[1] - points[0]) * t)).norm() < 1e-12);
            }
            // one point is not a line
            assert!(counted_from(&family.parametrisation, &points[..1], &[]).is_none());
        }
    }
}
