//! The trackers allocate for their results only, whatever the number of steps.

use allocation_counter::measure;
use num_complex::Complex64;

use super::StartKind;
use super::dispatch::track_all;
use super::fast_tracker::{FastPath, FastTracker};
use super::limits::{FAST, FastTrackerLimits, StepLimits, TrackerLimits};
use super::start::shipped;
use super::system::SectionHomotopy;
use crate::solve::ScaledFrames;
use num::Rng;
use platform::manipulator::{Leg, Manipulator, SquaredLegLengths};

/// From the shipped start to six random legs.
fn homotopy(seed: u64) -> SectionHomotopy<f64> {
    let mut rng = Rng::new(seed);
    let mut point = || nalgebra::Point3::from(nalgebra::Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
    let legs = std::array::from_fn(|_| Leg { base: point(), platform: point() });
    let m = Manipulator::from_legs(legs).unwrap();
    let s = SquaredLegLengths::try_new([1.1, 2.0, 0.7, 2.9, 1.6, 2.3]).unwrap();
    let target = ScaledFrames::of(&m, &s).sections(&m, &s).unwrap();
    SectionHomotopy::real(&shipped(StartKind::Generic).unwrap().sections, &target).unwrap()
}

const CORNER: Complex64 = Complex64::new(0.5, 0.25);

#[test]
fn the_fast_tracker_allocates_for_its_results_whatever_the_number_of_steps() {
    let starts = &shipped(StartKind::Generic).unwrap().solutions;
    for seed in 1..4 {
        let real = homotopy(seed);
        let run = |limits: FastTrackerLimits| {
            let mut out: Vec<FastPath> = Vec::new();
            let counted = measure(|| {
                out = FastTracker {
                    homotopy: &real,
                    starts,
                    way: [Complex64::ONE, CORNER, Complex64::ZERO],
                    limits,
                }
                .run();
            });
            (counted.count_total, out.iter().map(|p| p.steps).sum::<u32>())
        };
        let usual = run(FAST);
        let slow = run(FastTrackerLimits {
            step: StepLimits { truncation: 1e-9, radius_fraction: 0.05, ..FAST.step },
            most_iterations: 5000,
            ..FAST
        });
        assert!(slow.1 > 4 * usual.1, "{} and {} steps", usual.1, slow.1);
        // the paths once, the list of those that arrived as it grows
        assert_eq!((usual.0, slow.0), (6, 6));
    }
}

#[test]
fn the_careful_tracker_allocates_once_whatever_the_number_of_steps() {
    let starts = &shipped(StartKind::Generic).unwrap().solutions;
    let first = SectionHomotopy::through(&homotopy(1), Complex64::ONE).shortened(CORNER);
    let run = |truncation: f64| {
        let limits = TrackerLimits {
            step: StepLimits { truncation, radius_fraction: 0.5, first_correction: 1e-3, accuracy: 1e-9 },
            corrections: 4,
            most_steps: 20_000,
        };
        let mut out = Vec::new();
        let counted = measure(|| out = track_all(&first, starts, &limits, 0.0));
        (counted.count_total, out.iter().map(|p| p.steps).sum::<u32>())
    };
    let (rough, fine) = (run(1e-3), run(1e-10));
    assert!(fine.1 > 2 * rough.1, "{} and {} steps", rough.1, fine.1);
    assert_eq!((rough.0, fine.0), (1, 1));
}
