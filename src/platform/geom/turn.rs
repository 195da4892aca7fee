//! Enclosures of rotations by rotation vectors.
//!
//! With `s = w.w` and the entire functions `C_k(s) = sum_j (-s)^j / (2j + k)!` (Stumpff 1959)
//!
//! ```text
//! exp([w]x) = I + C_1(s) [w]x + C_2(s) [w]x^2,   C_1 = sin(t) / t,   C_2 = (1 - cos(t)) / t^2,   t = sqrt(s).
//! ```
//!
//! Outward-rounded intervals sum the series and close it by its first omitted term, since sines of mathematical
//! libraries have no guaranteed error bounds.

use super::enclosed::{IntervalVector, Rotation, matrix, skew};
use num::interval::Interval;
use num::smooth::norm_squared;

/// Number of terms of the series; beyond it the terms fall for every `s <= LARGEST`.
const TERMS: usize = 30;

/// The series ends earlier at a term below this share of the sum, a hundredth of the rounding error of the sum.
const NEGLIGIBLE: f64 = 1e-18;

/// Greatest argument of the series: rotations of 358 degrees.
const LARGEST: f64 = 39.0;

/// `C_1` and `C_2` with their first two derivatives over an interval of `s`.
#[derive(Debug, Clone, Copy)]
pub struct TurnCoefficients {
    /// `C_1` and its derivatives.
    pub first: [Interval; 3],
    /// `C_2` and its derivatives.
    pub second: [Interval; 3],
}

impl TurnCoefficients {
    /// The coefficients over an interval of numbers `s >= 0` (its part below zero is ignored).
    pub fn over(s: Interval) -> Self {
        Self {
            first: std::array::from_fn(|n| stumpff(1, n, s)),
            second: std::array::from_fn(|n| stumpff(2, n, s)),
        }
    }
}

/// Encloses the `n`-th derivative of `C_k`, `k` 1 or 2 and `n <= 2`, over an interval.
///
/// `(-1)^n C_k^(n)` falls from its value at 0 as long as the next derivative keeps its sign. The derivatives of `C_1`
/// are spherical Bessel functions, `C_1^(n) = (-1/2)^n j_n(t) / t^n`. Their first zeros are at `t` = 4.4934, 5.7634,
/// 6.9879 for `n` = 1, 2, 3. The derivatives of `C_2 = C_1(s/4)^2 / 2` keep their signs up to `t = 2 pi`, by the
/// product rule. Beyond, `C_1 > -0.2173` (its least value) and the bounds of the values at 0 remain.
fn stumpff(k: usize, n: usize, s: Interval) -> Interval {
    let (low, high) = (s.lo().max(0.0), s.hi().max(0.0));
    let falls_up_to = if k == 1 { [20.0, 33.0, LARGEST][n] } else { LARGEST };
    let at = |x: f64| series(k, n, Interval::from(x));
    if high <= falls_up_to {
        let (a, b) = (at(low), if high > low { at(high) } else { at(low) });
        return hull(a, b);
    }
    if k == 1 && n == 0 && high <= LARGEST {
        let both = hull(at(low), at(high));
        return Interval::new(-0.2173, both.hi()).unwrap_or(Interval::WHOLE);
    }
    // |C_k^(n)| <= n! / (2n + k)! for s >= 0, its value at 0: integrals of (1 - u)^(k-1) u^(2n) times a Bessel function
    // that is largest at 0
    let bound = at(0.0).magnitude();
    Interval::new(-bound, bound).unwrap_or(Interval::WHOLE)
}

fn hull(a: Interval, b: Interval) -> Interval {
    Interval::new(a.lo().min(b.lo()), a.hi().max(b.hi())).unwrap_or(Interval::WHOLE)
}

/// `sum_i (-1)^(i+n) (i+n)! / i! s^i / (2i + 2n + k)!`, `0 <= s <= LARGEST`.
///
/// Signs alternate, so once the terms fall, the first omitted one bounds the rest.
fn series(k: usize, n: usize, s: Interval) -> Interval {
    let number = |x: usize| Interval::from(x as f64);
    let over = |x: Interval, y: usize| x.checked_div(number(y)).unwrap_or(Interval::WHOLE);
    // n! / (2n + k)!
    let mut term = (2..=n).fold(Interval::from(if n % 2 == 1 { -1.0 } else { 1.0 }), |t, x| t * number(x));
    term = (2..=2 * n + k).fold(term, over);
    let mut sum = Interval::ZERO;
    for i in 0..TERMS {
        sum = sum + term;
        let up = 2 * i + 2 * n + k;
        // a term over the one before, which falls with i
        let ratio = over(s * number(i + n + 1), (i + 1) * (up + 1) * (up + 2));
        term = -(term * ratio);
        if ratio.hi() < 0.5 && term.magnitude() < NEGLIGIBLE * sum.magnitude() {
            break;
        }
    }
    let rest = term.magnitude();
    sum + Interval::new(-rest, rest).unwrap_or(Interval::WHOLE)
}

