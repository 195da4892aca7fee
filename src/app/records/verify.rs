//! Answers on whether two designs are kinematically equivalent, with the evidence of both sides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ComplexRecord, FramesRecord, MapRecord, Number, PoseRecord, leg_number};
use ask::ComparedDesigns;
use fk::{CompletenessWord, FkSolutions, Method};
use platform::geom::{ComplexPose, SamplePlan};
use synthesis::LegMapOutcome;
use verify::{Counterexample, Sample, Verdict, VerdictWord, Verification};

/// The answer of `verify`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct VerifyAnswer {
    /// The verdict.
    pub verdict: VerdictWord,
    /// Verdict in words, with the numbers that decided.
    pub explanation: String,
    /// Whether exact arithmetic proves the verdict; `level` of the map names the joints it holds for.
    pub proved: bool,
    /// The algebraic evidence; if no motion was found, the map between the designs as given.
    pub map: MapRecord,
    /// Bounds on the squared lengths of B minus A s + c, design units squared. They hold at all poses of `sampling`,
    /// for any tolerance of the map. Null: the map is exact by proof, or singular, or no motion was found.
    pub deviation_bounds: Option<[Number; 6]>,
    /// Largest distance of matched poses; null: none were compared.
    pub worst_distance: Option<Number>,
    /// Unmatched poses set aside, because rounding of the joints decides whether they exist. Absent: no motion was
    /// found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub beyond_precision: Option<BeyondPrecisionRecord>,
    /// The numerical evidence.
    pub samples: Vec<SampleRecord>,
    /// Pose distinguishing the designs; null: none was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub counterexample: Option<CounterexampleRecord>,
    /// The box of random poses; absent: no motion was found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sampling: Option<SamplingRecord>,
    /// The changes of frames of the second design.
    #[serde(flatten)]
    pub frames: FramesRecord,
}

impl VerifyAnswer {
    /// The answer of a verification over the samples of a plan.
    #[must_use]
    pub fn new(v: &Verification, plan: &SamplePlan, frames: FramesRecord) -> Self {
        let [a, b] = v.beyond_precision();
        Self {
            verdict: v.verdict.word(),
            explanation: v.explanation(),
            proved: v.proved(),
            map: (&v.map).into(),
            deviation_bounds: v.deviation_bounds.map(|bounds| bounds.map(Number)),
            worst_distance: Some(Number(v.worst_distance())),
            beyond_precision: Some(BeyondPrecisionRecord { a, b }),
            samples: v.samples.iter().map(SampleRecord::from).collect(),
            counterexample: match &v.verdict {
                Verdict::NotEquivalent(Some(c)) => Some(c.as_ref().into()),
                _ => None,
            },
            sampling: Some(plan.into()),
            frames,
        }
    }

    /// The answer for a search for rigid motions without success: there are none (`refuted`), or none were found.
    #[must_use]
    pub fn unaligned(map: &LegMapOutcome, refuted: bool, explanation: String, frames: FramesRecord) -> Self {
        Self {
            verdict: if refuted { VerdictWord::NotEquivalent } else { VerdictWord::Inconclusive },
            explanation,
            proved: false,
            map: map.into(),
            deviation_bounds: None,
            worst_distance: None,
            beyond_precision: None,
            samples: Vec::new(),
            counterexample: None,
            sampling: None,
            frames,
        }
    }
}

/// Numbers of poses that were set aside.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct BeyondPrecisionRecord {
    /// Number of poses of A.
    pub a: usize,
    /// Number of poses of B.
    pub b: usize,
}

/// Both designs at one set of corresponding leg lengths.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SampleRecord {
    /// Leg lengths of A, design units.
    pub lengths_a: [Number; 6],
    /// Leg lengths of B, design units.
    pub lengths_b: [Number; 6],
    /// The poses of A.
    pub a: SolvedSampleRecord,
    /// The poses of B.
    pub b: SolvedSampleRecord,
    /// Number of pairs of poses.
    pub matched: usize,
    /// Number of unmatched poses of A.
    pub only_a: usize,
    /// Number of unmatched poses of B.
    pub only_b: usize,
    /// Number of poses of A set aside.
    pub beyond_precision_a: usize,
    /// Number of poses of B set aside.
    pub beyond_precision_b: usize,
    /// Largest distance in a pair.
    pub worst_distance: Number,
    /// Whether it supports equivalence.
    pub agrees: bool,
}

