//! Certificates for octahedral platforms, all sixteen poses at once.
//!
//! With base triangle `P1 P2 P3`, platform triangle `P4 P5 P6` and legs `14 24 25 35 36 16`, a pose gives two unknown squared distances
//! `x = s15`, `y = s34` that satisfy two closures (`closures.rs`): Cayley-Menger determinants of the points 1 2 3 4 5 and 1 3 4 5 6. A regular zero
//! of both at which `P4` (or `P5`) is off the base plane and 1 3 4 5 is not a flat tetrahedron belongs to exactly two poses, regular and mirror
//! images in the base plane; theorem and proof: `docs/theory/certificates.md`. So a test in two unknowns certifies two poses, and their
//! places follow by disc arithmetic (`poses.rs`). Coefficients are enclosed from the joints, each coordinate within its radius of a double, and from squared
//! lengths as intervals. Nothing is shared with the solver but the order of the legs.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

pub(super) mod arithmetic;
mod closures;
mod poses;

use num_complex::Complex64;

use super::certificate::{PoseEnclosure, ProvedReality, WhyUncertified};
use super::system::{SquareData, exact_product, power_of_two_below, scale_point, scaled_radius};
use crate::geom::ComplexPose;
use crate::manipulator::{Body, LegIndex, Octahedral};
use crate::num::ball::{Disc, Real, UP};
use crate::num::batch::{ComplexBatch, LANES};
use crate::num::rounding::check_arithmetic;
use crate::num::vector_unit::on_vector_unit;
use arithmetic::{Discs, RealVector, Triangle};
use closures::{ClosureCoefficients, RootDiscs, one_root_about};
use poses::{Data, deviation};

/// Pairs of poses of an octahedral platform.
pub const PAIRS: usize = LANES;

/// One octahedral design, ready to certify the poses for any leg lengths without allocation.
#[derive(Debug, Clone)]
pub struct OctahedralCertifier {
    unit: f64,
    order: [usize; 6],
    base: Triangle,
    platform: Triangle,
    /// The platform triangle as `P5 P6 P4`.
    turned: Triangle,
    /// `P1` in the base frame and `P4` in the platform frame, over the unit.
    origins: [RealVector; 2],
}

/// Proof that exactly one pair `(s15, s34)` lies near a point, and that two given poses approximate its two poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairCertificate {
    /// Discs that hold `s15` and `s34`, design units squared.
    pub squared_distances: [Disc; 2],
    /// Weights `sigma` of the norm `max(|h_x| / sigma_x, |h_y| / sigma_y)` of the proof, design units squared.
    pub weights: [f64; 2],
    /// The pair is at most this far from the centres of the discs, in that norm.
    pub radius: f64,
    /// There is no other pair at most this far from them.
    pub uniqueness_radius: f64,
    /// What is proved about the two poses: both are real, or neither is.
    pub reality: ProvedReality,
    /// The given poses are at most this far from the certified ones: entries of `R` relative to the larger of 1 and the largest of them, entries of `p` relative
    /// to the larger of the power of two near the larger triangle and the largest of them.
    pub deviation: f64,
    /// The same distances as they are, of the entries of `R` and of `p` (design units).
    pub distances: [f64; 2],
    /// `P4` of pose `2k` is near this far from the base plane, on the side of `(P2 - P1) x (P3 - P1)`; of pose `2k + 1` near the negative. Design units; an
    /// approximation that tells the two poses apart.
    pub height: Complex64,
    /// Contraction constant of the simplified Newton map on the disc of the pair.
    pub contraction: f64,
    /// `|J| |J^-1|` of the closures with rows scaled to one: an estimate, not a bound.
    pub condition: f64,
}

/// Proof that exactly one root lies near a pose of an octahedral platform: the certificate of its pair, and which of its two poses it is.
///
/// With the legs [`order`](Self::order) from `P1 P2 P2 P3 P3 P1` to `P4 P4 P5 P5 P6 P6` there is exactly one zero `(s15, s34)` of the two closures within
/// `uniqueness_radius` times the weights of the pair (see [`pair`](Self::pair)), coordinate by coordinate; it lies within `radius` times the weights. Of its two poses the root is
/// the one with the distance of `P4` from the base plane near [`height`](Self::height).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctahedralCertificate {
    pub(super) order: [usize; 6],
    pub(super) pair: PairCertificate,
    pub(super) height: Complex64,
    pub(super) enclosure: PoseEnclosure,
}

impl OctahedralCertificate {
    /// Indices of the legs `14 24 25 35 36 16`.
    #[must_use]
    pub fn order(&self) -> [usize; 6] {
        self.order
    }

    /// The pair of poses that the root belongs to.
    #[must_use]
    pub fn pair(&self) -> &PairCertificate {
        &self.pair
    }

