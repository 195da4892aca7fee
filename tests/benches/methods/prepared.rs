//! The cost of a design that is solved again and again: preparation, and a solve with certificates, on one thread.
//!
//! Run with
//! `cargo bench --package equipod-benches --bench prepared -- [method=METHOD] [lengths=N] [CLASS | translations ...]`.
//! Times of a solve are medians over designs and lengths, each solved once. They are in microseconds and in units of
//! `eig40`, the eigenvalues of a random 40 x 40 matrix, measured in the same run.

use std::hint::black_box;
use std::time::Instant;

use equipod::methods::bench::{Class, LengthsFrom, Problem, problem, reference_times};
use equipod::methods::fk::{FkOptions, FkSolutions, ForwardKinematics, Method, solver};
use equipod::methods::geom::{Pose, random_rotation};
use equipod::methods::manipulator::{Manipulator, SquaredLegLengths};
use equipod::methods::num::Rng;
use nalgebra::{Point3, Rotation3, Vector3};

const DESIGNS: u64 = 10;
const LENGTHS: usize = 20;
const SEED: u64 = 6;

/// Lengths of poses as the class has them: near home for hexapods, otherwise any.
fn lengths(p: &Problem, row: Row, rng: &mut Rng) -> Option<SquaredLegLengths> {
    let random = Vector3::from_fn(|_, _| rng.normal());
    let pose = match (&p.pose, row) {
        (Some(drawn), Row::Translations) => Pose { position: drawn.position + random * 0.3, ..*drawn },
        (Some(drawn), Row::Of(Class::Hexapod)) => {
            let turn = Rotation3::new(random * 0.1);
            let shift = Vector3::from_fn(|_, _| rng.uniform(-0.2, 0.2));
            Pose { rotation: turn * drawn.rotation, position: drawn.position + shift }
        }
        _ => Pose { rotation: random_rotation(rng), position: random },
    };
    pose.squared_lengths(&p.manipulator)
}

#[derive(Default)]
struct Times {
    first: Vec<f64>,
    preparation: Vec<f64>,
    solve: Vec<f64>,
    unprepared: usize,
    poses: Vec<usize>,
    complete: usize,
    steps: Vec<f64>,
    different: usize,
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let out = black_box(work());
    (out, start.elapsed().as_secs_f64() * 1e6)
}

fn quantile(times: &mut [f64], q: f64) -> f64 {
    times.sort_by(f64::total_cmp);
    let last = times.len().saturating_sub(1);
    // the first that has the share of all before it
    let found = times.iter().enumerate().find(|(k, _)| *k as f64 >= (q * last as f64).round());
    found.map_or(f64::NAN, |(_, time)| *time)
}

/// Whether both have as many certified poses, and each has those of the other. Two poses closer than the tolerance of
/// the comparison are near to either.
fn same(m: &Manipulator, a: &FkSolutions, b: &FkSolutions) -> bool {
    let has = |one: &FkSolutions, other: &FkSolutions| {
        one.roots.iter().all(|r| {
            let scale = r.pose.rotation.iter().map(|z| z.norm()).fold(1.0, f64::max);
            other.roots.iter().any(|o| o.pose.distance(&r.pose, m.size()) < 1e-6 * scale)
        })
    };
    a.roots.len() == b.roots.len() && has(a, b) && has(b, a)
}

/// The measured problems: a class, or octahedral designs of parallel triangles at pure translations.
#[derive(Clone, Copy)]
enum Row {
    Of(Class),
    Translations,
}

impl Row {
    const TRANSLATIONS: &str = "translations";

    fn name(self) -> String {
        match self {
            Self::Of(class) => class.name().into_owned(),
            Self::Translations => Self::TRANSLATIONS.to_owned(),
        }
    }

    fn from_name(name: &str) -> Option<Self> {
        let class = || Class::from_name(name).map(Self::Of);
        if name == Self::TRANSLATIONS { Some(Self::Translations) } else { class() }
    }

