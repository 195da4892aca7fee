//! The best platform without shared joints that is equivalent to an octahedral one, joints inside the edges.
//!
//! ```text
//! inverse condition number 0.0921, det A 0.3675
//! all margins met: true
//! proved to be within 1 % of the best: true
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
    let mut design = Design::load("designs/rbt-octahedral.toml")?;
    design.optimize.min_joint_distance = Some(1.2);
    let found = design.optimize_with(OptimizeOptions::new().extension(0.0))?;

    let OptimizeEvidence::Offsets(offsets) = &found.evidence else { return Err("not offsets".into()) };
    if let Some(best) = offsets.report.solution() {
        let check = &best.recheck;
        writeln!(out, "inverse condition number {:.4}, det A {:.4}", check.objective, check.det.abs())?;
        writeln!(out, "all margins met: {}", check.margins.all_met())?;
    }
    writeln!(out, "proved to be within 1 % of the best: {}", found.status == OptimizeStatus::Optimal)?;
    Ok(out)
}
