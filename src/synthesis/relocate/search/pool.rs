//! The possible origins of legs of an equivalent platform, and the patterns: numbers of legs from each origin such that
//! six generic legs are independent.

use super::candidate::LegSource;
use super::targets::{CheckedHole, Hole, HoleAnswer, Targets};
use crate::components::{Component, Components, MovingPoint, Parametrisation};
use num::Rng;
use num::linalg::LinalgError;
use platform::manipulator::{Body, Leg, LegIndex, Manipulator};

/// An origin, with generic legs from it.
#[derive(Debug)]
pub(super) struct LegOrigin {
    pub(super) source: LegSource,
    pub(super) formulas: Parametrisation,
    /// Holes that contain an end of its legs.
    fills: Vec<usize>,
    /// The legs whose vectors span those of its legs, exactly; `None` if known only within a tolerance.
    support: Option<Vec<LegIndex>>,
    /// Generic legs, as many as the pattern may take from this origin.
    pub(super) generic: Vec<(Leg, [f64; 6])>,
}

/// All origins: the six legs, the largest families, the legs through holes.
#[derive(Debug)]
pub(super) struct LegPool<'a> {
    pub(super) places: Vec<LegOrigin>,
    /// Whether generic legs of every family could be drawn.
    pub(super) drawn: bool,
    found: &'a Components,
}

fn fixed(leg: &Leg) -> Parametrisation {
    let at = |p: [f64; 3]| MovingPoint { terms: vec![([0, 0, 0], [1.0, p[0], p[1], p[2]])] };
    Parametrisation::Rational {
        parameters: 0,
        base: at(leg.base.coords.into()),
        platform: at(leg.platform.coords.into()),
    }
}

impl LegOrigin {
    /// Whether the base (or platform) end of all its legs is one joint of the platform, exactly.
    fn holds_joint(&self, platform_end: bool) -> bool {
        let constant = match &self.formulas {
            Parametrisation::Rational { base, platform, .. } => {
                let end = if platform_end { platform } else { base };
                end.terms.iter().all(|(exponents, _)| *exponents == [0; 3])
            }
            Parametrisation::Cubic(_) => false,
        };
        constant && self.support.is_some()
    }
}

impl<'a> LegPool<'a> {
    pub(super) fn new(
        m: &Manipulator,
        found: &'a Components,
        targets: &Targets,
        records: &[CheckedHole],
        rng: &mut Rng,
    ) -> Result<Self, LinalgError> {
        let mut pool = Self { places: Vec::new(), drawn: true, found };
        let limit = found.options.tolerance * m.size();
        let legs = m.legs();
        for leg in LegIndex::all() {
            let ends = legs[leg.get()];
            let fits = |(_, h): &(usize, &Hole)| {
                (ends.end(h.body) - h.point).norm() <= limit && (h.legs.is_empty() || h.legs.contains(&leg))
            };
            let fills = targets.holes.iter().enumerate().filter(fits).map(|(k, _)| k).collect();
            pool.add(LegSource::Kept(leg), fixed(&ends), fills, 1, rng)?;
        }
        for (k, hole) in records.iter().enumerate() {
            if let HoleAnswer::Legs { formulas, .. } = &hole.answer {
                pool.add(LegSource::Hole(k), formulas.clone(), vec![k], 1, rng)?;
            }
        }
        // one leg with both ends in holes
        for (k, l) in (0..records.len()).flat_map(|k| (0..records.len()).map(move |l| (k, l))) {
            let (a, b) = (&targets.holes[k], &targets.holes[l]);
            if a.body != Body::Base || b.body != Body::Platform {
                continue;
            }
            let leg = Leg { base: a.point, platform: b.point };
            if found.span.distance(&leg) <= found.options.tolerance {
                pool.add(LegSource::Holes(k, l), fixed(&leg), vec![k, l], 1, rng)?;
            }
        }
        for (k, family) in found.components.iter().enumerate().filter(|(_, c)| c.contained_in.is_empty()) {
            pool.add(LegSource::Family(k), family.parametrisation.clone(), Vec::new(), 6, rng)?;
        }
        Ok(pool)
    }

