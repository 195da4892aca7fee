//! The folder `explore` fills: each file appears whole or not at all.

use std::path::{Path, PathBuf};

use crate::cli::commands::optimize::dimensional;
use crate::cli::commands::report;
use crate::cli::failure::Failure;
use crate::cli::files;
use crate::entrance::freedoms::ConflictFreedom;
use crate::export::ExportedFile;
use crate::report::ReportFile;

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

/// What stands first in a report of the folder.
pub(in crate::cli::commands) const FIRST: [&str; 19] = [
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

/// The folder and what has been written into it.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    written: Vec<String>,
}

fn not_writable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::refused("file::not_writable", format!("{} cannot be written: {error}", path.display()))
        .with_help("check the folder and its permissions")
}

impl Folder {
    /// Makes the folder and removes the files of an earlier run, so that an interrupted run leaves no mixture.
    ///
    /// # Errors
    /// Exit 2: the folder cannot be made, or an input of the run is one of the files to be written.
    pub(super) fn prepare(path: &Path) -> Result<Self, Failure> {
        files::make_folder(path)?;
        let entries = std::fs::read_dir(path).map_err(|e| not_writable(path, &e))?;
        let left = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let left = left.filter(|file| {
            let name = file.file_name().unwrap_or_default();
            let opened = ConflictFreedom::ALL.map(dimensional::opened_file);
            let own = ALL.iter().copied().chain(opened.iter().map(String::as_str));
            own.into_iter().any(|own| name == own || files::is_part(name, own))
        });
        let left: Vec<PathBuf> = left.collect();
        left.iter().try_for_each(|file| files::check_input(file))?; // before anything is removed
        for file in left {
            std::fs::remove_file(&file).map_err(|e| not_writable(&file, &e))?;
        }
        Ok(Self { path: path.to_path_buf(), written: Vec::new() })
    }

    /// Writes a file of the folder.
    ///
    /// # Errors
    /// As [`files::write_into`].
    pub(super) fn write(&mut self, name: &str, text: &str) -> Result<(), Failure> {
        files::write_into(&self.path, name, text)?;
        self.written.push(name.to_owned());
        Ok(())
    }

    /// The folder.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// Counts a file as written that somebody else has written into the folder.
    pub(super) fn note(&mut self, name: String) {
        self.written.push(name);
    }

    /// Writes files for other programs into a folder of their own.
    ///
    /// # Errors
    /// As [`files::write_into`].
    pub(super) fn write_machine(&mut self, list: &[ExportedFile]) -> Result<(), Failure> {
        list.iter().try_for_each(|file| self.write(&format!("{MACHINE}/{}", file.name), &file.text))
    }

    /// What has been written, for the page: other files in the folder are none of its business.
    ///
    /// # Errors
    /// Exit 2: a file cannot be read again.
    pub(super) fn results(&self) -> Result<Vec<ReportFile>, Failure> {
        let picture = |name: &str| {
            Path::new(name).extension().is_some_and(|end| end == "svg") || name.ends_with("/parts.csv")
        };
        let shown = |name: &&String| *name != DRIVES && (!name.starts_with(MACHINE) || picture(name));
        report::read(&self.path, self.written.iter().filter(shown).map(|name| self.path.join(name)))
    }

    /// What has been written, in order.
    pub(super) fn written(&self) -> impl Iterator<Item = String> {
        self.written.iter().map(|name| self.path.join(name).display().to_string())
    }
}
