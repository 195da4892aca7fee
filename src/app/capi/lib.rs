//! The C interface of the library: designs from text, lengths and poses, prepared solvers, batches, tracked poses.
//!
//! cbindgen makes `eqp.h` beside this file; `docs/c-interface.md` describes how to build and use it. Nothing is
//! computed here: pointers become values of the front page, and answers are written to places of the caller.
//!
//! Every function that can fail returns an `EqpStatus`, and writes a text into an `EqpError` if the caller gives one.
//! The library keeps no error state. A panic, which would be an error of the library, ends as `EqpStatus::Internal`.
//! Designs, solvers and solutions are immutable, so threads may share them. A tracker belongs to one thread at a time.

#![allow(
    unsafe_code,
    reason = "C hands over pointers and finds functions by exported names; every function says what it needs of its caller, and checks for null pointers"
)]
#![allow(unreachable_pub, reason = "C reaches them by name")]

mod design;
mod failure;
mod limits;
mod pose;
mod solving;
mod tracking;

use std::ffi::{CStr, c_char};

/// The version of the library, `major.minor.patch`, a static text.
#[unsafe(no_mangle)]
pub extern "C" fn eqp_version() -> *const c_char {
    // the only text of this function that ends with a zero
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(text) => text,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

#[cfg(test)]
mod tests;
