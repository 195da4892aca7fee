//! Trilateration in matrix form over the complex numbers.

use nalgebra::Vector3;
use num_complex::Complex64;

/// The two points with squared distances `s` to three known points, mirror images of each other in their plane.
///
/// With `u = p2 - p1`, `v = p3 - p1` and `n = u x v` (bilinear products, no conjugation) the point is
///
/// ```text
/// p = p1 + alpha u + beta v +- gamma n,
/// [u.u u.v; u.v v.v] [alpha; beta] = 1/2 [s1 + u.u - s2; s1 + v.v - s3],
/// gamma^2 n.n = s1 - |alpha u + beta v|^2.
/// ```
///
/// The determinant of the Gram matrix is `n.n`, four times the Cayley-Menger determinant `D(1,2,3)` up to sign. If it
/// vanishes (collinear or isotropic base triangle), trilateration is impossible and the answer is `None`. Real points
/// with real distances give complex points if the distances are incompatible. Source: Thomas, Ros 2005; Rojas, Borras,
/// Thomas, eq. (2).
#[must_use]
pub fn trilaterate(points: &[Vector3<Complex64>; 3], s: [Complex64; 3]) -> Option<[Vector3<Complex64>; 2]> {
    let (u, v) = (points[1] - points[0], points[2] - points[0]);
    let n = u.cross(&v);
    let (uu, uv, vv, nn) = (u.dot(&u), u.dot(&v), v.dot(&v), n.dot(&n));
    if !(nn.norm() > 1e-26 * uu.norm() * vv.norm()) {
        return None;
    }
    let half = Complex64::new(0.5, 0.0);
    let f = (s[0] + uu - s[1]) * half;
    let g = (s[0] + vv - s[2]) * half;
    let (alpha, beta) = ((vv * f - uv * g) / nn, (uu * g - uv * f) / nn);
    let foot = u * alpha + v * beta;
    let gamma = ((s[0] - foot.dot(&foot)) / nn).sqrt();
    let origin = points[0] + foot;
    Some([origin + n * gamma, origin - n * gamma])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vector(x: f64, y: f64, z: f64) -> Vector3<Complex64> {
        Vector3::new(x.into(), y.into(), z.into())
    }

    #[test]
    fn recovers_a_point_and_its_mirror_image() {
        let base = [vector(0.0, 0.0, 0.0), vector(2.0, 0.0, 0.0), vector(0.5, 1.5, 0.0)];
        let p = vector(0.3, -0.4, 1.2);
        let s = base.map(|b| (p - b).dot(&(p - b)));
        let pair = trilaterate(&base, s).unwrap();
        let mirror = vector(0.3, -0.4, -1.2);
        let near = |q: &Vector3<Complex64>| pair.iter().any(|r| (r - q).norm() < 1e-13);
        assert!(near(&p) && near(&mirror));
    }

    #[test]
    fn distances_that_cannot_be_met_give_complex_points_with_these_distances() {
        let base = [vector(0.0, 0.0, 0.0), vector(2.0, 0.0, 0.0), vector(0.5, 1.5, 0.0)];
        let s = [0.01, 0.01, 0.01].map(Complex64::from);
        for p in trilaterate(&base, s).unwrap() {
            for (b, s) in base.iter().zip(s) {
                assert!(((p - b).dot(&(p - b)) - s).norm() < 1e-12);
            }
            assert!(p.iter().any(|z| z.im.abs() > 0.1));
        }
    }

    #[test]
    fn collinear_base_points_are_refused() {
        let base = [vector(0.0, 0.0, 0.0), vector(1.0, 1.0, 0.0), vector(2.0, 2.0, 0.0)];
        assert!(trilaterate(&base, [Complex64::ONE; 3]).is_none());
    }
}
