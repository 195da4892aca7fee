//! The platform that moves of legs make, and its equivalence to the design.

use std::str::FromStr;

use nalgebra::Point3;
use thiserror::Error;

use crate::{Design, NoReplaceableLegs, ReplaceableOptions};
use files::design::{InvalidShare, Share};
use num::linalg::LinalgError;
use platform::manipulator::{Body, LegIndex};
use synthesis::components::{ComponentOptions, Components, Parametrisation};
use synthesis::relocate::{
    Chain, LegMove, RelocateError, Relocation, counted_from, family_between, relocate,
};
use synthesis::{LegMapTolerances, Relation};
use verify::decide_map;

/// The end of a leg is at a joint within this share of the size of the design.
const STAYS: f64 = 1e-9;

/// A family of replaceable legs by its name.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum NamedFamily {
    /// Its number, from 1.
    Number(usize),
    /// The joints that span its flats: `P1:P4-P5`.
    Between(String),
}

/// A move of one leg along a family; written `LEG:FAMILY:T[,U,..]`, for instance `1:P1:P4-P5:1/4`.
#[derive(Debug, Clone, PartialEq)]
pub struct LegMoveRequest {
    /// The leg.
    pub leg: LegIndex,
    /// The family.
    pub along: NamedFamily,
    /// The place on the family.
    pub parameters: Vec<Share>,
}

/// Why a text is no move.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidMove {
    /// It has another form.
    #[error("`{0}` is not a move")]
    Form(String),
    /// It names no leg.
    #[error("`{0}` is not the number of a leg")]
    Leg(String),
    /// A parameter is no number.
    #[error(transparent)]
    Parameter(#[from] InvalidShare),
}

impl LegMoveRequest {
    /// A move from its three parts.
    ///
    /// # Errors
    /// [`InvalidMove`].
    pub fn of(leg: &str, along: &str, to: &str) -> Result<Self, InvalidMove> {
        let number = leg.trim().parse::<usize>().ok().and_then(|n| n.checked_sub(1));
        let along = along.trim();
        Ok(Self {
            parameters: to.split(',').map(str::parse).collect::<Result<_, _>>()?,
            along: along.parse().map_or_else(|_| NamedFamily::Between(along.into()), NamedFamily::Number),
            leg: number.and_then(LegIndex::new).ok_or_else(|| InvalidMove::Leg(leg.into()))?,
        })
    }
}

impl FromStr for LegMoveRequest {
    type Err = InvalidMove;

    fn from_str(text: &str) -> Result<Self, InvalidMove> {
        let parts = text.split_once(':').and_then(|(leg, rest)| Some((leg, rest.rsplit_once(':')?)));
        let (leg, (along, to)) = parts.ok_or_else(|| InvalidMove::Form(text.into()))?;
        Self::of(leg, along, to)
    }
}

/// Options of a move of legs.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MoveOptions {
    /// All at once, along families of the given design, instead of one after another.
    pub together: bool,
    /// Options of the search for families.
    pub search: ComponentOptions,
}

impl MoveOptions {
    num::setters! {
        /// Whether the legs move all at once, along families of the given design.
        fn together(together: bool) = together;
        /// Options of the search for families.
        fn search(search: ComponentOptions) = search;
    }
}

/// Moves made at once, with the names of the families that they used.
#[derive(Debug, Clone)]
pub struct MovedAtOnce {
    /// The moves and their map.
    pub relocation: Relocation,
    /// For each move the type of its family and the joints that span it.
    pub families: Vec<(String, Option<String>)>,
    /// For each move its parameters as they were written.
    pub written: Vec<Vec<String>>,
    /// The new design; `None` when the legs make no platform.
    pub design: Option<Design>,
}

/// Moves of legs, with the platform they make.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct MovesReport {
    /// Moves made at once, one after another; the first singular one is the last.
    pub steps: Vec<MovedAtOnce>,
    /// Their composition, and the map from the design to the last platform.
    pub chain: Chain,
    /// All moves were made at once.
    pub together: bool,
    /// Moves that were not made, because one before them is not regular.
    pub left_out: usize,
    /// The last platform, with the leg lengths of the design's pose; `None` when its legs make no platform.
    pub design: Option<Design>,
}

impl MovesReport {
    /// The relation of the last step, which decides: the steps before it were regular.
    #[must_use]
    pub fn outcome(&self) -> Option<Relation> {
        self.steps.last().and_then(|step| step.relocation.map.relation.decided())
    }

    /// Every step is regular: the new platform is equivalent to the design.
    #[must_use]
    pub fn is_regular(&self) -> bool {
        self.steps.iter().all(|step| step.relocation.is_regular())
    }

    /// The platform is architecturally singular.
    #[must_use]
    pub fn is_singular(&self) -> bool {
        self.steps.iter().any(|step| step.relocation.map.relation == Relation::Singular)
    }
}

