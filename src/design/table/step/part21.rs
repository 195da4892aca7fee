//! The exchange structure of ISO 10303-21: the header and the entities of the data sections.

use std::collections::HashMap;

/// A parameter of an entity.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum StepValue {
    /// `$`, `*` and binary literals: nothing that says where something is.
    Nothing,
    Number(f64),
    Text(String),
    /// `.MILLI.` without its points.
    Word(String),
    Reference(u64),
    List(Vec<StepValue>),
    /// `LENGTH_MEASURE(25.4)`: what is inside; the type has no use here.
    Typed(Vec<StepValue>),
}

impl StepValue {
    pub(super) fn number(&self) -> Option<f64> {
        match self {
            Self::Number(x) => Some(*x),
            Self::Typed(inner) => {
                inner.first().and_then(|v| if let Self::Number(x) = v { Some(*x) } else { None })
            }
            _ => None,
        }
    }

    pub(super) fn reference(&self) -> Option<u64> {
        if let Self::Reference(id) = self { Some(*id) } else { None }
    }

    pub(super) fn text(&self) -> Option<&str> {
        if let Self::Text(text) = self { Some(text) } else { None }
    }

    pub(super) fn word(&self) -> Option<&str> {
        if let Self::Word(word) = self { Some(word) } else { None }
    }

    pub(super) fn list(&self) -> &[StepValue] {
        if let Self::List(list) = self { list } else { &[] }
    }

    /// All references in it. The depth of values is bounded by the reader.
    pub(super) fn references(&self, out: &mut Vec<u64>) {
        match self {
            Self::Reference(id) => out.push(*id),
            Self::List(list) | Self::Typed(list) => list.iter().for_each(|v| v.references(out)),
            _ => {}
        }
    }
}

/// A name with its parameters; an entity is one, or several where it is complex.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct StepRecord {
    pub(super) name: String,
    pub(super) values: Vec<StepValue>,
}

impl StepRecord {
    /// A reference among the parameters.
    pub(super) fn reference(&self, k: usize) -> Option<u64> {
        self.values.get(k)?.reference()
    }
}

/// A file.
#[derive(Debug, Default)]
pub(super) struct ExchangeFile {
    pub(super) header: Vec<StepRecord>,
    pub(super) entities: HashMap<u64, Vec<StepRecord>>,
    /// Numbers of the entities as they come.
    pub(super) order: Vec<u64>,
}

impl ExchangeFile {
    /// The record of this name of an entity.
    pub(super) fn record(&self, id: u64, name: &str) -> Option<&StepRecord> {
        self.entities.get(&id)?.iter().find(|r| r.name == name)
    }

    /// All records of a name, in the order of the file.
    pub(super) fn all<'a>(&'a self, name: &'a str) -> impl Iterator<Item = (u64, &'a StepRecord)> {
        self.order.iter().filter_map(move |id| Some((*id, self.record(*id, name)?)))
    }

    /// Reads a file.
    ///
    /// # Errors
    /// What is not in the grammar, with its line.
    pub(super) fn read(text: &str) -> Result<Self, String> {
        let mut reader = Reader { text, at: 0 };
        reader.file().map_err(|why| {
            let line = 1 + text.get(..reader.at).unwrap_or(text).matches('\n').count();
            format!("line {line}: {why}")
        })
    }
}

/// Lists in lists.
const MAX_DEPTH: usize = 50;

struct Reader<'a> {
    text: &'a str,
    /// Always at the beginning of a character.
    at: usize,
}

