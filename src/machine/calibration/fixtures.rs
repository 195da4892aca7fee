//! Machines with known truth for tests.

use nalgebra::{Point3, Rotation3, Vector3};

use super::{LegModel, Measurement, MeasurementNoise};
use num::Rng;
use platform::geom::Pose;

/// A hexapod with joints in pairs on circles of 500 and 300 mm, some millimetres out of their planes.
pub(super) fn nominal() -> LegModel {
    let joints = |radius: f64, first: f64, spread: f64| -> Vec<Point3<f64>> {
        (0..6_u8)
            .map(|i| {
                let side = if i % 2 == 0 { -1.0 } else { 1.0 };
                let angle = (first + 120.0 * f64::from(i / 2) + side * spread).to_radians();
                Point3::new(radius * angle.cos(), radius * angle.sin(), f64::from(i % 3) * 4.0)
            })
            .collect()
    };
    let (base, platform) = (joints(500.0, 0.0, 10.0), joints(300.0, 0.0, 50.0));
    LegModel { base, platform, pairs: std::array::from_fn(|i| (i, i)), offsets: [0.0; 6] }
}

/// An octahedral platform: every joint carries two legs.
pub(super) fn octahedral() -> LegModel {
    let corners = |radius: f64, first: f64| -> Vec<Point3<f64>> {
        (0..3_u8)
            .map(|i| {
                let angle = (first + 120.0 * f64::from(i)).to_radians();
                Point3::new(radius * angle.cos(), radius * angle.sin(), 0.0)
            })
            .collect()
    };
    LegModel {
        base: corners(500.0, 0.0),
        platform: corners(300.0, 60.0),
        pairs: [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)],
        offsets: [0.0; 6],
    }
}

/// The machine with its joints off by about `joints` in each coordinate and offsets of about `offsets`.
pub(super) fn built(nominal: &LegModel, joints: f64, offsets: f64, rng: &mut Rng) -> LegModel {
    let mut out = nominal.clone();
    for joint in out.base.iter_mut().chain(&mut out.platform) {
        *joint += Vector3::from_fn(|_, _| joints * rng.normal());
    }
    for offset in &mut out.offsets {
        *offset += offsets * rng.normal();
    }
    out
}

/// Poses around (0, 0, 600): up to 120 mm away along each axis, turned by up to 25 degrees about each.
pub(super) fn poses(count: usize, rng: &mut Rng) -> Vec<Pose> {
    (0..count)
        .map(|_| {
            let at = Vector3::from_fn(|_, _| rng.uniform(-120.0, 120.0));
            let turn = Vector3::from_fn(|_, _| rng.uniform(-25.0, 25.0_f64).to_radians());
            Pose { rotation: Rotation3::new(turn), position: Vector3::new(0.0, 0.0, 600.0) + at }
        })
        .collect()
}

/// Simulated measurements at poses; `None`: without noise.
pub(super) fn measured(
    truth: &LegModel,
    poses: &[Pose],
    noise: Option<&MeasurementNoise>,
    rng: &mut Rng,
) -> Vec<Measurement> {
    poses
        .iter()
        .map(|pose| {
            let lengths = truth.lengths(pose);
            let Some(noise) = noise else { return Measurement { pose: *pose, lengths } };
            let shift = Vector3::from_fn(|_, _| noise.position * rng.normal());
            let turn = Vector3::from_fn(|_, _| noise.rotation * rng.normal());
            Measurement {
                pose: Pose {
                    rotation: Rotation3::new(turn) * pose.rotation,
                    position: pose.position + shift,
                },
                lengths: lengths.map(|l| l + noise.length * rng.normal()),
            }
        })
        .collect()
}
