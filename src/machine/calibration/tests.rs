//! Calibrations of simulated machines whose joints and offsets are known.

use nalgebra::{DMatrix, Point3, Rotation3, Vector3};

use super::fixtures::{built, measured, nominal, octahedral, poses};
use super::*;
use num::Rng;
use platform::geom::{Pose, random_rotation, rotation_vector, turn_between};
use platform::manipulator::Body;

const LASER: MeasurementNoise = MeasurementNoise { length: 0.01, position: 0.015, rotation: 3e-5 };
const ENCODERS: MeasurementNoise = MeasurementNoise { length: 0.02, position: 0.0, rotation: 0.0 };

fn options(noise: Option<MeasurementNoise>) -> CalibrateOptions {
    CalibrateOptions { noise, ..CalibrateOptions::default() }
}

fn farthest(a: &LegModel, b: &LegModel) -> f64 {
    let joints = a.base.iter().zip(&b.base).chain(a.platform.iter().zip(&b.platform));
    let offsets = a.offsets.iter().zip(&b.offsets).map(|(x, y)| (x - y).abs());
    joints.map(|(x, y)| (x - y).amax()).chain(offsets).fold(0.0, f64::max)
}

/// `e^T C^-1 e` of the errors of a calibration whose unknowns are all identified.
fn mahalanobis(found: &Calibration, truth: &LegModel) -> f64 {
    let error = found.model.values(&found.unknowns) - truth.values(&found.unknowns);
    found.root.clone().lu().solve(&error).unwrap().norm_squared()
}

#[test]
fn exact_measurements_give_the_machine_from_either_start() {
    for (k, design) in [nominal(), octahedral()].into_iter().enumerate() {
        let mut rng = Rng::new(11 + k as u64);
        let truth = built(&design, 2.0, 5.0, &mut rng);
        let rows = measured(&truth, &poses(24, &mut rng), None, &mut rng);
        for start in [StartChoice::Best, StartChoice::Nominal, StartChoice::ClosedForm] {
            let found = calibrate(&design, &rows, &CalibrateOptions { start, ..CalibrateOptions::default() })
                .unwrap();
            assert_eq!(found.status, CalibrationStatus::Calibrated, "{start:?} {found:?}");
            assert!(farthest(&found.model, &truth) < 1e-8, "{start:?}: {:e}", farthest(&found.model, &truth));
            assert_eq!(found.unknowns.count(), [42, 24][k]);
            assert!(found.before.rms > 1.0 && found.after.rms < 1e-10);
            assert_eq!(found.noise_source, NoiseSource::Estimated);
            if start == StartChoice::Best {
                assert_eq!(found.starts.agree, Some(true));
            }
        }
    }
}

#[test]
fn a_start_without_the_design_needs_no_design() {
    let mut rng = Rng::new(5);
    let truth = built(&nominal(), 2.0, 5.0, &mut rng);
    let rows = measured(&truth, &poses(40, &mut rng), Some(&LASER), &mut rng);
    // a design in other frames than the machine
    let turn = Rotation3::from_euler_angles(0.4, 1.0, -2.0);
    let mut far = nominal();
    for p in &mut far.base {
        *p = turn * *p + Vector3::new(300.0, -800.0, 200.0);
    }
    let best = calibrate(&far, &rows, &options(Some(LASER))).unwrap();
    let start = StartChoice::ClosedForm;
    let found = calibrate(&far, &rows, &CalibrateOptions { start, ..options(Some(LASER)) }).unwrap();
    assert_eq!((found.status, found.starts.taken), (CalibrationStatus::Calibrated, StartName::ClosedForm));
    assert!(farthest(&found.model, &truth) < 1.0);
    assert!(best.starts.closed_form.is_some() && farthest(&best.model, &found.model) < 1e-3);
    // one orientation is too little for the linear equations
    let few: Vec<Measurement> = rows
        .iter()
        .map(|m| Measurement { pose: Pose { rotation: rows[0].pose.rotation, ..m.pose }, ..*m })
        .collect();
    let asked = CalibrateOptions { start, ..options(None) };
    assert_eq!(calibrate(&far, &few, &asked), Err(CalibrationError::NoClosedForm));
    // carried to the frames of the design it is the machine in these frames
    let frames = CarriedFrames::between(&found.model, &far).unwrap();
    let carried = frames.carry(&found.model);
    assert!(farthest(&LegModel { offsets: [0.0; 6], ..carried.clone() }, &far) < 10.0);
    assert!(turn_between(&frames.base.motion.rotation, &turn).norm() < 0.05 || frames.base.rms < 10.0);
    for pose in poses(3, &mut rng) {
        let there = carried.lengths(&pose);
        let here = found.model.lengths(&frames.measured_pose(&pose));
        assert!(there.iter().zip(here).all(|(x, y)| (x - y).abs() < 1e-9));
    }
}

