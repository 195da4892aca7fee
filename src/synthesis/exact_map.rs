//! The leg map between platforms whose joints are known exactly, as exact numbers.
//!
//! A leg `(a, b)` is the vector `(1, a) (x) (1, b)` of `R^16`; `A` writes the vectors of TO as combinations of those of FROM, and
//! `c_i = |a'_i|^2 + |b'_i|^2 - sum_k A_ik (|a_k|^2 + |b_k|^2)`. Both platforms are equivalent if and only if `det A` is not zero.

use std::fmt::Write as _;

use crate::manipulator::{ExactEnds, squares_of_ends, vector_of_ends};
use crate::num::surd::{Surd, combination, eliminate};

/// `s(TO) = A s(FROM) + c` with exact numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ExactMap {
    /// `A`, by rows.
    pub(crate) a: Vec<Vec<Surd>>,
    /// `c`.
    pub(crate) c: Vec<Surd>,
    /// `det A`.
    pub(crate) determinant: Surd,
}

/// Why there is no map, decided without rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum NoExactMap {
    /// The legs of FROM are dependent.
    FromDependent,
    /// A leg of TO, from 0, is not in the span of those of FROM.
    OutOfSpan(usize),
    /// Numbers become too long: nothing is decided.
    TooLong,
}

impl ExactMap {
    /// The map from six legs to six others.
    pub(crate) fn between(from: &[ExactEnds; 6], to: &[ExactEnds; 6]) -> Result<Self, NoExactMap> {
        let [old, new] = [from, to].map(|legs| legs.iter().map(vector_of_ends).collect::<Option<Vec<_>>>());
        let (old, new) = (old.ok_or(NoExactMap::TooLong)?, new.ok_or(NoExactMap::TooLong)?);
        // one row for each of the 16 coordinates: the six of FROM, then the six of TO
        let mut rows: Vec<Vec<Surd>> =
            (0..16).map(|k| old.iter().chain(&new).map(|v| v[k].clone()).collect()).collect();
        if eliminate(&mut rows, 6).ok_or(NoExactMap::TooLong)? < 6 {
            return Err(NoExactMap::FromDependent);
        }
        if let Some(leg) = (0..6).find(|i| rows[6..].iter().any(|row| !row[6 + i].is_zero())) {
            return Err(NoExactMap::OutOfSpan(leg));
        }
        let a: Vec<Vec<Surd>> = (0..6).map(|i| (0..6).map(|k| rows[k][6 + i].clone()).collect()).collect();
        let map = || -> Option<Self> {
            let c = (0..6).map(|i| {
                let taken = combination(
                    &a[i],
                    &from.each_ref().map(squares_of_ends).into_iter().collect::<Option<Vec<_>>>()?,
                )?;
                squares_of_ends(&to[i])?.minus(&taken)
            });
            Some(Self { c: c.collect::<Option<_>>()?, determinant: determinant(&a)?, a: a.clone() })
        };
        let map = map().ok_or(NoExactMap::TooLong)?;
        let holds = map.holds(&old, &new).ok_or(NoExactMap::TooLong)?;
        // elimination and this sum are different ways to the same identity
        if holds { Ok(map) } else { Err(NoExactMap::TooLong) }
    }

    /// The columns of `1 - t` and of `t` where row `i` is these beside zeros.
    fn share_columns(&self, i: usize) -> Option<(usize, usize)> {
        let (zero, one) = (Surd::zero(), Surd::integer(1));
        let filled: Vec<usize> = (0..6).filter(|k| self.a[i][*k] != zero).collect();
        let (first, second) = match filled[..] {
            [j, k] if self.a[i][j].plus(&self.a[i][k])? == one => (j, k),
            _ => return None,
        };
        // in the circulant order of the legs a leg has its own number first
        Some(if second == i { (second, first) } else { (first, second) })
    }

    /// The determinant with rows that have a single one each, in the columns given, in the place of those of `A`.
    fn determinant_with(&self, columns: &[(usize, usize)]) -> Option<Surd> {
        let mut a = self.a.clone();
        for (i, column) in columns {
            a[*i] = (0..6).map(|l| Surd::integer(i64::from(l == *column))).collect();
        }
        determinant(&a)
    }

    /// The share `t` for which the determinant vanishes when row `i` is `1 - t` and `t` beside zeros: `det A` is affine in `t`.
    pub(crate) fn singular_share(&self, i: usize) -> Option<Surd> {
        let (own, other) = self.share_columns(i)?;
        let at = |k: usize| self.determinant_with(&[(i, k)]);
        let start = at(own)?;
        start.times(&start.minus(&at(other)?)?.inverse()?)
    }

