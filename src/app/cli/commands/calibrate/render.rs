//! A calibration as text.

use std::fmt::Write as _;

use machine::calibration::{NoiseSource, StartName};
use num::shown::fixed;
use num::shown::significant;
use records::{
    CalibrateAnswer, CalibrateOutcome, CalibrationFrames, CalibrationRecord, Number, ResidualsRecord,
};

/// Unobservable changes that are written out.
const CHANGES: usize = 12;

/// The outcome, the machine, and what says how far to trust it.
pub(super) fn text(answer: &CalibrateAnswer, wanted: bool) -> String {
    let word = match answer.outcome {
        CalibrateOutcome::Calibrated => "calibrated",
        CalibrateOutcome::NotIdentifiable => "not identifiable",
        CalibrateOutcome::Refuted => "refuted",
        CalibrateOutcome::Undecided => "undecided",
        CalibrateOutcome::Planned => "planned",
    };
    let mut out = format!("{}: {word}: {}\n", answer.name, answer.reason);
    let units = &answer.units;
    if let Some(found) = &answer.calibration {
        facts(&mut out, found, units);
        residuals(&mut out, found, units);
        machine(&mut out, found, units);
        doubts(&mut out, found, units);
    }
    if !answer.next_poses.is_empty() {
        let _ = writeln!(
            out,
            "\nposes to measure {}: x, y, z ({units}), roll, pitch, yaw (deg); factor of the deviations; greatest one after it",
            if answer.calibration.is_some() { "next" } else { "first" }
        );
        for next in &answer.next_poses {
            let pose: Vec<String> = next
                .pose
                .position
                .iter()
                .map(|x| format!("{:>10}", fixed(x.0, 3)))
                .chain(next.rpy_deg.iter().map(|x| format!("{:>9}", fixed(x.0, 3))))
                .collect();
            let _ = writeln!(
                out,
                "{}  {:.4}  {}",
                pose.join(" "),
                next.shrinks.0,
                significant(next.greatest_deviation.0)
            );
        }
    }
    match &answer.path {
        Some(path) => {
            let _ = writeln!(out, "wrote {path}");
        }
        None if wanted => out.push_str("no design was written\n"),
        None => {}
    }
    out
}

fn facts(out: &mut String, found: &CalibrationRecord, units: &str) {
    if let Some([i, j]) = found.exchanged_legs {
        let _ = writeln!(
            out,
            "LEGS EXCHANGED? The lengths of legs {i} and {j} are five times nearer to the design when they change places: look at the wiring or the columns of the table."
        );
    }
    let source = match found.noise.source {
        NoiseSource::Given => "given",
        NoiseSource::Estimated => "estimated from the residuals",
        NoiseSource::Assumed => "assumed",
    };
    let _ = writeln!(
        out,
        "{} poses, {} unknowns, rank {}; joints in the frames of the {}",
        found.poses,
        found.unknowns,
        found.observability.rank,
        match found.frames {
            CalibrationFrames::Measured => "measurements",
            CalibrationFrames::Design => "design",
        }
    );
    let _ = writeln!(
        out,
        "noise ({source}): length {} {units}, position {} {units}, rotation {} deg",
        significant(found.noise.length.0),
        significant(found.noise.position.0),
        significant(found.noise.rotation_deg.0)
    );
    let begun = match found.start.taken {
        StartName::Nominal => "begun at the design",
        StartName::ClosedForm => "begun at the linear equations, without the design",
    };
    let other = match found.start.agree {
        Some(true) => "; the other start ends at the same machine",
        Some(false) => "; the other start ends at another machine, which fits worse",
        None => "",
    };
    let _ = writeln!(out, "{begun}{other}");
    if let Some(motions) = &found.motions {
        for (body, m) in [("base", &motions.base), ("platform", &motions.platform)] {
            let p = <[f64; 3]>::from(m.motion.position).map(significant);
            let _ = writeln!(
                out,
                "{body} carried to the design: shift {} {units}, rms {} {units} left",
                p.join(", "),
                significant(m.rms)
            );
        }
    }
}

