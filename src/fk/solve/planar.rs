//! Platforms whose base joints lie in a plane and whose platform joints lie in a plane need only half of the paths.
//!
//! With both planes as `z = 0` seven of the 17 forms drop out of the leg equations and ten remain,
//!
//! ```text
//! N, e0^2 - e3^2, e1^2 - e2^2, 2 e0 e3, 2 e1 e2, (e0 gv - g0 ev)_xy, (ev x gv)_xy, g.g,
//! ```
//!
//! all of them invariant under the mirror map `(e, g) -> (e0, -e1, -e2, e3, -g0, g1, g2, -g3)`. With `k` the third
//! quaternion unit and `S = diag(1, 1, -1)` it is `e -> k e k~`, `g -> -k g k~`, that is `R -> S R S`, `p -> S p`. It
//! reflects the scene in the plane of the base and the platform in its own. Poses come in mirror pairs, the 40 of the
//! general member in 20. A pose that is its own mirror image has the platform in the plane of the base. There the leg
//! equations are even in three of six directions, so that an isolated one has multiplicity eight at least. Six general
//! sections in the ten forms miss these poses, which form a threefold.

use nalgebra::{Point3, Rotation3, Vector3};
use num_complex::Complex64;

use crate::solve::sections::FORMS;
use platform::manipulator::Manipulator;

/// Number of quadratic forms in the leg equations of a doubly planar platform.
pub(crate) const PLANAR_FORMS: usize = 10;

/// Coefficients of the ten forms in the order of the module's documentation.
pub(crate) type PlanarRow = [f64; PLANAR_FORMS];

/// Joints count as coplanar when they are closer to the plane of three of them than this part of the largest
/// coordinate. Rounding moves joints that far out of a plane that is not a coordinate plane.
const FLAT: f64 = 64.0 * f64::EPSILON;
/// The triangle that spans the plane must not be thinner than this part of the square of the size.
const SPAN: f64 = 1e-3;

/// The mirror pose, in frames with both planes as `z = 0`.
pub fn mirror(x: [Complex64; 8]) -> [Complex64; 8] {
    [x[0], -x[1], -x[2], x[3], -x[4], x[5], x[6], -x[7]]
}

/// The coefficients of the ten forms in a row that has no others.
pub(crate) fn planar_row(row: [f64; FORMS]) -> PlanarRow {
    let (norm, outer, inner) = (0.5 * (row[0] + row[9]), 0.5 * (row[0] - row[9]), 0.5 * (row[4] - row[7]));
    [norm, outer, inner, row[3], row[5], row[10], row[11], row[13], row[14], row[16]]
}

/// The row of 17 coefficients of a combination of the ten forms.
pub(crate) fn spatial_row(row: [Complex64; PLANAR_FORMS]) -> [Complex64; FORMS] {
    let zero = Complex64::ZERO;
    let [norm, outer, inner, w03, w12, mx, my, nx, ny, c] = row;
    let diagonal = [norm + outer, norm + inner, norm - inner, norm - outer];
    let [e00, e11, e22, e33] = diagonal;
    [e00, zero, zero, w03, e11, w12, zero, e22, zero, e33, mx, my, zero, nx, ny, zero, c]
}

/// Rotations that turn the planes of base and platform to `z = const`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Planes {
    pub base: Rotation3<f64>,
    pub platform: Rotation3<f64>,
}

impl Planes {
    /// `None` when the joints of a body are not coplanar to rounding, or nearly collinear.
    pub(super) fn of(m: &Manipulator) -> Option<Self> {
        let legs = m.legs();
        let base = turn_to_plane(&legs.map(|l| l.base), m.size())?;
        Some(Self { base, platform: turn_to_plane(&legs.map(|l| l.platform), m.size())? })
    }
}

