use std::ffi::CStr;
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};

use super::design::*;
use super::failure::*;
use super::limits::*;
use super::pose::*;
use super::solving::*;
use super::tracking::*;
use super::*;

const DESIGN: &str = include_str!("../../../designs/presets/bench-l16.toml");

fn design() -> *mut EqpDesign {
    let mut made = null_mut();
    // SAFETY: the pointers are those of the test's own values.
    let status =
        unsafe { eqp_design_from_toml(DESIGN.as_ptr().cast(), DESIGN.len(), &raw mut made, null_mut()) };
    assert_eq!(status, EqpStatus::Ok);
    made
}

fn message(error: &EqpError) -> String {
    // SAFETY: messages end with a zero.
    unsafe { CStr::from_ptr(error.message.as_ptr()) }.to_str().unwrap().to_owned()
}

fn no_error() -> EqpError {
    EqpError { status: EqpStatus::Ok, message: [0; EQP_MESSAGE] }
}

#[test]
fn lengths_and_poses_go_there_and_back() {
    // SAFETY: the pointers are those of the test's own values.
    unsafe {
        let design = design();
        let mut home = MaybeUninit::<EqpPose>::uninit();
        assert_eq!(eqp_design_home(design, home.as_mut_ptr(), null_mut()), EqpStatus::Ok);
        let home = home.assume_init();
        let mut lengths = [[0.0; 6]];
        assert_eq!(
            eqp_ik(design, &raw const home, 1, lengths.as_mut_ptr().cast(), null_mut()),
            EqpStatus::Ok
        );
        let mut solver = null_mut();
        assert_eq!(eqp_solver_new(design, 1, &raw mut solver, null_mut()), EqpStatus::Ok);
        eqp_design_free(design);
        let rows = [lengths[0], [-1.0; 6], lengths[0]];
        let mut solutions = [null_mut(); 3];
        let mut statuses = [EqpStatus::Internal; 3];
        let mut error = no_error();
        let status = eqp_solve_all(
            solver,
            rows.as_ptr().cast(),
            3,
            2,
            solutions.as_mut_ptr(),
            statuses.as_mut_ptr(),
            &raw mut error,
        );
        assert_eq!(
            (status, statuses),
            (EqpStatus::BadLengths, [EqpStatus::Ok, EqpStatus::BadLengths, EqpStatus::Ok])
        );
        assert!(
            solutions[1].is_null() && error.status == EqpStatus::BadLengths && !message(&error).is_empty()
        );
        assert_eq!(eqp_solutions_count(solutions[0]), 16);
        assert_eq!(eqp_solutions_completeness(solutions[0]), EqpCompleteness::Proved);
        let mut near = f64::INFINITY;
        for k in 0..16 {
            let mut one = MaybeUninit::<EqpSolution>::uninit();
            assert_eq!(eqp_solutions_get(solutions[0], k, one.as_mut_ptr(), null_mut()), EqpStatus::Ok);
            let one = one.assume_init();
            assert!(one.certified && one.position_error < 1e-6 && one.rotation_error < 1e-8);
            let off: f64 = (0..3).map(|i| (one.position[i] - home.position[i]).abs()).sum();
            if one.reality == EqpReality::Real {
                near = near.min(off);
            }
        }
        assert!(near < 1e-9, "{near}");
        let mut none = MaybeUninit::<EqpSolution>::uninit();
        assert_eq!(eqp_solutions_get(solutions[0], 16, none.as_mut_ptr(), null_mut()), EqpStatus::BadIndex);
        for found in solutions {
            eqp_solutions_free(found);
        }
        eqp_solver_free(solver);
    }
}

