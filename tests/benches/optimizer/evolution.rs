//! CMA-ES with restarts: two regimes of population sizes as in BIPOP (Hansen 2009), and two ways to treat requirements.
//! Some runs start from the best answer so far.

use std::sync::atomic::{AtomicUsize, Ordering};

use cmaes::{CMAESOptions, DVector, Mode};
use equipod::methods::num::Rng;

use crate::judge::Judge;
use crate::record::{Record, Rival};

/// Draws for the start of a run; the first feasible ones count.
const DRAWS: usize = 2000;
/// The best of so many feasible draws is the start.
const CHOSEN_FROM: usize = 20;
/// Draws of which the one with the least violation is the start when none is feasible.
const LEAST_OF: usize = 100;
/// Weights of a violation in the runs that may leave the feasible points, in turn; relative to the size of the value.
const PENALTIES: [f64; 3] = [10.0, 100.0, 1000.0];
/// Given points that a thread starts from.
const GIVEN: usize = 4;
/// Weight of the squared distance from the box; inside there is none.
const OUTSIDE: f64 = 1e-3;

/// The treatment of requirements in a run.
#[derive(Debug, Clone, Copy)]
enum Handling {
    /// Every feasible point is before every other one; those are ranked by their violation.
    FeasibleFirst,
    /// Value less this multiple of the violation.
    Penalty(f64),
}

/// Everything that a run needs.
struct Arena<'a> {
    judge: &'a dyn Judge,
    record: &'a Record,
    asked: &'a AtomicUsize,
    /// Seconds of processor time.
    budget: f64,
}

impl Arena<'_> {
    fn is_over(&self) -> bool {
        self.record.clock.spent().cpu >= self.budget
    }

    /// Variables of a point of the unit cube; points outside are moved onto its boundary.
    fn variables(&self, u: &[f64]) -> Vec<f64> {
        let at = |(u, b): (&f64, &(f64, f64))| b.0 + (b.1 - b.0) * u.clamp(0.0, 1.0);
        u.iter().zip(self.judge.bounds()).map(at).collect()
    }

    fn merit(&self, u: &[f64], handling: Handling) -> f64 {
        self.asked.fetch_add(1, Ordering::Relaxed);
        if u.iter().any(|u| !u.is_finite()) {
            return -1e9;
        }
        let outside: f64 = u.iter().map(|u| (u - u.clamp(0.0, 1.0)).powi(2)).sum();
        let x = self.variables(u);
        let violation = self.judge.violation(&x);
        let merit = if violation <= 0.0 {
            self.record.evaluate(self.judge, &x)
        } else {
            match handling {
                Handling::FeasibleFirst => -violation,
                Handling::Penalty(weight) => {
                    let value = self.judge.value(&x);
                    value - weight * value.abs().max(1e-3) * violation
                }
            }
        };
        merit - OUTSIDE * merit.abs().max(1e-3) * outside.min(1e6)
    }

    /// The best of some feasible draws, or the one of the least violation when none is feasible.
    fn start(&self, rng: &mut Rng) -> Vec<f64> {
        let n = self.judge.bounds().len();
        let mut best: Option<(f64, Vec<f64>)> = None;
        let mut feasible = 0;
        for _ in 0..DRAWS {
            let u: Vec<f64> = (0..n).map(|_| rng.unit()).collect();
            let x = self.variables(&u);
            if !self.judge.is_feasible(&x) {
                if self.is_over() {
                    break;
                }
                continue;
            }
            let value = self.record.evaluate(self.judge, &x);
            if best.as_ref().is_none_or(|b| value > b.0) {
                best = Some((value, u));
            }
            feasible += 1;
            if feasible == CHOSEN_FROM {
                break;
            }
        }
        if best.is_none() {
            for _ in 0..LEAST_OF {
                let u: Vec<f64> = (0..n).map(|_| rng.unit()).collect();
                let violation = self.judge.violation(&self.variables(&u));
                if best.as_ref().is_none_or(|b| -violation > b.0) {
                    best = Some((-violation, u));
                }
            }
        }
        best.map_or(vec![0.5; n], |b| b.1)
    }

    /// Variables as a point of the unit cube.
    fn cube(&self, x: &[f64]) -> Vec<f64> {
        let at = |(x, b): (&f64, &(f64, f64))| if b.1 > b.0 { (x - b.0) / (b.1 - b.0) } else { 0.0 };
        x.iter().zip(self.judge.bounds()).map(at).collect()
    }

    /// The best answer so far as a point of the unit cube.
    fn champion(&self) -> Option<Vec<f64>> {
        let x = self.record.best();
        (!x.is_empty()).then(|| self.cube(&x))
    }

    /// One run, at most `most` evaluations; how many it took.
    fn run(&self, run: &Run, seed: u64) -> usize {
        let f = |u: &DVector<f64>| self.merit(u.as_slice(), run.handling);
        let options = CMAESOptions::new(run.mean.clone(), run.step)
            .mode(Mode::Maximize)
            .population_size(run.population)
            .tol_fun(1e-13)
            .seed(seed);
        let Ok(mut state) = options.build(f) else { return 0 };
        while state.next().is_none() && state.function_evals() < run.most && !self.is_over() {}
        state.function_evals()
    }
}

