//! Affine maps between the squared leg lengths of two platforms: `s(TO) = A s(FROM) + c`.

use std::array::from_fn;

use nalgebra::{Matrix6, Vector6};
use thiserror::Error;

use super::exact_map::{ExactMap, ExactRelation};
use super::singularity::Architecture;
use super::{LegSpan, Normalisation};
use num::double_double::DoubleDouble;
use num::linalg::LinalgError;
use num::shown::rounded;
use platform::manipulator::{
    ExactLegs, Leg, LegIndex, Level, Manipulator, SquaredLegLengths, inverse_condition,
};

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
    /// The required minimum.
    pub limit: f64,
}

impl AffineLegMap {
    /// Below this `sigma_min / sigma_max` the inverse has no correct digits.
    const INVERSE_LIMIT: f64 = 1e-13;

    /// The map of a platform to itself.
    #[must_use]
    pub fn identity() -> Self {
        Self { a: Matrix6::identity(), c: Vector6::zeros() }
    }

    /// `A s + c` for the stored `A` and `c`, in double-double; the radii include those of `s` and the rounding of the
    /// sums.
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
    /// `sigma_min / sigma_max` of `A` is below `1e-13`: then `A` is indistinguishable from a singular matrix.
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

num::answer_words! {
    /// The relation of two platforms.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum Relation as name, Display {
        /// `s(TO) = A s(FROM) + c` at every pose with `det A != 0`: equal poses, equal singularities.
        Equivalent = "equivalent",
        /// The legs of FROM or of TO are dependent: one of the two is architecturally singular.
        Singular = "singular",
        /// Some leg of TO is not an affine function of the legs of FROM.
        Unrelated = "unrelated",
        /// Undecided: the relation holds only within rounding, or a singular design is within rounding.
        Undecided = "undecided",
    }
}

impl Relation {
    /// The relation if it is decided.
    pub fn decided(self) -> Option<Self> {
        Some(self).filter(|r| *r != Self::Undecided)
    }
}

/// Dimensionless limits of [`leg_map`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegMapTolerances {
    /// A leg of TO farther than this from the span of FROM, relative to its vector, is not in it. It applies only to
    /// joints that are not known exactly.
    pub residual: f64,
    /// Leg vectors with singular values below this times the largest are left out of the span, unless exact arithmetic
    /// proves them independent.
    pub rank: f64,
    /// `A` with `sigma_min / sigma_max` below this is indistinguishable from a singular matrix. It applies only to
    /// joints that are not known exactly.
    pub singular: f64,
}

impl Default for LegMapTolerances {
    /// `1e-9` for all three: it detects a joint `1e-6` of the size off its line, but no rounding of the data.
    fn default() -> Self {
        Self { residual: 1e-9, rank: 1e-9, singular: 1e-9 }
    }
}

