//! The folder of a sweep: its plan, its parts, their manifests.
//!
//! `sweep.json` holds plan, base design and seed. Each shard has a part and, written after it, a manifest with the
//! digest of the part. A shard is done if both are present and agree. All files are written under temporary names and
//! renamed, so that a file with its final name is whole.

use std::fs::{self, File};
use std::io::{BufWriter, ErrorKind, Write};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use serde::Serialize;

use super::context::{Context, format_of};
use super::exit::Exit;
use super::failure::Failure;
use super::files::{self, OutputPath};
use crate::app::presets::PRESETS;
use ::files::design::{Format, Violation};
use ask::whole::{WholeFile, part_of};
use records::{
    DamagedPartRecord, SCHEMA_VERSION, SweepFolderRecord, SweepManifestRecord, SweepStatusAnswer,
    SweepTextRecord, sha256,
};
use sweep::part::{PartError, PartReader, PartWriter};
use sweep::plan::{self, BaseName, BasePlan, PlanFiles, PlanText};
use sweep::{Digested, RowChunk, Sweep, SweepCell, digest_of};

/// The file that describes the sweep of the folder.
const SWEEP: &str = "sweep.json";

/// The key of the plan's digest in a part.
const PLAN_NOTE: &str = "equipod.plan_sha256";

/// Greatest number of shards: each has two files.
pub(crate) const MOST_SHARDS: u64 = 1_000_000;

/// The folder of a sweep.
#[derive(Debug)]
pub(crate) struct SweepFolder {
    pub(crate) path: PathBuf,
    pub(crate) record: SweepFolderRecord,
}

/// The state of a shard.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum ShardState {
    Done(Box<SweepManifestRecord>),
    Missing,
    Damaged(String),
}

/// The depth of the check of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PartCheck {
    /// The whole part: its digest is compared with the manifest.
    Whole,
    /// The size only, which detects truncation. For parts of other jobs: with as many jobs as shards, complete checks
    /// by each would cost the square.
    Size,
}

fn failed(path: &Path) -> impl Fn(std::io::Error) -> Failure + '_ {
    move |error| match error.kind() {
        // a limit on the size of files is not the fault of the arguments either
        ErrorKind::FileTooLarge => {
            let message = format!("{} cannot be written: {error}", path.display());
            Failure::new(Exit::Internal, "file::disk_full", message)
                .with_help("free some space, or write elsewhere")
        }
        _ => files::not_written(&path.display().to_string(), &error),
    }
}

/// The failure for a part that cannot be written.
pub(crate) fn part_failed(path: &Path, error: &PartError) -> Failure {
    match error.system() {
        Some(system) => failed(path)(std::io::Error::new(system.kind(), system.to_string())),
        None => Failure::internal(format!("{}: {error}", path.display())),
    }
}

/// Writes a file under another name with `write`, flushes it to the disk, and renames it.
pub(crate) fn write_whole<T>(
    path: &Path,
    write: impl FnOnce(BufWriter<File>) -> Result<Option<(BufWriter<File>, T)>, Failure>,
) -> Result<Option<T>, Failure> {
    let whole = WholeFile::begin(path).map_err(failed(path))?;
    let file = whole.file().try_clone().map_err(failed(path))?;
    let Some((mut writer, value)) = write(BufWriter::with_capacity(1 << 16, file))? else { return Ok(None) };
    writer.flush().map_err(failed(path))?;
    whole.finish().map_err(failed(path))?;
    Ok(Some(value))
}

/// Writes a record whole.
fn write_record(path: &Path, record: &impl Serialize) -> Result<(), Failure> {
    WholeFile::write(path, files::record_text(record)?.as_bytes()).map_err(failed(path))
}

impl SweepFolder {
    /// Begins a sweep in a folder, or continues it.
    pub(crate) fn begin(
        path: &Path,
        texts: &SweepTexts,
        sweep: &Sweep,
        shards: Option<u64>,
    ) -> Result<Self, Failure> {
        files::make_folder(path)?;
        let there = path.join(SWEEP).exists().then(|| Self::open(path)).transpose()?;
        let shards = shards
            .or(there.as_ref().map(|f| f.record.shards))
            .unwrap_or_else(|| default_shards(sweep.count()));
        let record = SweepFolderRecord {
            schema_version: SCHEMA_VERSION,
            name: sweep.plan.name.clone(),
            version: env!("CARGO_PKG_VERSION").into(),
            seed: sweep.seed,
            candidates: sweep.count(),
            shards,
            plan_sha256: texts.sha256(),
            plan: texts.plan.clone(),
            design: texts.design.clone(),
            drives: texts.drives.clone(),
            poses: texts.poses.clone(),
        };
        if let Some(there) = there {
            return there.goes_on(&record);
        }
        // two processes that begin at the same time write the same
        write_record(&path.join(SWEEP), &record)?;
        Ok(Self { path: path.to_path_buf(), record })
    }

