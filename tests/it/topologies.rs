//! Number of finite poses of the joint-sharing topologies: the poses found, and the bound that proves them complete.

use equipod::methods::bench::{Class, LengthsFrom, Planar, problem};
use equipod::methods::fk::{Completeness, FkOptions, FkSolutions, solver};
use equipod::methods::manipulator::Manipulator;
use equipod::methods::topology::{NamedTopology, catalogue, recognise};

use super::evidence::size;

/// Finite poses of generic members, in the order of the catalogue (`docs/theory/topologies.md`).
const COUNTS: [usize; 34] = [
    40, 40, 16, 32, 40, 24, 8, 16, 16, 32, 24, 8, 16, 8, 8, 16, 8, 8, 16, 8, 16, 24, 16, 16, 8, 16, 8, 8, 8,
    8, 16, 8, 8, 16,
];

fn member(topology: NamedTopology, planar: Planar, k: u64) -> FkSolutions {
    let class = Class::Topology { topology, planar };
    let drawn = problem(class, LengthsFrom::Pose, 0x0707, k).unwrap();
    solver(None).solve(&drawn.manipulator, &drawn.squares, &FkOptions::default()).unwrap()
}

fn is_proved(found: &FkSolutions) -> bool {
    matches!(found.completeness, Completeness::Proved { .. })
}

#[test]
fn every_topology_has_its_number_of_poses_certified_and_proved_complete() {
    for (t, count) in catalogue().into_iter().zip(COUNTS) {
        for k in 0..3 {
            let found = member(t, Planar::Neither, k);
            assert_eq!(found.roots.len(), count, "{} {k}: {:?}", t.id(), found.completeness);
            assert!(found.roots.iter().all(equipod::methods::fk::FkRoot::certified), "{} {k}", t.id());
            assert!(is_proved(&found), "{} {k}: {:?}", t.id(), found.completeness);
        }
    }
}

#[test]
fn planes_change_nothing_about_shared_joints() {
    for (t, count) in catalogue().into_iter().zip(COUNTS) {
        for planar in [Planar::Base, Planar::Platform, Planar::Both] {
            let found = member(t, planar, 0);
            assert_eq!(found.roots.len(), count, "{} {planar:?}: {:?}", t.id(), found.completeness);
            assert!(is_proved(&found), "{} {planar:?}: {:?}", t.id(), found.completeness);
        }
    }
}

/// Joints a rounding error apart make a general platform. Its further poses are far out or hard to find, and no proof
/// may be given for fewer than forty.
#[test]
fn joints_that_do_not_quite_coincide_get_no_proof_from_the_topology() {
    let shared = catalogue().into_iter().filter(|t| t.topology().shared_joints() > 0);
    for t in shared.step_by(size(17, 1)) {
        let class = Class::Topology { topology: t, planar: Planar::Neither };
        let drawn = problem(class, LengthsFrom::Pose, 0x0707, 5).unwrap();
        let mut legs = drawn.manipulator.legs();
        for (k, leg) in legs.iter_mut().enumerate() {
            let off = 1e-13 * (k as f64 - 2.5);
            leg.base.x += off;
            leg.platform.y -= off;
        }
        let apart = Manipulator::from_legs(legs).unwrap();
        assert_eq!(recognise(&apart).unwrap().topology.name(), "6-6");
        let found = solver(None).solve(&apart, &drawn.squares, &FkOptions::default()).unwrap();
        assert!(!is_proved(&found) || found.roots.len() == 40, "{}: {:?}", t.id(), found.completeness);
    }
}
