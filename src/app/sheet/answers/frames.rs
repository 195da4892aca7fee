//! The second design in the frames of the first.

use nalgebra::{UnitQuaternion, Vector3};

use crate::Sheet;
use crate::figure::figure;
use platform::geom::Pose;
use records::{AlignmentOutcome, FramesRecord};
use synthesis::alignment::AlignmentWord;

/// The answer to `--align` and `--exchange`; empty without them.
#[must_use]
pub(super) fn frames(r: &FramesRecord) -> Sheet {
    let mut out = Sheet::new();
    if r.exchanged {
        out.line("Base and platform of the second design are exchanged: its poses are inverse poses.");
    }
    let Some(found) = &r.alignment else { return out };
    out.line(&found.explanation);
    if let AlignmentOutcome::Found { motions, .. } = &found.outcome {
        for (k, m) in motions.iter().enumerate() {
            say!(out, "{:>3}  base      {}", k + 1, motion(&Pose::from(&m.base)));
            say!(out, "     platform  {}", motion(&Pose::from(&m.platform)));
            say!(out, "     residual {}, det A = {}", figure(m.residual.0), figure(m.det.0));
        }
    } else {
        for (name, other) in [("exchanged", &found.exchanged), ("mirrored", &found.mirrored)] {
            if other.status == AlignmentWord::Found {
                say!(out, "The designs are equivalent if the second one is {name}.");
            }
        }
    }
    out.space();
    out
}

/// A motion as axis, angle and shift.
fn motion(p: &Pose) -> String {
    // the axis comes from the quaternion: for a half turn the skew part of the matrix is zero
    let q = UnitQuaternion::from_rotation_matrix(&p.rotation);
    let (axis, angle) = q.axis_angle().map_or((Vector3::z(), 0.0), |(u, t)| (u.into_inner(), t.to_degrees()));
    let vector = |v: &Vector3<f64>| format!("({})", [v.x, v.y, v.z].map(figure).join(", "));
    format!("rotate by {} deg about {}, then shift by {}", figure(angle), vector(&axis), vector(&p.position))
}
