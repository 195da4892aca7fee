//! The correspondence between the legs of two designs.

use platform::manipulator::{LegIndex, Manipulator};

/// Legs closer than this, relative to the size, are the same leg.
const SAME: f64 = 1e-9;
/// Legs closer than this, relative to the size, count as nearly the same.
const NEARLY: f64 = 1e-3;

/// For each leg of TO the leg of FROM between the same joints, exactly or nearly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegCorrespondence {
    /// The nearest leg of FROM, if it is within a thousandth of the size.
    pub legs: [Option<LegIndex>; 6],
    /// The larger distance of the two joints of the nearest leg of FROM, relative to the size of FROM.
    pub distances: [f64; 6],
}

impl LegCorrespondence {
    /// Compares two designs in the same frames and units.
    #[must_use]
    pub fn between(from: &Manipulator, to: &Manipulator) -> Self {
        let old = from.legs();
        let nearest = to.legs().map(|leg| {
            let apart = |i: LegIndex| {
                let near = &old[i.get()];
                (near.base - leg.base).norm().max((near.platform - leg.platform).norm()) / from.size()
            };
            let all = LegIndex::all().map(|i| (i, apart(i)));
            all.fold((None, f64::INFINITY), |best, (i, d)| if d < best.1 { (Some(i), d) } else { best })
        });
        let legs = nearest.map(|(leg, distance)| leg.filter(|_| distance <= NEARLY));
        Self { legs, distances: nearest.map(|n| n.1) }
    }

    /// Whether every leg of TO is (nearly) a leg of FROM, and no two are the same one.
    #[must_use]
    pub fn is_permutation(&self) -> bool {
        let mut seen = [false; 6];
        self.legs.iter().all(|leg| leg.is_some_and(|i| !std::mem::replace(&mut seen[i.get()], true)))
    }

    /// Whether every matched leg is the same up to rounding.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.legs.iter().zip(self.distances).all(|(leg, d)| leg.is_none() || d <= SAME)
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::Point3;

    use super::*;
    use num::Rng;
    use platform::manipulator::Leg;

    #[test]
    fn an_order_is_found_and_a_moved_joint_is_told() {
        let mut rng = Rng::new(2);
        let mut point = || Point3::new(rng.normal(), rng.normal(), rng.normal());
        let a = Manipulator::from_legs(std::array::from_fn(|_| Leg { base: point(), platform: point() }))
            .unwrap();
        let order = [3, 1, 0, 5, 4, 2];
        let b = a.reordered(order).unwrap();
        let c = LegCorrespondence::between(&a, &b);
        assert_eq!(c.legs.map(|l| l.unwrap().get()), order);
        assert!(c.is_permutation() && c.is_exact());
        let mut legs = b.legs();
        legs[1].base.x += 1e-6 * a.size();
        legs[2].base.x += a.size();
        let c = LegCorrespondence::between(&a, &Manipulator::from_legs(legs).unwrap());
        assert!(!c.is_permutation() && !c.is_exact() && c.legs[2].is_none());
        assert!((c.distances[1] - 1e-6).abs() < 1e-12);
        legs[2] = legs[3];
        legs[2].base.x += 1e-6;
        assert!(!LegCorrespondence::between(&a, &Manipulator::from_legs(legs).unwrap()).is_permutation());
    }
}
