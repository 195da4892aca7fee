//! Lists of points in source code: Python and numpy, C initialisers, MATLAB matrices, JSON and YAML.
//!
//! The text is read as assignments of values to names. A value is a number, a text or a nested list in brackets of any
//! kind. The row of a MATLAB matrix ends at a semicolon or, without commas, at the end of a line. An item of a YAML
//! list begins with a dash. Other text is left to the reader of tables.

use nalgebra::Point3;

use super::{
    FIRST_WITH_FIRST, InvalidPointTable, LEG_WORDS, PointTable, ROW_WORDS, bodies_of_words, body_of_word,
    only_number, told_apart,
};
use crate::design::table::header::{UNITS, plain, units_in_title};
use platform::geom::{Angles, Pose};
use platform::manipulator::{Body, Leg};

/// A value assigned to a name.
#[derive(Debug, Clone, PartialEq)]
enum ListValue {
    Number(f64),
    Text(String),
    List(Vec<ListValue>),
    /// An object or a mapping.
    Named(Vec<(String, ListValue)>),
}

#[derive(Debug, Clone, PartialEq)]
enum Token {
    Word(String),
    Text(String),
    Number(f64),
    Open(char),
    Close(char),
    /// `=` or `:`.
    Is,
    Comma,
    Semicolon,
    /// A factor of a list.
    Times,
    LineEnd,
    /// The dash before an item of a YAML list.
    Item,
}

/// The tokens of a text without its comments, and the column of each; `None` if it contains anything that lists of
/// numbers cannot have.
fn tokens(text: &str) -> Option<(Vec<Token>, Vec<usize>)> {
    let mut out = Vec::new();
    let mut columns = Vec::new();
    let mut in_comment = false;
    for line in text.lines() {
        let mut rest = line;
        if in_comment {
            let Some((_, after)) = rest.split_once("*/") else { continue };
            (rest, in_comment) = (after, false);
        }
        if let Some(definition) = rest.trim_start().strip_prefix("#define") {
            let mut words = definition.split_whitespace();
            if let (Some(name), Some(number)) = (words.next(), words.next().and_then(|w| w.parse().ok())) {
                out.extend([Token::Word(name.into()), Token::Is, Token::Number(number), Token::LineEnd]);
                columns.resize(out.len(), 0);
            }
            continue;
        }
        if ["import ", "from ", "#include", "---"].iter().any(|w| rest.trim_start().starts_with(w)) {
            continue;
        }
        let mut at_start = true;
        let mut continued = false;
        while let Some(c) = rest.chars().next() {
            let mut skip = c.len_utf8();
            columns.resize(out.len(), line.len() - rest.len());
            match c {
                _ if c.is_whitespace() => {}
                '.' if rest.starts_with("...") => {
                    // the statement goes on in the next line
                    continued = true;
                    break;
                }
                // a transposed matrix is known by its shape
                '\'' if matches!(out.last(), Some(Token::Close(_))) => {}
                '.' if rest.starts_with(".T") && matches!(out.last(), Some(Token::Close(_))) => skip = 2,
                '*' => out.push(Token::Times),
                '#' | '%' => break,
                '/' if rest.starts_with("//") => break,
                '/' if rest.starts_with("/*") => {
                    let Some((before, _)) = rest.split_once("*/") else {
                        in_comment = true;
                        break;
                    };
                    skip = before.len() + 2;
                }
                '-' if at_start && rest[1..].starts_with(' ') => {
                    out.push(Token::Item);
                    columns.resize(out.len(), line.len() - rest.len());
                    rest = &rest[skip..];
                    continue;
                }
                '[' | '(' | '{' => out.push(Token::Open(c)),
                ']' | ')' | '}' => out.push(Token::Close(c)),
                '=' | ':' => out.push(Token::Is),
                ',' => out.push(Token::Comma),
                ';' => out.push(Token::Semicolon),
                '"' | '\'' => {
                    let end = rest[1..].find(c)?;
                    out.push(Token::Text(rest[1..=end].into()));
                    skip = end + 2;
                }
                _ if c.is_ascii_digit() || "+-.".contains(c) => {
                    let (number, length) = number(rest)?;
                    out.push(Token::Number(number));
                    skip = length;
                }
                _ if c.is_alphabetic() || c == '_' => {
                    skip = rest
                        .find(|c: char| !(c.is_alphanumeric() || "_.-".contains(c)))
                        .unwrap_or(rest.len());
                    out.push(Token::Word(rest[..skip].trim_end_matches(['.', '-']).into()));
                }
                // arithmetic, or no list at all
                _ => return None,
            }
            columns.resize(out.len(), line.len() - rest.len());
            at_start &= c.is_whitespace();
            rest = &rest[skip..];
        }
        if !continued {
            out.push(Token::LineEnd);
        }
        columns.resize(out.len(), line.len());
    }
    Some((out, columns))
}

