//! Singular poses of five legs that hold a line, and sixth legs that allow a stepwise solution of the platform.
//!
//! With the numbers of [`platform::pentapod`] the five squared lengths are linear in `(P, Q, p, v)`, which satisfy
//! `P = p.p`, `Q = p.v` and `v.v = d.d`. The pose of the line is singular if a motion that keeps these three equations
//! changes no leg length:
//!
//! ```text
//! F(p, v) = det [ row 1; ..; row 5;  (1, 0, -2p, 0);  (0, 1, -v, -p);  (0, 0, 0, 2v) ] = 0
//! ```
//!
//! `F` is a cubic polynomial, at most quadratic in the position and at most quadratic in the direction. Rasoulzadeh and
//! Nawratil (2018) search for linear pentapods with a simpler `F`: linear in one of them, or quadratic in total.

use std::collections::BTreeMap;

use num::exact::{self, ExactVector, Rational, integer, rank};
use num_traits::{One, Zero};
use platform::manipulator::Body;
use platform::pentapod::{
    LINE_NUMBERS, LinearPentapod, Pentapod, RationalPoint, cross, joints_of_legs, lines_without_one_leg,
};

/// Exponents of `p_x, p_y, p_z, v_x, v_y, v_z`.
type LineExponents = [u8; 6];

/// A polynomial in the position and the direction of the line.
pub type LinePolynomial = BTreeMap<LineExponents, Rational>;

/// The singular locus of five legs that hold a line.
#[derive(Debug, Clone, PartialEq)]
pub struct LineLocus {
    /// `F` with coprime integers as coefficients; `p` is the joint of leg 1 and `v` has the length of `d`.
    pub polynomial: LinePolynomial,
    /// Its degree in all six unknowns.
    pub degree: u8,
    /// Its degree in the position.
    pub in_position: u8,
    /// Its degree in the direction.
    pub in_direction: u8,
    /// Whether every pose of the line is singular: the pentapod is architecturally singular.
    pub everywhere: bool,
}

impl LineLocus {
    /// The locus of a linear pentapod.
    #[must_use]
    pub fn of(p: &LinearPentapod) -> Self {
        let polynomial = primitive(determinant(&p.rows()));
        let degree = |unknowns: std::ops::Range<usize>| {
            polynomial.keys().map(|e| e[unknowns.clone()].iter().sum::<u8>()).max().unwrap_or(0)
        };
        Self {
            degree: degree(0..6),
            in_position: degree(0..3),
            in_direction: degree(3..6),
            everywhere: with_unit_length(&polynomial, &p.square()).is_empty(),
            polynomial,
        }
    }

    /// The name of the family with these degrees.
    #[must_use]
    pub fn family(&self) -> &'static str {
        match (self.everywhere, self.degree, self.in_position, self.in_direction) {
            (true, ..) => "architecturally singular",
            (_, 0..=2, ..) => "quadratic in all",
            (_, _, 0..=1, _) => "linear in the position",
            (_, _, _, 0..=1) => "linear in the direction",
            _ => "cubic",
        }
    }

    /// `F` at a position and a direction.
    #[must_use]
    pub fn value(&self, position: &[f64; 3], direction: &[f64; 3]) -> f64 {
        let term = |(exponents, c): (&LineExponents, &Rational)| {
            let unknowns = position.iter().chain(direction);
            exact::nearest(c) * unknowns.zip(exponents).map(|(x, e)| x.powi(i32::from(*e))).product::<f64>()
        };
        self.polynomial.iter().map(term).sum()
    }
}

