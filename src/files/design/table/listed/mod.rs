//! Lists of values in source code: Python and numpy, C initialisers, MATLAB matrices, JSON and YAML.
//!
//! The text is read as assignments of values to names. A value is a number, a text or a nested list in brackets of any
//! kind. The row of a MATLAB matrix ends at a semicolon or, without commas, at the end of a line. An item of a YAML
//! list begins with a dash. Other text is left to the reader of tables.

mod reader;
mod records;
mod tokens;

use self::reader::Reader;
pub(super) use self::records::{Formula, Record, is_abbreviated, member, records, table_of};
pub(super) use self::tokens::is_computed;
use self::tokens::{Token, tokens};
use super::header::{UNITS, plain, units_in_title};
use platform::geom::AngleUnit;

/// Members of an object that hold the coordinates of a point.
const PLACE_WORDS: [&str; 9] =
    ["at", "position", "pos", "xyz", "coordinates", "coords", "point", "location", "centre"];

/// A value assigned to a name.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ListValue {
    Number(f64),
    Text(String),
    List(Vec<ListValue>),
    /// An object or a mapping.
    Named(Vec<(String, ListValue)>),
}

/// The values that a text assigns to names.
pub(super) struct NamedValues {
    /// In the order of the text; names in an object have the object's name before them.
    pub(super) values: Vec<(String, ListValue)>,
    /// Names of values that formulas compute.
    pub(super) computed: Vec<String>,
}

/// The values of a text; factors of lists are guesses. `None` if a list in brackets holds a formula.
pub(super) fn named_values(text: &str, guesses: &mut Vec<String>) -> Option<NamedValues> {
    let (tokens, places) = tokens(text);
    let mut reader = Reader { tokens: &tokens, places: &places, at: 0, factor: None, depth: 0 };
    let (mut out, mut computed) = (Vec::new(), Vec::new());
    reader.skip_lines();
    if reader.peek() == Some(&Token::Open('{')) {
        reader.at += 1;
        if let ListValue::Named(named) = reader.list('{')? {
            out.extend(named);
        }
    }
    while let Some(token) = reader.next().cloned() {
        let (Token::Word(name) | Token::Text(name)) = token else { continue };
        let begin = reader.at;
        // the dimensions of an array of C
        while let Some([Token::Open('['), Token::Number(_) | Token::Word(_), Token::Close(']')]) =
            reader.tokens.get(reader.at..reader.at + 3)
        {
            reader.at += 3;
        }
        if reader.peek() == Some(&Token::Open('['))
            && reader.tokens.get(reader.at + 1) == Some(&Token::Close(']'))
        {
            reader.at += 2;
        }
        if reader.peek() != Some(&Token::Is) {
            reader.at = begin;
            continue;
        }
        // `:=` is one sign
        while reader.peek() == Some(&Token::Is) {
            reader.at += 1;
        }
        let after = reader.at;
        match (reader.value(), reader.tokens.get(after)) {
            (Some(value), _) => {
                let factor = reader.factor.take();
                guesses.extend(factor.map(|factor| format!("`{name}` is {factor}.")));
                out.push((name, value));
            }
            (None, Some(Token::Open(_))) => return None,
            // a mapping of YAML: its keys are read separately
            (None, Some(Token::LineEnd)) => reader.at = after,
            (None, _) => {
                computed.push(name);
                reader.at = after;
            }
        }
    }
    Some(NamedValues { values: flat(out, ""), computed })
}

/// Nested objects as one list, with all names on the way to a value.
fn flat(values: Vec<(String, ListValue)>, before: &str) -> Vec<(String, ListValue)> {
    let path = |name: &str| if before.is_empty() { name.to_owned() } else { format!("{before}_{name}") };
    values
        .into_iter()
        .flat_map(|(name, value)| match value {
            // a point is one value
            ListValue::Named(inner) if ListValue::Named(inner.clone()).numbers().is_none() => {
                flat(inner, &path(&name))
            }
            value => vec![(path(&name), value)],
        })
        .collect()
}

