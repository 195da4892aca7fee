//! The degrees of a sequence's closure polynomial, measured once on a random design with the same joints shared. Its
//! zeros are those of a polynomial in `u` and `1/u`, found from its values on a circle.

use nalgebra::Point3;
use num_complex::Complex64;

use super::chain::{ChainBranch, Exponents, TrilaterationChain};
use super::each_start;
use num::poly::approximate_roots;
use num::{Purpose, Rng};
use platform::manipulator::Manipulator;
use platform::topology::{JointIndex, Sequence};

/// Degrees that hold for all designs of a topology: almost all have them, the others may have less.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct GenericDegrees {
    /// See `docs/theory/trilateration.md`.
    pub(super) exponents: Exponents,
    /// Half the number of zeros for each choice of the orientations before the turn.
    pub(super) degree: usize,
    /// Places of the joints before the turn.
    pub(super) starts: usize,
    /// Whether zeros are simple.
    simple: bool,
}

/// Points in a random sample.
const SAMPLES: usize = 128;
/// Random instances that have to agree, and the most that are tried until one shows the degree clearly.
const INSTANCES: (u64, u64) = (2, 8);

impl GenericDegrees {
    /// Poses of almost all designs with this shape.
    #[must_use]
    pub fn expected(&self) -> usize {
        self.starts * (2 * self.degree).max(1)
    }

    /// Whether each pose of almost all designs is a simple zero of the closure polynomial.
    #[must_use]
    pub fn is_simple(&self) -> bool {
        self.simple
    }

    /// Measures the shape of a sequence for designs with the legs of `m`; `None` when the closure is not a polynomial
    /// for any exponents tried. The result depends on the legs alone, not on coordinates.
    #[must_use]
    pub fn measure(
        m: &Manipulator,
        s: &Sequence,
        given: &[(usize, usize)],
        closure: Option<[JointIndex; 2]>,
    ) -> Option<Self> {
        let mut seen: Vec<(Self, bool)> = Vec::new();
        for k in 0..INSTANCES.1 {
            let rng = &mut Purpose::GENERIC_DESIGNS.item(0x5ea1, k);
            let random = random_design(m, rng)?;
            let chain = TrilaterationChain::new(&random, s, given, closure)?;
            let complex = |_| Complex64::new(rng.uniform(1.0, 4.0), rng.uniform(-1.0, 1.0));
            let lengths: Vec<Complex64> = (0..6 + given.len()).map(complex).collect();
            seen.extend(of_instance(&chain, &lengths, rng));
            let degree = seen.iter().map(|s| s.0.degree).max().unwrap_or(0);
            let shown = seen.iter().any(|s| s.1 && s.0.degree == degree);
            if k + 1 >= INSTANCES.0 && shown {
                break;
            }
        }
        // nearly all instances have the same shape, so that the greatest degree is that of almost all designs
        let degree = seen.iter().filter(|s| s.1).map(|s| s.0.degree).max()?;
        let first = seen.iter().find(|s| s.0.degree == degree)?.0;
        let alike = seen.iter().all(|s| s.0.exponents == first.exponents && s.0.degree <= degree);
        let simple = seen.iter().any(|s| s.0.simple);
        alike.then_some(Self { simple, ..first })
    }
}

/// The legs of `m` with other joints.
fn random_design(m: &Manipulator, rng: &mut Rng) -> Option<Manipulator> {
    let mut joints = |n: usize| -> Vec<Point3<f64>> {
        (0..n).map(|_| Point3::from([(); 3].map(|()| rng.uniform(-1.0, 1.0)))).collect()
    };
    let (base, platform) = (joints(m.base_joints().len()), joints(m.platform_joints().len()));
    Manipulator::try_new(base, platform, m.pairs()).ok()
}

/// The shape, and whether nothing stands between the coefficients and rounding.
fn of_instance(
    chain: &TrilaterationChain,
    lengths: &[Complex64],
    rng: &mut Rng,
) -> Option<(GenericDegrees, bool)> {
    let mut starts = Vec::new();
    each_start(chain, lengths, &mut |at| starts.push(*at));
    if chain.turn.is_none() {
        // half a zero for each place
        return Some((
            GenericDegrees { exponents: [0, 0], degree: 0, starts: starts.len(), simple: true },
            true,
        ));
    }
    let branch = ChainBranch::new(chain, lengths, starts.first()?)?;
    let exponents = exponents(&branch, rng)?;
    let circle = unit_circle(SAMPLES);
    let values = branch.products(&circle, exponents);
    let most = SAMPLES / 2 - 1;
    let c = coefficients(&values, most, &circle);
    let largest = c.iter().map(|z| z.norm()).fold(0.0, f64::max);
    let beyond = |limit: f64| {
        (0..=most).rev().find(|k| [most - k, most + k].iter().any(|i| c[*i].norm() > limit * largest))
    };
    let (clear, degree) = (beyond(1e-9)?, beyond(1e-12)?);
    if degree > 24 {
        return None;
    }
    let (found, _) = zeros(&c[most - degree..=most + degree]);
    let apart =
        |i: usize, j: usize| (found[i] - found[j]).norm() > 1e-4 * found[i].norm().min(found[j].norm());
    let simple = (0..found.len()).all(|i| (0..i).all(|j| apart(i, j)));
    Some((GenericDegrees { exponents, degree, starts: starts.len(), simple }, clear == degree))
}

