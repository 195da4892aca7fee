//! The number of poses, counted without finding them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use fk::solve::pose_count::{CountUndecided, CountedLengths, PoseCount, PoseSet};
use fk::{Completeness, FkSolutions};

view! {
    /// The finite poses of the design, counted without finding them.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct PoseCountRecord {
        /// Number of poses with multiplicity; null: not finite, or undecided.
        pub finite: Option<usize> = None,
        /// Number of standard monomials by degree.
        pub by_degree: Option<Vec<usize>> = None,
        /// Dimension of a positive-dimensional set.
        pub dimension: Option<usize> = None,
        /// Degree of a positive-dimensional set, in the 16 coordinates of a pose, with multiplicity.
        pub degree: Option<usize> = None,
        /// Reason for no count.
        pub undecided: Option<CountUndecided> = None,
        /// The counted lengths: the exact ones given, or generic ones, which have at least as many isolated poses.
        /// Lengths known only to rounding, such as images under a leg map, are counted as generic.
        pub lengths: CountedLengths = CountedLengths::Given,
        /// The evidence for the count: a theorem with certificates, or counting modulo random primes.
        pub evidence: EvidenceWord = evidence,
        /// Bound on the probability of a wrong count; null: proved, or undecided.
        pub error_probability: Option<f64> = None,
        /// The primes in decimal, as text: they have more digits than a double.
        pub primes: Vec<String> = Vec::new(),
    }
    fn without(evidence: EvidenceWord) {}
}

/// The evidence for a count.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum EvidenceWord {
    /// A theorem and certificates.
    Proved,
    /// Linear algebra modulo random primes.
    Modular,
}

impl PoseCountRecord {
    pub(super) fn of(s: &FkSolutions) -> Option<Self> {
        match &s.pose_count {
            Some(count) => Some(count.into()),
            None => matches!(s.completeness, Completeness::Proved { .. })
                .then(|| Self { finite: Some(s.certified_count()), ..Self::without(EvidenceWord::Proved) }),
        }
    }
}

impl From<&PoseCount> for PoseCountRecord {
    fn from(c: &PoseCount) -> Self {
        let mut record = Self::without(EvidenceWord::Modular);
        match &c.set {
            PoseSet::Finite { count, by_degree } => {
                record.finite = Some(*count);
                record.by_degree = Some(by_degree.clone());
            }
            PoseSet::PositiveDimensional { dimension, degree } => {
                record.dimension = Some(*dimension);
                record.degree = Some(*degree);
            }
            PoseSet::Undecided { why } => record.undecided = Some(*why),
        }
        record.lengths = c.lengths;
        record.error_probability = record.undecided.is_none().then_some(c.error_probability);
        record.primes = c.primes.iter().map(u64::to_string).collect();
        record
    }
}
