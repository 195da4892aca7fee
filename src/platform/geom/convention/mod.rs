//! Conventions for poses: the order of the turns, the point whose position is given, the frame it is measured from,
//! the axis that points up, units of angles, and the order of a quaternion.
//!
//! A pose written as `(q, Q)` in a convention with the pivot `c`, the map `C` of its axes to ours (`C = Rx(90 deg)`
//! where y is up) and home `(R0, p0)` is our pose `(R, p)` with
//!
//! ```text
//! R = C Q C^T R0,   p = C q + (R0 C c + p0) - R C c      counted from home
//! R = C Q C^T,      p = C q - R C c                      in the base frame
//! ```
//!
//! so that the pivot, and not the origin of the platform, stands at `C q`.

mod matrix;

use std::fmt::Write as _;

use std::fmt;
use std::str::FromStr;

use nalgebra::{Matrix3, Rotation3, Vector3};

use super::pose_set::ListedFrom;
use super::rotation_vector::rotation_vector;
use super::{InvalidPose, Pose};

pub use matrix::is_by_columns;

num::words! {
    /// An axis of a frame.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum FrameAxis as name {
        /// The first one.
        X = "x",
        /// The second one.
        Y = "y",
        /// The third one.
        Z = "z",
    }
}

impl FrameAxis {
    /// 0, 1, 2.
    #[must_use]
    pub fn index(self) -> usize {
        self as usize
    }

    fn turn(self, angle: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Vector3::ith_axis(self.index()), angle)
    }
}

/// Whether the axes of successive turns stay or are carried along.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TurnAxes {
    /// Every turn is about an axis of the base: the first one stands last in the product of matrices.
    Fixed,
    /// Every turn is about an axis of the platform as the turns before have left it: the first one stands first.
    Moving,
}

/// The meaning of three numbers that state a rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RotationOrder {
    /// Angles of three turns, one after the other, in the order in which they are written.
    Turns(TurnAxes, [FrameAxis; 3]),
    /// The rotation vector: its direction is the axis, its length the angle.
    Vector,
}

/// `R = Rz(yaw) Ry(pitch) Rx(roll)`, the order of this program.
const FIXED_XYZ: RotationOrder =
    RotationOrder::Turns(TurnAxes::Fixed, [FrameAxis::X, FrameAxis::Y, FrameAxis::Z]);

impl RotationOrder {
    /// `R = Rx(U) Ry(V) Rz(W)`: the order of the controllers of Physik Instrumente and of the hexapods of the Rubin
    /// Observatory.
    pub const MOVING_XYZ: Self = Self::Turns(TurnAxes::Moving, [FrameAxis::X, FrameAxis::Y, FrameAxis::Z]);

