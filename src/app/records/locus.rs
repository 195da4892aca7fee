//! Answers on the squared length of a virtual leg at all poses while one leg length varies.

use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, leg_number};
use ask::{LocusPoint, LocusReport, LocusWord};
use files::plot::{LocusMeeting, locus_meetings};
use fk::{Method, Reality};

view! {
    /// The answer of `plot locus`.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct LocusAnswer {
        /// Variable leg, from 1.
        pub leg: usize = leg_number(found.leg),
        /// Joints of the virtual leg.
        pub between: [String; 2] = found.between.names.clone(),
        /// The values at each length.
        pub rows: Vec<LocusRowRecord> = found.points.iter().enumerate().map(row).collect(),
        /// Interpolated lengths at which two real values meet.
        pub meetings: Vec<LocusMeeting> = locus_meetings(&found.steps()),
    }
    impl From(found: &LocusReport) {
        let row = |(step, point): (usize, &LocusPoint)| LocusRowRecord {
            step,
            length: Number(point.length),
            status: point.word(),
            all_paths_accounted: point.is_complete(),
            method: point.found.as_ref().map(|f| f.0.method),
            values: values(point),
        };
    }
}

/// The values at one length.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct LocusRowRecord {
    /// Step number, from 0.
    pub step: usize,
    /// Length of the variable leg, design units.
    pub length: Number,
    /// Structure of the set of poses; `failed`: it could not be computed.
    pub status: LocusWord,
    /// Whether every path is accounted for; false: poses may be missing.
    pub all_paths_accounted: bool,
    /// The method that found them.
    pub method: Option<Method>,
    /// The values, one for each pose.
    pub values: Vec<LocusValueRecord>,
}

/// The squared length of the virtual leg at one pose, design units squared.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct LocusValueRecord {
    /// The real part.
    pub re: Number,
    /// The imaginary part.
    pub im: Number,
    /// Whether the pose is real; null: undecided.
    pub real: Option<bool>,
    /// Whether the pose has a certificate.
    pub certified: bool,
    /// Number of paths, or roots of a polynomial, that end at the pose.
    pub multiplicity: u32,
}

fn values(point: &LocusPoint) -> Vec<LocusValueRecord> {
    let all = point.found.iter().flat_map(|(solutions, values)| solutions.roots.iter().zip(values));
    let value = all.map(|(root, v)| LocusValueRecord {
        re: Number(v.re),
        im: Number(v.im),
        real: match root.reality {
            Reality::Real => Some(true),
            Reality::NonReal => Some(false),
            Reality::Undecided => None,
        },
        certified: root.certified(),
        multiplicity: root.multiplicity,
    });
    value.collect()
}
