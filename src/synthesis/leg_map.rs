//! Affine maps between the squared leg lengths of two platforms: `s(TO) = A s(FROM) + c`.

use std::array::from_fn;

use nalgebra::{Matrix6, Vector6};
use thiserror::Error;

use super::exact_leg_map::ExactFacts;
use super::{LegSpan, Normalisation};
use crate::manipulator::{Leg, LegIndex, Manipulator, SquaredLegLengths, inverse_condition};
use crate::num::double_double::DoubleDouble;
use crate::num::linalg::LinalgError;

/// The map `s' = A s + c` on squared leg lengths.
///
/// `A` has no unit, `c` is in squared design units. Leg maps are affine in squared lengths, never in lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AffineLegMap {
    /// `A`; row `i` belongs to leg `i` of the new platform, column `j` to leg `j` of the old one.
    pub a: Matrix6<f64>,
    /// `c`, squared design units.
    pub c: Vector6<f64>,
}

/// A squared length that no leg can have.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{leg} would need the squared length {value}: no pose of the platform has these leg lengths")]
pub struct NotRealizable {
    /// The leg of the new platform.
    pub leg: LegIndex,
    /// The value of `A s + c`, negative or not finite.
    pub value: f64,
}

/// A map that cannot be inverted to working precision.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the leg map is singular: the smallest singular value of A is {inverse_condition:e} of the largest, \
     the limit is {limit:e}"
)]
pub struct SingularMap {
    /// Smallest over largest singular value of `A`.
    pub inverse_condition: f64,
    /// What it had to exceed.
    pub limit: f64,
}

impl AffineLegMap {
    /// Below this `sigma_min / sigma_max` the inverse has no correct digit left worth returning.
    const INVERSE_LIMIT: f64 = 1e-13;

    /// The map of a platform to itself.
    #[must_use]
    pub fn identity() -> Self {
        Self { a: Matrix6::identity(), c: Vector6::zeros() }
    }

    /// `A s + c` for `A` and `c` as they are, in double-double; the radii hold those of `s` and the rounding of the sums.
    ///
    /// # Errors
    /// The first leg whose value is negative or not finite; nothing is clamped.
    pub fn apply(&self, s: &SquaredLegLengths) -> Result<SquaredLegLengths, NotRealizable> {
        let (middle, width) = (s.middle(), s.radius());
        let (mut image, mut radius) = ([DoubleDouble::ZERO; 6], [0.0; 6]);
        for leg in LegIndex::all() {
            let i = leg.get();
            let (mut sum, mut size) = (DoubleDouble::from(self.c[i]), self.c[i].abs());
            for j in 0..6 {
                sum = sum + DoubleDouble::from(self.a[(i, j)]) * middle[j];
                size += (self.a[(i, j)] * middle[j].hi()).abs();
                radius[i] += self.a[(i, j)].abs() * width[j];
            }
            // each term passes at most seven operations; the rest is for the rounding of the bound and for underflow
            radius[i] = radius[i] * (1.0 + 1e-12) + 8.0 * DoubleDouble::UNIT * size + f64::MIN_POSITIVE;
            let value = sum.hi();
            if !value.is_finite() || value < 0.0 || !radius[i].is_finite() {
                return Err(NotRealizable { leg, value });
            }
            image[i] = sum;
        }
        SquaredLegLengths::try_within(image, radius).map_err(|_| unreachable!("all six were checked"))
    }

    /// First `self`, then `next`: `s'' = A2 (A1 s + c1) + c2`.
    #[must_use]
    pub fn then(&self, next: &Self) -> Self {
        Self { a: next.a * self.a, c: next.a * self.c + next.c }
    }

    /// `det A`; zero for a map onto an architecturally singular platform.
    #[must_use]
    pub fn determinant(&self) -> f64 {
        self.a.determinant()
    }

    /// Smallest over largest singular value of `A`, in `[0, 1]`.
    #[must_use]
    pub fn inverse_condition(&self) -> f64 {
        inverse_condition(&self.a)
    }

