//! Outcomes: codes with texts.

use std::ffi::{CStr, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use ask::Error;
use files::design::Code;

/// The outcome of a call.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EqpStatus {
    /// Success.
    Ok = 0,
    /// A required pointer is null, or a number of items is too large.
    BadPointer = 1,
    /// A text is not UTF-8.
    BadText = 2,
    /// The text of a design is refused; the message lists all violations.
    BadDesign = 3,
    /// A file cannot be read.
    File = 4,
    /// Joints and legs that make no platform.
    BadJoints = 5,
    /// Values that are no leg lengths, or a characteristic length that is not positive and finite.
    BadLengths = 6,
    /// Numbers that make no pose.
    BadPose = 7,
    /// A pose so far away that lengths overflow.
    Overflow = 8,
    /// No pose that meets the requirements was found.
    NoAllowedPose = 9,
    /// An index beyond the number of items.
    BadIndex = 10,
    /// A failed computation, or a leg of length zero, which has no direction.
    Computation = 11,
    /// An error of the library.
    Internal = 12,
    /// The legs of a design are rods on cranks: functions for them are in the C of `equipod export DESIGN --to c`.
    Cranks = 13,
}

/// Size of the message of an error, bytes, including the zero at its end.
pub const EQP_MESSAGE: usize = 1024;

/// An error in words, owned by the caller. Pass a null pointer in its place to get no words.
#[repr(C)]
#[derive(Debug, Clone, Copy)]
pub struct EqpError {
    /// The outcome of the call.
    pub status: EqpStatus,
    /// The message, UTF-8 with a zero at its end; cut if it is too long, empty on success.
    pub message: [c_char; EQP_MESSAGE],
}

/// The meaning of a code, a static text, also for an unknown code.
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

/// The reason why a call failed, before the caller gets it.
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
            // the remedy comes first, since a message that is too long is cut at its end
            let message = format!(
                "the legs are rods on cranks, but this library takes legs of variable length; `equipod export DESIGN --to c` writes C for cranks: {error}"
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

/// Runs the body of an exported function and reports its outcome; no panic leaves it.
///
/// # Safety
/// `error` is null or points to an [`EqpError`] that this thread may write.
pub(super) unsafe fn told(error: *mut EqpError, body: impl FnOnce() -> Result<(), CallFault>) -> EqpStatus {
    // a body writes its answers last, so a panic leaves no incomplete value that is read later
    let outcome = catch_unwind(AssertUnwindSafe(body)).unwrap_or_else(|payload| {
        let said = payload.downcast_ref::<&str>().map(ToString::to_string);
        let said = said.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
        Err(CallFault::new(EqpStatus::Internal, format!("a fault of the library: {said}")))
    });
    let (status, message) = match &outcome {
        Ok(()) => (EqpStatus::Ok, ""),
        Err(fault) => (fault.status, fault.message.as_str()),
    };
    // SAFETY: the caller's promise; null is checked.
    if let Some(error) = unsafe { error.as_mut() } {
        error.status = status;
        write_text(message, &mut error.message);
    }
    status
}

/// Writes a text with a zero at its end, cut between two characters if it is too long.
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
/// `pointer` is null or points to a `T` that stays unchanged while the reference lives.
pub(super) unsafe fn read<'a, T>(pointer: *const T, what: &str) -> Result<&'a T, CallFault> {
    // SAFETY: the caller's promise; null is checked.
    unsafe { pointer.as_ref() }.ok_or_else(|| CallFault::null(what))
}

/// A place of the caller for an answer.
///
/// # Safety
/// `pointer` is null or points to a `T` that only this thread reads and writes while the reference lives.
pub(super) unsafe fn write<'a, T>(pointer: *mut T, what: &str) -> Result<&'a mut T, CallFault> {
    // SAFETY: the caller's promise; null is checked.
    unsafe { pointer.as_mut() }.ok_or_else(|| CallFault::null(what))
}

/// Items of the caller.
///
/// # Safety
/// `pointer` is null or points to `count` consecutive values of `T` that stay unchanged while the slice lives.
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
/// `pointer` is null or points to `count` consecutive values of `T` that only this thread reads and writes while the
/// slice lives.
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

/// Gives a value to the caller, who frees it with the function for its type.
///
/// # Safety
/// As [`write()`].
pub(super) unsafe fn give<T>(value: T, to: *mut *mut T, what: &str) -> Result<(), CallFault> {
    // SAFETY: the caller's promise. The place is checked first: without one the value is dropped here.
    let to = unsafe { write(to, what) }?;
    *to = Box::into_raw(Box::new(value));
    Ok(())
}

/// Takes back a value from [`give`]; null is ignored.
///
/// # Safety
/// `pointer` is null or came from [`give`] and was not taken back before.
pub(super) unsafe fn take_back<T>(pointer: *mut T) {
    if !pointer.is_null() {
        // SAFETY: the caller's promise. A panic of a destructor would be an error of the library, and is kept inside.
        let _ = catch_unwind(AssertUnwindSafe(|| drop(unsafe { Box::from_raw(pointer) })));
    }
}
