//! Decompositions of small matrices in a bounded number of steps.
//!
//! The iterations of `nalgebra` have no bound by default, and entries whose products fall below the range of doubles can keep them going for ever.

use nalgebra::allocator::Allocator;
use nalgebra::{
    DefaultAllocator, Dim, DimDiff, DimMin, DimMinimum, DimSub, Matrix3, OMatrix, OVector, SVD, U1, Vector3,
};

/// Entries below this, relative to the largest one, are left out: no sum with it can hold them.
const LEAST: f64 = 1e-100;
/// Steps after which an iteration is given up; ten are usual.
const STEPS: usize = 1000;
/// As `nalgebra` has it.
const SETTLED: f64 = 5.0 * f64::EPSILON;

fn held<R: Dim, C: Dim>(m: &OMatrix<f64, R, C>) -> OMatrix<f64, R, C>
where
    DefaultAllocator: Allocator<R, C>,
{
    let least = LEAST * m.iter().fold(0.0, |x: f64, y| x.max(y.abs()));
    m.map(|x| if x.abs() < least { 0.0 } else { x })
}

/// Singular value decomposition with both bases, largest value first; `None` for entries that are not finite.
pub(crate) fn bounded_svd<R: DimMin<C>, C: Dim>(m: &OMatrix<f64, R, C>) -> Option<SVD<f64, R, C>>
where
    DimMinimum<R, C>: DimSub<U1>,
    DefaultAllocator: Allocator<R, C>
        + Allocator<C>
        + Allocator<R>
        + Allocator<DimDiff<DimMinimum<R, C>, U1>>
        + Allocator<DimMinimum<R, C>, C>
        + Allocator<R, DimMinimum<R, C>>
        + Allocator<DimMinimum<R, C>>,
{
    if m.iter().any(|x| !x.is_finite()) {
        return None;
    }
    held(m).try_svd(true, true, SETTLED, STEPS)
}

/// Singular values, largest first; `None` for entries that are not finite.
pub(crate) fn singular_values<R: DimMin<C>, C: Dim>(
    m: &OMatrix<f64, R, C>,
) -> Option<OVector<f64, DimMinimum<R, C>>>
where
    DimMinimum<R, C>: DimSub<U1>,
    DefaultAllocator: Allocator<R, C>
        + Allocator<C>
        + Allocator<R>
        + Allocator<DimDiff<DimMinimum<R, C>, U1>>
        + Allocator<DimMinimum<R, C>, C>
        + Allocator<R, DimMinimum<R, C>>
        + Allocator<DimMinimum<R, C>>,
{
    if m.iter().any(|x| !x.is_finite()) {
        return None;
    }
    held(m).try_svd(false, false, SETTLED, STEPS).map(|d| d.singular_values)
}

/// Eigenvalues, in no order, and eigenvectors, as columns, of a symmetric matrix. Of one with entries that are not finite: zeros, and the axes.
pub(crate) fn symmetric_eigen3(m: &Matrix3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let none = (Vector3::zeros(), Matrix3::identity());
    if m.iter().any(|x| !x.is_finite()) {
        return none;
    }
    held(m).try_symmetric_eigen(f64::EPSILON, STEPS).map_or(none, |e| (e.eigenvalues, e.eigenvectors))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::num::Rng;
    use nalgebra::Matrix6;

    #[test]
    fn decompositions_are_those_of_the_library_and_end_whatever_the_entries() {
        let mut rng = Rng::new(5);
        for k in 0..400 {
            let m = Matrix6::from_fn(|_, _| rng.normal());
            assert_eq!(singular_values(&m).unwrap(), m.singular_values());
            let s = Matrix3::from_fn(|_, _| rng.normal());
            let s = s + s.transpose();
            assert_eq!(symmetric_eigen3(&s).0, s.symmetric_eigen().eigenvalues);
            // half of the entries from nothing to the least number there is
            let mut small = || if rng.unit() < 0.5 { 0.0 } else { 5e-324 * (rng.next_u64() % 9) as f64 };
            let tiny = Matrix6::from_fn(|i, j| if (i + j + k) % 3 == 0 { 3.0 } else { small() });
            let d = bounded_svd(&tiny).unwrap();
            assert!((d.recompose().unwrap() - tiny).amax() < 1e-13);
            let v = Matrix3::from_fn(|i, j| if i == j && i != k % 3 { 2.0 } else { small() });
            assert!(symmetric_eigen3(&(v + v.transpose())).0.amax() < 4.0 + 1e-13);
        }
        let broken = Matrix6::from_element(f64::NAN);
        assert!(bounded_svd(&broken).is_none() && singular_values(&broken).is_none());
    }
}
