//! A sequence as indices and numbers, its evaluation, and the closure condition along the circle on which one joint
//! turns.

#![allow(clippy::inline_always, reason = "lanes fill vector units only in one piece of code")]

use nalgebra::{Matrix3, Vector3};
use num_complex::Complex64;

use super::number::{LaneNumber, TrilateratedPlaces, Vector, along, cross, dot, minus, squared_distance};
use num::batch::{ComplexBatch, LANES};
use num::vector_unit::on_vector_unit;
use platform::geom::ComplexPose;
use platform::manipulator::Manipulator;
use platform::topology::{JointIndex, Sequence, Step};

/// Places for six joints of the first body and three of the second.
const SLOTS: usize = 9;
/// The first slot of the three joints.
const THREE: usize = 6;

/// Positions of joints, in the frame of the first body over the size.
pub(super) type Positions<T> = [Vector<T>; SLOTS];

/// A known squared distance.
#[derive(Debug, Clone, Copy)]
pub(super) enum Measured {
    /// The length of a leg. Numbers from 6 on are virtual legs whose length is given.
    Leg(usize),
    /// A distance within a body.
    Fixed(f64),
}

impl Measured {
    #[inline(always)]
    pub(super) fn value(self, lengths: &[Complex64]) -> Complex64 {
        match self {
            Self::Leg(k) => lengths[k],
            Self::Fixed(s) => Complex64::from(s),
        }
    }
}

/// An unoriented step with three known distances.
#[derive(Debug, Clone, Copy)]
pub(super) struct JointPlacement {
    pub(super) from: [usize; 3],
    pub(super) distances: [Measured; 3],
    pub(super) place: usize,
}

/// A step with a virtual leg whose length is unknown: the joint is on a circle about the line of two others.
#[derive(Debug, Clone, Copy)]
pub(super) struct Turn {
    axis: [usize; 2],
    pub(super) distances: [Measured; 2],
    pub(super) place: usize,
    /// The other end of the virtual leg.
    pub(super) virtual_end: usize,
}

/// The known distance that no step uses.
#[derive(Debug, Clone, Copy)]
pub(super) enum ChainClosure {
    /// The distance of two joints in place.
    Pair([usize; 2], Measured),
    /// The distance of a joint of the first body from `y1 + a (y2 - y1) + b (y3 - y1) + c (y2 - y1) x (y3 - y1)`.
    Rigid { at: usize, omega: [f64; 3], distance: Measured },
}

/// A sequence for one design.
#[derive(Debug, Clone)]
pub(super) struct TrilaterationChain {
    /// Joints of the first body over the size.
    pub(super) first: Positions<Complex64>,
    /// Steps that do not depend on the virtual leg.
    pub(super) before: Vec<JointPlacement>,
    pub(super) turn: Option<Turn>,
    pub(super) after: Vec<JointPlacement>,
    pub(super) closure: Option<ChainClosure>,
    /// Frame of the three joints in their body, inverted, and the first of them, over the size.
    inverse: Matrix3<f64>,
    origin: Vector3<f64>,
    base_is_first: bool,
    pub(super) size: f64,
}

/// Joints in their slots.
struct Slots {
    first: Vec<JointIndex>,
    three: Vec<JointIndex>,
}

impl Slots {
    fn of(&self, joint: JointIndex) -> Option<usize> {
        let on_first = self.first.iter().position(|j| *j == joint);
        on_first.or_else(|| self.three.iter().position(|j| *j == joint).map(|k| THREE + k))
    }
}

