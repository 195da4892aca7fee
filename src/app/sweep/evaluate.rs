//! Rows of the table: the free quantities of candidate `k`, and its computed results.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::OnceLock;

use nalgebra::Point3;
use serde_json::Value;

use super::candidate::{Ground, SweepCandidate};
use super::climb::climb;
use super::column::{ColumnKind, SweepCell, SweepColumn};
use super::plan::{AnswerField, AnswerName, AxisValues, BasePlan, FreeQuantity, SweepPlan, SweepTask};
use ask::{BOX_CELLS, CheckReport, Checked, OptimizeEvidence, OptimizeOptions, Solver};
use files::design::Drive;
use fk::{FkOptions, FkRoot, Threads};
use machine::manufacture::{PoseSearch, joint_allowance};
use machine::requirements::{TermKind, Terms};
use platform::manipulator::{
    Body, inverse_condition, jacobian, least_axis_distance, length_range, worst_conditioning,
};
use records::{AssessAnswer, CheckAnswer, SolvedRecord};
use synthesis::Pattern;
use synthesis::singularity::regular_box;

/// Number of poses for the joint tolerances, as in `compare`.
const TOLERANCE_POSES: usize = 300;

/// A pattern with the number of its offsets.
#[derive(Debug, Clone)]
pub(super) struct KnownPattern {
    pub(super) pattern: Pattern,
    pub(super) offsets: usize,
}

/// A prepared plan: candidate `k` always has the same row.
#[derive(Debug)]
pub struct Sweep {
    /// The plan.
    pub plan: SweepPlan,
    /// The base design and its files.
    pub base: BasePlan,
    /// The seed of all samples.
    pub seed: u64,
    /// The columns of the table.
    pub columns: Vec<SweepColumn>,
    /// The data common to all candidates, unless the text of the base design changes.
    pub(super) ground: Option<Ground>,
    /// Forward kinematics prepared once, if all candidates have the same platform.
    pub(super) solver: Option<Solver>,
    pub(super) patterns: BTreeMap<String, KnownPattern>,
    /// The pattern for offsets without a named pattern.
    pub(super) joint_free: KnownPattern,
    kinds: Vec<TermKind>,
    /// The result of `check`, if all candidates have the same platform.
    pub(super) checked: OnceLock<Result<CheckReport, String>>,
}

impl Sweep {
    /// # Errors
    /// The reason why the base design has no candidates at all.
    pub fn new(plan: SweepPlan, base: BasePlan, seed: u64) -> Result<Self, String> {
        let words = plan.blocks.iter().flat_map(|b| &b.axes).filter(|a| a.quantity == FreeQuantity::Pattern);
        let words =
            words.filter_map(|a| if let AxisValues::Words(list) = &a.values { Some(list) } else { None });
        let known = |pattern: Pattern| KnownPattern { offsets: pattern.offsets().len(), pattern };
        let patterns =
            words.flatten().filter_map(|word| Some((word.clone(), known(word.parse().ok()?)))).collect();
        let joint_free = Pattern::new([false; 6], [1; 6])
            .unwrap_or_else(|| unreachable!("one inner point on each side is a pattern"));
        let mut sweep = Self {
            columns: plan.columns(&base),
            kinds: base.required_kinds(),
            plan,
            base,
            seed,
            ground: None,
            solver: None,
            patterns,
            joint_free: known(joint_free),
            checked: OnceLock::new(),
        };
        if sweep.plan.text_is_fixed() {
            sweep.ground = Some(Ground::new(sweep.base.design.clone(), &sweep)?);
        }
        if sweep.plan.platform_is_fixed() && sweep.plan.tasks.iter().any(SweepTask::needs_lengths) {
            let options = FkOptions::new().seed(seed);
            sweep.solver = Some(Solver::new(sweep.base.design.manipulator().clone(), options));
        }
        Ok(sweep)
    }

    /// The number of candidates.
    pub fn count(&self) -> u64 {
        self.plan.count()
    }

    /// Whether candidates are equivalent platforms of the base design.
    pub(super) fn has_equivalents(&self) -> bool {
        self.plan.quantities().any(|q| matches!(q, FreeQuantity::Pattern | FreeQuantity::Offset(_)))
    }

