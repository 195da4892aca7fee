//! Gaussian elimination with complete pivoting in complex double-double arithmetic.

use num_complex::Complex64;

use num::double_double::ComplexDoubleDouble as Number;

/// A matrix brought to upper triangular form in its first columns, the pivots on the diagonal.
#[derive(Debug, Clone)]
pub(super) struct Triangularised {
    rows: Vec<Vec<Number>>,
    /// `columns[k]`: which unknown the pivot of row `k` belongs to; the unknowns without pivot follow.
    columns: Vec<usize>,
    odd: bool,
}

fn size(z: Number) -> f64 {
    z.hi().l1_norm()
}

impl Triangularised {
    /// Eliminates in the first `unknowns` columns; the columns after them are right-hand sides.
    pub(super) fn new(mut rows: Vec<Vec<Number>>, unknowns: usize) -> Self {
        let mut columns: Vec<usize> = (0..unknowns).collect();
        let mut odd = false;
        for k in 0..rows.len().min(unknowns) {
            let mut best = (k, k, -1.0);
            for (i, row) in rows.iter().enumerate().skip(k) {
                for (j, z) in row.iter().enumerate().take(unknowns).skip(k) {
                    if size(*z) > best.2 {
                        best = (i, j, size(*z));
                    }
                }
            }
            if best.2 <= 0.0 {
                break;
            }
            odd ^= (best.0 != k) ^ (best.1 != k);
            rows.swap(k, best.0);
            columns.swap(k, best.1);
            for row in &mut rows {
                row.swap(k, best.1);
            }
            let (done, rest) = rows.split_at_mut(k + 1);
            let pivot_row = &done[k];
            for row in rest {
                let factor = row[k] / pivot_row[k];
                row[k] = Number::ZERO;
                if size(factor) > 0.0 {
                    for (x, p) in row.iter_mut().zip(pivot_row).skip(k + 1) {
                        *x = *x - factor * *p;
                    }
                }
            }
        }
        Self { rows, columns, odd }
    }

    /// Smallest pivot over largest.
    pub(super) fn pivot_ratio(&self) -> f64 {
        let pivots = self.rows.iter().enumerate().map(|(k, r)| size(r[k]));
        let (low, high) = pivots.fold((f64::INFINITY, 0.0f64), |(a, b), p| (p.min(a), p.max(b)));
        low / high
    }

    /// Determinant of a square matrix.
    pub(super) fn determinant(&self) -> Number {
        let one = Number::from(Complex64::ONE);
        let product = self.rows.iter().enumerate().fold(one, |z, (k, r)| z * r[k]);
        if self.odd { -product } else { product }
    }

    /// The unknowns for right-hand side `column` of `M x = b`, the unknown without pivot (if any) zero.
    pub(super) fn solution(&self, column: usize) -> Vec<Number> {
        self.back(self.rows.len(), |row| row[self.columns.len() + column], None)
    }

    /// A vector of the null space: the last unknown in pivot order is one, rows beyond the others are ignored.
    pub(super) fn null_vector(&self) -> Vec<Number> {
        let last = self.columns.len() - 1;
        self.back(last, |row| -row[last], Some(last))
    }

    fn back(&self, count: usize, right: impl Fn(&[Number]) -> Number, free: Option<usize>) -> Vec<Number> {
        let mut x = vec![Number::ZERO; self.columns.len()];
        if let Some(free) = free {
            x[self.columns[free]] = Number::from(Complex64::ONE);
        }
        for k in (0..count).rev() {
            let row = &self.rows[k];
            let mut sum = right(row);
            for j in k + 1..count {
                sum = sum - row[j] * x[self.columns[j]];
            }
            x[self.columns[k]] = sum / row[k];
        }
        x
    }
}