/// The rows of `F` below those of the legs: entries are constants or multiples of one unknown.
fn gradients() -> [[LinePolynomial; LINE_NUMBERS]; 3] {
    let constant = |c: i64| LinePolynomial::from([([0; 6], integer(c))]);
    let unknown = |k: usize, c: i64| {
        let mut exponents = [0; 6];
        exponents[k] = 1;
        LinePolynomial::from([(exponents, integer(c))])
    };
    let (p, v) = ([0, 1, 2], [3, 4, 5]);
    let row = |first: [i64; 2], middle: Option<([usize; 3], i64)>, last: Option<([usize; 3], i64)>| {
        let mut row: [LinePolynomial; LINE_NUMBERS] = std::array::from_fn(|_| LinePolynomial::new());
        for (entry, c) in row.iter_mut().zip(first).filter(|(_, c)| *c != 0) {
            *entry = constant(c);
        }
        for (start, part) in [(2, middle), (5, last)] {
            if let Some((unknowns, c)) = part {
                unknowns.iter().enumerate().for_each(|(k, u)| row[start + k] = unknown(*u, c));
            }
        }
        row
    };
    [
        row([1, 0], Some((p, -2)), None),
        row([0, 1], Some((v, -1)), Some((p, -1))),
        row([0, 0], None, Some((v, 2))),
    ]
}

fn add(to: &mut LinePolynomial, x: &LinePolynomial, factor: &Rational) {
    for (exponents, c) in x {
        *to.entry(*exponents).or_insert_with(Rational::zero) += c * factor;
    }
    to.retain(|_, c| !c.is_zero());
}

fn product(x: &LinePolynomial, y: &LinePolynomial) -> LinePolynomial {
    let mut out = LinePolynomial::new();
    for (e, c) in x {
        let shifted = y.iter().map(|(f, d)| (std::array::from_fn(|k| e[k] + f[k]), d.clone())).collect();
        add(&mut out, &shifted, c);
    }
    out
}

/// Laplace expansion by the columns of the three rows of gradients.
fn determinant(legs: &[ExactVector; 5]) -> LinePolynomial {
    let rows = gradients();
    let mut out = LinePolynomial::new();
    for i in 0..LINE_NUMBERS {
        for j in i + 1..LINE_NUMBERS {
            for k in j + 1..LINE_NUMBERS {
                let rest: Vec<usize> = (0..LINE_NUMBERS).filter(|c| ![i, j, k].contains(c)).collect();
                let minor = exact::determinant(
                    legs.iter().map(|row| rest.iter().map(|c| row[*c].clone()).collect()).collect(),
                );
                if minor.is_zero() {
                    continue;
                }
                // rows 5, 6, 7 and columns i, j, k, counted from 0
                let sign = if (5 + 6 + 7 + i + j + k) % 2 == 0 { 1 } else { -1 };
                let columns = [i, j, k];
                for (order, parity) in [
                    ([0, 1, 2], 1),
                    ([1, 2, 0], 1),
                    ([2, 0, 1], 1),
                    ([0, 2, 1], -1),
                    ([1, 0, 2], -1),
                    ([2, 1, 0], -1),
                ] {
                    let entry = |row: usize| &rows[row][columns[order[row]]];
                    let term = product(&product(entry(0), entry(1)), entry(2));
                    add(&mut out, &term, &(&minor * integer(sign * parity)));
                }
            }
        }
    }
    out
}

/// The same function with `v_z^2` replaced, for a fixed value of `v.v`.
fn with_unit_length(polynomial: &LinePolynomial, square: &Rational) -> LinePolynomial {
    let mut out = LinePolynomial::new();
    for (exponents, c) in polynomial {
        let mut lower = *exponents;
        if exponents[5] < 2 {
            add(&mut out, &LinePolynomial::from([(lower, c.clone())]), &Rational::one());
            continue;
        }
        // the degree in the direction is at most two, so one pass suffices
        lower[5] -= 2;
        let raised = |k: usize| {
            let mut e = lower;
            e[k] += 2;
            (e, -c.clone())
        };
        let terms = LinePolynomial::from([(lower, c * square), raised(3), raised(4)]);
        add(&mut out, &terms, &Rational::one());
    }
    out
}

fn primitive(polynomial: LinePolynomial) -> LinePolynomial {
    let (exponents, coefficients): (Vec<_>, Vec<_>) = polynomial.into_iter().unzip();
    exponents.into_iter().zip(exact::primitive(&coefficients)).collect()
}

