//! Outcomes: codes with texts.

use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use ask::Error;
use files::design::Code;

/// What became of a call.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpStatus {
    /// Done.
    Ok = 0,
    /// A pointer is null that must not be, or a number of items is too large.
    BadPointer = 1,
    /// A text is not UTF-8.
    BadText = 2,
    /// The text of a design is refused; all that is wrong with it is in the message.
    BadDesign = 3,
    /// A file cannot be read.
    File = 4,
    /// Joints and legs that make no platform.
    BadJoints = 5,
    /// Values that are no leg lengths, or a characteristic length that is not positive and finite.
    BadLengths = 6,
    /// Numbers that are no pose.
    BadPose = 7,
    /// A pose so far away that lengths overflow.
    Overflow = 8,
    /// No pose was found that meets the requirements.
    NoAllowedPose = 9,
    /// An index beyond the number of items.
    BadIndex = 10,
    /// A computation that broke down, or a leg of length zero, which has no direction.
    Computation = 11,
    /// A fault of the library.
    Internal = 12,
    /// The legs of a design are rods on cranks: functions for them are in the C of `equipod export DESIGN --to c`.
    Cranks = 13,
}

/// Bytes of the message of an error, the zero at its end included.
pub const EQP_MESSAGE: usize = 1024;

/// What went wrong, in words. The caller owns it; a null pointer in its place says that no words are wanted.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct EqpError {
    /// The outcome of the call.
    pub status: EqpStatus,
    /// UTF-8 that ends with a zero; cut where it is longer, empty where all is well.
    pub message: [c_char; EQP_MESSAGE],
}

/// What a code means, a text that stays; for a number that is no code it says so.
#[unsafe(no_mangle)]
pub extern "C" fn eqp_status_text(status: i32) -> *const c_char {
    let text: &CStr = match status {
        0 => c"done",
        1 => c"a pointer is null that must not be, or a number of items is too large",
        2 => c"a text is not UTF-8",
        3 => c"the text of a design is refused",
        4 => c"a file cannot be read",
        5 => c"joints and legs that make no platform",
        6 => c"values that are no leg lengths, or a characteristic length that is not positive and finite",
        7 => c"numbers that are no pose",
        8 => c"a pose so far away that lengths overflow",
        9 => c"no pose was found that meets the requirements",
        10 => c"an index beyond the number of items",
        11 => c"a computation that broke down, or a leg of length zero",
        12 => c"a fault of the library",
        13 => c"legs that are rods on cranks, which the C of `equipod export DESIGN --to c` takes",
        _ => c"no status of this library",
    };
    text.as_ptr()
}

/// Why a call failed, before it is told.
#[derive(Debug)]
pub(super) struct CallFault {
    pub(super) status: EqpStatus,
    message: String,
}

impl CallFault {
    pub(super) fn new(status: EqpStatus, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    pub(super) fn null(what: &str) -> Self {
        Self::new(EqpStatus::BadPointer, format!("{what} is a null pointer"))
    }
}

impl From<Error> for CallFault {
    fn from(error: Error) -> Self {
        if let Error::Design { violations, .. } = &error
            && violations.iter().any(|v| v.code == Code::Rotary)
        {
            // what to do comes first: a message that is too long is cut at its end
            let message = format!(
                "the legs are rods on cranks, and this library takes legs that change their lengths; `equipod export DESIGN --to c` writes C for cranks: {error}"
            );
            return Self::new(EqpStatus::Cranks, message);
        }
        let status = match &error {
            Error::Design { .. } | Error::Trajectory { .. } => EqpStatus::BadDesign,
            Error::File { .. } => EqpStatus::File,
            Error::Manipulator(_) | Error::Joint(_) => EqpStatus::BadJoints,
            Error::Lengths(_) => EqpStatus::BadLengths,
            Error::Pose(_) => EqpStatus::BadPose,
            Error::Overflow => EqpStatus::Overflow,
            Error::NoAllowedPose => EqpStatus::NoAllowedPose,
            _ => EqpStatus::Computation,
        };
        Self::new(status, error.to_string())
    }
}

/// Runs the body of an exported function and tells its outcome; no panic passes.
///
/// # Safety
/// `error` is null or points to an [`EqpError`] that this thread may write.
pub(super) unsafe fn told(error: *mut EqpError, body: impl FnOnce() -> Result<(), CallFault>) -> EqpStatus {
    // a body writes its answers last, so that a panic leaves nothing half made that is looked at again
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        let said = payload.downcast_ref::<&str>().map(ToString::to_string);
        let said = said.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
        Err(CallFault::new(EqpStatus::Internal, format!("a fault of the library: {said}")))
    });
    let (status, message) = match &outcome {
        Ok(()) => (EqpStatus::Ok, ""),
        Err(fault) => (fault.status, fault.message.as_str()),
    };
    // SAFETY: the caller's promise; null is looked for.
    if let Some(error) = unsafe { error.as_mut() } {
        error.status = status;
        write_text(message, &mut error.message);
    }
    status
}

