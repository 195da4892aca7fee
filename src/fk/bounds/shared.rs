//! Proved upper bounds on the number of isolated finite poses of platforms with shared joints.
//!
//! A bound proved for generic platforms of a topology holds for every platform of it and of its mergers. Coincidence of
//! joints is decided exactly, on the doubles as they are.

use crate::Theorem;
use platform::manipulator::{Body, JointKnowledge, Manipulator};
use platform::topology::Topology;

/// A topology with a count of its own, base and platform joint of every leg.
type Row = ([usize; 6], [usize; 6], Theorem);

const fn row(poses: usize, base: [usize; 6], platform: [usize; 6], construction: &'static str) -> Row {
    (base, platform, Theorem::SharedJoints { poses, construction })
}

const ALL: [usize; 6] = [0, 1, 2, 3, 4, 5];

/// The topologies whose generic count is proved in the documentation, smallest counts first. Every other count
/// follows: merging joints never adds isolated poses.
const PROVED: [Row; 10] = [
    row(
        8,
        [0, 0, 0, 1, 1, 2],
        ALL,
        "joints of one body carry three, two and one legs: three trilaterations, two places each",
    ),
    row(
        8,
        [0, 0, 0, 1, 2, 3],
        [0, 1, 2, 3, 3, 4],
        "three legs meet in a joint, two others in a joint of the other body: three trilaterations, two places each",
    ),
    row(
        8,
        [0, 0, 1, 1, 2, 2],
        [0, 1, 0, 1, 2, 3],
        "four legs join two joints of each body and the others share a joint: two tetrahedra, two conics in two distances",
    ),
    row(
        16,
        [0, 0, 0, 1, 2, 3],
        ALL,
        "three legs meet in a joint, which has two places, with three quadrics in the quaternion for each",
    ),
    row(
        16,
        [0, 0, 1, 1, 2, 2],
        ALL,
        "three joints of one body carry two legs each: three circles and three distances of bidegree (2, 2)",
    ),
    row(
        16,
        [0, 0, 1, 1, 2, 3],
        [0, 1, 2, 3, 4, 4],
        "two joints carry two legs each and the last two legs share a joint of the other body: three circles and three \
         equations of bidegree (2, 2)",
    ),
    row(
        16,
        [0, 0, 1, 1, 2, 3],
        [0, 1, 0, 1, 2, 3],
        "four legs join two joints of each body: two tetrahedra, two equations of bidegree (2, 2) in two angles for each",
    ),
    row(
        16,
        [0, 0, 1, 1, 2, 3],
        [0, 1, 2, 3, 0, 2],
        "two joints of each body carry two legs each, in pairs that have one leg in common: four circles in a ring of \
         equations of bidegree (2, 2), shared with the mirror image",
    ),
    row(
        24,
        [0, 0, 1, 2, 3, 4],
        [0, 1, 2, 2, 3, 4],
        "two legs share a joint of the base and two others one of the platform: degree of the closure condition of two legs \
         on a curve of bidegree (2, 2)",
    ),
    row(
        32,
        [0, 0, 1, 1, 2, 3],
        ALL,
        "two joints of one body carry two legs each: degree of the closure condition of the other two legs on a curve of \
         bidegree (2, 2)",
    ),
];

/// The smallest bound below 40 that shared joints give, if any.
pub(crate) fn class_bound(m: &Manipulator) -> Option<Theorem> {
    let bodies = match m.joint_knowledge() {
        JointKnowledge::Doubles => Body::BOTH.map(|body| places(m.legs().map(|l| l.end(body).into()))),
        JointKnowledge::Exact => {
            let ends = m.exact_ends()?;
            Body::BOTH.map(|body| first_of(&ends.each_ref().map(|leg| &leg[body.index()])))
        }
        // two joints within the same bounds need not be one
        JointKnowledge::Enclosed => Body::BOTH.map(|body| first_of(&m.pairs().map(|pair| body.of(pair)))),
    };
    let [base, platform] = bodies;
    bound_of(Topology::unordered(base, platform))
}

