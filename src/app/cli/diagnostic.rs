//! Failures and warnings for people, on standard error.
//!
//! Colours only on a terminal and without `NO_COLOR`: `anstream` strips them elsewhere.

use std::fmt::Display;

use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};

use super::failure::Failure;
use super::streams::Errors;
use files::design::{Violation, Warning};
use num::names::changes_direction;

const RENDERER: Renderer = Renderer::styled();

/// Only this number of characters at the beginning of a line is used for excerpts, so that a long line with many faults
/// is cheap.
const MAX_READ: usize = 2000;

/// Shows a failure and all its violations.
pub(crate) fn print_failure(failure: &Failure) {
    print(&render_failure(failure));
}

/// Shows one warning.
pub(crate) fn print_warning(path: &str, text: &str, warning: &Warning) {
    print(&render_warning(path, text, warning));
}

/// Shows a line unchanged.
pub(crate) fn print_note(text: &str) {
    print(&format!("{}\n", printable_lines(text)));
}

fn print(text: &str) {
    Errors::of_run().write_styled(text);
}

/// The violations of a design, then the failure. A single violation is the failure itself.
fn render_failure(failure: &Failure) -> String {
    let mut out = String::new();
    if let Some(design) = &failure.design {
        for violation in &design.violations {
            out.push_str(&render_violation(&design.path, &design.text, violation));
            out.push('\n');
        }
        if design.violations.len() == 1 {
            return out.trim_end().to_owned() + "\n";
        }
    }
    out + &report(Level::ERROR, &failure.code, &failure.message, None, failure.help.as_deref())
}

fn render_violation(path: &str, text: &str, v: &Violation) -> String {
    let excerpt = excerpt(path, text, v.line, Some((v.column, v.width)));
    report(Level::ERROR, v.code, &v.message, Some(excerpt), Some(&v.help))
}

fn render_warning(path: &str, text: &str, w: &Warning) -> String {
    let excerpt = excerpt(path, text, w.line(), None);
    report(Level::WARNING, w.code(), &w.to_string(), Some(excerpt), Some(&w.advice()))
}

fn report(
    level: Level<'_>,
    code: impl Display,
    message: &str,
    excerpt: Option<Snippet<'_, Annotation<'_>>>,
    help: Option<&str>,
) -> String {
    let help = help.map(|text| Level::HELP.message(printable(text)));
    let title = level.primary_title(printable(message)).id(code.to_string());
    RENDERER.render(&[Group::with_title(title).elements(excerpt).elements(help)]) + "\n"
}

/// `--> file:line:column`, the line, and carets below the place: its column and width in characters.
fn excerpt<'a>(
    path: &str,
    text: &str,
    line: usize,
    place: Option<(usize, usize)>,
) -> Snippet<'a, Annotation<'a>> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let source = text.lines().nth(line - 1).unwrap_or_default();
    let source: String = source.chars().take(MAX_READ).map(printable_char).collect();
    let path = printable(path);
    let byte = |column: usize| source.char_indices().nth(column - 1).map_or(source.len(), |(at, _)| at);
    let (path, mark) = match place {
        Some((column, width)) if column <= MAX_READ => {
            (path, AnnotationKind::Primary.span(byte(column)..byte(column + width)))
        }
        // a line without carets is shown without its place
        Some((column, _)) => (format!("{path}:{line}:{column}"), AnnotationKind::Visible.span(0..0)),
        None => (format!("{path}:{line}"), AnnotationKind::Visible.span(0..0)),
    };
    Snippet::source(source).line_start(line).path(path).annotation(mark)
}

/// Replaces control characters one for one, so that a file cannot control the terminal and columns stay.
fn printable(text: &str) -> String {
    text.chars().map(printable_char).collect()
}

fn printable_lines(text: &str) -> String {
    text.lines().map(printable).collect::<Vec<_>>().join("\n")
}

fn printable_char(c: char) -> char {
    match c {
        '\t' => ' ',
        c if steers(c) => '\u{fffd}',
        c => c,
    }
}

/// Whether a character moves the cursor of a terminal, or changes the direction of the text after it.
fn steers(c: char) -> bool {
    c.is_control() || changes_direction(c) || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}')
}

/// A text with terminal control characters replaced by `spell`; line ends and tabulators stay.
pub(crate) fn escaped(text: &str, spell: impl Fn(char) -> String) -> String {
    let plain = |c: char| !steers(c) || matches!(c, '\n' | '\r' | '\t');
    if text.chars().all(plain) {
        return text.to_string();
    }
    text.chars().map(|c| if plain(c) { c.to_string() } else { spell(c) }).collect()
}

/// An answer for people: names of files and joints in it cannot control the terminal.
pub(crate) fn harmless(text: &str) -> String {
    escaped(text, |c| c.escape_unicode().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use ask::design::parse;
    use files::design::Format;

    #[test]
    fn shows_the_line_with_a_caret_and_the_help() {
        let text = "name = \"x\"\n\tunit = \"mm\"\n";
        let violations = parse(text, Format::Toml).unwrap_err();
        let slip = violations.iter().find(|v| v.line == 2).unwrap();
        let shown = anstream::adapter::strip_str(&render_violation("a.toml", text, slip)).to_string();
        assert_eq!(
            shown,
            r#"error[design::unknown_key]: `unit` is not a key of a design
 --> a.toml:2:2
  |
2 |  unit = "mm"
  |  ^^^^
  |
  = help: did you mean `units`?
"#
        );
    }

    fn plain(text: &str, line: usize, place: Option<(usize, usize)>) -> String {
        let shown = report(Level::ERROR, "a::b", "c", Some(excerpt("a.toml", text, line, place)), None);
        anstream::adapter::strip_str(&shown).to_string()
    }

    #[test]
    fn carets_stand_below_what_follows_wide_characters() {
        assert_eq!(
            plain("name = \"六足\", unit = 5", 1, Some((14, 4))),
            r#"error[a::b]: c
 --> a.toml:1:14
  |
1 | name = "六足", unit = 5
  |                ^^^^
"#
        );
    }

    #[test]
    fn a_long_line_is_shown_about_its_place() {
        let long = format!("{}unit = 5{}", "x = 1, ".repeat(100), ", y = 2".repeat(9999));
        let shown = plain(&long, 1, Some((701, 4)));
        assert!(
            shown.contains("--> a.toml:1:701\n") && shown.contains("unit = 5") && shown.contains("^^^^"),
            "{shown}"
        );
        for (line, place, head) in
            [(1, Some((5000, 4)), "1:5000\n"), (1, None, "1\n"), (3, None, "3\n"), (3, Some((1, 1)), "3:1\n")]
        {
            let shown = plain(&format!("{long}\n\n"), line, place);
            assert!(shown.contains(&format!("--> a.toml:{head}")), "{shown}");
            assert!(shown.len() < 500, "{shown}");
        }
    }

    #[test]
    fn control_characters_of_a_file_do_not_reach_the_terminal() {
        assert_eq!(printable("a\u{1b}[31mb\tc"), "a\u{fffd}[31mb c");
        assert_eq!(printable("a\u{202e}b"), "a\u{fffd}b");
        assert_eq!(harmless("a\u{202e}b\u{9b}c\td\n"), "a\\u{202e}b\\u{9b}c\td\n");
    }
}
