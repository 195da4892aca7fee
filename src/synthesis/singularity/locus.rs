//! The singular poses of a family of poses, as the zeros of one polynomial.
//!
//! At a fixed orientation `det J` is a cubic in the position, and on a line of positions a cubic in one parameter. On a
//! rotation about an axis it is a polynomial in the tangent of half the angle, over powers of the quaternion's norm.
//! Theory: `docs/theory/parallel-singularities.md`. Source of the cubic: Mayer St-Onge, Gosselin (2000).

use std::collections::BTreeMap;

use num::algebraic::Algebraic;
use num::interval::Interval;
use num::poly::{FieldPoly, RootCount, without_common_factor};
use num::surd::Surd;
use platform::manipulator::{JointKnowledge, Manipulator};

/// Greatest degree of `det J` in the position.
const POSITION_DEGREE: usize = 3;

/// An exact pose: its position, and a nonzero quaternion of any norm, scalar first.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactPose {
    /// The position.
    pub position: [Surd; 3],
    /// The quaternion.
    pub quaternion: [Surd; 4],
}

/// A family of poses around a given one.
#[derive(Debug, Clone, PartialEq)]
pub enum PoseFamily {
    /// Every position at the orientation of the pose.
    Positions,
    /// The positions `p + u d`.
    Line([Surd; 3]),
    /// The rotations about an axis through the platform origin, with the quaternions `(1, u n) q`.
    Rotation([Surd; 3]),
}

/// The coefficients of a polynomial, each with its exponents.
#[derive(Debug, Clone, PartialEq)]
pub enum LocusCoefficients {
    /// Exact coefficients: integers without a common factor if the ratios are fractions, otherwise with a leading 1.
    Exact(Vec<(Vec<usize>, Algebraic)>),
    /// Enclosures, if joints are known only between bounds.
    Enclosed(Vec<(Vec<usize>, Interval)>),
}

/// `det J` on a family of poses, up to a constant factor.
#[derive(Debug, Clone, PartialEq)]
pub struct LocusPolynomial {
    /// The terms: one unknown is `u`; three unknowns are the coordinates of the position.
    pub coefficients: LocusCoefficients,
    /// The degree including the powers of the norm of the quaternion; `None` for zero.
    pub degree_before: Option<usize>,
    /// The degree; `None` for zero: every pose of the family is singular.
    pub degree: Option<usize>,
    /// The square of the length of the axis, and the removed power of `1 + n^2 u^2`.
    pub removed: Option<(Algebraic, usize)>,
    /// The roots of nonzero exact polynomials in one unknown.
    pub roots: Option<RootCount>,
}

/// Number types for sums of products.
trait Term: Clone {
    fn integer(n: i64) -> Self;
    fn plus(&self, other: &Self) -> Self;
    fn times(&self, other: &Self) -> Self;
    fn is_nothing(&self) -> bool;
}

impl Term for Algebraic {
    fn integer(n: i64) -> Self {
        Self::integer(n)
    }
    fn plus(&self, other: &Self) -> Self {
        self + other
    }
    fn times(&self, other: &Self) -> Self {
        self * other
    }
    fn is_nothing(&self) -> bool {
        self.is_zero()
    }
}

impl Term for Interval {
    fn integer(n: i64) -> Self {
        Self::from(n as f64)
    }
    fn plus(&self, other: &Self) -> Self {
        *self + *other
    }
    fn times(&self, other: &Self) -> Self {
        *self * *other
    }
    fn is_nothing(&self) -> bool {
        *self == Self::ZERO
    }
}

/// A polynomial in up to three unknowns.
#[derive(Clone)]
struct Terms<N>(BTreeMap<[usize; 3], N>);

impl<N: Term> Terms<N> {
    fn zero() -> Self {
        Self(BTreeMap::new())
    }

    fn constant(x: N) -> Self {
        Self::term([0; 3], x)
    }

    fn term(exponents: [usize; 3], x: N) -> Self {
        Self(std::iter::once((exponents, x)).filter(|(_, x)| !x.is_nothing()).collect())
    }

    fn integer(n: i64) -> Self {
        Self::constant(N::integer(n))
    }

    fn add(&mut self, exponents: [usize; 3], x: &N) {
        let sum = self.0.get(&exponents).map_or_else(|| x.clone(), |own| own.plus(x));
        if sum.is_nothing() {
            self.0.remove(&exponents);
        } else {
            self.0.insert(exponents, sum);
        }
    }

