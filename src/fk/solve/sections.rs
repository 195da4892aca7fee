//! Six leg equations as six linear sections of the group variety, in dual-quaternion coordinates.
//!
//! Let `e` be the rotation quaternion, `p` the position as a pure quaternion, and `g = p e` their quaternion product,
//! so that `e.g = 0`. Then every leg equation, multiplied by `N = e.e`, is one quadratic form
//!
//! ```text
//! q(e, g) = e^T E e + g^T T e + c g.g,      T e = (-m.ev, m e0 + n x ev),
//! ```
//!
//! with `E` symmetric 4 x 4, `T` skew 4 x 4 given by the two vectors `m, n`, and `c` a number: 17 coefficients. For the
//! leg `(a, b, s)`: `m = 2 (b - a)`, `n = -2 (a + b)`, `c = 1` and `e^T E e = (|a|^2 + |b|^2 - s) N - 2 a^T R b N`. The
//! 17 forms are the coordinates of the compactified group `SE(3)` in `P^16`, a sixfold of degree 40 (Gallet, Nawratil,
//! Schicho 2014). So six general linear equations in them have 40 solutions, whatever the legs. Only the span of the
//! six coefficient vectors matters. They are made orthonormal, which removes the scale of each equation and the
//! dependence on the leg order up to rounding.

use std::ops::Neg;

use nalgebra::{Rotation3, SMatrix, SVector, UnitQuaternion, Vector3};
use num_complex::Complex64;

use crate::solve::planar::Planes;
use num::Rng;
use num::small::bounded_svd;
use num::vector::{RingNumber, dot};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Number of quadratic forms.
pub(super) const FORMS: usize = 17;

/// Coefficients of one quadratic form, in the order `E00 E01 E02 E03 E11 E12 E13 E22 E23 E33`
/// (diagonal entries as they stand, off-diagonal entries of the symmetric matrix), `m`, `n`, `c`.
pub(crate) type FormRow = [Complex64; FORMS];

/// Six linear sections.
#[derive(Debug, Clone, Copy)]
pub struct Sections {
    /// One linear form a section.
    pub rows: [FormRow; 6],
}

/// Centred and scaled frames in which a problem is solved: `turn (a - origin_a) = scale a'`, likewise `b`.
#[derive(Debug, Clone, Copy)]
pub struct ScaledFrames {
    pub(super) base_origin: Vector3<f64>,
    pub(super) platform_origin: Vector3<f64>,
    pub(super) scale: f64,
    /// For doubly planar platforms: both frames turned so that the planes of the joints are `z = 0`.
    pub(super) planes: Option<Planes>,
}

impl ScaledFrames {
    /// Centroids as origins; the scale is the larger of the design's size and its RMS leg length.
    pub fn of(m: &Manipulator, s: &SquaredLegLengths) -> Self {
        let [base_origin, platform_origin] = m.mean_leg_ends();
        let rms = (s.get().iter().sum::<f64>() / 6.0).sqrt();
        Self { base_origin, platform_origin, scale: m.size().max(rms), planes: None }
    }

    /// [`ScaledFrames::of`] with the joints of base and platform in `z = 0`; `None` unless both are coplanar to
    /// rounding.
    pub fn planar(m: &Manipulator, s: &SquaredLegLengths) -> Option<Self> {
        Some(Self { planes: Some(Planes::of(m)?), ..Self::of(m, s) })
    }

    /// The orthonormalised sections of the legs, in this frame, `g.g` in the last one only. Far out, where `|e|` is
    /// small against `|g|`, rounding in `g.g` would drown the information of the others about `e`. `None` when the six
    /// leg equations are linearly dependent to rounding (relative `1e-13`), so that they do not span six dimensions.
    pub fn sections(&self, m: &Manipulator, s: &SquaredLegLengths) -> Option<Sections> {
        self.moving_sections(m, s, &[Complex64::ZERO; 6]).map(|(sections, _)| sections)
    }

    /// The sections, and for each the factor of `e.e` by which it changes with the squared lengths. They change by
    /// `change` (design units squared), and the legs are combined as they are here.
    pub(crate) fn moving_sections(
        &self,
        m: &Manipulator,
        s: &SquaredLegLengths,
        change: &[Complex64; 6],
    ) -> Option<(Sections, [Complex64; 6])> {
        let [first, others @ ..] = self.leg_rows(m, s);
        let apart = others.map(|row| std::array::from_fn(|k| row[k] - first[k]));
        let [a, b, c, d, e] = apart;
        let [first_moves, others_move @ ..] = change.map(|z| -z / (self.scale * self.scale));
        let [p, q, r, u, v] = others_move.map(|z| z - first_moves);
        let mut moves = [p, q, r, u, v, first_moves];
        let sections = Sections { rows: [a, b, c, d, e, first] }.orthonormalised_beside(&mut moves)?;
        Some((sections, moves))
    }

