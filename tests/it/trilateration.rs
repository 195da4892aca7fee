//! `fk::Trilateration` on all topologies it takes, against proofs and against the homotopy.

use equipod::methods::bench::{Class, LengthsFrom, Planar, problem};
use equipod::methods::fk::{
    Completeness, FkOptions, FkSolutions, ForwardKinematics, Homotopy, Method, Trilateration, solver,
};
use equipod::methods::manipulator::Manipulator;
use equipod::methods::topology::catalogue;

use super::cli_frame::{document, equipod};

fn proved(found: &FkSolutions) -> bool {
    matches!(found.completeness, Completeness::Proved { .. })
        && found.roots.iter().all(equipod::methods::fk::FkRoot::certified)
}

#[test]
fn every_topology_is_solved_completely() {
    let method = Trilateration::default();
    for topology in catalogue() {
        let class = Class::Topology { topology, planar: Planar::Neither };
        // the 6-6 takes as long as all the others
        for k in 0..if topology.number() == 1 { 1 } else { 4 } {
            let p = problem(class, LengthsFrom::Pose, 3, k).unwrap();
            let found = method.solve(&p.manipulator, &p.squares, &FkOptions::default()).unwrap();
            assert!(proved(&found), "{} {k}: {:?}", topology.id(), found.completeness);
            assert_eq!(found.method, Method::Trilateration);
        }
    }
}

/// The certified sets are the same: as many roots, and each near one of the other's.
#[test]
fn the_homotopy_finds_the_same_poses() {
    for id in [3, 11, 14, 28, 31] {
        let topology = catalogue()[id - 1];
        for planar in [Planar::Neither, Planar::Platform] {
            let p = problem(Class::Topology { topology, planar }, LengthsFrom::Pose, 5, 0).unwrap();
            let o = FkOptions::default();
            let one = Trilateration::default().solve(&p.manipulator, &p.squares, &o).unwrap();
            let other = Homotopy.solve(&p.manipulator, &p.squares, &o).unwrap();
            assert!(proved(&one) && proved(&other), "{} {planar:?}", topology.id());
            assert_eq!(one.roots.len(), other.roots.len());
            let size = p.manipulator.size();
            for r in &one.roots {
                let scale = r.pose.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
                let near = |q: &&equipod::methods::fk::FkRoot| q.pose.distance(&r.pose, size) < 1e-6 * scale;
                let partner: Vec<_> = other.roots.iter().filter(near).collect();
                assert!(!partner.is_empty() && partner.iter().any(|q| q.reality == r.reality));
            }
        }
    }
}

#[test]
fn preparation_changes_nothing_and_the_order_of_designs_neither() {
    let o = FkOptions::default();
    let topology = catalogue()[15];
    let class = Class::Topology { topology, planar: Planar::Neither };
    let problems = [0, 1, 2].map(|k| problem(class, LengthsFrom::Pose, 9, k).unwrap());
    let used = solver(Some(Method::Trilateration));
    let forth: Vec<_> =
        problems.iter().map(|p| used.solve(&p.manipulator, &p.squares, &o).unwrap()).collect();
    for (p, before) in problems.iter().zip(forth).rev() {
        let fresh = Trilateration::default();
        assert_eq!(fresh.solve(&p.manipulator, &p.squares, &o).unwrap(), before);
        let prepared = fresh.prepare(&p.manipulator, &FkOptions::default()).unwrap();
        assert_eq!(prepared.solve(&p.squares, &o).unwrap(), before);
    }
}

/// Porta and Thomas, sec. IV: ten real poses of sixteen.
#[test]
fn the_decoupled_example_of_porta_and_thomas() {
    let out = equipod(&["fk", "designs/porta-thomas-1.toml", "--method", "trilateration", "--json"]);
    let doc = document(&out);
    assert_eq!((out.status.code(), doc["completeness"].as_str()), (Some(0), Some("proved")));
    assert_eq!((doc["finite_count"].as_u64(), doc["real_count"].as_u64()), (Some(16), Some(10)));
}

/// Lengths that no real pose has still have complex ones; a length off by little is another problem.
#[test]
fn other_lengths_have_other_poses() {
    let class = Class::Topology { topology: catalogue()[7], planar: Planar::Neither };
    let p = problem(class, LengthsFrom::Pose, 2, 0).unwrap();
    let squares =
        equipod::methods::manipulator::SquaredLegLengths::try_new(p.squares.get().map(|s| 1.01 * s)).unwrap();
    let o = FkOptions::default();
    let (one, other) = (
        Trilateration::default().solve(&p.manipulator, &p.squares, &o),
        Trilateration::default().solve(&p.manipulator, &squares, &o),
    );
    let (one, other) = (one.unwrap(), other.unwrap());
    assert!(proved(&one) && proved(&other));
    let m: &Manipulator = &p.manipulator;
    assert!(one.roots.iter().all(|r| r.pose.residual(m, &squares) > 1e-4));
}

/// Squares of lengths have more digits than doubles, and these decide how many poses are real.
#[test]
fn the_closure_polynomial_and_the_certificates_count_the_same_real_poses() {
    let path = "tests/fixtures/adversarial/lengths-as-given.toml";
    let doc = document(&equipod(&["fk", path, "--method", "trilateration", "--json"]));
    assert_eq!((&doc["completeness"], &doc["real_count"]), (&"proved".into(), &8.into()));
    let by_polynomial = &doc["closure"]["poses_real_proved"];
    assert!(by_polynomial.is_null() || *by_polynomial == doc["real_count"], "{by_polynomial}");
}