/// Functions that compute numbers, which are not evaluated.
const FUNCTIONS: [&str; 11] =
    ["sin", "cos", "tan", "sqrt", "radians", "degrees", "deg2rad", "rad2deg", "linspace", "arange", "range"];

/// Whether a word calls one of [`FUNCTIONS`].
fn computes(word: &str) -> bool {
    word.rsplit('.').next().is_some_and(|name| FUNCTIONS.contains(&name.to_lowercase().as_str()))
}

/// Whether a text computes its numbers: it is a program, and is not run.
pub(super) fn is_computed(text: &str) -> bool {
    let statements = text.lines().map(|line| line.split(['#', '%']).next().unwrap_or_default());
    statements.filter(|line| line.contains('=')).any(|line| {
        let (_, value) = line.split_once('=').unwrap_or_default();
        let called = |word: &str| value.contains(&format!("{word}("));
        let in_list = value.contains(['[', '(', '{']) && (value.contains(" for ") || value.contains('*'));
        FUNCTIONS.iter().any(|word| called(word)) || in_list
    })
}

/// The number at the beginning of a text, and its length; the next character must end it.
fn number(text: &str) -> Option<(f64, usize)> {
    let mut length = 0;
    let mut last = ' ';
    for c in text.chars() {
        let signed = "+-".contains(c) && (length == 0 || "eE".contains(last));
        if !(c.is_ascii_digit() || ".eE".contains(c) || signed) {
            break;
        }
        length += c.len_utf8();
        last = c;
    }
    let value = text[..length].parse().ok().filter(|x: &f64| x.is_finite())?;
    // the only suffix of a number is that of `1.5f` in C
    let after = &text[length..];
    let suffix = usize::from(after.starts_with(['f', 'F']));
    let ended = |c: char| c.is_whitespace() || ",;)]}#%/".contains(c);
    after[suffix..].chars().next().is_none_or(ended).then_some((value, length + suffix))
}

/// Reads values from tokens.
struct Reader<'a> {
    tokens: &'a [Token],
    columns: &'a [usize],
    at: usize,
    /// The factor of the last list that had one.
    factor: Option<f64>,
    /// Lists and mappings around the present one.
    depth: usize,
}

/// Greatest depth of lists in lists; a file of brackets alone would exhaust the stack.
const DEEPEST: usize = 32;

