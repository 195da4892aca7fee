//! A home pose for designs without one.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use super::Manipulator;
use crate::geom::Pose;
use num::small::symmetric_eigen3;

/// Centroid and centred copies of six leg ends (a joint with two legs counts twice).
fn centred(points: [Vector3<f64>; 6]) -> (Vector3<f64>, [Vector3<f64>; 6]) {
    let c = points.iter().sum::<Vector3<f64>>() / 6.0;
    (c, points.map(|p| p - c))
}

/// The part of `towards` normal to `axis`, or that of the next coordinate axis if it is nearly parallel.
fn normal_to(axis: Vector3<f64>, towards: Vector3<f64>) -> Vector3<f64> {
    let candidates = [towards, Vector3::z(), Vector3::x(), Vector3::y()];
    let parts = candidates.map(|v| v - axis * axis.dot(&v));
    // one of three orthogonal candidates is at least 35 degrees off the axis
    parts.into_iter().find(|p| p.norm() > 0.5).map_or(Vector3::z(), |p| p.normalize())
}

/// Normal of the best-fit plane through the centroid, pointing to positive z of the body's frame (then y, then x).
///
/// Collinear points (second moment below `1e-18` of the first): the normal to the line closest to z. Coincident points:
/// z.
fn plane_normal(points: &[Vector3<f64>; 6], size: f64) -> Vector3<f64> {
    let moments: Matrix3<f64> = points.iter().map(|p| p * p.transpose()).sum();
    let (values, vectors) = symmetric_eigen3(&moments);
    let mut order = [0, 1, 2];
    order.sort_by(|&i, &j| values[i].total_cmp(&values[j]));
    let [least, middle, most] = order;
    if values[most] <= 1e-24 * size * size {
        return Vector3::z();
    }
    if values[middle] <= 1e-18 * values[most] {
        return normal_to(vectors.column(most).normalize(), Vector3::z());
    }
    let n: Vector3<f64> = vectors.column(least).normalize();
    let leading = [n.z, n.y, n.x].into_iter().find(|x| x.abs() > 1e-9);
    if leading.is_some_and(|x| x < 0.0) { -n } else { n }
}

/// The shortest rotation from the unit vector `from` to `to`; half a turn about a fixed normal if they are opposite.
fn shortest_rotation(from: Vector3<f64>, to: Vector3<f64>) -> Rotation3<f64> {
    let half_turn = || {
        let axis = Unit::new_normalize(normal_to(from, Vector3::x()));
        Rotation3::from_axis_angle(&axis, std::f64::consts::PI)
    };
    Rotation3::rotation_between(&from, &to).unwrap_or_else(half_turn)
}

/// A home pose: platform parallel to the base, above its centre, rotated for short legs.
///
/// Let `n` and `n'` be the normals of the best-fit planes of the base and platform leg ends, each towards positive z of
/// its frame. `a_i'` and `b_i'` are the leg ends relative to their centroids:
///
/// ```text
/// R = Rot(n, theta) R_0,   R_0 n' = n (shortest rotation),
/// theta = atan2(sum n.(b_i'' x a_i'), sum a_i'.b_i'' - (n.a_i')(n.b_i'')),   b_i'' = R_0 b_i',
/// ```
///
/// which minimises the sum of squared leg lengths over rotations about `n`. The platform centroid is on `n` through the
/// base centroid. Its height equals the base radius, the greatest distance of a base leg end from the centroid. If the
/// base leg ends coincide, the height is [`Manipulator::size`]. If all rotations are equally good (both sums below
/// `1e-12` of the squared size), `theta = 0`. It is deterministic, and possibly singular.
#[must_use]
pub fn default_home(m: &Manipulator) -> Pose {
    let legs = m.legs();
    let (base_centre, a) = centred(legs.map(|l| l.base.coords));
    let (platform_centre, b) = centred(legs.map(|l| l.platform.coords));
    let normal = plane_normal(&a, m.size());
    let r0 = shortest_rotation(plane_normal(&b, m.size()), normal);
    let turned = b.map(|b| r0 * b);
    let (mut cosine, mut sine) = (0.0, 0.0);
    for (a, b) in a.iter().zip(&turned) {
        cosine += a.dot(b) - normal.dot(a) * normal.dot(b);
        sine += normal.dot(&b.cross(a));
    }
    let flat = cosine.hypot(sine) <= 1e-12 * m.size() * m.size();
    let theta = if flat { 0.0 } else { sine.atan2(cosine) };
    let rotation = Rotation3::from_axis_angle(&Unit::new_normalize(normal), theta) * r0;
    let radius = a.iter().map(nalgebra::Matrix::norm).fold(0.0, f64::max);
    let height = if radius > 1e-12 * m.size() { radius } else { m.size() };
    Pose { rotation, position: base_centre + normal * height - rotation * platform_centre }
}

