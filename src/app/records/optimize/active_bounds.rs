//! The active bounds of a platform: limits and ends of ranges with almost no margin.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::nearest::short;
use crate::{MarginRecord, Number};
use ask::Checked;
use ask::Design;
use machine::requirements::TermKind;
use num::shown::rounded;
use optimize::dimensional::ChosenVariable;
use platform::manipulator::Body;

/// A margin below this share of its limit counts as zero.
const NOTHING: f64 = 1e-3;
/// A variable this near to an end of its range, as a share of the range, counts as at the end.
const AT_END: f64 = 1e-6;
/// The growth above which a body is named.
const GROWN: f64 = 1.2;

/// The active bounds of a platform, and the growth of its bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ActiveBoundsRecord {
    /// Active bounds.
    pub bounds: Vec<ActiveBoundRecord>,
    /// Growth factor of the base: greatest distance of a base joint from the centre of the base joints, divided by its
    /// value in the design.
    pub base_growth: Number,
    /// Growth factor of the platform: greatest distance of a platform joint from the centre of the platform joints,
    /// divided by its value in the design.
    pub platform_growth: Number,
    /// Bounds in words.
    pub message: String,
}

/// An active bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ActiveBoundRecord {
    /// Variable or requirement, or `abs_det`.
    pub name: String,
    /// The kind of bound.
    pub kind: ActiveBoundWord,
    /// Value of the variable, or margin.
    pub value: Number,
    /// Unit; empty for a pure number.
    pub unit: String,
}

/// The kind of an active bound.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ActiveBoundWord {
    /// The end of the range of a variable.
    Range,
    /// The limit itself.
    Limit,
    /// The safety margin on the limit, which is kept.
    SafetyMargin,
}

/// `|det A|` of a platform beyond the least value, this least value, and the safety margin on it.
#[derive(Debug, Clone, Copy)]
pub(super) struct DetMargin {
    pub(super) left: f64,
    pub(super) least: f64,
    pub(super) safety_margin: f64,
}

impl ActiveBoundsRecord {
    /// The active bounds of a platform found for a design; `None` if there are none and no body has grown.
    pub(super) fn new(
        design: &Design,
        c: &Checked,
        variables: &[ChosenVariable],
        margins: &[MarginRecord],
        det: Option<DetMargin>,
    ) -> Option<Self> {
        let mut bounds: Vec<ActiveBoundRecord> = variables.iter().filter_map(at_end).collect();
        let required = c.design.requirements();
        for m in margins.iter().filter(|m| !m.violates()) {
            let whole = Some(required.whole(m.name)).filter(|x| *x > 0.0);
            let scale = whole.unwrap_or_else(|| c.design.manipulator().size());
            let kind =
                if m.safety_margin.0 > 0.0 { ActiveBoundWord::SafetyMargin } else { ActiveBoundWord::Limit };
            if m.net_margin.0 <= NOTHING * scale {
                let (name, unit) = (m.name.code().to_owned(), m.unit.clone());
                bounds.push(ActiveBoundRecord { name, kind, value: m.margin, unit });
            }
        }
        if let Some(d) = det.filter(|d| d.left - d.safety_margin <= NOTHING * d.least) {
            let kind =
                if d.safety_margin > 0.0 { ActiveBoundWord::SafetyMargin } else { ActiveBoundWord::Limit };
            let (name, value) = ("abs_det".to_owned(), Number(d.left));
            bounds.push(ActiveBoundRecord { name, kind, value, unit: String::new() });
        }
        let growth = Body::BOTH.map(|body| c.design.radius(body) / design.radius(body));
        let grown: Vec<String> = Body::BOTH
            .into_iter()
            .filter(|body| growth[body.index()] > GROWN)
            .map(|body| format!("the {body} is {} times as wide", rounded(growth[body.index()], 3)))
            .collect();
        if bounds.is_empty() && grown.is_empty() {
            return None;
        }
        let message = message(&bounds, &grown);
        let [base_growth, platform_growth] = growth.map(Number);
        Some(Self { bounds, base_growth, platform_growth, message })
    }
}

/// A variable at an end of its range.
fn at_end(v: &ChosenVariable) -> Option<ActiveBoundRecord> {
    let [low, high] = v.bounds;
    let left = (v.value - low).min(high - v.value);
    let range = high - low;
    (range.is_finite() && range > 0.0 && left <= AT_END * range).then(|| ActiveBoundRecord {
        name: v.name.clone(),
        kind: ActiveBoundWord::Range,
        value: Number(v.value),
        unit: String::new(),
    })
}

/// A requirement as people call it, anything else by its name.
fn said(name: &str) -> &str {
    TermKind::ALL.into_iter().find(|kind| kind.code() == name).map_or(name, |kind| kind.label())
}

fn message(bounds: &[ActiveBoundRecord], grown: &[String]) -> String {
    let mut parts: Vec<String> = Vec::new();
    let ends: Vec<&ActiveBoundRecord> = bounds.iter().filter(|b| b.kind == ActiveBoundWord::Range).collect();
    let mut values: Vec<String> = ends.iter().map(|b| short(b.value.0)).collect();
    values.sort();
    values.dedup();
    for value in values {
        let names: Vec<&str> =
            ends.iter().filter(|b| short(b.value.0) == value).map(|b| b.name.as_str()).collect();
        let their = if names.len() == 1 { "its" } else { "their" };
        parts.push(format!("{} = {value} (end of {their} range)", names.join(", ")));
    }
    for b in bounds.iter().filter(|b| b.kind != ActiveBoundWord::Range) {
        let what =
            if b.kind == ActiveBoundWord::SafetyMargin { "its safety margin" } else { "no safety margin" };
        let left = format!("{} {}", short(b.value.0), b.unit);
        parts.push(format!("{} ({} left, {what})", said(&b.name), left.trim_end()));
    }
    let active = if parts.is_empty() { None } else { Some(format!("active limits: {}", parts.join(", "))) };
    let all: Vec<String> = active.into_iter().chain(grown.iter().cloned()).collect();
    format!("{}; `safety_margin` in [limits] sets safety margins, [envelope] bounds the size", all.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(name: &str, value: f64) -> ChosenVariable {
        let bounds = [-0.3, 1.3];
        ChosenVariable { name: name.into(), start: 0.0, value, bounds }
    }

    #[test]
    fn ends_of_ranges_are_named_together_and_inner_ones_are_not() {
        let all =
            [variable("t1", -0.3), variable("t2", 0.2), variable("t3", -0.3 + 1e-8), variable("t4", 1.3)];
        let bounds: Vec<ActiveBoundRecord> = all.iter().filter_map(at_end).collect();
        assert_eq!(bounds.iter().map(|b| b.name.as_str()).collect::<Vec<_>>(), ["t1", "t3", "t4"]);
        let text = message(&bounds, &["the base is 2.6 times as wide".to_owned()]);
        assert!(text.contains("t1, t3 = -0.3 (end of their range), t4 = 1.3 (end of its range)"), "{text}");
        assert!(
            text.contains("2.6 times") && text.contains("`safety_margin`") && text.contains("[envelope]")
        );
    }

    #[test]
    fn an_endless_range_has_no_end_to_ride_on() {
        let mut free = variable("t1", 5.0);
        free.bounds = [f64::NEG_INFINITY, f64::INFINITY];
        assert_eq!(at_end(&free), None);
    }
}
