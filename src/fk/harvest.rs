//! From ends of homotopy paths to certified roots, without a detour over `R` and `p`.

use num_complex::Complex64;

use super::cluster::separate;
use super::collect::{Collected, PoseCandidate, SortKey, Sourced, collect_with, sort_key};
use super::evidence::{KnownCertificates, proved};
use super::homotopy::pose_of;
use super::{FkRoot, FkTolerances, Rejected, RejectionReason};
use crate::solve::certify::{
    CertifiedPose, Certifier, MIRROR, NewtonStart, ProvedReality, RootRelation, overlapping_pairs, relation,
};
use num::octuple::ComplexOctuple;
use platform::geom::ComplexPose;
use platform::manipulator::{Leg, Manipulator, SquaredLegLengths};

/// Regular ends with a larger condition number may belong to a cluster.
const NEARLY_SINGULAR: f64 = 1e4;

/// Ends this near to images of others are examined with these, relative to 1 and to themselves.
const ALIKE: f64 = 1e-7;

/// A root is sought within this distance from the mean of an endgame loop, in parts of the size of the point.
const MEAN: f64 = 1e-3;

/// An end of a path that is, or may be, finite.
#[derive(Debug, Clone, Copy)]
pub(super) struct HarvestEnd {
    /// `(e, g)` in the design's frames.
    pub(super) point: [Complex64; 8],
    pub(super) singular: bool,
    /// Taken for an end at `e.e = 0` or infinity by the endgame.
    pub(super) doubtful: bool,
    /// Two roots at `point` plus and minus this may look like a double one.
    pub(super) split: Option<[Complex64; 8]>,
    pub(super) condition: f64,
    /// Index of the path.
    pub(super) source: usize,
}

/// An end known with 256 bits, in the design's frames.
#[derive(Debug, Clone, Copy)]
pub(super) struct PreciseEnd {
    pub(super) point: [ComplexOctuple; 8],
    pub(super) condition: f64,
    /// Index of the path.
    pub(super) source: usize,
}

/// Roots, and the certificates of those that are certified.
pub(super) struct Harvest {
    pub(super) collected: Collected,
    pub(super) certificates: KnownCertificates,
}

/// A certified root and the paths that ended there; none where it is known as the conjugate of another only.
struct CertifiedRoot {
    root: CertifiedPose,
    condition: f64,
    sources: Vec<usize>,
}

/// Certifies regular ends one by one, conjugates together. Ends without a certificate are refined and merged as the
/// candidates of any other method are. `precise` are ends of other paths.
pub(super) fn harvest(
    m: &Manipulator,
    s: &SquaredLegLengths,
    t: &FkTolerances,
    ends: &[HarvestEnd],
    precise: &[PreciseEnd],
) -> Harvest {
    let is_close = |e: &HarvestEnd| e.singular || !(e.condition < NEARLY_SINGULAR);
    let (mut doubtful, mut close, mut others) = (Vec::new(), Vec::new(), Vec::new());
    let all_plain = !ends.iter().any(|e| e.doubtful || is_close(e));
    if !all_plain {
        for end in ends {
            let list = if end.doubtful {
                &mut doubtful
            } else if is_close(end) {
                &mut close
            } else {
                &mut others
            };
            list.push(*end);
        }
    }
    let clusters = separate(m, s, close.iter().map(candidate).collect());
    let (mut open, plain): (Vec<PoseCandidate>, Vec<PoseCandidate>) =
        clusters.plain.into_iter().partition(|c| c.singular);
    others.extend(close.iter().filter(|e| plain.iter().any(|c| c.source == e.source)));
    let alone = if all_plain { ends } else { &others };
    let mut proofs: Vec<CertifiedRoot> = clusters
        .proved
        .into_iter()
        .map(|(c, certificate)| CertifiedRoot {
            root: CertifiedPose { pose: c.pose, certificate },
            condition: c.condition,
            sources: vec![c.source],
        })
        .collect();
    open.extend(certify_all(m, s, alone, &mut proofs));
    proofs.extend(finite_after_all(m, s, &doubtful));
    open.extend(certify_precise(m, s, precise, &mut proofs));
    let overlapping = overlapping_pairs(proofs.iter().map(|p| p.root.certificate.enclosure()));
    let repeated = drop_repeated(&mut proofs, &overlapping);
    // a conjugate without a path of its own is a root all the same, but the path that should end there went elsewhere
    let lost = proofs.iter().any(|p| p.sources.is_empty());
    let (mut collected, certificates) = if open.is_empty() && overlapping.is_empty() {
        (in_order(m, s, proofs), KnownCertificates::AllApart)
    } else {
        let certificates = proofs.iter().map(|p| p.root.certificate).collect();
        let legs = m.legs();
        let roots: Vec<Sourced> = proofs.into_iter().map(|p| (record(m, &legs, s, &p), p.sources)).collect();
        (collect_with(m, s, t, &open, roots), KnownCertificates::Listed(certificates))
    };
    collected.doubtful |= lost || repeated > 0;
    let duplicate = Rejected { reason: RejectionReason::Duplicate, residual: 0.0 };
    collected.rejected.extend(std::iter::repeat_n(duplicate, repeated));
    Harvest { collected, certificates }
}

