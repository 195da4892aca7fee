//! The start systems, shipped as data: 40 solutions of six general sections, and 20 solutions for doubly planar
//! platforms. The latter are one of each mirror pair of solutions of six general sections in the ten forms.
//!
//! `data/generic40.txt` and `data/planar20.txt` are written by `cargo run --example generate_start_system` from a
//! seed; a test makes them again and compares.

use std::fmt::Write as _;
use std::sync::OnceLock;

use num_complex::Complex64;
use thiserror::Error;

use super::monodromy::{StartKind, StartSystem, generate};
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
    /// The sections are linearly dependent.
    #[error("the sections of the start data are linearly dependent")]
    Degenerate,
    /// The target sections are not real.
    #[error("the target sections are not real")]
    NotReal,
    /// Monodromy did not find all solutions.
    #[error("monodromy from seed {seed} did not reach {count} solutions")]
    Incomplete {
        /// The seed.
        seed: u64,
        /// Number of solutions there are.
        count: usize,
    },
}

/// The text of a start data file made from `seed`.
///
/// # Errors
/// [`StartError::Incomplete`] when monodromy stops short of all solutions.
pub fn start_system_text(kind: StartKind, seed: u64) -> Result<String, StartError> {
    let count = kind.count();
    let system = generate(kind, seed, 200).ok_or(StartError::Incomplete { seed, count })?;
    let name = match kind {
        StartKind::Generic => "Generic start system",
        StartKind::Planar => "Start system in the ten planar forms, one solution of each mirror pair",
    };
    let mut text = format!(
        "# {name}: 6 sections of {FORMS} complex coefficients, then {count} solutions (e, g) of\n\
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

fn parse(text: &str, count: usize) -> Result<StartSystem, StartError> {
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
    let mut solutions = vec![[Complex64::ZERO; 8]; count];
    for z in solutions.iter_mut().flatten() {
        *z = complex()?;
    }
    Ok(StartSystem { sections, solutions })
}

/// The same system in the basis in which targets are given, see
/// [`ScaledFrames::sections`](crate::solve::sections::ScaledFrames).
fn graded(system: StartSystem) -> Result<StartSystem, StartError> {
    let sections = system.sections.graded().ok_or(StartError::Degenerate)?;
    Ok(StartSystem { sections, ..system })
}

type Shipped = OnceLock<Result<StartSystem, StartError>>;

/// The shipped start system of a kind.
pub(crate) fn shipped(kind: StartKind) -> Result<&'static StartSystem, StartError> {
    static GENERIC: Shipped = OnceLock::new();
    static PLANAR: Shipped = OnceLock::new();
    let (system, text) = match kind {
        StartKind::Generic => (&GENERIC, include_str!("data/generic40.txt")),
        StartKind::Planar => (&PLANAR, include_str!("data/planar20.txt")),
    };
    system.get_or_init(|| graded(parse(text, kind.count())?)).as_ref().map_err(Clone::clone)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::homotopy::endgame::projective_distance;
    use crate::solve::planar::mirror;
    use crate::solve::sections::forms;

    const KINDS: [StartKind; 2] = [StartKind::Generic, StartKind::Planar];

    #[test]
    fn shipped_solutions_solve_the_shipped_sections_and_are_distinct() {
        for kind in KINDS {
            let system = shipped(kind).unwrap();
            assert_eq!(system.solutions.len(), kind.count());
            let mut all = system.solutions.clone();
            if kind == StartKind::Planar {
                all.extend(system.solutions.iter().map(|x| mirror(*x)));
            }
            assert_eq!(all.len(), 40);
            for (i, x) in all.iter().enumerate() {
                for row in &system.sections.rows {
                    let value: Complex64 = row.iter().zip(forms(*x)).map(|(c, z)| c * z).sum();
                    assert!(value.norm() < 1e-13);
                }
                let study: Complex64 = (0..4).map(|k| x[k] * x[4 + k]).sum();
                let n: Complex64 = (0..4).map(|k| x[k] * x[k]).sum();
                assert!(study.norm() < 1e-13 && n.norm() > 1e-6);
                assert!(all[..i].iter().all(|y| projective_distance(x, y) > 1e-3));
            }
        }
    }

    #[test]
    fn shipped_data_is_what_the_generator_makes() {
        for kind in KINDS {
            let again = parse(&start_system_text(kind, SHIPPED_SEED).unwrap(), kind.count()).unwrap();
            let (again, system) = (graded(again).unwrap(), shipped(kind).unwrap());
            for (p, q) in again.sections.rows.iter().flatten().zip(system.sections.rows.iter().flatten()) {
                assert!((p - q).norm() < 1e-12);
            }
            for x in &again.solutions {
                assert!(system.solutions.iter().any(|y| projective_distance(x, y) < 1e-10));
            }
        }
    }

    #[test]
    fn damaged_data_is_refused_with_its_place() {
        assert_eq!(parse("0.5 x", 40).unwrap_err(), StartError::Malformed { index: 1 });
        assert_eq!(parse("# only a comment\n0.5", 40).unwrap_err(), StartError::Malformed { index: 1 });
    }
}
