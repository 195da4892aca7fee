//! The way from coplanar points to the leg map of an equivalent platform, step by step.
//!
//! A joint `Q` is on the line of two joints `X` and `Y`, whose legs share the joint `F` of the other body. The four
//! points are then coplanar at every pose. Their Cayley-Menger determinant therefore vanishes. With `d = |XY|` and
//! `Q = X + t (Y - X)` it is the square
//!
//! ```text
//! D(X, Y, Q, F) = -2 d^2 (s' - (1 - t) s_X - t s_Y + t (1 - t) d^2)^2,
//! ```
//!
//! so that each moved leg gives one row of `A` and of `c`. Source: Rojas, Borras, Thomas (2010), eq. 7.

use num::algebraic::Algebraic;
use platform::manipulator::{ExactLegs, LegIndex, Manipulator, Octahedral};

use crate::determinant::{Factor, offset_products};
use crate::hexagon::{HexagonPoint, JointLabel, Offset, corner, edge, sliding_body};
use crate::pattern::Pattern;

/// One leg that moves along the line of two legs with a common joint.
#[derive(Debug, Clone, PartialEq)]
pub struct LegSlide {
    /// The leg that moves.
    pub leg: usize,
    /// The legs `X F` and `Y F`.
    pub between: [usize; 2],
    /// The joints `X` and `Y`.
    pub ends: [JointLabel; 2],
    /// The new joint `Q`.
    pub moved: JointLabel,
    /// The fixed joint `F`.
    pub fixed: JointLabel,
    /// `t`, with `Q = X + t (Y - X)`.
    pub share: Algebraic,
    /// `d^2 = |XY|^2`, design units squared.
    pub square: Algebraic,
}

impl LegSlide {
    /// `1 - t`.
    #[must_use]
    pub fn rest(&self) -> Algebraic {
        &Algebraic::integer(1) - &self.share
    }

    /// `-t (1 - t) d^2`, the entry of `c`.
    #[must_use]
    pub fn constant(&self) -> Algebraic {
        -&(&(&self.share * &self.rest()) * &self.square)
    }

    /// `|XQ|^2` and `|YQ|^2`.
    #[must_use]
    pub fn squares_to_ends(&self) -> [Algebraic; 2] {
        [self.share.clone(), self.rest()].map(|t| &(&t * &t) * &self.square)
    }
}

/// The derivation of the leg map of one platform of the class.
#[derive(Debug, Clone, PartialEq)]
pub struct Derivation {
    /// Whether all numbers are those of exact joints, with joints exactly on their lines. Otherwise they are those of
    /// the doubles.
    pub exact: bool,
    /// One row of `A` for each moved leg, all offsets at once, from the legs of the octahedral platform. The rows are
    /// in the cyclic order of the legs.
    pub moves: Vec<LegSlide>,
    /// The same with one offset at a time, in an order in which each leg slides along the line of two existing legs.
    /// `None` if every order passes through two coincident legs.
    pub sequence: Option<Vec<LegSlide>>,
    /// The factors of `det A` with their values.
    pub factors: Vec<(Factor, Algebraic)>,
    /// `prod (1 - t)` and `prod t` for the platform without shared joints; their difference is `det A`.
    pub products: Option<[Algebraic; 2]>,
}

impl Derivation {
    /// The derivation of the platform `built` by `pattern` from `original`, in which `o` was recognised. `None` if an
    /// edge has no length, which is impossible for an octahedral platform.
    #[must_use]
    pub fn of(
        o: &Octahedral,
        original: &Manipulator,
        pattern: &Pattern,
        built: &Manipulator,
    ) -> Option<Self> {
        let order = o.order().map(LegIndex::get);
        let [from, to] = [original, built].map(ExactLegs::of);
        let (mut exact, [from, to]) = match (from, to) {
            (Some(from), Some(to)) => (true, [from, to]),
            _ => (false, [ExactLegs::of_doubles(&original.legs())?, ExactLegs::of_doubles(&built.legs())?]),
        };
        let slots = pattern.legs();
        let mut shares = Vec::new();
        for (slot, point) in slots.iter().enumerate() {
            let HexagonPoint::Inner(offset) = *point else { continue };
            let body = sliding_body(offset.side);
            let end = |k: usize| &from.ends(body)[order[k % 6]][1..];
            let (x, y, q) = (end(offset.side), end(offset.side + 1), &to.ends(body)[order[slot]][1..]);
            let along: Vec<Algebraic> = y.iter().zip(x).map(|(y, x)| y - x).collect();
            let square: Algebraic = along.iter().map(|a| a * a).sum();
            if square.is_zero() {
                return None;
            }
            let way: Algebraic = q.iter().zip(x).zip(&along).map(|((q, x), a)| &(q - x) * a).sum();
            let share = &way / &square;
            exact &= q.iter().zip(x).zip(&along).all(|((q, x), a)| *q == &(&share * a) + x);
            shares.push((offset, share, square));
        }
        let sides = Sides { shares, order };
        let at = |offset: Offset| sides.of(offset).0;
        let one = Algebraic::integer(1);
        let factors = pattern.factors().iter().map(|f| (*f, f.value(&one, at))).collect();
        let cycle = pattern.factors().contains(&Factor::Cycle);
        let products = cycle.then(|| offset_products(&one, pattern.offsets().into_iter().map(at)).into());
        let moves = slots.iter().enumerate().filter_map(|(slot, point)| {
            let HexagonPoint::Inner(offset) = *point else { return None };
            let ends = [offset.side, (offset.side + 1) % 6];
            sides.slide(slot, offset, ends, ends.map(HexagonPoint::Vertex))
        });
        let moves = moves.collect();
        let sequence = sides.one_at_a_time(&slots);
        Some(Self { exact, moves, sequence, factors, products })
    }
}