fn candidate(end: &HarvestEnd) -> PoseCandidate {
    PoseCandidate {
        pose: pose_of(end.point),
        singular: end.singular,
        condition: end.condition,
        source: end.source,
    }
}

fn record(m: &Manipulator, legs: &[Leg; 6], s: &SquaredLegLengths, p: &CertifiedRoot) -> FkRoot {
    FkRoot {
        pose: p.root.pose,
        reality: proved(p.root.certificate.reality()),
        certificate: Some(p.root.certificate.into()),
        multiplicity: 1,
        residual: p.root.pose.residual_of(legs, m.size(), s),
        condition: p.condition,
        dual_quaternion: Some(p.root.certificate.point()),
    }
}

/// The roots of proofs in the order of [`collect_with`], when there are no other roots. Only their keys are sorted,
/// because a record has a kilobyte.
fn in_order(m: &Manipulator, s: &SquaredLegLengths, mut proofs: Vec<CertifiedRoot>) -> Collected {
    let key = |p: &CertifiedRoot| sort_key(proved(p.root.certificate.reality()), &p.root.pose, m.size());
    let mut order: Vec<(SortKey, usize)> = proofs.iter().enumerate().map(|(k, p)| (key(p), k)).collect();
    order.sort_unstable();
    let legs = m.legs();
    Collected {
        roots: order.iter().map(|(_, k)| record(m, &legs, s, &proofs[*k])).collect(),
        sources: order.iter().map(|(_, k)| std::mem::take(&mut proofs[*k].sources)).collect(),
        rejected: Vec::new(),
        doubtful: false,
    }
}

fn is_zero(x: f64) -> bool {
    x.to_bits() << 1 == 0 // either sign
}

/// Roots that are certified with this one: the conjugate, and with both bodies flat the mirror images of both. Each is
/// made when it is asked for.
fn images(root: &CertifiedPose, flat: bool) -> impl Iterator<Item = CertifiedPose> + use<'_> {
    let pair = root.certificate.reality() == ProvedReality::NonReal;
    let applies = move |(conjugate, mirrored): &(bool, bool)| (!conjugate || pair) && (!mirrored || flat);
    [(true, false), (false, true), (true, true)].into_iter().filter(applies).map(|image| match image {
        (true, false) => root.conjugate(),
        (false, _) => root.mirrored(),
        (true, true) => root.mirrored().conjugate(),
    })
}

/// One of each set of ends that look like images of each other, the first: the others are certified with it.
fn representatives(ends: &[HarvestEnd], flat: bool) -> Vec<usize> {
    let points: Vec<([Complex64; 8], usize)> = ends.iter().map(|e| on_patch(&e.point)).collect();
    let mut taken = vec![false; ends.len()];
    let mut out = Vec::with_capacity(ends.len());
    for (i, (x, patch)) in points.iter().enumerate() {
        if std::mem::replace(&mut taken[i], true) {
            continue;
        }
        out.push(i);
        let sign = |k: usize| if flat { MIRROR[k] * MIRROR[*patch] } else { 1.0 };
        for (j, (y, _)) in points.iter().enumerate().skip(i + 1).filter(|(_, p)| p.1 == *patch) {
            let alike = |image: &dyn Fn(usize) -> Complex64| {
                (0..8).all(|k| (y[k] - image(k)).norm_sqr() <= ALIKE * ALIKE * (1.0 + y[k].norm_sqr()))
            };
            taken[j] |= alike(&|k| x[k].conj())
                || (flat && (alike(&|k| x[k] * sign(k)) || alike(&|k| x[k].conj() * sign(k))));
        }
    }
    out
}

/// The point divided by its largest `e_k`, and `k`.
fn on_patch(x: &[Complex64; 8]) -> ([Complex64; 8], usize) {
    let patch = (1..4).fold(0, |best, k| if x[k].norm_sqr() > x[best].norm_sqr() { k } else { best });
    let inverse = x[patch].inv();
    (x.map(|z| z * inverse), patch)
}

