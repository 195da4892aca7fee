//! The knowledge whether an answer holds all finite poses: data that is joined by rule and put into words in one place.
//!
//! The states of knowledge form a lattice:
//!
//! ```text
//!                    Proved                a theorem: as many certified distinct poses as there can be
//!                      |
//!                 ProvedBounded            a theorem: every real pose is listed; others are farther out, or complex
//!                      |
//!                   Modular                as many as there are, counted modulo random primes
//!                      |
//!     Unproved { all reasons together }
//!            /         |         \
//!   Unproved {a}  Unproved {b}  ...
//!            \         |         /
//!               Unproved {}                nothing is known, nothing speaks against the answer
//! ```
//!
//! [`Completeness::join`] is the least upper bound. A proof leaves no doubt; without one no reason gets lost, in
//! whatever order the reasons come. The order of the variants of [`Reason`] is their order in the text.

use std::fmt;

use crate::solve::pose_count::CountedLengths;

/// Whether the set of roots is known to be all of them.
#[derive(Debug, Clone, PartialEq)]
pub enum Completeness {
    /// The number of distinct certified roots equals a proved upper bound.
    Proved {
        /// The bound.
        theorem: Theorem,
    },
    /// Every real pose is listed. Either the certified roots, with the others that are proved to be farther out, reach
    /// the largest possible number: then all poses up to a distance are listed. Or each real pose is one of those next
    /// to the poses of an affine neighbour: then complex poses of any size may be missing.
    ProvedBounded {
        /// The number of poses and the distance.
        proof: BoundedProof,
    },
    /// The certified roots are distinct and as many as the finite poses of the design and lengths as written, counted
    /// modulo random primes with multiplicity. All poses are isolated and listed, up to the probability of error of
    /// [`FkSolutions::pose_count`](super::FkSolutions::pose_count).
    Modular {
        /// Certified distinct poses.
        poses: usize,
        /// Whether the poses of the given lengths or those of generic lengths are counted. When generic lengths have as
        /// many poses as are certified, there are no others.
        lengths: CountedLengths,
        /// Bound on the probability that the count is wrong.
        error_probability: f64,
    },
    /// No proof.
    Unproved {
        /// The known facts and the causes of doubt.
        reasons: Reasons,
    },
}

num::answer_words! {
    /// Whether all poses are known to be listed.
    pub enum CompletenessWord as name of Completeness {
        /// A theorem proves it.
        Proved = "proved",
        /// A theorem proves it for all real poses, or for all poses up to a distance above theirs.
        ProvedBounded = "proved_bounded",
        /// Counted modulo random primes, with a bound on the probability of error.
        Modular = "modular",
        /// Not known.
        Unproved = "unproved",
    }
}

/// The numbers of a proof that all real poses are listed, or all poses up to a distance.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema))]
pub struct BoundedProof {
    /// Certified poses listed, with multiplicity.
    pub poses: usize,
    /// Number of far poses, certified to be different and farther out, or at infinity; null: the proof needs none.
    pub far: Option<usize>,
    /// Bound on rotation entries: every pose whose rotation matrix has no entry of a larger modulus is listed. Entries
    /// of real rotations are at most 1. Null: the proof is about real poses alone.
    #[cfg_attr(feature = "serde", serde(rename = "R"))]
    pub rotation: Option<f64>,
    /// Change of leg ends to a neighbouring design without more poses, design units. The proof is then about real
    /// poses. Null: it is about far poses.
    pub neighbour: Option<f64>,
    /// The far poses, the nearest ones first.
    pub others: Vec<FarPoses>,
}

/// Poses far out, certified in coordinates that are regular at infinity.
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, schemars::JsonSchema))]
pub struct FarPoses {
    /// Number of poses: two that are too close to be told apart, or one.
    pub poses: usize,
    /// Lower bound on their largest rotation entry.
    pub rotation: f64,
    /// It is at most this; null: they may be at infinity.
    pub rotation_at_most: Option<f64>,
}

