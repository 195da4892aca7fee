//! The bill of materials as a table of the page.

use maud::{Markup, html};

use sheet::{Sheet, Table, answers::words, left};

/// The beginning of the line of titles of a bill of materials.
const TITLES: &str = "part,count,";

/// The table of a bill of materials as written by `export` (`parts.csv`), without empty columns; `None` for another
/// text. `link` leads to its file.
pub(super) fn section(link: &Markup, text: &str) -> Option<Markup> {
    let mut lines = text.lines().filter(|line| !line.starts_with('#') && !line.is_empty());
    let titles = cells(lines.next().filter(|line| line.starts_with(TITLES))?);
    let rows: Vec<Vec<String>> = lines.map(cells).filter(|row| row.len() == titles.len()).collect();
    let told: Vec<usize> = (0..titles.len()).filter(|k| rows.iter().any(|row| !row[*k].is_empty())).collect();
    let table = Table::new(told.iter().map(|k| left(words(&titles[*k]), 0)));
    let table = table.with_rows(rows.iter().map(|row| told.iter().map(|k| row[*k].as_str())));
    Some(html! { (Sheet::from(table).html()) p.note { "From " (link) } })
}

/// The cells of a line; quotation marks keep commas together, and two of them in a quoted cell are one.
fn cells(line: &str) -> Vec<String> {
    let (mut out, mut quoted) = (vec![String::new()], false);
    let mut letters = line.chars().peekable();
    while let Some(c) = letters.next() {
        let last = out.len() - 1;
        match c {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                out[last].push('"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => out.push(String::new()),
            c => out[last].push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bill_of_materials_is_a_table_without_empty_columns() {
        let text = "# design\npart,count,mass_each_kg,remark\nbase plate,1,,6 holes\n\"leg, kind 1\",2,,\"<b>, \"\"x\"\"\"\n";
        let table = section(&html! { "link" }, text).unwrap().into_string();
        assert!(
            table.contains("<th scope=\"row\">leg, kind 1</th><td>2</td><td>&lt;b&gt;, &quot;x&quot;</td>"),
            "{table}"
        );
        assert!(!table.contains("mass") && table.contains("<th scope=\"col\">remark</th>"));
        assert!(section(&html! {}, "x,y,z\n1,2,3\n").is_none());
    }
}
