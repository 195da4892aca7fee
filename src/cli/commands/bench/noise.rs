//! `equipod bench --noise`: errors of poses over errors of leg lengths.

use std::fmt::Write as _;
use std::num::NonZeroUsize;

use serde_json::{Map, Value, json};

use super::Args;
use crate::bench::{Class, NOISE_LEVELS, NoiseLevel, NoisePlan, Spread, noise};
use crate::cli::exit::Exit;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::cli::output::{Answer, number};
use crate::fk::{ForwardKinematics, Threads};
use crate::plot::{NoiseCurve, NoiseFigure, NoisePoint, noise_chart};

/// Levels the published figure shows, other than zero.
const PUBLISHED: (f64, f64) = (1e-4, 8e-4);

type Row = (Class, Vec<NoiseLevel>);

/// Runs the classes, writes the picture.
pub(super) fn run(
    args: &Args,
    classes: &[Class],
    solver: &dyn ForwardKinematics,
    seed: u64,
) -> Result<Answer, Failure> {
    if args.svg.is_some() && classes.len() > NoiseFigure::MOST_CURVES {
        let message = format!("a picture of {} classes cannot be read", classes.len());
        return Err(Failure::refused("bench::too_many_classes", message)
            .with_help(format!("name at most {} classes", NoiseFigure::MOST_CURVES)));
    }
    let threads = usize::try_from(args.threads).ok().and_then(NonZeroUsize::new);
    let mut rows: Vec<Row> = Vec::new();
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
        rows.push((*class, levels));
    }
    if let Some(path) = &args.svg {
        files::write_text(path, &noise_chart(&figure(args.count, seed, &rows)))?;
    }
    let mut json = Map::new();
    json.insert("class".into(), json!(args.class));
    json.insert("count".into(), json!(args.count));
    json.insert("seed".into(), json!(seed));
    json.insert("threads".into(), json!(args.threads));
    json.insert("rows".into(), rows.iter().map(record).collect());
    Ok(Answer::new(Exit::Yes, json, text(&rows)))
}

fn record((class, levels): &Row) -> Value {
    let level = |l: &NoiseLevel| {
        json!({
            "sigma": number(l.sigma), "without_real_pose": l.without_pose,
            "rotation": l.rotation.as_ref().map(spread), "position": l.position.as_ref().map(spread),
        })
    };
    json!({ "class": class.name(), "levels": levels.iter().map(level).collect::<Vec<_>>() })
}

fn spread(s: &Spread) -> Value {
    json!({
        "lower_quartile": number(s.lower_quartile), "median": number(s.median),
        "upper_quartile": number(s.upper_quartile), "p99": number(s.p99), "max": number(s.max),
    })
}

fn text(rows: &[Row]) -> String {
    let mut out = format!(
        "{:<14} {:>7} {:>7} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
        "class", "sigma", "no pose", "rot 25%", "50%", "75%", "99%", "pos 25%", "50%", "75%", "99%"
    );
    for (class, levels) in rows {
        for l in levels {
            let _ = write!(out, "{:<14} {:>7.0e} {:>7}", class.name(), l.sigma, l.without_pose);
            for s in [&l.rotation, &l.position] {
                match s {
                    Some(s) => {
                        for value in [s.lower_quartile, s.median, s.upper_quartile, s.p99] {
                            let _ = write!(out, " {value:>9.2e}");
                        }
                    }
                    None => out.push_str(&format!(" {:>9}", "-").repeat(4)),
                }
            }
            out.push('\n');
        }
    }
    out.push_str("radians; angle of the rotation, angle of the positions, to the nearest real pose\n");
    out
}

fn figure(count: u64, seed: u64, rows: &[Row]) -> NoiseFigure {
    let quartiles = |s: &Spread| [s.lower_quartile, s.median, s.upper_quartile];
    let point = |l: &NoiseLevel| {
        let (rotation, position) = (l.rotation.as_ref()?, l.position.as_ref()?);
        Some(NoisePoint { sigma: l.sigma, quartiles: [quartiles(rotation), quartiles(position)] })
    };
    let curve = |(class, levels): &Row| NoiseCurve {
        label: class.name().into_owned(),
        points: levels.iter().filter_map(point).collect(),
    };
    NoiseFigure {
        title: "Errors of poses over errors of leg lengths".into(),
        note: format!(
            "{count} platforms a class, seed {seed}; nearest real pose; definitions of Martyushev (2025), eqs. (20), (21); \
             curves are set a little apart"
        ),
        panels: ["angle of the rotation [rad]".into(), "angle of the position vectors [rad]".into()],
        marked: (PUBLISHED.0, PUBLISHED.1, "published range".into()),
        curves: rows.iter().map(curve).collect(),
    }
}
