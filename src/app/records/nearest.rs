//! Answers about the octahedral platform nearest to a design.

use schemars::JsonSchema;
use serde::Serialize;

use super::{DesignRecord, Number, PoseQuaternionRecord, SourceWord};
use ask::Design;
use ask::equivalents::NearestDesigns;
use platform::geom::Pose;
use synthesis::{LengthDeviation, NearestOptions, length_deviation};

/// The answer of `equivalents nearest`.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NearestAnswer {
    /// The name of the design.
    pub name: String,
    /// One sentence with the numbers that decided.
    pub explanation: String,
    /// How far a joint may lie outside its side, on its extension, in lengths of the side.
    pub extension: f64,
    /// Least `|det A|`.
    pub min_abs_det: f64,
    /// What was found; null: no way to lay the legs round a hexagon gives a regular platform within these limits.
    pub nearest: Option<NearestRecord>,
    /// The files written.
    pub paths: Vec<String>,
}

/// The nearest octahedral platform with the error it would make.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct NearestRecord {
    /// The leg on side k of the hexagon, from 1.
    pub order: [usize; 6],
    /// `t_k` of the leg on side k, 0 or 1 at a corner.
    pub offsets: [Number; 6],
    /// det A of the map from the octahedral platform to the platform beside the design.
    pub det: Number,
    /// How far the base end and the platform end of each leg have moved, design units.
    pub displacements: [[Number; 2]; 6],
    /// The largest of them.
    pub largest_displacement: Number,
    /// The root of the mean of their squares, which is what was made small.
    pub rms_displacement: Number,
    /// The largest displacement over the size of the design.
    pub relative_displacement: Number,
    /// The largest difference of leg lengths between the design and the platform beside it, over the poses of the
    /// workspace.
    pub largest_length_deviation: Number,
    /// The leg, from 1.
    pub deviating_leg: usize,
    /// The pose.
    pub deviating_pose: PoseQuaternionRecord,
    /// Poses looked at.
    pub poses: usize,
    /// Whose workspace that is.
    pub workspace_from: SourceWord,
    /// Both fits have settled: this is a local minimum.
    pub settled: bool,
    /// Ways round the hexagon that came nearer but are no regular platform.
    pub set_aside: usize,
    /// The platform beside the design: every leg next to one of its legs, equivalent to the octahedral platform.
    pub beside: DesignRecord,
    /// The octahedral platform.
    pub octahedral: DesignRecord,
}

impl NearestRecord {
    fn new(design: &Design, near: &NearestDesigns, poses: &[Pose], worst: LengthDeviation) -> Self {
        let n = &near.found;
        let largest = n.largest_displacement();
        Self {
            order: n.order.map(|leg| leg.get() + 1),
            offsets: n.offsets.map(Number),
            det: Number(n.determinant),
            displacements: n.displacements.map(|d| d.map(Number)),
            largest_displacement: Number(largest),
            rms_displacement: Number(n.rms_displacement()),
            relative_displacement: Number(largest / design.manipulator().size()),
            largest_length_deviation: Number(worst.value),
            deviating_leg: worst.leg.get() + 1,
            deviating_pose: (&poses[worst.pose]).into(),
            poses: poses.len(),
            workspace_from: SourceWord::given(!design.workspace.is_empty()),
            settled: n.settled,
            set_aside: n.set_aside,
            beside: (&near.beside).into(),
            octahedral: (&near.octahedral).into(),
        }
    }
}

impl NearestAnswer {
    /// What was found for a design.
    #[must_use]
    pub fn new(design: &Design, options: &NearestOptions, near: Option<&NearestDesigns>) -> Self {
        let poses = design.workspace_or_default().sample(&design.home_or_default());
        let nearest = near.and_then(|near| {
            let (own, beside) = (design.manipulator().legs(), near.beside.manipulator().legs());
            Some(NearestRecord::new(design, near, &poses, length_deviation(&own, &beside, &poses)?))
        });
        let explanation = match &nearest {
            None => format!(
                "no way to lay the six legs round a hexagon gives an octahedral platform with |det A| at least {} \
                 and joints at most {} lengths of their side beyond its corners",
                options.min_abs_det, options.extension
            ),
            Some(n) if n.relative_displacement.0 <= SAME => format!(
                "the legs of the design lie on the sides of two triangles: it is equivalent to an octahedral platform (det A = {})",
                short(n.det.0)
            ),
            Some(n) => format!(
                "an octahedral platform whose equivalent has every joint within {} {} of the design ({} of its size), \
                 and leg lengths within {} {} at {} poses of the workspace",
                short(n.largest_displacement.0),
                design.units,
                short(n.relative_displacement.0),
                short(n.largest_length_deviation.0),
                design.units,
                n.poses
            ),
        };
        Self {
            name: design.name.clone(),
            explanation,
            extension: options.extension,
            min_abs_det: options.min_abs_det,
            nearest,
            paths: Vec::new(),
        }
    }

    /// Whether the design itself lies on the sides of two triangles, within rounding.
    #[must_use]
    pub fn is_the_design(&self) -> bool {
        self.nearest.as_ref().is_some_and(|n| n.relative_displacement.0 <= SAME)
    }
}

/// Displacements below this share of the size are rounding.
const SAME: f64 = 1e-9;

/// Three digits, for a sentence.
pub(super) fn short(x: f64) -> String {
    num::shown::rounded(x, 3)
}
