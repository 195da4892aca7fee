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

use equipod::methods::design::{Design, Format, parse};
use equipod::methods::synthesis::{LegMapTolerances, leg_map};

const DESIGNS: [(&str, &str); 3] = [
    ("Griffis-Duffy type", include_str!("../designs/rbt-griffis-duffy.toml")),
    ("all midpoints", include_str!("../designs/rbt-midline.toml")),
    ("general", include_str!("../designs/general-6-6.toml")),
];

fn main() -> Result<(), Box<dyn Error>> {
    std::io::Write::write_all(&mut std::io::stdout(), report()?.as_bytes())?;
    Ok(())
}

fn read(text: &str) -> Result<Design, String> {
    Ok(parse(text, Format::Toml).map_err(|v| v[0].message.clone())?.0)
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let octahedral = read(include_str!("../designs/rbt-octahedral.toml"))?;
    let squares = octahedral.lengths.ok_or("the design has no lengths")?.squared();
    let mut out = String::new();
    for (name, text) in DESIGNS {
        let design = read(text)?;
        let found = leg_map(octahedral.manipulator(), design.manipulator(), LegMapTolerances::default())?;
        writeln!(out, "{name}: {}", found.relation.as_str())?;
        if let Some(map) = found.map() {
            let lengths = map.apply(&squares)?.lengths().get();
            let [first, .., last] = lengths;
            writeln!(out, "  det A = {:.4}, lengths {first:.6} .. {last:.6}", found.determinant.abs())?;
        }
    }
    Ok(out)
}
