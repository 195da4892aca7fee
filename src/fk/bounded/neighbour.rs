//! Real poses of a design next to one whose number of poses a theorem bounds for all lengths.
//!
//! Rounded affine hexagons have further poses near a whole curve of points at infinity, which no certificate of single
//! points reaches. But their real poses are those of affine hexagons next to them. Let no end of leg `i` be farther
//! than `d_i` from that of the neighbour, both ends together, and let `P` be a real pose at lengths `l`. Then `P` is a
//! pose of the neighbour for some lengths within `d_i` of `l_i`, because a real motion keeps distances. When the
//! neighbour has as many certified poses as it can have, for all lengths within `d_i`, then `P` is one of them. When
//! each of their enclosures has no real pose, or is where a certified pose of the design is the only one, `P`
//! is listed.

use nalgebra::Matrix6;
use num_complex::Complex64;

use crate::bounds::special_bound;
use crate::evidence::all_distinct;
use crate::solve::certify::{
    Certificate, Certifier, ClusterCertificate, Distinctness, NewtonStart, ProvedReality, RootCertificate,
    RootRelation, SquareData, cluster_is_captured_by, is_captured_by, is_of, relation,
};
use crate::{BoundedProof, FkRoot, FkSolutions};
use num::ball::UP;
use num::exact::rational;
use num::surd::Surd;
use platform::geom::ComplexPose;
use platform::manipulator::{Body, ExactEnds, Manipulator, SquaredLegLengths};

/// Ends farther from a plane than this, relative to their spread, have no affine hexagons as neighbours worth a try.
const NEAR: f64 = 1e-3;
/// The largest number of poses that are proved together.
const MOST_TOGETHER: usize = 4;
/// Poses closer than this, in entries of `R` and sizes of the design, may be proved together.
const CLOSE: f64 = 0.25;

/// Affine hexagons next to a design.
#[derive(Debug)]
pub(crate) struct Neighbour {
    manipulator: Manipulator,
    /// The number of poses that it can have.
    most: usize,
    /// Bounds of `d_i`.
    distances: [f64; 6],
}

/// Distance of a neighbour, as a share of the size, within which doubles do not see the far poses of the design.
const UNSEEN: f64 = 1e-9;

impl Neighbour {
    /// Whether the design is so near that computations in doubles take it for its neighbour.
    pub(super) fn hides_far_poses(&self) -> bool {
        self.distance() <= UNSEEN * self.manipulator.size()
    }

    /// The greatest `d_i`.
    fn distance(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }

    /// The nearest affine hexagons, where the design is near any.
    ///
    /// The ends of affine hexagons, both of a leg together, are points of a plane of 6-space.
    pub(super) fn of(m: &Manipulator) -> Option<Self> {
        let legs = m.legs();
        let end = |i: usize, k: usize| if k < 3 { legs[i].base[k] } else { legs[i].platform[k - 3] };
        let mean: [f64; 6] = std::array::from_fn(|k| (0..6).map(|i| end(i, k)).sum::<f64>() / 6.0);
        let svd = num::small::bounded_svd(&Matrix6::from_fn(|i, k| end(i, k) - mean[k]))?;
        let sizes = svd.singular_values;
        if !(sizes[2] < NEAR * sizes[1]) {
            return None;
        }
        let (u, v_t) = (svd.u?, svd.v_t?);
        let exact = |x: f64| Surd::rational(&rational(x)?);
        let coordinate = |i: usize, k: usize| {
            (0..2).try_fold(exact(mean[k])?, |sum, j| {
                sum.plus(&exact(u[(i, j)] * sizes[j])?.times(&exact(v_t[(j, k)])?)?)
            })
        };
        let point = |i: usize, first: usize| {
            Some([coordinate(i, first)?, coordinate(i, first + 1)?, coordinate(i, first + 2)?])
        };
        let ends: Vec<ExactEnds> =
            (0..6).map(|i| Some([point(i, 0)?, point(i, 3)?])).collect::<Option<_>>()?;
        let manipulator = Manipulator::from_exact_ends(&ends.try_into().ok()?).ok()?;
        let most = special_bound(&manipulator)?.bound();
        let distances = std::array::from_fn(|i| {
            let apart = |body: Body| {
                let (here, there) = (legs[i].end(body), manipulator.legs()[i].end(body));
                // both are doubles within radii of the joints
                let radii = m.end_radius(i, body) + manipulator.end_radius(i, body);
                ((here - there).norm() + 2.0 * radii) * UP
            };
            (apart(Body::Base) + apart(Body::Platform)) * UP
        });
        Some(Self { manipulator, most, distances })
    }

    /// The proof that all real poses of the design `m` are listed.
    pub(super) fn prove(
        &self,
        found: &FkSolutions,
        m: &Manipulator,
        s: &SquaredLegLengths,
    ) -> Option<BoundedProof> {
        self.near(found, m, s)?;
        Some(BoundedProof {
            poses: self.most,
            far: None,
            rotation: None,
            neighbour: Some(self.distance()),
            others: Vec::new(),
        })
    }

