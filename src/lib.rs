//! Design synthesis and kinematic equivalence of Gough-Stewart platforms.
//!
//! Leg `i` joins the base joint `a_i` to the platform joint `b_i`; at the pose `(R, p)` its squared length is
//!
//! ```text
//! s_i = |R b_i + p - a_i|^2.
//! ```
//!
//! Two platforms are *kinematically equivalent* when `s' = A s + c` with `det A != 0` holds at every pose.

pub mod bench;
#[cfg(feature = "cli")]
pub mod cli;
pub mod design;
pub mod dimensional;
pub mod distance;
pub mod equivalence;
pub mod export;
pub mod fk;
pub mod geom;
pub mod manipulator;
pub mod manufacture;
pub mod num;
pub mod offsets;
pub mod page;
pub mod plot;
pub mod poly;
pub mod report;
pub mod requirements;
pub mod singularity;
pub mod solve;
pub mod synthesis;
pub mod topology;

/// The code of the README is compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
