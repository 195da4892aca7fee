//! The proof of a relation between two designs.

use std::borrow::Cow;

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
        let known = |k: usize| map.architectures.as_ref().map(|both| &both[k]);
        proof.relation(
            relation,
            (from, &legs_a, Asked { m: a.manipulator(), known: known(0) }),
            (to, &legs_b, Asked { m: second, known: known(1) }),
        );
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
            for (design, _, asked) in [a, b] {
                self.dependent_lines(design, &asked.architecture());
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
    fn architecture(&mut self, (design, legs, asked): Numbered<'_>) {
        let pose = (&asked.architecture().jacobian.witness).into();
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
type Numbered<'a> = (usize, &'a ExactLegs, Asked<'a>);

/// A platform with the decision about it that the answer has.
#[derive(Debug, Clone, Copy)]
struct Asked<'a> {
    m: &'a Manipulator,
    known: Option<&'a Architecture>,
}

impl<'a> Asked<'a> {
    /// The decision; it is made here only if dependent leg vectors decided the answer without it.
    fn architecture(self) -> Cow<'a, Architecture> {
        self.known.map_or_else(|| Cow::Owned(Architecture::of(self.m)), Cow::Borrowed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ask::design::parse;
    use files::design::Format;
    use synthesis::singularity::RationalPose;

    /// The pose of the answer stands in the proof, and not one that is searched for again.
    #[test]
    fn a_proof_takes_the_decision_about_a_design_from_the_answer() {
        let read = |text: &str| parse(text, Format::Toml).unwrap().0;
        let a = read(include_str!("../../../../designs/rbt-octahedral.toml"));
        let b = read(include_str!("../../../../designs/rbt-griffis-duffy.toml"));
        let mut map = ask::leg_map(&a, &b).unwrap();
        let known = map.architectures.as_mut().unwrap();
        assert_eq!(known[1], Architecture::of(b.manipulator()));
        known[0].jacobian.witness = RationalPose { quaternion: [97, 1, 2, 3], steps: [5, 6, 701], unit: -6 };
        let proof = ProofFile::verify(&a, (&b, b.manipulator()), &map);
        let text = serde_json::to_string(&proof).unwrap();
        assert!(text.contains("701/64") && text.contains("\"97\""), "{text}");
    }
}
