//! Is the design singular, and does it meet its requirements?

use std::time::Instant;

use super::{Error, SingularHome, StatedRange};
use crate::Design;
use crate::equivalents::Equivalents;
use files::design::Workspace;
use fk::solve::pose_count::{
    CommonPoints, CountOptions, PoseCount, count_common_points, count_generic_poses,
};
use fk::solve::{LegDependence, dependence};
use fk::{Solvability, Theorem, pose_bound, solvability};
use machine::requirements::{
    AssessOptions, AssessStage, LeastConditioning, MarginBound, MarginProof, Requirements, RodRegularity,
    Terms, least_conditioning, least_rod_conditioning, prove_telling, regular_rods,
};
use platform::geom::{BestLine, PoseSpace, Region};
use platform::manipulator::{Body, Level, Manipulator};
use synthesis::singularity::{
    Assembly, BoxOptions, Conditioning, NearestSingular, Regularity, SingularityVerdict, assembly,
    conditioning, nearest_singular, regular_workspace, singular_distance_at_least,
};

/// Whether a design is architecturally singular, and why.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CheckReport {
    /// The design.
    pub design: Design,
    /// Whether it is singular, with the proof.
    pub verdict: SingularityVerdict,
    /// A singular design nearby; `None` for a singular design.
    pub nearest: Option<NearestSingular>,
    /// No singular design is nearer than this, design units; 0 for a singular one.
    pub at_least: f64,
    /// Whether the lengths can be assembled; for a singular design of Griffis-Duffy type with lengths.
    pub assembly: Option<Assembly>,
    /// Inverse condition number of the Jacobian at random poses.
    pub conditioning: Conditioning,
    /// Number of finite poses, real and complex, for generic leg lengths; no other lengths have more isolated poses.
    pub pose_count: PoseCount,
    /// The common points of the legs for generic lengths, by kind; `None` if the poses are not isolated or not counted.
    pub common_points: Option<CommonPoints>,
    /// The theorem with the smallest bound on the isolated finite poses, for all lengths.
    pub pose_bound: Theorem,
    /// The steps in which the poses can be computed.
    pub solvability: Solvability,
    /// The best-fitting line through the joints of each body; `None` if they are all at one point.
    pub best_lines: [Option<BestLine>; 2],
    /// The home pose that the design states, if it is singular.
    pub singular_home: Option<SingularHome>,
}

impl CheckReport {
    /// Whether the design is architecturally singular: proved, or `None` ([`SingularityVerdict`]).
    #[must_use]
    pub fn is_singular(&self) -> Option<bool> {
        self.verdict.is_singular()
    }
}

/// The verdict in a sentence.
impl std::fmt::Display for CheckReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (name, units) = (&self.design.name, &self.design.units);
        if let Some(words) = self.verdict.undecided_in_words(units) {
            return write!(f, "{name} is {words}");
        }
        let about = self.verdict.level().map_or("", Level::words);
        let singular = self.is_singular() == Some(true);
        let word = if singular { "architecturally singular" } else { "not architecturally singular" };
        write!(f, "{name} is {word}: proved {about}")?;
        match self.verdict.reason() {
            Some(reason) => write!(f, " ({reason})"),
            None if !singular && self.singular_home.is_some() => write!(f, "; its home pose is singular"),
            None => Ok(()),
        }
    }
}

/// The poses of an assessment: home, and the poses that the design states.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct AssessedPoses {
    /// Every pose of a region about home.
    pub region: bool,
    /// Single poses, without the motions between them.
    pub listed: usize,
    /// Poses of a trajectory, with the straight motions between them.
    pub trajectory: usize,
    /// Coordinates that move alone from home, each over the whole of its range.
    pub ranges: usize,
}

impl AssessedPoses {
    /// The poses of a workspace.
    #[must_use]
    pub fn of(workspace: &Workspace) -> Self {
        let trajectory = workspace.trajectory.as_ref().map_or(0, |t| t.poses.len());
        Self {
            region: workspace.has_box(),
            listed: workspace.poses.len(),
            trajectory,
            ranges: workspace.ranged_coordinates(),
        }
    }

    /// Whether the design states any poses; otherwise only home is assessed.
    #[must_use]
    pub fn are_stated(self) -> bool {
        self.are_connected() || self.listed > 0
    }

