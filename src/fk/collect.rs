//! Turns candidate poses into distinct roots with evidence.
//!
//! Nothing is dropped without a record. The source of a candidate is among the sources of a root, or the candidate is
//! rejected with a reason. A regular candidate that repeats an uncertified root is both, because one path too many has
//! ended there. A candidate that repeats a certified root is rejected only.

use num_complex::Complex64;

use super::newton::refine_to;
use super::{FkRoot, FkTolerances, Reality, Rejected, RejectionReason};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// A pose some method believes to be a solution.
#[derive(Debug, Clone, Copy)]
pub(super) struct PoseCandidate {
    pub(super) pose: ComplexPose,
    /// The method found the equations singular there, so that coinciding candidates count as multiplicity.
    pub(super) singular: bool,
    pub(super) condition: f64,
    /// Index of the path or polynomial root it came from.
    pub(super) source: usize,
}

/// Roots and the fate of the candidates.
#[derive(Debug, Clone)]
pub(super) struct Collected {
    pub(super) roots: Vec<FkRoot>,
    /// Sources of the candidates that ended in each root.
    pub(super) sources: Vec<Vec<usize>>,
    pub(super) rejected: Vec<Rejected>,
    /// A regular candidate coincides with another, or with a certified root: one root was reached twice, so another may
    /// have been missed.
    pub(super) doubtful: bool,
}

/// Singular candidates closer than this, relative to the pose's numbers, are one. They are means of endgame loops, and
/// these means are accepted when they agree to `1e-4`.
const SINGULAR_RADIUS: f64 = 1e-3;

/// A residual below this, relative to the square of the pose's numbers, is rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Poses far out, whose rounding is larger than this times that of a rotation, are refined as far as it goes.
const FAR: f64 = 100.0;

/// A distinct pose with everything that ended in it.
struct PoseGroup {
    candidate: PoseCandidate,
    residual: f64,
    /// See [`pose_scale`].
    scale: f64,
    sources: Vec<usize>,
}

/// Refines the regular candidates, takes singular ones as they are, merges and sorts.
///
/// A candidate is accepted when its residual is at most the tolerance (its square root for singular ones) times the
/// square of the pose's scale. Rounding grows with that square. Two regular or two singular candidates are merged when
/// their distance is below the tolerance (or [`SINGULAR_RADIUS`]) times the scale.
pub(super) fn collect(
    m: &Manipulator,
    s: &SquaredLegLengths,
    tolerances: &FkTolerances,
    candidates: &[PoseCandidate],
) -> Collected {
    collect_with(m, s, tolerances, candidates, Vec::new())
}

/// A root and the indices of the candidates it stands for.
pub(super) type Sourced = (FkRoot, Vec<usize>);

/// [`collect`] with further roots that are certified and distinct, however close together: they are never merged, and a
/// regular candidate near one repeats it.
pub(super) fn collect_with(
    m: &Manipulator,
    s: &SquaredLegLengths,
    tolerances: &FkTolerances,
    candidates: &[PoseCandidate],
    certified: Vec<Sourced>,
) -> Collected {
    let length = m.size();
    let mut groups: Vec<PoseGroup> = Vec::new();
    let mut rejected = Vec::new();
    let mut doubtful = false;
    for candidate in candidates {
        let mut c = *candidate;
        // rounding in |R b + p - a|^2 grows with the square of the pose's own numbers
        let rounding = pose_scale(&c.pose, length).powi(2);
        let residual = if c.singular {
            c.pose.residual(m, s)
        } else {
            let (pose, residual) = refine_to(m, s, &c.pose, ROUNDING * rounding.min(FAR));
            c.pose = pose;
            residual
        };
        let scale = pose_scale(&c.pose, length);
        let limit = if c.singular { tolerances.residual.sqrt() } else { tolerances.residual };
        if !(residual <= limit * scale * scale) {
            rejected.push(Rejected { reason: RejectionReason::ResidualTooLarge, residual });
            continue;
        }
        let radius = if c.singular { SINGULAR_RADIUS } else { tolerances.distinct };
        let same = groups.iter_mut().find(|g| {
            g.candidate.singular == c.singular
                && g.candidate.pose.is_within(&c.pose, length, radius * g.scale)
        });
        let proved = certified
            .iter()
            .any(|(r, _)| r.pose.is_within(&c.pose, length, radius * pose_scale(&r.pose, length)));
        match same {
            None if proved && !c.singular => {
                doubtful = true;
                rejected.push(Rejected { reason: RejectionReason::Duplicate, residual });
            }
            Some(g) => {
                doubtful |= !c.singular;
                if !c.singular {
                    rejected.push(Rejected { reason: RejectionReason::Duplicate, residual });
                }
                g.sources.push(c.source);
            }
            None => groups.push(PoseGroup { candidate: c, residual, scale, sources: vec![c.source] }),
        }
    }
    let plain = groups.into_iter();
    let mut order: Vec<Sourced> = plain
        .map(|PoseGroup { candidate: c, residual, sources, .. }| {
            let reality = reality_of(&c, length, tolerances);
            let multiplicity = if c.singular { sources.len() as u32 } else { 1 };
            let root = FkRoot {
                pose: c.pose,
                reality,
                certificate: None,
                multiplicity,
                residual,
                condition: c.condition,
                dual_quaternion: None,
            };
            (root, sources)
        })
        .chain(certified)
        .collect();
    order.sort_by_cached_key(|(root, _)| sort_key(root.reality, &root.pose, length));
    let (roots, sources) = order.into_iter().unzip();
    Collected { roots, sources, rejected, doubtful }
}

