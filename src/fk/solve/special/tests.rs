use super::*;
use num::Rng;

/// A rational number of few digits that is no double.
fn small(rng: &mut Rng) -> Surd {
    let n = (rng.next_u64() % 96).cast_signed() - 48;
    let d = [7, 11, 13][(rng.next_u64() % 3) as usize];
    let n = if n % d == 0 { n + 1 } else { n };
    Surd::integer(n).times(&Surd::integer(d).inverse().unwrap()).unwrap()
}

fn point(rng: &mut Rng) -> [Surd; 3] {
    std::array::from_fn(|_| small(rng))
}

fn flat(rng: &mut Rng) -> [Surd; 3] {
    [small(rng), small(rng), Surd::zero()]
}

fn mixed(p: &[Surd; 3], q: &[Surd; 3], t: &Surd) -> [Surd; 3] {
    std::array::from_fn(|k| p[k].plus(&q[k].minus(&p[k]).unwrap().times(t).unwrap()).unwrap())
}

/// A platform with exact joints.
fn exact(base: [[Surd; 3]; 6], platform: [[Surd; 3]; 6]) -> Manipulator {
    let mut platform = platform.into_iter();
    let ends = base.map(|a| [a, platform.next().unwrap()]);
    Manipulator::from_exact_ends(&ends).unwrap()
}

fn isolated_points(m: &Manipulator, seed: u64) -> Option<PointsAtInfinity> {
    special_position(m, seed)?.at_infinity
}

fn bound(m: &Manipulator) -> usize {
    40 - isolated_points(m, 1).map_or(0, PointsAtInfinity::weight)
}

const OCTAHEDRON: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];

fn octahedron(rng: &mut Rng) -> ([[Surd; 3]; 6], [[Surd; 3]; 6]) {
    let (p, q): ([_; 3], [_; 3]) = (std::array::from_fn(|_| point(rng)), std::array::from_fn(|_| point(rng)));
    (OCTAHEDRON.map(|l| p[l.0].clone()), OCTAHEDRON.map(|l| q[l.1].clone()))
}

/// A semi-regular hexagon: two points on a circle about the origin, in the field of the square root of 3, turned by
/// thirds.
fn semi_regular(rng: &mut Rng) -> [[Surd; 3]; 6] {
    let (half, root) = (Surd::integer(2).inverse().unwrap(), Surd::integer(3).sqrt().unwrap());
    let (c, s) = (half.negated(), root.times(&half).unwrap());
    let turn = |p: &[Surd; 3]| -> [Surd; 3] {
        let [x, y, z] = p;
        [
            c.times(x).unwrap().minus(&s.times(y).unwrap()).unwrap(),
            s.times(x).unwrap().plus(&c.times(y).unwrap()).unwrap(),
            z.clone(),
        ]
    };
    let u = flat(rng);
    let v = [u[0].clone(), u[1].negated(), u[2].clone()];
    let (u1, v1) = (turn(&u), turn(&v));
    let (u2, v2) = (turn(&u1), turn(&v1));
    [u, v, u1, v1, u2, v2]
}

#[test]
fn octahedral_platforms_and_their_equivalents_have_twelve_double_points() {
    let mut rng = Rng::new(3);
    for _ in 0..4 {
        let (a, b) = octahedron(&mut rng);
        assert_eq!(
            isolated_points(&exact(a.clone(), b.clone()), 1),
            Some(PointsAtInfinity { butterflies: 3, inversions: 0 })
        );
        // leg ends moved along the edges
        let slid = |p: &[[Surd; 3]; 6], rng: &mut Rng| -> [[Surd; 3]; 6] {
            std::array::from_fn(|i| mixed(&p[i], &p[(i + 1) % 6], &small(rng)))
        };
        let (a, b) = (slid(&a, &mut rng), slid(&b, &mut rng));
        assert_eq!(bound(&exact(a.clone(), b.clone())), 16);
        // the same joints as doubles are no such platform
        let rounded = exact(a, b).legs();
        assert_eq!(bound(&Manipulator::from_legs(rounded).unwrap()), 40);
    }
}