/// Over many seeds, the errors agree with the covariance, and the residuals with the noise.
#[test]
#[ignore = "evidence"]
fn errors_agree_with_the_covariance() {
    let seeds = 40;
    for (noise, given) in [(LASER, true), (ENCODERS, true), (ENCODERS, false)] {
        let (mut errors, mut residuals, mut refuted) = (0.0, 0.0, 0);
        for seed in 0..seeds {
            let mut rng = Rng::stream(77, seed);
            let truth = built(&nominal(), 1.0, 2.0, &mut rng);
            let rows = measured(&truth, &poses(30, &mut rng), Some(&noise), &mut rng);
            let start = StartChoice::Nominal;
            let asked = CalibrateOptions { start, ..options(given.then_some(noise)) };
            let found = calibrate(&nominal(), &rows, &asked).unwrap();
            assert!(found.converged && found.observability.rank == 42, "{found:?}");
            errors += mahalanobis(&found, &truth);
            residuals += found.chi_square.value;
            assert_eq!(found.chi_square.freedoms, 180 - 42);
            refuted += usize::from(found.status == CalibrationStatus::Refuted);
            if !given {
                assert!((found.noise.length / noise.length - 1.0).abs() < 0.3);
            }
        }
        let (errors, residuals) = (errors / seeds as f64, residuals / seeds as f64);
        // the mean of chi-squares over all seeds has the deviation sqrt(2 n / seeds)
        let wide = |n: f64| 4.0 * (2.0 * n / seeds as f64).sqrt();
        assert!((errors - 42.0).abs() < wide(42.0) + 1.0, "{noise:?} {given}: {errors}");
        assert!((residuals - 138.0).abs() < wide(138.0), "{noise:?} {given}: {residuals}");
        assert!(refuted <= 1);
    }
}

/// Poses computed with calibrated machines from exact lengths deviate from the truth in agreement with the covariance,
/// correlations included.
#[test]
#[ignore = "evidence"]
fn computed_poses_are_as_uncertain_as_they_are_said_to_be() {
    let seeds = 60;
    let (mut found_squares, mut said, mut independent) = ([0.0; 2], [0.0; 2], 0.0);
    let mut rng = Rng::new(101);
    let at = poses(1, &mut rng)[0];
    for seed in 0..seeds {
        let mut rng = Rng::stream(78, seed);
        let truth = built(&nominal(), 1.0, 2.0, &mut rng);
        let rows = measured(&truth, &poses(30, &mut rng), Some(&LASER), &mut rng);
        let start = StartChoice::Nominal;
        let found =
            calibrate(&nominal(), &rows, &CalibrateOptions { start, ..options(Some(LASER)) }).unwrap();
        let shown = truth.lengths(&at);
        let mut pose = at;
        for _ in 0..6 {
            let residual = found.model.residual(&Measurement { pose, lengths: shown });
            let step = found.model.pose_sensitivity(&pose).try_inverse().unwrap() * residual;
            pose.position += step.fixed_rows::<3>(0);
            pose.rotation = Rotation3::new(step.fixed_rows::<3>(3).into_owned()) * pose.rotation;
        }
        found_squares[0] += (pose.position - at.position).norm_squared();
        found_squares[1] += turn_between(&at.rotation, &pose.rotation).norm_squared();
        let deviation = pose_deviation(&found.model, &found.unknowns, &found.root, &at).unwrap();
        said[0] += deviation.position.powi(2);
        said[1] += deviation.rotation.powi(2);
        let alone = DMatrix::from_diagonal(&nalgebra::DVector::from_vec(found.deviations()));
        independent += pose_deviation(&found.model, &found.unknowns, &alone, &at).unwrap().position.powi(2);
    }
    for k in 0..2 {
        let ratio = found_squares[k] / said[k];
        assert!(ratio > 0.6 && ratio < 1.6, "{ratio}");
    }
    // negative control: without correlations the deviation would be much larger
    assert!(independent > 10.0 * said[0], "{independent} {}", said[0]);
}