/// A sixth leg that allows a solution of the platform in steps, each a polynomial of low degree.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(tag = "case", rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum DecouplingLeg {
    /// Five legs hold a line of this body. Any leg off the line determines the rotation about it, with two solutions
    /// for each pose of the line.
    OffTheLine {
        /// The body.
        body: Body,
    },
    /// Four legs end on a line of this body. A fifth leg to the line makes them hold it, so that the line is solved
    /// first.
    ToTheLine {
        /// The body.
        body: Body,
        /// The four legs, counted from 1.
        legs: Vec<usize>,
    },
    /// Two legs share a joint of this body. A third leg to it determines its place by three distances, so that the
    /// position is solved first and the orientation about that joint second.
    ToTheJoint {
        /// The body.
        body: Body,
        /// The two legs, counted from 1.
        legs: Vec<usize>,
    },
}

impl DecouplingLeg {
    /// All suitable sixth legs for five legs.
    #[must_use]
    pub fn all(p: &Pentapod) -> Vec<Self> {
        let mut out = Vec::new();
        for body in [Body::Platform, Body::Base] {
            let dimension = |legs: &[usize]| p.dimension(body, legs);
            let counted = |legs: &[usize]| legs.iter().map(|leg| leg + 1).collect();
            if dimension(&[0, 1, 2, 3, 4]) == 1 {
                out.push(Self::OffTheLine { body });
            }
            let lines = lines_without_one_leg(5, dimension);
            out.extend(lines.iter().map(|legs| Self::ToTheLine { body, legs: counted(legs) }));
            let joints = joints_of_legs(5, 2, dimension);
            out.extend(joints.iter().map(|legs| Self::ToTheJoint { body, legs: counted(legs) }));
        }
        out
    }
}

/// Number of poses tried by [`independent_somewhere`].
const POSES: usize = 8;

