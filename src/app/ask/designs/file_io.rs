//! Reads and writes designs; the only place of the library that accesses files, beside the command line.

use std::path::Path;

use super::Error;
#[cfg(not(target_family = "wasm"))]
use super::whole::WholeFile;
use crate::Design;
use crate::design::{DesignOrViolations, parse};
use files::design::{Format, Warning, read_poses};

impl Design {
    /// Reads a design file: JSON if the name ends in `.json`, else TOML. The table of its trajectory is read too, if it
    /// names one. Suspicious but valid entries are in [`warnings`](Self::warnings).
    ///
    /// ```
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/rbt-octahedral.toml")?;
    /// assert_eq!((design.name.as_str(), design.warnings().len()), ("octahedral 12-6", 0));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// A file that cannot be read; all violations of an invalid design.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::load_by(path.as_ref(), parse)
    }

    /// As [`load`](Self::load), but accepts designs with rods on cranks, for callers that can handle them.
    ///
    /// # Errors
    /// The errors of [`load`](Self::load).
    #[cfg(feature = "files")]
    pub fn load_ideal(path: impl AsRef<Path>) -> Result<Self, Error> {
        Self::load_by(path.as_ref(), crate::design::parse_ideal)
    }

    fn load_by(path: &Path, parsed: fn(&str, Format) -> DesignOrViolations) -> Result<Self, Error> {
        let (mut design, _) = parsed(&read(path)?, Format::of_path(path))
            .map_err(|violations| Error::Design { file: Some(path.to_path_buf()), violations })?;
        let (home, frames) = (design.home_or_default(), design.trajectory_frames());
        let units = design.units.clone();
        if let Some(trajectory) = &mut design.workspace.trajectory {
            let file = path.parent().unwrap_or(Path::new("")).join(&trajectory.file);
            let bytes = std::fs::read(&file).map_err(|source| Error::File { path: file.clone(), source })?;
            let table = read_poses(&bytes, &frames, &home, &units)
                .map_err(|why| Error::Trajectory { file, bad: why.sentences() })?;
            trajectory.poses = table.rows.into_iter().map(|row| row.value).collect();
        }
        Ok(design)
    }

    /// Writes the design: as JSON if the name ends in `.json`, else as TOML with the comments of its file
    /// ([`text`](files::design::DesignModel::text)). The file appears whole or not at all.
    ///
    /// # Errors
    /// A file that cannot be written.
    #[cfg(not(target_family = "wasm"))]
    pub fn save(&self, path: impl AsRef<Path>) -> Result<(), Error> {
        let path = path.as_ref();
        let text = match Format::of_path(path) {
            Format::Toml => self.text(),
            Format::Json => self.to_json(),
        };
        WholeFile::write(path, text.as_bytes())
            .map_err(|source| Error::File { path: path.to_path_buf(), source })
    }

    /// Valid but suspicious entries in the text of the design.
    #[must_use]
    pub fn warnings(&self) -> &[Warning] {
        self.written.warnings()
    }
}

/// Parses TOML; [`Design::load`] reads files of both notations.
impl std::str::FromStr for Design {
    type Err = Error;

    fn from_str(text: &str) -> Result<Self, Error> {
        match parse(text, Format::Toml) {
            Ok((design, _)) => Ok(design),
            Err(violations) => Err(Error::Design { file: None, violations }),
        }
    }
}

fn read(path: &Path) -> Result<String, Error> {
    std::fs::read_to_string(path).map_err(|source| Error::File { path: path.to_path_buf(), source })
}
