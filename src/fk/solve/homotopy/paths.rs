//! All paths of one problem: tracked, ended, classified, repaired.

use num_complex::Complex64;

use super::dispatch::track_all;
use super::endgame::{end_path, projective_distance};
use super::fast_tracker::{FastPath, FastTracker};
use super::limits::{BRISK, CAREFUL, FAST, TrackerLimits, VERY_CAREFUL};
use super::monodromy::StartKind;
use super::polish::{PolishedRoot, polish};
use super::start::{StartError, shipped};
use super::system::SectionHomotopy;
use super::tail::{CornerTail, TailEnd};
use super::tracker::Tracked;
use crate::solve::octuple_sections::OctupleSections;
use crate::solve::planar::mirror;
use crate::solve::sections::Sections;
use num::Purpose;

/// A Newton correction below this, or expected to be, needs no further polishing.
pub(super) const SETTLED: f64 = 1e-13;
/// Paths to be tracked again are stopped here and always go through the endgame.
const CAREFUL_ENDGAME_AT: f64 = 1e-2;
/// Paths are followed with 256 bits from here.
const TAIL_AT: f64 = 1e-2;
/// A point with `|e.e| / |e|^2` below this at a converged end has no rotation.
const ISOTROPIC: f64 = 1e-9;
/// A converged end with `|e| / |(e, g)|` below this is at infinity or very far out: for a certificate to decide.
const INFINITE: f64 = 1e-7;
/// [`ISOTROPIC`] for an end known only as the mean of an endgame loop, whose square root counts.
const ISOTROPIC_MEAN: f64 = 1e-4;
/// Newton's method confirms the mean of an endgame loop when it moves it by less than this.
const SAME_MEAN: f64 = 1e-3;
/// Two regular ends closer than this are one root reached twice.
pub(super) const SAME_END: f64 = 1e-7;

/// Squared moduli of a coordinate of ends that may be one are no further apart.
const ALIKE_MODULI: f64 = 10.0 * SAME_END;

/// A regular end with a smaller pivot ratio may be one of two roots that coincide nearly.
const NEARLY_SINGULAR: f64 = 1e-5;
/// The kind of the end of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EndKind {
    /// A nonsingular finite root, Newton converged.
    Regular,
    /// A finite root where the equations are singular.
    Singular,
    /// `e.e = 0`, `e != 0`.
    Isotropic,
    /// `e = 0`.
    Infinite,
    /// Not found.
    Failed,
}

/// One path.
#[derive(Debug, Clone, Copy)]
pub struct HomotopyPath {
    /// The end of the path, in Study coordinates.
    pub x: [Complex64; 8],
    /// The kind of its end.
    pub kind: EndKind,
    /// Accepted steps.
    pub steps: u32,
    /// Rejected steps.
    pub rejections: u32,
    /// Winding number found by the endgame, 0 when not determined.
    pub winding: u32,
    /// Number of repeated trackings with smaller steps.
    pub retracked: u32,
    /// Half the distance of two roots not told apart, where the winding number is two; see `endgame::EndPoint`.
    pub split: Option<[Complex64; 8]>,
    /// Smallest over largest pivot modulus of the Newton matrix at the end.
    pub pivot_ratio: f64,
    /// The end was followed with 256 bits.
    pub(crate) precise: bool,
}

impl HomotopyPath {
    /// The results of the fast tracker; no end yet.
    pub(super) fn under_way(p: &FastPath) -> Self {
        Self {
            x: p.x,
            kind: EndKind::Failed,
            steps: p.steps,
            rejections: p.rejections,
            winding: 0,
            retracked: 0,
            split: None,
            pivot_ratio: 1.0 / p.condition,
            precise: false,
        }
    }
}

fn isotropy(x: &[Complex64; 8]) -> (f64, f64) {
    let e = &x[..4];
    let size: f64 = e.iter().map(num_complex::Complex::norm_sqr).sum();
    let all: f64 = x.iter().map(num_complex::Complex::norm_sqr).sum();
    let n: Complex64 = e.iter().map(|z| z * z).sum();
    // no `hypot`: numbers that underflow are isotropic
    (n.norm_sqr().sqrt() / size, (size / all).sqrt())
}

