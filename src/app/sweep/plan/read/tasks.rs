//! The computed results and the conditions on rows.

use super::{PlanReader, missing};
use crate::column::{ColumnKind, SweepColumn};
use crate::plan::{AnswerField, AnswerName, KeepCondition, SweepTask, TASK_WORDS};
use files::design::Code;
use files::design::spanned::{Entry, Node, Value, check_keys, find, nearest_help, shown, text};
impl PlanReader<'_, '_> {
    pub(super) fn tasks(&mut self, root: &Node, entry: Option<&Entry>) -> Option<Vec<SweepTask>> {
        const FORM: &str = "write compute = [\"det_a\", \"conditioning\"]";
        let Some(entry) = entry else {
            missing(self.report, root, "compute", FORM);
            return None;
        };
        let list = self.list(&entry.node, "`compute`", FORM)?;
        let tasks: Vec<_> = list.iter().map(|node| self.task(node)).collect();
        tasks.into_iter().collect()
    }

    fn task(&mut self, node: &Node) -> Option<SweepTask> {
        let words: Vec<&str> = TASK_WORDS.iter().map(|t| t.0).collect();
        match &node.value {
            Value::Text(word) => {
                let found = TASK_WORDS.iter().find(|t| t.0 == word);
                if found.is_none() {
                    let help = nearest_help("what can be computed", word, &words);
                    self.report.refuse(
                        Code::UnknownName,
                        &node.span,
                        format!("`{}` cannot be computed", shown(word)),
                        help,
                    );
                }
                found.map(|t| t.1.clone())
            }
            Value::Table(inner) => self.field(node, inner).map(SweepTask::Field),
            _ => {
                self.report.not_a(node, "what is computed", "a word", format!("one of {}", words.join(", ")))
            }
        }
    }

    fn field(&mut self, node: &Node, inner: &[Entry]) -> Option<AnswerField> {
        const FORM: &str = "write { column = \"median\", field = \"check.jacobian_inverse_condition.median\", as = \"number\" }";
        check_keys(self.report, inner, &["column", "field", "as", "unit"], "a computed field");
        let mut word = |key: &str, optional: bool| match find(inner, key) {
            Some(e) => text(self.report, e),
            None if optional => None,
            None => self.report.refused(Code::MissingKey, &node.span, format!("`{key}` is missing"), FORM),
        };
        let (column, field) = (word("column", false), word("field", false));
        let (kind, unit) = (word("as", true), word("unit", true));
        let kind = match kind {
            None => ColumnKind::Number,
            Some(word) => {
                let found = ColumnKind::ALL.into_iter().find(|k| k.name() == word);
                let Some(kind) = found else {
                    let help = nearest_help("kinds", &word, &ColumnKind::ALL.map(ColumnKind::name));
                    return self.report.refused(
                        Code::UnknownName,
                        &node.span,
                        format!("`{}` is not a kind of column", shown(&word)),
                        help,
                    );
                };
                kind
            }
        };
        let (column, field) = (column?, field?);
        let mut path = field.split('.').map(str::to_owned);
        let first = path.next().unwrap_or_default();
        let Some(answer) = AnswerName::ALL.into_iter().find(|a| a.name() == first) else {
            let help = nearest_help("answers", &first, &AnswerName::ALL.map(AnswerName::name));
            return self.report.refused(
                Code::UnknownName,
                &node.span,
                format!("`{}` is not an answer with fields", shown(&first)),
                help,
            );
        };
        Some(AnswerField { column, answer, path: path.collect(), kind, unit })
    }

    /// The conditions. If the columns are unknown, because the plan is refused, only their form is checked.
    pub(super) fn keep(
        &mut self,
        entry: &Entry,
        columns: Option<&[SweepColumn]>,
    ) -> Option<Vec<KeepCondition>> {
        let form = "write keep = [\"conditioning >= 0.1\"]";
        let list = self.list(&entry.node, "`keep`", form)?;
        let mut keep = Vec::new();
        for node in list {
            let Value::Text(condition) = &node.value else {
                self.report.refuse(
                    Code::WrongType,
                    &node.span,
                    format!("a condition is {}, not a string", node.value.kind()),
                    form,
                );
                continue;
            };
            let read = match columns {
                Some(columns) => KeepCondition::read(condition, columns).map(Some),
                None => KeepCondition::parts(condition).map(|_| None),
            };
            match read {
                Ok(condition) => keep.extend(condition),
                Err((message, help)) => self.report.refuse(Code::Expression, &node.span, message, help),
            }
        }
        Some(keep)
    }
}
