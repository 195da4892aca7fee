//! The way from coplanar points to the leg map of an equivalent platform.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{Number, VerifyAnswer};
use ask::equivalents::Original;
use ask::{ComparedDesigns, Design, SAMPLES};
use fk::FkOptions;
use num::algebraic::Algebraic;
use synthesis::{Derivation, LegMapOutcome, LegSlide, Pattern};
use verify::VerifyError;

view! {
    /// The derivation of A, c and det A for one platform of the class from coplanar joints, with the forward kinematics
    /// as a check.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DerivationRecord {
        /// Whether numbers are exact: the joints are exact, and each moved joint lies exactly on its line. Otherwise
        /// the numbers are doubles.
        pub exact: bool = steps.exact,
        /// Row of A of each moved leg, with all offsets at once, from the legs of the octahedral platform.
        pub moves: Vec<LegSlideRecord> = steps.moves.iter().map(record).collect(),
        /// The moves one at a time, each from the legs before it; det A is the product of their `rest`. Null: every
        /// order of single moves puts two legs on one another.
        pub sequence: Option<Vec<LegSlideRecord>> =
            steps.sequence.as_ref().map(|sequence| sequence.iter().map(record).collect()),
        /// The factors of det A.
        pub factors: Vec<FactorRecord> = (steps.factors.iter())
            .map(|(f, value)| FactorRecord {
                formula: f.to_string(),
                zero: f.zero(),
                value: number(value),
            })
            .collect(),
        /// Products over all offsets; det A is their difference. Null: some leg is not moved.
        pub products: Option<OffsetProductsRecord> = (steps.products.as_ref())
            .map(|[rest, own]| OffsetProductsRecord { rest: number(rest), own: number(own) }),
        /// Check by forward kinematics, solved independently, and the leg map from one to the other.
        pub verification: VerifyAnswer = verification,
    }
    /// The steps, with the names that joints have in the class, and the verification of the platform they make.
    pub fn new(steps: &Derivation, original: &Original, verification: VerifyAnswer) {
        let number = |x: &Algebraic| ExactNumberRecord {
            value: Number(x.approximate()),
            exact: steps.exact.then(|| x.to_string()),
        };
        let record = |step: &LegSlide| LegSlideRecord::of(step, original, &number);
    }
}

view! {
    /// One leg that moves along the line of two legs with a joint in common. X, Y, Q and F are in one plane at every
    /// pose.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct LegSlideRecord {
        /// Moved leg.
        pub leg: usize = step.leg + 1,
        /// Legs X F and Y F, from 1.
        pub between: [usize; 2] = step.between.map(|leg| leg + 1),
        /// The names of X and Y.
        pub ends: [String; 2] = step.ends.map(|j| original.joint_name(j)),
        /// New joint Q: Q = X + t (Y - X).
        pub moved: String = original.joint_name(step.moved),
        /// The name of F, the joint that the leg keeps.
        pub fixed: String = original.joint_name(step.fixed),
        /// The offset t: s' = (1 - t) s(X F) + t s(Y F) - t (1 - t) d^2.
        pub offset: ExactNumberRecord = number(&step.share),
        /// 1 - t.
        pub rest: ExactNumberRecord = number(&step.rest()),
        /// Squared edge d^2 = |XY|^2, design units squared.
        pub square: ExactNumberRecord = number(&step.square),
        /// |XQ|^2 and |YQ|^2, design units squared.
        pub squares_to_ends: [ExactNumberRecord; 2] = step.squares_to_ends().each_ref().map(number),
        /// The entry of c: -t (1 - t) d^2, design units squared.
        pub constant: ExactNumberRecord = number(&step.constant()),
    }
    fn of(step: &LegSlide, original: &Original, number: &dyn Fn(&Algebraic) -> ExactNumberRecord) {}
}

/// A factor of det A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FactorRecord {
    /// Formula in the offsets, such as 1 - t1.
    pub formula: String,
    /// Equation of zeros; the platform is architecturally singular there.
    pub zero: String,
    /// Value at the offsets.
    pub value: ExactNumberRecord,
}

/// Products over the six offsets of the platform without shared joints.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OffsetProductsRecord {
    /// Product of all 1 - t.
    pub rest: ExactNumberRecord,
    /// Product of all t.
    pub own: ExactNumberRecord,
}

/// A number, exact or as a double.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ExactNumberRecord {
    /// The nearest double.
    pub value: Number,
    /// Number as an exact expression, such as 4/5 or 1/2 + sqrt(3)/6; null: known only as a double.
    pub exact: Option<String>,
}

impl DerivationRecord {
    /// The steps to an equivalent platform, with forward kinematics of both platforms at sample poses, and the leg map
    /// of the two; `None` where an edge of the original has no length.
    ///
    /// # Errors
    /// The comparison gives these ([`ComparedDesigns::of`]).
    pub fn compared(
        original: &Original,
        pattern: &Pattern,
        built: &Design,
        options: &FkOptions,
    ) -> Result<Option<(Self, LegMapOutcome)>, VerifyError> {
        let Some(steps) = original.derivation(pattern, built) else { return Ok(None) };
        let compared = ComparedDesigns::of([&original.design, built], SAMPLES, options)?;
        Ok(Some((Self::new(&steps, original, VerifyAnswer::from(&compared)), compared.found.map)))
    }
}
