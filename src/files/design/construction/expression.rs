//! Small arithmetic expressions: `sqrt(3)*r/2 - 1.5`.
//!
//! ```text
//! length  = product [ unit ] { ("+" | "-") product [ unit ] }
//! sum     = product { ("+" | "-") product }
//! product = signed { ("*" | "/") signed }
//! signed  = { "+" | "-" } power
//! power   = atom [ "^" [ "-" ] digits ]
//! atom    = decimal | name | function "(" sum ")" | "(" sum ")"
//! ```

use std::ops::Range;

use crate::design::scale::{UNITS, micrometres};
use num::exact::{Rational, decimal};
use num::real::{NoReal, RealNumber};

/// Most bytes of an expression.
const MAX_LENGTH: usize = 2000;
/// Greatest nesting depth of signs and parentheses.
const MAX_DEPTH: usize = 24;
/// Greatest exponent of a decimal, and of a power.
const MAX_EXPONENT: u32 = 100;

/// The functions of one number.
const FUNCTIONS: [(&str, NamedFunction); 3] =
    [("sqrt", NamedFunction::Sqrt), ("sin_deg", NamedFunction::SinDeg), ("cos_deg", NamedFunction::CosDeg)];

/// Names of the functions.
pub(in crate::design) fn function_names() -> [&'static str; 3] {
    FUNCTIONS.map(|f| f.0)
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum NamedFunction {
    Sqrt,
    SinDeg,
    CosDeg,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

/// An expression, or a part of one, with its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::design) struct Expression {
    place: Range<usize>,
    part: SumPart,
}

#[derive(Debug, Clone, PartialEq)]
enum SumPart {
    Decimal(Rational),
    Name(String),
    Negative(Box<Expression>),
    /// From left to right, so that long sums are not deep.
    Chain(Box<Expression>, Vec<(Operator, Expression)>),
    Power(Box<Expression>, i32),
    Of(NamedFunction, Box<Expression>),
}

/// The fault of a text that is no expression, and its place.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::design) struct Slip {
    pub(in crate::design) place: Range<usize>,
    pub(in crate::design) message: String,
    /// The text is too long or nested too deep.
    pub(in crate::design) too_complex: bool,
}

/// The units that may stand behind a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::design) enum UnitsBehind {
    /// None: it is an angle, a share or a name for either.
    None,
    /// Units of length, which become the unit of the design: so many micrometres, where its label names a known length.
    Length(Option<u64>),
}

/// An operation without a result, and its place in the text.
#[derive(Debug, Clone, PartialEq)]
pub(in crate::design) struct Stuck {
    pub(in crate::design) place: Range<usize>,
    pub(in crate::design) why: Unsolved,
}

#[derive(Debug, Clone, PartialEq)]
pub(in crate::design) enum Unsolved {
    NoReal(NoReal),
    /// The name has no value.
    Name(String),
    /// The value of the name is unknown because of another fault, which is reported instead.
    Poisoned,
}

/// A name as expressions can use it: letters, digits and underscores, not a digit first, and no function.
pub(in crate::design) fn is_name(text: &str) -> bool {
    text.len() <= 60
        && text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
        && !function_names().contains(&text)
}

impl Expression {
    /// A number without unit.
    pub(in crate::design) fn parse(text: &str) -> Result<Self, Slip> {
        Self::read(text, UnitsBehind::None).map(|read| read.0)
    }

    /// A length, and whether it has its own unit: `12/5 mm`, `5 ft + 3 in`. The factor to the unit of the design is in
    /// the expression, so that it stays exact.
    pub(in crate::design) fn read(text: &str, units: UnitsBehind) -> Result<(Self, bool), Slip> {
        if text.len() > MAX_LENGTH {
            let message = format!("the expression is longer than {MAX_LENGTH} characters");
            return Err(Slip { place: 0..text.len(), message, too_complex: true });
        }
        let mut reader = ExpressionReader { text, at: 0, depth: 0, units, terms: 0, with_unit: 0 };
        let whole = reader.chain([('+', Operator::Plus), ('-', Operator::Minus)], ExpressionReader::term)?;
        reader.skip_blanks();
        match reader.rest().chars().next() {
            None if reader.with_unit != 0 && reader.with_unit != reader.terms => {
                let message = "either every term of a sum has a unit, or none has one".to_owned();
                Err(Slip { place: whole.place, message, too_complex: false })
            }
            None => Ok((whole, reader.with_unit != 0)),
            Some(c) => {
                let message = format!("`{}` is out of place in the expression", c.escape_debug());
                Err(Slip { place: reader.at..reader.at + c.len_utf8(), message, too_complex: false })
            }
        }
    }