    /// `det A` for all shares `t1` to `t6` at once, of the rows that are `1 - t` and `t` beside zeros, the other rows as they stand: a sum of products of `(1 - t)` and `t`, since the determinant is affine in
    /// each row. Its zeros are the singular ones of the platforms whose leg ends stay on the same edges. `None` where there is no such row, or a number becomes too long.
    pub(crate) fn determinant_of_shares(&self) -> Option<String> {
        let free: Vec<(usize, (usize, usize))> =
            (0..6).filter_map(|i| Some((i, self.share_columns(i)?))).collect();
        if free.is_empty() {
            return None;
        }
        let mut text = String::new();
        for choice in 0..1_usize << free.len() {
            let moved = |k: usize| choice >> k & 1 == 1;
            let columns: Vec<(usize, usize)> = free
                .iter()
                .enumerate()
                .map(|(k, (i, (own, other)))| (*i, if moved(k) { *other } else { *own }))
                .collect();
            let number = self.determinant_with(&columns)?;
            if number.is_zero() {
                continue;
            }
            let factor = |(k, (i, _)): (usize, &(usize, (usize, usize)))| {
                if moved(k) { format!("t{}", i + 1) } else { format!("(1 - t{})", i + 1) }
            };
            let product = free.iter().enumerate().map(factor).collect::<Vec<_>>().join(" ");
            let number = number.to_string();
            let (sign, size) = match number.strip_prefix('-') {
                Some(rest) if !number.contains(' ') => ("-", rest),
                _ => ("+", number.as_str()),
            };
            let size = match size {
                "1" => String::new(),
                sum if sum.contains(' ') => format!("({sum}) "),
                one => format!("{one} "),
            };
            let _ = match (text.is_empty(), sign) {
                (true, "+") => write!(text, "{size}{product}"),
                (true, _) => write!(text, "-{size}{product}"),
                (false, sign) => write!(text, " {sign} {size}{product}"),
            };
        }
        // no choice gives a regular matrix: singular whatever the shares are
        Some(if text.is_empty() { "0".into() } else { text })
    }

    /// Whether every vector of TO is the sum that `A` says, entry by entry.
    fn holds(&self, old: &[Vec<Surd>], new: &[Vec<Surd>]) -> Option<bool> {
        for (row, w) in self.a.iter().zip(new) {
            for (k, entry) in w.iter().enumerate() {
                let column: Vec<Surd> = old.iter().map(|v| v[k].clone()).collect();
                if combination(row, &column)? != *entry {
                    return Some(false);
                }
            }
        }
        Some(true)
    }
}

