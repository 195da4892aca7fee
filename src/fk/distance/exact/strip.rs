//! The unoriented steps of a sequence over the tower, and the closure condition.
//!
//! A step places `P` from `o, p, q` in place: with `u = p - o`, `v = q - o`, `n = u x v`, `m = 2 u.v`,
//! `F = 2 u.(P - o)`, `G = 2 v.(P - o)` from distances,
//!
//! ```text
//! A   = 4 (u.u v.v) - m^2                        the singular factor, -D(o, p, q)
//! K   = v.v F^2 - m F G + u.u G^2
//! P   = o + [ (2 v.v F - m G) u + (2 u.u G - m F) v + 2 sqrt(s_oP A - K) n ] / A.
//! ```
//!
//! The closure is a condition `2 w.(P - o) = h` on the last of the steps it needs. The sixteen doubled scalar products
//! of `u, v, P - o, w` are known. Then its norm over the root of that step is a Gram determinant, which vanishes for
//! four vectors in space:
//!
//! ```text
//! A w.w (product over both signs of the closure) = det (2 g_i.g_j),  up to a constant factor.
//! ```
//!
//! So the outermost root and its singular factor never appear.
//!
//! For comparison the closure is also carried out as the paper does: squared distances from coordinates, denominators
//! cleared, roots squared out, nothing cancelled.

use super::tower::{Divisor, Fraction, Fractions, Ring, STEPS, is_zero, zero};
use super::{ClosureError, ExactData, cross, dot, minus};
use platform::topology::{JointIndex, Sequence, Step};

/// A closure of a sequence: the squared distance between the two joints, computed, is the known one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct StripClosure {
    /// The joint placed last.
    pub(super) last: JointIndex,
    pub(super) other: JointIndex,
    /// Steps that are needed to place both.
    pub(super) steps: usize,
}

/// Joints placed one after the other.
pub(super) struct Strip<'a, R> {
    pub(super) data: &'a ExactData,
    pub(super) fractions: Fractions<R>,
    pub(super) steps: [Step; STEPS],
    pub(super) closure: StripClosure,
    virtual_leg: Option<(usize, usize)>,
    /// Coordinates of the joints placed so far.
    placed: Vec<[Fraction<R>; 3]>,
    /// `A` of each step so far.
    pub(super) singular: Vec<Fraction<R>>,
    /// Whether distances are taken from coordinates as the paper does, in place of shorter ways.
    pub(super) literal: bool,
}

impl<'a, R: Ring> Strip<'a, R> {
    pub(super) fn new(
        data: &'a ExactData,
        s: &Sequence,
        closure: StripClosure,
        literal: bool,
    ) -> Result<Self, ClosureError> {
        let steps: Vec<Step> = s.unoriented().copied().collect();
        let steps: [Step; STEPS] = steps.try_into().map_err(|_| ClosureError::Unsupported)?;
        if s.virtual_legs.len() > 1 {
            return Err(ClosureError::Unsupported);
        }
        Ok(Self {
            data,
            fractions: Fractions::new(!literal),
            steps,
            closure,
            virtual_leg: s.virtual_legs.first().copied(),
            placed: Vec::new(),
            singular: Vec::new(),
            literal,
        })
    }

    fn index(&self, joint: JointIndex) -> Option<usize> {
        self.steps.iter().position(|s| s.place == joint)
    }

    /// Coordinates in the frame of the first body.
    fn coordinates(&self, joint: JointIndex) -> [Fraction<R>; 3] {
        match self.index(joint).and_then(|k| self.placed.get(k)) {
            Some(p) => p.clone(),
            None => self.data.point(joint).each_ref().map(|c| self.fractions.integer(c)),
        }
    }

    fn difference(&self, p: &[Fraction<R>; 3], q: &[Fraction<R>; 3]) -> [Fraction<R>; 3] {
        std::array::from_fn(|i| self.fractions.minus(&p[i], &q[i]))
    }

    pub(super) fn product(&self, p: &[Fraction<R>; 3], q: &[Fraction<R>; 3]) -> Fraction<R> {
        let f = &self.fractions;
        let terms: Vec<Fraction<R>> = (0..3).map(|i| f.times(&p[i], &q[i])).collect();
        f.sum(&terms)
    }

