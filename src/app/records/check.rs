//! Answers on whether a design is architecturally singular, with reasons and the distance to a singular design.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fk::PoseCountRecord;
use super::pose::leg_numbers;
use super::{NamedPoints, Number, PoseRecord};
use ask::CheckReport;
use ask::Design;
use files::design::{DesignExactness, Exactness};
use fk::solve::pose_count::CommonPoints;
use fk::{Solvability, Theorem};
use platform::geom::BestLine;
use platform::manipulator::{Body, LegLengths, Level};
use synthesis::singularity::{
    Architecture, Assembly, Conditioning, Dependency, Finding, GriffisDuffy, NearestSingular, RankBound,
    RationalPose, SingularEvidence,
};

view! {
    /// The answer of `check`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CheckAnswer {
        /// The name of the design.
        pub name: String = c.design.name.clone(),
        /// Verdict in words, with the name.
        pub headline: String = headline(c),
        /// The unit of lengths.
        pub units: String = c.design.units.clone(),
        /// The size of the design, in its units: what distances are compared with.
        pub size: Number = Number(c.design.manipulator().size()),
        /// The exactness of the design's joints.
        pub joints: JointsRecord = (&c.design.exactness()).into(),
        /// Whether every pose is singular. Null: undecided, since a singular design lies within rounding or the digits
        /// given, or some joints are known only between bounds.
        pub architecturally_singular: Option<bool> = c.is_singular(),
        /// The level of the proof; "within rounding": a singular design may have been meant. Null: not decided.
        pub level: Option<Level> = c.verdict.level(),
        /// Whether a singular design may have been meant: it agrees within rounding or the digits given, and is
        /// `nearest_singular`.
        pub singular_within_rounding: bool = c.verdict.meant.is_some(),
        /// Exact decision for the joints as numbers; null: some joints are known only between bounds.
        pub singular_as_written: Option<bool> = a.is_singular(),
        /// Evidence that home is singular; null: it is regular, or the design states none.
        pub singular_home: Option<SingularEvidence> = c.singular_home.map(|home| home.evidence),
        /// Short code; null: regular.
        pub reason: Option<String> = c.verdict.reason().map(str::to_owned),
        /// Verdict in words.
        pub explanation: String = explanation(c),
        /// Proof for the joints as written.
        pub proof: ProofWord = proof(a),
        /// Proof in words.
        pub proof_explanation: String = proof_explanation(a),
        /// Rank of the leg vectors.
        pub leg_rank: usize = a.leg_rank,
        /// Generic Jacobian rank: the rank of the leg lines at almost every pose.
        pub jacobian_rank: usize = a.jacobian.rank,
        /// Pose with this rank.
        pub witness: WitnessRecord = (&a.jacobian.witness).into(),
        /// First dependency of the leg vectors; null: there is none.
        pub dependency: Option<DependencyRecord> = dependencies.first().cloned(),
        /// All dependencies of the leg vectors.
        pub dependencies: Vec<DependencyRecord> = dependencies,
        /// Legs of the first known case, from 1.
        pub dependent_legs: Option<Vec<usize>> = a.findings.first().map(|f| leg_numbers(&f.legs)),
        /// Known cases, the most specific first.
        pub cases: Vec<CaseRecord> = a.findings.iter().map(CaseRecord::from).collect(),
        /// The Griffis-Duffy type; null: the joints do not lie on the sides of two triangles.
        pub griffis_duffy: Option<GriffisDuffyRecord> = a
            .griffis_duffy
            .as_ref()
            .map(|g| GriffisDuffyRecord::new(g, &c.design, c.assembly.as_ref())),
        /// The nearest singular design found; null: the design itself is singular.
        pub nearest_singular: Option<NearestSingularRecord> = c
            .nearest
            .as_ref()
            .map(|n| NearestSingularRecord::new(n, c.at_least, &c.design)),
        /// Finite poses, real and complex, for generic leg lengths.
        pub pose_count: PoseCountRecord = (&c.pose_count).into(),
        /// Common points of six leg equations for generic lengths, by kind. Null: the poses are not isolated, or not
        /// counted.
        pub common_points: Option<CommonPoints> = c.common_points,
        /// Upper bound on isolated finite poses, by a theorem.
        pub pose_bound: PoseBoundRecord = c.pose_bound.into(),
        /// Steps that compute the poses: by quadratic equations alone, or with one part of the platform first.
        pub solvability: Solvability = c.solvability.clone(),
        /// Best line through the joints by body, base first. A body whose joints all lie on one line can rotate about
        /// it. A body with all joints at one point has no line.
        pub best_lines: Vec<BestLineRecord> =
            Body::BOTH.into_iter().zip(c.best_lines).filter_map(BestLineRecord::of).collect(),
        /// Singular values of the normalised leg vectors.
        pub singular_values: [Number; 6] = c.conditioning.leg_vectors.map(Number),
        /// Inverse condition number of the Jacobian at random poses.
        pub jacobian_inverse_condition: Conditioning = c.conditioning,
    }
    impl From(c: &CheckReport) {
        let a = &c.verdict.architecture;
        let lengths = c.design.lengths.as_ref();
        let dependencies: Vec<_> = a.dependencies.iter().map(|d| DependencyRecord::new(d, lengths)).collect();
    }
}

