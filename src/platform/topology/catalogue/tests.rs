//! The catalogue compared with exact ranks.

use super::*;
use nalgebra::Point3;
use num::Rng;

const PRIME: i128 = (1 << 61) - 1;

/// Rank of the six leg lines modulo a prime, joints at random integer points, all in one frame.
///
/// Rank six modulo a prime implies rank six over the rationals.
fn rank_of_lines(base: [usize; 6], platform: [usize; 6], seed: u64) -> usize {
    let rng = &mut Rng::new(seed);
    let mut joints = || [(); 6].map(|()| [(); 3].map(|()| i128::from(rng.next_u64() >> 44)));
    let (a, b) = (joints(), joints());
    let mut rows: Vec<[i128; 6]> = (0..6)
        .map(|i| {
            let (u, v) = (a[base[i]], b[platform[i]]);
            let d = [v[0] - u[0], v[1] - u[1], v[2] - u[2]];
            let moment = |x: usize, y: usize| u[x] * v[y] - u[y] * v[x];
            [d[0], d[1], d[2], moment(1, 2), moment(2, 0), moment(0, 1)].map(|x| x.rem_euclid(PRIME))
        })
        .collect();
    let mut rank = 0;
    for column in 0..6 {
        let Some(pivot) = (rank..6).find(|r| rows[*r][column] != 0) else { continue };
        rows.swap(rank, pivot);
        let head = rows[rank];
        for row in &mut rows[rank + 1..] {
            // cross-multiplication needs no inverse
            let factor = row[column];
            for (x, h) in row.iter_mut().zip(head) {
                *x = (*x * head[column] % PRIME - factor * h % PRIME).rem_euclid(PRIME);
            }
        }
        rank += 1;
    }
    rank
}

#[test]
fn there_are_34_topologies_that_can_hold_a_platform() {
    let list = catalogue();
    assert_eq!(list.len(), 34);
    assert_eq!((list[0].id(), list[0].name()), ("T01".into(), "6-6".into()));
    assert_eq!(list[33].topology(), standing(Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2])));
    let names: BTreeSet<String> = list.iter().map(|n| n.name()).collect();
    assert_eq!(names.len(), 34);
    for (k, n) in list.iter().enumerate() {
        assert_eq!(n.number(), k + 1);
        assert!(n.topology().base_joints() >= n.topology().platform_joints());
        assert!(n.topology().platform_joints() >= 3);
    }
}

/// The conditions hold exactly if the leg lines have rank six somewhere.
#[test]
fn topologies_are_in_the_catalogue_if_and_only_if_some_platform_is_not_singular() {
    let known: BTreeSet<Topology> = catalogue().into_iter().map(NamedTopology::topology).collect();
    let (mut regular, mut singular) = (BTreeSet::new(), 0);
    for base in shapes() {
        each_partition(&mut [0; 6], 1, 1, &mut |platform| {
            let platform = platform.map(usize::from);
            let rank = rank_of_lines(base, platform, 17);
            assert_eq!(holds(base, platform), rank == 6, "{base:?} {platform:?}: rank {rank}");
            if rank == 6 {
                let _ = regular.insert(standing(Topology::of_legs(base, platform)));
            } else {
                singular += 1;
            }
        });
    }
    assert_eq!(regular, known);
    assert!(singular > 500);
}

#[test]
fn the_classes_of_porta_and_thomas_are_mergers_of_their_representatives() {
    let all = [0, 1, 2, 3, 4, 5];
    let representatives = [
        Topology::of_legs([0, 0, 0, 1, 1, 2], all), // trilaterable
        Topology::of_legs([0, 0, 0, 1, 2, 3], all), // one virtual leg, decoupled
        Topology::of_legs([0, 0, 1, 1, 2, 3], all), // one virtual leg, coupled
        Topology::of_legs([0, 0, 1, 2, 3, 4], all), // two virtual legs
        Topology::of_legs(all, all),
    ];
    let mut sizes = [0; 5];
    for n in catalogue() {
        let t = n.topology();
        let class = representatives.iter().position(|r| t.is_merger_of(*r) || t.exchanged().is_merger_of(*r));
        sizes[class.unwrap()] += 1;
    }
    assert_eq!(sizes, [10, 7, 13, 3, 1]);
}

#[test]
#[ignore = "evidence"]
fn designs_are_recognised_whatever_the_order_of_legs_and_bodies() {
    let rng = &mut Rng::new(5);
    let mut points =
        || -> Vec<Point3<f64>> { (0..6).map(|_| Point3::from([(); 3].map(|()| rng.normal()))).collect() };
    let (a, b) = (points(), points());
    for n in catalogue() {
        let legs = n.topology().legs();
        let order = [3, 1, 5, 0, 4, 2];
        let one = Manipulator::try_new(a.clone(), b.clone(), order.map(|i| legs[i])).unwrap();
        let turned = legs.map(|(x, y)| (y, x));
        let other = Manipulator::try_new(b.clone(), a.clone(), order.map(|i| turned[i])).unwrap();
        assert_eq!(recognise(&one), Ok(Recognised { topology: n, exchanged: false }));
        let symmetric = n.topology().exchanged() == n.topology();
        assert_eq!(recognise(&other), Ok(Recognised { topology: n, exchanged: !symmetric }));
    }
    let four = Manipulator::try_new(a, b, [(0, 0), (0, 1), (0, 2), (0, 3), (1, 4), (2, 5)]).unwrap();
    assert_eq!(recognise(&four), Err(AlwaysSingular::FourLegsAtOneJoint));
}
