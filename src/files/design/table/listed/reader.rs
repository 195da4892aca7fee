//! Values in brackets of any kind, and YAML by its columns.

use super::ListValue;
use super::tokens::{Token, TokenPlace, computes};

/// Reads values from tokens.
pub(super) struct Reader<'a> {
    pub(super) tokens: &'a [Token],
    pub(super) places: &'a [TokenPlace],
    pub(super) at: usize,
    /// The factor or divisor of the last list that had one, in words.
    pub(super) factor: Option<String>,
    /// Lists and mappings around the present one.
    pub(super) depth: usize,
}

/// Greatest depth of lists in lists; a file of brackets alone would exhaust the stack.
pub(super) const DEEPEST: usize = 32;

/// The bracket that closes another one.
pub(super) fn closing(open: char) -> char {
    match open {
        '[' => ']',
        '(' => ')',
        _ => '}',
    }
}

impl Reader<'_> {
    pub(super) fn next(&mut self) -> Option<&Token> {
        self.at += 1;
        self.tokens.get(self.at - 1)
    }

    pub(super) fn peek(&self) -> Option<&Token> {
        self.tokens.get(self.at)
    }

    pub(super) fn skip_lines(&mut self) {
        while self.peek() == Some(&Token::LineEnd) {
            self.at += 1;
        }
    }

    fn column(&self, at: usize) -> Option<usize> {
        self.places.get(at).map(|(_, column)| *column)
    }

    /// A value behind `=` or `:`, perhaps a number times a list, or a list over a number.
    pub(super) fn value(&mut self) -> Option<ListValue> {
        let mut value = match self.tokens.get(self.at..self.at + 2) {
            Some([Token::Number(factor), Token::Times]) => {
                let factor = *factor;
                self.at += 2;
                self.factor = Some(format!("multiplied by {factor}"));
                self.operand()?.map(&|x| x * factor)?
            }
            _ => self.operand()?,
        };
        if let Some([sign @ (Token::Times | Token::Over), Token::Number(factor)]) =
            self.tokens.get(self.at..self.at + 2)
        {
            let factor = *factor;
            let (word, of): (_, &dyn Fn(f64) -> f64) = match sign {
                Token::Over => ("divided", &|x| x / factor),
                _ => ("multiplied", &|x| x * factor),
            };
            self.at += 2;
            self.factor = Some(format!("{word} by {factor}"));
            value = value.map(of)?;
        }
        let goes_on = match self.peek() {
            Some(Token::Times | Token::Over | Token::Other) => true,
            // `B = [..] + 5`, but not a text such as `made of 6 legs`
            Some(Token::Number(_)) => !matches!(value, ListValue::Text(_)),
            _ => false,
        };
        (!goes_on).then_some(value)
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
        Some(ListValue::List(self.lined_items()?.into_iter().map(|(_, item)| item).collect()))
    }

    /// The items of a YAML list with the lines where they begin.
    pub(super) fn lined_items(&mut self) -> Option<Vec<(usize, ListValue)>> {
        let mut items = Vec::new();
        loop {
            self.skip_lines();
            if self.peek() != Some(&Token::Item) {
                return Some(items);
            }
            let line = self.places[self.at].0;
            self.at += 1;
            let value = match self.tokens.get(self.at..self.at + 2)? {
                [Token::Word(_), Token::Is] => self.mapping()?,
                _ => self.value()?,
            };
            items.push((line, value));
        }
    }

    /// The elements of a list in brackets with the lines where they begin, after the opening bracket. Numbers without
    /// brackets of their own are rows that end at a semicolon, or at the end of a line without a comma.
    pub(super) fn lined_elements(&mut self, open: char) -> Option<Vec<(usize, ListValue)>> {
        let mut elements: Vec<(usize, ListValue)> = Vec::new();
        let mut row = Vec::new();
        let (mut begun, mut after_comma) = (0, false);
        loop {
            let line = self.places.get(self.at)?.0;
            let token = self.next()?.clone();
            let ends_row = match token {
                Token::LineEnd => !after_comma,
                Token::Semicolon | Token::Close(_) => true,
                _ => false,
            };
            if ends_row && !row.is_empty() {
                elements.push((begun, ListValue::List(std::mem::take(&mut row))));
            }
            after_comma = token == Token::Comma || (after_comma && token == Token::LineEnd);
            match token {
                Token::Close(c) if c == closing(open) => return Some(elements),
                Token::Comma | Token::Semicolon | Token::LineEnd => {}
                Token::Number(x) => {
                    begun = if row.is_empty() { line } else { begun };
                    row.push(ListValue::Number(x));
                }
                Token::Open(inner) if row.is_empty() => elements.push((line, self.list(inner)?)),
                // `array([..])`
                Token::Word(name) if row.is_empty() && !computes(&name) => {
                    let Token::Open(inner) = self.next()?.clone() else { return None };
                    elements.push((line, self.list(inner)?));
                }
                _ => return None,
            }
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
        let column = self.column(self.at)?;
        let mut named = Vec::new();
        while let Some([Token::Word(name), Token::Is]) = self.tokens.get(self.at..self.at + 2)
            && self.column(self.at) == Some(column)
        {
            let name = name.clone();
            self.at += 2;
            let begin = self.at;
            self.skip_lines();
            let deeper = self.at > begin
                && matches!(self.peek(), Some(Token::Word(_)))
                && self.column(self.at).is_some_and(|inner| inner > column);
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
    pub(super) fn list(&mut self, open: char) -> Option<ListValue> {
        self.deeper(|reader| reader.list_here(open))
    }

    fn list_here(&mut self, open: char) -> Option<ListValue> {
        let close = closing(open);
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
                Token::Item | Token::Is | Token::Times | Token::Over | Token::Other | Token::Close(_) => {
                    return None;
                }
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
