//! Answers on whether two designs are kinematically equivalent, with the evidence of both sides.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{ComplexRecord, FramesRecord, MapRecord, Number, PoseRecord, leg_number};
use ask::ComparedDesigns;
use fk::{CompletenessWord, FkSolutions, Method};
use platform::geom::{ComplexPose, SamplePlan};
use synthesis::LegMapOutcome;
use verify::{Counterexample, Sample, Verdict, VerdictWord, Verification};

view! {
    /// The answer of `verify`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct VerifyAnswer {
        /// The verdict.
        pub verdict: VerdictWord = v.verdict.word(),
        /// Verdict in words, with the numbers that decided.
        pub explanation: String = v.explanation(),
        /// Whether exact arithmetic proves the verdict; `level` of the map names the joints it holds for.
        pub proved: bool = v.proved(),
        /// The algebraic evidence; if no motion was found, the map between the designs as given.
        pub map: MapRecord = (&v.map).into(),
        /// Bounds on the squared lengths of B minus A s + c, design units squared. They hold at all poses of
        /// `sampling`, for any tolerance of the map. Null: the map is exact by proof, or singular, or no motion was
        /// found.
        pub deviation_bounds: Option<[Number; 6]> = v.deviation_bounds.map(|bounds| bounds.map(Number)),
        /// Largest distance of matched poses; null: none were compared.
        pub worst_distance: Option<Number> = Some(Number(v.worst_distance())),
        /// Unmatched poses set aside, because rounding of the joints decides whether they exist. Absent: no motion was
        /// found.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub beyond_precision: Option<BeyondPrecisionRecord> = Some(BeyondPrecisionRecord { a, b }),
        /// The numerical evidence.
        pub samples: Vec<SampleRecord> = v.samples.iter().map(SampleRecord::from).collect(),
        /// Pose distinguishing the designs; null: none was found.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub counterexample: Option<CounterexampleRecord> = match &v.verdict {
            Verdict::NotEquivalent(Some(c)) => Some(c.as_ref().into()),
            _ => None,
        },
        /// The box of random poses; absent: no motion was found.
        #[serde(skip_serializing_if = "Option::is_none")]
        pub sampling: Option<SamplingRecord> = Some(plan.into()),
        /// The changes of frames of the second design.
        #[serde(flatten)]
        pub frames: FramesRecord = frames,
    }
    /// The answer of a verification over the samples of a plan.
    pub fn new(v: &Verification, plan: &SamplePlan, frames: FramesRecord) {
        let [a, b] = v.beyond_precision();
    }
}

impl VerifyAnswer {
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

view! {
    /// Both designs at one set of corresponding leg lengths.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SampleRecord {
        /// Leg lengths of A, design units.
        pub lengths_a: [Number; 6] = s.squares_a.lengths().get().map(Number),
        /// Leg lengths of B, design units.
        pub lengths_b: [Number; 6] = s.squares_b.lengths().get().map(Number),
        /// The poses of A.
        pub a: SolvedSampleRecord = (&s.solutions_a).into(),
        /// The poses of B.
        pub b: SolvedSampleRecord = (&s.solutions_b).into(),
        /// Number of pairs of poses.
        pub matched: usize = s.matching.pairs.len(),
        /// Number of unmatched poses of A.
        pub only_a: usize = s.matching.only_a.len(),
        /// Number of unmatched poses of B.
        pub only_b: usize = s.matching.only_b.len(),
        /// Number of poses of A set aside.
        pub beyond_precision_a: usize = s.matching.beyond_a.len(),
        /// Number of poses of B set aside.
        pub beyond_precision_b: usize = s.matching.beyond_b.len(),
        /// Largest distance in a pair.
        pub worst_distance: Number = Number(s.matching.worst_distance()),
        /// Whether it supports equivalence.
        pub agrees: bool = s.agrees(),
    }
    impl From(s: &Sample) {}
}

view! {
    /// Poses of one design at one set of lengths, by forward kinematics.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SolvedSampleRecord {
        /// The method.
        pub method: Method = s.method,
        /// Completeness of the list.
        pub completeness: CompletenessWord = s.completeness.word(),
        /// Evidence for completeness.
        pub completeness_reason: String = s.completeness.to_string(),
        /// Whether every path is accounted for; false: poses may be missing.
        pub all_paths_accounted: bool = s.all_accounted(),
        /// Number of finite poses, real and complex.
        pub finite_count: usize = s.roots.len(),
        /// Number of real poses.
        pub real_count: usize = s.assembly_modes().count(),
        /// Number of poses with a certificate.
        pub certified_count: usize = s.roots.iter().filter(|r| r.certified()).count(),
    }
    impl From(s: &FkSolutions) {}
}

view! {
    /// A pose that the lengths of one design allow and the corresponding lengths of the other do not.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CounterexampleRecord {
        /// Index into `samples`, from 0.
        pub sample: usize = c.sample,
        /// The design that has the pose: A or B.
        #[schemars(extend("enum" = ["A", "B"]))]
        pub solves: String = c.solves.to_owned(),
        /// The pose.
        pub pose: ComplexRecord<PoseRecord> = parts(&c.pose),
        /// Whether a certificate proves the pose for this design.
        pub certified: bool = c.certified(),
        /// Leg of the other design with the greatest length error, from 1.
        pub leg: usize = leg_number(c.leg),
        /// The error of its squared length, relative to the squared size.
        pub miss: Number = Number(c.miss),
        /// Rounding error expected in it.
        pub rounding: Number = Number(c.rounding),
    }
    impl From(c: &Counterexample) {}
}

/// Real and imaginary part, each as a pose.
fn parts(pose: &ComplexPose) -> ComplexRecord<PoseRecord> {
    let part = |of: fn(&num_complex::Complex64) -> f64| PoseRecord {
        rotation: [0, 1, 2].map(|i| [0, 1, 2].map(|j| Number(of(&pose.rotation[(i, j)])))),
        position: [0, 1, 2].map(|i| Number(of(&pose.position[i]))),
    };
    ComplexRecord { re: part(|z| z.re), im: part(|z| z.im) }
}

view! {
    /// The random poses at which designs were compared.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct SamplingRecord {
        /// Number of poses.
        pub count: usize = plan.count,
        /// Centre of the box, base frame, design units.
        pub home_position: [f64; 3] = plan.home.position.into(),
        /// Half widths of positions, design units.
        pub translation_half_widths: [f64; 3] = plan.translation.into(),
        /// Half widths of rotation vectors, radians.
        pub rotation_half_widths_rad: [f64; 3] = plan.rotation.into(),
    }
    impl From(plan: &SamplePlan) {}
}

impl From<&ComparedDesigns> for VerifyAnswer {
    fn from(compared: &ComparedDesigns) -> Self {
        Self::new(&compared.found, &compared.plan, FramesRecord::default())
    }
}
