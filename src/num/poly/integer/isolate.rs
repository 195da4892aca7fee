//! Isolation of real roots, with proof.

use std::sync::Arc;

use num_bigint::{BigInt, Sign};
use num_traits::{One, Zero};

use super::{Dyadic, IntPoly, gcd, squarefree_factors, sturm_count};

/// One real root. It is `low` if `low = high`; otherwise it is the only root of the polynomial with `low < x < high`,
/// and neither end is a root.
#[derive(Debug, Clone)]
pub struct RealRoot {
    low: Dyadic,
    high: Dyadic,
    multiplicity: usize,
    factor: Arc<IntPoly>,
    /// Sign of `factor` at `low`.
    sign: Sign,
}

impl RealRoot {
    /// Lower end.
    #[must_use]
    pub fn low(&self) -> &Dyadic {
        &self.low
    }

    /// Upper end.
    #[must_use]
    pub fn high(&self) -> &Dyadic {
        &self.high
    }

    /// Multiplicity as a root of the original polynomial.
    #[must_use]
    pub fn multiplicity(&self) -> usize {
        self.multiplicity
    }

    /// The square-free polynomial whose simple root this is.
    #[must_use]
    pub fn factor(&self) -> &IntPoly {
        &self.factor
    }

    /// Whether the root is known exactly.
    #[must_use]
    pub fn is_exact(&self) -> bool {
        self.low == self.high
    }

    /// Halves the interval, exactly.
    pub fn bisect(&mut self) {
        if self.is_exact() {
            return;
        }
        let middle = self.low.midpoint(&self.high);
        let sign = self.factor.sign_at(&middle);
        if sign == Sign::NoSign {
            (self.low, self.high) = (middle.clone(), middle);
        } else if sign == self.sign {
            self.low = middle;
        } else {
            self.high = middle;
        }
    }

    /// Bisects until the width is below `2^exponent`.
    pub fn refine_to_width(&mut self, exponent: i64) {
        while self.width_log2().is_some_and(|w| w >= exponent) {
            self.bisect();
        }
    }

    /// Bisects until the width is below `2^-bits |x|`; a root at zero is always exact.
    pub fn refine_relative(&mut self, bits: u32) {
        loop {
            let Some(width) = self.width_log2() else { return };
            // the lesser end in modulus; zero while the interval touches zero
            let size = self.low.log2_floor().min(self.high.log2_floor());
            if size.is_some_and(|s| width < s - i64::from(bits)) {
                return;
            }
            self.bisect();
        }
    }

    /// The midpoint as a double, after refinement to `2^-60` relative.
    #[must_use]
    pub fn to_f64(&self) -> f64 {
        let mut root = self.clone();
        root.refine_relative(60);
        root.low.midpoint(&root.high).to_f64()
    }

    /// The exact sign of another polynomial at the root: zero for a common root.
    #[must_use]
    pub fn sign_of(&self, q: &IntPoly) -> Sign {
        let mut root = self.clone();
        if !root.is_exact() {
            let common = gcd(q, &root.factor);
            // a divisor of the factor has no other root here, and this one is simple
            if common.sign_at(&root.low) != common.sign_at(&root.high) {
                return Sign::NoSign;
            }
        }
        while !root.is_exact() && sturm_count(q, &root.low, &root.high) > 0 {
            root.bisect();
        }
        q.sign_at(&root.high)
    }

    fn width_log2(&self) -> Option<i64> {
        self.high.minus(&self.low).log2_floor()
    }
}

/// All distinct real roots, ascending, each isolated from all others, with multiplicities. Constants and zero have
/// none.
///
/// Square-free factors come from Yun's algorithm. Descartes' rule of signs on halved intervals (Collins, Akritas 1976)
/// isolates their roots, in integers throughout, so the number of roots is proved.
///
/// ```
/// # mod equipod { pub use equipod_num::Cancel; pub mod methods { pub use equipod_num::poly; } }
/// use equipod::methods::poly::{IntPoly, real_roots};
/// // (x^2 - 2) (x - 3)^2
/// let p = IntPoly::from_i64(&[-18, 12, 7, -6, 1]);
/// let roots = real_roots(&p);
/// assert_eq!(roots.iter().map(|r| r.multiplicity()).collect::<Vec<_>>(), [1, 1, 2]);
/// assert_eq!(roots[1].to_f64(), 2f64.sqrt());
/// ```
#[must_use]
pub fn real_roots(p: &IntPoly) -> Vec<RealRoot> {
    let mut out: Vec<RealRoot> = Vec::new();
    for f in squarefree_factors(p) {
        let factor = Arc::new(f.factor);
        out.extend(of_squarefree(&factor, f.multiplicity));
    }
    separate(&mut out);
    out.sort_by(|a, b| a.low.cmp(&b.low));
    out
}

