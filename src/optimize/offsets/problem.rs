//! The optimisation problem in design units, its defaults, and the scaled model of the search.

use thiserror::Error;

use super::conditioning::PoseLegs;
use num::conic::ConicTally;
use platform::geom::Pose;
use platform::manipulator::Octahedral;
use synthesis::{HexagonSide, sides};

/// Default of [`OffsetProblem::min_joint_distance`] as a share of the smaller body's radius.
pub const DEFAULT_SPACING_SHARE: f64 = 0.05;
/// Default of [`OffsetProblem::min_abs_det`].
pub const DEFAULT_MIN_ABS_DET: f64 = 0.05;
/// Default bounds of an offset: at most one edge length out on either extension of the edge.
pub const DEFAULT_BOUNDS: (f64, f64) = (-1.0, 2.0);

/// The problem of the best platform without shared joints that is equivalent to an octahedral one.
///
/// Maximise over `t` in `R^6`, with leg `i` as `(1 - t_i) leg_i + t_i leg_(i+1)` of the cyclic octahedral legs,
///
/// ```text
/// min over poses of sigma_6(J(t, pose)) / sigma_1(J(t, pose)),  rows [u_i, (R b_i x u_i) / L],
/// ```
///
/// subject to three limits. Joint centres of one body are at least `min_joint_distance` apart (three vertices and three
/// edge joints on each body). `|det A(t)| >= min_abs_det`, and `bounds[i].0 <= t_i <= bounds[i].1`.
#[derive(Debug, Clone, PartialEq)]
pub struct OffsetProblem {
    /// The octahedral manipulator, cyclic order.
    pub octahedral: Octahedral,
    /// Poses of the worst case, design units.
    pub poses: Vec<Pose>,
    /// `L`, design units.
    pub characteristic_length: f64,
    /// Least distance of joint centres on one body, design units.
    pub min_joint_distance: f64,
    /// Least `|det A|`, dimensionless.
    pub min_abs_det: f64,
    /// Least and greatest `t_i`, cyclic order; 0 and 1 are the ends of the edge.
    pub bounds: [(f64, f64); 6],
}

/// Reasons why a problem is invalid.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidOffsetProblem {
    /// There are no poses for the worst case.
    #[error("no pose is given to judge the platform at")]
    NoPoses,
    /// A pose has entries that are not finite.
    #[error("pose {index} has an entry that is not a finite number")]
    PoseNotFinite {
        /// 0-based index.
        index: usize,
    },
    /// A quantity that must be positive and finite is not.
    #[error("{quantity} is {value}; it must be positive and finite")]
    NotPositive {
        /// Name of the field.
        quantity: &'static str,
        /// Its value.
        value: f64,
    },
    /// Lower bound above the upper bound, or a bound that is not finite.
    #[error("the bounds of offset {} are {low} and {high}; both have to be finite, and the first no larger than the second", side + 1)]
    Bounds {
        /// 0-based side of the hexagon.
        side: usize,
        /// Lower bound.
        low: f64,
        /// Upper bound.
        high: f64,
    },
}

fn radius(triangle: &[nalgebra::Point3<f64>; 3]) -> f64 {
    let c = (triangle[0].coords + triangle[1].coords + triangle[2].coords) / 3.0;
    triangle.iter().map(|p| (p.coords - c).norm()).fold(0.0, f64::max)
}

impl OffsetProblem {
    /// The problem with the documented defaults. `L` is the RMS distance of the platform vertices from their centroid.
    /// The spacing is 5 % of the smaller body's radius (greatest distance of a vertex from the centroid). `|det A|` is
    /// at least 0.05, and joints are at most one edge length out on an extension.
    #[must_use]
    pub fn with_defaults(octahedral: Octahedral, poses: Vec<Pose>) -> Self {
        let (base, platform) = (octahedral.base(), octahedral.platform());
        let centroid = (platform[0].coords + platform[1].coords + platform[2].coords) / 3.0;
        let mean_square = platform.iter().map(|p| (p.coords - centroid).norm_squared()).sum::<f64>() / 3.0;
        let smaller = radius(&base).min(radius(&platform));
        Self {
            octahedral,
            poses,
            characteristic_length: mean_square.sqrt(),
            min_joint_distance: DEFAULT_SPACING_SHARE * smaller,
            min_abs_det: DEFAULT_MIN_ABS_DET,
            bounds: [DEFAULT_BOUNDS; 6],
        }
    }

    /// The larger radius of the two triangles, the internal unit of length.
    #[must_use]
    pub fn size(&self) -> f64 {
        radius(&self.octahedral.base()).max(radius(&self.octahedral.platform()))
    }