/// Cosine of angles of at most a turn; otherwise `[-1, 1]`.
pub fn cosine(angle: Interval) -> Interval {
    let square = angle.square();
    if square.hi() > LARGEST {
        return Interval::new(-1.0, 1.0).unwrap_or(Interval::WHOLE);
    }
    // the series has slope -C_1 / 2, at most 1/2
    let (middle, reach) = square.centre_and_radius();
    let off = (Interval::from(reach) * Interval::from(0.5)).hi();
    series(0, 0, Interval::from(middle)) + Interval::new(-off, off).unwrap_or(Interval::WHOLE)
}

/// Sine of angles of at most a turn.
pub fn sine(angle: Interval) -> Interval {
    angle * stumpff(1, 0, angle.square())
}

/// An angle in degrees.
pub fn degrees(radians: Interval) -> Interval {
    let pi = Interval::new(std::f64::consts::PI, std::f64::consts::PI.next_up()).unwrap_or(Interval::WHOLE);
    (radians * Interval::from(180.0)).checked_div(pi).unwrap_or(Interval::WHOLE)
}

/// The angles from 0 to pi whose cosine is in an interval; cosines beyond 1 and -1 come from rounding.
///
/// The library's angle is used only if the series of the cosine confirms that it is too large, or too small.
pub fn arc_cosine(cosine: Interval) -> Interval {
    let cosine_of = |angle: f64| series(0, 0, Interval::from(angle).square());
    let slack = |k: i32| 1e-15 * 10f64.powi(k);
    let above = |x: f64| {
        let guess = x.clamp(-1.0, 1.0).acos();
        let sure = |a: &f64| *a < std::f64::consts::PI && cosine_of(*a).hi() <= x;
        (0..10).map(|k| guess + slack(k)).find(sure).unwrap_or(std::f64::consts::PI.next_up())
    };
    let below = |x: f64| {
        let guess = x.clamp(-1.0, 1.0).acos();
        let sure = |a: &f64| *a > 0.0 && cosine_of(*a).lo() >= x;
        (0..10).map(|k| guess - slack(k)).find(sure).unwrap_or(0.0)
    };
    Interval::new(below(cosine.hi()), above(cosine.lo())).unwrap_or(Interval::WHOLE)
}

/// `[w]x^2 = w w^T - s I`, without the terms of the diagonal that cancel.
fn double_cross(w: &IntervalVector) -> Rotation {
    matrix(|i, j| if i == j { -(w[(i + 1) % 3].square() + w[(i + 2) % 3].square()) } else { w[i] * w[j] })
}

/// Encloses `exp([w]x)`.
pub fn turn(w: &IntervalVector) -> Rotation {
    let c = TurnCoefficients::over(norm_squared(w));
    let (once, twice) = (skew(w), double_cross(w));
    let identity = |i, j| if i == j { Interval::from(1.0) } else { Interval::ZERO };
    matrix(|i, j| identity(i, j) + c.first[0] * once[i][j] + c.second[0] * twice[i][j])
}