impl TrilaterationChain {
    /// The sequence for `m`, with known lengths of the virtual legs `given`. A further virtual leg is found from
    /// `closure`. `None` when the sequence is not of this kind.
    pub(super) fn new(
        m: &Manipulator,
        s: &Sequence,
        given: &[(usize, usize)],
        closure: Option<[JointIndex; 2]>,
    ) -> Option<Self> {
        let size = m.size();
        let local = |j: JointIndex| j.point(m).coords / size;
        let on_first = |j: &JointIndex| j.same_body(s.start[0]);
        let placed = s.steps.iter().map(|t| t.place);
        let first: Vec<JointIndex> = s.start.iter().copied().chain(placed.filter(on_first)).collect();
        let three: Vec<JointIndex> = s.unoriented().map(|t| t.place).collect();
        if first.len() > THREE || three.len() != 3 {
            return None;
        }
        let slots = Slots { first, three };
        let measured = |x: JointIndex, y: JointIndex| match x.across(y) {
            None => Some(Measured::Fixed((local(x) - local(y)).norm_squared())),
            Some(pair) => {
                let leg = m.pairs().iter().position(|l| *l == pair);
                leg.or_else(|| given.iter().position(|v| *v == pair).map(|k| 6 + k)).map(Measured::Leg)
            }
        };
        let mut positions = [[Complex64::ZERO; 3]; SLOTS];
        for (k, joint) in slots.first.iter().enumerate() {
            positions[k] = std::array::from_fn(|i| Complex64::from(local(*joint)[i]));
        }
        let [a, b, c] = [0, 1, 2].map(|k| local(slots.three[k]));
        let (u, v) = (b - a, c - a);
        let inverse = Matrix3::from_columns(&[u, v, u.cross(&v)]).try_inverse()?;
        let closure = match closure {
            None => None,
            Some([x, y]) => Some(closure_of(&slots, x, y, measured(x, y)?, &|j| inverse * (local(j) - a))?),
        };
        let mut chain = Self {
            first: positions,
            before: Vec::new(),
            turn: None,
            after: Vec::new(),
            closure,
            inverse,
            origin: a,
            base_is_first: matches!(s.start[0], JointIndex::Base(_)),
            size,
        };
        for step in s.unoriented() {
            chain.add(step, &slots, &measured)?;
        }
        (chain.turn.is_some() == chain.closure.is_some()).then_some(chain)
    }

    fn add(
        &mut self,
        step: &Step,
        slots: &Slots,
        measured: &impl Fn(JointIndex, JointIndex) -> Option<Measured>,
    ) -> Option<()> {
        let place = slots.of(step.place)?;
        let mut known = Vec::new();
        let mut open = Vec::new();
        for f in step.from {
            match measured(f, step.place) {
                Some(d) => known.push((slots.of(f)?, d)),
                None => open.push(slots.of(f)?),
            }
        }
        match (known[..].as_ref(), open[..].as_ref()) {
            ([x, y, z], []) => {
                let placement = JointPlacement { from: [x.0, y.0, z.0], distances: [x.1, y.1, z.1], place };
                if self.turn.is_some() { self.after.push(placement) } else { self.before.push(placement) }
            }
            ([x, y], [virtual_end]) if self.turn.is_none() => {
                let (axis, distances) = ([x.0, y.0], [x.1, y.1]);
                self.turn = Some(Turn { axis, distances, place, virtual_end: *virtual_end });
            }
            _ => return None,
        }
        Some(())
    }

    /// The two places of a step.
    #[inline(always)]
    pub(super) fn places<T: LaneNumber>(
        step: &JointPlacement,
        at: &Positions<T>,
        lengths: &[Complex64],
    ) -> TrilateratedPlaces<T> {
        let ([x, y, z], [a, b, c]) = (step.from, step.distances);
        let constant = |d: Measured| T::constant(d.value(lengths));
        TrilateratedPlaces::of([&at[x], &at[y], &at[z]], [constant(a), constant(b), constant(c)])
    }

    /// Computed less known squared distance of the closure.
    #[inline(always)]
    pub(super) fn defect<T: LaneNumber>(&self, at: &Positions<T>, lengths: &[Complex64]) -> Option<T> {
        let (square, distance) = match self.closure? {
            ChainClosure::Pair([x, y], d) => (squared_distance(&at[x], &at[y]), d),
            ChainClosure::Rigid { at: x, omega, distance } => {
                let (u, v) = (minus(&at[THREE + 1], &at[THREE]), minus(&at[THREE + 2], &at[THREE]));
                let real = |c: f64| T::constant(Complex64::from(c));
                let n = cross(&u, &v);
                let here = along(&along(&at[THREE], real(omega[0]), &u), real(omega[1]), &v);
                (squared_distance(&along(&here, real(omega[2]), &n), &at[x]), distance)
            }
        };
        Some(square - T::constant(distance.value(lengths)))
    }