#[test]
fn poses_that_leave_changes_unseen_say_which() {
    let mut rng = Rng::new(3);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let shifted = |turns: fn(&Pose) -> Rotation3<f64>, rng: &mut Rng| -> Vec<Pose> {
        poses(40, rng).iter().map(|p| Pose { rotation: turns(p), position: p.position }).collect()
    };
    // without rotations the joints of a leg can move together unobserved
    let translations = shifted(|_| Rotation3::from_euler_angles(0.1, 0.2, 0.3), &mut rng);
    let about_z = shifted(
        |p| Rotation3::from_axis_angle(&Vector3::z_axis(), rotation_vector(&p.rotation).norm()),
        &mut rng,
    );
    for (list, rank, each) in [(translations, 24, 3), (about_z, 36, 1)] {
        for noise in [None, Some(LASER)] {
            let mut exact = measured(&truth, &list, noise.as_ref(), &mut rng);
            for (row, pose) in exact.iter_mut().zip(&list) {
                row.pose = *pose;
            }
            let found = calibrate(&nominal(), &exact, &options(noise)).unwrap();
            assert_eq!(found.status, CalibrationStatus::NotIdentifiable);
            assert_eq!((found.observability.rank, found.observability.unobservable.len()), (rank, 42 - rank));
            for change in &found.observability.unobservable {
                assert!(change.offsets.is_empty(), "{change:?}");
                let [(first, i, a), (second, j, b)] = change.joints.as_slice() else {
                    panic!("{change:?}");
                };
                assert_eq!((*first, *second, i), (Body::Base, Body::Platform, j));
                let turned = list[0].rotation * b;
                assert!((a - turned).norm() < 1e-6 || each == 1, "{change:?}");
                if each == 1 {
                    assert!((a - b).norm() < 1e-4 && a.xy().norm() < 1e-4, "{change:?}");
                }
            }
            assert!((found.after.rms - noise.map_or(0.0, |_| 0.02)).abs() < 0.02, "what is seen is fitted");
            // unobserved directions stay near the design
            assert!(farthest(&found.model, &nominal()) < 20.0);
        }
    }
}

#[test]
fn too_few_measurements_are_an_outcome() {
    let mut rng = Rng::new(8);
    let truth = built(&nominal(), 0.5, 0.5, &mut rng);
    let list = poses(7, &mut rng);
    let of = |count: usize, noise: Option<MeasurementNoise>, rng: &mut Rng| {
        let rows = measured(&truth, &list[..count], Some(&ENCODERS), rng);
        calibrate(&nominal(), &rows, &CalibrateOptions { identified: 1e6, ..options(noise) }).unwrap()
    };
    let found = of(5, Some(ENCODERS), &mut rng);
    assert_eq!((found.status, found.observability.rank), (CalibrationStatus::NotIdentifiable, 30));
    let found = of(7, Some(ENCODERS), &mut rng);
    assert_ne!(found.status, CalibrationStatus::Calibrated);
    assert_eq!((found.chi_square.freedoms, found.indispensable.len()), (0, 7));
    let found = of(7, None, &mut rng);
    assert_eq!(found.noise_source, NoiseSource::Assumed);
    assert_ne!(found.status, CalibrationStatus::Calibrated);
}