    /// Whether some motions are assessed as a whole, rather than single poses only.
    #[must_use]
    pub fn are_connected(self) -> bool {
        self.region || self.trajectory > 0 || self.ranges > 0
    }

    /// The wording of the verdict if the requirements are met at these poses, in two or three words.
    #[must_use]
    pub fn met_in_words(self) -> String {
        match self {
            _ if !self.are_stated() => "met at home only".to_owned(),
            _ if !self.are_connected() => format!("met at {}", poses(self.listed)),
            Self { region: false, trajectory: 0, listed: 0, .. } => "met along its ranges".to_owned(),
            _ => "met".to_owned(),
        }
    }

    /// A sentence without full stop, which says that none of these poses is singular.
    fn regular_in_words(self) -> String {
        if !self.are_stated() {
            return "Home is not a singular pose: proved; no workspace stated".to_owned();
        }
        if !self.are_connected() {
            return format!("No singular pose among the {} listed: proved; {BETWEEN}", poses(self.listed));
        }
        let mut places = Vec::new();
        places.extend(self.region.then_some("in the workspace"));
        places.extend((!self.region && self.trajectory > 0).then_some("on the trajectory"));
        places.extend((self.ranges > 0).then_some(ALONG));
        places.extend((!self.region && self.listed > 0).then_some("among the poses listed"));
        format!("No singular pose {}: proved{}", places.join(" and "), self.limitation())
    }

    /// The motions that the answer leaves out, at the end of a sentence.
    fn limitation(self) -> String {
        let mut left_out = Vec::new();
        left_out.extend((!self.region && self.trajectory == 0).then_some("combined motions"));
        left_out.extend((self.listed > 0).then_some("motions between the poses listed"));
        if left_out.is_empty() {
            return String::new();
        }
        format!("; {} are not assessed", left_out.join(" and "))
    }
}

/// The limitation of a list of poses.
const BETWEEN: &str = "poses between them are not assessed";
/// The poses of ranges.
const ALONG: &str = "along the ranges of single coordinates";

/// A number of poses in words.
fn poses(n: usize) -> String {
    if n == 1 { "1 pose".to_owned() } else { format!("{n} poses") }
}

/// The poses as the end of a sentence.
impl std::fmt::Display for AssessedPoses {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if !self.are_stated() {
            return f.write_str("at home; no workspace stated");
        }
        if !self.are_connected() {
            return write!(f, "at the {} listed; {BETWEEN}", poses(self.listed));
        }
        let mut whole = Vec::new();
        whole.extend(self.region.then_some("for every pose of its workspace"));
        whole.extend((!self.region && self.trajectory > 0).then_some("for every pose of its trajectory"));
        whole.extend((self.ranges > 0).then_some(ALONG));
        f.write_str(&whole.join(" and "))?;
        match (self.region, self.listed) {
            (_, 0) => {}
            (true, n) => write!(f, ", with the {} listed", poses(n))?,
            (false, n) => write!(f, ", and at the {} listed", poses(n))?,
        }
        f.write_str(&self.limitation())
    }
}

/// The margins of a design's requirements.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct AssessReport {
    /// The poses assessed.
    pub assessed_poses: AssessedPoses,
    /// The least margin of each kind of requirement, with its proof.
    pub proof: MarginProof,
    /// Whether a pose of the workspace is singular.
    pub regularity: Regularity,
    /// Number of cells examined for the regularity.
    pub regularity_cells: usize,
    /// The pose with the worst conditioning of the Jacobian among the sampled poses.
    pub conditioning: LeastConditioning,
    /// The ranges of single coordinates with their free parts.
    pub ranges: Vec<StatedRange>,
}

impl AssessReport {
    /// Whether the design meets its requirements: proved, or `None`. Without a stated workspace it is never
    /// `Some(true)`, because home alone is assessed.
    #[must_use]
    pub fn met(&self) -> Option<bool> {
        self.met_at_assessed_poses().filter(|met| !met || self.assessed_poses.are_stated())
    }

