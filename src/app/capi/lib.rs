//! The C interface of the library: designs from text, lengths and poses, prepared solvers, batches, tracked poses.
//!
//! `eqp.h` beside this file is what cbindgen makes of it; `docs/c-interface.md` says how to build and use it. Nothing is computed here: pointers become values of the front page, and answers are written where the caller
//! says.
//!
//! Every function that can fail returns an `EqpStatus` and writes a text into an `EqpError` where the caller gives one; there is no state of the library to ask afterwards. A panic, which would be
//! a fault of the library, ends as `EqpStatus::Internal` and does not leave it. Designs, solvers and solutions do not change once they are made, so that threads may share them; a tracker belongs to one
//! thread at a time.

#![allow(
    unsafe_code,
    reason = "C hands over pointers and finds functions by exported names; every function says what it needs of its caller, and looks for null pointers"
)]
#![allow(unreachable_pub, reason = "C reaches them by name")]

mod design;
mod failure;
mod limits;
mod pose;
mod solving;
mod tracking;

use std::ffi::{CStr, c_char};

/// The version of the library, `major.minor.patch`: a text that stays.
#[unsafe(no_mangle)]
pub extern "C" fn eqp_version() -> *const c_char {
    // the one text of this function that ends with a zero
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(text) => text,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

#[cfg(test)]
mod tests;
