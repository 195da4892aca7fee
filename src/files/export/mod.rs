//! Writes a design as files for other programs: CAD, simulators, machine controls, tables, drawings.
//!
//! [`Export`] holds all data of the formats, computed once: plates around the joints, legs at home, the length unit. A
//! [`Writer`] converts it to the text of one or more files, without input or output; equal data give equal bytes. Every
//! file states its frames and its unit.
//!
//! Frames, all right-handed. *Base*: the frame of the base joints of the design. *Platform*: that of the platform
//! joints; at the pose `(R, p)` a point is `x_base = R x_platform + p`. *Plate*: the origin is the foot of the body's
//! origin on the lower face of the plate. The third axis is the normal of the plate towards positive z of the body. If
//! the plate is parallel to the x-y plane of the body, plate coordinates `(u, v)` are the body's `(x, y)`.

mod controller;
mod csv;
mod drawing;
mod dxf;
mod hal;
mod json;
mod masses;
mod matlab;
mod mjcf;
mod model;
mod parts;
mod plate;
mod robots;
#[cfg(test)]
mod round_trip_tests;
mod sizes;
mod step;
mod stl;
mod surface;
mod telescope;
#[cfg(test)]
mod tests;
mod text;
mod triangulate;
mod units;

use thiserror::Error;

use platform::manipulator::Body;

pub use controller::EquivalentOctahedral;
pub use machine::requirements::{Outline, OutlinePart};
pub use model::{Export, ExportBody, ExportCalibration, ExportCranks, ExportLeg, ExportedJoint};
pub use parts::{PART_COLUMNS, PartLine};
pub use plate::{DrilledHole, Plate};
pub use sizes::{ExportOptions, NoExport, SizeChoice};
pub use surface::{SurfaceFile, SurfaceFormat};
pub use text::csv_field;
pub use units::{LengthUnit, UnknownUnit};

/// A file: its name and its text.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ExportedFile {
    /// Name, with `linuxcnc/` before it for files in that folder.
    pub name: String,
    /// Its whole text.
    pub text: String,
}

impl ExportedFile {
    fn new(name: &str, text: String) -> Self {
        Self { name: name.to_string(), text }
    }
}

/// Reasons why a format cannot hold a design.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum Unsupported {
    /// Two seats of a plate overlap.
    #[error(
        "the {parts} of the joints {first} and {second} of the {body} overlap: their axes are {distance} apart and {parts} are {diameter} wide (design units)"
    )]
    SeatsOverlap {
        /// The body.
        body: Body,
        /// `"holes"`, or `"posts"` if a joint stands on one.
        parts: &'static str,
        /// Name of a joint.
        first: String,
        /// Name of another joint.
        second: String,
        /// Distance of the axes, design units.
        distance: f64,
        /// Their diameter, design units.
        diameter: f64,
    },
    /// A hole of a plate overlaps another one or the outline.
    #[error("in the plate of the {body}, {first} overlaps {second} by {by} (design units)")]
    HolesMeet {
        /// The body.
        body: Body,
        /// A hole.
        first: String,
        /// Another hole, or the outline.
        second: String,
        /// The overlap, design units.
        by: f64,
    },
    /// A leg has no space for a body between its joints.
    #[error(
        "leg {leg} is {length} long at home and its joints take {taken} (design units), so a cylinder and a rod do not fit"
    )]
    LegTooShort {
        /// 1-based number.
        leg: usize,
        /// Length at home, design units.
        length: f64,
        /// The length of the balls and the cylinder, design units.
        taken: f64,
    },
    /// The format requires legs of variable length.
    #[error("the format takes legs of variable length, but the design has rods on cranks")]
    Cranks,
    /// The format takes the drive lengths for the distances of the joints.
    #[error(
        "the joints are not ideal (`offset` of universal joints or `screw_lead` in [hardware]), but the format takes drives that are as long as the distance of their joints"
    )]
    NotIdeal,
    /// The format has one greatest angle for all joints of a body.
    #[error(
        "the joints of the {0} have different cone angles (`cone_angle_deg`), but the format takes one for all joints of a body"
    )]
    ConeOfLegs(Body),
    /// A rod is along the axis of its crank at home.
    #[error("the rod of leg {leg} is along the axis of its crank at home, where the crank does not move it")]
    RodAlongAxis {
        /// 1-based number.
        leg: usize,
    },
    /// A leg has no direction at home.
    #[error("leg {leg} has length zero at home, so its direction is undefined")]
    NoDirection {
        /// 1-based number.
        leg: usize,
    },
}

/// How a format is written.
#[derive(Debug)]
pub struct Writer {
    /// Its purpose, in a few words.
    pub purpose: &'static str,
    /// The parts of a design that the format leaves out; empty if nothing important.
    pub leaves_out: &'static str,
    /// Whether it supports rods on cranks.
    pub takes_cranks: bool,
    /// Whether it supports drives with joint offsets or leads.
    pub takes_coupled: bool,
    write: fn(&Export) -> Result<Vec<ExportedFile>, Unsupported>,
}

impl Writer {
    const fn new(
        purpose: &'static str,
        write: fn(&Export) -> Result<Vec<ExportedFile>, Unsupported>,
    ) -> Self {
        Self { purpose, leaves_out: "", takes_cranks: false, takes_coupled: false, write }
    }

    /// The files. For rods on cranks only formats that [support them](Self::takes_cranks) are asked.
    ///
    /// # Errors
    /// The design has parts that the format cannot express.
    pub fn files(&self, export: &Export) -> Result<Vec<ExportedFile>, Unsupported> {
        (self.write)(export)
    }
}

num::words! {
    /// A format by its name.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum ExportFormat as name, Display, FromStr("format") {
        /// C99 for controllers.
        C = "c",
        /// Joints, lengths at home, workspace and trajectory as tables.
        Csv = "csv",
        /// Hole plans of both plates.
        Dxf = "dxf",
        /// Geometry for `genhexkins` of `LinuxCNC`.
        Hal = "hal",
        /// All data, for programs.
        Json = "json",
        /// MATLAB and Octave.
        Matlab = "matlab",
        /// A closed mechanism for `MuJoCo` and other simulators.
        Mjcf = "mjcf",
        /// A closed mechanism for Gazebo.
        Sdf = "sdf",
        /// Solids for CAD programs.
        Step = "step",
        /// Solids as meshes.
        Stl = "stl",
        /// A drawing with three views.
        Drawing = "svg",
        /// A tree of links for ROS.
        Urdf = "urdf",
    }
}

impl ExportFormat {
    /// Whether its files show the parts of the machine; those of controllers have joint centres alone.
    #[must_use]
    pub fn has_parts(self) -> bool {
        !matches!(self, Self::C | Self::Hal | Self::Matlab)
    }

    /// Its writer.
    #[must_use]
    pub fn writer(self) -> &'static Writer {
        match self {
            Self::C => &controller::WRITER,
            Self::Csv => &csv::WRITER,
            Self::Dxf => &dxf::WRITER,
            Self::Hal => &hal::WRITER,
            Self::Json => &json::WRITER,
            Self::Matlab => &matlab::WRITER,
            Self::Mjcf => &mjcf::WRITER,
            Self::Sdf => &robots::sdf::WRITER,
            Self::Step => &step::WRITER,
            Self::Stl => &stl::WRITER,
            Self::Drawing => &drawing::WRITER,
            Self::Urdf => &robots::urdf::WRITER,
        }
    }
}
