//! The verdict of a result, in a word.

use serde_json::{Map, Value};

/// The verdict of a result.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ResultVerdict {
    /// The word of the result itself, for instance `equivalent`.
    pub word: String,
    /// Yes, no, or neither.
    pub holds: Option<bool>,
    /// The explanation with the numbers that decided, if the result has one.
    pub explanation: Option<String>,
}

/// Words of the commands for yes.
const YES: [&str; 10] = [
    "equivalent",
    "optimal",
    "best_found",
    "feasible",
    "front",
    "regular",
    "proved",
    "met",
    "found",
    "identical",
];
/// Words of the commands for no.
const NO: [&str; 8] = [
    "not_equivalent",
    "not equivalent",
    "infeasible",
    "impossible",
    "singular",
    "not_realizable",
    "violated",
    "none",
];

/// The verdict, if the result has one.
pub(super) fn verdict(fields: &Map<String, Value>) -> Option<ResultVerdict> {
    let text = |key: &str| fields.get(key).and_then(Value::as_str).map(str::to_owned);
    let explanation = text("explanation").or_else(|| text("completeness_reason"));
    if let Some(met) = fields.get("met").and_then(Value::as_bool) {
        let word = if met { "met" } else { "violated" };
        return Some(ResultVerdict { word: word.into(), holds: Some(met), explanation });
    }
    if fields.contains_key("met") && fields.get("requirements").is_some_and(Value::is_array) {
        return Some(ResultVerdict { word: "undecided".into(), holds: None, explanation });
    }
    if let Some(singular) =
        fields.get("architecturally_singular").filter(|_| fields.contains_key("singular_as_written"))
    {
        let (word, holds) = match singular.as_bool() {
            Some(true) => ("architecturally singular", Some(false)),
            Some(false) => ("regular", Some(true)),
            None => ("undecided", None),
        };
        return Some(ResultVerdict { word: word.into(), holds, explanation });
    }
    let word =
        ["verdict", "status", "relation", "outcome"].iter().find_map(|key| text(key)).or_else(|| {
            let count = |key: &str| fields.get(key).and_then(Value::as_u64);
            Some(format!("{} finite poses, {} real", count("finite_count")?, count("real_count")?))
        })?;
    let holds = match word.as_str() {
        w if YES.contains(&w) => Some(true),
        w if NO.contains(&w) => Some(false),
        _ => fields.get("completeness").and_then(Value::as_str).filter(|c| *c == "proved").map(|_| true),
    };
    Some(ResultVerdict { word: word.replace('_', " "), holds, explanation })
}