    fn leg_rows(&self, m: &Manipulator, s: &SquaredLegLengths) -> [FormRow; 6] {
        let mut rows = [[Complex64::ZERO; FORMS]; 6];
        for ((row, leg), s) in rows.iter_mut().zip(m.legs()).zip(s.get()) {
            let mut a = (leg.base.coords - self.base_origin) / self.scale;
            let mut b = (leg.platform.coords - self.platform_origin) / self.scale;
            if let Some(planes) = &self.planes {
                (a, b) = (planes.base * a, planes.platform * b);
                // zero up to rounding, or there were no planes
                (a.z, b.z) = (0.0, 0.0);
            }
            *row = leg_row(&a.into(), &b.into(), s / (self.scale * self.scale)).map(Complex64::from);
        }
        rows
    }

    /// The span of the leg equations as far as they are independent (sines above `tolerance`), filled up to six
    /// dimensions by random real sections. The second result is the number of these: `least` or more, and general
    /// combinations of the leg equations replace as many equations.
    pub(crate) fn sliced_sections(
        &self,
        m: &Manipulator,
        s: &SquaredLegLengths,
        tolerance: f64,
        least: usize,
        rng: &mut Rng,
    ) -> Option<(Sections, usize)> {
        let mut rest: Vec<SVector<Complex64, FORMS>> = self.leg_rows(m, s).map(SVector::from).to_vec();
        let norms: Vec<f64> = rest.iter().map(nalgebra::Matrix::norm).collect();
        for (row, norm) in rest.iter_mut().zip(&norms) {
            *row /= Complex64::new(*norm, 0.0);
        }
        let mut basis: Vec<SVector<Complex64, FORMS>> = Vec::new();
        while let Some((at, size)) =
            rest.iter().map(nalgebra::Matrix::norm).enumerate().max_by(|x, y| x.1.total_cmp(&y.1))
        {
            if !(size > tolerance) {
                break;
            }
            let row = rest.swap_remove(at) / Complex64::new(size, 0.0);
            for other in &mut rest {
                let parallel = row * row.dotc(other);
                *other -= parallel;
            }
            basis.push(row);
        }
        if basis.len() + least > 6 {
            let mix = |_| basis.iter().map(|row| row * Complex64::new(rng.normal(), 0.0)).sum();
            basis = (0..6usize.saturating_sub(least)).map(mix).collect();
        }
        let missing = 6 - basis.len();
        let mut random = || SVector::from_fn(|_, _| Complex64::new(rng.normal(), 0.0));
        basis.extend((0..missing).map(|_| random()));
        let rows: [SVector<Complex64, FORMS>; 6] = basis.try_into().ok()?;
        Some((Sections { rows: rows.map(Into::into) }.orthonormalised()?, missing))
    }

    /// Homogeneous coordinates `(e, g)` in the design's own frames from those in this frame.
    ///
    /// Turning: `R = T_a~ R' T_b`, hence `e = t_a~ e' t_b` with the quaternions of the turns, likewise `g`. Moving:
    /// `p = scale p' + o_a - R o_b`, hence `g = scale g' + o_a e - e o_b`.
    pub(crate) fn to_design(self, x: [Complex64; 8]) -> [Complex64; 8] {
        let (mut e, mut g) = split(x);
        if let Some(planes) = &self.planes {
            let (left, right) = (conjugated(turn(&planes.base)), turn(&planes.platform));
            let turned = |y| quaternion_product(quaternion_product(left, y), right);
            (e, g) = (turned(e), turned(g));
        }
        let left = quaternion_product(pure(&self.base_origin), e);
        let right = quaternion_product(e, pure(&self.platform_origin));
        let mut out = x;
        for k in 0..4 {
            out[k] = e[k];
            out[4 + k] = g[k] * self.scale + left[k] - right[k];
        }
        out
    }

    /// The inverse of [`to_design`](Self::to_design).
    pub(crate) fn to_frame(self, x: [Complex64; 8]) -> [Complex64; 8] {
        let (mut e, mut g) = split(x);
        let left = quaternion_product(pure(&self.base_origin), e);
        let right = quaternion_product(e, pure(&self.platform_origin));
        for k in 0..4 {
            g[k] = (g[k] - left[k] + right[k]) / self.scale;
        }
        if let Some(planes) = &self.planes {
            let (left, right) = (turn(&planes.base), conjugated(turn(&planes.platform)));
            let turned = |y| quaternion_product(quaternion_product(left, y), right);
            (e, g) = (turned(e), turned(g));
        }
        [e[0], e[1], e[2], e[3], g[0], g[1], g[2], g[3]]
    }

