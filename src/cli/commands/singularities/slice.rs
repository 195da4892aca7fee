//! The singularity surface over two freedoms.

use nalgebra::{Rotation3, Vector3};

use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::plucker_matrix;
use crate::plot::{SliceAxis, SliceFigure};
use crate::singularity::BoxOptions;

const NAMES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];
/// Grid points a side.
const SIDE: usize = 161;
/// Rotations shown each way, degrees.
const DEGREES: f64 = 90.0;

/// Two of the six freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Slice([usize; 2]);

impl Slice {
    /// Two names separated by a comma.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let place = |name: &str| NAMES.iter().position(|n| *n == name.trim());
        match text.split_once(',').map(|(a, b)| (place(a), place(b))) {
            Some((Some(a), Some(b))) if a != b => Ok(Self([a, b])),
            _ => Err(format!("give two different ones of {}", NAMES.join(", "))),
        }
    }

    /// `det J` about the pose: positions three times the box and at least 1.5 times the size, rotations 90 degrees each way.
    pub(super) fn figure(self, design: &Design, pose: &Pose, options: &BoxOptions) -> SliceFigure {
        let m = design.manipulator();
        let far = self.0.iter().filter(|k| **k < 3).map(|k| 3.0 * options.translation[*k]);
        let far = far.fold(1.5 * m.size(), f64::max);
        let half = |k: usize| if k < 3 { far } else { DEGREES };
        let middle = |k: usize| if k < 3 { pose.position[k] } else { 0.0 };
        let axis = |k: usize| {
            let unit = if k < 3 { design.units.as_str() } else { "degrees" };
            let label = format!("{} [{unit}]", NAMES[k]);
            SliceAxis { label, low: middle(k) - half(k), high: middle(k) + half(k) }
        };
        let step = |k: usize, i: usize| half(k) * (2.0 * i as f64 / (SIDE as f64 - 1.0) - 1.0);
        let value = |index: usize| {
            let moves = [(self.0[0], index % SIDE), (self.0[1], index / SIDE)];
            let (mut shift, mut turn) = (Vector3::zeros(), Vector3::zeros());
            for (k, i) in moves {
                if k < 3 {
                    shift[k] = step(k, i);
                } else {
                    turn[k - 3] = step(k, i).to_radians();
                }
            }
            let moved =
                Pose { rotation: Rotation3::new(turn) * pose.rotation, position: pose.position + shift };
            plucker_matrix(m, &moved, m.size()).determinant()
        };
        SliceFigure {
            title: format!("Singular poses of {}", design.name),
            note: "the other four freedoms are those of the marked pose; rotation vector in the base frame; det J of the leg lines"
                .into(),
            across: axis(self.0[0]),
            up: axis(self.0[1]),
            side: SIDE,
            values: (0..SIDE * SIDE).map(value).collect(),
            mark: Some(((middle(self.0[0]), middle(self.0[1])), "pose".into())),
        }
    }
}