/// Certifies as many ends as possible; returns the rest.
fn certify_all(
    m: &Manipulator,
    s: &SquaredLegLengths,
    ends: &[HarvestEnd],
    proofs: &mut Vec<CertifiedRoot>,
) -> Vec<PoseCandidate> {
    let Ok(certifier) = Certifier::new(m, s) else {
        return ends.iter().map(candidate).collect();
    };
    if ends.is_empty() {
        return Vec::new();
    }
    // exactly, because the certificate is about the joints as they are
    let flat = m.legs().iter().all(|l| is_zero(l.base.z) && is_zero(l.platform.z));
    let mut open = Vec::new();
    let chosen = representatives(ends, flat);
    let points: Vec<&[Complex64; 8]> = chosen.iter().map(|i| &ends[*i].point).collect();
    let found = certifier.roots_near(&points);
    let mut known = chosen.iter().zip(&found).peekable();
    let mut done = vec![false; ends.len()];
    proofs.reserve(ends.len());
    for (i, end) in ends.iter().enumerate() {
        let quick = known.next_if(|(k, _)| **k == i).and_then(|(_, root)| root.as_ref());
        if std::mem::replace(&mut done[i], true) {
            continue;
        }
        let slow;
        let root = if let Some(root) = quick {
            root
        } else if let Ok(root) = certifier.root_near(NewtonStart::Point(&end.point)) {
            slow = root;
            &slow
        } else {
            open.push(candidate(end));
            continue;
        };
        let first = proofs.len();
        proofs.push(CertifiedRoot { root: *root, condition: end.condition, sources: vec![end.source] });
        for image in images(root, flat) {
            // an image of an image may be known already; the root may be an image of itself
            let apart = |p: &CertifiedRoot| {
                relation(&p.root.certificate, &image.certificate) == RootRelation::Distinct
            };
            if !proofs[first..].iter().all(apart) {
                continue;
            }
            let near = |j: &usize| !done[*j] && image.certificate.is_near(&ends[*j].point);
            let partner = (i + 1..ends.len()).find(near);
            let sources = partner.map(|j| {
                done[j] = true;
                ends[j].source
            });
            let sources = sources.into_iter().collect();
            proofs.push(CertifiedRoot { root: image, condition: end.condition, sources });
        }
    }
    open
}

/// Poses so far out, or so close to an end at `e.e = 0`, that the endgame could not tell: a certificate can, it proves
/// `e.e != 0`.
fn finite_after_all(m: &Manipulator, s: &SquaredLegLengths, ends: &[HarvestEnd]) -> Vec<CertifiedRoot> {
    if ends.is_empty() {
        return Vec::new();
    }
    let Ok(certifier) = Certifier::new(m, s) else { return Vec::new() };
    let mut proofs: Vec<CertifiedRoot> = Vec::new();
    for end in ends {
        let starts = match &end.split {
            None => vec![end.point],
            Some(h) => [1.0, -1.0].map(|sign| std::array::from_fn(|k| end.point[k] + h[k] * sign)).to_vec(),
        };
        for start in starts {
            let Ok(root) = certifier.root_near(NewtonStart::DoubtfulPoint(&start, MEAN)) else { continue };
            // the two paths of a pair are free to share it out
            let taken = |p: &CertifiedRoot| {
                relation(&p.root.certificate, &root.certificate) != RootRelation::Distinct
            };
            if end.split.is_none() || !proofs.iter().any(taken) {
                proofs.push(CertifiedRoot { root, condition: end.condition, sources: vec![end.source] });
                break;
            }
        }
    }
    // the loops of conjugates are as hard as each other, rounding decides which is followed far enough
    add_conjugates(&mut proofs, 0);
    proofs
}

/// Roots that are certified because their conjugates are, for proofs from `first` on.
fn add_conjugates(proofs: &mut Vec<CertifiedRoot>, first: usize) {
    for k in first..proofs.len() {
        if proofs[k].root.certificate.reality() == ProvedReality::NonReal {
            let (root, condition) = (proofs[k].root.conjugate(), proofs[k].condition);
            let apart = |p: &CertifiedRoot| {
                relation(&p.root.certificate, &root.certificate) == RootRelation::Distinct
            };
            if proofs.iter().all(apart) {
                proofs.push(CertifiedRoot { root, condition, sources: Vec::new() });
            }
        }
    }
}

/// Certifies as many as possible of the ends known with many digits; returns the rest.
fn certify_precise(
    m: &Manipulator,
    s: &SquaredLegLengths,
    ends: &[PreciseEnd],
    proofs: &mut Vec<CertifiedRoot>,
) -> Vec<PoseCandidate> {
    if ends.is_empty() {
        return Vec::new();
    }
    let first = proofs.len();
    let certifier = Certifier::new(m, s);
    let mut open = Vec::new();
    for end in ends {
        match certifier.as_ref().map(|c| c.root_near(NewtonStart::PrecisePoint(&end.point))) {
            Ok(Ok(root)) => {
                proofs.push(CertifiedRoot { root, condition: end.condition, sources: vec![end.source] });
            }
            _ => open.push(PoseCandidate {
                pose: precise_pose(&end.point),
                singular: true,
                condition: end.condition,
                source: end.source,
            }),
        }
    }
    add_conjugates(proofs, first);
    open
}

