//! All paths of one problem: tracked, ended, classified, repaired.

use num_complex::Complex64;
use pulp::Scalar;

use super::endgame::{end_path, projective_distance};
use super::lanes::{Lanes, Vec8, norm_sqr};
use super::lu::Lu;
use super::sprint::{Pace, Sprint};
use super::start::{StartError, shipped};
use super::system::{SectionHomotopy, derivative_matrix, values};
use super::tracker::{TrackerSettings, track_one};
use crate::num::Rng;
use crate::solve::sections::Sections;

/// A last Newton correction below this needs no further polishing.
const SETTLED: f64 = 1e-13;
/// Paths to be tracked again are stopped here and always go through the endgame.
const CAREFUL_ENDGAME_AT: f64 = 1e-2;
/// A point with `|e.e| / |e|^2` below this at a converged end has no rotation.
const ISOTROPIC: f64 = 1e-9;
/// The same for an end known only as the mean of an endgame loop, whose square root counts.
const ISOTROPIC_MEAN: f64 = 1e-4;
/// Two regular ends closer than this are one root reached twice.
const SAME_END: f64 = 1e-7;

/// Where a path ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EndKind {
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
pub(crate) struct Path {
    pub(crate) x: [Complex64; 8],
    pub(crate) kind: EndKind,
    pub(crate) steps: u32,
    pub(crate) rejections: u32,
    pub(crate) winding: u32,
    pub(crate) retracked: u32,
    /// Smallest over largest pivot modulus of the Newton matrix at the end.
    pub(crate) pivot_ratio: f64,
}

/// Newton's method at the target.
struct Polished {
    x: [Complex64; 8],
    converged: bool,
    pivot_ratio: f64,
}

fn polish(homotopy: &SectionHomotopy, x: &[Complex64; 8]) -> Polished {
    let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
    let simd = Scalar::new();
    let mut y: Vec8<Scalar> = x.map(|z| Lanes::splat(simd, z / norm));
    let patch = y.map(Lanes::conj);
    let rows = homotopy.rows_at(Lanes::zero(simd));
    let mut last = f64::INFINITY;
    let mut pivot_ratio = 0.0;
    for _ in 0..8 {
        let j = derivative_matrix(&rows, &y, &patch);
        let f = values(&j, &y);
        let lu = Lu::factorise(j);
        pivot_ratio = lu.pivot_ratio()[0];
        let delta = lu.solve(f);
        let size = norm_sqr(&delta).sqrt();
        if !(size < 0.1 * last) {
            // no longer contracting: at rounding level that is the end of it, above it is failure
            let x = y.map(|z| z.lane(0));
            return Polished { x, converged: last < 1e-8 && size < 1e-8, pivot_ratio };
        }
        for p in 0..8 {
            y[p] -= delta[p];
        }
        last = size;
        if size < 1e-15 {
            break;
        }
    }
    Polished { x: y.map(|z| z.lane(0)), converged: last < 1e-8, pivot_ratio }
}

fn isotropy(x: &[Complex64; 8]) -> (f64, f64) {
    let e = &x[..4];
    let size: f64 = e.iter().map(num_complex::Complex::norm_sqr).sum();
    let all: f64 = x.iter().map(num_complex::Complex::norm_sqr).sum();
    let n: Complex64 = e.iter().map(|z| z * z).sum();
    (n.norm() / size, (size / all).sqrt())
}

/// Tracks all generic paths to `target`. The seed sets gamma.
///
/// Ends that look alike although regular, and paths without an end, are tracked again with smaller steps;
/// what fails then is left as [`EndKind::Failed`].
pub(crate) fn solve_sections(target: &Sections, seed: u64) -> Result<Vec<Path>, StartError> {
    let start = shipped()?;
    let mut rng = Rng::stream(seed, 0);
    let corner = Complex64::new(0.5, 0.0) + Complex64::from_polar(0.25, rng.uniform(0.6, 2.5));
    let real = SectionHomotopy::real(&start.sections, target).ok_or(StartError::NotReal)?;
    let sprint = Sprint { homotopy: &real, starts: &start.solutions, corner, pace: Pace::DEFAULT };
    let sprinted = sprint.run();
    // the second leg, from the corner to the target, as a homotopy of its own
    let homotopy = SectionHomotopy::through(&real, corner);
    let mut paths: Vec<Path> = sprinted
        .iter()
        .map(|p| {
            let blank = Path {
                x: p.x,
                kind: EndKind::Failed,
                steps: p.steps,
                rejections: p.rejections,
                winding: 0,
                retracked: 0,
                pivot_ratio: 1.0 / p.condition,
            };
            match p.remaining {
                None => blank,
                Some(t) if t > 0.0 => settle_by_endgame(&homotopy, blank, t.into()),
                Some(_) if p.correction < SETTLED => settle(blank, &p.x),
                Some(_) => settle_arrived(&homotopy, blank),
            }
        })
        .collect();
    for again in suspects(&paths, target) {
        let first = SectionHomotopy::through(&real, Complex64::ONE);
        let settings = &TrackerSettings::CAREFUL;
        if let Some(x) = track_one(&first, &start.solutions[again], Complex64::ONE, corner, settings) {
            paths[again] = retrack(&homotopy, &x, &paths[again]);
        }
    }
    Ok(paths)
}

