//! The leg map between platforms with exactly known joints, in exact numbers.
//!
//! A leg `(a, b)` is the vector `(1, a) (x) (1, b)` of `R^16`; `A` writes the vectors of TO as combinations of those of
//! FROM, and `c_i = |a'_i|^2 + |b'_i|^2 - sum_k A_ik (|a_k|^2 + |b_k|^2)`. The platforms are equivalent if and only if
//! three conditions hold. The legs of FROM are independent, those of TO are independent, and each leg of TO is in the
//! span of FROM.

use std::fmt::Write as _;

use num::algebraic::Algebraic;
use num::exact::{determinant, rank, relations};
use platform::manipulator::{AlgebraicVector, ExactLegs};

/// `s(TO) = A s(FROM) + c` with exact numbers and `det A` not zero.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactMap {
    /// `A`, by rows.
    pub a: Vec<AlgebraicVector>,
    /// `c`.
    pub c: AlgebraicVector,
    /// `det A`.
    pub determinant: Algebraic,
}

/// The relation of two platforms, decided without rounding.
#[derive(Debug, Clone, PartialEq)]
pub enum ExactRelation {
    /// A regular map.
    Equivalent(Box<ExactMap>),
    /// The leg vectors of FROM or of TO are dependent.
    Singular {
        /// Ranks of the leg vectors of FROM and of TO.
        ranks: [usize; 2],
        /// The map if the legs of FROM are independent and those of TO are in their span; its determinant is zero.
        map: Option<Box<ExactMap>>,
    },
    /// Both are independent, and these legs of TO, from 0, are not in the span of those of FROM.
    Unrelated(Vec<usize>),
}

impl ExactRelation {
    /// The relation of six legs to six others.
    #[must_use]
    pub fn of(from: &ExactLegs, to: &ExactLegs) -> Self {
        let ranks = [from, to].map(|legs| rank(&legs.vectors));
        let (mut a, mut off) = (Vec::new(), Vec::new());
        if ranks[0] == 6 {
            for (i, w) in to.vectors.iter().enumerate() {
                let mut rows = from.vectors.clone();
                rows.push(w.clone());
                // the six are independent: at most one relation, and the seventh has a part in it
                match relations(&rows).pop() {
                    Some(relation) => a.push(relation[..6].iter().map(|x| -&(x / &relation[6])).collect()),
                    None => off.push(i),
                }
            }
        }
        let map = (ranks[0] == 6 && off.is_empty()).then(|| Box::new(ExactMap::new(a, from, to)));
        match map {
            map if ranks != [6, 6] => Self::Singular { ranks, map },
            Some(map) => Self::Equivalent(map),
            None => Self::Unrelated(off),
        }
    }

    /// The map, also if its determinant is zero.
    #[must_use]
    pub fn map(&self) -> Option<&ExactMap> {
        match self {
            Self::Equivalent(map) | Self::Singular { map: Some(map), .. } => Some(map),
            _ => None,
        }
    }
}

impl ExactMap {
    fn new(a: Vec<AlgebraicVector>, from: &ExactLegs, to: &ExactLegs) -> Self {
        let c = (0..6).map(|i| {
            let taken: Algebraic = a[i].iter().enumerate().map(|(k, x)| x * &from.squares(k)).sum();
            &to.squares(i) - &taken
        });
        Self { c: c.collect(), determinant: determinant(a.clone()), a }
    }

    /// Greatest number of bits of a numerator or denominator in `A` and `c`.
    pub(crate) fn bits(&self) -> u64 {
        self.a.iter().flatten().chain(&self.c).map(Algebraic::bits).max().unwrap_or(0)
    }

    /// The columns of `1 - t` and of `t`, if row `i` has only these nonzero entries.
    fn share_columns(&self, i: usize) -> Option<(usize, usize)> {
        let filled: Vec<usize> = (0..6).filter(|k| !self.a[i][*k].is_zero()).collect();
        let (first, second) = match filled[..] {
            [j, k] if &self.a[i][j] + &self.a[i][k] == Algebraic::integer(1) => (j, k),
            _ => return None,
        };
        // in the circulant order of the legs a leg has its own number first
        Some(if second == i { (second, first) } else { (first, second) })
    }

    /// The determinant with single ones, in the given columns, in place of the rows of `A`.
    fn determinant_with(&self, columns: &[(usize, usize)]) -> Algebraic {
        let mut a = self.a.clone();
        for (i, column) in columns {
            a[*i] = (0..6).map(|l| Algebraic::integer(i64::from(l == *column))).collect();
        }
        determinant(a)
    }

    /// The share `t` at which the determinant vanishes, if row `i` has only `1 - t` and `t`: `det A` is affine in `t`.
    pub(crate) fn singular_share(&self, i: usize) -> Option<Algebraic> {
        let (own, other) = self.share_columns(i)?;
        let at = |k: usize| self.determinant_with(&[(i, k)]);
        let start = at(own);
        let slope = &start - &at(other);
        (!slope.is_zero()).then(|| &start / &slope)
    }

