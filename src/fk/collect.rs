//! From candidate poses to distinct roots with evidence: nothing is dropped without a record.

use num_complex::Complex64;

use super::newton::refine_to;
use super::{FkRoot, FkTolerances, Reality, Rejected, RejectionReason};
use crate::geom::ComplexPose;
use crate::manipulator::{Manipulator, SquaredLegLengths};

/// A pose some method believes to be a solution.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) pose: ComplexPose,
    /// The method found the equations singular there, so that coinciding candidates count as multiplicity.
    pub(super) singular: bool,
    pub(super) condition: f64,
    /// Index of the path or polynomial root it came from.
    pub(super) source: usize,
}

/// Roots and what became of the candidates.
#[derive(Debug, Clone)]
pub(super) struct Collected {
    pub(super) roots: Vec<FkRoot>,
    /// Candidate sources of every root.
    pub(super) sources: Vec<Vec<usize>>,
    pub(super) rejected: Vec<Rejected>,
    /// Two regular candidates coincide: one root was reached twice, so another may have been missed.
    pub(super) doubtful: bool,
}

/// Singular candidates are known to about the square root of rounding only.
const SINGULAR_RADIUS: f64 = 1e-3;

/// A residual below this, relative to the square of the pose's numbers, is rounding.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Poses far out, whose rounding is larger than this times that of a rotation, are refined as far as it goes.
const FAR: f64 = 100.0;

/// A distinct pose with everything that ended in it.
struct Group {
    candidate: Candidate,
    residual: f64,
    /// See [`pose_scale`].
    scale: f64,
    sources: Vec<usize>,
}

/// Refines, merges and sorts candidates.
pub(super) fn collect(
    m: &Manipulator,
    s: &SquaredLegLengths,
    tolerances: &FkTolerances,
    candidates: &[Candidate],
) -> Collected {
    collect_with(m, s, tolerances, candidates, Vec::new())
}

/// A root and the indices of the candidates it stands for.
pub(super) type Sourced = (FkRoot, Vec<usize>);

/// [`collect`] with further roots that are certified and distinct, however close together.
pub(super) fn collect_with(
    m: &Manipulator,
    s: &SquaredLegLengths,
    tolerances: &FkTolerances,
    candidates: &[Candidate],
    certified: Vec<Sourced>,
) -> Collected {
    let length = m.size();
    let mut groups: Vec<Group> = Vec::new();
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
            None => groups.push(Group { candidate: c, residual, scale, sources: vec![c.source] }),
        }
    }
    let plain = groups.into_iter();
    let mut order: Vec<Sourced> = plain
        .map(|Group { candidate: c, residual, sources, .. }| {
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
    order.sort_by_cached_key(|root| sort_key(&root.0, length));
    let (roots, sources) = order.into_iter().unzip();
    Collected { roots, sources, rejected, doubtful }
}

/// The largest of 1 and the moduli of `R` and of `p` over the size.
pub(super) fn pose_scale(p: &ComplexPose, length: f64) -> f64 {
    let r = p.rotation.iter().map(Complex64::norm_sqr).fold(1.0, f64::max);
    p.position.iter().map(|z| z.norm_sqr() / (length * length)).fold(r, f64::max).sqrt()
}

fn reality_of(c: &Candidate, length: f64, tolerances: &FkTolerances) -> Reality {
    let blur =
        if c.singular { SINGULAR_RADIUS } else { tolerances.reality * c.condition.clamp(1.0, 1e6).sqrt() };
    let imaginary = c.pose.imaginary_size(length) / pose_scale(&c.pose, length);
    if imaginary <= blur {
        if c.singular { Reality::Undecided } else { Reality::Real }
    } else if imaginary > 1e3 * blur {
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

/// Real roots first, then by position and rotation, rounded so that rounding errors do not reorder.
pub(super) fn sort_key(root: &FkRoot, length: f64) -> SortKey {
    let rank = match root.reality {
        Reality::Real => 0.0,
        Reality::Undecided => 1.0,
        Reality::NonReal => 2.0,
    };
    let grid = |x: f64| (x * 1e6).round() + 0.0;
    let p = root.pose.position.map(|z| z / length);
    let r = &root.pose.rotation;
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
