//! Legs as chains of rotations, simulated by separate code; round trips; cases without convergence.
#![allow(clippy::float_cmp, reason = "ideal joints give the same bits")]

use nalgebra::{Matrix6, Point3, Rotation3, Unit, Vector3, Vector6};

use super::*;
use crate::requirements::{Hardware, JointAxes, UniversalJoint};
use fk::NearSolver;
use num::Rng;
use platform::geom::Pose;
use platform::manipulator::{Body, Manipulator};

/// A leg as it is built: base, rotation about x, offset along z, rotation about y, length along z. Rotations about z
/// and y, the offset along z, and a rotation about x follow.
#[derive(Debug, Clone, Copy)]
struct SimulatedLeg {
    base: Vector3<f64>,
    frame: Rotation3<f64>,
    offsets: [f64; 2],
    /// Angles about the first and second axis of the base, length, angle about the leg, angles about the second and
    /// first axis of the platform.
    at: [f64; 6],
}

impl SimulatedLeg {
    /// Position of the platform joint, and orientation of the parts fixed to it.
    fn end(&self, at: &[f64; 6]) -> (Vector3<f64>, Rotation3<f64>) {
        let [q1, q2, length, twist, q3, q4] = *at;
        let about =
            |axis: Vector3<f64>, angle: f64| Rotation3::from_axis_angle(&Unit::new_normalize(axis), angle);
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        let mut turn = self.frame * about(x, q1);
        let mut place = self.base + turn * (z * self.offsets[0]);
        turn *= about(y, q2);
        place += turn * (z * length);
        turn *= about(z, twist);
        turn *= about(y, q3);
        place += turn * (z * self.offsets[1]);
        (place, turn * about(x, q4))
    }

    /// The state that takes the end to a position and an orientation, by Newton's method with finite differences.
    fn solved(&self, place: &Vector3<f64>, turn: &Rotation3<f64>) -> [f64; 6] {
        let error = |at: &[f64; 6]| {
            let (p, r) = self.end(at);
            // twice the sine of the remaining rotation, along its axis: zero if no rotation remains
            let w = (r * turn.inverse()).into_inner();
            let w = [w[(2, 1)] - w[(1, 2)], w[(0, 2)] - w[(2, 0)], w[(1, 0)] - w[(0, 1)]];
            Vector6::new(p.x - place.x, p.y - place.y, p.z - place.z, w[0], w[1], w[2])
        };
        let mut at = self.at;
        for _ in 0..30 {
            let here = error(&at);
            let slopes = Matrix6::from_fn(|i, k| {
                let moved = |h: f64| {
                    let mut y = at;
                    y[k] += h;
                    error(&y)[i]
                };
                (moved(1e-6) - moved(-1e-6)) / 2e-6
            });
            let step = slopes.try_inverse().expect("regular") * here;
            at = std::array::from_fn(|k| at[k] - step[k]);
        }
        assert!(error(&at).norm() < 1e-12, "the chain does not reach: {}", error(&at));
        at
    }
}

/// A machine of chains at home, and its description in a design.
struct Built {
    chains: [SimulatedLeg; 6],
    legs: CoupledLegs,
    home: Pose,
    /// Orientation of the end of each chain at home, platform frame.
    carried: [Rotation3<f64>; 6],
    lead: f64,
}

#[allow(clippy::large_types_passed_by_value, reason = "a test makes them on the spot")]
fn hardware(axes: [[Vector3<f64>; 6]; 2], offsets: [f64; 2], lead: Option<f64>) -> Hardware {
    let joint = |k: usize| UniversalJoint {
        first_axes: axes[k].map(|a| Some(Unit::new_normalize(a))),
        limits_deg: [None; 6],
        axes: JointAxes::Home,
        offset: offsets[k],
    };
    Hardware {
        base_universal: Some(joint(0)),
        platform_universal: Some(joint(1)),
        screw_lead: lead,
        ..Hardware::default()
    }
}