    /// Coordinates of this frame from those of the same frame with another scale.
    pub(crate) fn rescaled(&self, x: &[Complex64; 8], scale: f64) -> [Complex64; 8] {
        let ratio = scale / self.scale;
        std::array::from_fn(|k| if k < 4 { x[k] } else { x[k] * ratio })
    }

    /// Design units a unit of this frame.
    pub fn scale(&self) -> f64 {
        self.scale
    }
}

/// The quaternion of a turn.
fn turn(turn: &Rotation3<f64>) -> [Complex64; 4] {
    let q = UnitQuaternion::from_rotation_matrix(turn);
    [q.w, q.i, q.j, q.k].map(Complex64::from)
}

fn conjugated([w, i, j, k]: [Complex64; 4]) -> [Complex64; 4] {
    [w, -i, -j, -k]
}

fn pure(v: &Vector3<f64>) -> [Complex64; 4] {
    [Complex64::ZERO, v.x.into(), v.y.into(), v.z.into()]
}

/// `(e, g)` from `x`.
pub fn split(x: [Complex64; 8]) -> ([Complex64; 4], [Complex64; 4]) {
    ([x[0], x[1], x[2], x[3]], [x[4], x[5], x[6], x[7]])
}

/// Quaternion product, scalar part first.
pub fn quaternion_product<T: RingNumber>(p: [T; 4], q: [T; 4]) -> [T; 4] {
    [
        p[0] * q[0] - p[1] * q[1] - p[2] * q[2] - p[3] * q[3],
        p[0] * q[1] + p[1] * q[0] + p[2] * q[3] - p[3] * q[2],
        p[0] * q[2] - p[1] * q[3] + p[2] * q[0] + p[3] * q[1],
        p[0] * q[3] + p[1] * q[2] - p[2] * q[1] + p[3] * q[0],
    ]
}

fn twice<T: RingNumber>(x: T) -> T {
    x + x
}

/// The coefficient vector of one leg equation, in doubles or with more digits.
pub(crate) fn leg_row<T>(a: &[T; 3], b: &[T; 3], s: T) -> [T; FORMS]
where
    T: RingNumber + Neg<Output = T> + From<f64>,
{
    let gamma = |i: usize, j: usize| -twice(a[i] * b[j]);
    let trace = gamma(0, 0) + gamma(1, 1) + gamma(2, 2);
    let delta = dot(a, a) + dot(b, b) - s;
    let m = |k: usize| twice(b[k] - a[k]);
    let n = |k: usize| -twice(a[k] + b[k]);
    let diagonal = |k: usize| twice(gamma(k, k)) - trace + delta;
    [
        trace + delta,
        gamma(2, 1) - gamma(1, 2),
        gamma(0, 2) - gamma(2, 0),
        gamma(1, 0) - gamma(0, 1),
        diagonal(0),
        gamma(0, 1) + gamma(1, 0),
        gamma(0, 2) + gamma(2, 0),
        diagonal(1),
        gamma(1, 2) + gamma(2, 1),
        diagonal(2),
        m(0),
        m(1),
        m(2),
        n(0),
        n(1),
        n(2),
        T::from(1.0),
    ]
}

impl Sections {
    /// The same sections with rows as close to those of `other` as possible, so that the way to the others is shorter
    /// (orthogonal Procrustes problem). The real rows but the last are rotated among themselves, `O rows` with `O`
    /// orthogonal, and the sign of the last is chosen. The last row is the one with `g.g` and stays so.
    pub(crate) fn aligned_with(&self, other: &Self) -> Self {
        let real = |s: &Self| SMatrix::<f64, 6, FORMS>::from_fn(|i, k| s.rows[i][k].re);
        let (own, aim) = (real(self), real(other));
        let (own_first, aim_first) = (own.fixed_rows::<5>(0), aim.fixed_rows::<5>(0));
        let overlap = bounded_svd(&(aim_first * own_first.transpose()));
        // without the decomposition the rows stay as they are: any order of them will do
        let Some((u, v_t)) = overlap.and_then(|svd| svd.u.zip(svd.v_t)) else { return *self };
        let turned = u * v_t * own_first;
        let sign = 1.0_f64.copysign(own.row(5).dot(&aim.row(5)));
        let entry = |i: usize, k: usize| if i < 5 { turned[(i, k)] } else { sign * own[(5, k)] };
        Self { rows: std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k).into())) }
    }

    /// An orthonormal basis of the same span with `g.g` in the last row only.
    pub(crate) fn graded(&self) -> Option<Self> {
        const LAST: usize = FORMS - 1;
        let mut rows = self.rows;
        let pivot =
            (1..6).fold(0, |best, i| if rows[i][LAST].norm() > rows[best][LAST].norm() { i } else { best });
        rows.swap(pivot, 5);
        let [others @ .., last] = &mut rows;
        for row in others {
            let factor = row[LAST] / last[LAST];
            for k in 0..LAST {
                row[k] -= factor * last[k];
            }
            row[LAST] = Complex64::ZERO;
        }
        Self { rows }.orthonormalised()
    }

    /// Modified Gram-Schmidt with re-orthogonalisation; `None` when a row depends on the earlier ones.
    pub fn orthonormalised(&self) -> Option<Self> {
        self.orthonormalised_beside(&mut [Complex64::ZERO; 6])
    }

    /// Makes the rows orthonormal and combines one more number for each row in the same way; the numbers do not count
    /// in norms.
    fn orthonormalised_beside(&self, beside: &mut [Complex64; 6]) -> Option<Self> {
        let mut rows: [SVector<Complex64, FORMS>; 6] = self.rows.map(SVector::from);
        for i in 0..6 {
            let before = rows[i].norm();
            for _ in 0..2 {
                for j in 0..i {
                    let overlap = rows[j].dotc(&rows[i]);
                    let parallel = rows[j] * overlap;
                    rows[i] -= parallel;
                    let parallel = beside[j] * overlap;
                    beside[i] -= parallel;
                }
            }
            let after = rows[i].norm();
            if !(after > 1e-13 * before) {
                return None;
            }
            rows[i] /= Complex64::new(after, 0.0);
            beside[i] /= after;
        }
        Some(Self { rows: rows.map(Into::into) })
    }
}

