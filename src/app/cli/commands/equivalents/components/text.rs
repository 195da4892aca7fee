//! The families as a table.

use std::fmt::Write as _;

use ask::Design;
use platform::manipulator::LegIndex;
use synthesis::components::{Component, Components, PlaneCurve, SampledLeg, flat_name};

fn names(list: &[LegIndex]) -> String {
    list.iter().map(|l| (l.get() + 1).to_string()).collect::<Vec<_>>().join(" ")
}

fn word(exact: Option<bool>) -> &'static str {
    match exact {
        Some(true) => "exact",
        Some(false) => "tolerance",
        None => "numerical",
    }
}

/// The table and what follows it.
pub(super) fn table(
    design: &Design,
    found: &Components,
    wanted: &[usize],
    samples: &[Vec<SampledLeg>],
) -> String {
    let mut text = format!("replaceable legs of {}\n\n", design.name);
    if found.components.is_empty() {
        text.push_str("none: no leg can be moved without changing the platform\n");
    } else {
        text.push_str(
            "  no  type         base   platform  dim  legs         moves with   holds      inside\n",
        );
    }
    for k in wanted {
        line(&mut text, *k, &found.components[*k]);
    }
    let rank = &found.leg_rank;
    if rank.value < 6 {
        let exact = rank.exact.map_or(String::new(), |e| format!(", exactly {e}"));
        let _ = writeln!(text, "\nthe leg vectors are dependent: rank {}{exact}", rank.value);
    }
    for planes in &found.planes {
        let legs = names(&found.pairs[planes.pair].legs);
        let _ = writeln!(text, "\nplanes of legs {legs}");
        curve(&mut text, "base", &planes.base);
        curve(&mut text, "platform", &planes.platform);
    }
    for (k, list) in wanted.iter().zip(samples).filter(|(_, s)| !s.is_empty()) {
        let _ = writeln!(text, "\nlegs of family {}", k + 1);
        for s in list {
            let (a, b) = (&s.leg.base, &s.leg.platform);
            let _ = writeln!(
                text,
                "  [{}, {}, {}] - [{}, {}, {}]  residual {:.1e}",
                a.x, a.y, a.z, b.x, b.y, b.z, s.residual
            );
        }
    }
    for doubt in &found.doubts {
        let _ = writeln!(text, "\nnot shown to be complete: {doubt}");
    }
    text
}

fn line(text: &mut String, k: usize, c: &Component) {
    let inside: Vec<String> = c.contained_in.iter().map(|l| (l + 1).to_string()).collect();
    let _ = writeln!(
        text,
        "{:>4}  {:<12} {:<6} {:<9} {:>3}  {:<12} {:<12} {:<10} {}",
        k + 1,
        c.type_name(),
        flat_name(c.base_span),
        flat_name(c.platform_span),
        c.dimension,
        names(&c.legs),
        names(&c.support),
        word(c.exact),
        inside.join(" ")
    );
}

fn curve(text: &mut String, body: &str, c: &PlaneCurve) {
    let parts: Vec<String> = c
        .parts
        .iter()
        .map(|p| {
            if p.multiplicity > 1 {
                format!("{} ({} times)", p.kind.name(), p.multiplicity)
            } else {
                p.kind.name().to_string()
            }
        })
        .collect();
    let what = if c.generic_rank < 3 {
        "every point of the plane carries a replaceable leg".to_string()
    } else if c.degree == 0 {
        "no curve".to_string()
    } else {
        format!("degree {}: {}", c.degree, parts.join(", "))
    };
    let _ = writeln!(text, "  {body:<9} {what}");
    match &c.exact {
        Ok(e) if e.generic_rank == 3 && e.degree > 0 => {
            let parts: Vec<&str> = e.parts.iter().map(|p| p.kind.name()).collect();
            let _ = writeln!(text, "            as written, over the complex numbers: {}", parts.join(", "));
        }
        Ok(_) => {}
        Err(reason) => {
            let _ = writeln!(text, "            nothing exact: {reason}");
        }
    }
    for s in &c.singular_points {
        let at = s.point.map_or("infinity".to_string(), |p| format!("[{}, {}, {}]", p.x, p.y, p.z));
        let line = if s.line_of_partners { ", a whole line corresponds" } else { "" };
        let _ = writeln!(text, "            {} at {at}{line}", s.kind.name());
    }
}
