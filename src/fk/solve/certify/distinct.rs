//! Telling certified roots of one problem apart, whatever patches they were certified on.

use super::certificate::{CentrePrecision, Certificate, PoseEnclosure};
use super::cluster::ClusterCertificate;
use num::ball::UP;
use num::ball::WideDisc;

/// The relation of two certified roots of the same problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootRelation {
    /// Proved different: some entry of `R` or `p`, or some ratio of Study coordinates, is.
    Distinct,
    /// Proved to be one root: one lies where the other is the only one.
    Same,
    /// The enclosures overlap and neither uniqueness ball holds the other enclosure.
    Undecided,
}

/// Whether a list of certified roots is free of repetitions.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Distinctness {
    /// Proof: all pairs are distinct.
    AllDistinct,
    /// The pairs (indices into the list) that are not proved distinct, each with its relation.
    NotAll(Vec<(usize, usize, RootRelation)>),
}

/// Relation of the roots of two certificates; both must come from the same manipulator and the same squared lengths.
///
/// Roots are compared by the enclosures of `R` and `p`, which do not depend on the patch, and by those of their Study
/// coordinates. Far out (`e.e` near 0) two poses may agree in all the leading digits of `R` and `p` and still have
/// quite different `g`.
#[must_use]
pub fn relation(a: &Certificate, b: &Certificate) -> RootRelation {
    if a.enclosure.is_disjoint(&b.enclosure) {
        return RootRelation::Distinct;
    }
    if is_plainly_captured(a, b) || is_plainly_captured(b, a) {
        return RootRelation::Same;
    }
    let seen = [(a, b), (b, a)].map(|(inner, outer)| (on_patch(inner, outer.patch, outer.unit), outer));
    let any = |holds: &dyn Fn(&[WideDisc; 8], &Certificate) -> bool| {
        seen.iter().any(|(x, outer)| x.is_some_and(|x| holds(&x, outer)))
    };
    if any(&is_apart) {
        RootRelation::Distinct
    } else if any(&is_captured) {
        RootRelation::Same
    } else {
        RootRelation::Undecided
    }
}

/// Coordinate `j` of the root, where that of its patch is 1.
fn coordinate(c: &Certificate, j: usize) -> WideDisc {
    WideDisc::about(c.centre[j], c.low[j], if j == c.patch { 0.0 } else { c.radius })
}

/// The coordinates of the root of `inner` in `unit`, divided by the one of the patch. `None` when that one may vanish.
fn on_patch(inner: &Certificate, patch: usize, unit: f64) -> Option<[WideDisc; 8]> {
    carried(|j| coordinate(inner, j), (inner.patch, inner.unit), (patch, unit))
}

/// Coordinates on one patch in one unit as those on another patch in another unit.
fn carried(
    coordinate: impl Fn(usize) -> WideDisc,
    (from, own): (usize, f64),
    (patch, unit): (usize, f64),
) -> Option<[WideDisc; 8]> {
    // both units are powers of two: products with their ratio are exact
    let ratio = own / unit;
    let disc = |j: usize| coordinate(j).scaled(if j < 4 { 1.0 } else { ratio });
    if !ratio.is_normal() {
        return None;
    }
    if from == patch {
        return Some(std::array::from_fn(disc));
    }
    let factor = disc(patch).reciprocal()?;
    Some(std::array::from_fn(|j| disc(j) * factor))
}

/// Proves that `x` is not the root of `outer`.
fn is_apart(x: &[WideDisc; 8], outer: &Certificate) -> bool {
    (0..8).filter(|j| *j != outer.patch).any(|j| x[j].is_disjoint(&coordinate(outer, j)))
}

/// Proves that the root of `inner`, for every choice of its data, lies where that of `outer` is the only one. The data
/// of both may differ.
pub(crate) fn is_captured_by(inner: &Certificate, outer: &Certificate) -> bool {
    on_patch(inner, outer.patch, outer.unit).is_some_and(|x| is_captured(&x, outer))
}

/// Proves that the roots of the cluster `inner`, for every choice of its data, lie where those of `outer` are the only
/// ones. The data of both may differ.
pub(crate) fn cluster_is_captured_by(inner: &ClusterCertificate, outer: &ClusterCertificate) -> bool {
    let of =
        |c: &ClusterCertificate, j: usize, radius: f64| WideDisc::about(c.centre()[j], c.low()[j], radius);
    let disc = |j: usize| of(inner, j, if j == inner.patch() { 0.0 } else { inner.radius() });
    let (patch, radius) = (outer.patch(), outer.uniqueness_radius());
    carried(disc, (inner.patch(), inner.unit()), (patch, outer.unit()))
        .is_some_and(|x| lies_within(&x, patch, radius, |j| of(outer, j, 0.0)))
}

/// Proves that `x` lies in the uniqueness ball of `outer`.
fn is_captured(x: &[WideDisc; 8], outer: &Certificate) -> bool {
    let centre = |j: usize| WideDisc::about(outer.centre[j], outer.low[j], 0.0);
    lies_within(x, outer.patch, outer.uniqueness_radius, centre)
}