impl Reader<'_> {
    fn next(&mut self) -> Option<&Token> {
        self.at += 1;
        self.tokens.get(self.at - 1)
    }

    fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    fn skip_lines(&mut self) {
        while self.peek() == Some(&Token::LineEnd) {
            self.at += 1;
        }
    }

    /// A value behind `=` or `:`, perhaps a number times a list.
    fn value(&mut self) -> Option<ListValue> {
        let value = match self.tokens.get(self.at..self.at + 2) {
            Some([Token::Number(factor), Token::Times]) => {
                let factor = *factor;
                self.at += 2;
                self.factor = Some(factor);
                self.operand()?.times(factor)?
            }
            _ => self.operand()?,
        };
        match self.tokens.get(self.at..self.at + 2) {
            Some([Token::Times, Token::Number(factor)]) => {
                let factor = *factor;
                self.at += 2;
                self.factor = Some(factor);
                value.times(factor)
            }
            _ if self.peek() == Some(&Token::Times) => None,
            _ => Some(value),
        }
    }

    fn operand(&mut self) -> Option<ListValue> {
        let mut lines = 0;
        while self.peek() == Some(&Token::LineEnd) {
            (self.at, lines) = (self.at + 1, lines + 1);
        }
        match self.peek()?.clone() {
            Token::Item if lines > 0 => self.deeper(Self::items),
            Token::Number(x) if lines == 0 => {
                self.at += 1;
                Some(ListValue::Number(x))
            }
            Token::Text(text) if lines == 0 => {
                self.at += 1;
                Some(ListValue::Text(text))
            }
            Token::Open(open) => {
                self.at += 1;
                self.list(open)
            }
            // `np.array(`, or a word as a text
            Token::Word(word) if lines == 0 => {
                self.at += 1;
                match self.peek() {
                    Some(Token::Open(_)) if computes(&word) => None,
                    Some(Token::Open(open)) => {
                        let open = *open;
                        self.at += 1;
                        self.list(open)
                    }
                    _ => Some(ListValue::Text(word)),
                }
            }
            _ => None,
        }
    }

    /// The items of a YAML list.
    fn items(&mut self) -> Option<ListValue> {
        let mut items = Vec::new();
        loop {
            self.skip_lines();
            if self.peek() != Some(&Token::Item) {
                return Some(ListValue::List(items));
            }
            self.at += 1;
            items.push(match self.tokens.get(self.at..self.at + 2)? {
                [Token::Word(_), Token::Is] => self.mapping()?,
                _ => self.value()?,
            });
        }
    }

    /// `x: 1`, one per line, with the names in one column; deeper names are a mapping in it.
    fn mapping(&mut self) -> Option<ListValue> {
        self.deeper(Self::mapping_here)
    }

    /// Reads a value one level deeper; `None` below [`DEEPEST`].
    fn deeper(&mut self, read: impl FnOnce(&mut Self) -> Option<ListValue>) -> Option<ListValue> {
        if self.depth >= DEEPEST {
            return None;
        }
        self.depth += 1;
        let value = read(self);
        self.depth -= 1;
        value
    }

    fn mapping_here(&mut self) -> Option<ListValue> {
        let column = *self.columns.get(self.at)?;
        let mut named = Vec::new();
        while let Some([Token::Word(name), Token::Is]) = self.tokens.get(self.at..self.at + 2)
            && self.columns.get(self.at) == Some(&column)
        {
            let name = name.clone();
            self.at += 2;
            let begin = self.at;
            self.skip_lines();
            let deeper = self.at > begin
                && matches!(self.peek(), Some(Token::Word(_)))
                && self.columns.get(self.at).is_some_and(|inner| *inner > column);
            let value = if deeper {
                self.mapping()?
            } else {
                self.at = begin;
                self.value()?
            };
            self.skip_lines();
            named.push((name, value));
        }
        (!named.is_empty()).then_some(ListValue::Named(named))
    }

    /// The contents of brackets, after the opening one.
    fn list(&mut self, open: char) -> Option<ListValue> {
        self.deeper(|reader| reader.list_here(open))
    }

    fn list_here(&mut self, open: char) -> Option<ListValue> {
        let close = match open {
            '[' => ']',
            '(' => ')',
            _ => '}',
        };
        let (mut rows, mut row, mut named) = (Vec::new(), Vec::new(), Vec::new());
        let (mut commas, mut semicolons, mut lines) = (false, false, Vec::new());
        loop {
            match self.next()?.clone() {
                Token::Close(c) if c == close => break,
                Token::Comma => commas = true,
                Token::LineEnd => lines.push(row.len()),
                Token::Semicolon => {
                    semicolons = true;
                    rows.push(std::mem::take(&mut row));
                    lines.clear();
                }
                Token::Number(x) => row.push(ListValue::Number(x)),
                Token::Open(inner) => row.push(self.list(inner)?),
                Token::Text(name) | Token::Word(name) => match self.peek() {
                    Some(Token::Is) => {
                        self.at += 1;
                        named.push((name, self.value()?));
                    }
                    Some(Token::Open(_)) if computes(&name) => return None,
                    Some(Token::Open(inner)) => {
                        let inner = *inner;
                        self.at += 1;
                        row.push(self.list(inner)?);
                    }
                    _ => row.push(ListValue::Text(name)),
                },
                Token::Item | Token::Is | Token::Times | Token::Close(_) => return None,
            }
        }
        if !named.is_empty() {
            // `np.array([..], dtype = float)`
            return match row.pop() {
                Some(only @ ListValue::List(_)) if row.is_empty() => Some(only),
                Some(_) => None,
                None => Some(ListValue::Named(named)),
            };
        }
        if semicolons {
            rows.push(row);
            rows.retain(|row| !row.is_empty());
            return Some(ListValue::List(rows.into_iter().map(ListValue::List).collect()));
        }
        let plain = row.iter().all(|x| matches!(x, ListValue::Number(_)));
        if open == '[' && plain && !commas && lines.iter().any(|n| *n > 0 && *n < row.len()) {
            let mut begin = 0;
            lines.push(row.len());
            for end in lines {
                if end > begin {
                    rows.push(row[begin..end].to_vec());
                    begin = end;
                }
            }
            return Some(ListValue::List(rows.into_iter().map(ListValue::List).collect()));
        }
        // `np.array([[..], ..])`
        match row.pop() {
            Some(only @ (ListValue::List(_) | ListValue::Named(_))) if row.is_empty() && open == '(' => {
                Some(only)
            }
            Some(last) => {
                row.push(last);
                Some(ListValue::List(row))
            }
            None => Some(ListValue::List(row)),
        }
    }
}