#[test]
fn a_tracker_follows_and_limits_are_told() {
    // SAFETY: the pointers are those of the test's own values.
    unsafe {
        let design = design();
        let mut home = MaybeUninit::<EqpPose>::uninit();
        eqp_design_home(design, home.as_mut_ptr(), null_mut());
        let home = home.assume_init();
        let mut tracker = null_mut();
        assert_eq!(eqp_tracker_new(design, &raw const home, &raw mut tracker, null_mut()), EqpStatus::Ok);
        let mut moved = home;
        moved.position[0] += 1.0;
        let mut lengths = [0.0; 6];
        eqp_ik(design, &raw const moved, 1, (&raw mut lengths).cast(), null_mut());
        let mut track = MaybeUninit::<EqpTrack>::uninit();
        assert_eq!(
            eqp_tracker_step(tracker, (&raw const lengths).cast(), track.as_mut_ptr(), null_mut()),
            EqpStatus::Ok
        );
        let track = track.assume_init();
        assert_eq!(track.status, EqpTrackStatus::Tracked);
        assert!((track.pose.position[0] - moved.position[0]).abs() < 1e-9);
        eqp_tracker_free(tracker);
        let mut allowed = false;
        assert_eq!(eqp_allowed(design, &raw const home, &raw mut allowed, null_mut()), EqpStatus::Ok);
        assert!(allowed);
        let mut ranges = MaybeUninit::<[EqpFreeRange; 6]>::uninit();
        assert_eq!(
            eqp_free_ranges(design, &raw const home, ranges.as_mut_ptr().cast(), null_mut()),
            EqpStatus::Ok
        );
        assert!(ranges.assume_init().iter().all(|r| r.back > 0.0 && r.forth > 0.0 && r.back_binds));
        moved.position[2] += 1e3;
        let mut error = no_error();
        let status = eqp_free_ranges(design, &raw const moved, ranges.as_mut_ptr().cast(), &raw mut error);
        assert_eq!((status, message(&error).as_str()), (EqpStatus::NoAllowedPose, "the pose is not allowed"));
        let mut nearest = MaybeUninit::<EqpNearest>::uninit();
        assert_eq!(
            eqp_nearest_allowed(design, &raw const moved, 0, nearest.as_mut_ptr(), null_mut()),
            EqpStatus::Ok
        );
        assert!(nearest.assume_init().distance < 1e3);
        eqp_design_free(design);
    }
}

#[test]
fn what_cannot_be_is_a_code_with_a_text() {
    // SAFETY: the pointers are those of the test's own values, or null.
    unsafe {
        let mut error = no_error();
        let mut made = null_mut();
        let bad = b"name = 'x'\n\xff";
        assert_eq!(
            eqp_design_from_toml(bad.as_ptr().cast(), bad.len(), &raw mut made, null_mut()),
            EqpStatus::BadText
        );
        assert_eq!(
            eqp_design_from_toml(bad.as_ptr().cast(), 11, &raw mut made, &raw mut error),
            EqpStatus::BadDesign
        );
        assert!(message(&error).contains("units") && made.is_null());
        assert_eq!(eqp_design_from_toml(null(), 5, &raw mut made, null_mut()), EqpStatus::BadPointer);
        assert_eq!(
            eqp_design_from_toml(bad.as_ptr().cast(), usize::MAX, &raw mut made, null_mut()),
            EqpStatus::BadPointer
        );
        assert_eq!(
            eqp_design_load(c"no such file.toml".as_ptr(), &raw mut made, &raw mut error),
            EqpStatus::File
        );
        let same = [[0.0; 3]; 6];
        assert_eq!(
            eqp_design_from_joints(
                (&raw const same).cast(),
                (&raw const same).cast(),
                &raw mut made,
                null_mut()
            ),
            EqpStatus::BadJoints
        );
        let design = design();
        let mut pose =
            EqpPose { rotation: [[2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], position: [0.0; 3] };
        let mut lengths = [0.0; 6];
        assert_eq!(
            eqp_ik(design, &raw const pose, 1, (&raw mut lengths).cast(), null_mut()),
            EqpStatus::BadPose
        );
        let place = [1.0, 2.0, 3.0];
        let angles = [10.0, 20.0, 30.0];
        assert_eq!(
            eqp_pose_from_rpy(
                (&raw const place).cast(),
                (&raw const angles).cast(),
                &raw mut pose,
                null_mut()
            ),
            EqpStatus::Ok
        );
        let mut again = [0.0_f64; 3];
        assert_eq!(eqp_pose_rpy(&raw const pose, (&raw mut again).cast(), null_mut()), EqpStatus::Ok);
        assert!(again.iter().zip(&angles).all(|(a, b)| (a - b).abs() < 1e-12));
        assert_eq!(CStr::from_ptr(eqp_design_units(design)).to_str(), Ok("mm"));
        eqp_design_free(design);
        eqp_design_free(null_mut());
        for status in 0..13 {
            assert!(!CStr::from_ptr(eqp_status_text(status)).to_bytes().is_empty());
        }
        assert_eq!(CStr::from_ptr(eqp_version()).to_str(), Ok(env!("CARGO_PKG_VERSION")));
    }
}

#[test]
fn a_jacobian_has_a_length_and_legs_with_directions() {
    // SAFETY: the pointers are those of the test's own values.
    unsafe {
        let design = design();
        let mut home = MaybeUninit::<EqpPose>::uninit();
        eqp_design_home(design, home.as_mut_ptr(), null_mut());
        let home = home.assume_init();
        let (mut rows, mut error) = ([[7.0_f64; 6]; 6], no_error());
        for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let status =
                eqp_jacobian(design, &raw const home, length, (&raw mut rows).cast(), &raw mut error);
            assert_eq!(status, EqpStatus::BadLengths, "{length}");
            assert!(message(&error).contains("characteristic_length"), "{}", message(&error));
        }
        // moments divided by so short a length overflow
        let status = eqp_jacobian(design, &raw const home, 1e-320, (&raw mut rows).cast(), null_mut());
        assert_eq!((status, rows), (EqpStatus::Computation, [[7.0; 6]; 6]), "refused rows stay");
        let status = eqp_jacobian(design, &raw const home, 50.0, (&raw mut rows).cast(), null_mut());
        assert_eq!(status, EqpStatus::Ok);
        assert!(rows.iter().all(|row| (row[..3].iter().map(|x| x * x).sum::<f64>() - 1.0).abs() < 1e-12));
        eqp_design_free(design);
        // at the identity the second leg of this platform has both ends in one point
        let base = [
            [1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, 1.0, 0.0],
            [-1.0, -1.0, 0.0],
            [-1.0, -1.0, 0.0],
        ];
        let platform = [
            [0.0, 1.0, 1.0],
            [1.0, 0.0, 0.0],
            [1.0, 0.0, 0.0],
            [-1.0, 0.0, 1.0],
            [-1.0, 0.0, 1.0],
            [0.0, 1.0, 1.0],
        ];
        let mut made = null_mut();
        let status = eqp_design_from_joints(
            (&raw const base).cast(),
            (&raw const platform).cast(),
            &raw mut made,
            &raw mut error,
        );
        assert_eq!(status, EqpStatus::Ok, "{}", message(&error));
        let flat =
            EqpPose { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], position: [0.0; 3] };
        let status = eqp_jacobian(made, &raw const flat, 1.0, (&raw mut rows).cast(), &raw mut error);
        assert_eq!(status, EqpStatus::Computation);
        assert!(message(&error).starts_with("leg 2 "), "{}", message(&error));
        eqp_design_free(made);
    }
}

