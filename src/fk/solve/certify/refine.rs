//! Newton's method in double-double: residuals in double-double, corrections from the inverse in double.
//!
//! Each correction adds about `16 - log10(condition)` digits (mixed-precision refinement, Higham 2002, ch. 12). The
//! rounding of the residual stops it near `2^-102` times the condition number.

use num_complex::Complex64;

use super::certificate::WhyUncertified;
use super::inverse::equilibrated_inverse;
use super::system::{LegSystem, N, RealScalar, Study};
use num::double_double::{ComplexDoubleDouble, DoubleDouble};
use platform::geom::ComplexPose;

/// Corrections after which an iteration that has not settled is given up.
const MAX_STEPS: u32 = 60;

/// A pose refined to double-double. It is an approximation, not a proof: certify [`pose`](Self::pose).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RefinedPose {
    /// Rotation matrix.
    pub rotation: [[ComplexDoubleDouble; 3]; 3],
    /// Position, design units.
    pub position: [ComplexDoubleDouble; 3],
    /// Distance from the pose given, in Study coordinates with lengths in units of the data's order of magnitude.
    pub moved: f64,
    /// Length of the last correction, same coordinates: an estimate of the error.
    pub last_step: f64,
    /// Corrections made.
    pub steps: u32,
}

impl RefinedPose {
    /// The nearest pose in doubles.
    #[must_use]
    pub fn pose(&self) -> ComplexPose {
        ComplexPose {
            rotation: nalgebra::Matrix3::from_fn(|i, j| self.rotation[i][j].hi()),
            position: nalgebra::Vector3::from_fn(|i, _| self.position[i].hi()),
        }
    }
}

/// The end of the iteration.
pub(super) struct RefinedRoot {
    pub(super) x: Study<DoubleDouble>,
    pub(super) moved: f64,
    pub(super) last_step: f64,
    pub(super) steps: u32,
}

/// `Y F(x)`, coordinate by coordinate (zero for the patch).
fn newton_step(system: &LegSystem, x: &Study<DoubleDouble>) -> Result<[Complex64; 8], WhyUncertified> {
    let [re, im] = system.jacobian_apart(&x.rounded());
    let y = equilibrated_inverse(&re, &im).ok_or(WhyUncertified::SingularJacobian)?;
    let (f_re, f_im) = system.values_apart(x);
    let f: [Complex64; N] = std::array::from_fn(|i| Complex64::new(f_re[i].rounded(), f_im[i].rounded()));
    let mut step = [Complex64::ZERO; 8];
    for k in 0..N {
        let coordinate = if k == x.patch { 7 } else { k };
        step[coordinate] = (0..N).map(|i| Complex64::new(y.re[k][i], y.im[k][i]) * f[i]).sum();
    }
    Ok(step)
}

/// Newton from `start` until the corrections are rounding, moving no further than `near`.
pub(super) fn refine_study(
    system: &LegSystem,
    start: &Study<f64>,
    near: f64,
) -> Result<RefinedRoot, WhyUncertified> {
    let mut x = start.lifted();
    let mut previous = f64::INFINITY;
    for steps in 1..=MAX_STEPS {
        let step = newton_step(system, &x)?;
        let length = step.iter().map(|z| z.norm()).fold(0.0, f64::max);
        if !length.is_finite() {
            return Err(WhyUncertified::Inaccurate { step: length });
        }
        for k in 0..8 {
            x.re[k] = x.re[k] - step[k].re.into();
            x.im[k] = x.im[k] - step[k].im.into();
        }
        let size = (0..8).map(|k| x.re[k].rounded().hypot(x.im[k].rounded())).fold(0.0, f64::max);
        let moved = (0..8)
            .map(|k| (x.re[k].rounded() - start.re[k]).hypot(x.im[k].rounded() - start.im[k]))
            .fold(0.0, f64::max);
        if moved > near {
            return Err(WhyUncertified::Inaccurate { step: moved });
        }
        // settled: below the unit of double-double, or no longer shrinking where only rounding is left
        let settled = length <= 2f64.powi(-102) * size || (length < 1e-12 * size && length > 0.9 * previous);
        if settled {
            return Ok(RefinedRoot { x, moved, last_step: length, steps });
        }
        previous = length;
    }
    Err(WhyUncertified::Inaccurate { step: previous })
}
