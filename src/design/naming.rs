//! Requirements in the words of a design.

use super::Design;
use crate::requirements::{Quantity, Term, TermKind};

impl Design {
    /// Leg, joint, keep-out and load names of a requirement.
    pub(crate) fn names_of(&self, term: Term) -> Vec<String> {
        let leg = |i: usize| format!("leg {}", i + 1);
        let joints = |names: &[String]| vec![names[term.first].clone(), names[term.second].clone()];
        match term.kind {
            TermKind::BaseSpacing => joints(self.base_names()),
            TermKind::PlatformSpacing => joints(self.platform_names()),
            TermKind::LegClearance => vec![leg(term.first), leg(term.second)],
            TermKind::KeepOut => vec![leg(term.first), self.keep_outs[term.second].name.clone()],
            TermKind::LegForce => vec![leg(term.first), self.loads[term.second].name.clone()],
            _ => vec![leg(term.first)],
        }
    }

    /// The unit of a margin.
    pub(crate) fn unit_of(&self, quantity: Quantity) -> String {
        match quantity {
            Quantity::Length => self.units.clone(),
            Quantity::Angle => "deg".to_string(),
            Quantity::Force => "force".to_string(),
            Quantity::Speed => format!("{}/s", self.units),
        }
    }
}
