//! Six exact legs as a design, with the proof that it is equivalent to another one.

use nalgebra::Point3;

use super::sample::{ExactLeg, Sample, rounded};
use crate::manipulator::{InvalidManipulator, Manipulator};
use crate::num::exact::Rational;
use crate::synthesis::components::exact::{Exact, rank};

/// A design with rational joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    base: Vec<Exact>,
    platform: Vec<Exact>,
    legs: [(usize, usize); 6],
}

impl Arrangement {
    /// The design of a sample's own joints.
    pub(super) fn of_sample(sample: &Sample) -> Option<Self> {
        Self::of_legs(&sample.legs())
    }

    /// Ends at one place become one joint; `None` unless there are six legs.
    pub(super) fn of_legs(legs: &[ExactLeg]) -> Option<Self> {
        let (mut base, mut platform) = (Vec::new(), Vec::new());
        let pairs: Vec<(usize, usize)> =
            legs.iter().map(|l| (place(&mut base, &l.base), place(&mut platform, &l.platform))).collect();
        Some(Self { base, platform, legs: pairs.try_into().ok()? })
    }

    /// Base and platform joint of each leg.
    #[must_use]
    pub fn legs(&self) -> [(usize, usize); 6] {
        self.legs
    }

    /// Joints that carry two or more legs.
    #[must_use]
    pub fn shared_joints(&self) -> usize {
        let shared = |count: usize, end: fn(&(usize, usize)) -> usize| {
            (0..count).filter(|k| self.legs.iter().filter(|l| end(l) == *k).count() > 1).count()
        };
        shared(self.base.len(), |l| l.0) + shared(self.platform.len(), |l| l.1)
    }

    /// Twelve less the number of joints.
    #[must_use]
    pub fn merged_ends(&self) -> usize {
        12 - self.base.len() - self.platform.len()
    }

    /// Coordinates of the base joints as fractions.
    #[must_use]
    pub fn base(&self) -> Vec<[String; 3]> {
        self.base.iter().map(fractions).collect()
    }

    /// Coordinates of the platform joints as fractions.
    #[must_use]
    pub fn platform(&self) -> Vec<[String; 3]> {
        self.platform.iter().map(fractions).collect()
    }

    /// The design with its coordinates rounded to doubles.
    ///
    /// # Errors
    /// [`InvalidManipulator`] when the joints make no manipulator.
    pub fn manipulator(&self) -> Result<Manipulator, InvalidManipulator> {
        let points = |list: &[Exact]| list.iter().map(rounded).collect::<Vec<Point3<f64>>>();
        Manipulator::try_new(points(&self.base), points(&self.platform), self.legs)
    }

    /// Whether the leg vectors of the two designs span the same six-dimensional space, decided in rational arithmetic.
    #[must_use]
    pub fn is_equivalent_to(&self, other: &Self) -> bool {
        let (own, others) = (self.vectors(), other.vectors());
        rank(&own) == 6 && rank(&others) == 6 && rank(&[own, others].concat()) == 6
    }

    fn vectors(&self) -> Vec<Exact> {
        let leg = |l: &(usize, usize)| ExactLeg {
            base: self.base[l.0].clone(),
            platform: self.platform[l.1].clone(),
        };
        self.legs.iter().map(|l| leg(l).vector()).collect()
    }
}

fn place(joints: &mut Vec<Exact>, point: &Exact) -> usize {
    joints.iter().position(|p| p == point).unwrap_or_else(|| {
        joints.push(point.clone());
        joints.len() - 1
    })
}

fn fractions(x: &Exact) -> [String; 3] {
    std::array::from_fn(|k| x.get(k + 1).map_or(String::new(), Rational::to_string))
}
