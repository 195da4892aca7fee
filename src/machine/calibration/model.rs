//! Joints and offsets of a machine, the lengths that follow from them, and the choice of unknown coordinates.

use nalgebra::{DMatrix, DVector, Matrix6, Point3, Vector3, Vector6};

use platform::geom::Pose;
use platform::manipulator::{Body, InvalidManipulator, Manipulator};

/// The joints and offsets that determine the lengths a machine shows: `l_i = |R b_i + p - a_i| + d_i`.
#[derive(Debug, Clone, PartialEq)]
pub struct LegModel {
    /// Base joints `a`, base frame.
    pub base: Vec<Point3<f64>>,
    /// Platform joints `b`, platform frame.
    pub platform: Vec<Point3<f64>>,
    /// Base and platform joint of each leg.
    pub pairs: [(usize, usize); 6],
    /// `d_i`: the shown length minus the distance of the joints, design units.
    pub offsets: [f64; 6],
}

impl LegModel {
    /// The joints of a manipulator with offsets.
    #[must_use]
    pub fn new(m: &Manipulator, offsets: [f64; 6]) -> Self {
        Self {
            base: m.base_joints().to_vec(),
            platform: m.platform_joints().to_vec(),
            pairs: m.pairs(),
            offsets,
        }
    }

    /// The joints as a manipulator.
    ///
    /// # Errors
    /// [`InvalidManipulator`]: coordinates that are not finite or too large.
    pub fn manipulator(&self) -> Result<Manipulator, InvalidManipulator> {
        Manipulator::try_new(self.base.clone(), self.platform.clone(), self.pairs)
    }

    /// The vector from base joint to platform joint of a leg, base frame.
    fn line(&self, leg: usize, pose: &Pose) -> Vector3<f64> {
        let (a, b) = self.pairs[leg];
        pose.transform(&self.platform[b]) - self.base[a]
    }

    /// The lengths shown at a pose.
    #[must_use]
    pub fn lengths(&self, pose: &Pose) -> [f64; 6] {
        std::array::from_fn(|leg| self.line(leg, pose).norm() + self.offsets[leg])
    }

    /// Rows `[u_i, (R b_i) x u_i]`: the derivatives of the lengths by a shift of the platform origin and a small
    /// rotation about it, base frame.
    pub(super) fn pose_sensitivity(&self, pose: &Pose) -> Matrix6<f64> {
        let mut out = Matrix6::zeros();
        for leg in 0..6 {
            let u = self.direction(leg, pose);
            let arm = pose.rotation * self.platform[self.pairs[leg].1].coords;
            out.fixed_view_mut::<1, 3>(leg, 0).copy_from(&u.transpose());
            out.fixed_view_mut::<1, 3>(leg, 3).copy_from(&arm.cross(&u).transpose());
        }
        out
    }

    /// The unit vector along a leg; zero for a leg of length zero.
    fn direction(&self, leg: usize, pose: &Pose) -> Vector3<f64> {
        self.line(leg, pose).try_normalize(0.0).unwrap_or_default()
    }

    /// Derivatives of the six lengths by the unknowns: `-u^T` for the base joint, `u^T R` for the platform joint, 1 for
    /// the offset.
    pub(super) fn sensitivity(&self, unknowns: &Unknowns, pose: &Pose) -> DMatrix<f64> {
        let mut out = DMatrix::zeros(6, unknowns.count());
        for leg in 0..6 {
            let u = self.direction(leg, pose);
            let (a, b) = self.pairs[leg];
            let in_platform = pose.rotation.inverse() * u;
            for (at, row) in [(unknowns.base[a], -u), (unknowns.platform[b], in_platform)] {
                if let Some(column) = at {
                    out.fixed_view_mut::<1, 3>(leg, column).copy_from(&row.transpose());
                }
            }
            if let Some(column) = unknowns.offsets[leg] {
                out[(leg, column)] = 1.0;
            }
        }
        out
    }

    /// The measured lengths minus those of the model.
    pub(super) fn residual(&self, measurement: &Measurement) -> Vector6<f64> {
        let lengths = self.lengths(&measurement.pose);
        Vector6::from_fn(|leg, _| measurement.lengths[leg] - lengths[leg])
    }

