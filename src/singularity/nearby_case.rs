//! The name of a singular design that is known in doubles only: dimensions and maps decided with a tolerance.

use nalgebra::{Point3, Vector3};

use super::griffis_duffy::GriffisDuffy;
use crate::manipulator::Manipulator;
use crate::num::linalg::{LinalgError, svd};

/// Singular values below this times the largest count as zero; names only, nothing is decided with it.
const NEGLIGIBLE: f64 = 1e-7;

/// The case of a relation between the vectors of `legs`; codes as in [`Case::name`](super::Case::name).
pub(super) fn name(m: &Manipulator, legs: &[usize]) -> Result<&'static str, LinalgError> {
    let all = m.legs();
    let base = plane_coordinates(m, &legs.iter().map(|i| all[*i].base).collect::<Vec<_>>())?;
    let platform = plane_coordinates(m, &legs.iter().map(|i| all[*i].platform).collect::<Vec<_>>())?;
    Ok(match (base.dimension, platform.dimension) {
        (0, 0) => "coincident_legs",
        (0, 1) | (1, 0) => "point_line",
        (0, _) | (_, 0) => "concurrent_four",
        (1, 1) => "line_line",
        (1, _) | (_, 1) => "line_other",
        // nothing but two planes is left for a relation of six legs or fewer
        _ if legs.len() == 6 && GriffisDuffy::recognise(m).is_some_and(|g| g.is_nearly_singular()) => {
            "griffis_duffy"
        }
        _ if projective(&base.coordinates, &platform.coordinates)? => "conic",
        _ => "planar_bodies",
    })
}

struct Spread {
    dimension: usize,
    /// `(1, x, y)` along the two principal axes, in units of the largest spread.
    coordinates: Vec<[f64; 3]>,
}

fn plane_coordinates(m: &Manipulator, points: &[Point3<f64>]) -> Result<Spread, LinalgError> {
    let mean = points.iter().map(|p| p - points[0]).sum::<Vector3<f64>>() / points.len() as f64;
    let rows: Vec<Vec<f64>> =
        points.iter().map(|p| ((p - points[0] - mean) / m.size()).iter().copied().collect()).collect();
    let d = svd(&rows)?;
    let dimension = d.s.iter().filter(|s| **s > NEGLIGIBLE).count();
    let unit = if d.s[0] > 0.0 { d.s[0] } else { 1.0 };
    let along = |row: &[f64], k: usize| (0..3).map(|i| row[i] * d.v[i][k]).sum::<f64>() / unit;
    let coordinates = rows.iter().map(|row| [1.0, along(row, 0), along(row, 1)]).collect();
    Ok(Spread { dimension, coordinates })
}

/// Whether a projectivity takes one set to the other: `b_i x T a_i = 0`, linear in the nine entries of `T`, has a solution. With dependent leg
/// vectors the points then lie on a conic.
fn projective(a: &[[f64; 3]], b: &[[f64; 3]]) -> Result<bool, LinalgError> {
    let mut rows = Vec::new();
    for (a, b) in a.iter().zip(b) {
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            let mut row = vec![0.0; 9];
            for l in 0..3 {
                row[3 * last + l] = b[next] * a[l];
                row[3 * next + l] = -b[last] * a[l];
            }
            rows.push(row);
        }
    }
    let s = svd(&rows)?.s;
    Ok(s[8] <= NEGLIGIBLE * s[0])
}
