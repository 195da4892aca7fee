//! Design synthesis and kinematic equivalence of Gough-Stewart platforms.
//!
//! Leg `i` joins the base joint `a_i` to the platform joint `b_i`; at the pose `(R, p)` its squared length is
//!
//! ```text
//! s_i = |R b_i + p - a_i|^2.
//! ```
//!
//! Two platforms are *kinematically equivalent* when `s' = A s + c` with `det A != 0` holds at every pose.
//!
//! Without cargo features the crate solves forward kinematics: all poses for given leg lengths, each with its certificate. The features
//! `synthesis`, `optimize`, `files`, `page`, `lab` and `cli` add the rest; `docs/architecture.md` says what each costs.

#![cfg_attr(
    not(feature = "cli"),
    allow(
        dead_code,
        unused_imports,
        reason = "the layers below serve every capability, also those left out"
    )
)]

#[cfg(feature = "lab")]
mod bench;
#[cfg(feature = "cli")]
pub mod cli;
#[cfg(feature = "files")]
mod design;
#[cfg(feature = "optimize")]
mod dimensional;
mod distance;
#[cfg(feature = "synthesis")]
mod equivalence;
#[cfg(feature = "files")]
mod export;
mod fk;
mod geom;
mod manipulator;
#[cfg(feature = "synthesis")]
mod manufacture;
mod num;
#[cfg(feature = "optimize")]
mod offsets;
#[cfg(feature = "page")]
mod page;
#[cfg(feature = "files")]
mod plot;
mod poly;
#[cfg(feature = "page")]
pub mod records;
#[cfg(feature = "page")]
mod report;
#[cfg(any(feature = "files", feature = "synthesis"))]
mod requirements;
#[cfg(feature = "synthesis")]
mod singularity;
mod solve;
#[cfg(feature = "synthesis")]
mod synthesis;
mod topology;

/// The modules behind the entrance, for those who develop methods: a new solver, a new way to prove a root, another
/// search. Users of the library need none of them.
///
/// Each holds what its layer knows (`docs/architecture.md`). Names and signatures in here change from version to version.
pub mod methods {
    /// Problems drawn from a class, solved, validated with arithmetic of their own, counted and timed.
    #[cfg(feature = "lab")]
    pub mod bench {
        pub use crate::bench::*;
    }
    /// Design files: text in, values out, and back to text.
    #[cfg(feature = "files")]
    pub mod design {
        pub use crate::design::*;
    }
    /// The best platform that meets its requirements: offsets, triangles, height, joint axes.
    #[cfg(feature = "optimize")]
    pub mod dimensional {
        pub use crate::dimensional::*;
    }
    /// Poses from distances alone: Cayley-Menger determinants, trilateration, closure conditions.
    pub mod distance {
        pub use crate::distance::*;
    }
    /// Whether two platforms are equivalent: the leg map and forward kinematics, compared.
    #[cfg(feature = "synthesis")]
    pub mod equivalence {
        pub use crate::equivalence::*;
    }
    /// Files for other programs: a design in, texts out.
    #[cfg(feature = "files")]
    pub mod export {
        pub use crate::export::*;
    }
    /// Forward kinematics: all finite complex poses for given leg lengths, by every method.
    pub mod fk {
        pub use crate::fk::*;
    }
    /// Poses, quaternions, distances.
    pub mod geom {
        pub use crate::geom::*;
    }
    /// Joints, legs, lengths, inverse kinematics, Jacobian.
    pub mod manipulator {
        pub use crate::manipulator::*;
    }
    /// Tolerances of the joints, the correction a controller runs, joints on a grid of holes.
    #[cfg(feature = "synthesis")]
    pub mod manufacture {
        pub use crate::manufacture::*;
    }
    /// Seeded random numbers, double-double, interval and exact arithmetic, dense linear algebra, conic programs.
    pub mod num {
        pub use crate::num::*;
    }
    /// The best platform without shared joints in the class of an octahedral one.
    #[cfg(feature = "optimize")]
    pub mod offsets {
        pub use crate::offsets::*;
    }
    /// One HTML page of a design, and the answers it gets from the core.
    #[cfg(feature = "page")]
    pub mod page {
        pub use crate::page::*;
    }
    /// Pictures: values in, SVG text out.
    #[cfg(feature = "files")]
    pub mod plot {
        pub use crate::plot::*;
    }
    /// Polynomials in one unknown.
    pub mod poly {
        pub use crate::poly::*;
    }
    /// A folder of results as one HTML page: files in, HTML text out.
    #[cfg(feature = "page")]
    pub mod report {
        pub use crate::report::*;
    }
    /// What a platform has to satisfy, evaluated from the definitions.
    #[cfg(any(feature = "files", feature = "synthesis"))]
    pub mod requirements {
        pub use crate::requirements::*;
    }
    /// Designs that no pose can hold, singular poses, self-motions.
    #[cfg(feature = "synthesis")]
    pub mod singularity {
        pub use crate::singularity::*;
    }
    /// The leg equations over the complex numbers, and certificates of their roots.
    pub mod solve {
        pub use crate::solve::*;
    }
    /// Leg maps, and the class of equivalent platforms.
    #[cfg(feature = "synthesis")]
    pub mod synthesis {
        pub use crate::synthesis::*;
    }
    /// Which legs share which joints, and the catalogue of all ways to share them.
    pub mod topology {
        pub use crate::topology::*;
    }
}

/// The code of the README is compiled and run as a documentation test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct ReadmeExamples;
