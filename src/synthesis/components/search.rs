//! The search for all families of a design.
//!
//! Every closed pair is searched. Each family is kept once with its legs, and exact arithmetic confirms or denies the
//! results of floating point.

use nalgebra::Vector3;

use super::component::{Component, FamilyKind, SampledLeg, flat_name, infinite_parameters};
use super::exact::{combination, fibre as exact_fibre, only_crossings};
use super::exact_curve::{ExactCurve, NoExactCurve, meeting, place};
use super::exact_form::ExactKind;
use super::flats::{BothReadings, ClosedPair, Flat, Reading};
use super::form::{Form, PartKind};
use super::found::{FoundComponents, View};
use super::planes::{PlaneSide, joints_on_line, line_points, plane_side, points_of};
use super::shape::FamilyShape;
use super::spectrum::{APART, AT_INFINITY, COMPUTED, Question, SAME, nearness, unit};
use num::Rng;
use platform::manipulator::{AlgebraicVector, Body, LegIndex};

use crate::leg_vector::{LegSpan, Normalisation};
use num::linalg::LinalgError;

/// Base and platform end in normalised coordinates.
type NormalisedLeg = (Vector3<f64>, Vector3<f64>);

/// The families as sets, in the order of their discovery.
#[derive(Debug)]
pub(super) struct FamilySearch<'a> {
    pub(super) ends: &'a BothReadings,
    pub(super) span: &'a LegSpan,
    pub(super) rng: Rng,
    pub(super) found: Vec<(FoundComponents, Component)>,
    /// Two planes: the closed pair and the results for each.
    pub(super) planes: Vec<(usize, PlaneSide, PlaneSide)>,
    /// Parts of the search that may be incomplete.
    pub(super) doubts: Vec<String>,
}

