//! The freedoms that resolve a conflict: repeats the search with one more freedom each.

use std::ops::ControlFlow;

use super::assessed::{Checked, checked};
use super::platform_search::keeps_symmetry_of_start;
use super::problem::dimensional_problem;
use crate::Design;
use machine::requirements::{Envelope, LengthLimits, PlateDesign, TermKind, VariableKind};
use optimize::dimensional::{
    ConstraintConflict, Demand, DimensionalOutcome, DimensionalProblem, DimensionalReport,
    DimensionalSolution, Give, Progress, ShapeSearchOptions, Triangles, meet, optimize,
};
use optimize::offsets::DEFAULT_MIN_ABS_DET;
use platform::manipulator::Octahedral;
use verify::VerifyError;

num::words! {
    /// A freedom that a design does not allow.
    #[derive(
        Debug,
        Clone,
        Copy,
        PartialEq,
        Eq,
        PartialOrd,
        Ord,
        serde::Serialize,
        serde::Deserialize,
        schemars::JsonSchema,
    )]
    #[serde(rename_all = "snake_case")]
    #[schemars(rename = "Freedom")]
    pub enum ConflictFreedom as name {
        /// The height of home is chosen.
        HomeHeight = "home_height",
        /// The sizes of the triangles, or of base and platform, are chosen.
        TriangleSizes = "triangle_sizes",
        /// Shapes and sizes of the triangles are chosen.
        Triangles = "triangles",
        /// The legs have a longer stroke.
        Stroke = "stroke",
        /// The base envelope is wider on every side.
        BaseEnvelope = "base_envelope",
        /// The platform envelope is wider on every side.
        PlatformEnvelope = "platform_envelope",
        /// The machine envelope is wider on every side.
        MachineEnvelope = "machine_envelope",
        /// The base plate is wider on every side: its outline has a greater margin around the joints.
        BaseMargin = "base_margin",
        /// The platform plate is wider on every side.
        PlatformMargin = "platform_margin",
        /// The default limit of the least `|det A|`, which the design does not state, is dropped.
        MinAbsDet = "min_abs_det",
    }
}

impl ConflictFreedom {
    /// The variables that it adds; `None` for a limit that is relaxed.
    fn variable(self) -> Option<VariableKind> {
        match self {
            Self::HomeHeight => Some(VariableKind::HomeHeight),
            Self::TriangleSizes => Some(VariableKind::TriangleSizes),
            Self::Triangles => Some(VariableKind::Triangles),
            _ => None,
        }
    }

    /// The requirements that it eases.
    fn kinds(self) -> &'static [TermKind] {
        match self {
            Self::Stroke => &[TermKind::MinLegLength, TermKind::MaxLegLength],
            Self::BaseEnvelope => &[TermKind::BaseEnvelope],
            Self::PlatformEnvelope => &[TermKind::PlatformEnvelope],
            Self::MachineEnvelope => &[TermKind::MachineEnvelope],
            Self::BaseMargin => &[TermKind::BaseHoleEdge],
            Self::PlatformMargin => &[TermKind::PlatformHoleEdge],
            _ => &[],
        }
    }
}

/// The outcome of a search with one more freedom.
#[derive(Debug, Clone, PartialEq)]
pub enum FreedomOutcome {
    /// A platform is proved by [`Design::assess`] to meet all requirements with their safety margins.
    Resolved(Box<Checked>),
    /// A platform meets the requirements at the sampled poses; some are unproved.
    Undecided(Box<Checked>),
    /// No start met the requirements.
    Unresolved,
    /// The search was interrupted before.
    NotTried,
}

impl FreedomOutcome {
    /// The code of the outcome.
    #[must_use]
    pub fn word(&self) -> FreedomWord {
        match self {
            Self::Resolved(_) => FreedomWord::Resolved,
            Self::Undecided(_) => FreedomWord::Undecided,
            Self::Unresolved => FreedomWord::Unresolved,
            Self::NotTried => FreedomWord::NotTried,
        }
    }

    /// The platform found, with its check.
    #[must_use]
    pub fn found(&self) -> Option<&Checked> {
        match self {
            Self::Resolved(c) | Self::Undecided(c) => Some(c),
            Self::Unresolved | Self::NotTried => None,
        }
    }
}

