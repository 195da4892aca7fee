//! Design synthesis and kinematic equivalence of Gough-Stewart platforms.
//!
//! Leg `i` joins the base joint `a_i` to the platform joint `b_i`; at the pose `(R, p)` its squared length is
//!
//! ```text
//! s_i = |R b_i + p - a_i|^2.
//! ```
//!
//! Two platforms are *kinematically equivalent* when `s' = A s + c` with `det A != 0` holds at every pose.

mod bench;
#[cfg(feature = "cli")]
pub mod cli;
mod design;
mod dimensional;
mod distance;
mod equivalence;
mod export;
mod fk;
mod geom;
mod manipulator;
mod manufacture;
mod num;
mod offsets;
mod page;
mod plot;
mod poly;
pub mod records;
mod report;
mod requirements;
mod singularity;
mod solve;
mod synthesis;
mod topology;

/// The modules behind the entrance, for those who develop methods: a new solver, a new way to prove a root, another
/// search. Users of the library need none of them.
///
/// Each holds what its layer knows (`docs/architecture.md`). Names and signatures in here change from version to version.
pub mod methods {
    /// Problems drawn from a class, solved, validated with arithmetic of their own, counted and timed.
    pub mod bench {
        pub use crate::bench::*;
    }
    /// Design files: text in, values out, and back to text.
    pub mod design {
        pub use crate::design::*;
    }
    /// The best platform that meets its requirements: offsets, triangles, height, joint axes.
    pub mod dimensional {
        pub use crate::dimensional::*;
    }
    /// Poses from distances alone: Cayley-Menger determinants, trilateration, closure conditions.
    pub mod distance {
        pub use crate::distance::*;
    }
    /// Whether two platforms are equivalent: the leg map and forward kinematics, compared.
    pub mod equivalence {
        pub use crate::equivalence::*;
    }
    /// Files for other programs: a design in, texts out.
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
    pub mod manufacture {
        pub use crate::manufacture::*;
    }
    /// Seeded random numbers, double-double, interval and exact arithmetic, dense linear algebra, conic programs.
    pub mod num {
        pub use crate::num::*;
    }
    /// The best platform without shared joints in the class of an octahedral one.
    pub mod offsets {
        pub use crate::offsets::*;
    }
    /// One HTML page of a design, and the answers it gets from the core.
    pub mod page {
        pub use crate::page::*;
    }
    /// Pictures: values in, SVG text out.
    pub mod plot {
        pub use crate::plot::*;
    }
    /// Polynomials in one unknown.
    pub mod poly {
        pub use crate::poly::*;
    }
    /// A folder of results as one HTML page: files in, HTML text out.
    pub mod report {
        pub use crate::report::*;
    }
    /// What a platform has to satisfy, evaluated from the definitions.
    pub mod requirements {
        pub use crate::requirements::*;
    }
    /// Designs that no pose can hold, singular poses, self-motions.
    pub mod singularity {
        pub use crate::singularity::*;
    }
    /// The leg equations over the complex numbers, and certificates of their roots.
    pub mod solve {
        pub use crate::solve::*;
    }
    /// Leg maps, and the class of equivalent platforms.
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