    /// Refuses to continue another sweep.
    fn goes_on(self, requested: &SweepFolderRecord) -> Result<Self, Failure> {
        let own = &self.record;
        let differs = [
            ("the plan or its base design", own.plan_sha256 == requested.plan_sha256),
            ("the seed", own.seed == requested.seed),
            ("the number of shards", own.shards == requested.shards),
            ("the version of the program", own.version == requested.version),
        ];
        let Some((what, _)) = differs.iter().find(|(_, same)| !same) else { return Ok(self) };
        let message = format!("{} contains another sweep: {what} differs", self.path.display());
        let help = format!(
            "name another folder; this one is of \"{}\", seed {}, {} shards, equipod {}",
            own.name, own.seed, own.shards, own.version
        );
        Err(Failure::refused("sweep::other_sweep", message).with_help(help))
    }

    /// The sweep in a folder.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        let file = path.join(SWEEP);
        let Some(record) = files::found_record::<SweepFolderRecord>(&file) else {
            let message = format!(
                "{} is not the folder of a sweep: {SWEEP} is missing or cannot be read",
                path.display()
            );
            return Err(Failure::refused("sweep::no_sweep", message)
                .with_help("give the folder DIR of `equipod sweep run PLAN -o DIR`"));
        };
        Ok(Self { path: path.to_path_buf(), record })
    }

    /// The texts from which it was begun.
    pub(crate) fn texts(&self) -> SweepTexts {
        let SweepFolderRecord { plan, design, drives, poses, .. } = self.record.clone();
        SweepTexts { plan, design, drives, poses }
    }

    /// The sweep, ready to recompute its rows.
    pub(crate) fn sweep(&self) -> Result<Sweep, Failure> {
        if self.record.version != env!("CARGO_PKG_VERSION") {
            let message = format!("{} was computed by equipod {}", self.path.display(), self.record.version);
            return Err(Failure::refused("sweep::other_sweep", message)
                .with_help("candidates are computed again by the same version"));
        }
        let texts = self.texts();
        if texts.sha256() != self.record.plan_sha256 {
            let message =
                format!("{}: the digest of plan and design is wrong", self.path.join(SWEEP).display());
            return Err(Failure::refused("sweep::no_sweep", message)
                .with_help("the file was altered: begin anew in another folder"));
        }
        texts.sweep(self.record.seed, &self.path.join(SWEEP).display().to_string())
    }

    /// Name of the part of a shard, without extension.
    fn stem(&self, shard: u64) -> String {
        let wide = self.record.shards.to_string().len().max(5);
        format!("part-{shard:0wide$}-of-{:0wide$}", self.record.shards)
    }

    pub(crate) fn part(&self, shard: u64) -> PathBuf {
        self.path.join(self.stem(shard) + ".parquet")
    }

    fn manifest(&self, shard: u64) -> PathBuf {
        self.path.join(self.stem(shard) + ".json")
    }

    /// The notes on its origin in every part.
    pub(crate) fn notes(&self, description: Option<&str>, shard: Option<u64>) -> Vec<(String, String)> {
        let r = &self.record;
        let mut notes = vec![
            ("equipod.name".into(), r.name.clone()),
            ("equipod.version".into(), r.version.clone()),
            ("equipod.seed".into(), r.seed.to_string()),
            ("equipod.candidates".into(), r.candidates.to_string()),
            (PLAN_NOTE.into(), r.plan_sha256.clone()),
            ("equipod.plan".into(), r.plan.text.clone()),
            ("equipod.design".into(), r.design.text.clone()),
        ];
        notes.extend(description.map(|text| ("equipod.description".into(), text.to_owned())));
        notes.extend(shard.map(|s| ("equipod.shard".into(), format!("{s}/{}", r.shards))));
        notes
    }

    /// Writes the table of poses named by the candidates of a sweep into the folder of their design files.
    ///
    /// # Errors
    /// Exit 2: another file has its name.
    pub(crate) fn write_poses(&self, sweep: &Sweep, folder: &Path) -> Result<(), Failure> {
        let (Some(text), Some(named)) = (&self.record.poses, &sweep.base.design.workspace.trajectory) else {
            return Ok(());
        };
        let path = folder.join(&named.file);
        match files::found_in_folder(&path) {
            Some(there) if there == text.as_bytes() => Ok(()),
            _ if path.exists() => {
                let message = format!("{} is not the table of poses of the sweep", path.display());
                Err(Failure::refused("sweep::other_poses", message)
                    .with_help("the name is taken by --candidates: write them into another folder"))
            }
            _ => files::write_text(&path, text),
        }
    }

    /// The state of a shard.
    pub(crate) fn state(&self, shard: u64, check: PartCheck) -> ShardState {
        let (part, manifest) = (self.part(shard), self.manifest(shard));
        if !manifest.exists() {
            return ShardState::Missing;
        }
        let Some(record) = files::found_record::<SweepManifestRecord>(&manifest) else {
            return ShardState::Damaged("the manifest cannot be read".into());
        };
        let r = &self.record;
        if (record.shard, record.shards, record.seed) != (shard, r.shards, r.seed)
            || (&record.plan_sha256, &record.version) != (&r.plan_sha256, &r.version)
        {
            return ShardState::Damaged("the manifest is of another sweep".into());
        }
        let seen = match check {
            PartCheck::Whole => {
                files::open_regular(&part).and_then(digest_of).map(|(bytes, sha256)| (bytes, Some(sha256)))
            }
            PartCheck::Size => fs::metadata(&part).map(|m| (m.len(), None)),
        };
        match seen {
            Err(error) if error.kind() == ErrorKind::NotFound => ShardState::Missing,
            Err(error) => ShardState::Damaged(format!("the part cannot be read: {error}")),
            Ok((bytes, _)) if bytes != record.bytes => {
                ShardState::Damaged(format!("the part has {bytes} bytes instead of {}", record.bytes))
            }
            Ok((_, Some(sha256))) if sha256 != record.sha256 => {
                ShardState::Damaged("the part has another digest".into())
            }
            Ok(_) => ShardState::Done(Box::new(record)),
        }
    }

    /// Opens the part of a finished shard.
    pub(crate) fn reader(&self, shard: u64) -> Result<PartReader, Failure> {
        let path = self.part(shard);
        let unreadable = |why: String| {
            Failure::refused("sweep::damaged", format!("{} cannot be read: {why}", path.display()))
                .with_help("`equipod sweep run` computes it again")
        };
        let file = files::open_regular(&path).map_err(|e| unreadable(e.to_string()))?;
        let reader = PartReader::new(file).map_err(|e| unreadable(e.to_string()))?;
        if reader.note(PLAN_NOTE).as_ref() != Some(&self.record.plan_sha256) {
            return Err(unreadable("it is of another plan".into()));
        }
        Ok(reader)
    }

    /// Writes the part of a shard from its rows, then its manifest. The function `go_on` gets the number of finished
    /// candidates, and may stop the work; the result is then `None`.
    pub(crate) fn write_part(
        &self,
        sweep: &Sweep,
        shard: u64,
        (first, candidates): (u64, u64),
        mut rows: impl Iterator<Item = RowChunk>,
        mut go_on: impl FnMut(u64) -> ControlFlow<()>,
    ) -> Result<Option<SweepManifestRecord>, Failure> {
        let (path, manifest) = (self.part(shard), self.manifest(shard));
        // a manifest must never describe a missing part
        match fs::remove_file(&manifest) {
            Err(error) if error.kind() != ErrorKind::NotFound => return Err(failed(&manifest)(error)),
            _ => {}
        }
        let (began, mut waited) = (Instant::now(), Duration::ZERO);
        let error_column = sweep.columns.len() - 1;
        let written = write_whole(&path, |to| {
            let mut writer = PartWriter::new(
                Digested::new(to),
                &sweep.columns,
                &self.notes(sweep.plan.description.as_deref(), Some(shard)),
                candidates,
            )
            .map_err(|e| part_failed(&path, &e))?;
            let (mut kept, mut failed) = (0, 0);
            loop {
                let asked = Instant::now();
                let Some(mut chunk) = rows.next() else { break };
                waited += asked.elapsed();
                if go_on(chunk.candidates).is_break() {
                    return Ok(None);
                }
                for row in chunk.rows() {
                    kept += 1;
                    failed += u64::from(row[error_column] != SweepCell::Empty);
                    writer.push(row).map_err(|e| part_failed(&path, &e))?;
                }
            }
            let (to, bytes, sha256) = writer.finish().map_err(|e| part_failed(&path, &e))?.finish();
            Ok(Some((to, (kept, failed, bytes, sha256))))
        })?;
        let Some((rows, failed, bytes, sha256)) = written else { return Ok(None) };
        let took = began.elapsed();
        let r = &self.record;
        let record = SweepManifestRecord {
            schema_version: SCHEMA_VERSION,
            shard,
            shards: r.shards,
            first,
            candidates,
            rows,
            failed,
            plan_sha256: r.plan_sha256.clone(),
            seed: r.seed,
            version: r.version.clone(),
            part: path.file_name().unwrap_or_default().to_string_lossy().into_owned(),
            bytes,
            sha256,
            seconds: took.as_secs_f64().into(),
            writing_seconds: took.saturating_sub(waited).as_secs_f64().into(),
        };
        write_record(&manifest, &record)?;
        Ok(Some(record))
    }

    /// The finished and missing shards, after reading every part.
    pub(crate) fn status(&self) -> SweepStatusAnswer {
        self.status_after(Vec::new(), |shard| self.state(shard, PartCheck::Whole))
    }

    /// The finished and missing shards by `state`, after the shards `computed` were computed.
    pub(crate) fn status_after(
        &self,
        computed: Vec<u64>,
        mut state: impl FnMut(u64) -> ShardState,
    ) -> SweepStatusAnswer {
        let r = &self.record;
        let (mut done, mut missing, mut damaged, mut rows, mut failed) =
            (Vec::new(), Vec::new(), Vec::new(), 0, 0);
        for shard in 0..r.shards {
            match state(shard) {
                ShardState::Done(manifest) => {
                    rows += manifest.rows;
                    failed += manifest.failed;
                    done.push(shard);
                }
                ShardState::Missing => missing.push(shard),
                ShardState::Damaged(reason) => {
                    missing.push(shard);
                    damaged.push(DamagedPartRecord { shard, reason });
                }
            }
        }
        SweepStatusAnswer {
            name: r.name.clone(),
            folder: self.path.display().to_string(),
            plan_sha256: r.plan_sha256.clone(),
            seed: r.seed,
            candidates: r.candidates,
            shards: r.shards,
            missing_ranges: ranges(&missing),
            done,
            missing,
            damaged,
            computed,
            rows,
            failed,
            unfinished: self.unfinished(),
        }
    }

    /// Files left incomplete by an ended run, or being written now.
    fn unfinished(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.path).into_iter().flatten().flatten();
        let names = entries.map(|e| e.file_name().to_string_lossy().into_owned());
        let is_part = |name: &String| part_of(name.as_ref()).is_some_and(|of| of.starts_with("part-"));
        let mut names: Vec<String> = names.filter(is_part).collect();
        names.sort();
        names
    }

    /// Removes leftovers of ended runs once all shards are done; files still being written by others are then
    /// superfluous too.
    pub(crate) fn tidy(&self) {
        for name in self.unfinished() {
            let _ = fs::remove_file(self.path.join(name)); // it is in nobody's way
        }
    }
}

