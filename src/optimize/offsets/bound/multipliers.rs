//! The multipliers that minimise a sum of greatest values: a small linear program, by the simplex method on a dense
//! tableau.

/// Number of sampled offsets of each coordinate.
pub(super) const SAMPLES: usize = 7;
/// Values of one function of six offsets, a sum of functions of one offset each, at the samples.
pub(super) type Sampled = [[f64; SAMPLES]; 6];

/// Multipliers below this share of the largest are dropped; any set of multipliers is valid.
const NEGLIGIBLE: f64 = 1e-4;
/// Rows of the tableau: every sample but the first of each coordinate, and the bound of the sum.
const ROWS: usize = 6 * (SAMPLES - 1) + 1;
/// Perturbation of the right-hand sides, as a share of the largest entry, so that the method does not stall.
const APART: f64 = 1e-9;
/// Share of the largest entry below which an entry is no pivot, and a cost no gain.
const SMALL: f64 = 1e-12;
/// Greatest number of pivots: any multipliers give a valid bound, the best ones only a tighter one.
const MOST_PIVOTS: usize = 600;

/// Multipliers `mu >= 0`, `sum mu <= 1`, that minimise `sum_i max_j sum_k mu_k samples[k][i][j]`; `None` if the least
/// value is not below 0.
///
/// The greatest values `m_i` have slacks `s_ij = m_i - sum_k mu_k S_kij >= 0`. The first sample of each coordinate
/// eliminates them by `m_i = s_i0 + sum_k mu_k S_ki0`. The reduced program has the feasible start `mu = 0`, `s = 0`.
pub(super) fn multipliers(samples: &[Sampled]) -> Option<Vec<f64>> {
    let n = samples.len();
    let scale = samples.iter().flatten().flatten().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(scale > 0.0 && scale.is_finite()) {
        return None;
    }
    let mu = Tableau::new(samples, scale).least(n)?;
    let largest = mu.iter().copied().fold(0.0, f64::max);
    let greatest = |i: usize| {
        let at = |j: usize| mu.iter().zip(samples).map(|(m, s)| m * s[i][j]).sum::<f64>();
        (0..SAMPLES).map(at).fold(f64::NEG_INFINITY, f64::max)
    };
    let value: f64 = (0..6).map(greatest).sum();
    if !(value < 0.0 && largest > 0.0) {
        return None;
    }
    Some(mu.into_iter().map(|m| if m < NEGLIGIBLE * largest { 0.0 } else { m }).collect())
}

/// Multipliers `mu >= 0`, `sum mu = 1`, that minimise the greatest of the values `sum_k mu_k values[k][j]`; `None` if
/// that is not below 0.
///
/// It is a matrix game (von Neumann 1928). With all values raised above 0, `p = mu / value` maximises `sum p` under
/// `sum_k p_k values[k][j] <= 1`.
pub(super) fn game<const N: usize>(values: &[[f64; N]]) -> Option<Vec<f64>> {
    let n = values.len();
    let range =
        values.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |r, x| (r.0.min(*x), r.1.max(*x)));
    if !(range.0.is_finite() && range.1.is_finite() && range.0 < 0.0)
        || values.iter().flatten().any(|x| x.is_nan())
    {
        return None;
    }
    let raised = (range.1 - range.0).max(-range.0);
    let scale = 1.0 / raised;
    let mut entries = vec![0.0; (N + 1) * (n + 1)];
    for j in 0..N {
        for (k, own) in values.iter().enumerate() {
            entries[j * (n + 1) + k] = (own[j] - range.0) * scale + 1.0;
        }
        entries[j * (n + 1) + n] = 1.0 + APART * (1.0 + (0.618_034 * j as f64).fract());
    }
    entries[N * (n + 1)..][..n].fill(-1.0);
    let basic = (n..n + N).collect();
    let tableau = Tableau { rows: N, columns: n, entries, basic, other: (0..n).collect(), small: SMALL };
    let mu = tableau.least(n)?;
    let total: f64 = mu.iter().sum();
    if !(total > 0.0 && total.is_finite()) {
        return None;
    }
    let mu: Vec<f64> = mu.into_iter().map(|m| if m < NEGLIGIBLE * total { 0.0 } else { m / total }).collect();
    let at = |j: usize| mu.iter().zip(values).map(|(m, v)| m * v[j]).sum::<f64>();
    (0..N).all(|j| at(j) < 0.0).then_some(mu)
}

