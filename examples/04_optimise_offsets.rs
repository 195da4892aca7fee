//! The best platform without shared joints that is equivalent to an octahedral one, joints inside the edges.
//!
//! ```text
//! inverse condition number 0.1099, det A 0.3719
//! all margins met: true
//! proved to be within 1 % of the best: true
//! ```

use std::error::Error;
use std::fmt::Write;
use std::ops::ControlFlow;

use equipod::methods::design::{Format, parse};
use equipod::methods::manipulator::Octahedral;
use equipod::methods::offsets::{OffsetOutcome, OffsetProblem, OptimizeOptions, optimize};

fn main() -> Result<(), Box<dyn Error>> {
    std::io::Write::write_all(&mut std::io::stdout(), report()?.as_bytes())?;
    Ok(())
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let text = include_str!("../designs/rbt-octahedral.toml");
    let (design, _) = parse(text, Format::Toml).map_err(|v| v[0].message.clone())?;
    let octahedral = Octahedral::recognise(design.manipulator())?;
    let home = design.home.ok_or("the design has no home pose")?;

    let mut problem = OffsetProblem::with_defaults(octahedral, vec![home]);
    problem.bounds = [(0.0, 1.0); 6];
    problem.min_joint_distance = 1.2;
    let report = optimize(&problem, &OptimizeOptions::default(), &mut |_| ControlFlow::Continue(()))?;

    let mut out = String::new();
    match &report.outcome {
        OffsetOutcome::Optimal(best) => {
            let check = &best.recheck;
            writeln!(out, "inverse condition number {:.4}, det A {:.4}", check.objective, check.det.abs())?;
            writeln!(out, "all margins met: {}", check.margins.all_met())?;
            let proved = report.bound.is_some_and(|b| b.upper <= 1.01 * check.objective);
            writeln!(out, "proved to be within 1 % of the best: {proved}")?;
        }
        other => writeln!(out, "{other:?}")?,
    }
    Ok(out)
}
