//! Proofs of roots, single or in clusters, with their numbers.

use schemars::JsonSchema;
use serde::Serialize;

use crate::{ComplexRecord, Number};
use fk::solve::certify::octahedral::OctahedralCertificate;
use fk::solve::certify::{
    CentrePrecision, Certificate, ClusterCertificate, PoseEnclosure, ProvedReality, RootCertificate,
};
use num::ball::Disc;

/// The proof that a root exists and is unique nearby, with all its numbers.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum CertificateRecord {
    /// In coordinates `(e, g / unit)` with `e_patch = 1`; distances are largest moduli of coordinate differences.
    Study {
        /// Coordinate that equals 1.
        patch: usize,
        /// A power of two, design units.
        unit: Number,
        /// The centre of the ball.
        centre: ComplexRecord<[Number; 8]>,
        /// Its low-order parts, to be added to it.
        centre_low: ComplexRecord<[Number; 8]>,
        /// One root lies within this distance of the centre.
        radius: Number,
        /// No other root lies within this distance.
        uniqueness_radius: Number,
        /// Contraction of the simplified Newton map on that ball, below 1.
        contraction: Number,
        /// Precision of the centre.
        precision: CentrePrecision,
        /// Reality of the root, proved for all squared lengths within the rounding of the data.
        reality: ProvedReality,
        /// Discs that contain the pose.
        enclosure: Box<EnclosureRecord>,
    },
    /// Cluster of close or equal roots (e, g / unit), with coordinate `patch` of e equal to 1. They lie on a curve
    /// through the centre, parametrised by t with |t| below `reach`.
    Cluster {
        /// Number of roots, counted with multiplicity; at least 2.
        multiplicity: usize,
        /// Coordinate that equals 1.
        patch: usize,
        /// The unit of g, design units.
        unit: Number,
        /// e0..e3, g0..g3 over the unit.
        centre: ComplexRecord<[Number; 8]>,
        /// Its low-order parts, to be added to it.
        centre_low: ComplexRecord<[Number; 8]>,
        /// All roots lie within this distance of the centre.
        radius: Number,
        /// No other root lies within this distance; it may be smaller than the radius.
        uniqueness_radius: Number,
        /// Radius of the disc of t.
        reach: Number,
        /// Remainder over the leading term, the power of t with the multiplicity as exponent, on the circle; below 1.
        dominance: Number,
        /// `non_real` if no root is real; otherwise undecided.
        reality: ProvedReality,
        /// Discs that contain all poses.
        enclosure: Box<EnclosureRecord>,
    },
    /// Three angles as coordinates. The legs 14 24, 25 35, 36 16 put P4, P5, P6 on circles about the axes P1 P2, P2 P3,
    /// P3 P1. Their equation is h^2 + z^2 = rho. The coordinate z is along n = (P2 - P1) x (P3 - P1). The coordinate h
    /// points to the left of the way from the first joint to the second. With u = h + i z, the distance is the largest
    /// value `|log(u / centre)|` of the three.
    Octahedral {
        /// Legs 14 24 25 35 36 16, from 0.
        order: [usize; 6],
        /// u of P4, P5, P6, design units; rho / u is h - i z.
        centre: ComplexRecord<[Number; 3]>,
        /// Whether the root is the mirror image, in the plane of the base, of the pose near the centre.
        mirrored: bool,
        /// One pose lies within this angle of the centre.
        radius: Number,
        /// No other pose lies within this angle.
        uniqueness_radius: Number,
        /// Contraction of the simplified Newton map on that ball, below 1.
        contraction: Number,
        /// Precision of the centre.
        precision: CentrePrecision,
        /// Reality of the root, proved for all squared lengths within the rounding of the data.
        reality: ProvedReality,
        /// Discs that contain the pose.
        enclosure: Box<EnclosureRecord>,
    },
}

impl From<&RootCertificate> for CertificateRecord {
    fn from(c: &RootCertificate) -> Self {
        match c {
            RootCertificate::Study(c) => c.into(),
            RootCertificate::Octahedral(c) => c.into(),
            RootCertificate::Cluster(c) => c.into(),
        }
    }
}

impl From<&Certificate> for CertificateRecord {
    fn from(c: &Certificate) -> Self {
        Self::Study {
            patch: c.patch(),
            unit: Number(c.unit()),
            centre: (*c.centre()).into(),
            centre_low: (*c.low()).into(),
            radius: Number(c.radius()),
            uniqueness_radius: Number(c.uniqueness_radius()),
            contraction: Number(c.contraction()),
            precision: c.precision(),
            reality: c.reality(),
            enclosure: Box::new(c.enclosure().into()),
        }
    }
}

impl From<&ClusterCertificate> for CertificateRecord {
    fn from(c: &ClusterCertificate) -> Self {
        Self::Cluster {
            multiplicity: c.multiplicity(),
            patch: c.patch(),
            unit: Number(c.unit()),
            centre: (*c.centre()).into(),
            centre_low: (*c.low()).into(),
            radius: Number(c.radius()),
            uniqueness_radius: Number(c.uniqueness_radius()),
            reach: Number(c.reach()),
            dominance: Number(c.dominance()),
            reality: c.reality(),
            enclosure: Box::new(c.enclosure().into()),
        }
    }
}

impl From<&OctahedralCertificate> for CertificateRecord {
    fn from(c: &OctahedralCertificate) -> Self {
        let pair = c.pair();
        Self::Octahedral {
            order: c.order(),
            centre: pair.centre.into(),
            mirrored: c.is_mirrored(),
            radius: Number(pair.radius),
            uniqueness_radius: Number(pair.uniqueness_radius),
            contraction: Number(pair.contraction),
            precision: CentrePrecision::Double,
            reality: pair.reality,
            enclosure: Box::new(c.enclosure().into()),
        }
    }
}

view! {
    /// Discs that contain the entries of R and p of a root.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct EnclosureRecord {
        /// Rotation matrix entries, rows.
        #[serde(rename = "R")]
        pub rotation: DiscsRecord<[[Number; 3]; 3]> = DiscsRecord {
            re: rows(|d| d.centre.re),
            im: rows(|d| d.centre.im),
            radius: rows(|d| d.radius),
        },
        /// Position entries, design units.
        #[serde(rename = "p")]
        pub position: DiscsRecord<[Number; 3]> = DiscsRecord {
            re: three(|d| d.centre.re),
            im: three(|d| d.centre.im),
            radius: three(|d| d.radius),
        },
    }
    impl From(e: &PoseEnclosure) {
        let rows =
            |of: fn(&Disc) -> f64| e.rotation.each_ref().map(|row| row.each_ref().map(|d| Number(of(d))));
        let three = |of: fn(&Disc) -> f64| e.position.each_ref().map(|d| Number(of(d)));
    }
}

/// Discs in the complex plane, in some arrangement.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct DiscsRecord<T> {
    /// Real parts of centres.
    pub re: T,
    /// Imaginary parts of centres.
    pub im: T,
    /// Radii.
    pub radius: T,
}
