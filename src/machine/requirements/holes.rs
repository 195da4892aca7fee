//! Grids of holes: the possible places of the joints of a plate.

num::words! {
    /// The pattern of the holes of a grid.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    #[cfg_attr(
        feature = "serde",
        derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
        serde(rename_all = "snake_case")
    )]
    pub enum HolePattern: name, ALL {
        /// On squares.
        #[default]
        Square = "square",
        /// On equilateral triangles. The grid is symmetric under rotations by 60 degrees about a hole, and by 120
        /// degrees about the middle of a triangle.
        Triangular = "triangular",
        /// On rings about the origin whose radii grow by the pitch, with the same number of holes on each.
        Polar = "polar",
        /// On circles about the origin with given radii and numbers of holes.
        BoltCircle = "bolt_circle",
    }
}

impl HolePattern {
    /// Cosine of the angle between the two axes along which holes are counted; `None` where they are counted on
    /// circles.
    #[must_use]
    pub fn skew(self) -> Option<f64> {
        match self {
            Self::Square => Some(0.0),
            Self::Triangular => Some(0.5),
            Self::Polar | Self::BoltCircle => None,
        }
    }
}

/// Holes on a circle, equally spaced.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), schemars(rename = "HoleCircleRecord", transform = num::nullable))]
pub struct HoleCircle {
    /// The radius.
    // design units, positive
    pub radius: f64,
    /// The number of holes.
    // at least one
    pub holes: u32,
}

/// The circles of a grid, at most [`Self::MOST`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct HoleCircles {
    list: [HoleCircle; Self::MOST],
    count: usize,
}

impl HoleCircles {
    /// Circles that a grid can state.
    pub const MOST: usize = 16;
    /// No circle.
    pub const NONE: Self = Self { list: [HoleCircle { radius: 0.0, holes: 0 }; Self::MOST], count: 0 };

    /// These circles; `None` where there are more than [`Self::MOST`].
    #[must_use]
    pub fn new(circles: &[HoleCircle]) -> Option<Self> {
        let mut out = Self::NONE;
        out.list.get_mut(..circles.len())?.copy_from_slice(circles);
        out.count = circles.len();
        Some(out)
    }

    /// In the order in which they were given.
    #[must_use]
    pub fn as_slice(&self) -> &[HoleCircle] {
        self.list.get(..self.count).unwrap_or(&[])
    }

    /// The circles with all radii changed.
    #[must_use]
    pub fn scaled(mut self, of: impl Fn(f64) -> f64) -> Self {
        for circle in self.list.iter_mut().take(self.count) {
            circle.radius = of(circle.radius);
        }
        self
    }
}

/// A grid of holes.
///
/// Its first axis is the x axis of the body frame, projected on the plane of the joints and rotated by the angle. The
/// second axis is 90 degrees from it on a square grid, 60 degrees on a triangular one. Its origin is the projection of
/// the origin of the frame, shifted along the x and y axes.
///
/// On circles hole `j` of circle `k` with `n` holes is at
/// `origin + r_k (cos(angle + j 360 / n), sin(angle + j 360 / n))`. The radii of a polar grid are
/// `r_k = first + k pitch`, unlimited; those of bolt circles are listed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// The pattern of the holes.
    pub pattern: HolePattern,
    /// Distance of neighbouring holes, or of neighbouring rings of a polar grid, design units, positive; 0 for bolt
    /// circles.
    pub pitch: f64,
    /// The first ring of a polar grid, or all bolt circles; none for the other patterns.
    pub circles: HoleCircles,
    /// A hole, or the centre of the circles, in the axes of the frame before the rotation of the grid, design units.
    pub origin: [f64; 2],
    /// Rotation about the normal of the plane, degrees.
    pub angle_deg: f64,
}

impl Grid {
    /// A square grid of this pitch with a hole at the origin, along the axes of the frame.
    #[must_use]
    pub const fn square(pitch: f64) -> Self {
        let circles = HoleCircles::NONE;
        Self { pattern: HolePattern::Square, pitch, circles, origin: [0.0; 2], angle_deg: 0.0 }
    }

    /// The triangular grid of this pitch with a hole at the origin and holes along the x axis.
    #[must_use]
    pub fn triangular(pitch: f64) -> Self {
        Self { pattern: HolePattern::Triangular, ..Self::square(pitch) }
    }