impl fmt::Display for BoundedProof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { poses, far, rotation, neighbour, .. } = self;
        let (Some(far), Some(rotation)) = (far, rotation) else {
            return write!(
                f,
                "{poses} certified distinct poses, the number of planar bodies whose joints are affine images of each other. The joints are within {:.1e} of such bodies, \
                 and every real pose is a pose of them at lengths within that distance; each of these is next to a listed pose or not real: all real poses are listed",
                neighbour.unwrap_or_default()
            );
        };
        write!(
            f,
            "{poses} certified distinct poses, and the other {far} of at most {} are proved to be complex: their rotation matrices have entries above {rotation:.1e}",
            poses + far
        )
    }
}

/// A proved upper bound on the number of finite poses, counted with multiplicity, that certified poses reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Theorem {
    /// A linear relation between the legs holds exactly and the lengths contradict it: there is no pose.
    ContradictoryLengths,
    /// The octic of an octahedral platform: eight values of the unknown distance, two mirror poses each.
    Octahedral,
    /// Six legs never have more than 40 isolated finite poses.
    SixLegs,
    /// The joints that the legs share allow no more.
    SharedJoints {
        /// The bound.
        poses: usize,
        /// The construction that proves it, see `docs/theory/completeness.md`.
        construction: &'static str,
    },
    /// Five legs end on a line of one body: three quadrics for the line, then an angle.
    FiveOnALine,
    /// Four legs end on a line of one body: a curve of degree eight for the line, then an angle.
    FourOnALine,
    /// Planar bodies whose joints are affine images of each other: a quartic, two signs, a quadric.
    AffineHexagons,
    /// Points at infinity that the legs have in common whatever their lengths are.
    PointsAtInfinity {
        /// Pairs of lines, one of each body, on which all legs end: each takes eight poses away.
        butterflies: usize,
        /// Projections of planar bodies that a linear fractional map relates: each takes four poses away.
        inversions: usize,
    },
}

impl Theorem {
    /// The largest number of isolated finite poses.
    #[must_use]
    pub fn bound(self) -> usize {
        match self {
            Self::ContradictoryLengths => 0,
            Self::Octahedral | Self::FiveOnALine | Self::AffineHexagons => 16,
            Self::SixLegs => 40,
            Self::SharedJoints { poses, .. } => poses,
            Self::FourOnALine => 32,
            Self::PointsAtInfinity { butterflies, inversions } => {
                40usize.saturating_sub(8 * butterflies + 4 * inversions)
            }
        }
    }

    /// Why there are not more, in one clause.
    #[must_use]
    pub fn statement(self) -> String {
        match self {
            Self::ContradictoryLengths => {
                "the leg vectors satisfy a linear relation exactly, and the squared lengths contradict it: the same combination of \
                 the leg equations is a nonzero multiple of e.e, which is zero at no pose"
            }
            Self::Octahedral => {
                "an octahedral platform never has more than 16 isolated ones (an octic with two mirror poses for each root)"
            }
            Self::SixLegs => {
                "six leg equations never have more than 40 isolated ones (Ronga, Vust 1992; Lazard 1993; Mourrain 1993)"
            }
            Self::SharedJoints { poses, construction } => {
                return format!("no more than {poses} are possible: {construction}");
            }
            Self::FiveOnALine => {
                "no more than 16 are possible with five joints of one body on a line: three quadrics for the position of the line, two angles about it"
            }
            Self::FourOnALine => {
                "no more than 32 are possible with four joints of one body on a line: a closure condition of degree four on a curve of degree eight"
            }
            Self::AffineHexagons => {
                "no more than 16 are possible with planar bodies whose joints are affine images of each other: a quartic, two mirror images, two translations"
            }
            Self::PointsAtInfinity { butterflies, inversions } => {
                let causes = [
                    (butterflies, "pairs of lines on which all legs end"),
                    (inversions, "pairs of projections of the planar bodies that a linear fractional map relates"),
                ];
                let causes: Vec<String> =
                    causes.iter().filter(|c| c.0 > 0).map(|c| format!("{} {}", c.0, c.1)).collect();
                return format!(
                    "no more than {} are possible: of the 40 common points of six legs {} are at infinity for every set of lengths ({})",
                    self.bound(),
                    40 - self.bound(),
                    causes.join(" and ")
                );
            }
        }
        .to_owned()
    }
}