    /// The pose with the joints in place, in design units.
    pub(super) fn pose(&self, at: &Positions<Complex64>) -> ComplexPose {
        self.pose_of([at[THREE], at[THREE + 1], at[THREE + 2]])
    }

    /// The pose by the three joints of the second body, in design units.
    pub(super) fn pose_of(&self, three: [Vector<Complex64>; 3]) -> ComplexPose {
        let [a, b, c] = three.map(Vector3::from);
        let (u, v) = (b - a, c - a);
        let frame = Matrix3::from_columns(&[u, v, u.cross(&v)]);
        let rotation = Matrix3::from_fn(|i, j| {
            (0..3).map(|k| frame[(i, k)] * self.inverse[(k, j)]).fold(Complex64::ZERO, |x, y| x + y)
        });
        let o = &self.origin;
        let turned =
            Vector3::from_fn(|i, _| rotation[(i, 0)] * o.x + rotation[(i, 1)] * o.y + rotation[(i, 2)] * o.z);
        let position = (a - turned) * Complex64::from(self.size);
        if self.base_is_first {
            return ComplexPose { rotation, position };
        }
        let rotation = rotation.transpose();
        ComplexPose { rotation, position: -(rotation * position) }
    }
}

/// The closure between `x` and `y` at a known distance; `omega` gives the place of a joint in the frame of the three.
fn closure_of(
    slots: &Slots,
    x: JointIndex,
    y: JointIndex,
    distance: Measured,
    omega: &impl Fn(JointIndex) -> Vector3<f64>,
) -> Option<ChainClosure> {
    match (slots.of(x), slots.of(y)) {
        (Some(i), Some(j)) => Some(ChainClosure::Pair([i, j], distance)),
        (Some(at), None) => Some(ChainClosure::Rigid { at, omega: omega(y).into(), distance }),
        (None, Some(at)) => Some(ChainClosure::Rigid { at, omega: omega(x).into(), distance }),
        (None, None) => None,
    }
}

/// A circle `centre + w u + z / u`; real points for `|u| = 1` when everything is real.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChainCircle {
    centre: Vector<Complex64>,
    forth: Vector<Complex64>,
    back: Vector<Complex64>,
}

impl ChainCircle {
    /// Points with squared distances `s` to two points; `None` when these are one or on an isotropic line.
    pub(super) fn of(p: [&Vector<Complex64>; 2], s: [Complex64; 2]) -> Option<Self> {
        let axis = minus(p[1], p[0]);
        let square = dot(&axis, &axis);
        let length: f64 = axis.iter().map(Complex64::norm_sqr).sum();
        if !(square.norm() > 1e-12 * length) {
            return None;
        }
        let t = (s[0] + square - s[1]).times(0.5) / square;
        let radius = (s[0] - t * t * square).root();
        // the coordinate direction farthest from the axis, made orthogonal to it
        let k = (0..3).min_by(|i, j| axis[*i].norm_sqr().total_cmp(&axis[*j].norm_sqr()))?;
        let mut e = [Complex64::ZERO; 3];
        e[k] = Complex64::ONE;
        let e = along(&e, Complex64::ZERO - axis[k] / square, &axis);
        let e = e.map(|z| z / dot(&e, &e).sqrt());
        let f = cross(&axis, &e).map(|z| z / square.sqrt());
        let half = radius.times(0.5);
        // cos = (u + 1/u) / 2, sin = (u - 1/u) / 2i
        let forth = std::array::from_fn(|i| half * (e[i] - Complex64::I * f[i]));
        let back = std::array::from_fn(|i| half * (e[i] + Complex64::I * f[i]));
        Some(Self { centre: along(p[0], t, &axis), forth, back })
    }

