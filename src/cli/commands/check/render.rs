//! What `check` tells people.

use std::fmt::Write as _;

use super::Checked;
use crate::singularity::{Assembly, Dependency, GriffisDuffy, NearestSingular, RankBound};

/// Which design it is, in one sentence.
pub(super) fn explanation(c: &Checked) -> String {
    let a = &c.architecture;
    match (c.verdict(), a.findings.first()) {
        (None, _) => "as written the design is regular, but a singular one differs from it by no more than rounding: which of the two \
                      was meant cannot be told from the file"
            .into(),
        (_, Some(f)) => format!("{} ({})", f.case.sentence(), list(&f.legs)),
        (_, None) => "almost every pose holds the platform".into(),
    }
}

/// What proves the answer for the joints as written.
pub(super) fn proof(c: &Checked) -> String {
    let j = &c.architecture.jacobian;
    let pose = format!(
        "the pose with quaternion {:?} and p = {}",
        j.witness.quaternion,
        triple(&j.witness.pose().position)
    );
    match j.bound {
        RankBound::Legs => {
            format!("{pose} has six independent leg lines, in exact arithmetic on the joints as written")
        }
        RankBound::LegVectors => format!(
            "the leg vectors have rank {0} exactly, the lines never have more; {pose} has rank {0}",
            c.architecture.leg_rank
        ),
        RankBound::Lattice { poses, primes } => format!(
            "the leg lines have rank {} or less at {poses} poses that decide all poses, in exact arithmetic ({primes} primes); {pose} has \
             that rank",
            j.rank
        ),
    }
}

fn triple(v: &nalgebra::Vector3<f64>) -> String {
    format!("({}, {}, {})", v.x, v.y, v.z)
}

fn list(legs: &[usize]) -> String {
    let numbers: Vec<String> = legs.iter().map(|i| (i + 1).to_string()).collect();
    format!("legs {}", numbers.join(", "))
}

pub(super) fn text(c: &Checked) -> String {
    let a = &c.architecture;
    let verdict = match c.verdict() {
        Some(true) => "architecturally singular",
        Some(false) => "regular",
        None => "regular as written, singular within rounding",
    };
    let mut text = format!("{}: {verdict}\n{}\n", c.design.name, explanation(c));
    let _ = writeln!(text, "\nrank of the leg vectors     {}", a.leg_rank);
    let _ = writeln!(text, "generic rank of the lines   {}", a.jacobian.rank);
    let _ = writeln!(text, "proof: {}", proof(c));
    for f in a.findings.iter().skip(1) {
        let _ = writeln!(text, "also: {} ({})", f.case.sentence(), list(&f.legs));
    }
    for d in &a.dependencies {
        dependency(&mut text, c, d);
    }
    if let Some(g) = &a.griffis_duffy {
        griffis_duffy(&mut text, c, g);
    }
    if let Some(n) = &c.nearest {
        nearest(&mut text, c, n);
    }
    let f = &c.conditioning;
    let values: Vec<String> = f.leg_vectors.iter().map(|x| format!("{x:.3e}")).collect();
    let _ = writeln!(text, "\nsingular values of the normalised leg vectors: {}", values.join(", "));
    let _ = writeln!(
        text,
        "inverse condition number of the Jacobian at {} random poses: best {:.3e}, median {:.3e}, worst {:.3e}",
        f.poses, f.best, f.median, f.worst
    );
    text
}

fn sum(coefficients: [f64; 6], letter: char) -> String {
    let mut text = String::new();
    for (i, c) in coefficients.into_iter().enumerate().filter(|(_, c)| *c != 0.0) {
        let sign = match (c < 0.0, text.is_empty()) {
            (true, true) => "-",
            (true, false) => " - ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let size = c.abs();
        let factor = if size.total_cmp(&1.0).is_eq() { String::new() } else { format!("{size} ") };
        let _ = write!(text, "{sign}{factor}{letter}{}", i + 1);
    }
    text
}

fn dependency(text: &mut String, c: &Checked, d: &Dependency) {
    let _ = writeln!(text, "\ndependency of {}: {} = 0", list(&d.legs), sum(d.coefficients, 'v'));
    let _ = writeln!(
        text,
        "  base ends span dimension {}, platform ends {}",
        d.base_dimension, d.platform_dimension
    );
    let _ = writeln!(text, "  squared lengths of every pose: {} = {}", sum(d.coefficients, 's'), d.constant);
    if let Some(l) = &c.design.lengths {
        let defect = d.defect(&l.squared());
        let _ = writeln!(text, "  the lengths of the design miss it by {defect:.1e} (relative)");
    }
}

fn griffis_duffy(text: &mut String, c: &Checked, g: &GriffisDuffy) {
    let t: Vec<String> = g.t.iter().map(|t| format!("{t:.6}")).collect();
    let _ = writeln!(text, "\nGriffis-Duffy type, going round by {}: t = {}", list(&g.order), t.join(", "));
    let exactly = if g.is_exactly_singular() { " (zero exactly)" } else { "" };
    let _ = writeln!(
        text,
        "  det A = prod (1 - t) - prod t = {:.6e}{exactly}; singular where it is zero",
        g.determinant()
    );
    let limit = GriffisDuffy::limit(c.design.manipulator());
    let _ = writeln!(
        text,
        "  joints off their sides by at most {:.1e} (recognised up to {limit:.1e})",
        g.deviation
    );
    let lengths = match &c.assembly {
        None => return,
        Some(Assembly::Incompatible { defect }) => {
            format!("cannot be assembled: they miss the condition by {defect:.1e} (relative)")
        }
        Some(Assembly::NoTriangles) => {
            "satisfy the condition, but have no real pose: the triangles of the legs do not close".into()
        }
        Some(Assembly::NotFound { .. }) => "satisfy the condition; no real pose was found".into(),
        Some(Assembly::Real { residual, .. }) => {
            format!("can be assembled, and the platform moves: real pose found, residual {residual:.1e}")
        }
    };
    let _ = writeln!(text, "  the lengths of the design {lengths}");
}

fn nearest(text: &mut String, c: &Checked, n: &NearestSingular) {
    let relative = n.distance / c.design.manipulator().size();
    let _ = writeln!(
        text,
        "\nnearest singular design found ({}, {}): {:.6e} away, {relative:.1e} of the size (norm of the change of all joints)",
        n.kind,
        list(&n.legs),
        n.distance
    );
    let _ = writeln!(text, "  none is nearer than {:.6e} (lengths in {})", c.at_least, c.design.units);
}
