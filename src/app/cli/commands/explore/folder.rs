//! The folder of `explore`. Each file appears whole or not at all, and all appear at the end of the run. Files of the
//! user are never replaced.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use crate::app::cli::commands::optimize;
use crate::app::cli::commands::report;
use crate::app::cli::{Failure, files};
use crate::app::report::ReportFile;
use ::files::export::ExportedFile;
use ask::ConflictFreedom;
use ask::whole::{WholeFile, part_of};
use records::sha256;

/// Files of a finished run, in the order they appear.
pub(super) const ORIGINAL: &str = "original.toml";
pub(super) const FAMILY: &str = "family.json";
pub(super) const OPTIMIZE: &str = "optimize.json";
pub(super) const OPTIMISED: &str = "optimised.toml";
pub(super) const CLOSEST: &str = "closest.toml";
pub(super) const ROUNDED: &str = "rounded.toml";
pub(super) const ROUNDED_ASSESS: &str = "rounded-assess.json";
pub(super) const ROUND: &str = "round.json";
/// Folder of the files for other programs.
pub(super) const MACHINE: &str = "machine";
pub(super) const DETERMINANT: &str = "determinant.svg";
pub(super) const VERIFY: &str = "verify.json";
pub(super) const FK: &str = "fk.json";
pub(super) const MODES: &str = "assembly-modes.svg";
pub(super) const REPORT: &str = "report.md";
pub(super) const PAGE: &str = report::PAGE;
pub(super) const COMPONENTS: &str = "components.json";
pub(super) const MOVES: &str = "moves.json";
pub(super) const EQUIVALENT: &str = "equivalent.toml";
pub(super) const NEAREST: &str = "nearest.json";
pub(super) const NEAREST_OCTAHEDRAL: &str = "nearest-octahedral.toml";
pub(super) const BESIDE: &str = "nearest-equivalent.toml";
pub(super) const ASSESS: &str = "nearest-assess.json";
/// The table of drives that the design names, beside the copy of the design.
pub(super) const DRIVES: &str = "drives.csv";
const ALL: [&str; 22] = [
    ORIGINAL,
    DRIVES,
    FAMILY,
    OPTIMIZE,
    OPTIMISED,
    CLOSEST,
    ROUNDED,
    ROUNDED_ASSESS,
    ROUND,
    DETERMINANT,
    COMPONENTS,
    MOVES,
    EQUIVALENT,
    NEAREST,
    NEAREST_OCTAHEDRAL,
    BESIDE,
    ASSESS,
    VERIFY,
    FK,
    MODES,
    REPORT,
    PAGE,
];

/// The files that come first in a report of the folder.
pub(in crate::app::cli::commands) const FIRST: [&str; 19] = [
    ORIGINAL,
    ROUNDED,
    ROUNDED_ASSESS,
    OPTIMISED,
    CLOSEST,
    EQUIVALENT,
    NEAREST_OCTAHEDRAL,
    BESIDE,
    VERIFY,
    OPTIMIZE,
    ROUND,
    MOVES,
    NEAREST,
    ASSESS,
    FK,
    FAMILY,
    COMPONENTS,
    DETERMINANT,
    MODES,
];

/// The list of files written by `explore`, for recognising them later.
const MANIFEST: &str = ".explore.json";

/// A file of an earlier run: its name in the folder and the hash of its bytes.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct KnownFile {
    name: String,
    sha256: String,
}

#[derive(Debug, Default, Serialize, Deserialize)]
struct Manifest {
    written_by: String,
    files: Vec<KnownFile>,
}

/// A folder of results. They are kept in memory until the run has ended, and then replace those of an earlier run.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    /// The files of an earlier run.
    earlier: Vec<KnownFile>,
    results: Vec<(String, String)>,
}

impl Folder {
    /// Makes the folder, and refuses one in which a result would replace a file of the user. Such a file was not
    /// written by `explore`, or was changed since. Other files in the folder are not read or changed.
    ///
    /// # Errors
    /// Exit 2: the folder cannot be made or written, `explore::not_ours`, or an input of the run is one of the files to
    /// be written.
    pub(super) fn prepare(path: &Path) -> Result<Self, Failure> {
        files::make_folder(path)?;
        let manifest = Self::manifest_in(path)?;
        let folder = Self { path: path.to_path_buf(), earlier: manifest.files, results: Vec::new() };
        let opened = ConflictFreedom::ALL.map(optimize::opened_file);
        let own = ALL.iter().copied().chain(opened.iter().map(String::as_str));
        let mut names: Vec<String> = own.map(str::to_owned).collect();
        files_below(path, MACHINE, &mut names);
        names.iter().try_for_each(|name| folder.refuse_foreign(name))?;
        // the folder must be writable now, not after minutes of computing
        folder.write_manifest(folder.earlier.clone())?;
        Ok(folder)
    }