/// The answer of [`leg_map`] with the deciding numbers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LegMapOutcome {
    /// The verdict: decided in exact arithmetic if the joints of both are known exactly, never by a tolerance.
    pub relation: Relation,
    /// The level of the proof; [`Level::WithinRounding`] without a proof.
    pub level: Level,
    /// Whether the relation holds within rounding of the joints, which may be rounded values of equivalent platforms.
    /// It is also true if the relation holds exactly.
    pub holds_within_rounding: bool,
    /// The least-squares map. It is *the* map unless `relation` is [`Relation::Unrelated`]; then only the rows with a
    /// small residual are valid.
    pub closest: AffineLegMap,
    /// `det A`.
    pub determinant: f64,
    /// Relative distance of each leg vector of TO from the span of FROM, in `[0, 1]`.
    pub residuals: [f64; 6],
    /// The largest of `residuals`.
    pub residual: f64,
    /// Dimension of the span of the legs of FROM: exact if below 6.
    pub leg_rank: usize,
    /// Singular values of the normalised leg vectors of FROM, largest first.
    pub singular_values: [f64; 6],
    /// `sigma_min / sigma_max` of `A`.
    pub inverse_condition: f64,
    /// Required minimum of `inverse_condition`. It is the larger of the tolerance and the expected error of `A` from
    /// rounding, the residual and the condition of FROM. Below the tolerance it is that error alone if exact arithmetic
    /// proves both platforms independent; it is 0 for an exact map.
    pub singular_limit: f64,
    /// Whether the map is exact: every leg vector of TO is exactly in the span of those of FROM.
    pub exact: bool,
    /// The map in exact numbers if it is exact and the numbers are short enough to read; otherwise `None`.
    pub exact_numbers: Option<ExactNumbers>,
    /// Whether the leg vectors of both are independent; unknown for joints known only between bounds.
    leg_vectors_independent: bool,
    /// Distance of a singular platform from one of the two, design units, if it is within rounding.
    pub near_singular: Option<f64>,
    /// The decisions whether FROM and TO are architecturally singular. `None` if they were not asked for, as for
    /// dependent leg vectors, which decide alone.
    pub architectures: Option<Box<[Architecture; 2]>>,
    /// Legs of TO that are not in the span of FROM.
    off: [bool; 6],
    /// The tolerances used.
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
    /// For each leg of TO with only `1 - t` and `t` in its row of `A`, the `t` at which `det A` vanishes. `None` for
    /// other rows, and if no such number exists. A leg end at the share `t` of an edge has such a row.
    pub singular_offsets: [Option<String>; 6],
    /// `det A` as a polynomial in the shares `t1` to `t6` of all such rows, with the other rows constant. Its zeros are
    /// the singular shares. `None` without such rows.
    pub determinant_of_offsets: Option<String>,
}

impl LegMapOutcome {
    /// Whether the map and its inverse are usable: the platforms are equivalent, by proof or within rounding.
    #[must_use]
    pub fn is_regular_within_rounding(&self) -> bool {
        match self.relation {
            Relation::Equivalent => true,
            Relation::Undecided => {
                self.holds_within_rounding
                    && self.near_singular.is_none()
                    && self.inverse_condition > self.singular_limit
            }
            Relation::Singular | Relation::Unrelated => false,
        }
    }

    /// The outcome if the leg lines of one of the two are dependent at every pose, proved at `level`.
    pub fn with_dependent_lines(mut self, level: Level) -> Self {
        (self.relation, self.level) = (Relation::Singular, level);
        self
    }

    /// The outcome if a singular platform is within rounding of one of the two, at this distance.
    pub fn near_singular(mut self, distance: f64) -> Self {
        (self.relation, self.level) = (Relation::Undecided, Level::WithinRounding);
        self.near_singular = Some(distance);
        self
    }

    /// The outcome for a TO moved by numbers that are known only to the tolerance, so that its joints as written are
    /// not exact. `dependent` if the legs of one of the two are dependent, which no motion changes.
    pub(super) fn of_moved(mut self, dependent: bool) -> Self {
        self.holds_within_rounding = self.residual <= self.tolerances.residual;
        if dependent && self.holds_within_rounding {
            self.relation = Relation::Singular;
        } else if self.holds_within_rounding {
            (self.relation, self.level) = (Relation::Undecided, Level::WithinRounding);
            self.off = [false; 6];
            self.exact_numbers = None;
        }
        self
    }

    /// Takes over the result of exact arithmetic on the joints, proved at `level`.
    fn decided(&mut self, relation: &ExactRelation, level: Level) {
        self.level = level;
        self.leg_vectors_independent = !matches!(relation, ExactRelation::Singular { .. });
        self.relation = match relation {
            ExactRelation::Equivalent(_) => Relation::Equivalent,
            ExactRelation::Singular { .. } => Relation::Singular,
            ExactRelation::Unrelated(_) => Relation::Unrelated,
        };
        if let ExactRelation::Singular { ranks, .. } = relation {
            self.leg_rank = ranks[0];
        }
        let Some(map) = relation.map() else { return };
        let a = Matrix6::from_fn(|i, j| map.a[i][j].approximate());
        self.closest = AffineLegMap { a, c: Vector6::from_fn(|i, _| map.c[i].approximate()) };
        self.determinant = map.determinant.approximate();
        self.inverse_condition = inverse_condition(&a);
        (self.residuals, self.residual) = ([0.0; 6], 0.0);
        (self.singular_limit, self.exact, self.holds_within_rounding) = (0.0, true, true);
        let readable = if level == Level::ExactJoints { LONG } else { SHORT };
        self.exact_numbers = (map.bits() <= readable).then(|| ExactNumbers::of(map));
    }