    fn problem(self, k: u64) -> Result<Problem, Box<dyn std::error::Error>> {
        match self {
            Self::Of(class) => Ok(problem(class, LengthsFrom::Pose, SEED, k)?),
            Self::Translations => {
                let mut rng = Rng::stream(SEED, k);
                let mut point = || Point3::new(rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0), 0.0);
                let base = [point(), point(), point()];
                let ratio = rng.uniform(0.3, 1.3);
                let middle =
                    |i: usize, j: usize| Point3::from((base[i].coords + base[j].coords) * (0.5 * ratio));
                let legs = [(0, 0), (1, 0), (1, 1), (2, 1), (2, 2), (0, 2)];
                let platform = vec![middle(0, 1), middle(1, 2), middle(2, 0)];
                let manipulator = Manipulator::try_new(base.to_vec(), platform, legs)?;
                let position = Vector3::new(0.0, 0.0, 2.0);
                let pose = Pose { rotation: Rotation3::identity(), position };
                let squares = pose.squared_lengths(&manipulator).ok_or("overflow")?;
                Ok(Problem { manipulator, squares, pose: Some(pose) })
            }
        }
    }
}

fn row_times(
    row: Row,
    lengths_of_a_design: usize,
    method: &dyn ForwardKinematics,
) -> Result<Times, Box<dyn std::error::Error>> {
    let options = FkOptions::default();
    let mut times = Times::default();
    for k in 0..DESIGNS {
        let p = row.problem(k)?;
        let m = &p.manipulator;
        let (first, time) = timed(|| method.solve(m, &p.squares, &options));
        times.first.push(time);
        let (prepared, time) = timed(|| method.prepare(m, &options));
        times.preparation.push(time);
        let Some(prepared) = prepared else {
            times.unprepared += 1;
            continue;
        };
        times.different += usize::from(!same(m, &first?, &prepared.solve(&p.squares, &options)?));
        let mut rng = Rng::stream(SEED, k);
        for _ in 0..lengths_of_a_design {
            let Some(s) = lengths(&p, row, &mut rng) else { continue };
            let (found, time) = timed(|| prepared.solve(&s, &options));
            times.solve.push(time);
            let found = found?;
            let steps: u32 = found.paths.iter().map(|p| p.steps + p.rejections).sum();
            times.steps.push(f64::from(steps) / found.paths.len().max(1) as f64);
            times.complete += usize::from(found.is_complete());
            times.poses.push(found.roots.len());
        }
    }
    Ok(times)
}

#[allow(clippy::print_stdout, reason = "a table for people")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let value = |key: &str| words.iter().find_map(|w| w.strip_prefix(key));
    let method: Option<Method> = value("method=").map(str::parse).transpose()?;
    let lengths_of_a_design = value("lengths=").map(str::parse).transpose()?.unwrap_or(LENGTHS);
    let names: Vec<&String> = words.iter().filter(|w| !w.contains('=')).collect();
    let rows: Vec<Row> = if names.is_empty() {
        let classes = Class::ALL.into_iter().chain(Class::topologies());
        classes.map(Row::Of).chain([Row::Translations]).collect()
    } else {
        names.iter().filter_map(|n| Row::from_name(n)).collect()
    };
    println!("times in microseconds, [eig40]");
    for row in rows {
        let unit = reference_times(1)?.eig40;
        let mut t = row_times(row, lengths_of_a_design, solver(method).as_ref())?;
        t.poses.sort_unstable();
        let poses = t.poses.get(t.poses.len() / 2).copied().unwrap_or(0);
        let (median, late) = (quantile(&mut t.solve, 0.5), quantile(&mut t.solve, 0.99));
        println!(
            "{:<16} {poses:>2} poses, first {:>7.0}, preparation {:>7.0}, solve {median:>7.1} [{:.3}], 99 % {late:>8.1}; eig40 {unit:.0}; {:.1} steps a path, complete {} of {}, other roots {} of {}, not prepared {}",
            row.name(),
            quantile(&mut t.first, 0.5),
            quantile(&mut t.preparation, 0.5),
            median / unit,
            quantile(&mut t.steps, 0.5),
            t.complete,
            t.poses.len(),
            t.different,
            DESIGNS as usize - t.unprepared,
            t.unprepared
        );
    }
    Ok(())
}
