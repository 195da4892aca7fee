//! Markdown, for the README of a folder of results.

use super::{Block, Sheet, Table};

impl Sheet {
    /// Paragraphs, lists of what belongs to the line above, and tables.
    #[must_use]
    pub fn markdown(&self) -> String {
        let mut parts: Vec<String> = Vec::new();
        let mut listed = false;
        for block in &self.0 {
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
                Block::Part { title, sheet, .. } => format!("**{}**\n\n{}", escaped(title), sheet.markdown()),
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

/// Text that cannot become markup.
#[must_use]
pub fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '#' | '|' => out.extend(['\\', c]),
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}
