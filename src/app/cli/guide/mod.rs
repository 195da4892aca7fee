//! The commands by task: the order and the examples of `--help`.
//!
//! The table below is the only list of commands beside their definitions. One test checks that it names every command
//! once, and another runs every example on the designs of the project.

use std::fmt::Write as _;

use clap::builder::Styles;
use clap::{Command, CommandFactory};

use super::args::Cli;

/// Commands for one task.
struct CommandGroup {
    heading: &'static str,
    commands: &'static [GuideEntry],
}

/// A command with its place in the help.
#[derive(Debug)]
pub struct GuideEntry {
    /// The words after `equipod`.
    pub path: &'static str,
    /// Command lines after `equipod` that work on the designs of the project; the help of the program and of the group
    /// shows the first one.
    pub examples: &'static [&'static str],
    /// Other words for the command; if they are typed, the command is suggested.
    pub words: &'static [&'static str],
}

const fn entry(
    path: &'static str,
    examples: &'static [&'static str],
    words: &'static [&'static str],
) -> GuideEntry {
    GuideEntry { path, examples, words }
}

const JOBS: [CommandGroup; 10] = [
    CommandGroup {
        heading: "Start",
        commands: &[entry(
            "new",
            &[
                "new --base-radius 500 --platform-radius 300 --base-spread 20 --platform-spread 20 --height 400 -o hexapod.toml",
                "new --servo --crank 24 --base-radius 80 --platform-radius 60 --base-spread 20 --platform-spread 20 --height 110 -o servos.toml",
                "new --corners 0,0/12,0/6,10.4 0,0/6,0/3,5.2 --height 9 -o octahedral.toml",
                "new --points designs/tables/hexapod.csv -o mine.toml",
            ],
            &["init", "create", "import", "start"],
        )],
    },
    CommandGroup {
        heading: "Solve",
        commands: &[
            entry(
                "ik",
                &[
                    "ik designs/symmetric-hexapod.toml --pose 0,0,360,5,0,0",
                    "ik designs/presets/bench-l16.toml --json",
                    "ik designs/presets/reachy-mini.toml --pose 0,0,180,5,0,0",
                ],
                &["inverse", "inverse-kinematics", "lengths", "leg-lengths", "cranks", "servos"],
            ),
            entry(
                "fk",
                &[
                    "fk designs/rbt-octahedral.toml",
                    "fk designs/rbt-octahedral.toml --method trilateration",
                    "fk designs/rbt-octahedral.toml --lengths 11,11,11,11,11,11 --json",
                    "fk designs/presets/reachy-mini.toml --angles 36,-36,36,-36,36,-36 --near home",
                ],
                &["forward", "forward-kinematics", "kinematics", "solve", "poses"],
            ),
            entry(
                "at",
                &[
                    "at designs/presets/bench-l16.toml --wrench 0,0,-20,0,0,0",
                    "at designs/symmetric-hexapod.toml --forces 1,1,1,1,1,1 --point 0,0,50 --axes platform --json",
                    "at designs/symmetric-hexapod.toml --pose 0,0,360,5,0,0 --leg 3 --nearest-singular",
                ],
                &["statics", "forces", "wrench", "load-cell", "stiffness", "resolution", "stuck", "torque"],
            ),
            entry(
                "limits",
                &[
                    "limits designs/presets/bench-l16.toml",
                    "limits designs/presets/bench-l16.toml --table",
                    "limits designs/presets/bench-l16.toml --at 0,0,215,3,0,0 --to 10,0,212,0,0,0 --json",
                ],
                &["limit", "range", "ranges", "reach", "reachable", "travel"],
            ),
        ],
    },
    CommandGroup {
        heading: "Equivalent designs",
        commands: &[
            entry(
                "equivalents family",
                &[
                    "equivalents family designs/rbt-octahedral.toml",
                    "equivalents family designs/rbt-octahedral.toml --pattern S123456 --offsets 0.2,0.3,0.2,0.3,0.2,0.3 -o equivalent.toml",
                    "equivalents family designs/rbt-octahedral.toml --pattern S123456 --offsets 0.2,0.2,0.2,0.2,0.2,0.2 --explain",
                ],
                &["patterns", "class", "derivation", "Cayley-Menger"],
            ),
            entry(
                "equivalents components",
                &["equivalents components designs/symmetric-hexapod.toml"],
                &["families", "replaceable"],
            ),
            entry(
                "equivalents topologies",
                &["equivalents topologies designs/innocenti-6-4.toml"],
                &["topology"],
            ),
            entry(
                "equivalents move",
                &["equivalents move designs/rbt-octahedral.toml --move 1:1:0.25"],
                &["relocate", "rearrange"],
            ),
            entry(
                "equivalents nearest",
                &["equivalents nearest designs/symmetric-hexapod.toml -o octahedral.toml"],
                &["closest", "octahedral", "approximate"],
            ),
            entry(
                "equivalents map",
                &["equivalents map designs/rbt-octahedral.toml designs/rbt-griffis-duffy.toml"],
                &["leg-map", "affine"],
            ),
            entry(
                "verify",
                &["verify designs/rbt-octahedral.toml designs/rbt-griffis-duffy.toml"],
                &["equivalent"],
            ),
            entry("explore", &["explore designs/rbt-octahedral.toml -o out"], &["analyse", "analyze"]),
        ],
    },
    CommandGroup {
        heading: "Requirements",
        commands: &[
            entry("assess", &["assess designs/worked/bench-octahedral.toml"], &["requirements", "margins"]),
            entry(
                "compare",
                &[
                    "compare designs/worked/bench-octahedral.toml designs/worked/bench-joint-free.toml --accuracy 0.1,0.05 -o compare.html",
                ],
                &["candidates", "side-by-side", "table"],
            ),
            entry(
                "motion",
                &["motion designs/worked/simulator-octahedral.toml --sine z:0.1:0.5 --accelerate pitch:100"],
                &["dynamics", "inverse-dynamics", "drive-forces", "power"],
            ),
            entry(
                "optimize",
                &["optimize designs/rbt-octahedral.toml -o best.toml"],
                &["optimise", "optimum", "improve"],
            ),
        ],
    },
    CommandGroup {
        heading: "Singular designs and poses",
        commands: &[
            entry("check", &["check designs/rbt-midline.toml"], &["architecture", "singular-design"]),
            entry(
                "singular poses",
                &["singular poses designs/rbt-octahedral.toml"],
                &["singularities", "singularity", "singular-poses"],
            ),
            entry(
                "singular locus",
                &[
                    "singular locus designs/rbt-octahedral.toml",
                    "singular locus designs/rbt-octahedral.toml --about 0,0,1",
                ],
                &["singularity-locus", "polynomial", "cubic"],
            ),
            entry(
                "singular motion",
                &["singular motion designs/rbt-midline.toml"],
                &["selfmotion", "self-motion"],
            ),
        ],
    },
    CommandGroup {
        heading: "Build",
        commands: &[
            entry(
                "build drives",
                &["build drives designs/presets/bench-l16.toml designs/tables/drives.csv -o driven.toml"],
                &["actuators", "actuator", "cylinders", "catalogue"],
            ),
            entry(
                "build round",
                &["build round designs/rbt-octahedral.toml --grid 0.25 -o rounded.toml"],
                &["rounding", "grid", "holes"],
            ),
            entry(
                "build tolerances",
                &["build tolerances designs/rbt-octahedral.toml --bound 0.1,0.5"],
                &["tolerance", "budget"],
            ),
            entry(
                "calibrate",
                &[
                    "calibrate designs/symmetric-hexapod.toml designs/tables/calibration.csv --sigma-length 0.005 --sigma-position 0.01 --sigma-rotation-deg 0.002 -o calibrated.toml",
                    "calibrate designs/symmetric-hexapod.toml --sigma-length 0.005 --next 30",
                ],
                &["calibration", "identify", "measure", "joint-centres"],
            ),
            entry(
                "export",
                &["export designs/rbt-octahedral.toml --to step,dxf --unit mm -o files"],
                &["cad"],
            ),
        ],
    },
    CommandGroup {
        heading: "Many designs",
        commands: &[
            entry(
                "sweep run",
                &[
                    "sweep run designs/sweeps/offsets.toml -o sweep",
                    "sweep run designs/sweeps/offsets.toml --shard 3/16 -o sweep",
                    "sweep run designs/sweeps/offsets.toml --estimate",
                ],
                &["study", "campaign", "latin-hypercube", "sobol"],
            ),
            entry("sweep status", &["sweep status sweep"], &["missing"]),
            entry("sweep merge", &["sweep merge sweep -o sweep.parquet"], &["concatenate", "parquet"]),
            entry("sweep verify", &["sweep verify sweep"], &["digests"]),
            entry("sweep best", &["sweep best sweep --by conditioning --count 3 -o best"], &["top", "rank"]),
            entry("sweep design", &["sweep design sweep --candidate 5 -o candidate.toml"], &["extract"]),
            entry(
                "sweep script",
                &["sweep script designs/sweeps/offsets.toml --slurm --folder sweep -o sweep.sh"],
                &["slurm", "cluster", "batch"],
            ),
        ],
    },
    CommandGroup {
        heading: "Design files",
        commands: &[
            entry(
                "design convert",
                &[
                    "design convert designs/rbt-octahedral.toml -o octahedral.json",
                    "design convert designs/symmetric-hexapod.toml --units in -o inches.toml",
                ],
                &["format", "units"],
            ),
            entry(
                "design presets",
                &["design presets", "design presets bench-l16 -o mine.toml"],
                &["preset", "hardware"],
            ),
            entry("design schema", &["design schema", "design schema equivalents-family"], &["json-schema"]),
        ],
    },
    CommandGroup {
        heading: "See and share",
        commands: &[
            entry(
                "plot modes",
                &["plot modes designs/rbt-octahedral.toml -o modes.svg"],
                &["assembly-modes"],
            ),
            entry(
                "plot components",
                &["plot components designs/rbt-griffis-duffy.toml -o curves.svg"],
                &["curves"],
            ),
            entry("plot det", &["plot det designs/rbt-octahedral.toml -o det.svg"], &["determinant"]),
            entry(
                "plot locus",
                &[
                    "plot locus designs/innocenti-6-4.toml --leg 6 --from 4.3 --to 4.7 --steps 11 -o locus.svg",
                ],
                &["root-locus"],
            ),
            entry(
                "plot pair",
                &["plot pair designs/rbt-octahedral.toml designs/rbt-griffis-duffy.toml -o pair.svg"],
                &[],
            ),
            entry("plot pareto", &["plot pareto front.json -o front.svg"], &["front"]),
            entry(
                "plot self-motion",
                &["plot self-motion designs/rbt-midline.toml -o motion.svg"],
                &["animation"],
            ),
            entry(
                "plot singular-poses",
                &["plot singular-poses designs/rbt-octahedral.toml -o singular.svg"],
                &["slice"],
            ),
            entry(
                "plot sweep",
                &[
                    "plot sweep sweep --columns det_a,conditioning,clearance -o cloud.svg",
                    "plot sweep sweep.parquet --kind front --columns base_spacing,conditioning -o spacing.svg",
                    "plot sweep sweep --kind histogram --columns conditioning -o histogram.svg",
                ],
                &["heat-map", "histogram", "scatter", "parallel-coordinates", "contour"],
            ),
            entry("plot topologies", &["plot topologies designs/innocenti-6-4.toml -o topology.svg"], &[]),
            entry(
                "plot workspace",
                &["plot workspace designs/worked/bench-octahedral.toml --slice x,z -o workspace.svg"],
                &["workspace"],
            ),
            entry("view", &["view designs/rbt-octahedral.toml -o page.html"], &["show", "page", "html"]),
            entry("report", &["report out"], &["results"]),
        ],
    },
    CommandGroup {
        heading: "Measure and install",
        commands: &[
            entry("bench", &["bench --class 6-6 --count 10"], &["benchmark", "time"]),
            entry("shell completions", &["shell completions bash"], &["completion", "complete"]),
            entry("shell man", &["shell man -o man"], &["manual", "manpage"]),
        ],
    },
];

