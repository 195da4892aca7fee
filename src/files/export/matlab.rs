//! A script for MATLAB and Octave.

use std::fmt::Write as _;

use super::text::{commented, one_line, real};
use super::{Export, ExportedFile, Writer};

/// The format `matlab`.
pub(super) static WRITER: Writer = Writer::new(
    "3x6 arrays in metres and the inverse kinematics, for MATLAB, Octave and Simscape",
    |export| Ok(vec![ExportedFile::new("platform.m", script(export))]),
);

/// A string literal: quotes are doubled.
fn quoted(text: &str) -> String {
    format!("'{}'", one_line(text).replace('\'', "''"))
}

fn matrix(out: &mut String, name: &str, rows: &[Vec<f64>]) {
    let _ = writeln!(out, "stewart.{name} = [");
    for row in rows {
        let row: Vec<String> = row.iter().map(|x| real(*x)).collect();
        let _ = writeln!(out, "  {};", row.join(", "));
    }
    out.push_str("];\n");
}

/// Results of a calibration besides the joints: offsets, and the joint uncertainty of the unknowns.
fn calibration(out: &mut String, export: &Export) {
    let m = export.unit.metres;
    let column = |values: &[f64]| values.iter().map(|x| vec![x * m]).collect::<Vec<_>>();
    if let Some(offsets) = &export.leg_offsets {
        out.push_str(
            "% offsets: 6x1, length that each leg shows, minus the distance of its joints; l, L and lengths are shown lengths\n",
        );
        matrix(out, "offsets", &column(offsets));
    }
    let Some(found) = &export.calibration else { return };
    out.push_str(
        "% unknowns: names of calibrated coordinates of joints and of offsets; values, deviations: n x 1, metres; covariance: n x n, square metres\n",
    );
    let names: Vec<String> = found.names.iter().map(|name| quoted(name)).collect();
    let _ = writeln!(out, "stewart.unknowns = {{{}}};", names.join("; "));
    matrix(out, "values", &column(&found.values));
    matrix(out, "deviations", &column(&found.deviations));
    let rows = found.correlations.row_iter().map(|row| row.iter().copied().collect());
    matrix(out, "correlations", &rows.collect::<Vec<_>>());
    out.push_str(
        "stewart.covariance = diag(stewart.deviations) * stewart.correlations * diag(stewart.deviations);\n",
    );
}

fn script(export: &Export) -> String {
    let m = export.unit.metres;
    let mut out = commented("%", export.heading("m"));
    out.push_str(
        "% a, b: 3x6, column i belongs to leg i; a in the base frame, b in the platform frame.\n\
         % R, p: home pose. l: 6x1 leg lengths at home. T: n x 16, rows of 4x4 poses (row by row); L: n x 6 lengths.\n\
         % stewart.lengths(R, p) gives the six lengths at any pose.\n",
    );
    let _ = writeln!(out, "stewart = struct();\nstewart.name = {};", quoted(&export.name));
    let per_leg = |point: &dyn Fn(usize) -> nalgebra::Point3<f64>| -> Vec<Vec<f64>> {
        (0..3).map(|k| (0..6).map(|i| point(i)[k] * m).collect()).collect()
    };
    matrix(&mut out, "a", &per_leg(&|i| export.legs[i].foot));
    matrix(&mut out, "b", &per_leg(&|i| export.bodies[1].joints[export.legs[i].platform].at));
    let r = export.home.rotation.matrix();
    matrix(&mut out, "R", &[0, 1, 2].map(|i| r.row(i).iter().copied().collect()));
    matrix(&mut out, "p", &[0, 1, 2].map(|i| vec![export.home.position[i] * m]));
    matrix(&mut out, "l", &export.shown_at(&export.home).map(|l| vec![l * m]));
    let poses: Vec<_> = export.workspace.iter().chain(&export.trajectory).collect();
    let row = |pose: &&platform::geom::Pose| -> Vec<f64> {
        let (r, p) = (pose.rotation.matrix(), pose.position * m);
        let mut row: Vec<f64> = (0..3).flat_map(|i| [r[(i, 0)], r[(i, 1)], r[(i, 2)], p[i]]).collect();
        row.extend([0.0, 0.0, 0.0, 1.0]);
        row
    };
    matrix(&mut out, "T", &poses.iter().map(row).collect::<Vec<_>>());
    let lengths = poses.iter().map(|p| export.shown_at(p).iter().map(|l| l * m).collect());
    matrix(&mut out, "L", &lengths.collect::<Vec<_>>());
    calibration(&mut out, export);
    let offsets = if export.leg_offsets.is_some() { " + stewart.offsets" } else { "" };
    let _ = writeln!(
        out,
        "stewart.lengths = @(R, p) sqrt(sum((R * stewart.b + repmat(p, 1, 6) - stewart.a).^2, 1))'{offsets};"
    );
    out.push_str(
        "% the lengths written are those of the formula\n\
         for stewart_k = 1:size(stewart.T, 1)\n\
         \x20 stewart_T = reshape(stewart.T(stewart_k, :), 4, 4)';\n\
         \x20 stewart_d = stewart.lengths(stewart_T(1:3, 1:3), stewart_T(1:3, 4)) - stewart.L(stewart_k, :)';\n\
         \x20 assert(max(abs(stewart_d)) <= 1e-12 * max(abs(stewart.L(:))));\n\
         end\n\
         clear stewart_k stewart_T stewart_d\n",
    );
    out
}
