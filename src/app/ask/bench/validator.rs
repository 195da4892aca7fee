//! Validates a claimed set of roots by refinement in double-double, by symmetry, and by roots from other starts.

use num_complex::Complex64;

use fk::Reality;
use num::ball::Disc;
use num::double_double::ComplexDoubleDouble;
use platform::geom::ComplexPose;

use super::generator::Problem;
use super::newton::{NewtonEnd, Point, ValidationEquations};
use super::symmetry::PlanarReflections;

/// Largest residual of a root, relative to the square of the pose's own numbers.
const RESIDUAL: f64 = 1e-9;
/// A claim that Newton's method moves farther than this, relative to the pose's own numbers, is no root.
const MOVED: f64 = 1e-6;
/// The accuracy to which singular roots are known.
const SINGULAR_RADIUS: f64 = 1e-3;
/// Two refined roots closer than this count as one.
const SAME: f64 = 1e-14;
/// Relative distances from a multiple root at which the steps of Newton's method are checked; the next root is farther
/// away.
const BESIDE: [f64; 3] = [1e-5, 1e-9, 1e-13];
/// The accuracy claimed by a certificate without an enclosure: half of the digits of a double.
const CLAIMED: f64 = 4e-8;

/// The claims about one root.
#[derive(Debug, Clone, PartialEq)]
pub struct Claim {
    /// The pose.
    pub pose: ComplexPose,
    /// The pose as a dual quaternion, see [`FkRoot::dual_quaternion`](fk::FkRoot::dual_quaternion).
    pub dual_quaternion: Option<[Complex64; 8]>,
    /// Whether existence is claimed to be proved.
    pub certified: bool,
    /// Discs claimed to contain `R` (row by row) and `p` (design units) of the root.
    pub enclosure: Option<Vec<Disc>>,
    /// Claimed reality.
    pub reality: Reality,
    /// Claimed multiplicity.
    pub multiplicity: u32,
}

/// The result of a validation.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Validation {
    /// Number of distinct correct roots.
    pub distinct: usize,
    /// Number of correct roots; singular ones count with their claimed multiplicity.
    pub counted: usize,
    /// Number of real correct roots.
    pub real: usize,
    /// Number of claims that are no root or repeat one.
    pub spurious: usize,
    /// Number of true roots that are not among the claims.
    pub missed: usize,
    /// Number of certificates with a wrong place or a wrong reality of the root.
    pub false_certificates: usize,
    /// Largest residual of the claims as given, in double-double, relative to the square of the pose's own numbers.
    pub worst_residual: f64,
}

/// A correct claim.
struct Root {
    point: Point,
    /// A pose within this distance counts as this root.
    radius: f64,
    /// A claim within this distance repeats the root. It is smaller for discs that hold a multiple root, since another
    /// root may be close.
    own: f64,
}

/// Validates `claims` for `problem`. `others` are probable roots: the generating pose, and roots from another start.
/// Each of them that refines to a regular root must be among the claims. So must conjugates and, for two planar bodies,
/// mirror images.
#[must_use]
pub fn validate(problem: &Problem, claims: &[Claim], others: &[ComplexPose]) -> Validation {
    let equations = ValidationEquations::new(&problem.manipulator, &problem.squares);
    let mut verdict = Validation::default();
    let mut roots: Vec<Root> = Vec::new();
    for claim in claims {
        let start = equations.point(&claim.pose);
        let refined = equations.refine_from(&start, claim.dual_quaternion.as_ref());
        verdict.worst_residual = verdict.worst_residual.max(refined.residual);
        let multiple = claim.multiplicity > 1 && is_multiple(&equations, claim, &start);
        // from close to a double root even halving steps look like convergence
        let regular = !multiple
            && (is_regular(&start, &refined) || encloses(claim, &start, &refined, equations.unit()));
        let as_claimed =
            multiple || regular && claim.multiplicity < 2 && is_as_claimed(claim, &refined, equations.unit());
        if claim.certified && !as_claimed {
            verdict.false_certificates += 1;
        }
        // a double root is accurate to about the square root of rounding, still with a small residual
        let singular = !regular && refined.residual <= RESIDUAL && claim.multiplicity > 1;
        let root = if singular {
            let radius = SINGULAR_RADIUS * start.scale();
            let own = if multiple { held_within(claim, equations.unit()).min(radius) } else { radius };
            Root { point: start, radius, own }
        } else {
            Root { point: refined.point, radius: radius(&refined), own: radius(&refined) }
        };
        let proper = if singular { root.point.is_rotation() } else { refined.proper };
        let wrong = !(regular && refined.residual <= RESIDUAL || singular) || !proper;
        if wrong || repeats(&roots, &root.point) {
            verdict.spurious += 1;
            continue;
        }
        verdict.counted += if singular { claim.multiplicity as usize } else { 1 };
        verdict.real += usize::from(root.point.imaginary() <= 1e-18 * root.point.scale());
        roots.push(root);
    }
    verdict.distinct = roots.len();
    verdict.missed = missed(problem, &equations, &roots, claims, others);
    verdict
}

/// Whether the iteration converged near its start.
fn is_regular(start: &Point, refined: &NewtonEnd) -> bool {
    refined.converged && start.distance(&refined.point) <= MOVED * start.scale()
}