impl<'a> Reader<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    /// Past spaces and comments.
    fn skip(&mut self) -> Result<(), String> {
        loop {
            let rest = self.rest();
            self.at += rest.len() - rest.trim_start().len();
            let Some(comment) = self.rest().strip_prefix("/*") else { return Ok(()) };
            let end = comment.find("*/").ok_or("a comment has no end")?;
            self.at += end + 4;
        }
    }

    fn next(&mut self) -> Result<Option<char>, String> {
        self.skip()?;
        Ok(self.rest().chars().next())
    }

    fn eat(&mut self, c: char) -> Result<bool, String> {
        let found = self.next()? == Some(c);
        self.at += if found { c.len_utf8() } else { 0 };
        Ok(found)
    }

    fn expect(&mut self, c: char) -> Result<(), String> {
        if self.eat(c)? {
            return Ok(());
        }
        let found = self.rest().chars().next().map_or("the end of the file".into(), |c| format!("`{c}`"));
        Err(format!("`{c}` is expected, and there is {found}"))
    }

    /// The characters that `fits`.
    fn run(&mut self, fits: impl Fn(char) -> bool) -> &'a str {
        let rest = self.rest();
        let length = rest.find(|c: char| !fits(c)).unwrap_or(rest.len());
        self.at += length;
        &rest[..length]
    }

    fn name(&mut self) -> Result<String, String> {
        self.skip()?;
        let name = self.run(|c| c.is_ascii_alphanumeric() || "_-!".contains(c));
        if name.is_empty() {
            let found = self.rest().chars().next().map_or("the end of the file".into(), |c| format!("`{c}`"));
            return Err(format!("a name is expected, and there is {found}"));
        }
        Ok(name.to_ascii_uppercase())
    }

    fn file(&mut self) -> Result<ExchangeFile, String> {
        let mut file = ExchangeFile::default();
        let begin = self.name()?;
        if begin != "ISO-10303-21" {
            return Err(format!("`ISO-10303-21` is expected, and there is `{begin}`"));
        }
        self.expect(';')?;
        let mut sections = 0;
        loop {
            let section = self.name()?;
            match section.as_str() {
                "END-ISO-10303-21" => break,
                "HEADER" => {
                    self.expect(';')?;
                    while self.next()?.is_some_and(|c| c != '#') {
                        let name = self.name()?;
                        if name == "ENDSEC" {
                            break;
                        }
                        let values = self.parameters(0)?;
                        self.expect(';')?;
                        file.header.push(StepRecord { name, values });
                    }
                    self.expect(';')?;
                }
                "DATA" => {
                    sections += 1;
                    if self.next()? == Some('(') {
                        self.parameters(0)?;
                    }
                    self.expect(';')?;
                    while self.eat('#')? {
                        self.entity(&mut file)?;
                    }
                    let end = self.name()?;
                    if end != "ENDSEC" {
                        return Err(format!("an entity or `ENDSEC` is expected, and there is `{end}`"));
                    }
                    self.expect(';')?;
                }
                // sections of later editions, which say nothing about shapes
                "ANCHOR" | "REFERENCE" | "SIGNATURE" => {
                    let end =
                        self.rest().find("ENDSEC").ok_or_else(|| format!("section {section} has no end"))?;
                    self.at += end + "ENDSEC".len();
                    self.expect(';')?;
                }
                _ => return Err(format!("`{section}` is no section")),
            }
        }
        if sections == 0 { Err("there is no section DATA".into()) } else { Ok(file) }
    }

    /// Behind its `#`.
    fn entity(&mut self, file: &mut ExchangeFile) -> Result<(), String> {
        let id = self.id()?;
        self.expect('=')?;
        let mut records = Vec::new();
        if self.eat('(')? {
            while !self.eat(')')? {
                let name = self.name()?;
                records.push(StepRecord { name, values: self.parameters(0)? });
            }
        } else {
            let name = self.name()?;
            records.push(StepRecord { name, values: self.parameters(0)? });
        }
        self.expect(';')?;
        if file.entities.insert(id, records).is_some() {
            return Err(format!("entity #{id} is defined a second time"));
        }
        file.order.push(id);
        Ok(())
    }

    fn id(&mut self) -> Result<u64, String> {
        let digits = self.run(|c| c.is_ascii_digit());
        digits.parse().map_err(|_| format!("`#{digits}` is no number of an entity"))
    }

    fn parameters(&mut self, depth: usize) -> Result<Vec<StepValue>, String> {
        if depth > MAX_DEPTH {
            return Err(format!("more than {MAX_DEPTH} lists are nested in each other"));
        }
        self.expect('(')?;
        let mut values = Vec::new();
        if self.eat(')')? {
            return Ok(values);
        }
        loop {
            values.push(self.value(depth)?);
            if self.eat(')')? {
                return Ok(values);
            }
            self.expect(',')?;
        }
    }

    fn value(&mut self, depth: usize) -> Result<StepValue, String> {
        let Some(first) = self.next()? else {
            return Err("a value is expected at the end of the file".into());
        };
        match first {
            '(' => Ok(StepValue::List(self.parameters(depth + 1)?)),
            '\'' => self.text(),
            '#' => {
                self.at += 1;
                self.id().map(StepValue::Reference)
            }
            '$' | '*' => {
                self.at += 1;
                Ok(StepValue::Nothing)
            }
            '"' => {
                self.at += 1;
                self.run(|c| c != '"');
                self.expect('"')?;
                Ok(StepValue::Nothing)
            }
            '.' => {
                self.at += 1;
                let word = self.run(|c| c.is_ascii_alphanumeric() || c == '_').to_ascii_uppercase();
                self.expect('.')?;
                Ok(StepValue::Word(word))
            }
            '+' | '-' | '0'..='9' => {
                let digits = self.run(|c| c.is_ascii_digit() || "+-.eE".contains(c));
                let number = digits.parse().ok().filter(|x: &f64| x.is_finite());
                number.map(StepValue::Number).ok_or_else(|| format!("`{digits}` is no number"))
            }
            _ => {
                self.name()?;
                Ok(StepValue::Typed(self.parameters(depth + 1)?))
            }
        }
    }

    /// A string: two apostrophes are one.
    fn text(&mut self) -> Result<StepValue, String> {
        self.at += 1;
        let mut raw = String::new();
        loop {
            raw.push_str(self.run(|c| c != '\''));
            if self.rest().starts_with("''") {
                raw.push('\'');
                self.at += 2;
            } else if self.rest().starts_with('\'') {
                self.at += 1;
                return Ok(StepValue::Text(decoded(&raw)));
            } else {
                return Err("a string has no end".into());
            }
        }
    }
}

