//! The tokens of lists in source code, without comments.

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    Word(String),
    Text(String),
    Number(f64),
    Open(char),
    Close(char),
    /// `=` or `:`.
    Is,
    Comma,
    Semicolon,
    /// Before or behind a factor of a list.
    Times,
    /// Before a divisor of a list.
    Over,
    LineEnd,
    /// The dash before an item of a YAML list.
    Item,
    /// A part of a formula, which is not evaluated.
    Other,
}

/// The place of a token: its line from 1, and its column.
pub(super) type TokenPlace = (usize, usize);

/// The tokens of a text without its comments, with their places.
pub(super) fn tokens(text: &str) -> (Vec<Token>, Vec<TokenPlace>) {
    let mut out = Vec::new();
    let mut places = Vec::new();
    let mut in_comment = false;
    for (k, line) in text.lines().enumerate() {
        let mut rest = line;
        if in_comment {
            let Some((_, after)) = rest.split_once("*/") else { continue };
            (rest, in_comment) = (after, false);
        }
        if let Some(definition) = rest.trim_start().strip_prefix("#define") {
            let mut words = definition.split_whitespace();
            if let (Some(name), Some(number)) = (words.next(), words.next().and_then(|w| w.parse().ok())) {
                out.extend([Token::Word(name.into()), Token::Is, Token::Number(number), Token::LineEnd]);
                places.resize(out.len(), (k + 1, 0));
            }
            continue;
        }
        if ["import ", "from ", "#include", "---"].iter().any(|w| rest.trim_start().starts_with(w)) {
            continue;
        }
        let mut at_start = true;
        let mut continued = false;
        let mut unclosed = None;
        while let Some(c) = rest.chars().next() {
            let mut skip = c.len_utf8();
            places.resize(out.len(), (k + 1, line.len() - rest.len()));
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
                // `.x = 1` names a member
                '.' if rest[1..].starts_with(char::is_alphabetic) => {}
                '*' => out.push(Token::Times),
                '#' | '%' => break,
                '/' if !rest.starts_with("//") && !rest.starts_with("/*") => out.push(Token::Over),
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
                    places.resize(out.len(), (k + 1, line.len() - rest.len()));
                    rest = &rest[skip..];
                    continue;
                }
                '[' | '(' | '{' => out.push(Token::Open(c)),
                ']' | ')' | '}' => out.push(Token::Close(c)),
                '=' | ':' => out.push(Token::Is),
                ',' => out.push(Token::Comma),
                ';' => out.push(Token::Semicolon),
                // no second search to the end of a long line
                '"' | '\'' if unclosed == Some(c) => out.push(Token::Other),
                '"' | '\'' => {
                    if let Some(end) = quote_end(&rest[1..], c) {
                        out.push(Token::Text(rest[1..=end].into()));
                        skip = end + 2;
                    } else {
                        unclosed = Some(c);
                        out.push(Token::Other);
                    }
                }
                _ if c.is_ascii_digit() || "+-.".contains(c) => {
                    if let Some((number, length)) = number(rest) {
                        out.push(Token::Number(number));
                        skip = length;
                    } else {
                        // the whole run, so that it is looked at once
                        let ends = |c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c));
                        skip = rest.find(ends).unwrap_or(rest.len()).max(1);
                        out.push(Token::Other);
                    }
                }
                _ if c.is_alphabetic() || c == '_' => {
                    // `Eigen::Vector3d` is one name
                    let in_name = |(at, c): (usize, char)| {
                        let scope = c == ':'
                            && (rest[at..].starts_with("::") || rest[..at].ends_with(':'))
                            && !rest[at..].starts_with(":=");
                        c.is_alphanumeric() || "_.-".contains(c) || scope
                    };
                    skip =
                        rest.char_indices().find(|place| !in_name(*place)).map_or(rest.len(), |(at, _)| at);
                    out.push(Token::Word(rest[..skip].trim_end_matches(['.', '-']).into()));
                }
                // arithmetic, or no list at all
                _ => out.push(Token::Other),
            }
            places.resize(out.len(), (k + 1, line.len() - rest.len()));
            at_start &= c.is_whitespace();
            rest = &rest[skip..];
        }
        if !continued {
            out.push(Token::LineEnd);
        }
        places.resize(out.len(), (k + 1, line.len()));
    }
    (out, places)
}

/// The place of the mark that closes a quoted text; a backslash hides one.
fn quote_end(text: &str, mark: char) -> Option<usize> {
    let mut hidden = false;
    text.char_indices()
        .find(|(_, c)| {
            let ends = *c == mark && !hidden;
            hidden = *c == '\\' && !hidden;
            ends
        })
        .map(|(at, _)| at)
}

/// Functions that compute numbers, which are not evaluated.
const FUNCTIONS: [&str; 11] =
    ["sin", "cos", "tan", "sqrt", "radians", "degrees", "deg2rad", "rad2deg", "linspace", "arange", "range"];

/// Whether a word calls one of [`FUNCTIONS`].
pub(super) fn computes(word: &str) -> bool {
    word.rsplit('.').next().is_some_and(|name| FUNCTIONS.contains(&name.to_lowercase().as_str()))
}

/// Whether a text computes its numbers: it is a program, and is not run.
pub(in crate::design::table) fn is_computed(text: &str) -> bool {
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
    let ended = |c: char| c.is_whitespace() || ",;)]}#%/*".contains(c);
    after[suffix..].chars().next().is_none_or(ended).then_some((value, length + suffix))
}
