//! The joints of a design modulo a prime: doubles as the dyadic numbers they are, exact joints as the algebraic numbers
//! they are.
//!
//! Coordinates that are sums of square roots and cosines have residues modulo primes for which these exist
//! ([`SplitField`]); primes are drawn until there is one.

use super::{CountUndecided, Lengths};
use num::modular::{Field, mantissa_and_exponent};
use num::split::SplitField;
use num::surd::Surd;
use num::{Purpose, Rng};
use num_bigint::BigInt;
use num_integer::Integer as _;
use platform::manipulator::{ExactEnds, JointKnowledge, Leg, Manipulator};
use sha2::{Digest, Sha256};

/// The ends of the legs modulo a prime, on base and platform.
pub(super) type EndResidues = [[[u64; 3]; 2]; 6];

/// A drawn prime, and the joints modulo it.
pub(super) struct DrawnPrime {
    pub(super) field: Field,
    pub(super) ends: EndResidues,
    /// [`SplitField::chances`].
    pub(super) chances: f64,
}

/// Joints known exactly.
pub(super) enum CountedJoints {
    /// The joints as the doubles they are.
    Dyadic(Box<[Leg; 6]>),
    /// The joints as sums of square roots and cosines.
    Algebraic(Box<[ExactEnds; 6]>),
}

impl CountedJoints {
    pub(super) fn of(m: &Manipulator) -> Result<Self, CountUndecided> {
        if m.joint_knowledge() == JointKnowledge::Doubles {
            return Ok(Self::Dyadic(Box::new(m.legs())));
        }
        m.exact_ends().map(|ends| Self::Algebraic(Box::new(ends))).ok_or(CountUndecided::JointsNotExact)
    }

    /// The generator of the primes and sections for these joints and lengths.
    ///
    /// The primes follow from a hash of the design and its lengths. So no two problems share their primes at one seed,
    /// and no design can be made from the primes by which it is counted.
    pub(super) fn rng(&self, lengths: Lengths<'_>, seed: u64) -> Rng {
        let mut hash = Sha256::new();
        hash.update(seed.to_le_bytes());
        let mut doubles = |list: &[f64]| list.iter().for_each(|x| hash.update(x.to_bits().to_le_bytes()));
        match lengths {
            Lengths::Given(squares) => doubles(squares.as_flattened()),
            Lengths::Generic => doubles(&[]),
        }
        match self {
            Self::Dyadic(legs) => {
                legs.iter().for_each(|l| {
                    doubles(&[l.base.coords.as_slice(), l.platform.coords.as_slice()].concat());
                });
            }
            Self::Algebraic(ends) => {
                ends.iter().flatten().flatten().for_each(|x| hash.update(format!("{x};")));
            }
        }
        let digest: [u8; 32] = hash.finalize().into();
        let first = digest.iter().take(8).fold(0, |word, byte| word << 8 | u64::from(*byte));
        Purpose::POSE_COUNT.rng(first)
    }

    /// A prime modulo which the joints have residues, and these; `None` when none was drawn.
    pub(super) fn drawn(&self, rng: &mut Rng) -> Option<DrawnPrime> {
        match self {
            Self::Dyadic(legs) => {
                let field = Field::drawn(rng);
                let residues = |p: &nalgebra::Point3<f64>| [p.x, p.y, p.z].map(|x| field.scaled(x, 0));
                let ends = legs.each_ref().map(|l| [residues(&l.base), residues(&l.platform)]);
                Some(DrawnPrime { field, ends, chances: 1.0 })
            }
            Self::Algebraic(ends) => {
                let split = SplitField::drawn(rng, ends.iter().flatten().flatten())?;
                let mut residues = [[[0; 3]; 2]; 6];
                let places = residues.iter_mut().flatten().flatten();
                for (x, residue) in ends.iter().flatten().flatten().zip(places) {
                    *residue = split.residue(x)?;
                }
                Some(DrawnPrime { field: split.field(), ends: residues, chances: split.chances() })
            }
        }
    }

    /// Bits of the norm of a leg equation with integer coefficients, in every embedding of the field. The numbers are
    /// multiples of `2^low` below `2^high`, in products of two, times the square of a common denominator.
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
                legs.iter().flat_map(|l| l.base.iter().chain(l.platform.iter())).for_each(|x| take(*x, 1));
            }
            Self::Algebraic(ends) => {
                for leg in ends.iter() {
                    let coordinates = || leg.iter().flatten();
                    above = above.max(coordinates().map(Surd::magnitude_bits).max().unwrap_or(1));
                    let one = BigInt::from(1);
                    let common = coordinates().fold(one, |l, x| l.lcm(x.denominator()));
                    below = below.max(common.bits().cast_signed());
                }
            }
        }
        // seventeen coefficients, of which the largest is a sum of six squares and two parts of a length
        2.0 * (i64::from(high).max(above) - i64::from(low) + below) as f64 + 6.0
    }
}