/// Opens a table written by `sweep`, a part or a merged one.
pub(crate) fn open_table(path: &Path) -> Result<PartReader, Failure> {
    let unreadable = |why: String| {
        Failure::refused("file::not_readable", format!("{} cannot be read: {why}", path.display()))
            .with_help("name the folder of a sweep, or the file that `equipod sweep merge` wrote")
    };
    let file = files::open_regular(path).map_err(|e| unreadable(e.to_string()))?;
    PartReader::new(file).map_err(|e| unreadable(e.to_string()))
}

/// A number of shards that limits the loss of one: sixteen, or more if one had more than 100 000 candidates.
pub(crate) fn default_shards(candidates: u64) -> u64 {
    candidates.div_ceil(100_000).clamp(16, MOST_SHARDS).min(candidates.max(1))
}

/// Numbers as ranges: `2-5,9`.
pub(crate) fn ranges(numbers: &[u64]) -> String {
    let mut out: Vec<(u64, u64)> = Vec::new();
    for n in numbers {
        match out.last_mut() {
            Some((_, last)) if *last + 1 == *n => *last = *n,
            _ => out.push((*n, *n)),
        }
    }
    let shown = |(a, b): &(u64, u64)| if a == b { a.to_string() } else { format!("{a}-{b}") };
    out.iter().map(shown).collect::<Vec<_>>().join(",")
}

