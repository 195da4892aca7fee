//! Tests of recognition.

use super::*;
use crate::design::PointTable;

fn design(text: &str) -> DesignModel {
    PointTable::read(text.as_bytes()).unwrap().design("typed", "mm").unwrap()
}

/// Rows of two rings with these decimals.
fn rings(decimals: usize, turn: f64) -> String {
    let at = |r: f64, degrees: f64| {
        let (s, c) = (degrees + turn).to_radians().sin_cos();
        format!("{:.decimals$},{:.decimals$},0", r * c, r * s)
    };
    let (base, platform) = ([-10., 10., 110., 130., 230., 250.], [-50., 50., 70., 170., 190., 290.]);
    let rows = base.iter().zip(platform).map(|(a, b)| format!("{},{}", at(500.0, *a), at(300.0, b)));
    rows.collect::<Vec<_>>().join("\n")
}

#[test]
fn rings_typed_as_decimals_become_one_pair_and_its_turns() {
    for (decimals, off) in [(12, 1e-11), (6, 2e-6), (3, 2e-3)] {
        let snapped = design(&rings(decimals, 0.0)).snapped().unwrap();
        assert!(snapped.found.iter().all(|f| f.off <= off), "{:?}", snapped.found);
        // one joint of each body keeps its numbers
        let text = snapped.design.to_toml();
        assert_eq!(text.matches("mirror").count() + text.matches("turn").count(), 10, "{text}");
        assert_eq!(
            snapped.design.manipulator().joint_knowledge(),
            platform::manipulator::JointKnowledge::Exact,
            "{text}"
        );
    }
    // a mirror plane at 7 degrees is found too
    let turned = found(&rings(12, 7.0)).design;
    let text = turned.to_toml();
    assert!(text.contains("normal"), "{text}");
    let own = |text: &str, letter: char| {
        let is_own = |line: &&str| line.split_once(" = ").is_some_and(|(_, joint)| joint.starts_with('['));
        text.lines().filter(|line| line.starts_with(letter)).filter(is_own).count()
    };
    assert_eq!((own(&text, 'A'), own(&text, 'B')), (1, 6), "{text}");
    // pairs on both sides of 60 degrees, with the plane xz between two pairs
    let text = found(&rings(6, 60.0)).design.to_toml();
    assert_eq!((own(&text, 'A'), own(&text, 'B')), (1, 6), "{text}");
}

#[test]
fn ends_that_are_apart_by_noise_are_one_joint() {
    let noise = "-0.000001,150,-0.000001,77.942286,45,0.000001\n0.000001,150,0.000001,-77.942286,45,0.000001\n-129.903810,-75,-0.000001,-77.942286,44.999999,-0.000001\n-129.903812,-75,-0.000001,0,-89.999999,0\n129.903812,-75,0,0.000001,-90,0\n129.903810,-75.000001,0,77.942285,45,0\n";
    let snapped = design(noise).snapped().unwrap();
    let m = snapped.design.manipulator();
    assert_eq!((m.base_joints().len(), m.platform_joints().len()), (3, 3));
    assert!(snapped.sentences("mm").iter().any(|s| s.starts_with("base: ")), "{:?}", snapped.sentences("mm"));
}

/// A millionth of a body that is a billion times larger is no rounding of the smaller body.
#[test]
fn a_small_body_keeps_its_shape_beside_a_large_one() {
    let base = [[-6, -6, -7], [-3, 6, 4], [-9, -9, 7], [-8, 1, -1], [-5, 9, 5], [-2, -8, -5]];
    let platform = [[-3, -8, 7], [-5, -2, -9], [-8, -9, 0], [1, 8, -9], [-2, 3, 1], [6, -7, -5]];
    let rows = base.iter().zip(platform).map(|(a, b)| {
        let numbers = a.iter().map(|x| f64::from(*x)).chain(b.iter().map(|x| 1e9 * f64::from(*x)));
        numbers.map(|x| x.to_string()).collect::<Vec<_>>().join(",")
    });
    assert!(design(&rows.collect::<Vec<_>>().join("\n")).snapped().is_none());
}

#[test]
fn nothing_is_found_where_nothing_is() {
    let mut rng = num::Rng::new(4);
    let rows: Vec<String> = (0..6)
        .map(|_| (0..6).map(|_| rng.uniform(-1.0, 1.0).to_string()).collect::<Vec<_>>().join(","))
        .collect();
    assert_eq!(design(&rows.join("\n")).snapped(), None);
    // a thousandth off is another machine
    let off = rings(12, 0.0).replacen("492.403876506104", "492.9", 1);
    let snapped = design(&off).snapped().unwrap();
    assert!(snapped.design.to_toml().contains("492.9"));
    // exact relations are left unchanged
    let exact = snapped.design.snapped();
    assert_eq!(exact, None);
}

