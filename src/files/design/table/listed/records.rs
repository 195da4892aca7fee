//! Records of a list: objects, or the numbers of a row, with the lines where they begin.

use super::reader::{DEEPEST, Reader, closing};
use super::tokens::{Token, computes, tokens};
use super::{ListValue, NamedValues, named_values};
use crate::design::table::header::CellUnit;
use crate::design::table::sheet::SheetRow;

/// A record of a list.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::design::table) struct Record {
    /// The line where it begins, from 1.
    pub(in crate::design::table) line: usize,
    /// An object, or a list of numbers.
    pub(in crate::design::table) value: ListValue,
}

/// Fewest numbers of a record that is a pose.
const POSE: usize = 6;
/// Numbers of a row of a matrix with a position, and fewest such rows.
const MATRIX_ROW: (usize, usize) = (4, 3);

/// A formula whose value is not computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::design::table) struct Formula;

/// The records in the lists of a text: objects that `is_known` accepts, else rows of six numbers or more, else rows of
/// four numbers. The outermost lists count; a matrix in a list is one record.
///
/// # Errors
/// A list in a formula, such as one with a factor.
pub(in crate::design::table) fn records(
    text: &str,
    is_known: &dyn Fn(&ListValue) -> bool,
) -> Result<Option<Vec<Record>>, Formula> {
    // assignments, or a mapping without brackets; names that come again are those of several objects
    let is_one = |named: &NamedValues| {
        let mut names: Vec<&String> = named.values.iter().map(|(name, _)| name).collect();
        names.sort_unstable();
        names.windows(2).all(|pair| pair[0] != pair[1])
    };
    if let Some(named) = named_values(text, &mut Vec::new()).filter(is_one) {
        let value = ListValue::Named(named.values);
        if is_known(&value) {
            return Ok(Some(vec![Record { line: 1, value }]));
        }
    }
    let (tokens, places) = tokens(text);
    let mut reader = Reader { tokens: &tokens, places: &places, at: 0, factor: None, depth: 0 };
    let mut found: Vec<Vec<Record>> = Vec::new();
    let count = |record: &Record| if let ListValue::List(list) = &record.value { list.len() } else { 0 };
    let heights = heights(&tokens);
    while let Some(token) = reader.peek().cloned() {
        let begin = reader.at;
        if matches!(token, Token::Open(_)) && !(1..=DEEPEST).contains(&heights[begin]) {
            reader.at += 1;
            continue;
        }
        let line = places[begin].0;
        let list = match token {
            Token::Open(open) => {
                reader.at += 1;
                // `array(` is no list of its own
                reader.lined_elements(open).filter(|list| open != '(' || list.len() != 1)
            }
            Token::Item => reader.lined_items(),
            _ => None,
        };
        let list = list.and_then(|list| {
            let record = |(line, value): (usize, ListValue)| {
                let value = if is_known(&value) { value } else { value.flattened()? };
                Some(Record { line, value })
            };
            list.into_iter().map(record).collect::<Option<Vec<_>>>().filter(|list| !list.is_empty())
        });
        if let Some(list) = list {
            let is_formula = |at: Option<usize>| {
                at.and_then(|at| tokens.get(at))
                    .is_some_and(|token| matches!(token, Token::Times | Token::Over))
            };
            if list.iter().any(|record| count(record) >= MATRIX_ROW.0)
                && (is_formula(begin.checked_sub(1)) || is_formula(Some(reader.at)))
            {
                return Err(Formula);
            }
            found.push(list);
            continue;
        }
        if let (Token::Word(name), Some(Token::Open(_))) = (&token, tokens.get(begin + 1))
            && computes(name)
        {
            return Err(Formula);
        }
        reader.at = begin + 1;
        if token == Token::Open('{') {
            match reader.list('{').filter(is_known) {
                Some(value) => found.push(vec![Record { line, value }]),
                None => reader.at = begin + 1,
            }
        }
    }
    // a short row among others is a fault of the table, and not another list
    let most = |list: &Vec<Record>| list.iter().map(count).max().unwrap_or(0);
    let kept = |keeps: &dyn Fn(usize) -> bool| -> Vec<Record> {
        found.iter().filter(|list| keeps(most(list))).flatten().cloned().collect()
    };
    let rows = kept(&|n| n == MATRIX_ROW.0);
    let kinds =
        [kept(&|n| n == 0), kept(&|n| n >= POSE), if rows.len() < MATRIX_ROW.1 { Vec::new() } else { rows }];
    Ok(kinds.into_iter().find(|list| !list.is_empty()))
}

