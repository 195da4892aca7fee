//! A design opened for a page.

use thiserror::Error;

use ask::equivalents::Original;
use ask::{Design, PoseFrames};
use machine::rotary::RotaryPlatform;
use optimize::offsets::OffsetProblem;
use platform::geom::{Pose, PoseConvention};
use platform::manipulator::Manipulator;
use synthesis::{AffineLegMap, InstantiateError, Pattern};

/// A design with the data of its page: its octahedral platform, home, and the starting offsets.
#[derive(Debug, Clone)]
pub struct Session {
    pub(super) design: Design,
    pub(super) original: Option<Original>,
    pub(super) start: Option<Equivalent>,
    /// The cranks, for rods on cranks; there is then no octahedral original.
    pub(super) cranks: Option<RotaryPlatform>,
    pub(super) home: Pose,
    /// The limits of the least distance of joint centres and the least `|det A|`.
    pub(super) limits: (f64, f64),
    /// Whether the page is for users without a design.
    pub(super) without_design: bool,
}

/// One of the equivalent platforms.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Equivalent {
    pub(super) pattern: Pattern,
    pub(super) offsets: Vec<f64>,
}

/// A platform that cannot be shown first.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum InvalidStart {
    /// The design has no equivalents to choose from.
    #[error(
        "the design is neither octahedral nor made from an octahedral platform by offsets on the sides of two triangles"
    )]
    NoOriginal,
    /// The offsets do not fit the pattern.
    #[error(transparent)]
    Offsets(#[from] InstantiateError),
    /// The starting design is invalid.
    #[error("the page without a design has none to begin with: {0}")]
    Design(String),
}

impl Session {
    /// Opens a design. The page of an octahedral design starts with an equivalent without shared joints, if possible
    /// one that is regular and meets the requirements. The page of an equivalent design starts with the design itself.
    #[must_use]
    pub fn new(design: Design) -> Self {
        // the cranks of a parsed design always make a platform
        let cranks = design.rotary().ok().flatten();
        let original = if cranks.is_some() { None } else { Original::of(&design) };
        let table = &design.optimize;
        let defaults =
            original.as_ref().map(|o| OffsetProblem::with_defaults(o.octahedral.clone(), Vec::new()));
        let spacing = defaults.as_ref().map_or(0.0, |d| d.min_joint_distance);
        let least = defaults.as_ref().map_or(0.0, |d| d.min_abs_det);
        let mut session = Self {
            start: None,
            cranks,
            home: design.home_or_default(),
            limits: (table.min_joint_distance.unwrap_or(spacing), table.min_abs_det.unwrap_or(least)),
            original,
            design,
            without_design: false,
        };
        session.start = session.first_equivalent();
        session
    }

    /// The design itself as an equivalent, or else the platform without shared joints with regular offsets.
    fn first_equivalent(&self) -> Option<Equivalent> {
        let (pattern, offsets) = if let Some(seen) = self.original.as_ref()?.seen.clone() {
            seen
        } else {
            let pattern = Pattern::new([false; 6], [1; 6])?;
            let offsets = self.first_offsets(&pattern).ok()?;
            (pattern, offsets)
        };
        Some(Equivalent { pattern, offsets })
    }

    /// The same session with another equivalent platform at the start.
    ///
    /// # Errors
    /// [`InvalidStart`] if there are no equivalents, or the offsets do not fit.
    pub fn starting_with(mut self, pattern: Pattern, offsets: Vec<f64>) -> Result<Self, InvalidStart> {
        let original = self.original.as_ref().ok_or(InvalidStart::NoOriginal)?;
        pattern.instantiate(&original.octahedral, &offsets)?;
        self.start = Some(Equivalent { pattern, offsets });
        Ok(self)
    }

    /// The design.
    #[must_use]
    pub fn design(&self) -> &Design {
        &self.design
    }

    /// The platform that the page shows first: the starting equivalent, or else the design.
    #[must_use]
    pub fn shown(&self) -> Design {
        let equivalent = self.start.as_ref().and_then(|e| self.second(e).ok());
        equivalent.map_or_else(|| self.design.clone(), |(design, _)| design)
    }

    /// The convention of the poses that people type and see: `[frames]` of the design.
    pub(super) fn frames(&self) -> PoseFrames {
        PoseFrames { home: self.home, ..self.design.pose_frames(PoseConvention::default()) }
    }

    /// The octahedral original, or else the design itself.
    pub(super) fn first(&self) -> &Design {
        self.original.as_ref().map_or(&self.design, |o| &o.design)
    }

    /// Whether the requirements of the file apply to [`first`](Self::first); requirements of a platform without shared
    /// joints do not apply to its original.
    pub(super) fn first_is_given(&self) -> bool {
        self.original.as_ref().is_none_or(|o| o.seen.is_none())
    }

    /// The equivalent platform as a design with its leg map from the original.
    pub(super) fn second(&self, e: &Equivalent) -> Result<(Design, AffineLegMap), InvalidStart> {
        let original = self.original.as_ref().ok_or(InvalidStart::NoOriginal)?;
        Ok(original.equivalent(&e.pattern, &e.offsets)?)
    }

    /// The poses for the conditioning: the poses of the workspace, home first.
    pub(super) fn assessed_poses(&self) -> Vec<Pose> {
        self.design.workspace_or_default().sample(&self.home)
    }

    /// Size of both bodies at home, which a picture has to contain.
    pub(super) fn reach(&self) -> (nalgebra::Point3<f64>, f64) {
        let m: &Manipulator = self.first().manipulator();
        let ends: Vec<_> = m.legs().iter().flat_map(|l| [l.base, self.home.transform(&l.platform)]).collect();
        let centre = nalgebra::Point3::from(
            ends.iter().map(|p| p.coords).sum::<nalgebra::Vector3<f64>>() / ends.len() as f64,
        );
        // the tips of the cranks move around the base joints
        let crank = self.cranks.iter().flat_map(RotaryPlatform::legs).map(|leg| leg.crank.length);
        (centre, ends.iter().map(|p| (p - centre).norm()).fold(0.0, f64::max) + crank.fold(0.0, f64::max))
    }
}
