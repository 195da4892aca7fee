//! Singular poses of the octahedral platform as four planes through one point.

use nalgebra::{Matrix4, Vector3, Vector4};

use platform::geom::Pose;
use platform::manipulator::Octahedral;

/// The plane through three points, `(n, -n.p)` with `n = (q - p) x (r - p)`.
fn plane(p: &Vector3<f64>, q: &Vector3<f64>, r: &Vector3<f64>) -> Vector4<f64> {
    let n = (q - p).cross(&(r - p));
    Vector4::new(n.x, n.y, n.z, -n.dot(p))
}

/// Determinants of the two sets of four alternate faces of the octahedron. The first is the base with the three
/// triangles of a platform edge and a base joint. The second is the platform with the three triangles of a base edge
/// and a platform joint. Units: design units to the ninth power.
///
/// Each vanishes exactly if its four planes have a common point (or direction), that is, at singular poses. Up to sign
/// both are `det J` of the leg lines without division by lengths (rows `[n, a x n]` about the base origin). Source:
/// Downing, Samuel, Hunt 2002; Rojas, Borras, Thomas, sec. 3.
#[must_use]
pub fn four_planes(octahedral: &Octahedral, pose: &Pose) -> [f64; 2] {
    let [p1, p2, p3] = octahedral.base().map(|p| p.coords);
    let [p4, p5, p6] = octahedral.platform().map(|p| pose.transform(&p).coords);
    let determinant = |faces: [Vector4<f64>; 4]| Matrix4::from_columns(&faces).determinant();
    // P2 has legs to P4 and P5, P3 to P5 and P6, P1 to P6 and P4
    let base = [plane(&p1, &p2, &p3), plane(&p4, &p5, &p2), plane(&p5, &p6, &p3), plane(&p6, &p4, &p1)];
    let platform = [plane(&p4, &p5, &p6), plane(&p1, &p2, &p4), plane(&p2, &p3, &p5), plane(&p3, &p1, &p6)];
    [determinant(base), determinant(platform)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use num::Rng;
    use platform::geom::random_rotation;
    use platform::manipulator::{Manipulator, plucker_matrix};

    #[test]
    fn both_determinants_are_that_of_the_leg_lines() {
        let mut rng = Rng::new(5);
        for _ in 0..40 {
            let mut three = || -> Vec<Point3<f64>> {
                (0..3).map(|_| Point3::from(Vector3::from_fn(|_, _| rng.normal()))).collect()
            };
            let (base, platform) = (three(), three());
            let zigzag = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
            let m = Manipulator::try_new(base, platform, zigzag).unwrap();
            let o = Octahedral::recognise(&m).unwrap();
            let position = Vector3::from_fn(|_, _| rng.normal());
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let det = plucker_matrix(&m, &pose, 1.0).determinant();
            for d in four_planes(&o, &pose) {
                assert!((d.abs() - det.abs()).abs() < 1e-10 * det.abs().max(1.0), "{d} {det}");
            }
        }
    }

    #[test]
    fn a_flat_pose_is_singular() {
        let t = |r: f64| vec![Point3::new(r, 0.0, 0.0), Point3::new(-r, r, 0.0), Point3::new(-r, -r, 0.0)];
        let m =
            Manipulator::try_new(t(2.0), t(1.0), [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
        let o = Octahedral::recognise(&m).unwrap();
        let flat = Pose { rotation: nalgebra::Rotation3::identity(), position: Vector3::new(0.1, 0.3, 0.0) };
        assert!(four_planes(&o, &flat).iter().all(|d| d.abs() < 1e-12));
    }
}
