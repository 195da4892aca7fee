//! The proof of the poses for given lengths.

use super::{Claim, ComplexText, DiscsOfPose, DiscsText, ProofFile, RootClaim, of_double, text, texts};
use ask::Design;
use fk::solve::certify::{Certificate, Certifier, PoseEnclosure, ProvedReality, RootCertificate};
use fk::{Completeness, FkRoot, FkSolutions, Theorem};
use num::algebraic::Algebraic;
use num::ball::Disc;
use num::exact::{rational, relations};
use num_complex::Complex64;
use platform::manipulator::{ExactLegs, LegLengths};

/// A design and a set of lengths by their places in the file.
type Problem = (usize, usize);

impl ProofFile {
    /// The proof of the poses of a design for lengths between its joint centres.
    #[must_use]
    pub fn fk(design: &Design, lengths: &LegLengths, found: &FkSolutions) -> Self {
        let mut proof = Self::of("fk");
        let m = design.manipulator();
        let Some((k, legs)) = proof.design((&design.name, &design.units), m, "the poses") else {
            return proof;
        };
        if !lengths.squared().is_exact() {
            proof.leave_out("the poses", "the squares of the lengths leave the range of doubles");
            return proof;
        }
        proof.lengths.push(lengths.get().map(of_double));
        let problem = (k, 0);
        let certifier = Certifier::new(m, &lengths.squared()).ok();
        let mut names = Vec::new();
        for (i, root) in found.roots.iter().enumerate() {
            let id = format!("pose-{}", i + 1);
            match study_certificate(root, certifier.as_ref()) {
                Some(certificate) => {
                    proof.claim(&id, Claim::Root(Box::new(RootClaim::new(problem, &certificate))));
                    names.push((id, certificate.reality()));
                }
                None => {
                    proof
                        .leave_out(id, "the pose has no certificate of one simple root in Study coordinates");
                }
            }
        }
        let all = names.len() == found.roots.len();
        match &found.completeness {
            Completeness::Proved { theorem: Theorem::ContradictoryLengths } => {
                proof.no_pose(problem, &legs, lengths);
            }
            Completeness::Proved { theorem } if all && theorem.bound() == names.len() => {
                proof.complete(design, (problem, &legs), *theorem, names);
            }
            other => {
                proof.distinct(names);
                proof.leave_out("whether these are all poses", other.to_string());
            }
        }
        proof
    }

    fn complete(
        &mut self,
        design: &Design,
        ((place, lengths), legs): (Problem, &ExactLegs),
        theorem: Theorem,
        names: Vec<(String, ProvedReality)>,
    ) {
        let decided = names.iter().all(|(_, reality)| *reality != ProvedReality::Undecided);
        let bound = if decided { self.pose_bound(design, (place, legs), theorem) } else { None };
        let Some(bound) = bound else {
            self.distinct(names);
            let reason = "the checker does not test the hypotheses of the bound, or the reality of a pose is undecided";
            self.leave_out("there are no other poses", reason);
            return;
        };
        let real = names.iter().filter(|(_, reality)| *reality == ProvedReality::Real).count();
        let roots = names.into_iter().map(|(id, _)| id).collect();
        self.claim("complete", Claim::Complete { design: place, lengths, roots, bound, real });
    }

    fn distinct(&mut self, names: Vec<(String, ProvedReality)>) {
        if names.len() > 1 {
            let roots = names.into_iter().map(|(id, _)| id).collect();
            self.claim("distinct", Claim::Distinct { roots });
        }
    }

    /// A relation of the leg vectors that the squared lengths contradict.
    fn no_pose(&mut self, (design, place): Problem, legs: &ExactLegs, lengths: &LegLengths) {
        let squares = lengths.get().map(|l| rational(l).map(|l| Algebraic::from(&l * &l)));
        let misses = |c: &Vec<Algebraic>| {
            let terms = c.iter().zip(&squares).enumerate();
            let sum: Algebraic =
                terms.filter_map(|(i, (c, s))| Some(c * &(s.as_ref()? - &legs.squares(i)))).sum();
            !sum.is_zero()
        };
        match relations(&legs.vectors).into_iter().find(misses) {
            Some(c) => {
                let coefficients = texts(&c);
                self.claim("no-pose", Claim::NoPose { design, lengths: place, coefficients });
            }
            None => {
                self.leave_out("there is no pose", "the legs have no relation that the lengths contradict");
            }
        }
    }
}

/// The certificate of a simple root in Study coordinates: its own, or one about the same pose.
fn study_certificate(root: &FkRoot, certifier: Option<&Certifier>) -> Option<Certificate> {
    match root.certificate.as_ref()? {
        RootCertificate::Study(certificate) => Some(*certificate),
        RootCertificate::Octahedral(_) => certifier?.certify(&root.pose).certificate().copied(),
        RootCertificate::Cluster(_) => None,
    }
}

impl RootClaim {
    fn new((design, lengths): Problem, c: &Certificate) -> Self {
        Self {
            design,
            lengths,
            patch: c.patch(),
            unit: of_double(c.unit()),
            centre: sums(c.centre(), c.low()),
            radius: of_double(c.radius()),
            uniqueness_radius: of_double(c.uniqueness_radius()),
            reality: c.reality(),
            pose: c.enclosure().into(),
        }
    }
}

/// Sums of high and low parts.
fn sums(high: &[Complex64; 8], low: &[Complex64; 8]) -> ComplexText {
    let part = |of: fn(&Complex64) -> f64| {
        let exact = |z| rational(of(z)).unwrap_or_default();
        high.iter().zip(low).map(|(high, low)| text(&(exact(high) + exact(low)))).collect()
    };
    ComplexText { re: part(|z| z.re), im: part(|z| z.im) }
}

impl From<&PoseEnclosure> for DiscsOfPose {
    fn from(e: &PoseEnclosure) -> Self {
        let discs = |list: Vec<&Disc>| {
            let part = |of: fn(&Disc) -> f64| list.iter().map(|d| of_double(of(d))).collect();
            DiscsText {
                centre: ComplexText { re: part(|d| d.centre.re), im: part(|d| d.centre.im) },
                radius: part(|d| d.radius),
            }
        };
        Self { rotation: discs(e.rotation.iter().flatten().collect()), p: discs(e.position.iter().collect()) }
    }
}
