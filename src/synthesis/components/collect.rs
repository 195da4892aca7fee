//! Families gathered: each is kept once, with what belongs to it.

use super::component::{Component, SampledLeg, infinite_parameters};
use super::flat::Flat;
use super::found::Found;
use super::pairs::ClosedPair;
use super::search::{NormalisedLeg, Search};
use super::shape::Shape;
use crate::manipulator::LegIndex;
use crate::num::linalg::LinalgError;

impl Search<'_> {
    /// Whether a flat of partners of one point lies in a family of larger dimension.
    pub(super) fn inside_larger(&self, found: &Found) -> bool {
        let Shape::Product { base, platform, .. } = &found.shape else { return false };
        let mut rng = self.rng.clone();
        let mut random =
            |flat: &Flat| flat.axes.iter().fold(flat.origin, |x, e| x + e * rng.uniform(-1.0, 1.0));
        let samples: Vec<_> = (0..4).map(|_| (random(base), random(platform))).collect();
        let inside = |shape: &Shape| samples.iter().all(|(a, b)| shape.distance(a, b) <= self.near());
        self.found.iter().any(|(k, c)| c.dimension > found.shape.dimension() && inside(&k.shape))
    }

    /// Adds a family unless it is there already.
    pub(super) fn add(
        &mut self,
        mut found: Found,
        pair: &ClosedPair,
        exact: Option<bool>,
    ) -> Result<(), LinalgError> {
        found.exact = exact;
        let mut decisions = pair.decisions.clone();
        decisions.append(&mut found.decisions);
        found.decisions = decisions;
        let n = self.normalisation();
        let parametrisation = found.shape.parametrisation(self.ends, &n);
        let mut component = Component {
            kind: found.kind,
            base_span: found.base_span,
            platform_span: found.platform_span,
            dimension: found.shape.dimension(),
            legs: Vec::new(),
            support: Vec::new(),
            at_infinity: infinite_parameters(&parametrisation)?,
            parametrisation,
            exact,
            decisions: found.decisions.clone(),
            contained_in: Vec::new(),
        };
        let samples = self.samples(&component, 4)?;
        for (old, known) in &mut self.found {
            if known.dimension != component.dimension || samples.is_empty() {
                continue;
            }
            let mut same = true;
            for (a, b) in &samples {
                same &= old.shape.distance(a, b) <= (10.0 * self.ends.tolerance).max(1e-8);
            }
            if same {
                if known.exact != Some(true) && exact == Some(true) {
                    (known.exact, old.exact) = (exact, exact);
                }
                return Ok(());
            }
        }
        for leg in LegIndex::all() {
            let (a, b) = (self.ends.base[leg.get()], self.ends.platform[leg.get()]);
            if found.shape.distance(&a, &b) <= self.near() {
                component.legs.push(leg);
            }
        }
        component.support = self.support(&component)?;
        self.found.push((found, component));
        Ok(())
    }

    /// Normalised ends of random legs of a family.
    pub(super) fn samples(
        &mut self,
        component: &Component,
        count: usize,
    ) -> Result<Vec<NormalisedLeg>, LinalgError> {
        let n = self.normalisation();
        let mut out = Vec::new();
        for _ in 0..count {
            if let Some(s) = self.sample(component)? {
                let leg = n.apply(&s.leg);
                out.push((leg.base.coords, leg.platform.coords));
            }
        }
        Ok(out)
    }

    /// A random leg, near the joints where there is one: a family whose fixed end is far out has none.
    fn sample(&mut self, component: &Component) -> Result<Option<SampledLeg>, LinalgError> {
        let near = component.sample(self.span, &mut self.rng)?;
        if near.is_some() { Ok(near) } else { component.sample_within(1e4, self.span, &mut self.rng) }
    }

    fn support(&mut self, component: &Component) -> Result<Vec<LegIndex>, LinalgError> {
        let mut used = [false; 6];
        for _ in 0..3 {
            if let Some(s) = self.sample(component)? {
                let largest = s.coefficients.iter().fold(0.0f64, |m, c| m.max(c.abs()));
                for (u, c) in used.iter_mut().zip(s.coefficients) {
                    *u |= c.abs() > 1e-7 * largest;
                }
            }
        }
        Ok(LegIndex::all().filter(|i| used[i.get()]).collect())
    }
}