    pub(super) fn cross(&self, p: &[Fraction<R>; 3], q: &[Fraction<R>; 3]) -> [Fraction<R>; 3] {
        let f = &self.fractions;
        std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            f.minus(&f.times(&p[j], &q[k]), &f.times(&p[k], &q[j]))
        })
    }

    /// A known squared distance, that of the closure left out.
    fn known(&self, x: JointIndex, y: JointIndex) -> Option<Fraction<R>> {
        let closing = (x, y) == (self.closure.last, self.closure.other)
            || (y, x) == (self.closure.last, self.closure.other);
        match x.across(y) {
            _ if closing => None,
            None => Some(self.fractions.integer(&self.data.within(x, y))),
            pair if pair == self.virtual_leg => Some(self.fractions.unknown()),
            _ => self.data.leg(x, y).map(|s| self.fractions.integer(s)),
        }
    }

    /// The two joints whose squared distance is the unknown.
    pub(super) fn unknown(&self) -> [JointIndex; 2] {
        match self.virtual_leg {
            Some((a, b)) => [JointIndex::Base(a), JointIndex::Platform(b)],
            None => [self.closure.last, self.closure.other],
        }
    }

    /// The distance that the closure prescribes: the known one, or the unknown when there is no virtual leg.
    fn closing(&self) -> Fraction<R> {
        let StripClosure { last, other, .. } = self.closure;
        match last.across(other) {
            None => self.fractions.integer(&self.data.within(last, other)),
            Some(_) => match self.data.leg(last, other) {
                Some(s) => self.fractions.integer(s),
                None => self.fractions.unknown(),
            },
        }
    }

    /// The squared distance of two joints in place.
    pub(super) fn squared(&self, x: JointIndex, y: JointIndex) -> Fraction<R> {
        if let Some(s) = self.known(x, y) {
            return s;
        }
        let (moving, still) = if self.index(x).is_some() { (x, y) } else { (y, x) };
        let f = &self.fractions;
        if self.literal || self.index(still).is_some() {
            let d = self.difference(&self.coordinates(x), &self.coordinates(y));
            return self.product(&d, &d);
        }
        // |P - y|^2 = |P - r|^2 + 2 (P - r).(r - y) + |r - y|^2 with r at a known distance: linear in the coordinates
        let from = self.index(moving).map_or([still; 3], |k| self.steps[k].from);
        let reference = from.into_iter().find(|r| !r.same_body(moving)).unwrap_or(still);
        let Some(s) = self.known(reference, moving) else {
            let d = self.difference(&self.coordinates(x), &self.coordinates(y));
            return self.product(&d, &d);
        };
        let step = minus(self.data.point(reference), self.data.point(still));
        let p = self.difference(&self.coordinates(moving), &self.coordinates(reference));
        let terms: Vec<Fraction<R>> = (0..3).map(|i| f.scaled(&p[i], &(&step[i] * 2))).collect();
        let linear = f.plus(&f.sum(&terms), &f.integer(&dot(&step, &step)));
        f.plus(&s, &linear)
    }

    /// `2 (x - o).(y - o)` from distances.
    fn doubled(&self, o: JointIndex, x: JointIndex, y: JointIndex) -> Fraction<R> {
        let f = &self.fractions;
        let legs = f.plus(&self.squared(o, x), &self.squared(o, y));
        if x == y { legs } else { f.minus(&legs, &self.squared(x, y)) }
    }

    /// `A = 4 (u.u v.v) - (2 u.v)^2` of step `t`.
    pub(super) fn singular_factor(&self, [o, p, q]: [JointIndex; 3]) -> Fraction<R> {
        let f = &self.fractions;
        let m = self.doubled(o, p, q);
        let product = f.times(&self.squared(o, p), &self.squared(o, q));
        f.minus(&f.scaled(&product, &4.into()), &f.times(&m, &m))
    }

    /// The joints of step `t` with the origin first: one of the first body.
    pub(super) fn base_of(&self, t: usize) -> [JointIndex; 3] {
        let mut from = self.steps[t].from;
        if let Some(k) = from.iter().position(|j| !j.same_body(self.steps[t].place)) {
            from.swap(0, k);
        }
        from
    }

    /// Places the joint of the next step.
    pub(super) fn place(&mut self) -> Result<(), ClosureError> {
        let t = self.placed.len();
        let (base, new) = (self.base_of(t), self.steps[t].place);
        let [o, p, q] = base;
        let singular = self.singular_factor(base);
        if self.fractions.tower.norm(&singular.numerator).is_zero() {
            return Err(ClosureError::Collinear { step: t });
        }
        let inverse = self.fractions.adjoin_factor(&singular);
        let f = &self.fractions;
        // the symbols of the module's page: m = 2 u.v, F = 2 u.(P - o), G = 2 v.(P - o)
        let (u_u, v_v, m) = (self.squared(o, p), self.squared(o, q), self.doubled(o, p, q));
        let (big_f, big_g) = (self.doubled(o, p, new), self.doubled(o, q, new));
        let along_u = f.minus(&f.twice(&f.times(&v_v, &big_f)), &f.times(&m, &big_g));
        let along_v = f.minus(&f.twice(&f.times(&u_u, &big_g)), &f.times(&m, &big_f));
        // 2 K = F (2 v.v F - m G) + G (2 u.u G - m F)
        let two_k = f.plus(&f.times(&big_f, &along_u), &f.times(&big_g, &along_v));
        // 2 sqrt(s A - K) = sqrt(2 (2 s A - 2 K))
        let radicand = f.twice(&f.minus(&f.twice(&f.times(&self.squared(o, new), &singular)), &two_k));
        let origin = self.coordinates(o);
        let u = self.difference(&self.coordinates(p), &origin);
        let v = self.difference(&self.coordinates(q), &origin);
        let root = self.fractions.adjoin_root(&radicand);
        let n = self.cross(&u, &v);
        let f = &self.fractions;
        let place = std::array::from_fn(|i| {
            let flat = f.plus(&f.times(&along_u, &u[i]), &f.times(&along_v, &v[i]));
            let out = f.plus(&flat, &f.times(&root, &n[i]));
            f.plus(&origin[i], &f.times(&inverse, &out))
        });
        self.singular.push(singular);
        self.placed.push(place);
        Ok(())
    }

    /// A multiple of the product of the closure over both signs of its last step, without the root of that step. It is
    /// computed before that step.
    pub(super) fn gram_determinant(&self) -> Result<Fraction<R>, ClosureError> {
        let t = self.closure.steps - 1;
        assert!(self.placed.len() == t);
        if is_zero(&self.singular_factor(self.base_of(t)).numerator) {
            return Err(ClosureError::Collinear { step: t });
        }
        let direct = self.steps[t].place == self.closure.last;
        let gram = if direct { self.direct_products(t) } else { self.rigid_products()? };
        Ok(self.determinant(&gram))
    }

    /// The closure is a distance of the joint itself: `w` is the other joint.
    fn direct_products(&self, t: usize) -> [[Fraction<R>; 4]; 4] {
        let ([o, p, q], new, other) = (self.base_of(t), self.steps[t].place, self.closure.other);
        let f = &self.fractions;
        let pair = |x: JointIndex, y: JointIndex| {
            if x == y {
                return f.twice(&self.squared(o, x));
            }
            let closing = x == new && y == other || x == other && y == new;
            let across = if closing { self.closing() } else { self.squared(x, y) };
            f.minus(&f.plus(&self.squared(o, x), &self.squared(o, y)), &across)
        };
        let list = [p, q, new, other];
        std::array::from_fn(|i| std::array::from_fn(|j| pair(list[i], list[j])))
    }

    /// The closure for a distance between a joint `K` and a joint `L` in place. `K` is rigidly joined to the three
    /// placed joints `P1`, `P2`, `P3`.
    ///
    /// With `y = P2 - P1`, `z = P3 - P1`, `n = y x z`: `|n|^2 (K - P1) = c_y y + c_z z + c_n n`, integers. With
    /// `t = P1 - L` the closure is `2 w.z = h`, `w = c_z t + c_n (t x y)`. The four vectors of the Gram matrix are `y`,
    /// `v = J - P1`, `z` and `2 w`. The third step starts from `J`, a joint in place. All products are doubled.
    fn rigid_products(&self) -> Result<[[Fraction<R>; 4]; 4], ClosureError> {
        let f = &self.fractions;
        let [p1, p2, p3] = self.steps.map(|s| s.place);
        let StripClosure { last, other, .. } = self.closure;
        let in_place = |joint: &JointIndex| !joint.same_body(p1);
        let start = self.steps[2].from.into_iter().find(in_place).ok_or(ClosureError::Unsupported)?;
        let moving = self.steps[2].from.iter().filter(|j| !in_place(j)).count();
        if moving != 2 {
            return Err(ClosureError::Unsupported);
        }
        // the rigid body in integers
        let from_first = |joint| minus(self.data.point(joint), self.data.point(p1));
        let (y, z, to_last) = (from_first(p2), from_first(p3), from_first(last));
        let normal = cross(&y, &z);
        let along_y = dot(&cross(&to_last, &z), &normal);
        let along_z = dot(&cross(&y, &to_last), &normal);
        let along_normal = dot(&to_last, &normal);
        // squared lengths
        let y_y = self.squared(p1, p2);
        let t_t = self.squared(p1, other);
        let v_v = self.squared(p1, start);
        let z_z = f.integer(&self.data.within(p1, p3));
        // doubled products of the legs with each other and with t
        let two_y_t = f.minus(&self.squared(p2, other), &f.plus(&t_t, &y_y));
        let start_to_other = f.integer(&self.data.within(start, other));
        let two_v_t = f.minus(&start_to_other, &f.plus(&v_v, &t_t));
        let two_y_v = self.doubled(p1, p2, start);
        let two_y_z = self.doubled(p1, p2, p3);
        let two_v_z = self.doubled(p1, start, p3);
        // doubled products with w, which is at right angles to y but for its part along t
        let two_y_w = f.scaled(&two_y_t, &along_z);
        let two_volumes = f.twice(&self.volume(p1, p2, start, other));
        let two_v_w = f.plus(&f.scaled(&two_v_t, &along_z), &f.scaled(&two_volumes, &along_normal));
        // 4 |t x y|^2; the last vector is 2 w, so that its square needs no half
        let four_areas = f.minus(&f.scaled(&f.times(&t_t, &y_y), &4.into()), &f.times(&two_y_t, &two_y_t));
        let eight_w_w = f.plus(
            &f.scaled(&t_t, &(&along_z * &along_z * 8)),
            &f.scaled(&four_areas, &(&along_normal * &along_normal * 2)),
        );
        let rigid = f.minus(&self.closing(), &f.plus(&f.integer(&dot(&to_last, &to_last)), &t_t));
        let closure = f.minus(&f.scaled(&rigid, &dot(&normal, &normal)), &f.scaled(&two_y_t, &along_y));
        let (four_y_w, four_v_w, four_z_w) = (f.twice(&two_y_w), f.twice(&two_v_w), f.twice(&closure));
        Ok([
            [f.twice(&y_y), two_y_v.clone(), two_y_z.clone(), four_y_w.clone()],
            [two_y_v, f.twice(&v_v), two_v_z.clone(), four_v_w.clone()],
            [two_y_z, two_v_z, f.twice(&z_z), four_z_w.clone()],
            [four_y_w, four_v_w, four_z_w, eight_w_w],
        ])
    }

    /// `(j - P1).[(P1 - l) x (P2 - P1)] = det(j - P1, j - l, P2 - j)`, bilinear in the coordinates.
    fn volume(&self, p1: JointIndex, p2: JointIndex, j: JointIndex, l: JointIndex) -> Fraction<R> {
        let cj = self.coordinates(j);
        let first = self.difference(&cj, &self.coordinates(p1));
        let last = self.difference(&self.coordinates(p2), &cj);
        let fixed = minus(self.data.point(j), self.data.point(l)).map(|c| self.fractions.integer(&c));
        self.product(&self.cross(&first, &fixed), &last)
    }

    /// The determinant of a symmetric matrix by products of minors of its upper and lower half.
    fn determinant(&self, g: &[[Fraction<R>; 4]; 4]) -> Fraction<R> {
        let f = &self.fractions;
        let minor = |r: usize, i: usize, j: usize| {
            f.minus(&f.times(&g[r][i], &g[r + 1][j]), &f.times(&g[r][j], &g[r + 1][i]))
        };
        let mut sum = f.whole(vec![zero()]);
        for (i, j, k, l, positive) in [
            (0, 1, 2, 3, true),
            (0, 2, 1, 3, false),
            (0, 3, 1, 2, true),
            (1, 2, 0, 3, true),
            (1, 3, 0, 2, false),
            (2, 3, 0, 1, true),
        ] {
            let term = f.times(&minor(0, i, j), &minor(2, k, l));
            sum = if positive { f.plus(&sum, &term) } else { f.minus(&sum, &term) };
        }
        sum
    }
}

