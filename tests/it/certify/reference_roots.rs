use equipod::methods::solve::certify::{
    CentrePrecision, Distinctness, ProvedReality, RootRelation, distinct, relation,
};

use super::support::{encloses, pose, problem, problems};

#[test]
fn every_reference_root_rounded_to_double_is_certified_and_enclosed() {
    for p in problems() {
        for (i, (c, root)) in p.certificates().iter().zip(&p.roots).enumerate() {
            assert!(encloses(c, root), "{} root {i}: {c:?}", p.name);
            assert!(c.contraction() < 1.0 && c.uniqueness_radius() > c.radius());
            assert!(c.radius() < 1e-8, "{} root {i}: radius {:e}", p.name, c.radius());
            assert!(!encloses(c, &p.roots[(i + 1) % p.roots.len()]), "the enclosure says something");
        }
    }
}

#[test]
fn reality_is_proved_for_every_reference_root() {
    for p in problems() {
        for (i, (c, real)) in p.certificates().iter().zip(&p.real).enumerate() {
            let expected = if *real { ProvedReality::Real } else { ProvedReality::NonReal };
            assert_eq!(c.reality(), expected, "{} root {i}", p.name);
        }
    }
}

#[test]
fn the_roots_are_pairwise_distinct_close_pairs_included() {
    for p in problems() {
        let mut certificates = p.certificates();
        assert_eq!(distinct(&certificates), Distinctness::AllDistinct, "{}", p.name);
        certificates.push(certificates[3]);
        let twice = Distinctness::NotAll(vec![(3, p.roots.len(), RootRelation::Same)]);
        assert_eq!(distinct(&certificates), twice, "{}", p.name);
    }
}

#[test]
fn one_root_from_two_slightly_different_poses_is_recognised_as_one() {
    let p = problem("general66_00");
    let certifier = p.certifier();
    for root in &p.roots {
        let mut other = pose(root);
        other.position *= num_complex::Complex64::new(1.0 + 1e-12, 0.0);
        let (a, b) = (certifier.certify(&pose(root)), certifier.certify(&other));
        assert_eq!(relation(a.certificate().unwrap(), b.certificate().unwrap()), RootRelation::Same);
    }
}

#[test]
fn refinement_gives_back_the_digits_that_rounding_took() {
    for p in problems() {
        let certifier = p.certifier();
        // s is the interval of exact squares, refined roots belong to its centre
        let width = p.s.iter().map(|s| (s.hi() - s.lo()) / s.hi()).fold(0.0, f64::max);
        assert!(width < 1e-15);
        for root in &p.roots {
            let refined = certifier.refine(&pose(root)).unwrap();
            assert!(refined.last_step < 1e-24, "{}: {:e}", p.name, refined.last_step);
            let again = certifier.refine(&refined.pose()).unwrap();
            let scale: f64 = root.iter().map(|z| z.hi().norm()).fold(1.0, f64::max);
            for (a, b) in refined.position.iter().zip(&again.position) {
                assert!((*a - *b).hi().norm() < 1e-24 * scale, "{}: {a:?} {b:?}", p.name);
            }
        }
    }
}

#[test]
fn doubles_suffice_for_well_separated_roots() {
    let p = problem("dietmaier40");
    assert!(p.certificates().iter().all(|c| c.precision() == CentrePrecision::Double));
}