/// Tracks all paths from the start system of a kind to `target`, which must be of that kind. For [`StartKind::Planar`]
/// the mirror images of the ends are the ends of the other paths. The seed sets gamma.
///
/// Ends that look alike although regular, and paths without an end, are tracked again with smaller steps. Paths that
/// fail again are left as [`EndKind::Failed`].
///
/// # Errors
/// A start system that cannot be made.
pub fn solve_sections(
    kind: StartKind,
    target: &Sections,
    seed: u64,
) -> Result<Vec<HomotopyPath>, StartError> {
    let start = shipped(kind)?;
    let corner = corner(seed);
    let aligned = start.sections.aligned_with(target);
    let real = SectionHomotopy::real(&aligned, target).ok_or(StartError::NotReal)?;
    let (starts, limits, way) = (&start.solutions, FAST, [Complex64::ONE, corner, Complex64::ZERO]);
    let tracked_fast = match kind {
        StartKind::Generic => FastTracker { homotopy: &real, starts, way, limits }.run(),
        StartKind::Planar => FastTracker { homotopy: &real.planar(), starts, way, limits }.run(),
    };
    // the second leg, from the corner to the target, as a homotopy of its own
    let homotopy = SectionHomotopy::through(&real, corner);
    let mut paths: Vec<HomotopyPath> = tracked_fast
        .iter()
        .map(|p| {
            let blank = HomotopyPath::under_way(p);
            match p.remaining {
                None => blank,
                Some(t) if t > 0.0 => settle_by_endgame(&homotopy, blank, t),
                Some(_) if p.correction < SETTLED => settle(blank, &p.x),
                Some(_) => settle_arrived(&homotopy, &blank),
            }
        })
        .collect();
    let retracker = Retracker { homotopy: &homotopy, real: &real, corner, starts };
    // A long last step may arrive at a singular end without passing through the endgame: those paths are
    // stopped before it. The later rounds are for lost and crossed paths.
    for limits in [BRISK, CAREFUL, VERY_CAREFUL] {
        let again = suspects(kind, &paths, target);
        if again.is_empty() {
            break;
        }
        retracker.run(&mut paths, &again, &limits);
    }
    Ok(paths)
}

/// The corner of the way from start to target.
fn corner(seed: u64) -> Complex64 {
    let mut rng = Purpose::GAMMA.rng(seed);
    Complex64::new(0.5, 0.0) + Complex64::from_polar(0.25, rng.uniform(0.6, 2.5))
}

/// Tracks the paths `which` of the 40 to `target` again, the last part of each with 256 bits. The seed is that of
/// [`solve_sections`], whose paths these are.
///
/// # Errors
/// A start system that cannot be made.
pub(crate) fn follow_finely(
    target: &OctupleSections,
    seed: u64,
    which: &[usize],
) -> Result<Vec<TailEnd>, StartError> {
    let start = shipped(StartKind::Generic)?;
    let corner = corner(seed);
    let rounded = target.rounded();
    let aligned = start.sections.aligned_with(&rounded);
    let real = SectionHomotopy::real(&aligned, &rounded).ok_or(StartError::NotReal)?;
    let first = SectionHomotopy::through(&real, Complex64::ONE).shortened(corner);
    let second = SectionHomotopy::through(&real, corner).shortened(TAIL_AT.into());
    let tail = CornerTail::new(&aligned, target, corner);
    let from: Vec<[Complex64; 8]> = which.iter().map(|i| start.solutions[*i]).collect();
    let at_corner = track_all(&first, &from, &CAREFUL, 0.0);
    let middle: Vec<[Complex64; 8]> = at_corner.iter().map(|p| p.x).collect();
    let near_end = track_all(&second, &middle, &CAREFUL, 0.0);
    let follow = |(p, q): (&Tracked, &Tracked)| {
        if p.arrived && q.arrived { tail.follow(&q.x, TAIL_AT) } else { TailEnd::lost(&q.x) }
    };
    Ok(at_corner.iter().zip(&near_end).map(follow).collect())
}

pub(super) fn settle_arrived(homotopy: &SectionHomotopy, path: &HomotopyPath) -> HomotopyPath {
    settle_polished(*path, &polish(homotopy, &path.x))
}

fn settle_polished(mut path: HomotopyPath, end: &PolishedRoot) -> HomotopyPath {
    path.pivot_ratio = end.pivot_ratio;
    if end.converged { settle(path, &end.x) } else { path }
}

/// A path whose end point Newton's method has settled.
pub(super) fn settle(mut path: HomotopyPath, x: &[Complex64; 8]) -> HomotopyPath {
    let (iso, finite) = isotropy(x);
    path.x = *x;
    path.winding = 1;
    path.kind = if finite < INFINITE {
        EndKind::Infinite
    } else if iso < ISOTROPIC {
        EndKind::Isotropic
    } else {
        EndKind::Regular
    };
    path
}

fn settle_by_endgame(homotopy: &SectionHomotopy, mut path: HomotopyPath, t: f64) -> HomotopyPath {
    let Some(end) = end_path(homotopy, &path.x, t) else { return path };
    if let Some(polished) = &end.regular {
        return settle_polished(path, polished);
    }
    // A mean with winding number 1 is a single point. If Newton's method confirms it as a regular root, its own digits
    // say whether e.e vanishes. The blur below is for ends that are known with less accuracy. Finite poses far out have
    // |e.e| / |e|^2 down to 1e-6 and must not be taken for ends at e.e = 0.
    if end.winding == 1 {
        let polished = polish(homotopy, &end.x);
        if polished.converged && projective_distance(&unit(&polished.x), &unit(&end.x)) < SAME_MEAN {
            return settle_polished(path, &polished);
        }
    }
    path.x = end.x;
    path.winding = end.winding;
    path.split = end.split;
    let (iso, finite) = isotropy(&end.x);
    let blur = end.accuracy.max(1e-12).sqrt().max(ISOTROPIC_MEAN);
    path.kind = if finite < blur {
        EndKind::Infinite
    } else if iso < blur {
        EndKind::Isotropic
    } else {
        EndKind::Singular
    };
    path.pivot_ratio = polish(homotopy, &path.x).pivot_ratio;
    path
}