    /// The row of candidate `k`; `None` if the plan does not keep it. A failed computation gives a row with its error.
    pub fn row(&self, k: u64) -> Option<Vec<SweepCell>> {
        let mut row = Vec::with_capacity(self.columns.len());
        self.row_onto(k, &mut row).then_some(row)
    }

    /// Appends the row of candidate `k` to others; `false` without a row if the plan does not keep it.
    pub(super) fn row_onto(&self, k: u64, rows: &mut Vec<SweepCell>) -> bool {
        let values = self.plan.values(self.seed, k);
        if self.repeats(k, &values) {
            return false;
        }
        // a panic in one candidate must not lose the others
        let found = catch_unwind(AssertUnwindSafe(|| self.computed(&values)));
        let (cells, error) = match found {
            Ok(Kept::Row(cells)) => (cells, None),
            Ok(Kept::Not) => return false,
            Ok(Kept::Failed(cells, error)) => (cells, Some(error)),
            Err(payload) => {
                let text = payload.downcast_ref::<&str>().map(ToString::to_string);
                let text = text.or_else(|| payload.downcast_ref::<String>().cloned()).unwrap_or_default();
                (Vec::new(), Some(format!("the program broke down: {text}")))
            }
        };
        let first = rows.len();
        rows.push(SweepCell::Integer(k as i64));
        rows.extend(values);
        rows.extend(cells);
        rows.resize(first + self.columns.len() - 1, SweepCell::Empty);
        rows.push(SweepCell::text(error.as_deref()));
        true
    }

    /// Whether another candidate has the same platform, because the pattern leaves offsets unused: the one with first
    /// values for these offsets.
    fn repeats(&self, k: u64, values: &[SweepCell]) -> bool {
        let pattern =
            self.plan.quantities().zip(values).find_map(|(quantity, value)| match (quantity, value) {
                (FreeQuantity::Pattern, SweepCell::Text(name)) => self.patterns.get(name),
                _ => None,
            });
        pattern.is_some_and(|pattern| !self.plan.has_first_of_unused(k, pattern.offsets))
    }

    /// The text of candidate `k` as a design file.
    ///
    /// # Errors
    /// The reason why there is none.
    pub fn design_text(&self, k: u64) -> Result<String, String> {
        let values = self.plan.values(self.seed, k);
        SweepCandidate::new(self, &values)?.text()
    }

    fn computed(&self, values: &[SweepCell]) -> Kept {
        let first = 1 + values.len();
        let mut row = Vec::with_capacity(self.columns.len());
        row.push(SweepCell::Empty);
        row.extend_from_slice(values);
        let mut conditions: Vec<_> = self.plan.keep.iter().collect();
        let mut fails = |row: &[SweepCell]| {
            let mut failed = false;
            conditions.retain(|c| {
                let known = c.column < row.len();
                failed |= known && !c.holds(row);
                !known
            });
            failed
        };
        if fails(&row) {
            return Kept::Not;
        }
        let candidate = match SweepCandidate::new(self, values) {
            Ok(candidate) => candidate,
            Err(error) => return Kept::Failed(Vec::new(), error),
        };
        for task in &self.plan.tasks {
            match self.cells(task, &candidate) {
                Ok(cells) => row.extend(cells),
                Err(error) => return Kept::Failed(row.split_off(first), error),
            }
            if fails(&row) {
                return Kept::Not;
            }
        }
        Kept::Row(row.split_off(first))
    }

