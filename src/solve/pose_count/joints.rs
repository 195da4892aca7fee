//! The joints of a design modulo a prime: doubles as the dyadic numbers they are, exact joints as the algebraic numbers they are.
//!
//! Coordinates in `K = Q(sqrt b_1, .., sqrt b_k)`, the `b_i` pairwise coprime, have residues modulo the primes `p` for which all `b_i` are squares: the choice of a root of each
//! is a homomorphism from the integers of `K` to the field of `p`, whose kernel is a prime ideal over `p`. Such primes are one in `2^k`; primes are drawn until there is one.

use super::{CountUndecided, Lengths};
use crate::manipulator::{ExactEnds, JointKnowledge, Leg, Manipulator};
use crate::num::Rng;
use crate::num::modular::{Field, mantissa_and_exponent};
use crate::num::surd::{Surd, coprime_base};

/// Most square roots: beyond, the bound on the probability of error would be of little use.
const MOST_ROOTS: usize = 6;
/// Primes drawn for each that is expected to do.
const PATIENCE: usize = 16;

/// The ends of the legs modulo a prime, on base and platform.
pub(super) type EndResidues = [[[u64; 3]; 2]; 6];

/// Joints known exactly.
pub(super) enum CountedJoints {
    /// As the doubles they are.
    Dyadic(Box<[Leg; 6]>),
    /// In the field of the square roots of these numbers.
    Algebraic { ends: Box<[ExactEnds; 6]>, base: Vec<u64> },
}

impl CountedJoints {
    pub(super) fn of(m: &Manipulator) -> Result<Self, CountUndecided> {
        if m.joint_knowledge() == JointKnowledge::Doubles {
            return Ok(Self::Dyadic(Box::new(m.legs())));
        }
        let ends = m.exact_ends().ok_or(CountUndecided::JointsNotExact)?;
        let base = coprime_base(ends.iter().flatten().flatten().flat_map(Surd::radicands));
        if base.len() > MOST_ROOTS {
            return Err(CountUndecided::NoPrimeDrawn);
        }
        Ok(Self::Algebraic { ends: Box::new(ends), base })
    }

    /// Most primes drawn for one that does.
    fn draws(&self) -> usize {
        match self {
            Self::Dyadic(_) => 1,
            Self::Algebraic { base, .. } => PATIENCE << base.len(),
        }
    }

    /// How many times the probability that a drawn prime divides a minor exceeds that of a single draw and a minor that is an integer: as many draws, and
    /// as many conjugates of the minor, whose product is the integer.
    pub(super) fn chances(&self) -> f64 {
        match self {
            Self::Dyadic(_) => 1.0,
            Self::Algebraic { base, .. } => (self.draws() << base.len()) as f64,
        }
    }

    /// A prime modulo which the joints have residues, and these; `None` when none was drawn.
    pub(super) fn drawn(&self, rng: &mut Rng) -> Option<(Field, EndResidues)> {
        (0..self.draws()).find_map(|_| {
            let field = Field::drawn(rng);
            Some((field, self.residues(field)?))
        })
    }

    fn residues(&self, field: Field) -> Option<EndResidues> {
        match self {
            Self::Dyadic(legs) => {
                let residue = |p: &nalgebra::Point3<f64>| [p.x, p.y, p.z].map(|x| field.scaled(x, 0));
                Some(legs.each_ref().map(|l| [residue(&l.base), residue(&l.platform)]))
            }
            Self::Algebraic { ends, base } => {
                let roots: Vec<(u64, u64)> =
                    base.iter().map(|b| Some((*b, field.sqrt(b % field.prime())?))).collect::<Option<_>>()?;
                let root = |radicand: u64| {
                    let factors = roots.iter().filter(|(b, _)| radicand.is_multiple_of(*b));
                    factors.fold(1, |product, (_, r)| field.mul(product, *r))
                };
                let mut out = [[[0; 3]; 2]; 6];
                for (x, residue) in ends.iter().flatten().flatten().zip(out.iter_mut().flatten().flatten()) {
                    *residue = x.residue(field, root)?;
                }
                Some(out)
            }
        }
    }

    /// Bits of the norm of a leg equation with integer coefficients, in every embedding of the field: numbers below `2^high` that are multiples of `2^low`, in products of two,
    /// times the square of a common denominator.
    pub(super) fn bits(&self, lengths: Lengths<'_>) -> f64 {
        let (mut high, mut low) = (1, 0);
        let mut take = |x: f64, halves: i32| {
            let (mantissa, exponent) = mantissa_and_exponent(x);
            if mantissa != 0 {
                let length = 64 - mantissa.unsigned_abs().leading_zeros().cast_signed();
                // a squared length counts as a product of two numbers
                high = high.max((exponent + length + halves - 1).div_euclid(halves));
                low = low.min(exponent.div_euclid(halves));
            }
        };
        match lengths {
            Lengths::Given(squares) => squares.iter().flatten().for_each(|x| take(*x, 2)),
            Lengths::Generic => take(2f64.powi(60), 2),
        }
        let (mut above, mut below) = (1, 0);
        match self {
            Self::Dyadic(legs) => {
                legs.iter()
                    .flat_map(|l| l.base.iter().chain(l.platform.iter()))
                    .for_each(|x| take(*x, 1));
            }
            Self::Algebraic { ends, .. } => {
                for leg in ends.iter() {
                    let coordinates = || leg.iter().flatten();
                    above = above.max(coordinates().map(Surd::magnitude_bits).max().unwrap_or(1));
                    below = below.max(Surd::common_denominator(coordinates()).bits().cast_signed());
                }
            }
        }
        // seventeen coefficients, of which the largest is a sum of six squares and two parts of a length
        2.0 * (i64::from(high).max(above) - i64::from(low) + below) as f64 + 6.0
    }
}
