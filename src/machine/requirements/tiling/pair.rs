//! Gaps between two leg bodies on a cell of a tiling.
//!
//! For every vector `u` the distance of two segments is at least `min u . (y - x) / |u|` over their ends `x` and `y`.
//! So `u . (y - x) - gap |u|` has to be non-negative for all pairs of ends. The best direction at the middle of the
//! cell is taken from nine that depend on the pose: normal to both legs, from an end of one segment across the other
//! leg, or between two ends.

use num::interval::Interval;
use num::jet::{Jet, JetVector, cross, dot, norm_squared};
use num::vector::minus;

use super::{Cell, Ends, Function, TiledRegion};
use crate::requirements::hardware::LegBody;

/// Number of directions.
const DIRECTIONS: usize = 9;

/// The line of a leg on a cell, and its cylinder and rod.
struct LegOnCell {
    base: JetVector,
    line: JetVector,
    parts: Vec<Part>,
}

/// Points within a radius of a segment.
struct Part {
    ends: [JetVector; 2],
    radius: Interval,
}

/// A part of a leg.
type PartOfLeg<'a> = (&'a LegOnCell, &'a Part);

pub(super) fn constant(x: Interval) -> Jet {
    Jet::constant(x, 6, false)
}

/// A multiple of the vector from the foot on the line of a leg to a point.
fn across(leg: &LegOnCell, point: &JetVector) -> JetVector {
    let arm = minus(point, &leg.base);
    let (along, square) = (dot(&arm, &leg.line), norm_squared(&leg.line));
    std::array::from_fn(|k| arm[k] * square - leg.line[k] * along)
}

/// A direction from the first leg to the second; only the normal of both may have the opposite sign.
fn direction(code: usize, [(leg, part), (other, theirs)]: [PartOfLeg<'_>; 2]) -> JetVector {
    match code {
        0 => cross(&leg.line, &other.line),
        1 | 2 => across(other, &part.ends[code - 1]).map(|x| -x),
        3 | 4 => across(leg, &theirs.ends[code - 3]),
        _ => minus(&theirs.ends[(code - 5) % 2], &part.ends[(code - 5) / 2]),
    }
}

/// `u . (y - x)` for the ends of two parts. A direction normal to a leg has the same product with all points of its
/// line, and its base joint is the one that never moves.
fn separations<'a>(
    code: usize,
    u: &'a JetVector,
    [(leg, part), (other, theirs)]: [PartOfLeg<'a>; 2],
) -> impl Iterator<Item = Jet> + 'a {
    let ours = if matches!(code, 0 | 3 | 4) { std::slice::from_ref(&leg.base) } else { &part.ends[..] };
    let theirs = if matches!(code, 0..=2) { std::slice::from_ref(&other.base) } else { &theirs.ends[..] };
    ours.iter().flat_map(move |x| theirs.iter().map(move |y| dot(u, &minus(y, x))))
}

impl TiledRegion {
    /// A tiling that proves the gap of two leg bodies to be at least this at every pose of the region, with the
    /// directions: a digit for each pair of parts on each proved cell.
    #[must_use]
    pub fn pair_tiling(&self, legs: [usize; 2], body: &LegBody, gap: f64) -> Option<(String, String)> {
        let mut directions = String::new();
        let tree = self.tiling(&mut |ends| match self.pair_cell(legs, body, gap, ends) {
            Ok(found) => {
                directions.push_str(&found);
                None
            }
            Err(axis) => Some(axis),
        })?;
        Some((tree, directions))
    }

    /// The directions that prove a cell, or the coordinate along which to split it.
    fn pair_cell(&self, legs: [usize; 2], body: &LegBody, gap: f64, ends: &Ends) -> Result<String, usize> {
        let (at, over) = (self.cell(&ends.middle()), self.cell(ends));
        let [first, second] = legs.map(|leg| {
            let over = self.leg_on(leg, body, &over, true);
            let at = self.leg_on(leg, body, &at, over.parts.len() == 2);
            (at, over)
        });
        if [&first, &second].iter().any(|(at, over)| at.parts.len() != over.parts.len()) {
            return Err(super::widest(&|k| ends.half(k)));
        }
        let mut directions = String::new();
        for (p, q) in (0..first.1.parts.len()).flat_map(|p| (0..second.1.parts.len()).map(move |q| (p, q))) {
            let at = [(&first.0, &first.0.parts[p]), (&second.0, &second.0.parts[q])];
            let over = [(&first.1, &first.1.parts[p]), (&second.1, &second.1.parts[q])];
            let least = Interval::from(gap) + over[0].1.radius + over[1].1.radius;
            let code = best_direction(at);
            directions.push(char::from(b'0' + code as u8));
            let [u_at, u_over] = directed(code, at, over);
            let [size_at, size_over] = [&u_at, &u_over].map(|u| norm_squared(u).root());
            let (Some(size_at), Some(size_over)) = (size_at, size_over) else {
                return Err(super::widest(&|k| ends.half(k)));
            };
            let values = separations(code, &u_at, at);
            for (value, slopes) in values.zip(separations(code, &u_over, over)) {
                let (value, slopes) = (value - size_at.times(least), slopes - size_over.times(least));
                let slopes = std::array::from_fn(|k| slopes.slope(k));
                let f = Function { value: value.value, slopes, rest: [0.0; 6] };
                if let Some(axis) = self.split(&f, ends) {
                    return Err(axis);
                }
            }
        }
        Ok(directions)
    }

