//! Matches two sets of complex poses.

use super::determined::magnitude;
use platform::geom::ComplexPose;

/// A pairing of two sets of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct PoseMatching {
    /// Pairs (index in A, index in B, distance). Distances are those of [`ComplexPose::distance`], divided by the size
    /// of the numbers in the pose if these exceed one.
    pub pairs: Vec<(usize, usize, f64)>,
    /// Poses of A with no partner within the tolerance.
    pub only_a: Vec<usize>,
    /// Poses of B with no partner within the tolerance.
    pub only_b: Vec<usize>,
    /// Poses of A without partner that are excluded.
    pub beyond_a: Vec<usize>,
    /// Poses of B without partner that are excluded.
    pub beyond_b: Vec<usize>,
}

impl PoseMatching {
    /// The largest distance of a pair, zero without pairs.
    #[must_use]
    pub fn worst_distance(&self) -> f64 {
        self.pairs.iter().map(|p| p.2).fold(0.0, f64::max)
    }

    /// Whether every pose of either set that is not excluded has a partner.
    #[must_use]
    pub fn is_perfect(&self) -> bool {
        self.only_a.is_empty() && self.only_b.is_empty()
    }

    /// Excludes poses without partner that `of_a` (for A) or `of_b` (for B) selects.
    pub(super) fn set_aside(&mut self, of_a: impl Fn(usize) -> bool, of_b: impl Fn(usize) -> bool) {
        self.beyond_a.extend(self.only_a.extract_if(.., |i| of_a(*i)));
        self.beyond_b.extend(self.only_b.extract_if(.., |j| of_b(*j)));
    }
}

/// Pairs the poses of two sets one to one, nearest pairs first. Poses farther apart than `tolerance` (relative to
/// `size` for positions and to the pose's own numbers) are not paired.
#[must_use]
pub fn match_poses(a: &[ComplexPose], b: &[ComplexPose], size: f64, tolerance: f64) -> PoseMatching {
    let mut all: Vec<(usize, usize, f64)> = Vec::with_capacity(a.len() * b.len());
    for (i, p) in a.iter().enumerate() {
        for (j, q) in b.iter().enumerate() {
            let distance = p.distance(q, size) / magnitude(p, size);
            if distance <= tolerance {
                all.push((i, j, distance));
            }
        }
    }
    all.sort_by(|x, y| x.2.total_cmp(&y.2));
    let (mut free_a, mut free_b) = (vec![true; a.len()], vec![true; b.len()]);
    let mut pairs = Vec::new();
    for (i, j, distance) in all {
        if free_a[i] && free_b[j] {
            (free_a[i], free_b[j]) = (false, false);
            pairs.push((i, j, distance));
        }
    }
    let left = |free: &[bool]| free.iter().enumerate().filter(|f| *f.1).map(|f| f.0).collect();
    PoseMatching {
        pairs,
        only_a: left(&free_a),
        only_b: left(&free_b),
        beyond_a: Vec::new(),
        beyond_b: Vec::new(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;
    use num::Rng;
    use platform::geom::{Pose, random_rotation};

    fn poses(n: u64) -> Vec<ComplexPose> {
        let mut rng = Rng::new(8);
        let mut one = || {
            let rotation = random_rotation(&mut rng);
            ComplexPose::from(Pose { rotation, position: Vector3::from_fn(|_, _| rng.normal()) })
        };
        (0..n).map(|_| one()).collect()
    }

    #[test]
    fn a_permuted_set_matches_perfectly_and_a_moved_pose_is_left_over() {
        let a = poses(6);
        let mut b = a.clone();
        b.reverse();
        let m = match_poses(&a, &b, 1.0, 1e-9);
        assert!(m.is_perfect() && m.worst_distance() < 1e-15);
        assert!(m.pairs.iter().all(|p| p.0 + p.1 == 5));
        b[2].position.x += 1e-6;
        let m = match_poses(&a, &b, 1.0, 1e-9);
        assert_eq!((&m.only_a, &m.only_b), (&vec![3], &vec![2]));
        // excluding on one side does not affect the other
        let mut m = m;
        m.set_aside(|i| i == 3, |j| j == 0);
        assert_eq!((&m.beyond_a, &m.only_a, &m.only_b), (&vec![3], &vec![], &vec![2]));
        assert!(!m.is_perfect());
        m.set_aside(|_| false, |j| j == 2);
        assert!(m.is_perfect() && m.beyond_a == [3] && m.beyond_b == [2]);
    }

    #[test]
    fn no_pose_has_two_partners() {
        let a = poses(2);
        let m = match_poses(&[a[0], a[0]], &[a[0]], 1.0, 1e-9);
        assert_eq!((m.pairs.len(), m.only_a.len(), m.only_b.len()), (1, 1, 0));
    }
}
