//! Designs for other programs.

use super::Error;
use crate::design::Design;
use crate::export::{Export, ExportFormat, ExportOptions, ExportedFile};

impl Design {
    /// The files of a format: names and texts, nothing is written.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// let design = Design::load("designs/presets/bench-l16.toml")?;
    /// let files = design.export("dxf".parse()?)?;
    /// assert!(files.iter().all(|f| f.name.ends_with(".dxf")));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Sizes that nothing can be made of, a unit that is no length, a format that cannot hold the design.
    pub fn export(&self, format: ExportFormat) -> Result<Vec<ExportedFile>, Error> {
        self.export_with(format, &ExportOptions::default())
    }

    /// As [`export`](Self::export), with sizes and the unit chosen.
    ///
    /// # Errors
    /// As [`export`](Self::export).
    pub fn export_with(
        &self,
        format: ExportFormat,
        options: &ExportOptions,
    ) -> Result<Vec<ExportedFile>, Error> {
        Ok(format.writer().files(&Export::of(self, options)?)?)
    }
}