    #[inline(always)]
    pub(super) fn point<T: LaneNumber>(&self, u: T) -> Vector<T> {
        let inverse = u.reciprocal();
        let mut out = [u; 3];
        for i in 0..3 {
            out[i] = T::constant(self.centre[i])
                + T::constant(self.forth[i]) * u
                + T::constant(self.back[i]) * inverse;
        }
        out
    }
}

/// Relative displacement for differences in place of derivatives.
const NUDGE: f64 = 1e-7;
/// Most sweeps of the simultaneous iteration.
const SWEEPS: usize = 12;

/// Exponents of the Gram determinants of the two steps after the turn, by which the product of the closures over all
/// orientations is divided.
pub(super) type Exponents = [u32; 2];

/// A chain with lengths, the joints before the turn in place.
#[derive(Debug, Clone, Copy)]
pub(super) struct ChainBranch<'a> {
    pub(super) chain: &'a TrilaterationChain,
    pub(super) lengths: &'a [Complex64],
    fixed: Positions<Complex64>,
    circle: ChainCircle,
    place: usize,
}

/// Choices of orientations at eight points of the circle.
#[derive(Debug, Clone, Copy)]
struct SignChoice {
    defect: ComplexBatch,
    /// Signed heights of the steps after the turn.
    heights: [ComplexBatch; 2],
    at: Positions<ComplexBatch>,
}

impl SignChoice {
    /// Becomes the other where `which`.
    #[inline(always)]
    fn take(&mut self, other: &Self, which: [bool; LANES]) {
        self.defect = other.defect.select(self.defect, which);
        for t in 0..2 {
            self.heights[t] = other.heights[t].select(self.heights[t], which);
        }
        for k in 0..SLOTS {
            for i in 0..3 {
                self.at[k][i] = other.at[k][i].select(self.at[k][i], which);
            }
        }
    }
}

/// Zeros of the closure, with the joints in place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Polished {
    pub(super) u: ComplexBatch,
    at: Positions<ComplexBatch>,
    /// Last relative step of `u`.
    pub(super) step: [f64; LANES],
    /// Whether there was a finite closure to begin with.
    pub(super) found: [bool; LANES],
}

impl Polished {
    /// The joint in a slot.
    pub(super) fn joint(&self, k: usize, slot: usize) -> Vector<Complex64> {
        let [x, y, z] = &self.at[slot];
        [x.lane(k), y.lane(k), z.lane(k)]
    }

    /// The three joints of the second body.
    pub(super) fn three(&self, k: usize) -> [Vector<Complex64>; 3] {
        [self.joint(k, THREE), self.joint(k, THREE + 1), self.joint(k, THREE + 2)]
    }
}

impl<'a> ChainBranch<'a> {
    /// `None` when the circle is degenerate.
    pub(super) fn new(
        chain: &'a TrilaterationChain,
        lengths: &'a [Complex64],
        fixed: &Positions<Complex64>,
    ) -> Option<Self> {
        let turn = chain.turn?;
        let s = turn.distances.map(|d| d.value(lengths));
        let circle = ChainCircle::of(turn.axis.map(|k| &fixed[k]), s)?;
        Some(Self { chain, lengths, fixed: *fixed, circle, place: turn.place })
    }

    #[inline(always)]
    fn start<T: LaneNumber>(&self, u: T) -> Positions<T> {
        let mut at = [[T::constant(Complex64::ZERO); 3]; SLOTS];
        for k in 0..SLOTS {
            for i in 0..3 {
                at[k][i] = T::constant(self.fixed[k][i]);
            }
        }
        at[self.place] = self.circle.point(u);
        at
    }

