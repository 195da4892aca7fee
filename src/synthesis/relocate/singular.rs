//! Singular parameters of a move along a family.

use nalgebra::Matrix6;

use super::LegMove;
use crate::components::spectrum::real_roots;
use crate::components::{Components, Parametrisation};
use num::linalg::LinalgError;
use platform::manipulator::Leg;

/// First parameters with det A = 0.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(
    feature = "serde",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case"),
    schemars(rename = "SingularParametersRecord", transform = num::nullable)
)]
pub enum SingularParameters {
    /// All values.
    Everywhere,
    /// Some values, in order; other parameters are those of the move. For plane cubics these are the changes of sign of
    /// the determinant over 360 lines through the centre.
    #[cfg_attr(feature = "serde", serde(untagged))]
    At(Vec<f64>),
}

/// The determinant counts as zero below this share of its largest value along the family.
const ZERO: f64 = 1e-9;
/// Number of sampled lines of the pencil of a cubic.
const LINES: usize = 360;

/// The determinant of `a` with the coefficients of the leg in the row of the move, times the denominators of the leg's
/// ends.
struct RowDeterminant<'a> {
    found: &'a Components,
    step: &'a LegMove,
    rest: &'a Matrix6<f64>,
}

impl RowDeterminant<'_> {
    fn determinant(&self, leg: &Leg) -> f64 {
        let mut a = *self.rest;
        for (j, c) in self.found.span.coefficients(leg).into_iter().enumerate() {
            a[(self.step.leg.get(), j)] = c;
        }
        a.determinant()
    }

    fn at(&self, t: f64) -> Result<Option<f64>, LinalgError> {
        let mut parameters = self.step.parameters.clone();
        parameters[0] = t;
        let formulas = self.step.formulas(&self.found.components[self.step.family]);
        let weight = match formulas {
            Parametrisation::Rational { base, platform, .. } => {
                base.homogeneous(&parameters)[0] * platform.homogeneous(&parameters)[0]
            }
            Parametrisation::Cubic(_) => 1.0,
        };
        Ok(formulas.leg_at(&parameters)?.map(|leg| self.determinant(&leg) * weight))
    }
}

/// The zeros of `det A` along the first parameter of a move; `rest` is `A` with the rows of the other moves.
pub(super) fn singular_parameters(
    found: &Components,
    step: &LegMove,
    rest: &Matrix6<f64>,
) -> Result<SingularParameters, LinalgError> {
    let along = RowDeterminant { found, step, rest };
    match step.formulas(&found.components[step.family]) {
        Parametrisation::Rational { base, platform, .. } => {
            let degree = |p: &crate::components::MovingPoint| {
                p.terms.iter().map(|(e, _)| usize::from(e[0])).max().unwrap_or(0)
            };
            rational(&along, degree(base) + degree(platform))
        }
        Parametrisation::Cubic(_) => cubic(&along),
    }
}

/// Roots of `det A` times the denominators, a polynomial of known degree found by interpolation.
fn rational(along: &RowDeterminant, degree: usize) -> Result<SingularParameters, LinalgError> {
    let mut nodes = Vec::new();
    // Chebyshev points of [-1, 2], without those that have no leg
    let count = degree + 1;
    for extra in 0..6 {
        nodes.clear();
        let n = count + extra;
        for k in 0..n {
            let t = 0.5 + 1.5 * (std::f64::consts::PI * (k as f64 + 0.5) / n as f64).cos();
            nodes.extend(along.at(t)?.map(|y| (t, y)));
        }
        if nodes.len() >= count {
            break;
        }
    }
    nodes.truncate(count);
    let coefficients = interpolate(&nodes);
    let top = nodes.iter().fold(0.0f64, |m, (_, y)| m.max(y.abs()));
    if !(top > ZERO) {
        return Ok(SingularParameters::Everywhere);
    }
    let trimmed: Vec<f64> = {
        let last = coefficients.iter().rposition(|c| c.abs() > 1e-11 * top).map_or(0, |k| k + 1);
        coefficients[..last].to_vec()
    };
    let mut roots: Vec<f64> = Vec::new();
    for t in real_roots(&trimmed)? {
        // a zero of the denominators is not a zero of det A
        let growth = (1.0 + t.abs()).powf(degree as f64);
        let zero = along.at(t)?.is_some_and(|y| y.abs() <= 1e-7 * top * growth);
        if zero && !roots.iter().any(|r| (r - t).abs() <= 1e-7 * (1.0 + t.abs())) {
            roots.push(t);
        }
    }
    Ok(SingularParameters::At(roots))
}

/// Coefficients of the polynomial through the points (Newton's divided differences).
fn interpolate(nodes: &[(f64, f64)]) -> Vec<f64> {
    let n = nodes.len();
    let mut d: Vec<f64> = nodes.iter().map(|x| x.1).collect();
    for k in 1..n {
        for i in (k..n).rev() {
            d[i] = (d[i] - d[i - 1]) / (nodes[i].0 - nodes[i - k].0);
        }
    }
    let mut out = vec![0.0; n];
    for k in (0..n).rev() {
        // out <- out (t - t_k) + d_k
        let mut carry = 0.0;
        for c in &mut out {
            let shifted = carry - nodes[k].0 * *c;
            carry = *c;
            *c = shifted;
        }
        out[0] += d[k];
    }
    out
}

fn cubic(along: &RowDeterminant) -> Result<SingularParameters, LinalgError> {
    let step = 2.0 / LINES as f64;
    let mut values = Vec::new();
    for k in 0..=LINES {
        let t = (k as f64 + 0.25) * step;
        values.push((t, along.at(t)?));
    }
    let mut moderate: Vec<f64> = values.iter().filter_map(|x| x.1.map(f64::abs)).collect();
    moderate.sort_by(f64::total_cmp);
    // the determinant has poles, so its median measures its size and its largest value does not
    let Some(size) = moderate.get(moderate.len() / 2).copied().filter(|m| *m > ZERO) else {
        return Ok(SingularParameters::Everywhere);
    };
    let mut roots = Vec::new();
    for pair in values.windows(2) {
        let [(mut low, Some(y0)), (mut high, Some(y1))] = [pair[0], pair[1]] else { continue };
        if y0 * y1 > 0.0 {
            continue;
        }
        let mut last = y0.abs().min(y1.abs());
        for _ in 0..60 {
            let mid = 0.5 * (low + high);
            let Some(y) = along.at(mid)? else { break };
            last = y.abs();
            if y * y0 > 0.0 { low = mid } else { high = mid }
        }
        if last <= 1e-7 * size {
            roots.push((0.5 * (low + high)).rem_euclid(2.0));
        }
    }
    roots.sort_by(f64::total_cmp);
    Ok(SingularParameters::At(roots))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn interpolation_gives_the_coefficients_back() {
        let c = [1.0, -3.0, 0.5, 2.0];
        let value = |t: f64| c.iter().rev().fold(0.0, |s, x| s * t + x);
        let nodes: Vec<(f64, f64)> = [-1.0, 0.2, 0.7, 1.9].map(|t| (t, value(t))).to_vec();
        for (x, y) in interpolate(&nodes).iter().zip(c) {
            assert!((x - y).abs() < 1e-13);
        }
    }
}
