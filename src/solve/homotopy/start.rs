//! The generic start system: 40 solutions of six general sections, shipped as data.
//!
//! `data/generic40.txt` is written by `cargo run --example generate_start_system` from a seed; a test makes it
//! again and compares.

use std::fmt::Write as _;
use std::sync::OnceLock;

use num_complex::Complex64;
use thiserror::Error;

use super::monodromy::{GENERIC_COUNT, StartSystem, generate};
use crate::solve::sections::{FORMS, Sections};

/// Seed of the shipped data.
pub const SHIPPED_SEED: u64 = 2;

/// Start data that cannot be read or made.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum StartError {
    /// A number is missing or malformed.
    #[error("number {index} of the start data is missing or malformed")]
    Malformed {
        /// 0-based index of the number in the file.
        index: usize,
    },
    /// The target sections are not real.
    #[error("the target sections are not real")]
    NotReal,
    /// Monodromy did not find all solutions.
    #[error("monodromy from seed {seed} did not reach {GENERIC_COUNT} solutions")]
    Incomplete {
        /// The seed.
        seed: u64,
    },
}

/// The text of a start data file made from `seed`.
///
/// # Errors
/// [`StartError::Incomplete`] when monodromy stops short of 40 solutions.
pub fn start_system_text(seed: u64) -> Result<String, StartError> {
    let system = generate(seed, 200).ok_or(StartError::Incomplete { seed })?;
    let mut text = format!(
        "# Generic start system: 6 sections of {FORMS} complex coefficients, then {GENERIC_COUNT} solutions (e, g) of\n\
         # 8 complex numbers, one a line as 're im'. Made by monodromy, seed {seed}:\n\
         #   cargo run --release --example generate_start_system\n"
    );
    let sections = system.sections.rows.iter().flatten();
    let numbers = sections.chain(system.solutions.iter().flatten());
    for z in numbers {
        // writing to a String cannot fail
        let _ = writeln!(text, "{:?} {:?}", z.re, z.im);
    }
    Ok(text)
}

fn parse(text: &str) -> Result<StartSystem, StartError> {
    let mut words = text.lines().filter(|l| !l.starts_with('#')).flat_map(str::split_whitespace).enumerate();
    let mut index = 0;
    let mut next = || -> Result<f64, StartError> {
        let (i, word) = words.next().ok_or(StartError::Malformed { index })?;
        index = i + 1;
        word.parse().map_err(|_| StartError::Malformed { index: i })
    };
    let mut complex = || -> Result<Complex64, StartError> { Ok(Complex64::new(next()?, next()?)) };
    let mut sections = Sections { rows: [[Complex64::ZERO; FORMS]; 6] };
    for z in sections.rows.iter_mut().flatten() {
        *z = complex()?;
    }
    let mut solutions = vec![[Complex64::ZERO; 8]; GENERIC_COUNT];
    for z in solutions.iter_mut().flatten() {
        *z = complex()?;
    }
    Ok(StartSystem { sections, solutions })
}

/// The shipped start system.
pub(crate) fn shipped() -> Result<&'static StartSystem, StartError> {
    static SYSTEM: OnceLock<Result<StartSystem, StartError>> = OnceLock::new();
    SYSTEM.get_or_init(|| parse(include_str!("data/generic40.txt"))).as_ref().map_err(Clone::clone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::homotopy::endgame::projective_distance;
    use crate::solve::sections::forms;

    #[test]
    fn shipped_solutions_solve_the_shipped_sections_and_are_distinct() {
        let system = shipped().unwrap();
        for (i, x) in system.solutions.iter().enumerate() {
            for row in &system.sections.rows {
                let value: Complex64 = row.iter().zip(forms(*x)).map(|(c, z)| c * z).sum();
                assert!(value.norm() < 1e-13);
            }
            assert!(system.solutions[..i].iter().all(|y| projective_distance(x, y) > 1e-3));
        }
    }

    #[test]
    fn shipped_data_is_what_the_generator_makes() {
        let again = parse(&start_system_text(SHIPPED_SEED).unwrap()).unwrap();
        let system = shipped().unwrap();
        for (p, q) in again.sections.rows.iter().flatten().zip(system.sections.rows.iter().flatten()) {
            assert!((p - q).norm() < 1e-12);
        }
        for x in &again.solutions {
            assert!(system.solutions.iter().any(|y| projective_distance(x, y) < 1e-10));
        }
    }

    #[test]
    fn damaged_data_is_refused_with_its_place() {
        assert_eq!(parse("0.5 x").unwrap_err(), StartError::Malformed { index: 1 });
        assert_eq!(parse("# only a comment\n0.5").unwrap_err(), StartError::Malformed { index: 1 });
    }
}
