//! Legs with the exact numbers of their joints, for ranks without any tolerance.
//!
//! Joints of a design with constructions are numbers of a field of square roots; plain doubles are rational numbers. A
//! point is homogeneous, `(1, x, y, z)`; the leg `(a, b)` is the vector `(1, a) (x) (1, b)` of `R^16`.

use nalgebra::Point3;

use super::{Body, ExactEnds, JointKnowledge, Leg, Manipulator};
use num::algebraic::Algebraic;
use num::exact::{ExactNumber, ExactVector, Rational, product, rank, rational};
use num::modular::{Field, mantissa_and_exponent};
use num::split::{SplitField, common_bits, degree_of};
use num::surd::Surd;

/// A vector of numbers of one field of square roots.
pub type AlgebraicVector = Vec<Algebraic>;

/// A leg between two points in exact homogeneous coordinates, first coordinates 1.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactLeg {
    /// The base end.
    pub base: ExactVector,
    /// The platform end.
    pub platform: ExactVector,
}

/// The six legs.
#[derive(Debug, Clone)]
pub struct ExactLegs {
    /// `(1, a_i)`.
    pub base: Vec<AlgebraicVector>,
    /// `(1, b_i)`.
    pub platform: Vec<AlgebraicVector>,
    /// `(1, a_i) (x) (1, b_i)`.
    pub vectors: Vec<AlgebraicVector>,
}

/// `(1, x)`; `None` if a coordinate is not finite.
pub fn homogeneous(p: &Point3<f64>) -> Option<ExactVector> {
    [1.0, p.x, p.y, p.z].iter().map(|x| rational(*x)).collect()
}

/// Dimension of the flat of homogeneous points: 0 a point, 1 a line, 2 a plane, 3 space.
pub fn flat_dimension<'a, N: ExactNumber + 'a>(points: impl IntoIterator<Item = &'a Vec<N>>) -> usize {
    rank(&points.into_iter().cloned().collect::<Vec<_>>()).saturating_sub(1)
}

fn squares(a: &[Rational], b: &[Rational]) -> Rational {
    a[1..].iter().chain(&b[1..]).map(|x| x * x).sum()
}

impl ExactLeg {
    /// `None` if a coordinate is not finite, which a manipulator excludes.
    pub fn of(leg: &Leg) -> Option<Self> {
        Some(Self { base: homogeneous(&leg.base)?, platform: homogeneous(&leg.platform)? })
    }

    /// `(1, a) (x) (1, b)`.
    pub fn vector(&self) -> ExactVector {
        product(&self.base, &self.platform)
    }

    /// `|a|^2 + |b|^2`.
    pub fn squares(&self) -> Rational {
        squares(&self.base, &self.platform)
    }
}

/// Legs with exactly known joints.
#[derive(Debug, Clone)]
pub enum ExactJoints {
    /// Joints as doubles.
    Doubles(Box<[Leg; 6]>),
    /// Joints as sums of square roots.
    Surds(Box<[ExactEnds; 6]>),
}

impl ExactJoints {
    /// `None` for joints that are known only between bounds.
    pub fn of(m: &Manipulator) -> Option<Self> {
        match m.joint_knowledge() {
            JointKnowledge::Doubles => Some(Self::Doubles(Box::new(m.legs()))),
            JointKnowledge::Exact => Some(Self::Surds(Box::new(m.exact_ends()?))),
            JointKnowledge::Enclosed => None,
        }
    }

    fn surds(&self) -> impl Iterator<Item = &Surd> {
        let ends = match self {
            Self::Doubles(_) => None,
            Self::Surds(ends) => Some(ends.iter().flatten().flatten()),
        };
        ends.into_iter().flatten()
    }

    /// Degree of a field with all coordinates; `None` for too many square roots.
    pub fn degree(&self) -> Option<usize> {
        degree_of(self.surds())
    }

    /// Residues of both ends of every leg, for one prime after the other.
    ///
    /// The sequence is practically without end; it is empty for too many square roots.
    pub fn residues(&self) -> impl Iterator<Item = LegResidues> {
        let fields = SplitField::all(self.surds()).into_iter().flatten();
        fields.filter_map(|field| Some(LegResidues { ends: self.modulo(&field)?, field: field.field() }))
    }

    fn modulo(&self, field: &SplitField) -> Option<[[[u64; 3]; 2]; 6]> {
        let mut residues = [[[0; 3]; 2]; 6];
        match self {
            Self::Doubles(legs) => {
                let of = |p: Point3<f64>| [p.x, p.y, p.z].map(|x| field.field().scaled(x, 0));
                residues = legs.each_ref().map(|leg| [of(leg.base), of(leg.platform)]);
            }
            Self::Surds(ends) => {
                let places = residues.iter_mut().flatten().flatten();
                for (x, residue) in ends.iter().flatten().flatten().zip(places) {
                    *residue = field.residue(x)?;
                }
            }
        }
        Some(residues)
    }

    /// Bits of a common denominator of all coordinates, and the exponent of a power of two that bounds all their
    /// conjugates.
    pub fn bits(&self) -> [i64; 2] {
        match self {
            Self::Doubles(legs) => {
                let all = legs.iter().flat_map(|l| l.base.iter().chain(l.platform.iter()));
                all.map(|x| mantissa_and_exponent(*x)).filter(|(m, _)| *m != 0).fold(
                    [0_i64, 0],
                    |[d, n], (m, e)| {
                        let length = i64::from(64 - m.unsigned_abs().leading_zeros());
                        [d.max(-i64::from(e)), n.max(length + i64::from(e))]
                    },
                )
            }
            Self::Surds(_) => common_bits(self.surds()),
        }
    }
}

