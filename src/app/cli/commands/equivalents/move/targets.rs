//! The requested properties on the command line.

use nalgebra::Point3;

use crate::app::cli::failure::Failure;
use crate::app::cli::numbers::{self, Length};
use ask::{Design, MoveTargets};
use platform::manipulator::{Body, LegIndex};
use synthesis::relocate::search::{Hole, MoveSearchOptions};

/// The requested properties of an equivalent platform.
#[derive(Debug, Default, clap::Args)]
pub(in crate::app::cli::commands) struct TargetArgs {
    /// Search: every joint holds one leg
    #[arg(long)]
    no_shared_joints: bool,
    /// Search: no two legs meet at home
    #[arg(long)]
    no_crossing: bool,
    /// Search: least clearance of two legs, design units; default: the leg diameter, or 0
    #[arg(long, value_name = "D", value_parser = numbers::length, requires = "no_crossing")]
    clearance: Option<Length>,
    /// Search: a joint of the body lies here; repeat for several
    #[arg(long, value_name = "BODY:X,Y,Z")]
    hole: Vec<String>,
    /// Search: this joint moves here, with one of its legs; repeat for several
    #[arg(long, value_name = "NAME=X,Y,Z")]
    joint: Vec<String>,
    /// Search: least distance of two joints of one body, design units; default: the widest joint, `min_joint_distance`,
    /// or a hundredth of the size
    #[arg(long, value_name = "D", value_parser = numbers::length)]
    spacing: Option<Length>,
    /// Search: least inverse condition number of the Jacobian; default: a tenth of the design's
    #[arg(long, value_name = "X")]
    conditioning: Option<f64>,
    /// Search: greatest distance of a joint from its body's centre, in sizes of the design; default 1.5
    #[arg(long, value_name = "X")]
    reach: Option<f64>,
    /// Search: check the whole workspace, not home alone
    #[arg(long)]
    workspace: bool,
    /// Search: number of platforms to list; default 5
    #[arg(long, value_name = "N")]
    count: Option<usize>,
}

impl TargetArgs {
    /// The first requested property.
    pub(super) fn first_given(&self) -> Option<&'static str> {
        let given = [
            (self.no_shared_joints, "--no-shared-joints"),
            (self.no_crossing, "--no-crossing"),
            (!self.hole.is_empty(), "--hole"),
            (!self.joint.is_empty(), "--joint"),
            (self.spacing.is_some(), "--spacing"),
            (self.conditioning.is_some(), "--conditioning"),
            (self.reach.is_some(), "--reach"),
            (self.workspace, "--workspace"),
            (self.count.is_some(), "--count"),
        ];
        given.into_iter().find(|(is, _)| *is).map(|(_, name)| name)
    }

    /// The requested properties.
    pub(in crate::app::cli::commands) fn targets(&self, design: &Design) -> Result<MoveTargets, Failure> {
        let asked =
            self.no_shared_joints || self.no_crossing || !self.hole.is_empty() || !self.joint.is_empty();
        if !asked && self.spacing.is_none() && self.conditioning.is_none() && self.reach.is_none() {
            return Err(Failure::refused("move::no_target", "a search needs a target").with_help(
                "--no-shared-joints, --no-crossing, --hole, --joint, --spacing, --conditioning, --reach",
            ));
        }
        let mut holes = Vec::new();
        for text in &self.hole {
            holes.push(hole(text, &design.units)?);
        }
        for text in &self.joint {
            holes.push(joint(text, design)?);
        }
        Ok(MoveTargets::default()
            .no_shared_joints(self.no_shared_joints)
            .no_crossing(self.no_crossing)
            .clearance(Length::of_option(self.clearance.as_ref(), &design.units)?)
            .holes(holes)
            .spacing(Length::of_option(self.spacing.as_ref(), &design.units)?)
            .conditioning(self.conditioning)
            .reach(self.reach)
            .workspace(self.workspace))
    }

    pub(in crate::app::cli::commands) fn options(&self, seed: u64) -> MoveSearchOptions {
        let default = MoveSearchOptions::default();
        MoveSearchOptions { seed, count: self.count.unwrap_or(default.count), ..default }
    }
}

fn point(text: &str, whole: &str, units: &str) -> Result<Point3<f64>, Failure> {
    numbers::lengths::<3>(text, "three", units).map(Point3::from).map_err(|why| {
        Failure::refused("move::bad_hole", format!("`{whole}`: {why}"))
            .with_help("--hole base:X,Y,Z or --joint NAME=X,Y,Z, in the frame of the body")
    })
}

fn hole(text: &str, units: &str) -> Result<Hole, Failure> {
    let named = text.split_once(':').and_then(|(body, place)| Some((body.parse().ok()?, place)));
    let Some((body, place)) = named else {
        return Err(Failure::refused("move::bad_hole", format!("`{text}` names no body"))
            .with_help("base:X,Y,Z or platform:X,Y,Z"));
    };
    Ok(Hole { body, point: point(place, text, units)?, legs: Vec::new() })
}

/// Parses `NAME=X,Y,Z`: one of the legs at joint NAME has to end there.
fn joint(text: &str, design: &Design) -> Result<Hole, Failure> {
    let (name, place) = text.rsplit_once('=').unwrap_or((text, ""));
    let names = design.leg_names();
    let legs = |body: Body| LegIndex::all().filter(|l| body.of(names[l.get()]) == name).collect::<Vec<_>>();
    let (base, platform) = (legs(Body::Base), legs(Body::Platform));
    let (body, legs) = match (base.is_empty(), platform.is_empty()) {
        (false, true) => (Body::Base, base),
        (true, false) => (Body::Platform, platform),
        (false, false) => {
            let message = format!("`{name}` is a joint of both bodies");
            return Err(Failure::refused("move::ambiguous_joint", message).with_help("use --hole BODY:X,Y,Z"));
        }
        (true, true) => {
            let known: Vec<&String> = design.base_names().iter().chain(design.platform_names()).collect();
            let known: Vec<&str> = known.into_iter().map(String::as_str).collect();
            return Err(Failure::refused("move::no_such_joint", format!("no leg has a joint `{name}`"))
                .with_help(format!("joints: {}", known.join(", "))));
        }
    };
    Ok(Hole { body, point: point(place, text, &design.units)?, legs })
}
