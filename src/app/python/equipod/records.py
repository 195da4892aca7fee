"""Answers as typed records: the fields of `equipod COMMAND --json`, by the same names.

Made from the schemas of the answers by `.ci/generate`; do not edit. What may be absent from a document is None, and so is what is null in it.
"""

from __future__ import annotations

from typing import Any, Literal, Union

from ._record import Record

AlignmentUndecided = Literal["no_axes", "unclear_dimension", "within_errors"]
AlignmentWord = Literal["found", "none", "undecided"]
Body = Literal["base", "platform"]
BranchWord = Literal["best", "bounded", "dominated", "infeasible", "solver_failure", "unproved"]
CalibrateOutcome = Literal["calibrated", "not_identifiable", "planned", "refuted", "undecided"]
CalibrationFrames = Literal["design", "measured"]
CentrePrecision = Literal["double", "double_double"]
CoefficientsWord = Literal["enclosed", "expressions", "integers"]
CompletenessWord = Literal["modular", "proved", "proved_bounded", "unproved"]
CorrelationsWord = Literal["design", "independent"]
CountUndecided = Literal["degree_too_low", "joints_not_exact", "no_prime_drawn", "primes_disagree"]
CountedLengths = Literal["generic", "given"]
DesignObjective = Literal[
    "joint_spacing",
    "leg_clearance",
    "leg_force",
    "mean_conditioning",
    "natural_frequency",
    "singularity_distance",
    "smallest_singular_value",
    "stiffness",
    "stroke",
    "worst_conditioning",
]
DesignRoleWord = Literal["closest", "design", "equivalent", "nearest_equivalent", "on_holes", "optimised"]
DriveRanking = Literal["objective", "price"]
DriveSearchWord = Literal[
    "dearer",
    "infeasible",
    "interrupted",
    "met",
    "not_tried",
    "undecided",
    "violated",
    "weaker",
]
DriveSolutionWord = Literal["no_length", "not_contracting", "not_tracked", "proved", "unproved"]
ErrorKind = Literal["position", "rotation"]
EvidenceWord = Literal["modular", "proved"]
ExactnessWord = Literal["doubles", "field", "interval", "rational"]
Freedom = Literal[
    "base_envelope",
    "base_margin",
    "home_height",
    "machine_envelope",
    "min_abs_det",
    "platform_envelope",
    "platform_margin",
    "stroke",
    "triangle_sizes",
    "triangles",
]
FreedomWord = Literal["not_tried", "resolved", "undecided", "unresolved"]
HolePattern = Literal["bolt_circle", "polar", "square", "triangular"]
Invariant = Literal[
    "base_principal_value",
    "canonical_distance",
    "joint_rank",
    "leg_rank",
    "open_translations",
    "platform_principal_value",
]
LengthsOrigin = Literal["design", "home"]
Level = Literal["doubles_as_written", "exact_joints", "within_rounding"]
LineClass = Literal["cubic", "octic", "quadratic", "quartic"]
Loss = Literal["cauchy", "huber", "squares", "tukey"]
LossUnit = Literal["leg", "pose"]
MarginVerdict = Literal["at_limit", "met", "searched", "violated"]
Method = Literal["homotopy", "near", "octic", "sylvester", "template", "trilateration"]
MotionRegularity = Literal["proved", "sampled", "singular"]
NearWord = Literal["lost", "near_singularity", "tracked"]
NoRoundingWord = Literal[
    "bad_grid",
    "free_pattern",
    "joints_coincide",
    "no_lines",
    "no_triangle_near",
    "no_triangles",
    "singular",
    "singular_pose",
]
NoiseSource = Literal["assumed", "estimated", "given"]
Objective = Literal[
    "joint_spacing",
    "leg_clearance",
    "leg_force",
    "mean_conditioning",
    "natural_frequency",
    "singularity_distance",
    "smallest_singular_value",
    "stiffness",
    "stroke",
    "worst_conditioning",
]
OptimalityWord = Literal["best_of_starts", "proved_within_gap"]
OptimizeWord = Literal[
    "best_found",
    "feasible",
    "front",
    "infeasible",
    "interrupted",
    "optimal",
    "undecided",
    "violated",
]
PathEnd = Literal["at_infinity", "failed", "finite", "isotropic"]
PoseFamilyWord = Literal["line", "positions", "rotation"]
ProofWord = Literal["leg_vectors", "none", "pose_lattice", "regular_pose"]
ProvedReality = Literal["non_real", "real", "undecided"]
RegionWord = Literal["box", "ellipsoid"]
RegularityWord = Literal["changes_sign", "proved", "undecided"]
RejectionReason = Literal["duplicate", "not_certified", "not_finite", "residual_too_large"]
Relation = Literal["equivalent", "singular", "undecided", "unrelated"]
RiddenWord = Literal["limit", "range_end", "reserve"]
SearchMethodWord = Literal["dimensional", "offsets"]
SearchWord = Literal["found", "impossible", "undecided", "violated"]
SideWord = Literal["above", "below"]
SignOutcome = Literal["crosses", "keeps_sign", "undecided"]
SingularEvidenceWord = Literal["rounding", "sign_change", "zero"]
SourceWord = Literal["default", "design"]
SpecialDemand = Literal["abs_det", "reach"]
StageWord = Literal["assess", "components", "fk", "moves", "nearest", "verify"]
StartName = Literal["closed_form", "nominal"]
SymmetryWord = Literal["given_up", "kept"]
TermKind = Literal[
    "angular_stiffness",
    "base_envelope",
    "base_first_angle",
    "base_hole_edge",
    "base_hole_gap",
    "base_second_angle",
    "base_spacing",
    "base_swing",
    "crank_angle",
    "crank_speed",
    "crank_torque",
    "crank_transmission",
    "keep_out",
    "leg_clearance",
    "leg_force",
    "leg_speed",
    "leg_too_long",
    "leg_too_short",
    "linear_stiffness",
    "machine_envelope",
    "natural_frequency",
    "payload_clearance",
    "plate_clearance",
    "platform_envelope",
    "platform_first_angle",
    "platform_hole_edge",
    "platform_hole_gap",
    "platform_second_angle",
    "platform_spacing",
    "platform_swing",
    "rod_too_long",
    "rod_too_short",
    "tip_swing",
]
VariantWord = Literal["exact", "nearest"]
VerdictWord = Literal["equivalent", "inconclusive", "not_equivalent", "singular"]
WorkspaceWord = Literal["default", "design"]


class AccuracyRecord(Record):
    """How far the pose may be off."""

    #: Of the platform origin, design units.
    position: float
    #: Angle of rotation.
    rotation_deg: float


class AlignmentRecord(Record):
    """The rigid motions that make one design equivalent to another."""

    #: One sentence with the numbers that decided.
    explanation: str
    #: The same with base and platform of the second design exchanged.
    exchanged: OtherAlignmentRecord
    #: The same with the mirror image of the second design.
    mirrored: OtherAlignmentRecord
    status: Union[Literal["found", "none", "undecided"], None]
    #: Nearest to no motion first.
    motions: Union[tuple[MotionRecord, ...], None]
    #: There are no others.
    all: Union[bool, None]
    #: Dimension of the families the motions lie in.
    freedom: Union[int, None]
    #: The number that shows it.
    difference: Union[DifferenceRecord, None]
    #: How near a motion comes.
    nearest: Union[NearestMotionRecord, None]
    #: Why not.
    reason: Union[AlignmentUndecided, None]


class AssemblyRecord(Record):
    """Whether a singular platform can be assembled."""

    verdict: Union[Literal["incompatible", "no_real_pose", "undecided", "real"], None]
    #: By how much, relative.
    defect: Union[float, None]
    #: Squared lengths of the octahedral platforms.
    octahedral_squared_lengths: Union[CornerLengthsRecord, None]
    #: The pose.
    pose: Union[PoseRecord, None]
    #: Its residual.
    residual: Union[float, None]


