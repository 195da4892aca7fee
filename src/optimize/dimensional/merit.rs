//! The objectives as gains, each in its unit and to be maximised, with their models for the subproblems.
//!
//! Units are 1 for condition and singular values, the size of the design for lengths, and the stiffness of a leg. They
//! are the frequency of the payload on a single leg, and the greatest load for forces.

use nalgebra::{Matrix6, Vector3, Vector4, Vector6};

use super::leg_gaps::Gap;
use super::leg_lines::{HeldLegs, HeldPose, LegLines};
use super::problem::DimensionalProblem;
use super::pull::{Gradient, PoseGradient};
use super::shape::JointEnds;
use super::stiffness::{self, RayleighQuotient};
use super::terms::{RequirementTerms, joint_pull};
use crate::climb::CLUSTER;
use machine::requirements::{LegsWeight, Load, Objective, VibratingMasses};
use num::linalg::svd;
use num::small::{bounded_svd, singular_values};
use platform::manipulator::Body;
use synthesis::Normalisation;

/// Gain of the leg force at a singular pose, in units of the loads.
const SINGULAR_GAIN: f64 = -1e6;

/// `y <= value + f (s_6 - sigma_6) - h (s_1 - sigma_1)` with the singular values `s` of the linearised matrix.
#[derive(Debug, Clone)]
pub(crate) struct Spectral {
    pub value: f64,
    pub f: f64,
    pub h: f64,
    pub low: Cluster,
    pub high: Cluster,
}

/// An extreme singular value with those close to it: their values, and the gradients of the blocks `(kk, ko, oo)`.
#[derive(Debug, Clone)]
pub(super) struct Cluster {
    pub sigma: f64,
    pub own: PoseGradient,
    pub others: Vec<(f64, PoseGradient, PoseGradient)>,
}

/// An upper bound of an objective.
#[derive(Debug, Clone)]
pub(crate) enum MeritPiece {
    /// `y <= value + gradient`.
    Linear(f64, PoseGradient),
    /// The bound by the least and the greatest singular value.
    Spectral(Box<Spectral>),
    /// Length of a leg, a bound on both sides for the stroke.
    Length(usize, f64, PoseGradient),
}

/// The data for the evaluation of the objectives.
#[derive(Debug, Clone)]
pub(crate) struct Merit<'a> {
    loads: &'a [Load],
    leg_body: Option<machine::requirements::LegBody>,
    length: f64,
    size: f64,
    force_unit: f64,
    vibrating: Option<VibratingMasses>,
    normalisation: Normalisation,
    /// Poses of the mean.
    pub sample: Vec<HeldPose>,
}

impl<'a> Merit<'a> {
    pub(super) fn new(p: &'a DimensionalProblem, sample: Vec<HeldPose>) -> Self {
        let of_legs = |w: &LegsWeight| 6.0 * (w.rod.norm() + w.moment.norm() / p.characteristic_length);
        let of = |l: &Load| {
            let own = l.force.norm() + l.torque.norm() / p.characteristic_length;
            l.legs.as_ref().map_or(own, |weight| own + of_legs(weight))
        };
        let force_unit = p.requirements.loads.iter().map(of).fold(0.0, f64::max);
        Self {
            loads: &p.requirements.loads,
            leg_body: p.requirements.hardware.leg_body,
            length: p.characteristic_length,
            size: p.manipulator.size(),
            force_unit: if force_unit > 0.0 { force_unit } else { 1.0 },
            vibrating: p.requirements.vibrating,
            normalisation: Normalisation::of(&p.manipulator),
            sample,
        }
    }

    /// Factor from a gain to the value of the objective, sign included.
    pub(super) fn unit(&self, o: Objective, stiffness: f64) -> f64 {
        match o {
            Objective::LegForce => -self.force_unit,
            Objective::Stroke => -self.size,
            Objective::JointSpacing | Objective::LegClearance => self.size,
            Objective::Stiffness => stiffness,
            Objective::NaturalFrequency => self.vibrating.map_or(1.0, |masses| masses.on_one_leg()),
            _ => 1.0,
        }
    }

    /// `true` if the objective is a worst case over the poses.
    pub(crate) fn is_over_poses(o: Objective) -> bool {
        !matches!(
            o,
            Objective::MeanConditioning
                | Objective::JointSpacing
                | Objective::SingularityDistance
                | Objective::Stroke
        )
    }

