//! Start solutions from nothing: one solution is easy to make, monodromy finds the others.
//!
//! Six random sections through a random point of the Study quadric have that point as a solution. Moving the
//! sections round triangles with random corners permutes the solutions of the same system; the known ones
//! are sent round until their number reaches the degree 40 of the compactified group (Duff et al. 2019).

use num_complex::Complex64;

use super::dispatch::track_all;
use super::endgame::projective_distance;
use super::system::SectionHomotopy;
use super::tracker::TrackerSettings;
use crate::num::Rng;
use crate::solve::sections::{FORMS, Row, Sections, forms};

/// Number of solutions of six general sections: the degree of the compactification.
pub const GENERIC_COUNT: usize = 40;

/// A start system with its solutions.
#[derive(Debug, Clone)]
pub(crate) struct StartSystem {
    pub(crate) sections: Sections,
    pub(crate) solutions: Vec<[Complex64; 8]>,
}

fn random_number(rng: &mut Rng) -> Complex64 {
    Complex64::new(rng.normal(), rng.normal())
}

fn random_sections(rng: &mut Rng) -> Option<Sections> {
    Sections { rows: std::array::from_fn(|_| std::array::from_fn(|_| random_number(rng))) }.orthonormalised()
}

/// Random orthonormal sections through `x`.
fn sections_through(x: &[Complex64; 8], rng: &mut Rng) -> Option<Sections> {
    let f = forms(*x);
    let size: f64 = f.iter().map(num_complex::Complex::norm_sqr).sum();
    let rows: [Row; 6] = std::array::from_fn(|_| {
        let row: Row = std::array::from_fn(|_| random_number(rng));
        let value: Complex64 = row.iter().zip(&f).map(|(c, z)| c * z).sum();
        std::array::from_fn::<_, FORMS, _>(|k| row[k] - value / size * f[k].conj())
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

/// Finds a start system with all [`GENERIC_COUNT`] solutions from a seed; `None` when `loops` triangles do
/// not suffice.
pub(crate) fn generate(seed: u64, loops: usize) -> Option<StartSystem> {
    let mut rng = Rng::new(seed);
    let first = random_point(&mut rng);
    let sections = sections_through(&first, &mut rng)?;
    let mut solutions = vec![first];
    for _ in 0..loops {
        if solutions.len() >= GENERIC_COUNT {
            break;
        }
        let corners = [random_sections(&mut rng)?, random_sections(&mut rng)?];
        let way = [(&sections, &corners[0]), (&corners[0], &corners[1]), (&corners[1], &sections)];
        let mut points = solutions.clone();
        for (from, to) in way {
            let phase = Complex64::from_polar(1.0, rng.uniform(0.0, std::f64::consts::TAU));
            let homotopy = SectionHomotopy::new(from, phase, to);
            let tracked = track_all(&homotopy, &points, &TrackerSettings::CAREFUL, 0.0);
            points = tracked.into_iter().filter(|p| p.arrived).map(|p| p.x).collect();
        }
        for point in points {
            if solutions.iter().all(|known| projective_distance(known, &point) > 1e-6) {
                solutions.push(point);
            }
        }
    }
    to_real_sections(&sections, &solutions, &mut rng)
}

/// Carries the solutions over to random real sections: general real sections are as good a start as
/// complex ones, as long as the path from them to the target is complex, and cheaper.
fn to_real_sections(sections: &Sections, solutions: &[[Complex64; 8]], rng: &mut Rng) -> Option<StartSystem> {
    let rows = std::array::from_fn(|_| std::array::from_fn(|_| Complex64::new(rng.normal(), 0.0)));
    let real = Sections { rows }.orthonormalised()?;
    let phase = Complex64::from_polar(1.0, rng.uniform(0.0, std::f64::consts::TAU));
    let carry = SectionHomotopy::new(sections, phase, &real);
    let carried = track_all(&carry, solutions, &TrackerSettings::CAREFUL, 0.0);
    // once more round nothing: polishes every solution to rounding
    let polish = SectionHomotopy::new(&real, Complex64::ONE, &real);
    let points: Vec<[Complex64; 8]> = carried.iter().filter(|p| p.arrived).map(|p| p.x).collect();
    let tracked = track_all(&polish, &points, &TrackerSettings::CAREFUL, 0.0);
    let complete = tracked.len() == GENERIC_COUNT && tracked.iter().all(|p| p.arrived);
    complete.then(|| StartSystem { sections: real, solutions: tracked.into_iter().map(|p| p.x).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn monodromy_reaches_forty_solutions_and_no_more() {
        let start = generate(2, 60).unwrap();
        for x in &start.solutions {
            for row in &start.sections.rows {
                let value: Complex64 = row.iter().zip(forms(*x)).map(|(c, z)| c * z).sum();
                assert!(value.norm() < 1e-13);
            }
        }
        assert_eq!(start.solutions.len(), 40);
    }
}