    /// The same about the assessed poses, which are home alone without a stated workspace. Searches ask this.
    #[must_use]
    pub fn met_at_assessed_poses(&self) -> Option<bool> {
        match (self.proof.all_met(), self.regularity.is_regular()) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        }
    }

    /// Whether the safety margin on every limit is kept too, which a search has to reach: proved, or `None`.
    #[must_use]
    pub fn met_with_safety_margin(&self) -> Option<bool> {
        match (self.met_at_assessed_poses(), self.proof.all_keep_safety_margin()) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        }
    }

    /// The kinds of requirements with this answer.
    fn kinds(&self, of: impl Fn(&MarginBound) -> Option<bool>, answer: Option<bool>) -> Vec<&'static str> {
        let these = self.proof.bounds.iter().filter(|b| of(b) == answer);
        these.map(|b| b.found.term.kind.label()).collect()
    }

    /// The requirements with this answer, singularity among them.
    pub(super) fn names(&self, answer: Option<bool>) -> String {
        let mut names = self.kinds(|b| b.verdict.is_met(), answer);
        names.extend((self.regularity.is_regular() == answer).then_some("no singular pose"));
        names.join("; ")
    }

    /// The result on singular poses, as a sentence without its full stop.
    #[must_use]
    pub fn regularity_in_words(&self) -> String {
        match self.regularity {
            Regularity::Regular => self.assessed_poses.regular_in_words(),
            Regularity::ChangesSign(_) => {
                "The workspace contains a singular pose: det J changes its sign on the path to it".to_owned()
            }
            Regularity::Undecided(_) => "Undecided whether a pose of the workspace is singular".to_owned(),
        }
    }
}

/// The verdict without its subject, in the words that every command and page uses.
impl std::fmt::Display for AssessReport {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let met = self.met_at_assessed_poses();
        match met {
            Some(true) => write!(f, "meets all its requirements, proved {}", self.assessed_poses)?,
            Some(false) => write!(f, "violates requirements: {}", self.names(Some(false)))?,
            None => write!(
                f,
                "violates no requirement at the sampled poses; not all is proved: {}",
                self.names(None)
            )?,
        }
        if met != Some(true) && !self.assessed_poses.are_stated() {
            f.write_str("; no workspace stated, assessed at home")?;
        }
        if self.proof.bounds.iter().any(|b| b.safety_margin.is_some()) {
            let short = |answer| self.kinds(MarginBound::keeps_safety_margin, answer).join("; ");
            match self.proof.all_keep_safety_margin() {
                Some(true) => f.write_str("; every safety margin is kept")?,
                Some(false) => write!(f, "; the safety margin is not kept: {}", short(Some(false)))?,
                None => write!(f, "; the safety margin is not proved to be kept: {}", short(None))?,
            }
        }
        write!(f, " ({} evaluated)", poses(self.proof.poses))
    }
}

/// Greatest number of cells for bounding `det J` in the search for the largest region without singular poses.
pub const BOX_CELLS: usize = 30_000;

/// Greatest number of workspace cells for [`Design::assess`]: for each kind of requirement, and for `det J`.
pub(super) const ASSESS_CELLS: usize = 6000;

/// The same number for undecided cases: a search drives margins to zero, and proofs of small margins need many cells.
pub(super) const PATIENT_CELLS: usize = 60_000;

/// Greatest number of cells of the first attempt at each drive of a table.
pub(super) const BRIEF_CELLS: usize = 300;

/// The regularity result of rods as one of legs.
fn as_regularity(of_rods: &RodRegularity) -> Regularity {
    match *of_rods {
        RodRegularity::Regular => Regularity::Regular,
        RodRegularity::ChangesSign(pose) => Regularity::ChangesSign(pose),
        RodRegularity::Undecided(pose) => Regularity::Undecided(pose),
    }
}

/// Whether a region holds a singular pose: of the rods for a design with cranks, otherwise of the legs.
pub(super) fn regular_region(
    m: &Manipulator,
    required: &Requirements,
    space: &PoseSpace,
    cells: usize,
    seed: u64,
) -> Regularity {
    match regular_rods(m, required, space, cells, seed) {
        Some((of_rods, _)) => as_regularity(&of_rods),
        None => regular_workspace(m, space, cells, seed).0,
    }
}

/// Options for proofs that end as soon as they decide.
pub(super) fn deciding(seed: u64) -> AssessOptions {
    AssessOptions::new().seed(seed).close(false)
}

impl Design {
    /// Decides whether the design is architecturally singular, so that no pose can hold the platform. The answer is
    /// exact, with an explanation and the distance to a singular design.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let midpoints = Design::load("designs/rbt-midline.toml")?;
    /// assert_eq!(midpoints.check()?.is_singular(), Some(true));
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// A decomposition that does not converge.
    pub fn check(&self) -> Result<CheckReport, Error> {
        self.check_with(1)
    }