/// Basic variables over the others: `basic + sum entry * other = right-hand side`, the costs of the others in the last
/// row.
struct Tableau {
    rows: usize,
    /// Number of columns without the right-hand side.
    columns: usize,
    entries: Vec<f64>,
    /// Numbers of the variables: multipliers, then the six first slacks, then the other slacks.
    basic: Vec<usize>,
    other: Vec<usize>,
    small: f64,
}

impl Tableau {
    fn new(samples: &[Sampled], scale: f64) -> Self {
        let n = samples.len();
        let columns = n + 6;
        let mut entries = vec![0.0; (ROWS + 1) * (columns + 1)];
        let mut set = |row: usize, column: usize, x: f64| entries[row * (columns + 1) + column] = x;
        for i in 0..6 {
            for j in 1..SAMPLES {
                let row = i * (SAMPLES - 1) + j - 1;
                for (k, s) in samples.iter().enumerate() {
                    set(row, k, s[i][j] - s[i][0]);
                }
                set(row, n + i, -1.0);
                // multiples of the golden ratio are spread evenly
                set(row, columns, APART * scale * (1.0 + (0.618_034 * row as f64).fract()));
            }
            set(ROWS, n + i, 1.0);
        }
        for (k, s) in samples.iter().enumerate() {
            set(ROWS - 1, k, 1.0);
            set(ROWS, k, s.iter().map(|s| s[0]).sum());
        }
        set(ROWS - 1, columns, 1.0);
        let basic = (columns..columns + ROWS).collect();
        Self {
            rows: ROWS,
            columns,
            entries,
            basic,
            other: (0..columns).collect(),
            small: SMALL * scale.min(1.0),
        }
    }

    /// The first `n` variables after all pivots; `None` for a program without a least value.
    fn least(mut self, n: usize) -> Option<Vec<f64>> {
        for _ in 0..MOST_PIVOTS {
            let Some(column) = self.entering() else { break };
            let row = self.leaving(column)?;
            self.pivot(row, column);
        }
        let mut out = vec![0.0; n];
        for (row, variable) in self.basic.iter().enumerate().filter(|(_, variable)| **variable < n) {
            out[*variable] = self.entry(row, self.columns).max(0.0);
        }
        Some(out)
    }

    fn entry(&self, row: usize, column: usize) -> f64 {
        self.entries[row * (self.columns + 1) + column]
    }

