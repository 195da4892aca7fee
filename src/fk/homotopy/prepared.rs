//! The homotopy prepared for one design: its poses at generic lengths, once, and from there paths in the lengths alone.
//!
//! Generic lengths have as many poses, `N`, as isolated poses can be at any. So `N` certified distinct poses at the
//! lengths asked for are all poses, and no curve of poses exists besides them. Near a curve there would be isolated
//! poses of generic lengths, which would then have more than `N` (docs/theory/completeness.md).

use num_complex::Complex64;

use super::{SectionProblem, assemble, ends_of};
use crate::bounded::{KnownSurroundings, Surroundings};
use crate::counted::{CountVerdict, compare};
use crate::evidence::{Bounds, attach};
use crate::harvest::harvest;
use crate::solve::homotopy::{LengthStart, StartKind, projective_distance, unit};
use crate::solve::pose_count::{CountOptions, PoseCount, count_generic_poses};
use crate::solve::{ScaledFrames, mirror};
use crate::{
    Completeness, FkError, FkOptions, FkSolutions, ForwardKinematics, Homotopy, PoseCounting, PreparedDesign,
    SolutionSet, Theorem,
};
use num::Purpose;
use platform::manipulator::{Manipulator, SquaredLegLengths, default_home};

/// Two start poses closer than this are not told apart.
const SAME_POSE: f64 = 1e-6;

/// [`Homotopy`] for one design.
#[derive(Debug)]
pub(super) struct PreparedHomotopy {
    manipulator: Manipulator,
    pub(super) start: LengthStart,
    /// The bound that the start poses reach, which does not depend on the lengths; that of any six legs where they
    /// reach none.
    theorem: Theorem,
    /// The number of start poses by the count, where no theorem proves it.
    count: Option<PoseCount>,
    /// The knowledge for the proof up to a distance, when the start poses are proved so.
    known: Option<KnownSurroundings>,
}

impl PreparedHomotopy {
    /// `None` unless the start poses are known to be all, or all up to a distance: as many certified ones as a theorem
    /// allows, or as the count says.
    pub(super) fn new(m: &Manipulator, o: &FkOptions) -> Option<Self> {
        let (from, to) = generic_lengths(m, o.seed)?;
        let quick = o.pose_count(PoseCounting::Never);
        let found = Homotopy.solve(m, &from, &quick).ok()?;
        if found.roots.is_empty() || found.solution_set != SolutionSet::Isolated {
            return None;
        }
        let mut starts: Vec<usize> = (0..found.roots.len()).collect();
        let (theorem, count, known) = match found.completeness {
            Completeness::Proved { theorem } => (theorem, None, None),
            Completeness::ProvedBounded { .. } => {
                let known;
                (starts, known) = Surroundings::of_proved(m, o.seed, &found, &from).ok()??;
                (Theorem::SixLegs, None, Some(known))
            }
            _ if o.pose_count == PoseCounting::Never => return None,
            _ => {
                let options = CountOptions { seed: o.seed, ..CountOptions::default() };
                let generic = count_generic_poses(m, &options);
                if compare(&mut found.clone(), &generic).ok()? != CountVerdict::Complete {
                    return None;
                }
                (Theorem::SixLegs, Some(generic), None)
            }
        };
        let poses: Option<Vec<[Complex64; 8]>> =
            starts.iter().map(|k| found.roots[*k].dual_quaternion).collect();
        let poses = poses?;
        let flat = ScaledFrames::planar(m, &from).and_then(|frame| {
            let points = poses.iter().map(|x| unit(&frame.to_frame(*x))).collect();
            Some((StartKind::Planar, frame, one_of_each_pair(points)?))
        });
        let (kind, frame, points) = flat.unwrap_or_else(|| {
            let frame = ScaledFrames::of(m, &from);
            (StartKind::Generic, frame, poses.iter().map(|x| unit(&frame.to_frame(*x))).collect())
        });
        let start = LengthStart::new(kind, &frame, m, &from, &points, to)?;
        Some(Self { manipulator: m.clone(), start, theorem, count, known })
    }

    /// The answer where it is whole, `None` where anything is left over.
    pub(super) fn whole(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<Option<FkSolutions>, FkError> {
        let (m, kind) = (&self.manipulator, self.start.kind());
        let frame = match kind {
            StartKind::Generic => Some(ScaledFrames::of(m, s)),
            StartKind::Planar => ScaledFrames::planar(m, s),
        };
        let followed = frame.and_then(|frame| Some((frame, self.start.follow(&frame, m, s)?)));
        let Some((frame, (sections, paths))) = followed else { return Ok(None) };
        let problem = SectionProblem { frame, sections, kind, fine: false };
        let found = harvest(m, s, &o.tolerances, &ends_of(&problem, &paths), &[]);
        let (mut found, certificates) = assemble(o, &problem, &paths, self.start.paths(), found);
        attach(&mut found, m, s, Bounds::Only(self.theorem), certificates)?;
        if found.completeness.is_proved() {
            return Ok(Some(found));
        }
        if let Some(known) = &self.known
            && known.conclude(&mut found, m, s)?
        {
            return Ok(Some(found));
        }
        // a root without a certificate may be a sign of a motion: the general treatment examines it
        let open = found.roots.iter().any(|r| !r.certified());
        let Some(count) = self.count.as_ref().filter(|_| !open) else { return Ok(None) };
        let complete = compare(&mut found, count)? == CountVerdict::Complete;
        Ok(complete.then_some(found))
    }
}

impl PreparedDesign for PreparedHomotopy {
    fn solve(&self, s: &SquaredLegLengths, o: &FkOptions) -> Result<FkSolutions, FkError> {
        match self.whole(s, o)? {
            Some(found) => Ok(found),
            None => Homotopy.solve(&self.manipulator, s, o),
        }
    }
}

/// Real squared lengths about those of the home pose, and complex ones next to them.
fn generic_lengths(m: &Manipulator, seed: u64) -> Option<(SquaredLegLengths, [Complex64; 6])> {
    let mut rng = Purpose::START_LENGTHS.rng(seed);
    let home = default_home(m).squared_lengths(m)?.get();
    let real = home.map(|s| s * rng.uniform(0.8, 1.25));
    let mean = real.iter().sum::<f64>() / 6.0;
    let complex = real.map(|s| Complex64::new(s, mean * rng.uniform(-1.0, 1.0)));
    Some((SquaredLegLengths::try_new(real).ok()?, complex))
}

/// One of each two unit points that are mirror images; `None` when they are not pairs.
fn one_of_each_pair(points: Vec<[Complex64; 8]>) -> Option<Vec<[Complex64; 8]>> {
    let mut open = points;
    let mut out = Vec::with_capacity(open.len() / 2);
    while let Some(x) = open.pop() {
        let image = mirror(x);
        let partner = open.iter().position(|y| projective_distance(y, &image) < SAME_POSE)?;
        open.swap_remove(partner);
        out.push(x);
    }
    Some(out)
}
