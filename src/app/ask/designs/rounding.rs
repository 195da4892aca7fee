//! A design on grids of holes.

#[cfg(feature = "optimize")]
use std::ops::ControlFlow;

use nalgebra::Point3;

#[cfg(feature = "optimize")]
use super::AssessReport;
#[cfg(feature = "optimize")]
use super::Error;
#[cfg(feature = "optimize")]
use super::optimizing::{EXTENSION, checked, dimensional_problem, met_or_nothing_required};
use crate::Design;
use files::design::DesignModel;
use machine::manufacture::{NoRounding, Rounding, RoundingProblem, round_to_grid};
use machine::requirements::{Grid, HolePattern};
#[cfg(feature = "optimize")]
use machine::requirements::{Requirements, SafetyMargin, VariableKind};
#[cfg(feature = "optimize")]
use optimize::dimensional::{self, DimensionalProblem, Progress, ShapeSearchOptions};
use platform::manipulator::{Body, Manipulator};

/// Default share of the inverse condition number that an exact rounding must keep to be chosen.
pub const KEEP: f64 = 0.9;
/// Number of triangles of each body that are combined in the first search.
pub const CANDIDATES: u32 = 40;
/// Number of random poses for the error of the nearest rounding.
pub const TRIALS: u32 = 500;

/// The grids, and the effort of the search.
#[derive(Debug, Clone, Copy)]
#[non_exhaustive]
pub struct RoundingChoices {
    /// The grids of base and platform; `None` if the joints of the plate stay in place.
    pub grids: [Option<Grid>; 2],
    /// Whether origins and angles of the grids are optimised too.
    pub free: bool,
    /// See [`RoundingProblem::keep`].
    pub keep: f64,
    /// See [`RoundingProblem::candidates`].
    pub candidates: usize,
    /// See [`RoundingProblem::tool`].
    pub tool: Point3<f64>,
    /// See [`RoundingProblem::trials`].
    pub trials: usize,
    /// Seed.
    pub seed: u64,
}

impl RoundingChoices {
    /// The usual choices for these grids.
    pub fn on(grids: &[Option<Grid>; 2], seed: u64) -> Self {
        let tool = Point3::origin();
        let (candidates, trials) = (CANDIDATES as usize, TRIALS as usize);
        Self { grids: *grids, free: false, keep: KEEP, candidates, tool, trials, seed }
    }

    num::setters! {
        /// Whether origins and angles of the grids are optimised too.
        fn free(free: bool) = free;
        /// See [`RoundingProblem::keep`].
        fn keep(keep: f64) = keep;
        /// See [`RoundingProblem::candidates`].
        fn candidates(candidates: usize) = candidates;
        /// See [`RoundingProblem::tool`].
        fn tool(tool: Point3<f64>) = tool;
        /// See [`RoundingProblem::trials`].
        fn trials(trials: usize) = trials;
    }
}

num::words! {
    /// The kind of rounding.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
    #[serde(rename_all = "snake_case")]
    #[schemars(rename = "VariantWord")]
    pub enum RoundingWay as name {
        /// All joints exactly on the sides of two triangles.
        Exact = "exact",
        /// All joints on holes near their given positions.
        Nearest = "nearest",
    }
}

impl Design {
    /// Both roundings of the design, evaluated at the poses of its workspace grid.
    ///
    /// # Errors
    /// [`NoRounding`].
    pub fn rounded(&self, choices: &RoundingChoices) -> Result<Rounding, NoRounding> {
        let (home, workspace) = (self.home_or_default(), self.workspace_or_default());
        let (space, poses) = (workspace.space(&home), workspace.sample(&home));
        let required = self.requirements();
        let fixed = Body::BOTH.map(|body| self.fixed_joints(body));
        let m = self.manipulator();
        round_to_grid(&RoundingProblem {
            manipulator: m,
            grids: choices.grids,
            free: choices.free,
            fixed: fixed.each_ref().map(Vec::as_slice),
            requirements: &required,
            space: &space,
            poses: &poses,
            characteristic_length: self.characteristic_length(),
            min_abs_det: self.optimize.min_abs_det,
            tool: choices.tool,
            candidates: choices.candidates,
            keep: choices.keep,
            trials: choices.trials,
            seed: choices.seed,
        })
    }

    /// This design with its joints on the holes of grids, as placed by a rounding.
    pub fn on_holes(&self, way: RoundingWay, m: &Manipulator, grids: &[Option<Grid>; 2]) -> Self {
        let plain = DesignModel::new(format!("{}, rounded", self.name), self.units.clone(), m.clone());
        let (base, platform) = (self.base_names().to_vec(), self.platform_names().to_vec());
        let mut out = plain.clone().with_joint_names(base, platform).unwrap_or(plain);
        out.description = Some(format!(
            "Joints of the design \"{}\" on grids by equipod {}, variant {}; base: {}; platform: {}",
            self.name,
            env!("CARGO_PKG_VERSION"),
            way.name(),
            grid_in_words(grids[0].as_ref()),
            grid_in_words(grids[1].as_ref())
        ));
        let decimals = [0, 1].map(|body| decimals(grids[body].as_ref()?, m.joints(Body::BOTH[body])));
        out.with_tables_of(self).at_decimals(decimals.each_ref().map(Option::as_deref)).into()
    }
}

