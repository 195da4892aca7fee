//! Approximate inverse of the complex 7 x 7 Jacobian.

use super::system::N;

/// Rows of a 7 x 7 matrix padded to eight lanes, parts apart.
#[derive(Debug, Clone, Copy)]
pub(super) struct PaddedMatrix {
    pub(super) re: [[f64; 8]; N],
    pub(super) im: [[f64; 8]; N],
}

/// Inverse by Gauss-Jordan elimination in place with row pivoting, `None` at a pivot that is zero or not finite.
///
/// No accuracy is claimed: `I - Y J` is bounded afterwards with the result.
pub(super) fn approximate_inverse(re: &[[f64; 8]; N], im: &[[f64; 8]; N]) -> Option<PaddedMatrix> {
    let mut m = PaddedMatrix { re: *re, im: *im };
    let mut swapped = [0; N];
    for p in 0..N {
        let size = |r: usize| m.re[r][p] * m.re[r][p] + m.im[r][p] * m.im[r][p];
        let mut best = p;
        for r in p + 1..N {
            if size(r) > size(best) {
                best = r;
            }
        }
        let norm = size(best);
        if !norm.is_normal() {
            return None;
        }
        m.re.swap(p, best);
        m.im.swap(p, best);
        swapped[p] = best;
        let (pr, pi) = (m.re[p][p] / norm, -m.im[p][p] / norm);
        (m.re[p][p], m.im[p][p]) = (1.0, 0.0);
        let (row_re, row_im) = multiply(&m.re[p], &m.im[p], pr, pi);
        (m.re[p], m.im[p]) = (row_re, row_im);
        for r in 0..N {
            if r != p {
                let (fr, fi) = (m.re[r][p], m.im[r][p]);
                (m.re[r][p], m.im[r][p]) = (0.0, 0.0);
                subtract(&mut m.re[r], &mut m.im[r], &row_re, &row_im, fr, fi);
            }
        }
    }
    for p in (0..N).rev() {
        for row in m.re.iter_mut().chain(&mut m.im) {
            row.swap(p, swapped[p]);
        }
    }
    Some(m)
}

/// [`approximate_inverse`] after scaling rows and columns by powers of two, for matrices with entries of very different
/// size.
pub(super) fn equilibrated_inverse(re: &[[f64; 8]; N], im: &[[f64; 8]; N]) -> Option<PaddedMatrix> {
    let unit = |x: f64| if x.is_normal() { 2f64.powi(-(x.log2().floor() as i32)) } else { 1.0 };
    let size = |i: usize, k: usize| re[i][k].abs().max(im[i][k].abs());
    let rows: [f64; N] = std::array::from_fn(|i| unit((0..N).map(|k| size(i, k)).fold(0.0, f64::max)));
    let columns: [f64; N] =
        std::array::from_fn(|k| unit((0..N).map(|i| size(i, k) * rows[i]).fold(0.0, f64::max)));
    let scaled = |m: &[[f64; 8]; N]| -> [[f64; 8]; N] {
        std::array::from_fn(|i| {
            std::array::from_fn(|k| if k < N { m[i][k] * rows[i] * columns[k] } else { 0.0 })
        })
    };
    let mut y = approximate_inverse(&scaled(re), &scaled(im))?;
    for k in 0..N {
        for i in 0..N {
            y.re[k][i] *= columns[k] * rows[i];
            y.im[k][i] *= columns[k] * rows[i];
        }
    }
    Some(y)
}

/// `Y` for the equations themselves from that for `F_0`, `F_i - F_0`, `F_6`.
pub(super) fn apart(y: &PaddedMatrix) -> PaddedMatrix {
    let mut whole = *y;
    for row in whole.re.iter_mut().chain(&mut whole.im) {
        row[0] -= row[1] + row[2] + row[3] + row[4] + row[5];
    }
    whole
}

fn multiply(re: &[f64; 8], im: &[f64; 8], fr: f64, fi: f64) -> ([f64; 8], [f64; 8]) {
    (std::array::from_fn(|j| re[j] * fr - im[j] * fi), std::array::from_fn(|j| re[j] * fi + im[j] * fr))
}

/// `row -= f * other`.
pub(super) fn subtract(
    re: &mut [f64; 8],
    im: &mut [f64; 8],
    other_re: &[f64; 8],
    other_im: &[f64; 8],
    fr: f64,
    fi: f64,
) {
    for j in 0..8 {
        re[j] -= other_re[j] * fr - other_im[j] * fi;
        im[j] -= other_re[j] * fi + other_im[j] * fr;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::Rng;

    #[test]
    fn the_product_with_the_matrix_is_the_identity() {
        let mut rng = Rng::new(41);
        let mut draw =
            || std::array::from_fn(|_| std::array::from_fn(|j| if j < 7 { rng.normal() } else { 0.0 }));
        let (re, mut im): ([[f64; 8]; N], [[f64; 8]; N]) = (draw(), draw());
        let y = approximate_inverse(&re, &im).unwrap();
        for k in 0..N {
            let (mut row_re, mut row_im) = ([0.0; 8], [0.0; 8]);
            row_re[k] = 1.0;
            for i in 0..N {
                subtract(&mut row_re, &mut row_im, &re[i], &im[i], y.re[k][i], y.im[k][i]);
            }
            assert!(row_re.iter().chain(&row_im).all(|x| x.abs() < 1e-12), "{row_re:?} {row_im:?}");
        }
        let mut singular = re;
        (singular[2], im[2]) = ([0.0; 8], [0.0; 8]);
        assert!(approximate_inverse(&singular, &im).is_none());
    }
}
