//! `equipod equivalents topologies`: the joint-sharing topologies, their numbers of poses, pictures and designs.

mod rearrangements;

use std::collections::BTreeMap;
use std::path::PathBuf;

use nalgebra::Point3;

use crate::app::cli::{Answer, Context, Exit, Failure, OutputPath, files};
use ::files::plot::{TopologyFigure, topology_diagram, topology_sheet};
use ask::Design;
use ask::bench::{Class, LengthsFrom, Planar, problem};
use fk::distance::generic_degrees;
use fk::{Completeness, FkOptions, ForwardKinematics, Homotopy, PoseCounting};
use num::Purpose;
use platform::manipulator::{Manipulator, default_home};
use platform::topology::{NamedTopology, Recognised, catalogue, recognise};
use records::{
    RearrangementRecord, RecognisedRecord, TopologiesAnswer, TopologyFindings, TopologyRecord,
    VirtualLegsRecord,
};

/// Arguments of `equivalents topologies`.
#[derive(Debug, clap::Args)]
pub(crate) struct EquivalentsTopologiesArgs {
    /// Design file (.toml or .json): name only its topology
    design: Option<PathBuf>,
    /// Number of random members of each topology to solve
    #[arg(long, value_name = "N", default_value_t = 2, value_parser = clap::value_parser!(u64).range(1..=1000))]
    members: u64,
    /// Write a picture of all listed topologies
    #[arg(long, value_name = "FILE")]
    svg: Option<OutputPath>,
    /// Write a design (T01.toml) and a picture (T01.svg) of each topology into this folder
    #[arg(short, long, value_name = "DIR")]
    output: Option<OutputPath>,
    /// Add the equivalent rearrangement of each topology with the fewest shared joints, bodies in space or in a plane;
    /// with -o, write its designs
    #[arg(long)]
    rearrangements: bool,
}

/// Lists the catalogue, or the topology of one design.
pub(crate) fn run(args: &EquivalentsTopologiesArgs, context: &mut Context) -> Result<Answer, Failure> {
    let mut listed = catalogue();
    let count = listed.len();
    let (mut of_design, mut by_virtual_legs) = (None, None);
    if let Some(path) = &args.design {
        let design = context.load(path)?;
        let found = recognised(&design)?;
        of_design = Some(RecognisedRecord {
            name: design.name.clone(),
            id: found.topology.id(),
            topology: found.topology.name(),
            exchanged: found.exchanged,
        });
        listed = vec![found.topology];
    } else {
        by_virtual_legs = Some(VirtualLegsRecord::of(&listed));
    }
    let moved = if args.rearrangements { Some(rearrangements::cases(&listed)?) } else { None };
    let entries = listed.into_iter().map(|t| entry(t, args.members, context.seed()));
    let entries = entries.collect::<Result<Vec<TopologyFindings>, Failure>>()?;
    write_files(args, &entries)?;
    if let Some(list) = &moved {
        args.output.iter().try_for_each(|folder| rearrangements::write(folder, list))?;
    }
    let exit = if entries.iter().all(|e| e.proved) { Exit::Yes } else { Exit::Inconclusive };
    let answer = TopologiesAnswer {
        count,
        design: of_design,
        by_virtual_legs,
        members: args.members,
        topologies: entries.iter().map(TopologyRecord::from).collect(),
        rearrangements: moved.map(|list| list.iter().map(RearrangementRecord::from).collect()),
    };
    let sheet = sheet::answers::topologies(&answer);
    Ok(Answer::new(exit, answer, sheet))
}

fn entry(named: NamedTopology, members: u64, seed: u64) -> Result<TopologyFindings, Failure> {
    let t = named.topology();
    let mut votes: BTreeMap<u32, (u64, bool)> = BTreeMap::new();
    for k in 0..members {
        let class = Class::Topology { topology: named, planar: Planar::Neither };
        let internal =
            |e: &dyn std::fmt::Display| Failure::internal(format!("{}, member {k}: {e}", named.id()));
        let member = problem(class, LengthsFrom::Pose, seed, k).map_err(|e| internal(&e))?;
        let options = FkOptions::new().seed(seed).pose_count(PoseCounting::Never);
        let found =
            Homotopy.solve(&member.manipulator, &member.squares, &options).map_err(|e| internal(&e))?;
        let vote = votes.entry(found.count_with_multiplicity()).or_default();
        vote.0 += 1;
        vote.1 |= matches!(found.completeness, Completeness::Proved { .. });
    }
    // a proved count holds for all generic members; otherwise take the most frequent count
    let best = votes.into_iter().max_by_key(|(count, (times, proved))| (*proved, *times, *count));
    let (poses, (_, proved)) = best.unwrap_or_default();
    let sequence = t.trilateration();
    let closure = generic_degrees(&t.legs(), &sequence, seed).ok();
    Ok(TopologyFindings { named, sequence, decoupled: t.is_decoupled(), poses, proved, closure })
}

