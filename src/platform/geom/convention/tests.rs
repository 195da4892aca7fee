use super::*;
use crate::geom::random_rotation;
use nalgebra::Point3;
use num::Rng;

fn pose(rng: &mut Rng) -> Pose {
    Pose { rotation: random_rotation(rng), position: Vector3::from_fn(|_, _| rng.normal()) }
}

fn difference(a: &Pose, b: &Pose) -> f64 {
    (a.rotation.matrix() - b.rotation.matrix()).amax().max((a.position - b.position).amax())
}

/// Every convention that a random draw makes of the orders, pivots, frames and units.
fn conventions(rng: &mut Rng) -> Vec<PoseConvention> {
    let mut out = Vec::new();
    for (k, order) in RotationOrder::all().into_iter().enumerate() {
        let pick = |bit: usize| (k >> bit) & 1;
        out.push(PoseConvention {
            rotation_order: Some(order),
            angles: Some(AngleUnit::ALL[pick(0)]),
            quaternion: Some(QuaternionOrder::ALL[pick(1)]),
            pivot: (pick(2) == 1).then(|| Vector3::from_fn(|_, _| rng.normal())),
            relative_to: Some([ListedFrom::Base, ListedFrom::Home][pick(1)]),
            up: Some(UpAxis::ALL[pick(0)]),
        });
    }
    out
}

#[test]
fn every_order_is_the_product_that_its_formula_names() {
    let angles: [f64; 3] = [0.3, -0.8, 1.9];
    let about = |name: char, angle: f64| -> Matrix3<f64> {
        let (s, c) = angle.sin_cos();
        match name {
            'x' => Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            'y' => Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
            _ => Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        }
    };
    let orders = RotationOrder::all();
    assert_eq!(orders.len(), 25);
    for order in orders {
        let name = order.to_string();
        assert_eq!(name.parse(), Ok(order));
        if order == RotationOrder::Vector {
            continue;
        }
        // the formula as text is multiplied by hand
        let mut product = Matrix3::identity();
        for factor in order.formula().split(' ') {
            let letters: Vec<char> = factor.chars().collect();
            product *= about(letters[1], angles["abc".find(letters[3]).unwrap()]);
        }
        assert!((order.rotation(angles).matrix() - product).amax() < 1e-15, "{name}");
        // moving axes: the first letter is the first factor; fixed ones: the last factor
        let first = order.formula().chars().nth(1).unwrap();
        let axes = name.split('-').nth(1).unwrap();
        let expected = if name.starts_with("moving") { axes.chars().next() } else { axes.chars().last() };
        assert_eq!(Some(first), expected, "{name}");
    }
    assert_eq!("PI".parse(), Ok(RotationOrder::MOVING_XYZ));
    assert_eq!(RotationOrder::MOVING_XYZ.formula(), "Rx(a) Ry(b) Rz(c)");
    assert_eq!("rpy".parse(), Ok(RotationOrder::default()));
    for text in ["xyz", "fixed-xxy", "moving-xyyx", "", "intrinsic"] {
        assert!(text.parse::<RotationOrder>().is_err(), "{text}");
    }
}

#[test]
fn poses_come_back_from_every_convention() {
    let mut rng = Rng::new(11);
    for round in 0..40 {
        let (one, home) = (pose(&mut rng), pose(&mut rng));
        for convention in conventions(&mut rng) {
            let written = convention.write(&one, &home);
            assert!(written.angles_are_unique, "{convention:?}");
            let [x, y, z] = written.position;
            let [a, b, c] = written.angles;
            let by_angles = convention.read(&[x, y, z, a, b, c], &home).unwrap();
            let [q, r, s, t] = written.quaternion;
            let by_quaternion = convention.read(&[x, y, z, q, r, s, t], &home).unwrap();
            for again in [by_angles, by_quaternion] {
                assert!(
                    difference(&again, &one) < 2e-14,
                    "{round} {convention:?}: {}",
                    difference(&again, &one)
                );
            }
            let text = format!("{x}, {y}, {z}, {a}, {b}, {c}");
            assert_eq!(convention.read_text(&text, &home).unwrap(), by_angles);
        }
    }
}