/// Whether the lines of five legs are independent at a random pose; then they are independent at almost every pose.
/// `false`: they are dependent at all tried poses, which proves nothing.
#[must_use]
pub fn independent_somewhere(p: &Pentapod, seed: u64) -> bool {
    let mut rng = num::Rng::new(seed);
    let mut draw = || integer(rng.uniform(-9.0, 10.0).floor() as i64);
    (0..POSES).any(|_| {
        let [w, x, y, z] = [draw() + integer(20), draw(), draw(), draw()];
        let position = [draw(), draw(), draw()];
        let two = integer(2);
        let norm = &w * &w + &x * &x + &y * &y + &z * &z;
        let turned = |b: &RationalPoint| -> RationalPoint {
            // b + 2 q x (q x b + w b) / norm
            let q = [x.clone(), y.clone(), z.clone()];
            let inner = cross(&q, b);
            let inner = std::array::from_fn(|k| &inner[k] + &w * &b[k]);
            let outer = cross(&q, &inner);
            std::array::from_fn(|k| &b[k] + &two * &outer[k] / &norm + &position[k])
        };
        let rows: Vec<ExactVector> = (0..5)
            .map(|leg| {
                let (a, b) = (&p.base[leg], turned(&p.platform[leg]));
                let along = std::array::from_fn(|k| &b[k] - &a[k]);
                along.iter().cloned().chain(cross(a, &along)).collect()
            })
            .collect();
        rank(&rows) == 5
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{SMatrix, Vector3};
    use num::Rng;

    fn five(base: &[[f64; 3]; 5], marks: [f64; 5]) -> LinearPentapod {
        Pentapod::from_doubles(base, &marks.map(|x| [x, 0.0, 0.0])).unwrap().linear().unwrap()
    }

    /// The determinant of the Plücker coordinates of five legs and a torque about the line; it vanishes at singular
    /// poses.
    fn moments(base: &[[f64; 3]; 5], marks: [f64; 5], p: Vector3<f64>, v: Vector3<f64>) -> f64 {
        let mut rows = SMatrix::<f64, 6, 6>::zeros();
        for (i, a) in base.iter().enumerate() {
            let (a, b) = (Vector3::from(*a), p + v * marks[i]);
            let (l, m) = (b - a, b.cross(&(b - a)));
            rows.row_mut(i).copy_from_slice(&[l.x, l.y, l.z, m.x, m.y, m.z]);
        }
        // a torque about the line, which no leg can resist
        rows.row_mut(5).copy_from_slice(&[0.0, 0.0, 0.0, v.x, v.y, v.z]);
        rows.determinant()
    }

    #[test]
    fn the_polynomial_is_the_determinant_of_the_legs_at_every_pose() {
        let mut rng = Rng::new(5);
        for planar in [true, false] {
            let base: [[f64; 3]; 5] = std::array::from_fn(|_| {
                [
                    rng.uniform(-3.0, 3.0),
                    rng.uniform(-3.0, 3.0),
                    if planar { 0.0 } else { rng.uniform(-1.0, 1.0) },
                ]
            });
            let marks = [0.0, 3.0, 1.0, 5.0, -2.0];
            let locus = LineLocus::of(&five(&base, marks));
            assert_eq!((locus.degree, locus.in_position, locus.in_direction), (3, 2, 2));
            let ratio = |rng: &mut Rng| {
                let p = Vector3::from_fn(|_, _| rng.uniform(-3.0, 3.0));
                let v = Vector3::from_fn(|_, _| rng.normal()).normalize();
                // the direction has the length of the farthest joint, at mark 5
                let scaled = v * 5.0;
                locus.value(&p.into(), &scaled.into()) / moments(&base, marks, p, v)
            };
            let first = ratio(&mut rng);
            for _ in 0..10 {
                assert!((ratio(&mut rng) / first - 1.0).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn families_are_those_of_their_degrees() {
        // four coincident joints: singular everywhere, with independent rows
        let base = [[0.0, 0.0, 0.0], [4.0, 0.0, 1.0], [6.0, 3.0, 0.0], [3.0, 6.0, 2.0], [-1.0, 5.0, 0.0]];
        let p = five(&base, [0.0, 0.0, 0.0, 0.0, 1.0]);
        assert!(num::exact::relations(&p.rows()).is_empty());
        assert!(LineLocus::of(&p).everywhere);
        let line = |marks: [f64; 5]| Pentapod::from_doubles(&base, &marks.map(|x| [x, 0.0, 0.0])).unwrap();
        assert!(!independent_somewhere(&line([0.0, 0.0, 0.0, 0.0, 1.0]), 1));
        assert!(independent_somewhere(&line([0.0, 1.0, 3.0, 4.0, 6.0]), 1));
        assert_eq!(LineLocus::of(&five(&base, [0.0, 1.0, 3.0, 4.0, 6.0])).family(), "cubic");
        // marks that are an affine function of the joints of a plane
        let plane = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 3.0, 0.0], [-1.0, 2.0, 0.0], [3.0, 2.0, 0.0]];
        let locus = LineLocus::of(&five(&plane, [1.0, 5.0, 0.0, -3.0, 5.0]));
        assert!(!locus.everywhere);
        assert_eq!((locus.degree, locus.in_position), (3, 1), "{:?}", locus.polynomial);
    }

    #[test]
    fn sixth_legs_go_to_lines_and_joints() {
        let base = [[0.0, 0.0, 0.0], [4.0, 0.0, 1.0], [6.0, 3.0, 0.0], [3.0, 6.0, 2.0], [-1.0, 5.0, 0.0]];
        let line = [0.0, 1.0, 3.0, 4.0, 6.0].map(|x| [x, 0.0, 0.0]);
        let legs =
            |platform: &[[f64; 3]; 5]| DecouplingLeg::all(&Pentapod::from_doubles(&base, platform).unwrap());
        assert_eq!(legs(&line), [DecouplingLeg::OffTheLine { body: Body::Platform }]);
        let mut four = line;
        four[4] = [1.0, 2.0, 0.0];
        assert_eq!(legs(&four), [DecouplingLeg::ToTheLine { body: Body::Platform, legs: vec![1, 2, 3, 4] }]);
        let shared = [[0.0; 3], [0.0; 3], [3.0, 1.0, 0.0], [4.0, 0.0, 2.0], [1.0, 2.0, 5.0]];
        assert_eq!(legs(&shared), [DecouplingLeg::ToTheJoint { body: Body::Platform, legs: vec![1, 2] }]);
    }
}