/// A line that joints of a body lie nearly on, body frame, design units.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BestLineRecord {
    /// The body.
    pub body: Body,
    /// A point of the line: the centroid of the joints.
    pub point: [Number; 3],
    /// Unit vector along it.
    pub direction: [Number; 3],
    /// Greatest distance of a joint from the line, design units.
    pub distance: Number,
    /// Greatest distance of a joint from the centroid, design units.
    pub reach: Number,
}

impl BestLineRecord {
    fn of((body, line): (Body, Option<BestLine>)) -> Option<Self> {
        let BestLine { point, direction, distance, reach } = line?;
        let (point, direction) = (point.into(), direction.into_inner().into());
        let numbers = |x: [f64; 3]| x.map(Number);
        let (distance, reach) = (Number(distance), Number(reach));
        Some(Self { body, point: numbers(point), direction: numbers(direction), distance, reach })
    }
}

/// A proved bound on the number of isolated finite poses, counted with multiplicity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PoseBoundRecord {
    /// The bound.
    pub poses: usize,
    /// Theorem behind it.
    pub theorem: String,
}

impl From<Theorem> for PoseBoundRecord {
    fn from(theorem: Theorem) -> Self {
        Self { poses: theorem.bound(), theorem: theorem.statement() }
    }
}

/// The proof of the answer for the joints as written.
fn proof(a: &Architecture) -> ProofWord {
    match a.jacobian.bound {
        _ if a.is_singular().is_none() => ProofWord::None,
        _ if a.is_singular() == Some(false) => ProofWord::RegularPose,
        RankBound::LegVectors | RankBound::Legs => ProofWord::LegVectors,
        RankBound::Lattice { .. } => ProofWord::PoseLattice,
    }
}

/// The verdict; a singular design that may have been meant is named here, with its distance.
fn headline(c: &CheckReport) -> String {
    let name = &c.design.name;
    match (&c.verdict.meant, c.is_singular()) {
        (Some(n), _) => format!("{name}: {}", n.words(&c.design.units)),
        (None, Some(true)) => {
            format!("{name}: architecturally singular, the legs hold the platform at no pose")
        }
        (None, Some(false)) => format!("{name}: regular, the legs hold the platform at almost every pose"),
        (None, None) => format!("{name}: not decided"),
    }
}

/// The kind of singular design, in one sentence.
fn explanation(c: &CheckReport) -> String {
    if let Some(n) = &c.verdict.meant {
        let (units, kind) = (&c.design.units, n.kind.replace('_', " "));
        return match n.within_digits {
            Some(half) => format!(
                "a singular design ({kind}) is only {:.1e} {units} away: every coordinate agrees with it within half a unit of the last digit ({half} {units}). As written the design is regular",
                n.distance
            ),
            None => format!(
                "a singular design ({kind}) is only {:.1e} {units} away, within rounding of the numbers. As written the design is regular",
                n.distance
            ),
        };
    }
    match (c.is_singular(), c.verdict.architecture.findings.first()) {
        (None, _) => {
            "the joints are known between bounds only, and at no pose the legs are proved to hold the platform".into()
        }
        (_, Some(f)) => format!("{} ({})", f.case.sentence(), legs_in_words(&leg_numbers(&f.legs))),
        (_, None) => "the legs hold the platform at almost every pose".into(),
    }
}