    /// The map back: `s = A^-1 (s' - c)`.
    ///
    /// # Errors
    /// When `sigma_min / sigma_max` of `A` is below `1e-13`: then `A` cannot be told from a singular matrix.
    pub fn invert(&self) -> Result<Self, SingularMap> {
        let singular =
            SingularMap { inverse_condition: self.inverse_condition(), limit: Self::INVERSE_LIMIT };
        if singular.inverse_condition <= singular.limit {
            return Err(singular);
        }
        let a = self.a.try_inverse().ok_or(singular)?;
        Ok(Self { a, c: -(a * self.c) })
    }
}

/// What two platforms have to do with each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "files",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum Relation {
    /// `s(TO) = A s(FROM) + c` at every pose with `det A != 0`: same poses, same singularities.
    Equivalent,
    /// The relation holds, but not backwards: the legs of TO are dependent (`det A = 0`), or those of FROM
    /// are (`leg_rank < 6`) and `A` is not unique.
    Singular,
    /// Some leg of TO is not an affine function of the legs of FROM.
    Unrelated,
    /// The relation holds within the tolerance, and a singular design lies within what the tolerance and rounding leave open.
    Undecided,
}

impl Relation {
    /// The relation where it is decided.
    pub(crate) fn decided(self) -> Option<Self> {
        Some(self).filter(|r| *r != Self::Undecided)
    }

    /// `"equivalent"`, `"singular"`, `"unrelated"` or `"undecided"`.
    #[must_use]
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Equivalent => "equivalent",
            Self::Singular => "singular",
            Self::Unrelated => "unrelated",
            Self::Undecided => "undecided",
        }
    }
}

impl std::fmt::Display for Relation {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Dimensionless limits of [`leg_map`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegMapTolerances {
    /// A leg of TO farther than this from the span of FROM, relative to its vector, is not in it.
    pub residual: f64,
    /// Leg vectors with singular values below this times the largest are left to exact arithmetic.
    pub rank: f64,
    /// `A` with `sigma_min / sigma_max` below this is left to exact arithmetic.
    pub singular: f64,
}

impl Default for LegMapTolerances {
    /// `1e-9` for all three: a joint `1e-6` of the size off its line is seen, rounding of the data is not.
    fn default() -> Self {
        Self { residual: 1e-9, rank: 1e-9, singular: 1e-9 }
    }
}

/// The answer of [`leg_map`] with the numbers that decided it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LegMapOutcome {
    /// The verdict.
    pub relation: Relation,
    /// The least-squares map. It is *the* map unless `relation` is [`Relation::Unrelated`]; then only the
    /// rows with a small residual mean anything.
    pub closest: AffineLegMap,
    /// `det A`.
    pub determinant: f64,
    /// Relative distance of each leg vector of TO from the span of FROM, in `[0, 1]`.
    pub residuals: [f64; 6],
    /// The largest of `residuals`.
    pub residual: f64,
    /// Dimension of the span of the legs of FROM: exact where it is below 6.
    pub leg_rank: usize,
    /// Singular values of the normalised leg vectors of FROM, largest first.
    pub singular_values: [f64; 6],
    /// `sigma_min / sigma_max` of `A`.
    pub inverse_condition: f64,
    /// What `inverse_condition` had to exceed: the tolerance asked for, or the error to expect in `A` from rounding, the residual
    /// and the condition of FROM, whichever is larger; below the tolerance the error alone, where exact arithmetic found both platforms independent;
    /// 0 where the map is exact.
    pub singular_limit: f64,
    /// Whether the map is exact: every leg vector of TO lies in the span of those of FROM as rational numbers, not within a tolerance. Looked at
    /// only where doubles do not decide.
    pub exact: bool,
    /// The map in exact numbers, where the joints of both designs are known exactly and the identity of their leg vectors
    /// was checked in exact arithmetic; `None` where it was not looked at, and where it does not hold.
    pub exact_numbers: Option<ExactNumbers>,
    /// The tolerances asked for.
    pub tolerances: LegMapTolerances,
}

/// A leg map in exact numbers, each as an expression such as `64/243` or `1/2 + sqrt(3)/6`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExactNumbers {
    /// `A`, by rows.
    pub a: [[String; 6]; 6],
    /// `c`, units squared.
    pub c: [String; 6],
    /// `det A`.
    pub determinant: String,
    /// For each leg of TO whose row of `A` is `1 - t` and `t` beside zeros, the number `t` for which `det A` vanishes while the other legs stay; `None` for other rows, and where
    /// there is no such number. A leg end at the share `t` of an edge has such a row.
    pub singular_shares: [Option<String>; 6],
    /// `det A` as a polynomial in the shares `t1` to `t6` of all such rows at once, the others as they stand: its zeros are the singular shares. `None` where there is no such row.
    pub determinant_of_shares: Option<String>,
}

