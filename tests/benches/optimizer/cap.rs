//! The smallest cap of the unit sphere that holds given directions.

use nalgebra::Vector3;

/// A support grows by one direction a step and is cut back to at most three; so many steps are never needed.
const MOST_STEPS: usize = 200;

/// Centre of the smallest cap around unit vectors that lie within less than 90 degrees of some direction.
///
/// The cap is that of two directions (centred half way) or of three (on the normal of their plane). The direction
/// farthest from the centre joins the support until none is outside.
pub(crate) fn centre(directions: &[Vector3<f64>]) -> Vector3<f64> {
    let Some(first) = directions.first() else { return Vector3::z() };
    let (mut support, mut c) = (vec![*first], *first);
    for _ in 0..MOST_STEPS {
        let farthest = directions.iter().min_by(|a, b| a.dot(&c).total_cmp(&b.dot(&c)));
        let inside = |c: &Vector3<f64>| support.iter().map(|u| u.dot(c)).fold(f64::INFINITY, f64::min);
        let Some(u) = farthest.filter(|u| u.dot(&c) < inside(&c) - 1e-14) else { break };
        support.push(*u);
        (support, c) = smallest(&support);
    }
    c
}

/// The smallest cap of at most four directions, with those it rests on.
fn smallest(all: &[Vector3<f64>]) -> (Vec<Vector3<f64>>, Vector3<f64>) {
    let mut best = (all.to_vec(), all[0], f64::NEG_INFINITY);
    let mut offer = |rest: Vec<Vector3<f64>>, c: Vector3<f64>| {
        let held = all.iter().map(|u| u.dot(&c)).fold(f64::INFINITY, f64::min);
        if held > best.2 {
            best = (rest, c, held);
        }
    };
    for (i, a) in all.iter().enumerate() {
        for (j, b) in all.iter().enumerate().take(i) {
            if let Some(c) = (a + b).try_normalize(1e-12) {
                offer(vec![*a, *b], c);
            }
            for d in &all[..j] {
                if let Some(n) = (b - a).cross(&(d - a)).try_normalize(1e-300) {
                    offer(vec![*a, *b, *d], if n.dot(a) < 0.0 { -n } else { n });
                }
            }
        }
    }
    (best.0, best.1)
}
