//! The four exported functions of the WebAssembly module.
//!
//! The page writes a text to [`input`](equipod_input) and calls [`open`](equipod_open) or [`answer`](equipod_answer).
//! It then reads the returned number of bytes at [`output`](equipod_output). The design stays open between calls. Only
//! this part of the library has a state, and it exists only in WebAssembly.
#![allow(
    unsafe_code,
    reason = "an exported name must be unique in the whole program; these four are, and no other unsafe code is here"
)]
#![allow(unreachable_pub, reason = "the page reaches them by name")]

use std::sync::{Mutex, MutexGuard, PoisonError};

use equipod::methods::page::Session;

/// The texts between page and core.
#[derive(Debug)]
struct Desk {
    input: Vec<u8>,
    output: Vec<u8>,
    session: Option<Session>,
}

static DESK: Mutex<Desk> = Mutex::new(Desk { input: Vec::new(), output: Vec::new(), session: None });

fn desk() -> MutexGuard<'static, Desk> {
    // a panic ends the module, so a broken state is never used
    DESK.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Desk {
    fn reply(&mut self, text: String) -> usize {
        self.output = text.into_bytes();
        self.output.len()
    }
}

/// Memory for a text of `length` bytes, which the page fills with UTF-8 before the next call.
#[unsafe(no_mangle)]
pub extern "C" fn equipod_input(length: usize) -> *mut u8 {
    let mut desk = desk();
    desk.input = vec![0; length];
    desk.input.as_mut_ptr()
}

/// The address of the last reply.
#[unsafe(no_mangle)]
pub extern "C" fn equipod_output() -> *const u8 {
    desk().output.as_ptr()
}

/// Opens the design of the input as [`Session::open`]. Returns the length of the reply: zero, or the length of an
/// error.
#[unsafe(no_mangle)]
pub extern "C" fn equipod_open() -> usize {
    let mut desk = desk();
    let text = String::from_utf8_lossy(&desk.input).into_owned();
    match Session::open(&text) {
        Ok(session) => {
            desk.session = Some(session);
            desk.reply(String::new())
        }
        Err(error) => desk.reply(error),
    }
}

/// Answers the request of the input as [`Session::answer`]. Returns the length of the reply.
#[unsafe(no_mangle)]
pub extern "C" fn equipod_answer() -> usize {
    let mut desk = desk();
    let text = String::from_utf8_lossy(&desk.input).into_owned();
    let reply = desk.session.as_ref().map(|s| s.answer(&text)).unwrap_or_default();
    desk.reply(reply)
}
