//! Certificates straight from dual quaternions, and poses with all their digits.
//!
//! `R = X(e) / (e.e)` loses `log10(|e|^2 / |e.e|)` digits in double, and `p e = g` as many on the way back. Far out, where `e.e`
//! is small, a pose is therefore made from a point refined in double-double.

use num_complex::Complex64;

use super::centre::{pose_numerators, pose_of, study_of};
use super::krawczyk::{Centre, Contraction, contract, contract_sharply};
use super::precisely::contract_precisely;
use super::refine::refine_study;
use super::system::{LegSystem, Scalar, Study};
use super::{CentrePrecision, Certificate, CertificateOutcome, Certifier, NEAR, RefinedPose, WhyUncertified};
use crate::geom::ComplexPose;
use crate::num::double_double::DoubleDouble;
use crate::num::octuple::{ComplexOctuple, Octuple};

/// Below this `|e.e| / |e|^2` a pose is computed in double-double.
const FAR: f64 = 1.0 / 16.0;

/// Points with smaller `|g|` gain nothing from a larger unit of length.
const CLOSE: f64 = 64.0;
/// Powers of two by which the unit is enlarged beyond `|g|`.
const FLATTER: [i32; 4] = [0, 5, 10, 15];

/// A proved root and its pose, rounded from the best approximation at hand.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CertifiedPose {
    pub(crate) pose: ComplexPose,
    pub(crate) certificate: Certificate,
}

impl CertifiedPose {
    /// The mirror image in `z = 0`, see [`Certificate::mirrored`].
    pub(crate) fn mirrored(&self) -> Self {
        let side = |k: usize| if k == 2 { -1.0 } else { 1.0 };
        let pose = ComplexPose {
            rotation: nalgebra::Matrix3::from_fn(|i, j| self.pose.rotation[(i, j)] * (side(i) * side(j))),
            position: nalgebra::Vector3::from_fn(|i, _| self.pose.position[i] * side(i)),
        };
        Self { pose, certificate: self.certificate.mirrored() }
    }

    /// The complex conjugate root.
    pub(crate) fn conjugate(&self) -> Self {
        let pose = ComplexPose {
            rotation: self.pose.rotation.map(|z| z.conj()),
            position: self.pose.position.map(|z| z.conj()),
        };
        Self { pose, certificate: self.certificate.conjugate() }
    }
}

/// `(e, g)` of a pose, any scale; `None` for numbers out of range.
pub(crate) fn dual_quaternion(pose: &ComplexPose) -> Option<[Complex64; 8]> {
    let x = study_of(pose, 1.0).ok()?;
    Some(std::array::from_fn(|k| Complex64::new(x.re[k], x.im[k])))
}

/// `x = (e, g)` on the patch of its largest `|e_k|`, lengths divided by `unit`.
fn study_at(x: &[Complex64; 8], unit: f64) -> Result<Study<f64>, WhyUncertified> {
    let size = |k: &usize| x[*k].norm_sqr();
    let patch = (1..4).fold(0, |best, k| if size(&k) > size(&best) { k } else { best });
    let inverse = x[patch].inv();
    let mut z: [Complex64; 8] = std::array::from_fn(|j| x[j] * if j < 4 { inverse } else { inverse / unit });
    z[patch] = Complex64::ONE;
    if !z.iter().all(|z| z.is_finite()) {
        return Err(WhyUncertified::NotFinite);
    }
    // as for poses: moduli below 2^30 keep every product of the evaluation far below 2^100
    if !z.iter().all(|z| z.norm_sqr() < 2f64.powi(60)) {
        return Err(WhyUncertified::OutOfRange);
    }
    Ok(Study { re: z.map(|z| z.re), im: z.map(|z| z.im), patch })
}

