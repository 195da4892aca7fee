//! Time of problems with 200 poses, beside a reference in the same run.

use std::hint::black_box;
use std::ops::ControlFlow;
use std::path::Path;

use equipod::methods::num::Rng;
use equipod::methods::offsets::{OffsetSearchOptions, optimize};

use crate::judge::{Judge, OffsetJudge, offset_problem};
use crate::record::Clock;
use crate::{Failure, ROOT, load};

/// Runs of which the medians are taken.
const RUNS: u64 = 15;
/// Judgements of the reference.
const JUDGED: usize = 1000;

fn median(mut x: Vec<f64>) -> f64 {
    x.sort_by(f64::total_cmp);
    x.get(x.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Elapsed seconds of [`JUDGED`] values at all poses, on one thread.
fn reference(judge: &OffsetJudge, seed: u64) -> f64 {
    let mut rng = Rng::new(seed);
    let clock = Clock::start();
    for _ in 0..JUDGED {
        let x: Vec<f64> = judge.bounds().iter().map(|b| rng.uniform(b.0, b.1)).collect();
        black_box(judge.value(&x));
    }
    clock.spent().elapsed
}

/// The published example with 200 poses of its workspace: home, the corners, and points of a Halton sequence and random
/// ones in halves.
pub(crate) fn run(threads: usize) -> Result<(), Failure> {
    let design = load(&Path::new(ROOT).join("designs/rbt-octahedral.toml"))?;
    let home = design.home.ok_or("the design has no home")?;
    let space = design.workspace.space(&home);
    println!(
        "| 200 poses, {threads} threads | median s | least | greatest | processor s | reference s | elapsed / reference |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|");
    for extension in [1.0, 0.0] {
        let (mut times, mut cpu, mut references) = (Vec::new(), Vec::new(), Vec::new());
        for run in 0..RUNS {
            let mut p = offset_problem(&design, extension).ok_or("the design is not octahedral")?;
            // other poses in every run, so that no lucky set is measured
            let mut points = space.cube_points(68, &mut Rng::new(run));
            points.truncate(200);
            p.poses = points.iter().map(|x| space.pose(x)).collect();
            let options = OffsetSearchOptions { threads, seed: run, ..OffsetSearchOptions::default() };
            let clock = Clock::start();
            black_box(optimize(&p, &options, &mut |_| ControlFlow::Continue(()))?);
            let spent = clock.spent();
            times.push(spent.elapsed);
            cpu.push(spent.cpu);
            references.push(reference(&OffsetJudge::new(&p), run));
        }
        let least = times.iter().copied().fold(f64::INFINITY, f64::min);
        let most = times.iter().copied().fold(0.0, f64::max);
        let ratios = times.iter().zip(&references).map(|(t, r)| t / r).collect();
        println!(
            "| extension {extension} | {:.2} | {least:.2} | {most:.2} | {:.2} | {:.2} | {:.2} |",
            median(times.clone()),
            median(cpu),
            median(references),
            median(ratios),
        );
    }
    println!(
        "\nReference: {JUDGED} random offsets judged at the 200 poses, one thread, in the same run; medians of {RUNS} runs with different poses and seeds."
    );
    Ok(())
}
