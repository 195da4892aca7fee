//! Cayley-Menger bideterminants and trilateration in matrix form.

use super::scalar::Scalar;

/// The bordered determinant of the squared distances between `rows` and `columns`,
///
/// ```text
///                                    | 0   1        ..  1        |
/// D(i_1, .., i_n; j_1, .., j_n) =    | 1   s(i1,j1) ..  s(i1,jn) |
///                                    | ..  ..           ..       |
///                                    | 1   s(in,j1) ..  s(in,jn) |,
/// ```
///
/// without the factor `2 (-1/2)^n` that others give it. For three points `-D = 16 area^2 = 4 |u x v|^2`, for four
/// `D = 288 volume^2 = 8 det(u, v, w)^2`; for five points in space it vanishes. `like` tells the ring. Expanded by
/// cofactors: for a handful of points.
#[must_use]
pub fn bideterminant<const N: usize, S: Scalar>(
    like: &S,
    rows: &[usize; N],
    columns: &[usize; N],
    squared: &impl Fn(usize, usize) -> S,
) -> S {
    let entry = |i: usize, j: usize| match (i, j) {
        (0, 0) => None,
        (0, _) | (_, 0) => Some(like.one()),
        _ => Some(squared(rows[i - 1], columns[j - 1])),
    };
    let matrix: Vec<Vec<Option<S>>> = (0..=N).map(|i| (0..=N).map(|j| entry(i, j)).collect()).collect();
    minor(like, &matrix, 0, &mut (0..=N).collect())
}

/// The determinant of the rows from `row` on in the columns given; absent entries are zeros.
fn minor<S: Scalar>(like: &S, matrix: &[Vec<Option<S>>], row: usize, columns: &mut Vec<usize>) -> S {
    if row == matrix.len() {
        return like.one();
    }
    let mut sum = like.zero();
    for k in 0..columns.len() {
        let Some(entry) = &matrix[row][columns[k]] else { continue };
        let column = columns.remove(k);
        let term = entry.times(&minor(like, matrix, row + 1, columns));
        columns.insert(k, column);
        sum = if k % 2 == 0 { sum.plus(&term) } else { sum.minus(&term) };
    }
    sum
}

/// `D(i_1, .., i_n; i_1, .., i_n)`, see [`bideterminant`].
#[must_use]
pub fn determinant<const N: usize, S: Scalar>(
    like: &S,
    points: &[usize; N],
    squared: &impl Fn(usize, usize) -> S,
) -> S {
    bideterminant(like, points, points, squared)
}

/// The six squared distances of four points `i, j, k, l`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tetrahedron<S> {
    /// Distance of `i` and `j`.
    pub ij: S,
    /// Distance of `i` and `k`.
    pub ik: S,
    /// Distance of `j` and `k`.
    pub jk: S,
    /// Distance of `i` and `l`.
    pub il: S,
    /// Distance of `j` and `l`.
    pub jl: S,
    /// Distance of `k` and `l`.
    pub kl: S,
}

/// The point `l` seen from the triangle `i, j, k`: with `u = p_j - p_i` and `v = p_k - p_i`
///
/// ```text
/// p_l - p_i = (B u + C v + sigma sqrt(2 D) u x v) / A,
/// A = -D(i,j,k) = 4 |u x v|^2,  B = D(i,k,l; i,j,k),  C = -D(i,j,l; i,j,k),  D = D(i,j,k,l),
/// ```
///
/// `sigma = 1` when `u, v, p_l - p_i` are right-handed, `-1` when they are left-handed. Source: Porta, Thomas, eq. (5).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrilateratedPoint<S> {
    /// `A`, four times the Gram determinant of the triangle. It is zero when the triangle is collinear, or isotropic
    /// over the complex numbers; then there is no trilateration.
    pub a: S,
    /// `B`.
    pub b: S,
    /// `C`.
    pub c: S,
    /// `2 D(i,j,k,l)`, the number under the square root: `16 det(u, v, w)^2` for `w = p_l - p_i`.
    pub radicand: S,
}