    /// Names of orders by those who use them.
    pub const NAMES: [(&'static str, Self); 4] =
        [("rpy", FIXED_XYZ), ("pi", Self::MOVING_XYZ), ("rubin", Self::MOVING_XYZ), ("vector", Self::Vector)];

    /// Every order that three turns may have, two in succession about different axes, and the vector.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut out = vec![Self::Vector];
        for axes in [TurnAxes::Fixed, TurnAxes::Moving] {
            for first in FrameAxis::ALL {
                for second in FrameAxis::ALL.into_iter().filter(|axis| *axis != first) {
                    let third = FrameAxis::ALL.into_iter().filter(|axis| *axis != second);
                    out.extend(third.map(|third| Self::Turns(axes, [first, second, third])));
                }
            }
        }
        out
    }

    /// The places of the turns about x, y and z among the three numbers; `None` where an axis is turned about twice.
    #[must_use]
    pub fn places(self) -> Option<[usize; 3]> {
        let Self::Turns(_, axes) = self else { return Some([0, 1, 2]) };
        let place = |axis: FrameAxis| axes.iter().position(|own| *own == axis);
        Some([place(FrameAxis::X)?, place(FrameAxis::Y)?, place(FrameAxis::Z)?])
    }

    /// The rotation of three angles in radians, in the order in which they are written.
    #[must_use]
    pub fn rotation(self, angles: [f64; 3]) -> Rotation3<f64> {
        match self {
            Self::Vector => Rotation3::new(Vector3::from(angles)),
            Self::Turns(axes, about) => {
                let (about, [a, b, c]) = in_product(axes, about, angles);
                if about == [FrameAxis::Z, FrameAxis::Y, FrameAxis::X] {
                    // the digits that roll, pitch and yaw have always had
                    return Rotation3::from_euler_angles(c, b, a);
                }
                about[0].turn(a) * about[1].turn(b) * about[2].turn(c)
            }
        }
    }

    /// The three angles of a rotation in radians, and whether they are the only ones.
    ///
    /// The middle angle is from -90 to 90 degrees, about the same axis twice from 0 to 180; the others are from -180
    /// to 180. At the ends of the middle one only a combination of the others is determined: the angles are then one
    /// choice of many, and they still give the rotation back to rounding.
    #[must_use]
    pub fn angles(self, rotation: &Rotation3<f64>) -> WrittenAngles {
        let Self::Turns(axes, about) = self else {
            let vector = rotation_vector(rotation);
            // half a turn has two vectors
            let are_unique = std::f64::consts::PI - vector.norm() > NEAR_LOCK;
            return WrittenAngles { angles: vector.into(), are_unique };
        };
        let (about, _) = in_product(axes, about, [0.0; 3]);
        let found = angles_of_product(rotation.matrix(), about.map(FrameAxis::index));
        let (_, angles) = in_product(axes, about, found.angles);
        WrittenAngles { angles, ..found }
    }

    /// The product of matrices of angles `a`, `b`, `c` in the order in which they are written.
    #[must_use]
    pub fn formula(self) -> String {
        let turn = |(axis, letter): (&FrameAxis, &str)| format!("R{}({letter})", axis.name());
        let written =
            |about: &[FrameAxis; 3]| about.iter().zip(["a", "b", "c"]).map(turn).collect::<Vec<_>>();
        match self {
            Self::Vector => "exp([a b c])".into(),
            Self::Turns(TurnAxes::Moving, about) => written(&about).join(" "),
            Self::Turns(TurnAxes::Fixed, about) => {
                written(&about).into_iter().rev().collect::<Vec<_>>().join(" ")
            }
        }
    }
}

impl Default for RotationOrder {
    fn default() -> Self {
        FIXED_XYZ
    }
}

impl fmt::Display for RotationOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Vector => f.write_str("vector"),
            Self::Turns(axes, [a, b, c]) => {
                let axes = match axes {
                    TurnAxes::Fixed => "fixed",
                    TurnAxes::Moving => "moving",
                };
                write!(f, "{axes}-{}{}{}", a.name(), b.name(), c.name())
            }
        }
    }
}

/// A text that names no order of turns.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "`{0}` is no order of rotations: write fixed-xyz (R = Rz Ry Rx), moving-xyz (R = Rx Ry Rz) or other axes, rpy, pi, rubin or vector"
)]
pub struct UnknownOrder(pub String);

impl FromStr for RotationOrder {
    type Err = UnknownOrder;

    fn from_str(text: &str) -> Result<Self, UnknownOrder> {
        let word = text.trim().to_lowercase();
        if let Some((_, order)) = Self::NAMES.into_iter().find(|(name, _)| *name == word) {
            return Ok(order);
        }
        Self::all().into_iter().find(|order| order.to_string() == word).ok_or(UnknownOrder(text.into()))
    }
}

/// Three angles in the order in which they are written, radians.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrittenAngles {
    /// The angles.
    pub angles: [f64; 3],
    /// False where the rotation has many such angles, or has them to half of the digits of a double only.
    pub are_unique: bool,
}

/// Angles whose middle one is as near to its end as this (radians) have less than half of the digits of a double: the
/// rounding of the matrix, 1e-16, moves them by 1e-16 over the distance.
const NEAR_LOCK: f64 = 1e-8;

