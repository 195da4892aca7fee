//! Points of the region of poses: the worst near a point, and the point of a pose.

use equipod::geom::Pose;
use equipod::num::Rng;
use equipod::requirements::{PoseSpace, Region};
use nalgebra::{Vector3, Vector6};

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

/// The point of the cube that a pose of the region belongs to.
pub(crate) fn cube_point(space: &PoseSpace, pose: &Pose) -> Vector6<f64> {
    let d = pose.position - space.home.position;
    let w = (pose.rotation * space.home.rotation.inverse()).scaled_axis().map(f64::to_degrees);
    let (half_d, half_w) = (space.translation, space.rotation_deg);
    let part = |x: f64, half: f64| if half > 0.0 { x / half } else { 0.0 };
    let ball = [0, 1, 2].map(|k| (part(d[k], half_d[k]), part(w[k], half_w[k])));
    let (d, w) = (Vector3::from(ball.map(|b| b.0)), Vector3::from(ball.map(|b| b.1)));
    let cube = |v: Vector3<f64>| match space.region {
        Region::Box => v,
        Region::Ellipsoid => {
            // the ball is the cube with every ray shortened from its edge to length 1
            if v.amax() > 0.0 { v * (v.norm() / v.amax()) } else { v }
        }
    };
    let (d, w) = (cube(d), cube(w));
    Vector6::new(d.x, d.y, d.z, w.x, w.y, w.z).map(|x| x.clamp(-1.0, 1.0))
}