    /// The product of the closures over all orientations and of the powers of the Gram determinants.
    #[inline(always)]
    pub(super) fn product<T: LaneNumber>(&self, u: T, e: Exponents) -> T {
        let mut at = self.start(u);
        let one = T::constant(Complex64::ONE);
        let last = |at: &Positions<T>| self.chain.defect(at, self.lengths).unwrap_or(one);
        match self.chain.after[..] {
            [] => last(&at),
            [step] => {
                let places = TrilaterationChain::places(&step, &at, self.lengths);
                let mut out = power(places.gram, e[0]);
                for q in places.both() {
                    at[step.place] = q;
                    out = out * last(&at);
                }
                out
            }
            [first, second, ..] => {
                let places = TrilaterationChain::places(&first, &at, self.lengths);
                let mut out = power(places.gram, e[0]);
                for q in places.both() {
                    at[first.place] = q;
                    let next = TrilaterationChain::places(&second, &at, self.lengths);
                    out = out * power(next.gram, e[1]);
                    for r in next.both() {
                        at[second.place] = r;
                        out = out * last(&at);
                    }
                }
                out
            }
        }
    }

    /// The Gram determinant of the first step after the turn, and the product of those of the second.
    pub(super) fn grams(&self, u: Complex64) -> [Complex64; 2] {
        let mut at = self.start(u);
        let mut out = [Complex64::ONE; 2];
        let Some(first) = self.chain.after.first() else { return out };
        let places = TrilaterationChain::places(first, &at, self.lengths);
        out[0] = places.gram;
        let Some(second) = self.chain.after.get(1) else { return out };
        for q in places.both() {
            at[first.place] = q;
            out[1] *= TrilaterationChain::places(second, &at, self.lengths).gram;
        }
        out
    }

    /// The product at many points, on vector units.
    pub(super) fn products(&self, points: &[Complex64], e: Exponents) -> Vec<Complex64> {
        let mut out = Vec::with_capacity(points.len());
        for chunk in points.chunks(LANES) {
            let values = on_vector_unit(ChainProduct { branch: self, u: batch_of(chunk), e });
            out.extend((0..chunk.len()).map(|k| values.lane(k)));
        }
        out
    }

    /// Ehrlich-Aberth sweeps on the product itself, of degree `2 degree` in `u` after multiplication by `u^degree`. Its
    /// coefficients lose digits that are small beside the largest value on the circle; the product keeps them.
    pub(super) fn separate(&self, zeros: &mut [Complex64], e: Exponents, degree: usize) {
        for _ in 0..SWEEPS {
            let nudged = zeros.iter().map(|u| u * (1.0 + NUDGE));
            let points: Vec<Complex64> = zeros.iter().copied().chain(nudged).collect();
            let values = self.products(&points, e);
            let mut largest = 0.0_f64;
            for k in 0..zeros.len() {
                let u = zeros[k];
                let growth = (values[zeros.len() + k] / values[k] - 1.0) / NUDGE + degree as f64;
                let others = zeros.iter().enumerate().filter(|(j, _)| *j != k);
                let repulsion: Complex64 = others.map(|(_, v)| (u - v).inv()).filter(|w| w.is_finite()).sum();
                let step = (growth / u - repulsion).inv();
                if step.is_finite() && step.norm_sqr() < 0.25 * u.norm_sqr() {
                    zeros[k] -= step;
                    largest = largest.max(step.norm_sqr() / u.norm_sqr());
                }
            }
            if largest < 1e-16 {
                break;
            }
        }
    }

    /// Eight choices at `u`: `upper` says for which a step's height is taken as it is, for the others with the other
    /// sign.
    #[inline(always)]
    fn choice(&self, u: ComplexBatch, upper: impl Fn(usize, ComplexBatch) -> [bool; LANES]) -> SignChoice {
        let mut at = self.start(u);
        let mut heights = [ComplexBatch::ZERO; 2];
        for (t, step) in self.chain.after.iter().enumerate() {
            let places: TrilateratedPlaces<ComplexBatch> =
                TrilaterationChain::places(step, &at, self.lengths);
            heights[t] = places.height.select(-places.height, upper(t, places.height));
            at[step.place] = places.at_height(heights[t]);
        }
        let one = ComplexBatch::real(1.0);
        SignChoice { defect: self.chain.defect(&at, self.lengths).unwrap_or(one), heights, at }
    }

