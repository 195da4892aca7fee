//! The octic for control loops: all sixteen poses side by side, without allocation.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::Vector3;
use num_complex::Complex64;

use super::OcticProblem;
use super::factors::Gram;
use super::lanes::{Corners, PoseLanes, SEPARATE};
use super::parallel::ParallelSides;
use crate::collect::pose_scale;
use crate::newton::refine;
use crate::solve::certify::octahedral::{
    OctahedralCertificate, OctahedralCertificates, OctahedralCertifier, PairCertificate,
};
use crate::{FkError, Method};
use num::batch::LANES;
use num::vector_unit::on_vector_unit;
use platform::geom::{ComplexPose, reorthogonalised};
use platform::manipulator::{Manipulator, Octahedral, SquaredLegLengths};

/// Largest residual of a pose that is returned.
const RESIDUAL: f64 = 1e-12;

/// Forward kinematics of one octahedral design; made once, a solve allocates nothing.
///
/// ```
/// # mod equipod {
/// #     pub use equipod_fk::*;
/// #     pub mod methods {
/// #         pub use equipod_fk as fk; pub use equipod_fk::solve;
/// #         pub use platform::{geom, manipulator};
/// #     }
/// # }
/// use equipod::methods::fk::OcticSolver;
/// use equipod::methods::manipulator::{LegLengths, Manipulator};
/// use nalgebra::Point3;
/// let triangle = |r: f64| {
///     let h = 0.75f64.sqrt() * r;
///     vec![Point3::new(0.0, 0.0, 0.0), Point3::new(r / 2.0, h, 0.0), Point3::new(r, 0.0, 0.0)]
/// };
/// let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
/// let m = Manipulator::try_new(triangle(12.0), triangle(6.0), legs)?;
/// let s = LegLengths::try_new([19.8, 18.0, 18.0, 17.0, 14.9, 17.8])?.squared();
/// let found = OcticSolver::new(&m)?.solve(&s).ok_or("degenerate lengths")?;
/// let real = found.poses.iter().filter(|p| p.imaginary_size(m.size()) < 1e-9).count();
/// assert_eq!((found.poses.len(), real), (16, 12));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct OcticSolver {
    manipulator: Manipulator,
    pub(super) size: f64,
    /// Leg of the design at each place of the cycle.
    order: [usize; 6],
    pub(super) base: FramedTriangle,
    pub(super) platform: FramedTriangle,
    /// Corners in the design's frames over its size.
    pub(super) base_corners: [Vector3<f64>; 3],
    pub(super) platform_corners: [Vector3<f64>; 3],
    pub(super) base_gram: Gram,
    /// The Gram matrix of the platform triangle as `P5 P6 P4`.
    pub(super) turned_gram: Gram,
    pub(super) parallel: [ParallelSides; 4],
    /// Absent where the joints cannot be scaled exactly.
    certifier: Option<OctahedralCertifier>,
}

/// A triangle in a frame of its own: corners `(0, 0)`, `(b, 0)`, `(u, v)`; rows of `axes` are the frame.
#[derive(Debug, Clone)]
pub(super) struct FramedTriangle {
    pub(super) b: f64,
    pub(super) u: f64,
    pub(super) v: f64,
    pub(super) axes: [[f64; 3]; 3],
}

impl FramedTriangle {
    fn of(p: &[Vector3<f64>; 3]) -> Self {
        let (side, other) = (p[1] - p[0], p[2] - p[0]);
        let b = side.norm();
        let x = side / b;
        let u = other.dot(&x);
        let rest = other - x * u;
        let v = rest.norm();
        let y = rest / v;
        Self { b, u, v, axes: [x.into(), y.into(), x.cross(&y).into()] }
    }
}

/// All sixteen poses: entry `2 k + 1` is the mirror image of entry `2 k` in the planes of both triangles.
#[derive(Debug, Clone, PartialEq)]
pub struct OcticPoses {
    /// The poses.
    pub poses: [ComplexPose; 2 * LANES],
    /// Squared distances `(s15, s34)` of the pairs, design units squared.
    pub pairs: [[Complex64; 2]; LANES],
    /// The residual of each pose, as [`ComplexPose::residual`].
    pub residuals: [f64; 2 * LANES],
    /// The largest of them, each over the square of the pose's own numbers where these exceed 1.
    pub residual: f64,
}

/// A solve with the vector units that the machine turns out to have; the results are the same on all.
struct Solve<'a> {
    solver: &'a OcticSolver,
    s: &'a SquaredLegLengths,
}

impl pulp::WithSimd for Solve<'_> {
    type Output = Option<OcticPoses>;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Option<OcticPoses> {
        self.solver.solve_lanes(self.s)
    }
}

