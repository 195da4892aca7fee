//! The proof that requirements on the legs are met: at home, at the listed poses, and over the region of the workspace.

use super::{Claim, ExactNumbersOfPose, PoseText, ProofFile, RegionText, of_double};
use ask::{AssessReport, Design};
use machine::requirements::{
    LeastMargins, LegRequirement, MarginBound, PoseSpace, Requirements, TermKind, Terms, TiledRegion,
};
use platform::geom::Pose;
use platform::manipulator::Body;
use synthesis::singularity::Regularity;

/// Margins are claimed less this share of their reference value, far above the rounding of their evaluation.
const ROUNDING: f64 = 1e-9;
/// The share of the proved least margin that is claimed over a region: smaller margins need fewer cells.
const CLAIMED: f64 = 0.5;

/// A requirement on the legs.
#[derive(Clone, Copy)]
enum OnLegs {
    MinLength(f64),
    MaxLength(f64),
    /// Limits in degrees of the angles at the joints of a body.
    ConeAngles(Body, [f64; 6]),
}

/// A design with its requirements, and its place in the file.
struct Assessed<'a> {
    place: usize,
    terms: Terms<'a>,
    required: &'a Requirements,
    size: f64,
    poses: Vec<Pose>,
    /// The least margin of each kind of requirement at these poses.
    least: LeastMargins<()>,
    region: Option<(TiledRegion, RegionText)>,
}

impl ProofFile {
    /// The proof of an answer of `assess`.
    #[must_use]
    pub fn assess(design: &Design, report: &AssessReport) -> Self {
        let mut proof = Self::of("assess");
        let (m, required) = (design.manipulator(), design.requirements());
        if required.cranks.is_some() || required.hardware.is_coupled() {
            proof.leave_out(
                "the requirements",
                "the checker knows ideal legs, without cranks and joint offsets",
            );
            return proof;
        }
        let Some((k, legs)) = proof.design((&design.name, &design.units), m, "the requirements") else {
            return proof;
        };
        let space = design.workspace.space(&design.home_or_default());
        let listed = std::iter::once(&space.home).chain(&space.poses).chain(&space.trajectory);
        let poses: Vec<Pose> = listed.copied().collect();
        let terms = Terms::new(m, &required, &space.home);
        let mut least = LeastMargins::default();
        poses.iter().for_each(|pose| least.see(terms.at(pose), ()));
        let assessed = Assessed {
            place: k,
            terms,
            required: &required,
            size: m.size(),
            poses,
            least,
            region: TiledRegion::new(m, &space).map(|tiled| (tiled, (&space).into())),
        };
        for bound in &report.proof.bounds {
            proof.margin(&assessed, bound);
        }
        for (i, pose) in assessed.poses.iter().enumerate() {
            let id = if i == 0 { "regular-home".to_owned() } else { format!("regular-pose-{i}") };
            proof.regular_pose(id, (k, &legs), &pose.into(), false);
        }
        match assessed.region {
            Some(_) => proof.regular_region(&assessed, report.regularity == Regularity::Regular),
            None if report.assessed_poses.region => proof.leave_out(
                "the requirements over the region",
                "the checker knows regions with home in their middle, without pivot and with rotations below 250 degrees",
            ),
            None => {}
        }
        if report.assessed_poses.ranges > 0 {
            let statement = "the requirements along the ranges of single coordinates";
            proof.leave_out(statement, "the checker knows regions and single poses");
        }
        if report.assessed_poses.trajectory > 0 {
            let statement = "the requirements on the motions between the poses of the trajectory";
            proof.leave_out(statement, "the claims are about the poses themselves");
        }
        proof
    }

