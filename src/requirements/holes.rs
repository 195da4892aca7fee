//! Grids of holes: where the joints of a plate can be put.

/// How the holes of a grid lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(
    feature = "files",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
pub enum HolePattern {
    /// On squares.
    #[default]
    Square,
    /// On equilateral triangles: turns by 60 degrees about a hole take the grid to itself, and turns by 120 degrees about the middle of a triangle too.
    Triangular,
}

impl HolePattern {
    /// Every pattern.
    pub const ALL: [Self; 2] = [Self::Square, Self::Triangular];

    /// Its name in files and on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Square => "square",
            Self::Triangular => "triangular",
        }
    }

    /// Cosine of the angle between the two axes along which holes are counted.
    #[must_use]
    pub fn skew(self) -> f64 {
        match self {
            Self::Square => 0.0,
            Self::Triangular => 0.5,
        }
    }
}

/// A grid of holes.
///
/// Its first axis is the x axis of the body frame, projected on the plane of the joints and turned by the angle; the second is 90 degrees from it on a square grid and 60
/// degrees on a triangular one. Its origin is the projection of the origin of the frame, shifted along the x and y axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Grid {
    /// How the holes lie.
    pub pattern: HolePattern,
    /// Distance of neighbouring holes, design units, positive.
    pub pitch: f64,
    /// A hole, in the axes of the frame before the grid is turned, design units.
    pub origin: [f64; 2],
    /// Turn about the normal of the plane, degrees.
    pub angle_deg: f64,
}

impl Grid {
    /// A square grid of this pitch with a hole at the origin, along the axes of the frame.
    #[must_use]
    pub fn square(pitch: f64) -> Self {
        Self { pattern: HolePattern::Square, pitch, origin: [0.0; 2], angle_deg: 0.0 }
    }

    /// The triangular grid of this pitch with a hole at the origin and holes along the x axis.
    #[must_use]
    pub fn triangular(pitch: f64) -> Self {
        Self { pattern: HolePattern::Triangular, ..Self::square(pitch) }
    }
}

/// The grid in words.
impl std::fmt::Display for Grid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { pattern, pitch, origin: [x, y], angle_deg } = self;
        let kind = match pattern {
            HolePattern::Square => "",
            HolePattern::Triangular => "triangular, ",
        };
        write!(f, "{kind}pitch {pitch}, a hole at ({x}, {y}), turned by {angle_deg} deg")
    }
}