impl FamilySearch<'_> {
    pub(super) fn normalisation(&self) -> Normalisation {
        self.span.normalisation()
    }

    /// Greatest distance of a leg from a family that contains it.
    pub(super) fn near(&self) -> f64 {
        nearness(self.ends.tolerance)
    }

    /// The whole search of one closed pair.
    pub(super) fn pair(&mut self, index: usize, pair: &ClosedPair) -> Result<(), LinalgError> {
        let ends = self.ends.of(&pair.legs);
        let base: Vec<Vector3<f64>> = ends.iter().map(|e| e.0).collect();
        let platform: Vec<Vector3<f64>> = ends.iter().map(|e| e.1).collect();
        let turned = pair.product.exchanged();
        let tolerance = self.ends.tolerance;
        let over_base =
            View { product: &pair.product, carrying: Body::Base, near: &base, far: &platform, tolerance };
        let over_platform =
            View { product: &turned, carrying: Body::Platform, near: &platform, far: &base, tolerance };
        let full = pair.rank == (pair.base + 1) * (pair.platform + 1);
        if full {
            let (a, b) = (pair.product.base.clone(), pair.product.platform.clone());
            let found = over_base.all_pairs(a, b, Vec::new());
            return self.add(found, pair, Some(pair.reading != Reading::ToleranceOnly));
        }
        match (pair.base, pair.platform) {
            (1, _) => self.line(&over_base, pair),
            (_, 1) => self.line(&over_platform, pair),
            (2, 2) => self.two_planes(index, &over_base, &over_platform, pair),
            (2, _) => self.plane_space(&over_base, pair),
            (_, 2) => self.plane_space(&over_platform, pair),
            _ => Ok(()),
        }
    }

    /// A line and any flat: one family over the line. Families over single points of it are families over joints.
    fn line(&mut self, view: &View<'_>, pair: &ClosedPair) -> Result<(), LinalgError> {
        let flat = &view.product.base;
        let first = view.near[0];
        let far = view.near.iter().find(|p| (*p - first).norm() > APART * flat.axes[0].norm());
        let second = far.copied().unwrap_or(first + flat.axes[0]);
        let (p, q) = (flat.local(&first), flat.local(&second));
        if let Some(found) = view.over_line(&p, &q, None, &mut self.rng)? {
            let exact = self.exact_over(view, pair, &[0, 1, 2, 3, 4]);
            let dimension = found.shape.dimension();
            self.add(found, pair, exact.map(|d| d == dimension))
        } else {
            self.doubts.push(format!("no family was found over the line of legs {}", names(&pair.legs)));
            Ok(())
        }
    }

    fn two_planes(
        &mut self,
        index: usize,
        over_base: &View<'_>,
        over_platform: &View<'_>,
        pair: &ClosedPair,
    ) -> Result<(), LinalgError> {
        let [base, platform] = [over_base, over_platform].map(|view| {
            let exact = self.exact_curve(view, pair);
            plane_side(view, exact, &mut self.rng)
        });
        let (base, platform) = (base?, platform?);
        // lines of both bodies, then conics of both: rational parts are described first
        let mut only_nearly = false;
        for kind in [PartKind::Line, PartKind::Conic] {
            for (view, side) in [(over_base, &base), (over_platform, &platform)] {
                only_nearly |= self.parts(view, pair, side, kind)?;
            }
        }
        let cubics = base.split.parts.iter().filter(|p| p.kind == PartKind::Cubic);
        for part in cubics.cloned().collect::<Vec<_>>() {
            self.cubic(over_base, pair, &part.form, Some(&platform), &base)?;
        }
        // lines that the exact data lack: their curve does not split there
        if only_nearly && pair.rank == 6 && pair.reading != Reading::ToleranceOnly {
            // the record of the planes shows another splitting, such as a conic for two lines
            if !base.exact.as_ref().is_ok_and(|c| !c.has(ExactKind::Cubic)) {
                let form = base.form.clone();
                self.cubic(over_base, pair, &form, None, &base)?;
            }
        }
        if !(base.complete && platform.complete) {
            self.doubts
                .push(format!("the planes of legs {} hold a curve that was not split", names(&pair.legs)));
        }
        self.planes.push((index, base, platform));
        Ok(())
    }

    /// Families over the parts of one kind of the curve in one plane, and over the plane itself. Also returns whether
    /// exact arithmetic denies one of them.
    fn parts(
        &mut self,
        view: &View<'_>,
        pair: &ClosedPair,
        side: &PlaneSide,
        kind: PartKind,
    ) -> Result<bool, LinalgError> {
        let generic = self.exact_over(view, pair, &[]);
        let mut denied = false;
        for (part, found) in &side.families {
            let exact = match part {
                None if kind == PartKind::Line => generic.map(|d| d == found.shape.dimension() - 1),
                Some(k) if side.split.parts[*k].kind == kind => match kind {
                    PartKind::Line => {
                        match self.exact_line(view, pair, &side.split.parts[*k].form, generic) {
                            None => self.exact_part(view, side, *k)?,
                            known => known,
                        }
                    }
                    _ => self.exact_part(view, side, *k)?,
                },
                _ => continue,
            };
            denied |= exact == Some(false);
            let mut found = found.clone();
            for d in &mut found.decisions {
                match d.question {
                    Question::LineFactor => d.exact = exact.map(usize::from),
                    // for a degenerate conic it is known only that it is no part
                    Question::ConicRank if exact == Some(true) => d.exact = Some(3),
                    _ => {}
                }
            }
            self.add(found, pair, exact)?;
        }
        Ok(denied)
    }

    /// The family over an irreducible cubic.
    fn cubic(
        &mut self,
        view: &View<'_>,
        pair: &ClosedPair,
        form: &Form,
        platform: Option<&PlaneSide>,
        side: &PlaneSide,
    ) -> Result<(), LinalgError> {
        if side.rank != 3 || view.product.equations.len() != 3 {
            self.doubts.push(format!("a cubic of legs {} was not followed", names(&pair.legs)));
            return Ok(());
        }
        let joints: Vec<Vec<f64>> = view.near.iter().map(|p| view.product.base.local(p)).collect();
        let Some(centre) = joints.iter().find(|p| form.value(&unit(p)).abs() <= self.near() * form.norm())
        else {
            self.doubts.push(format!("a cubic of legs {} passes through no joint", names(&pair.legs)));
            return Ok(());
        };
        // the part of the platform's curve that contains the partners
        let mut partners: Vec<Vec<f64>> = Vec::new();
        for alpha in points_of(form, 6, &mut self.rng)? {
            partners.extend(view.product.spectrum(&alpha)?.vectors.pop());
        }
        let fits = |f: &Form| partners.iter().all(|b| f.value(b).abs() <= 1e-6 * f.norm());
        let curve = platform.and_then(|s| s.split.parts.iter().map(|p| &p.form).find(|f| fits(f)));
        let shape = FamilyShape::Cubic {
            product: Box::new(view.product.clone()),
            base: form.clone(),
            platform: curve.cloned(),
            centre: centre.clone(),
        };
        let found = FoundComponents {
            shape,
            kind: FamilyKind::OverCubic,
            base_span: 2,
            platform_span: 2,
            exact: None,
            decisions: side.decisions.clone(),
        };
        let exact = match &side.exact {
            Ok(c) if c.has(ExactKind::Undecided) => None,
            Ok(c) => Some(c.has(ExactKind::Cubic)),
            Err(NoExactCurve::OtherFlats) => Some(false),
            Err(_) => None,
        };
        self.add(found, pair, exact)
    }

    fn plane_space(&mut self, view: &View<'_>, pair: &ClosedPair) -> Result<(), LinalgError> {
        let side = plane_side(view, self.exact_curve(view, pair), &mut self.rng)?;
        for kind in [PartKind::Line, PartKind::Conic] {
            self.parts(view, pair, &side, kind)?;
        }
        if !side.complete || side.split.parts.iter().any(|p| p.kind == PartKind::Cubic) {
            self.doubts.push(format!("a curve over the plane of legs {} was not split", names(&pair.legs)));
        }
        self.isolated_points(view, pair)
    }

    /// Flats of partners over every joint, by all six legs.
    pub(super) fn joints(&mut self, whole: &ClosedPair) -> Result<(), LinalgError> {
        let turned = whole.product.exchanged();
        let ends = self.ends;
        for carrying in Body::BOTH {
            let product = carrying.of((&whole.product, &turned));
            let (near, far) = (ends.side(carrying), ends.side(carrying.other()));
            let exact_ends = carrying.of((&ends.exact.base, &ends.exact.platform));
            for i in (0..6).filter(|i| !exact_ends[..*i].contains(&exact_ends[*i])) {
                let of_joint: Vec<Vector3<f64>> =
                    (0..6).filter(|k| near[*k] == near[i]).chain(0..6).map(|k| far[k]).collect();
                let view = View { product, carrying, near, far: &of_joint, tolerance: ends.tolerance };
                let exact = exact_fibre(&ends.exact, carrying, &exact_ends[i], &whole.legs);
                let width = product.platform.dimension() + 1;
                let exactly = ends.constructed || whole.reading == Reading::ExactOnly;
                let rank = exactly.then(|| width.saturating_sub(exact));
                if let Some(found) = view.over_point(&near[i], rank)? {
                    let dimension = found.shape.dimension();
                    // in a larger family every joint has such a flat, which adds nothing
                    if !self.inside_larger(&found) {
                        self.add(found, whole, Some(exact == dimension + 1))?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Points of a plane with a whole line of partners that are not joints. They are intersections of lines through
    /// joints, and further common zeros of the minors of order 3. The dimension of the cubics through them proves that
    /// there are no others. An exact bound on partners can prove it if several of them coincide.
    fn isolated_points(&mut self, view: &View<'_>, pair: &ClosedPair) -> Result<(), LinalgError> {
        let joints: Vec<Vec<f64>> = view.near.iter().map(|p| view.product.base.local(p)).collect();
        let conditions = super::planes::conditions(view, &mut self.rng)?;
        let mut points: Vec<Vec<f64>> = Vec::new();
        let (located, complex) = super::planes::located(view, &mut self.rng)?;
        for candidate in super::planes::candidates(&joints).into_iter().chain(located) {
            let s = view.product.spectrum(&candidate)?;
            if s.rank(COMPUTED * self.ends.tolerance) + 2 > view.product.platform.dimension() + 1 {
                continue;
            }
            let new = !points.iter().any(|p| super::form::same_point(p, &candidate, SAME));
            if new && candidate[0].abs() > AT_INFINITY {
                let place = super::found::point(&view.product.base, &candidate);
                if let Some(found) = view.over_point(&place, None)?.filter(|f| !self.inside_larger(f)) {
                    let exact = self.exact_meeting(view, pair, &place, found.shape.dimension());
                    self.add(found, pair, exact)?;
                }
            }
            points.push(candidate);
        }
        let met = super::planes::conditions_of(&points, view.product.platform.dimension())? + complex;
        let exact = pair.reading != Reading::ToleranceOnly;
        if conditions > met && !(exact && only_crossings(&self.ends.exact, view.carrying, &pair.legs)) {
            self.doubts.push(format!(
                "over the plane of legs {} there may be a point with a line of partners that was not located",
                names(&pair.legs)
            ));
        }
        Ok(())
    }
}

/// Leg numbers, counted from 1.
fn names(legs: &[usize]) -> String {
    legs.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join(" ")
}

impl FamilySearch<'_> {
    /// Whether a flat of partners of one point lies in a family of larger dimension.
    fn inside_larger(&self, found: &FoundComponents) -> bool {
        let FamilyShape::Product { base, platform, .. } = &found.shape else { return false };
        let mut rng = self.rng.clone();
        let mut random =
            |flat: &Flat| flat.axes.iter().fold(flat.origin, |x, e| x + e * rng.uniform(-1.0, 1.0));
        let samples: Vec<_> = (0..4).map(|_| (random(base), random(platform))).collect();
        let inside = |shape: &FamilyShape| samples.iter().all(|(a, b)| shape.distance(a, b) <= self.near());
        self.found.iter().any(|(k, c)| c.dimension > found.shape.dimension() && inside(&k.shape))
    }

    /// Adds a family unless it is known already, or exact joints lack it.
    pub(super) fn add(
        &mut self,
        mut found: FoundComponents,
        pair: &ClosedPair,
        exact: Option<bool>,
    ) -> Result<(), LinalgError> {
        if self.ends.constructed && exact == Some(false) {
            let (base, platform) = (flat_name(found.base_span), flat_name(found.platform_span));
            self.doubts.push(format!(
                "legs {} have a family between {base} and {platform} within the tolerance only, so numbers are too close to separate the exact families",
                names(&pair.legs)
            ));
            return Ok(());
        }
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
                same &= old.shape.distance(a, b) <= nearness(self.ends.tolerance);
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

    /// A random leg, near the joints if possible; a family with a distant fixed end has none there.
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

impl FamilySearch<'_> {
    /// Centre and unit of the normalised coordinates of the carrying body.
    fn frame(&self, view: &View<'_>) -> (Vector3<f64>, f64) {
        let n = self.normalisation();
        view.carrying.of(((n.base_centre.coords, n.base_unit), (n.platform_centre.coords, n.platform_unit)))
    }

    /// Exact dimension of the partners of a generic point of the flat of the carrying body, for exact pairs. It is the
    /// least over points such that a minor of order 4 that vanishes at all of them vanishes everywhere.
    fn exact_over(&self, view: &View<'_>, pair: &ClosedPair, steps: &[i32]) -> Option<usize> {
        if pair.reading == Reading::ToleranceOnly {
            return Some(usize::MAX);
        }
        let ends = view.carrying.of((&self.ends.exact.base, &self.ends.exact.platform));
        let mut kept: Vec<&AlgebraicVector> = Vec::new();
        for i in &pair.legs {
            let mut rows: Vec<AlgebraicVector> = kept.iter().map(|r| (*r).clone()).collect();
            rows.push(ends[*i].clone());
            if num::exact::rank(&rows) == rows.len() {
                kept.push(&ends[*i]);
            }
        }
        let points: Vec<AlgebraicVector> = match kept.len() {
            2 => steps.iter().map(|s| combination(&kept, &[1, *s])).collect(),
            3 => (0..5)
                .flat_map(|x| (0..5 - x).map(move |y| [x, y, 4 - x - y]))
                .map(|c| combination(&kept, &c))
                .collect(),
            _ => return None,
        };
        points.iter().map(|x| exact_fibre(&self.ends.exact, view.carrying, x, &pair.legs)).min()
    }

    /// Whether the exact data have a family over the line through two joints on it.
    fn exact_line(
        &self,
        view: &View<'_>,
        pair: &ClosedPair,
        line: &Form,
        generic: Option<usize>,
    ) -> Option<bool> {
        if pair.reading == Reading::ToleranceOnly {
            return Some(false);
        }
        let joints: Vec<Vec<f64>> = view.near.iter().map(|p| view.product.base.local(p)).collect();
        let on = joints_on_line(line, &joints, self.ends.tolerance);
        let ends = view.carrying.of((&self.ends.exact.base, &self.ends.exact.platform));
        let p = &ends[pair.legs[*on.first()?]];
        let q = on.iter().map(|k| &ends[pair.legs[*k]]).find(|q| *q != p)?;
        let generic = generic?;
        let points = [0, 1, 2, 3, 5].map(|s| combination(&[p, q], &[1, s]));
        let fibres = points.iter().map(|x| exact_fibre(&self.ends.exact, view.carrying, x, &pair.legs));
        Some(fibres.min()? > generic)
    }

    /// The curve of the exact data over the plane of the carrying body.
    pub(super) fn exact_curve(&self, view: &View<'_>, pair: &ClosedPair) -> Result<ExactCurve, NoExactCurve> {
        if pair.reading == Reading::ToleranceOnly {
            return Err(NoExactCurve::OtherFlats);
        }
        ExactCurve::of(&self.ends.exact, &pair.legs, view.carrying)
    }

    /// Whether the exact curve has a line or conic at part `k` of the curve within the tolerance.
    fn exact_part(&self, view: &View<'_>, side: &PlaneSide, k: usize) -> Result<Option<bool>, LinalgError> {
        let curve = match &side.exact {
            Ok(curve) => curve,
            Err(NoExactCurve::OtherFlats) => return Ok(Some(false)),
            Err(_) => return Ok(None),
        };
        let (part, flat) = (&side.split.parts[k], &view.product.base);
        let joints: Vec<Vec<f64>> = view.near.iter().map(|p| flat.local(p)).collect();
        let line = part.kind == PartKind::Line;
        let points = if line {
            let Some([p, q]) = line_points(&part.form, &joints, self.ends.tolerance) else { return Ok(None) };
            let along = |t: f64| p.iter().zip(&q).map(|(x, y)| x + t * (y - x)).collect::<Vec<f64>>();
            [-1.0, 0.0, 0.5, 1.0, 2.0].map(along).to_vec()
        } else {
            // a separate random stream keeps the results independent of their checks
            points_of(&part.form, 8, &mut Rng::new(8))?
        };
        let (centre, unit) = self.frame(view);
        let places: Vec<Vector3<f64>> = points
            .iter()
            .filter(|p| p[0].abs() > 1e-3)
            .map(|p| centre + super::found::point(flat, p) * unit)
            .collect();
        let lines = |k| matches!(k, ExactKind::Line | ExactKind::RealLines | ExactKind::ThreeLines { .. });
        Ok(curve.has_part(|k| if line { lines(k) } else { k == ExactKind::Conic }, &places))
    }

    /// Whether the exact data have partners of that dimension over the intersection of two lines of joints nearest to a
    /// point.
    fn exact_meeting(
        &self,
        view: &View<'_>,
        pair: &ClosedPair,
        at: &Vector3<f64>,
        dimension: usize,
    ) -> Option<bool> {
        if pair.reading == Reading::ToleranceOnly {
            return Some(false);
        }
        let ends = view.carrying.of((&self.ends.exact.base, &self.ends.exact.platform));
        let (centre, unit) = self.frame(view);
        let distance = |p: &AlgebraicVector| place(p).map_or(f64::MAX, |x| ((x - centre) / unit - at).norm());
        let mut best: Option<(f64, AlgebraicVector)> = None;
        let lines: Vec<[&AlgebraicVector; 2]> = (0..pair.legs.len())
            .flat_map(|k| (0..k).map(move |l| [k, l]))
            .map(|pair_of| pair_of.map(|k| &ends[pair.legs[k]]))
            .filter(|[p, q]| p != q)
            .collect();
        for (k, l) in lines.iter().enumerate() {
            for m in &lines[..k] {
                let Some(point) = meeting([*l, *m]) else { continue };
                let d = distance(&point);
                if best.as_ref().is_none_or(|b| d < b.0) {
                    best = Some((d, point));
                }
            }
        }
        let (distance, point) = best?;
        let fibre = exact_fibre(&self.ends.exact, view.carrying, &point, &pair.legs);
        (distance < 1e-6).then_some(fibre == dimension + 1)
    }
}
