//! Linear dependence of the six leg vectors, decided exactly where that is possible.
//!
//! The leg `(a, b)` is the vector `v = (1, a) (x) (1, b)` of `R^16`. Its equation is
//! `<v, W(pose)> + |a|^2 + |b|^2 - s = 0` (multiplied by `e.e`). A relation `sum c_i v_i = 0` leaves
//! `e.e sum c_i (|a_i|^2 + |b_i|^2 - s_i) = 0`. Either the lengths satisfy the relation as well, and one equation is
//! redundant, or `e.e = 0` and there is no finite pose.
//!
//! Joints that are their doubles are decided over the rationals, exact ones in their field of square roots. For joints
//! known only between bounds one statement is possible: they are far from any relation.

use num::elimination::{SurdArithmetic, eliminate_first};
use num::exact::{ExactVector, Rational, rational, relations};
use num::surd::{Surd, combination};
use platform::manipulator::{
    Body, ExactLeg, JointKnowledge, Manipulator, SquaredLegLengths, squares_of_ends, vector_of_ends,
};

/// Below this (sine of the angle to the span of the others) exact arithmetic is asked.
const SUSPECT: f64 = 1e-9;
/// Lengths count as compatible within this times `s + |a|^2 + |b|^2` for each leg: rounding of a length, its
/// square and the pose it was computed from.
const ROUNDING: f64 = 1.0 / (1u64 << 49) as f64;

/// The known dependence of the six leg vectors and its agreement with the lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LegDependence {
    /// Independent, far from any relation.
    Independent,
    /// A relation holds nearly; not exactly, or that is not known.
    Nearly,
    /// Proved: a relation of the basis holds exactly and the lengths contradict it by more than rounding.
    Incompatible,
    /// Proved: this many relations hold exactly. The lengths satisfy each of a basis of them within rounding. It is
    /// not asked whether some lengths that near satisfy all at once.
    Compatible {
        /// Six less the rank.
        relations: usize,
    },
}

/// Decides the dependence of the legs of `m` with squared lengths `s`.
pub fn dependence(m: &Manipulator, s: &SquaredLegLengths) -> LegDependence {
    let radius = (0..6).flat_map(|i| Body::BOTH.map(|body| m.end_radius(i, body))).fold(0.0, f64::max);
    // a vector of scaled coordinates changes by less than sixteen times their radius
    if least_sine(m) > SUSPECT + 32.0 * radius / m.size() {
        return LegDependence::Independent;
    }
    match m.joint_knowledge() {
        JointKnowledge::Doubles => dependence_of_doubles(m, s),
        JointKnowledge::Exact => dependence_of_exact(m, s).unwrap_or(LegDependence::Nearly),
        JointKnowledge::Enclosed => LegDependence::Nearly,
    }
}

fn dependence_of_doubles(m: &Manipulator, s: &SquaredLegLengths) -> LegDependence {
    let Some(rows) = exact_rows(m, s) else { return LegDependence::Nearly };
    let vectors: Vec<ExactVector> = rows.iter().map(|r| r.vector.clone()).collect();
    let found = relations(&vectors);
    if found.is_empty() {
        return LegDependence::Nearly;
    }
    let zero = Rational::from_integer(0.into());
    let modulus = |x: &Rational| if *x < zero { -x } else { x.clone() };
    let contradicted = found.iter().any(|c| {
        let defect: Rational = c.iter().zip(&rows).map(|(c, r)| c * &r.constant).sum();
        let slack: Rational = c.iter().zip(&rows).map(|(c, r)| modulus(c) * &r.slack).sum();
        modulus(&defect) > slack
    });
    if contradicted {
        LegDependence::Incompatible
    } else {
        LegDependence::Compatible { relations: found.len() }
    }
}

/// Decides the dependence for exact joints; `None` when numbers become too long.
fn dependence_of_exact(m: &Manipulator, s: &SquaredLegLengths) -> Option<LegDependence> {
    let ends = m.exact_ends()?;
    let rounding = rational(ROUNDING)?;
    let number = |x: &Rational| Surd::rational(x);
    let (mut rows, mut constants, mut slacks) = (Vec::new(), Vec::new(), Vec::new());
    for (i, leg) in ends.iter().enumerate() {
        let mut row = vector_of_ends(leg)?;
        row.extend((0..6).map(|k| Surd::integer(i64::from(k == i))));
        rows.push(row);
        let (squares, length) = (squares_of_ends(leg)?, number(&rational(s.get()[i])?)?);
        constants.push(squares.minus(&length)?);
        let slack = squares.plus(&length)?.times(&number(&rounding)?)?;
        slacks.push(slack.plus(&number(&rational(s.radius()[i])?)?)?);
    }
    let rank = eliminate_first(&SurdArithmetic, &mut rows, 16)?.len();
    if rank == 6 {
        return Some(LegDependence::Nearly);
    }
    let modulus = |x: &Surd| if x.sign().is_lt() { x.negated() } else { x.clone() };
    for row in &rows[rank..] {
        let c = &row[16..];
        let defect = modulus(&combination(c, &constants)?);
        let slack = combination(&c.iter().map(modulus).collect::<Vec<_>>(), &slacks)?;
        if defect.minus(&slack)?.sign().is_gt() {
            return Some(LegDependence::Incompatible);
        }
    }
    Some(LegDependence::Compatible { relations: 6 - rank })
}

