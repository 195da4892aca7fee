//! The judge and the verdict of the comparison of the optimiser with random designs and CMA-ES (`cargo bench --bench optimizer`): they can find a loss.

use std::ops::ControlFlow;
use std::path::Path;

use equipod::design::{Format, parse};
use equipod::num::Rng;
use equipod::offsets::{OffsetProblem, OptimizeOptions, optimize};
use nalgebra::Vector3;

#[path = "../benches/optimizer/cap.rs"]
mod cap;
#[path = "../benches/optimizer/judge.rs"]
mod judge;
#[path = "../benches/optimizer/verdict.rs"]
mod verdict;

use judge::{Judge, OffsetJudge, offset_problem};
use verdict::{Judged, Verdict};

fn problem(extension: f64) -> OffsetProblem {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("designs/rbt-octahedral.toml");
    let text = std::fs::read_to_string(path).unwrap();
    offset_problem(&parse(&text, Format::Toml).unwrap().0, extension).unwrap()
}

fn judged(judge: &OffsetJudge, t: &[f64; 6]) -> Judged {
    judge.last_word(t)
}

/// Random offsets within the bounds.
fn draw(judge: &OffsetJudge, rng: &mut Rng) -> [f64; 6] {
    std::array::from_fn(|i| rng.uniform(judge.bounds()[i].0, judge.bounds()[i].1))
}

#[test]
fn the_judge_and_the_optimisers_own_check_agree() {
    let p = problem(1.0);
    let judge = OffsetJudge::new(&p);
    let mut rng = Rng::new(3);
    let (mut met, mut missed) = (0, 0);
    for _ in 0..200 {
        let t = draw(&judge, &mut rng);
        let own = p.recheck(&t).unwrap();
        assert!((judge.value(&t) - own.objective).abs() < 1e-12);
        assert_eq!(judge.violation(&t) <= 0.0, own.margins.all_met(), "{t:?}");
        *(if own.margins.all_met() { &mut met } else { &mut missed }) += 1;
    }
    assert!(met > 20 && missed > 20, "{met} {missed}");
}

/// The optimum, and answers that are worse or not feasible, before the same rival.
#[test]
fn a_worse_answer_is_found_out() {
    let p = problem(0.0);
    let judge = OffsetJudge::new(&p);
    let o = OptimizeOptions { gap: 0.05, ..OptimizeOptions::default() };
    let report = optimize(&p, &o, &mut |_| ControlFlow::Continue(())).unwrap();
    let t = report.solution().unwrap().offsets;
    let best = judged(&judge, &t);
    assert!(best.violation <= 0.0 && best.value > 0.09);
    assert_eq!(judge.confirm(&t), Some(best.value));

    let mut rng = Rng::new(8);
    let feasible = std::iter::repeat_with(|| draw(&judge, &mut rng)).filter(|t| judge.is_feasible(t));
    let random: Vec<Judged> = feasible.take(10).map(|t| judged(&judge, &t)).collect();
    assert!(random.iter().all(|r| matches!(Verdict::of(Some(best), Some(*r)), Verdict::Beats(_))));
    // the roles exchanged: what a single random start would have given
    assert!(random.iter().all(|r| Verdict::of(Some(*r), Some(best)).is_loss()));

    // a little away from the vertices: feasible, and worse by a few millionths
    let inward = t.map(|t| t + 2e-5 * (0.5 - t));
    let worse = judged(&judge, &inward);
    assert!(worse.violation <= 0.0);
    let Verdict::Loses(loss) = Verdict::of(Some(worse), Some(best)) else { panic!("{worse:?} {best:?}") };
    assert!(loss < 1e-3, "{loss}");
    // a little towards them: better, but too close
    let outward = judged(&judge, &t.map(|t| t - 2e-5 * (0.5 - t)));
    assert!(outward.violation > 0.0 && outward.value > best.value);
    assert_eq!(Verdict::of(Some(outward), Some(best)), Verdict::NoAnswer);
    assert_eq!(Verdict::of(Some(best), Some(outward)), Verdict::Unopposed);
}

#[test]
fn values_within_a_millionth_are_equal_and_nothing_is_no_answer() {
    let at = |value: f64| Some(Judged { value, violation: 0.0 });
    assert!(matches!(Verdict::of(at(1.0), at(1.0 + 9e-7)), Verdict::Equals(_)));
    assert!(matches!(Verdict::of(at(1.0), at(1.0 + 2e-6)), Verdict::Loses(_)));
    assert!(matches!(Verdict::of(at(1.0 + 2e-6), at(1.0)), Verdict::Beats(_)));
    // costs are negative values
    assert!(matches!(Verdict::of(at(-2.0), at(-1.0)), Verdict::Loses(_)));
    assert!(matches!(Verdict::of(at(-1.0), at(-1.1)), Verdict::Beats(_)));
    assert!(Verdict::of(at(0.0), at(0.1)).is_loss());
    for none in [None, at(f64::NAN), at(f64::INFINITY)] {
        assert_eq!(Verdict::of(none, at(0.1)), Verdict::NoAnswer);
        assert!(Verdict::of(none, at(0.1)).is_loss());
        assert_eq!(Verdict::of(at(0.1), none), Verdict::Unopposed);
    }
}

/// The axes that the judge of problems with requirements chooses: no direction nearby holds all legs in a smaller cap.
#[test]
fn the_smallest_cap_cannot_be_made_smaller() {
    let mut rng = Rng::new(12);
    for count in [1, 2, 3, 40, 200] {
        let tilted = |rng: &mut Rng| Vector3::new(0.3 * rng.normal(), 0.2 * rng.normal(), 1.0).normalize();
        let all: Vec<Vector3<f64>> = (0..count).map(|_| tilted(&mut rng)).collect();
        let least = |c: &Vector3<f64>| all.iter().map(|u| u.dot(c)).fold(f64::INFINITY, f64::min);
        let c = cap::centre(&all);
        assert!((c.norm() - 1.0).abs() < 1e-12);
        for step in [1e-1, 1e-3, 1e-5] {
            for _ in 0..200 {
                let near = (c + Vector3::from_fn(|_, _| step * rng.normal())).normalize();
                assert!(least(&near) <= least(&c) + 1e-13);
            }
        }
    }
}
