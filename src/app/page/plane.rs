//! `det A` over two offsets of an equivalent platform.

use serde::Serialize;

use super::request::Refusal;
use super::session::Equivalent;
use files::plot::ValueGrid;

/// Greatest number of points along each side.
const MOST: usize = 201;

impl Equivalent {
    /// The offsets with new values for some.
    fn changed(&self, changes: &[(usize, f64)]) -> Result<Vec<f64>, Refusal> {
        let mut offsets = self.offsets.clone();
        for (k, value) in changes {
            match offsets.get_mut(*k) {
                Some(place) => *place = *value,
                None => return Err(Refusal::new("offsets", format!("there is no offset {}", k + 1))),
            }
        }
        Ok(offsets)
    }

    /// The platform with new values for some offsets.
    pub(super) fn moved(&self, changes: &[(usize, f64)]) -> Result<Self, Refusal> {
        Ok(Self { pattern: self.pattern.clone(), offsets: self.changed(changes)? })
    }

    /// `det A` with new values for some offsets.
    pub(super) fn with(&self, changes: &[(usize, f64)]) -> Result<f64, Refusal> {
        self.pattern.determinant(&self.changed(changes)?).map_err(|e| Refusal::new("offsets", e))
    }

    /// For each offset, the value for which `det A` vanishes while the others stay fixed; `det A` is affine in every
    /// single offset. `None` if it does not depend on the offset.
    pub(super) fn zeros(&self) -> Result<Vec<Option<f64>>, Refusal> {
        (0..self.offsets.len())
            .map(|k| {
                let (at_0, at_1) = (self.with(&[(k, 0.0)])?, self.with(&[(k, 1.0)])?);
                let zero = at_0 / (at_0 - at_1);
                Ok(zero.is_finite().then_some(zero))
            })
            .collect()
    }
}

/// `det A` on a square of two offsets.
#[derive(Debug, Serialize)]
pub(super) struct PlaneRecord {
    /// Number of points along each side.
    points: usize,
    low: f64,
    high: f64,
    /// The values row by row, the first offset to the right.
    values: Vec<f64>,
    /// The lines on which `det A` vanishes.
    zero: Vec<Vec<[f64; 2]>>,
}

/// The places of the points of a square of two offsets.
pub(super) fn square(
    [i, j]: [usize; 2],
    [low, high]: [f64; 2],
    points: usize,
) -> Result<impl Fn(usize) -> f64, Refusal> {
    if i == j || !(2..=MOST).contains(&points) || !(low < high && high - low < f64::INFINITY) {
        return Err(Refusal::new(
            "request",
            "two different offsets, low < high and 2 to 201 points are needed",
        ));
    }
    Ok(move |k: usize| low + k as f64 / (points as f64 - 1.0) * (high - low))
}

/// Values on a square of two offsets, row by row with the first offset to the right, and their zero lines.
pub(super) fn record(
    e: &Equivalent,
    [i, j]: [usize; 2],
    [low, high]: [f64; 2],
    points: usize,
) -> Result<PlaneRecord, Refusal> {
    let at = square([i, j], [low, high], points)?;
    let place = |k: f64| low + k / (points as f64 - 1.0) * (high - low);
    let mut values = Vec::with_capacity(points * points);
    for row in 0..points {
        for column in 0..points {
            values.push(e.with(&[(i, at(column)), (j, at(row))])?);
        }
    }
    let grid = ValueGrid { columns: points, rows: points, values };
    let lines = grid.contour(0.0).into_iter();
    let zero = lines.map(|line| line.into_iter().map(|(x, y)| [place(x), place(y)]).collect()).collect();
    Ok(PlaneRecord { points, low, high, values: grid.values, zero })
}
