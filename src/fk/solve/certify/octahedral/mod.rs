//! Certificates for octahedral platforms, all sixteen poses at once.
//!
//! Base triangle `P1 P2 P3`, platform triangle `P4 P5 P6`, legs `14 24 25 35 36 16`. Each corner of the platform is on
//! a circle about a side of the base. Three angles remain, and the lengths of the three sides of the platform are three
//! equations in them (`circles.rs`). A regular zero of these equations belongs to exactly one pose, regular too. The
//! mirror image of that pose in the base plane has the opposite heights above it. Theorem and proof:
//! `docs/theory/certificates.md`.
//!
//! So a test in three unknowns certifies two poses, and their places follow by disc arithmetic (`poses.rs`).
//! Coefficients are enclosed from the joints, each coordinate within its radius of a double, and from squared lengths
//! as intervals. Only the order of the legs is shared with the solver.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

pub(super) mod arithmetic;
mod circles;
mod poses;

use num_complex::Complex64;

use super::certificate::{PoseEnclosure, ProvedReality, WhyUncertified};
use super::system::{SquareData, exact_product, power_of_two_below, scale_point, scaled_radius};
use arithmetic::{CertifiedTriangle, RealVector, parts};
use circles::{BaseSides, ZeroDiscs, one_zero_about};
use num::ball::{Disc, Real, UP};
use num::batch::LANES;
use num::rounding::check_arithmetic;
use num::vector_unit::on_vector_unit;
use platform::geom::ComplexPose;
use platform::manipulator::{Body, LegIndex, Octahedral};
use poses::{GivenPoses, corners_of, deviation, place};

/// Pairs of poses of an octahedral platform.
pub const PAIRS: usize = LANES;

/// One octahedral design, ready to certify the poses for any leg lengths without allocation.
#[derive(Debug, Clone)]
pub struct OctahedralCertifier {
    unit: f64,
    order: [usize; 6],
    base: CertifiedTriangle,
    platform: CertifiedTriangle,
    sides: BaseSides,
    /// `P4`, `P5`, `P6` in the platform frame, over the unit.
    corners: [RealVector; 3],
    /// `P1` in the base frame and `P4` in the platform frame, over the unit.
    origins: [RealVector; 2],
}

/// Proof that exactly two poses, mirror images of each other in the base plane, have their corners near given ones. It
/// also proves that two given poses approximate them.
///
/// Each corner `k` is on a circle `h^2 + z^2 = rho` about its side of the base. `h` is across the side in the plane of
/// the base, `z` along `(P2 - P1) x (P3 - P1)`. With `u = h + i z`, `v = h - i z` that is `u v = rho`. The distance of
/// two points of a circle is `|log|` of the ratio of their `u`, an angle. The distance of two poses is the largest of
/// the three.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PairCertificate {
    /// `u` of `P4`, `P5`, `P6` of the centre, design units: for pose `2k`. The other pose has `u` and `v` exchanged.
    pub centre: [Complex64; 3],
    /// `h` of `P4`, `P5`, `P6` near the certified pose, design units: the same for both.
    pub across: [Complex64; 3],
    /// `h` of the certified poses is at most this far from `across`, design units.
    pub blur: [f64; 3],
    /// The pose is at most this far from the centre, an angle.
    pub radius: f64,
    /// There is no other at most this far from it, an angle.
    pub uniqueness_radius: f64,
    /// The proved reality of the two poses: both are real, or neither is.
    pub reality: ProvedReality,
    /// Largest distance of the given poses from the certified ones. Entries of `R` are relative to the larger of 1 and
    /// the largest of them. Entries of `p` are relative to the larger of the largest of them and the power of two near
    /// the larger triangle.
    pub deviation: f64,
    /// The same distances as they are, of the entries of `R` and of `p` (design units).
    pub distances: [f64; 2],
    /// Contraction constant of the simplified Newton map on the ball of the radius.
    pub contraction: f64,
    /// `|J| |J^-1|` of the three equations with rows scaled to one: an estimate, not a bound.
    pub condition: f64,
}

impl PairCertificate {
    /// Proved: the poses of both certificates are different ones. Mirror images have the same distances across the
    /// sides.
    #[must_use]
    pub fn is_distinct_from(&self, other: &Self) -> bool {
        (0..3).any(|k| {
            let gap = self.across[k] - other.across[k];
            let sum = (self.blur[k] + other.blur[k]) * UP;
            gap.re.abs() > sum || gap.im.abs() > sum
        })
    }
}

/// Proof that exactly one root lies near a pose of an octahedral platform: the certificate of its pair, and the choice
/// between the two poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OctahedralCertificate {
    pub(super) order: [usize; 6],
    pub(super) pair: PairCertificate,
    pub(super) mirrored: bool,
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

    /// Whether the root is the mirror image, in the plane of the base triangle, of the pose that the numbers of the
    /// pair are for.
    #[must_use]
    pub fn is_mirrored(&self) -> bool {
        self.mirrored
    }

    /// The enclosure of `R` and `p` of the root.
    #[must_use]
    pub fn enclosure(&self) -> &PoseEnclosure {
        &self.enclosure
    }
}

