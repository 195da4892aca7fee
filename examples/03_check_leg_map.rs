//! The affine map between the squared leg lengths of two platforms, and when there is none.
//!
//! ```text
//! Griffis-Duffy type: equivalent
//!   det A = 0.2621, lengths 18.851843 .. 18.058793
//! all midpoints: singular
//!   det A = 0.0000, lengths 17.944916 .. 18.586016
//! general: unrelated
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
    let octahedral = Design::load("designs/rbt-octahedral.toml")?;
    let squares = octahedral.lengths.ok_or("the design has no lengths")?.squared();
    for (name, file) in [
        ("Griffis-Duffy type", "designs/rbt-griffis-duffy.toml"),
        ("all midpoints", "designs/rbt-midline.toml"),
        ("general", "designs/general-6-6.toml"),
    ] {
        let mut design = Design::load(file)?;
        design.units.clone_from(&octahedral.units); // one of the files has no unit
        let found = leg_map(&octahedral, &design)?;
        writeln!(out, "{name}: {}", found.relation)?;
        if let Some(map) = found.map() {
            let [first, .., last] = map.apply(&squares)?.lengths().get();
            writeln!(out, "  det A = {:.4}, lengths {first:.6} .. {last:.6}", found.determinant.abs())?;
        }
    }
    Ok(out)
}
