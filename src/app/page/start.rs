//! The default starting offsets of a page.

use super::session::{InvalidStart, Session};
use ask::equivalents::Original;
use machine::requirements::{Requirements, Standing, Terms};
use platform::manipulator::{Body, inverse_condition, jacobian};
use synthesis::{Offset, Pattern, sliding_body};

/// Offsets to try, equal on all edges of a body.
const SHARES: [f64; 12] = [0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.65, 0.7, 0.75, 0.8, 0.85, 0.9];
/// The share by which the conditioning must improve, since mirrored platforms differ by rounding.
const BETTER: f64 = 1e-9;

/// The quality of offsets: numbers of violated requirements and of requirements at their limit, and the inverse
/// condition number at home.
type StartWorth = ([usize; 2], f64);

impl Session {
    /// Regular offsets of a pattern: one value on the edges of the base, one on the edges of the platform. A second
    /// joint of an edge is as far from its other end. The choice has the fewest violated requirements (of the file at
    /// home, joint distance and `det A`). Ties are broken by the fewest at their limit, then by the best conditioning
    /// at home.
    pub(super) fn first_offsets(&self, pattern: &Pattern) -> Result<Vec<f64>, InvalidStart> {
        let original = self.original.as_ref().ok_or(InvalidStart::NoOriginal)?;
        let mut required = self.design.requirements();
        required.min_joint_distance.get_or_insert(self.limits.0);
        let mut best: Option<(StartWorth, Vec<f64>)> = None;
        for (base, platform) in SHARES.into_iter().flat_map(|b| SHARES.map(|p| (b, p))) {
            let offsets = regular(pattern, base, platform);
            let (trouble, conditioning) = self.worth(original, &required, pattern, &offsets)?;
            let better = |((other, least), _): &(StartWorth, Vec<f64>)| {
                trouble < *other || (trouble == *other && conditioning > least * (1.0 + BETTER))
            };
            if best.as_ref().is_none_or(better) {
                best = Some(((trouble, conditioning), offsets));
            }
        }
        Ok(best.map(|b| b.1).unwrap_or_default())
    }

    fn worth(
        &self,
        original: &Original,
        required: &Requirements,
        pattern: &Pattern,
        offsets: &[f64],
    ) -> Result<StartWorth, InvalidStart> {
        let m = pattern.instantiate(&original.octahedral, offsets)?;
        let terms = Terms::new(&m, required, &self.home);
        let fixed = terms.fixed().into_iter().map(|(term, x)| terms.standing(term.kind, x, None));
        let at_home = terms.at(&self.home);
        let at_home = at_home.iter().map(|(term, x)| terms.standing(term.kind, *x, Some(&self.home)));
        let standings: Vec<Standing> = fixed.chain(at_home).collect();
        let count = |standing| standings.iter().filter(|s| **s == standing).count();
        let singular = pattern.determinant(offsets)?.abs() < self.limits.1;
        let violated = count(Standing::Violated) + usize::from(singular);
        let conditioning =
            inverse_condition(&jacobian(&m, &self.home, original.design.characteristic_length()));
        Ok(([violated, count(Standing::AtLimit)], conditioning))
    }
}

fn regular(pattern: &Pattern, base: f64, platform: f64) -> Vec<f64> {
    let value = |o: &Offset| {
        let share = if sliding_body(o.side) == Body::Base { base } else { platform };
        if o.second { 1.0 - share } else { share }
    };
    pattern.offsets().iter().map(value).collect()
}
