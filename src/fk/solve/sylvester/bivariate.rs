//! Polynomials in `c_1, c_2` up to degree six, complex double-double coefficients.

use num::double_double::ComplexDoubleDouble as Number;

/// Highest degree that occurs.
const DEGREE: usize = 6;

/// Number of monomials up to degree `d`.
pub(super) const fn count(d: usize) -> usize {
    (d + 1) * (d + 2) / 2
}

/// Place of `c_1^i c_2^j`: by degree, then by the power of `c_2`.
pub(super) const fn place(i: usize, j: usize) -> usize {
    (i + j) * (i + j + 1) / 2 + j
}

/// A polynomial of known degree bound.
#[derive(Debug, Clone, Copy)]
pub(super) struct Bivariate {
    degree: usize,
    c: [Number; count(DEGREE)],
}

impl Bivariate {
    pub(super) const ZERO: Self = Self { degree: 0, c: [Number::ZERO; count(DEGREE)] };

    /// `z c_1^i c_2^j`.
    pub(super) fn monomial(z: Number, i: usize, j: usize) -> Self {
        let mut out = Self { degree: i + j, ..Self::ZERO };
        out.c[place(i, j)] = z;
        out
    }

    pub(super) fn at(&self, i: usize, j: usize) -> Number {
        self.c[place(i, j)]
    }

    /// Coefficients up to degree `d`.
    pub(super) fn up_to(&self, d: usize) -> &[Number] {
        &self.c[..count(d)]
    }

    pub(super) fn plus(&self, other: &Self) -> Self {
        let mut out = *self;
        out.degree = self.degree.max(other.degree);
        for (x, y) in out.c.iter_mut().zip(&other.c).take(count(out.degree)) {
            *x = *x + *y;
        }
        out
    }

    pub(super) fn minus(&self, other: &Self) -> Self {
        self.plus(&other.times(-Number::from(num_complex::Complex64::ONE)))
    }

    pub(super) fn times(&self, z: Number) -> Self {
        let mut out = *self;
        for x in &mut out.c[..count(self.degree)] {
            *x = *x * z;
        }
        out
    }

    /// Product with `c_1^a c_2^b`.
    pub(super) fn shifted(&self, a: usize, b: usize) -> Self {
        let mut out = Self { degree: self.degree + a + b, ..Self::ZERO };
        for d in 0..=self.degree {
            for j in 0..=d {
                out.c[place(d - j + a, j + b)] = self.at(d - j, j);
            }
        }
        out
    }

    pub(super) fn product(&self, other: &Self) -> Self {
        let mut out = Self { degree: self.degree + other.degree, ..Self::ZERO };
        for d in 0..=self.degree {
            for j in 0..=d {
                let x = self.at(d - j, j);
                for e in 0..=other.degree {
                    for k in 0..=e {
                        let target = &mut out.c[place(d - j + e - k, j + k)];
                        *target = *target + x * other.at(e - k, k);
                    }
                }
            }
        }
        out
    }

    /// Value at a point.
    pub(super) fn value(&self, x: Number, y: Number) -> Number {
        let mut sum = Number::ZERO;
        for d in (0..=self.degree).rev() {
            // Horner in the scale of the point: sum = sum_d (forms of degree d)
            let mut form = Number::ZERO;
            for j in 0..=d {
                let mut term = self.at(d - j, j);
                for _ in 0..d - j {
                    term = term * x;
                }
                for _ in 0..j {
                    term = term * y;
                }
                form = form + term;
            }
            sum = sum + form;
        }
        sum
    }

    /// The same with everything above degree `d` left out, where it vanishes identically.
    pub(super) fn truncated(&self, d: usize) -> Self {
        let mut out = Self { degree: d.min(self.degree), ..*self };
        out.c[count(d)..].fill(Number::ZERO);
        out
    }

    /// Replaces the monomials of degree six and five by `lower[n] = c_1^(5-n) c_2^n`, of degree four.
    pub(super) fn reduced(&self, lower: &[Self; 6]) -> Self {
        let mut p = *self;
        if p.degree == 6 {
            for j in 0..=6 {
                let z = p.at(6 - j, j);
                let times_last = j == 6;
                let (n, shift) = if times_last { (5, (0, 1)) } else { (j, (1, 0)) };
                p.c[place(6 - j, j)] = Number::ZERO;
                p = p.plus(&lower[n].times(z).shifted(shift.0, shift.1));
            }
            p.degree = 5;
        }
        if p.degree == 5 {
            let top: [Number; 6] = std::array::from_fn(|n| p.at(5 - n, n));
            p = p.truncated(4);
            for (z, l) in top.into_iter().zip(lower) {
                p = p.plus(&l.times(z));
            }
        }
        p
    }
}
