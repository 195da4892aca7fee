"""Answers as typed records: the fields of `equipod COMMAND --json`, by the same names.

Made from the schemas of the answers by `.ci/generate`; do not edit. What may be absent from a document is None, and so is what is null in it.
"""

from __future__ import annotations

from typing import Any, Literal, Union

from ._record import Record

ActiveBoundWord = Literal["limit", "range", "safety_margin"]
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
SearchMethodWord = Literal["dimensional", "offsets"]
SearchWord = Literal["found", "impossible", "undecided", "violated"]
SideWord = Literal["above", "below"]
SignOutcome = Literal["crosses", "keeps_sign", "undecided"]
SingularEvidenceWord = Literal["rounding", "sign_change", "zero"]
SourceWord = Literal["default", "design"]
SpecialDemand = Literal["abs_det", "reach"]
StageWord = Literal["assess", "components", "fk", "moves", "nearest", "verify"]
StartName = Literal["closed_form", "nominal"]
StatedPosesWord = Literal["listed_poses", "none", "stated"]
SymmetryWord = Literal["given_up", "kept"]
TermKind = Literal[
    "angular_stiffness",
    "base_cone_angle",
    "base_envelope",
    "base_first_angle",
    "base_hole_edge",
    "base_hole_gap",
    "base_second_angle",
    "base_spacing",
    "crank_angle",
    "crank_speed",
    "crank_torque",
    "crank_transmission",
    "keep_out",
    "leg_clearance",
    "leg_force",
    "leg_speed",
    "linear_stiffness",
    "machine_envelope",
    "max_leg_length",
    "max_rod_length",
    "min_leg_length",
    "min_rod_length",
    "natural_frequency",
    "payload_clearance",
    "plate_clearance",
    "platform_cone_angle",
    "platform_envelope",
    "platform_first_angle",
    "platform_hole_edge",
    "platform_hole_gap",
    "platform_second_angle",
    "platform_spacing",
    "tip_angle",
]
VariantWord = Literal["exact", "nearest"]
VerdictWord = Literal["equivalent", "inconclusive", "not_equivalent", "singular"]


class AccuracyRecord(Record):
    """The allowed error of the pose."""

    #: Error of the platform origin, design units.
    position: float
    #: Error of the orientation, degrees.
    rotation_deg: float


class ActiveBoundRecord(Record):
    """An active bound."""

    #: Variable or requirement, or `abs_det`.
    name: str
    #: The kind of bound.
    kind: ActiveBoundWord
    #: Value of the variable, or margin.
    value: Union[float, None]
    #: Unit; empty for a pure number.
    unit: str


class ActiveBoundsRecord(Record):
    """The active bounds of a platform, and the growth of its bodies."""

    #: Active bounds.
    bounds: tuple[ActiveBoundRecord, ...]
    #: Growth factor of the base: greatest distance of a base joint from the centre of the base joints,
    #: divided by its value in the design.
    base_growth: Union[float, None]
    #: Growth factor of the platform: greatest distance of a platform joint from the centre of the platform
    #: joints, divided by its value in the design.
    platform_growth: Union[float, None]
    #: Bounds in words.
    message: str


class AlignmentRecord(Record):
    """The rigid motions that make one design equivalent to another."""

    #: Result in words, with the numbers that decided.
    explanation: str
    #: With base and platform of the second design exchanged.
    exchanged: OtherAlignmentRecord
    #: With the mirror image of the second design.
    mirrored: OtherAlignmentRecord
    status: Union[Literal["found", "none", "undecided"], None]
    #: Smallest first.
    motions: Union[tuple[MotionRecord, ...], None]
    #: Whether `motions` is complete.
    all: Union[bool, None]
    #: Dimension of the families of motions.
    freedom: Union[int, None]
    #: Difference of the designs, which proves it.
    difference: Union[DifferenceRecord, None]
    #: Nearest motion.
    nearest: Union[NearestMotionRecord, None]
    #: The reason.
    reason: Union[AlignmentUndecided, None]


class AssemblyRecord(Record):
    """Whether a singular platform can be assembled."""

    verdict: Union[Literal["incompatible", "no_real_pose", "undecided", "real"], None]
    #: The relative violation.
    defect: Union[float, None]
    #: Squared lengths of the octahedral platforms.
    octahedral_squared_lengths: Union[CornerLengthsRecord, None]
    #: The pose.
    pose: Union[PoseRecord, None]
    #: Its residual.
    residual: Union[float, None]


class AssessAnswer(Record):
    """The answer of `assess`."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: Assessed design.
    name: str
    #: Unit of lengths.
    length_unit: str
    #: Role of the design here.
    role: DesignRoleWord
    #: Verdict for `assessed_poses`. True: every margin and det J are proved. False: one pose proves a
    #: violation or a change of sign of det J. Null: neither is proved, or the design states no workspace.
    met: Union[bool, None]
    #: Verdict in words.
    explanation: str
    #: Poses that the design states.
    workspace: StatedPosesWord
    #: The poses assessed.
    assessed_poses: AssessedPosesRecord
    #: Verdict for safety margins. True: every margin is proved to keep its safety margin. False: the given
    #: pose proves the opposite. Null: neither is proved.
    safety_margin_kept: Union[bool, None]
    #: The least margin of each kind.
    requirements: tuple[MarginRecord, ...]
    #: Least margin relative to its limit; null: no requirement has a limit to compare with.
    tightest: Union[TightestRecord, None]
    #: Whether the workspace is free of singular poses.
    regular: RegularityRecord
    #: Result on singular poses.
    regular_explanation: str
    #: Worst conditioning over the sampled poses: a value found, without limit and proof.
    conditioning: LeastConditioningRecord
    #: Number of poses sampled.
    poses: int
    #: Number of workspace cells of the proof.
    cells: int
    #: Lightest drive that meets the requirements, from the table that the design names. Null: the design
    #: names none, or the answer has another subject.
    lightest_drive: Union[LightestDriveRecord, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Ranges of single coordinates with their free parts. Absent: the design states none.
    ranges: Union[tuple[RangeRecord, ...], None]
    #: Assumptions about masses, one sentence each. Absent: no force, torque or natural frequency is
    #: assessed, or the enclosing answer has the list.
    assumptions: Union[tuple[str, ...], None]


class AssessedPosesRecord(Record):
    """The poses of an assessment, with home."""

    #: Whether the design states a workspace; otherwise only home is assessed.
    stated: bool
    #: Whether a whole region around home is assessed.
    region: bool
    #: Number of single poses; the motions between them are not assessed.
    listed: int
    #: Number of poses of a trajectory; the straight motions between them are assessed too.
    trajectory: int
    #: Number of coordinates that move alone from home, each over the whole of its range.
    ranges: int
    #: Wording of the verdict if met.
    met_in_words: str


class AtAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of lengths.
    length_unit: str
    #: The unit of forces; torques are in this unit times the unit of length.
    force_unit: str
    #: Convention in which poses were read, and of `in_frames`.
    frames: PoseConventionRecord
    #: The pose.
    pose: PoseQuaternionRecord
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Reference point, platform frame of `frames`: wrenches, shifts and stiffness are about it.
    point: tuple[Union[float, None], ...]
    #: Body whose axes vectors have: `base` or `platform`.
    axes: str
    #: Lengths shown; null: the legs are rods on cranks.
    lengths: Union[tuple[float, ...], None]
    #: Whether every requirement is met, and det J has the sign that it has at home.
    allowed: bool
    #: Violated requirements, the worst first.
    violated: tuple[LimitRecord, ...]
    #: The evidence of a singular pose; null: the pose is regular.
    singular: Union[SingularEvidenceWord, None]
    #: Inverse condition number of the Jacobian: 1 at best.
    inverse_condition: Union[float, None]
    #: Forces that hold each load and `--wrench`, at rest.
    held: tuple[HeldWrenchRecord, ...]
    #: Wrench that `--forces` hold; null: none were given.
    wrench: Union[WrenchRecord, None]
    #: Matrix from leg forces to the wrench they hold, force before torque, as in a six-axis load cell;
    #: null where a rod does not reach or a crank is singular.
    wrench_matrix: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Stiffness at the point; null: the design states neither `leg_stiffness` nor, for cranks,
    #: `stiffness`.
    stiffness: Union[PointStiffnessRecord, None]
    #: Motion of the point by drive steps; null at a singular pose.
    resolution: Union[ResolutionRecord, None]
    #: Remaining motion with the leg of `--leg` stuck, or free; null: no leg was named.
    stuck: Union[StuckLegRecord, None]
    #: The nearest singular pose found; null: it was not asked for, or no way met one.
    nearest_singular: Union[NearestSingularPoseRecord, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Crank angles, where a design has some and all rods reach.
    angles_deg: Union[tuple[float, ...], None]
    #: First rod that does not reach; nothing else is then known.
    out_of_reach: Union[OutOfReachRecord, None]


class BestLineRecord(Record):
    """A line that joints of a body lie nearly on, body frame, design units."""

    #: The body.
    body: Body
    #: A point of the line: the centroid of the joints.
    point: tuple[Union[float, None], ...]
    #: Unit vector along it.
    direction: tuple[Union[float, None], ...]
    #: Greatest distance of a joint from the line, design units.
    distance: Union[float, None]
    #: Greatest distance of a joint from the centroid, design units.
    reach: Union[float, None]


class BeyondPrecisionRecord(Record):
    """Numbers of poses that were set aside."""

    #: Number of poses of A.
    a: int
    #: Number of poses of B.
    b: int


class BoundedProof(Record):
    """The numbers of a proof that all real poses are listed, or all poses up to a distance."""

    #: Certified poses listed, with multiplicity.
    poses: int
    #: Number of far poses, certified to be different and farther out, or at infinity; null: the proof
    #: needs none.
    far: Union[int, None]
    #: Bound on rotation entries: every pose whose rotation matrix has no entry of a larger modulus is
    #: listed. Entries of real rotations are at most 1. Null: the proof is about real poses alone.
    R: Union[float, None]
    #: Change of leg ends to a neighbouring design without more poses, design units. The proof is then
    #: about real poses. Null: it is about far poses.
    neighbour: Union[float, None]
    #: The far poses, the nearest ones first.
    others: tuple[FarPoses, ...]


class BranchConflictRecord(Record):
    """A proof that a branch or a part of it is empty."""

    #: A short stable code.
    code: Literal["vertices_too_close", "outside_bounds", "no_space", "pair_too_close", "det_too_small", "combination"]
    #: Proof in words, with its numbers.
    message: str


class BranchCountsRecord(Record):
    """Counts of the verdicts on the branches."""

    #: All branches.
    total: int
    #: Feasible branches.
    feasible: int
    #: Proved empty: zone outside the bounds.
    infeasible_bounds: int
    #: Proved empty: no space for joints.
    infeasible_spacing: int
    #: Proved empty: |det A| too small.
    infeasible_det: int
    #: Excluded by the bound over all offsets, without a search.
    bounded: int
    #: Undecided.
    unproved: int
    #: The conic solver failed.
    solver_failure: int


class BranchRecord(Record):
    """A branch: one zone for each offset."""

    #: Zone of each offset: before, inside or beyond its edge.
    branch: str
    #: Outcome.
    verdict: BranchWord
    #: The best objective of the branch, if it is dominated.
    objective: Union[float, None]
    #: The offsets with this objective.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: Number of searched parts.
    cells: int
    #: Proved conflicts.
    conflicts: tuple[BranchConflictRecord, ...]


class BudgetPosesRecord(Record):
    """The poses evaluated."""

    #: Number of poses.
    count: int
    #: Source of the workspace.
    workspace: SourceWord


class CalibrateAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of lengths.
    units: str
    #: Convention in which poses were read, and of `in_frames`.
    frames: PoseConventionRecord
    #: The outcome of the calibration.
    outcome: CalibrateOutcome
    #: Reason of the outcome, one sentence.
    reason: str
    #: The calibration; null: nothing was measured, and poses to measure were asked for.
    calibration: Union[CalibrationRecord, None]
    #: The poses to measure next, the most informative first.
    next_poses: tuple[NextPoseRecord, ...]
    #: The design file written; null: none.
    path: Union[str, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class CalibratedJointRecord(Record):
    """A calibrated joint."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: The position, design units, body frame.
    position: tuple[Union[float, None], ...]
    #: Standard deviations, design units; null: the joint was held.
    deviations: Union[tuple[Union[float, None], ...], None]
    #: Displacement from the design, design units.
    moved: tuple[Union[float, None], ...]


class CalibratedOffsetRecord(Record):
    """The offset of a leg."""

    #: The leg, from 1.
    leg: int
    #: Shown length minus joint distance, design units.
    offset: Union[float, None]
    #: Standard deviation, design units; null: the offset was held.
    deviation: Union[float, None]


class CalibratedPosesRecord(Record):
    """Standard deviations of poses computed from lengths with the calibrated machine. The noise of the lengths adds to them."""

    #: Source of correlations.
    correlations: CorrelationsWord
    #: Number of poses evaluated.
    poses: int
    #: RMS error of the tool point, design units.
    position: DeviationRecord
    #: RMS error of the orientation, degrees.
    rotation_deg: DeviationRecord


class CalibrationRecord(Record):
    """The calibrated machine with its residuals and deviations."""

    #: Number of measured poses.
    poses: int
    #: Number of unknowns.
    unknowns: int
    #: The frames of joints, deviations and covariance.
    frames: CalibrationFrames
    #: Motions from measurement frames to design frames; null: joints are given in the frames of the
    #: measurements.
    motions: Union[FrameMotionsRecord, None]
    #: Standard deviations of measurements.
    noise: NoiseRecord
    #: Loss function.
    loss: LossRecord
    #: Start of the fit.
    start: StartRecord
    #: Whether the fit converged.
    converged: bool
    #: Number of steps in all.
    steps: int
    #: The calibrated joints: all joints that carry legs.
    joints: tuple[CalibratedJointRecord, ...]
    #: Offsets of the legs: shown length minus distance of the joints, design units.
    offsets: tuple[CalibratedOffsetRecord, ...]
    #: Covariance of the unknowns, squared design units; directions that are not identified contribute no
    #: variance.
    covariance: CovarianceRecord
    #: Uncertainty of computed poses; null: not all unknowns are identified, or the design has no pose to
    #: evaluate.
    computed_poses: Union[ComputedPosesRecord, None]
    #: Observability of the machine's parameters.
    observability: ObservabilityRecord
    #: Residuals before calibration.
    before: ResidualsRecord
    #: Residuals after calibration, without outliers.
    after: ResidualsRecord
    #: First-order leave-one-out residuals, without outliers: each pose against the machine fitted to the
    #: other poses.
    leave_one_out: ResidualsRecord
    #: Residuals of `--check`; null: there are none.
    check: Union[ResidualsRecord, None]
    #: Indispensable measurements, by line: without one of them, the unknowns are not determined.
    indispensable: tuple[int, ...]
    #: Test of residuals against noise.
    chi_square: ChiSquareRecord
    #: Contradicting measurements, the farthest first.
    outliers: tuple[OutlierRecord, ...]
    #: Legs with lengths probably exchanged, from 1: swapped, they are five times nearer to the design.
    #: Null: none.
    exchanged_legs: Union[tuple[int, ...], None]


class CaseRecord(Record):
    """A known kind of singular design."""

    #: Name of the case.
    case: str
    #: Short code.
    reason: str
    #: Legs, from 1.
    legs: tuple[int, ...]
    #: Case in words.
    explanation: str


class CertificateRecord(Record):
    """The proof that a root exists and is unique nearby, with all its numbers."""

    kind: Union[Literal["study", "cluster", "octahedral"], None]
    #: Coordinate that equals 1.
    patch: Union[int, None]
    #: A power of two, design units.
    unit: Union[float, None]
    #: The centre of the ball.
    centre: Union[ComplexRecord5, ComplexRecord4, None]
    #: Its low-order parts, to be added to it.
    centre_low: Union[ComplexRecord5, None]
    #: One root lies within this distance of the centre.
    radius: Union[float, None]
    #: No other root lies within this distance.
    uniqueness_radius: Union[float, None]
    #: Contraction of the simplified Newton map on that ball, below 1.
    contraction: Union[float, None]
    #: Precision of the centre.
    precision: Union[CentrePrecision, None]
    #: Reality of the root, proved for all squared lengths within the rounding of the data.
    reality: Union[ProvedReality, None]
    #: Discs that contain the pose.
    enclosure: Union[EnclosureRecord, None]
    #: Number of roots, counted with multiplicity; at least 2.
    multiplicity: Union[int, None]
    #: Radius of the disc of t.
    reach: Union[float, None]
    #: Remainder over the leading term, the power of t with the multiplicity as exponent, on the circle;
    #: below 1.
    dominance: Union[float, None]
    #: Legs 14 24 25 35 36 16, from 0.
    order: Union[tuple[int, ...], None]
    #: Whether the root is the mirror image, in the plane of the base, of the pose near the centre.
    mirrored: Union[bool, None]


class CheckAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Verdict in words, with the name.
    headline: str
    #: The unit of lengths.
    units: str
    #: The size of the design, in its units: what distances are compared with.
    size: Union[float, None]
    #: The exactness of the design's joints.
    joints: JointsRecord
    #: Whether every pose is singular. Null: undecided, since a singular design lies within rounding or the
    #: digits given, or some joints are known only between bounds.
    architecturally_singular: Union[bool, None]
    #: The level of the proof; "within rounding": a singular design may have been meant. Null: not decided.
    level: Union[Level, None]
    #: Whether a singular design may have been meant: it agrees within rounding or the digits given, and is
    #: `nearest_singular`.
    singular_within_rounding: bool
    #: Exact decision for the joints as numbers; null: some joints are known only between bounds.
    singular_as_written: Union[bool, None]
    #: Evidence that home is singular; null: it is regular, or the design states none.
    singular_home: Union[SingularEvidenceWord, None]
    #: Short code; null: regular.
    reason: Union[str, None]
    #: Verdict in words.
    explanation: str
    #: Proof for the joints as written.
    proof: ProofWord
    #: Proof in words.
    proof_explanation: str
    #: Rank of the leg vectors.
    leg_rank: int
    #: Generic Jacobian rank: the rank of the leg lines at almost every pose.
    jacobian_rank: int
    #: Pose with this rank.
    witness: WitnessRecord
    #: First dependency of the leg vectors; null: there is none.
    dependency: Union[DependencyRecord, None]
    #: All dependencies of the leg vectors.
    dependencies: tuple[DependencyRecord, ...]
    #: Legs of the first known case, from 1.
    dependent_legs: Union[tuple[int, ...], None]
    #: Known cases, the most specific first.
    cases: tuple[CaseRecord, ...]
    #: The Griffis-Duffy type; null: the joints do not lie on the sides of two triangles.
    griffis_duffy: Union[GriffisDuffyRecord, None]
    #: The nearest singular design found; null: the design itself is singular.
    nearest_singular: Union[NearestSingularRecord, None]
    #: Finite poses, real and complex, for generic leg lengths.
    pose_count: PoseCountRecord
    #: Common points of six leg equations for generic lengths, by kind. Null: the poses are not isolated,
    #: or not counted.
    common_points: Union[CommonPointsRecord, None]
    #: Upper bound on isolated finite poses, by a theorem.
    pose_bound: PoseBoundRecord
    #: Steps that compute the poses: by quadratic equations alone, or with one part of the platform first.
    solvability: Solvability
    #: Best line through the joints by body, base first. A body whose joints all lie on one line can rotate
    #: about it. A body with all joints at one point has no line.
    best_lines: tuple[BestLineRecord, ...]
    #: Singular values of the normalised leg vectors.
    singular_values: tuple[Union[float, None], ...]
    #: Inverse condition number of the Jacobian at random poses.
    jacobian_inverse_condition: ConditioningRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class ChiSquareRecord(Record):
    """Agreement of residuals with the noise."""

    #: Sum of squared whitened residuals.
    value: Union[float, None]
    #: Number of residuals minus number of identified unknowns.
    degrees_of_freedom: int
    #: Probability of a larger value by noise; null: the noise is estimated from the same residuals.
    probability: Union[float, None]


class ClosurePolynomialRecord(Record):
    """The closure polynomial in one squared distance, with its results on the number of real poses."""

    #: The joints of the virtual leg; null: none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: Two joints with unknown squared distance.
    unknown: tuple[str, ...]
    #: The joints of the first triangle.
    start: tuple[str, ...]
    #: The trilaterations after the first triangle.
    sequence: tuple[TrilaterationStepRecord, ...]
    #: Names of unknowns.
    unknowns: tuple[str, ...]
    #: Degree with spurious factors.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: Exponents of the unknowns by term.
    exponents: tuple[tuple[int, ...], ...]
    #: Exact coefficients, integers as decimal text; for one unknown the constant comes first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: Their multiplicities.
    real_root_multiplicities: tuple[int, ...]
    #: Singular factors.
    factors: tuple[SingularFactorRecord, ...]
    #: Number of real poses at each real root; null: not determined by the polynomial.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Total number of real poses, proved; null: not determined by the polynomial.
    poses_real_proved: Union[int, None]
    #: Coefficient bounds [low, high]; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class ClosureRecord(Record):
    """The closure polynomial beside the poses."""

    #: The joints of the virtual leg; null: none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: Two joints with unknown squared distance.
    unknown: Union[tuple[str, ...], None]
    #: The joints of the first triangle.
    start: Union[tuple[str, ...], None]
    #: The trilaterations after the first triangle.
    sequence: Union[tuple[TrilaterationStepRecord, ...], None]
    #: Names of unknowns.
    unknowns: Union[tuple[str, ...], None]
    #: Degree with spurious factors.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: Union[CoefficientsWord, None]
    #: Exponents of the unknowns by term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: Exact coefficients, integers as decimal text; for one unknown the constant comes first.
    coefficients: Union[tuple[str, ...], None]
    #: Coefficient bounds [low, high]; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: Their multiplicities.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: Singular factors.
    factors: Union[tuple[SingularFactorRecord, ...], None]
    #: Number of real poses at each real root; null: not determined by the polynomial.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Total number of real poses, proved; null: not determined by the polynomial.
    poses_real_proved: Union[int, None]
    #: Reason for no trilateration polynomial.
    no_sequence: Union[str, None]
    #: The reason.
    error: Union[str, None]


class CommonPointsRecord(Record):
    """Common points of six legs in the closure of the group, each with its multiplicity, counted modulo random primes."""

    #: Finite poses.
    finite: int
    #: Limits of poses with isotropic quaternion e: e.e = 0, e not 0. Null: not isolated, or not counted.
    isotropic: Union[int, None]
    #: Limits of poses with e = 0: the position goes to infinity. Null: points at infinity are not
    #: isolated, or not counted.
    at_infinity: Union[int, None]
    #: Bound on the probability of a wrong count.
    error_probability: float


class CompareAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: Unit of lengths.
    length_unit: str
    #: Unit of forces.
    force_unit: str
    #: The manoeuvres about home; forces, speeds and powers are computed along them.
    manoeuvres: tuple[str, ...]
    #: The accuracy for the joint tolerances; null: none was requested.
    accuracy: Union[AccuracyRecord, None]
    #: Characteristic length: the value of the first design, design units.
    characteristic_length: float
    #: The designs in the order given.
    designs: tuple[FiguresRecord, ...]
    #: The files written: the table and the page.
    paths: tuple[str, ...]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class ComparedRecord(Record):
    """A summary of a verification."""

    #: Number of length sets; both designs were solved at each.
    sample_count: int
    #: The largest distance of matched poses.
    worst_distance: Union[float, None]
    #: The residual of the affine map.
    residual: Union[float, None]
    #: The determinant of the affine map.
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
    """Standard deviations of poses computed from lengths, caused by the errors of the calibration with all correlations. The noise of the lengths adds to them."""

    #: Number of poses evaluated: the poses of the workspace at which the requirements of the design are
    #: met.
    poses: int
    #: Median RMS error of the measured platform origin, design units.
    position_median: Union[float, None]
    #: Greatest RMS error of the measured platform origin, design units.
    position_greatest: Union[float, None]
    #: Median RMS error of the orientation.
    rotation_deg_median: Union[float, None]
    #: Greatest RMS error of the orientation.
    rotation_deg_greatest: Union[float, None]
    #: Pose with the greatest position error.
    pose: PoseQuaternionRecord


class ConditioningRecord(Record):
    """The inverse condition number of the Jacobian at random poses."""

    #: The number of poses.
    poses: int
    #: The best.
    best: Union[float, None]
    #: The median value.
    median: Union[float, None]
    #: The worst.
    worst: Union[float, None]


class ConflictReasonRecord(Record):
    """A kind of proof that branches of the offsets are empty."""

    #: A short stable code.
    code: Literal["vertices_too_close", "outside_bounds", "no_space", "pair_too_close", "det_too_small", "combination"]
    #: Number of branches with this first proof.
    branches: int
    #: Proof for one branch, with its numbers.
    message: str


class ConflictRecord(Record):
    """A conflict: a set of requirements that cannot be met together; without any one of them the others were met."""

    #: Whether the conflict is proved.
    proved: bool
    #: The requirements in conflict, with the amounts to relax. Empty: the branches are empty for different
    #: reasons.
    requirements: tuple[GiveRecord, ...]
    #: Reasons for empty branches, by kind; empty: the search has no branches.
    reasons: tuple[ConflictReasonRecord, ...]


class CornerLengthsRecord(Record):
    """Squared lengths origin + x direction with x in the interval."""

    #: The origin at x = 0.
    origin: tuple[Union[float, None], ...]
    #: The direction of x.
    direction: tuple[Union[float, None], ...]
    #: The interval of x.
    interval: tuple[Union[float, None], ...]


class CorrespondenceRecord(Record):
    """The leg of FROM that corresponds to each leg of TO."""

    #: Leg of FROM for each leg of TO, from 1; null: none.
    legs: tuple[Union[int, None], ...]
    #: Distances of the two legs over the size.
    distances: tuple[Union[float, None], ...]
    #: Whether every leg of FROM is one of TO.
    permutation: bool
    #: Whether all distances are zero.
    exact: bool


class CounterexampleRecord(Record):
    """A pose that the lengths of one design allow and the corresponding lengths of the other do not."""

    #: Index into `samples`, from 0.
    sample: int
    #: The design that has the pose: A or B.
    solves: Literal["A", "B"]
    #: The pose.
    pose: ComplexRecord2
    #: Whether a certificate proves the pose for this design.
    certified: bool
    #: Leg of the other design with the greatest length error, from 1.
    leg: int
    #: The error of its squared length, relative to the squared size.
    miss: Union[float, None]
    #: Rounding error expected in it.
    rounding: Union[float, None]


class CounterexampleRecord2(Record):
    """A pose that the lengths of one design allow and the corresponding lengths of the other do not."""

    #: Index into `samples`, from 0.
    sample: int
    #: The design that has the pose: A or B.
    solves: Literal["A", "B"]
    #: The pose.
    pose: ComplexRecord2
    #: Whether a certificate proves the pose for this design.
    certified: bool
    #: Leg of the other design with the greatest length error, from 1.
    leg: int
    #: The error of its squared length, relative to the squared size.
    miss: Union[float, None]
    #: Rounding error expected in it.
    rounding: Union[float, None]


class CountsRecord(Record):
    """Counts of the members of the class."""

    #: Patterns of kept and moved legs.
    patterns: int
    #: Patterns up to symmetries that keep base and platform apart.
    classes: int
    #: Patterns up to all symmetries.
    classes_exchange: int
    #: Topologies, including the octahedral one.
    topologies: int
    #: The same, base and platform exchangeable.
    topologies_exchange: int
    #: Topologies reached by offsets one at a time.
    sequential_topologies: int
    #: The same, base and platform exchangeable.
    sequential_topologies_exchange: int
    #: Patterns reached by offsets one at a time.
    sequential_patterns: int
    #: Patterns that only split joints.
    splitting_patterns: int


class CovarianceRecord(Record):
    """The covariance matrix of the unknowns."""

    #: Names of rows and columns: `base.A1.x`, `offset.3`.
    unknowns: tuple[str, ...]
    #: The rows of the matrix.
    matrix: tuple[tuple[Union[float, None], ...], ...]


class CrankFiguresRecord(Record):
    """The figures of the cranks over the poses that all rods reach."""

    #: Least crank angle, degrees; null: no pose is reached.
    least_deg: Union[float, None]
    #: Greatest crank angle, degrees.
    greatest_deg: Union[float, None]
    #: Least transmission angle, degrees: 0 at a singular crank.
    transmission_deg: Union[float, None]
    #: Greatest torque under payload and loads, one at a time, force units times design units.
    torque: Union[float, None]
    #: Greatest crank speed at the required platform speed, degrees per second.
    speed_deg: Union[float, None]
    #: Greatest torque along the manoeuvres.
    motion_torque: Union[float, None]
    #: Greatest speed along the manoeuvres, degrees per second.
    motion_speed_deg: Union[float, None]


class CrankMotionRecord(Record):
    """A crank along a motion."""

    #: Leg, from 1.
    leg: int
    #: The least angle, degrees.
    least_deg: ExtremeRecord
    #: The greatest angle, degrees.
    greatest_deg: ExtremeRecord
    #: Greatest speed, degrees per second.
    speed_deg: ExtremeRecord
    #: Greatest acceleration, degrees per second squared.
    acceleration_deg: ExtremeRecord
    #: Greatest torque about the axis, force units times design units. Null: no masses are known, or
    #: torques are not determined. Cranks and rods count as massless.
    torque: Union[ExtremeRecord, None]
    #: RMS torque over time, force units times design units.
    rms_torque: Union[float, None]
    #: Greatest power, watts; negative: the drive brakes.
    power_w: Union[ExtremeRecord, None]


class DecouplingLeg(Record):
    """A sixth leg that allows a solution of the platform in steps, each a polynomial of low degree."""

    case: Union[Literal["off_the_line", "to_the_line", "to_the_joint"], None]
    #: The body.
    body: Union[Body, None]
    #: The four legs, counted from 1.
    legs: Union[tuple[int, ...], None]


class DefaultSafetyMarginRecord(Record):
    """The result for a default safety margin that the design does not state itself."""

    #: Safety margin of every limit, percent.
    percent: float
    #: Whether the platform found keeps it. False: no platform with it was found, and the search continued
    #: without it. Null: the search with it was interrupted.
    kept: Union[bool, None]
    #: Result in words.
    message: str


class DependencyRecord(Record):
    """A linear dependency of leg vectors: `sum c_i v_i = 0`."""

    #: Legs with nonzero coefficients, from 1.
    legs: tuple[int, ...]
    #: The numbers `c_i`.
    coefficients: tuple[Union[float, None], ...]
    #: `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
    constant: Union[float, None]
    #: Dimension spanned by the base ends.
    base_dimension: int
    #: Dimension spanned by the platform ends.
    platform_dimension: int
    #: Relative difference of `sum c_i s_i` at the design lengths from `constant`; null without lengths.
    lengths_defect: Union[float, None]


class DerivationRecord(Record):
    """The derivation of A, c and det A for one platform of the class from coplanar joints, with the forward kinematics as a check."""

    #: Whether numbers are exact: the joints are exact, and each moved joint lies exactly on its line.
    #: Otherwise the numbers are doubles.
    exact: bool
    #: Row of A of each moved leg, with all offsets at once, from the legs of the octahedral platform.
    moves: tuple[LegSlideRecord, ...]
    #: The moves one at a time, each from the legs before it; det A is the product of their `rest`. Null:
    #: every order of single moves puts two legs on one another.
    sequence: Union[tuple[LegSlideRecord, ...], None]
    #: The factors of det A.
    factors: tuple[FactorRecord, ...]
    #: Products over all offsets; det A is their difference. Null: some leg is not moved.
    products: Union[OffsetProductsRecord, None]
    #: Check by forward kinematics, solved independently, and the leg map from one to the other.
    verification: VerifyAnswer


class Design(Record):
    """A design file of equipod, as JSON; a TOML file has the same structure. What no schema can say (joints of legs exist, axes are not zero, rotations are rotations) is checked by the program."""

    #: name of the design, not blank
    name: str
    #: label of the length unit of every length in the file
    units: str
    #: `[base joint, platform joint]` in leg order; in TOML above the first table
    legs: tuple[tuple[str, ...], ...]
    #: joints in the base frame, each as `[x, y, z]` or as a construction
    base: DesignBody
    #: joints in the platform frame, each as `[x, y, z]` or as a construction
    platform: DesignBody
    #: unit of all forces, default newtons; torques are in force units times the length unit
    force_units: Union[Literal["N", "kN", "kgf", "lbf"], None]
    #: unit of all masses, default kilograms
    mass_units: Union[Literal["g", "kg", "t", "lb"], None]
    #: where the numbers come from
    source: Union[str, None]
    #: free text
    description: Union[str, None]
    #: revision of the design, as drawings and parts name it
    revision: Union[str, None]
    #: `prismatic`: legs change their lengths; `rotary`: the legs are rods of constant length on cranks,
    #: the base joints are the centres of the cranks, and `[cranks]` is required
    drive: Union[Literal["prismatic", "rotary"], None]
    #: leg lengths in leg order, which `equipod fk` takes without `--lengths`
    lengths: Union[tuple[DesignNotNegative, ...], None]
    #: numbers and expressions that expressions of joints and of other parameters name
    parameters: Union[dict[str, DesignQuantity], None]
    #: cranks and rods of a rotary design: keys for all, and tables named by base joints for single cranks
    cranks: Union[dict[str, DesignCrank], None]
    #: the pose the platform is built for
    home: Union[DesignHomePose, None]
    #: convention of the poses that commands read and write
    frames: Union[dict[str, Any], None]
    #: the poses to reach
    workspace: Union[dict[str, Any], None]
    #: variables and objectives of the optimiser
    optimize: Union[dict[str, Any], None]
    #: sizes and limits of joints, legs and drives
    hardware: Union[dict[str, Any], None]
    #: speed that the platform has to reach in every direction
    speed: Union[dict[str, Any], None]
    #: stiffness that the platform needs on its legs at every pose; needs `leg_stiffness` of `[hardware]`
    stiffness: Union[dict[str, Any], None]
    #: wrenches the legs have to hold, one at a time
    loads: Union[tuple[dict[str, Any], ...], None]
    #: bodies the legs must not touch, each a box, a sphere or a capsule
    keep_out: Union[tuple[Any, ...], None]
    #: mass, inertia and size of the payload
    payload: Union[dict[str, Any], None]
    #: space that plates and machine may occupy
    envelope: Union[dict[str, Any], None]
    #: grids of holes for the joints, in both plates or in one
    holes: Union[dict[str, Any], None]
    #: the plates that carry the joints: sizes, material, holes and bolts
    plates: Union[dict[str, Any], None]
    #: safety margins to each limit
    limits: Union[dict[str, Any], None]
    #: results of `equipod calibrate` beside the joints
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

    #: length of each crank, from its centre to its tip
    length: Union[DesignQuantity, None]
    #: length of each rod, from the tip to the platform joint
    rod_length: Union[DesignQuantity, None]
    #: direction of the axis, base frame; angles are positive by the right-hand rule
    axis: Union[tuple[DesignQuantity, ...], None]
    #: direction of the tip at the angle 0, base frame; its part along the axis is ignored
    zero: Union[tuple[DesignQuantity, ...], None]
    #: side of the crank: the greater (`plus`) or the smaller (`minus`) of its two angles for a pose,
    #: around the angle at which the tip is nearest to the platform joint
    elbow: Union[Literal["plus", "minus"], None]
    #: `[least, greatest]` angle, degrees; no limit when absent
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

    #: position of the platform origin, base frame
    position: tuple[DesignQuantity, ...]
    #: roll, pitch, yaw in degrees, `R = Rz(yaw) Ry(pitch) Rx(roll)`; give exactly one of `rpy_deg`,
    #: `quat_wxyz` and `rotation`
    rpy_deg: Union[tuple[DesignQuantity, ...], None]
    #: quaternion, scalar part first, normalised; its norm is within 1e-3 of 1
    quat_wxyz: Union[DesignQuaternion, None]
    #: rows of R, orthonormal within 1e-9 and right-handed
    rotation: Union[DesignRows, None]