#[test]
fn joints_are_counted_as_legs_are() {
    // SAFETY: the pointers are those of the test's own values.
    unsafe {
        let (mut made, mut error) = (null_mut(), no_error());
        let good: [[f64; 3]; 6] = std::array::from_fn(|i| [i as f64, (i * i) as f64, 0.0]);
        let mut bad = good;
        bad[1] = bad[0]; // one joint of two legs
        bad[3][2] = f64::NAN;
        let (good, bad) = ((&raw const good).cast(), (&raw const bad).cast());
        let status = eqp_design_from_joints(bad, good, &raw mut made, &raw mut error);
        assert_eq!(status, EqpStatus::BadJoints);
        assert!(message(&error).contains("base joint 4 "), "{}", message(&error));
        let status = eqp_design_from_joints(good, bad, &raw mut made, &raw mut error);
        assert_eq!(status, EqpStatus::BadJoints);
        assert!(message(&error).contains("platform joint 4 "), "{}", message(&error));
    }
}

#[test]
fn a_value_without_a_place_is_dropped() {
    struct Counted<'a>(&'a std::cell::Cell<u32>);
    impl Drop for Counted<'_> {
        fn drop(&mut self) {
            self.0.set(self.0.get() + 1);
        }
    }
    let dropped = std::cell::Cell::new(0);
    // SAFETY: the pointers are null or those of the test's own values.
    unsafe {
        let status = told(null_mut(), || give(Counted(&dropped), null_mut(), "place"));
        assert_eq!((status, dropped.get()), (EqpStatus::BadPointer, 1));
        let mut place = null_mut();
        assert_eq!(told(null_mut(), || give(Counted(&dropped), &raw mut place, "place")), EqpStatus::Ok);
        assert_eq!(dropped.get(), 1, "what is given stays");
        take_back(place);
        assert_eq!(dropped.get(), 2);
        let design = design();
        assert_eq!(eqp_solver_new(design, 1, null_mut(), null_mut()), EqpStatus::BadPointer);
        eqp_design_free(design);
    }
}

