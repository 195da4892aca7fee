//! Two and three virtual legs: one length is hidden, the others follow from it.
//!
//! A design with two virtual legs has a joint that two legs share; it moves on a circle. With the joint at a point of
//! the circle three of the other four legs leave finitely many poses, and the last leg closes. The product over these
//! poses of the errors of its squared length is a rational function on the circle with known poles. Its 40 (24) zeros
//! are the poses of the platform.
//!
//! Without a shared joint, the 6-6, a virtual leg that shares a joint takes the place of a leg. The same product over
//! the 40 poses of that platform is a polynomial of degree 40 in the squared virtual length. Theory, proofs and costs:
//! `docs/theory/hidden-lengths.md`.

mod chebyshev;
mod general;
mod legs;
mod roots;
mod rotations;

use self::general::{GeneralRoles, general_poses};
use self::legs::{HiddenLeg, LegRoles, scaled, unscaled};
use self::roots::closure_zeros;
use platform::geom::ComplexPose;
use platform::manipulator::{Manipulator, SquaredLegLengths};

/// A pose at a zero is also kept when one step on the circle leads to it that is shorter than this.
const CLOSE: f64 = 1e-6;

/// The ways to hide one length of a design; every way finds all poses unless it degenerates.
#[derive(Debug, Clone)]
pub struct HiddenLengths<'a> {
    manipulator: &'a Manipulator,
    ways: Ways,
}

#[derive(Debug, Clone)]
enum Ways {
    Two(Vec<LegRoles>),
    Three(Vec<GeneralRoles>),
}

/// Candidate poses of one way.
#[derive(Debug, Clone)]
pub struct HiddenPoses {
    /// Poses as found, not refined; `None` where a zero has none.
    pub poses: Vec<Option<ComplexPose>>,
    /// Zeros that settled, of as many as the degree says.
    pub settled: usize,
    /// Evaluations of closure conditions, inner ones included.
    pub evaluations: usize,
    /// Platforms with two virtual legs that were solved for a design with three.
    pub platforms: usize,
    /// Largest coefficient beyond the degree over the largest of all, by interpolation: rounding when the degree is
    /// right.
    pub excess: f64,
}

impl<'a> HiddenLengths<'a> {
    /// `None` for designs that need less than two virtual legs.
    #[must_use]
    pub fn of(m: &'a Manipulator) -> Option<Self> {
        let pairs = m.pairs();
        let distinct = |ends: [usize; 6]| (0..6).all(|i| ends[..i].iter().all(|j| *j != ends[i]));
        let general = distinct(pairs.map(|p| p.0)) && distinct(pairs.map(|p| p.1));
        let ways = if general { Ways::Three(GeneralRoles::all()) } else { Ways::Two(LegRoles::of(&pairs)) };
        let hidden = Self { manipulator: m, ways };
        (hidden.ways() > 0).then_some(hidden)
    }

    /// Number of virtual legs: two or three.
    #[must_use]
    pub fn virtual_legs(&self) -> usize {
        match self.ways {
            Ways::Two(_) => 2,
            Ways::Three(_) => 3,
        }
    }

    /// Number of ways.
    #[must_use]
    pub fn ways(&self) -> usize {
        match &self.ways {
            Ways::Two(list) => list.len(),
            Ways::Three(list) => list.len(),
        }
    }

    /// All poses by one way, below [`ways`](Self::ways); `None` when it degenerates or there is no such way.
    #[must_use]
    pub fn poses(&self, s: &SquaredLegLengths, way: usize) -> Option<HiddenPoses> {
        let legs = scaled(self.manipulator, s);
        let mut found = match &self.ways {
            Ways::Two(list) => two(&legs, list.get(way)?),
            Ways::Three(list) => Some(general_poses(&legs, list.get(way)?)),
        }?;
        for pose in found.poses.iter_mut().flatten() {
            *pose = unscaled(pose, self.manipulator);
        }
        Some(found)
    }
}

fn two(legs: &[HiddenLeg; 6], roles: &LegRoles) -> Option<HiddenPoses> {
    let zeros = closure_zeros(&roles.closure(legs)?)?;
    let mut poses = Vec::with_capacity(zeros.found.len());
    for zero in &zeros.found {
        let Some(near) = &zero.evidence else {
            poses.push(None);
            continue;
        };
        let best = near.best();
        let chosen = (0..near.placed.len()).filter(|k| Some(*k) == best || near.step(*k) < CLOSE);
        poses.extend(chosen.map(|k| Some(roles.pose(legs, &near.joint, &near.placed[k]))));
    }
    let settled = zeros.found.iter().filter(|z| z.settled).count();
    Some(HiddenPoses { poses, settled, evaluations: zeros.evaluations, platforms: 0, excess: zeros.excess })
}

#[cfg(test)]
mod tests;
