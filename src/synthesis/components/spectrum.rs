//! Ranks, kernels and least squares by singular values, and the record of each numerical decision.

use num::linalg::{LinalgError, svd};

/// Factor of the tolerance for kernels of computed polynomials and minors, which are accurate to a digit less than the
/// data.
pub(super) const COMPUTED: f64 = 10.0;
/// Parts of unit vectors below this add no dimension to a span of computed vectors.
pub(super) const NO_DIMENSION: f64 = 1e-7;
/// Unit homogeneous points and lines whose directions differ by less count as one: a double root is accurate to the
/// square root of rounding.
pub(super) const SAME: f64 = 1e-6;
/// First coordinate of a unit homogeneous point below which the point is at infinity.
pub(super) const AT_INFINITY: f64 = 1e-9;
/// Least distance of two joints for a line through them, in reaches of the joints.
pub(super) const APART: f64 = 1e-3;

/// Greatest distance of a leg or joint from a computed set that contains it, in sizes of the body.
pub(super) fn nearness(tolerance: f64) -> f64 {
    (COMPUTED * tolerance).max(1e-8)
}

/// Singular values and right singular vectors of a matrix with `n` columns.
#[derive(Debug, Clone)]
pub(crate) struct Spectrum {
    /// Singular values, largest first, padded with zeros to `n` entries.
    pub(crate) values: Vec<f64>,
    /// Right singular vectors, one per entry, in the order of `values`: an orthonormal basis of `R^n`.
    pub(crate) vectors: Vec<Vec<f64>>,
}

impl Spectrum {
    /// The spectrum of the matrix with these rows; without rows it is the zero matrix.
    pub(crate) fn of(rows: &[Vec<f64>], n: usize) -> Result<Self, LinalgError> {
        if rows.is_empty() || n == 0 {
            let unit = |k: usize| (0..n).map(|i| if i == k { 1.0 } else { 0.0 }).collect();
            return Ok(Self { values: vec![0.0; n], vectors: (0..n).map(unit).collect() });
        }
        let d = svd(rows)?;
        let mut values = d.s;
        values.resize(n, 0.0);
        let vectors = (0..n).map(|k| d.v.iter().map(|row| row[k]).collect()).collect();
        Ok(Self { values, vectors })
    }

    /// Number of singular values above `limit`.
    pub(crate) fn rank(&self, limit: f64) -> usize {
        self.values.iter().filter(|s| **s > limit).count()
    }

    /// Vectors that belong to all but the first `rank` singular values.
    pub(crate) fn kernel(&self, rank: usize) -> &[Vec<f64>] {
        &self.vectors[rank.min(self.vectors.len())..]
    }

    /// Vectors that belong to the first `rank` singular values.
    pub(crate) fn image(&self, rank: usize) -> &[Vec<f64>] {
        &self.vectors[..rank.min(self.vectors.len())]
    }
}

/// Inner product.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Euclidean norm.
pub(crate) fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

/// `a` over its norm; zero stays zero.
pub(crate) fn unit(a: &[f64]) -> Vec<f64> {
    let n = norm(a);
    if n > 0.0 { a.iter().map(|x| x / n).collect() } else { a.to_vec() }
}

/// The remainder of `a` without its parts along an orthonormal system.
pub(crate) fn without(a: &[f64], system: &[Vec<f64>]) -> Vec<f64> {
    let mut rest = a.to_vec();
    for _ in 0..2 {
        for e in system {
            let along = dot(&rest, e);
            rest.iter_mut().zip(e).for_each(|(x, y)| *x -= along * y);
        }
    }
    rest
}

/// An orthonormal basis of the span of `vectors`; remainders shorter than `limit` of their vector are left out.
pub(crate) fn orthonormal(vectors: &[Vec<f64>], limit: f64) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = Vec::new();
    for v in vectors {
        let rest = without(&unit(v), &basis);
        if norm(&rest) > limit {
            basis.push(unit(&rest));
        }
    }
    basis
}

/// The shortest `x` that minimises `|sum_k x_k columns_k - target|`, and that distance over `|target|`.
pub(crate) fn least_squares(columns: &[Vec<f64>], target: &[f64]) -> Result<(Vec<f64>, f64), LinalgError> {
    // rows of the transposed system: its left singular vectors are the coefficients
    let d = svd(columns)?;
    let top = d.s.first().copied().unwrap_or(0.0);
    let mut x = vec![0.0; columns.len()];
    for (k, s) in d.s.iter().enumerate().filter(|(_, s)| **s > 1e-14 * top) {
        let along: f64 = target.iter().zip(&d.v).map(|(t, row)| t * row[k]).sum::<f64>() / s;
        x.iter_mut().zip(&d.u).for_each(|(c, row)| *c += along * row[k]);
    }
    let mut rest = target.to_vec();
    for (c, column) in x.iter().zip(columns) {
        rest.iter_mut().zip(column).for_each(|(r, y)| *r -= c * y);
    }
    let size = norm(target);
    Ok((x, if size > 0.0 { norm(&rest) / size } else { 0.0 }))
}

