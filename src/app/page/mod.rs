//! Shows a design to users who have only a browser: one HTML page, and its questions to the core.
//!
//! The page computes nothing itself: every number it shows is the answer of [`Session::answer`] to a request in JSON.
//! In the browser this function runs as WebAssembly. Without WebAssembly, the page replays answers recorded when it was
//! written. The functions here map text to text, without access to files.

mod begin;
mod derivation;
mod feasible;
mod html;
#[cfg(not(target_arch = "wasm32"))]
mod licences;
mod limits;
mod modes;
mod motion;
mod opening;
mod path;
mod plane;
mod request;
mod scene;
mod session;
mod start;
mod surface;
#[cfg(test)]
mod tests;
mod worst;

#[cfg(not(target_arch = "wasm32"))]
pub use html::CORE;
pub use html::{page, policy, strict_policy};
#[cfg_attr(not(feature = "cli"), allow(unused_imports, reason = "the command line alone uses it"))]
pub use session::{InvalidStart, Session};