/// The shares of the offsets of a pattern, and the squares of their edges.
struct Sides {
    shares: Vec<(Offset, Algebraic, Algebraic)>,
    order: [usize; 6],
}

impl Sides {
    /// The share and the squared edge of an offset of the pattern.
    fn of(&self, offset: Offset) -> (Algebraic, Algebraic) {
        let found = self.shares.iter().find(|(own, ..)| *own == offset);
        found.map_or_else(
            || unreachable!("each offset of a pattern has a share"),
            |(_, share, square)| (share.clone(), square.clone()),
        )
    }

    /// Position of a point on its side.
    fn position(&self, side: usize, point: HexagonPoint) -> Algebraic {
        match point {
            HexagonPoint::Vertex(i) => Algebraic::integer(i64::from(i != side)),
            HexagonPoint::Inner(offset) => self.of(offset).0,
        }
    }

    /// The leg of `slot` moves to `offset` on the line of the legs of the slots `between`, which are at `points`.
    fn slide(
        &self,
        slot: usize,
        offset: Offset,
        between: [usize; 2],
        points: [HexagonPoint; 2],
    ) -> Option<LegSlide> {
        let (side, body) = (offset.side, sliding_body(offset.side));
        let (share, square) = self.of(offset);
        let [x, y] = points.map(|p| self.position(side, p));
        let length = &y - &x;
        if length.is_zero() {
            return None;
        }
        let label = |p: HexagonPoint| p.joints()[body.index()];
        Some(LegSlide {
            leg: self.order[slot],
            between: between.map(|k| self.order[k]),
            ends: points.map(|p| match p {
                HexagonPoint::Vertex(i) => JointLabel::Corner(edge(side)[usize::from(i != side)]),
                HexagonPoint::Inner(_) => label(p),
            }),
            moved: JointLabel::OnEdge(offset),
            fixed: JointLabel::Corner(corner(body.other(), side)),
            share: &(&share - &x) / &length,
            square: &(&length * &length) * &square,
        })
    }

    /// An order of single moves to the points, each along the line of two legs at different places.
    fn one_at_a_time(&self, target: &[HexagonPoint; 6]) -> Option<Vec<LegSlide>> {
        let (mut now, mut path) = (std::array::from_fn(HexagonPoint::Vertex), Vec::new());
        self.extend(&mut now, target, &mut path).then_some(path)
    }

