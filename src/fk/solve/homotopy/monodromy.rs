//! Start solutions from nothing: one solution is easy to make, monodromy finds the others.
//!
//! Six random sections through a random point of the Study quadric have that point as a solution. Moving the sections
//! round triangles with random corners permutes the solutions of the same system. The known ones are sent round until
//! their number reaches the degree 40 of the compactified group (Duff et al. 2019). Sections in the ten forms of doubly
//! planar platforms have 20 mirror pairs, of which one member each is kept.

use num_complex::Complex64;

use super::dispatch::track_all;
use super::endgame::projective_distance;
use super::limits::CAREFUL;
use super::system::SectionHomotopy;
use crate::solve::planar::{PLANAR_FORMS, mirror, spatial_row};
use crate::solve::sections::{FormRow, Sections, forms};
use num::Rng;

/// Number of solutions of six general sections: the degree of the compactification.
pub const GENERIC_COUNT: usize = 40;

/// A start system with its solutions.
#[derive(Debug, Clone)]
pub(crate) struct StartSystem {
    pub sections: Sections,
    pub solutions: Vec<[Complex64; 8]>,
}

/// The kind of sections that a start system is made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StartKind {
    /// General sections: 40 solutions.
    Generic,
    /// General sections in the ten forms of doubly planar platforms: 40 solutions, mirror images in pairs.
    Planar,
}

impl StartKind {
    /// Number of solutions kept: one of each pair of mirror images.
    #[must_use]
    pub fn count(self) -> usize {
        match self {
            Self::Generic => GENERIC_COUNT,
            Self::Planar => GENERIC_COUNT / 2,
        }
    }

    /// The coefficients of the forms that are not in use made zero, orthogonally.
    fn projected(self, row: &FormRow) -> FormRow {
        match self {
            Self::Generic => *row,
            Self::Planar => {
                let half = |a: Complex64, b: Complex64| 0.5 * (a + b);
                let norm = half(half(row[0], row[9]), half(row[4], row[7]));
                let ten: [Complex64; PLANAR_FORMS] = [
                    norm,
                    half(row[0], -row[9]),
                    half(row[4], -row[7]),
                    row[3],
                    row[5],
                    row[10],
                    row[11],
                    row[13],
                    row[14],
                    row[16],
                ];
                spatial_row(ten)
            }
        }
    }

    /// Whether two points are one solution, or count as one.
    fn same(self, x: &[Complex64; 8], y: &[Complex64; 8]) -> bool {
        let close = |y: &[Complex64; 8]| projective_distance(x, y) < SAME;
        close(y) || (self == Self::Planar && close(&mirror(*y)))
    }
}

/// Solutions closer than this are one.
const SAME: f64 = 1e-6;

fn random_number(rng: &mut Rng) -> Complex64 {
    Complex64::new(rng.normal(), rng.normal())
}

fn random_sections(kind: StartKind, rng: &mut Rng) -> Option<Sections> {
    let mut row = || kind.projected(&std::array::from_fn(|_| random_number(rng)));
    Sections { rows: std::array::from_fn(|_| row()) }.orthonormalised()
}

/// Random orthonormal sections through `x`.
fn sections_through(kind: StartKind, x: &[Complex64; 8], rng: &mut Rng) -> Option<Sections> {
    // `conj(f)` spans the normal of the rows that vanish at x; its projection does within the kind
    let f = kind.projected(&forms(*x).map(|z| z.conj())).map(|z| z.conj());
    let size: f64 = f.iter().map(num_complex::Complex::norm_sqr).sum();
    let rows: [FormRow; 6] = std::array::from_fn(|_| {
        let row = kind.projected(&std::array::from_fn(|_| random_number(rng)));
        let value: Complex64 = row.iter().zip(&f).map(|(c, z)| c * z).sum();
        std::array::from_fn(|k| row[k] - value / size * f[k].conj())
    });
    Sections { rows }.orthonormalised()
}

fn random_point(rng: &mut Rng) -> [Complex64; 8] {
    let mut x: [Complex64; 8] = std::array::from_fn(|_| random_number(rng));
    let rest: Complex64 = (1..4).map(|k| x[k] * x[4 + k]).sum();
    x[4] = -rest / x[0];
    let norm = x.iter().map(num_complex::Complex::norm_sqr).sum::<f64>().sqrt();
    x.map(|z| z / norm)
}

/// Finds a start system with all solutions from a seed; `None` when `loops` triangles do not suffice.
pub(super) fn generate(kind: StartKind, seed: u64, loops: usize) -> Option<StartSystem> {
    let mut rng = Rng::new(seed);
    let first = random_point(&mut rng);
    let sections = sections_through(kind, &first, &mut rng)?;
    let mut solutions = vec![first];
    for _ in 0..loops {
        if solutions.len() >= kind.count() {
            break;
        }
        let corners = [random_sections(kind, &mut rng)?, random_sections(kind, &mut rng)?];
        let way = [(&sections, &corners[0]), (&corners[0], &corners[1]), (&corners[1], &sections)];
        let mut points = solutions.clone();
        for (from, to) in way {
            let phase = Complex64::from_polar(1.0, rng.uniform(0.0, std::f64::consts::TAU));
            let homotopy = SectionHomotopy::new(from, phase, to);
            let tracked = track_all(&homotopy, &points, &CAREFUL, 0.0);
            points = tracked.into_iter().filter(|p| p.arrived).map(|p| p.x).collect();
        }
        for point in points {
            if !solutions.iter().any(|known| kind.same(known, &point)) {
                solutions.push(point);
            }
        }
    }
    to_real_sections(kind, &sections, &solutions, &mut rng)
}

/// Carries the solutions over to random real sections. They are cheaper than complex ones and as good a start, as long
/// as the path from them to the target is complex.
fn to_real_sections(
    kind: StartKind,
    sections: &Sections,
    solutions: &[[Complex64; 8]],
    rng: &mut Rng,
) -> Option<StartSystem> {
    let mut row = || kind.projected(&std::array::from_fn(|_| Complex64::new(rng.normal(), 0.0)));
    let rows = std::array::from_fn(|_| row());
    let real = Sections { rows }.orthonormalised()?;
    let phase = Complex64::from_polar(1.0, rng.uniform(0.0, std::f64::consts::TAU));
    let carry = SectionHomotopy::new(sections, phase, &real);
    let carried = track_all(&carry, solutions, &CAREFUL, 0.0);
    // once more round nothing: polishes every solution to rounding
    let polish = SectionHomotopy::new(&real, Complex64::ONE, &real);
    let points: Vec<[Complex64; 8]> = carried.iter().filter(|p| p.arrived).map(|p| p.x).collect();
    let tracked = track_all(&polish, &points, &CAREFUL, 0.0);
    let complete = tracked.len() == kind.count() && tracked.iter().all(|p| p.arrived);
    complete.then(|| StartSystem { sections: real, solutions: tracked.into_iter().map(|p| p.x).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monodromy_reaches_all_solutions_and_no_more() {
        for (kind, count) in [(StartKind::Generic, 40), (StartKind::Planar, 20)] {
            let start = generate(kind, 2, 60).unwrap();
            for x in &start.solutions {
                for row in &start.sections.rows {
                    let value: Complex64 = row.iter().zip(forms(*x)).map(|(c, z)| c * z).sum();
                    assert!(value.norm() < 1e-13);
                }
            }
            assert_eq!(start.solutions.len(), count);
        }
    }
}