class AssessAnswer(Record):
    """The answer of `assess`."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The design judged.
    name: str
    #: What it is in this answer.
    role: DesignRoleWord
    #: True: every margin and det J are proved, for all poses that `judged` names; false: a violation or a
    #: change of sign of det J is proved by its pose; null: neither.
    met: Union[bool, None]
    #: The verdict in a sentence whose subject is the design.
    explanation: str
    #: The poses judged.
    judged: JudgedPosesRecord
    #: The same of the reserves: true: every margin is proved to keep its reserve; false: one does not, at
    #: the pose given; null: neither.
    reserve_kept: Union[bool, None]
    #: The least of each kind.
    requirements: tuple[MarginRecord, ...]
    #: The requirement with the least room as a share of its limit; null: none has a limit to compare with.
    tightest: Union[TightestRecord, None]
    #: Whether there are singular poses.
    regular: RegularityRecord
    #: The same in a sentence.
    regular_explanation: str
    #: Where the Jacobian is conditioned worst among the poses looked at: a number found, without a limit
    #: and without a proof.
    conditioning: LeastConditioningRecord
    #: Poses looked at.
    poses: int
    #: Cells over which margins were bounded.
    cells: int
    #: The lightest drive of the table that the design names with which its requirements are met; null: it
    #: names none, or the answer is about something else.
    lightest_drive: Union[LightestDriveRecord, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: Assumptions about masses that the file leaves open, a sentence each; absent where no force, torque
    #: or natural frequency is judged, and where the answer around this one has the list.
    assumptions: Union[tuple[str, ...], None]


class BestLineRecord(Record):
    """A line that joints of a body lie nearly on, in the frame of the body, design units."""

    #: The body.
    body: Body
    #: A point of the line, the centroid of the joints.
    point: tuple[Union[float, None], ...]
    #: A unit vector along it.
    direction: tuple[Union[float, None], ...]
    #: The greatest distance of a joint from the line.
    distance: Union[float, None]
    #: The greatest distance of a joint from the centroid along the line.
    reach: Union[float, None]


class BeyondPrecisionRecord(Record):
    """Numbers of poses that were set aside."""

    #: Of A.
    a: int
    #: Of B.
    b: int


class BoundedProof(Record):
    """The numbers of a proof that all poses up to a distance are listed."""

    #: Certified poses listed, with multiplicity.
    poses: int
    #: Others, certified to be different and farther out, or at infinity.
    far: int
    #: The distance: every pose whose rotation matrix has no entry of a larger modulus is listed. Entries
    #: of real rotations are at most 1.
    rotation: float


class BranchConflictRecord(Record):
    """Why a branch or a part of it is empty."""

    #: A short stable code.
    code: Literal["vertices_too_close", "outside_bounds", "no_room", "pair_too_close", "det_too_small", "combination"]
    #: One sentence with the numbers.
    message: str


class BranchCountsRecord(Record):
    """What became of the branches."""

    #: All of them.
    total: int
    #: Feasible ones.
    feasible: int
    #: Proved empty: nothing of a zone lies within the bounds.
    infeasible_bounds: int
    #: Proved empty: no room for the joints.
    infeasible_spacing: int
    #: Proved empty: |det A| is too small.
    infeasible_det: int
    #: Covered by the bound over all offsets, not searched.
    bounded: int
    #: Not decided.
    unproved: int
    #: The conic solver failed.
    solver_failure: int


class BranchRecord(Record):
    """A branch: a zone for each offset."""

    #: Zone of each offset: before, inside, beyond its edge.
    branch: str
    #: What became of it.
    verdict: BranchWord
    #: Its own best, where it is dominated.
    objective: Union[float, None]
    #: Where that is reached.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: Parts of the branch searched.
    cells: int
    #: Proved conflicts of the branch or of parts of it.
    conflicts: tuple[BranchConflictRecord, ...]


class BudgetPosesRecord(Record):
    """The poses looked at."""

    #: How many.
    count: int
    #: Whether the workspace is that of the design.
    workspace: WorkspaceWord


class CalibrateAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of lengths.
    units: str
    #: The convention in which measured poses were read, and of `in_frames`.
    frames: PoseConventionRecord
    #: How it ended.
    outcome: CalibrateOutcome
    #: Why it ended so, in a sentence.
    reason: str
    #: What was found; null: nothing was measured, and poses to measure were asked for.
    calibration: Union[CalibrationRecord, None]
    #: The poses at which another measurement says most, the best first.
    next_poses: tuple[NextPoseRecord, ...]
    #: The design that was written; null: none.
    path: Union[str, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class CalibratedJointRecord(Record):
    """A joint."""

    #: Its body.
    body: Body
    #: Its name.
    joint: str
    #: Where it is, frame of the body.
    position: tuple[Union[float, None], ...]
    #: Standard deviations of the coordinates; null: it was held.
    deviations: Union[tuple[Union[float, None], ...], None]
    #: From where the design has it.
    moved: tuple[Union[float, None], ...]


class CalibratedOffsetRecord(Record):
    """The offset of a leg."""

    #: From 1.
    leg: int
    #: What the length shown is longer than the distance of the joints, design units.
    offset: Union[float, None]
    #: Its standard deviation; null: it was held.
    deviation: Union[float, None]


class CalibratedPosesRecord(Record):
    """Standard deviations of poses computed from lengths with the calibrated machine; the noise of these lengths comes on top."""

    #: Whether the design file has correlations.
    correlations: CorrelationsWord
    #: Poses looked at.
    poses: int
    #: Root mean square of the distance by which the tool point is off, design units.
    position: DeviationRecord
    #: Root mean square of the angle by which the orientation is off, degrees.
    rotation_deg: DeviationRecord


class CalibrationRecord(Record):
    """What was found."""

    #: Poses measured.
    poses: int
    #: Coordinates and offsets sought.
    unknowns: int
    #: The frames of joints, deviations and covariance.
    frames: CalibrationFrames
    #: The motions from the frames of the measurements to those of the design; null: joints are in the
    #: frames of the measurements.
    motions: Union[FrameMotionsRecord, None]
    #: How uncertain measurements are.
    noise: NoiseRecord
    #: How far measurements cost.
    loss: LossRecord
    #: Where the fit began.
    start: StartRecord
    #: Whether its steps ended where they must.
    converged: bool
    #: Steps in all.
    steps: int
    #: The joints that carry legs.
    joints: tuple[CalibratedJointRecord, ...]
    #: Leg offsets in leg order: shown length less distance of the joints.
    offsets: tuple[CalibratedOffsetRecord, ...]
    #: Covariance of the unknowns, squared design units; directions that are not identified have none.
    covariance: CovarianceRecord
    #: How uncertain poses are that are computed with the machine; null: not all unknowns are identified,
    #: or the design has no pose to look at.
    computed_poses: Union[ComputedPosesRecord, None]
    #: Which changes of the machine the measurements see, and how well.
    observability: ObservabilityRecord
    #: Residuals of the design as it is.
    before: ResidualsRecord
    #: Residuals of the calibrated machine, without outliers.
    after: ResidualsRecord
    #: Residuals of each pose for the machine that the other poses give, to first order, without outliers.
    left_out: ResidualsRecord
    #: Residuals of the measurements of `--check`; null: there are none.
    check: Union[ResidualsRecord, None]
    #: Lines of measurements without which the unknowns are not determined.
    indispensable: tuple[int, ...]
    #: Agreement of the residuals with the noise.
    chi_square: ChiSquareRecord
    #: Measurements that do not belong to the others, the farthest first.
    outliers: tuple[OutlierRecord, ...]
    #: Two legs, from 1, whose measured lengths look exchanged: they are five times nearer to the design
    #: when they change places; null: none do.
    exchanged_legs: Union[tuple[int, ...], None]


class CaseRecord(Record):
    """A known kind of singular design."""

    #: Which.
    case: str
    #: The short code of the reason.
    reason: str
    #: The legs it is about, from 1.
    legs: tuple[int, ...]
    #: One sentence.
    explanation: str


class CertificateRecord(Record):
    """The proof that a root exists and is alone, with all its numbers."""

    kind: Union[Literal["study", "cluster", "octahedral"], None]
    #: Index of the coordinate that is 1.
    patch: Union[int, None]
    #: A power of two, design units.
    unit: Union[float, None]
    #: The centre.
    centre: Union[ComplexRecord5, ComplexRecord4, None]
    #: To be added to the centre.
    centre_low: Union[ComplexRecord5, None]
    #: One root lies within this distance of the centre.
    radius: Union[float, None]
    #: No other root lies within this distance.
    uniqueness_radius: Union[float, None]
    #: Contraction of the simplified Newton map on the ball of the radius, below 1.
    contraction: Union[float, None]
    #: Precision of the centre.
    precision: Union[CentrePrecision, None]
    #: Proved for all squared lengths that the data can mean.
    reality: Union[ProvedReality, None]
    #: What holds the pose of the root.
    enclosure: Union[EnclosureRecord, None]
    #: Their number, each counted with its multiplicity; 2 or more.
    multiplicity: Union[int, None]
    #: Radius of the disc of t.
    reach: Union[float, None]
    #: What is left beside the power of t that has the multiplicity as exponent, over this power, on the
    #: circle; below 1.
    dominance: Union[float, None]
    #: Legs 14 24 25 35 36 16, from 0.
    order: Union[tuple[int, ...], None]
    #: The root is the mirror image, in the plane of the base, of the pose near the centre.
    mirrored: Union[bool, None]


class CheckAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The verdict in a sentence, with the name.
    headline: str
    #: The unit of lengths.
    units: str
    #: The size of the design, in its units: what distances are compared with.
    size: Union[float, None]
    #: How exactly its joints are known.
    joints: JointsRecord
    #: Null: the design as written is regular, and a singular one lies within rounding of it or within the
    #: digits given; or joints are known between bounds only.
    architecturally_singular: Union[bool, None]
    #: What the answer is proved about; within rounding: a singular design may have been meant. Null: not
    #: decided.
    level: Union[Level, None]
    #: Decided exactly, for the joints as the numbers they are; null where they are known between bounds
    #: only.
    singular_as_written: Union[bool, None]
    #: What shows that the home pose of the design is singular; null: it is regular, or the design states
    #: none.
    singular_home: Union[SingularEvidenceWord, None]
    #: A short code of the reason; null: regular.
    reason: Union[str, None]
    #: One sentence.
    explanation: str
    #: What proves the answer for the joints as written.
    proof: ProofWord
    #: One sentence on the proof.
    proof_explanation: str
    #: Rank of the leg vectors.
    leg_rank: int
    #: Rank of the leg lines at almost every pose.
    jacobian_rank: int
    #: A pose with that rank.
    witness: WitnessRecord
    #: The first of the dependencies.
    dependency: Union[DependencyRecord, None]
    #: Dependencies of leg vectors.
    dependencies: tuple[DependencyRecord, ...]
    #: The legs of the first case.
    guilty_legs: Union[tuple[int, ...], None]
    #: The cases that apply, most telling first.
    cases: tuple[CaseRecord, ...]
    #: The Griffis-Duffy type, where the joints lie on the sides of two triangles.
    griffis_duffy: Union[GriffisDuffyRecord, None]
    #: The nearest singular design that was found; null for a singular one.
    nearest_singular: Union[NearestSingularRecord, None]
    #: Finite poses, real and complex, for generic leg lengths.
    pose_count: PoseCountRecord
    #: The points that six legs have in common, for generic lengths, by where they are; null where the
    #: poses are not isolated or not counted.
    common_points: Union[CommonPointsRecord, None]
    #: How many isolated finite poses no lengths exceed, by a theorem.
    pose_bound: PoseBoundRecord
    #: In which steps the poses can be found: whether by quadratic equations alone, and which part of the
    #: platform can be placed before the rest.
    solvability: Solvability
    #: The line that fits the joints of each body best, base first: a body whose joints all lie on one
    #: turns about it. A body with its joints in one place has none.
    best_lines: tuple[BestLineRecord, ...]
    #: Singular values of the normalised leg vectors.
    singular_values: tuple[Union[float, None], ...]
    #: How well conditioned the Jacobian is at random poses.
    jacobian_inverse_condition: ConditioningRecord
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class ChiSquareRecord(Record):
    """Agreement of residuals with the noise."""

    #: Sum of the squares of whitened residuals.
    value: Union[float, None]
    #: Numbers less unknowns identified.
    degrees_of_freedom: int
    #: The probability of a larger value, were model and noise right; null: the noise is estimated from the
    #: same residuals.
    probability: Union[float, None]


class ClosurePolynomialRecord(Record):
    """The closure polynomial in one squared distance, with what it says about the number of real poses."""

    #: The joints of the virtual leg; null where none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: The joints whose squared distance is the unknown.
    unknown: tuple[str, ...]
    #: The joints of the first triangle.
    start: tuple[str, ...]
    #: The trilaterations after it.
    sequence: tuple[TrilaterationStepRecord, ...]
    #: The unknowns by their names.
    unknowns: tuple[str, ...]
    #: The degree before factors without meaning are removed.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The factors that were removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Different complex roots; null with several unknowns, and where that is not proved.
    distinct_roots: Union[int, None]
    #: How the coefficients are known.
    coefficients_known: CoefficientsWord
    #: The exponents of the unknowns in each term.
    exponents: tuple[tuple[int, ...], ...]
    #: The exact coefficient of each term, integers as decimal text; of one unknown the constant one first.
    coefficients: tuple[str, ...]
    #: Different real roots, counted by Sturm's theorem; null with several unknowns, and where coefficients
    #: are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: How often each of them is a root.
    real_root_multiplicities: tuple[int, ...]
    #: Singular factors.
    factors: tuple[SingularFactorRecord, ...]
    #: Real poses at each of them; null where that does not follow.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Real poses in all, proved; null where that does not follow.
    poses_real_proved: Union[int, None]
    #: Bounds [low, high] of the coefficients, where they are not exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class ClosureRecord(Record):
    """The exact closure polynomial beside the poses."""

    #: The joints of the virtual leg; null where none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: The joints whose squared distance is the unknown.
    unknown: Union[tuple[str, ...], None]
    #: The joints of the first triangle.
    start: Union[tuple[str, ...], None]
    #: The trilaterations after it.
    sequence: Union[tuple[TrilaterationStepRecord, ...], None]
    #: The unknowns by their names.
    unknowns: Union[tuple[str, ...], None]
    #: The degree before factors without meaning are removed.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The factors that were removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Different complex roots; null with several unknowns, and where that is not proved.
    distinct_roots: Union[int, None]
    #: How the coefficients are known.
    coefficients_known: Union[CoefficientsWord, None]
    #: The exponents of the unknowns in each term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: The exact coefficient of each term, integers as decimal text; of one unknown the constant one first.
    coefficients: Union[tuple[str, ...], None]
    #: Bounds [low, high] of the coefficients, where they are not exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Different real roots, counted by Sturm's theorem; null with several unknowns, and where coefficients
    #: are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: How often each of them is a root.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: Singular factors.
    factors: Union[tuple[SingularFactorRecord, ...], None]
    #: Real poses at each of them; null where that does not follow.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Real poses in all, proved; null where that does not follow.
    poses_real_proved: Union[int, None]
    #: Why not.
    error: Union[str, None]


class CommonPointsRecord(Record):
    """Common points of six legs in the closure of the group, each with its multiplicity, counted modulo random primes."""

    #: Finite poses.
    finite: int
    #: Limits of poses whose quaternion e becomes isotropic: e.e = 0, e not 0. Null: not isolated, or not
    #: counted.
    isotropic: Union[int, None]
    #: Limits of poses with e = 0: the position goes to infinity. Null: points at infinity are not
    #: isolated, or not counted.
    at_infinity: Union[int, None]
    #: A bound on the probability that the numbers are others.
    error_probability: float


class CompareAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: Of all designs.
    length_unit: str
    #: Of all designs.
    force_unit: str
    #: The manoeuvres about home along which forces, speeds and powers are taken.
    manoeuvres: tuple[str, ...]
    #: The accuracy for which joints are toleranced; null: none was asked for.
    accuracy: Union[AccuracyRecord, None]
    #: Characteristic length of every conditioning in this answer: that of the first design.
    characteristic_length: float
    #: In the order in which they were given.
    designs: tuple[FiguresRecord, ...]
    #: The table and the page that were written.
    paths: tuple[str, ...]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class ComparedRecord(Record):
    """A verification in short."""

    #: Sets of lengths at which both designs were solved.
    sample_count: int
    #: The largest distance of matched poses.
    worst_distance: Union[float, None]
    #: Of the affine map.
    residual: Union[float, None]
    #: Its determinant.
    det: Union[float, None]


class ComplexRecord(Record):
    """Complex numbers in some arrangement: real and imaginary parts, each in that arrangement."""

    #: Real parts.
    re: tuple[Union[float, None], ...]
    #: Imaginary parts.
    im: tuple[Union[float, None], ...]


class ComplexRecord2(Record):
    """Complex numbers in some arrangement: real and imaginary parts, each in that arrangement."""

    #: Real parts.
    re: PoseRecord
    #: Imaginary parts.
    im: PoseRecord


class ComplexRecord3(Record):
    """Complex numbers in some arrangement: real and imaginary parts, each in that arrangement."""

    #: Real parts.
    re: tuple[tuple[Union[float, None], ...], ...]
    #: Imaginary parts.
    im: tuple[tuple[Union[float, None], ...], ...]


class ComplexRecord4(Record):
    """Complex numbers in some arrangement: real and imaginary parts, each in that arrangement."""

    #: Real parts.
    re: tuple[Union[float, None], ...]
    #: Imaginary parts.
    im: tuple[Union[float, None], ...]


class ComplexRecord5(Record):
    """Complex numbers in some arrangement: real and imaginary parts, each in that arrangement."""

    #: Real parts.
    re: tuple[Union[float, None], ...]
    #: Imaginary parts.
    im: tuple[Union[float, None], ...]


class ComputedPosesRecord(Record):
    """Standard deviations of poses computed from lengths, by what the calibration does not know, with all correlations; the noise of these lengths comes on top."""

    #: Poses looked at: those of the workspace at which the requirements of the design are met.
    poses: int
    #: Root mean square of the distance by which the platform origin of the measurements is off, design
    #: units: the median over the poses.
    position_median: Union[float, None]
    #: The greatest of them.
    position_greatest: Union[float, None]
    #: Root mean square of the angle by which the orientation is off, degrees: the median over the poses.
    rotation_deg_median: Union[float, None]
    #: The greatest of them.
    rotation_deg_greatest: Union[float, None]
    #: The pose with the greatest deviation of the position.
    pose: PoseQuaternionRecord


class ConditioningRecord(Record):
    """The inverse condition number of the Jacobian at random poses."""

    #: How many poses.
    poses: int
    #: The best.
    best: Union[float, None]
    #: The median.
    median: Union[float, None]
    #: The worst.
    worst: Union[float, None]


class ConflictReasonRecord(Record):
    """A kind of proof that branches of the offsets are empty."""

    #: A short stable code.
    code: Literal["vertices_too_close", "outside_bounds", "no_room", "pair_too_close", "det_too_small", "combination"]
    #: Branches with this as their first proof.
    branches: int
    #: One sentence with the numbers of one of them.
    message: str


class ConflictRecord(Record):
    """Requirements that cannot be met together; without any one of them the others were met."""

    #: The set is proved to be in conflict.
    proved: bool
    #: What would have to give; empty where every branch is empty for reasons of its own.
    requirements: tuple[GiveRecord, ...]
    #: Why the branches of the offsets are empty, by kind; empty where the search has no branches.
    reasons: tuple[ConflictReasonRecord, ...]


class CornerLengthsRecord(Record):
    """Squared lengths origin + x direction with x in the interval."""

    #: For x = 0.
    origin: tuple[Union[float, None], ...]
    #: What x multiplies.
    direction: tuple[Union[float, None], ...]
    #: Where x may be.
    interval: tuple[Union[float, None], ...]


class CorrespondenceRecord(Record):
    """Which leg of FROM each leg of TO is."""

    #: The leg of FROM, from 1; null: none of them.
    legs: tuple[Union[int, None], ...]
    #: Its distance from the leg of TO, over the size.
    distances: tuple[Union[float, None], ...]
    #: Every leg of FROM is one leg of TO.
    permutation: bool
    #: All distances are zero.
    exact: bool


class CounterexampleRecord(Record):
    """A pose that belongs to the lengths of one design and not to those of the other."""

    #: Index into `samples`, from 0.
    sample: int
    #: The design whose lengths the pose has: A or B.
    solves: Literal["A", "B"]
    #: The pose.
    pose: ComplexRecord2
    #: Whether a certificate proves the pose a solution of the one.
    certified: bool
    #: The leg of the other design that is missed most, from 1.
    leg: int
    #: By how much its squared length is missed, relative to the squared size.
    miss: Union[float, None]
    #: Rounding to expect in this number.
    rounding: Union[float, None]


class CounterexampleRecord2(Record):
    """A pose that belongs to the lengths of one design and not to those of the other."""

    #: Index into `samples`, from 0.
    sample: int
    #: The design whose lengths the pose has: A or B.
    solves: Literal["A", "B"]
    #: The pose.
    pose: ComplexRecord2
    #: Whether a certificate proves the pose a solution of the one.
    certified: bool
    #: The leg of the other design that is missed most, from 1.
    leg: int
    #: By how much its squared length is missed, relative to the squared size.
    miss: Union[float, None]
    #: Rounding to expect in this number.
    rounding: Union[float, None]


class CountsRecord(Record):
    """How many members the class has."""

    #: Patterns of kept and moved legs.
    patterns: int
    #: Patterns up to the symmetries of the hexagon that keep base and platform apart.
    classes: int
    #: Patterns up to all symmetries of the hexagon.
    classes_exchange: int
    #: Ways in which legs share joints, the octahedral one included.
    topologies: int
    #: The same where base and platform may be exchanged.
    topologies_exchange: int
    #: Topologies that are reached by offsets introduced one at a time.
    sequential_topologies: int
    #: The same where base and platform may be exchanged.
    sequential_topologies_exchange: int
    #: Patterns that are reached by offsets introduced one at a time.
    sequential_patterns: int
    #: Patterns that split joints only.
    splitting_patterns: int


class CovarianceRecord(Record):
    """A covariance matrix."""

    #: Names of rows and columns: `base.A1.x`, `offset.3`.
    unknowns: tuple[str, ...]
    #: Rows.
    matrix: tuple[tuple[Union[float, None], ...], ...]


class CrankFiguresRecord(Record):
    """What cranks do over the poses that all rods reach."""

    #: Least angle; null: no pose is reached.
    least_deg: Union[float, None]
    #: Greatest angle.
    greatest_deg: Union[float, None]
    #: Least transmission angle: 0 at a singular crank.
    transmission_deg: Union[float, None]
    #: Greatest torque under the payload and the loads, one at a time, force units times design units.
    torque: Union[float, None]
    #: Greatest speed under the speed that the platform has to have, degrees per second.
    speed_deg: Union[float, None]
    #: Greatest torque along the manoeuvres.
    motion_torque: Union[float, None]
    #: Greatest speed along the manoeuvres, degrees per second.
    motion_speed_deg: Union[float, None]


class CrankMotionRecord(Record):
    """A crank along a motion."""

    #: From 1.
    leg: int
    #: Least angle.
    least_deg: ExtremeRecord
    #: Greatest angle.
    greatest_deg: ExtremeRecord
    #: Speed of the greatest size, degrees per second.
    speed_deg: ExtremeRecord
    #: Acceleration of the greatest size, degrees per second squared.
    acceleration_deg: ExtremeRecord
    #: Torque of the greatest size about the axis, force units times design units; null: no masses are
    #: known, or torques are not determined. Cranks and rods count as massless.
    torque: Union[ExtremeRecord, None]
    #: Root of the mean square of the torque over time.
    rms_torque: Union[float, None]
    #: Power of the greatest size, watts; negative where the drive brakes.
    power_w: Union[ExtremeRecord, None]


class DecouplingLeg(Record):
    """A sixth leg with which the platform is solved in steps, each a polynomial of low degree."""

    case: Union[Literal["off_the_line", "to_the_line", "to_the_joint"], None]
    #: The body.
    body: Union[Body, None]
    #: The four legs, counted from 1.
    legs: Union[tuple[int, ...], None]


class DefaultReserveRecord(Record):
    """What became of the reserve that a design does not state."""

    #: On every limit.
    percent: float
    #: The platform found keeps it; false: no platform that keeps it was found, and the search went on
    #: without.
    kept: bool
    #: One sentence.
    message: str


class DependencyRecord(Record):
    """A dependency of leg vectors: `sum c_i v_i = 0`."""

    #: The legs in it, from 1.
    legs: tuple[int, ...]
    #: The numbers `c_i`.
    coefficients: tuple[Union[float, None], ...]
    #: `sum c_i s_i` of the squared lengths of every pose.
    constant: Union[float, None]
    #: Dimension of the span of the base ends.
    base_dimension: int
    #: Dimension of the span of the platform ends.
    platform_dimension: int
    #: By how much the lengths of the design miss the constant, relative; null without lengths.
    lengths_defect: Union[float, None]


class DerivationRecord(Record):
    """How A, c and det A of one platform of the class follow from coplanar joints, and what forward kinematics says."""

    #: The numbers are those of exact joints, and each moved joint lies on its line exactly; otherwise they
    #: are those of the doubles.
    exact: bool
    #: One row of A for each moved leg, all offsets at once, from the legs of the octahedral platform.
    moves: tuple[LegSlideRecord, ...]
    #: The same one offset at a time, from the legs that are there before each move; det A is the product
    #: of their `rest`. null: no order of single moves reaches the platform without two legs on one
    #: another.
    sequence: Union[tuple[LegSlideRecord, ...], None]
    #: The factors of det A.
    factors: tuple[FactorRecord, ...]
    #: Products over all six offsets, whose difference det A is; null: some leg is not moved.
    products: Union[OffsetProductsRecord, None]
    #: Forward kinematics of the octahedral platform and of this one, solved independently, and the leg map
    #: from one to the other.
    verification: VerifyAnswer


class Design(Record):
    """A design file of equipod, as JSON; a TOML file has the same structure. What no schema can say (joints of legs exist, axes are not zero, rotations are rotations) is checked by the program."""

    #: of the design, not blank
    name: str
    #: label of the length unit; every length of the file is in it
    units: str
    #: `[base joint, platform joint]` in leg order; in TOML above the first table
    legs: tuple[tuple[str, ...], ...]
    #: joints in the base frame, each as `[x, y, z]` or as a construction
    base: DesignBody
    #: joints in the platform frame, each as `[x, y, z]` or as a construction
    platform: DesignBody
    #: unit of all forces; torques are in it times the length unit; where none is named a payload and the
    #: simulator take newtons
    force_units: Union[Literal["N", "kN", "kgf", "lbf"], None]
    #: unit of all masses; kilograms where none is named
    mass_units: Union[Literal["g", "kg", "t", "lb"], None]
    #: where the numbers come from
    source: Union[str, None]
    #: free text
    description: Union[str, None]
    #: of the design, as its drawings and parts name it
    revision: Union[str, None]
    #: `prismatic`: legs change their lengths; `rotary`: the legs are rods of constant length on cranks,
    #: the base joints are the centres of the cranks, and `[cranks]` is required
    drive: Union[Literal["prismatic", "rotary"], None]
    #: leg lengths in leg order, which `equipod fk` takes without `--lengths`
    lengths: Union[tuple[DesignNotNegative, ...], None]
    #: numbers and expressions that expressions of joints and of other parameters name
    parameters: Union[dict[str, DesignQuantity], None]
    #: cranks and rods of a design whose drive is rotary: what holds for all, and tables named by base
    #: joints for what is different at one
    cranks: Union[dict[str, DesignCrank], None]
    #: the pose the platform is built for
    home: Union[DesignHomePose, None]
    #: the machine's own convention for poses that commands take and answer
    frames: Union[dict[str, Any], None]
    #: the poses to reach
    workspace: Union[dict[str, Any], None]
    #: what the optimiser chooses, and by what
    optimize: Union[dict[str, Any], None]
    #: sizes and limits of joints, legs and drives
    hardware: Union[dict[str, Any], None]
    #: the platform has to move so fast in every direction
    speed: Union[dict[str, Any], None]
    #: the platform has to be so stiff on its legs at every pose; needs `leg_stiffness` of `[hardware]`
    stiffness: Union[dict[str, Any], None]
    #: wrenches the legs have to hold, one at a time
    loads: Union[tuple[dict[str, Any], ...], None]
    #: bodies the legs must not touch, each a box, a sphere or a capsule
    keep_out: Union[tuple[Any, ...], None]
    #: what the platform carries
    payload: Union[dict[str, Any], None]
    #: room that plates and machine may take up
    envelope: Union[dict[str, Any], None]
    #: grids of holes that the joints have to be put on, of both plates or of one
    holes: Union[dict[str, Any], None]
    #: the plates that carry the joints: sizes, material, holes and bolts
    plates: Union[dict[str, Any], None]
    #: what has to remain of each limit
    limits: Union[dict[str, Any], None]
    #: what `equipod calibrate` found beside the joints
    calibration: Union[dict[str, Any], None]


class DesignBolts(Record):
    """DesignBolts"""

    #: bolts of a joint
    count: int
    #: diameter of their circle
    circle: DesignPositive
    #: diameter of their holes
    hole: DesignPositive
    #: angle of the first one, degrees
    first_deg: Union[DesignNumber, None]
    #: from where it counts: from the first axis of the plate, or from the direction from the origin of the
    #: plate to the joint
    from_: Union[Literal["axis", "centre"], None]


class DesignBox(Record):
    """DesignBox"""

    center: DesignVector
    size: DesignEdges


class DesignCapsule(Record):
    """DesignCapsule"""

    from_: DesignVector
    to: DesignVector
    diameter: DesignPositive


class DesignCrank(Record):
    """DesignCrank"""

    #: of each crank, from its centre to its tip
    length: Union[DesignQuantity, None]
    #: of each rod, from the tip to the platform joint
    rod_length: Union[DesignQuantity, None]
    #: direction of the axis, base frame; angles count about it by the right hand
    axis: Union[tuple[DesignQuantity, ...], None]
    #: direction of the tip at the angle 0, base frame; what of it is along the axis is left out
    zero: Union[tuple[DesignQuantity, ...], None]
    #: the side that the crank stays on: the greater or the smaller of the two angles around the one at
    #: which the tip is nearest to the platform joint
    elbow: Union[Literal["plus", "minus"], None]
    #: `[least, greatest]` angle, degrees; none when absent
    angle_deg: Union[tuple[DesignQuantity, ...], None]
    #: the base joint of another crank: this one has its values, with axis and zero turned about the z axis
    #: of the base frame
    turn: Union[str, None]
    #: with `turn`
    deg: Union[DesignQuantity, None]
    #: the base joint of another crank: this one has its values, with zero mirrored and axis mirrored and
    #: reversed, so that equal angles are mirror images
    mirror: Union[str, None]
    #: with `mirror`
    plane: Union[Literal["xy", "xz", "yz"], None]


class DesignEnvelope(Record):
    """DesignEnvelope"""

    #: of a cylinder about a line along the z axis
    radius: Union[DesignPositive, None]
    #: of the cylinder
    center: Union[tuple[DesignNumber, ...], None]
    #: the least coordinates of a box
    min: Union[DesignVector, None]
    #: the greatest coordinates of a box
    max: Union[DesignVector, None]


class DesignHoleGrid(Record):
    """DesignHoleGrid"""

    pattern: Union[Literal["square", "triangular", "polar", "bolt_circle"], None]
    #: distance of neighbouring holes, or of the rings of a polar grid
    pitch: Union[DesignPositive, None]
    #: radius of the innermost ring of a polar grid
    first_radius: Union[DesignPositive, None]
    #: radii of bolt circles
    radii: Union[DesignPositive, tuple[DesignPositive, ...], None]
    #: angle between neighbouring holes of a ring or of each bolt circle; a whole number of them makes 360
    step_deg: Union[DesignPositive, tuple[DesignPositive, ...], None]
    #: number of holes of a ring or of each bolt circle, instead of step_deg
    count: Union[int, tuple[int, ...], None]
    #: a hole, or the centre of the circles
    origin: Union[tuple[DesignNumber, ...], None]
    #: turn of the grid
    angle_deg: Union[DesignNumber, None]


class DesignHomePose(Record):
    """DesignHomePose"""

    #: of the platform origin, base frame
    position: tuple[DesignQuantity, ...]
    #: roll, pitch, yaw in degrees, `R = Rz(yaw) Ry(pitch) Rx(roll)`; exactly one of `rpy_deg`, `quat_wxyz`
    #: and `rotation` is there
    rpy_deg: Union[tuple[DesignQuantity, ...], None]
    #: scalar part first, of norm 1 within 1e-3; it is normalised
    quat_wxyz: Union[DesignQuaternion, None]
    #: rows of R, orthonormal within 1e-9 and right-handed; taken as it is
    rotation: Union[DesignRows, None]


class DesignJointModel(Record):
    """DesignJointModel"""

    #: `ball`: turns freely in a cone; `universal`: two axes, the first fixed in the body, the second at a
    #: right angle to it and to the leg; `flexure`: bends about its centre, within the cone of the swing
    model: Literal["ball", "universal", "flexure"]
    #: universal: direction of the first axis in the frame of the body, one for all joints or six in leg
    #: order, in a list of tables one; required
    first_axis: Union[DesignVector, tuple[DesignVector, ...], None]
    #: universal: greatest angles about the first and about the second axis, either way, degrees; none when
    #: absent
    angle_deg: Union[tuple[float, float], None]
    #: universal: distance of the two axes, which meet when it is 0
    offset: Union[DesignNotNegative, None]
    #: the room that the joint takes up, in place of that of the body: a diameter, or edge lengths of a box
    #: along the axes of the body
    housing: Union[DesignHousing, None]
    #: greatest angle between the leg and the axis of the joint, in place of that of the body
    #: (`base_swing_deg`, `platform_swing_deg`)
    swing_deg: Union[float, None]
    #: flexure: torque over angle, force units times design units per radian; required
    bending_stiffness: Union[DesignPositive, None]


class DesignPlate(Record):
    """DesignPlate"""

    #: thickness
    thickness: DesignPositive
    #: distance of the outline from the convex hull of the joints, more than half of `hole`
    margin: DesignPositive
    #: diameter of the hole under each joint
    hole: DesignPositive
    #: height of the lowest joint centre above the face of the plate; without it that of a ball as wide as
    #: the housing on the edge of the hole
    height: Union[DesignPositive, None]
    #: `aluminium`, `steel`, `stainless_steel`, `cast_iron`, `titanium`, `brass`, `pom` or `plywood`, whose
    #: densities are known, or another name beside `density`
    material: Union[str, None]
    #: kg/m^3; `units` is then a unit of length that is known
    density: Union[DesignPositive, None]
    #: least distance of the edge of a hole from the outline
    edge_distance: Union[DesignNotNegative, None]
    #: least distance of the edges of two holes
    hole_distance: Union[DesignNotNegative, None]
    #: diameter of the round foot of a joint; feet keep apart
    foot: Union[DesignPositive, None]
    #: the bolts of each joint, on a circle about its centre
    bolts: Union[DesignBolts, None]


class DesignPose(Record):
    """DesignPose"""

    #: of the platform origin, base frame
    position: DesignVector
    #: roll, pitch, yaw in degrees, `R = Rz(yaw) Ry(pitch) Rx(roll)`; exactly one of `rpy_deg`, `quat_wxyz`
    #: and `rotation` is there
    rpy_deg: Union[DesignVector, None]
    #: scalar part first, of norm 1 within 1e-3; it is normalised
    quat_wxyz: Union[DesignQuaternion, None]
    #: rows of R, orthonormal within 1e-9 and right-handed; taken as it is
    rotation: Union[DesignRows, None]


class DesignSourceRecord(Record):
    """A design that an answer is about."""

    #: The name of the design.
    name: str
    #: The file it was read from, as it was named; null: it was made in memory, and its text is what it
    #: would be saved as.
    path: Union[str, None]
    #: SHA-256 of the bytes of that file or text, hexadecimal.
    sha256: str


class DesignSphere(Record):
    """DesignSphere"""

    center: DesignVector
    diameter: DesignPositive


class DeviationRecord(Record):
    """A standard deviation over the poses looked at."""

    #: Half of the poses have at most this.
    median: Union[float, None]
    #: The greatest.
    greatest: Union[float, None]
    #: What it would be at the same pose if every coordinate and offset were off for itself.
    independent: Union[float, None]
    #: The pose.
    pose: PoseQuaternionRecord
    #: Covariance of the shift of the tool point (design units) and the rotation vector (degrees) at the
    #: pose, base frame.
    covariance: tuple[tuple[Union[float, None], ...], ...]


class DifferenceRecord(Record):
    """An invariant that tells two designs apart."""

    #: Which.
    invariant: Invariant
    #: Its value for the first design.
    a: Union[float, None]
    #: Its value for the second.
    b: Union[float, None]
    #: By how much they differ.
    gap: Union[float, None]
    #: What a difference has to exceed.
    bound: Union[float, None]


class DiscsRecord(Record):
    """Discs in the complex plane, in some arrangement."""

    #: Real parts of the centres.
    re: tuple[tuple[Union[float, None], ...], ...]
    #: Imaginary parts of the centres.
    im: tuple[tuple[Union[float, None], ...], ...]
    #: Radii.
    radius: tuple[tuple[Union[float, None], ...], ...]


class DiscsRecord2(Record):
    """Discs in the complex plane, in some arrangement."""

    #: Real parts of the centres.
    re: tuple[Union[float, None], ...]
    #: Imaginary parts of the centres.
    im: tuple[Union[float, None], ...]
    #: Radii.
    radius: tuple[Union[float, None], ...]


class DriveRecord(Record):
    """A drive of the table, in the units of the design."""

    #: Its name.
    name: str
    #: Line of the table, from 1.
    line: int
    #: It is proved to fit, proved not to, or neither (null).
    fits: Union[bool, None]
    #: The reserve on every limit is kept too, likewise.
    reserve_kept: Union[bool, None]
    #: The travel.
    stroke: Union[float, None]
    #: Least and greatest length from joint centre to joint centre.
    leg_length: tuple[Union[float, None], ...]
    #: Greatest force; null: the table does not say it.
    force: Union[float, None]
    #: Greatest speed; null: the table does not say it.
    speed: Union[float, None]
    #: Mass; null: the table does not say it.
    mass: Union[float, None]
    #: Stiffness along the drive; null: the table does not say it.
    stiffness: Union[float, None]
    #: Price; null: the table does not say it.
    price: Union[float, None]
    #: Where the numbers are from; null: the table does not say it.
    source: Union[str, None]
    #: What `assess` says of the design with the drive.
    assessment: AssessAnswer
    #: Along the motions asked for.
    motions: tuple[MotionRunRecord, ...]


class DriveSearchRecord(Record):
    """The search over the drives of a table."""

    #: The name of the drive of the answer; null: with no drive was a platform found that is proved to meet
    #: the requirements.
    chosen: Union[str, None]
    #: What decides between drives with which the requirements are met.
    ranked_by: DriveRanking
    #: Of prices, as the table names it; null: it does not.
    currency: Union[str, None]
    #: The search was told to end before every drive was tried that could win.
    interrupted: bool
    #: One sentence.
    message: str
    #: All drives, the best first.
    drives: tuple[SearchedDriveRecord, ...]


class DriveSolutionRecord(Record):
    """How the pose for lengths of drives was found."""

    #: What is known of it.
    status: DriveSolutionWord
    #: Why there is no pose.
    reason: Union[str, None]
    #: The lengths that the drives show.
    lengths: tuple[float, ...]
    #: The distances of the joints at the pose, to which it was followed.
    distances: tuple[float, ...]
    #: Steps of the fixed point.
    steps: int
    #: The greatest ratio of two changes of the corrections, one after the other; 0 where there were none
    #: above rounding.
    factor: Union[float, None]
    #: Proved: the platform origin of the pose with exactly these lengths is no farther away, design units.
    position_bound: Union[float, None]
    #: Proved: its rotation is no farther away.
    angle_bound_deg: Union[float, None]
    #: The factor by which the Newton map contracts around the pose; null: not proved.
    contraction: Union[float, None]


class DrivesAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: True: a drive is proved to fit; false: every drive is proved not to; null: neither.
    met: Union[bool, None]
    #: The name of the drive to take: the cheapest that is proved to fit, the lightest of equally cheap
    #: ones; null: there is none.
    chosen: Union[str, None]
    #: All drives: those that fit, those that are undecided, those that do not; each by price, then mass.
    drives: tuple[DriveRecord, ...]
    #: Of prices, as the table names it; null: it does not.
    currency: Union[str, None]
    #: Of lengths; speeds are in it per second.
    length_unit: str
    #: Of forces.
    force_unit: str
    #: Of masses.
    mass_unit: str
    #: What neither the file nor the table says and was taken instead, a sentence each.
    assumptions: tuple[str, ...]
    #: The design with the chosen drive; null: none fits.
    design: Union[Design, None]
    #: The file written.
    output: Union[str, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class EnclosureRecord(Record):
    """Discs that hold the entries of R and p of a root."""

    #: The entries of the rotation matrix, rows.
    R: DiscsRecord
    #: The entries of the position, design units.
    p: DiscsRecord2


class ErrorMapRecord(Record):
    """The greatest errors of the pose by all causes together, to first order."""

    #: Every joint is off by at most this in any direction.
    joint_error: Union[float, None]
    #: Every leg is longer or shorter than it shows by at most this.
    length_error: Union[float, None]
    #: Growth of base, platform and legs, as shares; with either sign.
    growth: tuple[Union[float, None], ...]
    #: Poses looked at: the corners and a sample of the region, and those that are listed.
    poses: int
    #: Of the tool point, design units.
    position: GreatestErrorRecord
    #: Of the orientation, degrees.
    rotation_deg: GreatestErrorRecord
    #: The table of all poses that was written; null: none.
    path: Union[str, None]


class ExactNumberRecord(Record):
    """A number that is known exactly, or as the doubles say it."""

    #: The nearest double.
    value: Union[float, None]
    #: The number as an expression, such as 4/5 or 1/2 + sqrt(3)/6; null where it is known as doubles only.
    exact: Union[str, None]


class ExactRoundingOutcome(Record):
    """The exact rounding, or why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: Equivalence with its own octahedral platform is proved in exact arithmetic.
    proved: Union[bool, None]
    #: What leg map and forward kinematics say of it.
    verdict: Union[RoundingVerdict, None]
    #: Turns by 120 degrees take both triangles with their joints to themselves.
    three_fold: Union[bool, None]
    #: Round the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: How good it is.
    judgement: Union[JudgementRecord, None]
    #: How it was found.
    search: Union[RoundingSearchRecord, None]
    #: What stands against it.
    error: Union[NoRoundingError, None]