/// The code for the outcome of a search with one more freedom.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FreedomWord {
    /// A platform is proved to meet all requirements.
    Resolved,
    /// A platform meets the requirements at the sampled poses; some are unproved.
    Undecided,
    /// No start met the requirements.
    Unresolved,
    /// The search was interrupted before.
    NotTried,
}

/// A freedom with its search result.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct OpenedFreedom {
    /// The freedom.
    pub freedom: ConflictFreedom,
    /// The amount by which a limit was relaxed in the last search, design units. For a variable, the difference in
    /// height of the platform found, design units. `None` if there is no such number.
    pub amount: Option<f64>,
    /// The outcome of the search.
    pub outcome: FreedomOutcome,
    /// The demands of the conflict that need less relaxation with this freedom, with both amounts.
    pub eased: Vec<RelaxedRequirement>,
}

impl OpenedFreedom {
    /// The platform found with it.
    #[must_use]
    pub fn design(&self) -> Option<&Design> {
        self.outcome.found().map(|c| &c.design)
    }
}

/// A demand of a conflict that needs less relaxation without a default limit of the search.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelaxedRequirement {
    /// The demand.
    pub demand: Demand,
    /// The amount of relaxation with the default limit.
    pub from: f64,
    /// The amount of relaxation without it.
    pub to: f64,
}

/// Factors on the amount that the conflict names, tried in order.
const ATTEMPTS: [f64; 4] = [1.1, 1.3, 2.0, 4.0];
/// The first amount if the conflict names none, as a share of the limit.
const FIRST: f64 = 0.02;

/// The options of one attempt: a quarter of the effort of the whole search.
fn smaller(options: &ShapeSearchOptions) -> ShapeSearchOptions {
    let quarter = |n: usize| n.div_ceil(4).max(1);
    ShapeSearchOptions {
        populations: quarter(options.populations),
        starts: quarter(options.starts).max(3),
        polished: quarter(options.polished).max(2),
        ..*options
    }
}

/// A least `|det A|` too small to be decisive, as a share of the usual one.
const LOOSE: f64 = 1e-3;
/// A demand is eased if its relaxation decreases by more than this share.
const EASED: f64 = 1e-2;

/// The design without the default limit of the least `|det A|`; `None` if it states one, or the search has no such
/// limit.
fn without_default_determinant(design: &Design, extension: f64) -> Option<Design> {
    let v = dimensional_problem(design, extension).variables;
    let holds = (v.offsets || v.components) && v.triangles == Triangles::Fixed;
    let mut loose = design.clone();
    loose.optimize.min_abs_det = Some(LOOSE * DEFAULT_MIN_ABS_DET);
    (holds && design.optimize.min_abs_det.is_none()).then_some(loose)
}

/// The least amount by which a demand has to be relaxed.
fn given(g: &Give) -> f64 {
    g.alone.unwrap_or(g.together)
}

/// The demands that need less relaxation in the second conflict.
fn eased(before: &ConstraintConflict, after: &ConstraintConflict) -> Vec<RelaxedRequirement> {
    let less = |g: &Give| {
        let other = after.demands.iter().find(|other| other.demand == g.demand)?;
        let found = RelaxedRequirement { demand: g.demand, from: given(g), to: given(other) };
        (found.to < (1.0 - EASED) * found.from).then_some(found)
    };
    before.demands.iter().filter_map(less).collect()
}