/// A grid in words, or the statement that the joints of the plate stay in place.
pub fn grid_in_words(grid: Option<&Grid>) -> String {
    grid.map_or_else(|| "no grid, its joints stay".into(), Grid::to_string)
}

/// The joints of a body as the exact decimals of the grid's holes; doubles only approximate them. For example, the
/// third hole of pitch 0.1 is at 0.3.
///
/// `None` if the doubles are exact (whole pitches), or if the coordinates are no short decimals. The latter holds for a
/// long pitch, and for grid axes that differ from the body axes.
fn decimals(grid: &Grid, joints: &[Point3<f64>]) -> Option<Vec<[String; 3]>> {
    // without an exponent, with the fewest digits
    let places = |x: f64| x.to_string().split_once('.').map_or(0, |(_, digits)| digits.len());
    let digits = grid.origin.into_iter().chain([grid.pitch]).map(places).max().unwrap_or(0);
    let height = joints.first()?.z;
    let level = joints.iter().all(|p| p.z.total_cmp(&height).is_eq());
    let plain = grid.angle_deg == 0.0 && grid.pattern == HolePattern::Square;
    // below this bound every decimal with this number of places has its own double, with some space for rounding errors
    let largest = 10f64.powi(14 - i32::try_from(digits).ok()?);
    let apart = joints.iter().all(|p| p.x.abs().max(p.y.abs()) < largest);
    let shown =
        |p: &Point3<f64>| [format!("{:.digits$}", p.x), format!("{:.digits$}", p.y), height.to_string()];
    (digits > 0 && level && plain && apart).then(|| joints.iter().map(shown).collect())
}

/// The search that found the platform; it is repeated if rounding violates a limit.
#[cfg(feature = "optimize")]
#[derive(Debug, Clone, Copy)]
pub struct FirstSearch<'a> {
    /// The design at its start.
    pub design: &'a Design,
    /// Its problem.
    pub problem: &'a DimensionalProblem,
    /// Its result, in its variables.
    pub point: &'a [f64],
}

/// A platform on the holes that its design states.
#[cfg(feature = "optimize")]
#[derive(Debug, Clone)]
pub struct DesignOnHoles {
    /// The platform that was rounded.
    pub given: Design,
    /// The grids and the effort of the search.
    pub choices: RoundingChoices,
    /// Both roundings of it.
    pub rounding: Rounding,
    /// The platform on the holes, with the kind of rounding; `None` if there is none.
    pub found: Option<(RoundingWay, Design)>,
    /// The result of [`Design::assess`] for this platform; `None` without a platform or requirements.
    pub assessed: Option<AssessReport>,
    /// The variables optimised again after rounding.
    pub refitted: Vec<VariableKind>,
    /// Number of passes of search and rounding; 1 if the first was good.
    pub passes: usize,
}

/// Greatest number of passes of search and rounding.
#[cfg(feature = "optimize")]
const PASSES: usize = 3;
/// The factor from a violation to the growth of the safety margin.
#[cfg(feature = "optimize")]
const GROWTH: f64 = 1.25;

/// The rank of a result: requirements met, then safety margins kept; proved 2, undecided 1, refuted 0.
#[cfg(feature = "optimize")]
fn rank(assessed: Option<&AssessReport>) -> [u8; 2] {
    let known = |x: Option<bool>| x.map_or(1, |x| if x { 2 } else { 0 });
    [
        known(assessed.map_or(Some(true), AssessReport::met_at_assessed_poses)),
        known(met_or_nothing_required(assessed)),
    ]
}

#[cfg(feature = "optimize")]
impl DesignOnHoles {
    fn rank(&self) -> [u8; 2] {
        if self.found.is_some() { rank(self.assessed.as_ref()) } else { [0, 0] }
    }

    /// Whether the platform on the holes is proved to meet its requirements; `None`: undecided; `Some(true)` without
    /// requirements.
    pub fn met(&self) -> Option<bool> {
        self.assessed.as_ref().map_or(Some(true), AssessReport::met_at_assessed_poses)
    }
}