    /// The model with the unknowns changed by `step`.
    pub(super) fn stepped(&self, unknowns: &Unknowns, step: &DVector<f64>) -> Self {
        let mut out = self.clone();
        for (joints, columns) in [(&mut out.base, &unknowns.base), (&mut out.platform, &unknowns.platform)] {
            for (joint, column) in joints.iter_mut().zip(columns) {
                if let Some(column) = column {
                    *joint += Vector3::from_fn(|k, _| step[column + k]);
                }
            }
        }
        for (offset, column) in out.offsets.iter_mut().zip(unknowns.offsets) {
            if let Some(column) = column {
                *offset += step[column];
            }
        }
        out
    }

    /// The values of the unknowns.
    pub(super) fn values(&self, unknowns: &Unknowns) -> DVector<f64> {
        DVector::from_iterator(
            unknowns.count(),
            unknowns.list().iter().map(|unknown| match *unknown {
                Unknown::Joint { body, joint, axis } => body.of((&self.base, &self.platform))[joint][axis],
                Unknown::Offset { leg } => self.offsets[leg],
            }),
        )
    }
}

/// A pose with the lengths that were measured at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measurement {
    /// The pose, as it was measured.
    pub pose: Pose,
    /// The lengths that the machine showed. An encoder may count from anywhere: they need not be positive.
    pub lengths: [f64; 6],
}

/// Groups of parameters that the calibration keeps fixed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct HeldParts {
    /// The joints of the base.
    pub base: bool,
    /// The joints of the platform.
    pub platform: bool,
    /// The leg offsets.
    pub offsets: bool,
}

/// One unknown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// A coordinate of a joint, frame of its body.
    Joint {
        /// The body.
        body: Body,
        /// Index of the joint.
        joint: usize,
        /// 0, 1, 2: x, y, z.
        axis: usize,
    },
    /// The offset of a leg.
    Offset {
        /// Index of the leg.
        leg: usize,
    },
}

/// The unknowns and their columns: base joints, platform joints, offsets. A joint that two legs share is one joint; one
/// without legs is no unknown.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unknowns {
    /// First of three columns of each joint.
    base: Vec<Option<usize>>,
    platform: Vec<Option<usize>>,
    offsets: [Option<usize>; 6],
    list: Vec<Unknown>,
}

impl Unknowns {
    /// The unknowns of a model, without the held parts.
    #[must_use]
    pub fn new(model: &LegModel, held: HeldParts) -> Self {
        let mut list = Vec::new();
        let mut columns = |body: Body, count: usize, held: bool| -> Vec<Option<usize>> {
            let used = |joint: usize| model.pairs.iter().any(|pair| body.of(*pair) == joint);
            (0..count)
                .map(|joint| {
                    (used(joint) && !held).then(|| {
                        list.extend((0..3).map(|axis| Unknown::Joint { body, joint, axis }));
                        list.len() - 3
                    })
                })
                .collect()
        };
        let base = columns(Body::Base, model.base.len(), held.base);
        let platform = columns(Body::Platform, model.platform.len(), held.platform);
        let mut offsets = [None; 6];
        if !held.offsets {
            for (leg, column) in offsets.iter_mut().enumerate() {
                *column = Some(list.len());
                list.push(Unknown::Offset { leg });
            }
        }
        Self { base, platform, offsets, list }
    }

    /// The number of unknowns.
    #[must_use]
    pub fn count(&self) -> usize {
        self.list.len()
    }

    /// All unknowns, in the order of their columns.
    #[must_use]
    pub fn list(&self) -> &[Unknown] {
        &self.list
    }

    /// The first columns of all joints of a body that are unknown.
    pub(super) fn joint_columns(&self, body: Body) -> impl Iterator<Item = usize> + '_ {
        body.of((&self.base, &self.platform)).iter().copied().flatten()
    }

    /// The first of the three columns of a joint; `None` where it is held or carries no leg.
    #[must_use]
    pub fn joint(&self, body: Body, joint: usize) -> Option<usize> {
        body.of((&self.base, &self.platform)).get(joint).copied().flatten()
    }

    /// The column of the offset of a leg; `None` where offsets are held.
    #[must_use]
    pub fn offset(&self, leg: usize) -> Option<usize> {
        self.offsets.get(leg).copied().flatten()
    }
}
