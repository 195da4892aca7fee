//! The proof that requirements on the legs are met: at home, at the listed poses, over the region of the workspace, and
//! along the ranges of single coordinates.

use super::super::limits::COORDINATES;
use super::{
    Claim, ExactNumbersOfPose, LegBodyText, LegWeightsText, LoadText, PairText, PoseText, ProofFile,
    RegionText, of_double,
};
use ask::{AssessReport, Design};
use machine::requirements::{
    CoordinateRange, LeastMargins, LegRequirement, Load, MarginBound, PoseSpace, Requirements, TermKind,
    Terms, TiledRegion,
};
use nalgebra::Vector3;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator};
use synthesis::singularity::Regularity;

/// Margins are claimed less this share of their reference value, far above the rounding of their evaluation.
const ROUNDING: f64 = 1e-9;
/// The share of the proved least margin that is claimed over a region: smaller margins need fewer cells.
const CLAIMED: f64 = 0.5;

/// The reason for leaving out a requirement without a tiling.
const UNTILED: &str = "it is not proved with a margin, or its tiling needs too many cells";

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
    manipulator: &'a Manipulator,
    terms: Terms<'a>,
    required: &'a Requirements,
    size: f64,
    poses: Vec<Pose>,
    /// The least margin of each kind of requirement at these poses.
    least: LeastMargins<()>,
    regions: Vec<StatedRegion>,
}

/// The region of the workspace, or a range of a single coordinate as a region.
struct StatedRegion {
    /// The end of the names of its claims.
    name: String,
    /// The end of a statement about its poses.
    place: String,
    text: RegionText,
    /// `None`: its rotations are too large for tilings.
    tiled: Option<TiledRegion>,
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
        for pose in &poses {
            least.see(terms.at(pose), ());
        }
        let assessed = Assessed {
            place: k,
            manipulator: m,
            terms,
            required: &required,
            size: m.size(),
            poses,
            least,
            regions: StatedRegion::all(design, &space),
        };
        for bound in &report.proof.bounds {
            proof.margin(&assessed, bound);
        }
        for (i, pose) in assessed.poses.iter().enumerate() {
            let id = if i == 0 { "regular-home".to_owned() } else { format!("regular-pose-{i}") };
            proof.regular_pose(id, (k, &legs), &pose.into(), false);
        }
        for region in &assessed.regions {
            proof.regular_region(&assessed, region, report.regularity == Regularity::Regular);
        }
        if report.assessed_poses.trajectory > 0 {
            let statement = "the requirements on the motions between the poses of the trajectory";
            proof.leave_out(statement, "the claims are about the poses themselves");
        }
        proof
    }

    fn margin(&mut self, a: &Assessed<'_>, bound: &MarginBound) {
        let kind = bound.found.term.kind;
        let at_least = CLAIMED * bound.below;
        match kind {
            TermKind::LegClearance => return self.leg_clearance(a, at_least),
            TermKind::LegForce => return self.leg_force(a, at_least),
            _ => {}
        }
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
        for region in &a.regions {
            let trees = region.tiled.as_ref().filter(|_| at_least > 0.0).and_then(|tiled| {
                let trees = (0..6).map(|leg| tiled.leg_tiling(leg, on_legs.of_leg(leg, &a.terms, at_least)));
                trees.collect::<Option<Vec<String>>>()
            });
            let Some(trees) = trees else {
                self.leave_out(format!("{} {}", kind.label(), region.place), region.reason(UNTILED));
                continue;
            };
            let claim = Claim::MarginOverRegion {
                design: a.place,
                requirement: kind,
                at_least: of_double(at_least),
                limits: limits.clone(),
                axes: axes.clone(),
                region: Box::new(region.text.clone()),
                trees,
            };
            self.claim(format!("{}-{}", kind.code(), region.name), claim);
        }
    }

    /// A requirement that is proved by tilings alone: over the regions, and at the single poses.
    fn tiled(
        &mut self,
        a: &Assessed<'_>,
        kind: TermKind,
        at_least: f64,
        claim: impl Fn(&TiledRegion, &StatedRegion) -> Option<Claim>,
    ) {
        if !(at_least > 0.0) {
            self.leave_out(kind.label(), "it is not proved with a margin");
            return;
        }
        let single = a.poses.iter().enumerate().map(|(k, pose)| StatedRegion::single(a.manipulator, k, pose));
        for region in a.regions.iter().chain(&single.collect::<Vec<_>>()) {
            match region.tiled.as_ref().and_then(|tiled| claim(tiled, region)) {
                Some(claim) => self.claim(format!("{}-{}", kind.code(), region.name), claim),
                None => self.leave_out(format!("{} {}", kind.label(), region.place), region.reason(UNTILED)),
            }
        }
    }

    fn leg_clearance(&mut self, a: &Assessed<'_>, at_least: f64) {
        let hardware = &a.required.hardware;
        let Some(body) = hardware.leg_body else { return };
        let clearance = hardware.leg_clearance.unwrap_or(0.0);
        let shared = a.manipulator.pairs();
        let apart = |[i, j]: &[usize; 2]| shared[*i].0 != shared[*j].0 && shared[*i].1 != shared[*j].1;
        let pairs: Vec<[usize; 2]> =
            (0..6).flat_map(|i| (i + 1..6).map(move |j| [i, j])).filter(apart).collect();
        self.tiled(a, TermKind::LegClearance, at_least, |tiled, region| {
            let tiling = |legs: &[usize; 2]| {
                let (tree, directions) = tiled.pair_tiling(*legs, &body, (clearance + at_least).next_up())?;
                Some(PairText { legs: legs.map(|leg| leg + 1), tree, directions })
            };
            Some(Claim::LegClearance {
                design: a.place,
                at_least: of_double(at_least),
                clearance: of_double(clearance),
                body: LegBodyText {
                    diameter: of_double(body.diameter),
                    cylinder_length: body.rod.map(|(length, _)| of_double(length)),
                    rod_diameter: body.rod.map(|(_, diameter)| of_double(diameter)),
                },
                region: Box::new(region.text.clone()),
                pairs: pairs.iter().map(tiling).collect::<Option<_>>()?,
            })
        });
    }

    fn leg_force(&mut self, a: &Assessed<'_>, at_least: f64) {
        let kind = TermKind::LegForce;
        let Some(limit) = a.required.hardware.drive_limit(kind) else { return };
        self.tiled(a, kind, at_least, |tiled, region| {
            let tiling = |load: &Load| {
                let tree = tiled.force_tiling(load, (limit - at_least).next_down())?;
                Some(LoadText::new(load, tree))
            };
            Some(Claim::LegForce {
                design: a.place,
                at_least: of_double(at_least),
                limit: of_double(limit),
                unit: of_double(tiled.unit()),
                region: Box::new(region.text.clone()),
                loads: a.required.loads.iter().map(tiling).collect::<Option<_>>()?,
            })
        });
    }

    fn regular_region(&mut self, a: &Assessed<'_>, region: &StatedRegion, regular: bool) {
        let tiled = region.tiled.as_ref().filter(|_| regular);
        if let Some((unit, tree)) = tiled.and_then(|tiled| Some((tiled.unit(), tiled.regular_tiling()?))) {
            let (unit, text) = (of_double(unit), Box::new(region.text.clone()));
            let claim = Claim::RegularRegion { design: a.place, region: text, unit, tree };
            self.claim(format!("regular-{}", region.name), claim);
        } else {
            let reason = "it is not proved nonzero, or its tiling needs too many cells";
            self.leave_out(format!("det J {}", region.place), region.reason(reason));
        }
    }
}

