//! A member of a topology with small integer coordinates in exact arithmetic. Also six exact legs as a design, with the
//! proof that it is equivalent to another one.

use nalgebra::Point3;

use num::Rng;
pub(super) use num::exact::integer;
use num::exact::{ExactVector, Rational, rank, relations};
use platform::manipulator::{Body, ExactLeg, InvalidManipulator, Manipulator, flat_dimension};

/// Joints and legs of one design. Joints are homogeneous: `(1, x, y, z)`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DesignSample {
    base: Vec<ExactVector>,
    platform: Vec<ExactVector>,
    legs: [(usize, usize); 6],
}

/// The same point with the first coordinate 1; `None` at infinity.
pub(super) fn finite(x: &ExactVector) -> Option<ExactVector> {
    let first = x.first().filter(|f| **f != integer(0))?;
    Some(x.iter().map(|c| c / first).collect())
}

/// A basis of the intersection of the spans of two lists of independent vectors.
pub(super) fn meet(u: &[ExactVector], v: &[ExactVector]) -> Vec<ExactVector> {
    let rows: Vec<ExactVector> = u.iter().chain(v).cloned().collect();
    relations(&rows).iter().map(|c| weighted(u, c)).collect()
}

/// `sum_k c_k rows_k`; further coefficients are ignored.
pub(super) fn weighted(rows: &[ExactVector], c: &[Rational]) -> ExactVector {
    let mut out = vec![integer(0); rows.first().map_or(0, Vec::len)];
    for (row, c) in rows.iter().zip(c) {
        out.iter_mut().zip(row).for_each(|(o, x)| *o += c * x);
    }
    out
}

/// Both ends normalised; `None` when one is at infinity.
pub(super) fn leg_through(base: &ExactVector, platform: &ExactVector) -> Option<ExactLeg> {
    Some(ExactLeg { base: finite(base)?, platform: finite(platform)? })
}

impl DesignSample {
    /// A sample with joints from the integers `-9..=9`, and planar bodies in `z = 0`.
    pub(super) fn draw(legs: [(usize, usize); 6], planar: (bool, bool), rng: &mut Rng) -> Self {
        let mut joints = |count: usize, planar: bool| -> Vec<ExactVector> {
            let mut coordinate = || (rng.next_u64() % 19).cast_signed() - 9;
            let mut point = || {
                let (x, y, z) = (coordinate(), coordinate(), coordinate());
                [1, x, y, if planar { 0 } else { z }].map(integer).to_vec()
            };
            (0..count).map(|_| point()).collect()
        };
        let count = |of: fn(&(usize, usize)) -> usize| 1 + legs.iter().map(of).max().unwrap_or(0);
        let base = joints(count(|l| l.0), planar.0);
        let platform = joints(count(|l| l.1), planar.1);
        Self { base, platform, legs }
    }

    /// All joints of a body.
    pub(super) fn joints(&self, body: Body) -> &[ExactVector] {
        body.of((&self.base, &self.platform))
    }

    /// Some joints of a body.
    pub(super) fn points(&self, body: Body, which: &[usize]) -> Vec<ExactVector> {
        which.iter().map(|k| self.joints(body)[*k].clone()).collect()
    }

    /// Joints of the other body to which a joint has a leg, ascending.
    pub(super) fn neighbours(&self, body: Body, joint: usize) -> Vec<usize> {
        let ends = self.legs.iter().filter(|l| body.of(**l) == joint);
        let mut out: Vec<usize> = ends.map(|l| body.other().of(*l)).collect();
        out.sort_unstable();
        out
    }

    /// Dimension of the flat of all joints of a body.
    pub(super) fn dimension(&self, body: Body) -> usize {
        flat_dimension(self.joints(body))
    }

    /// The six legs.
    pub(super) fn legs(&self) -> Vec<ExactLeg> {
        let leg = |l: &(usize, usize)| ExactLeg {
            base: self.base[l.0].clone(),
            platform: self.platform[l.1].clone(),
        };
        self.legs.iter().map(leg).collect()
    }

    /// Whether the sample is general. No joints coincide, as many joints as the flat of a body allows are independent,
    /// and so are the six leg vectors.
    pub(super) fn is_general(&self, planar: (bool, bool)) -> bool {
        let vectors: Vec<ExactVector> = self.legs().iter().map(ExactLeg::vector).collect();
        let general = |body: Body, planar: bool| {
            let joints = self.joints(body);
            let size = joints.len().min(if planar { 3 } else { 4 });
            subsets(joints.len()).filter(|s| s.len() == size).all(|s| rank(&self.points(body, &s)) == size)
        };
        rank(&vectors) == 6 && general(Body::Base, planar.0) && general(Body::Platform, planar.1)
    }
}

/// The nearest doubles of a finite point.
fn rounded(x: &ExactVector) -> Point3<f64> {
    let near = num::exact::approximate;
    Point3::new(near(&x[1]), near(&x[2]), near(&x[3]))
}

/// All nonempty subsets of `0..count`.
pub(super) fn subsets(count: usize) -> impl Iterator<Item = Vec<usize>> {
    (1..1usize << count).map(move |set| (0..count).filter(|k| set >> k & 1 == 1).collect())
}

/// A design with rational joints.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrangement {
    base: Vec<ExactVector>,
    platform: Vec<ExactVector>,
    legs: [(usize, usize); 6],
}

impl Arrangement {
    /// The design of a sample with its original joints.
    pub(super) fn of_sample(sample: &DesignSample) -> Option<Self> {
        Self::of_legs(&sample.legs())
    }

    /// Coincident ends become one joint; `None` unless there are six legs.
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

    /// Twelve minus the number of joints.
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
    /// [`InvalidManipulator`] if the joints form no manipulator.
    pub fn manipulator(&self) -> Result<Manipulator, InvalidManipulator> {
        let points = |list: &[ExactVector]| list.iter().map(rounded).collect::<Vec<Point3<f64>>>();
        Manipulator::try_new(points(&self.base), points(&self.platform), self.legs)
    }

    /// Whether the leg vectors of the two designs span the same six-dimensional space, decided in rational arithmetic.
    #[must_use]
    pub fn is_equivalent_to(&self, other: &Self) -> bool {
        let (own, others) = (self.vectors(), other.vectors());
        rank(&own) == 6 && rank(&others) == 6 && rank(&[own, others].concat()) == 6
    }

    fn vectors(&self) -> Vec<ExactVector> {
        let leg = |l: &(usize, usize)| ExactLeg {
            base: self.base[l.0].clone(),
            platform: self.platform[l.1].clone(),
        };
        self.legs.iter().map(|l| leg(l).vector()).collect()
    }
}

fn place(joints: &mut Vec<ExactVector>, point: &ExactVector) -> usize {
    joints.iter().position(|p| p == point).unwrap_or_else(|| {
        joints.push(point.clone());
        joints.len() - 1
    })
}

fn fractions(x: &ExactVector) -> [String; 3] {
    std::array::from_fn(|k| x.get(k + 1).map_or(String::new(), Rational::to_string))
}
