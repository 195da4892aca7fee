//! Checks that the parts of a plan fit each other and the base design.

use super::PlanReader;
use crate::column::SweepColumn;
use crate::plan::{AnswerField, AnswerName, AxisValues, FreeQuantity, SweepPlan, SweepTask};
use ask::equivalents::Original;
use files::design::Code;
use files::design::spanned::{Span, shown};
use synthesis::Pattern;
impl PlanReader<'_, '_> {
    pub(super) fn count(&mut self, plan: &SweepPlan, place: &Span) {
        let counts: Vec<u64> = plan.blocks.iter().map(|b| b.count).collect();
        self.product(&counts, place);
    }

    /// Checks that free quantities fit each other and the base design.
    pub(super) fn quantities(&mut self, plan: &SweepPlan, place: &Span) {
        let has = |counts: &dyn Fn(&FreeQuantity) -> bool| plan.quantities().filter(|q| counts(q)).count();
        let offsets = has(&|q| matches!(q, FreeQuantity::Offset(_)));
        let pattern = has(&|q| *q == FreeQuantity::Pattern) > 0;
        if (offsets > 0 || pattern) && plan.text_is_fixed() && Original::of(&self.base.design).is_none() {
            self.report.refuse(
                Code::ConflictingKeys,
                place,
                "offsets and patterns are those of octahedral platforms, and the base design is none",
                "take an octahedral design; `equipod equivalents nearest DESIGN` finds one near",
            );
        }
        if offsets > 0 && !pattern && offsets != 6 {
            self.report.refuse(
                Code::MissingKey,
                place,
                format!("{offsets} of the six offsets vary"),
                "give all six: `offsets.1` to `offsets.6`, single values in lists of one",
            );
        }
        if pattern {
            let words =
                plan.blocks.iter().flat_map(|b| &b.axes).filter(|a| a.quantity == FreeQuantity::Pattern);
            let needed = words
                .filter_map(|a| if let AxisValues::Words(list) = &a.values { Some(list) } else { None })
                .flatten()
                .filter_map(|w| w.parse::<Pattern>().ok())
                .map(|p| p.offsets().len())
                .max()
                .unwrap_or(0);
            if needed > offsets {
                self.report.refuse(
                    Code::MissingKey,
                    place,
                    format!("{offsets} offsets vary, and the patterns take up to {needed}"),
                    "give `offsets`: a pattern with fewer takes the first ones",
                );
            }
        }
        // the table in the base design is for its searches
        let named_by_plan = self.base.drives.is_some() && self.base.design.drive_table.is_none();
        if named_by_plan && has(&|q| *q == FreeQuantity::Drive) == 0 {
            self.report.refuse(
                Code::ConflictingKeys,
                place,
                "the plan names a table of drives, and the drive does not vary",
                "add drive = \"all\" to the values of a block, or leave `drives` out",
            );
        }
        let lengths = has(&|q| matches!(q, FreeQuantity::Length(_)));
        let pose = has(&|q| matches!(q, FreeQuantity::Pose(_)));
        if lengths > 0 && pose > 0 {
            self.report.refuse(
                Code::ConflictingKeys,
                place,
                "lengths vary, and the pose from which lengths are taken does too",
                "keep one of them",
            );
        }
        if (1..6).contains(&lengths) && self.base.design.lengths.is_none() {
            self.report.refuse(
                Code::MissingKey,
                place,
                format!("{lengths} of the six lengths vary, and the base design has none"),
                "give all six, or `lengths` to the base design",
            );
        }
        if (lengths > 0 || pose > 0) && !plan.tasks.iter().any(SweepTask::needs_lengths) {
            self.report.refuse(
                Code::ConflictingKeys,
                place,
                "lengths or the pose vary, and nothing that is computed depends on them",
                "compute lengths, poses or solutions",
            );
        }
    }

    /// Checks that the computed results make sense for the base design and for the free quantities.
    pub(super) fn computable(&mut self, plan: &SweepPlan, place: &Span) {
        let equivalent =
            plan.quantities().any(|q| matches!(q, FreeQuantity::Pattern | FreeQuantity::Offset(_)));
        for task in &plan.tasks {
            match task {
                SweepTask::DetA if !equivalent => {
                    self.report.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`det_a` is that of an equivalent platform",
                        "vary `offsets` or `pattern`, or leave it out",
                    );
                }
                SweepTask::Tolerance if plan.accuracy.is_none() => {
                    self.report.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`tolerance` is that for an accuracy, and the plan has none",
                        "add accuracy = [position, rotation_deg], or leave it out",
                    );
                }
                SweepTask::Drive if self.base.drives.is_none() => {
                    self.report.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`drive` is what a table says of the drive of a candidate, and the plan names none",
                        "add `drives = \"FILE.csv\"`, or leave it out",
                    );
                }
                SweepTask::Margins if self.base.required_kinds().is_empty() => {
                    self.report.refuse(
                        Code::ConflictingKeys,
                        place,
                        "`margins` are those of requirements, and the base design has none",
                        "add [hardware] to the design, or leave it out",
                    );
                }
                SweepTask::Field(AnswerField { answer: AnswerName::Assess, .. })
                    if self.base.required_kinds().is_empty() =>
                {
                    self.report.refuse(
                        Code::ConflictingKeys,
                        place,
                        "the base design has no requirements that `assess` could check",
                        "add [hardware] to the design, or leave the field out",
                    );
                }
                _ => {}
            }
        }
    }

    /// All columns, with unique names.
    pub(super) fn columns(&mut self, plan: &SweepPlan, place: &Span) -> Vec<SweepColumn> {
        let columns = plan.columns(self.base);
        for (k, column) in columns.iter().enumerate() {
            if columns[..k].iter().any(|c| c.name == column.name) {
                let message = format!("two columns have the name `{}`", shown(&column.name));
                self.report.refuse(
                    Code::ConflictingKeys,
                    place,
                    message,
                    "a quantity varies once, and a thing is computed once",
                );
            }
        }
        columns
    }
}
