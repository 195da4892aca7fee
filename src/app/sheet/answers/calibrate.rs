//! Joint centres and leg offsets from measurements, or poses to measure.

use crate::figure::figure;
use crate::{Sheet, Table, left, right};
use machine::calibration::{NoiseSource, StartName};
use num::shown::fixed;
use records::{CalibrateAnswer, CalibrateOutcome, CalibrationFrames, CalibrationRecord, ResidualsRecord};

/// The greatest number of unobservable changes written out.
const CHANGES: usize = 12;

/// The answer of `calibrate`; `with_file`: a design file was requested.
#[must_use]
pub fn calibrate(answer: &CalibrateAnswer, with_file: bool) -> Sheet {
    let word = match answer.outcome {
        CalibrateOutcome::Calibrated => "calibrated",
        CalibrateOutcome::NotIdentifiable => "not identifiable",
        CalibrateOutcome::Refuted => "refuted",
        CalibrateOutcome::Undecided => "undecided",
        CalibrateOutcome::Planned => "planned",
    };
    let mut out = Sheet::new();
    say!(out, "{}: {word}: {}", answer.name, answer.reason);
    let units = &answer.units;
    if let Some(found) = &answer.calibration {
        facts(&mut out, found, units);
        residuals(&mut out, found, units);
        machine(&mut out, found, units);
        doubts(&mut out, found, units);
    }
    if !answer.next_poses.is_empty() {
        say!(
            out,
            "\nposes to measure {}; each multiplies the standard deviations of the joints by its factor and leaves the greatest deviation shown:",
            if answer.calibration.is_some() { "next" } else { "first" }
        );
        if !answer.frames.is_usual() {
            say!(out, "{}", answer.frames.sentence);
        }
        let position = ["x", "y", "z"].map(|axis| format!("{axis} {units}"));
        let names = if answer.frames.is_usual() { ["roll", "pitch", "yaw"] } else { ["a", "b", "c"] };
        let angles = names.map(|angle| format!("{angle} {}", answer.frames.angles));
        let columns = position.into_iter().chain(angles).map(|title| right(title, 9));
        let gains = [right("factor", 0).gap(2), right(format!("deviation {units}"), 0).gap(2)];
        let mut table = Table::new(columns.chain(gains));
        for next in &answer.next_poses {
            let numbers = next.in_frames.position.iter().chain(&next.in_frames.angles).map(|x| figure(x.0));
            let gains = [figure(next.shrinks.0), figure(next.greatest_deviation.0)];
            table.row(numbers.chain(gains));
        }
        out.table(table);
    }
    match &answer.path {
        Some(path) => {
            say!(out, "wrote {path}");
        }
        None if with_file => out.line("No design was written."),
        None => {}
    }
    out
}

