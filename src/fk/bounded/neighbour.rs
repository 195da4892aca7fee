//! Real poses of a design next to one whose number of poses a theorem bounds for all lengths.
//!
//! Rounded affine hexagons have further poses near a whole curve of points at infinity, which no certificate of single
//! points reaches. But their real poses are those of affine hexagons next to them. Let no end of leg `i` be farther
//! than `d_i` from that of the neighbour, both ends together, and let `P` be a real pose at lengths `l`. Then `P` is a
//! pose of the neighbour for some lengths within `d_i` of `l_i`, because a real motion keeps distances. When the
//! neighbour has as many certified poses as it can have, for all lengths within `d_i`, then `P` is one of them. When
//! the enclosures of these are each where a certified pose of the design is the only one, `P` is this pose.

use nalgebra::Matrix6;

use crate::bounds::special_bound;
use crate::evidence::all_distinct;
use crate::solve::certify::{
    Certificate, Certifier, ClusterCertificate, Distinctness, NewtonStart, RootCertificate, SquareData,
    cluster_is_captured_by, is_captured_by, is_of,
};
use crate::{BoundedProof, FkRoot, FkSolutions};
use num::ball::UP;
use num::exact::rational;
use num::surd::Surd;
use platform::geom::ComplexPose;
use platform::manipulator::{Body, ExactEnds, Manipulator, SquaredLegLengths};

/// Ends farther from a plane than this, relative to their spread, have no affine hexagons as neighbours worth a try.
const NEAR: f64 = 1e-3;

/// Affine hexagons next to a design.
#[derive(Debug)]
pub(super) struct Neighbour {
    manipulator: Manipulator,
    /// The number of poses that it can have.
    most: usize,
    /// Bounds of `d_i`.
    distances: [f64; 6],
}

impl Neighbour {
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
        let listed: Vec<(&FkRoot, &Certificate)> = found
            .roots
            .iter()
            .filter_map(|root| match &root.certificate {
                Some(RootCertificate::Study(c)) => Some((root, c)),
                _ => None,
            })
            .collect();
        if listed.len() < self.most {
            return None;
        }
        let there = Certifier::new(&self.manipulator, self.lengths(s)).ok()?;
        let single = |(root, own): &(&FkRoot, &Certificate)| {
            let near = there.root_near(NewtonStart::Point(root.dual_quaternion.as_ref()?)).ok()?.certificate;
            is_captured_by(&near, own).then_some(near)
        };
        let (mut near, mut rest) = (Vec::new(), Vec::new());
        for pose in &listed {
            match single(pose) {
                Some(certificate) => near.push(certificate),
                None => rest.push(*pose),
            }
        }
        let mut pairs = Vec::new();
        if near.len() < self.most {
            let here = Certifier::new(m, s).ok()?;
            while let Some(pose) = rest.pop() {
                let Some((pair, own)) = pair_near(&here, &there, &pose.0.pose) else { continue };
                let partner = rest.iter().position(|other| is_of(other.1, &own));
                if let Some(partner) = partner.filter(|_| is_of(pose.1, &own)) {
                    rest.swap_remove(partner);
                    pairs.push(pair);
                }
            }
        }
        let proved = near.len() + 2 * pairs.len() == self.most
            && all_distinct(&near, &pairs) == Distinctness::AllDistinct;
        let distance = self.distances.iter().copied().fold(0.0, f64::max);
        proved.then_some(BoundedProof {
            poses: self.most,
            far: None,
            rotation: None,
            neighbour: Some(distance),
            others: Vec::new(),
        })
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

/// Two poses of the neighbour that are not told apart for all its lengths, where two of the design are the only ones.
fn pair_near(
    here: &Certifier,
    there: &Certifier,
    pose: &ComplexPose,
) -> Option<(ClusterCertificate, ClusterCertificate)> {
    let two = |certifier: &Certifier| {
        certifier.clusters_near(pose, 2).map(|found| found.1).find(|c| c.multiplicity() == 2)
    };
    let (own, pair) = (two(here)?, two(there)?);
    cluster_is_captured_by(&pair, &own).then_some((pair, own))
}