    /// The cells of a task, one for each of its columns.
    fn cells(&self, task: &SweepTask, c: &SweepCandidate<'_>) -> Result<Vec<SweepCell>, String> {
        let m = c.manipulator();
        Ok(match task {
            SweepTask::DetA => vec![SweepCell::number(c.determinant())],
            SweepTask::Conditioning => {
                let worst = worst_conditioning(&m.legs(), &c.ground.poses, c.characteristic_length());
                vec![
                    SweepCell::number(worst.map(|w| w.0)),
                    worst.map_or(SweepCell::Empty, |w| SweepCell::count(w.1)),
                ]
            }
            SweepTask::HomeConditioning => {
                let j = jacobian(m, &c.ground.home, c.characteristic_length());
                vec![SweepCell::Number(inverse_condition(&j))]
            }
            SweepTask::Spacing => {
                Body::BOTH.map(|body| SweepCell::number(m.nearest_joints(body).map(|n| n.0))).to_vec()
            }
            SweepTask::SharedJoints => vec![SweepCell::count(m.with_merged_joints().shared_joints())],
            SweepTask::Clearance => vec![SweepCell::number(self.clearance(c))],
            SweepTask::LengthRange => match length_range(&m.legs(), &c.ground.poses) {
                Some(range) => range.map(SweepCell::Number).to_vec(),
                None => vec![SweepCell::Empty; 2],
            },
            SweepTask::Lengths => c.squares()?.lengths().get().map(SweepCell::Number).to_vec(),
            SweepTask::Poses => {
                let found = c.solved()?;
                let certified = found.roots.iter().filter(|r| r.certified()).count();
                vec![
                    SweepCell::count(found.roots.len()),
                    SweepCell::count(found.assembly_modes().count()),
                    SweepCell::count(certified),
                    SweepCell::text(Some(found.completeness.name())),
                ]
            }
            SweepTask::Solutions => {
                vec![SweepCell::Text(as_json(&SolvedRecord::from(c.solved()?))?.to_string())]
            }
            SweepTask::Margins => {
                let found = c.assessed()?;
                let mut cells =
                    vec![SweepCell::truth(found.met()), SweepCell::truth(found.regularity.is_regular())];
                cells.extend(self.kinds.iter().map(|kind| {
                    let bound = found.proof.bounds.iter().find(|b| b.found.term.kind == *kind);
                    SweepCell::number(bound.map(|b| b.found.value))
                }));
                cells
            }
            SweepTask::Drive => {
                let of = |figure: fn(&Drive) -> Option<f64>| SweepCell::number(c.drive.and_then(figure));
                vec![of(|d| Some(d.stroke)), of(|d| d.mass), of(|d| d.price)]
            }
            SweepTask::Check => {
                let found = c.checked()?;
                vec![
                    SweepCell::truth(found.is_singular()),
                    SweepCell::text(found.verdict.reason()),
                    SweepCell::Number(found.at_least),
                    found.pose_count.finite().map_or(SweepCell::Empty, SweepCell::count),
                ]
            }
            SweepTask::RegularBox => {
                let options = c.ground.design.box_options(BOX_CELLS, self.seed);
                let found = regular_box(m, &c.ground.home, &options);
                vec![SweepCell::Number(found.proved), SweepCell::number(found.refuted.map(|r| r.scale))]
            }
            SweepTask::Tolerance => vec![self.tolerance(c)?],
            SweepTask::Optimum => self.optimum(c)?,
            SweepTask::Joints => {
                let ends = m.legs().map(|leg| [leg.base, leg.platform]);
                ends.iter().flatten().flat_map(|p| [p.x, p.y, p.z]).map(SweepCell::Number).collect()
            }
            SweepTask::Climb => {
                let found = climb(m, &c.squares()?, self.seed, self.plan.steps)?;
                let certified = |r: &&FkRoot| r.certified();
                let mut cells = vec![
                    SweepCell::count(found.began),
                    SweepCell::count(found.found.assembly_modes().filter(certified).count()),
                    SweepCell::count(found.found.roots.iter().filter(certified).count()),
                    SweepCell::text(Some(found.found.completeness.name())),
                    SweepCell::count(found.steps),
                ];
                let ends = found.manipulator.legs().map(|leg| [leg.base, leg.platform]);
                cells.extend(ends.iter().flatten().flat_map(|p| [p.x, p.y, p.z]).map(SweepCell::Number));
                cells.extend(found.squares.lengths().get().map(SweepCell::Number));
                cells
            }
            SweepTask::Field(field) => vec![field_of(field, c)?],
        })
    }

