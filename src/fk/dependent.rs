//! Platforms that cannot be assembled, and sets of poses of positive dimension.

use super::counted::{CountVerdict, compare, counted, set_counted};
use super::homotopy::pose_of;
use super::newton::on_a_curve;
use super::real_points::real_points;
use super::{
    Completeness, FkError, FkOptions, FkRoot, FkSolutions, Method, Reality, Reason, Rejected,
    RejectionReason, SolutionSet, Theorem,
};
use crate::solve::homotopy::{EndKind, HomotopyPath, StartKind, solve_sections};
use crate::solve::pose_count::{CountedLengths, PoseCount, PoseSet};
use crate::solve::{LegDependence, ScaledFrames};
use num::Purpose;
use platform::geom::{ComplexPose, Pose};
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Leg equations count as dependent below this sine when curves are searched for.
const RANK: f64 = 1e-9;
/// Points of a section with imaginary parts this many times the tolerance are not real.
const NON_REAL: f64 = 1e4;
/// Points of a section closer than this are not known to be two, in entries of the rotation and sizes.
const ONE_POSE: f64 = 1e-6;
/// Slices tried for one with a real pose on it.
const SLICES: u64 = 4;

fn without_roots(completeness: Completeness, solution_set: SolutionSet, o: &FkOptions) -> FkSolutions {
    FkSolutions {
        method: Method::Homotopy,
        roots: Vec::new(),
        solution_set,
        completeness,
        paths: Vec::new(),
        rejected: Vec::new(),
        pose_count: None,
        library_calls: Vec::new(),
        unproved: Vec::new(),
        seed: o.seed,
    }
}