    fn add(
        &mut self,
        source: LegSource,
        formulas: Parametrisation,
        fills: Vec<usize>,
        copies: usize,
        rng: &mut Rng,
    ) -> Result<(), LinalgError> {
        let support = match source {
            LegSource::Kept(leg) => Some(vec![leg]),
            LegSource::Family(k) => {
                let family = self.found.components.get(k).filter(|f| f.exact == Some(true));
                family.map(|f| f.support.clone())
            }
            LegSource::Hole(_) | LegSource::Holes(..) => None,
        };
        let mut place = LegOrigin { source, formulas, fills, support, generic: Vec::new() };
        for _ in 0..copies {
            let x = self.draw_place(&place, rng)?;
            if let Some(leg) = place.formulas.leg_at(&x)? {
                place.generic.push((leg, self.found.span.coefficients(&leg)));
            }
        }
        self.drawn &= place.generic.len() == copies;
        if !place.generic.is_empty() {
            self.places.push(place);
        }
        Ok(())
    }

    /// The first hole whose legs cannot replace any of the legs named for it.
    pub(super) fn not_by_those_legs(&self, holes: &[Hole]) -> Option<usize> {
        let replaces = |place: &LegOrigin, hole: &Hole| {
            let generic = place.generic.iter();
            hole.legs.is_empty()
                || generic.flat_map(|(_, c)| hole.legs.iter().map(|l| c[l.get()])).any(|c| c.abs() > 1e-9)
        };
        (0..holes.len()).find(|k| !self.places.iter().any(|p| p.fills.contains(k) && replaces(p, &holes[*k])))
    }

    fn family(&self, source: LegSource) -> Option<&Component> {
        match source {
            LegSource::Family(k) => self.found.components.get(k),
            _ => None,
        }
    }

    fn draw_place(&self, place: &LegOrigin, rng: &mut Rng) -> Result<Vec<f64>, LinalgError> {
        if let Some(family) = self.family(place.source) {
            return Ok(family.sample(&self.found.span, rng)?.map_or(Vec::new(), |s| s.parameters));
        }
        Ok((0..place.formulas.parameters()).map(|_| rng.uniform(-1.5, 1.5)).collect())
    }

    /// Random parameters of all legs of a pattern, in order.
    pub(super) fn draw(&self, pattern: &JointPattern, rng: &mut Rng) -> Result<Vec<f64>, LinalgError> {
        let mut x = Vec::new();
        for k in pattern.places {
            let place = &self.places[k];
            let mut own = self.draw_place(place, rng)?;
            own.resize(place.formulas.parameters(), 0.5);
            x.extend(own);
        }
        Ok(x)
    }

    /// Number of parameters of a pattern.
    pub(super) fn parameters(&self, pattern: &JointPattern) -> usize {
        pattern.places.iter().map(|k| self.places[*k].formulas.parameters()).sum()
    }

    /// The six legs at the parameters; `None` if one of them does not exist.
    pub(super) fn legs(&self, pattern: &JointPattern, x: &[f64]) -> Result<Option<[Leg; 6]>, LinalgError> {
        let mut out = Vec::with_capacity(6);
        let mut at = 0;
        for k in pattern.places {
            let formulas = &self.places[k].formulas;
            let n = formulas.parameters();
            match formulas.leg_at(&x[at..at + n])? {
                Some(leg) => out.push(leg),
                None => return Ok(None),
            }
            at += n;
        }
        Ok(<[Leg; 6]>::try_from(out).ok())
    }
}

/// Six origins, in the order of the pool.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct JointPattern {
    /// Indices of origins.
    pub(super) places: [usize; 6],
    /// Legs that share a base joint for all parameters.
    pub(super) same_base: [[bool; 6]; 6],
    /// Legs that share a platform joint for all parameters.
    pub(super) same_platform: [[bool; 6]; 6],
    /// Number of joints with two legs or more.
    pub(super) shared: usize,
}

/// Greatest number of patterns; beyond it nothing is proved impossible. No known platform has a tenth of it.
const MOST: usize = 50_000;
/// Greatest distance of a generic leg from the span of others that counts as dependent, for unit vectors.
const INDEPENDENT: f64 = 1e-7;
/// Ends of generic legs within this distance, relative to the size, are one joint.
const SAME: f64 = 1e-8;

/// The patterns found.
#[derive(Debug)]
pub(super) struct Patterns {
    /// Patterns that fill every hole.
    pub(super) list: Vec<JointPattern>,
    /// Whether the list is complete: neither the limit nor floating point alone excluded a pattern, and no two joints
    /// were identified by distance alone.
    pub(super) exhaustive: bool,
}

struct Growing<'a> {
    pool: &'a LegPool<'a>,
    list: Vec<JointPattern>,
    size: f64,
    exhaustive: bool,
}

