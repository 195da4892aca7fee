//! The general method: parameter homotopy for any six legs, knowing nothing of leg maps.

mod prepared;

use std::collections::VecDeque;

use num_complex::Complex64;

use super::bounded::Surroundings;
use super::counted::{CountVerdict, compare, counted, set_counted};
use super::dependent::{curves, detect_curves, not_told_apart, positive_dimensional, related};
use super::evidence::{KnownCertificates, attach, set_unproved_apart};
use super::harvest::{Harvest, HarvestEnd, PreciseEnd, harvest};
use super::{
    Completeness, FkError, FkOptions, FkSolutions, ForwardKinematics, Method, PathEnd, PathReport,
    PathsEnded, PoseCounting, PreparedDesign, Reason, SolutionSet, Theorem,
};
use crate::solve::homotopy::{
    EndKind, GENERIC_COUNT, HomotopyPath, StartError, StartKind, TailEnd, follow_finely, solve_sections,
};
use crate::solve::pose_count::PoseCount;
use crate::solve::{LegDependence, ScaledFrames, Sections, dependence, mirror, quaternion_product, split};
use platform::geom::{ComplexPose, rotation_from_quaternion};
use platform::manipulator::{Manipulator, SquaredLegLengths};
use prepared::PreparedHomotopy;

/// Times the whole problem is tracked again with another gamma when paths fail.
const ATTEMPTS: u64 = 3;
/// The same with 256 bits, seconds each where paths fail.
const FINE_ATTEMPTS: u64 = 2;
/// Above this ratio of the bodies doubles keep at most six digits of the smaller one beside the larger.
const BODIES_APART: f64 = 1e10;

/// Forward kinematics of any six legs by 40 homotopy paths from a generic start system. With planar base and platform,
/// 20 paths lead to one pose of each mirror pair.
///
/// Unknowns are the dual quaternion `(e, g)`, `g = p e`; a pose is finite when `e.e != 0`. Sources: Husty 1996 for the
/// coordinates, Gallet, Nawratil, Schicho 2014 for the degree 40. Each path is reported with its end: a finite pose,
/// `e.e = 0`, infinity, or failed. Both poses of a mirror pair are refined and certified on the legs as they are. When
/// fewer poses are found than there can be, all 40 paths are tracked. The paths that do not end in a certified pose are
/// then followed with 256 bits.
#[derive(Debug, Clone, Copy, Default)]
pub struct Homotopy;

impl ForwardKinematics for Homotopy {
    fn method(&self) -> Method {
        Method::Homotopy
    }

    fn solve(&self, m: &Manipulator, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        let frame = ScaledFrames::of(m, s);
        let legs = dependence(m, s);
        let nearly = matches!(legs, LegDependence::Nearly);
        if nearly && ratio_of_bodies(m) > BODIES_APART {
            return not_told_apart(m, s, o);
        }
        if let Some(dependent) = related(legs, m, s, o) {
            return dependent;
        }
        let Some(sections) = frame.sections(m, s) else {
            return if nearly { curves(m, s, o, &frame, 0) } else { not_told_apart(m, s, o) };
        };
        let mut surroundings = Surroundings::new(m, o.seed);
        let mut found = attempts((frame, sections), nearly, (m, &mut surroundings), s, o)?;
        surroundings.conclude_last(&mut found, s);
        Ok(found)
    }

    fn prepare(&self, m: &Manipulator, o: &FkOptions) -> Option<Box<dyn PreparedDesign>> {
        Some(Box::new(PreparedHomotopy::new(m, o)?))
    }
}

