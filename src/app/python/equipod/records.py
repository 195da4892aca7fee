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
WorkspaceWord = Literal["default", "design"]


class AccuracyRecord(Record):
    """The allowed error of the pose."""

    #: Error of the platform origin, design units.
    position: float
    #: Error of the orientation, degrees.
    rotation_deg: float


class ActiveBoundRecord(Record):
    """An active bound."""

    #: The name of a variable or a requirement, or `abs_det`.
    name: str
    #: The kind of bound.
    kind: ActiveBoundWord
    #: The value of the variable or the margin of the limit.
    value: Union[float, None]
    #: The unit of the value; empty for a pure number.
    unit: str


class ActiveBoundsRecord(Record):
    """The active bounds of a platform, and the growth of its bodies."""

    #: Active ranges of variables and active limits.
    bounds: tuple[ActiveBoundRecord, ...]
    #: Growth of the base as a factor: greatest distance of a base joint from the centre of the base
    #: joints, divided by its value in the design.
    base_growth: Union[float, None]
    #: Growth of the platform as a factor: greatest distance of a platform joint from the centre of the
    #: platform joints, divided by its value in the design.
    platform_growth: Union[float, None]
    #: The bounds in one sentence.
    message: str


class AlignmentRecord(Record):
    """The rigid motions that make one design equivalent to another."""

    #: The result in one sentence, with the numbers that decided.
    explanation: str
    #: The result with base and platform of the second design exchanged.
    exchanged: OtherAlignmentRecord
    #: The result with the mirror image of the second design.
    mirrored: OtherAlignmentRecord
    status: Union[Literal["found", "none", "undecided"], None]
    #: The motions, the smallest first.
    motions: Union[tuple[MotionRecord, ...], None]
    #: Whether the list of motions is complete.
    all: Union[bool, None]
    #: Dimension of the families that contain the motions.
    freedom: Union[int, None]
    #: The quantity in which the designs differ, which proves it.
    difference: Union[DifferenceRecord, None]
    #: The motion that comes nearest.
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
    #: The name of the assessed design.
    name: str
    #: The unit of lengths, as in `pose`.
    length_unit: str
    #: The role of the design in this answer.
    role: DesignRoleWord
    #: The verdict for all poses that `assessed_poses` names. True: every margin and det J are proved.
    #: False: one pose proves a violation or a change of sign of det J. Null: neither is proved.
    met: Union[bool, None]
    #: The verdict in one sentence.
    explanation: str
    #: The poses assessed.
    assessed_poses: AssessedPosesRecord
    #: The verdict for the safety margins. True: every margin is proved to keep its safety margin. False:
    #: the given pose proves the opposite. Null: neither is proved.
    safety_margin_kept: Union[bool, None]
    #: The least margin of each kind.
    requirements: tuple[MarginRecord, ...]
    #: The requirement with the least margin as a share of its limit; null: no requirement has a limit to
    #: compare with.
    tightest: Union[TightestRecord, None]
    #: Whether the workspace holds singular poses.
    regular: RegularityRecord
    #: The result on singular poses in one sentence.
    regular_explanation: str
    #: The worst conditioning of the Jacobian over the sampled poses: a value found, without limit and
    #: proof.
    conditioning: LeastConditioningRecord
    #: Number of poses sampled.
    poses: int
    #: Number of cells over which margins were bounded.
    cells: int
    #: The lightest drive that meets the requirements, from the table that the design names. Null: the
    #: design names none, or the answer has another subject.
    lightest_drive: Union[LightestDriveRecord, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Assumptions about masses that the file leaves open, one sentence each. Absent: no force, torque or
    #: natural frequency is assessed, or the enclosing answer has the list.
    assumptions: Union[tuple[str, ...], None]


class AssessedPosesRecord(Record):
    """The poses of an assessment, with home."""

    #: Whether the design states a workspace; otherwise only home is assessed.
    stated: bool
    #: Whether every pose of a region around home is assessed.
    region: bool
    #: Number of single poses; the motions between them are not assessed.
    listed: int
    #: Number of poses of a trajectory; the straight motions between them are assessed too.
    trajectory: int
    #: The wording of the verdict if the requirements are met at these poses.
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
    #: The convention in which poses were read, and of `in_frames`.
    frames: PoseConventionRecord
    #: The pose.
    pose: PoseQuaternionRecord
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: The reference point on the platform, platform frame of `frames`: wrenches, shifts and stiffness are
    #: about it.
    point: tuple[Union[float, None], ...]
    #: The body whose axes all vectors have: `base` or `platform`.
    axes: str
    #: The lengths that the legs show; null: the legs are rods on cranks.
    lengths: Union[tuple[float, ...], None]
    #: Every requirement is met, and det J has the sign that it has at home.
    allowed: bool
    #: Requirements that are violated, the worst first.
    violated: tuple[LimitRecord, ...]
    #: The evidence of a singular pose; null: the pose is regular.
    singular: Union[SingularEvidenceWord, None]
    #: Smallest over largest singular value of the Jacobian of legs or rods with the characteristic length:
    #: 1 at best.
    inverse_condition: Union[float, None]
    #: The forces that hold the loads of the design and the wrench of `--wrench`, at rest.
    held: tuple[HeldWrenchRecord, ...]
    #: The wrench that the forces of `--forces` hold; null: none were given.
    wrench: Union[WrenchRecord, None]
    #: Rows of the matrix that maps leg forces (or crank torques) to the wrench that they hold, force
    #: before torque, as in a six-axis load cell; null where a rod does not reach or a crank is singular.
    wrench_matrix: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Stiffness at the point; null: the design states neither `leg_stiffness` nor, for cranks,
    #: `stiffness`.
    stiffness: Union[PointStiffnessRecord, None]
    #: The motion of the point for a step of the drives; null at a singular pose.
    resolution: Union[ResolutionRecord, None]
    #: The remaining motion with the leg of `--leg` stuck, or free; null: no leg was named.
    stuck: Union[StuckLegRecord, None]
    #: The nearest singular pose found; null: it was not asked for, or no way met one.
    nearest_singular: Union[NearestSingularPoseRecord, None]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: The angles of the cranks, where a design has some and all rods reach.
    angles_deg: Union[tuple[float, ...], None]
    #: The first rod that does not reach, where one does not; nothing else is then known.
    out_of_reach: Union[OutOfReachRecord, None]


class BestLineRecord(Record):
    """A line that joints of a body lie nearly on, body frame, design units."""

    #: The body.
    body: Body
    #: A point of the line: the centroid of the joints.
    point: tuple[Union[float, None], ...]
    #: A unit vector along the line.
    direction: tuple[Union[float, None], ...]
    #: The greatest distance of a joint from the line, design units.
    distance: Union[float, None]
    #: The greatest distance of a joint from the centroid along the line, design units.
    reach: Union[float, None]


class BeyondPrecisionRecord(Record):
    """Numbers of poses that were set aside."""

    #: Number of poses of A.
    a: int
    #: Number of poses of B.
    b: int


class BoundedProof(Record):
    """The numbers of a proof that all poses up to a distance are listed."""

    #: Certified poses listed, with multiplicity.
    poses: int
    #: Number of far poses, certified to be different and farther out, or at infinity; null: the proof
    #: needs none.
    far: Union[int, None]
    #: Bound on rotation entries: every pose whose rotation matrix has no entry of a larger modulus is
    #: listed. Entries of real rotations are at most 1. Null: the proof is about real poses alone.
    R: Union[float, None]
    #: Largest change of the two ends of a leg (both together) in a neighbouring design that has no more
    #: poses, design units. The proof is then about real poses. Null: it is about far poses.
    neighbour: Union[float, None]
    #: The far poses, the nearest ones first.
    others: tuple[FarPoses, ...]


class BranchConflictRecord(Record):
    """A proof that a branch or a part of it is empty."""

    #: A short stable code.
    code: Literal["vertices_too_close", "outside_bounds", "no_space", "pair_too_close", "det_too_small", "combination"]
    #: The proof in one sentence, with its numbers.
    message: str


class BranchCountsRecord(Record):
    """Counts of the verdicts on the branches."""

    #: All branches.
    total: int
    #: Feasible branches.
    feasible: int
    #: Proved empty: no part of a zone is within the bounds.
    infeasible_bounds: int
    #: Proved empty: no space for the joints.
    infeasible_spacing: int
    #: Proved empty: |det A| is too small.
    infeasible_det: int
    #: Covered by the bound over all offsets, without a search.
    bounded: int
    #: Undecided.
    unproved: int
    #: The conic solver failed.
    solver_failure: int


class BranchRecord(Record):
    """A branch: one zone for each offset."""

    #: Zone of each offset: before, inside or beyond its edge.
    branch: str
    #: The outcome of the branch.
    verdict: BranchWord
    #: The best objective of the branch, if it is dominated.
    objective: Union[float, None]
    #: The offsets with this objective.
    offsets: Union[tuple[Union[float, None], ...], None]
    #: Number of parts of the branch searched.
    cells: int
    #: Proved conflicts of the branch or of parts of it.
    conflicts: tuple[BranchConflictRecord, ...]


class BudgetPosesRecord(Record):
    """The poses evaluated."""

    #: Number of poses.
    count: int
    #: The source of the workspace.
    workspace: WorkspaceWord


class CalibrateAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of lengths.
    units: str
    #: The convention in which measured poses were read, and of `in_frames`.
    frames: PoseConventionRecord
    #: The outcome of the calibration.
    outcome: CalibrateOutcome
    #: The reason of the outcome, one sentence.
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
    #: Standard deviations of the coordinates, design units; null: the joint was held.
    deviations: Union[tuple[Union[float, None], ...], None]
    #: The displacement from the position in the design, design units.
    moved: tuple[Union[float, None], ...]


class CalibratedOffsetRecord(Record):
    """The offset of a leg."""

    #: The leg, from 1.
    leg: int
    #: The shown length minus the distance of the joints, design units.
    offset: Union[float, None]
    #: The standard deviation of the offset, design units; null: the offset was held.
    deviation: Union[float, None]


class CalibratedPosesRecord(Record):
    """Standard deviations of poses computed from lengths with the calibrated machine. The noise of the lengths adds to them."""

    #: Whether the design file has correlations.
    correlations: CorrelationsWord
    #: Number of poses evaluated.
    poses: int
    #: Root mean square error of the tool point, design units.
    position: DeviationRecord
    #: Root mean square error of the orientation, degrees.
    rotation_deg: DeviationRecord


class CalibrationRecord(Record):
    """The calibrated machine with its residuals and deviations."""

    #: Number of measured poses.
    poses: int
    #: Number of unknown coordinates and offsets.
    unknowns: int
    #: The frames of joints, deviations and covariance.
    frames: CalibrationFrames
    #: The motions from the frames of the measurements to the design frames; null: joints are given in the
    #: frames of the measurements.
    motions: Union[FrameMotionsRecord, None]
    #: Standard deviations of the measurements.
    noise: NoiseRecord
    #: The loss function of the fit.
    loss: LossRecord
    #: The starting point of the fit.
    start: StartRecord
    #: Whether the fit converged.
    converged: bool
    #: Number of steps in all.
    steps: int
    #: The calibrated joints: all joints that carry legs.
    joints: tuple[CalibratedJointRecord, ...]
    #: Leg offsets in leg order: shown length minus distance of the joints, design units.
    offsets: tuple[CalibratedOffsetRecord, ...]
    #: Covariance of the unknowns, squared design units; directions that are not identified contribute no
    #: variance.
    covariance: CovarianceRecord
    #: Uncertainty of poses computed with the machine; null: not all unknowns are identified, or the design
    #: has no pose to evaluate.
    computed_poses: Union[ComputedPosesRecord, None]
    #: Observability of the machine's parameters by these measurements.
    observability: ObservabilityRecord
    #: Residuals of the design before calibration.
    before: ResidualsRecord
    #: Residuals of the calibrated machine, without outliers.
    after: ResidualsRecord
    #: Leave-one-out residuals to first order, without outliers: each pose against the machine fitted to
    #: the other poses.
    leave_one_out: ResidualsRecord
    #: Residuals of the measurements of `--check`; null: there are none.
    check: Union[ResidualsRecord, None]
    #: Lines of the measurements that the unknowns depend on: without one of them, the unknowns are not
    #: determined.
    indispensable: tuple[int, ...]
    #: Test of the residuals against the noise.
    chi_square: ChiSquareRecord
    #: Measurements that contradict the others, the farthest first.
    outliers: tuple[OutlierRecord, ...]
    #: Two legs whose measured lengths are probably exchanged, from 1: swapped, they are five times nearer
    #: to the design. Null: none.
    exchanged_legs: Union[tuple[int, ...], None]


class CaseRecord(Record):
    """A known kind of singular design."""

    #: The name of the case.
    case: str
    #: The short code of the reason.
    reason: str
    #: The legs of the case, from 1.
    legs: tuple[int, ...]
    #: The case in one sentence.
    explanation: str


class CertificateRecord(Record):
    """The proof that a root exists and is unique nearby, with all its numbers."""

    kind: Union[Literal["study", "cluster", "octahedral"], None]
    #: Index of the coordinate that equals 1.
    patch: Union[int, None]
    #: A power of two, design units.
    unit: Union[float, None]
    #: The centre of the ball.
    centre: Union[ComplexRecord5, ComplexRecord4, None]
    #: Low-order parts of the centre, to be added to it.
    centre_low: Union[ComplexRecord5, None]
    #: One root lies within this distance of the centre.
    radius: Union[float, None]
    #: No other root lies within this distance.
    uniqueness_radius: Union[float, None]
    #: Contraction of the simplified Newton map on the ball of the radius, below 1.
    contraction: Union[float, None]
    #: Precision of the centre.
    precision: Union[CentrePrecision, None]
    #: Reality of the root, proved for all squared lengths within the rounding of the data.
    reality: Union[ProvedReality, None]
    #: Discs that contain the pose of the root.
    enclosure: Union[EnclosureRecord, None]
    #: Number of roots, counted with multiplicity; at least 2.
    multiplicity: Union[int, None]
    #: Radius of the disc of t.
    reach: Union[float, None]
    #: Remainder of the equation divided by its leading term, the power of t with the multiplicity as
    #: exponent, on the circle; below 1.
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
    #: The verdict in a sentence, with the name.
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
    #: The exact decision for the joints as numbers; null: some joints are known only between bounds.
    singular_as_written: Union[bool, None]
    #: The evidence that the home pose is singular; null: it is regular, or the design states none.
    singular_home: Union[SingularEvidenceWord, None]
    #: A short code of the reason; null: regular.
    reason: Union[str, None]
    #: The verdict in one sentence.
    explanation: str
    #: The proof of the answer for the joints as written.
    proof: ProofWord
    #: The proof in one sentence.
    proof_explanation: str
    #: Rank of the leg vectors.
    leg_rank: int
    #: Generic rank of the Jacobian: the rank of the leg lines at almost every pose.
    jacobian_rank: int
    #: A pose at which the leg lines have this rank.
    witness: WitnessRecord
    #: The first linear dependency of the leg vectors; null: there is none.
    dependency: Union[DependencyRecord, None]
    #: All linear dependencies of the leg vectors.
    dependencies: tuple[DependencyRecord, ...]
    #: The legs of the first known case, from 1.
    dependent_legs: Union[tuple[int, ...], None]
    #: The known cases that apply, the most specific first.
    cases: tuple[CaseRecord, ...]
    #: The Griffis-Duffy type; null: the joints do not lie on the sides of two triangles.
    griffis_duffy: Union[GriffisDuffyRecord, None]
    #: The nearest singular design found; null: the design itself is singular.
    nearest_singular: Union[NearestSingularRecord, None]
    #: Number of finite poses, real and complex, for generic leg lengths.
    pose_count: PoseCountRecord
    #: Points common to the equations of six legs for generic lengths, by kind. Null: the poses are not
    #: isolated, or not counted.
    common_points: Union[CommonPointsRecord, None]
    #: An upper bound on the number of isolated finite poses, by a theorem.
    pose_bound: PoseBoundRecord
    #: The steps in which the poses can be computed: by quadratic equations alone, or with one part of the
    #: platform first.
    solvability: Solvability
    #: The best-fitting line through the joints of each body, base first. A body whose joints all lie on
    #: one line can rotate about it. A body with all joints at one point has no line.
    best_lines: tuple[BestLineRecord, ...]
    #: Singular values of the matrix of normalised leg vectors.
    singular_values: tuple[Union[float, None], ...]
    #: Inverse condition number of the Jacobian at random poses.
    jacobian_inverse_condition: ConditioningRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class ChiSquareRecord(Record):
    """Agreement of residuals with the noise."""

    #: Sum of the squares of whitened residuals.
    value: Union[float, None]
    #: Number of residuals minus number of identified unknowns.
    degrees_of_freedom: int
    #: The probability of a larger value if model and noise are right; null: the noise is estimated from
    #: the same residuals.
    probability: Union[float, None]


class ClosurePolynomialRecord(Record):
    """The closure polynomial in one squared distance, with its results on the number of real poses."""

    #: The joints of the virtual leg; null: none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: The two joints with the unknown squared distance.
    unknown: tuple[str, ...]
    #: The joints of the first triangle.
    start: tuple[str, ...]
    #: The trilaterations after the first triangle.
    sequence: tuple[TrilaterationStepRecord, ...]
    #: The unknowns by their names.
    unknowns: tuple[str, ...]
    #: The degree before spurious factors are removed.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: The exponents of the unknowns in each term.
    exponents: tuple[tuple[int, ...], ...]
    #: The exact coefficient of each term, integers as decimal text; for one unknown the constant comes
    #: first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: The multiplicity of each real root.
    real_root_multiplicities: tuple[int, ...]
    #: Singular factors.
    factors: tuple[SingularFactorRecord, ...]
    #: Number of real poses at each real root; null: not determined by the polynomial.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Total number of real poses, proved; null: not determined by the polynomial.
    poses_real_proved: Union[int, None]
    #: Bounds [low, high] of the coefficients; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class ClosureRecord(Record):
    """The closure polynomial beside the poses."""

    #: The joints of the virtual leg; null: none is needed.
    virtual_leg: Union[tuple[str, ...], None]
    #: The two joints with the unknown squared distance.
    unknown: Union[tuple[str, ...], None]
    #: The joints of the first triangle.
    start: Union[tuple[str, ...], None]
    #: The trilaterations after the first triangle.
    sequence: Union[tuple[TrilaterationStepRecord, ...], None]
    #: The unknowns by their names.
    unknowns: Union[tuple[str, ...], None]
    #: The degree before spurious factors are removed.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: Union[CoefficientsWord, None]
    #: The exponents of the unknowns in each term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: The exact coefficient of each term, integers as decimal text; for one unknown the constant comes
    #: first.
    coefficients: Union[tuple[str, ...], None]
    #: Bounds [low, high] of the coefficients; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: The multiplicity of each real root.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: Singular factors.
    factors: Union[tuple[SingularFactorRecord, ...], None]
    #: Number of real poses at each real root; null: not determined by the polynomial.
    real_poses_at_roots: Union[tuple[int, ...], None]
    #: Total number of real poses, proved; null: not determined by the polynomial.
    poses_real_proved: Union[int, None]
    #: The reason why trilaterations give no polynomial.
    no_sequence: Union[str, None]
    #: The reason.
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
    #: A bound on the probability that the numbers are wrong.
    error_probability: float


class CompareAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The unit of lengths for all designs.
    length_unit: str
    #: The unit of forces for all designs.
    force_unit: str
    #: The manoeuvres about home; forces, speeds and powers are computed along them.
    manoeuvres: tuple[str, ...]
    #: The accuracy for the joint tolerances; null: none was requested.
    accuracy: Union[AccuracyRecord, None]
    #: Characteristic length of every conditioning in this answer: the value of the first design, design
    #: units.
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
    #: Median over the poses of the root mean square error of the measured platform origin, design units.
    position_median: Union[float, None]
    #: Greatest root mean square error of the measured platform origin over the poses, design units.
    position_greatest: Union[float, None]
    #: Median over the poses of the root mean square error of the orientation, degrees.
    rotation_deg_median: Union[float, None]
    #: Greatest root mean square error of the orientation over the poses, degrees.
    rotation_deg_greatest: Union[float, None]
    #: The pose with the greatest error of position.
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
    #: Number of branches with this as their first proof.
    branches: int
    #: The proof for one of these branches in one sentence, with its numbers.
    message: str


class ConflictRecord(Record):
    """A conflict: a set of requirements that cannot be met together; without any one of them the others were met."""

    #: Whether the conflict is proved.
    proved: bool
    #: The requirements in conflict, with the amounts to relax. Empty: the branches are empty for different
    #: reasons.
    requirements: tuple[GiveRecord, ...]
    #: The reasons for empty branches of the offsets, by kind; empty: the search has no branches.
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

    #: The leg of FROM for each leg of TO, from 1; null: none.
    legs: tuple[Union[int, None], ...]
    #: The distance of the two legs divided by the size of the design.
    distances: tuple[Union[float, None], ...]
    #: Whether every leg of FROM is one leg of TO.
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
    #: Whether a certificate proves that the pose is a solution for this design.
    certified: bool
    #: The leg of the other design with the greatest error of length, from 1.
    leg: int
    #: The error of its squared length, relative to the squared size.
    miss: Union[float, None]
    #: The rounding error expected in this number.
    rounding: Union[float, None]


class CounterexampleRecord2(Record):
    """A pose that the lengths of one design allow and the corresponding lengths of the other do not."""

    #: Index into `samples`, from 0.
    sample: int
    #: The design that has the pose: A or B.
    solves: Literal["A", "B"]
    #: The pose.
    pose: ComplexRecord2
    #: Whether a certificate proves that the pose is a solution for this design.
    certified: bool
    #: The leg of the other design with the greatest error of length, from 1.
    leg: int
    #: The error of its squared length, relative to the squared size.
    miss: Union[float, None]
    #: The rounding error expected in this number.
    rounding: Union[float, None]


class CountsRecord(Record):
    """Counts of the members of the class."""

    #: Patterns of kept and moved legs.
    patterns: int
    #: Patterns up to the symmetries of the hexagon that keep base and platform apart.
    classes: int
    #: Patterns up to all symmetries of the hexagon.
    classes_exchange: int
    #: Topologies of shared joints, including the octahedral one.
    topologies: int
    #: The same with base and platform exchangeable.
    topologies_exchange: int
    #: Topologies that are reached by offsets introduced one at a time.
    sequential_topologies: int
    #: The same with base and platform exchangeable.
    sequential_topologies_exchange: int
    #: Patterns that are reached by offsets introduced one at a time.
    sequential_patterns: int
    #: Patterns that split joints only.
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
    #: Greatest torque under the payload and the loads, one at a time, force units times design units.
    torque: Union[float, None]
    #: Greatest crank speed at the platform speed that the design requires, degrees per second.
    speed_deg: Union[float, None]
    #: Greatest torque along the manoeuvres.
    motion_torque: Union[float, None]
    #: Greatest speed along the manoeuvres, degrees per second.
    motion_speed_deg: Union[float, None]


class CrankMotionRecord(Record):
    """A crank along a motion."""

    #: The leg of the crank, from 1.
    leg: int
    #: The least angle, degrees.
    least_deg: ExtremeRecord
    #: The greatest angle, degrees.
    greatest_deg: ExtremeRecord
    #: The speed of greatest size, degrees per second.
    speed_deg: ExtremeRecord
    #: The acceleration of greatest size, degrees per second squared.
    acceleration_deg: ExtremeRecord
    #: The torque of greatest size about the axis, force units times design units. Null: no masses are
    #: known, or torques are not determined. Cranks and rods count as massless.
    torque: Union[ExtremeRecord, None]
    #: Root mean square of the torque over time, force units times design units.
    rms_torque: Union[float, None]
    #: The power of greatest size, watts; negative: the drive brakes.
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

    #: The safety margin on every limit, percent.
    percent: float
    #: Whether the platform found keeps it. False: no platform with it was found, and the search continued
    #: without it.
    kept: bool
    #: The result in one sentence.
    message: str


class DependencyRecord(Record):
    """A linear dependency of leg vectors: `sum c_i v_i = 0`."""

    #: The legs with nonzero coefficients, from 1.
    legs: tuple[int, ...]
    #: The numbers `c_i`.
    coefficients: tuple[Union[float, None], ...]
    #: The value of `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
    constant: Union[float, None]
    #: Dimension of the span of the base ends.
    base_dimension: int
    #: Dimension of the span of the platform ends.
    platform_dimension: int
    #: Relative difference between `sum c_i s_i` for the lengths of the design and the constant; null
    #: without lengths.
    lengths_defect: Union[float, None]


class DerivationRecord(Record):
    """The derivation of A, c and det A for one platform of the class from coplanar joints, with the forward kinematics as a check."""

    #: Whether the numbers are exact: the joints are exact, and each moved joint lies exactly on its line.
    #: Otherwise the numbers are doubles.
    exact: bool
    #: One row of A for each moved leg, with all offsets at once, from the legs of the octahedral platform.
    moves: tuple[LegSlideRecord, ...]
    #: The moves one at a time, each from the legs before it; det A is the product of their `rest`. Null:
    #: every order of single moves puts two legs on one another.
    sequence: Union[tuple[LegSlideRecord, ...], None]
    #: The factors of det A.
    factors: tuple[FactorRecord, ...]
    #: Products over all six offsets; det A is their difference. Null: some leg is not moved.
    products: Union[OffsetProductsRecord, None]
    #: Forward kinematics of the octahedral platform and of this one, solved independently, and the leg map
    #: from one to the other.
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
    #: The file as named by the caller; null: the design was made in memory, and its text is the text it
    #: would be saved as.
    path: Union[str, None]
    #: SHA-256 of the bytes of that file or text, hexadecimal.
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
    #: The value at the same pose if the errors of coordinates and offsets were independent.
    independent: Union[float, None]
    #: The pose with the greatest value.
    pose: PoseQuaternionRecord
    #: Covariance at this pose of the shift of the tool point (design units) and the rotation vector
    #: (degrees), base frame.
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


class DistancePolynomialRecord(Record):
    """The polynomial in the squared distance of two joints whose roots are its values at all poses. Mirror images of a planar design have one root."""

    #: The two joints with the unknown squared distance.
    unknown: tuple[str, ...]
    #: The unknowns by their names.
    unknowns: tuple[str, ...]
    #: The degree before spurious factors are removed.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: The exponents of the unknowns in each term.
    exponents: tuple[tuple[int, ...], ...]
    #: The exact coefficient of each term, integers as decimal text; for one unknown the constant comes
    #: first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: The multiplicity of each real root.
    real_root_multiplicities: tuple[int, ...]
    #: The reason why trilaterations give no polynomial.
    no_sequence: str
    #: Bounds [low, high] of the coefficients; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class DriveRecord(Record):
    """A drive of the table, in the units of the design."""

    #: The name of the drive.
    name: str
    #: Line of the table, from 1.
    line: int
    #: Whether the drive fits: true and false are proved; null: undecided.
    fits: Union[bool, None]
    #: Whether the safety margin on every limit is kept too: true and false are proved; null: undecided.
    safety_margin_kept: Union[bool, None]
    #: The travel, design units.
    stroke: Union[float, None]
    #: Least and greatest length from joint centre to joint centre, design units.
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
    #: The source of the numbers; null: not in the table.
    source: Union[str, None]
    #: The result of `assess` for the design with the drive.
    assessment: AssessAnswer
    #: The results along the requested motions.
    motions: tuple[MotionRunRecord, ...]


class DriveSearchRecord(Record):
    """The search over the drives of a table."""

    #: The name of the drive of the answer; null: no drive leads to a platform that is proved to meet the
    #: requirements.
    chosen: Union[str, None]
    #: The criterion for choosing among the drives that meet the requirements.
    ranked_by: DriveRanking
    #: The currency of prices from the table; null: the table names none.
    currency: Union[str, None]
    #: Whether the search was interrupted before every drive that could win was tried.
    interrupted: bool
    #: The result in one sentence.
    message: str
    #: All drives, the best first.
    drives: tuple[SearchedDriveRecord, ...]


class DriveSolutionRecord(Record):
    """The iteration for the pose with given drive lengths."""

    #: The status of the solution.
    status: DriveSolutionWord
    #: The reason if there is no pose; null: there is one.
    reason: Union[str, None]
    #: The lengths that the drives show, design units.
    lengths: tuple[float, ...]
    #: The distances of the joints at the pose found, design units.
    distances: tuple[float, ...]
    #: Number of fixed-point steps.
    steps: int
    #: The greatest ratio of two successive changes of the corrections; 0 if there were none above
    #: rounding.
    factor: Union[float, None]
    #: Proved bound on the distance from this platform origin to the one with exactly these lengths, design
    #: units.
    position_bound: Union[float, None]
    #: Proved bound on the angle to the rotation with exactly these lengths, degrees.
    angle_bound_deg: Union[float, None]
    #: The contraction factor of the Newton map around the pose; null: not proved.
    contraction: Union[float, None]


class DrivesAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: Whether some drive fits: true and false are proved; null: undecided.
    met: Union[bool, None]
    #: The name of the chosen drive: the cheapest that is proved to fit, the lightest of equally cheap
    #: ones; null: there is none.
    chosen: Union[str, None]
    #: All drives: fitting ones first, then undecided and unfit ones; within each group by price, then
    #: mass.
    drives: tuple[DriveRecord, ...]
    #: The currency of prices from the table; null: the table names none.
    currency: Union[str, None]
    #: The unit of lengths; speeds are in this unit per second.
    length_unit: str
    #: The unit of forces.
    force_unit: str
    #: The unit of masses.
    mass_unit: str
    #: Assumed values that neither the file nor the table states, one sentence each.
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

    #: The entries of the rotation matrix, rows.
    R: DiscsRecord
    #: The entries of the position, design units.
    p: DiscsRecord2


class ErrorMapRecord(Record):
    """The greatest errors of the pose by all causes together, to first order."""

    #: The greatest error of each joint, in any direction, design units.
    joint_error: Union[float, None]
    #: The greatest error of each leg length, design units.
    length_error: Union[float, None]
    #: Relative expansion of each part: base, platform and legs, with either sign.
    growth: tuple[Union[float, None], ...]
    #: Number of poses evaluated: the corners and a sample of the region, and the listed poses.
    poses: int
    #: Error of the tool point, design units.
    position: GreatestErrorRecord
    #: Error of the orientation, degrees.
    rotation_deg: GreatestErrorRecord
    #: The table of all poses written; null: none.
    path: Union[str, None]


class EvaluationRecord(Record):
    """The quality of a design."""

    #: The worst inverse condition number over the poses.
    objective: Union[float, None]
    #: The pose of this value.
    worst_pose: PoseQuaternionRecord
    #: Least distances of two joints, base and platform.
    least_distances: tuple[Union[float, None], ...]
    #: det A; null: there is no leg map.
    det: Union[float, None]
    #: The least margin of each requirement.
    requirements: tuple[RequirementMarginRecord, ...]
    #: No requirement is violated.
    met: bool
    #: Every margin is at least its safety margin.
    safety_margin_kept: bool


class ExactNumberRecord(Record):
    """A number, exact or as a double."""

    #: The nearest double.
    value: Union[float, None]
    #: The number as an expression, such as 4/5 or 1/2 + sqrt(3)/6; null: known only as a double.
    exact: Union[str, None]


class ExactRoundingOutcome(Record):
    """The exact rounding, or the reason why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: Whether exact arithmetic proves equivalence with its own octahedral platform.
    proved: Union[bool, None]
    #: The verdict of leg map and forward kinematics.
    verdict: Union[RoundingVerdict, None]
    #: Whether rotations by 120 degrees map both triangles with their joints to themselves.
    three_fold: Union[bool, None]
    #: The offsets in order around the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: The figures of the rounded design.
    evaluation: Union[EvaluationRecord, None]
    #: Statistics of the search.
    search: Union[RoundingSearchRecord, None]
    #: The obstacle.
    error: Union[NoRoundingError, None]


class ExactRoundingRecord(Record):
    """A rounding with all joints exactly on the sides of two triangles, with holes as their corners."""

    #: The grids used.
    grids: GridsRecord
    #: Whether exact arithmetic proves equivalence with its own octahedral platform.
    proved: bool
    #: The verdict of leg map and forward kinematics.
    verdict: RoundingVerdict
    #: Whether rotations by 120 degrees map both triangles with their joints to themselves.
    three_fold: bool
    #: The offsets in order around the hexagon: [m, g] for t = m / g.
    fractions: Union[tuple[tuple[int, ...], ...], None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: The figures of the rounded design.
    evaluation: EvaluationRecord
    #: Statistics of the search.
    search: RoundingSearchRecord


class ExploreAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: The verdict of the whole run.
    verdict: Union[ExploreVerdict, None]
    #: The verdict in one sentence, with the numbers that decided.
    explanation: Union[str, None]
    #: The name of the design.
    name: Union[str, None]
    #: The files written, in order.
    paths: Union[tuple[str, ...], None]
    #: The equivalence class.
    family: Union[FamilySizeRecord, None]
    #: The result of `assess` for the platform found; null: there is none, or the design has no
    #: requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform found; null: none.
    optimize: Union[OptimizedRecord, None]
    #: Number of conic programs solved by the library clarabel in the platform search; searches with other
    #: drives, for freedoms and for holes are not counted.
    conic_programs: Union[int, None]
    #: The cost of separate joints: figures of the design and of the platform to build; null: there is
    #: none.
    price: Union[PriceRecord, None]
    #: The result for the default safety margin of 5 % on every limit; null: the design states its own.
    safety_margin: Union[DefaultSafetyMarginRecord, None]
    #: The comparison of the design with the optimised platform; null: there is none.
    verify: Union[ComparedRecord, None]
    #: The platform with its joints on holes; null: the design states no holes, or no platform was found.
    #: The assessment applies to this platform.
    holes: Union[OnHolesRecord, None]
    #: Further freedoms that might allow a platform, each with its search result. Null: a platform meets
    #: the requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: The result for the three-fold symmetry of the design. Null: the design has none or names one, or the
    #: search could not break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table with the search result for each; null: no table was given. The rest of the
    #: answer is about the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: The poses of the design.
    fk: Union[PoseTotalsRecord, None]
    #: The stages of the run, in order.
    stages: Union[tuple[StageRecord, ...], None]
    #: The families of replaceable legs.
    components: Union[FamiliesFoundRecord, None]
    #: The search for an equivalent platform without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the platform equivalent to the nearest octahedral one meets the design's requirements: true
    #: and false are proved. Null: undecided, not assessed, or nothing is required.
    nearest_meets_requirements: Union[bool, None]


class ExploreGeneralAnswer(Record):
    """The answer of `explore` about a design that is not octahedral."""

    #: The verdict of the whole run.
    verdict: ExploreVerdict
    #: The verdict in one sentence, with the numbers that decided.
    explanation: str
    #: The name of the design.
    name: str
    #: The files written, in order.
    paths: tuple[str, ...]
    #: The stages of the run, in order.
    stages: tuple[StageRecord, ...]
    #: The families of replaceable legs.
    components: FamiliesFoundRecord
    #: The search for an equivalent platform without shared joints; null: no leg can be moved.
    moves: Union[MovesFoundRecord, None]
    #: The nearest octahedral platform; null: none was found.
    nearest: Union[NearestErrorRecord, None]
    #: Whether the platform equivalent to the nearest octahedral one meets the design's requirements: true
    #: and false are proved. Null: undecided, not assessed, or nothing is required.
    nearest_meets_requirements: Union[bool, None]
    #: The comparison of the design with its equivalent, or of the nearest octahedral platform with its
    #: equivalent. Null: neither exists.
    verify: Union[ComparedRecord, None]
    #: The poses of the design.
    fk: PoseTotalsRecord


class ExploreOctahedralAnswer(Record):
    """The answer of `explore` about an octahedral design."""

    #: The verdict of the whole run.
    verdict: ExploreVerdict
    #: The verdict in one sentence, with the numbers that decided.
    explanation: str
    #: The name of the design.
    name: str
    #: The files written, in order.
    paths: tuple[str, ...]
    #: The equivalence class.
    family: FamilySizeRecord
    #: The result of `assess` for the platform found; null: there is none, or the design has no
    #: requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform found; null: none.
    optimize: Union[OptimizedRecord, None]
    #: Number of conic programs solved by the library clarabel in the platform search; searches with other
    #: drives, for freedoms and for holes are not counted.
    conic_programs: int
    #: The cost of separate joints: figures of the design and of the platform to build; null: there is
    #: none.
    price: Union[PriceRecord, None]
    #: The result for the default safety margin of 5 % on every limit; null: the design states its own.
    safety_margin: Union[DefaultSafetyMarginRecord, None]
    #: The comparison of the design with the optimised platform; null: there is none.
    verify: Union[ComparedRecord, None]
    #: The platform with its joints on holes; null: the design states no holes, or no platform was found.
    #: The assessment applies to this platform.
    holes: Union[OnHolesRecord, None]
    #: Further freedoms that might allow a platform, each with its search result. Null: a platform meets
    #: the requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: The result for the three-fold symmetry of the design. Null: the design has none or names one, or the
    #: search could not break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table with the search result for each; null: no table was given. The rest of the
    #: answer is about the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: The poses of the design.
    fk: PoseTotalsRecord


class ExtremeRecord(Record):
    """A value with its time."""

    #: The signed value.
    value: Union[float, None]
    #: Time of the value, seconds.
    time_s: float


class FactorRecord(Record):
    """A factor of det A."""

    #: The formula in the offsets, such as 1 - t1.
    formula: str
    #: The equation of its zeros; the platform is architecturally singular there.
    zero: str
    #: The value of the factor at the offsets.
    value: ExactNumberRecord


class FailureRecord(Record):
    """A refusal or a failure."""

    #: A stable short code, `fk::not_applicable` for example.
    code: str
    #: The message in one sentence.
    message: str
    #: The faults of the design file; empty for other failures.
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
    #: The edge of each side of the hexagon, design units.
    edge_lengths: tuple[Union[float, None], ...]
    #: Numbers of patterns and topologies.
    counts: CountsRecord
    #: All patterns, or the requested one.
    patterns: tuple[PatternRecord, ...]
    #: The topologies: the ways in which legs share joints.
    topologies: tuple[FamilyTopologyRecord, ...]
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: The platform of the pattern at the offsets given, with `--offsets`.
    instance: Union[InstanceRecord, None]
    #: The derivation of its leg map from coplanar joints, with `--explain`.
    derivation: Union[DerivationRecord, None]


class FamilySizeRecord(Record):
    """The number of platforms equivalent to an octahedral one."""

    #: Number of patterns of legs.
    patterns: int
    #: Number of topologies: ways to share joints.
    topologies: int


class FamilyTopologyRecord(Record):
    """A way in which the legs of equivalent platforms share joints."""

    #: The number of the topology, from 1.
    topology: int
    #: Joints of the base.
    base_joints: int
    #: Joints of the platform.
    platform_joints: int
    #: Joints that hold more than one leg.
    shared_joints: int
    #: Whether offsets introduced one at a time lead to it.
    sequential: bool
    #: The name of a pattern with this topology.
    example: str
    #: Topologies one offset further, from 1.
    next: tuple[int, ...]


class FarPoses(Record):
    """Poses far out, certified in coordinates that are regular at infinity."""

    #: Number of poses in the group: two that are too close to be told apart, or one.
    poses: int
    #: The largest entry of their rotation matrices is at least this.
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
    #: The lightest drive that meets the requirements, from the table that the design names; null: it names
    #: none.
    lightest_drive: Union[LightestDriveRecord, None]
    #: The poses of all figures.
    assessed_poses: AssessedPosesRecord
    #: Number of poses evaluated for the figures; the assessment and the conditioning use poses of their
    #: own.
    poses: int
    #: Least leg length; null: the legs are rods on cranks.
    shortest: Union[float, None]
    #: Greatest leg length; null: the legs are rods on cranks.
    longest: Union[float, None]
    #: Greatest minus least leg length.
    stroke: Union[float, None]
    #: Number of different leg lengths at home, or rod lengths on cranks; a difference counts above a
    #: millionth of the size.
    different_legs: int
    #: Greatest leg force under the weight of all moving parts and each load, one at a time.
    force: Union[float, None]
    #: Greatest leg speed at the platform speed that the design requires.
    speed: Union[float, None]
    #: Greatest leg force along the manoeuvres.
    motion_force: Union[float, None]
    #: Greatest leg speed along the manoeuvres.
    motion_speed: Union[float, None]
    #: Greatest power of a drive along the manoeuvres, watts.
    motion_power_w: Union[float, None]
    #: The worst conditioning found by `assess`: the least inverse condition number.
    conditioning: Union[float, None]
    #: Least stiffness against a force through the platform origin, force units per design unit.
    stiffness: Union[float, None]
    #: Lowest natural frequency, hertz.
    frequency_hz: Union[float, None]
    #: Least distance of two joint centres of the base, design units.
    base_spacing: Union[float, None]
    #: Least distance of two joint centres of the platform, design units.
    platform_spacing: Union[float, None]
    #: Least clearance between two legs, design units.
    clearance: Union[float, None]
    #: Greatest distance of a base joint from the centroid of the base joints, design units.
    base_radius: Union[float, None]
    #: Greatest distance of a platform joint from the centroid of the platform joints, design units.
    platform_radius: Union[float, None]
    #: The greatest error of every joint in any direction that keeps the accuracy to first order, design
    #: units.
    joint_tolerance: Union[float, None]
    #: The reason for a missing tolerance; null: there is one, or none was requested.
    no_tolerance: Union[str, None]
    #: Assumptions about masses that the file leaves open, one sentence each. Empty: no figure is a force,
    #: a torque or a natural frequency.
    assumptions: tuple[str, ...]
    #: The angles, torques and speeds of the cranks; null: the legs change their lengths.
    cranks: Union[CrankFiguresRecord, None]


class FileSourceRecord(Record):
    """A file other than a design."""

    #: The file, as it was named.
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
    #: The rows in the order of the file.
    rows: Union[tuple[FkRowRecord, ...], None]
    #: The method that found them.
    method: Union[Method, None]
    #: The level of completeness of the list.
    completeness: Union[CompletenessWord, None]
    #: The evidence for completeness in one sentence.
    completeness_reason: Union[str, None]
    #: The numbers of the proof that the list holds all poses up to a distance; null: another proof, or
    #: none.
    bound: Union[BoundedProof, None]
    #: Whether every path is accounted for; false: roots may be missing.
    all_paths_accounted: Union[bool, None]
    #: Number of `solutions`.
    finite_count: Union[int, None]
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: Union[int, None]
    #: Number of real poses.
    real_count: Union[int, None]
    #: Number of poses that may be real or not.
    undecided_count: Union[int, None]
    #: Number of finite poses beyond the certified ones, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: The paths of the homotopy.
    paths: Union[tuple[PathRecord, ...], None]
    #: Rejected candidates that are no roots.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Path ends without a certificate: there may be one pose, several or none near each. They are not
    #: among the solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: The computations of the linear algebra libraries for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: The meaning of null for each number that is not finite.
    notes: Union[tuple[str, ...], None]
    #: The crank angles in degrees, if given. The legs are then the rods from the crank tips, rounded to
    #: doubles, and certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all given angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: The tracking of the pose, with `--near`.
    near: Union[NearRecord, None]
    #: The iteration for joints that are not ideal. The given lengths are then drive lengths, and no root
    #: gets a certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves the dimension for the lengths as written. False: the
    #: lengths satisfy it only within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: The degree of the set; null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkOneAnswer(Record):
    """The poses with one set of lengths, and further results on request."""

    #: The method that found them.
    method: Method
    #: The level of completeness of the list.
    completeness: CompletenessWord
    #: The evidence for completeness in one sentence.
    completeness_reason: str
    #: Whether every path is accounted for; false: roots may be missing.
    all_paths_accounted: bool
    #: Number of `solutions`.
    finite_count: int
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: int
    #: Number of real poses.
    real_count: int
    #: Number of poses that may be real or not.
    undecided_count: int
    #: Number of finite poses beyond the certified ones, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first.
    solutions: tuple[SolutionRecord, ...]
    #: The paths of the homotopy.
    paths: tuple[PathRecord, ...]
    #: Rejected candidates that are no roots.
    rejected: tuple[RejectedRecord, ...]
    #: Path ends without a certificate: there may be one pose, several or none near each. They are not
    #: among the solutions.
    unproved: tuple[SolutionRecord, ...]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The numbers of the proof that the list holds all poses up to a distance; null: another proof, or
    #: none.
    bound: Union[BoundedProof, None]
    #: The computations of the linear algebra libraries for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: The meaning of null for each number that is not finite.
    notes: Union[tuple[str, ...], None]
    #: The crank angles in degrees, if given. The legs are then the rods from the crank tips, rounded to
    #: doubles, and certificates hold for these tips.
    angles_deg: Union[tuple[float, ...], None]
    #: Whether all given angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: The tracking of the pose, with `--near`.
    near: Union[NearRecord, None]
    #: The iteration for joints that are not ideal. The given lengths are then drive lengths, and no root
    #: gets a certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves the dimension for the lengths as written. False: the
    #: lengths satisfy it only within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: The degree of the set; null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]


class FkRowRecord(Record):
    """One row of a file of lengths."""

    #: The line of the CSV file, from 1.
    line: int
    #: The six lengths, design units; for given crank angles, the rod lengths.
    lengths: tuple[float, ...]
    #: The time of the row, if the file has a column of times.
    time: Union[float, None]
    #: The crank angles in degrees, if given.
    angles_deg: Union[tuple[float, ...], None]
    #: The convention of `in_frames`; of a row of a table that of the whole answer.
    frames: Union[PoseConventionRecord, None]
    #: The method that found them.
    method: Union[Method, None]
    #: The level of completeness of the list.
    completeness: Union[CompletenessWord, None]
    #: The evidence for completeness in one sentence.
    completeness_reason: Union[str, None]
    #: The numbers of the proof that the list holds all poses up to a distance; null: another proof, or
    #: none.
    bound: Union[BoundedProof, None]
    #: Whether every path is accounted for; false: roots may be missing.
    all_paths_accounted: Union[bool, None]
    #: Number of `solutions`.
    finite_count: Union[int, None]
    #: Number of `solutions` with multiplicity.
    finite_count_with_multiplicity: Union[int, None]
    #: Number of real poses.
    real_count: Union[int, None]
    #: Number of poses that may be real or not.
    undecided_count: Union[int, None]
    #: Number of finite poses beyond the certified ones, counted with multiplicity; null: not counted.
    missing_count: Union[int, None]
    #: The number of poses by theorem, or counted without finding them; null: not known.
    pose_count: Union[PoseCountRecord, None]
    #: The poses, real ones first.
    solutions: Union[tuple[SolutionRecord, ...], None]
    #: The paths of the homotopy.
    paths: Union[tuple[PathRecord, ...], None]
    #: Rejected candidates that are no roots.
    rejected: Union[tuple[RejectedRecord, ...], None]
    #: Path ends without a certificate: there may be one pose, several or none near each. They are not
    #: among the solutions.
    unproved: Union[tuple[SolutionRecord, ...], None]
    #: The computations of the linear algebra libraries for `--method template`.
    library_calls: Union[tuple[LibraryCallsRecord, ...], None]
    #: The meaning of null for each number that is not finite.
    notes: Union[tuple[str, ...], None]
    #: Whether all given angles are within their limits, ends included; null: no angles, or no limits.
    within_limits: Union[bool, None]
    #: Legs with cranks beyond their limits at these angles, from 1.
    outside: Union[tuple[int, ...], None]
    #: Number of finite poses of the exactly symmetric platform, by a theorem. It is present if tips and
    #: platform joints have three-fold symmetry to rounding and the rods are equally long. Rounding of the
    #: tips alone decides on further poses, which are far away.
    symmetric_finite: Union[int, None]
    #: The tracking of the pose, with `--near`.
    near: Union[NearRecord, None]
    #: The iteration for joints that are not ideal. The given lengths are then drive lengths, and no root
    #: gets a certificate.
    drives: Union[DriveSolutionRecord, None]
    #: The closure polynomial, with `--method trilateration` or `--between`.
    closure: Union[ClosureRecord, None]
    #: The polynomial in the Cayley parameter c3 of all poses, with `--polynomial`.
    polynomial: Union[RotationPolynomialRecord, None]
    solution_set: Union[Literal["isolated", "empty", "positive_dimensional"], None]
    #: The dimension, counted modulo random primes; null: not counted.
    dimension: Union[int, None]
    #: The dimension found numerically, a lower bound.
    dimension_at_least: Union[int, None]
    #: Whether a relation between the legs proves the dimension for the lengths as written. False: the
    #: lengths satisfy it only within rounding, and have finitely many poses.
    dimension_established: Union[bool, None]
    #: The degree of the set; null: not established.
    degree: Union[int, None]
    #: Points of a general section, and real points found by a search.
    witness_points: Union[tuple[SolutionRecord, ...], None]
    #: The failure, as the command reports it for this row alone.
    error: Union[FailureRecord, None]


class FkRowsAnswer(Record):
    """The poses with the lengths of each row of a file."""

    #: The convention of `in_frames`.
    frames: PoseConventionRecord
    #: The rows in the order of the file.
    rows: tuple[FkRowRecord, ...]


class FrameMotionRecord(Record):
    """The rigid motion with which measured joints are nearest to those of the design: a point x of the measurements is at R x + p."""

    #: The motion.
    motion: PoseRecord
    #: Root mean square of the distances that remain, design units.
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
    #: The value at the pose.
    value: float
    #: The travel towards smaller values.
    back: TravelRecord
    #: The travel towards greater values.
    forth: TravelRecord


class FreeSizeRecord(Record):
    """The largest free size of a region around home."""

    #: The largest size for which every pose is proved to be regular and to meet all requirements on poses;
    #: 0: nothing is proved.
    proved: float
    #: The largest size for which no violation was found.
    searched: float
    #: The requirement violated in a slightly larger region; null: none was found.
    binds: Union[LimitRecord, None]


class FreeTurnRecord(Record):
    """The free rotation of the platform about an axis."""

    #: The axis of the base frame: `x`, `y` or `z`.
    axis: str
    #: The free angle in the negative sense, degrees, given as a positive number.
    back_deg: float
    #: The requirement that ends it; null: none within half a turn.
    back_binds: Union[LimitRecord, None]
    #: The free angle in the positive sense, degrees.
    forth_deg: float
    #: The requirement that ends it; null: none within half a turn.
    forth_binds: Union[LimitRecord, None]


class FreedomRecord(Record):
    """A freedom that the design does not allow, and the result of the search with it."""

    #: The freedom.
    freedom: Freedom
    #: The outcome of the search.
    outcome: FreedomWord
    #: The amount by which the limit was relaxed in the last search, or by which the platform found is
    #: higher; null: no such number.
    amount: Union[float, None]
    #: The unit of the amount.
    unit: str
    #: The result in one sentence.
    message: str
    #: The result of `assess` for the platform found; null: none was found.
    assessment: Union[AssessAnswer, None]
    #: The platform found, with the relaxed limit; null: none was found.
    design: Union[Design, None]
    #: The design file written; null: none.
    output: Union[str, None]


class FrontMemberRecord(Record):
    """A member of a Pareto front."""

    #: Value of the first objective.
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
    #: The legs of the cycle, from 1; null: no offsets were chosen.
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
    #: Margins of the requirements, over many poses and computed independently of the search.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: Margins of the extra conditions of the search.
    search_margins: Union[SearchMarginsRecord, None]
    #: The active bounds: ends of ranges and limits without any margin, and the growth of the bodies. Null:
    #: none.
    active_bounds: Union[ActiveBoundsRecord, None]
    #: Whether the platform is proved to meet its requirements; null: some are unproved.
    requirements_met: Union[bool, None]
    #: The result of `assess` for the platform; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Whether it is equivalent to the design; null: the variables leave the equivalence class.
    verify: Union[VerifiedRecord, None]
    #: The held pose with the value of the first objective; null: the objective is not the worst
    #: conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the run that found it; null: a member of a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses held and checked.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design.
    design: Design
    #: The file written; null: none.
    output: Union[str, None]
    #: The objectives as evaluated for comparing the members.
    non_dominated_at: tuple[Union[float, None], ...]


class GiveRecord(Record):
    """A requirement of a conflict."""

    #: The requirement.
    name: DemandWord
    #: The unit of the amounts.
    unit: str
    #: The amount of relaxation that suffices alone; null: no amount suffices.
    alone: Union[float, None]
    #: The amount of relaxation if all requirements give way together; the sum of these amounts, each in
    #: its scale, is least.
    together: Union[float, None]
    #: The relaxation in one sentence.
    message: str


class GlobalBoundRecord(Record):
    """The proved upper bound over all offsets."""

    #: No offsets within the limits reach a greater value.
    upper: Union[float, None]
    #: Relative distance of the bound above the solution.
    gap: Union[float, None]
    #: Number of searched boxes of offsets.
    boxes: int


class GreatestErrorRecord(Record):
    """The greatest error over the poses of a map."""

    #: The greatest error by all causes together.
    greatest: Union[float, None]
    #: The part due to joints, at the same pose.
    joints: Union[float, None]
    #: The part due to leg lengths, at the same pose.
    lengths: Union[float, None]
    #: The part due to expansion, at the same pose.
    growth: Union[float, None]
    #: The pose with the greatest error.
    pose: PoseQuaternionRecord
    #: The median over the poses, by all causes together.
    median: Union[float, None]


class GreatestResidualRecord(Record):
    """The residual of greatest size."""

    #: Line of the table of measurements.
    line: int
    #: The leg, from 1.
    leg: int
    #: The measured length minus the length of the model, design units.
    value: Union[float, None]


class GridRecord(Record):
    """A grid of holes in the plane of a body."""

    #: The pattern of the holes.
    pattern: HolePattern
    #: Distance of neighbouring holes, or of the rings of a polar grid, design units; null for bolt
    #: circles.
    pitch: Union[float, None]
    #: The circles of the grid: the first ring of a polar grid, or all bolt circles; empty for the other
    #: patterns.
    circles: tuple[HoleCircleRecord, ...]
    #: A hole, or the centre of the circles, body frame, design units.
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

    #: The legs in order around the hexagon, from 1.
    order: tuple[int, ...]
    #: The position of each joint on its side, as a fraction from 0 to 1.
    t: tuple[Union[float, None], ...]
    #: Lengths of the sides, design units.
    side_lengths: tuple[Union[float, None], ...]
    #: `prod (1 - t) - prod t`; zero means singular.
    det: Union[float, None]
    #: Whether `det` is exactly zero.
    exactly_singular: bool
    #: The greatest distance of a joint from its side, relative to the size.
    deviation: Union[float, None]
    #: The greatest deviation at which the type is recognised.
    deviation_limit: Union[float, None]
    #: The coefficients of the dependency of the legs for `det = 0`.
    coefficients: tuple[Union[float, None], ...]
    #: The value of `sum c_i s_i` at every pose, with the squared lengths `s_i`; design units squared.
    constant: Union[float, None]
    #: Relative difference between `sum c_i s_i` for the lengths of the design and the constant; null
    #: without lengths.
    lengths_defect: Union[float, None]
    #: Whether the platform can be assembled with the lengths of the design.
    assembly: Union[AssemblyRecord, None]


class HeldLineRecord(Record):
    """A line of a body that five legs hold."""

    #: The body.
    body: Body
    #: The positions of the leg joints along the line, measured from the joint of leg 1 in units of
    #: `length`.
    marks: tuple[Union[float, None], ...]
    #: Distance from the joint of leg 1 to the farthest joint, design units.
    length: Union[float, None]
    #: The type of equation that gives the line; null: the legs are dependent.
    class_: Union[LineClass, None]
    #: Number of poses of the line, real and complex, for generic lengths; null: not counted.
    generic_poses: Union[int, None]
    #: The poses of the line that are singular.
    singular_poses: LineLocusRecord


class HeldPosesRecord(Record):
    """Numbers of poses."""

    #: Number of poses at which the search held the requirements.
    held: int
    #: Number of poses of the independent evaluation.
    checked: int


class HeldWrenchRecord(Record):
    """A wrench on the platform and what holds it."""

    #: The name of the load; null: the wrench of `--wrench`.
    load: Union[str, None]
    #: The wrench on the platform.
    wrench: WrenchRecord
    #: Forces of the legs, positive where they push the platform, or torques of the cranks about their
    #: axes; null at a singular pose.
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
    #: The offsets as fractions of the edges.
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

    #: The numbers of the two modes, from 1.
    modes: tuple[int, ...]
    #: The poses of the path, joined by straight segments.
    poses: tuple[PoseQuaternionRecord, ...]


class JointAxesRecord(Record):
    """Joint axes: unit vectors, body frame; null: not chosen."""

    #: Axes at the base ends of the legs, base frame.
    base: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Axes at the platform ends of the legs, platform frame.
    platform: Union[tuple[tuple[Union[float, None], ...], ...], None]


class JointBudgetRecord(Record):
    """The error allowed at one joint while the others are exact."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: The error allowed in any direction.
    alone: JointLimitRecord
    #: The worst direction of the error, body frame.
    direction: tuple[Union[float, None], ...]
    #: Error of the tool point per unit of joint error in the worst direction.
    position_per_unit: Union[float, None]
    #: Error of the orientation per unit of joint error in the worst direction, degrees per design unit.
    rotation_deg_per_unit: Union[float, None]
    #: The errors allowed along each axis of the body, design units; null: no influence.
    along_axes: tuple[Union[float, None], ...]
    #: Half widths of the box of largest volume for all joints together, design units; null: no influence.
    largest_product: tuple[Union[float, None], ...]


class JointLimitRecord(Record):
    """An allowed joint error with the bound that limits it."""

    #: Allowed error that keeps the bound to first order, design units.
    value: Union[float, None]
    #: Error size that reaches the bound to first order.
    reached: Union[float, None]
    #: The bound that is reached.
    limited_by: ErrorKind
    #: The pose at which it is reached.
    pose: PoseQuaternionRecord


class JointShiftRecord(Record):
    """The displacement of a joint."""

    #: The body of the joint.
    body: Body
    #: The name of the joint.
    joint: str
    #: The displacement in the body frame of the measured poses; relative, the whole change has norm 1.
    shift: tuple[Union[float, None], ...]


class JointsRecord(Record):
    """The exactness of all joints of a design together."""

    #: The exactness of the least exact joint.
    exactness: ExactnessWord
    #: The integers with square roots in the field of the exact coordinates, beside the cosines of
    #: `divisions`; empty for fractions.
    radicands: tuple[int, ...]
    #: Numbers `n` with `cos(360 / n)` degrees among the generators of the field: some of 9, 16, 20 and 32.
    divisions: tuple[int, ...]
    #: Joints known only between bounds, with their bodies: `base.A2`.
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
    #: The speed of greatest size, design units per second; positive: the leg becomes longer.
    speed: ExtremeRecord
    #: The acceleration of greatest size, design units per second squared.
    acceleration: ExtremeRecord
    #: The greatest push of the drive, force units; 0: it only pulls. Null: no masses are known, or forces
    #: are not determined.
    push: Union[ExtremeRecord, None]
    #: The greatest pull of the drive, a negative force; 0: it only pushes.
    pull: Union[ExtremeRecord, None]
    #: Root mean square of the force over time, force units.
    rms_force: Union[float, None]
    #: The power of greatest size, watts; negative: the drive brakes.
    power_w: Union[ExtremeRecord, None]


class LegPathPoseRecord(Record):
    """A pose with all lengths but one."""

    #: The distance of the joints of the leg.
    length: float
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames


class LegSlideRecord(Record):
    """One leg that moves along the line of two legs with a joint in common. X, Y, Q and F are in one plane at every pose."""

    #: The moved leg, from 1.
    leg: int
    #: The legs X F and Y F, from 1.
    between: tuple[int, ...]
    #: The names of X and Y.
    ends: tuple[str, ...]
    #: The name of the new joint Q of the leg: Q = X + t (Y - X).
    moved: str
    #: The name of F, the joint that the leg keeps.
    fixed: str
    #: The offset t: s' = (1 - t) s(X F) + t s(Y F) - t (1 - t) d^2.
    offset: ExactNumberRecord
    #: The number 1 - t.
    rest: ExactNumberRecord
    #: The squared edge d^2 = |XY|^2, design units squared.
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
    #: Rows and columns of the matrix.
    size: tuple[int, ...]
    #: Number of calls.
    calls: int


class LightestDriveRecord(Record):
    """The lightest drive of the table with which the requirements of a design are met."""

    #: The name of the drive; null: no drive is proved to suffice.
    name: Union[str, None]
    #: The mass of the drive; null: the table has none, or no drive is proved to suffice.
    mass: Union[float, None]
    #: The unit of the mass.
    mass_unit: str
    #: Undecided lighter drives; all undecided drives if none is proved to suffice.
    undecided: tuple[str, ...]
    #: The result in one sentence.
    message: str


class LimitRecord(Record):
    """A requirement that is active or violated."""

    #: The kind; null: a singular pose, where det J vanishes.
    name: Union[TermKind, None]
    #: The margin, negative for a violation; for a singular pose det J divided by its value at home.
    margin: Union[float, None]
    #: The unit of the margin; null: a pure ratio.
    unit: Union[str, None]
    #: The parts that the requirement is about: legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: The legs concerned, from 1.
    legs: tuple[int, ...]


class LimitsAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The convention in which poses were read, of `in_frames` and of `axes`.
    frames: PoseConventionRecord
    #: The pose of `--at`.
    pose: PoseQuaternionRecord
    #: The same in the convention of `frames`.
    in_frames: PoseInFrames
    #: Whether every requirement is met at the pose, and det J has the sign that it has at home.
    allowed: bool
    #: The requirements violated at the pose, the worst first.
    violated: tuple[LimitRecord, ...]
    #: The free travel of each pose coordinate while the others stay fixed (x, y, z, roll, pitch, yaw);
    #: empty: the pose is not allowed.
    axes: tuple[FreeRangeRecord, ...]
    #: The straight path to the pose of `--to`; null: none was requested, or it begins at a pose that is
    #: not allowed.
    straight_path: Union[StraightPathRecord, None]
    #: The allowed pose nearest to the pose of `--to`, or nearest to the pose of `--at` if that is not
    #: allowed. Null: every requested pose is allowed, or no allowed pose was found.
    nearest_allowed: Union[NearestAllowedRecord, None]
    #: The size of the workspace around home; null: `--workspace` was not given, or home is not allowed.
    workspace: Union[WorkspaceSizeRecord, None]
    #: The surface that was written; null: none was asked for, or the pose of `--at` is not allowed.
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

    #: The joint of leg 1, frame of the other body, design units.
    position: ComplexRecord
    #: The unit vector from the joint of leg 1 to the farthest joint, frame of the other body.
    direction: ComplexRecord
    #: Whether the pose is real, decided exactly.
    real: bool
    #: The multiplicity of the pose.
    multiplicity: int
    #: Greatest error of a coordinate of the position, design units.
    position_error: Union[float, None]
    #: Greatest error of a coordinate of the direction.
    direction_error: Union[float, None]


class LinePosesRecord(Record):
    """All poses of a line for given lengths."""

    #: Number of poses, real and complex, counted with multiplicity: proved in exact arithmetic.
    counted: int
    #: Number of real poses.
    real: int
    #: The coefficients of the polynomial for the poses, as decimal text, the constant first.
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

    #: Whether the search converged: the model of the last step promised no further gain.
    converged: bool
    #: The remaining first-order gain for a unit of the variables.
    stationarity: Union[float, None]
    #: The gain of a pattern search from there; null: none was made.
    pattern_gain: Union[float, None]
    #: Number of points tried by the pattern search.
    pattern_trials: Union[int, None]


class LossRecord(Record):
    """The loss function of the fit, which limits the weight of outliers."""

    #: The kind of loss.
    loss: Loss
    #: The unit that is rejected together: a pose or a single leg length.
    of: LossUnit


class MapAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The relation of the two designs; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: The level of the proof; within rounding: nothing is proved.
    level: Level
    #: Whether the relation holds up to rounding of the joints; true for an exact relation too.
    holds_within_rounding: bool
    #: The relation in one sentence, with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: The determinant as an exact number, such as 64/243. Null: the identity of leg vectors is not proved
    #: in exact arithmetic, or the number is too long to read.
    det_exact: Union[str, None]
    #: Rows of A as exact numbers; null if `det_exact` is null.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: The constant terms as exact numbers, design units squared; null if `det_exact` is null.
    c_exact: Union[tuple[str, ...], None]
    #: The zeros of det A for single legs, exact. Such a leg has its ends on edges of FROM at the offset t.
    #: Its row of A has the entries 1 - t and t, the others zero. The list has the t for which det A
    #: vanishes while other legs stay fixed. An entry is null for other legs, or if no t exists. The list
    #: is null if `det_exact` is null.
    singular_offsets: Union[tuple[Union[str, None], ...], None]
    #: det A as a polynomial with exact coefficients in the offsets t1 to t6 of all such legs, the other
    #: legs fixed. TO is singular exactly at its zeros. Null: no leg is of this kind, or `det_exact` is
    #: null.
    det_of_offsets: Union[str, None]
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
    #: The thresholds of the decision.
    tolerances: MapTolerancesRecord
    #: The correspondence of the legs of both designs.
    correspondence: CorrespondenceRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: Leg lengths taken from one design to the other, with `--lengths`.
    lengths: Union[MappedLengthsRecord, None]
    #: Whether base and platform of the second design were exchanged first.
    exchanged: Union[bool, None]
    #: The rigid motions that make the second design equivalent to the first, with `--align`.
    alignment: Union[AlignmentRecord, None]
    #: The file written.
    output: Union[str, None]


class MapRecord(Record):
    """The affine map s(TO) = A s(FROM) + c between the squared leg lengths of two designs."""

    #: The relation of the two designs; null: undecided, exit 3.
    relation: Union[Relation, None]
    #: The level of the proof; within rounding: nothing is proved.
    level: Level
    #: Whether the relation holds up to rounding of the joints; true for an exact relation too.
    holds_within_rounding: bool
    #: The relation in one sentence, with the numbers that decided.
    explanation: str
    #: Rows of A: s(TO) = A s(FROM) + c of squared leg lengths.
    A: tuple[tuple[Union[float, None], ...], ...]
    #: The constant terms, design units squared.
    c: tuple[Union[float, None], ...]
    #: The determinant of A.
    det: Union[float, None]
    #: The determinant as an exact number, such as 64/243. Null: the identity of leg vectors is not proved
    #: in exact arithmetic, or the number is too long to read.
    det_exact: Union[str, None]
    #: Rows of A as exact numbers; null if `det_exact` is null.
    A_exact: Union[tuple[tuple[str, ...], ...], None]
    #: The constant terms as exact numbers, design units squared; null if `det_exact` is null.
    c_exact: Union[tuple[str, ...], None]
    #: The zeros of det A for single legs, exact. Such a leg has its ends on edges of FROM at the offset t.
    #: Its row of A has the entries 1 - t and t, the others zero. The list has the t for which det A
    #: vanishes while other legs stay fixed. An entry is null for other legs, or if no t exists. The list
    #: is null if `det_exact` is null.
    singular_offsets: Union[tuple[Union[str, None], ...], None]
    #: det A as a polynomial with exact coefficients in the offsets t1 to t6 of all such legs, the other
    #: legs fixed. TO is singular exactly at its zeros. Null: no leg is of this kind, or `det_exact` is
    #: null.
    det_of_offsets: Union[str, None]
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
    #: The thresholds of the decision.
    tolerances: MapTolerancesRecord


class MapTolerancesRecord(Record):
    """The thresholds of the decision about a map."""

    #: The greatest `residual` of a map that holds.
    residual: float
    #: The threshold of the singular values, relative to the largest.
    rank: float
    #: The least `inverse_condition` of a regular map.
    inverse_condition: float


class MappedLengthsRecord(Record):
    """Lengths of the legs of both designs at the same poses, as the legs show them, design units."""

    #: The given lengths of FROM.
    from_: tuple[Union[float, None], ...]
    #: The lengths of TO; null: there are none.
    to: Union[tuple[Union[float, None], ...], None]
    #: The reason why there are none: no regular map, or a squared length that is not positive.
    reason: Union[str, None]


class MarginRecord(Record):
    """The least margin of a kind of requirement."""

    #: The kind of requirement.
    name: TermKind
    #: The least margin over the sampled poses, negative for a violation.
    margin: Union[float, None]
    #: The safety margin that the design requires for this limit, in the unit of the margin; 0: none. Its
    #: name in JSON is older than the word.
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
    #: The proved lower bound of the margin over the whole workspace; null: nothing is proved.
    proved_margin: Union[float, None]
    #: The unit of the margins.
    unit: str
    #: The parts with the least margin: legs, joints, keep-out or load.
    between: tuple[str, ...]
    #: The legs concerned, from 1; for a requirement on joints, the legs of the joint.
    legs: tuple[int, ...]
    #: The pose with the least margin; null: the margin is the same at every pose.
    pose: Union[PoseQuaternionRecord, None]


class MotionAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: The convention in which poses of options were read, and of the table of instants; a table of poses
    #: may say more in the names of its columns.
    frames: PoseConventionRecord
    #: Whether every requirement is met at the sampled instants, and every pose of the motions is regular.
    met: bool
    #: The unit of lengths; speeds are in this unit per second, accelerations per second squared.
    length_unit: str
    #: The unit of forces.
    force_unit: str
    #: Assumed values that the file does not state, one sentence each.
    assumptions: tuple[str, ...]
    #: The motions: the trajectory first, then sines and accelerations.
    motions: tuple[MotionRunRecord, ...]
    #: The stiffness of the platform at the pose of `--about`; null: not requested.
    stiffness: Union[StiffnessRecord, None]
    #: The table of instants written; null: none.
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
    #: The residual of the leg map to the moved design.
    residual: Union[float, None]
    #: The determinant of this map.
    det: Union[float, None]
    #: The relation of the moved design to the first; null: undecided.
    relation: Union[Relation, None]


class MotionRunRecord(Record):
    """The legs along one motion."""

    #: The trajectory file or the manoeuvre, as requested.
    motion: str
    #: Number of sampled instants.
    instants: int
    #: Time from the first to the last instant, seconds.
    duration_s: float
    #: Whether this motion meets every requirement at the sampled instants, and every pose is regular.
    met: bool
    #: The legs in order; empty: a leg has no length at some instant, or the legs are rods on cranks.
    legs: tuple[LegMotionRecord, ...]
    #: The least margin of each kind of requirement, with the forces and speeds of this motion.
    requirements: tuple[TimedMarginRecord, ...]
    #: Whether every pose of the motion is regular.
    regularity: MotionRegularity
    #: The time of the first singular pose, seconds; null: none was found.
    singular_at_s: Union[float, None]
    #: The first singular pose; null: none was found.
    singular_pose: Union[PoseQuaternionRecord, None]
    #: The evidence that it is singular.
    singular_evidence: Union[SingularEvidenceWord, None]
    #: The cranks in leg order, for legs that are rods on cranks; empty: a rod does not reach at some
    #: instant.
    cranks: Union[tuple[CrankMotionRecord, ...], None]
    #: The time at which a rod first does not reach from its crank to the platform, seconds.
    unreached_at_s: Union[float, None]


class MovesFoundRecord(Record):
    """A summary of a search for equivalent platforms."""

    #: The outcome of the search.
    outcome: SearchWord
    #: Legs of the written platform that differ from the design's legs, from 1; null: no platform is
    #: written.
    moved_legs: Union[tuple[int, ...], None]
    #: det A of the leg map to the written platform; null: no platform is written.
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
    #: The reason for losing the pose; null: it was not lost.
    reason: Union[str, None]
    #: The pose at the beginning.
    start: PoseRecord
    #: The pose at the end.
    reached: PoseRecord
    #: The fraction of the straight line of squared lengths that was covered; 1: all.
    fraction: float
    #: Largest error of the leg equations divided by the squared size.
    residual: Union[float, None]
    #: Inverse condition number of the Jacobian at the pose reached, as in `assess`: 1 at best, 0 at a
    #: singular pose.
    inverse_condition: Union[float, None]
    #: Number of segments of the line.
    segments: int
    #: Number of Newton steps in all.
    newton_steps: int
    #: The largest Kantorovich number; below 1, no segment holds a singular pose.
    kantorovich: Union[float, None]
    #: Displacement of the platform centroid since the start, design units.
    distance: Union[float, None]
    #: Angle of rotation since the start, degrees.
    angle_deg: Union[float, None]
    #: Uncertainty of the pose reached. Present for ideal joints and a design with standard deviations of a
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
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: Distance from the requested pose, design units: `sqrt(|p - p'|^2 + (L angle)^2)`.
    distance: float
    #: The `L` of the distance, design units per radian.
    characteristic_length: float
    #: The active requirements that keep the pose from being nearer.
    binds: tuple[LimitRecord, ...]
    #: Whether no small step leads nearer, as far as margins are smooth: the pose is then locally nearest.
    #: False: the search ended early.
    stationary: bool
    #: Whether the straight path from home to the pose violates nothing.
    straight_from_home: bool


class NearestErrorRecord(Record):
    """The errors of the nearest octahedral platform."""

    #: The largest displacement of a leg end, design units.
    largest_displacement: Union[float, None]
    #: The largest displacement divided by the size of the design.
    relative_displacement: Union[float, None]
    #: The largest difference of leg lengths over the poses of the workspace, design units.
    largest_length_deviation: Union[float, None]
    #: det A of the leg map from the octahedral platform to the equivalent one near the design.
    det: Union[float, None]


class NearestMotionRecord(Record):
    """The pair of rigid motions with the least residual."""

    #: Motion of the base of the second design.
    base: PoseRecord
    #: Motion of its platform.
    platform: PoseRecord
    #: The residual it leaves.
    residual: Union[float, None]


class NearestPlatformRecord(Record):
    """The platform with the least violation of its requirements."""

    #: The chosen variables, without axes.
    variables: tuple[VariableRecord, ...]
    #: Margins of the requirements, over many poses and computed independently of the search.
    constraint_margins: tuple[MarginRecord, ...]
    #: The result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design


class NearestRoundingOutcome(Record):
    """The nearest rounding, or the reason why there is none."""

    #: The grids used.
    grids: Union[GridsRecord, None]
    #: The verdict of leg map and forward kinematics against the given design.
    verdict: Union[RoundingVerdict, None]
    #: The residual of the leg map; null: it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: Union[tuple[RoundedJointRecord, ...], None]
    #: The figures of the rounded design.
    evaluation: Union[EvaluationRecord, None]
    #: The error of the pose when the formula of the given design is used.
    pose_error: Union[RoundingErrorRecord, None]
    #: Number of joints that are not on the nearest hole.
    not_nearest: Union[int, None]
    #: Whether rotations by 120 degrees map the joints of both bodies to themselves.
    three_fold: Union[bool, None]
    #: The obstacle.
    error: Union[NoRoundingError, None]


class NearestRoundingRecord(Record):
    """A rounding with all joints on holes near their given positions."""

    #: The grids used.
    grids: GridsRecord
    #: The verdict of leg map and forward kinematics against the given design.
    verdict: RoundingVerdict
    #: The residual of the leg map; null: it could not be computed.
    map_residual: Union[float, None]
    #: The joints.
    joints: tuple[RoundedJointRecord, ...]
    #: The figures of the rounded design.
    evaluation: EvaluationRecord
    #: The error of the pose when the formula of the given design is used.
    pose_error: RoundingErrorRecord
    #: Number of joints that are not on the nearest hole.
    not_nearest: int
    #: Whether rotations by 120 degrees map the joints of both bodies to themselves.
    three_fold: bool


class NearestSingularPoseRecord(Record):
    """A singular pose near the one asked about."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: `sqrt(|p - p'|^2 + (L angle)^2)`, design units.
    distance: float
    #: The `L` of the distance, design units a radian.
    characteristic_length: float
    #: Whether no small step on singular poses leads nearer: then it is locally nearest.
    stationary: bool
    #: A pose with det J = 0 is proved to be within this distance; null: not proved.
    proved_within: Union[float, None]


class NearestSingularRecord(Record):
    """The nearest singular design found."""

    #: Norm of the change of all joints, design units.
    distance: Union[float, None]
    #: Always `upper`: the distance is an upper bound of the least distance.
    bound: Literal["upper"]
    #: A lower bound: no singular design is nearer, design units.
    distance_at_least: Union[float, None]
    #: The kind of singularity.
    kind: str
    #: The dependent legs, from 1.
    legs: tuple[int, ...]
    #: The coefficients of the dependency of the leg vectors.
    coefficients: Union[tuple[Union[float, None], ...], None]
    #: The residual of the dependency.
    residual: Union[float, None]
    #: Whether the two designs differ by no more than rounding of the file.
    within_rounding: bool
    #: Half a unit of the last digit given, design units; null: some coordinate differs by more.
    within_digits: Union[float, None]
    #: The base joints of the singular design by name, base frame.
    base: dict[str, tuple[Union[float, None], ...]]
    #: The platform joints of the singular design by name, platform frame.
    platform: dict[str, tuple[Union[float, None], ...]]


class NextPoseRecord(Record):
    """A pose to measure next."""

    #: The pose, in the design frames if joints are carried to them, else in the frames of the
    #: measurements.
    pose: PoseQuaternionRecord
    #: Roll, pitch and yaw of the pose, degrees.
    rpy_deg: tuple[Union[float, None], ...]
    #: The pose in the convention of `frames`.
    in_frames: PoseInFrames
    #: The factor by which this measurement shrinks the error ellipsoid: the geometric mean of the
    #: deviations along its axes.
    shrinks: Union[float, None]
    #: The greatest standard deviation of a coordinate or offset after this pose and those before it,
    #: design units.
    greatest_deviation: Union[float, None]


class NoRoundingError(Record):
    """The obstacle to a rounding."""

    #: A short code.
    code: NoRoundingWord
    #: The message in one sentence.
    message: str


class NoRoundingRecord(Record):
    """The reason why there is no rounding."""

    #: The obstacle.
    error: NoRoundingError


class NoiseRecord(Record):
    """Standard deviations of measurements."""

    #: The source of the values.
    source: NoiseSource
    #: Standard deviation of a length, design units.
    length: Union[float, None]
    #: Standard deviation of each coordinate of the platform origin, design units.
    position: Union[float, None]
    #: Standard deviation of each component of the rotation vector, degrees.
    rotation_deg: Union[float, None]


class ObjectiveRecord(Record):
    """An objective and its value."""

    #: The name of the objective.
    name: Objective
    #: The value over many poses, computed independently of the search.
    value: Union[float, None]
    #: The value over the poses at which the search held the requirements.
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
    #: The threshold: smaller singular values count as not identified.
    tolerance: Union[float, None]
    #: `(s_1 .. s_m)^(1/m) / sqrt(n)` (Borm, Menq 1991).
    volume_index: Union[float, None]
    #: `s_m / s_1` (Driels, Pathre 1990).
    inverse_condition: Union[float, None]
    #: `s_m^2 / s_1` (Nahvi, Hollerbach 1996).
    noise_amplification: Union[float, None]
    #: `1 / (1/s_1 + .. + 1/s_m)` (Sun, Hollerbach 2008).
    harmonic_index: Union[float, None]
    #: Changes of the machine that are not identified, each normalised to 1 over all unknowns.
    unobservable: tuple[UnobservableRecord, ...]


class OffsetProductsRecord(Record):
    """Products over the six offsets of the platform without shared joints."""

    #: The product of the six numbers 1 - t.
    rest: ExactNumberRecord
    #: The product of the six offsets t.
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
    #: Whether rotations by 120 degrees map both triangles with their joints to themselves.
    three_fold: bool
    #: The largest displacement of a joint to its hole, design units.
    largest_displacement: Union[float, None]
    #: Variables optimised again after rounding.
    refitted: tuple[str, ...]
    #: Number of passes of search and rounding.
    passes: int
    #: The reason why there is no rounding; null: there is one.
    error: Union[NoRoundingError, None]


class OptimizeAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The status of the search.
    status: OptimizeWord
    #: The evidence of optimality; null: none, or there is no platform.
    optimality: Union[OptimalityWord, None]
    #: Value of the first objective.
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
    #: The legs of the cycle, from 1; null: no offsets were chosen.
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
    #: Margins of the requirements, over many poses and computed independently of the search.
    constraint_margins: Union[tuple[MarginRecord, ...], None]
    #: Margins of the extra conditions of the search.
    search_margins: Union[SearchMarginsRecord, None]
    #: The active bounds: ends of ranges and limits without any margin, and the growth of the bodies. Null:
    #: none.
    active_bounds: Union[ActiveBoundsRecord, None]
    #: Whether the platform is proved to meet its requirements; null: some are unproved.
    requirements_met: Union[bool, None]
    #: The result of `assess` for the platform; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: Whether it is equivalent to the design; null: the variables leave the equivalence class.
    verify: Union[VerifiedRecord, None]
    #: The held pose with the value of the first objective; null: the objective is not the worst
    #: conditioning.
    worst_pose: Union[WorstPoseRecord, None]
    #: Evidence of local optimality.
    local_optimality: Union[LocalOptimalityRecord, None]
    #: Steps of the run that found it; null: a member of a front.
    history: Union[tuple[SearchStepRecord, ...], None]
    #: Numbers of poses held and checked.
    poses: Union[HeldPosesRecord, None]
    #: The platform as a design; null: there is none.
    design: Union[Design, None]
    #: The file written, with the best platform or the one with the least violation.
    output: Union[str, None]
    #: The platform with the least violation; null: a platform meets the requirements.
    nearest: Union[NearestPlatformRecord, None]
    #: The requirements in conflict; null: no conflict is known.
    conflict: Union[ConflictRecord, None]
    #: The reason why the search did not decide, one sentence; null: it decided, or nothing failed.
    failure: Union[str, None]
    #: Further freedoms that might allow a platform, each with its search result. Null: a platform meets
    #: the requirements, or no freedom was tried.
    freedoms: Union[tuple[FreedomRecord, ...], None]
    #: The result for the three-fold symmetry of the design. Null: the design has none or names one, or the
    #: search could not break it or did not check it.
    symmetry: Union[SymmetryRecord, None]
    #: The drives of a table with the search result for each; null: no table was given. The rest of the
    #: answer is about the chosen drive, or else about the drive with the best result.
    drive_search: Union[DriveSearchRecord, None]
    #: Other local optima that meet the requirements at the poses held, best first; null: not requested.
    candidates: Union[tuple[OptimumRecord, ...], None]
    #: The Pareto front with mode = "pareto": no platform is better than another in every objective. Sorted
    #: by falling gain of the first objective; null in other modes.
    front: Union[tuple[FrontMemberRecord, ...], None]
    #: The reason why the sizes of the bodies and the height of home are chosen, one sentence. Null: the
    #: variables come from the design or are the usual ones.
    choice: Union[str, None]
    #: Limits of the search itself.
    limits: SearchLimitsRecord
    #: The poses required.
    region: PoseRegionRecord
    #: Statistics of the search.
    search: SearchRecord
    #: An upper bound on the objective of every platform at the poses held; null: not proved, or there is
    #: no solution.
    global_bound: Union[GlobalBoundRecord, None]
    #: Greatest gap to this bound at which the answer counts as optimal; null: the search proves no bound.
    tolerance: Union[float, None]
    #: Numbers of branches by outcome; null: the search has none.
    branch_counts: Union[BranchCountsRecord, None]
    #: The best other branches.
    runners_up: Union[tuple[BranchRecord, ...], None]
    #: All branches, with one zone for each offset.
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
    #: Value of the first objective.
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
    #: The active bounds of the platform; null: none.
    active_bounds: Union[ActiveBoundsRecord, None]


class OptimumRecord(Record):
    """A local optimum other than the best one."""

    #: All objectives.
    objectives: tuple[ObjectiveRecord, ...]
    #: The chosen variables, without axes.
    variables: tuple[VariableRecord, ...]
    #: Whether the platform is proved to meet its requirements; null: some are unproved.
    requirements_met: Union[bool, None]
    #: The result of `assess`; null: the design has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The platform.
    design: Design
    #: The design file written; null: none.
    output: Union[str, None]


class OtherAlignmentRecord(Record):
    """The result for the exchanged or mirrored second design."""

    #: Whether such motions exist.
    status: AlignmentWord
    #: Number of motions.
    motions: int


class OutOfReachRecord(Record):
    """A rod that does not reach from the circle of its crank to the platform joint."""

    #: The leg, from 1.
    leg: int
    #: The missing length of the rod, design units; negative: the rod is too long.
    too_short_by: float


class OutlierRecord(Record):
    """A measurement that contradicts the others."""

    #: Line of the table of measurements.
    line: int
    #: The leg, from 1; null: the whole pose.
    leg: Union[int, None]
    #: Distance of the measurement from the model, standard deviations.
    distance: Union[float, None]
    #: The rejection threshold, standard deviations: correct measurements all stay below it with a
    #: probability of 99 %.
    threshold: Union[float, None]
    #: The weight of the measurement in the fit.
    weight: Union[float, None]


class PathRecord(Record):
    """The report of a path of the homotopy."""

    #: Index of the start point.
    start: int
    #: The end of the path.
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
    #: Number of repeated trackings with smaller steps.
    retracked: int


class PatternLegRecord(Record):
    """One leg of a pattern."""

    #: The base joint of the leg.
    base: str
    #: The platform joint of the leg.
    platform: str
    kind: Union[Literal["vertex", "inner"], None]
    #: The side, from 1.
    side: Union[int, None]
    #: The name of its offset.
    offset: Union[str, None]
    #: The legs at the ends of the side, from 1.
    between: Union[tuple[int, ...], None]


class PatternRecord(Record):
    """A pattern: the kept legs, and the moved legs with their edges."""

    #: The name of the pattern: V and the vertices kept, S and the sides of the moved ones.
    id: str
    #: The class of the pattern up to symmetry, from 1.
    class_: int
    #: The class of the pattern up to all symmetries, from 1.
    class_exchange: int
    #: The topology of the pattern, from 1.
    topology: int
    #: Whether offsets introduced one at a time lead to it.
    sequential: bool
    #: The legs, in the order of the design.
    legs: tuple[PatternLegRecord, ...]
    #: Names of the offsets.
    offsets: tuple[str, ...]
    #: Joints that hold more than one leg.
    shared_joints: tuple[SharedJointRecord, ...]
    #: Joints on one line.
    alignments: tuple[tuple[str, ...], ...]
    #: Formulas of the entries of A, with legs in the order of the design.
    A: tuple[tuple[str, ...], ...]
    #: The formula of det A.
    det: str
    #: The equations of the factors of det A = 0.
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
    #: Whether the legs are dependent at every pose; null: not decided.
    architecturally_singular: Union[bool, None]
    #: Sixth legs that make the platform solvable in steps.
    sixth_legs: tuple[DecouplingLeg, ...]
    #: The lengths given, design units; null: none.
    lengths: Union[tuple[float, ...], None]
    #: All poses of the line for these lengths; null: no lengths were given, or there is no answer.
    poses: Union[LinePosesRecord, None]
    #: The reason why there are no poses for the given lengths; null: there are poses.
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
    #: The legs, counted from 1.
    legs: Union[tuple[int, ...], None]
    #: The polynomial that places it; null when the legs are dependent, or joints are no fractions.
    class_: Union[LineClass, None]
    #: The five other ends lie in a plane: a line-plane component.
    other_ends_in_plane: Union[bool, None]


class PointStiffnessRecord(Record):
    """Stiffness at a point of the platform."""

    #: Force and torque for a shift of the point and a small turn: force units, design units and radians.
    K: tuple[tuple[Union[float, None], ...], ...]
    #: Its inverse: shift and turn for a force and a torque; null at a singular pose.
    compliance: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Least stiffness against a force through the point, force units per design unit; 0 at a singular
    #: pose.
    linear: Union[float, None]
    #: Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
    angular: Union[float, None]


class PolynomialRecord(Record):
    """A polynomial in one unknown or in several: its degrees, its coefficients and its real roots."""

    #: The unknowns by their names.
    unknowns: tuple[str, ...]
    #: The degree before spurious factors are removed.
    degree_before: int
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: tuple[RemovedFactorRecord, ...]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: CoefficientsWord
    #: The exponents of the unknowns in each term.
    exponents: tuple[tuple[int, ...], ...]
    #: The exact coefficient of each term, integers as decimal text; for one unknown the constant comes
    #: first.
    coefficients: tuple[str, ...]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: The multiplicity of each real root.
    real_root_multiplicities: tuple[int, ...]
    #: Bounds [low, high] of the coefficients; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]


class PoseBoundRecord(Record):
    """A proved bound on the number of isolated finite poses, counted with multiplicity."""

    #: The bound.
    poses: int
    #: The theorem that gives the bound.
    theorem: str


class PoseConventionRecord(Record):
    """A convention for poses."""

    #: Order of the rotations: `fixed-xyz` and the like for fixed axes, `moving-xyz` for moving axes, or
    #: `vector` for rotation vectors.
    rotation_order: str
    #: The rotation as a product of matrices for the three angles a, b, c in their order.
    formula: str
    #: Unit of angles: `deg` or `rad`.
    angles: str
    #: Order of quaternions: `wxyz` or `xyzw`.
    quaternion: str
    #: The point of the platform whose position is given, platform frame, design units.
    pivot: tuple[Union[float, None], ...]
    #: The origin of poses: `base` or `home`.
    relative_to: str
    #: The axis that points up: `z` or `y`.
    up: str
    #: The convention in words.
    sentence: str


class PoseCountRecord(Record):
    """The finite poses of the design, counted without finding them."""

    #: Number of poses with multiplicity; null: not finite, or undecided.
    finite: Union[int, None]
    #: Number of standard monomials of each degree.
    by_degree: Union[tuple[int, ...], None]
    #: Dimension of a set of positive dimension.
    dimension: Union[int, None]
    #: Degree of a set of positive dimension, in the 16 coordinates of a pose, with multiplicity.
    degree: Union[int, None]
    #: The reason why there is no count.
    undecided: Union[CountUndecided, None]
    #: The counted lengths: the exact ones given, or generic ones, which have at least as many isolated
    #: poses. Lengths known only to rounding, such as images under a leg map, are counted as generic.
    lengths: CountedLengths
    #: The evidence for the count: a theorem with certificates, or counting modulo random primes.
    evidence: EvidenceWord
    #: A bound on the probability of a wrong count; null: proved, or undecided.
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

    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: det J of the leg lines, divided by the size to the sixth power.
    determinant: Union[float, None]
    #: Inverse condition number of the Jacobian: 1 at best, 0 at a singular pose.
    inverse_condition: Union[float, None]
    #: The two conditions for four planes through one point, for octahedral designs.
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
    """The poses that a design requires."""

    #: The source of home.
    home: SourceWord
    #: The position of home in the starting design, base frame, design units.
    home_position: tuple[Union[float, None], ...]
    #: The source of the workspace.
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

    #: Whether the design file has correlations.
    correlations: CorrelationsWord
    #: Root mean square error of the platform origin, design units.
    position: Union[float, None]
    #: Root mean square error of the orientation, degrees.
    rotation_deg: Union[float, None]
    #: Covariance of the shift of the platform origin (design units) and the rotation vector (degrees),
    #: base frame.
    covariance: tuple[tuple[Union[float, None], ...], ...]


class PriceRecord(Record):
    """Figures of a design and of the platform with separate joints made from it, in this order."""

    #: Worst conditioning over the poses of the workspace; both use the characteristic length of the
    #: design.
    conditioning: tuple[Union[float, None], ...]
    #: Least distance of the ends of two legs on the base, design units; 0 for a shared joint.
    base_spacing: tuple[Union[float, None], ...]
    #: Least distance of the ends of two legs on the platform, design units; 0 for a shared joint.
    platform_spacing: tuple[Union[float, None], ...]
    #: Greatest distance of a base joint from the centre of the base joints, design units.
    base_radius: tuple[Union[float, None], ...]
    #: Greatest distance of a platform joint from the centre of the platform joints, design units.
    platform_radius: tuple[Union[float, None], ...]
    #: The comparison in one sentence.
    message: str


class ProvenanceRecord(Record):
    """The data needed to compute an answer again: the program, the seed and the files. It holds no time and no name of a machine."""

    #: The version of the program.
    version: str
    #: The seed of the computation; null: it takes none.
    seed: Union[int, None]
    #: The designs in the order given.
    designs: tuple[DesignSourceRecord, ...]
    #: The other files read: tables of lengths or poses, fronts.
    files: tuple[FileSourceRecord, ...]


class QuantilesRecord(Record):
    """Quantiles of values."""

    #: Half of the values are at most this.
    median: Union[float, None]
    #: 90 % of the values are at most this.
    p90: Union[float, None]
    #: 99 % of the values are at most this.
    p99: Union[float, None]
    #: The greatest value.
    max: Union[float, None]


class RayEndRecord(Record):
    """A limit that ends paths."""

    #: The kind of requirement; null: a singular pose, or no limit within ten sizes of the design.
    name: Union[TermKind, None]
    #: The limit in a word.
    end: str
    #: The share of the paths that it ends, a share of solid angle.
    share: float


class RealPoseRecord(Record):
    """A real pose as real numbers."""

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
    #: The side of the base on which the platform is; null: its centre is in the plane of the base, here or
    #: at home.
    mode: Union[SideWord, None]
    #: Largest difference from home of an entry of the rotation matrix, or of a coordinate of the position
    #: divided by the size of the design.
    distance_from_home: float
    #: Whether this is the real pose nearest to home.
    nearest_home: bool
    #: Whether the pose meets every requirement and det J has the sign that it has at home, with
    #: `--limits`.
    allowed: Union[bool, None]
    #: Whether each crank is on the side (elbow) that the design names; null: no cranks. A crank changes
    #: its side only through a singular pose, with crank, rod and axis in one plane.
    elbow_kept: Union[tuple[bool, ...], None]


class RegularBoxRecord(Record):
    """A box of regular poses around a pose."""

    #: Half widths of positions at scale 1, design units, base frame.
    translation: tuple[float, ...]
    #: Half widths of the rotation vector at scale 1, base frame, degrees.
    rotation_deg: tuple[float, ...]
    #: The shape of the region.
    region: RegionWord
    #: Proved: no pose up to this scale is singular.
    proved_scale: Union[float, None]
    #: A pose in the smallest box known to hold a singular one; null: no such box is known.
    singular_within: Union[ScaledPoseRecord, None]
    #: The greatest scale searched for a change of sign.
    searched_scale: Union[float, None]
    #: Number of cells in the proof.
    cells: int


class RegularityRecord(Record):
    """Whether det J is nonzero at every pose of the workspace."""

    #: Whether every pose is regular; null: undecided.
    met: Union[bool, None]
    #: The result in a word.
    status: RegularityWord
    #: The pose at which det J has the opposite sign to home, or is undecided.
    pose: Union[PoseQuaternionRecord, None]
    #: Number of cells of the workspace examined.
    cells: int


class RejectedRecord(Record):
    """A candidate that is no root."""

    #: The reason of the rejection.
    reason: RejectionReason
    #: Error of the candidate in the leg equations, over the squared size.
    residual: Union[float, None]


class RemovedFactorRecord(Record):
    """A spurious factor: it comes from the derivation of the polynomial and has no meaning for the poses."""

    #: The factor in the unknowns, or in words.
    factor: str
    #: The degree of the factor.
    degree: int
    #: The number of times it was removed.
    times: int


class RequiredSizeRecord(Record):
    """The workspace that a design requires."""

    #: Volume of its translations, design units cubed.
    volume: float
    #: The volume of its translations divided by the volume that straight paths reach at the orientation of
    #: home.
    share: Union[float, None]
    #: The factor by which its translations and rotations together can grow; 1 or more: the whole region is
    #: free.
    factor: FreeSizeRecord


class RequirementMarginRecord(Record):
    """The least margin of a requirement."""

    #: The requirement.
    name: TermKind
    #: The margin; a violation below 0.
    margin: Union[float, None]


class ResidualsRecord(Record):
    """Statistics of residuals, design units."""

    #: Root mean square of the residuals.
    rms: Union[float, None]
    #: Root mean square of the residuals of each leg.
    legs: tuple[Union[float, None], ...]
    #: The residual of greatest size; null: none was counted.
    greatest: Union[GreatestResidualRecord, None]
    #: Number of lengths counted.
    count: int


class ResolutionRecord(Record):
    """The motion of the point for a step of the drives."""

    #: The step: design units of legs, degrees of cranks.
    step: float
    #: The unit of the step.
    step_unit: str
    #: The motion for a step of each drive alone, in leg order.
    drives: tuple[SmallMotionRecord, ...]
    #: Greatest change of each coordinate when every drive is off by up to a step: sums of the sizes.
    all: SmallMotionRecord


class RotationPolynomialRecord(Record):
    """The polynomial in a Cayley parameter of all poses."""

    #: The unknowns by their names.
    unknowns: Union[tuple[str, ...], None]
    #: The degree before spurious factors are removed.
    degree_before: Union[int, None]
    #: The degree; null for the zero polynomial.
    degree: Union[int, None]
    #: The spurious factors removed.
    removed: Union[tuple[RemovedFactorRecord, ...], None]
    #: Number of distinct complex roots; null: several unknowns, or not proved.
    distinct_roots: Union[int, None]
    #: The representation of the coefficients.
    coefficients_known: Union[CoefficientsWord, None]
    #: The exponents of the unknowns in each term.
    exponents: Union[tuple[tuple[int, ...], ...], None]
    #: The exact coefficient of each term, integers as decimal text; for one unknown the constant comes
    #: first.
    coefficients: Union[tuple[str, ...], None]
    #: Bounds [low, high] of the coefficients; null: they are exact.
    coefficient_bounds: Union[tuple[tuple[Union[float, None], ...], ...], None]
    #: Number of distinct real roots, counted by Sturm's theorem; null: several unknowns, or coefficients
    #: that are not exact.
    real_roots_by_sturm: Union[int, None]
    #: Real roots as [low, high], rounded outwards.
    real_roots: tuple[tuple[Union[float, None], ...], ...]
    #: The multiplicity of each real root.
    real_root_multiplicities: Union[tuple[int, ...], None]
    #: The reason.
    error: Union[str, None]


class RoundAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The name of the design.
    name: str
    #: The unit of its lengths.
    units: str
    #: The grids asked for.
    grids: GridsRecord
    #: Whether origins and angles of the grids are optimised too.
    free_grid: bool
    #: The figures of the given design.
    given: EvaluationRecord
    #: The best rounding that is exactly equivalent to an octahedral platform.
    exact: ExactRoundingOutcome
    #: The rounding of every joint to a hole near its given position.
    nearest: NearestRoundingOutcome
    #: The result of `assess` for the rounded design; null: there is none, or the design has no
    #: requirements.
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
    #: The hole: its counts along the axes of the grid, or its circle and its number on the circle. Null:
    #: the joint stays in place.
    cell: Union[tuple[int, ...], None]
    #: The displacement, body frame, design units.
    moved: tuple[Union[float, None], ...]
    #: The size of the displacement, design units.
    distance: Union[float, None]
    #: Distance from the line of its side, design units; null for corners.
    off_line: Union[float, None]


class RoundingErrorRecord(Record):
    """The error of the pose if a rounded platform is controlled like the given one."""

    #: The error to first order.
    first_order: PoseErrorRecord
    #: The error to first order with every joint on the nearest hole.
    first_order_nearest_points: PoseErrorRecord
    #: The error solved at random poses.
    solved: PoseErrorsRecord
    #: Number of random poses.
    solved_poses: int


class RoundingSearchRecord(Record):
    """Statistics of the search for an exact rounding."""

    #: Numbers of triangles of base and platform that were combined.
    triangles: tuple[int, ...]
    #: The distances up to which all triangles of base and platform were combined, design units.
    complete_to: tuple[Union[float, None], ...]
    #: Number of improvements by replacing one triangle.
    replacements: int


class RowFailure(Record):
    """The reason why a row has no poses."""

    #: The failure, as the command reports it for this row alone.
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
    #: The largest distance within a pair.
    worst_distance: Union[float, None]
    #: Whether this sample supports equivalence.
    agrees: bool


class SamplingRecord(Record):
    """The random poses at which designs were compared."""

    #: Number of poses.
    count: int
    #: The centre of the box, base frame, design units.
    home_position: tuple[float, ...]
    #: Half widths of the box of positions, design units.
    translation_half_widths: tuple[float, ...]
    #: Half widths of the box of rotation vectors, radians.
    rotation_half_widths_rad: tuple[float, ...]


class ScaledPoseRecord(Record):
    """A pose and the scale of the smallest box that holds it."""

    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: Unit quaternion, scalar part first.
    q: tuple[Union[float, None], ...]
    #: The scale.
    scale: Union[float, None]


class ScrewRecord(Record):
    """A turn about an axis with a shift along it."""

    #: Unit vector of the axis; of the shift where nothing turns.
    direction: tuple[Union[float, None], ...]
    #: The point of the axis nearest to the point asked about, from there, design units.
    point: tuple[Union[float, None], ...]
    #: Shift along the axis, design units per radian; null: a shift without a turn.
    pitch: Union[float, None]


class SearchLimitsRecord(Record):
    """Limits of a search beside the requirements of the design."""

    #: Least distance of joint centres of a body, design units; null: none.
    min_joint_distance: Union[float, None]
    #: Least |det A| of platforms equivalent to the design.
    min_abs_det: float
    #: The characteristic length, by which moments in the Jacobian are divided, design units.
    characteristic_length: float
    #: Label of the length unit.
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
    #: Number of starts that led to a feasible point.
    feasible: Union[int, None]
    #: Gains of the polished runs; null in the list: not feasible.
    polished: Union[tuple[Union[float, None], ...], None]
    #: Number of runs of a Pareto front that met their bounds and were dominated by or equal to others;
    #: null: no front.
    dominated: Union[int, None]
    #: Number of bounds of a Pareto front that no run met; null: no front.
    unmet: Union[int, None]
    #: Number of conic programs solved by the library clarabel in this search; searches with other drives
    #: and for freedoms are not counted.
    conic_programs: int


class SearchStepRecord(Record):
    """A step of the run that found the platform."""

    #: Value after the step: the weighted gain of the objectives; for offsets the worst inverse condition
    #: number.
    objective: Union[float, None]
    #: Greatest violation in the scale of its constraint; lengths relative to the size.
    violation: Union[float, None]
    #: Radius of the trust region.
    radius: Union[float, None]
    #: Number of poses held.
    poses: int
    #: Whether the step was accepted.
    accepted: bool
    #: Gain of the merit function predicted by the model.
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
    #: Least and greatest length from joint centre to joint centre, design units.
    leg_length: tuple[Union[float, None], ...]
    #: Greatest force; null: not in the table.
    force: Union[float, None]
    #: Greatest speed; null: not in the table.
    speed: Union[float, None]
    #: The outcome for the drive.
    outcome: DriveSearchWord
    #: Value of the first objective of the platform found; null: no platform was found.
    objective: Union[float, None]
    #: Margins against the limits of the drive (length, force, speed), for the platform found or the one
    #: with the least violation. Empty: the drive was not searched.
    margins: tuple[MarginRecord, ...]
    #: The result for the three-fold symmetry of the design; null under the same conditions as without a
    #: table.
    symmetry: Union[SymmetryRecord, None]
    #: The reason why this drive is not the answer, one sentence; null: it is the answer.
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

    #: The numbers of the two modes, from 1.
    modes: tuple[int, ...]
    #: The sign of det J along the straight path.
    straight: SignOutcome
    #: Number of proved changes of sign on the straight path.
    changes: int
    #: Whether some path without singular pose joins the two modes; null: none was found.
    joined: Union[bool, None]


class SignPairsRecord(Record):
    """The assembly modes joined by paths without singular pose."""

    #: The sign of det J at each assembly mode.
    signs: tuple[SignRecord, ...]
    #: All pairs of assembly modes.
    pairs: tuple[SignPairRecord, ...]
    #: Groups of assembly modes joined by such paths, numbers from 1.
    groups: tuple[tuple[int, ...], ...]
    #: The paths found.
    paths: tuple[JoiningPathRecord, ...]


class SignPartRecord(Record):
    """det J along a straight part of a path, with parameter u from 0 to 1."""

    #: The sign of det J along the part.
    outcome: SignOutcome
    #: Number of proved changes of sign.
    changes: int
    #: Number of pieces without a proved sign or change.
    doubtful: int
    #: The pieces with their signs.
    pieces: tuple[SignPieceRecord, ...]
    #: Sampled values [u, det J].
    values: tuple[tuple[Union[float, None], ...], ...]


class SignPathRecord(Record):
    """det J along a path of straight parts."""

    #: Number of the first assembly mode, from 1; 0: the given pose.
    from_: int
    #: Number of the last assembly mode, from 1.
    to: int
    #: The poses that the path joins.
    poses: tuple[PoseQuaternionRecord, ...]
    #: Whether det J keeps its sign: true and false are proved; null: neither.
    keeps_sign: Union[bool, None]
    #: The straight parts in order.
    parts: tuple[SignPartRecord, ...]


class SignPieceRecord(Record):
    """A piece of a straight path."""

    #: The parameter u at the beginning.
    from_: Union[float, None]
    #: The parameter u at the end.
    to: Union[float, None]
    #: The sign of det J on the piece.
    sign: SignRecord
    #: Whether the piece holds a singular pose: det J has proved, opposite signs before and after it.
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
    #: The unit of its lengths.
    units: str
    #: The family of poses on which det J is a polynomial.
    family: PoseFamilyWord
    #: The position of the given pose, as exact expressions, base frame.
    position: tuple[str, ...]
    #: A quaternion of the given orientation, scalar part first, of any norm, as exact expressions.
    quaternion: tuple[str, ...]
    #: The direction of the line, or the axis of the rotations, base frame; null: a family of positions.
    direction: Union[tuple[str, ...], None]
    #: The squared length of the axis; u is the tangent of half the angle divided by this length. Null: no
    #: axis.
    axis_squared: Union[float, None]
    #: det J up to a constant factor; the zero polynomial means that every pose is singular.
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
    #: The unit of its lengths.
    units: str
    #: Whether the examined region is free of singular poses: the workspace of the design, or the region of
    #: `--box` about the pose; null: no region is given.
    regular: Union[RegularityRecord, None]
    #: The given pose.
    pose: PoseFiguresRecord
    #: The leg lengths, design units.
    lengths: tuple[float, ...]
    #: The real poses with these lengths.
    assembly_modes: tuple[PoseFiguresRecord, ...]
    #: Whether every path is accounted for; false: poses may be missing.
    assembly_modes_accounted: bool
    #: A box of regular poses around the pose.
    box: RegularBoxRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]
    #: det J along a path, with `--path`.
    path: Union[SignPathRecord, None]
    #: det J between all assembly modes, with `--between`.
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
    #: Whether there is a certificate.
    certified: bool
    #: The proof; null: there is none.
    certificate: Union[CertificateRecord, None]
    #: Number of paths, or roots of a polynomial, that end here.
    multiplicity: int
    #: Largest error of the leg equations divided by the squared size.
    residual: Union[float, None]
    #: An estimate of the condition number.
    condition: Union[float, None]
    #: The dual quaternion (e, g): scalar part of e first, g = p e in design units, `max |e_k| = 1`.
    dual_quaternion: Union[ComplexRecord5, None]
    #: The pose in real numbers; null: it is not real.
    real_pose: Union[RealPoseRecord, None]


class Solvability(Record):
    """The ways to find the poses in steps."""

    #: A chain of quadratic equations gives all poses.
    quadratic: bool
    #: The parts that can be placed first; empty where the legs do not decouple in these ways.
    placed_first: tuple[PlacedFirst, ...]


class SolvedBudgetRecord(Record):
    """The exact check of the first-order radius."""

    #: Whether the solved pose stays within the bound for every sampled error in the budget.
    within_bound: bool
    #: The largest share of the bound that was reached; null: a pose was lost.
    largest_share: Union[float, None]
    #: A radius for which the worst joint errors keep the bound, solved exactly at their pose.
    radius: Union[float, None]


class SolvedSampleRecord(Record):
    """Poses of one design at one set of lengths, by forward kinematics."""

    #: The method.
    method: Method
    #: The level of completeness of the list.
    completeness: CompletenessWord
    #: The evidence for completeness in one sentence.
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

    #: The name of the stage.
    stage: StageWord
    #: The result in one sentence.
    explanation: str


class StartRecord(Record):
    """The start that was taken, and the result of the other one."""

    #: The start whose result was taken.
    taken: StartName
    #: Whether both starts led to the same machine; null: only one was tried.
    agree: Union[bool, None]
    #: Misfit from the nominal joints: sum of the losses, or estimated deviation of a length; smaller is
    #: better; null: not tried.
    nominal: Union[float, None]
    #: The same measure from the linear equations for squared lengths, which need no design; null: not
    #: tried, or not determined by the poses.
    closed_form: Union[float, None]


class StiffnessRecord(Record):
    """Stiffness and natural motions at a pose."""

    #: The pose.
    pose: PoseQuaternionRecord
    #: The stiffness matrix `J^T diag(k) J` at the platform origin, base frame; force units, design units
    #: and radians. It maps a shift and a small rotation to force and torque.
    K: tuple[tuple[Union[float, None], ...], ...]
    #: Least stiffness against a force through the platform origin, force units per design unit; 0 at a
    #: singular pose.
    linear: Union[float, None]
    #: Least stiffness against a torque, force units times design units per radian; 0 at a singular pose.
    angular: Union[float, None]
    #: The natural motions, the slowest first; null: masses are unknown, or no inertia resists some
    #: rotation.
    natural: Union[tuple[NaturalMotionRecord, ...], None]


class StraightPathRecord(Record):
    """The straight path to another pose: the platform origin moves on a line while the platform rotates about one axis."""

    #: The end of the path.
    to: PoseQuaternionRecord
    #: The free share of the path from its beginning; 1: the whole path.
    free: float
    #: The pose at the end of the free share.
    pose: PoseQuaternionRecord
    #: The same in the convention of `frames`.
    in_frames: PoseInFrames
    #: The requirement violated beyond this pose; null: none.
    binds: Union[LimitRecord, None]


class StuckLegRecord(Record):
    """The remaining motion with a leg stuck, or free."""

    #: The leg, from 1.
    leg: int
    #: The travel of its drive for each of the six numbers of the pose alone: design units of legs, degrees
    #: of cranks, per design unit and per `deg` or `rad` of `frames`. With the drive stuck only a number
    #: with 0 can still be changed alone; five independent changes are left.
    rates: tuple[Union[float, None], ...]
    #: The motion that is lost, and the only one left when the leg is free and the others hold; null at a
    #: singular pose.
    screw: Union[ScrewRecord, None]
    #: Poses of that motion with smaller lengths of the leg, up to its limit, a tenth of its length, or the
    #: first singular pose; none for cranks.
    shorter: tuple[LegPathPoseRecord, ...]
    #: The same with greater lengths.
    longer: tuple[LegPathPoseRecord, ...]


class SymmetryRecord(Record):
    """The search result for the three-fold symmetry that a design has at home and does not require."""

    #: The result for the symmetry.
    three_fold: SymmetryWord
    #: The reason, and the way to switch this off, in one sentence.
    message: str


class TightestRecord(Record):
    """The requirement with the least margin as a share of its limit."""

    #: The kind of requirement.
    name: TermKind
    #: The least margin divided by its limit, such as the travel of the legs or the greatest force;
    #: negative for a violation.
    share: Union[float, None]


class TimedMarginRecord(Record):
    """A least margin with its time."""

    #: The time of the least margin, seconds.
    time_s: float
    #: The margin.
    margin: MarginRecord


class TolerancesAnswer(Record):
    """One JSON document: an answer with the fields that all answers have."""

    #: The version of the answer format, always 1.
    schema_version: int
    #: The result of `assess` for the design; null: it has no requirements.
    assessment: Union[AssessAnswer, None]
    #: The greatest error of the pose allowed.
    bound: PoseErrorRecord
    #: The tool point, platform frame.
    tool: tuple[Union[float, None], ...]
    #: The unit of lengths.
    units: str
    #: The error allowed at all joints at once, in any direction, to first order.
    all_joints_radius: JointLimitRecord
    #: The error allowed in all coordinates at once, to first order.
    all_coordinates: JointLimitRecord
    #: The joints, the most critical first.
    joints: tuple[JointBudgetRecord, ...]
    #: Errors of the pose for the worst joint errors, solved exactly.
    worst_errors: WorstErrorsRecord
    #: The exact check of the first-order radius.
    solved: SolvedBudgetRecord
    #: Statistics of random errors in the budget.
    trials: TrialsRecord
    #: Statistics of random errors of joints and leg offsets with the covariance of the calibration; null:
    #: not requested.
    calibrated: Union[TrialsRecord, None]
    #: Uncertainty of computed poses due to the errors of the calibration, to first order; null: not
    #: requested.
    calibrated_poses: Union[CalibratedPosesRecord, None]
    #: The greatest errors from all causes together (joints, leg lengths, temperature); null: not
    #: requested.
    map: Union[ErrorMapRecord, None]
    #: The poses evaluated.
    poses: BudgetPosesRecord
    #: The program, seed and files behind the answer.
    provenance: ProvenanceRecord
    #: Warnings about the design files read.
    warnings: tuple[WarningRecord, ...]


class TravelRecord(Record):
    """A free travel and its end."""

    #: The length of the travel, not negative.
    free: float
    #: The value at the end.
    value: float
    #: The requirement violated beyond the end; null: none within half a turn, or ten sizes of the design.
    binds: Union[LimitRecord, None]


class TrialsRecord(Record):
    """Statistics of random errors in the budget."""

    #: Number of random samples.
    count: int
    #: Number of poses that were lost.
    lost: int
    #: Number of poses within the bound.
    within_bound: int
    #: Number of poses beyond the bound.
    beyond_bound: int
    #: Errors of the pose computed by the nominal formula.
    formula: PoseErrorsRecord
    #: Differences between these errors and their first-order values.
    first_order_discrepancy: PoseErrorsRecord
    #: Errors after one Newton step with the actual joints.
    after_one_step: PoseErrorsRecord
    #: Errors after two Newton steps with the actual joints.
    after_two_steps: PoseErrorsRecord


class TrilaterationStepRecord(Record):
    """One trilateration: a joint placed by its distances from three others."""

    #: Three joints already placed.
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
    #: Its value in the initial design.
    start: Union[float, None]
    #: Its value in the platform.
    value: Union[float, None]
    #: Its least and greatest allowed value.
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
    #: The verdict in one sentence, with the numbers that decided.
    explanation: str
    #: Whether exact arithmetic on the leg vectors proves the verdict; `level` of the map names the joints
    #: it holds for.
    proved: bool
    #: The algebraic evidence; if no motion was found, the map between the designs as given.
    map: MapRecord
    #: Bounds on the difference between the squared length of each leg of B and A s + c, design units
    #: squared. They hold at all poses of `sampling`, for any tolerance of the map. Null: the map is exact
    #: by proof, or singular, or no motion was found.
    deviation_bounds: Union[tuple[Union[float, None], ...], None]
    #: The largest distance of matched poses over all samples; null: none were compared.
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
    #: A pose that distinguishes the designs; null: none was found.
    counterexample: Union[CounterexampleRecord, None]
    #: The box of random poses; absent: no motion was found.
    sampling: Union[SamplingRecord, None]
    #: Whether base and platform of the second design were exchanged first.
    exchanged: Union[bool, None]
    #: The rigid motions that make the second design equivalent to the first, with `--align`.
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
    #: The line concerned, from 1.
    line: int
    #: The problem.
    message: str
    #: The remedy.
    help: str


class WitnessRecord(Record):
    """A pose with rational coordinates."""

    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]
    #: The orientation as a quaternion of any norm, scalar part first.
    quaternion: tuple[int, ...]


class WorkspaceSizeRecord(Record):
    """The size of the workspace around home."""

    #: Volume of the positions reached by straight paths from home at its orientation, design units cubed;
    #: an estimate from the paths that were followed.
    volume: float
    #: The relative difference between the volume estimates from every second path and from the others.
    volume_uncertainty: float
    #: Number of paths followed.
    rays: int
    #: The limits that end the paths, the most frequent first.
    ends: tuple[RayEndRecord, ...]
    #: Radius of the largest free ball of positions around home, at the orientation of home, design units.
    ball_radius: FreeSizeRecord
    #: Half widths of the largest box of positions proved free around home, at its orientation, along the
    #: axes of the base frame, design units.
    box_proved: tuple[float, ...]
    #: Half widths of the largest such box in which no violation was found, design units.
    box_searched: tuple[float, ...]
    #: The requirement violated in a slightly larger box; null: none was found.
    box_binds: Union[LimitRecord, None]
    #: Rotations about each axis of the base frame through the platform origin, at home.
    turns: tuple[FreeTurnRecord, ...]
    #: Largest free angle of rotation about every axis in the xy plane of the base, at the position of
    #: home, degrees.
    tilt_deg: FreeSizeRecord
    #: Largest free angle of rotation about every axis, at the position of home, degrees.
    turn_deg: FreeSizeRecord
    #: The workspace that the design requires; null: none.
    required: Union[RequiredSizeRecord, None]


class WorstErrorsRecord(Record):
    """Errors of the pose for the worst errors of all joints, solved exactly."""

    #: Errors of the pose for joint errors of this radius; null: the pose was lost.
    in_budget: Union[PoseErrorRecord, None]
    #: Errors of the pose for joint errors of 1.5 times the radius; null: the pose was lost.
    times_1_5: Union[PoseErrorRecord, None]
    #: The pose at which the errors were solved.
    pose: PoseQuaternionRecord


class WorstPoseRecord(Record):
    """The pose with the worst conditioning."""

    #: Index of the pose among the poses held, from 0.
    index: int
    #: Rows of the rotation matrix.
    R: tuple[tuple[Union[float, None], ...], ...]
    #: Position of the platform origin, base frame, design units.
    p: tuple[Union[float, None], ...]


class WrenchRecord(Record):
    """A force and a torque."""

    #: Force units.
    force: tuple[Union[float, None], ...]
    #: About the point, force units times design units.
    torque: tuple[Union[float, None], ...]


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

DesignSafetyMargin = Union[DesignNotNegative, DesignPercent]

DesignVector = tuple[DesignNumber, ...]

DesignAxes = Union[Literal["home", "normal", "optimize"], DesignVector, tuple[Union[Literal["normal"], DesignVector], ...]]

DesignBody = dict[str, Union[tuple[DesignQuantity, ...], Any, dict[str, Any]]]

DesignHousing = Union[DesignPositive, DesignEdges]

DesignRows = tuple[DesignVector, ...]