fn of_squarefree(factor: &Arc<IntPoly>, multiplicity: usize) -> Vec<RealRoot> {
    let mut found: Vec<(Dyadic, Dyadic)> = Vec::new();
    let mut q = (**factor).clone();
    if q.0[0].is_zero() {
        found.push((Dyadic::new(BigInt::zero(), 0), Dyadic::new(BigInt::zero(), 0)));
        q.0.remove(0);
    }
    if q.degree() != Some(0) {
        let bound = q.root_bound();
        found.extend(positive(&q, bound));
        let mirrored = positive(&q.reflected(), bound);
        found.extend(mirrored.into_iter().map(|(low, high)| (high.negated(), low.negated())));
    }
    let root = |(low, high): (Dyadic, Dyadic)| {
        let mut root = RealRoot { low, high, multiplicity, factor: Arc::clone(factor), sign: Sign::NoSign };
        root.clear_ends();
        root
    };
    found.into_iter().map(root).collect()
}

impl RealRoot {
    fn is_root(&self, x: &Dyadic) -> bool {
        self.factor.sign_at(x) == Sign::NoSign
    }

    /// Shrinks an open interval with one simple root until no end is a root.
    fn clear_ends(&mut self) {
        if self.is_exact() {
            return;
        }
        // the sign just above the lower end
        let at_low = self.factor.sign_at(&self.low);
        self.sign = if at_low == Sign::NoSign { self.factor.derivative().sign_at(&self.low) } else { at_low };
        while !self.is_exact() && (self.is_root(&self.low) || self.is_root(&self.high)) {
            self.bisect();
        }
    }
}

/// Isolating intervals of the roots of a square-free polynomial in `(0, 2^bound)`.
fn positive(q: &IntPoly, bound: i64) -> Vec<(Dyadic, Dyadic)> {
    let mut found = Vec::new();
    // (polynomial on (0, 1), number of the interval, depth)
    let mut open = vec![(q.stretched(-bound), BigInt::zero(), 0i64)];
    while let Some((q, place, depth)) = open.pop() {
        let point = |k: &BigInt| Dyadic::new(k.clone(), bound - depth);
        match variations(&q.reversed().shifted_by_one()) {
            0 => {}
            1 => found.push((point(&place), point(&(&place + BigInt::one())))),
            _ => {
                let left = without_powers_of_two(q.stretched(1));
                let mut right = left.shifted_by_one();
                let middle: BigInt = (&place << 1u32) + 1u32;
                if right.0[0].is_zero() {
                    let x = Dyadic::new(middle.clone(), bound - depth - 1);
                    found.push((x.clone(), x));
                    right.0.remove(0);
                }
                open.push((left, place << 1u32, depth + 1));
                open.push((right, middle, depth + 1));
            }
        }
    }
    found
}

fn without_powers_of_two(p: IntPoly) -> IntPoly {
    let common = p.0.iter().filter_map(BigInt::trailing_zeros).min().unwrap_or(0);
    if common == 0 { p } else { IntPoly(p.0.into_iter().map(|c| c >> common).collect()) }
}

/// Changes of sign in the sequence of coefficients: the number of positive roots, or more by an even number
/// (Descartes).
fn variations(p: &IntPoly) -> usize {
    let signs: Vec<Sign> = p.0.iter().map(BigInt::sign).filter(|s| *s != Sign::NoSign).collect();
    signs.windows(2).filter(|w| w[0] != w[1]).count()
}

/// Bisects intervals of different factors until they are disjoint; the factors have no common root.
fn separate(roots: &mut [RealRoot]) {
    for i in 0..roots.len() {
        for j in 0..i {
            let (before, rest) = roots.split_at_mut(i);
            let (a, b) = (&mut before[j], &mut rest[0]);
            while a.low <= b.high && b.low <= a.high {
                a.bisect();
                b.bisect();
            }
        }
    }
}
