//! Detection of two legs whose columns of lengths are exchanged.

use super::{LegModel, Measurement};

/// Required reduction of the root mean square residual when two columns are exchanged. Joint errors of built machines
/// cannot cause a factor this large.
const NEARER: f64 = 5.0;

/// The two legs whose measured lengths look exchanged. Exchanging them must bring the data nearest to the nominal
/// machine, by a factor of at least five.
///
/// The mean of each difference between column and leg is removed, so encoder offsets have no influence.
pub(super) fn exchanged(nominal: &LegModel, measurements: &[Measurement]) -> Option<[usize; 2]> {
    let count = measurements.len() as f64;
    let predicted: Vec<[f64; 6]> = measurements.iter().map(|m| nominal.lengths(&m.pose)).collect();
    // sum of squares of the differences between column `i` and leg `j`
    let apart = |i: usize, j: usize| {
        let each = || measurements.iter().zip(&predicted).map(|(m, own)| m.lengths[i] - own[j]);
        let mean = each().sum::<f64>() / count;
        each().map(|d| (d - mean).powi(2)).sum::<f64>()
    };
    let pairs = (0..6).flat_map(|i| (i + 1..6).map(move |j| [i, j]));
    let gains = pairs.filter_map(|[i, j]| {
        let (as_given, changed) = (apart(i, i) + apart(j, j), apart(i, j) + apart(j, i));
        (as_given > NEARER * NEARER * changed).then_some(([i, j], as_given - changed))
    });
    gains.max_by(|x, y| x.1.total_cmp(&y.1)).map(|(legs, _)| legs)
}

#[cfg(test)]
mod tests {
    use super::super::fixtures::{built, measured, nominal, octahedral, poses};
    use super::*;
    use crate::calibration::MeasurementNoise;
    use num::Rng;

    #[test]
    fn columns_in_each_others_place_are_named_and_no_others() {
        let noise = MeasurementNoise { length: 0.01, position: 0.015, rotation: 3e-5 };
        let mut rng = Rng::new(17);
        for design in [nominal(), octahedral()] {
            let truth = built(&design, 2.0, 5.0, &mut rng);
            let rows = measured(&truth, &poses(20, &mut rng), Some(&noise), &mut rng);
            assert_eq!(exchanged(&design, &rows), None);
            for (i, j) in (0..6).flat_map(|i| (i + 1..6).map(move |j| (i, j))) {
                let mut wired = rows.clone();
                for m in &mut wired {
                    m.lengths.swap(i, j);
                }
                assert_eq!(exchanged(&design, &wired), Some([i, j]));
            }
        }
        // a single measurement cannot show an exchange
        let one = measured(&nominal(), &poses(1, &mut rng), None, &mut rng);
        assert_eq!(exchanged(&nominal(), &one), None);
    }
}
