//! Further freedoms that may resolve a conflict.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::{AssessAnswer, DesignRecord, DesignRoleWord, Number};
use ask::Design;
use ask::{ConflictFreedom, FreedomWord, OpenedFreedom, RelaxedRequirement};
use optimize::offsets::DEFAULT_MIN_ABS_DET;

view! {
    /// A freedom that the design does not allow, and the result of the search with it.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct FreedomRecord {
        /// The freedom.
        pub freedom: ConflictFreedom = opened.freedom,
        /// The outcome of the search.
        pub outcome: FreedomWord = outcome,
        /// Relaxation of the limit in the last search, or by which the platform found is higher; null: no such number.
        pub amount: Option<Number> = opened.amount.map(Number),
        /// Unit.
        pub unit: String = design.units.clone(),
        /// Result in words.
        pub message: String = message(design, opened, outcome),
        /// Result of `assess`; null: none was found.
        pub assessment: Option<AssessAnswer> = found.and_then(|c| {
            c.assessed
                .as_ref()
                .map(|a| AssessAnswer::new(&c.design, a).with_role(DesignRoleWord::Optimised))
        }),
        /// The platform found, with the relaxed limit; null: none was found.
        pub design: Option<DesignRecord> = found.map(|c| (&c.design).into()),
        /// The design file written; null: none.
        pub output: Option<String> = output.map(str::to_owned),
    }
    /// The record of a freedom of a design.
    pub fn new(design: &Design, opened: &OpenedFreedom, output: Option<&str>) {
        let (outcome, found) = (opened.outcome.word(), opened.outcome.found());
    }
}

fn message(design: &Design, opened: &OpenedFreedom, outcome: FreedomWord) -> String {
    let by = |x: f64| format!("{} {}", super::conflict::amount(x.abs()), design.units);
    let (tried, amount) = (outcome == FreedomWord::Unresolved, opened.amount);
    let wider = |body: &str| match amount {
        Some(x) if tried => format!("an envelope of the {body} wider by up to {} on every side", by(x)),
        Some(x) => format!("an envelope of the {body} wider by {} on every side", by(x)),
        None => format!("a wider envelope of the {body}"),
    };
    let plate = |body: &str| match amount {
        Some(x) if tried => format!("a plate of the {body} wider by up to {} on every side", by(x)),
        Some(x) => format!("a plate of the {body} wider by {} on every side", by(x)),
        None => format!("a wider plate of the {body}"),
    };
    let what = match opened.freedom {
        ConflictFreedom::HomeHeight => match amount {
            Some(x) if x < 0.0 => format!("home lower by {}", by(x)),
            Some(x) => format!("home higher by {}", by(x)),
            None => "another height of home".to_owned(),
        },
        ConflictFreedom::TriangleSizes => "other sizes of base and platform".to_owned(),
        ConflictFreedom::Triangles => "other shapes of the triangles".to_owned(),
        ConflictFreedom::Stroke => match amount {
            Some(x) if tried => format!("a stroke longer by up to {}", by(x)),
            Some(x) => format!("a stroke longer by {}", by(x)),
            None => "a longer stroke".to_owned(),
        },
        ConflictFreedom::BaseEnvelope => wider("base"),
        ConflictFreedom::PlatformEnvelope => wider("platform"),
        ConflictFreedom::MachineEnvelope => wider("machine"),
        ConflictFreedom::MinAbsDet => "no least |det A| (the default of the search)".to_owned(),
        ConflictFreedom::BaseMargin => plate("base"),
        ConflictFreedom::PlatformMargin => plate("platform"),
    };
    match outcome {
        FreedomWord::Resolved => {
            format!("with {what}, the requirements can be met: proved for the platform found")
        }
        FreedomWord::Undecided => format!(
            "with {what}, the platform found violates no requirement at the sampled poses; not all is proved"
        ),
        FreedomWord::Unresolved if !opened.eased.is_empty() => {
            let less = |e: &RelaxedRequirement| {
                let (name, unit) = super::conflict::words(design, e.demand);
                let [to, from] = [e.to, e.from].map(super::conflict::amount);
                format!("{name}: relax it by {to} {unit} instead of {from} {unit}")
            };
            let list: Vec<String> = opened.eased.iter().map(less).collect();
            format!(
                "|det A| >= {DEFAULT_MIN_ABS_DET}, a default of the search, is part of the conflict. Without it, {}",
                list.join(", ")
            )
        }
        FreedomWord::Unresolved => format!("{what} alone did not resolve the conflict from any start"),
        FreedomWord::NotTried => format!("{what} was not tried, because the search was interrupted"),
    }
}
