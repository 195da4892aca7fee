//! Answers about the octahedral platform nearest to a design.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{DesignRecord, Number, PoseQuaternionRecord, SourceWord};
use ask::Design;
use ask::equivalents::NearestDesigns;
use platform::geom::Pose;
use synthesis::{LengthDeviation, NearestOptions, length_deviation};

view! {
    /// The answer of `equivalents nearest`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestAnswer {
        /// The name of the design.
        pub name: String = design.name.clone(),
        /// Result in words, with the numbers that decided.
        pub explanation: String = explanation,
        /// Greatest distance of a joint beyond its side, in lengths of the side.
        pub extension: f64 = options.extension,
        /// Least `|det A|`.
        pub min_abs_det: f64 = options.min_abs_det,
        /// The nearest octahedral platform; null: no order of the legs around the hexagon gives a regular platform
        /// within these limits.
        pub nearest: Option<NearestRecord> = nearest,
        /// The files written.
        pub paths: Vec<String> = Vec::new(),
    }
    /// The record of the fit to a design.
    pub fn new(design: &Design, options: &NearestOptions, near: Option<&NearestDesigns>) {
        let poses = design.workspace_or_default().sample(&design.home_or_default());
        let nearest = near.and_then(|near| {
            let (own, beside) = (design.manipulator().legs(), near.beside.manipulator().legs());
            Some(NearestRecord::new(design, near, &poses, length_deviation(&own, &beside, &poses)?))
        });
        let explanation = match &nearest {
            None => format!(
                "no order of the six legs around a hexagon gives an octahedral platform with |det A| at least {} \
                 with joints at most {} side lengths beyond the corners",
                options.min_abs_det, options.extension
            ),
            Some(n) if n.error.relative_displacement.0 <= SAME => format!(
                "the legs of the design lie on the sides of two triangles: it is equivalent to an octahedral platform (det A = {})",
                short(n.error.det.0)
            ),
            Some(n) => format!(
                "an octahedral platform whose equivalent has every joint within {} of the design ({} of its size), \
                 and leg lengths within {} at {} poses of the workspace",
                length(n.error.largest_displacement.0, &design.units),
                short(n.error.relative_displacement.0),
                length(n.error.largest_length_deviation.0, &design.units),
                n.poses
            ),
        };
    }
}

view! {
    /// The nearest octahedral platform with the error of replacing the design by it.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestRecord {
        /// Leg on side k of the hexagon, from 1.
        pub order: [usize; 6] = n.order.map(|leg| leg.get() + 1),
        /// Offset `t_k` on side k; 0 or 1 at a corner.
        pub offsets: [Number; 6] = n.offsets.map(Number),
        /// The largest errors.
        #[serde(flatten)]
        pub error: NearestErrorRecord = NearestErrorRecord {
            largest_displacement: Number(largest),
            relative_displacement: Number(largest / design.manipulator().size()),
            largest_length_deviation: Number(worst.value),
            det: Number(n.determinant),
        },
        /// Displacements of both ends by leg, design units.
        pub displacements: [[Number; 2]; 6] = n.displacements.map(|d| d.map(Number)),
        /// RMS of the displacements, the objective of the fit, design units.
        pub rms_displacement: Number = Number(n.rms_displacement()),
        /// Leg with the largest length difference, from 1.
        pub deviating_leg: usize = worst.leg.get() + 1,
        /// Pose of that difference.
        pub deviating_pose: PoseQuaternionRecord = (&poses[worst.pose]).into(),
        /// Number of poses sampled.
        pub poses: usize = poses.len(),
        /// Source of the workspace.
        pub workspace_from: SourceWord = SourceWord::given(!design.workspace.is_empty()),
        /// Whether both fits converged to a local minimum.
        pub converged: bool = n.settled,
        /// Number of nearer fits without regular platform.
        pub set_aside: usize = n.set_aside,
        /// Equivalent platform near the design; its legs are near the legs of the design.
        pub beside: DesignRecord = (&near.beside).into(),
        /// The octahedral platform.
        pub octahedral: DesignRecord = (&near.octahedral).into(),
    }
    fn new(design: &Design, near: &NearestDesigns, poses: &[Pose], worst: LengthDeviation) {
        let n = &near.found;
        let largest = n.largest_displacement();
    }
}

/// The errors of the nearest octahedral platform.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NearestErrorRecord {
    /// Largest displacement of a leg end, design units.
    pub largest_displacement: Number,
    /// Largest displacement over the size.
    pub relative_displacement: Number,
    /// Largest leg length difference over the workspace, design units.
    pub largest_length_deviation: Number,
    /// det A from octahedral to equivalent platform.
    pub det: Number,
}

/// Displacements below this share of the size count as rounding.
const SAME: f64 = 1e-9;

/// A number with six digits.
pub(super) fn short(x: f64) -> String {
    num::shown::rounded(x, 3)
}

/// A length with its unit; designs without a unit have the label `1`.
fn length(x: f64, units: &str) -> String {
    if units == "1" { short(x) } else { format!("{} {units}", short(x)) }
}
