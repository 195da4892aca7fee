//! Every platform equivalent to an octahedral one, and one of them built.
//!
//! ```text
//! 728 patterns, 74 up to symmetry
//! 20 topologies, 13 with base and platform exchanged
//! V3456S11: det A = (u1 - t1) = 0.5
//! 5 base joints, 3 platform joints, 4 shared
//! ```

use std::error::Error;
use std::fmt::Write;

use equipod::methods::design::{Format, parse};
use equipod::methods::manipulator::Octahedral;
use equipod::methods::synthesis::{Family, Pattern};

fn main() -> Result<(), Box<dyn Error>> {
    std::io::Write::write_all(&mut std::io::stdout(), report()?.as_bytes())?;
    Ok(())
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let text = include_str!("../designs/rbt-octahedral.toml");
    let (design, _) = parse(text, Format::Toml).map_err(|v| v[0].message.clone())?;
    let octahedral = Octahedral::recognise(design.manipulator())?;

    let family = Family::octahedral();
    let counts = family.counts();
    let mut out = String::new();
    writeln!(out, "{} patterns, {} up to symmetry", counts.patterns, counts.classes_exchange)?;
    writeln!(
        out,
        "{} topologies, {} with base and platform exchanged",
        counts.topologies, counts.topologies_exchange
    )?;

    // legs 3 to 6 kept, both legs at one joint moved along side 1
    let pattern: Pattern = "V3456S11".parse()?;
    let offsets = [0.25, 0.75];
    let platform = pattern.instantiate(&octahedral, &offsets)?;
    writeln!(
        out,
        "{pattern}: det A = {} = {}",
        pattern.determinant_formula(),
        pattern.determinant(&offsets)?
    )?;
    let [base, moving] = [platform.base_joints().len(), platform.platform_joints().len()];
    writeln!(out, "{base} base joints, {moving} platform joints, {} shared", pattern.shared_joints().len())?;
    Ok(out)
}