impl fmt::Display for Theorem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let statement = self.statement();
        match self {
            Self::ContradictoryLengths => write!(f, "{statement} (docs/theory/completeness.md)"),
            // the construction is told in full
            Self::SharedJoints { poses, .. } => {
                write!(f, "{poses} certified distinct poses, and {statement}")
            }
            Self::SixLegs | Self::Octahedral => {
                write!(f, "{} certified distinct poses, and {statement}", self.bound())
            }
            _ => write!(
                f,
                "{} certified distinct poses, and {statement} (docs/theory/completeness.md)",
                self.bound()
            ),
        }
    }
}

/// One thing that is known about an answer without a proof, with its numbers.
#[derive(Debug, Clone, PartialEq, PartialOrd)]
#[non_exhaustive]
pub enum Reason {
    /// Modulo random primes the poses form a set of positive dimension.
    SetCounted {
        /// Dimension of the components of highest dimension.
        dimension: usize,
        /// Their degree.
        degree: usize,
        /// Bound on the probability that this is wrong.
        error_probability: f64,
        /// Whether a proved relation between the legs explains the set.
        established: bool,
    },
    /// A motion is seen within rounding, but modulo random primes there is none.
    NoMotionAsWritten {
        /// Finite poses of the design and lengths as written.
        poses: usize,
        /// Bound on the probability that this is wrong.
        error_probability: f64,
    },
    /// Modulo random primes there are more poses than are certified, or those certified are not proved distinct.
    PosesMissing {
        /// Finite poses of the design and lengths as written, multiplicity included.
        counted: usize,
        /// Certified ones.
        certified: usize,
        /// Bound on the probability that the count is wrong.
        error_probability: f64,
    },
    /// Modulo random primes there are more poses for generic lengths than are certified, or the certified ones are not
    /// proved distinct. The given lengths are known within radii only and may have fewer.
    FewerThanGeneric {
        /// Finite poses for generic lengths.
        counted: usize,
        /// Certified ones.
        certified: usize,
        /// Bound on the probability that the count is wrong.
        error_probability: f64,
    },
    /// Dependent legs, within rounding, and the points that random sections found of the set of poses.
    DependentLegs {
        /// Whether the relation is proved and the sections are as they have to be for it.
        established: bool,
        /// Dimension of the set, at least.
        dimension: usize,
        /// Finite points on a general section of that codimension.
        points: usize,
        /// Points listed that are real.
        real: usize,
    },
    /// Random sections of a set of poses that was counted.
    Sectioned {
        /// Finite points on a general section of that codimension.
        points: usize,
        /// Points listed that are real.
        real: usize,
        /// Certified isolated poses beside the set.
        isolated: usize,
    },
    /// The ends of the paths of a homotopy.
    PathsEnded(PathsEnded),
    /// Candidates of eliminations.
    CandidatesEliminated {
        /// Candidates, those without a finite pose included.
        candidates: usize,
        /// Eliminations made.
        eliminations: usize,
        /// Certified poses.
        certified: usize,
        /// Poses that could not be certified.
        uncertified: usize,
    },
    /// Pairs of poses from the octic.
    OcticSolved {
        /// Pairs of squared distances.
        pairs: usize,
        /// Distinct poses of at most 16.
        poses: usize,
        /// Pairs that gave no pose.
        unplaced: usize,
    },
    /// Poses from trilaterations.
    Trilaterated {
        /// Certified poses.
        certified: usize,
        /// Configurations that they come from.
        configurations: usize,
        /// The attempts of the trilateration.
        tried: Tried,
        /// Poses that generic platforms of the topology have.
        usual: usize,
    },
    /// One pose was followed from a known one.
    OnePoseFollowed {
        /// Whether it was found.
        found: bool,
    },
    /// Paths end on curves of poses, seen numerically.
    CurvesSeen {
        /// Paths that end there.
        paths: u32,
    },
    /// Candidates that certificates prove to be roots found already.
    CandidatesRepeated {
        /// Their number.
        candidates: usize,
    },
    /// Regular poses without a certificate.
    PosesUncertified {
        /// Their number.
        poses: usize,
    },
    /// Certified poses that are not proved distinct.
    PairsNotDistinct {
        /// Pairs of them.
        pairs: usize,
        /// Pairs proved equal.
        equal: usize,
    },
    /// The leg vectors are nearly, and not exactly, dependent.
    LegsNearlyDependent,
    /// The equations of the legs cannot be told apart in doubles. The lengths are much longer than the design, or one
    /// body is much larger than the other.
    LegsNotToldApart,
    /// Near and far poses are certified, fewer than there can be: others are missing, or no proof tells near from far.
    NotSeparated {
        /// Certified poses nearer than the far ones.
        near: usize,
        /// Certified far ones.
        far: usize,
    },
    /// Paths that end near points without a certificate.
    EndsUnproved {
        /// Paths.
        paths: u32,
        /// Points.
        points: usize,
    },
}

