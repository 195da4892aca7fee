//! Offsets introduced one at a time.
//!
//! A *move* takes two legs of the current platform that share a joint `Y` and have different other ends `X1`, `X2`. It
//! slides the end `X1` of one of them along the line `X1 X2` to a generic point. On the hexagon, the closed side of `Y`
//! has two points, one of which is a vertex; this vertex moves into the side. Moving an inner point on its side only
//! changes the value of its offset.
//!
//! A move *splits* a joint when another leg stays behind at `X1`. Only such a move adds a joint and changes the
//! topology; otherwise the joint `X1` itself is displaced. Two inner points on one side are possible: the first leg of
//! a pair slides, then the second, which still shares `Y` with it.

use std::collections::BTreeSet;

use super::pattern::Pattern;

/// One move.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Move {
    /// Side of the hexagon on which the leg slides.
    pub side: usize,
    /// Hexagon vertex that leaves, `side` or `side + 1`.
    pub vertex: usize,
    /// Whether another leg stays at the old joint.
    pub splits: bool,
    /// The pattern reached.
    pub to: Pattern,
}

/// Number of legs on a closed side: two if the joint of the side is shared.
fn legs_on(pattern: &Pattern, side: usize) -> usize {
    pattern.legs().iter().filter(|p| p.is_on_side(side)).count()
}

/// All moves from a pattern.
#[must_use]
pub fn moves(pattern: &Pattern) -> Vec<Move> {
    let mut list = Vec::new();
    for side in (0..6).filter(|k| legs_on(pattern, *k) == 2) {
        for vertex in [side, (side + 1) % 6] {
            if !pattern.vertices()[vertex] {
                continue;
            }
            // the sliding joint belongs to the other side at this vertex
            let behind = if vertex == side { (side + 5) % 6 } else { vertex };
            let (mut vertices, mut inner) = (pattern.vertices(), pattern.inner());
            vertices[vertex] = false;
            inner[side] += 1;
            if let Some(to) = Pattern::new(vertices, inner) {
                list.push(Move { side, vertex, splits: legs_on(pattern, behind) == 2, to });
            }
        }
    }
    list
}

/// All patterns that moves reach from the octahedral one, including itself; with `splitting_only`, by moves that split
/// a joint.
#[must_use]
pub fn reachable(splitting_only: bool) -> BTreeSet<Pattern> {
    let mut reached: BTreeSet<Pattern> = Pattern::new([true; 6], [0; 6]).into_iter().collect();
    let mut front: Vec<Pattern> = reached.iter().cloned().collect();
    while let Some(pattern) = front.pop() {
        for step in moves(&pattern) {
            if (step.splits || !splitting_only) && reached.insert(step.to.clone()) {
                front.push(step.to);
            }
        }
    }
    reached
}
