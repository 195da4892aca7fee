//! What exact arithmetic says about families found in floating point.

use nalgebra::Vector3;

use super::curves::PartKind;
use super::exact::{Exact, combination};
use super::exact_curve::{ExactCurve, NoExactCurve, meeting, place};
use super::exact_split::ExactKind;
use super::form::Form;
use super::found::View;
use super::pairs::{ClosedPair, Reading};
use super::planes::{PlaneSide, line_points, on_line, points_of};
use super::search::Search;
use crate::num::Rng;
use crate::num::linalg::LinalgError;

impl Search<'_> {
    /// Centre and unit of the normalised coordinates of the carrying body.
    fn frame(&self, view: &View<'_>) -> (Vector3<f64>, f64) {
        let n = self.normalisation();
        if view.over_platform {
            (n.platform_centre.coords, n.platform_unit)
        } else {
            (n.base_centre.coords, n.base_unit)
        }
    }

    /// Exact dimension of the partners of a generic point of the flat of the carrying body, if asked on an exact pair:
    /// the least at points on which no minor of order 4 can vanish without vanishing everywhere.
    pub(super) fn exact_over(&self, view: &View<'_>, pair: &ClosedPair, steps: &[i32]) -> Option<usize> {
        if pair.reading == Reading::ToleranceOnly {
            return Some(usize::MAX);
        }
        let ends = if view.over_platform { &self.ends.exact.platform } else { &self.ends.exact.base };
        let mut kept: Vec<&Exact> = Vec::new();
        for i in &pair.legs {
            let mut rows: Vec<Exact> = kept.iter().map(|r| (*r).clone()).collect();
            rows.push(ends[*i].clone());
            if super::exact::rank(&rows) == rows.len() {
                kept.push(&ends[*i]);
            }
        }
        let points: Vec<Exact> = match kept.len() {
            2 => steps.iter().map(|s| combination(&kept, &[1, *s])).collect(),
            3 => (0..5)
                .flat_map(|x| (0..5 - x).map(move |y| [x, y, 4 - x - y]))
                .map(|c| combination(&kept, &c))
                .collect(),
            _ => return None,
        };
        points.iter().map(|x| self.ends.exact.fibre(view.over_platform, x, &pair.legs)).min()
    }

    /// Whether the exact data have a family over the line through two joints on it.
    pub(super) fn exact_line(
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
        let on = on_line(line, &joints, self.ends.tolerance);
        let ends = if view.over_platform { &self.ends.exact.platform } else { &self.ends.exact.base };
        let p = &ends[pair.legs[*on.first()?]];
        let q = on.iter().map(|k| &ends[pair.legs[*k]]).find(|q| *q != p)?;
        let generic = generic?;
        let points = [0, 1, 2, 3, 5].map(|s| combination(&[p, q], &[1, s]));
        let fibres = points.iter().map(|x| self.ends.exact.fibre(view.over_platform, x, &pair.legs));
        Some(fibres.min()? > generic)
    }

    /// The curve of the exact data over the plane of the carrying body.
    pub(super) fn exact_curve(&self, view: &View<'_>, pair: &ClosedPair) -> Result<ExactCurve, NoExactCurve> {
        if pair.reading == Reading::ToleranceOnly {
            return Err(NoExactCurve::OtherFlats);
        }
        ExactCurve::of(&self.ends.exact, &pair.legs, view.over_platform)
    }

    /// Whether the exact curve has a line or conic where the one within the tolerance has part `k`.
    pub(super) fn exact_part(
        &self,
        view: &View<'_>,
        side: &PlaneSide,
        k: usize,
    ) -> Result<Option<bool>, LinalgError> {
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
            // a stream of its own: what is found does not depend on how it is checked
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

    /// Whether the exact data have partners of that dimension over the crossing of two lines of joints that is nearest to a point.
    pub(super) fn exact_meeting(
        &self,
        view: &View<'_>,
        pair: &ClosedPair,
        at: &Vector3<f64>,
        dimension: usize,
    ) -> Option<bool> {
        if pair.reading == Reading::ToleranceOnly {
            return Some(false);
        }
        let ends = if view.over_platform { &self.ends.exact.platform } else { &self.ends.exact.base };
        let (centre, unit) = self.frame(view);
        let distance = |p: &Exact| place(p).map_or(f64::MAX, |x| ((x - centre) / unit - at).norm());
        let mut best: Option<(f64, Exact)> = None;
        let lines: Vec<[&Exact; 2]> = (0..pair.legs.len())
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
        let fibre = self.ends.exact.fibre(view.over_platform, &point, &pair.legs);
        (distance < 1e-6).then_some(fibre == dimension + 1)
    }
}