    /// The names in it.
    pub(in crate::design) fn names(&self) -> Vec<&str> {
        match &self.part {
            SumPart::Decimal(_) => Vec::new(),
            SumPart::Name(name) => vec![name],
            SumPart::Negative(x) | SumPart::Power(x, _) | SumPart::Of(_, x) => x.names(),
            SumPart::Chain(first, rest) => {
                first.names().into_iter().chain(rest.iter().flat_map(|(_, x)| x.names())).collect()
            }
        }
    }

    /// The value of a decimal with or without a sign.
    pub(in crate::design) fn decimal(&self) -> Option<Rational> {
        match &self.part {
            SumPart::Decimal(x) => Some(x.clone()),
            SumPart::Negative(x) => x.decimal().map(|x| -x),
            _ => None,
        }
    }

    /// Its operations, square roots counted as many.
    pub(in crate::design) fn work(&self) -> usize {
        match &self.part {
            SumPart::Decimal(_) | SumPart::Name(_) => 1,
            SumPart::Negative(x) => x.work(),
            SumPart::Power(x, _) => x.work() + 10,
            SumPart::Of(_, x) => x.work() + 20,
            SumPart::Chain(first, rest) => {
                first.work() + rest.iter().map(|(_, x)| 1 + x.work()).sum::<usize>()
            }
        }
    }

    /// The value, with that of the names from outside.
    pub(in crate::design) fn value(
        &self,
        named: &dyn Fn(&str) -> Result<RealNumber, Unsolved>,
    ) -> Result<RealNumber, Stuck> {
        let stuck = |place: &Range<usize>, why| Stuck { place: place.clone(), why };
        let here = |why: NoReal| stuck(&self.place, Unsolved::NoReal(why));
        match &self.part {
            SumPart::Decimal(x) => RealNumber::rational(x).map_err(here),
            SumPart::Name(name) => named(name).map_err(|why| stuck(&self.place, why)),
            SumPart::Negative(x) => Ok(x.value(named)?.negated()),
            SumPart::Power(x, n) => x.value(named)?.power(*n).map_err(here),
            SumPart::Of(function, x) => {
                let x = x.value(named)?;
                match function {
                    NamedFunction::Sqrt => x.sqrt(),
                    NamedFunction::SinDeg => x.turn().map(|t| t.1),
                    NamedFunction::CosDeg => x.turn().map(|t| t.0),
                }
                .map_err(here)
            }
            SumPart::Chain(first, rest) => {
                let mut x = first.value(named)?;
                for (operator, other) in rest {
                    let y = other.value(named)?;
                    // a failing division blames its divisor
                    let from = if *operator == Operator::Over { other } else { &**first };
                    let stuck = |why| stuck(&(from.place.start..other.place.end), Unsolved::NoReal(why));
                    x = match operator {
                        Operator::Plus => x.plus(&y),
                        Operator::Minus => x.minus(&y),
                        Operator::Times => x.times(&y),
                        Operator::Over => x.over(&y),
                    }
                    .map_err(stuck)?;
                }
                Ok(x)
            }
        }
    }
}

struct ExpressionReader<'t> {
    text: &'t str,
    at: usize,
    depth: usize,
    units: UnitsBehind,
    /// Terms of the whole sum, and how many of them have a unit.
    terms: usize,
    with_unit: usize,
}