/// The numbers of paths of a homotopy, by their ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct PathsEnded {
    /// Paths of the start system.
    pub paths: usize,
    /// Whether each stands for its mirror image as well.
    pub mirrored: bool,
    /// Paths to finite poses.
    pub finite: usize,
    /// Paths to `e.e = 0`.
    pub isotropic: usize,
    /// Paths to infinity.
    pub infinite: usize,
    /// Paths without an end.
    pub failed: usize,
    /// Ends so near infinity or `e.e = 0` that they may be finite poses.
    pub blurred: usize,
    /// Ends that are no root, or a root reached before.
    pub rejected: usize,
    /// Whether two regular paths share an end, or a root has fewer paths than it should.
    pub ambiguous: bool,
    /// Paths of which nothing is reported.
    pub unreported: usize,
}

impl PathsEnded {
    /// Whether every path ended where theory lets it end.
    #[must_use]
    pub fn accounted(&self) -> bool {
        let doubtful = self.failed + self.blurred + self.rejected + self.unreported;
        doubtful == 0 && !self.ambiguous
    }
}

/// The attempts of a trilateration.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tried {
    /// Trilateration sequences, each evaluated on a circle.
    Evaluations(usize),
    /// Ways to hide a length.
    HiddenLengths {
        /// Ways.
        ways: usize,
        /// Values of closure conditions in all.
        values: usize,
    },
}

impl fmt::Display for Tried {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Evaluations(count) => write!(f, "{count} evaluations"),
            Self::HiddenLengths { ways, values } => {
                write!(f, "{ways} ways to hide a length with {values} values of closure conditions")
            }
        }
    }
}

impl Reason {
    /// Whether this says nothing against completeness.
    #[must_use]
    pub fn is_accounted(&self) -> bool {
        match self {
            Self::SetCounted { established, .. } | Self::DependentLegs { established, .. } => *established,
            Self::PathsEnded(ends) => ends.accounted(),
            Self::OcticSolved { poses, unplaced, .. } => {
                *poses == Theorem::Octahedral.bound() && *unplaced == 0
            }
            Self::Trilaterated { certified, usual, .. } => certified == usual,
            Self::OnePoseFollowed { found } => *found,
            // a fact about the last digits: the motion within rounding has a reason of its own
            Self::NoMotionAsWritten { .. } => true,
            Self::PosesMissing { .. }
            | Self::FewerThanGeneric { .. }
            | Self::Sectioned { .. }
            | Self::CandidatesEliminated { .. }
            | Self::CurvesSeen { .. }
            | Self::CandidatesRepeated { .. }
            | Self::PosesUncertified { .. }
            | Self::PairsNotDistinct { .. }
            | Self::LegsNearlyDependent
            | Self::LegsNotToldApart
            | Self::NotSeparated { .. }
            | Self::EndsUnproved { .. } => false,
        }
    }
}

/// Writes how many of the listed points are real.
fn real_part(f: &mut fmt::Formatter<'_>, real: usize) -> fmt::Result {
    match real {
        0 => {
            f.write_str("sections and a search from 24 starts found no real pose on it, which proves nothing")
        }
        real => write!(f, "{real} of the points listed are real, found numerically"),
    }
}

