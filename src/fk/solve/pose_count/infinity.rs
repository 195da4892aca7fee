//! Points at infinity that all legs have in common.

use super::joints::EndResidues;
use super::quadrics::{Cut, H, Linear, cut};
use super::quotient::{QuotientOutcome, close};
use super::{DEGREE, leg_equation};
use num::Rng;
use num::modular::Field;

/// Whether they are seen to be finitely many, whatever the lengths.
///
/// With `h = 0` the quadrics and leg equations are homogeneous and contain no lengths. A curve of points meets every
/// hyperplane. So there is no curve if any homogeneous linear equation leaves only the zero solution, an algebra of
/// finite dimension. The dimension of a projective scheme does not fall modulo a prime. So finitely many points modulo
/// a prime are finitely many for the joints as they are.
pub(crate) fn are_points_at_infinity_finite(field: Field, ends: &EndResidues, rng: &mut Rng) -> bool {
    let hyperplane = std::array::from_fn(|k| if k < H { rng.next_u64() >> 4 } else { 0 });
    are_finite_by(field, ends, hyperplane)
}

/// Whether this linear equation, which has no constant, shows it.
fn are_finite_by(field: Field, ends: &EndResidues, hyperplane: Linear) -> bool {
    let mut equations: Vec<Linear> = ends.iter().map(|end| leg_equation(field, end, 0)).collect();
    equations.push(std::array::from_fn(|k| u64::from(k == H)));
    equations.push(hyperplane);
    match cut(field, &equations) {
        // homogeneous equations have the solution zero
        Cut::Empty => false,
        Cut::Quadrics { unknowns, polynomials } => {
            matches!(close(field, unknowns, polynomials, DEGREE), QuotientOutcome::Closed { .. })
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The octahedral platform has isolated points at infinity; four joints at one place of the base and two at
    /// another leave curves of them.
    #[test]
    fn no_hyperplane_hides_a_curve_of_points_at_infinity() {
        let field = Field::MERSENNE;
        let mut rng = Rng::new(3);
        let point = |x: u64, y: u64| [x, y, 0];
        let (base, platform) =
            ([point(0, 0), point(6, 10), point(12, 0)], [point(0, 0), point(6, 0), point(3, 5)]);
        let octahedral: EndResidues = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]
            .map(|(i, j): (usize, usize)| [base[i], platform[j]]);
        assert!(are_points_at_infinity_finite(field, &octahedral, &mut rng));
        let doubled: EndResidues = std::array::from_fn(|i| {
            [
                if i < 4 { base[0] } else { base[1] },
                [rng.next_u64() >> 8, rng.next_u64() >> 8, rng.next_u64() >> 8],
            ]
        });
        assert!(!are_points_at_infinity_finite(field, &doubled, &mut rng));
        // hyperplanes that contain whole curves: those that would leave nothing if they had a constant
        for k in 0..H {
            let coordinate = std::array::from_fn(|l| u64::from(l == k));
            assert!(!are_finite_by(field, &doubled, coordinate), "{k}");
        }
    }
}