class DesignJointModel(Record):
    """DesignJointModel"""

    #: `ball`: rotates freely in a cone; `universal`: two axes, the first fixed in the body, the second at
    #: a right angle to it and to the leg; `flexure`: bends about its centre, within the cone angle
    model: Literal["ball", "universal", "flexure"]
    #: universal: direction of the first axis in the frame of the body, one for all joints or six in leg
    #: order, and one in each table of a list; required
    first_axis: Union[DesignVector, tuple[DesignVector, ...], None]
    #: universal: greatest angles about the first and about the second axis, in both directions, degrees;
    #: no limit when absent
    angle_deg: Union[tuple[float, float], None]
    #: universal: distance of the two axes, which meet when it is 0
    offset: Union[DesignNotNegative, None]
    #: space that the joint occupies, in place of the housing of the body: a diameter, or edge lengths of a
    #: box along the axes of the body
    housing: Union[DesignHousing, None]
    #: greatest angle between the leg and the axis of the joint, in place of the angle of the body
    #: (`base_cone_angle_deg`, `platform_cone_angle_deg`)
    cone_angle_deg: Union[float, None]
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

    #: position of the platform origin, base frame
    position: DesignVector
    #: roll, pitch, yaw in degrees, `R = Rz(yaw) Ry(pitch) Rx(roll)`; give exactly one of `rpy_deg`,
    #: `quat_wxyz` and `rotation`
    rpy_deg: Union[DesignVector, None]
    #: quaternion, scalar part first, normalised; its norm is within 1e-3 of 1
    quat_wxyz: Union[DesignQuaternion, None]
    #: rows of R, orthonormal within 1e-9 and right-handed
    rotation: Union[DesignRows, None]


class DesignSourceRecord(Record):
    """A design of an answer."""

    #: The name of the design.
    name: str
    #: File as named; null: the design was made in memory, and its text is the text it would be saved as.
    path: Union[str, None]
    #: SHA-256 of file or text, hexadecimal.
    sha256: str


class DesignSphere(Record):
    """DesignSphere"""

    center: DesignVector
    diameter: DesignPositive


class DeviationRecord(Record):
    """A standard deviation over the poses evaluated."""

    #: The median over the poses.
    median: Union[float, None]
    #: The greatest value.
    greatest: Union[float, None]
    #: Value with independent errors at the same pose.
    independent: Union[float, None]
    #: The pose with the greatest value.
    pose: PoseQuaternionRecord
    #: Covariance of tool point (design units) and rotation vector (degrees) there, base frame.
    covariance: tuple[tuple[Union[float, None], ...], ...]


class DifferenceRecord(Record):
    """An invariant that distinguishes two designs."""

    #: The invariant.
    invariant: Invariant
    #: Its value for the first design.
    a: Union[float, None]
    #: Its value for the second.
    b: Union[float, None]
    #: The difference of both values.
    gap: Union[float, None]
    #: The threshold for a difference.
    bound: Union[float, None]


class DiscsRecord(Record):
    """Discs in the complex plane, in some arrangement."""

    #: Real parts of centres.
    re: tuple[tuple[Union[float, None], ...], ...]
    #: Imaginary parts of centres.
    im: tuple[tuple[Union[float, None], ...], ...]
    #: Radii.
    radius: tuple[tuple[Union[float, None], ...], ...]


class DiscsRecord2(Record):
    """Discs in the complex plane, in some arrangement."""

    #: Real parts of centres.
    re: tuple[Union[float, None], ...]
    #: Imaginary parts of centres.
    im: tuple[Union[float, None], ...]
    #: Radii.
    radius: tuple[Union[float, None], ...]


class DistancePolynomialRecord(Record):
    """The polynomial in the squared distance of two joints whose roots are its values at all poses. Mirror images of a planar design have one root."""

    #: Two joints with unknown squared distance.
    unknown: tuple[str, ...]
    #: Names of unknowns.
    unknowns: tuple[str, ...]
    #: Degree with spurious factors.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: Exponents of the unknowns by term.
    exponents: tuple[tuple[int, ...], ...]
    #: Exact coefficients, integers as decimal text; for one unknown the constant comes first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: Their multiplicities.
    real_root_multiplicities: tuple[int, ...]
    #: Reason for no trilateration polynomial.
    no_sequence: str
    #: Coefficient bounds [low, high]; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class DriveRecord(Record):
    """A drive of the table, in the units of the design."""

    #: The name of the drive.
    name: str
    #: Line of the table, from 1.
    line: int
    #: Whether it fits: true and false are proved; null: undecided.
    fits: Union[bool, None]
    #: Whether all safety margins are kept too: true and false are proved; null: undecided.
    safety_margin_kept: Union[bool, None]
    #: The travel, design units.
    stroke: Union[float, None]
    #: Least and greatest joint distance, design units.
    leg_length: tuple[Union[float, None], ...]
    #: Greatest force; null: not in the table.
    force: Union[float, None]
    #: Greatest speed; null: not in the table.
    speed: Union[float, None]
    #: Mass; null: not in the table.
    mass: Union[float, None]
    #: Stiffness along the drive; null: not in the table.
    stiffness: Union[float, None]
    #: Price; null: not in the table.
    price: Union[float, None]
    #: Source of its numbers; null: not in the table.
    source: Union[str, None]
    #: Result of `assess`.
    assessment: AssessAnswer
    #: Results along requested motions.
    motions: tuple[MotionRunRecord, ...]


class DriveSearchRecord(Record):
    """The search over the drives of a table."""

    #: Drive of the answer; null: no drive leads to a platform that is proved to meet the requirements.
    chosen: Union[str, None]
    #: Criterion of the choice.
    ranked_by: DriveRanking
    #: Currency of prices; null: the table names none.
    currency: Union[str, None]
    #: Whether the search was interrupted.
    interrupted: bool
    #: Result in words.
    message: str
    #: Drives, best first.
    drives: tuple[SearchedDriveRecord, ...]


class DriveSolutionRecord(Record):
    """The iteration for the pose with given drive lengths."""

    #: Status of the solution.
    status: DriveSolutionWord
    #: Reason for no pose; null: there is one.
    reason: Union[str, None]
    #: The lengths that the drives show, design units.
    lengths: tuple[float, ...]
    #: Joint distances at the pose, design units.
    distances: tuple[float, ...]
    #: Number of fixed-point steps.
    steps: int
    #: Greatest ratio of successive corrections; 0 if there were none above rounding.
    factor: Union[float, None]
    #: Proved bound on the position error, design units.
    position_bound: Union[float, None]
    #: Proved bound on the angle error, degrees.
    angle_bound_deg: Union[float, None]
    #: Contraction of the Newton map at the pose; null: not proved.
    contraction: Union[float, None]


class DrivesAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Whether some drive fits: true and false are proved; null: undecided.
    met: Union[bool, None]
    #: Name of the chosen drive: the cheapest that is proved to fit, the lightest of equally cheap ones;
    #: null: there is none.
    chosen: Union[str, None]
    #: Drives, fitting ones first, then undecided and unfit ones; within each group by price, then mass.
    drives: tuple[DriveRecord, ...]
    #: Currency of prices; null: the table names none.
    currency: Union[str, None]
    #: The unit of lengths; speeds are in this unit per second.
    length_unit: str
    #: The unit of forces.
    force_unit: str
    #: The unit of masses.
    mass_unit: str
    #: Values assumed, one sentence each.
    assumptions: tuple[str, ...]
    #: The design with the chosen drive; null: none fits.
    design: Union[Design, None]
    #: The file written.
    output: Union[str, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class EnclosureRecord(Record):
    """Discs that contain the entries of R and p of a root."""

    #: Rotation matrix entries, rows.
    R: DiscsRecord
    #: Position entries, design units.
    p: DiscsRecord2


class ErrorMapRecord(Record):
    """The greatest errors of the pose by all causes together, to first order."""

    #: Greatest joint error, in any direction, design units.
    joint_error: Union[float, None]
    #: Greatest error of a leg length, design units.
    length_error: Union[float, None]
    #: Relative expansion by part: base, platform and legs, with either sign.
    growth: tuple[Union[float, None], ...]
    #: Number of poses evaluated: the corners and a sample of the region, and the listed poses.
    poses: int
    #: Error of the tool point, design units.
    position: GreatestErrorRecord
    #: Error of the orientation, degrees.
    rotation_deg: GreatestErrorRecord
    #: Table written; null: none.
    path: Union[str, None]


class EvaluationRecord(Record):
    """The quality of a design."""

    #: Worst inverse condition number.
    objective: Union[float, None]
    #: The pose of this value.
    worst_pose: PoseQuaternionRecord
    #: Least distances of joints, base and platform.
    least_distances: tuple[Union[float, None], ...]
    #: det A; null: there is no leg map.
    det: Union[float, None]
    #: Least margin by requirement.
    requirements: tuple[RequirementMarginRecord, ...]
    #: Whether all requirements are met.
    met: bool
    #: Whether all safety margins are kept.
    safety_margin_kept: bool


class ExactNumberRecord(Record):
    """A number, exact or as a double."""

    #: The nearest double.
    value: Union[float, None]
    #: Number as an exact expression, such as 4/5 or 1/2 + sqrt(3)/6; null: known only as a double.
    exact: Union[str, None]


class ExactRoundingOutcome(Record):
    """The exact rounding, or the reason why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: Whether equivalence with its own octahedral platform is proved.
    proved: Union[bool, None]
    #: Verdict of leg map and forward kinematics.
    verdict: Union[RoundingVerdict, None]
    #: Whether rotations by 120 degrees keep both bodies.
    three_fold: Union[bool, None]
    #: Offsets around the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: Figures of the rounded design.
    evaluation: Union[EvaluationRecord, None]
    #: Search statistics.
    search: Union[RoundingSearchRecord, None]
    #: The obstacle.
    error: Union[NoRoundingError, None]


class ExactRoundingRecord(Record):
    """A rounding with all joints exactly on the sides of two triangles, with holes as their corners."""

    #: The grids used.
    grids: GridsRecord
    #: Whether equivalence with its own octahedral platform is proved.
    proved: bool
    #: Verdict of leg map and forward kinematics.
    verdict: RoundingVerdict
    #: Whether rotations by 120 degrees keep both bodies.
    three_fold: bool
    #: Offsets around the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: Figures of the rounded design.
    evaluation: EvaluationRecord
    #: Search statistics.
    search: RoundingSearchRecord


class ExploreAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Verdict of the run.
    verdict: Union[ExploreVerdict, None]
    #: Verdict in words, with the numbers that decided.
    explanation: Union[str, None]
    #: Whether the time limit or the caller ended the search, or an assessment before its verdict.
    interrupted: Union[bool, None]
    #: The name of the design.
    name: Union[str, None]
    #: Files written.
    paths: Union[tuple[str, ...], None]
    #: The equivalence class.
    family: Union[FamilySizeRecord, None]
    #: Result of `assess`; null: there is none, or the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform found; null: none.
    optimize: Union[OptimizedRecord, None]
    #: Number of conic programs solved by clarabel; searches with other drives, for freedoms and for holes
    #: are not counted.
    conic_programs: Union[int, None]
    #: The cost of separate joints: figures of the design and of the platform to build; null: there is
    #: none.
    price: Union[PriceRecord, None]
    #: Result for the default safety margin of 5 %; null: the design states its own.
    safety_margin: Union[DefaultSafetyMarginRecord, None]
    #: Comparison with the optimised platform; null: there is none.
    verify: Union[ComparedRecord, None]
    #: Platform on holes; null: the design states no holes, or no platform was found. The assessment
    #: applies to this platform.
    holes: Union[OnHolesRecord, None]
    #: Searches with one more freedom, each with its search result. Null: a platform meets the
    #: requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: Result for the three-fold symmetry. Null: the design has none or names one, or the search could not
    #: break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: Drives of the table with their results; null: no table was given. The rest of the answer is about
    #: the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: Poses of the design.
    fk: Union[PoseTotalsRecord, None]
    #: Stages, in order.
    stages: Union[tuple[StageRecord, ...], None]
    #: The families of replaceable legs.
    components: Union[FamiliesFoundRecord, None]
    #: Search for an equivalent without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the nearest equivalent platform meets the requirements: true and false are proved. Null:
    #: undecided, not assessed, or nothing is required.
    nearest_meets_requirements: Union[bool, None]


class ExploreGeneralAnswer(Record):
    """The answer of `explore` about a design that is not octahedral."""

    #: Verdict of the run.
    verdict: ExploreVerdict
    #: Verdict in words, with the numbers that decided.
    explanation: str
    #: The name of the design.
    name: str
    #: Files written.
    paths: tuple[str, ...]
    #: Stages, in order.
    stages: tuple[StageRecord, ...]
    #: The families of replaceable legs.
    components: FamiliesFoundRecord
    #: Search for an equivalent without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the nearest equivalent platform meets the requirements: true and false are proved. Null:
    #: undecided, not assessed, or nothing is required.
    nearest_meets_requirements: Union[bool, None]
    #: Comparison with the equivalent platform, or of the nearest octahedral platform with its equivalent.
    #: Null: neither exists.
    verify: Union[ComparedRecord, None]
    #: Poses of the design.
    fk: PoseTotalsRecord


class ExploreOctahedralAnswer(Record):
    """The answer of `explore` about an octahedral design."""

    #: Verdict of the run.
    verdict: ExploreVerdict
    #: Verdict in words, with the numbers that decided.
    explanation: str
    #: Whether the time limit or the caller ended the search, or an assessment before its verdict.
    interrupted: bool
    #: The name of the design.
    name: str
    #: Files written.
    paths: tuple[str, ...]
    #: The equivalence class.
    family: FamilySizeRecord
    #: Result of `assess`; null: there is none, or the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform found; null: none.
    optimize: Union[OptimizedRecord, None]
    #: Number of conic programs solved by clarabel; searches with other drives, for freedoms and for holes
    #: are not counted.
    conic_programs: int
    #: The cost of separate joints: figures of the design and of the platform to build; null: there is
    #: none.
    price: Union[PriceRecord, None]
    #: Result for the default safety margin of 5 %; null: the design states its own.
    safety_margin: Union[DefaultSafetyMarginRecord, None]
    #: Comparison with the optimised platform; null: there is none.
    verify: Union[ComparedRecord, None]
    #: Platform on holes; null: the design states no holes, or no platform was found. The assessment
    #: applies to this platform.
    holes: Union[OnHolesRecord, None]
    #: Searches with one more freedom, each with its search result. Null: a platform meets the
    #: requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: Result for the three-fold symmetry. Null: the design has none or names one, or the search could not
    #: break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: Drives of the table with their results; null: no table was given. The rest of the answer is about
    #: the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: Poses of the design.
    fk: PoseTotalsRecord


class ExtremeRecord(Record):
    """A value with its time."""

    #: The signed value.
    value: Union[float, None]
    #: Time, seconds.
    time_s: float


class FactorRecord(Record):
    """A factor of det A."""

    #: Formula in the offsets, such as 1 - t1.
    formula: str
    #: Equation of zeros; the platform is architecturally singular there.
    zero: str
    #: Value at the offsets.
    value: ExactNumberRecord


class FailureRecord(Record):
    """A refusal or a failure."""

    #: A stable short code, `fk::not_applicable` for example.
    code: str
    #: Message in words.
    message: str
    #: Faults; empty for other failures.
    violations: tuple[ViolationRecord, ...]
    #: The remedy.
    help: Union[str, None]
    #: The design file concerned.
    path: Union[str, None]


class FamiliesFoundRecord(Record):
    """A summary of the families of replaceable legs."""

    #: Number of families.
    count: int
    #: Whether the list of families is complete.
    complete: bool


class FamilyAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Legs along the hexagon, from 1.
    cyclic_order: tuple[int, ...]
    #: Edges of the hexagon, design units.
    edge_lengths: tuple[Union[float, None], ...]
    #: Numbers of patterns and topologies.
    counts: CountsRecord
    #: Patterns, or the requested one.
    patterns: tuple[PatternRecord, ...]
    #: Ways to share joints.
    topologies: tuple[FamilyTopologyRecord, ...]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Platform at the offsets given, with `--offsets`.
    instance: Union[InstanceRecord, None]
    #: Derivation of the leg map from coplanar joints, with `--explain`.
    derivation: Union[DerivationRecord, None]


class FamilySizeRecord(Record):
    """The number of platforms equivalent to an octahedral one."""

    #: Number of patterns of legs.
    patterns: int
    #: Number of topologies: ways to share joints.
    topologies: int


class FamilyTopologyRecord(Record):
    """A way in which the legs of equivalent platforms share joints."""

    #: Topology number, from 1.
    topology: int
    #: Joints of the base.
    base_joints: int
    #: Joints of the platform.
    platform_joints: int
    #: Joints of several legs.
    shared_joints: int
    #: Whether offsets one at a time lead to it.
    sequential: bool
    #: Pattern with this topology.
    example: str
    #: Topologies one offset further, from 1.
    next: tuple[int, ...]


class FarPoses(Record):
    """Poses far out, certified in coordinates that are regular at infinity."""

    #: Number of poses: two that are too close to be told apart, or one.
    poses: int
    #: Lower bound on their largest rotation entry.
    rotation: float
    #: It is at most this; null: they may be at infinity.
    rotation_at_most: Union[float, None]


class FiguresRecord(Record):
    """The figures of a design over the poses of its workspace, or at home if it states none. Null: the design does not specify the quantity, or the value is infinite."""

    #: Name of the design.
    name: str
    #: The design file.
    path: str
    #: The result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Lightest drive that meets the requirements, from the table that the design names; null: it names
    #: none.
    lightest_drive: Union[LightestDriveRecord, None]
    #: Poses of all figures.
    assessed_poses: AssessedPosesRecord
    #: Number of poses evaluated; the assessment and the conditioning use poses of their own.
    poses: int
    #: Least leg length; null: the legs are rods on cranks.
    shortest: Union[float, None]
    #: Greatest leg length; null: the legs are rods on cranks.
    longest: Union[float, None]
    #: Greatest minus least leg length.
    stroke: Union[float, None]
    #: Number of different leg lengths, or rod lengths on cranks; a difference counts above a millionth of
    #: the size.
    different_legs: int
    #: Greatest leg force under weight and each load, one at a time.
    force: Union[float, None]
    #: Greatest leg speed at the required platform speed.
    speed: Union[float, None]
    #: Greatest leg force along the manoeuvres.
    motion_force: Union[float, None]
    #: Greatest leg speed along the manoeuvres.
    motion_speed: Union[float, None]
    #: Greatest drive power along the manoeuvres, watts.
    motion_power_w: Union[float, None]
    #: Worst conditioning of `assess`: the least inverse condition number.
    conditioning: Union[float, None]
    #: Least stiffness against forces through the platform origin, force units per design unit.
    stiffness: Union[float, None]
    #: Lowest natural frequency, hertz.
    frequency_hz: Union[float, None]
    #: Least distance of base joint centres, design units.
    base_spacing: Union[float, None]
    #: Least distance of platform joint centres, design units.
    platform_spacing: Union[float, None]
    #: Least leg clearance, design units.
    clearance: Union[float, None]
    #: Greatest distance of base joints from their centroid, design units.
    base_radius: Union[float, None]
    #: Greatest distance of platform joints from their centroid, design units.
    platform_radius: Union[float, None]
    #: Greatest error of all joints that keeps the accuracy, design units.
    joint_tolerance: Union[float, None]
    #: Reason for no tolerance; null: there is one, or none was requested.
    no_tolerance: Union[str, None]
    #: Assumptions about masses, one sentence each. Empty: no figure is a force, a torque or a natural
    #: frequency.
    assumptions: tuple[str, ...]
    #: Crank angles, torques and speeds; null: the legs change their lengths.
    cranks: Union[CrankFiguresRecord, None]


class FileSourceRecord(Record):
    """A file other than a design."""

    #: File as named.
    path: str
    #: SHA-256 of its bytes, hexadecimal.
    sha256: str


class FkAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: The convention of `in_frames`.
    frames: Union[PoseConventionRecord, None]
    #: The unit of lengths.
    units: Union[str, None]
    #: Rows of the file.
    rows: Union[tuple[FkRowRecord, ...], None]
    #: The method that found them.
    method: Union[Method, None]
    #: Completeness of the list.
    completeness: Union[CompletenessWord, None]
    #: Evidence for completeness.
    completeness_reason: Union[str, None]
    #: Proof that all poses up to a distance are listed; null: another proof, or none.
    bound: Union[BoundedProof, None]
    #: Whether every path is accounted for; false: poses may be missing.
    all_paths_accounted: Union[bool, None]
    #: Number of `solutions`.
    finite_count: Union[int, None]
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: Union[int, None]
    #: Number of real poses.
    real_count: Union[int, None]
    #: Number of poses that may be real.
    undecided_count: Union[int, None]
    #: Number of finite poses without certificate, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first; the text and `--csv` number them from 1 in this order.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: Homotopy paths.
    paths: Union[tuple[PathRecord, ...], None]
    #: Rejected candidates.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Uncertified path ends: there may be one pose, several or none near each. They are not among the
    #: solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: Library computations of `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: Meaning of null for non-finite numbers.
    notes: Union[tuple[str, ...], None]
    #: Crank angles, if given. The legs are then the rods from the crank tips, rounded to doubles, and
    #: certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: Tracking, with `--near`.
    near: Union[NearRecord, None]
    #: Iteration for non-ideal joints. The given lengths are then drive lengths, and no root gets a
    #: certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: Polynomial in the Cayley parameter c3, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether the dimension is proved for the lengths as written. False: the lengths satisfy it only
    #: within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Degree of the set, with as many points of a general section; null: points may be missing.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkOneAnswer(Record):
    """The poses with one set of lengths, and further results on request."""

    #: The method that found them.
    method: Method
    #: Completeness of the list.
    completeness: CompletenessWord
    #: Evidence for completeness.
    completeness_reason: str
    #: Whether every path is accounted for; false: poses may be missing.
    all_paths_accounted: bool
    #: Number of `solutions`.
    finite_count: int
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: int
    #: Number of real poses.
    real_count: int
    #: Number of poses that may be real.
    undecided_count: int
    #: Number of finite poses without certificate, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first; the text and `--csv` number them from 1 in this order.
    solutions: tuple[SolutionRecord, ...]
    #: Homotopy paths.
    paths: tuple[PathRecord, ...]
    #: Rejected candidates.
    rejected: tuple[RejectedRecord, ...]
    #: Uncertified path ends: there may be one pose, several or none near each. They are not among the
    #: solutions.
    unproved: tuple[SolutionRecord, ...]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The unit of lengths; of a row of a table that of the whole answer.
    units: Union[str, None]
    #: Proof that all poses up to a distance are listed; null: another proof, or none.
    bound: Union[BoundedProof, None]
    #: Library computations of `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: Meaning of null for non-finite numbers.
    notes: Union[tuple[str, ...], None]
    #: Crank angles, if given. The legs are then the rods from the crank tips, rounded to doubles, and
    #: certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: Tracking, with `--near`.
    near: Union[NearRecord, None]
    #: Iteration for non-ideal joints. The given lengths are then drive lengths, and no root gets a
    #: certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: Polynomial in the Cayley parameter c3, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether the dimension is proved for the lengths as written. False: the lengths satisfy it only
    #: within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Degree of the set, with as many points of a general section; null: points may be missing.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkRowRecord(Record):
    """One row of a file of lengths."""

    #: Line of the table, from 1.
    line: int
    #: The six lengths, design units; for given crank angles, the rod lengths.
    lengths: tuple[float, ...]
    #: The time of the row, if the file has a column of times.
    time: Union[float, None]
    #: Crank angles, if given.
    angles_deg: Union[tuple[float, ...], None]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The unit of lengths; of a row of a table that of the whole answer.
    units: Union[str, None]
    #: The method that found them.
    method: Union[Method, None]
    #: Completeness of the list.
    completeness: Union[CompletenessWord, None]
    #: Evidence for completeness.
    completeness_reason: Union[str, None]
    #: Proof that all poses up to a distance are listed; null: another proof, or none.
    bound: Union[BoundedProof, None]
    #: Whether every path is accounted for; false: poses may be missing.
    all_paths_accounted: Union[bool, None]
    #: Number of `solutions`.
    finite_count: Union[int, None]
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: Union[int, None]
    #: Number of real poses.
    real_count: Union[int, None]
    #: Number of poses that may be real.
    undecided_count: Union[int, None]
    #: Number of finite poses without certificate, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first; the text and `--csv` number them from 1 in this order.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: Homotopy paths.
    paths: Union[tuple[PathRecord, ...], None]
    #: Rejected candidates.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Uncertified path ends: there may be one pose, several or none near each. They are not among the
    #: solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: Library computations of `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: Meaning of null for non-finite numbers.
    notes: Union[tuple[str, ...], None]
    #: Whether all angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: Tracking, with `--near`.
    near: Union[NearRecord, None]
    #: Iteration for non-ideal joints. The given lengths are then drive lengths, and no root gets a
    #: certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: Polynomial in the Cayley parameter c3, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether the dimension is proved for the lengths as written. False: the lengths satisfy it only
    #: within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: Degree of the set, with as many points of a general section; null: points may be missing.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]
    #: Failure of this row.
    error: Union[FailureRecord, None]


class FkRowsAnswer(Record):
    """The poses with the lengths of each row of a file."""

    #: The convention of `in_frames`.
    frames: PoseConventionRecord
    #: The unit of lengths.
    units: str
    #: Rows of the file.
    rows: tuple[FkRowRecord, ...]


class FrameMotionRecord(Record):
    """The rigid motion with which measured joints are nearest to those of the design: a point x of the measurements is at R x + p."""

    #: The motion.
    motion: PoseRecord
    #: RMS of the remaining distances, design units.
    rms: Union[float, None]


class FrameMotionsRecord(Record):
    """Two rigid motions."""

    #: Motion of the base frame.
    base: FrameMotionRecord
    #: Motion of the platform frame.
    platform: FrameMotionRecord


class FreeRangeRecord(Record):
    """The free travel of one of the six numbers of a pose."""

    #: The pose coordinate: `x`, `y`, `z`, and `roll`, `pitch`, `yaw` or the angles of another order.
    axis: str
    #: `deg` or `rad`, or the unit of length.
    unit: str
    #: Value at the pose.
    value: float
    #: Travel towards smaller values.
    back: TravelRecord
    #: Travel towards greater values.
    forth: TravelRecord
    #: Smaller one of both travels: the number can move by this much either way.
    symmetric: float
    #: Greatest speed of this number alone at the pose, `unit` per second; null: the drives have no speed
    #: limit.
    greatest_speed: Union[float, None]
    #: Greatest force along the axis, or torque about it at the pivot, that the drives hold at the pose
    #: without weights. Null: the drives have no force limit.
    greatest_effort: Union[float, None]
    #: Unit of `greatest_effort`.
    effort_unit: str


class FreeSizeRecord(Record):
    """The largest free size of a region around home."""

    #: Largest size with all poses proved regular and allowed; 0: nothing is proved.
    proved: float
    #: Largest size without violation found.
    searched: float
    #: Requirement violated just beyond; null: none was found.
    binds: Union[LimitRecord, None]


class FreeTurnRecord(Record):
    """The free rotation of the platform about an axis."""

    #: Base frame axis: `x`, `y` or `z`.
    axis: str
    #: Free angle, negative sense, degrees, given as a positive number.
    back_deg: float
    #: Requirement that ends it; null: none within half a turn.
    back_binds: Union[LimitRecord, None]
    #: Free angle, positive sense, degrees.
    forth_deg: float
    #: Requirement that ends it; null: none within half a turn.
    forth_binds: Union[LimitRecord, None]


class FreedomRecord(Record):
    """A freedom that the design does not allow, and the result of the search with it."""

    #: The freedom.
    freedom: Freedom
    #: The outcome of the search.
    outcome: FreedomWord
    #: Relaxation of the limit in the last search, or by which the platform found is higher; null: no such
    #: number.
    amount: Union[float, None]
    #: Unit.
    unit: str
    #: Result in words.
    message: str
    #: Result of `assess`; null: none was found.
    assessment: Union[AssessAnswer, None]
    #: The platform found, with the relaxed limit; null: none was found.
    design: Union[Design, None]
    #: The design file written; null: none.
    output: Union[str, None]


class FrontMemberRecord(Record):
    """A member of a Pareto front."""

    #: First objective.
    objective: Union[float, None]
    #: All objectives.
    objectives: Union[tuple[ObjectiveRecord, ...], None]
    #: The chosen variables, without axes.
    variables: Union[tuple[VariableRecord, ...], None]
    #: The offsets `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: The displacements `t_i d_i`, design units; null if `edge_lengths` is null.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: The edges `d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    edge_lengths: Union[tuple[Union[float, None], ...], None]
    #: Legs in cyclic order, from 1; null: no offsets were chosen.
    cyclic_order: Union[tuple[int, ...], None]
    #: Zone of each offset: before, inside or beyond its edge; null: no offsets were chosen.
    branch: Union[str, None]
    #: det A of the leg map; null: the variables leave the equivalence class of the design.
    det: Union[float, None]
    #: Rows of A: s' = A s + c of squared leg lengths, legs in the order of the design. Null if `det` is
    #: null.
    A: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: The constant terms, design units squared; null if `det` is null.
    c: Union[tuple[Union[float, None], ...], None]
    #: The home pose, raised if its height was chosen.
    home: Union[PoseQuaternionRecord, None]
    #: The chosen joint axes.
    joint_axes: Union[JointAxesRecord, None]
    #: Margins of requirements, over many poses and computed independently of the search.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: Margins of the search's extra conditions.
    search_margins: Union[SearchMarginsRecord, None]
    #: The active bounds: ends of ranges and limits without any margin, and the growth of the bodies. Null:
    #: none.
    active_bounds: Union[ActiveBoundsRecord, None]
    #: Whether all requirements are proved; null: some are unproved.
    requirements_met: Union[bool, None]
    #: Result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Equivalence with the design; null: the variables leave the equivalence class.
    verify: Union[VerifiedRecord, None]
    #: Pose with the first objective's value; null: the objective is not the worst conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the successful run; null: a member of a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses held and checked.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design.
    design: Design
    #: The file written; null: none.
    output: Union[str, None]
    #: Objectives as compared on the front.
    non_dominated_at: tuple[Union[float, None], ...]


class GiveRecord(Record):
    """A requirement of a conflict."""

    #: The requirement.
    name: DemandWord
    #: Unit.
    unit: str
    #: Relaxation that suffices alone; null: no amount suffices.
    alone: Union[float, None]
    #: Relaxation if all give way together; the sum of these amounts, each in its scale, is least.
    together: Union[float, None]
    #: Relaxation in words.
    message: str


class GlobalBoundRecord(Record):
    """The proved upper bound over all offsets."""

    #: Greatest value that offsets within limits could reach.
    upper: Union[float, None]
    #: Relative gap of the bound above the solution.
    gap: Union[float, None]
    #: Number of searched boxes.
    boxes: int


class GreatestErrorRecord(Record):
    """The greatest error over the poses of a map."""

    #: Greatest error by all causes.
    greatest: Union[float, None]
    #: Part by joints, at the same pose.
    joints: Union[float, None]
    #: Part by lengths, at the same pose.
    lengths: Union[float, None]
    #: Part by expansion, at the same pose.
    growth: Union[float, None]
    #: The pose with the greatest error.
    pose: PoseQuaternionRecord
    #: The median over the poses, by all causes together.
    median: Union[float, None]


class GreatestResidualRecord(Record):
    """The residual of greatest size."""

    #: Line of the table.
    line: int
    #: The leg, from 1.
    leg: int
    #: Measured length minus model length, design units.
    value: Union[float, None]


class GridRecord(Record):
    """A grid of holes in the plane of a body."""

    #: Hole pattern.
    pattern: HolePattern
    #: Distance of neighbouring holes, or of the rings of a polar grid, design units; null for bolt
    #: circles.
    pitch: Union[float, None]
    #: The circles of the grid: the first ring of a polar grid, or all bolt circles; empty for the other
    #: patterns.
    circles: tuple[HoleCircleRecord, ...]
    #: Hole, or centre of the circles, body frame, design units.
    origin: tuple[Union[float, None], ...]
    #: The angle of the grid, degrees.
    angle_deg: Union[float, None]


class GridsRecord(Record):
    """The grids of both bodies."""

    #: The grid of the base; null: the base joints stay in place.
    base: Union[GridRecord, None]
    #: The grid of the platform; null: the platform joints stay in place.
    platform: Union[GridRecord, None]


class GriffisDuffyRecord(Record):
    """Joints on the sides of two triangles."""

    #: Legs around the hexagon, from 1.
    order: tuple[int, ...]
    #: Positions of joints on their sides, as a fraction from 0 to 1.
    t: tuple[Union[float, None], ...]
    #: Lengths of the sides, design units.
    side_lengths: tuple[Union[float, None], ...]
    #: `prod (1 - t) - prod t`; zero means singular.
    det: Union[float, None]
    #: Whether it is zero exactly.
    exactly_singular: bool
    #: Greatest distance of a joint from its side, relative to the size.
    deviation: Union[float, None]
    #: Greatest `deviation` for this type.
    deviation_limit: Union[float, None]
    #: Dependency of the legs for `det = 0`.
    coefficients: tuple[Union[float, None], ...]
    #: `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
    constant: Union[float, None]
    #: Relative difference of `sum c_i s_i` at the design lengths from `constant`; null without lengths.
    lengths_defect: Union[float, None]
    #: Assembly with the lengths of the design.
    assembly: Union[AssemblyRecord, None]


class HeldLineRecord(Record):
    """A line of a body that five legs hold."""

    #: The body.
    body: Body
    #: Leg joints along the line, measured from the joint of leg 1 in units of `length`.
    marks: tuple[Union[float, None], ...]
    #: Distance from leg 1 to the farthest joint, design units.
    length: Union[float, None]
    #: Equation that gives the line; null: the legs are dependent.
    class_: Union[LineClass, None]
    #: Number of poses of the line, real and complex, for generic lengths; null: not counted.
    generic_poses: Union[int, None]
    #: Singular poses of the line.
    singular_poses: LineLocusRecord


class HeldPosesRecord(Record):
    """Numbers of poses."""

    #: Number of poses held by the search.
    held: int
    #: Number of poses evaluated independently.
    checked: int


class HeldWrenchRecord(Record):
    """A wrench on the platform and what holds it."""

    #: Load; null: the wrench of `--wrench`.
    load: Union[str, None]
    #: The wrench on the platform.
    wrench: WrenchRecord
    #: Leg forces, positive where they push the platform, or torques of the cranks about their axes; null
    #: at a singular pose.
    forces: Union[tuple[Union[float, None], ...], None]


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
    #: Offsets as fractions of the edges.
    offsets: tuple[Union[float, None], ...]
    #: Rows of A: s' = A s + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: Joints of the base.
    base_joints: int
    #: Joints of the platform.
    platform_joints: int


class JoiningPathRecord(Record):
    """A path without singular pose between two assembly modes."""

    #: Numbers of the two modes, from 1.
    modes: tuple[int, ...]
    #: Poses of the path, joined by straight segments.
    poses: tuple[PoseQuaternionRecord, ...]


class JointAxesRecord(Record):
    """Joint axes: unit vectors, body frame; null: not chosen."""

    #: Axes at the base ends, base frame.
    base: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Axes at the platform ends, platform frame.
    platform: Union[tuple[tuple[Union[float, None], ...], ...], None]


class JointBudgetRecord(Record):
    """The error allowed at one joint while the others are exact."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: Error allowed in any direction.
    alone: JointLimitRecord
    #: The worst direction of the error, body frame.
    direction: tuple[Union[float, None], ...]
    #: Tool point error per joint error in that direction.
    position_per_unit: Union[float, None]
    #: Orientation error per joint error in that direction, degrees per design unit.
    rotation_deg_per_unit: Union[float, None]
    #: Errors allowed along the axes of the body, design units; null: no influence.
    along_axes: tuple[Union[float, None], ...]
    #: Half widths of the box of largest volume for all joints, design units; null: no influence.
    largest_product: tuple[Union[float, None], ...]


class JointLimitRecord(Record):
    """An allowed joint error with the bound that limits it."""

    #: Allowed error to first order, design units.
    value: Union[float, None]
    #: Error that reaches the bound to first order.
    reached: Union[float, None]
    #: Bound reached.
    limited_by: ErrorKind
    #: Pose at which it is reached.
    pose: PoseQuaternionRecord


class JointShiftRecord(Record):
    """The displacement of a joint."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: Displacement, body frame of the measurement; relative, the whole change has norm 1.
    shift: tuple[Union[float, None], ...]


class JointsRecord(Record):
    """The exactness of all joints of a design together."""

    #: Exactness of the least exact joint.
    exactness: ExactnessWord
    #: Integers with square roots in the coordinate field, beside the cosines of `divisions`; empty for
    #: fractions.
    radicands: tuple[int, ...]
    #: Numbers `n` with `cos(360 / n)` degrees in the coordinate field: some of 9, 16, 20 and 32.
    divisions: tuple[int, ...]
    #: Joints between bounds, with their bodies: `base.A2`.
    enclosed: tuple[str, ...]
    #: The exactness in words.
    explanation: str


class LeastConditioningRecord(Record):
    """The pose with the worst conditioning."""

    #: Inverse condition number of the Jacobian, with unit lines and moments divided by the characteristic
    #: length: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: The pose.
    pose: PoseQuaternionRecord
    #: The characteristic length, design units.
    characteristic_length: float


class LegMotionRecord(Record):
    """A leg along a motion."""

    #: The leg, from 1.
    leg: int
    #: The least length, design units.
    shortest: ExtremeRecord
    #: The greatest length, design units.
    longest: ExtremeRecord
    #: Greatest speed, design units per second; positive: the leg becomes longer.
    speed: ExtremeRecord
    #: Greatest acceleration, design units per second squared.
    acceleration: ExtremeRecord
    #: Greatest push, force units; 0: it only pulls. Null: no masses are known, or forces are not
    #: determined.
    push: Union[ExtremeRecord, None]
    #: Greatest pull, a negative force; 0: it only pushes.
    pull: Union[ExtremeRecord, None]
    #: RMS force over time, force units.
    rms_force: Union[float, None]
    #: Greatest power, watts; negative: the drive brakes.
    power_w: Union[ExtremeRecord, None]


class LegPathPoseRecord(Record):
    """A pose with all lengths but one."""

    #: Joint distance of the leg.
    length: float
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames


class LegSlideRecord(Record):
    """One leg that moves along the line of two legs with a joint in common. X, Y, Q and F are in one plane at every pose."""

    #: Moved leg.
    leg: int
    #: Legs X F and Y F, from 1.
    between: tuple[int, ...]
    #: The names of X and Y.
    ends: tuple[str, ...]
    #: New joint Q: Q = X + t (Y - X).
    moved: str
    #: The name of F, the joint that the leg keeps.
    fixed: str
    #: The offset t: s' = (1 - t) s(X F) + t s(Y F) - t (1 - t) d^2.
    offset: ExactNumberRecord
    #: 1 - t.
    rest: ExactNumberRecord
    #: Squared edge d^2 = |XY|^2, design units squared.
    square: ExactNumberRecord
    #: |XQ|^2 and |YQ|^2, design units squared.
    squares_to_ends: tuple[ExactNumberRecord, ...]
    #: The entry of c: -t (1 - t) d^2, design units squared.
    constant: ExactNumberRecord


class LibraryCallsRecord(Record):
    """A library of linear algebra computed this for an answer."""

    #: The library.
    library: str
    #: The kind of computation: `plu`, a triangular factor with partial pivoting, or `qz`, generalised
    #: eigenvectors.
    computation: str
    #: Rows and columns.
    size: tuple[int, ...]
    #: Number of calls.
    calls: int


class LightestDriveRecord(Record):
    """The lightest drive of the table with which the requirements of a design are met."""

    #: The name of the drive; null: no drive is proved to suffice.
    name: Union[str, None]
    #: Drive mass; null: the table has none, or no drive is proved to suffice.
    mass: Union[float, None]
    #: The unit of the mass.
    mass_unit: str
    #: Undecided lighter drives; all undecided drives if none is proved to suffice.
    undecided: tuple[str, ...]
    #: Result in words.
    message: str


class LimitRecord(Record):
    """A requirement that is active or violated."""

    #: The kind; null: a singular pose, where det J vanishes.
    name: Union[TermKind, None]
    #: The margin, negative for a violation; for a singular pose det J divided by its value at home.
    margin: Union[float, None]
    #: Unit; null: a pure ratio.
    unit: Union[str, None]
    #: Parts concerned: legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: Legs, from 1.
    legs: tuple[int, ...]


class LimitsAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: Convention in which poses were read, of `in_frames` and of `axes`.
    frames: PoseConventionRecord
    #: The pose of `--at`.
    pose: PoseQuaternionRecord
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Whether every requirement is met at the pose, and det J has the sign that it has at home.
    allowed: bool
    #: Violated requirements, the worst first.
    violated: tuple[LimitRecord, ...]
    #: Free travel of each pose coordinate alone (x, y, z, roll, pitch, yaw); empty: the pose is not
    #: allowed.
    axes: tuple[FreeRangeRecord, ...]
    #: Straight path to `--to`; null: none was requested, or it begins at a pose that is not allowed.
    straight_path: Union[StraightPathRecord, None]
    #: Allowed pose nearest to `--to`, or nearest to the pose of `--at` if that is not allowed. Null: every
    #: requested pose is allowed, or no allowed pose was found.
    nearest_allowed: Union[NearestAllowedRecord, None]
    #: Size of the workspace around home; null: `--workspace` was not given, or home is not allowed.
    workspace: Union[WorkspaceSizeRecord, None]
    #: Surface written; null: none was asked for, or the pose of `--at` is not allowed.
    surface: Union[str, None]
    #: The unit of lengths.
    length_unit: str
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class LineLocusRecord(Record):
    """The polynomial `F(p, v)` whose zeros are the singular poses of the line."""

    #: The form of the polynomial: `architecturally singular`, `quadratic in all`, `linear in the
    #: position`, `linear in the direction`, or `cubic`.
    family: str
    #: The degree of the polynomial.
    degree: int
    #: The degree in the position.
    degree_in_position: int
    #: The degree in the direction.
    degree_in_direction: int
    #: The terms of the polynomial. The position is the joint of leg 1 in the frame of the other body. The
    #: direction is a vector of length `length`.
    terms: tuple[LineTermRecord, ...]


class LinePoseRecord(Record):
    """A pose of a line in the frame of the other body."""

    #: Joint of leg 1, frame of the other body, design units.
    position: ComplexRecord
    #: Unit vector from leg 1 to the farthest joint, frame of the other body.
    direction: ComplexRecord
    #: Whether the pose is real, decided exactly.
    real: bool
    #: The multiplicity of the pose.
    multiplicity: int
    #: Greatest error of a position coordinate, design units.
    position_error: Union[float, None]
    #: Greatest error of a direction coordinate.
    direction_error: Union[float, None]


class LinePosesRecord(Record):
    """All poses of a line for given lengths."""

    #: Number of poses, real and complex, counted with multiplicity: proved in exact arithmetic.
    counted: int
    #: Number of real poses.
    real: int
    #: Polynomial of the poses, as decimal text, the constant first.
    coefficients: tuple[str, ...]
    #: Real ones first.
    poses: tuple[LinePoseRecord, ...]


class LineTermRecord(Record):
    """A term of a polynomial in the position and the direction of a line."""

    #: Exponents of `p_x, p_y, p_z, v_x, v_y, v_z`.
    exponents: tuple[int, ...]
    #: Integer as text.
    coefficient: str


class LocalOptimalityRecord(Record):
    """Evidence of local optimality."""

    #: Whether it converged: the model of the last step promised no further gain.
    converged: bool
    #: First-order gain per unit of the variables.
    stationarity: Union[float, None]
    #: Gain of a further pattern search; null: none was made.
    pattern_gain: Union[float, None]
    #: Number of points of the pattern search.
    pattern_trials: Union[int, None]


class LossRecord(Record):
    """The loss function of the fit, which limits the weight of outliers."""

    #: The kind of loss.
    loss: Loss
    #: Unit that is rejected together: a pose or a single leg length.
    of: LossUnit


class MapAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The relation of the two designs; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: The level of the proof; within rounding: nothing is proved.
    level: Level
    #: Whether the relation holds up to rounding; true for an exact relation too.
    holds_within_rounding: bool
    #: Relation in words, with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: Exact determinant, such as 64/243. Null: the identity of leg vectors is not proved in exact
    #: arithmetic, or the number is too long to read.
    det_exact: Union[str, None]
    #: Rows of A, exact; null if `det_exact` is null.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: Constant terms, exact, design units squared; null if `det_exact` is null.
    c_exact: Union[tuple[str, ...], None]
    #: Zeros of det A for single legs, exact. Such a leg has its ends on edges of FROM at the offset t. Its
    #: row of A has the entries 1 - t and t, the others zero. The list has the t for which det A vanishes
    #: while other legs stay fixed. An entry is null for other legs, or if no t exists. The list is null if
    #: `det_exact` is null.
    singular_offsets: Union[tuple[Union[str, None], ...], None]
    #: det A as an exact polynomial in the offsets t1 to t6, the other legs fixed. TO is singular exactly
    #: at its zeros. Null: no leg is of this kind, or `det_exact` is null.
    det_of_offsets: Union[str, None]
    #: Largest residual.
    residual: Union[float, None]
    #: Relative distance of each leg of TO from the span of FROM.
    residuals: tuple[Union[float, None], ...]
    #: Rank of the leg vectors of FROM.
    leg_rank: int
    #: Singular values of the normalised leg vectors of FROM.
    singular_values: tuple[Union[float, None], ...]
    #: Smallest over largest singular value of A.
    inverse_condition: Union[float, None]
    #: Decision thresholds.
    tolerances: MapTolerancesRecord
    #: Correspondence of the legs.
    correspondence: CorrespondenceRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Lengths carried from FROM to TO, with `--lengths`.
    lengths: Union[MappedLengthsRecord, None]
    #: Whether base and platform of the second design were exchanged.
    exchanged: Union[bool, None]
    #: Rigid motions that make the second design equivalent, with `--align`.
    alignment: Union[AlignmentRecord, None]
    #: The file written.
    output: Union[str, None]


class MapRecord(Record):
    """The affine map s(TO) = A s(FROM) + c between the squared leg lengths of two designs."""

    #: The relation of the two designs; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: The level of the proof; within rounding: nothing is proved.
    level: Level
    #: Whether the relation holds up to rounding; true for an exact relation too.
    holds_within_rounding: bool
    #: Relation in words, with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: Exact determinant, such as 64/243. Null: the identity of leg vectors is not proved in exact
    #: arithmetic, or the number is too long to read.
    det_exact: Union[str, None]
    #: Rows of A, exact; null if `det_exact` is null.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: Constant terms, exact, design units squared; null if `det_exact` is null.
    c_exact: Union[tuple[str, ...], None]
    #: Zeros of det A for single legs, exact. Such a leg has its ends on edges of FROM at the offset t. Its
    #: row of A has the entries 1 - t and t, the others zero. The list has the t for which det A vanishes
    #: while other legs stay fixed. An entry is null for other legs, or if no t exists. The list is null if
    #: `det_exact` is null.
    singular_offsets: Union[tuple[Union[str, None], ...], None]
    #: det A as an exact polynomial in the offsets t1 to t6, the other legs fixed. TO is singular exactly
    #: at its zeros. Null: no leg is of this kind, or `det_exact` is null.
    det_of_offsets: Union[str, None]
    #: Largest residual.
    residual: Union[float, None]
    #: Relative distance of each leg of TO from the span of FROM.
    residuals: tuple[Union[float, None], ...]
    #: Rank of the leg vectors of FROM.
    leg_rank: int
    #: Singular values of the normalised leg vectors of FROM.
    singular_values: tuple[Union[float, None], ...]
    #: Smallest over largest singular value of A.
    inverse_condition: Union[float, None]
    #: Decision thresholds.
    tolerances: MapTolerancesRecord


class MapTolerancesRecord(Record):
    """The thresholds of the decision about a map."""

    #: Greatest `residual` of a valid map.
    residual: float
    #: Singular value threshold, relative to the largest.
    rank: float
    #: Least `inverse_condition` of a regular map.
    inverse_condition: float


class MappedLengthsRecord(Record):
    """Lengths of the legs of both designs at the same poses, as the legs show them, design units."""

    #: Given lengths.
    from_: tuple[Union[float, None], ...]
    #: The lengths of TO; null: there are none.
    to: Union[tuple[Union[float, None], ...], None]
    #: Reason for none: no regular map, or a squared length that is not positive.
    reason: Union[str, None]


class MarginRecord(Record):
    """The least margin of a kind of requirement."""

    #: The kind of requirement.
    name: TermKind
    #: Least margin over sampled poses, negative for a violation.
    margin: Union[float, None]
    #: Required safety margin, in the unit of the margin; 0: none. Its name in JSON is older than the word.
    reserve: Union[float, None]
    #: The margin minus the safety margin.
    net_margin: Union[float, None]
    #: Whether the safety margin is kept. In `assess` this is proved, or null; in other answers it holds at
    #: the sampled poses.
    safety_margin_kept: Union[bool, None]
    #: Whether the requirement is met, apart from rounding. In `assess` this is proved, or null; in other
    #: answers it holds at the sampled poses.
    met: Union[bool, None]
    #: Whether the margin is 0 to rounding.
    at_limit: bool
    #: The status of the requirement.
    status: MarginVerdict
    #: Proved lower bound over the workspace; null: nothing is proved.
    proved_margin: Union[float, None]
    #: Unit.
    unit: str
    #: The parts with the least margin: legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: Legs, from 1; for a requirement on joints, the legs of the joint.
    legs: tuple[int, ...]
    #: The pose with the least margin; null: the margin is the same at every pose.
    pose: Union[PoseQuaternionRecord, None]


class MotionAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Convention in which poses were read, and of the table of instants; a table of poses may say more in
    #: the names of its columns.
    frames: PoseConventionRecord
    #: Whether every requirement is met at the sampled instants, and every pose of the motions is regular.
    met: bool
    #: The unit of lengths; speeds are in this unit per second, accelerations per second squared.
    length_unit: str
    #: The unit of forces.
    force_unit: str
    #: Values assumed, one sentence each.
    assumptions: tuple[str, ...]
    #: The motions: the trajectory first, then sines and accelerations.
    motions: tuple[MotionRunRecord, ...]
    #: Stiffness at the pose of `--about`; null: not requested.
    stiffness: Union[StiffnessRecord, None]
    #: Table written; null: none.
    csv: Union[str, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class MotionRecord(Record):
    """A pair of rigid motions of the second design."""

    #: The motion of its base.
    base: PoseRecord
    #: The motion of its platform.
    platform: PoseRecord
    #: Residual of the leg map.
    residual: Union[float, None]
    #: Determinant of this map.
    det: Union[float, None]
    #: Relation to the first design; null: undecided.
    relation: Union[Relation, None]


class MotionRunRecord(Record):
    """The legs along one motion."""

    #: Trajectory or manoeuvre, as requested.
    motion: str
    #: Number of sampled instants.
    instants: int
    #: Duration of the motion, seconds.
    duration_s: float
    #: Whether every requirement is met at the sampled instants, and every pose is regular.
    met: bool
    #: The legs in order; empty: a leg has no length at some instant, or the legs are rods on cranks.
    legs: tuple[LegMotionRecord, ...]
    #: Least margin by kind of requirement, with the forces and speeds of this motion.
    requirements: tuple[TimedMarginRecord, ...]
    #: Whether all its poses are regular.
    regularity: MotionRegularity
    #: Time of the first singular pose, seconds; null: none was found.
    singular_at_s: Union[float, None]
    #: The first singular pose; null: none was found.
    singular_pose: Union[PoseQuaternionRecord, None]
    #: Evidence that it is singular.
    singular_evidence: Union[SingularEvidenceWord, None]
    #: The cranks in leg order, for legs that are rods on cranks; empty: a rod does not reach at some
    #: instant.
    cranks: Union[tuple[CrankMotionRecord, ...], None]
    #: First time at which a rod does not reach, seconds.
    unreached_at_s: Union[float, None]


class MovesFoundRecord(Record):
    """A summary of a search for equivalent platforms."""

    #: The outcome of the search.
    outcome: SearchWord
    #: Legs that differ from the design, from 1; null: no platform is written.
    moved_legs: Union[tuple[int, ...], None]
    #: det A to the written platform; null: no platform is written.
    det: Union[float, None]


class NaturalMotionRecord(Record):
    """A natural motion."""

    #: The frequency, hertz.
    frequency_hz: Union[float, None]
    #: The mode shape, base frame: shift of the platform origin in design units and rotation vector in
    #: radians. It is normalised to `v^T M v = 1` in kilograms and design units.
    shape: tuple[Union[float, None], ...]


class NearRecord(Record):
    """The path from the start to the pose reached, with the numbers that prove that it holds no singular pose."""

    #: The outcome of the tracking.
    outcome: NearWord
    #: Reason for losing it; null: it was not lost.
    reason: Union[str, None]
    #: Start pose.
    start: PoseRecord
    #: End pose.
    reached: PoseRecord
    #: Share of the straight line of squared lengths; 1: all.
    fraction: float
    #: Largest leg equation error over squared size.
    residual: Union[float, None]
    #: Inverse condition number at the pose reached, as in `assess`: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: Number of segments of the line.
    segments: int
    #: Number of Newton steps in all.
    newton_steps: int
    #: The largest Kantorovich number; below 1, no segment holds a singular pose.
    kantorovich: Union[float, None]
    #: Displacement of the platform centroid since start, design units.
    distance: Union[float, None]
    #: Rotation since start, degrees.
    angle_deg: Union[float, None]
    #: Uncertainty of that pose. Present for ideal joints and a design with standard deviations of a
    #: calibration.
    uncertainty: Union[PoseUncertaintyRecord, None]


class NearestAllowedRecord(Record):
    """The allowed pose found near a pose that is not allowed."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: The position, base frame, design units.
    position: tuple[float, ...]
    #: Roll, pitch and yaw, degrees.
    rpy_deg: tuple[float, ...]
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Distance from the requested pose, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    distance: float
    #: Length `L` of `distance`, design units per radian.
    characteristic_length: float
    #: Active requirements.
    binds: tuple[LimitRecord, ...]
    #: Whether no small step leads nearer, as far as margins are smooth: the pose is then locally nearest.
    #: False: the search ended early.
    stationary: bool
    #: Whether the straight path from home is allowed.
    straight_from_home: bool


class NearestErrorRecord(Record):
    """The errors of the nearest octahedral platform."""

    #: Largest displacement of a leg end, design units.
    largest_displacement: Union[float, None]
    #: Largest displacement over the size.
    relative_displacement: Union[float, None]
    #: Largest leg length difference over the workspace, design units.
    largest_length_deviation: Union[float, None]
    #: det A from octahedral to equivalent platform.
    det: Union[float, None]


class NearestMotionRecord(Record):
    """The pair of rigid motions with the least residual."""

    #: Motion of the second design's base.
    base: PoseRecord
    #: Motion of its platform.
    platform: PoseRecord
    #: The residual it leaves.
    residual: Union[float, None]


class NearestPlatformRecord(Record):
    """The platform with the least violation of its requirements."""

    #: The chosen variables, without axes.
    variables: tuple[VariableRecord, ...]
    #: Margins of requirements, over many poses and computed independently of the search.
    constraint_margins: tuple[MarginRecord, ...]
    #: The result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design


class NearestRoundingOutcome(Record):
    """The nearest rounding, or the reason why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: Verdict of leg map and forward kinematics.
    verdict: Union[RoundingVerdict, None]
    #: Leg map residual; null: it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: Figures of the rounded design.
    evaluation: Union[EvaluationRecord, None]
    #: Pose error when computing with the given design.
    pose_error: Union[RoundingErrorRecord, None]
    #: Number of joints on another than the nearest hole.
    not_nearest: Union[int, None]
    #: Whether rotations by 120 degrees keep both bodies.
    three_fold: Union[bool, None]
    #: The obstacle.
    error: Union[NoRoundingError, None]


class NearestRoundingRecord(Record):
    """A rounding with all joints on holes near their given positions."""

    #: The grids used.
    grids: GridsRecord
    #: Verdict of leg map and forward kinematics.
    verdict: RoundingVerdict
    #: Leg map residual; null: it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: Figures of the rounded design.
    evaluation: EvaluationRecord
    #: Pose error when computing with the given design.
    pose_error: RoundingErrorRecord
    #: Number of joints on another than the nearest hole.
    not_nearest: int
    #: Whether rotations by 120 degrees keep both bodies.
    three_fold: bool


class NearestSingularPoseRecord(Record):
    """A singular pose near the one asked about."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: `sqrt(|p - p'|^2 + (L angle)^2)`, design units.
    distance: float
    #: Length `L` of `distance`, design units per radian.
    characteristic_length: float
    #: Whether no small step on singular poses leads nearer: then it is locally nearest.
    stationary: bool
    #: Distance within which a singular pose is proved; null: not proved.
    proved_within: Union[float, None]


class NearestSingularRecord(Record):
    """The nearest singular design found."""

    #: Norm of the change of all joints.
    distance: Union[float, None]
    #: Unit of distances: that of the design.
    unit: str
    #: Always `upper`: an upper bound of the least distance.
    bound: Literal["upper"]
    #: A lower bound: no singular design is nearer, design units.
    distance_at_least: Union[float, None]
    #: The kind of singularity.
    kind: str
    #: Dependent legs.
    legs: tuple[int, ...]
    #: Dependency of the leg vectors.
    coefficients: Union[tuple[Union[float, None], ...], None]
    #: Residual of the dependency.
    residual: Union[float, None]
    #: Whether the designs differ by rounding only.
    within_rounding: bool
    #: Half a unit of the last digit, design units; null: some coordinate differs by more.
    within_digits: Union[float, None]
    #: Base joints by name, base frame.
    base: dict[str, tuple[Union[float, None], ...]]
    #: Platform joints by name, platform frame.
    platform: dict[str, tuple[Union[float, None], ...]]


class NextPoseRecord(Record):
    """A pose to measure next."""

    #: Pose, in design frames if joints are, else in the frames of the measurements.
    pose: PoseQuaternionRecord
    #: Roll, pitch and yaw, degrees.
    rpy_deg: tuple[Union[float, None], ...]
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Factor by which this measurement shrinks the error ellipsoid: the geometric mean of the deviations
    #: along its axes.
    shrinks: Union[float, None]
    #: Greatest standard deviation after all poses up to this one, design units.
    greatest_deviation: Union[float, None]


class NoRoundingError(Record):
    """The obstacle to a rounding."""

    #: A short code.
    code: NoRoundingWord
    #: Message in words.
    message: str


class NoRoundingRecord(Record):
    """The reason why there is no rounding."""

    #: The obstacle.
    error: NoRoundingError


class NoiseRecord(Record):
    """Standard deviations of measurements."""

    #: Source of values.
    source: NoiseSource
    #: Standard deviation of a length, design units.
    length: Union[float, None]
    #: Standard deviation of a platform origin coordinate, design units.
    position: Union[float, None]
    #: Standard deviation of a rotation vector component, degrees.
    rotation_deg: Union[float, None]


class ObjectiveRecord(Record):
    """An objective and its value."""

    #: The name of the objective.
    name: Objective
    #: Value over many poses, computed independently of the search.
    value: Union[float, None]
    #: Value over the poses held.
    at_held_poses: Union[float, None]
    #: The unit; empty for a pure number.
    unit: str


class ObservabilityRecord(Record):
    """Observability of the machine's parameters by the measurements."""

    #: Number of identified directions.
    rank: int
    #: Singular values of the identification matrix, whitened and multiplied by the deviation of a length,
    #: largest first; no unit.
    singular_values: tuple[Union[float, None], ...]
    #: Singular values below are not identified.
    tolerance: Union[float, None]
    #: `(s_1 .. s_m)^(1/m) / sqrt(n)` (Borm, Menq 1991).
    volume_index: Union[float, None]
    #: `s_m / s_1` (Driels, Pathre 1990).
    inverse_condition: Union[float, None]
    #: `s_m^2 / s_1` (Nahvi, Hollerbach 1996).
    noise_amplification: Union[float, None]
    #: `1 / (1/s_1 + .. + 1/s_m)` (Sun, Hollerbach 2008).
    harmonic_index: Union[float, None]
    #: Unidentified changes of the machine, each normalised to 1 over all unknowns.
    unobservable: tuple[UnobservableRecord, ...]


class OffsetProductsRecord(Record):
    """Products over the six offsets of the platform without shared joints."""

    #: Product of all 1 - t.
    rest: ExactNumberRecord
    #: Product of all t.
    own: ExactNumberRecord


class OffsetShiftRecord(Record):
    """The change of an offset."""

    #: The leg, from 1.
    leg: int
    #: The change of the offset; relative, the whole change has norm 1.
    change: Union[float, None]


class OnHolesRecord(Record):
    """A summary of a platform with its joints on the holes that its design states."""

    #: The rounding chosen; null: there is none.
    variant: Union[VariantWord, None]
    #: Whether rotations by 120 degrees keep both bodies.
    three_fold: bool
    #: Largest displacement to a hole, design units.
    largest_displacement: Union[float, None]
    #: Variables optimised again.
    refitted: tuple[str, ...]
    #: Number of passes of search and rounding.
    passes: int
    #: Reason for no rounding; null: there is one.
    error: Union[NoRoundingError, None]


class OptimizeAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The status of the search.
    status: OptimizeWord
    #: The evidence of optimality; null: none, or there is no platform.
    optimality: Union[OptimalityWord, None]
    #: First objective.
    objective: Union[float, None]
    #: All objectives.
    objectives: Union[tuple[ObjectiveRecord, ...], None]
    #: The chosen variables, without axes.
    variables: Union[tuple[VariableRecord, ...], None]
    #: The offsets `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: The displacements `t_i d_i`, design units; null if `edge_lengths` is null.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: The edges `d_i`, design units; null: no offsets were chosen, or the triangles were chosen too.
    edge_lengths: Union[tuple[Union[float, None], ...], None]
    #: Legs in cyclic order, from 1; null: no offsets were chosen.
    cyclic_order: Union[tuple[int, ...], None]
    #: Zone of each offset: before, inside or beyond its edge; null: no offsets were chosen.
    branch: Union[str, None]
    #: det A of the leg map; null: the variables leave the equivalence class of the design.
    det: Union[float, None]
    #: Rows of A: s' = A s + c of squared leg lengths, legs in the order of the design. Null if `det` is
    #: null.
    A: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: The constant terms, design units squared; null if `det` is null.
    c: Union[tuple[Union[float, None], ...], None]
    #: The home pose, raised if its height was chosen.
    home: Union[PoseQuaternionRecord, None]
    #: The chosen joint axes.
    joint_axes: Union[JointAxesRecord, None]
    #: Margins of requirements, over many poses and computed independently of the search.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: Margins of the search's extra conditions.
    search_margins: Union[SearchMarginsRecord, None]
    #: The active bounds: ends of ranges and limits without any margin, and the growth of the bodies. Null:
    #: none.
    active_bounds: Union[ActiveBoundsRecord, None]
    #: Whether all requirements are proved; null: some are unproved.
    requirements_met: Union[bool, None]
    #: Result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Equivalence with the design; null: the variables leave the equivalence class.
    verify: Union[VerifiedRecord, None]
    #: Pose with the first objective's value; null: the objective is not the worst conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the successful run; null: a member of a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses held and checked.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design; null: there is none.
    design: Union[Design, None]
    #: The file written, with the best platform or the one with the least violation.
    output: Union[str, None]
    #: Platform with the least violation; null: a platform meets the requirements.
    nearest: Union[NearestPlatformRecord, None]
    #: The requirements in conflict; null: no conflict is known.
    conflict: Union[ConflictRecord, None]
    #: Reason for no decision, one sentence; null: it decided, or nothing failed.
    failure: Union[str, None]
    #: Searches with one more freedom, each with its search result. Null: a platform meets the
    #: requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: Result for the three-fold symmetry. Null: the design has none or names one, or the search could not
    #: break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: Drives of the table with their results; null: no table was given. The rest of the answer is about
    #: the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: Other local optima that meet the requirements, best first; null: not requested.
    candidates: Union[tuple[OptimumRecord, ...], None]
    #: Pareto front with mode = "pareto": no platform is better than another in every objective. Sorted by
    #: falling gain of the first objective; null in other modes.
    front: Union[tuple[FrontMemberRecord, ...], None]
    #: Reason for choosing sizes and home height, one sentence. Null: the variables come from the design or
    #: are the usual ones.
    choice: Union[str, None]
    #: Limits of the search.
    limits: SearchLimitsRecord
    #: The poses required.
    region: PoseRegionRecord
    #: Search statistics.
    search: SearchRecord
    #: Upper bound on the objective at the poses held; null: not proved, or there is no solution.
    global_bound: Union[GlobalBoundRecord, None]
    #: Greatest gap that counts as optimal; null: the search proves no bound.
    tolerance: Union[float, None]
    #: Branches by outcome; null: the search has none.
    branch_counts: Union[BranchCountsRecord, None]
    #: The best other branches.
    runners_up: Union[tuple[BranchRecord, ...], None]
    #: All branches.
    branches: Union[tuple[BranchRecord, ...], None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class OptimizedRecord(Record):
    """A summary of the platform: the main fields of the answer of `optimize`."""

    #: The status of the search.
    status: OptimizeWord
    #: The evidence of optimality; null: none.
    optimality: Union[OptimalityWord, None]
    #: First objective.
    objective: Union[float, None]
    #: The chosen variables, without axes.
    variables: tuple[VariableRecord, ...]
    #: The offsets `t_i` in cyclic order; null: no offsets were chosen.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: The displacements `t_i d_i`, design units; null: no offsets were chosen, or the triangles were
    #: chosen too.
    shifts: Union[tuple[Union[float, None], ...], None]
    #: det A of the leg map; null: the variables leave the equivalence class of the design.
    det: Union[float, None]
    #: Active bounds; null: none.
    active_bounds: Union[ActiveBoundsRecord, None]


class OptimumRecord(Record):
    """A local optimum other than the best one."""

    #: All objectives.
    objectives: tuple[ObjectiveRecord, ...]
    #: The chosen variables, without axes.
    variables: tuple[VariableRecord, ...]
    #: Whether all requirements are proved; null: some are unproved.
    requirements_met: Union[bool, None]
    #: The result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design
    #: The design file written; null: none.
    output: Union[str, None]


class OtherAlignmentRecord(Record):
    """The result for the exchanged or mirrored second design."""

    #: Whether motions exist.
    status: AlignmentWord
    #: Number of motions.
    motions: int


class OutOfReachRecord(Record):
    """A rod that does not reach from the circle of its crank to the platform joint."""

    #: The leg, from 1.
    leg: int
    #: Missing length, design units; negative: the rod is too long.
    too_short_by: float


class OutlierRecord(Record):
    """A measurement that contradicts the others."""

    #: Line of the table.
    line: int
    #: The leg, from 1; null: the whole pose.
    leg: Union[int, None]
    #: Distance from the model, standard deviations.
    distance: Union[float, None]
    #: The rejection threshold, standard deviations: correct measurements all stay below it with a
    #: probability of 99 %.
    threshold: Union[float, None]
    #: Weight in the fit.
    weight: Union[float, None]


class PathRecord(Record):
    """The report of a path of the homotopy."""

    #: Start index.
    start: int
    #: Path end.
    end: PathEnd
    #: Index into `solutions`, from 0.
    root: Union[int, None]
    #: Mirror image index, where one path stands for two.
    mirror_root: Union[int, None]
    #: Accepted steps.
    steps: int
    #: Rejected steps.
    rejections: int
    #: Winding number, 1 for a regular end, 0 where it is not determined.
    winding: int
    #: |e.e| / |e|^2 at the end.
    isotropy: Union[float, None]
    #: Number of repetitions with smaller steps.
    retracked: int


class PatternLegRecord(Record):
    """One leg of a pattern."""

    #: Base joint.
    base: str
    #: Platform joint.
    platform: str
    kind: Union[Literal["vertex", "inner"], None]
    #: The side, from 1.
    side: Union[int, None]
    #: Name of its offset.
    offset: Union[str, None]
    #: Legs at the ends of the side, from 1.
    between: Union[tuple[int, ...], None]


class PatternRecord(Record):
    """A pattern: the kept legs, and the moved legs with their edges."""

    #: Name of the pattern: V and the vertices kept, S and the sides of the moved ones.
    id: str
    #: Class up to symmetry, from 1.
    class_: int
    #: Class up to all symmetries, from 1.
    class_exchange: int
    #: Topology of the pattern, from 1.
    topology: int
    #: Whether offsets one at a time lead to it.
    sequential: bool
    #: Legs of the design in order.
    legs: tuple[PatternLegRecord, ...]
    #: Offset names.
    offsets: tuple[str, ...]
    #: Joints of several legs.
    shared_joints: tuple[SharedJointRecord, ...]
    #: Collinear joints.
    alignments: tuple[tuple[str, ...], ...]
    #: Formulas of A, with legs in the order of the design.
    A: tuple[tuple[str, ...], ...]
    #: Formula of det A.
    det: str
    #: Equations of the zeros of det A.
    det_zero: tuple[str, ...]


class PentapodAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Number of legs: 5.
    legs: int
    #: Whether a joint is no fraction, so that the answer is about the nearest doubles.
    rounded_joints: bool
    #: The line that the legs hold; the platform can still rotate about it. Null: no body has all its
    #: joints on a line.
    line: Union[HeldLineRecord, None]
    #: Whether the legs are always dependent; null: not decided.
    architecturally_singular: Union[bool, None]
    #: Sixth legs that allow solving in steps.
    sixth_legs: tuple[DecouplingLeg, ...]
    #: The lengths given, design units; null: none.
    lengths: Union[tuple[float, ...], None]
    #: Poses of the line for these lengths; null: no lengths were given, or there is no answer.
    poses: Union[LinePosesRecord, None]
    #: Reason for no poses; null: there are poses.
    no_poses: Union[str, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class PlacedFirst(Record):
    """A part of the platform that some of the legs place, before the others place the rest."""

    part: Union[Literal["line", "joint"], None]
    #: The body.
    body: Union[Body, None]
    #: Legs, from 1.
    legs: Union[tuple[int, ...], None]
    #: Polynomial for it; null when the legs are dependent, or joints are no fractions.
    class_: Union[LineClass, None]
    #: Whether the five other ends are coplanar: a line-plane component.
    other_ends_in_plane: Union[bool, None]


class PointStiffnessRecord(Record):
    """Stiffness at a point of the platform."""

    #: Force and torque for a shift of the point and a small rotation: force units, design units and
    #: radians.
    K: tuple[tuple[Union[float, None], ...], ...]
    #: Its inverse; null at a singular pose.
    compliance: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Least stiffness against forces through the point, force units per design unit; 0 at a singular pose.
    linear: Union[float, None]
    #: Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
    angular: Union[float, None]


class PolynomialRecord(Record):
    """A polynomial in one unknown or in several: its degrees, its coefficients and its real roots."""

    #: Names of unknowns.
    unknowns: tuple[str, ...]
    #: Degree with spurious factors.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: Exponents of the unknowns by term.
    exponents: tuple[tuple[int, ...], ...]
    #: Exact coefficients, integers as decimal text; for one unknown the constant comes first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: Their multiplicities.
    real_root_multiplicities: tuple[int, ...]
    #: Coefficient bounds [low, high]; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class PoseBoundRecord(Record):
    """A proved bound on the number of isolated finite poses, counted with multiplicity."""

    #: The bound.
    poses: int
    #: Theorem behind it.
    theorem: str


class PoseConventionRecord(Record):
    """A convention for poses."""

    #: Order of the rotations: `fixed-xyz` and the like for fixed axes, `moving-xyz` for moving axes, or
    #: `vector` for rotation vectors.
    rotation_order: str
    #: Rotation as a product of matrices of angles a, b, c in their order.
    formula: str
    #: Unit of angles: `deg` or `rad`.
    angles: str
    #: Order of quaternions: `wxyz` or `xyzw`.
    quaternion: str
    #: Point whose position is given, platform frame, design units.
    pivot: tuple[Union[float, None], ...]
    #: The origin of poses: `base` or `home`.
    relative_to: str
    #: Upward axis: `z` or `y`.
    up: str
    #: The convention in words.
    sentence: str


class PoseCountRecord(Record):
    """The finite poses of the design, counted without finding them."""

    #: Number of poses with multiplicity; null: not finite, or undecided.
    finite: Union[int, None]
    #: Number of standard monomials by degree.
    by_degree: Union[tuple[int, ...], None]
    #: Dimension of a positive-dimensional set.
    dimension: Union[int, None]
    #: Degree of a positive-dimensional set, in the 16 coordinates of a pose, with multiplicity.
    degree: Union[int, None]
    #: Reason for no count.
    undecided: Union[CountUndecided, None]
    #: The counted lengths: the exact ones given, or generic ones, which have at least as many isolated
    #: poses. Lengths known only to rounding, such as images under a leg map, are counted as generic.
    lengths: CountedLengths
    #: The evidence for the count: a theorem with certificates, or counting modulo random primes.
    evidence: EvidenceWord
    #: Bound on the probability of a wrong count; null: proved, or undecided.
    error_probability: Union[float, None]
    #: The primes in decimal, as text: they have more digits than a double.
    primes: tuple[str, ...]


class PoseErrorRecord(Record):
    """The error of a pose."""

    #: Error of the tool point, design units.
    position: Union[float, None]
    #: Error of the orientation, degrees.
    rotation_deg: Union[float, None]


class PoseErrorsRecord(Record):
    """Quantiles of pose errors."""

    #: Errors of the tool point, design units.
    position: QuantilesRecord
    #: Errors of the orientation, degrees.
    rotation_deg: QuantilesRecord


class PoseFiguresRecord(Record):
    """A pose with figures of its Jacobian."""

    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: det J of the leg lines, divided by the size to the sixth power.
    determinant: Union[float, None]
    #: Inverse condition number of the Jacobian: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: Conditions for four planes through a point, for octahedral designs.
    four_planes: Union[tuple[Union[float, None], ...], None]


class PoseInFrames(Record):
    """A pose in the numbers of a convention."""

    #: Position of the pivot, design units.
    position: tuple[Union[float, None], ...]
    #: Angles in the unit of `frames`, in the order in which they are written.
    angles: tuple[Union[float, None], ...]
    #: Whether the rotation has no other angles: false near the ends of the middle angle, where only a
    #: combination of the others is determined to more than half of the digits of a double.
    angles_unique: bool
    #: Unit quaternion in the order of `frames`.
    quaternion: tuple[Union[float, None], ...]


class PoseQuaternionRecord(Record):
    """A pose by its quaternion: a platform point x is at R(q) x + p in the base frame."""

    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]


class PoseRecord(Record):
    """A pose: a platform point x is at R x + p in the base frame."""

    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]


class PoseRegionRecord(Record):
    """The poses that a design requires."""

    #: The source of home.
    home: SourceWord
    #: Home position of the starting design, base frame, design units.
    home_position: tuple[Union[float, None], ...]
    #: Source of the workspace.
    workspace: SourceWord


class PoseTotalsRecord(Record):
    """Numbers of poses."""

    #: The source of the lengths.
    lengths_from: LengthsOrigin
    #: Number of finite poses, real and complex.
    finite_count: int
    #: Number of real poses.
    real_count: int
    #: Number of poses with a certificate.
    certified_count: int
    #: Whether every path is accounted for; false: poses may be missing.
    all_paths_accounted: bool


class PoseUncertaintyRecord(Record):
    """The uncertainty of a pose computed from lengths with the calibrated machine, to first order. It covers the errors of the calibration; the noise of the lengths adds to it."""

    #: Source of correlations.
    correlations: CorrelationsWord
    #: RMS error of the platform origin, design units.
    position: Union[float, None]
    #: RMS error of the orientation, degrees.
    rotation_deg: Union[float, None]
    #: Covariance of platform origin (design units) and rotation vector (degrees), base frame.
    covariance: tuple[tuple[Union[float, None], ...], ...]


class PriceRecord(Record):
    """Figures of a design and of the platform with separate joints made from it, in this order."""

    #: Worst conditioning over the workspace; both use the characteristic length of the design.
    conditioning: tuple[Union[float, None], ...]
    #: Least distance of base ends, design units; 0 for a shared joint.
    base_spacing: tuple[Union[float, None], ...]
    #: Least distance of platform ends, design units; 0 for a shared joint.
    platform_spacing: tuple[Union[float, None], ...]
    #: Greatest distance of base joints from their centre, design units.
    base_radius: tuple[Union[float, None], ...]
    #: Greatest distance of platform joints from their centre, design units.
    platform_radius: tuple[Union[float, None], ...]
    #: Comparison in words.
    message: str


class ProvenanceRecord(Record):
    """The data needed to compute an answer again: the program, the seed and the files. It holds no time and no name of a machine."""

    #: Program version.
    version: str
    #: Seed; null: it takes none.
    seed: Union[int, None]
    #: The designs in the order given.
    designs: tuple[DesignSourceRecord, ...]
    #: The other files read: tables of lengths or poses, fronts.
    files: tuple[FileSourceRecord, ...]


class QuantilesRecord(Record):
    """Quantiles of values."""

    #: Half of the values are below.
    median: Union[float, None]
    #: 90 % of the values are below.
    p90: Union[float, None]
    #: 99 % of the values are below.
    p99: Union[float, None]
    #: The greatest value.
    max: Union[float, None]


class RangeRecord(Record):
    """A range of a single coordinate from home, and the part of it that is free."""

    #: The coordinate, as in `[workspace]`: `x`, `y`, `z`, `roll_deg`, `pitch_deg` or `yaw_deg`.
    coordinate: str
    #: `deg`, or the unit of length.
    unit: str
    #: Stated lower end, measured from home.
    min: float
    #: Stated upper end, measured from home.
    max: float
    #: Free part of the range towards smaller values; computed in doubles, without proof.
    back: TravelRecord
    #: Free part of the range towards greater values; computed in doubles, without proof.
    forth: TravelRecord


class RayEndRecord(Record):
    """A limit that ends paths."""

    #: The kind of requirement; null: a singular pose, or no limit within ten sizes of the design.
    name: Union[TermKind, None]
    #: Limit in a word.
    end: str
    #: Share of the paths it ends, a share of solid angle.
    share: float


class RealPoseRecord(Record):
    """A real pose as real numbers."""

    #: Platform origin, base frame, design units.
    position: tuple[float, ...]
    #: Rows of the rotation matrix.
    rotation: tuple[tuple[float, ...], ...]
    #: Roll, pitch and yaw in degrees, R = Rz(yaw) Ry(pitch) Rx(roll).
    rpy_deg: tuple[float, ...]
    #: Unit quaternion, scalar part first.
    quat_wxyz: tuple[float, ...]
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Side of the base; null: its centre is in the plane of the base, here or at home.
    mode: Union[SideWord, None]
    #: Largest difference of a rotation entry from home, or of a coordinate of the position divided by the
    #: size of the design.
    distance_from_home: float
    #: Whether it is the real pose nearest to home.
    nearest_home: bool
    #: Whether all requirements are met and det J has the sign of home, with `--limits`.
    allowed: Union[bool, None]
    #: Whether each crank is on the named side; null: no cranks. A crank changes its side only through a
    #: singular pose, with crank, rod and axis in one plane.
    elbow_kept: Union[tuple[bool, ...], None]


class RegularBoxRecord(Record):
    """A box of regular poses around a pose."""

    #: Half widths of positions at scale 1, design units, base frame.
    translation: tuple[float, ...]
    #: Half widths of the rotation vector at scale 1, base frame, degrees.
    rotation_deg: tuple[float, ...]
    #: Point of the platform about which it rotates, platform frame, design units.
    pivot: tuple[float, ...]
    #: Shape.
    region: RegionWord
    #: Scale proved free of singular poses.
    proved_scale: Union[float, None]
    #: Pose in the smallest box that holds a singular one; null: no such box is known.
    singular_within: Union[ScaledPoseRecord, None]
    #: Greatest scale searched for a sign change.
    searched_scale: Union[float, None]
    #: Number of cells of the proof.
    cells: int


class RegularityRecord(Record):
    """Whether det J is nonzero at every pose of the workspace."""

    #: Whether every pose is regular; null: undecided.
    met: Union[bool, None]
    #: Result.
    status: RegularityWord
    #: Pose with det J opposite to home, or is undecided.
    pose: Union[PoseQuaternionRecord, None]
    #: Number of cells examined.
    cells: int


class RejectedRecord(Record):
    """A candidate that is no root."""

    #: The reason of the rejection.
    reason: RejectionReason
    #: Leg equation error of the candidate, over the squared size.
    residual: Union[float, None]


class RemovedFactorRecord(Record):
    """A spurious factor: it comes from the derivation of the polynomial and has no meaning for the poses."""

    #: Factor in the unknowns, or in words.
    factor: str
    #: The degree of the factor.
    degree: int
    #: Number of removals.
    times: int


class RequiredSizeRecord(Record):
    """The workspace that a design requires."""

    #: Volume of its translations, design units cubed.
    volume: float
    #: Its volume over the volume that straight paths reach.
    share: Union[float, None]
    #: Factor by which it can grow; 1 or more: the whole region is free.
    factor: FreeSizeRecord


class RequirementMarginRecord(Record):
    """The least margin of a requirement."""

    #: The requirement.
    name: TermKind
    #: The margin; a violation below 0.
    margin: Union[float, None]


class ResidualsRecord(Record):
    """Statistics of residuals, design units."""

    #: RMS residual.
    rms: Union[float, None]
    #: RMS residual by leg.
    legs: tuple[Union[float, None], ...]
    #: Greatest residual; null: none was counted.
    greatest: Union[GreatestResidualRecord, None]
    #: Number of lengths counted.
    count: int


class ResolutionRecord(Record):
    """The motion of the point for a step of the drives."""

    #: Step: design units of legs, degrees of cranks.
    step: float
    #: The unit of the step.
    step_unit: str
    #: Motion by a step of one drive, in leg order.
    drives: tuple[SmallMotionRecord, ...]
    #: Greatest change when every drive is off by a step: sums of the sizes.
    all: SmallMotionRecord


class RotationPolynomialRecord(Record):
    """The polynomial in a Cayley parameter of all poses."""

    #: Names of unknowns.
    unknowns: Union[tuple[str, ...], None]
    #: Degree with spurious factors.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: Union[CoefficientsWord, None]
    #: Exponents of the unknowns by term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: Exact coefficients, integers as decimal text; for one unknown the constant comes first.
    coefficients: Union[tuple[str, ...], None]
    #: Coefficient bounds [low, high]; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: Their multiplicities.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: The reason.
    error: Union[str, None]


class RoundAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Unit of lengths.
    units: str
    #: The grids asked for.
    grids: GridsRecord
    #: Whether grid origins and angles are optimised.
    free_grid: bool
    #: Figures of the given design.
    given: EvaluationRecord
    #: Best rounding equivalent to an octahedral platform.
    exact: ExactRoundingOutcome
    #: Every joint on a hole near its position.
    nearest: NearestRoundingOutcome
    #: Result of `assess`; null: there is none, or the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The rounding chosen; null: none meets the requirements.
    chosen: Union[VariantWord, None]
    #: The rounding with the least violation, measured by the greatest violation as a share of its limit;
    #: null: a rounding meets the requirements.
    least_missed: Union[VariantWord, None]
    #: The rounded design: the chosen one, or the one with the least violation.
    design: Union[Design, None]
    #: The file written.
    output: Union[str, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class RoundedJointRecord(Record):
    """A joint on a hole."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: Hole by its counts along the axes, or its circle and its number on the circle. Null: the joint stays
    #: in place.
    cell: Union[tuple[int, ...], None]
    #: The displacement, body frame, design units.
    moved: tuple[Union[float, None], ...]
    #: The size of the displacement, design units.
    distance: Union[float, None]
    #: Distance from its side, design units; null for corners.
    off_line: Union[float, None]


class RoundingErrorRecord(Record):
    """The error of the pose if a rounded platform is controlled like the given one."""

    #: The error to first order.
    first_order: PoseErrorRecord
    #: First-order error with all joints on nearest holes.
    first_order_nearest_points: PoseErrorRecord
    #: Errors solved at random poses.
    solved: PoseErrorsRecord
    #: Number of random poses.
    solved_poses: int


class RoundingSearchRecord(Record):
    """Statistics of the search for an exact rounding."""

    #: Triangles of base and platform combined.
    triangles: tuple[int, ...]
    #: Distances to which all triangles were combined, design units.
    complete_to: tuple[Union[float, None], ...]
    #: Number of improvements by one triangle.
    replacements: int


class RowFailure(Record):
    """The reason why a row has no poses."""

    #: Failure of this row.
    error: FailureRecord


class SampleRecord(Record):
    """Both designs at one set of corresponding leg lengths."""

    #: Leg lengths of A, design units.
    lengths_a: tuple[Union[float, None], ...]
    #: Leg lengths of B, design units.
    lengths_b: tuple[Union[float, None], ...]
    #: The poses of A.
    a: SolvedSampleRecord
    #: The poses of B.
    b: SolvedSampleRecord
    #: Number of pairs of poses.
    matched: int
    #: Number of unmatched poses of A.
    only_a: int
    #: Number of unmatched poses of B.
    only_b: int
    #: Number of poses of A set aside.
    beyond_precision_a: int
    #: Number of poses of B set aside.
    beyond_precision_b: int
    #: Largest distance in a pair.
    worst_distance: Union[float, None]
    #: Whether it supports equivalence.
    agrees: bool


class SamplingRecord(Record):
    """The random poses at which designs were compared."""

    #: Number of poses.
    count: int
    #: Centre of the box, base frame, design units.
    home_position: tuple[float, ...]
    #: Half widths of positions, design units.
    translation_half_widths: tuple[float, ...]
    #: Half widths of rotation vectors, radians.
    rotation_half_widths_rad: tuple[float, ...]


class ScaledPoseRecord(Record):
    """A pose and the scale of the smallest box that holds it."""

    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: The scale.
    scale: Union[float, None]


class ScrewRecord(Record):
    """A turn about an axis with a shift along it."""

    #: Unit vector; of the shift where nothing turns.
    direction: tuple[Union[float, None], ...]
    #: Point of the axis nearest to the point asked about, from there, design units.
    point: tuple[Union[float, None], ...]
    #: Shift along the axis, design units per radian; null: a shift without a turn.
    pitch: Union[float, None]


class SearchLimitsRecord(Record):
    """Limits of a search beside the requirements of the design."""

    #: Least distance of joint centres of a body, design units; null: none.
    min_joint_distance: Union[float, None]
    #: Least |det A| of equivalent platforms.
    min_abs_det: float
    #: The characteristic length, by which moments in the Jacobian are divided, design units.
    characteristic_length: float
    #: Unit of lengths.
    units: str


class SearchMarginsRecord(Record):
    """Margins of the extra conditions of a search."""

    #: |det A| less the required value; null: the variables do not keep the class of the design.
    abs_det: Union[float, None]
    #: Least distance of a variable from its bounds.
    bounds: Union[float, None]


class SearchRecord(Record):
    """Statistics of a search."""

    #: The search method.
    method: SearchMethodWord
    #: Number of starts; null: the search begins in the branches.
    starts: Union[int, None]
    #: Number of starts with a feasible result.
    feasible: Union[int, None]
    #: Gains of polished runs; null in the list: not feasible.
    polished: Union[tuple[Union[float, None], ...], None]
    #: Number of runs on a Pareto front dominated by others; null: no front.
    dominated: Union[int, None]
    #: Number of bounds of a Pareto front that no run met; null: no front.
    unmet: Union[int, None]
    #: Number of conic programs solved by clarabel; searches with other drives and for freedoms are not
    #: counted.
    conic_programs: int


class SearchStepRecord(Record):
    """A step of the run that found the platform."""

    #: Value after the step: the weighted gain of the objectives; for offsets the worst inverse condition
    #: number.
    objective: Union[float, None]
    #: Greatest scaled violation; lengths relative to the size.
    violation: Union[float, None]
    #: Trust region radius.
    radius: Union[float, None]
    #: Number of poses held.
    poses: int
    #: Whether it was accepted.
    accepted: bool
    #: Predicted gain of the merit function.
    predicted: Union[float, None]
    #: Actual gain of the merit function; for a rejected step, at the poses that rejected it.
    actual: Union[float, None]


class SearchedDriveRecord(Record):
    """A drive of the table in the units of the design, with its search result."""

    #: The name of the drive.
    name: str
    #: Line of the table, from 1.
    line: int
    #: Price; null: not in the table.
    price: Union[float, None]
    #: Mass; null: not in the table.
    mass: Union[float, None]
    #: Least and greatest joint distance, design units.
    leg_length: tuple[Union[float, None], ...]
    #: Greatest force; null: not in the table.
    force: Union[float, None]
    #: Greatest speed; null: not in the table.
    speed: Union[float, None]
    #: Outcome.
    outcome: DriveSearchWord
    #: First objective of the platform found; null: no platform was found.
    objective: Union[float, None]
    #: Margins against the drive's limits (length, force, speed), for the platform found or the one with
    #: the least violation. Empty: the drive was not searched.
    margins: tuple[MarginRecord, ...]
    #: Result for the three-fold symmetry; null under the same conditions as without a table.
    symmetry: Union[SymmetryRecord, None]
    #: Reason for rejection, one sentence; null: it is the answer.
    reason: Union[str, None]


class SharedJointRecord(Record):
    """A joint that holds more than one leg."""

    #: The body it is on.
    body: Body
    #: The name of the joint.
    joint: str
    #: The legs, from 1.
    legs: tuple[int, ...]


class SignPairRecord(Record):
    """The straight path between two assembly modes."""

    #: Numbers of the two modes, from 1.
    modes: tuple[int, ...]
    #: Sign of det J along the straight path.
    straight: SignOutcome
    #: Number of proved sign changes on the straight path.
    changes: int
    #: Whether some regular path joins them; null: none was found.
    joined: Union[bool, None]


class SignPairsRecord(Record):
    """The assembly modes joined by paths without singular pose."""

    #: Sign of det J by assembly mode.
    signs: tuple[SignRecord, ...]
    #: All pairs of assembly modes.
    pairs: tuple[SignPairRecord, ...]
    #: Modes joined by such paths, numbers from 1.
    groups: tuple[tuple[int, ...], ...]
    #: The paths found.
    paths: tuple[JoiningPathRecord, ...]


class SignPartRecord(Record):
    """det J along a straight part of a path, with parameter u from 0 to 1."""

    #: Sign of det J along the part.
    outcome: SignOutcome
    #: Number of proved sign changes.
    changes: int
    #: Number of pieces without proof.
    doubtful: int
    #: The pieces with their signs.
    pieces: tuple[SignPieceRecord, ...]
    #: Samples [u, det J].
    values: tuple[tuple[Union[float, None], ...], ...]


class SignPathRecord(Record):
    """det J along a path of straight parts."""

    #: First assembly mode, from 1; 0: the given pose.
    from_: int
    #: Last assembly mode, from 1.
    to: int
    #: Poses on the path.
    poses: tuple[PoseQuaternionRecord, ...]
    #: Whether det J keeps its sign: true and false are proved; null: neither.
    keeps_sign: Union[bool, None]
    #: The straight parts in order.
    parts: tuple[SignPartRecord, ...]


class SignPieceRecord(Record):
    """A piece of a straight path."""

    #: First parameter u.
    from_: Union[float, None]
    #: Last parameter u.
    to: Union[float, None]
    #: Sign of det J.
    sign: SignRecord
    #: Whether it holds a singular pose: det J has proved, opposite signs before and after it.
    singular: bool


class SingularFactorRecord(Record):
    """A factor of the closure condition that belongs to degenerate trilaterations."""

    #: Unoriented steps, from 0.
    step: int
    #: Its degree.
    degree: int
    #: Number of removals.
    removed: int


class SingularLocusAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Unit of lengths.
    units: str
    #: Poses on which det J is a polynomial.
    family: PoseFamilyWord
    #: Position of the given pose, as exact expressions, base frame.
    position: tuple[str, ...]
    #: Quaternion of the orientation, scalar part first, of any norm, as exact expressions.
    quaternion: tuple[str, ...]
    #: The direction of the line, or the axis of the rotations, base frame; null: a family of positions.
    direction: Union[tuple[str, ...], None]
    #: The squared length of the axis; u is the tangent of half the angle divided by this length. Null: no
    #: axis.
    axis_squared: Union[float, None]
    #: det J up to a constant; the zero polynomial means that every pose is singular.
    polynomial: PolynomialRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class SingularPosesAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Unit of lengths.
    units: str
    #: Whether the region is free of singular poses: the workspace of the design, or the region of `--box`
    #: about the pose; null: no region is given.
    regular: Union[RegularityRecord, None]
    #: The given pose.
    pose: PoseFiguresRecord
    #: The leg lengths, design units.
    lengths: tuple[float, ...]
    #: The real poses with these lengths.
    assembly_modes: tuple[PoseFiguresRecord, ...]
    #: Whether every path is accounted for; false: poses may be missing.
    assembly_modes_accounted: bool
    #: Box of regular poses.
    box: RegularBoxRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: det J along a path, with `--path`.
    path: Union[SignPathRecord, None]
    #: det J between all modes, with `--between`.
    between: Union[SignPairsRecord, None]


class SmallMotionRecord(Record):
    """A small motion."""

    #: The shift of the point, design units.
    shift: tuple[Union[float, None], ...]
    #: Rotation vector, degrees.
    turn_deg: tuple[Union[float, None], ...]


class SolutionRecord(Record):
    """One pose with its evidence."""

    #: Rotation matrix, rows.
    R: ComplexRecord3
    #: Position, base frame, design units.
    p: ComplexRecord4
    #: Whether the pose is real; null: undecided.
    real: Union[bool, None]
    #: Whether it has a certificate.
    certified: bool
    #: The proof; null: there is none.
    certificate: Union[CertificateRecord, None]
    #: Number of paths, or roots of a polynomial, that end here.
    multiplicity: int
    #: Largest leg equation error over squared size.
    residual: Union[float, None]
    #: Estimated condition number.
    condition: Union[float, None]
    #: The dual quaternion (e, g): scalar part of e first, g = p e in design units, `max |e_k| = 1`.
    dual_quaternion: Union[ComplexRecord5, None]
    #: Real pose; null: it is not real.
    real_pose: Union[RealPoseRecord, None]


class Solvability(Record):
    """The ways to find the poses in steps."""

    #: Whether quadratic equations give all poses.
    quadratic: bool
    #: Parts that can be placed first; empty where the legs do not decouple in these ways.
    placed_first: tuple[PlacedFirst, ...]


class SolvedBudgetRecord(Record):
    """Exact check of the first-order radius."""

    #: Whether all solved errors stay within the bound.
    within_bound: bool
    #: Largest share of the bound reached; null: a pose was lost.
    largest_share: Union[float, None]
    #: Joint error that keeps the bound, solved exactly at their pose.
    radius: Union[float, None]


class SolvedSampleRecord(Record):
    """Poses of one design at one set of lengths, by forward kinematics."""

    #: The method.
    method: Method
    #: Completeness of the list.
    completeness: CompletenessWord
    #: Evidence for completeness.
    completeness_reason: str
    #: Whether every path is accounted for; false: poses may be missing.
    all_paths_accounted: bool
    #: Number of finite poses, real and complex.
    finite_count: int
    #: Number of real poses.
    real_count: int
    #: Number of poses with a certificate.
    certified_count: int


class StageRecord(Record):
    """The result of one stage of `explore`."""

    #: Stage.
    stage: StageWord
    #: Result in words.
    explanation: str


class StartRecord(Record):
    """The start that was taken, and the result of the other one."""

    #: Start taken.
    taken: StartName
    #: Whether both starts agree; null: only one was tried.
    agree: Union[bool, None]
    #: Misfit from nominal joints: sum of the losses, or estimated deviation of a length; smaller is
    #: better; null: not tried.
    nominal: Union[float, None]
    #: Misfit from the linear equations for squared lengths, which need no design; null: not tried, or not
    #: determined by the poses.
    closed_form: Union[float, None]


class StiffnessRecord(Record):
    """Stiffness and natural motions at a pose."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: Stiffness matrix `J^T diag(k) J` at the platform origin, base frame; force units, design units and
    #: radians. It maps a shift and a small rotation to force and torque.
    K: tuple[tuple[Union[float, None], ...], ...]
    #: Least stiffness against forces through the platform origin, force units per design unit; 0 at a
    #: singular pose.
    linear: Union[float, None]
    #: Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
    angular: Union[float, None]
    #: The natural motions, the slowest first; null: masses are unknown, or no inertia resists some
    #: rotation.
    natural: Union[tuple[NaturalMotionRecord, ...], None]


class StraightPathRecord(Record):
    """The straight path to another pose: the platform origin moves on a line while the platform rotates about one axis."""

    #: Path end.
    to: PoseQuaternionRecord
    #: Free share of the path; 1: the whole path.
    free: float
    #: Pose at its end.
    pose: PoseQuaternionRecord
    #: Pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Requirement violated beyond this pose; null: none.
    binds: Union[LimitRecord, None]


class StuckLegRecord(Record):
    """The remaining motion with a leg stuck, or free."""

    #: The leg, from 1.
    leg: int
    #: Travel of its drive per coordinate of the pose: design units of legs, degrees of cranks, per design
    #: unit and per `deg` or `rad` of `frames`. With the drive stuck only a number with 0 can still be
    #: changed alone; five independent changes are left.
    rates: tuple[Union[float, None], ...]
    #: Motion that is lost, and the only one left when the leg is free and the others hold; null at a
    #: singular pose.
    screw: Union[ScrewRecord, None]
    #: Poses with a shorter leg, up to its limit, a tenth of its length, or the first singular pose; none
    #: for cranks.
    shorter: tuple[LegPathPoseRecord, ...]
    #: Poses with a longer leg.
    longer: tuple[LegPathPoseRecord, ...]


class SymmetryRecord(Record):
    """The search result for the three-fold symmetry that a design has at home and does not require."""

    #: Result.
    three_fold: SymmetryWord
    #: Reason, and how to switch it off, in one sentence.
    message: str


class TightestRecord(Record):
    """The requirement with the least margin as a share of its limit."""

    #: The kind of requirement.
    name: TermKind
    #: Margin over its limit, such as the travel of the legs or the greatest force; negative for a
    #: violation.
    share: Union[float, None]


class TimedMarginRecord(Record):
    """A least margin with its time."""

    #: Time of the least margin, seconds.
    time_s: float
    #: The margin.
    margin: MarginRecord


class TolerancesAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: Result of `assess`; null: it has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Allowed pose error.
    bound: PoseErrorRecord
    #: The tool point, platform frame.
    tool: tuple[Union[float, None], ...]
    #: The unit of lengths.
    units: str
    #: Error allowed at all joints together, in any direction, to first order.
    all_joints_radius: JointLimitRecord
    #: Error allowed in all coordinates together, to first order.
    all_coordinates: JointLimitRecord
    #: Joints, most critical first.
    joints: tuple[JointBudgetRecord, ...]
    #: Pose errors of the worst joint errors, solved exactly.
    worst_errors: WorstErrorsRecord
    #: Exact check of the first-order radius.
    solved: SolvedBudgetRecord
    #: Random errors in the budget.
    trials: TrialsRecord
    #: Random errors with the calibration covariance; null: not requested.
    calibrated: Union[TrialsRecord, None]
    #: Uncertainty of computed poses by calibration errors, to first order; null: not requested.
    calibrated_poses: Union[CalibratedPosesRecord, None]
    #: Greatest errors from all causes (joints, leg lengths, temperature); null: not requested.
    map: Union[ErrorMapRecord, None]
    #: The poses evaluated.
    poses: BudgetPosesRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class TravelRecord(Record):
    """A free travel and its end."""

    #: Length of the travel, not negative.
    free: float
    #: The value at the end.
    value: float
    #: Requirement violated beyond the end; null: none within the range, half a turn, or ten sizes of the
    #: design.
    binds: Union[LimitRecord, None]


class TrialsRecord(Record):
    """Random errors in the budget."""

    #: Number of random samples.
    count: int
    #: Number of lost poses.
    lost: int
    #: Number of poses within the bound.
    within_bound: int
    #: Number of poses beyond the bound.
    beyond_bound: int
    #: Pose errors of the nominal formula.
    formula: PoseErrorsRecord
    #: Differences from their first-order values.
    first_order_discrepancy: PoseErrorsRecord
    #: Errors after one Newton step with actual joints.
    after_one_step: PoseErrorsRecord
    #: Errors after two Newton steps.
    after_two_steps: PoseErrorsRecord


class TrilaterationStepRecord(Record):
    """One trilateration: a joint placed by its distances from three others."""

    #: Joints already placed.
    from_: tuple[str, ...]
    #: The joint placed.
    place: str
    #: Whether all four joints are on one body: the joint then has one place instead of two.
    rigid: bool


class UnobservableRecord(Record):
    """A change of joints and offsets that leaves all measured lengths almost unchanged."""

    #: The displaced joints, the farthest first.
    joints: tuple[JointShiftRecord, ...]
    #: The changed offsets.
    offsets: tuple[OffsetShiftRecord, ...]


class VariableRecord(Record):
    """A chosen quantity."""

    #: The name of the quantity.
    name: str
    #: Initial value.
    start: Union[float, None]
    #: Chosen value.
    value: Union[float, None]
    #: Least and greatest allowed value.
    bounds: tuple[Union[float, None], ...]


class VerifiedRecord(Record):
    """A summary of a verification."""

    #: The verdict.
    verdict: VerdictWord
    #: The largest distance of matched poses.
    worst_distance: Union[float, None]
    #: Number of length sets; both designs were solved at each.
    sample_count: int


class VerifyAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The verdict.
    verdict: VerdictWord
    #: Verdict in words, with the numbers that decided.
    explanation: str
    #: Whether exact arithmetic proves the verdict; `level` of the map names the joints it holds for.
    proved: bool
    #: The algebraic evidence; if no motion was found, the map between the designs as given.
    map: MapRecord
    #: Bounds on the squared lengths of B minus A s + c, design units squared. They hold at all poses of
    #: `sampling`, for any tolerance of the map. Null: the map is exact by proof, or singular, or no motion
    #: was found.
    deviation_bounds: Union[tuple[Union[float, None], ...], None]
    #: Largest distance of matched poses; null: none were compared.
    worst_distance: Union[float, None]
    #: The numerical evidence.
    samples: tuple[SampleRecord, ...]
    #: The version of the answer format, always 1.
    schema_version: int
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Unmatched poses set aside, because rounding of the joints decides whether they exist. Absent: no
    #: motion was found.
    beyond_precision: Union[BeyondPrecisionRecord, None]
    #: Pose distinguishing the designs; null: none was found.
    counterexample: Union[CounterexampleRecord, None]
    #: The box of random poses; absent: no motion was found.
    sampling: Union[SamplingRecord, None]
    #: Whether base and platform of the second design were exchanged.
    exchanged: Union[bool, None]
    #: Rigid motions that make the second design equivalent, with `--align`.
    alignment: Union[AlignmentRecord, None]
    #: The file written.
    output: Union[str, None]


class ViolationRecord(Record):
    """One fault of a design file."""

    #: A stable short code.
    code: str
    #: The line, from 1.
    line: int
    #: The column, from 1.
    column: int
    #: The fault.
    message: str
    #: The correction to write.
    help: str


class WarningRecord(Record):
    """A warning about a design file that can still be used."""

    #: A stable short code.
    code: str
    #: The design file.
    path: str
    #: Line, from 1.
    line: int
    #: The problem.
    message: str
    #: The remedy.
    help: str


class WitnessRecord(Record):
    """A pose with rational coordinates."""

    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Orientation, quaternion of any norm, scalar part first.
    quaternion: tuple[int, ...]


class WorkspaceSizeRecord(Record):
    """The size of the workspace around home."""

    #: Volume that straight paths from home reach, design units cubed; an estimate from the paths that were
    #: followed.
    volume: float
    #: Relative difference of the volume by every second path.
    volume_uncertainty: float
    #: Number of paths followed.
    rays: int
    #: Limits ending the paths, the most frequent first.
    ends: tuple[RayEndRecord, ...]
    #: Largest free ball of positions around home, at the orientation of home, design units.
    ball_radius: FreeSizeRecord
    #: Half widths of the largest box proved free around home, at its orientation, along the axes of the
    #: base frame, design units.
    box_proved: tuple[float, ...]
    #: Half widths of the largest box without violation found, design units.
    box_searched: tuple[float, ...]
    #: Requirement violated just beyond the box; null: none was found.
    box_binds: Union[LimitRecord, None]
    #: Rotations about axes of the base frame at the platform origin, at home.
    turns: tuple[FreeTurnRecord, ...]
    #: Largest free tilt in every direction, at the position of home, degrees.
    tilt_deg: FreeSizeRecord
    #: Largest free rotation about every axis, at the position of home, degrees.
    turn_deg: FreeSizeRecord
    #: Required workspace; null: none.
    required: Union[RequiredSizeRecord, None]


class WorstErrorsRecord(Record):
    """Errors of the pose for the worst errors of all joints, solved exactly."""

    #: Pose errors at this radius; null: the pose was lost.
    in_budget: Union[PoseErrorRecord, None]
    #: Pose errors at 1.5 times the radius; null: the pose was lost.
    times_1_5: Union[PoseErrorRecord, None]
    #: Pose at which the errors were solved.
    pose: PoseQuaternionRecord


class WorstPoseRecord(Record):
    """The pose with the worst conditioning."""

    #: Index among the poses held, from 0.
    index: int
    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]


class WrenchRecord(Record):
    """A force and a torque."""

    #: Force units.
    force: tuple[Union[float, None], ...]
    #: About the point, force units times design units.
    torque: tuple[Union[float, None], ...]


DemandWord = Union[TermKind, Objective, SpecialDemand]

DesignAroundHome = tuple[float, float]

DesignDegreesAroundHome = tuple[float, float]

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

DesignSafetyMargin = Union[DesignNotNegative, DesignPercent]

DesignVector = tuple[DesignNumber, ...]

DesignAxes = Union[Literal["home", "normal", "optimize"], DesignVector, tuple[Union[Literal["normal"], DesignVector], ...]]

DesignBody = dict[str, Union[tuple[DesignQuantity, ...], Any, dict[str, Any]]]

DesignHousing = Union[DesignPositive, DesignEdges]

DesignRows = tuple[DesignVector, ...]
