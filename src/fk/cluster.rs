//! Close ends of homotopy paths: two roots, one multiple root, or one root reached twice.

use num_complex::Complex64;

use super::collect::PoseCandidate;
use super::newton::beside;
use crate::solve::certify::{Certificate, Certifier, RootRelation, relation};
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// Ends as singular as this may belong to a cluster.
const SINGULAR: f64 = 1e4;
/// Ends closer than this, in design sizes and rotation entries, are one cluster.
const RADIUS: f64 = 1e-5;
/// Distances from the centre of a cluster at which Newton's method is started.
const STARTS: [f64; 2] = [1e-6, 1e-4];

/// Candidates sorted into those that stand alone and those proved to be close but distinct.
pub(super) struct Separated {
    pub(super) plain: Vec<PoseCandidate>,
    pub(super) proved: Vec<(PoseCandidate, Certificate)>,
}

/// Takes clusters of nearly singular candidates apart.
///
/// A cluster of `k` ends with `k` certified distinct roots in it becomes these roots. One without any certified
/// root becomes a root of multiplicity `k`. Anything else stays as it is, so that the coincidence is reported.
pub(super) fn separate(m: &Manipulator, s: &SquaredLegLengths, candidates: Vec<PoseCandidate>) -> Separated {
    let size = m.size();
    let (close, mut plain): (Vec<_>, Vec<_>) =
        candidates.into_iter().partition(|c| c.singular || !(c.condition < SINGULAR));
    let mut clusters: Vec<Vec<PoseCandidate>> = Vec::new();
    for c in close {
        let spread = |p: &ComplexPose| p.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
        let near = |d: &PoseCandidate| d.pose.distance(&c.pose, size) < RADIUS * spread(&c.pose);
        match clusters.iter_mut().find(|members| members.iter().any(near)) {
            Some(members) => members.push(c),
            None => clusters.push(vec![c]),
        }
    }
    let mut proved = Vec::new();
    for members in clusters {
        if members.len() == 1 {
            plain.extend(members);
        } else {
            resolve(m, s, members, &mut plain, &mut proved);
        }
    }
    Separated { plain, proved }
}

fn resolve(
    m: &Manipulator,
    s: &SquaredLegLengths,
    members: Vec<PoseCandidate>,
    plain: &mut Vec<PoseCandidate>,
    proved: &mut Vec<(PoseCandidate, Certificate)>,
) {
    let centre = mean(&members);
    let found = certified_near(m, s, &members, &centre);
    if found.len() == members.len() {
        let roots = members.iter().zip(found);
        proved.extend(roots.map(|(c, (pose, proof))| (PoseCandidate { pose, singular: false, ..*c }, proof)));
    } else if found.is_empty() {
        plain.extend(members.iter().map(|c| PoseCandidate { pose: centre, singular: true, ..*c }));
    } else {
        plain.extend(members);
    }
}

/// The mean cancels the leading errors of the ends about a multiple root.
fn mean(members: &[PoseCandidate]) -> ComplexPose {
    let weight = Complex64::new(1.0 / members.len() as f64, 0.0);
    let mut out = members[0].pose;
    out.rotation = members.iter().map(|c| c.pose.rotation * weight).sum();
    out.position = members.iter().map(|c| c.pose.position * weight).sum();
    out
}

/// Certified, pairwise distinct roots near the cluster, at most as many as it has members.
fn certified_near(
    m: &Manipulator,
    s: &SquaredLegLengths,
    members: &[PoseCandidate],
    centre: &ComplexPose,
) -> Vec<(ComplexPose, Certificate)> {
    let Ok(certifier) = Certifier::new(m, s) else { return Vec::new() };
    let mut known: Vec<(ComplexPose, Certificate)> = Vec::new();
    let mut guesses: Vec<ComplexPose> = members.iter().map(|c| c.pose).collect();
    for distance in STARTS {
        guesses.extend(beside(m, s, centre, distance));
    }
    for guess in guesses {
        if known.len() == members.len() {
            break;
        }
        let Ok(refined) = certifier.refine(&guess) else { continue };
        let pose = refined.pose();
        if pose.distance(centre, m.size()) > 1e3 * RADIUS {
            continue;
        }
        let outcome = certifier.certify(&pose);
        let Some(certificate) = outcome.certificate() else { continue };
        if known.iter().all(|(_, k)| relation(k, certificate) == RootRelation::Distinct) {
            known.push((pose, *certificate));
        }
    }
    known
}