/// The closures to choose from. With virtual legs it is the closure of the sequence. Otherwise every pair of a placed
/// joint and a joint of the first body that no leg joins is one, the joint placed last first.
pub(super) fn closures(data: &ExactData, s: &Sequence) -> Vec<StripClosure> {
    let steps: Vec<JointIndex> = s.unoriented().map(|t| t.place).collect();
    let order = |j: JointIndex| {
        if j.same_body(s.start[0]) { 0 } else { steps.iter().position(|p| *p == j).map_or(STEPS, |k| k + 1) }
    };
    if let Some([x, y]) = s.closures.first() {
        let (last, other) = if order(*x) >= order(*y) { (*x, *y) } else { (*y, *x) };
        return vec![StripClosure { last, other, steps: order(last) }];
    }
    let all = s.start.iter().copied().chain(s.steps.iter().map(|t| t.place));
    let first: Vec<JointIndex> = all.filter(|j| order(*j) == 0).collect();
    let pairs = steps.iter().rev().flat_map(|last| first.iter().map(move |other| (*last, *other)));
    let free = pairs.filter(|(last, other)| data.leg(*last, *other).is_none());
    free.map(|(last, other)| StripClosure { last, other, steps: order(last) }).collect()
}

/// The polynomial without roots, with its degrees and factors.
pub(super) struct Literal<R> {
    /// The norm of the numerator of the closure.
    pub(super) polynomial: R,
    /// Powers of the singular factors in the denominator of the closure.
    pub(super) exponents: [i32; STEPS],
    /// Number of roots in the closure.
    pub(super) levels: usize,
    /// The singular factors of the steps used, as numerators with the powers of earlier ones in their denominators.
    pub(super) factors: Vec<(Divisor<R>, [i32; STEPS])>,
}