fn built(rng: &mut Rng, offsets: [f64; 2], lead: f64) -> Built {
    let home = Pose {
        rotation: Rotation3::new(Vector3::from_fn(|_, _| rng.uniform(-0.2, 0.2))),
        position: Vector3::new(rng.uniform(-0.3, 0.3), rng.uniform(-0.3, 0.3), 6.0),
    };
    let chains: [SimulatedLeg; 6] = std::array::from_fn(|i| {
        let around =
            |angle: f64, r: f64| Vector3::new(r * angle.cos(), r * angle.sin(), rng.uniform(-0.1, 0.1));
        let pair = (i / 2) as f64 * std::f64::consts::TAU / 3.0;
        let side = if i % 2 == 0 { -1.0 } else { 1.0 };
        let mut around = around;
        let base = around(pair + side * 0.2, 6.0);
        let given = home.position + around(pair + side * 0.85, 4.0);
        // z of the frame towards the platform joint, x where it happens to be
        let z = (given - base).normalize();
        let aside = Vector3::new(rng.normal(), rng.normal(), rng.normal());
        let x = (aside - z * aside.dot(&z)).normalize();
        let frame = Rotation3::from_basis_unchecked(&[x, z.cross(&x), z]);
        let mut small = || rng.uniform(-0.3, 0.3);
        let length = (given - base).norm() - offsets[0] - offsets[1];
        SimulatedLeg { base, frame, offsets, at: [small(), small(), length, small(), small(), small()] }
    });
    let ends = chains.map(|c| c.end(&c.at));
    let back = home.rotation.inverse();
    let platform = ends.map(|(p, _)| Point3::from(back * (p - home.position)));
    let carried = ends.map(|(_, r)| back * r);
    let axes = [chains.map(|c| c.frame * Vector3::x()), carried.map(|r| r * Vector3::x())];
    let base = chains.map(|c| Point3::from(c.base));
    let m = Manipulator::try_new(base.to_vec(), platform.to_vec(), std::array::from_fn(|i| (i, i))).unwrap();
    let legs = CoupledLegs::new(&m, &hardware(axes, offsets, Some(lead)), &home).unwrap();
    Built { chains, legs, home, carried, lead }
}

impl Built {
    fn near(&self, rng: &mut Rng, reach: f64) -> Pose {
        let mut vector = |x: f64| Vector3::from_fn(|_, _| rng.uniform(-x, x));
        Pose {
            rotation: Rotation3::new(vector(0.12 * reach)) * self.home.rotation,
            position: self.home.position + vector(reach),
        }
    }

    /// Lengths that the drives have in the simulation.
    fn simulated(&self, pose: &Pose) -> [f64; 6] {
        std::array::from_fn(|i| {
            let chain = &self.chains[i];
            let place = pose.transform(&self.legs.manipulator().legs()[i].platform).coords;
            let at = chain.solved(&place, &(pose.rotation * self.carried[i]));
            at[2] - self.lead / std::f64::consts::TAU * (at[3] - chain.at[3])
        })
    }
}

#[test]
#[ignore = "evidence"]
fn drives_are_as_long_as_those_of_simulated_chains() {
    let mut rng = Rng::new(71);
    for offsets in [[0.0, 0.0], [0.4, 0.0], [0.0, 0.3], [0.5, 0.35]] {
        for lead in [0.0, 0.7, -0.4] {
            let b = built(&mut rng, offsets, lead);
            for _ in 0..4 {
                let pose = b.near(&mut rng, 1.0);
                let (drives, simulated) = (b.legs.drives(&pose).unwrap(), b.simulated(&pose));
                let ideal = pose.lengths(b.legs.manipulator()).unwrap().get();
                let mut away: f64 = 0.0;
                for i in 0..6 {
                    assert!(
                        (drives[i] - simulated[i]).abs() < 1e-10,
                        "{offsets:?} {lead} {drives:?} {simulated:?}"
                    );
                    away = away.max((ideal[i] - simulated[i]).abs());
                }
                // the control: lengths of ideal joints differ
                assert_eq!(away > 1e-3, offsets != [0.0, 0.0] || lead != 0.0, "{offsets:?} {lead} {away}");
            }
        }
    }
}

#[test]
fn rates_are_those_of_differences() {
    let mut rng = Rng::new(72);
    let b = built(&mut rng, [0.5, 0.35], 0.9);
    let pose = b.near(&mut rng, 1.0);
    let states = b.legs.states(&pose).unwrap();
    let h = 1e-6;
    for k in 0..6 {
        let moved = |h: f64| {
            let mut v = Vector6::zeros();
            v[k] = h;
            let pose = Pose {
                rotation: Rotation3::new(Vector3::new(v[3], v[4], v[5])) * pose.rotation,
                position: pose.position + Vector3::new(v[0], v[1], v[2]),
            };
            b.legs.drives(&pose).unwrap()
        };
        let (up, down) = (moved(h), moved(-h));
        for i in 0..6 {
            let slope = (up[i] - down[i]) / (2.0 * h);
            assert!((slope - states[i].rates[k]).abs() < 1e-8, "{i} {k}: {slope} {}", states[i].rates[k]);
        }
    }
}