/// Tracks the paths, again and more finely as long as poses are missing.
fn attempts(
    (frame, sections): (ScaledFrames, Sections),
    nearly: bool,
    (m, surroundings): (&Manipulator, &mut Surroundings<'_>),
    s: &SquaredLegLengths,
    o: &FkOptions,
) -> Result<FkSolutions, FkError> {
    let mut best: Option<FkSolutions> = None;
    let mut count: Option<PoseCount> = None;
    let whole = |k: u64, fine| (SectionProblem { frame, sections, kind: StartKind::Generic, fine }, k);
    let planar = SectionProblem::planar(m, s).map(|p| (p, 0));
    let next = u64::from(planar.is_none());
    let mut plans = VecDeque::from([planar.unwrap_or_else(|| whole(0, false))]);
    let mut quick = None;
    // roots that doubles cannot certify, of any attempt: more bits certify each of them beside a motion too
    let mut uncertified = None;
    while let Some((problem, attempt)) = plans.pop_front() {
        let seed = o.seed.wrapping_add(attempt.wrapping_mul(0x9e37_79b9));
        let (mut found, certificates) = problem.solve(m, s, o, seed)?;
        attach(&mut found, m, s, Theorem::SixLegs, certificates)?;
        uncertified = found.roots.iter().any(|r| !r.certified()).then(|| found.clone()).or(uncertified);
        if found.completeness.is_proved() || surroundings.conclude(&mut found, s, o.pose_count)? {
            return Ok(moving_within_rounding(uncertified, m, s, count, o).unwrap_or(found));
        }
        let quick = *quick.get_or_insert_with(|| {
            // poses that doubles cannot see are asked for by the count, and by the proof next to affine hexagons
            let quick = o.pose_count == PoseCounting::Never && !surroundings.is_next_to_affine_hexagons();
            let (plain, fine) = if quick { (ATTEMPTS, 0) } else { (1, FINE_ATTEMPTS) };
            plans.extend((next..plain).map(|k| whole(k, false)).chain((0..fine).map(|k| whole(k, true))));
            quick
        });
        // the kind of the set has to be known before any end without a proof is taken for a pose
        if count.is_none() {
            count = counted(m, s, o);
        }
        let verdict = count.as_ref().map_or(Ok(CountVerdict::Silent), |c| compare(&mut found, c))?;
        match verdict {
            CountVerdict::Complete => {
                return Ok(moving_within_rounding(uncertified, m, s, count, o).unwrap_or(found));
            }
            CountVerdict::PositiveDimensional { dimension } => {
                return positive_dimensional(found, m, s, o, &frame, dimension);
            }
            CountVerdict::Short => {}
            CountVerdict::Silent => detect_curves(&mut found, m, s),
        }
        if nearly {
            // the answer depends on digits that nobody knows
            found.completeness.doubt(Reason::LegsNearlyDependent);
        }
        set_unproved_apart(&mut found);
        let settled = (nearly && quick) || found.solution_set != SolutionSet::Isolated;
        if settled || (found.all_accounted() && (quick || problem.fine)) {
            return Ok(found);
        }
        let certified = |f: &FkSolutions| f.roots.iter().filter(|r| r.certified()).count();
        let rank = |f: &FkSolutions| (std::cmp::Reverse(certified(f)), failures(f));
        // where every path has an end, other paths have the same; where nothing is gained, they fail as well
        let gained = best.as_ref().is_none_or(|b| certified(&found) > certified(b));
        let ended = failures(&found) == 0 && found.rejected.is_empty();
        let last = problem.fine && (ended || !gained);
        if best.as_ref().is_none_or(|b| rank(&found) < rank(b)) {
            best = Some(found);
        }
        if last {
            break;
        }
    }
    best.ok_or_else(|| FkError::Breakdown { what: "no attempt was made".to_owned() })
}

/// The answer for lengths of a self-motion that were rounded. Rounded lengths allow no motion: the design as written
/// has the certified poses and no others, but designs next to it move. The answer says so and is not called complete.
fn moving_within_rounding(
    found: Option<FkSolutions>,
    m: &Manipulator,
    s: &SquaredLegLengths,
    count: Option<PoseCount>,
    o: &FkOptions,
) -> Option<FkSolutions> {
    let mut found = found?;
    detect_curves(&mut found, m, s);
    if !matches!(found.solution_set, SolutionSet::PositiveDimensional { .. }) {
        return None;
    }
    set_unproved_apart(&mut found);
    let count = count.or_else(|| counted(m, s, o));
    if let Some(count) = &count {
        found.completeness.learn(set_counted(count, false));
    }
    found.pose_count = count;
    Some(found)
}

/// Failed paths, each counted once for every pose it stands for.
fn failures(found: &FkSolutions) -> usize {
    let failed = found.paths.iter().filter(|p| p.end == PathEnd::Failed).count();
    if found.paths.len() < GENERIC_COUNT { 2 * failed } else { failed }
}

/// The ratio of the sizes of the two bodies, by the distances of leg ends from their mean; 1 for a body in one point.
fn ratio_of_bodies(m: &Manipulator) -> f64 {
    let [base, platform] = m.mean_leg_ends();
    let largest = |list: [f64; 6]| list.into_iter().fold(0.0, f64::max);
    let (a, b) = (
        largest(m.legs().map(|l| (l.base.coords - base).norm())),
        largest(m.legs().map(|l| (l.platform.coords - platform).norm())),
    );
    if a.min(b) > 0.0 { (a / b).max(b / a) } else { 1.0 }
}

/// The sections to be solved and the frame they belong to.
struct SectionProblem {
    frame: ScaledFrames,
    sections: Sections,
    kind: StartKind,
    /// Whether paths that end in no certified pose are followed with 256 bits; for [`StartKind::Generic`].
    fine: bool,
}

impl SectionProblem {
    /// The problem in the planes of base and platform, if there are such planes.
    fn planar(m: &Manipulator, s: &SquaredLegLengths) -> Option<Self> {
        let frame = ScaledFrames::planar(m, s)?;
        Some(Self { sections: frame.sections(m, s)?, frame, kind: StartKind::Planar, fine: false })
    }

    fn solve(
        &self,
        m: &Manipulator,
        s: &SquaredLegLengths,
        o: &FkOptions,
        seed: u64,
    ) -> Result<(FkSolutions, KnownCertificates), FkError> {
        let breakdown = |e: StartError| FkError::Breakdown { what: e.to_string() };
        let mut paths = solve_sections(self.kind, &self.sections, seed).map_err(breakdown)?;
        let mut found = harvest(m, s, &o.tolerances, &ends_of(self, &paths), &[]);
        if self.fine {
            // with 256 bits nothing is dependent that is not so exactly: that is for others to find
            if let Some(sections) = self.frame.octuple_sections(m, s) {
                let open = open_paths(&found, paths.len());
                let tails = follow_finely(&sections, seed, &open).map_err(breakdown)?;
                let precise = self.take_over(&mut paths, &open, &tails);
                found = harvest(m, s, &o.tolerances, &ends_of(self, &paths), &precise);
            }
        }
        Ok(assemble(o, self, &paths, self.kind.count(), found))
    }

    /// Replaces the results of doubles by those of the precise continuation of paths. Returns the finite ends with all
    /// their digits.
    fn take_over(&self, paths: &mut [HomotopyPath], open: &[usize], tails: &[TailEnd]) -> Vec<PreciseEnd> {
        let mut out = Vec::new();
        for (&source, tail) in open.iter().zip(tails) {
            let path = &mut paths[source];
            path.kind = tail.kind();
            path.x = tail.rounded();
            path.steps += tail.steps;
            path.rejections += tail.rejections;
            path.winding = u32::from(tail.arrived);
            path.retracked += 1;
            path.split = None;
            path.pivot_ratio = tail.pivot_ratio;
            path.precise = true;
            if path.kind == EndKind::Regular {
                let point = self.frame.to_design_precisely(&tail.x);
                out.push(PreciseEnd { point, condition: 1.0 / tail.pivot_ratio, source });
            }
        }
        out
    }
}

/// Paths that do not end in a certified root, or share it with another.
fn open_paths(found: &Harvest, count: usize) -> Vec<usize> {
    let collected = &found.collected;
    let settled: Vec<usize> = collected
        .roots
        .iter()
        .zip(&collected.sources)
        .filter(|(root, sources)| root.certified() && sources.len() == 1)
        .map(|(_, sources)| sources[0])
        .collect();
    (0..count).filter(|k| !settled.contains(k)).collect()
}

/// The pose of homogeneous coordinates `(e, g)` in the design's frames: `R = R(e)`, `p = g e~ / (e.e)`.
pub(super) fn pose_of(x: [Complex64; 8]) -> ComplexPose {
    let (e, g) = split(x);
    let n: Complex64 = e.iter().map(|z| z * z).sum();
    let conjugate = [e[0], -e[1], -e[2], -e[3]];
    let p = quaternion_product(g, conjugate);
    let position = nalgebra::Vector3::new(p[1] / n, p[2] / n, p[3] / n);
    ComplexPose { rotation: rotation_from_quaternion(e), position }
}

/// The ends that are or may be finite; where paths stand for two, the mirror images follow with sources counted on.
fn ends_of(problem: &SectionProblem, paths: &[HomotopyPath]) -> Vec<HarvestEnd> {
    let mut out = Vec::with_capacity(2 * paths.len());
    for (start, path) in paths.iter().enumerate() {
        let finite = matches!(path.kind, EndKind::Regular | EndKind::Singular);
        // ends followed with 256 bits are final, finite ones in a list of their own
        let elsewhere = path.precise && path.kind != EndKind::Singular;
        if elsewhere || path.kind == EndKind::Failed || !(finite || path.winding <= 2) {
            continue;
        }
        let end = |x: [Complex64; 8], split: Option<[Complex64; 8]>, source| HarvestEnd {
            point: problem.frame.to_design(x),
            singular: path.kind == EndKind::Singular,
            doubtful: !finite,
            split: split.map(|h| problem.frame.to_design(h)),
            condition: 1.0 / path.pivot_ratio,
            source,
        };
        out.push(end(path.x, path.split, start));
        if problem.kind == StartKind::Planar {
            out.push(end(mirror(path.x), path.split.map(mirror), paths.len() + start));
        }
    }
    out
}

fn report_of(start: usize, path: &HomotopyPath) -> PathReport {
    let end = match path.kind {
        EndKind::Regular | EndKind::Singular => PathEnd::Finite,
        EndKind::Isotropic => PathEnd::IsotropicRotation,
        EndKind::Infinite => PathEnd::AtInfinity,
        EndKind::Failed => PathEnd::Failed,
    };
    let e = &path.x[..4];
    let n: Complex64 = e.iter().map(|z| z * z).sum();
    let size: f64 = e.iter().map(num_complex::Complex::norm_sqr).sum();
    PathReport {
        start,
        end,
        root: None,
        mirror_root: None,
        steps: path.steps,
        rejections: path.rejections,
        winding: path.winding,
        isotropy: n.norm() / size,
        retracked: path.retracked,
    }
}

/// Whether an end is near infinity or `e.e = 0` but not there to the digits that ends have.
///
/// Ends at infinity have `|e| / |(e, g)|` below `1e-9`, or around `1e-8`, the root of rounding, where two paths end in
/// one. Ends at `e.e = 0` have `|e.e| / |e|^2` below `1e-13` and `e` not small (18,000 ends of the special classes of
/// the harness). The limits leave a factor of ten, and poses far out lie between them.
fn is_blurred(path: &HomotopyPath) -> bool {
    let e: f64 = path.x[..4].iter().map(Complex64::norm_sqr).sum();
    let all: f64 = path.x.iter().map(Complex64::norm_sqr).sum();
    let n: Complex64 = path.x[..4].iter().map(|z| z * z).sum();
    let at_infinity = e < 1e-14 * all;
    let isotropic = n.norm() < 1e-10 * e && e > 1e-6 * all;
    let far = matches!(path.kind, EndKind::Infinite | EndKind::Isotropic);
    far && !path.precise && !at_infinity && !isotropic
}

fn assemble(
    o: &FkOptions,
    problem: &SectionProblem,
    paths: &[HomotopyPath],
    expected: usize,
    found: Harvest,
) -> (FkSolutions, KnownCertificates) {
    let mut reports: Vec<PathReport> =
        paths.iter().enumerate().map(|(start, path)| report_of(start, path)).collect();
    let Harvest { mut collected, certificates } = found;
    for (root, sources) in collected.sources.iter().enumerate() {
        for &source in sources {
            let report = &mut reports[source % paths.len()];
            let place = if source < paths.len() { &mut report.root } else { &mut report.mirror_root };
            *place = Some(root);
            report.end = PathEnd::Finite;
            // a path with winding number w shares its end with w - 1 others
            collected.doubtful |= report.winding > collected.roots[root].multiplicity;
        }
    }
    let count = |end| reports.iter().filter(|p| p.end == end).count();
    let ends = PathsEnded {
        paths: expected,
        mirrored: problem.kind == StartKind::Planar,
        finite: count(PathEnd::Finite),
        isotropic: count(PathEnd::IsotropicRotation),
        infinite: count(PathEnd::AtInfinity),
        failed: count(PathEnd::Failed),
        blurred: reports.iter().zip(paths).filter(|(r, p)| r.root.is_none() && is_blurred(p)).count(),
        rejected: collected.rejected.len(),
        ambiguous: collected.doubtful,
        unreported: expected.abs_diff(reports.len()),
    };
    let solutions = FkSolutions {
        method: Method::Homotopy,
        roots: collected.roots,
        solution_set: SolutionSet::Isolated,
        completeness: Completeness::unproved([Reason::PathsEnded(ends)]),
        paths: reports,
        rejected: collected.rejected,
        pose_count: None,
        library_calls: Vec::new(),
        unproved: Vec::new(),
        seed: o.seed,
    };
    (solutions, certificates)
}

#[cfg(test)]
mod tests;
