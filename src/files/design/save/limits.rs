//! `[limits]` and `[envelope]`.

use serde::Serialize;

use machine::requirements::{Envelope, Envelopes, Reserve, Reserves, TermKind};

/// A percentage, or an amount.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum ReserveValue {
    Percent(String),
    Amount(f64),
}

impl ReserveValue {
    pub(super) fn percent(x: f64) -> Self {
        Self::Percent(format!("{x}%"))
    }
}

/// `[limits]`.
#[derive(Serialize)]
pub(super) struct LimitsFile {
    reserve: ReservesTable,
}

/// One for every limit, or a table.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum ReservesTable {
    All(ReserveValue),
    Kinds(std::collections::BTreeMap<&'static str, ReserveValue>),
}

impl LimitsFile {
    pub(super) fn of(reserves: &Reserves) -> Option<Self> {
        if reserves.is_empty() {
            return None;
        }
        if let (Some(all), true) = (reserves.all, reserves.kinds.is_empty()) {
            return Some(Self { reserve: ReservesTable::All(ReserveValue::percent(all)) });
        }
        let own = reserves.kinds.iter().map(|(kind, r)| {
            let value = match r {
                Reserve::Percent(x) => ReserveValue::percent(*x),
                Reserve::Amount(x) => ReserveValue::Amount(*x),
            };
            (TermKind::code(*kind), value)
        });
        let all = reserves.all.map(|x| ("all", ReserveValue::percent(x)));
        Some(Self { reserve: ReservesTable::Kinds(own.chain(all).collect()) })
    }
}

/// A shape of `[envelope]`.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum EnvelopeValue {
    Cylinder { radius: f64, center: [f64; 2] },
    Box { min: [f64; 3], max: [f64; 3] },
}

/// `[envelope]`.
#[derive(Serialize)]
pub(super) struct EnvelopesTable {
    #[serde(skip_serializing_if = "Option::is_none")]
    base: Option<EnvelopeValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    platform: Option<EnvelopeValue>,
    #[serde(skip_serializing_if = "Option::is_none")]
    machine: Option<EnvelopeValue>,
}

impl EnvelopesTable {
    pub(super) fn of(e: &Envelopes) -> Option<Self> {
        let value = |e: Envelope| match e {
            Envelope::Cylinder { radius, center } => EnvelopeValue::Cylinder { radius, center },
            Envelope::Box { min, max } => {
                EnvelopeValue::Box { min: min.coords.into(), max: max.coords.into() }
            }
        };
        (*e != Envelopes::default()).then(|| Self {
            base: e.base.map(value),
            platform: e.platform.map(value),
            machine: e.machine.map(value),
        })
    }
}