    fn plus(&self, other: &Self) -> Self {
        let mut sum = self.clone();
        other.0.iter().for_each(|(e, x)| sum.add(*e, x));
        sum
    }

    fn times(&self, other: &Self) -> Self {
        let mut product = Self::zero();
        for (e, x) in &self.0 {
            for (f, y) in &other.0 {
                product.add([0, 1, 2].map(|k| e[k] + f[k]), &x.times(y));
            }
        }
        product
    }

    fn minus(&self, other: &Self) -> Self {
        self.plus(&other.times(&Self::integer(-1)))
    }

    fn degree(&self) -> Option<usize> {
        self.0.keys().map(|e| e.iter().sum()).max()
    }
}

type TermVector<N> = [Terms<N>; 3];

fn cross<N: Term>(a: &TermVector<N>, b: &TermVector<N>) -> TermVector<N> {
    let part = |i: usize, j: usize| a[i].times(&b[j]).minus(&a[j].times(&b[i]));
    [part(1, 2), part(2, 0), part(0, 1)]
}

fn dot<N: Term>(a: &[Terms<N>], b: &[Terms<N>]) -> Terms<N> {
    a.iter().zip(b).fold(Terms::zero(), |sum, (x, y)| sum.plus(&x.times(y)))
}

/// Position, quaternion and joints in one kind of number.
struct Numbers<N> {
    position: [N; 3],
    quaternion: [N; 4],
    /// The direction or the axis.
    direction: [N; 3],
    legs: Vec<[[N; 3]; 2]>,
}

impl<N: Term> Numbers<N> {
    /// `N^6 det J` without lengths, for the quaternions and positions of the family with the norm `N`.
    fn determinant(&self, family: &PoseFamily) -> Terms<N> {
        let constants = |v: &[N; 3]| v.each_ref().map(|x| Terms::constant(x.clone()));
        let unknown = |k: usize| Terms::term([0, 1, 2].map(|i| usize::from(i == k)), N::integer(1));
        let along = constants(&self.direction).map(|d| d.times(&unknown(0)));
        let (mut position, mut e) =
            (constants(&self.position), self.quaternion.each_ref().map(|x| Terms::constant(x.clone())));
        match family {
            PoseFamily::Positions => position = [0, 1, 2].map(unknown),
            PoseFamily::Line(_) => position = [0, 1, 2].map(|k| position[k].plus(&along[k])),
            PoseFamily::Rotation(_) => {
                // (1, u n) (w, v) = (w - u n.v, v + u w n + u n x v)
                let [w, v @ ..] = e.clone();
                let turned = cross(&along, &v);
                let part = |k: usize| v[k].plus(&along[k].times(&w)).plus(&turned[k]);
                e = [w.minus(&dot(&along, &v)), part(0), part(1), part(2)];
            }
        }
        let norm = dot(&e, &e);
        let [w, axis @ ..] = e;
        let two = Terms::integer(2);
        let rows: Vec<[TermVector<N>; 2]> = self
            .legs
            .iter()
            .map(|[a, b]| {
                let (a, b) = (constants(a), constants(b));
                let once = cross(&axis, &b);
                let twice = cross(&axis, &once);
                let line = [0, 1, 2].map(|k| {
                    // N (p + b - a) + 2 (w (v x b) + v x (v x b))
                    let shift = position[k].plus(&b[k]).minus(&a[k]);
                    norm.times(&shift).plus(&two.times(&w.times(&once[k]).plus(&twice[k])))
                });
                let moment = cross(&a, &line);
                [line, moment]
            })
            .collect();
        laplace(&rows)
    }
}

/// The determinant of the rows `[l, m]` by minors of the first and of the last three columns.
fn laplace<N: Term>(rows: &[[TermVector<N>; 2]]) -> Terms<N> {
    let minor = |three: &[usize], side: usize| {
        let row = |k: usize| &rows[three[k]][side];
        dot(row(0), &cross(row(1), row(2)))
    };
    let mut sum = Terms::zero();
    for mask in (0u8..64).filter(|mask| mask.count_ones() == 3) {
        let (inside, outside): (Vec<usize>, Vec<usize>) = (0..6).partition(|k| mask >> k & 1 == 1);
        let part = minor(&inside, 0).times(&minor(&outside, 1));
        // rows count from 0 here, from 1 in the formula
        let negative = inside.iter().sum::<usize>() % 2 == 0;
        sum = if negative { sum.minus(&part) } else { sum.plus(&part) };
    }
    sum
}

