//! Two of the six freedoms of a platform, for pictures over them.

use nalgebra::{Rotation3, Vector3};

use ask::Design;
use files::plot::SliceAxis;
use platform::geom::Pose;

const NAMES: [&str; 6] = ["x", "y", "z", "rx", "ry", "rz"];

/// Two of `x, y, z` (positions) and `rx, ry, rz` (rotation vector in the base frame).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Freedoms([usize; 2]);

impl Freedoms {
    /// Two names separated by a comma.
    pub(crate) fn parse(text: &str) -> Result<Self, String> {
        let place = |name: &str| NAMES.iter().position(|n| *n == name.trim());
        match text.split_once(',').map(|(a, b)| (place(a), place(b))) {
            Some((Some(a), Some(b))) if a != b => Ok(Self([a, b])),
            _ => Err(format!("give two different ones of {}", NAMES.join(", "))),
        }
    }

    /// Their indices among the six; positions are below 3.
    pub(crate) fn places(self) -> [usize; 2] {
        self.0
    }
}

/// A square grid of poses around a pose, over two freedoms.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PoseGrid {
    pub(crate) freedoms: Freedoms,
    pub(crate) middle: Pose,
    /// Half widths, design units or degrees.
    pub(crate) half: [f64; 2],
    /// Number of points along each side, at least two.
    pub(crate) side: usize,
}

impl PoseGrid {
    /// The place of the central pose on the axes: its position, and no rotation.
    pub(crate) fn centre(&self) -> (f64, f64) {
        let at = |place: usize| if place < 3 { self.middle.position[place] } else { 0.0 };
        (at(self.freedoms.0[0]), at(self.freedoms.0[1]))
    }

    /// The axes: to the right and upwards.
    pub(crate) fn axes(&self, design: &Design) -> [SliceAxis; 2] {
        let centre = [self.centre().0, self.centre().1];
        std::array::from_fn(|k| {
            let place = self.freedoms.0[k];
            let unit = if place < 3 { design.units.as_str() } else { "degrees" };
            let label = format!("{} [{unit}]", NAMES[place]);
            SliceAxis { label, low: centre[k] - self.half[k], high: centre[k] + self.half[k] }
        })
    }

    /// All poses, row by row from the lowest.
    pub(crate) fn poses(&self) -> impl Iterator<Item = Pose> {
        let grid = *self;
        (0..self.side * self.side).map(move |k| grid.pose(k % grid.side, k / grid.side))
    }

    fn pose(&self, column: usize, row: usize) -> Pose {
        let (mut shift, mut turn) = (Vector3::zeros(), Vector3::zeros());
        for (k, i) in [column, row].into_iter().enumerate() {
            let place = self.freedoms.0[k];
            let step = self.half[k] * (2.0 * i as f64 / (self.side as f64 - 1.0) - 1.0);
            if place < 3 {
                shift[place] = step;
            } else {
                turn[place - 3] = step.to_radians();
            }
        }
        Pose { rotation: Rotation3::new(turn) * self.middle.rotation, position: self.middle.position + shift }
    }
}
