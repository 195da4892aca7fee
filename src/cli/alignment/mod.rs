//! `--align` and `--exchange` of `map` and `verify`: the second design in the frames of the first.

mod render;

use std::fmt::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use self::render::{explanation, motion_text, record, status};
use super::exit::Exit;
use super::failure::Failure;
use super::files::{self, OutputPath};
use crate::design::Design;
use crate::geom::Pose;
use crate::manipulator::Manipulator;
use crate::synthesis::alignment::{Alignment, align, exchanged, mirrored, transformed};

/// Options about the frames of the second design.
#[derive(Debug, clap::Args)]
pub(crate) struct FrameArgs {
    /// The second design is in other base and platform frames: find all rigid motions that make it equivalent to the first
    #[arg(long)]
    align: bool,
    /// Exchange base and platform of the second design first: its poses become the inverse poses
    #[arg(long)]
    exchange: bool,
    /// Write the second design, in the frames of the first, to FILE (.toml or .json)
    #[arg(short, long, value_name = "FILE")]
    output: Option<OutputPath>,
}

/// The second design as it is compared with the first.
#[derive(Debug)]
pub(crate) struct Second {
    /// In the frames of the first, where `--align` found how.
    pub(crate) manipulator: Manipulator,
    alignment: Option<Alignment>,
    /// What `--align` finds for the second design taken otherwise.
    others: Vec<(&'static str, Alignment)>,
    exchange: bool,
    written: Option<PathBuf>,
}

impl FrameArgs {
    /// Exchanges, aligns and writes the second design as asked.
    pub(crate) fn apply(&self, a: &Design, b: &Design, seed: u64) -> Result<Second, Failure> {
        let broken = |e: &dyn std::fmt::Display| {
            Failure::new(Exit::Inconclusive, "align::breakdown", format!("no motion could be computed: {e}"))
                .with_help("coordinates of this magnitude are beyond what the search computes with; use a larger unit")
        };
        let upside_down = exchanged(b.manipulator());
        let (given, other) = if self.exchange {
            (upside_down, b.manipulator().clone())
        } else {
            (b.manipulator().clone(), upside_down)
        };
        let find = |m: &Manipulator| align(a.manipulator(), m, seed).map_err(|e| broken(&e));
        let mut second = Second {
            manipulator: given,
            alignment: None,
            others: Vec::new(),
            exchange: self.exchange,
            written: None,
        };
        let mut motion = None;
        if self.align {
            let found = find(&second.manipulator)?;
            second.others =
                vec![("exchanged", find(&other)?), ("mirrored", find(&mirrored(&second.manipulator))?)];
            if let Alignment::Found { motions, .. } = &found {
                let first = &motions[0];
                motion = Some((first.base, first.platform));
                second.manipulator =
                    transformed(&second.manipulator, &first.base, &first.platform).map_err(|e| broken(&e))?;
            }
            second.alignment = Some(found);
        }
        if let Some(path) = self.output.as_deref().filter(|_| motion.is_some() || !self.align) {
            files::write_design(path, &second.design(b, motion.as_ref())?)?;
            second.written = Some(path.to_path_buf());
        }
        Ok(second)
    }
}

impl Second {
    /// Some rigid motion was asked for and not found: there is none (`Some(true)`), or it is not decided (`Some(false)`).
    pub(crate) fn refuted(&self) -> Option<bool> {
        match self.alignment.as_ref()? {
            Alignment::Found { .. } => None,
            Alignment::None { .. } => Some(true),
            Alignment::Undecided { .. } => Some(false),
        }
    }

    /// Names, lengths and home pose follow; a box of poses about home, which has the axes of the old frame, does not.
    fn design(&self, b: &Design, motion: Option<&(Pose, Pose)>) -> Result<Design, Failure> {
        let (mut base, mut platform) = (b.base_names().to_vec(), b.platform_names().to_vec());
        if self.exchange {
            std::mem::swap(&mut base, &mut platform);
        }
        let moved = |pose: &Pose| {
            let pose = if self.exchange { inverse(pose) } else { *pose };
            motion.map_or(pose, |(g, h)| after(g, &after(&pose, &inverse(h))))
        };
        let mut design = Design::new(format!("{}, moved", b.name), &b.units, self.manipulator.clone())
            .with_joint_names(base, platform)
            .map_err(|e| Failure::internal(e.to_string()))?;
        (design.source, design.description) = (b.source.clone(), b.description.clone());
        (design.lengths, design.optimize, design.hardware) = (b.lengths, b.optimize, b.hardware);
        design.home = b.home.as_ref().map(moved);
        design.workspace.poses = b.workspace.poses.iter().map(moved).collect();
        Ok(design)
    }

    /// Fields for the document.
    pub(crate) fn put(&self, fields: &mut Map<String, Value>) {
        if self.exchange {
            fields.insert("exchanged".into(), json!(true));
        }
        if let Some(found) = &self.alignment {
            let mut record = record(found);
            for (name, other) in &self.others {
                let count = if let Alignment::Found { motions, .. } = other { motions.len() } else { 0 };
                record.insert((*name).into(), json!({ "status": status(other), "motions": count }));
            }
            fields.insert("alignment".into(), Value::Object(record));
        }
        if let Some(path) = &self.written {
            fields.insert("output".into(), json!(path.display().to_string()));
        }
    }

    /// What people read; empty without the options.
    pub(crate) fn text(&self) -> String {
        let mut out = String::new();
        if self.exchange {
            out.push_str(
                "base and platform of the second design are exchanged: its poses are inverse poses\n",
            );
        }
        let Some(found) = &self.alignment else { return out };
        let _ = writeln!(out, "{}", explanation(found));
        if let Alignment::Found { motions, .. } = found {
            for (k, m) in motions.iter().enumerate() {
                let _ = writeln!(out, "{:>3}  base      {}", k + 1, motion_text(&m.base));
                let _ = writeln!(out, "     platform  {}", motion_text(&m.platform));
                let _ =
                    writeln!(out, "     residual {:.1e}, det A = {:.6}", m.map.residual, m.map.determinant);
            }
        }
        for (name, other) in &self.others {
            if let (Alignment::Found { .. }, false) = (other, self.refuted().is_none()) {
                let _ = writeln!(out, "it is equivalent when the second design is {name}");
            }
        }
        out.push('\n');
        out
    }

    /// One sentence on the alignment, where one was asked for.
    pub(crate) fn explanation(&self) -> Option<String> {
        self.alignment.as_ref().map(explanation)
    }
}

fn inverse(pose: &Pose) -> Pose {
    let rotation = pose.rotation.inverse();
    Pose { rotation, position: -(rotation * pose.position) }
}

/// First `y`, then `x`.
fn after(x: &Pose, y: &Pose) -> Pose {
    Pose { rotation: x.rotation * y.rotation, position: x.rotation * y.position + x.position }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Rotation3, Vector3};

    use super::*;

    #[test]
    fn poses_compose_and_invert() {
        let x = Pose {
            rotation: Rotation3::new(Vector3::new(0.1, 0.7, -0.3)),
            position: Vector3::new(1.0, 2.0, 3.0),
        };
        let none = after(&x, &inverse(&x));
        assert!(none.position.norm() < 1e-14 && none.rotation.angle() < 1e-7);
    }
}