pub(super) fn literal<R: Ring>(
    data: &ExactData,
    s: &Sequence,
    closure: StripClosure,
) -> Result<Literal<R>, ClosureError> {
    let mut strip = Strip::<R>::new(data, s, closure, true)?;
    for _ in 0..strip.closure.steps.min(STEPS) {
        strip.place()?;
    }
    let closure = condition(&strip)?;
    let f = &strip.fractions;
    let factors = f.factors.iter().cloned().zip(strip.singular.iter().map(|a| a.exponents)).collect();
    Ok(Literal {
        polynomial: f.tower.norm(&closure.numerator),
        exponents: closure.exponents,
        levels: closure.numerator.len().trailing_zeros() as usize,
        factors,
    })
}

/// Computed squared distance less the known one, times a positive integer.
fn condition<R: Ring>(strip: &Strip<'_, R>) -> Result<Fraction<R>, ClosureError> {
    let f = &strip.fractions;
    let (last, other) = (strip.closure.last, strip.closure.other);
    let places = strip.steps.map(|s| s.place);
    if places.contains(&last) {
        let d = strip.difference(&strip.coordinates(last), &strip.coordinates(other));
        return Ok(f.minus(&strip.product(&d, &d), &strip.closing()));
    }
    let [p1, p2, p3] = places;
    let point = |joint| strip.data.point(joint);
    let (y, z, k) = (minus(point(p2), point(p1)), minus(point(p3), point(p1)), minus(point(last), point(p1)));
    let normal = cross(&y, &z);
    let size = dot(&normal, &normal);
    let (n1, n2, n3) = (dot(&cross(&k, &z), &normal), dot(&cross(&y, &k), &normal), dot(&k, &normal));
    if size == 0.into() {
        return Err(ClosureError::Collinear { step: STEPS });
    }
    let origin = strip.coordinates(p1);
    let (y, z) = (
        strip.difference(&strip.coordinates(p2), &origin),
        strip.difference(&strip.coordinates(p3), &origin),
    );
    let w = strip.cross(&y, &z);
    let t = strip.difference(&origin, &strip.coordinates(other));
    let d: [Fraction<R>; 3] = std::array::from_fn(|i| {
        let terms =
            [f.scaled(&t[i], &size), f.scaled(&y[i], &n1), f.scaled(&z[i], &n2), f.scaled(&w[i], &n3)];
        f.sum(&terms)
    });
    Ok(f.minus(&strip.product(&d, &d), &f.scaled(&strip.closing(), &(&size * &size))))
}