impl LegMapOutcome {
    /// The same with what the exact joints say, of which the doubles are rounded values.
    #[cfg(feature = "files")]
    #[must_use]
    pub(crate) fn decided_exactly(self, map: &super::exact_map::ExactMap) -> Self {
        let a = Matrix6::from_fn(|i, j| map.a[i][j].nearest());
        let c = Vector6::from_fn(|i, _| map.c[i].nearest());
        let relation = if map.determinant.is_zero() { Relation::Singular } else { Relation::Equivalent };
        Self {
            relation,
            closest: AffineLegMap { a, c },
            determinant: map.determinant.nearest(),
            residuals: [0.0; 6],
            residual: 0.0,
            leg_rank: 6,
            inverse_condition: inverse_condition(&a),
            singular_limit: 0.0,
            exact: true,
            exact_numbers: Some(ExactNumbers {
                a: from_fn(|i| from_fn(|j| map.a[i][j].to_string())),
                c: from_fn(|i| map.c[i].to_string()),
                determinant: map.determinant.to_string(),
                singular_shares: from_fn(|i| map.singular_share(i).map(|share| share.to_string())),
                determinant_of_shares: map.determinant_of_shares(),
            }),
            ..self
        }
    }

    /// One sentence: what was decided and by which number.
    #[must_use]
    pub fn explanation(&self) -> String {
        let (o, t) = (self, self.tolerances);
        match o.relation {
            Relation::Unrelated => {
                let legs: Vec<String> = o.legs_off().map(|i| i.to_string()).collect();
                format!(
                    "the squared length of {} of TO is no affine function of those of FROM: distance from the span \
                     {:.3e}, tolerance {:.0e}; A and c are the closest fit only",
                    legs.join(", "),
                    o.residual,
                    t.residual
                )
            }
            Relation::Singular if o.leg_rank < 6 => format!(
                "the leg vectors of FROM have rank {}: FROM is architecturally singular and the coefficients of the map \
                 are not unique; the shortest ones are given",
                o.leg_rank
            ),
            Relation::Singular => format!(
                "det A = 0: the leg vectors of TO are dependent as the numbers they are, without a tolerance; TO is architecturally singular \
                 (smallest singular value of A {:.3e} of the largest)",
                o.inverse_condition
            ),
            Relation::Undecided if o.singular_limit >= 1.0 => format!(
                "neither platform is architecturally singular as the numbers they are, but rounding and the residual {:.1e} decide nothing about det A:                  the joints are too far from the origin for their size, or the platforms of too different size",
                o.residual
            ),
            Relation::Undecided => format!(
                "neither platform is architecturally singular as the numbers they are, but the smallest singular value of A, {:.3e} of the largest, is not above \
                 the {:.1e} that rounding and the residual {:.1e} leave open",
                o.inverse_condition, o.singular_limit, o.residual
            ),
            Relation::Equivalent => match &o.exact_numbers {
                Some(numbers) => format!(
                    "proved: same poses for corresponding lengths, same singularities, since every leg vector of TO is a combination of those of FROM and \
                     det A = {} is not zero, both in exact arithmetic on the exact joints",
                    numbers.determinant
                ),
                None if o.exact => format!(
                    "same poses for corresponding lengths, same singularities: every leg vector of TO is a combination of those of FROM and both are \
                     independent, in exact arithmetic; smallest singular value of A {:.3e} of the largest",
                    o.inverse_condition
                ),
                None => format!(
                    "same poses for corresponding lengths, same singularities: residual {:.1e} (tolerance {:.0e}), smallest \
                     singular value of A {:.3e} of the largest (limit {:.1e})",
                    o.residual, t.residual, o.inverse_condition, o.singular_limit
                ),
            },
        }
    }