    /// Approximate signed distance of `P4` from the base plane, along `(P2 - P1) x (P3 - P1)`, design units.
    #[must_use]
    pub fn height(&self) -> Complex64 {
        self.height
    }

    /// Where `R` and `p` of the root are.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        &self.enclosure
    }
}

/// What could be proved about eight pairs of poses.
#[derive(Debug, Clone, PartialEq)]
pub struct OctahedralCertificates {
    /// Pair by pair, `None` where there is no proof.
    pub pairs: [Option<PairCertificate>; PAIRS],
    /// Proved: all sixteen poses are certified and pairwise distinct.
    pub complete: bool,
}

impl OctahedralCertifier {
    /// Prepares a design.
    ///
    /// # Errors
    /// [`WhyUncertified::OutOfRange`] when coordinates cannot be scaled exactly; [`WhyUncertified::Arithmetic`].
    pub fn new(design: &Octahedral) -> Result<Self, WhyUncertified> {
        check_arithmetic()?;
        let (base, platform) = (design.base(), design.platform());
        let sides = |t: &[nalgebra::Point3<f64>; 3]| (t[1] - t[0]).norm().max((t[2] - t[0]).norm());
        let size = sides(&base).max(sides(&platform));
        if !(size > 1e-120 && size < 1e120) {
            return Err(WhyUncertified::OutOfRange);
        }
        let unit = power_of_two_below(size);
        let scaled = |p: nalgebra::Point3<f64>, radius: f64| -> Result<RealVector, WhyUncertified> {
            let radius = scaled_radius(radius, unit.recip());
            scale_point(p.coords.into(), unit.recip())
                .map(|p| p.map(|centre| Real { centre, radius }))
                .filter(|p| p.iter().all(|x| x.centre.abs() + x.radius < LARGEST))
                .ok_or(WhyUncertified::OutOfRange)
        };
        let corners =
            |t: [nalgebra::Point3<f64>; 3], body: Body| -> Result<[RealVector; 3], WhyUncertified> {
                let radii = design.corner_radii(body);
                Ok([scaled(t[0], radii[0])?, scaled(t[1], radii[1])?, scaled(t[2], radii[2])?])
            };
        let (p, q) = (corners(base, Body::Base)?, corners(platform, Body::Platform)?);
        Ok(Self {
            unit,
            order: design.order().map(LegIndex::get),
            base: Triangle::of(p),
            platform: Triangle::of(q),
            turned: Triangle::of([q[1], q[2], q[0]]),
            origins: [p[0], q[0]],
        })
    }