/// All commands, in the order of the help.
pub fn entries() -> impl Iterator<Item = &'static GuideEntry> {
    JOBS.iter().flat_map(|job| job.commands)
}

/// The definition of the program with the examples and the order of this guide.
pub fn program() -> Command {
    let mut program = Cli::command();
    for entry in entries() {
        program = with_examples(program, &entry.path.split(' ').collect::<Vec<_>>(), entry.examples);
    }
    let groups: Vec<String> =
        program.get_subcommands().filter(|c| c.has_subcommands()).map(|c| c.get_name().to_string()).collect();
    for group in groups {
        let listed = entries().filter(|e| e.path.split(' ').next() == Some(&group));
        let body = list("Commands", listed.map(|e| line(&program, e.path, e.path, e.examples[0])));
        program = program.mut_subcommand(group, |c| c.help_template(template(&body)));
    }
    let body = JOBS.iter().map(|job| list(job.heading, lines(&program, job))).collect::<String>();
    program.help_template(template(&body))
}

/// A note for users who have the program alone.
const WITHOUT_REPOSITORY: &str = "\n\nThe files in designs/ come with the sources; `equipod new` and `equipod design presets` write designs without them.";

fn with_examples(command: Command, path: &[&str], examples: &[&str]) -> Command {
    let Some((first, rest)) = path.split_first() else {
        let lines: Vec<String> = examples.iter().map(|e| format!("  equipod {e}")).collect();
        let heading = styled(if examples.len() == 1 { "Example" } else { "Examples" });
        let mut lines = lines.join("\n");
        if examples.iter().any(|e| e.contains("designs/")) {
            lines.push_str(WITHOUT_REPOSITORY);
        }
        // a template is not wrapped, so command lines stay whole; manual pages take the text after the help
        return command.after_help(format!("{heading}\n{lines}")).help_template(format!(
            "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{{all-args}}\n\n{heading}\n{lines}\n"
        ));
    };
    command.mut_subcommand(first, |c| with_examples(c, rest, examples))
}