    /// The least clearance, over the poses, of two legs that share no joint.
    fn clearance(&self, c: &SweepCandidate<'_>) -> Option<f64> {
        let (m, poses) = (c.manipulator(), &c.ground.poses);
        let Some(body) = self.base.design.hardware.leg_body else { return least_axis_distance(m, poses) };
        if body.rod.is_none() {
            return least_axis_distance(m, poses).map(|d| d - body.diameter);
        }
        let required = c.ground.design.requirements();
        let terms = Terms::new(m, &required, &c.ground.home);
        poses.iter().filter_map(|pose| terms.least_leg_gap(pose)).reduce(f64::min)
    }

    fn tolerance(&self, c: &SweepCandidate<'_>) -> Result<SweepCell, String> {
        let Some(bound) = self.plan.accuracy else { return Ok(SweepCell::Empty) };
        let space = c.ground.design.workspace_or_default().space(&c.ground.home);
        let search = PoseSearch { points: TOLERANCE_POSES, seed: self.seed, ..PoseSearch::default() };
        let found = joint_allowance(c.manipulator(), &space, Point3::origin(), bound, &search);
        found.map(|found| SweepCell::Number(found.value)).map_err(|e| e.to_string())
    }

    fn optimum(&self, c: &SweepCandidate<'_>) -> Result<Vec<SweepCell>, String> {
        // one thread: the other threads work on other candidates of the shard
        let threads = Threads::Count(std::num::NonZeroUsize::MIN);
        let mut options = OptimizeOptions::new().seed(self.seed).threads(threads).freedoms(false);
        let design = c.design()?;
        if let (Some(table), Some(_)) = (&self.base.drives, &design.drive_table) {
            options = options.drives(table);
        }
        let report = design.optimize_with(options).map_err(|e| e.to_string())?;
        let first = |c: &Checked| c.objectives.first().map(|(_, value)| *value);
        let value = match &report.evidence {
            OptimizeEvidence::Front(found) => found.members.first().and_then(first),
            _ => report.checked().and_then(first),
        };
        Ok(vec![SweepCell::text(Some(report.status.name())), SweepCell::number(value)])
    }
}

/// The outcome of a candidate.
enum Kept {
    /// Its cells.
    Row(Vec<SweepCell>),
    /// A condition of the plan does not hold.
    Not,
    /// The cells up to an error.
    Failed(Vec<SweepCell>, String),
}

fn as_json(record: &impl serde::Serialize) -> Result<Value, String> {
    serde_json::to_value(record).map_err(|e| e.to_string())
}

/// The field of an answer as a cell: empty if it is null or absent.
fn field_of(field: &AnswerField, c: &SweepCandidate<'_>) -> Result<SweepCell, String> {
    let answer = match field.answer {
        AnswerName::Assess => as_json(&AssessAnswer::new(c.design()?, c.assessed()?))?,
        AnswerName::Check => as_json(&CheckAnswer::from(c.checked()?))?,
        AnswerName::Fk => as_json(&SolvedRecord::from(c.solved()?))?,
    };
    let step = |value: &Value, key: &String| match value {
        Value::Array(list) => key.parse::<usize>().ok()?.checked_sub(1).and_then(|i| list.get(i).cloned()),
        other => other.get(key).cloned(),
    };
    let found = field.path.iter().try_fold(answer, |value, key| step(&value, key));
    let wrong =
        |value: &Value| Err(format!("{} is {value}, not a {}", field.path.join("."), field.kind.name()));
    match (field.kind, found) {
        (_, None | Some(Value::Null)) => Ok(SweepCell::Empty),
        (ColumnKind::Number, Some(Value::Number(x))) => Ok(SweepCell::number(x.as_f64())),
        (ColumnKind::Integer, Some(Value::Number(x))) => {
            Ok(x.as_i64().map_or(SweepCell::Empty, SweepCell::Integer))
        }
        (ColumnKind::Truth, Some(Value::Bool(b))) => Ok(SweepCell::Truth(b)),
        (ColumnKind::Text, Some(Value::String(text))) => Ok(SweepCell::Text(text)),
        (_, Some(other)) => wrong(&other),
    }
}