/// The proofs about eight pairs of poses.
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
            base: CertifiedTriangle::of(p),
            platform: CertifiedTriangle::of(q),
            sides: BaseSides::of(&CertifiedTriangle::of(p)),
            corners: q,
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
        let zero = disc(Complex64::ZERO, 0.0);
        let mut enclosure = PoseEnclosure { rotation: [[zero; 3]; 3], position: [zero; 3] };
        for i in 0..3 {
            for j in 0..3 {
                enclosure.rotation[i][j] = disc(pose.rotation[(i, j)], turn);
            }
            enclosure.position[i] = disc(pose.position[i], shift);
        }
        OctahedralCertificate { order: self.order, pair: *pair, mirrored, enclosure }
    }

    /// Tries to prove that near each pose `2k` there is exactly one pose of the platform, and that pose `2k + 1`
    /// approximates its mirror image.
    ///
    /// `s` are the squared leg lengths in the design's order.
    #[must_use]
    pub fn certify(
        &self,
        s: impl Into<SquareData>,
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
        if !squares.iter().all(|s| s.magnitude() < LARGEST) {
            return none;
        }
        on_vector_unit(OctahedralProof { certifier: self, squares: &squares, poses })
    }

    #[inline(always)]
    fn prove(&self, s: &[Real; 6], poses: &[ComplexPose; 2 * PAIRS]) -> OctahedralCertificates {
        let circles = self.sides.circles(s);
        let t = &self.platform;
        let gaps = self.sides.gaps(&circles, [t.bb, t.opposite, t.cc]);
        let given = GivenPoses::of(poses, self.unit);
        let found = one_zero_about(&circles, &gaps, &corners_of(self, &circles, &given));
        let deviation = deviation(self, &place(self, &circles, &found), &given);
        let relative = deviation.relative;
        // the poses of a pair are distinct where a corner is proved off the base plane
        let heights =
            [parts(&found.places[0][1].c), parts(&found.places[1][1].c), parts(&found.places[2][1].c)];
        let mut out = OctahedralCertificates { pairs: [None; PAIRS], complete: false };
        for k in 0..PAIRS {
            let raised = (0..3).any(|i| heights[i].0[k] > found.places[i][1].r.0[k] * UP);
            let in_range = found.places.iter().flatten().all(|z| {
                let z = z.c.lane(k);
                z.re.abs() < LARGEST && z.im.abs() < LARGEST
            });
            if !(in_range && raised && found.step.0[k] <= super::NEAR && relative.0[k] <= super::NEAR) {
                continue;
            }
            let (mut centre, mut across, mut blur) = ([Complex64::ZERO; 3], [Complex64::ZERO; 3], [0.0; 3]);
            for i in 0..3 {
                centre[i] = found.centres[i].lane(k) * self.unit;
                across[i] = found.places[i][0].c.lane(k) * self.unit;
                blur[i] = found.places[i][0].r.0[k] * self.unit;
            }
            out.pairs[k] = Some(PairCertificate {
                centre,
                across,
                blur,
                radius: found.radius.0[k],
                uniqueness_radius: found.uniqueness.0[k],
                reality: reality(&found, k),
                deviation: relative.0[k],
                distances: [deviation.rotation.0[k], deviation.position.0[k] * self.unit],
                contraction: found.lipschitz.0[k],
                condition: found.condition.0[k],
            });
        }
        out.complete = out.pairs.iter().all(Option::is_some) && are_distinct(&found);
        out
    }
}

/// A proof to be made with the vector units that the machine turns out to have; the results are the same on all.
struct OctahedralProof<'a> {
    certifier: &'a OctahedralCertifier,
    squares: &'a [Real; 6],
    poses: &'a [ComplexPose; 2 * PAIRS],
}

impl pulp::WithSimd for OctahedralProof<'_> {
    type Output = OctahedralCertificates;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> OctahedralCertificates {
        self.certifier.prove(self.squares, self.poses)
    }
}

/// Coordinates and squared distances in units of the design stay below this, and products of eight of them in range.
const LARGEST: f64 = (1u64 << 50) as f64;

/// The equations are real, so that the conjugate of a zero is a zero. Within the uniqueness ball it is the zero itself,
/// and the pose is real. A corner that cannot be real proves the opposite.
#[inline(always)]
fn reality(found: &ZeroDiscs, k: usize) -> ProvedReality {
    let [above, below] = found.conjugates;
    if (found.radius.0[k] + above.0[k]) * UP <= found.uniqueness.0[k] {
        ProvedReality::Real
    } else if below.0[k] > 2.0 * found.radius.0[k] * UP {
        ProvedReality::NonReal
    } else {
        ProvedReality::Undecided
    }
}

/// Every two lanes have disjoint discs for the distance of a corner across its side.
#[inline(always)]
fn are_distinct(found: &ZeroDiscs) -> bool {
    let mut all = true;
    for shift in 1..=LANES / 2 {
        for k in 0..LANES {
            let l = (k + shift) % LANES;
            let apart = |i: usize| {
                let d = &found.places[i][0];
                let (re, im) = ((d.c.re[k] - d.c.re[l]).abs(), (d.c.im[k] - d.c.im[l]).abs());
                let sum: f64 = (d.r.0[k] + d.r.0[l]) * UP;
                re > sum || im > sum
            };
            all &= apart(0) | apart(1) | apart(2);
        }
    }
    all
}

/// Unit roundoff.
const U: f64 = f64::EPSILON / 2.0;
