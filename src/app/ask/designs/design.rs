//! The design of the front page: the contents of a design file, with the questions as methods.

use std::ops::{Deref, DerefMut};

use files::design::{DesignModel, Format, NameCount, Violation, Warning};
use platform::manipulator::Manipulator;

/// A platform with names, units, home pose and requirements, read from a file or a text.
///
/// It has the fields and the methods of [`DesignModel`]; its own methods answer questions.
#[derive(Debug, Clone, PartialEq)]
pub struct Design(DesignModel);

impl Design {
    /// Makes a design with numbered joint names and nothing optional ([`DesignModel::new`]).
    #[must_use]
    pub fn new(name: impl Into<String>, units: impl Into<String>, manipulator: Manipulator) -> Self {
        DesignModel::new(name, units, manipulator).into()
    }

    /// Gives the joints other names, in joint order ([`DesignModel::with_joint_names`]).
    ///
    /// # Errors
    /// [`NameCount`] if the numbers of names and joints differ.
    pub fn with_joint_names(self, base: Vec<String>, platform: Vec<String>) -> Result<Self, NameCount> {
        self.0.with_joint_names(base, platform).map(Self)
    }

    /// Takes the source and the requirements of another design ([`DesignModel::with_tables_of`]).
    #[must_use]
    pub fn with_tables_of(self, other: &Self) -> Self {
        Self(self.0.with_tables_of(other))
    }
}

impl From<DesignModel> for Design {
    fn from(model: DesignModel) -> Self {
        Self(model)
    }
}

impl Deref for Design {
    type Target = DesignModel;

    fn deref(&self) -> &DesignModel {
        &self.0
    }
}

impl DerefMut for Design {
    fn deref_mut(&mut self) -> &mut DesignModel {
        &mut self.0
    }
}

/// A design with its warnings, or all violations of its text.
pub type DesignOrViolations = Result<(Design, Vec<Warning>), Vec<Violation>>;

fn wrapped(read: Result<(DesignModel, Vec<Warning>), Vec<Violation>>) -> DesignOrViolations {
    read.map(|(model, warnings)| (model.into(), warnings))
}

/// Reads a design with [`files::design::parse`], which lists unsupported designs.
///
/// # Errors
/// All violations found.
pub fn parse(text: &str, format: Format) -> DesignOrViolations {
    wrapped(files::design::parse(text, format))
}

/// Reads a design with [`files::design::parse_with_cranks`], which accepts rods on cranks and joints that are not
/// ideal.
///
/// # Errors
/// All violations found.
pub fn parse_with_cranks(text: &str, format: Format) -> DesignOrViolations {
    wrapped(files::design::parse_with_cranks(text, format))
}

/// Reads a design with [`files::design::parse_ideal`], which accepts rods on cranks.
///
/// # Errors
/// All violations found.
pub fn parse_ideal(text: &str, format: Format) -> DesignOrViolations {
    wrapped(files::design::parse_ideal(text, format))
}
