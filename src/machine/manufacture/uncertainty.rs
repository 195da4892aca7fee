//! Uncertainty of the poses of a calibrated machine.

use nalgebra::{DMatrix, Matrix6, Point3, Vector3};

use super::sensitivity::Sensitivity;
use num::Rng;
use num::small::bounded_svd;
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// The remaining uncertainty of a calibrated machine: errors of joints and leg offsets with the covariance `C = F F^T`.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineUncertainty {
    /// `F`, design units: three rows for each of [`joints`](super::joints), in the frame of its body, then one for each
    /// leg offset.
    root: DMatrix<f64>,
}

/// The covariance of a pose, and two figures derived from it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseCovariance {
    /// Covariance of the shift of the tool point (design units) and the rotation vector (radians), base frame.
    pub matrix: Matrix6<f64>,
    /// Root mean square of the distance by which the tool point is off, design units.
    pub position: f64,
    /// Root mean square of the angle by which the orientation is off, radians.
    pub rotation: f64,
}

impl MachineUncertainty {
    /// The uncertainty with these standard deviations (design units) and correlations: three rows for each of
    /// [`joints`](super::joints), then six for the offsets. `None` if the sizes differ or an entry is not finite.
    ///
    /// With the singular value decomposition `R = U S V^T` of the correlations, `U S U^T` is `R` if that is positive
    /// semidefinite. Negative eigenvalues from rounding change sign.
    #[must_use]
    pub fn new(deviations: &[f64], correlations: &DMatrix<f64>) -> Option<Self> {
        let n = deviations.len();
        if correlations.shape() != (n, n) || deviations.iter().any(|d| !d.is_finite()) {
            return None;
        }
        let svd = bounded_svd(correlations)?;
        let mut root = svd.u?;
        for (mut column, value) in root.column_iter_mut().zip(&svd.singular_values) {
            column *= value.sqrt();
        }
        for (mut row, deviation) in root.row_iter_mut().zip(deviations) {
            row *= *deviation;
        }
        Some(Self { root })
    }

    /// The same deviations without correlations.
    #[must_use]
    pub fn independent(&self) -> Self {
        let deviations = self.root.row_iter().map(|row| row.norm());
        let diagonal = nalgebra::DVector::from_iterator(self.root.nrows(), deviations);
        Self { root: DMatrix::from_diagonal(&diagonal) }
    }

    /// The covariance of a pose computed from shown lengths with the calibrated joints and offsets. `None` at a
    /// singular pose and if the sizes differ.
    ///
    /// To first order it is `G C G^T`, with the derivatives `G` of the pose error by the errors of joints and offsets
    /// ([`Sensitivity`]). The noise of the lengths is not included.
    #[must_use]
    pub fn pose_covariance(
        &self,
        m: &Manipulator,
        pose: &Pose,
        tool: &Point3<f64>,
    ) -> Option<PoseCovariance> {
        let s = Sensitivity::at(m, pose, tool)?;
        let count = s.position.len();
        if self.root.nrows() != 3 * count + 6 {
            return None;
        }
        let mut g = DMatrix::zeros(6, 3 * count + 6);
        for (k, (position, rotation)) in s.position.iter().zip(&s.rotation).enumerate() {
            g.fixed_view_mut::<3, 3>(0, 3 * k).copy_from(position);
            g.fixed_view_mut::<3, 3>(3, 3 * k).copy_from(rotation);
        }
        for (leg, (position, rotation)) in s.leg_position.iter().zip(&s.leg_rotation).enumerate() {
            g.fixed_view_mut::<3, 1>(0, 3 * count + leg).copy_from(position);
            g.fixed_view_mut::<3, 1>(3, 3 * count + leg).copy_from(rotation);
        }
        let moved = g * &self.root;
        let product = &moved * moved.transpose();
        Some(PoseCovariance {
            matrix: product.fixed_view::<6, 6>(0, 0).into(),
            position: moved.rows(0, 3).norm(),
            rotation: moved.rows(3, 3).norm(),
        })
    }