/// The reason that legs are not moved; a family that does not exist comes with the families that do.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoMoves {
    /// The families cannot be found.
    #[error(transparent)]
    Families(#[from] NoReplaceableLegs),
    /// The text names no family.
    #[error("`{0}` is neither the number of a family nor base joints, a colon and platform joints")]
    NotAFamily(String),
    /// No family has that number, or lies between those joints.
    #[error("{message}")]
    NoSuchFamily {
        /// The family that was meant.
        message: String,
        /// The families that there are.
        families: String,
    },
    /// The joints fit several families.
    #[error("`{text}` fits the families {}", numbers.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "))]
    Ambiguous {
        /// The joints.
        text: String,
        /// The numbers of the families, from 1.
        numbers: Vec<usize>,
    },
    /// A leg cannot be moved like this.
    #[error("{why}")]
    Move {
        /// The reason.
        why: RelocateError,
        /// The families that there are.
        families: String,
    },
    /// No leg would end at a joint that may not be moved.
    #[error("the joint {0} is `fixed` in [optimize], and no leg would end there")]
    Fixed(String),
    /// A decomposition that does not converge.
    #[error(transparent)]
    Linalg(#[from] LinalgError),
}

impl Design {
    /// The platform that moves of legs make, with its relation to the design.
    ///
    /// # Errors
    /// [`NoMoves`].
    pub fn move_legs(&self, moves: &[LegMoveRequest], options: MoveOptions) -> Result<MovesReport, NoMoves> {
        let at_once = if options.together { moves.len().max(1) } else { 1 };
        let mut steps: Vec<MovedAtOnce> = Vec::new();
        for together in moves.chunks(at_once) {
            let current = steps.last().and_then(|step| step.design.as_ref()).unwrap_or(self);
            let step = self.step(current, together, options.search)?;
            let regular = step.relocation.is_regular();
            steps.push(step);
            if !regular {
                break;
            }
        }
        let relocations: Vec<Relocation> = steps.iter().map(|step| step.relocation.clone()).collect();
        let mut chain = Chain::of(self.manipulator(), &relocations, LegMapTolerances::default())?;
        let last = steps.last().and_then(|step| step.design.clone());
        if let Some(new) = &last {
            self.keeps_fixed(new)?;
            chain.direct = decide_map(self.manipulator(), new.manipulator())?;
        }
        let made: usize = relocations.iter().map(|r| r.moved.len()).sum();
        let together = options.together;
        let report = MovesReport { steps, chain, together, left_out: moves.len() - made, design: None };
        Ok(MovesReport { design: last.map(|new| self.finished(new, &report)), ..report })
    }

    /// Moves of legs of `current` made at once; names mean joints of this design, where they are.
    fn step(
        &self,
        current: &Self,
        requests: &[LegMoveRequest],
        search: ComponentOptions,
    ) -> Result<MovedAtOnce, NoMoves> {
        let found = current.replaceable_legs(&ReplaceableOptions::all(search))?.found;
        let mut moves = Vec::new();
        let (mut families, mut written) = (Vec::new(), Vec::new());
        for request in requests {
            let (family, formulas) = self.family_meant(&request.along, current, &found)?;
            let parameters = request.parameters.iter().map(Share::nearest).collect();
            moves.push(LegMove { leg: request.leg, family, parameters, formulas });
            families.push((found.components[family].type_name(), current.family_name(&found, family)?));
            written.push(request.parameters.iter().map(Share::to_string).collect());
        }
        let moved = relocate(current.manipulator(), &found, &moves, LegMapTolerances::default());
        let mut relocation = match moved {
            Ok(relocation) => relocation,
            Err(RelocateError::Linalg(why)) => return Err(why.into()),
            Err(why) => return Err(NoMoves::Move { why, families: current.families_in_words(&found)? }),
        };
        let shares: Vec<Share> = requests.iter().flat_map(|request| request.parameters.clone()).collect();
        let design = current.with_legs_of(&relocation.assembled, &shares);
        if let Some(new) = &design {
            relocation.map = decide_map(current.manipulator(), new.manipulator())?;
        }
        Ok(MovedAtOnce { relocation, families, written, design })
    }

    /// The index of a family, with formulas whose parameters are counted from the joints that were named. Names mean
    /// joints of this design, at the places they have there, which families keep; joints that only `current` has can be
    /// named too.
    fn family_meant(
        &self,
        along: &NamedFamily,
        current: &Self,
        found: &Components,
    ) -> Result<(usize, Option<Parametrisation>), NoMoves> {
        let missing = |message: String| match current.families_in_words(found) {
            Ok(families) => NoMoves::NoSuchFamily { message, families },
            Err(why) => why.into(),
        };
        let text = match along {
            NamedFamily::Number(n) if (1..=found.components.len()).contains(n) => return Ok((n - 1, None)),
            NamedFamily::Number(n) => {
                let count = found.components.len();
                return Err(missing(format!("there is no family {n}, the platform has {count}")));
            }
            NamedFamily::Between(text) => text,
        };
        let [base, platform] = Body::BOTH.map(|body| self.joints_with_those_of(current, body));
        let flats = text
            .match_indices(':')
            .find_map(|(k, _)| Some((points(&text[..k], &base)?, points(&text[k + 1..], &platform)?)));
        let (a, b) = flats.ok_or_else(|| NoMoves::NotAFamily(text.clone()))?;
        match family_between(current.manipulator(), found, &a, &b)?[..] {
            [index] => Ok((index, counted_from(&found.components[index].parametrisation, &a, &b))),
            [] => Err(missing(format!("there is no family of legs `{text}`"))),
            ref several => {
                let numbers = several.iter().map(|k| k + 1).collect();
                Err(NoMoves::Ambiguous { text: text.clone(), numbers })
            }
        }
    }

    /// Names and places of the joints of one body, those of this design first.
    fn joints_with_those_of<'a>(&'a self, other: &'a Self, body: Body) -> Vec<(&'a str, Point3<f64>)> {
        let of = |d: &'a Self| d.joint_names(body).iter().zip(d.manipulator().joints(body));
        of(self).chain(of(other)).map(|(name, place)| (name.as_str(), *place)).collect()
    }

    /// The families of replaceable legs in one line, for messages.
    ///
    /// # Errors
    /// A decomposition that does not converge.
    pub fn families_in_words(&self, found: &Components) -> Result<String, LinalgError> {
        if found.components.is_empty() {
            return Ok("no leg of this platform is replaceable".into());
        }
        let mut entries = Vec::new();
        for (k, c) in found.components.iter().enumerate() {
            let legs: Vec<String> = c.support.iter().map(|leg| (leg.get() + 1).to_string()).collect();
            let name = self.family_name(found, k)?.map_or(String::new(), |name| format!(" {name}"));
            let parameters =
                if c.dimension == 1 { "1 parameter".into() } else { format!("{} parameters", c.dimension) };
            entries.push(format!(
                "{}{name} ({}, {parameters}, legs {})",
                k + 1,
                c.type_name(),
                legs.join(" ")
            ));
        }
        Ok(format!("families, with the legs they can replace: {}", entries.join("; ")))
    }

    /// A joint that may not be moved has to stay the end of a leg.
    fn keeps_fixed(&self, new: &Self) -> Result<(), NoMoves> {
        let size = self.manipulator().size();
        for body in Body::BOTH {
            let joints = self.manipulator().joints(body);
            let ends = new.manipulator().legs().map(|leg| body.of((leg.base, leg.platform)));
            for (k, fixed) in self.fixed_joints(body).into_iter().enumerate() {
                let in_use = self.manipulator().pairs().iter().any(|(a, b)| body.of((*a, *b)) == k);
                if fixed && in_use && ends.iter().all(|end| (end - joints[k]).norm() > STAYS * size) {
                    return Err(NoMoves::Fixed(self.joint_names(body)[k].clone()));
                }
            }
        }
        Ok(())
    }

    /// The new platform with a name, a description, and the leg lengths of this design's pose.
    fn finished(&self, mut new: Self, report: &MovesReport) -> Self {
        let direct = &report.chain.direct;
        new.name = format!("{}, legs moved", self.name);
        new.description = Some(if report.is_regular() {
            format!(
                "Equivalent to \"{}\" by equipod {} (legs moved {}): det A = {}",
                self.name,
                env!("CARGO_PKG_VERSION"),
                if report.together { "together" } else { "one after another" },
                direct.determinant
            )
        } else {
            format!("Singular: made from \"{}\" by moves with det A = 0", self.name)
        });
        let lengths = self.lengths.and_then(|l| direct.closest.apply(&l.squared()).ok());
        new.lengths = lengths.map(|s| s.lengths());
        new
    }
}

