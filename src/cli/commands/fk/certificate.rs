//! Certificates of roots as JSON: everything that another program needs to check them with the design and its lengths.

use num_complex::Complex64;
use serde_json::{Value, json};

use crate::cli::output::number;
use crate::num::disc::Disc;
use crate::solve::certify::octahedral::OctahedralCertificate;
use crate::solve::certify::{CentrePrecision, Certificate, PoseEnclosure, ProvedReality, RootCertificate};

/// The field `certificate` of a solution.
pub(super) fn json(c: &RootCertificate) -> Value {
    match c {
        RootCertificate::Study(c) => study(c),
        RootCertificate::Octahedral(c) => octahedral(c),
    }
}

fn study(c: &Certificate) -> Value {
    json!({
        "kind": "study",
        "patch": c.patch(),
        "unit": number(c.unit()),
        "centre": complex(c.centre()),
        "centre_low": complex(c.low()),
        "radius": number(c.radius()),
        "uniqueness_radius": number(c.uniqueness_radius()),
        "contraction": number(c.contraction()),
        "precision": match c.precision() {
            CentrePrecision::Double => "double",
            CentrePrecision::DoubleDouble => "double_double",
        },
        "reality": reality(c.reality()),
        "enclosure": enclosure(c.enclosure()),
    })
}

fn octahedral(c: &OctahedralCertificate) -> Value {
    let pair = c.pair();
    json!({
        "kind": "octahedral",
        "order": c.order(),
        "weights": pair.weights.map(number),
        "centre": complex(&pair.squared_distances.map(|d| d.centre)),
        "radius": number(pair.radius),
        "uniqueness_radius": number(pair.uniqueness_radius),
        "contraction": number(pair.contraction),
        "height": complex(&[c.height()]),
        "precision": "double",
        "reality": reality(pair.reality),
        "enclosure": enclosure(c.enclosure()),
    })
}

fn reality(r: ProvedReality) -> &'static str {
    match r {
        ProvedReality::Real => "real",
        ProvedReality::NonReal => "non_real",
        ProvedReality::Undecided => "undecided",
    }
}

fn complex(z: &[Complex64]) -> Value {
    let part = |of: fn(&Complex64) -> f64| -> Value { z.iter().map(|z| number(of(z))).collect() };
    json!({ "re": part(|z| z.re), "im": part(|z| z.im) })
}

fn enclosure(e: &PoseEnclosure) -> Value {
    let rows = |of: fn(&Disc) -> f64| -> Value {
        e.rotation.iter().map(|row| row.iter().map(|d| number(of(d))).collect::<Value>()).collect()
    };
    let three = |of: fn(&Disc) -> f64| -> Value { e.position.iter().map(|d| number(of(d))).collect() };
    json!({
        "R": { "re": rows(|d| d.centre.re), "im": rows(|d| d.centre.im), "radius": rows(|d| d.radius) },
        "p": { "re": three(|d| d.centre.re), "im": three(|d| d.centre.im), "radius": three(|d| d.radius) },
    })
}