impl From<&Sample> for SampleRecord {
    fn from(s: &Sample) -> Self {
        Self {
            lengths_a: s.squares_a.lengths().get().map(Number),
            lengths_b: s.squares_b.lengths().get().map(Number),
            a: (&s.solutions_a).into(),
            b: (&s.solutions_b).into(),
            matched: s.matching.pairs.len(),
            only_a: s.matching.only_a.len(),
            only_b: s.matching.only_b.len(),
            beyond_precision_a: s.matching.beyond_a.len(),
            beyond_precision_b: s.matching.beyond_b.len(),
            worst_distance: Number(s.matching.worst_distance()),
            agrees: s.agrees(),
        }
    }
}

/// Poses of one design at one set of lengths, by forward kinematics.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SolvedSampleRecord {
    /// The method.
    pub method: Method,
    /// Completeness of the list.
    pub completeness: CompletenessWord,
    /// Evidence for completeness.
    pub completeness_reason: String,
    /// Whether every path is accounted for; false: poses may be missing.
    pub all_paths_accounted: bool,
    /// Number of finite poses, real and complex.
    pub finite_count: usize,
    /// Number of real poses.
    pub real_count: usize,
    /// Number of poses with a certificate.
    pub certified_count: usize,
}

impl From<&FkSolutions> for SolvedSampleRecord {
    fn from(s: &FkSolutions) -> Self {
        Self {
            method: s.method,
            completeness: s.completeness.word(),
            completeness_reason: s.completeness.to_string(),
            all_paths_accounted: s.all_accounted(),
            finite_count: s.roots.len(),
            real_count: s.assembly_modes().count(),
            certified_count: s.roots.iter().filter(|r| r.certified()).count(),
        }
    }
}

/// A pose that the lengths of one design allow and the corresponding lengths of the other do not.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CounterexampleRecord {
    /// Index into `samples`, from 0.
    pub sample: usize,
    /// The design that has the pose: A or B.
    #[schemars(extend("enum" = ["A", "B"]))]
    pub solves: String,
    /// The pose.
    pub pose: ComplexRecord<PoseRecord>,
    /// Whether a certificate proves the pose for this design.
    pub certified: bool,
    /// Leg of the other design with the greatest length error, from 1.
    pub leg: usize,
    /// The error of its squared length, relative to the squared size.
    pub miss: Number,
    /// Rounding error expected in it.
    pub rounding: Number,
}

impl From<&Counterexample> for CounterexampleRecord {
    fn from(c: &Counterexample) -> Self {
        Self {
            sample: c.sample,
            solves: c.solves.to_owned(),
            pose: parts(&c.pose),
            certified: c.certified(),
            leg: leg_number(c.leg),
            miss: Number(c.miss),
            rounding: Number(c.rounding),
        }
    }
}

/// Real and imaginary part, each as a pose.
fn parts(pose: &ComplexPose) -> ComplexRecord<PoseRecord> {
    let part = |of: fn(&num_complex::Complex64) -> f64| PoseRecord {
        rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| Number(of(&pose.rotation[(i, j)])))),
        position: [0, 1, 2].map(|i| Number(of(&pose.position[i]))),
    };
    ComplexRecord { re: part(|z| z.re), im: part(|z| z.im) }
}

/// The random poses at which designs were compared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SamplingRecord {
    /// Number of poses.
    pub count: usize,
    /// Centre of the box, base frame, design units.
    pub home_position: [f64; 3],
    /// Half widths of positions, design units.
    pub translation_half_widths: [f64; 3],
    /// Half widths of rotation vectors, radians.
    pub rotation_half_widths_rad: [f64; 3],
}

impl From<&SamplePlan> for SamplingRecord {
    fn from(plan: &SamplePlan) -> Self {
        Self {
            count: plan.count,
            home_position: plan.home.position.into(),
            translation_half_widths: plan.translation.into(),
            rotation_half_widths_rad: plan.rotation.into(),
        }
    }
}

impl From<&ComparedDesigns> for VerifyAnswer {
    fn from(compared: &ComparedDesigns) -> Self {
        Self::new(&compared.found, &compared.plan, FramesRecord::default())
    }
}