    /// The polar grid of this pitch about the origin with this first ring.
    #[must_use]
    pub fn polar(first: HoleCircle, pitch: f64) -> Self {
        let mut circles = HoleCircles::NONE;
        (circles.list[0], circles.count) = (first, 1);
        Self { pattern: HolePattern::Polar, circles, ..Self::square(pitch) }
    }

    /// Bolt circles about the origin.
    #[must_use]
    pub fn bolt_circles(circles: HoleCircles) -> Self {
        Self { pattern: HolePattern::BoltCircle, circles, ..Self::square(0.0) }
    }

    /// Whether its lengths and counts are valid: all finite, used radii, counts and pitch positive, and circles present
    /// if the pattern needs them.
    #[must_use]
    pub fn is_usable(&self) -> bool {
        let finite = self.origin.iter().chain([&self.angle_deg]).all(|x| x.is_finite());
        let positive = |x: f64| x > 0.0 && x.is_finite();
        let circles = self.circles.as_slice();
        let round = circles.iter().all(|c| positive(c.radius) && c.holes > 0);
        let spaced = positive(self.pitch) || self.pattern == HolePattern::BoltCircle;
        let counted = match self.pattern {
            HolePattern::Square | HolePattern::Triangular => true,
            HolePattern::Polar => circles.len() == 1,
            HolePattern::BoltCircle => !circles.is_empty(),
        };
        finite && spaced && round && counted
    }

    /// The circle with this number, from 0.
    #[must_use]
    pub fn circle(&self, number: usize) -> Option<HoleCircle> {
        match self.pattern {
            HolePattern::Polar => {
                let first = self.circles.as_slice().first()?;
                Some(HoleCircle { radius: first.radius + number as f64 * self.pitch, ..*first })
            }
            _ => self.circles.as_slice().get(number).copied(),
        }
    }
}

/// The grid in words.
impl std::fmt::Display for Grid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pattern, pitch, circles, origin: [x, y], angle_deg } = self;
        let circles = circles.as_slice();
        match pattern {
            HolePattern::Square => {
                write!(f, "pitch {pitch}, a hole at ({x}, {y}), turned by {angle_deg} deg")
            }
            HolePattern::Triangular => {
                write!(f, "triangular, pitch {pitch}, a hole at ({x}, {y}), turned by {angle_deg} deg")
            }
            HolePattern::Polar => {
                let first = circles.first().copied().unwrap_or_default();
                write!(
                    f,
                    "polar, rings of {} holes from radius {} on every {pitch}, about ({x}, {y}), turned by {angle_deg} deg",
                    first.holes, first.radius
                )
            }
            HolePattern::BoltCircle => {
                let all: Vec<String> =
                    circles.iter().map(|c| format!("{} holes at radius {}", c.holes, c.radius)).collect();
                write!(f, "bolt circles, {}, about ({x}, {y}), turned by {angle_deg} deg", all.join(", "))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn circles_are_counted_from_the_first_and_words_name_them() {
        let polar = Grid::polar(HoleCircle { radius: 100.0, holes: 24 }, 25.0);
        assert_eq!(polar.circle(3), Some(HoleCircle { radius: 175.0, holes: 24 }));
        assert!(polar.is_usable());
        let circles = [HoleCircle { radius: 80.0, holes: 12 }, HoleCircle { radius: 120.0, holes: 18 }];
        let bolts = Grid::bolt_circles(HoleCircles::new(&circles).unwrap());
        assert!(bolts.is_usable() && bolts.circle(1) == Some(circles[1]) && bolts.circle(2).is_none());
        assert!(bolts.to_string().starts_with("bolt circles, 12 holes at radius 80, 18 holes at radius 120"));
        assert!(HoleCircles::new(&[HoleCircle::default(); HoleCircles::MOST + 1]).is_none());
        // negative controls: grids without holes
        assert!(!Grid::bolt_circles(HoleCircles::NONE).is_usable());
        assert!(!Grid { pattern: HolePattern::Polar, ..Grid::square(25.0) }.is_usable());
        assert!(!Grid::polar(HoleCircle { radius: 0.0, holes: 24 }, 25.0).is_usable());
    }
}
