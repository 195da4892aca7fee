//! Platforms whose leg equations are linearly dependent: no pose at all, or curves of poses.

use super::homotopy::pose_of;
use super::newton::on_a_curve;
use super::{Completeness, FkError, FkOptions, FkRoot, FkSolutions, Method, Reality, SolutionSet};
use crate::manipulator::{Manipulator, SquaredLegLengths};
use crate::num::Rng;
use crate::solve::Frame;
use crate::solve::homotopy::{EndKind, Path, StartKind, solve_sections};

/// Leg equations count as dependent below this sine when curves are looked for.
const RANK: f64 = 1e-9;
/// Slices tried for one with a real pose on it.
const SLICES: u64 = 4;

fn without_roots(reason: String, solution_set: SolutionSet, o: &FkOptions) -> FkSolutions {
    FkSolutions {
        method: Method::Homotopy,
        roots: Vec::new(),
        solution_set,
        completeness: Completeness::Unproved { reason, all_paths_accounted: true },
        paths: Vec::new(),
        rejected: Vec::new(),
        seed: o.seed,
    }
}

/// Leg vectors with a relation that the lengths contradict.
pub(super) fn incompatible(o: &FkOptions) -> FkSolutions {
    let argument = "the leg vectors satisfy a linear relation, exactly, and the squared lengths do not: the same combination of \
                    the leg equations is a nonzero multiple of e.e, which no pose annuls (docs/theory/completeness.md)";
    let mut out = without_roots(String::new(), SolutionSet::Empty, o);
    out.completeness = Completeness::Proved { argument: argument.to_owned() };
    out
}

/// Dependent leg equations: as many random sections as there are relations, and the points they cut out.
///
/// `proved` is the number of relations known to hold exactly, 0 when none is.
pub(super) fn curves(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &Frame,
    proved: usize,
) -> Result<FkSolutions, FkError> {
    let breakdown = |what: &str| FkError::Breakdown { what: what.to_owned() };
    let mut best: Option<(Vec<FkRoot>, usize, bool)> = None;
    for slice in 0..SLICES {
        let mut rng = Rng::stream(o.seed, 1000 + slice);
        let (sections, dimension) = frame
            .sliced_sections(m, s, RANK, &mut rng)
            .ok_or_else(|| breakdown("the leg equations have no rank"))?;
        let paths =
            solve_sections(StartKind::Generic, &sections, o.seed).map_err(|e| breakdown(&e.to_string()))?;
        let points = witnesses(m, s, o, frame, &paths);
        let clean = paths.iter().all(|p| !matches!(p.kind, EndKind::Failed | EndKind::Singular));
        let finite = paths.iter().filter(|p| p.kind == EndKind::Regular).count();
        let established = proved > 0 && dimension == proved && clean && finite == points.len() && finite > 0;
        let real = points.iter().any(|p| p.reality == Reality::Real);
        if best.is_none() || real {
            best = Some((points, dimension, established));
        }
        if real {
            break;
        }
    }
    let (points, dimension, established) = best.ok_or_else(|| breakdown("no slice was made"))?;
    Ok(report(points, dimension, established, o))
}

fn report(points: Vec<FkRoot>, dimension: usize, established: bool, o: &FkOptions) -> FkSolutions {
    let real = points.iter().filter(|p| p.reality == Reality::Real).count();
    let relation = if established {
        "a relation between the leg vectors holds exactly and"
    } else {
        "numerically, a relation between the leg vectors holds and"
    };
    let reason = format!(
        "{relation} the lengths satisfy it within rounding: the poses form a set of dimension {dimension} (at least), which a general \
         section of that codimension meets in {} finite points, {real} of them real in this section; isolated poses beside it are not \
         looked for",
        points.len(),
    );
    let set = SolutionSet::PositiveDimensional { dimension, witnesses: points, established };
    let mut out = without_roots(String::new(), set, o);
    out.completeness = Completeness::Unproved { reason, all_paths_accounted: established };
    out
}

fn witnesses(
    m: &Manipulator,
    s: &SquaredLegLengths,
    o: &FkOptions,
    frame: &Frame,
    paths: &[Path],
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
        } else if imaginary > 1e4 * o.tolerances.reality {
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
    for path in &mut found.paths {
        // the numbering of the roots has changed
        path.root = None;
        path.mirror_root = None;
    }
    let reason = format!(
        "{} paths end on curves of poses (self-motions), found numerically; further curves and isolated poses may be missing",
        curve.iter().map(|r| r.multiplicity).sum::<u32>()
    );
    found.completeness = Completeness::Unproved { reason, all_paths_accounted: false };
    found.solution_set =
        SolutionSet::PositiveDimensional { dimension: 1, witnesses: curve, established: false };
}