impl fmt::Display for PathsEnded {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let both = if self.mirrored { ", each standing for its mirror image as well," } else { "" };
        let Self { paths, finite, isotropic, infinite, failed, blurred, .. } = self;
        write!(
            f,
            "of {paths} paths{both} {finite} ended in finite poses, {isotropic} at e.e = 0, {infinite} at infinity, {failed} failed; {}",
            if self.accounted() { "every path is accounted for" } else { "poses may be missing" },
        )?;
        if *blurred > 0 {
            write!(f, ": {blurred} ends are so near infinity or e.e = 0 that they may be finite poses")?;
        }
        Ok(())
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let doubt = if self.is_accounted() { "" } else { "; poses may be missing or multiple" };
        match self {
            Self::SetCounted { dimension, degree, error_probability, .. } => write!(
                f,
                "the poses form a set of dimension {dimension} and degree {degree} (modulo random primes, probability of error below {error_probability:.0e})"
            ),
            Self::NoMotionAsWritten { poses, error_probability } => write!(
                f,
                "the design and lengths as written have {poses} finite poses and no motion (modulo random primes, \
                 probability of error below {error_probability:.0e})"
            ),
            Self::PosesMissing { counted, certified, error_probability } => write!(
                f,
                "the design and lengths as written have {counted} finite poses with multiplicity (modulo random primes, probability of error below {error_probability:.0e}); \
                 {certified} are certified, {} are missing or not certified",
                counted.saturating_sub(*certified)
            ),
            Self::FewerThanGeneric { counted, certified, error_probability } => write!(
                f,
                "the design has {counted} finite poses for generic lengths (modulo random primes, probability of error below {error_probability:.0e}); \
                 {certified} are certified for the given lengths, which are known to rounding; poses may be missing or multiple"
            ),
            Self::DependentLegs { established, dimension, points, real } => {
                let relation = if *established {
                    "a relation between the leg vectors holds exactly and the lengths satisfy it within rounding"
                } else {
                    "within rounding, a relation between the leg vectors holds and the lengths satisfy it"
                };
                write!(
                    f,
                    "{relation}: the poses form a set of dimension {dimension} (at least), which a general \
                     section of that codimension meets in {points} finite points; "
                )?;
                real_part(f, *real)?;
                f.write_str("; isolated poses outside it are not searched")
            }
            Self::Sectioned { points, real, isolated } => {
                write!(f, "general sections of that codimension met it numerically in {points} points; ")?;
                real_part(f, *real)?;
                write!(f, "; {isolated} certified isolated poses outside it are listed, and others may be missing")
            }
            Self::PathsEnded(ends) => ends.fmt(f),
            Self::CandidatesEliminated { candidates, eliminations, certified, uncertified } => write!(
                f,
                "{candidates} candidates of {eliminations} elimination(s) gave {certified} certified poses and {uncertified} that could not be certified; a \
                 general platform has 40, so that roots may be missing or the platform is a special one",
            ),
            Self::OcticSolved { pairs, poses, .. } => write!(
                f,
                "the octic gave {pairs} pairs (s15, s34), {poses} distinct poses of at most 16 were found{doubt}"
            ),
            Self::Trilaterated { certified, configurations, tried, usual } => write!(
                f,
                "{certified} certified poses from {configurations} configurations of {tried}, {usual} are usual for the topology{doubt}"
            ),
            Self::OnePoseFollowed { .. } => {
                f.write_str("one pose was followed from the start pose; other poses were not searched")
            }
            Self::CurvesSeen { paths } => write!(
                f,
                "{paths} paths end on curves of poses (self-motions), found numerically; further curves and isolated poses may be missing"
            ),
            Self::CandidatesRepeated { candidates } => {
                write!(f, "{candidates} candidates are roots found already")
            }
            Self::PosesUncertified { poses } => write!(f, "{poses} regular poses could not be certified"),
            Self::PairsNotDistinct { pairs, equal } => {
                write!(f, "{pairs} pairs of certified poses are not proved distinct, {equal} of them proved equal")
            }
            Self::LegsNearlyDependent => f.write_str(
                "the leg vectors are linearly dependent to within 1e-9 but not exactly (nearly architecturally singular)",
            ),
            Self::LegsNotToldApart => f.write_str(
                "no poses were computed: doubles do not distinguish the legs, because the lengths are much longer than the design or one body is much larger than the other",
            ),
            Self::NotSeparated { near, far } => write!(
                f,
                "{near} near and {far} far poses are certified, of at most 40; the other {} are missing, or it is undecided whether they are near or far",
                40usize.saturating_sub(near + far)
            ),
            Self::EndsUnproved { paths, points } => write!(
                f,
                "{paths} paths end near {points} points without a certificate: multiple poses, several close ones, or none"
            ),
        }
    }
}

