//! Who wins, from values that the same judge gave.

use std::fmt;

/// Values within this share of each other count as equal.
pub(crate) const TOLERANCE: f64 = 1e-6;

/// The judge on one answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Judged {
    pub(crate) value: f64,
    /// 0 when every requirement is met.
    pub(crate) violation: f64,
}

/// The optimiser's answer against a rival's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Verdict {
    /// Better by this share.
    Beats(f64),
    /// Within [`TOLERANCE`], by this share.
    Equals(f64),
    /// Worse by this share.
    Loses(f64),
    /// The rival has no feasible answer.
    Unopposed,
    /// The optimiser has none that the judge accepts, and the rival has.
    NoAnswer,
}

impl Verdict {
    /// `ours` and `rival` are `None` where there is no answer; one with a violation is none, and NaN is no value.
    pub(crate) fn of(ours: Option<Judged>, rival: Option<Judged>) -> Self {
        let accepted = |j: &Judged| j.violation <= 0.0 && j.value.is_finite();
        let (Some(rival), ours) = (rival.filter(accepted), ours.filter(accepted)) else {
            return Self::Unopposed;
        };
        let Some(ours) = ours else { return Self::NoAnswer };
        // costs are negative values
        let gain = (ours.value - rival.value) / rival.value.abs().max(f64::MIN_POSITIVE);
        if gain > TOLERANCE {
            Self::Beats(gain)
        } else if gain >= -TOLERANCE {
            Self::Equals(gain)
        } else {
            Self::Loses(-gain)
        }
    }

    pub(crate) fn is_loss(self) -> bool {
        matches!(self, Self::Loses(_) | Self::NoAnswer)
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Beats(gain) => write!(f, "beats by {gain:.1e}"),
            Self::Equals(gain) => write!(f, "equals ({gain:+.0e})"),
            Self::Loses(loss) => write!(f, "LOSES by {loss:.1e}"),
            Self::Unopposed => f.write_str("rival without a feasible answer"),
            Self::NoAnswer => f.write_str("NO ANSWER"),
        }
    }
}