/// `R` and `p` of `(e, g)`, rounded.
fn precise_pose(x: &[ComplexOctuple; 8]) -> ComplexPose {
    let n = (0..4).fold(ComplexOctuple::ZERO, |sum, k| sum + x[k] * x[k]).recip();
    let [w, x1, x2, x3, g0, g1, g2, g3] = *x;
    let two = |a: ComplexOctuple| (a.scaled(1) * n).rounded();
    let diagonal = |a, b, c| ((w * w + a * a - b * b - c * c) * n).rounded();
    let rotation = nalgebra::Matrix3::new(
        diagonal(x1, x2, x3),
        two(x1 * x2 - w * x3),
        two(x1 * x3 + w * x2),
        two(x1 * x2 + w * x3),
        diagonal(x2, x1, x3),
        two(x2 * x3 - w * x1),
        two(x1 * x3 - w * x2),
        two(x2 * x3 + w * x1),
        diagonal(x3, x1, x2),
    );
    let position = nalgebra::Vector3::new(
        ((w * g1 - g0 * x1 + x2 * g3 - x3 * g2) * n).rounded(),
        ((w * g2 - g0 * x2 + x3 * g1 - x1 * g3) * n).rounded(),
        ((w * g3 - g0 * x3 + x1 * g2 - x2 * g1) * n).rounded(),
    );
    ComplexPose { rotation, position }
}

/// Merges proofs of one root, among those that overlap; their number. A conjugate that has a path after all is no
/// repetition.
fn drop_repeated(proofs: &mut Vec<CertifiedRoot>, overlapping: &[(usize, usize)]) -> usize {
    let certificate = |k: usize| &proofs[k].root.certificate;
    if overlapping.iter().all(|(i, j)| relation(certificate(*i), certificate(*j)) != RootRelation::Same) {
        return 0;
    }
    let mut kept: Vec<CertifiedRoot> = Vec::with_capacity(proofs.len());
    let mut repeated = 0;
    for proof in proofs.drain(..) {
        let same =
            |k: &CertifiedRoot| relation(&k.root.certificate, &proof.root.certificate) == RootRelation::Same;
        match kept.iter_mut().find(|k| same(k)) {
            Some(known) => {
                repeated += usize::from(!known.sources.is_empty() && !proof.sources.is_empty());
                known.sources.extend(proof.sources);
            }
            None => kept.push(proof),
        }
    }
    *proofs = kept;
    repeated
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FkOptions, ForwardKinematics, Homotopy};
    use nalgebra::{Point3, Rotation3, Vector3};
    use num::Rng;
    use platform::geom::Pose;

    /// Certificates taken over from mirror images and conjugates are those that their own poses get.
    #[test]
    fn images_of_certified_poses_are_certified_poses() {
        let mut rng = Rng::new(91);
        for height in [0.0, 1e-3] {
            let mut point = |z: f64| Point3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), z);
            let legs = std::array::from_fn(|i| Leg {
                base: point(if i == 2 { height } else { 0.0 }),
                platform: point(0.0),
            });
            let m = Manipulator::from_legs(legs).unwrap();
            let rotation = Rotation3::from_euler_angles(0.3, -0.5, 0.2);
            let pose = Pose { rotation, position: Vector3::new(0.3, 0.2, 1.7) };
            let s = pose.squared_lengths(&m).unwrap();
            let certifier = Certifier::new(&m, &s).unwrap();
            let found = Homotopy.solve(&m, &s, &FkOptions::default()).unwrap();
            assert_eq!(found.roots.iter().filter(|r| r.certified()).count(), 40);
            for root in &found.roots {
                let own = certifier.certify(&root.pose);
                let proof = certifier.root_near(NewtonStart::Point(&root.dual_quaternion.unwrap())).unwrap();
                assert_eq!(relation(own.certificate().unwrap(), &proof.certificate), RootRelation::Same);
                for image in images(&proof, true) {
                    let own = certifier.certify(&image.pose);
                    // the mirror is none of a platform with one joint off the plane
                    let conjugate = image.pose.distance(&proof.conjugate().pose, 1.0) < 1e-12;
                    assert_eq!(own.certificate().is_some(), height.abs() < 1e-9 || conjugate);
                    if let Some(own) = own.certificate() {
                        assert_eq!(relation(own, &image.certificate), RootRelation::Same);
                    }
                }
            }
        }
    }
}
