//! The platforms equivalent to an octahedral design.

use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use platform::manipulator::Body;
use records::{FamilyAnswer, PatternPlace, PatternRecord};

/// The answer of `equivalents family`: the class with its topologies, or only the requested patterns.
#[must_use]
pub fn family(r: &FamilyAnswer, asked: bool) -> Sheet {
    let mut sheet = summary(r);
    if asked {
        r.patterns.iter().for_each(|p| describe(&mut sheet, p, r));
    } else {
        topologies(&mut sheet, r);
    }
    if let Some(r) = &r.instance {
        say!(sheet, "\nat these offsets det A = {}", figure(r.determinant.0));
    }
    if let Some(d) = &r.derivation {
        let to = r.instance.as_ref().map_or("the platform", |built| built.pattern.as_str());
        sheet.add(super::derivation(d, &r.name, to));
    }
    sheet
}

fn summary(r: &FamilyAnswer) -> Sheet {
    let (mut out, c) = (Sheet::new(), &r.counts);
    say!(out, "platforms equivalent to {}\n", r.name);
    let lines = [
        ("patterns", c.patterns, None),
        ("patterns up to symmetry", c.classes, Some(c.classes_exchange)),
        ("topologies", c.topologies, Some(c.topologies_exchange)),
        ("topologies, one offset at a time", c.sequential_topologies, Some(c.sequential_topologies_exchange)),
    ];
    let mut table = Table::new([right("", 5), left("", 0).gap(2)]);
    for (what, count, exchange) in lines {
        let exchanged = exchange.map(|n| format!(" ({n} when base and platform may be exchanged)"));
        table.row([count.to_string(), format!("{what}{}", exchanged.unwrap_or_default())]);
    }
    out.table(table);
    out
}

fn topologies(out: &mut Sheet, r: &FamilyAnswer) {
    let counts = ["base", "platform", "shared", "patterns"].map(|title| right(title, 0).gap(2));
    let columns = [right("topology", 0)].into_iter().chain(counts);
    let mut table = Table::new(columns.chain([left("sequential", 0).gap(2), left("example", 0).gap(2)]));
    for t in &r.topologies {
        let patterns = r.patterns.iter().filter(|p| p.topology == t.topology).count();
        table.row([
            t.topology.to_string(),
            t.base_joints.to_string(),
            t.platform_joints.to_string(),
            t.shared_joints.to_string(),
            patterns.to_string(),
            if t.sequential { "yes" } else { "no" }.to_owned(),
            t.example.clone(),
        ]);
    }
    out.space();
    out.table(table);
}

fn describe(out: &mut Sheet, pattern: &PatternRecord, r: &FamilyAnswer) {
    say!(out, "\npattern {}", pattern.id);
    for (k, leg) in pattern.legs.iter().enumerate() {
        let formula = match &leg.place {
            PatternPlace::Vertex {} => format!("s{}", k + 1),
            PatternPlace::Inner { side, offset: t, between: [k, n] } => {
                format!("(1 - {t}) s{k} + {t} s{n} - {t} (1 - {t}) d{side}^2")
            }
        };
        say!(out, "  leg {}  {:<4} {:<4}  s' = {formula}", k + 1, leg.base, leg.platform);
    }
    for (k, d) in r.edge_lengths.iter().enumerate() {
        let body = if k % 2 == 0 { Body::Base } else { Body::Platform };
        say!(out, "  d{} = {} ({body})", k + 1, figure(d.0));
    }
    say!(out, "  det A = {}", pattern.determinant);
    let zeros = if pattern.zeros.is_empty() { "never".into() } else { pattern.zeros.join(" or ") };
    say!(out, "  singular where {zeros}");
}