/// The rotation by the smallest angle that makes the plane of the points parallel to `z = 0`; the identity when
/// it is, to the last bit.
fn turn_to_plane(points: &[Point3<f64>; 6], size: f64) -> Option<Rotation3<f64>> {
    let mut normal = Vector3::zeros();
    let mut through = points[0];
    for i in 0..6 {
        for j in i + 1..6 {
            for k in j + 1..6 {
                let n = (points[j] - points[i]).cross(&(points[k] - points[i]));
                if n.norm_squared() > normal.norm_squared() {
                    (normal, through) = (n, points[i]);
                }
            }
        }
    }
    let normal = normal.try_normalize(SPAN * size * size)?;
    let largest = points.iter().map(|p| p.coords.amax()).fold(size, f64::max);
    let flat = points.iter().all(|p| (p - through).dot(&normal).abs() <= FLAT * largest);
    let upward = if normal.z < 0.0 { -normal } else { normal };
    // upward is never opposite to z
    flat.then(|| Rotation3::rotation_between(&upward, &Vector3::z()).unwrap_or_else(Rotation3::identity))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::sections::{ScaledFrames, forms};
    use nalgebra::{Matrix3, UnitQuaternion};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    fn random_point(rng: &mut Rng) -> [Complex64; 8] {
        std::array::from_fn(|_| Complex64::new(rng.normal(), rng.normal()))
    }

    /// Doubly planar joints; `off` lifts one of them, `tilt` moves both planes.
    fn joints(rng: &mut Rng, off: f64, tilt: bool) -> Manipulator {
        let mut body = |off: f64| {
            let rotation = random_rotation(rng);
            let shift = Vector3::from_fn(|_, _| 3.0 * rng.normal());
            let mut at = |z| Point3::new(rng.normal(), rng.normal(), z);
            let points: [Point3<f64>; 6] = std::array::from_fn(|i| at(if i == 4 { off } else { 0.0 }));
            if tilt { points.map(|p| rotation * p + shift) } else { points }
        };
        let (base, platform) = (body(0.0), body(off));
        Manipulator::from_legs(std::array::from_fn(|i| Leg { base: base[i], platform: platform[i] })).unwrap()
    }

    #[test]
    fn the_mirror_map_is_the_reflection_of_rotation_and_position() {
        let mut rng = Rng::new(8);
        let reflect = Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, -1.0));
        let (rotation, p) = (random_rotation(&mut rng), Vector3::new(0.3, -1.0, 2.0));
        let study = |rotation: &Matrix3<f64>, p: Vector3<f64>| {
            let q = UnitQuaternion::from_matrix(rotation);
            let g = nalgebra::Quaternion::from_imag(p) * q.into_inner();
            [q.w, q.i, q.j, q.k, g.w, g.i, g.j, g.k].map(Complex64::from)
        };
        let expected = study(&(reflect * rotation.matrix() * reflect), reflect * p);
        let image = mirror(study(rotation.matrix(), p));
        let sign = (expected[0] / image[0]).re;
        for k in 0..8 {
            assert!((expected[k] - image[k] * sign).norm() < 1e-14, "{k}");
        }
    }

    #[test]
    fn ten_forms_are_invariant_and_carry_the_leg_equations() {
        let mut rng = Rng::new(9);
        let x = random_point(&mut rng);
        let value =
            |row: &[Complex64; FORMS], x| -> Complex64 { row.iter().zip(forms(x)).map(|(c, f)| c * f).sum() };
        for k in 0..PLANAR_FORMS {
            let mut unit = [Complex64::ZERO; PLANAR_FORMS];
            unit[k] = Complex64::ONE;
            let row = spatial_row(unit);
            assert!((value(&row, x) - value(&row, mirror(x))).norm() < 1e-13);
            let back = planar_row(row.map(|z| z.re));
            for n in 0..PLANAR_FORMS {
                assert!((back[n] - unit[n].re).abs() < 1e-16);
            }
        }
        for tilt in [false, true] {
            let m = joints(&mut rng, 0.0, tilt);
            let pose = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(1.0, 2.0, -0.5) };
            let s = pose.squared_lengths(&m).unwrap();
            let sections = ScaledFrames::planar(&m, &s).unwrap().sections(&m, &s).unwrap();
            for row in sections.rows {
                let again = spatial_row(planar_row(row.map(|z| z.re)).map(Complex64::from));
                let lost = row.iter().zip(again).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
                assert!(lost < 1e-14, "{lost}");
            }
        }
    }

    #[test]
    fn planes_are_found_wherever_they_are_and_only_if_they_are() {
        let mut rng = Rng::new(10);
        for tilt in [false, true] {
            for _ in 0..50 {
                assert!(Planes::of(&joints(&mut rng, 0.0, tilt)).is_some());
                assert!(Planes::of(&joints(&mut rng, 1e-6, tilt)).is_none());
                assert!(Planes::of(&joints(&mut rng, 1e-12, tilt)).is_none());
            }
        }
        let m = joints(&mut rng, 0.0, false);
        assert_eq!(Planes::of(&m).unwrap().base, Rotation3::identity());
        // units and a shift of the frames do not matter
        let legs = joints(&mut rng, 0.0, true)
            .legs()
            .map(|l| Leg { base: l.base * 1e3 + Vector3::new(50.0, 1e3, 2e3), platform: l.platform * 1e3 });
        assert!(Planes::of(&Manipulator::from_legs(legs).unwrap()).is_some());
    }
}
