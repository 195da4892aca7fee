//! The proof that a design is architecturally singular or regular.

use super::{BoundWord, Claim, ProofFile};
use ask::equivalents::Original;
use ask::{CheckReport, Design};
use fk::Theorem;
use platform::manipulator::{AlgebraicVector, ExactLegs};
use synthesis::ExactRelation;
use synthesis::singularity::RankBound;

/// Greatest number of isolated poses of an octahedral design.
const OCTAHEDRAL: usize = 16;

impl ProofFile {
    /// The proof of an answer of `check`.
    #[must_use]
    pub fn check(report: &CheckReport) -> Self {
        let mut proof = Self::of("check");
        let (design, found) = (&report.design, &report.verdict.architecture);
        let m = design.manipulator();
        let statement = "whether the design is architecturally singular";
        if let Some((k, legs)) = proof.design((&design.name, &design.units), m, statement) {
            proof.claim("leg-rank", Claim::LegRank { design: k, rank: found.leg_rank });
            proof.dependencies((k, &legs));
            let pose = (&found.jacobian.witness).into();
            if found.jacobian.rank == 6 {
                proof.regular_pose("regular".into(), (k, &legs), &pose, true);
            } else if let RankBound::Lattice { .. } = found.jacobian.bound {
                proof.dependent_lines(k, found);
            } else {
                let rank = found.jacobian.rank;
                proof.claim("generic-rank", Claim::GenericRank { design: k, rank, pose: (&pose).into() });
            }
            proof.pose_bound(design, (k, &legs), report.pose_bound);
        }
        if let Some(near) = &report.verdict.meant {
            proof.leave_out(near.words(&design.units), "a nearest design is found by a search");
        }
        if report.singular_home.is_some() {
            proof.leave_out("the home pose is singular", "it is decided by a separate test");
        }
        proof.leave_out(
            "the number of poses",
            "it is counted modulo random primes, with a probability of error",
        );
        proof.leave_out(
            "the distance to singular designs",
            "its bounds come from a search and from many poses",
        );
        proof
    }

    /// The bound of a theorem as a claim; its name if the checker tests the hypotheses.
    pub(super) fn pose_bound(
        &mut self,
        design: &Design,
        (k, legs): (usize, &ExactLegs),
        theorem: Theorem,
    ) -> Option<String> {
        let by = match theorem {
            Theorem::SixLegs => Some(BoundWord::SixLegs),
            Theorem::SharedJoints { .. } => Some(BoundWord::SharedJoints),
            Theorem::Octahedral if shares_all_joints(legs) => Some(BoundWord::SharedJoints),
            Theorem::FiveOnALine | Theorem::FourOnALine => Some(BoundWord::JointsOnALine),
            Theorem::AffineHexagons => Some(BoundWord::AffineHexagons),
            // butterflies count more than once, which the checker does not know
            Theorem::PointsAtInfinity { butterflies: 0, .. } => Some(BoundWord::PointsAtInfinity),
            _ => None,
        };
        let (id, poses) = (format!("bound-{}", k + 1), theorem.bound());
        if let Some(by) = by {
            self.claim(&id, Claim::PoseBound { design: k, poses, by });
            return Some(id);
        }
        if poses == OCTAHEDRAL && self.octahedral_bound(design, (k, legs), &id).is_some() {
            return Some(id);
        }
        let statement = format!("at most {poses} isolated poses");
        self.leave_out(statement, "the checker does not test the hypotheses of this theorem");
        None
    }

    /// The bound of a design made from an octahedral one by offsets along the sides of its triangles: that of the
    /// octahedral design, by the leg map.
    fn octahedral_bound(&mut self, design: &Design, (k, legs): (usize, &ExactLegs), id: &str) -> Option<()> {
        let original = Original::of(design)?;
        let (name, m) = (&original.design.name, original.design.manipulator());
        let of_original = ExactLegs::of(m)?;
        let ExactRelation::Equivalent(map) = ExactRelation::of(&of_original, legs) else { return None };
        let (from, _) = self.design((name, &original.design.units), m, "a bound on the poses")?;
        let (leg_map, bound) = (format!("leg-map-{}", from + 1), format!("bound-{}", from + 1));
        self.leg_map(&leg_map, (from, k), &map);
        let by = BoundWord::SharedJoints;
        self.claim(&bound, Claim::PoseBound { design: from, poses: OCTAHEDRAL, by });
        self.claim(id, Claim::EquivalentBound { design: k, poses: OCTAHEDRAL, leg_map, bound });
        Some(())
    }
}

/// Whether every joint carries two legs.
fn shares_all_joints(legs: &ExactLegs) -> bool {
    let shared = |ends: &[AlgebraicVector]| ends.iter().all(|x| ends.iter().filter(|y| x == *y).count() == 2);
    shared(&legs.base) && shared(&legs.platform)
}
