//! Elimination over fields of square roots and modulo a prime alike.

use super::modular::Field;
use super::surd::Surd;

/// A field; `None` from an operation when numbers become too long.
pub trait Arithmetic {
    /// Its numbers.
    type Number: Clone + PartialEq;
    /// Zero.
    fn zero(&self) -> Self::Number;
    /// One.
    fn one(&self) -> Self::Number;
    /// A sum.
    fn plus(&self, x: &Self::Number, y: &Self::Number) -> Option<Self::Number>;
    /// A difference.
    fn minus(&self, x: &Self::Number, y: &Self::Number) -> Option<Self::Number>;
    /// A product.
    fn times(&self, x: &Self::Number, y: &Self::Number) -> Option<Self::Number>;
    /// The inverse; `None` for zero.
    fn inverse(&self, x: &Self::Number) -> Option<Self::Number>;
}

/// Sums of square roots.
#[derive(Debug)]
pub struct SurdArithmetic;

impl Arithmetic for SurdArithmetic {
    type Number = Surd;
    fn zero(&self) -> Surd {
        Surd::zero()
    }
    fn one(&self) -> Surd {
        Surd::integer(1)
    }
    fn plus(&self, x: &Surd, y: &Surd) -> Option<Surd> {
        x.plus(y)
    }
    fn minus(&self, x: &Surd, y: &Surd) -> Option<Surd> {
        x.minus(y)
    }
    fn times(&self, x: &Surd, y: &Surd) -> Option<Surd> {
        x.times(y)
    }
    fn inverse(&self, x: &Surd) -> Option<Surd> {
        x.inverse()
    }
}

impl Arithmetic for Field {
    type Number = u64;
    fn zero(&self) -> u64 {
        0
    }
    fn one(&self) -> u64 {
        1
    }
    fn plus(&self, x: &u64, y: &u64) -> Option<u64> {
        Some(self.add(*x, *y))
    }
    fn minus(&self, x: &u64, y: &u64) -> Option<u64> {
        Some(self.sub(*x, *y))
    }
    fn times(&self, x: &u64, y: &u64) -> Option<u64> {
        Some(self.mul(*x, *y))
    }
    fn inverse(&self, x: &u64) -> Option<u64> {
        (*x != 0).then(|| Field::inverse(*self, *x))
    }
}

/// Rows of equal length.
pub type Rows<A> = Vec<Vec<<A as Arithmetic>::Number>>;

/// Brings rows to echelon form, leading entries one with zeros above them, without zero rows; the columns of these
/// entries.
pub fn eliminate<A: Arithmetic>(field: &A, rows: &mut Rows<A>) -> Option<Vec<usize>> {
    let width = rows.first().map_or(0, Vec::len);
    let leading = eliminate_first(field, rows, width)?;
    rows.truncate(leading.len());
    Some(leading)
}

/// Brings the first columns to echelon form, leading entries one with zeros above them; the columns of these entries.
pub fn eliminate_first<A: Arithmetic>(field: &A, rows: &mut Rows<A>, width: usize) -> Option<Vec<usize>> {
    let (zero, mut leading) = (field.zero(), Vec::new());
    for column in 0..width {
        let rank = leading.len();
        let Some(pivot) = (rank..rows.len()).find(|i| rows[*i][column] != zero) else { continue };
        rows.swap(rank, pivot);
        let inverse = field.inverse(&rows[rank][column])?;
        let head: Vec<_> = rows[rank].iter().map(|x| field.times(x, &inverse)).collect::<Option<_>>()?;
        for (i, row) in rows.iter_mut().enumerate() {
            let factor = row[column].clone();
            if i != rank && factor != zero {
                for (x, h) in row.iter_mut().zip(&head).filter(|(_, h)| **h != zero) {
                    *x = field.minus(x, &field.times(&factor, h)?)?;
                }
            }
        }
        rows[rank] = head;
        leading.push(column);
    }
    Some(leading)
}

/// A basis of the vectors that all rows annul.
pub fn kernel<A: Arithmetic>(field: &A, mut rows: Rows<A>, width: usize) -> Option<Rows<A>> {
    let leading = eliminate(field, &mut rows)?;
    let free = (0..width).filter(|c| !leading.contains(c));
    free.map(|f| {
        let mut vector = vec![field.zero(); width];
        vector[f] = field.one();
        for (row, column) in rows.iter().zip(&leading) {
            vector[*column] = field.minus(&field.zero(), &row[f])?;
        }
        Some(vector)
    })
    .collect()
}
