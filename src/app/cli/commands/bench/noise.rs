//! `equipod bench --noise`: pose errors divided by errors of leg lengths.

use std::num::NonZeroUsize;

use super::BenchArgs;
use crate::app::cli::{Answer, Exit, Failure, files};
use ::files::plot::{NoiseCurve, NoiseFigure, NoisePoint, noise_chart};
use ask::bench::{Class, NOISE_LEVELS, NoiseLevel, NoisePlan, Spread, noise};
use fk::{ForwardKinematics, Threads};
use records::{BenchAnswer, NoiseAnswer, NoiseRowRecord};

/// The least and greatest nonzero level in the published figure.
const PUBLISHED: (f64, f64) = (1e-4, 8e-4);

/// Runs the classes and writes the picture.
pub(super) fn run(
    args: &BenchArgs,
    classes: &[Class],
    solver: &dyn ForwardKinematics,
    seed: u64,
) -> Result<Answer, Failure> {
    if args.svg.is_some() && classes.len() > NoiseFigure::MOST_CURVES {
        let message = format!("a picture of {} classes would be unreadable", classes.len());
        return Err(Failure::refused("bench::too_many_classes", message)
            .with_help(format!("name at most {} classes", NoiseFigure::MOST_CURVES)));
    }
    let threads = usize::try_from(args.threads).ok().and_then(NonZeroUsize::new);
    let mut rows = Vec::new();
    for class in classes {
        let plan = NoisePlan {
            class: *class,
            count: args.count,
            seed,
            threads: threads.map_or(Threads::All, Threads::Count),
            levels: NOISE_LEVELS.to_vec(),
        };
        let levels = noise(&plan, solver);
        let levels = levels.map_err(|e| Failure::new(Exit::Inconclusive, "bench::not_run", e.to_string()))?;
        rows.push(NoiseRowRecord::new(*class, &levels));
    }
    let record = NoiseAnswer { class: args.class.clone(), count: args.count, threads: args.threads, rows };
    if let Some(path) = &args.svg {
        files::write_text(path, &noise_chart(&figure(&record, seed)))?;
    }
    let answer = BenchAnswer::Noise(record);
    let sheet = sheet::answers::bench(&answer, seed);
    Ok(Answer::new(Exit::Yes, answer, sheet))
}

fn figure(noise: &NoiseAnswer, seed: u64) -> NoiseFigure {
    let count = noise.count;
    let quartiles = |s: &Spread| [s.lower_quartile, s.median, s.upper_quartile];
    let point = |l: &NoiseLevel| {
        let (rotation, position) = (l.rotation.as_ref()?, l.position.as_ref()?);
        Some(NoisePoint { sigma: l.sigma, quartiles: [quartiles(rotation), quartiles(position)] })
    };
    let curve = |row: &NoiseRowRecord| NoiseCurve {
        label: row.class.clone(),
        points: row.levels.iter().filter_map(point).collect(),
    };
    NoiseFigure {
        title: "Errors of poses over errors of leg lengths".into(),
        note: format!(
            "{count} platforms a class, seed {seed}; nearest real pose; definitions of Martyushev (2025), eqs. (20), (21); \
             curves are set a little apart"
        ),
        panels: ["angle of the rotation [rad]".into(), "angle of the position vectors [rad]".into()],
        marked: (PUBLISHED.0, PUBLISHED.1, "published range".into()),
        curves: noise.rows.iter().map(curve).collect(),
    }
}
