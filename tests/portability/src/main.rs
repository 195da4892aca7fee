//! All poses of the reference problems, with their certificates, in a form that `../compare.py` compares across
//! processors.
//!
//! A line `problem NAME key=value ..` begins each problem. A line `root key=value .. | re im radius` with twelve discs
//! (`R` row by row, then `p`) follows for each root; without a certificate the radius is `-`. Numbers are written so
//! that they read back to the same double.

use std::error::Error;
use std::fmt::Write;
use std::io::Write as _;

use equipod::methods::fk::{FkOptions, FkSolutions, solver};
use equipod::methods::manipulator::{Leg, LegLengths, Manipulator};
use nalgebra::Point3;
use serde_json::Value;

macro_rules! problems {
    ($($name:literal),* $(,)?) => { [$(($name, include_str!(concat!("../../fixtures/roots/", $name, ".json")))),*] };
}

/// One of each class that the reference roots have, special and nearly singular ones among them.
const PROBLEMS: [(&str, &str); 12] = problems![
    "dietmaier40",
    "general65_00",
    "general66_00",
    "general66_01",
    "geom55_00",
    "geom63_00",
    "geom64_00",
    "hexapod_01",
    "nearsing_00",
    "octahedral33_00",
    "realpose66_00",
    "semiplanar6P6_00",
];

fn main() -> Result<(), Box<dyn Error>> {
    let mut out = String::new();
    for (name, text) in PROBLEMS {
        let found = solved(&serde_json::from_str(text)?).ok_or_else(|| format!("{name} cannot be solved"))?;
        write(&mut out, name, &found)?;
    }
    std::io::stdout().write_all(out.as_bytes())?;
    Ok(())
}

fn solved(problem: &Value) -> Option<FkSolutions> {
    let number = |x: &Value| x.as_f64();
    let point = |body: &str, i: usize| -> Option<Point3<f64>> {
        let p = problem.get(body)?.get(i)?;
        Some(Point3::new(number(p.get(0)?)?, number(p.get(1)?)?, number(p.get(2)?)?))
    };
    let mut legs = [Leg { base: Point3::origin(), platform: Point3::origin() }; 6];
    let mut lengths = [0.0; 6];
    for i in 0..6 {
        legs[i] = Leg { base: point("base", i)?, platform: point("platform", i)? };
        lengths[i] = number(problem.get("leg_lengths")?.get(i)?)?;
    }
    let m = Manipulator::from_legs(legs).ok()?;
    solver(None).solve(&m, &LegLengths::try_new(lengths).ok()?.squared(), &FkOptions::default()).ok()
}

fn write(out: &mut String, name: &str, found: &FkSolutions) -> std::fmt::Result {
    let count = found.pose_count.as_ref().map(|count| format!("{:?}", count.set).replace(' ', ""));
    writeln!(
        out,
        "problem {name} method={} roots={} certified={} unproved={} accounted={} count={}",
        found.method,
        found.roots.len(),
        found.certified_count(),
        found.unproved.len(),
        found.all_accounted(),
        count.unwrap_or_else(|| "-".into()),
    )?;
    for root in &found.roots {
        write!(out, "root real={:?} multiplicity={} |", root.reality, root.multiplicity)?;
        match &root.certificate {
            Some(proof) => {
                for disc in proof.enclosure().discs() {
                    write!(out, " {:?} {:?} {:?}", disc.centre.re, disc.centre.im, disc.radius)?;
                }
            }
            None => {
                let (r, p) = (&root.pose.rotation, &root.pose.position);
                for z in r.transpose().iter().chain(p.iter()) {
                    write!(out, " {:?} {:?} -", z.re, z.im)?;
                }
            }
        }
        writeln!(out)?;
    }
    Ok(())
}
