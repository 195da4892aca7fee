//! The legs that can be replaced without changing the platform's kinematics.

use nalgebra::{Point3, Vector3};
use thiserror::Error;

use crate::Design;
use files::plot::{CurveFigure, CurveMark, CurvePanel};
use num::Purpose;
use num::linalg::LinalgError;
use platform::manipulator::LegIndex;
use synthesis::components::{
    Component, ComponentOptions, Components, ComponentsError, FlatPair, PlaneCurve, PlanePair, SampledLeg,
    components, flat_name,
};

/// Number of corresponding points marked in a picture.
const MARKS: usize = 8;

/// The requested families.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ReplaceableOptions {
    /// The threshold for zero, relative to the size of the body, and the seed.
    pub search: ComponentOptions,
    /// Only this family, counted from 0; default: all families.
    pub family: Option<usize>,
    /// Number of random legs of each family.
    pub samples: u64,
}

impl ReplaceableOptions {
    /// Options for all families, without random legs.
    #[must_use]
    pub fn all(search: ComponentOptions) -> Self {
        Self { search, family: None, samples: 0 }
    }

    num::setters! {
        /// Only this family, counted from 0.
        fn family(family: impl Into<Option<usize>>) = family.into();
        /// Number of random legs of each family.
        fn samples(samples: u64) = samples;
    }
}

/// The reason why there are no families.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoReplaceableLegs {
    /// The search failed.
    #[error(transparent)]
    Search(#[from] ComponentsError),
    /// There is no family of that number.
    #[error("{name} has {count} families, there is no number {number}")]
    Family {
        /// The design.
        name: String,
        /// The number of its families.
        count: usize,
        /// The requested number, from 1.
        number: usize,
    },
    /// No legs can be drawn from a family.
    #[error(transparent)]
    Legs(#[from] LinalgError),
}

/// A family with the legs drawn from it.
#[derive(Debug, Clone)]
pub struct ReplaceableFamily {
    /// Its index in the list of all families, from 0.
    pub index: usize,
    /// Random legs.
    pub samples: Vec<SampledLeg>,
}

/// The families of replaceable legs of a design.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct ReplaceableLegs {
    /// All families, with the pairs of flats and the curves in them.
    pub found: Components,
    /// The requested families.
    pub families: Vec<ReplaceableFamily>,
    /// The options of the search.
    pub search: ComponentOptions,
}

impl Design {
    /// The families of legs that can replace legs of the design.
    ///
    /// # Errors
    /// [`NoReplaceableLegs`].
    pub fn replaceable_legs(
        &self,
        options: &ReplaceableOptions,
    ) -> Result<ReplaceableLegs, NoReplaceableLegs> {
        let found = components(self.manipulator(), options.search)?;
        let count = found.components.len();
        let chosen = match options.family {
            None => 0..count,
            Some(k) if k < count => k..k + 1,
            Some(k) => {
                return Err(NoReplaceableLegs::Family { name: self.name.clone(), count, number: k + 1 });
            }
        };
        let mut families = Vec::with_capacity(chosen.len());
        for index in chosen {
            // each family has its own stream, so that `family` does not change the legs
            let mut rng = Purpose::SAMPLED_LEGS.item(options.search.seed, index as u64);
            let mut samples = Vec::new();
            for _ in 0..options.samples {
                samples.extend(found.components[index].sample(&found.span, &mut rng)?);
            }
            families.push(ReplaceableFamily { index, samples });
        }
        Ok(ReplaceableLegs { found, families, search: options.search })
    }
}

impl ReplaceableLegs {
    /// The curves in all pairs of planes, those with the most legs first, or only in `pair`, counted from 0.
    ///
    /// # Errors
    /// There is no such pair of planes.
    pub fn curves(&self, design: &Design, pair: Option<usize>) -> Result<CurveFigure, NoPlanes> {
        let found = &self.found;
        let mut pairs: Vec<&PlanePair> =
            found.planes.iter().filter(|p| pair.is_none_or(|k| k == p.pair)).collect();
        if pairs.is_empty() {
            let name = |(k, p): (usize, &FlatPair)| {
                format!("{} {}-{}", k + 1, flat_name(p.base), flat_name(p.platform))
            };
            return Err(NoPlanes { pairs: found.pairs.iter().enumerate().map(name).collect() });
        }
        pairs.sort_by_key(|p| std::cmp::Reverse(found.pairs[p.pair].legs.len()));
        let title = format!("replaceable legs of {}", design.name);
        let panels = pairs.iter().map(|p| both(design, found, p, self.search.seed)).collect();
        Ok(CurveFigure { title, panels })
    }
}

