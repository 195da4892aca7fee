//! All configurations of random designs.

use nalgebra::Point3;

use super::*;
use crate::distance::plans;
use crate::num::Rng;
use crate::topology::catalogue;

pub(super) fn design(legs: [(usize, usize); 6], seed: u64) -> Manipulator {
    let rng = &mut Rng::new(seed);
    let mut joints = |n: usize| -> Vec<Point3<f64>> {
        (0..n).map(|_| Point3::from([(); 3].map(|()| rng.uniform(-1.0, 1.0)))).collect()
    };
    let count = |end: fn(&(usize, usize)) -> usize| 1 + legs.iter().map(end).max().unwrap();
    Manipulator::try_new(joints(count(|l| l.0)), joints(count(|l| l.1)), legs).unwrap()
}

fn residual(m: &Manipulator, s: &[Complex64], pose: &ComplexPose) -> f64 {
    m.legs().iter().zip(s).map(|(leg, s)| (pose.squared_length(leg) - s).norm()).fold(0.0, f64::max)
}

#[test]
fn every_topology_has_as_many_configurations_as_poses() {
    let rng = &mut Rng::new(11);
    for n in catalogue().into_iter().filter(|n| [22, 31, 34].contains(&n.number())) {
        let t = n.topology();
        let m = design(t.legs(), n.number() as u64);
        let Ok(list) = plans(&m, 1) else { continue };
        for (k, s) in list.iter().take(6).enumerate() {
            let closure = s.closures.first().copied();
            let Some(e) = Evaluator::new(&m, s, &[], closure) else {
                println!("{} plan {k}: no shape", n.id());
                continue;
            };
            let squares: Vec<Complex64> = (0..6).map(|_| Complex64::from(rng.uniform(1.0, 3.0))).collect();
            let c = e.configurations(&squares, 1.0);
            let good = c.found.iter().filter(|f| residual(&m, &squares, &f.pose) < 1e-9).count();
            println!(
                "{} plan {k}: {:?} expected {} found {} good {good} lost {}",
                n.id(),
                e.shape(),
                e.shape().expected(),
                c.found.len(),
                c.lost
            );
        }
    }
}