/// Axes and angles in the order of the product of matrices, from that in which they are written, and back.
fn in_product<T: Copy>(axes: TurnAxes, about: [FrameAxis; 3], list: [T; 3]) -> ([FrameAxis; 3], [T; 3]) {
    let reversed = |[x, y, z]: [FrameAxis; 3]| [z, y, x];
    match axes {
        TurnAxes::Moving => (about, list),
        TurnAxes::Fixed => (reversed(about), [list[2], list[1], list[0]]),
    }
}

/// The angles of `R = R_i(a) R_j(b) R_k(c)` with `j` other than `i` and `k`.
///
/// With `e = 1` where `i`, `j` and the third axis follow each other as x, y, z do, else `-1`, the column of the last
/// turn gives `a` and `b`, and row `j` of `R_i(-a) R`, which is `e_j^T R_k(c)` at every `b`, gives `c`.
pub(super) fn angles_of_product(r: &Matrix3<f64>, [i, j, last]: [usize; 3]) -> WrittenAngles {
    let k = 3 - i - j;
    let sign = if (i + 1) % 3 == j { 1.0 } else { -1.0 };
    // + 0.0: the angle of (-0, -0) is no half turn
    let (a, b, from_lock) = if last == k {
        let across = r[(k, k)].hypot(r[(j, k)]);
        ((-sign * r[(j, k)] + 0.0).atan2(r[(k, k)] + 0.0), (sign * r[(i, k)]).atan2(across), across)
    } else {
        let across = r[(j, i)].hypot(r[(k, i)]);
        ((r[(j, i)] + 0.0).atan2(-sign * r[(k, i)] + 0.0), across.atan2(r[(i, i)]), across)
    };
    let (sin, cos) = a.sin_cos();
    let row = |column: usize| cos * r[(j, column)] + sign * sin * r[(k, column)];
    let c = if last == k { (sign * row(i)).atan2(row(j)) } else { (-sign * row(k)).atan2(row(j)) };
    WrittenAngles { angles: [a, b, c], are_unique: from_lock > NEAR_LOCK }
}

num::words! {
    /// The unit of angles.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum AngleUnit as name {
        /// Degrees.
        #[default]
        Degrees = "deg",
        /// Radians.
        Radians = "rad",
    }
}

impl AngleUnit {
    fn radians(self, angle: f64) -> f64 {
        match self {
            Self::Degrees => angle.to_radians(),
            Self::Radians => angle,
        }
    }

    /// An angle in this unit.
    #[must_use]
    pub fn of_radians(self, angle: f64) -> f64 {
        match self {
            Self::Degrees => angle.to_degrees(),
            Self::Radians => angle,
        }
    }
}

num::words! {
    /// The place of the scalar in a quaternion.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum QuaternionOrder as name {
        /// In front.
        #[default]
        ScalarFirst = "wxyz",
        /// Behind.
        ScalarLast = "xyzw",
    }
}

impl QuaternionOrder {
    /// Four things in the order `w, x, y, z`, from the one in which they are written.
    #[must_use]
    pub fn scalar_first<T>(self, [a, b, c, d]: [T; 4]) -> [T; 4] {
        match self {
            Self::ScalarFirst => [a, b, c, d],
            Self::ScalarLast => [d, a, b, c],
        }
    }

    /// Four things in the order in which they are written, from `w, x, y, z`.
    #[must_use]
    pub fn written<T>(self, [w, x, y, z]: [T; 4]) -> [T; 4] {
        match self {
            Self::ScalarFirst => [w, x, y, z],
            Self::ScalarLast => [x, y, z, w],
        }
    }
}

num::words! {
    /// The axis that points up.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum UpAxis as name {
        /// y, in the base frame and in that of the platform: `(x, y, z)` are our `(x, -z, y)`.
        Y = "y",
        /// z, as in this program.
        #[default]
        Z = "z",
    }
}

