//! `--path` and `--between`: det J along paths of poses, and which assembly modes paths without singular pose join.

use std::fmt::Write as _;

use super::{Args, Judged};
use crate::app::cli::failure::Failure;
use crate::app::cli::files;
use crate::app::cli::poses;
use ::files::plot::{AlongFigure, AlongPart, sign_along};
use ask::Design;
use platform::geom::Pose;
use platform::manipulator::leg_determinant;
use records::{
    Number, PoseQuaternionRecord, SignOutcome, SignPairRecord, SignPairsRecord, SignPartRecord,
    SignPathRecord, WayRecord,
};
use synthesis::singularity::{JoinOptions, Joined, Sign, SignsAlong, between, join, signs_along};

/// Values of det J listed on each straight part of a path.
const STEPS: usize = 100;

/// The path of `--path`: its poses and the signs on each straight part.
pub(super) struct Path {
    ends: [usize; 2],
    poses: Vec<Pose>,
    parts: Vec<SignsAlong>,
    /// `(part, u, pose, det J)`.
    values: Vec<(usize, f64, Pose, f64)>,
}

/// What `--between` found: straight paths of all pairs of modes, and groups of modes.
pub(super) struct Between {
    straight: Vec<([usize; 2], SignsAlong)>,
    joined: Joined,
}

fn refuse(message: String) -> Failure {
    Failure::refused("poses::bad_path", message)
        .with_help("give two numbers of assembly modes as the command lists them; 0 is POSE")
}

/// The path of `--path` and `--via`, written to `--csv`.
pub(super) fn path(
    args: &Args,
    design: &Design,
    middle: &Pose,
    modes: &[Judged],
) -> Result<Option<Path>, Failure> {
    let Some(text) = &args.path else { return Ok(None) };
    let numbers =
        text.split_once(',').and_then(|(a, b)| Some((a.trim().parse().ok()?, b.trim().parse().ok()?)));
    let Some((from, to)) = numbers else {
        return Err(refuse(format!("--path: `{text}` is not two numbers")));
    };
    let end = |k: usize| match k.checked_sub(1) {
        None => Ok(*middle),
        Some(k) => modes.get(k).map(|m| m.pose).ok_or_else(|| {
            refuse(format!("--path: there is no assembly mode {}, there are {}", k + 1, modes.len()))
        }),
    };
    let mut chain = vec![end(from)?];
    for via in &args.via {
        chain.push(poses::parse(via, design, "--via", "poses::bad_pose")?);
    }
    chain.push(end(to)?);
    let m = design.manipulator();
    let parts = chain.windows(2).map(|w| signs_along(m, &w[0], &w[1])).collect();
    let mut values = Vec::new();
    for (part, w) in chain.windows(2).enumerate() {
        for k in 0..=STEPS {
            let u = k as f64 / STEPS as f64;
            let pose = between(&w[0], &w[1], u);
            values.push((part, u, pose, leg_determinant(m, &pose)));
        }
    }
    let path = Path { ends: [from, to], poses: chain, parts, values };
    if let Some(file) = &args.csv {
        files::write_text(file, &path.csv())?;
    }
    if let Some(file) = &args.path_svg {
        files::write_text(file, &sign_along(&path.figure(design)))?;
    }
    Ok(Some(path))
}

/// All pairs of modes, and the search for paths between those of equal sign.
pub(super) fn all_pairs(args: &Args, design: &Design, modes: &[Judged], seed: u64) -> Option<Between> {
    if !args.between {
        return None;
    }
    let m = design.manipulator();
    let ends: Vec<Pose> = modes.iter().map(|mode| mode.pose).collect();
    let pairs = (0..ends.len()).flat_map(|i| (i + 1..ends.len()).map(move |j| [i, j]));
    let straight = pairs.map(|[i, j]| ([i, j], signs_along(m, &ends[i], &ends[j]))).collect();
    let joined = join(m, &ends, &JoinOptions { samples: args.samples, seed });
    Some(Between { straight, joined })
}

impl Path {
    fn csv(&self) -> String {
        let mut out = String::from("part,u,x,y,z,qw,qx,qy,qz,det\n");
        for (part, u, pose, det) in &self.values {
            let _ = writeln!(out, "{},{u},{},{det}", part + 1, poses::csv_fields(pose));
        }
        out
    }