/// With what is written in hexadecimal (`\X2\00E4\X0\`) as characters, and two backslashes as one. Other directives stay as they are.
fn decoded(raw: &str) -> String {
    let mut out = String::new();
    let mut rest = raw;
    while let Some(at) = rest.find('\\') {
        out.push_str(&rest[..at]);
        rest = &rest[at..];
        if let Some(after) = rest.strip_prefix("\\\\") {
            out.push('\\');
            rest = after;
        } else if let Some((digits, after)) = rest.strip_prefix("\\X2\\").and_then(|r| r.split_once("\\X0\\"))
        {
            let digits: Vec<char> = digits.chars().collect();
            let unit =
                |four: &[char]| u16::from_str_radix(&four.iter().collect::<String>(), 16).unwrap_or(0xfffd);
            let units: Vec<u16> = digits.chunks(4).map(unit).collect();
            out.push_str(&String::from_utf16_lossy(&units));
            rest = after;
        } else {
            out.push('\\');
            rest = &rest[1..];
        }
    }
    out.push_str(rest);
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(data: &str) -> String {
        format!(
            "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('it''s','b'),'2;1');\nENDSEC;\nDATA;\n{data}\nENDSEC;\nEND-ISO-10303-21;\n"
        )
    }

    #[test]
    fn entities_of_all_kinds_are_read() {
        let text = file(
            "#1=POINT('a /* b',(1.,-2.5E-3,+3));/* #9=NO(); */\n#2 = ( A(#1) B($,*,.T.,LENGTH_MEASURE(25.4),\"0F\",()) ) ;\n#3=N('\\X2\\00E4\\X0\\ \\\\');",
        );
        let read = ExchangeFile::read(&text).unwrap();
        assert_eq!(read.order, vec![1, 2, 3]);
        let point = read.record(1, "POINT").unwrap();
        assert_eq!(point.values[0].text(), Some("a /* b"));
        let numbers: Vec<f64> = point.values[1].list().iter().filter_map(StepValue::number).collect();
        assert_eq!(numbers, vec![1.0, -2.5e-3, 3.0]);
        let b = read.record(2, "B").unwrap();
        assert_eq!((b.values[2].word(), b.values[3].number()), (Some("T"), Some(25.4)));
        assert_eq!(read.record(2, "A").unwrap().reference(0), Some(1));
        assert_eq!(read.record(3, "N").unwrap().values[0].text(), Some("ä \\"));
        assert_eq!(read.header[0].values[0].list()[0].text(), Some("it's"));
    }

    #[test]
    fn slips_are_told_with_their_line() {
        let refusal = |data: &str| ExchangeFile::read(&file(data)).unwrap_err();
        assert!(refusal("#1=A(1,);").starts_with("line 6:"));
        assert!(refusal("#1=A('x);").contains("a string has no end"));
        assert!(refusal("#1=A(1);#1=A(2);").contains("a second time"));
        assert!(refusal("#1=A(1e);").contains("is no number"));
        assert!(refusal("/* no end").contains("a comment has no end"));
        assert!(refusal(&format!("#1=A({});", "(".repeat(100_000))).contains("are nested"));
        assert!(refusal(&format!("#1=A({}", "B(".repeat(100_000))).contains("are nested"));
        assert!(
            ExchangeFile::read("ISO-10303-21;HEADER;ENDSEC;END-ISO-10303-21;").unwrap_err().contains("DATA")
        );
        assert!(ExchangeFile::read("ISO-10303-21;DATA;").unwrap_err().contains("the end of the file"));
    }
}
