//! Shows how reliable and how fast the solver is: this module draws random problems of a class, solves them, validates
//! every answer with code that shares nothing with the solver, counts and times.
//!
//! Generator ([`Class`], [`problem`]) -> any [`ForwardKinematics`](fk::ForwardKinematics) -> [`validate`]
//! (double-double Newton in the twelve entries of `R` and `p`, on the data as given) -> [`BenchReport`]. Problem `k` of
//! a class depends on the seed, the class and `k` only, so that a failure is named by three values.
//!
//! This module measures time; nothing else below `cli` does.

mod classes;
mod dual;
mod error_metric;
mod exact_members;
mod expectation;
mod generator;
mod newton;
mod noise;
mod raw;
mod reference_time;
mod run;
mod singular;
mod statistics;
mod symmetry;
mod validator;

pub use classes::{Class, Planar};
pub use error_metric::error_metric;
pub use generator::{LengthsFrom, NotDrawn, Problem, problem};
pub use noise::{NOISE_LEVELS, NoiseLevel, NoisePlan, Spread, noise};
pub use raw::{Elimination, EliminationMatrix, ErrorBin, GapStatistics, RawReport, StepTime};
pub use reference_time::{ReferenceTimes, reference_times};
pub use run::{OpenAnswer, Plan, RunError, WrongAnswer, run};
pub use statistics::{BenchReport, ErrorStatistics, TimeSplit};
pub use validator::{Claim, Validation, validate};
