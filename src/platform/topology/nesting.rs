//! The square roots of a trilateration sequence, and their dependencies.

use super::sequence::{JointIndex, Sequence};

/// The dependencies of a number computed along a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Dependence {
    /// Bit `t`: the square root of unoriented step `t`.
    pub radicals: u8,
    /// Bit `v`: the squared length of virtual leg `v`, directly or within one of those square roots.
    pub virtual_legs: u8,
}

impl Dependence {
    fn or(self, other: Self) -> Self {
        Self {
            radicals: self.radicals | other.radicals,
            virtual_legs: self.virtual_legs | other.virtual_legs,
        }
    }

    /// Whether it depends on neither square roots nor virtual legs: it follows from the design and the legs.
    #[must_use]
    pub fn is_none(self) -> bool {
        self == Self::default()
    }
}

/// The dependencies of an unoriented step on the earlier ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct StepDependence {
    /// Dependencies of the Cayley-Menger determinant `A` of its base triangle.
    pub base: Dependence,
    /// Dependencies of its radicand: the base triangle and the three distances to the joint.
    pub radicand: Dependence,
    /// Sides of the base triangle that are not known distances.
    pub computed_sides: u8,
}

impl StepDependence {
    /// Whether the square root is the same for all lengths of the virtual legs.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.radicand.virtual_legs == 0
    }
}

/// A measure of the nesting of a sequence's closures; less is better.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Nesting {
    /// Square roots that depend on a virtual leg.
    pub varying_radicals: usize,
    /// Constant ones after a varying one.
    pub late_constants: usize,
    /// Sides of base triangles computed from coordinates.
    pub computed_sides: usize,
    /// Radicands that depend on earlier square roots, counted with multiplicity.
    pub nested_radicals: usize,
    /// Closures that need joints placed by rigid steps.
    pub rigid_closures: usize,
}

impl Sequence {
    /// One record for each unoriented step, for legs between the joints of the sequence.
    #[must_use]
    pub fn dependence(&self, legs: &[(usize, usize); 6]) -> Vec<StepDependence> {
        let mut at: Vec<(JointIndex, Dependence)> = Vec::new();
        let mut out = Vec::new();
        for (t, step) in self.unoriented().enumerate() {
            let of = |j: JointIndex| at.iter().find(|p| p.0 == j).map_or(Dependence::default(), |p| p.1);
            let virtual_leg = |x: JointIndex, y: JointIndex| {
                let found = x.across(y).and_then(|p| self.virtual_legs.iter().position(|v| *v == p));
                found.map(|v| Dependence { radicals: 0, virtual_legs: 1 << v })
            };
            let [i, j, k] = step.from;
            let mut base = Dependence::default();
            let mut computed_sides = 0;
            for (x, y) in [(i, j), (i, k), (j, k)] {
                if x.same_body(y) || x.across(y).is_some_and(|p| legs.contains(&p)) {
                    continue;
                }
                let known = virtual_leg(x, y);
                computed_sides += u8::from(known.is_none());
                base = base.or(known.unwrap_or_else(|| of(x).or(of(y))));
            }
            let sides = step.from.iter().filter_map(|f| virtual_leg(*f, step.place));
            let radicand = sides.fold(base, Dependence::or);
            out.push(StepDependence { base, radicand, computed_sides });
            let points = step.from.iter().fold(radicand, |d, f| d.or(of(*f)));
            at.push((step.place, Dependence { radicals: points.radicals | 1 << t, ..points }));
        }
        out
    }
}

impl Nesting {
    /// The nesting of a sequence for `legs`.
    #[must_use]
    pub fn of(legs: &[(usize, usize); 6], s: &Sequence) -> Self {
        let steps = s.dependence(legs);
        let rigid = |j: &JointIndex| {
            s.steps.iter().any(|step| step.rigid && step.place == *j && !step.place.same_body(s.start[0]))
        };
        let first = steps.iter().position(|d| !d.is_constant()).unwrap_or(steps.len());
        Self {
            late_constants: steps[first..].iter().filter(|d| d.is_constant()).count(),
            varying_radicals: steps.iter().filter(|d| !d.is_constant()).count(),
            computed_sides: steps.iter().map(|d| usize::from(d.computed_sides)).sum(),
            nested_radicals: steps.iter().map(|d| d.radicand.radicals.count_ones() as usize).sum(),
            rigid_closures: s.closures.iter().filter(|c| c.iter().any(rigid)).count(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::topology::{Topology, catalogue};

    #[test]
    fn a_joint_of_three_legs_gives_a_constant_radical() {
        for n in catalogue() {
            let t = n.topology();
            let s = t.trilateration();
            let steps = s.dependence(&t.legs());
            let varying = steps.iter().filter(|d| !d.is_constant()).count();
            let (least, most) = match (s.virtual_legs.len(), t.is_decoupled()) {
                (0, _) => (0, 0),
                // one closure with the tetrahedra of the other steps having known edges
                (1, true) => (1, 2),
                (1, false) => (1, 3),
                _ => (3, 3),
            };
            assert!((least..=most).contains(&varying), "{}: {s:?}", n.id());
            assert_eq!(steps[0].is_constant(), t.is_decoupled() || s.virtual_legs.is_empty(), "{}", n.id());
        }
    }

    #[test]
    fn the_octahedral_platform_needs_no_nested_radical() {
        let t = Topology::of_legs([0, 1, 1, 2, 2, 0], [0, 0, 1, 1, 2, 2]);
        let nesting = Nesting::of(&t.legs(), &t.trilateration());
        assert_eq!((nesting.computed_sides, nesting.nested_radicals), (0, 0));
    }
}
