//! No feasible offsets are ever excluded: families of problems with almost no feasible offsets, judged in exact
//! rationals.

use std::ops::ControlFlow;

use nalgebra::Point3;

use super::branch::{Branch, divide, in_order};
use super::conditioning::worst_case;
use super::limits::{OffsetLimits, OffsetRanges, proved_empty};
use super::problem::OffsetModel;
use super::tests::poses;
use super::{OffsetOutcome, OffsetProblem, OffsetSearchOptions, optimize};
use num::Rng;
use num::conic::ConicTally;
use num::exact::{Rational, approximate, rational};
use platform::manipulator::{Body, Manipulator, Octahedral};
use synthesis::sides;

fn exact(x: f64) -> Rational {
    rational(x).unwrap()
}

fn triangle(rng: &mut Rng, size: f64) -> Vec<Point3<f64>> {
    (0..3).map(|_| Point3::new(size * rng.uniform(-1.0, 1.0), size * rng.uniform(-1.0, 1.0), 0.0)).collect()
}

/// A random octahedral design; every third with whole numbers as coordinates, so that distances can be exact.
fn octahedral(rng: &mut Rng, n: usize) -> Octahedral {
    let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let ratio = 10f64.powi([0, 0, -6, -3, 3, 6][n % 6]);
    loop {
        let (mut base, mut platform) = (triangle(rng, 1.0), triangle(rng, ratio));
        if n.is_multiple_of(3) {
            let whole = |p: &Point3<f64>, size: f64| Point3::from((p.coords * (20.0 / size)).map(f64::round));
            base = base.iter().map(|p| whole(p, 1.0)).collect();
            platform = platform.iter().map(|p| whole(p, ratio)).collect();
        }
        let area = |t: &[Point3<f64>]| (t[1] - t[0]).cross(&(t[2] - t[0])).norm();
        let size = |t: &[Point3<f64>]| t.iter().map(|p| p.coords.amax()).fold(0.0, f64::max);
        if [&base, &platform].iter().all(|t| area(t) > 0.1 * size(t).powi(2))
            && let Ok(m) = Manipulator::try_new(base, platform, legs)
            && let Ok(o) = Octahedral::recognise(&m)
        {
            return o;
        }
    }
}

/// Square of the least distance of two joints of a body, and the size of `det A`: exact.
fn exact_values(o: &Octahedral, t: &[f64; 6]) -> (Rational, Rational) {
    let sides = sides(o, 1.0);
    let mut least: Option<Rational> = None;
    for body in Body::BOTH {
        let mut joints: Vec<[Rational; 3]> = Vec::new();
        for i in (0..6).filter(|i| sides[*i].sliding == body) {
            let place = |x: f64| {
                [0, 1, 2].map(|k| {
                    let (a, b) = (exact(sides[i].start[k]), exact(sides[i].end[k]));
                    &a + (b - &a) * exact(x)
                })
            };
            joints.extend([place(t[i]), place(0.0)]);
        }
        for i in 0..6 {
            for j in 0..i {
                let d: Rational = (0..3)
                    .map(|k| (&joints[i][k] - &joints[j][k]) * (&joints[i][k] - &joints[j][k]))
                    .fold(exact(0.0), |s, x| s + x);
                least = Some(least.map_or(d.clone(), |l| l.min(d)));
            }
        }
    }
    // a deliberately separate evaluation from the tested one
    let (mut free, mut own) = (exact(1.0), exact(1.0));
    for x in t {
        free *= exact(1.0) - exact(*x);
        own *= exact(*x);
    }
    let det = free - own;
    (least.unwrap(), if det < exact(0.0) { -det } else { det })
}

/// The greatest double whose square is at most `x`.
fn root_below(x: &Rational) -> f64 {
    let mut r = approximate(x).sqrt();
    while &(exact(r) * exact(r)) > x {
        r = r.next_down();
    }
    while &(exact(r.next_up()) * exact(r.next_up())) <= x {
        r = r.next_up();
    }
    r
}

fn below(x: &Rational) -> f64 {
    let r = approximate(x);
    if &exact(r) > x { r.next_down() } else { r }
}

/// A problem that given offsets meet without margin in distance, determinant and, in part, bounds.
fn barely(rng: &mut Rng, n: usize) -> (OffsetProblem, [f64; 6]) {
    loop {
        let o = octahedral(rng, n);
        // sometimes at the bounds, as for joints that may not leave their edges
        let t: [f64; 6] = std::array::from_fn(|_| match n % 5 {
            0 => rng.uniform(-1.0, 2.0),
            1 => (rng.uniform(-1.0, 2.0) * 8.0).round() / 8.0,
            2 => [-1.0, 2.0, 0.5, 0.25][(rng.next_u64() % 4) as usize],
            3 => rng.uniform(0.02, 0.98),
            _ => [1.0 - 1e-6, 1e-6, -1e-9, 0.5][(rng.next_u64() % 4) as usize] + 1e-3 * rng.unit(),
        });
        let (distance, det) = exact_values(&o, &t);
        if distance == exact(0.0) || det == exact(0.0) {
            continue;
        }
        let mut p = OffsetProblem::with_defaults(o, poses());
        (p.min_joint_distance, p.min_abs_det) = (root_below(&distance), below(&det));
        if p.min_joint_distance > 0.0 && p.min_abs_det > 0.0 && p.min_joint_distance.is_normal() {
            assert!(p.margins(&t).unwrap().all_met(), "{t:?}");
            return (p, t);
        }
    }
}

