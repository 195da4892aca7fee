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

use equipod::prelude::*;

#[allow(clippy::print_stdout, reason = "an example prints")]
fn main() -> Result<(), Box<dyn Error>> {
    print!("{}", report()?);
    Ok(())
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let mut out = String::new();
    let design = Design::load("designs/rbt-octahedral.toml")?;
    let lengths = design.lengths.ok_or("the design has no lengths")?;
    let found = design.fk(lengths)?;
    let general = design.fk_with(lengths, FkOptions::new().method(Method::Homotopy))?;

    writeln!(out, "{}: {} finite poses by the {} method", design.name, found.roots.len(), found.method)?;
    writeln!(out, "{} finite poses by the {} method", general.roots.len(), general.method)?;
    writeln!(out, "real, certified, platform origin above the base at x, y, z:")?;
    for pose in found.roots.iter().filter(|root| root.certified()).filter_map(FkRoot::real_pose) {
        let p = pose.position;
        if p.z > 0.0 {
            writeln!(out, "{:9.4} {:9.4} {:9.4}", p.x, p.y, p.z)?;
        }
    }
    Ok(out)
}