/// The units that a text states in a value `units` or in a comment, and the guess about that of lengths.
pub(super) fn stated_units(
    values: &[(String, ListValue)],
    text: &str,
) -> (Option<&'static str>, Option<AngleUnit>, Option<String>) {
    let comments = text.lines().filter_map(|line| {
        // a line of a block of C begins with an asterisk
        let in_block = || line.trim_start().starts_with("* ").then_some(0);
        let at = line
            .find(['#', '%'])
            .or_else(|| line.find("//"))
            .or_else(|| line.find("/*"))
            .or_else(in_block)?;
        Some(units_in_title(&line[at..]))
    });
    let of_comments =
        comments.fold((None, None), |(length, angle), found| (length.or(found.0), angle.or(found.1)));
    let of_value = values.iter().find_map(|(name, value)| {
        let word = plain(name);
        let ListValue::Text(said) = value else { return None };
        let label = UNITS.iter().find(|(spelling, _)| *spelling == said.to_lowercase())?.1;
        (word.starts_with("unit") || word.ends_with("units")).then_some((label, name))
    });
    match (of_value, of_comments.0) {
        (Some((label, name)), _) => {
            let guess = format!("The lengths are in {label}, as `{name}` says.");
            (Some(label), of_comments.1, Some(guess))
        }
        (None, Some(label)) => {
            let guess = format!("The lengths are in {label}, as a comment says.");
            (Some(label), of_comments.1, Some(guess))
        }
        (None, None) => (None, of_comments.1, None),
    }
}

impl ListValue {
    pub(super) fn number(&self) -> Option<f64> {
        if let Self::Number(x) = self { Some(*x) } else { None }
    }

    /// A list of numbers; an object with `x`, `y` and perhaps `z`, or a column, counts as one.
    pub(super) fn numbers(&self) -> Option<Vec<f64>> {
        match self {
            Self::List(list) => {
                let alone = |x: &Self| match x {
                    Self::List(one) if one.len() == 1 => one[0].number(),
                    other => other.number(),
                };
                list.iter().map(alone).collect()
            }
            Self::Named(named) => {
                let of = |axis: &str| {
                    named.iter().find(|(name, _)| plain(name) == axis).and_then(|(_, x)| x.number())
                };
                let z = of("z");
                Some([of("x")?, of("y")?].into_iter().chain(z).collect())
            }
            _ => None,
        }
    }

    /// The coordinates of a point, or of an object that has them in one of its members.
    pub(super) fn place(&self) -> Option<Vec<f64>> {
        let member = |named: &Vec<(String, Self)>| {
            named.iter().find(|(name, _)| PLACE_WORDS.contains(&plain(name).as_str()))?.1.numbers()
        };
        self.numbers().or_else(|| if let Self::Named(named) = self { member(named) } else { None })
    }

    /// The text of a member of an object, by the words for it.
    pub(super) fn text_of(&self, words: &[&str]) -> Option<&str> {
        let Self::Named(named) = self else { return None };
        named.iter().find_map(|(name, value)| match value {
            Self::Text(text) if words.contains(&plain(name).as_str()) => Some(text.as_str()),
            _ => None,
        })
    }

    /// The value with every number replaced.
    fn map(self, of: &dyn Fn(f64) -> f64) -> Option<Self> {
        match self {
            Self::Number(x) => Some(Self::Number(of(x))),
            Self::List(list) => Some(Self::List(list.into_iter().map(|x| x.map(of)).collect::<Option<_>>()?)),
            Self::Text(_) | Self::Named(_) => None,
        }
    }

    /// The points of an end of a leg or of both, with their names.
    pub(super) fn points(&self) -> Vec<(&str, Vec<f64>)> {
        let point = |value: &Self| value.numbers().filter(|list| (2..=3).contains(&list.len()));
        match self {
            Self::Named(named) => {
                named.iter().filter_map(|(name, value)| Some((name.as_str(), point(value)?))).collect()
            }
            Self::List(list) => list.iter().filter_map(|value| Some(("", point(value)?))).collect(),
            _ => Vec::new(),
        }
    }

    /// Rows of numbers of equal length.
    pub(super) fn rows(&self) -> Option<Vec<Vec<f64>>> {
        let Self::List(list) = self else { return None };
        let rows: Vec<Vec<f64>> = list.iter().map(Self::place).collect::<Option<_>>()?;
        let width = rows.first()?.len();
        (width > 1 && rows.iter().all(|row| row.len() == width)).then_some(rows)
    }
}
