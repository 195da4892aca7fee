//! The ways in which six legs can share joints.

use crate::{Sheet, Table, left, right};
use records::{RearrangementRecord, TopologiesAnswer, TopologyRecord};

/// The answer of `equivalents topologies`.
#[must_use]
pub fn topologies(r: &TopologiesAnswer) -> Sheet {
    let mut out = Sheet::new();
    if let Some(d) = &r.design {
        let exchanged = if d.exchanged { ", base and platform exchanged" } else { "" };
        say!(out, "{}: topology {} {}{exchanged}\n", d.name, d.id, d.topology);
    }
    out.table(catalogue(&r.topologies));
    if let Some(list) = &r.rearrangements {
        out.space();
        out.table(rearrangements(list));
    }
    out
}

fn catalogue(list: &[TopologyRecord]) -> Table {
    let mut table = Table::new([
        left("id", 4),
        left("name", 5),
        left("legs", 39),
        right("poses", 5),
        left("proved", 6).gap(2),
        left("closure degree (before)", 14).gap(2),
        left("virtual legs", 0).gap(2),
    ]);
    let joined = |pairs: &[[String; 2]]| pairs.iter().map(|p| p.concat()).collect::<Vec<_>>().join(" ");
    for t in list {
        let closure = t.closure_degree.zip(t.closure_degree_before);
        let joints = match t.virtual_legs {
            0 => String::new(),
            _ => format!(": {}", joined(&t.virtual_leg_joints)),
        };
        table.row([
            t.id.clone(),
            t.name.clone(),
            joined(&t.legs),
            t.finite_roots.to_string(),
            if t.finite_roots_proved { "yes" } else { "no" }.to_owned(),
            closure.map_or("-".to_owned(), |(degree, before)| format!("{degree} ({before})")),
            format!("{}{joints}{}", t.virtual_legs, if t.decoupled { " (decoupled)" } else { "" }),
        ]);
    }
    table
}

/// The fewest shared joints of each topology, by equivalent rearrangement.
fn rearrangements(list: &[RearrangementRecord]) -> Table {
    let mut table = Table::new([
        left("id", 4),
        left("name", 5),
        left("base", 6),
        left("platform", 9),
        left("shared joints", 14),
        left("merged ends", 12),
        left("octahedral", 18),
        left("families of replaceable legs", 0),
    ]);
    for r in list {
        table.row([
            r.id.clone(),
            r.name.clone(),
            r.base.clone(),
            r.platform.clone(),
            format!("{} -> {}", r.shared_joints, r.fewest_shared_joints),
            format!("{} -> {}", r.merged_ends, r.fewest_merged_ends),
            r.octahedral_reason.clone().unwrap_or_else(|| "yes".to_owned()),
            r.family_names.clone(),
        ]);
    }
    table
}
