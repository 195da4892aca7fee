//! Measures reliability and speed of the solver. It draws random problems of a class, solves and times them, and
//! validates every answer independently of the solver's code.
//!
//! The chain is generator ([`Class`], [`problem`]) -> any [`ForwardKinematics`](fk::ForwardKinematics) -> [`validate`]
//! -> [`BenchReport`]. The validator is a double-double Newton method in the twelve entries of `R` and `p`, on the data
//! as given. Problem `k` of a class depends only on the seed, the class and `k`, so these three values name a failure.
//!
//! Below `cli` only this module measures time.

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