/// The freedoms that a design does not allow: defaults of the search first, then variables, then the limits of the
/// conflict.
fn closed(design: &Design, report: &DimensionalReport, extension: f64) -> Vec<ConflictFreedom> {
    let has = |kind| design.search.variables.contains(&kind);
    let mut out = Vec::new();
    if without_default_determinant(design, extension).is_some() {
        out.push(ConflictFreedom::MinAbsDet);
    }
    if !has(VariableKind::HomeHeight) {
        out.push(ConflictFreedom::HomeHeight);
    }
    let octahedral = Octahedral::recognise(design.manipulator()).is_ok();
    match (has(VariableKind::TriangleSizes), has(VariableKind::Triangles)) {
        (true, false) if octahedral => out.push(ConflictFreedom::Triangles),
        (true, false) | (_, true) => {}
        (false, false) => out.push(ConflictFreedom::TriangleSizes),
    }
    let DimensionalOutcome::Infeasible(conflict) = &report.outcome else { return out };
    let clashes = |kind: &TermKind| conflict.demands.iter().any(|g| g.demand == Demand::Requirement(*kind));
    let limits = [
        ConflictFreedom::Stroke,
        ConflictFreedom::BaseEnvelope,
        ConflictFreedom::PlatformEnvelope,
        ConflictFreedom::MachineEnvelope,
        ConflictFreedom::BaseMargin,
        ConflictFreedom::PlatformMargin,
    ];
    out.extend(limits.into_iter().filter(|f| f.kinds().iter().any(clashes)));
    out
}

/// The amount by which the requirements of a kind have to be relaxed in the conflict: alone if known, else together
/// with the others.
fn gives(report: &DimensionalReport, kind: TermKind) -> f64 {
    let DimensionalOutcome::Infeasible(conflict) = &report.outcome else { return 0.0 };
    let own = conflict.demands.iter().find(|g| g.demand == Demand::Requirement(kind));
    own.map_or(0.0, |g| g.alone.unwrap_or(g.together))
}

/// The design with a limit relaxed by an amount. For the stroke, `ends` gives the parts added at the short and at the
/// long end of the range.
fn wider(design: &Design, freedom: ConflictFreedom, amount: f64, ends: [f64; 2]) -> Design {
    let mut out = design.clone();
    let grown = |e: &mut Option<Envelope>| {
        *e = e.map(|e| match e {
            Envelope::Cylinder { radius, center } => Envelope::Cylinder { radius: radius + amount, center },
            Envelope::Box { min, max } => {
                Envelope::Box { min: min.map(|x| x - amount), max: max.map(|x| x + amount) }
            }
        });
    };
    let widened = |plate: &mut Option<PlateDesign>| {
        if let Some(plate) = plate {
            plate.margin += amount;
        }
    };
    match freedom {
        ConflictFreedom::BaseMargin => widened(&mut out.plates.base),
        ConflictFreedom::PlatformMargin => widened(&mut out.plates.platform),
        ConflictFreedom::Stroke => {
            out.hardware.leg_length = design.hardware.leg_length.map(|l| match l {
                LengthLimits::Range(a, b) => {
                    LengthLimits::Range((a - ends[0] * amount).max(0.0), b + ends[1] * amount)
                }
                LengthLimits::Stroke { dead, stroke } => {
                    LengthLimits::Stroke { dead, stroke: stroke + amount }
                }
            });
        }
        ConflictFreedom::BaseEnvelope => grown(&mut out.envelopes.base),
        ConflictFreedom::PlatformEnvelope => grown(&mut out.envelopes.platform),
        ConflictFreedom::MachineEnvelope => grown(&mut out.envelopes.machine),
        ConflictFreedom::HomeHeight
        | ConflictFreedom::TriangleSizes
        | ConflictFreedom::Triangles
        | ConflictFreedom::MinAbsDet => {}
    }
    out
}

