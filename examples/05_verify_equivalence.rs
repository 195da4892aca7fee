//! Are two platforms equivalent? The leg map says so, and forward kinematics that knows nothing of it agrees.
//!
//! ```text
//! as designed: equivalent
//!   poses in common at each sample: [16, 16, 16]
//! a joint moved by 1e-6 of the size: not_equivalent
//!   poses in common at each sample: [1, 1, 1]
//!   a pose of B misses leg 3 of the other, certified: true
//! ```

use std::error::Error;
use std::fmt::Write;

use equipod::methods::design::{Design, Format, parse};
use equipod::methods::equivalence::{SamplePlan, Verdict, verify};
use equipod::methods::fk::FkOptions;
use equipod::methods::manipulator::Manipulator;
use nalgebra::Vector3;

fn main() -> Result<(), Box<dyn Error>> {
    std::io::Write::write_all(&mut std::io::stdout(), report()?.as_bytes())?;
    Ok(())
}

fn read(text: &str) -> Result<Design, String> {
    Ok(parse(text, Format::Toml).map_err(|v| v[0].message.clone())?.0)
}

/// The text of the output.
pub(crate) fn report() -> Result<String, Box<dyn Error>> {
    let a = read(include_str!("../designs/rbt-octahedral.toml"))?;
    let b = read(include_str!("../designs/rbt-griffis-duffy.toml"))?;
    let home = a.home.ok_or("the design has no home pose")?;
    let (translation, rotation) = (Vector3::repeat(1.0), Vector3::repeat(0.2));
    let plan = SamplePlan { home, translation, rotation, count: 3, seed: 1 };

    let mut legs = b.manipulator().legs();
    legs[2].platform.z += 1e-6 * b.manipulator().size();
    let moved = Manipulator::from_legs(legs)?;

    let mut out = String::new();
    for (name, other) in [("as designed", b.manipulator()), ("a joint moved by 1e-6 of the size", &moved)] {
        let found = verify(a.manipulator(), other, &plan, &FkOptions::default())?;
        writeln!(out, "{name}: {}", found.verdict.as_str())?;
        let pairs: Vec<usize> = found.samples.iter().map(|s| s.matching.pairs.len()).collect();
        writeln!(out, "  poses in common at each sample: {pairs:?}")?;
        if let Verdict::NotEquivalent(c) = &found.verdict {
            writeln!(
                out,
                "  a pose of {} misses {} of the other, certified: {}",
                c.solves,
                c.leg,
                c.certified()
            )?;
        }
    }
    Ok(out)
}