fn distance(a: &Pose, b: &Pose) -> (f64, f64) {
    // a cosine tells small angles from zero no better than to 1e-8
    let turned = (a.rotation.matrix() - b.rotation.matrix()).norm() / std::f64::consts::SQRT_2;
    ((a.position - b.position).norm(), turned)
}

#[test]
fn poses_come_back_and_their_error_is_within_the_bound_proved() {
    let mut rng = Rng::new(73);
    for (offsets, lead) in [([0.4, 0.0], 0.0), ([0.5, 0.35], 0.0), ([0.0, 0.0], 0.6), ([0.5, 0.35], -0.8)] {
        let b = built(&mut rng, offsets, lead);
        let size = b.legs.manipulator().size();
        for _ in 0..3 {
            let pose = b.near(&mut rng, 0.6);
            let drives = b.legs.drives(&pose).unwrap();
            let mut tracker = CoupledTracker::new(b.legs.clone(), b.home);
            let found = tracker.step(&drives);
            let Some(reached) = found.pose() else { panic!("{offsets:?} {lead} {found:?}") };
            let (away, turned) = distance(reached, &pose);
            assert!(away < 1e-12 * size && turned < 1e-12, "{away} {turned} {found:?}");
            let CoupledStatus::Proved(bound) = found.status else { panic!("{found:?}") };
            // the pose itself was rounded
            assert!(
                away <= bound.position + 1e-14 * size && turned <= bound.angle + 1e-14,
                "{away} {turned} {bound:?}"
            );
            assert!(bound.position < 1e-9 * size && bound.contraction < 0.1, "{bound:?}");
            assert!(found.factor < 0.7, "{found:?}");
            assert_eq!(distance(&tracker.pose(), found.pose().unwrap()).0, 0.0);
        }
    }
}

/// The bound of a wrong pose covers its distance from the right one.
#[test]
fn the_bound_of_a_pose_beside_the_right_one_reaches_to_it() {
    let mut rng = Rng::new(74);
    let b = built(&mut rng, [0.5, 0.35], 0.6);
    let mut proved = 0;
    for k in 1..8 {
        let pose = b.near(&mut rng, 0.5);
        let drives = b.legs.drives(&pose).unwrap();
        let off = 10f64.powi(-2 * k);
        let beside = Pose {
            rotation: Rotation3::new(Vector3::new(off, -off, 0.3 * off)) * pose.rotation,
            position: pose.position + Vector3::new(off, 0.0, -2.0 * off),
        };
        let states = b.legs.states(&beside).unwrap();
        let Some(bound) = b.legs.bound(&beside, &states, &drives) else { continue };
        let (away, turned) = distance(&beside, &pose);
        assert!(away <= bound.position + 1e-14 && turned <= bound.angle + 1e-14, "{off} {bound:?}");
        assert!(bound.position < 100.0 * away + 1e-11, "{off} {bound:?}");
        proved += 1;
    }
    assert!(proved >= 5, "{proved}");
}

#[test]
fn ideal_joints_give_the_ideal_answers_bit_for_bit() {
    let mut rng = Rng::new(75);
    let b = built(&mut rng, [0.0, 0.0], 0.0);
    let m = b.legs.manipulator();
    for _ in 0..5 {
        let pose = b.near(&mut rng, 0.8);
        let lengths = pose.lengths(m).unwrap();
        assert_eq!(b.legs.drives(&pose).unwrap(), lengths.get());
        let found = CoupledTracker::new(b.legs.clone(), b.home).find(&lengths.get());
        let ideal = NearSolver::new(m).solve(&lengths.squared(), &b.home);
        assert_eq!(found.pose(), ideal.tracked());
        assert_eq!((found.steps, found.factor), (1, 0.0));
    }
}

