//! Finds all poses by trilateration in floating point, for sequences with no or one unknown virtual leg.
//!
//! The joint at the end of the virtual leg has two other known distances, so that it turns on a circle. Its angle is a
//! better unknown than the length of the virtual leg. `u = exp(i angle)` is a rational parameter of the first square
//! root, and real configurations have `|u| = 1`. The closures of all orientations of the later steps are multiplied.
//! Their product is a polynomial in `u` and `1/u` over powers of the Gram determinants of the steps' bases. Values on
//! `|u| = 1` give its coefficients. Each zero gives one configuration, which Newton's method on the closure itself
//! makes accurate. Theory: `docs/theory/trilateration.md`.

mod chain;
mod number;
mod shape;

pub use shape::GenericDegrees;

use num_complex::Complex64;

use self::chain::ChainBranch;
use chain::{Positions, TrilaterationChain};
use num::batch::LANES;
use number::squared_distance;
use platform::geom::ComplexPose;
use platform::manipulator::Manipulator;
use platform::topology::{JointIndex, Sequence};

/// A sequence prepared for a design, for any lengths.
#[derive(Debug, Clone)]
pub struct Evaluator {
    chain: TrilaterationChain,
    shape: GenericDegrees,
    /// The sample points of the polynomial.
    circle: Vec<Complex64>,
}

/// A pose that satisfies the distances used.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Configuration {
    /// The pose of the platform, design units.
    pub pose: ComplexPose,
    /// Squared length of the unknown virtual leg, design units squared; `None` when there is none.
    pub virtual_square: Option<Complex64>,
    /// The last step of Newton's method on the closure, relative to `u`; zero without a closure.
    pub step: f64,
}

/// All configurations found.
#[derive(Debug, Clone, PartialEq)]
pub struct Configurations {
    /// One for each zero of the closure polynomial: some may coincide where zeros are close together.
    pub found: Vec<Configuration>,
    /// Number of configurations for almost all designs of the topology.
    pub expected: usize,
    /// Zeros at infinity within rounding, or too far out for the samples.
    pub lost: usize,
}

impl Evaluator {
    /// Prepares a sequence for a design. The lengths of the virtual legs `given` are known in
    /// [`configurations`](Self::configurations); when the sequence has one more it is found from `closure`. `None` when
    /// the sequence does not fit, or its shape cannot be measured.
    #[must_use]
    pub fn new(
        m: &Manipulator,
        s: &Sequence,
        given: &[(usize, usize)],
        closure: Option<[JointIndex; 2]>,
    ) -> Option<Self> {
        let shape = GenericDegrees::measure(m, s, given, closure)?;
        Self::with_shape(m, s, given, closure, shape)
    }

    /// [`new`](Self::new) with the shape known from another design with the same legs.
    #[must_use]
    pub fn with_shape(
        m: &Manipulator,
        s: &Sequence,
        given: &[(usize, usize)],
        closure: Option<[JointIndex; 2]>,
        shape: GenericDegrees,
    ) -> Option<Self> {
        // as many as there are coefficients, in full batches
        let circle = shape::unit_circle((2 * shape.degree + 1).next_multiple_of(LANES));
        Some(Self { chain: TrilaterationChain::new(m, s, given, closure)?, shape, circle })
    }

    /// The degrees that hold for all designs of the topology.
    #[must_use]
    pub fn shape(&self) -> GenericDegrees {
        self.shape
    }

    /// Whether the sequence has a virtual leg that is found from a closure.
    #[must_use]
    pub fn has_closure(&self) -> bool {
        self.chain.closure.is_some()
    }

