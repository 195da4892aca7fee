//! Certificates of forward-kinematics roots: interval proofs that share no code with any solver.
//!
//! A pose is a point `x = (e, g)` of dual quaternions with `g = p e`; six leg equations
//! `|g + e b_i - a_i e|^2 = s_i e.e`, the Study quadric `e.g = 0` and the patch `e_k = 1` (largest coordinate) make seven
//! quadrics in seven unknowns. The simplified Newton map with an approximate inverse `Y` of the Jacobian is shown to contract a ball
//! (Krawczyk 1969 in the norm-wise form of Kantorovich; Breiding, Rose, Timme 2020 for certifying solutions of
//! polynomial systems). Statement, proof and all rounding bounds: `docs/theory/certificates.md` and the sources of
//! the submodules. Joints enter as the exact doubles they are, squared lengths with all their digits and a radius ([`SquareData`]).
//!
//! ```
//! use equipod::methods::geom::{ComplexPose, Pose};
//! use equipod::methods::manipulator::{Leg, Manipulator};
//! use equipod::methods::solve::certify::{ProvedReality, certify};
//! use nalgebra::{Point3, Rotation3, Vector3};
//! let legs = std::array::from_fn(|i| {
//!     let t = f64::from(i as u8);
//!     let base = Point3::new(2.0 * t.cos(), 2.0 * t.sin(), 0.3 * t);
//!     Leg { base, platform: Point3::new((2.0 * t).cos(), (1.3 * t).sin(), 0.1 * t * t) }
//! });
//! let m = Manipulator::from_legs(legs)?;
//! let rotation = Rotation3::from_euler_angles(0.3, -0.2, 0.7);
//! let pose = Pose { rotation, position: Vector3::new(0.1, 0.4, 1.5) };
//! let s = pose.squared_lengths(&m).ok_or("overflow")?;
//! let outcome = certify(&m, &s, &ComplexPose::from(pose));
//! let certificate = outcome.certificate().ok_or("no certificate")?;
//! assert_eq!(certificate.reality(), ProvedReality::Real);
//! assert!(certificate.radius() < 1e-12);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod apart;
mod centre;
mod certificate;
mod data;
mod differences;
mod distinct;
mod inverse;
mod krawczyk;
pub mod octahedral;
mod point;
mod precisely;
mod refine;
mod second_order;
mod system;

pub use certificate::{
    CentrePrecision, Certificate, CertificateOutcome, PoseEnclosure, ProvedReality, RootCertificate,
    WhyUncertified,
};
pub use data::SquareData;
pub use distinct::{Distinctness, RootRelation, distinct, relation};
pub(crate) use point::{CertifiedPose, dual_quaternion};
pub use refine::RefinedPose;

use num_complex::Complex64;

use crate::geom::ComplexPose;
use crate::manipulator::Manipulator;
use crate::num::disc::UP;
use crate::num::double_double::DoubleDouble;
use centre::{deviation, enclose_pose, enclose_pose_widely, pose_of, rotation_distance, study_of};
use krawczyk::{Centre, Contraction, contract, contract_sharply};
use refine::refine_study;
use system::{LegSystem, Study};

/// How accurate a pose must be to be certified: `2^-26`, half of the digits of a double.
///
/// The Newton map contracts on balls far wider than that, so that a proof alone would also go to poses which are wrong in the
/// sixth digit. A certificate shall say that the pose *is* the root to the accuracy of its digits. Measured twice: the Newton step in Study coordinates with
/// `e_k = 1` and lengths divided by [`Certificate::unit`]; and the distance of the entries of the pose from all points of the enclosure, for `R` relative to the
/// larger of 1 and the largest entry, for `p` relative to the larger of the unit and the largest entry.
pub const NEAR: f64 = 1.0 / (1u32 << 26) as f64;

/// How wide an enclosure may be, in the measure of [`NEAR`], where `e.e` is so small that double-double does not give `R` and `p` to `NEAR`. The pose is then the middle of
/// it, and the enclosure says which digits it has.
pub const FAR_OUT: f64 = 1.0 / (1u32 << 10) as f64;

/// A pose this near to the middle of its enclosure is the middle, rounded.
const ROUNDED: f64 = 1.0 / (1u64 << 40) as f64;

/// One problem, scaled once and ready to certify any number of roots.
#[derive(Debug, Clone)]
pub struct Certifier(LegSystem);

impl Certifier {
    /// Prepares `m` with the squared leg lengths `s`: [`SquaredLegLengths`](crate::manipulator::SquaredLegLengths) or intervals (design units squared).
    ///
    /// # Errors
    /// [`WhyUncertified::OutOfRange`] when the data cannot be scaled exactly.
    pub fn new(m: &Manipulator, s: impl Into<SquareData>) -> Result<Self, WhyUncertified> {
        LegSystem::new(m, &s.into()).map(Self)
    }

    /// Proves that the pose approximates exactly one root, see [`Certificate`]; the centre is the pose as
    /// given. Only when doubles do not suffice is it refined in double-double, by no more than [`NEAR`].
    #[must_use]
    pub fn certify(&self, pose: &ComplexPose) -> CertificateOutcome {
        match self.try_certify(pose) {
            Ok(certificate) => CertificateOutcome::Certified(certificate),
            Err(why) => CertificateOutcome::Absent(why),
        }
    }