/// The largest of 1 and the moduli of `R` and of `p` over the size.
pub(super) fn pose_scale(p: &ComplexPose, length: f64) -> f64 {
    let r = p.rotation.iter().map(Complex64::norm_sqr).fold(1.0, f64::max);
    p.position.iter().map(|z| z.norm_sqr() / (length * length)).fold(r, f64::max).sqrt()
}

/// Condition numbers above this say no more about the digits of an imaginary part.
const WORST_CONDITION: f64 = 1e6;
/// Imaginary parts this many times larger than their blur are no rounding.
const NON_REAL: f64 = 1e3;

/// Whether a pose without a certificate is real. Imaginary parts of regular poses are blurred by the tolerance times
/// the root of the condition number. At singular poses they are blurred by [`SINGULAR_RADIUS`], and nothing shows that
/// such a pose is real.
fn reality_of(c: &PoseCandidate, length: f64, tolerances: &FkTolerances) -> Reality {
    let blur = if c.singular {
        SINGULAR_RADIUS
    } else {
        tolerances.reality * c.condition.clamp(1.0, WORST_CONDITION).sqrt()
    };
    let imaginary = c.pose.imaginary_size(length) / pose_scale(&c.pose, length);
    if imaginary <= blur {
        if c.singular { Reality::Undecided } else { Reality::Real }
    } else if imaginary > NON_REAL * blur {
        Reality::NonReal
    } else {
        Reality::Undecided
    }
}

/// Numbers compared one after the other, mapped to integers of the same order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct SortKey([i64; 8]);

/// Order of [`f64::total_cmp`] as that of integers.
fn ordered(x: f64) -> i64 {
    let bits = x.to_bits().cast_signed();
    bits ^ ((bits >> 63).cast_unsigned() >> 1).cast_signed()
}

/// Real roots come first, then undecided, then non-real ones. Within these the real parts of `z`, `x`, `y` decide, then
/// those of the first two entries of the first column of `R`. The imaginary parts of `z` and `x` come last. Numbers are
/// rounded to `1e-6`, so that rounding errors reorder only where they cross a step of that grid.
pub(super) fn sort_key(reality: Reality, pose: &ComplexPose, length: f64) -> SortKey {
    let rank = match reality {
        Reality::Real => 0.0,
        Reality::Undecided => 1.0,
        Reality::NonReal => 2.0,
    };
    let grid = |x: f64| (x * 1e6).round() + 0.0;
    let p = pose.position.map(|z| z / length);
    let r = &pose.rotation;
    let numbers = [
        rank,
        grid(p.z.re),
        grid(p.x.re),
        grid(p.y.re),
        grid(r[(0, 0)].re),
        grid(r[(1, 0)].re),
        grid(p.z.im),
        grid(p.x.im),
    ];
    SortKey(numbers.map(ordered))
}