    /// The decision and the deciding number: sentences that can follow a colon, without the last full stop.
    #[must_use]
    pub fn explanation(&self) -> String {
        let (o, t) = (self, self.tolerances);
        let level = o.level.words();
        if let (Relation::Undecided, Some(distance)) = (o.relation, o.near_singular) {
            return format!(
                "within rounding, not proved: one of the two is regular as written, but a singular platform is only {distance:.1e} units of length away"
            );
        }
        match o.relation {
            Relation::Unrelated => {
                let legs: Vec<String> = o.legs_off().map(|i| (i.get() + 1).to_string()).collect();
                let subject = match legs.as_slice() {
                    [one] => format!("the squared length of leg {one} of TO is not an affine function"),
                    _ => format!(
                        "the squared lengths of legs {} of TO are not affine functions",
                        legs.join(", ")
                    ),
                };
                let by = if o.level.is_proved() {
                    format!("proved {level}")
                } else {
                    format!("tolerance {:.0e}: the joints are known between bounds only", t.residual)
                };
                format!(
                    "{subject} of the squared lengths of FROM ({by}). Their distance from the span is {} of the size. A and c are only the closest fit",
                    rounded(o.residual, 3),
                )
            }
            Relation::Singular if o.leg_rank < 6 => format!(
                "FROM is architecturally singular: its leg vectors have rank {}, proved {level}. The coefficients of the map are not unique",
                o.leg_rank
            ),
            Relation::Singular if o.leg_vectors_independent => format!(
                "one of the two is architecturally singular: its leg lines are dependent at every pose, proved {level}, although its leg vectors are independent"
            ),
            Relation::Singular => format!(
                "the leg vectors of TO are dependent, proved {level}{}: TO is architecturally singular",
                if o.exact { ", det A = 0" } else { "" }
            ),
            Relation::Undecided if o.singular_limit >= 1.0 => format!(
                "as written, neither platform is architecturally singular, but rounding and the residual {:.1e} leave det A undecided. The joints are too far from the origin for their size, or the sizes of the platforms differ too much",
                o.residual
            ),
            Relation::Undecided => format!(
                "within rounding, not proved: the nearest map misses the legs of TO by {:.1e} of the size, and rounding of the joints explains that much{}",
                o.residual,
                if o.inverse_condition > o.singular_limit {
                    String::new()
                } else {
                    format!(
                        ". A singular A is within rounding too: its smallest singular value is {:.1e} of the largest",
                        o.inverse_condition
                    )
                }
            ),
            Relation::Equivalent => format!(
                "proved {level}: corresponding lengths have the same poses, and the singular poses are the same. Every leg vector of TO is a linear combination \
                 of those of FROM, and det A{} is not zero",
                o.exact_numbers
                    .as_ref()
                    .filter(|numbers| numbers.determinant.len() <= WRITTEN)
                    .map_or_else(String::new, |numbers| format!(" = {}", numbers.determinant))
            ),
        }
    }

    /// The map, `None` for unrelated platforms.
    #[must_use]
    pub fn map(&self) -> Option<&AffineLegMap> {
        (self.relation != Relation::Unrelated).then_some(&self.closest)
    }

    /// Legs of TO that are not affine functions of the legs of FROM.
    pub fn legs_off(&self) -> impl Iterator<Item = LegIndex> + '_ {
        LegIndex::all().filter(|i| self.off[i.get()])
    }
}

