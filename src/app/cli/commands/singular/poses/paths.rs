//! `--path` and `--between`: det J along paths of poses, and the assembly modes joined by regular paths.

use std::fmt::Write as _;

use super::SingularPosesArgs;
use crate::app::cli::poses;
use crate::app::cli::{Context, Failure, files};
use ::files::plot::{AlongFigure, AlongPart, sign_along};
use ask::{Design, PoseFrames, SignPath, SignsBetween, SingularPosesReport};
use platform::geom::Pose;
use records::{
    JoiningPathRecord, Number, PoseQuaternionRecord, SignPairRecord, SignPairsRecord, SignPartRecord,
    SignPathRecord,
};
use synthesis::singularity::{Sign, SignsAlong};

fn refuse(message: String) -> Failure {
    Failure::refused("poses::bad_path", message)
        .with_help("give two numbers of assembly modes as the command lists them; 0 is POSE")
}

/// The path of `--path` and `--via`, written to `--csv`.
pub(super) fn path(
    args: &SingularPosesArgs,
    design: &Design,
    report: &SingularPosesReport,
    context: &Context,
) -> Result<Option<SignPath>, Failure> {
    let Some(text) = &args.path else { return Ok(None) };
    let numbers =
        text.split_once(',').and_then(|(a, b)| Some([a.trim().parse().ok()?, b.trim().parse().ok()?]));
    let ends = numbers.ok_or_else(|| refuse(format!("--path: `{text}` is not two numbers")))?;
    let frames = args.frames.of(design);
    let of = ("--via", "poses::bad_pose");
    let via = args.via.iter().map(|text| poses::parse(text, &frames, of, context));
    let via: Vec<Pose> = via.collect::<Result<_, _>>()?;
    let path = report.path(design, ends, &via).map_err(|k| {
        refuse(format!("--path: there is no assembly mode {k}, there are {}", report.modes.len()))
    })?;
    if let Some(file) = &args.csv {
        files::write_text(file, &csv(&path, &frames))?;
    }
    if let Some(file) = &args.path_svg {
        files::write_text(file, &sign_along(&figure(&path, design)))?;
    }
    Ok(Some(path))
}

fn csv(path: &SignPath, frames: &PoseFrames) -> String {
    let mut out = format!("part,u,{},det\n", poses::csv_names(frames).join(","));
    for (part, u, pose, det) in &path.values {
        let _ = writeln!(out, "{},{u},{},{det}", part + 1, poses::csv_fields(frames, pose));
    }
    out
}

pub(super) fn path_record(path: &SignPath) -> SignPathRecord {
    let parts = path.parts.iter().enumerate().map(|(k, s)| {
        let values = path.values.iter().filter(|v| v.0 == k).map(|v| [Number(v.1), Number(v.3)]);
        SignPartRecord::new(s, values.collect())
    });
    SignPathRecord {
        from: path.ends[0],
        to: path.ends[1],
        poses: path.poses.iter().map(PoseQuaternionRecord::from).collect(),
        keeps_sign: path.keeps_sign(),
        parts: parts.collect(),
    }
}

fn figure(path: &SignPath, design: &Design) -> AlongFigure {
    let part = |(k, s): (usize, &SignsAlong)| AlongPart {
        values: path.values.iter().filter(|v| v.0 == k).map(|v| (v.1, v.3)).collect(),
        pieces: s.pieces.iter().map(|p| (p.from, p.to, p.sign.map_or(0, Sign::value))).collect(),
    };
    AlongFigure {
        title: format!("{}: from mode {} to mode {}", design.name, path.ends[0], path.ends[1]),
        note: "grounds: proved sign of det J; lines: no sign proved. Leg lines not divided by lengths, over the size to the sixth; 0 is the pose"
            .into(),
        quantity: "det J".into(),
        parts: path.parts.iter().enumerate().map(part).collect(),
    }
}

pub(super) fn pairs_record(between: &SignsBetween) -> SignPairsRecord {
    let pair = |([i, j], s): &([usize; 2], SignsAlong)| SignPairRecord {
        modes: [i + 1, j + 1],
        straight: s.into(),
        changes: s.changes().count(),
        joined: between.joins(*i, *j),
    };
    let groups = between.joined.groups.iter().map(|g| g.iter().map(|k| k + 1).collect());
    SignPairsRecord {
        signs: between.joined.signs.iter().map(|s| (*s).into()).collect(),
        pairs: between.straight.iter().map(pair).collect(),
        groups: groups.collect(),
        paths: between.joined.ways.iter().map(JoiningPathRecord::from).collect(),
    }
}
