//! The pair of planes as a picture.

use nalgebra::{Point3, Vector3};

use ask::Design;
use files::plot::{CurveFigure, CurveMark, CurvePanel, component_curves};
use num::Purpose;
use platform::manipulator::LegIndex;
use synthesis::components::{Components, FlatPair, PlaneCurve, PlanePair, flat_name};

/// Corresponding points that are marked.
const MARKS: usize = 8;

/// The picture of all pairs of planes, those with most legs first, or of one (`wanted`, an index of `pairs`); `None`
/// when there is none.
pub(super) fn picture(
    design: &Design,
    found: &Components,
    wanted: Option<usize>,
    seed: u64,
) -> Option<String> {
    let mut pairs: Vec<&PlanePair> =
        found.planes.iter().filter(|p| wanted.is_none_or(|k| k == p.pair)).collect();
    pairs.sort_by_key(|p| std::cmp::Reverse(found.pairs[p.pair].legs.len()));
    let title = format!("replaceable legs of {}", design.name);
    let panels: Vec<[CurvePanel; 2]> = pairs.iter().map(|p| both(design, found, p, seed)).collect();
    (!panels.is_empty()).then(|| component_curves(&CurveFigure { title, panels }))
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
            // shared joints carry all their leg numbers
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

/// Legs of the families between the planes, near enough to be shown.
fn partners(found: &Components, planes: &PlanePair, seed: u64) -> Vec<(Point3<f64>, Point3<f64>)> {
    let pair = &found.pairs[planes.pair];
    let inside = |c: &&synthesis::components::Component| {
        c.support.iter().all(|l| pair.legs.contains(l)) && c.exact != Some(false)
    };
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

/// What a design without such a picture is told.
pub(super) fn refusal(found: &Components) -> String {
    let name =
        |(k, p): (usize, &FlatPair)| format!("{} {}-{}", k + 1, flat_name(p.base), flat_name(p.platform));
    let pairs: Vec<String> = found.pairs.iter().enumerate().map(name).collect();
    format!("there is no such pair of planes; pairs of flats: {}", pairs.join(", "))
}