    /// The slowest motions, if masses are known.
    fn slowest<P: Gradient>(&self, l: &LegLines) -> Option<Vec<RayleighQuotient<P>>> {
        stiffness::frequencies(l, self.size, self.vibrating.as_ref()?)
    }

    /// Unit of angular frequencies.
    fn omega(&self) -> f64 {
        self.vibrating.map_or(1.0, |masses| masses.on_one_leg() * std::f64::consts::TAU)
    }

    /// The least gain at one pose, for objectives over poses.
    pub(super) fn at_pose(&self, o: Objective, terms: &RequirementTerms<'_>, l: &LegLines) -> f64 {
        match o {
            Objective::WorstConditioning => {
                platform::manipulator::inverse_condition(&l.jacobian(self.length))
            }
            Objective::SmallestSingularValue | Objective::Stiffness => {
                let j = l.jacobian(self.length);
                let s = singular_values(&j).map_or(0.0, |s| s.min());
                if o == Objective::Stiffness { s * s } else { s }
            }
            Objective::NaturalFrequency => {
                let least = |all: Vec<RayleighQuotient<()>>| {
                    all.iter().map(|q| q.value).fold(f64::INFINITY, f64::min)
                };
                let square = self.slowest(l).map_or(0.0, least);
                square.max(0.0).sqrt() / self.omega()
            }
            Objective::LegForce => {
                let lines = HeldLegs::new::<()>(l, self.size);
                let worst = |load| match lines.hold(load) {
                    Some(f) => -f.values.amax() / self.force_unit,
                    None => SINGULAR_GAIN,
                };
                self.loads.iter().map(worst).fold(f64::INFINITY, f64::min)
            }
            _ => {
                let mut least = f64::INFINITY;
                let Some(body) = self.leg_body else { return least };
                for (i, j) in terms.separate_legs() {
                    let see = &mut |gap: Gap<()>| least = f64::min(least, gap.value / self.size);
                    l.leg_gaps(&body, i, j, see);
                }
                least
            }
        }
    }

    /// The pieces of an objective over poses at one pose.
    pub(crate) fn pieces_at(
        &self,
        o: Objective,
        terms: &RequirementTerms<'_>,
        l: &LegLines,
        see: &mut dyn FnMut(MeritPiece),
    ) {
        match o {
            Objective::WorstConditioning | Objective::SmallestSingularValue | Objective::Stiffness => {
                if let Some(s) = self.spectral(o, l) {
                    see(MeritPiece::Spectral(Box::new(s)));
                }
            }
            Objective::NaturalFrequency => {
                for q in self.slowest::<PoseGradient>(l).into_iter().flatten().filter(|q| q.value > 0.0) {
                    let omega = q.value.sqrt();
                    let factor = 0.5 / (omega * self.omega());
                    see(MeritPiece::Linear(omega / self.omega(), q.pull.scaled(factor)));
                }
            }
            Objective::LegForce => {
                let lines = HeldLegs::new::<PoseGradient>(l, self.size);
                for forces in self.loads.iter().map(|load| lines.hold(load)) {
                    for i in 0..6 {
                        let piece = match &forces {
                            Some(f) => {
                                let (value, pull): (f64, PoseGradient) = f.of(i);
                                let factor = -value.signum() / self.force_unit;
                                MeritPiece::Linear(value * factor, pull.scaled(factor))
                            }
                            None => MeritPiece::Linear(SINGULAR_GAIN, PoseGradient::none()),
                        };
                        see(piece);
                    }
                }
            }
            Objective::LegClearance => {
                let Some(body) = self.leg_body else { return };
                for (i, j) in terms.separate_legs() {
                    l.leg_gaps(&body, i, j, &mut |gap: Gap<PoseGradient>| {
                        see(MeritPiece::Linear(gap.value / self.size, gap.pull.scaled(1.0 / self.size)));
                    });
                }
            }
            Objective::Stroke => {
                for i in 0..6 {
                    let mut pull = PoseGradient::none();
                    pull.line(i, l.direction[i] / self.size);
                    see(MeritPiece::Length(i, l.length[i] / self.size, pull));
                }
            }
            _ => {}
        }
    }