    /// As [`check`](Self::check), with another seed of the search for a singular design nearby.
    ///
    /// # Errors
    /// A decomposition that does not converge.
    pub fn check_with(&self, seed: u64) -> Result<CheckReport, Error> {
        let m = self.manipulator();
        let verdict = SingularityVerdict::of(m)?;
        let singular = verdict.architecture.is_singular();
        let nearest = match &verdict.meant {
            None if singular == Some(true) => None,
            None => nearest_singular(m, seed)?,
            meant => meant.clone(),
        };
        let at_least = if nearest.is_some() { singular_distance_at_least(m, seed) } else { 0.0 };
        let conditioning = conditioning(m, seed)?;
        let singular_hexagon = verdict.architecture.griffis_duffy.as_ref().filter(|g| g.is_nearly_singular());
        let assembly = match (singular_hexagon, self.lengths) {
            (Some(g), Some(l)) => {
                let s = l.squared();
                match dependence(m, &s) {
                    LegDependence::Incompatible => {
                        Some(Assembly::Incompatible { defect: g.assembly_defect(&s) })
                    }
                    LegDependence::Compatible { .. } => Some(assembly(g, m, &s)?),
                    // the condition belongs to dependent legs
                    LegDependence::Nearly | LegDependence::Independent => None,
                }
            }
            _ => None,
        };
        let counting = CountOptions { seed, ..CountOptions::default() };
        let pose_count = count_generic_poses(m, &counting);
        // lengths determine the poses up to finitely many for regular designs, and only for these
        if let (Some(singular), Some(poses)) = (singular, pose_count.finite())
            && singular != (poses == 0)
        {
            return Err(Error::Contradiction { singular, poses });
        }
        let common_points = count_common_points(m, &pose_count, &counting);
        let design = self.clone();
        let pose_bound = pose_bound(m);
        Ok(CheckReport {
            design,
            verdict,
            nearest,
            at_least,
            assembly,
            conditioning,
            pose_count,
            common_points,
            pose_bound,
            solvability: solvability(m),
            best_lines: Body::BOTH.map(|body| BestLine::of(m.joints(body))),
            singular_home: self.singular_home(),
        })
    }

    /// The margins of the design's requirements over its whole workspace, with proofs. Cases undecided after 6,000
    /// cells of the workspace get 60,000.
    ///
    /// # Errors
    /// [`Error::NothingRequired`] for a design without requirements.
    pub fn assess(&self) -> Result<AssessReport, Error> {
        self.assess_by(&AssessOptions::default(), None, &mut |_| {})
    }

    /// As [`assess_with`](Self::assess_with) with this number of cells, or as [`assess`](Self::assess) without one.
    ///
    /// # Errors
    /// [`Error::NothingRequired`] for a design without requirements.
    pub fn assess_by(
        &self,
        options: &AssessOptions,
        cells: Option<usize>,
        tell: &mut dyn FnMut(AssessStage),
    ) -> Result<AssessReport, Error> {
        let length = self.characteristic_length();
        match cells {
            Some(cells) => self.assessed_by((options, cells), length, tell),
            None => self.assessed_by((&options.patient_cells(PATIENT_CELLS), ASSESS_CELLS), length, tell),
        }
    }

    /// As [`assess`](Self::assess), with other numbers of poses and cells.
    ///
    /// # Errors
    /// [`Error::NothingRequired`] for a design without requirements.
    pub fn assess_with(&self, options: &AssessOptions, cells: usize) -> Result<AssessReport, Error> {
        self.assessed_by((options, cells), self.characteristic_length(), &mut |_| {})
    }

    /// The assessment, with this characteristic length for the conditioning.
    fn assessed_by(
        &self,
        (options, cells): (&AssessOptions, usize),
        length: f64,
        tell: &mut dyn FnMut(AssessStage),
    ) -> Result<AssessReport, Error> {
        let (m, space) = (self.manipulator(), self.workspace.space(&self.home_or_default()));
        let required = self.requirements();
        let proof = prove_telling(m, &required, &space, (options, cells), tell);
        if proof.bounds.is_empty() {
            return Err(Error::NothingRequired);
        }
        tell(AssessStage::SingularPoses);
        let patient = cells.max(options.patient_cells);
        let (regularity, regularity_cells) = if options.is_late() {
            (Regularity::Undecided(space.home), 0)
        } else if let Some((of_rods, cells)) = regular_rods(m, &required, &space, patient, options.seed) {
            (as_regularity(&of_rods), cells)
        } else {
            regular_workspace(m, &space, cells, options.seed)
        };
        tell(AssessStage::Conditioning);
        let conditioning = self.least_conditioning(options, length);
        Ok(AssessReport {
            assessed_poses: self.assessed_poses(),
            proof,
            regularity,
            regularity_cells,
            conditioning,
            ranges: self.stated_ranges(),
        })
    }