    /// The line of a leg on a cell.
    pub(super) fn line_jet(&self, leg: usize, cell: &Cell) -> JetVector {
        let (values, along) = (self.line(leg, cell), [0, 1, 2, 3, 4, 5].map(|k| self.along(leg, cell, k)));
        std::array::from_fn(|j| Jet::linear(values[j], along.map(|slope| slope[j]), 6, false))
    }

    /// A leg body on a cell. It is one part with the greater radius unless the leg is proved longer than its cylinder
    /// and two parts are `wanted`.
    fn leg_on(&self, leg: usize, body: &LegBody, cell: &Cell, wanted: bool) -> LegOnCell {
        let (base, line) = (self.base[leg].map(constant), self.line_jet(leg, cell));
        let end: JetVector = std::array::from_fn(|j| base[j] + line[j]);
        let part = |from: JetVector, to: JetVector, diameter: f64| Part {
            ends: [from, to],
            radius: Interval::from(diameter) * Interval::from(0.5),
        };
        let square = norm_squared(&line);
        let longer = |cylinder: f64| wanted && square.value.lo() > Interval::from(cylinder).square().hi();
        let parts = match (body.rod, square.inverse_root()) {
            (Some((cylinder, rod)), Some(inverse)) if longer(cylinder) => {
                let share = inverse.times(Interval::from(cylinder));
                let top: JetVector = std::array::from_fn(|j| base[j] + line[j] * share);
                vec![part(base, top, body.diameter), part(top, end, rod)]
            }
            (rod, _) => vec![part(base, end, rod.map_or(body.diameter, |(_, rod)| rod.max(body.diameter)))],
        };
        LegOnCell { base, line, parts }
    }
}

/// The direction of a pair of parts at the middle of a cell and over the cell, from the first leg to the second.
fn directed(code: usize, at: [PartOfLeg<'_>; 2], over: [PartOfLeg<'_>; 2]) -> [JetVector; 2] {
    let both = [direction(code, at), direction(code, over)];
    let between = minus(&at[1].0.base, &at[0].0.base);
    let backwards = code == 0 && dot(&both[0], &between).value.centre_and_radius().0 < 0.0;
    if backwards { both.map(|u| u.map(|x| -x)) } else { both }
}

/// The direction that separates two parts most at the middle of a cell.
fn best_direction(at: [PartOfLeg<'_>; 2]) -> usize {
    let middle = |x: Jet| x.value.centre_and_radius().0;
    let separation = |code: usize| {
        let [u, _] = directed(code, at, at);
        let least = separations(code, &u, at).map(middle).fold(f64::INFINITY, f64::min);
        let size = middle(norm_squared(&u)).sqrt();
        if size > 0.0 { least / size } else { f64::NEG_INFINITY }
    };
    let separations: [f64; DIRECTIONS] = std::array::from_fn(separation);
    (0..DIRECTIONS).max_by(|i, j| separations[*i].total_cmp(&separations[*j])).unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{aside, hexapod, space};
    use super::*;
    use crate::requirements::{PoseSpace, Region, Requirements, TermKind, Terms};
    use num::Rng;

    /// The least gap of two legs over sampled poses, without clearance.
    fn sampled(body: LegBody, space: &PoseSpace, legs: [usize; 2]) -> f64 {
        let (m, mut required) = (hexapod(), Requirements::default());
        required.hardware.leg_body = Some(body);
        let terms = Terms::new(&m, &required, &space.home);
        let poses = space.cube_points(300, &mut Rng::new(1)).into_iter().map(|x| space.pose(&x));
        let gaps = poses.flat_map(|pose| terms.at(&pose));
        let own =
            gaps.filter(|(term, _)| term.kind == TermKind::LegClearance && [term.first, term.second] == legs);
        own.map(|(_, gap)| gap).fold(f64::INFINITY, f64::min)
    }

    /// Legs of one part, with a rod, and shorter than their cylinder.
    #[test]
    fn gaps_with_room_are_tiled_and_others_are_not() {
        let whole = LegBody { diameter: 30.0, rod: None };
        let thin = LegBody { diameter: 30.0, rod: Some((150.0, 12.0)) };
        let short = LegBody { diameter: 30.0, rod: Some((900.0, 12.0)) };
        for body in [whole, thin, short] {
            for space in [space(Region::Box, 0.5), space(Region::Ellipsoid, 0.5), aside(Region::Ellipsoid)] {
                let tiled = TiledRegion::new(&hexapod(), &space).unwrap();
                for legs in [[0, 1], [1, 2]] {
                    let least = sampled(body, &space, legs);
                    assert!(least.is_finite() && least > 12.0, "{least}");
                    let (tree, directions) = tiled.pair_tiling(legs, &body, 0.4 * least).unwrap();
                    let cells = tree.matches('.').count();
                    assert!(directions.len() >= cells && directions.len() <= 4 * cells);
                }
                // no cell with the worst sampled pose is proved
                let violated = sampled(body, &space, [0, 1]) + 0.5;
                assert_eq!(tiled.pair_tiling([0, 1], &body, violated), None);
            }
        }
    }
}
