//! The singularity surface over two freedoms.

use crate::app::cli::freedoms::{Freedoms, PoseGrid};
use ask::Design;
use files::plot::SliceFigure;
use platform::geom::Pose;
use platform::manipulator::plucker_matrix;
use synthesis::singularity::BoxOptions;

/// Number of grid points along each side.
const SIDE: usize = 161;
/// Half width for rotations, degrees.
const DEGREES: f64 = 90.0;

/// `det J` about the pose: positions over three times the box and at least 1.5 times the size, rotations over 90
/// degrees in each direction.
pub(crate) fn figure(design: &Design, freedoms: Freedoms, pose: &Pose, options: &BoxOptions) -> SliceFigure {
    let m = design.manipulator();
    let places = freedoms.places();
    let far = places.iter().filter(|k| **k < 3).map(|k| 3.0 * options.translation[*k]);
    let far = far.fold(1.5 * m.size(), f64::max);
    let half = places.map(|k| if k < 3 { far } else { DEGREES });
    let grid = PoseGrid { freedoms, middle: *pose, half, side: SIDE };
    let [across, up] = grid.axes(design);
    SliceFigure {
        title: format!("Singular poses of {}", design.name),
        quantity: "det J".into(),
        note: "the other four coordinates are those of the marked pose; rotation vector in the base frame; det J of the leg lines"
            .into(),
        across,
        up,
        side: SIDE,
        values: grid.poses().map(|moved| plucker_matrix(m, &moved, m.size()).determinant()).collect(),
        mark: Some((grid.centre(), "pose".into())),
    }
}
