//! `det J` along a straight path of poses, as a polynomial with interval coefficients.
//!
//! With the quaternion `e(u) = (1 - u) e_0 + u e_1` (not normalised) and `p(u) = (1 - u) p_0 + u p_1` the vectors
//! `N n_i = N R(e) b_i + N (p - a_i)`, `N = e.e`, are cubic forms in `(1 - u, u)`, and `N^6 det J` is one of degree 18. It is kept by its
//! coefficients `c_k` of `(1 - u)^{18 - k} u^k`, which multiply like those of ordinary polynomials; `c_k` over the binomial coefficient is
//! the Bernstein coefficient: when all have one sign the form has it on `[0, 1]`.

use nalgebra::{UnitQuaternion, Vector3};

use crate::geom::Pose;
use crate::manipulator::Manipulator;
use crate::num::interval::Interval;

/// Degree of `N^6 det J`.
const DEGREE: usize = 18;

/// A form in `(1 - u, u)` by its coefficients.
type Form = Vec<Interval>;

fn times(x: &Form, y: &Form) -> Form {
    let mut out = vec![Interval::ZERO; x.len() + y.len() - 1];
    for (i, a) in x.iter().enumerate() {
        for (j, b) in y.iter().enumerate() {
            out[i + j] = out[i + j] + *a * *b;
        }
    }
    out
}

fn plus(x: &Form, y: &Form) -> Form {
    x.iter().zip(y).map(|(a, b)| *a + *b).collect()
}

fn minus(x: &Form, y: &Form) -> Form {
    x.iter().zip(y).map(|(a, b)| *a - *b).collect()
}

fn scaled(x: &Form, factor: Interval) -> Form {
    x.iter().map(|a| *a * factor).collect()
}

/// Bernstein coefficients of `N^6 det J` on the path from `from` to `to`, up to the power of the size.
pub(super) fn determinant(m: &Manipulator, from: &Pose, to: &Pose) -> Vec<Interval> {
    let rows = rows(m, from, to);
    let minor = |r: usize, c: [usize; 3]| {
        let part = |i: usize, j: usize, k: usize| {
            let two =
                minus(&times(&rows[r + 1][j], &rows[r + 2][k]), &times(&rows[r + 1][k], &rows[r + 2][j]));
            times(&rows[r][i], &two)
        };
        plus(&minus(&part(c[0], c[1], c[2]), &part(c[1], c[0], c[2])), &part(c[2], c[0], c[1]))
    };
    let mut sum = vec![Interval::ZERO; DEGREE + 1];
    // Laplace expansion by complementary minors of the first three rows
    for i in 0..6 {
        for j in i + 1..6 {
            for k in j + 1..6 {
                let mut others = (0..6).filter(|x| ![i, j, k].contains(x));
                let rest: [usize; 3] = std::array::from_fn(|_| others.next().unwrap_or(0));
                let term = times(&minor(0, [i, j, k]), &minor(3, rest));
                sum = if (i + j + k) % 2 == 1 { plus(&sum, &term) } else { minus(&sum, &term) };
            }
        }
    }
    let mut binomial = 1.0;
    for (k, c) in sum.iter_mut().enumerate() {
        *c = c.checked_div(Interval::from(binomial)).unwrap_or(Interval::WHOLE);
        binomial = binomial * (DEGREE - k) as f64 / (k + 1) as f64;
    }
    sum
}