    /// Length of the edge along which the joint of side `i` slides, design units.
    #[must_use]
    pub fn edge_lengths(&self) -> [f64; 6] {
        sides(&self.octahedral, 1.0).map(|s| s.edge_length())
    }

    /// Checks that the problem is complete and its numbers are valid.
    ///
    /// # Errors
    /// The first violation.
    pub fn validate(&self) -> Result<(), InvalidOffsetProblem> {
        if self.poses.is_empty() {
            return Err(InvalidOffsetProblem::NoPoses);
        }
        let finite = |p: &Pose| p.rotation.matrix().iter().chain(p.position.iter()).all(|x| x.is_finite());
        if let Some(index) = self.poses.iter().position(|p| !finite(p)) {
            return Err(InvalidOffsetProblem::PoseNotFinite { index });
        }
        let positive = [
            ("characteristic_length", self.characteristic_length),
            ("min_joint_distance", self.min_joint_distance),
            ("min_abs_det", self.min_abs_det),
        ];
        for (quantity, value) in positive {
            if !(value > 0.0 && value.is_finite()) {
                return Err(InvalidOffsetProblem::NotPositive { quantity, value });
            }
        }
        for (side, (low, high)) in self.bounds.into_iter().enumerate() {
            if !(low.is_finite() && high.is_finite() && low <= high) {
                return Err(InvalidOffsetProblem::Bounds { side, low, high });
            }
        }
        Ok(())
    }
}

/// The problem with lengths divided by the size, as in the search.
#[derive(Debug, Clone)]
pub(crate) struct OffsetModel {
    /// Design units in one unit of length of the model.
    pub scale: f64,
    pub sides: [HexagonSide; 6],
    pub poses: Vec<PoseLegs>,
    /// Required spacing.
    pub spacing: f64,
    /// Radii of the two triangles, base first: the reference of the back-off from the spacing.
    pub radii: [f64; 2],
    /// Required `|det A|`, exact.
    pub min_abs_det: f64,
    /// Counts the conic programs of the search.
    pub conic: ConicTally,
}

/// Distance of the search from the true limits (relative to the radius of the body; absolute in `det A`). It keeps a
/// conic solver's residual from carrying the answer across them. Proofs do not use it.
pub(crate) const BACKOFF: f64 = 1e-8;

impl OffsetModel {
    pub(super) fn new(p: &OffsetProblem) -> Self {
        let scale = p.size();
        let sides = sides(&p.octahedral, scale);
        let length = p.characteristic_length / scale;
        let poses = p.poses.iter().map(|pose| PoseLegs::new(&sides, pose, length, scale)).collect();
        Self {
            scale,
            sides,
            poses,
            spacing: p.min_joint_distance / scale,
            radii: [p.octahedral.base(), p.octahedral.platform()].map(|t| radius(&t) / scale),
            min_abs_det: p.min_abs_det,
            conic: ConicTally::default(),
        }
    }

    /// Radius of the body on which the joint of a side slides.
    pub(super) fn radius(&self, side: usize) -> f64 {
        self.radii[side % 2]
    }

    pub(crate) fn kept_spacing(&self, side: usize) -> f64 {
        self.spacing + BACKOFF * self.radius(side)
    }

    pub(crate) fn kept_det(&self) -> f64 {
        self.min_abs_det + BACKOFF
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{example, poses};
    use super::*;

    #[test]
    fn refuses_what_cannot_be_asked() {
        let good = OffsetProblem::with_defaults(example(), poses());
        assert_eq!(good.validate(), Ok(()));
        let check = |change: &dyn Fn(&mut OffsetProblem)| {
            let mut p = good.clone();
            change(&mut p);
            p.validate().unwrap_err()
        };
        assert_eq!(check(&|p| p.poses.clear()), InvalidOffsetProblem::NoPoses);
        assert_eq!(
            check(&|p| p.poses[1].position.x = f64::NAN),
            InvalidOffsetProblem::PoseNotFinite { index: 1 }
        );
        assert!(matches!(check(&|p| p.min_abs_det = 0.0), InvalidOffsetProblem::NotPositive { .. }));
        assert!(matches!(check(&|p| p.bounds[4] = (1.0, 0.0)), InvalidOffsetProblem::Bounds { side: 4, .. }));
    }

    #[test]
    fn defaults_are_those_documented() {
        let p = OffsetProblem::with_defaults(example(), poses());
        // platform edge 6: radius 6/sqrt 3
        let r = 6.0 / 3f64.sqrt();
        assert!(
            (p.characteristic_length - r).abs() < 1e-12 && (p.min_joint_distance - 0.05 * r).abs() < 1e-12
        );
        for (i, d) in p.edge_lengths().into_iter().enumerate() {
            assert!((d - if i % 2 == 0 { 12.0 } else { 6.0 }).abs() < 1e-12);
        }
    }
}