impl UpAxis {
    fn to_ours(self, v: Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Y => Vector3::new(v.x, -v.z, v.y),
            Self::Z => v,
        }
    }

    fn theirs_of(self, v: Vector3<f64>) -> Vector3<f64> {
        match self {
            Self::Y => Vector3::new(v.x, v.z, -v.y),
            Self::Z => v,
        }
    }

    fn turned(self, r: &Rotation3<f64>, to: impl Fn(Self, Vector3<f64>) -> Vector3<f64>) -> Rotation3<f64> {
        if self == Self::Z {
            return *r;
        }
        // C R C^T by columns: both maps only exchange entries and change signs
        let once = Matrix3::from_columns(&[0, 1, 2].map(|k| to(self, r.matrix().column(k).into_owned())));
        let twice = once.transpose();
        let twice = Matrix3::from_columns(&[0, 1, 2].map(|k| to(self, twice.column(k).into_owned())));
        Rotation3::from_matrix_unchecked(twice.transpose())
    }
}

/// A convention for poses. An absent part is as in this program, unless names of columns state another one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PoseConvention {
    /// Order of the turns.
    pub rotation_order: Option<RotationOrder>,
    /// Unit of angles.
    pub angles: Option<AngleUnit>,
    /// Order of quaternions.
    pub quaternion: Option<QuaternionOrder>,
    /// The point of the platform whose position is given, in the frame of the platform with the axes of the convention.
    pub pivot: Option<Vector3<f64>>,
    /// The pose from which poses are measured.
    pub relative_to: Option<ListedFrom>,
    /// The axis that points up.
    pub up: Option<UpAxis>,
}

/// A pose in a convention.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WrittenPose {
    /// Position of the pivot.
    pub position: [f64; 3],
    /// Angles in the unit of the convention, in the order in which they are written.
    pub angles: [f64; 3],
    /// False where the rotation has many such angles.
    pub angles_are_unique: bool,
    /// The unit quaternion in the order of the convention, its scalar not negative.
    pub quaternion: [f64; 4],
}

impl WrittenPose {
    /// Position and angles.
    #[must_use]
    pub fn numbers(&self) -> [f64; 6] {
        let ([x, y, z], [a, b, c]) = (self.position, self.angles);
        [x, y, z, a, b, c]
    }
}

impl PoseConvention {
    /// This convention, filled by the other one where this one states nothing.
    #[must_use]
    pub fn over(self, below: &Self) -> Self {
        Self {
            rotation_order: self.rotation_order.or(below.rotation_order),
            angles: self.angles.or(below.angles),
            quaternion: self.quaternion.or(below.quaternion),
            pivot: self.pivot.or(below.pivot),
            relative_to: self.relative_to.or(below.relative_to),
            up: self.up.or(below.up),
        }
    }

    /// The order of the turns.
    #[must_use]
    pub fn order(&self) -> RotationOrder {
        self.rotation_order.unwrap_or_default()
    }

    /// The unit of angles.
    #[must_use]
    pub fn angle_unit(&self) -> AngleUnit {
        self.angles.unwrap_or_default()
    }

    /// The order of quaternions.
    #[must_use]
    pub fn quaternion_order(&self) -> QuaternionOrder {
        self.quaternion.unwrap_or_default()
    }

    /// The pose from which poses are measured.
    #[must_use]
    pub fn measured_from(&self) -> ListedFrom {
        self.relative_to.unwrap_or_default()
    }

    /// The axis that points up.
    #[must_use]
    pub fn up_axis(&self) -> UpAxis {
        self.up.unwrap_or_default()
    }

    /// The pivot in our axes of the platform frame.
    #[must_use]
    pub fn pivot_on_platform(&self) -> Vector3<f64> {
        self.pivot.map_or_else(Vector3::zeros, |pivot| self.up_axis().to_ours(pivot))
    }

    /// The axes of the convention in ours, by columns: the same in the base frame and in that of the platform.
    #[must_use]
    pub fn axes(&self) -> Matrix3<f64> {
        let up = self.up_axis();
        Matrix3::from_columns(&[0, 1, 2].map(|k| up.to_ours(Vector3::ith(k, 1.0))))
    }