    /// The column of the lowest cost; `None` at the optimum.
    fn entering(&self) -> Option<usize> {
        let costs = &self.entries[self.rows * (self.columns + 1)..][..self.columns];
        let lowest = costs.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1));
        lowest.filter(|(_, cost)| **cost < -self.small).map(|(k, _)| k)
    }

    /// The row that bounds the entering variable; of equal ones the one with the larger pivot.
    fn leaving(&self, column: usize) -> Option<usize> {
        let mut best: Option<(f64, f64, usize)> = None;
        for row in 0..self.rows {
            let pivot = self.entry(row, column);
            if pivot > self.small {
                let ratio = self.entry(row, self.columns) / pivot;
                if best.is_none_or(|b| ratio < b.0 || (ratio <= b.0 && pivot > b.1)) {
                    best = Some((ratio, pivot, row));
                }
            }
        }
        best.map(|b| b.2)
    }

    fn pivot(&mut self, row: usize, column: usize) {
        let width = self.columns + 1;
        let inverse = 1.0 / self.entry(row, column);
        let mut line: Vec<f64> = self.entries[row * width..][..width].iter().map(|x| x * inverse).collect();
        line[column] = inverse;
        for (r, own) in self.entries.chunks_exact_mut(width).enumerate() {
            if r == row {
                own.copy_from_slice(&line);
                continue;
            }
            let factor = own[column];
            if factor != 0.0 {
                own[column] = 0.0;
                for (x, y) in own.iter_mut().zip(&line) {
                    *x -= factor * y;
                }
            }
        }
        std::mem::swap(&mut self.basic[row], &mut self.other[column]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;
    use num::conic::{ConicAnswer, ConicProgram, ConicTally};

    fn value(samples: &[Sampled], mu: &[f64]) -> f64 {
        let greatest = |i: usize| {
            let at = |j: usize| mu.iter().zip(samples).map(|(m, s)| m * s[i][j]).sum::<f64>();
            (0..SAMPLES).map(at).fold(f64::NEG_INFINITY, f64::max)
        };
        (0..6).map(greatest).sum()
    }

    /// The same program by the conic solver.
    fn least(samples: &[Sampled]) -> f64 {
        let n = samples.len();
        let mut p = ConicProgram { variables: n + 6, linear: vec![0.0; n + 6], ..Default::default() };
        for i in 0..6 {
            p.linear[n + i] = 1.0;
            for j in 0..SAMPLES {
                let mut row: Vec<(usize, f64)> = (0..n).map(|k| (k, samples[k][i][j])).collect();
                row.push((n + i, -1.0));
                p.at_least_zero(row, 0.0);
            }
        }
        (0..n).for_each(|k| p.at_least_zero(vec![(k, -1.0)], 0.0));
        p.at_least_zero((0..n).map(|k| (k, 1.0)).collect(), 1.0);
        let ConicAnswer::Point(found) = p.solve(&ConicTally::default()) else { panic!("no point") };
        found.x[n..].iter().sum()
    }

    #[test]
    fn the_least_value_is_that_of_the_conic_solver() {
        let mut rng = Rng::new(5);
        let (mut below, mut none) = (0, 0);
        for n in 0..120 {
            let functions = 1 + n % 70;
            let lift = rng.uniform(-0.4, 0.8);
            let samples: Vec<Sampled> = (0..functions)
                .map(|_| std::array::from_fn(|_| std::array::from_fn(|_| rng.normal() + lift)))
                .collect();
            let expected = least(&samples);
            if let Some(mu) = multipliers(&samples) {
                below += 1;
                assert!(mu.iter().all(|m| *m >= 0.0) && mu.iter().sum::<f64>() < 1.0 + 1e-9);
                let found = value(&samples, &mu);
                // dropped multipliers and the perturbation cost a little
                assert!((found - expected).abs() < 2e-3 * expected.abs().max(0.1), "{found} {expected}");
            } else {
                none += 1;
                assert!(expected > -1e-6, "{expected}");
            }
        }
        assert!(below > 20 && none > 20, "{below} {none}");
    }

    #[test]
    fn games_have_the_value_of_the_conic_solver() {
        let mut rng = Rng::new(6);
        let (mut below, mut none) = (0, 0);
        for n in 0..80 {
            let (functions, lift) = (1 + n % 20, rng.uniform(-1.5, 1.5));
            let values: Vec<[f64; 16]> =
                (0..functions).map(|_| std::array::from_fn(|_| rng.normal() + lift)).collect();
            let mut p = ConicProgram {
                variables: functions + 1,
                linear: vec![0.0; functions + 1],
                ..Default::default()
            };
            p.linear[functions] = 1.0;
            for j in 0..16 {
                let mut row: Vec<(usize, f64)> = (0..functions).map(|k| (k, values[k][j])).collect();
                row.push((functions, -1.0));
                p.at_least_zero(row, 0.0);
            }
            (0..functions).for_each(|k| p.at_least_zero(vec![(k, -1.0)], 0.0));
            p.at_least_zero((0..functions).map(|k| (k, 1.0)).collect(), 1.0);
            p.at_least_zero((0..functions).map(|k| (k, -1.0)).collect(), -1.0);
            let ConicAnswer::Point(found) = p.solve(&ConicTally::default()) else { panic!("no point") };
            let expected = found.x[functions];
            if let Some(mu) = game(&values) {
                below += 1;
                assert!(mu.iter().all(|m| *m >= 0.0));
                let at = |j: usize| mu.iter().zip(&values).map(|(m, v)| m * v[j]).sum::<f64>();
                let value = (0..16).map(at).fold(f64::MIN, f64::max);
                assert!((value - expected).abs() < 2e-3 * expected.abs().max(0.1), "{value} {expected}");
            } else {
                none += 1;
                assert!(expected > -1e-3, "{expected}");
            }
        }
        assert!(below > 10 && none > 10, "{below} {none}");
        assert!(game::<4>(&[]).is_none() && game(&[[f64::NAN; 4]]).is_none());
    }

    #[test]
    fn equal_functions_and_bad_numbers_do_no_harm() {
        let equal = vec![[[-1.0; SAMPLES]; 6]; 30];
        assert!((value(&equal, &multipliers(&equal).unwrap()) + 6.0).abs() < 1e-6);
        assert!(multipliers(&[]).is_none());
        assert!(multipliers(&[[[f64::NAN; SAMPLES]; 6]]).is_none());
        assert!(multipliers(&[[[f64::INFINITY; SAMPLES]; 6]]).is_none());
    }
}