/// The answer for leg vectors with a proved relation; `None` without one.
pub(super) fn related(
    legs: LegDependence,
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Option<Result<FkSolutions, FkError>> {
    match legs {
        LegDependence::Incompatible => Some(Ok(incompatible(o))),
        LegDependence::Compatible { relations } => Some(curves(m, s, o, &ScaledFrames::of(m, s), relations)),
        LegDependence::Independent | LegDependence::Nearly => None,
    }
}

/// Leg vectors with a relation that the lengths contradict.
fn incompatible(o: &FkOptions) -> FkSolutions {
    let theorem = Theorem::ContradictoryLengths;
    without_roots(Completeness::Proved { theorem }, SolutionSet::Empty, o)
}

/// Dependent leg equations: as many random sections as there are relations, or as the poses have dimensions, and the
/// points they cut out.
///
/// `proved` is the number of relations known to hold exactly, 0 when none is.
pub(super) fn curves(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &ScaledFrames,
    proved: usize,
) -> Result<FkSolutions, FkError> {
    let count = counted(m, s, o);
    let given = count.as_ref().filter(|c| c.lengths == CountedLengths::Given);
    let least = match given.map(|c| &c.set) {
        Some(PoseSet::PositiveDimensional { dimension, .. }) => *dimension,
        _ => 0,
    };
    let cuts = cut(m, s, o, frame, least)?;
    let dimension = cuts.dimension;
    let established = proved > 0 && dimension == proved && cuts.clean && !cuts.points.is_empty();
    let degree = if established { Some(cuts.points.len()) } else { cuts.degree(count.as_ref(), m.size()) };
    let mut points = cuts.points;
    let sections = points.len();
    if points.iter().all(|p| p.reality != Reality::Real) {
        points.extend(searched(m, s, o));
    }
    let seen = Reason::DependentLegs { established, dimension, points: sections, real: real(&points) };
    let mut completeness = Completeness::unproved([seen]);
    if let Some(count) = &count {
        completeness.learn(set_counted(count, established));
    }
    let set = SolutionSet::PositiveDimensional { dimension, witnesses: points, degree, established };
    let mut out = without_roots(completeness, set, o);
    out.pose_count = count;
    Ok(out)
}

/// The answer for independent legs whose equations cannot be told apart in doubles: the count, and no poses.
///
/// The lengths are then much longer than the design, or one body is much larger than the other.
pub(super) fn not_told_apart(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Result<FkSolutions, FkError> {
    let mut out = without_roots(Completeness::unproved([Reason::LegsNotToldApart]), SolutionSet::Isolated, o);
    if let Some(count) = counted(m, s, o)
        && let CountVerdict::PositiveDimensional { dimension } = compare(&mut out, &count)?
    {
        out.solution_set = SolutionSet::seen(dimension, Vec::new());
    }
    Ok(out)
}

/// The answer for a set of positive dimension that the count has found: points on the set replace the ends of paths,
/// which are arbitrary. Certified roots are isolated poses beside the set and stay; ends without a certificate are not
/// roots.
pub(super) fn positive_dimensional(
    mut found: FkSolutions,
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &ScaledFrames,
    dimension: usize,
) -> Result<FkSolutions, FkError> {
    let (isolated, others): (Vec<FkRoot>, Vec<FkRoot>) = found.roots.into_iter().partition(FkRoot::certified);
    let reason = RejectionReason::NotCertified;
    found.rejected.extend(others.iter().map(|r| Rejected { reason, residual: r.residual }));
    found.roots = isolated;
    forget_numbering(&mut found.paths);
    let cuts = cut(m, s, o, frame, dimension)?;
    let degree = cuts.degree(found.pose_count.as_ref(), m.size());
    let mut points = cuts.points;
    let sections = points.len();
    points.extend(searched(m, s, o));
    let isolated = found.roots.len();
    found.completeness.doubt(Reason::Sectioned { points: sections, real: real(&points), isolated });
    found.solution_set =
        SolutionSet::PositiveDimensional { dimension, witnesses: points, degree, established: false };
    Ok(found)
}

/// The number of real points.
fn real(points: &[FkRoot]) -> usize {
    points.iter().filter(|p| p.reality == Reality::Real).count()
}

/// The intersection of a set with random sections.
struct Cuts {
    points: Vec<FkRoot>,
    dimension: usize,
    /// All paths of the sections have a regular end or none, and all regular ends are points of the set.
    clean: bool,
}

impl Cuts {
    /// The degree counted modulo random primes for these lengths, if the sections have as many distinct points. General
    /// sections meet every component of that dimension, and have no more points than the degree.
    fn degree(&self, count: Option<&PoseCount>, size: f64) -> Option<usize> {
        let count = count.filter(|c| c.lengths == CountedLengths::Given)?;
        let PoseSet::PositiveDimensional { dimension, degree } = count.set else { return None };
        let poses: Vec<&ComplexPose> = self.points.iter().map(|p| &p.pose).collect();
        let apart = |k: usize| poses[..k].iter().all(|p| p.distance(poses[k], size) > ONE_POSE);
        (dimension == self.dimension && degree == poses.len() && (0..degree).all(apart)).then_some(degree)
    }
}

/// Real random sections, as many as dimensions, up to [`SLICES`] times until one has a real point.
fn cut(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &ScaledFrames,
    least: usize,
) -> Result<Cuts, FkError> {
    let breakdown = |what: &str| FkError::Breakdown { what: what.to_owned() };
    let mut best: Option<Cuts> = None;
    for slice in 0..SLICES {
        let mut rng = Purpose::SLICES.item(o.seed, slice);
        let (sections, dimension) = frame
            .sliced_sections(m, s, RANK, least, &mut rng)
            .ok_or_else(|| breakdown("the leg equations have no rank"))?;
        let paths =
            solve_sections(StartKind::Generic, &sections, o.seed).map_err(|e| breakdown(&e.to_string()))?;
        let points = witnesses(m, s, o, frame, &paths);
        let clean = paths.iter().all(|p| !matches!(p.kind, EndKind::Failed | EndKind::Singular));
        let finite = paths.iter().filter(|p| p.kind == EndKind::Regular).count();
        let real = points.iter().any(|p| p.reality == Reality::Real);
        if best.is_none() || real {
            best = Some(Cuts { clean: clean && finite == points.len(), points, dimension });
        }
        if real {
            break;
        }
    }
    best.ok_or_else(|| breakdown("no slice was made"))
}

/// Real poses on real components, as records without a certificate.
fn searched(m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Vec<FkRoot> {
    let record = |pose: &Pose| {
        let pose = ComplexPose::from(*pose);
        FkRoot {
            pose,
            reality: Reality::Real,
            certificate: None,
            multiplicity: 1,
            residual: pose.residual(m, s),
            condition: f64::INFINITY,
            dual_quaternion: None,
        }
    };
    real_points(m, s, o.seed).iter().map(record).collect()
}

fn witnesses(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &ScaledFrames,
    paths: &[HomotopyPath],
) -> Vec<FkRoot> {
    let size = m.size();
    let mut out = Vec::new();
    for path in paths.iter().filter(|p| p.kind == EndKind::Regular) {
        let pose = pose_of(frame.to_design(path.x));
        let scale = pose.position.iter().map(|z| z.norm() / size);
        let scale = pose.rotation.iter().map(|z| z.norm()).chain(scale).fold(1.0, f64::max);
        let residual = pose.residual(m, s);
        if !(residual <= o.tolerances.residual * scale * scale) {
            continue;
        }
        let imaginary = pose.imaginary_size(size) / scale;
        let reality = if imaginary < o.tolerances.reality {
            Reality::Real
        } else if imaginary > NON_REAL * o.tolerances.reality {
            Reality::NonReal
        } else {
            Reality::Undecided
        };
        let condition = 1.0 / path.pivot_ratio;
        out.push(FkRoot {
            pose,
            reality,
            certificate: None,
            multiplicity: 1,
            residual,
            condition,
            dual_quaternion: None,
        });
    }
    out
}

/// The numbering of the roots has changed.
fn forget_numbering(paths: &mut [super::PathReport]) {
    for path in paths {
        path.root = None;
        path.mirror_root = None;
    }
}

/// Moves uncertified roots that lie on curves of poses out of the list of isolated ones.
pub(super) fn detect_curves(found: &mut FkSolutions, m: &Manipulator, s: &SquaredLegLengths) {
    let suspect = |r: &FkRoot| !r.certified() && !(r.condition < 1e6);
    if !found.roots.iter().any(suspect) {
        return;
    }
    let roots = std::mem::take(&mut found.roots);
    let (curve, isolated): (Vec<FkRoot>, Vec<FkRoot>) =
        roots.into_iter().partition(|r| suspect(r) && on_a_curve(m, s, &r.pose));
    found.roots = isolated;
    if curve.is_empty() {
        return;
    }
    forget_numbering(&mut found.paths);
    let paths = curve.iter().map(|r| r.multiplicity).sum();
    found.completeness.doubt(Reason::CurvesSeen { paths });
    found.solution_set = SolutionSet::seen(1, curve);
}
