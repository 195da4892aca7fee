//! Singular poses: det J at poses, along paths of poses, and over a region of poses.

use thiserror::Error;

use super::assessing::BOX_CELLS;
use crate::Design;
use fk::{Automatic, FkError, FkOptions, ForwardKinematics};
use platform::geom::{Pose, PoseSpace, Region};
use platform::manipulator::{LegLengths, Octahedral, inverse_condition, jacobian, leg_determinant};
use synthesis::singularity::{
    BoxOptions, JoinOptions, Joined, RegularBox, Regularity, SignsAlong, between, four_planes, join,
    regular_box, regular_workspace, signs_along,
};

/// Number of values of det J on each straight part of a path.
const STEPS: usize = 100;

/// The options of the singular poses around a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SingularPosesOptions {
    /// The pose in the centre.
    pub pose: Pose,
    /// Lengths for which all assembly modes are evaluated; default: the lengths at the pose.
    pub lengths: Option<LegLengths>,
    /// Half widths of a box of poses: positions, design units, and components of the rotation vector, degrees. Default:
    /// the workspace of the design.
    pub half_widths: Option<[[f64; 3]; 2]>,
    /// Greatest number of cells of a proof.
    pub cells: usize,
    /// The seed.
    pub seed: u64,
}

impl SingularPosesOptions {
    /// The poses around this one.
    #[must_use]
    pub fn about(pose: Pose) -> Self {
        Self { pose, lengths: None, half_widths: None, cells: BOX_CELLS, seed: 1 }
    }

    num::setters! {
        /// Lengths for which all assembly modes are evaluated.
        fn lengths(lengths: impl Into<Option<LegLengths>>) = lengths.into();
        /// Half widths of a box of poses: positions, design units, and components of the rotation vector, degrees.
        fn half_widths(half_widths: impl Into<Option<[[f64; 3]; 2]>>) = half_widths.into();
        /// Greatest number of cells of a proof.
        fn cells(cells: usize) = cells;
        /// The seed.
        fn seed(seed: u64) = seed;
    }
}

/// Figures of one pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseFigures {
    /// The pose.
    pub pose: Pose,
    /// `det J` of the leg lines, with lengths divided by the size.
    pub determinant: f64,
    /// Inverse condition number of the Jacobian, with unit lines and the characteristic length of the design.
    pub inverse_condition: f64,
    /// The two conditions for four planes through one point, for octahedral designs.
    pub four_planes: Option<[f64; 2]>,
}

/// The reason why poses are not evaluated.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum NoSingularPoses {
    /// At the pose a leg has no length.
    #[error("the leg lengths at this pose are not finite positive numbers")]
    NoLengths,
    /// Forward kinematics failed.
    #[error("assembly modes: {0}")]
    Modes(#[from] FkError),
}

/// Singular poses around a pose.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SingularPosesReport {
    /// The lengths of the assembly modes.
    pub lengths: LegLengths,
    /// The pose in the centre.
    pub middle: PoseFigures,
    /// All real poses with the lengths.
    pub modes: Vec<PoseFigures>,
    /// Whether the list of modes is complete.
    pub modes_complete: bool,
    /// The shape of the region.
    pub options: BoxOptions,
    /// The largest region of this shape that is proved to be regular.
    pub regular: RegularBox,
    /// Whether the workspace, or the given box, is regular, and the number of cells of the proof.
    pub safe: Option<(Regularity, usize)>,
}

impl SingularPosesReport {
    /// Whether the given region is regular; `None`: undecided. Without a region of given size, whether some box is
    /// proved regular.
    #[must_use]
    pub fn is_regular(&self) -> Option<bool> {
        match &self.safe {
            Some((regularity, _)) => regularity.is_regular(),
            None => (self.regular.proved > 0.0).then_some(true),
        }
    }

    /// det J on straight paths from one mode through poses to another. Modes count from 1; 0 is the pose in the centre.
    ///
    /// # Errors
    /// The number of a mode that does not exist.
    pub fn path(&self, design: &Design, ends: [usize; 2], via: &[Pose]) -> Result<SignPath, usize> {
        let end = |k: usize| match k.checked_sub(1) {
            None => Ok(self.middle.pose),
            Some(k) => self.modes.get(k).map(|m| m.pose).ok_or(k + 1),
        };
        let poses: Vec<Pose> =
            [&[end(ends[0])?], via, &[end(ends[1])?]].into_iter().flatten().copied().collect();
        let m = design.manipulator();
        let parts = poses.windows(2).map(|w| signs_along(m, &w[0], &w[1])).collect();
        let values = poses.windows(2).enumerate().flat_map(|(part, w)| {
            (0..=STEPS).map(move |k| {
                let u = k as f64 / STEPS as f64;
                let pose = between(&w[0], &w[1], u);
                (part, u, pose, leg_determinant(m, &pose))
            })
        });
        let values = values.collect();
        Ok(SignPath { ends, poses, parts, values })
    }