    /// Pieces without a pose.
    pub(crate) fn pieces_fixed(
        &self,
        o: Objective,
        terms: &RequirementTerms<'_>,
        ends: &JointEnds,
        see: &mut dyn FnMut(MeritPiece),
    ) {
        match o {
            Objective::JointSpacing => {
                for body in Body::BOTH {
                    for (i, j) in terms.separate_joints(body) {
                        let at = body.of((&ends.base, &ends.platform));
                        let d = at[j] - at[i];
                        let n = d.try_normalize(0.0).unwrap_or_else(Vector3::x) / self.size;
                        see(MeritPiece::Linear(d.norm() / self.size, joint_pull(body, i, j, &n)));
                    }
                }
            }
            Objective::SingularityDistance => {
                if let Some((value, pull)) = self.leg_vectors(ends) {
                    see(MeritPiece::Linear(value, pull));
                }
            }
            _ => {}
        }
    }

    /// Smallest singular value of the six leg vectors and its gradient.
    fn leg_vectors(&self, ends: &JointEnds) -> Option<(f64, PoseGradient)> {
        let n = &self.normalisation;
        let one = |v: Vector3<f64>| Vector4::new(1.0, v.x, v.y, v.z);
        let a = ends.base.map(|p| one((p - n.base_centre.coords) / n.base_unit));
        let b = ends.platform.map(|p| one((p - n.platform_centre.coords) / n.platform_unit));
        let rows: Vec<Vec<f64>> =
            (0..6).map(|i| (0..16).map(|k| a[i][k / 4] * b[i][k % 4]).collect()).collect();
        let d = svd(&rows).ok()?;
        let w = nalgebra::Matrix4::from_fn(|p, q| d.v[4 * p + q][5]);
        let mut pull = PoseGradient::none();
        for i in 0..6 {
            let (on_a, on_b) = (w * b[i] * d.u[i][5], w.transpose() * a[i] * d.u[i][5]);
            pull.base[i] += Vector3::new(on_a[1], on_a[2], on_a[3]) / n.base_unit;
            pull.arm[i] += Vector3::new(on_b[1], on_b[2], on_b[3]) / n.platform_unit;
        }
        Some((d.s[5], pull))
    }

    /// Inverse condition number at a pose and its gradient.
    pub(super) fn conditioning(&self, l: &LegLines) -> Option<(f64, PoseGradient)> {
        let (u, s, v) = decomposed(&l.jacobian(self.length))?;
        let g = s[5] / s[0];
        let mut pull = PoseGradient::none();
        for i in 0..6 {
            let on_row = (v.column(5) * u[(i, 5)] - v.column(0) * (g * u[(i, 0)])) / s[0];
            l.pull_row(&mut pull, i, self.length, &on_row);
        }
        Some((g, pull))
    }

    fn spectral(&self, o: Objective, l: &LegLines) -> Option<Spectral> {
        let (u, s, v) = decomposed(&l.jacobian(self.length))?;
        let block = |a: usize, b: usize| {
            let mut pull = PoseGradient::none();
            for i in 0..6 {
                let on_row = (v.column(b) * u[(i, a)] + v.column(a) * u[(i, b)]) * 0.5;
                l.pull_row(&mut pull, i, self.length, &on_row);
            }
            pull
        };
        let cluster = |k: usize, others: [usize; 2]| Cluster {
            sigma: s[k],
            own: block(k, k),
            others: others
                .into_iter()
                .filter(|&o| s[o].max(s[k]) < CLUSTER * s[o].min(s[k]))
                .map(|o| (s[o], block(k, o), block(o, o)))
                .collect(),
        };
        let high = if o == Objective::WorstConditioning {
            cluster(0, [1, 2])
        } else {
            Cluster { sigma: s[0], own: PoseGradient::none(), others: Vec::new() }
        };
        let (value, f, h) = match o {
            Objective::WorstConditioning => (s[5] / s[0], 1.0 / s[0], s[5] / (s[0] * s[0])),
            Objective::Stiffness => (s[5] * s[5], 2.0 * s[5], 0.0),
            _ => (s[5], 1.0, 0.0),
        };
        Some(Spectral { value, f, h, low: cluster(5, [4, 3]), high })
    }
}

fn decomposed(j: &Matrix6<f64>) -> Option<(Matrix6<f64>, Vector6<f64>, Matrix6<f64>)> {
    let d = bounded_svd(j)?;
    Some((d.u?, d.singular_values, d.v_t?.transpose()))
}

impl Spectral {
    /// The gradient of the piece; clusters have none here.
    pub(super) fn pull(&self) -> PoseGradient {
        let mut pull = self.low.own.scaled(self.f);
        pull.add(&self.high.own, -self.h);
        pull
    }
}
