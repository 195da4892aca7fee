//! Times and completeness of the forward-kinematics methods on random problems, drawn as in Martyushev, sec. 5.
//!
//! `cargo bench --package equipod-benches --bench compare_methods -- [COUNT] [SEED]` prints one Markdown table for each
//! class. First joints are at the origins, the other coordinates uniform in [-2, 2], squared lengths uniform in [0.5,
//! 3].
#![allow(clippy::print_stdout, reason = "a program that prints tables")]

use std::error::Error;
use std::time::{Duration, Instant};

use equipod::methods::fk::{
    Completeness, FkOptions, FkSolutions, ForwardKinematics, Homotopy, Sylvester, Template,
};
use equipod::methods::geom::ComplexPose;
use equipod::methods::manipulator::{Leg, Manipulator, SquaredLegLengths};
use equipod::methods::num::Rng;
use equipod::methods::solve::generic_frame::GenericProblem;
use equipod::methods::solve::sylvester::Eliminant;
use equipod::methods::solve::template::TemplateLayout;
use nalgebra::{Point3, Vector3};

#[derive(Clone, Copy)]
enum Class {
    General,
    SharedPlatformJoint,
    PlanarBase,
}

type Problem = (Manipulator, SquaredLegLengths);

fn draw(class: Class, rng: &mut Rng) -> Result<Problem, Box<dyn Error>> {
    let mut point = || Point3::from(Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0)));
    let mut legs: [Leg; 6] = std::array::from_fn(|_| Leg { base: point(), platform: point() });
    legs[0] = Leg { base: Point3::origin(), platform: Point3::origin() };
    match class {
        Class::General => {}
        Class::SharedPlatformJoint => legs[5].platform = legs[4].platform,
        Class::PlanarBase => legs.iter_mut().for_each(|l| l.base.z = 0.0),
    }
    let s = std::array::from_fn(|_| rng.uniform(0.5, 3.0));
    Ok((Manipulator::from_legs(legs)?, SquaredLegLengths::try_new(s)?))
}

/// The measurements of one method on many problems.
#[derive(Default)]
struct Tally {
    steps: Vec<Vec<Duration>>,
    /// Problems with 40 candidates of residual below 1e-6 before any refinement.
    raw: usize,
    /// Problems with 40 certified poses from one elimination, from all attempts.
    once: usize,
    proved: usize,
    /// Largest residual of the 40 best candidates, before refinement.
    worst: Vec<f64>,
}

impl Tally {
    fn residuals(&mut self, poses: impl Iterator<Item = Option<ComplexPose>>, (m, s): &Problem) {
        let mut r: Vec<f64> = poses.map(|p| p.map_or(f64::INFINITY, |p| p.residual(m, s))).collect();
        r.sort_by(f64::total_cmp);
        self.raw += usize::from(r[39] < 1e-6);
        self.worst.push(r[39]);
    }

    fn solutions(&mut self, found: &FkSolutions, candidates: usize) {
        let proved = matches!(found.completeness, Completeness::Proved { .. });
        self.proved += usize::from(proved);
        self.once += usize::from(proved && found.roots.len() + found.rejected.len() == candidates);
    }

    fn medians(&self) -> Vec<String> {
        let columns = self.steps.first().map_or(0, Vec::len);
        let column = |k: usize| self.steps.iter().map(|s| s[k].as_secs_f64() * 1e3).collect::<Vec<f64>>();
        (0..columns).map(|k| format!("{:.2}", median(column(k)))).collect()
    }
}

fn median(mut x: Vec<f64>) -> f64 {
    x.sort_by(f64::total_cmp);
    x.get(x.len() / 2).copied().unwrap_or(f64::NAN)
}