/// There is no such pair of planes.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("there is no such pair of planes; pairs of flats: {}", pairs.join(", "))]
#[non_exhaustive]
pub struct NoPlanes {
    /// The existing pairs of flats, with their numbers from 1.
    pub pairs: Vec<String>,
}

/// Base and platform of a pair.
fn both(design: &Design, found: &Components, planes: &PlanePair, seed: u64) -> [CurvePanel; 2] {
    let legs = &found.pairs[planes.pair].legs;
    let extra = partners(found, planes, seed);
    let ends = design.manipulator().legs();
    let panel = |curve: &PlaneCurve, platform: bool| {
        let end = |l: &LegIndex| if platform { ends[l.get()].platform } else { ends[l.get()].base };
        let mut marks: Vec<CurveMark> = Vec::new();
        let limit = 1e-9 * curve.axes[0].norm().max(curve.axes[1].norm());
        for l in legs {
            let at = coordinates(curve, &end(l));
            let number = (l.get() + 1).to_string();
            // a shared joint carries the numbers of all its legs
            match marks.iter_mut().find(|m| (m.at[0] - at[0]).hypot(m.at[1] - at[1]) <= limit) {
                Some(mark) => {
                    mark.label.push(' ');
                    mark.label.push_str(&number);
                }
                None => marks.push(CurveMark { at, label: number, joint: true }),
            }
        }
        for (k, (a, b)) in extra.iter().enumerate() {
            let at = coordinates(curve, if platform { b } else { a });
            let near = |m: &&mut CurveMark| !m.joint && (m.at[0] - at[0]).hypot(m.at[1] - at[1]) <= limit;
            match marks.iter_mut().find(near) {
                Some(mark) => {
                    mark.label.push(' ');
                    mark.label.push_str(&letter(k));
                }
                None => marks.push(CurveMark { at, label: letter(k), joint: false }),
            }
        }
        CurvePanel {
            title: format!("{} plane of pair {}, {}", curve.body, planes.pair + 1, design.units),
            degree: if curve.generic_rank < 3 { 0 } else { curve.degree },
            coefficients: curve.coefficients.clone(),
            units: curve.axes.map(|a| a.norm()),
            marks,
            note: note(curve),
        }
    };
    [panel(&planes.base, false), panel(&planes.platform, true)]
}

fn letter(k: usize) -> String {
    char::from(b'a' + k as u8).to_string()
}

fn note(curve: &PlaneCurve) -> String {
    if curve.generic_rank < 3 {
        return "every point carries a replaceable leg".to_string();
    }
    let parts: Vec<&str> = curve.parts.iter().map(|p| p.kind.name()).collect();
    format!("curve of degree {}: {}", curve.degree, parts.join(", "))
}

/// Plane coordinates in design units.
fn coordinates(curve: &PlaneCurve, p: &Point3<f64>) -> [f64; 2] {
    let d: Vector3<f64> = p - curve.origin;
    curve.axes.map(|a| a.dot(&d) / a.norm())
}

/// Legs of the families between the planes, near enough to be drawn.
fn partners(found: &Components, planes: &PlanePair, seed: u64) -> Vec<(Point3<f64>, Point3<f64>)> {
    let pair = &found.pairs[planes.pair];
    let inside = |c: &&Component| c.support.iter().all(|l| pair.legs.contains(l)) && c.exact != Some(false);
    let families: Vec<_> = found.components.iter().filter(inside).collect();
    let mut out = Vec::new();
    if families.is_empty() {
        return out;
    }
    let n = found.span.normalisation();
    let mut rng = Purpose::FIGURE_MARKS.rng(seed);
    for k in 0..20 * MARKS {
        if out.len() == MARKS {
            break;
        }
        let Ok(Some(s)) = families[k % families.len()].sample(&found.span, &mut rng) else { continue };
        let reach = n.apply(&s.leg);
        if reach.base.coords.norm().max(reach.platform.coords.norm()) < 1.6 {
            out.push((s.leg.base, s.leg.platform));
        }
    }
    out
}
