//! Constructions of a design whose joints derive from those of another.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

use super::expression::{UnitsBehind, Unsolved};
use super::resolve::on_line;
use super::{Construction, Constructions, LinePlace, RealPoint, Spelling, WrittenHome, WrittenNumber};
use crate::design::DesignModel;
use crate::design::scale::micrometres;
use num::real::{NoReal, RealNumber};
use num::surd::Surd;
use platform::manipulator::Body;

/// A share of the way from one joint to another, as written: a decimal, or an expression such as `1/5` or
/// `2 - sqrt(3)`.
#[derive(Debug, Clone, PartialEq)]
pub struct Share {
    written: WrittenNumber,
    value: RealNumber,
}

/// A text that is not a share.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("`{text}`: {why}")]
pub struct InvalidShare {
    text: String,
    why: String,
}

impl Share {
    /// The shortest decimal that reads back to this double; `None` unless it is finite.
    #[must_use]
    pub fn shortest(x: f64) -> Option<Self> {
        let written = WrittenNumber::shortest(x)?;
        let value = RealNumber::rational(&written.expression().decimal()?).ok()?;
        Some(Self { written, value })
    }

    /// The exact number; `None` if it is known only between bounds.
    #[must_use]
    pub fn exact(&self) -> Option<&Surd> {
        self.value.exact()
    }

    /// The nearest double.
    #[must_use]
    pub fn nearest(&self) -> f64 {
        self.value.nearest()
    }
}

/// A length in the unit of a design: a decimal or an expression, which may have a unit of its own: `12/5 mm`.
///
/// # Errors
/// A text that is no number; a unit where the label of the design's unit names no known length.
pub fn length_in(text: &str, units: &str) -> Result<RealNumber, InvalidShare> {
    let text = text.trim();
    if let Ok(decimal) = text.parse::<f64>()
        && let Some(share) = Share::shortest(decimal)
    {
        return Ok(share.value);
    }
    let refuse = |why: String| InvalidShare { text: text.to_owned(), why };
    let read = WrittenNumber::with_units(text, UnitsBehind::Length(micrometres(units)));
    valued(&read.map_err(|slip| refuse(slip.message))?.0).map_err(refuse)
}

impl DesignModel {
    /// The share of the way from one joint of a body to another at which a text puts a joint: a share, or a length with
    /// a unit from the first joint: `1/5`, `12/5 mm`. It is exact where the joints and the length are.
    ///
    /// # Errors
    /// A text that is neither; a unit where the design has none; two joints at one place.
    pub fn share_of(&self, body: Body, ends: [usize; 2], text: &str) -> Result<Share, InvalidShare> {
        if let Ok(share) = text.parse() {
            return Ok(share);
        }
        let length = length_in(text, &self.units)?;
        let refuse = |why: String| InvalidShare { text: text.trim().to_owned(), why };
        let points = self.constructions.exact(body, self.manipulator.joints(body));
        let way = || -> Result<RealNumber, NoReal> {
            let [a, b] = ends.map(|end| &points[end]);
            let [x, y, z] = [0, 1, 2].map(|i| b[i].minus(&a[i]));
            let [x, y, z] = [x?, y?, z?].map(|x| x.times(&x));
            length.over(&x?.plus(&y?)?.plus(&z?)?.sqrt()?)
        };
        let value = way().map_err(|why| refuse(why.to_string()))?;
        let written = value.exact().and_then(|exact| WrittenNumber::text(&exact.to_string()).ok());
        match written {
            Some(written) => Ok(Share { written, value }),
            None => {
                Share::shortest(value.nearest()).ok_or_else(|| refuse("the share is not finite".to_owned()))
            }
        }
    }
}

/// The value of a number without names.
fn valued(written: &WrittenNumber) -> Result<RealNumber, String> {
    let value = written.expression().value(&|name| Err(Unsolved::Name(name.to_owned())));
    value.map_err(|stuck| match stuck.why {
        Unsolved::NoReal(why) => why.to_string(),
        Unsolved::Name(name) => format!("no value belongs to `{name}` here"),
        Unsolved::Poisoned => "it has no value".to_owned(),
    })
}

impl FromStr for Share {
    type Err = InvalidShare;

    fn from_str(text: &str) -> Result<Self, InvalidShare> {
        let text = text.trim();
        let refuse = |why: String| InvalidShare { text: text.to_owned(), why };
        if let Some(decimal) = text.parse().ok().and_then(Self::shortest) {
            return Ok(decimal);
        }
        let written = WrittenNumber::text(text).map_err(|slip| refuse(slip.message))?;
        let value = valued(&written).map_err(refuse)?;
        Ok(Self { written, value })
    }
}

/// As it is written.
impl fmt::Display for Share {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.written.written() {
            Spelling::Number(x) => write!(f, "{x:?}"),
            Spelling::Text(text) => f.write_str(text),
        }
    }
}

/// The origin of a joint, in terms of the joints of the same body of the previous design.
#[derive(Debug, Clone, PartialEq)]
pub enum Origin {
    /// It is this joint.
    Kept(usize),
    /// It is on the line of two of them, at this share of the way.
    Between([usize; 2], Box<Share>),
    /// It is in the plane of three of them: at so many ways from the first to the second and to the third.
    InPlane([usize; 3], Box<[Share; 2]>),
    /// It is given by its coordinates alone.
    New,
}

impl Origin {
    /// A joint on the line of two joints at this share; given by its coordinates if the share is not finite.
    #[must_use]
    pub fn between(ends: [usize; 2], t: f64) -> Self {
        Share::shortest(t).map_or(Self::New, |share| Self::Between(ends, Box::new(share)))
    }
}