/// Encloses `d exp([w]x) / d w_k`: `2 w_k (C_1' [w]x + C_2' [w]x^2) + C_1 [e_k]x + C_2 (e_k w^T + w e_k^T - 2 w_k I)`.
pub fn turn_slope(w: &IntervalVector, k: usize) -> Rotation {
    let c = TurnCoefficients::over(norm_squared(w));
    let (once, twice) = (skew(w), double_cross(w));
    let unit: IntervalVector =
        std::array::from_fn(|i| if i == k { Interval::from(1.0) } else { Interval::ZERO });
    let turned = skew(&unit);
    let two = Interval::from(2.0) * w[k];
    matrix(|i, j| {
        let diagonal = if i == j { two } else { Interval::ZERO };
        two * (c.first[1] * once[i][j] + c.second[1] * twice[i][j])
            + c.first[0] * turned[i][j]
            + c.second[0] * (unit[i] * w[j] + w[i] * unit[j] - diagonal)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, Vector3};
    use num::Rng;
    use num::interval::radians;

    /// `C_k^(n)` from sines and cosines, away from 0.
    fn plain(k: usize, n: usize, s: f64) -> f64 {
        let value = |s: f64| {
            let t = s.sqrt();
            if k == 1 { t.sin() / t } else { (1.0 - t.cos()) / s }
        };
        // Richardson's central differences
        let step = 1e-2;
        let first = |s: f64, h: f64| (value(s + h) - value(s - h)) / (2.0 * h);
        let second = |s: f64, h: f64| (value(s + h) - 2.0 * value(s) + value(s - h)) / (h * h);
        match n {
            0 => value(s),
            1 => (4.0 * first(s, step / 2.0) - first(s, step)) / 3.0,
            _ => (4.0 * second(s, step / 2.0) - second(s, step)) / 3.0,
        }
    }

    #[test]
    fn coefficients_and_derivatives_lie_in_their_enclosures() {
        let mut rng = Rng::new(4);
        for _ in 0..400 {
            let (a, b) = (rng.uniform(0.1, 45.0), rng.uniform(0.0, 3.0) * rng.unit());
            let c = TurnCoefficients::over(Interval::new(a, a + b).unwrap());
            let s = rng.uniform(a, a + b);
            for n in 0..3 {
                for (k, enclosed) in [(1, c.first[n]), (2, c.second[n])] {
                    let (x, slack) = (plain(k, n, s), if n == 0 { 1e-15 } else { 1e-9 });
                    assert!(
                        enclosed.lo() - slack <= x && x <= enclosed.hi() + slack,
                        "{k} {n} {s}: {x} {enclosed:?}"
                    );
                }
            }
            // points are enclosed tightly
            let point = TurnCoefficients::over(Interval::from(a));
            assert!(a > 20.0 || point.first[0].hi() - point.first[0].lo() < 1e-13);
        }
        let at_zero = TurnCoefficients::over(Interval::ZERO);
        for (n, (x, y)) in
            [(1.0, 0.5), (-1.0 / 6.0, -1.0 / 24.0), (1.0 / 60.0, 1.0 / 360.0)].into_iter().enumerate()
        {
            assert!((at_zero.first[n].lo() - x).abs() < 1e-15 && (at_zero.second[n].hi() - y).abs() < 1e-15);
        }
    }

    #[test]
    fn rotations_lie_in_their_enclosures_and_slopes_are_those_of_differences() {
        let mut rng = Rng::new(5);
        for _ in 0..200 {
            let w = Vector3::from_fn(|_, _| rng.uniform(-2.0, 2.0));
            let wide: IntervalVector =
                std::array::from_fn(|k| Interval::new(w[k] - 0.01, w[k] + 0.02).unwrap());
            let point: IntervalVector = std::array::from_fn(|k| Interval::from(w[k]));
            let (r, over, at) = (Rotation3::new(w), turn(&wide), turn(&point));
            for i in 0..3 {
                for j in 0..3 {
                    let x = r[(i, j)];
                    assert!(over[i][j].contains(x) && (at[i][j].lo() - x).abs() < 1e-13);
                    assert!(over[i][j].hi() - over[i][j].lo() < 0.3);
                }
            }
            for k in 0..3 {
                let slope = turn_slope(&point, k);
                let step = Vector3::from_fn(|i, _| if i == k { 1e-5 } else { 0.0 });
                let difference =
                    (Rotation3::new(w + step).matrix() - Rotation3::new(w - step).matrix()) / 2e-5;
                for i in 0..3 {
                    for j in 0..3 {
                        assert!((slope[i][j].lo() - difference[(i, j)]).abs() < 1e-8);
                    }
                }
            }
        }
    }

    #[test]
    fn angles_of_cosines_are_enclosed() {
        let mut rng = Rng::new(8);
        for _ in 0..300 {
            let angle = rng.uniform(0.05, 3.1);
            let found = arc_cosine(Interval::from(angle.cos()));
            assert!(found.contains(angle) && found.hi() - found.lo() < 1e-10, "{angle} {found:?}");
            assert!(degrees(found).contains(angle.to_degrees()));
            let wide = Interval::new(angle - 0.01, angle + 0.02).unwrap();
            assert!(sine(wide).contains(angle.sin()) && cosine(wide).contains(angle.cos()));
            let point = Interval::from(-angle);
            assert!(
                (sine(point).lo() + angle.sin()).abs() < 1e-13
                    && (cosine(point).hi() - angle.cos()).abs() < 1e-13
            );
        }
        for (cosine, angle) in
            [(1.0, 0.0), (-1.0, std::f64::consts::PI), (1.5, 0.0), (-2.0, std::f64::consts::PI)]
        {
            let found = arc_cosine(Interval::from(cosine));
            assert!(
                found.lo() <= angle && angle <= found.hi() && found.hi() - found.lo() < 1e-5,
                "{found:?}"
            );
        }
        assert!(arc_cosine(Interval::WHOLE).encloses(Interval::new(0.0, 3.0).unwrap()));
    }

    #[test]
    fn radians_hold_the_angle() {
        let right = radians(90.0);
        assert!(right.contains(std::f64::consts::FRAC_PI_2) && right.hi() - right.lo() < 4e-15);
    }
}