class ExactRoundingRecord(Record):
    """All joints exactly on the sides of two triangles whose corners are holes."""

    #: The grids used.
    grids: GridsRecord
    #: Equivalence with its own octahedral platform is proved in exact arithmetic.
    proved: bool
    #: What leg map and forward kinematics say of it.
    verdict: RoundingVerdict
    #: Turns by 120 degrees take both triangles with their joints to themselves.
    three_fold: bool
    #: Round the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: How good it is.
    judgement: JudgementRecord
    #: How it was found.
    search: RoundingSearchRecord


class ExploreAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: Of the whole run.
    verdict: Union[ExploreVerdict, None]
    #: One sentence with the numbers that decided.
    explanation: Union[str, None]
    #: The name of the design.
    name: Union[str, None]
    #: The files written.
    paths: Union[tuple[str, ...], None]
    #: The equivalence class.
    family: Union[FamilySizeRecord, None]
    #: What `assess` says of the platform found; null: there is none, or the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The platform; null: none was found.
    optimize: Union[OptimizedRecord, None]
    #: Conic programs that the library clarabel solved in the search for the platform; those with other
    #: drives, for freedoms and for holes are not counted.
    conic_programs: Union[int, None]
    #: What separate joints cost: figures of the design and of the platform to build; null: there is none.
    price: Union[PriceRecord, None]
    #: What became of the reserve of 5 % on every limit; null: the design states a reserve.
    reserve: Union[DefaultReserveRecord, None]
    #: The comparison of the design with the optimised one; null: there is none.
    verify: Union[ComparedRecord, None]
    #: The platform with its joints on holes; null: the design states no holes, or no platform was found.
    #: The assessment is then that of this platform.
    holes: Union[OnHolesRecord, None]
    #: What became of the three-fold symmetry of the design; null where it has none, names one, or the
    #: search could not break it or did not look at it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table, with what the search came to with each; null where no table was given.
    drive_search: Union[DriveSearchRecord, None]
    #: Where nothing that meets the requirements was found: the freedoms that the design does not have,
    #: each with what came of a search that had it; null where none was looked at.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: The poses of the design.
    fk: Union[PoseTotalsRecord, None]
    #: What was done, in order.
    stages: Union[tuple[StageRecord, ...], None]
    #: The families of replaceable legs.
    components: Union[FamiliesFoundRecord, None]
    #: The search for an equivalent platform without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the platform equivalent to the nearest octahedral one meets the requirements of the design:
    #: true and false are proved; null: undecided, not looked at, or nothing is required.
    nearest_meets_requirements: Union[bool, None]


class ExploreGeneralAnswer(Record):
    """The answer of `explore` about a design that is not octahedral."""

    #: Of the whole run.
    verdict: ExploreVerdict
    #: One sentence with the numbers that decided.
    explanation: str
    #: The name of the design.
    name: str
    #: The files written.
    paths: tuple[str, ...]
    #: What was done, in order.
    stages: tuple[StageRecord, ...]
    #: The families of replaceable legs.
    components: FamiliesFoundRecord
    #: The search for an equivalent platform without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the platform equivalent to the nearest octahedral one meets the requirements of the design:
    #: true and false are proved; null: undecided, not looked at, or nothing is required.
    nearest_meets_requirements: Union[bool, None]
    #: The comparison of the design with the equivalent found, else of the nearest octahedral platform with
    #: its equivalent; null: there is neither.
    verify: Union[ComparedRecord, None]
    #: The poses of the design.
    fk: PoseTotalsRecord


class ExploreOctahedralAnswer(Record):
    """The answer of `explore` about an octahedral design."""

    #: Of the whole run.
    verdict: ExploreVerdict
    #: One sentence with the numbers that decided.
    explanation: str
    #: The name of the design.
    name: str
    #: The files written.
    paths: tuple[str, ...]
    #: The equivalence class.
    family: FamilySizeRecord
    #: What `assess` says of the platform found; null: there is none, or the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The platform; null: none was found.
    optimize: Union[OptimizedRecord, None]
    #: Conic programs that the library clarabel solved in the search for the platform; those with other
    #: drives, for freedoms and for holes are not counted.
    conic_programs: int
    #: What separate joints cost: figures of the design and of the platform to build; null: there is none.
    price: Union[PriceRecord, None]
    #: What became of the reserve of 5 % on every limit; null: the design states a reserve.
    reserve: Union[DefaultReserveRecord, None]
    #: The comparison of the design with the optimised one; null: there is none.
    verify: Union[ComparedRecord, None]
    #: The platform with its joints on holes; null: the design states no holes, or no platform was found.
    #: The assessment is then that of this platform.
    holes: Union[OnHolesRecord, None]
    #: What became of the three-fold symmetry of the design; null where it has none, names one, or the
    #: search could not break it or did not look at it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table, with what the search came to with each; null where no table was given.
    drive_search: Union[DriveSearchRecord, None]
    #: Where nothing that meets the requirements was found: the freedoms that the design does not have,
    #: each with what came of a search that had it; null where none was looked at.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: The poses of the design.
    fk: PoseTotalsRecord