/// For each opening bracket the depth of brackets in it, from 1; 0 for other tokens and for brackets without an end.
fn heights(tokens: &[Token]) -> Vec<usize> {
    let mut out = vec![0; tokens.len()];
    let mut around: Vec<(usize, char, usize)> = Vec::new();
    for (at, token) in tokens.iter().enumerate() {
        match token {
            Token::Open(open) => around.push((at, *open, 0)),
            Token::Close(close) => match around.pop() {
                Some((begin, open, inner)) if closing(open) == *close => {
                    out[begin] = inner + 1;
                    if let Some((.., height)) = around.last_mut() {
                        *height = inner.saturating_add(1).max(*height);
                    }
                }
                _ => around.clear(),
            },
            _ => {}
        }
    }
    out
}

/// Whether a printed array leaves out rows or numbers, which it shows as `...`.
pub(in crate::design::table) fn is_abbreviated(text: &str) -> bool {
    text.lines().any(|line| {
        let Some((before, behind)) = line.split_once("...") else { return false };
        let ends = |c: char| c.is_whitespace() || ",[]".contains(c);
        let behind = behind.trim_matches(ends);
        let alone = before.trim_matches(ends).is_empty() && behind.is_empty();
        alone || behind.starts_with(|c: char| c.is_ascii_digit() || c == '-')
    })
}

/// A row of a table from a record: its line, and its cells with the names of their columns.
pub(in crate::design::table) type NamedCells = (usize, Vec<(String, String)>);

/// The table of rows whose cells have names; absent cells are empty.
pub(in crate::design::table) fn table_of(rows: Vec<NamedCells>) -> (Vec<String>, Vec<SheetRow>) {
    let mut header: Vec<String> = Vec::new();
    for (name, _) in rows.iter().flat_map(|(_, cells)| cells) {
        if !header.contains(name) {
            header.push(name.clone());
        }
    }
    let row = |(line, cells): NamedCells| {
        let cell = |name: &String| cells.iter().find(|(own, _)| own == name).map(|(_, cell)| cell.clone());
        SheetRow { line, cells: header.iter().map(|name| cell(name).unwrap_or_default()).collect() }
    };
    let rows = rows.into_iter().map(row).collect();
    (header, rows)
}

/// The name of a coordinate of a list, before the unit in the name of the list.
pub(in crate::design::table) fn member(name: &str, axis: &str) -> String {
    match name.rsplit_once('_') {
        Some((head, unit)) if CellUnit::of(unit).is_some() => format!("{head}_{axis}_{unit}"),
        _ => format!("{name}_{axis}"),
    }
}

impl ListValue {
    /// Calls `visit` with numbers, texts and lists in an object, and the names on the way to them.
    pub(in crate::design::table) fn leaves(&self, name: &str, visit: &mut dyn FnMut(&str, &Self)) {
        let Self::Named(members) = self else { return visit(name, self) };
        for (member, inner) in members {
            let path = if name.is_empty() { member.clone() } else { format!("{name}_{member}") };
            inner.leaves(&path, visit);
        }
    }

    /// All numbers of nested lists in their order; `None` with a text or an object among them.
    fn flattened(&self) -> Option<Self> {
        fn numbers(value: &ListValue, out: &mut Vec<ListValue>) -> Option<()> {
            match value {
                ListValue::Number(_) => out.push(value.clone()),
                ListValue::List(list) => list.iter().try_for_each(|inner| numbers(inner, out))?,
                ListValue::Text(_) | ListValue::Named(_) => return None,
            }
            Some(())
        }
        let mut out = Vec::new();
        numbers(self, &mut out)?;
        (matches!(self, Self::List(_)) && !out.is_empty()).then_some(Self::List(out))
    }
}