struct Run {
    mean: Vec<f64>,
    step: f64,
    population: usize,
    most: usize,
    handling: Handling,
}

/// Restarts on every thread until the processor time of all of them together is used up; the first ones from the points
/// given, best last.
pub(crate) fn evolution(
    judge: &dyn Judge,
    given: &[Vec<f64>],
    budget: f64,
    threads: usize,
    seed: u64,
) -> Rival {
    let record = Record::new();
    let asked = AtomicUsize::new(0);
    let arena = Arena { judge, record: &record, asked: &asked, budget };
    std::thread::scope(|scope| {
        for k in 0..threads.max(1) {
            let arena = &arena;
            // every thread takes its share of the points
            let own: Vec<Vec<f64>> =
                given.iter().rev().skip(k).step_by(threads.max(1)).take(GIVEN).rev().cloned().collect();
            scope.spawn(move || restarts(arena, own, &mut Rng::stream(seed ^ 0xc3a5, k as u64)));
        }
    });
    Rival { draws: asked.into_inner(), ..record.finish(judge) }
}

fn restarts(arena: &Arena<'_>, mut given: Vec<Vec<f64>>, rng: &mut Rng) {
    let n = arena.judge.bounds().len();
    let smallest = CMAESOptions::new(vec![0.5; n], 0.25).population_size;
    let (mut large, mut large_total, mut small_total, mut last_large) = (smallest, 0, 0, 0);
    let mut number = 0usize;
    while !arena.is_over() {
        let handling = if number.is_multiple_of(2) {
            Handling::FeasibleFirst
        } else {
            Handling::Penalty(PENALTIES[number / 2 % PENALTIES.len()])
        };
        // every fourth run works on the best answer of all runs
        let champion = (number % 4 == 3).then(|| arena.champion()).flatten();
        let seed = rng.next_u64();
        let u = rng.unit();
        if let Some(x) = given.pop() {
            let mean = arena.cube(&x);
            arena.run(&Run { mean, step: 0.1, population: 2 * smallest, most: 20_000, handling }, seed);
        } else if let Some(mean) = champion {
            let step = 0.1 * 10f64.powf(-3.0 * u);
            arena.run(&Run { mean, step, population: 2 * smallest, most: 20_000, handling }, seed);
        } else if last_large > 0 && small_total < large_total {
            let between = (0.5 * large as f64 / smallest as f64).max(1.0).powf(u * u);
            // at least 1
            #[allow(clippy::cast_sign_loss)]
            let population = (smallest as f64 * between) as usize;
            let step = 0.2 * 10f64.powf(-2.0 * rng.unit());
            let run =
                Run { mean: arena.start(rng), step, population, most: (last_large / 2).max(500), handling };
            small_total += arena.run(&run, seed);
        } else {
            let run = Run { mean: arena.start(rng), step: 0.25, population: large, most: 400_000, handling };
            last_large = arena.run(&run, seed);
            large_total += last_large;
            // beyond a few thousand points a generation the start matters more than the size
            large = if large > 2000 { smallest } else { 2 * large };
        }
        number += 1;
    }
}