class ExtremeRecord(Record):
    """A value with its time."""

    #: With its sign.
    value: Union[float, None]
    #: When.
    time_s: float


class FactorRecord(Record):
    """A factor of det A."""

    #: In the offsets, such as 1 - t1.
    formula: str
    #: The equation of its zeros, where the platform is architecturally singular.
    zero: str
    #: Its value at the offsets.
    value: ExactNumberRecord


class FailureRecord(Record):
    """A refusal or a failure."""

    #: A stable short code, `fk::not_applicable` for example.
    code: str
    #: One sentence.
    message: str
    #: What is wrong with the design file; empty where the failure is not about one.
    violations: tuple[ViolationRecord, ...]
    #: What to do about it.
    help: Union[str, None]
    #: The design file.
    path: Union[str, None]


class FamiliesFoundRecord(Record):
    """The families of replaceable legs in short."""

    #: How many.
    count: int
    #: There are no others.
    complete: bool


class FamilyAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: Legs along the hexagon, from 1.
    cyclic_order: tuple[int, ...]
    #: The edge of each side of the hexagon, design units.
    edge_lengths: tuple[Union[float, None], ...]
    #: How many there are.
    counts: CountsRecord
    #: The patterns, or the one that was asked for.
    patterns: tuple[PatternRecord, ...]
    #: The ways in which legs share joints.
    topologies: tuple[FamilyTopologyRecord, ...]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: The platform of the pattern at the offsets given, with `--offsets`.
    instance: Union[InstanceRecord, None]
    #: How its map follows from coplanar joints, with `--explain`.
    derivation: Union[DerivationRecord, None]


class FamilySizeRecord(Record):
    """How many platforms are equivalent to an octahedral one."""

    #: Patterns of legs.
    patterns: int
    #: Ways to share joints.
    topologies: int


class FamilyTopologyRecord(Record):
    """A way in which the legs of equivalent platforms share joints."""

    #: Its number, from 1.
    topology: int
    #: Joints of the base.
    base_joints: int
    #: Joints of the platform.
    platform_joints: int
    #: Joints that hold more than one leg.
    shared_joints: int
    #: It is reached by offsets introduced one at a time.
    sequential: bool
    #: A pattern that has it.
    example: str
    #: Topologies one offset further, from 1.
    next: tuple[int, ...]


class FiguresRecord(Record):
    """The figures of a design over the poses of its workspace, at home where it states none. Null: the design says nothing about it, or the value is not finite."""

    #: Name of the design.
    name: str
    #: Its file.
    path: str
    #: The judgement of `assess`; null: it requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The lightest drive of the table that the design names with which its requirements are met; null: it
    #: names none.
    lightest_drive: Union[LightestDriveRecord, None]
    #: The poses of all figures.
    judged: JudgedPosesRecord
    #: Poses looked at for the figures besides the judgement and the conditioning.
    poses: int
    #: Least leg length; null where the legs are rods on cranks.
    shortest: Union[float, None]
    #: Greatest leg length; null where the legs are rods on cranks.
    longest: Union[float, None]
    #: The difference.
    stroke: Union[float, None]
    #: Lengths at home that differ by more than a millionth of the size; of rods on cranks the lengths of
    #: the rods.
    different_legs: int
    #: Greatest leg force under the weight of all that moves and under each load, one at a time.
    force: Union[float, None]
    #: Greatest leg speed under the speed that the platform has to have.
    speed: Union[float, None]
    #: Greatest leg force along the manoeuvres.
    motion_force: Union[float, None]
    #: Greatest leg speed along the manoeuvres.
    motion_speed: Union[float, None]
    #: Greatest power of a drive along the manoeuvres, watts.
    motion_power_w: Union[float, None]
    #: The worst conditioning of `assess`: the least inverse condition number found.
    conditioning: Union[float, None]
    #: Least stiffness against a force through the platform origin, force units per design unit.
    stiffness: Union[float, None]
    #: Lowest natural frequency.
    frequency_hz: Union[float, None]
    #: Least distance of two joint centres of the base.
    base_spacing: Union[float, None]
    #: The same on the platform.
    platform_spacing: Union[float, None]
    #: Least gap between two legs.
    clearance: Union[float, None]
    #: Greatest distance of a joint of the base from their centroid.
    base_radius: Union[float, None]
    #: The same on the platform.
    platform_radius: Union[float, None]
    #: How far every joint may be off, in any direction, for the accuracy to be kept to first order.
    joint_tolerance: Union[float, None]
    #: Why there is no such tolerance; null: there is one, or none was asked for.
    no_tolerance: Union[str, None]
    #: Assumptions about masses that the file leaves open, a sentence each; empty where no figure is a
    #: force, a torque or a natural frequency.
    assumptions: tuple[str, ...]
    #: What the cranks do, where the legs are rods on cranks.
    cranks: Union[CrankFiguresRecord, None]


class FileSourceRecord(Record):
    """A file that is no design."""

    #: The file, as it was named.
    path: str
    #: SHA-256 of its bytes, hexadecimal.
    sha256: str


class FkAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: The convention of `in_frames`.
    frames: Union[PoseConventionRecord, None]
    #: In the order of the file.
    rows: Union[tuple[FkRowRecord, ...], None]
    #: The method that found them.
    method: Union[Method, None]
    #: Whether these are known to be all.
    completeness: Union[CompletenessWord, None]
    #: One sentence on what is known.
    completeness_reason: Union[str, None]
    #: The numbers of the proof that all poses up to a distance are listed, where it is one.
    bounded: Union[BoundedProof, None]
    #: False: roots may be missing.
    all_paths_accounted: Union[bool, None]
    #: The number of `solutions`.
    finite_count: Union[int, None]
    #: The same, each pose counted as often as it stands for.
    finite_count_with_multiplicity: Union[int, None]
    #: Real poses among them.
    real_count: Union[int, None]
    #: Poses of which it is not decided whether they are real.
    undecided_count: Union[int, None]
    #: Finite poses, multiplicity included, that are not among the certified ones; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses, by theorem or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: Real ones first.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: The paths of the homotopy.
    paths: Union[tuple[PathRecord, ...], None]
    #: Candidates that are no roots.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Ends of paths without a certificate, near which there may be one pose, several or none: they are not
    #: among the solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: What libraries of linear algebra computed for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: What null stands for, where a number is not finite.
    notes: Union[tuple[str, ...], None]
    #: The angles of the cranks, where these were given; the legs are then the rods from the tips of the
    #: cranks, as doubles, to the platform, and certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all angles given are within their limits, the ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: The legs whose cranks are beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Where tips and platform joints have the symmetry of three turns, to rounding, and rods are equally
    #: long: how many finite poses the exactly symmetric platform has, by a theorem. Further poses of the
    #: tips as doubles are so far out that their rounding decides whether there are any.
    symmetric_finite: Union[int, None]
    #: How the pose was followed, with `--near`.
    near: Union[NearRecord, None]
    #: What the corrections of joints that are not ideal came to; the lengths are then those of drives, and
    #: no certificate is given of a root.
    drives: Union[DriveSolutionRecord, None]
    #: The exact closure polynomial, with `--method trilateration`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: Counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: What was seen numerically.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves it for the lengths as written; false where they satisfy
    #: the relation within rounding only and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkOneAnswer(Record):
    """The poses with one set of lengths, and what was asked for besides."""

    #: The method that found them.
    method: Method
    #: Whether these are known to be all.
    completeness: CompletenessWord
    #: One sentence on what is known.
    completeness_reason: str
    #: False: roots may be missing.
    all_paths_accounted: bool
    #: The number of `solutions`.
    finite_count: int
    #: The same, each pose counted as often as it stands for.
    finite_count_with_multiplicity: int
    #: Real poses among them.
    real_count: int
    #: Poses of which it is not decided whether they are real.
    undecided_count: int
    #: Finite poses, multiplicity included, that are not among the certified ones; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses, by theorem or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: Real ones first.
    solutions: tuple[SolutionRecord, ...]
    #: The paths of the homotopy.
    paths: tuple[PathRecord, ...]
    #: Candidates that are no roots.
    rejected: tuple[RejectedRecord, ...]
    #: Ends of paths without a certificate, near which there may be one pose, several or none: they are not
    #: among the solutions.
    unproved: tuple[SolutionRecord, ...]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The numbers of the proof that all poses up to a distance are listed, where it is one.
    bounded: Union[BoundedProof, None]
    #: What libraries of linear algebra computed for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: What null stands for, where a number is not finite.
    notes: Union[tuple[str, ...], None]
    #: The angles of the cranks, where these were given; the legs are then the rods from the tips of the
    #: cranks, as doubles, to the platform, and certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all angles given are within their limits, the ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: The legs whose cranks are beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Where tips and platform joints have the symmetry of three turns, to rounding, and rods are equally
    #: long: how many finite poses the exactly symmetric platform has, by a theorem. Further poses of the
    #: tips as doubles are so far out that their rounding decides whether there are any.
    symmetric_finite: Union[int, None]
    #: How the pose was followed, with `--near`.
    near: Union[NearRecord, None]
    #: What the corrections of joints that are not ideal came to; the lengths are then those of drives, and
    #: no certificate is given of a root.
    drives: Union[DriveSolutionRecord, None]
    #: The exact closure polynomial, with `--method trilateration`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: Counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: What was seen numerically.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves it for the lengths as written; false where they satisfy
    #: the relation within rounding only and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkRowRecord(Record):
    """One row of a file of lengths."""

    #: The line of the CSV file, from 1.
    line: int
    #: The six lengths, design units; those of the rods where angles of cranks were given.
    lengths: tuple[float, ...]
    #: The time of the row, where the file has a column of times.
    time: Union[float, None]
    #: The angles of the cranks, where these were given.
    angles_deg: Union[tuple[float, ...], None]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The method that found them.
    method: Union[Method, None]
    #: Whether these are known to be all.
    completeness: Union[CompletenessWord, None]
    #: One sentence on what is known.
    completeness_reason: Union[str, None]
    #: The numbers of the proof that all poses up to a distance are listed, where it is one.
    bounded: Union[BoundedProof, None]
    #: False: roots may be missing.
    all_paths_accounted: Union[bool, None]
    #: The number of `solutions`.
    finite_count: Union[int, None]
    #: The same, each pose counted as often as it stands for.
    finite_count_with_multiplicity: Union[int, None]
    #: Real poses among them.
    real_count: Union[int, None]
    #: Poses of which it is not decided whether they are real.
    undecided_count: Union[int, None]
    #: Finite poses, multiplicity included, that are not among the certified ones; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses, by theorem or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: Real ones first.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: The paths of the homotopy.
    paths: Union[tuple[PathRecord, ...], None]
    #: Candidates that are no roots.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Ends of paths without a certificate, near which there may be one pose, several or none: they are not
    #: among the solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: What libraries of linear algebra computed for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: What null stands for, where a number is not finite.
    notes: Union[tuple[str, ...], None]
    #: Whether all angles given are within their limits, the ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: The legs whose cranks are beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Where tips and platform joints have the symmetry of three turns, to rounding, and rods are equally
    #: long: how many finite poses the exactly symmetric platform has, by a theorem. Further poses of the
    #: tips as doubles are so far out that their rounding decides whether there are any.
    symmetric_finite: Union[int, None]
    #: How the pose was followed, with `--near`.
    near: Union[NearRecord, None]
    #: What the corrections of joints that are not ideal came to; the lengths are then those of drives, and
    #: no certificate is given of a root.
    drives: Union[DriveSolutionRecord, None]
    #: The exact closure polynomial, with `--method trilateration`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: Counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: What was seen numerically.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves it for the lengths as written; false where they satisfy
    #: the relation within rounding only and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]
    #: The failure, as the command would have reported it for this row alone.
    error: Union[FailureRecord, None]


class FkRowsAnswer(Record):
    """The poses with the lengths of each row of a file."""

    #: The convention of `in_frames`.
    frames: PoseConventionRecord
    #: In the order of the file.
    rows: tuple[FkRowRecord, ...]


class FrameMotionRecord(Record):
    """The rigid motion with which measured joints are nearest to those of the design: a point x of the measurements is at R x + p."""

    #: The motion.
    motion: PoseRecord
    #: Root mean square of the distances that remain, design units.
    rms: Union[float, None]


class FrameMotionsRecord(Record):
    """Two rigid motions."""

    #: Of the base.
    base: FrameMotionRecord
    #: Of the platform.
    platform: FrameMotionRecord


class FreeRangeRecord(Record):
    """How far one of the six numbers of a pose may move."""

    #: Which number: `x`, `y`, `z`, and `roll`, `pitch`, `yaw` or the angles of another order.
    axis: str
    #: `deg` or `rad`, or the unit of length.
    unit: str
    #: At the pose.
    value: float
    #: Towards smaller values.
    back: TravelRecord
    #: Towards greater ones.
    forth: TravelRecord


class FreeSizeRecord(Record):
    """Up to which size a region around home is free."""

    #: Proved: all poses of the region of this size meet all requirements that depend on the pose, and none
    #: is singular; 0: nothing is proved.
    proved: float
    #: No violation was found in regions up to this size.
    searched: float
    #: What is violated in a region that is larger by a little; null: nothing that was looked at.
    binds: Union[LimitRecord, None]


class FreeTurnRecord(Record):
    """How far the platform may turn about an axis."""

    #: `x`, `y` or `z` of the base frame.
    axis: str
    #: Against the axis, degrees, positive.
    back_deg: float
    #: What binds there; null: nothing within half a turn.
    back_binds: Union[LimitRecord, None]
    #: About the axis, degrees.
    forth_deg: float
    #: What binds there; null: nothing within half a turn.
    forth_binds: Union[LimitRecord, None]


class FreedomRecord(Record):
    """A freedom that the design does not have, and what came of the search with it."""

    #: Which.
    freedom: Freedom
    #: What came of it.
    outcome: FreedomWord
    #: By how much the limit gave way in the last search, or by how much the platform found is higher;
    #: null: no such number.
    amount: Union[float, None]
    #: Of the amount.
    unit: str
    #: One sentence.
    message: str
    #: What `assess` says of the platform found; null: none was.
    assessment: Union[AssessAnswer, None]
    #: The platform found, with the limit that gave way; null: none was.
    design: Union[Design, None]
    #: The file it was written to.
    output: Union[str, None]


class FrontMemberRecord(Record):
    """A member of a front."""

    #: Value of the first objective.
    objective: Union[float, None]
    #: All of them.
    objectives: Union[tuple[ObjectiveRecord, ...], None]
    #: What was chosen, axes left out.
    variables: Union[tuple[VariableRecord, ...], None]
    #: The numbers `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: `t_i d_i`, design units; null as `edge_lengths`.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: `d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    edge_lengths: Union[tuple[Union[float, None], ...], None]
    #: The legs of the cycle, from 1; null: no offsets were chosen.
    cyclic_order: Union[tuple[int, ...], None]
    #: Zone of each offset: before, inside, beyond its edge; null: no offsets were chosen.
    branch: Union[str, None]
    #: det A of the leg map; null: the variables do not keep the class of the design.
    det: Union[float, None]
    #: s' = A s + c, legs in the order of the design; rows. Null as `det`.
    A: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: The constant terms, design units squared; null as `det`.
    c: Union[tuple[Union[float, None], ...], None]
    #: Home, lifted when its height was chosen.
    home: Union[PoseQuaternionRecord, None]
    #: The axes chosen.
    joint_axes: Union[JointAxesRecord, None]
    #: The requirements, over many poses and by other code.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: By how much what the search demands besides them is met.
    search_margins: Union[SearchMarginsRecord, None]
    #: What the platform rides on: ends of ranges and limits of which nothing is left, and how its bodies
    #: have grown; null: nothing.
    riding: Union[RidingRecord, None]
    #: Whether the platform meets its requirements, proved by the assessment; null: not all is proved.
    requirements_met: Union[bool, None]
    #: What `assess` says of the platform; null: the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: Whether it is equivalent to the design; null: the variables do not keep the class.
    verify: Union[VerifiedRecord, None]
    #: Where the first objective is reached among the poses held; null: it is not the worst conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the run that found it; null in a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design.
    design: Design
    #: The file written.
    output: Union[str, None]
    #: The objectives in the evaluation that compared the members.
    non_dominated_at: tuple[Union[float, None], ...]


class GiveRecord(Record):
    """A requirement of a conflict."""

    #: Which.
    name: DemandWord
    #: In which it gives.
    unit: str
    #: By how much it would have to give alone; null: cannot make room.
    alone: Union[float, None]
    #: Its violation where the sum of all, each in its scale, is least.
    together: Union[float, None]
    #: One sentence.
    message: str


class GlobalBoundRecord(Record):
    """What no offsets can exceed."""

    #: No offsets within the limits reach more.
    upper: Union[float, None]
    #: By how much that is above the solution, relative.
    gap: Union[float, None]
    #: Boxes of offsets that were looked at.
    boxes: int


class GreatestErrorRecord(Record):
    """The greatest error over the poses of a map."""

    #: By all causes.
    greatest: Union[float, None]
    #: By joints alone, at the same pose.
    joints: Union[float, None]
    #: By leg lengths alone.
    lengths: Union[float, None]
    #: By growth alone.
    growth: Union[float, None]
    #: The pose.
    pose: PoseQuaternionRecord
    #: Half of the poses have at most this by all causes.
    median: Union[float, None]


class GreatestResidualRecord(Record):
    """The largest residual."""

    #: Line of the table of measurements.
    line: int
    #: From 1.
    leg: int
    #: Length measured less that of the model.
    value: Union[float, None]


class GridRecord(Record):
    """A grid of holes in the plane of a body."""

    #: How the holes lie.
    pattern: HolePattern
    #: Distance of neighbouring holes, or of the rings of a polar grid; null for bolt circles.
    pitch: Union[float, None]
    #: The first ring of a polar grid, or all bolt circles; empty for the other patterns.
    circles: tuple[HoleCircleRecord, ...]
    #: A hole, or the centre of the circles.
    origin: tuple[Union[float, None], ...]
    #: The turn of the grid.
    angle_deg: Union[float, None]


class GridsRecord(Record):
    """The grids of both bodies."""

    #: Of the base; null: its joints stay where they are.
    base: Union[GridRecord, None]
    #: Of the platform; null: its joints stay where they are.
    platform: Union[GridRecord, None]