fn facts(out: &mut Sheet, found: &CalibrationRecord, units: &str) {
    if let Some([i, j]) = found.exchanged_legs {
        say!(
            out,
            "LEGS EXCHANGED? The lengths of legs {i} and {j} are five times nearer to the design when they change places: check the wiring, or the columns of the table."
        );
    }
    let source = match found.noise.source {
        NoiseSource::Given => "given",
        NoiseSource::Estimated => "estimated from the residuals",
        NoiseSource::Assumed => "assumed",
    };
    say!(
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
    say!(
        out,
        "noise ({source}): length {} {units}, position {} {units}, rotation {} deg",
        figure(found.noise.length.0),
        figure(found.noise.position.0),
        figure(found.noise.rotation_deg.0)
    );
    let begun = match found.start.taken {
        StartName::Nominal => "start: the design",
        StartName::ClosedForm => "start: the solution of the linear equations, without the design",
    };
    let other = match found.start.agree {
        Some(true) => "; the other start gives the same machine",
        Some(false) => "; the other start gives another machine with greater residuals",
        None => "",
    };
    say!(out, "{begun}{other}");
    if let Some(motions) = &found.motions {
        for (body, m) in [("base", &motions.base), ("platform", &motions.platform)] {
            let p = <[f64; 3]>::from(m.motion.position).map(figure);
            say!(
                out,
                "{body} moved into the frame of the design: by {} {units}; rms difference of the joints {} {units}",
                p.join(", "),
                figure(m.rms)
            );
        }
    }
}

fn residuals(out: &mut Sheet, found: &CalibrationRecord, units: &str) {
    let numbers = [right("rms", 8), right("greatest", 0).gap(2)];
    let columns = [left(format!("residuals [{units}]"), 15)].into_iter().chain(numbers);
    let mut table = Table::new(columns.chain([left("where", 0).gap(2)]));
    let rows = [
        ("before the fit", Some(&found.before)),
        ("after the fit", Some(&found.after)),
        ("leave-one-out", Some(&found.leave_one_out)),
        ("check measurements", found.check.as_ref()),
    ];
    for (name, residuals) in rows {
        let Some(ResidualsRecord { rms, greatest, .. }) = residuals else { continue };
        let Some(greatest) = greatest else { continue };
        let [rms, value] = [rms.0, greatest.value.0].map(figure);
        table.row([name.to_owned(), rms, value, format!("line {}, leg {}", greatest.line, greatest.leg)]);
    }
    out.space();
    out.table(table);
    let chi = &found.chi_square;
    let probability = chi.probability.map_or(String::new(), |p| format!(", p-value {}", figure(p)));
    say!(out, "chi-square {} with {} degrees of freedom{probability}", figure(chi.value), chi.freedoms);
}

/// Joints with their standard deviations, and the offsets of the legs.
fn machine(out: &mut Sheet, found: &CalibrationRecord, units: &str) {
    let columns = [left(format!("joint [{units}]"), 22)].into_iter();
    let columns = columns.chain(["x", "y", "z"].map(|axis| right(axis, 10)));
    let columns = columns.chain(["x", "y", "z"].map(|axis| right(format!("std {axis}"), 0).gap(2)));
    let mut table = Table::new(columns.chain([right("moved", 8).gap(2)]));
    for joint in &found.joints {
        let moved = joint.moved.iter().map(|x| x.0 * x.0).sum::<f64>().sqrt();
        let position = joint.position.map(|x| fixed(x.0, 4));
        let deviations = joint
            .deviations
            .map_or_else(|| ["held"; 3].map(str::to_owned), |deviations| deviations.map(|x| figure(x.0)));
        let name = [format!("{}.{}", joint.body, joint.joint)];
        table.row(name.into_iter().chain(position).chain(deviations).chain([figure(moved)]));
    }
    out.space();
    out.table(table);
    let mut table = Table::new([
        left(format!("leg offset [{units}]"), 0),
        right("offset", 9).gap(2),
        right("std", 0).gap(2),
    ]);
    for leg in &found.offsets {
        let deviation = leg.deviation.map_or("held".to_owned(), |d| figure(d.0));
        table.row([format!("leg {}", leg.leg), figure(leg.offset.0), deviation]);
    }
    out.table(table);
}

fn doubts(out: &mut Sheet, found: &CalibrationRecord, units: &str) {
    if let Some(poses) = &found.computed_poses {
        say!(
            out,
            "\nPoses computed with this machine have standard deviations of at most {} {units} and {} deg over {} poses (medians {} {units}, {} deg). The noise of their own lengths comes on top.",
            figure(poses.position_greatest.0),
            figure(poses.rotation_deg_greatest.0),
            poses.poses,
            figure(poses.position_median.0),
            figure(poses.rotation_deg_median.0)
        );
    }
    let o = &found.observability;
    say!(
        out,
        "\nobservability: volume {}, inverse condition {}, noise amplification {}, harmonic {}",
        figure(o.volume_index.0),
        figure(o.inverse_condition.0),
        figure(o.noise_amplification.0),
        figure(o.harmonic_index.0)
    );
    if !o.unobservable.is_empty() {
        out.line("changes of the machine that the measurements do not show:");
        for change in o.unobservable.iter().take(CHANGES) {
            say!(out, "  {}", change.words());
        }
        if o.unobservable.len() > CHANGES {
            say!(out, "  and {} more", o.unobservable.len() - CHANGES);
        }
    }
    for outlier in &found.outliers {
        let leg = outlier.leg.map_or(String::new(), |leg| format!(", leg {leg}"));
        say!(
            out,
            "outlier: line {}{leg}: {} standard deviations from the model (limit {}); weight {}",
            outlier.line,
            figure(outlier.distance.0),
            figure(outlier.threshold.0),
            figure(outlier.weight.0)
        );
    }
    if !found.indispensable.is_empty() {
        let lines: Vec<String> = found.indispensable.iter().map(ToString::to_string).collect();
        say!(out, "measurements without redundancy, which nothing checks: line {}", lines.join(", "));
    }
}
