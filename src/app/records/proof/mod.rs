//! Proof files: the proved claims of an answer, each with the data by which another program checks it.
//!
//! All numbers are exact and written as text, such as `-3/4` or `1/2 + sqrt(3)/6`. The program `equipod-check`
//! (`src/app/python/equipod_check/check.py`) recomputes every claim from the designs in the file. A result that it
//! cannot check is no claim: [`ProofFile::not_included`] names it with the reason. The format is in `docs/claims.md`.

mod assess;
mod check;
mod fk;
mod verify;

use serde::Serialize;

use num::algebraic::Algebraic;
use num::exact::{Rational, determinant, rational, relations};
use platform::geom::Pose;
use platform::manipulator::{Body, ExactLegs, Level, Manipulator};
use synthesis::singularity::RationalPose;

use super::SCHEMA_VERSION;
use machine::requirements::{Region, TermKind};

/// A proof file.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ProofFile {
    schema_version: u32,
    /// The command whose answer the claims belong to.
    equipod_proof: &'static str,
    equipod_version: &'static str,
    designs: Vec<ProofDesign>,
    /// Sets of lengths between joint centres, design units.
    lengths: Vec<[String; 6]>,
    claims: Vec<NamedClaim>,
    not_included: Vec<LeftOut>,
}

/// The exact joints of a design, leg by leg.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ProofDesign {
    name: String,
    units: String,
    joints: Level,
    legs: Vec<ProofLeg>,
}

/// The exact ends of a leg.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ProofLeg {
    base: Vec<String>,
    platform: Vec<String>,
}

/// A claim with its name in the file and the page of its theorem.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct NamedClaim {
    id: String,
    /// The page in `docs/theory`.
    theorem: &'static str,
    #[serde(flatten)]
    claim: Claim,
}

/// A statement that `equipod-check` checks. Designs and lengths are given by their places in the file.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "claim", rename_all = "snake_case")]
enum Claim {
    /// The squared lengths of `to` are `A s + c` of those of `from` at every pose.
    LegMap {
        from: usize,
        to: usize,
        #[serde(rename = "A")]
        a: Vec<Vec<String>>,
        c: Vec<String>,
        det: String,
    },
    /// The squared lengths of these legs of `to`, from 1, are no affine functions of those of `from`.
    NoLegMap { from: usize, to: usize, legs: Vec<usize> },
    /// The combination of the leg vectors is zero, that of the squared lengths constant.
    Dependency { design: usize, coefficients: Vec<String>, constant: String },
    /// Rank of the leg vectors.
    LegRank { design: usize, rank: usize },
    /// The leg lines are independent at the pose.
    RegularPose {
        design: usize,
        pose: PoseText,
        /// `det J` with the rows `(n, a x n)`; absent: only its sign is stated.
        #[serde(skip_serializing_if = "Option::is_none")]
        det: Option<String>,
        sign: i8,
    },
    /// Rank of the leg lines at almost every pose, attained at this one.
    GenericRank { design: usize, rank: usize, pose: PoseText },
    /// The leg lines are dependent at the poses that decide all poses.
    DependentLines { design: usize },
    /// An upper bound on isolated poses for any lengths.
    PoseBound { design: usize, poses: usize, by: BoundWord },
    /// The bound of an equivalent design: the claims of the leg map to this design, and of the bound.
    EquivalentBound { design: usize, poses: usize, leg_map: String, bound: String },
    /// One pose near a centre in Study coordinates.
    Root(Box<RootClaim>),
    /// The poses are different and all.
    Complete { design: usize, lengths: usize, roots: Vec<String>, bound: String, real: usize },
    /// The poses are different.
    Distinct { roots: Vec<String> },
    /// The lengths contradict this relation of the leg vectors.
    NoPose { design: usize, lengths: usize, coefficients: Vec<String> },
    /// A requirement on the legs is met with this margin at the poses.
    Margin {
        design: usize,
        requirement: TermKind,
        at_least: String,
        limits: Vec<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        axes: Option<Vec<[String; 3]>>,
        poses: Vec<PoseText>,
    },
    /// The same at every pose of a region, by a tiling for each leg.
    MarginOverRegion {
        design: usize,
        requirement: TermKind,
        at_least: String,
        limits: Vec<String>,
        #[serde(skip_serializing_if = "Option::is_none")]
        axes: Option<Vec<[String; 3]>>,
        region: Box<RegionText>,
        trees: Vec<String>,
    },
    /// The gap of any two legs without a shared joint is the clearance and this margin at every pose of a region.
    LegClearance {
        design: usize,
        at_least: String,
        clearance: String,
        body: LegBodyText,
        region: Box<RegionText>,
        pairs: Vec<PairText>,
    },
    /// Every leg force under each load is the limit less this margin at most, at every pose of a region. Moments are
    /// divided by the unit.
    LegForce {
        design: usize,
        at_least: String,
        limit: String,
        unit: String,
        region: Box<RegionText>,
        loads: Vec<LoadText>,
    },
    /// `det J` is nonzero at every pose of a region, by a tiling; moments are divided by the unit.
    RegularRegion { design: usize, region: Box<RegionText>, unit: String, tree: String },
}

