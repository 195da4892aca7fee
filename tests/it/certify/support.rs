//! Reference problems: roots to 31 digits, each number as a sum of two doubles.

use equipod::methods::geom::ComplexPose;
use equipod::methods::manipulator::{Leg, LegLengths, Manipulator};
use equipod::methods::num::double_double::{ComplexDoubleDouble, DoubleDouble};
use equipod::methods::num::interval::Interval;
use equipod::methods::solve::certify::{Certificate, CertificateOutcome, Certifier};
use nalgebra::{Matrix3, Point3, Vector3};

/// `R` row by row, then `p`.
pub(crate) type Root = [ComplexDoubleDouble; 12];

pub(crate) struct Problem {
    pub(crate) name: &'static str,
    pub(crate) manipulator: Manipulator,
    pub(crate) s: [Interval; 6],
    pub(crate) roots: Vec<Root>,
    pub(crate) real: Vec<bool>,
}

const FILES: [(&str, &str); 5] = [
    ("general66_00", include_str!("../../fixtures/reference/general66_00.json")),
    ("dietmaier40", include_str!("../../fixtures/reference/dietmaier40.json")),
    ("nearsing_00", include_str!("../../fixtures/reference/nearsing_00.json")),
    ("octahedral33_00", include_str!("../../fixtures/reference/octahedral33_00.json")),
    ("hexapod_00", include_str!("../../fixtures/reference/hexapod_00.json")),
];

#[derive(serde::Deserialize)]
struct File {
    base: [[f64; 3]; 6],
    platform: [[f64; 3]; 6],
    leg_lengths: [f64; 6],
    real: Vec<bool>,
    solutions: Vec<Vec<f64>>,
}

pub(crate) fn manipulator(base: &[[f64; 3]; 6], platform: &[[f64; 3]; 6]) -> Manipulator {
    let leg = |i: usize| Leg { base: Point3::from(base[i]), platform: Point3::from(platform[i]) };
    Manipulator::from_legs(std::array::from_fn(leg)).unwrap()
}

fn root(v: &[f64]) -> Root {
    let part = |k: usize| DoubleDouble::from_sum(v[2 * k], v[2 * k + 1]);
    std::array::from_fn(|k| ComplexDoubleDouble { re: part(2 * k), im: part(2 * k + 1) })
}

pub(crate) fn pose(root: &Root) -> ComplexPose {
    ComplexPose {
        rotation: Matrix3::from_fn(|i, j| root[3 * i + j].hi()),
        position: Vector3::from_fn(|i, _| root[9 + i].hi()),
    }
}

pub(crate) fn problem(name: &str) -> Problem {
    let (name, text) = FILES.into_iter().find(|f| f.0 == name).unwrap();
    let file: File = serde_json::from_str(text).unwrap();
    Problem {
        name,
        manipulator: manipulator(&file.base, &file.platform),
        s: LegLengths::try_new(file.leg_lengths).unwrap().squared().intervals(),
        roots: file.solutions.iter().map(|v| root(v)).collect(),
        real: file.real,
    }
}

pub(crate) fn problems() -> Vec<Problem> {
    FILES.iter().map(|f| problem(f.0)).collect()
}

impl Problem {
    pub(crate) fn certifier(&self) -> Certifier {
        Certifier::new(&self.manipulator, &self.s).unwrap()
    }

    pub(crate) fn certificates(&self) -> Vec<Certificate> {
        let certifier = self.certifier();
        let certify = |(i, root)| match certifier.certify(&pose(root)) {
            CertificateOutcome::Certified(c) => c,
            CertificateOutcome::Absent(why) => panic!("{} root {i}: {why}", self.name),
        };
        self.roots.iter().enumerate().map(certify).collect()
    }
}

/// `true` when the enclosure of the certificate holds the 31-digit root.
pub(crate) fn encloses(c: &Certificate, root: &Root) -> bool {
    c.enclosure().discs().zip(root).all(|(disc, z)| {
        let gap = *z - ComplexDoubleDouble::from(disc.centre);
        gap.hi().norm() <= disc.radius + 1e-29 * z.hi().norm()
    })
}