impl<'t> ExpressionReader<'t> {
    fn rest(&self) -> &'t str {
        &self.text[self.at..]
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().len() - self.rest().trim_start().len();
    }

    /// Takes one of the characters if it is next.
    fn take(&mut self, any: &[char]) -> Option<char> {
        self.skip_blanks();
        let c = self.rest().chars().next().filter(|c| any.contains(c))?;
        self.at += c.len_utf8();
        Some(c)
    }

    /// The longest run of such characters.
    fn run(&mut self, kind: impl Fn(char) -> bool) -> &'t str {
        let rest = self.rest();
        let run = &rest[..rest.find(|c| !kind(c)).unwrap_or(rest.len())];
        self.at += run.len();
        run
    }

    fn slip<T>(&self, from: usize, message: impl Into<String>) -> Result<T, Slip> {
        Err(Slip { place: from..self.at.max(from), message: message.into(), too_complex: false })
    }

    fn deeper<T>(&mut self, read: impl FnOnce(&mut Self) -> Result<T, Slip>) -> Result<T, Slip> {
        if self.depth == MAX_DEPTH {
            let message = format!("more than {MAX_DEPTH} signs and parentheses stand inside one another");
            return Err(Slip { place: self.at..self.at, message, too_complex: true });
        }
        self.depth += 1;
        let read = read(self);
        self.depth -= 1;
        read
    }

    fn chain(
        &mut self,
        signs: [(char, Operator); 2],
        mut next: impl FnMut(&mut Self) -> Result<Expression, Slip>,
    ) -> Result<Expression, Slip> {
        let first = next(self)?;
        let mut rest = Vec::new();
        while let Some(sign) = self.take(&signs.map(|s| s.0)) {
            let operator = if sign == signs[0].0 { signs[0].1 } else { signs[1].1 };
            rest.push((operator, next(self)?));
        }
        Ok(match rest.last() {
            None => first,
            Some((_, last)) => Expression {
                place: first.place.start..last.place.end,
                part: SumPart::Chain(Box::new(first), rest),
            },
        })
    }

    /// A product of the whole sum, with the unit behind it.
    fn term(&mut self) -> Result<Expression, Slip> {
        let product = self.product()?;
        self.terms += 1;
        self.skip_blanks();
        let from = self.at;
        let word = self.run(|c| c.is_ascii_alphanumeric() || c == '_');
        let Some(length) = micrometres(word) else {
            self.at = from;
            return Ok(product);
        };
        let own = match self.units {
            UnitsBehind::Length(Some(own)) => own,
            UnitsBehind::Length(None) => {
                let known = UNITS.map(|(label, _)| label).join(", ");
                let message = format!(
                    "`{word}` cannot be converted, since the unit of the design is no known length; known are {known}"
                );
                return self.slip(from, message);
            }
            UnitsBehind::None => {
                return self
                    .slip(from, format!("`{word}` is a unit of length, and this number is no length"));
            }
        };
        self.with_unit += 1;
        let factor = SumPart::Decimal(Rational::new(length.into(), own.into()));
        let factor = Expression { place: from..self.at, part: factor };
        let place = product.place.start..self.at;
        Ok(Expression { place, part: SumPart::Chain(Box::new(product), vec![(Operator::Times, factor)]) })
    }

    fn sum(&mut self) -> Result<Expression, Slip> {
        self.chain([('+', Operator::Plus), ('-', Operator::Minus)], Self::product)
    }

    fn product(&mut self) -> Result<Expression, Slip> {
        self.chain([('*', Operator::Times), ('/', Operator::Over)], Self::signed)
    }

    fn signed(&mut self) -> Result<Expression, Slip> {
        self.skip_blanks();
        let from = self.at;
        match self.take(&['+', '-']) {
            None => self.power(),
            Some(sign) => {
                let inner = self.deeper(Self::signed)?;
                let place = from..inner.place.end;
                let part = if sign == '-' { SumPart::Negative(Box::new(inner)) } else { inner.part };
                Ok(Expression { place, part })
            }
        }
    }

    fn power(&mut self) -> Result<Expression, Slip> {
        let root = self.atom()?;
        if self.take(&['^']).is_none() {
            return Ok(root);
        }
        self.skip_blanks();
        let from = self.at;
        let negative = self.take(&['-']).is_some();
        let digits = self.run(|c| c.is_ascii_digit());
        let exponent = digits.parse::<u32>().ok().filter(|n| *n <= MAX_EXPONENT);
        let Some(n) = exponent.and_then(|n| i32::try_from(n).ok()) else {
            let rule = format!("an exponent is an integer from -{MAX_EXPONENT} to {MAX_EXPONENT}");
            return self.slip(from, rule);
        };
        let n = if negative { -n } else { n };
        Ok(Expression { place: root.place.start..self.at, part: SumPart::Power(Box::new(root), n) })
    }

    fn atom(&mut self) -> Result<Expression, Slip> {
        self.skip_blanks();
        let from = self.at;
        if self.take(&['(']).is_some() {
            let inner = self.deeper(Self::sum)?;
            return self.closed(from, inner.part);
        }
        if self.rest().starts_with(|c: char| c.is_ascii_digit() || c == '.') {
            return self.decimal();
        }
        let word = self.run(|c| c.is_ascii_alphanumeric() || c == '_');
        if word.is_empty() {
            let found = self.rest().chars().next();
            let end = from + found.map_or(0, char::len_utf8);
            let found = found.map_or("the end".to_string(), |c| format!("`{}`", c.escape_debug()));
            let message = format!("a number, a name or a parenthesis is missing before {found}");
            return Err(Slip { place: from..end, message, too_complex: false });
        }
        let named = Expression { place: from..self.at, part: SumPart::Name(word.to_string()) };
        if self.take(&['(']).is_none() {
            return Ok(named);
        }
        let Some((_, function)) = FUNCTIONS.iter().find(|f| f.0 == word) else {
            let message = format!("there is no function `{word}`, only {}", function_names().join(", "));
            return Err(Slip { place: named.place, message, too_complex: false });
        };
        let argument = self.deeper(Self::sum)?;
        self.closed(from, SumPart::Of(*function, Box::new(argument)))
    }

    fn closed(&mut self, from: usize, part: SumPart) -> Result<Expression, Slip> {
        if self.take(&[')']).is_none() {
            return self.slip(from, "a parenthesis is not closed");
        }
        Ok(Expression { place: from..self.at, part })
    }

    /// `12`, `0.5`, `1.5e-3`: the decimal that is written.
    fn decimal(&mut self) -> Result<Expression, Slip> {
        let from = self.at;
        let digit = |c: char| c.is_ascii_digit();
        let whole = self.run(digit);
        let fraction = if self.rest().starts_with('.') {
            self.at += 1;
            self.run(digit)
        } else {
            ""
        };
        let mut exponent = 0i64;
        let mark = self.at;
        if self.rest().starts_with(['e', 'E']) {
            self.at += 1;
            let negative = self.rest().starts_with('-');
            if self.rest().starts_with(['-', '+']) {
                self.at += 1;
            }
            let digits = self.run(digit);
            let limit = |n: &u32| *n <= MAX_EXPONENT;
            let Some(n) = digits.parse::<u32>().ok().filter(limit) else {
                return self.slip(mark, format!("the exponent of a decimal is at most {MAX_EXPONENT}"));
            };
            exponent = if negative { -i64::from(n) } else { i64::from(n) };
        }
        let exponent = exponent - i64::try_from(fraction.len()).unwrap_or(0);
        let Some(value) = decimal(&format!("{whole}{fraction}"), exponent) else {
            return self.slip(from, "this is not a decimal number");
        };
        Ok(Expression { place: from..self.at, part: SumPart::Decimal(value) })
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn value(text: &str) -> Result<RealNumber, String> {
        let parsed = Expression::parse(text).map_err(|slip| format!("{:?} {}", slip.place, slip.message))?;
        let named = |name: &str| match name {
            "r" => Ok(RealNumber::integer(6)),
            "h_1" => Ok(RealNumber::integer(-2)),
            _ => Err(Unsolved::Name(name.to_string())),
        };
        parsed.value(&named).map_err(|stuck| format!("{:?} {:?}", stuck.place, stuck.why))
    }

    fn shown(text: &str) -> String {
        match value(text) {
            Ok(RealNumber::Exact(x)) => x.to_string(),
            Ok(RealNumber::Within(_)) => "within".to_string(),
            Err(why) => why,
        }
    }

    #[test]
    fn values_follow_the_usual_precedence() {
        for (text, expected) in [
            ("1/3", "1/3"),
            ("0.1", "1/10"),
            ("1.5e-3", "3/2000"),
            ("2e2", "200"),
            ("1 - 2 - 3", "-4"),
            ("8/2/2", "2"),
            ("2 + 3*4^2", "50"),
            ("-2^2", "-4"),
            ("(-2)^2", "4"),
            ("2^-2", "1/4"),
            ("--r", "6"),
            ("r*sqrt(3)", "6*sqrt(3)"),
            ("sqrt( 12 )/h_1", "-sqrt(3)"),
            ("sqrt(8 + 4*sqrt(3))", "sqrt(2) + sqrt(6)"),
            ("1/(1 + sqrt(2))", "-1 + sqrt(2)"),
            ("cos_deg(30)", "sqrt(3)/2"),
            ("sin_deg(-150)", "-1/2"),
            ("cos_deg(75)*4", "-sqrt(2) + sqrt(6)"),
            ("sqrt(3 + sqrt(2))", "within"),
            ("cos_deg(80)", "cos_deg(80)"),
            ("cos_deg(7)", "within"),
            ("sqrt(2 + sqrt(2))", "2*cos_deg(22.5)"),
            ("sqrt(10 - 2*sqrt(5))/4 - sin_deg(36)", "0"),
            (".5", "1/2"),
        ] {
            assert_eq!(shown(text), expected, "{text}");
        }
    }

    #[test]
    fn lengths_may_have_units_and_stay_exact() {
        let length = |text: &str, own: Option<u64>| -> String {
            match Expression::read(text, UnitsBehind::Length(own)) {
                Err(slip) => format!("{:?} {}", slip.place, slip.message),
                Ok((read, with_unit)) => {
                    let value = read.value(&|name| Err(Unsolved::Name(name.to_string())));
                    let value = value.map(|x| x.exact().map(ToString::to_string));
                    format!("{} {with_unit}", value.unwrap().unwrap())
                }
            }
        };
        let mixed = "either every term of a sum has a unit, or none has one";
        for (text, own, expected) in [
            ("12/5 mm", Some(1000), "12/5 true"),
            ("36/19 in", Some(1000), "4572/95 true"),
            ("1in", Some(304_800), "1/12 true"),
            ("5 ft + 3 in", Some(25_400), "63 true"),
            ("-sqrt(3)*2 cm - 1 mm", Some(1000), "-1 - 20*sqrt(3) true"),
            ("(1 + 2)/3 m", Some(1000), "1000 true"),
            ("12/5", Some(1000), "12/5 false"),
            ("12/5", None, "12/5 false"),
            ("1 + 2 mm", Some(1000), &format!("0..8 {mixed}")),
            ("(1 mm)*2", Some(1000), "0..3 a parenthesis is not closed"),
            ("2 mm mm", Some(1000), "5..6 `m` is out of place in the expression"),
            ("2 parsec", Some(1000), "2..3 `p` is out of place in the expression"),
        ] {
            assert_eq!(length(text, own), expected, "{text}");
        }
        assert!(length("2 mm", None).starts_with("2..4 `mm` cannot be converted"));
        assert_eq!(shown("2 mm"), "2..4 `mm` is a unit of length, and this number is no length");
    }

    #[test]
    fn slips_are_named_where_they_are() {
        for (text, expected) in [
            ("", "0..0 a number, a name or a parenthesis is missing before the end"),
            ("1 +", "3..3 a number, a name or a parenthesis is missing before the end"),
            ("1 + * 2", "4..5 a number, a name or a parenthesis is missing before `*`"),
            ("2 r", "2..3 `r` is out of place in the expression"),
            ("(1 + 2", "0..6 a parenthesis is not closed"),
            ("1)", "1..2 `)` is out of place in the expression"),
            ("root(2)", "0..4 there is no function `root`, only sqrt, sin_deg, cos_deg"),
            ("2^r", "2..2 an exponent is an integer from -100 to 100"),
            ("2^1000", "2..6 an exponent is an integer from -100 to 100"),
            ("1e999999999999", "1..14 the exponent of a decimal is at most 100"),
            (".", "0..1 this is not a decimal number"),
            ("\u{3c0}", "0..2 a number, a name or a parenthesis is missing before `\u{3c0}`"),
            ("1/(r - 6)", "2..9 NoReal(DivisionByZero)"),
            ("2*sqrt(h_1)", "2..11 NoReal(NegativeRoot)"),
            ("r + s", "4..5 Name(\"s\")"),
        ] {
            assert_eq!(shown(text), expected, "{text}");
        }
    }

    #[test]
    fn hostile_texts_are_refused_before_they_cost_anything() {
        for text in
            ["(".repeat(1900), "-".repeat(1900), "1+".repeat(4000), format!("{}2", "sqrt(".repeat(35))]
        {
            let slip = Expression::parse(&text).unwrap_err();
            assert!(slip.too_complex, "{}", slip.message);
        }
        assert!(value(&format!("{}1", "1+".repeat(999))).is_ok(), "a long sum is not deep");
        // as much arithmetic as fits
        assert!(value(&format!("{}1", "9e9*".repeat(49))).is_ok());
        assert!(value(&format!("{}1", "9e99*".repeat(39))).is_err());
        assert!(value(&format!("{}1", "9e-99^100*".repeat(19))).is_err());
        assert!(value("(sqrt(2)+sqrt(3)+sqrt(5)+sqrt(7)+sqrt(11)+sqrt(13))^100").is_ok());
    }

    proptest! {
        #[test]
        fn no_text_makes_it_panic(text in "[-+*/^()0-9.er sqrt_deg\u{e9}]{0,40}") {
            let _ = value(&text);
        }

        #[test]
        fn what_a_number_is_written_as_reads_back(n in -50i64..50, d in 1i64..20, k in 1i64..30) {
            let text = format!("{n}/{d} + {d}*sqrt({k})/7");
            let x = value(&text).unwrap();
            prop_assert_eq!(value(&x.exact().unwrap().to_string()).unwrap(), x);
        }
    }
}