/// The poses `R = exp([w]x) R_home`, `p = p_home + d + R_home q - R q` with the pivot `q`, platform frame.
///
/// The intervals of `d` and `w`, base frame, are measured from home; an ellipsoid touches them.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct RegionText {
    shape: Region,
    home: PoseText,
    pivot: [String; 3],
    translation: [[String; 2]; 3],
    rotation_deg: [[String; 2]; 3],
}

/// The body of each leg: all points within half a diameter of the cylinder, which begins at the base joint, or of the
/// rod, which continues to the platform joint. Without rod the cylinder is the whole leg.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LegBodyText {
    diameter: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    cylinder_length: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    rod_diameter: Option<String>,
}

/// A force at a point of the platform frame and a torque, which keep their direction in the frame of a body, with the
/// weights of the legs and the tiling.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LoadText {
    name: String,
    force: [String; 3],
    torque: [String; 3],
    at: [String; 3],
    fixed_to: Body,
    #[serde(skip_serializing_if = "Option::is_none")]
    leg_weights: Option<LegWeightsText>,
    tree: String,
}

/// The force `rod + (moment - u (u . moment)) / q` on the platform joint of each leg with length `q` and direction `u`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LegWeightsText {
    rod: [String; 3],
    moment: [String; 3],
}

/// The tiling for two legs, from 1, and a direction for each pair of their parts on each cell.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct PairText {
    legs: [usize; 2],
    tree: String,
    directions: String,
}

/// Exactly one pose lies within `radius` of the centre, and no other within `uniqueness_radius`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct RootClaim {
    design: usize,
    lengths: usize,
    patch: usize,
    unit: String,
    centre: ComplexText,
    radius: String,
    uniqueness_radius: String,
    reality: ::fk::solve::certify::ProvedReality,
    pose: DiscsOfPose,
}

/// Complex numbers.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct ComplexText {
    re: Vec<String>,
    im: Vec<String>,
}

/// Discs with the entries of `R`, row by row, and of `p`.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct DiscsOfPose {
    #[serde(rename = "R")]
    rotation: DiscsText,
    p: DiscsText,
}

/// Discs in the complex plane.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct DiscsText {
    #[serde(flatten)]
    centre: ComplexText,
    radius: Vec<String>,
}

/// The theorem behind a bound, by the hypothesis that is tested.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
enum BoundWord {
    SixLegs,
    SharedJoints,
    JointsOnALine,
    AffineHexagons,
    PointsAtInfinity,
}

/// An exact pose: the rotation of a quaternion of any norm, scalar part first, and a position.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct PoseText {
    quaternion: [String; 4],
    position: [String; 3],
}

/// A result that is no claim of the file.
#[derive(Debug, Clone, PartialEq, Serialize)]
struct LeftOut {
    statement: String,
    reason: String,
}

/// An exact number as text.
fn text<N: ToString>(x: &N) -> String {
    x.to_string()
}

/// The value of a finite double as text.
fn of_double(x: f64) -> String {
    rational(x).map_or_else(String::new, |x| text(&x))
}

fn texts<'a>(numbers: impl IntoIterator<Item = &'a Algebraic>) -> Vec<String> {
    numbers.into_iter().map(text).collect()
}

impl Claim {
    /// The page of its theorem.
    fn theorem(&self) -> &'static str {
        match self {
            Self::LegMap { .. } | Self::NoLegMap { .. } => "leg-maps.md",
            Self::Dependency { .. }
            | Self::LegRank { .. }
            | Self::RegularPose { .. }
            | Self::GenericRank { .. }
            | Self::DependentLines { .. } => "architectural-singularity.md",
            Self::PoseBound { .. }
            | Self::EquivalentBound { .. }
            | Self::Complete { .. }
            | Self::NoPose { .. } => "completeness.md",
            Self::Root(_) | Self::Distinct { .. } => "certificates.md",
            Self::Margin { .. }
            | Self::MarginOverRegion { .. }
            | Self::LegClearance { .. }
            | Self::LegForce { .. } => "requirements.md",
            Self::RegularRegion { .. } => "parallel-singularities.md",
        }
    }
}

