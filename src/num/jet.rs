//! Values with first and second derivatives in up to six variables, enclosed over a box of them.
//!
//! Forward differentiation (Wengert 1964) in outward-rounded intervals: each component of a result encloses that of the
//! exact function at every point of the box.

use super::interval::Interval;
pub use super::smooth::{cross, dot, norm_squared};

/// Number of second derivatives in six variables.
const PAIRS: usize = 21;

/// A function over a box of variables.
#[derive(Debug, Clone, Copy)]
pub struct Jet {
    /// Its values.
    pub value: Interval,
    slope: [Interval; 6],
    curve: [Interval; PAIRS],
    /// Number of variables.
    variables: usize,
    /// Whether second derivatives are kept.
    second: bool,
}

/// The index of the derivative by variables `i <= j`, and of the entry of a symmetric 6 x 6 matrix.
pub fn place(i: usize, j: usize) -> usize {
    i * (11 - i) / 2 + j
}

impl Jet {
    /// A constant.
    pub fn constant(value: Interval, variables: usize, second: bool) -> Self {
        Self { value, slope: [Interval::ZERO; 6], curve: [Interval::ZERO; PAIRS], variables, second }
    }

    /// A function with these values and constant slopes.
    pub fn linear(value: Interval, slope: [Interval; 6], variables: usize, second: bool) -> Self {
        Self { slope, ..Self::constant(value, variables, second) }
    }

    /// A constant in the same variables.
    pub fn alike(&self, value: Interval) -> Self {
        Self::constant(value, self.variables, self.second)
    }

    /// An unbounded function in the same variables.
    pub fn unknown(&self) -> Self {
        Self { value: Interval::WHOLE, slope: [Interval::WHOLE; 6], curve: [Interval::WHOLE; PAIRS], ..*self }
    }

    /// The jet without its second derivatives, so that results from it cost only their slopes.
    pub fn first_order(mut self) -> Self {
        self.second = false;
        self.curve = [Interval::ZERO; PAIRS];
        self
    }

    /// Whether second derivatives are kept.
    pub fn is_second_order(&self) -> bool {
        self.second
    }

    /// First derivatives.
    pub fn slope(&self, k: usize) -> Interval {
        self.slope[k]
    }

    /// Second derivatives; zero if they are not kept.
    pub fn curve(&self, i: usize, j: usize) -> Interval {
        self.curve[place(i.min(j), i.max(j))]
    }

    /// Sets the second derivative by two variables.
    pub fn set_curve(&mut self, i: usize, j: usize, curve: Interval) {
        self.curve[place(i.min(j), i.max(j))] = curve;
    }

    /// The jet with other values and the same derivatives.
    pub fn with_value(self, value: Interval) -> Self {
        Self { value, ..self }
    }

    /// The norms of the derivatives of a vector, of first or of second order, rounded up, by index.
    pub fn sizes(v: &JetVector, order: usize) -> [Interval; PAIRS] {
        std::array::from_fn(|k| {
            let part = |x: &Self| match order {
                1 => x.slope.get(k).copied().unwrap_or(Interval::ZERO),
                _ => x.curve[k],
            };
            let square = part(&v[0]).square() + part(&v[1]).square() + part(&v[2]).square();
            Interval::from(square.sqrt().map_or(f64::INFINITY, Interval::hi))
        })
    }

    /// The jet with derivatives of the given order widened by `widths`, by index. Higher orders are dropped.
    pub fn widened(mut self, order: usize, widths: &[Interval; PAIRS]) -> Self {
        let wide = |x: Interval, width: Interval| x + Interval::about_zero(width.hi());
        if order == 1 {
            for (x, width) in self.slope.iter_mut().zip(widths).take(self.variables) {
                *x = wide(*x, *width);
            }
            self.curve = [Interval::ZERO; PAIRS];
        } else if self.second {
            for i in 0..self.variables {
                for j in i..self.variables {
                    self.curve[place(i, j)] = wide(self.curve[place(i, j)], widths[place(i, j)]);
                }
            }
        }
        self
    }

    /// `f` of the jet, from values of `f`, `f'` and `f''` over its values.
    pub fn composed(&self, f: [Interval; 3]) -> Self {
        let mut out = Self::constant(f[0], self.variables, self.second);
        for i in 0..self.variables {
            out.slope[i] = f[1] * self.slope[i];
            if self.second {
                for j in i..self.variables {
                    let bend = if i == j { self.slope[i].square() } else { self.slope[i] * self.slope[j] };
                    out.curve[place(i, j)] = f[1] * self.curve[place(i, j)] + f[2] * bend;
                }
            }
        }
        out
    }

    /// Its square.
    pub fn square(&self) -> Self {
        let two = Interval::from(2.0);
        self.composed([self.value.square(), two * self.value, two])
    }

    /// `1 / sqrt(x)`, `None` unless it is positive.
    pub fn inverse_root(&self) -> Option<Self> {
        let root = Some(self.value).filter(|v| v.lo() > 0.0)?.sqrt()?;
        let one = Interval::from(1.0);
        let f0 = one.checked_div(root)?;
        let f1 = -f0.checked_div(self.value * Interval::from(2.0))?;
        let f2 = (f0 * Interval::from(0.75)).checked_div(self.value.square())?;
        Some(self.composed([f0, f1, f2]))
    }

    /// `1 / x`, `None` where it may be zero.
    pub fn inverse(&self) -> Option<Self> {
        let f0 = Interval::from(1.0).checked_div(self.value)?;
        let square = f0.square();
        Some(self.composed([f0, -square, Interval::from(2.0) * f0 * square]))
    }