/// Writes a text with a zero at its end, cut between two characters where it is too long.
fn write_text(text: &str, to: &mut [c_char; EQP_MESSAGE]) {
    let mut length = text.len().min(EQP_MESSAGE - 1);
    while !text.is_char_boundary(length) {
        length -= 1;
    }
    for (to, byte) in to.iter_mut().zip(text[..length].bytes().chain([0])) {
        *to = c_char::from_ne_bytes([byte]);
    }
}

/// A value behind a pointer of the caller.
///
/// # Safety
/// `pointer` is null or points to a `T` that nothing changes while the reference lives.
pub(super) unsafe fn read<'a, T>(pointer: *const T, what: &str) -> Result<&'a T, CallFault> {
    // SAFETY: the caller's promise; null is looked for.
    unsafe { pointer.as_ref() }.ok_or_else(|| CallFault::null(what))
}

/// A place that the caller wants an answer in.
///
/// # Safety
/// `pointer` is null or points to a `T` that this thread may write and nobody else looks at while the reference lives.
pub(super) unsafe fn write<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut T, CallFault> {
    // SAFETY: the caller's promise; null is looked for.
    unsafe { pointer.as_mut() }.ok_or_else(|| CallFault::null(what))
}

/// Items of the caller.
///
/// # Safety
/// `pointer` is null or points to `count` values of `T` one after the other that nothing changes while the slice lives.
pub(super) unsafe fn items<'a, T>(pointer: *const T, count: usize, what: &str) -> Result<&'a [T], CallFault> {
    checked_count::<T>(count, what)?;
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(CallFault::null(what));
    }
    // SAFETY: not null, the caller's promise for the rest, and no more bytes than a slice may have.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Places for items of the caller.
///
/// # Safety
/// `pointer` is null or points to `count` values of `T` one after the other that this thread may write and nobody else looks at while the slice lives.
pub(super) unsafe fn places<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [T], CallFault> {
    checked_count::<T>(count, what)?;
    if count == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() {
        return Err(CallFault::null(what));
    }
    // SAFETY: not null, the caller's promise for the rest, and no more bytes than a slice may have.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

fn checked_count<T>(count: usize, what: &str) -> Result<(), CallFault> {
    let bytes = count.checked_mul(size_of::<T>()).filter(|bytes| isize::try_from(*bytes).is_ok());
    bytes.map(|_| ()).ok_or_else(|| CallFault::new(EqpStatus::BadPointer, format!("{what}: too many items")))
}

/// Gives a value to the caller, who frees it by the function for its type.
///
/// # Safety
/// As [`write()`].
pub(super) unsafe fn give<T>(value: T, to: *mut *mut T, what: &str) -> Result<(), CallFault> {
    // SAFETY: the caller's promise. The place comes first: without one the value is dropped here.
    let to = unsafe { write(to, what) }?;
    *to = Box::into_raw(Box::new(value));
    Ok(())
}

/// Takes back what [`give`] gave; null is nothing.
///
/// # Safety
/// `pointer` is null or came from [`give`] and was not taken back before.
pub(super) unsafe fn take_back<T>(pointer: *mut T) {
    if !pointer.is_null() {
        // SAFETY: the caller's promise. A panic of a destructor would be a fault of the library and is kept from leaving it.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(unsafe { Box::from_raw(pointer) })));
    }
}