    fn extend(
        &self,
        now: &mut [HexagonPoint; 6],
        target: &[HexagonPoint; 6],
        path: &mut Vec<LegSlide>,
    ) -> bool {
        if now == target {
            return true;
        }
        for slot in (0..6).filter(|slot| now[*slot] != target[*slot]).collect::<Vec<_>>() {
            let HexagonPoint::Inner(offset) = target[slot] else { continue };
            let on: Vec<usize> = (0..6).filter(|k| now[*k].is_on_side(offset.side)).collect();
            let other = match on[..] {
                [a, b] if a == slot => b,
                [a, b] if b == slot => a,
                _ => continue,
            };
            let Some(step) = self.slide(slot, offset, [slot, other], [now[slot], now[other]]) else {
                continue;
            };
            path.push(step);
            let left = std::mem::replace(&mut now[slot], target[slot]);
            if self.extend(now, target, path) {
                return true;
            }
            now[slot] = left;
            path.pop();
        }
        false
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Family;
    use crate::hexagon::tests::example;
    use num::exact::Rational;

    fn rational(n: i64, d: i64) -> Algebraic {
        Algebraic::from(Rational::new(n.into(), d.into()))
    }

    /// The determinant of a square matrix by expansion along its first row.
    fn expansion(rows: &[Vec<Algebraic>]) -> Algebraic {
        if rows.is_empty() {
            return Algebraic::integer(1);
        }
        let minor = |k: usize| -> Vec<Vec<Algebraic>> {
            let without = |row: &Vec<Algebraic>| [&row[..k], &row[k + 1..]].concat();
            rows[1..].iter().map(without).collect()
        };
        (0..rows.len())
            .map(|k| {
                &(&rows[0][k] * &expansion(&minor(k))) * &Algebraic::integer(if k % 2 == 0 { 1 } else { -1 })
            })
            .sum()
    }

    #[test]
    fn the_cayley_menger_determinant_is_the_square_of_the_relation() {
        let int = Algebraic::integer;
        let of = |share: Algebraic, square: Algebraic| LegSlide {
            leg: 0,
            between: [0, 1],
            ends: [JointLabel::Corner(0), JointLabel::Corner(1)],
            moved: JointLabel::OnEdge(Offset { side: 0, second: false }),
            fixed: JointLabel::Corner(3),
            share,
            square,
        };
        for (t, d, s) in [
            (rational(1, 5), int(144), [int(300), int(324), int(290)]),
            (rational(-3, 7), rational(36, 5), [int(30), rational(7, 2), rational(11, 3)]),
            (rational(9, 4), int(2), [int(5), int(8), int(13)]),
        ] {
            let step = of(t, d);
            let [x, y] = step.squares_to_ends();
            let (zero, one, d) = (int(0), int(1), step.square.clone());
            let [s_x, s_y, s_q] = &s;
            let row = |list: [&Algebraic; 5]| list.map(Clone::clone).to_vec();
            let rows = [
                row([&zero, &one, &one, &one, &one]),
                row([&one, &zero, &d, &x, s_x]),
                row([&one, &d, &zero, &y, s_y]),
                row([&one, &x, &y, &zero, s_q]),
                row([&one, s_x, s_y, s_q, &zero]),
            ];
            let mapped = &(&(&step.rest() * s_x) + &(&step.share * s_y)) + &step.constant();
            let off = s_q - &mapped;
            assert!(!off.is_zero());
            assert_eq!(expansion(&rows), &(&int(-2) * &d) * &(&off * &off));
        }
    }

    /// All 728 patterns: rows of `A`, the factors, and an order of single moves exactly if the class has one.
    #[test]
    fn the_steps_make_the_leg_map_of_every_pattern() {
        let o = example();
        let original = Pattern::new([true; 6], [0; 6]).unwrap().instantiate(&o, &[]).unwrap();
        for member in Family::octahedral().members() {
            let pattern = &member.pattern;
            let offsets: Vec<f64> =
                (0..pattern.offsets().len()).map(|k| [0.25, 0.625, -0.5, 1.25, 0.375, 0.75][k]).collect();
            let built = pattern.instantiate(&o, &offsets).unwrap();
            let map = pattern.leg_map(&o, &offsets).unwrap();
            let steps = Derivation::of(&o, &original, pattern, &built).unwrap();
            let near = |x: &Algebraic, y: f64| (x.approximate() - y).abs() < 1e-9 * (1.0 + y.abs());
            for step in &steps.moves {
                let [x, y] = step.between;
                assert!(near(&step.rest(), map.a[(step.leg, x)]) && near(&step.share, map.a[(step.leg, y)]));
                assert!(near(&step.constant(), map.c[step.leg]));
            }
            let product = |list: Vec<Algebraic>| list.iter().fold(Algebraic::integer(1), |p, x| &p * x);
            let determinant = product(steps.factors.iter().map(|(_, value)| value.clone()).collect());
            assert!(near(&determinant, pattern.determinant(&offsets).unwrap()), "{pattern}");
            assert_eq!(steps.sequence.is_some(), member.sequential, "{pattern}");
            if let Some(sequence) = &steps.sequence {
                // each step contributes 1 - t of its own leg: the determinant is their product
                let of_steps = product(sequence.iter().map(LegSlide::rest).collect());
                assert!(near(&of_steps, pattern.determinant(&offsets).unwrap()), "{pattern}");
                assert!(sequence.iter().all(|step| step.between[0] == step.leg));
            }
        }
    }
}
