//! Certificates of forward-kinematics roots: interval proofs that share no code with any solver.
//!
//! A pose is a point `x = (e, g)` of dual quaternions with `g = p e`. Seven quadrics in seven unknowns hold for it: six
//! leg equations `|g + e b_i - a_i e|^2 = s_i e.e` and the Study quadric `e.g = 0`, with the patch `e_k = 1` (largest
//! coordinate). The certificate shows that the simplified Newton map with an approximate inverse `Y` of the Jacobian
//! contracts a ball. Sources: Krawczyk 1969 in the norm-wise form of Kantorovich; Breiding, Rose, Timme 2020 for
//! certifying solutions of polynomial systems. Statement, proof and all rounding bounds: `docs/theory/certificates.md`
//! and the sources of the submodules. Joints enter as the exact doubles they are, squared lengths with all their digits
//! and a radius ([`SquareData`]).
//!
//! # What is decided, and by what
//!
//! ```text
//!   callers:    certify(pose)              root_near(start)            relation(a, b)   distinct(list)
//!                    |                          |                            |________________|
//!                    |   pose_is_the_root  <----+----> refine                |
//!                    |          ^               |                   enclosures of R, p and x,
//!                    +----------+               |                   balls of uniqueness
//!                    |                          |
//!                    +------> certificate_about(centre) <------+
//!                               |               |
//!                      one_root_about       enclose, reality
//!                               |
//!                        holds_one_root      the theorem, on three bounds |Y F|, |I - Y J|, |Y Q|
//!                       ________|_________________
//!                      |            |             |
//!                   krawczyk   differences     octuple     the bounds: on the equations as they are, on their
//!                                                          differences, with 256 bits
//! ```
//!
//! Each function below decides the question that follows its name.
//!
//! * [`Certifier::certify`]: is this pose, as given, exactly one root to half of the digits of a double? It uses
//!   `certificate_about`, then `pose_is_the_root`. The centre is the pose, refined by at most [`NEAR`] when doubles do
//!   not suffice. Otherwise [`WhyUncertified`], which does not mean that there is no root.
//! * `Certifier::root_near`: is there exactly one root where Newton's method leads from a start, and which pose is it?
//!   The same theorem holds about the end of the iteration, which a `NewtonStart` limits. A root further away is not
//!   sought.
//! * `certificate_about`: does a ball about the centre hold exactly one root, with finite `R` and `p` in known discs?
//!   Is the root real? It uses `one_root_about`, disc arithmetic over the ball, in which `e.e` must not vanish, and
//!   conjugation for reality. Reality has an [`Undecided`](ProvedReality::Undecided) of its own.
//! * `one_root_about`: does a ball about the centre hold exactly one root? It uses the contraction theorem of
//!   `krawczyk.rs`. The centre is finite, on its patch, with a Newton step of at most [`NEAR`]. If no ball contracts,
//!   there is no root, there are two close ones, or data or digits are not good enough.
//! * `pose_is_the_root`: has the pose the digits of the certified root? Its distance from all points of the enclosure
//!   is at most [`NEAR`]. Otherwise the root is proved, but is not shown to be this pose.
//! * `Certifier::clusters_near`: do exactly so many roots, two or more, counted with multiplicity, lie near this pose?
//!   It uses the bordered equations and Rouche's theorem of `cluster.rs`. The Jacobian has one small singular value.
//! * [`is_of()`]: is a certified root one of a cluster? It is when it lies in the ball in which the roots of the
//!   cluster are the only ones. Otherwise it may be or not.
//! * [`relation()`], [`distinct()`]: are two certified roots of one problem different, or one? They are different when
//!   enclosures are disjoint, and one when an enclosure lies in the other's ball of uniqueness. Otherwise enclosures
//!   overlap: [`RootRelation::Undecided`].
//!
//! [`Certifier::refine`] proves nothing: it is Newton's method in double-double. Octahedral platforms have a
//! certificate of all sixteen poses at once, [`octahedral`]. Outside this folder [`Certifier::certify`] certifies a
//! root whose pose is certified as it is. `root_near` finds the best pose with its proof.
//!
//! ```
//! # mod equipod { pub mod methods { pub use equipod_fk::solve; pub use platform::{geom, manipulator}; } }
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

mod certificate;
mod cluster;
mod coordinates;
mod differences;
mod distinct;
pub(crate) mod far;
mod inverse;
mod krawczyk;
pub mod octahedral;
mod octuple;
#[cfg(test)]
mod radii_tests;
mod refine;
mod second_order;
mod side_by_side;
mod system;

