//! The folder `explore` fills: each file appears whole or not at all.

use std::path::{Path, PathBuf};

use crate::cli::commands::report;
use crate::cli::failure::Failure;
use crate::report::ReportFile;

/// Files of a finished run, in the order they appear.
pub(super) const ORIGINAL: &str = "original.toml";
pub(super) const FAMILY: &str = "family.json";
pub(super) const OPTIMIZE: &str = "optimize.json";
pub(super) const OPTIMISED: &str = "optimised.toml";
pub(super) const DETERMINANT: &str = "determinant.svg";
pub(super) const VERIFY: &str = "verify.json";
pub(super) const FK: &str = "fk.json";
pub(super) const MODES: &str = "assembly-modes.svg";
pub(super) const REPORT: &str = "report.md";
pub(super) const PAGE: &str = report::PAGE;
const ALL: [&str; 10] = [ORIGINAL, FAMILY, OPTIMIZE, OPTIMISED, DETERMINANT, VERIFY, FK, MODES, REPORT, PAGE];

/// What stands first in a report of the folder.
pub(in crate::cli::commands) const FIRST: [&str; 8] =
    [ORIGINAL, OPTIMISED, VERIFY, OPTIMIZE, FK, FAMILY, DETERMINANT, MODES];

/// The folder and what has been written into it.
#[derive(Debug)]
pub(super) struct Folder {
    path: PathBuf,
    written: Vec<&'static str>,
}

fn not_writable(path: &Path, error: &std::io::Error) -> Failure {
    Failure::refused("file::not_writable", format!("{} cannot be written: {error}", path.display()))
        .with_help("check the folder and its permissions")
}

impl Folder {
    /// Makes the folder and removes the files of an earlier run, so that an interrupted run leaves no mixture.
    ///
    /// # Errors
    /// Exit 2: the folder cannot be made, or the design itself is one of the files to be written.
    pub(super) fn prepare(path: &Path, design: &Path) -> Result<Self, Failure> {
        std::fs::create_dir_all(path).map_err(|e| not_writable(path, &e))?;
        let design = design.canonicalize().ok();
        let files: Vec<PathBuf> = ALL.iter().map(|name| path.join(name)).collect();
        if let Some(file) = files.iter().find(|f| design.is_some() && f.canonicalize().ok() == design) {
            let message = format!("{} is the design itself and would be overwritten", file.display());
            return Err(
                Failure::refused("explore::overwrites_design", message).with_help("name another folder")
            );
        }
        for file in files.iter().flat_map(|f| [f.clone(), part(f)]) {
            match std::fs::remove_file(&file) {
                Err(e) if e.kind() != std::io::ErrorKind::NotFound => return Err(not_writable(&file, &e)),
                _ => {}
            }
        }
        Ok(Self { path: path.to_path_buf(), written: Vec::new() })
    }

    /// Writes a file beside its place and renames it.
    ///
    /// # Errors
    /// Exit 2: `file::not_writable`.
    pub(super) fn write(&mut self, name: &'static str, text: &str) -> Result<(), Failure> {
        let file = self.path.join(name);
        let part = part(&file);
        let result = std::fs::write(&part, text).and_then(|()| std::fs::rename(&part, &file));
        result.map_err(|error| {
            let _ = std::fs::remove_file(&part); // it may not exist; the error to report is the first one
            not_writable(&file, &error)
        })?;
        self.written.push(name);
        Ok(())
    }

    /// What has been written, for the page: other files in the folder are none of its business.
    ///
    /// # Errors
    /// Exit 2: a file cannot be read again.
    pub(super) fn results(&self) -> Result<Vec<ReportFile>, Failure> {
        report::read(self.written.iter().map(|name| self.path.join(name)))
    }

    /// What has been written, in order.
    pub(super) fn written(&self) -> impl Iterator<Item = (&'static str, String)> {
        self.written.iter().map(|name| (*name, self.path.join(name).display().to_string()))
    }
}

fn part(file: &Path) -> PathBuf {
    let mut name = file.as_os_str().to_owned();
    name.push(".part");
    PathBuf::from(name)
}