fn prove(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<Certificate, WhyUncertified> {
    let hi = x.rounded();
    let centre = Centre { hi: &hi, full: Some(x) };
    Certifier::build(system, &centre, &contract_sharply(system, &centre)?)
}

/// [`prove`] with 256 bits for the inverse of the Jacobian and everything it is multiplied with.
fn prove_precisely(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<Certificate, WhyUncertified> {
    let hi = x.rounded();
    let centre = Centre { hi: &hi, full: Some(x) };
    Certifier::build(system, &centre, &contract_precisely(system, x)?)
}

impl Certifier {
    /// Proves that the point `(e, g)` of the design's frames (any scale) approximates one root, as [`certify`](Self::certify) does
    /// for poses.
    pub(crate) fn certify_point(&self, x: &[Complex64; 8]) -> Result<CertifiedPose, WhyUncertified> {
        let study = study_at(x, self.0.unit())?;
        let double = Centre { hi: &study, full: None };
        match contract(&self.0, &double, NEAR) {
            Ok(c) => self.certify_plainly(&double, &c).or_else(|_| self.certify_doubtful(x, f64::INFINITY)),
            // how far Newton's method leads does not matter: the proof is about where it ends
            Err(why) => self.certify_doubtful(x, f64::INFINITY).map_err(|_| why),
        }
    }

    /// The certificate about a double, with the pose one Newton step on, where doubles are enough for `R` and `p`.
    fn certify_plainly(&self, x: &Centre<'_>, c: &Contraction) -> Result<CertifiedPose, WhyUncertified> {
        let certificate = Self::build(&self.0, x, c)?;
        let better: [Complex64; 8] =
            std::array::from_fn(|j| Complex64::new(x.hi.re[j], x.hi.im[j]) - c.step[j]);
        let pose = self.near_pose(&better).ok_or(WhyUncertified::RotationUndefined)?;
        Ok(CertifiedPose { pose, certificate: self.accurate(&pose, &certificate)? })
    }

    /// [`certify`](Self::certify) with the pose of the certified root, rounded from the best approximation at hand: for poses whose last digits got lost on the way.
    pub(crate) fn certify_pose(&self, pose: &ComplexPose) -> Result<CertifiedPose, WhyUncertified> {
        match self.certify(pose) {
            // in doubles the pose is as good as the centre; beyond, the middle of the enclosure has more digits
            CertificateOutcome::Certified(certificate) => {
                let digits = certificate.precision() == CentrePrecision::DoubleDouble;
                let pose = if digits { certificate.enclosure().middle() } else { *pose };
                Ok(CertifiedPose { pose, certificate })
            }
            CertificateOutcome::Absent(why) => {
                let refined =
                    refine_study(&self.0, &study_of(pose, self.0.unit())?, NEAR).map_err(|_| why)?;
                let pose = self.rounded_pose(&refined.x);
                self.accurate(&pose, &prove(&self.0, &refined.x)?)
                    .map(|certificate| CertifiedPose { pose, certificate })
            }
        }
    }

    /// [`certify_point`](Self::certify_point) for a point that may be no root, or at `e.e = 0`: Newton's method in double-double is given
    /// `reach`, in the size of the point, to settle.
    pub(crate) fn certify_doubtful(
        &self,
        x: &[Complex64; 8],
        reach: f64,
    ) -> Result<CertifiedPose, WhyUncertified> {
        let study = study_at(x, self.0.unit())?;
        let size = (0..8).map(|j| study.re[j].hypot(study.im[j])).fold(1.0, f64::max);
        let refined = refine_study(&self.0, &study, reach * size)?;
        let certificate = match prove(&self.0, &refined.x) {
            Ok(certificate) => certificate,
            Err(why) => self.prove_coarsely(&refined.x).ok_or(why)?,
        };
        let pose = certificate.enclosure.middle();
        Ok(CertifiedPose { pose, certificate: self.accurate(&pose, &certificate)? })
    }

    /// [`certify_point`](Self::certify_point) for a point known to more digits than a double-double has: however far out, the unit of length is
    /// taken from the point itself, and only its digits beyond double-double are dropped.
    pub(crate) fn certify_precise(&self, x: &[ComplexOctuple; 8]) -> Result<CertifiedPose, WhyUncertified> {
        let size = |k: usize| x[k].norm_sqr().rounded();
        let patch = (1..4).fold(0, |best, k| if size(k) > size(best) { k } else { best });
        let inverse = x[patch].recip();
        let plain: [ComplexOctuple; 8] = std::array::from_fn(|k| x[k] * inverse);
        let own = self.0.unit().log2() as i32;
        let g = plain[4..].iter().map(ComplexOctuple::exponent).max().unwrap_or(0) - own;
        let both =
            |z: Octuple| DoubleDouble::from_sum(z.rounded(), (z - Octuple::from(z.rounded())).rounded());
        let mut why = WhyUncertified::OutOfRange;
        for more in FLATTER {
            let coarser = (g.max(0) + more).max(0);
            let system = if coarser == 0 { Some(self.0.clone()) } else { self.0.coarser(2f64.powi(coarser)) };
            let Some(system) = system else { continue };
            let in_unit = |k: usize| if k < 4 { plain[k] } else { plain[k].scaled(-own - coarser) };
            let mut study = Study {
                re: std::array::from_fn(|k| both(in_unit(k).re)),
                im: std::array::from_fn(|k| both(in_unit(k).im)),
                patch,
            };
            (study.re[patch], study.im[patch]) = (DoubleDouble::ONE, DoubleDouble::ZERO);
            match prove(&system, &study).or_else(|why| prove_precisely(&system, &study).map_err(|_| why)) {
                Ok(certificate) => {
                    let (rotation, position) = pose_of(&study, system.unit());
                    let pose =
                        RefinedPose { rotation, position, moved: 0.0, last_step: 0.0, steps: 0 }.pose();
                    return Ok(CertifiedPose { pose, certificate: self.accurate(&pose, &certificate)? });
                }
                Err(reason) => why = reason,
            }
        }
        Err(why)
    }

    /// Near infinity `g` is known less well than `e` by many powers of ten, and the largest ball in which there is one root is as
    /// flat: a larger unit of length makes it round.
    fn prove_coarsely(&self, x: &Study<DoubleDouble>) -> Option<Certificate> {
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
            prove(&system, &y).ok()
        })
    }

    /// The pose in double, unless `e.e` is too small for it.
    fn near_pose(&self, x: &[Complex64; 8]) -> Option<ComplexPose> {
        let (r, p, n) = pose_numerators(x);
        let size: f64 = x[..4].iter().map(Complex64::norm_sqr).sum();
        let inverse = n.inv();
        (n.norm_sqr() > FAR * FAR * size * size).then(|| ComplexPose {
            rotation: nalgebra::Matrix3::from_fn(|i, j| r[3 * i + j] * inverse),
            position: nalgebra::Vector3::from_fn(|i, _| p[i] * inverse * self.0.unit()),
        })
    }

    fn rounded_pose(&self, x: &Study<DoubleDouble>) -> ComplexPose {
        let (rotation, position) = pose_of(x, self.0.unit());
        RefinedPose { rotation, position, moved: 0.0, last_step: 0.0, steps: 0 }.pose()
    }
}