    /// `det A` as a polynomial in all shares `t1` to `t6` of the rows with only `1 - t` and `t`; other rows are
    /// constant. It is a sum of products of `(1 - t)` and `t`, since the determinant is affine in each row. Its zeros
    /// are the singular platforms with the leg ends on the same edges. `None` without such a row.
    pub(crate) fn determinant_of_offsets(&self) -> Option<String> {
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
            let number = self.determinant_with(&columns);
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
        // no choice gives a regular matrix: singular for all shares
        Some(if text.is_empty() { "0".into() } else { text })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num::surd::Surd;
    use platform::manipulator::{ExactEnds, Manipulator};

    /// The relation of platforms by their exact ends.
    fn relation(from: &[ExactEnds; 6], to: &[ExactEnds; 6]) -> ExactRelation {
        let [from, to] =
            [from, to].map(|ends| ExactLegs::of(&Manipulator::from_exact_ends(ends).unwrap()).unwrap());
        ExactRelation::of(&from, &to)
    }

    fn equivalent(from: &[ExactEnds; 6], to: &[ExactEnds; 6]) -> ExactMap {
        let ExactRelation::Equivalent(map) = relation(from, to) else { panic!("no regular map") };
        *map
    }

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
        let map = equivalent(&octahedral, &slid(&t));
        let one = Surd::integer(1);
        let product = |list: Vec<Surd>| list.iter().fold(one.clone(), |p, x| p.times(x).unwrap());
        let complement = t.iter().map(|t| one.minus(t).unwrap()).collect();
        let expected = product(complement).minus(&product(t.to_vec())).unwrap();
        assert_eq!(map.determinant.surd(), expected);
        for k in 0..6 {
            assert_eq!(map.a[k][k].surd(), one.minus(&t[k]).unwrap());
            assert_eq!(map.a[k][(k + 1) % 6].surd(), t[k]);
            // -t (1 - t) d^2 with the edges 12 and 6
            let d = Surd::integer(if k % 2 == 0 { 144 } else { 36 });
            let c = t[k].times(&one.minus(&t[k]).unwrap()).unwrap().times(&d).unwrap().negated();
            assert_eq!(map.c[k].surd(), c);
            // (1 - x) prod (1 - t) = x prod t over the other legs
            let others =
                |f: &dyn Fn(&Surd) -> Surd| product((0..6).filter(|l| *l != k).map(|l| f(&t[l])).collect());
            let (stay, pass) = (others(&|t| one.minus(t).unwrap()), others(&Surd::clone));
            let singular = stay.times(&stay.plus(&pass).unwrap().inverse().unwrap()).unwrap();
            assert_eq!(map.singular_share(k).map(|t| t.surd()), Some(singular));
        }
    }

    /// All offsets at once: unmoved legs have no share, and the polynomial is zero where the platform is singular.
    #[test]
    fn the_singular_offsets_are_the_zeros_of_one_polynomial() {
        let octahedral = slid(&std::array::from_fn(|_| Surd::zero()));
        let of = |t: [i64; 6]| {
            let relation = relation(&octahedral, &slid(&t.map(|n| surd(n, 5))));
            let map = relation.map().unwrap();
            (map.determinant_of_offsets(), map.determinant.clone())
        };
        let all = "(1 - t1) (1 - t2) (1 - t3) (1 - t4) (1 - t5) (1 - t6) - t1 t2 t3 t4 t5 t6";
        assert_eq!(of([1, 2, 3, 1, 2, 4]).0.as_deref(), Some(all));
        // each t with its 1 - t: the same polynomial, and zero
        let (polynomial, determinant) = of([1, 4, 2, 3, 1, 4]);
        assert_eq!((polynomial.as_deref(), determinant.is_zero()), (Some(all), true));
        // with one unmoved leg the product of the shares is zero, and only a share of one is singular
        assert_eq!(of([0, 2, 3, 1, 0, 4]).0.as_deref(), Some("(1 - t2) (1 - t3) (1 - t4) (1 - t6)"));
        assert_eq!(of([0; 6]), (None, Algebraic::integer(1)));
    }

    #[test]
    fn singular_and_unrelated_platforms_are_told_exactly() {
        let octahedral = slid(&std::array::from_fn(|_| Surd::zero()));
        let half = slid(&std::array::from_fn(|_| surd(1, 2)));
        let found = relation(&octahedral, &half);
        assert!(
            matches!(&found, ExactRelation::Singular { ranks: [6, 5], map: Some(map) } if map.determinant.is_zero())
        );
        let back = relation(&half, &octahedral);
        assert_eq!(back, ExactRelation::Singular { ranks: [5, 6], map: None });
        let mut off = slid(&[1, 2, 3, 1, 2, 4].map(|n| surd(n, 5)));
        off[4][0][2] = surd(1, 1_000_000_000_000);
        assert_eq!(relation(&octahedral, &off), ExactRelation::Unrelated(vec![4]));
    }
}