impl<S: Scalar> Tetrahedron<S> {
    fn squared(&self, x: usize, y: usize) -> S {
        match (x.min(y), x.max(y)) {
            (0, 1) => self.ij.clone(),
            (0, 2) => self.ik.clone(),
            (1, 2) => self.jk.clone(),
            (0, 3) => self.il.clone(),
            (1, 3) => self.jl.clone(),
            (2, 3) => self.kl.clone(),
            _ => self.ij.zero(),
        }
    }

    /// The coefficients of eq. (5), from the squared distances alone.
    #[must_use]
    pub fn trilateration(&self) -> TrilateratedPoint<S> {
        let (like, squared) = (&self.ij, |x, y| self.squared(x, y));
        let twice = |x: S| x.plus(&x);
        TrilateratedPoint {
            a: determinant(like, &[0, 1, 2], &squared).negated(),
            b: bideterminant(like, &[0, 2, 3], &[0, 1, 2], &squared),
            c: bideterminant(like, &[0, 1, 3], &[0, 1, 2], &squared).negated(),
            radicand: twice(determinant(like, &[0, 1, 2, 3], &squared)),
        }
    }
}

impl<S: Scalar> TrilateratedPoint<S> {
    /// `omega = (B, C, root) / A` for a square root of the radicand, whose sign is the orientation: the coordinates of
    /// `p_l - p_i` in `u, v, u x v` (eq. 6). `None` when the base is degenerate, `A = 0` or a divisor of zero.
    #[must_use]
    pub fn coordinates(&self, root: &S) -> Option<[S; 3]> {
        Some([self.b.over(&self.a)?, self.c.over(&self.a)?, root.over(&self.a)?])
    }

    /// The squared length of `Q omega` for `omega` in the frame `Q = [u v u x v]` of a triangle. `Q^T Q` comes from its
    /// squared sides `s_ij, s_ik, s_jk` (eq. 7). The difference of two coordinate vectors gives the squared distance of
    /// two points.
    #[must_use]
    pub fn squared_length(omega: &[S; 3], [ij, ik, jk]: [&S; 3]) -> S {
        // u.v = (s_ij + s_ik - s_jk) / 2, |u x v|^2 = s_ij s_ik - (u.v)^2
        let twice_uv = ij.plus(ik).minus(jk);
        let [x, y, z] = omega;
        let four_cross = ij.times(ik).times(&ij.integer(4)).minus(&twice_uv.times(&twice_uv));
        let planar = x.times(x).times(ij).plus(&y.times(y).times(ik)).plus(&x.times(y).times(&twice_uv));
        let normal = z.times(z).times(&four_cross);
        // division by four: the integer 4 is invertible wherever distances make sense
        let quarter = ij.one().over(&ij.integer(4));
        quarter.map_or_else(|| planar.clone(), |q| planar.plus(&normal.times(&q)))
    }
}

/// The quality of a triangle as a base of trilaterations.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Base {
    /// A proper triangle.
    Proper,
    /// Collinear within rounding of its coordinates: `A_ijk = 0`.
    Collinear,
}

impl Base {
    /// Decides from the squared sides. The triangle is collinear when `A` is below `2^-40` of the square of the largest
    /// squared side. The height is then below about a millionth of the longest side.
    #[must_use]
    pub fn of(sides: [f64; 3]) -> Self {
        if Self::fatness(sides) > 2f64.powi(-40) { Self::Proper } else { Self::Collinear }
    }

