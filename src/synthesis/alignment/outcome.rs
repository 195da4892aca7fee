//! Answers of [`align`](super::align), and the reasons for them.

use nalgebra::{Rotation3, Vector3};

use super::leg_space::Canonical;
use super::{CLEAR, RoundingBounds, SAME};
use crate::leg_map::LegMapOutcome;
use platform::geom::{Pose, rotation_vector};

/// A pair of rigid motions that makes B equivalent to A.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// `x -> R x + p` for base joints of B, to the base frame of A.
    pub base: Pose,
    /// The same motion for platform joints, to the platform frame of A.
    pub platform: Pose,
    /// The leg map from A to the moved B.
    pub map: LegMapOutcome,
}

impl Motion {
    pub(super) fn is_near(&self, base: &Pose, platform: &Pose) -> bool {
        let apart = |x: &Pose, y: &Pose| (x.rotation.matrix() - y.rotation.matrix()).amax();
        apart(&self.base, base) < SAME && apart(&self.platform, platform) < SAME
    }

    /// Whether it moves anything.
    #[must_use]
    pub fn is_motion(&self) -> bool {
        let still = Pose { rotation: Rotation3::identity(), position: Vector3::zeros() };
        self.base != still || self.platform != still
    }

    /// Sum of the angles of rotation and the translations over `size`.
    pub(super) fn extent(&self, size: f64) -> f64 {
        [&self.base, &self.platform]
            .iter()
            .map(|m| rotation_vector(&m.rotation).norm() + m.position.norm() / size)
            .sum()
    }
}

/// The pair of rigid motions with the least residual.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "NearestMotionRecord", transform = num::nullable))]
pub struct NearestMotion {
    /// Motion of the second design's base.
    pub base: Pose,
    /// Motion of its platform.
    pub platform: Pose,
    /// The residual it leaves.
    // the largest relative distance of a leg from the span of the first design
    pub residual: f64,
}

num::answer_words! {
    /// An invariant under rigid motions that equivalent designs share.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Invariant as name {
        /// Dimension of the span `L` of the leg vectors.
        LegRank = "leg_rank",
        /// Dimension of the entries `(1, a, b)` of the elements of `L`.
        JointRank = "joint_rank",
        /// Dimension of the translations left open by a step towards the canonical origins.
        OpenTranslations = "open_translations",
        /// A principal value of the base.
        BasePrincipalValue = "base_principal_value",
        /// A principal value of the platform.
        PlatformPrincipalValue = "platform_principal_value",
        /// Distance of the canonical forms, zero for equivalent designs.
        CanonicalDistance = "canonical_distance",
    }
}

/// An invariant that distinguishes two designs.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "DifferenceRecord", transform = num::nullable))]
pub struct Difference {
    /// The invariant.
    pub invariant: Invariant,
    /// Its value for the first design.
    // zero for the distance of canonical forms
    #[cfg_attr(feature = "serde", serde(rename = "a"))]
    pub in_a: f64,
    /// Its value for the second.
    // the distance itself for the distance of canonical forms
    #[cfg_attr(feature = "serde", serde(rename = "b"))]
    pub in_b: f64,
    /// The difference of both values.
    // for dimensions the smallest singular value that did not count as zero
    pub gap: f64,
    /// The threshold for a difference.
    // for dimensions the largest singular value that counted as zero
    pub bound: f64,
}

num::answer_words! {
    /// The reason why nothing was decided.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum AlignmentUndecided as name {
        /// A dimension is unclear: singular values are too near the tolerance.
        UnclearDimension = "unclear_dimension",
        /// A body has no unique axes, or nearly so; a search found no motion, which proves nothing.
        NoAxes = "no_axes",
        /// No invariant differs by more than its possible error, and no motion reaches the tolerance.
        WithinErrors = "within_errors",
    }
}

/// The motions that make B equivalent to A.
#[derive(Debug, Clone, PartialEq)]
pub enum Alignment {
    /// Motions were found.
    Found {
        /// The smallest motion is first. Their number is that of the pairs of motions that keep the span of A, one of
        /// each family.
        motions: Vec<Motion>,
        /// Whether the list is complete, up to the families of its motions.
        all: bool,
        /// Dimension of the families the motions lie in; zero for finitely many motions.
        freedom: usize,
    },
    /// No motion exists.
    None {
        /// The invariant that shows it.
        difference: Difference,
        /// The nearest motion.
        nearest: Option<NearestMotion>,
    },
    /// Not decided.
    Undecided {
        /// Why.
        reason: AlignmentUndecided,
        /// The nearest motion.
        nearest: Option<NearestMotion>,
    },
}

impl Alignment {
    /// The motions found.
    #[must_use]
    pub fn motions(&self) -> &[Motion] {
        match self {
            Self::Found { motions, .. } => motions,
            _ => &[],
        }
    }
}

num::answer_words! {
    /// Whether rigid motions were found.
    pub enum AlignmentWord as name of Alignment {
        /// Motions were found.
        Found = "found",
        /// No motion exists.
        None = "none",
        /// Not decided.
        Undecided = "undecided",
    }
}