/// Tracks paths again from the start by the trusted tracker, stops them before the target and ends them in
/// the endgame.
struct Retracker<'a> {
    /// The way from the corner to the target.
    homotopy: &'a SectionHomotopy,
    real: &'a SectionHomotopy<f64>,
    corner: Complex64,
    starts: &'a [[Complex64; 8]],
}

impl Retracker<'_> {
    fn run(&self, paths: &mut [HomotopyPath], again: &[usize], limits: &TrackerLimits) {
        let first = SectionHomotopy::through(self.real, Complex64::ONE).shortened(self.corner);
        let second = self.homotopy.shortened(CAREFUL_ENDGAME_AT.into());
        let from: Vec<[Complex64; 8]> = again.iter().map(|i| self.starts[*i]).collect();
        let at_corner = track_all(&first, &from, limits, 0.0);
        let middle: Vec<[Complex64; 8]> = at_corner.iter().map(|p| p.x).collect();
        let near_end = track_all(&second, &middle, limits, 0.0);
        for ((index, p), q) in again.iter().zip(at_corner).zip(near_end) {
            let before = &paths[*index];
            let path = HomotopyPath {
                x: q.x,
                kind: EndKind::Failed,
                steps: before.steps + p.steps + q.steps,
                rejections: before.rejections + p.rejections + q.rejections,
                winding: 0,
                retracked: before.retracked + 1,
                split: None,
                pivot_ratio: 0.0,
                precise: false,
            };
            let arrived = p.arrived && q.arrived;
            paths[*index] =
                if arrived { settle_by_endgame(self.homotopy, path, CAREFUL_ENDGAME_AT) } else { path };
        }
    }
}

/// Indices of paths whose end is missing, coincides with that of another regular path, or lacks its
/// complex conjugate although the target is real. Mirror images of ends are ends, too, for a planar start.
pub(crate) fn suspects(kind: StartKind, paths: &[HomotopyPath], target: &Sections) -> Vec<usize> {
    let real = target.rows.iter().flatten().all(|z| z.im == 0.0);
    let mut ends: Vec<([Complex64; 8], bool)> =
        paths.iter().map(|p| (unit(&p.x), p.kind == EndKind::Regular)).collect();
    if kind == StartKind::Planar {
        for i in 0..paths.len() {
            ends.push((mirror(ends[i].0), ends[i].1));
        }
    }
    // moduli of two coordinates, whatever the phases: a quick check before the accurate distance, in the order of the
    // first
    let moduli: Vec<[f64; 2]> = ends.iter().map(|(x, _)| [x[0].norm_sqr(), x[1].norm_sqr()]).collect();
    let mut order: Vec<usize> = (0..ends.len()).filter(|k| ends[*k].1).collect();
    order.sort_unstable_by(|i, j| moduli[*i][0].total_cmp(&moduli[*j][0]));
    let is_reached = |x: &[Complex64; 8], seen: [f64; 2], but: usize| {
        let first = order.partition_point(|k| moduli[*k][0] < seen[0] - ALIKE_MODULI);
        let near = order[first..].iter().take_while(|k| moduli[**k][0] <= seen[0] + ALIKE_MODULI);
        let mut alike = near.filter(|k| **k != but && (moduli[**k][1] - seen[1]).abs() < ALIKE_MODULI);
        alike.any(|k| projective_distance(&ends[*k].0, x) < SAME_END)
    };
    let mut doubtful = Vec::new();
    for (i, p) in paths.iter().enumerate() {
        let x = &ends[i].0;
        let mirrored = x.map(|z| z.conj());
        let doubt = match p.kind {
            EndKind::Failed => true,
            // close to a multiple root Newton's method may take two ends to one root: not for this test to tell
            EndKind::Regular if p.pivot_ratio < NEARLY_SINGULAR => false,
            EndKind::Regular => {
                // moduli of the conjugate are the same
                is_reached(x, moduli[i], i) || (real && !is_reached(&mirrored, moduli[i], usize::MAX))
            }
            // a point where w sheets meet is the end of w paths: with fewer the circle was round several ends
            EndKind::Singular => {
                let together = ends.iter().filter(|(y, _)| projective_distance(y, x) < SAME_MEAN).count();
                together < p.winding as usize
            }
            _ => false,
        };
        if doubt {
            doubtful.push(i);
        }
    }
    doubtful
}

/// `x` over its norm.
pub fn unit(x: &[Complex64; 8]) -> [Complex64; 8] {
    let inverse = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt().recip();
    x.map(|z| z * inverse)
}