    fn try_certify(&self, pose: &ComplexPose) -> Result<Certificate, WhyUncertified> {
        let x = study_of(pose, self.0.unit())?;
        let double = Centre { hi: &x, full: None };
        let quick = contract(&self.0, &double, NEAR)
            .and_then(|c| Self::build(&self.0, &double, &c))
            .and_then(|c| self.accurate(pose, &c));
        let why = match quick {
            Ok(certificate) => return Ok(certificate),
            Err(why) => why,
        };
        let refined = refine_study(&self.0, &x, NEAR).map_err(|_| why)?;
        let hi = refined.x.rounded();
        let centre = Centre { hi: &hi, full: Some(&refined.x) };
        let certificate = Self::build(&self.0, &centre, &contract_sharply(&self.0, &centre)?)?;
        self.accurate(pose, &certificate)
    }

    /// The certificate when the pose is its root, for the middles of the data, to within [`NEAR`] in `R` and `p`; or, far out, the middle of an enclosure not wider than
    /// [`FAR_OUT`].
    fn accurate(&self, pose: &ComplexPose, c: &Certificate) -> Result<Certificate, WhyUncertified> {
        let own =
            if c.centre_radius < c.radius { Self::enclose(c, c.centre_radius) } else { Some(c.enclosure) };
        let enclosure = own.ok_or(WhyUncertified::RotationUndefined)?;
        let distance = rotation_distance(pose, &enclosure);
        if !(distance <= NEAR) {
            return Err(WhyUncertified::NotARotation { distance });
        }
        let unit = self.0.unit();
        let distance = deviation(pose, &enclosure, unit, false);
        let is_middle = || deviation(pose, &enclosure, unit, true) <= ROUNDED;
        let far_out = distance <= FAR_OUT && c.precision == CentrePrecision::DoubleDouble && is_middle();
        if distance <= NEAR || far_out { Ok(*c) } else { Err(WhyUncertified::Deviation { distance }) }
    }

    /// Encloses `R` and `p` over the ball of `radius` about the centre.
    fn enclose(c: &Certificate, radius: f64) -> Option<PoseEnclosure> {
        match c.precision {
            CentrePrecision::Double => enclose_pose(&c.centre, c.patch, radius, c.unit),
            CentrePrecision::DoubleDouble => enclose_pose_widely(&c.centre, &c.low, c.patch, radius, c.unit),
        }
    }

    fn build(system: &LegSystem, x: &Centre<'_>, c: &Contraction) -> Result<Certificate, WhyUncertified> {
        let centre: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(x.hi.re[j], x.hi.im[j]));
        let tail =
            |f: &Study<DoubleDouble>| std::array::from_fn(|j| Complex64::new(f.re[j].lo(), f.im[j].lo()));
        let low: [Complex64; 8] = x.full.map_or([Complex64::ZERO; 8], tail);
        let (patch, radius, uniqueness_radius) = (x.hi.patch, c.radius, c.uniqueness_radius);
        let unit = system.unit();
        let enclosure = match x.full {
            None => enclose_pose(&centre, patch, radius, unit),
            Some(_) => enclose_pose_widely(&centre, &low, patch, radius, unit),
        };
        let enclosure = enclosure.ok_or(WhyUncertified::RotationUndefined)?;
        let precision =
            if x.full.is_some() { CentrePrecision::DoubleDouble } else { CentrePrecision::Double };
        Ok(Certificate {
            centre,
            low,
            patch,
            unit,
            radius,
            centre_radius: c.centre_radius,
            uniqueness_radius,
            contraction: c.lipschitz,
            reality: reality(x, c),
            precision,
            enclosure,
        })
    }

    /// Newton in double-double from the pose, as far as it leads: about `2^-102` times the condition of the root.
    ///
    /// # Errors
    /// When the iteration meets a singular Jacobian or does not settle.
    pub fn refine(&self, pose: &ComplexPose) -> Result<RefinedPose, WhyUncertified> {
        let start = study_of(pose, self.0.unit())?;
        let end = refine_study(&self.0, &start, f64::INFINITY)?;
        let (rotation, position) = pose_of(&end.x, self.0.unit());
        Ok(RefinedPose { rotation, position, moved: end.moved, last_step: end.last_step, steps: end.steps })
    }
}

/// The system and the patch are real, so the conjugate of a root is one. It is at most `radius + 2 |im c|` from the
/// centre; within the uniqueness ball it is the root itself. A coordinate whose disc holds no real number proves the contrary.
fn reality(x: &Centre<'_>, c: &Contraction) -> ProvedReality {
    // the digits beyond double change a coordinate by less than 2^-53 of itself
    let largest = x.hi.im.iter().fold(0.0_f64, |m, y| m.max(y.abs()));
    if (c.radius + 2.0 * largest) * UP <= c.uniqueness_radius {
        ProvedReality::Real
    } else if largest * (2.0 - UP) > c.radius {
        ProvedReality::NonReal
    } else {
        ProvedReality::Undecided
    }
}

/// [`Certifier::certify`] for a single pose.
#[must_use]
pub fn certify(m: &Manipulator, s: impl Into<SquareData>, pose: &ComplexPose) -> CertificateOutcome {
    match Certifier::new(m, s) {
        Ok(certifier) => certifier.certify(pose),
        Err(why) => CertificateOutcome::Absent(why),
    }
}

/// [`Certifier::refine`] for a single pose.
///
/// # Errors
/// As [`Certifier::new`] and [`Certifier::refine`].
pub fn refine(
    m: &Manipulator,
    s: impl Into<SquareData>,
    pose: &ComplexPose,
) -> Result<RefinedPose, WhyUncertified> {
    Certifier::new(m, s)?.refine(pose)
}