/// The first amount; for a stroke also its distribution over the ends.
fn first_amount(design: &Design, report: &DimensionalReport, freedom: ConflictFreedom) -> (f64, [f64; 2]) {
    let half = |e: Option<Envelope>| e.map_or(0.0, |e| e.half_width());
    let part = |x: f64, whole: f64| if x > 0.0 { x } else { FIRST * whole };
    let margin = |plate: &Option<PlateDesign>| plate.as_ref().map_or(0.0, |plate| plate.margin);
    match freedom {
        ConflictFreedom::BaseMargin => {
            (part(gives(report, TermKind::BaseHoleEdge), margin(&design.plates.base)), [0.0; 2])
        }
        ConflictFreedom::PlatformMargin => {
            (part(gives(report, TermKind::PlatformHoleEdge), margin(&design.plates.platform)), [0.0; 2])
        }
        ConflictFreedom::Stroke => {
            let range = design.hardware.leg_length.map_or((0.0, 0.0), |l| l.range());
            let [short, long] =
                [TermKind::MinLegLength, TermKind::MaxLegLength].map(|kind| gives(report, kind));
            match design.hardware.leg_length {
                // the longest leg grows by twice the stroke
                Some(LengthLimits::Stroke { .. }) => {
                    (part(0.5 * long.max(short), range.1 - range.0), [0.0; 2])
                }
                // one end suffices if relaxing it alone resolves the conflict
                _ if long > 0.0 && (long <= short || short <= 0.0) => (long, [0.0, 1.0]),
                _ if short > 0.0 => (short, [1.0, 0.0]),
                _ => (FIRST * (range.1 - range.0), [0.5; 2]),
            }
        }
        ConflictFreedom::BaseEnvelope => {
            (part(gives(report, TermKind::BaseEnvelope), half(design.envelopes.base)), [0.0; 2])
        }
        ConflictFreedom::PlatformEnvelope => {
            (part(gives(report, TermKind::PlatformEnvelope), half(design.envelopes.platform)), [0.0; 2])
        }
        _ => (part(gives(report, TermKind::MachineEnvelope), half(design.envelopes.machine)), [0.0; 2]),
    }
}

/// One search; `Break` if it was interrupted.
type AttemptFlow = ControlFlow<(), Option<Box<Checked>>>;

/// Searches with one more freedom each.
pub(crate) struct FreedomSearch<'a, 'p> {
    pub(crate) design: &'a Design,
    pub(crate) extension: f64,
    pub(crate) report: &'a DimensionalReport,
    pub(crate) options: ShapeSearchOptions,
    pub(crate) progress: &'p mut dyn FnMut(ConflictFreedom, Progress) -> ControlFlow<()>,
}

impl FreedomSearch<'_, '_> {
    /// Tries all freedoms that the design does not allow, one after the other.
    pub(crate) fn run(mut self) -> Result<Vec<OpenedFreedom>, VerifyError> {
        let mut out = Vec::new();
        let mut ended = false;
        for freedom in closed(self.design, self.report, self.extension) {
            let opened = if ended {
                let outcome = FreedomOutcome::NotTried;
                Some(OpenedFreedom { freedom, amount: None, outcome, eased: Vec::new() })
            } else {
                self.open(freedom)?
            };
            ended |= opened.as_ref().is_some_and(|o| o.outcome == FreedomOutcome::NotTried);
            out.extend(opened);
        }
        Ok(out)
    }

    /// Tries one freedom; `None` if it cannot be searched.
    fn open(&mut self, freedom: ConflictFreedom) -> Result<Option<OpenedFreedom>, VerifyError> {
        let told = |outcome, amount| Some(OpenedFreedom { freedom, amount, outcome, eased: Vec::new() });
        if freedom == ConflictFreedom::MinAbsDet {
            return self.without_default();
        }
        if let Some(kind) = freedom.variable() {
            let mut more = self.design.clone();
            if more.search.variables.is_empty() {
                let usual = if Octahedral::recognise(more.manipulator()).is_ok() {
                    VariableKind::Offsets
                } else {
                    VariableKind::Components
                };
                more.search.variables.push(usual);
            }
            more.search.variables.push(kind);
            return Ok(match self.search(freedom, &more)? {
                None => None,
                Some(ControlFlow::Break(())) => told(FreedomOutcome::NotTried, None),
                Some(ControlFlow::Continue(found)) => {
                    let lift = |c: &Checked| {
                        c.design.home_or_default().position.z - self.design.home_or_default().position.z
                    };
                    let amount =
                        found.as_deref().filter(|_| freedom == ConflictFreedom::HomeHeight).map(lift);
                    told(outcome_of(found), amount)
                }
            });
        }
        let (first, ends) = first_amount(self.design, self.report, freedom);
        let mut best: Option<(f64, Box<Checked>)> = None;
        let mut last = None;
        for factor in ATTEMPTS {
            let amount = first * factor;
            match self.search(freedom, &wider(self.design, freedom, amount, ends))? {
                None => return Ok(None),
                Some(ControlFlow::Break(())) if best.is_none() => {
                    return Ok(told(FreedomOutcome::NotTried, None));
                }
                Some(ControlFlow::Break(())) => break,
                Some(ControlFlow::Continue(found)) => {
                    last = Some(amount);
                    let Some(found) = found else { continue };
                    let proved = found.met() == Some(true);
                    if best.is_none() || proved {
                        best = Some((amount, found));
                    }
                    if proved {
                        break;
                    }
                }
            }
        }
        Ok(match best {
            Some((amount, found)) => told(outcome_of(Some(found)), Some(amount)),
            None => told(FreedomOutcome::Unresolved, last),
        })
    }

