//! The requirement that limits the workspace at a pose.

use super::Requirements;
use super::term::{Term, Terms};
use platform::geom::Pose;
use platform::manipulator::Manipulator;

/// A limit of the workspace.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Limit {
    /// A requirement that depends on the pose.
    Term(Term),
    /// `det J` vanishes here or between home and here: the lines of the legs are linearly dependent.
    Singular,
}

/// The requirement with the least margin at a pose.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoseLimit {
    /// Its margin as a share: over the size of the manipulator (lengths), 90 degrees (angles), its limit (forces,
    /// speeds, stiffness, frequency), `det J` at home (singularity). Negative if violated; infinite without a
    /// requirement.
    pub share: f64,
    /// The requirement; `None` without any.
    pub limit: Option<Limit>,
}

/// Requirements and singularity as limits of the workspace around a home pose.
///
/// A pose lies in the workspace if all requirements are met and `det J` has the same sign as at home. Every path
/// between different signs contains a singular pose. The same sign proves nothing: a path may still have to pass
/// singular poses. If home itself is singular, singularity is ignored.
#[derive(Debug)]
pub struct Limits<'a> {
    required: &'a Requirements,
    terms: Terms<'a>,
    size: f64,
    /// `det J` at home; `None` where it vanishes.
    at_home: Option<f64>,
}

/// `|det J|` with lengths over the size below which home counts as singular.
const SINGULAR: f64 = 1e-12;

impl<'a> Limits<'a> {
    /// Prepares the requirements.
    #[must_use]
    pub fn new(manipulator: &'a Manipulator, required: &'a Requirements, home: &Pose) -> Self {
        let terms = Terms::new(manipulator, required, home);
        let size = manipulator.size();
        let at_home = terms.determinant(home).filter(|det| det.abs() > SINGULAR);
        Self { required, terms, size, at_home }
    }

    /// Whether `det J` limits the workspace; not when it vanishes at home.
    #[must_use]
    pub fn checks_singularity(&self) -> bool {
        self.at_home.is_some()
    }

    fn share(&self, (term, margin): &(Term, f64)) -> f64 {
        margin / self.required.scale_of(term.kind, self.size)
    }

    /// The requirement with the least margin at a pose. A singularity counts as the worst only if all others are met.
    #[must_use]
    pub fn at(&self, pose: &Pose) -> PoseLimit {
        let terms = self.terms.at(pose);
        let shares = terms.iter().map(|t| PoseLimit { share: self.share(t), limit: Some(Limit::Term(t.0)) });
        let none = PoseLimit { share: f64::INFINITY, limit: None };
        let worst = shares.fold(none, |worst, t| if t.share < worst.share { t } else { worst });
        // a rod that does not close violates its requirement
        let ratio = self.at_home.and_then(|home| Some(self.terms.determinant(pose)? / home));
        let ratio = ratio.unwrap_or(f64::INFINITY);
        if worst.share > 0.0 && ratio < worst.share {
            PoseLimit { share: ratio, limit: Some(Limit::Singular) }
        } else {
            worst
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fixtures::symmetric_hexapod;
    use crate::requirements::{Hardware, LengthLimits};
    use nalgebra::{Rotation3, Vector3};
    use platform::manipulator::default_home;

    fn lifted(home: &Pose, z: f64) -> Pose {
        Pose { position: home.position + Vector3::z() * z, ..*home }
    }

    #[test]
    fn the_worst_requirement_is_named_with_its_share() {
        let m = symmetric_hexapod(2.0, 1.0);
        let home = default_home(&m);
        let length = home.lengths(&m).unwrap().get()[0];
        let limits = LengthLimits::Range(0.8 * length, 1.2 * length);
        let hardware = Hardware { leg_length: Some(limits), ..Hardware::default() };
        let required = Requirements { hardware, ..Requirements::default() };
        let limits = Limits::new(&m, &required, &home);
        let here = limits.at(&home);
        assert!((here.share - 0.2 * length / m.size()).abs() < 1e-9);
        let kind = |z: f64| match limits.at(&lifted(&home, z)) {
            PoseLimit { share, limit: Some(Limit::Term(t)) } if share < 0.0 => Some(t.kind.code()),
            _ => None,
        };
        assert_eq!(kind(length), Some("max_leg_length"));
        assert_eq!(kind(-0.9 * length), Some("min_leg_length"));
        assert_eq!(kind(0.0), None);
    }

    #[test]
    fn a_pose_beyond_a_singularity_is_out_of_the_workspace() {
        let m = symmetric_hexapod(2.0, 1.0);
        let home = default_home(&m);
        let nothing = Requirements::default();
        let limits = Limits::new(&m, &nothing, &home);
        assert!(limits.checks_singularity());
        assert!((limits.at(&home).share - 1.0).abs() < 1e-12);
        // det J changes its sign after a quarter turn about the axis of symmetry
        let turned = |deg: f64| Pose {
            rotation: Rotation3::from_axis_angle(&Vector3::z_axis(), deg.to_radians()) * home.rotation,
            ..home
        };
        assert!(limits.at(&turned(60.0)).share > 0.0);
        let beyond = limits.at(&turned(120.0));
        assert!(beyond.share < 0.0 && beyond.limit == Some(Limit::Singular));
        let singular = Limits::new(&m, &nothing, &turned(90.0));
        assert!(!singular.checks_singularity() && singular.at(&home).limit.is_none());
    }
}