    /// `sqrt(x)`, `None` unless it is positive.
    pub fn root(&self) -> Option<Self> {
        let root = Some(self.value).filter(|v| v.lo() > 0.0)?.sqrt()?;
        let f1 = Interval::from(0.5).checked_div(root)?;
        let f2 = -f1.checked_div(self.value * Interval::from(2.0))?;
        Some(self.composed([root, f1, f2]))
    }

    /// A multiple.
    pub fn times(&self, factor: Interval) -> Self {
        let mut out = Self::constant(factor * self.value, self.variables, self.second);
        for k in 0..self.variables {
            out.slope[k] = factor * self.slope[k];
        }
        if self.second {
            out.curve = self.curve.map(|x| if x == Interval::ZERO { x } else { factor * x });
        }
        out
    }

    /// Entry by entry.
    #[inline]
    fn combined(&self, other: &Self, f: impl Fn(Interval, Interval) -> Interval) -> Self {
        let mut out = Self::constant(f(self.value, other.value), self.variables, self.second);
        for k in 0..self.variables {
            out.slope[k] = f(self.slope[k], other.slope[k]);
        }
        if self.second {
            for (x, (a, b)) in out.curve.iter_mut().zip(self.curve.iter().zip(&other.curve)) {
                *x = f(*a, *b);
            }
        }
        out
    }

    fn sum(&self, other: &Self) -> Self {
        self.combined(other, |x, y| x + y)
    }

    fn difference(&self, other: &Self) -> Self {
        self.combined(other, |x, y| x - y)
    }

    fn product(&self, other: &Self) -> Self {
        let mut out = Self::constant(self.value * other.value, self.variables, self.second);
        // most factors depend on few variables, so products with zero are skipped
        let product = |x: Interval, y: Interval| {
            if x == Interval::ZERO || y == Interval::ZERO { Interval::ZERO } else { x * y }
        };
        for i in 0..self.variables {
            out.slope[i] = product(self.slope[i], other.value) + product(self.value, other.slope[i]);
            if self.second {
                for j in i..self.variables {
                    let at = place(i, j);
                    out.curve[at] = product(self.curve[at], other.value)
                        + product(self.value, other.curve[at])
                        + product(self.slope[i], other.slope[j])
                        + product(self.slope[j], other.slope[i]);
                }
            }
        }
        out
    }
}

crate::operators! {
    [inline] [] Jet;
    // the operators are inlined and their implementations are not, so that the large operands are not copied
    Add::add(x, y) {
        x.sum(&y)
    }
    Sub::sub(x, y) {
        x.difference(&y)
    }
    Neg::neg(x) {
        x.alike(Interval::ZERO).difference(&x)
    }
    Mul::mul(x, y) {
        x.product(&y)
    }
}

/// Three coordinates.
pub type JetVector = [Jet; 3];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Rng;

    /// `sqrt(1 + x y) (x - z^2) / sqrt(2 + y)` with every operation, and its values in doubles.
    fn formula(x: &[Jet; 3]) -> Jet {
        let one = Jet::constant(Interval::from(1.0), 3, true);
        let two = Jet::constant(Interval::from(2.0), 3, true);
        (one + x[0] * x[1]).root().unwrap() * (x[0] - x[2].square()) * (two + x[1]).inverse_root().unwrap()
    }

    fn plain(x: [f64; 3]) -> f64 {
        (1.0 + x[0] * x[1]).sqrt() * (x[0] - x[2] * x[2]) / (2.0 + x[1]).sqrt()
    }

    fn variables(lo: [f64; 3], width: f64) -> [Jet; 3] {
        std::array::from_fn(|k| {
            let mut slope = [Interval::ZERO; 6];
            slope[k] = Interval::from(1.0);
            Jet::linear(Interval::new(lo[k], lo[k] + width).unwrap(), slope, 3, true)
        })
    }

    #[test]
    fn values_and_derivatives_are_those_of_differences_and_boxes_hold_their_points() {
        let mut rng = Rng::new(6);
        let h = 1e-4;
        for _ in 0..50 {
            let x: [f64; 3] = std::array::from_fn(|_| rng.uniform(0.2, 2.0));
            let at = formula(&variables(x, 0.0));
            let moved = |steps: &[(usize, f64)]| {
                let mut y = x;
                for (k, s) in steps {
                    y[*k] += s * h;
                }
                plain(y)
            };
            assert!((at.value.lo() - plain(x)).abs() < 1e-13);
            for i in 0..3 {
                let slope = (moved(&[(i, 1.0)]) - moved(&[(i, -1.0)])) / (2.0 * h);
                assert!((at.slope(i).lo() - slope).abs() < 1e-6);
                for j in 0..3 {
                    let s = |a: f64, b: f64| moved(&[(i, a), (j, b)]);
                    let curve = (s(1.0, 1.0) - s(1.0, -1.0) - s(-1.0, 1.0) + s(-1.0, -1.0)) / (4.0 * h * h);
                    assert!((at.curve(i, j).lo() - curve).abs() < 1e-5, "{i} {j}");
                    assert_eq!(at.curve(i, j), at.curve(j, i));
                }
            }
            // over a box around it
            let low = x.map(|x| x - 0.1);
            let over = formula(&variables(low, 0.2));
            assert!(over.value.encloses(at.value));
            for i in 0..3 {
                assert!(over.slope(i).encloses(at.slope(i)));
                assert!((0..3).all(|j| over.curve(i, j).encloses(at.curve(i, j))));
            }
        }
        let zero = Jet::constant(Interval::ZERO, 1, true);
        assert!(zero.root().is_none() && zero.inverse_root().is_none());
    }
}