#[test]
fn a_panic_stays_inside_and_long_messages_are_cut_between_characters() {
    let mut error = no_error();
    // SAFETY: the pointer is that of the test's own value.
    let status = unsafe { told(&raw mut error, || panic!("planted")) };
    assert_eq!((status, message(&error).as_str()), (EqpStatus::Internal, "a fault of the library: planted"));
    let long = "ä".repeat(2000);
    // SAFETY: as above.
    let status = unsafe { told(&raw mut error, || Err(CallFault::new(EqpStatus::File, long.clone()))) };
    assert_eq!(status, EqpStatus::File);
    assert_eq!(message(&error).chars().count(), (EQP_MESSAGE - 1) / 2);
}

#[test]
fn cranks_are_refused_with_a_code_of_their_own() {
    let text = include_str!("../../../designs/presets/reachy-mini.toml");
    let mut made = null_mut();
    let mut error = no_error();
    // SAFETY: the pointers are those of the test's own values.
    let status =
        unsafe { eqp_design_from_toml(text.as_ptr().cast(), text.len(), &raw mut made, &raw mut error) };
    assert_eq!((status, error.status), (EqpStatus::Cranks, EqpStatus::Cranks));
    assert!(made.is_null());
    let message = message(&error);
    assert!(
        message.contains("`equipod export DESIGN --to c`") && message.contains("design::rotary"),
        "{message}"
    );
    // SAFETY: a text that stays and ends with a zero.
    let text = unsafe { CStr::from_ptr(eqp_status_text(13)) }.to_str().unwrap();
    assert!(text.contains("cranks"), "{text}");
}

#[test]
fn poses_as_numbers_have_the_convention_of_the_design() {
    const FRAMES: &str = "rotation_order = \"pi\"\npivot = [0, 0, 50]\nrelative_to = \"home\"\nup = \"y\"\nquaternion = \"xyzw\"";
    // SAFETY: the pointers are those of the test's own values.
    unsafe {
        let usual = design();
        let mut own = null_mut();
        let made =
            eqp_design_with_frames(usual, FRAMES.as_ptr().cast(), FRAMES.len(), &raw mut own, null_mut());
        assert_eq!(made, EqpStatus::Ok);
        let sentence = CStr::from_ptr(eqp_design_frames(own)).to_str().unwrap();
        assert!(sentence.contains("Rx(a) Ry(b) Rz(c)") && sentence.contains("from home"), "{sentence}");
        let given = [1.0, 2.0, -3.0, 4.0, -5.0, 6.0];
        let mut pose = MaybeUninit::<EqpPose>::uninit();
        let read = |of: *mut EqpDesign, pose: &mut MaybeUninit<EqpPose>| {
            eqp_pose_from_numbers(of, given.as_ptr(), 6, pose.as_mut_ptr(), null_mut())
        };
        assert_eq!(read(own, &mut pose), EqpStatus::Ok);
        let (mut numbers, mut quaternion) = ([0.0; 6], [0.0; 4]);
        let status =
            eqp_pose_numbers(own, pose.as_ptr(), numbers.as_mut_ptr(), quaternion.as_mut_ptr(), null_mut());
        assert_eq!(status, EqpStatus::Ok);
        assert!(numbers.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-12), "{numbers:?}");
        assert!(quaternion[3] > 0.9, "the scalar is last: {quaternion:?}");
        // the same numbers in the usual convention are another pose
        let theirs = pose.assume_init();
        let mut ours = MaybeUninit::<EqpPose>::uninit();
        assert_eq!(read(usual, &mut ours), EqpStatus::Ok);
        assert_ne!(ours.assume_init(), theirs);
        let mut error = no_error();
        let bad = "up = \"x\"";
        let status =
            eqp_design_with_frames(own, bad.as_ptr().cast(), bad.len(), &raw mut own, &raw mut error);
        assert_eq!(status, EqpStatus::BadDesign, "{}", message(&error));
        let status = eqp_pose_from_numbers(own, given.as_ptr(), 5, ours.as_mut_ptr(), &raw mut error);
        assert_eq!(status, EqpStatus::BadPose);
        eqp_design_free(usual);
        eqp_design_free(own);
    }
}