#[test]
fn angles_near_the_ends_of_the_middle_one_give_the_rotation_back_and_are_called_many() {
    for order in RotationOrder::all() {
        let RotationOrder::Turns(_, [first, _, third]) = order else { continue };
        let ends: [f64; 2] = if first == third { [0.0, 180.0] } else { [90.0, -90.0] };
        for end in ends {
            for off in [0.0, 1e-15, 1e-13, 1e-10, 1e-7, 1e-4] {
                let middle = end - off * (end - 45.0).signum();
                for (a, c) in [(0.0, 0.0), (30.0, 0.0), (0.0, -75.0), (170.0, -160.0)] {
                    let rotation = order.rotation([a, middle, c].map(f64::to_radians));
                    let found = order.angles(&rotation);
                    let error = (order.rotation(found.angles).matrix() - rotation.matrix()).amax();
                    assert!(error < 1e-15, "{order} {middle} {a} {c}: {error:e}");
                    assert_eq!(found.are_unique, off > 1e-6, "{order} {middle}");
                }
            }
        }
    }
    let half = Rotation3::new(Vector3::new(std::f64::consts::PI, 0.0, 0.0));
    assert!(!RotationOrder::Vector.angles(&half).are_unique);
}

#[test]
fn the_point_of_the_pivot_stands_where_the_numbers_say() {
    let mut rng = Rng::new(12);
    for _ in 0..50 {
        let home = pose(&mut rng);
        let pivot = Vector3::from_fn(|_, _| rng.normal());
        let numbers: [f64; 6] = std::array::from_fn(|_| rng.normal());
        let asked = Vector3::new(numbers[0], numbers[1], numbers[2]);
        let mut convention = PoseConvention { pivot: Some(pivot), ..PoseConvention::default() };
        let found = convention.read(&numbers, &home).unwrap();
        assert!((found.transform(&Point3::from(pivot)).coords - asked).amax() < 1e-14);
        convention.relative_to = Some(ListedFrom::Home);
        let moved = convention.read(&numbers, &home).unwrap();
        let at_home = home.transform(&Point3::from(pivot)).coords;
        assert!((moved.transform(&Point3::from(pivot)).coords - at_home - asked).amax() < 1e-14);
        // nothing moves by zeros
        let still = convention.read(&[0.0; 6], &home).unwrap();
        assert!(difference(&still, &home) < 1e-15);
    }
}

#[test]
fn y_up_turns_both_frames_and_leaves_distances() {
    let mut rng = Rng::new(13);
    let convention = PoseConvention { up: Some(UpAxis::Y), ..PoseConvention::default() };
    let home = pose(&mut rng);
    let ours = |v: Vector3<f64>| Point3::new(v.x, -v.z, v.y);
    for _ in 0..50 {
        let theirs = pose(&mut rng);
        let found = convention.in_base_frame(&theirs, &home);
        let (base, platform) = (Vector3::from_fn(|_, _| rng.normal()), Vector3::from_fn(|_, _| rng.normal()));
        let length = (theirs.rotation * platform + theirs.position - base).norm();
        assert!(((found.transform(&ours(platform)) - ours(base)).norm() - length).abs() < 1e-14);
        assert!((found.rotation.matrix().determinant() - 1.0).abs() < 1e-14);
    }
    // yaw about the axis that is up
    let yaw = convention.read(&[0.0, 5.0, 0.0, 0.0, 30.0, 0.0], &home).unwrap();
    let expected = Pose::new([0.0, 0.0, 5.0], crate::geom::Angles::from_degrees([0.0, 0.0, 30.0]));
    assert!(difference(&yaw, &expected) < 1e-15);
}

#[test]
fn the_usual_convention_changes_no_digit_and_says_its_order() {
    let mut rng = Rng::new(14);
    let usual = PoseConvention::default();
    assert!(usual.is_usual());
    for _ in 0..50 {
        let one = pose(&mut rng);
        assert_eq!(usual.as_stated(&one, &pose(&mut rng)), one);
        assert_eq!(usual.in_base_frame(&one, &pose(&mut rng)), one);
        let angles = one.angles();
        assert_eq!(usual.write(&one, &one).angles.map(f64::to_bits), angles.degrees().map(f64::to_bits));
        assert_eq!(RotationOrder::default().rotation(angles.radians()), Rotation3::from(angles));
    }
    assert_eq!(
        usual.sentences(),
        "Angles a, b, c are in degrees in the order fixed-xyz: R = Rz(c) Ry(b) Rx(a)."
    );
    let other = PoseConvention {
        relative_to: Some(ListedFrom::Home),
        pivot: Some(Vector3::new(0.0, 0.0, 50.0)),
        ..PoseConvention::default()
    };
    let machine = PoseConvention {
        rotation_order: Some(RotationOrder::MOVING_XYZ),
        pivot: Some(Vector3::x()),
        ..PoseConvention::default()
    };
    let both = other.over(&machine);
    assert!(!both.is_usual());
    assert_eq!((both.order(), both.pivot), (RotationOrder::MOVING_XYZ, other.pivot));
    assert!(both.sentences().contains("(0, 0, 50)") && both.sentences().contains("from home"));
}

