//! Blocks of free quantities, with the numbers of their candidates.

use super::{PlanReader, missing};
use crate::plan::{AxisValues, MOST_CANDIDATES, PlanAxis, PlanBlock, Spreading};
use crate::sample::{DIMENSIONS, MOST, PointSpread};
use files::design::Code;
use files::design::spanned::{Entry, Node, Span, Value, check_keys, find, nearest_help, shown, table, text};

const SPREADINGS: [(&str, Spreading); 5] = [
    ("grid", Spreading::Grid),
    ("list", Spreading::List),
    ("uniform", Spreading::Points(PointSpread::Uniform)),
    ("latin_hypercube", Spreading::Points(PointSpread::LatinHypercube)),
    ("sobol", Spreading::Points(PointSpread::Sobol)),
];
impl PlanReader<'_, '_> {
    pub(super) fn blocks(&mut self, root: &Node, entry: Option<&Entry>) -> Option<Vec<PlanBlock>> {
        const FORM: &str = "write `[[vary]]` with `by = \"grid\"` and [vary.values] below it";
        let Some(entry) = entry else {
            missing(self.report, root, "vary", FORM);
            return None;
        };
        let nodes = match &entry.node.value {
            // a single block may be written as a table
            Value::Table(_) => std::slice::from_ref(&entry.node),
            _ => self.list(&entry.node, "`vary`", FORM)?,
        };
        if nodes.len() > 255 {
            return self.report.refused(
                Code::TooComplex,
                &entry.node.span,
                "`vary` has more than 255 blocks",
                "put quantities into one block",
            );
        }
        let blocks: Vec<_> = nodes.iter().map(|node| self.block(node)).collect();
        blocks.into_iter().collect()
    }

    fn block(&mut self, node: &Node) -> Option<PlanBlock> {
        let entries = table(self.report, node, "a block of `vary`")?;
        check_keys(self.report, entries, &["by", "count", "values"], "`vary`");
        let by = match find(entries, "by") {
            None => {
                let at = node.span.start..node.span.start;
                self.report.refused(
                    Code::MissingKey,
                    &at,
                    "`by` is missing",
                    "add `by = \"grid\"`, or list, uniform, latin_hypercube, sobol",
                )
            }
            Some(entry) => text(self.report, entry).and_then(|word| {
                let found = SPREADINGS.iter().find(|(name, _)| *name == word);
                if found.is_none() {
                    let help = nearest_help("ways to vary", &word, &SPREADINGS.map(|s| s.0));
                    self.report.refuse(
                        Code::UnknownName,
                        &entry.node.span,
                        format!("`{}` is not a way to vary", shown(&word)),
                        help,
                    );
                }
                found.map(|(_, s)| *s)
            }),
        };
        let Some(values) = find(entries, "values") else {
            let at = node.span.start..node.span.start;
            return self.report.refused(
                Code::MissingKey,
                &at,
                "`values` is missing",
                "add [vary.values] with a line for each free quantity",
            );
        };
        let listed = table(self.report, &values.node, "`values`")?;
        let mut leaves = Vec::new();
        flatten(listed, "", &mut leaves);
        if leaves.is_empty() {
            return self.report.refused(
                Code::MissingKey,
                &values.key_span,
                "`values` is empty",
                "add a line such as `offsets = { from = 0.1, to = 0.4 }`",
            );
        }
        // without a known kind of spreading, ranges are taken as written
        let counted =
            |e: &Entry| matches!(&e.node.value, Value::Table(keys) if find(keys, "count").is_some());
        let grid = by.map_or_else(|| leaves.iter().any(|(_, e)| counted(e)), |by| by == Spreading::Grid);
        let axes: Vec<Option<Vec<PlanAxis>>> =
            leaves.iter().map(|(path, entry)| self.axes(path, entry, grid)).collect();
        let axes = axes.into_iter().collect::<Option<Vec<_>>>();
        let (Some(by), Some(axes)) = (by, axes) else {
            let of_points = by.is_none_or(|by| matches!(by, Spreading::Points(_)));
            if let Some(entry) = find(entries, "count").filter(|_| of_points) {
                self.whole(entry, MOST);
            }
            return None;
        };
        let axes: Vec<PlanAxis> = axes.concat();
        let count = self.block_count(node, entries, by, &axes)?;
        if by == Spreading::Points(PointSpread::Sobol) && axes.len() > DIMENSIONS {
            let message = format!("{} quantities of one Sobol sequence", axes.len());
            return self.report.refused(
                Code::TooComplex,
                &node.span,
                message,
                format!("a block by sobol has at most {DIMENSIONS}: take latin_hypercube"),
            );
        }
        Some(PlanBlock { spreading: by, count, axes })
    }

    fn block_count(
        &mut self,
        node: &Node,
        entries: &[Entry],
        by: Spreading,
        axes: &[PlanAxis],
    ) -> Option<u64> {
        let at = node.span.start..node.span.start;
        let given = find(entries, "count");
        match by {
            Spreading::Points(spread) => {
                let Some(entry) = given else {
                    return self.report.refused(
                        Code::MissingKey,
                        &at,
                        "`count` is missing",
                        "add `count = N`, the number of points of this block",
                    );
                };
                let most = if spread == PointSpread::Sobol { 1 << 32 } else { MOST };
                self.whole(entry, most)
            }
            Spreading::Grid | Spreading::List => {
                if let Some(entry) = given {
                    return self.report.refused(
                        Code::ConflictingKeys,
                        &entry.key_span,
                        "`count` is for uniform, latin_hypercube and sobol",
                        "leave it out: the values say how many there are",
                    );
                }
                let lens: Vec<u64> = axes.iter().map(|a| a.values.len()).collect();
                if by == Spreading::Grid {
                    return self.product(&lens, &at);
                }
                if axes.iter().any(|a| matches!(a.values, AxisValues::Range { .. })) {
                    return self.report.refused(
                        Code::WrongType,
                        &at,
                        "a block by list has a range",
                        "write the values one by one, or take `by = \"grid\"`",
                    );
                }
                if lens.iter().any(|n| *n != lens[0]) {
                    let message = format!(
                        "the lists have {} elements",
                        lens.iter().map(u64::to_string).collect::<Vec<_>>().join(", ")
                    );
                    return self.report.refused(
                        Code::ConflictingKeys,
                        &at,
                        message,
                        "candidate j has element j of each list: give them the same length",
                    );
                }
                Some(lens[0])
            }
        }
    }

    pub(super) fn product(&mut self, numbers: &[u64], at: &Span) -> Option<u64> {
        let product =
            numbers.iter().try_fold(1u64, |p, n| p.checked_mul(*n).filter(|p| *p <= MOST_CANDIDATES));
        if product.is_none() {
            self.report.refuse(
                Code::TooComplex,
                at,
                format!("more than {MOST_CANDIDATES} candidates"),
                "take fewer values",
            );
        }
        product
    }
}

/// The values with their full names: a table without `from` and `to` holds further ones (`offsets.1 = ...` without
/// quotes).
fn flatten<'a>(entries: &'a [Entry], before: &str, out: &mut Vec<(String, &'a Entry)>) {
    for entry in entries {
        let path = if before.is_empty() { entry.key.clone() } else { format!("{before}.{}", entry.key) };
        match &entry.node.value {
            Value::Table(inner)
                if find(inner, "from").is_none() && find(inner, "to").is_none() && !inner.is_empty() =>
            {
                flatten(inner, &path, out);
            }
            _ => out.push((path, entry)),
        }
    }
}