/// Refuses an output inside the folder of the sweep, since it would be taken for a part.
pub(crate) fn outside(output: &OutputPath) -> Result<(), Failure> {
    let name = output.file_name().unwrap_or_default().to_string_lossy();
    if name.starts_with("part-") {
        let message = format!("{} has the name of a part", output.display());
        return Err(Failure::refused("sweep::part_name", message).with_help("name another file"));
    }
    Ok(())
}

/// A plan, its base design and its table of drives, as texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct SweepTexts {
    plan: SweepTextRecord,
    design: SweepTextRecord,
    drives: Option<String>,
    /// The table of poses of the workspace.
    poses: Option<String>,
}

impl SweepTexts {
    /// Reads a plan, and the files that it names.
    pub(crate) fn load(path: &Path, context: &mut Context) -> Result<Self, Failure> {
        let text = files::read_text(path)?;
        let format = format_of(path, &text);
        let shown = files::shown(path);
        let PlanFiles { base, drives } =
            plan::files_named(PlanText::new(&text, format).with_presets(&PRESETS))
                .map_err(|violations| bad_plan(&shown, &text, violations))?;
        let beside = |name: String| path.parent().unwrap_or(Path::new("")).join(name);
        let mut drives = drives.map(|name| files::read_text(&beside(name))).transpose()?;
        let (design, poses) = match base {
            BaseName::Preset(_, text) => (SweepTextRecord { text: text.into(), format: Format::Toml }, None),
            BaseName::File(name) => {
                let file = beside(name);
                // warnings are shown, and the provenance includes the design
                let read = context.load_with_texts(&file)?;
                let poses = read.poses.map(|(table, bytes)| files::utf8(&table, bytes)).transpose()?;
                if let (None, Some(name)) = (&drives, &read.design.drive_table) {
                    drives = Some(files::read_text(&file.parent().unwrap_or(Path::new("")).join(name))?);
                }
                (SweepTextRecord { text: read.text, format: Format::of_path(&file) }, poses)
            }
        };
        Ok(Self { plan: SweepTextRecord { text, format }, design, drives, poses })
    }