#[test]
fn one_number_grows_along_its_way_and_the_others_stay() {
    let mut rng = Rng::new(15);
    for _ in 0..20 {
        let (one, home) = (pose(&mut rng), pose(&mut rng));
        for convention in conventions(&mut rng) {
            if convention.order() == RotationOrder::Vector {
                continue;
            }
            let pivot = convention.pivot_on_platform();
            let before = convention.write(&one, &home);
            for (k, [velocity, turn]) in convention.ways(&one, &home).into_iter().enumerate() {
                let step = 1e-4;
                let rotation = Rotation3::new(turn * step) * one.rotation;
                let position = one.position + velocity * step + one.rotation * pivot - rotation * pivot;
                let after = convention.write(&Pose { rotation, position }, &home);
                let change = |w: &WrittenPose, i: usize| if i < 3 { w.position[i] } else { w.angles[i - 3] };
                for i in 0..6 {
                    let unit = if i < 3 { 1.0 } else { convention.angle_unit().of_radians(1.0) };
                    let grown = (change(&after, i) - change(&before, i)) / unit;
                    let expected = if i == k { step } else { 0.0 };
                    assert!((grown - expected).abs() < 1e-9, "{convention:?} {k} {i}: {grown:e}");
                }
            }
        }
    }
}

#[test]
fn matrices_are_read_to_the_digits_they_have_and_refused_where_they_are_unclear() {
    let mut rng = Rng::new(12);
    let usual = PoseConvention::default();
    let rounded = |x: f64, digits: i32| (x * 10.0_f64.powi(digits)).round() / 10.0_f64.powi(digits);
    for _ in 0..40 {
        let (one, home) = (pose(&mut rng), pose(&mut rng));
        let (r, p) = (*one.rotation.matrix(), one.position);
        let rows = |digits: i32| -> Vec<f64> {
            (0..3)
                .flat_map(|i| [0, 1, 2].map(|j| rounded(r[(i, j)], digits)).into_iter().chain([p[i]]))
                .collect()
        };
        for convention in conventions(&mut rng) {
            let stated = convention.as_stated(&one, &home);
            let (r, p) = (*stated.rotation.matrix(), stated.position);
            let twelve: Vec<f64> = (0..3).flat_map(|i| [r[(i, 0)], r[(i, 1)], r[(i, 2)], p[i]]).collect();
            assert!(difference(&convention.read(&twelve, &home).unwrap(), &one) < 2e-14, "{convention:?}");
            let sixteen = [&twelve[..], &[0.0, 0.0, 0.0, 1.0]].concat();
            assert!(difference(&convention.read(&sixteen, &home).unwrap(), &one) < 2e-14);
            let by_columns: Vec<f64> = (0..16).map(|k| sixteen[k % 4 * 4 + k / 4]).collect();
            assert!(difference(&convention.read(&by_columns, &home).unwrap(), &one) < 2e-14);
        }
        for digits in [3, 4, 7, 15] {
            let found = usual.read(&rows(digits), &home).unwrap();
            assert!(difference(&found, &one) < 2.0 * 10.0_f64.powi(-digits), "{digits}");
        }
        let why = |numbers: &[f64]| usual.read(numbers, &home).unwrap_err().to_string();
        // entries with many digits that are no rotation, and entries with two
        let mut sheared = rows(15);
        sheared[1] += 1e-4;
        assert!(why(&sheared).contains("no rotation"), "{}", why(&sheared));
        assert!(why(&rows(1)).contains("no rotation"));
        let mirrored: Vec<f64> =
            rows(15).iter().enumerate().map(|(k, x)| if k % 4 < 3 { -x } else { *x }).collect();
        assert!(why(&mirrored).contains("no rotation"));
        let nine: Vec<f64> = (0..9).map(|k| r[(k / 3, k % 3)]).collect();
        assert!(why(&nine).contains("without a position"), "{}", why(&nine));
        for twelve in [[&nine[..], &[p.x, p.y, p.z]].concat(), [&[p.x, p.y, p.z], &nine[..]].concat()] {
            assert!(why(&twelve).contains("do not tell rows from columns"), "{}", why(&twelve));
        }
    }
    let level = usual.read(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 5.0, 6.0, 7.0], &Pose::identity());
    assert_eq!(level.unwrap(), Pose::shifted(Vector3::new(5.0, 6.0, 7.0)));
}