/// The proof in one sentence.
fn proof_explanation(a: &Architecture) -> String {
    let j = &a.jacobian;
    let pose = format!(
        "the pose with quaternion {:?} and p = {}",
        j.witness.quaternion,
        triple(&j.witness.pose().position)
    );
    let Some(level) = a.level else { return "nothing is proved".into() };
    let about = level.words();
    match j.bound {
        RankBound::Legs => format!("{pose} has six independent leg lines, proved {about}"),
        RankBound::LegVectors => format!(
            "the leg vectors have rank {0}, proved {about}, and the lines never have more; {pose} has rank {0}",
            a.leg_rank
        ),
        RankBound::Lattice { poses, primes } => format!(
            "the leg lines have rank {} or less at {poses} poses that decide all poses, proved {about} ({primes} primes); {pose} has that rank",
            j.rank
        ),
    }
}

view! {
    /// The exactness of all joints of a design together.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct JointsRecord {
        /// Exactness of the least exact joint.
        pub exactness: ExactnessWord = match e.exactness {
            None => ExactnessWord::Doubles,
            Some(Exactness::Rational) => ExactnessWord::Rational,
            Some(Exactness::Field) => ExactnessWord::Field,
            Some(Exactness::Interval) => ExactnessWord::Interval,
        },
        /// Integers with square roots in the coordinate field, beside the cosines of `divisions`; empty for fractions.
        pub radicands: Vec<u64> = e.radicands.clone(),
        /// Numbers `n` with `cos(360 / n)` degrees in the coordinate field: some of 9, 16, 20 and 32.
        pub divisions: Vec<u32> = e.divisions.clone(),
        /// Joints between bounds, with their bodies: `base.A2`.
        pub enclosed: Vec<String> = e.enclosed.clone(),
        /// The exactness in words.
        pub explanation: String = e.to_string(),
    }
    impl From(e: &DesignExactness) {}
}

/// The exactness of joint coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ExactnessWord {
    /// All joints are three plain numbers, read as the nearest doubles.
    Doubles,
    /// All coordinates are fractions.
    Rational,
    /// All coordinates are sums of rational multiples of square roots of integers and of cosines.
    Field,
    /// At least one joint is known only between two close bounds.
    Interval,
}

/// The proof that a design is regular or singular.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ProofWord {
    /// A pose with six independent leg lines.
    RegularPose,
    /// The rank of the leg vectors.
    LegVectors,
    /// Ranks at the poses of a lattice that decide all poses.
    PoseLattice,
    /// No proof: some joints are known only between bounds, and no pose is proved to hold the platform.
    None,
}

/// A pose with rational coordinates.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct WitnessRecord {
    /// The pose.
    #[serde(flatten)]
    pub pose: PoseRecord,
    /// Orientation, quaternion of any norm, scalar part first.
    pub quaternion: [i64; 4],
}

impl From<&RationalPose> for WitnessRecord {
    fn from(w: &RationalPose) -> Self {
        Self { pose: (&w.pose()).into(), quaternion: w.quaternion }
    }
}

view! {
    /// A linear dependency of leg vectors: `sum c_i v_i = 0`.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct DependencyRecord {
        /// Legs with nonzero coefficients, from 1.
        pub legs: Vec<usize> = leg_numbers(&d.legs),
        /// The numbers `c_i`.
        pub coefficients: [Number; 6] = d.coefficients.map(Number),
        /// `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
        pub constant: Number = Number(d.constant),
        /// Dimension spanned by the base ends.
        pub base_dimension: usize = d.base_dimension,
        /// Dimension spanned by the platform ends.
        pub platform_dimension: usize = d.platform_dimension,
        /// Relative difference of `sum c_i s_i` at the design lengths from `constant`; null without lengths.
        pub lengths_defect: Option<Number> = lengths.map(|l| Number(d.defect(&l.squared()))),
    }
    fn new(d: &Dependency, lengths: Option<&LegLengths>) {}
}