impl ExactNumbers {
    fn of(map: &ExactMap) -> Self {
        Self {
            a: from_fn(|i| from_fn(|j| map.a[i][j].to_string())),
            c: from_fn(|i| map.c[i].to_string()),
            determinant: map.determinant.to_string(),
            singular_offsets: from_fn(|i| map.singular_share(i).map(|share| share.to_string())),
            determinant_of_offsets: map.determinant_of_offsets(),
        }
    }
}

/// Greatest length of an exact number in a sentence, characters.
const WRITTEN: usize = 24;

/// Greatest number of bits of printed exact numbers.
const LONG: u64 = 2048;
/// The same limit for doubles, whose fractions are unnecessarily long.
const SHORT: u64 = 256;
/// Coordinates count as rounded by this share of the largest coordinate of their body: eight half units in its last
/// place.
const ROUNDING: f64 = 1.0 / (1u64 << 50) as f64;

/// The affine map from the squared leg lengths of `from` to those of `to`, leg by leg in leg order.
///
/// Row `i` of `A` holds the coefficients of `v(a'_i, b'_i)` in the leg vectors of `from`, and
///
/// ```text
/// c_i = |a'_i|^2 + |b'_i|^2 - sum_j A_ij (|a_j|^2 + |b_j|^2).
/// ```
///
/// Both platforms are described in the same two frames; the unit must be the same. Moving a frame or changing the unit
/// does not change `A` (see [`Normalisation`]). Since `sum_j A_ij = 1` and `sum_j A_ij a_j = a'_i` (and the same for
/// `b`), a shift by `u` changes `c_i` by `2 u (a'_i - sum A_ij a_j) + |u|^2 (1 - sum A_ij) = 0`. So `c` is computed
/// from the centred joints, without cancellation of large numbers.
///
/// The relation is decided in exact arithmetic on the joints as given. They are numbers of a field of square roots for
/// designs with constructions, otherwise doubles as rational numbers. Platforms that differ from equivalent ones by no
/// more than rounding of their doubles are [`Relation::Undecided`]. Tolerances decide only for joints known between
/// bounds, and never for a relation.
///
/// ```
/// # mod equipod { pub mod methods { pub use equipod_synthesis as synthesis; pub use platform::manipulator; } }
/// use equipod::methods::manipulator::{Leg, Manipulator};
/// use equipod::methods::synthesis::{LegMapTolerances, Relation, leg_map};
/// use nalgebra::Point3;
/// let joint = |r: f64, k: usize| Point3::new([2.0, -1.0, -1.0][k] * r, [0.0, 1.5, -1.5][k] * r, 0.0);
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
/// Source: Rojas, Borras, Thomas, *A distance-based formulation of the octahedral manipulator kinematics*, eq. (4)-(7),
/// for one offset; the general statement is derived in `docs/theory/leg-maps.md`.
///
/// # Errors
/// When a singular value decomposition does not converge.
pub fn leg_map(
    from: &Manipulator,
    to: &Manipulator,
    tolerances: LegMapTolerances,
) -> Result<LegMapOutcome, LinalgError> {
    related(from, &to.legs(), ExactLegs::of(to).as_ref(), to.level(), tolerances)
}

/// [`leg_map()`] for six legs computed from those of `from`, so that they are known only to the tolerance. Two of them
/// may coincide, which a [`Manipulator`] does not allow.
pub(super) fn leg_map_to_legs(
    from: &Manipulator,
    legs: &[Leg; 6],
    tolerances: LegMapTolerances,
) -> Result<LegMapOutcome, LinalgError> {
    let found =
        related(from, legs, ExactLegs::of_doubles(legs).as_ref(), Level::DoublesAsWritten, tolerances)?;
    Ok(if found.relation == Relation::Unrelated { found.of_moved(false) } else { found })
}