#[test]
fn symmetric_hexapods_have_twelve_points_and_skew_ones_none() {
    let mut rng = Rng::new(8);
    let mut found = 0;
    for _ in 0..4 {
        let (a, mut b) = (semi_regular(&mut rng), semi_regular(&mut rng));
        b.rotate_left(1);
        assert_eq!(
            isolated_points(&exact(a.clone(), b.clone()), 1),
            Some(PointsAtInfinity { butterflies: 0, inversions: 3 })
        );
        found += 1;
        let mut moved = b;
        moved[0][0] = moved[0][0].plus(&Surd::integer(1)).unwrap();
        assert_eq!(bound(&exact(a, moved)), 40);
    }
    assert_eq!(found, 4);
}

#[test]
fn projective_images_have_four_points() {
    let mut rng = Rng::new(11);
    for _ in 0..3 {
        let a: [[Surd; 3]; 6] = std::array::from_fn(|_| flat(&mut rng));
        let m: [[Surd; 3]; 3] = std::array::from_fn(|_| point(&mut rng));
        let image = |p: &[Surd; 3]| -> [Surd; 3] {
            let row = |k: usize| {
                let x = m[k][0].times(&p[0]).unwrap().plus(&m[k][1].times(&p[1]).unwrap()).unwrap();
                x.plus(&m[k][2]).unwrap()
            };
            let w = row(2).inverse().unwrap();
            [row(0).times(&w).unwrap(), row(1).times(&w).unwrap(), Surd::zero()]
        };
        let b = a.each_ref().map(image);
        // each of them counts twice, which is not shown: such platforms have 32 poses
        assert_eq!(
            isolated_points(&exact(a, b), 1),
            Some(PointsAtInfinity { butterflies: 0, inversions: 1 })
        );
    }
}

#[test]
fn four_joints_on_a_line_have_four_double_points_and_three_none() {
    let mut rng = Rng::new(20);
    for (count, poses) in [(3, 40), (4, 32)] {
        let mut a: [[Surd; 3]; 6] = std::array::from_fn(|_| point(&mut rng));
        let b: [[Surd; 3]; 6] = std::array::from_fn(|_| point(&mut rng));
        let (p, q) = (a[0].clone(), a[5].clone());
        for end in &mut a[..count] {
            *end = mixed(&p, &q, &small(&mut rng));
        }
        a[5] = point(&mut rng);
        assert_eq!(bound(&exact(a.clone(), b.clone())), poses);
        assert_eq!(bound(&exact(b, a)), poses, "bodies exchanged");
    }
}

#[test]
fn curves_at_infinity_are_no_isolated_points() {
    let mut rng = Rng::new(31);
    // affine images: curves at infinity
    let a: [[Surd; 3]; 6] = std::array::from_fn(|_| flat(&mut rng));
    let t: [Surd; 4] = std::array::from_fn(|_| small(&mut rng));
    let image = |p: &[Surd; 3]| -> [Surd; 3] {
        let row =
            |k: usize| t[2 * k].times(&p[0]).unwrap().plus(&t[2 * k + 1].times(&p[1]).unwrap()).unwrap();
        [row(0), row(1), Surd::zero()]
    };
    let b = a.each_ref().map(image);
    let affine = special_position(&exact(a.clone(), b.clone()), 1).unwrap();
    assert_eq!((affine.at_infinity, affine.affine_hexagons, affine.on_a_line), (None, true, 2));
    let mut moved = b;
    moved[3][0] = moved[3][0].plus(&Surd::integer(1)).unwrap();
    assert!(!special_position(&exact(a, moved), 1).unwrap().affine_hexagons);
    // three legs in one joint, the ends of the others on a line: a line of the base turns about the joint
    let mut a: [[Surd; 3]; 6] = std::array::from_fn(|_| point(&mut rng));
    let mut b: [[Surd; 3]; 6] = std::array::from_fn(|_| point(&mut rng));
    (a[1], a[2]) = (a[0].clone(), a[0].clone());
    b[5] = mixed(&b[3], &b[4], &small(&mut rng));
    a[4] = mixed(&a[0], &a[3], &small(&mut rng));
    assert_eq!(isolated_points(&exact(a, b), 1), None);
}

#[test]
fn general_platforms_have_none() {
    let mut rng = Rng::new(40);
    for planar in [false, true] {
        let mut any = || if planar { flat(&mut rng) } else { point(&mut rng) };
        let (a, b) = (std::array::from_fn(|_| any()), std::array::from_fn(|_| any()));
        assert_eq!(bound(&exact(a, b)), 40);
    }
}
