//! Swing limits of the balls at the platform.
//!
//! The range of a ball joint limits its whole turn, that about the leg included, and legs 2 to 6 have no ball joint but a `connect`. A tendon between two points does what a cone does: with the joint in the
//! origin, `-h u` on the rod and `-h k` on the axis of the joint, `u` and `k` unit vectors with the angle `t`, its length is
//!
//! ```text
//! |h u - h k| = 2 h sin(t / 2).
//! ```

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::{Export, ExportLeg, Scale, Unsupported, real};
use crate::requirements::JointAxes;

/// Distance of both ends of the tendon from the joint, over the length of the leg at home.
const AWAY: f64 = 0.1;

/// The greatest angle of a leg (from 0) at the platform, radians, where the design limits it.
fn limit(export: &Export, leg: usize) -> Option<f64> {
    let swing = export.hardware.platform_swing.filter(|_| export.cranks.is_none())?;
    Some(swing.limits_deg[leg].to_radians()).filter(|most| *most < std::f64::consts::PI)
}

/// Whether the swing of any leg at the platform is limited.
pub(super) fn is_limited(export: &Export) -> bool {
    (0..6).any(|leg| limit(export, leg).is_some())
}

/// The tendon of a leg.
pub(super) struct SwingTendon {
    number: usize,
    /// Distance of its ends from the joint, design units.
    away: f64,
    /// Its end on the platform, platform frame.
    seat: Vector3<f64>,
    /// Its greatest length, design units.
    longest: f64,
}

impl SwingTendon {
    /// `None` where nothing limits the swing.
    pub(super) fn of(export: &Export, leg: &ExportLeg) -> Result<Option<Self>, Unsupported> {
        let (Some(swing), Some(most)) = (export.hardware.platform_swing, limit(export, leg.number - 1))
        else {
            return Ok(None);
        };
        let axis = match swing.axes {
            JointAxes::Given(axes) => axes[leg.number - 1].into_inner(),
            JointAxes::Home | JointAxes::Optimize => export.home.rotation.inverse() * leg.direction()?,
        };
        let away = AWAY * leg.length();
        let joint = export.bodies[1].joints[leg.platform].at.coords;
        let longest = 2.0 * away * (0.5 * most).sin();
        Ok(Some(Self { number: leg.number, away, seat: joint - axis * away, longest }))
    }

    /// Its site on the rod, whose origin is the joint and whose third axis is the leg.
    pub(super) fn at_rod(&self, out: &mut String, scale: &Scale) {
        let at = scale.at(&Vector3::new(0.0, 0.0, -self.away));
        let size = real(0.01 * scale.size);
        let _ = writeln!(
            out,
            "            <site name=\"rod{}_swing\" pos=\"{at}\" size=\"{size}\"/>",
            self.number
        );
    }

    /// Its site on the platform.
    pub(super) fn at_platform(&self, out: &mut String, scale: &Scale) {
        let (at, size) = (scale.at(&self.seat), real(0.01 * scale.size));
        let _ = writeln!(
            out,
            "              <site name=\"platform{}_swing\" pos=\"{at}\" size=\"{size}\"/>",
            self.number
        );
    }
}

/// The tendons of all legs.
pub(super) fn tendons(out: &mut String, scale: &Scale, export: &Export) -> Result<(), Unsupported> {
    if !is_limited(export) {
        return Ok(());
    }
    out.push_str("  <tendon>\n");
    for leg in &export.legs {
        let Some(tendon) = SwingTendon::of(export, leg)? else { continue };
        let _ = writeln!(
            out,
            "    <spatial name=\"swing{0}\" limited=\"true\" range=\"0 {1}\" width=\"{2}\">\n      \
             <site site=\"rod{0}_swing\"/>\n      <site site=\"platform{0}_swing\"/>\n    </spatial>",
            tendon.number,
            real(tendon.longest * scale.metres),
            real(0.002 * scale.size)
        );
    }
    out.push_str("  </tendon>\n");
    Ok(())
}