/// The names with values, in the order of the text; names in an object have the object's name before them.
///
/// Factors of lists are guesses.
fn named_values(text: &str, guesses: &mut Vec<String>) -> Option<Vec<(String, ListValue)>> {
    let (tokens, columns) = tokens(text)?;
    let mut reader = Reader { tokens: &tokens, columns: &columns, at: 0, factor: None, depth: 0 };
    let mut out = Vec::new();
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
        while let Some([Token::Open('['), Token::Number(_), Token::Close(']')]) =
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
        match reader.value() {
            Some(value) => {
                let factor = reader.factor.take();
                guesses.extend(factor.map(|factor| format!("`{name}` is multiplied by {factor}.")));
                out.push((name, value));
            }
            // a mapping of YAML: its keys are read separately
            None => reader.at = after,
        }
    }
    Some(flat(out, ""))
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

impl ListValue {
    fn number(&self) -> Option<f64> {
        if let Self::Number(x) = self { Some(*x) } else { None }
    }

    /// A list of numbers; an object with `x`, `y` and perhaps `z`, or a column, counts as one.
    fn numbers(&self) -> Option<Vec<f64>> {
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

    /// Every number times a factor.
    fn times(self, factor: f64) -> Option<Self> {
        match self {
            Self::Number(x) => Some(Self::Number(x * factor)),
            Self::List(list) => {
                Some(Self::List(list.into_iter().map(|x| x.times(factor)).collect::<Option<_>>()?))
            }
            Self::Text(_) | Self::Named(_) => None,
        }
    }

    /// The points of an end of a leg or of both, with their names.
    fn points(&self) -> Vec<(&str, Vec<f64>)> {
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
    fn rows(&self) -> Option<Vec<Vec<f64>>> {
        let Self::List(list) = self else { return None };
        let rows: Vec<Vec<f64>> = list.iter().map(Self::numbers).collect::<Option<_>>()?;
        let width = rows.first()?.len();
        (width > 1 && rows.iter().all(|row| row.len() == width)).then_some(rows)
    }
}

/// Six points, by rows or by columns.
struct SixPoints {
    points: [Point3<f64>; 6],
    by_columns: bool,
    flat: bool,
}

impl SixPoints {
    fn of(value: &ListValue) -> Option<Self> {
        // 18 numbers are six points one after another
        if let Some(list) = value.numbers().filter(|list| list.len() == 18) {
            let points = std::array::from_fn(|i| Point3::new(list[3 * i], list[3 * i + 1], list[3 * i + 2]));
            return Some(Self { points, by_columns: false, flat: false });
        }
        let rows = value.rows()?;
        let (height, width) = (rows.len(), rows[0].len());
        let by_columns = match (height, width) {
            (6, 2 | 3) => false,
            (2 | 3, 6) => true,
            _ => return None,
        };
        let at = |leg: usize, axis: usize| {
            if by_columns { rows.get(axis).map(|row| row[leg]) } else { rows[leg].get(axis).copied() }
        };
        let points = std::array::from_fn(|i| Point3::from([0, 1, 2].map(|axis| at(i, axis).unwrap_or(0.0))));
        Some(Self { points, by_columns, flat: height.min(width) == 2 })
    }
}

/// Joints of a body, with the names of the values in the text.
struct ListedBody {
    name: String,
    points: [Point3<f64>; 6],
    used: Vec<usize>,
}

/// The twelve ends in lists; `None` if the text has no two named lists of six points or angles.
pub(super) fn read(text: &str) -> Option<Result<PointTable, InvalidPointTable>> {
    let mut guesses = Vec::new();
    let values = named_values(text, &mut guesses)?;
    let bodies = points(&values, &mut guesses)
        .or_else(|| coordinate_lists(&values).map(Ok))
        .or_else(|| named_legs(&values, &mut guesses))
        .or_else(|| numbered_points(&values, &mut guesses).map(Ok))
        .or_else(|| legs(&values, &mut guesses).map(Ok))
        .or_else(|| polar(&values, text, &mut guesses))?;
    Some(bodies.map(|bodies| table(&bodies, &values, text, guesses)))
}

/// A point of two or three coordinates.
fn point_of(list: &[f64]) -> Point3<f64> {
    Point3::from([0, 1, 2].map(|axis| list.get(axis).copied().unwrap_or(0.0)))
}

/// Lists of x, of y and perhaps of z for both bodies: `base_x = [..]`.
fn coordinate_lists(values: &[(String, ListValue)]) -> Option<[ListedBody; 2]> {
    let mut bodies: Vec<(String, [Option<usize>; 3])> = Vec::new();
    for (k, (name, value)) in values.iter().enumerate() {
        if value.numbers().is_none_or(|list| list.len() != 6) {
            continue;
        }
        let word = plain(name);
        let Some(axis) = word.chars().last().and_then(|c| "xyz".find(c)) else { continue };
        let stem = word[..word.len() - 1].to_owned();
        if let Some((_, places)) = bodies.iter_mut().find(|(known, _)| *known == stem) {
            places[axis] = Some(k);
        } else {
            let mut places = [None; 3];
            places[axis] = Some(k);
            bodies.push((stem, places));
        }
    }
    let of = |(stem, places): (String, [Option<usize>; 3])| {
        let [Some(_), Some(_), _] = places else { return None };
        let list = |place: Option<usize>| place.and_then(|k| values[k].1.numbers());
        let lists = places.map(list);
        let at = |i: usize| lists.each_ref().map(|list| list.as_ref().map_or(0.0, |list| list[i]));
        let points = std::array::from_fn(|i| Point3::from(at(i)));
        Some(ListedBody { name: stem, points, used: places.into_iter().flatten().collect() })
    };
    let bodies: Vec<ListedBody> = bodies.into_iter().map(of).collect::<Option<_>>()?;
    bodies.try_into().ok()
}

/// Points with names, and six legs as pairs of these names.
fn named_legs(
    values: &[(String, ListValue)],
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let pair = |value: &ListValue| match value {
        ListValue::List(list) => match &list[..] {
            [ListValue::Text(a), ListValue::Text(b)] => Some([a.clone(), b.clone()]),
            _ => None,
        },
        _ => None,
    };
    let pairs = |value: &ListValue| match value {
        ListValue::List(list) if list.len() == 6 => list.iter().map(pair).collect::<Option<Vec<_>>>(),
        _ => None,
    };
    let (at, legs) = values.iter().enumerate().find_map(|(k, (_, value))| Some((k, pairs(value)?)))?;
    let point = |joint: &String| {
        let found = values.iter().enumerate().find_map(|(k, (name, value))| {
            let own =
                name.strip_suffix(joint.as_str()).is_some_and(|way| way.is_empty() || way.ends_with('_'));
            let list = value.numbers().filter(|list| own && (2..=3).contains(&list.len()))?;
            Some((name.clone(), k, point_of(&list)))
        });
        found.ok_or_else(|| {
            let message =
                format!("`{}` names the joint `{joint}`, which has no list of coordinates", values[at].0);
            InvalidPointTable::Form(message)
        })
    };
    let body = |end: usize| -> Result<ListedBody, InvalidPointTable> {
        let joints = legs.iter().map(|leg| point(&leg[end])).collect::<Result<Vec<_>, _>>()?;
        let name = joints[0].0.chars().filter(|c| !c.is_ascii_digit()).collect();
        let used = joints.iter().map(|(_, k, _)| *k).chain([at]).collect();
        Ok(ListedBody { name, points: std::array::from_fn(|leg| joints[leg].2), used })
    };
    guesses.push(format!("The legs join the joints that `{}` names.", values[at].0));
    Some(body(0).and_then(|first| Ok([first, body(1)?])))
}

/// A point with the number in its name and its place among the values.
type NumberedPoint = (u64, usize, Point3<f64>);

/// Single points with a number in their names: `B1 = [..]`, or the members of an object for each body.
fn numbered_points(values: &[(String, ListValue)], guesses: &mut Vec<String>) -> Option<[ListedBody; 2]> {
    let mut bodies: Vec<(String, Vec<NumberedPoint>)> = Vec::new();
    for (k, (name, value)) in values.iter().enumerate() {
        let Some(list) = value.numbers().filter(|list| (2..=3).contains(&list.len())) else { continue };
        let Some(number) = only_number(name) else { continue };
        let stem: String = name.chars().filter(|c| !c.is_ascii_digit()).collect();
        let joint = (number, k, point_of(&list));
        match bodies.iter_mut().find(|(known, _)| *known == stem) {
            Some((_, joints)) => joints.push(joint),
            None => bodies.push((stem, vec![joint])),
        }
    }
    bodies.retain(|(_, joints)| joints.len() == 6);
    let numbers = |(_, joints): &mut (String, Vec<NumberedPoint>)| {
        joints.sort_by_key(|(number, ..)| *number);
        joints.iter().map(|(number, ..)| *number).collect::<Vec<_>>()
    };
    let [first, second] = &mut bodies[..] else { return None };
    let (first, second) = (numbers(first), numbers(second));
    if first != second || first.windows(2).any(|pair| pair[0] == pair[1]) {
        return None;
    }
    guesses.push("Joints with the same number are the ends of one leg.".into());
    let of = |(name, joints): (String, Vec<NumberedPoint>)| ListedBody {
        name,
        points: std::array::from_fn(|i| joints[i].2),
        used: joints.iter().map(|(_, k, _)| *k).collect(),
    };
    let bodies: Vec<ListedBody> = bodies.into_iter().map(of).collect();
    bodies.try_into().ok()
}

/// Six legs, each with its two ends.
fn legs(values: &[(String, ListValue)], guesses: &mut Vec<String>) -> Option<[ListedBody; 2]> {
    let (k, items) = values.iter().enumerate().find_map(|(k, (_, value))| match value {
        ListValue::List(list) if list.len() == 6 && list.iter().all(|leg| leg.points().len() == 2) => {
            Some((k, list))
        }
        _ => None,
    })?;
    let number = |leg: &ListValue| {
        let ListValue::Named(named) = leg else { return None };
        named.iter().find_map(|(name, value)| {
            let name = plain(name);
            let counts =
                LEG_WORDS.contains(&name.as_str()) || ROW_WORDS.contains(&name.as_str()) || name == "name";
            match value {
                ListValue::Number(x) if counts && *x >= 0.0 && x.fract() == 0.0 => Some(*x),
                ListValue::Text(text) if counts => only_number(text).map(|n| n as f64),
                _ => None,
            }
        })
    };
    let mut order: Vec<&ListValue> = items.iter().collect();
    let numbers: Option<Vec<f64>> = items.iter().map(number).collect();
    if let Some(numbers) = numbers
        && !numbers.is_sorted()
    {
        order.sort_by(|a, b| number(a).unwrap_or(0.0).total_cmp(&number(b).unwrap_or(0.0)));
        guesses.push("The legs are put in the order of their numbers.".into());
    }
    let names = order[0].points().into_iter().map(|(name, _)| name.to_owned()).collect::<Vec<_>>();
    let same =
        order.iter().all(|leg| leg.points().iter().zip(&names).all(|((name, _), known)| name == known));
    if !same {
        return None;
    }
    let of = |end: usize| ListedBody {
        name: names[end].clone(),
        points: std::array::from_fn(|i| point_of(&order[i].points()[end].1)),
        used: vec![k],
    };
    Some([of(0), of(1)])
}

fn points(
    values: &[(String, ListValue)],
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let found: Vec<(usize, SixPoints)> =
        values.iter().enumerate().filter_map(|(k, (_, value))| Some((k, SixPoints::of(value)?))).collect();
    if found.len() > 2 {
        let names: Vec<String> = found.iter().map(|(k, _)| format!("`{}`", values[*k].0)).collect();
        let message = format!(
            "there are {} lists of six points, {}: leave the two of the bodies",
            found.len(),
            names.join(", ")
        );
        return Some(Err(InvalidPointTable::Form(message)));
    }
    let bodies: Vec<ListedBody> = found
        .into_iter()
        .map(|(k, six)| {
            let name = values[k].0.clone();
            if six.by_columns {
                guesses.push(format!("The columns of `{name}` are the joints of the legs."));
            }
            if six.flat {
                guesses.push(format!("`{name}` has no z: its joints are at z = 0 of their body."));
            }
            ListedBody { name, points: six.points, used: vec![k] }
        })
        .collect();
    bodies.try_into().ok().map(Ok)
}

/// Two radii and two lists of six angles.
fn polar(
    values: &[(String, ListValue)],
    text: &str,
    guesses: &mut Vec<String>,
) -> Option<Result<[ListedBody; 2], InvalidPointTable>> {
    let angles: Vec<(usize, Vec<f64>)> = values
        .iter()
        .enumerate()
        .filter_map(|(k, (_, value))| Some((k, value.numbers().filter(|list| list.len() == 6)?)))
        .collect();
    let [(i, first), (j, second)] = &angles[..] else { return None };
    let radii: Vec<(usize, f64)> = values
        .iter()
        .enumerate()
        .filter_map(|(k, (name, value))| Some((k, value.number().filter(|_| is_radius(name))?)))
        .collect();
    let names = [values[*i].0.as_str(), values[*j].0.as_str()];
    if !names.iter().all(|name| is_angle(name)) {
        return None;
    }
    let [(k, r), (l, s)] = radii[..] else {
        let message = format!(
            "`{}` and `{}` are six angles each, and two radii are needed beside them, not {}",
            names[0],
            names[1],
            radii.len()
        );
        return Some(Err(InvalidPointTable::Form(message)));
    };
    // a radius belongs to the angles of the same body, otherwise both are in the same order
    let said = |name: &str| body_of_word(&plain(name));
    let crossed = matches!((said(names[0]), said(&values[k].0)), (Some(x), Some(y)) if x != y);
    let pairs = if crossed { [(s, l), (r, k)] } else { [(r, k), (s, l)] };
    let degrees = match angle_unit(names, text, first.iter().chain(second)) {
        Ok(degrees) => degrees,
        Err(why) => return Some(Err(InvalidPointTable::Form(why))),
    };
    guesses.push(format!(
        "`{}` and `{}` are angles in {}, counted from x towards y.",
        names[0],
        names[1],
        if degrees { "degrees" } else { "radians" }
    ));
    let body = |index: usize, list: &[f64], (radius, at): (f64, usize)| ListedBody {
        name: values[index].0.clone(),
        points: std::array::from_fn(|leg| on_circle(radius, list[leg], degrees)),
        used: vec![index, at],
    };
    Some(Ok([body(*i, first, pairs[0]), body(*j, second, pairs[1])]))
}

/// The point of a circle about z at an angle from x towards y.
pub(super) fn on_circle(radius: f64, angle: f64, degrees: bool) -> Point3<f64> {
    let (sin, cos) = if degrees { angle.to_radians() } else { angle }.sin_cos();
    Point3::new(radius * cos, radius * sin, 0.0)
}

/// Words for a radius.
pub(super) const RADIUS_WORDS: [&str; 3] = ["radius", "halbmesser", "rayon"];
/// Words for a diameter.
pub(super) const DIAMETER_WORDS: [&str; 2] = ["diameter", "durchmesser"];

/// Whether a name is that of a diameter.
pub(super) fn is_diameter(name: &str) -> bool {
    DIAMETER_WORDS.iter().any(|word| plain(name).contains(word))
}

/// Whether a name is that of a radius.
pub(super) fn is_radius(name: &str) -> bool {
    let name = plain(name);
    RADIUS_WORDS.iter().any(|word| name.contains(word))
        || name.contains("radii")
        || ["r", "rb", "rp", "rt", "br", "pr", "tr"].contains(&name.as_str())
}

/// Whether a name is that of an angle.
pub(super) fn is_angle(name: &str) -> bool {
    let name = plain(name);
    ["angle", "theta", "phi", "azimut", "deg", "winkel"].iter().any(|word| name.contains(word))
}

/// The unit of angles, from their names, a comment, or a value above 6.3. Otherwise it is the reason why the unit is
/// unknown.
pub(super) fn angle_unit<'a>(
    names: [&str; 2],
    text: &str,
    mut angles: impl Iterator<Item = &'a f64>,
) -> Result<bool, String> {
    let said = |text: &str| {
        let text = text.to_lowercase();
        let words = |words: &[&str]| {
            text.split(|c: char| !(c.is_alphabetic() || c == '\u{b0}')).any(|part| words.contains(&part))
        };
        let degrees = words(&["deg", "degree", "degrees", "grad", "\u{b0}"]);
        match (degrees, words(&["rad", "radian", "radians"])) {
            (true, false) => Some(true),
            (false, true) => Some(false),
            _ => None,
        }
    };
    match said(&names.join(" ")).or_else(|| said(text)) {
        Some(degrees) => Ok(degrees),
        None if angles.any(|x| x.abs() > std::f64::consts::TAU) => Ok(true),
        None => Err("the angles may be degrees or radians: say which in a name or in a comment".into()),
    }
}

/// Names of the height of the platform above the base.
const HEIGHTS: [&str; 8] = ["height", "h", "z0", "home", "homeheight", "h0", "zhome", "homez"];

fn table(
    bodies: &[ListedBody; 2],
    values: &[(String, ListValue)],
    text: &str,
    mut guesses: Vec<String>,
) -> PointTable {
    let [first, second] = bodies;
    let order = bodies_of_words(&plain(&first.name), &plain(&second.name), &mut Vec::new());
    guesses.push(if first.name.is_empty() {
        "The first point of a leg is the one of the base.".into()
    } else {
        told_apart([&first.name, &second.name], order)
    });
    let (base, platform) = if order[0] == Body::Base { (first, second) } else { (second, first) };
    if !first.used.iter().any(|k| second.used.contains(k))
        && !guesses.iter().any(|g| g.contains("same number"))
    {
        guesses.push(FIRST_WITH_FIRST.into());
    }
    let mut used: Vec<usize> = bodies.iter().flat_map(|body| body.used.iter().copied()).collect();
    let mut home = None;
    let mut units = None;
    for (k, (name, value)) in values.iter().enumerate() {
        let word = plain(name);
        let vector = value.numbers().filter(|list| list.len() == 3);
        let position = match (value.number(), vector) {
            (Some(z), _)
                if HEIGHTS.contains(&word.as_str())
                    || ["height", "homez"].iter().any(|end| word.ends_with(end)) =>
            {
                Some([0.0, 0.0, z])
            }
            (_, Some(p)) => Some([p[0], p[1], p[2]]),
            _ => None,
        };
        if let Some(position) = position.filter(|_| home.is_none() && !used.contains(&k)) {
            let [x, y, z] = position;
            guesses
                .push(format!("`{name}` is the place of the platform at home: x = {x}, y = {y}, z = {z}."));
            home = Some(Pose::new(position, Angles::default()));
            used.push(k);
        }
        if let ListValue::Text(said) = value
            && (word.starts_with("unit") || word.ends_with("units"))
            && let Some((_, label)) = UNITS.iter().find(|(spelling, _)| *spelling == said.to_lowercase())
        {
            units = Some((*label).to_owned());
            guesses.push(format!("The lengths are in {label}, as `{name}` says."));
            used.push(k);
        }
    }
    if units.is_none()
        && let Some(label) = unit_of_comment(text)
    {
        guesses.push(format!("The lengths are in {label}, as a comment says."));
        units = Some(label.to_owned());
    }
    let unread: Vec<String> = values
        .iter()
        .enumerate()
        .filter(|(k, (_, value))| !used.contains(k) && !matches!(value, ListValue::Text(_)))
        .map(|(_, (name, _))| format!("`{name}`"))
        .collect();
    if !unread.is_empty() {
        guesses.push(format!("Not read: {}.", unread.join(", ")));
    }
    let mut table = PointTable {
        legs: std::array::from_fn(|i| Leg { base: base.points[i], platform: platform.points[i] }),
        names: None,
        units,
        home,
        guesses,
    };
    if table.home.is_none() {
        table.part_frames();
    }
    table
}

/// The unit in a comment: `# anchors in mm`.
fn unit_of_comment(text: &str) -> Option<&'static str> {
    let mut comments = text.lines().filter_map(|line| {
        let at = line.find(['#', '%']).or_else(|| line.find("//")).or_else(|| line.find("/*"))?;
        Some(&line[at..])
    });
    comments.find_map(|comment| units_in_title(comment).0)
}
