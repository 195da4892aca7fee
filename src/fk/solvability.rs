//! In which steps the poses of six legs can be found, where legs meet in a joint or end on a line.

use super::distance::plans;
use super::pentapod::{LineClass, line_class};
use platform::manipulator::{Body, ExactLegs, Manipulator, flat_dimension};
use platform::pentapod::{Pentapod, RationalPoint, joints_of_legs, lines_without_one_leg};

/// A part of the platform that some of the legs place, before the others place the rest.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(tag = "part", rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum PlacedFirst {
    /// Line of five leg ends; the sixth turns the platform about it, in two ways.
    Line {
        /// The body.
        body: Body,
        /// Legs, from 1.
        legs: Vec<usize>,
        /// Polynomial for it; null when the legs are dependent, or joints are no fractions.
        class: Option<LineClass>,
        /// Whether the five other ends are coplanar: a line-plane component.
        other_ends_in_plane: bool,
    },
    /// Joint of three legs; the others turn the platform about it.
    Joint {
        /// The body.
        body: Body,
        /// Legs, from 1.
        legs: Vec<usize>,
    },
}

/// The ways to find the poses in steps.
#[derive(Debug, Clone, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema))]
pub struct Solvability {
    /// Whether quadratic equations give all poses.
    pub quadratic: bool,
    /// Parts that can be placed first; empty where the legs do not decouple in these ways.
    pub placed_first: Vec<PlacedFirst>,
}

impl Solvability {
    /// One sentence.
    #[must_use]
    pub fn sentence(&self) -> String {
        let chain = if self.quadratic {
            "quadratically solvable: a chain of quadratic equations gives all poses"
        } else {
            ""
        };
        let parts = self.placed_first.iter().map(|part| match part {
            PlacedFirst::Line { body, legs, class, other_ends_in_plane } => {
                let by = class.map_or("an equation", |class| match class {
                    LineClass::Quadratic => "a quadratic equation",
                    LineClass::Cubic => "a cubic equation",
                    LineClass::Quartic => "a quartic equation",
                    LineClass::Octic => "an equation of degree eight",
                });
                let component = if *other_ends_in_plane { " (a line-plane component)" } else { "" };
                format!("legs {} place a line of the {body} by {by}{component}, the other leg turns the platform about it", listed(legs))
            }
            PlacedFirst::Joint { body, legs } => format!(
                "legs {} place a joint of the {body}, the others turn the platform about it",
                listed(legs)
            ),
        });
        let all: Vec<String> =
            Some(chain.to_owned()).filter(|c| !c.is_empty()).into_iter().chain(parts).collect();
        if all.is_empty() {
            "no five legs end on a line and no three meet in a joint: all legs are solved together".into()
        } else {
            all.join("; ")
        }
    }
}

fn listed(legs: &[usize]) -> String {
    let legs: Vec<String> = legs.iter().map(ToString::to_string).collect();
    legs.join(", ")
}

/// The steps in which the poses of `m` can be found. Lines and joints are those of the exact joints. For joints that
/// are known between bounds only, the pattern of shared joints decides alone.
#[must_use]
pub fn solvability(m: &Manipulator) -> Solvability {
    let mut placed_first = Vec::new();
    let known = ExactLegs::of(m);
    if let Some(exact) = known.clone().or_else(|| ExactLegs::of_doubles(&m.legs())) {
        for body in [Body::Platform, Body::Base] {
            let ends = body.of((&exact.base, &exact.platform));
            let others = body.other().of((&exact.base, &exact.platform));
            let dimension = |legs: &[usize]| flat_dimension(legs.iter().map(|leg| &ends[*leg]));
            let counted = |legs: &[usize]| legs.iter().map(|leg| leg + 1).collect::<Vec<_>>();
            for five in lines_without_one_leg(6, dimension) {
                let class = known.as_ref().and_then(|known| {
                    let of = |body: Body| -> Option<[RationalPoint; 5]> {
                        let points = five.iter().map(|leg| known.fractions(body, *leg));
                        points.collect::<Option<Vec<_>>>()?.try_into().ok()
                    };
                    let pentapod = Pentapod { base: of(Body::Base)?, platform: of(Body::Platform)? };
                    line_class(&pentapod.linear_on(body)?)
                });
                let other_ends_in_plane = flat_dimension(five.iter().map(|leg| &others[*leg])) == 2;
                let legs = counted(&five);
                placed_first.push(PlacedFirst::Line { body, legs, class, other_ends_in_plane });
            }
            let joints = joints_of_legs(6, 3, dimension);
            placed_first.extend(joints.iter().map(|legs| PlacedFirst::Joint { body, legs: counted(legs) }));
        }
    }
    let by_line = placed_first
        .iter()
        .any(|part| matches!(part, PlacedFirst::Line { class: Some(LineClass::Quadratic), .. }));
    Solvability { quadratic: by_line || plans(m, 0).is_ok(), placed_first }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point3;
    use platform::manipulator::Leg;

    const BASE: [[f64; 3]; 6] =
        [[0., 0., 0.], [2., 0., 0.], [1., 3., 0.], [-1., 2., 0.], [3., 2., 0.], [2., -2., 3.]];

    fn platform_on_line(marks: [f64; 5]) -> Manipulator {
        let ends = marks.map(|x| [x, 0., 0.]);
        let all = [ends[0], ends[1], ends[2], ends[3], ends[4], [2., 3., 1.]];
        let legs =
            std::array::from_fn(|i| Leg { base: Point3::from(BASE[i]), platform: Point3::from(all[i]) });
        Manipulator::from_legs(legs).unwrap()
    }

    #[test]
    fn five_legs_to_a_line_place_it_first() {
        let quartic = solvability(&platform_on_line([0., 3., 1., 4., -2.]));
        let line = |class| PlacedFirst::Line {
            body: Body::Platform,
            legs: vec![1, 2, 3, 4, 5],
            class: Some(class),
            other_ends_in_plane: true,
        };
        assert_eq!((quartic.quadratic, quartic.placed_first), (false, vec![line(LineClass::Quartic)]));
        let quadratic = solvability(&platform_on_line([1., 5., 0., -3., 5.]));
        assert_eq!((quadratic.quadratic, quadratic.placed_first), (true, vec![line(LineClass::Quadratic)]));
    }

    #[test]
    fn legs_without_lines_and_joints_are_solved_together() {
        let mut rng = num::Rng::new(2);
        let mut point = || Point3::from([0; 3].map(|_| rng.uniform(-1.0, 1.0)));
        let m = Manipulator::from_legs([0; 6].map(|_| Leg { base: point(), platform: point() })).unwrap();
        assert_eq!(solvability(&m), Solvability { quadratic: false, placed_first: Vec::new() });
    }
}