pub use certificate::{
    CentrePrecision, Certificate, CertificateOutcome, PoseEnclosure, ProvedReality, RootCertificate,
    WhyUncertified,
};
pub use certificate::{CertifiedPose, MIRROR};
pub use cluster::ClusterCertificate;
pub use coordinates::dual_quaternion;
pub(crate) use distinct::overlapping_pairs;
pub use distinct::{Distinctness, RootRelation, distinct, is_of, relation};
pub(crate) use distinct::{cluster_is_captured_by, is_captured_by};
pub use refine::RefinedPose;
pub use system::SquareData;

use num_complex::Complex64;

pub(crate) use cluster::ProvedCluster;
use cluster::clusters_near;
use coordinates::{
    PrecisePoint, deviation, enclose_pose, enclose_pose_widely, pose_in_double, pose_of, rotation_distance,
    rounded_pose, study_at, study_of,
};
use krawczyk::{Centre, Digits, RootBall, newton_step, one_root_about};
use num::ball::UP;
use num::batch::LANES;
use num::double_double::DoubleDouble;
use num::octuple::ComplexOctuple;
use num::vector_unit::on_vector_unit;
use platform::geom::ComplexPose;
use platform::manipulator::Manipulator;
use refine::refine_study;
use side_by_side::EightPoints;
use system::{LegSystem, RealScalar, Study};

/// The accuracy that a pose must have to be certified: `2^-26`, half of the digits of a double.
///
/// The Newton map contracts on balls far wider than that. A proof alone would also go to poses which are wrong in the
/// sixth digit. A certificate shall say that the pose *is* the root to the accuracy of its digits. Two distances are
/// measured:
///
/// * the Newton step in Study coordinates with `e_k = 1` and lengths divided by [`Certificate::unit`];
/// * the distance of the entries of the pose from all points of the enclosure. For `R` it is relative to the larger of
///   1 and the largest entry. For `p` it is relative to the larger of the unit and the largest entry.
pub const NEAR: f64 = 1.0 / (1u32 << 26) as f64;

/// The largest width of an enclosure, in the measure of [`NEAR`]. It applies when `e.e` is so small that double-double
/// does not give `R` and `p` to `NEAR`. The pose is then the middle of the enclosure, whose width shows the valid
/// digits.
pub const FAR_OUT: f64 = 1.0 / (1u32 << 10) as f64;

/// A pose this near to the middle of its enclosure is the middle, rounded.
const ROUNDED: f64 = 1.0 / (1u64 << 40) as f64;

/// Points with smaller `|g|` gain nothing from a larger unit of length.
const CLOSE: f64 = 64.0;
/// Powers of two by which the unit is enlarged beyond `|g|`.
const FLATTER: [i32; 4] = [0, 5, 10, 15];

