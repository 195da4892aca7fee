//! The statement of a certificate, and the reasons for having none.

use num_complex::Complex64;
use thiserror::Error;

use super::cluster::ClusterCertificate;
use super::octahedral::OctahedralCertificate;
use num::ball::Disc;
use num::rounding::UnfitArithmetic;
use platform::geom::ComplexPose;

/// Signs of `(e, g)` under the mirror in `z = 0`, up to a common one.
pub const MIRROR: [f64; 8] = [1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0];

/// Entries of `R` that change sign under the mirror.
const TURNED_BY_MIRROR: [(usize, usize); 4] = [(0, 2), (1, 2), (2, 0), (2, 1)];

/// The proved reality of a root.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum ProvedReality {
    /// The root equals its complex conjugate, for every choice of the data in their intervals.
    Real,
    /// Some ratio of Study coordinates is not real.
    NonReal,
    /// Neither could be shown.
    Undecided,
}

/// Precision in which the equations had to be evaluated at the centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum CentrePrecision {
    /// Doubles sufficed.
    Double,
    /// The centre was refined, within [`NEAR`](super::NEAR), and evaluated in double-double.
    DoubleDouble,
}

/// Discs that hold the entries of `R` (row by row) and `p` (design units) of the certified root.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseEnclosure {
    /// `rotation[i][j]` holds `R_ij`.
    pub rotation: [[Disc; 3]; 3],
    /// `position[i]` holds `p_i`, design units.
    pub position: [Disc; 3],
}

impl PoseEnclosure {
    /// The twelve discs, `R` row by row, then `p`.
    pub fn discs(&self) -> impl Iterator<Item = &Disc> {
        self.rotation.iter().flatten().chain(&self.position)
    }

    /// Proves that no pose is in both.
    pub fn is_disjoint(&self, other: &Self) -> bool {
        self.discs().zip(other.discs()).any(|(x, y)| x.is_disjoint(y))
    }

    /// The centres of the discs.
    pub fn middle(&self) -> ComplexPose {
        ComplexPose {
            rotation: nalgebra::Matrix3::from_fn(|i, j| self.rotation[i][j].centre),
            position: nalgebra::Vector3::from_fn(|i, _| self.position[i].centre),
        }
    }

    fn mirror(&mut self) {
        for (i, j) in TURNED_BY_MIRROR {
            self.rotation[i][j].centre = -self.rotation[i][j].centre;
        }
        self.position[2].centre = -self.position[2].centre;
    }

    fn conjugate(&mut self) {
        for disc in self.rotation.iter_mut().flatten().chain(&mut self.position) {
            disc.centre.im = -disc.centre.im;
        }
    }
}

/// Proof that exactly one root lies near a point; made by [`certify`](super::certify) only.
///
/// Coordinates are `x = (e_0..e_3, g_0..g_3 / unit)` with `e_patch = 1`; a distance is the largest modulus of a
/// coordinate difference. For every choice of the squared lengths within their radii there is exactly one root within
/// [`uniqueness_radius`](Self::uniqueness_radius) of the centre [`centre`](Self::centre) `+` [`low`](Self::low). It is
/// regular and lies within [`radius`](Self::radius).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    pub(super) centre: [Complex64; 8],
    pub(super) low: [Complex64; 8],
    pub(super) patch: usize,
    pub(super) unit: f64,
    pub(super) radius: f64,
    /// As `radius`, but for the root of the middles of the data.
    pub(super) centre_radius: f64,
    pub(super) uniqueness_radius: f64,
    pub(super) contraction: f64,
    pub(super) reality: ProvedReality,
    pub(super) precision: CentrePrecision,
    pub(super) enclosure: PoseEnclosure,
}

impl Certificate {
    /// The doubles nearest to the centre, `g` divided by [`unit`](Self::unit).
    #[must_use]
    pub fn centre(&self) -> &[Complex64; 8] {
        &self.centre
    }

    /// The digits of the centre beyond [`centre`](Self::centre), zero where doubles sufficed.
    #[must_use]
    pub fn low(&self) -> &[Complex64; 8] {
        &self.low
    }

