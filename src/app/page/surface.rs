//! Singular surfaces in space: `det A` over three offsets, and `det J` over the positions of the platform at its
//! orientation.

use nalgebra::Vector3;
use serde::Serialize;

use super::opening::reach;
use super::request::Refusal;
use super::scene::sign;
use super::session::Equivalent;
use ask::Design;
use files::plot::{TriangleSurface, ValueBox};
use platform::geom::Pose;
use platform::manipulator::jacobian;

/// Greatest number of points along each side.
const MOST: usize = 61;
/// Number of points along each side for checking whether a platform is singular everywhere.
const COARSE: usize = 3;

/// A surface of triangles in a box.
#[derive(Debug, Serialize)]
pub(super) struct SurfaceRecord {
    low: [f64; 3],
    high: [f64; 3],
    vertices: Vec<[f64; 3]>,
    /// The triangles, each as three indices of vertices.
    triangles: Vec<[usize; 3]>,
}

impl SurfaceRecord {
    fn new(found: TriangleSurface, [low, high]: [[f64; 3]; 2], points: usize) -> Self {
        let last = points as f64 - 1.0;
        let place = |v: [f64; 3]| [0, 1, 2].map(|k| low[k] + v[k] / last * (high[k] - low[k]));
        Self {
            low,
            high,
            vertices: found.vertices.into_iter().map(place).collect(),
            triangles: found.triangles,
        }
    }
}

/// The singular poses about home with one orientation.
#[derive(Debug, Serialize)]
pub(super) struct LocusRecord {
    /// Whether every pose is singular: there is no surface.
    everywhere: bool,
    /// The greatest translations of the workspace to either side of home, design units.
    workspace: [f64; 3],
    home: [f64; 3],
    surface: SurfaceRecord,
}

fn few(points: usize) -> Result<(), Refusal> {
    if (2..=MOST).contains(&points) {
        return Ok(());
    }
    Err(Refusal::new("request", format!("2 to {MOST} points are needed")))
}

/// Values at all points of a box, the first coordinate fastest.
fn values<E>(
    [low, high]: [[f64; 3]; 2],
    points: usize,
    mut f: impl FnMut([f64; 3]) -> Result<f64, E>,
) -> Result<ValueBox, E> {
    let last = points as f64 - 1.0;
    let mut values = Vec::with_capacity(points.pow(3));
    for z in 0..points {
        for y in 0..points {
            for x in 0..points {
                let at = [x, y, z];
                values.push(f([0, 1, 2].map(|k| low[k] + at[k] as f64 / last * (high[k] - low[k])))?);
            }
        }
    }
    Ok(ValueBox { points, values })
}

/// The surface `det A = 0` over three offsets; the others stay fixed.
pub(super) fn offsets(
    e: &Equivalent,
    axes: [usize; 3],
    [low, high]: [f64; 2],
    points: usize,
) -> Result<SurfaceRecord, Refusal> {
    few(points)?;
    let different = axes[0] != axes[1] && axes[1] != axes[2] && axes[2] != axes[0];
    if !(different && low < high && high - low < f64::INFINITY) {
        return Err(Refusal::new("request", "three different offsets and low < high are needed"));
    }
    let ends = [[low; 3], [high; 3]];
    let found = values(ends, points, |at| e.with(&[0, 1, 2].map(|k| (axes[k], at[k]))))?;
    Ok(SurfaceRecord::new(found.surface(0.0), ends, points))
}

/// The positions with the orientation of a pose at which `det J = 0`, about home within the range of the page's
/// sliders.
///
/// `J` is the Jacobian of the leg lengths, with rotations multiplied by the characteristic length. Positions at which a
/// leg has no length are left out.
pub(super) fn locus(
    design: &Design,
    home: &Pose,
    pose: &Pose,
    points: usize,
) -> Result<LocusRecord, Refusal> {
    few(points)?;
    let half = Vector3::from(reach(design).0);
    let ends = [(home.position - half).into(), (home.position + half).into()];
    let matrix = |at: [f64; 3]| {
        let there = Pose { rotation: pose.rotation, position: Vector3::from(at) };
        jacobian(design.manipulator(), &there, design.characteristic_length())
    };
    let mut everywhere = true;
    values(ends, COARSE, |at| {
        everywhere &= sign(&matrix(at)) == 0;
        Ok::<_, Refusal>(0.0)
    })?;
    let found = if everywhere {
        TriangleSurface::default()
    } else {
        values(ends, points, |at| Ok::<_, Refusal>(matrix(at).determinant()))?.surface(0.0)
    };
    Ok(LocusRecord {
        everywhere,
        workspace: design.workspace_or_default().space(home).reach().0.into(),
        home: home.position.into(),
        surface: SurfaceRecord::new(found, ends, points),
    })
}
