//! Standard manoeuvres: a sine in one freedom, and an acceleration from rest.

use std::str::FromStr;

use nalgebra::{Rotation3, Unit, Vector3};
use thiserror::Error;

use super::MotionState;
use platform::geom::Pose;

num::answer_words! {
    /// A freedom of the platform: along an axis of the base frame, or about the line through the platform origin that
    /// is parallel to it.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    pub enum PlatformFreedom as name {
        /// Along x.
        X = "x",
        /// Along y.
        Y = "y",
        /// Along z.
        Z = "z",
        /// About x.
        Roll = "roll",
        /// About y.
        Pitch = "pitch",
        /// About z.
        Yaw = "yaw",
    }
}

impl PlatformFreedom {
    /// `true` for the three rotations, whose amounts are in degrees.
    #[must_use]
    pub fn is_turn(self) -> bool {
        self as usize >= 3
    }

    fn axis(self) -> Unit<Vector3<f64>> {
        [Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis()][self as usize % 3]
    }

    /// The state of a platform that moved from `about` by `amount` (design units or radians) in this freedom, with the
    /// derivatives of the amount.
    fn state(self, about: &Pose, [amount, speed, acceleration]: [f64; 3]) -> MotionState {
        let axis = self.axis();
        let rest = MotionState::at_rest(*about);
        if self.is_turn() {
            let rotation = Rotation3::from_axis_angle(&axis, amount) * about.rotation;
            return MotionState {
                pose: Pose { rotation, ..*about },
                angular_velocity: axis.scale(speed),
                angular_acceleration: axis.scale(acceleration),
                ..rest
            };
        }
        MotionState {
            pose: Pose { position: about.position + axis.scale(amount), ..*about },
            velocity: axis.scale(speed),
            acceleration: axis.scale(acceleration),
            ..rest
        }
    }
}

/// A standard manoeuvre. Amounts are design units along an axis and degrees about one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Manoeuvre {
    /// `amplitude sin(2 pi frequency t)` over one period.
    Sine {
        /// The moving freedom.
        freedom: PlatformFreedom,
        /// Design units or degrees.
        amplitude: f64,
        /// Hertz, positive.
        frequency: f64,
    },
    /// An acceleration from rest: the forces needed to start or to stop.
    Acceleration {
        /// The moving freedom.
        freedom: PlatformFreedom,
        /// Design units or degrees per second squared.
        acceleration: f64,
    },
}

/// A text that is no manoeuvre.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum InvalidManoeuvre {
    /// It has a wrong number of parts.
    #[error("`{0}` is not of the form {1}")]
    Form(String, &'static str),
    /// Its freedom is unknown.
    #[error("`{0}` is not an axis")]
    Freedom(String),
    /// One of its numbers is not a number or has the wrong sign.
    #[error("`{0}` is not {1}")]
    Number(String, &'static str),
}

impl FromStr for PlatformFreedom {
    type Err = InvalidManoeuvre;

    fn from_str(word: &str) -> Result<Self, InvalidManoeuvre> {
        let found = Self::ALL.into_iter().find(|f| f.name() == word.trim());
        found.ok_or_else(|| InvalidManoeuvre::Freedom(word.into()))
    }
}

fn finite(text: &str) -> Result<f64, InvalidManoeuvre> {
    let value = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    value.ok_or_else(|| InvalidManoeuvre::Number(text.into(), "a number"))
}

fn positive(text: &str) -> Result<f64, InvalidManoeuvre> {
    let value = finite(text)?;
    if value > 0.0 { Ok(value) } else { Err(InvalidManoeuvre::Number(text.into(), "a positive number")) }
}

impl Manoeuvre {
    /// Reads `FREEDOM:AMPLITUDE:HERTZ`.
    ///
    /// # Errors
    /// [`InvalidManoeuvre`].
    pub fn sine(text: &str) -> Result<Self, InvalidManoeuvre> {
        let parts: Vec<&str> = text.split(':').collect();
        let [freedom, amplitude, frequency] = parts[..] else {
            return Err(InvalidManoeuvre::Form(text.into(), "AXIS:AMPLITUDE:HERTZ"));
        };
        let freedom = freedom.parse()?;
        Ok(Self::Sine { freedom, amplitude: positive(amplitude)?, frequency: positive(frequency)? })
    }

    /// Reads `FREEDOM:ACCELERATION`.
    ///
    /// # Errors
    /// [`InvalidManoeuvre`].
    pub fn acceleration(text: &str) -> Result<Self, InvalidManoeuvre> {
        let parts: Vec<&str> = text.split(':').collect();
        let [freedom, acceleration] = parts[..] else {
            return Err(InvalidManoeuvre::Form(text.into(), "AXIS:ACCELERATION"));
        };
        Ok(Self::Acceleration { freedom: freedom.parse()?, acceleration: finite(acceleration)? })
    }

    /// Its duration, seconds; 0 for an acceleration from rest.
    #[must_use]
    pub fn duration(&self) -> f64 {
        match self {
            Self::Sine { frequency, .. } => 1.0 / frequency,
            Self::Acceleration { .. } => 0.0,
        }
    }

    /// The state at a time.
    #[must_use]
    pub fn at(&self, about: &Pose, time: f64) -> MotionState {
        let in_freedom =
            |freedom: PlatformFreedom, x: f64| if freedom.is_turn() { x.to_radians() } else { x };
        match *self {
            Self::Sine { freedom, amplitude, frequency } => {
                let a = in_freedom(freedom, amplitude);
                let w = std::f64::consts::TAU * frequency;
                let (sine, cosine) = (w * time).sin_cos();
                freedom.state(about, [a * sine, a * w * cosine, -a * w * w * sine])
            }
            Self::Acceleration { freedom, acceleration } => {
                freedom.state(about, [0.0, 0.0, in_freedom(freedom, acceleration)])
            }
        }
    }
}
