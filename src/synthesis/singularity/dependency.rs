//! Exact linear relations between the leg vectors `v = (1, a) (x) (1, b)`.

use num_traits::{Signed, Zero};

use num::algebraic::Algebraic;
use num::exact::{Rational, integer, primitive, relations};
use platform::manipulator::{Body, ExactLegs, SquaredLegLengths};

/// A minimal set of legs with dependent vectors: `sum c_i v_i = 0`, and no proper subset is dependent.
///
/// It forces `sum c_i s_i = constant` on the squared leg lengths of every pose: other lengths cannot be assembled.
#[derive(Debug, Clone, PartialEq)]
pub struct Dependency {
    /// The legs, 0-based, ascending.
    pub legs: Vec<usize>,
    /// `c_1 .. c_6`, zero for legs outside the set. They are small integers if possible, otherwise scaled to a largest
    /// modulus of 1.
    pub coefficients: [f64; 6],
    /// `sum c_i (|a_i|^2 + |b_i|^2)`, design units squared, computed exactly and rounded once.
    pub constant: f64,
    /// Dimension (0 to 3) of the smallest point, line, plane or space with the base ends.
    pub base_dimension: usize,
    /// The same for the platform ends.
    pub platform_dimension: usize,
}

impl Dependency {
    /// Violation of the condition by squared lengths: `sum c_i s_i - constant`, over the sum of the moduli of its
    /// terms.
    #[must_use]
    pub fn defect(&self, s: &SquaredLegLengths) -> f64 {
        let terms = self.coefficients.iter().zip(s.get()).map(|(c, s)| c * s);
        let (sum, moduli) = terms.fold((0.0, self.constant.abs()), |(x, y), t| (x + t, y + f64::abs(t)));
        (sum - self.constant) / moduli
    }
}

/// All minimal dependent sets, fewest legs first.
pub(super) fn dependencies(six: &ExactLegs) -> Vec<Dependency> {
    let mut found: Vec<Dependency> = Vec::new();
    for legs in subsets_by_size(2) {
        if found.iter().any(|d| d.legs.iter().all(|i| legs.contains(i))) {
            continue;
        }
        // no proper subset is dependent, so there is at most one relation
        if let Some(c) = relations(&six.vectors_of(&legs)).first() {
            found.push(dependency(six, &legs, c));
        }
    }
    found
}

fn dependency(six: &ExactLegs, legs: &[usize], c: &[Algebraic]) -> Dependency {
    let fractions: Option<Vec<Rational>> = c.iter().map(|x| x.as_rational().cloned()).collect();
    let c = match fractions {
        Some(fractions) => scaled(&fractions).into_iter().map(Algebraic::Rational).collect(),
        None => scaled_to_one(c),
    };
    let mut coefficients = [0.0; 6];
    let mut constant = Algebraic::integer(0);
    for (i, c) in legs.iter().zip(&c) {
        coefficients[*i] = c.approximate();
        constant = &constant + &(c * &six.squares(*i));
    }
    Dependency {
        legs: legs.to_vec(),
        coefficients,
        constant: constant.approximate(),
        base_dimension: six.dimension(Body::Base, legs),
        platform_dimension: six.dimension(Body::Platform, legs),
    }
}

/// Subsets of the six legs with at least `least` members, small ones first, then in lexicographic order.
pub(super) fn subsets_by_size(least: usize) -> Vec<Vec<usize>> {
    let mut all: Vec<Vec<usize>> =
        (1u8..64).map(|mask| (0..6).filter(|i| mask >> i & 1 == 1).collect()).collect();
    all.retain(|s: &Vec<usize>| s.len() >= least);
    all.sort_by(|x, y| x.len().cmp(&y.len()).then_with(|| x.cmp(y)));
    all
}

/// The multiple of `c` with a largest modulus of 1 and a positive first nonzero entry.
fn scaled_to_one(c: &[Algebraic]) -> Vec<Algebraic> {
    let largest = c.iter().map(|x| x.approximate().abs()).enumerate().max_by(|x, y| x.1.total_cmp(&y.1));
    let Some(most) = largest.map(|(k, _)| &c[k]).filter(|x| !x.is_zero()) else { return c.to_vec() };
    let ratios: Vec<Algebraic> = c.iter().map(|x| x / most).collect();
    let negative = ratios.iter().find(|x| !x.is_zero()).is_some_and(|x| x.approximate() < 0.0);
    if negative { ratios.iter().map(|x| -x).collect() } else { ratios }
}

/// A multiple of `c` with a positive first nonzero entry: integers below a million without a common factor, the least
/// at most 60, or a largest modulus of 1.
fn scaled(c: &[Rational]) -> Vec<Rational> {
    let whole = primitive(c);
    let moduli = || whole.iter().filter(|x| !x.is_zero()).map(Signed::abs);
    let (Some(least), Some(most)) = (moduli().min(), moduli().max()) else { return whole };
    // the usual small relations have a small entry
    if least <= integer(60) && most < integer(1_000_000) {
        return whole;
    }
    whole.iter().map(|x| x / &most).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::{Leg, Manipulator};

    fn legs(list: &[([f64; 3], [f64; 3]); 6]) -> Manipulator {
        let leg = |(a, b): &([f64; 3], [f64; 3])| Leg { base: Point3::from(*a), platform: Point3::from(*b) };
        Manipulator::from_legs(list.each_ref().map(leg)).unwrap()
    }

    #[test]
    fn three_legs_on_a_line_of_legs_are_one_dependency_with_its_condition() {
        let p = [0.5, 0.25, 1.0];
        let m = legs(&[
            ([0.0, 0.0, 0.0], p),
            ([4.0, 0.0, 0.0], p),
            ([1.0, 0.0, 0.0], p),
            ([0.0, 3.0, 1.0], [1.0, 2.0, 0.0]),
            ([2.0, 3.0, 0.0], [-1.0, 2.0, 0.5]),
            ([0.0, -3.0, 2.0], [1.0, -2.0, 0.0]),
        ]);
        let found = dependencies(&ExactLegs::of(&m).unwrap());
        assert_eq!(found.len(), 1);
        let d = &found[0];
        assert_eq!((d.legs.as_slice(), d.base_dimension, d.platform_dimension), (&[0, 1, 2][..], 1, 0));
        assert!(
            d.coefficients.iter().zip([3.0, 1.0, -4.0, 0.0, 0.0, 0.0]).all(|(x, y)| (x - y).abs() <= 0.0)
        );
        // Stewart's theorem: 3 s_1 + s_2 - 4 s_3 = 12 for the feet 0, 4 and 1 of a triangle
        assert!((d.constant - 12.0).abs() <= 0.0, "{}", d.constant);
    }

    #[test]
    fn subsets_are_in_order_and_complete() {
        let all = subsets_by_size(2);
        assert_eq!((all.len(), all[0].as_slice(), all[56].len()), (57, &[0, 1][..], 6));
        assert!(all.windows(2).all(|w| w[0].len() <= w[1].len()));
    }
}
