//! Finds out where, and whether at all, the legs hold the platform.
//!
//! *Architectural singularity*: platforms that no pose can hold, decided exactly and explained. *Parallel singularities*: single poses at which the legs
//! do not hold the platform, and boxes of poses without any. *Self-motions*: curves of poses with constant leg lengths.
//!
//! A design is *architecturally singular* when its six leg lines are dependent at every pose. Coordinates are taken as the binary
//! numbers they are; the answer for them is proved either way. Theory: `docs/theory/architectural-singularity.md`.

mod case;
mod conditioning;
mod dependency;
mod four_planes;
mod griffis_duffy;
mod hold;
mod lattice;
mod lower_bound;
mod nearest;
mod path;
mod regular_box;
mod self_motion;

pub use self::case::PlanarMap;
pub use self::griffis_duffy::{Assembly, CornerLengths, assembly};
pub use case::{Case, Finding};
pub use conditioning::{Conditioning, conditioning};
pub use dependency::Dependency;
pub use four_planes::four_planes;
pub use griffis_duffy::GriffisDuffy;
pub use hold::{PoseHold, SingularEvidence, SingularOnPath, hold_at, singular_along};
pub use lattice::{GenericRank, RankBound, RationalPose};
pub use lower_bound::singular_distance_at_least;
pub use nearest::{NearestSingular, nearest_singular};
pub use path::{
    ControlPoint, JoinOptions, Joined, PathPiece, Sign, SignsAlong, Way, between, join, signs_along,
    signs_on_curve, straight,
};
pub use regular_box::{BoxOptions, RegularBox, Regularity, SingularSegment, regular_box, regular_workspace};
pub use self_motion::{
    AtPose, CriticalPoses, CurveDegree, CurveEnd, MotionCurve, MotionEvidence, MotionOptions, MotionPoint,
    PoseVerdict, SelfMotion, critical_poses, curve_degree, motion_at, self_motion,
};

use self::dependency::subsets_by_size;
use self::lattice::{generic_rank, rank_at_least};
use crate::manipulator::{ExactLegs, Manipulator};

/// The answer for a design as it is written, with what proves it.
#[derive(Debug, Clone, PartialEq)]
pub struct Architecture {
    /// Rank of the six leg vectors, exact.
    pub leg_rank: usize,
    /// Rank of the six leg lines at almost all poses, exact.
    pub jacobian: GenericRank,
    /// All smallest sets of legs with dependent vectors.
    pub dependencies: Vec<Dependency>,
    /// The cases it falls under, most telling first; empty for a regular design.
    pub findings: Vec<Finding>,
    /// The offsets on the sides of two triangles, where the design is of that type.
    pub griffis_duffy: Option<GriffisDuffy>,
}

impl Architecture {
    /// Decides the design as it is written: no tolerance takes part.
    #[must_use]
    pub fn of(m: &Manipulator) -> Self {
        let Some(legs) = ExactLegs::of(&m.legs()) else {
            unreachable!("coordinates of a manipulator are finite")
        };
        let all: Vec<usize> = (0..6).collect();
        let leg_rank = legs.rank(&all);
        let jacobian = generic_rank(m, &all, leg_rank);
        // with all joints at corners it is the octahedral platform itself
        let griffis_duffy = GriffisDuffy::recognise(m).filter(|g| !g.is_octahedral());
        let dependencies = if leg_rank < 6 { legs.dependencies() } else { Vec::new() };
        let mut findings = Vec::new();
        if jacobian.rank < 6 {
            findings = case::positional(&legs);
            for d in &dependencies {
                let finding = case::of_dependency(&legs, d, griffis_duffy.as_ref());
                // four legs of five from one point depend as well: the point says it once
                if !findings
                    .iter()
                    .any(|f| f.case == finding.case && d.legs.iter().all(|i| f.legs.contains(i)))
                {
                    findings.push(finding);
                }
            }
            if findings.is_empty() {
                findings.push(case::of_lines(&legs, guilty_lines(m, &jacobian)));
            }
        }
        Self { leg_rank, jacobian, dependencies, findings, griffis_duffy }
    }

    /// Whether the leg lines are dependent at every pose.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.jacobian.rank < 6
    }
}

/// A smallest set of legs whose lines are dependent at every pose, for a design with independent leg vectors.
fn guilty_lines(m: &Manipulator, jacobian: &GenericRank) -> Vec<usize> {
    let legs = m.legs();
    let suspect = |s: &Vec<usize>| {
        let chosen: Vec<_> = s.iter().map(|i| legs[*i]).collect();
        // one pose sorts most sets out before the proof is asked
        rank_at_least(&chosen, &jacobian.witness) < s.len() && generic_rank(m, s, s.len()).rank < s.len()
    };
    subsets_by_size(2).into_iter().find(suspect).unwrap_or_else(|| (0..6).collect())
}
