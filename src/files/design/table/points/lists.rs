//! Lists of points in source code: Python and numpy, C initialisers, MATLAB matrices, JSON and YAML.
//!
//! The text is read as assignments of values to names. A value is a number, a text or a nested list in brackets of any
//! kind. The row of a MATLAB matrix ends at a semicolon or, without commas, at the end of a line. An item of a YAML
//! list begins with a dash. Other text is left to the reader of tables.

use nalgebra::Point3;

use super::{InvalidPointTable, PointTable, bodies_of_words, body_of_word, told_apart};
use crate::design::table::header::{UNITS, plain};
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
    LineEnd,
    /// The dash before an item of a YAML list.
    Item,
}

/// The tokens of a text without its comments; `None` if it contains anything that lists of numbers cannot have.
fn tokens(text: &str) -> Option<Vec<Token>> {
    let mut out = Vec::new();
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
            }
            continue;
        }
        if ["import ", "from ", "#include", "---"].iter().any(|w| rest.trim_start().starts_with(w)) {
            continue;
        }
        let mut at_start = true;
        while let Some(c) = rest.chars().next() {
            let mut skip = c.len_utf8();
            match c {
                _ if c.is_whitespace() => {}
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
            at_start &= c.is_whitespace();
            rest = &rest[skip..];
        }
        out.push(Token::LineEnd);
    }
    Some(out)
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
    at: usize,
}

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

    /// A value behind `=` or `:`.
    fn value(&mut self) -> Option<ListValue> {
        let mut lines = 0;
        while self.peek() == Some(&Token::LineEnd) {
            (self.at, lines) = (self.at + 1, lines + 1);
        }
        match self.peek()?.clone() {
            Token::Item if lines > 0 => self.items(),
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

    /// `x: 1`, one per line, up to the next item or a value that is not a number.
    fn mapping(&mut self) -> Option<ListValue> {
        let mut named = Vec::new();
        while let Some([Token::Word(name), Token::Is, Token::Number(x), Token::LineEnd]) =
            self.tokens.get(self.at..self.at + 4)
        {
            named.push((name.clone(), ListValue::Number(*x)));
            self.at += 4;
        }
        (!named.is_empty()).then_some(ListValue::Named(named))
    }

    /// The contents of brackets, after the opening one.
    fn list(&mut self, open: char) -> Option<ListValue> {
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
                    Some(Token::Open(inner)) => {
                        let inner = *inner;
                        self.at += 1;
                        row.push(self.list(inner)?);
                    }
                    _ => row.push(ListValue::Text(name)),
                },
                Token::Item | Token::Is | Token::Close(_) => return None,
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
fn named_values(text: &str) -> Option<Vec<(String, ListValue)>> {
    let tokens = tokens(text)?;
    let mut reader = Reader { tokens: &tokens, at: 0 };
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
        reader.at += 1;
        let after = reader.at;
        match reader.value() {
            Some(value) => out.push((name, value)),
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
            ListValue::Named(inner) => flat(inner, &path(&name)),
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
    let values = named_values(text)?;
    let mut guesses = Vec::new();
    let bodies = points(&values, &mut guesses).or_else(|| polar(&values, text, &mut guesses))?;
    Some(bodies.map(|bodies| table(&bodies, &values, text, guesses)))
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

/// Whether a name is that of a radius.
pub(super) fn is_radius(name: &str) -> bool {
    let name = plain(name);
    name.contains("radius")
        || name.contains("radii")
        || ["r", "rb", "rp", "rt", "br", "pr", "tr"].contains(&name.as_str())
}

/// Whether a name is that of an angle.
pub(super) fn is_angle(name: &str) -> bool {
    let name = plain(name);
    ["angle", "theta", "phi", "azimuth", "deg"].iter().any(|word| name.contains(word))
}

/// The unit of angles, from their names, a comment, or a value above 6.3. Otherwise it is the reason why the unit is
/// unknown.
pub(super) fn angle_unit<'a>(
    names: [&str; 2],
    text: &str,
    mut angles: impl Iterator<Item = &'a f64>,
) -> Result<bool, String> {
    let named = |words: &[&str]| {
        let in_names = names.iter().any(|name| {
            name.to_lowercase().split(|c: char| !c.is_alphabetic()).any(|part| words.contains(&part))
        });
        in_names || text.to_lowercase().split(|c: char| !c.is_alphabetic()).any(|part| words.contains(&part))
    };
    match (named(&["deg", "degree", "degrees"]), named(&["rad", "radian", "radians"])) {
        (true, false) => Ok(true),
        (false, true) => Ok(false),
        _ if angles.any(|x| x.abs() > std::f64::consts::TAU) => Ok(true),
        _ => Err("the angles may be degrees or radians: say which in a name or in a comment".into()),
    }
}

/// Names of the height of the platform above the base.
const HEIGHTS: [&str; 7] = ["height", "h", "z0", "home", "homeheight", "h0", "zhome"];

fn table(
    bodies: &[ListedBody; 2],
    values: &[(String, ListValue)],
    text: &str,
    mut guesses: Vec<String>,
) -> PointTable {
    let [first, second] = bodies;
    let order = bodies_of_words(&plain(&first.name), &plain(&second.name), &mut Vec::new());
    guesses.push(told_apart([&first.name, &second.name], order));
    let (base, platform) = if order[0] == Body::Base { (first, second) } else { (second, first) };
    guesses.push("Leg 1 joins the first joint of the base and the first of the platform, and so on.".into());
    let mut used: Vec<usize> = bodies.iter().flat_map(|body| body.used.iter().copied()).collect();
    let mut home = None;
    let mut units = None;
    for (k, (name, value)) in values.iter().enumerate() {
        let word = plain(name);
        let vector = value.numbers().filter(|list| list.len() == 3);
        let position = match (value.number(), vector) {
            (Some(z), _) if HEIGHTS.contains(&word.as_str()) || word.ends_with("height") => {
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
            && word.starts_with("unit")
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
        Some(line[at..].to_lowercase())
    });
    comments.find_map(|comment| {
        let words: Vec<&str> =
            comment.split(|c: char| !c.is_alphabetic()).filter(|w| !w.is_empty()).collect();
        let unit = |word: &str| {
            UNITS.iter().find(|(spelling, _)| *spelling == word && word != "in").map(|(_, label)| *label)
        };
        words.windows(2).find_map(|pair| if pair[0] == "in" { unit(pair[1]) } else { None })
    })
}