    /// SHA-256 over all texts.
    pub(crate) fn sha256(&self) -> String {
        let part = |t: &SweepTextRecord| format!("{} {}\n{}", t.format, t.text.len(), t.text);
        let table = |name: &str, text: &Option<String>| {
            text.as_ref().map_or_else(String::new, |t| format!("{name} {}\n{t}", t.len()))
        };
        let tables = table("drives", &self.drives) + &table("poses", &self.poses);
        sha256((part(&self.plan) + &part(&self.design) + &tables).as_bytes())
    }

    /// The sweep described by the texts; `shown` is the source of the plan.
    pub(crate) fn sweep(&self, seed: u64, shown: &str) -> Result<Sweep, Failure> {
        let base =
            BasePlan::new(PlanText::new(&self.design.text, self.design.format)).map_err(|violations| {
                Failure::bad_design("base design".into(), self.design.text.clone(), violations)
            })?;
        let base = match &self.drives {
            None => base,
            Some(table) => base.with_drives(table.as_bytes()).map_err(|why| {
                Failure::refused("drives::bad_table", format!("the table of drives of {shown}: {why}"))
                    .with_help("docs/guides/choosing-drives.md has the columns; drives of a plan have different names")
            })?,
        };
        let base = match &self.poses {
            None => base,
            Some(table) => base.with_poses(table.as_bytes()).map_err(|why| {
                let message = format!("the table of poses of the base design of {shown}: {why}");
                Failure::refused("design::bad_trajectory", message)
            })?,
        };
        let text = PlanText::new(&self.plan.text, self.plan.format).with_presets(&PRESETS);
        let plan =
            plan::read(text, &base).map_err(|violations| bad_plan(shown, &self.plan.text, violations))?;
        Sweep::new(plan, base, seed).map_err(|why| Failure::refused("sweep::no_candidates", why))
    }
}

fn bad_plan(shown: &str, text: &str, violations: Vec<Violation>) -> Failure {
    let mut failure = Failure::bad_design(shown.to_owned(), text.to_owned(), violations);
    failure.code = "sweep::bad_plan".into();
    failure
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_shown_as_ranges() {
        assert_eq!(ranges(&[]), "");
        assert_eq!(ranges(&[3]), "3");
        assert_eq!(ranges(&[0, 1, 2, 5, 7, 8]), "0-2,5,7-8");
    }

    #[test]
    fn small_sweeps_have_no_empty_shards_and_large_ones_no_large_shards() {
        assert_eq!([0, 1, 7, 1000, 10_000_000].map(default_shards), [1, 1, 7, 16, 100]);
    }
}