/// The help of the program or of a group of commands around its list of commands.
fn template(commands: &str) -> String {
    let options = styled("Options");
    format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{commands}{options}\n{{options}}{{after-help}}"
    )
}

fn styled(heading: &str) -> String {
    let styles = Styles::default();
    let style = styles.get_header();
    format!("{style}{heading}:{style:#}")
}

/// A command with its purpose and an example.
struct GuideLine {
    name: String,
    about: String,
    example: &'static str,
}

/// The lines of a task; the figures of `plot` share one.
fn lines<'a>(program: &'a Command, job: &'a CommandGroup) -> impl Iterator<Item = GuideLine> + 'a {
    let first_figure = job.commands.iter().position(|e| e.path.starts_with("plot "));
    job.commands.iter().enumerate().filter_map(move |(k, e)| match e.path.strip_prefix("plot ") {
        None => Some(line(program, e.path, e.path, e.examples[0])),
        Some(_) if Some(k) == first_figure => Some(line(program, "plot", "plot FIGURE", e.examples[0])),
        Some(_) => None,
    })
}

fn line(program: &Command, path: &str, name: &str, example: &'static str) -> GuideLine {
    let found = path.split(' ').try_fold(program, |c, word| c.find_subcommand(word));
    let about = found.and_then(Command::get_about).map(ToString::to_string).unwrap_or_default();
    GuideLine { name: name.into(), about, example }
}

/// Width of the names in the lists of commands.
const NAMES: usize = 24;

fn list(heading: &str, lines: impl Iterator<Item = GuideLine>) -> String {
    let styles = Styles::default();
    let literal = styles.get_literal();
    let mut out = styled(heading) + "\n";
    for GuideLine { name, about, example } in lines {
        // writing to a string cannot fail
        let _ = writeln!(out, "  {literal}{name:<NAMES$}{literal:#}{about}");
        let _ = writeln!(out, "  {:<NAMES$}$ equipod {example}", "");
    }
    out + "\n"
}

#[cfg(test)]
mod tests;