    /// The map, `None` for unrelated platforms.
    #[must_use]
    pub fn map(&self) -> Option<&AffineLegMap> {
        (self.relation != Relation::Unrelated).then_some(&self.closest)
    }

    /// Legs of TO that are not affine functions of the legs of FROM.
    pub fn legs_off(&self) -> impl Iterator<Item = LegIndex> + '_ {
        LegIndex::all().filter(|i| self.residuals[i.get()] > self.tolerances.residual)
    }
}

/// The affine map from the squared leg lengths of `from` to those of `to`, leg by leg in leg order.
///
/// Row `i` of `A` are the coefficients of `v(a'_i, b'_i)` in the leg vectors of `from`, and
///
/// ```text
/// c_i = |a'_i|^2 + |b'_i|^2 - sum_j A_ij (|a_j|^2 + |b_j|^2).
/// ```
///
/// Both platforms are described in the same two frames; the unit must be the same. Moving a frame or changing
/// the unit does not change `A` (see [`Normalisation`]). Since `sum_j A_ij = 1`, `sum_j A_ij a_j = a'_i` and
/// likewise for `b`, a shift by `u` changes `c_i` by `2 u (a'_i - sum A_ij a_j) + |u|^2 (1 - sum A_ij) = 0`,
/// so `c` is formed from the centred joints, where nothing large cancels.
///
/// Degenerate cases: dependent legs of `from` (`leg_rank < 6`) leave the coefficients undetermined; the
/// shortest ones are returned and the relation is `Singular` when all legs of `to` are in the span.
///
/// `Singular` is never said by a tolerance: the leg vectors of one of the two are dependent as the rational numbers that the coordinates are.
/// Between that and a regular map whose `sigma_min` exceeds the error to expect in `A` the answer is `Undecided`.
///
/// ```
/// use equipod::methods::manipulator::{Leg, Manipulator};
/// use equipod::methods::synthesis::{LegMapTolerances, Relation, leg_map};
/// use nalgebra::Point3;
/// let joint = |r: f64, k: u32| {
///     let (s, c) = (std::f64::consts::TAU * f64::from(k) / 3.0).sin_cos();
///     Point3::new(r * c, r * s, 0.0)
/// };
/// let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let mut legs = hexagon.map(|(i, j)| Leg { base: joint(2.0, i), platform: joint(1.0, j) });
/// let octahedral = Manipulator::from_legs(legs)?;
/// legs[0].base += (legs[1].base - legs[0].base) * 0.25; // slide along the edge to the next joint
/// let moved = Manipulator::from_legs(legs)?;
/// let outcome = leg_map(&octahedral, &moved, LegMapTolerances::default())?;
/// assert_eq!(outcome.relation, Relation::Equivalent);
/// assert!((outcome.determinant - 0.75).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// Source: Rojas, Borras, Thomas, *A distance-based formulation of the octahedral manipulator kinematics*, eq. (4)-(7), for
/// one offset; the general statement is derived in `docs/theory/leg-maps.md`.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn leg_map(
    from: &Manipulator,
    to: &Manipulator,
    tolerances: LegMapTolerances,
) -> Result<LegMapOutcome, LinalgError> {
    leg_map_to_legs(from, &to.legs(), tolerances)
}