#[test]
#[ignore = "evidence"]
fn gross_errors_are_found_and_hardly_matter() {
    let mut rng = Rng::new(21);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let clean = measured(&truth, &poses(50, &mut rng), Some(&LASER), &mut rng);
    let asked = |loss, loss_unit, noise| CalibrateOptions { loss, loss_unit, ..options(noise) };
    let best = calibrate(&nominal(), &clean, &options(Some(LASER))).unwrap();
    assert!(best.outliers.is_empty() && best.status == CalibrationStatus::Calibrated, "{:?}", best.outliers);
    // three poses are wrong by a millimetre
    let mut rows = clean.clone();
    for k in [4, 17, 33] {
        rows[k].pose.position += Vector3::new(0.8, -0.5, 0.6);
    }
    let misled = calibrate(&nominal(), &rows, &options(Some(LASER))).unwrap();
    assert_eq!(misled.status, CalibrationStatus::Refuted);
    for loss in [Loss::Huber, Loss::Cauchy, Loss::Tukey] {
        for noise in [Some(LASER), None] {
            let found = calibrate(&nominal(), &rows, &asked(loss, LossUnit::Pose, noise)).unwrap();
            let mut out: Vec<usize> = found.outliers.iter().map(|o| o.measurement).collect();
            out.sort_unstable();
            assert_eq!(out, [4, 17, 33], "{loss:?} {noise:?}");
            assert_eq!(found.status, CalibrationStatus::Calibrated, "{loss:?} {noise:?}");
            let off = |c: &Calibration| mahalanobis(c, &truth);
            if noise.is_some() {
                assert!(off(&found) < 42.0 + 5.0 * 84.0_f64.sqrt(), "{loss:?}: {}", off(&found));
            }
            assert!(found.after.rms < 1.5 * best.after.rms && misled.after.rms > best.after.rms);
        }
    }
    // noise that is ten times too small makes no outliers of right measurements
    let small = MeasurementNoise { length: 0.001, position: 0.0015, rotation: 3e-6 };
    let found = calibrate(&nominal(), &clean, &asked(Loss::Huber, LossUnit::Pose, Some(small))).unwrap();
    assert!(found.status == CalibrationStatus::Refuted && found.outliers.is_empty(), "{found:?}");
    // a leg that slipped once
    let mut rows = clean;
    rows[9].lengths[2] += 0.5;
    let found = calibrate(&nominal(), &rows, &asked(Loss::Tukey, LossUnit::Leg, Some(LASER))).unwrap();
    assert_eq!((found.outliers[0].measurement, found.outliers[0].leg), (9, Some(2)));
    assert!(found.outliers[0].weight < 1e-6 && mahalanobis(&found, &truth) < 42.0 + 5.0 * 84.0_f64.sqrt());
}

#[test]
fn a_leg_with_a_wrong_model_is_seen_in_the_chi_square() {
    let mut rng = Rng::new(31);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let mut rows = measured(&truth, &poses(40, &mut rng), Some(&ENCODERS), &mut rng);
    let right = calibrate(&nominal(), &rows, &options(Some(ENCODERS))).unwrap();
    assert_eq!(right.status, CalibrationStatus::Calibrated);
    assert!(right.chi_square.probability.unwrap() > 1e-3);
    // the screw of leg 4 has an error that repeats with every revolution
    for row in &mut rows {
        row.lengths[3] += 0.1 * (row.lengths[3] * std::f64::consts::TAU / 10.0).sin();
    }
    let wrong = calibrate(&nominal(), &rows, &options(Some(ENCODERS))).unwrap();
    assert_eq!(wrong.status, CalibrationStatus::Refuted);
    assert!(wrong.chi_square.probability.unwrap() < 1e-9);
    let worst = (0..6).max_by(|i, j| wrong.after.legs[*i].total_cmp(&wrong.after.legs[*j]));
    assert_eq!(worst, Some(3));
}

