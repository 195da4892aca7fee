//! Looking for the nearest pose at which `det J` has the other sign.

use super::Shape;
use super::enclosure::Lines;
use crate::num::Rng;

/// Rays tried at random.
const RAYS: usize = 1500;

/// Steps of a ray up to the nearest change found so far.
const STEPS: usize = 60;

/// Rays by which the best ones are improved.
const IMPROVEMENTS: usize = 1500;

/// The smallest scale found, and the point there, with a proved change of sign between home and it.
///
/// Proves nothing about what it does not find.
pub(super) fn nearest_change(lines: &Lines, shape: &Shape, seed: u64) -> Option<(f64, [f64; 6])> {
    let mut rng = Rng::new(seed);
    let mut best: Option<(f64, [f64; 6])> = None;
    let mut limit = shape.largest();
    for k in 0..RAYS + IMPROVEMENTS {
        let direction = match best {
            Some((_, u)) if k >= RAYS => {
                // steps that shrink: the nearest point is usually on edges of the box
                let width = 0.5 * (1.0 - (k - RAYS) as f64 / IMPROVEMENTS as f64).powi(2) + 1e-3;
                u.map(|x| (x + width * rng.normal()).clamp(-1.0, 1.0))
            }
            None if k >= RAYS => break,
            _ => std::array::from_fn(|_| rng.uniform(-1.0, 1.0)),
        };
        let largest = direction.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        let u = direction.map(|x| x / largest);
        if let Some(scale) = change_along(lines, shape, &u, limit) {
            let point = point_of(shape, &u, scale);
            if lines.has_other_sign(&point) {
                limit = scale;
                best = Some((scale, u));
            }
        }
    }
    best.map(|(scale, u)| {
        let point = point_of(shape, &u, scale);
        (shape.scale_of(&point), point)
    })
}

fn point_of(shape: &Shape, u: &[f64; 6], t: f64) -> [f64; 6] {
    let half = shape.half_widths(t);
    std::array::from_fn(|k| u[k] * half[k])
}

/// The first change of sign found along a ray, a little beyond it so that the sign there is clear.
fn change_along(lines: &Lines, shape: &Shape, u: &[f64; 6], limit: f64) -> Option<f64> {
    let value = |t: f64| lines.determinant(&point_of(shape, u, t));
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