impl ProofFile {
    fn of(command: &'static str) -> Self {
        Self {
            schema_version: SCHEMA_VERSION,
            equipod_proof: command,
            equipod_version: env!("CARGO_PKG_VERSION"),
            designs: Vec::new(),
            lengths: Vec::new(),
            claims: Vec::new(),
            not_included: Vec::new(),
        }
    }

    /// Whether nothing is claimed.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.claims.is_empty()
    }

    /// The number of claims, and a line for each result left out.
    #[must_use]
    pub fn summary(&self) -> String {
        let count = self.claims.len();
        let claims = match count {
            0 => "no claims: nothing in it can be checked".to_owned(),
            1 => "1 claim for equipod-check".to_owned(),
            _ => format!("{count} claims for equipod-check"),
        };
        let left =
            self.not_included.iter().map(|l| format!("\n  not included: {} ({})", l.statement, l.reason));
        claims + &left.collect::<String>()
    }

    fn claim(&mut self, id: impl Into<String>, claim: Claim) {
        self.claims.push(NamedClaim { id: id.into(), theorem: claim.theorem(), claim });
    }

    fn leave_out(&mut self, statement: impl Into<String>, reason: impl Into<String>) {
        self.not_included.push(LeftOut { statement: statement.into(), reason: reason.into() });
    }

    /// The place of a design in the file, with its exact legs; `None`, and a note about `statement`, if its joints
    /// have no exact numbers that the checker handles.
    fn design(
        &mut self,
        (name, units): (&str, &str),
        m: &Manipulator,
        statement: &str,
    ) -> Option<(usize, ExactLegs)> {
        let Some(legs) = ExactLegs::of(m) else {
            let reason = "the joints are known only between bounds, or have too many square roots";
            self.leave_out(statement, format!("{name}: {reason}"));
            return None;
        };
        let end = |point: &[Algebraic]| texts(&point[1..]);
        let ends = legs.base.iter().zip(&legs.platform);
        let record: Vec<ProofLeg> = ends.map(|(a, b)| ProofLeg { base: end(a), platform: end(b) }).collect();
        // the checker knows square roots, and no cosines
        if record.iter().flat_map(|leg| leg.base.iter().chain(&leg.platform)).any(|x| x.contains("cos")) {
            self.leave_out(statement, format!("{name}: the checker has no exact arithmetic with cosines"));
            return None;
        }
        let joints = m.level();
        self.designs.push(ProofDesign { name: name.into(), units: units.into(), joints, legs: record });
        Some((self.designs.len() - 1, legs))
    }

    /// The leg lines at a pose: independent, with the sign of `det J`, and its value if it is `stated`.
    fn regular_pose(
        &mut self,
        id: String,
        (design, legs): (usize, &ExactLegs),
        pose: &ExactNumbersOfPose,
        stated: bool,
    ) {
        let value = determinant(legs.lines_at(&pose.quaternion, &pose.position));
        let sign = value.surd().sign() as i8;
        if sign == 0 {
            self.leave_out(id, "the leg lines are dependent at this pose");
            return;
        }
        let det = stated.then(|| text(&value));
        self.claim(id, Claim::RegularPose { design, pose: pose.into(), det, sign });
    }

    /// Every relation of a basis of those between the leg vectors.
    fn dependencies(&mut self, (design, legs): (usize, &ExactLegs)) {
        for (k, c) in relations(&legs.vectors).iter().enumerate() {
            let constant = c.iter().enumerate().map(|(i, x)| x * &legs.squares(i)).sum::<Algebraic>();
            let claim = Claim::Dependency { design, coefficients: texts(c), constant: text(&constant) };
            self.claim(format!("dependency-{}-{}", design + 1, k + 1), claim);
        }
    }
}

/// A pose as rational numbers.
struct ExactNumbersOfPose {
    quaternion: [Rational; 4],
    position: [Rational; 3],
}

impl From<&RationalPose> for ExactNumbersOfPose {
    fn from(pose: &RationalPose) -> Self {
        let step = rational(2f64.powi(pose.unit)).unwrap_or_default();
        Self {
            quaternion: pose.quaternion.map(num::exact::integer),
            position: pose.steps.map(|n| num::exact::integer(n) * &step),
        }
    }
}

/// The pose whose rotation is exactly that of the quaternion in doubles, of whatever norm.
impl From<&Pose> for ExactNumbersOfPose {
    fn from(pose: &Pose) -> Self {
        let exact = |x: f64| rational(x).unwrap_or_default();
        let position: [f64; 3] = pose.position.into();
        Self { quaternion: pose.quaternion().map(exact), position: position.map(exact) }
    }
}

impl From<&ExactNumbersOfPose> for PoseText {
    fn from(pose: &ExactNumbersOfPose) -> Self {
        Self {
            quaternion: pose.quaternion.each_ref().map(text),
            position: pose.position.each_ref().map(text),
        }
    }
}