/// Other frames of base and platform, other numbers of legs, another unit: the same machine.
#[test]
fn the_answer_moves_with_frames_legs_and_units() {
    let mut rng = Rng::new(41);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let rows = measured(&truth, &poses(30, &mut rng), Some(&LASER), &mut rng);
    let found = calibrate(&nominal(), &rows, &options(Some(LASER))).unwrap();
    let deviations = found.deviations();

    // the base frame moved: isotropic noise is the same in it
    let motion = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(30.0, -50.0, 20.0) };
    let moved_rows: Vec<Measurement> = rows
        .iter()
        .map(|m| Measurement {
            pose: Pose {
                rotation: motion.rotation * m.pose.rotation,
                position: motion.rotation * m.pose.position + motion.position,
            },
            ..*m
        })
        .collect();
    let mut moved_design = nominal();
    let mut expected = found.model.clone();
    for p in moved_design.base.iter_mut().chain(&mut expected.base) {
        *p = motion.transform(p);
    }
    let moved = calibrate(&moved_design, &moved_rows, &options(Some(LASER))).unwrap();
    assert!(farthest(&moved.model, &expected) < 1e-5);
    assert!((moved.chi_square.value - found.chi_square.value).abs() < 1e-6 * found.chi_square.value);

    // the platform frame rotated about its origin, whose position is measured
    let turn = random_rotation(&mut rng);
    let turned_rows: Vec<Measurement> = rows
        .iter()
        .map(|m| Measurement {
            pose: Pose { rotation: m.pose.rotation * turn.inverse(), position: m.pose.position },
            ..*m
        })
        .collect();
    let mut turned_design = nominal();
    let mut expected = found.model.clone();
    for p in turned_design.platform.iter_mut().chain(&mut expected.platform) {
        *p = turn * *p;
    }
    let turned = calibrate(&turned_design, &turned_rows, &options(Some(LASER))).unwrap();
    assert!(farthest(&turned.model, &expected) < 1e-5);

    // legs in another order
    let order = [3, 0, 5, 1, 4, 2];
    let mut reordered = nominal();
    reordered.pairs = order.map(|i| reordered.pairs[i]);
    let relabelled: Vec<Measurement> =
        rows.iter().map(|m| Measurement { lengths: order.map(|i| m.lengths[i]), ..*m }).collect();
    let other = calibrate(&reordered, &relabelled, &options(Some(LASER))).unwrap();
    assert!(
        farthest(
            &LegModel { offsets: [0.0; 6], ..other.model.clone() },
            &LegModel { offsets: [0.0; 6], ..found.model.clone() }
        ) < 1e-7
    );
    assert!((0..6).all(|i| (other.model.offsets[i] - found.model.offsets[order[i]]).abs() < 1e-7));

    // metres instead of millimetres
    let small = |p: &Point3<f64>| p * 1e-3;
    let mut metres = nominal();
    for p in metres.base.iter_mut().chain(&mut metres.platform) {
        *p = small(p);
    }
    let in_metres: Vec<Measurement> = rows
        .iter()
        .map(|m| Measurement {
            pose: Pose { position: m.pose.position * 1e-3, ..m.pose },
            lengths: m.lengths.map(|l| l * 1e-3),
        })
        .collect();
    let noise = MeasurementNoise { length: 1e-5, position: 1.5e-5, ..LASER };
    let scaled = calibrate(&metres, &in_metres, &options(Some(noise))).unwrap();
    assert_eq!(scaled.observability.rank, 42);
    assert!(scaled.deviations().iter().zip(&deviations).all(|(x, y)| (x * 1e3 / y - 1.0).abs() < 1e-6));
    assert!((scaled.observability.volume_index() / found.observability.volume_index() - 1.0).abs() < 1e-6);
    assert!((scaled.chi_square.value / found.chi_square.value - 1.0).abs() < 1e-6);
}

