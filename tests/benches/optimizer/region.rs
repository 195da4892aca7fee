//! The worst pose near another one.

use equipod::methods::num::Rng;
use nalgebra::Vector6;

/// The least value near a point of the cube, without derivatives.
pub(crate) fn descend(
    f: &dyn Fn(&Vector6<f64>) -> f64,
    mut value: f64,
    mut x: Vector6<f64>,
    axes: &[usize],
    rng: &mut Rng,
) -> (f64, Vector6<f64>) {
    let mut step = 0.2;
    while step > 1e-7 && !axes.is_empty() {
        let mut better = false;
        for trial in 0..2 * axes.len() {
            let mut y = x;
            for (j, k) in axes.iter().enumerate() {
                if trial % 2 == 0 || j == trial / 2 {
                    y[*k] = (y[*k] + step * rng.uniform(-1.0, 1.0)).clamp(-1.0, 1.0);
                }
            }
            let there = f(&y);
            if there < value {
                (value, x, better) = (there, y, true);
            }
        }
        if !better {
            step *= 0.6;
        }
    }
    (value, x)
}
