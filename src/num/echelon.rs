//! Row echelon forms modulo a prime of 61 bits.
//!
//! A row is reduced in accumulators of 128 bits. Products are added without division, and each column is reduced once,
//! when the elimination reaches it (delayed reduction; Dumas, Giorgi, Pernet 2008).

use super::modular::Field;

/// `sum + x y`, below `ceiling = 2^62 p`; products of residues are smaller.
#[inline]
fn add_product(sum: u128, x: u64, y: u64, ceiling: u128) -> u128 {
    let next = sum + u128::from(x) * u128::from(y);
    if next >= ceiling { next - ceiling } else { next }
}

/// The span of rows, in echelon form: leading entries are one, in different columns.
#[derive(Debug, Clone)]
pub struct Echelon {
    field: Field,
    /// `2^62 p`, the upper limit of accumulators.
    ceiling: u128,
    /// Row with its leading entry in a column.
    of_column: Vec<Option<usize>>,
    rows: Vec<Vec<u64>>,
    work: Vec<u128>,
}

impl Echelon {
    /// No rows yet, `width` columns; the prime is between `2^60` and `2^61`.
    pub fn new(field: Field, width: usize) -> Self {
        Self {
            field,
            ceiling: u128::from(field.prime()) << 62,
            of_column: vec![None; width],
            rows: Vec::new(),
            work: vec![0; width],
        }
    }

    /// Number of independent rows.
    #[cfg(test)]
    pub fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Adds a row of residues; returns the column of its leading entry after elimination, or `None` if it depends on
    /// the earlier rows.
    pub fn insert(&mut self, row: &[u64]) -> Option<usize> {
        let Self { field, ceiling, work, .. } = self;
        for (w, x) in work.iter_mut().zip(row) {
            *w = u128::from(*x);
        }
        for column in 0..work.len() {
            let x = field.reduced(work[column]);
            if x == 0 {
                continue;
            }
            let Some(known) = self.of_column[column] else {
                let inverse = field.inverse(x);
                let mut own = vec![0; work.len()];
                own[column] = 1;
                for k in column + 1..work.len() {
                    own[k] = field.mul(field.reduced(work[k]), inverse);
                }
                self.of_column[column] = Some(self.rows.len());
                self.rows.push(own);
                return Some(column);
            };
            let negative = field.prime() - x;
            for (w, y) in work[column..].iter_mut().zip(&self.rows[known][column..]) {
                *w = add_product(*w, negative, *y, *ceiling);
            }
        }
        None
    }

    /// Clears the leading columns in all other rows.
    pub fn reduce_fully(&mut self) {
        let width = self.of_column.len();
        let leading: Vec<usize> = (0..width).filter(|c| self.of_column[*c].is_some()).collect();
        let free: Vec<usize> = (0..width).filter(|c| self.of_column[*c].is_none()).collect();
        let Self { field, ceiling, work, .. } = self;
        for (place, &column) in leading.iter().enumerate().rev() {
            let Some(own) = self.of_column[column] else { continue };
            for &k in &free {
                work[k] = u128::from(self.rows[own][k]);
            }
            for &later in &leading[place + 1..] {
                let x = self.rows[own][later];
                let Some(other) = self.of_column[later].filter(|_| x != 0) else { continue };
                // the other row has no entries left in leading columns except its own
                for &k in &free {
                    work[k] = add_product(work[k], field.prime() - x, self.rows[other][k], *ceiling);
                }
                self.rows[own][later] = 0;
            }
            for &k in &free {
                self.rows[own][k] = field.reduced(work[k]);
            }
        }
    }

    /// The row with its leading entry in a column.
    pub fn leading_in(&self, column: usize) -> Option<&[u64]> {
        self.of_column[column].map(|r| self.rows[r].as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    #[test]
    fn sums_of_products_stay_below_the_ceiling() {
        let mut rng = Rng::new(8);
        for _ in 0..200 {
            let field = Field::drawn(&mut rng);
            let p = u128::from(field.prime());
            let ceiling = p << 62;
            let (x, y) = (rng.next_u64() % field.prime(), rng.next_u64() % field.prime());
            let sum = add_product(ceiling - 1, x, y, ceiling);
            assert!(sum < ceiling);
            assert_eq!(
                u128::from(field.reduced(sum)),
                ((ceiling - 1) % p + u128::from(x) * u128::from(y)) % p
            );
        }
    }

    #[test]
    fn rank_and_reduced_rows_agree_with_elimination_by_cross_multiplication() {
        let mut rng = Rng::new(9);
        let field = Field::drawn(&mut rng);
        for rank in 0..6 {
            // eight rows of seven entries, combinations of `rank` of them
            let seeds: Vec<[u64; 7]> =
                (0..rank).map(|_| std::array::from_fn(|_| rng.next_u64() % field.prime())).collect();
            let rows: Vec<[u64; 7]> = (0..8)
                .map(|_| {
                    let mut row = [0; 7];
                    for seed in &seeds {
                        let c = rng.next_u64() % field.prime();
                        for k in 0..7 {
                            row[k] = field.add(row[k], field.mul(c, seed[k]));
                        }
                    }
                    row
                })
                .collect();
            let mut echelon = Echelon::new(field, 7);
            for row in &rows {
                echelon.insert(row);
            }
            echelon.reduce_fully();
            assert_eq!((echelon.rank(), field.rank(rows.clone())), (rank, rank));
            let leading: Vec<usize> = (0..7).filter(|c| echelon.leading_in(*c).is_some()).collect();
            for &c in &leading {
                let row = echelon.leading_in(c).unwrap();
                assert!(leading.iter().all(|k| row[*k] == u64::from(*k == c)));
                let mut more = rows.clone();
                more.push(std::array::from_fn(|k| row[k]));
                assert_eq!(field.rank(more), rank);
            }
        }
    }
}