#[test]
fn residuals_left_out_are_those_of_a_fit_without_the_pose() {
    let mut rng = Rng::new(51);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let rows = measured(&truth, &poses(20, &mut rng), Some(&ENCODERS), &mut rng);
    let asked = CalibrateOptions { start: StartChoice::Nominal, ..options(Some(ENCODERS)) };
    let found = calibrate(&nominal(), &rows, &asked).unwrap();
    let at = found.left_out.greatest.unwrap();
    let others: Vec<Measurement> =
        rows.iter().enumerate().filter(|(k, _)| *k != at.measurement).map(|(_, m)| *m).collect();
    let without = calibrate(&nominal(), &others, &asked).unwrap();
    let there = without.residuals_of(&rows[at.measurement..=at.measurement]);
    assert!((there.greatest.unwrap().value - at.value).abs() < 0.02 * at.value.abs(), "{there:?} {at:?}");
    assert!(found.left_out.rms > found.after.rms && found.indispensable.is_empty());
}

#[test]
fn what_is_held_stays_and_the_rest_is_better_known() {
    let mut rng = Rng::new(61);
    let truth = LegModel { base: nominal().base, ..built(&nominal(), 1.0, 2.0, &mut rng) };
    let rows = measured(&truth, &poses(20, &mut rng), Some(&ENCODERS), &mut rng);
    let free = calibrate(&nominal(), &rows, &options(Some(ENCODERS))).unwrap();
    let held = HeldParts { base: true, ..HeldParts::default() };
    let asked = CalibrateOptions { held, ..options(Some(ENCODERS)) };
    let found = calibrate(&nominal(), &rows, &asked).unwrap();
    assert_eq!((found.unknowns.count(), &found.model.base), (24, &nominal().base));
    assert!(farthest(&found.model, &truth) < 0.2 && found.starts.closed_form.is_none());
    let of = |c: &Calibration| {
        let column = c.unknowns.joint(Body::Platform, 2).unwrap();
        c.deviations()[column]
    };
    assert!(of(&found) < of(&free));
    let all = HeldParts { base: true, platform: true, offsets: true };
    let asked = CalibrateOptions { held: all, ..options(None) };
    assert_eq!(calibrate(&nominal(), &rows, &asked), Err(CalibrationError::NothingUnknown));
}

#[test]
fn the_next_poses_lower_the_determinant_as_they_say_and_more_than_others() {
    let mut rng = Rng::new(71);
    let list = poses(12, &mut rng);
    let candidates = poses(60, &mut rng);
    let model = nominal();
    let volume = |list: &[Pose]| {
        let rows = measured(&model, list, None, &mut Rng::new(1));
        let asked = CalibrateOptions { start: StartChoice::Nominal, identified: 1e3, ..options(Some(LASER)) };
        let found = calibrate(&model, &rows, &asked).unwrap();
        let logs = found.observability.singular_values.iter().map(|s| s.ln()).sum::<f64>();
        (found, -logs / 42.0)
    };
    let (found, before) = volume(&list);
    let next = next_poses(&found.model, &found.unknowns, &LASER, &found.root, &candidates, 4);
    let with = |chosen: &[usize]| {
        let more = chosen.iter().map(|k| candidates[*k]);
        volume(&list.iter().copied().chain(more).collect::<Vec<_>>()).1
    };
    let chosen: Vec<usize> = next.iter().map(|n| n.candidate).collect();
    let promised: f64 = next.iter().map(|n| n.shrinks.ln()).sum();
    assert!((with(&chosen) - before - promised).abs() < 1e-6, "{next:?}");
    assert!(next.iter().all(|n| n.shrinks < 1.0));
    for k in 0..8 {
        let others: Vec<usize> = (0..4).map(|i| 7 * k + i).collect();
        assert!(with(&chosen) <= with(&others));
    }
    assert!(next.windows(2).all(|n| n[1].greatest_deviation <= n[0].greatest_deviation));
    // without measurements
    let unknowns = Unknowns::new(&model, HeldParts::default());
    let first = next_poses(&model, &unknowns, &LASER, &planning_root(&unknowns, 10.0), &candidates, 10);
    assert!(first[9].greatest_deviation < first[0].greatest_deviation);
}