/// The start of Newton's method, and the distance that it may lead.
#[derive(Debug, Clone, Copy)]
pub(crate) enum NewtonStart<'a> {
    /// A pose whose last digits got lost on the way; by no more than [`NEAR`].
    Pose(&'a ComplexPose),
    /// A point `(e, g)` of the design's frames, any scale; however far.
    Point(&'a [Complex64; 8]),
    /// A point that may be no root, or at `e.e = 0`; by no more than `reach`, in the size of the point.
    DoubtfulPoint(&'a [Complex64; 8], f64),
    /// A point known to more digits than a double-double has, which is not moved at all. However far out, the unit of
    /// length is taken from the point itself, and only its digits beyond double-double are dropped.
    PrecisePoint(&'a [ComplexOctuple; 8]),
}

/// One problem, scaled once and ready to certify any number of roots.
#[derive(Debug, Clone)]
pub struct Certifier(LegSystem);

impl Certifier {
    /// Prepares `m` with the squared leg lengths `s`: [`SquaredLegLengths`](platform::manipulator::SquaredLegLengths)
    /// or intervals (design units squared).
    ///
    /// # Errors
    /// [`WhyUncertified::OutOfRange`] when the data cannot be scaled exactly; [`WhyUncertified::Arithmetic`].
    pub fn new(m: &Manipulator, s: impl Into<SquareData>) -> Result<Self, WhyUncertified> {
        LegSystem::new(m, &s.into()).map(Self)
    }

    /// Decides whether the pose as given approximates exactly one root, see [`Certificate`]; the centre is the pose.
    /// Only when doubles do not suffice is the centre refined in double-double, by no more than [`NEAR`].
    #[must_use]
    pub fn certify(&self, pose: &ComplexPose) -> CertificateOutcome {
        match self.try_certify(pose) {
            Ok(certificate) => CertificateOutcome::Certified(certificate),
            Err(why) => CertificateOutcome::Absent(why),
        }
    }

    fn try_certify(&self, pose: &ComplexPose) -> Result<Certificate, WhyUncertified> {
        let x = study_of(pose, self.0.unit())?;
        let quick = certificate_about(&self.0, &Centre { hi: &x, full: None }, Digits::OfTheCentre)
            .and_then(|c| self.pose_is_the_root(pose, &c).map(|()| c));
        let why = match quick {
            Ok(certificate) => return Ok(certificate),
            Err(why) => why,
        };
        let refined = refine_study(&self.0, &x, NEAR).map_err(|_| why)?;
        let certificate = certificate_about_precise(&self.0, &refined.x, Digits::OfTheCentre)?;
        self.pose_is_the_root(pose, &certificate)?;
        Ok(certificate)
    }

    /// Decides whether there is exactly one root where Newton's method leads from `start`, and gives its pose, rounded
    /// from the best approximation at hand.
    pub(crate) fn root_near(&self, start: NewtonStart<'_>) -> Result<CertifiedPose, WhyUncertified> {
        match start {
            NewtonStart::Pose(pose) => self.root_near_pose(pose),
            NewtonStart::Point(x) => {
                // how far Newton's method leads does not matter: the proof is about where it ends
                let far = || self.root_near_doubtful_point(x, f64::INFINITY);
                let study = study_at(x, self.0.unit())?;
                let double = Centre { hi: &study, full: None };
                match one_root_about(&self.0, &double, Digits::OfTheCentre) {
                    Ok(ball) => self
                        .root_in_double(&double, &ball)
                        .or_else(|_| self.root_one_step_on(&study))
                        .or_else(|_| far()),
                    Err(why) => far().map_err(|_| why),
                }
            }
            NewtonStart::DoubtfulPoint(x, reach) => self.root_near_doubtful_point(x, reach),
            NewtonStart::PrecisePoint(x) => self.root_at_precise_point(x),
        }
    }

    /// [`root_near`](Self::root_near) of points `(e, g)`, eight at a time. `None` when doubles prove nothing:
    /// `root_near` then has to examine the point.
    pub(crate) fn roots_near(&self, points: &[&[Complex64; 8]]) -> Vec<Option<CertifiedPose>> {
        let nothing = Study { re: [f64::NAN; 8], im: [f64::NAN; 8], patch: 0 };
        let study = |x: &&[Complex64; 8]| study_at(x, self.0.unit()).unwrap_or(nothing);
        self.roots_near_studies(&points.iter().map(study).collect::<Vec<_>>())
    }

    /// [`roots_near`](Self::roots_near) of poses: the best approximations at hand, not the poses themselves.
    pub(crate) fn roots_near_poses(&self, poses: &[ComplexPose]) -> Vec<Option<CertifiedPose>> {
        let nothing = Study { re: [f64::NAN; 8], im: [f64::NAN; 8], patch: 0 };
        let study = |pose: &ComplexPose| study_of(pose, self.0.unit()).unwrap_or(nothing);
        self.roots_near_studies(&poses.iter().map(study).collect::<Vec<_>>())
    }

    fn roots_near_studies(&self, points: &[Study<f64>]) -> Vec<Option<CertifiedPose>> {
        let mut found = Vec::with_capacity(points.len());
        for batch in points.chunks(LANES) {
            let first = found.len();
            let ball_only = on_vector_unit(EightPoints { system: &self.0, points: batch, out: &mut found });
            for (l, x) in batch.iter().enumerate().filter(|(l, _)| ball_only[*l]) {
                found[first + l] = self.root_one_step_on(x).ok();
            }
        }
        found
    }

    fn root_near_pose(&self, pose: &ComplexPose) -> Result<CertifiedPose, WhyUncertified> {
        match self.certify(pose) {
            // in doubles the pose is as good as the centre; beyond, the middle of the enclosure has more digits
            CertificateOutcome::Certified(certificate) => {
                let digits = certificate.precision() == CentrePrecision::DoubleDouble;
                let pose = if digits { certificate.enclosure().middle() } else { *pose };
                Ok(CertifiedPose { pose, certificate })
            }
            CertificateOutcome::Absent(why) => {
                let unit = self.0.unit();
                let refined = refine_study(&self.0, &study_of(pose, unit)?, NEAR).map_err(|_| why)?;
                let certificate = certificate_about_precise(&self.0, &refined.x, Digits::OfTheCentre)?;
                self.certified(rounded_pose(&refined.x, unit), &certificate)
            }
        }
    }

    /// The root in a ball about a double, with the pose one Newton step on, where doubles are enough for `R` and `p`.
    fn root_in_double(&self, x: &Centre<'_>, ball: &RootBall) -> Result<CertifiedPose, WhyUncertified> {
        let better: [Complex64; 8] =
            std::array::from_fn(|j| Complex64::new(x.hi.re[j], x.hi.im[j]) - ball.step[j]);
        let pose = pose_in_double(&better, self.0.unit()).ok_or(WhyUncertified::RotationUndefined)?;
        self.certified(pose, &certificate_of(&self.0, x, ball)?)
    }

    /// The root in a ball about a double when `R` and `p` need more digits than the point has. One Newton step with
    /// values in double-double gives these digits, which suffices for a point as good as doubles can make it.
    fn root_one_step_on(&self, x: &Study<f64>) -> Result<CertifiedPose, WhyUncertified> {
        let mut better = x.lifted();
        for (k, step) in newton_step(&self.0, &better)?.iter().enumerate() {
            better.re[k] = better.re[k] - step.re.into();
            better.im[k] = better.im[k] - step.im.into();
        }
        let certificate = certificate_about_precise(&self.0, &better, Digits::OfTheCentre)?;
        self.certified(certificate.enclosure.middle(), &certificate)
    }

    fn root_near_doubtful_point(
        &self,
        x: &[Complex64; 8],
        reach: f64,
    ) -> Result<CertifiedPose, WhyUncertified> {
        let study = study_at(x, self.0.unit())?;
        let size = (0..8).map(|j| study.re[j].hypot(study.im[j])).fold(1.0, f64::max);
        let refined = refine_study(&self.0, &study, reach * size)?;
        let certificate = certificate_about_precise(&self.0, &refined.x, Digits::OfTheCentre)
            .or_else(|why| self.certificate_in_a_larger_unit(&refined.x).ok_or(why))?;
        self.certified(certificate.enclosure.middle(), &certificate)
    }

    /// The certificate in a larger unit of length. Near infinity `g` is known less well than `e` by many powers of ten.
    /// The largest ball in which there is one root is as flat, and the larger unit makes it round.
    fn certificate_in_a_larger_unit(&self, x: &Study<DoubleDouble>) -> Option<Certificate> {
        let g = (4..8).map(|k| x.re[k].rounded().hypot(x.im[k].rounded())).fold(0.0, f64::max);
        if !(g > CLOSE) {
            return None;
        }
        FLATTER.iter().find_map(|more| {
            let factor = 2f64.powi(g.log2() as i32 + more);
            let system = self.0.coarser(factor)?;
            let mut y = *x;
            for k in 4..8 {
                (y.re[k], y.im[k]) = (x.re[k].scaled(factor.recip()), x.im[k].scaled(factor.recip()));
            }
            certificate_about_precise(&system, &y, Digits::OfTheCentre).ok()
        })
    }

    fn root_at_precise_point(&self, x: &[ComplexOctuple; 8]) -> Result<CertifiedPose, WhyUncertified> {
        let point = PrecisePoint::of(x);
        let own = self.0.unit().log2() as i32;
        let g = point.exponent() - own;
        let mut why = WhyUncertified::OutOfRange;
        for more in FLATTER {
            let coarser = (g.max(0) + more).max(0);
            let system = if coarser == 0 { Some(self.0.clone()) } else { self.0.coarser(2f64.powi(coarser)) };
            let Some(system) = system else { continue };
            let study = point.study(own + coarser);
            let certificate = certificate_about_precise(&system, &study, Digits::OfTheCentre)
                .or_else(|why| certificate_about_precise(&system, &study, Digits::Octuple).map_err(|_| why));
            match certificate {
                Ok(certificate) => return self.certified(rounded_pose(&study, system.unit()), &certificate),
                Err(reason) => why = reason,
            }
        }
        Err(why)
    }

    /// The pose with its certificate, when [`pose_is_the_root`](Self::pose_is_the_root).
    fn certified(
        &self,
        pose: ComplexPose,
        certificate: &Certificate,
    ) -> Result<CertifiedPose, WhyUncertified> {
        self.pose_is_the_root(&pose, certificate)?;
        Ok(CertifiedPose { pose, certificate: *certificate })
    }

    /// Decides whether the pose is the certified root, for the middles of the data, to within [`NEAR`] in `R` and `p`.
    /// Far out it may be the middle of an enclosure not wider than [`FAR_OUT`].
    fn pose_is_the_root(&self, pose: &ComplexPose, c: &Certificate) -> Result<(), WhyUncertified> {
        let own = if c.centre_radius < c.radius { enclose(c, c.centre_radius) } else { Some(c.enclosure) };
        let enclosure = own.ok_or(WhyUncertified::RotationUndefined)?;
        let distance = rotation_distance(pose, &enclosure);
        if !(distance <= NEAR) {
            return Err(WhyUncertified::NotARotation { distance });
        }
        let unit = self.0.unit();
        let distance = deviation(pose, &enclosure, unit, false);
        let is_middle = || deviation(pose, &enclosure, unit, true) <= ROUNDED;
        let far_out = distance <= FAR_OUT && c.precision == CentrePrecision::DoubleDouble && is_middle();
        if distance <= NEAR || far_out { Ok(()) } else { Err(WhyUncertified::Deviation { distance }) }
    }

    /// Clusters of two or more roots, at most `most`, counted with multiplicity, that are proved to lie near the pose
    /// apart from all others: a multiple root, or close ones. Small clusters come first; each pose is the middle of
    /// the roots. None means that no cluster is proved.
    pub(crate) fn clusters_near(
        &self,
        pose: &ComplexPose,
        most: usize,
    ) -> impl Iterator<Item = ProvedCluster> {
        clusters_near(&self.0, pose, most).into_iter().flatten().filter_map(Result::ok)
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

/// Decides whether a ball about the centre holds exactly one root, a finite pose.
fn certificate_about(
    system: &LegSystem,
    x: &Centre<'_>,
    digits: Digits,
) -> Result<Certificate, WhyUncertified> {
    certificate_of(system, x, &one_root_about(system, x, digits)?)
}

/// [`certificate_about`] a centre in double-double.
fn certificate_about_precise(
    system: &LegSystem,
    x: &Study<DoubleDouble>,
    digits: Digits,
) -> Result<Certificate, WhyUncertified> {
    certificate_about(system, &Centre { hi: &x.rounded(), full: Some(x) }, digits)
}

/// The certificate of the root in a ball: where its `R` and `p` are, and whether it is real.
fn certificate_of(
    system: &LegSystem,
    x: &Centre<'_>,
    ball: &RootBall,
) -> Result<Certificate, WhyUncertified> {
    let centre: [Complex64; 8] = std::array::from_fn(|j| Complex64::new(x.hi.re[j], x.hi.im[j]));
    let tail = |f: &Study<DoubleDouble>| std::array::from_fn(|j| Complex64::new(f.re[j].lo(), f.im[j].lo()));
    let low: [Complex64; 8] = x.full.map_or([Complex64::ZERO; 8], tail);
    let (patch, unit) = (x.hi.patch, system.unit());
    let enclosure = match x.full {
        None => enclose_pose(&centre, patch, ball.radius, unit),
        Some(_) => enclose_pose_widely(&centre, &low, patch, ball.radius, unit),
    };
    Ok(Certificate {
        centre,
        low,
        patch,
        unit,
        radius: ball.radius,
        centre_radius: ball.centre_radius,
        uniqueness_radius: ball.uniqueness_radius,
        contraction: ball.lipschitz,
        reality: reality(x, ball),
        precision: if x.full.is_some() { CentrePrecision::DoubleDouble } else { CentrePrecision::Double },
        enclosure: enclosure.ok_or(WhyUncertified::RotationUndefined)?,
    })
}

/// Encloses `R` and `p` over the ball of `radius` about the centre of a certificate.
fn enclose(c: &Certificate, radius: f64) -> Option<PoseEnclosure> {
    match c.precision {
        CentrePrecision::Double => enclose_pose(&c.centre, c.patch, radius, c.unit),
        CentrePrecision::DoubleDouble => enclose_pose_widely(&c.centre, &c.low, c.patch, radius, c.unit),
    }
}

/// Decides whether the root in a ball is real.
///
/// The system and the patch are real, so the conjugate of a root is one. It is at most `radius + 2 |im c|` from the
/// centre; within the uniqueness ball it is the root itself. A coordinate whose disc holds no real number proves the
/// contrary.
fn reality(x: &Centre<'_>, c: &RootBall) -> ProvedReality {
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
