//! Two and three virtual legs: the distance method and the homotopy find the same poses.

use equipod::methods::bench::{Class, LengthsFrom, Planar, problem};
use equipod::methods::fk::{
    Completeness, FkOptions, FkSolutions, ForwardKinematics, Homotopy, Method, Trilateration,
};
use equipod::methods::topology::catalogue;

use super::cli_frame::{document, equipod};

fn proved(f: &FkSolutions) -> bool {
    matches!(f.completeness, Completeness::Proved { .. })
}

#[test]
fn the_distance_method_and_the_homotopy_certify_the_same_poses() {
    for (id, members) in [("T01", 1), ("T02", 6), ("T05", 6), ("T06", 6)] {
        let topology = catalogue().into_iter().find(|t| t.id() == id).unwrap();
        for k in 0..members {
            let class = Class::Topology { topology, planar: Planar::Neither };
            let member = problem(class, LengthsFrom::Pose, 3, k).unwrap();
            let (m, s, o) = (&member.manipulator, &member.squares, FkOptions::default());
            let (a, b) =
                (Trilateration::default().solve(m, s, &o).unwrap(), Homotopy.solve(m, s, &o).unwrap());
            assert_eq!(
                (a.method, proved(&a), proved(&b)),
                (Method::Trilateration, true, true),
                "{id} {k} {:?}",
                a.completeness
            );
            assert_eq!(a.roots.len(), b.roots.len(), "{id} {k}");
            for x in &a.roots {
                let near = |y: &equipod::methods::fk::FkRoot| {
                    x.pose.distance(&y.pose, m.size()) < 1e-6 * (1.0 + x.condition)
                };
                assert!(x.certified() && b.roots.iter().filter(|y| near(y)).count() >= 1, "{id} {k}");
            }
            assert_eq!(a, Trilateration::default().solve(m, s, &o).unwrap(), "same input, same output");
        }
    }
}

#[test]
fn designs_with_fewer_poses_are_not_called_complete_without_proof() {
    // lengths that no generic argument covers: base and platform in planes, all joints of the base on a line with two
    // exceptions
    let topology = catalogue().into_iter().find(|t| t.id() == "T02").unwrap();
    let class = Class::Topology { topology, planar: Planar::Both };
    let member = problem(class, LengthsFrom::Pose, 3, 0).unwrap();
    let (m, s, o) = (&member.manipulator, &member.squares, FkOptions::default());
    let (a, b) = (Trilateration::default().solve(m, s, &o).unwrap(), Homotopy.solve(m, s, &o).unwrap());
    assert!(a.roots.len() <= b.roots.len() && a.roots.iter().all(equipod::methods::fk::FkRoot::certified));
    assert!(proved(&a) == (a.roots.len() == 40) && a.all_accounted() == proved(&a));
}

/// Dietmaier's platform: forty real poses, by distances alone.
#[test]
#[ignore = "evidence"]
fn all_forty_poses_of_dietmaiers_platform_are_real() {
    let doc = document(&equipod(&["fk", "designs/dietmaier.toml", "--method", "trilateration", "--json"]));
    assert_eq!(doc["completeness"], "proved", "{}", doc["completeness_reason"]);
    assert_eq!((doc["finite_count"].as_u64(), doc["real_count"].as_u64()), (Some(40), Some(40)));
}