class GriffisDuffyRecord(Record):
    """Joints on the sides of two triangles."""

    #: The legs going round the hexagon, from 1.
    order: tuple[int, ...]
    #: Where each joint lies on its side, from 0 to 1.
    t: tuple[Union[float, None], ...]
    #: Lengths of the sides, design units.
    side_lengths: tuple[Union[float, None], ...]
    #: prod (1 - t) - prod t: singular where it is zero.
    det: Union[float, None]
    #: It is zero, exactly.
    exactly_singular: bool
    #: How far joints are off their sides, relative.
    deviation: Union[float, None]
    #: Up to which deviation the type is recognised.
    deviation_limit: Union[float, None]
    #: The dependency of the legs where `det` is zero.
    coefficients: tuple[Union[float, None], ...]
    #: `sum c_i s_i` of the squared lengths of every pose.
    constant: Union[float, None]
    #: By how much the lengths of the design miss the constant, relative; null without lengths.
    lengths_defect: Union[float, None]
    #: Whether the platform can be assembled with the lengths of the design.
    assembly: Union[AssemblyRecord, None]


class HeldLineRecord(Record):
    """A line of a body that five legs hold."""

    #: The body.
    body: Body
    #: Where the joint of each leg is on the line, from that of leg 1, in units of `length`.
    marks: tuple[Union[float, None], ...]
    #: From the joint of leg 1 to the one farthest from it, design units.
    length: Union[float, None]
    #: By which equation the line is found; null where the legs are dependent.
    class_: Union[LineClass, None]
    #: Poses of the line, real and complex, for generic lengths; null where they were not counted.
    generic_poses: Union[int, None]
    #: The poses of the line that are singular.
    singular_poses: LineLocusRecord


class HeldPosesRecord(Record):
    """Numbers of poses."""

    #: Where the search held the requirements.
    held: int
    #: Of the dense evaluation.
    checked: int


class HoleCircleRecord(Record):
    """Holes on a circle, equally spaced."""

    #: The radius.
    radius: Union[float, None]
    #: The number of holes.
    holes: int


class InstanceRecord(Record):
    """The platform of a pattern at given offsets."""

    #: The pattern.
    pattern: str
    #: The offsets, fractions of the edges.
    offsets: tuple[Union[float, None], ...]
    #: Rows of A: s' = A s + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: det A.
    det: Union[float, None]
    #: Joints of the base.
    base_joints: int
    #: Joints of the platform.
    platform_joints: int


class JointAxesRecord(Record):
    """Axes of joints: unit vectors, frame of the body; null: not chosen."""

    #: Of the base ends of the legs.
    base: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Of their platform ends.
    platform: Union[tuple[tuple[Union[float, None], ...], ...], None]


class JointBudgetRecord(Record):
    """How far one joint may be off while the others are where they should be."""

    #: Its body.
    body: Body
    #: Its name.
    joint: str
    #: In any direction.
    alone: JointLimitRecord
    #: The worst direction, frame of the body.
    direction: tuple[Union[float, None], ...]
    #: Error of the tool point for each unit of error in the worst direction.
    position_per_unit: Union[float, None]
    #: Error of the orientation for each unit of error in the worst direction.
    rotation_deg_per_unit: Union[float, None]
    #: Along x, y and z of the body; null: no influence.
    along_axes: tuple[Union[float, None], ...]
    #: Half widths of the box of largest volume for all joints together; null: no influence.
    largest_product: tuple[Union[float, None], ...]


class JointLimitRecord(Record):
    """How far joints may be off."""

    #: Keeps the bound to first order, design units.
    value: Union[float, None]
    #: Uses the bound up to first order.
    reached: Union[float, None]
    #: Which bound it is.
    limited_by: ErrorKind
    #: The pose at which it is.
    pose: PoseQuaternionRecord


class JointShiftRecord(Record):
    """How a joint moves."""

    #: Its body.
    body: Body
    #: Its name.
    joint: str
    #: The shift, frame of the body in which the poses were measured.
    shift: tuple[Union[float, None], ...]


class JointsRecord(Record):
    """How exactly the joints of a design are known, all together."""

    #: The least exact of the joints decides.
    exactness: ExactnessWord
    #: The integers whose square roots generate the field of the exact coordinates, beside the cosines of
    #: `divisions`; empty for fractions.
    radicands: tuple[int, ...]
    #: Numbers `n` whose cosines `cos(360 / n)` degrees belong to the generators: some of 9, 16, 20 and 32.
    divisions: tuple[int, ...]
    #: Joints known between bounds only, with their bodies: `base.A2`.
    enclosed: tuple[str, ...]
    #: The same in words.
    explanation: str


class JudgedPoseRecord(Record):
    """A pose with figures of its Jacobian."""

    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: det J of the leg lines, over the size to the sixth.
    determinant: Union[float, None]
    #: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: The two conditions of four planes in one point, of octahedral designs.
    four_planes: Union[tuple[Union[float, None], ...], None]


class JudgedPosesRecord(Record):
    """The poses that a judgement is about, with home."""

    #: The design states a workspace; else home alone is judged.
    stated: bool
    #: Every pose of a region about home is judged.
    region: bool
    #: Single poses; nothing is said between them.
    listed: int
    #: Poses of a trajectory, with the straight motions between them.
    trajectory: int
    #: The verdict of requirements that are met at these poses, in a few words.
    met_in_words: str


class JudgementRecord(Record):
    """How good a design is."""

    #: The worst inverse condition number over the poses.
    objective: Union[float, None]
    #: Where it is.
    worst_pose: PoseQuaternionRecord
    #: Least distances of two joints, base and platform.
    least_distances: tuple[Union[float, None], ...]
    #: det A; null: there is no leg map.
    det: Union[float, None]
    #: The least margin of each requirement.
    requirements: tuple[RequirementMarginRecord, ...]
    #: No requirement is violated.
    met: bool
    #: Every margin keeps its reserve too.
    reserve_kept: bool


class LeastConditioningRecord(Record):
    """The worst conditioned pose."""

    #: Smallest over largest singular value of the Jacobian with unit lines and moments over the
    #: characteristic length: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: Where.
    pose: PoseQuaternionRecord
    #: Design units.
    characteristic_length: float


class LegMotionRecord(Record):
    """A leg along a motion."""

    #: From 1.
    leg: int
    #: Least length.
    shortest: ExtremeRecord
    #: Greatest length.
    longest: ExtremeRecord
    #: Speed of the greatest size, positive where the leg becomes longer.
    speed: ExtremeRecord
    #: Acceleration of the greatest size.
    acceleration: ExtremeRecord
    #: Hardest push of the drive, 0 where it only pulls; null: no masses are known, or forces are not
    #: determined.
    push: Union[ExtremeRecord, None]
    #: Hardest pull, negative, 0 where it only pushes.
    pull: Union[ExtremeRecord, None]
    #: Root of the mean square of the force over time, force units.
    rms_force: Union[float, None]
    #: Power of the greatest size, watts; negative where the drive brakes.
    power_w: Union[ExtremeRecord, None]


class LegSlideRecord(Record):
    """One leg that moves along the line of two legs with a joint in common: X, Y, Q and F are in one plane at every pose."""

    #: The leg that moves, from 1.
    leg: int
    #: The legs X F and Y F, from 1.
    between: tuple[int, ...]
    #: The names of X and Y.
    ends: tuple[str, ...]
    #: The name of Q = X + t (Y - X), the joint that the leg gets.
    moved: str
    #: The name of F, the joint that it keeps.
    fixed: str
    #: t: s' = (1 - t) s(X F) + t s(Y F) - t (1 - t) d^2.
    share: ExactNumberRecord
    #: 1 - t.
    rest: ExactNumberRecord
    #: d^2 = |XY|^2, design units squared.
    square: ExactNumberRecord
    #: |XQ|^2 and |YQ|^2, design units squared.
    squares_to_ends: tuple[ExactNumberRecord, ...]
    #: The entry of c: -t (1 - t) d^2, design units squared.
    constant: ExactNumberRecord


class LibraryCallsRecord(Record):
    """A library of linear algebra computed this for an answer."""

    #: The library.
    library: str
    #: The computation: `plu`, a triangular factor with partial pivoting, or `qz`, generalised
    #: eigenvectors.
    computation: str
    #: Rows and columns of the matrix.
    size: tuple[int, ...]
    #: How often.
    calls: int


class LightestDriveRecord(Record):
    """The lightest drive of the table that a design names with which its requirements are met."""

    #: Its name; null: none is proved to suffice.
    name: Union[str, None]
    #: Its mass; null: the table has none, or there is no such drive.
    mass: Union[float, None]
    #: Of the mass.
    mass_unit: str
    #: Drives that are lighter, or all where none is proved to suffice, of which neither is proved.
    undecided: tuple[str, ...]
    #: One sentence.
    message: str


class LimitRecord(Record):
    """A requirement that binds or is violated."""

    #: The kind; null: a singular pose, where det J vanishes.
    name: Union[TermKind, None]
    #: By how much it is met, a violation below 0; of a singular pose det J over that at home.
    margin: Union[float, None]
    #: Of the margin; null: a share.
    unit: Union[str, None]
    #: Legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: The legs among them, from 1.
    legs: tuple[int, ...]


class LimitsAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The convention in which poses were read, of `in_frames` and of `axes`.
    frames: PoseConventionRecord
    #: The pose of `--at`.
    pose: PoseQuaternionRecord
    #: The same in the convention of `frames`.
    in_frames: PoseInFrames
    #: Every requirement is met there, and det J has the sign that it has at home.
    allowed: bool
    #: What is violated there, the worst first.
    violated: tuple[LimitRecord, ...]
    #: x, y, z and the three angles of `frames`, or turns about x, y and z for rotation vectors: how far
    #: each may move while the others stay; nothing where the pose is not allowed.
    axes: tuple[FreeRangeRecord, ...]
    #: The straight way to the pose of `--to`; null: none was asked for, or it begins at a pose that is not
    #: allowed.
    way: Union[StraightWayRecord, None]
    #: The allowed pose nearest to that of `--to`, or to that of `--at` where it is not allowed; null: all
    #: that was asked for is allowed, or no allowed pose was found.
    nearest_allowed: Union[NearestAllowedRecord, None]
    #: How large the workspace is around home; null: `--workspace` was not given, or home is not allowed.
    workspace: Union[WorkspaceSizeRecord, None]
    #: The surface that was written; null: none was asked for, or the pose of `--at` is not allowed.
    surface: Union[str, None]
    #: Of lengths.
    length_unit: str
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class LineLocusRecord(Record):
    """The polynomial `F(p, v)` whose zeros are the singular poses of the line."""

    #: `architecturally singular`, `quadratic in all`, `linear in the position`, `linear in the direction`,
    #: or `cubic`.
    family: str
    #: Its degree.
    degree: int
    #: Its degree in the position.
    degree_in_position: int
    #: Its degree in the direction.
    degree_in_direction: int
    #: Its terms. The position is that of the joint of leg 1 in the frame of the other body, and the
    #: direction is a vector as long as `length`.
    terms: tuple[LineTermRecord, ...]


class LinePoseRecord(Record):
    """A pose of a line in the frame of the other body."""

    #: The joint of leg 1, design units.
    position: ComplexRecord
    #: The unit vector from the joint of leg 1 towards the one farthest from it.
    direction: ComplexRecord
    #: Whether it is real: decided exactly.
    real: bool
    #: How often it counts.
    multiplicity: int
    #: No coordinate of the position is farther from the true one.
    position_error: Union[float, None]
    #: No coordinate of the direction is farther from the true one.
    direction_error: Union[float, None]


class LinePosesRecord(Record):
    """All poses of a line for given lengths."""

    #: How many there are, real and complex, each as often as its multiplicity says: proved in exact
    #: arithmetic.
    counted: int
    #: How many of them are real.
    real: int
    #: The coefficients of the polynomial that gives them, as decimal text, the constant one first.
    coefficients: tuple[str, ...]
    #: The poses, the real ones first.
    poses: tuple[LinePoseRecord, ...]


class LineTermRecord(Record):
    """A term of a polynomial in the position and the direction of a line."""

    #: Exponents of `p_x, p_y, p_z, v_x, v_y, v_z`.
    exponents: tuple[int, ...]
    #: The coefficient, an integer as decimal text.
    coefficient: str


class LocalOptimalityRecord(Record):
    """Evidence of local optimality."""

    #: The model of the last step promised no further gain.
    converged: bool
    #: Gain still promised for a unit of the variables.
    stationarity: Union[float, None]
    #: Gained by a pattern search from there; null: none was made.
    pattern_gain: Union[float, None]
    #: Points it tried.
    pattern_trials: Union[int, None]


class LossRecord(Record):
    """How much far measurements cost."""

    #: The loss.
    loss: Loss
    #: What is doubted together.
    of: LossUnit


class MapAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: What the designs have to do with each other; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: What the relation is proved about; within rounding: nothing is proved.
    level: Level
    #: It holds within rounding of the joints, or exactly.
    holds_within_rounding: bool
    #: One sentence with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: The determinant as an exact number, such as 64/243, where the identity of leg vectors holds in exact
    #: arithmetic; null elsewhere, and for numbers too long to be read.
    det_exact: Union[str, None]
    #: Rows of A as exact numbers; null where `det_exact` is.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: The constant terms as exact numbers; null where `det_exact` is.
    c_exact: Union[tuple[str, ...], None]
    #: For each leg of TO whose row of A is 1 - t and t beside zeros (its ends on edges of FROM at the
    #: share t), the t at which det A vanishes while the other legs stay, as an exact number; null for
    #: other legs and where there is none; null as a whole where `det_exact` is.
    singular_shares: Union[tuple[Union[str, None], ...], None]
    #: det A as a polynomial with exact coefficients in the shares t1 to t6 of all such legs at once, the
    #: other legs as they stand: TO is singular where it is zero, and only there; null where there is no
    #: such leg, and where `det_exact` is.
    det_of_shares: Union[str, None]
    #: The largest of the residuals.
    residual: Union[float, None]
    #: Relative distance of each leg of TO from the span of the legs of FROM.
    residuals: tuple[Union[float, None], ...]
    #: Rank of the leg vectors of FROM.
    leg_rank: int
    #: Singular values of the normalised leg vectors of FROM.
    singular_values: tuple[Union[float, None], ...]
    #: Smallest over largest singular value of A.
    inverse_condition: Union[float, None]
    #: What the numbers were compared with.
    tolerances: MapTolerancesRecord
    #: Which leg is which.
    correspondence: CorrespondenceRecord
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: Leg lengths taken from one design to the other, with `--lengths`.
    lengths: Union[MappedLengthsRecord, None]
    #: Base and platform of the second design were exchanged first.
    exchanged: Union[bool, None]
    #: The rigid motions that make the second design equivalent to the first, with `--align`.
    alignment: Union[AlignmentRecord, None]
    #: The file written.
    output: Union[str, None]


class MapRecord(Record):
    """The affine map s(TO) = A s(FROM) + c between the squared leg lengths of two designs."""

    #: What the designs have to do with each other; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: What the relation is proved about; within rounding: nothing is proved.
    level: Level
    #: It holds within rounding of the joints, or exactly.
    holds_within_rounding: bool
    #: One sentence with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: The determinant as an exact number, such as 64/243, where the identity of leg vectors holds in exact
    #: arithmetic; null elsewhere, and for numbers too long to be read.
    det_exact: Union[str, None]
    #: Rows of A as exact numbers; null where `det_exact` is.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: The constant terms as exact numbers; null where `det_exact` is.
    c_exact: Union[tuple[str, ...], None]
    #: For each leg of TO whose row of A is 1 - t and t beside zeros (its ends on edges of FROM at the
    #: share t), the t at which det A vanishes while the other legs stay, as an exact number; null for
    #: other legs and where there is none; null as a whole where `det_exact` is.
    singular_shares: Union[tuple[Union[str, None], ...], None]
    #: det A as a polynomial with exact coefficients in the shares t1 to t6 of all such legs at once, the
    #: other legs as they stand: TO is singular where it is zero, and only there; null where there is no
    #: such leg, and where `det_exact` is.
    det_of_shares: Union[str, None]
    #: The largest of the residuals.
    residual: Union[float, None]
    #: Relative distance of each leg of TO from the span of the legs of FROM.
    residuals: tuple[Union[float, None], ...]
    #: Rank of the leg vectors of FROM.
    leg_rank: int
    #: Singular values of the normalised leg vectors of FROM.
    singular_values: tuple[Union[float, None], ...]
    #: Smallest over largest singular value of A.
    inverse_condition: Union[float, None]
    #: What the numbers were compared with.
    tolerances: MapTolerancesRecord


class MapTolerancesRecord(Record):
    """Limits of the decision about a map."""

    #: Of `residual`.
    residual: float
    #: Of the singular values, relative to the largest.
    rank: float
    #: Of `inverse_condition`.
    inverse_condition: float


class MappedLengthsRecord(Record):
    """Lengths of the legs of both designs at the same poses, as the legs show them, design units."""

    #: Of FROM, as given.
    from_: tuple[Union[float, None], ...]
    #: Of TO; null: there are none.
    to: Union[tuple[Union[float, None], ...], None]
    #: Why there are none: no regular map, or a squared length that is not positive.
    why_not: Union[str, None]


class MarginRecord(Record):
    """The least margin of a kind of requirement."""

    #: The kind.
    name: TermKind
    #: Least over the poses looked at; a violation below 0.
    margin: Union[float, None]
    #: What has to remain of the limit, in the unit of the margin; 0: no reserve is asked for.
    reserve: Union[float, None]
    #: The margin less the reserve.
    margin_with_reserve: Union[float, None]
    #: The reserve is kept: proved in `assess` (null where it is not), at the poses looked at elsewhere.
    reserve_kept: Union[bool, None]
    #: Not violated by more than rounding: proved in `assess` (null where it is not), at the poses looked
    #: at elsewhere.
    met: Union[bool, None]
    #: Rounding does not tell the margin from 0.
    at_limit: bool
    #: What is known of it.
    status: MarginVerdict
    #: No pose of the workspace has a smaller margin; null where nothing is proved.
    proved_margin: Union[float, None]
    #: Of the margins.
    unit: str
    #: Legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: The legs among them, from 1; those of a joint where the requirement is about joints.
    legs: tuple[int, ...]
    #: Where it is least; null where the pose has no influence.
    pose: Union[PoseQuaternionRecord, None]


class MotionAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The convention in which poses of options were read, and of the table of instants; a table of poses
    #: may say more in the names of its columns.
    frames: PoseConventionRecord
    #: No requirement is violated at the instants looked at, and no pose of the motions is singular.
    met: bool
    #: Of lengths; speeds are in it per second, accelerations per second squared.
    length_unit: str
    #: Of forces.
    force_unit: str
    #: What the file does not say and was taken instead, a sentence each.
    assumptions: tuple[str, ...]
    #: In the order asked for: the trajectory, sines, accelerations.
    motions: tuple[MotionRunRecord, ...]
    #: How stiff the platform is at the pose of `--about`; null: it was not asked for.
    stiffness: Union[StiffnessRecord, None]
    #: The table of instants that was written; null: none.
    csv: Union[str, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class MotionRecord(Record):
    """A pair of rigid motions of the second design."""

    #: Of its base.
    base: PoseRecord
    #: Of its platform.
    platform: PoseRecord
    #: The residual of the map to the moved design.
    residual: Union[float, None]
    #: The determinant of that map.
    det: Union[float, None]
    #: What the moved design has to do with the first; null: undecided.
    relation: Union[Relation, None]


class MotionRunRecord(Record):
    """The legs along a motion."""

    #: The file of the trajectory, or the manoeuvre as it was asked for.
    motion: str
    #: Instants looked at.
    instants: int
    #: From the first to the last of them.
    duration_s: float
    #: As in the answer, of this motion.
    met: bool
    #: By leg; empty where a leg has no length at some instant, and where the legs are rods on cranks.
    legs: tuple[LegMotionRecord, ...]
    #: The least margin of each kind of requirement, force and speed by this motion.
    requirements: tuple[TimedMarginRecord, ...]
    #: Whether every pose of the motion is regular.
    regularity: MotionRegularity
    #: When the first singular pose is passed; null: none was found.
    singular_at_s: Union[float, None]
    #: That pose.
    singular_pose: Union[PoseQuaternionRecord, None]
    #: What shows that it is singular.
    singular_evidence: Union[SingularEvidenceWord, None]
    #: By leg, where the legs are rods on cranks; empty where a rod does not reach at some instant.
    cranks: Union[tuple[CrankMotionRecord, ...], None]
    #: When a rod first does not reach from its crank to the platform, where one does not.
    unreached_at_s: Union[float, None]


class MovesFoundRecord(Record):
    """A search for equivalent platforms in short."""

    #: What came out.
    outcome: SearchWord
    #: Legs of the platform written that are not legs of the design, from 1; null: none is written.
    moved_legs: Union[tuple[int, ...], None]
    #: det A of the map to it; null: none is written.
    det: Union[float, None]


class NaturalMotionRecord(Record):
    """A natural motion."""

    #: Its frequency.
    frequency_hz: Union[float, None]
    #: Its shape: shift of the platform origin in design units and rotation vector in radians, base frame,
    #: for which `v^T M v` is 1 in kilograms and design units.
    shape: tuple[Union[float, None], ...]


class NearRecord(Record):
    """The way from the start to the pose reached, with the numbers that prove it free of singularities."""

    #: What came of it.
    outcome: NearWord
    #: Why it was lost.
    reason: Union[str, None]
    #: The pose at the beginning.
    start: PoseRecord
    #: The pose at the end.
    reached: PoseRecord
    #: How far on the straight line of squared lengths; 1 at its end.
    fraction: float
    #: Largest error of the leg equations over the squared size.
    residual: Union[float, None]
    #: Of the Jacobian at the pose reached, as in `assess`: 1 at best, 0 at a singularity.
    inverse_condition: Union[float, None]
    #: Segments the line was divided into.
    segments: int
    #: Newton steps in all.
    newton_steps: int
    #: The largest Kantorovich number; below 1 every segment is free of singularities.
    kantorovich: Union[float, None]
    #: How far the centroid of the platform moved, design units.
    distance: Union[float, None]
    #: The angle the platform turned by.
    angle_deg: Union[float, None]
    #: How uncertain the pose reached is, where the design has standard deviations of a calibration and
    #: joints are ideal.
    uncertainty: Union[PoseUncertaintyRecord, None]


class NearestAllowedRecord(Record):
    """An allowed pose near one that is not."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: Its position, design units.
    position: tuple[float, ...]
    #: Its roll, pitch and yaw.
    rpy_deg: tuple[float, ...]
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Distance from the pose asked for, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    distance: float
    #: The `L` of the distance, design units a radian.
    characteristic_length: float
    #: What keeps it from being nearer.
    binds: tuple[LimitRecord, ...]
    #: Whether no small step leads nearer, as far as margins are smooth: then it is locally nearest. False:
    #: the search ended before that was so.
    stationary: bool
    #: Whether the straight way from home to it violates nothing.
    straight_from_home: bool


class NearestErrorRecord(Record):
    """The nearest octahedral platform in short."""

    #: The largest displacement of a leg end, design units.
    largest_displacement: Union[float, None]
    #: The same over the size of the design.
    relative_displacement: Union[float, None]
    #: The largest difference of leg lengths over the poses of the workspace.
    largest_length_deviation: Union[float, None]
    #: det A of the map from the octahedral platform to the one beside the design.
    det: Union[float, None]


class NearestMotionRecord(Record):
    """The pair of rigid motions that comes nearest."""

    #: Of the base of the second design.
    base: PoseRecord
    #: Of its platform.
    platform: PoseRecord
    #: The residual it leaves.
    residual: Union[float, None]


class NearestPlatformRecord(Record):
    """The platform that comes nearest to its requirements."""

    #: What was chosen, axes left out.
    variables: tuple[VariableRecord, ...]
    #: The requirements, over many poses and by other code.
    constraint_margins: tuple[MarginRecord, ...]
    #: What `assess` says of it; null: the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design


class NearestRoundingOutcome(Record):
    """The nearest rounding, or why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: What leg map and forward kinematics say of it and the wanted design.
    verdict: Union[RoundingVerdict, None]
    #: The residual of the leg map; null where it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: How good it is.
    judgement: Union[JudgementRecord, None]
    #: The error of the pose by the formula of the wanted design.
    pose_error: Union[RoundingErrorRecord, None]
    #: Joints that are not on the nearest hole.
    not_nearest: Union[int, None]
    #: Turns by 120 degrees take the joints of both bodies to themselves.
    three_fold: Union[bool, None]
    #: What stands against it.
    error: Union[NoRoundingError, None]


class NearestRoundingRecord(Record):
    """All joints on holes next to where they are wanted."""

    #: The grids used.
    grids: GridsRecord
    #: What leg map and forward kinematics say of it and the wanted design.
    verdict: RoundingVerdict
    #: The residual of the leg map; null where it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: How good it is.
    judgement: JudgementRecord
    #: The error of the pose by the formula of the wanted design.
    pose_error: RoundingErrorRecord
    #: Joints that are not on the nearest hole.
    not_nearest: int
    #: Turns by 120 degrees take the joints of both bodies to themselves.
    three_fold: bool


class NearestSingularRecord(Record):
    """The nearest singular design that was found."""

    #: Norm of the change of all joints, design units.
    distance: Union[float, None]
    #: The distance found is an upper bound of the least one.
    bound: Literal["upper"]
    #: No singular design is nearer.
    distance_at_least: Union[float, None]
    #: What becomes singular.
    kind: str
    #: The legs in it, from 1.
    legs: tuple[int, ...]
    #: The dependency of their leg vectors.
    coefficients: Union[tuple[Union[float, None], ...], None]
    #: What is left of the dependency.
    residual: Union[float, None]
    #: Rounding of the file may be the only difference.
    within_rounding: bool
    #: Half a unit of the last digit given, design units, where no coordinate differs by more; null
    #: otherwise.
    within_digits: Union[float, None]
    #: Its base joints by name, base frame.
    base: dict[str, tuple[Union[float, None], ...]]
    #: Its platform joints by name, platform frame.
    platform: dict[str, tuple[Union[float, None], ...]]


class NextPoseRecord(Record):
    """A pose to measure next."""

    #: The pose, in the frames of the design where joints are carried to them, else in those of the
    #: measurements.
    pose: PoseQuaternionRecord
    #: Roll, pitch and yaw of it, degrees.
    rpy_deg: tuple[Union[float, None], ...]
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: By what factor the geometric mean of the deviations along the axes of the error ellipsoid becomes
    #: smaller with it.
    shrinks: Union[float, None]
    #: The greatest standard deviation of a coordinate or offset after it and those before it, design
    #: units.
    greatest_deviation: Union[float, None]


class NoRoundingError(Record):
    """What stands against a rounding."""

    #: A short code.
    code: NoRoundingWord
    #: One sentence.
    message: str


class NoRoundingRecord(Record):
    """Why there is no rounding."""

    #: What stands against it.
    error: NoRoundingError


class NoiseRecord(Record):
    """Standard deviations of measurements."""

    #: Where they come from.
    source: NoiseSource
    #: Of a length, design units.
    length: Union[float, None]
    #: Of each coordinate of the platform origin, design units.
    position: Union[float, None]
    #: Of each component of the rotation vector, degrees.
    rotation_deg: Union[float, None]


class ObjectiveRecord(Record):
    """An objective and its value."""

    #: Which.
    name: Objective
    #: By the dense evaluation.
    value: Union[float, None]
    #: Over the poses at which the search held the requirements.
    at_held_poses: Union[float, None]
    #: Empty for a pure number.
    unit: str


class ObservabilityRecord(Record):
    """Which changes of the machine the measurements see, and how well."""

    #: Directions identified.
    rank: int
    #: Of the identification matrix, whitened and multiplied by the deviation of a length; largest first,
    #: without unit.
    singular_values: tuple[Union[float, None], ...]
    #: Smaller values are directions that are not identified.
    tolerance: Union[float, None]
    #: `(s_1 .. s_m)^(1/m) / sqrt(n)` (Borm, Menq 1991).
    volume_index: Union[float, None]
    #: `s_m / s_1` (Driels, Pathre 1990).
    inverse_condition: Union[float, None]
    #: `s_m^2 / s_1` (Nahvi, Hollerbach 1996).
    noise_amplification: Union[float, None]
    #: `1 / (1/s_1 + .. + 1/s_m)` (Sun, Hollerbach 2008).
    harmonic_index: Union[float, None]
    #: Changes of the machine that are not identified, each of norm 1 over all unknowns.
    unobservable: tuple[UnobservableRecord, ...]


class OffsetProductsRecord(Record):
    """Products over the six offsets of the platform without shared joints."""

    #: The product of all `1 - t_i`.
    rest: ExactNumberRecord
    #: The product of all `t_i`.
    own: ExactNumberRecord


class OffsetShiftRecord(Record):
    """How an offset changes."""

    #: From 1.
    leg: int
    #: The change.
    change: Union[float, None]


class OnHolesRecord(Record):
    """A platform with its joints on the holes that its design states, in short."""

    #: Which rounding was taken; null: there is none.
    variant: Union[VariantWord, None]
    #: Turns by 120 degrees take both triangles with their joints to themselves.
    three_fold: bool
    #: The farthest that a joint went to its hole.
    largest_displacement: Union[float, None]
    #: Variables that were chosen again after rounding.
    refitted: tuple[str, ...]
    #: How often a platform was sought and rounded.
    passes: int
    #: Why there is no rounding; null: there is one.
    error: Union[NoRoundingError, None]


class OptimizeAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: What came of the search.
    status: OptimizeWord
    #: What is known of better ones; null: nothing, or there is no platform.
    optimality: Union[OptimalityWord, None]
    #: Value of the first objective.
    objective: Union[float, None]
    #: All of them.
    objectives: Union[tuple[ObjectiveRecord, ...], None]
    #: What was chosen, axes left out.
    variables: Union[tuple[VariableRecord, ...], None]
    #: The numbers `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: `t_i d_i`, design units; null as `edge_lengths`.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: `d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    edge_lengths: Union[tuple[Union[float, None], ...], None]
    #: The legs of the cycle, from 1; null: no offsets were chosen.
    cyclic_order: Union[tuple[int, ...], None]
    #: Zone of each offset: before, inside, beyond its edge; null: no offsets were chosen.
    branch: Union[str, None]
    #: det A of the leg map; null: the variables do not keep the class of the design.
    det: Union[float, None]
    #: s' = A s + c, legs in the order of the design; rows. Null as `det`.
    A: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: The constant terms, design units squared; null as `det`.
    c: Union[tuple[Union[float, None], ...], None]
    #: Home, lifted when its height was chosen.
    home: Union[PoseQuaternionRecord, None]
    #: The axes chosen.
    joint_axes: Union[JointAxesRecord, None]
    #: The requirements, over many poses and by other code.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: By how much what the search demands besides them is met.
    search_margins: Union[SearchMarginsRecord, None]
    #: What the platform rides on: ends of ranges and limits of which nothing is left, and how its bodies
    #: have grown; null: nothing.
    riding: Union[RidingRecord, None]
    #: Whether the platform meets its requirements, proved by the assessment; null: not all is proved.
    requirements_met: Union[bool, None]
    #: What `assess` says of the platform; null: the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: Whether it is equivalent to the design; null: the variables do not keep the class.
    verify: Union[VerifiedRecord, None]
    #: Where the first objective is reached among the poses held; null: it is not the worst conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the run that found it; null in a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design; null: there is none.
    design: Union[Design, None]
    #: The file written, with the platform or the one that comes nearest.
    output: Union[str, None]
    #: Where none that meets the requirements was found: the one with the least violation, which misses
    #: some of them.
    nearest: Union[NearestPlatformRecord, None]
    #: What cannot be met together, where that is why there is no platform.
    conflict: Union[ConflictRecord, None]
    #: Why the search failed to decide, a sentence; null: it decided, or nothing failed.
    failure: Union[str, None]
    #: Where nothing that meets the requirements was found: the freedoms that the design does not have,
    #: each with what came of a search that had it; null where none was looked at.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: What became of the three-fold symmetry of the design; null where it has none, names one, or the
    #: search could not break it or did not look at it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table, with what the search came to with each; null where no table was given. The
    #: rest of the answer is about the drive chosen; where none is, about that with which most was reached.
    drive_search: Union[DriveSearchRecord, None]
    #: Other local optima that meet the requirements at the poses that were held, best first; null where
    #: they were not asked for.
    candidates: Union[tuple[OptimumRecord, ...], None]
    #: With mode = "pareto": platforms of which none is better in every objective, by falling gain of the
    #: first objective; else null.
    front: Union[tuple[FrontMemberRecord, ...], None]
    #: Why the sizes of the bodies and the height of home are chosen, a sentence; null: the variables are
    #: those of the design, or the usual ones.
    choice: Union[str, None]
    #: What the search itself was held to.
    limits: SearchLimitsRecord
    #: The poses that were asked for.
    region: PoseRegionRecord
    #: How the search went.
    search: SearchRecord
    #: What no platform that could be chosen can exceed at the poses held; null: not proved, or there is no
    #: solution.
    global_bound: Union[GlobalBoundRecord, None]
    #: Greatest gap to that bound at which the answer counts as optimal; null: the search proves no bound.
    tolerance: Union[float, None]
    #: What became of the branches; null: the search has none.
    branch_counts: Union[BranchCountsRecord, None]
    #: The best other branches.
    runners_up: Union[tuple[BranchRecord, ...], None]
    #: All branches: a zone for each offset.
    branches: Union[tuple[BranchRecord, ...], None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class OptimizedRecord(Record):
    """The platform in short: the fields of the answer of `optimize` that say most."""

    #: What came of the search.
    status: OptimizeWord
    #: What is known of better ones; null: nothing.
    optimality: Union[OptimalityWord, None]
    #: Value of the first objective.
    objective: Union[float, None]
    #: What was chosen, axes left out.
    variables: tuple[VariableRecord, ...]
    #: The numbers `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: `t_i d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: det A of the leg map; null: the variables do not keep the class of the design.
    det: Union[float, None]
    #: What the platform rides on; null: nothing.
    riding: Union[RidingRecord, None]


class OptimumRecord(Record):
    """A local optimum beside the best one."""

    #: All objectives.
    objectives: tuple[ObjectiveRecord, ...]
    #: What was chosen, axes left out.
    variables: tuple[VariableRecord, ...]
    #: Whether the platform meets its requirements, proved by the assessment; null: not all is proved.
    requirements_met: Union[bool, None]
    #: What `assess` says of it; null: the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design
    #: The file it was written to.
    output: Union[str, None]


class OtherAlignmentRecord(Record):
    """What was found for the second design taken otherwise."""

    #: Whether there are motions.
    status: AlignmentWord
    #: How many.
    motions: int


class OutlierRecord(Record):
    """A measurement that does not belong to the others."""

    #: Line of the table of measurements.
    line: int
    #: From 1; null: the whole pose.
    leg: Union[int, None]
    #: How far it is from the model, standard deviations.
    distance: Union[float, None]
    #: Right measurements are all nearer with a probability of 99 %.
    threshold: Union[float, None]
    #: Its weight in the fit.
    weight: Union[float, None]


class PathRecord(Record):
    """What a path of the homotopy did."""

    #: Index of the start point.
    start: int
    #: Where it ended.
    end: PathEnd
    #: Index into `solutions`, from 0.
    root: Union[int, None]
    #: Index of the mirror image, where one path stands for two.
    mirror_root: Union[int, None]
    #: Accepted steps.
    steps: int
    #: Rejected steps.
    rejections: int
    #: Winding number, 1 for a regular end, 0 where it is not determined.
    winding: int
    #: |e.e| / |e|^2 at the end.
    isotropy: Union[float, None]
    #: How often it had to be tracked again with smaller steps.
    retracked: int


class PatternLegRecord(Record):
    """One leg of a pattern."""

    #: Its base joint.
    base: str
    #: Its platform joint.
    platform: str
    kind: Union[Literal["vertex", "inner"], None]
    #: The side, from 1.
    side: Union[int, None]
    #: The name of its offset.
    offset: Union[str, None]
    #: The legs at the ends of the side, from 1.
    between: Union[tuple[int, ...], None]


class PatternRecord(Record):
    """Which legs are kept and which are moved along which edge."""

    #: Its name: V and the vertices kept, S and the sides of the moved ones.
    id: str
    #: Its class up to symmetry, from 1.
    class_: int
    #: Its class up to all symmetries, from 1.
    class_exchange: int
    #: Its topology, from 1.
    topology: int
    #: It is reached by offsets introduced one at a time.
    sequential: bool
    #: The legs, in the order of the design.
    legs: tuple[PatternLegRecord, ...]
    #: Names of the offsets.
    offsets: tuple[str, ...]
    #: Joints that hold more than one leg.
    shared_joints: tuple[SharedJointRecord, ...]
    #: Joints on one line.
    alignments: tuple[tuple[str, ...], ...]
    #: Formulas of the entries of A, legs in the order of the design.
    A: tuple[tuple[str, ...], ...]
    #: The formula of det A.
    det: str
    #: Equations for det A = 0, one a factor.
    det_zero: tuple[str, ...]


class PentapodAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: How many legs it has: 5.
    legs: int
    #: A joint is no fraction; the answer is about its nearest doubles.
    rounded_joints: bool
    #: The line that the legs hold; null where no body has all its joints on a line. The other freedom of
    #: the platform is the turn about this line.
    line: Union[HeldLineRecord, None]
    #: Whether the legs are dependent at every pose; null: not decided.
    architecturally_singular: Union[bool, None]
    #: The sixth legs with which the platform is solved in steps.
    sixth_legs: tuple[DecouplingLeg, ...]
    #: The lengths that poses were asked for; null: none.
    lengths: Union[tuple[float, ...], None]
    #: All poses of the line for them; null where none were asked for, or there is no answer.
    poses: Union[LinePosesRecord, None]
    #: Why there are no poses although lengths are given.
    no_poses: Union[str, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class PlacedFirst(Record):
    """A part of the platform that some of the legs place, before the others place the rest."""

    part: Union[Literal["line", "joint"], None]
    #: The body.
    body: Union[Body, None]
    #: The legs, counted from 1.
    legs: Union[tuple[int, ...], None]
    #: By which polynomial; null where the legs are dependent, or joints are no fractions.
    class_: Union[LineClass, None]
    #: The five other ends lie in a plane: a line-plane component.
    other_ends_in_plane: Union[bool, None]


class PolynomialRecord(Record):
    """A polynomial in one unknown or in several: its degrees, its coefficients and its real roots."""

    #: The unknowns by their names.
    unknowns: tuple[str, ...]
    #: The degree before factors without meaning are removed.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The factors that were removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Different complex roots; null with several unknowns, and where that is not proved.
    distinct_roots: Union[int, None]
    #: How the coefficients are known.
    coefficients_known: CoefficientsWord
    #: The exponents of the unknowns in each term.
    exponents: tuple[tuple[int, ...], ...]
    #: The exact coefficient of each term, integers as decimal text; of one unknown the constant one first.
    coefficients: tuple[str, ...]
    #: Different real roots, counted by Sturm's theorem; null with several unknowns, and where coefficients
    #: are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: How often each of them is a root.
    real_root_multiplicities: tuple[int, ...]
    #: Bounds [low, high] of the coefficients, where they are not exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class PoseBoundRecord(Record):
    """A proved bound on the number of isolated finite poses, counted with multiplicity."""

    #: The bound.
    poses: int
    #: Why there are not more.
    theorem: str


class PoseConventionRecord(Record):
    """A convention for poses."""

    #: Order of the turns: `fixed-xyz` and the like for fixed axes, `moving-xyz` for axes that are carried
    #: along, or `vector` for rotation vectors.
    rotation_order: str
    #: The same as a product of matrices for angles a, b, c in the order in which they are written.
    formula: str
    #: Unit of angles: `deg` or `rad`.
    angles: str
    #: Order of quaternions: `wxyz` or `xyzw`.
    quaternion: str
    #: The point of the platform whose position is given, platform frame, design units.
    pivot: tuple[Union[float, None], ...]
    #: What poses are measured from: `base` or `home`.
    relative_to: str
    #: The axis that points up: `z` or `y`.
    up: str
    #: The convention in words.
    sentence: str


class PoseCountRecord(Record):
    """The finite poses of the design, counted without finding them."""

    #: Their number with multiplicity; null: not finite, or undecided.
    finite: Union[int, None]
    #: Standard monomials of each degree.
    by_degree: Union[tuple[int, ...], None]
    #: Dimension of a set of positive dimension.
    dimension: Union[int, None]
    #: Degree of a set of positive dimension, in the 16 coordinates of a pose, with multiplicity.
    degree: Union[int, None]
    #: Why there is no count.
    undecided: Union[CountUndecided, None]
    #: The lengths it is the count of: those given, exactly as they stand, or generic ones, which have as
    #: many isolated poses as any or more. Where the lengths are known to rounding only, as images under a
    #: leg map are, the latter are counted.
    lengths: CountedLengths
    #: By a theorem and certificates, or modulo random primes.
    evidence: EvidenceWord
    #: A bound; null: proved, or undecided.
    error_probability: Union[float, None]
    #: In decimal, as text: they have more digits than a double.
    primes: tuple[str, ...]


class PoseErrorRecord(Record):
    """The error of a pose."""

    #: Of the tool point, design units.
    position: Union[float, None]
    #: Of the orientation.
    rotation_deg: Union[float, None]


class PoseErrorsRecord(Record):
    """How the errors of poses spread."""

    #: Of the tool point, design units.
    position: QuantilesRecord
    #: Of the orientation.
    rotation_deg: QuantilesRecord


class PoseInFrames(Record):
    """A pose in the numbers of a convention."""

    #: Position of the pivot, design units.
    position: tuple[Union[float, None], ...]
    #: Angles in the unit of `frames`, in the order in which they are written.
    angles: tuple[Union[float, None], ...]
    #: Whether the rotation has no other angles: false near the ends of the middle angle, where only a
    #: combination of the others is determined to more than half of the digits of a double.
    angles_unique: bool
    #: The unit quaternion in the order of `frames`.
    quaternion: tuple[Union[float, None], ...]


class PoseQuaternionRecord(Record):
    """A pose by its quaternion: a platform point x is at R(q) x + p in the base frame."""

    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]


class PoseRecord(Record):
    """A pose: a platform point x is at R x + p in the base frame."""

    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]


class PoseRegionRecord(Record):
    """The poses that a design asks for."""

    #: Where home comes from.
    home: SourceWord
    #: Its position in the design that the search began with.
    home_position: tuple[Union[float, None], ...]
    #: Where the workspace comes from.
    workspace: SourceWord


class PoseTotalsRecord(Record):
    """Poses counted."""

    #: Where the lengths come from.
    lengths_from: LengthsOrigin
    #: Finite poses, real and complex.
    finite_count: int
    #: Real ones.
    real_count: int
    #: Poses with a certificate.
    certified_count: int
    #: False: poses may be missing.
    all_paths_accounted: bool


class PoseUncertaintyRecord(Record):
    """How uncertain a pose is that is computed from lengths with the calibrated machine, by what the calibration does not know, to first order; the noise of these lengths comes on top."""

    #: Whether the design file has correlations.
    correlations: CorrelationsWord
    #: Root mean square of the distance by which the platform origin is off, design units.
    position: Union[float, None]
    #: Root mean square of the angle by which the orientation is off, degrees.
    rotation_deg: Union[float, None]
    #: Covariance of the shift of the platform origin (design units) and the rotation vector (degrees),
    #: base frame.
    covariance: tuple[tuple[Union[float, None], ...], ...]


class PriceRecord(Record):
    """Figures of a design and of the platform with separate joints made from it, in this order."""

    #: Worst conditioning over the poses of the workspace, both by the characteristic length of the design.
    conditioning: tuple[Union[float, None], ...]
    #: Least distance of the ends of two legs on the base, design units; 0 where they share a joint.
    base_spacing: tuple[Union[float, None], ...]
    #: The same on the platform.
    platform_spacing: tuple[Union[float, None], ...]
    #: Greatest distance of a base joint from the centre of the joints.
    base_radius: tuple[Union[float, None], ...]
    #: The same of the platform.
    platform_radius: tuple[Union[float, None], ...]
    #: One sentence.
    message: str


class ProvenanceRecord(Record):
    """What it takes to make an answer again: the program, the seed and the files. There is no clock and no name of a machine in it."""

    #: The version of the program.
    version: str
    #: The seed that was handed to the computation; null where it takes none.
    seed: Union[int, None]
    #: The designs, in the order in which they were given.
    designs: tuple[DesignSourceRecord, ...]
    #: Other texts that were read: tables of lengths or poses, fronts.
    files: tuple[FileSourceRecord, ...]


class QuantilesRecord(Record):
    """How values spread."""

    #: Half of the values is at most this.
    median: Union[float, None]
    #: 90 of a hundred.
    p90: Union[float, None]
    #: 99 of a hundred.
    p99: Union[float, None]
    #: All.
    max: Union[float, None]


class RayEndRecord(Record):
    """What ends ways."""

    #: The kind of requirement; null: a singular pose, or nothing within ten sizes.
    name: Union[TermKind, None]
    #: The same in a word.
    end: str
    #: The share of the ways, which is one of solid angle.
    share: float


class RealPoseRecord(Record):
    """A real pose in real numbers."""

    #: Position of the platform origin, base frame, design units.
    position: tuple[float, ...]
    #: Rows of the rotation matrix.
    rotation: tuple[tuple[float, ...], ...]
    #: Roll, pitch and yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll).
    rpy_deg: tuple[float, ...]
    #: Unit quaternion, scalar part first.
    quat_wxyz: tuple[float, ...]
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: On which side of the base the platform is; null: its centre is in the plane of the base, there or at
    #: home.
    mode: Union[SideWord, None]
    #: Largest difference from home of an entry of the rotation matrix, or of a coordinate of the position
    #: over the size of the design.
    distance_from_home: float
    #: Whether none of the other real poses listed is nearer to home.
    nearest_home: bool
    #: Whether the pose meets every requirement and det J has the sign that it has at home, with
    #: `--limits`.
    allowed: Union[bool, None]
    #: Whether each crank is on the side (elbow) that the design names, where the legs are rods on cranks:
    #: a machine gets to another side only through a pose with crank and rod in one plane with the axis.
    elbow_kept: Union[tuple[bool, ...], None]


class RegularBoxRecord(Record):
    """A box of poses about a pose that holds no singular one."""

    #: Half widths of positions at scale 1, design units, base frame.
    translation: tuple[float, ...]
    #: Half widths of the rotation vector at scale 1, base frame.
    rotation_deg: tuple[float, ...]
    #: Its shape.
    region: RegionWord
    #: No singular pose up to this scale, proved.
    proved_scale: Union[float, None]
    #: A pose of the smallest box known to hold a singular one.
    singular_within: Union[ScaledPoseRecord, None]
    #: Up to this scale a change of sign was looked for.
    searched_scale: Union[float, None]
    #: Cells the proof took.
    cells: int


class RegularityRecord(Record):
    """Whether det J vanishes at no pose of the workspace."""

    #: Null: undecided.
    met: Union[bool, None]
    #: The same in a word.
    status: RegularityWord
    #: Where det J has the other sign than at home, or where it is undecided.
    pose: Union[PoseQuaternionRecord, None]
    #: Cells of the workspace that were looked at.
    cells: int


class RejectedRecord(Record):
    """A candidate that is no root."""

    #: Why.
    reason: RejectionReason
    #: Its error in the leg equations, over the squared size.
    residual: Union[float, None]


class RemovedFactorRecord(Record):
    """A factor that belongs to the way to the polynomial, not to its meaning."""

    #: The factor in the unknowns, or in words.
    factor: str
    #: Its degree.
    degree: int
    #: How often it was removed.
    times: int


class RequiredSizeRecord(Record):
    """The region that a design asks for."""

    #: Of its translations, design units cubed.
    volume: float
    #: The same over the volume that straight ways reach at the orientation of home.
    share: Union[float, None]
    #: The factor by which its translations and rotations together may be multiplied; 1 and more: the
    #: region is free.
    factor: FreeSizeRecord


class RequirementMarginRecord(Record):
    """The least margin of a requirement."""

    #: Which.
    name: TermKind
    #: The margin; a violation below 0.
    margin: Union[float, None]


class ResidualsRecord(Record):
    """Sizes of residuals, design units."""

    #: Root mean square.
    rms: Union[float, None]
    #: Of each leg.
    legs: tuple[Union[float, None], ...]
    #: The one of the largest size; null: none was counted.
    greatest: Union[GreatestResidualRecord, None]
    #: Lengths counted.
    count: int


class RiddenBoundRecord(Record):
    """A bound of which nothing is left."""

    #: A variable, a requirement, or `abs_det`.
    name: str
    #: What bounds it.
    kind: RiddenWord
    #: The value of a variable; what is left of a limit.
    value: Union[float, None]
    #: Of the value; empty for a pure number.
    unit: str


class RidingRecord(Record):
    """The bounds that decide about a platform, and the growth of its bodies."""

    #: Ranges of variables and limits of which nothing is left.
    bounds: tuple[RiddenBoundRecord, ...]
    #: Greatest distance of a base joint from the centre of the joints, over that in the design.
    base_growth: Union[float, None]
    #: The same of the platform.
    platform_growth: Union[float, None]
    #: One sentence.
    message: str


class RotationPolynomialRecord(Record):
    """The polynomial in a Cayley parameter of all poses."""

    #: The unknowns by their names.
    unknowns: Union[tuple[str, ...], None]
    #: The degree before factors without meaning are removed.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The factors that were removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Different complex roots; null with several unknowns, and where that is not proved.
    distinct_roots: Union[int, None]
    #: How the coefficients are known.
    coefficients_known: Union[CoefficientsWord, None]
    #: The exponents of the unknowns in each term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: The exact coefficient of each term, integers as decimal text; of one unknown the constant one first.
    coefficients: Union[tuple[str, ...], None]
    #: Bounds [low, high] of the coefficients, where they are not exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Different real roots, counted by Sturm's theorem; null with several unknowns, and where coefficients
    #: are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: How often each of them is a root.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: Why not.
    error: Union[str, None]


class RoundAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of its lengths.
    units: str
    #: The grids asked for.
    grids: GridsRecord
    #: Origins and angles of the grids are chosen too.
    free_grid: bool
    #: The design as it is wanted.
    wanted: JudgementRecord
    #: The best rounding that is exactly equivalent to an octahedral platform.
    exact: ExactRoundingOutcome
    #: The rounding with every joint next to where it is wanted.
    nearest: NearestRoundingOutcome
    #: What `assess` says of the rounded design; null: there is none, or the design requires nothing.
    assessment: Union[AssessAnswer, None]
    #: Which of them the rule takes; null: none meets the requirements.
    chosen: Union[VariantWord, None]
    #: Where none meets the requirements, the one that misses them least, by the greatest violation as a
    #: share of what is limited; null otherwise.
    least_missed: Union[VariantWord, None]
    #: The rounded design: the one chosen, or the one that misses the requirements least.
    design: Union[Design, None]
    #: The file written.
    output: Union[str, None]
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class RoundedJointRecord(Record):
    """A joint on a hole."""

    #: Its body.
    body: Body
    #: Its name.
    joint: str
    #: The hole: counted along the axes of the grid, or its circle and its number on it; null: the joint
    #: stays where it was.
    cell: Union[tuple[int, ...], None]
    #: How it moved, frame of the body.
    moved: tuple[Union[float, None], ...]
    #: How far.
    distance: Union[float, None]
    #: Distance from the line of its side; null for corners.
    off_line: Union[float, None]


class RoundingErrorRecord(Record):
    """The error of the pose when a rounded platform is controlled as the wanted one."""

    #: To first order.
    first_order: PoseErrorRecord
    #: The same with every joint on the nearest hole.
    first_order_nearest_points: PoseErrorRecord
    #: Solved at random poses.
    solved: PoseErrorsRecord
    #: How many.
    solved_poses: int


class RoundingSearchRecord(Record):
    """How an exact rounding was found."""

    #: Triangles of base and platform that were combined.
    triangles: tuple[int, ...]
    #: All triangles up to this distance were.
    complete_to: tuple[Union[float, None], ...]
    #: Improvements by replacing one triangle.
    replacements: int


class RowFailure(Record):
    """Why a row has no poses."""

    #: The failure, as the command would have reported it for this row alone.
    error: FailureRecord


class SampleRecord(Record):
    """Both designs at one set of corresponding leg lengths."""

    #: Leg lengths of A, design units.
    lengths_a: tuple[Union[float, None], ...]
    #: Leg lengths of B.
    lengths_b: tuple[Union[float, None], ...]
    #: The poses of A.
    a: SolvedSampleRecord
    #: The poses of B.
    b: SolvedSampleRecord
    #: Pairs of poses.
    matched: int
    #: Poses of A without partner.
    only_a: int
    #: Poses of B without partner.
    only_b: int
    #: Poses of A that were set aside.
    beyond_precision_a: int
    #: Poses of B that were set aside.
    beyond_precision_b: int
    #: The largest distance of a pair.
    worst_distance: Union[float, None]
    #: Whether this sample speaks for equivalence.
    agrees: bool


class SamplingRecord(Record):
    """The random poses at which designs were compared."""

    #: How many.
    count: int
    #: The middle of the box.
    home_position: tuple[float, ...]
    #: Half widths of the box of positions, design units.
    translation_half_widths: tuple[float, ...]
    #: Half widths of the box of rotation vectors.
    rotation_half_widths_rad: tuple[float, ...]


class ScaledPoseRecord(Record):
    """A pose and the scale of the smallest box that holds it."""

    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: The scale.
    scale: Union[float, None]


class SearchLimitsRecord(Record):
    """What a search is held to besides the requirements of the design."""

    #: Of joint centres of a body, design units; null: none.
    min_joint_distance: Union[float, None]
    #: The least |det A| of platforms equivalent to the design.
    min_abs_det: float
    #: By which the lengths in the Jacobian are divided.
    characteristic_length: float
    #: Label of the length unit.
    units: str


class SearchMarginsRecord(Record):
    """By how much what a search demands besides the requirements is met."""

    #: |det A| less the required value; null: the variables do not keep the class of the design.
    abs_det: Union[float, None]
    #: Least distance of a variable from its bounds.
    bounds: Union[float, None]


class SearchRecord(Record):
    """How a search went."""

    #: Which search it was.
    method: SearchMethodWord
    #: Starts that were climbed from; null: it begins in the branches.
    starts: Union[int, None]
    #: Starts that led to a feasible point.
    feasible: Union[int, None]
    #: Gains of the polished runs; null in the list: not feasible.
    polished: Union[tuple[Union[float, None], ...], None]
    #: Of a front: runs that met their bounds, and were dominated by others or equal to one.
    dominated: Union[int, None]
    #: Of a front: bounds that no run met.
    unmet: Union[int, None]
    #: Conic programs that the library clarabel solved in this search; those with other drives and for
    #: freedoms are not counted.
    conic_programs: int


class SearchStepRecord(Record):
    """A step of the run that found a platform."""

    #: Value after the step: the weighted gain of the objectives, for offsets the worst inverse condition
    #: number.
    objective: Union[float, None]
    #: In the scale of its constraint; lengths relative to the size.
    violation: Union[float, None]
    #: Of the trust region.
    radius: Union[float, None]
    #: Poses held.
    poses: int
    #: The step was taken.
    accepted: bool
    #: Gain of the merit that the model promised.
    predicted: Union[float, None]
    #: Gain of the merit found; for a refused step at the poses that refused it.
    actual: Union[float, None]


class SearchedDriveRecord(Record):
    """A drive of the table, in the units of the design, with what the search came to."""

    #: Its name.
    name: str
    #: Line of the table, from 1.
    line: int
    #: Price; null: the table does not say it.
    price: Union[float, None]
    #: Mass; null: the table does not say it.
    mass: Union[float, None]
    #: Least and greatest length from joint centre to joint centre.
    leg_length: tuple[Union[float, None], ...]
    #: Greatest force; null: the table does not say it.
    force: Union[float, None]
    #: Greatest speed; null: the table does not say it.
    speed: Union[float, None]
    #: What came of it.
    outcome: DriveSearchWord
    #: Value of the first objective of the platform found; null: none was.
    objective: Union[float, None]
    #: What the platform found, or the one that misses the requirements least, leaves of the lengths, the
    #: force and the speed of the drive; empty where the drive was not searched.
    margins: tuple[MarginRecord, ...]
    #: What became of the three-fold symmetry of the design; null as in an answer without a table.
    symmetry: Union[SymmetryRecord, None]
    #: Why it is not the answer, a sentence; null: it is.
    reason: Union[str, None]


class SharedJointRecord(Record):
    """A joint that holds more than one leg."""

    #: The body it is on.
    body: Body
    #: Its name.
    joint: str
    #: The legs, from 1.
    legs: tuple[int, ...]


class SignPairRecord(Record):
    """The straight path between two assembly modes."""

    #: Their numbers, from 1.
    modes: tuple[int, ...]
    #: What det J does on the straight path.
    straight: SignOutcome
    #: Proved changes of sign on it.
    changes: int
    #: Whether some path without singular pose joins them; null: none was found.
    joined: Union[bool, None]


class SignPairsRecord(Record):
    """Which assembly modes paths without singular pose join."""

    #: The sign of det J at each assembly mode.
    signs: tuple[SignRecord, ...]
    #: All pairs.
    pairs: tuple[SignPairRecord, ...]
    #: Groups of modes that such paths join, from 1.
    groups: tuple[tuple[int, ...], ...]
    #: The paths found.
    ways: tuple[WayRecord, ...]


class SignPartRecord(Record):
    """det J along a straight part of a path, with parameter u from 0 to 1."""

    #: What it does.
    outcome: SignOutcome
    #: Proved changes of sign.
    changes: int
    #: Pieces where neither a sign nor a change is proved.
    doubtful: int
    #: Pieces with their signs.
    pieces: tuple[SignPieceRecord, ...]
    #: [u, det J].
    values: tuple[tuple[Union[float, None], ...], ...]


class SignPathRecord(Record):
    """det J along a path of straight parts."""

    #: Number of the assembly mode it begins at, from 1; 0: the pose.
    from_: int
    #: Number of the assembly mode it ends at.
    to: int
    #: Its poses.
    poses: tuple[PoseQuaternionRecord, ...]
    #: Whether det J keeps its sign: true and false are proved.
    keeps_sign: Union[bool, None]
    #: One for each straight part.
    parts: tuple[SignPartRecord, ...]


class SignPieceRecord(Record):
    """A piece of a straight path."""

    #: Where it begins.
    from_: Union[float, None]
    #: Where it ends.
    to: Union[float, None]
    #: The sign of det J on it.
    sign: SignRecord
    #: It holds a singular pose: det J has proved signs before and after it, and they differ.
    singular: bool


class SingularFactorRecord(Record):
    """A factor of the closure condition that belongs to degenerate trilaterations."""

    #: Unoriented steps, from 0.
    step: int
    #: Its degree.
    degree: int
    #: How often it was removed.
    removed: int


class SingularLocusAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of its lengths.
    units: str
    #: The poses over which det J is a polynomial.
    family: PoseFamilyWord
    #: The position of the pose given, as exact expressions.
    position: tuple[str, ...]
    #: A quaternion of its orientation, scalar part first, of any norm, as exact expressions.
    quaternion: tuple[str, ...]
    #: The direction of the line, or the axis of the rotations, in the base frame; null for positions.
    direction: Union[tuple[str, ...], None]
    #: The square of the length of the axis: u is the tangent of half the angle over that length; null
    #: without an axis.
    axis_squared: Union[float, None]
    #: det J up to a constant factor. The zero polynomial: every pose is singular.
    polynomial: PolynomialRecord
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class SingularPosesAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of its lengths.
    units: str
    #: Whether the workspace of the design, or the region of `--box`, about the pose is free of singular
    #: poses; null where neither is given.
    regular: Union[RegularityRecord, None]
    #: The pose asked about.
    pose: JudgedPoseRecord
    #: The leg lengths, design units.
    lengths: tuple[float, ...]
    #: The real poses with these lengths.
    assembly_modes: tuple[JudgedPoseRecord, ...]
    #: False: some may be missing.
    assembly_modes_accounted: bool
    #: A box of poses about the pose that holds no singular one.
    box: RegularBoxRecord
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: det J along a path, with `--path`.
    path: Union[SignPathRecord, None]
    #: det J between all assembly modes, with `--between`.
    between: Union[SignPairsRecord, None]


class SolutionRecord(Record):
    """One pose with its evidence."""

    #: Rotation matrix, rows.
    R: ComplexRecord3
    #: Position, base frame, design units.
    p: ComplexRecord4
    #: Null: undecided.
    real: Union[bool, None]
    #: Whether there is a certificate.
    certified: bool
    #: The proof; null where there is none.
    certificate: Union[CertificateRecord, None]
    #: Paths, or roots of a polynomial, that end here.
    multiplicity: int
    #: Largest error of the leg equations over the squared size.
    residual: Union[float, None]
    #: Estimate of the condition number.
    condition: Union[float, None]
    #: (e, g), scalar part of e first, g = p e in design units, `max |e_k| = 1`.
    dual_quaternion: Union[ComplexRecord5, None]
    #: The pose in real numbers, where it is real.
    real_pose: Union[RealPoseRecord, None]


class Solvability(Record):
    """How the poses can be found in steps."""

    #: A chain of quadratic equations gives all poses.
    quadratic: bool
    #: The parts that can be placed first; empty where the legs do not decouple in these ways.
    placed_first: tuple[PlacedFirst, ...]


class SolvedBudgetRecord(Record):
    """What solving says about the radius, which is of first order."""

    #: No error looked at in the budget goes beyond the bound when its pose is solved.
    within_bound: bool
    #: The largest share of the bound that was used up; null: a pose was lost.
    largest_share: Union[float, None]
    #: The worst errors of this length at their pose keep the bound when they are solved.
    radius: Union[float, None]


class SolvedSampleRecord(Record):
    """Poses of one design at one set of lengths, by forward kinematics."""

    #: The method.
    method: Method
    #: Whether these are known to be all poses.
    completeness: CompletenessWord
    #: One sentence on what is known.
    completeness_reason: str
    #: False: poses may be missing.
    all_paths_accounted: bool
    #: Finite poses, real and complex.
    finite_count: int
    #: Real poses.
    real_count: int
    #: Poses with a certificate.
    certified_count: int


class StageRecord(Record):
    """What a stage of `explore` did."""

    #: Which.
    stage: StageWord
    #: What came out, a sentence.
    explanation: str


class StartRecord(Record):
    """Where the fit began, and what came of the other start."""

    #: The start whose end was taken.
    taken: StartName
    #: Whether both starts ended at the same machine; null: only one was tried.
    agree: Union[bool, None]
    #: Sum of the losses, or the estimated deviation of a length, from the nominal joints: the less, the
    #: better; null: not tried.
    nominal: Union[float, None]
    #: The same from the linear equations for squared lengths, which need no design; null: not tried, or
    #: the poses do not determine them.
    closed_form: Union[float, None]


class StiffnessRecord(Record):
    """Stiffness and natural motions at a pose."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: `J^T diag(k) J`: force and torque about the platform origin for a shift of it and a small turn, base
    #: frame; force units, design units and radians.
    K: tuple[tuple[Union[float, None], ...], ...]
    #: Least stiffness against a force through the platform origin, force units per design unit; 0 at a
    #: singular pose.
    linear: Union[float, None]
    #: Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
    angular: Union[float, None]
    #: The natural motions, the slowest first; null: masses are not known, or no inertia is held against
    #: turns.
    natural: Union[tuple[NaturalMotionRecord, ...], None]


class StraightWayRecord(Record):
    """The straight way to another pose: the platform origin moves on a line while the platform turns about one axis."""

    #: Where it ends.
    to: PoseQuaternionRecord
    #: The share of it that is free from its beginning, 1: all.
    free: float
    #: Where that share ends.
    pose: PoseQuaternionRecord
    #: The same in the convention of `frames`.
    in_frames: PoseInFrames
    #: What is violated beyond; null: nothing.
    binds: Union[LimitRecord, None]


class SymmetryRecord(Record):
    """What became of the three-fold symmetry that a design has at home and does not ask for."""

    #: What became of it.
    three_fold: SymmetryWord
    #: One sentence: why, and how it is turned off.
    message: str


class TightestRecord(Record):
    """The requirement with the least margin as a share of its limit."""

    #: The kind.
    name: TermKind
    #: Its least margin over its limit (travel of the legs, greatest force and so on); below 0 for a
    #: violation.
    share: Union[float, None]


class TimedMarginRecord(Record):
    """A margin with its time."""

    #: When the margin is least.
    time_s: float
    #: The margin.
    margin: MarginRecord


class TolerancesAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: Always 1: the version of these definitions.
    schema_version: int
    #: What `assess` says of the design; null: it requires nothing.
    assessment: Union[AssessAnswer, None]
    #: The greatest error allowed.
    bound: PoseErrorRecord
    #: The tool point, platform frame.
    tool: tuple[Union[float, None], ...]
    #: The unit of lengths.
    units: str
    #: How far every joint may be off in any direction, to first order.
    all_joints_radius: JointLimitRecord
    #: How far every coordinate may be off, to first order.
    all_coordinates: JointLimitRecord
    #: The joints, the most critical first.
    joints: tuple[JointBudgetRecord, ...]
    #: Errors of the pose with the joints off in the worst way, solved.
    worst_errors: WorstErrorsRecord
    #: What solving says about the radius.
    solved: SolvedBudgetRecord
    #: Random errors in the budget.
    trials: TrialsRecord
    #: Random errors of joints and leg offsets with the covariance of the calibration; null: not asked for.
    calibrated: Union[TrialsRecord, None]
    #: How uncertain computed poses are by what the calibration does not know, to first order; null: not
    #: asked for.
    calibrated_poses: Union[CalibratedPosesRecord, None]
    #: The greatest errors by joints, leg lengths and temperature together; null: not asked for.
    map: Union[ErrorMapRecord, None]
    #: The poses looked at.
    poses: BudgetPosesRecord
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]


class TravelRecord(Record):
    """A free way and its end."""

    #: How far, not negative.
    free: float
    #: The value at the end.
    value: float
    #: What is violated beyond; null: nothing within half a turn, or ten sizes of the design.
    binds: Union[LimitRecord, None]


class TrialsRecord(Record):
    """Random errors in the budget."""

    #: How many.
    count: int
    #: Poses that were lost.
    lost: int
    #: Poses within the bound.
    within_bound: int
    #: Poses beyond it.
    beyond_bound: int
    #: Errors of the pose by the nominal formula.
    formula: PoseErrorsRecord
    #: By how much their first order is off.
    first_order_discrepancy: PoseErrorsRecord
    #: Errors after one Newton step with the joints as they are.
    after_one_step: PoseErrorsRecord
    #: Errors after two.
    after_two_steps: PoseErrorsRecord


class TrilaterationStepRecord(Record):
    """One trilateration: a joint placed by its distances from three others."""

    #: Three joints in place.
    from_: tuple[str, ...]
    #: The joint placed.
    place: str
    #: All four are on one body: one place instead of two.
    rigid: bool


class UnobservableRecord(Record):
    """A change of joints and offsets that changes no measured length, or hardly."""

    #: Joints that move, the farthest first.
    joints: tuple[JointShiftRecord, ...]
    #: Offsets that change.
    offsets: tuple[OffsetShiftRecord, ...]


class VariableRecord(Record):
    """A quantity that was chosen."""

    #: Which.
    name: str
    #: Its value in the design that the search began with.
    start: Union[float, None]
    #: Its value in the platform.
    value: Union[float, None]
    #: Least and greatest value that it may have.
    bounds: tuple[Union[float, None], ...]


class VerifiedRecord(Record):
    """A verification in short."""

    #: The verdict.
    verdict: VerdictWord
    #: The largest distance of matched poses.
    worst_distance: Union[float, None]
    #: Sets of lengths at which both were solved.
    sample_count: int


class VerifyAnswer(Record):
    """One JSON document: an answer between what all answers have."""

    #: The verdict.
    verdict: VerdictWord
    #: One sentence with the numbers that decided.
    explanation: str
    #: Whether the verdict is proved, in exact arithmetic on the leg vectors; `level` of the map says about
    #: which joints.
    proved: bool
    #: The algebraic side; that of the designs as they are given where no motion was found.
    map: MapRecord
    #: For each leg of B a bound of how far its squared length is from A s + c at all poses of `sampling`,
    #: design units squared, whatever the tolerance of the map; null where the map is proved, so that there
    #: is no difference, where it is singular, and where no motion was found.
    deviation_bounds: Union[tuple[Union[float, None], ...], None]
    #: The largest distance of matched poses over all samples; null where none were compared.
    worst_distance: Union[float, None]
    #: The numerical side.
    samples: tuple[SampleRecord, ...]
    #: Always 1: the version of these definitions.
    schema_version: int
    #: What the answer was made from.
    provenance: ProvenanceRecord
    #: What was odd about the design files that were read.
    warnings: tuple[WarningRecord, ...]
    #: Poses without partner that were set aside: the rounding of the joints decides whether they exist.
    #: Absent where no motion was found.
    beyond_precision: Union[BeyondPrecisionRecord, None]
    #: A pose that tells the designs apart.
    counterexample: Union[CounterexampleRecord, None]
    #: The box of random poses; absent where no motion was found.
    sampling: Union[SamplingRecord, None]
    #: Base and platform of the second design were exchanged first.
    exchanged: Union[bool, None]
    #: The rigid motions that make the second design equivalent to the first, with `--align`.
    alignment: Union[AlignmentRecord, None]
    #: The file written.
    output: Union[str, None]


class ViolationRecord(Record):
    """One thing that is wrong with a design file."""

    #: A stable short code.
    code: str
    #: The line, from 1.
    line: int
    #: The column, from 1.
    column: int
    #: What is wrong.
    message: str
    #: What to write instead.
    help: str


class WarningRecord(Record):
    """Something odd about a design file that does not keep it from being used."""

    #: A stable short code.
    code: str
    #: The design file.
    path: str
    #: The line it is about, from 1.
    line: int
    #: What is odd.
    message: str
    #: What to do about it.
    help: str


class WayRecord(Record):
    """A path without singular pose between two assembly modes."""

    #: Their numbers, from 1.
    modes: tuple[int, ...]
    #: Its poses, joined by straight paths.
    poses: tuple[PoseQuaternionRecord, ...]


class WitnessRecord(Record):
    """A pose with rational coordinates."""

    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: A quaternion of any norm, scalar part first.
    quaternion: tuple[int, ...]


class WorkspaceSizeRecord(Record):
    """How large the workspace is around home."""

    #: Volume of the positions that straight ways from home at its orientation reach, design units cubed;
    #: an estimate from the ways that were followed.
    volume: float
    #: The share by which the estimates from every second way and from the others differ.
    volume_doubt: float
    #: Ways that were followed.
    rays: int
    #: What ends them, the most frequent first.
    ends: tuple[RayEndRecord, ...]
    #: Radius of the largest ball of positions around home, at the orientation of home, design units.
    ball_radius: FreeSizeRecord
    #: Half widths of the largest box of positions found around home, at the orientation of home, along the
    #: axes of the base frame, design units: those proved to be free.
    box_proved: tuple[float, ...]
    #: The same: those in which no violation was found.
    box_searched: tuple[float, ...]
    #: What is violated in a box that is larger by a little; null: nothing that was looked at.
    box_binds: Union[LimitRecord, None]
    #: Turns about x, y and z of the base frame through the platform origin, at home.
    turns: tuple[FreeTurnRecord, ...]
    #: Largest angle up to which the platform may turn about every axis of the xy plane of the base at the
    #: position of home, degrees.
    tilt_deg: FreeSizeRecord
    #: Largest angle up to which it may turn about every axis there, degrees.
    turn_deg: FreeSizeRecord
    #: The region that the design asks for; null: none.
    required: Union[RequiredSizeRecord, None]


class WorstErrorsRecord(Record):
    """Errors of the pose with all joints off in the worst way, solved."""

    #: By the radius; null: the pose was lost.
    in_budget: Union[PoseErrorRecord, None]
    #: By one and a half times the radius; null: the pose was lost.
    times_1_5: Union[PoseErrorRecord, None]
    #: The pose.
    pose: PoseQuaternionRecord


class WorstPoseRecord(Record):
    """The pose with the worst conditioning."""

    #: Its place among the poses held, from 0.
    index: int
    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]


DemandWord = Union[TermKind, Objective, SpecialDemand]

DesignNotNegative = float

DesignNumber = float

DesignPercent = str

DesignPositive = float

ExploreVerdict = Union[Literal["infeasible", "none", "violated", "new_kinematics", "on_holes"], VerdictWord]

RoundingVerdict = Union[Literal["not_computed"], VerdictWord]

SignRecord = Union[int, None]

DesignEdges = tuple[DesignPositive, ...]

DesignHalfWidths = tuple[DesignNotNegative, ...]

DesignQuantity = Union[DesignNumber, str]

DesignQuaternion = tuple[DesignNumber, ...]

DesignRange = tuple[DesignNumber, ...]

DesignReserve = Union[DesignNotNegative, DesignPercent]

DesignVector = tuple[DesignNumber, ...]

DesignAxes = Union[Literal["home", "normal", "optimize"], DesignVector, tuple[Union[Literal["normal"], DesignVector], ...]]

DesignBody = dict[str, Union[tuple[DesignQuantity, ...], Any, dict[str, Any]]]

DesignHousing = Union[DesignPositive, DesignEdges]

DesignRows = tuple[DesignVector, ...]