    /// Errors of the joints, in the order of [`joints`](super::joints), and of the offsets, drawn from the normal
    /// distribution with the covariance.
    pub fn draw(&self, rng: &mut Rng) -> (Vec<Vector3<f64>>, [f64; 6]) {
        let normal = nalgebra::DVector::from_fn(self.root.ncols(), |_, _| rng.normal());
        let errors = &self.root * normal;
        let count = (self.root.nrows() - 6) / 3;
        let joint = |k: usize| Vector3::new(errors[3 * k], errors[3 * k + 1], errors[3 * k + 2]);
        ((0..count).map(joint).collect(), std::array::from_fn(|leg| errors[3 * count + leg]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use platform::geom::Angles;

    /// Three base joints and three platform joints, each of two legs.
    fn octahedral() -> Manipulator {
        let corner = |radius: f64, turn: f64| {
            move |k: usize| {
                let (sin, cos) = (turn + k as f64 * 120.0).to_radians().sin_cos();
                Point3::new(radius * cos, radius * sin, 0.0)
            }
        };
        let pairs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
        let base = (0..3).map(corner(5.0, 0.0)).collect();
        Manipulator::try_new(base, (0..3).map(corner(3.0, 60.0)).collect(), pairs).unwrap()
    }

    #[test]
    fn joints_that_are_off_together_move_the_pose_and_do_not_turn_it() {
        let m = octahedral();
        let pose = Pose::new(Vector3::new(0.3, -0.2, 4.0), Angles::from_degrees([5.0, -3.0, 8.0]));
        let tool = Point3::new(0.5, 1.0, 2.0);
        // all base joints along x by the same normal number of deviation 0.1: the computed pose shifts by it, for any
        // legs
        let along_x = |k: usize| k < 9 && k.is_multiple_of(3);
        let deviations: Vec<f64> = (0..24).map(|k| if along_x(k) { 0.1 } else { 0.0 }).collect();
        let together = |i: usize, j: usize| f64::from(u8::from(i == j || (along_x(i) && along_x(j))));
        let known = MachineUncertainty::new(&deviations, &DMatrix::from_fn(24, 24, together)).unwrap();
        let found = known.pose_covariance(&m, &pose, &tool).unwrap();
        let mut expected = Matrix6::zeros();
        expected[(0, 0)] = 0.01;
        assert!((found.matrix - expected).amax() < 1e-14, "{}", found.matrix);
        assert!((found.position - 0.1).abs() < 1e-13 && found.rotation < 1e-13, "{found:?}");
        // without the correlations the shift differs, and the platform turns
        let independent = known.independent().pose_covariance(&m, &pose, &tool).unwrap();
        assert!(
            (independent.matrix[(0, 0)] - 0.01).abs() > 1e-3 && independent.rotation > 0.001,
            "{independent:?}"
        );
        let same = MachineUncertainty::new(&deviations, &DMatrix::identity(24, 24)).unwrap();
        let same = same.pose_covariance(&m, &pose, &tool).unwrap();
        assert!((same.matrix - independent.matrix).amax() < 1e-14);
    }

    #[test]
    fn draws_have_the_covariance() {
        let m = octahedral();
        let pose = Pose::new(Vector3::new(0.0, 0.0, 4.0), Angles::from_degrees([0.0, 2.0, 0.0]));
        let mut rng = Rng::new(3);
        let mixing = DMatrix::from_fn(24, 24, |_, _| rng.normal());
        let covariance = &mixing * mixing.transpose();
        let deviations: Vec<f64> = (0..24).map(|k| covariance[(k, k)].sqrt()).collect();
        let scaled = DMatrix::from_fn(24, 24, |i, j| covariance[(i, j)] / (deviations[i] * deviations[j]));
        let known = MachineUncertainty::new(&deviations, &scaled).unwrap();
        let expected = known.pose_covariance(&m, &pose, &Point3::origin()).unwrap();
        let s = Sensitivity::at(&m, &pose, &Point3::origin()).unwrap();
        let count = 20_000;
        let squares: f64 = (0..count)
            .map(|_| {
                let (errors, offsets) = known.draw(&mut rng);
                (s.error(&errors).0 + s.error_of_lengths(&offsets).0).norm_squared()
            })
            .sum();
        let found = (squares / f64::from(count)).sqrt();
        // the mean of `count` squares is within a few hundredths
        assert!((found / expected.position - 1.0).abs() < 0.03, "{found} {}", expected.position);
    }

    #[test]
    fn sizes_that_differ_give_nothing() {
        assert!(MachineUncertainty::new(&[1.0, 2.0], &DMatrix::identity(3, 3)).is_none());
        let known = MachineUncertainty::new(&[1.0; 9], &DMatrix::identity(9, 9)).unwrap();
        let pose = Pose::new(Vector3::new(0.0, 0.0, 4.0), Angles::from_degrees([0.0; 3]));
        assert!(known.pose_covariance(&octahedral(), &pose, &Point3::origin()).is_none());
    }
}