/// All patterns that fill every hole.
pub(super) fn patterns(pool: &LegPool, targets: &Targets, size: f64) -> Patterns {
    let mut growing = Growing { pool, list: Vec::new(), size, exhaustive: true };
    growing.grow(0, &mut Vec::new(), &mut Vec::new());
    let all = targets.holes.len();
    growing.list.retain(|p| (0..all).all(|h| p.places.iter().any(|k| pool.places[*k].fills.contains(&h))));
    Patterns { list: growing.list, exhaustive: growing.exhaustive }
}

/// Whether legs from these origins are dependent for all parameters: some of them have their vectors in the span of
/// fewer legs of the platform. This is the easy half of Rado's theorem on independent transversals (1942). The test is
/// exact, without any numbers.
fn always_dependent(supports: &[Option<&Vec<LegIndex>>]) -> bool {
    (1..1_u32 << supports.len()).any(|mask| {
        let part: Vec<_> = (0..supports.len()).filter(|i| mask >> i & 1 == 1).map(|i| supports[i]).collect();
        let spanning = LegIndex::all().filter(|l| part.iter().flatten().any(|s| s.contains(l))).count();
        part.iter().all(Option::is_some) && spanning < part.len()
    })
}

impl Growing<'_> {
    /// Adds legs from the origins `from..` to those chosen; `basis` is orthonormal and spans their coefficient vectors.
    fn grow(&mut self, from: usize, chosen: &mut Vec<(usize, Leg)>, basis: &mut Vec<[f64; 6]>) {
        if self.list.len() >= MOST {
            self.exhaustive = false;
            return;
        }
        if chosen.len() == 6 {
            self.close(chosen);
            return;
        }
        for k in from..self.pool.places.len() {
            let copy = chosen.iter().filter(|(l, _)| *l == k).count();
            let Some((leg, c)) = self.pool.places[k].generic.get(copy) else { continue };
            let Some(rest) = outside(c, basis) else {
                let supports: Vec<_> = chosen.iter().map(|(l, _)| *l).chain([k]).collect();
                let supports: Vec<_> =
                    supports.iter().map(|l| self.pool.places[*l].support.as_ref()).collect();
                self.exhaustive = self.exhaustive && always_dependent(&supports);
                continue;
            };
            chosen.push((k, *leg));
            basis.push(rest);
            self.grow(k, chosen, basis);
            basis.pop();
            chosen.pop();
        }
    }

    fn close(&mut self, chosen: &[(usize, Leg)]) {
        let limit = SAME * self.size;
        let same = |f: &dyn Fn(&Leg) -> nalgebra::Point3<f64>| -> [[bool; 6]; 6] {
            std::array::from_fn(|i| {
                std::array::from_fn(|j| i != j && (f(&chosen[i].1) - f(&chosen[j].1)).norm() <= limit)
            })
        };
        let (same_base, same_platform) = (same(&|l| l.base), same(&|l| l.platform));
        for (ends, table) in [(false, &same_base), (true, &same_platform)] {
            let held = |i: usize| self.pool.places[chosen[i].0].holds_joint(ends);
            self.exhaustive &= (0..6).all(|i| !table[i].contains(&true) || held(i));
        }
        self.list.push(JointPattern {
            places: std::array::from_fn(|i| chosen[i].0),
            shared: shared(&same_base) + shared(&same_platform),
            same_base,
            same_platform,
        });
    }
}

/// Joints with two legs or more: legs with a later, but no earlier partner.
pub(super) fn shared(same: &[[bool; 6]; 6]) -> usize {
    (0..6).filter(|i| same[*i][..*i].iter().all(|x| !x) && same[*i][*i + 1..].iter().any(|x| *x)).count()
}

/// The unit vector of the part outside the span of the basis.
fn outside(c: &[f64; 6], basis: &[[f64; 6]]) -> Option<[f64; 6]> {
    let norm = |v: &[f64; 6]| v.iter().map(|x| x * x).sum::<f64>().sqrt();
    let length = norm(c);
    let mut rest = c.map(|x| x / length);
    for _ in 0..2 {
        for e in basis {
            let along: f64 = rest.iter().zip(e).map(|(x, y)| x * y).sum();
            rest.iter_mut().zip(e).for_each(|(x, y)| *x -= along * y);
        }
    }
    let left = norm(&rest);
    (left > INDEPENDENT).then(|| rest.map(|x| x / left))
}
