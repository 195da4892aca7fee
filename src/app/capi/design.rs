//! Designs, and results at a pose.

use std::ffi::{CStr, CString, c_char};

use nalgebra::Point3;

use super::failure::{CallFault, EqpError, EqpStatus, give, items, places, read, take_back, told, write};
use super::pose::EqpPose;
use ask::Error;
use ask::design::parse;
use ask::{Design, PoseFrames};
use files::design::{Format, parse_frames};
use machine::requirements::Requirements;
use platform::geom::PoseConvention;
use platform::manipulator::{Leg, Manipulator, jacobian};

/// An immutable design, which threads may share.
#[derive(Debug)]
pub struct EqpDesign {
    pub(super) design: Design,
    pub(super) required: Requirements,
    name: CString,
    units: CString,
    frames: CString,
}

impl EqpDesign {
    fn new(design: Design) -> Self {
        // names containing a zero end there
        let text = |s: &str| CString::new(s.split('\0').next().unwrap_or_default()).unwrap_or_default();
        let required = design.requirements();
        Self {
            name: text(&design.name),
            units: text(&design.units),
            frames: text(&design.frames.sentences()),
            required,
            design,
        }
    }

    /// The convention of poses as numbers, with home.
    pub(super) fn frames(&self) -> PoseFrames {
        self.design.pose_frames(PoseConvention::default())
    }

    /// The design with the keys of a `[frames]` table in place of its own.
    fn with_frames(&self, keys: &str) -> Result<Self, CallFault> {
        let mut design = self.design.clone();
        design.frames = parse_frames(keys).map_err(|violations| Error::Design { file: None, violations })?;
        Ok(Self::new(design))
    }
}

/// # Safety
/// `text` points to `length` bytes.
unsafe fn utf8<'a>(text: *const c_char, length: usize) -> Result<&'a str, CallFault> {
    // SAFETY: the caller's promise; a byte is a byte.
    let bytes = unsafe { items(text.cast::<u8>(), length, "text") }?;
    std::str::from_utf8(bytes).map_err(|e| CallFault::new(EqpStatus::BadText, e.to_string()))
}

/// # Safety
/// `text` points to `length` bytes.
unsafe fn parsed(text: *const c_char, length: usize, format: Format) -> Result<EqpDesign, CallFault> {
    // SAFETY: the caller's promise.
    let text = unsafe { utf8(text, length) }?;
    let (design, _) = parse(text, format).map_err(|violations| Error::Design { file: None, violations })?;
    Ok(EqpDesign::new(design))
}

/// Reads the text of a design file, TOML, of `length` bytes.
///
/// # Safety
/// `text` points to `length` bytes, and `design` to a place for a pointer. The argument `error` is null or points to a
/// place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_from_toml(
    text: *const c_char,
    length: usize,
    design: *mut *mut EqpDesign,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe { told(error, || give(parsed(text, length, Format::Toml)?, design, "design")) }
}

/// Reads the text of a design file, JSON, of `length` bytes.
///
/// # Safety
/// As `eqp_design_from_toml`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_from_json(
    text: *const c_char,
    length: usize,
    design: *mut *mut EqpDesign,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe { told(error, || give(parsed(text, length, Format::Json)?, design, "design")) }
}

/// Reads a design file; `path` ends with a zero and is UTF-8.
///
/// # Safety
/// `path` points to a text that ends with a zero, and `design` to a place for a pointer. The argument `error` is null
/// or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_load(
    path: *const c_char,
    design: *mut *mut EqpDesign,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            if path.is_null() {
                return Err(CallFault::null("path"));
            }
            let path = CStr::from_ptr(path);
            let path = path.to_str().map_err(|e| CallFault::new(EqpStatus::BadText, e.to_string()))?;
            give(EqpDesign::new(Design::load(path)?), design, "design")
        })
    }
}

/// Makes a design from the ends of its six legs: base joints in the base frame, platform joints in the platform frame,
/// in leg order. Its home is computed, and it has no limits.
///
/// # Safety
/// `base` and `platform` point to six points of three numbers, and `design` to a place for a pointer. The argument
/// `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_from_joints(
    base: *const f64,
    platform: *const f64,
    design: *mut *mut EqpDesign,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let base = read(base.cast::<[[f64; 3]; 6]>(), "base")?;
            let platform = read(platform.cast::<[[f64; 3]; 6]>(), "platform")?;
            let point = |x: &[f64; 3]| Point3::new(x[0], x[1], x[2]);
            let legs = std::array::from_fn(|i| Leg { base: point(&base[i]), platform: point(&platform[i]) });
            let made = Manipulator::from_legs(legs).map_err(Error::from)?;
            give(EqpDesign::new(Design::new("platform", "units", made)), design, "design")
        })
    }
}