struct ExactRow {
    vector: ExactVector,
    /// `|a|^2 + |b|^2 - s`.
    constant: Rational,
    slack: Rational,
}

fn exact_rows(m: &Manipulator, s: &SquaredLegLengths) -> Option<Vec<ExactRow>> {
    let rounding = rational(ROUNDING)?;
    let mut rows = Vec::new();
    for ((leg, square), radius) in m.legs().iter().zip(s.get()).zip(s.radius()) {
        let (leg, square) = (ExactLeg::of(leg)?, rational(square)?);
        let squares = leg.squares();
        rows.push(ExactRow {
            vector: leg.vector(),
            constant: &squares - &square,
            slack: (squares + square) * &rounding + rational(radius)?,
        });
    }
    Some(rows)
}

/// Smallest sine of the angle of a leg vector to the span of the earlier ones, frames at the centroids and
/// scaled to the size.
fn least_sine(m: &Manipulator) -> f64 {
    let [base, platform] = m.mean_leg_ends();
    let size = m.size();
    let mut rows: [nalgebra::SVector<f64, 16>; 6] = m.legs().map(|l| {
        let (a, b) = ((l.base.coords - base) / size, (l.platform.coords - platform) / size);
        let (a, b) = ([1.0, a.x, a.y, a.z], [1.0, b.x, b.y, b.z]);
        nalgebra::SVector::from_fn(|k, _| a[k / 4] * b[k % 4])
    });
    let mut least = f64::INFINITY;
    for i in 0..6 {
        let before = rows[i].norm();
        for _ in 0..2 {
            for j in 0..i {
                let parallel = rows[j] * rows[j].dot(&rows[i]);
                rows[i] -= parallel;
            }
        }
        let after = rows[i].norm();
        // NaN is passed on as suspect
        if !(after > SUSPECT * before) {
            return 0.0;
        }
        least = least.min(after / before);
        rows[i] /= after;
    }
    least
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Point3, Rotation3, Vector3};
    use num::Rng;
    use platform::geom::{Pose, random_rotation};
    use platform::manipulator::Leg;

    /// Midpoints of the edges of two triangles (Rojas, Borras, Thomas 2010, sec. 6); all halves are exact.
    fn midline() -> Manipulator {
        let (a, h, k) = (10.392_304_845_413_264, 5.196_152_422_706_632, 2.598_076_211_353_316);
        let base = [[3.0, h], [6.0, a], [9.0, h], [12.0, 0.0], [6.0, 0.0], [0.0, 0.0]];
        let platform = [[0.0, 0.0], [3.0, 0.0], [6.0, 0.0], [4.5, -k], [3.0, -h], [1.5, -k]];
        let point = |p: [f64; 2]| Point3::new(p[0], p[1], 0.0);
        Manipulator::from_legs(std::array::from_fn(|i| Leg {
            base: point(base[i]),
            platform: point(platform[i]),
        }))
        .unwrap()
    }

    #[test]
    fn lengths_of_poses_are_compatible_and_others_are_not() {
        let m = midline();
        let mut rng = Rng::new(4);
        for _ in 0..20 {
            let position = Vector3::from_fn(|_, _| rng.uniform(-9.0, 9.0));
            let pose = Pose { rotation: random_rotation(&mut rng), position };
            let s = pose.squared_lengths(&m).unwrap();
            assert_eq!(dependence(&m, &s), LegDependence::Compatible { relations: 1 });
            let mut longer = s.get();
            longer[2] *= 1.0 + 1e-12;
            let longer = SquaredLegLengths::try_new(longer).unwrap();
            assert_eq!(dependence(&m, &longer), LegDependence::Incompatible);
        }
    }

    #[test]
    fn a_turned_frame_makes_the_relation_approximate() {
        let turn = Rotation3::from_euler_angles(0.3, 0.2, 0.1);
        let legs = midline().legs().map(|l| Leg { base: turn * l.base, platform: l.platform });
        let m = Manipulator::from_legs(legs).unwrap();
        let s = SquaredLegLengths::try_new([200.0; 6]).unwrap();
        assert_eq!(dependence(&m, &s), LegDependence::Nearly);
        let mut moved = midline().legs();
        moved[0].base.x += 1e-3;
        let m = Manipulator::from_legs(moved).unwrap();
        assert_eq!(dependence(&m, &s), LegDependence::Independent);
    }
}
