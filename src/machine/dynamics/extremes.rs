//! The greatest lengths, speeds, accelerations, forces and powers of a leg along a motion.

use super::LegMotion;

/// A value with its time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    schemars(rename = "ExtremeRecord")
)]
pub struct Extreme {
    /// The signed value.
    #[cfg_attr(feature = "serde", schemars(with = "num::Number"))]
    pub value: f64,
    /// Time, seconds.
    #[cfg_attr(feature = "serde", serde(rename = "time_s"))]
    pub time: f64,
}

/// Extremes of a leg along a motion, at the sampled instants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegExtremes {
    /// Least length, design units.
    pub shortest: Extreme,
    /// Greatest length, design units.
    pub longest: Extreme,
    /// Speed of the greatest size, design units per second.
    pub speed: Extreme,
    /// Acceleration of the greatest size, design units per second squared.
    pub acceleration: Extreme,
    /// Extremes of the drive; `None` without masses.
    pub drive: Option<DriveExtremes>,
}

/// Extremes of the drive of a leg along a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DriveExtremes {
    /// The greatest pushing force; 0 for a drive that only pulls.
    pub push: Extreme,
    /// The greatest pulling force, negative; 0 for a drive that only pushes.
    pub pull: Extreme,
    /// Power of the greatest size, negative where the drive brakes.
    pub power: Extreme,
    /// Root of the mean square of the force over time.
    pub rms_force: f64,
}

/// An instant of a leg: its time, its motion, and the force and the power of its drive.
pub type LegInstant = (f64, LegMotion, Option<(f64, f64)>);

impl LegExtremes {
    /// The extremes over the instants of a leg, in the order of time. `None` without any instant, or where only some
    /// instants have forces.
    #[must_use]
    pub fn of(instants: &[LegInstant]) -> Option<Self> {
        let most = |value: &dyn Fn(&LegInstant) -> f64, better: &dyn Fn(f64, f64) -> bool| {
            let all = instants.iter().map(|i| Extreme { value: value(i), time: i.0 });
            all.reduce(|best, next| if better(next.value, best.value) { next } else { best })
        };
        let less = |a: f64, b: f64| a < b;
        let more = |a: f64, b: f64| a > b;
        let larger = |a: f64, b: f64| a.abs() > b.abs();
        let driven = instants.iter().all(|i| i.2.is_some());
        let drive = |i: &LegInstant| i.2.unwrap_or((f64::NAN, f64::NAN));
        let drive = if driven {
            Some(DriveExtremes {
                push: most(&|i| drive(i).0.max(0.0), &more)?,
                pull: most(&|i| drive(i).0.min(0.0), &less)?,
                power: most(&|i| drive(i).1, &larger)?,
                rms_force: rms(instants.iter().map(|i| (i.0, drive(i).0))),
            })
        } else {
            None
        };
        Some(Self {
            shortest: most(&|i| i.1.length, &less)?,
            longest: most(&|i| i.1.length, &more)?,
            speed: most(&|i| i.1.speed, &larger)?,
            acceleration: most(&|i| i.1.acceleration, &larger)?,
            drive,
        })
    }
}

/// Root of the mean square over time by trapezia; for one instant its size.
fn rms(values: impl Iterator<Item = (f64, f64)>) -> f64 {
    let values: Vec<(f64, f64)> = values.collect();
    let (Some(first), Some(last)) = (values.first(), values.last()) else { return f64::NAN };
    let duration = last.0 - first.0;
    if !(duration > 0.0) {
        return first.1.abs();
    }
    let area = |w: &[(f64, f64)]| 0.5 * (w[1].0 - w[0].0) * (w[0].1.powi(2) + w[1].1.powi(2));
    (values.windows(2).map(area).sum::<f64>() / duration).sqrt()
}