/// Reasons without repetition, in the order of the text.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Reasons(Vec<Reason>);

impl Reasons {
    /// The reasons, one after the other.
    pub fn iter(&self) -> impl Iterator<Item = &Reason> {
        self.0.iter()
    }

    /// The union.
    fn join(mut self, other: Self) -> Self {
        for reason in other.0 {
            if !self.0.contains(&reason) {
                self.0.push(reason);
            }
        }
        // numbers are never NaN
        self.0.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        self
    }
}

impl Completeness {
    /// No proof, for these reasons.
    #[must_use]
    pub fn unproved(reasons: impl IntoIterator<Item = Reason>) -> Self {
        let reasons = Reasons::default().join(Reasons(reasons.into_iter().collect()));
        Self::Unproved { reasons }
    }

    /// The knowledge from both: the better proof, or the reasons of both.
    #[must_use]
    pub fn join(self, other: Self) -> Self {
        match (self, other) {
            (Self::Proved { theorem: a }, Self::Proved { theorem: b }) => Self::Proved { theorem: a.min(b) },
            (proved @ Self::Proved { .. }, _) | (_, proved @ Self::Proved { .. }) => proved,
            (Self::ProvedBounded { proof: a }, Self::ProvedBounded { proof: b }) => {
                Self::ProvedBounded { proof: if a < b { b } else { a } }
            }
            (bounded @ Self::ProvedBounded { .. }, _) | (_, bounded @ Self::ProvedBounded { .. }) => bounded,
            (
                Self::Modular { poses, lengths, error_probability: a },
                Self::Modular { poses: other, lengths: others, error_probability: b },
            ) => Self::Modular {
                poses: poses.max(other),
                lengths: lengths.min(others),
                error_probability: a.min(b),
            },
            (modular @ Self::Modular { .. }, _) | (_, modular @ Self::Modular { .. }) => modular,
            (Self::Unproved { reasons: a }, Self::Unproved { reasons: b }) => {
                Self::Unproved { reasons: a.join(b) }
            }
        }
    }

    /// [`join`](Self::join) in place.
    pub(super) fn learn(&mut self, more: Self) {
        let known = std::mem::replace(self, Self::unproved([]));
        *self = known.join(more);
    }

    /// [`join`](Self::join) with one reason for doubt.
    pub(super) fn doubt(&mut self, reason: Reason) {
        self.learn(Self::unproved([reason]));
    }

    /// Whether a theorem proves it.
    #[must_use]
    pub fn is_proved(&self) -> bool {
        matches!(self, Self::Proved { .. })
    }

    /// `false` when something speaks against completeness, so that roots may be missing.
    #[must_use]
    pub fn all_accounted(&self) -> bool {
        match self {
            Self::Proved { .. } | Self::ProvedBounded { .. } | Self::Modular { .. } => true,
            Self::Unproved { reasons } => reasons.iter().all(Reason::is_accounted),
        }
    }

    /// The name used in JSON.
    #[must_use]
    pub fn name(&self) -> &'static str {
        self.word().name()
    }
}

