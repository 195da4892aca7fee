//! The fewest shared joints of the listed topologies, by equivalent rearrangement.

use std::path::Path;

use crate::app::cli::{Failure, files};
use ask::Design;
use platform::manipulator::default_home;
use platform::topology::NamedTopology;
use synthesis::rearrangement::{Arrangement, PlanarBodies, Rearrangement, Reduction, rearrangement};

/// All cases of these topologies.
pub(super) fn cases(list: &[NamedTopology]) -> Result<Vec<Rearrangement>, Failure> {
    let all = list.iter().flat_map(|t| PlanarBodies::of(*t).into_iter().map(|planar| (*t, planar)));
    all.map(|(t, planar)| rearrangement(t, planar).map_err(|e| Failure::internal(e.to_string()))).collect()
}

/// Writes the member, the equivalent design with fewest shared joints, and the octahedral one if it exists.
pub(super) fn write(folder: &Path, list: &[Rearrangement]) -> Result<(), Failure> {
    for r in list {
        let [base, platform] = r.planar.names();
        let stem = format!("{}-{base}-{platform}", r.topology.id());
        let octahedral = match &r.octahedral {
            Reduction::Octahedral(design) => Some(("octahedral", design)),
            Reduction::Not(_) => None,
        };
        let designs = [("member", &r.member), ("fewest", &r.fewest)].into_iter().chain(octahedral);
        for (name, arrangement) in designs {
            let title = format!("{} ({}), {base} {platform}: {name}", r.topology.id(), r.topology.name());
            let text = design(&title, arrangement)?.to_toml();
            files::write_text(&folder.join(format!("{stem}-{name}.toml")), &text)?;
        }
    }
    Ok(())
}

fn design(title: &str, arrangement: &Arrangement) -> Result<Design, Failure> {
    let m = arrangement.manipulator().map_err(|e| Failure::internal(format!("{title}: {e}")))?;
    let lengths = default_home(&m).squared_lengths(&m).map(|s| s.lengths());
    let mut design = Design::new(title.to_string(), "1", m);
    design.source = Some("made by equipod equivalents topologies --rearrangements".to_string());
    design.lengths = lengths;
    Ok(design)
}