/// Height of the centre of the platform above the base, design units. It is `n . (R b + p - a)` with the means `a`, `b`
/// of the leg ends. `n` is the normal of the best-fit plane of the base leg ends, towards positive z of the base frame.
pub fn height_above_base(m: &Manipulator, pose: &Pose) -> f64 {
    let (base_centre, a) = centred(m.legs().map(|l| l.base.coords));
    let (platform_centre, _) = centred(m.legs().map(|l| l.platform.coords));
    plane_normal(&a, m.size()).dot(&(pose.rotation * platform_centre + pose.position - base_centre))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::random_rotation;
    use crate::manipulator::Leg;
    use nalgebra::Point3;
    use num::Rng;

    fn cost(m: &Manipulator, pose: &Pose) -> f64 {
        m.legs().iter().map(|l| pose.squared_length(l)).sum()
    }

    fn random_platform(rng: &mut Rng) -> Manipulator {
        let mut point = |r: f64| Point3::new(r * rng.normal(), r * rng.normal(), 0.2 * rng.normal());
        Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(3.0), platform: point(1.5) }))
            .unwrap()
    }

    #[test]
    fn is_the_best_turn_at_the_stated_height() {
        let mut rng = Rng::new(5);
        for _ in 0..20 {
            let m = random_platform(&mut rng);
            let home = default_home(&m);
            let (base, a) = centred(m.legs().map(|l| l.base.coords));
            let (platform, _) = centred(m.legs().map(|l| home.transform(&l.platform).coords));
            let radius = a.iter().map(nalgebra::Matrix::norm).fold(0.0, f64::max);
            let lift = platform - base;
            assert!((lift.norm() - radius).abs() < 1e-10);
            let axis = Unit::new_normalize(lift);
            for k in 1..24 {
                let turn = Rotation3::from_axis_angle(&axis, f64::from(k) * std::f64::consts::TAU / 24.0);
                let pose = Pose {
                    rotation: turn * home.rotation,
                    position: platform + turn * (home.position - platform),
                };
                assert!(cost(&m, &pose) >= cost(&m, &home) - 1e-9);
            }
        }
    }

    #[test]
    fn leg_lengths_do_not_depend_on_frames_that_keep_z_up() {
        let mut rng = Rng::new(6);
        let m = random_platform(&mut rng);
        let turn = |x: f64| Rotation3::from_axis_angle(&Vector3::z_axis(), x);
        let moved = Manipulator::from_legs(m.legs().map(|l| Leg {
            base: turn(1.1) * l.base + Vector3::new(5.0, -2.0, 7.0),
            platform: turn(-0.4) * l.platform + Vector3::new(0.3, 9.0, -4.0),
        }))
        .unwrap();
        let (p, q) = (default_home(&m).lengths(&m).unwrap(), default_home(&moved).lengths(&moved).unwrap());
        assert!(p.get().iter().zip(q.get()).all(|(x, y)| (x - y).abs() < 1e-9));
    }

    #[test]
    fn degenerate_bodies_still_get_a_finite_proper_pose() {
        let mut rng = Rng::new(7);
        let line = |k: usize| Point3::new(0.0, 0.0, k as f64);
        let flat = |k: usize| Point3::new((k as f64).cos(), 0.0, (k as f64).sin());
        let shapes: [&dyn Fn(usize) -> Point3<f64>; 3] = [&line, &flat, &|_| Point3::new(1.0, 2.0, 3.0)];
        for (i, base) in shapes.iter().enumerate() {
            for platform in &shapes[..2] {
                let legs = std::array::from_fn(|k| Leg { base: base(k), platform: platform(k) });
                let m = Manipulator::from_legs(legs).unwrap();
                let home = default_home(&m);
                assert!(home.position.iter().all(|x| x.is_finite()), "base shape {i}");
                assert!((home.rotation.matrix().determinant() - 1.0).abs() < 1e-12);
                assert_eq!(home, default_home(&m));
            }
        }
        // opposite normals
        let r = shortest_rotation(Vector3::y(), -Vector3::y());
        assert!((r * Vector3::y() + Vector3::y()).norm() < 1e-12);
        let v = random_rotation(&mut rng) * Vector3::x();
        assert!(normal_to(v, v).dot(&v).abs() < 1e-12);
    }
}