    /// The nearest doubles of the centre with `g` in design units.
    pub fn point(&self) -> [Complex64; 8] {
        std::array::from_fn(|k| if k < 4 { self.centre[k] } else { self.centre[k] * self.unit })
    }

    /// The certificate of the complex conjugate root. Equations and patch are real, so that conjugation maps balls
    /// about a centre to balls about its conjugate and zeros to zeros.
    #[must_use]
    pub fn conjugate(&self) -> Self {
        let mut out = *self;
        out.conjugate_in_place();
        out
    }

    /// Becomes the certificate of the mirror image `R -> S R S`, `p -> S p`, `S = diag(1, 1, -1)`, for platforms with
    /// all joints in `z = 0`. The equations are even under `(e, g) -> (e0, -e1, -e2, e3, -g0, g1, g2, -g3)`, and these
    /// changes of sign are exact.
    fn mirror(&mut self) {
        let common = if self.patch == 0 || self.patch == 3 { 1.0 } else { -1.0 };
        for (k, sign) in MIRROR.iter().enumerate() {
            self.centre[k] *= sign * common;
            self.low[k] *= sign * common;
        }
        self.enclosure.mirror();
    }

    /// [`conjugate`](Self::conjugate), without a second record.
    fn conjugate_in_place(&mut self) {
        for z in self.centre.iter_mut().chain(&mut self.low) {
            z.im = -z.im;
        }
        self.enclosure.conjugate();
    }

    /// Whether the point `(e, g)` (any scale, `g` in design units) lies in the ball in which the root is the only one.
    pub fn is_near(&self, x: &[Complex64; 8]) -> bool {
        let one = x[self.patch];
        let limit = self.uniqueness_radius * self.uniqueness_radius * one.norm_sqr();
        (0..8).all(|j| {
            let scale = if j < 4 { 1.0 } else { self.unit };
            (x[j] / scale - self.centre[j] * one).norm_sqr() <= limit
        })
    }

    /// Index of the coordinate that is 1.
    #[must_use]
    pub fn patch(&self) -> usize {
        self.patch
    }

    /// The power of two, in design units, that lengths are divided by.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    /// The root is at most this far from the centre.
    #[must_use]
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// There is no other root at most this far from the centre.
    #[must_use]
    pub fn uniqueness_radius(&self) -> f64 {
        self.uniqueness_radius
    }

    /// Lipschitz constant, below 1, of the simplified Newton map on the ball of [`radius`](Self::radius).
    #[must_use]
    pub fn contraction(&self) -> f64 {
        self.contraction
    }

    /// The proved reality of the root.
    #[must_use]
    pub fn reality(&self) -> ProvedReality {
        self.reality
    }

    /// The precision needed.
    #[must_use]
    pub fn precision(&self) -> CentrePrecision {
        self.precision
    }

    /// The enclosure of `R` and `p` of the root.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        &self.enclosure
    }
}

/// A proved root and its pose, rounded from the best approximation at hand.
#[derive(Debug, Clone, Copy)]
pub struct CertifiedPose {
    /// The pose, rounded.
    pub pose: ComplexPose,
    /// The proof.
    pub certificate: Certificate,
}

impl CertifiedPose {
    /// The mirror image in `z = 0`, see `Certificate::mirror`.
    pub fn mirrored(&self) -> Self {
        let mut out = *self;
        for (i, j) in TURNED_BY_MIRROR {
            out.pose.rotation[(i, j)] = -out.pose.rotation[(i, j)];
        }
        out.pose.position.z = -out.pose.position.z;
        out.certificate.mirror();
        out
    }

    /// The complex conjugate root.
    pub fn conjugate(&self) -> Self {
        let mut out = *self;
        for z in out.pose.rotation.iter_mut().chain(out.pose.position.iter_mut()) {
            z.im = -z.im;
        }
        out.certificate.conjugate_in_place();
        out
    }
}