    fn margin(&mut self, a: &Assessed<'_>, bound: &MarginBound) {
        let kind = bound.found.term.kind;
        let Some(on_legs) = OnLegs::of(a.required, kind) else {
            self.leave_out(kind.label(), "the checker does not evaluate this requirement");
            return;
        };
        let least = a.least.of(kind).unwrap_or(f64::INFINITY) - ROUNDING * a.required.scale_of(kind, a.size);
        if !(least.is_finite() && least >= 0.0) {
            self.leave_out(kind.label(), "it is violated or at its limit at one of the poses");
            return;
        }
        let limits = on_legs.limits().map(of_double).to_vec();
        let axes = on_legs.body().map(|body| {
            a.terms.axes()[body.index()].map(|axis| [axis.x, axis.y, axis.z].map(of_double)).to_vec()
        });
        let claim = Claim::Margin {
            design: a.place,
            requirement: kind,
            at_least: of_double(least),
            limits: limits.clone(),
            axes: axes.clone(),
            poses: a.poses.iter().map(|pose| PoseText::from(&ExactNumbersOfPose::from(pose))).collect(),
        };
        self.claim(kind.code(), claim);
        let Some((tiled, region)) = &a.region else { return };
        let at_least = CLAIMED * bound.below;
        let trees = (at_least > 0.0).then(|| {
            let trees = (0..6).map(|leg| tiled.leg_tiling(leg, on_legs.of_leg(leg, &a.terms, at_least)));
            trees.collect::<Option<Vec<String>>>()
        });
        let Some(trees) = trees.flatten() else {
            let statement = format!("{} over the region", kind.label());
            self.leave_out(statement, "it is not proved with a margin, or its tiling needs too many cells");
            return;
        };
        let claim = Claim::MarginOverRegion {
            design: a.place,
            requirement: kind,
            at_least: of_double(at_least),
            limits,
            axes,
            region: Box::new(region.clone()),
            trees,
        };
        self.claim(format!("{}-region", kind.code()), claim);
    }

    fn regular_region(&mut self, a: &Assessed<'_>, regular: bool) {
        let tiled = a.region.as_ref().filter(|_| regular);
        let found = tiled.and_then(|(tiled, region)| Some((tiled.unit(), region, tiled.regular_tiling()?)));
        match found {
            Some((unit, region, tree)) => {
                let (unit, region) = (of_double(unit), Box::new(region.clone()));
                self.claim("regular-region", Claim::RegularRegion { design: a.place, region, unit, tree });
            }
            None => self.leave_out(
                "det J over the region",
                "it is not proved nonzero, or its tiling needs too many cells",
            ),
        }
    }
}

impl OnLegs {
    /// `None` for requirements that the checker does not evaluate.
    fn of(required: &Requirements, kind: TermKind) -> Option<Self> {
        let hardware = &required.hardware;
        let lengths = || hardware.leg_length.map(|limits| limits.range());
        match kind {
            TermKind::MinLegLength => lengths().map(|(least, _)| Self::MinLength(least)),
            TermKind::MaxLegLength => lengths().map(|(_, greatest)| Self::MaxLength(greatest)),
            TermKind::BaseConeAngle => {
                hardware.base_cone_angle.map(|cone| Self::ConeAngles(Body::Base, cone.limits_deg))
            }
            TermKind::PlatformConeAngle => {
                hardware.platform_cone_angle.map(|cone| Self::ConeAngles(Body::Platform, cone.limits_deg))
            }
            _ => None,
        }
    }

    fn limits(self) -> [f64; 6] {
        match self {
            Self::MinLength(limit) | Self::MaxLength(limit) => [limit; 6],
            Self::ConeAngles(_, limits) => limits,
        }
    }

    /// The body whose joints have axes.
    fn body(self) -> Option<Body> {
        match self {
            Self::MinLength(_) | Self::MaxLength(_) => None,
            Self::ConeAngles(body, _) => Some(body),
        }
    }

    /// The requirement on one leg with a margin.
    fn of_leg(self, leg: usize, terms: &Terms<'_>, margin: f64) -> LegRequirement {
        match self {
            Self::MinLength(limit) => LegRequirement::MinLength((limit + margin).next_up()),
            Self::MaxLength(limit) => LegRequirement::MaxLength((limit - margin).next_down()),
            Self::ConeAngles(body, limits) => LegRequirement::ConeAngle {
                body,
                axis: terms.axes()[body.index()][leg],
                limit_deg: (limits[leg] - margin).next_down(),
            },
        }
    }
}

impl From<&PoseSpace> for RegionText {
    fn from(space: &PoseSpace) -> Self {
        Self {
            shape: space.region,
            home: PoseText::from(&ExactNumbersOfPose::from(&space.home)),
            translation: <[f64; 3]>::from(space.translation).map(of_double),
            rotation_deg: <[f64; 3]>::from(space.rotation_deg).map(of_double),
        }
    }
}
