//! Looking for the nearest pose at which `det J` has the other sign.

use super::enclosure::Lines;
use crate::num::Rng;

/// Rays tried at random.
const RAYS: usize = 1500;

/// Steps of a ray up to the nearest change found so far.
const STEPS: usize = 60;

/// Rays by which the best ones are improved.
const IMPROVEMENTS: usize = 1500;

/// The smallest scale found up to `limit`, and the point there, with a proved change of sign between home and it.
///
/// Proves nothing about what it does not find.
pub(super) fn nearest_change(
    lines: &Lines<'_>,
    sign: f64,
    mut limit: f64,
    seed: u64,
) -> Option<(f64, [f64; 6])> {
    let mut rng = Rng::new(seed);
    let chart = lines.chart;
    let most = limit;
    let mut best: Option<(f64, [f64; 6])> = None;
    let mut direction_of = None;
    for k in 0..RAYS + IMPROVEMENTS {
        let mut direction = [0.0; 6];
        for x in direction.iter_mut().take(chart.len()) {
            *x = rng.uniform(-1.0, 1.0);
        }
        if k >= RAYS {
            let Some(u) = direction_of else { break };
            // steps that shrink: the nearest point is usually on edges of the box
            let width = 0.5 * (1.0 - (k - RAYS) as f64 / IMPROVEMENTS as f64).powi(2) + 1e-3;
            let near: [f64; 6] = u;
            for (x, y) in direction.iter_mut().zip(near).take(chart.len()) {
                *x = (y + width * rng.normal()).clamp(-1.0, 1.0);
            }
        }
        let scale = chart.scale_of(&direction);
        if !(scale > 0.0) {
            continue;
        }
        let u = direction.map(|x| x / scale);
        if let Some(t) = change_along(lines, &u, limit) {
            let point = u.map(|x| x * t);
            let scale = chart.scale_of(&point);
            if scale <= most && lines.sign_at(&point).is_some_and(|s| s * sign < 0.0) {
                limit = t;
                direction_of = Some(u);
                best = Some((scale, point));
            }
        }
    }
    best
}

/// The first change of sign found along a ray, a little beyond it so that the sign there is clear.
fn change_along(lines: &Lines<'_>, u: &[f64; 6], limit: f64) -> Option<f64> {
    let value = |t: f64| lines.determinant(&u.map(|x| x * t));
    let home = value(0.0);
    let step = limit / STEPS as f64;
    let mut hit = (1..=STEPS).map(|k| k as f64 * step).find(|t| value(*t) * home < 0.0)?;
    let mut clear = hit - step;
    while hit - clear > 1e-6 * hit {
        let middle = 0.5 * (hit + clear);
        if value(middle) * home < 0.0 {
            hit = middle;
        } else {
            clear = middle;
        }
    }
    (hit < limit).then_some(hit)
}