fn residuals(out: &mut String, found: &CalibrationRecord, units: &str) {
    let _ = writeln!(out, "\nresiduals [{units}]        rms    greatest  where");
    let rows = [
        ("before", Some(&found.before)),
        ("after", Some(&found.after)),
        ("pose left out", Some(&found.left_out)),
        ("check", found.check.as_ref()),
    ];
    for (name, residuals) in rows {
        let Some(ResidualsRecord { rms, greatest, .. }) = residuals else { continue };
        let Some(greatest) = greatest else { continue };
        let _ = writeln!(
            out,
            "{name:<15} {:>12} {:>11}  line {}, leg {}",
            significant(rms.0),
            significant(greatest.value.0),
            greatest.line,
            greatest.leg
        );
    }
    let chi = &found.chi_square;
    let probability = chi.probability.map_or(String::new(), |p| format!(", probability {}", significant(p)));
    let _ = writeln!(
        out,
        "chi-square {} with {} degrees of freedom{probability}",
        significant(chi.value),
        chi.freedoms
    );
}

fn machine(out: &mut String, found: &CalibrationRecord, units: &str) {
    let _ = writeln!(
        out,
        "\n{:<22} {:>12} {:>12} {:>12}   standard deviations [{units}]     moved",
        "joint", "x", "y", "z"
    );
    let numbers = |list: &[Number; 3], width: usize| {
        list.iter().map(|x| format!("{:>width$}", fixed(x.0, 4))).collect::<Vec<_>>().join(" ")
    };
    for joint in &found.joints {
        let moved = joint.moved.iter().map(|x| x.0 * x.0).sum::<f64>().sqrt();
        let deviations = joint.deviations.map_or_else(
            || format!("{:>32}", "held"),
            |d| d.iter().map(|x| format!("{:>10}", significant(x.0))).collect::<Vec<_>>().join(" "),
        );
        let _ = writeln!(
            out,
            "{:<22} {}  {deviations}  {:>8}",
            format!("{}.{}", joint.body, joint.joint),
            numbers(&joint.position, 12),
            significant(moved)
        );
    }
    for leg in &found.offsets {
        let deviation = leg.deviation.map_or("held".to_string(), |d| significant(d.0));
        let _ = writeln!(out, "offset {}  {:>12}  {deviation:>12}", leg.leg, significant(leg.offset.0));
    }
}

fn doubts(out: &mut String, found: &CalibrationRecord, units: &str) {
    if let Some(poses) = &found.computed_poses {
        let _ = writeln!(
            out,
            "\nposes computed with it are off by {} {units} and {} deg (deviations, greatest of {} poses; medians {} {units}, {} deg), besides the noise of their lengths",
            significant(poses.position_greatest.0),
            significant(poses.rotation_deg_greatest.0),
            poses.poses,
            significant(poses.position_median.0),
            significant(poses.rotation_deg_median.0)
        );
    }
    let o = &found.observability;
    let _ = writeln!(
        out,
        "\nobservability: volume {}, inverse condition {}, noise amplification {}, harmonic {}",
        significant(o.volume_index.0),
        significant(o.inverse_condition.0),
        significant(o.noise_amplification.0),
        significant(o.harmonic_index.0)
    );
    if !o.unobservable.is_empty() {
        out.push_str("changes that are not seen:\n");
        for change in o.unobservable.iter().take(CHANGES) {
            let _ = writeln!(out, "  {}", change.words());
        }
        if o.unobservable.len() > CHANGES {
            let _ = writeln!(out, "  and {} more", o.unobservable.len() - CHANGES);
        }
    }
    for outlier in &found.outliers {
        let leg = outlier.leg.map_or(String::new(), |leg| format!(", leg {leg}"));
        let _ = writeln!(
            out,
            "outlier: line {}{leg}: {} deviations from the model, where right ones stay below {}; weight {}",
            outlier.line,
            significant(outlier.distance.0),
            significant(outlier.threshold.0),
            significant(outlier.weight.0)
        );
    }
    if !found.indispensable.is_empty() {
        let lines: Vec<String> = found.indispensable.iter().map(ToString::to_string).collect();
        let _ = writeln!(out, "measurements that nothing checks: line {}", lines.join(", "));
    }
}