impl StatedRegion {
    /// The region of a design, if it states one, and its ranges.
    fn all(design: &Design, space: &PoseSpace) -> Vec<Self> {
        let (m, workspace) = (design.manipulator(), &design.workspace);
        let region = workspace.has_box().then(|| Self {
            name: "region".to_owned(),
            place: "over the region".to_owned(),
            text: RegionText::new(space, workspace.translation, workspace.rotation_deg),
            tiled: TiledRegion::new(m, space),
        });
        let ranges = (0..6).filter(|k| !space.ranges[*k].is_still());
        let alone = ranges.zip(space.ranges_alone()).map(|(k, space)| {
            let still = CoordinateRange::default();
            let [x, y, z, roll, pitch, yaw] =
                std::array::from_fn(|i| if i == k { workspace.ranges[k] } else { still });
            Self {
                name: COORDINATES[k].to_owned(),
                place: format!("along the range of {}", COORDINATES[k]),
                text: RegionText::new(&space, [x, y, z], [roll, pitch, yaw]),
                tiled: TiledRegion::new(m, &space),
            }
        });
        region.into_iter().chain(alone).collect()
    }

    /// A pose of the list as a region: home is the first.
    fn single(m: &Manipulator, k: usize, pose: &Pose) -> Self {
        let space = PoseSpace::at(*pose);
        let still = [CoordinateRange::default(); 3];
        let (name, place) = match k {
            0 => ("home".to_owned(), "at home".to_owned()),
            k => (format!("pose-{k}"), format!("at pose {k} of the list")),
        };
        let text = RegionText::new(&space, still, still);
        Self { name, place, text, tiled: TiledRegion::new(m, &space) }
    }

    /// The reason why a claim is left out.
    fn reason(&self, otherwise: &'static str) -> &'static str {
        if self.tiled.is_some() { otherwise } else { "its rotations may exceed 250 degrees" }
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

impl LoadText {
    fn new(load: &Load, tree: String) -> Self {
        let vector = |v: Vector3<f64>| <[f64; 3]>::from(v).map(of_double);
        Self {
            name: load.name.clone(),
            force: vector(load.force),
            torque: vector(load.torque),
            at: vector(load.at.coords),
            fixed_to: load.fixed_to,
            leg_weights: load
                .legs
                .map(|legs| LegWeightsText { rod: vector(legs.rod), moment: vector(legs.moment) }),
            tree,
        }
    }
}

impl RegionText {
    /// The region of a space with these intervals, as the design states them.
    fn new(space: &PoseSpace, translation: [CoordinateRange; 3], rotation_deg: [CoordinateRange; 3]) -> Self {
        let ends = |range: CoordinateRange| [range.min, range.max].map(of_double);
        Self {
            shape: space.region,
            home: PoseText::from(&ExactNumbersOfPose::from(&space.home)),
            pivot: <[f64; 3]>::from(space.pivot).map(of_double),
            translation: translation.map(ends),
            rotation_deg: rotation_deg.map(ends),
        }
    }
}
