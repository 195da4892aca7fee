//! Columns of two legs that stand in each other's place.

use super::{LegModel, Measurement};

/// How much nearer to the nominal machine two columns are after they changed places, root mean square: far more than
/// joints off by what machines are built to can make.
const NEARER: f64 = 5.0;

/// The legs whose measured lengths look exchanged: those that come nearest to the nominal machine when they change
/// places, where they come nearer by a factor of five.
///
/// What a column differs from a leg by is compared without its mean, so that offsets of encoders count for nothing.
pub(super) fn exchanged(nominal: &LegModel, measurements: &[Measurement]) -> Option<[usize; 2]> {
    let count = measurements.len() as f64;
    let predicted: Vec<[f64; 6]> = measurements.iter().map(|m| nominal.lengths(&m.pose)).collect();
    // sum of squares of what column `i` differs from leg `j` by
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
    use super::super::simulated::{built, measured, nominal, octahedral, poses};
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
        // a single measurement says nothing
        let one = measured(&nominal(), &poses(1, &mut rng), None, &mut rng);
        assert_eq!(exchanged(&nominal(), &one), None);
    }
}
