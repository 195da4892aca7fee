//! Answers on the squared length of a virtual leg at all poses while one leg length varies.

use num_complex::Complex64;
use schemars::JsonSchema;
use serde::Serialize;

use super::{Number, leg_number};
use ask::{LocusPoint, LocusReport, LocusWord};
use files::plot::{LocusMeeting, locus_meetings};
use fk::{FkRoot, Method, Reality};

view! {
    /// The answer of `plot locus`.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct LocusAnswer {
        /// Variable leg, from 1.
        pub leg: usize = leg_number(found.leg),
        /// Joints of the virtual leg.
        pub between: [String; 2] = found.between.names.clone(),
        /// The values at each length.
        pub rows: Vec<LocusRowRecord> = found.points.iter().enumerate().map(LocusRowRecord::of).collect(),
        /// Interpolated lengths at which two real values meet.
        pub meetings: Vec<LocusMeeting> = locus_meetings(&found.steps()),
    }
    impl From(found: &LocusReport) {}
}

view! {
    /// The values at one length.
    #[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
    pub struct LocusRowRecord {
        /// Step number, from 0.
        pub step: usize = step,
        /// Length of the variable leg, design units.
        pub length: Number = Number(point.length),
        /// Structure of the set of poses; `failed`: it could not be computed.
        pub status: LocusWord = point.word(),
        /// Whether every path is accounted for; false: poses may be missing.
        pub all_paths_accounted: bool = point.is_complete(),
        /// The method that found them.
        pub method: Option<Method> = point.found.as_ref().map(|f| f.0.method),
        /// The values, one for each pose.
        pub values: Vec<LocusValueRecord> = values(point),
    }
    fn of((step, point): (usize, &LocusPoint)) {}
}

view! {
    /// The squared length of the virtual leg at one pose, design units squared.
    #[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
    pub struct LocusValueRecord {
        /// The real part.
        pub re: Number = Number(v.re),
        /// The imaginary part.
        pub im: Number = Number(v.im),
        /// Whether the pose is real; null: undecided.
        pub real: Option<bool> = match root.reality {
            Reality::Real => Some(true),
            Reality::NonReal => Some(false),
            Reality::Undecided => None,
        },
        /// Whether the pose has a certificate.
        pub certified: bool = root.certified(),
        /// Number of paths, or roots of a polynomial, that end at the pose.
        pub multiplicity: u32 = root.multiplicity,
    }
    fn of((root, v): (&FkRoot, &Complex64)) {}
}

fn values(point: &LocusPoint) -> Vec<LocusValueRecord> {
    let all = point.found.iter().flat_map(|(solutions, values)| solutions.roots.iter().zip(values));
    all.map(LocusValueRecord::of).collect()
}
