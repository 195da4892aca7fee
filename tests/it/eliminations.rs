//! The published eliminations against reference roots and against the homotopy.

use std::fmt::Write as _;

use equipod::methods::fk::{
    Completeness, FkError, FkOptions, ForwardKinematics, Homotopy, PoseCounting, Sylvester, Template,
};

use equipod::methods::manipulator::{Leg, LegLengths, Manipulator, SquaredLegLengths};
use nalgebra::Point3;

use crate::reference::{Reference, load};

/// Designs with forty poses.
const FORTY: [&str; 10] = [
    "lee_shim",
    "dietmaier40",
    "general66_00",
    "general66_01",
    "general66_02",
    "general65_00",
    "realpose66_00",
    "realpose66_01",
    "nearsing_00",
    "semiplanar6P6_00",
];

/// Designs outside the eliminations: planar bodies, or fewer than forty poses.
const SPECIAL: [&str; 8] = [
    "octahedral33_00",
    "hexapod_00",
    "hexapod_01",
    "planar6P6P_00",
    "planar6P6P_01",
    "geom64_00",
    "geom63_00",
    "geom55_00",
];

fn finds_forty(method: &dyn ForwardKinematics, names: &[&str]) {
    let mut report = String::new();
    let mut good = true;
    for name in names {
        let r = load(&format!("{name}.json"));
        let (m, s) = (&r.manipulator, r.lengths.squared());
        match method.solve(m, &s, &FkOptions::default()) {
            Ok(found) => {
                let proved = matches!(found.completeness, Completeness::Proved { .. });
                let other = Homotopy.solve(m, &s, &FkOptions::default()).unwrap();
                let mut worst = 0.0f64;
                for h in &other.roots {
                    let near = found.roots.iter().map(|q| q.pose.distance(&h.pose, m.size()));
                    worst = worst.max(near.fold(f64::INFINITY, f64::min));
                }
                good &= proved && found.roots.len() == 40 && other.roots.len() == 40 && worst < 1e-7;
                let _ = writeln!(
                    report,
                    "{name:17} {:2} roots, proved {proved}, worst {worst:.1e}",
                    found.roots.len()
                );
            }
            Err(e) => {
                good = false;
                let _ = writeln!(report, "{name:17} {e}");
            }
        }
    }
    assert!(good, "\n{report}");
}

/// Whether the method answers. Then it must report no false pose. It must say that roots may be missing, unless it has
/// them all and the bound of the class proves it.
fn answers_honestly(method: &dyn ForwardKinematics, r: &Reference) -> bool {
    let (m, s) = (&r.manipulator, r.lengths.squared());
    match method.solve(m, &s, &FkOptions::default()) {
        Ok(found) => {
            let proved = matches!(found.completeness, Completeness::Proved { .. });
            let complete = proved && found.roots.len() == r.solutions.len();
            assert!(complete || !found.all_accounted(), "{}: {:?}", r.name, found.completeness);
            for q in &found.roots {
                let near = r.solutions.iter().map(|(pose, _)| q.pose.distance(pose, m.size()));
                let near = near.fold(f64::INFINITY, f64::min);
                assert!(q.certified() && near < 1e-6, "{}: false root, {near:.1e}, {}", r.name, q.residual);
            }
            true
        }
        Err(FkError::NotApplicable { method: named, .. }) => {
            assert_eq!(named, method.method());
            false
        }
        Err(e) => panic!("{}: {e}", r.name),
    }
}

/// Rojas, Borras, Thomas, sec. 6: joints inside the edges of two triangles, 16 finite poses.
fn griffis_duffy() -> (Manipulator, SquaredLegLengths) {
    let triangle = |edge: f64| {
        let height = edge * 0.75f64.sqrt();
        [Point3::origin(), Point3::new(edge / 2.0, height, 0.0), Point3::new(edge, 0.0, 0.0)]
    };
    let (base, platform) = (triangle(12.0), triangle(6.0));
    let between = |p: Point3<f64>, q: Point3<f64>| p + (q - p) * 0.2;
    // legs of the octahedral platform in cyclic order, each moved a fifth of the way to the next
    let octahedral = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let legs = std::array::from_fn(|i| {
        let ((a, b), (c, d)) = (octahedral[i], octahedral[(i + 1) % 6]);
        Leg { base: between(base[a], base[c]), platform: between(platform[b], platform[d]) }
    });
    let m = [
        18.851843411189265,
        17.839282496782207,
        17.145261736118233,
        16.426868234694037,
        14.762655587664439,
        18.05879287217172,
    ];
    (Manipulator::from_legs(legs).unwrap(), LegLengths::try_new(m).unwrap().squared())
}

#[test]
fn neither_applies_to_a_griffis_duffy_platform() {
    let (m, s) = griffis_duffy();
    // without the count nobody asks for the poses far out that rounding of the joints makes
    let o = FkOptions::new().pose_count(PoseCounting::Never);
    assert_eq!(Homotopy.solve(&m, &s, &o).unwrap().roots.len(), 16);
    for method in [&Template as &dyn ForwardKinematics, &Sylvester] {
        let refused = method.solve(&m, &s, &o);
        assert!(matches!(refused, Err(FkError::NotApplicable { .. })), "{refused:?}");
    }
}

#[test]
fn the_template_finds_forty_certified_poses_equal_to_those_of_the_homotopy() {
    finds_forty(&Template, &FORTY);
}

#[test]
fn the_template_is_honest_about_special_platforms() {
    let refused =
        SPECIAL.iter().filter(|name| !answers_honestly(&Template, &load(&format!("{name}.json")))).count();
    assert!(refused >= 7, "{refused}: the template keeps its rank on 5-5 platforms only");
}

#[test]
fn the_sylvester_matrix_finds_forty_certified_poses_equal_to_those_of_the_homotopy() {
    finds_forty(&Sylvester, &FORTY);
}

#[test]
fn the_sylvester_matrix_is_honest_about_special_platforms() {
    let refused =
        SPECIAL.iter().filter(|name| !answers_honestly(&Sylvester, &load(&format!("{name}.json")))).count();
    assert!(refused >= 5, "{refused}: joints of 6-4, 6-3, 5-5 leave the linear equations independent");
}