/// The places of joints joined by hyphens; names may contain hyphens themselves.
fn points(text: &str, joints: &[(&str, Point3<f64>)]) -> Option<Vec<Point3<f64>>> {
    for (name, place) in joints {
        let Some(rest) = text.strip_prefix(name) else { continue };
        if rest.is_empty() {
            return Some(vec![*place]);
        }
        if let Some(mut more) = rest.strip_prefix('-').and_then(|r| points(r, joints)) {
            more.insert(0, *place);
            return Some(more);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moves_in_one_word_and_in_three() {
        let read = |text: &str| text.parse::<LegMoveRequest>();
        let (first, second) = (read("1:3:0.25").unwrap(), read("6:P1:P4-P5:-1/2,2").unwrap());
        let numbers = |m: &LegMoveRequest| m.parameters.iter().map(Share::nearest).collect::<Vec<_>>();
        assert_eq!((&first.along, numbers(&first)), (&NamedFamily::Number(3), vec![0.25]));
        assert_eq!((second.leg.get(), &second.along), (5, &NamedFamily::Between("P1:P4-P5".into())));
        assert_eq!(numbers(&second), [-0.5, 2.0]);
        assert_eq!(LegMoveRequest::of("1", "3", "0.25").unwrap(), first);
        for bad in ["1:0.25", "x:1:0.2", "7:1:0.2", "0:1:0.2", "1:2:", "1:2:nan", "1"] {
            assert!(read(bad).is_err(), "{bad}");
        }
    }
}