impl DesignModel {
    /// The design with the constructions of the joints it takes from another design, and with those of joints on the
    /// lines of its joints.
    ///
    /// A construction may refer to joints that no longer exist. The joint is then given by its exact coordinates, or by
    /// three doubles if these have no short expression. The same applies to a joint at another place.
    pub fn constructed_from(self, old: &Self, origins: [&[Origin]; 2]) -> Self {
        let mut made = Constructions::default();
        for body in Body::BOTH {
            let list = self.carried(old, body, origins[body.index()]);
            made.joints[body.index()] = if list.iter().all(Option::is_none) { Vec::new() } else { list };
        }
        made.home = old.written_home().filter(|written| self.home == Some(written.pose)).cloned();
        let used = |(_, q): (usize, &WrittenNumber)| !q.expression().names().is_empty();
        let mut all = made.joints.iter().flatten().flatten().flat_map(Construction::quantities);
        if all.any(used) || made.home.iter().flat_map(WrittenHome::quantities).any(used) {
            made.parameters.clone_from(&old.constructions.parameters);
        }
        if made.is_empty() {
            return self;
        }
        // constructions that fail leave the joint with its three numbers
        self.clone().with_constructions(made).unwrap_or(self)
    }

    /// The design with the joints of a body at these decimals, in their order; a body without a list stays unchanged.
    pub fn at_decimals(self, decimals: [Option<&[[String; 3]]>; 2]) -> Self {
        let mut made = self.current_constructions();
        for (own, list) in made.joints.iter_mut().zip(decimals) {
            let number = |text: &String| WrittenNumber::text(text).ok();
            let joint = |[x, y, z]: &[String; 3]| {
                Some(Construction::Coordinates([number(x)?, number(y)?, number(z)?]))
            };
            if let Some(list) = list {
                *own = list.iter().map(joint).collect();
            }
        }
        self.clone().with_constructions(made).unwrap_or(self)
    }

    /// The design with base and platform exchanged; joints keep their constructions from `old`.
    pub fn exchanged_from(self, old: &Self) -> Self {
        let mut made = old.constructions.clone();
        made.joints.swap(0, 1);
        made.home = None; // of the other body
        self.clone().with_constructions(made).unwrap_or(self)
    }

    fn carried(&self, old: &Self, body: Body, origins: &[Origin]) -> Vec<Option<Construction>> {
        let (m, before) = (self.manipulator(), old.manipulator());
        let points = body.of((m.base_joints(), m.platform_joints()));
        let old_points = body.of((before.base_joints(), before.platform_joints()));
        let exact = old.exact_points(body);
        // a joint of the previous design that kept its place
        let stayed = |new: usize, joint: usize| points[new] == old_points[joint];
        let place = |joint: usize| {
            origins.iter().enumerate().position(|(new, o)| *o == Origin::Kept(joint) && stayed(new, joint))
        };
        let one = |(new, origin): (usize, &Origin)| -> Option<Construction> {
            match origin {
                Origin::New => None,
                Origin::Kept(joint) if !stayed(new, *joint) => None,
                Origin::Kept(joint) => {
                    let own = old.constructions.of(body, *joint)?;
                    own.moved(&place).or_else(|| coordinates(&exact[*joint]))
                }
                Origin::Between(ends, t) => {
                    let share = LinePlace::Share(t.written.clone());
                    let [a, b] = ends.map(|joint| origins.iter().position(|o| *o == Origin::Kept(joint)));
                    if let (Some(a), Some(b)) = (a, b) {
                        return Some(Construction::OnLine { through: [a, b], at: share });
                    }
                    let [a, b] = ends.map(|joint| &exact[joint]);
                    coordinates(&on_line(a, b, &share, &t.value)?.ok()??)
                }
                Origin::InPlane(corners, shares) => {
                    let corners = corners.map(|joint| &exact[joint]);
                    coordinates(&in_plane(corners, shares.each_ref().map(|share| &share.value)).ok()?)
                }
            }
        };
        origins.iter().enumerate().map(one).collect()
    }
}

/// `a + t (b - a) + u (c - a)`.
fn in_plane([a, b, c]: [&RealPoint; 3], [t, u]: [&RealNumber; 2]) -> Result<RealPoint, NoReal> {
    let one = |i: usize| {
        let along = |to: &RealPoint, share: &RealNumber| to[i].minus(&a[i])?.times(share);
        a[i].plus(&along(b, t)?)?.plus(&along(c, u)?)
    };
    Ok([one(0)?, one(1)?, one(2)?])
}

impl Construction {
    /// The construction with other indices of joints; `None` if one of them has none.
    fn moved(&self, place: &dyn Fn(usize) -> Option<usize>) -> Option<Self> {
        let mut moved = self.clone();
        match &mut moved {
            Self::Coordinates(_) | Self::Polar { .. } => {}
            Self::OnLine { through, .. } => {
                for joint in through {
                    *joint = place(*joint)?;
                }
            }
            Self::Turned { joint, .. } | Self::Mirrored { joint, .. } => *joint = place(*joint)?,
        }
        Some(moved)
    }
}

/// Exact coordinates as expressions; `None` if they are unknown or long.
fn coordinates(point: &RealPoint) -> Option<Construction> {
    let one = |x: &RealNumber| WrittenNumber::text(&x.exact()?.to_string()).ok();
    let [x, y, z] = point;
    Some(Construction::Coordinates([one(x)?, one(y)?, one(z)?]))
}
