//! All patterns, and their classes under the symmetries of the hexagon.

use super::pattern::Pattern;

/// Every pattern of six independent points of the hexagon, by number of offsets.
///
/// The loop tries all choices of unchanged legs and of zero, one or two inner points per side that give six points.
/// [`Pattern::new`] keeps those whose `det A` is not the zero polynomial.
#[must_use]
pub fn enumerate() -> Vec<Pattern> {
    let mut patterns: Vec<Pattern> = (0..64u32)
        .flat_map(|kept| (0..729u32).map(move |moved| (kept, moved)))
        .filter_map(|(kept, moved)| {
            let vertices = std::array::from_fn(|i| kept >> i & 1 == 1);
            let inner = std::array::from_fn(|k| (moved / 3u32.pow(k as u32) % 3) as u8);
            let points = kept.count_ones() + inner.iter().map(|m| u32::from(*m)).sum::<u32>();
            if points == 6 { Pattern::new(vertices, inner) } else { None }
        })
        .collect();
    patterns.sort_unstable();
    patterns
}

/// A symmetry of the hexagon: vertex `i` goes to `shift + i` or, reflected, to `shift - i` (mod 6).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Symmetry {
    shift: usize,
    reflected: bool,
}

impl Symmetry {
    /// The twelve symmetries of the hexagon; half of them exchange base and platform.
    pub fn all() -> impl Iterator<Item = Self> {
        (0..6).flat_map(|shift| [false, true].map(|reflected| Self { shift, reflected }))
    }

    fn vertex(self, i: usize) -> usize {
        (self.shift + if self.reflected { 6 - i % 6 } else { i }) % 6
    }

    fn side(self, k: usize) -> usize {
        if self.reflected { self.vertex(k + 1) } else { self.vertex(k) }
    }

    /// Whether it maps even sides to even sides, so that base stays base.
    #[must_use]
    pub fn keeps_bodies(self) -> bool {
        self.side(0).is_multiple_of(2)
    }

    /// The image of a pattern.
    #[must_use]
    pub fn apply(self, pattern: &Pattern) -> Pattern {
        let (mut vertices, mut inner) = ([false; 6], [0; 6]);
        for i in 0..6 {
            vertices[self.vertex(i)] = pattern.vertices()[i];
            inner[self.side(i)] = pattern.inner()[i];
        }
        Pattern::new(vertices, inner).unwrap_or_else(|| unreachable!("symmetries keep independence"))
    }
}

/// The least pattern of the orbit of `pattern`, under the symmetries that keep base and platform apart or,
/// with `exchange`, under all twelve.
#[must_use]
pub fn representative(pattern: &Pattern, exchange: bool) -> Pattern {
    Symmetry::all()
        .filter(|s| exchange || s.keeps_bodies())
        .map(|s| s.apply(pattern))
        .min()
        .unwrap_or_else(|| pattern.clone())
}
