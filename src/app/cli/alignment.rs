//! `--align` and `--exchange` of `equivalents map` and `verify`: the second design in the frames of the first.

use std::path::PathBuf;

use super::context::Context;
use super::exit::Exit;
use super::failure::Failure;
use super::files::{self, OutputPath};
use ::files::design::DesignModel;
use ask::Design;
use num::linalg::LinalgError;
use platform::geom::Pose;
use platform::manipulator::Manipulator;
use records::{AlignmentRecord, FramesRecord};
use synthesis::alignment::{Alignment, align, exchanged, mirrored, transformed};
use synthesis::{LegMapOutcome, Relation};
use verify::decide_map;

/// Options about the frames of the second design.
#[derive(Debug, clap::Args)]
pub(crate) struct AlignmentArgs {
    /// Find all rigid motions of the second design's frames that make it equivalent
    #[arg(long)]
    align: bool,
    /// Exchange base and platform of the second design first; its poses are inverted
    #[arg(long)]
    exchange: bool,
    /// Write the second design in the frames of the first (.toml or .json)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// The second design, prepared for the comparison with the first.
#[derive(Debug)]
pub(crate) struct Second {
    /// In the frames of the first design, if `--align` found a motion.
    pub(crate) manipulator: Manipulator,
    /// As requested, before any motion.
    given: Manipulator,
    aligned: Option<Aligned>,
    exchange: bool,
    written: Option<PathBuf>,
}

/// The results of `--align`.
#[derive(Debug)]
struct Aligned {
    /// The alignment of the second design as requested.
    given: Alignment,
    /// The alignment of the second design with base and platform exchanged.
    exchanged: Alignment,
    /// The alignment of the second design's mirror image.
    mirrored: Alignment,
}

/// Refuses two designs in different units with this code.
pub(crate) fn same_units(a: &Design, b: &Design, code: &str) -> Result<(), Failure> {
    if a.units == b.units {
        return Ok(());
    }
    let message = format!("{} has the unit `{}`, and {} has the unit `{}`", a.name, a.units, b.name, b.units);
    Err(Failure::refused(code, message)
        .with_help("convert one of them: `equipod design convert DESIGN --units UNIT -o FILE`"))
}

impl AlignmentArgs {
    /// Exchanges, aligns and writes the second design as requested.
    pub(crate) fn apply(&self, a: &Design, b: &Design, context: &Context) -> Result<Second, Failure> {
        if !(self.align || self.exchange) {
            context.no_effect("output", "the second design stays as it is without --align and --exchange")?;
        }
        let broken = |e: &dyn std::fmt::Display| {
            Failure::new(Exit::Inconclusive, "align::breakdown", format!("no motion could be computed: {e}"))
                .with_help("the coordinates are too large for the search; use a larger unit")
        };
        let upside_down = exchanged(b.manipulator());
        let (given, other) = if self.exchange {
            (upside_down, b.manipulator().clone())
        } else {
            (b.manipulator().clone(), upside_down)
        };
        let find = |m: &Manipulator| align(a.manipulator(), m, context.seed()).map_err(|e| broken(&e));
        let mut second = Second {
            manipulator: given.clone(),
            given,
            aligned: None,
            exchange: self.exchange,
            written: None,
        };
        let mut motion = None;
        if self.align {
            let found = find(&second.manipulator)?;
            let (exchanged, mirrored) = (find(&other)?, find(&mirrored(&second.manipulator))?);
            if let Alignment::Found { motions, .. } = &found {
                let first = &motions[0];
                motion = Some((first.base, first.platform));
                // without a motion the joints stay exact
                if first.is_motion() {
                    second.manipulator = transformed(&second.manipulator, &first.base, &first.platform)
                        .map_err(|e| broken(&e))?;
                }
            }
            second.aligned = Some(Aligned { given: found, exchanged, mirrored });
        }
        if let Some(path) = self.output.as_deref().filter(|_| motion.is_some() || !self.align) {
            files::write_design(path, &second.design(b, motion.as_ref())?)?;
            second.written = Some(path.to_path_buf());
        }
        Ok(second)
    }
}

impl Second {
    /// The relation of the first design and this one. A motion is known only to rounding, so after it nothing is proved
    /// except that a platform is singular.
    pub(crate) fn compared(&self, a: &Manipulator) -> Result<LegMapOutcome, LinalgError> {
        let given = decide_map(a, &self.given)?;
        match self.aligned.as_ref().map(|found| &found.given) {
            Some(Alignment::Found { motions, .. })
                if given.relation != Relation::Singular && motions[0].is_motion() =>
            {
                Ok(motions[0].map.clone())
            }
            _ => Ok(given),
        }
    }

    /// Whether the requested rigid motion was not found: there is none (`Some(true)`), or it is undecided
    /// (`Some(false)`).
    pub(crate) fn refuted(&self) -> Option<bool> {
        match self.aligned.as_ref()?.given {
            Alignment::Found { .. } => None,
            Alignment::None { .. } => Some(true),
            Alignment::Undecided { .. } => Some(false),
        }
    }

    /// Names, lengths and home pose are carried over. A box of poses about home is dropped, since it has the axes of
    /// the old frame.
    fn design(&self, b: &Design, motion: Option<&(Pose, Pose)>) -> Result<Design, Failure> {
        let (mut base, mut platform) = (b.base_names().to_vec(), b.platform_names().to_vec());
        if self.exchange {
            std::mem::swap(&mut base, &mut platform);
        }
        let moved = |pose: &Pose| {
            let pose = if self.exchange { pose.inverse() } else { *pose };
            motion.map_or(pose, |(g, h)| g.compose(&pose.compose(&h.inverse())))
        };
        let mut design = DesignModel::new(format!("{}, moved", b.name), &b.units, self.manipulator.clone())
            .with_joint_names(base, platform)
            .map_err(|e| Failure::internal(e.to_string()))?;
        (design.source, design.description) = (b.source.clone(), b.description.clone());
        (design.lengths, design.optimize, design.hardware) = (b.lengths, b.optimize, b.hardware);
        design.home = b.home.as_ref().map(moved);
        // in the base frame: home is a different pose in the new frames
        design.workspace.poses = b.workspace.space(&b.home_or_default()).poses.iter().map(moved).collect();
        // a numerical motion makes all joints inexact: three numbers each
        Ok(if motion.is_none() { design.exchanged_from(b) } else { design }.into())
    }

    /// Fields for the document.
    pub(crate) fn record(&self) -> FramesRecord {
        let aligned = self.aligned.as_ref();
        FramesRecord {
            exchanged: self.exchange,
            alignment: aligned.map(|a| AlignmentRecord::new(&a.given, &a.exchanged, &a.mirrored)),
            output: self.written.as_ref().map(|path| path.display().to_string()),
        }
    }

    /// One sentence on the alignment, if it was requested.
    pub(crate) fn explanation(&self) -> Option<String> {
        self.aligned.as_ref().map(|a| a.given.explanation())
    }
}