    /// The poses of the list next to those of the neighbour, where these are proved to be all it has.
    pub(super) fn near(
        &self,
        found: &FkSolutions,
        m: &Manipulator,
        s: &SquaredLegLengths,
    ) -> Option<Vec<usize>> {
        let listed: Vec<Listed> = found
            .roots
            .iter()
            .enumerate()
            .filter_map(|(place, root)| match &root.certificate {
                Some(RootCertificate::Study(certificate)) => Some(Listed { place, root, certificate }),
                _ => None,
            })
            .collect();
        if listed.len() < self.most {
            return None;
        }
        let there = Certifier::new(&self.manipulator, self.lengths(s)).ok()?;
        let found_there: Vec<Option<Certificate>> = listed
            .iter()
            .map(|pose| {
                let start = NewtonStart::Point(pose.root.dual_quaternion.as_ref()?);
                Some(there.root_near(start).ok()?.certificate)
            })
            .collect();
        // one entry for each listed pose
        let mut alone: Vec<Option<Certificate>> = found_there
            .iter()
            .zip(&listed)
            .map(|(near, pose)| near.filter(|near| is_captured_by(near, pose.certificate)))
            .collect();
        // no real pose is where the neighbour has none
        for (k, near) in found_there.iter().enumerate() {
            let Some(near) = near.filter(|near| near.reality() == ProvedReality::NonReal) else { continue };
            let is_new = |other: &Certificate| relation(other, &near) == RootRelation::Distinct;
            if alone.iter().flatten().all(is_new) {
                alone[k] = Some(near);
            }
        }
        let mut is_placed: Vec<bool> = alone.iter().map(Option::is_some).collect();
        let mut together = Vec::new();
        let mut grouped = vec![false; listed.len()];
        let placed = |list: &[bool]| list.iter().filter(|x| **x).count();
        if placed(&is_placed) < self.most {
            let here = Certifier::new(m, s).ok()?;
            for k in 0..listed.len() {
                if is_placed[k] {
                    continue;
                }
                let Some((group, members)) = group_near(&here, &there, (&listed, m.size()), k) else {
                    continue;
                };
                if members.iter().any(|i| grouped[*i]) {
                    continue;
                }
                together.push(group);
                for i in members {
                    (alone[i], is_placed[i], grouped[i]) = (None, true, true);
                }
            }
        }
        let near: Vec<Certificate> = alone.into_iter().flatten().collect();
        let proved =
            placed(&is_placed) == self.most && all_distinct(&near, &together) == Distinctness::AllDistinct;
        proved.then(|| listed.iter().zip(&is_placed).filter(|(_, p)| **p).map(|(l, _)| l.place).collect())
    }

    /// All squared lengths that real poses of the design at the lengths `s` can have in the neighbour.
    fn lengths(&self, s: &SquaredLegLengths) -> SquareData {
        let (mut radius, middle) = (s.radius(), s.middle());
        for i in 0..6 {
            let d = self.distances[i];
            let longest = (middle[i].hi() + radius[i]).max(0.0).sqrt() * UP;
            radius[i] = (radius[i] + d * (2.0 * longest + d)) * UP;
        }
        SquareData::within(middle, radius)
    }
}

/// A certified pose of the design and its place in the list.
struct Listed<'a> {
    place: usize,
    root: &'a FkRoot,
    certificate: &'a Certificate,
}

/// Poses of the neighbour that are not told apart for all its lengths, where as many listed poses are the only ones of
/// the design: their certificate, and the listed poses, one of them `k`.
fn group_near(
    here: &Certifier,
    there: &Certifier,
    (listed, size): (&[Listed], f64),
    k: usize,
) -> Option<(ClusterCertificate, Vec<usize>)> {
    let pose = &listed[k].root.pose;
    // the middle of two poses is nearer to that of their group than either
    let middle = |other: &Listed| {
        let other = &other.root.pose;
        (pose.distance(other, size) < CLOSE).then(|| ComplexPose {
            rotation: (pose.rotation + other.rotation) / Complex64::from(2.0),
            position: (pose.position + other.position) / Complex64::from(2.0),
        })
    };
    let starts: Vec<ComplexPose> = listed.iter().filter_map(middle).collect();
    let mut found = starts
        .iter()
        .flat_map(|start| here.clusters_near(start, MOST_TOGETHER).map(move |own| (start, own.1)));
    found.find_map(|(start, own)| {
        let members: Vec<usize> = (0..listed.len()).filter(|i| is_of(listed[*i].certificate, &own)).collect();
        if members.len() != own.multiplicity() || !members.contains(&k) {
            return None;
        }
        let is_same = |group: &ClusterCertificate| {
            group.multiplicity() == own.multiplicity()
                && (group.reality() == ProvedReality::NonReal || cluster_is_captured_by(group, &own))
        };
        let group = there.clusters_near(start, own.multiplicity()).map(|found| found.1).find(is_same)?;
        Some((group, members))
    })
}
