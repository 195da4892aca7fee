//! Allowances with the largest product under linear constraints.

/// Steps of the iteration, at most.
const STEPS: usize = 2000;

/// Maximises `prod x_k` over `x > 0` with `sum_k rows[r][k] x_k <= 1`; every column needs a positive entry, all entries
/// are at least 0.
///
/// The dual is to maximise `sum_k log (lambda^T w)_k` over weights `lambda` of sum 1. With
/// `q_r = (1/n) sum_k w_rk / (lambda^T w)_k` the step `lambda_r <- lambda_r q_r` never lowers it (Cover 1984), and at
/// the optimum `x_k = 1 / (n (lambda^T w)_k)`, `q_r = w_r . x <= 1`. The result is divided by the largest `q_r` and
/// thus satisfies all constraints. Its product is below the best one by a factor of at most `(max q)^n`. The iteration
/// ends when `max q` is below `1 + accuracy`.
pub(super) fn largest_product(rows: &[Vec<f64>], weights: &mut Vec<f64>, accuracy: f64) -> Vec<f64> {
    let n = rows.first().map_or(0, Vec::len);
    // rows that are new start with a small weight
    weights.resize(rows.len(), 0.1 / rows.len().max(1) as f64);
    let sum: f64 = weights.iter().sum();
    for weight in weights.iter_mut() {
        *weight /= sum;
    }
    let mut x = vec![0.0; n];
    for step in 0..=STEPS {
        for (k, x) in x.iter_mut().enumerate() {
            *x = 1.0 / (n as f64 * rows.iter().zip(weights.iter()).map(|(r, l)| r[k] * l).sum::<f64>());
        }
        let used: Vec<f64> = rows.iter().map(|r| r.iter().zip(&x).map(|(w, x)| w * x).sum()).collect();
        let most = used.iter().copied().fold(0.0, f64::max);
        if most <= 1.0 + accuracy || step == STEPS {
            for x in &mut x {
                *x /= most;
            }
            break;
        }
        weights.iter_mut().zip(&used).for_each(|(l, q)| *l *= q);
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn one_constraint_is_shared_equally() {
        let x = largest_product(&[vec![2.0, 1.0, 0.5]], &mut Vec::new(), 1e-12);
        for (x, w) in x.iter().zip([2.0, 1.0, 0.5]) {
            assert!((x * w - 1.0 / 3.0).abs() < 1e-12);
        }
    }

    #[test]
    fn no_feasible_point_has_a_larger_product() {
        let mut rng = Rng::new(2);
        let rows: Vec<Vec<f64>> = (0..6).map(|_| (0..4).map(|_| rng.unit()).collect()).collect();
        let x = largest_product(&rows, &mut Vec::new(), 1e-6);
        let used = |x: &[f64]| {
            let row = |r: &Vec<f64>| r.iter().zip(x).map(|(w, x)| w * x).sum::<f64>();
            rows.iter().map(row).fold(0.0, f64::max)
        };
        assert!(used(&x) <= 1.0 + 1e-12);
        let best: f64 = x.iter().product();
        for _ in 0..20_000 {
            let y: Vec<f64> = x.iter().map(|x| x * (0.5 * rng.normal()).exp()).collect();
            let scale = used(&y);
            assert!(y.iter().map(|y| y / scale).product::<f64>() < best * (1.0 + 1e-5));
        }
    }
}
