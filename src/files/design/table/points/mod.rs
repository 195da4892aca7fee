//! The twelve ends of the legs from a table in any arrangement of rows and columns.

mod columns;
mod ends;
mod lists;
mod polar;
mod rows;
mod scalars;
mod upright;
mod words;

use thiserror::Error;

use self::columns::{PointColumns, unit_of};
use self::ends::{names, six_rows, twelve_rows};
use self::rows::data_rows;
use super::hal::{HOME_OF_COMMENT, HexapodPins, home_of};
use super::listed::is_computed;
use super::models;
use super::sheet::{CellTable, InvalidSheet};
use super::text::decode;
use crate::design::keys::LARGEST;
use crate::design::{DesignModel, NameCount};
use platform::geom::Pose;
use platform::manipulator::{Body, InvalidManipulator, Leg, Manipulator};

/// Least count of numbers in a row: joints of a flat body are often given by x and y alone.
const LEAST_NUMBERS: usize = 2;

/// Least height of a platform at home over the extent of the bodies: joints on posts are lower than this above the
/// frame of their body.
const LEAST_HEIGHT: f64 = 0.1;

/// Root elements of unsupported models, and the names of their formats.
const MODELS: [(&str, &str); 2] = [("SimMechanics", "Simscape Multibody XML"), ("COLLADA", "COLLADA")];

/// The ends of the six legs from a table.
#[derive(Debug, Clone, PartialEq)]
pub struct PointTable {
    /// The legs, in leg order: the base end in the base frame, the platform end in the platform frame.
    pub legs: [Leg; 6],
    /// Names of the base and platform ends, in leg order, if the table has valid joint names.
    pub names: Option<[[String; 6]; 2]>,
    /// The length unit from the header.
    pub units: Option<String>,
    /// The platform frame at home, base frame, from a comment or from a table with both bodies in one frame.
    pub home: Option<Pose>,
    /// The guesses, one sentence each.
    pub guesses: Vec<String>,
}

