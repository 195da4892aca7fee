//! Six legs from a model of a machine, with both ends in one frame and rounded coordinates.

use nalgebra::{Matrix3, Point3, Rotation3};

use super::points::PointTable;
use platform::geom::Pose;
use platform::manipulator::Leg;

/// A length unit for a design read from a file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct FileUnit {
    /// Its label.
    pub(super) label: &'static str,
    /// Its length in the unit of the file.
    pub(super) per: f64,
}

/// The number between `before` and `after` in a line of this program's exports, such as
/// `Lengths in mm; one unit of the design is 25.4 mm`.
pub(super) fn number_between(line: &str, before: &str, after: &str) -> Option<f64> {
    let number = line.trim().strip_prefix(before)?.strip_suffix(after)?;
    number.parse().ok().filter(|x: &f64| x.is_finite() && *x > 0.0)
}

/// The number at the end of a name.
pub(super) fn trailing_number(name: &str) -> Option<u64> {
    let head = name.trim_end_matches(|c: char| c.is_ascii_digit());
    name[head.len()..].parse().ok()
}

/// The order by these numbers, if all are present and different.
pub(super) fn order_of(numbers: &[Option<u64>]) -> Option<Vec<usize>> {
    let numbers: Vec<u64> = numbers.iter().copied().collect::<Option<_>>()?;
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by_key(|k| numbers[*k]);
    order.windows(2).all(|pair| numbers[pair[0]] < numbers[pair[1]]).then_some(order)
}

/// Legs at home.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PlacedLegs {
    /// Base end and platform end of each leg, base frame, unit of the file.
    pub(super) ends: [[Point3<f64>; 2]; 6],
    /// The platform frame, base frame, unit of the file.
    pub(super) home: Pose,
    /// Ends of a body within this distance, over the size, are one joint.
    pub(super) tolerance: f64,
}

/// A rotation matrix within this of the identity counts as the identity: quaternions of a model have sixteen digits.
const NO_TURN: f64 = 1e-12;
/// Precision of kept coordinates, over the size; products of frames lose smaller parts.
const KEPT: f64 = 1e-13;

/// The greatest distance between the first of these points and another.
pub(super) fn extent<'a>(points: impl IntoIterator<Item = &'a Point3<f64>>) -> f64 {
    let mut points = points.into_iter();
    let Some(first) = points.next() else { return 0.0 };
    points.map(|p| (p - first).norm()).fold(0.0, f64::max)
}

/// Rounds to a power of ten between one and ten times [`KEPT`] of a size.
struct Decimals(Option<usize>);

impl Decimals {
    fn of(size: f64) -> Self {
        // less than whole numbers remain: nothing is rounded
        if KEPT * size > 1.0 {
            return Self(None);
        }
        // decimals: the smallest number whose unit is below ten times the kept precision
        Self(
            (0..300)
                .find(|digits| 10.0_f64.powi(-digits) < 10.0 * KEPT * size)
                .and_then(|d| d.try_into().ok()),
        )
    }

    fn round(&self, x: f64) -> f64 {
        let Some(digits) = self.0 else { return x };
        // conversion by the decimal gives the double of the shortest decimal; adding zero removes the sign of zero
        format!("{x:.digits$}").parse().map_or(x, |rounded: f64| rounded + 0.0)
    }

    fn point(&self, p: &Point3<f64>) -> Point3<f64> {
        p.map(|x| self.round(x))
    }
}

impl PlacedLegs {
    /// The table in another unit; `None` if a coordinate is not finite.
    pub(super) fn table(&self, unit: &FileUnit, mut guesses: Vec<String>) -> Option<PointTable> {
        let mut ends = self.ends.map(|leg| leg.map(|p| p / unit.per));
        let mut home = Pose { position: self.home.position / unit.per, ..self.home };
        let finite = ends.iter().flatten().all(|p| p.iter().all(|x| x.is_finite()))
            && home.position.iter().all(|x| x.is_finite())
            && home.rotation.matrix().iter().all(|x| x.is_finite());
        if !finite {
            return None;
        }
        let size = extent(ends.iter().flatten());
        let mut joined = false;
        for body in 0..2 {
            for i in 1..6 {
                let near = |j: &usize| (ends[i][body] - ends[*j][body]).norm() <= self.tolerance * size;
                if let Some(j) = (0..i).find(near) {
                    joined |= ends[i][body] != ends[j][body];
                    ends[i][body] = ends[j][body];
                }
            }
        }
        if joined {
            let near = self.tolerance;
            guesses.push(format!(
                "Ends of legs on the same body that differ by less than {near:e} of the size are one point."
            ));
        }
        if (home.rotation.matrix() - Matrix3::identity()).amax() < NO_TURN {
            home.rotation = Rotation3::identity();
        }
        let decimals = Decimals::of(size);
        let back = home.rotation.inverse();
        let legs = ends.map(|[base, platform]| Leg {
            base: decimals.point(&base),
            platform: decimals.point(&Point3::from(back * (platform.coords - home.position))),
        });
        home.position = home.position.map(|x| decimals.round(x));
        Some(PointTable { legs, names: None, units: Some(unit.label.into()), home: Some(home), guesses })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coordinates_lose_the_last_digits_and_no_more() {
        let decimals = Decimals::of(600.0);
        let next = f64::from_bits(293.444_f64.to_bits() + 1);
        assert!(next.to_string() != "293.444");
        assert_eq!(decimals.round(next).to_string(), "293.444");
        assert_eq!(decimals.round(-62.374 - 1e-14).to_string(), "-62.374");
        assert_eq!(decimals.round(-3e-14).to_bits(), 0.0_f64.to_bits());
        assert_eq!(Decimals::of(1e20).round(1.25).to_bits(), 1.25_f64.to_bits());
        assert_eq!(Decimals::of(0.0).round(1.25).to_bits(), 1.25_f64.to_bits());
    }

    #[test]
    fn names_are_ordered_by_their_numbers_where_all_have_one() {
        assert_eq!(order_of(&["leg10", "leg2", "leg1"].map(trailing_number)), Some(vec![2, 1, 0]));
        assert_eq!(order_of(&["leg1", "leg"].map(trailing_number)), None);
        assert_eq!(order_of(&["a1", "b1"].map(trailing_number)), None);
        assert_eq!(trailing_number("99999999999999999999999"), None);
    }
}