    /// Whether poses are written as this program does.
    #[must_use]
    pub fn is_usual(&self) -> bool {
        self.order() == FIXED_XYZ
            && self.angle_unit() == AngleUnit::Degrees
            && self.quaternion_order() == QuaternionOrder::ScalarFirst
            && self.pivot_on_platform() == Vector3::zeros()
            && self.measured_from() == ListedFrom::Base
            && self.up_axis() == UpAxis::Z
    }

    /// The pose of six numbers, position and angles; of seven, position and a quaternion of norm 1 within a thousandth;
    /// or of twelve or sixteen, the matrix `(R p)` or `(R p; 0 0 0 1)` row by row.
    ///
    /// # Errors
    /// Another number of numbers, numbers that are not finite, another norm, a matrix that is no rotation within the
    /// rounding of its decimals.
    pub fn read(&self, numbers: &[f64], home: &Pose) -> Result<Pose, InvalidPose> {
        if !numbers.iter().all(|x| x.is_finite()) {
            return Err(InvalidPose::NotFinite);
        }
        let written = match *numbers {
            [x, y, z, a, b, c] => {
                let angles = [a, b, c].map(|angle| self.angle_unit().radians(angle));
                Pose { position: Vector3::new(x, y, z), rotation: self.order().rotation(angles) }
            }
            [x, y, z, a, b, c, d] => {
                Pose::from_quaternion([x, y, z], self.quaternion_order().scalar_first([a, b, c, d]))?
            }
            _ => match numbers.len() {
                12 => matrix::of_twelve(numbers)?,
                16 => matrix::of_sixteen(numbers)?,
                9 => return Err(matrix::without_position(numbers)),
                count => {
                    let message =
                        format!("{count} values instead of six or seven, or twelve or sixteen of a matrix");
                    return Err(InvalidPose::Text(message));
                }
            },
        };
        Ok(self.in_base_frame(&written, home))
    }

    /// The same of numbers in a text, separated by commas.
    ///
    /// # Errors
    /// As of [`read`](Self::read), and a text that is no number.
    pub fn read_text(&self, text: &str, home: &Pose) -> Result<Pose, InvalidPose> {
        let number = |(k, field): (usize, &str)| match field.trim().parse::<f64>() {
            Ok(x) if x.is_finite() => Ok(x),
            _ => {
                let message = format!("value {}, `{}`, is not a finite number", k + 1, field.trim());
                Err(InvalidPose::Text(message))
            }
        };
        let numbers: Vec<f64> = text.split(',').enumerate().map(number).collect::<Result<_, _>>()?;
        self.read(&numbers, home)
    }

    /// Our pose of one in the frames of the convention.
    #[must_use]
    pub fn in_base_frame(&self, written: &Pose, home: &Pose) -> Pose {
        let up = self.up_axis();
        let own = Pose {
            rotation: up.turned(&written.rotation, UpAxis::to_ours),
            position: up.to_ours(written.position),
        };
        let placed = self.measured_from().in_base_frame(&own, home);
        self.pivoted(placed, home, 1.0)
    }

    /// The pose in the frames of the convention of one of ours.
    #[must_use]
    pub fn as_stated(&self, pose: &Pose, home: &Pose) -> Pose {
        let up = self.up_axis();
        let own = self.measured_from().as_listed(&self.pivoted(*pose, home, -1.0), home);
        Pose { rotation: up.turned(&own.rotation, UpAxis::theirs_of), position: up.theirs_of(own.position) }
    }

    /// From the pose whose position is that of the pivot to that of the origin (`sign` 1), and back.
    fn pivoted(&self, mut pose: Pose, home: &Pose, sign: f64) -> Pose {
        // without a pivot no digit changes
        if self.pivot.is_some() {
            let pivot = self.pivot_on_platform();
            let mut arm = -(pose.rotation * pivot);
            if self.measured_from() == ListedFrom::Home {
                arm += home.rotation * pivot;
            }
            pose.position += arm * sign;
        }
        pose
    }