/// Smallest singular value that counts and largest that does not, over both designs.
fn gaps(a: &Canonical, b: &Canonical) -> (f64, f64) {
    (a.span.gap.0.min(b.span.gap.0), a.span.gap.1.max(b.span.gap.1))
}

fn is_clear(a: &Canonical, b: &Canonical) -> bool {
    let (counts, does_not) = gaps(a, b);
    counts >= CLEAR.0 && does_not <= CLEAR.1
}

/// The answer for spans of different dimensions.
pub(super) fn dimensions_differ(a: &Canonical, b: &Canonical) -> Alignment {
    let (x, y) = (a.span.dimensions, b.span.dimensions);
    let at = (0..5).find(|k| x[*k] != y[*k]).unwrap_or(0);
    let invariant = match at {
        0 => Invariant::LegRank,
        1 => Invariant::JointRank,
        _ => Invariant::OpenTranslations,
    };
    let (gap, bound) = gaps(a, b);
    if !is_clear(a, b) {
        return Alignment::Undecided { reason: AlignmentUndecided::UnclearDimension, nearest: None };
    }
    let difference = Difference { invariant, in_a: x[at] as f64, in_b: y[at] as f64, bound, gap };
    Alignment::None { difference, nearest: None }
}

/// The answer if no candidate makes the designs equivalent. `distance` is that of the canonical forms, if all
/// candidates are known.
pub(super) fn none_found(
    a: &Canonical,
    b: &Canonical,
    distance: Option<f64>,
    bounds: &RoundingBounds,
    nearest: Option<NearestMotion>,
) -> Alignment {
    if !is_clear(a, b) {
        return Alignment::Undecided { reason: AlignmentUndecided::UnclearDimension, nearest };
    }
    let values = (0..6).map(|k| Difference {
        invariant: if k < 3 { Invariant::BasePrincipalValue } else { Invariant::PlatformPrincipalValue },
        in_a: a.values[k],
        in_b: b.values[k],
        bound: bounds.values[k],
        gap: (a.values[k] - b.values[k]).abs(),
    });
    let forms = distance.map(|d| Difference {
        invariant: Invariant::CanonicalDistance,
        in_a: 0.0,
        in_b: d,
        bound: bounds.distance,
        gap: d,
    });
    let clear = values.chain(forms).filter(|d| d.gap > d.bound);
    match clear.max_by(|x, y| (x.gap / x.bound).total_cmp(&(y.gap / y.bound))) {
        Some(difference) => Alignment::None { difference, nearest },
        None if distance.is_none() => Alignment::Undecided { reason: AlignmentUndecided::NoAxes, nearest },
        None => Alignment::Undecided { reason: AlignmentUndecided::WithinErrors, nearest },
    }
}

impl Alignment {
    /// One sentence with the deciding numbers.
    #[must_use]
    pub fn explanation(&self) -> String {
        match self {
            Alignment::Found { motions, all, freedom } => {
                let n = motions.len();
                let family = match freedom {
                    0 => String::new(),
                    d => format!(", one of each family of dimension {d}"),
                };
                let others = if *all { "there are no others" } else { "there may be others" };
                format!(
                    "{n} pair{} of rigid motions make{} the second design equivalent to the first{family}; {others}",
                    if n == 1 { "" } else { "s" },
                    if n == 1 { "s" } else { "" }
                )
            }
            Alignment::None { difference, nearest } => {
                format!(
                    "no rigid motions make the second design equivalent to the first: {}{}",
                    reason(difference),
                    remark(nearest.as_ref())
                )
            }
            Alignment::Undecided { reason, nearest } => {
                let why = match reason {
                    AlignmentUndecided::UnclearDimension => {
                        "a dimension is not clear, singular values are too near to the tolerance"
                    }
                    AlignmentUndecided::NoAxes => {
                        "a body has no axes of its own, and the search found no motion"
                    }
                    _ => {
                        "no invariant differs by more than its error bound, and no motion reaches the tolerance"
                    }
                };
                format!(
                    "whether rigid motions make the designs equivalent is not decided: {why}{}",
                    remark(nearest.as_ref())
                )
            }
        }
    }
}

fn reason(d: &Difference) -> String {
    let (x, y, gap, bound) = (d.in_a, d.in_b, d.gap, d.bound);
    match d.invariant {
        Invariant::BasePrincipalValue => format!(
            "a principal value of the base is {x:.9} and {y:.9}, they differ by {gap:.1e} (error bound {bound:.1e})"
        ),
        Invariant::PlatformPrincipalValue => format!(
            "a principal value of the platform is {x:.9} and {y:.9}, they differ by {gap:.1e} (error bound {bound:.1e})"
        ),
        Invariant::CanonicalDistance => {
            format!("the canonical forms are {gap:.1e} apart at best (error bound {bound:.1e})")
        }
        other => format!(
            "{} is {x} and {y} (smallest singular value that counts {gap:.1e}, largest that does not {bound:.1e})",
            other.name().replace('_', " ")
        ),
    }
}

fn remark(nearest: Option<&NearestMotion>) -> String {
    nearest.map_or(String::new(), |n| format!("; the nearest motions leave a residual of {:.1e}", n.residual))
}
