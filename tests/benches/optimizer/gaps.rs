//! The gaps that the bound of the offset optimiser proves, on random pairs of triangles.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

use equipod::methods::design::Design;
use equipod::methods::manipulator::{Manipulator, Octahedral};
use equipod::methods::num::Rng;
use equipod::methods::offsets::{OffsetProblem, OffsetSearchOptions, optimize};
use nalgebra::Point3;

use crate::Failure;

/// Least area over that of the equilateral triangle with the longest edge: no slivers.
const FULLNESS: f64 = 0.3;

/// The proof about one pair.
#[derive(Debug, Clone, Copy)]
struct Proved {
    number: u64,
    value: f64,
    gap: f64,
    boxes: usize,
    seconds: f64,
}

fn triangle(rng: &mut Rng, scale: f64) -> Vec<Point3<f64>> {
    loop {
        let mut corner = || {
            let (x, y) = (rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0));
            Point3::new(scale * x, scale * y, 0.0)
        };
        let p: Vec<Point3<f64>> = (0..3).map(|_| corner()).collect();
        let longest = (0..3).map(|i| (p[(i + 1) % 3] - p[i]).norm()).fold(0.0, f64::max);
        let area = 0.5 * (p[1] - p[0]).cross(&(p[2] - p[0])).norm();
        if area > FULLNESS * 3f64.sqrt() / 4.0 * longest * longest {
            return p;
        }
    }
}

/// Pair `number` with the poses of its workspace: both triangles drawn, the platform 0.3 to 1 times as large.
fn problem(number: u64, seed: u64) -> Result<OffsetProblem, Failure> {
    let mut rng = Rng::stream(seed, number);
    let base = triangle(&mut rng, 1.0);
    let ratio = rng.uniform(0.3, 1.0);
    let platform = triangle(&mut rng, ratio);
    let hexagon = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
    let m = Manipulator::try_new(base, platform, hexagon)?;
    let design = Design::new("pair".to_owned(), "m".to_owned(), m.clone());
    let poses = design.workspace_or_default().sample(&design.home_or_default());
    let octahedral = Octahedral::recognise(&m).map_err(|_| "two triangles are not octahedral")?;
    Ok(OffsetProblem::with_defaults(octahedral, poses))
}

fn prove(number: u64, seed: u64) -> Result<Proved, Failure> {
    let p = problem(number, seed)?;
    let options = OffsetSearchOptions { threads: 1, ..OffsetSearchOptions::default() };
    let clock = Instant::now();
    let report = optimize(&p, &options, &mut |_| ControlFlow::Continue(()))?;
    let seconds = clock.elapsed().as_secs_f64();
    let value = report.solution().map_or(0.0, |s| s.recheck.objective);
    let (gap, boxes) = report.bound.map_or((f64::INFINITY, 0), |b| (b.gap, b.boxes));
    Ok(Proved { number, value, gap, boxes, seconds })
}

/// `count` pairs, `threads` at a time, each on one thread.
pub(crate) fn run(count: u64, threads: usize, seed: u64) -> Result<(), Failure> {
    let next = AtomicU64::new(0);
    let found: Mutex<Vec<Proved>> = Mutex::new(Vec::new());
    let failed: Mutex<Option<String>> = Mutex::new(None);
    std::thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                loop {
                    let number = next.fetch_add(1, Ordering::Relaxed);
                    if number >= count {
                        return;
                    }
                    match prove(number, seed) {
                        Ok(x) => {
                            eprintln!(
                                "pair {number}: value {:.5}, gap {:.2} %, {} boxes, {:.1} s",
                                x.value,
                                100.0 * x.gap,
                                x.boxes,
                                x.seconds
                            );
                            found.lock().unwrap_or_else(PoisonError::into_inner).push(x);
                        }
                        Err(e) => {
                            *failed.lock().unwrap_or_else(PoisonError::into_inner) =
                                Some(format!("pair {number}: {e}"));
                        }
                    }
                }
            });
        }
    });
    if let Some(e) = failed.into_inner().unwrap_or_else(PoisonError::into_inner) {
        return Err(e.into());
    }
    let mut found = found.into_inner().unwrap_or_else(PoisonError::into_inner);
    found.sort_by_key(|x| x.number);
    println!("| gap at most | pairs | median s | greatest s |\n|--:|--:|--:|--:|");
    for limit in [0.001, 0.01, 0.1, 1.0, 10.0, f64::INFINITY] {
        let mut seconds: Vec<f64> = found.iter().filter(|x| x.gap <= limit).map(|x| x.seconds).collect();
        seconds.sort_by(f64::total_cmp);
        let median = seconds.get(seconds.len() / 2).copied().unwrap_or(f64::NAN);
        let most = seconds.last().copied().unwrap_or(f64::NAN);
        println!("| {} % | {} | {median:.1} | {most:.1} |", 100.0 * limit, seconds.len());
    }
    let wide = found.iter().filter(|x| x.gap > 0.01);
    let wide = wide.map(|x| format!("{} (value {:.4}, {:.1} %)", x.number, x.value, 100.0 * x.gap));
    println!("\nWider than 1 %: {}.", wide.collect::<Vec<_>>().join(", "));
    Ok(())
}
