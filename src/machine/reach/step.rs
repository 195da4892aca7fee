//! Steps of a path over which no margin can reach zero.
//!
//! `v` and `w` are the velocities of the path, `o` is the pivot, and a leg has `c = R (b - o)`, `q = R o + p - a` and
//! the line `d = c + q`:
//!
//! ```text
//! |d'| <= V = |v| + |w x c|,   |d''| <= A = |w| |w x c|,
//! ```
//!
//! both constant along the path, since `c` turns about `w`. Seen from the platform the line is `b + R^T q`, hence
//! `V = |v| + |w x q|` and `A = |w| |w x q| + 2 |w| |v|`, where `|w x q|` grows by at most `|w| |v|` in a unit of `t`.
//! With `u = d / |d|`:
//!
//! ```text
//! -A <= |d|'' <= A + V^2 / |d|,   |u''| <= A / |d| + 3 V^2 / |d|^2.
//! ```
//!
//! A margin `f` with `f'' >= -K` stays non-negative up to the first root of `f + f' t - K t^2 / 2`.

use nalgebra::Vector3;

use super::{Reach, StraightPath};
use crate::requirements::{CrankClearances, HingeAngle, Limit, Term, TermKind};
use platform::geom::Pose;
use platform::manipulator::{Body, Leg};

/// The steps of a leg are so short that it keeps this share of its length.
const KEPT: f64 = 0.75;

/// Speed and acceleration of the line of a leg, in the frame of one of its ends.
#[derive(Debug, Clone, Copy)]
struct LineMotion {
    velocity: Vector3<f64>,
    /// Bounds over the step.
    speed: f64,
    acceleration: f64,
    /// Greatest length of a step.
    cap: f64,
}

/// A leg at a place of the path.
struct LegPlace {
    /// `R b`.
    arm: Vector3<f64>,
    /// `|w x R b|`.
    arm_speed: f64,
    /// Unit vector along the leg.
    u: Vector3<f64>,
    length: f64,
    in_base: LineMotion,
    in_platform: LineMotion,
}

impl LegPlace {
    fn of(leg: &Leg, path: &StraightPath, pose: &Pose) -> Self {
        let (v, w) = (&path.velocity, &path.turn);
        let origin_arm = pose.rotation * leg.platform.coords;
        let pivot = pose.rotation * path.pivot;
        let arm = origin_arm - pivot;
        let q = pose.position + pivot - leg.base.coords;
        let line = arm + q;
        let length = line.norm();
        let cap = |speed: f64| if speed > 0.0 { (1.0 - KEPT) * length / speed } else { f64::INFINITY };
        let turned = w.cross(&arm);
        let speed = v.norm() + turned.norm();
        let in_base = LineMotion {
            velocity: v + turned,
            speed,
            acceleration: w.norm() * turned.norm(),
            cap: cap(speed),
        };
        let turned = w.cross(&q);
        let both = w.norm() * v.norm();
        // with both velocities the speed grows by at most this much within the first cap
        let first = cap(v.norm() + turned.norm());
        let grown = if both > 0.0 && first.is_finite() { both * first } else { 0.0 };
        let speed = v.norm() + turned.norm() + grown;
        let in_platform = LineMotion {
            velocity: v - turned,
            speed,
            acceleration: w.norm() * (turned.norm() + grown) + 2.0 * both,
            cap: cap(speed).min(first),
        };
        Self {
            arm: origin_arm,
            arm_speed: w.cross(&origin_arm).norm(),
            u: line / length,
            length,
            in_base,
            in_platform,
        }
    }

    /// The step that the angle between leg and an axis (base frame) allows, up to a limit.
    fn cone_angle(&self, motion: &LineMotion, axis: &Vector3<f64>, limit_deg: f64) -> f64 {
        if limit_deg >= 180.0 {
            return f64::INFINITY;
        }
        let across = motion.velocity - self.u * self.u.dot(&motion.velocity);
        let short = KEPT * self.length;
        let margin = self.u.dot(axis) - limit_deg.to_radians().cos();
        let bend = motion.acceleration / short + 3.0 * (motion.speed / short).powi(2);
        root(margin, across.dot(axis) / self.length, bend).min(motion.cap)
    }
}

/// First root of `f + f' t - k t^2 / 2`; a negative `f` comes from rounding.
fn root(f: f64, rate: f64, k: f64) -> f64 {
    let f = f.max(0.0);
    let discriminant = (rate * rate + 2.0 * k * f).sqrt();
    match () {
        () if rate < 0.0 => 2.0 * f / (discriminant - rate),
        () if k > 0.0 => (rate + discriminant) / k,
        () => f64::INFINITY,
    }
}

/// Time until a margin with this rate reaches zero.
fn lasts(margin: f64, rate: f64) -> f64 {
    if rate > 0.0 { margin.max(0.0) / rate } else { f64::INFINITY }
}

/// A step over which the margin of a crank stays positive, if its platform joint moves at most at `speed`.
///
/// While the rod closes, `|d| <= r + l`, `||d|^2 - r^2 - l^2| <= 2 r l` and `|d.n| <= l`, hence
/// `|(s^2)'| <= 2 l V (2 + l / r)`; and `|q'| <= V l / (r s)`. When the rod ceases to close, its own margins end the
/// path.
fn crank_step(crank: &CrankClearances, kind: TermKind, margin: f64, speed: f64) -> f64 {
    let rate = 2.0 * crank.rod * speed * (2.0 + crank.rod / crank.length);
    match kind {
        TermKind::CrankTransmission => lasts(crank.above_least, rate),
        TermKind::TipAngle => lasts(crank.lean, speed),
        // s keeps half of its value
        _ => {
            let turning = 2.0 * speed * crank.rod / (crank.length * crank.square.max(0.0).sqrt());
            lasts(margin.to_radians(), turning).min(lasts(0.75 * crank.square, rate))
        }
    }
}