    /// All pairs of modes, and a search by random poses for paths between modes of equal sign.
    #[must_use]
    pub fn between(&self, design: &Design, options: &JoinOptions) -> SignsBetween {
        let m = design.manipulator();
        let ends: Vec<Pose> = self.modes.iter().map(|mode| mode.pose).collect();
        let pairs = (0..ends.len()).flat_map(|i| (i + 1..ends.len()).map(move |j| [i, j]));
        let straight = pairs.map(|[i, j]| ([i, j], signs_along(m, &ends[i], &ends[j]))).collect();
        SignsBetween { straight, joined: join(m, &ends, options) }
    }
}

/// det J along a path of straight parts.
#[derive(Debug, Clone)]
pub struct SignPath {
    /// The modes at its ends.
    pub ends: [usize; 2],
    /// Its poses.
    pub poses: Vec<Pose>,
    /// The signs on each straight part.
    pub parts: Vec<SignsAlong>,
    /// Sampled values `(part, u, pose, det J)`.
    pub values: Vec<(usize, f64, Pose, f64)>,
}

impl SignPath {
    /// Whether det J keeps its sign (`true`) or changes it (`false`), both proved; `None`: neither.
    #[must_use]
    pub fn keeps_sign(&self) -> Option<bool> {
        if self.parts.iter().all(|s| s.kept().is_some()) {
            return Some(true);
        }
        self.parts.iter().any(|s| s.changes().next().is_some()).then_some(false)
    }
}

/// The straight paths between all pairs of modes, and the groups of modes joined by regular paths.
#[derive(Debug, Clone)]
pub struct SignsBetween {
    /// The modes of a pair, from 0, with the signs between them.
    pub straight: Vec<([usize; 2], SignsAlong)>,
    /// Signs of the modes, groups, and paths that join them.
    pub joined: Joined,
}

impl SignsBetween {
    /// Whether some regular path joins two modes; `None`: none was found.
    #[must_use]
    pub fn joins(&self, i: usize, j: usize) -> Option<bool> {
        if self.joined.groups.iter().any(|g| g.contains(&i) && g.contains(&j)) {
            return Some(true);
        }
        match (self.joined.signs[i], self.joined.signs[j]) {
            (Some(x), Some(y)) if x != y => Some(false),
            _ => None,
        }
    }
}

impl Design {
    /// det J at a pose and at all assembly modes, and the largest proved regular region around the pose.
    ///
    /// # Errors
    /// [`NoSingularPoses`].
    pub fn singular_poses(
        &self,
        asked: &SingularPosesOptions,
    ) -> Result<SingularPosesReport, NoSingularPoses> {
        let m = self.manipulator();
        let SingularPosesOptions { pose, cells, seed, .. } = *asked;
        let lengths = asked.lengths.or_else(|| pose.lengths(m)).ok_or(NoSingularPoses::NoLengths)?;
        let octahedral = Octahedral::recognise(m).ok();
        let solutions = Automatic.solve(m, &lengths.squared(), &FkOptions::new().seed(seed))?;
        let modes = solutions.assembly_modes();
        let modes = modes.map(|r| self.pose_figures(octahedral.as_ref(), r.pose.real_part())).collect();
        let own = self.box_options(cells, seed);
        let (options, space) = match asked.half_widths {
            Some([translation, rotation_deg]) => (
                BoxOptions { region: Region::Box, translation, rotation_deg, pivot: [0.0; 3], ..own },
                Some(PoseSpace {
                    region: Region::Box,
                    translation: translation.into(),
                    rotation_deg: rotation_deg.into(),
                    ..PoseSpace::at(pose)
                }),
            ),
            None => (own, (!self.workspace.is_empty()).then(|| self.workspace.space(&pose))),
        };
        Ok(SingularPosesReport {
            lengths,
            middle: self.pose_figures(octahedral.as_ref(), pose),
            modes,
            modes_complete: solutions.all_accounted(),
            regular: regular_box(m, &pose, &options),
            options,
            safe: space.map(|space| regular_workspace(m, &space, cells, seed)),
        })
    }

    fn pose_figures(&self, octahedral: Option<&Octahedral>, pose: Pose) -> PoseFigures {
        let m = self.manipulator();
        let unit = m.size();
        PoseFigures {
            pose,
            determinant: leg_determinant(m, &pose),
            inverse_condition: inverse_condition(&jacobian(m, &pose, self.characteristic_length())),
            four_planes: octahedral.map(|o| four_planes(o, &pose).map(|d| d / unit.powi(9))),
        }
    }
}