#[test]
fn rigid_motions_are_found_and_points_on_a_line_have_none() {
    let mut rng = Rng::new(81);
    for planar in [false, true] {
        let flat = |p: Vector3<f64>| if planar { Vector3::new(p.x, p.y, 0.0) } else { p };
        let from: Vec<Point3<f64>> =
            (0..6).map(|_| Point3::from(flat(Vector3::from_fn(|_, _| rng.normal())))).collect();
        let motion = Pose { rotation: random_rotation(&mut rng), position: Vector3::new(1.0, 2.0, 3.0) };
        let to: Vec<Point3<f64>> = from.iter().map(|p| motion.transform(p)).collect();
        let found = rigid_motion(&from, &to).unwrap();
        assert!(
            (found.motion.rotation.matrix() - motion.rotation.matrix()).amax() < 1e-12 && found.rms < 1e-12
        );
    }
    let line: Vec<Point3<f64>> = (0..6_u8).map(|k| Point3::new(f64::from(k), 1.0, 2.0)).collect();
    assert!(rigid_motion(&line, &line).is_none());
}

#[test]
fn the_covariance_turns_with_the_joints() {
    let mut rng = Rng::new(91);
    let truth = built(&nominal(), 1.0, 2.0, &mut rng);
    let rows = measured(&truth, &poses(30, &mut rng), Some(&LASER), &mut rng);
    let found = calibrate(&nominal(), &rows, &options(Some(LASER))).unwrap();
    let quarter = Rotation3::from_axis_angle(&Vector3::z_axis(), std::f64::consts::FRAC_PI_2);
    let motion = |rotation| FrameMotion { motion: Pose { rotation, position: Vector3::zeros() }, rms: 0.0 };
    let frames = CarriedFrames { base: motion(quarter), platform: motion(Rotation3::identity()) };
    let turned: DMatrix<f64> = frames.carry_root(&found.unknowns, &found.root);
    let of = |root: &DMatrix<f64>, row: usize| root.row(row).norm();
    let a = found.unknowns.joint(Body::Base, 3).unwrap();
    assert!((of(&turned, a + 1) - of(&found.root, a)).abs() < 1e-12);
    assert!((of(&turned, a + 2) - of(&found.root, a + 2)).abs() < 1e-12);
    let b = found.unknowns.joint(Body::Platform, 3).unwrap();
    assert!((of(&turned, b) - of(&found.root, b)).abs() < 1e-12);
}

/// Three of five poses have a length that is off: the median pose is wrong, the median length is not.
#[test]
fn gross_lengths_in_most_poses_are_named_where_single_lengths_are_doubted() {
    let mut rng = Rng::new(23);
    let truth = built(&nominal(), 0.5, 2.0, &mut rng);
    let mut rows = measured(&truth, &poses(40, &mut rng), Some(&ENCODERS), &mut rng);
    let mut wrong = Vec::new();
    for (k, row) in rows.iter_mut().enumerate().filter(|(k, _)| k % 5 < 3) {
        let leg = (rng.next_u64() % 6) as usize;
        let off = rng.uniform(5.0, 20.0);
        row.lengths[leg] += if rng.unit() < 0.5 { off } else { -off };
        wrong.push((k, leg));
    }
    for loss in [Loss::Cauchy, Loss::Tukey] {
        let options = CalibrateOptions { loss, loss_unit: LossUnit::Leg, ..options(Some(ENCODERS)) };
        let found = calibrate(&nominal(), &rows, &options).unwrap();
        assert_eq!(found.status, CalibrationStatus::Calibrated, "{loss:?}");
        let named: Vec<_> = found.outliers.iter().map(|o| (o.measurement, o.leg.unwrap())).collect();
        assert!(
            wrong.iter().all(|w| named.contains(w)) && named.len() <= wrong.len() + 1,
            "{loss:?}: {named:?}"
        );
    }
}
