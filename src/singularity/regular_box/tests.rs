use super::*;
use crate::manipulator::{Leg, default_home, plucker_matrix};
use crate::num::Rng;
use nalgebra::Point3;

fn hexapod() -> Manipulator {
    let ring = |radius: f64, degrees: f64, z: f64| {
        let (s, c) = degrees.to_radians().sin_cos();
        Point3::new(radius * c, radius * s, z)
    };
    let base = [-10.0, 10.0, 110.0, 130.0, 230.0, 250.0];
    let platform = [-50.0, 50.0, 70.0, 170.0, 190.0, 290.0];
    Manipulator::from_legs(std::array::from_fn(|i| Leg {
        base: ring(200.0, base[i], 0.0),
        platform: ring(120.0, platform[i], 0.0),
    }))
    .unwrap()
}

fn home(m: &Manipulator) -> Pose {
    let mut home = default_home(m);
    home.position.z = 180.0;
    home
}

const OPTIONS: BoxOptions =
    BoxOptions { translation: [60.0; 3], rotation: [0.3; 3], regions: 20_000, enough: 0.8, seed: 1 };

#[test]
fn no_pose_of_the_proved_box_has_the_other_sign_and_the_segment_has_both() {
    let m = hexapod();
    let home = home(&m);
    let found = regular_box(&m, &home, &OPTIONS);
    let segment = found.refuted.unwrap();
    assert!(found.proved > 0.4 * segment.scale && found.proved < segment.scale, "{found:?}");
    let sign = |pose: &Pose| plucker_matrix(&m, pose, m.size()).determinant();
    let here = sign(&home);
    assert!(sign(&segment.pose) * here < 0.0);
    let mut rng = Rng::new(3);
    let shape = Shape::new(m.size(), &OPTIONS);
    let half = shape.half_widths(found.proved);
    for k in 0..20_000 {
        // every other one a corner
        let q: [f64; 6] = half.map(|h| {
            let u = rng.uniform(-1.0, 1.0);
            h * if k % 2 == 0 { u } else { u.signum() }
        });
        assert!(sign(&pose_at(&home, m.size(), &q)) * here > 0.0);
    }
}

#[test]
fn scale_of_the_design_and_moves_of_the_base_change_nothing() {
    let m = hexapod();
    let one = regular_box(&m, &home(&m), &OPTIONS);
    let larger =
        Manipulator::from_legs(m.legs().map(|l| Leg { base: l.base * 4.0, platform: l.platform * 4.0 }))
            .unwrap();
    let mut high = home(&m);
    high.position *= 4.0;
    let four = regular_box(&larger, &high, &BoxOptions { translation: [240.0; 3], ..OPTIONS });
    assert!((one.proved - four.proved).abs() < 1e-6 * one.proved);
    let shift = Vector3::new(100.0, -50.0, 30.0);
    let moved = Manipulator::from_legs(m.legs().map(|l| Leg { base: l.base + shift, ..l })).unwrap();
    let mut aside = home(&m);
    aside.position += shift;
    let there = regular_box(&moved, &aside, &OPTIONS);
    assert!((one.proved - there.proved).abs() < 1e-6 * one.proved);
}

#[test]
fn a_singular_home_proves_nothing() {
    // similar hexagons on circles, parallel: architecturally singular
    let m = hexapod();
    let similar = Manipulator::from_legs(
        m.legs().map(|l| Leg { base: l.base, platform: Point3::from(l.base.coords * 0.5) }),
    )
    .unwrap();
    let found = regular_box(&similar, &home(&similar), &OPTIONS);
    assert!(found.proved == 0.0 && found.refuted.is_none());
}

#[test]
fn the_determinant_changes_by_det_a_and_the_box_not_at_all() {
    // one end of a leg moved along the line of two legs with a common joint: det A = 1 - t
    let p = |x: f64, y: f64, z: f64| Point3::new(x, y, z);
    let (b, t) =
        ([p(0., 0., 0.), p(12., 0., 0.), p(5., 11., 0.)], [p(0., 0., 0.), p(6., 0., 0.), p(2., 5., 0.)]);
    let zigzag = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let octahedral = zigzag.map(|(i, j)| Leg { base: b[i], platform: t[j] });
    let mut moved = octahedral;
    moved[1].base = b[1] + (b[0] - b[1]) * 0.25;
    let (m, n) = (Manipulator::from_legs(octahedral).unwrap(), Manipulator::from_legs(moved).unwrap());
    let mut home = default_home(&m);
    home.position.z = 9.0;
    let ratio = plucker_matrix(&n, &home, 12.0).determinant() / plucker_matrix(&m, &home, 12.0).determinant();
    assert!((ratio - 0.75).abs() < 1e-12);
    let options = BoxOptions { translation: [3.0; 3], rotation: [0.3; 3], ..OPTIONS };
    let (x, y) = (regular_box(&m, &home, &options), regular_box(&n, &home, &options));
    let (sx, sy) = (x.refuted.unwrap().scale, y.refuted.unwrap().scale);
    // bounds from either platform hold for both
    assert!(x.proved < sy && y.proved < sx && (sx - sy).abs() < 0.05 * sx, "{x:?} {y:?}");
}