/// `det J` on a family of poses. `None` if numbers of the pose have too many square roots besides those of the joints.
///
/// The result is exact if the joints are known exactly; otherwise intervals enclose it.
#[must_use]
pub fn locus_polynomial(m: &Manipulator, pose: &ExactPose, family: &PoseFamily) -> Option<LocusPolynomial> {
    let zero = [Surd::zero(), Surd::zero(), Surd::zero()];
    let direction = match family {
        PoseFamily::Positions => &zero,
        PoseFamily::Line(d) | PoseFamily::Rotation(d) => d,
    };
    let own = pose.position.iter().chain(&pose.quaternion).chain(direction);
    if m.joint_knowledge() == JointKnowledge::Enclosed {
        let mut of_pose = own.map(enclosure);
        let mut next = || of_pose.next().unwrap_or(Interval::ZERO);
        let numbers = Numbers {
            position: [next(), next(), next()],
            quaternion: [next(), next(), next(), next()],
            direction: [next(), next(), next()],
            legs: (0..6).map(|leg| m.enclosed_ends(leg)).collect(),
        };
        return Some(enclosed(numbers.determinant(family), family));
    }
    let ends = m.exact_ends()?;
    let all: Vec<&Surd> = own.chain(ends.iter().flatten().flatten()).collect();
    let mut all = Algebraic::all(&all)?.into_iter();
    let mut next = || all.next().unwrap_or_else(|| Algebraic::integer(0));
    let mut numbers = Numbers {
        position: [next(), next(), next()],
        quaternion: [next(), next(), next(), next()],
        direction: [next(), next(), next()],
        legs: Vec::new(),
    };
    numbers.legs = (0..6).map(|_| [[next(), next(), next()], [next(), next(), next()]]).collect();
    let found = numbers.determinant(family);
    Some(match family {
        PoseFamily::Positions => in_position(&found),
        PoseFamily::Line(_) => univariate(&found, None),
        PoseFamily::Rotation(_) => univariate(&found, Some(&numbers.direction)),
    })
}

fn enclosure(x: &Surd) -> Interval {
    let near = x.nearest();
    let exact = x.distance_from(near) <= 0.0;
    let bounds =
        if exact { Some(Interval::from(near)) } else { Interval::new(near.next_down(), near.next_up()) };
    bounds.unwrap_or(Interval::WHOLE)
}

/// Drops terms that cancel in exact numbers: powers of the position above the third.
fn enclosed(found: Terms<Interval>, family: &PoseFamily) -> LocusPolynomial {
    let (width, most) = match family {
        PoseFamily::Positions => (3, POSITION_DEGREE),
        PoseFamily::Line(_) => (1, POSITION_DEGREE),
        PoseFamily::Rotation(_) => (1, usize::MAX),
    };
    let kept = found.0.into_iter().filter(|(e, _)| e.iter().sum::<usize>() <= most);
    let terms: Vec<(Vec<usize>, Interval)> = kept.map(|(e, x)| (e[..width].to_vec(), x)).collect();
    let degree = terms.iter().map(|(e, _)| e.iter().sum()).max();
    LocusPolynomial {
        coefficients: LocusCoefficients::Enclosed(terms),
        degree_before: degree,
        degree,
        removed: None,
        roots: None,
    }
}

fn in_position(found: &Terms<Algebraic>) -> LocusPolynomial {
    let terms = found.0.iter().rev().map(|(e, x)| (e.to_vec(), x.clone()));
    let (exponents, values): (Vec<_>, Vec<_>) = terms.unzip();
    let scaled = without_common_factor(&values, values.first());
    let degree = found.degree();
    LocusPolynomial {
        coefficients: LocusCoefficients::Exact(exponents.into_iter().zip(scaled).collect()),
        degree_before: degree,
        degree,
        removed: None,
        roots: None,
    }
}

