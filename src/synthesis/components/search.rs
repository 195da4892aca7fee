//! All families of a design.

use nalgebra::Vector3;

use super::component::{Component, FamilyKind};
use super::curves::PartKind;
use super::decision::Question;
use super::exact_curve::NoExactCurve;
use super::exact_split::ExactKind;
use super::form::Form;
use super::found::{Found, View};
use super::pairs::{ClosedPair, Ends, Reading};
use super::planes::{PlaneSide, plane_side, points_of};
use super::shape::Shape;
use super::spectrum::unit;
use crate::num::Rng;
use crate::num::linalg::LinalgError;
use crate::synthesis::leg_vector::{LegSpan, Normalisation};

/// Base and platform end in normalised coordinates.
pub(super) type NormalisedLeg = (Vector3<f64>, Vector3<f64>);

/// The families with the sets they are, in the order in which they were found.
#[derive(Debug)]
pub(super) struct Search<'a> {
    pub(super) ends: &'a Ends,
    pub(super) span: &'a LegSpan,
    pub(super) rng: Rng,
    pub(super) found: Vec<(Found, Component)>,
    /// Two planes: the closed pair and what was found over each.
    pub(super) planes: Vec<(usize, PlaneSide, PlaneSide)>,
    /// What could not be shown to be complete.
    pub(super) doubts: Vec<String>,
}

impl Search<'_> {
    pub(super) fn normalisation(&self) -> Normalisation {
        self.span.normalisation()
    }

    /// How near a leg must be to a family to belong to it.
    pub(super) fn near(&self) -> f64 {
        (10.0 * self.ends.tolerance).max(1e-8)
    }

    /// Everything in one closed pair.
    pub(super) fn pair(&mut self, index: usize, pair: &ClosedPair) -> Result<(), LinalgError> {
        let ends = self.ends.of(&pair.legs);
        let base: Vec<Vector3<f64>> = ends.iter().map(|e| e.0).collect();
        let platform: Vec<Vector3<f64>> = ends.iter().map(|e| e.1).collect();
        let turned = pair.product.exchanged();
        let tolerance = self.ends.tolerance;
        let over_base =
            View { product: &pair.product, over_platform: false, near: &base, far: &platform, tolerance };
        let over_platform =
            View { product: &turned, over_platform: true, near: &platform, far: &base, tolerance };
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

    /// A line and any flat: one family over the line. What stands over single points of it stands over joints.
    fn line(&mut self, view: &View<'_>, pair: &ClosedPair) -> Result<(), LinalgError> {
        let flat = &view.product.base;
        let first = view.near[0];
        let far = view.near.iter().find(|p| (*p - first).norm() > 1e-3 * flat.axes[0].norm());
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
        // lines of both bodies, then conics of both: what is rational is described so
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
        // lines that the exact data do not have: their curve does not split there
        if only_nearly && pair.rank == 6 && pair.reading != Reading::ToleranceOnly {
            // one that splits otherwise (a conic for two lines) is told in the record of the planes
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

    /// Families over the parts of one kind of the curve in one plane, and over the plane itself; whether exact arithmetic
    /// denies one of them.
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
                    // of a conic that is none nothing more is known than that it is no part
                    Question::ConicRank if exact == Some(true) => d.exact = Some(3),
                    _ => {}
                }
            }
            self.add(found, pair, exact)?;
        }
        Ok(denied)
    }

    /// The family over a cubic that does not split.
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
        // the part of the platform's curve on which the partners lie
        let mut partners: Vec<Vec<f64>> = Vec::new();
        for alpha in points_of(form, 6, &mut self.rng)? {
            partners.extend(view.product.spectrum(&alpha)?.vectors.pop());
        }
        let fits = |f: &Form| partners.iter().all(|b| f.value(b).abs() <= 1e-6 * f.norm());
        let curve = platform.and_then(|s| s.split.parts.iter().map(|p| &p.form).find(|f| fits(f)));
        let shape = Shape::Cubic {
            product: Box::new(view.product.clone()),
            base: form.clone(),
            platform: curve.cloned(),
            centre: centre.clone(),
        };
        let found = Found {
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
        for over_platform in [false, true] {
            let product = if over_platform { &turned } else { &whole.product };
            let (near, far) = (ends.side(over_platform), ends.side(!over_platform));
            let exact_ends = if over_platform { &ends.exact.platform } else { &ends.exact.base };
            for i in (0..6).filter(|i| !exact_ends[..*i].contains(&exact_ends[*i])) {
                let of_joint: Vec<Vector3<f64>> =
                    (0..6).filter(|k| near[*k] == near[i]).chain(0..6).map(|k| far[k]).collect();
                let view = View { product, over_platform, near, far: &of_joint, tolerance: ends.tolerance };
                let exact = ends.exact.fibre(over_platform, &exact_ends[i], &whole.legs);
                if let Some(found) = view.over_point(&near[i], None)? {
                    let dimension = found.shape.dimension();
                    // within a larger family every joint has such a flat, and it says nothing new
                    if !self.inside_larger(&found) {
                        self.add(found, whole, Some(exact == dimension + 1))?;
                    }
                }
            }
        }
        Ok(())
    }

    /// Points of a plane over which whole lines stand that are no joints: crossings of lines through joints, and what is left as
    /// common zeros of the minors of order 3; that there are no others is shown by the dimension these leave of all cubics.
    fn isolated_points(&mut self, view: &View<'_>, pair: &ClosedPair) -> Result<(), LinalgError> {
        let joints: Vec<Vec<f64>> = view.near.iter().map(|p| view.product.base.local(p)).collect();
        let conditions = super::isolated::conditions(view, &mut self.rng)?;
        let mut points: Vec<Vec<f64>> = Vec::new();
        let (located, complex) = super::isolated::located(view, &mut self.rng)?;
        for candidate in super::isolated::candidates(&joints).into_iter().chain(located) {
            let s = view.product.spectrum(&candidate)?;
            if s.rank(10.0 * self.ends.tolerance) + 2 > view.product.platform.dimension() + 1 {
                continue;
            }
            let new = !points.iter().any(|p| super::curves::same_point(p, &candidate, 1e-6));
            if new && candidate[0].abs() > 1e-9 {
                let place = super::found::point(&view.product.base, &candidate);
                if let Some(found) = view.over_point(&place, None)?.filter(|f| !self.inside_larger(f)) {
                    let exact = self.exact_meeting(view, pair, &place, found.shape.dimension());
                    self.add(found, pair, exact)?;
                }
            }
            points.push(candidate);
        }
        let met = super::isolated::conditions_of(&points, view.product.platform.dimension())? + complex;
        if conditions > met {
            self.doubts.push(format!(
                "over the plane of legs {} there may be a point with a line of partners that was not located",
                names(&pair.legs)
            ));
        }
        Ok(())
    }
}

/// Leg numbers, counted from 1.
pub(super) fn names(legs: &[usize]) -> String {
    legs.iter().map(|i| (i + 1).to_string()).collect::<Vec<_>>().join(" ")
}