view! {
    /// A known kind of singular design.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct CaseRecord {
        /// Name of the case.
        pub case: String = f.case.name().into(),
        /// Short code.
        pub reason: String = f.case.reason().into(),
        /// Legs, from 1.
        pub legs: Vec<usize> = leg_numbers(&f.legs),
        /// Case in words.
        pub explanation: String = f.case.sentence(),
    }
    impl From(f: &Finding) {}
}

view! {
    /// Joints on the sides of two triangles.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct GriffisDuffyRecord {
        /// Legs around the hexagon, from 1.
        pub order: Vec<usize> = leg_numbers(&g.order),
        /// Positions of joints on their sides, as a fraction from 0 to 1.
        pub t: [Number; 6] = g.t.map(Number),
        /// Lengths of the sides, design units.
        pub side_lengths: [Number; 6] = g.sides.map(Number),
        /// `prod (1 - t) - prod t`; zero means singular.
        pub det: Number = Number(g.determinant()),
        /// Whether it is zero exactly.
        pub exactly_singular: bool = g.is_exactly_singular(),
        /// Greatest distance of a joint from its side, relative to the size.
        pub deviation: Number = Number(g.deviation),
        /// Greatest `deviation` for this type.
        pub deviation_limit: Number = Number(GriffisDuffy::limit(design.manipulator())),
        /// Dependency of the legs for `det = 0`.
        pub coefficients: [Number; 6] = g.coefficients().map(Number),
        /// `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
        pub constant: Number = Number(g.constant()),
        /// Relative difference of `sum c_i s_i` at the design lengths from `constant`; null without lengths.
        pub lengths_defect: Option<Number> = design.lengths.map(|l| Number(g.assembly_defect(&l.squared()))),
        /// Assembly with the lengths of the design.
        pub assembly: Option<Assembly> = assembly.copied(),
    }
    fn new(g: &GriffisDuffy, design: &Design, assembly: Option<&Assembly>) {}
}

view! {
    /// The nearest singular design found.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
    pub struct NearestSingularRecord {
        /// Norm of the change of all joints.
        pub distance: Number = Number(n.distance),
        /// Unit of distances: that of the design.
        pub unit: String = design.units.clone(),
        /// Always `upper`: an upper bound of the least distance.
        #[schemars(extend("const" = "upper"))]
        pub bound: String = "upper".into(),
        /// A lower bound: no singular design is nearer, design units.
        pub distance_at_least: Number = Number(at_least),
        /// The kind of singularity.
        pub kind: String = n.kind.to_string(),
        /// Dependent legs.
        pub legs: Vec<usize> = leg_numbers(&n.legs),
        /// Dependency of the leg vectors.
        pub coefficients: Option<[Number; 6]> = n.coefficients.map(|c| c.map(Number)),
        /// Residual of the dependency.
        pub residual: Number = Number(n.residual),
        /// Whether the designs differ by rounding only.
        pub within_rounding: bool = n.within_rounding,
        /// Half a unit of the last digit, design units; null: some coordinate differs by more.
        pub within_digits: Option<Number> = n.within_digits.map(Number),
        /// Base joints by name, base frame.
        pub base: NamedPoints = NamedPoints::new(design.base_names(), &n.base),
        /// Platform joints by name, platform frame.
        pub platform: NamedPoints = NamedPoints::new(design.platform_names(), &n.platform),
    }
    fn new(n: &NearestSingular, at_least: f64, design: &Design) {}
}

fn triple(v: &nalgebra::Vector3<f64>) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

/// Legs by their numbers: `legs 1, 2`.
#[must_use]
pub fn legs_in_words(numbers: &[usize]) -> String {
    let numbers: Vec<String> = numbers.iter().map(ToString::to_string).collect();
    format!("legs {}", numbers.join(", "))
}