fn univariate(found: &Terms<Algebraic>, axis: Option<&[Algebraic; 3]>) -> LocusPolynomial {
    let top = found.degree().map_or(0, |n| n + 1);
    let coefficient = |k: usize| found.0.get(&[k, 0, 0]).cloned().unwrap_or_else(|| Algebraic::integer(0));
    let before = FieldPoly::new((0..top).map(coefficient).collect());
    let (mut after, mut removed) = (before.clone(), None);
    if let Some(axis) = axis.filter(|_| before.degree().is_some()) {
        let square: Algebraic = axis.iter().map(|x| x * x).sum();
        let norm = FieldPoly::new(vec![Algebraic::integer(1), Algebraic::integer(0), square.clone()]);
        let mut times = 0;
        loop {
            let (quotient, rest) = after.divided(&norm);
            if rest.degree().is_some() {
                break;
            }
            (after, times) = (quotient, times + 1);
        }
        removed = Some((square, times));
    }
    let scaled = without_common_factor(after.coefficients(), after.coefficients().last());
    LocusPolynomial {
        coefficients: LocusCoefficients::Exact(
            scaled.into_iter().enumerate().map(|(k, c)| (vec![k], c)).collect(),
        ),
        degree_before: before.degree(),
        degree: after.degree(),
        removed,
        roots: after.degree().map(|_| after.roots()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Vector3};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::leg_determinant;

    fn surd(x: f64) -> Surd {
        Surd::rational(&num::exact::rational(x).unwrap()).unwrap()
    }

    fn value(p: &LocusPolynomial, at: &[f64]) -> f64 {
        let power =
            |e: &[usize]| e.iter().zip(at).map(|(n, x)| (0..*n).fold(1.0, |p, _| p * x)).product::<f64>();
        match &p.coefficients {
            LocusCoefficients::Exact(terms) => terms.iter().map(|(e, c)| power(e) * c.approximate()).sum(),
            LocusCoefficients::Enclosed(terms) => {
                terms.iter().map(|(e, c)| power(e) * c.centre_and_radius().0).sum()
            }
        }
    }

    /// The ratio of the polynomial to det J is constant over all poses of the family.
    #[test]
    fn the_polynomials_are_det_j() {
        let mut rng = Rng::new(3);
        let mut points = |z: f64| -> Vec<Point3<f64>> {
            let mut one = || (rng.uniform(-1.0, 1.0) * 64.0).round() / 64.0;
            (0..6).map(|_| Point3::new(one(), one(), one() + z)).collect()
        };
        let m = Manipulator::try_new(points(0.0), points(0.5), std::array::from_fn(|i| (i, i))).unwrap();
        let start =
            Pose { rotation: random_rotation(&mut Rng::new(4)), position: Vector3::new(0.25, -0.5, 1.5) };
        let exact =
            ExactPose { position: [0.25, -0.5, 1.5].map(surd), quaternion: start.quaternion().map(surd) };
        let axis = [1.0, 2.0, -2.0];
        let families = [
            (PoseFamily::Positions, 3, 3),
            (PoseFamily::Line(axis.map(surd)), 3, 3),
            (PoseFamily::Rotation(axis.map(surd)), 12, 6),
        ];
        for joints in [m.clone(), m.clone().enclosed_within(1e-15)] {
            for (family, before, after) in &families {
                let found = locus_polynomial(&joints, &exact, family).unwrap();
                let is_exact = matches!(found.coefficients, LocusCoefficients::Exact(_));
                assert_eq!(found.degree_before, Some(*before));
                assert_eq!(found.degree, Some(if is_exact { *after } else { *before }));
                let ratio = |k: i32| {
                    let u = 0.1 * f64::from(k);
                    let (pose, at, norm) = match family {
                        PoseFamily::Positions => {
                            let p = Vector3::new(u, 0.5 * u, 1.0 - u);
                            (Pose { position: p, ..start }, p.as_slice().to_vec(), 1.0)
                        }
                        PoseFamily::Line(_) => (
                            Pose { position: start.position + Vector3::from(axis) * u, ..start },
                            vec![u],
                            1.0,
                        ),
                        PoseFamily::Rotation(_) => {
                            let turn = nalgebra::Quaternion::new(1.0, axis[0] * u, axis[1] * u, axis[2] * u);
                            let turn = nalgebra::UnitQuaternion::from_quaternion(turn).to_rotation_matrix();
                            let power = if is_exact { 3 } else { 6 };
                            (
                                Pose { rotation: turn * start.rotation, ..start },
                                vec![u],
                                (1.0 + 9.0 * u * u).powi(power),
                            )
                        }
                    };
                    value(&found, &at) / (norm * leg_determinant(&m, &pose))
                };
                for k in 1..5 {
                    assert!(
                        (ratio(k) / ratio(0) - 1.0).abs() < 1e-8,
                        "{family:?} {k}: {} {}",
                        ratio(k),
                        ratio(0)
                    );
                }
            }
        }
    }
}