/// The greatest speed of a platform joint on a path.
pub(super) fn fastest(path: &StraightPath, legs: &[Leg; 6]) -> f64 {
    let arm = |leg: &Leg| path.start.rotation * (leg.platform.coords - path.pivot);
    let turned = |leg: &Leg| path.turn.cross(&arm(leg)).norm();
    path.velocity.norm() + legs.iter().map(turned).fold(0.0, f64::max)
}

impl Reach<'_> {
    /// A step from a pose of the path over which no margin with a bounded rate reaches zero. Infinite if only forces,
    /// stiffness and the sign of `det J` remain.
    pub(super) fn safe_step(&self, path: &StraightPath, pose: &Pose, margins: &[(Limit, f64)]) -> f64 {
        let places: [LegPlace; 6] = std::array::from_fn(|i| LegPlace::of(&self.legs[i], path, pose));
        let steps = margins.iter().map(|(limit, margin)| match limit {
            Limit::Term(term) => self.step_of(*term, *margin, &places, pose),
            Limit::Singular => f64::INFINITY,
        });
        let least = steps.fold(f64::INFINITY, f64::min);
        if least.is_nan() { 0.0 } else { least }
    }

    fn step_of(&self, term: Term, margin: f64, places: &[LegPlace; 6], pose: &Pose) -> f64 {
        let hardware = &self.required.hardware;
        let leg = &places[term.first];
        let base = &leg.in_base;
        match term.kind {
            TermKind::MinLegLength => root(margin, leg.u.dot(&base.velocity), base.acceleration),
            TermKind::MaxLegLength => {
                let bend = base.acceleration + base.speed.powi(2) / (KEPT * leg.length);
                root(margin, -leg.u.dot(&base.velocity), bend).min(base.cap)
            }
            TermKind::BaseConeAngle => hardware.base_cone_angle.map_or(f64::INFINITY, |s| {
                leg.cone_angle(base, &self.terms.axes()[0][term.first], s.limits_deg[term.first])
            }),
            TermKind::PlatformConeAngle => hardware.platform_cone_angle.map_or(f64::INFINITY, |s| {
                let axis = pose.rotation * self.terms.axes()[1][term.first];
                leg.cone_angle(&leg.in_platform, &axis, s.limits_deg[term.first])
            }),
            kind if kind.hinge().is_some() => {
                let Some((body, angle)) = kind.hinge() else { return f64::INFINITY };
                let (end, motion) = body.of(((0, &leg.in_base), (1, &leg.in_platform)));
                let (Some(hinge), Some(limit)) =
                    (self.terms.hinge(end, term.first), hardware.angle_limit_deg(kind, term.first))
                else {
                    return f64::INFINITY;
                };
                let first = if end == 0 { hinge.first } else { pose.rotation * hinge.first };
                match angle {
                    // the second angle is within its limit if both ends of the first axis are 90 degrees minus the
                    // limit or more from the leg
                    HingeAngle::Second => {
                        let side = |axis: Vector3<f64>| leg.cone_angle(motion, &axis, 90.0 + limit);
                        side(first).min(side(-first))
                    }
                    HingeAngle::First => {
                        let away = leg.length * leg.u.cross(&first).norm();
                        let cap = if motion.speed > 0.0 {
                            (1.0 - KEPT) * away / motion.speed
                        } else {
                            f64::INFINITY
                        };
                        lasts(margin.to_radians(), motion.speed / (KEPT * away)).min(cap).min(motion.cap)
                    }
                }
            }
            TermKind::LegClearance => lasts(margin, base.speed + places[term.second].in_base.speed),
            TermKind::KeepOut => match self.required.keep_outs[term.second].fixed_to {
                Body::Base => lasts(margin, base.speed),
                Body::Platform => lasts(margin, leg.in_platform.speed).min(leg.in_platform.cap),
            },
            TermKind::PlateClearance if term.second == 0 => lasts(margin, base.speed),
            TermKind::PlateClearance | TermKind::PayloadClearance => {
                lasts(margin, leg.in_platform.speed).min(leg.in_platform.cap)
            }
            TermKind::LegSpeed => {
                // |(c x u)'| <= |c'| + |c| |u'|
                let arm = leg.arm.norm();
                let rate = leg.arm_speed + base.speed * arm / (KEPT * leg.length);
                let degrees = self.required.platform_speed.map_or(0.0, |s| s.angular_deg);
                lasts(margin, rate * degrees.to_radians()).min(base.cap)
            }
            TermKind::MachineEnvelope if term.second == 1 => lasts(margin, base.speed),
            // distances from points of the circle of the crank: the joint of the platform is no faster than V
            TermKind::MinRodLength | TermKind::MaxRodLength => lasts(margin, base.speed),
            TermKind::CrankTransmission | TermKind::CrankAngle | TermKind::TipAngle => self
                .terms
                .crank_clearances(term.first, pose)
                .map_or(f64::INFINITY, |crank| crank_step(&crank, term.kind, margin, base.speed)),
            // forces and stiffness have no bound near singular poses; the others do not depend on the pose
            _ => f64::INFINITY,
        }
    }
}
