//! Collecting violations with their line and column.

use super::tree::Span;
use super::{Code, Violation, Warning};

/// After this many violations the rest is only counted.
const MAX_VIOLATIONS: usize = 100;

/// Violations and warnings found so far in one text.
#[derive(Debug)]
pub(super) struct Report<'t> {
    text: &'t str,
    line_starts: Vec<usize>,
    violations: Vec<Violation>,
    warnings: Vec<Warning>,
    unlisted: usize,
}

impl<'t> Report<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        let starts = text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(i, _)| i + 1);
        let line_starts = std::iter::once(0).chain(starts).collect();
        Self { text, line_starts, violations: Vec::new(), warnings: Vec::new(), unlisted: 0 }
    }

    /// Line of a byte offset, 1-based.
    pub(super) fn line(&self, offset: usize) -> usize {
        self.line_starts.partition_point(|&start| start <= offset).max(1)
    }

    /// Text of a line, 1-based, with its end of line.
    pub(super) fn line_text(&self, line: usize) -> &'t str {
        let start = self.line_starts.get(line - 1).copied().unwrap_or(self.text.len());
        let end = self.line_starts.get(line).copied().unwrap_or(self.text.len());
        &self.text[start..end]
    }

    pub(super) fn refuse(
        &mut self,
        code: Code,
        span: &Span,
        message: impl Into<String>,
        help: impl Into<String>,
    ) {
        if self.violations.len() >= MAX_VIOLATIONS {
            self.unlisted += 1;
            return;
        }
        let (line, column, width) = self.locate(span);
        let (message, help) = (message.into(), help.into());
        self.violations.push(Violation { code, line, column, width, message, help });
    }

    pub(super) fn warn(&mut self, warning: Warning) {
        if self.warnings.len() < MAX_VIOLATIONS {
            self.warnings.push(warning);
        }
    }

    pub(super) fn is_clean(&self) -> bool {
        self.violations.is_empty()
    }

    /// The violations in the order of the text, closed by a count of those not listed.
    pub(super) fn into_violations(mut self) -> Vec<Violation> {
        self.violations.sort_by_key(|v| (v.line, v.column));
        if self.unlisted > 0 {
            self.violations.push(Violation {
                code: Code::TooMany,
                line: self.line_starts.len(),
                column: 1,
                width: 1,
                message: format!("{} more violations are not listed", self.unlisted),
                help: "mend the listed ones first".into(),
            });
        }
        self.violations
    }

    pub(super) fn into_warnings(mut self) -> Vec<Warning> {
        self.warnings.sort_by_key(Warning::line);
        self.warnings
    }

    /// Line, column and width on that line, all in characters.
    fn locate(&self, span: &Span) -> (usize, usize, usize) {
        let line = self.line(span.start.min(self.text.len()));
        let start = self.line_starts[line - 1];
        let end = self.line_starts.get(line).map_or(self.text.len(), |next| next - 1);
        let chars = |from: usize, to: usize| self.text.get(from..to).map_or(0, |s| s.chars().count());
        let column = chars(start, span.start.min(self.text.len())) + 1;
        let width = chars(span.start.min(end), span.end.min(end)).max(1);
        (line, column, width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_counted_in_characters() {
        let text = "a\n\u{e9}\u{e9} = x\r\n";
        let mut report = Report::new(text);
        let at = text.find('x').unwrap();
        report.refuse(Code::Syntax, &(at..at + 1), "m", "h");
        report.refuse(Code::Syntax, &(text.len()..text.len()), "m", "h");
        let found: Vec<_> = report.into_violations().iter().map(|v| (v.line, v.column, v.width)).collect();
        assert_eq!(found, [(2, 6, 1), (3, 1, 1)]);
    }

    #[test]
    fn endless_violations_end_in_a_count() {
        let mut report = Report::new("x");
        for _ in 0..250 {
            report.refuse(Code::UnknownKey, &(0..1), "m", "h");
        }
        let violations = report.into_violations();
        assert_eq!(violations.len(), 101);
        assert_eq!(violations[100].code, Code::TooMany);
        assert!(violations[100].message.starts_with("150 more"));
    }
}
