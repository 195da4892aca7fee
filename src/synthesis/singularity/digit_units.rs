//! The coordinates that plain numbers may be rounded from.

use nalgebra::{Point3, Vector3};

use super::nearest::Change;
use platform::manipulator::{Level, Manipulator};

/// Digits of a greater share of the size than this belong to the design and are no rounding.
const COARSE: f64 = 1.0 / 512.0;
/// Rounds of weights before the largest change counts as minimal.
const ROUNDS: usize = 40;
/// The least weight, so that scales stay comparable.
const LEAST_WEIGHT: f64 = 1e-6;

/// Half a unit of the last given digit of every coordinate, design units.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct DigitUnits {
    pub(super) base: Vec<Vector3<f64>>,
    pub(super) platform: Vec<Vector3<f64>>,
}

impl DigitUnits {
    /// The ways in which the plain coordinates may have been rounded: to equal decimals, and to equal significant
    /// digits. Units that are a large share of the design are left out, since such numbers are no rounded values.
    pub(super) fn given(m: &Manipulator) -> Vec<Self> {
        if m.level() != Level::DoublesAsWritten {
            return Vec::new();
        }
        let legs = m.legs();
        let used = || legs.iter().flat_map(|leg| [leg.base, leg.platform]).flat_map(|p| [p.x, p.y, p.z]);
        let forms: Vec<(i32, i32)> = used().filter(|x| *x != 0.0).map(decimal_form).collect();
        let decimals = forms.iter().map(|(digits, exponent)| digits - 1 - exponent).max().unwrap_or(0).max(0);
        let digits = forms.iter().map(|form| form.0).max().unwrap_or(0);
        // rounding to significant digits leaves most coordinates with all of them, or with a last zero less
        let long = forms.iter().filter(|form| form.0 + 1 >= digits).count();
        let of = |half: &dyn Fn(f64) -> f64| {
            let joints = |list: &[Point3<f64>]| list.iter().map(|p| p.coords.map(half)).collect();
            Self { base: joints(m.base_joints()), platform: joints(m.platform_joints()) }
        };
        let mut found = vec![of(&|_| half_unit(decimals))];
        if 2 * long > forms.len() {
            found.push(of(&|x| if x == 0.0 { 0.0 } else { half_unit(digits - 1 - decimal_form(x).1) }));
        }
        found.retain(|units| units.largest() <= COARSE * m.size());
        found
    }

    fn all(&self) -> impl Iterator<Item = &Vector3<f64>> {
        self.base.iter().chain(&self.platform)
    }

    pub(super) fn largest(&self) -> f64 {
        self.all().map(Vector3::amax).fold(0.0, f64::max)
    }

    /// The greatest distance of a design within these units.
    pub(super) fn reach(&self) -> f64 {
        self.all().map(Vector3::norm_squared).sum::<f64>().sqrt()
    }

    /// The changes by `least` with no coordinate beyond its unit, if there are some. `least` gives the least changes,
    /// each coordinate measured in its scale.
    ///
    /// The scales start as the units. They shrink where changes are large, so that the largest change falls to its
    /// minimum (Lawson's algorithm for Chebyshev approximation, 1961). Changes within their units have a weighted sum
    /// of squares below the sum of the weights, so that a greater least sum excludes them.
    pub(super) fn contained(&self, least: impl Fn(&Self) -> Option<Change>) -> Option<Change> {
        let mut weights = vec![1.0; 3 * self.all().count()];
        for _ in 0..ROUNDS {
            let change = least(&self.scaled(&weights))?;
            if self.contain(&change) {
                return Some(change);
            }
            let ratios = self.ratios(&change);
            let squares: f64 = ratios.iter().zip(&weights).map(|(r, w)| w * r * r).sum();
            if !(squares <= weights.iter().sum()) {
                return None;
            }
            weights.iter_mut().zip(&ratios).for_each(|(w, r)| *w *= r);
            let most = weights.iter().copied().fold(0.0, f64::max);
            for w in &mut weights {
                *w = (*w / most).max(LEAST_WEIGHT);
            }
        }
        None
    }

    /// Scales of coordinates with weights for the squares of changes in these units.
    fn scaled(&self, weights: &[f64]) -> Self {
        let mut scales = self.clone();
        let all = scales.base.iter_mut().chain(&mut scales.platform).flat_map(|v| v.iter_mut());
        all.zip(weights).for_each(|(half, weight)| *half /= weight.sqrt());
        scales
    }

    /// The changes of all coordinates in these units, without sign; coordinates without a unit have none.
    fn ratios(&self, change: &Change) -> Vec<f64> {
        let changes = change.base.iter().chain(&change.platform).flat_map(Vector3::iter);
        let halves = self.all().flat_map(Vector3::iter);
        changes.zip(halves).map(|(x, half)| if *half > 0.0 { x.abs() / half } else { 0.0 }).collect()
    }

    /// Whether no coordinate changes by more.
    pub(super) fn contain(&self, change: &Change) -> bool {
        let changes = change.base.iter().chain(&change.platform);
        changes.zip(self.all()).all(|(by, half)| by.iter().zip(half.iter()).all(|(x, h)| x.abs() <= *h))
    }
}

pub(super) fn half_unit(decimals: i32) -> f64 {
    0.5 * 10f64.powi(-decimals)
}

/// Number of significant digits, and exponent of the first one, of the shortest decimal that is read as this double.
fn decimal_form(x: f64) -> (i32, i32) {
    let text = format!("{x:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, ""));
    let count = digits.bytes().filter(u8::is_ascii_digit).count();
    (i32::try_from(count).unwrap_or(0), exponent.parse().unwrap_or(0))
}