    /// The choices at `u` that continue `near`.
    #[inline(always)]
    fn following(&self, u: ComplexBatch, near: &SignChoice) -> SignChoice {
        self.choice(u, |t, h| {
            let (same, other) = ((h - near.heights[t]).norm_sqr(), (h + near.heights[t]).norm_sqr());
            let mut upper = [false; LANES];
            for k in 0..LANES {
                upper[k] = same[k] <= other[k];
            }
            upper
        })
    }

    /// The choices at `u` whose closure is least, and where there is one.
    #[inline(always)]
    fn least(&self, u: ComplexBatch) -> (SignChoice, [bool; LANES]) {
        let zero = ComplexBatch::ZERO;
        let mut out = SignChoice { defect: zero, heights: [zero; 2], at: [[zero; 3]; SLOTS] };
        let mut least = [f64::INFINITY; LANES];
        for signs in 0..1 << self.chain.after.len() {
            let choice = self.choice(u, |t, _| [(signs >> t) & 1 == 0; LANES]);
            let size = choice.defect.norm_sqr();
            let mut less = [false; LANES];
            for k in 0..LANES {
                less[k] = size[k] < least[k];
                least[k] = if less[k] { size[k] } else { least[k] };
            }
            out.take(&choice, less);
        }
        let mut found = [false; LANES];
        for k in 0..LANES {
            found[k] = least[k] < f64::INFINITY;
        }
        (out, found)
    }

    /// Newton's method from near zeros on the closure of the choice of orientations that is least there.
    #[inline(always)]
    fn polished(&self, mut u: ComplexBatch) -> Polished {
        let (mut choice, found) = self.least(u);
        let (mut step, mut moving) = ([f64::INFINITY; LANES], found);
        for _ in 0..6 {
            let nudged = u.times(1.0 + NUDGE);
            let other = self.following(nudged, &choice);
            let slope = (other.defect - choice.defect) * (nudged - u).reciprocal();
            let change = choice.defect * slope.reciprocal();
            let next = self.following(u - change, &choice);
            let (change_size, size, defect) = (change.norm_sqr(), u.norm_sqr(), next.defect.norm_sqr());
            let mut goes = [false; LANES];
            for k in 0..LANES {
                let relative = (change_size[k] / size[k]).sqrt();
                // a step that does not shrink is rounding, or no convergence
                let shrinks = relative < 0.5 * step[k] && relative < 0.2;
                goes[k] = moving[k] && shrinks && defect[k] < f64::INFINITY;
                step[k] = if goes[k] { relative } else { step[k] };
                moving[k] = goes[k] && relative >= 1e-10;
            }
            u = (u - change).select(u, goes);
            choice.take(&next, goes);
            if !moving.contains(&true) {
                break;
            }
        }
        Polished { u, at: choice.at, step, found }
    }

    /// [`Polished`] of at most [`LANES`] points, on vector units.
    pub(super) fn polished_near(&self, points: &[Complex64]) -> Polished {
        on_vector_unit(Polishing { branch: self, u: batch_of(points) })
    }
}

/// Points side by side, the last repeated.
fn batch_of(points: &[Complex64]) -> ComplexBatch {
    let mut out = ComplexBatch::ZERO;
    for k in 0..LANES {
        let z = points[k.min(points.len() - 1)];
        (out.re[k], out.im[k]) = (z.re, z.im);
    }
    out
}

struct Polishing<'a, 'b> {
    branch: &'b ChainBranch<'a>,
    u: ComplexBatch,
}

impl pulp::WithSimd for Polishing<'_, '_> {
    type Output = Polished;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> Polished {
        self.branch.polished(self.u)
    }
}

struct ChainProduct<'a, 'b> {
    branch: &'b ChainBranch<'a>,
    u: ComplexBatch,
    e: Exponents,
}

impl pulp::WithSimd for ChainProduct<'_, '_> {
    type Output = ComplexBatch;

    #[inline(always)]
    fn with_simd<S: pulp::Simd>(self, _: S) -> ComplexBatch {
        self.branch.product(self.u, self.e)
    }
}

#[inline(always)]
fn power<T: LaneNumber>(z: T, n: u32) -> T {
    let mut out = T::constant(Complex64::ONE);
    for _ in 0..n {
        out = out * z;
    }
    out
}