/// Rows `N [n_i, a_i x n_i]`, about the mean base joint in units of the size.
fn rows(m: &Manipulator, from: &Pose, to: &Pose) -> Vec<[Form; 6]> {
    let legs = m.legs();
    let mean = legs.iter().map(|l| l.base.coords).sum::<Vector3<f64>>() / 6.0;
    let unit = Interval::from(m.size());
    let place = |x: f64, origin: f64| {
        (Interval::from(x) - Interval::from(origin)).checked_div(unit).unwrap_or(Interval::WHOLE)
    };
    let (e0, e1) = quaternions(from, to);
    let e: [Form; 4] = std::array::from_fn(|k| vec![Interval::from(e0[k]), Interval::from(e1[k])]);
    let squares = e.each_ref().map(|x| times(x, x));
    let vector = plus(&plus(&squares[1], &squares[2]), &squares[3]);
    let norm = plus(&squares[0], &vector);
    let row = |leg: &crate::manipulator::Leg| {
        let base: [Interval; 3] = std::array::from_fn(|k| place(leg.base[k], mean[k]));
        let arm: [Interval; 3] = std::array::from_fn(|k| place(leg.platform[k], 0.0));
        let turned = turned(&e, &minus(&squares[0], &vector), &arm);
        let direction: [Form; 3] = std::array::from_fn(|k| {
            let line = [from, to].map(|pose| place(pose.position[k], mean[k]) - base[k]).to_vec();
            // the quadratic form of the rotation times (1 - u) + u, which is one
            plus(&times(&turned[k], &vec![Interval::from(1.0); 2]), &times(&norm, &line))
        });
        let moment =
            |i: usize, j: usize| minus(&scaled(&direction[j], base[i]), &scaled(&direction[i], base[j]));
        let (x, y, z) = (moment(1, 2), moment(2, 0), moment(0, 1));
        let [u, v, w] = direction;
        [u, v, w, x, y, z]
    };
    legs.iter().map(row).collect()
}

/// `N R(e) b = (w^2 - v.v) b + 2 (v.b) v + 2 w v x b` with `e = (w, v)`.
fn turned(e: &[Form; 4], difference: &Form, b: &[Interval; 3]) -> [Form; 3] {
    let v = [&e[1], &e[2], &e[3]];
    let along = plus(&plus(&scaled(v[0], b[0]), &scaled(v[1], b[1])), &scaled(v[2], b[2]));
    let two = Interval::from(2.0);
    std::array::from_fn(|k| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        let cross = minus(&scaled(v[i], b[j]), &scaled(v[j], b[i]));
        let rest = plus(&times(&along, v[k]), &times(&e[0], &cross));
        plus(&scaled(difference, b[k]), &scaled(&rest, two))
    })
}

/// The quaternions of two poses, the second with the sign that makes the way short.
pub(super) fn quaternions(from: &Pose, to: &Pose) -> ([f64; 4], [f64; 4]) {
    let q = [from, to].map(|pose| {
        let q = UnitQuaternion::from_rotation_matrix(&pose.rotation);
        [q.w, q.i, q.j, q.k]
    });
    let dot: f64 = q[0].iter().zip(q[1]).map(|(x, y)| x * y).sum();
    (q[0], if dot < 0.0 { q[1].map(|x| -x) } else { q[1] })
}

/// The sign all numbers share, if they do.
pub(super) fn common_sign(c: &[Interval]) -> Option<Sign> {
    if c.iter().all(|x| x.lo() > 0.0) {
        Some(Sign::Positive)
    } else if c.iter().all(|x| x.hi() < 0.0) {
        Some(Sign::Negative)
    } else {
        None
    }
}

/// Bernstein coefficients on the two halves (de Casteljau).
pub(super) fn halves(c: &[Interval]) -> (Vec<Interval>, Vec<Interval>) {
    let half = Interval::from(0.5);
    let (mut row, mut left, mut right) = (c.to_vec(), Vec::new(), Vec::new());
    while let (Some(first), Some(last)) = (row.first(), row.last()) {
        left.push(*first);
        right.push(*last);
        row = row.windows(2).map(|w| (w[0] + w[1]) * half).collect();
    }
    right.reverse();
    (left, right)
}

/// Sign of `det J`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sign {
    /// `det J > 0`.
    Positive,
    /// `det J < 0`.
    Negative,
}

impl Sign {
    /// `+1` or `-1`.
    #[must_use]
    pub fn value(self) -> i8 {
        match self {
            Self::Positive => 1,
            Self::Negative => -1,
        }
    }
}