/// The bound of a topology.
fn bound_of(t: Topology) -> Option<Theorem> {
    let found = PROVED.iter().find(|(base, platform, _)| {
        // exchanging the rows' bodies is exchanging the platform's
        t.is_merger_of(Topology::unordered(*base, *platform))
            || t.is_merger_of(Topology::unordered(*platform, *base))
    });
    found.map(|row| row.2)
}

/// For each leg the first one with exactly the same end.
fn places(ends: [[f64; 3]; 6]) -> [usize; 6] {
    // adding zero makes -0 and 0 one number
    let bits = ends.map(|p: [f64; 3]| p.map(|x| (x + 0.0).to_bits()));
    first_of(&bits)
}

/// For each leg the first one with the same end.
fn first_of<T: PartialEq>(ends: &[T; 6]) -> [usize; 6] {
    std::array::from_fn(|i| ends.iter().position(|q| *q == ends[i]).unwrap_or(i))
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::Leg;
    use platform::topology::catalogue;

    fn joint(k: usize) -> Point3<f64> {
        let t = k as f64;
        Point3::new((1.3 * t).cos() + 0.1 * t, (1.7 * t).sin(), (0.9 * t).cos())
    }

    fn platform(base: [usize; 6], feet: [usize; 6]) -> [Leg; 6] {
        std::array::from_fn(|i| Leg { base: joint(base[i]), platform: joint(feet[i] + 7) })
    }

    fn count(legs: &[Leg; 6]) -> Option<usize> {
        class_bound(&Manipulator::from_legs(*legs).unwrap()).map(Theorem::bound)
    }

    #[test]
    fn every_topology_of_the_catalogue_has_the_bound_of_its_finest_rows() {
        let bounds: Vec<usize> =
            catalogue().iter().map(|n| bound_of(n.topology()).map_or(40, Theorem::bound)).collect();
        let number = |count| bounds.iter().filter(|b| **b == count).count();
        assert_eq!([40, 32, 24, 16, 8].map(number), [3, 2, 3, 12, 14]);
        for n in catalogue() {
            assert_eq!(bound_of(n.topology()), bound_of(n.topology().exchanged()), "{}", n.id());
        }
    }

    #[test]
    fn bounds_are_sorted_and_no_row_is_idle() {
        let rows: Vec<&Row> = PROVED.iter().collect();
        assert!(rows.windows(2).all(|w| w[0].2.bound() <= w[1].2.bound()));
        for r in rows {
            assert_eq!(
                bound_of(Topology::of_legs(r.0, r.1)),
                Some(r.2),
                "another row gives as little or less"
            );
        }
    }

    #[test]
    fn merging_joints_never_raises_a_bound() {
        let list = catalogue();
        let count = |t: Topology| bound_of(t).map_or(40, Theorem::bound);
        let mut pairs = 0;
        for (x, y) in list.iter().flat_map(|x| list.iter().map(move |y| (x.topology(), y.topology()))) {
            if x.is_merger_of(y) {
                pairs += 1;
                assert!(count(x) <= count(y));
            }
        }
        assert!(pairs > 200);
    }

    #[test]
    fn joints_that_nearly_coincide_are_two() {
        assert_eq!(count(&platform(ALL, [0, 0, 1, 1, 2, 3])), Some(32));
        let mut legs = platform(ALL, [0, 0, 1, 1, 2, 3]);
        legs[1].platform.x = legs[1].platform.x.next_up();
        assert_eq!(count(&legs), None);
        legs[1].platform.x = legs[0].platform.x;
        assert_eq!(count(&legs), Some(32));
        legs[0].platform.z = 0.0;
        legs[1].platform.z = -0.0;
        assert_eq!(count(&legs), Some(32), "the two zeros are one number");
        assert_eq!(count(&platform(ALL, ALL)), None);
        assert_eq!(count(&platform(ALL, [0, 0, 1, 2, 3, 4])), None);
    }
}
