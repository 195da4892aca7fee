//! Failures and warnings for people, on standard error.
//!
//! Colours only on a terminal and without `NO_COLOR`: `anstream` strips them elsewhere.

use std::fmt::Write as _;
use std::io::Write as _;

use anstyle::{AnsiColor, Style};

use super::failure::Failure;
use files::design::{Violation, Warning};
use num::names::changes_direction;

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
const QUIET: Style = AnsiColor::Blue.on_default().bold();
const BOLD: Style = Style::new().bold();

/// A source line is cut after so many characters.
const MAX_SHOWN: usize = 160;

/// Shows a failure and all its violations.
pub(crate) fn print_failure(failure: &Failure) {
    print(&render_failure(failure));
}

/// Shows one warning.
pub(crate) fn print_warning(path: &str, text: &str, warning: &Warning) {
    print(&render_warning(path, text, warning));
}

/// Shows a line as it is.
pub(crate) fn print_note(text: &str) {
    print(&format!("{}\n", printable_lines(text)));
}

fn print(text: &str) {
    // standard error may be closed: there is nobody left to tell
    let _ = anstream::stderr().lock().write_all(text.as_bytes());
}

fn render_failure(failure: &Failure) -> String {
    let mut out = String::new();
    if let Some(design) = &failure.design {
        for violation in &design.violations {
            out.push_str(&render_violation(&design.path, &design.text, violation));
        }
    }
    let _ = writeln!(
        out,
        "{ERROR}error[{}]{ERROR:#}{BOLD}: {}{BOLD:#}",
        failure.code,
        printable(&failure.message)
    );
    if let Some(help) = &failure.help {
        let _ = writeln!(out, "  {QUIET}={QUIET:#} help: {}", printable(help));
    }
    out
}

fn render_violation(path: &str, text: &str, v: &Violation) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{ERROR}error[{}]{ERROR:#}{BOLD}: {}{BOLD:#}", v.code, printable(&v.message));
    excerpt(&mut out, path, text, v.line, Some((v.column, v.width)));
    let _ = writeln!(out, "  {QUIET}={QUIET:#} help: {}\n", printable(&v.help));
    out
}

fn render_warning(path: &str, text: &str, w: &Warning) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "{WARNING}warning[{}]{WARNING:#}{BOLD}: {}{BOLD:#}",
        w.code(),
        printable(&w.to_string())
    );
    excerpt(&mut out, path, text, w.line(), None);
    let _ = writeln!(out, "  {QUIET}={QUIET:#} help: {}", printable(&w.advice()));
    out
}

/// `--> file:line:column`, the line, and carets below the place.
fn excerpt(out: &mut String, path: &str, text: &str, line: usize, place: Option<(usize, usize)>) {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let column = place.map_or(String::new(), |(column, _)| format!(":{column}"));
    let path = printable(path);
    let _ = writeln!(out, "  {QUIET}-->{QUIET:#} {path}:{line}{column}");
    let Some(source) = text.lines().nth(line - 1).filter(|l| !l.trim().is_empty()) else { return };
    let number = line.to_string();
    let shown: String = source.chars().take(MAX_SHOWN).map(printable_char).collect();
    let gutter = " ".repeat(number.len());
    let _ = writeln!(out, "{QUIET}{gutter} |{QUIET:#}\n{QUIET}{number} |{QUIET:#} {shown}");
    if let Some((column, width)) = place.filter(|(column, _)| *column <= MAX_SHOWN) {
        let blank = " ".repeat(column - 1);
        let carets = "^".repeat(width.min(MAX_SHOWN + 1 - column));
        let _ = writeln!(out, "{QUIET}{gutter} |{QUIET:#} {blank}{ERROR}{carets}{ERROR:#}");
    }
}

/// Control characters replaced one for one, so that a file cannot steer the terminal and columns stay.
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

/// A text whose characters that could steer a terminal are spelled by `spell`; ends of lines and tabulators stay.
pub(crate) fn escaped(text: &str, spell: impl Fn(char) -> String) -> String {
    let plain = |c: char| !steers(c) || matches!(c, '\n' | '\r' | '\t');
    if text.chars().all(plain) {
        return text.to_string();
    }
    text.chars().map(|c| if plain(c) { c.to_string() } else { spell(c) }).collect()
}

/// An answer for people: names of files and joints in it cannot steer the terminal.
pub(crate) fn harmless(text: &str) -> String {
    escaped(text, |c| c.escape_unicode().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::design::parse;
    use files::design::Format;

    #[test]
    fn shows_the_line_with_a_caret_and_the_help() {
        let text = "name = \"x\"\n\tunit = \"mm\"\n";
        let violations = parse(text, Format::Toml).unwrap_err();
        let slip = violations.iter().find(|v| v.line == 2).unwrap();
        let shown = anstream::adapter::strip_str(&render_violation("a.toml", text, slip)).to_string();
        assert_eq!(shown, r#"error[design::unknown_key]: `unit` is not a key of a design
  --> a.toml:2:2
  |
2 |  unit = "mm"
  |  ^^^^
  = help: did you mean `units`?
"#);
    }

    #[test]
    fn control_characters_of_a_file_do_not_reach_the_terminal() {
        assert_eq!(printable("a\u{1b}[31mb\tc"), "a\u{fffd}[31mb c");
        assert_eq!(printable("a\u{202e}b"), "a\u{fffd}b");
        assert_eq!(harmless("a\u{202e}b\u{9b}c\td\n"), "a\\u{202e}b\\u{9b}c\td\n");
    }
}