    /// `A` over the square of the largest squared side, `4 (height / longest side)^2`: 3 for an equilateral triangle, 0
    /// for a collinear one or a point.
    #[must_use]
    pub fn fatness([ij, ik, jk]: [f64; 3]) -> f64 {
        let largest = ij.max(ik).max(jk);
        if !(largest > 0.0) {
            return 0.0;
        }
        let (x, y, z) = (ij / largest, ik / largest, jk / largest);
        let twice_uv = x + y - z;
        4.0 * x * y - twice_uv * twice_uv
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use num_complex::Complex64;
    use proptest::prelude::*;

    type Point = Vector3<f64>;

    fn tetrahedron(p: &[Point; 4]) -> Tetrahedron<f64> {
        let s = |x: usize, y: usize| (p[x] - p[y]).norm_squared();
        Tetrahedron { ij: s(0, 1), ik: s(0, 2), jk: s(1, 2), il: s(0, 3), jl: s(1, 3), kl: s(2, 3) }
    }

    fn point() -> impl Strategy<Value = Point> {
        prop::array::uniform3(-1.0..1.0).prop_map(|x: [f64; 3]| Point::new(x[0], x[1], x[2]))
    }

    proptest! {
        #[test]
        fn the_point_comes_back_and_the_sign_is_the_orientation(p in prop::array::uniform4(point())) {
            let (u, v, w) = (p[1] - p[0], p[2] - p[0], p[3] - p[0]);
            let t = tetrahedron(&p).trilateration();
            prop_assume!(u.cross(&v).norm_squared() > 1e-2);
            prop_assert!((t.a - 4.0 * u.cross(&v).norm_squared()).abs() < 1e-12);
            let triple = u.cross(&v).dot(&w);
            prop_assert!((t.radicand - 16.0 * triple * triple).abs() < 1e-10);
            let root = t.radicand.max(0.0).sqrt().copysign(triple);
            let [x, y, z] = t.coordinates(&root).unwrap();
            let back = u * x + v * y + u.cross(&v) * z;
            // the square root halves the digits of a flat tetrahedron
            prop_assert!((back - w).norm() < 1e-5);
            let length = TrilateratedPoint::squared_length(&[x, y, z], [&u.norm_squared(), &v.norm_squared(), &(u - v).norm_squared()]);
            prop_assert!((length - w.norm_squared()).abs() < 1e-8);
            let other = u * x + v * y - u.cross(&v) * z;
            for q in [Point::zeros(), u, v] {
                prop_assert!(((other - q).norm_squared() - (back - q).norm_squared()).abs() < 1e-9);
            }
        }

        #[test]
        fn five_points_in_space_have_no_volume(p in prop::array::uniform5(point())) {
            let squared = |x: usize, y: usize| Complex64::from((p[x] - p[y]).norm_squared());
            let d = determinant(&Complex64::ONE, &[0, 1, 2, 3, 4], &squared);
            prop_assert!(d.norm() < 1e-11);
            let spoilt = |x: usize, y: usize| squared(x, y) + if x + y == 1 { 0.3 } else { 0.0 };
            let d4 = determinant(&Complex64::ONE, &[2, 3, 4], &squared);
            prop_assume!(d4.norm() > 0.05);
            prop_assert!(determinant(&Complex64::ONE, &[0, 1, 2, 3, 4], &spoilt).norm() > 1e-11);
        }

        #[test]
        fn a_bideterminant_is_transposed_by_exchange(p in prop::array::uniform5(point())) {
            let squared = |x: usize, y: usize| (p[x] - p[y]).norm_squared();
            let (rows, columns) = ([0, 1, 4], [0, 2, 3]);
            let (d, e) = (bideterminant(&0.0, &rows, &columns, &squared), bideterminant(&0.0, &columns, &rows, &squared));
            prop_assert!((d - e).abs() < 1e-12);
            // -D(i,j,k; i,l,m) = 4 (u x v).(u' x v') for two triangles at one point
            let product = (p[1] - p[0]).cross(&(p[4] - p[0])).dot(&(p[2] - p[0]).cross(&(p[3] - p[0])));
            prop_assert!((d + 4.0 * product).abs() < 1e-11);
        }
    }

    #[test]
    fn a_collinear_base_is_told_at_any_scale() {
        for scale in [1e-9, 1.0, 1e9] {
            let at = |x: f64, y: f64| Point::new(x, y, 1.0) * scale;
            let p = [at(0.0, 0.0), at(1.0, 1.0), at(3.0, 3.0)];
            let sides = |p: &[Point; 3]| [(0, 1), (0, 2), (1, 2)].map(|(i, j)| (p[i] - p[j]).norm_squared());
            assert_eq!(Base::of(sides(&p)), Base::Collinear);
            assert_eq!(Base::of(sides(&[p[0], p[1], at(3.0, 3.01)])), Base::Proper);
            assert_eq!(Base::of(sides(&[p[0], p[0], p[0]])), Base::Collinear);
        }
        let flat = Tetrahedron { ij: 1.0, ik: 4.0, jk: 1.0, il: 1.0, jl: 2.0, kl: 5.0 }.trilateration();
        assert_eq!((flat.a, flat.coordinates(&0.0)), (0.0, None));
    }
}