/// Puts the joints of a platform on the holes that its design states. After rounding, it optimises the free variables
/// again (height of home, joint axes) if a safety margin is violated. If a limit is violated, it starts again with
/// larger safety margins. The answer is the best result.
///
/// # Errors
/// [`Error`] of an invalid search; [`NoRounding`] inside if the grids are unusable.
#[cfg(feature = "optimize")]
pub fn on_stated_holes(
    given: &Design,
    grids: &[Option<Grid>; 2],
    first: Option<FirstSearch<'_>>,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Result<DesignOnHoles, NoRounding>, Error> {
    let mut best = match round_once(given, grids, options, progress)? {
        Ok(found) => found,
        Err(why) => return Ok(Err(why)),
    };
    let Some(first) = first else { return Ok(Ok(best)) };
    let mut problem = first.problem.clone();
    let mut missed = best.assessed.clone();
    for pass in 2..=PASSES {
        if best.rank()[0] > 0 {
            break;
        }
        let Some(report) = &missed else { break };
        widen(&mut problem.requirements, report);
        let brief = ShapeSearchOptions { populations: 3, generations: 6, starts: 4, polished: 2, ..*options };
        let found = dimensional::optimize(&problem, &[first.point.to_vec()], &brief, progress)?;
        let Some(s) = found.solution().filter(|_| !found.interrupted) else { break };
        let again = checked(first.design, &problem, s, options.into())?.design;
        let Ok(next) = round_once(&again, grids, options, progress)? else { break };
        missed.clone_from(&next.assessed);
        if next.rank() > best.rank() {
            best = DesignOnHoles { passes: pass, ..next };
        } else {
            best.passes = pass;
        }
    }
    Ok(Ok(best))
}

/// Enlarges the safety margins by the violations found.
#[cfg(feature = "optimize")]
fn widen(required: &mut Requirements, missed: &AssessReport) {
    for bound in &missed.proof.bounds {
        let kind = bound.found.term.kind;
        let short = -bound.found.value;
        if short > 0.0 && short.is_finite() {
            let safety_margin = required.safety_margin(kind) + GROWTH * short;
            required.safety_margins.kinds.insert(kind, SafetyMargin::Amount(safety_margin));
        }
    }
}

/// Rounds once, and optimises the free variables again if a limit or safety margin is violated.
#[cfg(feature = "optimize")]
fn round_once(
    given: &Design,
    grids: &[Option<Grid>; 2],
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Result<DesignOnHoles, NoRounding>, Error> {
    let choices = RoundingChoices::on(grids, options.seed);
    let rounding = match given.rounded(&choices) {
        Ok(rounding) => rounding,
        Err(why) => return Ok(Err(why)),
    };
    let exact = rounding.exact.as_ref().ok().map(|e| (RoundingWay::Exact, &e.manipulator));
    let nearest = rounding.nearest.as_ref().ok().map(|n| (RoundingWay::Nearest, &n.manipulator));
    let mut best: Option<(RoundingWay, Fitted)> = None;
    // joints stay on their lines if this meets the requirements
    for (way, m) in [exact, nearest].into_iter().flatten() {
        let fitted = fit(given.on_holes(way, m, grids), options, progress)?;
        if best.as_ref().is_none_or(|(_, old)| rank(fitted.1.as_ref()) > rank(old.1.as_ref())) {
            best = Some((way, fitted));
        }
        if best.as_ref().is_some_and(|(_, found)| rank(found.1.as_ref())[0] == 2) {
            break;
        }
    }
    let (found, assessed, refitted) = match best {
        Some((way, (design, assessed, refitted))) => (Some((way, design)), assessed, refitted),
        None => (None, None, Vec::new()),
    };
    let given = given.clone();
    Ok(Ok(DesignOnHoles { given, choices, rounding, found, assessed, refitted, passes: 1 }))
}

/// A design, its assessment, and the variables optimised again.
#[cfg(feature = "optimize")]
type Fitted = (Design, Option<AssessReport>, Vec<VariableKind>);

/// The design with the free variables optimised again, if it violates a limit or a safety margin; unchanged if that
/// brings no gain.
#[cfg(feature = "optimize")]
fn fit(
    design: Design,
    options: &ShapeSearchOptions,
    progress: &mut dyn FnMut(Progress) -> ControlFlow<()>,
) -> Result<Fitted, Error> {
    let assessed = design.assessed_until(options.seed, options.until);
    let beside = |kind: &VariableKind| matches!(kind, VariableKind::HomeHeight | VariableKind::JointAxes);
    let free: Vec<VariableKind> = design.search.variables.iter().copied().filter(beside).collect();
    if free.is_empty() || rank(assessed.as_ref()) == [2, 2] || options.is_late() {
        return Ok((design, assessed, Vec::new()));
    }
    let mut asked = design.clone();
    (asked.search.variables, asked.search.symmetry) = (free.clone(), None);
    let problem = dimensional_problem(&asked, EXTENSION);
    let brief = ShapeSearchOptions { populations: 2, generations: 6, starts: 3, polished: 2, ..*options };
    let report = dimensional::optimize(&problem, &[], &brief, progress)?;
    let Some(s) = report.solution().or(report.nearest.as_deref()) else {
        return Ok((design, assessed, Vec::new()));
    };
    let found = checked(&asked, &problem, s, options.into())?.design;
    let mut again = design.clone();
    (again.home, again.hardware) = (found.home, found.hardware);
    let reassessed = again.assessed_until(options.seed, options.until);
    if rank(reassessed.as_ref()) > rank(assessed.as_ref()) {
        return Ok((again, reassessed, free));
    }
    Ok((design, assessed, Vec::new()))
}