    /// A pose in the numbers of the convention.
    #[must_use]
    pub fn write(&self, pose: &Pose, home: &Pose) -> WrittenPose {
        let stated = self.as_stated(pose, home);
        let found = self.order().angles(&stated.rotation);
        WrittenPose {
            position: stated.position.into(),
            angles: found.angles.map(|angle| self.angle_unit().of_radians(angle)),
            angles_are_unique: found.are_unique,
            quaternion: self.quaternion_order().written(stated.quaternion()),
        }
    }

    /// For each of the six numbers of a pose the velocity of the pivot and the angular velocity, base frame, with which
    /// it grows by 1 (radians) while the others stay.
    ///
    /// With one angle changed the platform turns about a fixed axis. The components of a rotation vector do not; in
    /// their place stand turns about x, y and z.
    #[must_use]
    pub fn ways(&self, pose: &Pose, home: &Pose) -> [[Vector3<f64>; 2]; 6] {
        let up = self.up_axis();
        let axis = |k: usize| Vector3::ith(k, 1.0);
        let turned_about = match self.order() {
            RotationOrder::Vector => [0, 1, 2].map(axis),
            RotationOrder::Turns(axes, about) => {
                let found = self.order().angles(&self.as_stated(pose, home).rotation);
                let (about, angles) = in_product(axes, about, found.angles);
                let mut before = Rotation3::identity();
                let list = [0, 1, 2].map(|k| {
                    let own = before * axis(about[k].index());
                    before *= about[k].turn(angles[k]);
                    own
                });
                in_product(axes, about, list).1
            }
        };
        let still = Vector3::zeros();
        let [x, y, z] = [0, 1, 2].map(|k| [up.to_ours(axis(k)), still]);
        let [a, b, c] = turned_about.map(|own| [still, up.to_ours(own)]);
        [x, y, z, a, b, c]
    }

    /// Names of columns for three angles in the order in which they are written, with their unit.
    #[must_use]
    pub fn angle_names(&self) -> [String; 3] {
        let unit = self.angle_unit().name();
        self.angle_words().map(|word| format!("{word}_{unit}"))
    }

    /// The same without the unit.
    #[must_use]
    pub fn angle_words(&self) -> [&'static str; 3] {
        let order = self.order();
        match (order, order.places()) {
            (FIXED_XYZ, _) => ["roll", "pitch", "yaw"],
            (RotationOrder::Vector, _) => ["rx", "ry", "rz"],
            (RotationOrder::Turns(_, about), Some(_)) => about.map(|axis| ["rx", "ry", "rz"][axis.index()]),
            _ => ["a", "b", "c"],
        }
    }

    /// The convention in sentences: the order of the turns in every case, the rest where it is not the usual one.
    #[must_use]
    pub fn sentences(&self) -> String {
        let unit = match self.angle_unit() {
            AngleUnit::Degrees => "degrees",
            AngleUnit::Radians => "radians",
        };
        let order = self.order();
        let mut out = match order {
            RotationOrder::Vector => format!("Rotations are rotation vectors (a, b, c) in {unit}."),
            RotationOrder::Turns(..) => {
                format!("Angles a, b, c are in {unit} in the order {order}: R = {}.", order.formula())
            }
        };
        if let Some(pivot) = self.pivot.filter(|pivot| *pivot != Vector3::zeros()) {
            let _ = write!(
                out,
                " Positions are those of the platform point ({}, {}, {}).",
                pivot.x, pivot.y, pivot.z
            );
        }
        if self.measured_from() == ListedFrom::Home {
            out += " Poses count from home, along the axes of the base.";
        }
        if self.up_axis() == UpAxis::Y {
            out += " The y axis is up.";
        }
        if self.quaternion_order() == QuaternionOrder::ScalarLast {
            out += " Quaternions have the scalar last.";
        }
        out
    }
}

#[cfg(test)]
mod tests;
