//! Derivatives by reverse accumulation: gradients by the joints, and velocities of the joints by the variables.

use nalgebra::{Rotation3, Vector3};

/// Velocities of the joints for unit rate of one variable.
#[derive(Debug, Clone, Default)]
pub(crate) struct Rate {
    /// Leg, velocity of its base end (base frame) and of its platform end (platform frame).
    pub ends: Vec<(usize, Vector3<f64>, Vector3<f64>)>,
    /// Velocity of home, and of every pose given relative to it.
    pub lift: Vector3<f64>,
    /// Joint axis: body (0 base, 1 platform), leg, component.
    pub axis: Option<(usize, usize, usize)>,
}

/// The accumulator of a gradient: a [`PoseGradient`], or nothing if only the value is needed.
pub(super) trait Gradient: Copy {
    /// Whether gradients are kept; formulas skip their derivatives otherwise.
    const KEPT: bool;
    fn none() -> Self;
    /// Adds to the gradient with respect to a base end.
    fn at_base(&mut self, leg: usize, g: &Vector3<f64>);
    /// Adds to the gradient with respect to an arm `R b`.
    fn at_arm(&mut self, leg: usize, g: &Vector3<f64>);
    /// Adds to the gradient with respect to the position.
    fn at_position(&mut self, g: &Vector3<f64>);
    /// Sets the gradient with respect to the line of a leg at home.
    fn set_home(&mut self, leg: usize, g: Vector3<f64>);
    /// Sets the gradient with respect to the axis of a joint.
    fn set_axis(&mut self, body: usize, leg: usize, g: Vector3<f64>);
    fn scaled(self, factor: f64) -> Self;

    /// Adds a gradient with respect to the line `R b + p - a` of a leg.
    fn line(&mut self, leg: usize, g: Vector3<f64>) {
        self.at_base(leg, &-g);
        self.at_arm(leg, &g);
        self.at_position(&g);
    }
}

impl Gradient for () {
    const KEPT: bool = false;
    fn none() -> Self {}
    fn at_base(&mut self, _: usize, _: &Vector3<f64>) {}
    fn at_arm(&mut self, _: usize, _: &Vector3<f64>) {}
    fn at_position(&mut self, _: &Vector3<f64>) {}
    fn set_home(&mut self, _: usize, _: Vector3<f64>) {}
    fn set_axis(&mut self, _: usize, _: usize, _: Vector3<f64>) {}
    fn scaled(self, _: f64) -> Self {}
}

/// Gradient of a function of the legs at one pose with respect to base ends, arms `R b` and position.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PoseGradient {
    pub base: [Vector3<f64>; 6],
    pub arm: [Vector3<f64>; 6],
    pub position: Vector3<f64>,
    /// Leg and gradient with respect to its line at home.
    pub home: Option<(usize, Vector3<f64>)>,
    /// Body, leg and gradient with respect to the axis of the joint.
    pub axis: Option<(usize, usize, Vector3<f64>)>,
}

impl Gradient for PoseGradient {
    const KEPT: bool = true;

    fn none() -> Self {
        let zero = Vector3::zeros();
        Self { base: [zero; 6], arm: [zero; 6], position: zero, home: None, axis: None }
    }

    fn at_base(&mut self, leg: usize, g: &Vector3<f64>) {
        self.base[leg] += g;
    }

    fn at_arm(&mut self, leg: usize, g: &Vector3<f64>) {
        self.arm[leg] += g;
    }

    fn at_position(&mut self, g: &Vector3<f64>) {
        self.position += g;
    }

    fn set_home(&mut self, leg: usize, g: Vector3<f64>) {
        self.home = Some((leg, g));
    }

    fn set_axis(&mut self, body: usize, leg: usize, g: Vector3<f64>) {
        self.axis = Some((body, leg, g));
    }

    fn scaled(mut self, factor: f64) -> Self {
        self.base.iter_mut().chain(&mut self.arm).for_each(|g| *g *= factor);
        self.position *= factor;
        self.home = self.home.map(|(i, g)| (i, g * factor));
        self.axis = self.axis.map(|(b, i, g)| (b, i, g * factor));
        self
    }
}

impl PoseGradient {
    /// Adds `factor` times another.
    pub(super) fn add(&mut self, other: &Self, factor: f64) {
        for i in 0..6 {
            self.base[i] += other.base[i] * factor;
            self.arm[i] += other.arm[i] * factor;
        }
        self.position += other.position * factor;
    }

    /// Gradient with respect to the variables at a pose; `follows`: the pose moves with home.
    pub(super) fn gradient(
        &self,
        rates: &[Rate],
        rotation: &Rotation3<f64>,
        follows: bool,
        home: &Rotation3<f64>,
    ) -> Vec<f64> {
        let arm = self.arm.map(|g| rotation.inverse() * g);
        let back = self.home.map(|(i, g)| (i, g, home.inverse() * g));
        let one = |rate: &Rate| {
            let mut sum = if follows { self.position.dot(&rate.lift) } else { 0.0 };
            for (i, a, b) in &rate.ends {
                sum += self.base[*i].dot(a) + arm[*i].dot(b);
            }
            if let Some((leg, g, turned)) = &back {
                sum += g.dot(&rate.lift);
                for (_, a, b) in rate.ends.iter().filter(|e| e.0 == *leg) {
                    sum += turned.dot(b) - g.dot(a);
                }
            }
            if let (Some((body, leg, g)), Some((b, l, k))) = (self.axis, rate.axis)
                && (body, leg) == (b, l)
            {
                sum += g[k];
            }
            sum
        };
        rates.iter().map(one).collect()
    }
}