fn figure(e: &TopologyFindings) -> TopologyFigure {
    let legs = match e.sequence.virtual_legs.len() {
        0 => "trilaterable".to_string(),
        1 if e.decoupled => "decoupled".to_string(),
        1 => "1 virtual leg".to_string(),
        n => format!("{n} virtual legs"),
    };
    TopologyFigure { topology: e.named, caption: format!("{} poses, {legs}", e.poses) }
}

fn sheet(entries: &[TopologyFindings]) -> String {
    let figures: Vec<TopologyFigure> = entries.iter().map(figure).collect();
    topology_sheet("Joint-sharing topologies of six-legged platforms", &figures)
}

/// Only the picture: of the topology of a design, or of all.
pub(in crate::app::cli::commands) fn drawing(
    design: Option<&Design>,
    members: u64,
    seed: u64,
) -> Result<String, Failure> {
    let listed = match design {
        Some(design) => vec![recognised(design)?.topology],
        None => catalogue(),
    };
    let entries: Result<Vec<TopologyFindings>, Failure> =
        listed.into_iter().map(|t| entry(t, members, seed)).collect();
    Ok(sheet(&entries?))
}

fn recognised(design: &Design) -> Result<Recognised, Failure> {
    recognise(design.manipulator()).map_err(|why| {
        let message = format!("{} has none of the {} topologies: {why}", design.name, catalogue().len());
        Failure::new(Exit::No, "topologies::always_singular", message)
    })
}

fn write_files(args: &EquivalentsTopologiesArgs, entries: &[TopologyFindings]) -> Result<(), Failure> {
    if let Some(path) = &args.svg {
        files::write_text(path, &sheet(entries))?;
    }
    let Some(folder) = &args.output else { return Ok(()) };
    files::make_folder(folder)?;
    for e in entries {
        let file = |ending: &str| folder.join(format!("{}.{ending}", e.named.id()));
        files::write_text(&file("svg"), &topology_diagram(&figure(e)))?;
        files::write_text(&file("toml"), &representative(e)?.to_toml())?;
    }
    Ok(())
}

/// A member with its joints near two circles, at its default home pose; coordinates are thousandths of the base radius.
fn representative(e: &TopologyFindings) -> Result<Design, Failure> {
    let t = e.named.topology();
    let layout = t.layout();
    // independent of the seed, since the file belongs to the topology
    let mut rng = Purpose::REPRESENTATIVES.item(0x34, e.named.number() as u64);
    let mut ring = |angles: &[f64], radius: f64| -> Vec<Point3<f64>> {
        let mut off = || rng.uniform(-0.12, 0.12);
        let joint = |angle: &f64| {
            let (sine, cosine) = (angle + off()).sin_cos();
            let (r, z) = (radius * (1.0 + off()), off());
            Point3::new(r * cosine, r * sine, z).map(|x| (1000.0 * x).round() / 1000.0)
        };
        angles.iter().map(joint).collect()
    };
    let (base, platform) = (ring(&layout.base, 1.0), ring(&layout.platform, 0.6));
    let internal = |error: &dyn std::fmt::Display| Failure::internal(format!("{}: {error}", e.named.id()));
    let m = Manipulator::try_new(base, platform, t.legs()).map_err(|e| internal(&e))?;
    let home = default_home(&m);
    let squares = home.squared_lengths(&m).ok_or_else(|| internal(&"the home pose has no leg lengths"))?;
    let mut design = Design::new(format!("{} ({})", e.named.id(), e.named.name()), "1", m);
    design.source = Some("made by equipod equivalents topologies".to_string());
    design.description = Some(format!("representative of a joint-sharing topology with {} poses", e.poses));
    design.lengths = Some(squares.lengths());
    Ok(design)
}
