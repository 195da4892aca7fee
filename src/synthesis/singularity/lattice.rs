//! The generic rank of the Jacobian, decided exactly at finitely many poses.
//!
//! Theorem (proof in `docs/theory/architectural-singularity.md`). With the rotation of the Cayley vector `c`, take a
//! minor of the matrix of leg lines times `(1 + c.c)^3`. It is a polynomial of degree at most 6 in `c` and at most 3 in
//! `p`. It vanishes at all poses if it vanishes at the 84 x 20 poses of a lattice. These have `c` in `{i + j + k <= 6}`
//! and `p` in `{i + j + k <= 3}` (natural numbers; `p` in any unit).
//!
//! Minors are computed modulo primes. Without the common denominator of the coordinates, a minor is an algebraic
//! integer of a field of degree `n`, as are its conjugates. None of them exceeds `B` (Hadamard). Its norm is an integer
//! below `B^n`. A prime divides it if the minor is zero in one of its residue fields. The minor is zero if the product
//! of these primes is `B^n` or more. Doubles are the case `n = 1`.

use nalgebra::{Matrix6, UnitQuaternion, Vector3};

use num::Rng;
use num::modular::PRIME_BITS;
use num::small::singular_values;
use platform::geom::Pose;
use platform::manipulator::{ExactJoints, LegResidues, Manipulator, plucker_matrix};

/// A pose with integer numbers: `R` of the quaternion `(q0, q1, q2, q3)`, `p` in powers of two of the design unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RationalPose {
    /// Quaternion, scalar part first, of any norm.
    pub quaternion: [i64; 4],
    /// Position in units of `2^unit`.
    pub steps: [i64; 3],
    /// Exponent of the unit of position.
    pub unit: i32,
}

impl RationalPose {
    /// The pose in doubles; the position is exact up to 53 bits.
    #[must_use]
    pub fn pose(&self) -> Pose {
        let [w, x, y, z] = self.quaternion.map(|n| n as f64);
        let q = UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w, x, y, z));
        Pose {
            rotation: q.to_rotation_matrix(),
            position: Vector3::from(self.steps).map(|n| n as f64 * self.step()),
        }
    }

    fn step(&self) -> f64 {
        2f64.powi(self.unit)
    }
}

/// The rank of the leg lines at almost all poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GenericRank {
    /// The rank at all poses but a set of measure zero; no pose has a greater one.
    pub rank: usize,
    /// A pose with this rank, which proves that it is not less.
    pub witness: RationalPose,
    /// The proof that it is not greater.
    pub bound: RankBound,
}

/// The proof that the rank is nowhere greater.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RankBound {
    /// The number of legs bounds it.
    Legs,
    /// The lines are linear in the leg vectors, whose rank bounds it.
    LegVectors,
    /// All greater minors vanish at all poses of the lattice, exactly.
    Lattice {
        /// Poses.
        poses: usize,
        /// Primes modulo which the minors were found zero; their product exceeds every minor.
        primes: usize,
    },
}

/// Degree in the Cayley vector and in the position; see the module documentation.
const DEGREES: [i64; 2] = [6, 3];
/// Number of candidates for the witness.
const CANDIDATES: u64 = 96;

/// The generic rank of the lines of some legs of `m`, whose joints are `joints`; `leg_rank` is the exact rank of their
/// leg vectors. `None` for coordinates with too many square roots.
pub(super) fn generic_rank(
    m: &Manipulator,
    joints: &ExactJoints,
    chosen: &[usize],
    leg_rank: usize,
) -> Option<GenericRank> {
    let degree = joints.degree()?;
    let first = joints.residues().next()?;
    let (mut best, mut witness) = (0, RationalPose { quaternion: [1, 0, 0, 0], steps: [0; 3], unit: 0 });
    let unit = unit_of(m);
    for pose in candidates(m, unit, leg_rank).into_iter().chain(lattice(unit)) {
        let r = rank_at_least(&first, chosen, &pose);
        if r > best {
            (best, witness) = (r, pose);
        }
        if best == leg_rank {
            let bound = if best == chosen.len() { RankBound::Legs } else { RankBound::LegVectors };
            return Some(GenericRank { rank: best, witness, bound });
        }
    }
    let primes = primes_needed(joints.bits(), degree, chosen.len(), unit);
    let poses: Vec<RationalPose> = lattice(unit).collect();
    for residues in joints.residues().take(primes) {
        for pose in &poses {
            let r = rank_at_least(&residues, chosen, pose);
            if r > best {
                (best, witness) = (r, *pose);
            }
        }
    }
    Some(GenericRank { rank: best, witness, bound: RankBound::Lattice { poses: poses.len(), primes } })
}