/// As [`leg_map()`], for six legs of which two may be the same one, which no [`Manipulator`] has.
pub(super) fn leg_map_to_legs(
    from: &Manipulator,
    legs: &[Leg; 6],
    tolerances: LegMapTolerances,
) -> Result<LegMapOutcome, LinalgError> {
    let mut span = LegSpan::of(from, tolerances.rank)?;
    let facts = || ExactFacts::of(&from.legs(), legs);
    let mut exact = None;
    if span.rank() < 6 {
        exact = facts();
        if exact.as_ref().is_some_and(|e| e.from_rank == 6) {
            span = LegSpan::of(from, 0.0)?; // bodies of mixed scales: small singular values are no rounding
        }
    }
    let residuals = legs.map(|leg| span.distance(&leg));
    let residual = residuals.iter().copied().fold(0.0, f64::max);
    let rows = legs.map(|leg| span.coefficients(&leg));
    let a = Matrix6::from_fn(|i, j| rows[i][j]);
    let closest = AffineLegMap { a, c: constants(&span.normalisation(), &a, &from.legs(), legs) };
    let rounding = 64.0 * f64::EPSILON / span.inverse_condition();
    let error = rounding + residual / span.inverse_condition();
    let inverse_condition = closest.inverse_condition();
    let mut outcome = LegMapOutcome {
        relation: Relation::Equivalent,
        determinant: closest.determinant(),
        closest,
        residuals,
        residual,
        leg_rank: exact.as_ref().map_or(6, |e| e.from_rank),
        singular_values: span.singular_values(),
        inverse_condition,
        singular_limit: tolerances.singular.max(error),
        exact: false,
        exact_numbers: None,
        tolerances,
    };
    // the span itself is known to `rounding` only
    let off = residual.is_nan() || residual > tolerances.residual;
    if off && (exact.is_none() || outcome.leg_rank < 6 || residual > tolerances.residual + rounding) {
        outcome.relation = Relation::Unrelated;
        return Ok(outcome);
    }
    if exact.is_none() && inverse_condition > outcome.singular_limit {
        return Ok(outcome);
    }
    let Some(exact) = exact.or_else(facts) else {
        outcome.relation = Relation::Undecided;
        return Ok(outcome);
    };
    outcome.leg_rank = exact.from_rank;
    // dependent legs of TO that are off the span say nothing about FROM
    let holds = !off || exact.map.is_some();
    if holds && (exact.from_rank < 6 || exact.to_rank < 6) {
        outcome.relation = Relation::Singular;
    } else if let Some((a, c)) = exact.map {
        // independent vectors that are combinations of six independent ones: det A is not zero
        outcome.closest = AffineLegMap { a: Matrix6::from_fn(|i, j| a[i][j]), c: c.into() };
        outcome.determinant = outcome.closest.determinant();
        outcome.inverse_condition = outcome.closest.inverse_condition();
        (outcome.residuals, outcome.residual) = ([0.0; 6], 0.0);
        (outcome.singular_limit, outcome.exact) = (0.0, true);
    } else {
        outcome.singular_limit = error;
        if off || !(inverse_condition > error) {
            outcome.relation = Relation::Undecided;
        }
    }
    Ok(outcome)
}

/// `c` in squared design units from the centred joints.
fn constants(n: &Normalisation, a: &Matrix6<f64>, from: &[Leg; 6], to: &[Leg; 6]) -> Vector6<f64> {
    let squares = |leg: &Leg| {
        let x = n.apply(leg);
        (x.base.coords.norm_squared(), x.platform.coords.norm_squared())
    };
    let (old, new) = (from.map(|l| squares(&l)), to.map(|l| squares(&l)));
    Vector6::from_fn(|i, _| {
        let base: f64 = new[i].0 - (0..6).map(|j| a[(i, j)] * old[j].0).sum::<f64>();
        let platform: f64 = new[i].1 - (0..6).map(|j| a[(i, j)] * old[j].1).sum::<f64>();
        base * n.base_unit * n.base_unit + platform * n.platform_unit * n.platform_unit
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn negative_squares_are_refused_not_clamped() {
        let mut map = AffineLegMap::identity();
        map.c[3] = -5.0;
        let s = SquaredLegLengths::try_new([4.0; 6]).unwrap();
        let err = map.apply(&s).unwrap_err();
        assert_eq!((err.leg.get(), err.value), (3, -1.0));
        assert!(err.to_string().starts_with("leg 4 would need the squared length -1"));
        map.c[3] = f64::INFINITY;
        assert!(map.apply(&s).is_err());
    }

    #[test]
    fn singular_maps_have_no_inverse() {
        let mut map = AffineLegMap::identity();
        map.a[(5, 5)] = 1e-15;
        let err = map.invert().unwrap_err();
        assert!(err.inverse_condition < 1e-14);
        map.a[(5, 5)] = 0.25;
        map.c[5] = 3.0;
        let both = map.then(&map.invert().unwrap());
        assert_eq!(both, AffineLegMap::identity());
    }
}