impl fmt::Display for Completeness {
    /// The knowledge, in words.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Proved { theorem } => theorem.fmt(f),
            Self::ProvedBounded { proof } => proof.fmt(f),
            Self::Modular { poses, lengths: CountedLengths::Generic, error_probability } => write!(
                f,
                "{poses} certified distinct poses, and generic lengths have no more isolated poses, counted modulo random primes \
                 (probability of error below {error_probability:.0e})"
            ),
            Self::Modular { poses, lengths: CountedLengths::Given, error_probability } => write!(
                f,
                "{poses} certified distinct poses, and the design and lengths as written have the same number of finite poses, all isolated, counted modulo random primes \
                 (probability of error below {error_probability:.0e})"
            ),
            Self::Unproved { reasons } => {
                for (k, reason) in reasons.iter().enumerate() {
                    if k > 0 {
                        f.write_str("; ")?;
                    }
                    reason.fmt(f)?;
                }
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples() -> Vec<Completeness> {
        let proved = |theorem| Completeness::Proved { theorem };
        let reason = |r: Reason| Completeness::unproved([r]);
        let bounded = |rotation| BoundedProof {
            poses: 28,
            far: Some(12),
            rotation: Some(rotation),
            neighbour: None,
            others: vec![FarPoses { poses: 12, rotation, rotation_at_most: None }],
        };
        vec![
            Completeness::unproved([]),
            proved(Theorem::SixLegs),
            proved(Theorem::SharedJoints { poses: 8, construction: "three trilaterations" }),
            Completeness::ProvedBounded { proof: bounded(1e9) },
            Completeness::ProvedBounded { proof: bounded(1e10) },
            Completeness::Modular { poses: 12, lengths: CountedLengths::Given, error_probability: 1e-20 },
            reason(Reason::LegsNearlyDependent),
            reason(Reason::PosesUncertified { poses: 2 }),
            reason(Reason::PosesUncertified { poses: 3 }),
            reason(Reason::FewerThanGeneric { counted: 40, certified: 38, error_probability: 1e-19 }),
            reason(Reason::PosesMissing { counted: 40, certified: 38, error_probability: 1e-19 }),
            reason(Reason::OnePoseFollowed { found: true }),
        ]
    }

    #[test]
    fn joining_is_commutative_associative_and_idempotent_and_never_forgets() {
        for a in samples() {
            assert_eq!(a.clone().join(a.clone()), a);
            assert_eq!(a.clone().join(Completeness::unproved([])), a);
            for b in samples() {
                let both = a.clone().join(b.clone());
                assert_eq!(both, b.clone().join(a.clone()));
                // a proof alone ends a doubt
                let proof = !matches!(both, Completeness::Unproved { .. });
                assert_eq!(both.all_accounted(), proof || (a.all_accounted() && b.all_accounted()));
                for c in samples() {
                    assert_eq!(both.clone().join(c.clone()), a.clone().join(b.clone().join(c)));
                }
            }
        }
    }

    #[test]
    fn the_text_has_every_reason_once_in_one_order() {
        let doubts =
            [Reason::LegsNearlyDependent, Reason::PosesUncertified { poses: 2 }, Reason::LegsNearlyDependent];
        let ends = PathsEnded {
            paths: 40,
            mirrored: false,
            finite: 28,
            isotropic: 12,
            infinite: 0,
            failed: 0,
            blurred: 0,
            rejected: 0,
            ambiguous: false,
            unreported: 0,
        };
        let mut known = Completeness::unproved(doubts);
        assert!(!known.all_accounted());
        known.doubt(Reason::PathsEnded(ends));
        assert_eq!(
            known.to_string(),
            "of 40 paths 28 ended in finite poses, 12 at e.e = 0, 0 at infinity, 0 failed; every path is accounted for; \
             2 regular poses could not be certified; the leg vectors are linearly dependent to within 1e-9 but not exactly \
             (nearly architecturally singular)"
        );
        assert!(Completeness::unproved([Reason::PathsEnded(ends)]).all_accounted());
        let blurred = PathsEnded { blurred: 1, ..ends };
        assert!(!Completeness::unproved([Reason::PathsEnded(blurred)]).all_accounted());
        assert!(blurred.to_string().ends_with(
            "0 failed; poses may be missing: 1 ends are so near infinity or e.e = 0 that they may be finite poses"
        ));
    }
}