/// The ends of legs modulo a prime: ranks there are at most the true ones.
#[derive(Debug, Clone)]
pub struct LegResidues {
    /// The field.
    pub field: Field,
    /// Base and platform end of every leg.
    pub ends: [[[u64; 3]; 2]; 6],
}

/// The rotation matrix of a quaternion of any norm but zero, scalar part first.
fn rotation_of(quaternion: &[Rational; 4]) -> [[Rational; 3]; 3] {
    let q = |i: usize, j: usize| &quaternion[i] * &quaternion[j];
    let norm = q(0, 0) + q(1, 1) + q(2, 2) + q(3, 3);
    let twice = |x: Rational| &x + &x;
    let rows = [
        [q(0, 0) + q(1, 1) - q(2, 2) - q(3, 3), twice(q(1, 2) - q(0, 3)), twice(q(1, 3) + q(0, 2))],
        [twice(q(1, 2) + q(0, 3)), q(0, 0) - q(1, 1) + q(2, 2) - q(3, 3), twice(q(2, 3) - q(0, 1))],
        [twice(q(1, 3) - q(0, 2)), twice(q(2, 3) + q(0, 1)), q(0, 0) - q(1, 1) - q(2, 2) + q(3, 3)],
    ];
    rows.map(|row| row.map(|x| x / &norm))
}

impl ExactLegs {
    /// The legs with exact joints. `None` for joints that are known only between bounds, and for coordinates with too
    /// many independent square roots.
    pub fn of(m: &Manipulator) -> Option<Self> {
        match ExactJoints::of(m)? {
            ExactJoints::Doubles(legs) => Self::of_doubles(&legs),
            ExactJoints::Surds(ends) => {
                let all = Algebraic::all(&ends.iter().flatten().flatten().collect::<Vec<_>>())?;
                let homogeneous = |p: &[Algebraic]| {
                    std::iter::once(Algebraic::integer(1)).chain(p.iter().cloned()).collect()
                };
                let points: Vec<AlgebraicVector> = all.chunks(3).map(homogeneous).collect();
                let (base, platform) = points.chunks(2).map(|p| (p[0].clone(), p[1].clone())).unzip();
                Some(Self::between(base, platform))
            }
        }
    }

    /// Legs with their doubles as rational numbers; `None` if a coordinate is not finite, which a manipulator excludes.
    pub fn of_doubles(legs: &[Leg; 6]) -> Option<Self> {
        let of = |p: &Point3<f64>| Some(homogeneous(p)?.into_iter().map(Algebraic::Rational).collect());
        let base = legs.iter().map(|l| of(&l.base)).collect::<Option<_>>()?;
        Some(Self::between(base, legs.iter().map(|l| of(&l.platform)).collect::<Option<_>>()?))
    }

    fn between(base: Vec<AlgebraicVector>, platform: Vec<AlgebraicVector>) -> Self {
        let vectors = base.iter().zip(&platform).map(|(a, b)| product(a, b)).collect();
        Self { base, platform, vectors }
    }

    /// The ends on `body`.
    pub fn ends(&self, body: Body) -> &[AlgebraicVector] {
        body.of((&self.base, &self.platform))
    }

    /// The coordinates of the end of a leg as fractions; `None` where one is irrational.
    pub fn fractions(&self, body: Body, leg: usize) -> Option<[Rational; 3]> {
        let point: Option<ExactVector> =
            self.ends(body)[leg][1..].iter().map(|x| x.as_rational().cloned()).collect();
        point?.try_into().ok()
    }

    /// Dimension of the flat of the ends of some legs on `body`.
    pub fn dimension(&self, body: Body, legs: &[usize]) -> usize {
        flat_dimension(legs.iter().map(|i| &self.ends(body)[*i]))
    }

    /// `|a|^2 + |b|^2` of a leg.
    pub fn squares(&self, leg: usize) -> Algebraic {
        self.base[leg][1..].iter().chain(&self.platform[leg][1..]).map(|x| x * x).sum()
    }

    /// The rows `(n, a x n)` of the leg lines, `n = R b + p - a`, at an exact pose: the rotation of a quaternion of any
    /// norm but zero, scalar part first, and a position.
    pub fn lines_at(&self, quaternion: &[Rational; 4], position: &[Rational; 3]) -> Vec<AlgebraicVector> {
        let rotation = rotation_of(quaternion).map(|row| row.map(Algebraic::from));
        let position = position.each_ref().map(|x| Algebraic::from(x.clone()));
        let ends = self.base.iter().zip(&self.platform);
        let line = |(a, b): (&AlgebraicVector, &AlgebraicVector)| {
            let n: [Algebraic; 3] = std::array::from_fn(|i| {
                let turned: Algebraic = rotation[i].iter().zip(&b[1..]).map(|(r, x)| r * x).sum();
                &(&turned + &position[i]) - &a[i + 1]
            });
            let cross = |i: usize, j: usize| &(&a[i + 1] * &n[j]) - &(&a[j + 1] * &n[i]);
            let moment = [cross(1, 2), cross(2, 0), cross(0, 1)];
            n.into_iter().chain(moment).collect()
        };
        ends.map(line).collect()
    }

    /// The vectors of some legs.
    pub fn vectors_of(&self, legs: &[usize]) -> Vec<AlgebraicVector> {
        legs.iter().map(|i| self.vectors[*i].clone()).collect()
    }

    /// Rank of the vectors of some legs.
    pub fn rank(&self, legs: &[usize]) -> usize {
        rank(&self.vectors_of(legs))
    }
}