/// Rank of the lines of some legs at `pose` modulo a prime; a lower bound of the true one.
pub(crate) fn rank_at_least(legs: &LegResidues, chosen: &[usize], pose: &RationalPose) -> usize {
    legs.field.rank(rows_at(legs, chosen, pose))
}

/// Poses with small numbers and good conditioning, best first.
pub(crate) fn candidate_poses(m: &Manipulator) -> impl Iterator<Item = RationalPose> {
    candidates(m, unit_of(m), 6).into_iter()
}

/// The exponent of the power of two below the size of the design.
fn unit_of(m: &Manipulator) -> i32 {
    m.size().log2().floor().clamp(-1000.0, 1000.0) as i32
}

/// All natural `(i, j, k)` with a sum of at most `degree`.
fn principal_lattice(degree: i64) -> impl Iterator<Item = [i64; 3]> {
    (0..=degree)
        .flat_map(move |i| (0..=degree - i).flat_map(move |j| (0..=degree - i - j).map(move |k| [i, j, k])))
}

pub(super) fn lattice(unit: i32) -> impl Iterator<Item = RationalPose> {
    principal_lattice(DEGREES[0]).flat_map(move |[x, y, z]| {
        let quaternion = [1, x, y, z];
        principal_lattice(DEGREES[1]).map(move |steps| RationalPose { quaternion, steps, unit })
    })
}

/// Poses with small numbers around the middle of the design. The first are those whose lines are farthest from a rank
/// below `leg_rank`, by singular values; singular values beyond that rank are rounding errors.
fn candidates(m: &Manipulator, unit: i32, leg_rank: usize) -> Vec<RationalPose> {
    let mut rng = Rng::new(0);
    let mut digit = |reach: i64| (rng.next_u64() % (2 * reach.cast_unsigned() + 1)).cast_signed() - reach;
    let [base, platform] = m.mean_leg_ends();
    let step = 2f64.powi(unit);
    let mut list = Vec::new();
    for _ in 0..CANDIDATES {
        let quaternion = [4, digit(4), digit(4), digit(4)];
        let offset: [i64; 3] = std::array::from_fn(|_| digit(2));
        let mut pose = RationalPose { quaternion, steps: offset, unit };
        let middle = (base - pose.pose().rotation * platform) / step;
        for (s, c) in pose.steps.iter_mut().zip(middle.iter()) {
            // frames with a distant origin: skip step counts beyond the range of integers
            if c.abs() < 2f64.powi(50) {
                *s += c.round() as i64;
            }
        }
        let j: Matrix6<f64> = plucker_matrix(m, &pose.pose(), m.platform_rms_radius());
        let quality =
            singular_values(&j).filter(|s| s[0] > 0.0).map_or(0.0, |s| s[leg_rank.clamp(1, 6) - 1] / s[0]);
        list.push((quality, pose));
    }
    list.sort_by(|x, y| y.0.total_cmp(&x.0));
    list.into_iter().map(|(_, pose)| pose).collect()
}

/// Number of primes whose product exceeds the norm of every minor of `legs` legs at every pose of the lattice. The
/// common denominator of the coordinates is taken out.
///
/// Let `X` bound `|a| + |b| + |p|` (scaled, at least 1), and `N = q.q`. A row `(N (p - a) + M b, a x (N p + M b))` is
/// then shorter than `N X (1 + X) <= 2 N X^2`. A minor is less than the product of its rows (Hadamard). The same holds
/// for its conjugates.
fn primes_needed([denominator, magnitude]: [i64; 2], degree: usize, legs: usize, unit: i32) -> usize {
    // lattice positions are shorter than 2^2 units, and multiples of one unit
    let (unit, denominator) = (i64::from(unit), denominator.max(-i64::from(unit)));
    let largest = magnitude.max(unit + 2);
    // three vectors, each at most sqrt 3 times its largest coordinate: below 2^3 times the overall largest coordinate
    let sum = (largest + denominator + 3).max(0).cast_unsigned();
    // N <= 1 + 6^2 < 2^6
    let row = 6 + 1 + 2 * sum;
    (legs as u64 * row * degree as u64).div_ceil(u64::from(PRIME_BITS)) as usize
}