fn related(
    from: &Manipulator,
    legs: &[Leg; 6],
    exact: Option<&ExactLegs>,
    level: Level,
    tolerances: LegMapTolerances,
) -> Result<LegMapOutcome, LinalgError> {
    let relation = ExactLegs::of(from).zip(exact).map(|(from, to)| ExactRelation::of(&from, to));
    let mut span = LegSpan::of(from, tolerances.rank)?;
    let independent = !matches!(relation, None | Some(ExactRelation::Singular { ranks: [..6, _], .. }));
    if span.rank() < 6 && independent {
        span = LegSpan::of(from, 0.0)?; // bodies of mixed scales: small singular values are not rounding
    }
    let residuals = legs.map(|leg| span.distance(&leg));
    let residual = residuals.iter().copied().fold(0.0, f64::max);
    let rows = legs.map(|leg| span.coefficients(&leg));
    let a = Matrix6::from_fn(|i, j| rows[i][j]);
    let closest = AffineLegMap { a, c: constants(&span.normalisation(), &a, &from.legs(), legs) };
    let error = (64.0 * f64::EPSILON + residual) / span.inverse_condition();
    let inverse_condition = closest.inverse_condition();
    let mut outcome = LegMapOutcome {
        relation: Relation::Undecided,
        level: Level::WithinRounding,
        holds_within_rounding: false,
        determinant: closest.determinant(),
        closest,
        residuals,
        residual,
        leg_rank: span.rank(),
        singular_values: span.singular_values(),
        inverse_condition,
        singular_limit: tolerances.singular.max(error),
        exact: false,
        exact_numbers: None,
        leg_vectors_independent: false,
        near_singular: None,
        architectures: None,
        off: residuals.map(|r| r.is_nan() || r > tolerances.residual),
        tolerances,
    };
    let Some(relation) = relation else {
        let off = outcome.off.contains(&true);
        outcome.holds_within_rounding = !off;
        // rounding effects grow with the inaccuracy of the span
        if off && residual > tolerances.residual + 64.0 * f64::EPSILON / span.inverse_condition() {
            outcome.relation = Relation::Unrelated;
        }
        return Ok(outcome);
    };
    let level = level.min(from.level());
    outcome.leg_rank = 6;
    // for dependent legs the map itself means little, but its existence is known within the tolerance
    outcome.holds_within_rounding =
        matches!(relation, ExactRelation::Singular { .. }) && residual <= tolerances.residual;
    outcome.decided(&relation, level);
    if let ExactRelation::Unrelated(legs_off) = &relation {
        let limits = rounding_of_residuals(from, legs, &outcome.closest.a, &span.normalisation());
        // joints given as plain numbers are also rounded: name only the legs that are off by more
        let exact = level == Level::ExactJoints;
        outcome.off = from_fn(|i| legs_off.contains(&i) && (exact || !(residuals[i] <= limits[i])));
        if !outcome.off.contains(&true) {
            // rounded values of equivalent platforms look like this
            (outcome.relation, outcome.level) = (Relation::Undecided, Level::WithinRounding);
            outcome.holds_within_rounding = true;
        }
    }
    Ok(outcome)
}

/// Greatest distance, relative to its vector, of a leg of TO from the span of FROM by rounding of all coordinates. The
/// leg must be a combination of legs of FROM. Coordinates off by `d`, in normalised units, move every leg vector by at
/// most `4 d` of itself, and a combination by as much per term.
fn rounding_of_residuals(from: &Manipulator, to: &[Leg; 6], a: &Matrix6<f64>, n: &Normalisation) -> [f64; 6] {
    let legs = from.legs();
    let all = || legs.iter().chain(to);
    let base = all().map(|leg| leg.base.coords.amax()).fold(0.0, f64::max) / n.base_unit;
    let platform = all().map(|leg| leg.platform.coords.amax()).fold(0.0, f64::max) / n.platform_unit;
    let offset = 4.0 * ROUNDING * (base + platform);
    from_fn(|i| offset * (1.0 + a.row(i).iter().map(|x| x.abs()).sum::<f64>()))
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