/// `e.e` among the 17 forms.
pub(crate) const NORM_FORMS: [usize; 4] = [0, 4, 7, 9];

/// The 17 forms at `x`, such that `q(x) = sum_k row_k forms_k`.
pub(super) fn forms<T: RingNumber>([e0, e1, e2, e3, g0, g1, g2, g3]: [T; 8]) -> [T; FORMS] {
    [
        e0 * e0,
        twice(e0 * e1),
        twice(e0 * e2),
        twice(e0 * e3),
        e1 * e1,
        twice(e1 * e2),
        twice(e1 * e3),
        e2 * e2,
        twice(e2 * e3),
        e3 * e3,
        g1 * e0 - e1 * g0,
        g2 * e0 - e2 * g0,
        g3 * e0 - e3 * g0,
        e2 * g3 - e3 * g2,
        e3 * g1 - e1 * g3,
        e1 * g2 - e2 * g1,
        g0 * g0 + g1 * g1 + g2 * g2 + g3 * g3,
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    #[test]
    fn aligned_rows_span_the_same_sections_and_are_nearer() {
        let mut rng = Rng::new(4);
        let mut random = || {
            let mut row = || std::array::from_fn(|_| Complex64::new(rng.normal(), 0.0));
            Sections { rows: std::array::from_fn(|_| row()) }.graded().unwrap()
        };
        let (own, aim) = (random(), random());
        let turned = own.aligned_with(&aim);
        let matrix = |s: &Sections| SMatrix::<f64, 6, FORMS>::from_fn(|i, k| s.rows[i][k].re);
        let (a, b, c) = (matrix(&own), matrix(&aim), matrix(&turned));
        // orthonormal, with the same projector, and the overlap of the first five with the aim is symmetric: no turn
        // improves it
        assert!((c * c.transpose() - SMatrix::<f64, 6, 6>::identity()).norm() < 1e-13);
        assert!((c.transpose() * c - a.transpose() * a).norm() < 1e-13);
        assert!((0..5).all(|i| c[(i, FORMS - 1)].abs() < 1e-15));
        let overlap = b.fixed_rows::<5>(0) * c.fixed_rows::<5>(0).transpose();
        assert!((overlap - overlap.transpose()).norm() < 1e-13);
        assert!((b - c).norm() < (b - a).norm());
    }

    #[test]
    fn a_leg_row_vanishes_exactly_at_poses_with_its_length() {
        let mut rng = Rng::new(3);
        for _ in 0..20 {
            let mut vector = || Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0));
            let (a, b, p) = (vector(), vector(), vector());
            let rotation = random_rotation(&mut rng);
            let pose = Pose { rotation, position: p };
            let s = pose.squared_length(&Leg { base: a.into(), platform: b.into() });
            let q = UnitQuaternion::from_rotation_matrix(&rotation);
            let e = [q.w, q.i, q.j, q.k].map(|x| Complex64::new(1.3 * x, 0.0));
            let g = quaternion_product(pure(&p), e);
            let x = [e[0], e[1], e[2], e[3], g[0], g[1], g[2], g[3]];
            let value = |s: f64| -> Complex64 {
                leg_row(&a.into(), &b.into(), s).iter().zip(forms(x)).map(|(c, f)| f * *c).sum()
            };
            assert!(value(s).norm() < 1e-12);
            // the form is N (|R b + p - a|^2 - s), N = 1.69
            assert!((value(s - 1.0) - 1.69).norm() < 1e-12);
        }
    }
}
