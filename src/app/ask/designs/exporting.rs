//! Designs for other programs.

use super::Error;
use crate::Design;
use files::export::{EquivalentOctahedral, Export, ExportFormat, ExportOptions, ExportedFile};
use machine::manufacture::equivalent_octahedral;
use platform::manipulator::{Manipulator, Octahedral};
use synthesis::{LegMapTolerances, leg_map};

/// The octahedral platform from which controllers may compute the poses of a design; the design then has one joint on
/// each side of two triangles. `None` for an octahedral design, and for all others.
pub fn octahedral_of_controllers(design: &Design) -> Option<EquivalentOctahedral> {
    let m = design.manipulator();
    if Octahedral::recognise(&Manipulator::from_legs(m.legs()).ok()?).is_ok() {
        return None;
    }
    let octahedral = equivalent_octahedral(m)?;
    let found = leg_map(&octahedral, m, LegMapTolerances::default()).ok()?;
    let back = found.map().filter(|_| found.is_regular_within_rounding())?.invert().ok()?;
    let a = std::array::from_fn(|i| std::array::from_fn(|j| back.a[(i, j)]));
    Some(EquivalentOctahedral { manipulator: octahedral, a, c: back.c.into() })
}

impl Design {
    /// The files of a format as names and texts; nothing is written to disk.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/presets/bench-l16.toml")?;
    /// let files = design.export("dxf".parse()?)?;
    /// assert!(files.iter().all(|f| f.name.ends_with(".dxf")));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// Unusable sizes, a unit that is no length, a format that cannot hold the design.
    pub fn export(&self, format: ExportFormat) -> Result<Vec<ExportedFile>, Error> {
        self.export_with(format, &ExportOptions::default())
    }

    /// As [`export`](Self::export), with given sizes and unit.
    ///
    /// # Errors
    /// As [`export`](Self::export).
    pub fn export_with(
        &self,
        format: ExportFormat,
        options: &ExportOptions,
    ) -> Result<Vec<ExportedFile>, Error> {
        let mut export = Export::of(self, options)?;
        if format == ExportFormat::C && export.cranks.is_none() {
            export = export.with_octahedral(octahedral_of_controllers(self));
        }
        Ok(export.files(format)?)
    }
}
