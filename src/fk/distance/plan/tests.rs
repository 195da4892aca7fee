//! Plans for designs of all topologies.

use super::*;
use nalgebra::Point3;
use num::Rng;
use platform::topology::catalogue;

/// A design of a topology with joints drawn from a cube.
fn design(legs: [(usize, usize); 6], seed: u64, flat: bool) -> Manipulator {
    let rng = &mut Rng::new(seed);
    let mut joints = |n: usize| -> Vec<Point3<f64>> {
        (0..n)
            .map(|_| {
                let [x, y, z] = [(); 3].map(|()| rng.uniform(-1.0, 1.0));
                Point3::new(x, y, if flat { 0.0 } else { z })
            })
            .collect()
    };
    let count = |end: fn(&(usize, usize)) -> usize| 1 + legs.iter().map(end).max().unwrap();
    Manipulator::try_new(joints(count(|l| l.0)), joints(count(|l| l.1)), legs).unwrap()
}

#[test]
fn every_topology_has_a_plan_in_any_order_and_exchange() {
    let mut needed = [0; 4];
    for n in catalogue() {
        for t in [n.topology(), n.topology().exchanged()] {
            let legs = [4, 1, 5, 0, 3, 2].map(|i| t.legs()[i]);
            let m = design(legs, 7 + n.number() as u64, n.number() % 2 == 0);
            let list = plans(&m, 3).unwrap();
            let best = &list[0];
            needed[best.virtual_legs.len()] += 1;
            // coordinates choose among equals only
            let same = t.trilateration();
            assert_eq!(Nesting::of(&legs, best), Nesting::of(&t.legs(), &same), "{}", n.id());
            assert_eq!(best.steps.len() + 3, t.base_joints() + t.platform_joints());
        }
    }
    assert_eq!(needed, [20, 40, 6, 2]);
}

#[test]
fn more_virtual_legs_than_allowed_and_collinear_joints_are_refused() {
    let general = design([(0, 0), (1, 1), (2, 2), (3, 3), (4, 4), (5, 5)], 1, false);
    assert_eq!(plans(&general, 1), Err(NoPlan::TooManyVirtualLegs { needed: 3, allowed: 1 }));
    let line = |k: f64| Point3::new(k, 2.0 * k, 0.5);
    let base = [0.0, 1.0, 2.5].map(line).to_vec();
    let platform = vec![Point3::new(0.1, 0.0, 0.0), Point3::new(1.0, 0.0, 0.0), Point3::new(0.0, 1.0, 0.0)];
    let m = Manipulator::try_new(base, platform, [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)]).unwrap();
    assert_eq!(plans(&m, 1), Err(NoPlan::Collinear));
}

#[test]
fn a_collinear_triple_is_avoided_where_there_is_another() {
    let t = catalogue()[7].topology();
    let m = design(t.legs(), 3, false);
    let mut base = m.base_joints().to_vec();
    base[2] = base[0] + (base[1] - base[0]) * 2.0;
    let m = Manipulator::try_new(base, m.platform_joints().to_vec(), t.legs()).unwrap();
    for s in plans(&m, 1).unwrap() {
        let bases = s.steps.iter().map(|t| t.from).chain([s.start]);
        for from in bases.filter(|f| f[0].same_body(f[1]) && f[0].same_body(f[2])) {
            assert!(fatness(&m, from) > 1e-9);
        }
    }
}
