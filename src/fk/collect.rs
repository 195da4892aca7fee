//! From candidate poses to distinct roots with evidence: nothing is dropped without a record.

use nalgebra::{SMatrix, SVector};
use num_complex::Complex64;

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

/// Refines, merges and sorts candidates.
pub(super) fn collect(
    m: &Manipulator,
    s: &SquaredLegLengths,
    tolerances: &FkTolerances,
    candidates: &[Candidate],
) -> Collected {
    let length = m.size();
    let mut groups: Vec<(Candidate, f64, Vec<usize>)> = Vec::new();
    let mut rejected = Vec::new();
    let mut doubtful = false;
    for candidate in candidates {
        let mut c = *candidate;
        if !c.singular {
            c.pose = refine(m, s, &c.pose);
        }
        let residual = c.pose.residual(m, s);
        // rounding in |R b + p - a|^2 grows with the square of the pose's own numbers
        let rounding = pose_scale(&c.pose, length).powi(2);
        let limit = if c.singular { tolerances.residual.sqrt() } else { tolerances.residual } * rounding;
        if !(residual <= limit) {
            rejected.push(Rejected { reason: RejectionReason::ResidualTooLarge, residual });
            continue;
        }
        let radius = if c.singular { SINGULAR_RADIUS } else { tolerances.distinct };
        let spread = |p: &ComplexPose| pose_scale(p, length);
        let same = groups.iter_mut().find(|(g, _, _)| {
            g.singular == c.singular && g.pose.distance(&c.pose, length) < radius * spread(&g.pose)
        });
        match same {
            Some((_, _, sources)) => {
                doubtful |= !c.singular;
                if !c.singular {
                    rejected.push(Rejected { reason: RejectionReason::Duplicate, residual });
                }
                sources.push(c.source);
            }
            None => groups.push((c, residual, vec![c.source])),
        }
    }
    let mut order: Vec<(FkRoot, Vec<usize>)> = groups
        .into_iter()
        .map(|(c, residual, sources)| {
            let reality = reality_of(&c, length, tolerances);
            let multiplicity = if c.singular { sources.len() as u32 } else { 1 };
            let root = FkRoot {
                pose: c.pose,
                reality,
                certified: false,
                multiplicity,
                residual,
                condition: c.condition,
            };
            (root, sources)
        })
        .collect();
    order.sort_by(|a, b| sort_key(&a.0, length).total_cmp_with(&sort_key(&b.0, length)));
    let (roots, sources) = order.into_iter().unzip();
    Collected { roots, sources, rejected, doubtful }
}

fn pose_scale(p: &ComplexPose, length: f64) -> f64 {
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

struct SortKey([f64; 8]);

impl SortKey {
    fn total_cmp_with(&self, other: &Self) -> std::cmp::Ordering {
        let pairs = self.0.iter().zip(&other.0);
        pairs.map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne()).unwrap_or(std::cmp::Ordering::Equal)
    }
}

/// Real roots first, then by position and rotation, rounded so that rounding errors do not reorder.
fn sort_key(root: &FkRoot, length: f64) -> SortKey {
    let rank = match root.reality {
        Reality::Real => 0.0,
        Reality::Undecided => 1.0,
        Reality::NonReal => 2.0,
    };
    let grid = |x: f64| (x * 1e6).round() + 0.0;
    let p = root.pose.position.map(|z| z / length);
    let r = &root.pose.rotation;
    SortKey([
        rank,
        grid(p.z.re),
        grid(p.x.re),
        grid(p.y.re),
        grid(r[(0, 0)].re),
        grid(r[(1, 0)].re),
        grid(p.z.im),
        grid(p.x.im),
    ])
}

/// Newton's method on the leg equations in the pose itself: `R <- R exp([w]x)`, `p <- p + d`, over `C`.
///
/// Keeps the better of each step's two poses, so it never makes a residual worse.
pub(super) fn refine(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> ComplexPose {
    let mut best = *pose;
    let mut residual = best.residual(m, s);
    for _ in 0..4 {
        let Some(next) = newton_step(m, s, &best) else { break };
        let r = next.residual(m, s);
        if !(r < residual) {
            break;
        }
        best = next;
        residual = r;
    }
    best
}

fn newton_step(m: &Manipulator, s: &SquaredLegLengths, pose: &ComplexPose) -> Option<ComplexPose> {
    let size = m.size();
    let mut jacobian = SMatrix::<Complex64, 6, 6>::zeros();
    let mut defect = SVector::<Complex64, 6>::zeros();
    for (i, (leg, target)) in m.legs().iter().zip(s.get()).enumerate() {
        let lift = |v: nalgebra::Vector3<f64>| v.map(|x| Complex64::new(x, 0.0));
        let arm = pose.rotation * lift(leg.platform.coords);
        let d = arm + pose.position - lift(leg.base.coords);
        let moment = arm.cross(&d);
        for k in 0..3 {
            jacobian[(i, k)] = d[k] * 2.0 / size;
            jacobian[(i, 3 + k)] = moment[k] * 2.0 / (size * size);
        }
        defect[i] = (d.dot(&d) - target) / (size * size);
    }
    let twist = jacobian.lu().solve(&defect)?;
    // Cayley transform of the rotation vector: exactly orthogonal over C
    let w = nalgebra::Vector3::new(twist[3], twist[4], twist[5]) * Complex64::new(-0.5, 0.0);
    let n = Complex64::ONE + w.dot(&w);
    if !(n.norm() > 0.1) {
        return None;
    }
    let (two, one) = (Complex64::new(2.0, 0.0), Complex64::ONE);
    let cross = w.cross_matrix();
    let turn =
        (nalgebra::Matrix3::identity() * (one - w.dot(&w)) + (w * w.transpose()) * two + cross * two) / n;
    let shift = nalgebra::Vector3::new(twist[0], twist[1], twist[2]) * Complex64::new(size, 0.0);
    let rotation = reorthogonalised(&(turn * pose.rotation));
    Some(ComplexPose { rotation, position: pose.position - shift })
}

/// One step of `R <- R (3 I - R^T R) / 2`, which squares the defect of `R^T R = I` (over `C` as well).
fn reorthogonalised(r: &nalgebra::Matrix3<Complex64>) -> nalgebra::Matrix3<Complex64> {
    let gram = r.transpose() * r;
    let three = nalgebra::Matrix3::identity() * Complex64::new(3.0, 0.0);
    r * (three - gram) * Complex64::new(0.5, 0.0)
}
