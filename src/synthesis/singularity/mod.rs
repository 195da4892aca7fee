//! Decides at which poses, if at all, the legs hold the platform.
//!
//! *Architectural singularity*: platforms that are singular at every pose, decided exactly and explained. *Parallel
//! singularities*: singular poses, and boxes of poses without any. *Self-motions*: curves of poses with constant leg
//! lengths.
//!
//! A design is *architecturally singular* if its six leg lines are dependent at every pose. [`Architecture::of`]
//! decides it for the joints as written: the exact joints of a design with constructions, or the binary numbers of
//! plain ones. [`SingularityVerdict`] is the common verdict of all commands: plain numbers may be rounded values of a
//! singular design. Theory: `docs/theory/architectural-singularity.md`.

mod case;
mod conditioning;
mod dependency;
mod digit_units;
mod four_planes;
mod griffis_duffy;
mod hold;
mod joint_families;
mod lattice;
mod locus;
mod lower_bound;
mod nearest;
mod nearest_pose;
mod path;
mod regular_box;
mod self_motion;
mod verdict;

pub use self::case::PlanarMap;
pub use self::griffis_duffy::{Assembly, CornerLengths, assembly};
pub use case::{Case, Finding};
pub use conditioning::{Conditioning, conditioning};
pub use dependency::Dependency;
pub use four_planes::four_planes;
pub use griffis_duffy::GriffisDuffy;
pub use hold::{PoseHold, SingularEvidence, SingularOnPath, hold_at, singular_along};
pub use lattice::{GenericRank, RankBound, RationalPose};
pub use locus::{ExactPose, LocusCoefficients, LocusPolynomial, PoseFamily, locus_polynomial};
pub use lower_bound::singular_distance_at_least;
pub use nearest::{NearestSingular, nearest_singular};
pub use nearest_pose::{
    ChangeOfSign, NearestPoseSearch, NearestSingularPose, nearest_singular_pose, nearest_zero,
};
pub use path::{
    ControlPoint, JoinOptions, Joined, PathPiece, Sign, SignsAlong, Way, between, join, signs_along,
    signs_on_curve, straight,
};
pub use regular_box::{
    BoxOptions, RegularBox, Regularity, RegularityWord, SingularSegment, regular_box, regular_workspace,
};
pub use self_motion::{
    AtPose, CriticalPoses, CurveCrossing, CurveDegree, CurveEnd, MotionCurve, MotionEvidence, MotionOptions,
    MotionPoint, PoseVerdict, SelfMotion, critical_poses, curve_degree, motion_at, self_motion,
};
pub use verdict::SingularityVerdict;

use self::dependency::subsets_by_size;
use self::lattice::{candidate_poses, generic_rank, rank_at_least};
use platform::manipulator::{ExactJoints, ExactLegs, Level, Manipulator};

/// The answer for a design as written, with its proof.
#[derive(Debug, Clone, PartialEq)]
pub struct Architecture {
    /// The joints of the proof. `None` without a proof, if joints are known only between bounds: then the ranks are
    /// those of the middles.
    pub level: Option<Level>,
    /// Rank of the six leg vectors, exact.
    pub leg_rank: usize,
    /// Rank of the six leg lines at almost all poses, exact.
    pub jacobian: GenericRank,
    /// All minimal sets of legs with dependent vectors.
    pub dependencies: Vec<Dependency>,
    /// Its cases, the most specific first; empty for a regular design.
    pub findings: Vec<Finding>,
    /// The offsets on the sides of two triangles, if the design is of that type.
    pub griffis_duffy: Option<GriffisDuffy>,
}

impl Architecture {
    /// Decides the design as written, without any tolerance.
    ///
    /// Joints in a field of square roots are decided in that field, doubles as rational numbers. Joints between bounds
    /// are decided if one pose is proved to be regular for all of them; otherwise nothing is decided
    /// ([`level`](Self::level)).
    #[must_use]
    pub fn of(m: &Manipulator) -> Self {
        let level = m.level();
        let exact = ExactJoints::of(m).zip(ExactLegs::of(m));
        if let Some(found) = exact.and_then(|(joints, legs)| Self::decided(m, &joints, &legs, level)) {
            return found;
        }
        if let Some(witness) =
            candidate_poses(m).find(|pose| lower_bound::proved_at_pose(m, &pose.pose()) > 0.0)
        {
            let jacobian = GenericRank { rank: 6, witness, bound: RankBound::Legs };
            let griffis_duffy = GriffisDuffy::recognise(m).filter(|g| !g.is_octahedral());
            let (dependencies, findings) = (Vec::new(), Vec::new());
            return Self { level: Some(level), leg_rank: 6, jacobian, dependencies, findings, griffis_duffy };
        }
        let middles = m.without_values();
        let of_middles = ExactJoints::of(&middles).zip(ExactLegs::of(&middles));
        let found = of_middles.and_then(|(joints, legs)| Self::decided(&middles, &joints, &legs, level));
        let Some(found) = found else { unreachable!("coordinates of a manipulator are finite") };
        Self { level: None, ..found }
    }

    fn decided(m: &Manipulator, joints: &ExactJoints, legs: &ExactLegs, level: Level) -> Option<Self> {
        let all: Vec<usize> = (0..6).collect();
        let leg_rank = legs.rank(&all);
        let jacobian = generic_rank(m, joints, &all, leg_rank)?;
        // with all joints at corners it is the octahedral platform itself
        let griffis_duffy = GriffisDuffy::recognise(m).filter(|g| !g.is_octahedral());
        let dependencies = if leg_rank < 6 { dependency::dependencies(legs) } else { Vec::new() };
        let mut findings = Vec::new();
        if jacobian.rank < 6 {
            findings = case::positional(legs);
            for d in &dependencies {
                let finding = case::of_dependency(legs, d, griffis_duffy.as_ref());
                // four legs of five from one point are dependent too; the point is reported once
                if !findings
                    .iter()
                    .any(|f| f.case == finding.case && d.legs.iter().all(|i| f.legs.contains(i)))
                {
                    findings.push(finding);
                }
            }
            if findings.is_empty() {
                findings.push(case::of_lines(legs, guilty_lines(m, joints, &jacobian)));
            }
        }
        Some(Self { level: Some(level), leg_rank, jacobian, dependencies, findings, griffis_duffy })
    }

    /// Whether the leg lines are dependent at every pose; `None` if undecided.
    #[must_use]
    pub fn is_singular(&self) -> Option<bool> {
        self.level.map(|_| self.jacobian.rank < 6)
    }
}

/// Whether a regular design is singular in doubles: computations in doubles then use the legs of another design.
pub fn rounds_to_singular(m: &Manipulator) -> bool {
    m.level() == Level::ExactJoints
        && Architecture::of(m).is_singular() == Some(false)
        && Architecture::of(&m.without_values()).is_singular() == Some(true)
}

/// A minimal set of legs with dependent lines at every pose, for a design with independent leg vectors.
fn guilty_lines(m: &Manipulator, joints: &ExactJoints, jacobian: &GenericRank) -> Vec<usize> {
    let modulo = joints.residues().next();
    let suspect = |s: &Vec<usize>| {
        // one pose excludes most sets before the proof is needed
        modulo.as_ref().is_some_and(|legs| rank_at_least(legs, s, &jacobian.witness) < s.len())
            && generic_rank(m, joints, s, s.len()).is_some_and(|found| found.rank < s.len())
    };
    subsets_by_size(2).into_iter().find(suspect).unwrap_or_else(|| (0..6).collect())
}
