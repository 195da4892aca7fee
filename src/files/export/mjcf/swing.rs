//! Cone angles of the ball joints at the platform, for legs and for rods on cranks.
//!
//! The range of a ball joint limits its whole rotation, including that about the leg. Legs 2 to 6 have a `connect`
//! instead of a ball joint. A tendon between two points acts as a cone. Relative to the joint, its ends are `-h u` on
//! the rod and `-h k` on the joint axis. The unit vectors `u` and `k` enclose the angle `t`. Its length is
//!
//! ```text
//! |h u - h k| = 2 h sin(t / 2).
//! ```

use std::fmt::Write as _;

use nalgebra::Vector3;

use super::{Export, ExportLeg, Scale, Unsupported, real};
use machine::requirements::JointAxes;

/// Distance of both tendon ends from the joint, over the leg length at home or the rod length.
const AWAY: f64 = 0.1;

/// The comment of a model about the tendons.
pub(super) const COMMENT: &str = "  Tendon swingN limits the swing at the platform: it joins a site of rod N to one behind its joint on the axis of the joint, as far from it, so that its length is twice\n  that distance times the sine of half the angle between rod and axis, and that of no turn about the rod.\n";

/// The greatest angle of a leg or a rod (from 0) at the platform, radians, if the design limits it.
fn limit(export: &Export, leg: usize) -> Option<f64> {
    let most = match &export.cranks {
        Some(cranks) => cranks.platform_cone_angle,
        None => export.hardware.platform_cone_angle.map(|swing| swing.limits_deg[leg].to_radians()),
    };
    most.filter(|most| *most < std::f64::consts::PI)
}

/// Whether the angle of any leg at the platform is limited.
pub(super) fn is_limited(export: &Export) -> bool {
    (0..6).any(|leg| limit(export, leg).is_some())
}

/// The tendon of a leg or of a rod.
pub(super) struct ConeTendon {
    number: usize,
    /// Distance of its ends from the joint, design units.
    away: f64,
    /// Position of the joint along the third axis of the body called rod, design units.
    joint: f64,
    /// Its end on the platform, platform frame.
    seat: Vector3<f64>,
    /// Its greatest length, design units.
    longest: f64,
}

impl ConeTendon {
    /// `None` without a limit.
    pub(super) fn of(export: &Export, leg: &ExportLeg) -> Result<Option<Self>, Unsupported> {
        let Some(most) = limit(export, leg.number - 1) else { return Ok(None) };
        let to_platform = export.home.rotation.inverse();
        let (axis, length, joint) = if let Some(cranks) = &export.cranks {
            // the body of a rod begins at the tip of its crank, that of a leg at the platform
            let i = leg.number - 1;
            let tip = cranks.platform.tip(i, cranks.home_angles[i]);
            let end = export.home.transform(&cranks.platform.legs()[i].platform);
            let along = (end - tip).try_normalize(0.0).ok_or(Unsupported::NoDirection { leg: leg.number })?;
            let rod = cranks.platform.legs()[i].rod;
            (to_platform * along, rod, rod)
        } else {
            let axis = match export.hardware.platform_cone_angle.map(|swing| swing.axes) {
                Some(JointAxes::Given(axes)) => axes[leg.number - 1].into_inner(),
                _ => to_platform * leg.direction()?,
            };
            (axis, leg.length(), 0.0)
        };
        let away = AWAY * length;
        let seat = export.bodies[1].joints[leg.platform].at.coords - axis * away;
        Ok(Some(Self { number: leg.number, away, joint, seat, longest: 2.0 * away * (0.5 * most).sin() }))
    }

    /// Its site on the rod, whose third axis is the leg.
    pub(super) fn at_rod(&self, out: &mut String, scale: &Scale) {
        let at = scale.at(&Vector3::new(0.0, 0.0, self.joint - self.away));
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
        let Some(tendon) = ConeTendon::of(export, leg)? else { continue };
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
