//! The proof of a relation between two designs.

use super::{Claim, ProofFile, text, texts};
use ask::Design;
use platform::manipulator::{ExactLegs, Manipulator};
use synthesis::singularity::{Architecture, RankBound};
use synthesis::{ExactMap, ExactRelation, LegMapOutcome, Relation};

impl ProofFile {
    /// The proof for designs A and B, whose joints are `second` in the frames of A. `map` is the decision.
    #[must_use]
    pub fn verify(a: &Design, (b, second): (&Design, &Manipulator), map: &LegMapOutcome) -> Self {
        let mut proof = Self::of("verify");
        let Some(relation) = map.relation.decided().filter(|_| map.level.is_proved()) else {
            proof.leave_out("the relation of the two designs", map.explanation());
            return proof;
        };
        let statement = "the relation of the two designs";
        let first = proof.design((&a.name, &a.units), a.manipulator(), statement);
        let other = proof.design((&b.name, &b.units), second, statement);
        let (Some((from, legs_a)), Some((to, legs_b))) = (first, other) else { return proof };
        proof.relation(relation, (from, &legs_a, a.manipulator()), (to, &legs_b, second));
        proof.leave_out(
            "agreement of the poses at sampled lengths",
            "it is evidence beside the proof: option `--proof` of `fk` proves the poses for given lengths",
        );
        proof
    }

    fn relation(&mut self, relation: Relation, a: Numbered<'_>, b: Numbered<'_>) {
        let ((from, legs_a, _), (to, legs_b, _)) = (a, b);
        let exact = ExactRelation::of(legs_a, legs_b);
        if let Some(map) = exact.map() {
            self.leg_map("leg-map", (from, to), map);
        }
        match exact {
            ExactRelation::Unrelated(off) if relation == Relation::Unrelated => {
                self.claim(
                    "no-leg-map",
                    Claim::NoLegMap { from, to, legs: off.iter().map(|i| i + 1).collect() },
                );
            }
            ExactRelation::Singular { .. } => {
                for (design, legs, _) in [a, b] {
                    self.dependencies((design, legs));
                }
            }
            _ => {}
        }
        if relation == Relation::Equivalent {
            self.architecture(a);
        }
        if relation == Relation::Singular {
            for (design, _, m) in [a, b] {
                self.dependent_lines(design, &Architecture::of(m));
            }
        }
        if self.is_empty() {
            let reason = "the second design was moved by numbers that are known only to a tolerance";
            self.leave_out("the relation of the two designs", reason);
        }
    }

    pub(super) fn leg_map(&mut self, id: &str, (from, to): (usize, usize), map: &ExactMap) {
        let rows = map.a.iter().map(texts).collect();
        let (c, det) = (texts(&map.c), text(&map.determinant));
        self.claim(id, Claim::LegMap { from, to, a: rows, c, det });
    }

    /// A pose that proves a design regular.
    fn architecture(&mut self, (design, legs, m): Numbered<'_>) {
        let pose = (&Architecture::of(m).jacobian.witness).into();
        self.regular_pose(format!("regular-{}", design + 1), (design, legs), &pose, true);
    }

    /// The claim about a design whose leg lines are dependent at every pose, although its leg vectors are not.
    pub(super) fn dependent_lines(&mut self, design: usize, found: &Architecture) {
        if found.jacobian.rank < 6 && matches!(found.jacobian.bound, RankBound::Lattice { .. }) {
            self.claim(format!("dependent-lines-{}", design + 1), Claim::DependentLines { design });
        }
    }
}

/// A design by its place in the file.
type Numbered<'a> = (usize, &'a ExactLegs, &'a Manipulator);