/// The rows `(N (p - a) + M b, a x (N p + M b))` modulo a prime, `R = M / N`: the line of a leg times `N`.
fn rows_at(legs: &LegResidues, chosen: &[usize], pose: &RationalPose) -> Vec<[u64; 6]> {
    let field = legs.field;
    let (add, sub, mul) = (|x, y| field.add(x, y), |x, y| field.sub(x, y), |x, y| field.mul(x, y));
    let [w, x, y, z] = pose.quaternion;
    let n = field.integer(w * w + x * x + y * y + z * z);
    let m = [
        [w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z],
    ]
    .map(|row| row.map(|v| field.integer(v)));
    let unit = field.scaled(1.0, pose.unit);
    let p = pose.steps.map(|s| mul(mul(field.integer(s), unit), n));
    let rows = chosen.iter().map(|leg| &legs.ends[*leg]).map(|[a, b]| {
        let end: [u64; 3] = std::array::from_fn(|i| {
            let turned = add(add(mul(m[i][0], b[0]), mul(m[i][1], b[1])), mul(m[i][2], b[2]));
            add(p[i], turned)
        });
        let cross = |i: usize, j: usize| sub(mul(a[i], end[j]), mul(a[j], end[i]));
        let along = |i: usize| sub(end[i], mul(n, a[i]));
        [along(0), along(1), along(2), cross(1, 2), cross(2, 0), cross(0, 1)]
    });
    rows.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use num::modular::{Field, fields};
    use platform::manipulator::Leg;

    /// The rank of the lines of some legs of a design in doubles.
    fn generic(m: &Manipulator, chosen: &[usize], leg_rank: usize) -> GenericRank {
        generic_rank(m, &ExactJoints::of(m).unwrap(), chosen, leg_rank).unwrap()
    }

    const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

    fn random(rng: &mut Rng) -> Manipulator {
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() })).unwrap()
    }

    /// Every monomial of degree at most `degree` at every point of the principal lattice, modulo a prime.
    fn evaluation<const N: usize>(degree: i64) -> Vec<[u64; N]> {
        let field = fields(1)[0];
        let points: Vec<_> = principal_lattice(degree).collect();
        let power = |x: i64, n: i64| (0..n).fold(1, |y, _| field.mul(y, field.integer(x)));
        points
            .iter()
            .map(|p| std::array::from_fn(|k| (0..3).fold(1, |y, i| field.mul(y, power(p[i], points[k][i])))))
            .collect()
    }

    #[test]
    fn a_polynomial_that_vanishes_on_the_principal_lattice_is_zero() {
        let field = fields(1)[0];
        assert_eq!(field.rank(evaluation::<84>(6)), 84);
        assert_eq!(field.rank(evaluation::<20>(3)), 20);
        assert_eq!(lattice(0).count(), 84 * 20);
    }

    /// `(1 + c.c)^3 det J` modulo a prime: the determinant of the rows `N J` over `N^3`.
    fn polynomial(field: Field, m: &Manipulator, c: [i64; 3], p: [i64; 3]) -> u64 {
        let pose = RationalPose { quaternion: [1, c[0], c[1], c[2]], steps: p, unit: 0 };
        let n = field.integer(1 + c.iter().map(|x| x * x).sum::<i64>());
        let point = |p: Point3<f64>| [p.x, p.y, p.z].map(|x| field.scaled(x, 0));
        let legs = LegResidues { field, ends: m.legs().map(|l| [point(l.base), point(l.platform)]) };
        let det = field.determinant(&rows_at(&legs, &ALL, &pose));
        (0..3).fold(det, |d, _| field.mul(d, field.inverse(n)))
    }

    /// The difference of order `k` of `f` on `0..=k`.
    fn difference(field: Field, k: i64, f: impl Fn(i64) -> u64) -> u64 {
        let mut values: Vec<u64> = (0..=k).map(f).collect();
        while values.len() > 1 {
            values = values.windows(2).map(|w| field.sub(w[1], w[0])).collect();
        }
        values[0]
    }

    #[test]
    fn the_determinant_has_the_degrees_of_the_theorem_and_they_are_reached() {
        let field = fields(1)[0];
        let mut rng = Rng::new(12);
        for _ in 0..5 {
            let m = random(&mut rng);
            let mut digits = || [(); 3].map(|()| (rng.next_u64() % 19).cast_signed() - 9);
            let (c, d, p, q) = (digits(), digits(), digits(), digits());
            let on = |x: [i64; 3], y: [i64; 3], s: i64| [0, 1, 2].map(|i| x[i] + s * y[i]);
            let in_c = |k| difference(field, k, |s| polynomial(field, &m, on(c, d, s), p));
            let in_p = |k| difference(field, k, |s| polynomial(field, &m, c, on(p, q, s)));
            assert!(in_c(7) == 0 && in_c(6) != 0);
            assert!(in_p(4) == 0 && in_p(3) != 0);
        }
    }

    /// Rank of the determinants of as many random designs (flat bodies on request) at as many poses.
    fn dimension_of_the_determinants<const N: usize>(flat: bool) -> usize {
        let (field, mut rng) = (fields(1)[0], Rng::new(4));
        let designs: Vec<LegResidues> = (0..N)
            .map(|_| {
                let mut leg = || {
                    [(); 2].map(|()| [0, 1, 2].map(|i| if flat && i == 2 { 0 } else { rng.next_u64() >> 4 }))
                };
                LegResidues { field, ends: std::array::from_fn(|_| leg()) }
            })
            .collect();
        let mut digit = || (rng.next_u64() >> 50).cast_signed();
        let poses: Vec<RationalPose> = (0..N)
            .map(|_| RationalPose {
                quaternion: [(); 4].map(|()| digit()),
                steps: [(); 3].map(|()| digit()),
                unit: 0,
            })
            .collect();
        let rows: Vec<[u64; N]> = poses
            .iter()
            .map(|pose| std::array::from_fn(|k| field.determinant(&rows_at(&designs[k], &ALL, pose))))
            .collect();
        field.rank(rows)
    }

    #[test]
    #[ignore = "evidence"]
    fn the_determinants_of_all_planar_designs_span_55_dimensions() {
        assert_eq!(dimension_of_the_determinants::<80>(true), 55);
    }

    #[test]
    fn the_bound_of_the_minors_holds_with_room() {
        let mut rng = Rng::new(2);
        let m = random(&mut rng);
        let bits = ExactJoints::of(&m).unwrap().bits();
        let primes = primes_needed(bits, 1, 6, unit_of(&m));
        // log2 of the largest determinant of the integer rows, by doubles
        let scale = 2f64.powi(i32::try_from(bits[0]).unwrap());
        let largest = lattice(unit_of(&m)).map(|pose| {
            let n = pose.quaternion.iter().map(|x| (x * x) as f64).sum::<f64>();
            let j = plucker_matrix(&m, &pose.pose(), 1.0);
            let rows = j.row_iter().map(|r| (r.norm() * n).log2()).sum::<f64>();
            // three columns have one factor of the scale, three have two
            rows + 12.0 * scale.log2()
        });
        let largest = largest.fold(0.0, f64::max);
        let bits = primes as f64 * f64::from(PRIME_BITS);
        assert!(largest < bits && bits < 2.0 * largest, "{largest} {bits}");
    }

    #[test]
    fn a_leg_moved_by_the_last_bit_makes_a_coincident_pair_regular() {
        let mut rng = Rng::new(6);
        let mut legs = random(&mut rng).legs();
        legs[4] = legs[1];
        legs[4].base.z = f64::from_bits(legs[1].base.z.to_bits() + 1);
        let m = Manipulator::from_legs(legs).unwrap();
        let found = generic(&m, &[0, 1, 2, 3, 4, 5], 6);
        assert_eq!((found.rank, found.bound), (6, RankBound::Legs));
    }

    #[test]
    fn four_legs_at_a_point_have_rank_three_by_the_lattice() {
        let mut rng = Rng::new(7);
        let mut legs = random(&mut rng).legs();
        for i in 1..4 {
            legs[i].base = legs[0].base;
        }
        let m = Manipulator::from_legs(legs).unwrap();
        let found = generic(&m, &[0, 1, 2, 3], 4);
        assert_eq!(found.rank, 3);
        assert!(matches!(found.bound, RankBound::Lattice { poses: 1680, primes: 2.. }), "{:?}", found.bound);
        assert_eq!(generic(&m, &[0, 1, 2, 3, 4, 5], 6).rank, 5);
    }
}