fn determinant(a: &[Vec<Surd>]) -> Option<Surd> {
    let mut rows = a.to_vec();
    let mut product = Surd::integer(1);
    for column in 0..rows.len() {
        let Some(pivot) = (column..rows.len()).find(|i| !rows[*i][column].is_zero()) else {
            return Some(Surd::zero());
        };
        if pivot != column {
            rows.swap(pivot, column);
            product = product.negated();
        }
        product = product.times(&rows[column][column])?;
        let inverse = rows[column][column].inverse()?;
        let (above, below) = rows.split_at_mut(column + 1);
        for row in below {
            let factor = row[column].times(&inverse)?;
            for (x, h) in row.iter_mut().zip(&above[column]).skip(column) {
                *x = x.minus(&factor.times(h)?)?;
            }
        }
    }
    Some(product)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn surd(n: i64, d: i64) -> Surd {
        Surd::integer(n).times(&Surd::integer(d).inverse().unwrap()).unwrap()
    }

    fn between(a: &[Surd; 3], b: &[Surd; 3], t: &Surd) -> [Surd; 3] {
        [0, 1, 2].map(|i| a[i].plus(&t.times(&b[i].minus(&a[i]).unwrap()).unwrap()).unwrap())
    }

    /// Corners of the paper's octahedral platform, with `h = sqrt 3`.
    fn corners() -> [[Surd; 3]; 6] {
        let h = Surd::integer(3).sqrt().unwrap();
        let point = |x: i64, y: i64| [Surd::integer(x), h.times(&Surd::integer(y)).unwrap(), Surd::zero()];
        [point(0, 0), point(6, 6), point(12, 0), point(0, 0), point(6, 0), point(3, -3)]
    }

    /// Legs `P1P4, P2P4, P2P5, P3P5, P3P6, P1P6`, each moved along its side by its offset.
    fn slid(t: &[Surd; 6]) -> [ExactEnds; 6] {
        let p = corners();
        let ends = [(0, 3), (1, 3), (1, 4), (2, 4), (2, 5), (0, 5), (0, 3)];
        std::array::from_fn(|k| {
            let ((a, b), (c, d)) = (ends[k], ends[k + 1]);
            [between(&p[a], &p[c], &t[k]), between(&p[b], &p[d], &t[k])]
        })
    }

    #[test]
    fn the_determinant_of_the_joint_free_platform_is_a_fraction() {
        let octahedral = slid(&std::array::from_fn(|_| Surd::zero()));
        let t = [1, 2, 3, 1, 2, 4].map(|n| surd(n, 5));
        let map = ExactMap::between(&octahedral, &slid(&t)).unwrap();
        let one = Surd::integer(1);
        let product = |list: Vec<Surd>| list.iter().fold(one.clone(), |p, x| p.times(x).unwrap());
        let complement = t.iter().map(|t| one.minus(t).unwrap()).collect();
        let expected = product(complement).minus(&product(t.to_vec())).unwrap();
        assert_eq!(map.determinant, expected);
        for k in 0..6 {
            assert_eq!(map.a[k][k], one.minus(&t[k]).unwrap());
            assert_eq!(map.a[k][(k + 1) % 6], t[k]);
            // -t (1 - t) d^2 with the edges 12 and 6
            let d = Surd::integer(if k % 2 == 0 { 144 } else { 36 });
            let c = t[k].times(&one.minus(&t[k]).unwrap()).unwrap().times(&d).unwrap().negated();
            assert_eq!(map.c[k], c);
            // (1 - x) prod (1 - t) = x prod t over the other legs
            let others =
                |f: &dyn Fn(&Surd) -> Surd| product((0..6).filter(|l| *l != k).map(|l| f(&t[l])).collect());
            let (stay, pass) = (others(&|t| one.minus(t).unwrap()), others(&Surd::clone));
            let singular = stay.times(&stay.plus(&pass).unwrap().inverse().unwrap()).unwrap();
            assert_eq!(map.singular_share(k), Some(singular));
        }
    }

    /// All offsets at once: legs that stay have no share, and the polynomial is zero where the platform is singular.
    #[test]
    fn the_singular_offsets_are_the_zeros_of_one_polynomial() {
        let octahedral = slid(&std::array::from_fn(|_| Surd::zero()));
        let of = |t: [i64; 6]| {
            let map = ExactMap::between(&octahedral, &slid(&t.map(|n| surd(n, 5)))).unwrap();
            (map.determinant_of_shares(), map.determinant)
        };
        let all = "(1 - t1) (1 - t2) (1 - t3) (1 - t4) (1 - t5) (1 - t6) - t1 t2 t3 t4 t5 t6";
        assert_eq!(of([1, 2, 3, 1, 2, 4]).0.as_deref(), Some(all));
        // each t beside its 1 - t: the same polynomial, and zero
        let (polynomial, determinant) = of([1, 4, 2, 3, 1, 4]);
        assert_eq!((polynomial.as_deref(), determinant.is_zero()), (Some(all), true));
        // with one leg where it was the product of the shares is zero, and only a share of one is singular
        assert_eq!(of([0, 2, 3, 1, 0, 4]).0.as_deref(), Some("(1 - t2) (1 - t3) (1 - t4) (1 - t6)"));
        assert_eq!(of([0; 6]), (None, Surd::integer(1)));
    }

    #[test]
    fn singular_and_unrelated_platforms_are_told_exactly() {
        let octahedral = slid(&std::array::from_fn(|_| Surd::zero()));
        let half = slid(&std::array::from_fn(|_| surd(1, 2)));
        let map = ExactMap::between(&octahedral, &half).unwrap();
        assert!(map.determinant.is_zero());
        assert_eq!(ExactMap::between(&half, &octahedral), Err(NoExactMap::FromDependent));
        let mut off = slid(&[1, 2, 3, 1, 2, 4].map(|n| surd(n, 5)));
        off[4][0][2] = surd(1, 1_000_000_000_000);
        assert_eq!(ExactMap::between(&octahedral, &off), Err(NoExactMap::OutOfSpan(4)));
    }
}