fn settle_arrived(homotopy: &SectionHomotopy, mut path: Path) -> Path {
    let end = polish(homotopy, &path.x);
    path.pivot_ratio = end.pivot_ratio;
    if end.converged { settle(path, &end.x) } else { path }
}

/// A path whose end point Newton's method has settled.
fn settle(mut path: Path, x: &[Complex64; 8]) -> Path {
    let (iso, finite) = isotropy(x);
    path.x = *x;
    path.winding = 1;
    path.kind = if finite < ISOTROPIC {
        EndKind::Infinite
    } else if iso < ISOTROPIC {
        EndKind::Isotropic
    } else {
        EndKind::Regular
    };
    path
}

fn settle_by_endgame(homotopy: &SectionHomotopy, mut path: Path, t: Complex64) -> Path {
    if t.im != 0.0 || !(t.re > 0.0) {
        return path;
    }
    let Some(end) = end_path(homotopy, &path.x, t.re) else { return path };
    path.x = end.x;
    path.winding = end.winding;
    let (iso, finite) = isotropy(&end.x);
    let blur = end.accuracy.max(1e-12).sqrt().max(ISOTROPIC_MEAN);
    if finite < blur {
        path.kind = EndKind::Infinite;
    } else if iso < blur {
        path.kind = EndKind::Isotropic;
    } else if end.regular {
        path = settle_arrived(homotopy, path);
    } else {
        path.kind = EndKind::Singular;
        path.pivot_ratio = polish(homotopy, &path.x).pivot_ratio;
    }
    path
}

fn retrack(homotopy: &SectionHomotopy, start: &[Complex64; 8], before: &Path) -> Path {
    let goal = Complex64::from(CAREFUL_ENDGAME_AT);
    let mut path = Path { kind: EndKind::Failed, retracked: before.retracked + 1, ..*before };
    if let Some(x) = track_one(homotopy, start, Complex64::ONE, goal, &TrackerSettings::CAREFUL) {
        path.x = x;
        path = settle_by_endgame(homotopy, path, goal);
    }
    path
}

/// Indices of paths whose end is missing, coincides with that of another regular path, or lacks its
/// complex conjugate although the target is real.
pub(crate) fn suspects(paths: &[Path], target: &Sections) -> Vec<usize> {
    let real = target.rows.iter().flatten().all(|z| z.im == 0.0);
    let ends: Vec<([Complex64; 8], bool)> =
        paths.iter().map(|p| (unit(&p.x), p.kind == EndKind::Regular)).collect();
    let same = |x: &[Complex64; 8], y: &[Complex64; 8]| {
        nearly_parallel(x, y) && projective_distance(x, y) < SAME_END
    };
    let mut doubtful = Vec::new();
    for (i, p) in paths.iter().enumerate() {
        let x = &ends[i].0;
        let mirrored = x.map(|z| z.conj());
        let doubt = match p.kind {
            EndKind::Failed => true,
            EndKind::Regular => {
                let jumped =
                    ends.iter().enumerate().any(|(k, (y, regular))| *regular && k != i && same(y, x));
                jumped || (real && !ends.iter().any(|(y, regular)| *regular && same(y, &mirrored)))
            }
            _ => false,
        };
        if doubt {
            doubtful.push(i);
        }
    }
    doubtful
}

/// A quick look before the accurate distance: the cosine of the angle is above 0.999.
fn nearly_parallel(x: &[Complex64; 8], y: &[Complex64; 8]) -> bool {
    let overlap: Complex64 = x.iter().zip(y).map(|(a, b)| a.conj() * b).sum();
    overlap.norm_sqr() > 0.998
}

fn unit(x: &[Complex64; 8]) -> [Complex64; 8] {
    let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
    x.map(|z| z / norm)
}
