//! Shows a design to people who have only a browser: one HTML page, and the questions that it asks the core.
//!
//! The page computes nothing by itself: every number it shows is the answer of [`Session::answer`] to a request in
//! JSON. In the browser that function runs as WebAssembly; where there is none, the page replays answers that were
//! recorded when it was written. Text in, text out: nothing here reads or writes files.

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