    /// Searches without the least `|det A|`. If this does not resolve the conflict, it compares the conflicts; `None`
    /// if no demand is eased.
    fn without_default(&mut self) -> Result<Option<OpenedFreedom>, VerifyError> {
        let freedom = ConflictFreedom::MinAbsDet;
        let told = |outcome, eased| Some(OpenedFreedom { freedom, amount: None, outcome, eased });
        let Some(loose) = without_default_determinant(self.design, self.extension) else { return Ok(None) };
        match self.search(freedom, &loose)? {
            None => return Ok(None),
            Some(ControlFlow::Break(())) => return Ok(told(FreedomOutcome::NotTried, Vec::new())),
            Some(ControlFlow::Continue(Some(found))) => return Ok(told(outcome_of(Some(found)), Vec::new())),
            Some(ControlFlow::Continue(None)) => {}
        }
        let DimensionalOutcome::Infeasible(before) = &self.report.outcome else { return Ok(None) };
        let problem = dimensional_problem(&loose, self.extension);
        let report = optimize(&problem, &[], &smaller(&self.options), &mut |p| (self.progress)(freedom, p));
        let less = match report {
            Ok(DimensionalReport { outcome: DimensionalOutcome::Infeasible(after), .. }) => {
                eased(before, &after)
            }
            _ => Vec::new(),
        };
        Ok(if less.is_empty() { None } else { told(FreedomOutcome::Unresolved, less) })
    }

    /// Searches for a design with more freedom, and assesses the platform found; `None` if the problem is invalid. A
    /// design with three-fold symmetry that names none is searched with the symmetry first, which has few variables,
    /// then without it.
    fn search(
        &mut self,
        freedom: ConflictFreedom,
        design: &Design,
    ) -> Result<Option<AttemptFlow>, VerifyError> {
        let free = dimensional_problem(design, self.extension);
        let symmetric = keeps_symmetry_of_start(design, &free);
        for problem in symmetric.iter().chain([&free]) {
            match self.search_problem(freedom, design, problem)? {
                Some(ControlFlow::Continue(None)) => {}
                ended => return Ok(ended),
            }
        }
        Ok(Some(ControlFlow::Continue(None)))
    }

    /// See [`search`](Self::search), for one of its problems.
    fn search_problem(
        &mut self,
        freedom: ConflictFreedom,
        design: &Design,
        problem: &DimensionalProblem,
    ) -> Result<Option<AttemptFlow>, VerifyError> {
        let known = self.report.nearest.as_deref().map_or(&[][..], |s| &s.variables);
        let mut ended = false;
        let found = meet(problem, known, &smaller(&self.options), &mut |p| {
            let flow = (self.progress)(freedom, p);
            ended |= flow.is_break();
            flow
        });
        let found: Option<DimensionalSolution> = match found {
            Ok(found) => found,
            // an invalid problem with another variable is no freedom
            Err(_) => return Ok(None),
        };
        if ended && found.is_none() {
            return Ok(Some(ControlFlow::Break(())));
        }
        let assessed = found.map(|s| checked(design, problem, &s, (&self.options).into())).transpose()?;
        let met = assessed.filter(|c| c.met() != Some(false));
        Ok(Some(ControlFlow::Continue(met.map(Box::new))))
    }
}

fn outcome_of(found: Option<Box<Checked>>) -> FreedomOutcome {
    match found {
        None => FreedomOutcome::Unresolved,
        Some(c) if c.met() == Some(true) => FreedomOutcome::Resolved(c),
        Some(c) => FreedomOutcome::Undecided(c),
    }
}