fn template(p: &Problem, o: &FkOptions, tally: &mut Tally) -> Result<(), Box<dyn Error>> {
    let layout = TemplateLayout::shipped()?;
    let problem = GenericProblem::draw(&p.0, &p.1, &mut Rng::stream(o.seed, 0));
    let t = [Instant::now(); 5];
    let filled = layout.fill(&problem);
    let t = [t[0], Instant::now(), t[2], t[3], t[4]];
    let eliminated = filled.eliminate();
    let t = [t[0], t[1], Instant::now(), t[3], t[4]];
    let pairs = eliminated.eigenpairs()?;
    let t = [t[0], t[1], t[2], Instant::now(), t[4]];
    let found = Template.solve(&p.0, &p.1, o)?;
    let total = t[3].elapsed();
    let check = total.saturating_sub(t[3] - t[0]);
    tally.steps.push(vec![t[1] - t[0], t[2] - t[1], t[3] - t[2], check, total]);
    tally.residuals(pairs.iter().map(|pair| layout.pose(&problem, pair)), p);
    tally.solutions(&found, 69);
    Ok(())
}

fn sylvester(p: &Problem, o: &FkOptions, tally: &mut Tally) -> Result<(), Box<dyn Error>> {
    let problem = GenericProblem::draw(&p.0, &p.1, &mut Rng::stream(o.seed, 0));
    let start = Instant::now();
    let eliminant = Eliminant::of(&problem)?;
    let eliminated = start.elapsed();
    let poses = eliminant.poses(&problem);
    let raw = start.elapsed();
    let found = Sylvester.solve(&p.0, &p.1, o)?;
    let total = start.elapsed().saturating_sub(raw);
    let check = total.saturating_sub(raw);
    tally.steps.push(vec![eliminated, raw.saturating_sub(eliminated), check, total]);
    tally.residuals(poses.into_iter(), p);
    tally.solutions(&found, 40);
    Ok(())
}

fn homotopy(p: &Problem, o: &FkOptions, tally: &mut Tally) -> Result<(), Box<dyn Error>> {
    let start = Instant::now();
    let found = Homotopy.solve(&p.0, &p.1, o)?;
    tally.steps.push(vec![start.elapsed()]);
    tally.solutions(&found, 40);
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut numbers = std::env::args().skip(1).filter(|a| !a.starts_with("--")).map(|a| a.parse::<u64>());
    let count = numbers.next().transpose()?.unwrap_or(50);
    let seed = numbers.next().transpose()?.unwrap_or(1);
    let o = FkOptions::default();
    let classes = [(Class::General, "6-6"), (Class::SharedPlatformJoint, "6-5"), (Class::PlanarBase, "6P-6")];
    for (class, name) in classes {
        let mut tallies = [Tally::default(), Tally::default(), Tally::default()];
        for k in 0..count {
            let p = draw(class, &mut Rng::stream(seed, k))?;
            template(&p, &o, &mut tallies[0])?;
            sylvester(&p, &o, &mut tallies[1])?;
            homotopy(&p, &o, &mut tallies[2])?;
        }
        println!("\n{name}, {count} problems, seed {seed}; medians in ms\n");
        println!(
            "| method | steps | total | residual before refinement, median | 40 before | 40 certified, one elimination | 40 certified |"
        );
        println!("|---|---|---|---|---|---|---|");
        let names = [
            "template (fill, LU, QZ, refine + certify)",
            "sylvester (determinant, roots + poses, refine + certify)",
            "homotopy",
        ];
        for (tally, name) in tallies.iter().zip(names) {
            let m = tally.medians();
            let (total, steps) = m.split_last().ok_or("no problem")?;
            let (residual, raw) = if tally.worst.is_empty() {
                ("-".to_owned(), "-".to_owned())
            } else {
                (format!("{:.1e}", median(tally.worst.clone())), format!("{}", tally.raw))
            };
            println!(
                "| {name} | {} | {total} | {residual} | {raw} | {} | {} |",
                steps.join(", "),
                tally.once,
                tally.proved
            );
        }
    }
    Ok(())
}
