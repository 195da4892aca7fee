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

use equipod::prelude::*;

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let mut out = String::new();
    let class = Design::load("designs/rbt-octahedral.toml")?.equivalents()?;
    let counts = class.family().counts();
    writeln!(out, "{} patterns, {} up to symmetry", counts.patterns, counts.classes_exchange)?;
    let [topologies, exchanged] = [counts.topologies, counts.topologies_exchange];
    writeln!(out, "{topologies} topologies, {exchanged} with base and platform exchanged")?;

    // legs 3 to 6 kept, both legs at one joint moved along side 1
    let pattern: Pattern = "V3456S11".parse()?;
    let (built, map) = class.build(&pattern, &[0.25, 0.75])?;
    let formula = pattern.determinant_formula();
    writeln!(out, "{pattern}: det A = {formula} = {:.1}", map.determinant().abs())?;
    let [base, moving] = [built.base_names().len(), built.platform_names().len()];
    writeln!(out, "{base} base joints, {moving} platform joints, {} shared", pattern.shared_joints().len())?;
    Ok(out)
}