impl OcticSolver {
    /// Prepares an octahedral design; only coordinates count, not whether joints are named as shared (unless they are
    /// known between bounds only).
    ///
    /// # Errors
    /// [`FkError::NotApplicable`] when it is not octahedral.
    pub fn new(m: &Manipulator) -> Result<Self, FkError> {
        let refuse = |reason: String| FkError::NotApplicable { method: Method::Octic, reason };
        let octahedral = Octahedral::recognise(&m.with_merged_joints()).map_err(|e| refuse(e.to_string()))?;
        let size = m.size();
        let base_corners = octahedral.base().map(|p| p.coords / size);
        let platform_corners = octahedral.platform().map(|p| p.coords / size);
        let (base, platform) = (FramedTriangle::of(&base_corners), FramedTriangle::of(&platform_corners));
        Ok(Self {
            manipulator: m.clone(),
            size,
            order: octahedral.order().map(platform::manipulator::LegIndex::get),
            parallel: ParallelSides::all(&base, &platform),
            base,
            platform,
            base_gram: Gram::of(base_corners.each_ref()),
            turned_gram: Gram::of([&platform_corners[1], &platform_corners[2], &platform_corners[0]]),
            base_corners,
            platform_corners,
            certifier: OctahedralCertifier::new(&octahedral).ok(),
        })
    }

    /// Proofs for the poses that [`solve`](Self::solve) gave for the same lengths: existence, uniqueness, reality of
    /// each pair, and that all sixteen are distinct. Allocates nothing.
    #[must_use]
    pub fn certify(&self, s: &SquaredLegLengths, found: &OcticPoses) -> OctahedralCertificates {
        let none = OctahedralCertificates { pairs: [None; LANES], complete: false };
        let Some(certifier) = &self.certifier else { return none };
        certifier.certify(s, &found.poses)
    }

    /// The certificate of pose `2k` (or `2k + 1`, the mirror image) of pair `k` of those that
    /// [`certify`](Self::certify) proved.
    #[must_use]
    pub fn certificate(
        &self,
        pair: &PairCertificate,
        pose: &ComplexPose,
        mirrored: bool,
    ) -> Option<OctahedralCertificate> {
        self.certifier.as_ref().map(|c| c.of_pose(pair, pose, mirrored))
    }

    /// All sixteen finite complex poses, or `None` when these lengths need the general treatment of
    /// [`Octic`](super::Octic).
    ///
    /// They do when poses nearly coincide, roots lie at infinity, the corners of a pose lie in one plane, or a residual
    /// exceeds `1e-12`.
    #[must_use]
    pub fn solve(&self, s: &SquaredLegLengths) -> Option<OcticPoses> {
        on_vector_unit(Solve { solver: self, s })
    }

    /// Squared lengths over the squared size, in the order s14 s24 s25 s35 s36 s16.
    #[inline(always)]
    pub(super) fn scaled(&self, s: &SquaredLegLengths) -> [f64; 6] {
        let scale = (self.size * self.size).recip();
        let given = s.get();
        self.order.map(|i| given[i] * scale)
    }

    #[inline(always)]
    fn solve_lanes(&self, s: &SquaredLegLengths) -> Option<OcticPoses> {
        let scaled = self.scaled(s);
        for start in self.starts(&scaled) {
            let near = self.start(&start, &scaled);
            let corners = near.and_then(|near| self.continued(&near, start.beside.as_ref(), &scaled));
            let found = corners.and_then(|corners| self.placed(s, &scaled, &corners));
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// The poses of corners and pairs, where their residuals are small.
    #[inline(always)]
    fn placed(&self, s: &SquaredLegLengths, scaled: &[f64; 6], found: &Corners) -> Option<OcticPoses> {
        let (corners, x, y) = found;
        let frame = self.frame(corners);
        let PoseLanes { mut poses, mut residuals, scales } = self.place(scaled, &corners[0], &frame);
        let mut worst = 0.0;
        for k in 0..2 * LANES {
            let square = scales[k] * scales[k];
            if !(residuals[k] <= RESIDUAL * square) {
                residuals[k] = self.improve(s, &mut poses[k])?;
            }
            worst = f64::max(worst, residuals[k] / square);
        }
        let unit = self.size * self.size;
        let pairs = std::array::from_fn(|k| [x.lane(k) * unit, y.lane(k) * unit]);
        Some(OcticPoses { poses, pairs, residuals, residual: worst })
    }

    /// Newton's method on the leg equations; the residual then, or `None` when it stays too large or the pose was not
    /// near its root.
    #[cold]
    fn improve(&self, s: &SquaredLegLengths, pose: &mut ComplexPose) -> Option<f64> {
        let scale = pose_scale(pose, self.size);
        // Newton's method keeps R^T R as it is, so that is put right first
        let rotation = reorthogonalised(&pose.rotation);
        let next = refine(&self.manipulator, s, &ComplexPose { rotation, ..*pose });
        let residual = next.residual(&self.manipulator, s);
        let near = next.distance(pose, self.size) <= SEPARATE * scale;
        if !(near && residual <= RESIDUAL * scale * scale) {
            return None;
        }
        *pose = next;
        Some(residual)
    }

    pub(super) fn manipulator(&self) -> &Manipulator {
        &self.manipulator
    }

    /// The same numbers for the general treatment.
    pub(super) fn problem(&self, s: &SquaredLegLengths) -> OcticProblem {
        let (base, platform, given) = (self.base_corners, self.platform_corners, s.get());
        let scale = (self.size * self.size).recip();
        OcticProblem { base, platform, s: self.order.map(|i| given[i] * scale), size: self.size }
    }
}