/// Real roots of `c[0] + c[1] x + ..`; leading coefficients below `1e-13` of the largest are ignored.
pub(crate) fn real_roots(c: &[f64]) -> Result<Vec<f64>, LinalgError> {
    let size = c.iter().fold(0.0f64, |m, x| m.max(x.abs()));
    let Some(degree) = c.iter().rposition(|x| x.abs() > 1e-13 * size) else { return Ok(Vec::new()) };
    if degree == 0 || size <= 0.0 {
        return Ok(Vec::new());
    }
    let companion: Vec<Vec<f64>> = (0..degree)
        .map(|i| {
            let mut row: Vec<f64> = (0..degree).map(|j| if j + 1 == i { 1.0 } else { 0.0 }).collect();
            row[degree - 1] -= c[i] / c[degree];
            row
        })
        .collect();
    let roots = num::linalg::eigenvalues(&companion)?;
    // a double root appears as a pair with imaginary parts of the square root of rounding
    let near = |z: &f64, im: f64| im.abs() <= 1e-6 * (1.0 + z.abs());
    let mut real: Vec<f64> = roots.iter().filter(|z| near(&z.re, z.im)).map(|z| z.re).collect();
    real.sort_by(f64::total_cmp);
    Ok(real)
}

num::words! {
    /// The question of a numerical decision.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
    #[non_exhaustive]
    pub enum Question: name {
        /// Dimension of the flat that base joints span.
        BaseDimension = "base_dimension",
        /// Dimension of the flat that platform joints span.
        PlatformDimension = "platform_dimension",
        /// Rank of leg vectors.
        LegRank = "leg_rank",
        /// Rank of `M(a)` at a generic base point of the curve or flat below the family.
        RankOverBase = "rank_over_base",
        /// Rank of the transposed matrix at a generic platform point of the curve or flat below the family.
        RankOverPlatform = "rank_over_platform",
        /// Degree of the common factor of the minors of `M`.
        CommonFactor = "common_factor",
        /// Whether a curve contains a line: residual of the curve's equation on the line.
        LineFactor = "line_factor",
        /// Rank of the symmetric matrix of a conic.
        ConicRank = "conic_rank",
        /// Whether a curve has a singular point: size of the gradient.
        SingularPoint = "singular_point",
    }
}

/// One numerical decision with its gap.
///
/// The numbers are dimensionless: relative to the size of the body, to the largest singular value, or to the norm
/// of an equation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Decision {
    /// The question.
    pub question: Question,
    /// The answer used for the family.
    pub value: usize,
    /// The answer within the tolerance.
    pub numerical: usize,
    /// The answer of exact arithmetic on the doubles, if it was computed.
    pub exact: Option<usize>,
    /// The smallest number that counted as different from zero.
    pub above: Option<f64>,
    /// The largest number that counted as zero.
    pub below: Option<f64>,
    /// The limit between the two.
    pub tolerance: f64,
}

impl Decision {
    /// A rank from singular values (largest first); `value` is the numerical rank until [`taken`](Self::taken) changes
    /// it.
    pub(super) fn rank(question: Question, values: &[f64], scale: f64, tolerance: f64) -> Self {
        let relative: Vec<f64> = values.iter().map(|s| if scale > 0.0 { s / scale } else { 0.0 }).collect();
        let rank = relative.iter().filter(|s| **s > tolerance).count();
        Self {
            question,
            value: rank,
            numerical: rank,
            exact: None,
            above: rank.checked_sub(1).map(|k| relative[k]),
            below: relative.get(rank).copied(),
            tolerance,
        }
    }

    /// The same decision with the answer of exact arithmetic.
    pub(super) fn beside(mut self, exact: Option<usize>) -> Self {
        self.exact = exact;
        self
    }

    /// The same decision with `value` as the answer.
    pub(super) fn taken(mut self, value: usize) -> Self {
        self.value = value;
        self
    }

    /// Whether exact arithmetic gives the answer used; `None` if it was not computed.
    #[must_use]
    pub fn agrees(&self) -> Option<bool> {
        self.exact.map(|e| e == self.value)
    }
}
