//! Linear models of constraints and objectives near a point.

use super::values::ConstraintGroup;
use machine::requirements::TermKind;

/// A requirement: kind, leg (joint), other leg (joint, keep-out, load), part.
pub(crate) type TermId = (TermKind, usize, usize, usize);

/// The pose index of constraints without a pose.
pub(crate) const NO_POSE: usize = usize::MAX;

/// Singular values within this factor of the extreme one are modelled jointly.
pub(crate) const CLUSTER: f64 = 1.6;

/// A constraint near a point.
#[derive(Debug, Clone)]
pub(crate) struct LinearItem {
    pub group: ConstraintGroup,
    /// Pose and requirement.
    pub id: (usize, TermId),
    pub value: f64,
    pub gradient: Vec<f64>,
    /// Head and tail of a second-order cone, divided by the size.
    pub cone: Option<AffineCone>,
}

/// `head >= |tail|`, affine in the step.
#[derive(Debug, Clone)]
pub(crate) struct AffineCone {
    pub head: (f64, Vec<f64>),
    pub tail: [(f64, Vec<f64>); 3],
    /// Factor of the slack in the head.
    pub slack: f64,
}

/// A cluster of singular values with gradients by the variables.
#[derive(Debug, Clone)]
pub(crate) struct LinearCluster {
    pub sigma: f64,
    pub own: Vec<f64>,
    pub others: Vec<(f64, Vec<f64>, Vec<f64>)>,
}

/// A bound of an objective near a point.
#[derive(Debug, Clone)]
pub(crate) enum LinearBound {
    Plain,
    Spectral { f: f64, h: f64, low: LinearCluster, high: LinearCluster },
    Length(Option<AffineCone>),
}

/// A piece of an objective near a point.
#[derive(Debug, Clone)]
pub(crate) struct LinearPiece {
    pub objective: usize,
    /// Pose and number within the pose.
    pub id: (usize, usize),
    pub value: f64,
    pub gradient: Vec<f64>,
    pub bound: LinearBound,
}

fn affine(at: f64, gradient: &[f64], d: &[f64]) -> f64 {
    at + gradient.iter().zip(d).map(|(g, d)| g * d).sum::<f64>()
}

impl AffineCone {
    fn norm(&self, d: &[f64]) -> f64 {
        self.tail.iter().map(|(v, g)| affine(*v, g, d).powi(2)).sum::<f64>().sqrt()
    }
}

impl LinearItem {
    /// Value of the linear model after a step, with slack: negative if it is violated.
    pub(super) fn room(&self, d: &[f64], slack: f64, spare: f64) -> f64 {
        match &self.cone {
            Some(cone) => affine(cone.head.0, &cone.head.1, d) + cone.slack * slack - cone.norm(d),
            None => affine(self.value - spare + slack, &self.gradient, d),
        }
    }
}

impl LinearCluster {
    /// Change of the extreme singular value (`sign` 1: the least, -1: the greatest) after a step, pair by pair.
    fn change(&self, d: &[f64], sign: f64) -> f64 {
        let own = affine(0.0, &self.own, d);
        let pairs = self.others.iter().map(|(sigma, across, other)| {
            let (there, off) = (affine(sigma - self.sigma, other, d), affine(0.0, across, d));
            0.5 * (own + there - sign * (own - there).hypot(2.0 * off))
        });
        pairs.fold(own, |worst, v| if sign * v < sign * worst { v } else { worst })
    }
}

impl LinearPiece {
    /// Whether several singular values are modelled jointly, by cones.
    pub(super) fn has_cluster(&self) -> bool {
        matches!(&self.bound, LinearBound::Spectral { low, high, .. } if !low.others.is_empty() || !high.others.is_empty())
    }

    /// Upper bound of the objective by this piece after a step.
    pub(super) fn upper(&self, d: &[f64]) -> f64 {
        match &self.bound {
            LinearBound::Spectral { f, h, low, high } => {
                self.value + f * low.change(d, 1.0) - h * high.change(d, -1.0)
            }
            _ => affine(self.value, &self.gradient, d),
        }
    }

    /// Lower and upper model of a length after a step.
    pub(super) fn lengths(&self, d: &[f64]) -> (f64, f64) {
        let plain = affine(self.value, &self.gradient, d);
        match &self.bound {
            LinearBound::Length(Some(cone)) => (plain, cone.norm(d)),
            _ => (plain, plain),
        }
    }
}

/// The data of the next step.
#[derive(Debug, Clone, Default)]
pub(crate) struct Linearised {
    pub items: Vec<LinearItem>,
    pub pieces: Vec<LinearPiece>,
}