/// Steps of Newton's method from near a root of multiplicity `m` shrink by `(m - 1) / m` once the regular directions
/// have converged. The claimed discs hold the pose.
fn is_multiple(equations: &ValidationEquations, claim: &Claim, start: &Point) -> bool {
    let expected = 1.0 - 1.0 / f64::from(claim.multiplicity);
    let shrink_so = |distance: f64| {
        let steps = equations.steps_from_beside(start, distance);
        let ratios: Vec<f64> = steps.windows(2).skip(3).map(|pair| pair[1] / pair[0]).collect();
        ratios.len() >= 4 && ratios.iter().all(|r| (r - expected).abs() < 0.05)
    };
    let slow = BESIDE.into_iter().any(shrink_so);
    let held =
        claim.enclosure.as_deref().is_some_and(|discs| in_discs(discs, start, 1e-28, equations.unit()));
    slow && held
}

/// Whether the claimed discs hold both the claim and the root of the iteration. For distant roots, with discs wider
/// than [`MOVED`], this is the better rule.
fn encloses(claim: &Claim, start: &Point, refined: &NewtonEnd, unit: f64) -> bool {
    let discs = claim.enclosure.as_deref().filter(|_| claim.certified && refined.converged);
    discs.is_some_and(|discs| {
        let slack = 1e-28 + 10.0 * refined.error;
        in_discs(discs, start, slack, unit) && in_discs(discs, &refined.point, slack, unit)
    })
}

/// Whether all twelve entries lie in their discs, up to `slack` times the point's own scale.
fn in_discs(discs: &[Disc], x: &Point, slack: f64, unit: f64) -> bool {
    let scale = x.scale();
    let holds = |(k, disc): (usize, &Disc)| {
        let length = if k < 9 { 1.0 } else { unit };
        let gap = x.0[k] - ComplexDoubleDouble::from(disc.centre / length); // exact: a power of two
        gap.hi().norm() <= disc.radius / length + slack * scale
    };
    discs.len() == 12 && discs.iter().enumerate().all(holds)
}

fn radius(refined: &NewtonEnd) -> f64 {
    (SAME + 100.0 * refined.error) * refined.point.scale()
}

/// The diameter of the widest of the claimed discs.
fn held_within(claim: &Claim, unit: f64) -> f64 {
    let discs = claim.enclosure.as_deref().unwrap_or_default();
    let width = |(k, disc): (usize, &Disc)| 2.0 * disc.radius / if k < 9 { 1.0 } else { unit };
    discs.iter().enumerate().map(width).fold(0.0, f64::max)
}

fn repeats(roots: &[Root], x: &Point) -> bool {
    roots.iter().any(|r| r.point.distance(x) <= r.own)
}

fn holds(roots: &[Root], x: &Point) -> bool {
    roots.iter().any(|r| r.point.distance(x) <= r.radius)
}

/// Whether the refined root lies in the claimed discs and has the claimed reality.
fn is_as_claimed(claim: &Claim, refined: &NewtonEnd, unit: f64) -> bool {
    let x = &refined.point;
    let scale = x.scale();
    let in_place = if let Some(discs) = &claim.enclosure {
        in_discs(discs, x, 1e-28 + 10.0 * refined.error, unit)
    } else {
        let pose = &claim.pose;
        let entry =
            |k: usize| if k < 9 { pose.rotation[(k / 3, k % 3)] } else { pose.position[k - 9] / unit };
        (0..12).all(|k| (x.0[k].hi() - entry(k)).norm() <= CLAIMED * scale)
    };
    let imaginary = x.imaginary() / scale;
    let real = match claim.reality {
        Reality::Real => imaginary <= 1e-18 + 100.0 * refined.error,
        Reality::NonReal => imaginary > 1e-26,
        Reality::Undecided => true,
    };
    in_place && real
}

/// Counts the regular roots known by symmetry or from other starts that no claim accounts for.
fn missed(
    problem: &Problem,
    equations: &ValidationEquations,
    roots: &[Root],
    claims: &[Claim],
    others: &[ComplexPose],
) -> usize {
    let mut absent: Vec<Root> = Vec::new();
    let mut consider = |refined: NewtonEnd, near: bool| {
        let known = holds(roots, &refined.point) || holds(&absent, &refined.point);
        if near && refined.converged && refined.proper && !known {
            let (point, radius) = (refined.point, radius(&refined));
            absent.push(Root { point, radius, own: radius });
            let conjugate = point.conjugate();
            if !holds(roots, &conjugate) && !holds(&absent, &conjugate) {
                absent.push(Root { point: conjugate, radius, own: radius });
            }
        }
    };
    for root in roots {
        let conjugate = root.point.conjugate();
        if !holds(roots, &conjugate) {
            consider(equations.refine(&conjugate), true);
        }
    }
    let mirror = PlanarReflections::of(&problem.manipulator);
    let images = claims.iter().filter_map(|c| mirror.map(|m| m.image(&c.pose)));
    for pose in images.chain(others.iter().copied()) {
        let start = equations.point(&pose);
        if equations.residual(&start) <= RESIDUAL && !holds_nearly(roots, &start) {
            let refined = equations.refine(&start);
            consider(refined, is_regular(&start, &refined));
        }
    }
    absent.len()
}

/// Whether the point is so close to a known, isolated root that it needs no refinement.
fn holds_nearly(roots: &[Root], x: &Point) -> bool {
    let near = |limit: f64| roots.iter().filter(|r| r.point.distance(x) <= limit * x.scale()).count();
    near(1e-9) == 1 && near(1e-5) == 1
}
