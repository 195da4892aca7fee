//! Which poses are singular: det J at poses, along paths of poses, and over a region of poses?

use thiserror::Error;

use crate::Design;
use fk::{Automatic, FkError, FkOptions, ForwardKinematics};
use platform::geom::{Pose, PoseSpace, Region};
use platform::manipulator::{LegLengths, Octahedral, inverse_condition, jacobian, leg_determinant};
use synthesis::singularity::{
    BoxOptions, JoinOptions, Joined, RegularBox, Regularity, SignsAlong, between, four_planes, join,
    regular_box, regular_workspace, signs_along,
};

/// Values of det J on each straight part of a path.
const STEPS: usize = 100;

/// What is asked of the poses around one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SingularPosesOptions {
    /// The pose in the middle.
    pub pose: Pose,
    /// Lengths at which all assembly modes are judged; those of the pose when absent.
    pub lengths: Option<LegLengths>,
    /// Half widths of a box of poses: positions, design units, and components of the rotation vector, degrees. Absent:
    /// the workspace of the design.
    pub half_widths: Option<[[f64; 3]; 2]>,
    /// Cells of poses that a proof may take.
    pub cells: usize,
    /// The seed.
    pub seed: u64,
}

/// Figures of one pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseFigures {
    /// The pose.
    pub pose: Pose,
    /// `det J` of the leg lines, lengths over the size.
    pub determinant: f64,
    /// Of the Jacobian with unit lines and the characteristic length of the design.
    pub inverse_condition: f64,
    /// The two conditions of four planes in one point, of octahedral designs.
    pub four_planes: Option<[f64; 2]>,
}

/// Why poses are not judged.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoSingularPoses {
    /// A leg without a length at the pose.
    #[error("the leg lengths at this pose are not finite positive numbers")]
    NoLengths,
    /// Forward kinematics failed.
    #[error("assembly modes: {0}")]
    Modes(#[from] FkError),
}

/// Singular poses around a pose.
#[derive(Debug, Clone)]
pub struct SingularPosesReport {
    /// The lengths of the modes.
    pub lengths: LegLengths,
    /// The pose in the middle.
    pub middle: PoseFigures,
    /// All real poses with the lengths.
    pub modes: Vec<PoseFigures>,
    /// False: some may be missing.
    pub modes_complete: bool,
    /// The shape of the region.
    pub options: BoxOptions,
    /// The largest region of that shape that is proved to hold no singular pose.
    pub regular: RegularBox,
    /// Whether the workspace, or the box asked about, is free of singular poses, and the cells that took.
    pub safe: Option<(Regularity, usize)>,
}

impl SingularPosesReport {
    /// Whether the region asked about is free of singular poses; `None`: undecided. Of a box of no particular size:
    /// whether some box is.
    #[must_use]
    pub fn is_regular(&self) -> Option<bool> {
        match &self.safe {
            Some((regularity, _)) => regularity.is_regular(),
            None => (self.regular.proved > 0.0).then_some(true),
        }
    }

    /// det J on straight paths from one mode over poses to another one. Modes count from 1; 0 is the pose in the
    /// middle.
    ///
    /// # Errors
    /// The number of a mode that there is not.
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

    /// All pairs of modes, and a search by random poses for paths between those of equal sign.
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
    /// `(part, u, pose, det J)`.
    pub values: Vec<(usize, f64, Pose, f64)>,
}

impl SignPath {
    /// Whether det J is proved to keep its sign (`true`), proved to change it (`false`), or neither.
    #[must_use]
    pub fn keeps_sign(&self) -> Option<bool> {
        if self.parts.iter().all(|s| s.kept().is_some()) {
            return Some(true);
        }
        self.parts.iter().any(|s| s.changes().next().is_some()).then_some(false)
    }
}

/// Straight paths of all pairs of modes, and groups of modes that paths without singular pose join.
#[derive(Debug, Clone)]
pub struct SignsBetween {
    /// The modes of a pair, from 0, with the signs between them.
    pub straight: Vec<([usize; 2], SignsAlong)>,
    /// Signs of the modes, groups, and the paths that join them.
    pub joined: Joined,
}

impl SignsBetween {
    /// Whether some path without singular pose joins two modes; `None`: none was found.
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
    /// det J at a pose and at all assembly modes, and the region around the pose that holds no singular pose.
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
                BoxOptions { region: Region::Box, translation, rotation_deg, ..own },
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
