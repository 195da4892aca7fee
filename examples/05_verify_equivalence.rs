//! Are two platforms equivalent? The leg map says so, and forward kinematics that knows nothing of it agrees.
//!
//! ```text
//! as designed: equivalent
//!   poses in common at each sample: [16, 16, 16]
//! a joint moved by 1e-6 of the size: not_equivalent
//!   poses in common at each sample: [1, 1, 1]
//!   a pose of A misses leg 3 of the other, certified: true
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
    let a = Design::load("designs/rbt-octahedral.toml")?;
    let b = Design::load("designs/rbt-griffis-duffy.toml")?;
    let mut moved = b.clone();
    let (_, joint) = b.leg_names()[2];
    let (joint, pairs) = (format!("platform.{joint}"), b.manipulator().pairs());
    let mut point = b.manipulator().platform_joints()[pairs[2].1];
    point.z += 1e-6 * b.manipulator().size();
    moved.set_joint(&joint, point)?;

    for (name, other) in [("as designed", &b), ("a joint moved by 1e-6 of the size", &moved)] {
        let found = verify_with(&a, other, VerifyOptions::new().samples(3))?;
        writeln!(out, "{name}: {}", found.verdict.name())?;
        let pairs: Vec<usize> = found.samples.iter().map(|s| s.matching.pairs.len()).collect();
        writeln!(out, "  poses in common at each sample: {pairs:?}")?;
        if let Verdict::NotEquivalent(Some(c)) = &found.verdict {
            let [solves, leg] = [c.solves.to_string(), c.leg.to_string()];
            writeln!(out, "  a pose of {solves} misses {leg} of the other, certified: {}", c.certified())?;
        }
    }
    Ok(out)
}