/// Ranges about offsets, with the offsets at an end of some.
fn around(t: &[f64; 6], rng: &mut Rng) -> OffsetRanges {
    t.map(|x| {
        let width = 10f64.powf(rng.uniform(-13.0, 0.0));
        match (rng.next_u64() % 3) as usize {
            0 => (x, x + width),
            1 => (x - width, x),
            _ => (x - 0.3 * width, x + 0.7 * width),
        }
    })
}

#[test]
#[ignore = "evidence"]
fn offsets_that_meet_the_limits_exactly_are_in_a_box_and_in_no_excluded_one() {
    let mut rng = Rng::new(41);
    for n in 0..60 {
        let (p, t) = barely(&mut rng, n);
        let limits = OffsetLimits::new(&p);
        assert_eq!(limits.vertices_too_close(), None, "{n}");
        for _ in 0..20 {
            let bounds = around(&t, &mut rng);
            assert!(!limits.is_empty(&bounds), "{n}: {t:?} in {bounds:?}");
            for i in 0..6 {
                let left = limits.room(i, bounds[i]);
                assert!(
                    left.iter().any(|(low, high)| (*low..=*high).contains(&t[i])),
                    "{n}: {} {left:?}",
                    t[i]
                );
            }
        }
        let m = OffsetModel::new(&p);
        let own = &divide(&m, &limits)[Branch::of(&t).index()];
        let inside = |b: &OffsetRanges| t.iter().zip(b).all(|(t, b)| (b.0..=b.1).contains(t));
        assert!(own.boxes.iter().any(inside), "{n}: {t:?} {:?}", own.conflicts);
        let det = synthesis::offset_determinant(&t);
        let cells: Vec<_> =
            own.cells.iter().filter(|c| inside(&c.outer) && c.sign * det > 0.0 && in_order(c, &t)).collect();
        assert!(!cells.is_empty(), "{n}");
        assert!(
            cells.iter().all(|c| proved_empty(c, &limits, &ConicTally::default()).is_none()),
            "{n}: {t:?}"
        );
    }
}

/// Negative control: exclusion by more than rounding is detected.
#[test]
fn a_limit_raised_by_a_billionth_is_seen_to_exclude() {
    let mut rng = Rng::new(43);
    let mut excluded = 0;
    for n in 0..40 {
        let (mut p, t) = barely(&mut rng, n);
        if n % 2 == 0 {
            p.min_joint_distance *= 1.0 + 1e-9;
        } else {
            p.min_abs_det *= 1.0 + 1e-9;
        }
        let limits = OffsetLimits::new(&p);
        let point = t.map(|x| (x, x));
        let gone = limits.vertices_too_close().is_some()
            || limits.is_empty(&point)
            || (0..6).any(|i| limits.room(i, point[i]).is_empty());
        excluded += usize::from(gone);
    }
    assert!(excluded > 36, "{excluded} of 40");
}

fn quick() -> OffsetSearchOptions {
    OffsetSearchOptions {
        samples: 2,
        climbs: 1,
        polished: 1,
        starts: 1,
        boxes: 60,
        ..OffsetSearchOptions::default()
    }
}

/// Windows of 1e-12 to 1e-6 of an edge about offsets that meet the limits without margin.
#[test]
fn thin_feasible_windows_are_never_infeasible_and_never_above_the_bound() {
    let mut rng = Rng::new(47);
    let (mut found, mut bounded) = (0, 0);
    for n in 0..24 {
        let (mut p, t) = barely(&mut rng, n);
        let width = 10f64.powf(-6.0 - (n % 7) as f64);
        p.bounds = t.map(|x| if rng.unit() < 0.5 { (x, x + width) } else { (x - width, x) });
        let r = optimize(&p, &quick(), &mut |_| ControlFlow::Continue(())).unwrap();
        assert_ne!(r.outcome, OffsetOutcome::Infeasible, "{n}: {t:?} meets {p:?}");
        if let Some(s) = r.solution() {
            found += 1;
            assert!(p.margins(&s.offsets).unwrap().all_met());
        }
        if let Some(b) = r.bound {
            bounded += 1;
            let value = worst_case(&OffsetModel::new(&p).poses, &t).0;
            assert!(value <= b.upper * (1.0 + 1e-12), "{n}: {value} above {b:?}");
        }
    }
    assert!(found >= 8 && bounded >= 4, "{found} found, {bounded} bounded");
}