/// A table of six rows of points.
fn rows(base: &[[f64; 3]; 6], platform: &[[f64; 3]; 6], decimals: usize) -> String {
    let point = |p: &[f64; 3]| p.map(|x| format!("{x:.decimals$}")).join(",");
    let rows = base.iter().zip(platform).map(|(a, b)| format!("{},{}", point(a), point(b)));
    rows.collect::<Vec<_>>().join("\n")
}

/// Six points at these angles (degrees) on a circle, in the plane perpendicular to an axis.
fn ring(radius: f64, degrees: [f64; 6], axis: usize) -> [[f64; 3]; 6] {
    degrees.map(|angle| {
        let (s, c) = angle.to_radians().sin_cos();
        let mut p = [0.0; 3];
        (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (radius * c, radius * s);
        p
    })
}

/// Points with three coordinates each from a generator.
fn random(rng: &mut num::Rng) -> [[f64; 3]; 6] {
    std::array::from_fn(|_| [0, 1, 2].map(|k| if k == 2 { 0.0 } else { rng.uniform(-200.0, 200.0) }))
}

/// The snapped design, whose joints are exact and near those typed.
fn found(text: &str) -> SnappedDesign {
    let typed = design(text);
    let snapped = typed.snapped().expect(text);
    let toml = snapped.design.to_toml();
    assert_eq!(
        snapped.design.manipulator().joint_knowledge(),
        platform::manipulator::JointKnowledge::Exact,
        "{toml}"
    );
    let near = TOLERANCE * typed.manipulator().size();
    for (a, b) in typed.manipulator().legs().iter().zip(snapped.design.manipulator().legs()) {
        assert!(
            (a.base - b.base).norm() <= 1.1 * near && (a.platform - b.platform).norm() <= 1.1 * near,
            "{toml}"
        );
    }
    // the file keeps it
    let (again, _) = parse_with_cranks(&toml, Format::Toml).unwrap();
    assert_eq!(again.exact_joints(Body::Base), snapped.design.exact_joints(Body::Base), "{toml}");
    assert_eq!(again.exact_joints(Body::Platform), snapped.design.exact_joints(Body::Platform), "{toml}");
    snapped
}

/// `|sum of the first - sum of the second| = 0` exactly, of squared distances of joints.
fn squared(design: &DesignModel, body: Body, i: usize, j: usize) -> num::real::RealNumber {
    let points = design.exact_points(body);
    let difference = |k: usize| points[i][k].minus(&points[j][k]).unwrap();
    (0..3)
        .map(difference)
        .fold(num::real::RealNumber::integer(0), |sum, x| sum.plus(&x.times(&x).unwrap()).unwrap())
}

#[test]
fn a_mirror_plane_at_any_angle_is_one_normal() {
    let mut rng = num::Rng::new(7);
    for (angle, axis) in [(37.3_f64, 2), (-15.0, 2), (22.5, 1)] {
        // three joints and their mirror images in a plane through the axis
        let half = random(&mut rng);
        let base: [[f64; 3]; 6] = std::array::from_fn(|i| {
            let [x, y, _] = half[i / 2];
            let (along, across) = (x + 300.0, if i % 2 == 0 { y } else { -y });
            let (s, c) = angle.to_radians().sin_cos();
            let mut p = [0.0; 3];
            (p[(axis + 1) % 3], p[(axis + 2) % 3]) = (c * along - s * across, s * along + c * across);
            p
        });
        let mut platform = random(&mut rng);
        if axis == 1 {
            for p in &mut platform {
                p.swap(1, 2);
            }
        }
        let snapped = found(&rows(&base, &platform, 4));
        let images = snapped.found.iter().filter(|f| matches!(f.relation, JointRelation::Image(..))).count();
        assert_eq!(images, 3, "{angle}: {:?}", snapped.sentences("mm"));
        let m = &snapped.design;
        // distances are exactly equal, not only to rounding
        let difference = squared(m, Body::Base, 0, 2).minus(&squared(m, Body::Base, 1, 3)).unwrap();
        assert!(difference.exact().is_some_and(num::surd::Surd::is_zero), "{angle}");
    }
}

#[test]
fn thirds_of_a_turn_about_another_axis_are_found_with_y_up_and_off_centre() {
    for (axis, shift) in [(1, [0.0, 0.0, 0.0]), (2, [120.5, -40.25, 0.0]), (1, [33.0, 20.0, 7.5])] {
        let moved = |ring: [[f64; 3]; 6]| ring.map(|p| [0, 1, 2].map(|k| p[k] + shift[k]));
        let base = moved(ring(500.0, [-13.0, 17.0, 107.0, 137.0, 227.0, 257.0], axis));
        let platform = moved(ring(280.0, [-50.0, 41.0, 70.0, 161.0, 190.0, 281.0], axis));
        let snapped = found(&rows(&base, &platform, 5));
        let text = snapped.design.to_toml();
        assert!(text.matches("turn = ").count() >= 2, "{text}");
        let sides = [(0, 2), (2, 4), (4, 0)].map(|(i, j)| squared(&snapped.design, Body::Base, i, j));
        let difference = sides[0].minus(&sides[1]).unwrap();
        assert!(difference.exact().is_some_and(num::surd::Surd::is_zero), "{text}");
    }
}

#[test]
fn joints_on_a_line_of_others_are_found() {
    let mut rng = num::Rng::new(3);
    let mut base = random(&mut rng);
    for (joint, share) in [(2, 0.3), (4, 1.0 / 3.0)] {
        base[joint] = [0, 1, 2].map(|k| base[0][k] + share * (base[1][k] - base[0][k]));
    }
    let snapped = found(&rows(&base, &random(&mut rng), 5));
    let on: Vec<_> =
        snapped.found.iter().filter(|f| matches!(f.relation, JointRelation::OnLine(_))).collect();
    assert_eq!(on.len(), 2, "{:?}", snapped.found);
    assert!(snapped.sentences("mm")[0].contains("on lines of other joints"), "{:?}", snapped.sentences("mm"));
}

#[test]
fn a_platform_similar_to_its_base_is_written_from_it() {
    let mut rng = num::Rng::new(11);
    for (scale, angle, flip, order) in [
        (0.6, 0.0_f64, 1.0, [0, 1, 2, 3, 4, 5]),
        (1.0, 60.0, 1.0, [1, 2, 3, 4, 5, 0]),
        (0.731, 41.7, 1.0, [3, 1, 0, 2, 5, 4]),
        (0.5, 0.0, -1.0, [0, 1, 2, 3, 4, 5]),
    ] {
        let base = random(&mut rng);
        let (s, c) = angle.to_radians().sin_cos();
        let platform = order.map(|i: usize| {
            let [x, y, _] = base[i];
            let y = flip * y;
            [scale * (c * x - s * y), scale * (s * x + c * y), 0.0]
        });
        let snapped = found(&rows(&base, &platform, 6));
        assert!(
            snapped.sentences("mm").iter().any(|s| s.contains("of the base times")),
            "{:?}",
            snapped.sentences("mm")
        );
        let sides = [(0, 1), (2, 5)].map(|(i, j)| {
            let own = squared(&snapped.design, Body::Platform, i, j);
            own.over(&squared(&snapped.design, Body::Base, order[i], order[j])).unwrap()
        });
        let difference = sides[0].minus(&sides[1]).unwrap();
        assert!(difference.exact().is_some_and(num::surd::Surd::is_zero), "{}", snapped.design.to_toml());
    }
}

#[test]
fn equal_circles_are_equal_exactly() {
    let angles = [[3.0, 41.0, 100.0, 170.0, 222.0, 301.0], [20.0, 70.0, 133.0, 190.0, 250.0, 340.0]];
    let snapped = found(&rows(&ring(250.0, angles[0], 2), &ring(250.0, angles[1], 2), 4));
    for body in Body::BOTH {
        for p in snapped.design.exact_points(body) {
            let [x, y, _] = p.each_ref().map(|x| x.times(x).unwrap());
            let sum = x.plus(&y).unwrap();
            assert_eq!(sum.nearest().to_bits(), 62_500.0_f64.to_bits());
            assert!(sum.exact().is_some_and(|x| x.as_rational().is_some()));
        }
    }
}

#[test]
fn general_platforms_and_those_off_by_more_than_rounding_have_no_symmetry() {
    let mut rng = num::Rng::new(5);
    for _ in 0..50 {
        assert_eq!(design(&rows(&random(&mut rng), &random(&mut rng), 12)).snapped(), None);
        let mut base = ring(500.0, [-13.0, 17.0, 107.0, 137.0, 227.0, 257.0], 2);
        base.iter_mut().flatten().for_each(|x| *x += rng.uniform(-0.1, 0.1));
        assert_eq!(design(&rows(&base, &random(&mut rng), 12)).snapped(), None);
    }
}