    /// All configurations, real and complex. `squares` are the squared lengths of the six legs, then of the given
    /// virtual legs, in design units squared. The polynomial is sampled on `|u| = radius`; zeros far from there lose
    /// digits.
    #[must_use]
    pub fn configurations(&self, squares: &[Complex64], radius: f64) -> Configurations {
        let unit = self.chain.size * self.chain.size;
        let lengths: Vec<Complex64> = squares.iter().map(|s| s / unit).collect();
        let mut out = Configurations { found: Vec::new(), expected: self.shape.expected(), lost: 0 };
        each_start(&self.chain, &lengths, &mut |at| self.solve(&lengths, at, radius, &mut out));
        if self.chain.turn.is_none() {
            out.expected = self.shape.starts;
        }
        out
    }

    /// All zeros with the joints before the turn in place.
    fn solve(&self, lengths: &[Complex64], at: &Positions<Complex64>, radius: f64, out: &mut Configurations) {
        if self.chain.turn.is_none() {
            out.found.push(Configuration { pose: self.chain.pose(at), virtual_square: None, step: 0.0 });
            return;
        }
        let Some(branch) = ChainBranch::new(&self.chain, lengths, at) else {
            out.lost += 2 * self.shape.degree;
            return;
        };
        let points: Vec<Complex64> = self.circle.iter().map(|v| v * radius).collect();
        let values = branch.products(&points, self.shape.exponents);
        let coefficients = shape::coefficients(&values, self.shape.degree, &self.circle);
        let (zeros, lost) = shape::zeros(&coefficients);
        out.lost += lost;
        let mut zeros: Vec<Complex64> = zeros.into_iter().map(|v| v * radius).collect();
        let mut found = self.polished(&branch, &zeros);
        if !settled(&found, zeros.len()) {
            branch.separate(&mut zeros, self.shape.exponents, self.shape.degree);
            found = self.polished(&branch, &zeros);
        }
        out.lost += zeros.len() - found.len();
        out.found.extend(found.into_iter().map(|f| f.1));
    }

    /// The configuration at each zero of the product, that of the orientations whose closure is least, and its `u`.
    fn polished(&self, branch: &ChainBranch<'_>, zeros: &[Complex64]) -> Vec<(Complex64, Configuration)> {
        let mut out = Vec::with_capacity(zeros.len());
        let Some(turn) = self.chain.turn else { return out };
        let unit = self.chain.size * self.chain.size;
        for chunk in zeros.chunks(LANES) {
            let polished = branch.polished_near(chunk);
            for k in (0..chunk.len()).filter(|k| polished.found[*k]) {
                let [x, y] = [turn.place, turn.virtual_end].map(|slot| polished.joint(k, slot));
                let virtual_square = Some(squared_distance(&x, &y) * unit);
                let pose = self.chain.pose_of(polished.three(k));
                out.push((
                    polished.u.lane(k),
                    Configuration { pose, virtual_square, step: polished.step[k] },
                ));
            }
        }
        out
    }
}

/// Whether every zero led to a configuration of its own.
fn settled(found: &[(Complex64, Configuration)], zeros: usize) -> bool {
    let near = |x: Complex64, y: Complex64| (x - y).norm_sqr() < 1e-14 * x.norm_sqr();
    let apart = |i: usize| found[..i].iter().all(|f| !near(f.0, found[i].0));
    found.len() == zeros && found.iter().all(|f| f.1.step < 1e-8) && (0..zeros).all(apart)
}

/// All places of the joints before the turn.
fn each_start(
    chain: &TrilaterationChain,
    lengths: &[Complex64],
    visit: &mut impl FnMut(&Positions<Complex64>),
) {
    fn next(
        chain: &TrilaterationChain,
        lengths: &[Complex64],
        t: usize,
        at: &mut Positions<Complex64>,
        visit: &mut impl FnMut(&Positions<Complex64>),
    ) {
        let Some(step) = chain.before.get(t) else {
            visit(at);
            return;
        };
        for q in TrilaterationChain::places(step, at, lengths).both() {
            at[step.place] = q;
            next(chain, lengths, t + 1, at, visit);
        }
    }
    let mut at = chain.first;
    next(chain, lengths, 0, &mut at, visit);
}

#[cfg(test)]
mod tests;
