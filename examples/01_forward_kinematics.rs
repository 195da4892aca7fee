//! All poses of a platform for given leg lengths, by a method of its own and by the general one.
//!
//! ```text
//! octahedral 12-6: 16 finite poses by the octic method
//! 16 finite poses by the homotopy method
//! real, certified, platform origin above the base at x, y, z:
//!   14.9332    1.5801   12.9052
//!   14.1322    2.0425   13.7167
//!   13.3693    2.4830   14.3922
//!    9.2203    4.8784   16.8293
//!    7.4658    5.8914   17.3665
//!    5.7497    6.8822   17.6527
//! ```

use std::error::Error;
use std::fmt::Write;

use equipod::methods::design::{Format, parse};
use equipod::methods::fk::{FkOptions, ForwardKinematics, Homotopy, solver};

fn main() -> Result<(), Box<dyn Error>> {
    std::io::Write::write_all(&mut std::io::stdout(), report()?.as_bytes())?;
    Ok(())
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let text = include_str!("../designs/rbt-octahedral.toml");
    let (design, _) = parse(text, Format::Toml).map_err(|v| v[0].message.clone())?;
    let squares = design.lengths.ok_or("the design has no lengths")?.squared();

    let options = FkOptions::default();
    let found = solver(None).solve(design.manipulator(), &squares, &options)?;
    let general = Homotopy.solve(design.manipulator(), &squares, &options)?;

    let mut out = String::new();
    writeln!(out, "{}: {} finite poses by the {} method", design.name, found.roots.len(), found.method)?;
    writeln!(out, "{} finite poses by the {} method", general.roots.len(), general.method)?;
    writeln!(out, "real, certified, platform origin above the base at x, y, z:")?;
    for root in found.assembly_modes().filter(|r| r.certified() && r.pose.position.z.re > 0.0) {
        let p = root.pose.position.map(|z| z.re);
        writeln!(out, "{:9.4} {:9.4} {:9.4}", p.x, p.y, p.z)?;
    }
    Ok(out)
}