/// The same design with another convention for poses as numbers: `text` holds the keys of `[frames]` in a design file,
/// TOML, of `length` bytes, such as `rotation_order = "pi"`. Keys that are absent are as in this library.
///
/// # Safety
/// `design` is a design, `text` points to `length` bytes, and `with` to a place for a pointer. The argument `error` is
/// null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_with_frames(
    design: *const EqpDesign,
    text: *const c_char,
    length: usize,
    with: *mut *mut EqpDesign,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe { told(error, || give(read(design, "design")?.with_frames(utf8(text, length)?)?, with, "with")) }
}

/// Frees a design; null is ignored. Objects made from it stay valid.
///
/// # Safety
/// `design` is null or a design that was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_free(design: *mut EqpDesign) {
    // SAFETY: the caller's promise.
    unsafe { take_back(design) }
}

/// The name of a design, valid as long as the design; null for null.
///
/// # Safety
/// `design` is null or a design.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_name(design: *const EqpDesign) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { design.as_ref() }.map_or(std::ptr::null(), |d| d.name.as_ptr())
}

/// The unit of lengths of a design, valid as long as the design; null for null.
///
/// # Safety
/// `design` is null or a design.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_units(design: *const EqpDesign) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { design.as_ref() }.map_or(std::ptr::null(), |d| d.units.as_ptr())
}

/// The convention of poses as numbers in sentences, valid as long as the design; null for null.
///
/// # Safety
/// `design` is null or a design.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_frames(design: *const EqpDesign) -> *const c_char {
    // SAFETY: the caller's promise.
    unsafe { design.as_ref() }.map_or(std::ptr::null(), |d| d.frames.as_ptr())
}

/// The home pose of a design, or the default pose above the base.
///
/// # Safety
/// `design` is a design, `pose` points to a place for a pose, `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_design_home(
    design: *const EqpDesign,
    pose: *mut EqpPose,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let home = read(design, "design")?.design.home_or_default();
            *write(pose, "pose")? = (&home).into();
            Ok(())
        })
    }
}

/// Inverse kinematics: six lengths for each of `count` poses.
///
/// # Safety
/// `design` is a design, `poses` points to `count` poses, and `lengths` to places for `count` rows of six numbers. The
/// argument `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_ik(
    design: *const EqpDesign,
    poses: *const EqpPose,
    count: usize,
    lengths: *mut f64,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let design = &read(design, "design")?.design;
            let poses = items(poses, count, "poses")?;
            let lengths = places(lengths.cast::<[f64; 6]>(), count, "lengths")?;
            for (pose, to) in poses.iter().zip(lengths) {
                *to = design.ik(&pose.checked()?)?.get();
            }
            Ok(())
        })
    }
}

/// The Jacobian at a pose, base frame, rows `[u_i, ((R b_i) x u_i) / L]`. It gives the speed of leg `i` from the
/// velocity of the platform origin and the angular velocity times `L`. `EQP_STATUS_BAD_LENGTHS` if the characteristic
/// length `L` is not positive and finite, `EQP_STATUS_COMPUTATION` for a leg of length zero.
///
/// # Safety
/// `design` is a design, `pose` points to a pose, and `rows` to places for six rows of six numbers. The argument
/// `error` is null or points to a place for an error.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn eqp_jacobian(
    design: *const EqpDesign,
    pose: *const EqpPose,
    characteristic_length: f64,
    rows: *mut f64,
    error: *mut EqpError,
) -> EqpStatus {
    // SAFETY: the caller's promises, here and in the body.
    unsafe {
        told(error, || {
            let design = &read(design, "design")?.design;
            let pose = read(pose, "pose")?.checked()?;
            if !(characteristic_length > 0.0 && characteristic_length.is_finite()) {
                let message = format!(
                    "characteristic_length is {characteristic_length}; give a positive finite length"
                );
                return Err(CallFault::new(EqpStatus::BadLengths, message));
            }
            let j = jacobian(design.manipulator(), &pose, characteristic_length);
            if let Some(leg) = (0..6).find(|i| j.row(*i).iter().any(|x| !x.is_finite())) {
                let message = format!("leg {} has no direction at this pose, or its row overflows", leg + 1);
                return Err(CallFault::new(EqpStatus::Computation, message));
            }
            *write(rows.cast::<[[f64; 6]; 6]>(), "rows")? =
                std::array::from_fn(|i| std::array::from_fn(|k| j[(i, k)]));
            Ok(())
        })
    }
}