    /// The poses at which the design is assessed.
    pub fn assessed_poses(&self) -> AssessedPoses {
        AssessedPoses::of(&self.workspace)
    }

    /// The worst conditioning over these poses, of the rods for a design with cranks.
    pub(super) fn least_conditioning(&self, options: &AssessOptions, length: f64) -> LeastConditioning {
        let (m, required) = (self.manipulator(), self.requirements());
        let space = self.workspace.space(&self.home_or_default());
        let terms = Terms::new(m, &required, &space.home);
        least_rod_conditioning(&terms, &space, options, length)
            .unwrap_or_else(|| least_conditioning(m, &space, options, length))
    }

    /// The decision of [`assess`](Self::assess) with this seed, at the beginning of every answer about a design; `None`
    /// without requirements.
    ///
    /// Proofs end as soon as they decide, so the proved margins may be smaller than in `assess`.
    pub fn assessed(&self, seed: u64) -> Option<AssessReport> {
        self.assessed_until(seed, None)
    }

    /// The same; samples and proofs end at the given time with the result so far.
    pub fn assessed_until(&self, seed: u64, until: Option<Instant>) -> Option<AssessReport> {
        self.decided_by(&deciding(seed).until(until), self.characteristic_length())
    }

    fn decided_by(&self, options: &AssessOptions, length: f64) -> Option<AssessReport> {
        self.assessed_by((&options.patient_cells(PATIENT_CELLS), ASSESS_CELLS), length, &mut |_| {}).ok()
    }

    /// The same with a conditioning by a given length, common to all designs of a comparison. The conditioning exists
    /// even without requirements.
    pub fn assessed_beside(
        &self,
        seed: u64,
        length: f64,
        until: Option<Instant>,
    ) -> (Option<AssessReport>, LeastConditioning) {
        let options = deciding(seed).until(until);
        let found = self.decided_by(&options, length);
        let conditioning = found.as_ref().map(|f| f.conditioning);
        (found, conditioning.unwrap_or_else(|| self.least_conditioning(&options, length)))
    }

    /// Options for the largest region without singular poses. Its shape is the region of the workspace, or a box of
    /// half the size and 30 degrees in each direction. Intervals with home off their middle are extended to both sides.
    pub fn box_options(&self, regions: usize, seed: u64) -> BoxOptions {
        let w = &self.workspace;
        let (region, translation, rotation_deg, pivot) = if w.has_box() {
            let own = w.space(&self.home_or_default()).scaled_region(1.0);
            let (translation, rotation_deg) = own.reach();
            (w.region, translation.into(), rotation_deg.into(), own.pivot.into())
        } else {
            (Region::Box, [0.5 * self.manipulator().size(); 3], [30.0; 3], [0.0; 3])
        };
        BoxOptions { region, translation, rotation_deg, pivot, regions, enough: 0.9, seed }
    }

    /// All platforms equivalent to this one: the class of the octahedral platform that the design is, or is made from.
    ///
    /// ```
    /// use equipod::prelude::*;
    /// # std::env::set_current_dir("../../..").unwrap(); // the designs are at the top
    /// let design = Design::load("designs/rbt-octahedral.toml")?;
    /// let (free, map) = design.equivalents()?.joint_free([0.25, 0.5, 0.25, 0.5, 0.25, 0.75])?;
    /// assert_eq!((free.base_names().len(), free.platform_names().len()), (6, 6));
    /// assert!(map.determinant().abs() > 0.0);
    /// # Ok::<(), Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::NotOctahedral`] for a design that is neither octahedral nor made from an octahedral one by offsets
    /// along the sides of its triangles.
    pub fn equivalents(&self) -> Result<Equivalents, Error> {
        Ok(Equivalents::of(self)?)
    }
}