/// Reasons why a table does not give the ends of six legs.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InvalidPointTable {
    /// It is not a table of numbers.
    #[error(transparent)]
    Sheet(#[from] InvalidSheet),
    /// Its rows or columns are not those of twelve points.
    #[error("{0}")]
    Form(String),
    /// It is a model of a simulator, or other XML, without six legs.
    #[error("{0}")]
    Mechanism(String),
    /// It is an exchange file of a CAD program (ISO 10303-21), which is not supported.
    #[error("this is a STEP file, and assemblies are not read")]
    Step,
    /// It is an unsupported model of another program; its name.
    #[error("this is a model of {0}, and such models are not read")]
    Model(&'static str),
    /// It is a program that computes its numbers.
    #[error("this text computes its numbers, and programs are not run")]
    Computed,
    /// The points form no manipulator.
    #[error(transparent)]
    Manipulator(#[from] InvalidManipulator),
}

impl PointTable {
    /// Reads six rows of two points, base end first, or twelve rows of one point, in any notation.
    ///
    /// Columns follow the coordinate names of the header if it has any, otherwise their order. Rows of one point belong
    /// to the body given by a cell, a title above them or their name. Without these, the first six belong to the base.
    /// It also reads lists of Python, C, MATLAB, JSON and YAML, settings of `genhexkins` and models of `MuJoCo`, Gazebo
    /// (SDF) and ROS (URDF).
    ///
    /// # Errors
    /// [`InvalidPointTable`].
    pub fn read(bytes: &[u8]) -> Result<Self, InvalidPointTable> {
        let table = Self::read_any(bytes)?;
        let ends = table.legs.iter().flat_map(|leg| [leg.base, leg.platform]);
        // factors of lists and of units may leave the range of coordinates
        match ends.into_iter().flat_map(|end| [end.x, end.y, end.z]).find(|x| !(x.abs() < LARGEST)) {
            Some(x) => Err(InvalidPointTable::Form(format!("{x:e} is too far out, stay below {LARGEST:e}"))),
            None => Ok(table),
        }
    }

    fn read_any(bytes: &[u8]) -> Result<Self, InvalidPointTable> {
        let text = decode(bytes).map(|decoded| decoded.text).unwrap_or_default();
        if text.trim_start().starts_with("ISO-10303-21") {
            return Err(InvalidPointTable::Step);
        }
        if models::is_xml(&text) {
            let root = text.split('<').find(|tag| tag.starts_with(|c: char| c.is_ascii_alphabetic()));
            if let Some((_, name)) =
                MODELS.iter().find(|(root_of, _)| root.is_some_and(|r| r.starts_with(root_of)))
            {
                return Err(InvalidPointTable::Model(name));
            }
            return models::read(&text).map_err(InvalidPointTable::Mechanism);
        }
        if let Some(pins) = HexapodPins::read(&text) {
            let HexapodPins { legs, home, guesses } = pins?;
            return Ok(Self { legs, names: None, units: None, home, guesses });
        }
        if let Some(listed) = lists::read(&text).or_else(|| scalars::read(&text)) {
            return listed;
        }
        if is_computed(&text) {
            return Err(InvalidPointTable::Computed);
        }
        let objects = lists::read_objects(&text);
        let mut sheet = objects.map_or_else(|| CellTable::read(bytes, LEAST_NUMBERS), Ok)?;
        if let Some(listed) = scalars::of_one_row(&sheet) {
            return listed;
        }
        let mut guesses = std::mem::take(&mut sheet.guesses);
        upright::turn(&mut sheet, &mut guesses);
        polar::to_coordinates(&mut sheet, &text, &mut guesses)?;
        columns::header_as_title(&mut sheet);
        let rows = data_rows(&sheet, &mut guesses)?;
        let unit = sheet.header.as_ref().map_or(Ok(None), |header| unit_of(header))?;
        if let (Some(of_columns), Some(stated)) = (unit, sheet.length_unit)
            && of_columns != stated
        {
            return Err(InvalidPointTable::Form(format!(
                "the columns are in {of_columns}, and a line above them says {stated}"
            )));
        }
        let units = unit.or(sheet.length_unit).map(String::from);
        let columns = match sheet.header.as_ref().and_then(|h| PointColumns::named(h, &mut guesses)) {
            Some(columns) => columns,
            None => PointColumns::numbered(&sheet, &rows, &mut guesses)?,
        };
        guesses.extend(columns.unused(&sheet, &rows));
        let points = match columns.second {
            Some(_) => six_rows(&sheet, &rows, &columns, &mut guesses)?,
            None => twelve_rows(&sheet, &rows, &columns, &mut guesses)?,
        };
        guesses.extend(units.iter().map(|unit| format!("The lengths are in {unit}, as the table says.")));
        let names = names(&points);
        let mut table = Self {
            legs: std::array::from_fn(|i| Leg { base: points[0][i].at, platform: points[1][i].at }),
            names,
            units,
            home: text.lines().find_map(home_of),
            guesses,
        };
        if table.home.is_some() {
            table.guesses.push(HOME_OF_COMMENT.to_string());
        } else if !columns.own_heights {
            table.part_frames();
        }
        Ok(table)
    }

    /// If one body is far above the other, the table has both in one frame, as in a drawing. The platform frame is then
    /// at the mean height of the platform joints.
    pub(super) fn part_frames(&mut self) {
        // the axis along which the bodies are apart: z if possible
        let Some(axis) = [2, 1, 0].into_iter().find(|axis| self.apart_along(*axis)) else { return };
        let heights = |body: Body| self.legs.map(|leg| leg.end(body)[axis]);
        let above = heights(Body::Platform)[0] > heights(Body::Base)[0];
        let heights = heights(Body::Platform);
        // a common height keeps its exact value
        let level = heights.iter().all(|z| z.to_bits() == heights[0].to_bits());
        let height = if level { heights[0] } else { heights.iter().sum::<f64>() / 6.0 };
        for leg in &mut self.legs {
            leg.platform[axis] -= height;
        }
        let rotation = nalgebra::Rotation3::identity();
        let mut position = [0.0; 3];
        position[axis] = height;
        self.home = Some(Pose::new(position, rotation));
        let name = ["x", "y", "z"][axis];
        let up = if axis == 2 { String::new() } else { format!(" {name} is up.") };
        self.guesses.push(format!(
            "The platform joints are all {} those of the base: both are read in the base frame, and home is at {name} = {height}.{up}",
            if above { "above" } else { "below" }
        ));
    }

    /// Whether all platform joints are far beyond all base joints along an axis. Bodies in separate frames may be apart
    /// by chance: along z by the heights of their joints above them, along x and y by more.
    fn apart_along(&self, axis: usize) -> bool {
        let range = |body: Body, axis: usize| {
            let of = self.legs.map(|leg| leg.end(body)[axis]);
            (of.into_iter().fold(f64::INFINITY, f64::min), of.into_iter().fold(f64::NEG_INFINITY, f64::max))
        };
        let (base, platform) = (range(Body::Base, axis), range(Body::Platform, axis));
        let gap = (platform.0 - base.1).max(base.0 - platform.1);
        let extent = |axes: &[usize]| {
            let sizes = axes.iter().flat_map(|axis| Body::BOTH.map(|body| range(body, *axis)));
            sizes.map(|(low, high)| high - low).fold(0.0, f64::max)
        };
        gap > if axis == 2 { LEAST_HEIGHT * extent(&[0, 1]) } else { extent(&[axis]) }
    }

    /// The design with these joints: ends with equal coordinates are one joint of several legs.
    ///
    /// # Errors
    /// [`InvalidManipulator`].
    pub fn design(&mut self, name: &str, units: &str) -> Result<DesignModel, InvalidManipulator> {
        let manipulator = Manipulator::from_legs(self.legs)?;
        let counts = Body::BOTH.map(|body| manipulator.joints(body).len());
        for (body, count) in Body::BOTH.into_iter().zip(counts).filter(|(_, count)| *count < 6) {
            let sentence = format!(
                "Legs of the {body} that end at the same place share a joint: it has {count} joints."
            );
            if !self.guesses.contains(&sentence) {
                self.guesses.push(sentence);
            }
        }
        let pairs = manipulator.pairs();
        let mut design = DesignModel::new(name, units, manipulator);
        if let Some(names) = &self.names {
            let of = |body: Body| -> Vec<String> {
                let leg = |j: usize| pairs.iter().position(|(a, b)| body.of((*a, *b)) == j);
                (0..counts[body.index()]).filter_map(|j| Some(names[body.index()][leg(j)?].clone())).collect()
            };
            let named: Result<DesignModel, NameCount> =
                design.clone().with_joint_names(of(Body::Base), of(Body::Platform));
            design = named.unwrap_or(design);
        }
        design.home = self.home;
        Ok(design)
    }
}

#[cfg(test)]
mod tests;