/// A certificate of any kind.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant)] // plain values, kept with roots that are as large
pub enum RootCertificate {
    /// A certificate in the coordinates of dual quaternions; any six legs.
    Study(Certificate),
    /// A certificate in two squared distances; octahedral platforms.
    Octahedral(OctahedralCertificate),
    /// A certificate of two roots or more that are close or one; any six legs.
    Cluster(ClusterCertificate),
}

impl RootCertificate {
    /// The enclosure of `R` and `p` of the root.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        match self {
            Self::Study(c) => c.enclosure(),
            Self::Octahedral(c) => c.enclosure(),
            Self::Cluster(c) => c.enclosure(),
        }
    }

    /// The proved reality of the root.
    #[must_use]
    pub fn reality(&self) -> ProvedReality {
        match self {
            Self::Study(c) => c.reality(),
            Self::Octahedral(c) => c.pair().reality,
            Self::Cluster(c) => c.reality(),
        }
    }
}

impl From<Certificate> for RootCertificate {
    fn from(c: Certificate) -> Self {
        Self::Study(c)
    }
}

/// Why a pose has no certificate. None of these says that there is no root.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[non_exhaustive]
pub enum WhyUncertified {
    /// The arithmetic of this thread is not the one that the proof assumes.
    #[error(transparent)]
    Arithmetic(#[from] UnfitArithmetic),
    /// An entry of the pose is NaN or infinite.
    #[error("the pose has an entry that is not a finite number")]
    NotFinite,
    /// The data cannot be scaled exactly to order one, or a squared length is unbounded.
    #[error("the data span a range in which scaling by a power of two is not exact")]
    OutOfRange,
    /// The matrix is not, up to `NEAR`, the rotation of any quaternion.
    #[error("the matrix is not a rotation: it is {distance:e} away from that of its quaternion")]
    NotARotation {
        /// Largest entry difference, relative to the larger of 1 and the largest entry; infinite when there is no
        /// quaternion.
        distance: f64,
    },
    /// The Jacobian at the centre has no approximate inverse.
    #[error("the Jacobian is singular to working precision")]
    SingularJacobian,
    /// The approximate inverse is not accurate enough to prove the Jacobian regular.
    #[error("the Jacobian is too ill-conditioned: |I - Y J| is only known to be below {defect:e}")]
    IllConditioned {
        /// Bound of `|I - Y J|`, not below 1.
        defect: f64,
    },
    /// The Newton step at the centre is longer than `NEAR`: the pose is not accurate to half the digits of a double.
    #[error("the pose is not an accurate approximation: the Newton step is {step:e}")]
    Inaccurate {
        /// Length of the step, or the bound of it.
        step: f64,
    },
    /// No ball about the centre is mapped into itself: no root here, another one too close, or data too uncertain.
    #[error("the Newton map contracts no ball: step {step:e} against an admissible {admissible:e}")]
    NoContraction {
        /// Bound of the Newton step, width of the data included.
        step: f64,
        /// The step up to which a ball would contract, `(1 - |I - Y J|)^2 / (4 |Y Q|)`.
        admissible: f64,
    },
    /// The root is proved, but its `R` or `p` need not be that of the pose to half the digits of a double.
    #[error("R or p of the root may be {distance:e} away from those of the pose")]
    Deviation {
        /// Bound of the distance. For `R` it is relative to the larger of 1 and the largest entry. For `p` it is
        /// relative to the larger of the design's size and the largest entry.
        distance: f64,
    },
    /// `e.e` may be zero in the ball, where there is no pose.
    #[error("e.e may vanish in the enclosure, which is not a finite pose")]
    RotationUndefined,
}

/// A certificate, or why there is none.
#[derive(Debug, Clone, Copy, PartialEq)]
#[allow(clippy::large_enum_variant)] // both are plain values on the stack, made by the dozen
pub enum CertificateOutcome {
    /// The proof.
    Certified(Certificate),
    /// No proof.
    Absent(WhyUncertified),
}

impl CertificateOutcome {
    /// The certificate, if there is one.
    #[must_use]
    pub fn certificate(&self) -> Option<&Certificate> {
        match self {
            Self::Certified(c) => Some(c),
            Self::Absent(_) => None,
        }
    }
}