    pub(super) fn record(&self) -> SignPathRecord {
        let parts = self.parts.iter().enumerate().map(|(k, s)| {
            let values = self.values.iter().filter(|v| v.0 == k).map(|v| [Number(v.1), Number(v.3)]);
            SignPartRecord::new(s, values.collect())
        });
        SignPathRecord {
            from: self.ends[0],
            to: self.ends[1],
            poses: self.poses.iter().map(PoseQuaternionRecord::from).collect(),
            keeps_sign: self.keeps_sign(),
            parts: parts.collect(),
        }
    }

    fn figure(&self, design: &Design) -> AlongFigure {
        let part = |(k, s): (usize, &SignsAlong)| AlongPart {
            values: self.values.iter().filter(|v| v.0 == k).map(|v| (v.1, v.3)).collect(),
            pieces: s.pieces.iter().map(|p| (p.from, p.to, p.sign.map_or(0, Sign::value))).collect(),
        };
        AlongFigure {
            title: format!("{}: from mode {} to mode {}", design.name, self.ends[0], self.ends[1]),
            note: "grounds: proved sign of det J; lines: no sign proved. Leg lines not divided by lengths, over the size to the sixth; 0 is the pose"
                .into(),
            quantity: "det J".into(),
            parts: self.parts.iter().enumerate().map(part).collect(),
        }
    }

    /// Whether det J is proved to keep its sign (`true`), proved to change it (`false`), or neither.
    fn keeps_sign(&self) -> Option<bool> {
        if self.parts.iter().all(|s| s.kept().is_some()) {
            return Some(true);
        }
        self.parts.iter().any(|s| s.changes().next().is_some()).then_some(false)
    }
}

impl Between {
    fn joined(&self, i: usize, j: usize) -> Option<bool> {
        if self.joined.groups.iter().any(|g| g.contains(&i) && g.contains(&j)) {
            return Some(true);
        }
        match (self.joined.signs[i], self.joined.signs[j]) {
            (Some(x), Some(y)) if x != y => Some(false),
            _ => None,
        }
    }

    pub(super) fn record(&self) -> SignPairsRecord {
        let pair = |([i, j], s): &([usize; 2], SignsAlong)| SignPairRecord {
            modes: [i + 1, j + 1],
            straight: s.into(),
            changes: s.changes().count(),
            joined: self.joined(*i, *j),
        };
        let groups = self.joined.groups.iter().map(|g| g.iter().map(|k| k + 1).collect());
        SignPairsRecord {
            signs: self.joined.signs.iter().map(|s| (*s).into()).collect(),
            pairs: self.straight.iter().map(pair).collect(),
            groups: groups.collect(),
            ways: self.joined.ways.iter().map(WayRecord::from).collect(),
        }
    }
}

/// What det J does along a path, in words.
pub(super) fn path_text(r: &SignPathRecord) -> String {
    let mut out = format!("path from mode {} to mode {} (0 is the pose):\n", r.from, r.to);
    for (k, part) in r.parts.iter().enumerate() {
        let _ = writeln!(out, "  part {}", k + 1);
        for p in &part.pieces {
            let told = match p.sign.0 {
                Some(sign) if sign > 0 => "det J > 0, proved",
                Some(_) => "det J < 0, proved",
                None if p.singular => "a singular pose, proved by a change of sign",
                None => "det J vanishes or nearly so",
            };
            let _ = writeln!(out, "    {:<14} to {:<14} {told}", p.from.0, p.to.0);
        }
    }
    out
}

/// Which modes are joined, in words.
pub(super) fn pairs_text(r: &SignPairsRecord) -> String {
    let n = r.signs.len();
    let mut out = String::from(
        "straight paths between modes: = det J keeps its sign (proved), x changes it (proved), ? neither proved\n     ",
    );
    for j in 1..=n {
        let _ = write!(out, "{j:>3}");
    }
    for i in 1..=n {
        let _ = write!(out, "\n  {i:>3}");
        for j in 1..=n {
            let found = r.pairs.iter().find(|s| s.modes == [i.min(j), i.max(j)]);
            let mark = match found.map(|s| s.straight) {
                None => ".",
                Some(SignOutcome::KeepsSign) => "=",
                Some(SignOutcome::Crosses) => "x",
                Some(SignOutcome::Undecided) => "?",
            };
            let _ = write!(out, "{mark:>3}");
        }
    }
    out.push_str("\nmodes joined by paths without singular pose (proved):\n");
    for group in &r.groups {
        let sign = match group.first().and_then(|k| r.signs.get(k - 1)?.0) {
            Some(sign) if sign > 0 => "det J > 0",
            Some(_) => "det J < 0",
            None => "sign not proved",
        };
        let names: Vec<String> = group.iter().map(ToString::to_string).collect();
        let _ = writeln!(out, "  {sign}: {}", names.join(", "));
    }
    out
}