    /// The certificate of pose `2k` (or `2k + 1`, the mirror image) of a certified pair `k`.
    #[must_use]
    pub fn of_pose(
        &self,
        pair: &PairCertificate,
        pose: &ComplexPose,
        mirrored: bool,
    ) -> OctahedralCertificate {
        let disc = |centre: Complex64, radius: f64| Disc { centre, radius };
        let [turn, shift] = pair.distances;
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| disc(pose.rotation[(i, j)], turn)));
        let position = std::array::from_fn(|i| disc(pose.position[i], shift));
        OctahedralCertificate {
            order: self.order,
            pair: *pair,
            height: if mirrored { -pair.height } else { pair.height },
            enclosure: PoseEnclosure { rotation, position },
        }
    }

    /// Tries to prove that near each of the `pairs` (approximations of `s15`, `s34`, design units squared) there is exactly one, and that poses
    /// `2k`, `2k + 1` approximate the two poses of pair `k`, `2k + 1` being the mirror image of `2k`.
    ///
    /// `s` are the squared leg lengths in the design's order.
    #[must_use]
    pub fn certify(
        &self,
        s: impl Into<SquareData>,
        pairs: &[[Complex64; 2]; PAIRS],
        poses: &[ComplexPose; 2 * PAIRS],
    ) -> OctahedralCertificates {
        let none = OctahedralCertificates { pairs: [None; PAIRS], complete: false };
        let s: SquareData = s.into();
        let scale = (self.unit * self.unit).recip();
        let mut squares = [Real::ZERO; 6];
        for (square, i) in squares.iter_mut().zip(self.order) {
            let Some(c) = exact_product(s.middle[i].hi(), scale) else { return none };
            // the radius is only ever too large: it may underflow
            let blur = (s.middle[i].lo().abs() + s.radius[i]) * UP * scale;
            *square = Real { centre: c, radius: if blur <= 0.0 { 0.0 } else { blur.next_up() } };
        }
        let (mut x, mut y) = (ComplexBatch::ZERO, ComplexBatch::ZERO);
        for (k, pair) in pairs.iter().enumerate() {
            (x.re[k], x.im[k]) = (pair[0].re * scale, pair[0].im * scale);
            (y.re[k], y.im[k]) = (pair[1].re * scale, pair[1].im * scale);
        }
        let in_range = |z: &ComplexBatch| z.re.iter().chain(&z.im).all(|v| v.abs() < LARGEST);
        if !(in_range(&x) && in_range(&y) && squares.iter().all(|s| s.magnitude() < LARGEST)) {
            return none;
        }
        on_vector_unit(OctahedralProof { certifier: self, squares: &squares, pairs: [&x, &y], poses })
    }

    #[inline(always)]
    fn prove(
        &self,
        s: &[Real; 6],
        x: &ComplexBatch,
        y: &ComplexBatch,
        poses: &[ComplexPose; 2 * PAIRS],
    ) -> OctahedralCertificates {
        let closures = [
            ClosureCoefficients::new(&self.base, [s[2], s[3]], [s[0], s[1]], self.platform.bb),
            ClosureCoefficients::new(&self.turned, [s[5], s[0]], [s[3], s[4]], self.base.cc),
        ];
        let found = one_root_about(&closures, x, y);
        let radii = found.weights.map(|w| (w * found.radius).up());
        let discs = [Discs { c: *x, r: radii[0] }, Discs { c: *y, r: radii[1] }];
        let data = Data { base: &self.base, platform: &self.platform, s };
        let placed = data.place(discs[0], discs[1]);
        let deviation = deviation(self, &placed, poses);
        let relative = deviation.relative;
        let positive = placed.squared_height.c.re;
        let unit = self.unit * self.unit;
        let mut out = OctahedralCertificates { pairs: [None; PAIRS], complete: false };
        for k in 0..PAIRS {
            if !(found.step.0[k] <= super::NEAR && relative.0[k] <= super::NEAR) {
                continue;
            }
            let disc = |d: &Discs| Disc { centre: d.c.lane(k) * unit, radius: d.r.0[k] * unit };
            out.pairs[k] = Some(PairCertificate {
                squared_distances: [disc(&discs[0]), disc(&discs[1])],
                weights: found.weights.map(|w| w.0[k] * unit),
                radius: found.radius.0[k],
                uniqueness_radius: found.uniqueness.0[k],
                reality: reality(&found, x, y, positive[k], k),
                deviation: relative.0[k],
                distances: [deviation.rotation.0[k], deviation.position.0[k] * self.unit],
                height: placed.p4[2].c.lane(k) * (deviation.first.0[k] * self.unit),
                contraction: found.lipschitz.0[k],
                condition: found.condition.0[k],
            });
        }
        let certified = out.pairs.iter().all(Option::is_some);
        out.complete = certified && are_disjoint(&discs);
        out
    }
}

/// A proof to be made with the vector units that the machine turns out to have; the results are the same on all.
struct OctahedralProof<'a> {
    certifier: &'a OctahedralCertifier,
    squares: &'a [Real; 6],
    pairs: [&'a ComplexBatch; 2],
    poses: &'a [ComplexPose; 2 * PAIRS],
}

impl pulp::WithSimd for OctahedralProof<'_> {
    type Output = OctahedralCertificates;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> OctahedralCertificates {
        self.certifier.prove(self.squares, self.pairs[0], self.pairs[1], self.poses)
    }
}

/// Coordinates and squared distances in units of the design stay below this, and products of eight of them in range.
const LARGEST: f64 = (1u64 << 50) as f64;

/// The system is real, so that the conjugate of a pair is one; within the uniqueness ball it is the pair itself. The poses of a real pair
/// are real when the squared height, which is real and not zero, is positive, and neither is when it is negative.
#[inline(always)]
fn reality(found: &RootDiscs, x: &ComplexBatch, y: &ComplexBatch, height: f64, k: usize) -> ProvedReality {
    let imaginary = (x.im[k].abs() / found.weights[0].0[k]).max(y.im[k].abs() / found.weights[1].0[k]);
    let (radius, alone) = (found.radius.0[k], found.uniqueness.0[k]);
    if (radius + 2.0 * imaginary) * UP <= alone {
        if height > 0.0 { ProvedReality::Real } else { ProvedReality::NonReal }
    } else if imaginary > radius * UP {
        ProvedReality::NonReal
    } else {
        ProvedReality::Undecided
    }
}

/// Every two lanes have disjoint discs in one of the unknowns.
#[inline(always)]
fn are_disjoint(discs: &[Discs; 2]) -> bool {
    let mut all = true;
    for shift in 1..=LANES / 2 {
        for k in 0..LANES {
            let l = (k + shift) % LANES;
            let apart = |d: &Discs| {
                let (re, im) = ((d.c.re[k] - d.c.re[l]).abs(), (d.c.im[k] - d.c.im[l]).abs());
                let sum: f64 = (d.r.0[k] + d.r.0[l]) * UP;
                re > sum || im > sum
            };
            all &= apart(&discs[0]) | apart(&discs[1]);
        }
    }
    all
}

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;

#[cfg(test)]
mod tests;