    /// The list left by an earlier run; another file of this name belongs to the user.
    fn manifest_in(path: &Path) -> Result<Manifest, Failure> {
        let path = path.join(MANIFEST);
        let Ok(found) = path.symlink_metadata() else { return Ok(Manifest::default()) };
        let known = if found.is_file() { files::found_record::<Manifest>(&path) } else { None };
        known.filter(|manifest| manifest.written_by.starts_with("equipod ")).ok_or_else(|| {
            let message = format!(
                "{} is not a list written by `explore`, but would be replaced by one",
                path.display()
            );
            Failure::refused("explore::not_ours", message).with_help("move that file, or name another folder")
        })
    }

    /// Refuses an existing file that differs from what an earlier run wrote.
    fn refuse_foreign(&self, name: &str) -> Result<(), Failure> {
        let path = self.path.join(name);
        files::check_input(&path)?;
        let known = || self.earlier.iter().any(|file| file.name == name);
        if path.symlink_metadata().is_err() || (path.is_dir() && !known()) {
            return Ok(());
        }
        let is_ours = files::found_in_folder(&path).is_some_and(|bytes| {
            let found = KnownFile { name: name.to_owned(), sha256: sha256(&bytes) };
            self.earlier.contains(&found)
        });
        if is_ours {
            return Ok(());
        }
        let why =
            if known() { "was changed since `explore` wrote it" } else { "is not a result of `explore`" };
        let message = format!("{} {why}, and a result would replace it", path.display());
        Err(Failure::refused("explore::not_ours", message)
            .with_help("move that file, or name another folder"))
    }

    fn write_manifest(&self, files: Vec<KnownFile>) -> Result<(), Failure> {
        let manifest = Manifest { written_by: format!("equipod {}", env!("CARGO_PKG_VERSION")), files };
        let path = self.path.join(MANIFEST);
        WholeFile::write(&path, files::record_text(&manifest)?.as_bytes())
            .map_err(|e| files::not_written(&path.display().to_string(), &e))
    }

    /// Keeps a result, and returns its future path.
    pub(super) fn keep(&mut self, name: &str, text: String) -> String {
        self.results.push((name.to_owned(), text));
        self.path.join(name).display().to_string()
    }

    /// Keeps files for other programs, in a folder of their own.
    pub(super) fn keep_machine(&mut self, list: Vec<ExportedFile>) {
        for file in list {
            self.keep(&format!("{MACHINE}/{}", file.name), file.text);
        }
    }

    /// Replaces the results of the earlier run. Each file is whole at any time, and the manifest lists old and new
    /// files until all are written.
    ///
    /// # Errors
    /// The errors of [`files::write_into`]; `explore::not_ours` for a file that appeared during the run.
    pub(super) fn finish(&self) -> Result<(), Failure> {
        let named = |(name, text): &(String, String)| KnownFile {
            name: name.clone(),
            sha256: sha256(text.as_bytes()),
        };
        let new: Vec<KnownFile> = self.results.iter().map(named).collect();
        self.results.iter().try_for_each(|(name, _)| self.refuse_foreign(name))?;
        self.write_manifest([&self.earlier[..], &new].concat())?;
        for (name, text) in &self.results {
            files::write_into(&self.path, name, text)?;
        }
        let stale = self.earlier.iter().filter(|old| !new.iter().any(|file| file.name == old.name));
        for old in stale.filter(|old| self.refuse_foreign(&old.name).is_ok()) {
            let path = self.path.join(&old.name);
            match std::fs::remove_file(&path) {
                Err(error) if error.kind() != ErrorKind::NotFound => {
                    return Err(files::not_written(&path.display().to_string(), &error));
                }
                _ => {}
            }
        }
        // leftovers of killed runs
        let parts = std::fs::read_dir(&self.path).into_iter().flatten().flatten();
        for part in parts.filter(|entry| part_of(&entry.file_name()).is_some_and(|of| ALL.contains(&of))) {
            let _ = std::fs::remove_file(part.path()); // it is in nobody's way
        }
        self.write_manifest(new)
    }

    /// The results for the page, without other files of the folder.
    pub(super) fn results(&self) -> Vec<ReportFile> {
        let picture = |name: &str| {
            Path::new(name).extension().is_some_and(|end| end == "svg") || name.ends_with("/parts.csv")
        };
        let shown = self
            .results
            .iter()
            .filter(|(name, _)| name != DRIVES && (!name.starts_with(MACHINE) || picture(name)));
        let file = |(name, text): &(String, String)| ReportFile {
            name: name.clone(),
            bytes: text.clone().into_bytes(),
        };
        report::in_order(shown.map(file).collect())
    }

    /// The paths of the results, in order.
    pub(super) fn paths(&self) -> impl Iterator<Item = String> {
        self.results.iter().map(|(name, _)| self.path.join(name).display().to_string())
    }
}

/// Adds the files below a folder, as names from `root`; links are listed and not followed.
fn files_below(root: &Path, folder: &str, names: &mut Vec<String>) {
    for entry in std::fs::read_dir(root.join(folder)).into_iter().flatten().flatten() {
        let Ok(name) = entry.file_name().into_string() else { continue };
        let name = format!("{folder}/{name}");
        if entry.file_type().is_ok_and(|kind| kind.is_dir()) {
            files_below(root, &name, names);
        } else {
            names.push(name);
        }
    }
}