/// The least exponents with which the product has neither zeros nor poles where a Gram determinant vanishes.
fn exponents(branch: &ChainBranch<'_>, rng: &mut Rng) -> Option<Exponents> {
    let mut seen: Vec<[i32; 3]> = Vec::new();
    for t in 0..branch.chain.after.len() {
        for _ in 0..4 {
            let Some(zero) = gram_zero(branch, t, rng) else { continue };
            let around = |f: &dyn Fn(Complex64) -> Complex64| winding(f, zero);
            let product = around(&|u| branch.product(u, [0, 0]));
            let grams = [0, 1].map(|t| around(&|u| branch.grams(u)[t]));
            if let (Some(p), [Some(a), Some(b)]) = (product, grams) {
                seen.push([p, a, b]);
            }
        }
    }
    let fits = |a: i32, b: i32| seen.iter().all(|s| s[0] + a * s[1] + b * s[2] == 0);
    let pairs = (0..=16).flat_map(|sum| (0..=sum.min(8)).map(move |b| (sum - b, b)));
    pairs.into_iter().find(|(a, b)| fits(*a, *b)).map(|(a, b)| [a.unsigned_abs(), b.unsigned_abs()])
}

/// A zero of a Gram determinant by the secant method from a random point.
fn gram_zero(branch: &ChainBranch<'_>, t: usize, rng: &mut Rng) -> Option<Complex64> {
    let mut x = Complex64::from_polar(rng.uniform(0.4, 2.5), rng.uniform(-3.1, 3.1));
    let mut y = x * (1.0 + 1e-3);
    let scale = branch.grams(x)[t].norm();
    let (mut f, mut g) = (branch.grams(x)[t], branch.grams(y)[t]);
    for _ in 0..60 {
        let step = g * (y - x) / (g - f);
        if !step.is_finite() {
            break;
        }
        (x, f) = (y, g);
        y -= step;
        g = branch.grams(y)[t];
        if step.norm() < 1e-13 * y.norm() {
            break;
        }
    }
    let reasonable = (0.02..50.0).contains(&y.norm());
    (reasonable && branch.grams(y)[t].norm() < 1e-9 * scale).then_some(y)
}

/// The number of turns of a function about zero along a small circle; `None` when it is not clear.
fn winding(f: &dyn Fn(Complex64) -> Complex64, centre: Complex64) -> Option<i32> {
    /// Points of the circle: enough to count the turns of a zero of any order that occurs.
    const POINTS: usize = 48;
    /// Radius of the circle, relative to the modulus of its centre.
    const RADIUS: f64 = 1e-3;
    let radius = RADIUS * centre.norm();
    let values: Vec<Complex64> = unit_circle(POINTS).iter().map(|v| f(centre + v * radius)).collect();
    let turns = (0..POINTS).map(|k| (values[(k + 1) % POINTS] / values[k]).arg());
    let turns: Vec<f64> = turns.collect();
    if !turns.iter().all(|t| t.abs() < 2.0) {
        return None;
    }
    Some((turns.iter().sum::<f64>() / std::f64::consts::TAU).round() as i32)
}

/// Relative step at which a zero is near enough for Newton's method on the closure, of which it is a simple zero.
const STEP: f64 = 1e-6;
/// Sweeps after which zeros are taken as they are.
const SWEEPS: usize = 40;

/// Coefficients `c_{-D}, .., c_D` of `sum c_k v^k` from values at the `n > 2 D` roots of unity `v = exp(2 pi i j / n)`,
/// which are `turn`.
pub(super) fn coefficients(values: &[Complex64], degree: usize, turn: &[Complex64]) -> Vec<Complex64> {
    let n = values.len();
    let sum = |k: usize| {
        // k counts from -D
        let step = (k + n - degree % n) % n;
        let mut place = 0;
        let mut sum = Complex64::ZERO;
        for v in values {
            sum += v * turn[place].conj();
            place = (place + step) % n;
        }
        sum / n as f64
    };
    (0..=2 * degree).map(sum).collect()
}

/// The `n`-th roots of unity.
pub(super) fn unit_circle(n: usize) -> Vec<Complex64> {
    (0..n).map(|j| Complex64::cis(std::f64::consts::TAU * j as f64 / n as f64)).collect()
}

/// The zeros, and how many are lost at zero and infinity: end coefficients below `1e-15` of the largest are rounding.
pub(super) fn zeros(coefficients: &[Complex64]) -> (Vec<Complex64>, usize) {
    let largest = coefficients.iter().map(|c| c.norm()).fold(0.0, f64::max);
    let counts = |c: &Complex64| c.norm() > 1e-15 * largest;
    let ends = coefficients.iter().position(counts).zip(coefficients.iter().rposition(counts));
    let Some((low, top)) = ends else { return (Vec::new(), coefficients.len().saturating_sub(1)) };
    let found = approximate_roots(&coefficients[low..=top], STEP, SWEEPS).unwrap_or_default();
    let lost = coefficients.len() - 1 - found.len();
    (found, lost)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn zeros_come_back_from_values() {
        let known =
            [Complex64::new(0.5, 0.2), Complex64::new(-1.1, 0.7), Complex64::I, Complex64::new(2.0, 0.0)];
        let value = |v: &Complex64| known.iter().map(|w| v - w).product::<Complex64>() / (v * v);
        let values: Vec<Complex64> = unit_circle(8).iter().map(value).collect();
        let c = coefficients(&values, 3, &unit_circle(8));
        assert!(c[0].norm() < 1e-15 && c[6].norm() < 1e-15 && (c[5] - 1.0).norm() < 1e-15);
        let (found, lost) = zeros(&c[1..6]);
        assert_eq!((found.len(), lost), (4, 0));
        for w in known {
            assert!(found.iter().any(|z| (z - w).norm() < 1e-9));
        }
        let (found, lost) = zeros(&c);
        assert!(found.len() == 4 && lost == 2 || found.len() + lost == 6);
    }
}
