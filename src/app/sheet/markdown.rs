//! Markdown, for the README of a folder of results.

use super::{Block, DIGITS, Sheet, Table};

impl Sheet {
    /// The sheet as Markdown: paragraphs, lists of indented lines, and tables.
    #[must_use]
    pub fn markdown(&self) -> String {
        self.markdown_with(DIGITS.into())
    }

    /// The same with numbers of so many significant digits.
    #[must_use]
    pub fn markdown_with(&self, digits: usize) -> String {
        let mut parts: Vec<String> = Vec::new();
        let mut listed = false;
        for block in &self.rounded(digits).0 {
            let part = match block {
                Block::Space => continue,
                Block::Line(line) => match line.strip_prefix("  ") {
                    Some(item) => {
                        let item = format!("- {}", escaped(item.trim()));
                        match parts.last_mut().filter(|_| listed) {
                            Some(list) => *list = format!("{list}\n{item}"),
                            None => parts.push(item),
                        }
                        listed = true;
                        continue;
                    }
                    None => escaped(line),
                },
                Block::Table(table) => rows(table),
                Block::Part { title, sheet, .. } => {
                    format!("**{}**\n\n{}", escaped(title), sheet.markdown_with(digits))
                }
            };
            listed = false;
            parts.push(part.trim_end().to_owned());
        }
        parts.join("\n\n") + "\n"
    }
}

fn rows(table: &Table) -> String {
    let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = |right: bool| if right { "--:|" } else { "---|" };
    let titles = row(table.columns.iter().map(|column| escaped(&column.title)).collect());
    let rules: String = table.columns.iter().map(|column| rule(column.right)).collect();
    let rows =
        table.rows.iter().map(|cells| row(table.cells(cells).map(|(_, cell)| escaped(&cell.text)).collect()));
    format!("{titles}|{rules}\n{}", rows.collect::<String>())
}

/// Text escaped against markup: `>` and `#` matter only at the beginning of a line, and `_` never inside a word.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut chars = text.chars().peekable();
    let mut before = None;
    while let Some(c) = chars.next() {
        let in_word = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
        match c {
            '_' if in_word(before) && in_word(chars.peek().copied()) => out.push(c),
            '>' | '#' if before.is_some() => out.push(c),
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
        before = Some(c);
    }
    out
}