fn lies_within(x: &[WideDisc; 8], patch: usize, radius: f64, centre: impl Fn(usize) -> WideDisc) -> bool {
    (0..8).filter(|j| *j != patch).all(|j| {
        let gap = (x[j] - centre(j)).rounded();
        (gap.centre.norm() + gap.radius) * UP <= radius
    })
}

/// Proves that a root is one of a cluster: it lies where there are no others.
#[must_use]
pub fn is_of(root: &Certificate, cluster: &ClusterCertificate) -> bool {
    let (patch, radius) = (cluster.patch(), cluster.uniqueness_radius());
    let centre = |j: usize| WideDisc::about(cluster.centre()[j], cluster.low()[j], 0.0);
    on_patch(root, patch, cluster.unit()).is_some_and(|x| lies_within(&x, patch, radius, centre))
}

/// [`is_captured`] for centres in doubles on one patch, without balls: a computed difference is off by rounding of
/// itself, which [`UP`] takes up.
fn is_plainly_captured(inner: &Certificate, outer: &Certificate) -> bool {
    let in_double = |c: &Certificate| c.precision == CentrePrecision::Double;
    let alike = inner.patch == outer.patch && inner.unit.to_bits() == outer.unit.to_bits();
    let gap = |j: usize| {
        let z = inner.centre[j] - outer.centre[j];
        z.re.abs() + z.im.abs()
    };
    alike
        && in_double(inner)
        && in_double(outer)
        && (0..8).all(|j| (gap(j) + inner.radius) * UP <= outer.uniqueness_radius)
}

/// Pairs of enclosures that may have a pose in common, as indices in ascending order; all others are disjoint.
///
/// Discs over disjoint intervals of the real axis are disjoint. The intervals of one coordinate are passed from left to
/// right, so that of `n` enclosures not all `n (n - 1) / 2` pairs are examined.
pub(crate) fn overlapping_pairs<'a>(
    enclosures: impl Iterator<Item = &'a PoseEnclosure>,
) -> Vec<(usize, usize)> {
    let whole = [f64::NEG_INFINITY, f64::INFINITY];
    let interval = |e: &PoseEnclosure| {
        let disc = e.position[0];
        let ends = [(disc.centre.re - disc.radius).next_down(), (disc.centre.re + disc.radius).next_up()];
        if ends.iter().any(|x| x.is_nan()) { whole } else { ends }
    };
    let all: Vec<&PoseEnclosure> = enclosures.collect();
    let ends: Vec<[f64; 2]> = all.iter().map(|e| interval(e)).collect();
    let mut order: Vec<usize> = (0..all.len()).collect();
    order.sort_by(|&i, &j| ends[i][0].total_cmp(&ends[j][0]));
    let mut out = Vec::new();
    for (place, &i) in order.iter().enumerate() {
        for &j in order[place + 1..].iter().take_while(|&&j| ends[j][0] <= ends[i][1]) {
            if !all[i].is_disjoint(all[j]) {
                out.push((i.min(j), i.max(j)));
            }
        }
    }
    out.sort_unstable();
    out
}

/// Proves the roots of certificates of one problem pairwise distinct, or lists the pairs for which it cannot.
#[must_use]
pub fn distinct(certificates: &[Certificate]) -> Distinctness {
    let overlapping = overlapping_pairs(certificates.iter().map(Certificate::enclosure));
    let related = |(i, j): (usize, usize)| (i, j, relation(&certificates[i], &certificates[j]));
    let doubtful: Vec<(usize, usize, RootRelation)> =
        overlapping.into_iter().map(related).filter(|p| p.2 != RootRelation::Distinct).collect();
    if doubtful.is_empty() { Distinctness::AllDistinct } else { Distinctness::NotAll(doubtful) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use num::ball::Disc;
    use num_complex::Complex64;

    /// The pairs are those that a check of all of them finds, whatever the radii.
    #[test]
    fn no_overlapping_pair_is_passed_over() {
        let mut rng = Rng::new(17);
        for round in 0..40 {
            let mut disc = |k: usize| Disc {
                centre: Complex64::new(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0)),
                radius: match k {
                    3 => f64::INFINITY,
                    5 if round % 2 == 0 => f64::NAN,
                    _ => 10f64.powf(rng.uniform(-6.0, 0.3)),
                },
            };
            let mut one = |k: usize| PoseEnclosure {
                rotation: std::array::from_fn(|_| std::array::from_fn(|_| disc(0))),
                position: std::array::from_fn(|_| disc(k)),
            };
            let mut list: Vec<PoseEnclosure> = (0..12).map(&mut one).collect();
            // one twice, and one that shares the coordinate that is examined first
            list.push(list[2]);
            list[1].position[0] = list[0].position[0];
            let brute: Vec<(usize, usize)> = (0..list.len())
                .flat_map(|i| (i + 1..list.len()).map(move |j| (i, j)))
                .filter(|&(i, j)| !list[i].is_disjoint(&list[j]))
                .collect();
            assert_eq!(overlapping_pairs(list.iter()), brute);
            assert!(brute.contains(&(2, 12)));
        }
        assert!(overlapping_pairs([].iter()).is_empty());
    }
}