#[test]
fn what_does_not_settle_is_said() {
    let mut rng = Rng::new(76);
    let b = built(&mut rng, [0.0, 0.0], 400.0);
    let pose = b.near(&mut rng, 0.3);
    let drives = b.legs.drives(&pose).unwrap();
    let mut tracker = CoupledTracker::new(b.legs.clone(), b.home);
    let found = tracker.step(&drives);
    assert!(!found.status.is_reached() && found.pose().is_none(), "{found:?}");
    assert!(
        matches!(found.status, CoupledStatus::NotContracting | CoupledStatus::NotTracked),
        "a lead of fifty leg lengths a turn: {found:?}"
    );
    assert_eq!(tracker.pose(), b.home, "it stays where it was");
    // a leg along a first axis, and a lead without universal joints
    let z = [Vector3::z(); 6];
    let m = b.legs.manipulator();
    let leg = m.legs()[0];
    let above = Pose {
        rotation: Rotation3::identity(),
        position: leg.base.coords - leg.platform.coords + Vector3::new(0.0, 0.0, 8.0),
    };
    let along = CoupledLegs::new(m, &hardware([z, z], [0.3, 0.2], None), &above).unwrap();
    assert_eq!(along.drives(&above), Err(NoDriveLength::AlongFirstAxis { leg: 1, body: Body::Base }));
    let balls = Hardware { screw_lead: Some(1.0), ..Hardware::default() };
    assert_eq!(CoupledLegs::new(m, &balls, &b.home).unwrap_err(), NoDriveLength::LeadOfBalls);
}

#[test]
fn motions_and_scales_change_nothing() {
    let mut rng = Rng::new(77);
    let b = built(&mut rng, [0.5, 0.35], 0.7);
    let pose = b.near(&mut rng, 0.8);
    let drives = b.legs.drives(&pose).unwrap();
    let (turn, shift) = (Rotation3::new(Vector3::new(0.4, -1.0, 2.0)), Vector3::new(3.0, -7.0, 2.0));
    let m = b.legs.manipulator();
    let of = |scale: f64, turn: Rotation3<f64>, shift: Vector3<f64>| {
        let base = m.legs().map(|l| Point3::from(turn * (l.base.coords * scale) + shift)).to_vec();
        let platform = m.legs().map(|l| l.platform * scale).to_vec();
        let moved = Manipulator::try_new(base, platform, std::array::from_fn(|i| (i, i))).unwrap();
        let axes = [b.legs.axes[0].map(|a| turn * a), b.legs.axes[1]];
        let placed =
            |p: &Pose| Pose { rotation: turn * p.rotation, position: turn * (p.position * scale) + shift };
        let hardware = hardware(axes, [0.5 * scale, 0.35 * scale], Some(0.7 * scale));
        CoupledLegs::new(&moved, &hardware, &placed(&b.home)).unwrap().drives(&placed(&pose)).unwrap()
    };
    for (scale, turn, shift) in [(1.0, turn, shift), (1000.0, Rotation3::identity(), Vector3::zeros())] {
        let other = of(scale, turn, shift);
        for i in 0..6 {
            assert!((other[i] - scale * drives[i]).abs() < 1e-13 * scale * 20.0, "{other:?} {drives:?}");
        }
    }
}

/// The correction of `LinuxCNC`'s genhexkins for intersecting axes, written after its source. It takes the sine of the
/// angle between the second platform axis and the part of the base axis across the leg.
#[test]
fn corrections_of_screws_are_those_of_genhexkins_less_their_values_at_home() {
    let mut rng = Rng::new(78);
    let b = built(&mut rng, [0.0, 0.0], 0.9);
    let genhexkins = |pose: &Pose, i: usize| {
        let leg = b.legs.manipulator().legs()[i];
        let u = (pose.transform(&leg.platform) - leg.base).normalize();
        let nb3 = u.cross(&b.legs.axes[0][i].cross(&u)).normalize();
        let na2 = (pose.rotation * b.legs.axes[1][i]).cross(&u).normalize();
        // its lead has the other sign
        -b.lead * nb3.dot(&na2).asin() / std::f64::consts::TAU
    };
    for _ in 0..4 {
        let pose = b.near(&mut rng, 0.6);
        let states = b.legs.states(&pose).unwrap();
        for (i, state) in states.iter().enumerate() {
            let meant = genhexkins(&pose, i) - genhexkins(&b.home, i);
            assert!((state.correction - meant).abs() < 1e-12, "{i}: {} {meant}", state.correction);
        }
    }
}
